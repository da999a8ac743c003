//! Tests of `cam_law`.

use super::*;

fn r(n: i32, d: i32) -> Rational {
    Rational::from((n, d))
}

#[test]
fn cycloidal_and_harmonic_values() {
    let law = |b, d| Law::stretched(&Family::Scca { b, d }, &r(1, 2));
    let pi = Ball::pi(128);
    // s(1/4) = 1/4 − 1/2π; C_a = 2π.
    let jet = law(r(1, 2), r(1, 2)).jet(&r(1, 4), 128);
    let expected = Ball::rational(128, &r(1, 4)) - pi.shift(1).recip();
    assert!(jet[0].overlaps(&expected) && jet[0].accuracy_bits() > 110);
    assert!(jet[2].overlaps(&pi.shift(1)));
    // (1 − cos πx)/2 at x = 1/3.
    let jet = law(r(0, 1), r(1, 1)).jet(&r(1, 3), 128);
    assert!(jet[0].contains(&r(1, 4)));
    let mean = law(r(1, 5), r(1, 3)).mean(128);
    assert!(mean.contains(&r(1, 2)) && mean.accuracy_bits() > 110);
}

#[test]
fn halves_fit_together() {
    for family in [
        Family::Polynomial345,
        Family::Polynomial4567,
        Family::Scca {
            b: r(1, 5),
            d: r(2, 5),
        },
    ] {
        let law = Law::stretched(&family, &r(1, 3));
        let tiny = r(1, 1 << 30);
        let [before, after] = [r(1, 3) - tiny, r(1, 3)].map(|x| law.jet(&x, 128));
        let close = |a: &Ball, b: &Ball| (a - b).magnitude().to_f64() < 1e-5;
        for k in 0..3 {
            assert!(close(&before[k], &after[k]), "{family:?} {k}");
        }
        let end = law.jet(&r(1, 1), 128);
        assert!(end[0].contains(&r(1, 1)) && end[1].contains(&r(0, 1)));
    }
}
