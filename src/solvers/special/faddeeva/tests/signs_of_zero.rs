//! The sign of a part that is zero, on the axes and at infinity, and parts that are next to zero.

use super::super::{
    dawson, dawson_batch, erf, erfc, erfcx, erfcx_batch, erfi, faddeeva, faddeeva_batch,
    w_derivative,
};
use num_complex::Complex;

type C = Complex<f64>;

/// Moduli on every side of every seam.
fn moduli() -> impl Iterator<Item = f64> {
    let sizes = [
        5e-324,
        1e-310,
        1e-200,
        1e-9,
        1e50,
        1e120,
        f64::MAX,
        f64::INFINITY,
    ];
    (1..2000).map(|k| f64::from(k) * 0.0177).chain(sizes)
}

fn signed(x: f64, negative: bool) -> f64 {
    if negative { -x } else { x }
}

/// f is real and increasing (or decreasing) on the real axis: Im f has the sign of Im z (or the
/// other).
fn on_the_real_axis(name: &str, f: impl Fn(C) -> C, decreasing: impl Fn(f64) -> bool) {
    for x in moduli().chain([0.0]) {
        for (left, below) in [(false, false), (false, true), (true, false), (true, true)] {
            let z = C::new(signed(x, left), signed(0.0, below));
            let im = f(z).im;
            let negative = below != decreasing(z.re);
            assert!(
                im == 0.0 && im.is_sign_negative() == negative,
                "{name}({z:?}) = {:?}",
                f(z)
            );
        }
    }
}

/// f is imaginary on the imaginary axis, or real there with `imaginary = false`; the vanishing part
/// grows (or falls) with Re z.
fn on_the_imaginary_axis(name: &str, f: impl Fn(C) -> C, imaginary: bool, decreasing: bool) {
    for y in moduli().filter(|y| y.is_finite()) {
        for (left, below) in [(false, false), (false, true), (true, false), (true, true)] {
            let z = C::new(signed(0.0, left), signed(y, below));
            let value = f(z);
            let part = if imaginary { value.re } else { value.im };
            assert!(
                part == 0.0 && part.is_sign_negative() == (left != decreasing),
                "{name}({z:?}) = {value:?}"
            );
        }
    }
}

#[test]
fn of_the_error_functions() {
    let never = |_: f64| false;
    on_the_real_axis("erf", erf, never);
    on_the_imaginary_axis("erf", erf, true, false);
    on_the_real_axis("erfc", erfc, |_| true);
    on_the_imaginary_axis("erfi", erfi, true, false);
    // erfi beyond the range of f64 is infinite on the real axis, and real.
    on_the_real_axis("erfi", erfi, never);
    on_the_real_axis("erfcx", erfcx, |_| true);
}

#[test]
fn of_dawson() {
    // F has its maximum at 0.924138873004591767…
    on_the_real_axis("dawson", dawson, |x| x.abs() > 0.924_138_873_004_591_8);
    on_the_imaginary_axis("dawson", dawson, true, false);
}

#[test]
fn of_w_and_its_derivative() {
    on_the_imaginary_axis("w", faddeeva, false, false);
    on_the_imaginary_axis("w′", w_derivative, true, true);
}

/// A subnormal part of z times an exponential far above the range is above the range.
#[test]
fn subnormal_times_overflow() {
    let infinite = |w: C| w.re == f64::INFINITY && w.im == f64::INFINITY;
    assert!(infinite(faddeeva(C::new(1e-320, -53.0))));
    let mut points = Vec::new();
    for i in 0..80 {
        let x = 5e-324 * (f64::from(i) * 0.7).exp2();
        // The phase 2x|y| is below π/2, e^{y²} 2x|y| above 2^1024.
        points.extend(
            (390..4000)
                .step_by(7)
                .map(|j| C::new(x, -0.1 * f64::from(j))),
        );
    }
    for &z in &points {
        assert!(infinite(faddeeva(z)), "w({z:?}) = {:?}", faddeeva(z));
    }
    let mut w = vec![C::ZERO; points.len()];
    faddeeva_batch(&points, &mut w).expect("equal lengths");
    assert!(w.iter().all(|&w| infinite(w)));
    // erfcx z = w(iz).
    let turned: Vec<C> = points.iter().map(|z| C::new(z.im, -z.re)).collect();
    erfcx_batch(&turned, &mut w).expect("equal lengths");
    assert!(w.iter().all(|&w| infinite(w)));
    // F(z) = (√π/2) i (e^{−z²} − w(z)): the sine leads Re F, the cosine Im F.
    let up: Vec<C> = points.iter().map(|z| z.conj()).collect();
    dawson_batch(&up, &mut w).expect("equal lengths");
    assert!(w.iter().all(|&w| infinite(w)));
}
