use super::*;
use crate::planar::{GROUND, Guide, Joint, Point};
use crate::units::{Angle, Inertia, Length, Mass};
use std::f64::consts::{FRAC_PI_2, PI};

fn mass(body: usize, kg: f64, inertia: f64, [x, y]: [f64; 2]) -> BodyMass {
    BodyMass {
        body,
        mass: Mass::from_kg(kg),
        inertia: Inertia::from_kg_m2(inertia),
        centre: [Length::from_m(x), Length::from_m(y)],
    }
}

fn given(body: usize, value: f64, speed: f64) -> Given {
    let coordinate = Coordinate::angle(body);
    Given {
        coordinate,
        value,
        speed,
    }
}

fn four_bar_parts() -> (Description, Vec<BodyMass>) {
    let mut d = Description::new();
    let [crank, coupler, rocker] = ["crank", "coupler", "rocker"].map(|n| d.body(n));
    d.pin("O", &[(GROUND, [0.0, 0.0]), (crank, [0.0, 0.0])]);
    d.pin("A", &[(crank, [0.1, 0.0]), (coupler, [0.0, 0.0])]);
    d.pin("B", &[(coupler, [0.4, 0.0]), (rocker, [0.3, 0.0])]);
    d.pin("C", &[(GROUND, [0.35, 0.0]), (rocker, [0.0, 0.0])]);
    let masses = vec![
        mass(crank, 1.0, 0.002, [0.05, 0.0]),
        mass(coupler, 2.0, 0.03, [0.2, 0.01]),
        mass(rocker, 1.5, 0.012, [0.15, 0.0]),
    ];
    (d, masses)
}

fn four_bar(loads: Vec<Load>) -> Dynamics {
    let (d, masses) = four_bar_parts();
    Dynamics::new(d, masses, loads, Vec::new(), [0.0, -9.81]).unwrap()
}

fn last(dynamics: &Dynamics, start: &Assembly, time: f64) -> Moment {
    let mut last = None;
    let settings = Settings::default();
    dynamics
        .motion(start, &[time], settings, |m| {
            last = Some(m.clone());
            true
        })
        .unwrap();
    last.unwrap()
}

/// Energy is kept, and loops stay closed, while the crank swings to and fro through the turning
/// points of every body.
#[test]
fn a_four_bar_swings_without_loss() {
    let dynamics = four_bar(Vec::new());
    let start = dynamics.assemblies(&[given(1, 1.0, 0.0)], &[]).unwrap();
    assert_eq!(start.len(), 2);
    let times: Vec<f64> = (0..=500).map(|k| 0.01 * f64::from(k)).collect();
    for start in start {
        let mut first = None;
        let mut turned = 0;
        let mut before = 0.0;
        dynamics
            .motion(&start, &times, Settings::default(), |m| {
                let [kinetic, potential] = dynamics.energy(m);
                let energy = kinetic + potential;
                let first = *first.get_or_insert(energy);
                assert!(
                    (energy - first).abs() < 1e-10,
                    "{} {energy} {first}",
                    m.time
                );
                assert!(dynamics.gap(m) < 1e-15);
                let rate = dynamics.angle(m, 1)[1];
                turned += i32::from(rate * before < 0.0);
                before = rate;
                true
            })
            .unwrap();
        assert!(turned > 2, "{turned}");
    }
}

/// The crank's acceleration is that of the reduced equation, `I φ̈ + ½ I′ φ̇² = M_o − D φ̇`.
#[test]
fn accelerations_are_those_of_the_reduced_equation() {
    let loads = || {
        vec![
            Load::TorsionDamper {
                body: 3,
                from: GROUND,
                damping: 0.3,
            },
            Load::Spring {
                ends: [
                    Point::from_m(GROUND, [0.2, 0.5]),
                    Point::from_m(2, [0.2, 0.1]),
                ],
                stiffness: 40.0,
                length: 0.1,
            },
            Load::Damper {
                ends: [
                    Point::from_m(GROUND, [0.0, 0.5]),
                    Point::from_m(2, [0.1, 0.1]),
                ],
                damping: 2.0,
            },
            Load::TorsionSpring {
                body: 2,
                from: 3,
                stiffness: 1.5,
                angle: 0.4,
            },
            Load::Force {
                at: Point::from_m(3, [0.1, 0.2]),
                components: [Course::Constant(3.0), Course::Constant(-1.0)],
                along: 2,
            },
            Load::Torque {
                body: 1,
                from: 2,
                torque: Course::Constant(0.7),
            },
        ]
    };
    let (mut d, masses) = four_bar_parts();
    d.drive = crate::planar::Drive::Angle {
        body: 1,
        from: GROUND,
    };
    let mechanism = crate::planar::Mechanism::new(d).unwrap();
    let reduced = Loads::new(&mechanism, masses, loads(), [0.0, -9.81]).unwrap();
    let dynamics = four_bar(loads());
    for (k, speed) in [(0, 0.0), (1, 3.0), (2, -7.0), (5, 11.0)] {
        let phi = 0.3 + f64::from(k);
        let modes = mechanism.assembly_modes(phi);
        for state in &modes.states {
            let near: Vec<(usize, f64)> = (1..4)
                .map(|b| (b, mechanism.body_angle(state, b).angle.rad()))
                .collect();
            let start = dynamics.assemblies(&[given(1, phi, speed)], &near).unwrap();
            let moment = last(&dynamics, &start[0], 0.0);
            // The torsion spring counts the angles of its own bodies.
            let mut own = reduced.clone();
            let turn = |b: usize| dynamics.angle(&moment, b)[0] - near[b - 1].1;
            own.shift_torsion_springs(|b, f| turn(f) - turn(b));
            let r = own.reduce(&mechanism, state);
            let due = (r.moment - r.damping * speed - 0.5 * r.inertia_derivative * speed * speed)
                / r.inertia;
            let found = dynamics.angle(&moment, 1)[2];
            assert!(
                (found - due).abs() < 1e-10 * due.abs().max(1.0),
                "{found} {due}"
            );
        }
    }
}

/// Two point masses on massless rods: Lagrange's equations as any textbook has them.
#[test]
fn a_double_pendulum() {
    let mut d = Description::new();
    let [a, b] = ["a", "b"].map(|n| d.body(n));
    d.pin("O", &[(GROUND, [0.0, 0.0]), (a, [0.0, 0.0])]);
    d.pin("A", &[(a, [1.0, 0.0]), (b, [0.0, 0.0])]);
    let masses = vec![mass(a, 2.0, 0.0, [1.0, 0.0]), mass(b, 3.0, 0.0, [0.7, 0.0])];
    let dynamics = Dynamics::new(d, masses, Vec::new(), Vec::new(), [0.0, -9.81]).unwrap();
    assert_eq!(dynamics.freedoms(), 2);
    let (t1, t2, w1, w2): (f64, f64, f64, f64) = (0.8, -0.4, 1.5, -2.0);
    let start = [given(a, t1 - FRAC_PI_2, w1), given(b, t2 - FRAC_PI_2, w2)];
    let start = dynamics.assemblies(&start, &[]).unwrap();
    assert_eq!(start.len(), 1);
    let moment = last(&dynamics, &start[0], 0.0);
    let (m1, m2, l1, l2, g) = (2.0, 3.0, 1.0, 0.7, 9.81);
    let (s, c) = (t1 - t2).sin_cos();
    let (a11, a12, a22) = ((m1 + m2) * l1 * l1, m2 * l1 * l2 * c, m2 * l2 * l2);
    let f1 = -m2 * l1 * l2 * w2 * w2 * s - (m1 + m2) * g * l1 * t1.sin();
    let f2 = m2 * l1 * l2 * w1 * w1 * s - m2 * g * l2 * t2.sin();
    let det = a11 * a22 - a12 * a12;
    let due = [(f1 * a22 - f2 * a12) / det, (a11 * f2 - a12 * f1) / det];
    for (body, due) in [(a, due[0]), (b, due[1])] {
        let found = dynamics.angle(&moment, body)[2];
        assert!((found - due).abs() < 1e-12 * due.abs(), "{found} {due}");
    }
    // Energy over a chaotic motion.
    let energy = |m: &Moment| dynamics.energy(m).iter().sum::<f64>();
    let end = last(&dynamics, &start[0], 5.0);
    assert!((energy(&end) - energy(&moment)).abs() < 1e-9);
}

/// A block on an inclined guide that turns: slides are coordinates with inertia through the block.
#[test]
fn a_block_slides_down() {
    let mut d = Description::new();
    let block = d.body("block");
    let guide = Guide {
        origin: Point::from_m(GROUND, [0.0, 0.0]),
        direction: Angle::from_rad(-PI / 6.0),
    };
    d.joint(
        "s",
        Joint::Slide {
            slider: Point::from_m(block, [0.0, 0.0]),
            guide,
            turn: Angle::from_rad(0.2),
        },
    );
    let masses = vec![mass(block, 2.0, 0.1, [0.3, 0.1])];
    let dynamics = Dynamics::new(d, masses, Vec::new(), Vec::new(), [0.0, -9.81]).unwrap();
    let start = Given {
        coordinate: Coordinate::Displacement { joint: 0 },
        value: 0.25,
        speed: -1.0,
    };
    let start = dynamics.assemblies(&[start], &[]).unwrap();
    let end = last(&dynamics, &start[0], 2.0);
    let [s, v] = dynamics.displacement(&end, 0);
    let a = 9.81 * 0.5;
    assert!((s - (0.25 - 2.0 + 2.0 * a)).abs() < 1e-11, "{s}");
    assert!((v - (-1.0 + 2.0 * a)).abs() < 1e-11, "{v}");
}

/// A motion ends where a law changes its sign.
#[test]
fn a_motion_ends_at_an_event() {
    let dynamics = four_bar(Vec::new());
    let start = dynamics
        .assemblies(&[given(1, 1.0, 0.0)], &[(3, 2.0)])
        .unwrap();
    let law: Law = Box::new(|i| i.angle(1)[1]);
    let late: Law = Box::new(|i| i.time - 0.5);
    let times = [0.0, 0.1, 9.0];
    let mut seen = Vec::new();
    let mut until = |law: &Law| {
        let ended = dynamics.motion_until(&start[0], &times, Settings::default(), Some(law), |m| {
            seen.push(m.time);
            assert!(
                law(&Instant {
                    dynamics: &dynamics,
                    pose: &m.pose,
                    flow: &m.motion,
                    time: m.time,
                })
                .is_finite()
            );
            true
        });
        ended.unwrap().unwrap()
    };
    assert!((until(&late) - 0.5).abs() < 1e-14);
    let turned = until(&law);
    assert!(turned > 0.0 && turned < 9.0);
    let end = last(&dynamics, &start[0], turned);
    assert!(dynamics.angle(&end, 1)[1].abs() < 1e-9);
    assert_eq!(seen[..2], [0.0, 0.1]);
}

#[test]
fn refusals() {
    let (d, masses) = four_bar_parts();
    let table = Load::Torque {
        body: 1,
        from: GROUND,
        torque: Course::Table(vec![[0.0, 1.0], [1.0, 2.0]]),
    };
    let made = Dynamics::new(d.clone(), masses, vec![table], Vec::new(), [0.0; 2]);
    assert_eq!(made.err(), Some(DynamicsError::Table));
    let dynamics = four_bar(Vec::new());
    let none = dynamics.assemblies(&[], &[]).err();
    assert!(matches!(
        none,
        Some(DynamicsError::Freedoms {
            freedoms: 1,
            given: 0
        })
    ));
    // The rocker cannot stand at 0 rad.
    let off = dynamics.assemblies(&[given(3, 0.0, 0.0)], &[]).err();
    assert_eq!(off, Some(DynamicsError::NotAssembled));
    // Without masses nothing resists.
    let light = Dynamics::new(d, Vec::new(), Vec::new(), Vec::new(), [0.0; 2]).unwrap();
    let start = light.assemblies(&[given(1, 1.0, 0.0)], &[]).unwrap();
    let found = light
        .motion(&start[0], &[1.0], Settings::default(), |_| true)
        .err();
    assert_eq!(found, Some(DynamicsError::NoInertia { t: 0.0 }));
    // A law without a value.
    let (d, masses) = four_bar_parts();
    let law: Law = Box::new(|i| (1.0 - i.time).sqrt());
    let torque = DrivenLoad::Torque {
        body: 1,
        from: GROUND,
        torque: law,
    };
    let driven = Dynamics::new(d, masses, Vec::new(), vec![torque], [0.0; 2]).unwrap();
    let start = driven.assemblies(&[given(1, 1.0, 0.0)], &[]).unwrap();
    let found = driven
        .motion(&start[0], &[2.0], Settings::default(), |_| true)
        .err();
    assert!(
        matches!(found, Some(DynamicsError::Law { t } | DynamicsError::Small { t }) if (0.99..1.01).contains(&t)),
        "{found:?}"
    );
}
