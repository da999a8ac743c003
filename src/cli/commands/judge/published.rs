//! Judging a published table of values, entry by entry.

use crate::cli::args::{AuditFormat, JudgeArgs};
use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::bounded::Bounded;
use crate::cli::files::output::{Output, write_json};
use crate::cli::number::{FIELDS, LONGEST, Number, NumberError};
use crate::cli::report::{self, ReportExtras};
use mechaudit::audit::{
    Agreement, CandidateReport, Case, CaseReport, Column, ComponentJudgement, EntryJudgement,
    Judgement, Kind, Layout, LayoutError, Limit, Method, Origin, Printed, PrintedUnit, Reproduce,
    Settings, SolverAnswer, Tally, Variant, Verdict, csv_line, did_you_mean, judge_printed,
};
use mechaudit::reference::{Decimal, DecimalError, nearest_f64};
use mechaudit::report::json as in_json;
use mechaudit::report::text::style::{BAD, BOLD, DIM, DOUBT, GOOD, PLAIN, paint};
use mechaudit::report::text::table::Table;
use mechaudit::report::words::numbers::short;
use mechaudit::symbolic;
use rayon::prelude::*;
use rug::Rational;
use serde_json::json;
use std::cmp::Reverse;
use std::collections::BTreeMap;
use std::io::Read;
use std::path::Path;

/// The largest table, and the longest field of one.
const WHOLE: usize = 64 << 20;
const FIELD: usize = 1000;

/// Text that holds no table of the method's values.
#[derive(Debug, thiserror::Error)]
pub enum TableError {
    #[error("{}", reason(.0))]
    Csv(#[from] csv::Error),
    #[error("more than {FIELDS} columns")]
    TooManyColumns,
    #[error("two columns are named {0}")]
    SameColumn(String),
    #[error("{method} has no column {name:?}{}; it has: {}", did_you_mean(.name, .known), .known.join(", "))]
    NoColumn {
        method: &'static str,
        name: String,
        known: Vec<String>,
    },
    #[error("{name} is in [{due}], and [{unit}] is no unit of the same")]
    Unit {
        name: String,
        due: &'static str,
        unit: String,
    },
    #[error(
        "{name} is in [{due}]: a number in [{unit}] is no rational number of them, and inputs are taken exactly; convert the column"
    )]
    Degrees {
        name: String,
        due: &'static str,
        unit: String,
    },
    #[error("no column is named as an output of {method}: {}", .outputs.join(", "))]
    NoOutput {
        method: &'static str,
        outputs: Vec<String>,
    },
    #[error("the column {column} of {method} is missing")]
    NoInput {
        method: &'static str,
        column: String,
    },
    #[error("line {line}")]
    Line { line: u64, source: RowError },
    #[error("there are no entries")]
    Empty,
}

/// A line that is no row of the table.
#[derive(Debug, thiserror::Error)]
pub enum RowError {
    #[error("{found} fields where {due} are due")]
    Fields { found: usize, due: usize },
    #[error("a field is longer than {FIELD} bytes")]
    LongField,
    #[error(transparent)]
    Decimal(#[from] DecimalError),
    #[error(transparent)]
    Number(#[from] NumberError),
    #[error("{0} is empty")]
    NoInput(String),
    #[error(transparent)]
    Layout(#[from] LayoutError),
    #[error("the lengths do not fit: {0}")]
    Lengths(String),
}

/// A line of the table as printed.
pub struct Row {
    /// The line of the file.
    pub line: u64,
    /// The inputs, exactly as printed.
    pub input: Vec<Rational>,
    /// The values.
    pub entries: Vec<Entry>,
    /// Columns of values without an entry, as NaN.
    pub blanks: Vec<Entry>,
}

/// A printed value.
pub struct Entry {
    /// Its index among the method's.
    pub value: usize,
    column: usize,
    /// As printed.
    pub text: String,
    /// The number.
    pub printed: Printed,
}

/// A column of the table, and its unit if that is not the method's.
struct Heading {
    name: String,
    column: Column,
    unit: Option<PrintedUnit>,
}

/// An entry with its verdict.
struct Judged {
    line: u64,
    column: usize,
    text: String,
    found: EntryJudgement,
}

/// Half a unit of the last digit.
const LIMIT: Limit = Limit::LastDigit(0.5);

/// Judges the table in a CSV file, whose columns are named as the method's inputs, taken exactly as
/// printed, and its outputs.
pub fn judge(method: &dyn Method, path: &Path, args: &JudgeArgs) -> Result<Outcome, Failure> {
    let output = Output::open(args.output.as_deref())?;
    let (header, rows) = open(method, path, args.line)?;
    let settings = Settings::default();
    let variant = Variant::new(method).limit(LIMIT).without_laws();
    let judged: Vec<(CaseReport, Vec<Judged>)> = rows
        .into_par_iter()
        .map(|row| judged(&variant, row, &settings))
        .collect();
    let mut tally = Tally::new(&variant, &settings);
    judged.iter().for_each(|(case, _)| tally.add(case));
    let mut report = tally.finish(&variant);
    let judged: Vec<Judged> = judged
        .into_iter()
        .flat_map(|(_, entries)| entries)
        .collect();
    report.candidate = Some(CandidateReport {
        name: format!("table {}", path.display()),
        version: None,
        command: None,
        answered: judged.len() as u64,
        trouble: None,
    });
    report.reproduce = Reproduce {
        head: format!(
            "mechaudit judge {} --table {} ",
            shell_words::quote(method.name()),
            shell_words::quote(&path.to_string_lossy())
        ),
        tail: String::new(),
    };
    let count = |a: Agreement| judged.iter().filter(|j| j.found.agreement == a).count();
    let agreeing = count(Agreement::Agrees);
    let good = report.passed();
    match args.format {
        AuditFormat::Text => output.write(|out| {
            let (word, style) = if good { ("pass", GOOD) } else { ("FAIL", BAD) };
            let (all, name) = (judged.len(), paint(BOLD, method.name()));
            let word = paint(style, word);
            let counted = match all - agreeing {
                0 => format!("{agreeing} of {all} entries agree"),
                n => format!("{n} of {all} entries do not agree"),
            };
            writeln!(
                out,
                "{name}  {word}  {counted} within half a unit of their last digit"
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
        AuditFormat::Json => {
            let entries = judged.iter().map(|j| {
                json!({
                    "line": j.line,
                    "output": header[j.column],
                    "printed": j.text,
                    "judgement": j.found,
                })
            });
            let mut value = in_json::document(&[report], false);
            value["entries"] = entries.collect();
            write_json(output, &value)?;
        }
        other => return report::write(&[report], other, output, &ReportExtras::default()),
    }
    Ok(Outcome::of(good))
}

/// A row judged: as a case of the report, and entry by entry.
fn judged(variant: &Variant, row: Row, settings: &Settings) -> (CaseReport, Vec<Judged>) {
    let entries = row.entries.iter();
    let due: Vec<(usize, &Printed)> = entries.map(|e| (e.value, &e.printed)).collect();
    let found = judge_printed(variant, &row.input, &due, settings);
    let outputs = variant.outputs();
    let component = |(entry, found): (&Entry, &EntryJudgement)| {
        let (verdict, kind) = match found.agreement {
            Agreement::Agrees => (Verdict::Pass, None),
            Agreement::LastDigit | Agreement::Differs => (Verdict::Over, None),
            Agreement::Undecided => (Verdict::Undecided, None),
            Agreement::NoValue => (Verdict::WrongKind, Some(Kind::Value)),
        };
        ComponentJudgement {
            output: outputs[entry.value % outputs.len()].name,
            verdict,
            kind,
            ulps: f64::NAN,
            conditioned: f64::NAN,
            of_budget: found.units.abs() / LIMIT.factor(),
            condition: f64::NAN,
        }
    };
    let components: Vec<ComponentJudgement> =
        (row.entries.iter().zip(&found)).map(component).collect();
    let worst = (0..components.len()).max_by_key(|&k| (components[k].verdict, Reverse(k)));
    let verdict = worst.map_or(Verdict::Pass, |k| components[k].verdict);
    let reason = worst.filter(|_| verdict != Verdict::Pass).map(|k| {
        let (printed, expected) = (&row.entries[k].text, expected(&found[k]));
        let open = match verdict {
            Verdict::Undecided => ": the reference cannot decide it",
            _ => "",
        };
        format!(
            "{} is {printed}, expected {expected}{open}",
            components[k].output
        )
    });
    let worst = worst.map(|k| &components[k]);
    let case = CaseReport {
        case: Case {
            method: variant.name(),
            region: "given",
            input: row.input.iter().map(nearest_f64).collect(),
            origin: Origin::Line { number: row.line },
        },
        answer: Some(SolverAnswer::Values(
            (row.entries.iter()).map(|e| e.printed.nearest()).collect(),
        )),
        judgement: Judgement {
            verdict,
            reason: reason.map(Into::into),
            kind: worst.and_then(|c| c.kind),
            components,
            normwise: f64::NAN,
            norm_of_budget: f64::NAN,
            wide: false,
        },
        bits: found.iter().map(|f| f.bits).max().unwrap_or(0),
        reference: found.iter().map(|f| f.reference.clone()).collect(),
        radii: Vec::new(),
        proof: None,
        branch: None,
        unwritten: None,
    };
    let line = row.line;
    let pairs = row.entries.into_iter().zip(found);
    let judged = pairs.map(move |(entry, found)| Judged {
        line,
        column: entry.column,
        text: entry.text,
        found,
    });
    (case, judged.collect())
}

/// The reference beside an entry, or why there is none.
fn expected(found: &EntryJudgement) -> String {
    let reason = || found.reason.clone().unwrap_or_else(|| "a value".into());
    found.reference.clone().unwrap_or_else(reason)
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
        let reference = expected(&j.found);
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

/// The header and the rows of the table in a file, or the row on one line alone.
pub fn open(
    method: &dyn Method,
    path: &Path,
    line: Option<u64>,
) -> Result<(Vec<String>, Vec<Row>), Failure> {
    let file: Box<dyn Read> = match path == Path::new("-") {
        true => Box::new(std::io::stdin().lock()),
        false => Box::new(std::fs::File::open(path).map_err(|e| Failure::in_file(path, e))?),
    };
    let (header, mut rows) = read(method, file).map_err(|e| Failure::in_file(path, e))?;
    rows.retain(|row| line.is_none_or(|line| row.line == line));
    match line.filter(|_| rows.is_empty()) {
        Some(line) => {
            let name = path.display();
            Err(Failure::new(format!("{name}: no row on line {line}")))
        }
        None => Ok((header, rows)),
    }
}

/// The header and the lines of a table.
pub fn read(method: &dyn Method, input: impl Read) -> Result<(Vec<String>, Vec<Row>), TableError> {
    let mut text = Vec::new();
    let read = Bounded::new(input, LONGEST, WHOLE).read_to_end(&mut text);
    read.map_err(csv::Error::from)?;
    let mut reader = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .trim(csv::Trim::All)
        .flexible(true)
        .from_reader(text.as_slice());
    let layout = Layout::new(method);
    let header = reader.headers()?;
    if header.len() > FIELDS {
        return Err(TableError::TooManyColumns);
    }
    let mut headings: Vec<Heading> = Vec::new();
    for text in header {
        let heading = heading(method, &layout, text)?;
        if headings.iter().any(|h| h.column == heading.column) {
            return Err(TableError::SameColumn(heading.name));
        }
        headings.push(heading);
    }
    let columns: Vec<Column> = headings.iter().map(|h| h.column).collect();
    complete(method, &layout, &columns)?;
    let mut rows = Vec::new();
    for record in reader.records() {
        let record = record?;
        let line = record.position().map_or(0, |at| csv_line(&text, at));
        let row = row(&layout, &headings, &record, line);
        rows.push(row.map_err(|source| TableError::Line { line, source })?);
    }
    if rows.iter().all(|r| r.entries.is_empty()) {
        return Err(TableError::Empty);
    }
    Ok((headings.into_iter().map(|h| h.name).collect(), rows))
}

/// Returns the reader's message without its preface.
fn reason(e: &csv::Error) -> String {
    match e.kind() {
        csv::ErrorKind::Io(e) => e.to_string(),
        csv::ErrorKind::Utf8 { pos, .. } => {
            let line = pos.as_ref().map_or(0, csv::Position::line);
            format!("line {line} is not UTF-8")
        }
        _ => e.to_string(),
    }
}

/// Returns true if a part of the input is an imaginary part, which is zero in a table that has no
/// column for it.
fn is_imaginary(layout: &Layout, part: usize) -> bool {
    layout.is_single(part) && layout.input_column(part, 0).starts_with("Im ")
}

/// A column by its name, which a unit in brackets may follow. Where there are real and imaginary
/// parts, a name without either means the real part, and so does `x`.
fn heading(method: &dyn Method, layout: &Layout, text: &str) -> Result<Heading, TableError> {
    let (name, unit) = match text.strip_suffix(']').and_then(|t| t.split_once(" [")) {
        Some((name, unit)) => (name.trim_end(), Some(unit)),
        None => (text, None),
    };
    let real = || match name {
        "x" => layout.column("Re z"),
        name => layout.column(&format!("Re {name}")),
    };
    let Some(column) = layout.column(name).or_else(real) else {
        return Err(TableError::NoColumn {
            method: method.name(),
            name: name.into(),
            known: layout.columns(),
        });
    };
    let due = layout.unit(column);
    let unit = match unit.filter(|unit| *unit != due) {
        None => None,
        Some(unit) => {
            let factor = factor(due, unit).ok_or_else(|| TableError::Unit {
                name: name.into(),
                due,
                unit: unit.into(),
            })?;
            if factor.degrees != 0 && matches!(column, Column::Input { .. }) {
                return Err(TableError::Degrees {
                    name: name.into(),
                    due,
                    unit: unit.into(),
                });
            }
            Some(factor)
        }
    };
    Ok(Heading {
        name: name.into(),
        column,
        unit,
    })
}

/// The factor from a unit to another of the same dimension.
fn factor(from: &str, to: &str) -> Option<PrintedUnit> {
    let [from, to] = [from, to].map(|text| symbolic::unit(text).ok());
    let (from, to) = (from?, to?);
    let is_same = from.dimension == to.dimension;
    let degrees = from.dimension[3] * (i32::from(to.degrees) - i32::from(from.degrees));
    is_same.then(|| PrintedUnit {
        by: from.scale / to.scale,
        degrees,
    })
}

/// Returns true if every input has its column, and there is something to judge.
fn complete(method: &dyn Method, layout: &Layout, columns: &[Column]) -> Result<(), TableError> {
    let method = method.name();
    if !columns.iter().any(|c| matches!(c, Column::Value(_))) {
        let outputs = layout.columns().split_off(layout.parts());
        return Err(TableError::NoOutput { method, outputs });
    }
    for part in 0..layout.parts() {
        let there = |index| columns.contains(&Column::Input { part, index });
        let last = columns.iter().filter_map(|c| match c {
            Column::Input { part: p, index } if *p == part => Some(*index),
            _ => None,
        });
        // A vector may be empty.
        let due = match (layout.is_single(part), last.max()) {
            (true, _) => 1,
            (false, last) => last.map_or(0, |k| k + 1),
        };
        if is_imaginary(layout, part) {
            continue;
        }
        if let Some(k) = (0..due).find(|k| !there(*k)) {
            let column = layout.input_column(part, k);
            return Err(TableError::NoInput { method, column });
        }
    }
    Ok(())
}

/// An input as it is written: a decimal, a hexadecimal float or a quotient.
fn exact(text: &str) -> Result<Rational, RowError> {
    match text.contains(['x', 'X', '/']) {
        true => Ok(Number::parse(text)?.exact()?),
        false => Ok(Decimal::parse(text)?.value),
    }
}

/// The input and the entries of a line.
fn row(
    layout: &Layout,
    headings: &[Heading],
    record: &csv::StringRecord,
    line: u64,
) -> Result<Row, RowError> {
    if record.len() != headings.len() {
        return Err(RowError::Fields {
            found: record.len(),
            due: headings.len(),
        });
    }
    let mut parts: Vec<BTreeMap<usize, Rational>> = vec![BTreeMap::new(); layout.parts()];
    let (mut entries, mut blanks) = (Vec::new(), Vec::new());
    for (k, (text, heading)) in record.iter().zip(headings).enumerate() {
        if text.len() > FIELD {
            return Err(RowError::LongField);
        }
        let entry = |value, number: &str| {
            Ok::<Entry, DecimalError>(Entry {
                value,
                column: k,
                text: text.into(),
                printed: Printed::parse(number)?.in_unit(heading.unit.clone()),
            })
        };
        match heading.column {
            // Nothing was printed here, or a vector is shorter than in other lines.
            Column::Value(value) if text.is_empty() => blanks.push(entry(value, "nan")?),
            Column::Input { .. } if text.is_empty() => {}
            Column::Input { part, index } => {
                let number = exact(text)?;
                let scaled = heading.unit.iter().fold(number, |x, unit| x / &unit.by);
                parts[part].insert(index, scaled);
            }
            Column::Value(value) => entries.push(entry(value, text)?),
        }
    }
    let has = |column: Column| headings.iter().any(|h| h.column == column);
    for (part, found) in parts.iter_mut().enumerate() {
        if is_imaginary(layout, part) && !has(Column::Input { part, index: 0 }) {
            found.insert(0, Rational::new());
        }
    }
    for (part, found) in parts.iter().enumerate() {
        let due = match layout.is_single(part) {
            true => 1,
            false => found.last_key_value().map_or(0, |(k, _)| k + 1),
        };
        if let Some(k) = (0..due).find(|k| !found.contains_key(k)) {
            return Err(RowError::NoInput(layout.input_column(part, k)));
        }
    }
    let found: Vec<usize> = parts.iter().map(BTreeMap::len).collect();
    let input: Vec<Rational> = parts.into_iter().flat_map(BTreeMap::into_values).collect();
    let nearest: Vec<f64> = input.iter().map(Rational::to_f64).collect();
    let due = layout.lengths(&nearest)?;
    match due == found {
        true => Ok(Row {
            line,
            input,
            entries,
            blanks,
        }),
        false => Err(RowError::Lengths(layout.input())),
    }
}

#[cfg(test)]
mod tests;
