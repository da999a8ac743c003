//! One at a time or many, with vectors or without: the same bits.

use super::super::{LengthMismatch, faddeeva, faddeeva_batch, faddeeva_soa, plane};
use super::Random;
use crate::lanes::Plain;
use num_complex::Complex;
use proptest::prelude::*;

fn points(seed: u64, n: usize) -> Vec<Complex<f64>> {
    let mut random = Random(seed);
    let point = |_| {
        let (x, y) = random.point();
        Complex::new(x, y)
    };
    (0..n).map(point).collect()
}

/// The same bits, or both not a number.
fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan())
}

fn assert_same(z: &[Complex<f64>], w: &[Complex<f64>]) {
    assert_eq!(z.len(), w.len());
    for (i, (z, w)) in z.iter().zip(w).enumerate() {
        let one = faddeeva(*z);
        assert!(
            same(one.re, w.re) && same(one.im, w.im),
            "point {i}: w({:e} + {:e} i) = {one:?} alone, {w:?} in the batch",
            z.re,
            z.im
        );
    }
}

#[test]
fn batches_of_any_length() {
    for n in 0..600 {
        let z = points(n as u64, n);
        let mut w = vec![Complex::new(7.0, 7.0); n];
        faddeeva_batch(&z, &mut w).expect("equal lengths");
        assert_same(&z, &w);
    }
}

#[test]
fn batches_of_one_kind() {
    // A chunk full of points that need the same formula, and each of them in every place.
    let mut random = Random(31);
    for _ in 0..300 {
        let (x, y) = random.point();
        let n = 1 + random.below(300) as usize;
        let z = vec![Complex::new(x, y); n];
        let mut w = vec![Complex::new(0.0, 0.0); n];
        faddeeva_batch(&z, &mut w).expect("equal lengths");
        assert_same(&z, &w);
    }
}

/// Points that few others of a chunk share the formula with wait for more of them, those of several
/// chunks are computed together, and the last ones at the end.
#[test]
fn points_that_wait() {
    let mut random = Random(33);
    for n in [1023, 1024, 1025, 1300, 3000, 20_000] {
        // The rare ones thin out, so that they are due neither at once nor never.
        let rare = 1 + random.below(60);
        let z: Vec<_> = (0..n)
            .map(|_| match random.below(rare) {
                0 => {
                    let (x, y) = random.point();
                    Complex::new(x, y)
                }
                _ => Complex::new(1e3 + random.below(100) as f64, 2.0),
            })
            .collect();
        let mut w = vec![Complex::new(7.0, 7.0); n];
        faddeeva_batch(&z, &mut w).expect("equal lengths");
        assert_same(&z, &w);
    }
}

#[test]
fn parts_apart() {
    let z = points(32, 5000);
    let (x, y): (Vec<f64>, Vec<f64>) = z.iter().map(|z| (z.re, z.im)).unzip();
    let (mut re, mut im) = (vec![7.0; z.len()], vec![7.0; z.len()]);
    faddeeva_soa(&x, &y, &mut re, &mut im).expect("equal lengths");
    let pair = |(re, im): (&f64, &f64)| Complex::new(*re, *im);
    let w: Vec<_> = re.iter().zip(&im).map(pair).collect();
    assert_same(&z, &w);
}

#[test]
fn lengths_have_to_agree() {
    let mismatch = |values| Err(LengthMismatch { points: 3, values });
    let mut w = [Complex::new(7.0, 7.0); 2];
    assert_eq!(faddeeva_batch(&points(1, 3), &mut w), mismatch(2));
    assert_eq!(w, [Complex::new(7.0, 7.0); 2]);
    let (a, mut b, mut c) = ([1.0; 3], [7.0; 3], [7.0; 4]);
    assert_eq!(faddeeva_soa(&a, &a[1..], &mut b, &mut c[1..]), mismatch(2));
    assert_eq!(faddeeva_soa(&a, &a, &mut c, &mut b), mismatch(4));
    assert_eq!(faddeeva_soa(&a, &a, &mut b, &mut c), mismatch(4));
    assert_eq!((b, c), ([7.0; 3], [7.0; 4]));
}

#[cfg(all(target_arch = "x86_64", feature = "vectors"))]
#[test]
fn every_set_of_vectors() {
    use super::super::batch::batch;
    use super::super::points::Interleaved;
    use crate::pack::Wide;
    use pulp::x86::{V3, V4};

    fn check<S: Wide>(simd: S, lanes: V3) {
        for n in (0..600).chain([20_000]) {
            let z = points(1000 + n as u64, n);
            let mut w = vec![Complex::new(7.0, 7.0); n];
            let points = &mut Interleaved { z: &z, w: &mut w };
            simd.outlined(
                #[inline(always)]
                || batch(simd, lanes, points),
            );
            assert_same(&z, &w);
        }
    }
    if let Some(simd) = V3::try_new() {
        check(simd, simd);
    }
    if let Some(simd) = V4::try_new() {
        check(simd, *simd);
    }
}

/// The relatives: few points and many, every formula and both ways of computing again.
#[cfg(all(target_arch = "x86_64", feature = "vectors"))]
#[test]
fn relatives() {
    use super::super::groups::{Function, every_way};
    use super::super::{dawson, derivative, erf};
    use super::super::{dawson_batch, erf_batch, erfc_batch, erfi_batch, w_derivative_batch};

    type Batch = fn(&[Complex<f64>], &mut [Complex<f64>]) -> Result<(), LengthMismatch>;
    fn check(name: &str, one: fn(Complex<f64>) -> Complex<f64>, batch: Batch, f: impl Function) {
        for n in [0, 1, 7, 8, 9, 60, 257, 40_000] {
            let z = points(50 + n as u64, n);
            let mut w = vec![Complex::new(7.0, 7.0); n];
            batch(&z, &mut w).expect("equal lengths");
            for values in std::iter::once(w).chain(every_way(f, &z)) {
                for (z, w) in z.iter().zip(values) {
                    let one = one(*z);
                    assert!(
                        same(one.re, w.re) && same(one.im, w.im),
                        "{name}({:e} + {:e} i) = {one:?} alone, {w:?} in a batch of {n}",
                        z.re,
                        z.im
                    );
                }
            }
        }
        let z = points(50, 3);
        let lost = Err(LengthMismatch {
            points: 3,
            values: 2,
        });
        assert_eq!(batch(&z, &mut [Complex::ZERO; 2]), lost);
    }
    check("erf", erf::erf, erf_batch, erf::ERF);
    check("erfc", erf::erfc, erfc_batch, erf::ERFC);
    check("erfi", erf::erfi, erfi_batch, erf::ERFI);
    check("dawson", dawson::dawson, dawson_batch, dawson::Dawson);
    check(
        "w_derivative",
        derivative::w_derivative,
        w_derivative_batch,
        derivative::Derivative,
    );
}

#[test]
fn plain_arrays() {
    for z in points(41, 50_000) {
        let (re, im) = plane::w(Plain, z.re, z.im);
        let best = plane::w_with_best(z.re, z.im);
        assert!(
            same(re, best.0) && same(im, best.1),
            "w({:e} + {:e} i): {re:e} {im:e}, with vectors {best:?}",
            z.re,
            z.im
        );
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]
    /// Any bit pattern gives a value, mirrored points the conjugate one, and the batch the same.
    #[test]
    fn any_bits(x in any::<u64>(), y in any::<u64>()) {
        let z = Complex::new(f64::from_bits(x), f64::from_bits(y));
        let w = faddeeva(z);
        let mirrored = faddeeva(Complex::new(-z.re, z.im));
        prop_assert!(same(w.re, mirrored.re) && same(w.im, -mirrored.im));
        let mut many = [Complex::new(0.0, 0.0); 32];
        faddeeva_batch(&[z; 32], &mut many).expect("equal lengths");
        prop_assert!(many.iter().all(|v| same(w.re, v.re) && same(w.im, v.im)));
        if !z.re.is_nan() && !z.im.is_nan() && z.im >= 0.0 {
            // |w| ≤ 1 in the closed upper half-plane.
            prop_assert!(w.re.hypot(w.im) <= 1.0 && w.re >= 0.0, "{z:?} {w:?}");
        }
    }
}
