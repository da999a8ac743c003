//! Completeness beside other proofs of it: two circles, and the class-III group by elimination.

use super::tests::{cranked, four_bar};
use super::{Attachment, Body, Drive, Joint, Linkage, Mechanism};
use crate::Ball;
use crate::class_iii::tests::q;
use crate::class_iii::{self, ExactAngle, Geometry};
use rug::Rational;

const BITS: u32 = 128;

fn ball(text: &str) -> Ball {
    Ball::rational(BITS, &q(text))
}

fn turned(a: &Ball, b: &Ball) -> f64 {
    let off = (a - b).mid().to_f64();
    (off - std::f64::consts::TAU * (off / std::f64::consts::TAU).round()).abs()
}

#[test]
fn a_four_bar_has_two() {
    let linkage = cranked(&four_bar());
    for phi in ["0.9", "2.5", "-3.1", "3.141"] {
        let modes = linkage.modes(&ball(phi)).unwrap();
        assert_eq!(modes.len(), 2, "{phi}");
        for left in [true, false] {
            let lengths = ["2", "3.5", "3", "4"].map(q);
            let due = crate::dyad::four_bar(&lengths, &q(phi), left, BITS).unwrap();
            let met = modes.iter().filter(|m| {
                turned(&m.x[1], &due.coupler[0]) < 1e-30 && turned(&m.x[2], &due.rocker[0]) < 1e-30
            });
            assert_eq!(met.count(), 1, "{phi} {left}");
        }
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
    let pin = |a, b| Joint::Pin { a, b };
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
    let b = Attachment::body;
    let at = |x: &str| [q(x), q("0")];
    let with = |frame: &str| {
        let joints = vec![
            Joint::Pin {
                a: Attachment::ground(at("0")),
                b: b(0, at("0")),
            },
            Joint::Pin {
                a: b(0, at("1")),
                b: b(1, at("0")),
            },
            Joint::Pin {
                a: Attachment::ground(at(frame)),
                b: b(2, at("0")),
            },
            Joint::Pin {
                a: b(1, at("2")),
                b: b(2, at("1")),
            },
        ];
        let bodies = ["crank", "coupler", "rocker"].map(Body::massless).to_vec();
        cranked(&Mechanism::new(bodies, joints).unwrap())
    };
    // Coupler and rocker reach 3; from the crank's pin to the pivot it is 4 and more.
    assert!(with("4").modes(&ball("2")).unwrap().is_empty());
    // A parallelogram on one line.
    let flat = with("2").modes(&ball("0"));
    assert!(flat.is_err(), "{flat:?}");
    assert_eq!(with("2").modes(&ball("0.5")).unwrap().len(), 2);
}

/// Whole turns of the drive, and a drive between two bodies whose difference leaves the chart.
#[test]
fn whole_turns_lose_no_mode() {
    let linkage = cranked(&four_bar());
    let turn = Ball::pi(BITS).shift(1);
    for turns in [-3, 1, 2] {
        let at = ball("0.9") + Ball::integer(BITS, turns) * &turn;
        assert_eq!(linkage.modes(&at).unwrap().len(), 2, "{turns}");
    }
    // Coupler less crank at the values that both modes of a crank angle have.
    let relative = Linkage::new(&four_bar(), &Drive::relative(0, 1), BITS).unwrap();
    for phi in ["0.9", "2.5", "-3.1", "3.141"] {
        for mode in linkage.modes(&ball(phi)).unwrap() {
            let modes = relative.modes(&(&mode.x[1] - &mode.x[0])).unwrap();
            let same = |m: &&super::Position| {
                let pairs = m.x.iter().zip(&mode.x);
                pairs.into_iter().all(|(a, b)| turned(a, b) < 1e-25)
            };
            assert_eq!(modes.iter().filter(same).count(), 1, "{phi}");
        }
    }
}
