//! Rows of a linkage as CSV or JSON, written one by one.

use crate::cli::args::CsvOrJson;
use crate::cli::columns::Columns;
use crate::cli::failure::Failure;
use serde_json::{Map, Value};
use std::io::Write;

/// One value of a row.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    Count(usize),
    Float(f64),
    /// A certified decimal.
    Decimal(String),
    /// A word.
    Name(&'static str),
    /// A word of the input.
    Word(String),
    /// No digits could be certified.
    Undecided,
}

impl Cell {
    /// A certified decimal, if there is one.
    pub fn certified(digits: Option<String>) -> Cell {
        digits.map_or(Cell::Undecided, Cell::Decimal)
    }

    pub fn text(&self) -> String {
        match self {
            Cell::Count(n) => n.to_string(),
            Cell::Float(x) => shortest(*x),
            Cell::Decimal(d) | Cell::Word(d) => d.clone(),
            Cell::Name(n) => (*n).into(),
            Cell::Undecided => "undecided".into(),
        }
    }

    fn json(&self) -> Value {
        match self {
            Cell::Count(n) => (*n).into(),
            Cell::Float(x) => (*x).into(),
            Cell::Decimal(d) | Cell::Word(d) => d.as_str().into(),
            Cell::Name(n) => (*n).into(),
            Cell::Undecided => Value::Null,
        }
    }
}

/// The shortest decimal that reads back as the same number.
fn shortest(x: f64) -> String {
    let size = x.abs();
    if size != 0.0 && !(1e-5..1e16).contains(&size) {
        format!("{x:e}")
    } else {
        format!("{x}")
    }
}

/// A row of cells under the columns' names.
pub struct Rows<'a> {
    out: &'a mut dyn Write,
    format: CsvOrJson,
    columns: Columns,
    any: bool,
}

impl<'a> Rows<'a> {
    /// Writes the head: for CSV the columns' names, for JSON everything in `about` first.
    pub fn begin(
        out: &'a mut dyn Write,
        format: CsvOrJson,
        columns: impl Into<Columns>,
        about: &Map<String, Value>,
    ) -> Result<Rows<'a>, Failure> {
        let columns = columns.into();
        match format {
            CsvOrJson::Csv => writeln!(out, "{}", columns.names.join(","))?,
            CsvOrJson::Json => {
                writeln!(out, "{{")?;
                for (key, value) in about {
                    let value = serde_json::to_string(value)?;
                    writeln!(out, "  {}: {value},", serde_json::to_string(key)?)?;
                }
                let names = serde_json::to_string(&columns.names)?;
                write!(out, "  \"columns\": {names},\n  \"rows\": [")?;
            }
        }
        Ok(Rows {
            out,
            format,
            columns,
            any: false,
        })
    }

    /// Writes one row.
    pub fn row(&mut self, cells: &[Cell]) -> Result<(), Failure> {
        let cells = cells.iter().enumerate();
        let cells: Vec<Cell> = cells.map(|(k, c)| self.columns.cell(k, c)).collect();
        match self.format {
            CsvOrJson::Csv => {
                let texts: Vec<String> = cells.iter().map(Cell::text).collect();
                writeln!(self.out, "{}", texts.join(","))?;
            }
            CsvOrJson::Json => {
                let mut object = Map::new();
                for (name, cell) in self.columns.names.iter().zip(&cells) {
                    object.insert(name.clone(), cell.json());
                }
                let comma = if self.any { "," } else { "" };
                let object = serde_json::to_string(&object)?;
                write!(self.out, "{comma}\n    {object}")?;
            }
        }
        self.any = true;
        Ok(())
    }

    /// Writes the end.
    pub fn end(self) -> Result<(), Failure> {
        if self.format == CsvOrJson::Json {
            writeln!(self.out, "\n  ]\n}}")?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn floats_are_short_and_read_back() {
        for x in [
            0.1,
            -0.0,
            1e-300,
            123456789.125,
            5e-324,
            f64::MAX,
            1e16,
            0.00001,
        ] {
            let text = shortest(x);
            assert_eq!(
                text.parse::<f64>().unwrap().to_bits(),
                x.to_bits(),
                "{text}"
            );
            assert!(text.len() < 25, "{text}");
        }
    }

    #[test]
    fn both_forms() {
        let cells = [
            Cell::Count(1),
            Cell::Float(0.5),
            Cell::Decimal("0.25".into()),
            Cell::Undecided,
        ];
        let names = || ["a", "b", "c", "d"].map(String::from).to_vec();
        for (format, due) in [
            (CsvOrJson::Csv, "a,b,c,d\n1,0.5,0.25,undecided\n"),
            (
                CsvOrJson::Json,
                "{\"a\":1,\"b\":0.5,\"c\":\"0.25\",\"d\":null}",
            ),
        ] {
            let mut out = Vec::new();
            let mut rows = Rows::begin(&mut out, format, names(), &Map::new()).unwrap();
            rows.row(&cells).unwrap();
            rows.end().unwrap();
            let text = String::from_utf8(out).unwrap();
            assert!(text.contains(due), "{text}");
            if format == CsvOrJson::Json {
                serde_json::from_str::<Value>(&text).unwrap();
            }
        }
    }
}
