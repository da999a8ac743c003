//! Certified values at a method's inputs: a table for the test suites of other programs, and for
//! `judge --table`.

use crate::cli::failure::Failure;
use crate::cli::process::{interrupt, wire};
use mechaudit::audit::{Case, Cases, Layout, Uncertified};
use mechaudit::methods::{CertifiedValue, Evaluable, certified_digits};
use rayon::prelude::*;
use rug::Rational;

/// Rows computed between two looks at the wish to stop.
const TOGETHER: usize = 256;

/// The table, and what could not be decided.
pub struct Table {
    pub text: String,
    pub undecided: Vec<String>,
}

/// A case with its values, or the reason why it has none.
struct Row {
    case: Case,
    values: Result<Vec<CertifiedValue>, String>,
}

/// Returns the table of all cases; nothing if the user asked to stop.
pub fn table(
    method: &dyn Evaluable,
    cases: &Cases,
    one: Option<&Case>,
    (digits, decimal): (u32, bool),
) -> Result<Option<Table>, Failure> {
    let all = match one {
        Some(case) => vec![case.clone()],
        None => (0..cases.len()).map(|i| cases.get(i)).collect(),
    };
    let mut rows: Vec<Row> = Vec::with_capacity(all.len());
    for part in all.chunks(TOGETHER) {
        if interrupt::is_requested() {
            return Ok(None);
        }
        rows.par_extend(part.par_iter().map(|case| row(method, case, digits)));
    }
    let columns = Columns::of(method, &rows);
    // No version and no path: a table stays the same as long as its values do.
    let (name, summary) = (method.stream(), method.summary());
    let mut text = format!("# {name}: {summary}\n");
    text +=
        &format!("# {digits} certified significant digits of the values at exactly these inputs\n");
    text += &record(columns.names())?;
    let mut undecided = Vec::new();
    let mut region = "";
    for Row { case, values } in &rows {
        let input = wire::line(&case.input, decimal);
        if case.region != region {
            region = case.region;
            text += &format!("# region {region}\n");
        }
        match values {
            Ok(values) => {
                let open = values.iter().filter(|v| v.decimal.is_none());
                undecided.extend(open.map(|v| match &v.why {
                    Some(why) => format!("{input}: a value is undecided: {why}"),
                    None => format!("{input}: a value is undecided"),
                }));
                text += &record(columns.fields(&case.input, values, decimal))?;
            }
            Err(why) => text += &format!("# no values, {why}: {input}\n"),
        }
    }
    Ok(Some(Table { text, undecided }))
}

fn row(method: &dyn Evaluable, case: &Case, digits: u32) -> Row {
    let exact: Option<Vec<Rational>> = case.input.iter().map(|&x| Rational::from_f64(x)).collect();
    let values = match exact {
        None => Err("not finite".into()),
        Some(exact) => match certified_digits(method, &exact, digits, |_| true) {
            Ok(values) => Ok(values),
            Err(Uncertified::Refused(word)) => Err(format!("refused as {word}")),
            Err(other) => Err(other.to_string()),
        },
    };
    Row {
        case: case.clone(),
        values,
    }
}

/// The columns: as many numbers of each vector, and rows of outputs, as the longest case has.
struct Columns {
    layout: Layout,
    lengths: Vec<usize>,
    values: Vec<String>,
}

impl Columns {
    fn of(method: &dyn Evaluable, rows: &[Row]) -> Columns {
        let layout = Layout::new(method);
        let mut lengths = vec![0; layout.parts()];
        let mut most = 0;
        for row in rows {
            let Ok(values) = &row.values else { continue };
            most = most.max(values.len());
            let found = layout.lengths(&row.case.input).unwrap_or_default();
            for (length, found) in lengths.iter_mut().zip(found) {
                *length = found.max(*length);
            }
        }
        let outputs = method.outputs();
        let value = |i: usize| {
            let output = &outputs[i % outputs.len()];
            let name = match method.rows() {
                Some(_) => format!("{}[{}]", output.name, i / outputs.len()),
                None => output.name.to_string(),
            };
            with_unit(name, output.unit)
        };
        Columns {
            layout,
            lengths,
            values: (0..most).map(value).collect(),
        }
    }

    fn names(&self) -> Vec<String> {
        let inputs = self.lengths.iter().enumerate().flat_map(|(part, n)| {
            (0..*n).map(move |k| {
                let name = self.layout.input_column(part, k);
                let column = self.layout.column(&name);
                let unit = column.map_or("1", |column| self.layout.unit(column));
                with_unit(name, unit)
            })
        });
        inputs.chain(self.values.iter().cloned()).collect()
    }

    fn fields(&self, input: &[f64], values: &[CertifiedValue], decimal: bool) -> Vec<String> {
        let found = self.layout.lengths(input).unwrap_or_default();
        let mut fields = Vec::new();
        let mut at = 0;
        for (most, n) in self.lengths.iter().zip(found) {
            let numbers = input[at..at + n].iter();
            fields.extend(numbers.map(|x| wire::line(&[*x], decimal)));
            fields.extend(vec![String::new(); most - n]);
            at += n;
        }
        let decimals = values.iter().map(|v| v.decimal.clone().unwrap_or_default());
        fields.extend(decimals);
        fields.extend(vec![String::new(); self.values.len() - values.len()]);
        fields
    }
}

fn with_unit(name: String, unit: &str) -> String {
    match unit {
        "1" => name,
        unit => format!("{name} [{unit}]"),
    }
}

/// A line of CSV.
fn record(fields: Vec<String>) -> Result<String, Failure> {
    let mut line = csv::Writer::from_writer(Vec::new());
    line.write_record(&fields).map_err(Failure::caused)?;
    let bytes = line.into_inner().map_err(|e| Failure::new(e.to_string()))?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}
