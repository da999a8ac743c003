//! What an audited method has to say about itself.

use super::budget::{Budget, NormBudget};
use super::domain::Domain;
use super::due::Due;
use super::hard::HardCase;
use super::layout::Rows;
use mechaudit_reference::{Ball, Mag};
use rug::{Float, Rational};
use serde::Serialize;

/// Why a reference value is to be believed.
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
    /// Why they hold.
    pub proof: Proof,
}

/// What a reference answers.
#[derive(Clone, Debug)]
pub enum ReferenceAnswer {
    /// The values.
    Values(Reference),
    /// One entry for each value of the solver, where infinities or NaN may be due, and why they
    /// hold.
    Dues(Vec<Due>, Proof),
    /// There is no value, for the named reason; the solver must refuse with the same word.
    Refuses(&'static str),
    /// Not decided at this precision.
    Undecided(String),
    /// The reference itself failed: never a pass.
    Failed(String),
}

impl ReferenceAnswer {
    /// The same answer, its exact zeros with the signs that [`Method::signs_of_zero`] tells.
    pub(super) fn with_signs_of_zero(self, signs: &[Option<bool>]) -> ReferenceAnswer {
        let signed = |(i, due): (usize, Due)| due.signed(signs.get(i).copied().flatten());
        match self {
            ReferenceAnswer::Values(r) if !signs.is_empty() => ReferenceAnswer::Dues(
                r.values
                    .into_iter()
                    .map(Due::Number)
                    .enumerate()
                    .map(signed)
                    .collect(),
                r.proof,
            ),
            ReferenceAnswer::Dues(dues, proof) => {
                ReferenceAnswer::Dues(dues.into_iter().enumerate().map(signed).collect(), proof)
            }
            other => other,
        }
    }

    /// How many values there are, where there are any.
    pub(super) fn len(&self) -> Option<usize> {
        match self {
            ReferenceAnswer::Values(r) => Some(r.values.len()),
            ReferenceAnswer::Dues(dues, _) => Some(dues.len()),
            _ => None,
        }
    }

    /// The values, if every one of them is due as a number.
    pub fn numbers(self) -> Option<Vec<Ball>> {
        match self {
            ReferenceAnswer::Values(r) => Some(r.values),
            ReferenceAnswer::Dues(dues, _) => dues.into_iter().map(Due::into_number).collect(),
            _ => None,
        }
    }
}

/// What the code under test answers.
#[derive(Clone, Debug, PartialEq)]
pub enum SolverAnswer {
    /// The values.
    Values(Vec<f64>),
    /// A typed error, by its name.
    Refuses(&'static str),
    /// A refusal of code that knows no names: in its own word, which has to be the reference's, or
    /// without any, which is right wherever the reference refuses.
    Declines(Option<String>),
    /// No answer: what happened instead. Never a pass.
    Fails(String),
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

/// One value of the output. Where [`Method::rows`] repeats them, value `i` belongs to output
/// `i mod outputs.len()`.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Output {
    /// The symbol.
    pub name: &'static str,
    /// The unit, `1` if none.
    pub unit: &'static str,
    /// What it may be wrong by.
    pub budget: Budget,
}

/// One part of the input's layout.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Input {
    /// The symbol, with its length and a note: `phi1`, `a[n]`, `side (1 or -1)`; see
    /// [`Layout`](super::Layout).
    pub name: &'static str,
    /// The unit, `1` if none.
    pub unit: &'static str,
}

/// An identity that the solver's own values have to satisfy.
#[derive(Clone, Copy)]
pub struct Law {
    /// A short name.
    pub name: &'static str,
    /// The identity, and how closely it has to hold.
    pub statement: &'static str,
    /// Residual divided by what is allowed (≤ 1 passes); `None` where the law does not apply.
    pub residual: fn(&[f64]) -> Option<f64>,
}

/// A solver, its reference, domain, budget and source: everything an audit needs.
///
/// One file in `src/methods/` implements this for each audited method.
pub trait Method: Sync {
    /// The name used on the command line: lower case, words joined by hyphens.
    fn name(&self) -> &'static str;
    /// One line in plain words.
    fn summary(&self) -> &'static str;
    /// Where the method comes from, with equation numbers.
    fn source(&self) -> &'static str;
    /// The layout of the input vector.
    fn inputs(&self) -> Vec<Input>;
    /// The outputs with their budgets.
    fn outputs(&self) -> Vec<Output>;
    /// How often an answer repeats the outputs, where it holds more than one row of them.
    fn rows(&self) -> Option<Rows> {
        None
    }
    /// What all values together may be wrong by, besides.
    fn norm_budget(&self) -> Option<NormBudget> {
        None
    }
    /// Where it is audited.
    fn domain(&self) -> Domain;
    /// Calls the code under test.
    fn solve(&self, input: &[f64]) -> SolverAnswer;
    /// The reference at a working precision of `bits`.
    fn reference(&self, input: &[Rational], bits: u32) -> ReferenceAnswer;
    /// What is due where an input is NaN or infinite: by default a refusal.
    fn reference_not_finite(&self, _input: &[f64]) -> ReferenceAnswer {
        ReferenceAnswer::Refuses("not finite")
    }

    /// For each value that is exactly zero at `input`: whether the function's limit makes it −0;
    /// `None` where there is no such limit. By default no zero has a sign.
    fn signs_of_zero(&self, _input: &[f64]) -> Vec<Option<bool>> {
        Vec::new()
    }

    /// `Σ_j |x_j ∂f_i/∂x_j|` for each value `i`; `None` if it cannot be had.
    ///
    /// By default one-sided differences of the reference; see [`conditions_by_differences`].
    fn conditions(&self, input: &[f64]) -> Option<Vec<f64>> {
        conditions_by_differences(self, input, |_| true)
    }

    /// [`Method::conditions`] where the reference's answer at `input` is at hand.
    fn conditions_beside(&self, input: &[f64], _reference: &ReferenceAnswer) -> Option<Vec<f64>> {
        self.conditions(input)
    }

    /// What the method's own solver would answer without rounding, in balls, where that can be had:
    /// tells rounding from the error of the method itself.
    fn twin(&self, _input: &[f64]) -> Option<Vec<Ball>> {
        None
    }

    /// Hard cases found by earlier hunts, judged in every audit.
    fn hard(&self) -> Vec<HardCase> {
        Vec::new()
    }

    /// Whether an input belongs to the domain, beyond what the reference refuses: a hunt leaves
    /// others alone.
    fn admits(&self, _input: &[f64]) -> bool {
        true
    }

    /// Identities of the solver's values.
    fn laws(&self) -> Vec<Law> {
        Vec::new()
    }
}

/// Estimates `Σ_j |x_j ∂f_i/∂x_j|` from the reference at `x` and at `x` with each `x_j` in turn
/// multiplied by `1 + 2⁻⁴⁰`, at 256 bits.
///
/// An estimate: its relative error is of the order of 2⁻⁴⁰ times the second derivative. Inputs
/// for which `is_data` is false (counts, choices) are left alone.
pub fn conditions_by_differences<M: Method + ?Sized>(
    method: &M,
    input: &[f64],
    is_data: impl Fn(usize) -> bool,
) -> Option<Vec<f64>> {
    const BITS: u32 = 256;
    let exact: Option<Vec<Rational>> = input.iter().map(|&x| Rational::from_f64(x)).collect();
    let mut x = exact?;
    let base = method.reference(&x, BITS).numbers()?;
    let mut sum = vec![Mag::ZERO; base.len()];
    let scale = Rational::from(1) + (Rational::from(1) >> 40u32);
    for j in 0..x.len() {
        if x[j] == 0 || !is_data(j) {
            continue;
        }
        let moved = Rational::from(&x[j] * &scale);
        let old = std::mem::replace(&mut x[j], moved);
        let answer = method.reference(&x, BITS);
        x[j] = old;
        let shifted = answer.numbers().filter(|s| s.len() == sum.len())?;
        for ((s, a), b) in sum.iter_mut().zip(&shifted).zip(&base) {
            let d = Float::with_val(64, a.mid() - b.mid());
            *s = s.add(Mag::above(&d).shift(40));
        }
    }
    Some(sum.into_iter().map(Mag::to_f64).collect())
}
