//! Conditions of motions: derivatives of the states by the inputs and by their starts, which the
//! variational equation gives in balls.

use super::{Output, Solution};
use crate::reference::{Ball, Mag};
use crate::study::problem::Problem;
use mechaudit_symbolic::evaluation::{Balls, Evaluator};
use mechaudit_symbolic::graph::{Graph, Id};
use rug::Rational;

/// The nodes that conditions are made of.
pub struct Conditions {
    /// For each output that is an expression, `∂f/∂x_j` by inputs, time and states.
    slopes: Vec<Vec<Id>>,
    rates: Vec<Id>,
}

impl Conditions {
    /// Derives the outputs; there are no conditions where the language has no derivative.
    pub fn new(
        problem: &Problem,
        graph: &mut Graph,
        outputs: &[Output],
        nodes: &[(Id, Id)],
    ) -> Option<Conditions> {
        // Starts that a system of equations gives have no derivatives.
        if problem.system.is_some() {
            return None;
        }
        let mut slopes = Vec::new();
        for output in outputs {
            let leaves: Vec<Id> = match output {
                Output::State(_) => Vec::new(),
                Output::Expression(_) => {
                    (0..graph.inputs().len()).map(|k| graph.input(k)).collect()
                }
            };
            let row = leaves.into_iter().map(|leaf| match output {
                Output::Expression(id) => graph.derivative(*id, leaf).ok(),
                Output::State(_) => None,
            });
            slopes.push(row.collect::<Option<_>>()?);
        }
        let rates = nodes.iter().map(|n| n.1).collect();
        Some(Conditions { slopes, rates })
    }

    /// The condition of each output; none where a ball is too wide for its leading bits.
    pub fn values(
        &self,
        solution: &Solution,
        inputs: &[Rational],
        time: &Rational,
    ) -> Option<Vec<f64>> {
        const BITS: u32 = 64;
        /// Bits of a condition, or of the value beside which it is small.
        const ACCURACY: i64 = 10;
        let found = solution.trajectories.derivatives(inputs, time).ok()?;
        let mut evaluator = Evaluator::new(solution.graph.clone(), Balls::new(BITS));
        solution.set(&mut evaluator, inputs, time, &found.states, BITS);
        let mut node = |id: &Id| evaluator.value(*id).ok()?.real().cloned();
        let rates: Vec<Ball> = self.rates.iter().map(&mut node).collect::<Option<_>>()?;
        let exact = |x: &Rational| Ball::rational(BITS, x);
        // For each datum that is not zero: its value, its place among the leaves of the graph, and
        // the derivatives of all states.
        let mut data: Vec<(Ball, Option<usize>, Vec<&Ball>)> = Vec::new();
        for (j, x) in inputs.iter().enumerate() {
            let column = found.by_inputs.iter().map(|row| &row[j]);
            data.push((exact(x), Some(j), column.collect()));
        }
        for (k, y) in found.starts.iter().enumerate() {
            let column = found.by_starts.iter().map(|row| &row[k]);
            data.push((y.clone(), None, column.collect()));
        }
        data.push((exact(time), Some(inputs.len()), rates.iter().collect()));
        data.retain(|datum| !datum.0.is_zero());
        let mut conditions = Vec::new();
        for (output, slopes) in solution.outputs.iter().zip(&self.slopes) {
            let slopes: Vec<Ball> = slopes.iter().map(&mut node).collect::<Option<_>>()?;
            // A value that is not defined may have a condition.
            let value = match output {
                Output::State(i) => Some(found.states[*i].clone()),
                Output::Expression(id) => node(id),
            };
            let value = value.map_or(Mag::ZERO, |value| value.mignitude());
            let mut sum = Ball::integer(BITS, 0);
            for (x, leaf, column) in &data {
                let slope = match output {
                    Output::State(i) => column[*i].clone(),
                    Output::Expression(_) => {
                        let (direct, by_states) = slopes.split_at(inputs.len() + 1);
                        let direct = leaf.map_or(Ball::integer(BITS, 0), |k| direct[k].clone());
                        let terms = by_states.iter().zip(column).map(|(s, y)| s * *y);
                        terms.fold(direct, |sum, term| sum + term)
                    }
                };
                sum = sum + (x * &slope).abs();
            }
            let size = sum.mignitude().max(value);
            if sum.rad() > size.shift(-ACCURACY).max(Mag::power_of_two(-1000)) {
                return None;
            }
            conditions.push(sum.to_f64());
        }
        Some(conditions)
    }
}
