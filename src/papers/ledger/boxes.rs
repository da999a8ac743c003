//! Bounds of a function over a box, by subdivision in balls.

use crate::reference::{Ball, Mag};
use crate::symbolic::evaluation::{Balls, Evaluator, Value};
use crate::symbolic::graph::{Graph, Id};
use crate::symbolic::{Definitions, Expr, SymbolicError};
use rug::Rational;
use std::cmp::Ordering;
use std::collections::BinaryHeap;
use std::sync::Arc;

/// A box: names with their ends.
pub type Region = Vec<(String, [Rational; 2])>;

/// Working precision of the enclosures.
const BITS: u32 = 128;
/// Evaluations of one search, a few seconds of a formula of usual length.
const MOST: usize = 100_000;

/// The largest end of a box, so that its widths are numbers in binary64.
const LARGEST: f64 = 1e300;

/// A real function on a box.
#[derive(Clone, Debug)]
pub struct Function {
    graph: Arc<Graph>,
    value: Id,
    region: Vec<[Rational; 2]>,
}

/// A part of the box with an upper bound of the function there.
struct Part {
    bound: f64,
    ends: Vec<[Rational; 2]>,
}

impl PartialEq for Part {
    fn eq(&self, other: &Part) -> bool {
        self.cmp(other).is_eq()
    }
}
impl Eq for Part {}
impl PartialOrd for Part {
    fn partial_cmp(&self, other: &Part) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for Part {
    fn cmp(&self, other: &Part) -> Ordering {
        self.bound.total_cmp(&other.bound)
    }
}

impl Function {
    /// Prepares an expression whose free symbols are those of the box.
    ///
    /// # Errors
    /// An expression without meaning over the real numbers.
    pub fn new(
        definitions: &Definitions,
        e: &Expr,
        region: &Region,
    ) -> Result<Function, SymbolicError> {
        if region
            .iter()
            .flat_map(|r| &r.1)
            .any(|end| end.clone().abs() > LARGEST)
        {
            let reason = format!("an end of more than {LARGEST:e}");
            return Err(SymbolicError::Unsupported(reason));
        }
        let names = region.iter().map(|r| r.0.clone());
        let mut graph = Graph::new(names).of_real_functions();
        let value = graph.build(definitions, e)?;
        if graph.is_complex(value) || graph.is_condition(value) {
            let reason = format!("{e} is no real number");
            return Err(SymbolicError::Unsupported(reason));
        }
        Ok(Function {
            graph: Arc::new(graph),
            value,
            region: region.iter().map(|r| r.1.clone()).collect(),
        })
    }

    /// An enclosure of the values on a box; none where one of them may be undefined.
    fn over(&self, evaluator: &mut Evaluator<Balls>, ends: &[[Rational; 2]]) -> Option<Ball> {
        evaluator.reset(false);
        for (k, [a, b]) in ends.iter().enumerate() {
            let middle = Rational::from(a + b) / 2u32;
            let mut ball = Ball::rational(BITS, &middle);
            if a != b {
                // The quotient is cut off, by less than one part in 10^15 of a normal number.
                let radius = (Rational::from(b - a) / 2u32).to_f64();
                let radius = (radius * (1.0 + 1e-15)).max(f64::MIN_POSITIVE);
                ball = ball.widened(Mag::from_f64(radius));
            }
            evaluator.set_input(k, Value::Real(ball));
        }
        evaluator.value(self.value).ok()?.real().cloned()
    }

    /// Returns true if the function is proved to be positive everywhere.
    pub fn is_positive(&self) -> bool {
        let mut evaluator = Evaluator::new(Arc::clone(&self.graph), Balls::new(BITS));
        let mut open = vec![self.region.clone()];
        for _ in 0..MOST {
            let Some(ends) = open.pop() else { return true };
            match self.over(&mut evaluator, &ends) {
                Some(value) if value.is_positive() => {}
                Some(value) if value.is_negative() => return false,
                _ => match halves(&ends) {
                    Some(halves) => open.extend(halves),
                    None => return false,
                },
            }
        }
        false
    }

    /// The largest value, in a ball of a radius of at most `within`; none if it is not found.
    pub fn largest(&self, within: f64) -> Option<Ball> {
        let mut evaluator = Evaluator::new(Arc::clone(&self.graph), Balls::new(BITS));
        let mut heap = BinaryHeap::new();
        let mut least: Option<Ball> = None;
        let mut open = vec![self.region.clone()];
        for _ in 0..MOST {
            for ends in std::mem::take(&mut open) {
                let bound = self.over(&mut evaluator, &ends);
                let bound = bound.map_or(f64::INFINITY, |b| upper(&b));
                let point: Vec<_> = ends
                    .iter()
                    .map(|[a, b]| Rational::from(a + b) / 2u32)
                    .map(|m| [m.clone(), m])
                    .collect();
                if let Some(value) = self.over(&mut evaluator, &point)
                    && least.as_ref().is_none_or(|l| lower(&value) > lower(l))
                {
                    least = Some(value);
                }
                heap.push(Part { bound, ends });
            }
            let top = heap.pop()?;
            if let Some(least) = &least {
                let (low, high) = (lower(least), top.bound);
                if high - low <= 2.0 * within && high.is_finite() {
                    let middle = low + (high - low) / 2.0;
                    // Both differences are rounded, by less than the spacing of the ends.
                    let radius =
                        (high - middle).max(middle - low) + (low.abs().max(high.abs())) * 1e-15;
                    let exact = Rational::from_f64(middle)?;
                    return Some(Ball::rational(BITS, &exact).widened(Mag::from_f64(radius)));
                }
            }
            open.extend(halves(&top.ends)?);
        }
        None
    }
}

/// A number that is certainly not below the ball.
fn upper(b: &Ball) -> f64 {
    let (middle, radius) = (b.mid().to_f64(), b.rad().to_f64());
    ((middle + radius) + (middle.abs() + radius) * 1e-15).next_up()
}

/// A number that is certainly not above the ball.
fn lower(b: &Ball) -> f64 {
    let (middle, radius) = (b.mid().to_f64(), b.rad().to_f64());
    ((middle - radius) - (middle.abs() + radius) * 1e-15).next_down()
}

/// The halves of a box, cut across its longest side; none of a point.
fn halves(ends: &[[Rational; 2]]) -> Option<[Vec<[Rational; 2]>; 2]> {
    let width = |[a, b]: &[Rational; 2]| Rational::from(b - a);
    let (k, side) = ends
        .iter()
        .enumerate()
        .max_by(|a, b| width(a.1).cmp(&width(b.1)))?;
    if width(side) <= 0 {
        return None;
    }
    let middle = Rational::from(&side[0] + &side[1]) / 2u32;
    let mut halves = [ends.to_vec(), ends.to_vec()];
    halves[0][k][1] = middle.clone();
    halves[1][k][0] = middle;
    Some(halves)
}
