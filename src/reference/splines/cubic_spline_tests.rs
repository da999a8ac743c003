//! Tests of `cubic_spline`.

use super::*;
use crate::pinned::{Answers, Draw, pin};

fn q(v: &[i32]) -> Vec<Rational> {
    v.iter().map(|&v| v.into()).collect()
}

/// Interpolation, smoothness and the given end conditions, exactly.
fn check(s: &Spline) {
    let n = s.x.len() - 1;
    for i in 0..n {
        assert_eq!(s.eval_on(i, &s.x[i])[0], s.y[i]);
        assert_eq!(s.eval_on(i, &s.x[i + 1])[0], s.y[i + 1]);
        if i > 0 {
            assert_eq!(s.eval_on(i - 1, &s.x[i])[..3], s.eval_on(i, &s.x[i])[..3]);
        }
    }
}

#[test]
fn every_kind_meets_its_conditions() {
    for n in 1..9usize {
        let x: Vec<Rational> = (0..=n)
            .map(|i| Rational::from((i * i + 2 * i, 3)))
            .collect();
        let mut y: Vec<Rational> = (0..=n).map(|i| Rational::from((i * i * 7) % 11)).collect();
        let (u, v) = (Rational::from(3), Rational::from(-5));
        let s = Spline::second_derivatives(&x, &y, &u, &v).unwrap();
        check(&s);
        assert_eq!(s.eval(&x[0])[2], u);
        assert_eq!(s.eval(&x[n])[2], v);
        let s = Spline::clamped(&x, &y, &u, &v).unwrap();
        check(&s);
        assert_eq!((&s.eval(&x[0])[1], &s.eval(&x[n])[1]), (&u, &v));
        let s = Spline::not_a_knot(&x, &y).unwrap();
        check(&s);
        if n > 1 {
            assert_eq!(s.eval(&x[0])[3], s.eval(&x[1])[3]);
            assert_eq!(s.eval(&x[n - 2])[3], s.eval(&x[n])[3]);
        }
        assert_eq!(Spline::periodic(&x, &y).is_ok(), y[0] == y[n]);
        y[n] = y[0].clone();
        let s = Spline::periodic(&x, &y).unwrap();
        check(&s);
        assert_eq!(s.eval(&x[0])[..3], s.eval(&x[n])[..3]);
    }
}

#[test]
fn a_cubic_is_reproduced_and_integrated() {
    let f = |x: &Rational| x.clone().square() * x - Rational::from(x * 2) + 5u32;
    let x: Vec<Rational> = [0, 1, 4, 5, 9]
        .iter()
        .map(|&v| Rational::from((v, 2)))
        .collect();
    let y: Vec<Rational> = x.iter().map(f).collect();
    let ends = (Rational::from(-2), Rational::from((235, 4)));
    for s in [
        Spline::not_a_knot(&x, &y),
        Spline::clamped(&x, &y, &ends.0, &ends.1),
    ] {
        let s = s.unwrap();
        for k in -3..12 {
            let at = Rational::from((k, 3));
            assert_eq!(s.eval(&at)[0], f(&at));
            assert_eq!(s.eval(&at)[3], 6);
        }
        // x⁴/4 − x² + 5x from 1/3 to 4.
        let g = |x: &Rational| {
            x.clone().square().square() / 4 - x.clone().square() + Rational::from(x * 5)
        };
        let (a, b) = (Rational::from((1, 3)), Rational::from(4));
        assert_eq!(s.integral(&a, &b), g(&b) - g(&a));
        assert_eq!(s.integral(&b, &a), g(&a) - g(&b));
    }
}

#[test]
fn refusals() {
    assert_eq!(
        Spline::natural(&q(&[1]), &q(&[1])).unwrap_err(),
        SplineError::TooFew(1)
    );
    assert_eq!(
        Spline::natural(&q(&[1, 1]), &q(&[1, 2])).unwrap_err(),
        SplineError::NotIncreasing(1)
    );
    assert!(matches!(
        Spline::natural(&q(&[1, 2]), &q(&[1])),
        Err(SplineError::Length { .. })
    ));
    assert!(periodic_uniform(&[], &Ball::integer(64, 1)).is_err());
}

#[test]
fn balls_hold_the_exact_periodic_spline() {
    for n in 1..14usize {
        let y: Vec<Rational> = (0..=n).map(|i| Rational::from((i % n * 5) % 7)).collect();
        let h = Rational::from((1, 3));
        let x: Vec<Rational> = (0..=n).map(|i| Rational::from(&h * i as u32)).collect();
        let s = Spline::periodic(&x, &y).unwrap();
        let balls: Vec<Ball> = y[..n].iter().map(|y| Ball::rational(100, y)).collect();
        let b = periodic_uniform(&balls, &Ball::rational(100, &h)).unwrap();
        let all = b.second_derivatives();
        assert_eq!(all.len(), n);
        for (i, m) in all.iter().enumerate() {
            assert!(m.contains(&s.eval(&x[i])[2]));
            assert!(m.rad().is_zero() || m.rad().exponent().unwrap() < -90);
            for k in [
                Rational::new(),
                Rational::from((1, 3)),
                Rational::from((7, 8)),
            ] {
                let at = Rational::from(&h * &k) + &x[i];
                let truth = s.eval(&at);
                assert!(b.value(i, &k).contains(&truth[0]));
                assert!(b.derivative(i + n, &k).contains(&truth[1]));
                assert!(b.value(i, &k).rad().to_f64() < 1e-27);
            }
        }
    }
}

#[test]
fn periodic_splines_bit_by_bit() {
    let lines = [24, 64, 128].map(|bits| {
        Answers::line(bits, |all| {
            let mut draw = Draw(u64::from(bits));
            for n in [1, 2, 3, 5, 8] {
                let values: Vec<Ball> = (0..n).map(|_| draw.ball(bits, -2, 2)).collect();
                for wide in [24, 64, 90, 150] {
                    let h = Ball::rational(wide, &draw.between(1, 2));
                    let spline = periodic_uniform(&values, &h).unwrap();
                    all.add(&spline.second_derivatives());
                    for segment in 0..=n {
                        let k = (draw.fraction() + 1u32) / 2u32;
                        all.add(&[spline.value(segment, &k), spline.derivative(segment, &k)]);
                    }
                }
            }
        })
    });
    pin(
        &[
            "24: bec8c5d6, 1 to 9 bits",
            "64: 94b4798a, -2 to 7 bits",
            "128: 8f93f72d, 1 to 23 bits",
        ],
        lines,
    );
}
