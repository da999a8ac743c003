//! Mechanisms that several tests use, and what holds for all of them.

pub(super) use crate::arithmetic::tests::Random;

use super::*;
use crate::class_iii::{ClassIii, Geometry};
use crate::dyad::{Assembly, FourBar, SliderCrank};
use crate::units::{Angle, Length};

/// A crank that is driven, and nothing else.
pub(super) fn driver() -> Mechanism {
    let mut m = Description::new();
    let crank = m.body("crank");
    m.pin("O", &[(GROUND, [0.2, 0.1]), (crank, [0.3, 0.0])]);
    m.drive = Drive::Angle {
        body: crank,
        from: GROUND,
    };
    Mechanism::new(m).unwrap()
}

pub(super) fn four_bar([a, b, c, d]: [f64; 4]) -> Mechanism {
    let mut m = Description::new();
    let [crank, coupler, rocker] = ["crank", "coupler", "rocker"].map(|n| m.body(n));
    m.pin("O", &[(GROUND, [0.0, 0.0]), (crank, [0.0, 0.0])]);
    m.pin("A", &[(crank, [a, 0.0]), (coupler, [0.0, 0.0])]);
    m.pin("B", &[(coupler, [b, 0.0]), (rocker, [c, 0.0])]);
    m.pin("C", &[(GROUND, [d, 0.0]), (rocker, [0.0, 0.0])]);
    m.drive = Drive::Angle {
        body: crank,
        from: GROUND,
    };
    Mechanism::new(m).unwrap()
}

/// Crank, rod, offset; the guide along x.
pub(super) fn slider_crank([a, b, e]: [f64; 3]) -> Mechanism {
    let mut m = Description::new();
    let [crank, rod, slider] = ["crank", "rod", "slider"].map(|n| m.body(n));
    m.pin("O", &[(GROUND, [0.0, 0.0]), (crank, [0.0, 0.0])]);
    m.pin("A", &[(crank, [a, 0.0]), (rod, [0.0, 0.0])]);
    m.pin("B", &[(rod, [b, 0.0]), (slider, [0.0, 0.0])]);
    m.joint(
        "guide",
        slide((slider, [0.0, 0.0]), (GROUND, [0.0, e]), 0.0),
    );
    m.drive = Drive::Angle {
        body: crank,
        from: GROUND,
    };
    Mechanism::new(m).unwrap()
}

/// A slider at 0.25 rad against its guide's body.
pub(super) fn slide(slider: (usize, [f64; 2]), on: (usize, [f64; 2]), direction: f64) -> Joint {
    Joint::Slide {
        slider: Point::from_m(slider.0, slider.1),
        guide: guide(on, direction),
        turn: Angle::from_rad(0.25),
    }
}

pub(super) fn slot(pin: (usize, [f64; 2]), on: (usize, [f64; 2]), direction: f64) -> Joint {
    Joint::Slot {
        pin: Point::from_m(pin.0, pin.1),
        slot: guide(on, direction),
    }
}

pub(super) fn gears(wheels: [usize; 2], carrier: usize, ratio: f64, phase: f64) -> Joint {
    Joint::Gears {
        wheels,
        carrier,
        ratio,
        phase: Angle::from_rad(phase),
    }
}

pub(super) fn rack(wheel: usize, slide: usize, [radius, phase]: [f64; 2]) -> Joint {
    Joint::Rack {
        wheel,
        slide,
        radius: Length::from_m(radius),
        phase: Length::from_m(phase),
    }
}

pub(super) fn guide(on: (usize, [f64; 2]), direction: f64) -> Guide {
    Guide {
        origin: Point::from_m(on.0, on.1),
        direction: Angle::from_rad(direction),
    }
}

/// The linkage of [`crate::class_iii`] as a mechanism; link k is body k.
pub(super) fn class_iii(v: &[f64; 11]) -> Mechanism {
    let [l1, l2, l3, l4, l5, lb, phi_b, x3, y3, x5, y5] = *v;
    let mut m = Description::new();
    for k in 1..=5 {
        m.body(format!("link {k}"));
    }
    m.pin("O1", &[(0, [0.0, 0.0]), (1, [0.0, 0.0])]);
    m.pin("O3", &[(0, [x3, y3]), (3, [0.0, 0.0])]);
    m.pin("O5", &[(0, [x5, y5]), (5, [0.0, 0.0])]);
    m.pin("A", &[(1, [l1, 0.0]), (2, [0.0, 0.0])]);
    let b = [lb * phi_b.cos(), lb * phi_b.sin()];
    m.pin("B", &[(2, [l2, 0.0]), (4, b)]);
    m.pin("C", &[(3, [l3, 0.0]), (4, [0.0, 0.0])]);
    m.pin("D", &[(5, [l5, 0.0]), (4, [l4, 0.0])]);
    m.drive = Drive::Angle {
        body: 1,
        from: GROUND,
    };
    Mechanism::new(m).unwrap()
}

pub(super) const SAND_SCREEN: [f64; 11] = [
    0.10,
    1.04,
    0.60,
    0.64,
    0.485,
    0.22,
    -0.685_914_396_033_981_6,
    0.75,
    0.93,
    1.285,
    1.035,
];

/// PMKSWeb's double butterfly driven by the ternary link ACD about A (coordinates in metres here).
pub(super) fn double_butterfly() -> Mechanism {
    let at = |name: char| match name {
        'A' => [0.0, 0.0],
        'B' => [6.17, 0.0],
        'C' => [-0.21, 1.94],
        'D' => [1.4, 0.48],
        'E' => [2.69, 3.37],
        'F' => [5.84, 3.17],
        'G' => [5.37, 1.82],
        'H' => [3.63, 1.03],
        'I' => [4.67, -1.09],
        _ => [4.13, 2.05],
    };
    drawn(&["ACD", "CE", "EFG", "BFJ", "DHI", "GH", "IJ"], &["AB"], at)
}

/// Bodies as the drawing has them: each name is a set of its points, ground points in `fixed`; the
/// first body is driven.
pub(super) fn drawn(bodies: &[&str], fixed: &[&str], at: impl Fn(char) -> [f64; 2]) -> Mechanism {
    let mut m = Description::new();
    let mut on: Vec<(usize, &str)> = fixed.iter().map(|f| (GROUND, *f)).collect();
    on.extend(bodies.iter().map(|b| (m.body(*b), *b)));
    let mut points: Vec<char> = on.iter().flat_map(|b| b.1.chars()).collect();
    points.sort_unstable();
    points.dedup();
    for p in points {
        let all: Vec<(usize, [f64; 2])> = on
            .iter()
            .filter(|b| b.1.contains(p))
            .map(|b| (b.0, at(p)))
            .collect();
        if all.len() > 1 {
            m.pin(p.to_string(), &all);
        }
    }
    m.drive = Drive::Angle {
        body: 1,
        from: GROUND,
    };
    Mechanism::new(m).unwrap()
}

/// The smallest difference of angles.
pub(super) fn turn(a: f64, b: f64) -> f64 {
    let d = a - b;
    (d - (d / std::f64::consts::TAU).round() * std::f64::consts::TAU).abs()
}

#[test]
fn a_four_bar_is_that_of_the_dyads() {
    let mut random = Random(1);
    let m = Length::from_m;
    for _ in 0..300 {
        let [a, b, c, d] = std::array::from_fn(|_| random.between(0.2, 1.5));
        let phi = random.between(-3.0, 3.0);
        let Ok(special) = FourBar::new(m(a), m(b), m(c), m(d)) else {
            continue;
        };
        let general = four_bar([a, b, c, d]);
        let modes = general.assembly_modes(phi);
        let mut due = 0;
        for assembly in [Assembly::Positive, Assembly::Negative] {
            let Ok(s) = special.position(Angle::from_rad(phi), assembly) else {
                continue;
            };
            due += 1;
            let near = modes.states.iter().min_by(|x, y| {
                let apart = |s: &State, f: f64| turn(general.body_angle(s, 3).angle.rad(), f);
                let f = s.rocker.angle.rad();
                apart(x, f).total_cmp(&apart(y, f))
            });
            let state = near.unwrap();
            // The effect of rounding grows as the sides meet at a small angle.
            let bad = 1e-14 / s.transmission.rad().sin().powi(2);
            for (body, link) in [(2, s.coupler), (3, s.rocker)] {
                let g = general.body_angle(state, body);
                assert!(turn(g.angle.rad(), link.angle.rad()) < bad);
                assert!((g.first - link.first).abs() < 10.0 * bad * (1.0 + link.first.abs()));
                let size = 1.0 + link.second.abs();
                assert!(
                    (g.second - link.second).abs() < 100.0 * bad * size,
                    "{g:?} {link:?}"
                );
            }
            let gamma = general.transmission(state, 1).unwrap();
            assert!((gamma.rad() - s.transmission.rad()).abs() < bad);
        }
        assert_eq!(modes.states.len(), due);
        assert!(modes.complete);
    }
}

#[test]
fn a_slider_crank_is_that_of_the_dyads() {
    let mut random = Random(2);
    let m = Length::from_m;
    for _ in 0..300 {
        let [a, b] = std::array::from_fn(|_| random.between(0.2, 1.5));
        let e = random.between(-0.4, 0.4);
        let phi = random.between(-3.0, 3.0);
        let Ok(special) = SliderCrank::new(m(a), m(b), m(e), Angle::from_rad(0.0)) else {
            continue;
        };
        let general = slider_crank([a, b, e]);
        let modes = general.assembly_modes(phi);
        let mut due = 0;
        for assembly in [Assembly::Positive, Assembly::Negative] {
            let Ok(s) = special.position(Angle::from_rad(phi), assembly) else {
                continue;
            };
            due += 1;
            let travel = |x: &State| general.joint_displacement(x, 3).unwrap();
            let apart = |x: &&State| (travel(x).s_m - s.slider_m).abs();
            let state = modes
                .states
                .iter()
                .min_by(|x, y| apart(x).total_cmp(&apart(y)));
            let t = travel(state.unwrap());
            assert!((t.s_m - s.slider_m).abs() < 1e-12, "{t:?} {}", s.slider_m);
        }
        assert_eq!((modes.states.len(), modes.complete), (due, true));
    }
}

#[test]
fn a_class_iii_linkage_is_that_of_its_solver() {
    let mut random = Random(3);
    for round in 0..100 {
        let mut v: [f64; 11] = std::array::from_fn(|_| random.between(0.3, 1.5));
        if round == 0 {
            v = SAND_SCREEN;
        }
        let phi = random.between(-3.0, 3.0);
        let special = ClassIii::new(Geometry::from_values(&v)).unwrap();
        let general = class_iii(&v);
        let groups = &general.structure().groups;
        assert_eq!(groups[1].kind, GroupKind::Assur { class: 3 });
        assert_eq!(
            (groups[1].order, &groups[1].bodies[..]),
            (3, &[2, 3, 4, 5][..])
        );
        let found = special.assembly_modes(Angle::from_rad(phi));
        let modes = general.assembly_modes(phi);
        assert_eq!(found.modes.len(), modes.states.len());
        for mode in &found.modes {
            let due = special.state(Angle::from_rad(phi), *mode).unwrap();
            let angles = mode.to_array();
            let apart = |s: &&State| -> f64 {
                let of = |k: usize| turn(general.body_angle(s, k + 2).angle.rad(), angles[k]);
                (0..4).map(of).fold(0.0, f64::max)
            };
            let state = modes
                .states
                .iter()
                .min_by(|x, y| apart(x).total_cmp(&apart(y)))
                .unwrap();
            let bad = 1e-15 * due.condition;
            assert!(apart(&state) < bad, "{} {}", apart(&state), due.condition);
            for k in 0..4 {
                let g = general.body_angle(state, k + 2);
                let (w, x) = (due.rates.first[k], due.rates.second[k]);
                let size = due.condition * bad;
                assert!((g.first - w).abs() <= size, "{} {w} {size}", g.first);
                assert!(
                    (g.second - x).abs() <= size * due.condition,
                    "{} {x}",
                    g.second
                );
            }
        }
    }
}

/// The homotopy against the polynomial of degree 6.
#[test]
fn the_homotopy_finds_the_modes_of_triads() {
    let mut random = Random(4);
    for _ in 0..40 {
        let v: [f64; 11] = std::array::from_fn(|_| random.between(0.3, 1.5));
        let phi = random.between(-3.0, 3.0);
        let mut general = class_iii(&v);
        let due = general.assembly_modes(phi);
        general.triads.fill(None);
        let found = general.assembly_modes(phi);
        assert!(found.complete);
        assert_eq!(found.states.len(), due.states.len(), "{v:?} at {phi}");
        for (a, b) in found.states.iter().zip(&due.states) {
            let apart = a.pose.u.iter().zip(&b.pose.u).map(|(x, y)| turn(*x, *y));
            assert!(apart.fold(0.0, f64::max) < 1e-9);
        }
    }
}

#[test]
fn the_double_butterfly_is_one_group() {
    let m = double_butterfly();
    let groups = &m.structure().groups;
    assert_eq!(groups.len(), 2);
    assert_eq!(groups[1].bodies, [2, 3, 4, 5, 6, 7]);
    let modes = m.assembly_modes(0.0);
    assert!(modes.complete);
    // The drawing is one of them.
    let drawing = |s: &&State| (2..=7).all(|b| turn(m.body_angle(s, b).angle.rad(), 0.0) < 1e-9);
    assert_eq!(modes.states.iter().filter(drawing).count(), 1);
    assert_eq!(modes.states.len() % 2, 0);
    for s in &modes.states {
        assert!(m.gap(s) < 1e-14, "{}", m.gap(s));
    }
    println!("{} modes", modes.states.len());
}
