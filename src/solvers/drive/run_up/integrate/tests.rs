//! The integration step by step: its first step, its ends, what it counts, where it gives up.

use super::*;
use crate::run_up::stepper::WORK;
use crate::run_up::{
    Coefficients, ConstantInertia, Drive, ModelError, Motor, ReducedModel, Resistance,
};
use crate::units::{Inertia, Torque};

/// A rotor without a right-hand side beyond an angle, which counts how often it is asked.
struct Walled {
    wall: f64,
    asked: Cell<u64>,
}

impl Walled {
    fn at(wall: f64) -> Walled {
        let asked = Cell::new(0);
        Walled { wall, asked }
    }
}

impl ReducedModel for Walled {
    fn coefficients(&self, phi: f64) -> Result<Coefficients, ModelError> {
        self.asked.set(self.asked.get() + 1);
        match phi > self.wall {
            true => Err(ModelError::NotPeriodic),
            false => ConstantInertia(1.0).coefficients(phi),
        }
    }
}

fn resisted(torque: f64, viscous_n_m_s: f64) -> Drive {
    let r = Resistance {
        viscous_n_m_s,
        ..Resistance::default()
    };
    let none = Inertia::from_kg_m2(0.0);
    let motor = Motor::constant(Torque::from_n_m(torque)).unwrap();
    Drive::new(motor, 1.0, none, none, r).unwrap()
}

fn with(method: Method) -> Settings {
    Settings {
        method,
        ..Settings::default()
    }
}

fn open(end: f64) -> Limits {
    Limits {
        end,
        angles: (f64::NEG_INFINITY, f64::INFINITY),
        speeds: (f64::NEG_INFINITY, f64::INFINITY),
        extrema: false,
    }
}

/// An integrator at `(t, φ, ψ)` for what is asked of it.
fn at<T>(
    model: &dyn ReducedModel,
    drive: &Drive,
    method: Method,
    (t, phi, psi): (f64, f64, f64),
    ask: impl FnOnce(&mut Integrator) -> T,
) -> T {
    let equation = Equation::new(model, drive);
    ask(&mut Integrator::new(
        equation,
        with(method),
        t,
        phi,
        psi,
        1.0,
    ))
}

/// A thousandth of what changes first: by the damping, by the acceleration beside the speed, by
/// the angle, by the end; and of a second.
#[test]
fn the_first_step_is_short_beside_everything() {
    let first = |torque: f64, viscous: f64, psi: f64, t: f64, end: f64| {
        let drive = resisted(torque, viscous);
        let rotor = ConstantInertia(1.0);
        at(&rotor, &drive, Method::Verner98, (t, 0.0, psi), |i| {
            i.first_step(end)
        })
    };
    assert_eq!(first(0.0, 8.0, 0.25, 1.0, 9.0), 1e-3 * 0.125);
    assert_eq!(first(100.0, 0.0, 0.5, 1.0, 9.0), 1e-3 * (1.5 / 100.0));
    assert_eq!(first(4.0, 0.0, 3.0, 1.0, 9.0), 1e-3 * 0.2);
    assert_eq!(first(4.0, 0.0, -3.0, 1.0, 9.0), 1e-3 * 0.2);
    assert_eq!(first(0.25, 0.0, 0.5, 1.0, 1.125), 1e-3 * 0.125);
    assert_eq!(first(0.0, 0.0, 0.0, 1.0, 9.0), 1e-3);
    // An acceleration beyond all numbers makes no step of length zero.
    let drive = resisted(1e20, 0.0);
    let light = ConstantInertia(1e-300);
    let h = at(&light, &drive, Method::Verner98, (1.0, 0.0, 0.0), |i| {
        i.first_step(1.25)
    });
    assert_eq!(h, 1e-3 * 0.25);
}

#[test]
fn a_state_is_sound_when_finite_and_not_refused() {
    let (rotor, drive) = (ConstantInertia(1.0), resisted(0.0, 0.0));
    at(&rotor, &drive, Method::Verner98, (0.0, 0.0, 1.0), |i| {
        let good = [1.0; 6];
        let mut bad = good;
        bad[DAMPING] = f64::INFINITY;
        assert!(i.sound(&good) && !i.sound(&bad));
        let e = EquationError::Model(ModelError::NotPeriodic);
        *i.rhs.refused.borrow_mut() = Some(e.clone());
        assert!(!i.sound(&good) && !i.sound(&bad));
        // The reason of the equation comes before that of the method, once.
        assert_eq!(i.stuck("a".into()), Stuck::Equation(e));
        assert_eq!(i.stuck("a".into()), Stuck::Method("a".into()));
    });
}

/// Within four roundings of the end there is nothing to do; a step that comes as near is the last.
#[test]
fn the_end_is_met_exactly() {
    let (model, drive) = (Walled::at(f64::INFINITY), resisted(0.0, 0.0));
    let end = 1024.0;
    for (off, nothing) in [(0.0, true), (3.0, true), (4.0, true), (6.0, false)] {
        let t = end - off * f64::EPSILON * end;
        model.asked.set(0);
        at(&model, &drive, Method::Verner98, (t, 0.0, 0.5), |i| {
            let pause = i.advance(&open(end), &mut |_, _, _| ());
            assert_eq!((pause, i.t), (Ok(Pause::End), end));
            assert_eq!(i.counts.steps == 0, nothing, "{off}");
            assert_eq!(model.asked.get() == 0, nothing, "{off}");
        });
    }
    at(&model, &drive, Method::Verner98, (0.0, 0.0, 0.5), |i| {
        // Two roundings short of the end.
        i.h = end - 2.0 * f64::EPSILON * end;
        let pause = i.advance(&open(end), &mut |_, _, _| ());
        assert_eq!((pause, i.t, i.counts.steps), (Ok(Pause::End), end, 1));
    });
}

/// Evaluations of an explicit method: one to begin, those of the stages for each step tried, those
/// of the dense output and the new derivative for each step taken, and one for the first step.
fn evaluations(method: Method, begun: u64, tried: u64, taken: u64) -> u64 {
    let (stages, after) = match method {
        // 16 stages, and 10 more for its dense output; the derivative at the end.
        Method::Verner98 => (15, 11),
        // 12 stages, and 3 more; the derivative at the end.
        Method::Dop853 => (11, 4),
        Method::Radau5 => unreachable!("implicit"),
    };
    1 + begun + stages * tried + after * taken
}

#[test]
fn what_is_done_is_counted() {
    // A steep resistance: the steps are held down by it, and some are rejected.
    let model = Walled::at(f64::INFINITY);
    let drive = resisted(100.0, 50.0);
    for method in [Method::Verner98, Method::Dop853] {
        model.asked.set(0);
        at(&model, &drive, method, (0.0, 0.0, 0.0), |i| {
            let pause = i.advance(&open(1.0), &mut |_, _, _| ());
            assert_eq!(pause, Ok(Pause::End));
            let c = i.counts;
            assert!(c.rejected > 0 && c.retaken == 0);
            assert_eq!(c.evaluations, model.asked.get());
            let due = evaluations(method, 1, c.steps + c.rejected, c.steps);
            assert_eq!(c.evaluations, due, "{method:?}");
        });
    }
}

/// Steps into a wall are quartered until they are too small to be told from none.
#[test]
fn a_wall_ends_the_integration_after_quartering() {
    let drive = resisted(0.0, 0.0);
    let refused = Stuck::Equation(EquationError::Model(ModelError::NotPeriodic));
    let ask = |i: &mut Integrator| {
        let first = i.first_step(2.0);
        let found = i.advance(&open(2.0), &mut |_, _, _| ());
        (found, first, i.h, i.counts)
    };
    // From zero on every step can be told from none: 25 quarterings and no more.
    let wall = Walled::at(0.0);
    let (found, first, h, counts) = at(&wall, &drive, Method::Verner98, (0.0, 0.0, 1.0), ask);
    assert_eq!(found, Err(refused.clone()));
    assert_eq!((counts.steps, counts.rejected), (0, 26));
    assert_eq!(h, first * 0.25f64.powi(25));
    // At one second they vanish in rounding before.
    let (found, first, h, counts) = at(&wall, &drive, Method::Verner98, (1.0, 0.0, 1.0), ask);
    assert_eq!(found, Err(refused));
    let mut due = 1;
    while 1.0 + first * 0.25f64.powi(due) > 1.0 {
        due += 1;
    }
    assert_eq!((counts.steps, counts.rejected), (0, due as u64));
    assert_eq!(h, first * 0.25f64.powi(due - 1));
}

/// A wall farther on is approached to within rounding, and the steps before it count.
#[test]
fn a_wall_is_approached() {
    let (wall, drive) = (Walled::at(1.5), resisted(0.0, 0.0));
    at(&wall, &drive, Method::Verner98, (1.0, 0.0, 1.0), |i| {
        let found = i.advance(&open(9.0), &mut |_, _, _| ());
        assert!(matches!(found, Err(Stuck::Equation(_))), "{found:?}");
        assert!((i.y[PHI] - 1.5).abs() < 1e-14, "{:?}", i.y);
        assert!(i.counts.steps > 0 && i.counts.rejected > 25);
    });
}

/// The state is moved along the tangent onto what it stopped for, if that is nearer than a step.
#[test]
fn a_stop_is_settled_along_the_tangent() {
    let (rotor, drive) = (ConstantInertia(1.0), resisted(3.0, 0.0));
    let small = 0.5f64.powi(10);
    at(&rotor, &drive, Method::Verner98, (5.0, 1.0, 2.0), |i| {
        i.stretches = Some(Vec::new());
        i.h = small;
        i.settle(Pause::Angle(1.0 + 2.0 * small));
        assert_eq!(i.t, 5.0 + small);
        assert_eq!(i.y[PHI], 1.0 + 2.0 * small);
        assert_eq!(i.y[PSI], 2.0 + 3.0 * small);
        assert_eq!(i.y[WORK[0]], 6.0 * small);
        // Backwards, to a speed.
        i.settle(Pause::Speed(2.0));
        assert_eq!((i.t, i.y[PSI]), (5.0, 2.0));
        let (from, to, taken) = (5.0, 5.0 + small, Taken::Tangent);
        let back = Stretch {
            from: to,
            to: from,
            taken,
        };
        assert_eq!(i.stretches, Some(vec![Stretch { from, to, taken }, back]));
        // Farther than a step: only what it stopped for.
        let y = i.y;
        i.settle(Pause::Speed(2.0 + 4.0 * small));
        assert_eq!((i.t, i.y[PHI], i.y[PSI]), (5.0, y[PHI], 2.0 + 4.0 * small));
        i.settle(Pause::Speed(2.0 - 4.0 * small));
        assert_eq!((i.t, i.y[PHI], i.y[PSI]), (5.0, y[PHI], 2.0 - 4.0 * small));
    });
    // Standing still there is no tangent.
    let still = resisted(0.0, 0.0);
    at(&rotor, &still, Method::Verner98, (5.0, 1.0, 0.0), |i| {
        i.h = small;
        for pause in [Pause::Angle(1.5), Pause::Speed(0.25)] {
            i.y = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0];
            i.settle(pause);
            assert_eq!(i.t, 5.0);
        }
    });
}

/// A step that crosses a limit is taken again up to there, and counted.
#[test]
fn a_step_over_a_limit_is_taken_again() {
    let (model, drive) = (Walled::at(f64::INFINITY), resisted(0.0, 0.0));
    at(&model, &drive, Method::Verner98, (0.0, 0.0, 2.0), |i| {
        i.stretches = Some(Vec::new());
        let mut seen = Vec::new();
        for (k, angle) in [0.7, 1.9, 2.0].into_iter().enumerate() {
            let limits = Limits {
                angles: (0.0, angle),
                ..open(10.0)
            };
            let pause = i.advance(&limits, &mut |a, b, _| seen.push((a, b)));
            assert_eq!(pause, Ok(Pause::Angle(angle)));
            assert_eq!(i.y[PHI], angle);
            assert!((i.t - 0.5 * angle).abs() < 1e-15);
            assert_eq!(i.counts.retaken, k as u64 + 1);
            assert_eq!(i.counts.evaluations, model.asked.get());
        }
        let steps = i.counts.steps;
        assert_eq!(seen.len() as u64, steps);
        let stretches = i.stretches.take().unwrap();
        let taken = stretches.iter().filter(|s| s.taken == Taken::Step);
        assert_eq!(taken.count() as u64, steps);
        assert_eq!(
            (stretches[0].from, stretches.last().unwrap().to),
            (0.0, i.t)
        );
        assert!(stretches.iter().all(|s| s.from != s.to));
        assert!(stretches.windows(2).all(|s| s[0].to == s[1].from));
    });
}

/// Weights that jump to `.1` beyond an angle `.0`.
struct Jump(f64, f64);

impl ReducedModel for Jump {
    fn coefficients(&self, phi: f64) -> Result<Coefficients, ModelError> {
        Ok(Coefficients {
            inertia: 1.0,
            inertia_derivative: 0.0,
            moment: if phi > self.0 { self.1 } else { 0.0 },
        })
    }
}

/// At a jump steps are rejected until they are short; an explicit method is not begun afresh.
#[test]
fn a_jump_is_approached_by_rejections() {
    let (jump, drive) = (Jump(1.0, 1e6), resisted(0.0, 0.0));
    for method in Method::ALL {
        at(&jump, &drive, method, (0.0, 0.0, 1.0), |i| {
            let pause = i.advance(&open(1.01), &mut |_, _, _| ());
            assert_eq!(pause, Ok(Pause::End));
            let c = i.counts;
            // From rest at the jump on: ψ² = 1 + 2·10⁶ (φ − 1).
            assert!((i.y[PSI] - (1.0 + 1e4)).abs() < 1e-4, "{:?}", i.y);
            assert!(c.rejected >= 4);
            if method != Method::Radau5 {
                let due = evaluations(method, 1, c.steps + c.rejected, c.steps);
                assert_eq!(c.evaluations, due, "{method:?}");
            }
        });
    }
}

/// A hundred rejections in a row, which the library takes for stiffness, only begin it afresh.
#[test]
fn a_hundred_rejections_in_a_row_are_counted_as_any() {
    let (jump, drive) = (Jump(0.0, 1e90), resisted(0.0, 0.0));
    at(&jump, &drive, Method::Verner98, (0.0, 0.0, 1.0), |i| {
        i.settings.max_steps = 110;
        let found = i.advance(&open(1.0), &mut |_, _, _| ());
        assert_eq!(found, Err(Stuck::Budget));
        assert_eq!((i.counts.steps, i.counts.rejected), (0, 110));
        let due = evaluations(Method::Verner98, 2, 110, 0);
        assert_eq!(i.rhs.evaluations.get(), due);
    });
}

/// After every second rejection in a row the implicit method begins afresh, from the step that it
/// proposed then.
#[test]
fn an_implicit_method_begins_afresh_after_two_rejections() {
    let (jump, drive) = (Jump(0.0, 1e6), resisted(0.0, 0.0));
    let begun_with = |rejections: u64| {
        at(&jump, &drive, Method::Radau5, (0.0, 0.0, 1.0), |i| {
            i.settings.max_steps = rejections;
            let found = i.advance(&open(1.0), &mut |_, _, _| ());
            assert_eq!(found, Err(Stuck::Budget));
            assert_eq!((i.counts.steps, i.counts.rejected), (0, rejections));
            i.h
        })
    };
    let h = [1, 2, 3, 4, 5].map(begun_with);
    assert!(h[0] == 0.0 && h[1] > 0.0 && h[2] == h[1]);
    assert!(h[3] < h[2] && h[3] > 0.0 && h[4] == h[3]);
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
