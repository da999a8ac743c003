use super::tests::*;
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
    for (row, other) in map.rows.iter().zip(&due.rows) {
        assert_eq!(row.len(), other.len());
    }
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
            // Steps of any size give the same.
            let fine = mechanism
                .sweep(&start, (1..=100).map(|k| 0.3 + 0.02 * f64::from(k)))
                .unwrap();
            let coarse = mechanism.follow(&start, 0.3 + 0.02 * 100.0).unwrap();
            let last = &fine[99];
            for body in 1..mechanism.description().bodies.len() {
                let [a, b] = [last, &coarse].map(|s| mechanism.body_angle(s, body).angle.rad());
                assert!((a - b).abs() < 1e-13);
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
        let mut work = super::newton::Work::new(&m.chain);
        let e = m.advance(&mut state, 4.0, &mut work).unwrap_err();
        assert!(
            matches!(e, PositionError::Ends { drive } if (drive - std::f64::consts::PI).abs() < 1e-3),
            "{e}"
        );
        let at = m.singularity(&state).unwrap();
        assert_eq!(at.kind, SingularKind::ChangePoint);
        assert!((at.drive - std::f64::consts::PI).abs() < 1e-7, "{at:?}");
    }
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
