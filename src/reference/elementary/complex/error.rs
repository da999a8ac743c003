//! The error function, its relatives, and the Faddeeva function.

use super::super::error::{TWO_OVER_ROOT_PI, of_scaled};
use super::super::support::exp_above;
use super::super::{ComplexEvaluated, NoValue};
use super::{GUARD, bounded, clipped, turned, turned_back, widened};
use crate::special::faddeeva::{Relative, slope};
use crate::{ComplexBall, Mag};

/// A function at a point, with a relative radius of both components.
fn at(which: Relative, m: &ComplexBall, prec: u32) -> ComplexEvaluated {
    let [re, im] = which
        .at(m.re.mid(), m.im.mid(), prec + GUARD)
        .map_err(|_| NoValue::Undecided("a component cannot be told from zero"))?;
    let of = |part| super::inner(of_scaled(part, prec));
    Ok(ComplexBall::new(of(&re)?, of(&im)?))
}

/// `(2/√π) sup |e^{−z²}|`, with `Re z² ≥ a² − b²` for the least |x| and the greatest |y|.
fn gaussian(z: &ComplexBall) -> Mag {
    let (a, b) = (z.re.mignitude().to_f64().min(1e100), z.im.magnitude().to_f64());
    // Rounded up; each square is off by an ulp at most.
    let t = b * b * (1.0 + 1e-15) - a * a * (1.0 - 1e-15);
    let t = t + t.abs() * 1e-15;
    exp_above(t).mul(Mag::from_f64(TWO_OVER_ROOT_PI))
}

fn by_gaussian(which: Relative, z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    bounded(z)?;
    let (m, rho) = clipped(z);
    let value = at(which, &m, prec)?;
    if rho.is_zero() {
        return Ok(value);
    }
    widened(&value, gaussian(z).mul(rho), prec)
}

/// The error function: `|erf'| = (2/√π) |e^{−z²}|`.
pub fn erf(z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    by_gaussian(Relative::Erf, z, prec)
}

/// The complementary error function.
pub fn erfc(z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    by_gaussian(Relative::Erfc, z, prec)
}

/// `erfi z = −i erf iz`.
pub fn erfi(z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    Ok(turned_back(&erf(&turned(z), prec)?))
}

/// The Faddeeva function `w(z) = e^{−z²} erfc(−iz)`; its derivative is bounded as in
/// [`w_ball`](crate::faddeeva::w_ball).
pub fn w(z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    bounded(z)?;
    let (m, rho) = clipped(z);
    let value = at(Relative::Erfcx, &turned_back(&m), prec)?;
    if rho.is_zero() {
        return Ok(value);
    }
    let change = rho.mul(slope(&about(&m, rho), rho, value.magnitude()));
    widened(&value, change, prec)
}

/// A box about a midpoint that holds all points within ρ.
fn about(m: &ComplexBall, rho: Mag) -> ComplexBall {
    ComplexBall::new(m.re.widened(rho), m.im.widened(rho))
}

/// The scaled complementary error function `e^{z²} erfc z = w(iz)`.
pub fn erfcx(z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    w(&turned(z), prec)
}

/// Dawson's function `F(z) = (i√π/2)(e^{−z²} − w(z))`, so that for Im z ≥ 0 `|F'|` is at most
/// `(√π/2)(2|z| |e^{−z²}| + sup |w'|)`; F is odd. For `t = 2Zρ ≤ 1`, with Z the greatest |z|,
/// Grönwall's lemma and `F' = 1 − 2zF` give `|F| ≤ e^t (|F(m)| + ρ)` with `e^t ≤ 1 + 2t`, and
/// `|F'| ≤ 1 + 2Z |F|`.
pub fn dawson(z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    bounded(z)?;
    let (m, rho) = clipped(z);
    let value = at(Relative::Dawson, &m, prec)?;
    if rho.is_zero() {
        return Ok(value);
    }
    let one = Mag::power_of_two(0);
    let twice = z.magnitude().shift(1);
    let t = twice.mul(rho);
    let near = if t <= one {
        let grown = one.add(t.shift(1)).mul(value.magnitude().add(rho));
        one.add(twice.mul(grown))
    } else {
        Mag::INFINITY
    };
    let above = about(&if m.im.mid().is_sign_negative() { -&m } else { m.clone() }, rho);
    // √π/2 < 0.88623, and the Gaussian comes with 2/√π.
    let far = if above.im.lower() >= 0 {
        let of_w = slope(&above, rho, Mag::INFINITY).mul(Mag::from_f64(0.88623));
        twice.mul(gaussian(z)).mul(Mag::from_f64(0.7854)).add(of_w)
    } else {
        Mag::INFINITY
    };
    widened(&value, rho.mul(near.min(far)), prec)
}
