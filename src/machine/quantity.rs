//! Quantities as people write them: a decimal number and a unit. Read exactly.
//!
//! The type says what is measured, so a mass cannot be read where a length is due:
//!
//! ```
//! use mechaudit_cli::machine::quantity::Quantity;
//! use mechaudit::solvers::units::Length;
//! let l: Quantity<Length> = "48.5 cm".parse()?;
//! assert_eq!(l.value, rug::Rational::from((485, 1000)));
//! assert_eq!(l.to_f64(), 0.485);
//! let e = "48.5 kg".parse::<Quantity<Length>>().unwrap_err();
//! assert_eq!(e.to_string(), "\"48.5 kg\" is not a length; write it for instance in cm");
//! # Ok::<(), mechaudit_cli::machine::quantity::QuantityError>(())
//! ```

use crate::reference::class_iii::ExactAngle;
use crate::reference::{Ball, Decimal, DecimalError, nearest_f64};
use crate::solvers::units::{Acceleration, Angle, AngularVelocity, Inertia, Length, Mass, Torque};
use rug::Rational;
use rug::ops::Pow;
use serde::de::{self, Deserialize, Deserializer, Visitor};
use std::error::Error;
use std::fmt;
use std::marker::PhantomData;
use std::str::FromStr;

/// A measured quantity.
pub trait Dimension {
    /// With its article, as in "a length".
    const NAME: &'static str;
    /// A unit that one might write.
    const EXAMPLE: &'static str;
    /// Powers of metre, kilogram, second and angle.
    const POWERS: [i32; 4];
}

macro_rules! dimensions {
    ($($type:ident: $name:literal, $example:literal, $powers:expr;)*) => {
        $(impl Dimension for $type {
            const NAME: &'static str = $name;
            const EXAMPLE: &'static str = $example;
            const POWERS: [i32; 4] = $powers;
        })*
    };
}

/// The dimension of a point's velocity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Velocity {}
/// The dimension of an angular acceleration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AngularAcceleration {}
/// The dimension of a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Time {}
/// The dimension of a torque per angular velocity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ViscousResistance {}
/// The dimension of a force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Force {}
/// The dimension of a force per length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stiffness {}
/// The dimension of a torque per angle, radians only.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TorsionalStiffness {}
/// The dimension of a force per velocity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Damping {}
/// The dimension of a torque per angular velocity squared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum QuadraticResistance {}

dimensions! {
    Length: "a length", "cm", [1, 0, 0, 0];
    Angle: "an angle", "deg", [0, 0, 0, 1];
    Mass: "a mass", "kg", [0, 1, 0, 0];
    Inertia: "a moment of inertia", "kg m^2", [2, 1, 0, 0];
    Velocity: "a velocity", "m/s", [1, 0, -1, 0];
    Acceleration: "an acceleration", "m/s^2", [1, 0, -2, 0];
    AngularVelocity: "an angular velocity", "rad/s", [0, 0, -1, 1];
    AngularAcceleration: "an angular acceleration", "rad/s^2", [0, 0, -2, 1];
    Torque: "a torque", "N m", [2, 1, -2, 0];
    Time: "a time", "s", [0, 0, 1, 0];
    ViscousResistance: "a viscous resistance", "N m s", [2, 1, -1, 0];
    Force: "a force", "N", [1, 1, -2, 0];
    Stiffness: "a stiffness", "N/m", [0, 1, -2, 0];
    TorsionalStiffness: "a torsional stiffness", "N m/rad", [2, 1, -2, -1];
    Damping: "a damping", "N s/m", [0, 1, -1, 0];
    QuadraticResistance: "a quadratic resistance", "N m s^2", [2, 1, 0, 0];
}

/// A quantity, exact: in SI units, an angle or its derivatives in degrees if so written.
#[derive(Clone, Debug, PartialEq)]
pub struct Quantity<D> {
    /// The value.
    pub value: Rational,
    /// True if the value is in degrees.
    pub degrees: bool,
    dimension: PhantomData<D>,
}

/// A text is not the quantity that is due.
#[derive(Clone, Debug, PartialEq)]
pub struct QuantityError {
    /// The text.
    pub text: String,
    /// The value and unit that are expected.
    pub name: &'static str,
    /// A unit that is possible.
    pub example: &'static str,
    /// The fault.
    pub reason: QuantityReason,
}

/// The fault of a text that is to be a quantity.
#[derive(Clone, Debug, PartialEq)]
pub enum QuantityReason {
    /// It does not begin with a number.
    Number(DecimalError),
    /// It is a number alone.
    NoUnit,
    /// Its unit cannot be read.
    Unit(UnitError),
    /// Its unit measures something else.
    Dimension,
}

impl fmt::Display for QuantityError {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let QuantityError {
            text,
            name,
            example,
            reason,
        } = self;
        match reason {
            QuantityReason::Number(_) => write!(
                f,
                "{text:?} does not begin with a decimal number; write for instance \"12.5 {example}\""
            ),
            QuantityReason::NoUnit => write!(
                f,
                "{text:?} has no unit; for {name} write for instance \"{text} {example}\""
            ),
            QuantityReason::Unit(e) => {
                write!(f, "{text:?}: {e}; {name} is due, for instance in {example}")
            }
            QuantityReason::Dimension => {
                write!(
                    f,
                    "{text:?} is not {name}; write it for instance in {example}"
                )
            }
        }
    }
}

impl Error for QuantityError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        match &self.reason {
            QuantityReason::Number(e) => Some(e),
            QuantityReason::Unit(e) => Some(e),
            QuantityReason::NoUnit | QuantityReason::Dimension => None,
        }
    }
}

/// Why a text is not a unit.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum UnitError {
    /// Nothing is written.
    #[error("an empty unit")]
    Empty,
    /// Every factor makes the scale longer, and no quantity has as many.
    #[error("a product of more than {MOST_UNITS} units")]
    TooMany,
    /// Something else than a power from −4 to 4.
    #[error("{factor:?} is not a power of a unit")]
    Power {
        /// The factor.
        factor: String,
    },
    /// A frequency in other units than Hz and 1/min.
    #[error("of frequencies 1/min and Hz are known")]
    Frequency,
    /// None of [`KNOWN`].
    #[error("{name:?} is not a unit known here")]
    Unknown {
        /// The name.
        name: String,
    },
}

/// A unit, exact.
#[derive(Clone, Debug, PartialEq)]
pub struct Unit {
    /// Its size in SI units, of angles in degrees if so meant.
    pub scale: Rational,
    /// Powers of metre, kilogram, second and angle.
    pub dimension: [i32; 4],
    /// True if its size is in degrees.
    pub degrees: bool,
}

/// The units known by name.
pub const KNOWN: &str =
    "m dm cm mm um µm in inch ft kg g t lb N kN s ms min rad deg ° rev rpm Hz 1/min";

fn base(name: &str) -> Option<Unit> {
    let unit = |n: u64, d: u64, dimension| {
        Some(Unit {
            scale: Rational::from((n, d)),
            dimension,
            degrees: false,
        })
    };
    let degrees = |n: u64, dimension| {
        Some(Unit {
            scale: Rational::from(n),
            dimension,
            degrees: true,
        })
    };
    match name {
        "m" => unit(1, 1, [1, 0, 0, 0]),
        "dm" => unit(1, 10, [1, 0, 0, 0]),
        "cm" => unit(1, 100, [1, 0, 0, 0]),
        "mm" => unit(1, 1000, [1, 0, 0, 0]),
        // Both code points that keyboards have for µ.
        "um" | "µm" | "μm" => unit(1, 1_000_000, [1, 0, 0, 0]),
        "in" | "inch" => unit(254, 10_000, [1, 0, 0, 0]),
        "ft" => unit(3048, 10_000, [1, 0, 0, 0]),
        "kg" => unit(1, 1, [0, 1, 0, 0]),
        "g" => unit(1, 1000, [0, 1, 0, 0]),
        "t" => unit(1000, 1, [0, 1, 0, 0]),
        "lb" => unit(45_359_237, 100_000_000, [0, 1, 0, 0]),
        "N" => unit(1, 1, [1, 1, -2, 0]),
        "kN" => unit(1000, 1, [1, 1, -2, 0]),
        "s" => unit(1, 1, [0, 0, 1, 0]),
        "ms" => unit(1, 1000, [0, 0, 1, 0]),
        "min" => unit(60, 1, [0, 0, 1, 0]),
        "rad" => unit(1, 1, [0, 0, 0, 1]),
        "deg" | "°" => degrees(1, [0, 0, 0, 1]),
        "rev" => degrees(360, [0, 0, 0, 1]),
        "rpm" => degrees(6, [0, 0, -1, 1]),
        // Revolutions or cycles a second.
        "Hz" => degrees(360, [0, 0, -1, 1]),
        _ => None,
    }
}

/// Units in a product at most: no quantity has more, and every one makes the scale longer.
const MOST_UNITS: usize = 16;

/// Reads a product of units such as `kg m^2`, `kg·m²` or `m/s^2`.
///
/// # Errors
/// [`UnitError`].
pub fn unit(text: &str) -> Result<Unit, UnitError> {
    // As shaft speeds are written: revolutions.
    let compact: String = text.split_whitespace().collect();
    if let ("1/min" | "/min" | "min^-1" | "min⁻¹", Some(rpm)) = (&*compact, base("rpm")) {
        return Ok(rpm);
    }
    if compact.is_empty() {
        return Err(UnitError::Empty);
    }
    let mut all = Unit {
        scale: Rational::from(1),
        dimension: [0; 4],
        degrees: false,
    };
    let spaced = text
        .replace(['*', '·'], " ")
        .replace('/', " / ")
        .replace('²', "^2");
    let mut divided = false;
    for (k, token) in spaced.split_whitespace().enumerate() {
        if k == MOST_UNITS {
            return Err(UnitError::TooMany);
        }
        if token == "/" {
            divided = true;
            continue;
        }
        let (name, power) = token.split_once('^').unwrap_or((token, "1"));
        let power = match power.parse::<i32>() {
            Ok(p) if (-4..=4).contains(&p) => {
                if divided {
                    -p
                } else {
                    p
                }
            }
            _ => {
                return Err(UnitError::Power {
                    factor: token.into(),
                });
            }
        };
        let one = base(name).ok_or_else(|| match name {
            "1" => UnitError::Frequency,
            _ => UnitError::Unknown { name: name.into() },
        })?;
        for (d, k) in all.dimension.iter_mut().zip(one.dimension) {
            *d += power * k;
        }
        all.scale *= one.scale.pow(power);
        all.degrees |= one.degrees;
        divided = false;
    }
    Ok(all)
}

impl<D: Dimension> FromStr for Quantity<D> {
    type Err = QuantityError;

    /// Reads a number with its unit.
    fn from_str(text: &str) -> Result<Quantity<D>, QuantityError> {
        let text = text.trim();
        let refused = |reason| QuantityError {
            text: text.into(),
            name: D::NAME,
            example: D::EXAMPLE,
            reason,
        };
        let end = text
            .char_indices()
            .find(|&(i, c)| !is_number_part(text, i, c))
            .map_or(text.len(), |(i, _)| i);
        let (number, symbol) = (text[..end].trim(), text[end..].trim());
        let number = Decimal::parse(number).map_err(|e| refused(QuantityReason::Number(e)))?;
        if symbol.is_empty() {
            return Err(refused(QuantityReason::NoUnit));
        }
        let unit = unit(symbol).map_err(|e| refused(QuantityReason::Unit(e)))?;
        if unit.dimension != D::POWERS {
            return Err(refused(QuantityReason::Dimension));
        }
        Ok(Quantity {
            value: number.value * unit.scale,
            degrees: unit.degrees,
            dimension: PhantomData,
        })
    }
}

impl<'de, D: Dimension> Deserialize<'de> for Quantity<D> {
    fn deserialize<T: Deserializer<'de>>(from: T) -> Result<Quantity<D>, T::Error> {
        from.deserialize_any(Written(str::parse))
    }
}

/// Visits a string; a bare number is refused as one without a unit.
pub(super) struct Written<F>(pub F);

impl<T, E: fmt::Display, F: FnOnce(&str) -> Result<T, E>> Visitor<'_> for Written<F> {
    type Value = T;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a string with a number and its unit")
    }
    fn visit_str<R: de::Error>(self, text: &str) -> Result<T, R> {
        self.0(text).map_err(R::custom)
    }
    fn visit_i64<R: de::Error>(self, n: i64) -> Result<T, R> {
        self.visit_str(&n.to_string())
    }
    fn visit_u64<R: de::Error>(self, n: u64) -> Result<T, R> {
        self.visit_str(&n.to_string())
    }
    fn visit_f64<R: de::Error>(self, x: f64) -> Result<T, R> {
        self.visit_str(&x.to_string())
    }
}

impl<D> Quantity<D> {
    /// A quantity in SI units.
    pub fn si(value: Rational) -> Quantity<D> {
        Quantity {
            value,
            degrees: false,
            dimension: PhantomData,
        }
    }

    /// The nearest floating-point number in SI units; radians as `f64::to_radians` rounds the
    /// nearest number of degrees.
    pub fn to_f64(&self) -> f64 {
        let x = nearest_f64(&self.value);
        if self.degrees { x.to_radians() } else { x }
    }

    /// In SI units (radians), enclosed.
    pub fn to_ball(&self, bits: u32) -> Ball {
        let value = self.value.clone();
        match self.degrees {
            true => ExactAngle::Degrees(value).to_ball(bits),
            false => ExactAngle::Radians(value).to_ball(bits),
        }
    }
}

impl Quantity<Angle> {
    /// The angle, exact.
    pub fn exact_angle(&self) -> ExactAngle {
        match self.degrees {
            true => ExactAngle::Degrees(self.value.clone()),
            false => ExactAngle::Radians(self.value.clone()),
        }
    }

    /// In degrees; one given in radians is rounded.
    pub fn in_degrees(&self) -> Option<Rational> {
        match self.degrees {
            true => Some(self.value.clone()),
            false => Rational::from_f64(self.to_f64().to_degrees()),
        }
    }

    /// In turns; one given in degrees is divided exactly.
    pub fn in_turns(&self) -> f64 {
        match self.degrees {
            true => nearest_f64(&(self.value.clone() / 360u32)),
            false => self.to_f64() / std::f64::consts::TAU,
        }
    }
}

/// Returns true if the character belongs to the number: digits, sign, point, and an exponent's
/// letter if digits follow it.
fn is_number_part(text: &str, i: usize, c: char) -> bool {
    let after = text[i + c.len_utf8()..].trim_start_matches(['+', '-']);
    match c {
        '0'..='9' | '.' | '+' | '-' => true,
        'e' | 'E' => after.starts_with(|d: char| d.is_ascii_digit()),
        _ => false,
    }
}

#[cfg(test)]
mod tests;
