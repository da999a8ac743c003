//! Numbers of functions on the real axis: their values at centres of rows, and polynomials for the
//! asymptotic series.
//!
//! The sums `a₁ + a₂v + …` and `3a₁ + 5a₂v + …`, `a_n = (2n − 1)!!/2ⁿ`, for `0 ≤ v ≤ 1/79`, with
//! `v = 1/x²`: Taylor sums of more terms than are needed, from which Chebyshev polynomials of that
//! interval are subtracted one after the other (Lanczos, *Applied Analysis*, 1956, VII.8), all with
//! exact rational numbers. What is left out is at most the sum of the factors subtracted.

use super::{Tables, decided, nearest, parts};
use crate::cli::files::artefact::{MakeError, Outcome};
use mechaudit::reference::{Ball, faddeeva};
use rug::Rational;
use std::fmt::Write as _;

/// Terms of the sums, and of the polynomials.
const SUM: usize = 24;
const KEPT: usize = 10;
/// The interval ends at one part of this many.
const PER: i64 = 79;

/// `a_{k+1}`, times `2k + 3` if wanted.
fn coefficients(slope: bool) -> Vec<Rational> {
    let mut a = Rational::from(1);
    (0..SUM)
        .map(|k| {
            a *= Rational::from((2 * k as i64 + 1, 2));
            let factor = if slope { 2 * k as i64 + 3 } else { 1 };
            &a * Rational::from(factor)
        })
        .collect()
}

/// The Chebyshev polynomial `T_n(2v/V − 1)` in powers of v, `V = 1/PER`, n ≥ 1.
fn chebyshev(n: usize) -> Vec<Rational> {
    let mut before = vec![Rational::from(1)];
    let mut here = vec![Rational::from(-1), Rational::from(2 * PER)];
    for _ in 1..n {
        // T_{k+1} = 2 (2v/V − 1) T_k − T_{k−1}.
        let mut next = vec![Rational::new(); here.len() + 1];
        for (k, c) in here.iter().enumerate() {
            next[k + 1] += c * Rational::from(4 * PER);
            next[k] -= c * Rational::from(2);
        }
        for (k, c) in before.iter().enumerate() {
            next[k] -= c;
        }
        before = std::mem::replace(&mut here, next);
    }
    here
}

/// The shortened polynomial, and the most it differs from the sum.
fn shortened(slope: bool) -> (Vec<Rational>, Rational) {
    let mut c = coefficients(slope);
    let mut off = Rational::new();
    while c.len() > KEPT {
        let top = c.len() - 1;
        let t = chebyshev(top);
        let factor = Rational::from(&c[top] / &t[top]);
        for (c, t) in c.iter_mut().zip(&t) {
            *c -= Rational::from(&factor * t);
        }
        c.truncate(top);
        off += factor.abs();
    }
    (c, off)
}

/// Refuses a sum of which too much is left out: v times it stands beside 1.
fn negligible(off: &Rational) -> Result<(), MakeError> {
    match Rational::from(off / PER).to_f64() {
        part if part > 2f64.powi(-56) => Err(MakeError::LeftOut(part)),
        _ => Ok(()),
    }
}

pub fn polynomials(tables: &mut Tables) -> Outcome<()> {
    tables.depends_on(&format!("v <= 1/{PER}, {KEPT} of {SUM} terms"));
    tables.open(
        "The sums `a₁ + a₂v + …` and `3a₁ + 5a₂v + …`, `a_n = (2n − 1)!!/2ⁿ`, as polynomials for\n\
         `0 ≤ v ≤ 1/79`.",
        "REAL_LINE",
        &format!("[[f64; {KEPT}]; 2]"),
    );
    for slope in [false, true] {
        let (c, off) = shortened(slope);
        let row = decided("a polynomial", |bits| {
            let row: Option<Vec<f64>> = c
                .iter()
                .map(|c| nearest(&Ball::rational(bits, c)))
                .collect();
            Ok(row)
        })?;
        negligible(&off)?;
        let _ = writeln!(tables.text, "    {row:?},");
    }
    tables.close();
    Ok(())
}

/// The last of the centres, where the asymptotic series of erfcx has few terms, in units of one part
/// of this many.
const VALUES: (i64, i64) = (169, 16);

/// The values that the rows of erf, erfc, erfcx and Dawson's function begin with.
pub fn values(tables: &mut Tables) -> Outcome<()> {
    let (last, per) = VALUES;
    tables.open(
        &format!(
            "`e^{{−c²}}`, `erfcx c` and `(2/√π) F(c)`, F Dawson's function, each in two parts, at\n\
             `c = 0, 1/{per}, … {last}/{per}`."
        ),
        "ON_THE_AXIS",
        &format!("[[f64; 6]; {}]", last + 1),
    );
    let zero = Rational::new();
    for k in 0..=last {
        let c = Rational::from((k, per));
        let row = decided(&format!("the values at {c}"), |bits| {
            let w = faddeeva::w(&c, &zero, bits)?;
            let erfcx = faddeeva::w(&zero, &c, bits)?.re;
            let pairs = [&w.re, &erfcx, &w.im].map(parts::<2>);
            Ok(pairs.into_iter().collect::<Option<Vec<_>>>())
        })?;
        let _ = writeln!(tables.text, "    {:?},", row.concat());
    }
    tables.close();
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `a_1 = 1/2, a_2 = 3/4, a_3 = 15/8`, times 3, 5, 7 for the slope.
    #[test]
    fn coefficients_are_those_of_the_series() {
        for (slope, due) in [
            (false, [(1, 2), (3, 4), (15, 8), (105, 16)]),
            (true, [(3, 2), (15, 4), (105, 8), (945, 16)]),
        ] {
            let found = coefficients(slope);
            assert_eq!(found.len(), SUM);
            assert_eq!(found[..4], due.map(Rational::from), "{slope}");
        }
    }

    /// T_1 = u, T_2 = 2 u² − 1, T_3 = 4 u³ − 3 u of u = 2 · 79 v − 1.
    #[test]
    fn chebyshev_polynomials_are_shifted() {
        for v in [(0, 1), (1, 79), (1, 158), (1, 79 * 3)] {
            let v = Rational::from(v);
            let u = Rational::from(&v * 158) - 1;
            let at = |n: usize| {
                let c = chebyshev(n);
                assert_eq!(c.len(), n + 1);
                c.iter().rev().fold(Rational::new(), |sum, c| sum * &v + c)
            };
            let square = Rational::from(&u * &u);
            assert_eq!(at(1), u);
            assert_eq!(at(2), Rational::from(&square * 2) - 1);
            assert_eq!(at(3), (Rational::from(&square * 4) - 3u32) * &u);
        }
    }

    /// The polynomial is as far from the sum as it says, and no farther.
    #[test]
    fn what_is_left_out_is_bounded() {
        for slope in [false, true] {
            let (c, off) = shortened(slope);
            let sum = coefficients(slope);
            assert_eq!(c.len(), KEPT);
            let at = |c: &[Rational], v: &Rational| {
                c.iter().rev().fold(Rational::new(), |sum, c| sum * v + c)
            };
            let mut most = Rational::new();
            for k in 0..=40 {
                let v = Rational::from((k, 40 * PER));
                let apart = (at(&c, &v) - at(&sum, &v)).abs();
                assert!(apart <= off, "{k}");
                most = most.max(apart);
            }
            assert!(most > off / 4u32);
        }
    }

    #[test]
    fn an_eighth_of_the_last_place_is_left_out_at_most() {
        let most = Rational::from(PER) >> 56u32;
        assert!(negligible(&most).is_ok());
        let more = most * Rational::from((1_000_001, 1_000_000));
        assert!(matches!(negligible(&more), Err(MakeError::LeftOut(_))));
    }
}
