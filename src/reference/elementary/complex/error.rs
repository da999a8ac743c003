//! The error function, its relatives, and the Faddeeva function.

use super::super::error::{TWO_OVER_ROOT_PI, of_scaled};
use super::super::support::exp_above;
use super::super::{ComplexEvaluated, NoValue};
use super::{GUARD, bounded, clipped, turned, turned_back, widened};
use crate::special::faddeeva::{Relative, slope};
use crate::{Ball, ComplexBall, Mag};
use std::f64::consts::FRAC_PI_4;

/// A function at the midpoint of a box of radius ρ, with a relative radius of both components. An
/// overflow of a component is one of the modulus, but need not be one all over the box.
fn at(which: Relative, m: &ComplexBall, rho: Mag, prec: u32) -> ComplexEvaluated {
    let [re, im] = which
        .at(m.re.mid(), m.im.mid(), prec + GUARD)
        .map_err(|_| NoValue::Undecided("a component cannot be told from zero"))?;
    let of = |part| match of_scaled(part, prec) {
        Err(NoValue::Overflow { .. }) if rho.is_zero() => {
            Err(NoValue::Overflow { negative: false })
        }
        found => super::inner(found),
    };
    Ok(ComplexBall::new(of(&re)?, of(&im)?))
}

/// `(2/√π) sup |e^{−z²}|`, with `Re z² ≥ a² − b²` for the least |x| and the greatest |y|.
fn gaussian(z: &ComplexBall) -> Mag {
    let (a, b) = (
        z.re.mignitude().to_f64().min(1e100),
        z.im.magnitude().to_f64(),
    );
    // Rounded up; each square is off by an ulp at most.
    let t = b * b * (1.0 + 1e-15) - a * a * (1.0 - 1e-15);
    let t = t + t.abs() * 1e-15;
    exp_above(t).mul(Mag::from_f64(TWO_OVER_ROOT_PI))
}

fn by_gaussian(which: Relative, z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    bounded(z)?;
    let (m, rho) = clipped(z);
    let value = at(which, &m, rho, prec)?;
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

/// `sup |w'|` over the points with Im z ≥ 0 and |z| at least that of the box.
fn upper_slope(z: &ComplexBall) -> Mag {
    let least = Ball::new(super::below(z).to_float(), Mag::ZERO);
    let on_axis = ComplexBall::new(least, Ball::integer(64, 0));
    slope(&on_axis, Mag::ZERO, Mag::INFINITY)
}

/// The Faddeeva function `w(z) = e^{−z²} erfc(−iz)`. Its derivative is bounded as in
/// [`w_ball`](crate::faddeeva::w_ball), and by `4|z| |e^{−z²}| + |w'(−z)|` below the axis, since
/// `w(z) = 2e^{−z²} − w(−z)` (DLMF 7.4.3).
pub fn w(z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    bounded(z)?;
    let (m, rho) = clipped(z);
    let value = at(Relative::Erfcx, &turned_back(&m), rho, prec)?;
    if rho.is_zero() {
        return Ok(value);
    }
    let whole = ComplexBall::new(m.re.widened(rho), m.im.widened(rho));
    let near = slope(&whole, rho, value.magnitude());
    // The Gaussian comes with 2/√π; √π/2 < 0.88623.
    let below = z
        .magnitude()
        .shift(2)
        .mul(gaussian(z))
        .mul(Mag::from_f64(0.88623));
    let far = below.add(upper_slope(z));
    widened(&value, rho.mul(near.min(far)), prec)
}

/// The scaled complementary error function `e^{z²} erfc z = w(iz)`.
pub fn erfcx(z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    w(&turned(z), prec)
}

/// Dawson's function `F(z) = (i√π/2)(e^{−z²} − w(z))`, so that for Im z ≥ 0 `|F'|` is at most
/// `(√π/2)(2|z| |e^{−z²}| + sup |w'|)`; F is odd.
///
/// For `t = 2Zρ ≤ 1`, with Z the greatest |z|, Grönwall's lemma and `F' = 1 − 2zF` give
/// `|F| ≤ G = e^t (|F(m)| + ρ)` with `e^t ≤ 1 + 2t`, `|F'| ≤ 1 + 2ZG` and, with
/// `F'' = −2F − 2zF'`, `|F'| ≤ |1 − 2m F(m)| + ρ (2G + 2Z (1 + 2ZG))`.
pub fn dawson(z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    bounded(z)?;
    let (m, rho) = clipped(z);
    let value = at(Relative::Dawson, &m, rho, prec)?;
    if rho.is_zero() {
        return Ok(value);
    }
    let one = Mag::power_of_two(0);
    let twice = z.magnitude().shift(1);
    let t = twice.mul(rho);
    let near = if t <= one {
        let grown = one.add(t.shift(1)).mul(value.magnitude().add(rho));
        let first = one.add(twice.mul(grown));
        let product = &m * &value;
        let re = Ball::integer(64, 1) - product.re.shift(1);
        let at_mid = ComplexBall::new(re, product.im.shift(1)).magnitude();
        first.min(at_mid.add(rho.mul(grown.shift(1).add(twice.mul(first)))))
    } else {
        Mag::INFINITY
    };
    // π/4: √π/2, and the Gaussian comes with 2/√π.
    let bell = twice
        .mul(gaussian(z))
        .mul(Mag::from_f64(FRAC_PI_4.next_up()));
    let far = bell.add(upper_slope(z).mul(Mag::from_f64(0.88623)));
    widened(&value, rho.mul(near.min(far)), prec)
}
