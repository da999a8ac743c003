//! The chirp-forced oscillator.

use super::chirp_regions as regions;
use crate::audit::{
    Budget, Domain, Input, Law, Limit, Method, Output, Proof, Reference, ReferenceAnswer,
    SolverAnswer,
};
use crate::reference::chirp_oscillator::{Problem, conditions, enclose};
use crate::solvers::chirp_oscillator::{
    Chirp, ChirpError, ChirpResponse, Excitation, Forcing, Harmonic, InitialState, Oscillator,
};
use rug::Rational;

/// Input `w, n, eps, omega0, k, delta, y0, v0, t`, output `y, v, a, Re A, Im A`.
pub struct Audit;

const REASON: &str = "each part is of the size of the result or smaller and takes a few roundings of \
    its own; the divided difference over roots half their distance apart costs four of them, and the \
    sum of forced part, free vibration and passages another";

/// The values of the code under test.
pub(super) fn values(input: &[f64]) -> Result<Vec<f64>, ChirpError> {
    let [w, n, eps, omega0, k, delta, y0, v0, t] = input.try_into().expect("nine inputs");
    let excitation = Excitation {
        chirp: Chirp { omega0, eps },
        forcing: Forcing::Displacement,
        static_term: 0.0,
        harmonics: vec![Harmonic {
            k,
            amplitude: 1.0,
            phase: delta,
        }],
    };
    let initial = InitialState {
        displacement: y0,
        velocity: v0,
    };
    let response = ChirpResponse::new(Oscillator::new(w, n)?, excitation, initial)?;
    let m = response.motion(t)?;
    let a = response.harmonic(0, t)?.amplitude;
    Ok(vec![m.displacement, m.velocity, m.acceleration, a.re, a.im])
}

fn problem(input: &[Rational]) -> Result<Problem, &'static str> {
    let values: &[Rational; 9] = input.try_into().map_err(|_| "layout")?;
    Problem::new(values).map_err(|e| e.name())
}

impl Method for Audit {
    fn name(&self) -> &'static str {
        "chirp-response"
    }

    fn summary(&self) -> &'static str {
        "damped oscillator forced by a harmonic of linearly changing frequency"
    }

    fn source(&self) -> &'static str {
        "Gembara & Senyk (9), (10), (15), (18) with the corrections of their ledger; DLMF 7.2.3, 7.12.1"
    }

    fn inputs(&self) -> Vec<Input> {
        let input = |name, unit| Input { name, unit };
        vec![
            input("w", "rad/s"),
            input("n", "rad/s"),
            input("eps", "rad/s^2"),
            input("omega0", "rad/s"),
            input("k", "1"),
            input("delta", "rad"),
            input("y0", "m"),
            input("v0", "m/s"),
            input("t", "s"),
        ]
    }

    fn outputs(&self) -> Vec<Output> {
        let output = |name, unit| Output {
            name,
            unit,
            budget: Budget::new(Limit::Conditioned(20.0), REASON),
        };
        vec![
            output("y", "m"),
            output("v", "m/s"),
            output("a", "m/s^2"),
            output("Re A", "m"),
            output("Im A", "m"),
        ]
    }

    fn domain(&self) -> Domain {
        Domain {
            regions: regions::all(),
            check_points: regions::check_points(),
        }
    }

    fn solve(&self, input: &[f64]) -> SolverAnswer {
        match values(input) {
            Ok(values) => SolverAnswer::Values(values),
            Err(e) => SolverAnswer::Refuses(e.name()),
        }
    }

    fn reference(&self, input: &[Rational], bits: u32) -> ReferenceAnswer {
        let problem = match problem(input) {
            Ok(problem) => problem,
            Err(name) => return ReferenceAnswer::Refuses(name),
        };
        let r = enclose(&problem, bits);
        ReferenceAnswer::Values(Reference {
            values: r.components().map(Clone::clone).to_vec(),
            proof: Proof::Bounded(
                "closed form with the certified Faddeeva function in ball arithmetic",
            ),
        })
    }

    fn conditions(&self, input: &[f64]) -> Option<Vec<f64>> {
        let exact: Option<Vec<Rational>> = input.iter().map(|&x| Rational::from_f64(x)).collect();
        Some(conditions(&problem(&exact?).ok()?)?.to_vec())
    }

    fn laws(&self) -> Vec<Law> {
        Vec::new()
    }
}
