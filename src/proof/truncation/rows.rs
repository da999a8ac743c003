//! Taylor rows: the stored coefficients against certified ones, and what follows the last of them.
//!
//! With `c_n` the coefficients of w at the centre, `c̃_n` the stored ones (n < 18, or fewer of a
//! function on an axis), `|δ| ≤ D`:
//!
//! ```text
//! |p(δ) − w| ≤ Σ_{n<18} |c̃_n − c_n| Dⁿ + Σ_{n=18}^{40} |c_n| Dⁿ + Σ_{n>40} M (D/ρ)ⁿ
//! ```
//!
//! by Cauchy's estimate on the circle ρ = 3 about the centre: `|w(z)| ≤ erfcx(Im z)` (the integral
//! `(2/√π)∫₀^∞ e^{−t²+2izt}dt` with the absolute value inside), which is at most `2e^{(Im z)²}`
//! below the axis, so that with a centre on or above the axis `M = 2e⁹`, and with one down to
//! `Im z = −1` below it `M = 2e¹⁶`.

use super::Truncation;
use crate::ProofError;
use crate::bounds::{above, power_up, rational};
use crate::interval::{hypot_up, product_up, quotient_up, sum_up};
use mechaudit_reference::{Ball, ComplexBall, faddeeva};
use mechaudit_solvers::faddeeva::proof::Row;
use rug::Rational;

const BITS: u32 = 300;
const STORED: usize = 18;
const TERMS: usize = 41;
const RADIUS: f64 = 3.0;
/// Above `2e⁹`, and `2e¹⁶`.
const MOST: [f64; 2] = [16207.0, 1.78e7];

/// Bounds of the components of what each coefficient of the formula is wrong by.
#[derive(Clone, Debug)]
pub(crate) struct RowErrors {
    /// The centre.
    pub centre: (f64, f64),
    parts: Vec<[f64; 2]>,
}

/// `stored − exact`.
fn difference(stored: [f64; 2], exact: &Ball) -> f64 {
    let sum = rational(stored[0]) + rational(stored[1]);
    above(&(&Ball::rational(4 * BITS, &sum) - exact))
}

/// Places of a coefficient's parts in a row: real, its low part, imaginary, its low part.
fn places(n: usize) -> [Option<usize>; 4] {
    match n {
        0 => [0, 1, 2, 3].map(Some),
        1 => [4, 5, 6, 7].map(Some),
        _ => {
            let at = 8 + 8 * ((n - 2) / 4) + (n - 2) % 4;
            [Some(at), None, Some(at + 4), None]
        }
    }
}

/// The stored coefficient as the formula takes it: high and low parts, real and imaginary.
fn stored(row: &Row, n: usize) -> [[f64; 2]; 2] {
    let [p, q, r, s] = places(n).map(|at| at.map_or(0.0, |at| row[at]));
    [[p, q], [r, s]]
}

impl RowErrors {
    /// Of a row about a centre with `Im z ≥ −1`.
    ///
    /// # Errors
    /// If the reference is undecided, or the centre lies below.
    pub fn of(row: &Row, centre: (f64, f64)) -> Result<RowErrors, ProofError> {
        if !(centre.1 >= -1.0) {
            return Err("a centre too far below the axis".into());
        }
        let c = certified(centre)?;
        let parts = c.iter().enumerate().map(|(n, c)| match n < STORED {
            true => {
                let [re, im] = stored(row, n);
                [difference(re, &c.re), difference(im, &c.im)]
            }
            false => [above(&c.re), above(&c.im)],
        });
        let parts = parts.collect();
        Ok(RowErrors { centre, parts })
    }

    /// Of a row of erfcx about `s` on the imaginary axis; `erfcx(s + t) = Σ iⁿ c_n tⁿ`.
    ///
    /// # Errors
    /// If the reference is undecided.
    pub fn on_axis(row: &[f64], s: f64) -> Result<RowErrors, ProofError> {
        RowErrors::of_real(row, (0.0, s), |n, c| match n % 4 {
            0 => c.re.clone(),
            1 => -c.im.clone(),
            2 => -c.re.clone(),
            _ => c.im.clone(),
        })
    }

    /// Of a row of `(2/√π) F` about `t` on the real axis, F Dawson's function: the imaginary parts.
    ///
    /// # Errors
    /// If the reference is undecided.
    pub fn of_dawson(row: &[f64], t: f64) -> Result<RowErrors, ProofError> {
        RowErrors::of_real(row, (t, 0.0), |_, c| c.im.clone())
    }

    /// Of a row of erf about `t` on the real axis, where `Re w = e^{−x²}`: with the coefficients
    /// `c_n` of w those of erf are erf t and `(2/√π) Re c_{n−1}/n`. Beyond the last one they are
    /// less than `(2/√π) M ρ^{1−n}/41`, which is less than `M ρ^{−n}`.
    ///
    /// # Errors
    /// If the reference is undecided.
    pub fn of_erf(row: &[f64], t: f64) -> Result<RowErrors, ProofError> {
        let value = faddeeva::erf(&rational(t), &Rational::new(), BITS)?.re;
        let factor = &Ball::integer(BITS, 2) / &Ball::pi(BITS).sqrt();
        let c = certified((t, 0.0))?;
        let all = (0..c.len()).map(|n| match n {
            0 => value.clone(),
            _ => &(&factor * &c[n - 1].re) / &Ball::integer(BITS, n as i64),
        });
        Ok(RowErrors::of_balls(row, (t, 0.0), all))
    }

    fn of_real(
        row: &[f64],
        centre: (f64, f64),
        real: impl Fn(usize, &ComplexBall) -> Ball,
    ) -> Result<RowErrors, ProofError> {
        let c = certified(centre)?;
        let all = c.iter().enumerate().map(|(n, c)| real(n, c));
        Ok(RowErrors::of_balls(row, centre, all))
    }

    /// From the exact coefficients.
    fn of_balls(row: &[f64], centre: (f64, f64), exact: impl Iterator<Item = Ball>) -> RowErrors {
        let parts = exact.enumerate().map(|(n, real)| match n {
            0 | 1 => [difference([row[2 * n], row[2 * n + 1]], &real), 0.0],
            _ if n + 2 < row.len() => [difference([row[n + 2], 0.0], &real), 0.0],
            _ => [above(&real), 0.0],
        });
        let parts = parts.collect();
        RowErrors { centre, parts }
    }

    /// For `|Re δ| ≤ dx`, `|Im δ| ≤ dy`.
    ///
    /// The real part about a real centre: `Re Σ e_n δⁿ` is at most
    /// `Σ |Re e_n| Dⁿ + dy Σ n |Im e_n| D^{n−1}`, since `|Im δⁿ| ≤ n |Im δ| |δ|^{n−1}`. The
    /// imaginary part about a centre on the imaginary axis, where `iⁿ e_n` is real, divided by
    /// `Re δ`: at most `Σ n |e_n| D^{n−1}`, by the same for `−iδ`.
    pub fn within(&self, dx: f64, dy: f64) -> Truncation {
        let d = hypot_up(dx, dy);
        if !(d <= 1.0) {
            return Truncation::all(f64::INFINITY);
        }
        let (mut norm, mut re, mut im) = (0.0, 0.0, 0.0);
        let (mut power, mut before) = (1.0, 0.0);
        for (n, e) in self.parts.iter().enumerate() {
            let size = hypot_up(e[0], e[1]);
            let slope = product_up(n as f64, before);
            norm = sum_up(norm, product_up(size, power));
            let turned = product_up(dy, product_up(e[1], slope));
            re = sum_up(re, sum_up(product_up(e[0], power), turned));
            im = sum_up(im, product_up(size, slope));
            before = power;
            power = product_up(power, d);
        }
        let tail = tail(d, MOST[usize::from(self.centre.1 < 0.0)]);
        norm = sum_up(norm, tail);
        re = sum_up(re, tail);
        im = sum_up(im, tail);
        let (on_real, on_imaginary) = (self.centre.1 == 0.0, self.centre.0 == 0.0);
        Truncation {
            re: if on_real { re } else { norm },
            im: if on_imaginary { im } else { norm },
            ..Truncation::all(norm)
        }
    }

    /// Returns whether the components that are zero by symmetry about a centre on the imaginary
    /// axis are exactly zero.
    pub fn is_symmetric(&self) -> bool {
        self.centre.0 == 0.0
            && self.parts.iter().enumerate().all(|(n, e)| match n % 2 {
                0 => e[1] == 0.0,
                _ => e[0] == 0.0,
            })
    }
}

/// `Σ_{n>40} n q^{n−1} ≤ 41 q⁴⁰/(1 − q)² ≤ 100 q⁴⁰`, `q = D/ρ ≤ 1/3`, times M; the sum without n is
/// less.
fn tail(d: f64, most: f64) -> f64 {
    let q = quotient_up(d, RADIUS);
    product_up(100.0 * most, power_up(q, TERMS as u32 - 1))
}

fn certified(centre: (f64, f64)) -> Result<Vec<ComplexBall>, ProofError> {
    faddeeva::taylor(&rational(centre.0), &rational(centre.1), TERMS - 1, BITS)
        .map_err(ProofError::from)
}

#[cfg(test)]
mod tests;
