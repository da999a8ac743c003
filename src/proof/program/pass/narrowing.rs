//! Ranges narrowed by the condition on the inputs.
//!
//! Where the condition holds, some functions h of the inputs are not negative. For the exact value
//! v of an operation, every `λ ≥ 0` and every x of the box where it holds,
//!
//! ```text
//! v(x) ≥ v(x) − λ h(x) ≥ v(c) − λ h(c) + min Σ_j (∂_j v − λ ∂_j h)(x_j − c_j)
//! ```
//!
//! by the mean value theorem about the centre c, so that of linear functions what both have in
//! common cancels. The theorem needs derivatives on the way from c to x, where the condition may
//! fail: they must not come from narrowed ranges.

use super::super::tape::{Condition, Op, Place, Tape};
use super::Pass;
use crate::interval::{Interval, down, sum_up, up};
use mechaudit_symbolic::Relation;

/// A function that is not negative where the condition holds: at the centre, and its derivatives.
#[derive(Clone, Debug)]
struct Bounded {
    centre: Interval,
    slopes: Vec<Interval>,
}

/// The condition over a box.
#[derive(Clone, Debug)]
pub(crate) struct Narrowing {
    /// The box about its centre.
    steps: Vec<Interval>,
    /// The exact values of operations at the centre, as far as there are some.
    centre: Vec<Interval>,
    functions: Vec<Bounded>,
    /// True if the condition holds on all of the box.
    is_everywhere: bool,
}

/// The differences that are not negative where a condition holds.
fn differences(tape: &Tape, condition: usize, out: &mut Vec<[Place; 2]>) {
    match tape.conditions[condition] {
        Condition::And(a, b) => {
            differences(tape, a, out);
            differences(tape, b, out);
        }
        Condition::Compare(relation, a, b) => match relation {
            Relation::Less | Relation::LessEqual => out.push([b, a]),
            Relation::Greater | Relation::GreaterEqual => out.push([a, b]),
            Relation::Equal => out.extend([[a, b], [b, a]]),
            Relation::NotEqual => {}
        },
        _ => {}
    }
}

impl Narrowing {
    /// Of a condition by two passes of it, over a box and at its centre; `None` where it says
    /// nothing of this kind.
    pub fn new(
        (tape, condition): (&Tape, usize),
        [over, at]: [&Pass; 2],
        steps: Vec<Interval>,
        centre: Vec<Interval>,
    ) -> Option<Narrowing> {
        let is_open = |p: &Pass| !p.open.is_empty() || p.value.len() < tape.ops.len();
        if is_open(over) || is_open(at) {
            return None;
        }
        let mut all = Vec::new();
        differences(tape, condition, &mut all);
        let n = steps.len();
        let slope = |a: Place, j: usize| over.slope[a * n + j];
        let functions = all.into_iter().map(|[a, b]| Bounded {
            // Wherever the condition holds as it is computed, too.
            centre: (at.value[a] - at.value[b]).widened(sum_up(over.error[a], over.error[b])),
            slopes: (0..n).map(|j| slope(a, j) - slope(b, j)).collect(),
        });
        Some(Narrowing {
            is_everywhere: over.holds(tape, condition) == Some(true),
            functions: functions.collect(),
            steps,
            centre,
        })
    }

    /// A function over the box by its value at the centre and its slopes.
    fn about_centre(&self, centre: Interval, slopes: &[Interval]) -> Interval {
        let terms = slopes.iter().zip(&self.steps);
        terms.fold(centre, |sum, (slope, step)| sum + *slope * *step)
    }

    /// A lower bound of a function where the condition holds.
    fn least(&self, centre: Interval, slopes: &[Interval]) -> f64 {
        let middle = |x: Interval| x.lo / 2.0 + x.hi / 2.0;
        let mut best = f64::NEG_INFINITY;
        for h in &self.functions {
            for (p, q) in slopes.iter().zip(&h.slopes) {
                let factor = middle(*p) / middle(*q);
                if !(factor > 0.0 && factor.is_finite()) {
                    continue;
                }
                let factor = Interval::point(factor);
                let both = slopes.iter().zip(&h.slopes);
                let slopes: Vec<Interval> = both.map(|(p, q)| *p - factor * *q).collect();
                let form = self.about_centre(centre - factor * h.centre, &slopes);
                best = best.max(form.lo);
            }
        }
        best
    }
}

impl Pass {
    /// Narrows the range of the last operation, a sum or a difference whose derivatives hold on all
    /// of the box.
    pub(super) fn narrow(&mut self, tape: &Tape, op: Op) {
        let last = self.value.len() - 1;
        let (operands, count) = op.operands();
        let any = |flags: &[bool]| operands[..count].iter().any(|a| flags[*a]);
        // A choice may have been made by a narrowed range.
        let chosen = matches!(op, Op::If(..)) && self.is_narrowed.contains(&true);
        let inherited = chosen || any(&self.is_narrowed);
        let is_constant = |a: Place| matches!(tape.ops[a], Op::Constant(..));
        let is_linear = match op {
            Op::Neg(_) | Op::Add(..) | Op::Sub(..) => true,
            Op::Mul(a, b) => is_constant(a) || is_constant(b),
            Op::Div(_, b) => is_constant(b),
            _ => false,
        };
        let bent = any(&self.is_bent) || (inherited && !is_linear);
        self.is_narrowed.push(inherited);
        self.is_bent.push(bent);
        let is_sum = matches!(op, Op::Add(..) | Op::Sub(..)) && !bent && self.open.is_empty();
        let Some(narrowing) = self.narrowing.take_if(|_| is_sum) else {
            return;
        };
        if let Some(centre) = narrowing.centre.get(last).copied() {
            let slopes = &self.slope[last * self.inputs..(last + 1) * self.inputs];
            let minus: Vec<Interval> = slopes.iter().map(|s| -*s).collect();
            let everywhere = narrowing.about_centre(centre, slopes);
            let [lo, hi] = [
                narrowing.least(centre, slopes),
                -narrowing.least(-centre, &minus),
            ];
            self.within(last, [everywhere.lo, everywhere.hi]);
            let narrower = self.within(last, [lo, hi]) && !narrowing.is_everywhere;
            self.is_narrowed[last] |= narrower;
        }
        self.narrowing = Some(narrowing);
    }

    /// Narrows ranges to what the ends of the exact value leave of them; returns whether they are
    /// narrower.
    fn within(&mut self, place: Place, [lo, hi]: [f64; 2]) -> bool {
        // The path and what is computed are within the error of the exact value.
        let error = self.error[place];
        let (lo, hi) = (down(lo - error), up(hi + error));
        let mut is_narrower = false;
        for range in [&mut self.value[place], &mut self.float[place]] {
            let (from, to) = (range.lo.max(lo), range.hi.min(hi));
            if from <= to && (from > range.lo || to < range.hi) {
                *range = Interval { lo: from, hi: to };
                is_narrower = true;
            }
        }
        is_narrower
    }
}

#[cfg(test)]
mod tests;
