//! The parts of the search for assembly modes, one by one.

use super::super::tests::zinchenko;
use super::super::{Geometry, GeometryError};
use super::zero_tests::expanded;
use super::*;

fn other() -> ClassIii {
    let v = [1.3, 4.1, 2.7, 3.1, 2.2, 1.9, 0.8, 3.0, -1.5, 4.4, 1.7];
    ClassIii::new(Geometry::from_values(&v)).expect("a linkage")
}

fn angles() -> impl Iterator<Item = f64> {
    (0..24).map(|k| f64::from(k) * 0.27 - 3.1)
}

/// `T` from the loop equations: `|P q − Q p|² − 4 l3² Im(p̄q)²`, and what its terms are made of.
fn resultant_by_definition(l: &Lengths, phi1: f64, theta: f64) -> (f64, f64) {
    let p = l.o3 - l.o5 + unit(theta) * l.l4;
    let q = l.o3 - unit(phi1) * l.l1 + unit(theta) * l.eb * l.lb;
    let pp = l.l5 * l.l5 - l.l3 * l.l3 - p.norm_sqr();
    let qq = l.l2 * l.l2 - l.l3 * l.l3 - q.norm_sqr();
    let t = (q * pp - p * qq).norm_sqr() - 4.0 * l.l3 * l.l3 * (p.conj() * q).im.powi(2);
    let sizes = |k: f64, p: Complex64| k * k + l.l3 * l.l3 + p.norm_sqr();
    let size = q.norm() * sizes(l.l5, p) + p.norm() * sizes(l.l2, q);
    (t, size * size + 4.0 * (l.l3 * p.norm() * q.norm()).powi(2))
}

#[test]
fn the_polynomial_and_its_coefficients() {
    for linkage in [zinchenko(), other()] {
        for phi1 in angles() {
            let r = Resultant::new(&linkage.l, unit(phi1));
            let c = r.coefficients();
            for theta in angles() {
                let v = r.value(theta);
                let (t, size) = resultant_by_definition(&linkage.l, phi1, theta);
                assert!((v.t - t).abs() <= 1e-13 * size, "{} {t}", v.t);
                let series: f64 = (1..=3)
                    .map(|k| 2.0 * (c[k] * unit(k as f64 * theta)).re)
                    .sum();
                let off = (c[0].re + series - t).abs();
                assert!(off <= 1e-13 * size, "{off} {size}");
                // The estimate covers the rounding, and is not larger than its terms say.
                assert!((v.t - t).abs() <= v.noise, "{} {t} {}", v.t, v.noise);
                let unit = 16.0 * f64::EPSILON * size;
                assert!(
                    v.noise >= 0.1 * unit && v.noise <= 40.0 * unit,
                    "{}",
                    v.noise / unit
                );
                let l = &linkage.l;
                let p = r.p0 + super::unit(theta) * l.l4;
                let q = r.q0 + super::unit(theta) * r.q1;
                // |P q| + |Q p| + 2 l3 |p| |q|, with P and Q at their largest on the circles.
                let at_most = |k: f64, p0: Complex64, l4: f64| {
                    (k - p0.norm_sqr() - l4 * l4).abs() + 2.0 * p0.norm() * l4
                };
                let pp = at_most(l.l5 * l.l5 - l.l3 * l.l3, l.o3 - l.o5, l.l4);
                let qq = at_most(l.l2 * l.l2 - l.l3 * l.l3, r.q0, l.lb);
                let terms = q.norm() * pp + p.norm() * qq + 2.0 * l.l3 * p.norm() * q.norm();
                let ratio = v.noise / (16.0 * f64::EPSILON * terms * terms);
                assert!((ratio - 1.0).abs() < 1e-10, "{ratio}");
                // T compares |u|² with l3².
                let (left, right) = (v.u.norm_sqr() / (l.l3 * l.l3) - 1.0, v.right * v.right);
                assert!((left * right - v.t).abs() <= v.noise, "{left} {right}");
                // u lies on both lines.
                for (line, normal) in v.lines.iter().zip([p, q]) {
                    assert!((line.normal - normal).norm() < 1e-14);
                    let off = 2.0 * dot(v.u, normal) - line.c;
                    let known = (v.noise / f64::EPSILON).sqrt() / v.right.abs();
                    let size = line.terms * known;
                    assert!(off.abs() <= 1e-14 * size, "{off} {size}");
                }
            }
        }
    }
}

/// Between the angles of the partition `T` is monotone: its derivative vanishes at none of them
/// only where a root of `T′` is off the circle.
#[test]
fn the_partition_holds_all_extremes() {
    for linkage in [zinchenko(), other()] {
        for phi1 in angles() {
            let r = Resultant::new(&linkage.l, unit(phi1));
            let at = r.partition();
            assert_eq!(at.len(), 6);
            assert!(at.windows(2).all(|w| w[0] <= w[1]));
            let n = 4000;
            let t = |k: i32| {
                r.value(f64::from(k) * std::f64::consts::TAU / f64::from(n))
                    .t
            };
            for k in 0..n {
                let (a, b, c) = (t(k - 1), t(k), t(k + 1));
                if (b - a) * (c - b) < 0.0 {
                    let x = f64::from(k) * std::f64::consts::TAU / f64::from(n);
                    let near = at.iter().any(|p| wrap(p - x).abs() < 2e-3);
                    assert!(near, "{phi1}: {x} {at:?}");
                }
            }
        }
    }
}

/// The crank angle at which a pair of modes merges, to the last bit, by the number of modes.
fn fold(linkage: &ClassIii, mut with: f64, mut without: f64) -> f64 {
    let n = linkage.assembly_modes(Angle::from_rad(with)).modes.len();
    for _ in 0..60 {
        let middle = 0.5 * (with + without);
        match linkage.assembly_modes(Angle::from_rad(middle)).modes.len() == n {
            true => with = middle,
            false => without = middle,
        }
    }
    with
}

/// Places where the number of modes changes in a turn.
fn folds(linkage: &ClassIii) -> Vec<(f64, f64)> {
    let count = |phi1: f64| linkage.assembly_modes(Angle::from_rad(phi1)).modes.len();
    (0..360)
        .map(|k| (f64::from(k).to_radians(), f64::from(k + 1).to_radians()))
        .filter_map(|(a, b)| match count(a).cmp(&count(b)) {
            std::cmp::Ordering::Greater => Some((a, b)),
            std::cmp::Ordering::Less => Some((b, a)),
            std::cmp::Ordering::Equal => None,
        })
        .collect()
}

#[test]
fn merging_pairs() -> Result<(), GeometryError> {
    let mut met = 0;
    for linkage in [zinchenko(), other()] {
        for (with, without) in folds(&linkage) {
            let at = fold(&linkage, with, without);
            let inwards = (with - at).signum();
            // Close by the modes are nearly one: said so next to the fold, not farther off.
            assert!(
                linkage.assembly_modes(Angle::from_rad(at)).near_fold,
                "{at}"
            );
            assert!(
                !linkage
                    .assembly_modes(Angle::from_rad(at + 1e-5 * inwards))
                    .near_fold,
                "{at}"
            );
            assert!(
                !linkage
                    .assembly_modes(Angle::from_rad(at - 1e-5 * inwards))
                    .near_fold,
                "{at}"
            );
            for off in [1e-5, 1e-4] {
                let phi1 = at + off * inwards;
                let modes = linkage.assembly_modes(Angle::from_rad(phi1)).modes;
                let gap = |i: usize, j: usize| modes[i].distance(modes[j]);
                let (i, j) = (0..modes.len())
                    .flat_map(|i| (0..i).map(move |j| (i, j)))
                    .min_by(|a, b| gap(a.0, a.1).total_cmp(&gap(b.0, b.1)))
                    .expect("a pair");
                let due = wrap(modes[i].phi4 - modes[j].phi4).powi(2);
                let r = |phi1: f64| Resultant::new(&linkage.l, unit(phi1));
                let (d, x) = r(phi1).merging(modes[i].phi4).expect("a distance");
                assert!((d / due - 1.0).abs() < 0.02, "{phi1}: {d} {due}");
                let middle = modes[j].phi4 + 0.5 * wrap(modes[i].phi4 - modes[j].phi4);
                assert!(wrap(x - middle).abs() < 0.02 * due.sqrt(), "{x} {middle}");
                // Linear through zero.
                let beyond = r(at - off * inwards).merging(x).expect("a distance").0;
                assert!((beyond / d + 1.0).abs() < 0.02, "{beyond} {d}");
                met += 1;
            }
        }
    }
    assert!(met >= 8, "{met}");
    Ok(())
}

#[test]
fn roots_of_polynomials() {
    let c = Complex64::new;
    let sets = [
        vec![c(0.5, 0.2), c(-1.0, 0.3), c(0.1, -2.0), c(3.0, 1.0)],
        vec![
            c(1.0, 0.0),
            c(-1.0, 0.0),
            c(0.0, 1.0),
            c(0.0, -1.0),
            c(0.6, 0.8),
            c(0.6, -0.8),
        ],
        vec![c(2.0, -1.0)],
        vec![c(1e-3, 0.0), c(1e3, 0.0)],
    ];
    for roots in sets {
        let p = expanded(&roots).into_iter().map(|a| a * c(1.5, -0.5));
        let p: Vec<Complex64> = p.collect();
        // Zeros at both ends are left out: roots at 0 and at infinity.
        for (before, after) in [(0, 0), (2, 1)] {
            let mut padded = vec![c(0.0, 0.0); before];
            padded.extend(&p);
            padded.extend(vec![c(0.0, 0.0); after]);
            let found = polynomial_roots(&padded);
            assert_eq!(found.len(), roots.len());
            for r in &roots {
                let near = found
                    .iter()
                    .map(|f| (f - r).norm())
                    .fold(f64::MAX, f64::min);
                assert!(near < 1e-12 * (1.0 + r.norm()), "{r}: {found:?}");
            }
        }
    }
    assert!(polynomial_roots(&[]).is_empty());
    assert!(polynomial_roots(&[c(0.0, 0.0); 3]).is_empty());
    assert!(polynomial_roots(&[c(0.0, 0.0), c(2.0, 0.0)]).is_empty());
}
