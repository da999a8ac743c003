use super::super::tests::Random;
use super::super::tests::exact::{are_parts, error, gaussian, rational, w, wide};
use super::*;
use crate::lanes::Plain;
use mechaudit_reference::Ball;
use rug::ops::Pow;
use rug::{Float, Rational};

#[test]
fn constants() {
    assert!(are_parts(&Ball::pi(300).shift(1), &[TWO_PI.hi, TWO_PI.lo]));
    let part = Ball::pi(300).shift(1) / &Ball::integer(300, 23);
    assert!(are_parts(&part, &[TWO_PI_OVER_PER.hi, TWO_PI_OVER_PER.lo]));
    for rule in 0..2 {
        for k in 0..NODES {
            let t = Rational::from(((2 * k + rule) as u64 * 23, 128u32));
            let tau = TRAPEZOIDAL_NODES[rule][k];
            assert_eq!(rational(tau), t.pow(2));
            let factor = Rational::from((if tau == 0.0 { 23u32 } else { 46 }, 64u32));
            let weight = Ball::rational(300, &factor) * &Ball::exact(300, -tau).exp();
            let [high, low] = &TRAPEZOIDAL_WEIGHTS[rule];
            assert!(are_parts(&(weight / &Ball::pi(300)), &[high[k], low[k]]));
        }
    }
}

/// The error of each component by the larger of the terms it is the sum of.
fn check(a: f64, b: f64) -> f64 {
    let (re, im, _) = lower(One(Plain), a, b);
    let exact = w(a, -b);
    let (u, v) = w(a, b);
    let (c, s) = gaussian(a, -b);
    let larger = |x: Float, y: Float| {
        let (x, y) = (x.abs(), y.abs());
        if x > y { x } else { y }
    };
    error(&wide(re), &exact.0, &larger(u, c * 2)).max(error(&wide(im), &exact.1, &larger(v, s * 2)))
}

#[test]
fn where_terms_cancel() {
    let mut random = Random(91);
    let mut worst = (0.0f64, 0.0, 0.0);
    for k in 0..6000 {
        let (a, b) = match k % 3 {
            // Beside the diagonal.
            0 => {
                let a = random.power(0.0, 12.0);
                (a, a + random.between(-30.0, 6.0) / a)
            }
            // In the strip beside the real axis, where the terms of the real part cancel.
            1 => (random.between(1.0, 27.5), random.power(-1000.0, -3.0)),
            _ => (random.between(1.0, 7.0), random.between(0.1, 7.0)),
        };
        if b < 0.0 || (b - a) * (b + a) > 300.0 {
            continue;
        }
        let off = check(a, b);
        if off > worst.0 {
            worst = (off, a, b);
        }
    }
    println!("2^{:.2} at {:e} − {:e} i", worst.0.log2(), worst.1, worst.2);
    assert!(worst.0 < 2f64.powi(-92), "{worst:?}");
}
