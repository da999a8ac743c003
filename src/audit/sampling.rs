//! Where a run draws its cases: the regions of the domain, a box, or the neighbourhood of an input.

mod read;

use super::domain::{Domain, Draw, Region};
use super::layout::Layout;
use super::reason::plain;

/// Where cases are drawn.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Sampling {
    /// In the regions, after check points and hard cases.
    #[default]
    Domain,
    /// In a box.
    Box(SampleBox),
    /// About an input.
    Near(Near),
}

/// The reason why there is no such box or neighbourhood.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SamplingError {
    /// Not `NAME=SIDE`.
    #[error("{part:?} in the box is not NAME=LO..HI, NAME=log LO..HI, NAME=+-log LO..HI or NAME=X")]
    Side {
        /// The part.
        part: String,
    },
    /// A side that holds no numbers.
    #[error("{part:?} in the box: {reason}")]
    Ends {
        /// The part.
        part: String,
        /// The fault of it.
        reason: &'static str,
    },
    /// A name that is no number of the input.
    #[error("{method} has no input {name:?}{hint}; it has: {known}")]
    Name {
        /// The method.
        method: &'static str,
        /// The name.
        name: String,
        /// Which may be meant.
        hint: String,
        /// Those there are.
        known: String,
    },
    /// An element of a vector that is never so long.
    #[error("no region of {method} draws {name}: its vector is shorter")]
    Element {
        /// The method.
        method: &'static str,
        /// The element.
        name: String,
    },
    /// A name that stands twice.
    #[error("the box names {name} twice")]
    Twice {
        /// The name.
        name: String,
    },
    /// No input.
    #[error("{text:?} is neither numbers, a check point, REGION/CASE nor hard/N: {reason}")]
    Centre {
        /// The text given.
        text: String,
        /// The reason.
        reason: String,
    },
    /// A radius that is not a positive number.
    #[error("the radius {} must be positive and at most 1", plain(*.0))]
    Radius(f64),
    /// No regions to draw the rest from.
    #[error("there is no region to draw the other inputs from")]
    NoRegion,
}

/// The way a number of a box is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Spacing {
    Uniform,
    Logarithmic,
    /// Logarithmic with either sign.
    EitherSign,
}

/// A number of a box.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Side {
    /// The part of the input, and its number there.
    part: usize,
    index: usize,
    ends: [f64; 2],
    spacing: Spacing,
}

/// A box in some numbers of the input, or all.
#[derive(Clone, Debug, PartialEq)]
pub struct SampleBox {
    text: String,
    layout: Layout,
    sides: Vec<Side>,
    /// True if it names every number.
    whole: bool,
}

/// Inputs that are drawn from the regions at most before one has every element that the box names.
const TRIES: u64 = 1000;

impl SampleBox {
    /// As it was written.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Returns true if it names every number of the input, so that no region is drawn from.
    pub fn is_whole(&self) -> bool {
        self.whole
    }

    /// The input of that number, and the region that it was drawn from.
    pub(super) fn sample(
        &self,
        method: &'static str,
        domain: &Domain,
        (seed, index): (u64, u64),
    ) -> (&'static str, Vec<f64>) {
        let (region, mut input) = match self.whole {
            true => ("box", vec![0.0; self.sides.len()]),
            false => self.rest(method, domain, (seed, index)),
        };
        let places: Vec<Option<usize>> = self.sides.iter().map(|s| self.place(s, &input)).collect();
        let mut draw = Draw::new(seed, method, "box", index);
        for (side, place) in self.sides.iter().zip(places) {
            let x = side.draw(&mut draw);
            if let Some(number) = place.and_then(|at| input.get_mut(at)) {
                *number = x;
            }
        }
        (region, input)
    }

    fn place(&self, side: &Side, input: &[f64]) -> Option<usize> {
        match self.whole {
            // Of single numbers alone.
            true => Some(side.part),
            false => self.layout.place(side.part, side.index, input),
        }
    }

    /// An input of a region that has every element named, from the regions one after the other.
    fn rest(
        &self,
        method: &'static str,
        domain: &Domain,
        (seed, index): (u64, u64),
    ) -> (&'static str, Vec<f64>) {
        let n = domain.regions.len() as u64;
        let draw = |k: u64| {
            let region = &domain.regions[(k % n) as usize];
            let mut draw = Draw::new(seed, method, region.name, k / n);
            (region.name, (region.sample)(&mut draw))
        };
        let has_all = |input: &[f64]| self.sides.iter().all(|s| self.place(s, input).is_some());
        let own = draw(index);
        if has_all(&own.1) {
            return own;
        }
        // Beyond the numbers of ordinary cases, so that neighbours do not draw the same.
        let others = (0..TRIES).map(|k| draw((1 << 40) + index * TRIES + k));
        others
            .into_iter()
            .find(|(_, input)| has_all(input))
            .unwrap_or(own)
    }
}

impl Side {
    fn draw(&self, draw: &mut Draw) -> f64 {
        let [lo, hi] = self.ends;
        let t = draw.unit();
        let size = |lo: f64, hi: f64| {
            let x = libm::exp((1.0 - t) * libm::log(lo) + t * libm::log(hi));
            x.clamp(lo, hi)
        };
        match self.spacing {
            // Without the difference, which may overflow.
            Spacing::Uniform => ((1.0 - t) * lo + t * hi).clamp(lo, hi),
            Spacing::Logarithmic if hi < 0.0 => -size(-hi, -lo),
            Spacing::Logarithmic => size(lo, hi),
            Spacing::EitherSign => draw.signed(size(lo, hi)),
        }
    }
}

/// The neighbourhood of an input: data `x` becomes `x (1 + ρ t)`, a zero `ρ t`, with t uniform on
/// [−1, 1); ρ is the radius in one half of the cases and log-uniform from 2⁻⁵² up to it in the
/// other. Counts and choices stay.
#[derive(Clone, Debug, PartialEq)]
pub struct Near {
    text: String,
    centre: Vec<f64>,
    data: Vec<bool>,
    radius: f64,
}

impl Near {
    /// As the centre was written.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The radius.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    pub(super) fn sample(&self, method: &'static str, (seed, index): (u64, u64)) -> Vec<f64> {
        let mut draw = Draw::new(seed, method, "near", index);
        let least = 2f64.powi(-52).min(self.radius);
        let radius = match draw.chance(0.5) {
            true => self.radius,
            false => draw.log_uniform(least, self.radius),
        };
        let numbers = self.centre.iter().zip(&self.data);
        let moved = numbers.map(|(&x, data)| {
            let t = draw.uniform(-1.0, 1.0);
            match (data, x == 0.0) {
                (false, _) => x,
                (true, true) => radius * t,
                (true, false) => (x + x * (radius * t)).clamp(f64::MIN, f64::MAX),
            }
        });
        moved.collect()
    }
}

/// Magnitudes of ordinary numbers: far from the ends of the range, with their squares and cubes.
const ORDINARY: std::ops::RangeInclusive<f64> = 1e-100..=1e100;

/// Returns true if every number is zero or of ordinary size.
pub(super) fn is_ordinary(input: &[f64]) -> bool {
    let ordinary = |x: &f64| *x == 0.0 || ORDINARY.contains(&x.abs());
    input.iter().all(ordinary)
}

impl Region {
    /// Returns true if the region stays away from the ends of the range: all numbers of 64 draws of
    /// a fixed stream are zero or between 1e-100 and 1e100 in magnitude.
    pub fn is_ordinary(&self, method: &str) -> bool {
        (0..64).all(|i| {
            let mut draw = Draw::new(0, method, self.name, i);
            is_ordinary(&(self.sample)(&mut draw))
        })
    }
}

#[cfg(test)]
mod tests;
