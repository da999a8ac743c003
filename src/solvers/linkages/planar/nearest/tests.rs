//! The nearest position, by Newton's method and among all modes.

use super::super::tests::*;
use super::super::*;
use super::*;
use crate::units::Angle;
use std::f64::consts::{PI, TAU};

pub(super) fn angles(all: &[f64]) -> Vec<Angle> {
    all.iter().map(|&x| Angle::from_rad(x)).collect()
}

pub(super) fn placed(m: &Mechanism, state: &State) -> Vec<f64> {
    let bodies = m.description().bodies.len();
    let of = |b| m.body_angle(state, b).angle.rad();
    (1..bodies).map(of).collect()
}

/// The distances of all modes from `near`, whole turns aside, in order.
fn distances(m: &Mechanism, phi: f64, near: &[f64]) -> Vec<f64> {
    let of = |s: &State| {
        let pairs = placed(m, s).into_iter().zip(near);
        pairs.fold(0.0, |d: f64, (x, g)| d.max(turn(x, *g)))
    };
    let mut all: Vec<f64> = m.assembly_modes(phi).states.iter().map(of).collect();
    all.sort_by(f64::total_cmp);
    all
}

pub(super) fn off(m: &Mechanism, state: &State, near: &[f64]) -> f64 {
    let pairs = placed(m, state).into_iter().zip(near);
    pairs.fold(0.0, |d: f64, (x, g)| d.max((x - g).abs()))
}

pub(super) fn some_linkages(random: &mut Random) -> Vec<Mechanism> {
    let mut all = vec![double_butterfly(), class_iii(&SAND_SCREEN)];
    for _ in 0..30 {
        all.push(class_iii(&std::array::from_fn(|_| {
            random.between(0.3, 1.5)
        })));
        all.push(four_bar(std::array::from_fn(|_| random.between(0.2, 1.5))));
    }
    all
}

/// From anywhere: what Newton's method decides is what all modes decide.
#[test]
fn newton_and_all_modes_agree() {
    let mut random = Random(21);
    let (mut decided, mut none, mut open) = (0, 0, 0);
    for m in some_linkages(&mut random) {
        for round in 0..24 {
            let phi = random.between(-3.0, 3.0);
            let states = m.assembly_modes(phi).states;
            let size = [0.03, 0.3, 1.0, PI][round % 4];
            let mut near = match states.len() {
                0 => vec![0.0; m.description().bodies.len() - 1],
                n => placed(&m, &states[round % n]),
            };
            near[1..]
                .iter_mut()
                .for_each(|x| *x += random.between(-size, size));
            near[0] = phi;
            let reach = random.between(0.0, 2.0 * size);
            let all = distances(&m, phi, &near);
            let within = all.first().is_some_and(|d| *d <= reach);
            match m.nearest_by_newton(phi, &near, reach) {
                Way::Found(state) => {
                    decided += 1;
                    assert!(within && m.gap(&state) < 1e-13);
                    assert!((off(&m, &state, &near) - all[0]).abs() < 1e-9);
                    assert!(all.get(1).is_none_or(|d| *d > all[0]));
                }
                Way::None => {
                    none += 1;
                    assert!(!within, "{all:?} {reach}");
                }
                Way::Unknown => open += 1,
            }
        }
    }
    println!("{decided} found, {none} none, {open} open");
    assert!(decided > 200 && none > 200 && open > 200);
}

/// Close to a mode Newton's method decides alone, also where its neighbour is not far.
#[test]
fn near_a_mode_newton_decides() {
    let mut random = Random(22);
    let (mut all, mut open) = (0, 0);
    for m in some_linkages(&mut random) {
        let phi = random.between(-3.0, 3.0);
        let modes = m.assembly_modes(phi);
        for s in modes.states {
            let exact = placed(&m, &s);
            let mut near = exact.clone();
            near[1..]
                .iter_mut()
                .for_each(|x| *x += random.between(-1e-3, 1e-3));
            all += 1;
            match m.nearest_by_newton(phi, &near, 0.1) {
                Way::Found(state) => assert!(off(&m, &state, &exact) < 1e-9),
                Way::None => panic!("{exact:?}"),
                Way::Unknown => open += 1,
            }
        }
    }
    assert!(all > 80 && open * 20 < all, "{open} of {all}");
}

/// A dyad whose two modes are 2t apart, from between them. The estimate is nearly sharp: from the
/// share s of the way to one of them it gives about (1 − s)/(1 + s).
#[test]
fn equally_far_modes_are_not_told_apart() {
    // Coupler and rocker of length 1 on a base of 2 cos t: the modes are at angles ±t and π ∓ t.
    for t in [0.3f64, 0.01] {
        let m = four_bar([0.5, 1.0, 1.0, 0.5 + 2.0 * t.cos()]);
        let near = |share: f64| [0.0, share * t, PI - share * t];
        let told = |share: f64| m.nearest(0.0, &angles(&near(share)), Angle::from_rad(1.0));
        assert_eq!(told(0.0).unwrap_err(), NearestError::CannotTell);
        for share in [1e-6, 0.1, 0.5, 1.0, 1.5, -0.5] {
            let state = told(share).unwrap();
            let due = t.copysign(share);
            assert!((placed(&m, &state)[1] - due).abs() < 1e-9 / t);
        }
        for (share, due) in [(0.5, true), (1.5, true), (0.01, false)] {
            let way = m.nearest_by_newton(0.0, &near(share), 1.0);
            assert_eq!(matches!(way, Way::Found(_)), due, "{t} {share}");
        }
    }
}

#[test]
fn whole_turns_are_those_given() {
    let m = four_bar([0.1, 0.4, 0.3, 0.35]);
    let state = &m.assembly_modes(1.0).states[0];
    let exact = placed(&m, state);
    let mut near = exact.clone();
    near[1] += 3.0 * TAU + 1e-3;
    near[2] -= TAU;
    let found = m
        .nearest(1.0, &angles(&near), Angle::from_rad(0.1))
        .unwrap();
    for (x, (g, e)) in placed(&m, &found).iter().zip(near.iter().zip(&exact)) {
        assert!((x - g).abs() < 2e-3 && turn(*x, *e) < 1e-13);
    }
    // The drive gives the crank's angle as a number.
    near[0] += TAU;
    let none = m.nearest(1.0, &angles(&near), Angle::from_rad(0.1));
    assert!(matches!(none, Err(NearestError::NoneWithin { .. })));
    let turned = m.nearest(1.0 + TAU, &angles(&near), Angle::from_rad(0.1));
    assert!(off(&m, &turned.unwrap(), &near) < 2e-3);
}

#[test]
fn slides_are_decided_by_all_modes() {
    let m = slider_crank([0.3, 1.0, 0.1]);
    let modes = m.assembly_modes(0.7).states;
    assert_eq!(modes.len(), 2);
    for s in &modes {
        let mut near = placed(&m, s);
        near[1] += 0.05;
        let found = m
            .nearest(0.7, &angles(&near), Angle::from_rad(0.1))
            .unwrap();
        assert!(off(&m, &found, &placed(&m, s)) < 1e-12);
        near[1] += 0.1;
        let none = m.nearest(0.7, &angles(&near), Angle::from_rad(0.1));
        assert_eq!(none.unwrap_err(), NearestError::NoneWithin { reach: 0.1 });
    }
}

#[test]
fn bad_input_is_refused() {
    let m = four_bar([0.1, 0.4, 0.3, 0.35]);
    let reach = Angle::from_rad(0.1);
    let told = |drive: f64, near: &[f64]| m.nearest(drive, &angles(near), reach).unwrap_err();
    let count = NearestError::Count {
        given: 2,
        bodies: 3,
    };
    assert_eq!(told(1.0, &[1.0, 0.0]), count);
    let value = f64::INFINITY;
    assert_eq!(
        told(1.0, &[1.0, 0.0, value]),
        NearestError::NotFinite { value }
    );
    assert_eq!(
        told(value, &[1.0, 0.0, 0.0]),
        NearestError::NotFinite { value }
    );
    // A crank that cannot be joined: the pin's gap is wider than any arms reach.
    let apart = four_bar([0.1, 0.1, 0.1, 0.9]);
    let none = apart.nearest(0.0, &angles(&[0.0; 3]), reach);
    assert_eq!(none.unwrap_err(), NearestError::NoneWithin { reach: 0.1 });
    assert!(matches!(
        apart.nearest_by_newton(0.0, &[0.0; 3], 0.1),
        Way::None
    ));
}

#[test]
fn gears_are_not_decided() {
    let mut d = Description::new();
    let [a, b] = ["a", "b"].map(|n| d.body(n));
    d.pin("A", &[(GROUND, [0.0, 0.0]), (a, [0.0, 0.0])]);
    d.pin("B", &[(GROUND, [1.0, 0.0]), (b, [0.0, 0.0])]);
    let wheels = gears([a, b], GROUND, -0.5, 0.0);
    d.joint("mesh", wheels);
    let m = Mechanism::new(d).unwrap();
    let near = angles(&[1.0, -0.5]);
    let told = m.nearest(1.0, &near, Angle::from_rad(0.1));
    assert_eq!(told.unwrap_err(), NearestError::CannotTell);
}

/// Angles of unknowns from those of the bodies: less the drive and what a slide adds.
#[test]
fn unknowns_from_angles_of_bodies() {
    let mut random = Random(34);
    let coupled = {
        // The coupler is turned against the crank.
        let mut d = four_bar([0.1, 0.4, 0.3, 0.35]).description().clone();
        d.drive = Drive::Angle { body: 2, from: 1 };
        Mechanism::new(d).unwrap()
    };
    let from_behind = {
        let mut d = four_bar([0.1, 0.4, 0.3, 0.35]).description().clone();
        d.drive = Drive::Angle { body: 1, from: 2 };
        Mechanism::new(d).unwrap()
    };
    // The coupler, the first body, hangs on the crank and has the drive in its angle.
    let hung = {
        let mut d = Description::new();
        let [coupler, crank, rocker] = ["coupler", "crank", "rocker"].map(|n| d.body(n));
        d.pin("O", &[(GROUND, [0.0, 0.0]), (crank, [0.0, 0.0])]);
        d.pin("A", &[(crank, [0.1, 0.0]), (coupler, [0.0, 0.0])]);
        d.pin("B", &[(coupler, [0.4, 0.0]), (rocker, [0.3, 0.0])]);
        d.pin("C", &[(GROUND, [0.35, 0.0]), (rocker, [0.0, 0.0])]);
        d.drive = Drive::Angle {
            body: coupler,
            from: crank,
        };
        Mechanism::new(d).unwrap()
    };
    let all = [
        hung,
        four_bar([0.1, 0.4, 0.3, 0.35]),
        slider_crank([0.3, 1.0, 0.1]),
        coupled,
        from_behind,
        block_on_lever([0, 1, 2]),
        block_on_lever([2, 1, 0]),
    ];
    for m in all {
        let chain = &m.chain;
        for _ in 0..5 {
            let drive = random.between(-2.0, 2.0);
            let u: Vec<f64> = chain
                .lengths
                .iter()
                .map(|&length| {
                    if length {
                        0.0
                    } else {
                        random.between(-3.0, 3.0)
                    }
                })
                .collect();
            let pose = Pose::new(chain, drive, u.clone());
            let near: Vec<f64> = (1..chain.body_count())
                .map(|b| pose.angle(chain, b))
                .collect();
            let again = chain.unknowns_at(drive, &near);
            assert!(
                again.iter().zip(&u).all(|(a, b)| (a - b).abs() < 1e-14),
                "{again:?} {u:?}"
            );
        }
    }
}

/// Which linkages Newton's method is asked for, and which may turn freely.
#[test]
fn pins_alone_and_gears() {
    assert!(four_bar([0.1, 0.4, 0.3, 0.35]).chain.is_of_pins());
    assert!(double_butterfly().chain.is_of_pins());
    let slider = slider_crank([0.3, 1.0, 0.1]);
    assert!(!slider.chain.is_of_pins() && slider.chain.turns_freely());
    let near = placed(&slider, &slider.assembly_modes(0.7).states[0]);
    let way = slider.nearest_by_newton(0.7, &near, 0.1);
    assert!(matches!(way, Way::Unknown));
    // A slot beside a loop of pins: neither entries nor closures alone tell.
    let mut d = four_bar([0.1, 0.4, 0.3, 0.35]).description().clone();
    let lever = d.body("lever");
    d.pin("L", &[(GROUND, [-0.5, 0.0]), (lever, [0.0, 0.0])]);
    d.joint("slot", slot((1, [0.1, 0.0]), (lever, [0.0, 0.0]), 0.0));
    let with_slot = Mechanism::new(d.clone()).unwrap();
    assert!(!with_slot.chain.is_of_pins() && with_slot.chain.turns_freely());
    let wheel = d.body("wheel");
    d.pin("W", &[(GROUND, [-1.0, 0.0]), (wheel, [0.0, 0.0])]);
    d.joint("mesh", gears([1, wheel], GROUND, -0.5, 0.0));
    assert!(!Mechanism::new(d).unwrap().chain.turns_freely());
}

/// The state's own error counts: within reach only if certainly so, out of it only if certainly so.
#[test]
fn at_the_edge_of_reach_it_cannot_be_told() {
    let m = four_bar([0.1, 0.4, 0.3, 0.35]);
    let state = &m.assembly_modes(1.0).states[0];
    let mut near = placed(&m, state);
    near[1] += 0.05;
    let d = off(&m, state, &near);
    let way = |reach: f64| m.nearest_by_newton(1.0, &near, reach);
    assert!(matches!(way(d * (1.0 + 1e-9)), Way::Found(_)));
    assert!(matches!(way(d * (1.0 - 1e-9)), Way::None));
    assert!(matches!(way(d), Way::Unknown));
}

/// No mode is taken for nearest where there may be others.
#[test]
fn modes_near_merging_are_not_decided() {
    // The pin is within rounding of where coupler and rocker are stretched.
    let m = four_bar([0.25, 0.5, 0.25, 1.0]);
    let near = [0.0, 0.0, PI + 1e-3];
    let modes = m.assembly_modes(0.0);
    assert!(modes.near_singular);
    let told = m.nearest(0.0, &angles(&near), Angle::from_rad(1.0));
    assert_eq!(told.unwrap_err(), NearestError::CannotTell);
}

/// A block on the crank's pin that slides along a lever, turned by 0.25 rad against it; bodies in
/// this order.
fn block_on_lever(order: [usize; 3]) -> Mechanism {
    let mut d = Description::new();
    let mut bodies = [0; 3];
    for k in order {
        bodies[k] = d.body(["block", "crank", "lever"][k]);
    }
    let [block, crank, lever] = bodies;
    d.pin("O", &[(GROUND, [0.0, 0.0]), (crank, [0.0, 0.0])]);
    d.pin("A", &[(crank, [0.2, 0.0]), (block, [0.0, 0.0])]);
    d.pin("B", &[(GROUND, [-0.5, 0.0]), (lever, [0.0, 0.0])]);
    d.joint(
        "slide",
        slide((block, [0.0, 0.0]), (lever, [0.0, 0.0]), 0.0),
    );
    d.drive = Drive::Angle {
        body: crank,
        from: GROUND,
    };
    Mechanism::new(d).unwrap()
}

/// Whole turns of bodies that hang on slides, the first body among them.
#[test]
fn whole_turns_beside_slides() {
    for order in [[0, 1, 2], [2, 1, 0], [1, 0, 2]] {
        let m = block_on_lever(order);
        for state in &m.assembly_modes(0.7).states {
            let exact = placed(&m, state);
            let crank = order.iter().position(|k| *k == 1).unwrap();
            for turns in [-2.0, 1.0, 3.0] {
                let mut near = exact.clone();
                for (k, x) in near.iter_mut().enumerate().filter(|(k, _)| *k != crank) {
                    *x += turns * TAU + 0.01 * k as f64;
                }
                let found = m
                    .nearest(0.7, &angles(&near), Angle::from_rad(0.1))
                    .unwrap();
                assert!(off(&m, &found, &near) < 0.03, "{order:?} {turns}");
            }
        }
    }
}

/// A rod that comes first, with an angle of its own beside a slide.
#[test]
fn whole_turns_of_the_first_body() {
    let mut d = Description::new();
    let [rod, crank, slider] = ["rod", "crank", "slider"].map(|n| d.body(n));
    d.pin("O", &[(GROUND, [0.0, 0.0]), (crank, [0.0, 0.0])]);
    d.pin("A", &[(crank, [0.3, 0.0]), (rod, [0.0, 0.0])]);
    d.pin("B", &[(rod, [1.0, 0.0]), (slider, [0.0, 0.0])]);
    d.joint(
        "guide",
        slide((slider, [0.0, 0.0]), (GROUND, [0.0, 0.1]), 0.0),
    );
    d.drive = Drive::Angle {
        body: crank,
        from: GROUND,
    };
    let m = Mechanism::new(d).unwrap();
    let mut near = placed(&m, &m.assembly_modes(0.7).states[0]);
    near[0] += 2.0 * TAU + 0.02;
    let found = m
        .nearest(0.7, &angles(&near), Angle::from_rad(0.1))
        .unwrap();
    assert!(off(&m, &found, &near) < 0.03);
}

/// A crank alone is where the drive puts it.
#[test]
fn a_driver_is_its_own_nearest_position() {
    let m = driver();
    let near = |x: f64| m.nearest(0.3, &angles(&[x]), Angle::from_rad(0.1));
    assert_eq!(placed(&m, &near(0.35).unwrap()), [0.3]);
    assert!(matches!(near(0.5), Err(NearestError::NoneWithin { .. })));
}
