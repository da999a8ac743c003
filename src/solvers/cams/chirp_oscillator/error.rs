//! Describes what is refused.

/// Why an oscillator, an excitation or a time is refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ChirpError {
    /// A number that is NaN or infinite.
    #[error("{name} = {value} is not a finite number")]
    NotFinite {
        /// The parameter.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// A number that has to be positive.
    #[error("{name} = {value} must be greater than zero")]
    NotPositive {
        /// The parameter.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// A number that must not be negative.
    #[error("{name} = {value} must not be negative")]
    Negative {
        /// The parameter.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// A harmonic that does not exist.
    #[error("there is no harmonic number {index}: the excitation has {count}")]
    NoHarmonic {
        /// The position asked for, from 0.
        index: usize,
        /// Their number.
        count: usize,
    },
    /// An output slice of another length than the times.
    #[error("{values} places for the values at {times} times")]
    Lengths {
        /// Times.
        times: usize,
        /// Places for values.
        values: usize,
    },
}

impl ChirpError {
    /// One word for the kind of error.
    pub fn name(&self) -> &'static str {
        match self {
            ChirpError::NotFinite { .. } => "not finite",
            ChirpError::NotPositive { .. } => "not positive",
            ChirpError::Negative { .. } => "negative",
            ChirpError::NoHarmonic { .. } => "no such harmonic",
            ChirpError::Lengths { .. } => "lengths",
        }
    }
}

pub(super) fn finite(name: &'static str, value: f64) -> Result<f64, ChirpError> {
    match value.is_finite() {
        true => Ok(value),
        false => Err(ChirpError::NotFinite { name, value }),
    }
}

pub(super) fn not_negative(name: &'static str, value: f64) -> Result<f64, ChirpError> {
    match finite(name, value)? >= 0.0 {
        true => Ok(value),
        false => Err(ChirpError::Negative { name, value }),
    }
}

pub(super) fn positive(name: &'static str, value: f64) -> Result<f64, ChirpError> {
    match finite(name, value)? > 0.0 {
        true => Ok(value),
        false => Err(ChirpError::NotPositive { name, value }),
    }
}
