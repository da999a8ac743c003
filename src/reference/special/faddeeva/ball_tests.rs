//! w over balls: the bound on its derivative, and what is not finite.

use super::*;

/// A ball about x + iy.
fn about(x: f64, y: f64, rx: f64, ry: f64) -> ComplexBall {
    let ball = |x: f64, r: f64| Ball::exact(64, x).widened(Mag::from_f64(r));
    ComplexBall::new(ball(x, rx), ball(y, ry))
}

/// Balls with the case of the bound: near the axis from below (small or not), in the closed
/// half-plane next to the origin, away from it, and far out.
fn balls() -> Vec<ComplexBall> {
    vec![
        about(0.5, -0.25, 0.125, 0.125),
        about(3.0, 0.0, 0.03125, 0.03125),
        about(20.0, -0.5, 0.015625, 0.0),
        about(0.5, -1.5, 0.25, 0.25),
        about(2.0, 0.25, 0.5, 0.5),
        about(0.25, 0.5, 0.25, 0.5),
        about(0.75, 0.25, 0.0625, 0.25),
        about(1.25, 0.5, 0.0625, 0.25),
        about(1.5, 1.5, 0.25, 0.5),
        about(5.0, 0.5, 0.5, 0.5),
        about(-40.0, 3.0, 2.0, 1.0),
        about(0.0, 300.0, 1.0, 2.0),
    ]
}

fn middle(z: &ComplexBall) -> ComplexBall {
    let of = |part: &Ball| Ball::new(part.mid().clone(), Mag::ZERO);
    ComplexBall::new(of(&z.re), of(&z.im))
}

fn size_at_mid(z: &ComplexBall) -> Mag {
    w_ball(&middle(z), 64).magnitude()
}

/// No |w′| of the ball is beyond the bound, and none of the bounds is more than six times as large;
/// across the axis, where `−2zw` cancels most of `2i/√π`, ten |z|² times.
#[test]
fn slopes_hold_and_are_near() {
    for z in balls() {
        let bound = slope(&z, z.radius(), size_at_mid(&z)).to_f64();
        let mut most = 0.0f64;
        for (s, t) in (-4..=4).flat_map(|s| (-4..=4).map(move |t| (s, t))) {
            let at = |part: &Ball, k: i32| {
                let off = Rational::from_f64(part.rad().to_f64()).unwrap() * Rational::from((k, 4));
                part.mid().to_rational().unwrap() + off
            };
            let d = w_derivative(1, &at(&z.re, s), &at(&z.im, t), 60).unwrap();
            most = most.max(d.magnitude().to_f64());
        }
        assert!(most <= bound * (1.0 + 1e-14), "{z:?}: {most} {bound}");
        let far = z.magnitude().to_f64();
        let generous = if z.im.lower() < 0 {
            6.0f64.max(10.0 * far * far)
        } else {
            6.0
        };
        assert!(most * generous > bound, "{z:?}: {most} {bound}");
    }
}

/// The formulas, written out in doubles.
#[test]
fn slopes_are_those_of_the_formulas() {
    let flat = FRAC_2_SQRT_PI;
    for z in balls() {
        let (rho, size) = (z.radius().to_f64(), size_at_mid(&z));
        let low = z.im.mid().to_f64() - z.im.rad().to_f64();
        let (far, near) = (z.magnitude().to_f64(), z.mignitude().to_f64());
        let t = 2.0 * far * rho;
        let due = if low < 0.0 && t <= 1.0 {
            2.0 * far * (1.0 + 2.0 * t) * (size.to_f64() + flat * rho) + flat
        } else if low < 0.0 {
            flat + 4.0 * low.abs() * (low * low).exp()
        } else if near < 1.0 {
            flat
        } else {
            let inverse = 1.0 / (near * near);
            flat.min(inverse * (0.5642 + 3.07 * inverse))
        };
        let bound = slope(&z, z.radius(), size).to_f64();
        assert!(bound >= due * (1.0 - 1e-12), "{z:?}: {bound} {due}");
        assert!(bound <= due * (1.0 + 1e-6), "{z:?}: {bound} {due}");
    }
    // On both sides of t = 1: 2 · 2 · 0.25 and a little more.
    let size = Mag::from_f64(1.0);
    let z = about(1.0, 0.0, 1.0, 0.0).widened(Mag::ZERO);
    let lower = |rho: f64| {
        let z = ComplexBall::new(z.re.clone(), Ball::exact(64, -1e-30));
        slope(&z, Mag::from_f64(rho), size).to_f64()
    };
    let grown = 4.0 * 3.0 * (1.0 + 0.2499 * flat) + flat;
    assert!((lower(0.2499) / grown - 1.0).abs() < 1e-3);
    assert!((lower(0.2501) / flat - 1.0).abs() < 1e-9);
}

/// Wider than the midpoint's value by the radius times the slope; the whole plane for what is not
/// finite.
#[test]
fn balls_are_widened_by_the_slope() {
    for z in balls() {
        let w = w_ball(&z, 64);
        let mid = w_ball(&middle(&z), 64);
        let due = z
            .radius()
            .mul(slope(&z, z.radius(), mid.magnitude()))
            .to_f64();
        for part in [&w.re, &w.im] {
            assert!((part.rad().to_f64() / due - 1.0).abs() < 1e-9);
        }
    }
    let endless = about(1.0, 1.0, f64::INFINITY, 0.0);
    let none = ComplexBall::new(Ball::exact(64, f64::NAN), Ball::exact(64, 1.0));
    for z in [endless, none] {
        let w = w_ball(&z, 64);
        assert!(!w.re.is_finite() && !w.im.is_finite());
    }
    // No fewer bits than the evaluations take.
    let coarse = w_ball(&about(1.0, 1.0, 0.0, 0.0), 2);
    let fine = w_f64(1.0, 1.0, 80).unwrap();
    assert!(coarse.re.overlaps(&fine.re) && coarse.im.overlaps(&fine.im));
}

/// To the last bit no bound is below its formula `2/√π + 4h e^{h²}`, with an h of more bits than a
/// bound has.
#[test]
fn slopes_are_rounded_up() {
    let root = Ball::pi(300).sqrt();
    for k in 1..=300 {
        let low = Float::with_val(64, -k) / 47u32;
        let z = ComplexBall::new(Ball::exact(64, 3.0), Ball::new(low.clone(), Mag::ZERO));
        // A radius with which t is above 1.
        let bound = slope(&z, Mag::from_f64(0.5), Mag::from_f64(1.0));
        let h = Ball::new(Float::with_val(300, -low), Mag::ZERO);
        let due = Ball::integer(300, 2) / &root + (&h * &h.square().exp()).shift(2);
        assert!(due.upper() <= bound.to_float(), "{k}");
        assert!(due.magnitude().mul(Mag::from_f64(1.0 + 1e-14)) > bound);
    }
}

/// Far below the axis w is large, at few bits its radius is too, and the slope is that of the
/// largest |w|.
#[test]
fn slopes_take_the_whole_ball_at_the_midpoint() {
    for x in [0.5, -3.0, 0.0] {
        let z = about(x, -16384.0, 0.0, 2f64.powi(-16));
        let (w, mid) = (w_ball(&z, 16), w_ball(&middle(&z), 16));
        assert!(!mid.radius().is_zero());
        let due = z.radius().mul(slope(&z, z.radius(), mid.magnitude()));
        assert!(w.re.rad() >= due && w.im.rad() >= due, "{x}");
    }
}

#[test]
fn arguments_that_are_not_finite_are_refused() {
    let odd = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
    for (x, y) in odd.into_iter().flat_map(|x| [(x, 1.0), (1.0, x), (x, x)]) {
        let [a, b] = [x, y].map(|x| Float::with_val(53, x));
        for refused in [w_f64(x, y, 60), w_float(&a, &b, 60)] {
            let refused = refused.unwrap_err();
            assert!(refused.bits == 60 && refused.reason.contains("not finite"));
        }
    }
    assert!(w_f64(1.0, -1.0, 60).is_ok());
}

/// Derivatives of any order are those of the Taylor series, as many as asked for.
#[test]
fn derivatives_are_coefficients_times_factorials() {
    let q = |x: f64| Rational::from_f64(x).unwrap();
    for (x, y) in [
        (0.5, 0.25),
        (-3.0, 2.0),
        (1.0, -2.0),
        (0.0, 3.0),
        (6.0, 0.0),
    ] {
        let (x, y) = (q(x), q(y));
        let all = taylor(&x, &y, 6, 90).unwrap();
        assert_eq!(all.len(), 7);
        for (n, c) in all.iter().enumerate() {
            let factorial = Ball::integer(160, (1..=n as i64).product());
            let due = c.scaled(&factorial);
            let found = w_derivative(n, &x, &y, 80).unwrap();
            assert!(
                found.re.overlaps(&due.re) && found.im.overlaps(&due.im),
                "{n}"
            );
            assert!(c.radius() <= c.mignitude().shift(-90));
            for part in [&found.re, &found.im] {
                assert!(part.is_zero() || part.accuracy_bits() >= 80);
            }
        }
        assert_eq!(taylor(&x, &y, 0, 90).unwrap().len(), 1);
    }
    // w″ = 4z² w − 4iz/√π − 2w at z = i: (−6) erfcx(1) + 4/√π.
    let found = w_derivative(2, &q(0.0), &q(1.0), 100).unwrap();
    let w = w(&q(0.0), &q(1.0), 120).unwrap();
    let due = w.re * Ball::integer(200, -6) + Ball::integer(200, 4) / &Ball::pi(200).sqrt();
    assert!(found.re.overlaps(&due) && found.im.is_zero());
}

/// At few bits too a coefficient is told from zero: c_6 far up the imaginary axis loses 80 bits.
#[test]
fn coefficients_of_few_bits() {
    let q = |x: f64| Rational::from_f64(x).unwrap();
    for (x, y) in [(0.0, 1000.0), (3.0, 4000.0), (0.0, 30.0)] {
        let fine = taylor(&q(x), &q(y), 6, 60).unwrap();
        for bits in [0, 1, 2, 5] {
            for (c, fine) in taylor(&q(x), &q(y), 6, bits).unwrap().iter().zip(&fine) {
                assert!(c.radius() <= c.mignitude().shift(-i64::from(bits)));
                assert!(c.overlaps(fine));
            }
        }
    }
}

/// The coefficient of order 300 at 2^20 i loses more than 10 000 bits: the order counts for the
/// cap.
#[test]
fn coefficients_of_high_order() {
    let (x, y) = (Rational::new(), Rational::from(1 << 20));
    let all = taylor(&x, &y, 300, 20).unwrap();
    assert_eq!(all.len(), 301);
    // |c_n| is about 1/(√π y^(n + 1)).
    let log = |c: &ComplexBall| {
        let (m, e) = c.re.mid().to_f64_exp();
        let (n, f) = c.im.mid().to_f64_exp();
        if m == 0.0 {
            n.abs().log2() + f64::from(f)
        } else {
            m.abs().log2() + f64::from(e)
        }
    };
    for (n, c) in all.iter().enumerate() {
        assert!(c.radius() <= c.mignitude().shift(-20));
        let due = -20.0 * (n as f64 + 1.0) - std::f64::consts::PI.log2() / 2.0;
        assert!((log(c) - due).abs() < 1e-6, "{n}");
    }
}

/// Where |w| is beyond every exponent neither coefficients nor derivatives are balls; the first has
/// them scaled.
#[test]
fn what_no_exponent_holds_has_no_coefficients() {
    let (x, y) = (Rational::from(1), Rational::from(-1_000_000));
    for (n, bits) in [(0, 20), (1, 20), (4, 50)] {
        let open = taylor(&x, &y, n, bits).unwrap_err();
        assert!(open.bits >= 4 * bits + 4096, "{}", open.bits);
        assert!(open.reason.contains("cannot be told from zero"));
    }
    let first = w_derivative(1, &x, &y, 40).unwrap_err();
    assert!(first.reason.contains("binary exponent"));
    let second = w_derivative(2, &x, &y, 40).unwrap_err();
    assert!(second.reason.contains("cannot be told from zero"));
    // w′ = −2zw but for 2i/√π.
    let [re, im] = w_derivative_scaled(&x, &y, 40).unwrap();
    let [u, v] = w_scaled(&x, &y, 60).unwrap();
    let times =
        |s: &Scaled, k: i64| Scaled::new(&s.ball * &Ball::integer(64, k), s.exponent.clone());
    let sum = |a: &Scaled, b: &Scaled| {
        let (a, b, k) = scaled::aligned(a, b);
        Scaled::new(a + &b, k)
    };
    let due = [
        sum(&times(&u, -2), &times(&v, -2_000_000)),
        sum(&times(&u, 2_000_000), &times(&v, -2)),
    ];
    for (found, due) in [re, im].iter().zip(&due) {
        let (a, b, _) = scaled::aligned(found, due);
        assert!(a.overlaps(&b) && found.ball.accuracy_bits() >= 40);
    }
}
