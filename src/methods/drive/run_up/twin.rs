//! The twin of the run-up: the steps that the solver accepted, with its coefficients, without
//! rounding.
//!
//! The library gives its coefficients rounded to doubles, and these are taken as they are: what
//! their last digits do counts as an error of the method. Their defects in the order conditions are
//! below 1e-14 for Verner's method and for DOP853; see the test.

use super::{RunUp, RunUpInput, motion_with, reference_model, reference_run};
use crate::methods::definition::{Definition, exact};
use crate::reference::Ball;
use crate::reference::run_up::{Leg, RungeKutta, follow_steps};
use crate::solvers::run_up::{Method as Integration, Settings, Stretch, Taken};

/// Working precision: what it leaves of rounding in the twin is below 2⁻¹⁰⁰ in the audit.
const BITS: u32 = 160;

/// The end of the motion at a tolerance; none for an implicit method, whose unfinished iteration
/// would count as rounding, and where it is not decided.
pub(in crate::methods) fn twin(
    i: RunUpInput,
    tolerance: f64,
    method: Integration,
) -> Option<Vec<Ball>> {
    follow(i, &steps(i, tolerance, method)?, &coefficients(method)?)
}

/// [`twin`], with every step cut in two.
pub(in crate::methods) fn twin_of_half_steps(
    i: RunUpInput,
    tolerance: f64,
    method: Integration,
) -> Option<Vec<Ball>> {
    let halves = |s: Stretch| {
        let middle = 0.5 * (s.from + s.to);
        [Stretch { to: middle, ..s }, Stretch { from: middle, ..s }]
    };
    let steps = steps(i, tolerance, method)?;
    let steps: Vec<Stretch> = steps.into_iter().flat_map(halves).collect();
    follow(i, &steps, &coefficients(method)?)
}

fn coefficients(method: Integration) -> Option<RungeKutta> {
    let tableau = method.tableau()?;
    Some(RungeKutta {
        a: tableau.a,
        b: tableau.b,
    })
}

/// Returns what the solver did.
fn steps(i: RunUpInput, tolerance: f64, method: Integration) -> Option<Vec<Stretch>> {
    let settings = Settings {
        tolerance,
        method,
        ..Settings::default()
    };
    let (_, stretches) = motion_with(i, settings).ok()?;
    Some(stretches)
}

fn follow(i: RunUpInput, steps: &[Stretch], method: &RungeKutta) -> Option<Vec<Ball>> {
    let exact = exact(&i.to_vec())?;
    let exact = RunUp::unpack(&exact)?;
    let tangent = RungeKutta {
        a: vec![Vec::new()],
        b: vec![1.0],
    };
    let leg = |s: &Stretch| Leg {
        method: match s.taken {
            Taken::Step => method,
            Taken::Tangent => &tangent,
        },
        from: s.from,
        to: s.to,
    };
    let legs: Vec<Leg> = steps.iter().map(leg).collect();
    let model = reference_model(exact, BITS).ok()?;
    let end = follow_steps(&model, &reference_run(exact)?, &legs).ok()?;
    Some(end.to_vec())
}

#[cfg(test)]
mod tests {
    use super::super::{
        EXACT, HYBRID, SPLINES, bare_rotor_under_kloss, sand_screen, sand_screen_from_rest,
    };
    use super::*;
    use crate::audit::{Settings as AuditSettings, SolverAnswer, Variant, audit_method};
    use crate::reference::Mag;
    use rug::Float;

    const EXPLICIT: [Integration; 2] = [Integration::Verner98, Integration::Dop853];

    fn end(i: RunUpInput, tolerance: f64, method: Integration) -> [f64; 2] {
        let settings = Settings {
            tolerance,
            method,
            ..Settings::default()
        };
        let (m, _) = motion_with(i, settings).unwrap();
        [m.end.phi, m.end.psi]
    }

    fn off(got: [f64; 2], twin: &[Ball]) -> f64 {
        let gap = |k: usize| (&Ball::exact(160, got[k]) - &twin[k]).magnitude().to_f64();
        gap(0).max(gap(1))
    }

    /// Through knots of splines and dead positions, on all models.
    #[test]
    fn the_solver_differs_from_its_twin_by_rounding() {
        let long = |model, nodes| sand_screen(model, nodes, 0.05);
        for x in [
            bare_rotor_under_kloss(),
            long(EXACT, 0.0),
            long(SPLINES, 12.0),
            long(HYBRID, 12.0),
        ] {
            for method in EXPLICIT {
                let t = twin(x, 1e-6, method).unwrap();
                assert!(t.iter().all(|b| b.rad() < Mag::power_of_two(-100)), "{t:?}");
                let rounding = off(end(x, 1e-6, method), &t);
                assert!(rounding < 2e-13, "{method:?}: {rounding:e}");
            }
        }
        assert!(twin(bare_rotor_under_kloss(), 1e-6, Integration::Radau5).is_none());
    }

    #[test]
    fn a_coefficient_in_error_shows_as_rounding() {
        let x = sand_screen_from_rest(0.004);
        for method in EXPLICIT {
            let steps = steps(x, 1e-9, method).unwrap();
            let sound = coefficients(method).unwrap();
            let found = |c: &RungeKutta| off(end(x, 1e-9, method), &follow(x, &steps, c).unwrap());
            assert!(found(&sound) < 1e-12);
            let mut faulty = sound.clone();
            faulty.b[8] += 1e-9;
            assert!(found(&faulty) > 1e-11, "{:e}", found(&faulty));
            // Another sequence of steps is another approximation.
            let fewer = follow(x, &steps[1..], &sound).unwrap();
            assert!(off(end(x, 1e-9, method), &fewer) > 1e-9);
        }
    }

    #[test]
    fn a_solver_that_loses_digits_shows_as_rounding() {
        let x = bare_rotor_under_kloss();
        let careless = RunUpInput {
            i1: x.i1 * (1.0 + 1e-11),
            ..x
        };
        let t = twin(x, 1e-12, Integration::Verner98).unwrap();
        let rounding = off(end(x, 1e-12, Integration::Verner98), &t);
        let planted = off(end(careless, 1e-12, Integration::Verner98), &t);
        assert!(
            rounding < 2e-14 && planted > 1e-12,
            "{rounding:e} {planted:e}"
        );
    }

    /// Defects in the conditions of all rooted trees of each order (Butcher 1963; Hairer, Nørsett,
    /// Wanner, *Solving Ordinary Differential Equations I*, 2nd ed. 1993, II.2, theorem 2.13).
    fn defects(method: &RungeKutta, orders: usize) -> Vec<f64> {
        const BITS: u32 = 160;
        struct Tree {
            order: usize,
            /// Its elementary weight at each stage, and its density γ.
            at: Vec<Float>,
            density: f64,
        }
        struct Choice {
            left: usize,
            from: usize,
            at: Vec<Float>,
            density: f64,
        }
        let dot = |w: &[f64], v: &[Float]| {
            let zero = Float::new(BITS);
            w.iter()
                .zip(v)
                .fold(zero, |s, (w, v)| s + Float::with_val(BITS, v * *w))
        };
        let one = vec![Float::with_val(BITS, 1); method.b.len()];
        let mut trees: Vec<Tree> = Vec::new();
        let mut worst = Vec::new();
        for order in 1..=orders {
            let (known, mut largest) = (trees.len(), 0.0f64);
            let mut open = vec![Choice {
                left: order - 1,
                from: 0,
                at: one.clone(),
                density: order as f64,
            }];
            while let Some(c) = open.pop() {
                if c.left == 0 {
                    let due = Float::with_val(BITS, c.density).recip();
                    largest = largest.max((dot(&method.b, &c.at) - due).to_f64().abs());
                    trees.push(Tree {
                        order,
                        at: c.at,
                        density: c.density,
                    });
                    continue;
                }
                for k in c.from..known {
                    let t = &trees[k];
                    if t.order > c.left {
                        break;
                    }
                    let grown = method.a.iter().zip(&c.at);
                    open.push(Choice {
                        left: c.left - t.order,
                        from: k,
                        at: grown.map(|(row, x)| dot(row, &t.at) * x).collect(),
                        density: c.density * t.density,
                    });
                }
            }
            worst.push(largest);
        }
        assert_eq!(trees.iter().filter(|t| t.order == 8).count(), 115);
        worst
    }

    #[test]
    fn the_coefficients_have_their_order() {
        for (method, order) in [(Integration::Verner98, 9), (Integration::Dop853, 8)] {
            let found = defects(&coefficients(method).unwrap(), order + 1);
            assert!(
                found[..order].iter().all(|d| *d < 1e-14),
                "{method:?}: {found:?}"
            );
            assert!(found[order] > 1e-8, "{method:?}: {found:?}");
        }
        let mut faulty = coefficients(Integration::Verner98).unwrap();
        faulty.a[9][5] += 1e-11;
        let found = defects(&faulty, 9);
        assert!(found.iter().any(|d| *d > 1e-13), "{found:?}");
    }

    #[test]
    fn the_worst_run_up_is_taken_apart() {
        let method = crate::methods::find("run-up").unwrap();
        let some = Variant::new(&*method).region("bare-rotor").unwrap();
        let settings = AuditSettings {
            cases_per_region: 5,
            ..AuditSettings::default()
        };
        let report = audit_method(&some, &settings, &|| ());
        for o in report.outputs() {
            let parts = o.parts.unwrap();
            assert!(
                parts.method + parts.rounding >= o.ulps.max * (1.0 - 1e-9),
                "{parts:?}"
            );
            assert!(parts.rounding < 100.0, "{parts:?}");
        }
        // The twin is that of the method's own solver, not of another.
        let planted = some.solver(|x| match method.solve(x) {
            SolverAnswer::Values(v) => SolverAnswer::Values(vec![v[0] * (1.0 + 1e-12), v[1]]),
            other => other,
        });
        let report = audit_method(&planted, &settings, &|| ());
        assert!(report.outputs().iter().all(|o| o.parts.is_none()));
    }
}
