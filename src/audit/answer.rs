//! Answers of solver and reference.

use super::expected::Expected;
use mechaudit_reference::{Ball, Undecided};
use rug::Rational;
use serde::Serialize;

/// The reason to believe a reference value.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Proof {
    /// Exact rational arithmetic.
    Exact,
    /// Balls whose radius follows from the cited bound.
    Bounded(&'static str),
}

/// Reference values with their proof.
#[derive(Clone, Debug)]
pub struct Reference {
    /// One ball for each value of the solver.
    pub values: Vec<Ball>,
    /// The proof that they hold.
    pub proof: Proof,
}

/// The answer of a reference.
#[derive(Clone, Debug)]
pub enum ReferenceAnswer {
    /// The values.
    Values(Reference),
    /// One entry for each value of the solver, where infinities or NaN may be due, and why they
    /// hold.
    Expected(Vec<Expected>, Proof),
    /// There is no value, for the named reason; the solver must refuse with the same word.
    Refuses(&'static str),
    /// Not decided at this precision.
    Undecided(String),
    /// The reference itself failed: never a pass.
    Failed(String),
}

impl From<Uncertified> for ReferenceAnswer {
    fn from(why: Uncertified) -> ReferenceAnswer {
        match why {
            Uncertified::Refused(word) => ReferenceAnswer::Refuses(word),
            Uncertified::Undecided(why) => ReferenceAnswer::Undecided(why),
            Uncertified::Failed(why) => ReferenceAnswer::Failed(why),
            Uncertified::NoNumber => ReferenceAnswer::Failed(why.to_string()),
        }
    }
}

impl ReferenceAnswer {
    /// Creates values in exact rational arithmetic, rounded to balls of `bits` bits.
    pub fn exact<'a>(values: impl IntoIterator<Item = &'a Rational>, bits: u32) -> ReferenceAnswer {
        let values = values.into_iter().map(|v| Ball::rational(bits, v));
        ReferenceAnswer::Values(Reference {
            values: values.collect(),
            proof: Proof::Exact,
        })
    }

    /// Values whose radii follow from the cited bound.
    pub fn bounded(values: Vec<Ball>, bound: &'static str) -> ReferenceAnswer {
        let proof = Proof::Bounded(bound);
        ReferenceAnswer::Values(Reference { values, proof })
    }

    /// Returns true if a value is exactly zero and has no sign yet.
    fn has_zeros(&self) -> bool {
        let zero = |b: &Ball| b.mid().is_zero() && b.rad().is_zero();
        match self {
            ReferenceAnswer::Values(r) => r.values.iter().any(zero),
            ReferenceAnswer::Expected(expected, _) => {
                let number = |d: &Expected| matches!(d, Expected::Number(ball) if zero(ball));
                expected.iter().any(number)
            }
            _ => false,
        }
    }

    /// The same answer, value by value, its exact zeros with the signs that
    /// [`Method::signs_of_zero`](super::Method::signs_of_zero) tells.
    pub(super) fn with_signs_of_zero(
        self,
        signs: impl FnOnce() -> Vec<Option<bool>>,
    ) -> ReferenceAnswer {
        if !self.has_zeros() {
            return self;
        }
        let signs = signs();
        let signed =
            |(i, expected): (usize, Expected)| expected.signed(signs.get(i).copied().flatten());
        match self {
            ReferenceAnswer::Values(r) => {
                let numbers = r.values.into_iter().map(Expected::Number);
                ReferenceAnswer::Expected(numbers.enumerate().map(signed).collect(), r.proof)
            }
            ReferenceAnswer::Expected(expected, proof) => ReferenceAnswer::Expected(
                expected.into_iter().enumerate().map(signed).collect(),
                proof,
            ),
            other => other,
        }
    }

    /// Returns the number of values, if there are any.
    pub(super) fn len(&self) -> Option<usize> {
        match self {
            ReferenceAnswer::Values(r) => Some(r.values.len()),
            ReferenceAnswer::Expected(expected, _) => Some(expected.len()),
            _ => None,
        }
    }

    /// The values, if every one of them is due as a number.
    ///
    /// # Errors
    /// The reason why they are not.
    pub fn certified(self) -> Result<Vec<Ball>, Uncertified> {
        match self {
            ReferenceAnswer::Values(r) => Ok(r.values),
            ReferenceAnswer::Expected(expected, _) => {
                let numbers: Option<Vec<Ball>> =
                    expected.into_iter().map(Expected::into_number).collect();
                numbers.ok_or(Uncertified::NoNumber)
            }
            ReferenceAnswer::Refuses(word) => Err(Uncertified::Refused(word)),
            ReferenceAnswer::Undecided(why) => Err(Uncertified::Undecided(why)),
            ReferenceAnswer::Failed(why) => Err(Uncertified::Failed(why)),
        }
    }
}

/// The reason why there are no certified values.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Uncertified {
    /// There is no value, for the named reason.
    #[error("{0}")]
    Refused(&'static str),
    /// Not decided at this precision.
    #[error("{0}")]
    Undecided(String),
    /// The reference itself failed.
    #[error("{0}")]
    Failed(String),
    /// An infinity or no value at all.
    #[error("no finite value")]
    NoNumber,
}

impl From<Undecided> for Uncertified {
    fn from(e: Undecided) -> Uncertified {
        Uncertified::Undecided(e.to_string())
    }
}

/// The answer of the code under test.
#[derive(Clone, Debug, PartialEq)]
pub enum SolverAnswer {
    /// The values.
    Values(Vec<f64>),
    /// A typed error, by its name.
    Refuses(&'static str),
    /// A refusal of code that knows no names: in its own word, which has to be the reference's, or
    /// without any, which is right wherever the reference refuses.
    Declines(Option<String>),
    /// No answer: the text cannot be read, or the code panicked. Never a pass.
    Fails(String),
    /// Nothing came, or not in time: what happened instead. Never a pass.
    Unanswered(String),
}

impl SolverAnswer {
    /// The word of a refusal, if it has one.
    pub fn refusal(&self) -> Option<&str> {
        match self {
            SolverAnswer::Refuses(word) => Some(word),
            SolverAnswer::Declines(word) => word.as_deref(),
            _ => None,
        }
    }
}
