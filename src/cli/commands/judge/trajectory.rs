//! Judging the file of a simulation against the certified motion, row by row.

use super::published::{self, Row};
use crate::cli::args::{AuditFormat, JudgeArgs};
use crate::cli::commands::motion::shown;
use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::output::{Output, write_json};
use crate::cli::progress::waiting;
use mechaudit::audit::{
    Method, Output as Quantity, ReferenceAnswer, Rules, SolverAnswer, Verdict, judge_by,
};
use mechaudit::report::html::trajectory::{ErrorCurve, errors};
use mechaudit::report::text::style::{BAD, BOLD, DOUBT, GOOD, PLAIN, paint};
use mechaudit::report::text::table::Table;
use mechaudit::report::words::numbers::{count, short, short_if};
use mechaudit::study::Study;
use rug::Rational;
use serde::Serialize;
use serde_json::json;
use std::path::Path;

/// Bits of the reference beyond those of the entries.
const BITS: u32 = 160;
/// Digits of the reference in reports.
const DIGITS: usize = 20;

/// An entry of the table.
#[derive(Serialize)]
struct Entry {
    line: u64,
    /// The inputs and the time.
    #[serde(skip)]
    input: Vec<Rational>,
    /// The time.
    time: f64,
    output: &'static str,
    printed: String,
    reference: Option<String>,
    /// An upper bound on |printed − reference|.
    error: Option<f64>,
    /// A lower bound on |reference|.
    #[serde(skip)]
    size: f64,
    of_budget: f64,
    verdict: Verdict,
}

impl Entry {
    fn passes(&self) -> bool {
        self.verdict == Verdict::Pass
    }
}

/// Judges a table whose columns are named as the time, the inputs and outputs of a motion.
pub fn judge(study: &Study, path: &Path, args: &JudgeArgs) -> Result<Outcome, Failure> {
    if args.format == AuditFormat::Junit {
        let text = "a motion is judged as text, csv, json or html";
        return Err(Failure::new(format!("--format junit: {text}")));
    }
    let output = Output::open(args.output.as_deref())?;
    let (_, mut rows) = published::open(study, path, args.line)?;
    // A simulation has a number in every field: many programs write NaN as an empty one.
    for row in &mut rows {
        row.entries.append(&mut row.blanks);
    }
    let outputs = study.outputs();
    let entries: Vec<Entry> = waiting("motion", || {
        let rows = rows.iter();
        rows.flat_map(|row| judged(study, &outputs, row)).collect()
    });
    let report = Report {
        study,
        file: path.display().to_string(),
        time: study.inputs().last().map_or("t", |i| i.name),
        rows: rows.len(),
        columns: columns(&outputs, &entries),
        entries,
    };
    match args.format {
        AuditFormat::Csv => output.write(|out| Ok(out.write_all(report.csv().as_bytes())?))?,
        AuditFormat::Json => write_json(output, &report.json())?,
        AuditFormat::Html => output.text(report.page())?,
        _ => output.text(report.text())?,
    }
    Ok(Outcome::of(report.passes()))
}

/// The entries of a row with their verdicts.
fn judged(study: &Study, outputs: &[Quantity], row: &Row) -> Vec<Entry> {
    let time = row.input.last().map_or(f64::NAN, Rational::to_f64);
    let reference = study.reference(&row.input, BITS);
    let values = match &reference {
        ReferenceAnswer::Expected(values, _) => Some(values),
        _ => None,
    };
    // The outputs that the table has, and no others.
    let own: Vec<Quantity> = row.entries.iter().map(|e| outputs[e.value]).collect();
    let needed = own.iter().any(|o| o.budget.limit.needs_conditions());
    let nearest: Vec<f64> = row
        .input
        .iter()
        .map(mechaudit::reference::nearest_f64)
        .collect();
    let conditions = (needed && values.is_some())
        .then(|| study.conditions(&nearest))
        .flatten();
    let conditions: Option<Vec<f64>> =
        conditions.map(|all| row.entries.iter().map(|e| all[e.value]).collect());
    let bits = BITS + 64;
    let printed = row.entries.iter().map(|e| e.printed.value(bits));
    let printed: Vec<_> = printed.collect();
    let got = printed
        .iter()
        .map(|p| p.as_ref().map_or(f64::NAN, |ball| ball.to_f64()));
    let answer = SolverAnswer::Values(got.collect());
    let due = match (values, &reference) {
        (Some(values), ReferenceAnswer::Expected(_, proof)) => {
            let values = row.entries.iter().map(|e| values[e.value].clone());
            ReferenceAnswer::Expected(values.collect(), *proof)
        }
        _ => reference.clone(),
    };
    let rules = Rules {
        outputs: &own,
        norm: None,
        format: study.format(),
    };
    let judgement = judge_by(&rules, &answer, &due, conditions.as_deref());
    let entry = |(k, (entry, printed)): (usize, (&published::Entry, &Option<_>))| {
        let number = values.and_then(|v| v[entry.value].number());
        let component = judgement.components.get(k);
        Entry {
            line: row.line,
            input: row.input.clone(),
            time,
            output: own[k].name,
            printed: entry.text.clone(),
            reference: match values {
                Some(v) => v[entry.value].to_decimal(DIGITS),
                None => None,
            },
            error: number
                .zip(printed.as_ref())
                .map(|(r, p): (_, &mechaudit::reference::Ball)| (p - r).magnitude().to_f64()),
            size: number.map_or(0.0, |r| r.mignitude().to_f64()),
            of_budget: component.map_or(f64::NAN, |c| c.of_budget),
            verdict: component.map_or(judgement.verdict, |c| c.verdict),
        }
    };
    row.entries
        .iter()
        .zip(&printed)
        .enumerate()
        .map(entry)
        .collect()
}

/// The errors of a column.
#[derive(Serialize)]
struct Column {
    output: &'static str,
    /// The largest error and the time of it.
    error: f64,
    time: f64,
    /// The error in the last row.
    last: f64,
    /// The largest value of the reference.
    size: f64,
    /// Decimal digits that are right in every row, and in the last one, of the largest value.
    digits: [f64; 2],
    /// The largest share of the budget.
    of_budget: f64,
    /// The time of the first row that does not pass.
    fails_from: Option<f64>,
    /// The number of rows that do not pass.
    failures: usize,
    /// Rows without a certified reference or without a number.
    open: usize,
}

/// The columns of the table in the order of the outputs.
fn columns(outputs: &[Quantity], entries: &[Entry]) -> Vec<Column> {
    let column = |output: &Quantity| {
        let own: Vec<&Entry> = entries.iter().filter(|e| e.output == output.name).collect();
        let last = own.last()?.error.unwrap_or(f64::NAN);
        let worst = own.iter().filter_map(|e| Some((e.error?, e.time)));
        let (error, time) = worst.fold((f64::NAN, f64::NAN), |a, b| if a.0 >= b.0 { a } else { b });
        let size = own.iter().map(|e| e.size).fold(0.0, f64::max);
        let digits = |error: f64| match error {
            0.0 => f64::INFINITY,
            error => (size / error).log10().max(0.0),
        };
        Some(Column {
            output: output.name,
            error,
            time,
            last,
            size,
            digits: [digits(error), digits(last)],
            of_budget: own.iter().map(|e| e.of_budget).fold(f64::NAN, f64::max),
            fails_from: own.iter().find(|e| !e.passes()).map(|e| e.time),
            failures: own.iter().filter(|e| !e.passes()).count(),
            open: own.iter().filter(|e| e.error.is_none()).count(),
        })
    };
    outputs.iter().filter_map(column).collect()
}

/// A table that was judged.
struct Report<'a> {
    study: &'a Study,
    file: String,
    time: &'static str,
    rows: usize,
    columns: Vec<Column>,
    entries: Vec<Entry>,
}

impl Report<'_> {
    fn passes(&self) -> bool {
        self.entries.iter().all(Entry::passes)
    }

    /// One line about all.
    fn head(&self) -> String {
        let failures = self.entries.iter().filter(|e| !e.passes()).count();
        let all = self.entries.len();
        let ends = (self.entries.first(), self.entries.last());
        let times = match ends {
            (Some(a), Some(b)) => format!(", {} from {} to {}", self.time, a.time, b.time),
            _ => String::new(),
        };
        let counted = match failures {
            0 => format!("{all} of {all} entries within budget"),
            n => format!("{n} of {all} entries not within budget"),
        };
        format!("{counted}; {}{times}", count(self.rows, "row"))
    }

    fn text(&self) -> String {
        let (word, style) = if self.passes() {
            ("pass", GOOD)
        } else {
            ("FAIL", BAD)
        };
        let name = paint(BOLD, &self.file);
        let text = format!("{name}  {}  {}\n", paint(style, word), self.head());
        let at = format!("at {}", self.time);
        let heads = [
            "column",
            "largest error",
            &at,
            "digits right",
            "at the end",
            "of budget",
            "fails from",
            "not compared",
        ];
        let mut table = Table::new(&heads, &[0]);
        for c in &self.columns {
            let style = if c.failures == 0 { PLAIN } else { BAD };
            let digits = |d: f64| match d {
                d if d.is_nan() => "–".to_string(),
                d if d.is_infinite() => "all".into(),
                d => format!("{d:.1}"),
            };
            table.row(vec![
                (c.output.into(), PLAIN),
                (short_if(!c.error.is_nan(), c.error), style),
                (short_if(!c.time.is_nan(), c.time), PLAIN),
                (digits(c.digits[0]), PLAIN),
                (digits(c.digits[1]), PLAIN),
                (short_if(!c.of_budget.is_nan(), c.of_budget), style),
                (c.fails_from.map_or("–".into(), short), style),
                (c.open.to_string(), if c.open > 0 { DOUBT } else { PLAIN }),
            ]);
        }
        text + &table.render(2)
    }

    fn csv(&self) -> String {
        let inputs: Vec<&str> = self.study.inputs().iter().map(|i| i.name).collect();
        let heads = "output,printed,reference,error,of_budget,verdict";
        let mut text = format!("line,{},{heads}\n", inputs.join(","));
        for e in &self.entries {
            let input: Vec<String> = e.input.iter().map(shown).collect();
            let number = |x: Option<f64>| {
                x.filter(|x| x.is_finite())
                    .map_or(String::new(), |x| format!("{x:e}"))
            };
            let fields = [
                e.line.to_string(),
                input.join(","),
                e.output.into(),
                e.printed.clone(),
                e.reference.clone().unwrap_or_else(|| "undecided".into()),
                number(e.error),
                number(Some(e.of_budget)),
                word(e.verdict).into(),
            ];
            text.push_str(&fields.join(","));
            text.push('\n');
        }
        text
    }

    fn json(&self) -> serde_json::Value {
        json!({
            "schema_version": 1,
            "mechaudit_version": env!("CARGO_PKG_VERSION"),
            "study": self.study.name(),
            "table": self.file,
            "passed": self.passes(),
            "rows": self.rows,
            "columns": self.columns,
            "entries": self.entries,
        })
    }

    fn page(&self) -> String {
        let curve = |c: &Column| {
            let own = self.entries.iter().filter(|e| e.output == c.output);
            ErrorCurve {
                name: c.output,
                points: own.map(|e| (e.time, e.error.unwrap_or(f64::NAN))).collect(),
            }
        };
        let curves: Vec<ErrorCurve> = self.columns.iter().map(curve).collect();
        let heads = [
            "column",
            "largest error",
            "at",
            "digits right",
            "at the end",
            "of budget",
            "fails from",
        ];
        let row = |c: &Column| {
            let digits = |d: f64| {
                if d.is_finite() {
                    format!("{d:.1}")
                } else {
                    "–".into()
                }
            };
            vec![
                c.output.to_string(),
                short(c.error),
                short(c.time),
                digits(c.digits[0]),
                digits(c.digits[1]),
                short(c.of_budget),
                c.fails_from.map_or("–".into(), short),
            ]
        };
        let rows: Vec<Vec<String>> = self.columns.iter().map(row).collect();
        let outputs = self.study.outputs();
        let budget = |o: &Quantity| format!("{}: {}, {}", o.name, o.budget.limit, o.budget.reason);
        let facts: Vec<String> = outputs.iter().map(budget).collect();
        let title = &self.study.problem().title;
        let verdict = (self.passes(), self.head());
        errors(
            (title, &self.file, self.time),
            verdict,
            &curves,
            (&heads, &rows),
            &facts,
        )
    }
}

/// The word of a verdict.
fn word(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Pass => "pass",
        Verdict::Over => "over",
        Verdict::Undecided => "undecided",
        Verdict::WrongKind => "wrong_kind",
        Verdict::OracleError => "oracle_error",
    }
}
