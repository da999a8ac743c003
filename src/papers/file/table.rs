//! Printed tables: CSV files with the definition of each column.

use super::entry::{circular, fault};
use super::read::{Reading, count, defined, only, required, text, texts, word};
use super::study;
use crate::papers::number::Number;
use crate::study::document::{Item as Node, Value};
use crate::study::{Problem, Spacing, Study, StudyError, StudyInput, intern, is_name};
use crate::symbolic::Definitions;

/// The rule by which a printed number was rounded.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Rounding {
    /// To the nearest: within half a unit of the last digit.
    #[default]
    Nearest,
    /// From inexact intermediate values: within one unit of the last digit.
    LastDigit,
    /// The digits that follow are left out.
    Cut,
}

pub(super) const ROUNDINGS: [(&str, Rounding); 3] = [
    ("nearest", Rounding::Nearest),
    ("last-digit", Rounding::LastDigit),
    ("cut", Rounding::Cut),
];

/// A printed table.
#[derive(Clone, Debug)]
pub struct Table {
    /// Its number.
    pub number: u32,
    /// Its title.
    pub title: &'static str,
    /// The numbers of its rows as printed, or from 1.
    pub rows: Vec<u32>,
    /// Columns that are taken as printed: their names and numbers.
    pub given: Vec<(&'static str, Vec<Number>)>,
    /// Columns that are judged.
    pub columns: Vec<Column>,
}

/// A column that is judged.
#[derive(Clone, Debug)]
pub struct Column {
    /// Its name.
    pub name: &'static str,
    /// The numbers as printed; none where a cell is empty.
    pub printed: Vec<Option<Number>>,
    /// The study that has its definition, with the given columns as inputs.
    pub study: Study,
    /// The number of its output in that study.
    pub output: usize,
    /// The rule of rounding.
    pub rounding: Rounding,
    /// The rows that are known to be wrong.
    pub wrong: Vec<u32>,
}

/// The largest number of rows.
const MOST_ROWS: usize = 100_000;

/// The cells of a CSV file by column.
struct Cells {
    file: String,
    headers: Vec<String>,
    lines: Vec<u64>,
    rows: Vec<Vec<String>>,
}

impl Cells {
    fn fault(&self, line: u64, reason: String) -> StudyError {
        StudyError::new(format!("line {line}: {reason}")).in_file(&self.file)
    }

    fn read(reading: &Reading, node: &Node) -> Result<Cells, StudyError> {
        let file = node.text()?;
        let text = reading.source.read(file).map_err(|e| e.at(node.place))?;
        let mut reader = csv::ReaderBuilder::new()
            .comment(Some(b'#'))
            .flexible(true)
            .trim(csv::Trim::All)
            .from_reader(text.as_bytes());
        let mut cells = Cells {
            file: file.into(),
            headers: Vec::new(),
            lines: Vec::new(),
            rows: Vec::new(),
        };
        let bad = |e: csv::Error| StudyError::new(e.to_string()).in_file(file);
        cells.headers = reader
            .headers()
            .map_err(bad)?
            .iter()
            .map(String::from)
            .collect();
        for record in reader.records() {
            let record = record.map_err(bad)?;
            let line = record.position().map_or(0, csv::Position::line);
            let (found, due) = (record.len(), cells.headers.len());
            if found != due {
                let reason = format!("the row has {found} cells where the head has {due}");
                return Err(cells.fault(line, reason));
            }
            cells.lines.push(line);
            cells.rows.push(record.iter().map(String::from).collect());
            if cells.rows.len() > MOST_ROWS {
                return Err(cells.fault(line, format!("more than {MOST_ROWS} rows")));
            }
        }
        match cells.rows.is_empty() {
            true => Err(StudyError::new("the table has no rows").in_file(file)),
            false => Ok(cells),
        }
    }

    fn column(&self, name: &str, node: &Node) -> Result<usize, StudyError> {
        self.headers.iter().position(|h| h == name).ok_or_else(|| {
            let known = self.headers.join(", ");
            node.fault(format!(
                "{} has no column {name:?}; there are: {known}",
                self.file
            ))
        })
    }

    fn number(&self, row: usize, column: usize) -> Result<Number, StudyError> {
        let text = &self.rows[row][column];
        Number::parse(text).ok_or_else(|| {
            let reason = format!("column {}: {text:?} is no number", self.headers[column]);
            self.fault(self.lines[row], reason)
        })
    }
}

/// Reads a table, its file and the definitions of its columns.
pub(super) fn read(reading: &Reading, node: &Node) -> Result<Table, StudyError> {
    only(
        node,
        "number title file row given study with rounding columns",
    )?;
    let of = match node.get("study") {
        None => None,
        Some(file) => {
            if let Some(other) = node.get("given").or(node.get("with")) {
                let reason =
                    "the inputs of a study are taken as printed, and its names are its own";
                return Err(other.fault(reason));
            }
            Some((file, study::open(reading, file)?))
        }
    };
    let cells = Cells::read(reading, required(node, "file")?)?;
    let rounding = word(node.get("rounding"), &ROUNDINGS, Rounding::Nearest)?;
    let number = count(required(node, "number")?, 100_000)?;
    let rows = match node.get("row") {
        None => (1..=cells.rows.len() as u32).collect(),
        Some(row) => {
            let column = cells.column(row.text()?, row)?;
            let of = |k: usize| {
                let text = &cells.rows[k][column];
                text.parse::<u32>().map_err(|_| {
                    cells.fault(cells.lines[k], format!("{text:?} is no number of a row"))
                })
            };
            (0..cells.rows.len())
                .map(of)
                .collect::<Result<Vec<_>, _>>()?
        }
    };
    let mut named = Vec::new();
    match &of {
        Some((file, study)) => {
            let inputs = study.problem().inputs.iter();
            named.extend(inputs.map(|i| (i.name.clone(), *file)));
        }
        None => {
            for item in texts(node.get("given")) {
                is_name(item.text()?, item)?;
                named.push((item.text()?.to_string(), item));
            }
        }
    }
    let mut given = Vec::new();
    for (name, item) in &named {
        let column = cells.column(name, item)?;
        let numbers = (0..cells.rows.len()).map(|k| cells.number(k, column));
        given.push((intern(name), numbers.collect::<Result<Vec<_>, _>>()?));
    }
    let listed = required(node, "columns")?.table()?;
    if listed.is_empty() {
        return Err(node.fault("a table has at least one column with a definition"));
    }
    let mut stated = Vec::new();
    for (name, node) in listed {
        stated.push((name.as_str(), column(node, &rows, rounding)?));
    }
    let studies = match of {
        Some((file, of)) => {
            let outputs: Vec<_> = stated.iter().map(|(name, s)| (*name, s.is)).collect();
            vec![study::with_outputs(&of, file, &outputs)?; stated.len()]
        }
        None => {
            let inputs: Vec<&str> = given.iter().map(|g| g.0).collect();
            let shared = shared(reading, node)?;
            let own = stated.iter();
            let own = own.map(|(_, s)| formula(reading, s.is, &inputs, &shared));
            own.collect::<Result<_, _>>()?
        }
    };
    let mut columns = Vec::new();
    for ((name, stated), study) in stated.into_iter().zip(studies) {
        let column = cells.column(name, stated.node)?;
        let of = |k: usize| match cells.rows[k][column].is_empty() {
            true => Ok(None),
            false => cells.number(k, column).map(Some),
        };
        columns.push(Column {
            name: intern(name),
            printed: (0..cells.rows.len()).map(of).collect::<Result<_, _>>()?,
            output: study
                .problem()
                .outputs
                .iter()
                .position(|o| o.name == name)
                .unwrap_or(0),
            study,
            rounding: stated.rounding,
            wrong: stated.wrong,
        });
    }
    Ok(Table {
        number,
        title: text(node, "title")?,
        columns,
        rows,
        given,
    })
}

/// The definitions that all columns of a table, or a claim, may use: values of symbols and groups.
pub(super) fn shared(
    reading: &Reading,
    node: &Node,
) -> Result<(Definitions, Vec<String>), StudyError> {
    let with = reading.definitions(node.get("with"))?;
    let own: Vec<String> = with
        .iter()
        .filter_map(|t| defined(t))
        .map(String::from)
        .collect();
    let names = reading.symbols.names.with(own.clone());
    let place = node.get("with").unwrap_or(node);
    let mut all = names
        .definitions(&with)
        .map_err(|e| fault(e, place, &names))?;
    for (name, value) in &reading.symbols.values {
        all.names
            .entry(name.clone())
            .or_insert_with(|| value.clone());
    }
    match circular(&all) {
        Some(name) => Err(place.fault(format!("the definition of {name} leads back to {name}"))),
        None => Ok((all, own)),
    }
}

/// The statements of a file about a column.
struct Stated<'a> {
    node: &'a Node,
    is: &'a Node,
    rounding: Rounding,
    wrong: Vec<u32>,
}

fn column<'a>(node: &'a Node, rows: &[u32], rounding: Rounding) -> Result<Stated<'a>, StudyError> {
    let (is, rounding, wrong) = match node.value {
        Value::Table(_) => {
            node.only(&["is", "rounding", "wrong"])?;
            let mut wrong = Vec::new();
            for row in texts(node.get("wrong")) {
                let found = count(row, u32::MAX)?;
                if !rows.contains(&found) {
                    return Err(row.fault(format!("the table has no row {found}")));
                }
                wrong.push(found);
            }
            let rounding = word(node.get("rounding"), &ROUNDINGS, rounding)?;
            (required(node, "is")?, rounding, wrong)
        }
        _ => (node, rounding, Vec::new()),
    };
    Ok(Stated {
        node,
        is,
        rounding,
        wrong,
    })
}

/// An expression of named inputs as a study, whose values are certified.
pub(super) fn formula(
    reading: &Reading,
    node: &Node,
    inputs: &[&str],
    (definitions, own): &(Definitions, Vec<String>),
) -> Result<Study, StudyError> {
    let text = node.text()?;
    let more = inputs
        .iter()
        .map(|n| n.to_string())
        .chain(own.iter().cloned());
    let names = reading.symbols.names.with(more);
    let is = names.expression(text).map_err(|e| fault(e, node, &names))?;
    let mut definitions = definitions.clone();
    for name in inputs {
        definitions.names.remove(*name);
    }
    let input = |name: &&str| StudyInput {
        name: name.to_string(),
        unit: "1".into(),
        from: None,
        to: None,
        spacing: Spacing::Linear,
    };
    let problem = Problem {
        name: "value".into(),
        title: text.into(),
        inputs: inputs.iter().map(input).collect(),
        outputs: vec![study::output("value", text, is)],
        definitions,
        ..Problem::default()
    };
    Study::new(problem).map_err(|e| e.at(node.place))
}
