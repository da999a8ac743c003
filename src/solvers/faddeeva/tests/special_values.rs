//! What is defined where w is not.

use super::super::faddeeva;
use num_complex::Complex;

const INF: f64 = f64::INFINITY;
const NAN: f64 = f64::NAN;

fn w(x: f64, y: f64) -> Complex<f64> {
    faddeeva(Complex::new(x, y))
}

/// Equal, signs of zeros aside; NaN equals NaN.
fn assert_is(z: (f64, f64), re: f64, im: f64) {
    let w = w(z.0, z.1);
    let is = |a: f64, b: f64| a == b || (a.is_nan() && b.is_nan());
    assert!(
        is(w.re, re) && is(w.im, im),
        "w{z:?} = {w:?}, not {re} {im}"
    );
}

#[test]
fn not_a_number() {
    for v in [0.5, -2.0, 40.0, 1e200, INF, -INF, NAN] {
        assert_is((NAN, v), NAN, NAN);
        assert_is((v, NAN), NAN, NAN);
    }
    for zero in [0.0, -0.0] {
        assert_is((NAN, zero), NAN, NAN);
        // On the imaginary axis w is real whatever Im z is.
        assert_is((zero, NAN), NAN, 0.0);
    }
}

#[test]
fn infinity() {
    for x in [0.0, -0.0, 1.0, -3e-320, 1e300, INF, -INF] {
        assert_is((x, INF), 0.0, 0.0);
    }
    for y in [0.0, -0.0, 2.0, -2.0, 1e-320, -1e300, 1e300] {
        assert_is((INF, y), 0.0, 0.0);
        assert_is((-INF, y), 0.0, 0.0);
    }
    assert_is((0.0, -INF), INF, 0.0);
    assert_is((-0.0, -INF), INF, 0.0);
    for x in [1.0, -2e-310, 1e300, INF, -INF] {
        assert_is((x, -INF), NAN, NAN);
    }
}

#[test]
fn zero_and_the_axes() {
    assert_eq!(w(0.0, 0.0), Complex::new(1.0, 0.0));
    assert_eq!(w(-0.0, -0.0), Complex::new(1.0, 0.0));
    for k in 0..400 {
        let y = f64::from(k) * 0.19 - 27.0;
        let w = w(0.0, y);
        assert!(w.im == 0.0 && w.re > 0.0, "{y} {w:?}");
    }
    // Subnormal arguments: w = 1 + 2iz/√π.
    let w = w(5e-324, -5e-324);
    assert_eq!(w.re, 1.0);
    assert!(w.im == 5e-324, "{w:?}");
}

#[test]
fn overflow_in_the_lower_half_plane() {
    // 2e^{y²} leaves the range between 26.6 and 26.7.
    assert!(w(0.0, -26.6).re.is_finite());
    assert_is((0.0, -26.7), INF, 0.0);
    assert_is((0.0, -1e300), INF, 0.0);
    assert_is((0.0, -f64::MAX), INF, 0.0);
    // Both components with the signs of cos 2xy and −sin 2x(−|y|).
    let v = w(1e-3, -1e5);
    let (s, c) = (2.0f64 * 1e-3 * 1e5).sin_cos();
    assert_eq!(v.re, INF.copysign(c));
    assert_eq!(v.im, INF.copysign(s));
}
