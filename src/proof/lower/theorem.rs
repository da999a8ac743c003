//! All bounds of the lower half-plane together.

use super::apart::Apart;
use super::{Again, AroundZeros, Certificate, Code, Dominated, Leaf, Target, lower_half_plane};
use crate::certificate::{Open, Watch};
use crate::cover::Rectangle;
use crate::interval::worst;
use crate::prove::UPPER_HALF_PLANE;
use crate::tracked::Rounding;
use mechaudit_solvers::faddeeva::proof::lower as code;

/// What is not proved.
pub const NOT_PROVED: [&str; 1] = ["a component as a part of itself; of |w| each is within K"];

/// What of it is no run of the solver's code.
pub const BY_HAND: &str =
    "roundings of points computed again, in pairs and 256 bits; their constants are checked";

/// The worst of one formula.
#[derive(Clone, Debug)]
pub struct OfRegion {
    /// Its name.
    pub name: &'static str,
    /// Rectangles.
    pub boxes: usize,
    /// Of the norm, in units of 2⁻⁵².
    pub norm: f64,
    /// Where it is attained, `Re z` and `−Im z`; `None` for a bound without rectangles.
    pub at: Option<Rectangle>,
}

/// The theorem.
#[derive(Clone, Debug)]
pub struct Theorem {
    /// K, in units of 2⁻⁵².
    pub norm: f64,
    /// Each formula.
    pub regions: Vec<OfRegion>,
    /// Boxes of the exponential and its phase.
    pub of_exponential: usize,
    /// What shows that no zero is next to an `f64`.
    pub apart: Apart,
    /// Rectangles on which nothing is proved.
    pub open: Vec<Open>,
    /// All rectangles, those without a bound of their own among them.
    pub leaves: Vec<Leaf>,
}

/// Proves what can be proved; up to |Re z|, |Im z| in the binades below `within`. `None` if it was stopped.
///
/// # Errors
/// If the reference is undecided, or the exponential or the rounded formulas of the upper half-plane have no bound.
pub fn theorem(
    target: Target,
    within: Option<f64>,
    watch: &Watch,
) -> Result<Option<Theorem>, String> {
    let solver = Code::of_the_solver()?;
    let upper = crate::code::Code {
        tables: solver.tables.clone(),
        branch: |a, b| mechaudit_solvers::faddeeva::branch(num_complex::Complex::new(a, b)),
        rounding: Rounding::default(),
    };
    debug_assert!(UPPER_HALF_PLANE.norm <= target.norm);
    let zeros = AroundZeros::of(&AroundZeros::rows()?, solver.rounding, target.norm)?;
    let again = Again::of(&code::again(), code::constants().half_pi)?;
    let Some(apart) = Apart::all(within, watch)? else {
        return Ok(None);
    };
    let Some(dominated) = Dominated::of(&upper, &solver.exponential, &solver.limits, watch)? else {
        return Ok(None);
    };
    let wanted = |r: &Rectangle| within.is_none_or(|most| r.a[1].max(r.b[1]) < most);
    Ok(lower_half_plane(&solver, target, watch, wanted)
        .map(|found| together(&solver, &dominated, (zeros, again, apart), found)))
}

fn together(
    solver: &Code,
    dominated: &Dominated,
    (zeros, again, apart): (AroundZeros, Again, Apart),
    found: Certificate,
) -> Theorem {
    let mut regions: Vec<OfRegion> = Vec::new();
    for Leaf { at, region, norm } in &found.leaves {
        // Those have bounds without rectangles.
        if *region == super::Region::Dominated {
            continue;
        }
        let name = region.name();
        let known = regions.iter_mut().find(|r| r.name == name);
        let new = OfRegion {
            name,
            boxes: 1,
            norm: *norm,
            at: Some(*at),
        };
        match known {
            None => regions.push(new),
            Some(r) => {
                r.boxes += 1;
                if !(*norm <= r.norm) {
                    (r.norm, r.at) = (*norm, new.at);
                }
            }
        }
    }
    for (name, norm) in [
        ("cell, exponential small", dominated.image_in_cell),
        ("26 terms, exponential small", dominated.image_by_series),
        ("exponential, cell small", dominated.exponential),
        ("scaled", dominated.huge),
        ("again, pairs, |z| < 4096", again.near),
        ("again, pairs, beyond", again.far),
        ("again, 256 bits", again.long),
    ] {
        regions.push(OfRegion {
            name,
            boxes: 0,
            norm,
            at: None,
        });
    }
    regions.push(OfRegion {
        name: "stored zeros",
        boxes: zeros.boxes,
        norm: zeros.norm,
        at: zeros.at,
    });
    Theorem {
        apart,
        norm: worst(regions.iter().map(|r| r.norm)),
        of_exponential: solver.exponential.boxes,
        open: found.open,
        leaves: found.leaves,
        regions,
    }
}
