//! Conditions of motions: derivatives of the states by the inputs and by their starts.
//!
//! `x_j ∂y/∂x_j` is the difference of two certified motions, of which one has x_j (1 + 2⁻⁶⁰), over
//! 2⁻⁶⁰: its relative error is of the order of 2⁻⁶⁰ times the second derivative, and the balls add
//! less.

use super::trajectories::Trajectories;
use super::{InitialValue, Output, Solution};
use crate::reference::Ball;
use crate::study::problem::Problem;
use mechaudit_symbolic::Expr;
use mechaudit_symbolic::evaluation::{Balls, Evaluator, Goal, InitialValueProblem, Limits, State};
use mechaudit_symbolic::graph::{Graph, Id};
use rug::Rational;

/// Bits of states beside a disturbance.
pub const BITS: u32 = 96;

/// The disturbance: two to the power of minus so many.
const STEP: i32 = 60;

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
        // Starts that a system of equations gives are not disturbed.
        if problem.system.is_some() {
            return None;
        }
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
        let columns = inputs.len();
        let names: Vec<&str> = inputs.iter().map(String::as_str).collect();
        let start = super::number(&of.start);
        let posed =
            InitialValueProblem::new(&problem.definitions, &names, &time.name, &start, &disturbed)
                .ok()?;
        Some(Conditions {
            slopes,
            rates: nodes.iter().map(|n| n.1).collect(),
            disturbed: Trajectories::new(posed, Limits::default()).keeping(columns),
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
        // By column: the derivatives of all states, times the datum.
        let mut by_data: Vec<Vec<f64>> = Vec::new();
        let rest: Vec<Rational> = vec![Rational::new(); self.starts];
        let base: Vec<Rational> = inputs.iter().cloned().chain(rest).collect();
        let step = Rational::from(1) >> STEP;
        for j in 0..base.len() {
            let mut disturbed = base.clone();
            match j < inputs.len() {
                true => disturbed[j] *= Rational::from(1 + &step),
                false => disturbed[j].clone_from(&step),
            }
            let found = match disturbed == base {
                // The derivative is multiplied by zero.
                true => states.to_vec(),
                false => self.disturbed.at(&disturbed, time, Goal::Bits(BITS)).ok()?,
            };
            let pairs = found.iter().zip(states);
            by_data.push(pairs.map(|(a, b)| (a - b).shift(STEP).to_f64()).collect());
        }
        let mut evaluator = Evaluator::new(solution.graph.clone(), Balls::new(64));
        solution.set(&mut evaluator, inputs, time, states, 64);
        let mut node = |id: &Id| -> Option<f64> {
            let value = evaluator.value(*id).ok()?.real()?.to_f64();
            value.is_finite().then_some(value)
        };
        let rates: Vec<f64> = self.rates.iter().map(&mut node).collect::<Option<_>>()?;
        let t = time.to_f64();
        let x: Vec<f64> = inputs.iter().map(Rational::to_f64).collect();
        let state = |i: usize| {
            let by_data = by_data.iter().map(|column| column[i].abs());
            (t * rates[i]).abs() + by_data.sum::<f64>()
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
                    let by_column = by_data.iter().enumerate().map(|(j, column)| {
                        let own = x.get(j).map_or(0.0, |x| x * direct[j]);
                        (own + through(&|i| column[i])).abs()
                    });
                    by_time.abs() + by_column.sum::<f64>()
                }
            });
        }
        Some(found)
    }
}
