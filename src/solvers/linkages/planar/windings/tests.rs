use super::super::tests::{gears, rack, slide, turn};
use super::super::{Drive, GROUND, Mechanism, State};
use super::*;

/// A crank and a rocker that both turn fully, bodies 1 to 3, on pins at 0 and 0.1 m.
fn double_crank() -> Description {
    let mut d = Description::new();
    let [crank, coupler, rocker] = ["crank", "coupler", "rocker"].map(|n| d.body(n));
    d.pin("A", &[(GROUND, [0.0, 0.0]), (crank, [0.0, 0.0])]);
    d.pin("B", &[(crank, [0.5, 0.0]), (coupler, [0.0, 0.0])]);
    d.pin("C", &[(coupler, [0.4, 0.0]), (rocker, [0.5, 0.0])]);
    d.pin("D", &[(GROUND, [0.1, 0.0]), (rocker, [0.0, 0.0])]);
    d
}

/// A wheel on a pin of the ground, geared to another.
fn wheel(d: &mut Description, name: &str, at: f64, to: usize, ratio: f64) -> usize {
    let wheel = d.body(name);
    d.pin(name, &[(GROUND, [at, 0.0]), (wheel, [0.0, 0.0])]);
    d.joint(
        format!("{name}-gears"),
        gears([to, wheel], GROUND, ratio, 0.0),
    );
    wheel
}

fn is_among(m: &Mechanism, state: &State, all: &[State]) -> bool {
    let bodies = 1..m.description().bodies.len();
    let same = |s: &State| {
        let apart = |b| {
            let [a, b] = [state, s].map(|s| m.body_angle(s, b).angle.rad());
            turn(a, b)
        };
        bodies.clone().all(|b| apart(b) < 1e-9)
    };
    all.iter().any(same)
}

/// Four-bar, wheel by the half turn, and a link from the wheel to a slider: two positions each, and
/// two of the wheel. After a turn of the crank the wheel has made half of one.
#[test]
fn a_geared_dyad_has_eight_modes_and_its_branch_is_one_of_them() {
    let mut d = double_crank();
    let geared = wheel(&mut d, "wheel", 1.5, 3, -0.5);
    let [link, out] = ["link", "out"].map(|n| d.body(n));
    d.pin("M", &[(geared, [0.1, 0.0]), (link, [0.0, 0.0])]);
    d.pin("F", &[(link, [0.7, 0.0]), (out, [0.0, 0.0])]);
    d.joint("guide", slide((out, [0.0, 0.0]), (GROUND, [1.5, 0.0]), 0.0));
    let m = Mechanism::new(d).unwrap();
    let modes = m.assembly_modes(0.0);
    assert!(modes.complete && !modes.near_singular);
    assert_eq!(modes.states.len(), 8);
    for (k, state) in modes.states.iter().enumerate() {
        assert!(m.gap(state) < 1e-12);
        assert!(
            !is_among(&m, state, &modes.states[..k]),
            "{k} is there before"
        );
        let after = m.follow(state, TAU).unwrap();
        let [before, now] = [state, &after].map(|s| m.body_angle(s, geared).angle.rad());
        assert!(((now - before).abs() - 0.5 * TAU).abs() < 1e-9);
        assert!(
            is_among(&m, &after, &m.assembly_modes(TAU).states),
            "{k} is lost"
        );
        assert!(
            is_among(&m, &after, &modes.states),
            "{k} comes to none of the start"
        );
    }
    // The branches of all modes over a turn are the modes found afresh.
    let map = m.trace_branches(&[0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, TAU]);
    assert_eq!((map.branches, map.unmatched, map.complete), (8, 0, true));
}

/// The turns after which all wheels of a train are back are the least common multiple of those of
/// each.
#[test]
fn a_train_has_as_many_windings_as_turns_until_it_is_back() {
    for (ratios, due) in [
        (&[-0.5][..], 2),
        (&[-2.0], 1),
        (&[-2.0 / 3.0], 3),
        (&[17.0 / 53.0], 53),
        // One after the other, so that the last turns by 1/6.
        (&[-0.5, -1.0 / 3.0], 6),
        (&[-1.5, 4.0 / 3.0], 2),
    ] {
        let mut d = double_crank();
        let mut last = 3;
        for (k, ratio) in ratios.iter().enumerate() {
            last = wheel(&mut d, &format!("wheel-{k}"), 1.0 + k as f64, last, *ratio);
        }
        let m = Mechanism::new(d).unwrap();
        let modes = m.assembly_modes(0.3);
        assert!(modes.complete);
        assert_eq!(modes.states.len(), 2 * due, "{ratios:?}");
        for (k, state) in modes.states.iter().enumerate() {
            assert!(m.gap(state) < 1e-12);
            assert!(!is_among(&m, state, &modes.states[..k]));
        }
        // Turn by turn a branch passes through all of its windings.
        let mut here = modes.states[0].clone();
        let mut passed: Vec<State> = Vec::new();
        for turns in 1..=due {
            here = m.follow(&here, 0.3 + TAU * turns as f64).unwrap();
            assert!(is_among(&m, &here, &modes.states));
            assert!(!is_among(&m, &here, &passed), "{ratios:?} {turns}");
            passed.push(here.clone());
        }
        assert!(is_among(&m, &here, &modes.states[..1]));
    }
}

/// A wheel that the drive turns has the one angle that the drive gives it.
#[test]
fn the_drive_counts_its_own_turns() {
    let mut d = double_crank();
    let geared = wheel(&mut d, "wheel", 1.5, 1, -0.5);
    let m = Mechanism::new(d).unwrap();
    for drive in [0.3, 0.3 + TAU] {
        let modes = m.assembly_modes(drive);
        assert_eq!((modes.states.len(), modes.complete), (2, true));
        for state in &modes.states {
            let angle = m.body_angle(state, geared).angle.rad();
            assert!(turn(angle, -0.5 * drive) < 1e-12);
        }
    }
}

/// A ratio that is no fraction never brings the wheel back.
#[test]
fn windings_without_an_end_are_not_complete() {
    let mut d = double_crank();
    wheel(&mut d, "wheel", 1.5, 3, -std::f64::consts::FRAC_1_SQRT_2);
    let modes = Mechanism::new(d).unwrap().assembly_modes(0.3);
    assert_eq!((modes.states.len(), modes.complete), (2, false));
}

/// Two wheels on arms that turn freely: a turn of both is a turn of neither.
#[test]
fn a_position_is_counted_once_whatever_turns_lead_to_it() {
    // Another double crank from the same crank; its rocker carries the wheel that the first rocker
    // drives.
    let mut d = double_crank();
    let [coupler, arm] = ["second coupler", "arm"].map(|n| d.body(n));
    d.pin("E", &[(1, [0.0, 0.5]), (coupler, [0.0, 0.0])]);
    d.pin("F", &[(coupler, [0.4, 0.0]), (arm, [0.5, 0.0])]);
    d.pin("G", &[(GROUND, [0.1, 0.0]), (arm, [0.0, 0.0])]);
    let wheel = d.body("wheel");
    d.pin("H", &[(arm, [0.3, 0.0]), (wheel, [0.0, 0.0])]);
    d.joint("mesh", gears([3, wheel], arm, -0.5, 0.0));
    let m = Mechanism::new(d).unwrap();
    assert!(m.windings.overlap());
    let modes = m.assembly_modes(0.2);
    // Two of each double crank, and a half turn of the wheel.
    assert_eq!((modes.states.len(), modes.complete), (8, true));
    for (k, state) in modes.states.iter().enumerate() {
        assert!(m.gap(state) < 1e-12);
        assert!(!is_among(&m, state, &modes.states[..k]));
    }
}

/// A rack that the rocker moves by 0.05 m a radian, from whose slider two links lead to a pivot of
/// the ground: each turn that leaves the pivot in reach of them gives two positions. Without the
/// links there is no end.
#[test]
fn a_rack_has_the_windings_within_its_reach() {
    let radius = 0.05;
    let rack = |links: bool| {
        let mut d = double_crank();
        let bar = d.body("bar");
        let guide = d.joint("guide", slide((bar, [0.0, 0.0]), (GROUND, [0.0, 2.0]), 0.0));
        d.joint("rack", rack(3, guide, [radius, 0.1]));
        if links {
            let [first, second] = ["first", "second"].map(|n| d.body(n));
            d.pin("P", &[(bar, [0.0, 0.0]), (first, [0.0, 0.0])]);
            d.pin("Q", &[(first, [0.6, 0.0]), (second, [0.0, 0.0])]);
            d.pin("R", &[(GROUND, [0.2, 2.1]), (second, [0.7, 0.0])]);
        }
        (Mechanism::new(d).unwrap(), guide)
    };
    let (m, guide) = rack(true);
    for drive in [0.3, 2.0, 7.0] {
        let modes = m.assembly_modes(drive);
        assert!(modes.complete);
        let mut due = 0;
        for rocker in double_crank_rockers(drive) {
            for turns in -40..=40 {
                let s = radius * (rocker + TAU * f64::from(turns)) + 0.1;
                let span = (s - 0.2f64).hypot(0.1);
                due += if (0.1..1.3).contains(&span) { 2 } else { 0 };
            }
        }
        assert!(due > 8);
        assert_eq!(modes.states.len(), due);
        for state in &modes.states {
            assert!(m.gap(state) < 1e-12);
            let s = m.joint_displacement(state, guide).unwrap().s_m;
            let rocker = m.body_angle(state, 3).angle.rad();
            assert!((s - radius * rocker - 0.1).abs() < 1e-12);
        }
    }
    let (free, _) = rack(false);
    let modes = free.assembly_modes(0.3);
    assert_eq!((modes.states.len(), modes.complete), (2, false));
}

/// Angles of the double crank's rocker by the law of cosines.
fn double_crank_rockers(phi: f64) -> [f64; 2] {
    let (x, y) = (0.5 * phi.cos() - 0.1, 0.5 * phi.sin());
    let span = x.hypot(y);
    let off = ((0.25 + span * span - 0.16) / span).acos();
    [1.0, -1.0].map(|side| y.atan2(x) + side * off)
}

#[test]
fn ratios_are_the_simplest_fractions_that_round_to_them() {
    for (p, q) in [(1, 2), (-17, 53), (355, 113), (3, 1), (-1, 999_983), (0, 1)] {
        let found = Fraction::of(f64::from(p) / f64::from(q)).unwrap();
        assert_eq!((found.over, found.under), (p.into(), q.into()));
    }
    assert_eq!(Fraction::of(std::f64::consts::SQRT_2), None);
    assert_eq!(Fraction::of(f64::NAN), None);
}

/// A drive by displacement winds the wheel that its rack turns.
#[test]
fn a_driven_rack_gives_its_wheel_one_angle() {
    let mut d = Description::new();
    let [pinion, bar] = ["pinion", "bar"].map(|n| d.body(n));
    d.pin("W", &[(GROUND, [0.0, 0.0]), (pinion, [0.0, 0.0])]);
    let guide = d.joint("guide", slide((bar, [0.0, 0.0]), (GROUND, [0.0, 0.5]), 0.0));
    d.joint("rack", rack(pinion, guide, [0.4, 0.0]));
    wheel(&mut d, "second", 1.0, pinion, -0.5);
    d.drive = Drive::Displacement { joint: guide };
    let modes = Mechanism::new(d).unwrap().assembly_modes(0.9);
    assert_eq!((modes.states.len(), modes.complete), (1, true));
}
