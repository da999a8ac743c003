//! Rows of a linkage as CSV or JSON, written one by one.

use super::cell::Cell;
use super::columns::Columns;
use serde_json::{Map, Value};
use std::borrow::Cow;
use std::io::{self, Write};

/// The forms of rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// One line for each row.
    Csv,
    /// The rows beside all that is known of the whole.
    Json,
    /// A table for a page, with some of the rows.
    Table,
}

/// Rows of a table at most.
const MOST: usize = 64;

/// A row of cells under the columns' names.
pub struct Rows<'a> {
    out: &'a mut dyn Write,
    format: Form,
    columns: Columns,
    any: bool,
    /// Of a table the rows kept: every `every`th of those that came.
    kept: Vec<Vec<Cell>>,
    every: usize,
    came: usize,
    /// Memory for a line of CSV.
    line: String,
}

impl<'a> Rows<'a> {
    /// Writes the head: for CSV the columns' names, for JSON everything in `about` first.
    pub fn begin(
        out: &'a mut dyn Write,
        format: impl Into<Form>,
        columns: impl Into<Columns>,
        about: &Map<String, Value>,
    ) -> io::Result<Rows<'a>> {
        let (columns, format) = (columns.into(), format.into());
        match format {
            Form::Table => {}
            Form::Csv => writeln!(out, "{}", columns.names.join(","))?,
            Form::Json => {
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
            kept: Vec::new(),
            every: 1,
            came: 0,
            line: String::new(),
        })
    }

    /// Writes one row.
    pub fn row(&mut self, cells: &[Cell]) -> io::Result<()> {
        let columns = &self.columns;
        let cells = cells.iter().enumerate();
        let cells = cells.map(|(k, c)| columns.cell(k, c));
        match self.format {
            Form::Table => {
                let cells = cells.map(Cow::into_owned).collect();
                self.keep(cells);
            }
            Form::Csv => {
                self.line.clear();
                for cell in cells {
                    cell.append(&mut self.line);
                    self.line.push(',');
                }
                self.line.pop();
                self.line.push('\n');
                self.out.write_all(self.line.as_bytes())?;
            }
            Form::Json => {
                let mut object = Map::new();
                for (name, cell) in columns.names.iter().zip(cells) {
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

    /// Keeps the row if it is one of those shown; memory does not grow with the number of rows.
    fn keep(&mut self, cells: Vec<Cell>) {
        if self.came.is_multiple_of(self.every) {
            self.kept.push(cells);
        }
        self.came += 1;
        if self.kept.len() > MOST {
            self.every *= 2;
            let mut number = 0;
            self.kept.retain(|_| {
                number += 1;
                number % 2 == 1
            });
        }
    }

    /// Writes the end.
    pub fn end(self) -> io::Result<()> {
        if self.format == Form::Table {
            let table = super::html::run::table(&self.columns.names, &self.kept, self.every);
            self.out.write_all(table.into_string().as_bytes())?;
        }
        if self.format == Form::Json {
            writeln!(self.out, "\n  ]\n}}")?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
            (Form::Csv, "a,b,c,d\n1,0.5,0.25,undecided\n"),
            (Form::Json, "{\"a\":1,\"b\":0.5,\"c\":\"0.25\",\"d\":null}"),
        ] {
            let mut out = Vec::new();
            let mut rows = Rows::begin(&mut out, format, names(), &Map::new()).unwrap();
            rows.row(&cells).unwrap();
            rows.end().unwrap();
            let text = String::from_utf8(out).unwrap();
            assert!(text.contains(due), "{text}");
            if format == Form::Json {
                serde_json::from_str::<Value>(&text).unwrap();
            }
        }
    }

    #[test]
    fn rows_of_json_are_separated_and_come_behind_what_is_known() {
        let about: Map<String, Value> = [("name".to_string(), Value::from("a"))]
            .into_iter()
            .collect();
        for (n, due) in [
            (
                0,
                "{\n  \"name\": \"a\",\n  \"columns\": [\"x\"],\n  \"rows\": [\n  ]\n}\n",
            ),
            (
                2,
                "{\n  \"name\": \"a\",\n  \"columns\": [\"x\"],\n  \"rows\": [\n    {\"x\":0},\n    {\"x\":1}\n  ]\n}\n",
            ),
        ] {
            let mut out = Vec::new();
            let names = vec!["x".to_string()];
            let mut rows = Rows::begin(&mut out, Form::Json, names, &about).unwrap();
            for k in 0..n {
                rows.row(&[Cell::Count(k)]).unwrap();
            }
            rows.end().unwrap();
            assert_eq!(String::from_utf8(out).unwrap(), due);
        }
    }

    #[test]
    fn a_table_keeps_at_most_64_rows_evenly_spaced() {
        for (n, every) in [(1, 1), (64, 1), (65, 2), (128, 2), (129, 4), (1000, 16)] {
            let mut out = Vec::new();
            let mut rows = Rows::begin(&mut out, Form::Table, vec!["t_s".to_string()], &Map::new());
            for k in 0..n {
                rows.as_mut().unwrap().row(&[Cell::Count(k)]).unwrap();
            }
            rows.unwrap().end().unwrap();
            let html = String::from_utf8(out).unwrap();
            let body = html.split("<tbody>").nth(1).unwrap();
            let shown: Vec<usize> = body
                .split("<th>")
                .skip(1)
                .map(|t| t.split('<').next().unwrap().parse().unwrap())
                .collect();
            assert_eq!(shown, (0..n).step_by(every).collect::<Vec<_>>(), "{n}");
        }
    }

    #[test]
    fn csv_has_no_end() {
        let mut out = Vec::new();
        let rows = Rows::begin(&mut out, Form::Csv, vec!["x".to_string()], &Map::new());
        rows.unwrap().end().unwrap();
        assert_eq!(out, b"x\n");
    }
}
