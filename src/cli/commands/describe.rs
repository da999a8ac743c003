//! A method described to whoever writes a candidate, from the layout that the judge reads answers by.

use crate::cli::args::{DescribeArgs, TextOrJson};
use crate::cli::commands::audit::find;
use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::output::{print_json, write_to};
use crate::cli::process::wire;
use crate::cli::terminal::width;
use mechaudit::audit::{Case, Cases, Layout, Method, Settings, SolverAnswer, answer_of, hex_float};
use mechaudit::methods;
use mechaudit::report::text::style::{BOLD, DIM, PLAIN, paint, paragraph, wrap};
use mechaudit::report::text::table::Table;
use mechaudit::report::words::numbers::unit;
use serde_json::{Value, json};

/// Describes it.
pub fn describe(args: &DescribeArgs) -> Result<Outcome, Failure> {
    let method = find(&args.method)?;
    match args.format {
        TextOrJson::Text => {
            let text = text(&*method, width());
            write_to(None, |out| Ok(write!(out, "{text}")?))?;
        }
        TextOrJson::Json => print_json(&json(&*method))?,
    }
    Ok(Outcome::AsExpected)
}

/// The shortest case with an answer of values among the first of the regions; check points come before them.
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
    let inputs: Vec<Value> = shapes
        .iter()
        .enumerate()
        .map(|(k, s)| {
            json!({
                "symbol": s.symbol,
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
            "ordinary": r.is_ordinary(method.name()),
        })
    });
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
        "summary": method.summary(),
        "source": method.source(),
        "inputs": inputs,
        "outputs": outputs.collect::<Vec<_>>(),
        "rows": method.rows(),
        "norm_budget": method.norm_budget(),
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
    if let Some(signature) = methods::signature(method.name()) {
        out.push_str(&line("in Rust", signature));
    }
    let mut table = Table::new(&["input", "length", "unit", "", "note"], &[0, 1, 2, 3, 4]);
    for (k, s) in shapes.iter().enumerate() {
        let kind = match method.is_data(k) {
            true => "data",
            false => "count or choice",
        };
        table.row(vec![
            (s.symbol.into(), PLAIN),
            (s.length.clone().unwrap_or_default(), PLAIN),
            (unit(s.unit), PLAIN),
            (kind.into(), DIM),
            (s.note.unwrap_or_default().into(), PLAIN),
        ]);
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
    if let Some(norm) = method.norm_budget() {
        out.push_str(&line("all together", &norm.to_string()));
    }
    if let Some((case, values)) = example(method) {
        out.push_str(&line("a line in", &wire::line(&case.input, false)));
        out.push_str(&line("a line out", &wire::line(&values, false)));
    }
    let domain = method.domain();
    let (ordinary, ends): (Vec<_>, Vec<_>) =
        (domain.regions.iter()).partition(|r| r.is_ordinary(method.name()));
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
