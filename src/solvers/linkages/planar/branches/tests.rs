use super::super::tests::*;
use super::super::*;
use super::*;
use crate::class_iii::{ClassIii, Geometry};
use crate::units::Angle;
use std::f64::consts::TAU;

#[test]
fn folds_are_those_of_the_special_solver() {
    let special = ClassIii::new(Geometry::from_values(&SAND_SCREEN)).unwrap();
    let general = class_iii(&SAND_SCREEN);
    let start = 14.426f64.to_radians();
    let drives: Vec<f64> = (0..=48)
        .map(|k| start + (7.5 * f64::from(k)).to_radians())
        .collect();
    let angles: Vec<Angle> = drives.iter().map(|&x| Angle::from_rad(x)).collect();
    let due = special.trace_branches(&angles);
    let map = general.trace_branches(&drives);
    assert!(map.complete && map.unmatched == 0);
    assert_eq!(
        (map.branches, map.ends.len()),
        (due.branches, due.folds.len())
    );
    for (end, fold) in map.ends.iter().zip(&due.folds) {
        let at = end.at.as_ref().unwrap();
        assert_eq!((at.kind, end.begins), (SingularKind::Fold, fold.begins));
        assert_eq!(end.branches.len(), 2);
        assert!((at.drive - fold.phi1).abs() < 1e-9, "{at:?} {fold:?}");
        assert!(turn(at.angles[3], fold.phi4) < 1e-6);
    }
    assert_eq!(map.rows.len(), drives.len());
    for (row, other) in map.rows.iter().zip(&due.rows) {
        assert_eq!(row.len(), other.len());
        for (k, a) in row.iter().enumerate() {
            let apart = |b: &BranchSample| general.distance(&a.state, &b.state);
            assert!(row[..k].iter().all(|b| apart(b) > 1e-3));
        }
    }
}

/// Two dyads on one crank: the rockers' lengths with their pivots.
fn two_rockers(first: [f64; 3], second: [f64; 3]) -> Mechanism {
    let mut d = Description::new();
    let crank = d.body("crank");
    d.pin("O", &[(GROUND, [0.0, 0.0]), (crank, [0.0, 0.0])]);
    for [b, c, x] in [first, second] {
        let [coupler, rocker] = ["coupler", "rocker"].map(|n| d.body(n));
        d.pin("A", &[(crank, [0.2, 0.0]), (coupler, [0.0, 0.0])]);
        d.pin("B", &[(coupler, [b, 0.0]), (rocker, [c, 0.0])]);
        d.pin("C", &[(GROUND, [x, 0.0]), (rocker, [0.0, 0.0])]);
    }
    Mechanism::new(d).unwrap()
}

/// At a fold of one of two dyads the other has two positions: two ends at the same value of the
/// drive.
#[test]
fn ends_at_the_same_drive_are_told_apart() {
    // The first dyad is stretched where the crank's pin is 0.3 off (0.4, 0).
    let m = two_rockers([0.2, 0.1, 0.4], [0.5, 0.5, 0.5]);
    let fold = ((0.04 + 0.16 - 0.09f64) / 0.16).acos();
    let map = m.trace_branches(&[0.2, 0.5, 0.9, 1.2]);
    assert!(map.complete && map.unmatched == 0 && map.branches == 4);
    assert_eq!(map.ends.len(), 2);
    for end in &map.ends {
        assert!(
            (end.at.as_ref().unwrap().drive - fold).abs() < 1e-9,
            "{end:?}"
        );
        assert!(end.branches.len() == 2 && !end.begins);
    }
    let mut all: Vec<usize> = map.ends.iter().flat_map(|e| e.branches.clone()).collect();
    all.sort_unstable();
    assert_eq!(all, [0, 1, 2, 3]);
    let lengths: Vec<usize> = map.rows.iter().map(Vec::len).collect();
    assert_eq!(lengths, [4, 4, 0, 0]);
    // The other way they begin there.
    let back = m.trace_branches(&[1.2, 0.5]);
    assert_eq!((back.branches, back.ends.len(), back.unmatched), (4, 2, 0));
    assert!(back.ends.iter().all(|e| e.begins && e.branches.len() == 2));
}

/// Ends stand in the order of the drive, whatever the order of their branches; those that are not
/// refined stand alone.
#[test]
fn ends_are_in_order() {
    let m = four_bar([0.1, 0.4, 0.3, 0.35]);
    let sample = |branch: usize, drive: f64| BranchSample {
        branch,
        state: m.assembly_modes(drive).states[0].clone(),
    };
    let samples = vec![sample(0, 0.9), sample(1, 0.2), sample(2, 0.5)];
    let ends = m.grouped(samples, true);
    let order: Vec<&[usize]> = ends.iter().map(|e| &e.branches[..]).collect();
    assert_eq!(order, [[1], [2], [0]]);
    assert!(ends.iter().all(|e| e.begins && e.at.is_none()));
}

/// A branch met twice, and positions that were not there before though nothing begins: each is
/// counted.
#[test]
fn what_does_not_match_is_counted() {
    let m = four_bar([0.1, 0.4, 0.3, 0.35]);
    let states = m.assembly_modes(0.3).states;
    let sample = |branch: usize, k: usize| BranchSample {
        branch,
        state: states[k].clone(),
    };
    let mut map = BranchMap::default();
    let twice = vec![sample(0, 0), sample(1, 0), sample(2, 1), sample(3, 0)];
    let next = m.next_row(&mut map, twice, Some(0.3), 0.4);
    assert_eq!((map.unmatched, next.len(), map.ends.len()), (2, 4, 0));
    let next = m.next_row(&mut map, Vec::new(), Some(0.3), 0.4);
    assert_eq!((map.unmatched, next.len(), map.ends.len()), (4, 2, 0));
    let next = m.next_row(&mut map, Vec::new(), None, 0.4);
    assert_eq!((map.unmatched, next.len(), map.ends.len()), (4, 2, 0));
    let next = m.next_row(&mut map, vec![sample(0, 0), sample(1, 0)], Some(0.3), 0.4);
    assert_eq!((map.unmatched, next.len(), map.ends.len()), (6, 3, 0));
}

/// One position is known to 1e-7 of the drive, and to 1e-3 in each angle up to whole turns.
#[test]
fn singular_positions_that_are_one() {
    let at = |drive: f64, angles: [f64; 2]| Singularity {
        drive,
        kind: SingularKind::Fold,
        angles: angles.to_vec(),
    };
    let one = |drive: f64, angles: [f64; 2]| is_same(&at(0.0, [0.0, TAU]), &at(drive, angles));
    assert!(one(0.0, [0.0, 0.0]) && one(0.99e-7, [0.99e-3, -0.99e-3]));
    assert!(one(-0.99e-7, [TAU - 0.99e-3, TAU]));
    for off in [1e-7, -1.01e-7] {
        assert!(!one(off, [0.0, 0.0]));
    }
    for off in [1e-3, -1.01e-3] {
        assert!(!one(0.0, [off, 0.0]) && !one(0.0, [0.0, off]));
    }
}

/// Displacements by themselves, angles to the nearest turn.
#[test]
fn distances_of_positions() {
    let m = slider_crank([0.3, 1.0, 0.1]);
    let from = m.assembly_modes(0.7).states.remove(0);
    for (k, length) in m.chain.lengths.clone().into_iter().enumerate() {
        for (by, due) in [
            (0.25, 0.25),
            (TAU + 0.25, if length { TAU + 0.25 } else { 0.25 }),
        ] {
            let mut to = from.clone();
            to.pose.u[k] += by;
            assert!((m.distance(&from, &to) - due).abs() < 1e-14);
            assert!((m.distance(&to, &from) - due).abs() < 1e-14);
        }
    }
    assert!(m.chain.lengths.contains(&true) && m.chain.lengths.contains(&false));
}

/// Lengths are in a power of two metres, next below the largest.
#[test]
fn units_of_chains() {
    for (size, metres) in [(1.0, 0.25), (10.0, 4.0), (1e-3, 2f64.powi(-12))] {
        let m = four_bar([0.1, 0.4, 0.3, 0.35].map(|x| x * size));
        assert_eq!(m.chain.metres, metres);
        assert!(!m.drive_is_displacement());
    }
    let mut d = slider_crank([0.3, 1.0, 0.1]).description().clone();
    d.drive = Drive::Displacement { joint: 3 };
    let m = Mechanism::new(d).unwrap();
    assert!(m.drive_is_displacement());
    let state = m.assembly_modes(1.2).states.remove(0);
    assert!((m.joint_displacement(&state, 3).unwrap().s_m - 1.2).abs() < 1e-15);
}

#[test]
fn a_whole_turn_closes() {
    for mechanism in [
        four_bar([0.1, 0.4, 0.3, 0.35]),
        class_iii(&SAND_SCREEN),
        slider_crank([0.1, 0.3, 0.02]),
    ] {
        for start in mechanism.assembly_modes(0.3).states {
            let Ok(end) = mechanism.follow(&start, 0.3 + TAU) else {
                continue;
            };
            for body in 1..mechanism.description().bodies.len() {
                let [a, b] = [&start, &end].map(|s| mechanism.body_angle(s, body).angle.rad());
                assert!(turn(a, b) < 1e-12, "body {body}");
            }
        }
    }
}

/// Two samples of a branch are joined by the continuation only if its determinant keeps its sign.
#[test]
fn the_determinant_keeps_its_sign() {
    let mechanism = double_butterfly();
    let drives: Vec<f64> = (-6..=6).map(|k| 0.02 * f64::from(k)).collect();
    let map = mechanism.trace_branches(&drives);
    assert!(map.complete);
    let samples: Vec<&BranchSample> = map.rows.iter().flatten().collect();
    for s in &samples {
        let first = samples.iter().find(|o| o.branch == s.branch).unwrap();
        assert_eq!(s.state.determinant() > 0.0, first.state.determinant() > 0.0);
    }
}

/// A parallelogram passes through positions with all links on one line, where it may go on as an
/// antiparallelogram.
#[test]
fn change_points_are_told() {
    let m = four_bar([0.2, 0.5, 0.2, 0.5]);
    let modes = m.assembly_modes(1.0);
    assert_eq!(modes.states.len(), 2);
    for start in &modes.states {
        let mut state = start.clone();
        let mut follower = Follower::new(&m.chain);
        let e = m.advance(&mut state, 4.0, &mut follower).unwrap_err();
        assert!(
            matches!(e, PositionError::Ends { drive } if (drive - std::f64::consts::PI).abs() < 1e-3),
            "{e}"
        );
        let at = m.singularity(&state).unwrap();
        assert_eq!(at.kind, SingularKind::ChangePoint);
        assert!((at.drive - std::f64::consts::PI).abs() < 1e-7, "{at:?}");
    }
}

/// At a change point there is a position, and it is singular: what the map lists there is not all.
#[test]
fn a_map_through_a_change_point_is_not_complete() {
    let m = four_bar([1.0, 2.0, 1.0, 2.0]);
    let at = m.trace_branches(&[0.0]);
    assert!(at.rows[0].is_empty() && !at.complete);
    let beside = m.trace_branches(&[0.5, 1.0]);
    assert_eq!(beside.rows.iter().map(Vec::len).collect::<Vec<_>>(), [2, 2]);
    assert!(beside.complete);
}

/// A driver alone has no unknowns; it goes to every value of the drive, zero among them.
#[test]
fn a_driver_without_groups() {
    let mechanism = driver();
    let state = mechanism.assembly_modes(0.3).states.remove(0);
    for to in [0.0, -0.0, 1.0, -2.5] {
        let found = mechanism.follow(&state, to).unwrap();
        assert_eq!(mechanism.drive_of(&found), to);
    }
}

/// Many rows under one proof are those of a proof each.
#[test]
fn rows_under_one_proof() {
    let mechanism = class_iii(&SAND_SCREEN);
    for start in mechanism.assembly_modes(0.25).states {
        let drives: Vec<f64> = (0..400).map(|k| 0.25 + 1e-3 * f64::from(k)).collect();
        let (rows, _) = match mechanism.sweep(&start, drives.iter().copied()) {
            Ok(rows) => (rows, None),
            Err((rows, e)) => (rows, Some(e)),
        };
        let mut alone = start.clone();
        for (row, drive) in rows.iter().zip(&drives) {
            alone = mechanism.follow(&alone, *drive).unwrap();
            for body in 1..=5 {
                let [a, b] = [row, &alone].map(|s| mechanism.body_angle(s, body));
                assert!((a.angle.rad() - b.angle.rad()).abs() < 1e-13, "{drive}");
                assert!(
                    (a.second - b.second).abs() < 1e-10 * (1.0 + a.second.abs()),
                    "{drive}"
                );
            }
        }
    }
}

/// Wheels that only mesh with others have no place.
#[test]
fn bodies_that_hang_on_nothing() {
    let mut d = Description::new();
    let [crank, near, far] = ["crank", "near", "far"].map(|n| d.body(n));
    d.pin("O", &[(GROUND, [0.0, 0.0]), (crank, [0.0, 0.0])]);
    let mut mesh = |a: usize, b: usize, ratio: f64| {
        let gears = gears([a, b], GROUND, ratio, 0.0);
        d.joint("mesh", gears);
    };
    mesh(near, far, -0.5);
    mesh(near, far, -0.7);
    mesh(crank, far, -0.3);
    mesh(crank, far, -0.2);
    d.pin("A", &[(crank, [0.1, 0.0]), (near, [0.0, 0.0])]);
    let error = Mechanism::new(d).unwrap_err();
    assert!(
        matches!(&error, MechanismError::Hanging { bodies } if *bodies == ["near", "far"]),
        "{error:?}"
    );
}
