//! The Voigt profile over balls.

use super::error::{of_scaled, widened};
use super::exponential::expm1_above;
use super::support::{BITS, NARROW, WIDE, exact, hull};
use super::{Evaluated, NoValue, add, div, exp, mul, sqr, sqrt};
use crate::{Ball, ComplexBall, Mag, faddeeva};
use rug::Float;

/// Bits beyond those of the result.
const GUARD: u32 = 16;

/// Beyond 2 to this power, and below its inverse, ratios of the arguments are not formed.
const REACH: i32 = 1 << 14;

/// The density at x of the sum of a normal variable of standard deviation σ ≥ 0 and a Cauchy
/// variable of half-width γ ≥ 0, not both zero: `V = Re w((x + iγ)/(σ√2))/(σ√(2π))`.
///
/// For γ > 0 it is the mean of Cauchy densities `C(x − t)`, whose derivatives obey
/// `|∂C/∂x| ≤ C/γ`, `|∂C/∂γ| ≤ C/γ` and `|∂²C/∂x²| ≤ 2C/γ²`; by `∂V/∂σ = σ ∂²V/∂x²` V obeys
/// `|∂V/∂σ| ≤ 2σ V/γ²`. So `|Δ ln V| ≤ δ = (r_x + r_γ)/γ + 2σ r_σ/γ²` with the least γ and the
/// greatest σ of the balls, and the radius is `V (e^δ − 1)`.
///
/// Where σ or |x| is large beside γ, or δ is, the radius is also taken from w, and the lesser
/// counts: `|Δw| ≤ |w'| ρ + ρ²` for a change ρ of z, since `|w''| ≤ 2` for Im z ≥ 0 (`w'' = −(8/√π)
/// ∫_0^∞ t² e^{−t²+2izt} dt`).
pub fn voigt(x: &Ball, sigma: &Ball, gamma: &Ball, prec: u32) -> Evaluated {
    if sigma.is_negative() || gamma.is_negative() {
        return Err(NoValue::Undefined("a Voigt profile of negative width"));
    }
    if sigma.is_zero() && gamma.is_zero() {
        return Err(NoValue::Undefined("a Voigt profile without width"));
    }
    let p = prec + GUARD;
    let positive = |b: &Ball| b.is_positive();
    if sigma.is_zero() && positive(gamma) {
        // γ/(π(x² + γ²)) = 1/(π γ (1 + (x/γ)²))
        let ratio = sqr(&div(x, gamma, p)?, p)?;
        let below = mul(
            &mul(&Ball::pi(p), gamma, p)?,
            &add(&exact(p, 1), &ratio, p)?,
            p,
        )?;
        return super::recip(&below, prec);
    }
    if gamma.is_zero() && positive(sigma) {
        let t = sqr(&div(x, sigma, p)?, p)?.shift(-1);
        let below = mul(sigma, &sqrt(&Ball::pi(p).shift(1), p)?, p)?;
        return div(&exp(&-t, p)?, &below, prec);
    }
    if !positive(sigma) || !positive(gamma) {
        return Err(NoValue::Undecided("a width of a Voigt profile may be zero"));
    }
    if !x.is_finite() || !sigma.is_finite() || !gamma.is_finite() {
        return Err(WIDE);
    }
    let parts = [x, sigma, gamma];
    let out = |b: &&Ball| b.mid().get_exp().is_some_and(|e| e.abs() > REACH);
    if parts.iter().any(out) {
        return Err(NoValue::Undecided(
            "the arguments of a Voigt profile differ too much",
        ));
    }
    let exactly = |b: &Ball| b.mid().to_rational().ok_or(WIDE);
    let (a, s, g) = (exactly(x)?, exactly(sigma)?, exactly(gamma)?);
    let found = faddeeva::voigt_scaled(&a, &s, &g, prec)
        .map_err(|_| NoValue::Undecided("the Voigt profile cannot be told from zero"))?;
    let value = of_scaled(&found, prec)?;
    if parts.iter().all(|b| b.rad().is_zero()) {
        return Ok(value);
    }
    let low = gamma.mignitude();
    let turn = sigma.magnitude().mul(sigma.rad()).shift(1).div(low);
    let delta = x.rad().add(gamma.rad()).add(turn).div(low);
    let relative = if delta <= Mag::power_of_two(0) {
        value.magnitude().mul(expm1_above(delta))
    } else {
        Mag::INFINITY
    };
    let level = x.magnitude().max(sigma.magnitude()) <= low.shift(2);
    let found = if delta <= Mag::power_of_two(NARROW) && level {
        relative
    } else {
        relative.min(by_slope(x, sigma, gamma).unwrap_or(Mag::INFINITY))
    };
    if found <= value.magnitude() {
        return widened(value, found);
    }
    // 0 < V ≤ 1/(σ√(2π)), and V ≤ 1/(πγ).
    let most = Mag::from_f64(0.39895).div(sigma.mignitude());
    let most = most.min(Mag::from_f64(0.31832).div(low));
    let top = super::support::float_above(most.min(value.magnitude().add(found)));
    hull(prec, &Float::new(BITS), &top)
}

/// Bounds the change of V over the balls, from derivatives of w at the midpoint.
///
/// For the middle σ z changes by `(d_x + i d_y)`, and V by the change of `Re w/(σ√(2π))`. A change
/// of σ then changes V by `r_σ sup σ |∂²V/∂x²|`, and `∂²V/∂x² = Re w''/(2σ³√(2π))`, with `w'' = −2w
/// − 2zw'` and `|w'''| ≤ 8/√π < 4.514` for Im z ≥ 0.
fn by_slope(x: &Ball, sigma: &Ball, gamma: &Ball) -> Option<Mag> {
    let p = 2 * BITS;
    let at = |b: &Ball| Ball::new(b.mid().clone(), Mag::ZERO);
    let scale = |s: &Ball| mul(s, &sqrt(&exact(p, 2), p).ok()?, p).ok();
    let (middle, whole) = (scale(&at(sigma))?, scale(sigma)?);
    let point = |x: &Ball, y: &Ball, s: &Ball| {
        Some(ComplexBall::new(div(x, s, p).ok()?, div(y, s, p).ok()?))
    };
    let z = point(&at(x), &at(gamma), &middle)?;
    let m = ComplexBall::new(at(&z.re), at(&z.im));
    let w = faddeeva::w_float(m.re.mid(), m.im.mid(), p).ok()?;
    let two = |z: ComplexBall| ComplexBall::new(z.re.shift(1), z.im.shift(1));
    // w' = 2i/√π − 2zw
    let product = two(&m * &w);
    let lead = Ball::integer(p, 2) / &Ball::pi(p).sqrt();
    let first = ComplexBall::new(-product.re, lead - &product.im);
    let second = two(&w + &(&m * &first)).re.magnitude();
    let off = |z: &ComplexBall| {
        let of = |a: &Ball, b: &Ball| (a - b).magnitude();
        [of(&z.re, &m.re), of(&z.im, &m.im)]
    };
    let [dx, dy] = off(&point(x, gamma, &middle)?);
    let slope = first.re.magnitude().mul(dx);
    let slope = slope.add(first.im.magnitude().mul(dy));
    let of_w = slope.add(dx.mul(dx).add(dy.mul(dy)));
    let least = sigma.mignitude();
    // 1/√(2π) < 0.39895
    let at_middle = Mag::from_f64(0.39895).div(least).mul(of_w);
    if sigma.rad().is_zero() {
        return Some(at_middle);
    }
    let [dx, dy] = off(&point(x, gamma, &whole)?);
    let curve = second.add(dx.add(dy).mul(Mag::from_f64(4.514)));
    let cube = least.mul_below(least).mul_below(least);
    let turn = sigma.rad().mul(sigma.magnitude()).mul(curve).div(cube);
    Some(at_middle.add(turn.mul(Mag::from_f64(0.1995))))
}
