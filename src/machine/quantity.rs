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
use crate::symbolic::{UnitError, unit};
use rug::Rational;
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
        let [m, kg, s, angle] = D::POWERS;
        if unit.dimension != [m, kg, s, angle, 0, 0, 0, 0] {
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
