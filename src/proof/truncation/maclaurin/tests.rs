use super::*;
use mechaudit_reference::{Ball, ComplexBall, faddeeva};
use rug::Rational;

/// `Σ_{n ≤ last} (iz)ⁿ/Γ(n/2 + 1)`
fn sum(x: f64, y: f64, last: u32) -> ComplexBall {
    let ball = |x: f64| Ball::exact(300, x);
    let iz = ComplexBall::new(ball(-y), ball(x));
    let root = Ball::pi(300).sqrt();
    let mut power = ComplexBall::new(ball(1.0), ball(0.0));
    let mut all = ComplexBall::new(ball(0.0), ball(0.0));
    for n in 0..=last {
        // Γ(n/2 + 1) = (n/2)(n/2 − 1)⋯, at the end 1 or √π/2.
        let mut gamma = Rational::from(1);
        let mut k = n;
        while k > 1 {
            gamma *= Rational::from((k, 2));
            k -= 2;
        }
        let mut gamma = Ball::rational(300, &gamma);
        if n % 2 == 1 {
            gamma = (&gamma * &root).shift(-1);
        }
        let term = power.scaled(&gamma.recip());
        all = &all + &term;
        power = &power * &iz;
    }
    all
}

/// Checks that what the series leaves out is below its bounds, on the axes and off, and not far
/// below.
#[test]
fn what_is_left_out_is_below_its_bounds() {
    for last in [8, 20] {
        let mut most = [0.0f64; 3];
        for (r, t) in [
            (0.45, 0.0f64),
            (0.45, 0.7),
            (0.45, 1.5),
            (0.2, 0.3),
            (0.44, -1.2),
            (0.1, -1.5),
        ] {
            let (x, y) = (r * t.cos(), r * t.sin());
            let exact = |x: f64| Rational::from_f64(x).expect("finite");
            let w = faddeeva::w(&exact(x), &exact(y), 300).expect("decided");
            let off = &w - &sum(x, y, last);
            let size = |b: &Ball| b.mid().to_f64().abs();
            let found = maclaurin(last, x.hypot(y).next_up().min(0.45));
            let parts = [
                (size(&off.norm_sqr().sqrt()), found.norm),
                (size(&off.re), found.re),
                (size(&off.im) / x, found.im),
            ];
            for (i, (off, bound)) in parts.into_iter().enumerate() {
                assert!(off <= bound, "{last} {x} {y} {i} {off:e} {bound:e}");
                most[i] = most[i].max(off / bound);
            }
        }
        assert!(most.into_iter().all(|m| m > 0.2), "{last} {most:?}");
    }
}

#[test]
fn beyond_its_disc_nothing_is_known() {
    let beyond = [0.45f64.next_up(), 0.5, f64::NAN].map(|r| [(8, r), (20, r)]);
    for (last, r) in beyond.into_iter().flatten().chain([(9, 0.1), (19, 0.1)]) {
        let found = maclaurin(last, r);
        assert!(
            [found.norm, found.re, found.im]
                .iter()
                .all(|x| x.is_infinite())
        );
    }
    let found = maclaurin(8, 0.45);
    // 2 r⁹/Γ(11/2) and 2 · 9 r⁸/Γ(11/2).
    let gamma = 945.0 * std::f64::consts::PI.sqrt() / 32.0;
    let near = |x: f64, due: f64| x >= due && x <= 1.002 * due;
    assert!(
        near(found.norm, 2.0 * 0.45f64.powi(9) / gamma)
            && near(found.im, 18.0 * 0.45f64.powi(8) / gamma)
    );
    let gamma = 13_749_310_575.0 * std::f64::consts::PI.sqrt() / 2048.0;
    let found = maclaurin(20, 0.45);
    assert!(
        near(found.norm, 2.0 * 0.45f64.powi(21) / gamma)
            && near(found.im, 42.0 * 0.45f64.powi(20) / gamma)
    );
    assert_eq!((found.re, found.tiny), (found.norm, 0.0));
}
