//! Proofs of rounding-error bounds of the solvers that studies state.

pub mod same;

use super::error::StudyError;
use super::problem::{Problem, StudyInput, StudySolver};
use crate::audit::{Limit, rounded_up};
use mechaudit_proof::Watch;
use mechaudit_proof::program::{Interval, Limits, Measure, Program, Setting, prove};
use mechaudit_symbolic::evaluation::Format;
use mechaudit_symbolic::graph::Graph;
use mechaudit_symbolic::{Definitions, Expr};
use rug::float::Round;
use rug::{Float, Rational};

/// Boxes for a bound that is a budget: about a second.
const BOXES: u64 = 2_000;

impl Problem {
    /// The solver's formula of an output as a program of the proof, or of two outputs that are the
    /// real and the imaginary part of one result. Numbers beyond `within` in magnitude are left
    /// out.
    ///
    /// # Errors
    /// A problem that has no formulas, and a formula that the proof does not take.
    pub fn program(
        &self,
        solver: &StudySolver,
        outputs: &[usize],
        setting: Setting,
        within: Option<f64>,
    ) -> Result<Program, StudyError> {
        if self.linear.is_some() || self.system.is_some() || self.initial_value.is_some() {
            return Err(StudyError::new(
                "only studies of formulas have a proof: this is one of linear algebra, of a system or of a motion",
            ));
        }
        let names = outputs.iter().map(|k| self.outputs[*k].name.as_str());
        let names = names.collect::<Vec<_>>().join(", ");
        let refused = |e: &dyn std::fmt::Display| StudyError::new(format!("{names}: {e}"));
        let mut graph = Graph::new(self.inputs.iter().map(|i| i.name.clone()));
        let mut build = |definitions: &Definitions, e: &Expr| {
            graph.build(definitions, e).map_err(|e| refused(&e))
        };
        let formulas = outputs
            .iter()
            .map(|k| build(&solver.definitions, &solver.formulas[*k]));
        let formulas = formulas.collect::<Result<Vec<_>, _>>()?;
        let condition = self.condition.as_ref();
        let condition = condition
            .map(|c| build(&self.definitions, &c.is))
            .transpose()?;
        let domain = self.inputs.iter().map(|i| range(i, setting, within));
        let domain = domain.collect::<Result<Vec<_>, _>>()?;
        Program::new(&graph, &formulas, condition, &domain, setting).map_err(|e| refused(&e))
    }

    /// The proved bound of each output of a solver whose budget is a proof: in units in the last place,
    /// where there is no such bound of the relative error, and else of the absolute one.
    ///
    /// # Errors
    /// No solver, and an output without a bound.
    pub(super) fn proved(&self, solver: usize) -> Result<Vec<Option<Limit>>, StudyError> {
        let of = |(k, output): (usize, &super::StudyOutput)| {
            let Some(place) = output.proved else {
                return Ok(None);
            };
            let fault = |why: String| StudyError::new(why).at(place);
            let Some(solver) = self.solvers.get(solver) else {
                return Err(fault(
                    "budget = \"proved\" needs a [solver.NAME] in the file".into(),
                ));
            };
            let program = self.program(solver, &[k], solver.setting(), None);
            let program = program.map_err(|e| e.at(place))?;
            let mut why = None;
            for measure in [Measure::Ulps, Measure::Relative, Measure::Absolute] {
                let limits = Limits {
                    boxes: BOXES,
                    target: 0.0,
                };
                let found = prove(&program, measure, &limits, &Watch::default());
                let Some(found) = found else { continue };
                if let Some(bound) = found.proved() {
                    // Readable, and of a formula that is exact a bound all the same.
                    let bound = rounded_up(bound * (1.0 + 1e-9)).max(f64::MIN_POSITIVE);
                    return Ok(Some(limit(measure, bound)));
                }
                why = found.at.and_then(|at| at.why);
            }
            let why = why.unwrap_or("the limit ended it");
            Err(fault(format!(
                "{}: budget = \"proved\": nothing is proved: {why}",
                output.name
            )))
        };
        self.outputs.iter().enumerate().map(of).collect()
    }
}

impl StudySolver {
    /// How its formulas are evaluated.
    pub fn setting(&self) -> Setting {
        Setting {
            format: self.format,
            elementary: self.elementary,
            round_inputs: false,
        }
    }
}

/// The limit that a bound of a measure is.
pub fn limit(measure: Measure, bound: f64) -> Limit {
    match measure {
        Measure::Absolute => Limit::Absolute(bound),
        Measure::Relative => Limit::Relative(bound),
        Measure::Ulps => Limit::Ulps(bound),
    }
}

/// The numbers of the format between the ends of an input; the reals, if inputs are rounded.
fn range(
    input: &StudyInput,
    setting: Setting,
    within: Option<f64>,
) -> Result<Interval, StudyError> {
    let single = setting.format == Format::Single;
    let largest = if single {
        f64::from(f32::MAX)
    } else {
        f64::MAX
    };
    let largest = within.map_or(largest, |w| w.min(largest));
    let end = |q: &Option<Rational>, outside: f64, up: bool| {
        let Some(q) = q else { return outside };
        // Inward to a number of the format, or outward to one where inputs are real.
        let way = if up == setting.round_inputs {
            Round::Up
        } else {
            Round::Down
        };
        let bits = if single && !setting.round_inputs {
            24
        } else {
            53
        };
        Float::with_val_round(bits, q, way).0.to_f64_round(way)
    };
    let (from, to) = (
        end(&input.from, -largest, false),
        end(&input.to, largest, true),
    );
    // Below the normal numbers of binary32 there are fewer bits.
    let (from, to) = match single && !setting.round_inputs {
        true => {
            let (p, q) = (from as f32, to as f32);
            let p = if f64::from(p) < from { p.next_up() } else { p };
            let q = if f64::from(q) > to { q.next_down() } else { q };
            (f64::from(p), f64::from(q))
        }
        false => (from, to),
    };
    let (from, to) = (from.max(-largest), to.min(largest));
    if !(from <= to) {
        return Err(StudyError::new(format!(
            "no number of the format lies in the range of {}",
            input.name
        )));
    }
    Ok(Interval::new(from, to))
}

#[cfg(test)]
mod tests;
