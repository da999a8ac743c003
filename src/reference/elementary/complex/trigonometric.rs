//! Circular and hyperbolic functions.

use super::super::hyperbolic::sinh_cosh;
use super::super::support::{BITS, exact};
use super::super::trigonometric::sin_cos;
use super::super::{self as real, ComplexEvaluated, NoValue};
use super::{GUARD, inner, middle, turned, turned_back, widened};
use crate::{Ball, ComplexBall, Mag};

/// A function of x times one of y.
fn product(a: real::Evaluated, b: real::Evaluated, prec: u32) -> real::Evaluated {
    let a = a?;
    if a.is_zero() {
        return Ok(exact(prec, 0));
    }
    real::mul(&a, &b?, prec)
}

/// `sin z = sin x cosh y + i cos x sinh y`.
pub fn sin(z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    let p = prec + GUARD;
    let [sin, cos] = sin_cos(&z.re, p)?;
    let (sinh, cosh) = sinh_cosh(&z.im, p);
    let re = product(Ok(sin), cosh, prec)?;
    let im = product(sinh, Ok(cos), prec)?;
    Ok(ComplexBall::new(re, im))
}

/// `cos z = cos x cosh y − i sin x sinh y`.
pub fn cos(z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    let p = prec + GUARD;
    let [sin, cos] = sin_cos(&z.re, p)?;
    let (sinh, cosh) = sinh_cosh(&z.im, p);
    let re = product(Ok(cos), cosh, prec)?;
    let im = product(Ok(sin), sinh, prec)?;
    Ok(ComplexBall::new(re, -im))
}

/// `sinh z = −i sin iz`.
pub fn sinh(z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    Ok(turned_back(&sin(&turned(z), prec)?))
}

/// `cosh z = cos iz`.
pub fn cosh(z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    cos(&turned(z), prec)
}

/// `1/cosh z`, at most `1/√(sinh² x + cos² y)`: the parts of cosh over a wide rectangle may hold
/// zero each, and cosh not.
pub fn sech(z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    let (s, c) = (
        sinh_cosh(&z.re, BITS).0?.mignitude(),
        sin_cos(&z.im, BITS)?[1].mignitude(),
    );
    let least = real::trigonometric::root_below(s.mul_below(s).add_below(c.mul_below(c)));
    if least.is_zero() {
        return Err(NoValue::Undecided("a pole of 1/cosh may be in the operand"));
    }
    let most = Mag::power_of_two(0).div(least);
    match super::recip(&cosh(z, prec)?, prec) {
        Ok(found) if found.radius() <= most => Ok(found),
        _ => Ok(ComplexBall::zero(prec).widened(most)),
    }
}

/// Beyond this |y| tan z is ±i but for `4 e^{−2|y|}`.
const FAR: f64 = 1e5;

/// `tan z = (sin x cos x + i sinh y cosh y)/(cos² x + sinh² y)`, the divisor being |cos z|² and its
/// inverse the modulus of the derivative. `|tan z ∓ i| = |2/(e^{∓2iz} + 1)| ≤ 4 e^{−2|y|}` for
/// |y| ≥ 1.
pub fn tan(z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    let p = prec + GUARD;
    if z.im.mignitude() >= Mag::from_f64(FAR) {
        let a = z.im.mignitude().to_f64().min(1e15);
        let rest = real::support::exp_above(-1.999 * a).shift(2);
        let sign = if z.im.is_negative() { -1 } else { 1 };
        let end = ComplexBall::new(exact(prec, 0), exact(prec, sign));
        return widened(&end, rest, prec);
    }
    let m = middle(z);
    let (x, y) = (&m.re, &m.im);
    let (sin, cos) = (real::sin(x, p)?, real::cos(x, p)?);
    let (sinh, cosh) = (inner(real::sinh(y, p))?, inner(real::cosh(y, p))?);
    let square = |x: &Ball| inner(real::sqr(x, p));
    let below = real::add(&square(&cos)?, &square(&sinh)?, p)?;
    let over = |a: &Ball, b: &Ball| inner(real::div(&real::mul(a, b, p)?, &below, p));
    let value = ComplexBall::new(over(&sin, &cos)?, over(&sinh, &cosh)?);
    let rho = z.radius();
    if rho.is_zero() {
        return widened(&value, Mag::ZERO, prec);
    }
    let (c, s) = (
        real::cos(&z.re, BITS)?.mignitude(),
        inner(real::sinh(&z.im, BITS))?.mignitude(),
    );
    let least = c.mul_below(c).add_below(s.mul_below(s));
    if least.is_zero() {
        return Err(NoValue::Undecided("a pole of tan may be in the operand"));
    }
    widened(&value, rho.div(least), prec)
}

/// `tanh z = −i tan iz`.
pub fn tanh(z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    Ok(turned_back(&tan(&turned(z), prec)?))
}
