use super::tests::*;
use super::*;
use crate::units::{Inertia, Length, Mass};

fn mass(body: usize, kg: f64, j: f64, centre: [f64; 2]) -> BodyMass {
    BodyMass {
        body,
        mass: Mass::from_kg(kg),
        inertia: Inertia::from_kg_m2(j),
        centre: centre.map(Length::from_m),
    }
}

/// Everything that there is, on a class-III linkage.
fn loaded(mechanism: &Mechanism) -> Loads {
    let masses =
        (1..=5).map(|k| mass(k, 0.5 + k as f64, 0.02 * k as f64, [0.05 * k as f64, -0.03]));
    let point = |body, at| Point::from_m(body, at);
    let loads = vec![
        Load::Force {
            at: point(4, [0.2, 0.1]),
            components: [
                Course::Constant(30.0),
                Course::Table(vec![[0.0, 1.0], [2.0, -7.0]]),
            ],
            along: 4,
        },
        Load::Torque {
            body: 5,
            from: 4,
            torque: Course::Constant(-3.0),
        },
        Load::Spring {
            ends: [point(0, [0.5, 0.5]), point(2, [0.4, 0.1])],
            stiffness: 200.0,
            length: 0.1,
        },
        Load::TorsionSpring {
            body: 3,
            from: 1,
            stiffness: 15.0,
            angle: 0.4,
        },
        Load::Damper {
            ends: [point(1, [0.02, 0.0]), point(5, [0.1, 0.0])],
            damping: 12.0,
        },
        Load::TorsionDamper {
            body: 4,
            from: 2,
            damping: 0.7,
        },
    ];
    Loads::new(mechanism, masses.collect(), loads, [0.3, -9.81]).unwrap()
}

/// The drive torque by the bodies' equations is that of the reduced quantities.
#[test]
fn power_is_balanced() {
    let mechanism = class_iii(&SAND_SCREEN);
    let loads = loaded(&mechanism);
    for drive in [0.3, 1.7, -2.0] {
        for state in mechanism.assembly_modes(drive).states {
            for (w, e) in [(0.0, 0.0), (3.0, 0.0), (-2.0, 5.0)] {
                let due = loads.reduce(&mechanism, &state).drive(w, e);
                let found = loads.reactions(&mechanism, &state, w, e).unwrap();
                assert!(
                    (found.drive - due).abs() < 1e-9 * (1.0 + due.abs()),
                    "{} {due}",
                    found.drive
                );
            }
        }
    }
}

#[test]
fn reduced_derivatives_are_those_of_the_values() {
    let mechanism = class_iii(&SAND_SCREEN);
    let loads = loaded(&mechanism);
    let h = 1e-5;
    for state in mechanism.assembly_modes(1.1).states {
        let [a, b] = [-h, h].map(|d| {
            let s = mechanism.follow(&state, 1.1 + d).unwrap();
            loads.reduce(&mechanism, &s)
        });
        let mid = loads.reduce(&mechanism, &state);
        let inertia = (b.inertia - a.inertia) / (2.0 * h);
        let moment = (b.moment - a.moment) / (2.0 * h);
        assert!((inertia - mid.inertia_derivative).abs() < 1e-6 * (1.0 + inertia.abs()));
        assert!((moment - mid.moment_derivative).abs() < 1e-6 * (1.0 + moment.abs()));
        assert!(mid.damping > 0.0);
    }
}

#[test]
fn bad_loads_are_refused() {
    let m = four_bar([0.1, 0.4, 0.3, 0.35]);
    let refused = |masses: Vec<BodyMass>, loads: Vec<Load>| {
        Loads::new(&m, masses, loads, [0.0; 2]).unwrap_err()
    };
    let none = Vec::new;
    assert!(matches!(
        refused(vec![mass(2, -1.0, 0.0, [0.0; 2])], none()),
        LoadError::Negative { .. }
    ));
    assert!(matches!(
        refused(vec![mass(2, f64::NAN, 0.0, [0.0; 2])], none()),
        LoadError::NotFinite { .. }
    ));
    assert!(matches!(
        refused(vec![mass(9, 1.0, 0.0, [0.0; 2])], none()),
        LoadError::NoSuchBody { .. }
    ));
    assert!(matches!(
        refused(vec![mass(0, 1.0, 0.0, [0.0; 2])], none()),
        LoadError::Twice { body: 0 }
    ));
    let table = |rows| {
        vec![Load::Torque {
            body: 1,
            from: 0,
            torque: Course::Table(rows),
        }]
    };
    for rows in [
        vec![],
        vec![[1.0, 0.0], [1.0, 2.0]],
        vec![[0.0, 0.0], [7.0, 2.0]],
        vec![[0.0, 0.0], [std::f64::consts::TAU, 2.0]],
        vec![[0.0, 0.0], [1.0, 2.0], [0.5, 1.0]],
    ] {
        assert_eq!(refused(Vec::new(), table(rows)), LoadError::Table);
    }
    // A turn is counted from the first row.
    for rows in [
        vec![[5.0, 0.0], [11.0, 2.0]],
        vec![[-3.0, 1.0], [3.0, 2.0]],
        vec![[2.0, 1.0]],
    ] {
        assert!(Loads::new(&m, Vec::new(), table(rows), [0.0; 2]).is_ok());
    }
    let beyond = m.description().bodies.len();
    assert!(matches!(
        refused(vec![mass(beyond, 1.0, 0.0, [0.0; 2])], none()),
        LoadError::NoSuchBody { body, .. } if body == beyond
    ));
}

#[test]
fn tables_are_read_by_straight_lines() {
    let table = Course::Table(vec![[1.0, 2.0], [2.0, 4.0], [4.0, 0.0]]);
    for (x, linear, due) in [
        (1.5, true, [3.0, 2.0]),
        (3.0, true, [2.0, -2.0]),
        (0.0, true, [2.0, 0.0]),
        (9.0, true, [0.0, 0.0]),
        (2.0, true, [4.0, -2.0]),
        (4.0, true, [0.0, 0.0]),
        (1.5 + std::f64::consts::TAU, false, [3.0, 2.0]),
    ] {
        let [a, b] = table.at(x, linear);
        assert!(
            (a - due[0]).abs() < 1e-14 && (b - due[1]).abs() < 1e-14,
            "{x}"
        );
    }
    // From the last row on towards the first, a turn later.
    let [a, b] = table.at(0.5, false);
    let slope = 2.0 / (1.0 + std::f64::consts::TAU - 4.0);
    assert!((b - slope).abs() < 1e-14 && (a - (2.0 - 0.5 * slope)).abs() < 1e-14);
}

/// The torque on a body by a table, and its derivative along the drive.
#[test]
fn moments_of_tabulated_torques() {
    let m = four_bar([0.1, 0.4, 0.3, 0.35]);
    let rows = vec![[0.0, 2.0], [1.0, 5.0], [2.0, -1.0]];
    let torque = Load::Torque {
        body: 3,
        from: 2,
        torque: Course::Table(rows),
    };
    let loads = Loads::new(&m, Vec::new(), vec![torque.clone()], [0.0; 2]).unwrap();
    for (drive, value) in [(0.4, 3.2), (1.5, 2.0)] {
        let at = |drive: f64| {
            let state = m.assembly_modes(drive).states.remove(0);
            let [a, b] = [2, 3].map(|k| m.body_angle(&state, k).first);
            (loads.reduce(&m, &state), b - a)
        };
        let (found, rate) = at(drive);
        assert!((found.moment - value * rate).abs() < 1e-13);
        let h = 1e-5;
        let slope = (at(drive + h).0.moment - at(drive - h).0.moment) / (2.0 * h);
        assert!((found.moment_derivative - slope).abs() < 1e-7 * (1.0 + slope.abs()));
    }
    let ends = [Point::from_m(1, [0.1, 0.0]), Point::from_m(3, [0.2, 0.0])];
    let damper = Load::Damper { ends, damping: 1.0 };
    let turning = Load::TorsionDamper {
        body: 1,
        from: 0,
        damping: 1.0,
    };
    for (all, due) in [
        (vec![], false),
        (vec![torque.clone()], false),
        (vec![damper.clone()], true),
        (vec![torque.clone(), turning], true),
        (vec![damper, torque], true),
    ] {
        assert_eq!(
            Loads::new(&m, Vec::new(), all, [0.0; 2])
                .unwrap()
                .has_dampers(),
            due
        );
    }
}
