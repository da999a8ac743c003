//! Describes what is defined where w is not.

use super::super::{faddeeva, faddeeva_batch};
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

/// The sign of a NaN makes no difference, alone or among many.
#[test]
fn not_a_number_with_a_minus_sign() {
    let same = |a: f64, b: f64| a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan());
    let minus = -NAN;
    assert!(minus.is_sign_negative());
    for v in [
        0.0, -0.0, 1e-300, 0.5, -2.0, 40.0, 1e200, INF, -INF, NAN, minus,
    ] {
        for (z, of) in [((v, minus), (v, NAN)), ((minus, v), (NAN, v))] {
            let (got, expected) = (w(z.0, z.1), w(of.0, of.1));
            assert!(
                same(got.re, expected.re) && same(got.im, expected.im),
                "w{z:?} = {got:?}, not {expected:?}"
            );
            let mut many = [Complex::ZERO; 80];
            faddeeva_batch(&[Complex::new(z.0, z.1); 80], &mut many).expect("equal lengths");
            for got in many {
                assert!(same(got.re, expected.re) && same(got.im, expected.im));
            }
        }
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
    for y in [-27.0, -37.0, -40.0, -100.0, -1e10, -1e99] {
        assert_is((0.0, y), INF, 0.0);
    }
}

/// Both components with the signs of `cos 2xy` and `−sin 2xy`, however large `e^{y² − x²}` is.
#[test]
fn signs_of_infinity() {
    use super::Random;
    use rug::Float;
    let mut random = Random(121);
    for k in 0..20_000 {
        let y = -random.power(4.8, if k % 2 == 0 { 10.0 } else { 1000.0 });
        let x = match k % 3 {
            0 => random.power(-60.0, 0.0),
            1 => -y * random.power(-40.0, -0.1),
            _ => random.power(-3.0, 4.0),
        };
        if (y + x) * (y - x) < 800.0 {
            continue;
        }
        let phase: Float = Float::with_val(2600, x) * y * 2;
        let signs = (phase.clone().cos().to_f64(), -phase.sin().to_f64());
        for (x, s) in [(x, signs.1), (-x, -signs.1)] {
            assert_is((x, y), INF.copysign(signs.0), INF.copysign(s));
        }
    }
}

/// Beside the real axis, where `e^{−z²}` is nothing and Im z may be nothing but for its sign.
#[test]
fn far_to_the_side() {
    use super::Random;
    use super::exact::{error, float, w as exact};
    let mut random = Random(122);
    for _ in 0..20_000 {
        let (x, b) = (random.power(4.8, 340.0), random.power(-1074.0, 3.0));
        for y in [b, -b] {
            let (got, wanted) = (w(x, y), exact(x, y));
            for (got, wanted) in [(got.re, wanted.0), (got.im, wanted.1)] {
                let ulp = (wanted.to_f64().abs() * f64::EPSILON).max(5e-324);
                let off = error(&float(got), &wanted, &float(ulp));
                assert!(off <= 2.0, "{x:e} {y:e}: {got:e}, {off} ulp");
            }
        }
    }
}

/// Im W is proportional to Re z beside the imaginary axis: with the smallest numbers it is in range
/// where `e^{−z²}` is beyond e^1400. Values certified by `mechaudit eval faddeeva --digits 20`
/// at the doubles themselves.
#[test]
fn far_below_with_the_smallest_real_parts() {
    let tiny =
        |mantissa: f64, exponent: i32| mantissa * 2f64.powi(-500) * 2f64.powi(exponent + 500);
    for (x, y, im) in [
        (tiny(1.5, -1060), -37.9, 1.230_075_609_461_880_5e307),
        (tiny(1.0, -1030), -37.42, 1.729_402_212_707_140_5e300),
        (-tiny(1.1875, -1020), -37.5, -8.447_816_593_637_214e305),
        (tiny(1.0, -970), -37.0, 5.251_841_938_116_82e304),
        (tiny(1.0, -1074), -38.2, INF),
    ] {
        let w = w(x, y);
        assert_eq!(w.re, INF, "{x} {y}");
        let close = w.im == im || (w.im - im).abs() <= 2.0 * f64::EPSILON * im.abs();
        assert!(close, "{x} {y}: {} {im}", w.im);
    }
}

#[test]
fn next_to_zero_it_does_not_grow_on_the_imaginary_axis() {
    let on_axis = |y: f64| crate::faddeeva::faddeeva(Complex::new(0.0, y)).re;
    // The first one was found by an audit.
    let found = 0.007_262_203_177_223_835_5;
    let evenly = (1..=200_000).map(|i| f64::from(i) * 3.9e-8);
    for y in std::iter::once(found).chain(evenly) {
        for y in [y, -y] {
            let (here, next) = (on_axis(y), on_axis(y.next_up()));
            assert!(next <= here, "{y}: {here} {next}");
        }
    }
}
