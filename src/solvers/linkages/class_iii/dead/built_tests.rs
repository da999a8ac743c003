//! Dead positions of linkages that are built about one.

use super::super::loops::unit;
use super::super::{Geometry, Positions};
use super::*;
use num_complex::Complex64;
use std::f64::consts::PI;

/// Crank 1 and link 2 in one line at the crank angle `phi1`, and the positions there.
fn built(phi1: f64, l2: f64, stretched: bool) -> (ClassIii, Positions) {
    let at = |x: f64, y: f64| Complex64::new(x, y) * unit(phi1);
    let b = at(if stretched { 1.0 + l2 } else { 1.0 - l2 }, 0.0);
    let c = b + at(1.5, 0.3);
    let d = c + at(1.0, -0.8);
    let (o3, o5) = (c + at(0.2, -2.0), d + at(0.6, -1.7));
    let link = |z: Complex64| (z.norm(), z.arg());
    let ((l3, phi3), (l4, phi4), (l5, phi5), (lb, phi_cb)) =
        (link(c - o3), link(d - c), link(d - o5), link(b - c));
    let v = [
        1.0,
        l2,
        l3,
        l4,
        l5,
        lb,
        phi_cb - phi4,
        o3.re,
        o3.im,
        o5.re,
        o5.im,
    ];
    let phi2 = if stretched { phi1 } else { phi1 + PI };
    let linkage = ClassIii::new(Geometry::from_values(&v)).expect("a linkage");
    (linkage, Positions::from_array([phi2, phi3, phi4, phi5]))
}

/// In any direction, with links 2 of any length beside the crank, and on the way back.
#[test]
fn dead_positions_where_they_were_built() {
    for k in 0..12 {
        let phi1 = 0.3 + 0.5 * f64::from(k);
        for l2 in [1.5, 2.0, 5.0] {
            for stretched in [true, false] {
                let (linkage, p) = built(phi1, l2, stretched);
                let here = linkage
                    .state_near(Angle::from_rad(phi1), p)
                    .expect("a state");
                for way in [0.013, -0.013] {
                    let start = linkage
                        .follow(&here, Angle::from_rad(phi1 - way))
                        .expect("a state");
                    let found = linkage
                        .dead_positions(&start, Angle::from_rad(phi1 + way))
                        .expect("a way");
                    assert_eq!(found.len(), 1, "{phi1} {l2} {stretched}");
                    assert_eq!(found[0].stretched, stretched, "{phi1} {l2}");
                    let off = (found[0].state.phi1 - phi1).abs();
                    assert!(off < 1e-14, "{phi1} {l2} {stretched}: {off}");
                }
            }
        }
    }
}

/// A dead position at the start counts, one at the end does not.
#[test]
fn dead_positions_at_the_ends() {
    let (linkage, p) = built(0.0, 2.0, true);
    let mut here = linkage
        .state_near(Angle::from_rad(0.0), p)
        .expect("a state");
    here.positions.phi2 = 0.0;
    let found = linkage
        .dead_positions(&here, Angle::from_rad(0.01))
        .expect("a way");
    assert_eq!(found.len(), 1);
    assert!(found[0].state.phi1.abs() < 1e-15);
}

/// As many steps as the way is long, also across the angle zero.
#[test]
fn dead_positions_on_both_sides_of_zero() {
    let linkage = super::super::tests::zinchenko();
    let middle = super::super::tests::paper(0.0);
    for from in [PI, -PI] {
        let start = linkage
            .follow(&middle, Angle::from_rad(from))
            .expect("a state");
        let found = linkage
            .dead_positions(&start, Angle::from_rad(-from))
            .expect("a turn");
        assert_eq!(found.len(), 2);
    }
}
