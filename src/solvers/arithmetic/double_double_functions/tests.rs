use super::super::tests::Random;
use super::super::tests::exact::{are_parts, error, gaussian, shifted, wide};
use super::*;
use crate::lanes::Plain;
use crate::numbers::One;
use mechaudit_reference::Ball;
use rug::{Float, Integer, Rational};
use std::f64::consts::FRAC_PI_4;

#[test]
fn constants() {
    assert!(are_parts(&Ball::integer(400, 2).ln(), &LN_2));
    for (n, parts) in INVERSE_FACTORIAL.iter().enumerate() {
        let exact = Rational::from((1, Integer::from(Integer::factorial(n as u32))));
        assert!(are_parts(&Ball::rational(400, &exact), parts), "1/{n}!");
    }
}

#[test]
fn exponential() {
    let mut random = Random(71);
    let mut worst = 0.0f64;
    for k in 0..10_000 {
        let x = match k % 3 {
            0 => random.between(-1499.0, 1499.0),
            1 => random.number(-60, 1),
            _ => random.between(-3.0, 3.0),
        };
        let x = two_sum(x, x * random.number(-70, -54));
        let (e, n) = exp::<_, false>(x);
        let exact = Float::with_val(640, wide(x).exp_ref());
        let off = error(&shifted(e, n), &exact, &exact);
        worst = worst.max(off);
        assert!(off < 2f64.powi(-98), "{x:?}: {off:e}");
    }
    println!("2^{:.2}", worst.log2());
}

#[test]
fn sine_and_cosine() {
    let mut random = Random(72);
    let mut worst = 0.0f64;
    for k in 0..10_000 {
        let x = if k % 3 == 0 {
            random.number(-80, -2)
        } else {
            random.between(-FRAC_PI_4, FRAC_PI_4)
        };
        let r = two_sum(x, x * random.number(-70, -54));
        let zero = (Dd::ZERO, ROUND);
        let [(s, c), other] =
            factors::<_, false>(One(Plain), [(r, ROUND), zero], [Dd::ZERO; 2]).circle;
        assert_eq!((other.0.hi, other.1.hi), (0.0, 1.0));
        let [other, same] =
            factors::<_, false>(One(Plain), [zero, (r, ROUND)], [Dd::ZERO; 2]).circle;
        assert_eq!((other.0.hi, other.1.hi), (0.0, 1.0));
        assert_eq!(same, (s, c));
        let exact = wide(r);
        let (es, ec) = (
            Float::with_val(640, exact.sin_ref()),
            Float::with_val(640, exact.cos_ref()),
        );
        let off = error(&wide(s), &es, &es).max(error(&wide(c), &ec, &ec));
        worst = worst.max(off);
        assert!(off < 2f64.powi(-100), "{r:?}: {off:e}");
    }
    println!("2^{:.2}", worst.log2());
}

/// Both components, by the modulus: a reduced phase has an absolute error.
#[test]
fn gaussian_of_a_complex_number() {
    let mut random = Random(73);
    let (mut worst, mut short) = (0.0f64, 0.0f64);
    for k in 0..8000 {
        let (a, y) = match k % 3 {
            0 => (random.between(0.0, 26.0), random.between(-26.0, 26.0)),
            1 => {
                let a = random.power(0.0, 26.0);
                (a, -a + random.between(-300.0, 300.0) / a)
            }
            _ => {
                let a = random.power(0.0, 300.0);
                (a, -a)
            }
        };
        if exponent(a, y).hi.abs() > 1400.0 {
            continue;
        }
        let ((c, s, n), ..) = exp_minus_square(One(Plain), a, -y, Dd::ZERO, Dd::ZERO);
        let exact = gaussian(a, y);
        let size = Float::with_val(640, exact.0.hypot_ref(&exact.1));
        let off =
            error(&shifted(c, n), &exact.0, &size).max(error(&shifted(s, n), &exact.1, &size));
        worst = worst.max(off);
        // The exponent, up to 1400, has a relative error of a few 2⁻¹⁰⁶.
        assert!(off < 2f64.powi(-92), "{a:e} {y:e}: {off:e}");
        let zero = Dd::ZERO;
        let ((c, s, n), ..) = exp_minus_square_to::<_, true>(One(Plain), a, -y, zero, zero);
        let off =
            error(&shifted(c, n), &exact.0, &size).max(error(&shifted(s, n), &exact.1, &size));
        short = short.max(off);
        assert!(off < 2f64.powi(-68), "{a:e} {y:e}: {off:e}");
    }
    println!("2^{:.2} 2^{:.2}", worst.log2(), short.log2());
}
