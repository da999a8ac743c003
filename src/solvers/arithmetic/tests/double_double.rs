//! Double-double arithmetic against rational numbers, in units of u² = 2⁻¹⁰⁶.

use super::Random;
use super::exact::{in_squares, rational, sum};
use crate::double_double::{Dd, fast_two_sum, sign_of_sum, two_prod, two_sum};
use rug::Rational;

const SAMPLES: usize = 40_000;

/// A double-double number; the exponents of two of them are close together half of the time, so
/// that sums cancel.
fn number(random: &mut Random, reach: i32) -> Dd {
    let hi = random.number(-reach, reach);
    let lo = match random.below(8) {
        0 => 0.0,
        1 => hi * f64::EPSILON * 0.5 * if random.below(2) == 0 { 1.0 } else { -1.0 },
        _ => hi * random.number(-70, -54),
    };
    two_sum(hi, lo)
}

/// The largest error of an operation.
fn worst(f: impl Fn(Dd, Dd) -> (Dd, Rational)) -> f64 {
    let mut random = Random(1);
    let mut worst = 0.0f64;
    for k in 0..SAMPLES {
        let reach = if k % 2 == 0 { 1 } else { 60 };
        let (a, b) = (number(&mut random, reach), number(&mut random, reach));
        let (got, exact) = f(a, b);
        if exact == 0 {
            assert_eq!(got.hi, 0.0, "{a:?} {b:?}");
            continue;
        }
        let error = in_squares(got, &exact);
        assert!(
            error <= 10.0 && got.hi == got.hi + got.lo,
            "{a:?} {b:?}: {got:?}, {error} u²"
        );
        worst = worst.max(error);
    }
    worst
}

#[test]
fn transformations_are_exact() {
    let mut random = Random(2);
    for _ in 0..SAMPLES {
        let (a, b) = (random.number(-80, 80), random.number(-80, 80));
        let (p, q) = (rational(a), rational(b));
        assert_eq!(sum(two_sum(a, b)), Rational::from(&p + &q), "{a:e} {b:e}");
        let (c, d) = if a.abs() < b.abs() { (b, a) } else { (a, b) };
        assert_eq!(
            sum(fast_two_sum(c, d)),
            Rational::from(&p + &q),
            "{a:e} {b:e}"
        );
        assert_eq!(sum(two_prod(a, b)), p * q, "{a:e} {b:e}");
    }
    assert_eq!(sum(fast_two_sum(0.0, 3.5)), 3.5);
}

#[test]
fn operations_keep_their_bounds() {
    // The bounds quoted at the operations; AccurateDWPlusDW's 3u²/(1 − 4u) is 3u² to 15 digits.
    let slack = 1.0 + 1e-12;
    let sum_error = worst(|a, b| (a + b, sum(a) + sum(b)));
    assert!(sum_error <= 3.0 * slack, "{sum_error}");
    let difference = worst(|a, b| (a - b, sum(a) - sum(b)));
    assert!(difference <= 3.0 * slack, "{difference}");
    let product = worst(|a, b| (a * b, sum(a) * sum(b)));
    assert!(product <= 4.0, "{product}");
    let square = worst(|a, _| (a.square(), sum(a).square()));
    assert!(square <= 5.0, "{square}");
    let plus = worst(|a, b| (a.add_f(b.hi), sum(a) + rational(b.hi)));
    assert!(plus <= 2.0, "{plus}");
    let times = worst(|a, b| (a.mul_f(b.hi), sum(a) * rational(b.hi)));
    assert!(times <= 2.0, "{times}");
    let quotient = worst(|a, b| (a.div(b), sum(a) / sum(b)));
    assert!(quotient <= 10.0, "{quotient}");
    println!("{sum_error} {difference} {product} {square} {plus} {times} {quotient}");
}

#[test]
fn signs_and_powers_of_two_are_exact() {
    let mut random = Random(3);
    for _ in 0..1000 {
        let a = number(&mut random, 60);
        assert_eq!(sum(-a), -sum(a));
        assert_eq!(sum(a.scale(0.125)), sum(a) / 8u32);
        assert_eq!(sum(a.normal()), sum(a));
        assert_eq!(sum(Dd::from(a.hi)), a.hi);
        assert_eq!(a.value(), sum(a).to_f64_nearest());
    }
}

/// Rounding to the nearest.
trait Nearest {
    fn to_f64_nearest(&self) -> f64;
}

impl Nearest for Rational {
    fn to_f64_nearest(&self) -> f64 {
        rug::Float::with_val(53, self).to_f64()
    }
}

#[test]
fn signs_are_exact() {
    assert_eq!(sign_of_sum(&[1.0, 1e-30, -1.0]), 1.0);
    assert_eq!(sign_of_sum(&[1e-30, 1.0, -1.0, -1e-30]), 0.0);
    assert_eq!(sign_of_sum(&[0.1, 0.2, -0.3]), 1.0);
    assert_eq!(sign_of_sum(&[0.3, -0.1, -0.2]), -1.0);
    assert_eq!(sign_of_sum(&[]), 0.0);
}
