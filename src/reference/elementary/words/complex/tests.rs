//! Complex functions in machine words against those of MPFR.

use super::super::tests::Draws;
use super::*;
use crate::elementary::{ComplexEvaluated, complex as due};
use crate::{Ball, ComplexBall, Mag};
use rug::Float;

fn long(x: f64, tail: u64) -> Float {
    Float::with_val(128, x) + (Float::with_val(53, tail) >> 110u32)
}

/// A part on an axis, next to it, or anywhere up to a size.
fn part(draws: &mut Draws, size: f64) -> Float {
    let x = size * (2.0 * draws.next() - 1.0);
    match draws.next() {
        ..0.1 => Float::new(128),
        ..0.2 => long(x, draws.bits()) >> (100.0 * draws.next()) as u32,
        ..0.3 => Float::with_val(128, x.round()),
        _ => long(x, draws.bits()),
    }
}

/// Values at numbers, and at the corners of balls, are inside; at numbers they have the accuracy in
/// bits beside the modulus.
fn holds(
    name: &str,
    size: f64,
    bits: i64,
    word: impl Fn(&Complex128) -> Option<Complex128>,
    due: impl Fn(&ComplexBall) -> ComplexEvaluated,
) {
    let mut draws = Draws(1);
    let (mut found, mut exact) = (0, 0);
    for k in 0..3000 {
        let [x, y] = [0, 1].map(|_| part(&mut draws, size));
        let radius = match k % 2 {
            0 => Mag::ZERO,
            _ => Mag::from_f64(0.1).shift(-((k % 120) as i64)),
        };
        let [re, im] = [&x, &y].map(|x| Ball::new(x.clone(), radius));
        // A part may be too small beside its radius.
        let z = Complex128::of_ball(&ComplexBall::new(re, im));
        let Some(value) = z.and_then(|z| word(&z)) else {
            continue;
        };
        found += 1;
        let value = value.to_ball().unwrap();
        let reach = Float::with_val(300, radius.to_float());
        for (s, t) in [(0, 0), (1, 1), (1, -1), (-1, 1), (-1, -1)] {
            let of = |x: &Float, s: i32| Ball::new(Float::with_val(400, &reach * s) + x, Mag::ZERO);
            let at = ComplexBall::new(of(&x, s), of(&y, t));
            let due = due(&at).unwrap();
            assert!(
                value.re.overlaps(&due.re) && value.im.overlaps(&due.im),
                "{name} at {at:?}: {value:?} {due:?}"
            );
        }
        if radius.is_zero() {
            exact += 1;
            let size = value.magnitude().max(Mag::from_f64(0.01));
            let off = value.radius();
            assert!(off <= size.shift(-bits), "{name} at {x} {y}: {value:?}");
        }
    }
    assert!(found > 700 && exact > 500, "{name}: {found} {exact}");
}

#[test]
fn values_are_inside_and_close() {
    const P: u32 = 300;
    holds("exp", 20.0, 118, exp, |z| due::exp(z, P));
    holds("log", 20.0, 115, log, |z| due::log(z, P));
    holds("log", 1e5, 115, log, |z| due::log(z, P));
    holds("sqrt", 20.0, 120, Complex128::sqrt, |z| due::sqrt(z, P));
    holds("gamma", 30.0, 109, tgamma, |z| due::tgamma(z, P));
    holds("gamma", 200.0, 105, tgamma, |z| due::tgamma(z, P));
    let [re, im] = [1.5, -0.75].map(Ball128::exact);
    let w = Complex128 { re, im };
    let exponent = w.to_ball().unwrap();
    holds(
        "pow",
        9.0,
        110,
        |z| pow(z, &w),
        |z| due::pow(z, &exponent, P),
    );
    holds(
        "inverse cube",
        9.0,
        118,
        |z| z.power(-3),
        |z| due::recip(&(&(z * z) * z), P),
    );
    holds(
        "1 − z²/(z + i)",
        9.0,
        110,
        |z| {
            let i = Complex128::imaginary_unit();
            let one = Complex128::real(Ball128::integer(1));
            one.sub(&z.mul(z)?.div(&z.add(&i)?)?)
        },
        |z| {
            let [zero, one] = [0, 1].map(|n| Ball::integer(P, n));
            let i = ComplexBall::new(zero.clone(), one.clone());
            Ok(&ComplexBall::new(one, zero) - &due::div(&(z * z), &(z + &i), P)?)
        },
    );
}

/// A cut belongs to its upper side, and a ball across it has no value.
#[test]
fn cuts() {
    let of = |x: f64, y: f64| Complex128 {
        re: Ball128::exact(x),
        im: Ball128::exact(y),
    };
    for f in [log, Complex128::sqrt] {
        assert!(f(&of(-2.0, 0.0)).unwrap().im.doubles().unwrap()[0] > 1.0);
        assert!(f(&of(-2.0, -1e-20)).unwrap().im.doubles().unwrap()[1] < -1.0);
        let across = Complex128 {
            re: Ball128::integer(-2),
            im: Ball128::exact(1e-19).widened(-60).unwrap(),
        };
        assert!(f(&across).is_none() && f(&across.negative()).is_some());
        assert!(f(&of(0.0, 0.0)).is_none());
    }
}
