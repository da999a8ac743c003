//! The atlas for programs: a document of JSON, and its tables as CSV.

use crate::audit::hex_float;
use crate::claims::{Atlas, Figures, Verdict, advice};
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

fn number(x: Option<f64>) -> String {
    x.map_or(String::new(), |x| format!("{x:e}"))
}

fn spread(f: Option<&Figures>) -> [String; 3] {
    match f {
        Some(f) => [f.worst, f.p99, f.median].map(|x| format!("{x:e}")),
        None => Default::default(),
    }
}

/// A point of the plane; a line's eight parameters are in the document.
fn point(at: Option<&[f64]>) -> [String; 2] {
    match at {
        Some([x, y]) => [hex_float(*x), hex_float(*y)],
        _ => Default::default(),
    }
}

/// A line for each code and region, all regions last; a field without a number is empty.
///
/// # Errors
/// Of writing.
pub fn rows(atlas: &Atlas, out: &mut dyn Write) -> Result<(), ::csv::Error> {
    let mut csv = ::csv::Writer::from_writer(out);
    csv.write_record([
        "name",
        "precision",
        "region",
        "cases",
        "worst_norm",
        "p99_norm",
        "median_norm",
        "worst_re",
        "worst_im",
        "wrong",
        "negative_re",
        "worst_at_re",
        "worst_at_im",
        "worst_derivative",
        "worst_jump_re",
        "ns",
    ])?;
    for row in atlas.rows.iter().chain(&atlas.profiles) {
        for part in &row.parts {
            let mut fields = vec![
                row.name.clone(),
                if row.single { "single" } else { "double" }.into(),
                part.region.into(),
                part.cases.to_string(),
            ];
            fields.extend(spread(part.norm.as_ref()));
            fields.extend([number(part.re), number(part.im)]);
            fields.extend([part.wrong.to_string(), part.negative.to_string()]);
            fields.extend(point(part.worst_at.as_deref()));
            let all = part.region == "all";
            let once = |x: Option<f64>| number(x.filter(|_| all));
            fields.push(once(row.derivative.as_ref().map(|d| d.worst)));
            let jump = row.jumps.iter().map(|j| j.re).reduce(f64::max);
            fields.push(once(jump));
            fields.push(once(row.nanoseconds.map(f64::round)));
            csv.write_record(fields)?;
        }
    }
    Ok(csv.flush()?)
}

/// A line for each claim.
///
/// # Errors
/// Of writing.
pub fn claims(atlas: &Atlas, out: &mut dyn Write) -> Result<(), ::csv::Error> {
    let mut csv = ::csv::Writer::from_writer(out);
    csv.write_record([
        "algorithm",
        "statement",
        "source",
        "reading",
        "domain",
        "measure",
        "bound",
        "verdict",
        "part",
        "points",
        "found",
        "within",
        "at_re",
        "at_im",
        "reproduce",
    ])?;
    for c in &atlas.claims {
        let part = match c.verdict {
            Verdict::NotTestable => c.reading,
            _ => &c.part,
        };
        let [re, im] = point(c.at.as_deref());
        csv.write_record([
            c.algorithm,
            c.statement,
            c.source,
            c.reading,
            c.domain,
            &c.measure,
            &number(c.bound),
            c.verdict.words(),
            part,
            &c.points.to_string(),
            &number(c.found),
            &number(c.within),
            &re,
            &im,
            c.reproduce.as_deref().unwrap_or(""),
        ])?;
    }
    Ok(csv.flush()?)
}

#[cfg(test)]
#[path = "atlas_tests.rs"]
pub(crate) mod tests;
