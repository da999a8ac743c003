//! Lambert's function, the inverse of `w e^w`.
//!
//! # Proof
//! Newton's method gives a number v near W(z). On the disc |w − v| ≤ δ the map
//! `F(w) = w − (w e^w − z)/f'` with `f' = (1 + v) e^v` has a derivative of at most
//!
//! ```text
//! L = δ sup |f''|/|f'| ≤ δ (|v + 2| + δ) e^δ/|1 + v|
//! ```
//!
//! since `f''(w) = (w + 2) e^w`. If η is the greatest `|v e^v − z|/|f'|` of the ball of z, and
//! `η ≤ (1 − L) δ` with L < 1, the disc holds exactly one root of `w e^w = z` for each z of the
//! ball. The root belongs to the branch in whose range the whole disc lies (R. M. Corless et al.,
//! *Adv. Comput. Math.* 5 (1996) 329–359, section 4): of W₀ the points `x + iy` with |y| < π and
//! `x > −y cot y` (x > −1 for y = 0), which is so for x > 0 and |y| ≤ π/2, for x > −1 and |y| ≤ 1
//! with `x ≥ −y cot y` of the greatest |y|, and so on: `y cot y` decreases on [0, π).

use super::super::support::{BITS, WIDE, exact, exp_above};
use super::super::{self as real, ComplexEvaluated, Evaluated, NoValue};
use super::{GUARD, below, bounded, middle, rounded, widened};
use crate::{Ball, Ball128, ComplexBall, Mag};

/// `2 (1 + e z)`, about the square of W(z) + 1 next to the branch point.
fn branch_distance(z: &ComplexBall) -> ComplexEvaluated {
    // As many leading bits as z has may cancel.
    let p = z.re.prec().max(z.im.prec()) + 2 * BITS;
    let e = real::exp(&exact(BITS, 1), p)?;
    let t = super::plus(&z.scaled(&e), 1, p)?;
    Ok(ComplexBall::new(t.re.shift(1), t.im.shift(1)))
}

/// A number near W(z), of which t is the distance from the branch point.
fn start(z: &ComplexBall, t: &ComplexBall, lower: bool, p: u32) -> ComplexEvaluated {
    if t.magnitude() < Mag::from_f64(2.0) {
        // −1 ± √t − t/3
        let root = super::sqrt(&middle(t), p)?;
        let near = if lower { -&root } else { root };
        let third = ComplexBall::new(
            real::div(&t.re, &exact(BITS, 3), p)?,
            real::div(&t.im, &exact(BITS, 3), p)?,
        );
        return super::plus(&(&near - &third), -1, p);
    }
    let (x, y) = (z.re.mid().to_f64(), z.im.mid().to_f64());
    if lower {
        let log = real::log(&-&z.re, BITS)?;
        let less = real::log(&-&log, BITS)?;
        let w = real::sub(&log, &less, BITS)?;
        return Ok(ComplexBall::new(w, exact(BITS, 0)));
    }
    // Right of the branch point ln(1 + z) is near, elsewhere ln z − ln ln z.
    if x >= -0.25 && x.hypot(y) < 4.0 {
        return super::log1p(z, BITS);
    }
    let log = super::log(z, BITS)?;
    Ok(&log - &super::log(&log, BITS)?)
}

/// A number near W(z) to p bits of W(z) + 1, by Halley's method at a growing precision, and the bits
/// that it takes: twice as many more as are the same in W(z) and −1.
fn approximation(z: &ComplexBall, lower: bool, p: u32) -> Result<(ComplexBall, u32), NoValue> {
    let t = branch_distance(z)?;
    let same = t.magnitude().exponent().unwrap_or(0).min(0).unsigned_abs();
    let same = u32::try_from(same).map_err(|_| WIDE)?;
    let (p, mut bits) = (p + same, BITS + same);
    let mut w = middle(&start(z, &t, lower, bits)?);
    let mut rounds = 0;
    loop {
        // w − f/(f' − f (w + 2)/(2 (w + 1))) with f = w − z e^{−w}, f' = w + 1, all over e^w.
        let fall = super::exp(&-&w, bits)?;
        let f = &w - &(z * &fall);
        let more = super::plus(&w, 1, bits)?;
        let half = super::div(&super::plus(&w, 2, bits)?, &more, bits)?;
        let half = ComplexBall::new(half.re.shift(-1), half.im.shift(-1));
        let step = super::div(&f, &(&more - &(&f * &half)), bits)?;
        let size = step.magnitude();
        w = middle(&super::rounded(&(&w - &step), bits)?);
        rounds += 1;
        if rounds > 60 {
            return Err(NoValue::Undecided("no approximation to Lambert's function"));
        }
        let scale = w.magnitude().exponent().unwrap_or(0).min(0);
        let due = scale - i64::from(bits) / 3 - 2;
        if size <= Mag::power_of_two(due) {
            if bits >= p {
                return Ok((w, p));
            }
            bits = (bits * 5 / 2).min(p);
        }
    }
}

/// Returns true if the disc about v is certainly in the range of the branch.
///
/// `Im w e^w = e^x sin y (x + y cot y)`: for 0 < |y| < π a w whose z has an imaginary part of the
/// sign of y, or none, is not left of the curve. The curve itself is where z is on the cut.
fn is_in_range(z: &ComplexBall, v: &ComplexBall, delta: Mag, lower: bool, p: u32) -> bool {
    let disc = v.widened(delta);
    let [x, high] = real::support::ends(&disc.re, p);
    if lower {
        return v.im.is_zero() && high < -1;
    }
    let [bottom, top] = real::support::ends(&disc.im, p);
    // The double is below π.
    if bottom < -std::f64::consts::PI || top > std::f64::consts::PI {
        return false;
    }
    let [below, above] = real::support::ends(&z.im, p);
    if (below >= 0 && bottom > 0) || (above < 0 && top < 0) {
        return true;
    }
    // −y cot y rises with |y|: its greatest value is that at the end.
    let y = if -bottom.clone() > top { -bottom } else { top };
    let y = Ball::new(y, Mag::ZERO);
    let found = || -> Evaluated {
        let cot = real::div(&real::cos(&y, p)?, &real::sin(&y, p)?, p)?;
        real::mul(&y, &cot, p)
    };
    found().is_ok_and(|most| x > -most.lower())
}

fn value(z: &ComplexBall, lower: bool, prec: u32) -> ComplexEvaluated {
    let p = prec + 2 * GUARD;
    let m = middle(z);
    // Next to zero W(z) is z.
    if !lower && m.magnitude() < Mag::power_of_two(-i64::from(p)) {
        let size = z.magnitude();
        if size <= Mag::power_of_two(-8) {
            // |W(z) − z| ≤ 2 |z|².
            return rounded(&z.widened(size.mul(size).shift(1)), prec);
        }
    }
    // A step without a value says nothing of W(z).
    let found = approximation(&m, lower, p);
    let (v, p) = found.map_err(|_| NoValue::Undecided("no approximation to Lambert's function"))?;
    let bits = p + 16;
    let more = super::plus(&v, 1, bits)?;
    let grown = super::exp(&v, bits)?;
    let slope = &more * &grown;
    let least = super::below(&slope);
    let off = (&(&v * &grown) - z).magnitude();
    let eta = off.div(least);
    let delta = eta.shift(1);
    let two = super::plus(&v, 2, BITS)?.magnitude().add(delta);
    let l = delta
        .mul(two)
        .mul(exp_above(delta.to_f64()))
        .div(super::below(&more));
    if !(l <= Mag::power_of_two(-1)) {
        return Err(WIDE);
    }
    if !is_in_range(z, &v, delta, lower, bits) {
        return Err(NoValue::Undecided("the branch of Lambert's function"));
    }
    // η/(1 − L), and 1/(1 − L) ≤ 1 + 2L.
    let radius = eta.mul(l.shift(1).add(Mag::power_of_two(0)));
    rounded(&v.widened(radius), prec)
}

/// The principal branch W₀, with its cut left of −1/e.
///
/// For Re z ≥ 0 the real part of W is not negative: `Re w e^w = e^x (x cos y − y sin y)` is below
/// zero for x < 0 and |y| ≤ π/2, and beyond that the range has x > 0. There `W' = W/(z (1 + W))`
/// is at most 1/|z|, and `1/(e^W (1 + W))` at most 1, which serves where the disc proves nothing.
pub fn lambertw(z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    bounded(z)?;
    if z.re.is_zero() && z.im.is_zero() {
        return Ok(ComplexBall::zero(prec));
    }
    if z.im.is_zero() && (z.re.is_positive() || of_branch_point(&z.re) == Some(true)) {
        let re = real_branch(&z.re, false, prec)?;
        return Ok(ComplexBall::new(re, exact(prec, 0)));
    }
    // The disc that is found does not show on which side of the cut z is, and there is none around
    // the branch point.
    let place = if z.im.contains_zero() {
        of_branch_point(&z.re)
    } else {
        Some(true)
    };
    if place.is_none() || super::is_across(z) && place != Some(true) {
        return Err(NoValue::Undecided(
            "the operand meets the cut of Lambert's function",
        ));
    }
    match value(z, false, prec) {
        Err(NoValue::Undecided(_)) if real::support::ends(&z.re, BITS)[0] >= 0 => {
            let slope = Mag::power_of_two(0).min(Mag::power_of_two(0).div(below(z)));
            widened(
                &value(&middle(z), false, prec)?,
                slope.mul(z.radius()),
                prec,
            )
        }
        found => found,
    }
}

/// Returns true if x is certainly above −1/e, false if it is below.
fn of_branch_point(x: &Ball) -> Option<bool> {
    let p = x.prec().max(BITS) + 32;
    let place = real::exp(&exact(BITS, -1), p).ok()?;
    let above = real::add(x, &place, p).ok()?;
    match (above.is_positive(), above.is_negative()) {
        (true, _) => Some(true),
        (_, true) => Some(false),
        _ => None,
    }
}

/// Bits of a number for which machine words serve.
const WORDS: u32 = 100;

/// A real branch at a number or next to one.
fn of_number(x: &Ball, lower: bool, prec: u32) -> Evaluated {
    if x.is_zero() {
        return Ok(exact(prec, 0));
    }
    if !lower && prec <= WORDS && x.rad().is_zero() {
        let word = Ball128::of_ball(x).and_then(|x| real::words::lambertw(&x)?.to_ball());
        if let Some(found) = word {
            return Ok(found.with_prec(prec));
        }
    }
    let z = ComplexBall::new(x.clone(), exact(BITS, 0));
    Ok(value(&z, lower, prec)?.re)
}

/// A real branch: from −1 upwards, or downwards if `lower`. Both are monotonic.
pub(in super::super) fn real_branch(x: &Ball, lower: bool, prec: u32) -> Evaluated {
    if lower && (x.is_zero() || x.is_positive()) {
        return Err(NoValue::Undefined(
            "the lower branch of Lambert's function at a number that is not negative",
        ));
    }
    match of_branch_point(x) {
        Some(false) => return Err(NoValue::Undefined("Lambert's function below -1/e")),
        None => return Err(NoValue::Undecided("the operand may be below -1/e")),
        Some(true) => {}
    }
    if lower && !x.is_negative() {
        return Err(NoValue::Undecided("the operand may be zero"));
    }
    let is_wide = x.rad() > x.mignitude().shift(-4);
    let whole = match is_wide && x.is_finite() {
        true => Err(WIDE),
        false => of_number(x, lower, prec),
    };
    match whole {
        Err(NoValue::Undecided(_)) if !x.rad().is_zero() && x.is_finite() => {
            let at = |e| of_number(&Ball::new(e, Mag::ZERO), lower, prec + 8);
            let [low, high] = real::support::ends(x, prec).map(at);
            let (low, high) = if lower { (high?, low?) } else { (low?, high?) };
            real::support::union(prec, &[&low, &high])
        }
        found => found,
    }
}

#[cfg(test)]
mod tests;
