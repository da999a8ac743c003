//! Cases of studies of linear algebra.

use super::super::error::StudyError;
use super::super::problem::{Problem, intern};
use super::{Linear, Size, Task};
use crate::audit::{CheckPoint, Domain, Draw, Region};
use crate::reference::nearest_f64;
use std::sync::Arc;

/// The largest open length that is drawn.
const LARGEST: usize = 8;

/// The kind of matrices in a region.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Random,
    /// The last row is the first one but for a small part of it.
    NearlySingular,
    /// `1/(i + j + 1)` of the upper end.
    Hilbert,
}

/// A problem to draw for.
struct Sampler {
    linear: Linear,
    ranges: Vec<[f64; 2]>,
}

/// The domain of a study of linear algebra.
pub(in super::super) fn domain(problem: &Problem, linear: &Linear) -> Result<Domain, StudyError> {
    let mut ranges = Vec::new();
    for input in &problem.inputs {
        let low = input.from.as_ref().map_or(-1.0, nearest_f64);
        let high = input.to.as_ref().map_or(1.0, nearest_f64);
        if low > high || !low.is_finite() || !high.is_finite() {
            return Err(StudyError::new(format!(
                "the range of {} is empty: {low:e} to {high:e}; it is -1 to 1 where no ends are stated",
                input.name
            )));
        }
        ranges.push([low, high]);
    }
    let names = problem.inputs.iter().zip(&ranges);
    let text = names.map(|(i, [low, high])| format!("{} = {low:e}..{high:e}", i.name));
    let entries = text.collect::<Vec<_>>().join(", ");
    let sampler = Arc::new(Sampler {
        linear: linear.clone(),
        ranges,
    });
    let is_dense = linear
        .tasks
        .iter()
        .all(|t| linear.tensors[t.matrix()].band.is_none());
    let mut kinds = vec![("random", Kind::Random, format!("entries of {entries}"))];
    if is_dense {
        let near = "the last row, and column of a symmetric matrix, is nearly the first";
        kinds.push(("nearly-singular", Kind::NearlySingular, near.into()));
        let hilbert = "matrices of 1/(i + j + 1), i and j from 0 on, within the ranges";
        kinds.push(("hilbert", Kind::Hilbert, hilbert.into()));
    }
    let regions = kinds.into_iter().map(|(name, kind, text)| {
        let sampler = sampler.clone();
        Region::new(name, intern(&text), move |d| sampler.draw(kind, d))
    });
    let regions = regions.collect();
    let input = sampler.draw(Kind::Random, &mut Draw::new(1, "study", "check", 0));
    let check_points = vec![CheckPoint {
        name: "first",
        input,
    }];
    Ok(Domain {
        regions,
        check_points,
    })
}

impl Sampler {
    fn draw(&self, kind: Kind, d: &mut Draw) -> Vec<f64> {
        let linear = &self.linear;
        let (mut least, mut most) = (1, LARGEST);
        for task in &linear.tasks {
            if let Task::LeastSquares(a, _) = task {
                match (linear.tensors[*a].rows, linear.tensors[*a].columns) {
                    (Size::Open, Some(Size::Known(n))) => (least, most) = (n, n + LARGEST),
                    (Size::Known(m), Some(Size::Open)) => most = most.min(m),
                    _ => {}
                }
            }
        }
        let open = d.integer(least, most);
        let mut all = Vec::new();
        for (k, tensor) in linear.tensors.iter().enumerate() {
            let [low, high] = self.ranges[k];
            let is = |of: fn(&Task) -> Option<usize>| linear.tasks.iter().any(|t| of(t) == Some(k));
            let is_symmetric = is(|t| match t {
                Task::Eigenvalues(a, _) => Some(*a),
                _ => None,
            });
            let is_positive = is(|t| match t {
                Task::Eigenvalues(_, b) => *b,
                _ => None,
            });
            let is_matrix = linear.tasks.iter().any(|t| t.matrix() == k);
            let places: Vec<(usize, usize)> = tensor.places(open).collect();
            let mut values: Vec<f64> = places.iter().map(|_| d.uniform(low, high)).collect();
            let n = tensor.columns_at(open);
            let rows = tensor.rows.at(open);
            let clamped = |x: f64| x.clamp(low, high);
            if is_matrix && !is_positive && kind == Kind::Hilbert {
                for (x, (i, j)) in values.iter_mut().zip(&places) {
                    *x = clamped(high / (i + j + 1) as f64);
                }
            }
            if is_matrix && !is_positive && kind == Kind::NearlySingular && rows > 1 {
                let part = 2f64.powi(-(d.integer(8, 45) as i32));
                for j in 0..n {
                    let last = (rows - 1) * n + j;
                    values[last] = clamped(values[j] + part * values[last]);
                }
            }
            if is_positive {
                // Diagonally dominant.
                for (x, (i, j)) in values.iter_mut().zip(&places) {
                    *x = match i == j {
                        true => clamped(high * d.uniform(0.5, 1.0)),
                        false => clamped(*x / (4 * rows) as f64),
                    };
                }
            }
            if is_symmetric || is_positive {
                mirror(&mut values, &places);
            }
            all.extend(values);
        }
        all
    }
}

/// Sets entries below the diagonal to those above.
fn mirror(values: &mut [f64], places: &[(usize, usize)]) {
    let known: std::collections::HashMap<(usize, usize), f64> =
        places.iter().copied().zip(values.iter().copied()).collect();
    for (x, (i, j)) in values.iter_mut().zip(places) {
        if i > j {
            *x = known.get(&(*j, *i)).copied().unwrap_or(0.0);
        }
    }
}

/// Returns true if every number is within its range, and their count is right.
pub(in super::super) fn admits(problem: &Problem, linear: &Linear, input: &[f64]) -> bool {
    let Some(open) = linear.open(input.len()) else {
        return false;
    };
    let parts = linear.parts(input, open);
    problem.inputs.iter().zip(parts).all(|(i, part)| {
        part.iter().all(|x| {
            rug::Rational::from_f64(*x).is_some_and(|x| {
                i.from.as_ref().is_none_or(|from| *from <= x)
                    && i.to.as_ref().is_none_or(|to| x <= *to)
            })
        })
    })
}
