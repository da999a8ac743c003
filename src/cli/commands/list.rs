//! The list of methods and papers.

use crate::cli::args::{ListArgs, TextOrJson};
use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::output::{print_as, print_json, write_to};
use crate::cli::lookup;
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
        let method = lookup::method(name)?;
        print_as(args.format, || text(&*method, width()), || json(&*method))?;
        return Ok(Outcome::AsExpected);
    }
    match args.format {
        TextOrJson::Text => write_to(|out| {
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

#[cfg(test)]
mod tests {
    use super::*;
    use mechaudit::report::text::style::plain;

    /// The label stands before the first of several, and all texts begin in one column.
    #[test]
    fn a_method_is_listed_by_its_parts() {
        for method in methods::registry() {
            let name = method.name();
            let text = plain(&text(&*method, 100_000));
            let lines: Vec<&str> = text.lines().collect();
            assert_eq!(lines[0], name);
            assert!(
                lines[1].starts_with("  ") && lines[1][2..].starts_with(|c| c != ' '),
                "{text}"
            );
            let at = lines
                .iter()
                .position(|l| l.starts_with("  input "))
                .unwrap();
            let domain = method.domain();
            let parts: Vec<(String, String)> = lines[at..]
                .iter()
                .map(|line| {
                    let (label, text) = line.split_at(15);
                    assert!(text.starts_with(|c| c != ' '), "{line}");
                    (label.trim().to_owned(), text.to_owned())
                })
                .collect();
            let texts = |label: &str| -> Vec<&str> {
                let from = parts.iter().position(|p| p.0 == label);
                let from = from.map_or(&parts[..0], |k| &parts[k..]);
                let more = from.iter().skip(1).take_while(|p| p.0.is_empty());
                from.iter().take(1).chain(more).map(|p| &*p.1).collect()
            };
            let labels: Vec<&str> = parts
                .iter()
                .map(|p| &*p.0)
                .filter(|l| !l.is_empty())
                .collect();
            let mut due = vec!["input", "output"];
            due.extend(method.proved().iter().map(|_| "proved"));
            due.push("regions");
            due.extend((!domain.check_points.is_empty()).then_some("check points"));
            due.extend((!method.laws().is_empty()).then_some("laws"));
            due.push("source");
            assert_eq!(labels, due, "{text}");
            assert_eq!(texts("input"), [Layout::new(&*method).input()]);
            let regions: Vec<String> = (domain.regions.iter())
                .map(|r| format!("{}: {}", r.name, r.description))
                .collect();
            assert_eq!(texts("regions"), regions);
            let laws: Vec<String> = (method.laws().iter())
                .map(|l| format!("{}: {}", l.name, l.statement))
                .collect();
            assert_eq!(texts("laws"), laws);
            let points: Vec<&str> = domain.check_points.iter().map(|p| p.name).collect();
            assert!(points.is_empty() || texts("check points") == [points.join(", ")]);
            assert_eq!(texts("source"), [method.source()]);
            let proved: Vec<String> = method.proved().iter().map(proved).collect();
            let found = parts
                .iter()
                .filter(|p| p.0 == "proved")
                .map(|p| p.1.clone());
            assert_eq!(found.collect::<Vec<_>>(), proved);
            // Budgets, and what is beside them.
            let layout = Layout::new(&*method);
            let groups = outputs(&*method, &layout);
            let rest = layout.rows().is_some() as usize + method.norm_budget().is_some() as usize;
            let found = texts("output");
            assert_eq!(found.len(), groups.len() + rest, "{text}");
            if let Some(rows) = layout.rows() {
                assert_eq!(found[groups.len()], rows);
            }
            if let Some(norm) = method.norm_budget() {
                let last = found[found.len() - 1];
                assert!(
                    last.starts_with(&format!("all together: {norm}; ")),
                    "{last}"
                );
            }
        }
    }

    /// Each output once, with those that share its budget.
    #[test]
    fn outputs_are_grouped_by_budget() {
        for method in methods::registry() {
            let layout = Layout::new(&*method);
            let groups = outputs(&*method, &layout);
            let named = groups.iter().flat_map(|g| &g.0).count();
            assert_eq!(named, method.outputs().len());
            for o in method.outputs() {
                let name = format!("{}{}", layout.output(o.name), unit(o.unit));
                let of: Vec<_> = groups.iter().filter(|g| g.0.contains(&name)).collect();
                assert!(
                    of.len() == 1 && of[0].1 == o.budget,
                    "{}: {name}",
                    method.name()
                );
            }
            for (k, group) in groups.iter().enumerate() {
                assert!(
                    groups[k + 1..].iter().all(|g| g.1 != group.1),
                    "{}",
                    method.name()
                );
            }
        }
    }

    #[test]
    fn units_stand_in_brackets() {
        for (text, due) in [("1", ""), ("m", " [m]"), ("rad", " [rad]")] {
            assert_eq!(unit(text), due);
        }
    }
}
