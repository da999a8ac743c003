//! Evidence beside a proof: the worst input that a hunt finds.

use super::places::places;
use crate::cli::args::ProveArgs;
use crate::cli::failure::Failure;
use crate::cli::process::interrupt;
use mechaudit::audit::{HuntSettings, Method, SolverAnswer, Worst, hunt_from};
use mechaudit::proof::program::{Measure, Proof};
use mechaudit::study::proof::limit;
use mechaudit::study::{Problem, Study};
use mechaudit::symbolic::evaluation::{Answer, Goal};
use rug::{Float, Rational};

/// The largest error that the hunt finds.
#[derive(Clone, Debug)]
pub struct Found {
    /// The error in the measure asked for.
    pub error: f64,
    /// Where.
    pub input: Vec<f64>,
}

/// The largest error that a hunt finds at numbers of the format.
pub fn worst(
    own: &Problem,
    measure: Measure,
    proof: &Proof,
    args: &ProveArgs,
) -> Result<Option<Found>, Failure> {
    let bound = proof.bound;
    if args.evals == 0 || bound == 0.0 {
        return Ok(None);
    }
    let unit = if bound.is_finite() { bound } else { 1.0 };
    let is_complex = own.outputs.len() > 1;
    let mut problem = own.clone();
    for output in &mut problem.outputs {
        // A part of a complex number may be zero.
        let measure = if is_complex {
            Measure::Absolute
        } else {
            measure
        };
        output.budget = (limit(measure, unit), "the proved bound".into());
    }
    let study = Study::new(problem).map_err(Failure::caused)?;
    let settings = HuntSettings {
        evaluations: args.evals,
        seed: 1,
    };
    let given = places(&study, proof);
    let found = hunt_from(&study, &settings, &given, &|_| {}, interrupt::flag());
    let each = found
        .worst
        .into_iter()
        .filter_map(|Worst { share, input, .. }| {
            let error = match is_complex {
                true => norm(&study, measure, &input)?,
                false => share * unit,
            };
            Some(Found { error, input })
        });
    Ok(each.max_by(|a, b| a.error.total_cmp(&b.error)))
}

/// The error of two outputs as one complex number at an input.
fn norm(study: &Study, measure: Measure, input: &[f64]) -> Option<f64> {
    let exact: Option<Vec<Rational>> = input.iter().map(|x| Rational::from_f64(*x)).collect();
    let SolverAnswer::Values(computed) = study.solve(input) else {
        return None;
    };
    let (mut error, mut size) = (0.0f64, 0.0f64);
    for (answer, x) in study
        .answers(&exact?, Goal::Double(72))
        .iter()
        .zip(computed)
    {
        let due = match answer {
            Answer::Number(ball) => ball.mid().clone(),
            Answer::Zero => Float::new(64),
            _ => return None,
        };
        size = size.hypot(due.to_f64());
        error = error.hypot((due - x).to_f64());
    }
    Some(match measure {
        Measure::Absolute => error,
        _ => error / size,
    })
    .filter(|e| e.is_finite())
}
