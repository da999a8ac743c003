//! The bounds hold, and are near what they bound.

use super::bounds::{Bound, SLACK, bounds};
use super::equilibrium_tests::*;
use super::pose::Pose;
use super::tests::*;
use super::*;

fn residual(mechanism: &Mechanism, at: &Pose, along: &[f64], s: f64, h: f64) -> Vec<f64> {
    let u = at.u.iter().zip(along).map(|(u, d)| u + h * d).collect();
    let pose = Pose::new(&mechanism.chain, at.drive + h * s, u);
    let mut rows = Vec::new();
    pose.residual(&mechanism.chain, &mechanism.chain.closures, &mut rows);
    rows
}

/// The largest second derivative of each row over what its bound allows, in directions that pull all arms the same way
/// and others; at the pose and, which the bound has to hold as well, moved by as much as a step may.
fn shares(mechanism: &Mechanism, pose: &Pose, random: &mut Random, largest: &mut [f64]) {
    let n = mechanism.chain.unknowns;
    let mut found: Vec<Bound> = vec![Bound::default(); 3];
    bounds(&mechanism.chain, pose, &mut found);
    assert_eq!(found.len(), n);
    for trial in 0..200 {
        let coarse = random.next() < 0.7;
        let part = |x: f64| if coarse { x.signum() } else { x };
        let along: Vec<f64> = (0..n).map(|_| part(random.within(-1.0, 1.0))).collect();
        let s = [0.0, 1.0, -1.0, random.within(-1.0, 1.0)][(4.0 * random.next()) as usize];
        let d = [0.0, 1.0][usize::from(random.next() < 0.8)];
        let along: Vec<f64> = along.iter().map(|x| x * d).collect();
        let mut at = pose.clone();
        if trial % 2 == 1 {
            let moved = |x: &f64, random: &mut Random| x + SLACK * random.within(-1.0, 1.0);
            let u = at.u.iter().map(|u| moved(u, random)).collect();
            at = Pose::new(&mechanism.chain, moved(&at.drive, random), u);
        }
        let h = 1e-4;
        let [back, here, ahead] = [-h, 0.0, h].map(|h| residual(mechanism, &at, &along, s, h));
        let d = along.iter().fold(0.0f64, |m, x| m.max(x.abs()));
        for row in 0..n {
            let second = (ahead[row] - 2.0 * here[row] + back[row]) / (h * h);
            let Bound { k, m, w } = found[row];
            let bound = k * d * d + 2.0 * m * d * s.abs() + w * s * s;
            assert!(second.abs() <= bound + 1e-6, "row {row}: {second} {bound}");
            if bound > 0.1 {
                largest[row] = largest[row].max(second.abs() / bound);
            }
        }
    }
}

#[test]
fn second_derivatives_are_bounded() {
    let mut random = Random(11);
    for (what, mechanism) in [
        ("four-bar", four_bar([0.1, 0.4, 0.3, 0.35])),
        ("class III", class_iii(&SAND_SCREEN)),
        ("slider-crank", slider_crank([0.1, 0.3, 0.02])),
        ("quick return", quick_return()),
        ("slotted lever", slotted_lever()),
        ("slotted crank", slotted_crank()),
        ("scotch yoke", scotch_yoke()),
        ("trammel", trammel()),
        ("cylinder", cylinder()),
        ("cross slides", cross_slides()),
        ("common pin", common_pin()),
        ("gears and rack", gears_and_rack()),
    ] {
        let n = mechanism.chain.unknowns;
        let mut largest = vec![0.0f64; n];
        for _ in 0..60 {
            let u = (0..n).map(|_| random.within(-3.0, 3.0)).collect();
            let pose = Pose::new(&mechanism.chain, random.within(-3.0, 3.0), u);
            shares(&mechanism, &pose, &mut random, &mut largest);
        }
        // Displacements and angles alone are linear in the unknowns, whatever the way to them.
        let rows = largest.iter().filter(|x| **x > 1e-3);
        let all = rows.clone().all(|x| *x > 0.9);
        assert!(rows.count() > 0 && all, "{what}: {largest:?}");
    }
}

/// Crank, coupler and rocker of a four-bar: the arms themselves.
#[test]
fn bounds_of_a_four_bar() {
    let mechanism = four_bar([0.1, 0.4, 0.3, 0.35]);
    let pose = Pose::new(&mechanism.chain, 0.7, vec![0.2, -1.1]);
    let mut found = Vec::new();
    bounds(&mechanism.chain, &pose, &mut found);
    let metres = mechanism.chain.metres;
    for Bound { k, m, w } in found {
        assert!((k * metres - 0.7).abs() < 1e-15 && m == 0.0 && (w * metres - 0.1).abs() < 1e-15);
    }
}
