//! erfc from its value and slope at a centre:
//!
//! ```text
//! erfc(c + t) = erfc c − (2/√π) e^{−c²} t (1 + p),   1 + p = ∫₀¹ e^{us − vs²} ds
//!             = Σ_k (−v)^k/k! Σ_m u^m/(m! (m + 2k + 1)),   u = −2ct, v = t²
//! ```
//!
//! The formula has the terms of a few k and m, with stored coefficients. The same terms serve erfcx,
//! about centres of either sign:
//!
//! ```text
//! erfcx(c + t) = e^w (erfcx c − (2/√π) t (1 + p)),   w = 2ct + t²
//! ```
//!
//! with a polynomial for `e^w − 1`.

use crate::ProofError;
use crate::bounds::{above, exp_up, power_up, rational};
use crate::interval::{product_up, quotient_up, sum_up};
use mechaudit_reference::{Ball, faddeeva};
use mechaudit_solvers::faddeeva::proof::real_line as code;
use rug::Rational;
use rug::float::Round;

const BITS: u32 = 300;

/// Bounds of what value and slope at a centre are wrong by, and their sizes.
#[derive(Clone, Debug)]
pub(crate) struct ErfcRow {
    /// erfc c (hi, lo), and its slope; or erfcx c and −2/√π.
    pub row: [f64; 4],
    /// The centre; that of erfcx may be negative, −0 included.
    pub centre: f64,
    /// Tells whether it is erfcx.
    pub scaled: bool,
    errors: [f64; 2],
    sizes: [f64; 2],
}

impl ErfcRow {
    /// Of a row of erfc about a centre, or of erfcx if `scaled`.
    ///
    /// # Errors
    /// If the reference is undecided.
    pub fn new(scaled: bool, row: [f64; 4], centre: f64) -> Result<ErfcRow, ProofError> {
        let (c, zero) = (rational(centre), Rational::new());
        let slope = &Ball::integer(BITS, -2) / &Ball::pi(BITS).sqrt();
        let (value, slope) = match scaled {
            true => (faddeeva::erfcx(&c, &zero, BITS)?.re, slope),
            // Re w = e^{−c²}.
            false => (
                faddeeva::erfc(&c, &zero, BITS)?.re,
                &slope * &faddeeva::w(&c, &zero, BITS)?.re,
            ),
        };
        let off = |hi: f64, lo: f64, exact: &Ball| {
            above(&(&Ball::rational(4 * BITS, &(rational(hi) + rational(lo))) - exact))
        };
        Ok(ErfcRow {
            errors: [off(row[0], row[1], &value), off(row[2], row[3], &slope)],
            sizes: [above(&value), above(&slope)],
            row,
            centre,
            scaled,
        })
    }

    /// A bound of what the formula is wrong by for `|t|` up to `most`.
    pub fn within(&self, most: f64, terms: [&[f64]; 4]) -> f64 {
        let (u, v) = (
            product_up(2.0 * self.centre.abs(), most),
            product_up(most, most),
        );
        let [value, slope] = self.sizes;
        let of_slope = sum_up(
            product_up(self.errors[1], exp_up(u)),
            product_up(slope, terms_error(terms, u, v)),
        );
        let off = sum_up(self.errors[0], product_up(most, of_slope));
        if !self.scaled {
            return off;
        }
        // A (1 + q) in place of A e^w.
        let w = sum_up(u, v);
        let of_growth = growth_error(code::exponential_beside_one(), w);
        let size = sum_up(value, product_up(most, product_up(slope, exp_up(u))));
        sum_up(
            product_up(off, sum_up(exp_up(w), of_growth)),
            product_up(size, of_growth),
        )
    }
}

/// A bound of what the polynomial with these coefficients from w² on is wrong by as `e^w − 1`, for
/// |w| up to 1/2: the coefficients, and twice the first term that is left out.
fn growth_error(coefficients: &[f64], w: f64) -> f64 {
    if !(w <= 0.5) {
        return f64::INFINITY;
    }
    let mut exact = Rational::from(1);
    let mut error = 0.0;
    let next = coefficients.len() as u32 + 2;
    for n in 2..=next {
        exact /= n;
        let off = match coefficients.get(n as usize - 2) {
            Some(c) => (rational(*c) - &exact).abs(),
            None => exact.clone() * 2u32,
        };
        let off = rug::Float::with_val_round(53, &off, Round::Up).0.to_f64();
        error = sum_up(error, product_up(off, power_up(w, n)));
    }
    error
}

/// A bound of what p is wrong by for `|u| ≤ 1/2`, `v ≤ 1/2`: the coefficients, the terms in u that
/// are left out, less than twice the first of them, and those in v, less than twice `v⁴/(4! 9)` with
/// `e^{|u|}`.
pub(super) fn terms_error(terms: [&[f64]; 4], u: f64, v: f64) -> f64 {
    if !(u <= 0.5 && v <= 0.5) {
        return f64::INFINITY;
    }
    let mut error = 0.0;
    let mut factorial_of_k = Rational::from(1);
    for (k, stored) in terms.into_iter().enumerate() {
        if k > 1 {
            factorial_of_k *= k as u32;
        }
        let first = usize::from(k == 0);
        let mut factorial = factorial_of_k.clone();
        let mut of_k = 0.0;
        for m in 0..=first + stored.len() {
            if m > 1 {
                factorial *= m as u32;
            }
            let exact = Rational::from((&factorial * Rational::from(m + 2 * k + 1)).recip_ref());
            let off = match m.checked_sub(first).map(|at| stored.get(at)) {
                // One is not stored.
                None => continue,
                Some(Some(c)) => (rational(*c) - exact).abs(),
                Some(None) => exact * 2u32,
            };
            let off = rug::Float::with_val_round(53, &off, Round::Up).0.to_f64();
            of_k = sum_up(of_k, product_up(off, power_up(u, m as u32)));
        }
        error = sum_up(error, product_up(of_k, power_up(v, k as u32)));
    }
    let beyond = product_up(quotient_up(2.0, 216.0), power_up(v, 4));
    sum_up(error, product_up(beyond, exp_up(u)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The bound against the integral, by the terms as exact numbers.
    #[test]
    fn terms_that_are_left_out_count() {
        let terms = code::erfc_terms();
        let sound = terms_error(terms, 0.0625, 1.0 / 65536.0);
        assert!(sound < 5e-17, "{sound}");
        for k in 0..4 {
            let mut fewer = terms;
            fewer[k] = &terms[k][..terms[k].len() - 1];
            assert!(
                terms_error(fewer, 0.0625, 1.0 / 65536.0) > 1.5 * sound,
                "{k}"
            );
            let mut off = terms[k].to_vec();
            off[0] *= 3.0;
            let mut faulty = terms;
            faulty[k] = &off;
            assert!(
                terms_error(faulty, 0.0625, 1.0 / 65536.0) > 2.0 * sound,
                "{k}"
            );
        }
        // Where only v is not zero, the first term in v that is left out is the whole error.
        let (v, exact) = (0.5, 0.5f64.powi(4) / 216.0);
        let found = terms_error(terms, 0.0, v);
        assert!(found > exact && found < 3.0 * exact, "{found}");
        assert_eq!(terms_error(terms, 0.6, 0.0), f64::INFINITY);
        assert_eq!(terms_error(terms, 0.1, f64::NAN), f64::INFINITY);
    }

    #[test]
    fn value_and_slope_count() {
        let (row, centre) = code::erfc_row(1.0);
        let sound = ErfcRow::new(false, *row, centre).expect("decided");
        let terms = code::erfc_terms();
        assert_eq!(centre, 1.0);
        assert!(sound.errors[0] < 1e-30 && sound.errors[1] < 1e-30);
        assert!((sound.sizes[1] - 0.415_107_497_420_594_7).abs() < 1e-15);
        let most = 1.0 / 128.0;
        assert!(sound.within(most, terms) < 1e-18);
        for (at, due) in [(0, 1e-10), (1, 1e-10), (2, 1e-10 * most), (3, 1e-10 * most)] {
            let mut row = *row;
            row[at] += 1e-10;
            let faulty = ErfcRow::new(false, row, centre).expect("decided");
            let found = faulty.within(most, terms) / due;
            assert!((0.99..1.1).contains(&found), "{at} {found}");
        }
    }
    /// Of erfcx the polynomial of its exponential counts, too.
    #[test]
    fn growth_counts() {
        let coefficients = code::exponential_beside_one();
        let sound = growth_error(coefficients, 0.0626);
        assert!(sound < 1e-18, "{sound}");
        assert!(growth_error(&coefficients[..7], 0.0626) > 30.0 * sound);
        let mut off = coefficients.to_vec();
        off[1] += 1e-12;
        assert!(growth_error(&off, 0.0626) > 100.0 * sound);
        assert_eq!(growth_error(coefficients, f64::NAN), f64::INFINITY);
        let [slope, slope_low] = code::constants()[0].map(|c| -c);
        let within = |x: f64, changed: fn(f64) -> f64, most| {
            let [_, _, hi, lo] = *code::erfcx_row(x);
            let row = ErfcRow::new(true, [changed(hi), lo, slope, slope_low], -x).expect("decided");
            row.within(most, code::erfc_terms())
        };
        let most = 1.0 / 256.0;
        assert!(within(1.0, |hi| hi, most) < 1e-17);
        // A unit in the last place of erfcx −1, and more.
        let off = within(1.0, f64::next_up, most) / f64::EPSILON;
        assert!(off > 4.0 * 1.007, "{off}");
        // erfcx −4 is above 1.77e7.
        let off = within(4.0, |hi| hi, 1.0 / 64.0);
        assert!(off > 1.77e7 * growth_error(coefficients, 0.125), "{off}");
    }
}
