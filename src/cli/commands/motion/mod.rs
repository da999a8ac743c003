//! The certified motion of an initial value problem given in a file: a row for each time.

pub mod machine;
mod study;

use crate::cli::args::{MotionArgs, MotionFormat};
use crate::cli::complain;
use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::output::Output;
use crate::cli::progress::waiting;
use mechaudit::methods::CertifiedValue;
use mechaudit::motion::{Course, Drive, Motion};
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

/// A value of a row.
pub enum Entry {
    /// A number in floating point.
    Float(f64),
    /// A certified decimal, and the reason where there is none or where it is no number.
    Certified {
        decimal: Option<String>,
        why: Option<String>,
    },
}

impl From<CertifiedValue> for Entry {
    fn from(value: CertifiedValue) -> Entry {
        Entry::Certified {
            decimal: value.decimal,
            why: value.why,
        }
    }
}

impl Entry {
    fn cell(&self) -> Cell {
        match self {
            Entry::Float(x) => Cell::Float(*x),
            Entry::Certified { decimal, .. } => Cell::certified(decimal.clone()),
        }
    }

    /// The word in the place of digits with the reason for it.
    fn open(&self) -> Option<(&'static str, Option<&String>)> {
        let Entry::Certified { decimal, why } = self else {
            return None;
        };
        let word = match decimal.as_deref() {
            None => "undecided",
            Some("nan") => "nan",
            Some(_) => return None,
        };
        Some((word, why.as_ref()))
    }

    /// The value for a curve.
    fn nearest(&self) -> f64 {
        match self {
            Entry::Float(x) => *x,
            Entry::Certified { decimal, .. } => {
                let number = decimal.as_ref().and_then(|d| d.parse().ok());
                number.unwrap_or(f64::NAN)
            }
        }
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
    /// Times with the values there.
    pub rows: Vec<TableRow>,
}

/// A time with the values there.
pub type TableRow = (Rational, Vec<Entry>);

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
        let open = self.open();
        open.iter().for_each(|line| complain(line));
        Outcome::of(open.is_empty())
    }

    fn cells((time, values): &TableRow) -> Vec<Cell> {
        let values = values.iter().map(Entry::cell);
        std::iter::once(Cell::Word(shown(time)))
            .chain(values)
            .collect()
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
        put("undecided", self.open().into());
        let mut rows = Rows::begin(out, form, names, &about)?;
        for row in &self.rows {
            rows.row(&Table::cells(row))?;
        }
        rows.end()
    }

    /// The rows aligned.
    fn text(&self) -> String {
        let heads = self.heads();
        let heads: Vec<&str> = heads.iter().map(String::as_str).collect();
        let mut table = Aligned::new(&heads, &[]);
        for row in &self.rows {
            let cells = Table::cells(row).into_iter().map(|cell| {
                let style = match &cell {
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

    /// Reasons why values have no digits, each with the first time at which it holds.
    fn open(&self) -> Vec<String> {
        let mut lines: Vec<String> = Vec::new();
        let mut said: Vec<String> = Vec::new();
        for (time, values) in &self.rows {
            for (value, column) in values.iter().zip(&self.columns[1..]) {
                let Some((word, why)) = value.open() else {
                    continue;
                };
                let why = why
                    .cloned()
                    .unwrap_or_else(|| "the digits could not be certified".into());
                // Reasons name the time that was reached, which does not change from row to row.
                if !said.contains(&why) && lines.len() < MOST_REASONS {
                    let from = format!("from {} = {}", self.columns[0].name, shown(time));
                    lines.push(format!("{} is {word} {from} on: {why}", column.name));
                    said.push(why);
                }
            }
        }
        lines
    }

    /// The page.
    fn page(&self) -> String {
        let course = |(k, c): (usize, &Column)| Course {
            name: c.name.into(),
            unit: unit(c.unit),
            variants: vec![(
                String::new(),
                self.rows.iter().map(|r| r.1[k].nearest()).collect(),
            )],
            printed: Vec::new(),
        };
        let (time, quantities) = (&self.columns[0], &self.columns[1..]);
        let motion = Motion {
            name: self.title.clone(),
            drive: Drive {
                symbol: time.name,
                unit: if time.unit == "1" { "" } else { time.unit },
                values: self.rows.iter().map(|r| r.0.to_f64()).collect(),
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
        facts.extend(self.open());
        let rows: Vec<Vec<Cell>> = self.rows.iter().map(Table::cells).collect();
        trajectory::page(&motion, self.digits, &facts, (&self.heads(), &rows))
    }
}

/// The most reasons that are listed.
const MOST_REASONS: usize = 8;

/// A rational number as a decimal where that ends soon, else as a quotient.
pub fn shown(q: &Rational) -> String {
    const DECIMALS: u32 = 60;
    // The denominator of a decimal has no other prime factors than 2 and 5.
    let mut rest = q.denom().clone();
    let powers = [2, 5].map(|prime| rest.remove_factor_mut(&Integer::from(prime)));
    let decimals = powers[0].max(powers[1]);
    if rest != 1 || decimals > DECIMALS {
        return q.to_string();
    }
    let scaled = Integer::from(Integer::u_pow_u(10, decimals)) * q.numer() / q.denom();
    let digits = scaled.abs().to_string();
    let sign = if *q < 0 { "-" } else { "" };
    let decimals = decimals as usize;
    if decimals == 0 {
        return format!("{sign}{digits}");
    }
    let digits = format!("{digits:0>width$}", width = decimals + 1);
    let (whole, rest) = digits.split_at(digits.len() - decimals);
    format!("{sign}{whole}.{rest}")
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
        ] {
            assert_eq!(shown(&Rational::from(q)), due);
        }
    }
}
