use super::*;
use crate::at_points::error;
use crate::pinned::{bit_by_bit, counted, digest, units};
use mechaudit_solvers::faddeeva::{Branch, branch};
use num_complex::Complex;
use rand::rngs::ChaCha8Rng;
use rand::{Rng, SeedableRng};
use std::sync::LazyLock;

static ZEROS: LazyLock<Vec<Zero>> = LazyLock::new(|| AroundZeros::rows().expect("decided"));

fn proved(zeros: &[Zero]) -> f64 {
    let found = AroundZeros::of(zeros, Rounding::default(), 2.5);
    found.map_or(f64::INFINITY, |f| f.norm)
}

/// All zeros, and how far each is from what is stored.
#[test]
fn bounds_about_zeros_bit_by_bit() {
    let all = ZEROS.iter().map(|z| (z.size, &z.errors, z.off));
    let found = AroundZeros::of(&ZEROS, Rounding::default(), 2.5).expect("proved");
    assert!(found.norm > 1.0 && found.boxes > 1000);
    let found = [
        counted("zeros", all),
        ("bound", digest([found]), found.norm),
    ];
    let due = [
        ("zeros", 0x95681be5b92d2498, 12.0),
        ("bound", 0x0bbae64f6ad54afa, 2.4990503538045017),
    ];
    bit_by_bit(&found, &due);
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
            let off = error(z.re, z.im);
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
    let mut unit = units(12);
    for (outer, least) in [(0.1, 1e-17), (1.0, 0.3), (1.0, 0.25), (0.7, 0.69)] {
        let all = rings(outer, least);
        let halvings = (outer / least).log2().ceil() as usize;
        assert_eq!(all.len(), 4 * halvings, "{outer} {least}");
        for _ in 0..500 {
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
