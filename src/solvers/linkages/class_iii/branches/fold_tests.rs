//! Folds: how closely they are found, and which are the same.

use super::super::tests::zinchenko;
use crate::units::Angle;

/// The angles of the paper's linkage in degrees, by halving on the number of modes.
const FOLDS: [f64; 2] = [217.270876406, 282.845029080];

/// From anywhere up to half a thousandth before the pair is gone the same angle is found.
#[test]
fn folds_from_nearby() {
    let linkage = zinchenko();
    for (degrees, side) in FOLDS.into_iter().zip([-1.0, 1.0]) {
        let near = degrees.to_radians();
        let phi4 = |phi1: f64| linkage.assembly_modes(Angle::from_rad(phi1)).modes[0].phi4;
        let inside = near + 1e-8 * side;
        let (at, theta) = linkage
            .refine_fold(inside, phi4(near + 0.01 * side))
            .expect("a fold");
        assert!((at - near).abs() < 1e-10, "{degrees}");
        for off in [1e-9, 1e-7, 1e-5, 3e-5, 5e-4] {
            let (x, t) = linkage.refine_fold(at + side * off, theta).expect("a fold");
            assert!((x - at).abs() < 1e-14, "{degrees} {off}: {}", x - at);
            assert!((t - theta).abs() < 2e-14, "{degrees} {off}: {}", t - theta);
        }
    }
}

/// Where no fold is near the angle stays what it was.
#[test]
fn no_fold_nearby() {
    let linkage = zinchenko();
    for k in 0..60 {
        let near = 0.1 * f64::from(k);
        if FOLDS.iter().all(|f| (f.to_radians() - near).abs() > 0.03) {
            let (at, _) = linkage.refine_fold(near, 0.0).expect("an angle");
            assert_eq!(at, near);
        }
    }
}

/// Ends within 1e-7 of each other are one fold, others are not.
#[test]
fn ends_that_belong_together() {
    let linkage = zinchenko();
    let at = 0.5;
    let ends = vec![(0, at, 0.1), (1, at + 5e-8, 0.1), (2, at + 1e-6, 0.1)];
    let folds = linkage.pair_folds(ends, true);
    let branches: Vec<&[usize]> = folds.iter().map(|f| &f.branches[..]).collect();
    assert_eq!(branches, [&[0, 1][..], &[2]]);
    assert!(folds.iter().all(|f| f.begins));
    // Exactly 1e-7 is too far.
    let folds = linkage.pair_folds(vec![(0, 0.0, 0.1), (1, 1e-7, 0.1)], false);
    assert_eq!((folds[0].phi1, folds.len()), (0.0, 2));
}
