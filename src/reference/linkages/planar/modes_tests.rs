//! Completeness beside other proofs of it: two circles, and the class-III group by elimination.

use super::modes::{Found, intersection};
use super::tests::{bars, cranked, four_bar, pin};
use super::{Attachment, Body, Drive, Frame, Joint, Linkage, Mechanism, Real};
use crate::class_iii::tests::q;
use crate::class_iii::{self, ExactAngle, Geometry};
use crate::{Ball, Mag};
use rug::Rational;

const BITS: u32 = 128;

fn ball(text: &str) -> Ball {
    Ball::rational(BITS, &q(text))
}

fn turned(a: &Ball, b: &Ball) -> f64 {
    let off = (a - b).mid().to_f64();
    (off - std::f64::consts::TAU * (off / std::f64::consts::TAU).round()).abs()
}

/// A four-bar has two modes; whole turns of the crank change nothing but its own angle.
#[test]
fn a_crank_turned_further_has_the_same() {
    let linkage = cranked(&four_bar());
    for phi in ["0.9", "2.5", "-3.1", "3.141", "4", "-7", "40"] {
        let modes = linkage.modes(&ball(phi)).unwrap();
        assert_eq!(modes.len(), 2, "{phi}");
        for left in [true, false] {
            let lengths = ["2", "3.5", "3", "4"].map(q);
            let due = crate::dyad::four_bar(&lengths, &q(phi), left, BITS).unwrap();
            let met = modes.iter().filter(|m| {
                turned(&m.x[1], &due.coupler[0]) < 1e-30
                    && turned(&m.x[2], &due.rocker[0]) < 1e-30
                    && m.x[0].overlaps(&ball(phi))
            });
            assert_eq!(met.count(), 1, "{phi} {left}");
        }
    }
}

/// The coupler driven relative to the crank: both turn together, and the triangle of crank, coupler
/// and the line between their far ends has that line on the rocker's circle twice.
#[test]
fn a_drive_between_two_bodies_has_all_its_modes() {
    let mechanism = four_bar();
    let linkage = Linkage::new(&mechanism, &Drive::relative(0, 1), BITS).unwrap();
    for phi in ["1.9", "-2.2", "4.1", "-8"] {
        let modes = linkage.modes(&ball(phi)).unwrap();
        // Lengths 2 and 7/2 at this angle reach d; the frame 4 and the rocker 3 close the triangle
        // (d, 3, 4) or not.
        let angle = q(phi).to_f64();
        let d = (4.0 + 12.25 + 14.0 * angle.cos()).sqrt();
        let due = if d > 1.0 && d < 7.0 { 2 } else { 0 };
        assert_eq!(modes.len(), due, "{phi}");
        for m in &modes {
            assert!((&m.x[1] - &m.x[0]).overlaps(&ball(phi)));
            let as_cranked = cranked(&mechanism).modes(&m.x[0].clone()).unwrap();
            let met = as_cranked
                .iter()
                .filter(|c| turned(&c.x[1], &m.x[1]) < 1e-20);
            assert_eq!(met.count(), 1, "{phi}");
        }
    }
}

/// A five-bar whose cranks are geared: the second crank's angle follows from the first one's, turns
/// and all.
#[test]
fn gears_count_the_turns() {
    let b = Attachment::body;
    let at = |x: &str| [q(x), q("0")];
    let geared = |ratio: &str, drive: usize| {
        let joints = vec![
            pin(Attachment::ground(at("0")), b(0, at("0"))),
            pin(b(0, at("1")), b(1, at("0"))),
            pin(Attachment::ground(at("3")), b(2, at("0"))),
            pin(b(2, at("0.5")), b(3, at("0"))),
            pin(b(1, at("2.5")), b(3, at("2"))),
            Joint::Gear {
                a: Frame::Body(0),
                b: Frame::Body(2),
                carrier: Frame::Ground,
                ratio: q(ratio),
                offset: ExactAngle::Radians(q("0.25")),
            },
        ];
        let bodies = ["crank", "link", "second crank", "second link"].map(Body::massless);
        let mechanism = Mechanism::new(bodies.to_vec(), joints).unwrap();
        Linkage::new(&mechanism, &Drive::coordinate(drive), BITS).unwrap()
    };
    for (ratio, phi) in [("2", "2"), ("-3", "3"), ("0.5", "9"), ("0.75", "-5")] {
        let modes = geared(ratio, 0).modes(&ball(phi)).unwrap();
        assert_eq!(modes.len(), 2, "{ratio} {phi}");
        let second = Ball::rational(BITS, &(q(ratio) * q(phi) + q("0.25")));
        assert!(modes.iter().all(|m| m.x[2].overlaps(&second)));
    }
    // Turns of the second crank and of both links; the drive is at the crank or at its link.
    let keeps = |drive, turns: [i64; 4]| geared("2", drive).keeps(&turns);
    assert!(keeps(0, [0, 1, 0, -3]) && !keeps(0, [1, 0, 2, 0]) && !keeps(0, [0, 0, 1, 0]));
    assert!(keeps(1, [1, 0, 2, 5]) && !keeps(1, [1, 0, 1, 0]) && !keeps(1, [1, 1, 2, 0]));
    // Driven at the second crank with the ratio 2, half as many turns of the first: one crank angle
    // and two modes.
    for (ratio, psi) in [("2", "5"), ("0.5", "4")] {
        let modes = geared(ratio, 2).modes(&ball(psi)).unwrap();
        assert_eq!(modes.len(), 2, "{ratio} {psi}");
    }
    // Driven at a link: what is found with the crank's angle from −π to π, and over two turns where
    // the ratio is 1/2.
    for (ratio, turns) in [("1", 1), ("0.5", 2), ("2", 1)] {
        let linkage = geared(ratio, 1);
        let modes = linkage.modes(&ball("0.4")).unwrap();
        let mut due = 0;
        let cranked = geared(ratio, 0);
        let steps = 120 * turns;
        let mut before: Option<Vec<f64>> = None;
        // Changes of sign of the link's angle − 0.4 along the two branches, which are told by the
        // order of its sine.
        for k in 0..=steps {
            let phi = f64::from(turns)
                * std::f64::consts::PI
                * (2.0 * f64::from(k) / f64::from(steps) - 1.0)
                + 1e-3;
            let mut now: Vec<f64> = cranked
                .modes(&Ball::exact(BITS, phi))
                .unwrap()
                .iter()
                .map(|m| {
                    let off = (&m.x[1] - &ball("0.4")).mid().to_f64();
                    off - std::f64::consts::TAU * (off / std::f64::consts::TAU).round()
                })
                .collect();
            now.sort_by(f64::total_cmp);
            if let Some(before) = &before {
                due += before
                    .iter()
                    .zip(&now)
                    .filter(|(a, b)| a.signum() != b.signum() && (*a - *b).abs() < 1.0)
                    .count();
            }
            before = Some(now);
        }
        assert_eq!(modes.len(), due, "{ratio}");
    }
}

/// The class-III group of a right-angled ternary link, whose data are rational in both forms.
fn group() -> (Geometry, Mechanism) {
    let geometry = Geometry {
        l1: q("10"),
        l2: q("104"),
        l3: q("60"),
        l4: q("64"),
        l5: q("48.5"),
        lb: q("22"),
        phi_b: ExactAngle::Degrees(q("-90")),
        o3: [q("75"), q("93")],
        o5: [q("128.5"), q("103.5")],
    };
    let b = Attachment::body;
    let at = |x: &Rational| [x.clone(), Rational::new()];
    let origin = || [Rational::new(), Rational::new()];
    let g = &geometry;
    let joints = vec![
        pin(Attachment::ground(origin()), b(0, origin())),
        pin(b(0, at(&g.l1)), b(1, origin())),
        pin(Attachment::ground(g.o3.clone()), b(2, origin())),
        pin(b(2, at(&g.l3)), b(3, origin())),
        pin(Attachment::ground(g.o5.clone()), b(4, origin())),
        pin(b(3, at(&g.l4)), b(4, at(&g.l5))),
        pin(
            b(3, [Rational::new(), Rational::from(-&g.lb)]),
            b(1, at(&g.l2)),
        ),
    ];
    let bodies = ["crank", "link", "rocker", "ternary", "rocker 5"].map(Body::massless);
    let mechanism = Mechanism::new(bodies.to_vec(), joints).unwrap();
    (geometry, mechanism)
}

#[test]
fn a_class_iii_group_has_those_of_its_elimination() {
    let (geometry, mechanism) = group();
    let other = class_iii::Linkage::new(&geometry, BITS);
    let linkage = Linkage::new(&mechanism, &Drive::coordinate(0), BITS).unwrap();
    for phi in ["0.25", "2"] {
        let due = other.modes(&ball(phi)).unwrap();
        let modes = linkage.modes(&ball(phi)).unwrap();
        assert_eq!(modes.len(), due.len(), "{phi}");
        for mode in &due {
            let c = &mode.configuration;
            let rocker = (&c.c
                - &crate::ComplexBall::rational(BITS, &geometry.o3[0], &geometry.o3[1]))
                .arg();
            let ternary = (&c.d - &c.c).arg();
            let met = modes
                .iter()
                .filter(|m| turned(&m.x[2], &rocker) < 1e-20 && turned(&m.x[3], &ternary) < 1e-20);
            assert_eq!(met.count(), 1, "{phi}");
        }
    }
}

#[test]
fn none_where_it_cannot_be_joined_and_undecided_where_modes_meet() {
    let with = |frame| cranked(&bars(["1", "2", "1", frame]));
    // Coupler and rocker reach 3; from the crank's pin to the pivot it is 4 and more.
    assert!(with("4").modes(&ball("2")).unwrap().is_empty());
    // A parallelogram on one line.
    let flat = with("2").modes(&ball("0"));
    assert!(flat.is_err(), "{flat:?}");
    assert_eq!(with("2").modes(&ball("0.5")).unwrap().len(), 2);
}

/// Checks that what is recorded lies in the box in which it is alone, and is told from what is
/// known by that box.
#[test]
fn a_mode_is_told_by_the_box_in_which_it_is_alone() {
    let linkage = cranked(&four_bar());
    let phi = ball("0.9");
    let modes = linkage.modes(&phi).unwrap();
    let around = |at: &[Ball], by: f64| -> Vec<Ball> {
        let by = Ball::exact(BITS, by);
        at.iter()
            .map(|x| (x + &by).widened(Mag::from_f64(0.01)))
            .collect()
    };
    let known = |alone: Vec<Ball>, k: usize| {
        let position = modes[k].clone();
        vec![Found { position, alone }]
    };
    // Newton's method leads from a box beside the mode to the mode, which is not in the box.
    let beside = around(&modes[0].x, 0.05);
    assert!(
        linkage
            .record(&phi, beside.clone(), &mut Vec::new())
            .is_err()
    );
    // A mode on the edge of the box is not in it.
    let mut edge = around(&modes[0].x, 0.0);
    edge[1] = (&modes[0].x[1] + &Ball::exact(BITS, 0.01)).with_prec(BITS);
    edge[1] = Ball::new(edge[1].mid().clone(), Mag::from_f64(0.01));
    assert!(edge[1].overlaps(&modes[0].x[1]) && !edge[1].contains_ball(&modes[0].x[1]));
    assert!(linkage.record(&phi, edge.clone(), &mut Vec::new()).is_err());
    let mut found = Vec::new();
    linkage
        .record(&phi, around(&modes[0].x, 0.0), &mut found)
        .unwrap();
    linkage
        .record(&phi, around(&modes[0].x, 0.001), &mut found)
        .unwrap();
    assert_eq!(found.len(), 1);
    linkage
        .record(&phi, around(&modes[1].x, 0.0), &mut found)
        .unwrap();
    assert_eq!(found.len(), 2);
    // With angles beyond a quarter turn as well.
    let (far, mut twice) = (ball("2.5"), Vec::new());
    let mode = linkage.modes(&far).unwrap().swap_remove(0);
    for by in [0.0, 0.001] {
        linkage
            .record(&far, around(&mode.x, by), &mut twice)
            .unwrap();
    }
    assert_eq!(twice.len(), 1);
    // Another mode's box that it only touches.
    let mut found = known(edge, 1);
    linkage
        .record(&phi, around(&modes[0].x, 0.0), &mut found)
        .unwrap();
    assert_eq!(found.len(), 2);
    // In no common box, and not shown to be another.
    let same_place = linkage.record(&phi, around(&modes[0].x, 0.0), &mut known(beside, 0));
    assert!(same_place.is_err());
    // A turn of the crank alone does not keep the drive: it leads to no mode in a box there.
    let turn = Ball::pi(BITS).shift(1);
    let mut far = around(&modes[0].x, 0.0);
    far[0] = &far[0] + &turn;
    let mut found = known(far, 1);
    linkage
        .record(&phi, around(&modes[0].x, 0.0), &mut found)
        .unwrap();
    assert_eq!(found.len(), 2);
    // A turn of the rocker does.
    let mut far = around(&modes[0].x, 0.0);
    far[2] = &far[2] + &turn;
    let mut found = known(far, 1);
    linkage
        .record(&phi, around(&modes[0].x, 0.0), &mut found)
        .unwrap();
    assert_eq!(found.len(), 1);
}

/// Displacements have no compact chart: a slider-crank is undecided.
#[test]
fn slides_are_undecided() {
    let b = Attachment::body;
    let at = |x: &str| [q(x), q("0")];
    let joints = vec![
        pin(Attachment::ground(at("0")), b(0, at("0"))),
        pin(b(0, at("1")), b(1, at("0"))),
        pin(b(1, at("3")), b(2, at("0"))),
        Joint::Slide {
            a: Attachment::ground(at("0")),
            direction: at("1").map(Real::from),
            b: b(2, at("0")),
            turn: ExactAngle::Radians(q("0")),
        },
    ];
    let bodies = ["crank", "coupler", "slider"].map(Body::massless).to_vec();
    let linkage = cranked(&Mechanism::new(bodies, joints).unwrap());
    assert!(linkage.modes(&ball("0.5")).is_err());
}

#[test]
fn boxes_intersect_in_what_both_hold() {
    let between = |(low, high): (f64, f64)| {
        let [low, high] = [low, high].map(|x| Ball::exact(64, x));
        Ball::between(64, low.mid(), high.mid())
    };
    for (a, b, due) in [
        ((0.0, 2.0), (1.0, 3.0), Some((1.0, 2.0))),
        ((0.0, 4.0), (1.0, 3.0), Some((1.0, 3.0))),
        ((0.0, 1.0), (2.0, 3.0), None),
    ] {
        for (a, b) in [(a, b), (b, a)] {
            let found = intersection(&between(a), &between(b));
            let ends = found.map(|x| (x.lower().to_f64(), x.upper().to_f64()));
            let near = |x: f64, y: f64| (x - y).abs() < 1e-9;
            let right = match (ends, due) {
                (Some(e), Some(d)) => near(e.0, d.0) && near(e.1, d.1),
                (e, d) => e.is_none() && d.is_none(),
            };
            assert!(right, "{a:?} {b:?}: {ends:?}");
        }
    }
}

/// A free angle as many half turns to either side as a common denominator says, to the last bit,
/// and one that is solved for as far as its equation says.
#[test]
fn charts_are_as_wide_as_their_turns() {
    let system = cranked(&four_bar()).coarse;
    let pi = Ball::pi(400).lower();
    for q in 1..600 {
        let slope = (1, Rational::from((1, q)));
        let x = system.chart(&[(vec![(0, Rational::from(1)), slope], Ball::exact(64, 0.5))]);
        for (x, turns) in [(&x[1], q), (&x[2], 1)] {
            assert!(x.mid().is_zero());
            let (rad, due) = (x.rad().to_float(), pi.clone() * turns);
            assert!(rad >= due && rad < due * 1.000_000_1f64, "{q}");
        }
        let (low, high) = (x[0].lower() - 0.5f64, x[0].upper() - 0.5f64);
        assert!(low <= -pi.clone() && high >= pi && high < 3.15, "{q}");
    }
}
