//! The layout of inputs and answers: one description for lists, files, tables and messages.
//!
//! An input is named `symbol`, `symbol[length]` or either with a note in parentheses:
//! `phi1`, `lower[n-1]`, `assembly (1 or -1)`. A length is the symbol of an input before it
//! (`parameters[p]`), a letter that follows from the count of all numbers, or digits; `+k` or `-k`
//! may be added. The outputs form a row, which [`Rows`] may repeat.

use super::method::{Input, Method, Rows};
use super::reason::plain;
use serde::Serialize;

/// Numbers that are not laid out as a method asks for.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LayoutError {
    /// Too few or too many.
    #[error("{found} numbers where {expected} are due: {layout}")]
    Count {
        /// The number found.
        found: usize,
        /// The expected number.
        expected: usize,
        /// The layout.
        layout: String,
    },
    /// A count that belongs to no length.
    #[error("{found} numbers are right for no {letter}: {layout}")]
    NoLength {
        /// The number found.
        found: usize,
        /// The length.
        letter: &'static str,
        /// The layout.
        layout: String,
    },
    /// A number that should be a length.
    #[error("{symbol} = {} is no number of {of}", plain(*.value))]
    BadLength {
        /// Its symbol.
        symbol: &'static str,
        /// Its value.
        value: f64,
        /// The quantity that it counts.
        of: &'static str,
    },
}

/// The number of numbers in a part of the input.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Length {
    One,
    Of { symbol: &'static str, more: isize },
}

/// A part of the input.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Part {
    symbol: &'static str,
    unit: &'static str,
    length: Length,
}

impl Part {
    fn new(input: &Input) -> Part {
        let head = input.name.split(" (").next().unwrap_or(input.name);
        let (symbol, length) = match head.split_once('[') {
            None => (head, Length::One),
            Some((symbol, shape)) => {
                let shape = shape.trim_end_matches(']');
                let end = shape.find(['+', '-']).unwrap_or(shape.len());
                let more = shape[end..].parse().unwrap_or(0);
                let of = &shape[..end];
                (symbol, Length::Of { symbol: of, more })
            }
        };
        Part {
            symbol,
            unit: input.unit,
            length,
        }
    }

    /// The name of its number `k` as a column of a table.
    fn column(&self, k: usize) -> String {
        match self.length {
            Length::One => self.symbol.to_string(),
            Length::Of { .. } => format!("{}[{k}]", self.symbol),
        }
    }
}

/// A part of the input as it is laid out.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Shape {
    /// Its symbol.
    pub symbol: &'static str,
    /// Of a vector its length: the symbol of an input before it or a letter that follows from the
    /// count of all numbers, a constant added or not.
    pub length: Option<String>,
    /// Its unit, `1` if none.
    pub unit: &'static str,
    /// The condition on its values.
    pub note: Option<&'static str>,
}

/// The contents of a column of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Column {
    /// Number `index` of a part of the input.
    Input {
        /// The part, see [`Layout::parts`].
        part: usize,
        /// Counted from zero.
        index: usize,
    },
    /// The value of that number.
    Value(usize),
}

/// The layout of a method's inputs and answers.
#[derive(Clone, Debug, PartialEq)]
pub struct Layout {
    inputs: Vec<Input>,
    parts: Vec<Part>,
    outputs: Vec<(&'static str, &'static str)>,
    rows: Option<Rows>,
}

fn with_unit(name: &str, unit: &str) -> String {
    match unit {
        "1" => name.to_string(),
        unit => format!("{name} [{unit}]"),
    }
}

impl Layout {
    /// That of a method.
    pub fn new(method: &(impl Method + ?Sized)) -> Layout {
        let outputs = method.outputs();
        let outputs = outputs.iter().map(|o| (o.name, o.unit)).collect();
        Layout::of(method.inputs(), outputs, method.rows())
    }

    /// Returns the layout of these inputs, without that of an answer.
    pub fn of_inputs(inputs: Vec<Input>) -> Layout {
        Layout::of(inputs, Vec::new(), None)
    }

    /// Returns the layout of inputs and of outputs with their units.
    pub fn of(
        inputs: Vec<Input>,
        outputs: Vec<(&'static str, &'static str)>,
        rows: Option<Rows>,
    ) -> Layout {
        Layout {
            parts: inputs.iter().map(Part::new).collect(),
            inputs,
            outputs,
            rows,
        }
    }

    /// The input in words, with units.
    pub fn input(&self) -> String {
        let named = self.inputs.iter().map(|i| with_unit(i.name, i.unit));
        named.collect::<Vec<_>>().join(", ")
    }

    /// An output with the index of its row.
    pub fn output(&self, name: &str) -> String {
        match self.rows {
            Some(rows) => format!("{name}[{}]", rows.index),
            None => name.to_string(),
        }
    }

    /// Returns the description of the rows, if there are several.
    pub fn rows(&self) -> Option<String> {
        let rows = self.rows?;
        let (index, meaning) = (rows.index, rows.meaning);
        Some(match rows.count.parse::<usize>() {
            Ok(count) => {
                let (last, all) = (count - 1, count * self.outputs.len());
                format!("for {index} = 0 to {last}, {meaning}: {all} values, row by row")
            }
            Err(_) => format!(
                "for {index} = 0 to {} - 1, {meaning}, row by row",
                rows.count
            ),
        })
    }

    /// The answer in words, with units.
    pub fn answer(&self) -> String {
        let outputs = self.outputs.iter();
        let named = outputs.map(|(name, unit)| with_unit(&self.output(name), unit));
        let named = named.collect::<Vec<_>>().join(", ");
        match self.rows() {
            Some(rows) => format!("{named}; {rows}"),
            None => named,
        }
    }

    /// Parts of the input.
    pub fn parts(&self) -> usize {
        self.parts.len()
    }

    /// Returns the number of numbers in each part of an input.
    ///
    /// # Errors
    /// An input of a length that is not due.
    pub fn lengths(&self, input: &[f64]) -> Result<Vec<usize>, LayoutError> {
        let found = input.len();
        let mut lengths: Vec<Option<usize>> = Vec::new();
        // The letter that is left to be found.
        let mut letter = None;
        for part in &self.parts {
            lengths.push(match part.length {
                Length::One => Some(1),
                Length::Of { symbol, more } if let Ok(n) = symbol.parse::<usize>() => {
                    Some(n.saturating_add_signed(more))
                }
                Length::Of { symbol, more } => {
                    let counted = self.parts[..lengths.len()]
                        .iter()
                        .position(|p| p.symbol == symbol);
                    if counted.is_none() {
                        letter = Some(symbol);
                    }
                    let place = counted.map(|k| lengths[..k].iter().flatten().sum::<usize>());
                    // Cut off before it: the count below says so.
                    let value = place.and_then(|at| input.get(at));
                    match value {
                        Some(&value) => {
                            Some(counts(symbol, value, part.symbol)?.saturating_add_signed(more))
                        }
                        None => None,
                    }
                }
            });
        }
        let fixed = lengths
            .iter()
            .flatten()
            .fold(0usize, |a, b| a.saturating_add(*b));
        let Some(letter) = letter else {
            return match fixed == found {
                true => Ok(lengths.into_iter().flatten().collect()),
                false => Err(LayoutError::Count {
                    found,
                    expected: fixed,
                    layout: self.input(),
                }),
            };
        };
        self.of_letter(letter, &lengths, found.checked_sub(fixed))
            .ok_or_else(|| LayoutError::NoLength {
                found,
                letter,
                layout: self.input(),
            })
    }

    /// The lengths, the open ones those of a letter that takes up `left` numbers.
    fn of_letter(
        &self,
        letter: &str,
        lengths: &[Option<usize>],
        left: Option<usize>,
    ) -> Option<Vec<usize>> {
        let more = |part: &Part| match part.length {
            Length::Of { symbol, more } if symbol == letter => Some(more),
            _ => None,
        };
        let extra: Vec<isize> = self.parts.iter().filter_map(more).collect();
        let left = isize::try_from(left?).ok()? - extra.iter().sum::<isize>();
        let each = isize::try_from(extra.len()).ok()?;
        let n = (left % each == 0).then(|| left / each)?;
        let length = |(part, known): (&Part, &Option<usize>)| match known {
            Some(known) => Some(*known),
            None => usize::try_from(n + more(part)?).ok(),
        };
        self.parts.iter().zip(lengths).map(length).collect()
    }

    /// Returns the contents of a column of that name.
    pub fn column(&self, name: &str) -> Option<Column> {
        let (symbol, index) = match name.strip_suffix(']').and_then(|n| n.rsplit_once('[')) {
            None => (name, None),
            Some((symbol, digits)) => {
                let index: usize = digits.parse().ok()?;
                (index.to_string() == digits).then_some((symbol, Some(index)))?
            }
        };
        let part = self
            .parts
            .iter()
            .position(|p| p.symbol == symbol && index.is_some() == (p.length != Length::One));
        if let Some(part) = part {
            let index = index.unwrap_or(0);
            return Some(Column::Input { part, index });
        }
        let output = self.outputs.iter().position(|(o, _)| *o == symbol)?;
        let row = match (self.rows, index) {
            (None, None) => 0,
            (Some(rows), Some(row)) => {
                let there = rows
                    .count
                    .parse::<usize>()
                    .map_or(true, |count| row < count);
                there.then_some(row)?
            }
            _ => return None,
        };
        Some(Column::Value(row * self.outputs.len() + output))
    }

    /// The unit of a column.
    pub fn unit(&self, column: Column) -> &'static str {
        match column {
            Column::Input { part, .. } => self.parts[part].unit,
            Column::Value(i) => self.outputs[i % self.outputs.len()].1,
        }
    }

    /// The name of number `index` of a part of the input.
    pub fn input_column(&self, part: usize, index: usize) -> String {
        self.parts[part].column(index)
    }

    /// Returns true if a part of the input is a single number.
    pub fn is_single(&self, part: usize) -> bool {
        self.parts[part].length == Length::One
    }

    /// The parts of the input one by one.
    pub fn shapes(&self) -> Vec<Shape> {
        let parts = self.parts.iter().zip(&self.inputs);
        parts
            .map(|(part, input)| Shape {
                symbol: part.symbol,
                length: match part.length {
                    Length::One => None,
                    Length::Of { symbol, more: 0 } => Some(symbol.to_string()),
                    Length::Of { symbol, more } => Some(format!("{symbol}{more:+}")),
                },
                unit: part.unit,
                note: input
                    .name
                    .split_once(" (")
                    .map(|(_, n)| n.trim_end_matches(')')),
            })
            .collect()
    }

    /// The symbols of single numbers, with their places in an input: those before the first part
    /// whose length is not fixed.
    pub fn singles(&self) -> Vec<(&'static str, usize)> {
        let singles = self.parts.iter().take_while(|p| p.length == Length::One);
        singles.enumerate().map(|(k, p)| (p.symbol, k)).collect()
    }

    /// Where number `index` of a part stands in an input; nothing where the part is shorter, or
    /// the input is not laid out as it should be.
    pub fn place(&self, part: usize, index: usize, input: &[f64]) -> Option<usize> {
        let lengths = self.lengths(input).ok()?;
        let before: usize = lengths[..part].iter().sum();
        (index < lengths[part]).then_some(before + index)
    }

    /// The names of an input's numbers; `[k]` if it is not laid out as it should be.
    pub fn names(&self, input: &[f64]) -> Vec<(String, &'static str)> {
        let Ok(lengths) = self.lengths(input) else {
            return (0..input.len()).map(|k| (format!("[{k}]"), "")).collect();
        };
        let parts = self.parts.iter().zip(lengths);
        parts
            .flat_map(|(part, n)| (0..n).map(|k| (part.column(k), part.unit)))
            .collect()
    }

    /// For each number of an input whether it is data of the method; where it is not laid out as it
    /// should be, every number is.
    pub fn is_data(&self, method: &(impl Method + ?Sized), input: &[f64]) -> Vec<bool> {
        let Ok(lengths) = self.lengths(input) else {
            return vec![true; input.len()];
        };
        let parts = lengths.into_iter().enumerate();
        parts
            .flat_map(|(k, n)| std::iter::repeat_n(method.is_data(k), n))
            .collect()
    }

    /// The names of columns that there are; of vectors the first.
    pub fn columns(&self) -> Vec<String> {
        let inputs = self.parts.iter().map(|p| p.column(0));
        let outputs = self.outputs.iter().map(|(name, _)| match self.rows {
            Some(_) => format!("{name}[0]"),
            None => (*name).to_string(),
        });
        inputs.chain(outputs).collect()
    }
}

/// A number of the input as a length.
fn counts(symbol: &'static str, value: f64, of: &'static str) -> Result<usize, LayoutError> {
    // 2^32 is beyond what any line holds.
    match value {
        v if v >= 0.0 && v.fract() == 0.0 && v < 4_294_967_296.0 => Ok(v as usize),
        value => Err(LayoutError::BadLength { symbol, value, of }),
    }
}

#[cfg(test)]
mod tests;
