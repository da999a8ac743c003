//! The Voigt profile over balls.

use super::error::{of_scaled, widened};
use super::exponential::expm1_above;
use super::support::{BITS, NARROW, WIDE, exact, hull};
use super::{Evaluated, NoValue, add, div, exp, mul, sqr, sqrt};
use crate::{Ball, Mag, faddeeva};
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
/// Where σ or |x| is large beside γ, or δ is, the radius is also taken from w, and the lesser counts: `|Δw| ≤ |w'| ρ + ρ²` for a
/// change ρ of z, since `|w''| ≤ 2` for Im z ≥ 0 (`w'' = −(8/√π) ∫_0^∞ t² e^{−t²+2izt} dt`).
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

/// What V is off by over the balls, from the derivative of w at the midpoint.
fn by_slope(x: &Ball, sigma: &Ball, gamma: &Ball) -> Option<Mag> {
    let p = 2 * BITS;
    let at = |b: &Ball| Ball::new(b.mid().clone(), Mag::ZERO);
    let scale = |s: &Ball| mul(s, &sqrt(&exact(p, 2), p).ok()?, p).ok();
    let (middle, whole) = (scale(&at(sigma))?, scale(sigma)?);
    let (re, im) = (
        div(&at(x), &middle, p).ok()?,
        div(&at(gamma), &middle, p).ok()?,
    );
    let w = faddeeva::w_float(re.mid(), im.mid(), p).ok()?;
    // z over the balls, and how far its components are from those at which w is known.
    let (re_all, im_all) = (div(x, &whole, p).ok()?, div(gamma, &whole, p).ok()?);
    let from = |all: &Ball, mid: &Ball| (all - &at(mid)).magnitude();
    let (dx, dy) = (from(&re_all, &re), from(&im_all, &im));
    let (u, v) = (at(&re), at(&im));
    let turned = (&u * &w.re) - (&v * &w.im);
    let other = (&u * &w.im) + (&v * &w.re);
    let lead = Ball::integer(p, 1) / &Ball::pi(p).sqrt();
    // Re w' and Im w', halved.
    let slope = turned
        .magnitude()
        .mul(dx)
        .add((lead - &other).magnitude().mul(dy));
    let rho = dx.mul(dx).add(dy.mul(dy));
    let of_w = slope.shift(1).add(rho);
    // V = Re w/(σ√(2π)): the change of w, and that of 1/σ.
    let below = Mag::from_f64(0.39895).div(sigma.mignitude());
    let turn = sigma.rad().div(Mag::below(sigma.mid()));
    Some(below.mul(of_w.add(w.re.magnitude().mul(turn))))
}
