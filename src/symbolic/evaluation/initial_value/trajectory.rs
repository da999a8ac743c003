//! The solution of an initial value problem, as far as it is asked for.

use super::InitialValueProblem;
use crate::evaluation::Goal;
use mechaudit_reference::Ball;
use rug::Rational;

/// Limits on the work of one trajectory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// The highest working precision in bits.
    pub bits: u32,
    /// The most steps of all runs together.
    pub steps: u64,
}

impl Default for Limits {
    /// 4096 bits and a million steps.
    fn default() -> Limits {
        Limits {
            bits: 4096,
            steps: 1_000_000,
        }
    }
}

/// Reason why a motion has no certified value at a time.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MotionError {
    /// A start has no value.
    #[error("the start of {name} has no value: {reason}")]
    Start {
        /// The state, or the time.
        name: String,
        /// Why.
        reason: String,
    },
    /// The start of the time is not a rational number.
    #[error("the start of the time {0} is not a rational number")]
    StartTime(String),
    /// A rate has no value.
    #[error("the rate of {state} is undefined at {time}: {reason}", time = time.to_f64())]
    Rate {
        /// The state.
        state: String,
        /// The time up to which the motion is known.
        time: Rational,
        /// Why.
        reason: String,
    },
    /// The solution grows without bound in finite time, or seems to.
    #[error("the motion is known up to {reached} and grows without bound near {near}", reached = reached.to_f64())]
    BlowUp {
        /// The time up to which the motion is proved to exist.
        reached: Rational,
        /// An estimate, which is not proved, of the time where it ceases to exist.
        near: f64,
    },
    /// Nothing is proved beyond a time.
    #[error("undecided beyond {reached}: {reason}", reached = reached.to_f64())]
    Undecided {
        /// The time up to which the motion is proved to exist.
        reached: Rational,
        /// Why.
        reason: String,
    },
}

/// The solution of an initial value problem for one set of inputs, extended as it is asked for.
pub struct Trajectory {}

impl Trajectory {
    pub(super) fn new(
        _problem: &InitialValueProblem,
        _inputs: &[Rational],
        _limits: Limits,
    ) -> Result<Trajectory, MotionError> {
        todo!()
    }

    /// The time of the start.
    pub fn start(&self) -> &Rational {
        todo!()
    }

    /// The states at an exact time, before or after the start, each in a ball that meets the goal, or the narrowest
    /// one within the limits where none does.
    ///
    /// # Errors
    /// See [`MotionError`].
    pub fn at(&mut self, _time: &Rational, _goal: Goal) -> Result<Vec<Ball>, MotionError> {
        todo!()
    }

    /// The derivatives of the states by the inputs at a time, state by state, each with at least `bits` bits where
    /// the limits allow it.
    ///
    /// # Errors
    /// See [`MotionError`], and inputs by which the rates have no derivative in the language.
    pub fn sensitivities(
        &mut self,
        _time: &Rational,
        _bits: u32,
    ) -> Result<Vec<Vec<Ball>>, MotionError> {
        todo!()
    }

    /// Enclosures of the times at which the rates switched from one smooth piece to another, as far as the motion is
    /// known.
    pub fn switches(&self) -> Vec<Ball> {
        todo!()
    }
}
