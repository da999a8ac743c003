//! Where a step is ended: at angles, speeds and turning points, on a motion that is known.

use super::crossing::{Limits, Pause, crossing};
use super::integrate::Counts;
use super::runner::neighbours;
use super::stepper::{Method, State, Stepper, Tried};
use super::stepper::{PHI, PSI};
use differential_equations::ode::ODE;
use std::f64::consts::TAU;

/// One step from `a` to `b` of a motion.
struct Known<F: Fn(f64) -> State>(f64, f64, State, F);

impl<F: Fn(f64) -> State> Known<F> {
    fn new(a: f64, b: f64, f: F) -> Known<F> {
        Known(a, b, f(b), f)
    }
}

impl<F: Fn(f64) -> State> Stepper for Known<F> {
    fn step(&mut self, _: &dyn ODE<f64, State>, _: f64) -> Tried {
        unreachable!("one step")
    }
    fn proposed(&self) -> f64 {
        self.1 - self.0
    }
    fn t(&self) -> f64 {
        self.1
    }
    fn y(&self) -> &State {
        &self.2
    }
    fn t_before(&self) -> f64 {
        self.0
    }
    fn between(&mut self, t: f64) -> State {
        assert!(self.0 <= t && t <= self.1);
        (self.3)(t)
    }
}

fn state(phi: f64, psi: f64) -> State {
    let mut y = [0.0; 6];
    (y[PHI], y[PSI]) = (phi, psi);
    y
}

const OPEN: (f64, f64) = (f64::NEG_INFINITY, f64::INFINITY);

fn limits(angles: (f64, f64), speeds: (f64, f64)) -> Limits {
    Limits {
        end: 10.0,
        angles,
        speeds,
        extrema: false,
    }
}

#[test]
fn limits_are_met_to_the_last_bit() {
    // φ = 2t, ψ = 5 − t from 1 to 3.
    let at = |limits: Limits| {
        let mut s = Known::new(1.0, 3.0, |t| state(2.0 * t, 5.0 - t));
        crossing(&mut s, &limits, &mut None, &|_, _| {
            unreachable!("no turning points")
        })
    };
    let close = |found: Option<(f64, Pause)>, t: f64, pause: Pause| {
        let (at, what) = found.expect("a crossing");
        assert!(what == pause && at >= t && at - t < 2e-15, "{at} {what:?}");
    };
    // In every quarter of the step.
    for t in [1.2, 1.7, 2.3, 2.9] {
        close(at(limits((0.0, 2.0 * t), OPEN)), t, Pause::Angle(2.0 * t));
        close(at(limits(OPEN, (5.0 - t, 9.0))), t, Pause::Speed(5.0 - t));
    }
    assert_eq!(at(limits((0.0, 6.0), (2.0, 4.0))), None);
    // The earlier of two.
    close(at(limits((0.0, 3.0), (3.0, 9.0))), 1.5, Pause::Angle(3.0));
    close(
        at(limits((0.0, 3.2), (3.45, 9.0))),
        1.55,
        Pause::Speed(3.45),
    );
    // Backwards and faster.
    let mut s = Known::new(1.0, 3.0, |t| state(-2.0 * t, 5.0 + t));
    let never = |_: f64, _: &State| unreachable!("no turning points");
    let found = crossing(&mut s, &limits((-5.0, 0.0), OPEN), &mut None, &never);
    close(found, 2.5, Pause::Angle(-5.0));
    let found = crossing(&mut s, &limits(OPEN, (0.0, 6.5)), &mut None, &never);
    close(found, 1.5, Pause::Speed(6.5));
}

/// A turning point lies where the acceleration changes its sign; one that begins with zero takes
/// its sign from the first look.
#[test]
fn turning_points() {
    for sign in [1.0, -1.0] {
        for zero in [1.3, 1.9, 2.4, 2.95] {
            let mut s = Known::new(1.0, 3.0, |t| state(t, t));
            let acceleration = |_: f64, y: &State| sign * (zero - y[PSI]);
            let mut before = Some(sign * (zero - 1.0));
            let (t, what) = crossing(&mut s, &limits(OPEN, OPEN), &mut before, &acceleration)
                .expect("a turning point");
            assert!(what == Pause::Extremum && (t - zero).abs() < 2e-15, "{t}");
        }
        let mut s = Known::new(1.0, 3.0, |t| state(t, t));
        let acceleration = |_: f64, y: &State| sign * (y[PSI] - 1.0) * (2.75 - y[PSI]);
        let mut before = Some(0.0);
        let (t, _) = crossing(&mut s, &limits(OPEN, OPEN), &mut before, &acceleration)
            .expect("a turning point");
        assert!((t - 2.75).abs() < 2e-15, "{t}");
        // None: what is known afterwards is the sign at the end.
        let mut before = Some(sign);
        let steady = |_: f64, y: &State| sign * y[PSI];
        assert_eq!(
            crossing(&mut s, &limits(OPEN, OPEN), &mut before, &steady),
            None
        );
        assert_eq!(before, Some(3.0 * sign));
    }
}

#[test]
fn neighbours_among_whole_turns() {
    let angles = [0.5, 2.0, 5.0];
    for turns in [-4.0, -1.0, 0.0, 3.0] {
        let off = turns * TAU;
        let check = |phi: f64, low: f64, high: f64| {
            let (a, b) = neighbours(&angles, phi + off);
            assert!(
                (a - low - off).abs() < 1e-13 && (b - high - off).abs() < 1e-13,
                "{a} {b}"
            );
        };
        check(1.0, 0.5, 2.0);
        check(3.0, 2.0, 5.0);
        check(0.1, 5.0 - TAU, 0.5);
        check(6.0, 5.0, 0.5 + TAU);
        // One that it stands on is neither before nor after.
        check(2.0, 0.5, 5.0);
        check(2.0 + 1e-14, 0.5, 5.0);
        check(2.0 + 1e-9, 2.0, 5.0);
        check(2.0 - 1e-9, 0.5, 2.0);
    }
    assert_eq!(neighbours(&[], 1.0), OPEN);
    let (a, b) = neighbours(&[1.0], 1.0);
    assert!((a - (1.0 - TAU)).abs() < 1e-15 && (b - (1.0 + TAU)).abs() < 1e-15);
}

#[test]
fn counts_add_up() {
    let a = Counts {
        steps: 2,
        rejected: 3,
        retaken: 5,
        evaluations: 7,
    };
    let b = Counts {
        steps: 11,
        rejected: 13,
        retaken: 17,
        evaluations: 19,
    };
    let due = Counts {
        steps: 13,
        rejected: 16,
        retaken: 22,
        evaluations: 26,
    };
    assert_eq!(a.plus(b), due);
    let names: Vec<&str> = Method::ALL.iter().map(|m| m.name()).collect();
    assert_eq!(names, ["verner98", "dop853", "radau5"]);
}
