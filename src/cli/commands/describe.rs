//! Descriptions of methods, from the layout that the judge reads answers by: `describe` prints the
//! long form, `list` the short one.

use crate::cli::args::{DescribeArgs, ListArgs};
use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::output::print_as;
use crate::cli::lookup;
use crate::cli::process::wire;
use crate::cli::terminal::width;
use mechaudit::audit::{
    Budget, Case, Cases, Layout, Method, Settings, SolverAnswer, answer_of, hex_float,
};
use mechaudit::report::text::style::{BOLD, DIM, PLAIN, paint, paragraph, wrap};
use mechaudit::report::text::table::Table;
use mechaudit::report::words::audit::proved;
use mechaudit::report::words::numbers::unit;
use mechaudit::{methods, papers};
use serde_json::{Value, json};

/// Describes a method.
pub fn describe(args: &DescribeArgs) -> Result<Outcome, Failure> {
    let method = lookup::method(&args.method)?;
    print_as(args.format, || text(&*method, width()), || json(&*method))?;
    Ok(Outcome::AsExpected)
}

/// Lists a method, or all methods and papers.
pub fn list(args: &ListArgs) -> Result<Outcome, Failure> {
    let methods = lookup::methods(args.method.as_deref())?;
    let all = args.method.is_none();
    let text = || {
        let mut out: String = methods.iter().map(|m| short(&**m, width())).collect();
        if all {
            out += &format!("\n{}\n", paint(BOLD, "Papers"));
            for key in papers::keys() {
                out += &format!("  {key:<20} mechaudit paper {key}\n");
            }
        }
        out
    };
    let document = || match methods.as_slice() {
        [method] if !all => json(&**method),
        methods => {
            let methods: Vec<Value> = methods.iter().map(|m| json(&**m)).collect();
            json!({ "methods": methods, "papers": papers::keys() })
        }
    };
    print_as(args.format, text, document)?;
    Ok(Outcome::AsExpected)
}

/// Returns the name and the summary of a method, the summary wrapped beside the name.
pub fn short(method: &dyn Method, width: usize) -> String {
    format!(
        "{:<31} {}\n",
        method.name(),
        wrap(method.summary(), 32, width)
    )
}

/// Returns the names of the outputs that share a budget, with the budget.
fn budgets(method: &dyn Method, layout: &Layout) -> Vec<(Vec<String>, Budget)> {
    let mut groups: Vec<(Vec<String>, Budget)> = Vec::new();
    for o in method.outputs() {
        let name = layout.output(o.name);
        match groups.iter_mut().find(|g| g.1 == o.budget) {
            Some(group) => group.0.push(name),
            None => groups.push((vec![name], o.budget)),
        }
    }
    groups
}

/// Returns the shortest case with an answer of values among the first of the regions; check points
/// come before them.
fn example(method: &dyn Method) -> Option<(Case, Vec<f64>)> {
    let settings = Settings {
        cases_per_region: 3,
        ..Settings::default()
    };
    let cases = Cases::new(method, &settings);
    let points = method.domain().check_points.len();
    let answered = (points..cases.len()).filter_map(|i| {
        let case = cases.get(i);
        match answer_of(method, &case.input) {
            SolverAnswer::Values(v) if v.iter().all(|x| x.is_finite()) => Some((case, v)),
            _ => None,
        }
    });
    answered.min_by_key(|(case, v)| case.input.len() + v.len())
}

fn json(method: &dyn Method) -> Value {
    let layout = Layout::new(method);
    let domain = method.domain();
    let shapes = layout.shapes();
    let fields = methods::fields(method.name());
    let inputs: Vec<Value> = shapes
        .iter()
        .enumerate()
        .map(|(k, s)| {
            json!({
                "symbol": s.symbol,
                "field_in_rust": fields.as_ref().and_then(|f| f.get(k)),
                "length": s.length,
                "unit": s.unit,
                "note": s.note,
                "data": method.is_data(k),
            })
        })
        .collect();
    let outputs = method.outputs().into_iter().map(|o| {
        json!({
            "name": o.name,
            "unit": o.unit,
            "budget": o.budget,
            "budget_in_words": o.budget.limit.to_string(),
        })
    });
    let regions = domain.regions.iter().map(|r| {
        json!({
            "name": r.name,
            "description": r.description,
            "ordinary": r.is_ordinary(method.stream()),
        })
    });
    let laws = method.laws().into_iter();
    let laws = laws.map(|l| json!({ "name": l.name, "statement": l.statement }));
    let points = domain.check_points.iter();
    let points = points
        .map(|p| json!({ "name": p.name, "input": p.input, "input_hexadecimal": hex(&p.input) }));
    let example = example(method).map(|(case, values)| {
        json!({
            "input": wire::line(&case.input, false),
            "answer": wire::line(&values, false),
        })
    });
    json!({
        "schema_version": 1,
        "mechaudit_version": env!("CARGO_PKG_VERSION"),
        "method": method.name(),
        "name": method.name(),
        "summary": method.summary(),
        "source": method.source(),
        "remarks": method.remarks(),
        "inputs": inputs,
        "outputs": outputs.collect::<Vec<_>>(),
        "rows": method.rows(),
        "norm_budget": method.norm_budget(),
        "proved": method.proved(),
        "laws": laws.collect::<Vec<_>>(),
        "input": layout.input(),
        "answer": layout.answer(),
        "rust": methods::signature(method.name()),
        "regions": regions.collect::<Vec<_>>(),
        "check_points": points.collect::<Vec<_>>(),
        "hard_cases": method.hard().len(),
        "example": example,
    })
}

fn hex(input: &[f64]) -> Vec<String> {
    input.iter().map(|x| hex_float(*x)).collect()
}

fn text(method: &dyn Method, width: usize) -> String {
    let layout = Layout::new(method);
    let shapes = layout.shapes();
    let line = |label: &str, text: &str| format!("  {label:<13}{}\n", wrap(text, 15, width));
    let mut out = format!("{}\n", paint(BOLD, method.name()));
    out.push_str(&paragraph(method.summary(), 2, width));
    out.push_str(&line("source", method.source()));
    for (i, remark) in method.remarks().iter().enumerate() {
        out.push_str(&line(if i == 0 { "remarks" } else { "" }, remark));
    }
    if let Some(signature) = methods::signature(method.name()) {
        out.push_str(&line("in Rust", signature));
    }
    let fields = methods::fields(method.name());
    let mut head = vec!["input", "length", "unit", "", "note"];
    if fields.is_some() {
        head.insert(1, "field in Rust");
    }
    let left: Vec<usize> = (0..head.len()).collect();
    let mut table = Table::new(&head, &left);
    for (k, s) in shapes.iter().enumerate() {
        let kind = match method.is_data(k) {
            true => "data",
            false => "count or choice",
        };
        let mut row = vec![
            (s.symbol.into(), PLAIN),
            (s.length.clone().unwrap_or_default(), PLAIN),
            (unit(s.unit), PLAIN),
            (kind.into(), DIM),
            (s.note.unwrap_or_default().into(), PLAIN),
        ];
        if let Some(field) = fields.as_ref().and_then(|f| f.get(k)) {
            row.insert(1, (field.clone(), DIM));
        }
        table.row(row);
    }
    out.push_str(&table.render(2));
    let mut table = Table::new(&["output", "unit", "budget"], &[0, 1, 2]);
    for o in method.outputs() {
        table.row(vec![
            (layout.output(o.name), PLAIN),
            (unit(o.unit), PLAIN),
            (o.budget.limit.to_string(), PLAIN),
        ]);
    }
    out.push_str(&table.render(2));
    if let Some(rows) = layout.rows() {
        out.push_str(&line("rows", &rows));
    }
    for (i, (names, budget)) in budgets(method, &layout).iter().enumerate() {
        let text = format!("{}: {}", names.join(", "), budget.reason);
        out.push_str(&line(if i == 0 { "reasons" } else { "" }, &text));
    }
    if let Some(norm) = method.norm_budget() {
        out.push_str(&line("all together", &format!("{norm}; {}", norm.reason)));
    }
    for bound in method.proved() {
        out.push_str(&line("proved", &proved(&bound)));
    }
    for (i, law) in method.laws().iter().enumerate() {
        let text = format!("{}: {}", law.name, law.statement);
        out.push_str(&line(if i == 0 { "laws" } else { "" }, &text));
    }
    if let Some((case, values)) = example(method) {
        out.push_str(&line("a line in", &wire::line(&case.input, false)));
        out.push_str(&line("a line out", &wire::line(&values, false)));
    }
    let domain = method.domain();
    let (ordinary, ends): (Vec<_>, Vec<_>) =
        (domain.regions.iter()).partition(|r| r.is_ordinary(method.stream()));
    for (label, regions) in [("regions", ordinary), ("end of range", ends)] {
        for (i, r) in regions.iter().enumerate() {
            let text = format!("{}: {}", r.name, r.description);
            out.push_str(&line(if i == 0 { label } else { "" }, &text));
        }
    }
    let points: Vec<&str> = domain.check_points.iter().map(|p| p.name).collect();
    out.push_str(&line("check points", &points.join(", ")));
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gallery::Gallery;

    /// Each output stands once, with those that share its budget.
    #[test]
    fn outputs_are_grouped_by_budget() {
        for method in methods::registry() {
            let layout = Layout::new(&*method);
            let groups = budgets(&*method, &layout);
            let named = groups.iter().flat_map(|g| &g.0).count();
            assert_eq!(named, method.outputs().len());
            for o in method.outputs() {
                let name = layout.output(o.name);
                let of: Vec<_> = groups.iter().filter(|g| g.0.contains(&name)).collect();
                assert!(
                    of.len() == 1 && of[0].1 == o.budget,
                    "{}: {name}",
                    method.name()
                );
            }
        }
    }

    /// No other case of the first in each region is shorter.
    #[test]
    fn the_example_is_a_short_one() {
        for name in ["tridiagonal", "cubic-spline-clamped", "faddeeva"] {
            let method = lookup::method(name).unwrap();
            let (case, values) = example(&*method).unwrap();
            assert!(values.iter().all(|x| x.is_finite()));
            assert_eq!(
                answer_of(&*method, &case.input),
                SolverAnswer::Values(values.clone())
            );
            let settings = Settings {
                cases_per_region: 3,
                ..Settings::default()
            };
            let cases = Cases::new(&*method, &settings);
            let points = method.domain().check_points.len();
            let length = case.input.len() + values.len();
            for i in points..cases.len() {
                let other = cases.get(i);
                if let SolverAnswer::Values(v) = answer_of(&*method, &other.input)
                    && v.iter().all(|x| x.is_finite())
                {
                    assert!(length <= other.input.len() + v.len(), "{name}: {i}");
                }
            }
        }
    }

    #[test]
    fn methods_are_described() {
        let mut all = Gallery::default();
        for name in [
            "slider-crank",
            "cubic-spline-clamped",
            "tridiagonal",
            "voigt",
        ] {
            all.add(name, text(&*lookup::method(name).unwrap(), 100));
        }
        all.pin("descriptions");
    }
}
