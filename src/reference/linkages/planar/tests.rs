//! Positions, series, reactions and motion against closed forms and against each other.

use super::*;
use crate::class_iii::ExactAngle;
use crate::class_iii::tests::q;
use crate::dyad;
use crate::{Ball, Mag};
use rug::{Float, Rational};

pub(super) fn at(x: &str, y: &str) -> Point {
    [q(x), q(y)]
}

pub(super) fn pin(a: Attachment, b: Attachment) -> Joint {
    Joint::Pin { a, b }
}

fn unloaded() -> Forces {
    Forces {
        drive: Rational::new(),
        springs: Vec::new(),
        gravity: at("0", "0"),
    }
}

pub(super) const BITS: u32 = 192;

pub(super) fn ball(text: &str) -> Ball {
    Ball::rational(BITS, &q(text))
}

pub(super) fn guess(x: &[f64]) -> Vec<Float> {
    x.iter().map(|x| Float::with_val(64, *x)).collect()
}

pub(super) fn origin() -> Point {
    at("0", "0")
}

/// Crank, coupler, rocker with the lengths 2, 7/2, 3 and the frame 4 along x; the coupler carries a
/// mass off its axis.
pub(super) fn four_bar() -> Mechanism {
    let massless = bars(["2", "3.5", "3", "4"]);
    let mut bodies = massless.bodies().to_vec();
    for (k, body) in bodies.iter_mut().enumerate() {
        body.mass = Rational::from(k as u32 + 1);
        body.inertia = Rational::from((1, k as u32 + 2));
        body.centre = at("0.75", "0.5");
    }
    Mechanism::new(bodies, massless.joints().to_vec()).unwrap()
}

/// Crank, coupler, rocker and frame of these lengths, without masses.
pub(super) fn bars([crank, coupler, rocker, frame]: [&str; 4]) -> Mechanism {
    let b = Attachment::body;
    let joints = vec![
        pin(Attachment::ground(origin()), b(0, origin())),
        pin(b(0, at(crank, "0")), b(1, origin())),
        pin(Attachment::ground(at(frame, "0")), b(2, origin())),
        pin(b(1, at(coupler, "0")), b(2, at(rocker, "0"))),
    ];
    let bodies = ["crank", "coupler", "rocker"].map(Body::massless);
    Mechanism::new(bodies.to_vec(), joints).unwrap()
}

pub(super) fn cranked(mechanism: &Mechanism) -> Linkage {
    Linkage::new(mechanism, &Drive::coordinate(0), BITS).unwrap()
}

pub(super) fn meets(a: &Ball, b: &Ball) {
    let near = (a - b).magnitude() < Mag::power_of_two(-150);
    assert!(a.overlaps(b) && near, "{a:?} {b:?}");
}

#[test]
fn a_four_bar_by_circles() {
    let linkage = cranked(&four_bar());
    let lengths = ["2", "3.5", "3", "4"].map(q);
    for (phi, start) in [("0.9", [0.9, 0.5, 1.6]), ("2.5", [2.5, 0.6, 2.3])] {
        let due = dyad::four_bar(&lengths, &q(phi), true, BITS).unwrap();
        let position = linkage.position(&ball(phi), &guess(&start)).unwrap();
        let series = linkage.series(&position, 2).unwrap();
        for (k, angle) in [(1, &due.coupler), (2, &due.rocker)] {
            meets(series.coefficient(k, 0), &angle[0]);
            meets(series.coefficient(k, 1), &angle[1]);
            meets(&series.coefficient(k, 2).shift(1), &angle[2]);
        }
    }
}

#[test]
fn a_slider_crank_by_its_quadratic() {
    let b = Attachment::body;
    let bodies = ["crank", "rod", "slider"].map(Body::massless).to_vec();
    let joints = vec![
        pin(Attachment::ground(origin()), b(0, origin())),
        pin(b(0, at("1", "0")), b(1, origin())),
        Joint::Slide {
            a: Attachment::ground(at("0", "0.5")),
            direction: at("1", "0").map(Real::from),
            b: b(2, origin()),
            turn: ExactAngle::Radians(q("0.25")),
        },
        pin(b(1, at("4", "0")), b(2, origin())),
    ];
    let mechanism = Mechanism::new(bodies, joints).unwrap();
    let due =
        dyad::slider_crank(&["1", "4", "0.5"].map(q), &q("0"), &q("0.7"), true, BITS).unwrap();
    let position = cranked(&mechanism)
        .position(&ball("0.7"), &guess(&[0.7, 0.0, 0.25, 4.7]))
        .unwrap();
    let series = cranked(&mechanism).series(&position, 2).unwrap();
    for (k, value) in [(1, &due.rod), (3, &due.slider)] {
        meets(series.coefficient(k, 0), &value[0]);
        meets(series.coefficient(k, 1), &value[1]);
        meets(&series.coefficient(k, 2).shift(1), &value[2]);
    }
    meets(&position.x[2], &ball("0.25"));
    // The same with the slider for a drive.
    let slid = Linkage::new(&mechanism, &Drive::coordinate(3), BITS).unwrap();
    let back = slid
        .position(&position.x[3], &position.midpoints())
        .unwrap();
    meets(&back.x[0], &ball("0.7"));
}

/// A crank of length 1 about (0, 2) whose pin runs in a slot through the origin of a rocker:
/// `ψ = arg(2i + e^{iφ})`. Gears turn another body by −3/2 of the rocker's angle, and a rack moves
/// by 2 ψ.
#[test]
fn a_slot_a_gear_and_a_rack() {
    let b = Attachment::body;
    let bodies = ["crank", "rocker", "gear", "rack"]
        .map(Body::massless)
        .to_vec();
    let joints = vec![
        pin(Attachment::ground(at("0", "2")), b(0, origin())),
        pin(Attachment::ground(origin()), b(1, origin())),
        Joint::Slot {
            a: b(1, origin()),
            direction: at("0.5", "0").map(Real::from),
            b: b(0, at("1", "0")),
        },
        pin(Attachment::ground(at("5", "0")), b(2, origin())),
        Joint::Gear {
            a: Frame::Body(1),
            b: Frame::Body(2),
            carrier: Frame::Ground,
            ratio: q("-1.5"),
            offset: ExactAngle::Degrees(q("60")),
        },
        Joint::Slide {
            a: Attachment::ground(origin()),
            direction: at("0", "1").map(Real::from),
            b: b(3, origin()),
            turn: ExactAngle::Radians(q("0")),
        },
        Joint::Rack {
            pinion: Frame::Body(1),
            slide: 5,
            ratio: q("2"),
            offset: q("-1"),
        },
    ];
    let mechanism = Mechanism::new(bodies, joints).unwrap();
    let position = cranked(&mechanism)
        .position(&ball("0.4"), &guess(&[0.4, 1.2, -0.8, 0.0, 5.0, 1.4]))
        .unwrap();
    let (s, c) = ball("0.4").sin_cos();
    let y = s + Ball::integer(BITS, 2);
    let psi = y.atan2(&c);
    meets(&position.x[1], &psi);
    let third = Ball::pi(BITS) / Ball::integer(BITS, 3);
    meets(&position.x[2], &(third - &psi * &ball("1.5")));
    meets(&position.x[4], &(c.square() + y.square()).sqrt().shift(1));
    meets(&position.x[5], &(psi.shift(1) - Ball::integer(BITS, 1)));
}

/// Six orders carry a position over a twentieth of a radian.
#[test]
fn series_follow_the_path() {
    let linkage = cranked(&four_bar());
    let position = linkage
        .position(&ball("0.9"), &guess(&[0.9, 0.5, 1.6]))
        .unwrap();
    let moved = linkage
        .position(&ball("0.95"), &position.midpoints())
        .unwrap();
    let mut last = f64::INFINITY;
    for order in 1..=6 {
        let series = linkage.series(&position, order).unwrap();
        let sum = |i: usize| {
            let terms = series.of(i).iter().rev();
            terms.fold(Ball::integer(BITS, 0), |s, c| &s * &ball("0.05") + c)
        };
        let off = (0..3).map(|i| (sum(i) - &moved.x[i]).magnitude().to_f64());
        let off = off.fold(0.0, f64::max);
        assert!(off < 0.2 * last, "{order}: {off} after {last}");
        last = off;
    }
    assert!(last < 1e-8, "{last}");
}

/// `Q − λ = I b'' + ½ I' b'² + V'`: the drive's multiplier is what the energy of the whole says.
#[test]
fn the_drive_s_multiplier_balances_the_power() {
    let mechanism = four_bar();
    let linkage = cranked(&mechanism);
    let position = linkage
        .position(&ball("0.9"), &guess(&[0.9, 0.5, 1.6]))
        .unwrap();
    let forces = Forces {
        drive: q("3"),
        springs: vec![Spring {
            a: Attachment::body(1, at("1", "1")),
            b: Attachment::ground(at("-1", "3")),
            stiffness: q("7"),
            length: q("1.5"),
        }],
        gravity: at("0.5", "-9.81"),
    };
    let (speed, acceleration) = (ball("1.7"), ball("-0.6"));
    let rates = linkage.in_time(&position, &speed, &acceleration).unwrap();
    let multipliers = linkage.multipliers(&position, &rates, &forces).unwrap();
    let inertia = linkage.reduced_inertia(&linkage.series(&position, 2).unwrap());
    let load = super::energy::Load::new(&mechanism, &forces, BITS);
    let potential = load.potential_series(&linkage.series(&position, 1).unwrap());
    let due =
        &inertia[0] * &acceleration + (&inertia[1] * &speed.square()).shift(-1) + &potential[1];
    meets(&multipliers[2], &(ball("3") - due));
    meets(&linkage.potential(&position, &forces), &potential[0]);
}

/// A mass of 2 on a slide under a constant force 3 and a spring of 8 without length of its own:
/// `s = (3/8) (1 − cos 2t)`, which turns at t = π/2.
pub(super) fn oscillator() -> (Linkage, Forces) {
    let mut mass = Body::massless("mass");
    mass.mass = q("2");
    let joints = vec![Joint::Slide {
        a: Attachment::ground(origin()),
        direction: at("1", "0").map(Real::from),
        b: Attachment::body(0, origin()),
        turn: ExactAngle::Radians(q("0")),
    }];
    let mechanism = Mechanism::new(vec![mass], joints).unwrap();
    let forces = Forces {
        drive: q("3"),
        springs: vec![Spring {
            a: Attachment::body(0, at("10", "0")),
            b: Attachment::ground(at("0", "0")),
            stiffness: q("8"),
            length: q("10"),
        }],
        gravity: origin(),
    };
    let linkage = Linkage::new(&mechanism, &Drive::coordinate(1), BITS).unwrap();
    (linkage, forces)
}

#[test]
fn an_oscillator_by_its_cosine() {
    let (linkage, forces) = oscillator();
    let times = ["0.1", "0.7", "1.2"].map(q);
    let course = linkage
        .from_rest(&ball("0"), &guess(&[0.0, 0.0]), &forces, &times)
        .unwrap();
    assert_eq!(course.moments.len(), 3);
    assert!(course.first_acceleration.overlaps(&ball("1.5")));
    for m in &course.moments {
        let (s, c) = Ball::rational(BITS, &m.time).shift(1).sin_cos();
        let part = ball("0.375");
        meets(&m.drive, &(&part * &(Ball::integer(BITS, 1) - &c)));
        meets(&m.rates.drive[0], &(&part * &s).shift(1));
        meets(&m.rates.drive[1], &(&part * &c).shift(2));
        assert!(m.drive.accuracy_bits() > 150);
    }
    // Beyond the turning point nothing is claimed.
    let late = linkage.from_rest(&ball("0"), &guess(&[0.0, 0.0]), &forces, &[q("1.6")]);
    assert!(late.is_err());
    // Nor with the force the other way.
    let backwards = Forces {
        drive: q("-3"),
        ..forces
    };
    assert!(
        linkage
            .from_rest(&ball("0"), &guess(&[0.0, 0.0]), &backwards, &times)
            .is_err()
    );
}

/// A pendulum of length 1/2 let go at 90°: a quarter of its period is `K(sin 45°)/ω`, by the
/// arithmetic-geometric mean.
#[test]
fn a_pendulum_by_its_elliptic_integral() {
    let mut bob = Body::massless("bob");
    bob.mass = q("3");
    bob.centre = at("0.5", "0");
    let joints = vec![pin(
        Attachment::ground(origin()),
        Attachment::body(0, origin()),
    )];
    let mechanism = Mechanism::new(vec![bob], joints).unwrap();
    let forces = Forces {
        gravity: at("9.81", "0"),
        ..unloaded()
    };
    // ψ = 0 is the lowest position.
    let quarter = Ball::pi(BITS).shift(-1);
    let start = -&quarter;
    let one = Float::with_val(BITS, 1);
    let mean = one.clone().agm(&(Float::with_val(BITS, 0.5).sqrt()));
    let time = Ball::new(mean, Mag::power_of_two(4 - i64::from(BITS)));
    let time = &quarter / &time / (ball("9.81").shift(1)).sqrt();
    // A rational next to it; the pendulum goes 2^−100 further at its speed there.
    let near = Float::with_val(100, time.mid()).to_rational().unwrap();
    let course = cranked(&mechanism)
        .from_rest(
            &start,
            &guess(&[-1.57]),
            &forces,
            std::slice::from_ref(&near),
        )
        .unwrap();
    let m = &course.moments[0];
    let speed = ball("39.24").sqrt();
    let due = &speed * &(Ball::rational(BITS, &near) - &time);
    assert!(
        (&m.drive - &due).magnitude() < Mag::power_of_two(-150),
        "{:?}",
        m.drive
    );
    assert!((&m.rates.drive[0] - &speed).magnitude() < Mag::power_of_two(-150));
}

#[test]
fn what_is_no_mechanism_is_told_as_such() {
    let b = Attachment::body;
    let hung = || pin(Attachment::ground(origin()), b(0, origin()));
    let one = || vec![Body::massless("one")];
    let two = || ["one", "two"].map(Body::massless).to_vec();
    let error = |bodies, joints| Mechanism::new(bodies, joints).unwrap_err().to_string();
    assert_eq!(
        error(two(), vec![hung()]),
        "body two is not joined to the ground by pins, slides or slots"
    );
    assert_eq!(
        error(two(), vec![hung(), pin(b(0, at("1", "0")), b(1, origin()))]),
        "0 equations for 2 coordinates: 2 degrees of freedom instead of one"
    );
    assert_eq!(
        error(
            one(),
            vec![
                hung(),
                pin(Attachment::ground(at("1", "0")), b(0, at("1", "0")))
            ]
        ),
        "2 equations for 1 coordinates: -1 degrees of freedom instead of one"
    );
    assert_eq!(
        error(one(), vec![pin(b(0, origin()), b(0, origin()))]),
        "joint 0 joins a body to itself"
    );
    assert_eq!(
        error(one(), vec![hung(), pin(b(0, origin()), b(7, origin()))]),
        "joint 1 names a body or joint that does not exist"
    );
    let mechanism = Mechanism::new(one(), vec![hung()]).unwrap();
    for drive in [Drive(Vec::new()), Drive::coordinate(1)] {
        let refused = Linkage::new(&mechanism, &drive, BITS).unwrap_err();
        assert_eq!(refused, MechanismError::Drive);
    }
}

/// Newton and Euler's equations against the multipliers of the loops: the drive's torque and the
/// force in the pin that closes the loop.
#[test]
fn forces_in_pins_are_those_of_the_multipliers() {
    let linkage = cranked(&four_bar());
    let phi = ball("0.9");
    let position = linkage.position(&phi, &guess(&[0.9, 0.5, 1.6])).unwrap();
    let rates = linkage.in_time(&position, &ball("3"), &ball("-7")).unwrap();
    let forces = Forces {
        gravity: at("0.5", "-9.75"),
        ..unloaded()
    };
    let multipliers = linkage.multipliers(&position, &rates, &forces).unwrap();
    let found = linkage
        .joint_forces(&linkage.series(&position, 2).unwrap(), &rates, &forces)
        .unwrap();
    meets(&found.drive, &-&multipliers[2]);
    // The closure is coupler's end less rocker's: its multipliers act on the rocker.
    meets(&found.pins[3][0], &multipliers[0]);
    meets(&found.pins[3][1], &multipliers[1]);
    // The torque from the reduced quantities.
    let inertia = linkage.reduced_inertia(&linkage.series(&position, 2).unwrap());
    let [moment, _] = linkage.reduced_force(&linkage.series(&position, 2).unwrap(), &forces);
    let due = &inertia[0] * &ball("-7") + (&inertia[1] * &ball("9")).shift(-1) - moment;
    meets(&found.drive, &due);
}
