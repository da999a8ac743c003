//! The proof: intervals halved until the bound is good enough on each.

use super::choice::{Formula, choice};
use super::evaluate::{SMALL, beyond_subnormal, bound};
use super::tables::Tables;
use super::{Function, Interval};
use crate::ProofError;
use crate::certificate::{self, Step, Watch};
use crate::cover::{self, Rectangle, pieces};
use crate::tracked::Rounding;

/// The code whose error is bounded, and how its operations round.
#[derive(Clone)]
pub struct Code {
    /// Its rows and constants.
    pub tables: Tables,
    /// Which formula it uses at x or −x.
    pub choice: fn(Function, bool, f64) -> Formula,
    /// How operations round.
    pub rounding: Rounding,
}

impl Code {
    /// The solver's.
    ///
    /// # Errors
    /// If the reference is undecided about a coefficient.
    pub fn of_the_solver(function: Function) -> Result<Code, ProofError> {
        Ok(Code {
            tables: Tables::of_the_solver(function)?,
            choice,
            rounding: Rounding::default(),
        })
    }
}

/// An interval with the formula that is used in it.
#[derive(Clone, Copy, Debug)]
pub struct Leaf {
    /// Where.
    pub at: Interval,
    /// By which formula.
    pub formula: Formula,
    /// `|computed − f| ≤ ulps · ulp(f)`.
    pub ulps: f64,
}

/// An interval on which nothing is proved.
pub type Open = certificate::Open<Interval>;
/// Leaves together cover the finite numbers unless something is open.
pub type Certificate = certificate::Certificate<Leaf, Interval>;

/// How often an interval is halved at most for a better bound, and for one at all: to single
/// numbers.
const DEPTH: u32 = 14;
const MOST_DEPTH: u32 = 64;
/// More than these intervals for one to begin with, and it is given up.
const MANY: usize = 1 << 16;

/// The number of its binade in the underflowing range, of eight binades elsewhere.
fn binades(x: f64) -> (bool, u64) {
    match x < SMALL {
        true if beyond_subnormal(x) => (true, x.to_bits() >> 52),
        small => (small, if small { 0 } else { x.to_bits() >> 55 }),
    }
}

/// The intervals to begin with: one formula each, one centre, and at most a few binades.
fn roots(code: &Code, function: Function) -> Vec<(Interval, Formula)> {
    let mut all = Vec::new();
    for &negative in function.signs() {
        let at = |x| (code.choice)(function, negative, x);
        for (ends, formula) in pieces([0.0, f64::MAX], at) {
            for (ends, _) in pieces(ends, binades) {
                all.push((Interval { negative, ends }, formula));
            }
        }
    }
    all
}

/// Proves what can be proved of a function, with intervals halved until the bound is at most
/// `target` units in the last place; `None` if it was stopped.
pub fn real_line(
    code: &Code,
    function: Function,
    target: f64,
    watch: &Watch,
) -> Option<Certificate> {
    let all = roots(code, function);
    Certificate::of_all(&all, watch, |&(at, formula), found| {
        let refined = Refined {
            code,
            function,
            target,
            formula,
        };
        found.refine(at, 0, watch, &|at, depth, parts| {
            refined.step(at, depth, parts)
        })
    })
}

struct Refined<'a> {
    code: &'a Code,
    function: Function,
    target: f64,
    formula: Formula,
}

impl Refined<'_> {
    /// Proves an interval that was halved `depth` times, or cuts it.
    fn step(&self, at: &Interval, depth: u32, parts: usize) -> Step<Leaf, Interval> {
        let Code {
            tables, rounding, ..
        } = self.code;
        let point = at.is_point() || parts > MANY;
        match bound(tables, self.function, self.formula, at, *rounding) {
            Ok((formula, ulps)) if point || depth >= DEPTH || ulps <= self.target => {
                let at = *at;
                Step::Proved(vec![Leaf { at, formula, ulps }])
            }
            Err(why) if point || depth >= MOST_DEPTH => Step::Open(why),
            _ => Step::Cut(at.halves()),
        }
    }
}

/// A finite number that no interval holds, if there is one; of an odd function the positive ones
/// count.
pub fn hole(function: Function, intervals: impl IntoIterator<Item = Interval>) -> Option<f64> {
    let all: Vec<Interval> = intervals.into_iter().collect();
    function.signs().iter().find_map(|&negative| {
        let some = all.iter().filter(|i| i.negative == negative);
        let some = some.map(|i| Rectangle {
            a: i.ends,
            b: [0.0, f64::MAX],
        });
        let [x, _] = cover::hole(&some.collect::<Vec<_>>())?;
        Some(if negative { -x } else { x })
    })
}

#[cfg(test)]
mod tests;
