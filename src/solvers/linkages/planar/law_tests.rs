//! Laws, and descriptions that are refused.

use super::tests::*;
use super::*;

fn ring(n: usize) -> Description {
    let mut m = Description::new();
    let bars: Vec<usize> = (1..n).map(|k| m.body(format!("bar {k}"))).collect();
    m.pin("first", &[(GROUND, [0.0, 0.0]), (bars[0], [0.0, 0.0])]);
    for (k, w) in bars.windows(2).enumerate() {
        let l = 0.3 + 0.1 * k as f64;
        m.pin(format!("pin {k}"), &[(w[0], [l, 0.0]), (w[1], [0.0, 0.0])]);
    }
    m.pin("last", &[(bars[n - 2], [0.4, 0.0]), (GROUND, [0.5, 0.1])]);
    m.drive = Drive::Angle {
        body: bars[0],
        from: GROUND,
    };
    m
}

#[test]
fn freedoms_are_counted() {
    let told = |d: Description| Mechanism::new(d).map(|_| ()).unwrap_err().to_string();
    Mechanism::new(ring(4)).unwrap();
    assert_eq!(
        told(ring(5)),
        "with the drive held, bar 2, bar 3, bar 4 can still move, in 1 degree of freedom"
    );
    assert_eq!(
        told(ring(3)),
        "locked: the drive has nothing to move, ground, bar 1, bar 2 hold one another"
    );
    let mut held = ring(4);
    held.pin("brace", &[(1, [0.2, 0.1]), (3, [0.1, 0.1])]);
    assert_eq!(
        told(held),
        "over-constrained: brace is redundant among ground, bar 1, bar 2, bar 3"
    );
    let mut twice = ring(4);
    twice.pin("again", &[(1, [0.3, 0.2]), (2, [0.0, 0.2])]);
    assert_eq!(
        told(twice),
        "over-constrained: again is redundant among bar 1, bar 2"
    );
}

#[test]
fn bad_parts_are_refused() {
    let told = |change: &dyn Fn(&mut Description)| {
        let mut d = ring(4);
        change(&mut d);
        Mechanism::new(d).map(|_| ()).unwrap_err()
    };
    use MechanismError as E;
    let pin = |points: &[(usize, [f64; 2])]| {
        told(&|d| {
            d.pin("x", points);
        })
    };
    let nan = pin(&[(1, [f64::NAN, 0.0]), (2, [0.0; 2])]);
    assert!(matches!(nan, E::NotFinite { .. }), "{nan}");
    let body = pin(&[(1, [0.0; 2]), (9, [0.0; 2])]);
    assert!(
        matches!(
            body,
            E::NoSuchBody {
                body: 9,
                last: 3,
                ..
            }
        ),
        "{body}"
    );
    let same = pin(&[(1, [0.0; 2]), (1, [0.1; 2])]);
    assert!(matches!(same, E::SameBody { .. }), "{same}");
    let lonely = pin(&[(1, [0.0; 2])]);
    assert!(matches!(lonely, E::LonelyPin { count: 1, .. }), "{lonely}");
    let drive = told(&|d| d.drive = Drive::Displacement { joint: 0 });
    assert!(matches!(drive, E::NoSlide { joint: 0, .. }), "{drive}");
    let itself = told(&|d| d.drive = Drive::Angle { body: 2, from: 2 });
    assert!(matches!(itself, E::SameBody { .. }), "{itself}");
}

/// Driven at its follower by the angle found, a linkage has the crank's angle among its modes, and
/// the rates are inverse.
#[test]
fn drive_and_follower_exchanged() {
    let mut random = Random(12);
    for _ in 0..100 {
        let v: [f64; 11] = std::array::from_fn(|_| random.between(0.3, 1.5));
        let general = class_iii(&v);
        let mut d = general.description().clone();
        d.drive = Drive::Angle {
            body: 5,
            from: GROUND,
        };
        let exchanged = Mechanism::new(d).unwrap();
        // Seen from rocker 5 these are the driver and two dyads.
        assert_eq!(exchanged.structure().groups.len(), 3);
        let phi = random.between(-3.0, 3.0);
        for s in general.assembly_modes(phi).states {
            let rocker = general.body_angle(&s, 5);
            let modes = exchanged.assembly_modes(rocker.angle.rad());
            let back = modes.states.iter().find(|o| {
                (1..=4).all(|b| {
                    let [x, y] = [general.body_angle(&s, b), exchanged.body_angle(o, b)];
                    turn(x.angle.rad(), y.angle.rad()) < 1e-6
                })
            });
            if let Some(o) = back {
                let rate = exchanged.body_angle(o, 1).first;
                assert!(
                    (rate * rocker.first - 1.0).abs() < 1e-5,
                    "{rate} {}",
                    rocker.first
                );
            } else {
                // Lost only where the exchanged linkage is nearly singular.
                assert!(
                    modes.near_singular || rocker.first.abs() < 1e-4,
                    "{rocker:?}"
                );
            }
        }
    }
}

/// A lever with a slot, against the angle of the line to the crank's pin.
#[test]
fn a_pin_in_a_slot() {
    let mut m = Description::new();
    let [crank, lever] = ["crank", "lever"].map(|n| m.body(n));
    m.pin("O", &[(GROUND, [0.0, 0.12]), (crank, [0.0, 0.0])]);
    m.pin("Q", &[(GROUND, [0.0, 0.0]), (lever, [0.0, 0.0])]);
    let pin = Point::from_m(crank, [0.05, 0.0]);
    let slot = guide((lever, [0.0, 0.0]), 0.0);
    m.joint("slot", Joint::Slot { pin, slot });
    m.drive = Drive::Angle {
        body: crank,
        from: GROUND,
    };
    let m = Mechanism::new(m).unwrap();
    for phi in [0.0f64, 1.0, 2.5, -2.0] {
        let modes = m.assembly_modes(phi);
        assert!(modes.complete && modes.states.len() == 2);
        let due = (0.12 + 0.05 * phi.sin()).atan2(0.05 * phi.cos());
        for s in &modes.states {
            let angle = m.body_angle(s, 2).angle.rad();
            let half = turn(angle, due).min(turn(angle, due + std::f64::consts::PI));
            assert!(half < 1e-14);
            let travel = m.joint_displacement(s, 2).unwrap();
            let length = (0.05 * phi.cos()).hypot(0.12 + 0.05 * phi.sin());
            assert!((travel.s_m.abs() - length).abs() < 1e-15);
        }
    }
}
