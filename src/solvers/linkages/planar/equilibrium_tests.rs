//! Every body in equilibrium under what the joints are said to exert, whatever the joints and the
//! tree they make.

use super::pose::Pose;
use super::tests::*;
use super::*;
use crate::units::{Inertia, Length, Mass};

const SPEED: f64 = 2.5;
const ACCELERATION: f64 = -1.75;
const GRAVITY: [f64; 2] = [1.5, -9.81];

/// A mass on every body, off its origin.
fn masses(mechanism: &Mechanism) -> Vec<BodyMass> {
    let of = |body: usize| BodyMass {
        body,
        mass: Mass::from_kg(0.5 + body as f64),
        inertia: Inertia::from_kg_m2(0.02 * body as f64),
        centre: [0.07, -0.04].map(|x| Length::from_m(x * body as f64)),
    };
    (1..mechanism.description().bodies.len()).map(of).collect()
}

fn unit(angle: f64) -> [f64; 2] {
    [angle.cos(), angle.sin()]
}

/// Newton's and Euler's equations of every body.
fn hold(what: &str, mechanism: &Mechanism, state: &State) {
    let masses = masses(mechanism);
    let bodies = mechanism.description().bodies.len();
    let torque = Load::Torque {
        body: bodies - 1,
        from: 1,
        torque: Course::Constant(-3.5),
    };
    let loads = Loads::new(mechanism, masses.clone(), vec![torque], GRAVITY).unwrap();
    let found = loads
        .reactions(mechanism, state, SPEED, ACCELERATION)
        .unwrap();
    // Force and moment about the ground's origin.
    let mut sums = vec![[0.0; 3]; bodies];
    let mut size = 1.0f64;
    let mut push = |body: usize, sign: f64, [x, y]: [f64; 2], at: [f64; 2], moment: f64| {
        let all = [x, y, at[0] * y - at[1] * x + moment];
        for (sum, v) in sums[body].iter_mut().zip(all) {
            *sum += sign * v;
            size = size.max(v.abs());
        }
    };
    for f in &found.joints {
        let joint = &mechanism.description().joints[f.joint].part;
        let (first, normal) = match joint {
            Joint::Pin { points } => (points[0].body, true),
            Joint::Slide { guide, .. } | Joint::Slot { slot: guide, .. } => {
                let angle = mechanism.body_angle(state, guide.origin.body).angle.rad();
                let [c, s] = unit(angle + guide.direction.rad());
                let along = f.force_n[0] * c + f.force_n[1] * s;
                (
                    guide.origin.body,
                    along.abs() < 1e-9 * (1.0 + f.force_n[0].hypot(f.force_n[1])),
                )
            }
            _ => unreachable!("no teeth"),
        };
        assert!(normal, "{what}: {f:?} along its rail");
        let moment = matches!(joint, Joint::Slide { .. });
        assert!(moment || f.moment_n_m == 0.0, "{what}: {f:?}");
        push(f.body, 1.0, f.force_n, f.at_m, f.moment_n_m);
        push(first, -1.0, f.force_n, f.at_m, f.moment_n_m);
    }
    match mechanism.description().drive {
        Drive::Angle { body, from } => {
            push(body, 1.0, [0.0; 2], [0.0; 2], found.drive);
            push(from, -1.0, [0.0; 2], [0.0; 2], found.drive);
        }
        Drive::Displacement { joint } => {
            let Joint::Slide { slider, guide, .. } = &mechanism.description().joints[joint].part
            else {
                unreachable!("a slide")
            };
            let angle = mechanism.body_angle(state, guide.origin.body).angle.rad();
            let along = unit(angle + guide.direction.rad()).map(|x| x * found.drive);
            let at = mechanism.point(state, slider).r;
            push(slider.body, 1.0, along, at, 0.0);
            push(guide.origin.body, -1.0, along, at, 0.0);
        }
    }
    push(bodies - 1, 1.0, [0.0; 2], [0.0; 2], -3.5);
    push(1, -1.0, [0.0; 2], [0.0; 2], -3.5);
    for m in &masses {
        let [x, y] = m.centre;
        let c = mechanism.point(state, &Point::new(m.body, x, y));
        let turn = mechanism.body_angle(state, m.body);
        let at = |second: f64, first: f64| second * SPEED * SPEED + first * ACCELERATION;
        let kg = m.mass.kg();
        let force = [0, 1].map(|i| kg * (GRAVITY[i] - at(c.second[i], c.first[i])));
        let moment = -m.inertia.kg_m2() * at(turn.second, turn.first);
        push(m.body, 1.0, force, c.r, moment);
    }
    for (body, sum) in sums.iter().enumerate().skip(1) {
        let largest = sum.iter().fold(0.0f64, |m, x| m.max(x.abs()));
        assert!(
            largest < 1e-10 * size,
            "{what}: body {body} is left with {sum:?} of {size}"
        );
    }
    let due = loads.reduce(mechanism, state).drive(SPEED, ACCELERATION);
    assert!(
        (found.drive - due).abs() < 1e-10 * size,
        "{what}: {} {due}",
        found.drive
    );
}

/// A crank of 0.3 m about the ground's origin.
fn cranked(names: &[&str]) -> (Description, Vec<usize>) {
    let mut m = Description::new();
    let bodies: Vec<usize> = names.iter().map(|n| m.body(*n)).collect();
    m.pin("O", &[(GROUND, [0.0, 0.0]), (bodies[0], [0.0, 0.0])]);
    m.drive = Drive::Angle {
        body: bodies[0],
        from: GROUND,
    };
    (m, bodies)
}

/// A sliding block on a lever that swings about the ground, its pin on the crank.
pub(super) fn quick_return() -> Mechanism {
    let (mut m, b) = cranked(&["crank", "block", "lever"]);
    m.pin("A", &[(b[0], [0.3, 0.0]), (b[1], [0.02, 0.01])]);
    m.pin("C", &[(GROUND, [0.1, -0.9]), (b[2], [0.0, 0.0])]);
    m.joint(
        "lever",
        slide((b[1], [0.03, -0.02]), (b[2], [0.05, 0.1]), 0.4),
    );
    Mechanism::new(m).unwrap()
}

/// The crank's pin in a slot of the lever.
pub(super) fn slotted_lever() -> Mechanism {
    let (mut m, b) = cranked(&["crank", "lever"]);
    m.pin("C", &[(GROUND, [0.1, -0.9]), (b[1], [0.0, 0.0])]);
    m.joint("slot", slot((b[0], [0.3, 0.0]), (b[1], [0.05, 0.1]), 0.4));
    Mechanism::new(m).unwrap()
}

/// A lever's pin in a slot of the crank.
pub(super) fn slotted_crank() -> Mechanism {
    let (mut m, b) = cranked(&["crank", "lever"]);
    m.pin("C", &[(GROUND, [0.2, -0.3]), (b[1], [0.05, 0.0])]);
    m.joint("slot", slot((b[1], [0.7, 0.1]), (b[0], [0.05, 0.02]), 0.3));
    Mechanism::new(m).unwrap()
}

/// A yoke on a straight guide, moved by the crank's pin in its slot.
pub(super) fn scotch_yoke() -> Mechanism {
    let (mut m, b) = cranked(&["crank", "yoke"]);
    m.joint(
        "guide",
        slide((b[1], [0.0, 0.05]), (GROUND, [0.1, 0.2]), 0.3),
    );
    m.joint("slot", slot((b[0], [0.3, 0.0]), (b[1], [0.1, 0.0]), 1.7));
    Mechanism::new(m).unwrap()
}

/// A rod on two sliders whose guides cross, moved by a crank and a link.
pub(super) fn trammel() -> Mechanism {
    let (mut m, b) = cranked(&["crank", "link", "rod", "left", "right"]);
    m.pin("A", &[(b[0], [0.3, 0.0]), (b[1], [0.0, 0.0])]);
    m.pin("B", &[(b[1], [1.0, 0.0]), (b[2], [0.0, 0.1])]);
    m.pin("L", &[(b[2], [-0.6, 0.0]), (b[3], [0.01, 0.0])]);
    m.pin("R", &[(b[2], [0.6, 0.0]), (b[4], [0.0, 0.02])]);
    m.joint("l", slide((b[3], [0.0, 0.0]), (GROUND, [0.7, 0.4]), 0.2));
    m.joint("r", slide((b[4], [0.0, 0.0]), (GROUND, [0.8, 0.1]), 1.5));
    Mechanism::new(m).unwrap()
}

/// A cylinder between two links, its piston drawn out by the drive.
pub(super) fn cylinder() -> Mechanism {
    let mut m = Description::new();
    let [cylinder, piston, arm] = ["cylinder", "piston", "arm"].map(|n| m.body(n));
    m.pin("O", &[(GROUND, [0.0, 0.0]), (cylinder, [0.0, 0.0])]);
    m.pin("P", &[(piston, [0.4, 0.02]), (arm, [0.5, 0.0])]);
    m.pin("C", &[(GROUND, [0.9, 0.1]), (arm, [0.0, 0.0])]);
    let joint = m.joint(
        "stroke",
        slide((piston, [0.0, 0.0]), (cylinder, [0.05, 0.0]), 0.1),
    );
    m.drive = Drive::Displacement { joint };
    Mechanism::new(m).unwrap()
}

/// A block between two slides one on the other: both ties hold its angle.
pub(super) fn cross_slides() -> Mechanism {
    let (mut m, b) = cranked(&["crank", "rod", "block", "carriage"]);
    m.pin("A", &[(b[0], [0.3, 0.0]), (b[1], [0.0, 0.0])]);
    m.pin("B", &[(b[1], [0.5, 0.0]), (b[2], [0.02, 0.03])]);
    m.joint("upper", slide((b[2], [0.0, 0.0]), (b[3], [0.1, 0.05]), 1.2));
    m.joint(
        "lower",
        slide((b[3], [0.0, 0.0]), (GROUND, [0.6, -0.2]), 0.1),
    );
    // The rod is held by a second link.
    let link = m.body("link");
    m.pin("D", &[(b[1], [0.25, 0.1]), (link, [0.0, 0.0])]);
    m.pin("E", &[(GROUND, [0.2, 0.7]), (link, [0.8, 0.0])]);
    Mechanism::new(m).unwrap()
}

/// Three bodies on one pin.
pub(super) fn common_pin() -> Mechanism {
    let (mut m, b) = cranked(&["crank", "rod", "rocker", "second rod", "second rocker"]);
    m.pin(
        "A",
        &[(b[1], [0.0, 0.0]), (b[0], [0.3, 0.0]), (b[3], [0.01, 0.0])],
    );
    m.pin("B", &[(b[1], [0.9, 0.0]), (b[2], [0.6, 0.0])]);
    m.pin("C", &[(GROUND, [0.8, 0.1]), (b[2], [0.0, 0.0])]);
    m.pin("D", &[(b[3], [1.0, 0.0]), (b[4], [0.7, 0.0])]);
    m.pin("E", &[(GROUND, [-0.9, 0.2]), (b[4], [0.0, 0.0])]);
    Mechanism::new(m).unwrap()
}

/// A four-bar whose rocker turns a wheel on the coupler by gears, and the wheel moves a rack on a
/// guide of the coupler.
pub(super) fn gears_and_rack() -> Mechanism {
    let (mut m, b) = cranked(&["crank", "coupler", "rocker", "wheel", "rack"]);
    m.pin("A", &[(b[0], [0.3, 0.0]), (b[1], [0.0, 0.0])]);
    m.pin("B", &[(b[1], [0.9, 0.0]), (b[2], [0.6, 0.0])]);
    m.pin("C", &[(GROUND, [0.8, 0.1]), (b[2], [0.0, 0.0])]);
    m.pin("N", &[(b[1], [0.6, 0.1]), (b[3], [0.0, 0.0])]);
    m.joint("gears", gears([b[2], b[3]], b[1], -1.5, 0.2));
    let slide = m.joint("guide", slide((b[4], [0.0, 0.1]), (b[1], [0.5, 0.3]), 0.4));
    m.joint("rack", rack(b[3], slide, [-0.12, 0.05]));
    Mechanism::new(m).unwrap()
}

/// A four-bar driven at its elbow: the coupler turns with an unknown and with the drive.
pub(super) fn elbow() -> Mechanism {
    let mut m = four_bar([0.5, 0.4, 0.3, 0.9]).description().clone();
    m.drive = Drive::Angle { body: 2, from: 1 };
    Mechanism::new(m).unwrap()
}

/// A block on a lever that turns, moved along it by the drive or by a link, and its pin in the slot
/// of another lever.
pub(super) fn slotted_block(driven: bool) -> Mechanism {
    let (mut m, b) = cranked(&["lever", "block", "link", "slotted lever"]);
    let joint = m.joint(
        "rail",
        slide((b[1], [0.01, 0.0]), (b[0], [0.05, 0.02]), 0.2),
    );
    m.pin("A", &[(b[1], [0.03, 0.0]), (b[2], [0.0, 0.0])]);
    m.pin("B", &[(GROUND, [0.9, 0.3]), (b[2], [0.7, 0.0])]);
    m.pin("C", &[(GROUND, [-0.4, -0.6]), (b[3], [0.0, 0.0])]);
    m.joint("slot", slot((b[1], [0.02, 0.05]), (b[3], [0.05, 0.1]), 0.5));
    if driven {
        m.drive = Drive::Displacement { joint };
    }
    Mechanism::new(m).unwrap()
}

/// A block on a carriage on a lever that swings, its pins on the crank and in a slot of the ground.
pub(super) fn stacked() -> Mechanism {
    let (mut m, b) = cranked(&["crank", "lever", "carriage", "block"]);
    m.pin("C", &[(GROUND, [0.1, -0.9]), (b[1], [0.0, 0.0])]);
    m.joint("lower", slide((b[2], [0.0, 0.02]), (b[1], [0.1, 0.0]), 1.2));
    m.joint(
        "upper",
        slide((b[3], [0.03, 0.0]), (b[2], [0.1, 0.1]), -0.3),
    );
    m.pin("A", &[(b[0], [0.3, 0.0]), (b[3], [0.0, 0.0])]);
    m.joint("slot", slot((b[3], [0.2, 0.1]), (GROUND, [0.0, 0.3]), 0.1));
    Mechanism::new(m).unwrap()
}

/// A second block on the lever of a quick return, on a link.
pub(super) fn two_blocks() -> Mechanism {
    let mut m = quick_return().description().clone();
    let [block, link] = ["second block", "link"].map(|n| m.body(n));
    m.joint("second", slide((block, [0.02, 0.0]), (3, [0.4, 0.2]), 0.5));
    m.pin("D", &[(block, [0.0, 0.04]), (link, [0.0, 0.0])]);
    m.pin("E", &[(GROUND, [0.9, 0.1]), (link, [0.8, 0.0])]);
    Mechanism::new(m).unwrap()
}

/// A quick return driven by its block's angle: the block's slide gives its angle, the drive a
/// closure.
pub(super) fn turned_block() -> Mechanism {
    let mut m = Description::new();
    let b = ["crank", "block", "lever"].map(|n| m.body(n));
    m.pin("C", &[(GROUND, [0.1, -0.9]), (b[2], [0.0, 0.0])]);
    m.joint(
        "lever",
        slide((b[1], [0.03, -0.02]), (b[2], [0.05, 0.1]), 1.5),
    );
    m.pin("O", &[(GROUND, [0.0, 0.0]), (b[0], [0.0, 0.0])]);
    m.pin("A", &[(b[0], [0.3, 0.0]), (b[1], [0.02, 0.01])]);
    m.drive = Drive::Angle {
        body: b[1],
        from: GROUND,
    };
    Mechanism::new(m).unwrap()
}

/// A quick return whose drive is the crank's angle from its block, which turns with the lever: the
/// drive is a closure.
pub(super) fn turned_from_block() -> Mechanism {
    let mut m = Description::new();
    let b = ["crank", "lever", "block"].map(|n| m.body(n));
    m.pin("O", &[(GROUND, [0.0, 0.0]), (b[0], [0.0, 0.0])]);
    m.pin("C", &[(GROUND, [0.1, -0.9]), (b[1], [0.0, 0.0])]);
    m.joint(
        "lever",
        slide((b[2], [0.03, -0.02]), (b[1], [0.05, 0.1]), 1.5),
    );
    m.pin("A", &[(b[0], [0.3, 0.0]), (b[2], [0.02, 0.01])]);
    m.drive = Drive::Angle {
        body: b[0],
        from: b[2],
    };
    Mechanism::new(m).unwrap()
}

/// A block that slides along two levers, which turn with it: one slide gives its angle, the other
/// holds the second lever.
pub(super) fn two_levers() -> Mechanism {
    let (mut m, b) = cranked(&["lever", "block", "second lever"]);
    m.joint(
        "first",
        slide((b[1], [0.01, 0.0]), (b[0], [0.05, 0.02]), 0.2),
    );
    m.joint(
        "second",
        slide((b[1], [0.0, 0.03]), (b[2], [0.1, 0.0]), 1.3),
    );
    m.pin("C", &[(GROUND, [0.8, 0.2]), (b[2], [0.0, 0.04])]);
    Mechanism::new(m).unwrap()
}

/// Every kind of joint, on turning bodies and others, driven and not, at drives with positions;
/// without drives those whose positions or reactions are not told.
pub(super) fn every() -> Vec<(&'static str, Mechanism, &'static [f64])> {
    const ANGLES: &[f64] = &[0.4, 2.2, -1.0];
    vec![
        ("four-bar", four_bar([0.1, 0.4, 0.3, 0.35]), &[0.3, 2.0]),
        ("class III", class_iii(&SAND_SCREEN), &[]),
        ("slider-crank", slider_crank([0.1, 0.3, 0.02]), &[0.7, 2.5]),
        ("quick return", quick_return(), ANGLES),
        ("slotted lever", slotted_lever(), ANGLES),
        ("slotted crank", slotted_crank(), ANGLES),
        ("scotch yoke", scotch_yoke(), ANGLES),
        ("trammel", trammel(), ANGLES),
        ("cylinder", cylinder(), &[0.3, 0.5]),
        ("cross slides", cross_slides(), ANGLES),
        ("common pin", common_pin(), ANGLES),
        ("gears and rack", gears_and_rack(), &[]),
        ("elbow", elbow(), ANGLES),
        ("slotted block", slotted_block(false), ANGLES),
        ("driven block", slotted_block(true), &[0.4, 0.6]),
        ("stacked", stacked(), &[]),
        ("two blocks", two_blocks(), ANGLES),
        ("turned block", turned_block(), &[0.4]),
        ("turned from block", turned_from_block(), ANGLES),
        ("two levers", two_levers(), ANGLES),
    ]
}

#[test]
fn teeth_are_refused() {
    let mechanism = gears_and_rack();
    let u = (0..mechanism.chain.unknowns).map(|k| 0.5 * k as f64);
    let pose = Pose::new(&mechanism.chain, 0.4, u.collect());
    let state = State::new(&mechanism, pose).unwrap();
    let loads = Loads::new(&mechanism, masses(&mechanism), Vec::new(), GRAVITY).unwrap();
    let found = loads.reactions(&mechanism, &state, SPEED, ACCELERATION);
    assert!(matches!(found, Err(ReactionError::Teeth { joint }) if joint == "gears"));
}

#[test]
fn every_body_is_in_equilibrium() {
    for (what, mechanism, drives) in every() {
        let mut seen = 0;
        for &drive in drives {
            let modes = mechanism.assembly_modes(drive);
            seen += modes.states.len();
            modes.states.iter().for_each(|s| hold(what, &mechanism, s));
        }
        assert!(seen > 0 || drives.is_empty(), "{what}: no position");
    }
}
