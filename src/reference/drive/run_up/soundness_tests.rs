//! Tests of steps from an uncertain start, and of a motion that touches its bound.

use super::integrate::{Walk, integrate_within};
use super::linkage_panel::Panel;
use super::tests::LOW;
use super::*;
use crate::class_iii::{ExactAngle, Geometry, Linkage};
use crate::taylor_model::TaylorModel;
use crate::{Ball, Mag};
use rug::{Float, Rational};

fn start(speed: &Rational) -> Run {
    Run {
        motor: Motor::Rated {
            torque: Rational::from(40),
            overload: Rational::from((22, 10)),
            slip: Rational::from((1, 20)),
            synchronous: Rational::from(10),
        },
        rotor_inertia: Rational::from(2),
        angle: ExactAngle::Radians(Rational::from((1, 3))),
        speed: speed.clone(),
    }
}

/// A step from an uncertain speed ends with every speed that a step from within it ends with, and
/// its duration holds theirs; a start error a hundredth as large would miss some.
#[test]
fn the_start_error_of_a_step_is_carried_on() {
    let model = Coefficients::constant(&Rational::from(3), &Rational::from(-5), 120);
    let speed = Rational::from((7, 2));
    for size in [-20, -30, -50] {
        let radius = Mag::power_of_two(size);
        let mut wide = Walk::new(&model, &start(&speed), 40).unwrap();
        wide.uncertain(radius);
        let piece = wide.step().unwrap();
        let mut most = 0.0f64;
        for sign in [-1, 1] {
            let shift = radius.to_float().to_rational().unwrap() * sign;
            let moved = Rational::from(&speed + &shift);
            let exact = Walk::new(&model, &start(&moved), 40).unwrap();
            let (end, time) = exact.state_at(&piece.x1).unwrap();
            assert!(piece.speed.contains_ball(&end), "{size} {sign}");
            assert!(piece.duration.contains_ball(&time), "{size} {sign}");
            let way = Float::with_val(64, piece.speed.mid() - end.mid()).abs();
            most = most.max((way / piece.speed.rad().to_float()).to_f64());
        }
        assert!(most > 0.01, "{size}: {most}");
    }
}

/// The same for the place where the step begins.
#[test]
fn the_start_of_a_step_may_lie_anywhere_in_its_slack() {
    // Of a linkage, whose inertia and moment depend on the place.
    let model = Coefficients::exact(&LOW);
    let mut run = start(&Rational::from((7, 2)));
    run.angle = ExactAngle::Degrees(Rational::from(40));
    let slack = Mag::power_of_two(-30);
    let mut wide = Walk::new(&model, &run, 40).unwrap();
    wide.displaced(slack);
    let piece = wide.step().unwrap();
    for sign in [-1, 1] {
        let mut moved = Walk::new(&model, &run, 40).unwrap();
        moved.moved(&(slack.to_float() * sign));
        let (end, time) = moved.state_at(&piece.x1).unwrap();
        assert!(piece.speed.contains_ball(&end), "{sign}");
        assert!(piece.duration.contains_ball(&time), "{sign}");
    }
}

/// Steps are counted, and the largest radius of a speed at their ends is told.
#[test]
fn steps_and_radii_are_told() {
    let model = Coefficients::exact(&LOW);
    let mut run = start(&Rational::from((7, 2)));
    run.angle = ExactAngle::Degrees(Rational::from(40));
    for (nodes, told) in [(2, false), (3, true), (4, true)] {
        assert_eq!(Coefficients::splines(&LOW, nodes).is_ok(), told);
    }
    let last = Rational::from((3, 4));
    let motion = integrate_with(&model, &run, std::slice::from_ref(&last), 40).unwrap();
    let mut walk = Walk::new(&model, &run, 40).unwrap();
    let (mut steps, mut largest) = (0, Mag::ZERO);
    let mut time = crate::Ball::integer(120, 0);
    while time.to_f64() < last.to_f64() {
        let piece = walk.step().unwrap();
        largest = largest.max(piece.speed.rad());
        steps += 1;
        time = time + &piece.duration;
        walk.advance(piece, time.clone());
    }
    assert!(steps > 3 && largest.to_f64() > 0.0);
    assert_eq!((motion.steps, motion.largest_radius), (steps, largest));
}

/// A run is given up after its limit of steps.
#[test]
fn steps_have_a_limit() {
    let model = Coefficients::exact(&LOW);
    let mut run = start(&Rational::from((7, 2)));
    run.angle = ExactAngle::Degrees(Rational::from(40));
    let times = [Rational::from((3, 4))];
    let steps = integrate_with(&model, &run, &times, 40).unwrap().steps;
    let within = |most| integrate_within(&model, &run, &times, 40, most);
    assert!(within(steps).is_ok());
    assert!(within(steps - 1).unwrap_err().reason.contains("steps"));
}

/// Times about the end of a panel, of none of which is known on what side it is; the acceleration
/// is another beyond it.
#[test]
fn times_at_the_end_of_a_step_are_read_from_both_steps() {
    let model = |bits: u32, inertias: [i64; 2]| {
        let constant = |x: i64| TaylorModel::constant(&Ball::integer(bits, x));
        let panel = |inertia| Panel {
            inertia: constant(inertia),
            slope: constant(0),
            moment: constant(0),
        };
        Coefficients::of_panels(inertias.map(panel).into(), bits)
    };
    let run = Run {
        motor: Motor::Constant {
            torque: Rational::from(3000),
        },
        rotor_inertia: Rational::new(),
        angle: ExactAngle::Radians(Rational::from((1, 3))),
        speed: Rational::from(1),
    };
    for inertias in [[1, 1000], [1000, 1]] {
        let (coarse, fine) = (model(48, inertias), model(200, inertias));
        let mut walk = Walk::new(&coarse, &run, 20).unwrap();
        let mut end = Ball::integer(48, 0);
        loop {
            let piece = walk.step().unwrap();
            end = &end + &piece.duration;
            if piece.x1 == 1 {
                break;
            }
            walk.advance(piece, end.clone());
        }
        let times = [-0.9, -0.5, 0.1, 0.5, 0.9].map(|part| {
            let t = Float::with_val(200, end.rad().to_float() * part) + end.mid();
            t.to_rational().unwrap()
        });
        let at = |model, order| -> Motion { integrate_with(model, &run, &times, order).unwrap() };
        let (found, due) = (at(&coarse, 20), at(&fine, 90));
        assert_eq!([found.samples.len(), due.samples.len()], [times.len(); 2]);
        for (found, due) in found.samples.iter().zip(&due.samples) {
            assert!(found.speed.contains_ball(&due.speed), "{inertias:?}");
            assert!(found.angle.contains_ball(&due.angle), "{inertias:?}");
        }
    }
}

/// Splines take the values at their nodes, and a segment is as wide as the panels between two of
/// them.
#[test]
fn splines_and_panels_meet_at_the_nodes() {
    let exact = Coefficients::exact(&LOW);
    let splines = Coefficients::splines(&LOW, 12).unwrap();
    let hybrid = Coefficients::hybrid(&LOW, 12).unwrap();
    for (model, times) in [(&splines, 4), (&hybrid, 1)] {
        let width = exact.half_width() * Ball::integer(64, times);
        assert!(model.half_width().overlaps(&width));
    }
    let ends = [-1, 1].map(|x| Ball::integer(64, x));
    for j in 0..12 {
        let [first, last] = [4 * j, 4 * j + 3].map(|k| exact.panel(k).unwrap());
        let spline = splines.panel(j).unwrap();
        for (end, due) in ends.iter().zip([first, last]) {
            for (a, b) in [
                (&spline.inertia, &due.inertia),
                (&spline.moment, &due.moment),
            ] {
                assert!(a.eval(end).overlaps(&b.eval(end)), "{j}");
            }
        }
        for k in 0..4 {
            let part = hybrid.panel(4 * j + k).unwrap();
            let at = Ball::rational(64, &Rational::from((2 * k - 3, 4)));
            let due = spline.slope.eval(&at);
            assert!(part.slope.eval(&Ball::integer(64, 0)).overlaps(&due));
        }
    }
}

/// An angle that is the end of a panel but for rounding is not told from it; one that is exactly
/// there begins it.
#[test]
fn starts_at_the_ends_of_panels() {
    let model = Coefficients::constant(&Rational::from(3), &Rational::from(-5), 120);
    let at = |angle: ExactAngle| {
        let mut run = start(&Rational::from(1));
        run.angle = angle;
        Walk::new(&model, &run, 40).map(drop)
    };
    let zero = Rational::new();
    assert!(at(ExactAngle::Radians(zero.clone())).is_ok());
    assert!(at(ExactAngle::Radians(Rational::from((-1, 3)))).is_ok());
    // Close to an end, but certainly beside it.
    let tiny = Rational::from(1) >> 400u32;
    assert!(at(ExactAngle::Radians(tiny)).is_ok());
    let mut turned = Coefficients::constant(&Rational::from(3), &Rational::from(-5), 120);
    turned.offset = ExactAngle::Degrees(Rational::from(360));
    // Two pi, rounded: within its radius of the offset.
    let near = crate::Ball::pi(120).shift(1).mid().to_rational().unwrap();
    let mut run = start(&Rational::from(1));
    run.angle = ExactAngle::Radians(near);
    assert!(Walk::new(&turned, &run, 40).is_err());
}

/// Checks that a curve that is no motor is refused; the least overload is one.
#[test]
fn motors_that_are_none() {
    let q = |n: i32, d: i32| Rational::from((n, d));
    let kloss = |slip: Rational, speed: Rational| Motor::Kloss {
        breakdown_torque: q(40, 1),
        breakdown_slip: slip,
        synchronous: speed,
    };
    assert!(kloss(q(1, 4), q(10, 1)).fault().is_none());
    assert!(kloss(q(1, 4), q(1, 2)).fault().is_none());
    for (slip, speed) in [
        (q(0, 1), q(10, 1)),
        (q(-1, 4), q(10, 1)),
        (q(1, 4), q(0, 1)),
        (q(1, 4), q(-1, 1)),
    ] {
        assert!(kloss(slip, speed).fault().is_some());
    }
    let rated = |overload: Rational, slip: Rational, speed: Rational| Motor::Rated {
        torque: q(40, 1),
        overload,
        slip,
        synchronous: speed,
    };
    assert!(rated(q(1, 1), q(1, 20), q(10, 1)).fault().is_none());
    assert!(rated(q(11, 10), q(1, 20), q(1, 2)).fault().is_none());
    assert!(rated(q(9, 10), q(1, 20), q(10, 1)).fault().is_some());
    assert!(rated(q(2, 1), q(0, 1), q(10, 1)).fault().is_some());
    assert!(rated(q(2, 1), q(1, 20), q(0, 1)).fault().is_some());
}

/// A turn that ends at another branch's position does not end where it began.
#[test]
fn a_branch_comes_back_as_itself_alone() {
    let (geometry, start) = exchanging();
    let modes = Linkage::new(&geometry, 96)
        .modes(&start.to_ball(96))
        .unwrap();
    let masses = super::tests::masses("9.81");
    let own = &modes[0].configuration;
    let curve = LinkageCurve::new(&geometry, &masses, &start, own, 48, 96);
    for (k, mode) in modes.iter().enumerate() {
        assert_eq!(curve.is_back(&mode.configuration).unwrap(), k == 0);
    }
}

/// A linkage of four branches, and the crank angle at which they are told apart.
fn exchanging() -> (Geometry, ExactAngle) {
    let q = |n: i32| Rational::from((n, 64));
    let geometry = Geometry {
        l1: q(26),
        l2: q(75),
        l3: q(82),
        l4: q(38),
        l5: q(112),
        lb: q(22),
        phi_b: ExactAngle::Radians(q(148)),
        o3: [q(-5), q(-36)],
        o5: [q(-60), q(-49)],
    };
    (geometry, ExactAngle::Radians(Rational::from((1, 4))))
}

/// Of two branches over the whole turn one comes back as itself and one as another: beyond that
/// turn it is refused, and so are splines over it, whichever is asked for first.
#[test]
fn branches_that_exchange_in_a_turn_are_refused() {
    let bits = 96;
    let (geometry, start) = exchanging();
    let linkage = Linkage::new(&geometry, bits);
    let modes = linkage.modes(&start.to_ball(bits)).unwrap();
    assert_eq!(modes.len(), 4);
    let mut told = Vec::new();
    for mode in &modes {
        let curve = || {
            let masses = super::tests::masses("9.81");
            LinkageCurve::new(&geometry, &masses, &start, &mode.configuration, 48, bits)
        };
        let (by_panels, by_nodes) = (curve(), curve());
        // The others have no whole turn.
        if by_panels.panel(47).is_err() {
            continue;
        }
        let beyond = by_panels.panel(48).is_ok();
        assert_eq!(by_panels.nodes(48).is_ok(), beyond);
        assert_eq!(by_nodes.nodes(48).is_ok(), beyond);
        assert_eq!(by_nodes.panel(48).is_ok(), beyond);
        if beyond {
            let [first, after] = [0, 48].map(|k| by_panels.panel(k).unwrap());
            assert!(std::sync::Arc::ptr_eq(&first, &after));
        }
        told.push(beyond);
    }
    assert_eq!(told, [false, true]);
}
