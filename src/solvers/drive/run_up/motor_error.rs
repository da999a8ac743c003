//! Errors of motors and drives, and the checks of their numbers.

use crate::cubic_spline::CubicSplineError;

/// The reason for which a motor or drive is refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MotorError {
    /// A number that is NaN or infinite.
    #[error("{name} = {value} is not a finite number")]
    NotFinite {
        /// The parameter.
        name: &'static str,
        /// Its value in SI units.
        value: f64,
    },
    /// A number that has to be positive.
    #[error("{name} = {value} {unit} must be greater than zero")]
    NotPositive {
        /// The parameter.
        name: &'static str,
        /// Its value in SI units.
        value: f64,
        /// The SI unit, empty for a pure number.
        unit: &'static str,
    },
    /// A number that must not be negative.
    #[error("{name} = {value} {unit} must not be negative")]
    Negative {
        /// The parameter.
        name: &'static str,
        /// Its value in SI units.
        value: f64,
        /// The SI unit.
        unit: &'static str,
    },
    /// An overload factor below one: the motor would not reach its rated torque.
    #[error(
        "the overload factor k = {value} must be at least 1 (pull-out torque over rated torque)"
    )]
    Overload {
        /// k.
        value: f64,
    },
    /// A rated slip outside (0, 1).
    #[error("the rated slip {value} must lie between 0 and 1")]
    Slip {
        /// s_n.
        value: f64,
    },
    /// A reducer without a ratio.
    #[error("the reducer's ratio must not be zero")]
    NoRatio,
    /// A torque over time without points.
    #[error("the torque over time has no points")]
    NoPoints,
    /// A torque over time that does not begin with the run.
    #[error("the first time of the torque, {time} s, must be 0 s")]
    FirstTime {
        /// The first time in s.
        time: f64,
    },
    /// Times that do not increase.
    #[error("the time of point {point}, {time} s, must be greater than the one before, {before} s")]
    TimesNotIncreasing {
        /// The number of the point, counted from 1.
        point: usize,
        /// Its time in s.
        time: f64,
        /// The time before it in s.
        before: f64,
    },
    /// A table that is no curve.
    #[error("torque-speed table: {0}")]
    Table(#[from] CubicSplineError),
}

/// Returns the value, or an error if it is not finite.
pub(super) fn finite(name: &'static str, value: f64) -> Result<f64, MotorError> {
    match value.is_finite() {
        true => Ok(value),
        false => Err(MotorError::NotFinite { name, value }),
    }
}

/// Returns the value, or an error if it is not greater than zero.
pub(super) fn positive(
    name: &'static str,
    value: f64,
    unit: &'static str,
) -> Result<f64, MotorError> {
    match finite(name, value)? > 0.0 {
        true => Ok(value),
        false => Err(MotorError::NotPositive { name, value, unit }),
    }
}

/// Returns the value, or an error if it is less than zero.
pub(super) fn not_negative(
    name: &'static str,
    value: f64,
    unit: &'static str,
) -> Result<f64, MotorError> {
    match finite(name, value)? >= 0.0 {
        true => Ok(value),
        false => Err(MotorError::Negative { name, value, unit }),
    }
}
