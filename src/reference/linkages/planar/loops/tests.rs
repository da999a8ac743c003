//! Joints in any order, from either side and at any points of the bodies.

use super::super::energy::Forces;
use super::super::tests::{BITS, at, ball, cranked, four_bar, guess, meets, origin, pin};
use super::super::{
    Attachment, Body, Drive, Joint, Linkage, Mechanism, MechanismError, Point, Real,
};
use crate::Ball;
use crate::class_iii::ExactAngle;
use crate::class_iii::tests::q;
use crate::dyad;
use rug::Rational;

/// The four-bar with its joints from the last to the first, its bodies' origins beside their axes,
/// and the axes of the rocker turned by half a turn.
#[test]
fn a_four_bar_is_the_same_from_either_end() {
    let b = Attachment::body;
    let joints = vec![
        pin(b(2, at("-2", "0.25")), b(1, at("4.5", "1"))),
        pin(Attachment::ground(at("4", "0")), b(2, at("1", "0.25"))),
        pin(b(1, at("1", "1")), b(0, at("1.5", "-3"))),
        pin(b(0, at("-0.5", "-3")), Attachment::ground(origin())),
    ];
    let bodies = ["crank", "coupler", "rocker"].map(Body::massless).to_vec();
    let linkage = cranked(&Mechanism::new(bodies, joints).unwrap());
    let phi = ball("0.9");
    let due = cranked(&four_bar())
        .position(&phi, &guess(&[0.9, 0.5, 1.6]))
        .unwrap();
    let position = linkage.position(&phi, &guess(&[0.9, 0.5, -1.5])).unwrap();
    meets(&position.x[1], &due.x[1]);
    meets(&(&position.x[2] + &Ball::pi(BITS)), &due.x[2]);
    // The coupler's pin on the crank, and its mid-point, as points of the coupler.
    let series = linkage.series(&position, 2).unwrap();
    let (s, c) = phi.sin_cos();
    let [[x, y], ..] = linkage.point_motion(&series, &b(1, at("1", "1")));
    meets(&x, &c.shift(1));
    meets(&y, &s.shift(1));
    let (t, k) = due.x[1].sin_cos();
    let [[x, y], ..] = linkage.point_motion(&series, &b(1, at("2.75", "1")));
    meets(&x, &(c.shift(1) + &k * &ball("1.75")));
    meets(&y, &(s.shift(1) + &t * &ball("1.75")));
}

/// A slider-crank whose guide belongs to the slider and runs over a point of the ground: the line
/// at −1/4 rad, and the way of the other sign.
#[test]
fn a_guide_on_the_slider() {
    let b = Attachment::body;
    let bodies = ["crank", "rod", "slider"].map(Body::massless).to_vec();
    let joints = vec![
        Joint::Slide {
            a: b(2, origin()),
            direction: at("0.5", "0").map(Real::from),
            b: Attachment::ground(origin()),
            turn: ExactAngle::Radians(q("0.25")),
        },
        pin(Attachment::ground(origin()), b(0, origin())),
        pin(b(0, at("1", "0")), b(1, origin())),
        pin(b(1, at("4", "0")), b(2, origin())),
    ];
    let linkage = cranked(&Mechanism::new(bodies, joints).unwrap());
    let lengths = ["1", "4", "0"].map(q);
    let due = dyad::slider_crank(&lengths, &q("-0.25"), &q("0.7"), true, BITS).unwrap();
    let position = linkage
        .position(&ball("0.7"), &guess(&[0.7, -0.45, -0.25, -9.0]))
        .unwrap();
    let series = linkage.series(&position, 2).unwrap();
    meets(&position.x[2], &ball("-0.25"));
    for n in 0..3 {
        meets(
            &series.coefficient(1, n).shift((n == 2) as i32),
            &due.rod[n],
        );
        let slid = series.coefficient(3, n).shift((n == 2) as i32 - 1);
        meets(&-slid, &due.slider[n]);
    }
}

/// A body on a guide of the crank, its pin in the slot x = 1 of the ground: on the line at the
/// angle ψ through the origin that pin is at (1, tan ψ). The guide is the crank's, or the body's
/// over the crank's centre.
#[test]
fn a_guide_between_two_bodies() {
    let b = Attachment::body;
    let linkage = |guide: Joint| {
        let joints = vec![
            pin(Attachment::ground(origin()), b(0, origin())),
            guide,
            Joint::Slot {
                a: Attachment::ground(at("1", "0")),
                direction: at("0", "0.5").map(Real::from),
                b: b(1, at("1", "1")),
            },
        ];
        let bodies = ["crank", "block"].map(Body::massless).to_vec();
        cranked(&Mechanism::new(bodies, joints).unwrap())
    };
    let (turn, direction) = (ExactAngle::Radians(q("0.25")), at("2", "0"));
    let on_crank = linkage(Joint::Slide {
        a: b(0, origin()),
        direction: direction.clone().map(Real::from),
        b: b(1, at("1", "1")),
        turn: turn.clone(),
    });
    let on_block = linkage(Joint::Slide {
        a: b(1, at("1", "1")),
        direction: direction.map(Real::from),
        b: b(0, origin()),
        turn,
    });
    // The block's angle, the angle of the line, twice the sign of the way.
    let cases = [
        (on_crank, "0.85", "0.6", 0.6),
        (on_block, "0.35", "0.35", -0.6),
    ];
    for (linkage, block, line, way) in cases {
        let start = guess(&[0.6, q(block).to_f64(), way, 1.2]);
        let position = linkage.position(&ball("0.6"), &start).unwrap();
        meets(&position.x[1], &ball(block));
        let (s, c) = ball(line).sin_cos();
        let due = c.recip().shift(-1);
        meets(&position.x[2], &if way > 0.0 { due } else { -due });
        meets(&position.x[3], &(s / c).shift(1));
    }
}

#[test]
fn bad_parts_are_refused() {
    let b = Attachment::body;
    let hung = || pin(Attachment::ground(origin()), b(0, origin()));
    let body = |mass: &str, inertia: &str| {
        let mut body = Body::massless("one");
        (body.mass, body.inertia) = (q(mass), q(inertia));
        body
    };
    for (mass, inertia) in [("-1", "0"), ("0", "-1"), ("2", "-1"), ("-1", "2")] {
        let refused = Mechanism::new(vec![body(mass, inertia)], vec![hung()]).unwrap_err();
        assert_eq!(refused, MechanismError::Negative("one".into()));
    }
    assert!(Mechanism::new(vec![body("1", "2")], vec![hung()]).is_ok());
    // A rack on a pin, and on a joint that does not exist.
    for slide in [0, 2] {
        let rack = Joint::Rack {
            pinion: super::super::Frame::Body(0),
            slide,
            ratio: q("1"),
            offset: Rational::new(),
        };
        let refused = Mechanism::new(vec![body("0", "0")], vec![hung(), rack]).unwrap_err();
        assert_eq!(refused, MechanismError::Missing { joint: 1 });
    }
    let slot = |direction: Point| {
        let slot = Joint::Slot {
            a: Attachment::ground(at("1", "0")),
            direction: direction.map(Real::from),
            b: b(0, at("1", "0")),
        };
        Mechanism::new(vec![body("0", "0")], vec![hung(), slot]).unwrap_err()
    };
    assert_eq!(slot(origin()), MechanismError::Direction { joint: 1 });
    for direction in [at("0", "1"), at("1", "0")] {
        assert!(matches!(slot(direction), MechanismError::Freedom { .. }));
    }
    // One coordinate of a drive that exists is not enough, nor one factor that is not zero
    // elsewhere.
    let mechanism = four_bar();
    for terms in [
        vec![(0, q("1")), (3, q("1"))],
        vec![(3, q("1")), (0, q("1"))],
    ] {
        let refused = Linkage::new(&mechanism, &Drive(terms), BITS).unwrap_err();
        assert_eq!(refused, MechanismError::Drive);
    }
    assert!(Linkage::new(&mechanism, &Drive(vec![(1, q("0")), (2, q("3"))]), BITS).is_ok());
}

/// A block on a slide along x, held by a spring of stiffness 6 and length 2 from a point 3 above:
/// at s = 4 the spring is 5 long, and all derivatives of the energy are rational.
#[test]
fn a_spring_across_a_slide_by_its_derivatives() {
    let joints = vec![Joint::Slide {
        a: Attachment::ground(origin()),
        direction: at("1", "0").map(Real::from),
        b: Attachment::body(0, origin()),
        turn: ExactAngle::Radians(q("0")),
    }];
    let mechanism = Mechanism::new(vec![Body::massless("block")], joints).unwrap();
    let linkage = Linkage::new(&mechanism, &Drive::coordinate(1), BITS).unwrap();
    let forces = Forces {
        drive: q("10"),
        springs: vec![super::super::Spring {
            a: Attachment::body(0, origin()),
            b: Attachment::ground(at("0", "3")),
            stiffness: q("6"),
            length: q("2"),
        }],
        gravity: origin(),
    };
    let position = linkage.position(&ball("4"), &guess(&[0.0, 4.0])).unwrap();
    let series = linkage.series(&position, 4).unwrap();
    // L and its derivatives at s = 4, h = 3: s/L, h²/L³, −3h²s/L⁵, −3h²/L⁵ + 15h²s²/L⁷.
    let r = |n: i64, d: i64| Rational::from((n, d));
    let l = [
        r(3, 1),
        r(4, 5),
        r(9, 125),
        r(-108, 3125),
        r(-27, 3125) + r(2160, 78125),
    ];
    let p = |a: usize, b: usize| Rational::from(&l[a] * &l[b]);
    let derivatives = [
        p(0, 0) / 2,
        p(0, 1),
        p(1, 1) + p(0, 2),
        p(1, 2) * 3 + p(0, 3),
        p(2, 2) * 3 + p(1, 3) * 4 + p(0, 4),
    ];
    let derivatives = derivatives.map(|d| d * 6);
    let load = super::super::energy::Load::new(&mechanism, &forces, BITS);
    let potential = load.potential_series(&series);
    for (n, (found, factorial)) in potential.iter().zip([1, 1, 2, 6, 24]).enumerate() {
        let due = Rational::from(&derivatives[n] / factorial);
        meets(found, &Ball::rational(BITS, &due));
    }
    let [force, slope] = linkage.reduced_force(&series, &forces);
    meets(&force, &Ball::rational(BITS, &(q("10") - &derivatives[1])));
    meets(&slope, &-Ball::rational(BITS, &derivatives[2]));
}
