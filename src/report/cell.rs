//! Values of rows.

use serde_json::Value;

/// One value of a row.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// A whole number.
    Count(usize),
    /// A floating-point number.
    Float(f64),
    /// A certified decimal.
    Decimal(String),
    /// A word.
    Name(&'static str),
    /// A word of the input.
    Word(String),
    /// No digits could be certified.
    Undecided,
    /// There is no value: an empty field.
    Empty,
}

impl Cell {
    /// A certified decimal, if there is one.
    pub fn certified(digits: Option<String>) -> Cell {
        digits.map_or(Cell::Undecided, Cell::Decimal)
    }

    /// The value as written in CSV.
    pub fn text(&self) -> String {
        let mut text = String::new();
        self.append(&mut text);
        text
    }

    /// Appends [`Cell::text`].
    pub fn append(&self, text: &mut String) {
        match self {
            Cell::Count(n) => text.push_str(&n.to_string()),
            Cell::Float(x) => shortest(*x, text),
            Cell::Decimal(d) | Cell::Word(d) => text.push_str(d),
            Cell::Name(n) => text.push_str(n),
            Cell::Undecided => text.push_str("undecided"),
            Cell::Empty => {}
        }
    }

    /// The value for programs.
    pub fn json(&self) -> Value {
        match self {
            Cell::Count(n) => (*n).into(),
            Cell::Float(x) => (*x).into(),
            Cell::Decimal(d) | Cell::Word(d) => d.as_str().into(),
            Cell::Name(n) => (*n).into(),
            Cell::Undecided | Cell::Empty => Value::Null,
        }
    }
}

/// Appends the shortest decimal that reads back as the same number.
fn shortest(x: f64, text: &mut String) {
    if x == 0.0 || (1e-5..1e16).contains(&x.abs()) {
        let mut buffer = zmij::Buffer::new();
        let decimal = buffer.format_finite(x);
        text.push_str(decimal.strip_suffix(".0").unwrap_or(decimal));
    } else {
        text.push_str(&format!("{x:e}"));
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
            let text = Cell::Float(x).text();
            assert_eq!(
                text.parse::<f64>().unwrap().to_bits(),
                x.to_bits(),
                "{text}"
            );
            assert!(text.len() < 25, "{text}");
        }
    }

    #[test]
    fn exponents_are_for_what_is_small_or_large() {
        for (x, due) in [
            (0.0, "0"),
            (-0.0, "-0"),
            (0.5, "0.5"),
            (1e-5, "0.00001"),
            (1.5e-5, "0.000015"),
            (9e-6, "9e-6"),
            (-9e-6, "-9e-6"),
            (9e15, "9000000000000000"),
            (1e16, "1e16"),
            (1.5e16, "1.5e16"),
            (f64::INFINITY, "inf"),
        ] {
            assert_eq!(Cell::Float(x).text(), due);
        }
    }

    #[test]
    fn every_value_has_a_text_and_a_place_in_json() {
        for (cell, text, json) in [
            (Cell::Count(3), "3", Value::from(3)),
            (Cell::Float(0.5), "0.5", Value::from(0.5)),
            (Cell::certified(Some("0.50".into())), "0.50", "0.50".into()),
            (Cell::certified(None), "undecided", Value::Null),
            (Cell::Empty, "", Value::Null),
            (Cell::Name("a"), "a", "a".into()),
            (Cell::Word("b".into()), "b", "b".into()),
            (Cell::Float(f64::NAN), "NaN", Value::Null),
            (Cell::Empty, "", Value::Null),
        ] {
            assert_eq!((cell.text().as_str(), cell.json()), (text, json));
        }
    }
}
