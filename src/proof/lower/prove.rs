//! The proof for the open lower half-plane: rectangles `a − i b` halved until the bound is good
//! enough on each.

use super::regions::{Code, Region, bound, regions};
use crate::certificate::{self, Step, Watch};
use crate::cover::{Rectangle, shells};

/// Describes what a rectangle is not halved below.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// Of the norm, in units of 2⁻⁵².
    pub norm: f64,
    /// Of the norm where one formula serves.
    pub single: f64,
    /// How often a rectangle is halved at most.
    pub depth: u32,
}

/// The target that the proof of the lower half-plane reaches on every rectangle.
pub const LOWER_HALF_PLANE: Target = Target {
    norm: 2.5,
    single: 1.5,
    depth: 40,
};

/// A rectangle with a formula that may be used in it.
#[derive(Clone, Copy, Debug)]
pub struct Leaf {
    /// `Re z` and `−Im z`.
    pub at: Rectangle,
    /// By which formula.
    pub region: Region,
    /// Holds what is proved of the norm, in units of 2⁻⁵².
    pub norm: f64,
}

/// Leaves together cover the quadrant up to `|z|² = 10²⁰⁰` but for overflow, unless something is
/// open.
pub type Certificate = certificate::Certificate<Leaf>;

/// The quadrant `a ≥ 0`, `b > 0` up to the shell in which z begins to be scaled, as shells of
/// rectangles.
pub fn roots() -> Vec<Rectangle> {
    // 2³³² < 10¹⁰⁰ < 2³³³.
    shells(-9..=332, 2, [0.0, f64::from_bits(1)])
}

/// Proves what can be proved on the rectangles of the partition that `wanted` keeps; `None` if it
/// was stopped.
pub fn lower_half_plane(
    code: &Code,
    target: Target,
    watch: &Watch,
    wanted: impl Fn(&Rectangle) -> bool,
) -> Option<Certificate> {
    let all: Vec<Rectangle> = roots().into_iter().filter(wanted).collect();
    Certificate::of_all(&all, watch, |r, found| {
        found.refine(*r, 0, watch, &|at, depth, _| step(code, target, at, depth))
    })
}

/// Proves a rectangle that was halved `depth` times, or cuts it.
fn step(code: &Code, target: Target, at: &Rectangle, depth: u32) -> Step<Leaf, Rectangle> {
    let last = depth >= target.depth || at.is_point();
    let good = |l: &Leaf| {
        let norm = match l.region.is_reflected() {
            true => target.norm,
            false => target.single,
        };
        l.norm <= norm
    };
    match leaves(code, at) {
        Ok(leaves) if leaves.iter().all(good) => Step::Proved(leaves),
        Ok(leaves) if last => Step::Open(match leaves.iter().all(|l| l.norm.is_finite()) {
            true => "the bound is above the target",
            false => "w may be zero",
        }),
        Err(why) if last => Step::Open(why),
        _ => Step::Cut(at.halves(at.across_re(true))),
    }
}

/// The formulas that may be used in a rectangle, each with the bound on its piece of it.
pub(super) fn leaves(code: &Code, at: &Rectangle) -> Result<Vec<Leaf>, &'static str> {
    let all = regions(code, at)?.into_iter();
    all.map(|(at, region)| {
        let norm = bound(code, region, &at)?;
        Ok(Leaf { at, region, norm })
    })
    .collect()
}
