//! Work-precision rows: each integration method on the machine of the file.

use crate::cli::args::RunupArgs;
use crate::cli::complain;
use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::output::Output;
use crate::cli::progress::Progress;
use mechaudit::machine::run_up::{self, FINEST, MOMENTS, Machine};
use mechaudit::report::cell::Cell;
use mechaudit::report::columns::Columns;
use mechaudit::report::rows::Rows;
use mechaudit::report::svg::run_up::{Work, work_precision};
use mechaudit::solvers::run_up::{Equation, Method};
use serde_json::{Map, json};

/// The columns of a row.
pub const COLUMNS: [&str; 4] = ["method", "tolerance", "evaluations", "error_rad_per_s"];

/// Writes the table and, if asked, the drawing.
pub fn table(
    args: &RunupArgs,
    machine: &Machine,
    equation: &Equation,
    columns: Columns,
    output: Output,
    drawing: Option<Output>,
) -> Result<Outcome, Failure> {
    let progress = Progress::new();
    let points = run_up::work_precision(machine, equation, |done, total| {
        progress.show("work and precision", done, total);
    });
    let points = points.map_err(Failure::caused)?;
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
        Ok(rows.end()?)
    })?;
    complain(&format!(
        "error_rad_per_s is the worst difference of the speed at {MOMENTS} moments of the run from verner98 at tolerance {FINEST:e}, which is not itself certified; evaluations are those of the whole run"
    ));
    Ok(Outcome::AsExpected)
}
