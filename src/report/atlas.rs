//! The atlas for programs: a document of JSON, and its tables as CSV.

use super::csv::{Column, number, table};
use crate::audit::hex_float;
use crate::claims::{Atlas, Decided, Height, Part, Row, Verdict, advice};
use serde_json::{Value, json};
use std::io::Write;

/// The document; a height of `−∞`, everywhere, is written as the word `everywhere`.
pub fn document(atlas: &Atlas) -> Value {
    let mut value = serde_json::to_value(atlas).unwrap_or(Value::Null);
    for (k, row) in atlas.rows.iter().enumerate() {
        for (j, height) in row.heights.iter().enumerate() {
            let word = |h: Option<f64>| h.map_or(Value::Null, |h| json!(self::height(h)));
            let place = &mut value["rows"][k]["heights"][j];
            place["norm"] = word(height.norm);
            place["parts"] = word(height.parts);
        }
    }
    value["schema_version"] = json!(1);
    value["mechaudit_version"] = json!(env!("CARGO_PKG_VERSION"));
    value["advice"] = json!(advice(&atlas.rows));
    value
}

/// From which Im z on: a power of ten, or everywhere.
pub fn height(h: f64) -> String {
    match h {
        f64::NEG_INFINITY => "everywhere".into(),
        h => format!("1e{h}"),
    }
}

fn precision(row: &Row) -> &'static str {
    if row.single { "single" } else { "double" }
}

/// A coordinate of a point of the plane; a line's eight parameters are in the document.
fn coordinate(at: &Option<Vec<f64>>, k: usize) -> String {
    match at.as_deref() {
        Some(at @ [_, _]) => hex_float(at[k]),
        _ => String::new(),
    }
}

/// A line for each code and region, all regions last; a field without a number is empty.
///
/// # Errors
/// Of writing.
pub fn rows(atlas: &Atlas, out: &mut dyn Write) -> Result<(), ::csv::Error> {
    let all = atlas.rows.iter().chain(&atlas.profiles);
    let rows = all.flat_map(|row| row.parts.iter().map(move |part| (row, part)));
    let columns: [Column<(&Row, &Part)>; 16] = [
        ("name", |(row, _)| row.name.clone()),
        ("precision", |(row, _)| precision(row).into()),
        ("region", |(_, p)| p.region.into()),
        ("cases", |(_, p)| p.cases.to_string()),
        ("worst_norm", |(_, p)| {
            number(p.norm.as_ref().map(|f| f.worst))
        }),
        ("p99_norm", |(_, p)| number(p.norm.as_ref().map(|f| f.p99))),
        ("median_norm", |(_, p)| {
            number(p.norm.as_ref().map(|f| f.median))
        }),
        ("worst_re", |(_, p)| number(p.re)),
        ("worst_im", |(_, p)| number(p.im)),
        ("wrong", |(_, p)| p.wrong.to_string()),
        ("negative_re", |(_, p)| p.negative.to_string()),
        ("worst_at_re", |(_, p)| coordinate(&p.worst_at, 0)),
        ("worst_at_im", |(_, p)| coordinate(&p.worst_at, 1)),
        ("worst_derivative", |r| {
            number(whole(r).and_then(|r| Some(r.derivative.as_ref()?.worst)))
        }),
        ("worst_jump_re", |r| number(whole(r).and_then(worst_jump))),
        ("ns", |r| {
            number(whole(r).and_then(|r| r.nanoseconds.map(f64::round)))
        }),
    ];
    table(&columns, rows, out)
}

/// A line for each code and accuracy: from which height on the norm and each part meet it; empty where none does.
///
/// # Errors
/// Of writing.
pub fn heights(atlas: &Atlas, out: &mut dyn Write) -> Result<(), ::csv::Error> {
    let all = atlas.rows.iter();
    let rows = all.flat_map(|row| row.heights.iter().map(move |h| (row, h)));
    let columns: [Column<(&Row, &Height)>; 6] = [
        ("name", |(row, _)| row.name.clone()),
        ("precision", |(row, _)| precision(row).into()),
        ("parts", |(row, _)| match row.real_part_only {
            true => "Re".into(),
            false => "Re and Im".into(),
        }),
        ("target", |(_, h)| format!("{:e}", h.target)),
        ("norm", |(_, h)| h.norm.map_or(String::new(), height)),
        ("each_part", |(_, h)| h.parts.map_or(String::new(), height)),
    ];
    table(&columns, rows, out)
}

/// A line for each claim.
///
/// # Errors
/// Of writing.
pub fn claims(atlas: &Atlas, out: &mut dyn Write) -> Result<(), ::csv::Error> {
    let columns: [Column<&Decided>; 15] = [
        ("algorithm", |c| c.algorithm.into()),
        ("statement", |c| c.statement.into()),
        ("source", |c| c.source.into()),
        ("reading", |c| c.reading.into()),
        ("domain", |c| c.domain.into()),
        ("measure", |c| c.measure.clone()),
        ("bound", |c| number(c.bound)),
        ("verdict", |c| c.verdict.words().into()),
        ("part", |c| part(c).into()),
        ("points", |c| c.points.to_string()),
        ("found", |c| number(c.found)),
        ("within", |c| number(c.within)),
        ("at_re", |c| coordinate(&c.at, 0)),
        ("at_im", |c| coordinate(&c.at, 1)),
        ("reproduce", |c| c.reproduce.clone().unwrap_or_default()),
    ];
    table(&columns, &atlas.claims, out)
}

/// A note about all regions stands in their line.
fn whole<'a>(&(row, part): &(&'a Row, &Part)) -> Option<&'a Row> {
    (part.region == "all").then_some(row)
}

/// The largest relative jump of Re W.
pub fn worst_jump(row: &Row) -> Option<f64> {
    row.jumps.iter().map(|j| j.re).reduce(f64::max)
}

/// Where the claim holds, or why it cannot be tested.
fn part(c: &Decided) -> &str {
    match c.verdict {
        Verdict::NotTestable => c.reading,
        _ => &c.part,
    }
}

#[cfg(test)]
pub(crate) mod tests;
