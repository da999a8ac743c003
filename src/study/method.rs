//! A study as a method.

use super::Study;
use super::compiled::FloatSolver;
use super::linear;
use super::problem::{intern, kept};
use super::sampling::admits;
use crate::audit::Limit;
use crate::audit::{
    Budget, Domain, Expected, Format, Input, Method, Output, Proof, ProvedBound, ProvedError,
    ReferenceAnswer, Rows, SolverAnswer, Uncertified, conditions_by_differences,
};
use crate::methods::{CertifiedValue, Evaluable};
use crate::reference::faddeeva::Scaled;
use crate::reference::{Ball, nearest_f64};
use mechaudit_symbolic::evaluation::{self, Answer, Goal};
use rug::Rational;

/// Reason to believe the references of studies.
const PROOF: Proof = Proof::Bounded(
    "balls with proved radii at a precision that is raised until the value is decided",
);

/// Bits of references beyond those of the numbers that are judged.
const GUARD: u32 = 48;

impl Method for Study {
    fn name(&self) -> &'static str {
        self.name
    }

    fn summary(&self) -> &'static str {
        intern(&self.problem().title)
    }

    fn source(&self) -> &'static str {
        intern(&self.problem().source)
    }

    /// The name without the path: a file that is moved keeps its cases.
    fn stream(&self) -> &'static str {
        intern(&self.problem().name)
    }

    fn remarks(&self) -> Vec<String> {
        self.problem().notes.clone()
    }

    fn inputs(&self) -> Vec<Input> {
        if let Some(linear) = &self.problem().linear {
            let units = self.problem().inputs.iter().map(|i| intern(&i.unit));
            return linear.inputs(&units.collect::<Vec<_>>());
        }
        let inputs = self.problem().given().iter();
        let input = |i: &super::StudyInput| Input {
            name: intern(&i.name),
            unit: intern(&i.unit),
        };
        inputs.map(input).collect()
    }

    fn outputs(&self) -> Vec<Output> {
        let outputs = self.problem().outputs.iter().zip(self.proved.iter());
        let output = |(o, proved): (&super::StudyOutput, &Option<Limit>)| Output {
            name: intern(&o.name),
            unit: intern(&o.unit),
            budget: match proved {
                Some(limit) => Budget::new(
                    *limit,
                    "proved of the file's solver for every input of the domain",
                ),
                None => kept(&o.budget),
            },
        };
        outputs.map(output).collect()
    }

    fn proved(&self) -> Vec<ProvedBound> {
        let Some(solver) = self.problem().solvers.get(self.chosen) else {
            return Vec::new();
        };
        let command = format!("mechaudit prove {} --solver {}", self.name, solver.name);
        let outputs = self.problem().outputs.iter().zip(self.proved.iter());
        let bound = |(o, proved): (&super::StudyOutput, &Option<Limit>)| {
            Some(ProvedBound {
                error: match (*proved)? {
                    Limit::Ulps(k) => ProvedError::Ulps(k),
                    Limit::Relative(r) => ProvedError::Relative(r),
                    other => ProvedError::Absolute(other.factor()),
                },
                inputs: intern(&format!("{} at every input of the domain", o.name)),
                command: intern(&command),
            })
        };
        outputs.filter_map(bound).collect()
    }

    fn rows(&self) -> Option<Rows> {
        let times = self.problem().times();
        if !times.is_empty() {
            return Some(Rows {
                index: "k",
                count: intern(&times.len().to_string()),
                meaning: "time",
            });
        }
        self.problem().linear.as_ref()?.rows()
    }

    fn domain(&self) -> Domain {
        self.domain.clone()
    }

    fn solve(&self, input: &[f64]) -> SolverAnswer {
        let Some(solver) = self.solvers.get(self.chosen) else {
            return SolverAnswer::Declines(None);
        };
        if input.len() != self.problem().given().len() {
            return SolverAnswer::Refuses("bad layout");
        }
        let rows = self.problem().of_rows(input, nearest_f64);
        let values: Result<Vec<Vec<f64>>, _> = rows.iter().map(|row| solver.values(row)).collect();
        match values {
            Ok(values) => SolverAnswer::Values(values.concat()),
            Err(reason) => SolverAnswer::Refuses(reason),
        }
    }

    fn reference(&self, input: &[Rational], bits: u32) -> ReferenceAnswer {
        if let Some(linear) = &self.problem().linear {
            return linear.reference(input, bits);
        }
        if input.len() != self.problem().given().len() {
            return ReferenceAnswer::Refuses("bad layout");
        }
        let is_before = self.compiled.motion.as_ref().is_some_and(|motion| {
            let rows = self.problem().of_rows(input, Rational::clone);
            rows.iter().any(|row| motion.is_before_start(row))
        });
        if is_before {
            return ReferenceAnswer::Refuses("before the start");
        }
        let goal = Goal::Double(bits.saturating_sub(GUARD).max(72));
        let mut values = Vec::new();
        for answer in self.answers(input, goal) {
            values.push(match answer {
                Answer::Number(ball) => Expected::Number(ball),
                Answer::Zero => Expected::Number(Ball::integer(64, 0)),
                Answer::Huge { negative } => Expected::Infinity { negative },
                Answer::Undefined { .. } => Expected::NotANumber,
                Answer::Undecided(why) => return ReferenceAnswer::Undecided(why.to_string()),
            });
        }
        ReferenceAnswer::Expected(values, PROOF)
    }

    fn conditions(&self, input: &[f64]) -> Option<Vec<f64>> {
        let exact: Option<Vec<Rational>> = input.iter().map(|x| Rational::from_f64(*x)).collect();
        if let Some(linear) = &self.problem().linear {
            return linear::conditions(linear, &exact?);
        }
        let exact = exact.filter(|x| x.len() == self.problem().given().len())?;
        let rows = self.problem().of_rows(&exact, Rational::clone);
        let found = rows.iter().map(|row| self.compiled.conditions(row));
        let found = found.collect::<Option<Vec<_>>>().map(|rows| rows.concat());
        // The conditions of a motion are proved, or there are none.
        match self.compiled.motion.is_some() {
            true => found,
            false => found.or_else(|| conditions_by_differences(self, input, |_| true)),
        }
    }

    fn format(&self) -> Format {
        format(self.solvers.get(self.chosen))
    }

    fn admits(&self, input: &[f64]) -> bool {
        match &self.problem().linear {
            Some(linear) => linear::sampling::admits(self.problem(), linear, input),
            None => admits(self.problem(), &self.sketch, input),
        }
    }
}

/// The format of a solver; binary64 without one.
pub(super) fn format(solver: Option<&FloatSolver>) -> Format {
    match solver.map(FloatSolver::format) {
        Some(evaluation::Format::Single) => Format::Single,
        _ => Format::Double,
    }
}

impl Evaluable for Study {
    fn certify(&self, numbers: &[Rational], bits: u32) -> Result<Vec<Scaled>, Uncertified> {
        if let Some(linear) = &self.problem().linear {
            let values = linear.certify(numbers, bits)?;
            return Ok(values.into_iter().map(Scaled::from).collect());
        }
        let answers = self.answers(numbers, Goal::Bits(bits)).into_iter();
        let value = |answer: Answer| match answer {
            Answer::Number(ball) => Ok(ball.into()),
            Answer::Zero => Ok(Ball::integer(64, 0).into()),
            Answer::Undecided(why) => Err(Uncertified::Undecided(why.to_string())),
            Answer::Huge { .. } | Answer::Undefined { .. } => Err(Uncertified::NoNumber),
        };
        answers.map(value).collect()
    }

    fn refusal(&self, numbers: &[f64]) -> Option<String> {
        if let Some(motion) = &self.compiled.motion {
            let rows = self.problem().of_rows(numbers, nearest_f64);
            return rows.iter().find_map(|row| motion.refusal(*row.last()?));
        }
        self.problem().linear.as_ref()?.refusal(numbers.len())
    }

    fn explanation(&self, numbers: &[f64]) -> Option<String> {
        let exact: Option<Vec<Rational>> = numbers.iter().map(|x| Rational::from_f64(*x)).collect();
        let outputs = self.problem().outputs.iter();
        let answers = self.answers(&exact?, Goal::Double(72));
        let reasons = outputs.cycle().zip(answers).filter_map(|(output, answer)| {
            let Answer::Undefined { reason, place } = answer else {
                return None;
            };
            Some(format!("{} is undefined: {reason}: {place}", output.name))
        });
        let reasons = reasons.collect::<Vec<_>>().join("; ");
        Some(reasons).filter(|reasons| !reasons.is_empty())
    }

    fn digits(&self, numbers: &[Rational], digits: u32) -> Option<Vec<CertifiedValue>> {
        // Digits of linear problems follow from certified balls, and refusals say why.
        let is_linear = self.problem().linear.is_some();
        (!is_linear).then(|| Study::digits(self, numbers, digits))
    }

    fn has_solver(&self) -> bool {
        !self.solvers.is_empty()
    }

    fn select_solver(&mut self, name: &str) -> Result<(), String> {
        *self = self.clone().with_solver(name).map_err(|e| e.to_string())?;
        Ok(())
    }
}
