//! Units of measurement as people write them, read exactly.
//!
//! ```
//! use mechaudit_symbolic::unit;
//! let inertia = unit("kg cm^2")?;
//! assert_eq!(inertia.scale, rug::Rational::from((1, 10_000)));
//! assert_eq!(inertia.dimension[..3], [2, 1, 0]);
//! assert_eq!(unit("furlong").unwrap_err().to_string(), "\"furlong\" is not a unit known here");
//! # Ok::<(), mechaudit_symbolic::UnitError>(())
//! ```

use rug::Rational;
use rug::ops::Pow;

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
    /// Neither one of [`KNOWN_UNITS`] nor an SI unit with a prefix.
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
    /// Powers of metre, kilogram, second, angle, ampere, kelvin, mole and candela.
    pub dimension: [i32; 8],
    /// True if its size is in degrees.
    pub degrees: bool,
}

/// The units known by name. Those of the SI may have a prefix from p (pico) to T (tera).
pub const KNOWN_UNITS: &str = "m dm cm mm um µm in inch ft kg g t lb N kN s ms min rad deg ° rev rpm Hz 1/min \
                               h Pa bar J W A C V K mol cd 1 %";

/// Size as a quotient, powers of metre, kilogram, second and angle, true if in degrees.
type Named = ((u64, u64), [i32; 4], bool);

const LENGTH: [i32; 4] = [1, 0, 0, 0];
const MASS: [i32; 4] = [0, 1, 0, 0];
const TIME: [i32; 4] = [0, 0, 1, 0];
const ANGLE: [i32; 4] = [0, 0, 0, 1];
const RATE: [i32; 4] = [0, 0, -1, 1];

/// Units of the SI that take prefixes; the electrical ones and those of heat and light stand in
/// [`beyond_mechanics`].
fn of_si(name: &str) -> Option<Named> {
    Some(match name {
        "m" => ((1, 1), LENGTH, false),
        "g" => ((1, 1000), MASS, false),
        "N" => ((1, 1), [1, 1, -2, 0], false),
        "Pa" => ((1, 1), [-1, 1, -2, 0], false),
        "J" => ((1, 1), [2, 1, -2, 0], false),
        "W" => ((1, 1), [2, 1, -3, 0], false),
        "s" => ((1, 1), TIME, false),
        "rad" => ((1, 1), ANGLE, false),
        // Revolutions or cycles a second.
        "Hz" => ((360, 1), RATE, true),
        _ => return None,
    })
}

/// Powers of metre, kilogram, second, angle, ampere, kelvin, mole and candela.
fn beyond_mechanics(name: &str) -> Option<[i32; 8]> {
    Some(match name {
        "A" => [0, 0, 0, 0, 1, 0, 0, 0],
        "C" => [0, 0, 1, 0, 1, 0, 0, 0],
        "V" => [2, 1, -3, 0, -1, 0, 0, 0],
        "K" => [0, 0, 0, 0, 0, 1, 0, 0],
        "mol" => [0, 0, 0, 0, 0, 0, 1, 0],
        "cd" => [0, 0, 0, 0, 0, 0, 0, 1],
        _ => return None,
    })
}

/// Units that take no prefix.
fn alone(name: &str) -> Option<Named> {
    Some(match name {
        "in" | "inch" => ((254, 10_000), LENGTH, false),
        "ft" => ((3048, 10_000), LENGTH, false),
        "t" => ((1000, 1), MASS, false),
        "lb" => ((45_359_237, 100_000_000), MASS, false),
        "min" => ((60, 1), TIME, false),
        "h" => ((3600, 1), TIME, false),
        "bar" => ((100_000, 1), [-1, 1, -2, 0], false),
        "deg" | "°" => ((1, 1), ANGLE, true),
        "rev" => ((360, 1), ANGLE, true),
        "rpm" => ((6, 1), RATE, true),
        "1" => ((1, 1), [0; 4], false),
        "%" => ((1, 100), [0; 4], false),
        _ => return None,
    })
}

/// Prefixes with their powers of ten; both code points that keyboards have for µ.
const PREFIXES: [(&str, i32); 12] = [
    ("p", -12),
    ("n", -9),
    ("u", -6),
    ("µ", -6),
    ("μ", -6),
    ("m", -3),
    ("c", -2),
    ("d", -1),
    ("k", 3),
    ("M", 6),
    ("G", 9),
    ("T", 12),
];

fn base(name: &str) -> Option<Unit> {
    let of = |((above, below), [m, kg, s, angle], degrees): Named| Unit {
        scale: Rational::from((above, below)),
        dimension: [m, kg, s, angle, 0, 0, 0, 0],
        degrees,
    };
    let with_prefix = |name: &str| {
        let other = |dimension| Unit {
            scale: Rational::from(1),
            dimension,
            degrees: false,
        };
        of_si(name)
            .map(of)
            .or_else(|| beyond_mechanics(name).map(other))
    };
    if let Some(found) = alone(name).map(of).or_else(|| with_prefix(name)) {
        return Some(found);
    }
    let (rest, power) = PREFIXES
        .iter()
        .find_map(|(prefix, power)| Some((name.strip_prefix(prefix)?, *power)))?;
    let mut found = with_prefix(rest)?;
    found.scale *= Rational::from(10).pow(power);
    Some(found)
}

/// Units in a product at most: no quantity has more, and every one makes the scale longer.
const MOST_UNITS: usize = 16;

/// Reads a product of units such as `kg m^2`, `kg·m²` or `m/s^2`. A stroke divides by the next
/// factor alone.
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
        dimension: [0; 8],
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
        let one = base(name).ok_or_else(|| UnitError::Unknown { name: name.into() })?;
        for (d, k) in all.dimension.iter_mut().zip(one.dimension) {
            *d += power * k;
        }
        all.scale *= one.scale.pow(power);
        all.degrees |= one.degrees;
        divided = false;
    }
    Ok(all)
}

#[cfg(test)]
mod tests;
