//! Exponential, sine and cosine integrals.
//!
//! # Series
//! ```text
//! E₁(z) = −γ − ln z + Σ_{k≥1} (−1)^{k−1} z^k/(k k!)                          (DLMF 6.6.2)
//! Si(z) = Σ (−1)^k z^{2k+1}/((2k + 1) (2k + 1)!)                              (6.6.5)
//! Ci(z) = γ + ln z + Σ_{k≥1} (−1)^k z^{2k}/(2k (2k)!)                         (6.6.6)
//! ```
//!
//! # Large arguments
//! `z e^z E₁(z) = S(z) = Σ_{k<n} (−1)^k k!/z^k + R_n` with `z/(z + t) = Σ_{k<n} (−t/z)^k + …` under
//! `∫_0^∞ z e^{−t}/(z + t) dt` (6.2.2):
//!
//! ```text
//! R_n = (−1)^n z^{1−n} ∫ t^n e^{−t}/(z + t) dt
//! ```
//!
//! Along `t = s e^{iφ}` the exponential is `e^{−s cos φ}`, and |z + t| is at least |z| times the
//! sine of the angle between z and −t, or |z| beyond a right angle. With φ = 0 for
//! |ph z| ≤ 3π/4, where that sine is at least 1/√2, |R_n| is at most √2 times the first omitted
//! term. Up to |ph z| = π, |φ| = 1/√(n + 1) turns the path away from z, and the factor is
//! `1/(sin φ cos^{n+1} φ) ≤ 2 √(n + 1)` for n ≥ 1: `sin φ ≥ φ (1 − φ²/6) ≥ (11/12) φ`, and
//! `cos^{n+1} φ ≥ (1 − φ²/2)^{n+1} ≥ (3/4)²`, which rises with n. On the cut this is the limit from
//! either side.
//!
//! `Si(z) = π/2 − (i/2)(E₁(iz) − E₁(−iz))` and `Ci(z) = −(E₁(iz) + E₁(−iz))/2` for Re z > 0
//! (6.5.5 and 6.5.6).
//!
//! # Radii
//! Far from zero all of it is evaluated in balls; elsewhere from the derivatives `−e^{−z}/z`,
//! `sin z/z` and `cos z/z`, of which |sin z| and |cos z| are at most `e^{|y|}` and `|sin z/z|` too.

use super::super::support::{BITS, exact, exp_above};
use super::super::{self as real, ComplexEvaluated, NoValue};
use super::bessel::useful;
use super::hypergeometric::{Kind, Sum, series, sum};
use super::{GUARD, bounded, clipped, inner, middle, rounded, widened};
use crate::{Ball, ComplexBall, Mag};
use rug::Float;
use rug::float::Constant;
use std::f64::consts::LN_2;

/// Euler's constant γ.
fn euler(p: u32) -> Ball {
    Ball::new(
        Float::with_val(p, Constant::Euler),
        Mag::power_of_two(-i64::from(p)),
    )
}

/// The sums of `(−1)^k k! w^k` and their remainder.
struct Tail {
    sum: Sum,
    rest: Mag,
}

impl Tail {
    fn new(w: &ComplexBall, p: u32) -> Result<Tail, NoValue> {
        let sum = sum(w, p, Kind::Asymptotic, |k| (-(k as i64) - 1, 1))?;
        let factor = Mag::from_f64((sum.terms as f64 + 1.0) * 4.0).sqrt();
        let rest = sum.next.mul(factor);
        Ok(Tail { sum, rest })
    }

    /// `S(1/(i^m w))`.
    fn at(&self, m: usize) -> ComplexBall {
        self.sum.at(m).widened(self.rest)
    }
}

/// Returns true if the sums serve for every number of at least this modulus: `e^{−|z|}` is small
/// enough.
fn is_far(least: f64, p: u32) -> bool {
    least >= (f64::from(p) + 12.0) * LN_2
}

/// Places of a series at a point whose terms are at most `e^{|z|}`.
fn places(z: &ComplexBall, value: f64, p: u32) -> Result<u32, NoValue> {
    let size = z.magnitude().to_f64();
    let places =
        f64::from(p) + std::f64::consts::LOG2_E * (size - value) + (size + 1.0).log2() + 16.0;
    match places < 40_000.0 {
        true => Ok(places as u32),
        false => Err(NoValue::Undecided("an exponential integral far from zero")),
    }
}

fn scaled_by(z: &ComplexBall, bits: u32) -> ComplexBall {
    ComplexBall::new(
        z.re.with_prec(bits.max(z.re.prec())),
        z.im.with_prec(bits.max(z.im.prec())),
    )
}

/// `Σ_{k≥1} (−1)^{k−1} z^k/(k k!)` at an exact point.
fn entire(z: &ComplexBall, p: u32) -> ComplexEvaluated {
    // The sum itself is nearly −ln z − γ − E₁, not small to the right.
    let places = places(z, (-z.re.mid().to_f64()).max(0.0), p)?;
    let z = scaled_by(z, places);
    let sum = series(&-&z, places, |k| (k as i64 + 1, (k + 2) * (k + 2)))?;
    Ok(&z * &sum)
}

/// `E₁` at a point or in a box that is far from zero, or the midpoint of one near it.
fn first(z: &ComplexBall, is_far: bool, p: u32) -> ComplexEvaluated {
    if is_far {
        let w = super::recip(z, p)?;
        let value = &Tail::new(&w, p)?.at(0) * &w;
        return Ok(&value * &super::exp(&-z, p)?);
    }
    // Where E₁ is small, the logarithm and the sum cancel.
    let small = (std::f64::consts::LOG2_E * z.re.mid().to_f64().max(0.0)) as u32 + 8;
    let p = p + small;
    let log = super::log(z, p)?;
    let sum = entire(z, p)?;
    let value = &sum - &log;
    Ok(ComplexBall::new(&value.re - &euler(p), value.im))
}

/// The exponential integral `E₁(z)`, principal branch.
pub fn e1(z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    bounded(z)?;
    if z.re.is_zero() && z.im.is_zero() {
        return Err(NoValue::Undefined("the exponential integral at zero"));
    }
    super::exponential::off_cut(z)?;
    super::overflow(-real::support::ends(&z.re, BITS)[1].to_f64())?;
    let p = useful(z, prec) + 2 * GUARD;
    let long = z.magnitude().exponent().unwrap_or(0).max(0) as u32;
    if is_far(super::below(z).to_f64(), p) {
        let value = inner(first(z, true, p + long))?;
        let value = if z.im.is_zero() && z.re.is_negative() {
            // From above the cut.
            ComplexBall::new(value.re, -Ball::pi(p))
        } else {
            value
        };
        return rounded(&value, prec);
    }
    let m = middle(z);
    let rho = z.radius();
    let value = first(&m, is_far(super::below(&m).to_f64(), p), p)
        .map_err(|why| super::of_box(why, rho))?;
    if rho.is_zero() {
        return rounded(&value, prec);
    }
    let low = real::support::ends(&z.re, BITS)[0].to_f64();
    let slope = exp_above(-low + low.abs() * 1e-15).div(super::below(z));
    widened(&value, slope.mul(rho), prec)
}

/// The exponential integral `Ei(z) = γ + ln z + Σ_{k≥1} z^k/(k k!)`, with the cut of the logarithm
/// but for negative numbers, of which the value is real.
///
/// Beside the positive axis it is `−E₁(−z) ± iπ`, with the sign of Im z, and the sums for E₁ hold
/// on both sides of their cut.
pub fn ei(z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    if z.re.is_zero() && z.im.is_zero() {
        return Err(NoValue::Undefined("the exponential integral at zero"));
    }
    bounded(z)?;
    super::overflow(real::support::ends(&z.re, BITS)[0].to_f64())?;
    if !z.im.is_zero() {
        super::exponential::off_cut(z)?;
    }
    let p = useful(z, prec) + 2 * GUARD;
    let long = z.magnitude().exponent().unwrap_or(0).max(0) as u32;
    let at = |z: &ComplexBall, is_far: bool, p: u32| -> ComplexEvaluated {
        let other = -z;
        let value = if is_far {
            let w = super::recip(&other, p)?;
            let value = &Tail::new(&w, p)?.at(0) * &w;
            let value = -&(&value * &super::exp(z, p)?);
            let pi = Ball::pi(p);
            match z.im.is_zero() {
                true => value,
                false if super::is_across(z) => {
                    ComplexBall::new(value.re, value.im.widened(pi.magnitude()))
                }
                false if z.im.mid().is_sign_negative() => ComplexBall::new(value.re, value.im - pi),
                false => ComplexBall::new(value.re, value.im + pi),
            }
        } else {
            let small = (std::f64::consts::LOG2_E * (-z.re.mid().to_f64()).max(0.0)) as u32 + 8;
            let p = p + small;
            let log = super::log(z, p)?;
            let sum = &log - &entire(&other, p)?;
            ComplexBall::new(&sum.re + &euler(p), sum.im)
        };
        Ok(match z.im.is_zero() {
            true => ComplexBall::new(value.re, exact(p, 0)),
            false => value,
        })
    };
    if is_far(super::below(z).to_f64(), p) {
        return rounded(&inner(at(z, true, p + long))?, prec);
    }
    let m = middle(z);
    let least = super::below(z);
    if least.is_zero() {
        return Err(NoValue::Undecided("the operand may be zero"));
    }
    let rho = z.radius();
    let value = at(&m, is_far(super::below(&m).to_f64(), p), p + long)
        .map_err(|why| super::of_box(why, rho))?;
    if rho.is_zero() {
        return rounded(&value, prec);
    }
    let high = real::support::ends(&z.re, BITS)[1].to_f64();
    let slope = exp_above(high + high.abs() * 1e-15).div(least);
    let wide = widened(&value, slope.mul(rho), prec)?;
    Ok(match z.im.is_zero() {
        true => ComplexBall::new(wide.re, exact(prec, 0)),
        false => wide,
    })
}

/// `f = (E₁(iz) ± E₁(−iz))/2` far from zero with Re z ≥ 0, of the sine integral divided by i.
fn far(is_sine: bool, z: &ComplexBall, p: u32) -> ComplexEvaluated {
    let w = super::recip(z, p)?;
    let tail = Tail::new(&w, p)?;
    // E₁(iz) = e^{−iz} S(iz)/(iz), with 1/(iz) = i³ w.
    if z.im.is_zero() {
        // E₁(−iz) is the conjugate.
        let s = tail.at(3);
        let (cosine, sine) = (real::cos(&z.re, p)?, real::sin(&z.re, p)?);
        // e^{−ix} S(ix) (−i) = (cos x − i sin x)(s + it)(−i).
        let (re, im) = (
            &(&cosine * &s.im) - &(&sine * &s.re),
            -(&(&cosine * &s.re) + &(&sine * &s.im)),
        );
        let part = if is_sine { im } else { re };
        return Ok(ComplexBall::new(&part * &w.re, exact(p, 0)));
    }
    let up = &super::exp(&super::turned_back(z), p)? * &tail.at(3);
    let down = &super::exp(&super::turned(z), p)? * &tail.at(1);
    let (up, down) = (super::turned_back(&up), super::turned(&down));
    let sum = if is_sine {
        super::turned_back(&(&up - &down))
    } else {
        &up + &down
    };
    let sum = &sum * &w;
    Ok(ComplexBall::new(sum.re.shift(-1), sum.im.shift(-1)))
}

/// Si or Ci at an exact point with Re z ≥ 0, or in a box far from zero there.
fn right(is_sine: bool, z: &ComplexBall, is_far: bool, p: u32) -> ComplexEvaluated {
    if is_far {
        let value = far(is_sine, z, p)?;
        return Ok(match is_sine {
            // π/2 − (i/2)(E₁(iz) − E₁(−iz)) = π/2 + (E₁(iz) − E₁(−iz))/(2i).
            true => ComplexBall::new(&value.re + &Ball::pi(p).shift(-1), value.im),
            false => -&value,
        });
    }
    let grown = z.im.mid().to_f64().abs();
    let places = places(z, grown, p)?;
    let z = &scaled_by(z, places);
    let square = -&z.square();
    if is_sine {
        let sum = series(&square, places, |k| {
            (2 * k as i64 + 1, (2 * k + 2) * (2 * k + 3) * (2 * k + 3))
        })?;
        return Ok(&sum * z);
    }
    let sum = series(&square, places, |k| {
        (2 * k as i64 + 2, (2 * k + 3) * (2 * k + 4) * (2 * k + 4))
    })?;
    let sum = &square * &sum;
    let sum = ComplexBall::new(sum.re.shift(-2), sum.im.shift(-2));
    let sum = &sum + &super::log(z, p + 8)?;
    Ok(ComplexBall::new(&sum.re + &euler(p + 8), sum.im))
}

fn circular(is_sine: bool, z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    bounded(z)?;
    super::overflow(z.im.mignitude().to_f64())?;
    let p = useful(z, prec) + 2 * GUARD;
    let long = z.magnitude().exponent().unwrap_or(0).max(0) as u32;
    // Left of the axis Si is odd, and Ci(z) = Ci(−z) ± iπ.
    let is_left = z.re.mid().is_sign_negative() && !z.re.is_zero();
    let is_sided = match is_left {
        true => z.re.is_negative(),
        false => z.re.is_positive() || z.re.is_zero(),
    };
    let turned = |z: &ComplexBall, is_far: bool, p: u32| -> ComplexEvaluated {
        if !is_left {
            return right(is_sine, z, is_far, p);
        }
        let value = right(is_sine, &-z, is_far, p)?;
        if is_sine {
            return Ok(-&value);
        }
        let pi = Ball::pi(p);
        let is_below = z.im.mid().is_sign_negative() && !z.im.is_zero();
        let turn = if is_below { -pi } else { pi };
        Ok(ComplexBall::new(value.re, &value.im + &turn))
    };
    let found = if is_sided && is_far(super::below(z).to_f64(), p) {
        rounded(&inner(turned(z, true, p + long))?, prec)?
    } else {
        // The logarithm of a very small number is not that of zero.
        let (m, rho) = match is_sine {
            true => clipped(z),
            false => (middle(z), z.radius()),
        };
        let value = turned(&m, is_far(super::below(&m).to_f64(), p), p + long)
            .map_err(|why| super::of_box(why, rho))?;
        let least = super::below(z);
        let inverse = Mag::power_of_two(0).div(least);
        let slope = exp_above(z.im.magnitude().to_f64() * (1.0 + 1e-15));
        let inverse = if is_sine {
            inverse.min(Mag::power_of_two(0))
        } else {
            inverse
        };
        let change = if rho.is_zero() {
            rho
        } else {
            slope.mul(inverse).mul(rho)
        };
        widened(&value, change, prec)?
    };
    // The values on the line are real, but for Ci on its cut.
    Ok(match z.im.is_zero() && (is_sine || !is_left) {
        true => ComplexBall::new(found.re, exact(prec, 0)),
        false => found,
    })
}

/// The sine integral `∫_0^z sin t/t dt`.
pub fn si(z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    circular(true, z, prec)
}

/// The cosine integral `γ + ln z + ∫_0^z (cos t − 1)/t dt`, principal branch.
pub fn ci(z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    if z.re.is_zero() && z.im.is_zero() {
        return Err(NoValue::Undefined("the cosine integral at zero"));
    }
    super::exponential::off_cut(z)?;
    circular(false, z, prec)
}

#[cfg(test)]
mod tests;
