//! Tests of `cubic_spline`.

use super::*;

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

/// Each pair of conditions is met, and a cubic comes back from any pair.
#[test]
fn mixed_ends_meet_their_conditions() {
    let (u, v) = (Rational::from(3), Rational::from((-5, 2)));
    let ends = |v| {
        [
            End::FirstDerivative(v),
            End::SecondDerivative(v),
            End::NotAKnot,
        ]
    };
    let cube = |x: &Rational| x.clone().square() * x;
    for n in 1..7usize {
        let x: Vec<Rational> = (0..=n).map(|i| Rational::from((i * i + i, 2))).collect();
        let y: Vec<Rational> = (0..=n).map(|i| Rational::from((i * i * 5) % 7)).collect();
        for (i, first) in ends(&u).into_iter().enumerate() {
            for (j, last) in ends(&v).into_iter().enumerate() {
                let s = Spline::with_ends(&x, &y, first, last);
                if n == 1 && (i == 2) != (j == 2) {
                    assert_eq!(s.unwrap_err(), SplineError::TooFew(2));
                    continue;
                }
                let s = s.unwrap();
                check(&s);
                if i < 2 {
                    assert_eq!(s.eval(&x[0])[i + 1], u);
                } else if n > 1 {
                    assert_eq!(s.eval_on(0, &x[1])[3], s.eval_on(1, &x[1])[3]);
                }
                if j < 2 {
                    assert_eq!(s.eval(&x[n])[j + 1], v);
                } else if n > 1 {
                    assert_eq!(s.eval_on(n - 2, &x[n])[3], s.eval_on(n - 1, &x[n])[3]);
                }
            }
        }
        // Of x³ slope and second derivative are 3x² and 6x.
        let y: Vec<Rational> = x.iter().map(cube).collect();
        let slope = x[n].clone().square() * 3;
        let (zero, bend) = (Rational::new(), Rational::from(&x[n] * 6));
        for (first, last) in [
            (End::FirstDerivative(&zero), End::SecondDerivative(&bend)),
            (End::SecondDerivative(&zero), End::FirstDerivative(&slope)),
        ] {
            let s = Spline::with_ends(&x, &y, first, last).unwrap();
            let at = Rational::from((2, 3));
            assert_eq!(s.eval(&at)[0], cube(&at));
        }
    }
}

/// Values come back after each period, and integrals add up over it.
#[test]
fn periods_repeat() {
    let s = Spline::periodic(&q(&[1, 2, 4, 6]), &q(&[3, -1, 2, 3])).unwrap();
    let (a, b) = (Rational::from((3, 2)), Rational::from((11, 3)));
    let whole = s.integral(&Rational::from(1), &Rational::from(6));
    let inside = s.integral(&a, &b);
    for m in -3..4 {
        let far = Rational::from(&b + 5 * m);
        assert_eq!(s.eval_periodic(&far), s.eval(&b));
        let due = Rational::from(&whole * m) + &inside;
        assert_eq!(s.integral_periodic(&a, &far), due);
        assert_eq!(s.integral_periodic(&far, &a), -due);
    }
    // The last knot is the first one of the next period.
    assert_eq!(
        s.eval_periodic(&Rational::from(11))[3],
        s.eval(&Rational::from(1))[3]
    );
    assert_eq!(
        s.eval_periodic(&Rational::from(6))[3],
        s.eval(&Rational::from(6))[3]
    );
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
