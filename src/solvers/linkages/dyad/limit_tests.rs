//! Four-bars and slider-cranks exactly at the limits of their kinds.

use super::numeric::check_lengths;
use super::rrp::solve_guide;
use super::tests::{sides, slide};
use super::*;
use crate::units::{Angle, AngularVelocity, Length};
use std::f64::consts::{FRAC_PI_2, PI};

fn bar(l: [f64; 4]) -> FourBar {
    super::tests::bar(l).expect("a four-bar")
}

/// A rhombus: the coupler keeps its direction and the rocker turns with the crank, or the other way
/// round. Crank and frame are of one length, which decides between two ways to the same motion.
#[test]
fn a_rhombus() {
    let rhombus = bar([1.0; 4]);
    for k in 1..30 {
        let phi = 0.1 * f64::from(k);
        let rates = sides().map(|side| {
            let m = rhombus
                .position(Angle::from_rad(phi), side)
                .expect("closes");
            (m.coupler.first, m.rocker.first)
        });
        for ((p, q), (due_p, due_q)) in rates.into_iter().zip([(0.0, 1.0), (1.0, 0.0)]) {
            assert!(
                (p - due_p).abs() < 1e-13 && (q - due_q).abs() < 1e-13,
                "{phi}: {p} {q}"
            );
        }
    }
}

/// Where two sums are equal the crank just passes: no limit.
#[test]
fn limits_of_the_crank_at_equal_sums() {
    let range = |l| bar(l).crank_range();
    // a + d = b + c sets no outer limit, c − b = 3 an inner one.
    assert!(matches!(
        range([2.0, 1.0, 4.0, 3.0]),
        CrankRange::Beyond { .. }
    ));
    // |b − c| = |a − d| sets no inner limit, whichever is longer.
    for l in [
        [3.0, 4.0, 3.0, 2.0],
        [2.0, 4.0, 3.0, 3.0],
        [3.0, 3.0, 4.0, 2.0],
    ] {
        assert_eq!(range(l), CrankRange::Full, "{l:?}");
    }
    assert_eq!(range([2.0, 3.0, 4.0, 3.0]), CrankRange::Full);
    assert!(matches!(
        range([2.0, 1.0, 2.0, 3.0]),
        CrankRange::Within { .. }
    ));
}

/// Crank, coupler, rocker and frame in one line: the folded crank points to π, not to −π.
#[test]
fn a_flat_dead_position() {
    for side in sides() {
        let folded = bar([1.0, 2.0, 2.0, 3.0])
            .dead_positions(side)
            .folded
            .expect("flat");
        assert_eq!(folded.crank.rad(), PI, "{side:?}");
    }
}

/// The shorter way round between the two angles of the rocker.
#[test]
fn swings_are_the_shorter_way() {
    let swing = |a: f64, b: f64| {
        let at = |rocker: f64| DeadPosition {
            crank: Angle::from_rad(0.0),
            rocker: Angle::from_rad(rocker),
        };
        let both = DeadPositions {
            extended: Some(at(a)),
            folded: Some(at(b)),
        };
        both.swing().expect("two").rad()
    };
    assert_eq!(
        (swing(2.5, -2.5), swing(-2.5, 2.5)),
        (2.0 * PI - 5.0, 2.0 * PI - 5.0)
    );
    assert_eq!((swing(2.5, 1.0), swing(-0.5, 1.0)), (1.5, 1.5));
}

/// Lengths that differ by exactly the largest ratio.
#[test]
fn the_largest_ratio() {
    let check = |short: f64| {
        let l = [
            ("long", Length::from_m(8.0)),
            ("short", Length::from_m(short)),
        ];
        check_lengths(&l, &[])
    };
    let least = 8.0 / MAX_LENGTH_RATIO;
    assert!(check(least).is_ok() && check(least.next_down()).is_err());
}

/// π is not a double: seen against a guide in the direction −π the rod at π has what is left,
/// `π − fl(π)` = 1.22464679914735317723e-16.
#[test]
fn a_rod_against_its_guide() {
    let zero = [0.0; 3];
    let m = solve_guide(zero, zero, 1.0, -PI, Assembly::Negative.sign());
    assert_eq!(m.rod[0], 1.224_646_799_147_353_2e-16);
}

/// Two pivots close together, on long links: rates by 60 digits at the angle 0, where crank and
/// frame differ by 2⁻²⁰ and coupler and rocker by 2⁻²¹, all without rounding.
#[test]
fn a_short_span() {
    let (near, far) = (1.0 + 2f64.powi(-21), 1.0 + 2f64.powi(-20));
    let first = -(2f64.powi(20));
    let (p, q) = (634_804_545_065.374_1, 634_803_334_273.236_4);
    for (l, side, second) in [
        ([1.0, near], Assembly::Positive, [-p, -q]),
        ([1.0, near], Assembly::Negative, [p, q]),
        ([near, 1.0], Assembly::Positive, [q, p]),
        ([near, 1.0], Assembly::Negative, [-q, -p]),
    ] {
        let due = [first, second[0], first, second[1]];
        let m = bar([1.0, l[0], l[1], far])
            .position(Angle::from_rad(0.0), side)
            .expect("closes");
        let got = [
            m.coupler.first,
            m.coupler.second,
            m.rocker.first,
            m.rocker.second,
        ];
        for (got, due) in got.into_iter().zip(due) {
            assert!(
                (got / due - 1.0).abs() < 1e-14,
                "{l:?} {side:?}: {got} {due}"
            );
        }
    }
}

/// At the limits of the slider-crank the crank neither passes nor has a limit.
#[test]
fn slider_cranks_that_just_pass() {
    let slide = |l| slide(l, 0.0).expect("a slider-crank");
    for e in [0.5, -0.5] {
        let s = slide([1.0, 1.5, e]);
        assert!(!s.turns_fully());
        assert_eq!(s.crank_limits(), (None, None), "{e}");
        let (low, high) = slide([1.0, 1.5f64.next_down(), e]).crank_limits();
        let (one, none) = if e < 0.0 { (low, high) } else { (high, low) };
        assert!(none.is_none() || one.is_none(), "{e}");
        let one = one.or(none).expect("a limit");
        assert!((one.rad().abs() - FRAC_PI_2).abs() < 1e-7, "{e}");
    }
}

#[test]
fn lengths_are_given_back() {
    let b = bar([1.0, 3.0, 4.0, 5.0]);
    let got = [b.crank(), b.coupler(), b.rocker(), b.frame()].map(|l| l.m());
    assert_eq!(got, [1.0, 3.0, 4.0, 5.0]);
    let s = slide([1.0, 3.0, -0.5], 0.7).expect("a slider-crank");
    assert_eq!(
        [s.crank(), s.rod(), s.offset()].map(|l| l.m()),
        [1.0, 3.0, -0.5]
    );
    assert_eq!(s.direction().rad(), 0.7);
}

#[test]
fn links_at_the_speed_of_the_crank() {
    let angle = Angle::from_rad(0.3);
    let link = LinkMotion {
        angle,
        first: 0.5,
        second: -2.0,
    };
    let w = AngularVelocity::from_rad_per_s(10.0);
    assert_eq!(link.angular_velocity(w).rad_per_s(), 5.0);
    assert_eq!(link.angular_acceleration_rad_per_s2(w, 4.0), -198.0);
}

#[test]
fn points_that_are_no_numbers() {
    let rest = PointMotion::fixed([0.0, 0.0]);
    let there = PointMotion::fixed([2.0, 1.0]);
    let m = Length::from_m;
    let rrr = RrrDyad::new(m(2.0), m(3.0), Assembly::Positive).expect("a dyad");
    let rrp = RrpDyad::new(m(3.0), Assembly::Positive).expect("a dyad");
    let guide = Guide {
        origin_m: [0.0, 1.0],
        direction: Angle::from_rad(0.2),
    };
    assert!(rrr.solve(&rest, &there).is_ok() && rrp.solve(&rest, &guide).is_ok());
    for bad in [f64::NAN, f64::INFINITY] {
        for k in 0..6 {
            let mut p = there;
            [&mut p.position_m, &mut p.first_m, &mut p.second_m][k / 2][k % 2] = bad;
            let refused = |e: Result<(), DyadError>| matches!(e, Err(DyadError::NotFinite { .. }));
            assert!(refused(rrr.solve(&rest, &p).map(|_| ())), "{k}");
            assert!(refused(rrr.solve(&p, &rest).map(|_| ())), "{k}");
            assert!(refused(rrp.solve(&p, &guide).map(|_| ())), "{k}");
        }
    }
}

/// Limits of the crank, where lengths nearly cancel: `4ad sin²(φ/2) = (b + c)² − (a − d)²`, of
/// integers without error.
#[test]
fn limits_of_the_crank_between_nearly_equal_sums() {
    let unit = 2f64.powi(-40);
    let one: i128 = 1 << 40;
    for k in 0..60i128 {
        for (a, d) in [
            (2 * one + 12_345 * k, one + 777 * k),
            (one - 99 * k, 2 * one + 13 * k),
        ] {
            // b + c a little more than |a − d|, b and c of the same size.
            let gap = (a - d).abs() + 1 + 1000 * k * k;
            let b = gap / 3 + 5 * k;
            let c = gap - b;
            let l = [a, b, c, d].map(|x| x as f64 * unit);
            let Ok(bar) = super::tests::bar(l) else {
                continue;
            };
            let limit = match bar.crank_range() {
                CrankRange::Within { limit } => limit,
                CrankRange::Between { upper, .. } => upper,
                other => panic!("{other:?}"),
            };
            let product = (b + c - a + d) * (b + c + a - d);
            let due = product as f64 / (4.0 * a as f64 * d as f64);
            let got = (0.5 * limit.rad()).sin().powi(2);
            assert!((got / due - 1.0).abs() < 2e-15, "{k}: {got} {due}");
        }
    }
}
