//! Quantities as people write them: a decimal number and a unit. Read exactly.

use mechaudit::reference::class_iii::ExactAngle;
use mechaudit::reference::{Ball, Decimal};
use rug::{Float, Rational};

/// What a quantity is to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Length,
    Angle,
    Mass,
    Inertia,
    Velocity,
    Acceleration,
    AngularVelocity,
    AngularAcceleration,
    Torque,
    Time,
    /// Torque per angular velocity.
    Damping,
    /// Torque per angular velocity squared.
    QuadraticDamping,
}

impl Kind {
    /// Its name and what one might write.
    fn words(self) -> (&'static str, &'static str) {
        match self {
            Kind::Length => ("a length", "cm"),
            Kind::Angle => ("an angle", "deg"),
            Kind::Mass => ("a mass", "kg"),
            Kind::Inertia => ("a moment of inertia", "kg m^2"),
            Kind::Velocity => ("a velocity", "m/s"),
            Kind::Acceleration => ("an acceleration", "m/s^2"),
            Kind::AngularVelocity => ("an angular velocity", "rad/s"),
            Kind::AngularAcceleration => ("an angular acceleration", "rad/s^2"),
            Kind::Torque => ("a torque", "N m"),
            Kind::Time => ("a time", "s"),
            Kind::Damping => ("a viscous resistance", "N m s"),
            Kind::QuadraticDamping => ("a quadratic resistance", "N m s^2"),
        }
    }

    /// Powers of metre, kilogram, second and angle.
    fn dimension(self) -> [i32; 4] {
        match self {
            Kind::Length => [1, 0, 0, 0],
            Kind::Angle => [0, 0, 0, 1],
            Kind::Mass => [0, 1, 0, 0],
            Kind::Inertia => [2, 1, 0, 0],
            Kind::Velocity => [1, 0, -1, 0],
            Kind::Acceleration => [1, 0, -2, 0],
            Kind::AngularVelocity => [0, 0, -1, 1],
            Kind::AngularAcceleration => [0, 0, -2, 1],
            Kind::Torque => [2, 1, -2, 0],
            Kind::Time => [0, 0, 1, 0],
            Kind::Damping => [2, 1, -1, 0],
            Kind::QuadraticDamping => [2, 1, 0, 0],
        }
    }
}

/// A quantity, exact: in SI units, an angle or its derivatives in degrees if so written.
#[derive(Clone, Debug, PartialEq)]
pub struct Quantity {
    pub value: Rational,
    pub degrees: bool,
}

/// A unit, exact: in SI units, of angles in degrees if so meant.
pub struct Unit {
    pub scale: Rational,
    /// Powers of metre, kilogram, second and angle.
    pub dimension: [i32; 4],
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
pub fn unit(text: &str) -> Result<Unit, String> {
    // As shaft speeds are written: revolutions.
    let compact: String = text.split_whitespace().collect();
    if let ("1/min" | "/min" | "min^-1" | "min⁻¹", Some(rpm)) = (&*compact, base("rpm")) {
        return Ok(rpm);
    }
    if compact.is_empty() {
        return Err("an empty unit".into());
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
    let mut sign = 1;
    for (k, token) in spaced.split_whitespace().enumerate() {
        if k == MOST_UNITS {
            return Err(format!("a product of more than {MOST_UNITS} units"));
        }
        if token == "/" {
            sign = -1;
            continue;
        }
        let (name, power) = token.split_once('^').unwrap_or((token, "1"));
        let power = match power.parse::<i32>() {
            Ok(p) if (-4..=4).contains(&p) => p * sign,
            _ => return Err(format!("{token:?} is not a power of a unit")),
        };
        let one = base(name).ok_or_else(|| match name {
            "1" => "of frequencies 1/min and Hz are known".into(),
            _ => format!("{name:?} is not a unit known here"),
        })?;
        for (d, k) in all.dimension.iter_mut().zip(one.dimension) {
            *d += power * k;
        }
        for _ in 0..power.abs() {
            if power > 0 {
                all.scale *= &one.scale;
            } else {
                all.scale /= &one.scale;
            }
        }
        all.degrees |= one.degrees;
        sign = 1;
    }
    Ok(all)
}

impl Quantity {
    /// Reads `text`, which names its unit, as a quantity of the kind.
    pub fn parse(kind: Kind, text: &str) -> Result<Quantity, String> {
        let text = text.trim();
        let (what, example) = kind.words();
        let end = text
            .char_indices()
            .find(|&(i, c)| !is_number_part(text, i, c))
            .map_or(text.len(), |(i, _)| i);
        let (number, name) = (text[..end].trim(), text[end..].trim());
        let number = Decimal::parse(number).map_err(|_| {
            format!("{text:?} does not begin with a decimal number; write for instance \"12.5 {example}\"")
        })?;
        if name.is_empty() {
            return Err(format!(
                "{text:?} has no unit; for {what} write for instance \"{text} {example}\""
            ));
        }
        let unit = unit(name)
            .map_err(|e| format!("{text:?}: {e}; {what} is due, for instance in {example}"))?;
        if unit.dimension != kind.dimension() {
            return Err(format!(
                "{text:?} is not {what}; write it for instance in {example}"
            ));
        }
        Ok(Quantity {
            value: number.value * unit.scale,
            degrees: unit.degrees,
        })
    }

    /// A quantity in SI units.
    pub fn si(value: Rational) -> Quantity {
        Quantity {
            value,
            degrees: false,
        }
    }

    /// The nearest floating-point number, in SI units (radians).
    pub fn to_f64(&self) -> f64 {
        let x = nearest(&self.value);
        if self.degrees { x.to_radians() } else { x }
    }

    /// An angle, exact.
    pub fn exact_angle(&self) -> ExactAngle {
        match self.degrees {
            true => ExactAngle::Degrees(self.value.clone()),
            false => ExactAngle::Radians(self.value.clone()),
        }
    }

    /// In SI units (radians), enclosed.
    pub fn to_ball(&self, bits: u32) -> Ball {
        self.exact_angle().to_ball(bits)
    }
}

/// The floating-point number nearest to a rational one.
pub fn nearest(q: &Rational) -> f64 {
    Float::with_val(53, q).to_f64()
}

/// Whether the character belongs to the number: digits, sign, point, and an exponent's letter if
/// digits follow it.
fn is_number_part(text: &str, i: usize, c: char) -> bool {
    let after = text[i + c.len_utf8()..].trim_start_matches(['+', '-']);
    match c {
        '0'..='9' | '.' | '+' | '-' => true,
        'e' | 'E' => i > 0 && after.starts_with(|d: char| d.is_ascii_digit()),
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn si(kind: Kind, text: &str) -> Rational {
        Quantity::parse(kind, text).unwrap().value
    }

    #[test]
    fn quantities_are_exact() {
        assert_eq!(si(Kind::Length, "48.5 cm"), Rational::from((485, 1000)));
        assert_eq!(si(Kind::Length, "48.5cm"), Rational::from((485, 1000)));
        assert_eq!(si(Kind::Length, "-1.5e1 mm"), Rational::from((-15, 1000)));
        assert_eq!(si(Kind::Length, "2 in"), Rational::from((508, 10_000)));
        assert_eq!(si(Kind::Inertia, "20 kg cm^2"), Rational::from((2, 1000)));
        assert_eq!(si(Kind::Inertia, "20 kg·m²"), 20);
        assert_eq!(
            si(Kind::Inertia, "3 g*mm^2"),
            Rational::from((3, 1_000_000_000u64))
        );
        assert_eq!(
            si(Kind::Acceleration, "981 cm/s^2"),
            Rational::from((981, 100))
        );
        assert_eq!(si(Kind::Torque, "2.5 kN cm"), 25);
        assert_eq!(si(Kind::Torque, "3 N·m"), 3);
        assert_eq!(si(Kind::Damping, "3 N m s"), 3);
        assert_eq!(si(Kind::Time, "5 ms"), Rational::from((5, 1000)));
        assert_eq!(si(Kind::AngularVelocity, "60 rpm"), 360);
        assert_eq!(si(Kind::AngularVelocity, "2 rev/min"), 12);
        assert_eq!(si(Kind::AngularVelocity, "50 Hz"), 18_000);
        for frequency in [
            "1500 1/min",
            "1500/min",
            "1500 min^-1",
            "1500 min⁻¹",
            "25 Hz",
            "1500 rpm",
        ] {
            assert_eq!(si(Kind::AngularVelocity, frequency), 9000, "{frequency}");
        }
        for small in ["5 µm", "5 μm", "5 um", "5μm"] {
            assert_eq!(si(Kind::Length, small), Rational::from((5, 1_000_000)));
        }
        assert_eq!(si(Kind::Length, "2 inch"), Rational::from((508, 10_000)));
        let q = Quantity::parse(Kind::Angle, "-39.3 deg").unwrap();
        assert!(q.degrees && q.value == Rational::from((-393, 10)));
        assert_eq!(q.to_f64(), (-39.3f64).to_radians());
        assert_eq!(si(Kind::Mass, "0.1 kg"), Rational::from((1, 10)));
        assert_eq!(nearest(&si(Kind::Mass, "0.1 kg")), 0.1);
    }

    #[test]
    fn the_list_of_units_is_right() {
        for name in KNOWN.split(' ') {
            assert!(unit(name).is_ok(), "{name}");
        }
    }

    #[test]
    fn refusals_say_what_to_write() {
        let long = format!("1 {}", "in^4 ".repeat(200_000));
        let e = Quantity::parse(Kind::Length, &long).unwrap_err();
        assert!(e.contains("more than 16 units"));
        for (kind, text, part) in [
            (Kind::Length, "10", "write for instance \"10 cm\""),
            (Kind::Length, "10 kg", "is not a length"),
            (Kind::Length, "10 furlong", "\"furlong\" is not a unit"),
            (Kind::Length, "nan m", "decimal number"),
            (Kind::Length, "inf m", "decimal number"),
            (Kind::Length, "", "decimal number"),
            (Kind::Length, "1,5 cm", "not a unit"),
            (Kind::Inertia, "18 kg m", "is not a moment of inertia"),
            (Kind::Inertia, "18 kg m^x", "power"),
            (Kind::Angle, "1 rad/s", "is not an angle"),
            (Kind::Mass, "1e999999 kg", "decimal number"),
            (Kind::AngularVelocity, "5 1/s", "1/min and Hz are known"),
        ] {
            let e = Quantity::parse(kind, text).unwrap_err();
            assert!(e.contains(part), "{text}: {e}");
            assert!(!e.contains('\n'));
        }
    }
}
