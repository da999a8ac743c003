//! A number in a line of `eval`.

use mechaudit::reference::{Decimal, DecimalError, HexFloat, HexFloatError};
use rug::Rational;

/// A decimal, a hexadecimal float, an infinity or NaN.
#[derive(Clone, Debug, PartialEq)]
pub enum Number<'a> {
    /// Written as a decimal, and the nearest `f64`.
    Decimal(&'a str, f64),
    Hex(HexFloat),
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
            Number::NotFinite(x) => *x,
        }
    }

    /// The number itself.
    pub fn exact(&self) -> Result<Rational, NumberError> {
        match self {
            Number::Decimal(text, _) => Ok(Decimal::parse(text)?.value),
            Number::Hex(x) => Ok(x.value()),
            Number::NotFinite(x) => Err(NumberError::NotFinite(*x)),
        }
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
}
