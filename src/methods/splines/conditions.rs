//! `Σ_j |x_j ∂f/∂x_j|` of splines, by differences at 256 bits.
//!
//! An estimate, as every condition is here; no reference value depends on it. The spline is solved
//! for its slopes by ordinary elimination in floats, and again with each datum times `1 + 2⁻⁹⁰`.
//! Queries stay on their segments, so that the one-sided third derivative is well defined.

use super::common::{EndCondition, SplineProblem};
use rug::{Assign, Float};

const BITS: u32 = 256;
const STEP: u32 = 90;

fn float(v: f64) -> Float {
    Float::with_val(BITS, v)
}

/// The value of an operation.
fn with<T>(v: T) -> Float
where
    Float: Assign<T>,
{
    Float::with_val(BITS, v)
}

/// `Σ a_i b_i`.
fn sum(terms: &[(&Float, &Float)]) -> Float {
    let mut s = Float::new(BITS);
    for (a, b) in terms {
        s += *a * *b;
    }
    s
}

struct Slopes<'a> {
    h: Vec<Float>,
    delta: Vec<Float>,
    y: &'a [Float],
    x: &'a [Float],
    s: Vec<Float>,
}

/// Gaussian elimination with partial pivoting on a dense matrix whose rows end in the right-hand
/// side; zeros are skipped. `None` without a pivot.
fn eliminate(mut a: Vec<Vec<Float>>) -> Option<Vec<Float>> {
    let n = a.len();
    for c in 0..n {
        let best = (c..n).max_by(|&i, &j| {
            a[i][c]
                .cmp_abs(&a[j][c])
                .unwrap_or(std::cmp::Ordering::Equal)
        })?;
        a.swap(c, best);
        if a[c][c].is_zero() {
            return None;
        }
        let (done, rest) = a.split_at_mut(c + 1);
        let pivot = &done[c];
        for row in rest {
            if row[c].is_zero() {
                continue;
            }
            let f = Float::with_val(BITS, &row[c] / &pivot[c]);
            for j in c..=n {
                if !pivot[j].is_zero() {
                    row[j] -= &f * &pivot[j];
                }
            }
        }
    }
    // The last unknown first.
    let mut x: Vec<Float> = Vec::new();
    for (i, row) in a.iter().enumerate().rev() {
        let mut v = row[n].clone();
        for (c, known) in row[n - x.len()..n].iter().zip(x.iter().rev()) {
            if !c.is_zero() {
                v -= c * known;
            }
        }
        x.push(v / &row[i]);
    }
    x.reverse();
    Some(x)
}

impl<'a> Slopes<'a> {
    fn new(kind: EndCondition, problem: SplineProblem<'a, Float>) -> Option<Slopes<'a>> {
        let SplineProblem { x, y, ends, .. } = problem;
        let difference = |p: &[Float]| Float::with_val(BITS, &p[1] - &p[0]);
        let h: Vec<Float> = x.windows(2).map(difference).collect();
        let delta: Vec<Float> = y
            .windows(2)
            .zip(&h)
            .map(|(p, h)| difference(p) / h)
            .collect();
        let n = h.len();
        let periodic = kind == EndCondition::Periodic;
        let size = if periodic { n } else { n + 1 };
        let mut rows = vec![vec![Float::new(BITS); size + 1]; size];
        let one = float(1.0);
        let smooth =
            |row: &mut Vec<Float>, (p, q): (usize, usize), (i, j, k): (usize, usize, usize)| {
                let (a, b) = (
                    Float::with_val(BITS, &one / &h[p]),
                    Float::with_val(BITS, &one / &h[q]),
                );
                row[j] += Float::with_val(BITS, &a + &b) * 2;
                row[size] += sum(&[(&a, &delta[p]), (&b, &delta[q])]) * 3;
                row[i] += a;
                row[k] += b;
            };
        if periodic {
            for (i, row) in rows.iter_mut().enumerate() {
                let before = (i + n - 1) % n;
                smooth(row, (before, i), (before, i, (i + 1) % n));
            }
        } else {
            for (i, row) in rows.iter_mut().enumerate().take(n).skip(1) {
                smooth(row, (i - 1, i), (i - 1, i, i + 1));
            }
        }
        match kind {
            EndCondition::Periodic => {}
            EndCondition::Clamped => {
                let [first, last] = ends?;
                for (i, v) in [(0, first), (n, last)] {
                    rows[i][i] = one.clone();
                    rows[i][size] = v.clone();
                }
            }
            EndCondition::SecondDerivatives => {
                let [first, last] = ends?;
                let row = |own: usize, other: usize, rhs: Float, rows: &mut Vec<Vec<Float>>| {
                    rows[own][own] = float(2.0);
                    rows[own][other] = one.clone();
                    rows[own][size] = rhs;
                };
                let bend =
                    |d: &Float, h: &Float, m: Float| Float::with_val(BITS, d * 3u32) - m * h / 2u32;
                let left = bend(&delta[0], &h[0], first.clone());
                let right = bend(&delta[n - 1], &h[n - 1], -last.clone());
                row(0, 1, left, &mut rows);
                row(n, n - 1, right, &mut rows);
            }
            EndCondition::NotAKnot if n < 3 => {
                // One parabola, or a line: S'' is the same at both ends of each end segment.
                for (i, a) in [(0, 0), (n, n - 1)] {
                    rows[i][a] = one.clone();
                    rows[i][a + 1] = one.clone();
                    rows[i][size] = Float::with_val(BITS, &delta[a] * 2u32);
                }
                if n == 1 {
                    rows[1] = vec![float(1.0), float(-1.0), float(0.0)];
                }
            }
            EndCondition::NotAKnot => {
                for (i, a) in [(0, 0), (n, n - 2)] {
                    let square = |h: &Float| Float::with_val(BITS, h.square_ref()).recip();
                    let (p, q) = (square(&h[a]), square(&h[a + 1]));
                    rows[i][a + 1] = Float::with_val(BITS, &p - &q);
                    let turned = -q;
                    rows[i][size] = sum(&[(&p, &delta[a]), (&turned, &delta[a + 1])]) * 2;
                    rows[i][a] = p;
                    rows[i][a + 2] = turned;
                }
            }
        }
        let mut s = eliminate(rows)?;
        if periodic {
            s.push(s[0].clone());
        }
        Some(Slopes { h, delta, y, x, s })
    }

    /// `S`, `S'`, `S''`, `S'''` and the integral from the left knot, on a segment.
    fn at(&self, i: usize, x: &Float) -> [Float; 5] {
        let (h, delta, a, b) = (&self.h[i], &self.delta[i], &self.s[i], &self.s[i + 1]);
        let both = with(a + b);
        let c = (with(delta * 3u32) - &both - a) / h;
        let d = (both - with(delta * 2u32)) / h / h;
        let u = with(x - &self.x[i]);
        let value = ((with(&d * &u) + &c) * &u + a) * &u + &self.y[i];
        let first = (with(&d * &u) * 3u32 + with(&c * 2u32)) * &u + a;
        let second = with(&d * &u) * 6u32 + with(&c * 2u32);
        let part = (((with(&d * &u) / 4u32 + with(&c / 3u32)) * &u + with(a / 2u32)) * &u
            + &self.y[i])
            * &u;
        [value, first, second, d * 6u32, part]
    }

    fn outputs(&self, queries: [&Float; 2], segments: &[usize]) -> Vec<Float> {
        let at = [0, 1].map(|k| self.at(segments[k], queries[k]));
        let mut integral = Float::with_val(BITS, &at[1][4] - &at[0][4]);
        let (lo, hi) = (segments[0].min(segments[1]), segments[0].max(segments[1]));
        for i in lo..hi {
            let [.., whole] = self.at(i, &self.x[i + 1]);
            if segments[0] < segments[1] {
                integral += whole;
            } else {
                integral -= whole;
            }
        }
        let mut out = Vec::new();
        for (k, [v, d, dd, ddd, _]) in at.into_iter().enumerate() {
            let i = if k == 0 {
                integral.clone()
            } else {
                -integral.clone()
            };
            out.extend([v, d, dd, ddd, i]);
        }
        out
    }
}

/// The conditions of the ten outputs: of a kind, at an input that begins with `x[n]`, `y[n]`.
pub(super) fn conditions(
    kind: EndCondition,
    input: &[f64],
    unpack: fn(&[Float]) -> Option<SplineProblem<'_, Float>>,
) -> Option<Vec<f64>> {
    let mut data: Vec<Float> = input.iter().map(|&v| float(v)).collect();
    let p = unpack(&data)?;
    let increasing = p.x.windows(2).all(|w| w[0] < w[1]);
    if p.x.len() < 2
        || !increasing
        || (kind == EndCondition::Periodic && p.y[0] != p.y[p.y.len() - 1])
    {
        return None;
    }
    let segment = |q: &Float| p.x[1..p.x.len() - 1].partition_point(|k| k <= q);
    let segments: Vec<usize> = p.queries.into_iter().map(segment).collect();
    let run = |data: &[Float]| -> Option<Vec<Float>> {
        let p = unpack(data)?;
        Some(Slopes::new(kind, p)?.outputs(p.queries, &segments))
    };
    let n = p.x.len();
    let base = run(&data)?;
    let mut total = vec![0.0; base.len()];
    let moved = float(1.0) + (float(1.0) >> STEP);
    for j in 0..data.len() {
        // The last ordinate of a periodic spline is the first one.
        if input[j] == 0.0 || (kind == EndCondition::Periodic && j == 2 * n - 1) {
            continue;
        }
        let old = data.clone();
        data[j] *= &moved;
        if kind == EndCondition::Periodic && j == n {
            data[2 * n - 1] = data[j].clone();
        }
        let shifted = run(&data)?;
        data = old;
        for ((t, a), b) in total.iter_mut().zip(&shifted).zip(&base) {
            let d = Float::with_val(64, a - b) << STEP;
            *t += d.to_f64().abs();
        }
    }
    Some(total)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn solved(rows: &[&[f64]]) -> Option<Vec<f64>> {
        let rows = rows.iter().map(|r| r.iter().map(|&v| float(v)).collect());
        let x = eliminate(rows.collect())?;
        Some(x.iter().map(Float::to_f64).collect())
    }

    #[test]
    fn elimination_takes_a_pivot_from_below() {
        let rows: [&[f64]; 3] = [
            &[0.0, 1.0, 1.0, 5.0],
            &[1.0, 0.0, 2.0, 7.0],
            &[2.0, 1.0, 0.0, 4.0],
        ];
        assert_eq!(solved(&rows), Some(vec![1.0, 2.0, 3.0]));
        assert_eq!(solved(&[&[0.0, 1.0, 5.0], &[0.0, 2.0, 7.0]]), None);
    }
}
