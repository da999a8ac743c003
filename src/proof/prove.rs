//! The proof for the closed upper half-plane: rectangles halved until the bound is good enough on each.

use crate::certificate::{self, Open, Watch};
use crate::cover::{Rectangle, pieces, roots};
use crate::formula::{Bound, Formula, bound};
use crate::tables::{Tables, cell_at, imaginary_axis_at, real_axis_at};
use crate::tracked::Rounding;
use mechaudit_solvers::faddeeva::{Branch, branch};
use num_complex::Complex;

/// What a rectangle is not halved below.
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
    norm: 1.25,
    component: 4.0,
    depth: 48,
};

impl Default for Target {
    fn default() -> Target {
        UPPER_HALF_PLANE
    }
}

/// The code whose error is bounded, and how its operations round.
#[derive(Clone)]
pub struct Code {
    /// Its rows.
    pub tables: Tables,
    /// Which formula it uses at a point of the closed quadrant.
    pub branch: fn(f64, f64) -> Branch,
    /// How operations round.
    pub rounding: Rounding,
}

/// The solver's choice.
fn solvers_branch(a: f64, b: f64) -> Branch {
    branch(Complex::new(a, b))
}

impl Code {
    /// The solver's.
    ///
    /// # Errors
    /// If the reference is undecided about a coefficient.
    pub fn of_the_solver() -> Result<Code, String> {
        Ok(Code {
            tables: Tables::of_the_solver()?,
            branch: solvers_branch,
            rounding: Rounding::default(),
        })
    }
}

/// A rectangle with a formula that is used in it.
#[derive(Clone, Copy, Debug)]
pub struct Leaf {
    /// Where.
    pub at: Rectangle,
    /// By which formula.
    pub formula: Formula,
    /// What is proved.
    pub bound: Bound,
}

/// Leaves together cover the closed quadrant unless something is open.
pub type Certificate = certificate::Certificate<Leaf>;

/// Proves what can be proved on the rectangles of the partition that `wanted` keeps; `None` if it was stopped.
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
        refine(code, target, watch, *r, 0, found)
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
    refine(code, target, watch, at, 0, &mut found)?;
    Some(found)
}

/// The rectangles that a proof of the closed upper half-plane begins with, in the binades below `within` or all.
pub fn first_rectangles(within: Option<f64>) -> Vec<Rectangle> {
    let mut all = roots();
    all.retain(|r| within.is_none_or(|most| r.a[1].max(r.b[1]) < most));
    all
}

/// The rectangle, halved as often as it takes.
fn refine(
    code: &Code,
    target: Target,
    watch: &Watch,
    at: Rectangle,
    depth: u32,
    found: &mut Certificate,
) -> Option<()> {
    if watch.is_stopped() {
        return None;
    }
    let last = depth >= target.depth || at.is_point();
    let leaves = match leaves(code, &at) {
        Ok(leaves) => leaves,
        Err(why) if last => {
            found.open.push(Open { at, why });
            return Some(());
        }
        Err(_) => return halve(code, target, watch, at, depth, at.across_re(true), found),
    };
    if last || target.excess(&leaves) <= 1.0 {
        found.leaves.extend(leaves);
        return Some(());
    }
    if let Some(across_re) = beside_real_axis(&at, &leaves) {
        return halve(code, target, watch, at, depth, across_re, found);
    }
    // The cut after which the worse half is better.
    let after = |across_re: bool| {
        let each = at.halves(across_re).map(|half| self::leaves(code, &half));
        let excess = each.map(|l| l.map_or(f64::INFINITY, |l| target.excess(&l)));
        excess[0].max(excess[1])
    };
    let [re, im] = [at.a, at.b].map(|[lo, hi]| lo < hi);
    let across_re = match (re, im) {
        (true, true) => {
            let (p, q) = (after(true), after(false));
            // A little better now may be worse later: then the longer side, for a component that with more numbers.
            match (p < 0.9 * q, q < 0.9 * p) {
                (true, _) => true,
                (_, true) => false,
                _ => at.across_re(target.norm_is_worse(&leaves)),
            }
        }
        (re, _) => re,
    };
    halve(code, target, watch, at, depth, across_re, found)
}

/// Which cut a rectangle beside the real axis needs: the lines first, then columns, of half a row or across which
/// `e^{−z²}` changes by less than a fifth; `None` elsewhere and for what is narrower.
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
    /// Whether the norm is farther above its target than the components.
    fn norm_is_worse(&self, leaves: &[Leaf]) -> bool {
        let norm = leaves
            .iter()
            .fold(0.0, |most, l| f64::max(most, l.bound.norm));
        norm / self.norm >= self.excess(leaves)
    }

    /// How many times the worst of the bounds is above what it should be.
    fn excess(&self, leaves: &[Leaf]) -> f64 {
        leaves.iter().fold(0.0, |most, l| {
            let b = l.bound;
            let parts = b.re.max(b.im) / self.component;
            f64::max(most, f64::max(parts, b.norm / self.norm))
        })
    }
}

fn halve(
    code: &Code,
    target: Target,
    watch: &Watch,
    at: Rectangle,
    depth: u32,
    across_re: bool,
    found: &mut Certificate,
) -> Option<()> {
    for half in at.halves(across_re) {
        refine(code, target, watch, half, depth + 1, found)?;
    }
    Some(())
}

/// More than these formulas and pieces of a rectangle, and it is halved.
const MANY: usize = 6;

/// The formulas that are used in a rectangle, each with the bound on its piece of it.
fn leaves(code: &Code, at: &Rectangle) -> Result<Vec<Leaf>, &'static str> {
    let parts = parts(code, at)?;
    parts
        .into_iter()
        .map(|(at, formula)| {
            let bound = bound(&code.tables, formula, &at, code.rounding)?;
            Ok(Leaf { at, formula, bound })
        })
        .collect()
}

/// On which side of each of the lines a number is.
fn side(lines: &[f64]) -> impl Fn(f64) -> usize + '_ {
    |x| lines.iter().filter(|line| x >= **line).count()
}

/// The formulas that are used in a rectangle, each with the piece of it where it may be.
///
/// All choices of the code are made by `|z|²`, which in floating-point arithmetic too never falls when a coordinate
/// grows, and by comparisons of a coordinate with a constant ([`Rectangle::lines`]): on a piece between those lines the choices
/// at two opposite corners are the first and the last.
pub(crate) fn parts(
    code: &Code,
    at: &Rectangle,
) -> Result<Vec<(Rectangle, Formula)>, &'static str> {
    let mut out = Vec::new();
    if at.a == [0.0, 0.0] {
        for (b, branch) in pieces(at.b, |b| (code.branch)(0.0, b)) {
            let here = Rectangle { a: at.a, b };
            match branch {
                Branch::ImaginaryAxis { .. } => {
                    for (b, centre) in pieces(b, |b| imaginary_axis_at(b).0) {
                        out.push((Rectangle { a: at.a, b }, Formula::ImaginaryAxis { centre }));
                        if out.len() > MANY {
                            return Err("several formulas");
                        }
                    }
                }
                _ => {
                    let formula = Formula::of(branch, true).ok_or("an unknown branch")?;
                    out.push((here, formula));
                }
            }
        }
        return match out.len() > MANY {
            true => Err("several formulas"),
            false => Ok(out),
        };
    }
    let [re, im] = at.lines();
    for (a, _) in pieces(at.a, side(re)) {
        for (b, _) in pieces(at.b, side(im)) {
            let piece = Rectangle { a, b };
            let ends = [(code.branch)(a[0], b[0]), (code.branch)(a[1], b[1])];
            if ends[0] != ends[1] && !follows(ends) {
                return Err("several formulas");
            }
            let count = if ends[0] == ends[1] { 1 } else { 2 };
            for branch in &ends[..count] {
                with_rows(&piece, *branch, &mut out)?;
            }
            if out.len() > MANY {
                return Err("several formulas");
            }
        }
    }
    Ok(out)
}

/// Whether no third formula comes between two along the rings.
fn follows([first, second]: [Branch; 2]) -> bool {
    let rank = |b: Branch| match b {
        Branch::Maclaurin { terms: 9 } => 0,
        Branch::Maclaurin { .. } => 1,
        Branch::Cell { .. } => 2,
        // Between the same rings as what follows away from the strip.
        Branch::RealAxis { .. } | Branch::Asymptotic { terms: 26 } => 3,
        Branch::Strip { .. } | Branch::RealLine { .. } => 4,
        Branch::Asymptotic { terms: 14 } => 5,
        Branch::Asymptotic { terms: 6 } => 6,
        Branch::Asymptotic { terms: 4 } => 7,
        Branch::Asymptotic { .. } => 8,
        Branch::Huge => 9,
        _ => 100,
    };
    let strip = |b: Branch| matches!(b, Branch::Strip { .. } | Branch::RealLine { .. });
    let far = matches!(first, Branch::Asymptotic { terms: 26 });
    // Away from the strip 14 terms follow 26.
    let gap = if far && !strip(second) { 2 } else { 1 };
    rank(second) == rank(first) + gap
}

/// A piece of a rectangle with a formula, cut where the row of a table changes.
fn with_rows(
    piece: &Rectangle,
    branch: Branch,
    out: &mut Vec<(Rectangle, Formula)>,
) -> Result<(), &'static str> {
    match branch {
        Branch::Cell { .. } => {
            let columns = pieces(piece.a, |a| cell_at(a, piece.b[0]).0.0);
            let rows = pieces(piece.b, |b| cell_at(piece.a[0], b).0.1);
            if columns.len() * rows.len() > MANY {
                return Err("several cells");
            }
            for &(a, x) in &columns {
                for &(b, y) in &rows {
                    out.push((Rectangle { a, b }, Formula::Cell { centre: (x, y) }));
                }
            }
        }
        Branch::RealAxis { .. } => {
            let columns = pieces(piece.a, |a| real_axis_at(a).0);
            if columns.len() > MANY {
                return Err("several centres");
            }
            for (a, centre) in columns {
                out.push((Rectangle { a, b: piece.b }, Formula::RealAxis { centre }));
            }
        }
        _ => out.push((
            *piece,
            Formula::of(branch, false).ok_or("an unknown branch")?,
        )),
    }
    Ok(())
}

#[cfg(test)]
#[path = "tests/theorem.rs"]
mod tests;
