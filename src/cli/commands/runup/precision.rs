//! Work-precision rows: each integration method on the machine of the file.

use crate::cli::args::RunupArgs;
use crate::cli::complain;
use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::output::Output;
use crate::cli::progress::Progress;
use mechaudit::machine::run_up::{self, FINEST, MOMENTS, Machine};
use mechaudit::report::cell::Cell;
use mechaudit::report::columns::Columns;
use mechaudit::report::html::run::{Figure, Section, page};
use mechaudit::report::rows::{Form, Rows};
use mechaudit::report::svg::run_up::{Work, work_precision};
use mechaudit::solvers::run_up::{Equation, Method};
use serde_json::{Map, json};
use std::io::Write;

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
        drawing.text(work_precision(&machine.name, &works))?;
    }
    let note = format!(
        "the column error_rad_per_s is the worst difference of the speed at {MOMENTS} moments of the run from verner98 at tolerance {FINEST:e}, which is not itself certified; the evaluations are those of the whole run"
    );
    let write = |out: &mut dyn Write, form| -> Result<(), Failure> {
        let mut about = Map::new();
        about.insert("schema_version".into(), json!(1));
        about.insert("mechaudit_version".into(), json!(env!("CARGO_PKG_VERSION")));
        about.insert("name".into(), json!(machine.name));
        about.insert("duration_s".into(), json!(machine.plan.duration));
        let mut rows = Rows::begin(out, form, columns, &about)?;
        for p in &points {
            rows.row(&[
                Cell::Name(p.method.name()),
                Cell::Float(p.tolerance),
                Cell::Count(p.evaluations as usize),
                Cell::Float(p.error),
            ])?;
        }
        Ok(rows.end()?)
    };
    output.write(|out| {
        if let Some(form) = args.format.rows() {
            return write(out, form);
        }
        let mut table = Vec::new();
        write(&mut table, Form::Table)?;
        let line = |m: &Method| {
            let of = points.iter().filter(|p| p.method == *m);
            let at = of.map(|p| (p.evaluations as f64, p.error.max(1e-16)));
            (m.name().to_string(), at.collect())
        };
        let caption =
            "worst error of the speed found, rad/s, over evaluations of the right-hand side";
        let section = Section {
            key: "work-precision",
            title: "Work and precision".into(),
            figures: vec![Figure::Logarithmic(
                caption.into(),
                Method::ALL.iter().map(line).collect(),
            )],
            table,
        };
        let page = page(
            &machine.name,
            "work and precision",
            std::slice::from_ref(&note),
            &[section],
        );
        Ok(out.write_all(page.as_bytes())?)
    })?;
    complain(&note);
    Ok(Outcome::AsExpected)
}

#[cfg(test)]
mod tests {
    use super::*;
    use mechaudit::report::glossary::topics;

    #[test]
    fn every_column_has_a_meaning() {
        let topic = topics(&["work-precision"]).next().unwrap();
        for name in COLUMNS {
            assert!(topic.find(name).is_some(), "{name} has no entry");
        }
    }
}
