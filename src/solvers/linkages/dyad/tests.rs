use super::*;
use crate::units::{Angle, Length};
use proptest::prelude::*;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_3, PI};

pub(super) fn bar(l: [f64; 4]) -> Result<FourBar, DyadError> {
    let [a, b, c, d] = l.map(Length::from_m);
    FourBar::new(a, b, c, d)
}

pub(super) fn slide(l: [f64; 3], delta: f64) -> Result<SliderCrank, DyadError> {
    let [a, b, e] = l.map(Length::from_m);
    SliderCrank::new(a, b, e, Angle::from_rad(delta))
}

fn rad(x: f64) -> Angle {
    Angle::from_rad(x)
}

pub(super) fn sides() -> [Assembly; 2] {
    [Assembly::Positive, Assembly::Negative]
}

fn close(a: f64, b: f64, tol: f64) {
    assert!((a - b).abs() <= tol, "{a} is not {b}");
}

#[test]
fn lengths_are_checked() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for i in 0..4 {
            let mut l = [2.0, 3.0, 4.0, 5.0];
            l[i] = bad;
            let e = bar(l).unwrap_err();
            let named = ["crank", "coupler", "rocker", "frame"][i];
            assert!(
                matches!(e, DyadError::NotFinite { what, .. } if what == named),
                "{e}"
            );
        }
        assert_eq!(
            slide([1.0, 2.0, bad], 0.0).unwrap_err().name(),
            "not finite"
        );
        assert_eq!(
            slide([1.0, 2.0, 0.0], bad).unwrap_err().name(),
            "not finite"
        );
        let good = bar([2.0, 3.0, 4.0, 5.0]).unwrap();
        let e = good.position(rad(bad), Assembly::Positive).unwrap_err();
        assert_eq!(e.name(), "not finite");
        let good = slide([1.0, 2.0, 0.5], 0.0).unwrap();
        let e = good.position(rad(bad), Assembly::Positive).unwrap_err();
        assert_eq!(e.name(), "not finite");
    }
    assert_eq!(
        bar([2.0, -3.0, 4.0, 5.0]).unwrap_err(),
        DyadError::NotPositive {
            what: "coupler",
            value_m: -3.0
        }
    );
    assert_eq!(
        slide([0.0, 2.0, 0.0], 0.0).unwrap_err().name(),
        "not positive"
    );
    assert_eq!(
        bar([1e-31, 1.0, 1.0, 1.0]).unwrap_err().name(),
        "length ratio"
    );
    assert!(bar([1e-30, 1.0, 1.0, 1.0]).is_ok());
    let e = bar([1.0, 2.0, 3.0, 6.0]).unwrap_err();
    assert_eq!(e.name(), "cannot close");
    assert_eq!(
        e.to_string(),
        "the frame of 6 m has to be shorter than the other lengths together, 6 m"
    );
    assert_eq!(
        slide([1.0, 2.0, -3.0], 0.0).unwrap_err().name(),
        "cannot close"
    );
}

#[test]
fn what_cannot_be_reached_is_named() {
    let swinging = bar([2.0, 8.0, 3.0, 6.0]).unwrap();
    for side in sides() {
        assert_eq!(
            swinging.position(rad(0.0), side).unwrap_err(),
            DyadError::Unreachable {
                span_m: 4.0,
                least_m: 5.0,
                most_m: 11.0
            }
        );
        let folded = bar([2.0, 7.0, 3.0, 6.0]).unwrap();
        let e = folded.position(rad(0.0), side).unwrap_err();
        assert_eq!(e.name(), "singular");
        assert!(e.to_string().contains("spans 4 m"), "{e}");
        // The crank's end on the rocker's pivot.
        let kite = bar([3.0, 5.0, 5.0, 3.0]).unwrap();
        assert_eq!(
            kite.position(rad(0.0), side).unwrap_err().name(),
            "singular"
        );
        let offset = slide([1.0, 5.0, 5.0], 0.25).unwrap();
        assert_eq!(
            offset.position(rad(0.25), side).unwrap_err().name(),
            "singular"
        );
        let offset = slide([1.0, 5.0, 5.5], 0.25).unwrap();
        assert_eq!(
            offset.position(rad(0.25), side).unwrap_err().name(),
            "unreachable"
        );
    }
}

#[test]
fn the_3_4_5_triangle() {
    let m = bar([1.0, 3.0, 4.0, 6.0])
        .unwrap()
        .position(rad(0.0), Assembly::Positive)
        .unwrap();
    close(m.pressure_angle().rad(), 0.0, 2e-16);
    close(m.determinant_m2, 12.0, 2e-15);
}

#[test]
fn a_parallelogram_copies_the_crank() {
    for l in [[2.0, 5.0, 2.0, 5.0], [5.0, 2.0, 5.0, 2.0]] {
        let bar = bar(l).unwrap();
        assert_eq!(bar.grashof_type(), GrashofType::ChangePoint);
        for k in 1..30 {
            let phi = 0.1 * f64::from(k);
            let m = bar.position(rad(phi), Assembly::Positive).unwrap();
            close(m.coupler.angle.rad(), 0.0, 1e-14);
            close(m.rocker.angle.rad(), phi, 1e-14);
            close(m.coupler.first, 0.0, 1e-13);
            close(m.rocker.first, 1.0, 1e-13);
            close(m.rocker.second, 0.0, 1e-12);
        }
    }
}

#[test]
fn the_angles_are_continuous_over_many_turns() {
    for (l, turns) in [([1.0, 4.0, 3.0, 3.5], 0.0), ([3.5, 4.0, 3.0, 1.0], 1.0)] {
        let bar = bar(l).unwrap();
        for side in sides() {
            let at = |phi: f64| {
                let m = bar.position(rad(phi), side).unwrap();
                (m.coupler.angle.rad(), m.rocker.angle.rad())
            };
            let mut old = at(-10.0);
            for k in 1..=2000 {
                let new = at(-10.0 + 0.01 * f64::from(k));
                assert!((new.0 - old.0).abs() < 0.1 && (new.1 - old.1).abs() < 0.1);
                old = new;
            }
            let (p, q) = (at(0.3), at(0.3 + 2.0 * PI));
            close(q.1 - p.1, turns * 2.0 * PI, 1e-13);
            close(q.0 - p.0, turns * 2.0 * PI, 1e-13);
        }
    }
}

#[test]
fn grashof_types() {
    use GrashofType::*;
    let kind = |l| bar(l).unwrap().grashof_type();
    assert_eq!(kind([1.0, 4.0, 3.0, 3.5]), CrankRocker);
    assert_eq!(kind([4.0, 1.0, 3.0, 3.5]), DoubleRocker);
    assert_eq!(kind([4.0, 3.0, 1.0, 3.5]), RockerCrank);
    assert_eq!(kind([4.0, 3.0, 3.5, 1.0]), DoubleCrank);
    assert_eq!(kind([2.0, 4.0, 3.0, 2.5]), TripleRocker);
    assert_eq!(kind([3.0, 5.0, 5.0, 3.0]), ChangePoint);
    // One unit in the last place decides.
    assert_eq!(kind([1.0, 4.0, 3.0, 2.0]), ChangePoint);
    assert_eq!(kind([1.0, 4.0f64.next_down(), 3.0, 2.0]), CrankRocker);
    assert_eq!(kind([1.0, 4.0f64.next_up(), 3.0, 2.0]), TripleRocker);
    // 0.1 + 0.6 and 0.3 + 0.4 as stored differ by less than their rounded sums show.
    assert_eq!(kind([0.1, 0.6, 0.3, 0.4]), CrankRocker);
}

#[test]
fn crank_ranges() {
    let range = |l| bar(l).unwrap().crank_range();
    assert_eq!(range([1.0, 4.0, 3.0, 3.5]), CrankRange::Full);
    assert_eq!(range([3.5, 4.0, 3.0, 1.0]), CrankRange::Full);
    // Equilateral at the limit: a = d = b + c.
    let CrankRange::Within { limit } = range([2.0, 1.0, 1.0, 2.0]) else {
        panic!("the crank is limited outwards only");
    };
    close(limit.rad(), FRAC_PI_3, 2e-16);
    // |b − c| = 5 spans a 3-4-5 triangle.
    let CrankRange::Beyond { limit } = range([3.0, 7.0, 2.0, 4.0]) else {
        panic!("the crank is limited inwards only");
    };
    close(limit.rad(), FRAC_PI_2, 2e-16);
    let CrankRange::Between { lower, upper } = range([3.0, 3.25, 1.75, 4.0]) else {
        panic!("the crank is limited on both sides");
    };
    close(upper.rad(), FRAC_PI_2, 2e-16);
    close(lower.rad(), ((25.0 - 2.25) / 24.0f64).acos(), 1e-15);
}

#[test]
fn the_rocker_stands_still_at_its_dead_positions() {
    let linkages = [
        [1.0, 4.0, 3.0, 3.5],
        [4.0, 3.0, 1.0, 3.5],
        [4.0, 1.0, 3.0, 3.5],
        [2.0, 4.0, 3.0, 2.5],
        [1.0, 2.0, 2.5, 3.0],
    ];
    let mut found = 0;
    for l in linkages {
        let bar = bar(l).unwrap();
        for side in sides() {
            let dead = bar.dead_positions(side);
            for p in [dead.extended, dead.folded].into_iter().flatten() {
                let m = bar.position(p.crank, side).unwrap();
                close(m.rocker.first, 0.0, 1e-13);
                let turn = (m.rocker.angle.rad() - p.rocker.rad()) / (2.0 * PI);
                close(turn, turn.round(), 1e-14);
                found += 1;
            }
        }
    }
    assert_eq!(found, 14);
    let swing = bar(linkages[0])
        .unwrap()
        .dead_positions(Assembly::Positive)
        .swing();
    let exact = ((9.0 + 12.25 - 25.0) / 21.0f64).acos() - ((9.0 + 12.25 - 9.0) / 21.0f64).acos();
    close(swing.unwrap().rad(), exact, 1e-15);
}

#[test]
fn a_central_slider_crank() {
    let l = slide([1.0, 4.0, 0.0], 0.0).unwrap();
    assert_eq!(l.stroke().unwrap().m(), 2.0);
    assert!(l.turns_fully() && l.crank_limits() == (None, None));
}

#[test]
fn the_slider_stands_still_at_its_dead_centres() {
    let mut found = 0;
    for l in [
        [1.0, 4.0, 0.5],
        [1.0, 4.0, -2.0],
        [3.0, 1.0, 0.5],
        [2.0, 2.5, 1.5],
        [1.0, 4.0, 0.0],
    ] {
        let linkage = slide(l, 0.0).unwrap();
        for side in sides() {
            let dead = linkage.dead_centres(side);
            for p in [Some(dead.extended), dead.folded].into_iter().flatten() {
                let m = linkage.position(p.crank_from_guide, side).unwrap();
                close(m.slider_first_m, 0.0, 1e-14);
                close(m.slider_m, p.slider.m(), 1e-14);
                found += 1;
            }
            if let (Some(stroke), Some(folded)) = (linkage.stroke(), dead.folded) {
                let travel = (dead.extended.slider.m() - folded.slider.m()).abs();
                close(stroke.m(), travel, 1e-14);
            }
        }
    }
    assert_eq!(found, 18);
    let (low, high) = slide([2.0, 1.0, 0.0], 0.0).unwrap().crank_limits();
    close(low.unwrap().rad(), -PI / 6.0, 2e-16);
    close(high.unwrap().rad(), PI / 6.0, 2e-16);
    let (low, high) = slide([2.0, 2.5, 1.5], 0.0).unwrap().crank_limits();
    close(low.unwrap().rad(), -PI / 6.0, 2e-16);
    assert_eq!(high, None);
}

fn minus(p: [f64; 2], q: [f64; 2]) -> [f64; 2] {
    [p[0] - q[0], p[1] - q[1]]
}

fn inner(p: [f64; 2], q: [f64; 2]) -> f64 {
    p[0] * q[0] + p[1] * q[1]
}

proptest! {
    #[test]
    fn the_rrr_dyad_satisfies_its_constraints(
        p in prop::array::uniform12(-2.0f64..2.0), b in 1.0f64..6.0, c in 1.0f64..6.0, left: bool,
    ) {
        let point = |k: usize| PointMotion {
            position_m: [p[k], p[k + 1]],
            first_m: [p[k + 2], p[k + 3]],
            second_m: [p[k + 4], p[k + 5]],
        };
        let side = if left { Assembly::Positive } else { Assembly::Negative };
        let dyad = RrrDyad::new(Length::from_m(b), Length::from_m(c), side).unwrap();
        let (a, o) = (point(0), point(6));
        let Ok(m) = dyad.solve(&a, &o) else { return Ok(()) };
        prop_assume!(m.transmission.rad().sin() > 0.05);
        prop_assert!(m.determinant_m2 * side.sign() > 0.0);
        for (end, l, link) in [(a, b, m.first), (o, c, m.second)] {
            let v = minus(m.joint.position_m, end.position_m);
            let v1 = minus(m.joint.first_m, end.first_m);
            let v2 = minus(m.joint.second_m, end.second_m);
            let (size, size2) = (1.0 + inner(v1, v1), 1.0 + inner(v1, v1) + inner(v2, v2).sqrt());
            prop_assert!((inner(v, v).sqrt() - l).abs() < 1e-11);
            prop_assert!(inner(v, v1).abs() < 1e-9 * size);
            prop_assert!((inner(v, v2) + inner(v1, v1)).abs() < 1e-8 * size2);
            prop_assert!((link.angle.rad() - v[1].atan2(v[0])).sin().abs() < 1e-11);
            prop_assert!(((v[0] * v1[1] - v[1] * v1[0]) / (l * l) - link.first).abs() < 1e-9 * size);
        }
    }

    #[test]
    fn the_dyads_agree_with_the_linkages(
        l in prop::array::uniform4(0.5f64..3.0), phi in -3.0f64..3.0, left: bool,
    ) {
        let side = if left { Assembly::Positive } else { Assembly::Negative };
        let [a, b, c, d] = l;
        let end = PointMotion {
            position_m: [a * phi.cos(), a * phi.sin()],
            first_m: [-a * phi.sin(), a * phi.cos()],
            second_m: [-a * phi.cos(), -a * phi.sin()],
        };
        let same = |x: f64, y: f64, s: f64| (x - y).abs() < 1e-9 * (1.0 + x.abs()) * s;
        if let Ok(m) = bar(l).and_then(|f| f.position(rad(phi), side))
            && m.transmission.rad().sin() > 0.1
        {
            let dyad = RrrDyad::new(Length::from_m(b), Length::from_m(c), side).unwrap();
            let n = dyad.solve(&end, &PointMotion::fixed([d, 0.0])).unwrap();
            prop_assert!(same(m.coupler.first, n.first.first, 1.0));
            prop_assert!(same(m.rocker.second, n.second.second, 1e3));
            prop_assert!(same(m.joint.second_m[1], n.joint.second_m[1], 1e3));
        }
        let offset = c - 2.0;
        if let Ok(m) = slide([a, b, offset], d).and_then(|f| f.position(rad(phi), side))
            && m.transmission.rad().sin() > 0.1
        {
            let guide = Guide { origin_m: [-offset * d.sin(), offset * d.cos()], direction: rad(d) };
            let n = RrpDyad::new(Length::from_m(b), side).unwrap().solve(&end, &guide).unwrap();
            prop_assert!(same(m.slider_m, n.slider_m, 1.0));
            prop_assert!(same(m.slider_second_m, n.slider_second_m, 1e3));
            prop_assert!(same(m.rod.angle.rad(), n.rod.angle.rad(), 1.0));
            prop_assert!(same(m.rod.second, n.rod.second, 1e3));
        }
    }
}
