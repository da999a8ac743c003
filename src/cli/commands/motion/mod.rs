//! The certified motion of an initial value problem given in a file: a row for each time.

pub mod machine;
mod study;

use crate::cli::args::{MotionArgs, MotionFormat};
use crate::cli::complain;
use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::output::Output;
use crate::cli::progress::waiting;
use mechaudit::motion::{Course, Drive, Motion};
use mechaudit::reference::{nearest_f64, with_point};
use mechaudit::report::cell::Cell;
use mechaudit::report::html::trajectory;
use mechaudit::report::rows::{Form, Rows};
use mechaudit::report::text::style::{DOUBT, PLAIN};
use mechaudit::report::text::table::Table as Aligned;
use mechaudit::report::words::numbers::unit;
use rug::{Integer, Rational};
use serde_json::{Map, Value};

/// A quantity of the motion.
pub struct Column {
    /// Its name.
    pub name: &'static str,
    /// Its unit, `1` if none.
    pub unit: &'static str,
    /// Its definition.
    pub text: String,
}

/// A value of a row, and the reason where it has no digits.
pub type Entry = (Cell, Option<String>);

/// The value for a curve.
fn nearest(cell: &Cell) -> f64 {
    match cell {
        Cell::Float(x) => *x,
        Cell::Decimal(digits) => digits.parse().unwrap_or(f64::NAN),
        _ => f64::NAN,
    }
}

/// A motion at some times.
pub struct Table {
    /// One line in plain words.
    pub title: String,
    /// Where it comes from.
    pub source: String,
    /// The time, and the quantities.
    pub columns: Vec<Column>,
    /// The inputs that are the same in all rows.
    pub inputs: Vec<(&'static str, Rational)>,
    /// Significant digits of every value, which are certified; without them values are
    /// floating-point numbers.
    pub digits: Option<u32>,
    /// The times of the rows.
    times: Vec<f64>,
    /// The times with the values there.
    rows: Vec<Vec<Cell>>,
    /// Reasons why values have no digits, each with a line that says it with the first time.
    open: Vec<(String, String)>,
}

/// Computes the motion and writes it.
pub fn motion(args: &MotionArgs) -> Result<Outcome, Failure> {
    let times = &args.times.0;
    let (table, output) = match machine::source(args) {
        Some(source) => {
            let problem = machine::Problem::open(args, &source)?;
            let output = Output::open(args.output.as_deref())?;
            (waiting("motion", || problem.table(times))?, output)
        }
        None => {
            let problem = study::Problem::open(args)?;
            let output = Output::open(args.output.as_deref())?;
            (waiting("motion", || problem.table(times)), output)
        }
    };
    if args.format == MotionFormat::Text {
        output.text(table.text())?;
        return Ok(table.outcome());
    }
    table.write(
        output,
        match args.format {
            MotionFormat::Csv => Some(Form::Csv),
            MotionFormat::Json => Some(Form::Json),
            MotionFormat::Text | MotionFormat::Html => None,
        },
    )
}

impl Table {
    /// Without rows.
    pub fn new(title: String, source: String, columns: Vec<Column>, digits: Option<u32>) -> Table {
        Table {
            title,
            source,
            columns,
            inputs: Vec::new(),
            digits,
            times: Vec::new(),
            rows: Vec::new(),
            open: Vec::new(),
        }
    }

    /// Adds a row.
    pub fn push(&mut self, time: &Rational, values: impl IntoIterator<Item = Entry>) {
        let mut row = Vec::with_capacity(self.columns.len());
        row.push(Cell::Word(shown(time)));
        for (k, (cell, why)) in values.into_iter().enumerate() {
            self.note(k + 1, &row[0], &cell, why);
            row.push(cell);
        }
        self.times.push(nearest_f64(time));
        self.rows.push(row);
    }

    /// Notes the reason for a value without digits.
    fn note(&mut self, column: usize, time: &Cell, cell: &Cell, why: Option<String>) {
        let word = match cell {
            Cell::Undecided => "undecided",
            Cell::Decimal(word) if word == "nan" => "nan",
            _ => return,
        };
        let why = why.unwrap_or_else(|| "the digits could not be certified".into());
        // Reasons name the time that was reached, which does not change from row to row.
        if self.open.len() < MOST_REASONS && self.open.iter().all(|said| said.0 != why) {
            let [of, time_name] = [column, 0].map(|k| self.columns[k].name);
            let from = format!("from {time_name} = {}", time.text());
            let line = format!("{of} is {word} {from} on: {why}");
            self.open.push((why, line));
        }
    }

    /// Writes the rows in a form for programs, or the page.
    pub fn write(&self, output: Output, form: Option<Form>) -> Result<Outcome, Failure> {
        output.write(|out| match form {
            Some(form) => Ok(self.rows(out, form)?),
            None => Ok(out.write_all(self.page().as_bytes())?),
        })?;
        Ok(self.outcome())
    }

    /// Says what is not certified.
    fn outcome(&self) -> Outcome {
        self.reasons().for_each(|line| complain(line));
        Outcome::of(self.open.is_empty())
    }

    fn reasons(&self) -> impl Iterator<Item = &String> {
        self.open.iter().map(|(_, line)| line)
    }

    /// The names of the columns with their units.
    fn heads(&self) -> Vec<String> {
        let head = |c: &Column| match c.unit {
            "1" => c.name.to_string(),
            unit => format!("{} [{unit}]", c.name),
        };
        self.columns.iter().map(head).collect()
    }

    /// The rows in a form for programs.
    fn rows(&self, out: &mut dyn std::io::Write, form: Form) -> std::io::Result<()> {
        let mut about = Map::new();
        let mut put = |key: &str, value: Value| about.insert(key.into(), value);
        put("schema_version", 1.into());
        put("mechaudit_version", env!("CARGO_PKG_VERSION").into());
        put("title", self.title.as_str().into());
        put("source", self.source.as_str().into());
        put("digits", self.digits.into());
        let inputs = self
            .inputs
            .iter()
            .map(|(name, x)| (name.to_string(), Value::from(shown(x))));
        put("inputs", Value::Object(inputs.collect()));
        let names = self
            .columns
            .iter()
            .map(|c| c.name.to_string())
            .collect::<Vec<_>>();
        let units = self
            .columns
            .iter()
            .map(|c| (c.name.to_string(), Value::from(c.unit)));
        put("units", Value::Object(units.collect()));
        put("undecided", self.reasons().cloned().collect());
        let mut rows = Rows::begin(out, form, names, &about)?;
        for row in &self.rows {
            rows.row(row)?;
        }
        rows.end()
    }

    /// The rows aligned.
    fn text(&self) -> String {
        let heads = self.heads();
        let heads: Vec<&str> = heads.iter().map(String::as_str).collect();
        let mut table = Aligned::new(&heads, &[]);
        for row in &self.rows {
            let cells = row.iter().map(|cell| {
                let style = match cell {
                    Cell::Undecided => DOUBT,
                    Cell::Decimal(word) if word == "nan" => DOUBT,
                    _ => PLAIN,
                };
                (cell.text(), style)
            });
            table.row(cells.collect());
        }
        table.render(0)
    }

    /// The page.
    fn page(&self) -> String {
        let course = |(k, c): (usize, &Column)| Course {
            name: c.name.into(),
            unit: unit(c.unit),
            variants: vec![(
                String::new(),
                self.rows.iter().map(|r| nearest(&r[k + 1])).collect(),
            )],
            printed: Vec::new(),
        };
        let (time, quantities) = (&self.columns[0], &self.columns[1..]);
        let motion = Motion {
            name: self.title.clone(),
            drive: Drive {
                symbol: time.name,
                unit: if time.unit == "1" { "" } else { time.unit },
                values: self.times.clone(),
            },
            closed: false,
            start: 0,
            points: Vec::new(),
            links: Vec::new(),
            plates: Vec::new(),
            guides: Vec::new(),
            wheels: Vec::new(),
            courses: quantities.iter().enumerate().map(course).collect(),
        };
        let inputs = self
            .inputs
            .iter()
            .map(|(name, x)| format!("{name} = {}", shown(x)));
        let mut facts: Vec<String> = vec![format!("source: {}", self.source)];
        facts.extend(quantities.iter().map(|c| c.text.clone()));
        facts.extend(inputs);
        facts.extend(self.reasons().cloned());
        trajectory::page(&motion, self.digits, &facts, (&self.heads(), &self.rows))
    }
}

/// The most reasons that are listed.
const MOST_REASONS: usize = 8;

/// A rational number as a decimal where that ends soon, else as a quotient.
pub fn shown(q: &Rational) -> String {
    const DECIMALS: u32 = 60;
    if let Some(text) = shown_small(q) {
        return text;
    }
    // The denominator of a decimal has no other prime factors than 2 and 5.
    let mut rest = q.denom().clone();
    let powers = [2, 5].map(|prime| rest.remove_factor_mut(&Integer::from(prime)));
    let decimals = powers[0].max(powers[1]);
    if rest != 1 || decimals > DECIMALS {
        return q.to_string();
    }
    let scaled = Integer::from(Integer::u_pow_u(10, decimals)) * q.numer() / q.denom();
    with_point(*q < 0, &scaled.abs().to_string(), decimals as usize)
}

/// [`shown`] by machine words, where these hold the number.
fn shown_small(q: &Rational) -> Option<String> {
    let (n, d) = (q.numer().to_i64()?, q.denom().to_u64()?);
    let decimals = (0..=19).find(|k| 10u64.pow(*k).is_multiple_of(d))?;
    let digits = n.unsigned_abs().checked_mul(10u64.pow(decimals) / d)?;
    Some(with_point(n < 0, &digits.to_string(), decimals as usize))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_decimals_where_these_end() {
        for (q, due) in [
            ((0, 1), "0"),
            ((-5, 2), "-2.5"),
            ((1, 1000), "0.001"),
            ((12345, 100), "123.45"),
            ((1, 3), "1/3"),
            ((-1, 64), "-0.015625"),
            ((700, 7), "100"),
            ((1, 1 << 30), "0.000000000931322574615478515625"),
        ] {
            assert_eq!(shown(&Rational::from(q)), due);
        }
    }
}
