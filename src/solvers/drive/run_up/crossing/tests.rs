//! Where a step is looked at, and what counts as outside.

use super::*;
use crate::run_up::stepper::Tried;
use differential_equations::ode::ODE;

/// A step from `.0` to `.1` of the motion `.2`, with the moments at which it was looked at.
struct Watched<F>(f64, f64, State, F, Vec<f64>);

impl<F: Fn(f64) -> State> Stepper for Watched<F> {
    fn step(&mut self, _: &dyn ODE<f64, State>, _: f64) -> Tried {
        unreachable!("one step")
    }
    fn proposed(&self) -> f64 {
        unreachable!("one step")
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
        self.4.push(t);
        (self.3)(t)
    }
}

fn watched<F: Fn(f64) -> State>(a: f64, b: f64, f: F) -> Watched<F> {
    Watched(a, b, f(b), f, Vec::new())
}

fn state(phi: f64, psi: f64) -> State {
    [phi, psi, 0.0, 0.0, 0.0, 0.0]
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

/// The edges themselves are inside.
#[test]
fn the_motion_may_stand_on_an_edge() {
    let l = limits((1.0, 2.0), (3.0, 4.0));
    for (phi, psi) in [(1.0, 3.0), (1.0, 4.0), (2.0, 3.0), (2.0, 4.0)] {
        assert_eq!(l.outside(&state(phi, psi)), None);
    }
    let (below, above) = (f64::next_down, f64::next_up);
    for (phi, psi, pause) in [
        (below(1.0), 3.5, Pause::Angle(1.0)),
        (above(2.0), 3.5, Pause::Angle(2.0)),
        (1.5, below(3.0), Pause::Speed(3.0)),
        (1.5, above(4.0), Pause::Speed(4.0)),
        (above(2.0), above(4.0), Pause::Angle(2.0)),
    ] {
        assert_eq!(l.outside(&state(phi, psi)), Some(pause));
    }
}

/// Three looks within a step without a crossing, in quarters; down to neighbours in one with.
#[test]
fn no_more_looks_than_needed() {
    for (a, b, looks) in [(1.0, 3.0, [1.5, 2.0, 2.5]), (2.0, 10.0, [4.0, 6.0, 8.0])] {
        let mut s = watched(a, b, |t| state(t, 1.0));
        let unused = |_: f64, _: &State| unreachable!("no turning points");
        let none = crossing(&mut s, &limits((0.0, b), OPEN), &mut None, &unused);
        assert_eq!((none, &s.4[..]), (None, &looks[..]));
        // Just behind the first look: the quarter is halved until its ends are neighbours, which
        // is seen by a last half that falls onto one of them.
        let near = looks[0].next_up();
        for edge in [near, near.next_up()] {
            s.4.clear();
            let found = crossing(&mut s, &limits((0.0, edge), OPEN), &mut None, &unused);
            let due = edge.next_up();
            assert_eq!(found, Some((due, Pause::Angle(edge))));
            let (quarter, ulp) = ((b - a) / 4.0, due - edge);
            assert_eq!(s.4.len() as f64, 2.0 + (quarter / ulp).log2());
        }
    }
}

/// An acceleration that only touches zero at a look has no turning point; one that passes through
/// zero there has it next to it.
#[test]
fn an_acceleration_of_zero_at_a_look() {
    let l = limits(OPEN, OPEN);
    let find = |sign: f64, acceleration: &dyn Fn(f64, &State) -> f64| {
        let mut s = watched(1.0, 3.0, |t| state(t, 1.0));
        crossing(&mut s, &l, &mut Some(sign), acceleration)
    };
    for sign in [1.0, -1.0] {
        // From zero, so that it is +0 at the look whatever the sign.
        let touching = |_: f64, y: &State| 0.0 + sign * (y[PHI] - 2.0).powi(2);
        assert_eq!(find(sign, &touching), None);
        let through = |_: f64, y: &State| sign * (2.0 - y[PHI]);
        let due = Some((2.0f64.next_up(), Pause::Extremum));
        assert_eq!(find(sign, &through), due);
    }
}

#[test]
fn limits_are_met_to_the_last_bit() {
    // φ = 2t, ψ = 5 − t from 1 to 3.
    let at = |limits: Limits| {
        let mut s = watched(1.0, 3.0, |t| state(2.0 * t, 5.0 - t));
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
    let mut s = watched(1.0, 3.0, |t| state(-2.0 * t, 5.0 + t));
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
            let mut s = watched(1.0, 3.0, |t| state(t, t));
            let acceleration = |_: f64, y: &State| sign * (zero - y[PSI]);
            let mut before = Some(sign * (zero - 1.0));
            let (t, what) = crossing(&mut s, &limits(OPEN, OPEN), &mut before, &acceleration)
                .expect("a turning point");
            assert!(what == Pause::Extremum && (t - zero).abs() < 2e-15, "{t}");
        }
        let mut s = watched(1.0, 3.0, |t| state(t, t));
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
