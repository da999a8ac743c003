//! What a step carries on: an uncertain start, and a motion that touches its bound.

use super::integrate::Walk;
use super::tests::LOW;
use super::*;
use crate::Mag;
use crate::class_iii::ExactAngle;
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

/// A step from an uncertain speed ends with every speed that a step from within it ends with, and its duration holds
/// theirs; a start error a hundredth as large would miss some.
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
