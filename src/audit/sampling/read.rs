//! Boxes and centres as they are written.
//!
//! A box is written `NAME=SIDE, NAME=SIDE`: names of numbers of the input, those of vectors
//! counted from 0 as in `y[0]`, and for each
//!
//! | side | draws |
//! |---|---|
//! | `1.5` | this number |
//! | `-6..0` | uniformly |
//! | `log 1e-8..1e3` | uniformly in the logarithm; both ends of one sign |
//! | `+-log 1e-8..1e3` | the same with either sign |
//!
//! Inputs that it does not name are drawn from the regions, from one after the other.

use super::{Near, SampleBox, SamplingError, Side, Spacing};
use crate::case::{Case, Cases};
use crate::layout::{Column, Layout};
use crate::method::Method;
use crate::nearest::did_you_mean;
use crate::no_such::NoSuch;
use crate::settings::Settings;
use mechaudit_reference::{Decimal, HexFloat};

/// A number, decimal or hexadecimal.
fn number(text: &str) -> Option<f64> {
    let text = text.trim();
    let hex = text.trim_start_matches(['+', '-']).starts_with("0x");
    let x = match hex {
        true => HexFloat::parse(text).ok()?.to_f64(),
        false => Decimal::nearest(text).ok()?,
    };
    x.is_finite().then_some(x)
}

impl SampleBox {
    /// Reads a box of a method.
    ///
    /// # Errors
    /// A part that is no side, a name that the method does not have.
    pub fn read(method: &dyn Method, text: &str) -> Result<SampleBox, SamplingError> {
        let layout = Layout::new(method);
        let mut sides: Vec<Side> = Vec::new();
        for part in text.split(',') {
            let part = part.trim();
            let text = part;
            let bad = || SamplingError::Side { part: text.into() };
            let (name, side) = text.split_once('=').ok_or_else(bad)?;
            let (name, side) = (name.trim(), side.trim());
            let Some(Column::Input { part, index }) = layout.column(name) else {
                let of = |part| layout.input_column(part, 0);
                let known: Vec<String> = (0..layout.parts()).map(of).collect();
                return Err(SamplingError::Name {
                    method: method.name(),
                    name: name.into(),
                    hint: did_you_mean(name, &known),
                    known: known.join(", "),
                });
            };
            if sides.iter().any(|s| (s.part, s.index) == (part, index)) {
                return Err(SamplingError::Twice { name: name.into() });
            }
            let (spacing, ends) = match side {
                s if s.starts_with("+-log ") => (Spacing::EitherSign, &s[6..]),
                s if s.starts_with("log ") => (Spacing::Logarithmic, &s[4..]),
                s => (Spacing::Uniform, s),
            };
            let (lo, hi) = ends.split_once("..").unwrap_or((ends, ends));
            let ends = [number(lo).ok_or_else(bad)?, number(hi).ok_or_else(bad)?];
            let reason = match spacing {
                _ if ends[0] > ends[1] => Some("the lower end comes first"),
                Spacing::Logarithmic if ends[0] * ends[1].signum() <= 0.0 => {
                    Some("a logarithm needs both ends of one sign")
                }
                Spacing::EitherSign if ends[0] <= 0.0 => {
                    Some("with either sign both ends are positive")
                }
                _ => None,
            };
            if let Some(reason) = reason {
                let part = text.into();
                return Err(SamplingError::Ends { part, reason });
            }
            sides.push(Side {
                part,
                index,
                ends,
                spacing,
            });
        }
        sides.sort_by_key(|s| (s.part, s.index));
        let is_single = |s: &Side| layout.is_single(s.part);
        let whole = sides.len() == layout.parts() && sides.iter().all(is_single);
        let domain = method.domain();
        if !whole && domain.regions.is_empty() {
            return Err(SamplingError::NoRegion);
        }
        let read = SampleBox {
            text: text.into(),
            layout,
            sides,
            whole,
        };
        if !whole {
            let (_, input) = read.rest(method.name(), &domain, (0, 0));
            let missing = read.sides.iter().find(|s| read.place(s, &input).is_none());
            if let Some(side) = missing {
                return Err(SamplingError::Element {
                    method: method.name(),
                    name: read.layout.input_column(side.part, side.index),
                });
            }
        }
        Ok(read)
    }
}

impl Near {
    /// Reads the centre: numbers separated by commas, the name of a check point, `REGION/CASE` of
    /// the settings' seed, or `hard/N`.
    ///
    /// # Errors
    /// A text that is no input of the method; a radius that is not positive and at most 1.
    pub fn read(
        method: &dyn Method,
        settings: &Settings,
        text: &str,
        radius: f64,
    ) -> Result<Near, SamplingError> {
        if !(radius > 0.0 && radius <= 1.0) {
            return Err(SamplingError::Radius(radius));
        }
        let bad = |reason: String| SamplingError::Centre {
            text: text.into(),
            reason,
        };
        let numbers: Option<Vec<f64>> = text.split(',').map(number).collect();
        let centre = match numbers {
            Some(input) => {
                let layout = Layout::new(method);
                layout.lengths(&input).map_err(|e| bad(e.to_string()))?;
                input
            }
            None => {
                named(method, settings, text)
                    .map_err(|e| bad(e.to_string()))?
                    .input
            }
        };
        if let Some(x) = centre.iter().find(|x| !x.is_finite()) {
            return Err(bad(format!("{x} has no neighbours")));
        }
        Ok(Near {
            text: text.into(),
            data: Layout::new(method).is_data(method, &centre),
            centre,
            radius,
        })
    }
}

/// A case by its name.
fn named(method: &dyn Method, settings: &Settings, text: &str) -> Result<Case, NoSuch> {
    let cases = Cases::new(method, settings);
    match text.rsplit_once('/') {
        Some((region, index)) => match (region, index.parse::<u64>()) {
            ("hard", Ok(n)) => cases.hard_case(usize::try_from(n).unwrap_or(usize::MAX)),
            (region, Ok(n)) => cases.in_region(region, n),
            _ => cases.at_check_point(text),
        },
        None => cases.at_check_point(text),
    }
}
