//! Folds and change points: what is taken for one, how the search converges, and how far it looks.

use super::super::tests::*;
use super::*;
use std::f64::consts::PI;

/// The drive's column is measured by its largest member, whatever its size.
#[test]
fn folds_are_told_from_change_points() {
    assert!(is_fold(&[1.0, 0.0], &[1.0, 0.0]));
    assert!(is_fold(&[0.0, 1.0], &[1.0, 2e-5]));
    assert!(!is_fold(&[0.0, -1.0], &[1.0, 5e-6]));
    assert!(!is_fold(&[0.0, 1.0], &[-1.0, 5e-6]));
    assert!(is_fold(&[0.0, -1.0], &[1e-3, 2e-8]));
    assert!(!is_fold(&[0.0, 1.0], &[1e-3, 5e-9]));
    assert!(!is_fold(&[0.0, 1.0], &[1.0, NOTHING]));
    // Several closures of which each has its part: they cancel.
    assert!(!is_fold(&[0.6, 0.8], &[0.8, -0.6]));
}

#[test]
fn searches_end_at_rounding() {
    assert!(is_last(0.9e-14, f64::INFINITY) && !is_last(1e-14, f64::INFINITY));
    // Nearly, and no longer halved.
    assert!(is_last(0.9e-9, 1.7e-9) && !is_last(0.9e-9, 1.8e-9));
    assert!(!is_last(0.9e-9, 1.9e-9) && !is_last(1e-9, 1e-9));
    assert!(is_near(0.9e-4, 0.009) && is_near(0.9e-4, -0.009));
    assert!(!is_near(1e-4, 0.0) && !is_near(0.0, 1e-2) && !is_near(0.0, -0.011));
}

/// `U diag(1, 1e-2) Vᵀ`: errors fall by 1e4 in each of three rounds.
#[test]
fn null_vectors_of_a_nearly_singular_matrix() {
    for turned in [0.3, 1.1, 2.0, -0.7] {
        let (u, v) = ([f64::cos(turned), f64::sin(turned)], [0.8, -0.6]);
        let (u1, v1) = ([-u[1], u[0]], [-v[1], v[0]]);
        let mut a = Matrix::new(2, 2);
        for r in 0..2 {
            for c in 0..2 {
                a[(r, c)] = u1[r] * v1[c] + 1e-2 * u[r] * v[c];
            }
        }
        let mut factors = Factors::default();
        assert!(factors.of(&a, 2, 0));
        let (right, left) = null_vectors(&factors, 2);
        for (found, due, other) in [(right, v, v1), (left, u, u1)] {
            let dot = |x: [f64; 2]| found[0] * x[0] + found[1] * x[1];
            assert!((dot(due).abs() - 1.0).abs() < 1e-15);
            assert!(dot(other).abs() < 1e-10, "{turned}: {:e}", dot(other));
        }
    }
}

/// Where an inverse is beyond the range of numbers there is neither fold nor change point.
#[test]
fn null_vectors_beyond_the_range() {
    let (m, fold) = rocker();
    for size in [1e-200, 1e200] {
        let mut a = Matrix::new(2, 2);
        (a[(0, 0)], a[(1, 1)]) = (size, size);
        for mut last in before(&m, fold, 1e-6) {
            assert!(last.factors.of(&a, 2, 0));
            let (v, w) = null_vectors(&last.factors, 2);
            assert!(!is_fold(&w, &[1.0, 1.0]));
            assert!(m.change_point(&last, [&v, &w]).is_none());
            assert!(m.singularity(&last).is_none());
        }
    }
}

/// A four-bar driven by its longer arm, and the drive at which coupler and rocker are stretched.
fn rocker() -> (Mechanism, f64) {
    let cosine = (0.3f64.powi(2) + 0.35f64.powi(2) - 0.6f64.powi(2)) / (2.0 * 0.3 * 0.35);
    (four_bar([0.3, 0.4, 0.2, 0.35]), cosine.acos())
}

/// Both states at a drive before the fold.
fn before(m: &Mechanism, fold: f64, off: f64) -> Vec<State> {
    let states = m.assembly_modes(fold - off).states;
    assert_eq!(states.len(), 2);
    states
}

/// Corrections fall with their squares, though the fold is some tenths of a radian off in the
/// angles.
#[test]
fn searches_converge_quadratically() {
    let (m, fold) = rocker();
    for last in before(&m, fold, 5e-3) {
        let (v, _) = null_vectors(&last.factors, 2);
        let mut search = Search::new(&m.chain, last.pose.clone(), v);
        let mut sizes = Vec::new();
        while sizes.last().is_none_or(|s| *s > 1e-12) {
            sizes.push(search.correct(&m.chain).unwrap());
            assert!(sizes.len() < 7, "{sizes:?}");
        }
        assert!(sizes[0] < 0.2, "{sizes:?}");
        for pair in sizes.windows(2) {
            assert!(pair[1] < 3.0 * pair[0] * pair[0] + 1e-13, "{sizes:?}");
        }
        // F = 0, J v = 0 and v · v₀ = 1.
        assert!((search.pose.drive - fold).abs() < 4e-15);
        let along: f64 = search.v.iter().zip(&search.v0).map(|(a, b)| a * b).sum();
        assert!((along - 1.0).abs() < 1e-14);
        let mut jacobian = Matrix::new(2, 3);
        search
            .pose
            .jacobian(&m.chain, 0..m.chain.closures.len(), &mut jacobian);
        for r in 0..2 {
            let left: f64 = (0..2).map(|c| jacobian[(r, c)] * search.v[c]).sum();
            assert!(left.abs() < 1e-14);
        }
    }
}

/// A fold up to 1e-2 off in the drive is found, to rounding; one farther off is not the end of this
/// branch.
#[test]
fn folds_ahead_are_found() {
    let (m, fold) = rocker();
    for (off, found) in [
        (1e-9, true),
        (1e-6, true),
        (9.9e-3, true),
        (1.01e-2, false),
        (0.05, false),
    ] {
        for last in before(&m, fold, off) {
            let at = m.singularity(&last);
            assert_eq!(at.is_some(), found, "{off}");
            let Some(at) = at else { continue };
            assert_eq!(at.kind, SingularKind::Fold);
            assert!(
                (at.drive - fold).abs() < 4e-15,
                "{off}: {:e}",
                at.drive - fold
            );
            assert!(
                turn(at.angles[1], at.angles[2] + PI) < 1e-13,
                "{off}: {at:?}"
            );
        }
    }
    // A direction that is far from the null vector is given up, though the search would come back
    // to it.
    for last in before(&m, fold, 1e-6) {
        let (v, _) = null_vectors(&last.factors, 2);
        let turned = |by: f64| {
            let (s, c) = by.sin_cos();
            vec![c * v[0] - s * v[1], s * v[0] + c * v[1]]
        };
        assert!(m.fold(&last, turned(0.1)).is_some());
        assert!(m.fold(&last, turned(1.0)).is_none());
    }
    // Of a mechanism that has none there is none.
    let turning = four_bar([0.1, 0.4, 0.3, 0.35]);
    for state in turning.assembly_modes(0.7).states {
        assert!(turning.singularity(&state).is_none());
    }
}

/// A change point is looked for within 1e-4 along the tangent: the parallelogram's with all links
/// on one line.
#[test]
fn change_points_ahead_are_found() {
    let m = four_bar([0.2, 0.5, 0.2, 0.5]);
    for (off, found) in [(1e-6, true), (0.99e-4, true), (1.01e-4, false)] {
        for state in m.assembly_modes(PI - off).states {
            let (v, w) = null_vectors(&state.factors, 2);
            let pose = m.change_point(&state, [&v, &w]);
            assert_eq!(pose.is_some(), found, "{off}");
            let Some(pose) = pose else { continue };
            assert!(
                (pose.drive - PI).abs() < 1e-8,
                "{off}: {:e}",
                pose.drive - PI
            );
        }
    }
}
