//! Certified Faddeeva function `w(z) = e^{−z²} erfc(−iz)` and its relatives.
//!
//! Every result is a ball with a proven radius. [`w`] certifies each component to the relative
//! accuracy asked for, beside the axes and beside the zeros too; a component that is zero comes
//! out as exactly zero (Im w on the imaginary axis). Two evaluations cover the plane:
//!
//! * Kummer's series of Dawson's function with guard bits (`kummer.rs`), and
//! * the asymptotic series with a remainder bound on the closed quadrant and bounds for the
//!   components beside the axes (`asymptotic.rs`), wherever it reaches the precision.
//!
//! Both are derived at the head of their files. A loop raises the working precision until both
//! components are decided (Ziv, *ACM TOMS* 17, 1991, 410).
//!
//! # Errors
//! [`Undecided`] when the precision reaches its cap, `4 (bits + length of the input) + 4096` bits: a
//! component then is zero or indistinguishable from zero; or when the value leaves MPFR's exponents
//! (about 2^±(2^29) here), in which case [`w_scaled`] still has it.

mod argument;
mod asymptotic;
mod fixed;
mod gaussian;
mod kummer;
mod scaled;

use super::{Ball, ComplexBall, Mag, Undecided};
use argument::{Argument, Real};
use rug::{Float, Integer, Rational};

pub use scaled::Scaled;

/// w(z) for z = re + i im, each component with a relative radius of at most 2^-bits.
///
/// ```
/// use mechaudit::reference::faddeeva;
/// use rug::Rational;
/// // On the imaginary axis w is erfcx, and real.
/// let w = faddeeva::w(&Rational::new(), &Rational::from(1), 120)?;
/// assert_eq!(w.re.to_decimal(30).unwrap(), "0.427583576155807004410750344491");
/// assert!(w.im.is_zero());
/// # Ok::<(), mechaudit::reference::Undecided>(())
/// ```
///
/// # Errors
/// See the [module](self).
pub fn w(re: &Rational, im: &Rational, bits: u32) -> Result<ComplexBall, Undecided> {
    let real = |q: &Rational| Real::Rational(q.clone());
    balls(scaled(real(re), real(im), bits)?, bits)
}

/// [`w`] at an exact pair of doubles. NaN and infinities are refused.
///
/// # Errors
/// See the [module](self).
pub fn w_f64(re: f64, im: f64, bits: u32) -> Result<ComplexBall, Undecided> {
    if !(re.is_finite() && im.is_finite()) {
        return Err(Undecided {
            bits,
            reason: format!("w at the argument ({re}, {im}), which is not finite"),
        });
    }
    balls(scaled(Real::Double(re), Real::Double(im), bits)?, bits)
}

/// [`w`] at an exact pair of floats.
///
/// # Errors
/// See the [module](self). A NaN or an infinity is refused.
pub fn w_float(re: &Float, im: &Float, bits: u32) -> Result<ComplexBall, Undecided> {
    balls(w_float_scaled(re, im, bits)?, bits)
}

fn w_float_scaled(re: &Float, im: &Float, bits: u32) -> Result<[Scaled; 2], Undecided> {
    if !(re.is_finite() && im.is_finite()) {
        return Err(Undecided {
            bits,
            reason: format!("w at the argument ({re}, {im}), which is not finite"),
        });
    }
    scaled(Real::Float(re.clone()), Real::Float(im.clone()), bits)
}

/// [`w`] with exponents of any size: real and imaginary part.
///
/// # Errors
/// As [`w`], but not for the size of the result.
pub fn w_scaled(re: &Rational, im: &Rational, bits: u32) -> Result<[Scaled; 2], Undecided> {
    scaled(Real::Rational(re.clone()), Real::Rational(im.clone()), bits)
}

/// An enclosure of w over a ball, at a working precision of `prec` bits; nothing is promised about
/// its radius.
///
/// With the midpoint m and all points within ρ of it, `|w(z) − w(m)| ≤ ρ sup |w'|`. From
/// `w'(z) = (4i/√π) ∫_0^∞ t e^{−t² + 2izt} dt` (from DLMF 7.7.1-like `w = (2/√π) ∫_0^∞
/// e^{−t²+2izt} dt`, all z): `|w'| ≤ 2/√π` for Im z ≥ 0, and
/// `|w'| ≤ 2/√π + 4h e^{h²}` for Im z ≥ −h, because `∫_0^∞ 2t e^{−t²+2ht} dt = 1 + √π h e^{h²} erfc(−h)`.
/// For |z| ≥ 1 and Im z ≥ 0 also `|w'| ≤ (1/√π + 5.8/|z|²)/|z|²`: one term of the asymptotic
/// series and `D_1` (`asymptotic.rs`: `|z R_1'| ≤ √e(√2.5 + 5) Γ(3/2)/(π|z|³) ≤ 3.07/|z|³`).
pub fn w_ball(z: &ComplexBall, prec: u32) -> ComplexBall {
    let whole = || {
        let line = Ball::new(Float::new(prec), Mag::INFINITY);
        ComplexBall::new(line.clone(), line)
    };
    if !z.is_finite() {
        return whole();
    }
    let (x, y) = (z.re.mid(), z.im.mid());
    let argument = (Real::Float(x.clone()), Real::Float(y.clone()));
    let Some(parts) = once(argument.0, argument.1, prec.max(16)) else {
        return whole();
    };
    let [re, im] = parts;
    let value = ComplexBall::new(re.to_ball(), im.to_ball());
    let rho = z.radius();
    if rho.is_zero() {
        return value;
    }
    value.widened(rho.mul(slope(z)))
}

/// An upper bound on |w'| over the ball.
fn slope(z: &ComplexBall) -> Mag {
    let low = z.im.lower();
    let flat = Mag::from_f64(1.1283791670955128);
    if low < 0 {
        let h = Ball::new(low, Mag::ZERO);
        let grown = h.square().exp().magnitude();
        return flat.add(h.magnitude().mul(grown).shift(2));
    }
    let r = z.mignitude();
    let one = Mag::from_f64(1.0);
    if r < one {
        return flat;
    }
    let inverse = one.div(r).mul(one.div(r));
    let bound = inverse.mul(Mag::from_f64(0.5642).add(Mag::from_f64(5.8).mul(inverse)));
    if bound < flat { bound } else { flat }
}

/// Both components of a scaled result as balls.
fn balls([re, im]: [Scaled; 2], bits: u32) -> Result<ComplexBall, Undecided> {
    let open = |name: &str, part: &Scaled| Undecided {
        bits,
        reason: format!(
            "the {name} part of w has a binary exponent of {} bits, beyond what a ball holds",
            part.exponent.significant_bits()
        ),
    };
    let value = ComplexBall::new(re.to_ball(), im.to_ball());
    if !value.re.is_finite() {
        return Err(open("real", &re));
    }
    if !value.im.is_finite() {
        return Err(open("imaginary", &im));
    }
    Ok(value)
}

/// One evaluation at a given precision; `None` where |z| is too large for Kummer's series and the
/// asymptotic series does not reach (impossible: it reaches wherever |z|² exceeds the precision).
fn once(x: Real, y: Real, prec: u32) -> Option<[Scaled; 2]> {
    let mirrored = x.is_negative();
    let z = Argument::new(if mirrored { x.negated() } else { x }, y);
    let [re, im] = at(&z, prec)?;
    Some(if mirrored {
        [re, negated(im)]
    } else {
        [re, im]
    })
}

fn at(z: &Argument, prec: u32) -> Option<[Scaled; 2]> {
    if let Some(parts) = asymptotic::w(z, prec) {
        return Some(parts);
    }
    if !(z.norm_f64() < 1e8) {
        return None;
    }
    let value = kummer::w(z, prec);
    let part = |b| Scaled::new(b, Integer::new());
    Some([part(value.re), part(value.im)])
}

fn negated(s: Scaled) -> Scaled {
    Scaled::new(-s.ball, s.exponent)
}

/// Bits that are missing from what is asked for; zero for an exact zero.
fn missing(part: &Scaled, bits: u32) -> Option<u32> {
    if part.ball.is_zero() {
        return Some(0);
    }
    let have = part.ball.accuracy_bits();
    if !part.ball.is_finite() || have < 1 {
        return None;
    }
    Some(u32::try_from(i64::from(bits) - have.min(i64::from(bits))).unwrap_or(0))
}

/// Ziv's loop.
fn scaled(x: Real, y: Real, bits: u32) -> Result<[Scaled; 2], Undecided> {
    let bits = bits.max(2);
    let length = x.length().saturating_add(y.length());
    let cap = bits
        .saturating_add(length)
        .saturating_mul(4)
        .saturating_add(4096);
    let mirrored = x.is_negative();
    let z = Argument::new(if mirrored { x.negated() } else { x }, y);
    let mut prec = bits + 12;
    loop {
        let mut more = prec;
        if let Some([re, im]) = at(&z, prec) {
            match (missing(&re, bits), missing(&im, bits)) {
                (Some(0), Some(0)) => {
                    return Ok(if mirrored {
                        [re, negated(im)]
                    } else {
                        [re, im]
                    });
                }
                (Some(a), Some(b)) => more = a.max(b) + 6,
                _ => {}
            }
        }
        if prec == cap {
            return Err(Undecided {
                bits: prec,
                reason: "a component of w is zero or cannot be told from zero".into(),
            });
        }
        prec = prec.saturating_add(more).min(cap);
    }
}
