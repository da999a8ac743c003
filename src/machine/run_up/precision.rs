//! Work-precision data of each integration method on a machine.

use super::Machine;
use crate::solvers::run_up::{Equation, Method, Plan, RunError, Settings, run};

/// Tolerances tried: 1e-4 to 1e-13, two a decade.
const EXPONENTS: [f64; 19] = [
    4.0, 4.5, 5.0, 5.5, 6.0, 6.5, 7.0, 7.5, 8.0, 8.5, 9.0, 9.5, 10.0, 10.5, 11.0, 11.5, 12.0, 12.5,
    13.0,
];

/// The tolerance of the run against which errors are taken, by another method than DOP853 and
/// Radau's, and ten times finer than its own finest.
pub const FINEST: f64 = 1e-14;

/// Moments at which the speeds are compared.
pub const MOMENTS: u32 = 8;

/// A method at a tolerance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// The method.
    pub method: Method,
    /// The tolerance of a step.
    pub tolerance: f64,
    /// Evaluations of the right-hand side over the whole run.
    pub evaluations: u64,
    /// The worst difference of the speed at [`MOMENTS`] moments from the finest run, in rad/s.
    pub error: f64,
}

/// Runs the machine with every method at every tolerance; `progress` hears how many of how many
/// points are done.
///
/// # Errors
/// The first run that fails.
pub fn work_precision(
    machine: &Machine,
    equation: &Equation,
    mut progress: impl FnMut(u64, u64),
) -> Result<Vec<Point>, RunError> {
    let end = |method, tolerance, moment: u32| -> Result<(f64, u64), RunError> {
        let motion = run(equation, &part(&machine.plan, method, tolerance, moment))?;
        Ok((motion.end.psi, motion.counts.evaluations))
    };
    let finest = (1..=MOMENTS).map(|k| Ok(end(Method::Verner98, FINEST, k)?.0));
    let finest = finest.collect::<Result<Vec<f64>, RunError>>()?;
    let total = (Method::ALL.len() * EXPONENTS.len()) as u64;
    let mut points = Vec::new();
    for method in Method::ALL {
        for x in EXPONENTS {
            let tolerance = 10f64.powf(-x);
            let (mut error, mut evaluations) = (0.0f64, 0);
            for (k, reference) in (1..=MOMENTS).zip(&finest) {
                let (psi, cost) = end(method, tolerance, k)?;
                error = error.max((psi - reference).abs());
                evaluations = cost;
            }
            points.push(Point {
                method,
                tolerance,
                evaluations,
                error,
            });
            progress(points.len() as u64, total);
        }
    }
    Ok(points)
}

/// The run up to one of the moments by this method alone, without samples.
fn part(whole: &Plan, method: Method, tolerance: f64, moment: u32) -> Plan {
    Plan {
        duration: whole.duration * f64::from(moment) / f64::from(MOMENTS),
        sampling: None,
        settings: Settings {
            tolerance,
            method,
            switch_when_stiff: false,
            ..whole.settings
        },
        ..whole.clone()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::Source;
    use crate::machine::run_up::Overrides;

    fn machine(duration: &str) -> Machine {
        let text = include_str!("../../../examples/four-bar-run-up.toml");
        let text = text.replace("duration = \"2 s\"", &format!("duration = \"{duration}\""));
        Machine::read(&Source::toml(text), Overrides::default()).unwrap()
    }

    #[test]
    fn each_part_is_run_by_its_method_alone() {
        let mut whole = machine("2 s").plan;
        whole.settings.switch_when_stiff = true;
        let part = part(&whole, Method::Dop853, 1e-6, 3);
        assert_eq!((part.duration, part.sampling), (0.75, None));
        let due = Settings {
            tolerance: 1e-6,
            method: Method::Dop853,
            switch_when_stiff: false,
            ..whole.settings
        };
        assert_eq!(part.settings, due);
    }

    #[test]
    fn progress_ends_with_the_last_point() {
        let machine = machine("0.01 ms");
        let equation = Equation::new(&*machine.model, &machine.drive);
        let mut heard = Vec::new();
        let points = work_precision(&machine, &equation, |done, total| heard.push((done, total)));
        let total = points.unwrap().len() as u64;
        let due: Vec<(u64, u64)> = (1..=total).map(|k| (k, total)).collect();
        assert_eq!(heard, due);
    }

    /// Two tolerances a decade for each method; the error is the worst of eight moments, the cost
    /// that of the whole run.
    #[test]
    fn points_hold_the_worst_error_and_the_whole_cost() {
        let machine = machine("40 ms");
        let equation = Equation::new(&*machine.model, &machine.drive);
        let points = work_precision(&machine, &equation, |_, _| ()).unwrap();
        let of = |method: Method, tolerance: f64| -> Vec<_> {
            let end = |k: u32| {
                let mut plan = machine.plan.clone();
                plan.duration = 0.04 * f64::from(k) / 8.0;
                plan.sampling = None;
                plan.settings.method = method;
                plan.settings.tolerance = tolerance;
                plan.settings.switch_when_stiff = false;
                run(&equation, &plan).unwrap()
            };
            (1..=8).map(end).collect()
        };
        let finest = of(Method::Verner98, 1e-14);
        for (method, all) in Method::ALL.into_iter().zip(points.chunks(19)) {
            for (k, point) in all.iter().enumerate() {
                assert_eq!(point.method, method);
                let due = 10f64.powf(-4.0 - 0.5 * k as f64);
                assert!((point.tolerance / due - 1.0).abs() < 1e-12);
            }
            let ends = of(method, all[0].tolerance);
            let apart = ends
                .iter()
                .zip(&finest)
                .map(|(a, b)| (a.end.psi - b.end.psi).abs());
            let worst = apart.fold(0.0, f64::max);
            assert!(
                (all[0].error - worst).abs() <= 1e-3 * worst && worst > 0.0,
                "{worst}"
            );
            assert_eq!(all[0].evaluations, ends[7].counts.evaluations);
        }
    }
}
