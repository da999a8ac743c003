//! Judging a published table of values, entry by entry.

use super::args::TextOrJson;
use super::audit::print_json;
use super::failure::{Failure, Outcome};
use super::output::write_to;
use super::text::{BAD, BOLD, DIM, DOUBT, GOOD, PLAIN, Table, paint, short};
use mechaudit::audit::{Agreement, EntryJudgement, Method, Settings, judge_printed};
use mechaudit::reference::Decimal;
use rayon::prelude::*;
use rug::Rational;
use serde_json::json;
use std::path::Path;

/// What a column holds.
#[derive(Clone, Copy)]
enum Column {
    Input,
    /// Printed values with that index among the method's.
    Value(usize),
}

/// A line of the table as printed.
pub(super) struct Row {
    line: u64,
    input: Vec<Rational>,
    /// Index of the value, column, text and number.
    entries: Vec<(usize, usize, String, Decimal)>,
}

/// An entry with its verdict.
struct Judged {
    line: u64,
    column: usize,
    text: String,
    found: EntryJudgement,
}

/// Judges the table in a CSV file: columns named as an output hold printed values, all others the
/// inputs in their order, exactly as printed.
pub fn judge(method: &dyn Method, path: &Path, format: TextOrJson) -> Result<Outcome, Failure> {
    let named = |e: String| Failure::new(format!("{}: {e}", path.display()));
    let file = std::fs::File::open(path).map_err(|e| named(e.to_string()))?;
    let (header, rows) = read(method, file).map_err(named)?;
    let settings = Settings::default();
    let judged: Vec<Judged> = rows
        .into_par_iter()
        .flat_map_iter(|row| {
            let due: Vec<(usize, &Decimal)> = row.entries.iter().map(|e| (e.0, &e.3)).collect();
            let found = judge_printed(method, &row.input, &due, &settings);
            let pairs: Vec<_> = row.entries.into_iter().zip(found).collect();
            let line = row.line;
            pairs
                .into_iter()
                .map(move |((_, column, text, _), found)| Judged {
                    line,
                    column,
                    text,
                    found,
                })
        })
        .collect();
    let count = |a: Agreement| judged.iter().filter(|j| j.found.agreement == a).count();
    let agreeing = count(Agreement::Agrees);
    let good = !judged.is_empty() && agreeing == judged.len();
    match format {
        TextOrJson::Text => write_to(None, |out| {
            let (word, style) = if good { ("pass", GOOD) } else { ("FAIL", BAD) };
            let (all, name) = (judged.len(), paint(BOLD, method.name()));
            let word = paint(style, word);
            writeln!(
                out,
                "{name}  {word}  {agreeing} of {all} entries agree within half a unit of their last digit"
            )?;
            let (near, far) = (count(Agreement::LastDigit), count(Agreement::Differs));
            let (open, none) = (count(Agreement::Undecided), count(Agreement::NoValue));
            writeln!(
                out,
                "  last digit off by one: {near}, farther off: {far}, undecided: {open}, no such value: {none}"
            )?;
            if !good {
                write!(out, "{}", table(&header, &judged))?;
            }
            Ok(())
        })?,
        TextOrJson::Json => {
            let entries = judged.iter().map(|j| {
                json!({
                    "line": j.line,
                    "output": header[j.column],
                    "printed": j.text,
                    "judgement": j.found,
                })
            });
            print_json(&json!({
                "mechaudit_version": env!("CARGO_PKG_VERSION"),
                "method": method.name(),
                "passed": good,
                "agreeing": agreeing,
                "entries": entries.collect::<Vec<_>>(),
            }))?;
        }
    }
    Ok(Outcome::of(good))
}

/// The entries that do not agree.
fn table(header: &[String], judged: &[Judged]) -> String {
    let mut table = Table::new(
        &["line", "output", "printed", "reference", "units off"],
        &[1, 3],
    );
    for j in judged {
        let style = match j.found.agreement {
            Agreement::Agrees => continue,
            Agreement::LastDigit | Agreement::Undecided => DOUBT,
            _ => BAD,
        };
        let reason = j.found.reason.clone().unwrap_or_default();
        let reference = j.found.reference.clone().unwrap_or(reason);
        let units = match j.found.units {
            u if u.is_nan() => "–".into(),
            u => short(u),
        };
        table.row(vec![
            (j.line.to_string(), DIM),
            (header[j.column].clone(), PLAIN),
            (j.text.clone(), style),
            (reference, PLAIN),
            (units, style),
        ]);
    }
    table.render(2)
}

/// The header and the lines of a table.
pub(super) fn read(
    method: &dyn Method,
    input: impl std::io::Read,
) -> Result<(Vec<String>, Vec<Row>), String> {
    let mut reader = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .trim(csv::Trim::All)
        .from_reader(input);
    let header: Vec<String> = reader
        .headers()
        .map_err(|e| e.to_string())?
        .iter()
        .map(|h| h.split(" [").next().unwrap_or(h).to_string())
        .collect();
    let columns = columns(method, &header)?;
    let mut rows = Vec::new();
    for record in reader.records() {
        let record = record.map_err(|e| e.to_string())?;
        let line = record.position().map_or(0, csv::Position::line);
        let mut row = Row {
            line,
            input: Vec::new(),
            entries: Vec::new(),
        };
        for (k, (text, column)) in record.iter().zip(&columns).enumerate() {
            let number = || Decimal::parse(text).map_err(|e| format!("line {line}: {e}"));
            match column {
                Column::Input => row.input.push(number()?.value),
                // Nothing was printed here.
                Column::Value(_) if text.is_empty() => {}
                Column::Value(i) => row.entries.push((*i, k, text.into(), number()?)),
            }
        }
        rows.push(row);
    }
    if rows.iter().all(|r| r.entries.is_empty()) {
        return Err("there are no entries".into());
    }
    Ok((header, rows))
}

fn columns(method: &dyn Method, header: &[String]) -> Result<Vec<Column>, String> {
    let outputs: Vec<&str> = method.outputs().iter().map(|o| o.name).collect();
    let mut met = vec![0; outputs.len()];
    let columns = header
        .iter()
        .map(|name| match outputs.iter().position(|o| o == name) {
            None => Column::Input,
            // An output named again is the next of its kind.
            Some(o) => {
                met[o] += 1;
                Column::Value((met[o] - 1) * outputs.len() + o)
            }
        });
    let columns: Vec<Column> = columns.collect();
    match columns.iter().any(|c| matches!(c, Column::Value(_))) {
        true => Ok(columns),
        false => Err(format!(
            "no column is named as an output of {}: {}",
            method.name(),
            outputs.join(", ")
        )),
    }
}
