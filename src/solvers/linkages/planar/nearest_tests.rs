//! The nearest position, by Newton's method and among all modes.

use super::super::tests::*;
use super::super::*;
use super::*;
use crate::units::Angle;
use num_complex::Complex64;
use std::f64::consts::{PI, TAU};

fn angles(all: &[f64]) -> Vec<Angle> {
    all.iter().map(|&x| Angle::from_rad(x)).collect()
}

fn placed(m: &Mechanism, state: &State) -> Vec<f64> {
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

fn off(m: &Mechanism, state: &State, near: &[f64]) -> f64 {
    let pairs = placed(m, state).into_iter().zip(near);
    pairs.fold(0.0, |d: f64, (x, g)| d.max((x - g).abs()))
}

fn some_linkages(random: &mut Random) -> Vec<Mechanism> {
    let mut all = vec![double_butterfly(), class_iii(&SAND_SCREEN)];
    for _ in 0..30 {
        all.push(class_iii(&std::array::from_fn(|_| random.within(0.3, 1.5))));
        all.push(four_bar(std::array::from_fn(|_| random.within(0.2, 1.5))));
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
            let phi = random.within(-3.0, 3.0);
            let states = m.assembly_modes(phi).states;
            let size = [0.03, 0.3, 1.0, PI][round % 4];
            let mut near = match states.len() {
                0 => vec![0.0; m.description().bodies.len() - 1],
                n => placed(&m, &states[round % n]),
            };
            near[1..]
                .iter_mut()
                .for_each(|x| *x += random.within(-size, size));
            near[0] = phi;
            let reach = random.within(0.0, 2.0 * size);
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
        let phi = random.within(-3.0, 3.0);
        let modes = m.assembly_modes(phi);
        for s in modes.states {
            let exact = placed(&m, &s);
            let mut near = exact.clone();
            near[1..]
                .iter_mut()
                .for_each(|x| *x += random.within(-1e-3, 1e-3));
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

/// A dyad whose two modes are 2t apart, from between them. The estimate is nearly sharp: from the share s of the way to
/// one of them it gives about (1 − s)/(1 + s).
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
    let wheels = Joint::Gears {
        wheels: [a, b],
        carrier: GROUND,
        ratio: -0.5,
        phase: Angle::from_rad(0.0),
    };
    d.joint("mesh", wheels);
    let m = Mechanism::new(d).unwrap();
    let near = angles(&[1.0, -0.5]);
    let told = m.nearest(1.0, &near, Angle::from_rad(0.1));
    assert_eq!(told.unwrap_err(), NearestError::CannotTell);
}

/// A system of two pins with what the estimates make of it, by products of whole matrices.
#[test]
fn estimates_are_those_of_the_matrices() {
    let j: [[f64; 4]; 4] = [
        [0.9, 0.2, -0.1, 0.3],
        [0.1, 1.1, 0.2, -0.2],
        [-0.3, 0.1, 0.8, 0.4],
        [0.2, -0.1, 0.3, 1.2],
    ];
    let mut random = Random(31);
    let matrix = |of: &dyn Fn(usize, usize) -> f64| {
        let mut m = Matrix::new(4, 5);
        for (r, c) in (0..16).map(|k| (k / 4, k % 4)) {
            m[(r, c)] = of(r, c);
        }
        m
    };
    for off in [0.0, 0.02] {
        let other = std::array::from_fn::<f64, 16, _>(|_| random.within(-off, off));
        let at = matrix(&|r, c| j[r][c] + other[4 * r + c]);
        let mut factors = Factors::default();
        assert!(factors.of(&matrix(&|r, c| j[r][c]), 4, 0));
        let inverse: Vec<Vec<f64>> = (0..4)
            .map(|r| {
                let mut column = vec![0.0; 4];
                factors.solve(|k| f64::from(u8::from(k == r)), &mut column);
                column
            })
            .collect();
        let times = |i: usize, of: &dyn Fn(usize) -> f64| -> f64 {
            (0..4).map(|r| inverse[r][i] * of(r)).sum()
        };
        let turned = |r: usize, c: usize| match r % 2 {
            0 => -at[(r + 1, c)],
            _ => at[(r - 1, c)],
        };
        let residual = [0.3, -0.2, 0.5, 0.1];
        let most = |of: &dyn Fn(usize) -> f64| (0..4).map(of).fold(0.0, f64::max);
        for rounding in [0.0, 0.01] {
            let all = Estimate::new(&at, &factors, &residual, rounding);
            let size = |i: usize| (0..4).map(|r| inverse[r][i].abs()).sum::<f64>();
            let unit = |i: usize, c: usize| f64::from(u8::from(i == c));
            let defect = most(&|i| {
                let row = (0..4).map(|c| (unit(i, c) - times(i, &|r| at[(r, c)])).abs());
                row.sum::<f64>() + 4.0 * size(i) * rounding
            });
            let bend = most(&|i| {
                let row = (0..4).map(|c| times(i, &|r| turned(r, c)).abs());
                row.sum::<f64>() + 4.0 * size(i) * rounding
            });
            let correction = most(&|i| {
                let row = (0..4).map(|r| (inverse[r][i] * residual[r]).abs());
                row.sum::<f64>() + size(i) * rounding
            });
            for (x, due) in [
                (all.defect, defect),
                (all.bend, bend),
                (all.correction, correction),
            ] {
                assert!(
                    (x - due).abs() < 1e-14 * (1.0 + due),
                    "{off} {rounding}: {x} {due}"
                );
            }
            assert!(all.defect > 0.9 * off + 0.9 * rounding);
        }
    }
    let some = Estimate {
        defect: 0.125,
        bend: 3.0,
        correction: 7.0,
    };
    assert_eq!(some.norm(0.25, 0.5), 0.125 + 0.75 + 0.03125 + 0.5);
}

/// `‖I − A M‖` of columns turned and shortened as far as the estimate allows: never more than it, and nearly as much.
#[test]
fn turned_columns_are_within_the_estimate() {
    let mut random = Random(32);
    let mut closest = 0.0f64;
    for m in some_linkages(&mut random) {
        let phi = random.within(-3.0, 3.0);
        for state in m.assembly_modes(phi).states {
            let n = m.chain.unknowns;
            let (turn, short) = (random.within(0.0, 0.2), random.within(0.0, 0.01));
            let at = Estimate::new(&state.jacobian, &state.factors, &vec![0.0; n], 0.0);
            // Signs of the turns that add up in the row that bends most.
            for _ in 0..20 {
                let turns: Vec<(f64, f64)> = (0..n)
                    .map(|_| {
                        (
                            turn * random.within(-1.0, 1.0).signum(),
                            1.0 - short * random.next(),
                        )
                    })
                    .collect();
                let mut sums = vec![0.0; n];
                for (k, (turn, length)) in turns.into_iter().enumerate() {
                    let (s, c) = (turn.sin() * length, turn.cos() * length);
                    let right = |r: usize| {
                        let j = |r: usize| state.jacobian[(r, k)];
                        match r % 2 {
                            0 => c * j(r) - s * j(r + 1),
                            _ => c * j(r) + s * j(r - 1),
                        }
                    };
                    let mut column = vec![0.0; n];
                    state.factors.solve(right, &mut column);
                    for (i, (sum, x)) in sums.iter_mut().zip(column).enumerate() {
                        *sum += (x - f64::from(u8::from(i == k))).abs();
                    }
                }
                let norm = sums.into_iter().fold(0.0, f64::max);
                let bound = at.norm(turn, short);
                assert!(norm <= bound * (1.0 + 1e-12), "{norm} {bound}");
                closest = closest.max(norm / bound);
            }
        }
    }
    assert!(closest > 0.99, "{closest}");
}

/// Poses off a position by a known distance: the bound holds it and is at most five times as large; where the estimate
/// does not contract there is none.
#[test]
fn errors_of_positions_are_bounded() {
    let mut random = Random(33);
    let (mut bounded, mut none) = (0, 0);
    for m in some_linkages(&mut random) {
        let phi = random.within(-3.0, 3.0);
        for exact in m.assembly_modes(phi).states {
            let chain = &m.chain;
            let mut work = Work::new(chain);
            // Of the rounding alone.
            let least = chain.error_of(&exact, &mut work);
            let sizes = (0..30).map(|k| 0.02 * 1.1f64.powi(k));
            for size in [1e-12, 1e-9, 1e-6, 1e-4].into_iter().chain(sizes) {
                let by: Vec<f64> = (0..chain.unknowns)
                    .map(|_| random.within(-size, size))
                    .collect();
                let u = exact.pose.u.iter().zip(&by).map(|(u, d)| u + d).collect();
                let mut off = exact.clone();
                off.pose = Pose::new(chain, exact.pose.drive, u);
                if !off.update(chain, &mut work) {
                    continue;
                }
                let distance = by.iter().fold(0.0f64, |d, x| d.max(x.abs()));
                off.pose
                    .residual(chain, &chain.closures, &mut work.residual);
                let rounding = chain.rounding(&off.pose);
                let at = Estimate::new(&off.jacobian, &off.factors, &work.residual, rounding);
                let radius = 4.0 * at.correction;
                let norm = at.norm(radius, radius * radius / 6.0);
                match chain.error_of(&off, &mut Work::new(chain)) {
                    Some(bound) => {
                        bounded += 1;
                        assert!(norm <= 0.5 && distance <= bound + least.unwrap_or(0.0));
                        assert_eq!(bound, radius);
                    }
                    None => {
                        none += 1;
                        assert!(!(norm <= 0.5), "{norm}");
                    }
                }
            }
        }
    }
    println!("{bounded} bounded, {none} not");
    assert!(bounded > 300 && none > 50);
}

/// 16 u for each body and unit of length, the coordinates of joints among them.
#[test]
fn rounding_grows_with_bodies_and_extent() {
    let unit = 16.0 * f64::EPSILON;
    let m = four_bar([0.125, 0.5, 0.5, 0.5]);
    // In units of 0.5 m: the coupler's origin 0.25 off, the rocker's no farther than one.
    let pose = m.assembly_modes(0.0).states[0].pose.clone();
    let farthest = pose.p.iter().fold(0.0f64, |d, p| d.max(p.norm()));
    assert_eq!(farthest, 1.0);
    assert_eq!(m.chain.rounding(&pose), unit * 4.0 * 4.0);
    assert_eq!(m.chain.body_count(), 4);
}

/// A single pin: told open where its gap is more than its two arms close by turns within reach, and rounding.
#[test]
fn gaps_are_open_beyond_reach() {
    let m = four_bar([0.125, 0.5, 0.5, 0.75]);
    let chain = &m.chain;
    let mut work = Work::new(chain);
    let near = [0.0, 0.3, -0.4];
    let given = Pose::new(chain, 0.0, chain.unknowns_at(0.0, &near));
    let mut rows = Vec::new();
    given.residual(chain, &chain.closures, &mut rows);
    let gap = rows[0].hypot(rows[1]);
    let rounding = chain.rounding(&given);
    // Coupler and rocker, a unit each.
    let arms = 2.0 + 2.0 * rounding;
    for (share, open) in [
        (1.0 - 1.3e-9, true),
        (1.0 - 0.7e-9, false),
        (1.0 + 1e-9, false),
    ] {
        let reach = gap / arms * share;
        assert_eq!(
            chain.is_open(&given, &near, reach, &mut work),
            open,
            "{share}"
        );
    }
    // Without reach rounding alone decides.
    for (share, open) in [(1.9, false), (2.1, true)] {
        let exact = m.assembly_modes(0.0).states[0].clone();
        let mut pose = exact.pose.clone();
        let rounding = chain.rounding(&pose);
        let Closure::Pin { a, .. } = chain.closures[0] else {
            unreachable!()
        };
        pose.p[a.body] += Complex64::new(0.6, 0.8) * (share * rounding);
        pose.residual(chain, &chain.closures, &mut rows);
        let own = rows[0].hypot(rows[1]);
        assert!((own / rounding - share).abs() < 0.05, "{own}");
        let near = placed(&m, &exact);
        assert_eq!(chain.is_open(&pose, &near, 0.0, &mut work), open, "{share}");
    }
    // The crank's angle is the drive's.
    for (by, open) in [(0.05, false), (-0.05, false), (0.2, true), (-0.2, true)] {
        let exact = m.assembly_modes(0.0).states[0].clone();
        let mut near = placed(&m, &exact);
        near[0] += by;
        assert_eq!(chain.is_open(&exact.pose, &near, 0.1, &mut work), open);
    }
}

/// One of two loops that cannot be closed is enough.
#[test]
fn one_open_pin_is_enough() {
    let mut d = Description::new();
    let [crank, a, b, c, e] = ["crank", "a", "b", "c", "e"].map(|n| d.body(n));
    d.pin("O", &[(GROUND, [0.0, 0.0]), (crank, [0.0, 0.0])]);
    d.pin(
        "A",
        &[(crank, [0.1, 0.0]), (a, [0.0, 0.0]), (c, [0.0, 0.0])],
    );
    d.pin("B", &[(a, [0.4, 0.0]), (b, [0.3, 0.0])]);
    d.pin("C", &[(GROUND, [0.35, 0.0]), (b, [0.0, 0.0])]);
    d.pin("D", &[(c, [0.2, 0.0]), (e, [0.1, 0.0])]);
    d.pin("E", &[(GROUND, [0.9, 0.0]), (e, [0.0, 0.0])]);
    let m = Mechanism::new(d).unwrap();
    let first = four_bar([0.1, 0.4, 0.3, 0.35]);
    let closed = placed(&first, &first.assembly_modes(0.5).states[0]);
    let near = [&closed[..], &[0.0, 0.0]].concat();
    assert!(matches!(m.nearest_by_newton(0.5, &near, 0.1), Way::None));
    let told = m.nearest(0.5, &angles(&near), Angle::from_rad(0.1));
    assert_eq!(told.unwrap_err(), NearestError::NoneWithin { reach: 0.1 });
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
    let all = [
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
            let drive = random.within(-2.0, 2.0);
            let u: Vec<f64> = chain
                .lengths
                .iter()
                .map(|&length| {
                    if length {
                        0.0
                    } else {
                        random.within(-3.0, 3.0)
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
    d.joint(
        "slot",
        Joint::Slot {
            pin: Point::from_m(1, [0.1, 0.0]),
            slot: guide((lever, [0.0, 0.0]), 0.0),
        },
    );
    let with_slot = Mechanism::new(d.clone()).unwrap();
    assert!(!with_slot.chain.is_of_pins() && with_slot.chain.turns_freely());
    let wheel = d.body("wheel");
    d.pin("W", &[(GROUND, [-1.0, 0.0]), (wheel, [0.0, 0.0])]);
    d.joint(
        "mesh",
        Joint::Gears {
            wheels: [1, wheel],
            carrier: GROUND,
            ratio: -0.5,
            phase: Angle::from_rad(0.0),
        },
    );
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

/// A block on the crank's pin that slides along a lever, turned by 0.25 rad against it; bodies in this order.
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

/// Alone exactly where the norm at the middle, with half the distance, is below 0.95: on both sides of that.
#[test]
fn positions_are_alone_within_the_estimate() {
    let mut random = Random(35);
    let mut far = 0;
    for m in some_linkages(&mut random) {
        let phi = random.within(-3.0, 3.0);
        let chain = &m.chain;
        for found in m.assembly_modes(phi).states {
            let moved = found.pose.u.iter().map(|u| u + random.within(-0.05, 0.05));
            let given = Pose::new(chain, found.pose.drive, moved.collect());
            let middle = given
                .u
                .iter()
                .zip(&found.pose.u)
                .map(|(a, b)| 0.5 * (a + b));
            let middle = Pose::new(chain, given.drive, middle.collect());
            let (mut j, mut factors) = (Work::new(chain).jacobian, Factors::default());
            middle.jacobian(chain, 0..chain.closures.len(), &mut j);
            let blocks = chain.blocks.iter().map(|b| b.rows.clone());
            assert!(factors.of_blocks(&j, 0, blocks));
            let nothing = vec![0.0; chain.unknowns];
            let at = Estimate::new(&j, &factors, &nothing, chain.rounding(&middle));
            let norm = |d: f64| at.norm(0.5 * d, d * d / 6.0);
            let (mut low, mut high) = (0.0, 4.0);
            for _ in 0..60 {
                let half = 0.5 * (low + high);
                (low, high) = if norm(half) < 0.95 {
                    (half, high)
                } else {
                    (low, half)
                };
            }
            far += usize::from(low > 0.3);
            let alone = |d: f64| chain.is_alone(&given, &found.pose, d, &mut Work::new(chain));
            assert!(alone(0.999 * low) || low == 0.0);
            assert!(!alone(1.001 * low + 1e-12));
        }
    }
    assert!(far > 20, "{far}");
    // Coupler and rocker on one line at the middle: no inverse.
    let m = four_bar([0.1, 0.4, 0.3, 0.35]);
    let state = &m.assembly_modes(0.3).states[0];
    let folded = Pose::new(&m.chain, 0.3, vec![0.0; m.chain.unknowns]);
    assert!(
        !m.chain
            .is_alone(&folded, &folded, 0.0, &mut Work::new(&m.chain))
    );
    let alone = m
        .chain
        .is_alone(&state.pose, &state.pose, 0.0, &mut Work::new(&m.chain));
    assert!(alone);
}

/// The error counts twice beside the distance, that of the position found and that of the exact one, and once on either
/// side of the reach.
#[test]
fn errors_of_both_positions_count() {
    let m = four_bar([0.1, 0.4, 0.3, 0.35]);
    let chain = &m.chain;
    let state = &m.assembly_modes(1.0).states[0];
    let mut work = Work::new(chain);
    let (mut low, mut high) = (0.0, 4.0);
    for _ in 0..60 {
        let half = 0.5 * (low + high);
        (low, high) = match chain.is_alone(&state.pose, &state.pose, half, &mut work) {
            true => (half, high),
            false => (low, half),
        };
    }
    let mut told =
        |off: [f64; 2], reach| chain.told(&state.pose, state.clone(), off, reach, &mut work);
    let off = 0.5 * low;
    assert!(told([off, 0.249 * low], 4.0).is_some());
    assert!(told([off, 0.251 * low], 4.0).is_none());
    for (reach, way) in [
        (1.11, "found"),
        (1.09, "open"),
        (0.91, "open"),
        (0.89, "none"),
    ] {
        let found = told([off, 0.1 * off], reach * off).unwrap();
        let name = match found {
            Way::Found(_) => "found",
            Way::None => "none",
            Way::Unknown => "open",
        };
        assert_eq!(name, way, "{reach}");
    }
}
