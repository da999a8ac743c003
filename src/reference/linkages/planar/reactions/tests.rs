//! Rates, multipliers and forces in joints for drives of other forms.

use super::super::energy::{Forces, Spring};
use super::super::tests::{BITS, ball, cranked, four_bar, guess, meets};
use super::super::{Attachment, Drive, Joint, Linkage, Position};
use crate::class_iii::tests::q;
use crate::dyad;
use rug::Rational;

/// The four-bar at a crank angle of 9/10.
fn position() -> Position {
    let start = guess(&[0.9, 0.5, 1.6]);
    cranked(&four_bar()).position(&ball("0.9"), &start).unwrap()
}

fn forces(drive: &str) -> Forces {
    Forces {
        drive: q(drive),
        springs: Vec::new(),
        gravity: [q("0.5"), q("-9.75")],
    }
}

/// `x' = (dx/dφ) φ'` and `x'' = (d²x/dφ²) φ'² + (dx/dφ) φ''` for every coordinate.
#[test]
fn rates_follow_the_chain_rule() {
    let due = dyad::four_bar(&["2", "3.5", "3", "4"].map(q), &q("0.9"), true, BITS).unwrap();
    let (speed, acceleration) = (ball("3"), ball("-7"));
    let linkage = cranked(&four_bar());
    let rates = linkage.in_time(&position(), &speed, &acceleration).unwrap();
    assert_eq!((rates.first.len(), rates.second.len()), (3, 3));
    meets(&rates.first[0], &speed);
    meets(&rates.second[0], &acceleration);
    for (k, x) in [(1, &due.coupler), (2, &due.rocker)] {
        meets(&rates.first[k], &(&x[1] * &speed));
        let second = &x[2] * &speed.square() + &x[1] * &acceleration;
        meets(&rates.second[k], &second);
    }
}

/// A drive at the rocker, between two bodies, and of twice the crank's angle: Newton and Euler's
/// equations give the same force on it as Lagrange's, and the same as the energy of the whole.
#[test]
fn every_form_of_a_drive_has_its_force() {
    let (mechanism, start) = (four_bar(), position());
    let drives = [
        Drive::coordinate(0),
        Drive::coordinate(2),
        Drive::relative(0, 1),
        Drive::relative(1, 2),
        Drive(vec![(0, Rational::from(2))]),
    ];
    for drive in drives {
        let linkage = Linkage::new(&mechanism, &drive, BITS).unwrap();
        let at = linkage
            .position(&linkage.driven(&start), &start.midpoints())
            .unwrap();
        let series = linkage.series(&at, 2).unwrap();
        let (speed, acceleration) = (ball("3"), ball("-7"));
        let rates = series.in_time(&speed, &acceleration);
        let forces = forces("3");
        let multipliers = linkage.multipliers(&at, &rates, &forces).unwrap();
        let found = linkage.joint_forces(&series, &rates, &forces).unwrap();
        assert_eq!(found.pins.len(), 4);
        meets(&found.drive, &-&multipliers[2]);
        for i in 0..2 {
            meets(&found.pins[3][i], &multipliers[i]);
        }
        // I b'' + ½ I' b'² less what acts.
        let inertia = linkage.reduced_inertia(&series);
        let [force, _] = linkage.reduced_force(&series, &forces);
        let due = &inertia[0] * &acceleration + (&inertia[1] * &speed.square()).shift(-1) - force;
        meets(&found.drive, &due);
    }
}

/// Springs and joints other than pins are refused as such.
#[test]
fn forces_are_for_pins_without_springs() {
    let linkage = cranked(&four_bar());
    let series = linkage.series(&position(), 2).unwrap();
    let rates = series.in_time(&ball("1"), &ball("0"));
    let mut sprung = forces("0");
    sprung.springs.push(Spring {
        a: Attachment::body(1, [q("1"), q("1")]),
        b: Attachment::ground([q("0"), q("3")]),
        stiffness: q("2"),
        length: q("1"),
    });
    let refused = linkage.joint_forces(&series, &rates, &sprung).unwrap_err();
    assert!(refused.reason.contains("without springs"), "{refused:?}");
    let mut joints = linkage.mechanism().joints().to_vec();
    assert!(joints.iter().all(|j| matches!(j, Joint::Pin { .. })));
    joints.push(Joint::Gear {
        a: super::super::Frame::Body(0),
        b: super::super::Frame::Body(3),
        carrier: super::super::Frame::Ground,
        ratio: q("2"),
        offset: crate::class_iii::ExactAngle::Radians(q("0")),
    });
    let mut bodies = linkage.mechanism().bodies().to_vec();
    bodies.push(super::super::Body::massless("gear"));
    joints.push(Joint::Pin {
        a: Attachment::ground([q("9"), q("0")]),
        b: Attachment::body(3, [q("0"), q("0")]),
    });
    let geared = cranked(&super::super::Mechanism::new(bodies, joints).unwrap());
    let start = guess(&[0.9, 0.5, 1.6, 1.8]);
    let at = geared.position(&ball("0.9"), &start).unwrap();
    let series = geared.series(&at, 2).unwrap();
    let rates = series.in_time(&ball("1"), &ball("0"));
    let refused = geared
        .joint_forces(&series, &rates, &forces("0"))
        .unwrap_err();
    assert!(refused.reason.contains("pins alone"), "{refused:?}");
}
