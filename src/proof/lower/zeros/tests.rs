use super::*;
use crate::pinned::{self, bit_by_bit, counted};
use mechaudit_reference::faddeeva::w_f64;
use mechaudit_solvers::faddeeva::{Branch, branch, faddeeva};
use num_complex::Complex;
use rand::rngs::ChaCha8Rng;
use rand::{Rng, SeedableRng};
use rug::Float;
use std::sync::LazyLock;

static ZEROS: LazyLock<Vec<Zero>> = LazyLock::new(|| AroundZeros::rows().expect("decided"));

fn proved(zeros: &[Zero]) -> f64 {
    let found = AroundZeros::of(zeros, Rounding::default(), 2.5);
    found.map_or(f64::INFINITY, |f| f.norm)
}

#[test]
fn all_zeros_have_a_bound() {
    let found = AroundZeros::of(&ZEROS, Rounding::default(), 2.5).expect("proved");
    eprintln!("{found:?}");
    assert!(found.norm > 1.0 && found.boxes > 1000);
}

/// Faults of the first zero: a coefficient off by 2⁻⁴⁶ of it, the middle part left out, the row of
/// another zero.
#[test]
fn faults_show() {
    let sound = proved(&ZEROS[..1]);
    assert!(sound < 2.5);
    let faulty = |change: fn(&mut [f64; 46])| {
        let mut row = ZEROS[0].row;
        change(&mut row);
        proved(&[Zero::of(&row, 1).expect("decided")])
    };
    for norm in [
        faulty(|row| row[6] *= 1.0 + 2f64.powi(-46)),
        faulty(|row| row[1] = 0.0),
        faulty(|row| row[25] = 0.0),
        proved(&[Zero::of(&ZEROS[1].row, 1).expect("decided")]),
    ] {
        assert!(norm > 1.2 * sound, "{sound} {norm}");
    }
}

/// Next to the zeros, at distances of every size, the error is below the bound.
#[test]
fn errors_at_points_are_below_the_bound() {
    let mut random = ChaCha8Rng::seed_from_u64(11);
    let (mut points, mut most) = (0, 0.0f64);
    for zero in ZEROS.iter() {
        let bound = proved(std::slice::from_ref(zero));
        for _ in 0..200 {
            let mut near = |x: f64| {
                let bits = random.next_u64();
                let size = 2f64.powi(-4 - (bits % 50) as i32);
                x + size * ((bits >> 11) as f64 / 2f64.powi(52) - 1.0)
            };
            let z = Complex::new(near(zero.row[0]), near(zero.row[3]));
            if !matches!(branch(z), Branch::Zero { .. }) {
                continue;
            }
            let got = faddeeva(z);
            let w = w_f64(z.re, z.im, 120).expect("decided");
            let part = |g: f64, w: &Ball| (Float::with_val(300, g) - w.mid()).square();
            let size = |w: &Ball| Float::with_val(300, w.mid().square_ref());
            let off = part(got.re, &w.re) + part(got.im, &w.im);
            let off = (off / (size(&w.re) + size(&w.im))).sqrt().to_f64() * TWO_52;
            assert!(off <= bound, "{z} {off} {bound}");
            points += 1;
            most = most.max(off);
        }
    }
    assert!(points > 2000 && most > 0.4, "{points} {most}");
}

/// `Σ |g̃_n − g_n| Dⁿ⁺¹` and the tail, as a part of |δ|; each entry of a row counts for its
/// coefficient.
#[test]
fn coefficients_about_a_zero() {
    let zero = &ZEROS[1];
    assert_eq!(zero.errors.len(), TERMS - 2);
    assert!(
        zero.errors[..STORED].iter().all(|e| *e < 1e-12),
        "{:?}",
        zero.errors
    );
    assert!(zero.off < 1e-40, "{:e}", zero.off);
    let size = zero.row[0].hypot(zero.row[3]);
    assert!(zero.size >= size && zero.size < 1.000_001 * size);
    for d in [0.01, 0.05, 0.09] {
        let sum: f64 = zero
            .errors
            .iter()
            .zip(1..)
            .map(|(e, n)| e * f64::powi(d, n))
            .sum();
        let tail = 1.2 * (2.0 * (size + 1.0)).exp() * d.powi(TERMS as i32 - 1);
        let found = zero.within(d);
        assert!(
            found >= (sum + tail) * (1.0 - 1e-12) && found <= (sum + tail) * (1.0 + 1e-9),
            "{d}"
        );
    }
    for at in [6, 9, 10, 14, 21, 22, 37, 45] {
        let mut row = zero.row;
        row[at] += 1e-3;
        let faulty = Zero::of(&row, 2).expect("decided");
        let n = (0..STORED)
            .find(|n| places(*n).contains(&at))
            .expect("a place");
        for (m, e) in faulty.errors.iter().enumerate() {
            let due = if m == n { 1e-3 } else { zero.errors[m] };
            assert!((e - due).abs() < 1e-9 * due.max(1e-9), "{at} {m}");
        }
    }
    for at in 0..6 {
        let mut row = zero.row;
        row[at] += row[at].abs().max(1e-20) * 1e-3;
        let faulty = Zero::of(&row, 2).expect("decided");
        let due = row[at] - zero.row[at];
        assert!(
            (faulty.off / due.abs() - 1.0).abs() < 1e-6,
            "{at} {} {due}",
            faulty.off
        );
    }
    let all: std::collections::HashSet<usize> = (0..STORED).flat_map(places).collect();
    assert_eq!(
        (all.len(), all.iter().min(), all.iter().max()),
        (40, Some(&6), Some(&45))
    );
}

/// No part of the way down to the f64 next to a zero is left out, and none of it twice.
#[test]
fn rings_go_down_to_the_nearest() {
    let mut random = ChaCha8Rng::seed_from_u64(12);
    for (outer, least) in [(0.1, 1e-17), (1.0, 0.3), (1.0, 0.25), (0.7, 0.69)] {
        let all = rings(outer, least);
        let halvings = (outer / least).log2().ceil() as usize;
        assert_eq!(all.len(), 4 * halvings, "{outer} {least}");
        for _ in 0..500 {
            let mut unit = || (random.next_u64() >> 11) as f64 / 2f64.powi(53);
            let size = least * (outer / least).powf(unit());
            let (other, signs) = ((2.0 * unit() - 1.0) * size, unit());
            let size = if signs < 0.5 { size } else { -size };
            let point = if ((4.0 * signs) as u32).is_multiple_of(2) {
                [size, other]
            } else {
                [other, size]
            };
            let inside = |r: &&Signed| (0..2).all(|k| r[k][0] <= point[k] && point[k] <= r[k][1]);
            let met = all.iter().filter(inside).count();
            assert!((1..=2).contains(&met), "{point:?} {met}");
        }
    }
    assert_eq!(rings(0.25, 0.25), Vec::<Signed>::new());
}

#[test]
fn the_largest_bound_is_told_with_its_place() {
    let at = |x: f64| [[x, x + 0.125], [-0.25, 0.5]];
    let found = vec![(1.0, at(1.0)), (3.0, at(2.0)), (2.0, at(3.0))];
    assert_eq!(largest(found), Some((3.0, at(2.0))));
    assert_eq!(largest(Vec::new()), None);
    // The first zero is at 1.99 - 1.35i.
    let row = &ZEROS[0].row;
    let found = place(row, [[-0.25, 0.5], [-0.125, 1.0]]);
    assert_eq!(found.a, [row[0] - 0.25, row[0] + 0.5]);
    assert_eq!(found.b, [-row[3] - 1.0, -row[3] + 0.125]);
    let all = AroundZeros::of(&ZEROS[..2], Rounding::default(), 2.5).expect("proved");
    let at = all.at.expect("a place");
    let centre = [(at.a[0] + at.a[1]) / 2.0, -(at.b[0] + at.b[1]) / 2.0];
    let apart = |z: &Zero| (centre[0] - z.row[0]).hypot(centre[1] - z.row[3]);
    let apart = ZEROS[..2].iter().map(apart).fold(f64::INFINITY, f64::min);
    assert!(apart < 0.1, "{at:?} {apart}");
}

/// Next to a zero no f64 is nearer than the larger of the low parts of its coordinates.
#[test]
fn numbers_are_off_by_a_low_part() {
    let mut both = [false; 2];
    for zero in ZEROS.iter() {
        let [re, im] = [zero.row[1], zero.row[4]].map(f64::abs);
        both[usize::from(re > im)] = true;
        let due = if re > im { re } else { im };
        let [side, nearest] = zero.shells(1e-3);
        assert!((nearest / due - 1.0).abs() < 1e-13 && nearest < due);
        assert!((side * zero.row[0] / 1e-3 - 1.0).abs() < 1e-11 && side > 1e-3 / zero.row[0]);
    }
    assert_eq!(both, [true; 2]);
}

#[test]
fn rectangles_about_zeros_bit_by_bit() {
    let (_, reach) = code::zero_rows();
    let zeros = || ZEROS.iter();
    let all = zeros().map(|z| (z.size, &z.errors, z.off, z.shells(reach)));
    let within = zeros().flat_map(|z| [0.0, 1e-9, 1e-3, 0.05].map(|d| z.within(d)));
    let zero = &ZEROS[0];
    let mut parts = Vec::new();
    for at in [
        [[1e-3, 3e-3], [-1e-3, 1e-3]],
        [[1e-3, 5e-3], [-4e-3, 3e-3]],
        [[-1e-9, 1e-9], [1e-9, 2e-9]],
        [[1e-3, 2e-3], [1e-3, 2e-3]],
    ] {
        for target in [2.5, 1.0] {
            let mut found = Vec::new();
            let end = refine(zero, Rounding::default(), target, at, DEPTH - 8, &mut found);
            parts.push((end, found));
        }
    }
    // A bound that is the target serves.
    let at = [[1e-3, 1.01e-3], [1e-3, 1.01e-3]];
    let norm = bound(zero, Rounding::default(), &at).expect("a bound");
    let mut found = Vec::new();
    let end = refine(zero, Rounding::default(), norm, at, DEPTH, &mut found);
    parts.push((end, found));
    let two = AroundZeros::of(&ZEROS[..2], Rounding::default(), 2.5).expect("proved");
    let found = [
        counted("zeros", all),
        pinned::largest("within", within),
        counted("parts", parts),
        ("two of them", pinned::digest([two]), two.norm),
    ];
    let due = [
        ("zeros", 0x110c31ad11bc74dd, 12.0),
        ("within", 0x137e0031c442435a, 2.824036630784192e-17),
        ("parts", 0x361de2384495ba20, 9.0),
        ("two of them", 0x4df7bd6baa2d9033, 2.4991909462190756),
    ];
    bit_by_bit(&found, &due);
}
