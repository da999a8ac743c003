//! All bounds of the lower half-plane together.

use super::{Certificate, Code, Dominated, Leaf, Target, lower_half_plane};
use crate::certificate::{Open, Watch};
use crate::cover::Rectangle;
use crate::prove::{self, UPPER_HALF_PLANE};
use crate::tracked::Rounding;

/// What is not proved.
pub const NOT_PROVED: [&str; 3] = [
    "the components",
    "points that are computed again, in double-double or 256 bits, because terms cancel",
    "points around the first twelve zeros that are computed from the stored zero",
];

/// The worst of one formula.
#[derive(Clone, Debug)]
pub struct OfRegion {
    /// Its name.
    pub name: &'static str,
    /// Rectangles.
    pub boxes: usize,
    /// Of the norm, in units of 2⁻⁵².
    pub norm: f64,
    /// The same where `|w(z)| ≥ |w(−z)|/8`.
    pub away: f64,
    /// Where it is attained, `Re z` and `−Im z`; `None` for a bound without rectangles.
    pub at: Option<Rectangle>,
}

/// The theorem.
#[derive(Clone, Debug)]
pub struct Theorem {
    /// K, in units of 2⁻⁵².
    pub norm: f64,
    /// The same where `|w(z)| ≥ |w(−z)|/8`.
    pub away: f64,
    /// Each formula.
    pub regions: Vec<OfRegion>,
    /// Boxes of the exponential and its phase.
    pub of_exponential: usize,
    /// Rectangles on which nothing is proved.
    pub open: Vec<Open>,
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
    let code = Code::of_the_solver()?;
    let upper = prove::Code {
        tables: code.tables.clone(),
        branch: |a, b| mechaudit_solvers::faddeeva::branch(num_complex::Complex::new(a, b)),
        rounding: Rounding::default(),
    };
    debug_assert!(UPPER_HALF_PLANE.norm <= target.norm);
    let Some(dominated) = Dominated::of(&upper, &code.exponential, &code.limits, watch)? else {
        return Ok(None);
    };
    let wanted = |r: &Rectangle| within.is_none_or(|most| r.a[1].max(r.b[1]) < most);
    Ok(lower_half_plane(&code, target, watch, wanted)
        .map(|found| together(&code, &dominated, found)))
}

fn together(code: &Code, dominated: &Dominated, found: Certificate) -> Theorem {
    let mut regions: Vec<OfRegion> = Vec::new();
    for Leaf {
        at,
        region,
        norm,
        away,
    } in &found.leaves
    {
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
            away: *away,
            at: Some(*at),
        };
        match known {
            None => regions.push(new),
            Some(r) => {
                r.boxes += 1;
                r.away = r.away.max(*away);
                if *norm > r.norm {
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
    ] {
        regions.push(OfRegion {
            name,
            boxes: 0,
            norm,
            away: norm,
            at: None,
        });
    }
    let worst = |of: fn(&OfRegion) -> f64| regions.iter().map(of).fold(0.0, f64::max);
    Theorem {
        norm: worst(|r| r.norm),
        away: worst(|r| r.away),
        of_exponential: code.exponential.boxes,
        open: found.open,
        regions,
    }
}
