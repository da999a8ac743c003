//! Numbers and lines of numbers as users write them.

use mechaudit::reference::{Decimal, DecimalError, HexFloat, HexFloatError, nearest_f64};
use rug::Rational;

/// The longest line of an input, an answer or a table.
pub const LONGEST: usize = 1 << 20;
/// The largest number of fields on a line.
pub const FIELDS: usize = 100_000;

/// A decimal, a hexadecimal float, a quotient of decimals, an infinity or NaN.
#[derive(Clone, Debug, PartialEq)]
pub enum Number<'a> {
    /// Written as a decimal, and the nearest `f64`.
    Decimal(&'a str, f64),
    Hex(HexFloat),
    /// A quotient of two decimals, `1/3`.
    Quotient(Rational),
    NotFinite(f64),
}

/// The text is no number.
#[derive(Debug, thiserror::Error)]
pub enum NumberError {
    #[error(transparent)]
    Hex(#[from] HexFloatError),
    #[error("{text:?} is neither a decimal nor a hexadecimal float")]
    Neither { text: String },
    #[error(transparent)]
    Exponent(#[from] DecimalError),
    #[error("{0} has no certified digits: with --digits every argument must be finite")]
    NotFinite(f64),
}

impl<'a> Number<'a> {
    pub fn parse(text: &'a str) -> Result<Number<'a>, NumberError> {
        let text = text.trim();
        let body = text.strip_prefix(['-', '+']).unwrap_or(text);
        if body.starts_with("0x") || body.starts_with("0X") {
            return Ok(Number::Hex(HexFloat::parse(text)?));
        }
        if let Ok(nearest) = Decimal::nearest(text) {
            return Ok(Number::Decimal(text, nearest));
        }
        if let Some((above, below)) = text.split_once('/') {
            let decimal = |text: &str| Decimal::parse(text.trim()).map(|d| d.value);
            return match (decimal(above), decimal(below)) {
                (Ok(above), Ok(below)) if !below.is_zero() => Ok(Number::Quotient(above / below)),
                _ => Err(NumberError::Neither { text: text.into() }),
            };
        }
        let words = ["inf", "infinity", "nan"];
        match text.parse() {
            Ok(x) if words.iter().any(|w| body.eq_ignore_ascii_case(w)) => Ok(Number::NotFinite(x)),
            _ => Err(NumberError::Neither { text: text.into() }),
        }
    }

    /// The nearest `f64`.
    pub fn nearest(&self) -> f64 {
        match self {
            Number::Decimal(_, x) => *x,
            Number::Hex(x) => x.to_f64(),
            Number::Quotient(x) => nearest_f64(x),
            Number::NotFinite(x) => *x,
        }
    }

    /// The number itself.
    pub fn exact(&self) -> Result<Rational, NumberError> {
        match self {
            Number::Decimal(text, _) => Ok(Decimal::parse(text)?.value),
            Number::Hex(x) => Ok(x.value()),
            Number::Quotient(x) => Ok(x.clone()),
            Number::NotFinite(x) => Err(NumberError::NotFinite(*x)),
        }
    }
}

/// The reason why a line holds no numbers.
#[derive(Debug, thiserror::Error)]
pub enum LineError {
    #[error("longer than {}", size(LONGEST))]
    TooLong,
    #[error("not UTF-8")]
    NotUtf8(#[from] std::str::Utf8Error),
    #[error("empty")]
    Empty,
    #[error("more than {FIELDS} fields")]
    TooManyFields,
    #[error("an empty field in {0:?}")]
    EmptyField(String),
    /// Longer than what is shown of a line.
    #[error("a field that is no number in {line:?}")]
    LongField { line: String },
    #[error("{source} in {line:?}")]
    Field { line: String, source: NumberError },
}

/// The number of characters of a line that a message shows.
pub const SHOWN: usize = 80;

/// Returns the beginning of a line, for messages.
pub fn shortened(text: &[u8]) -> String {
    let text = String::from_utf8_lossy(&text[..text.len().min(4 * SHOWN)]);
    let text = text.trim();
    match text.char_indices().nth(SHOWN) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.into(),
    }
}

/// Reads numbers separated by commas or blanks.
pub fn numbers(text: &str) -> Result<Vec<f64>, LineError> {
    let line = || shortened(text.as_bytes());
    let mut numbers = Vec::new();
    for part in text.split(',') {
        let before = numbers.len();
        for field in part.split_whitespace() {
            if numbers.len() == FIELDS {
                return Err(LineError::TooManyFields);
            }
            numbers.push(match Number::parse(field) {
                Ok(number) => number.nearest(),
                Err(source) if field.len() <= SHOWN => {
                    let line = line();
                    return Err(LineError::Field { line, source });
                }
                Err(_) => return Err(LineError::LongField { line: line() }),
            });
        }
        // Nothing between two commas is something missing.
        if numbers.len() == before {
            return Err(LineError::EmptyField(line()));
        }
    }
    Ok(numbers)
}

/// Formats a number of bytes.
pub fn size(bytes: usize) -> String {
    match bytes {
        b if b >= 1 << 20 && b % (1 << 20) == 0 => format!("{} MiB", b >> 20),
        b => format!("{b} bytes"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers() {
        for (text, x) in [
            ("1", 1.0),
            (" -0.1 ", -0.1),
            ("+.5", 0.5),
            ("5.", 5.0),
            ("1e-3", 0.001),
            ("1E+3", 1000.0),
            ("0x1.8p-3", 0.1875),
            ("-0x0p+0", -0.0),
            ("-0", -0.0),
            ("1e400", f64::INFINITY),
            ("1e-400", 0.0),
            ("inf", f64::INFINITY),
            ("-Infinity", f64::NEG_INFINITY),
        ] {
            let got = Number::parse(text).unwrap().nearest();
            assert_eq!(got.to_bits(), x.to_bits(), "{text}: {got}");
        }
        assert!(Number::parse("NaN").unwrap().nearest().is_nan());
        for bad in [
            "", "-", ".", "e5", "1e", "1e+", "1.2.3", "1 2", "0x", "in", "1_0", "--1", "é", "1d5",
        ] {
            assert!(Number::parse(bad).is_err(), "{bad:?}");
        }
    }

    #[test]
    fn exactly() {
        let exact = |t: &str| Number::parse(t).unwrap().exact();
        assert_eq!(exact("0.1").unwrap(), Rational::from((1, 10)));
        assert_eq!(exact("5.").unwrap(), Rational::from(5));
        assert_eq!(exact("-0x1p-2").unwrap(), Rational::from((-1, 4)));
        assert!(exact("nan").unwrap_err().to_string().contains("finite"));
        assert!(
            exact("1e100001")
                .unwrap_err()
                .to_string()
                .contains("exponent")
        );
        assert!(exact("1e99999999999999999999").is_err());
    }

    #[test]
    fn whole_mebibytes_are_said_so() {
        assert_eq!(size(1 << 20), "1 MiB");
        assert_eq!(size(3 << 20), "3 MiB");
        assert_eq!(size((1 << 20) + 1), "1048577 bytes");
        assert_eq!(size(1 << 19), "524288 bytes");
        assert_eq!(size(2), "2 bytes");
        assert_eq!(size(0), "0 bytes");
    }
}
