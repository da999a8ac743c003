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
        match self {
            Cell::Count(n) => n.to_string(),
            Cell::Float(x) => shortest(*x),
            Cell::Decimal(d) | Cell::Word(d) => d.clone(),
            Cell::Name(n) => (*n).into(),
            Cell::Undecided => "undecided".into(),
            Cell::Empty => String::new(),
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

/// The shortest decimal that reads back as the same number.
fn shortest(x: f64) -> String {
    let size = x.abs();
    if size != 0.0 && !(1e-5..1e16).contains(&size) {
        format!("{x:e}")
    } else {
        format!("{x}")
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
