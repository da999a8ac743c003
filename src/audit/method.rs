//! The interface of an audited method.

use super::answer::{ReferenceAnswer, SolverAnswer, Uncertified};
use super::budget::{Budget, NormBudget};
use super::domain::Domain;
use super::hard::{HardCase, HardCaseError, HardCaseFault};
use super::no_such::NoSuch;
use super::sampling::Sampling;
use super::ulp::Format;
use mechaudit_reference::{Ball, Mag};
use rug::{Float, Rational};
use serde::Serialize;

/// One value of the output. Where [`Method::rows`] repeats them, value `i` belongs to output
/// `i mod outputs.len()`.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Output {
    /// The symbol.
    pub name: &'static str,
    /// The unit, `1` if none.
    pub unit: &'static str,
    /// The error that it may have.
    pub budget: Budget,
}

/// One part of the input's layout.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Input {
    /// The symbol, with its length and a note: `phi1`, `a[n]`, `side (1 or -1)`; see
    /// [`Layout`](super::Layout).
    pub name: &'static str,
    /// The unit, `1` if none.
    pub unit: &'static str,
}

/// A row of outputs for each of several things.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Rows {
    /// The index of a row: `q` in `S[q]`.
    pub index: &'static str,
    /// Their number: digits, a letter of the inputs' lengths, or a word where only the reference
    /// tells.
    pub count: &'static str,
    /// The object that a row belongs to.
    pub meaning: &'static str,
}

/// The formula by which a solver computes at an input, and the nearest place where another takes
/// over.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BranchAt {
    /// The formula, where it has a name.
    pub branch: Option<String>,
    /// The nearest seam: `|z|^2 = 48`.
    pub seam: String,
    /// The distance to it, in the unit of the inputs.
    pub distance: f64,
}

/// The quantity that a proved bound limits.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ProvedError {
    /// `‖got − ref‖₂ ≤ k u ‖ref‖₂` with u = 2⁻⁵³, but for what underflows.
    Norm(f64),
    /// `|got − ref| ≤ k ulp(ref)`, the unit in the last place at least the smallest number;
    /// infinity where the value is above the range.
    Ulps(f64),
    /// `|got − ref| ≤ r |ref|`.
    Relative(f64),
    /// `|got − ref| ≤ a`, in the output's unit.
    Absolute(f64),
}

impl std::fmt::Display for ProvedError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            ProvedError::Norm(k) => write!(f, "{k} u of the norm"),
            ProvedError::Ulps(k) => write!(f, "{k} ulp"),
            ProvedError::Relative(r) => write!(f, "{r:e} relative"),
            ProvedError::Absolute(a) => write!(f, "{a:e} absolute"),
        }
    }
}

/// A bound on the error of the method's own solver that is proved for every input of a set; what is
/// found beside it is the worst of a sample.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ProvedBound {
    /// Of which error, and how large.
    #[serde(flatten)]
    pub error: ProvedError,
    /// The inputs: `Im z >= 0`.
    pub inputs: &'static str,
    /// The command that proves it.
    pub command: &'static str,
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

/// The largest residual, zero of none; not a number, which breaks the law, where one is none.
pub fn largest(residuals: impl IntoIterator<Item = f64>) -> f64 {
    let larger = |worst: f64, x: f64| match worst.is_nan() || x <= worst {
        true => worst,
        false => x,
    };
    residuals.into_iter().fold(0.0, larger)
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
    /// Returns the name that random inputs are drawn by: the same wherever the method is kept.
    fn stream(&self) -> &'static str {
        self.name()
    }
    /// Returns remarks that every report shows with the method.
    fn remarks(&self) -> Vec<String> {
        Vec::new()
    }
    /// The layout of the input vector.
    fn inputs(&self) -> Vec<Input>;
    /// The outputs with their budgets.
    fn outputs(&self) -> Vec<Output>;
    /// Returns the rows of an answer, where it holds more than one row of outputs.
    fn rows(&self) -> Option<Rows> {
        None
    }
    /// Returns the budget of all values together, in addition to those of the outputs.
    fn norm_budget(&self) -> Option<NormBudget> {
        None
    }
    /// Returns the proved bounds of the solver's error.
    fn proved(&self) -> Vec<ProvedBound> {
        Vec::new()
    }
    /// Where it is audited.
    fn domain(&self) -> Domain;
    /// Where in it cases are drawn.
    fn sampling(&self) -> Sampling {
        Sampling::Domain
    }
    /// Calls the code under test.
    fn solve(&self, input: &[f64]) -> SolverAnswer;
    /// The reference at a working precision of `bits`.
    fn reference(&self, input: &[Rational], bits: u32) -> ReferenceAnswer;
    /// The word by which code of the method's kind may refuse an input that has values, for a
    /// reason that is proved to hold there: an algorithm's own limit, which is not the problem's.
    /// By default there is none.
    fn may_refuse(&self, _input: &[Rational]) -> Option<&'static str> {
        None
    }
    /// Returns the expected answer where an input is NaN or infinite: by default a refusal.
    fn reference_not_finite(&self, _input: &[f64]) -> ReferenceAnswer {
        ReferenceAnswer::Refuses("not finite")
    }

    /// For each value that is exactly zero at `input`: whether the function's limit makes it −0;
    /// `None` where there is no such limit. By default no zero has a sign.
    fn signs_of_zero(&self, _input: &[f64]) -> Vec<Option<bool>> {
        Vec::new()
    }

    /// `Σ_j |x_j ∂f_i/∂x_j|` for each value `i`; `None` if unavailable.
    ///
    /// By default one-sided differences of the reference; see [`conditions_by_differences`].
    fn conditions(&self, input: &[f64]) -> Option<Vec<f64>> {
        conditions_by_differences(self, input, |_| true)
    }

    /// [`Method::conditions`] where the reference's answer at `input` is at hand.
    fn conditions_beside(&self, input: &[f64], _reference: &ReferenceAnswer) -> Option<Vec<f64>> {
        self.conditions(input)
    }

    /// Returns the answer of the method's own solver without rounding, in balls, where available:
    /// tells rounding from the error of the method itself.
    fn twin(&self, _input: &[f64]) -> Option<Vec<Ball>> {
        None
    }

    /// The format of the numbers under test.
    fn format(&self) -> Format {
        Format::Double
    }

    /// By which of its formulas the method's own solver computes the values at `input`, and how far
    /// it is to where another takes over; `None` where the solver does not say.
    fn branch(&self, _input: &[f64]) -> Option<BranchAt> {
        None
    }

    /// Returns true if part `k` of the layout is data, which may take any value; if not, it counts
    /// or chooses.
    fn is_data(&self, _k: usize) -> bool {
        true
    }

    /// Hard cases found by earlier hunts, judged in every audit.
    fn hard(&self) -> Vec<HardCase> {
        Vec::new()
    }

    /// Returns true if an input belongs to the domain, beyond what the reference refuses: a hunt
    /// leaves others alone.
    fn admits(&self, _input: &[f64]) -> bool {
        true
    }

    /// Identities of the solver's values.
    fn laws(&self) -> Vec<Law> {
        Vec::new()
    }
}

impl HardCase {
    /// Reads a file of a method's.
    ///
    /// # Errors
    /// Also an output that the method does not have and an input outside of its domain.
    pub fn read_of(method: &dyn Method, text: &str) -> Result<Vec<HardCase>, HardCaseError> {
        let name = method.name();
        let known: Vec<&'static str> = method.outputs().iter().map(|o| o.name).collect();
        HardCase::read_if(text, |case| match case.output.as_str() {
            output if !known.contains(&output) => {
                Err(NoSuch::new(name, "output", output, known.clone()).into())
            }
            _ if !method.admits(&case.input) => Err(HardCaseFault::OutsideDomain(name)),
            _ => Ok(()),
        })
    }
}

/// Estimates `Σ_j |x_j ∂f_i/∂x_j|` from the reference at `x` and at `x` with each `x_j` in turn
/// multiplied by `1 + 2⁻⁸⁰`, or by `1 − 2⁻⁸⁰` where the former is refused, at 320 bits, or at 640
/// or 1280 where the reference is undecided with fewer.
///
/// An estimate: its relative error is of the order of 2⁻⁸⁰ times the second derivative, so that it
/// holds also where the domain ends close by: a linkage may not be assembled any more with a length
/// larger by 2⁻⁴⁰. Inputs for which `is_data` is false (counts, choices) are left alone.
pub fn conditions_by_differences<M: Method + ?Sized>(
    method: &M,
    input: &[f64],
    is_data: impl Fn(usize) -> bool,
) -> Option<Vec<f64>> {
    let exact: Option<Vec<Rational>> = input.iter().map(|&x| Rational::from_f64(x)).collect();
    let x = exact?;
    for bits in [320, 640, 1280] {
        match differences(method, x.clone(), &is_data, bits) {
            Ok(found) => return Some(found),
            Err(Uncertified::Undecided(_)) => {}
            Err(_) => return None,
        }
    }
    None
}

/// [`conditions_by_differences`] at a precision.
fn differences<M: Method + ?Sized>(
    method: &M,
    mut x: Vec<Rational>,
    is_data: impl Fn(usize) -> bool,
    bits: u32,
) -> Result<Vec<f64>, Uncertified> {
    const STEP: u32 = 80;
    let base = method.reference(&x, bits).certified()?;
    let mut sum = vec![Mag::ZERO; base.len()];
    let step = Rational::from(1) >> STEP;
    for j in 0..x.len() {
        if x[j] == 0 || !is_data(j) {
            continue;
        }
        let old = x[j].clone();
        let (mut shifted, mut why) = (None, Uncertified::NoNumber);
        for beside in [Rational::from(1 + &step), Rational::from(1 - &step)] {
            x[j] = Rational::from(&old * &beside);
            match method.reference(&x, bits).certified() {
                Ok(other) if other.len() == sum.len() => {
                    shifted = Some(other);
                    break;
                }
                // More bits may decide this side.
                Err(undecided @ Uncertified::Undecided(_)) => why = undecided,
                _ => {}
            }
        }
        x[j] = old;
        let shifted = shifted.ok_or(why)?;
        for ((s, a), b) in sum.iter_mut().zip(&shifted).zip(&base) {
            let d = Float::with_val(64, a.mid() - b.mid());
            *s = s.add(Mag::above(&d).shift(i64::from(STEP)));
        }
    }
    Ok(sum.into_iter().map(Mag::to_f64).collect())
}

#[cfg(test)]
mod tests;
