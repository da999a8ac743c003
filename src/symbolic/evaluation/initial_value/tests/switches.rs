//! Motions that cross switches.

use super::super::MotionError;
use super::super::crossing::{cross, enclosed, times};
use super::super::field::Smooth;
use super::{bits, check_derivatives, decimals, problem, trajectory, with_inputs};
use crate::evaluation::taylor::{Side, Switch};
use crate::evaluation::{Balls, Evaluator, Value};
use mechaudit_reference::Ball;
use mechaudit_reference::elementary as real;
use rug::Rational;

/// Motions whose rates change from one formula to another, in closed form.
#[test]
fn switches() {
    let at = |text: &str, t: (i64, i64)| {
        let mut motion = trajectory(text);
        let found = motion.at(&Rational::from(t), bits(25));
        let decimal = |ball: &Ball| ball.to_decimal(20).unwrap_or_else(|| format!("{ball:?}"));
        (
            found.map(|balls| decimal(&balls[0])),
            motion
                .switches()
                .into_iter()
                .map(|s| s.0)
                .collect::<Vec<_>>(),
        )
    };
    // x = cos t until π/2, then x″ = −4x: x = −sin(2(t − π/2))/2, then cos again.
    let spring = "x = 1 -> v; v = 0 -> -if(x < 0, 4*x, x)";
    assert_eq!(at(spring, (1, 1)).0, Ok("0.54030230586813971740".into()));
    assert_eq!(at(spring, (2, 1)).0, Ok("-0.37840124765396412569".into()));
    let absolute = at("y = -1 -> 1 + abs(y)/2", (3, 1));
    // y = 2 − 3 e^{−t/2} until y = 0 at t_1 = 2 log(3/2), then y = 2 (e^{(t − t_1)/2} − 1).
    assert_eq!(absolute.0, Ok("3.9755854271174197635".into()));
    let half_turn = Ball::pi(200).shift(-1);
    let first = &at(spring, (2, 1)).1[0];
    assert!(
        first.overlaps(&half_turn) && first.accuracy_bits() > 100,
        "{first:?}"
    );
    // The steps of floor are at 1 and 2.
    assert_eq!(
        at("y = 0 -> floor(t)", (5, 2)).0,
        Ok("2.0000000000000000000".into())
    );
    assert_eq!(
        at("y = 0 -> fmax(t - 1, 0)", (3, 1)).0,
        Ok("2.0000000000000000000".into())
    );
    // y = (t − 1)² − 1/4 is below zero for a time of 1 within a step.
    let below = "z = 0 -> if(y < 0, 1, 0); y = 3/4 -> 2*(t - 1)";
    assert_eq!(at(below, (3, 1)).0, Ok("1.0000000000000000000".into()));
    // A start at a switch that the motion leaves.
    assert_eq!(
        at("y = 0 -> 1 + abs(y)", (1, 1)).0,
        Ok("1.7182818284590452354".into())
    );
    let before = at("y = 1 -> if(y > 0, -1, 1)", (1, 2)).0;
    assert_eq!(before, Ok("0.50000000000000000000".into()));
    // Where the rate is zero at the switch alone the motion may stay there.
    for text in [
        "y = 0 -> if(y == 1, 0, 1)",
        "y = 1 -> if(y == 1, 0, 1)",
        "y = 2 -> if(y == 1, 0, -1)",
        "y = 0 -> if(y >= 1 and y <= 1, 0, 1)",
        "y = 0 -> if(not (y < 1 or y > 1), 0, 1)",
    ] {
        let found = at(text, (2, 1)).0;
        assert!(
            matches!(
                found,
                Err(MotionError::Undecided { .. } | MotionError::Rate { .. })
            ),
            "{text}: {found:?}"
        );
    }
    // y′ = y + 1 but at one value, where y′ = 1.
    assert_eq!(
        at("y = 0 -> 1 + if(y != 1/3, y, 0)", (1, 1)).0,
        Ok("1.7182818284590452354".into())
    );
    assert_eq!(
        at("y = 0 -> if(t == 1, 100, 1)", (2, 1)).0,
        Ok("2.0000000000000000000".into())
    );
    // Motion that touches a switch.
    let touching = at("y = 1 -> v; v = -2 -> if(y > 0, 2, 0)", (3, 1));
    assert!(
        matches!(touching.0, Err(MotionError::Undecided { .. })),
        "{touching:?}"
    );
}

/// Rates that jump: the derivatives jump with them.
#[test]
fn derivatives_across_switches() {
    // Reaches 1 at t = 1 − p, then moves twice as fast: y = 1 + 2 (t − 1 + p).
    let rise = || with_inputs(&[("p", (1, 4))], "y = p -> if(y < 1, 1, 2)");
    check_derivatives(rise(), (1, 2), &[1.0, 1.0]);
    check_derivatives(rise(), (2, 1), &[2.0, 2.0]);
    check_derivatives(rise(), (0, 1), &[1.0, 1.0]);
    // The time of the switch is a parameter: y = q + k (t − q).
    let inputs = [("q", (1, 3)), ("k", (5, 1))];
    let turn = with_inputs(&inputs, "y = 0 -> if(t < q, 1, k)");
    check_derivatives(turn, (3, 1), &[1.0, -4.0, 8.0 / 3.0]);
    // Rates that are continuous: y = −(p − t)²/2 up to t = p, then (t − p)²/2.
    let smooth = with_inputs(&[("p", (1, 3))], "y = -p^2/2 -> abs(t - p)");
    check_derivatives(smooth, (1, 1), &[1.0, -2.0 / 3.0]);
    // Up with 1 and down with −3, and the sum of both as a second state.
    let text = "y = 0 -> if(t < p, 1, -3); z = 0 -> y";
    let both = with_inputs(&[("p", (1, 2))], text);
    check_derivatives(both, (1, 1), &[1.0, 0.0, 4.0, 1.0, 1.0, 2.0]);
    // x = cos t, then −2 sin((t − π/2)/2): by the start (x = a cos t), x at π/2 switches at the
    // same time whatever a is.
    let spring = with_inputs(&[], "x = 1 -> v; v = 0 -> -if(x < 0, x/4, x)");
    let t = 2.0 - std::f64::consts::FRAC_PI_2;
    let (s, c) = (t / 2.0).sin_cos();
    check_derivatives(spring, (2, 1), &[-2.0 * s, c, -c, -s / 2.0]);
}

/// Switches at one instant: times that steps of floor share, and a place at a time.
#[test]
fn switches_at_one_instant() {
    let at = |text: &str, t: (i64, i64)| decimals(&mut trajectory(text), t, 15)[0].clone();
    // ∫ floor(t) + floor(2t) over [0, 5/2] is 3/2 + 1 and 1/2 + 1 + 3/2 + 2.
    assert_eq!(
        at("y = 0 -> floor(t) + floor(2*t) - 1/2", (5, 2)),
        "5.75000000000000"
    );
    // y = t up to 1, where both switch; then the rate is 2 + 3.
    let both = "y = 0 -> if(y < 1, 1, 2) + if(t < 1, 0, 3)";
    assert_eq!(at(both, (2, 1)), "6.00000000000000");
    assert_eq!(at(both, (1, 2)), "0.500000000000000");
    let three = "y = 0 -> 1 + if(y < 1, 0, 2) + if(z < 2, 0, 3) + floor(t); z = 1 -> 1";
    assert_eq!(at(three, (3, 2)), "4.50000000000000");
    // Two of the same: they come to rest at once.
    let twins = "x = 0 -> v; v = 1 -> -if(v > 0, 1, 2); y = 0 -> w; w = 1 -> -if(w > 0, 1, 2)";
    assert_eq!(at(twins, (2, 1)), "-0.500000000000000");
    // One that is crossed and one that is touched.
    let touched = at(
        "y = -1 -> 1 + if(t < 1, 0, 1); z = 1 -> if(y < 0, -1, 1)*abs(z)",
        (3, 1),
    );
    assert_eq!(touched, "4.00000000000000");
    // Times that nothing moves: the derivatives pass.
    let steps = with_inputs(&[("k", (3, 1))], "y = 1 -> k*(floor(t) + floor(2*t))");
    check_derivatives(steps, (9, 4), &[1.0, 5.5]);
    // A place that moves and a time that does not: which comes first decides.
    let both = with_inputs(
        &[("k", (1, 1))],
        "y = 0 -> k + if(y < 1, 0, 1) + if(t < 1, 0, 3)",
    );
    check_derivatives(both, (2, 1), &[f64::NAN, f64::NAN]);
}

#[test]
fn starts_at_switches() {
    let start = |text: &str| with_inputs(&[("k", (2, 1))], text);
    // The start does not leave the switch with k: v = −3kt; with v it does.
    let rest = start("x = 1 -> v; v = 0 -> -k*if(v > 0, 1, 3)");
    check_derivatives(rest, (1, 1), &[1.0, f64::NAN, -1.5, 0.0, f64::NAN, -3.0]);
    let rest = start("x = 1 -> v; v = 0 -> -k*if(v > 0, 1, 3)");
    check_derivatives(rest, (0, 1), &[1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
    let moved = start("y = k - 2 -> 1 + if(y < 0, 0, 1)");
    check_derivatives(moved, (1, 1), &[f64::NAN, f64::NAN]);
    // Two at once.
    let both = start("y = 0 -> k + abs(y) + floor(t)");
    let e = std::f64::consts::E.sqrt();
    check_derivatives(both, (1, 2), &[f64::NAN, e - 1.0]);
}

/// The fields of a problem without inputs on sides of its first switch, at a time and states.
fn fields(text: &str, sides: &[Side], time: (i64, i64)) -> (Vec<Smooth>, Vec<Switch>) {
    let problem = problem(text).unwrap();
    let mut evaluator = Evaluator::new(problem.graph.clone(), Balls::new(128));
    evaluator.set_input(0, Value::rational(128, Rational::from(time)));
    let switches: Vec<Switch> = problem.switches.iter().map(|s| s.0).collect();
    let field = |side: &Side| {
        let known = switches.first().map(|s| (*s, side.clone()));
        Smooth::new(&problem, &mut evaluator, &known.into_iter().collect()).unwrap()
    };
    (sides.iter().map(field).collect(), switches)
}

/// From y = 1/2 with the rate −1 it takes at least 1/2 to come to rest at zero.
#[test]
fn a_switch_is_reached_before_the_motion_slides() {
    let sides = [Side::Positive, Side::Negative];
    let (pieces, switches) = fields("y = 0 -> if(y > 0, -1, 1)", &sides, (0, 1));
    let pieces: Vec<&Smooth> = pieces.iter().collect();
    let [start, half] = [(0, 1), (1, 2)].map(Rational::from);
    let states = [Ball::rational(128, &half)];
    let width = (Rational::from((1, 64)), false);
    let Ok(crossing) = cross((&start, &states), &pieces, &switches, width, 128) else {
        panic!("not crossed")
    };
    assert!(
        crossing.slides && crossing.after >= half,
        "{}",
        crossing.after
    );
}

/// e^t over a quarter.
#[test]
fn all_solutions_are_in_the_box_of_a_way_across() {
    let (pieces, _) = fields("y = 1 -> y", &[Side::Positive], (0, 1));
    let [start, quarter] = [(0, 1), (1, 4)].map(Rational::from);
    let span = times(128, &start, &quarter);
    let way = Ball::rational(128, &quarter);
    let (hull, end) = enclosed(&[Ball::integer(128, 1)], &[&pieces[0]], &span, &way).unwrap();
    let due = real::exp(&way, 128).unwrap();
    assert!(
        end[0].contains_ball(&due) && hull[0].contains_ball(&due),
        "{hull:?} {end:?}"
    );
}
