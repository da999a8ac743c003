//! Describes what is told of a state: curvature, determinant, gap, transmission angle.

use super::super::tests::*;
use super::*;
use crate::planar::{Mechanism, Point, SingularKind};

#[test]
fn curvature_is_that_of_the_circle() {
    let moving = |first: [f64; 2], second: [f64; 2]| PointMotion {
        r: [7.0, 9.0],
        first,
        second,
    };
    assert_eq!(curvature(&moving([2.0, 0.0], [0.0, 3.0])), 0.75);
    assert_eq!(curvature(&moving([3.0, 4.0], [-1.0, 2.0])), 0.08);
    assert_eq!(curvature(&moving([3.0, 4.0], [2.0, 6.0])), 0.08);
    assert!(curvature(&moving([0.0, 0.0], [0.0, 0.0])).is_nan());
    // A point of the crank goes round its pin, 0.3 m along and 0.4 m across, counter-clockwise.
    let m = driver();
    let state = &m.assembly_modes(0.7).states[0];
    let k = curvature(&m.point(state, &Point::from_m(1, [0.6, 0.4])));
    assert!((k - 2.0).abs() < 1e-14, "{k}");
}

/// ± b c sin γ in the solver's unit of length, of different signs in the two modes.
#[test]
fn the_determinant_of_a_four_bar() {
    let (b, c) = (0.4, 0.3);
    let m = four_bar([0.1, b, c, 0.35]);
    let modes = m.assembly_modes(0.4).states;
    let found = [0, 1].map(|k| {
        let gamma = m.transmission(&modes[k], 1).unwrap().rad();
        let due = b * c * gamma.sin() / m.chain.metres.powi(2);
        let found = modes[k].determinant();
        assert!((found.abs() - due).abs() < 1e-14, "{found} {due}");
        found
    });
    assert!(found[0] * found[1] < 0.0);
    assert!(found[0].abs() > 0.5 && found[0].abs() != 1.0, "{found:?}");
}

/// A rocker turned by a little opens the pin by the arc, whatever the unit of length.
#[test]
fn the_gap_is_in_metres() {
    for size in [1e-3, 1.0, 1e4] {
        let m = four_bar([0.1, 0.4, 0.3, 0.35].map(|l| l * size));
        let closed = &m.assembly_modes(0.4).states[0];
        let c = m.body_angle(closed, 3).angle.rad();
        let mut u = closed.pose.u.clone();
        let at = u.iter().position(|u| turn(*u, c) < 1e-12).unwrap();
        u[at] += 1e-6;
        let open = State::new(&m, Pose::new(&m.chain, 0.4, u)).unwrap();
        let due = 0.3 * size * 1e-6 * c.sin().abs().max(c.cos().abs());
        let gap = m.gap(&open);
        assert!((gap / due - 1.0).abs() < 1e-5, "{gap} {due}");
        assert!(m.gap(closed) < 1e-15 * size);
    }
}

/// Where coupler and rocker lie on one line the Jacobian is singular, to the last bit where the
/// angles are zero.
#[test]
fn a_singular_pose_has_no_rates() {
    let m = four_bar([1.0, 1.0, 1.0, 1.0]);
    assert!(State::new(&m, Pose::new(&m.chain, 0.0, vec![0.0, 0.0])).is_none());
    assert!(State::new(&m, Pose::new(&m.chain, 0.0, vec![0.0, 1.0])).is_some());
}

/// The angle between the links of a dyad, whatever hangs on them.
#[test]
fn what_hangs_on_a_dyad_leaves_its_transmission_angle() {
    let plain = four_bar([0.1, 0.4, 0.3, 0.35]);
    let mut both = plain.description().clone();
    // A dyad that two links of the first one carry, and one on the coupler and the ground.
    let [p, q, r, s] = ["p", "q", "r", "s"].map(|n| both.body(n));
    both.pin("P", &[(2, [0.1, 0.2]), (p, [0.0, 0.0])]);
    both.pin("Q", &[(3, [0.1, 0.2]), (q, [0.0, 0.0])]);
    both.pin("PQ", &[(p, [0.4, 0.0]), (q, [0.5, 0.0])]);
    both.pin("R", &[(2, [0.2, -0.1]), (r, [0.0, 0.0])]);
    both.pin("S", &[(0, [0.1, 0.5]), (s, [0.0, 0.0])]);
    both.pin("RS", &[(r, [0.5, 0.0]), (s, [0.4, 0.0])]);
    let both = Mechanism::new(both).unwrap();
    let angle = |m: &Mechanism, s: &State, body: usize| m.body_angle(s, body).angle.rad();
    let mut seen = 0;
    for state in &both.assembly_modes(0.4).states {
        let modes = plain.assembly_modes(0.4).states;
        let same = |x: &&State| turn(angle(&plain, x, 3), angle(&both, state, 3)) < 1e-9;
        let due = plain.transmission(modes.iter().find(same).unwrap(), 1);
        let groups = &both.structure().groups;
        let first = groups.iter().position(|g| g.bodies == [2, 3]).unwrap();
        let found = both.transmission(state, first).unwrap().rad();
        assert!((found - due.unwrap().rad()).abs() < 1e-12);
        // Of the second dyad the links meet at their far ends: the angle between their directions.
        let second = groups.iter().position(|g| g.bodies == [p, q]).unwrap();
        let found = both.transmission(state, second).unwrap().rad();
        let inner = [p, q].map(|b| angle(&both, state, b));
        let apart = turn(inner[0], inner[1]);
        assert!((found - apart).abs() < 1e-9, "{found} {apart}");
        seen += 1;
    }
    assert!(seen > 0);
    // The driver is no dyad.
    assert!(
        plain
            .transmission(&plain.assembly_modes(0.4).states[0], 0)
            .is_none()
    );
}

/// A four-bar whose links fold onto the frame together, seen from a little before: both branches
/// cross there.
#[test]
fn a_change_point_is_found_from_beside_it() {
    use std::f64::consts::PI;
    let m = four_bar([0.25, 0.75, 0.5, 1.0]);
    for start in m.assembly_modes(PI - 0.3).states {
        for before in [3e-6, 1e-6] {
            let last = m.follow(&start, PI - before).unwrap();
            let found = m.singularity(&last).unwrap();
            assert_eq!(found.kind, SingularKind::ChangePoint);
            let off = (found.drive - PI).abs();
            assert!(off < 1e-9, "{off:e} from {before:e}");
            for angle in &found.angles {
                let straight = turn(2.0 * angle, 0.0);
                assert!(straight < 1e-8, "{:?}", found.angles);
            }
        }
    }
}
