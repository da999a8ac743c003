//! The proof for the closed upper half-plane: rectangles halved until the bound is good enough on
//! each.

use crate::bound::Bound;
use crate::certificate::{self, Step, Watch};
use crate::choice::parts;
use crate::code::Code;
use crate::cover::{Rectangle, roots};
use crate::formula::{Formula, bound};
use crate::interval::{larger, worst};

/// Describes what a rectangle is not halved below.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// Of the norm, in units of 2⁻⁵².
    pub norm: f64,
    /// Of a component, in units in its last place, where one is proved.
    pub component: f64,
    /// How often a rectangle is halved at most.
    pub depth: u32,
}

/// The target that the proof of the closed upper half-plane reaches on every rectangle.
pub const UPPER_HALF_PLANE: Target = Target {
    norm: mechaudit_solvers::faddeeva::PROVED_NORM,
    component: 4.0,
    depth: 48,
};

impl Default for Target {
    fn default() -> Target {
        UPPER_HALF_PLANE
    }
}

/// A rectangle with a formula that is used in it.
#[derive(Clone, Copy, Debug)]
pub struct Leaf {
    /// Where.
    pub at: Rectangle,
    /// By which formula.
    pub formula: Formula,
    /// Holds what is proved.
    pub bound: Bound,
}

/// Leaves together cover the closed quadrant unless something is open.
pub type Certificate = certificate::Certificate<Leaf>;

/// Proves what can be proved on the rectangles of the partition that `wanted` keeps; `None` if it
/// was stopped.
pub fn upper_half_plane(
    code: &Code,
    target: Target,
    watch: &Watch,
    wanted: impl Fn(usize, &Rectangle) -> bool,
) -> Option<Certificate> {
    let all: Vec<Rectangle> = roots()
        .into_iter()
        .enumerate()
        .filter(|(i, r)| wanted(*i, r))
        .map(|(_, r)| r)
        .collect();
    Certificate::of_all(&all, watch, |r, found| {
        found.refine(*r, 0, watch, &|at, depth, _| step(code, target, at, depth))
    })
}

/// Proves what can be proved on one rectangle; `None` if it was stopped.
pub fn on_rectangle(
    code: &Code,
    target: Target,
    watch: &Watch,
    at: Rectangle,
) -> Option<Certificate> {
    let mut found = Certificate::default();
    found.refine(at, 0, watch, &|at, depth, _| step(code, target, at, depth))?;
    Some(found)
}

/// The rectangles that a proof of the closed upper half-plane begins with, in the binades below
/// `within` or all.
pub fn first_rectangles(within: Option<f64>) -> Vec<Rectangle> {
    let mut all = roots();
    all.retain(|r| r.is_below(within));
    all
}

/// Proves a rectangle that was halved `depth` times, or cuts it.
fn step(code: &Code, target: Target, at: &Rectangle, depth: u32) -> Step<Leaf, Rectangle> {
    let last = depth >= target.depth || at.is_point();
    let leaves = match leaves(code, at) {
        Ok(leaves) => leaves,
        Err(why) if last => return Step::Open(why),
        Err(_) => return Step::Cut(at.halves(at.across_re(true))),
    };
    if last || target.excess(&leaves) <= 1.0 {
        return Step::Proved(leaves);
    }
    if let Some(across_re) = beside_real_axis(at, &leaves) {
        return Step::Cut(at.halves(across_re));
    }
    let after = |across_re: bool| {
        let each = at.halves(across_re).map(|half| self::leaves(code, &half));
        let excess = each.map(|l| l.map_or(f64::INFINITY, |l| target.excess(&l)));
        larger(excess[0], excess[1])
    };
    let [re, im] = [at.a, at.b].map(|[lo, hi]| lo < hi);
    let across_re = match (re, im) {
        // Without one that is better the longer side, for a component that with more numbers.
        (true, true) => better_cut(after(true), after(false))
            .unwrap_or_else(|| at.across_re(target.norm_is_worse(&leaves))),
        (re, _) => re,
    };
    Step::Cut(at.halves(across_re))
}

/// The cut, across Re z or not, after which the worse half is better by a tenth: a little better
/// now may be worse later.
fn better_cut(after_re: f64, after_im: f64) -> Option<bool> {
    let better = |p: f64, q: f64| p < 0.9 * q;
    match (better(after_re, after_im), better(after_im, after_re)) {
        (true, _) => Some(true),
        (_, true) => Some(false),
        _ => None,
    }
}

/// Which cut a rectangle beside the real axis needs: the lines first, then columns, of half a row
/// or across which `e^{−z²}` changes by less than a fifth; `None` elsewhere and for what is
/// narrower.
fn beside_real_axis(at: &Rectangle, leaves: &[Leaf]) -> Option<bool> {
    let column = |l: &Leaf| match l.formula {
        Formula::RealLine => Some(0.004),
        Formula::RealAxis { .. } => Some(0.032),
        _ => None,
    };
    let column = leaves.iter().filter_map(column).reduce(f64::min)?;
    let crosses = at.lines()[1]
        .iter()
        .any(|&line| at.b[0] < line && line <= at.b[1]);
    match crosses {
        true => Some(false),
        false => (at.a[1] - at.a[0] > column).then_some(true),
    }
}

impl Target {
    /// Returns whether the norm is farther above its target than the components.
    fn norm_is_worse(&self, leaves: &[Leaf]) -> bool {
        let norm = worst(leaves.iter().map(|l| l.bound.norm));
        norm / self.norm >= self.excess(leaves)
    }

    /// The factor by which the worst of the bounds is above what it should be.
    fn excess(&self, leaves: &[Leaf]) -> f64 {
        worst(leaves.iter().map(|l| {
            let parts = larger(l.bound.re, l.bound.im) / self.component;
            larger(parts, l.bound.norm / self.norm)
        }))
    }
}

/// The formulas that are used in a rectangle, each with the bound on its piece of it.
fn leaves(code: &Code, at: &Rectangle) -> Result<Vec<Leaf>, &'static str> {
    parts(code, at)?
        .into_iter()
        .map(|(at, formula)| {
            let bound = bound(&code.tables, formula, &at, code.rounding)?;
            Ok(Leaf { at, formula, bound })
        })
        .collect()
}

#[cfg(test)]
mod tests;

#[cfg(test)]
mod cut_tests;
