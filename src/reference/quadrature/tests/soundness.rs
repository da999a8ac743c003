//! Conditions of the proofs, each where it decides.

use super::*;
use crate::quadrature::adaptive::PARTS;

/// Rectangles over its parts cover an ellipse.
#[test]
fn the_parts_cover_the_ellipse() {
    let turns = 40_000;
    for i in 0..=turns {
        let angle = std::f64::consts::PI * f64::from(i) / f64::from(turns);
        let (y, x) = angle.sin_cos();
        let covers =
            |([from, to], height): &([f64; 2], f64)| *from <= x && x <= *to && y <= *height;
        assert!(PARTS.iter().any(covers), "{x} {y}");
    }
}

/// Few digits, so that what is cut off counts beside all other errors.
#[test]
fn what_is_cut_off_widens_the_result() {
    for bits in [6, 8, 11, 15] {
        let goal = Goal::bits(bits);
        let mut root = Formula {
            f: |z: &ComplexBall, _, bits| c::div(&c::real(1, bits), &c::sqrt(z)?),
            growth: |x: &Germ| x.sqrt()?.recip(),
        };
        let found = integrate(&mut root, &number(0), &number(1), &goal)
            .value
            .unwrap();
        assert!(found.contains(&2.into()), "{bits} {found:?}");
        assert!(found.rad() <= Mag::power_of_two(1 - i64::from(bits)));
        let mut tail = Formula {
            f: |z: &ComplexBall, _, bits| c::div(&c::real(1, bits), &(z * z)),
            growth: |x: &Germ| x.mul(x)?.recip(),
        };
        let found = integrate(&mut tail, &number(1), &Limit::PlusInfinity, &goal)
            .value
            .unwrap();
        assert!(found.contains(&1.into()), "{bits} {found:?}");
        let found = integrate(&mut tail, &Limit::MinusInfinity, &number(-2), &goal)
            .value
            .unwrap();
        assert!(found.contains(&(1, 2).into()), "{bits} {found:?}");
    }
}

/// A limit that is known by a ball: the integral for every number in it.
#[test]
fn wide_limits_widen_the_result() {
    let mut line = smooth(|z, _, _| Some(z.clone()));
    let off = Mag::power_of_two(-20);
    let wide = |n: i64| Limit::Finite(Ball::integer(64, n).widened(off));
    let found = integrate(&mut line, &wide(1), &wide(3), &Goal::digits(30));
    let value = found.value.unwrap();
    let step = rug::Rational::from((1, 1 << 20));
    for sign in [-1, 1] {
        let square = |x: rug::Rational| rug::Rational::from(x.square_ref());
        let shift = rug::Rational::from(&step * sign);
        let due = (square(shift.clone() + 3) - square(rug::Rational::from(1) - shift)) / 2;
        assert!(value.contains(&due));
    }
    assert!(value.rad() < off.shift(3) && found.hindrance == Some(Hindrance::Accuracy));
    // The same number twice, or perhaps not.
    let found = integrate(&mut line, &wide(1), &wide(1), &Goal::digits(30))
        .value
        .unwrap();
    assert!(found.contains(&0.into()) && found.rad() < off.shift(3) && found.rad() >= off.shift(1));
    let found = integrate(&mut line, &number(1), &number(1), &Goal::digits(30));
    assert!(found.value.unwrap().is_zero());
    // Singular at one end, and the other one wide.
    let mut log = Formula {
        f: |z: &ComplexBall, _, _| c::ln(z),
        growth: |x: &Germ| x.ln(),
    };
    let found = integrate(&mut log, &number(0), &wide(2), &Goal::digits(30))
        .value
        .unwrap();
    for sign in [-1.0, 1.0] {
        let b = Ball::exact(200, 2.0 + sign / f64::from(1 << 20));
        let due = &b * &b.ln() - b;
        assert!(found.contains_ball(&due), "{found:?}");
    }
}

/// A small value to its own digits needs a second run, whose tails are smaller.
#[test]
fn relative_goals_are_reached() {
    let goal = Goal {
        absolute: Mag::ZERO,
        ..Goal::digits(30)
    };
    let scale = Ball::integer(128, 10).square().square().square().recip();
    let small = ComplexBall::new(scale.square(), Ball::integer(64, 0));
    let mut tail = Formula {
        f: |z: &ComplexBall, _, _| Some(&c::exp(&-z) * &small),
        growth: |x: &Germ| x.neg().exp()?.mul(&Germ::constant(&small.re, 2)),
    };
    let found = integrate(&mut tail, &number(0), &Limit::PlusInfinity, &goal);
    let value = found.value.unwrap();
    assert!(found.hindrance.is_none() && value.overlaps(&small.re));
    assert!(value.accuracy_bits() >= 99, "{value:?}");
    let mut tiny = smooth(|z, _, _| Some(c::exp(z)));
    let found = integrate(&mut tiny, &number(-1020), &number(-1010), &goal);
    let due = Ball::integer(200, -1010).exp() - Ball::integer(200, -1020).exp();
    let value = found.value.unwrap();
    assert!(found.hindrance.is_none() && value.overlaps(&due) && value.accuracy_bits() >= 99);
    // Values that cancel to nothing reach the absolute goal, and no relative one.
    let mut odd = smooth(|z, _, _| Some(c::sine(z)));
    let found = integrate(&mut odd, &number(-9), &number(9), &Goal::digits(30));
    assert!(found.hindrance.is_none() && found.value.unwrap().contains_zero());
    let found = integrate(&mut odd, &number(-9), &number(9), &goal);
    assert_eq!(found.hindrance, Some(Hindrance::Accuracy));
}

/// A function with a pole on one side of a segment alone.
#[test]
fn both_sides_of_a_segment_count() {
    let goal = Goal::digits(30);
    for side in [-1, 1] {
        let at = |y: i64| ComplexBall::new(Ball::integer(128, side), Ball::integer(128, y));
        let mut pole = smooth(|z, _, bits| c::div(&c::real(1, bits), z));
        let found = integrate_segment(&mut pole, &at(-1), &at(1), &goal);
        let due = Ball::pi(128).shift(-1);
        let due = if side < 0 { -due } else { due };
        let value = found.value.unwrap();
        assert!(
            value.im.overlaps(&due) && value.re.contains_zero(),
            "{side} {value:?}"
        );
        assert!(value.radius().to_f64() < 1e-29);
    }
}

/// The direct enclosure of a panel holds all of its values: a spike that no node meets.
#[test]
fn a_narrow_step_is_not_overlooked() {
    // One on [1/3, 1/3 + 2^−40], and zero elsewhere.
    let low = rug::Rational::from((1, 3));
    let high = rug::Rational::from((1, 1i64 << 40)) + &low;
    let mut step = smooth(|z, holomorphic, bits| {
        let [a, b] = [&low, &high].map(|x| &z.re - Ball::rational(bits.max(200), x));
        let inside = a.is_positive() && b.is_negative();
        let outside = a.is_negative() || b.is_positive();
        match () {
            () if inside => Some(c::real(1, bits)),
            () if outside => Some(c::real(0, bits)),
            () if holomorphic => None,
            () => Some(ComplexBall::new(
                Ball::exact(64, 0.5).widened(Mag::from_f64(0.5)),
                Ball::integer(64, 0),
            )),
        }
    });
    let found = integrate(&mut step, &number(0), &number(1), &Goal::digits(30));
    assert!(found.hindrance.is_none());
    assert!(found.value.unwrap().contains(&(1, 1i64 << 40).into()));
}

/// An integrand that has values in machine words as well.
struct Words<I> {
    other: I,
    short: fn(&Ball128) -> Option<Ball128>,
}

impl<I: Integrand> Integrand for Words<I> {
    fn enclose(&mut self, z: &ComplexBall, holomorphic: bool, bits: u32) -> Option<ComplexBall> {
        self.other.enclose(z, holomorphic, bits)
    }

    fn enclose_short(&mut self, x: &Ball128) -> Option<Ball128> {
        (self.short)(x)
    }

    fn growth(&mut self, end: &End, k: u32) -> Option<Growth> {
        self.other.growth(end, k)
    }
}

/// Few digits, so that the error of a rule counts beside those of its nodes; and an end at one, from
/// which machine words do not measure.
#[test]
fn sums_in_machine_words_have_the_error_of_their_rule() {
    for bits in [6, 11, 30, 60, 110] {
        let goal = Goal::bits(bits);
        let mut lorentz = Words {
            other: smooth(|z, _, bits| c::div(&c::real(4, bits), &(&c::real(1, bits) + &(z * z)))),
            short: |x| Ball128::integer(4).div(&x.mul(x)?.add(&Ball128::integer(1))?),
        };
        for [from, to] in [[0, 1], [-1, 0]] {
            let found = integrate(&mut lorentz, &number(from), &number(to), &goal);
            reached(
                &found,
                &Ball::pi(300),
                i64::from(bits) * 3 / 10,
                "4/(1+x^2)",
            );
        }
        // x/√(x − 1): 8/3.
        let mut root = Words {
            other: Formula {
                f: |z: &ComplexBall, _, bits| c::div(z, &c::sqrt(&(z - &c::real(1, bits)))?),
                growth: |x: &Germ| x.div(&x.vanishing().sqrt()?),
            },
            short: |x| {
                let beside = x.sub(&Ball128::integer(1))?;
                let size = beside.mul(&beside)?.sqrt()?.sqrt()?;
                x.div(&size)
            },
        };
        let found = integrate(&mut root, &number(1), &number(2), &goal);
        let due = Ball::integer(300, 8) / Ball::integer(300, 3);
        reached(&found, &due, i64::from(bits) * 3 / 10, "x/sqrt(x-1)");
    }
}
