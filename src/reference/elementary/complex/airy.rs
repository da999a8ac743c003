//! Airy functions and their derivatives.
//!
//! # Series
//! With `w = z³/9`, `f = ₀F₁(2/3; w)` and `g = z ₀F₁(4/3; w)` (DLMF 9.4.1 to 9.4.4)
//!
//! ```text
//! Ai = c f − d g   Bi = √3 (c f + d g)   c = 3^{−2/3}/Γ(2/3)   d = 3^{−1/3}/Γ(1/3)
//! f' = (z²/2) ₀F₁(5/3; w)   g' = ₀F₁(1/3; w)
//! ```
//!
//! # Large arguments
//! With `ζ = (2/3) z^{3/2}` and the sums `S` of [`bessel`](super::bessel) of orders 1/3 and 2/3
//! (9.6.2 and 9.6.3), for |ph z| ≤ 2π/3
//!
//! ```text
//! 2√π z^{1/4} Ai = e^{−ζ} S_{1/3}(ζ)     2√π z^{−1/4} Ai' = −e^{−ζ} S_{2/3}(ζ)
//! √π z^{1/4} Bi = e^ζ S_{1/3}(−ζ) + (i/2) e^{−ζ} S_{1/3}(ζ)     for Im z ≥ 0 (9.2.11)
//! √π z^{−1/4} Bi' = e^ζ S_{2/3}(−ζ) − (i/2) e^{−ζ} S_{2/3}(ζ)
//! ```
//!
//! and for |ph z| ≤ π/3, from 9.2.14 and 9.2.10,
//!
//! ```text
//! 2√π z^{1/4} f(−z) = e^{iα − iζ} S_{1/3}(iζ) + e^{iζ − iα} S_{1/3}(−iζ)   α = π/4 of Ai, −π/4 of Bi
//! 2√π z^{−1/4} f'(−z) = e^{iα − iζ} S_{2/3}(iζ) + e^{iζ − iα} S_{2/3}(−iζ)   3π/4 of Ai', π/4 of Bi'
//! ```
//!
//! # Radii
//! Far from zero all of it is evaluated in balls. Elsewhere the midpoint m is, and with Z the
//! greatest |z| and `N = √Z |y| + |y'|` the equation `y'' = zy` gives `N(z) ≤ N(m) e^{√Z ρ}`
//! (Grönwall's lemma), hence `|y(z) − y(m)| ≤ ρ N(m) e^{√Z ρ}` and
//! `|y'(z) − y'(m)| ≤ ρ √Z N(m) e^{√Z ρ}`; also, from y'' once more,
//! `|y(z) − y(m)| ≤ ρ |y'(m)| + ρ² √Z N(m) e^{√Z ρ}`.

use super::super::support::{BITS, exact, exp_above};
use super::super::{self as real, ComplexEvaluated, NoValue};
use super::bessel::{Order, Tail, useful};
use super::hypergeometric::series;
use super::{GUARD, Kept, bounded, clipped, rounded, widened};
use crate::{Ball, ComplexBall};
use rug::Rational;
use std::f64::consts::LN_2;
use std::sync::Arc;

/// The function that is meant.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Which {
    /// True for Bi.
    second: bool,
    /// True for the derivative.
    slope: bool,
}

/// `c` and `d`, whose product is `1/(2π√3)` (DLMF 9.3.1 and 9.3.3, 5.5.3).
fn constants(p: u32) -> Result<Arc<[Ball; 2]>, NoValue> {
    static KNOWN: Kept<[Ball; 2]> = Kept::new();
    KNOWN.get(
        p,
        |_| true,
        |p| {
            let bits = p + 16;
            let third = Ball::rational(bits, &Rational::from((1, 3)));
            let root = real::cbrt(&exact(bits, 3), bits)?;
            let d = real::mul(&root, &real::tgamma(&third, bits)?, bits)?.recip();
            let turn = real::sqrt(&exact(bits, 3), bits)? * Ball::pi(bits).shift(1);
            let c = real::mul(&turn, &d, bits)?.recip();
            Ok([c, d])
        },
    )
}

/// The function at an exact point near zero, by its series.
fn near(which: Which, z: &ComplexBall, p: u32) -> ComplexEvaluated {
    let (x, y) = (z.re.mid().to_f64(), z.im.mid().to_f64());
    let size = x.hypot(y);
    let zeta = size.powf(1.5) / 1.5;
    // e^{−Re ζ} of terms of e^{|ζ|}; Bi is not small, nor is Ai left of the axis.
    let fall = (1.5 * y.abs().atan2(x)).cos();
    let fall = if which.second { fall.abs() } else { fall };
    let lost =
        std::f64::consts::LOG2_E * zeta * (1.0 + if which.second { -fall } else { fall }).max(0.0);
    let places = f64::from(p) + lost + 3.0 * (size + 1.0).log2() + 16.0;
    if !(places < 40_000.0) {
        return Err(NoValue::Undecided("an Airy function far from zero"));
    }
    let places = places as u32;
    let bits = places.max(z.re.prec()).max(z.im.prec());
    let z = ComplexBall::new(z.re.with_prec(bits), z.im.with_prec(bits));
    let square = z.square();
    let ninth = Ball::rational(bits, &Rational::from((1, 9)));
    let w = (&square * &z).scaled(&ninth);
    let sum = |n: u64| series(&w, places, |k| (3, (k + 1) * (3 * k + n)));
    let (first, other) = if which.slope {
        let half = ComplexBall::new(square.re.shift(-1), square.im.shift(-1));
        (&half * &sum(5)?, sum(1)?)
    } else {
        (sum(2)?, &z * &sum(4)?)
    };
    let known = constants(bits)?;
    let [c, d] = &*known;
    let (first, other) = (first.scaled(c), other.scaled(d));
    Ok(if which.second {
        (&first + &other).scaled(&real::sqrt(&exact(bits, 3), bits)?)
    } else {
        &first - &other
    })
}

/// Where the box lies.
enum Sector {
    /// |ph z| ≤ 2π/3.
    Right,
    /// |ph(−z)| ≤ π/3.
    Left,
}

fn sector(z: &ComplexBall) -> Option<Sector> {
    let [low, high] = real::support::ends(&z.re, BITS).map(|x| x.to_f64());
    let (least, most) = (z.im.mignitude().to_f64(), z.im.magnitude().to_f64());
    // The factors are on the safe sides of √3.
    if low >= 0.0 || least >= -low * 1.7320508076 {
        Some(Sector::Right)
    } else if -high * 1.7320508075 >= most {
        Some(Sector::Left)
    } else {
        None
    }
}

/// The function far from zero.
fn far(which: Which, z: &ComplexBall, p: u32) -> Option<ComplexEvaluated> {
    Some(match sector(z)? {
        Sector::Right => right(which, z, p),
        Sector::Left => left(which, &-z, p),
    })
}

/// ζ, and `z^{∓1/4}/(2√π)`.
fn phase(which: Which, z: &ComplexBall, p: u32) -> Result<[ComplexBall; 2], NoValue> {
    let root = super::sqrt(z, p)?;
    let two_thirds = Ball::rational(p, &Rational::from((2, 3)));
    let zeta = (&root * z).scaled(&two_thirds);
    let quarter = super::sqrt(&root, p)?;
    let quarter = if which.slope {
        quarter
    } else {
        super::recip(&quarter, p)?
    };
    let below = real::sqrt(&Ball::pi(p), p)?.shift(1).recip();
    Ok([zeta, quarter.scaled(&below)])
}

fn tail(which: Which, zeta: &ComplexBall, p: u32) -> Result<Tail, NoValue> {
    let order = Order {
        p: if which.slope { 2 } else { 1 },
        q: 3,
    };
    Tail::new(order, &super::recip(zeta, p)?, p)
}

/// |ph z| ≤ 2π/3.
fn right(which: Which, z: &ComplexBall, p: u32) -> ComplexEvaluated {
    if which.second && z.im.mid().is_sign_negative() && !super::is_across(z) && !z.im.is_zero() {
        return Ok(right(which, &z.conj(), p)?.conj());
    }
    let [zeta, size] = phase(which, z, p)?;
    let growth = -real::support::ends(&zeta.re, BITS)[1].to_f64();
    super::overflow(match which.second {
        true => zeta.re.mignitude().to_f64(),
        false => growth,
    })?;
    let tail = tail(which, &zeta, p)?;
    let fall = &super::exp(&-&zeta, p)? * &tail.at(0);
    if !which.second {
        let value = &fall * &size;
        return Ok(if which.slope { -&value } else { value });
    }
    let grown = &super::exp(&zeta, p)? * &tail.at(2);
    let grown = grown.scaled(&exact(p, 2));
    let sum = if super::is_across(z) {
        grown.widened(fall.magnitude())
    } else if z.im.is_zero() {
        // The imaginary parts cancel.
        ComplexBall::new(grown.re, exact(p, 0))
    } else if which.slope {
        &grown - &fall.turned()
    } else {
        &grown + &fall.turned()
    };
    Ok(&sum * &size)
}

/// f(−z) for |ph z| ≤ π/3.
fn left(which: Which, z: &ComplexBall, p: u32) -> ComplexEvaluated {
    let [zeta, size] = phase(which, z, p)?;
    super::overflow(zeta.im.mignitude().to_f64())?;
    let tail = tail(which, &zeta, p)?;
    let quarters = match (which.second, which.slope) {
        (false, false) => 1,
        (true, false) => -1,
        (false, true) => 3,
        (true, true) => 1,
    };
    let alpha = real::mul(&Ball::pi(p).shift(-2), &exact(p, quarters), p)?;
    let omega = ComplexBall::new(real::sub(&zeta.re, &alpha, p)?, zeta.im);
    if z.im.is_zero() {
        // Twice the real part of e^{−iω} S(iζ), with 1/(iζ) = i³/ζ.
        let s = tail.at(3);
        let (cosine, sine) = (real::cos(&omega.re, p)?, real::sin(&omega.re, p)?);
        let sum = (&(&cosine * &s.re) + &(&sine * &s.im)).shift(1);
        return Ok(ComplexBall::new(&sum * &size.re, exact(p, 0)));
    }
    let up = super::exp(&omega.turned(), p)?;
    let down = super::exp(&-&omega.turned(), p)?;
    let sum = &(&down * &tail.at(3)) + &(&up * &tail.at(1));
    Ok(&sum * &size)
}

/// Returns true if the sums serve for every number of at least this modulus.
fn is_far(least: f64, p: u32) -> bool {
    least.powf(1.5) / 1.5 >= (f64::from(p) + 8.0) * LN_2 / 2.0
}

/// The function at an exact point.
fn at(which: Which, m: &ComplexBall, p: u32) -> ComplexEvaluated {
    match is_far(super::below(m).to_f64(), p) {
        true => far(which, m, p + long(m)).unwrap_or(Err(super::super::support::WIDE)),
        false => near(which, m, p),
    }
}

/// Bits that the phase ζ is long.
fn long(z: &ComplexBall) -> u32 {
    let e = z.magnitude().exponent().unwrap_or(0).clamp(0, 1 << 13) as u32;
    e + e / 2 + 1
}

fn value(which: Which, z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    bounded(z)?;
    let is_real = z.im.is_zero();
    let whole = |z: ComplexBall| match is_real {
        true => ComplexBall::new(z.re, exact(prec, 0)),
        false => z,
    };
    let p = useful(z, prec) + 2 * GUARD;
    if !z.radius().is_zero()
        && is_far(super::below(z).to_f64(), p)
        && let Some(found) = far(which, z, p + long(z))
    {
        return rounded(&whole(found?), prec);
    }
    let (m, rho) = clipped(z);
    let at = |which, p| at(which, &m, p).map_err(|why| super::of_box(why, rho));
    let value = at(which, p)?;
    if rho.is_zero() {
        return rounded(&whole(value), prec);
    }
    let y = at(
        Which {
            slope: false,
            ..which
        },
        BITS,
    )?
    .magnitude();
    let slope = at(
        Which {
            slope: true,
            ..which
        },
        BITS,
    )?
    .magnitude();
    let root = z.magnitude().sqrt();
    let n = root.mul(y).add(slope);
    let grown = n.mul(exp_above(root.mul(rho).to_f64() * (1.0 + 1e-15)));
    let most = rho.mul(grown);
    let change = match which.slope {
        true => most.mul(root),
        false => most.min(rho.mul(slope).add(rho.mul(root).mul(most))),
    };
    widened(&whole(value), change, prec).map(whole)
}

/// `Ai(z)`.
pub fn airyai(z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    value(
        Which {
            second: false,
            slope: false,
        },
        z,
        prec,
    )
}

/// `Ai'(z)`.
pub fn airyaiprime(z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    value(
        Which {
            second: false,
            slope: true,
        },
        z,
        prec,
    )
}

/// `Bi(z)`.
pub fn airybi(z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    value(
        Which {
            second: true,
            slope: false,
        },
        z,
        prec,
    )
}

/// `Bi'(z)`.
pub fn airybiprime(z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    value(
        Which {
            second: true,
            slope: true,
        },
        z,
        prec,
    )
}

#[cfg(test)]
mod tests;
