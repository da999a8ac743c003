use super::super::rows::{REACH, nearest_zero};
use super::super::tables::ZEROS;
use super::super::tests::Random;
use super::super::tests::exact::{are_parts, error, float, w};
use super::*;
use crate::lanes::Plain;
use mechaudit_reference::faddeeva;

#[test]
fn constants() {
    for (k, row) in ZEROS.iter().enumerate() {
        let z = faddeeva::zero(k as u32 + 1, 300).expect("decided");
        assert!(are_parts(&z.re, &row.0[..3]) && are_parts(&z.im, &row.0[3..6]));
    }
}

/// Every point of a zero's square finds that zero.
#[test]
fn squares_are_found() {
    let mut random = Random(101);
    for (k, row) in ZEROS.iter().enumerate() {
        let (x, y) = (row.0[0], -row.0[3]);
        let reach = REACH / x;
        for _ in 0..5000 {
            let t = 0.999 * reach;
            let (a, b) = (x + random.between(-t, t), y + random.between(-t, t));
            assert_eq!(nearest_zero(a, b), Some(k), "{a} − {b} i");
        }
        for side in -50..=50 {
            let (s, t) = (0.019_999 * reach * f64::from(side), 0.999_999 * reach);
            for (p, q) in [(s, t), (s, -t), (t, s), (-t, s)] {
                assert_eq!(nearest_zero(x + p, y + q), Some(k));
            }
        }
        for (p, q) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
            let t = 0.999_999 * reach;
            assert_eq!(nearest_zero(x + p * t, y + q * t), Some(k));
            assert_eq!(nearest_zero(x + 1.001 * p * reach, y), None);
        }
    }
    for (a, b) in [
        (f64::NAN, 2.0),
        (2.0, f64::NAN),
        (f64::INFINITY, 2.0),
        (0.0, 0.0),
        (6.4, 6.4),
    ] {
        assert_eq!(nearest_zero(a, b), None);
    }
}

/// Each component, in units of its last place, at any distance from the zero.
#[test]
fn components_next_to_zeros() {
    let mut random = Random(102);
    let mut worst = (0.0f64, 0.0, 0.0);
    let mut given_up = 0;
    for k in 0..ZEROS.len() {
        for _ in 0..600 {
            let row = &ZEROS[k].0;
            let (r, s) = (random.power(-60.0, -4.0), random.power(-60.0, -4.0));
            let (p, q) = (random.between(-1.0, 1.0), random.between(-1.0, 1.0));
            let (a, b) = (row[0] + r * p, -row[3] + s * q);
            let Some((re, im)) = near_zero(Plain, &ZEROS[k].0, a, b) else {
                given_up += 1;
                continue;
            };
            let exact = w(a, -b);
            for (got, exact) in [(re, exact.0), (im, exact.1)] {
                let off = error(&float(got), &exact, &exact) / f64::EPSILON;
                if off > worst.0 {
                    worst = (off, a, b);
                }
            }
        }
        // At the zero's own f64.
        let row = &ZEROS[k].0;
        let (re, im) = near_zero(Plain, &ZEROS[k].0, row[0], -row[3]).expect("no cancellation");
        let exact = w(row[0], row[3]);
        let off = error(&float(re), &exact.0, &exact.0).max(error(&float(im), &exact.1, &exact.1));
        assert!(off < 2f64.powi(-50), "zero {k}: {off:e}");
    }
    println!(
        "{} ε at {:e} − {:e} i; {given_up} not this way",
        worst.0, worst.1, worst.2
    );
    assert!(worst.0 < 4.0, "{worst:?}");
}
