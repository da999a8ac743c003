//! Describes what is said of assembly modes beside their positions, and which refined solutions are
//! taken.

use super::super::tests::*;
use super::*;

#[test]
fn no_modes_at_what_is_no_drive() {
    let m = four_bar([0.1, 0.4, 0.3, 0.35]);
    for drive in [f64::NAN, f64::INFINITY] {
        assert!(m.assembly_modes(drive).states.is_empty());
    }
}

/// Next to folds of a dyad and of a triad it is said that rounding may decide; away from them not.
#[test]
fn near_folds_are_told() {
    // Coupler and rocker are stretched at the angle zero.
    let stretched = four_bar([0.25, 0.5, 0.25, 1.0]);
    assert!(stretched.assembly_modes(0.0).near_singular);
    assert!(!stretched.assembly_modes(0.3).near_singular);
    let triad = class_iii(&SAND_SCREEN);
    let drives: Vec<f64> = (0..=48).map(|k| 0.13 * f64::from(k)).collect();
    let map = triad.trace_branches(&drives);
    let fold = map.ends[0].at.as_ref().expect("a fold").drive;
    assert!(triad.assembly_modes(fold).near_singular);
    assert!(!triad.assembly_modes(0.3).near_singular);
}

/// A triad whose links all point to one point, where two positions have merged: told by the
/// polynomial and by the homotopy.
#[test]
fn merged_modes_are_told() {
    for size in [0.01, 1.0, 30.0] {
        let [b, c, d] = [[1.0, 0.2], [0.3, 0.9], [-0.4, 0.7]];
        let far = |p: [f64; 2], by: f64| [by * p[0], by * p[1]];
        let (a, o3, o5) = (far(b, 1.6), far(c, 1.5), far(d, 1.7));
        let length = |p: [f64; 2], q: [f64; 2]| (p[0] - q[0]).hypot(p[1] - q[1]);
        let arg = |p: [f64; 2], q: [f64; 2]| (q[1] - p[1]).atan2(q[0] - p[0]);
        // The crank ends at A, half its size from the origin along x.
        let at = |p: [f64; 2]| [p[0] - a[0] + 0.5, p[1] - a[1]];
        let ([x3, y3], [x5, y5]) = (at(o3), at(o5));
        let angle = arg(c, b) - arg(c, d);
        let lengths = [
            0.5,
            length(a, b),
            length(o3, c),
            length(c, d),
            length(o5, d),
            length(c, b),
        ];
        let mut v = [0.0; 11];
        v[..6].copy_from_slice(&lengths.map(|l| l * size));
        v[6] = angle;
        v[7..].copy_from_slice(&[x3, y3, x5, y5].map(|x| x * size));
        let mut m = class_iii(&v);
        assert!(m.assembly_modes(0.0).near_singular, "{size}");
        m.triads.fill(None);
        assert!(m.assembly_modes(0.0).near_singular, "{size}");
        assert!(!m.assembly_modes(0.4).near_singular, "{size}");
    }
}

/// A solution is refined and taken if it is near and new: angles by whole turns, displacements
/// relative to one more than themselves.
#[test]
fn solutions_are_taken_if_near_and_new() {
    let m = slider_crank([0.3, 1.0, 0.1]);
    let state = m.assembly_modes(0.7).states.remove(0);
    let block = &m.chain.blocks[m.chain.blocks.len() - 1];
    let mut work = Work::new(&m.chain);
    let moved = |k: usize, by: f64| {
        let mut pose = state.pose.clone();
        pose.u[k] += by;
        pose.place(&m.chain, &m.chain.order);
        pose
    };
    let mut collected = |poses: &[Pose]| {
        let mut found = Found::default();
        for pose in poses {
            m.collect(block, pose.clone(), &mut work, &mut found);
        }
        (found.poses.len(), found.near)
    };
    for (k, length) in m.chain.lengths.clone().into_iter().enumerate() {
        let u = state.pose.u[k].abs();
        // The error that a solution may have, as much of the displacement off as it is moved.
        let reach = if length {
            FARTHEST * (1.0 + u)
        } else {
            FARTHEST
        };
        for (share, due) in [
            (0.9, (1, false)),
            (-0.9, (1, false)),
            (1.2, (0, true)),
            (-1.2, (0, true)),
        ] {
            assert_eq!(collected(&[moved(k, share * reach)]), due, "{k} {share}");
        }
        let turned = collected(&[moved(k, 0.0), moved(k, std::f64::consts::TAU)]);
        assert_eq!(turned, (1, length), "{k}");
    }
    assert_eq!(collected(&[moved(0, 0.0), moved(0, 1e-3)]), (1, false));
    // Two that have not merged by a little are told.
    let angle = m.chain.lengths.iter().position(|length| !length).unwrap();
    let beside = |by: f64| {
        let mut found = Found::default();
        found.poses.push(moved(angle, by));
        m.collect(
            block,
            state.pose.clone(),
            &mut Work::new(&m.chain),
            &mut found,
        );
        (found.poses.len(), found.near)
    };
    assert_eq!((beside(0.9e-9), beside(1.1e-9)), ((1, false), (2, true)));
    assert_eq!((beside(0.9e-6), beside(1.1e-6)), ((2, true), (2, false)));
    // No position at all.
    let apart = four_bar([0.1, 0.1, 0.1, 0.9]);
    let mut found = Found::default();
    let pose = Pose::new(&apart.chain, 0.3, vec![0.4; apart.chain.unknowns]);
    let block = &apart.chain.blocks[apart.chain.blocks.len() - 1];
    apart.collect(block, pose, &mut Work::new(&apart.chain), &mut found);
    assert!(found.poses.is_empty() && found.near);
}

/// A dyad whose ends coincide may be anywhere about them; that is no complete answer.
#[test]
fn circles_that_coincide_are_not_complete() {
    // Crank and frame of one length, coupler and rocker too, at the angle zero.
    let m = four_bar([0.5, 0.4, 0.4, 0.5]);
    let modes = m.assembly_modes(0.0);
    assert!(!modes.complete && modes.states.is_empty());
    assert!(m.assembly_modes(0.3).complete);
}

/// A lost path leaves the count incomplete, a merged end tells that rounding may decide.
#[test]
fn ends_of_paths_are_told() {
    let told = |lost: usize, merged: usize| {
        let ends = homotopy::Ends {
            lost,
            merged,
            ..homotopy::Ends::default()
        };
        let mut found = Found::default();
        found.take(&ends);
        (found.incomplete, found.near)
    };
    assert_eq!((told(0, 0), told(1, 0)), ((false, false), (true, false)));
    assert_eq!((told(0, 1), told(2, 3)), ((false, true), (true, true)));
}
