//! The linearised flow of a step: `Φ′ = h J Φ`, `Φ(0) = I`, for every matrix function J within the
//! enclosure of the Jacobian, as a polynomial with double coefficients and a bound on its error.
//!
//! The bound is that of a differential inequality: with `|h J_ij| ≤ M_ij`, for i = j `h J_ii ≤ M_ii`, and
//! `M_ij ≥ 0`, a function with `e′ = h J e + d` satisfies `|e_i|′ ≤ Σ M_ij |e_j| + |d_i|`, and so `|e| ≤ exp(M)
//! (|e(0)| + max |d|)` over `0 ≤ τ ≤ 1` (Walter, *Ordinary Differential Equations*, 1998, §10.XII: M is
//! quasi-monotone).
//!
//! With `h J = A + δ`, A a polynomial and `|δ_ij| ≤ ρ_ij`, the polynomial P has the error `e = Φ −
//! P` with `e′ = A e + δ Φ + (A P − P′)`, and also `e′ = (A + δ) e + δ P + (A P − P′)`: entry by
//! entry the smaller bound of `|Φ| ≤ exp(M)` and of `|P|` serves. Where the motion contracts fast,
//! P has terms far larger than itself.

use super::coefficient::Coefficient;
use super::enclosed::{Enclosed, exponential_above, gamma, up};
use super::expansion::{Expansion, Obstacle};
use super::remainder::Remainders;
use super::{Field, Program};
use crate::{Ball, Mag};
use rug::Float;

/// An entry of the Jacobian over a step, times the length of the step.
struct Entry {
    row: usize,
    column: usize,
    terms: Vec<f64>,
    radius: f64,
}

/// The linearised flow of a step as a function of `0 ≤ τ ≤ 1`.
#[derive(Clone, Debug)]
pub(super) struct Flow {
    n: usize,
    /// The coefficients, order by order.
    terms: Vec<Vec<f64>>,
    /// The error of the polynomial.
    error: Vec<f64>,
    /// The part of it that comes from terms that are left out and from rounding, not from the width
    /// of the Jacobian.
    truncation: Vec<f64>,
    /// The exponential of the majorant.
    growth: Vec<f64>,
    /// The largest sum of magnitudes in a row of the Jacobian times the length of the step.
    norm: f64,
}

/// The polynomials of the states over a step, in the variable `τ = s/h`.
pub(super) struct Scaled {
    /// Coefficients by states.
    pub terms: Vec<Vec<f64>>,
    /// The remainders.
    pub radii: Vec<Mag>,
}

impl Scaled {
    /// The terms up to an order of polynomials in s, for the length h of a step; those above the
    /// degree are zero.
    pub fn new(p: &[Vec<Float>], h: f64, order: usize) -> Scaled {
        const BITS: u32 = 64;
        let powers = super::remainder::powers(Mag::from_f64(h), p[0].len());
        let mut power = Float::with_val(BITS, 1);
        let mut terms = vec![vec![0.0; order + 1]; p.len()];
        let top = order.min(p[0].len() - 1);
        for k in 0..=top {
            for (terms, p) in terms.iter_mut().zip(p) {
                terms[k] = Float::with_val(BITS, &p[k] * &power).to_f64();
            }
            power *= h;
        }
        // The power is rounded k times to 64 bits, and so is the product; then it is rounded to 53
        // bits.
        let radius = |p: &Vec<Float>| {
            let size = |k: usize| Mag::above(&p[k]).mul(powers[k]);
            let kept = (0..=top).fold(Mag::ZERO, |sum, k| sum.add(size(k)));
            let left = (top + 1..p.len()).fold(Mag::ZERO, |sum, k| sum.add(size(k)));
            left.add(kept.shift(-52)).add(f64::least())
        };
        Scaled {
            radii: p.iter().map(radius).collect(),
            terms,
        }
    }
}

/// Upper bounds `|c_k|`, and their sums from k on.
fn tails(terms: impl DoubleEndedIterator<Item = f64> + ExactSizeIterator) -> Vec<f64> {
    let mut sums = vec![0.0; terms.len() + 1];
    for (k, x) in terms.enumerate().rev() {
        sums[k] = up(sums[k + 1] + x.abs());
    }
    sums
}

/// Terms without those at the end that are small beside the others, and the sum of their
/// magnitudes.
pub(super) fn without_tail(mut terms: Vec<f64>) -> (Vec<f64>, f64) {
    /// A share beside which a double number's rounding is not small.
    const SHARE: f64 = f64::EPSILON / 8.0;
    let sums = tails(terms.iter().copied());
    let kept = sums.iter().position(|sum| *sum <= SHARE * sums[0]);
    // A sum that is no number is kept as it is.
    let kept = kept.unwrap_or(terms.len()).max(1).min(terms.len());
    terms.truncate(kept);
    (terms, sums[kept])
}

impl Flow {
    /// The flow of a step of length h from a time, whose states are within `tubes` of the
    /// polynomials.
    ///
    /// # Errors
    /// An entry of the Jacobian without a bound.
    pub fn new(
        field: &Field,
        constants: &[Ball],
        (time, h): (&Ball, f64),
        states: &Scaled,
        tubes: &[Mag],
        weights: &[f64],
    ) -> Result<Flow, Obstacle> {
        let (program, entries) = (&field.jacobian, &field.entries);
        let order = states.terms[0].len() - 1;
        let expansion = expand(program, constants, (time, h), states)?;
        let tubes: Vec<Mag> = tubes
            .iter()
            .zip(&states.radii)
            .map(|(tube, radius)| tube.add(*radius))
            .collect();
        let bounds = Remainders::new(&expansion, Mag::power_of_two(0), &tubes)?;
        let n = field.dimension();
        let mut majorant = vec![0.0; n * n];
        let mut scaled = Vec::with_capacity(entries.len());
        for (row, column, slot) in entries {
            let terms: Vec<f64> = expansion.coefficients[*slot]
                .iter()
                .map(|c| c * h)
                .collect();
            // One rounding a term, and what is left out.
            let size = bounds.norm(*slot).to_f64() * h.abs();
            let (terms, rest) = without_tail(terms);
            let radius = bounds.radius(*slot).to_f64() * h.abs() + size * f64::EPSILON;
            let radius = up(radius + rest);
            let upper = match row == column {
                true => {
                    let rounding = size * 4.0 * f64::EPSILON;
                    terms[0] + tails(terms[1..].iter().copied())[0] + radius + rounding
                }
                false => size + radius,
            };
            majorant[row * n + column] = match upper.is_finite() {
                true => up(upper.max(0.0)),
                // The larger of NaN and zero would be zero.
                false => f64::INFINITY,
            };
            scaled.push(Entry {
                row: *row,
                column: *column,
                terms,
                radius,
            });
        }
        let growth = exponential_above(&majorant, weights);
        let mut rows = vec![0.0; n];
        for e in &scaled {
            let size = e.terms.iter().fold(0.0, |sum, c| sum + c.abs());
            rows[e.row] += size * weights[e.column] / weights[e.row];
        }
        let norm = rows.into_iter().fold(0.0, f64::max);
        Ok(Flow::of_entries(n, scaled, (growth, norm), order))
    }

    /// The polynomial up to an order, and its error.
    fn of_entries(
        n: usize,
        entries: Vec<Entry>,
        (growth, norm): (Vec<f64>, f64),
        order: usize,
    ) -> Flow {
        let mut identity = vec![0.0; n * n];
        (0..n).for_each(|i| identity[i * n + i] = 1.0);
        let mut terms = vec![identity];
        for k in 0..order {
            let mut next = vec![0.0; n * n];
            for e in &entries {
                for (l, c) in e.terms.iter().enumerate().take(k + 1) {
                    if *c == 0.0 {
                        continue;
                    }
                    let from = &terms[k - l][e.column * n..(e.column + 1) * n];
                    let to = &mut next[e.row * n..(e.row + 1) * n];
                    to.iter_mut()
                        .zip(from)
                        .for_each(|(to, from)| *to += c * from);
                }
            }
            next.iter_mut().for_each(|x| *x /= (k + 1) as f64);
            terms.push(next);
        }
        // The defect Φ′ − h J Φ of the polynomial.
        let sizes: Vec<Vec<f64>> = (0..n * n)
            .map(|e| tails(terms.iter().map(|terms| terms[e])))
            .collect();
        let mut longest = vec![0; n];
        entries.iter().for_each(|e| longest[e.row] += e.terms.len());
        let (mut cut, mut wide) = (vec![0.0; n * n], vec![0.0; n * n]);
        for e in &entries {
            let norms = tails(e.terms.iter().copied());
            let rounded = norms[0] * gamma(longest[e.row] + 3);
            for j in 0..n {
                let tails = &sizes[e.column * n + j];
                let mut sum = rounded * tails[0];
                for (l, c) in e.terms.iter().enumerate() {
                    // Powers of τ from `order` on are left out.
                    sum += c.abs() * tails.get(order.saturating_sub(l)).copied().unwrap_or(0.0);
                }
                cut[e.row * n + j] += up(sum);
                wide[e.row * n + j] += e.radius * tails[0].min(growth[e.column * n + j]);
            }
        }
        let grown = |defect: &[f64]| -> Vec<f64> {
            let mut error = vec![0.0; n * n];
            for i in 0..n {
                for k in 0..n {
                    let g = growth[i * n + k];
                    for j in 0..n {
                        error[i * n + j] += g * defect[k * n + j];
                    }
                }
            }
            error.into_iter().map(up).collect()
        };
        let truncation = grown(&cut);
        let error = truncation
            .iter()
            .zip(grown(&wide))
            .map(|(cut, wide)| up(cut + wide))
            .collect();
        Flow {
            n,
            terms,
            error,
            truncation,
            growth,
            norm,
        }
    }

    /// The order at which the terms of `exp(x)` are below a share of 1, for x the size of the
    /// Jacobian over the step.
    pub fn order_for(&self, share: f64) -> usize {
        let mut term = 1.0;
        let mut k = 0;
        while term > share && k < 1000 {
            k += 1;
            term *= self.norm / k as f64;
        }
        k
    }

    /// `exp(M) x`: a bound over the whole step on errors that begin with x, or are driven by x.
    pub fn growth(&self, x: &[Mag]) -> Vec<Mag> {
        let row = |i: usize| {
            let row = self.growth[i * self.n..(i + 1) * self.n].iter().zip(x);
            row.fold(Mag::ZERO, |sum, (g, x)| sum.add(Mag::from_f64(*g).mul(*x)))
        };
        (0..self.n).map(row).collect()
    }

    /// The largest error by terms that are left out and by rounding, relative to the largest entry
    /// at the end, both in the sizes of the coordinates.
    pub fn truncation(&self, weights: &[f64]) -> f64 {
        let n = self.n;
        let weighted = |x: &[f64]| {
            let entries = (0..n * n).map(|k| x[k].abs() * weights[k % n] / weights[k / n]);
            entries.fold(0.0, |m: f64, x| if x.is_nan() { x } else { m.max(x) })
        };
        weighted(&self.truncation) / weighted(&self.at(1.0, 0.0).mid).max(1.0)
    }

    /// The flow at τ, which is given as a double number and a bound on its error. The polynomial's
    /// own error grows from zero by at most its bound in a unit of τ.
    pub fn at(&self, tau: f64, off: f64) -> Enclosed {
        let n = self.n;
        let order = self.terms.len() - 1;
        let (mut mid, mut size) = (vec![0.0; n * n], vec![0.0; n * n]);
        let mut slope = vec![0.0; n * n];
        for (k, terms) in self.terms.iter().enumerate().rev() {
            for e in 0..n * n {
                mid[e] = mid[e] * tau + terms[e];
                size[e] = size[e] * tau + terms[e].abs();
                slope[e] += k as f64 * terms[e].abs();
            }
        }
        let rounding = gamma(2 * order + 2);
        let rad = (0..n * n)
            .map(|e| up(self.error[e] * (tau + off) + size[e] * rounding + slope[e] * off))
            .collect();
        Enclosed { n, mid, rad }
    }
}

/// The expansion of the Jacobian's program in the variable τ.
fn expand<'p>(
    program: &'p Program,
    constants: &[Ball],
    (time, h): (&Ball, f64),
    states: &Scaled,
) -> Result<Expansion<'p, f64>, Obstacle> {
    let mut expansion = Expansion::new(program, f64::MANTISSA_DIGITS);
    let at = |k: usize| -> Vec<f64> { states.terms.iter().map(|terms| terms[k]).collect() };
    expansion.begin(constants, time, &at(0))?;
    for k in 1..states.terms[0].len() {
        expansion.advance(&at(k), &h);
    }
    Ok(expansion)
}
