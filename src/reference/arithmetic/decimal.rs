//! Exact decimals in, certified decimals out.

use super::ball::Ball;
use super::mag::Mag;
use rug::float::{Round, prec_min};
use rug::ops::Pow;
use rug::{Float, Integer, Rational};

/// A decimal number as written: its exact value and the place of its last digit.
#[derive(Clone, Debug, PartialEq)]
pub struct Decimal {
    /// The exact value.
    pub value: Rational,
    /// Digits after the decimal point.
    pub places: u32,
    /// The last digit stands for `10^exponent`: −2 in `1.25`, 3 in `1.2e4`.
    pub exponent: i32,
}

/// The text is not a decimal number that can be read exactly.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum DecimalError {
    /// Something else than digits with at most one point, an optional sign and exponent.
    #[error("{text:?} is not a decimal number (digits, one point, an optional sign and exponent)")]
    Syntax {
        /// The text.
        text: String,
    },
    /// Its digits written out would not fit into memory.
    #[error("the exponent of the decimal number {text:?} is beyond ±100000")]
    Exponent {
        /// The text.
        text: String,
    },
}

fn syntax(text: &str) -> DecimalError {
    DecimalError::Syntax { text: text.into() }
}

/// Precision of what is rounded up to a bound.
const BITS: u32 = 64;

/// Largest size of an exponent that is read exactly.
const LARGEST_EXPONENT: u32 = 100_000;

/// The parts of a written decimal: an optional sign, digits with at most one point, an optional
/// exponent of any size. The grammar of decimals everywhere.
struct Written<'a> {
    negative: bool,
    whole: &'a str,
    fraction: &'a str,
    /// With its sign; empty where there is none.
    exponent: &'a str,
}

impl<'a> Written<'a> {
    fn read(text: &'a str) -> Result<Written<'a>, DecimalError> {
        let unsigned = |t: &'a str| t.strip_prefix(['-', '+']).unwrap_or(t);
        let digits = |t: &str| t.bytes().all(|b| b.is_ascii_digit());
        let t = text.trim();
        let (mantissa, exponent) = t.split_once(['e', 'E']).unwrap_or((t, ""));
        let size = unsigned(mantissa);
        let (whole, fraction) = size.split_once('.').unwrap_or((size, ""));
        let power = unsigned(exponent);
        // That there are any digits is left to the conversions.
        let good = digits(whole)
            && digits(fraction)
            && digits(power)
            && (mantissa.len() == t.len() || !power.is_empty());
        let negative = mantissa.starts_with('-');
        let written = Written {
            negative,
            whole,
            fraction,
            exponent,
        };
        good.then_some(written).ok_or_else(|| syntax(text))
    }
}

impl Decimal {
    /// Reads a decimal such as `-110.0421`, `75` or `1.5e-3`, exactly.
    ///
    /// ```
    /// use mechaudit_reference::Decimal;
    /// let d = Decimal::parse("-39.30")?;
    /// assert_eq!(d.value, rug::Rational::from((-393, 10)));
    /// assert_eq!(d.places, 2);
    /// # Ok::<(), mechaudit_reference::DecimalError>(())
    /// ```
    ///
    /// # Errors
    /// Anything else, and an exponent beyond ±100 000.
    pub fn parse(text: &str) -> Result<Decimal, DecimalError> {
        let written = Written::read(text)?;
        let beyond = || DecimalError::Exponent { text: text.into() };
        let exponent = match written.exponent {
            "" => 0,
            e => e.parse::<i32>().map_err(|_| beyond())?,
        };
        if exponent.unsigned_abs() > LARGEST_EXPONENT {
            return Err(beyond());
        }
        let all = [written.whole, written.fraction].concat();
        let mut n: Integer = all.parse().map_err(|_| syntax(text))?;
        if written.negative {
            n = -n;
        }
        let shift = written.fraction.len() as i32 - exponent;
        let ten = Integer::from(10).pow(shift.unsigned_abs());
        let value = match shift {
            0.. => Rational::from((n, ten)),
            _ => Rational::from(n * ten),
        };
        Ok(Decimal {
            value,
            places: shift.max(0) as u32,
            exponent: -shift,
        })
    }

    /// The `f64` nearest to a written decimal, ties to even, without its exact value: the exponent
    /// may have any size, and the sign of a zero is kept.
    ///
    /// ```
    /// use mechaudit_reference::Decimal;
    /// assert_eq!(Decimal::nearest("2.5e-324")?, 5e-324);
    /// assert_eq!(Decimal::nearest("-1e99999999999")?, f64::NEG_INFINITY);
    /// assert!(Decimal::nearest("inf").is_err());
    /// # Ok::<(), mechaudit_reference::DecimalError>(())
    /// ```
    ///
    /// # Errors
    /// [`DecimalError::Syntax`].
    pub fn nearest(text: &str) -> Result<f64, DecimalError> {
        Written::read(text)?;
        // Rust's conversion rounds correctly.
        text.trim().parse().map_err(|_| syntax(text))
    }

    /// One unit in the last written digit.
    pub fn unit(&self) -> Rational {
        let ten = Rational::from(Integer::from(10).pow(self.exponent.unsigned_abs()));
        match self.exponent {
            0.. => ten,
            _ => ten.recip(),
        }
    }

    /// `(written − value)` in units of the last written digit; correctly rounded is at most a half.
    pub fn units_off(&self, value: &Ball) -> Ball {
        let bits = value.prec();
        let d = &Ball::rational(bits, &self.value) - value;
        &d / &Ball::rational(bits, &self.unit())
    }
}

impl Ball {
    /// The number with `digits` significant decimal digits, the last of them wrong by at most
    /// 0.51 units; `None` when the radius does not allow that many.
    pub fn to_decimal(&self, digits: usize) -> Option<String> {
        let digits = digits.max(1);
        if self.is_zero() {
            return Some("0".into());
        }
        // One hundredth of a unit in the last digit, bounded below by powers of two:
        // |x| ≥ 2^(e-1), and a digit's unit is at least |x| 10^-digits. Zero has no exponent.
        let e = i64::from(self.mid().get_exp()?) - 1;
        let unit_bits = (digits as f64 + 2.0) * std::f64::consts::LOG2_10;
        if self.rad() > Mag::power_of_two(e - unit_bits.ceil() as i64) {
            return None;
        }
        let text = self
            .mid()
            .to_string_radix_round(10, Some(digits), Round::Nearest);
        Some(plain(&text))
    }

    /// The midpoint with `digits` significant decimal digits, and a bound on the distance from that
    /// decimal to every point of the ball, rounded up to three digits; `None` where there is no
    /// finite bound.
    ///
    /// ```
    /// use mechaudit_reference::Ball;
    /// let third = Ball::integer(128, 3).recip();
    /// let (value, radius) = third.to_decimal_with_radius(5).unwrap();
    /// assert_eq!((value.as_str(), radius.as_str()), ("0.33333", "3.34e-6"));
    /// let half = Ball::exact(64, 0.5).to_decimal_with_radius(3).unwrap();
    /// assert_eq!(half, ("0.500".into(), "0".into()));
    /// ```
    pub fn to_decimal_with_radius(&self, digits: usize) -> Option<(String, String)> {
        if !self.is_finite() {
            return None;
        }
        let text = match self.mid().is_zero() {
            true => "0".into(),
            false => plain(&self.mid().to_string_radix_round(
                10,
                Some(digits.max(1)),
                Round::Nearest,
            )),
        };
        let off = match self.mid().get_exp() {
            // Too long to be written out.
            Some(e) if e.unsigned_abs() > 1 << 16 => half_a_unit(self.mid(), digits.max(1)),
            _ => {
                let written = Decimal::parse(&text).ok()?.value;
                let off = (written - self.mid().to_rational()?).abs();
                Mag::above(&Float::with_val_round(BITS, &off, Round::Up).0)
            }
        };
        let radius = self.rad().add(off);
        let radius = match radius.is_zero() {
            true => "0".into(),
            false => radius
                .to_float()
                .to_string_radix_round(10, Some(3), Round::Up),
        };
        Some((text, radius))
    }

    /// The number with `places` digits after the point, wrong by at most 0.51 units of the last.
    pub fn to_fixed(&self, places: u32) -> Option<String> {
        let hundredths = exact(&Integer::from(10).pow(places + 2));
        if self.rad().mul(Mag::above(&hundredths)) > Mag::from_f64(1.0) {
            return None;
        }
        let scaled = self.mid().to_rational()? * Integer::from(10).pow(places);
        let n = scaled.round().into_numer_denom().0;
        let digits = n.as_abs().to_string();
        Some(with_point(n < 0, &digits, places as usize))
    }

    /// A short, uncertified rendering for people.
    pub fn to_f64(&self) -> f64 {
        self.mid().to_f64()
    }
}

/// The `f64` nearest to a rational number, ties to even.
///
/// Below the normal numbers it is rounded once, to a multiple of 2⁻¹⁰⁷⁴: rounding to 53 bits first
/// would turn what is a little more than half of 2⁻¹⁰⁷⁴ into a tie, and that into zero.
///
/// ```
/// use mechaudit_reference::{Decimal, nearest_f64};
/// let half = Decimal::parse("2.4703282292062327209e-324")?;
/// assert_eq!(nearest_f64(&half.value), 5e-324);
/// # Ok::<(), mechaudit_reference::DecimalError>(())
/// ```
pub fn nearest_f64(q: &Rational) -> f64 {
    // The quotient of two doubles is rounded once, and that of these is a normal number.
    let exact = |n: &Integer| n.to_i64().filter(|n| n.unsigned_abs() <= 1 << 53);
    if let (Some(n), Some(d)) = (exact(q.numer()), exact(q.denom())) {
        return n as f64 / d as f64;
    }
    let (mut x, way) = Float::with_val_round(53, q, Round::Nearest);
    x.subnormalize_ieee_round(way, Round::Nearest);
    x.to_f64()
}

/// An integer of any length as a float.
pub(crate) fn exact(n: &Integer) -> Float {
    Float::with_val(n.significant_bits().max(prec_min()), n)
}

/// Half a unit of the last of `digits` digits of x from above: `10^(1−digits) |x| / 2`.
fn half_a_unit(x: &Float, digits: usize) -> Mag {
    let power = exact(&Integer::from(10).pow(digits as u32 - 1));
    Mag::above(x).shift(-1).div(Mag::below(&power))
}

/// A whole number of that sign and these digits over `10^places`, written out.
///
/// ```
/// use mechaudit_reference::with_point;
/// assert_eq!(with_point(true, "25", 3), "-0.025");
/// ```
pub fn with_point(is_negative: bool, digits: &str, places: usize) -> String {
    let zeros = (places + 1).saturating_sub(digits.len());
    let mut text = String::with_capacity(digits.len() + zeros + 2);
    text.push_str(if is_negative { "-" } else { "" });
    text.extend(std::iter::repeat_n('0', zeros));
    text.push_str(digits);
    if places > 0 {
        text.insert(text.len() - places, '.');
    }
    text
}

/// Turns `1.234e-2` into `0.01234` while the exponent is small; leaves the rest alone.
fn plain(text: &str) -> String {
    let parts = text.split_once('e');
    let parts = parts.and_then(|(mantissa, e)| Some((mantissa, e.parse::<i32>().ok()?)));
    let Some((mantissa, e)) = parts.filter(|(_, e)| (-7..=20).contains(e)) else {
        return text.into();
    };
    let (sign, m) = match mantissa.strip_prefix('-') {
        Some(m) => ("-", m),
        None => ("", mantissa),
    };
    let (whole, fraction) = m.split_once('.').unwrap_or((m, ""));
    let digits = [whole, fraction].concat();
    let point = whole.len() as i32 + e;
    let body = if point <= 0 {
        format!("0.{}{digits}", "0".repeat(-point as usize))
    } else if (point as usize) >= digits.len() {
        format!("{digits}{}", "0".repeat(point as usize - digits.len()))
    } else {
        let (a, b) = digits.split_at(point as usize);
        format!("{a}.{b}")
    };
    format!("{sign}{body}")
}

#[cfg(test)]
mod tests;
