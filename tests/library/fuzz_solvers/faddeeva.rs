//! The Faddeeva function and its relatives, against their tables of special values.

use super::{any_f64, cases};
use mechaudit::solvers::faddeeva::*;
use num_complex::Complex;
use proptest::prelude::*;

type C = Complex<f64>;
type Function = fn(C) -> C;

fn same(a: C, b: C) -> bool {
    let part = |a: f64, b: f64| a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan();
    part(a.re, b.re) && part(a.im, b.im)
}

fn finite(z: C) -> bool {
    z.re.is_finite() && z.im.is_finite()
}

fn is_nan(z: C) -> bool {
    z.re.is_nan() || z.im.is_nan()
}

const FUNCTIONS: [(&str, Function); 7] = [
    ("w", faddeeva),
    ("w'", w_derivative),
    ("erf", erf),
    ("erfc", erfc),
    ("erfcx", erfcx),
    ("erfi", erfi),
    ("dawson", dawson),
];

proptest! {
    #![proptest_config(cases(4000))]

    #[test]
    fn of_any_point(x in any_f64(), y in any_f64()) {
        let z = Complex::new(x, y);
        let _ = branch(z);
        for (name, f) in FUNCTIONS {
            let value = f(z);
            if is_nan(z) {
                prop_assert!(is_nan(value), "{}({}) = {}", name, z, value);
            } else if finite(z) {
                prop_assert!(!is_nan(value), "{}({}) = {}", name, z, value);
            }
        }
        if x.is_nan() || y.is_nan() {
            return Ok(());
        }
        let w = faddeeva(z);
        let wide = 1.0 + 1e-15;
        if y >= 0.0 {
            prop_assert!(w.re >= 0.0 && w.re.abs() <= wide && w.im.abs() <= 0.611, "w({}) = {}", z, w);
        }
        // Symmetries, bit for bit but for the sign of NaN: w(-conj z) = conj w(z), and those of the
        // odd functions.
        let mirrored = faddeeva(Complex::new(-x, y));
        prop_assert!(same(mirrored, w.conj()), "w({}) = {} beside {}", z, mirrored, w);
        for (name, f) in [("erf", erf as Function), ("erfi", erfi), ("dawson", dawson)] {
            let (a, b) = (f(z), f(-z));
            prop_assert!(same(a, -b), "{}({}) = {}, {}({}) = {}", name, z, a, name, -z, b);
            let c = f(z.conj());
            prop_assert!(same(a.conj(), c), "{}({}) = {} beside {}", name, z.conj(), c, a);
        }
        let (a, b) = (erfcx(z), erfcx(z.conj()));
        prop_assert!(same(a.conj(), b), "erfcx({}) = {} beside {}", z, a, b);
    }

    #[test]
    fn of_a_real_argument(x in any_f64()) {
        let all = [erf_real(x), erfc_real(x), erfcx_real(x), erfi_real(x), dawson_real(x)];
        for v in all {
            prop_assert_eq!(v.is_nan(), x.is_nan());
        }
        if !x.is_nan() {
            prop_assert!(all[0].abs() <= 1.0 && (0.0..=2.0).contains(&all[1]) && all[2] >= 0.0);
            prop_assert!(all[4].abs() <= 0.5411);
            prop_assert!(all[0].to_bits() == (-erf_real(-x)).to_bits());
            prop_assert!(all[4].to_bits() == (-dawson_real(-x)).to_bits());
        }
    }

    #[test]
    fn profiles(x in any_f64(), sigma in any_f64(), gamma in any_f64()) {
        let v = voigt(x, sigma, gamma);
        let bad = x.is_nan() || !(sigma >= 0.0) || !(gamma >= 0.0);
        prop_assert!(v.is_nan() == bad && (bad || v >= 0.0), "{} {} {}: {}", x, sigma, gamma, v);
        prop_assert!(bad || v.to_bits() == voigt(-x, sigma, gamma).to_bits());
        if [x, sigma, gamma].iter().any(|v| v.is_infinite()) && !bad {
            prop_assert_eq!(v, 0.0);
        }
    }
}

proptest! {
    #![proptest_config(cases(60))]

    #[test]
    fn batches(z in prop::collection::vec((any_f64(), any_f64()), 0..150)) {
        let z: Vec<C> = z.into_iter().map(|(x, y)| Complex::new(x, y)).collect();
        type Batch = fn(&[C], &mut [C]) -> Result<(), LengthMismatch>;
        let all: [(Batch, Function); 7] = [
            (faddeeva_batch, faddeeva),
            (w_derivative_batch, w_derivative),
            (erf_batch, erf),
            (erfc_batch, erfc),
            (erfcx_batch, erfcx),
            (erfi_batch, erfi),
            (dawson_batch, dawson),
        ];
        let mut out = vec![C::default(); z.len()];
        for (batch, one) in all {
            prop_assert!(batch(&z, &mut out).is_ok());
            for (z, w) in z.iter().zip(&out) {
                prop_assert!(same(*w, one(*z)), "{}: {} and {}", z, w, one(*z));
            }
        }
    }
}
