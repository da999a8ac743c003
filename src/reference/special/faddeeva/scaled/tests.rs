//! Exactly known arguments, and numbers with exponents of any size.

use super::super::argument::{Argument, Real};
use super::super::scaled::{Scaled, aligned};
use crate::{Ball, Mag};
use rug::float::Round;
use rug::{Float, Integer, Rational};

fn scaled(x: f64, exponent: i64) -> Scaled {
    Scaled::new(Ball::exact(80, x), Integer::from(exponent))
}

const REACH: i64 = 1 << 29;

/// Balls out of the exponents' reach: the whole line if too large, a tiny ball about zero if too
/// small.
#[test]
fn balls_at_the_ends_of_the_exponents() {
    for k in [1 - REACH, 0, REACH - 1] {
        let found = scaled(1.5, k);
        for ball in [found.to_ball(), found.to_ball_or_tiny()] {
            assert_eq!(*ball.mid(), Float::with_val(80, 1.5) << k as i32);
            assert!(ball.rad().is_zero());
        }
    }
    assert!(!scaled(1.5, REACH).to_ball().is_finite());
    assert!(!scaled(1.5, -REACH).to_ball().is_finite());
    assert!(!scaled(1.5, REACH).to_ball_or_tiny().is_finite());
    for x in [1.5, -1.5, 2.0] {
        let tiny = scaled(x, -REACH).to_ball_or_tiny();
        assert!(tiny.mid().is_zero());
        assert_eq!(tiny.rad(), Mag::power_of_two(1 - REACH));
    }
    // More than two times the power of two does not fit in.
    for x in [2.25, -3.0] {
        assert!(!scaled(x, -REACH).to_ball_or_tiny().is_finite());
    }
    let wide = Scaled::new(
        Ball::exact(80, 1.5).widened(Mag::from_f64(1.0)),
        Integer::from(-REACH),
    );
    assert!(!wide.to_ball_or_tiny().is_finite());
    for k in [-2 * REACH, 0, 2 * REACH] {
        assert!(scaled(0.0, k).to_ball().is_zero());
        assert!(scaled(0.0, k).to_ball_or_tiny().is_zero());
    }
    // Zero with a radius is not zero.
    let doubt = Ball::integer(80, 0).widened(Mag::from_f64(0.5));
    assert!(
        !Scaled::new(doubt, Integer::from(REACH))
            .to_ball()
            .is_finite()
    );
    let beyond = Scaled::new(Ball::exact(80, 1.0), Integer::from(1) << 80u32);
    assert!(!beyond.to_ball().is_finite() && !beyond.to_ball_or_tiny().is_finite());
}

/// Decimals with exponents that no float holds, next to those of floats: 2^k by its logarithm.
#[test]
fn decimals_of_any_size() {
    assert_eq!(scaled(1.0, 10).to_decimal(6).unwrap(), "1024.00");
    let direct = scaled(-1.5, 600).to_decimal(10).unwrap();
    assert_eq!(
        direct,
        Ball::exact(80, -1.5).shift(600).to_decimal(10).unwrap()
    );
    // log10 2 = 0.30102999566398119521… (OEIS A007524).
    let large = Integer::from(1_000_000_000);
    for (x, digits, due) in [
        (1.0, 5, "4.6130e301029995"),
        (-1.0, 5, "-4.6130e301029995"),
        (1.0, 1, "5e301029995"),
        (1.0, 0, "5e301029995"),
    ] {
        let number = Scaled::new(Ball::exact(80, x), large.clone());
        assert_eq!(number.to_decimal(digits).unwrap(), due);
    }
    let small = Scaled::new(Ball::exact(80, 1.0), -large);
    assert_eq!(small.to_decimal(5).unwrap(), "2.1678e-301029996");
    // Exponents far longer than 64 bits: 2^(2^100) by 2^100 log10 2, whose fraction is its digits.
    let k = Integer::from(1) << 100u32;
    let number = Scaled::new(Ball::exact(80, 1.0), k.clone());
    let log = Ball::rational(300, &Rational::from(&k))
        * &(Ball::integer(300, 2).ln() / &Ball::integer(300, 10).ln());
    let whole = log.mid().clone().floor();
    let fraction = Float::with_val(300, log.mid() - &whole);
    let lead = (Float::with_val(300, 10).ln() * fraction).exp();
    let text = number.to_decimal(12).unwrap();
    let (mantissa, exponent) = text.split_once('e').unwrap();
    assert_eq!(
        Integer::from_str_radix(exponent, 10).unwrap(),
        whole.to_integer().unwrap()
    );
    let mantissa: f64 = mantissa.parse().unwrap();
    assert!(
        (mantissa - lead.to_f64()).abs() < 1e-11,
        "{mantissa} {lead}"
    );
    // All digits of 80 bits, as MPFR writes this power, which its own exponents hold.
    let direct: Float = Float::with_val(80, 1.5) << 1_000_000_000i32;
    let (_, text, exponent) = direct.to_sign_string_exp_round(10, Some(24), Round::Nearest);
    let found = scaled(1.5, 1_000_000_000).to_decimal(24).unwrap();
    let due = format!("{}.{}e{}", &text[..1], &text[1..], exponent.unwrap() - 1);
    assert_eq!(found, due);
    // Not more digits than the radius allows.
    let rough = Ball::exact(80, 1.0).widened(Mag::from_f64(1e-8));
    let rough = Scaled::new(rough, Integer::from(1_000_000_000));
    assert!(rough.to_decimal(4).is_some() && rough.to_decimal(9).is_none());
    let nothing = Ball::exact(80, 1.0).widened(Mag::INFINITY);
    assert_eq!(Scaled::new(nothing, Integer::new()).to_decimal(1), None);
}

#[test]
fn alignment_is_to_the_larger_exponent() {
    let (a, b, k) = aligned(&scaled(1.5, 7), &scaled(1.25, 3));
    assert_eq!(
        (a.to_f64(), b.to_f64(), k),
        (1.5, 1.25 / 16.0, Integer::from(7))
    );
    let (a, b, k) = aligned(&scaled(0.0, 7), &scaled(1.25, 3));
    assert_eq!((a.to_f64(), b.to_f64(), k), (0.0, 1.25, Integer::from(3)));
    let (a, b, k) = aligned(&scaled(1.5, -9), &scaled(0.0, 3));
    assert_eq!((a.to_f64(), b.to_f64(), k), (1.5, 0.0, Integer::from(-9)));
}

/// Signs, zeros and balls of every kind of argument, and as many bits as they are written in.
#[test]
fn arguments_of_every_kind() {
    let q = |n: i32, d: i32| Rational::from((n, d));
    let all: [(Real, f64); 11] = [
        (Real::Double(1.5), 1.5),
        (Real::Double(-1.5), -1.5),
        (Real::Double(0.0), 0.0),
        (Real::Float(Float::with_val(90, -0.75)), -0.75),
        (Real::Float(Float::with_val(90, 0.0)), 0.0),
        (Real::Rational(q(-1, 3)), -1.0 / 3.0),
        (Real::Rational(q(0, 1)), 0.0),
        (Real::Root(false, q(1, 4)), 0.5),
        (Real::Root(true, q(1, 4)), -0.5),
        (Real::Root(true, q(0, 1)), 0.0),
        (Real::Root(false, q(2, 1)), std::f64::consts::SQRT_2),
    ];
    for (x, due) in all {
        assert_eq!(
            (x.is_zero(), x.is_negative()),
            (due == 0.0, due < 0.0),
            "{due}"
        );
        for prec in [30, 80, 300] {
            let ball = x.ball(prec);
            assert!((ball.to_f64() - due).abs() <= due.abs() * 1e-9);
            assert!(ball.is_zero() || ball.accuracy_bits() >= i64::from(prec) - 1);
            assert!((x.negated().ball(prec) + &ball).contains_zero());
        }
        assert_eq!(x.negated().is_negative(), due > 0.0);
    }
    // Floats and doubles are exact at any precision.
    let third = Float::with_val(200, 1) / 3u32;
    let ball = Real::Float(third.clone()).ball(20);
    assert!(ball.rad().is_zero() && *ball.mid() == third);
    assert!(Real::Double(1.0 / 3.0).ball(2).rad().is_zero());
    for (x, due) in [
        (1.0, 64),
        (2.0, 65),
        (0.25, 66),
        (1e300, 64 + 996),
        (1e-300, 64 + 997),
        (0.0, 64 + 1023),
    ] {
        assert_eq!(Real::Double(x).length(), due, "{x}");
    }
    assert_eq!(Real::Float(Float::with_val(90, 1)).length(), 122);
    assert_eq!(Real::Rational(q(5, 16)).length(), 8);
    assert_eq!(Real::Root(true, q(5, 16)).length(), 8);
}

/// |z|² from above in doubles, within 10^-12 of it, and its logarithm.
#[test]
fn sizes_of_arguments() {
    for (x, y) in [
        (3.0, 4.0),
        (0.1, -1e-9),
        (1e-200, 0.0),
        (1e160, 1.0),
        (0.7, 0.3),
    ] {
        let z = Argument::new(Real::Double(x), Real::Double(y));
        let exact = |x: f64| Rational::from_f64(x).unwrap().square();
        let norm = exact(x) + exact(y);
        let bound = z.norm_f64();
        if let Some(bound) = Rational::from_f64(bound) {
            assert!(
                bound >= norm
                    && bound
                        <= norm.clone()
                            * Rational::from((1_000_000_000_001_u64, 1_000_000_000_000_u64))
                    || norm < 1e-300
            );
        } else {
            assert!(norm > f64::MAX);
        }
        let log = Float::with_val(200, &norm).log2().to_f64();
        assert!((z.norm_log2() - log).abs() < 1e-9);
    }
    // Above by at least 1e-13 of it, what its own rounding may be.
    let z = Argument::new(Real::Double(3.0), Real::Double(4.0));
    assert!(z.norm_f64() / 25.0 - 1.0 > 0.9e-13);
}
