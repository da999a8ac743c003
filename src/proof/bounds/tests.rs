use super::*;
use mechaudit_reference::faddeeva;
use rug::Rational;

/// `|w − S_N|` at points of the quadrant is below the bounds, and not far below where it is
/// largest.
#[test]
fn remainders() {
    for (x, y) in [(7.0, 0.0), (7.0, 0.5), (5.0, 5.0), (0.25, 7.0), (9.0, 1.0)] {
        let z = (
            Rational::from_f64(x).unwrap(),
            Rational::from_f64(y).unwrap(),
        );
        let w = faddeeva::w(&z.0, &z.1, 200).unwrap();
        let r = Rational::from(z.0.square_ref()) + Rational::from(z.1.square_ref());
        // q = 1/z² and i/(√π z), exactly but for √π.
        let (qr, qi) = (
            (Rational::from(z.0.square_ref()) - Rational::from(z.1.square_ref()))
                / Rational::from(r.square_ref()),
            Rational::from(-2) * &z.0 * &z.1 / Rational::from(r.square_ref()),
        );
        for n in [10u32, 17, 27] {
            let (mut re, mut im) = (Rational::new(), Rational::new());
            for k in (0..n).rev() {
                // 1 + (k + ½) q (…)
                let f = Rational::from((2 * i64::from(k) + 1, 2));
                let p = (Rational::from(&re * &qr) - Rational::from(&im * &qi)) * &f + 1u32;
                im = (Rational::from(&re * &qi) + Rational::from(&im * &qr)) * f;
                re = p;
            }
            // i z̄/(√π r)
            let (a, b) = (&z.0 * &re, &z.1 * &re);
            let (a, b) = (Rational::from(a), Rational::from(b));
            let (c, d) = (Rational::from(&z.0 * &im), Rational::from(&z.1 * &im));
            let root = Ball::pi(300).sqrt();
            let part = |q: Rational| &Ball::rational(300, &(q / &r)) / &root;
            let (u, v) = (part(b - c), part(a + d));
            let off = (&w.re - &u).square() + (&w.im - &v).square();
            let off = above(&off.sqrt());
            let least = hypot(x, y);
            let bound = remainder(n, least.next_down());
            assert!(off <= bound, "{x} {y} {n}: {off:e} {bound:e}");
        }
    }
}

fn hypot(x: f64, y: f64) -> f64 {
    crate::interval::hypot_down(x, y)
}

/// Above what is due for all of many arguments: at some of them the value is next to above an f64.
#[test]
fn exponentials_are_rounded_up() {
    for k in 0..40_000 {
        let t = -20.0 + 0.001 * f64::from(k);
        let due = Float::with_val(200, t).exp();
        let found = exp_up(t);
        assert!(found >= due && found < due * (1.0 + 1e-15), "{t}");
    }
}
