//! Convergence of approximations, with method error and rounding apart.

use super::plots;
use crate::audit::{ConvergenceReport, LevelError, Uncertified};
use maud::{Markup, html};

/// A line of a diagram: its name, work and error.
type Line = (String, Vec<(f64, f64)>);

/// All of them; approximations of the same problem stand in one diagram.
pub fn all(reports: &[Result<ConvergenceReport, Uncertified>]) -> Markup {
    let mut rest: Vec<&ConvergenceReport> = reports.iter().flatten().collect();
    let mut problems = Vec::new();
    while let Some(first) = rest.first().copied() {
        let (same, others): (Vec<_>, _) =
            rest.into_iter().partition(|r| r.summary == first.summary);
        rest = others;
        problems.push((first, same));
    }
    html! {
        h2 id="convergence" { "Convergence, work and precision" } "\n"
        @for why in reports.iter().filter_map(|r| r.as_ref().err()) { p.alarm { (why) } "\n" }
        @for (first, same) in &problems { (problem(first, same)) }
    }
}

fn problem(first: &ConvergenceReport, reports: &[&ConvergenceReport]) -> Markup {
    let names: Vec<&str> = reports.iter().map(|r| r.name).collect();
    let levels = || reports.iter().flat_map(|r| &r.levels);
    let failed = levels().filter(|l| l.failed.is_some()).count();
    html! {
        h3 { (names.join(", ")) } "\n"
        p { (first.summary) "; " (first.places) } "\n"
        div.lines { "\n"
            @for (o, name) in first.outputs.iter().enumerate() {
                @let orders = reports.iter().filter_map(|r| r.fitted[o]);
                @let orders: Vec<String> = orders.map(|x| format!("{x:.2}")).collect();
                figure {
                    (plots::lines("error against work, both logarithmic", &lines(reports, o)))
                    figcaption {
                        "error of " (name) " against " (first.work_unit)
                        "; order over all levels " (orders.join(", "))
                        @if failed > 0 { "; " (failed) " runs failed" }
                    }
                } "\n"
            }
        } "\n"
    }
}

/// Total error of an output against work, and its parts where they are known.
fn lines(reports: &[&ConvergenceReport], output: usize) -> Vec<Line> {
    let mut lines = Vec::new();
    for r in reports {
        let line = |f: fn(&LevelError) -> Option<f64>| -> Vec<(f64, f64)> {
            let point =
                |l: &crate::audit::LevelReport| Some((l.work as f64, f(l.errors.get(output)?)?));
            r.levels.iter().filter_map(point).collect()
        };
        let name = |part: &str| match reports.len() {
            1 => part.to_string(),
            _ => format!("{} {part}", r.name),
        };
        lines.push((name("total"), line(|e| Some(e.total))));
        let mut errors = r.levels.iter().flat_map(|l| &l.errors);
        if errors.any(|e| e.method.is_some()) {
            lines.push((name("method"), line(|e| e.method)));
            lines.push((name("rounding"), line(|e| e.rounding)));
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::audit::LevelReport;
    use crate::report::gallery::Gallery;

    fn report(name: &'static str, summary: &'static str, parts: bool) -> ConvergenceReport {
        let error = |total: f64| LevelError {
            total,
            method: parts.then_some(total),
            rounding: parts.then_some(1e-16),
            order: None,
            richardson: None,
        };
        let level = |work, total| LevelReport {
            level: String::new(),
            work,
            failed: None,
            errors: vec![error(total)],
        };
        ConvergenceReport {
            name,
            summary,
            work_unit: "steps",
            places: "one place".into(),
            outputs: vec!["y"],
            orders: vec![None],
            fitted: vec![Some(4.0)],
            levels: vec![level(10, 1e-2), level(100, 1e-6)],
        }
    }

    /// Approximations of a problem share a diagram with a line for each part, where any level has
    /// it; runs that failed are counted.
    #[test]
    fn diagrams() {
        let mut shown = Gallery::default();
        let reports = [
            report("a", "first", true),
            report("b", "second", true),
            report("c", "first", false),
        ];
        shown.add("of three", all(&reports.map(Ok)).into_string());
        let mut first = report("a", "first", true);
        first.levels[1].errors[0].method = None;
        first.levels.push(LevelReport {
            level: String::new(),
            work: 1000,
            failed: Some("too long".into()),
            errors: Vec::new(),
        });
        let why = crate::audit::Uncertified::Undecided("y".into());
        shown.add("failed", all(&[Ok(first), Err(why)]).into_string());
        shown.pin("convergence");
    }
}
