//! A claim about an algorithm.

use crate::audit::Draw;
use serde::Serialize;

/// Describes what is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Measure {
    /// `|got − w|/|w|`.
    Norm,
    /// The relative error of Re w.
    RelativeRe,
    /// The relative error of Im w.
    RelativeIm,
    /// The larger of the two.
    RelativeParts,
    /// The larger error of Re w and Im w.
    Absolute,
    /// The error of Re w.
    AbsoluteRe,
}

impl Measure {
    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Measure::Norm => "relative, of the norm",
            Measure::RelativeRe => "relative, Re",
            Measure::RelativeIm => "relative, Im",
            Measure::RelativeParts => "relative, each part",
            Measure::Absolute => "absolute, each part",
            Measure::AbsoluteRe => "absolute, Re",
        }
    }
}

/// Of all points, or on the average.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Statistic {
    /// At every point.
    Maximum,
    /// The mean over points drawn as the domain says.
    Mean,
}

/// Where a claim is said to hold.
#[derive(Clone, Copy)]
pub struct Place {
    /// In words.
    pub words: &'static str,
    /// Draws a point of it.
    pub draw: fn(&mut Draw) -> Vec<f64>,
    /// Tells whether a point is of it.
    pub holds: fn(&[f64]) -> bool,
}

/// A claim.
#[derive(Clone, Copy)]
pub struct Claim {
    /// The algorithm's name.
    pub algorithm: &'static str,
    /// As printed.
    pub statement: &'static str,
    /// Where it was printed, and what was read.
    pub source: &'static str,
    /// How it is read here, where the wording leaves a choice.
    pub reading: &'static str,
    /// Holds what decides it; nothing if it cannot be tested, for the reason that `reading` has.
    pub test: Option<(Place, Measure, Statistic, f64)>,
}

/// Describes what became of a claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// At every point tried; the mean's interval is below the bound.
    Holds,
    /// In a part that is named.
    InPart,
    /// At a point that is named it certainly does not hold.
    Refuted,
    /// The mean's interval holds the bound, or the reference could not tell.
    Open,
    /// Not a statement about a double, or about an algorithm that is not at hand.
    NotTestable,
}

impl Verdict {
    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Verdict::Holds => "holds as far as searched",
            Verdict::InPart => "holds in part",
            Verdict::Refuted => "refuted",
            Verdict::Open => "open",
            Verdict::NotTestable => "not testable",
        }
    }
}
