//! Complex functions of test integrands, close on wide rectangles.

use crate::{Ball, ComplexBall, Mag};
use rug::Float;

pub fn real(n: i64, bits: u32) -> ComplexBall {
    ComplexBall::new(Ball::integer(bits, n), Ball::integer(bits, 0))
}

pub fn is_real(z: &ComplexBall) -> bool {
    z.im.is_zero()
}

/// A monotone function of a wide ball from its ends.
fn wide(x: &Ball, f: impl Fn(&Ball) -> Ball) -> Ball {
    if x.rad() < Mag::from_f64(1e-3) {
        return f(x);
    }
    let [low, high] = [x.lower(), x.upper()].map(|end| f(&Ball::new(end, Mag::ZERO)));
    low.union(&high)
}

/// The cosine of a wide ball: ±1 where a multiple of π may lie in it.
fn cos(x: &Ball) -> Ball {
    if x.rad() < Mag::from_f64(1e-3) || x.magnitude().to_f64() > 1e6 {
        return x.sin_cos().1;
    }
    let pi = std::f64::consts::PI;
    let mut range = wide(x, |x| x.sin_cos().1);
    let [low, high] = [x.lower(), x.upper()].map(|end| end.to_f64() / pi);
    if high - low > 2.0 {
        return Ball::integer(64, 0).widened(Mag::from_f64(1.0));
    }
    for k in (low - 1e-9).ceil() as i64..=(high + 1e-9).floor() as i64 {
        range = range.union(&Ball::integer(64, 1 - 2 * (k & 1)));
    }
    range
}

fn sin(x: &Ball) -> Ball {
    if x.rad() < Mag::from_f64(1e-3) {
        return x.sin_cos().0;
    }
    cos(&(x - Ball::pi(x.prec()).shift(-1)))
}

fn square(x: &Ball) -> Ball {
    let of = |m: Mag| {
        Ball::new(m.to_float(), Mag::ZERO)
            .with_prec(x.prec())
            .square()
    };
    match x.rad().shift(20) < x.magnitude() {
        true => x.square(),
        false => of(x.mignitude()).union(&of(x.magnitude())),
    }
}

pub fn exp(z: &ComplexBall) -> ComplexBall {
    let size = wide(&z.re, Ball::exp);
    match is_real(z) {
        true => ComplexBall::new(size, z.im.clone()),
        false => ComplexBall::new(cos(&z.im), sin(&z.im)).scaled(&size),
    }
}

/// `1/cosh z` from the smaller exponential.
pub fn sech(z: &ComplexBall) -> Option<ComplexBall> {
    let z = if z.re.is_negative() { -z } else { z.clone() };
    let bits = z.re.prec();
    if z.re.is_positive() {
        let e = exp(&-&z);
        return div(
            &e.scaled(&Ball::integer(bits, 2)),
            &(&real(1, bits) + &(&e * &e)),
        );
    }
    // Where the real part is small: cosh x cos y + i sinh x sin y, and cosh falls to 1.
    let (up, down) = (wide(&z.re, Ball::exp), wide(&-&z.re, Ball::exp));
    let most = Ball::new(z.re.magnitude().to_float(), Mag::ZERO)
        .with_prec(bits)
        .exp();
    let most = (&most + most.recip()).shift(-1);
    let cosh = if z.re.rad().is_zero() {
        most
    } else {
        most.union(&Ball::integer(bits, 1))
    };
    let sinh = (&up - &down).shift(-1);
    if is_real(&z) {
        return Some(ComplexBall::new(cosh.recip(), z.im.clone()));
    }
    div(
        &real(1, bits),
        &ComplexBall::new(&cosh * &cos(&z.im), &sinh * &sin(&z.im)),
    )
}

/// `sin z = sin x cosh y + i cos x sinh y`.
pub fn sine(z: &ComplexBall) -> ComplexBall {
    let (s, c) = (sin(&z.re), cos(&z.re));
    if is_real(z) {
        return ComplexBall::new(s, z.im.clone());
    }
    let (up, down) = (wide(&z.im, Ball::exp), wide(&-&z.im, Ball::exp));
    let (cosh, sinh) = ((&up + &down).shift(-1), (&up - &down).shift(-1));
    ComplexBall::new(&s * &cosh, &c * &sinh)
}

pub fn div(a: &ComplexBall, b: &ComplexBall) -> Option<ComplexBall> {
    if b.re.contains_zero() && b.im.contains_zero() {
        return None;
    }
    if is_real(a) && is_real(b) {
        return Some(ComplexBall::new(&a.re / &b.re, a.im.clone()));
    }
    let inverse = (square(&b.re) + square(&b.im)).recip();
    Some((a * &b.conj()).scaled(&inverse)).filter(ComplexBall::is_finite)
}

/// The principal logarithm off the cut.
pub fn ln(z: &ComplexBall) -> Option<ComplexBall> {
    if is_real(z) {
        return z
            .re
            .is_positive()
            .then(|| ComplexBall::new(z.re.ln(), z.im.clone()));
    }
    if !z.re.is_positive() && z.im.contains_zero() {
        return None;
    }
    let bits = z.re.prec();
    let exact = |m: Mag| Ball::new(m.to_float(), Mag::ZERO).with_prec(bits);
    let narrow = z.radius().shift(20) < z.mignitude();
    if narrow {
        return Some(ComplexBall::new(z.norm_sqr().ln().shift(-1), z.arg()));
    }
    let size = exact(z.mignitude()).ln().union(&exact(z.magnitude()).ln());
    // The greatest and the least angle lie in corners.
    let corner = |x: Float, y: Float| {
        let [x, y] = [x, y].map(|t| Ball::new(t, Mag::ZERO));
        y.atan2(&x)
    };
    let (x, y) = (&z.re, &z.im);
    let angle = corner(x.lower(), y.lower())
        .union(&corner(x.lower(), y.upper()))
        .union(&corner(x.upper(), y.lower()))
        .union(&corner(x.upper(), y.upper()));
    let value = ComplexBall::new(size, angle);
    Some(value).filter(ComplexBall::is_finite)
}

/// The principal root off the cut, and of real intervals from zero on.
pub fn sqrt(z: &ComplexBall) -> Option<ComplexBall> {
    if is_real(z) {
        if z.re.is_positive() {
            return Some(ComplexBall::new(z.re.sqrt(), z.im.clone()));
        }
        if z.re.lower() < 0 {
            return None;
        }
        let bits = z.re.prec();
        let high = Ball::new(z.re.upper(), Mag::ZERO)
            .with_prec(bits)
            .sqrt()
            .upper();
        let zero = Float::new(bits);
        return Some(ComplexBall::new(
            Ball::between(bits, &zero, &high),
            z.im.clone(),
        ));
    }
    let half = ln(z)?.scaled(&Ball::integer(z.re.prec(), 1).shift(-1));
    Some(exp(&half))
}
