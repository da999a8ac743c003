//! Special values, domains, radii, and balls of every kind.

use super::*;
use crate::{Ball, Mag};
use rug::Float;
use rug::float::{exp_max, exp_min};

pub(super) type One = fn(&Ball, u32) -> Evaluated;
pub(super) type Two = fn(&Ball, &Ball, u32) -> Evaluated;

pub(super) const ONE: [(&str, One); 42] = [
    ("sqrt", sqrt),
    ("cbrt", cbrt),
    ("exp", exp),
    ("exp2", exp2),
    ("exp10", exp10),
    ("expm1", expm1),
    ("log", log),
    ("log2", log2),
    ("log10", log10),
    ("log1p", log1p),
    ("sin", sin),
    ("cos", cos),
    ("tan", tan),
    ("sinpi", sinpi),
    ("cospi", cospi),
    ("tanpi", tanpi),
    ("asin", asin),
    ("acos", acos),
    ("atan", atan),
    ("sinh", sinh),
    ("cosh", cosh),
    ("tanh", tanh),
    ("asinh", asinh),
    ("acosh", acosh),
    ("atanh", atanh),
    ("erf", erf),
    ("erfc", erfc),
    ("erfcx", erfcx),
    ("erfi", erfi),
    ("dawson", dawson),
    ("tgamma", tgamma),
    ("lgamma", lgamma),
    ("digamma", digamma),
    ("fabs", fabs),
    ("floor", floor),
    ("ceil", ceil),
    ("round", round),
    ("trunc", trunc),
    ("nearbyint", nearbyint),
    ("recip", recip),
    ("sqr", sqr),
    ("cube", |x, prec| powi(x, 3, prec)),
];

pub(super) const TWO: [(&str, Two); 13] = [
    ("add", add),
    ("sub", sub),
    ("mul", mul),
    ("div", div),
    ("hypot", hypot),
    ("pow", pow),
    ("atan2", atan2),
    ("fmin", fmin),
    ("fmax", fmax),
    ("fdim", fdim),
    ("fmod", fmod),
    ("remainder", remainder),
    ("copysign", copysign),
];

/// Balls of every kind: zeros, the ends of MPFR's exponents, poles and what is beside them.
pub(super) fn hostile() -> Vec<Ball> {
    let power = |bits: u32, e: i32| (Float::with_val(bits, 1) << (e - 1)) * 1.5f64;
    let mut mids = vec![Float::new(2), -Float::new(2)];
    let far = [
        exp_min(),
        exp_min() + 1,
        -(1 << 29),
        -(1 << 20),
        -5000,
        -300,
        -60,
        -1,
        0,
        1,
        2,
        3,
        10,
        20,
        26,
        27,
        28,
        40,
        64,
        65,
        300,
        5000,
        140_000,
        1 << 20,
        1 << 29,
        exp_max() - 1,
        exp_max(),
    ];
    for e in far {
        for bits in [2, 64] {
            mids.push(power(bits, e.max(exp_min() + 1)));
            mids.push(-power(bits, e.max(exp_min() + 1)));
        }
    }
    for x in [
        -1.0,
        1.0,
        0.5,
        -0.5,
        -2.5,
        -7.0,
        1e300,
        -1e300,
        2.0f64.powi(-1000) - 3.0,
    ] {
        mids.push(Float::with_val(53, x));
    }
    mids.push(Float::with_val(2000, -5) + (Float::with_val(53, 1) >> 1500u32));
    let rads = [
        Mag::ZERO,
        Mag::power_of_two(-(1 << 40)),
        Mag::power_of_two(i64::from(exp_min()) - 1),
        Mag::power_of_two(-3000),
        Mag::power_of_two(-70),
        Mag::from_f64(0.3),
        Mag::from_f64(5.0),
        Mag::power_of_two(1 << 29),
        Mag::power_of_two(1 << 40),
        Mag::INFINITY,
    ];
    let mut all = Vec::new();
    for mid in &mids {
        for rad in rads {
            all.push(Ball::new(mid.clone(), rad));
        }
        all.push(Ball::new(mid.clone(), Mag::above(mid).shift(-20)));
        all.push(Ball::new(mid.clone(), Mag::above(mid)));
    }
    all
}

#[test]
fn no_ball_panics_or_runs_without_end() {
    let balls = hostile();
    for (name, f) in ONE {
        for x in &balls {
            for prec in [2, 64, 300] {
                let found = f(x, prec);
                assert!(
                    !found.is_ok_and(|ball| !ball.is_finite()),
                    "{name} {x:?} {prec}"
                );
            }
        }
    }
    let some: Vec<&Ball> = balls.iter().step_by(7).collect();
    for x in &some {
        for y in &some {
            for (name, f) in TWO {
                let found = f(x, y, 64);
                assert!(
                    !found.is_ok_and(|ball| !ball.is_finite()),
                    "{name} {x:?} {y:?}"
                );
            }
        }
    }
    let few: Vec<&Ball> = balls.iter().step_by(31).collect();
    for x in &few {
        for y in &few {
            for z in &few {
                for f in [fma, voigt] {
                    assert!(!f(x, y, z, 64).is_ok_and(|ball| !ball.is_finite()));
                }
            }
        }
    }
}

fn number(x: f64) -> Ball {
    Ball::exact(64, x)
}

fn around(x: f64, r: f64) -> Ball {
    number(x).widened(Mag::from_f64(r))
}

fn is_undefined(found: Evaluated) -> bool {
    matches!(found, Err(NoValue::Undefined(_)))
}

fn is_undecided(found: Evaluated) -> bool {
    matches!(found, Err(NoValue::Undecided(_)))
}

fn is_exactly(found: Evaluated, x: f64) -> bool {
    found.is_ok_and(|ball| ball.rad().is_zero() && *ball.mid() == x)
}

/// Returns true if the ball is `x` to 50 bits.
fn is_near(found: Evaluated, x: f64) -> bool {
    found.is_ok_and(|ball| {
        let off = ball.distance_from(x).1;
        off <= Mag::from_f64(x).shift(-50)
    })
}

/// Functions have no value where C99 has a NaN or a pole, and are undecided where a ball has points
/// of both kinds.
#[test]
fn domains_end_where_they_do() {
    let domains: [(One, f64, f64, f64); 12] = [
        // Undefined, undecided with a radius of 1/4 about the second, and a value.
        (sqrt, -1.0, 0.125, 0.0),
        (log, 0.0, 0.125, 2.0),
        (log2, -1.0, 0.125, 2.0),
        (log10, -0.0, 0.125, 2.0),
        (log1p, -1.0, -0.875, -0.5),
        (asin, 1.5, 1.125, 1.0),
        (acos, -1.5, -1.125, -1.0),
        (acosh, 0.5, 0.875, 1.0),
        (atanh, 1.0, 0.875, 0.5),
        (tanpi, 0.5, 0.625, 0.25),
        (recip, 0.0, 0.125, 2.0),
        (tgamma, -3.0, -3.125, -2.5),
    ];
    for (k, (f, none, some, value)) in domains.into_iter().enumerate() {
        assert!(is_undefined(f(&number(none), 64)), "{k}");
        assert!(is_undecided(f(&around(some, 0.25), 64)), "{k}");
        assert!(f(&number(value), 64).is_ok(), "{k}");
    }
    for f in [lgamma, digamma] {
        assert!(is_undefined(f(&number(-2.0), 64)) && is_undefined(f(&number(0.0), 64)));
        assert!(is_undecided(f(&around(-2.0, 0.1), 64)) && f(&number(-2.5), 64).is_ok());
    }
    // Balls that lie outside as a whole, and touch the end.
    assert!(is_undefined(log(&around(-0.25, 0.25), 64)));
    assert!(is_undefined(asin(&around(2.0, 0.5), 64)));
    assert!(sqrt(&around(0.25, 0.25), 64).is_ok() && acosh(&around(1.25, 0.25), 64).is_ok());
    assert!(asin(&around(0.75, 0.25), 64).is_ok() && is_undecided(atanh(&around(0.75, 0.25), 64)));
    let (zero, wide) = (number(0.0), around(0.0, 0.5));
    for f in [div, fmod, remainder] {
        assert!(is_undefined(f(&number(1.0), &zero, 64)) && is_undefined(f(&zero, &zero, 64)));
        assert!(is_undecided(f(&number(1.0), &wide, 64)));
    }
    for (sigma, gamma) in [(-1.0, 1.0), (1.0, -1.0), (0.0, 0.0)] {
        assert!(is_undefined(voigt(
            &zero,
            &number(sigma),
            &number(gamma),
            64
        )));
    }
    assert!(is_undecided(voigt(&zero, &wide, &number(1.0), 64)));
}

#[test]
fn powers_are_those_of_c99() {
    let power = |x: f64, y: f64| pow(&number(x), &number(y), 64);
    for (x, y, due) in [
        (0.0, 0.0, 1.0),
        (-3.0, 0.0, 1.0),
        (0.0, 2.5, 0.0),
        (-2.0, 3.0, -8.0),
        (-2.0, -2.0, 0.25),
        (4.0, 0.5, 2.0),
        (2.0, -1.0, 0.5),
    ] {
        assert!(is_exactly(power(x, y), due), "{x}^{y}");
    }
    for (x, y) in [(0.0, -1.0), (0.0, -0.5), (-2.0, 0.5), (-2.0, -1.25)] {
        assert!(is_undefined(power(x, y)), "{x}^{y}");
    }
    assert!(is_undecided(pow(&number(-2.0), &around(3.0, 0.125), 64)));
    assert!(is_undefined(pow(&number(-2.0), &around(3.5, 0.125), 64)));
    assert!(is_undecided(pow(&around(0.0, 0.5), &number(0.5), 64)));
    assert!(is_undecided(pow(&number(0.0), &around(0.0, 0.5), 64)));
    assert!(is_exactly(pow(&around(-1.0, 5.0), &number(0.0), 64), 1.0));
    // An even power of what may be zero is not negative, and one from zero on begins there.
    let even = pow(&around(0.5, 1.0), &number(2.0), 64).unwrap();
    assert!(even.lower() >= 0 && even.upper() >= 2.25 && even.upper() < 2.2501);
    let root = pow(&around(0.5, 0.5), &number(0.5), 64).unwrap();
    assert!(root.lower() >= 0 && root.upper() >= 1 && root.upper() < 1.0001);
    assert!(is_exactly(powi(&number(-3.0), 3, 64), -27.0));
    assert!(is_exactly(powi(&number(-2.0), -1, 64), -0.5));
    assert!(
        is_undefined(powi(&number(0.0), -2, 64)) && is_exactly(powi(&around(0.0, 1.0), 0, 64), 1.0)
    );
}

#[test]
fn angles_have_a_cut_on_the_negative_axis() {
    let angle = |y: &Ball, x: &Ball| atan2(y, x, 64);
    let pi = std::f64::consts::PI;
    assert!(is_exactly(angle(&number(0.0), &number(0.0)), 0.0));
    assert!(is_exactly(angle(&number(-0.0), &around(1.0, 0.5)), 0.0));
    assert!(is_near(angle(&number(0.0), &number(-1.0)), pi));
    assert!(is_near(angle(&number(-0.0), &around(-1.0, 0.5)), pi));
    assert!(is_near(angle(&number(1.0), &number(0.0)), pi / 2.0));
    assert!(is_undecided(angle(&around(0.0, 0.25), &number(-1.0))));
    assert!(is_undecided(angle(&around(-0.25, 0.25), &number(-1.0))));
    assert!(is_undecided(angle(&number(0.0), &around(0.0, 1.0))));
    assert!(is_undecided(angle(&around(0.25, 0.25), &around(0.0, 1.0))));
    // From above up to the axis: from 3π/4 to π.
    let above = angle(&around(0.5, 0.5), &number(-1.0)).unwrap();
    assert!(above.lower() > 2.356 && above.upper() >= pi && above.upper() < pi + 1e-9);
    // A box about the positive axis, with its extremes at corners.
    let right = angle(&around(0.0, 1.0), &around(2.0, 1.0)).unwrap();
    assert!(right.upper() >= pi / 4.0 && right.upper() < 0.7855 && right.lower() > -0.7855);
}

#[test]
fn steps_are_exact_between_jumps() {
    let halves = [
        (floor as One, [0.0, -1.0, 1.0, 2.0]),
        (ceil, [1.0, 0.0, 2.0, 3.0]),
        (round, [1.0, -1.0, 2.0, 3.0]),
        (trunc, [0.0, 0.0, 1.0, 2.0]),
        (nearbyint, [0.0, 0.0, 2.0, 2.0]),
    ];
    for (f, due) in halves {
        for (x, n) in [0.5, -0.5, 1.5, 2.5].into_iter().zip(due) {
            assert!(is_exactly(f(&number(x), 64), n), "{x}");
            assert!(is_exactly(f(&number(1e300), 2), 1e300));
        }
        assert!(is_exactly(
            f(&around(7.25, 0.125), 64),
            f(&number(7.25), 64).unwrap().mid().to_f64()
        ));
        let two = f(&around(3.25, 0.5), 64).unwrap();
        assert!(two.upper() - two.lower() <= 1.0001, "{two:?}");
    }
    for (x, y, by_trunc, by_nearest) in [
        (7.5, 2.0, 1.5, -0.5),
        (-7.5, 2.0, -1.5, 0.5),
        (7.0, 2.0, 1.0, -1.0),
        (5.0, 2.0, 1.0, 1.0),
        (5.0, -2.0, 1.0, 1.0),
        (1.0, 2.0, 1.0, 1.0),
        (6.0, 3.0, 0.0, 0.0),
    ] {
        assert!(
            is_exactly(fmod(&number(x), &number(y), 64), by_trunc),
            "{x} {y}"
        );
        assert!(
            is_exactly(remainder(&number(x), &number(y), 64), by_nearest),
            "{x} {y}"
        );
    }
    // 10^300 modulo 3 is one.
    let ten = powi(&Ball::exact(1100, 10.0), 300, 1100).unwrap();
    assert!(is_exactly(fmod(&ten, &number(3.0), 64), 1.0));
    // Beside a jump, and across it.
    let beside = fmod(&around(7.5, 0.25), &number(2.0), 64).unwrap();
    assert!(*beside.mid() == 1.5 && beside.rad() == Mag::from_f64(0.25));
    let across = fmod(&around(8.0, 0.25), &number(2.0), 64).unwrap();
    assert!(across.lower() <= 0 && across.upper() >= 2);
    let turned = remainder(&around(7.0, 0.25), &number(2.0), 64).unwrap();
    assert!(turned.lower() <= -1 && turned.upper() >= 1);
    // n r_y counts: 100 modulo 3 ± 0.01 is from 0.67 to 1.33.
    let far = fmod(&number(100.0), &around(3.0, 0.01), 64).unwrap();
    assert!(far.lower() <= 0.67 && far.upper() >= 1.33);
    let signs = copysign(&number(3.0), &around(0.0, 1.0), 64).unwrap();
    assert!(signs.lower() <= -3 && signs.upper() >= 3);
    assert!(is_exactly(copysign(&number(-3.0), &number(0.0), 64), 3.0));
    assert!(is_exactly(fmin(&number(3.0), &number(-2.0), 64), -2.0));
    assert!(is_exactly(fmax(&number(3.0), &number(-2.0), 64), 3.0));
    assert!(is_exactly(fdim(&number(3.0), &number(5.0), 64), 0.0));
    assert!(is_exactly(fdim(&number(3.0), &number(-2.0), 64), 5.0));
    let both = fmin(&around(0.0, 1.0), &around(0.5, 1.0), 64).unwrap();
    assert!(
        both.lower() <= -1 && both.lower() > -1.001 && both.upper() >= 1 && both.upper() < 1.001
    );
    let size = fabs(&around(-0.5, 1.0), 64).unwrap();
    assert!(size.lower() >= 0 && size.upper() >= 1.5);
}

/// Values beyond the exponents of MPFR overflow, or are balls around zero.
#[test]
fn overflow_has_a_sign_and_underflow_a_ball() {
    let overflow = |found: Evaluated, due: bool| {
        assert_eq!(found.unwrap_err(), NoValue::Overflow { negative: due });
    };
    overflow(exp(&number(1e300), 64), false);
    overflow(exp(&around(1e300, 1e299), 64), false);
    overflow(sinh(&number(-1e10), 64), true);
    overflow(tgamma(&number(1e300), 64), false);
    overflow(erfcx(&number(-1e9), 64), false);
    overflow(erfi(&number(-1e9), 64), true);
    overflow(pow(&number(-2.0), &number(1_073_741_825.0), 64), true);
    let huge = powi(&number(2.0), 1 << 29, 64).unwrap();
    overflow(
        mul(&huge, &-&mul(&huge, &number(4.0), 64).unwrap(), 64),
        true,
    );
    overflow(sqr(&mul(&huge, &number(4.0), 64).unwrap(), 64), false);
    // From 2^(10^9) to e^(10^10): no overflow at every point.
    assert!(is_undecided(exp(&around(1e10, 9.5e9), 64)));
    for found in [
        exp(&number(-1e300), 64),
        erfc(&number(1e9), 64),
        tgamma(&number(-1e9 - 0.5), 64),
    ] {
        let ball = found.unwrap();
        assert!(ball.mid().is_zero() && !ball.rad().is_zero());
        assert!(ball.rad() < Mag::power_of_two(-(1 << 29)));
    }
    // The least number, halved: rounded to a number or to zero, it is off by less than a ball says.
    let least = Ball::new(Float::with_val(64, 1) << (exp_min() - 1), Mag::ZERO);
    for factor in [0.25, 0.75] {
        let part = mul(&least, &number(factor), 64).unwrap();
        assert!(part.rad() >= Mag::power_of_two(i64::from(exp_min()) - 3));
    }
    for f in [sin, cos] {
        let far = f(
            &Ball::new(Float::with_val(64, 1) << (1 << 29), Mag::ZERO),
            64,
        )
        .unwrap();
        assert!(far.lower() <= -1 && far.upper() >= 1);
    }
    // sin 10^300 (Muller et al., Handbook of Floating-Point Arithmetic, give sin 10^22).
    assert!(is_near(sin(&number(1e22), 64), -0.8522008497671888));
}

/// Far left of zero the expansion at infinity does not hold, however few bits are asked for.
#[test]
fn erfcx_left_of_zero_to_a_few_bits() {
    for x in [-600.0, -1000.5, -20_000.0] {
        let [few, more] = [2, 64].map(|prec| erfcx(&number(x), prec).unwrap());
        assert!(few.overlaps(&more), "{x}: {few:?}");
    }
    let beyond = erfcx(&number(-29_999.998), 2);
    assert_eq!(beyond.err(), Some(NoValue::Overflow { negative: false }));
}

#[test]
fn special_values() {
    for (found, due) in [
        (tgamma(&number(5.0), 64), 24.0),
        (lgamma(&number(1.0), 64), 0.0),
        (hypot(&number(3.0), &number(-4.0), 64), 5.0),
        (cbrt(&number(-27.0), 64), -3.0),
        (exp2(&number(-3.0), 64), 0.125),
        (log2(&number(0.125), 64), -3.0),
        (sinpi(&number(2.5), 64), 1.0),
        (cospi(&number(2.5), 64), 0.0),
        (acos(&number(1.0), 64), 0.0),
        (erf(&number(0.0), 64), 0.0),
        (erfcx(&number(0.0), 64), 1.0),
        (dawson(&number(0.0), 64), 0.0),
        (fma(&number(3.0), &number(5.0), &number(-15.0), 64), 0.0),
    ] {
        assert!(is_exactly(found.clone(), due), "{found:?} {due}");
    }
    for (found, due) in [
        (erfcx(&number(1.0), 64), 0.427_583_576_155_807),
        (erfcx(&number(1e200), 64), 5.641_895_835_477_563e-201),
        (erfi(&number(1.0), 64), 1.650_425_758_797_543),
        (erfi(&number(1e-200), 64), 1.128_379_167_095_512_6e-200),
        (dawson(&number(1.0), 64), 0.538_079_506_912_768_4),
        (dawson(&number(1e200), 64), 5e-201),
        (digamma(&number(1.0), 64), -0.577_215_664_901_532_9),
        (lgamma(&number(-0.5), 64), 1.265_512_123_484_645_4),
        (lgamma(&number(1e200), 64), 4.595_170_185_988_091e202),
        (
            voigt(&number(0.0), &number(0.0), &number(1.0), 64),
            std::f64::consts::FRAC_1_PI,
        ),
        (
            voigt(&number(0.0), &number(1.0), &number(0.0), 64),
            0.398_942_280_401_432_7,
        ),
        (
            voigt(&number(1.0), &number(1.0), &number(1.0), 64),
            0.165_795_662_689_166_46,
        ),
    ] {
        assert!(is_near(found.clone(), due), "{found:?} {due}");
    }
}
