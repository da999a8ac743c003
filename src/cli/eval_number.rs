//! A number as a line of `eval` gives it.

use mechaudit::reference::{Decimal, HexFloat};
use rug::Rational;

/// A decimal, a hexadecimal float, an infinity or NaN.
#[derive(Clone, Debug, PartialEq)]
pub enum Number<'a> {
    /// Checked, not yet read: digits with at most one point, optional sign and exponent.
    Decimal(&'a str),
    Hex(HexFloat),
    NotFinite(f64),
}

impl<'a> Number<'a> {
    pub fn parse(text: &'a str) -> Result<Number<'a>, String> {
        let text = text.trim();
        let body = text.strip_prefix(['-', '+']).unwrap_or(text);
        if body.starts_with("0x") || body.starts_with("0X") {
            return HexFloat::parse(text)
                .map(Number::Hex)
                .map_err(|e| e.to_string());
        }
        if is_decimal(body) {
            return Ok(Number::Decimal(text));
        }
        let words = ["inf", "infinity", "nan"];
        match text.parse() {
            Ok(x) if words.iter().any(|w| body.eq_ignore_ascii_case(w)) => Ok(Number::NotFinite(x)),
            _ => Err(format!(
                "{text:?} is neither a decimal nor a hexadecimal float"
            )),
        }
    }

    /// The nearest `f64`.
    pub fn nearest(&self) -> f64 {
        match self {
            // Rust's conversion rounds correctly.
            Number::Decimal(text) => text.parse().unwrap_or(f64::NAN),
            Number::Hex(x) => x.to_f64(),
            Number::NotFinite(x) => *x,
        }
    }

    /// The number itself.
    pub fn exact(&self) -> Result<Rational, String> {
        match self {
            Number::Decimal(text) => Decimal::parse(text)
                .map(|d| d.value)
                .map_err(|_| format!("the exponent of {text} is beyond ±100000")),
            Number::Hex(x) => Ok(x.value()),
            Number::NotFinite(x) => Err(format!(
                "{x} has no certified digits: with --digits every argument must be finite"
            )),
        }
    }
}

/// Digits with at most one point and an optional exponent; no sign in front.
fn is_decimal(text: &str) -> bool {
    let digits = |t: &str| t.bytes().all(|b| b.is_ascii_digit());
    let (mantissa, exponent) = match text.split_once(['e', 'E']) {
        Some((mantissa, e)) => (mantissa, Some(e.strip_prefix(['-', '+']).unwrap_or(e))),
        None => (text, None),
    };
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    digits(whole)
        && digits(fraction)
        && !(whole.is_empty() && fraction.is_empty())
        && exponent.is_none_or(|e| !e.is_empty() && digits(e))
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
        assert!(exact("nan").unwrap_err().contains("finite"));
        assert!(exact("1e100001").unwrap_err().contains("exponent"));
        assert!(exact("1e99999999999999999999").is_err());
    }
}
