//! Sums of hypergeometric terms in fixed-point arithmetic.
//!
//! # Sum
//! `Σ_{k<n} t_k` with `t_0 = 1`, `t_{k+1} = t_k w a_k/b_k`, integers a_k and b_k > 0. The terms of
//! the same k mod 4 are added up by themselves: `Σ i^{mk} t_k` is the sum at `i^m w`.
//!
//! # Error
//! Both parts of every number are integers that count `u = 2^-bits`. A product loses less than u in
//! each part, and so does a quotient. If e bounds the error of t_k and e_w that of w, then t_{k+1}
//! is off by at most `(|ŵ| e + (|t̂| + e) e_w + √2 u) |a_k|/b_k + √2 u`, and the sum by the sum of
//! these bounds.
//!
//! # Remainder
//! Where `|w a_k|/b_k` does not increase from some k on and is at most 1/2, what is omitted is at
//! most twice the first omitted term. For an asymptotic series the caller multiplies that term by
//! the factor of its theorem.

use super::super::support::WIDE;
use super::super::{ComplexEvaluated, NoValue};
use crate::{Ball, ComplexBall, Mag};
use rug::{Assign, Float, Integer};

/// The kind of a series, by which it ends.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// The quotients of its terms do not increase in modulus.
    Convergent,
    /// Its terms decrease and then increase: it ends before they do.
    Asymptotic,
}

/// The sums of terms of the same number modulo 4.
pub(super) struct Sum {
    parts: [ComplexBall; 4],
    /// A bound on the modulus of the first omitted term.
    pub next: Mag,
    /// The number of terms.
    pub terms: u64,
}

impl Sum {
    /// The sum at `i^m w`, without what was omitted.
    pub fn at(&self, m: usize) -> ComplexBall {
        let [a, b, c, d] = &self.parts;
        let odd = [b - d, (b - d).turned(), d - b, (d - b).turned()];
        match m % 4 {
            0 | 2 => {
                let (even, odd) = (a + c, b + d);
                if m.is_multiple_of(4) {
                    &even + &odd
                } else {
                    &even - &odd
                }
            }
            m => &(a - c) + &odd[m],
        }
    }
}

/// Terms of a sum at most.
const MOST: u64 = 1 << 17;

/// A bound on the modulus of a number of these parts, in units of `2^-bits`.
fn size([re, im]: &[Integer; 2], bits: i64) -> Mag {
    let longest = i64::from(re.significant_bits().max(im.significant_bits()));
    let longest = Mag::power_of_two(longest - bits);
    match im.is_zero() || re.is_zero() {
        true => longest,
        false => longest.mul(Mag::from_f64(DIAGONAL)),
    }
}

/// Above √2.
const DIAGONAL: f64 = 1.41421357;

/// More than rounding may have taken from a quotient of two integers and a product with it.
const ROUNDING: f64 = 1.0 + 1e-15;

/// The sum with `bits` binary places. Errors are counted in units of the last place.
pub(super) fn sum(
    w: &ComplexBall,
    bits: u32,
    kind: Kind,
    ratio: impl Fn(u64) -> (i64, u64),
) -> Result<Sum, NoValue> {
    let places = i64::from(bits);
    let fixed = |x: &Ball| -> Option<Integer> {
        let scaled = Float::with_val(x.prec(), x.mid() << bits);
        scaled.to_integer()
    };
    if !w.is_finite() || w.magnitude() > Mag::power_of_two(1 << 20) {
        return Err(WIDE);
    }
    let (Some(p), Some(q)) = (fixed(&w.re), fixed(&w.im)) else {
        return Err(WIDE);
    };
    let is_real = q.is_zero() && w.im.is_zero();
    // Rounded to nearest, each part by half a unit at most.
    let off = w.radius().shift(places).add(Mag::power_of_two(0));
    let unit = Mag::power_of_two(-places);
    let reach = w.magnitude().to_f64();
    let about = w.magnitude().add(unit);
    let step = Mag::from_f64(DIAGONAL);
    let mut t = [Integer::from(1) << bits, Integer::new()];
    let mut other = Integer::new();
    let mut parts: [[Integer; 2]; 4] = Default::default();
    let (mut error, mut total, mut k) = (Mag::ZERO, Mag::ZERO, 0_u64);
    loop {
        for (sum, part) in parts[k as usize % 4].iter_mut().zip(&t) {
            *sum += part;
        }
        total = total.add(error);
        let (a, b) = ratio(k);
        let quotient = a.unsigned_abs() as f64 / b as f64 * ROUNDING;
        let factor = Mag::from_f64(quotient);
        let turned = size(&t, places).add(error.mul(unit)).mul(off);
        error = about.mul(error).add(turned).add(step).mul(factor).add(step);
        if is_real {
            t[0] *= &p;
        } else {
            let [re, im] = &mut t;
            // (p + iq)(re + i im)
            other.assign(&*re * &q);
            *re *= &p;
            *re -= &*im * &q;
            *im *= &p;
            *im += &other;
        }
        // A negative number that is shifted out stays −1, and its multiples by `a` grow.
        let mut has_vanished = true;
        for part in &mut t {
            *part >>= bits;
            has_vanished &= part.significant_bits() <= 1;
            if a != 1 {
                *part *= a;
            }
            *part /= b;
        }
        k += 1;
        let quotient = reach * quotient;
        let is_small = t.iter().all(|part| part.significant_bits() <= 4);
        let ends = match kind {
            Kind::Convergent => is_small && quotient <= 0.5,
            Kind::Asymptotic => is_small || has_vanished || (quotient >= 1.0 && k > 1),
        };
        if ends {
            break;
        }
        if k >= MOST {
            return Err(NoValue::Undecided("a series takes too many terms"));
        }
    }
    let longest = t[0].significant_bits().max(t[1].significant_bits());
    let next = error.add(step.shift(longest.into())).shift(-places);
    let total = total.shift(-places);
    let ball = |x: &Integer| {
        let exact = Float::with_val(x.significant_bits().max(bits), x);
        Ball::new(exact >> bits, Mag::ZERO)
    };
    // The parts share the error: each holds all of it.
    let of = |[re, im]: &[Integer; 2]| {
        let z = ComplexBall::new(ball(re), ball(im));
        let wide = z.re.widened(total);
        ComplexBall::new(wide, if is_real { z.im } else { z.im.widened(total) })
    };
    Ok(Sum {
        parts: [of(&parts[0]), of(&parts[1]), of(&parts[2]), of(&parts[3])],
        next,
        terms: k,
    })
}

/// The sum of a convergent series.
pub(super) fn series(
    w: &ComplexBall,
    bits: u32,
    ratio: impl Fn(u64) -> (i64, u64),
) -> ComplexEvaluated {
    let sum = sum(w, bits, Kind::Convergent, ratio)?;
    let all = sum.at(0);
    let rest = sum.next.shift(1);
    let im = if w.im.is_zero() {
        all.im
    } else {
        all.im.widened(rest)
    };
    Ok(ComplexBall::new(all.re.widened(rest), im))
}

#[cfg(test)]
mod tests;
