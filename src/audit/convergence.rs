//! Where the error of an approximation comes from, and how fast it falls.
//!
//! An approximation differs from the truth by its *method error* (truncation, step, interpolation)
//! and by *rounding*. A **twin**, the same algorithm without rounding, tells them apart: the method
//! error is twin less truth, the rounding error is value less twin. Bounds come from balls.

use super::answer::{SolverAnswer, Uncertified};
use super::ulp::{Format, distance};
use mechaudit_reference::{Ball, Mag};
use serde::Serialize;

/// A numerical approximation with a refinement, a twin where there is one, and the truth.
///
/// Values belong to outputs cyclically: value `i` to output `i mod outputs.len()`.
pub trait Approximation: Send + Sync {
    /// The name used on the command line.
    fn name(&self) -> &'static str;
    /// One line in plain words.
    fn summary(&self) -> &'static str;
    /// Returns the quantity counted as work: deterministic, the same on every machine.
    fn work_unit(&self) -> &'static str;
    /// The outputs with the order that theory promises, in powers of one over the work, if it does.
    fn outputs(&self) -> Vec<(&'static str, Option<f64>)>;
    /// The places where values are compared, in words; an error is the largest of them.
    fn places(&self) -> String;
    /// The names of the refinements, coarse to fine.
    fn levels(&self) -> Vec<String>;
    /// Returns true if the work grows by the same factor from level to level, so that orders can be
    /// observed between two of them.
    fn is_regular(&self) -> bool {
        true
    }
    /// The code under test at a level: the work done and the values.
    fn run(&self, level: usize) -> (u64, SolverAnswer);
    /// The same algorithm in arithmetic without rounding, or with much less and a bound on it.
    fn twin(&self, _level: usize) -> Option<Vec<Ball>> {
        None
    }
    /// The twin with every step cut in two: shows the order where the steps are chosen by the code
    /// under test and differ from level to level.
    fn twin_of_half_steps(&self, _level: usize) -> Option<Vec<Ball>> {
        None
    }
    /// The truth.
    ///
    /// # Errors
    /// The reason why it is unavailable.
    fn truth(&self) -> Result<Vec<Ball>, Uncertified>;
}

/// Errors of one output at one level, the largest over its values, as upper bounds at the places
/// of the report.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct LevelError {
    /// `|value − truth|`.
    pub total: f64,
    /// `|twin − truth|`.
    pub method: Option<f64>,
    /// `|value − twin|`.
    pub rounding: Option<f64>,
    /// Observed order: `log(e₁/e₂) / log(work₂/work₁)` against the level before, of the method
    /// error where there is a twin and of the total otherwise. Where steps can be cut in two,
    /// `log₂` of the method error before and after that.
    pub order: Option<f64>,
    /// The order that the values alone show (Richardson), `log(|v₀−v₁|/|v₁−v₂|)/log(work₂/work₁)`
    /// with the two levels before, where the work grows by the same factor each time.
    pub richardson: Option<f64>,
}

/// One level of a refinement.
#[derive(Clone, Debug, Serialize)]
pub struct LevelReport {
    /// Its name.
    pub level: String,
    /// The work done.
    pub work: u64,
    /// The reason why there are no values, if there are none.
    pub failed: Option<String>,
    /// One entry for each output; empty for a failed run.
    pub errors: Vec<LevelError>,
}

/// A refinement with its errors: the data of a work-precision diagram.
#[derive(Clone, Debug, Serialize)]
pub struct ConvergenceReport {
    /// The approximation.
    pub name: &'static str,
    /// In plain words.
    pub summary: &'static str,
    /// The quantity counted as work.
    pub work_unit: &'static str,
    /// The places where values are compared, in words; an error is the largest of them.
    pub places: String,
    /// The outputs.
    pub outputs: Vec<&'static str>,
    /// The orders promised.
    pub orders: Vec<Option<f64>>,
    /// The orders that all levels together show: minus the slope of the least-squares line through
    /// the logarithms of error and work.
    pub fitted: Vec<Option<f64>>,
    /// The levels.
    pub levels: Vec<LevelReport>,
}

/// The result of a level, for the levels after it.
struct Level {
    work: f64,
    values: Vec<f64>,
    leading: Vec<f64>,
}

/// Runs every level of an approximation.
///
/// # Errors
/// The true value is unavailable.
pub fn convergence(of: &dyn Approximation) -> Result<ConvergenceReport, Uncertified> {
    let truth = of.truth()?;
    let outputs = of.outputs();
    let n = outputs.len();
    let mut before: Vec<Level> = Vec::new();
    let mut levels = Vec::new();
    for (k, name) in of.levels().into_iter().enumerate() {
        let (work, answer) = of.run(k);
        let values = match answer {
            SolverAnswer::Values(v)
                if v.len() == truth.len() && v.iter().all(|x| x.is_finite()) =>
            {
                v
            }
            other => {
                levels.push(LevelReport {
                    level: name,
                    work,
                    failed: Some(failure(&other)),
                    errors: Vec::new(),
                });
                // No order is observed across a gap.
                before.clear();
                continue;
            }
        };
        let twin = of.twin(k).filter(|t| t.len() == truth.len());
        let halved = of.twin_of_half_steps(k).filter(|t| t.len() == truth.len());
        let mut errors: Vec<LevelError> = (0..n)
            .map(|o| {
                let own = || (o..values.len()).step_by(n);
                let largest =
                    |f: &dyn Fn(usize) -> Mag| own().map(f).fold(Mag::ZERO, Mag::max).to_f64();
                let beside_truth = |t: &Option<Vec<Ball>>| {
                    let t = t.as_ref()?;
                    Some(largest(&|i| (&t[i] - &truth[i]).magnitude()))
                };
                let method = beside_truth(&twin);
                let order = method
                    .zip(beside_truth(&halved))
                    .and_then(|(whole, half)| ratio(whole, half, std::f64::consts::LN_2));
                LevelError {
                    total: largest(&|i| distance(values[i], &truth[i], Format::Double).1),
                    method,
                    rounding: twin
                        .as_ref()
                        .map(|t| largest(&|i| distance(values[i], &t[i], Format::Double).1)),
                    order,
                    richardson: None,
                }
            })
            .collect();
        let leading: Vec<f64> = errors.iter().map(|e| e.method.unwrap_or(e.total)).collect();
        let work = work as f64;
        if let Some(last) = before.last().filter(|_| of.is_regular()) {
            let step = (work / last.work).ln();
            for (o, e) in errors.iter_mut().enumerate() {
                e.order = ratio(last.leading[o], leading[o], step);
            }
            if let [.., first, second] = before.as_slice() {
                for (o, e) in errors.iter_mut().enumerate() {
                    let change = |a: &[f64], b: &[f64]| {
                        let pairs = a.iter().zip(b).skip(o).step_by(n);
                        pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
                    };
                    let old = change(&first.values, &second.values);
                    e.richardson = ratio(old, change(&second.values, &values), step);
                }
            }
        }
        before.push(Level {
            work,
            values,
            leading,
        });
        levels.push(LevelReport {
            level: name,
            work: work as u64,
            failed: None,
            errors,
        });
    }
    Ok(ConvergenceReport {
        name: of.name(),
        summary: of.summary(),
        work_unit: of.work_unit(),
        places: of.places(),
        fitted: (0..n).map(|o| fitted(&levels, o)).collect(),
        outputs: outputs.iter().map(|o| o.0).collect(),
        orders: outputs.iter().map(|o| o.1).collect(),
        levels,
    })
}

/// The order that the errors of an output show over all levels.
fn fitted(levels: &[LevelReport], output: usize) -> Option<f64> {
    let point = |l: &LevelReport| {
        let e = l.errors.get(output)?;
        let (x, y) = ((l.work as f64).ln(), e.method.unwrap_or(e.total).ln());
        (x.is_finite() && y.is_finite()).then_some((x, y))
    };
    let points: Vec<(f64, f64)> = levels.iter().filter_map(point).collect();
    let n = points.len() as f64;
    let mean = |f: &dyn Fn(&(f64, f64)) -> f64| points.iter().map(f).sum::<f64>() / n;
    let (x, y) = (mean(&|p| p.0), mean(&|p| p.1));
    let slope = mean(&|p| (p.0 - x) * (p.1 - y)) / mean(&|p| (p.0 - x).powi(2));
    (points.len() > 2 && slope.is_finite()).then_some(-slope)
}

/// `log(old/new) / step`, where it means anything.
fn ratio(old: f64, new: f64, step: f64) -> Option<f64> {
    let order = (old / new).ln() / step;
    order.is_finite().then_some(order)
}

fn failure(answer: &SolverAnswer) -> String {
    match answer {
        SolverAnswer::Values(_) => "a value is missing or not finite".into(),
        SolverAnswer::Fails(why) | SolverAnswer::Unanswered(why) => why.clone(),
        other => other.refusal().unwrap_or("refused").into(),
    }
}

#[cfg(test)]
mod tests;
