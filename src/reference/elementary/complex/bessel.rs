//! Bessel functions of the first kind and their modified forms.
//!
//! # Series
//! `I_ν(z) = (z/2)^ν/Γ(ν + 1) Σ (z²/4)^k/(k! (ν + 1)_k)` (DLMF 10.25.2), J_ν with the sign of z²
//! turned (10.2.2).
//!
//! # Large arguments
//! With `a_{k+1} = a_k (4ν² − (2k + 1)²)/(8 (k + 1))` let `S(z) = Σ_{k<n} a_k/z^k + R_n`, so that
//! `K_ν(z) = √(π/2z) e^{−z} S(z)` (10.40.2). For |ph z| ≤ π (10.40.11 and 10.40.12, with
//! `χ(n) ≤ √(π (n + 1)/2)` by Wendel's inequality, `Γ(x + 1) ≤ √(x + 1/2) Γ(x + 1/2)`)
//!
//! ```text
//! |R_n| ≤ 2 χ(n) |a_n/z^n| exp(|ν² − 1/4| π/(2|z|))
//! ```
//!
//! The continuation 10.34.2 with m = 1 gives, for −π ≤ ph z ≤ 0,
//! `√(2πz) e^{−z} I_ν(z) = S(−z) − i e^{−νπi} e^{−2z} S(z)`, and with `z = −iζ` (10.27.6)
//! `√(2πζ) J_ν(ζ) = e^{−iω} S(−z) + e^{iω} S(z)`, `ω = ζ − (2ν + 1) π/4`, for 0 ≤ ph ζ ≤ π/2.
//!
//! # Radii
//! Far from zero all of it is evaluated in balls. Near zero the midpoint is, and
//! `|J_ν(z)| ≤ |z/2|^ν e^{|y|}/Γ(ν + 1)` (10.14.4; for I_ν with |x|) or, of an integer order,
//! `|J_n(z)| ≤ e^{|y|}` (10.9.1) bounds the derivative `J_{ν−1}/2 − J_{ν+1}/2`.

use super::super::support::{BITS, WIDE, exact, exp_above};
use super::super::{self as real, ComplexEvaluated, NoValue};
use super::hypergeometric::{Kind, Sum, series, sum};
use super::{GUARD, bounded, clipped, inner, rounded, widened};
use crate::{Ball, ComplexBall, Mag};
use rug::Rational;
use std::f64::consts::{FRAC_PI_2, LN_2};

/// An order p/q, not negative.
#[derive(Clone, Copy)]
pub(super) struct Order {
    pub p: i64,
    pub q: i64,
}

/// Orders are below this, with at most this denominator.
const LARGEST: i64 = 1 << 12;

impl Order {
    /// The modulus of a number, and its sign.
    fn new(order: &Rational) -> Result<(Order, bool), NoValue> {
        let parts = (order.numer().to_i64(), order.denom().to_i64());
        let (Some(p), Some(q @ ..=LARGEST)) = parts else {
            return Err(NoValue::Undecided("an order beyond 4096 or its inverse"));
        };
        if p.unsigned_abs() > (LARGEST * q) as u64 {
            return Err(NoValue::Undecided("an order beyond 4096 or its inverse"));
        }
        if p < 0 && q > 1 {
            return Err(NoValue::Undecided("a broken order below zero"));
        }
        Ok((Order { p: p.abs(), q }, p < 0))
    }

    fn is_integer(self) -> bool {
        self.q == 1
    }

    fn is_odd(self) -> bool {
        self.q == 1 && self.p % 2 != 0
    }

    /// `|4ν² − 1|/4` from above.
    fn square_less(self) -> f64 {
        let nu = self.p as f64 / self.q as f64;
        (nu * nu - 0.25).abs().next_up() * (1.0 + 1e-12) + 1e-12
    }

    fn ball(self, p: u32) -> Ball {
        &Ball::integer(p, self.p) / &Ball::integer(p, self.q)
    }

    /// The modulus from which the terms of S fall at first.
    fn reach(self) -> f64 {
        self.square_less()
    }
}

/// Twice the modulus at which `e^{−2|z|}` is below `2^−p`, in bits: where S serves.
fn is_far(least: f64, order: Order, p: u32) -> bool {
    least >= (f64::from(p) + 8.0) * LN_2 / 2.0 && least >= order.reach()
}

/// S at `z = w^{-1}/i^m` for the turns asked for, with the remainder.
pub(super) struct Tail {
    sum: Sum,
    rest: Mag,
}

impl Tail {
    /// The sums of the terms `a_k w^k`.
    pub fn new(order: Order, w: &ComplexBall, p: u32) -> Result<Tail, NoValue> {
        let four = 4 * order.p * order.p;
        let square = order.q * order.q;
        let ratio = |k: u64| {
            let odd = 2 * k as i64 + 1;
            (four - square * odd * odd, (8 * square) as u64 * (k + 1))
        };
        let sum = sum(w, p, Kind::Asymptotic, ratio)?;
        let chi = Mag::from_f64(FRAC_PI_2.next_up())
            .mul(Mag::from_f64(sum.terms as f64 + 1.0))
            .sqrt();
        let grown = w.magnitude().mul(Mag::from_f64(
            order.square_less() * FRAC_PI_2.next_up() * (1.0 + 1e-12),
        ));
        let factor = exp_above(grown.to_f64());
        let rest = sum.next.mul(chi).mul(factor).shift(1);
        Ok(Tail { sum, rest })
    }

    /// `S(1/(i^m w))`.
    pub fn at(&self, m: usize) -> ComplexBall {
        self.sum.at(m).widened(self.rest)
    }
}

/// Bits that an argument is known to, as far as they are of use.
pub(super) fn useful(z: &ComplexBall, prec: u32) -> u32 {
    let rad = z.radius();
    if rad.is_zero() {
        return prec;
    }
    let known = z.magnitude().exponent().unwrap_or(0) - rad.exponent().unwrap_or(0);
    // The radius of a phase is absolute.
    let turned = known.max(-rad.exponent().unwrap_or(0));
    prec.min(u32::try_from(turned.max(4)).unwrap_or(4) + GUARD)
}

/// `1/√(2πz)`.
fn amplitude(z: &ComplexBall, p: u32) -> ComplexEvaluated {
    let turn = Ball::pi(p).shift(1);
    super::recip(&super::sqrt(&z.scaled(&turn), p)?, p)
}

/// A Bessel function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bessel {
    /// J_ν.
    First,
    /// I_ν.
    Modified,
    /// `e^{−z} I_ν(z)`.
    Scaled,
}

/// `e^{iπp/q}`.
fn turn(order: Order, numerator: i64, denominator: i64, p: u32) -> ComplexEvaluated {
    let angle = Rational::from((order.p * numerator, order.q * denominator));
    let angle = Ball::rational(p, &angle);
    Ok(ComplexBall::new(
        real::cospi(&angle, p)?,
        real::sinpi(&angle, p)?,
    ))
}

/// `e^{−z} I_ν(z)` far from zero; a box on both sides of the real axis has to have one sign of x.
fn far_scaled(order: Order, z: &ComplexBall, p: u32) -> ComplexEvaluated {
    let across = super::is_across(z);
    if !across && z.im.mid().is_sign_positive() && !z.im.is_zero() {
        return Ok(far_scaled(order, &z.conj(), p)?.conj());
    }
    if across && !z.re.is_positive() {
        return Err(WIDE);
    }
    let tail = Tail::new(order, &super::recip(z, p)?, p)?;
    let fall = super::exp(&z.scaled(&Ball::integer(p, -2)), p)?;
    let second = &(&turn(order, -1, 1, p)? * &fall) * &tail.at(0);
    let first = tail.at(2);
    let sum = match across {
        // Above the axis the second term has the conjugate factor.
        true => first.widened(second.magnitude()),
        false => &first - &second.turned(),
    };
    // Of a real number the value is real.
    let sum = match z.im.is_zero() {
        true => ComplexBall::new(sum.re, exact(p, 0)),
        false => sum,
    };
    Ok(&sum * &amplitude(z, p)?)
}

/// `J_ν(z)` far from zero with Re z ≥ 0.
fn far_first(order: Order, z: &ComplexBall, p: u32) -> ComplexEvaluated {
    let tail = Tail::new(order, &super::recip(z, p)?, p)?;
    let quarter = Rational::from((2 * order.p + order.q, 4 * order.q));
    let p = p + GUARD;
    let phase = real::mul(&Ball::pi(p), &Ball::rational(p, &quarter), p)?;
    let omega = ComplexBall::new(real::sub(&z.re, &phase, p)?, z.im.clone());
    let size = amplitude(z, p)?;
    if z.im.is_zero() {
        let (cosine, sine) = (real::cos(&omega.re, p)?, real::sin(&omega.re, p)?);
        let s = tail.at(1);
        let sum = &(&cosine * &s.re) - &(&sine * &s.im);
        let value = (&sum * &size.re).shift(1);
        return Ok(ComplexBall::new(value, exact(p, 0)));
    }
    let up = super::exp(&omega.turned(), p)?;
    let down = super::exp(&-&omega.turned(), p)?;
    let sum = &(&up * &tail.at(1)) + &(&down * &tail.at(3));
    Ok(&sum * &size)
}

/// The function far from zero.
fn far(which: Bessel, order: Order, z: &ComplexBall, p: u32) -> ComplexEvaluated {
    // f(−z) = (−1)^n f(z) of an integer order.
    if z.re.is_negative() && order.is_integer() {
        let value = match which {
            Bessel::Scaled => {
                let value = far_scaled(order, &-z, p)?;
                &value * &super::exp(&z.scaled(&Ball::integer(p, -2)), p)?
            }
            which => far(which, order, &-z, p)?,
        };
        return Ok(if order.is_odd() { -&value } else { value });
    }
    match which {
        Bessel::Scaled => far_scaled(order, z, p),
        Bessel::Modified => Ok(&super::exp(z, p)? * &far_scaled(order, z, p)?),
        Bessel::First if !z.re.mid().is_sign_negative() && z.re.mignitude() > Mag::ZERO => {
            far_first(order, z, p)
        }
        // J_ν(z) = e^{νπi/2} I_ν(−iz).
        Bessel::First => {
            let other = super::turned_back(z);
            let (sign, other) = match other.re.is_negative() && order.is_integer() {
                true => (order.is_odd(), -&other),
                false => (false, other),
            };
            let value = &super::exp(&other, p)? * &far_scaled(order, &other, p)?;
            let value = &turn(order, 1, 2, p)? * &value;
            Ok(if sign { -&value } else { value })
        }
    }
}

/// Places that a series may have.
const PLACES: f64 = 40_000.0;

/// `z^ν/Γ(ν + 1)`.
fn lead(order: Order, z: &ComplexBall, p: u32) -> ComplexEvaluated {
    let nu = order.ball(p);
    let power = super::pow(z, &ComplexBall::new(nu.clone(), exact(p, 0)), p)?;
    let below = real::tgamma(&real::add(&nu, &exact(p, 1), p)?, p)?.recip();
    Ok(power.scaled(&below))
}

/// The function at an exact point near zero.
fn near(which: Bessel, order: Order, z: &ComplexBall, p: u32) -> ComplexEvaluated {
    let (x, y) = (z.re.mid().to_f64().abs(), z.im.mid().to_f64().abs());
    let size = x.hypot(y);
    let grown = if which == Bessel::First { y } else { x };
    // (|z|/2)^ν/Γ(ν + 1) is less than the power of e|z|/(2ν).
    let nu = order.p as f64 / order.q as f64;
    let factor = if nu > 0.0 {
        (nu * (1.36 * size / nu).log2()).max(0.0)
    } else {
        0.0
    };
    let places = f64::from(p)
        + std::f64::consts::LOG2_E * (size - grown)
        + factor
        + 2.0 * (size + 1.0).log2()
        + 16.0;
    if !(places < PLACES) {
        return Err(NoValue::Undecided("a Bessel function far from zero"));
    }
    let places = places as u32;
    let bits = places.max(z.re.prec()).max(z.im.prec());
    let exact_z = ComplexBall::new(z.re.with_prec(bits), z.im.with_prec(bits));
    let w = exact_z.square();
    let w = ComplexBall::new(w.re.shift(-2), w.im.shift(-2));
    let w = if which == Bessel::First { -&w } else { w };
    let ratio = |k: u64| {
        let k = k as i64 + 1;
        (order.q, (k * (order.q * k + order.p)) as u64)
    };
    let sum = series(&w, places, ratio)?;
    let half = ComplexBall::new(z.re.shift(-1), z.im.shift(-1));
    let value = match order.p {
        0 => sum,
        _ => &sum * &lead(order, &half, p)?,
    };
    match which {
        Bessel::Scaled => Ok(&value * &super::exp(&-z, p)?),
        _ => Ok(value),
    }
}

/// `s^ν/Γ(ν + 1)` of a bound s on |z/2|, from above for ν ≥ 0.
fn lead_above(size: &Ball, nu: &Ball) -> Mag {
    let found = || -> real::Evaluated {
        let power = real::pow(size, nu, BITS)?;
        let below = real::tgamma(&real::add(nu, &exact(BITS, 1), BITS)?, BITS)?;
        real::div(&power, &below, BITS)
    };
    found().map_or(Mag::INFINITY, |x| x.magnitude())
}

/// Bounds on the function and on its derivative over a box.
fn bounds(which: Bessel, order: Order, z: &ComplexBall) -> (Mag, Mag) {
    let above = |x: &Ball| exp_above(x.magnitude().to_f64() * (1.0 + 1e-15));
    let grown = match which {
        Bessel::First => above(&z.im),
        Bessel::Modified => above(&z.re),
        Bessel::Scaled => {
            // e^{|x| − x}.
            let low = real::support::ends(&z.re, BITS)[0].to_f64();
            exp_above(if low < 0.0 {
                -2.0 * low * (1.0 + 1e-15)
            } else {
                0.0
            })
        }
    };
    let nu = order.ball(BITS);
    let half = |m: Mag| Ball::new(m.shift(-1).to_float(), Mag::ZERO);
    let (size, least) = (half(z.magnitude()), half(super::below(z)));
    let value = lead_above(&size, &nu).mul(grown);
    // |(ν/z) f_ν| + |f_{ν+1}|, and |z^{−1} (z/2)^ν| = |z/2|^{ν−1}/2.
    let more =
        real::add(&nu, &exact(BITS, 1), BITS).map_or(Mag::INFINITY, |nu| lead_above(&size, &nu));
    let less = if order.p == 0 {
        Mag::ZERO
    } else {
        let lower = real::sub(&nu, &exact(BITS, 1), BITS);
        let base = if order.p >= order.q { &size } else { &least };
        // (ν/2) s^{ν−1}/Γ(ν + 1) = s^{ν−1}/(2Γ(ν)).
        lower
            .map_or(Mag::INFINITY, |nu| lead_above(base, &nu))
            .shift(-1)
    };
    let slope = more.add(less).mul(grown);
    let (value, slope) = match order.is_integer() {
        true => (value.min(grown), slope.min(grown)),
        false => (value, slope),
    };
    match which {
        Bessel::Scaled => (value, slope.add(value)),
        _ => (value, slope),
    }
}

/// The function of an order ν ≥ 0, or an integer.
pub fn bessel(which: Bessel, order: &Rational, z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    // A part that is clipped to the axis belongs to the side above it.
    if z.im.is_negative() {
        return Ok(bessel(which, order, &z.conj(), prec)?.conj());
    }
    let (order, is_negative) = Order::new(order)?;
    bounded(z)?;
    if !order.is_integer() && super::exponential::off_cut(z).is_err() {
        return Err(NoValue::Undecided(
            "the operand meets the cut of a Bessel function",
        ));
    }
    // The derivation of S shows that it is near 1 so far out.
    super::overflow(match which {
        Bessel::First => z.im.mignitude().to_f64(),
        Bessel::Modified => z.re.mignitude().to_f64(),
        Bessel::Scaled => -2.0 * real::support::ends(&z.re, BITS)[1].to_f64(),
    })?;
    let p = useful(z, prec) + 2 * GUARD;
    let is_sided = order.is_integer() || z.re.is_positive();
    let found = if is_sided && is_far(super::below(z).to_f64(), order, p) {
        let long = z.magnitude().exponent().unwrap_or(0).max(0);
        rounded(&inner(far(which, order, z, p + long as u32))?, prec)?
    } else {
        let (m, rho) = clipped(z);
        let is_far = is_sided && is_far(super::below(&m).to_f64(), order, p);
        let at = match is_far {
            true => far(which, order, &m, p),
            false => near(which, order, &m, p),
        };
        // The box reaches from the operand to what it was clipped to.
        let reach = |z: &Ball, m: &Ball| match z.mid() == m.mid() {
            true => z.clone(),
            false => m.widened(z.magnitude()),
        };
        let (most, slope) = if rho.is_zero() {
            (Mag::INFINITY, Mag::ZERO)
        } else {
            let around = ComplexBall::new(reach(&z.re, &m.re), reach(&z.im, &m.im));
            bounds(which, order, &around)
        };
        let change = slope.mul(rho);
        let zero = ComplexBall::zero(prec);
        // A broken power of a negative number is complex.
        let low = || real::support::ends(&z.re, BITS)[0].clone();
        let z_is_real = z.im.is_zero() && (order.is_integer() || low() >= 0);
        let wide = match at {
            Ok(at) if !(change > most) => widened(&at, change, prec)?,
            Err(why) if !most.is_finite() => return Err(super::of_box(why, rho)),
            _ => widened(&zero, most, prec)?,
        };
        match z_is_real {
            true => ComplexBall::new(wide.re, exact(prec, 0)),
            false => wide,
        }
    };
    // J_{−n} = (−1)^n J_n, I_{−n} = I_n.
    Ok(
        match is_negative && which == Bessel::First && order.is_odd() {
            true => -&found,
            false => found,
        },
    )
}

fn value(which: Bessel, order: &Ball, z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    let exact = order.mid().to_rational().filter(|_| order.rad().is_zero());
    let why = NoValue::Undecided("an order that is not an exact number");
    bessel(which, &exact.ok_or(why)?, z, prec)
}

/// `J_ν(z)` for ν ≥ 0, or an integer; ν an exact binary number.
pub fn besselj(order: &Ball, z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    value(Bessel::First, order, z, prec)
}

/// `I_ν(z)`, as [`besselj`].
pub fn besseli(order: &Ball, z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    value(Bessel::Modified, order, z, prec)
}

/// `e^{−z} I_ν(z)`, as [`besselj`].
pub fn besselie(order: &Ball, z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    value(Bessel::Scaled, order, z, prec)
}

#[cfg(test)]
mod tests;
