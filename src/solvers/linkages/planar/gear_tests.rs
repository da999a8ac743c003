//! Gears and racks: angles and displacements that they give, and groups that they leave unsolved.

use super::tests::*;
use super::*;

/// A driven body, bodies on pins of the ground, and what joins them.
fn train(names: &[&str], joints: impl FnOnce(&mut Description)) -> Mechanism {
    let mut d = Description::new();
    for (k, name) in names.iter().enumerate() {
        let body = d.body(*name);
        d.pin(*name, &[(GROUND, [k as f64, 0.0]), (body, [0.0, 0.0])]);
    }
    joints(&mut d);
    Mechanism::new(d).unwrap()
}

fn only(m: &Mechanism, drive: f64) -> State {
    let modes = m.assembly_modes(drive);
    assert!(modes.complete && !modes.near_singular);
    assert_eq!(modes.states.len(), 1);
    modes.states[0].clone()
}

/// `θ_b − θ_c = ratio (θ_a − θ_c) + phase`, solved for either wheel.
#[test]
fn wheels_turn_by_the_ratio() {
    for (ratio, phase) in [(-0.5, 0.3), (1.7, -0.4), (-2.5, 1.1)] {
        let [forward, back] = [[1, 2], [2, 1]].map(|wheels| {
            train(&["a", "b"], |d| {
                d.joint("mesh", gears(wheels, GROUND, ratio, phase));
            })
        });
        for drive in [-1.2, 0.0, 0.7, 2.9] {
            let angle = |m: &Mechanism| m.body_angle(&only(m, drive), 2);
            let found = angle(&forward);
            assert!(turn(found.angle.rad(), ratio * drive + phase) < 1e-14);
            assert!((found.first - ratio).abs() < 1e-14 && found.second.abs() < 1e-14);
            let found = angle(&back);
            assert!(turn(found.angle.rad(), (drive - phase) / ratio) < 1e-14);
            assert!((found.first - 1.0 / ratio).abs() < 1e-14);
        }
    }
}

/// An arm, driven, that carries a wheel meshing with one that is geared to the arm itself.
#[test]
fn wheels_on_a_moving_carrier() {
    for (ratio, phase) in [(-0.5, 0.3), (1.25, -0.2)] {
        for swapped in [false, true] {
            let mut d = Description::new();
            let [arm, sun, planet] = ["arm", "sun", "planet"].map(|n| d.body(n));
            d.pin(
                "O",
                &[(GROUND, [0.0, 0.0]), (arm, [0.0, 0.0]), (sun, [0.0, 0.0])],
            );
            d.pin("P", &[(arm, [1.0, 0.0]), (planet, [0.0, 0.0])]);
            d.joint("first", gears([arm, sun], GROUND, 0.75, 0.1));
            let wheels = if swapped {
                [planet, sun]
            } else {
                [sun, planet]
            };
            d.joint("second", gears(wheels, arm, ratio, phase));
            let m = Mechanism::new(d).unwrap();
            for drive in [-0.8, 0.5, 2.0] {
                let state = only(&m, drive);
                let sun_angle = 0.75 * drive + 0.1;
                let due = match swapped {
                    false => drive + ratio * (sun_angle - drive) + phase,
                    true => drive + (sun_angle - drive - phase) / ratio,
                };
                assert!(turn(m.body_angle(&state, sun).angle.rad(), sun_angle) < 1e-14);
                assert!(turn(m.body_angle(&state, planet).angle.rad(), due) < 1e-14);
            }
        }
    }
}

/// A rack on a guide of the ground or of a driven arm: `s = radius (θ_wheel − θ_guide) + phase`,
/// from the wheel to the rack and from the rack to the wheel.
#[test]
fn racks_and_pinions() {
    let (radius, phase) = (0.4, 0.15);
    let rack = |wheel: usize, slide: usize| rack(wheel, slide, [radius, phase]);
    let mut d = Description::new();
    let [wheel, bar] = ["wheel", "bar"].map(|n| d.body(n));
    d.pin("W", &[(GROUND, [0.0, 0.0]), (wheel, [0.0, 0.0])]);
    let guide = d.joint("guide", slide((bar, [0.1, 0.0]), (GROUND, [0.0, 0.5]), 0.3));
    d.joint("rack", rack(wheel, guide));
    let by_wheel = Mechanism::new(d.clone()).unwrap();
    d.drive = Drive::Displacement { joint: guide };
    let by_rack = Mechanism::new(d).unwrap();
    for drive in [-1.3, 0.2, 0.9] {
        let s = by_wheel
            .joint_displacement(&only(&by_wheel, drive), guide)
            .unwrap();
        assert!((s.s_m - (radius * drive + phase)).abs() < 1e-14);
        assert!((s.first_m - radius).abs() < 1e-14);
        let state = only(&by_rack, drive);
        let turned = by_rack.body_angle(&state, wheel);
        assert!(turn(turned.angle.rad(), (drive - phase) / radius) < 1e-13);
        assert!((turned.first - 1.0 / radius).abs() < 1e-13);
    }
    // On an arm, beside a slide of the same bar's other point that no rack holds.
    let mut d = Description::new();
    let [arm, sun, bar, pin] = ["arm", "sun", "bar", "pin"].map(|n| d.body(n));
    d.pin(
        "O",
        &[(GROUND, [0.0, 0.0]), (arm, [0.0, 0.0]), (sun, [0.0, 0.0])],
    );
    d.joint("mesh", gears([arm, sun], GROUND, -1.5, 0.2));
    let guide = d.joint("guide", slide((bar, [0.1, 0.0]), (arm, [0.0, 0.5]), 0.3));
    d.joint("rack", rack(sun, guide));
    d.pin("Q", &[(bar, [0.7, 0.1]), (pin, [0.0, 0.0])]);
    let slot = slot((pin, [2.0, 0.0]), (GROUND, [0.0, 1.5]), 0.1);
    d.joint("slot", slot);
    let m = Mechanism::new(d).unwrap();
    for drive in [-0.4, 0.3] {
        let modes = m.assembly_modes(drive);
        assert!(modes.complete && !modes.states.is_empty());
        for state in &modes.states {
            let turned = |b: usize| m.body_angle(state, b).angle.rad();
            assert!(turn(turned(sun), -1.5 * drive + 0.2) < 1e-14);
            let s = m.joint_displacement(state, guide).unwrap().s_m;
            assert!((s - (radius * (-1.5 * drive + 0.2 - drive) + phase)).abs() < 1e-13);
            assert!(m.gap(state) < 1e-13);
        }
    }
}

/// A coupler geared to a rocker, and a slot between them: the gear is among the unknowns, and
/// nothing is said.
#[test]
fn gears_among_unknowns_are_not_solved() {
    let mut d = Description::new();
    let [crank, coupler, rocker] = ["crank", "coupler", "rocker"].map(|n| d.body(n));
    d.pin("O", &[(GROUND, [0.0, 0.0]), (crank, [0.0, 0.0])]);
    d.pin("A", &[(crank, [0.2, 0.0]), (coupler, [0.0, 0.0])]);
    d.pin("C", &[(GROUND, [1.0, 0.0]), (rocker, [0.0, 0.0])]);
    d.joint("mesh", gears([coupler, rocker], GROUND, -0.5, 0.2));
    let slot = slot((coupler, [0.6, 0.0]), (rocker, [0.0, 0.0]), 0.3);
    d.joint("slot", slot);
    let modes = Mechanism::new(d).unwrap().assembly_modes(0.4);
    assert!(modes.states.is_empty() && !modes.complete);
}

/// A wheel on a crank that meshes with a rack, and a coupler between both: the rack is among the
/// unknowns.
#[test]
fn racks_among_unknowns_are_not_solved() {
    let mut d = Description::new();
    let [crank, wheel, bar, coupler] = ["crank", "wheel", "bar", "coupler"].map(|n| d.body(n));
    d.pin("O", &[(GROUND, [0.0, 0.0]), (crank, [0.0, 0.0])]);
    d.pin("A", &[(crank, [0.2, 0.0]), (wheel, [0.0, 0.0])]);
    let guide = d.joint("guide", slide((bar, [0.1, 0.0]), (GROUND, [0.0, 0.5]), 0.3));
    let rack = rack(wheel, guide, [0.4, 0.15]);
    d.joint("rack", rack);
    d.pin("W", &[(wheel, [0.3, 0.0]), (coupler, [0.0, 0.0])]);
    d.pin("B", &[(bar, [0.7, 0.1]), (coupler, [0.9, 0.0])]);
    let modes = Mechanism::new(d).unwrap().assembly_modes(0.4);
    assert!(modes.states.is_empty() && !modes.complete);
}

/// A row of platforms, a leg at each and two at the ends: beyond six complex unknowns nothing is
/// said.
#[test]
fn groups_beyond_the_homotopy_are_not_solved() {
    let mut d = Description::new();
    let crank = d.body("crank");
    d.pin("O", &[(GROUND, [0.0, 0.0]), (crank, [0.0, 0.0])]);
    let platforms: Vec<usize> = (0..6).map(|k| d.body(format!("platform {k}"))).collect();
    for (k, pair) in platforms.windows(2).enumerate() {
        d.pin(
            format!("P{k}"),
            &[(pair[0], [1.0, 0.0]), (pair[1], [0.0, 0.0])],
        );
    }
    let held = [0, 0, 1, 2, 3, 4, 5, 5];
    for (k, platform) in held.into_iter().enumerate() {
        let leg = d.body(format!("leg {k}"));
        let foot = if k == 0 {
            (crank, [0.3, 0.0])
        } else {
            (GROUND, [k as f64, -1.0])
        };
        d.pin(format!("F{k}"), &[foot, (leg, [0.0, 0.0])]);
        let at = [0.2 + 0.1 * k as f64, 0.4];
        d.pin(
            format!("L{k}"),
            &[(leg, [1.0, 0.0]), (platforms[platform], at)],
        );
    }
    let m = Mechanism::new(d).unwrap();
    assert_eq!(m.structure().groups[1].bodies.len(), 14);
    let modes = m.assembly_modes(0.4);
    assert!(modes.states.is_empty() && !modes.complete);
}
