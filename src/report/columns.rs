//! Columns of rows: names that carry their units, and other units on request.

use super::cell::Cell;
use crate::symbolic::{self, Unit};
use rug::Rational;
use std::borrow::Cow;

/// The factor of a column's values.
#[derive(Clone, Debug, PartialEq)]
struct Scale {
    by: Rational,
    /// With powers of 180/π.
    degrees: i32,
}

/// Units that columns cannot be in, with the reason.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct UnitsError(String);

/// Names of columns, and how their values come to be in these units.
pub struct Columns {
    /// With their units.
    pub names: Vec<String>,
    scales: Vec<Option<Scale>>,
    parts: Vec<Parts>,
}

/// A column's name without its unit, and the factors of that unit.
type Parts = (String, Vec<(String, i32)>);

impl From<Vec<String>> for Columns {
    fn from(names: Vec<String>) -> Columns {
        let scales = vec![None; names.len()];
        let owned = |(s, p): &(&str, i32)| (s.to_string(), *p);
        let part = |name: &String| {
            let (stem, factors) = split(name);
            (stem, factors.iter().map(owned).collect())
        };
        let parts = names.iter().map(part).collect();
        Columns {
            names,
            scales,
            parts,
        }
    }
}

/// A unit asked for: what stands in a column's name, and its size.
struct Wanted<'a> {
    text: &'a str,
    label: String,
    unit: Unit,
}

/// Units that columns are in; a column's name ends with a product of them.
const SYMBOLS: [&str; 7] = ["m", "kg", "s", "rad", "deg", "N", "J"];
const SPEED: [i32; 8] = [0, 0, -1, 1, 0, 0, 0, 0];

/// A column's name without its unit, and the factors of that unit.
fn split(name: &str) -> (String, Vec<(&'static str, i32)>) {
    let mut rest: Vec<&str> = name.split('_').collect();
    let mut factors: Vec<(&'static str, i32)> = Vec::new();
    while rest.len() > 1 {
        let last = rest[rest.len() - 1];
        if last == "per" {
            factors.iter_mut().for_each(|f| f.1 = -f.1);
            rest.pop();
            continue;
        }
        let symbol = last.trim_end_matches(|c: char| c.is_ascii_digit());
        let power = match &last[symbol.len()..] {
            "" => Some(1),
            digits => digits.parse().ok(),
        };
        let known = SYMBOLS.iter().find(|s| **s == symbol);
        match known.zip(power) {
            // J is also the Jacobian; as a unit it stands alone.
            Some((s, _)) if *s == "J" && !factors.is_empty() => break,
            Some((s, p)) => factors.insert(0, (s, p)),
            None => break,
        }
        rest.pop();
    }
    (rest.join("_"), factors)
}

/// A column's name with such a unit.
fn joined(stem: &str, factors: &[(String, i32)]) -> String {
    let part = |sign: i32| -> Vec<String> {
        let of = factors.iter().filter(|f| f.1.signum() == sign);
        of.map(|(s, p)| match p.abs() {
            1 => s.clone(),
            p => format!("{s}{p}"),
        })
        .collect()
    };
    let (over, under) = (part(1), part(-1));
    let mut all = vec![stem.to_string()];
    all.extend(over);
    if !under.is_empty() {
        all.push("per".into());
        all.extend(under);
    }
    all.join("_")
}

impl Wanted<'_> {
    fn read(text: &str) -> Result<Wanted<'_>, UnitsError> {
        let known = symbolic::KNOWN_UNITS;
        let unit =
            symbolic::unit(text).map_err(|e| UnitsError(format!("{e}; there are {known}")))?;
        let label = match text {
            "°" => "deg".into(),
            "µm" | "μm" => "um".into(),
            "/min" | "min^-1" | "min⁻¹" => "1_per_min".into(),
            _ => text.replace('/', "_per_"),
        };
        let word = |c: char| c.is_ascii_alphabetic();
        let good = match unit.dimension {
            SPEED => label.chars().all(|c| word(c) || matches!(c, '_' | '1')),
            // A unit whose name is letters alone is in [`SYMBOLS`] by other sizes.
            _ => label.chars().all(word),
        };
        if !good {
            return Err(UnitsError(format!(
                "{text:?} is a product; write its factors, for instance mm,deg,rpm"
            )));
        }
        Ok(Wanted { text, label, unit })
    }

    /// The same values in this unit to that power instead of the symbol's.
    fn scale(&self, symbol: &str, power: i32) -> Scale {
        let mut by = Rational::from(1);
        for _ in 0..power.abs() {
            match power > 0 {
                true => by /= &self.unit.scale,
                false => by *= &self.unit.scale,
            }
        }
        let degrees = match (symbol, self.unit.degrees) {
            ("rad", true) => power,
            ("deg", false) => -power,
            _ => 0,
        };
        Scale { by, degrees }
    }
}

/// Returns true if one of the columns is a length or has one among its factors.
pub fn any_length(names: &[String]) -> bool {
    let length = |name: &String| split(name).1.iter().any(|f| f.0 == "m");
    names.iter().any(length)
}

/// Returns true if a column is an angle.
pub fn is_angle(name: &str) -> bool {
    matches!(split(name).1[..], [("rad" | "deg", 1)])
}

fn dimension(symbol: &str) -> Option<[i32; 8]> {
    match symbol {
        // No unit of energy is known by name.
        "J" => None,
        s => symbolic::unit(s).ok().map(|u| u.dimension),
    }
}

impl Columns {
    /// These columns in the units asked for. Refuses a unit that no column can use and, of
    /// `certified` decimals, a factor that is no power of ten.
    pub fn of(
        names: Vec<String>,
        units: &[String],
        certified: bool,
    ) -> Result<Columns, UnitsError> {
        let mut columns = Columns::from(names);
        let wanted: Vec<Wanted> = units
            .iter()
            .map(|u| Wanted::read(u.trim()))
            .collect::<Result<_, _>>()?;
        for (k, w) in wanted.iter().enumerate() {
            let same = |v: &&Wanted| v.unit.dimension == w.unit.dimension;
            if let Some(other) = wanted[..k].iter().find(same) {
                let (a, b) = (other.text, w.text);
                let text = format!("{a} and {b} measure the same: leave one out");
                return Err(UnitsError(text));
            }
        }
        let own = columns.names.join(", ");
        let mut used = vec![false; wanted.len()];
        let rows = columns.names.iter_mut().zip(&mut columns.scales);
        for ((name, scale), parts) in rows.zip(&mut columns.parts) {
            let (in_unit, by) = one(name, &wanted, &mut used);
            let new = joined(&in_unit.0, &in_unit.1);
            *parts = in_unit;
            if let (true, Some(by)) = (certified, &by)
                && power_of_ten(by).is_none()
            {
                return Err(UnitsError(format!(
                    "from {name} to {new} is no power of ten, so certified digits would \
                     be lost: leave out --digits or the unit"
                )));
            }
            (*name, *scale) = (new, by);
        }
        match used.iter().position(|u| !u) {
            None => Ok(columns),
            Some(k) => Err(UnitsError(format!(
                "no column can be in {}; the columns are {own}",
                wanted[k].text
            ))),
        }
    }

    /// The column's name without its unit.
    pub fn stem(&self, column: usize) -> &str {
        &self.parts[column].0
    }

    /// The column's unit as people write it.
    pub fn unit(&self, column: usize) -> String {
        let factors = &self.parts[column].1;
        let part = |sign: i32| {
            let of = factors.iter().filter(|f| f.1.signum() == sign);
            let texts = of.map(|(s, p)| match p.abs() {
                1 if s == "deg" => "°".into(),
                1 => s.replace("1_per_", "1/"),
                2 => format!("{s}²"),
                p => format!("{s}^{p}"),
            });
            texts.collect::<Vec<String>>().join("·")
        };
        match (part(1), part(-1)) {
            (over, under) if under.is_empty() => over,
            (over, under) if over.is_empty() => format!("1/{under}"),
            (over, under) => format!("{over}/{under}"),
        }
    }

    /// A number in the column's unit.
    pub fn value(&self, column: usize, x: f64) -> f64 {
        self.scales[column].as_ref().map_or(x, |s| s.apply(x))
    }

    /// A row's value in the column's unit.
    pub fn cell<'a>(&self, column: usize, cell: &'a Cell) -> Cow<'a, Cell> {
        let Some(Some(scale)) = self.scales.get(column) else {
            return Cow::Borrowed(cell);
        };
        Cow::Owned(match cell {
            Cell::Float(x) => Cell::Float(scale.apply(*x)),
            Cell::Decimal(d) => match power_of_ten(scale) {
                Some(places) => Cell::Decimal(shifted(d, places)),
                None => Cell::Undecided,
            },
            other => return Cow::Borrowed(other),
        })
    }
}

/// A column's new name, and what its values are multiplied by.
fn one(name: &str, wanted: &[Wanted], used: &mut [bool]) -> (Parts, Option<Scale>) {
    let (stem, factors) = split(name);
    let mut by = Scale {
        by: Rational::from(1),
        degrees: 0,
    };
    let speed = wanted.iter().position(|w| w.unit.dimension == SPEED);
    if let (Some(k), [(angle @ ("rad" | "deg"), 1), ("s", -1)]) = (speed, &factors[..]) {
        used[k] = true;
        let scale = wanted[k].scale(angle, 1);
        return ((stem, vec![(wanted[k].label.clone(), 1)]), Some(scale));
    }
    let mut new = Vec::new();
    for (symbol, power) in factors {
        let due = dimension(symbol);
        match wanted.iter().position(|w| Some(w.unit.dimension) == due) {
            None => new.push((symbol.to_string(), power)),
            Some(k) => {
                used[k] = true;
                let scale = wanted[k].scale(symbol, power);
                by.by *= scale.by;
                by.degrees += scale.degrees;
                new.push((wanted[k].label.clone(), power));
            }
        }
    }
    let same = by.by == 1 && by.degrees == 0;
    ((stem, new), (!same).then_some(by))
}

impl Scale {
    fn apply(&self, x: f64) -> f64 {
        let size = |q: &rug::Integer| q.to_f64();
        let mut x = x * size(self.by.numer()) / size(self.by.denom());
        for _ in 0..self.degrees.abs() {
            x = match self.degrees > 0 {
                true => x.to_degrees(),
                false => x.to_radians(),
            };
        }
        x
    }
}

/// The places that the decimal point moves to the right.
fn power_of_ten(scale: &Scale) -> Option<i32> {
    (-60..=60).find(|k: &i32| {
        let ten = Rational::from(rug::Integer::u_pow_u(10, k.unsigned_abs()));
        let ten = if *k < 0 { ten.recip() } else { ten };
        scale.degrees == 0 && scale.by == ten
    })
}

/// A decimal with its point `places` places farther to the right, with the same digits.
fn shifted(text: &str, places: i32) -> String {
    let (sign, size) = match text.strip_prefix('-') {
        Some(size) => ("-", size),
        None => ("", text),
    };
    if let Some((digits, exponent)) = size.split_once('e')
        && let Ok(exponent) = exponent.parse::<i32>()
    {
        return format!("{sign}{digits}e{}", exponent + places);
    }
    let (whole, fraction) = size.split_once('.').unwrap_or((size, ""));
    let mut digits = format!("{whole}{fraction}");
    let mut point = whole.len() as i32 + places;
    if point <= 0 {
        digits.insert_str(0, &"0".repeat((1 - point) as usize));
        point = 1;
    }
    while (digits.len() as i32) < point {
        digits.push('0');
    }
    let (whole, fraction) = digits.split_at(point as usize);
    let whole = match whole.trim_start_matches('0') {
        "" => "0",
        w => w,
    };
    match fraction {
        "" => format!("{sign}{whole}"),
        f => format!("{sign}{whole}.{f}"),
    }
}

#[cfg(test)]
mod tests;
