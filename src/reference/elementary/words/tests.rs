//! Functions in machine words against MPFR.

use super::*;
use crate::Mag;
use crate::elementary::{self as real, Evaluated};
use rug::Float;

/// A stream of numbers between zero and one.
pub(super) struct Draws(pub(super) u64);

impl Draws {
    pub(super) fn bits(&mut self) -> u64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        self.0 >> 11
    }

    pub(super) fn next(&mut self) -> f64 {
        self.bits() as f64 / (1_u64 << 53) as f64
    }
}

/// Values at numbers of 106 bits, and at both ends of balls, are inside; at numbers they have the
/// accuracy in bits.
fn holds(
    name: &str,
    (low, high): (f64, f64),
    bits: i64,
    word: fn(&Ball128) -> Option<Ball128>,
    due: fn(&Ball, u32) -> Evaluated,
) {
    let mut draws = Draws(1);
    let (mut found, mut exact) = (0, 0);
    for k in 0..3000 {
        let x = match k % 3 {
            0 => low + (high - low) * draws.next(),
            // Of all sizes, and next to whole numbers.
            1 => high * (-20.0 * draws.next()).exp2(),
            _ => (low + (high - low) * draws.next()).round() + 1e-12 * draws.next(),
        };
        let tail = Float::with_val(53, draws.bits()) >> 110u32;
        let mid = Float::with_val(128, x) + tail;
        if mid < low || mid > high {
            continue;
        }
        let radius = match k % 2 {
            0 => Mag::ZERO,
            _ => Mag::from_f64(0.1).shift(-((k % 120) as i64)),
        };
        let ball = Ball::new(mid, radius);
        let Some(value) = word(&Ball128::of_ball(&ball).unwrap()) else {
            continue;
        };
        found += 1;
        let value_ball = value.to_ball().unwrap();
        // Ends are rounded far beyond the last bit.
        let long = Ball::new(Float::with_val(400, ball.mid()), radius);
        for at in [ball.mid().clone(), long.lower(), long.upper()] {
            let due = due(&Ball::new(at.clone(), Mag::ZERO), 300).unwrap();
            assert!(
                value_ball.overlaps(&due),
                "{name} at {at}: {value:?} {due:?}"
            );
        }
        if radius.is_zero() {
            exact += 1;
            let accuracy = value.accuracy().unwrap();
            assert!(accuracy >= bits, "{name} at {}: {accuracy}", ball.mid());
        }
    }
    assert!(found > 1000 && exact > 500, "{name}: {found} {exact}");
}

#[test]
fn values_are_inside_and_close() {
    holds("exp", (-700.0, 700.0), 122, exp, real::exp);
    holds("exp", (-1e6, 1e6), 122, exp, real::exp);
    holds("exp", (-2.0, 2.0), 122, exp, real::exp);
    holds("sin", (-10.0, 10.0), 105, sin, real::sin);
    holds("cos", (-1e6, 1e6), 105, cos, real::cos);
    holds("tan", (-30.0, 30.0), 104, tan, real::tan);
    holds("sinh", (-30.0, 30.0), 119, sinh, real::sinh);
    holds("cosh", (-30.0, 30.0), 121, cosh, real::cosh);
    holds("tanh", (-30.0, 30.0), 119, tanh, real::tanh);
    holds("log", (1e-3, 1e4), 115, log, real::log);
    holds("lambertw", (1e-6, 1e6), 117, lambertw, real::lambertw);
    holds("tgamma", (0.5, 200.0), 113, tgamma, real::tgamma);
}

#[test]
fn powers_are_inside_and_close() {
    let exponent = |y: f64, p: u32| Ball::exact(p, y);
    for y in [-1.5, 0.25, 3.75] {
        let mut draws = Draws(7);
        for _ in 0..500 {
            let x = 0.01 + 20.0 * draws.next();
            let Some(value) = pow(&Ball128::exact(x), &Ball128::exact(y)) else {
                continue;
            };
            let due = real::pow(&Ball::exact(300, x), &exponent(y, 300), 300).unwrap();
            assert!(value.to_ball().unwrap().overlaps(&due), "{x}^{y}");
            assert!(value.accuracy().unwrap() >= 112, "{x}^{y}");
        }
    }
}

#[test]
fn what_is_out_of_reach_is_left() {
    let of = |x: f64| Ball128::exact(x);
    assert!(exp(&of(0.0)).unwrap().is_exact());
    for x in [2e6, -2e6, 1e300] {
        assert!(exp(&of(x)).is_none() && sin(&of(x)).is_none());
    }
    assert!(sin(&of(1e-9)).is_none() && cos(&of(0.0)).is_none());
    assert!(log(&of(1.0)).is_none() && log(&of(0.0)).is_none() && log(&of(-2.0)).is_none());
    assert!(lambertw(&of(-0.1)).is_none() && tgamma(&of(0.25)).is_none());
    let wide = of(3.0).widened(0).unwrap();
    assert!(exp(&wide).is_none() && cos(&wide).is_none());
}
