//! Determinant, condition and pressure angle against the four equations as they stand.

use super::loops::unit;
use super::positions::{Positions, wrap};
use super::tests::{paper, zinchenko};
use super::*;
use crate::class_iii::geometry::Lengths;
use crate::units::{Angle, AngularVelocity};
use nalgebra::Matrix4;
use num_complex::Complex64;
use std::f64::consts::{PI, TAU};

fn other() -> ClassIii {
    let v = [0.4, 4.1, 2.7, 3.1, 2.2, 1.9, 0.8, 3.0, -1.5, 4.4, 1.7];
    ClassIii::new(Geometry::from_values(&v)).expect("a linkage")
}

fn states() -> Vec<(ClassIii, State)> {
    let mut all = Vec::new();
    for linkage in [zinchenko(), other()] {
        for k in 0..30 {
            let phi1 = 0.2 * f64::from(k);
            for mode in linkage.assembly_modes(Angle::from_rad(phi1)).modes {
                all.push((
                    linkage,
                    linkage
                        .state_near(Angle::from_rad(phi1), mode)
                        .expect("a state"),
                ));
            }
        }
    }
    assert!(all.len() > 80, "{}", all.len());
    all
}

/// Derivatives of the four loop equations in φ2 … φ5.
fn matrix(linkage: &ClassIii, p: &Positions) -> Matrix4<f64> {
    let (l, i) = (&linkage.l, Complex64::i());
    let zero = Complex64::new(0.0, 0.0);
    let (b, d) = (unit(p.phi4) * l.eb * l.lb, unit(p.phi4) * l.l4);
    let c = unit(p.phi3) * l.l3;
    let columns = [
        (i * unit(p.phi2) * l.l2, zero),
        (-i * c, i * c),
        (-i * b, i * d),
        (zero, -i * unit(p.phi5) * l.l5),
    ];
    Matrix4::from_fn(|row, k| match row {
        0 => columns[k].0.re,
        1 => columns[k].0.im,
        2 => columns[k].1.re,
        _ => columns[k].1.im,
    })
}

#[test]
fn determinants() {
    let mut sign = 0.0;
    for (linkage, s) in states() {
        let due = matrix(&linkage, &s.positions).determinant();
        let l = &linkage.l;
        let size = l.l2 * l.l5 * (l.l3 * (l.l4 + l.lb));
        assert!(
            (s.determinant.abs() - due.abs()).abs() < 1e-12 * size,
            "{due}"
        );
        if due.abs() > 1e-6 * size {
            // One orientation for all.
            let this = s.determinant.signum() * due.signum();
            assert!(sign == 0.0 || sign == this);
            sign = this;
        }
    }
}

/// Checks what the certificate of the continuation rests on: `β` bounds the inverse for residuals
/// of length one, and the Lipschitz constant the change of the derivatives.
#[test]
fn conditions_bound_the_inverse() {
    for (linkage, s) in states() {
        let l = &linkage.l;
        let beta = s.condition / (l.l2 + l.l3 + l.lb).max(l.l3 + l.l4 + l.l5);
        let inverse = matrix(&linkage, &s.positions)
            .try_inverse()
            .expect("regular");
        // The largest |x_i| for |r1| ≤ 1, |r2| ≤ 1.
        let exact = (0..4)
            .map(|i| {
                inverse[(i, 0)].hypot(inverse[(i, 1)]) + inverse[(i, 2)].hypot(inverse[(i, 3)])
            })
            .fold(0.0, f64::max);
        assert!(beta >= exact * (1.0 - 1e-10), "{beta} {exact}");
        // Each unknown's row: φ3 and φ4 exactly, φ2 and φ5 by the triangle's inequality.
        let row = |i: usize| {
            inverse[(i, 0)].hypot(inverse[(i, 1)]) + inverse[(i, 2)].hypot(inverse[(i, 3)])
        };
        let (x3, x4) = (row(1), row(2));
        let x2 = (1.0 + l.l3 * x3 + l.lb * x4) / l.l2;
        let x5 = (1.0 + l.l3 * x3 + l.l4 * x4) / l.l5;
        let due = x2.max(x3).max(x4).max(x5);
        assert!((beta / due - 1.0).abs() < 1e-9, "{beta} {due}");
    }
    let l = zinchenko().l;
    // 104 + 60 + 22 against 60 + 64 + 48.5 centimetres; and the other way round.
    assert!((l.lipschitz() - 1.86).abs() < 1e-15);
    let l = other().l;
    assert!((l.lipschitz() - 8.7).abs() < 1e-14);
    let turned = Lengths { l2: 1.0, ..l };
    assert!((turned.lipschitz() - 8.0).abs() < 1e-14);
}

/// The angle between link 2 and the way of B while links 3, 4, 5 move without it.
#[test]
fn pressure_angles() {
    for (linkage, s) in states() {
        let (l, i, p) = (&linkage.l, Complex64::i(), &s.positions);
        // Turn link 4 by a little and link 3 so that D stays on its circle about O5: the second
        // loop along link 5, i e3 l3 φ3' + i e4 l4 φ4' ⊥ e5.
        let along = |z: Complex64| (z * unit(p.phi5).conj()).re;
        let (c, d) = (i * unit(p.phi3) * l.l3, i * unit(p.phi4) * l.l4);
        let (w3, w4) = (-along(d), along(c));
        let path = c * w3 + i * unit(p.phi4) * l.eb * l.lb * w4;
        let turn = (path / unit(p.phi2)).arg().abs();
        let due = turn.min(PI - turn);
        assert!(
            (s.pressure_angle - due).abs() < 1e-10,
            "{} {due}",
            s.pressure_angle
        );
    }
}

#[test]
fn rates_at_the_speed_of_the_crank() {
    let (_, s) = states()[5];
    let (w, e) = s
        .rates
        .at_crank_speed(AngularVelocity::from_rad_per_s(3.0), -5.0);
    for i in 0..4 {
        let (first, second) = (s.rates.first[i], s.rates.second[i]);
        assert!((w[i] - 3.0 * first).abs() < 1e-15 * first.abs());
        assert!((e[i] - (9.0 * second - 5.0 * first)).abs() < 1e-13);
    }
}

/// Points of links, with their derivatives along the branch.
#[test]
fn points_by_differences() {
    let arms = [
        (Link::Crank, 0.7, 0.3),
        (Link::Link2, 1.1, -0.4),
        (Link::Link3, 0.9, 1.0),
        (Link::Link4, 1.3, 2.0),
        (Link::Link5, 0.6, -1.2),
    ];
    let mut met = 0;
    for (linkage, s) in states().into_iter().step_by(7) {
        if s.condition > 30.0 {
            continue;
        }
        let h = 1e-4;
        let near = |k: f64| {
            linkage
                .follow(&s, Angle::from_rad(s.phi1 + k * h))
                .expect("a state")
        };
        let (before, after) = (near(-1.0), near(1.0));
        let [_, b, c, d] = s.joints();
        let l = linkage.geometry();
        for (link, r, a) in arms {
            let at = s.point(link, r, a);
            let (x, z) = (before.point(link, r, a).r, after.point(link, r, a).r);
            for i in 0..2 {
                let first = (z[i] - x[i]) / (2.0 * h);
                let second = (z[i] - 2.0 * at.r[i] + x[i]) / (h * h);
                let scale = 1.0 + s.condition.powi(3);
                assert!((at.first[i] - first).abs() < 1e-6 * scale, "{link:?}");
                assert!((at.second[i] - second).abs() < 1e-5 * scale, "{link:?}");
            }
            // Its distance from the joint that the arm begins at.
            let origin = match link {
                Link::Crank => [0.0; 2],
                Link::Link2 => s.joints()[0],
                Link::Link3 => [l.x3.m(), l.y3.m()],
                Link::Link4 => c,
                Link::Link5 => [l.x5.m(), l.y5.m()],
            };
            let off = (at.r[0] - origin[0]).hypot(at.r[1] - origin[1]);
            assert!((off - r).abs() < 1e-14, "{link:?}");
            // The results without accelerations are the same.
            let v = linkage
                .velocities(Angle::from_rad(s.phi1), s.positions)
                .expect("regular");
            let along = v.point_along(link, unit(a) * r);
            assert!(
                (0..2).all(|i| (along[i] - at.first[i]).abs() < 1e-13),
                "{link:?}"
            );
        }
        // B and D as points of link 4, B as one of link 2.
        let close = |p: [f64; 2], q: [f64; 2]| (p[0] - q[0]).hypot(p[1] - q[1]) < 1e-12;
        assert!(close(s.point(Link::Link4, l.lb.m(), l.phi_b.rad()).r, b));
        assert!(close(s.point(Link::Link4, l.l4.m(), 0.0).r, d));
        assert!(close(s.point(Link::Link2, l.l2.m(), 0.0).r, b));
        met += 1;
    }
    assert!(met > 5, "{met}");
}

#[test]
fn angles_are_wrapped_into_one_turn() {
    for k in -3..=3 {
        for x in [-3.0, -1.0, 0.0, 0.5, 3.0] {
            let off = (wrap(x + TAU * f64::from(k)) - x).abs();
            assert!(off < 4e-15, "{x} {k}");
        }
    }
    assert_eq!((wrap(PI), wrap(-PI)), (PI, PI));
    assert_eq!(wrap(3.0 * PI), PI);
    assert_eq!(wrap(-3.0), -3.0);
    // Inside the turn nothing is touched, not even the sign of zero.
    assert!(wrap(-0.0).is_sign_negative() && wrap(0.0).is_sign_positive());
    for x in [PI, -PI.next_down(), 3.0, -3.125] {
        assert_eq!(wrap(x), x);
    }
    let p = Positions::from_array([4.0, -4.0, 1.0, 10.0]);
    let q = p.wrapped().to_array();
    assert!(p.distance(p.wrapped()) < 1e-15 && q.iter().all(|x| x.abs() <= PI));
    let away = Positions::from_array([4.0, -4.0 - TAU, 1.25, 10.0]);
    assert!((p.distance(away) - 0.25).abs() < 1e-15);
}

/// A guess that is not taken is told its distance by the first correction.
#[test]
fn corrections_that_are_too_large() {
    for (linkage, s) in states().into_iter().step_by(11) {
        if s.condition > 20.0 {
            continue;
        }
        let mut p = s.positions.to_array();
        p[2] += 0.012;
        let e = linkage.state_near(Angle::from_rad(s.phi1), Positions::from_array(p));
        let Err(ContinuationError::NotClosed { phi1, correction }) = e else {
            panic!("{e:?}");
        };
        assert_eq!(phi1, s.phi1);
        assert!((correction / 0.012 - 1.0).abs() < 0.3, "{correction}");
    }
}

/// Dead positions backwards, and one that the search starts at or ends on.
#[test]
fn dead_positions_either_way() {
    let linkage = zinchenko();
    let start = paper(0.0);
    let there = linkage
        .dead_positions(&start, Angle::from_rad(TAU))
        .expect("a turn");
    let end = linkage
        .follow(&start, Angle::from_rad(TAU))
        .expect("a turn");
    let back = linkage
        .dead_positions(&end, Angle::from_rad(0.0))
        .expect("a turn");
    assert_eq!((there.len(), back.len()), (2, 2));
    for (a, b) in there.iter().zip(back.iter().rev()) {
        assert!((a.state.phi1 - b.state.phi1).abs() < 1e-13);
        assert_eq!(a.stretched, b.stretched);
        let line = (a.state.positions.phi2 - a.state.phi1).sin();
        assert!(line.abs() < 1e-15, "{line}");
    }
    // In steps of a quarter of a turn each is found once.
    let mut found = 0;
    let mut here = start;
    for k in 1..=4 {
        let to = TAU * f64::from(k) / 4.0;
        found += linkage
            .dead_positions(&here, Angle::from_rad(to))
            .expect("a quarter")
            .len();
        here = linkage
            .follow(&here, Angle::from_rad(to))
            .expect("a quarter");
    }
    assert_eq!(found, 2);
    assert!(
        linkage
            .dead_positions(&start, Angle::from_rad(start.phi1))
            .expect("nothing")
            .is_empty()
    );
}

/// Folds: where the modes of a row end, in pairs, at the angle at which their number changes.
#[test]
fn folds_of_a_turn() {
    for linkage in [zinchenko(), other()] {
        let angles: Vec<Angle> = (0..=90)
            .map(|k| Angle::from_rad(TAU * f64::from(k) / 90.0))
            .collect();
        let map = linkage.trace_branches(&angles);
        let count = |phi1: f64| linkage.assembly_modes(Angle::from_rad(phi1)).modes.len() as i64;
        for f in &map.folds {
            assert_eq!(f.branches.len(), 2, "{f:?}");
            let change = count(f.phi1 + 1e-7) - count(f.phi1 - 1e-7);
            assert_eq!(change, if f.begins { 2 } else { -2 }, "{f:?}");
            // A square root of a distance of 1e-12 rad.
            let r = super::assembly::Resultant::new(&linkage.l, unit(f.phi1));
            let (d, x) = r.merging(f.phi4).expect("a distance");
            assert!(d.abs() < 1e-10, "{f:?}: {d}");
            assert!(wrap(x - f.phi4).abs() < 1e-6, "{f:?}: {x}");
        }
        for (row, &phi1) in map.rows.iter().zip(&angles) {
            assert_eq!(row.len() as i64, count(phi1.rad()), "{phi1:?}");
        }
        let born = map.folds.iter().filter(|f| f.begins).count();
        let first = map.rows[0].len();
        assert_eq!(map.branches, first + 2 * born);
    }
}
