//! Bounds of a function over a box, by subdivision in balls.

use crate::evaluation::{Balls, Evaluator, Value};
use crate::graph::{Graph, Id};
use crate::{Definitions, Expr, SymbolicError};
use mechaudit_reference::Ball;
use rug::float::{OrdFloat, Special};
use rug::{Float, Rational};
use std::collections::{BinaryHeap, VecDeque};
use std::sync::Arc;

/// A box: names with their ends.
pub type Region = Vec<(String, [Rational; 2])>;

/// Working precision of the enclosures.
const BITS: u32 = 128;
/// Evaluations of one search, a few seconds of a formula of usual length.
const MOST: usize = 100_000;

/// A real function on a box.
#[derive(Clone, Debug)]
pub struct Function {
    graph: Arc<Graph>,
    value: Id,
    region: Vec<[Rational; 2]>,
}

impl Function {
    /// Prepares an expression whose free symbols are those of the box.
    ///
    /// # Errors
    /// An expression without meaning over the real numbers.
    pub fn new(
        definitions: &Definitions,
        e: &Expr,
        region: &Region,
    ) -> Result<Function, SymbolicError> {
        let names = region.iter().map(|r| r.0.clone());
        let mut graph = Graph::new(names).of_real_functions();
        let value = graph.build(definitions, e)?;
        if graph.is_complex(value) || graph.is_condition(value) {
            let reason = format!("{e} is no real number");
            return Err(SymbolicError::Unsupported(reason));
        }
        Ok(Function {
            graph: Arc::new(graph),
            value,
            region: region.iter().map(|r| r.1.clone()).collect(),
        })
    }

    fn evaluator(&self) -> Evaluator<Balls> {
        Evaluator::new(Arc::clone(&self.graph), Balls::new(BITS))
    }

    /// An enclosure of the values on a box; none where one of them may be undefined.
    fn over(&self, evaluator: &mut Evaluator<Balls>, ends: &[[Rational; 2]]) -> Option<Ball> {
        evaluator.reset(false);
        for (k, ends) in ends.iter().enumerate() {
            let [a, b] = ends.each_ref().map(|end| Ball::rational(BITS, end));
            evaluator.set_input(k, Value::Real(a.union(&b)));
        }
        evaluator.value(self.value).ok()?.real().cloned()
    }

    /// Returns true if the function is proved to be positive everywhere.
    pub fn is_positive(&self) -> bool {
        let mut evaluator = self.evaluator();
        // The largest come first: in a box next to a zero the sign stays open at every size.
        let mut open = VecDeque::from([self.region.clone()]);
        for _ in 0..MOST {
            let Some(ends) = open.pop_front() else {
                return true;
            };
            match self.over(&mut evaluator, &ends) {
                Some(value) if value.is_positive() => {}
                Some(value) if value.is_negative() => return false,
                _ => match halves(&ends) {
                    Some(halves) => open.extend(halves),
                    None => return false,
                },
            }
        }
        false
    }

    /// The largest value, in a ball of a radius of at most `within`; none if it is not found.
    pub fn largest(&self, within: f64) -> Option<Ball> {
        let mut evaluator = self.evaluator();
        // Upper bounds of the function with the parts of the box that they hold for.
        let mut heap: BinaryHeap<(OrdFloat, Vec<[Rational; 2]>)> = BinaryHeap::new();
        let mut low: Option<Float> = None;
        let mut open = vec![self.region.clone()];
        for _ in 0..MOST {
            for ends in std::mem::take(&mut open) {
                let bound = self.over(&mut evaluator, &ends);
                let bound = bound.map_or(Float::with_val(BITS, Special::Infinity), |b| b.upper());
                let point = ends.iter().map(middle).map(|m| [m.clone(), m]);
                let value = self.over(&mut evaluator, &point.collect::<Vec<_>>());
                let both = low.into_iter().chain(value.map(|v| v.lower()));
                low = both.max_by(Float::total_cmp);
                heap.push((bound.into(), ends));
            }
            let (bound, ends) = heap.pop()?;
            let high = Float::from(bound);
            if let Some(low) = low.as_ref().filter(|_| high.is_finite()) {
                let ball = Ball::between(BITS, low, &high);
                if ball.rad().to_f64() <= within {
                    return Some(ball);
                }
            }
            open.extend(halves(&ends)?);
        }
        None
    }
}

fn middle([a, b]: &[Rational; 2]) -> Rational {
    Rational::from(a + b) / 2u32
}

/// The halves of a box, cut across its longest side; none of a point.
fn halves(ends: &[[Rational; 2]]) -> Option<[Vec<[Rational; 2]>; 2]> {
    let width = |[a, b]: &[Rational; 2]| Rational::from(b - a);
    let (k, side) = ends
        .iter()
        .enumerate()
        .max_by(|a, b| width(a.1).cmp(&width(b.1)))?;
    if width(side) <= 0 {
        return None;
    }
    let mut halves = [ends.to_vec(), ends.to_vec()];
    halves[0][k][1] = middle(side);
    halves[1][k][0] = middle(side);
    Some(halves)
}
