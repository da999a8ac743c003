//! Why there is no law, no cycle, or no value.

use crate::cubic_spline::{CubicSplineError, EvaluationError};

/// Why a law of motion or a cycle is refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CamLawError {
    /// A number that is not finite.
    #[error("{name} = {value} is not finite")]
    NotFinite {
        /// Holds what it is.
        name: &'static str,
        /// The number.
        value: f64,
    },
    /// A part of the rise that is negative.
    #[error("{name} = {value} must not be negative")]
    Negative {
        /// `b`, `c` or `d`.
        name: &'static str,
        /// The number.
        value: f64,
    },
    /// Sine, constant and cosine part that do not fill the rise.
    #[error(
        "b + c + d = {}, but the shares of sine, constant and cosine must fill the rise: they add up to 1 but for their \
         rounding, as 0.25, 0.5 and 0.25 do",
        without_rounding(*.sum)
    )]
    PartsSum {
        /// Their sum.
        sum: f64,
    },
    /// A share of the rise spent accelerating that leaves one half none, or next to none.
    #[error("acceleration fraction {value} must lie between 0.001 and 0.999")]
    AccelerationFraction {
        /// The number.
        value: f64,
    },
    /// A law that has no symmetric halves to be stretched.
    #[error("only SCCA, 3-4-5 and 4-5-6-7 laws have halves that can be stretched")]
    NoHalves,
    /// A polynomial that does not start at zero.
    #[error("the polynomial starts at {value}, but a law of motion starts at 0")]
    PolynomialStart {
        /// The constant term.
        value: f64,
    },
    /// A polynomial that does not end at one.
    #[error("the coefficients add up to {sum}, but a law of motion ends at 1 (within 1e-9)")]
    PolynomialEnd {
        /// Sum of the coefficients.
        sum: f64,
    },
    /// A polynomial of a degree that is not 1 to 24.
    #[error("degree {degree} of the polynomial is not between 1 and 24")]
    PolynomialDegree {
        /// The degree.
        degree: usize,
    },
    /// A table that does not lead from (0, 0) to (1, 1).
    #[error(
        "the table leads from ({x0}, {y0}) to ({x1}, {y1}), but must lead from (0, 0) to (1, 1)"
    )]
    TableEnds {
        /// First abscissa.
        x0: f64,
        /// First ordinate.
        y0: f64,
        /// Last abscissa.
        x1: f64,
        /// Last ordinate.
        y1: f64,
    },
    /// The table has no spline.
    #[error("no spline through the table: {0}")]
    Spline(#[from] CubicSplineError),
    /// The spline has no value.
    #[error("{0}")]
    Evaluation(#[from] EvaluationError),
    /// A name that no law has.
    #[error("unknown law {name:?}; known are {}", super::motion::NAMES.join(", "))]
    UnknownLaw {
        /// The name.
        name: String,
    },
    /// A law that Gembara and Senyk name without saying what it is.
    #[error("law {name:?} is named by Gembara and Senyk but defined nowhere in their paper")]
    UndefinedLaw {
        /// The name.
        name: String,
    },
    /// A place outside the stroke.
    #[error("x = {x} is outside the stroke [0, 1]")]
    Outside {
        /// The place.
        x: f64,
    },
    /// A phase that is not longer than nothing.
    #[error("{phase} of {value} turns must be positive")]
    PhaseNotPositive {
        /// Its name.
        phase: &'static str,
        /// Its length in turns.
        value: f64,
    },
    /// A dwell that is negative.
    #[error("{phase} of {value} turns must not be negative")]
    PhaseNegative {
        /// Its name.
        phase: &'static str,
        /// Its length in turns.
        value: f64,
    },
    /// Phases that do not fill the turn.
    #[error(
        "the phases add up to {sum} turns ({} deg), but must fill one turn (within 1e-9)",
        sum * 360.0
    )]
    PhasesSum {
        /// Their sum in turns.
        sum: f64,
    },
    /// A lift that is zero.
    #[error("the lift must not be 0")]
    NoLift,
}

pub(super) fn finite(name: &'static str, value: f64) -> Result<f64, CamLawError> {
    match value.is_finite() {
        true => Ok(value),
        false => Err(CamLawError::NotFinite { name, value }),
    }
}

/// A sum without the figures that are those of rounding, if it is not 1 without them.
fn without_rounding(sum: f64) -> f64 {
    let rounded = (sum * 1e12).round() / 1e12;
    match sum.abs() < 1e3 && rounded != 1.0 {
        true => rounded,
        false => sum,
    }
}
