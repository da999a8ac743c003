//! Conditions of motions, by the variational equation.

use super::trajectories::Trajectories;
use super::{InitialValue, Output, Solution};
use crate::reference::Ball;
use crate::study::problem::Problem;
use mechaudit_symbolic::Expr;
use mechaudit_symbolic::evaluation::{Balls, Evaluator, InitialValueProblem, Limits, State};
use mechaudit_symbolic::graph::{Graph, Id};
use rug::Rational;

/// Bits of derivatives.
pub const BITS: u32 = 24;

/// The derivatives that conditions are made of.
pub struct Conditions {
    /// For each output that is an expression, `∂f/∂x_j` by inputs, time and states.
    slopes: Vec<Vec<Id>>,
    rates: Vec<Id>,
    /// The problem whose inputs are those of the study and a relative disturbance of each start, at
    /// which all are zero.
    disturbed: Trajectories,
    starts: usize,
}

impl Conditions {
    /// Derives the outputs; there are no conditions where the language has no derivative.
    pub fn new(
        problem: &Problem,
        of: &InitialValue,
        graph: &mut Graph,
        outputs: &[Output],
        nodes: &[(Id, Id)],
    ) -> Option<Conditions> {
        let leaves = graph.inputs().len();
        let mut slopes = Vec::new();
        for output in outputs {
            slopes.push(match output {
                Output::State(_) => Vec::new(),
                Output::Expression(id) => {
                    let mut row = Vec::new();
                    for k in 0..leaves {
                        let leaf = graph.input(k);
                        row.push(graph.derivative(*id, leaf).ok()?);
                    }
                    row
                }
            });
        }
        let zero = Expr::Num("0".into());
        // A start that is zero has no relative disturbance.
        let starts: Vec<&State> = of.states.iter().filter(|s| s.start != zero).collect();
        // No name of a file has a blank in it.
        let disturbance = |s: &State| format!("disturbance of {}", s.name);
        let disturbed = of.states.iter().map(|s| {
            let start = match s.start == zero {
                true => s.start.clone(),
                false => {
                    let factor = vec![Expr::Num("1".into()), Expr::Sym(disturbance(s))];
                    Expr::Mul(vec![s.start.clone(), Expr::Add(factor)])
                }
            };
            State::new(s.name.clone(), start, s.rate.clone())
        });
        let disturbed: Vec<State> = disturbed.collect();
        let (time, own) = problem.inputs.split_last()?;
        let own = own.iter().map(|i| i.name.clone());
        let inputs: Vec<String> = own.chain(starts.iter().map(|s| disturbance(s))).collect();
        let names: Vec<&str> = inputs.iter().map(String::as_str).collect();
        let start = super::number(&of.start);
        let posed =
            InitialValueProblem::new(&problem.definitions, &names, &time.name, &start, &disturbed)
                .ok()?;
        Some(Conditions {
            slopes,
            rates: nodes.iter().map(|n| n.1).collect(),
            disturbed: Trajectories::new(posed, Limits::default()),
            starts: starts.len(),
        })
    }

    /// Sets the highest working precision in bits.
    pub fn set_limit(&mut self, bits: u32) {
        self.disturbed.set_limit(bits);
    }

    /// The condition of each output.
    pub fn values(
        &self,
        solution: &Solution,
        inputs: &[Rational],
        time: &Rational,
        states: &[Ball],
    ) -> Option<Vec<f64>> {
        let zeros = std::iter::repeat_n(Rational::new(), self.starts);
        let all: Vec<Rational> = inputs.iter().cloned().chain(zeros).collect();
        let by_inputs = self.disturbed.sensitivities(&all, time, BITS).ok()?;
        let mut evaluator = Evaluator::new(solution.graph.clone(), Balls::new(64));
        solution.set(&mut evaluator, inputs, time, states, 64);
        let mut node = |id: &Id| -> Option<f64> {
            let value = evaluator.value(*id).ok()?.real()?.to_f64();
            value.is_finite().then_some(value)
        };
        let rates: Vec<f64> = self.rates.iter().map(&mut node).collect::<Option<_>>()?;
        let (x, t): (Vec<f64>, f64) =
            (inputs.iter().map(Rational::to_f64).collect(), time.to_f64());
        let by_inputs: Vec<Vec<f64>> = by_inputs
            .iter()
            .map(|row| row.iter().map(Ball::to_f64).collect())
            .collect();
        // A disturbance is relative already.
        let scale = |j: usize| x.get(j).copied().unwrap_or(1.0);
        let state = |i: usize| {
            let row = by_inputs[i].iter().enumerate();
            (t * rates[i]).abs() + row.map(|(j, d)| (scale(j) * d).abs()).sum::<f64>()
        };
        let mut found = Vec::new();
        for (output, slopes) in solution.outputs.iter().zip(&self.slopes) {
            found.push(match output {
                Output::State(i) => state(*i),
                Output::Expression(_) => {
                    let slopes: Vec<f64> = slopes.iter().map(&mut node).collect::<Option<_>>()?;
                    let (direct, by_states) = slopes.split_at(x.len() + 1);
                    let through = |of: &dyn Fn(usize) -> f64| -> f64 {
                        by_states.iter().enumerate().map(|(i, s)| s * of(i)).sum()
                    };
                    let by_time = t * (direct[x.len()] + through(&|i| rates[i]));
                    let columns = 0..x.len() + self.starts;
                    let by_column = columns.map(|j| {
                        let own = if j < x.len() { direct[j] } else { 0.0 };
                        (scale(j) * (own + through(&|i| by_inputs[i][j]))).abs()
                    });
                    by_time.abs() + by_column.sum::<f64>()
                }
            });
        }
        Some(found)
    }
}
