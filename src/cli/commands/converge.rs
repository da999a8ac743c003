//! Convergence of approximations, with method error and rounding apart.

use crate::cli::args::{ConvergeArgs, TextOrJson};
use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::output::{print_json, write_to};
use crate::cli::process::interrupt;
use crate::cli::progress::Progress;
use crate::cli::terminal::width;
use mechaudit::audit::{ConvergenceReport, LevelReport, convergence};
use mechaudit::methods::{approximations, find_approximation};
use mechaudit::report::text::style::{BAD, BOLD, DIM, PLAIN, paint, paragraph};
use mechaudit::report::text::table::Table;
use mechaudit::report::words::numbers::short;
use serde_json::json;

/// Runs them.
pub fn converge(args: &ConvergeArgs) -> Result<Outcome, Failure> {
    let chosen = match &args.name {
        None => approximations(),
        Some(name) => vec![find_approximation(name).ok_or_else(|| {
            let known: Vec<&str> = approximations().iter().map(|a| a.name()).collect();
            Failure::no_such("approximation", name, &known)
        })?],
    };
    let total = chosen.len();
    let mut reports = Vec::new();
    let progress = Progress::new();
    let mut done = 0;
    for approximation in chosen {
        let name = approximation.name();
        progress.show(name, done as u64, total as u64);
        let Some(report) = interrupt::unless_requested(move || convergence(&*approximation)) else {
            break;
        };
        let report = report.map_err(|e| Failure::caused(e).about(name))?;
        done += 1;
        progress.clear();
        match args.format {
            TextOrJson::Text => write_to(|out| Ok(writeln!(out, "{}", text(&report))?))?,
            TextOrJson::Json => reports.push(report),
        }
    }
    let interrupted = done < total;
    if args.format == TextOrJson::Json {
        print_json(&json!({
            "schema_version": 1,
            "mechaudit_version": env!("CARGO_PKG_VERSION"),
            "interrupted": interrupted,
            "approximations": reports,
        }))?;
    }
    if interrupted && args.format == TextOrJson::Text {
        let text = format!("Interrupted: {done} of {total} approximations.");
        write_to(|out| Ok(writeln!(out, "{}", paint(BAD, &text))?))?;
    }
    Ok(Outcome::unless_interrupted(interrupted, true))
}

fn text(report: &ConvergenceReport) -> String {
    let mut out = format!("{}\n", paint(BOLD, report.name));
    out.push_str(&paragraph(report.summary, 2, width()));
    out.push_str(&paragraph(&report.places, 2, width()));
    let errors = || report.levels.iter().flat_map(|l| &l.errors);
    let twin = errors().any(|e| e.method.is_some());
    let regular = errors().any(|e| e.order.is_some());
    for (o, name) in report.outputs.iter().enumerate() {
        let mut header = vec![*name, report.work_unit, "total"];
        if twin {
            header.extend(["method", "rounding"]);
        }
        if regular {
            header.extend(["order", "Richardson"]);
        }
        let mut table = Table::new(&header, &[0]);
        for level in &report.levels {
            table.row(row(level, o, twin, regular));
        }
        out.push_str(&table.render(2));
        if let Some(fitted) = report.fitted[o] {
            let due = report.orders[o].map_or(String::new(), |d| format!(", due {d}"));
            out.push_str(&format!("    order over all levels: {fitted:.2}{due}\n"));
        }
    }
    for level in &report.levels {
        if let Some(why) = &level.failed {
            let text = format!("{} failed: {why}", level.level);
            out.push_str(&format!("  {}\n", paint(BAD, &text)));
        }
    }
    out
}

fn row(level: &LevelReport, o: usize, twin: bool, regular: bool) -> Vec<(String, anstyle::Style)> {
    let dash = || ("–".to_string(), DIM);
    let error = |x: Option<f64>| x.map_or_else(dash, |x| (format!("{x:.2e}"), PLAIN));
    let order = |x: Option<f64>| x.map_or_else(dash, |x| (short(x), PLAIN));
    let e = level.errors.get(o);
    let mut cells = vec![(level.level.clone(), PLAIN), (level.work.to_string(), DIM)];
    cells.push(match e {
        Some(e) => error(Some(e.total)),
        None => ("failed".into(), BAD),
    });
    if twin {
        cells.push(error(e.and_then(|e| e.method)));
        cells.push(error(e.and_then(|e| e.rounding)));
    }
    if regular {
        cells.push(order(e.and_then(|e| e.order)));
        cells.push(order(e.and_then(|e| e.richardson)));
    }
    cells
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gallery::Gallery;
    use mechaudit::audit::LevelError;

    /// A fact that is known of no level has no column; one level has all that can be known, one
    /// little, one nothing.
    #[test]
    fn reports() {
        let mut all = Gallery::default();
        let level = |name: &str, errors, failed: Option<&str>| LevelReport {
            level: name.into(),
            work: 8,
            failed: failed.map(Into::into),
            errors,
        };
        let error = |method, order| LevelError {
            total: 0.5,
            method,
            rounding: method,
            order,
            richardson: order,
        };
        let report = |outputs: &[&'static str], levels| ConvergenceReport {
            name: "some",
            summary: "Made up.",
            work_unit: "steps",
            places: "One place.".into(),
            outputs: outputs.to_vec(),
            orders: vec![Some(4.0), None],
            fitted: vec![Some(3.875), Some(2.0)],
            levels,
        };
        let (some, none) = (Some(0.25), None);
        for (method, order) in [(none, none), (none, some), (some, none)] {
            let levels = vec![level("n = 8", vec![error(method, order)], None)];
            all.add(
                format!("{method:?}, {order:?}"),
                text(&report(&["y"], levels)),
            );
        }
        let (full, little) = (error(some, some), error(none, none));
        let levels = vec![
            level("n = 8", vec![full, little], None),
            level("n = 4000", vec![little, full], None),
            level("n = 1", Vec::new(), Some("it stopped")),
        ];
        all.add("two outputs", text(&report(&["y", "z"], levels)));
        all.pin("convergence-texts");
    }
}
