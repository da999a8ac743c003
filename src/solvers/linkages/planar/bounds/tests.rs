//! The bounds hold, and are near what they bound.

use super::super::bounds::{SLACK, bounds};
use super::super::chain::{Bound, Chain, Entry, Rail};
use super::super::equilibrium_tests::*;
use super::super::pose::Pose;
use super::super::tests::*;
use super::super::*;
use num_complex::Complex64;
use std::f64::consts::TAU;

fn residual(mechanism: &Mechanism, at: &Pose, along: &[f64], s: f64, h: f64) -> Vec<f64> {
    let u = at.u.iter().zip(along).map(|(u, d)| u + h * d).collect();
    let pose = Pose::new(&mechanism.chain, at.drive + h * s, u);
    let mut rows = Vec::new();
    pose.residual(&mechanism.chain, &mechanism.chain.closures, &mut rows);
    rows
}

/// The largest second derivatives of each row over their bounds k, m and w, in directions that pull
/// all arms the same way and others; at the pose and, which the bounds have to hold as well, moved
/// by as much as a step may.
fn shares(mechanism: &Mechanism, pose: &Pose, random: &mut Random, largest: &mut [[f64; 3]]) {
    let n = mechanism.chain.unknowns;
    let mut found: Vec<Bound> = vec![Bound::default(); 3];
    bounds(&mechanism.chain, pose, &mut found);
    assert_eq!(found.len(), n);
    for trial in 0..200 {
        let coarse = random.between(0.0, 1.0) < 0.7;
        let part = |x: f64| if coarse { x.signum() } else { x };
        let along: Vec<f64> = (0..n).map(|_| part(random.between(-1.0, 1.0))).collect();
        let still = vec![0.0; n];
        let mut at = pose.clone();
        if trial % 2 == 1 {
            let moved = |x: &f64, random: &mut Random| x + SLACK * random.between(-1.0, 1.0);
            let u = at.u.iter().map(|u| moved(u, random)).collect();
            at = Pose::new(&mechanism.chain, moved(&at.drive, random), u);
        }
        let h = 1e-4;
        let second = |along: &[f64], s: f64| -> Vec<f64> {
            let [back, here, ahead] = [-h, 0.0, h].map(|h| residual(mechanism, &at, along, s, h));
            // Ties are given to the nearest whole turn.
            let change = |a: f64, b: f64| (b - a) - ((b - a) / TAU).round() * TAU;
            let of = |row: usize| {
                (change(here[row], ahead[row]) - change(back[row], here[row])) / (h * h)
            };
            (0..n).map(of).collect()
        };
        let (own, driven) = (second(&along, 0.0), second(&still, 1.0));
        let (with, against) = (second(&along, 1.0), second(&along, -1.0));
        for row in 0..n {
            let Bound { k, m, w } = found[row];
            let mixed = 0.25 * (with[row] - against[row]);
            for (share, (second, bound)) in
                largest[row]
                    .iter_mut()
                    .zip([(own[row], k), (mixed, m), (driven[row], w)])
            {
                assert!(second.abs() <= bound + 1e-6, "row {row}: {second} {bound}");
                if bound > 0.1 {
                    *share = share.max(second.abs() / bound);
                }
            }
        }
    }
}

#[test]
fn second_derivatives_are_bounded() {
    let mut random = Random(11);
    for (what, mechanism, _) in every() {
        let n = mechanism.chain.unknowns;
        let mut largest = vec![[0.0f64; 3]; n];
        for _ in 0..60 {
            let u = (0..n).map(|_| random.between(-3.0, 3.0)).collect();
            let pose = Pose::new(&mechanism.chain, random.between(-3.0, 3.0), u);
            shares(&mechanism, &pose, &mut random, &mut largest);
        }
        // Displacements and angles alone are linear in the unknowns, whatever the way to them.
        let mut shares = largest.iter().flatten().filter(|x| **x > 1e-3).peekable();
        assert!(shares.peek().is_some(), "{what}");
        assert!(shares.all(|x| *x > 0.45), "{what}: {largest:?}");
    }
}

fn told(chain: &Chain, pose: &Pose) -> Vec<Bound> {
    let mut found = Vec::new();
    bounds(chain, pose, &mut found);
    found
}

fn same(found: &Bound, due: [f64; 3]) {
    for (x, due) in [found.k, found.m, found.w].into_iter().zip(due) {
        assert!((x - due).abs() < 1e-13, "{found:?} {due}");
    }
}

/// Crank, coupler and rocker of a four-bar: the arms themselves.
#[test]
fn bounds_of_a_four_bar() {
    let mechanism = four_bar([0.1, 0.4, 0.3, 0.35]);
    let pose = Pose::new(&mechanism.chain, 0.7, vec![0.2, -1.1]);
    let found = told(&mechanism.chain, &pose);
    let metres = mechanism.chain.metres;
    for found in &found {
        same(found, [0.7 / metres, 0.0, 0.1 / metres]);
    }
}

/// The piston's travel along the turning cylinder is the drive; the cylinder's arm may grow by the
/// slack.
#[test]
fn bounds_of_a_cylinder() {
    let mechanism = cylinder();
    let (drive, metres) = (0.7, mechanism.chain.metres);
    let pose = Pose::new(&mechanism.chain, drive, vec![0.2, -1.1]);
    let found = told(&mechanism.chain, &pose);
    let pivot = Complex64::from(0.05) + Complex64::cis(0.1) * drive * metres;
    let arms = 0.5 + 0.4f64.hypot(0.02) + pivot.norm();
    assert_eq!(found.len(), 2);
    for found in &found {
        same(found, [arms / metres + SLACK, 1.0, 0.0]);
    }
}

/// A lever's slot: the distance along it may grow as the lever turns and as the crank does.
#[test]
fn bounds_of_a_slotted_lever() {
    let mechanism = slotted_lever();
    let (phi, theta, metres) = (0.7, -0.4, mechanism.chain.metres);
    let pose = Pose::new(&mechanism.chain, phi, vec![theta]);
    let found = told(&mechanism.chain, &pose);
    let (crank, arm) = (0.3 / metres, 0.05f64.hypot(0.1) / metres);
    let origin = Complex64::new(0.1, -0.9) + Complex64::cis(theta) * Complex64::new(0.05, 0.1);
    let far = (Complex64::cis(phi) * 0.3 - origin).norm() / metres + SLACK * (arm + crank);
    let due = [arm + far + 2.0 * arm, crank, crank];
    assert_eq!(found.len(), 1);
    same(&found[0], due);
}

/// The slot turns with the drive.
#[test]
fn bounds_of_a_slotted_crank() {
    let mechanism = slotted_crank();
    let (phi, theta, metres) = (0.7, -0.4, mechanism.chain.metres);
    let pose = Pose::new(&mechanism.chain, phi, vec![theta]);
    let found = told(&mechanism.chain, &pose);
    let (arm, origin) = (0.65f64.hypot(0.1), Complex64::new(0.05, 0.02));
    let pin = Complex64::new(0.2, -0.3) + Complex64::cis(theta) * Complex64::new(0.65, 0.1);
    let far = (pin - Complex64::cis(phi) * origin).norm() / metres;
    let (arm, origin) = (arm / metres, origin.norm() / metres);
    let far = far + SLACK * (arm + origin);
    assert_eq!(found.len(), 1);
    same(&found[0], [arm, arm, origin + far + 2.0 * origin]);
}

/// A slot on an arm that turns with another one and, against it, with the drive.
#[test]
fn bounds_of_a_slotted_elbow() {
    let mut m = Description::new();
    let [upper, fore] = ["upper arm", "forearm"].map(|n| m.body(n));
    m.pin("O", &[(GROUND, [0.0, 0.0]), (upper, [0.0, 0.0])]);
    m.pin("A", &[(upper, [0.5, 0.0]), (fore, [0.0, 0.0])]);
    m.joint("slot", slot((GROUND, [0.3, 0.4]), (fore, [0.1, 0.05]), 0.3));
    m.drive = Drive::Angle {
        body: fore,
        from: upper,
    };
    let mechanism = Mechanism::new(m).unwrap();
    let (drive, u, metres) = (0.7, -0.4, mechanism.chain.metres);
    let pose = Pose::new(&mechanism.chain, drive, vec![u]);
    let found = told(&mechanism.chain, &pose);
    let origin = Complex64::new(0.1, 0.05);
    let at = Complex64::cis(u) * 0.5 + Complex64::cis(u + drive) * origin;
    let far = (Complex64::new(0.3, 0.4) - at).norm() / metres;
    let (a, o) = (0.5 / metres, origin.norm() / metres);
    let far = far + SLACK * (a + o + o);
    let due = [
        a + o + far + 2.0 * (a + o),
        o + far + o + (a + o),
        o + far + 2.0 * o,
    ];
    assert_eq!(found.len(), 1);
    same(&found[0], due);
}

/// Displacements on displacements: either may lengthen the arms below it.
#[test]
fn bounds_of_a_stack() {
    let mechanism = stacked();
    let metres = mechanism.chain.metres;
    let modes = mechanism.assembly_modes(0.4).states;
    assert!(!modes.is_empty());
    for state in modes {
        let found = told(&mechanism.chain, &state.pose);
        let joints = &mechanism.description().joints;
        let travel = |name: &str| {
            let k = joints.iter().position(|j| j.name == name).unwrap();
            mechanism.joint_displacement(&state, k).unwrap().s_m
        };
        let upper = Complex64::new(0.1, 0.1) + Complex64::cis(-0.3) * travel("upper");
        let lower = Complex64::new(0.1, 0.0) + Complex64::cis(1.2) * travel("lower");
        let carriage = (upper - Complex64::new(0.0, 0.02)).norm();
        let arms = (0.03 + carriage + lower.norm()) / metres + 2.0 * SLACK;
        let pins = mechanism.chain.closures.iter().scan(0, |row, c| {
            *row += c.rows();
            Some((*row - c.rows(), c.rows()))
        });
        let mut seen = 0;
        for (row, rows) in pins {
            if rows == 2 {
                same(&found[row], [arms + 4.0, 0.0, 0.3 / metres]);
                seen += 1;
            }
        }
        assert_eq!(seen, 1);
    }
}

/// The lever on a rail of the carriage, which slides through a point of the block or on a rail of
/// it: both lengthen arms.
#[test]
fn bounds_of_rails_on_rails() {
    let mut mechanism = stacked();
    let pose = mechanism.assembly_modes(0.4).states.remove(0).pose;
    let chain = &mut mechanism.chain;
    let [lever, carriage, block] = [2, 3, 4];
    let Entry::WithRail {
        on,
        at,
        along,
        travel,
    } = chain.entries[carriage]
    else {
        panic!("the carriage slides through a point of the block");
    };
    let Entry::WithRail { travel: lower, .. } = chain.entries[lever] else {
        panic!("the lever slides through a point of the carriage");
    };
    let rail = |body: usize, turn: f64| Rail {
        body,
        at: Complex64::new(0.2, -0.1),
        along: Complex64::cis(turn),
    };
    let (own, upon) = (Complex64::new(0.3, 0.4), rail(carriage, 0.4));
    chain.entries[lever] = Entry::OnRail {
        rail: upon,
        own,
        travel: lower,
    };
    let pin = chain.closures.iter().position(|c| c.rows() == 2).unwrap();
    let row: usize = chain.closures[..pin].iter().map(|c| c.rows()).sum();
    let to = upon.at + upon.along * pose.travel(lower);
    let through = (to - at - along * pose.travel(travel)).norm() + on.at.norm();
    let found = told(chain, &pose);
    let due = |arms: f64| {
        [
            own.norm() + arms + 2.0 * SLACK + 4.0,
            0.0,
            0.3 / chain.metres,
        ]
    };
    same(&found[row], due(through));

    let own = Complex64::new(-0.1, 0.2);
    let under = rail(block, -0.7);
    let on_rail = (to - own).norm() + (under.at + under.along * pose.travel(travel)).norm();
    let due = due(on_rail);
    chain.entries[carriage] = Entry::OnRail {
        rail: under,
        own,
        travel,
    };
    let found = told(chain, &pose);
    same(&found[row], due);
}
