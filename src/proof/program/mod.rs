//! Proofs of rounding-error bounds of formulas in floating point.
//!
//! A [`Program`] is a formula of the language of studies, written as a tape of operations;
//! [`prove`] bounds over a domain what its evaluation in binary64 or binary32 is off from the same
//! formula over the reals. It cuts the domain into boxes; over each box `f̂ − f = Σ δ_i ∂f/∂δ_i` by
//! the mean value theorem, with the derivatives in intervals that hold the rounding errors too,
//! after the symbolic Taylor forms of A. Solovyev, M. S. Baranowski, I. Briggs, C. Jacobsen, Z.
//! Rakamarić, G. Gopalakrishnan, *Rigorous estimation of floating-point round-off errors with
//! symbolic Taylor expansions*, ACM TOPLAS 41(1), 2018. The chapter on proofs in the book has every
//! rule.

mod accuracy;
mod bound;
mod elementary;
pub(crate) mod pass;
mod search;
pub(crate) mod tape;
#[cfg(test)]
mod tests;

pub use crate::interval::Interval;
pub use accuracy::Accuracy;
pub use search::{Limits, Proof, ProvedBox, parts, prove};

use mechaudit_symbolic::evaluation::{Elementary, Format};
use mechaudit_symbolic::graph::{Graph, Id};
use tape::{Op, Place, Tape, Writer};

/// Why a formula is no program.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{0}")]
pub struct ProgramError(pub String);

fn refused<T>(why: impl Into<String>) -> Result<T, ProgramError> {
    Err(ProgramError(why.into()))
}

/// How a formula is evaluated.
#[derive(Clone, Copy, Debug, Default)]
pub struct Setting {
    /// The format of all numbers.
    pub format: Format,
    /// Whose elementary functions are taken.
    pub elementary: Elementary,
    /// True if inputs are real numbers, which are rounded to the format first.
    pub round_inputs: bool,
}

impl Setting {
    fn is_single(self) -> bool {
        self.format == Format::Single
    }

    /// The number of significant bits.
    fn bits(self) -> i32 {
        if self.is_single() { 24 } else { 53 }
    }

    /// The exponent of the smallest positive number.
    fn lowest(self) -> i32 {
        if self.is_single() { -149 } else { -1074 }
    }

    fn largest(self) -> f64 {
        if self.is_single() {
            f32::MAX.into()
        } else {
            f64::MAX
        }
    }
}

/// The measure of an error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// `|f̂ − f|`.
    Absolute,
    /// `|f̂ − f|/|f|`.
    Relative,
    /// `|f̂ − f|` in units in the last place of f.
    Ulps,
}

/// A formula as operations over a domain.
#[derive(Clone, Debug)]
pub struct Program {
    setting: Setting,
    domain: Vec<Interval>,
    tape: Tape,
    /// The result, or the real and the imaginary part of a complex one.
    roots: Vec<Place>,
    /// The condition on the inputs.
    condition: Option<(Tape, usize)>,
}

impl Program {
    /// Writes a formula of a graph as operations, or two that are the real and the imaginary part
    /// of a complex result: their error is the absolute value of the complex one.
    ///
    /// The domain holds the least and the largest number of each input in the graph's order, ends
    /// included; the condition narrows it.
    ///
    /// # Errors
    /// An expression without a floating-point operation, a function whose accuracy nobody states, a
    /// loop whose number of rounds is not the same for all inputs, no formula or more than two.
    pub fn new(
        graph: &Graph,
        formulas: &[Id],
        condition: Option<Id>,
        domain: &[Interval],
        setting: Setting,
    ) -> Result<Program, ProgramError> {
        if !matches!(formulas.len(), 1 | 2) {
            return refused("a result has one part or two");
        }
        if formulas.iter().any(|id| graph.is_complex(*id)) {
            return refused("complex arithmetic in floating point");
        }
        let mut writer = Writer::new(graph, setting, domain);
        let roots = formulas.iter().map(|id| writer.value(*id));
        let roots = roots.collect::<Result<_, _>>()?;
        let tape = writer.tape;
        let condition = match condition {
            None => None,
            Some(id) => {
                // Conditions are on the inputs as they are: nothing is rounded but what the same
                // formula rounds, which only widens the set that is kept.
                let mut writer = Writer::new(graph, setting, domain);
                let place = writer.condition(id)?;
                Some((writer.tape, place))
            }
        };
        Ok(Program {
            setting,
            domain: domain.to_vec(),
            tape,
            roots,
            condition,
        })
    }

    /// The same program over a part of its domain.
    pub fn within(&self, domain: Vec<Interval>) -> Program {
        Program {
            domain,
            ..self.clone()
        }
    }

    /// The ends of every input.
    pub fn domain(&self) -> &[Interval] {
        &self.domain
    }

    /// The number of operations that round or may round.
    pub fn operations(&self) -> usize {
        let rounds = |op: &&Op| !matches!(op, Op::Input(_) | Op::Neg(_) | Op::Abs(_) | Op::If(..));
        self.tape.ops.iter().filter(rounds).count()
    }

    /// The elementary functions with their accuracies, each once.
    pub fn functions(&self) -> Vec<(&'static str, Accuracy)> {
        let mut all: Vec<(&'static str, Accuracy)> = Vec::new();
        for op in &self.tape.ops {
            let (name, accuracy) = match op {
                Op::Smooth(f, _, a) => (f.name(), *a),
                Op::Power(.., a) | Op::Pow(.., a) => ("pow", *a),
                Op::Hypot(.., a) => ("hypot", *a),
                Op::Atan2(.., a) => ("atan2", *a),
                _ => continue,
            };
            if all.iter().all(|known| known.0 != name) {
                all.push((name, accuracy));
            }
        }
        all
    }
}
