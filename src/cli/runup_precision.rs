//! Work against precision: what each method costs for what accuracy, on the machine of the file.

use super::args::RunupArgs;
use super::columns::Columns;
use super::complain;
use super::failure::{Failure, Outcome};
use super::output::Output;
use super::progress::Progress;
use super::rows::{Cell, Rows};
use super::runup_file::Machine;
use mechaudit::report::svg::run_up::{Work, work_precision};
use mechaudit::solvers::run_up::{Equation, Method, Plan, Settings, run};
use serde_json::{Map, json};

/// Tolerances tried: 1e-4 to 1e-13, two a decade.
const EXPONENTS: [f64; 19] = [
    4.0, 4.5, 5.0, 5.5, 6.0, 6.5, 7.0, 7.5, 8.0, 8.5, 9.0, 9.5, 10.0, 10.5, 11.0, 11.5, 12.0, 12.5,
    13.0,
];

/// The run against which errors are taken, by another method than DOP853 and Radau's, and by a
/// tolerance ten times finer than its own finest.
const FINEST: f64 = 1e-14;

/// The columns of a row.
pub const COLUMNS: [&str; 4] = ["method", "tolerance", "evaluations", "error_rad_per_s"];

/// Moments at which the speeds are compared.
const MOMENTS: u32 = 8;

/// A point of the diagram.
pub struct Point {
    pub method: Method,
    pub tolerance: f64,
    pub evaluations: u64,
    pub error: f64,
}

/// Writes the table and, if asked, the drawing.
pub fn table(
    args: &RunupArgs,
    machine: &Machine,
    equation: &Equation,
    columns: Columns,
    output: Output,
    drawing: Option<Output>,
) -> Result<Outcome, Failure> {
    let end = |method, tolerance, moment: u32| -> Result<(f64, u64), Failure> {
        let plan = Plan {
            duration: machine.plan.duration * f64::from(moment) / f64::from(MOMENTS),
            sampling: None,
            settings: Settings {
                tolerance,
                method,
                switch_when_stiff: false,
                ..machine.plan.settings
            },
            ..machine.plan.clone()
        };
        let motion = run(equation, &plan).map_err(|e| Failure::new(e.to_string()))?;
        Ok((motion.end.psi, motion.counts.evaluations))
    };
    let progress = Progress::new();
    let finest = (1..=MOMENTS)
        .map(|k| Ok(end(Method::Verner98, FINEST, k)?.0))
        .collect::<Result<Vec<f64>, Failure>>()?;
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
            let total = (Method::ALL.len() * EXPONENTS.len()) as u64;
            progress.show("work and precision", points.len() as u64, total);
        }
    }
    drop(progress);
    if let Some(drawing) = drawing {
        let works = Method::ALL.map(|method| Work {
            method: method.name(),
            points: points
                .iter()
                .filter(|p| p.method == method)
                .map(|p| (p.error, p.evaluations))
                .collect(),
        });
        drawing.text(&work_precision(&machine.name, &works)?)?;
    }
    output.write(|out| {
        let mut about = Map::new();
        about.insert("schema_version".into(), json!(1));
        about.insert("mechaudit_version".into(), json!(env!("CARGO_PKG_VERSION")));
        about.insert("name".into(), json!(machine.name));
        about.insert("duration_s".into(), json!(machine.plan.duration));
        let mut rows = Rows::begin(out, args.format, columns, &about)?;
        for p in &points {
            rows.row(&[
                Cell::Name(p.method.name()),
                Cell::Float(p.tolerance),
                Cell::Count(p.evaluations as usize),
                Cell::Float(p.error),
            ])?;
        }
        rows.end()
    })?;
    complain(&format!(
        "error_rad_per_s is the worst difference of the speed at {MOMENTS} moments of the run from verner98 at tolerance {FINEST:e}, which is not itself certified; evaluations are those of the whole run"
    ));
    Ok(Outcome::AsExpected)
}
