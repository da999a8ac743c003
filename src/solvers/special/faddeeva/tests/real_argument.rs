//! Functions of a real argument, one at a time or many, with vectors or without: the same bits.

use super::super::{
    LengthMismatch, dawson_real, dawson_real_batch, erf_real, erf_real_batch, erfc_real,
    erfc_real_batch, erfcx_real, erfcx_real_batch, erfi_real, erfi_real_batch, real_argument,
};
use super::Random;
use crate::lanes::Plain;

type One = fn(f64) -> f64;
type Many = fn(&[f64], &mut [f64]) -> Result<(), LengthMismatch>;

const FUNCTIONS: [(&str, One, Many); 5] = [
    ("erf", erf_real, erf_real_batch),
    ("erfc", erfc_real, erfc_real_batch),
    ("erfcx", erfcx_real, erfcx_real_batch),
    ("erfi", erfi_real, erfi_real_batch),
    ("dawson", dawson_real, dawson_real_batch),
];

fn points(seed: u64, n: usize) -> Vec<f64> {
    let mut random = Random(seed);
    (0..n).map(|_| random.point().0).collect()
}

/// The same bits, or both not a number.
fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan())
}

fn assert_same(name: &str, one: One, x: &[f64], y: &[f64]) {
    for (x, y) in x.iter().zip(y) {
        let alone = one(*x);
        assert!(
            same(alone, *y),
            "{name}({x:e}) = {alone:e} alone, {y:e} in the batch"
        );
    }
}

#[test]
fn batches_of_any_length() {
    for (name, one, many) in FUNCTIONS {
        for n in (0..40).chain([20_000]) {
            let x = points(n as u64, n);
            let mut y = vec![7.0; n];
            many(&x, &mut y).expect("equal lengths");
            assert_same(name, one, &x, &y);
        }
    }
}

/// Neighbours of every limit between formulas, beside one another and beside what is not finite.
#[test]
fn limits_between_formulas() {
    let mut x = vec![
        f64::NAN,
        f64::INFINITY,
        0.0,
        5e-324,
        f64::MIN_POSITIVE,
        1e300,
    ];
    let circles = [
        80.0f64,
        112.0,
        768.0,
        1024.0,
        5120.0,
        1_048_576.0,
        1e200,
        1.25,
    ];
    let limits = [
        0.5,
        3.96875,
        5.96875,
        7.99609375,
        30.0,
        11.8,
        26.628_735_713_751_49,
        26.5,
        27.2,
        26.714,
    ];
    for limit in circles.map(f64::sqrt).into_iter().chain(limits) {
        let mut p = limit;
        for _ in 0..4 {
            p = p.next_down();
        }
        for _ in 0..9 {
            x.push(p);
            p = p.next_up();
        }
    }
    x.extend(x.clone().iter().map(|x| -x));
    let mut random = Random(5);
    for (name, one, many) in FUNCTIONS {
        for _ in 0..50 {
            for k in (1..x.len()).rev() {
                x.swap(k, random.below(k as u64 + 1) as usize);
            }
            let mut y = vec![7.0; x.len()];
            many(&x, &mut y).expect("equal lengths");
            assert_same(name, one, &x, &y);
        }
    }
}

#[test]
fn lengths_have_to_agree() {
    for (_, _, many) in FUNCTIONS {
        let mut y = [7.0; 2];
        let mismatch = LengthMismatch {
            points: 3,
            values: 2,
        };
        assert_eq!(many(&[1.0; 3], &mut y), Err(mismatch));
        assert_eq!(y, [7.0; 2]);
    }
}

#[test]
fn every_set_of_instructions() {
    let x = points(77, 30_000);
    for (name, one, _) in FUNCTIONS {
        for with in real_argument::every_way() {
            let mut y = vec![7.0; x.len()];
            with(name, &x, &mut y);
            assert_same(name, one, &x, &y);
        }
    }
    // Arrays serve processors without vectors.
    let mut y = vec![7.0; x.len()];
    for (name, one, _) in FUNCTIONS {
        real_argument::by_lanes(Plain, name, &x, &mut y);
        assert_same(name, one, &x, &y);
    }
}
