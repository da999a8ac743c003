//! The list of methods and papers.

use crate::cli::args::{ListArgs, TextOrJson};
use crate::cli::commands::audit::find;
use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::output::{print_json, write_to};
use crate::cli::terminal::width;
use mechaudit::audit::{Budget, Layout, Method};
use mechaudit::report::text::style::{BOLD, paint, paragraph, wrap};
use mechaudit::report::words::audit::proved;
use mechaudit::report::words::numbers;
use mechaudit::{methods, papers};
use serde_json::{Value, json};

/// Lists methods and papers.
pub fn list(args: &ListArgs) -> Result<Outcome, Failure> {
    if let Some(name) = &args.method {
        let method = find(name)?;
        match args.format {
            TextOrJson::Text => {
                let text = text(&*method, width());
                write_to(None, |out| Ok(write!(out, "{text}")?))?;
            }
            TextOrJson::Json => print_json(&json(&*method))?,
        }
        return Ok(Outcome::AsExpected);
    }
    match args.format {
        TextOrJson::Text => write_to(None, |out| {
            for method in methods::registry() {
                writeln!(out, "{}", text(method.as_ref(), width()))?;
            }
            writeln!(out, "{}", paint(BOLD, "Papers"))?;
            for key in papers::keys() {
                writeln!(out, "  {key:<20} mechaudit paper {key}")?;
            }
            Ok(())
        })?,
        TextOrJson::Json => {
            let all: Vec<Value> = methods::registry()
                .iter()
                .map(|m| json(m.as_ref()))
                .collect();
            print_json(&json!({ "methods": all, "papers": papers::keys() }))?;
        }
    }
    Ok(Outcome::AsExpected)
}

/// A line "label  text" with the text wrapped beside the label.
fn line(label: &str, text: &str, width: usize) -> String {
    format!("  {label:<13}{}\n", wrap(text, 15, width))
}

/// A unit in brackets, nothing where there is none.
fn unit(unit: &str) -> String {
    match numbers::unit(unit) {
        u if u.is_empty() => u,
        u => format!(" [{u}]"),
    }
}

/// Names of the outputs that share a budget, with the budget.
fn outputs(method: &dyn Method, layout: &Layout) -> Vec<(Vec<String>, Budget)> {
    let mut groups: Vec<(Vec<String>, Budget)> = Vec::new();
    for o in method.outputs() {
        let name = format!("{}{}", layout.output(o.name), unit(o.unit));
        match groups.iter_mut().find(|g| g.1 == o.budget) {
            Some(group) => group.0.push(name),
            None => groups.push((vec![name], o.budget)),
        }
    }
    groups
}

fn text(method: &dyn Method, width: usize) -> String {
    let mut out = format!("{}\n", paint(BOLD, method.name()));
    out.push_str(&paragraph(method.summary(), 2, width));
    let layout = Layout::new(method);
    out.push_str(&line("input", &layout.input(), width));
    for (i, (names, budget)) in outputs(method, &layout).iter().enumerate() {
        let text = format!("{}: {}; {}", names.join(", "), budget.limit, budget.reason);
        out.push_str(&line(if i == 0 { "output" } else { "" }, &text, width));
    }
    if let Some(rows) = layout.rows() {
        out.push_str(&line("", &rows, width));
    }
    if let Some(norm) = method.norm_budget() {
        let text = format!("all together: {norm}; {}", norm.reason);
        out.push_str(&line("", &text, width));
    }
    for bound in method.proved() {
        out.push_str(&line("proved", &proved(&bound), width));
    }
    let domain = method.domain();
    for (i, r) in domain.regions.iter().enumerate() {
        let text = format!("{}: {}", r.name, r.description);
        out.push_str(&line(if i == 0 { "regions" } else { "" }, &text, width));
    }
    let points: Vec<&str> = domain.check_points.iter().map(|p| p.name).collect();
    if !points.is_empty() {
        out.push_str(&line("check points", &points.join(", "), width));
    }
    for (i, law) in method.laws().iter().enumerate() {
        let text = format!("{}: {}", law.name, law.statement);
        out.push_str(&line(if i == 0 { "laws" } else { "" }, &text, width));
    }
    out.push_str(&line("source", method.source(), width));
    out
}

fn json(method: &dyn Method) -> Value {
    let domain = method.domain();
    let regions = domain.regions.iter();
    let laws = method.laws();
    json!({
        "name": method.name(),
        "summary": method.summary(),
        "source": method.source(),
        "inputs": method.inputs(),
        "outputs": method.outputs(),
        "rows": method.rows(),
        "input": Layout::new(method).input(),
        "answer": Layout::new(method).answer(),
        "norm_budget": method.norm_budget(),
        "proved": method.proved(),
        "regions": regions
            .map(|r| json!({ "name": r.name, "description": r.description }))
            .collect::<Vec<_>>(),
        "check_points": domain.check_points.iter().map(|p| p.name).collect::<Vec<_>>(),
        "laws": laws
            .iter()
            .map(|l| json!({ "name": l.name, "statement": l.statement }))
            .collect::<Vec<_>>(),
    })
}
