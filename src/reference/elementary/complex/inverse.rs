//! Inverse circular and hyperbolic functions.
//!
//! At a midpoint z with y ≥ 0, with `u = √(1 + z)` and `v = √(1 − z)` in the first and the fourth
//! quadrant (Kahan, *Branch cuts for complex elementary functions*, 1987):
//!
//! ```text
//! asin z = atan2(x, Re uv) + i asinh Im(u v̄)      acos z = 2 atan2(Re v, Re u) − i asinh Im(u v̄)
//! ```
//!
//! without differences, and conjugates below the axis. The cuts are `|x| ≥ 1` on the real axis;
//! `acosh z = i acos z` above it, `asinh z = −i asin iz`, `atan z = −i atanh iz`.

use super::super::support::{BITS, ends, exact};
use super::super::{self as real, ComplexEvaluated, NoValue};
use super::exponential::sqrt_above;
use super::{GUARD, below, inner, is_across, middle, plus, turned, turned_back, widened};
use crate::{Ball, ComplexBall, Mag};

/// Refuses a box across the real axis with points beyond ±1.
fn off_cuts(z: &ComplexBall) -> Result<(), NoValue> {
    if is_across(z) {
        let [low, high] = ends(&z.re, BITS);
        if low <= -1 || high >= 1 {
            return Err(NoValue::Undecided("the operand meets a cut"));
        }
    }
    Ok(())
}

/// `Im asin`, `Re asin` and `Re acos` at a midpoint above the real axis.
fn arcs(m: &ComplexBall, p: u32) -> Result<[Ball; 3], NoValue> {
    let u = sqrt_above(&plus(m, 1, p)?, p)?;
    // 1 − z̄ lies above the axis as well, and its root is v̄.
    let v = sqrt_above(&plus(&-&m.conj(), 1, p)?, p)?;
    let times = |x: &Ball, y: &Ball| inner(real::mul(x, y, p));
    let re = inner(real::add(&times(&u.re, &v.re)?, &times(&u.im, &v.im)?, p))?;
    let im = inner(real::add(&times(&u.im, &v.re)?, &times(&u.re, &v.im)?, p))?;
    let sine = real::atan2(&m.re, &re, p)?;
    let cosine = real::atan2(&v.re, &u.re, p)?.shift(1);
    Ok([real::asinh(&im, p)?, sine, cosine])
}

/// A value above the axis, or its conjugate below.
fn by_side(z: &ComplexBall, value: impl Fn(&ComplexBall) -> ComplexEvaluated) -> ComplexEvaluated {
    let m = middle(z);
    if m.im.mid().is_sign_negative() {
        return Ok(value(&m.conj())?.conj());
    }
    value(&m)
}

/// `1/√(|1 − z| |1 + z|)` over the box, times its radius.
fn of_root(z: &ComplexBall) -> Result<Mag, NoValue> {
    let rho = z.radius();
    if rho.is_zero() {
        return Ok(rho);
    }
    let (a, b) = (below(&plus(z, 1, BITS)?), below(&plus(z, -1, BITS)?));
    Ok(rho.div(real::trigonometric::root_below(a.mul_below(b))))
}

/// The principal arc sine: the derivative is `1/√(1 − z²)`.
pub fn asin(z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    off_cuts(z)?;
    let value = by_side(z, |m| {
        let [im, re, _] = arcs(m, prec + GUARD)?;
        Ok(ComplexBall::new(re, im))
    })?;
    widened(&value, of_root(z)?, prec)
}

/// The principal arc cosine.
pub fn acos(z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    off_cuts(z)?;
    let value = by_side(z, |m| {
        let [im, _, re] = arcs(m, prec + GUARD)?;
        Ok(ComplexBall::new(re, -im))
    })?;
    widened(&value, of_root(z)?, prec)
}

/// The principal inverse of cosh; its cut is x ≤ 1 on the real axis.
pub fn acosh(z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    if is_across(z) && ends(&z.re, BITS)[0] <= 1 {
        return Err(NoValue::Undecided("the operand meets a cut"));
    }
    let value = by_side(z, |m| {
        let [re, _, im] = arcs(m, prec + GUARD)?;
        Ok(ComplexBall::new(re, im))
    })?;
    widened(&value, of_root(z)?, prec)
}

/// The principal inverse of sinh.
pub fn asinh(z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    Ok(turned_back(&asin(&turned(z), prec)?))
}

/// The principal inverse of tanh at a midpoint above the axis: for x ≥ 0
/// `(1/4) log1p(4x/((1 − x)² + y²)) + (i/2)(atan2(y, 1 + x) + atan2(y, 1 − x))`; the real part is odd
/// in x.
fn atanh_above(m: &ComplexBall, p: u32) -> ComplexEvaluated {
    let size = m.re.abs();
    let gap = real::sub(&exact(BITS, 1), &size, p)?;
    let sum = real::add(&exact(BITS, 1), &size, p)?;
    let square = |x: &Ball| inner(real::sqr(x, p));
    let n = inner(real::add(&square(&gap)?, &square(&m.im)?, p))?;
    let quotient = inner(real::div(&size.shift(2), &n, p))?;
    let re = real::log1p(&quotient, p)?.shift(-2);
    let angle = |x: &Ball| real::atan2(&m.im, x, p);
    let im = real::add(&angle(&sum)?, &angle(&gap)?, p)?.shift(-1);
    let re = if m.re.mid().is_sign_negative() {
        -re
    } else {
        re
    };
    Ok(ComplexBall::new(re, im))
}

/// The principal inverse of tanh: the derivative is `1/(1 − z²)`. Undefined at ±1.
pub fn atanh(z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    off_cuts(z)?;
    let m = middle(z);
    if z.im.is_zero() && z.re.rad().is_zero() && *m.re.mid().as_abs() == 1 {
        return Err(NoValue::Undefined("atanh at a pole"));
    }
    let rho = z.radius();
    let (a, b) = (below(&plus(z, 1, BITS)?), below(&plus(z, -1, BITS)?));
    let change = rho.div(a.mul_below(b));
    if !change.is_finite() {
        return Err(NoValue::Undecided("a pole of atanh may be in the operand"));
    }
    let value = by_side(z, |m| atanh_above(m, prec + GUARD))?;
    widened(&value, change, prec)
}

/// The principal inverse of tan.
pub fn atan(z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    Ok(turned_back(&atanh(&turned(z), prec)?))
}
