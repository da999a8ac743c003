//! All bounds of the lower half-plane together.

use super::apart::Apart;
use super::{
    Again, AroundZeros, Certificate, Code, Dominated, Leaf, Region, Target, lower_half_plane,
};
use crate::ProofError;
use crate::certificate::{Open, Watch};
use crate::cover::Rectangle;
use crate::interval::worst;
use crate::prove::UPPER_HALF_PLANE;
use crate::summary::{attained, grouped};
use crate::tracked::Rounding;
use mechaudit_solvers::faddeeva::proof::lower as code;

/// States what is not proved.
pub const NOT_PROVED: [&str; 1] = ["a component as a part of itself; of |w| each is within K"];

/// States what of it is no run of the solver's code.
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
    /// Holds what shows that no zero is next to an `f64`.
    pub apart: Apart,
    /// Rectangles on which nothing is proved.
    pub open: Vec<Open>,
    /// All rectangles, those without a bound of their own among them.
    pub leaves: Vec<Leaf>,
}

/// Proves what can be proved; up to |Re z|, |Im z| in the binades below `within`. `None` if it was
/// stopped.
///
/// # Errors
/// If the reference is undecided, or the exponential or the rounded formulas of the upper
/// half-plane have no bound.
pub fn theorem(
    target: Target,
    within: Option<f64>,
    watch: &Watch,
) -> Result<Option<Theorem>, ProofError> {
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
    let found = lower_half_plane(&solver, target, watch, |r| r.is_below(within));
    let boxes = solver.exponential.boxes;
    Ok(found.map(|found| together(boxes, &dominated, (zeros, again, apart), found)))
}

fn together(
    of_exponential: usize,
    dominated: &Dominated,
    (zeros, again, apart): (AroundZeros, Again, Apart),
    found: Certificate,
) -> Theorem {
    // Those have bounds without rectangles.
    let some = found
        .leaves
        .iter()
        .filter(|l| l.region != Region::Dominated);
    let of_region = |(name, leaves): (&'static str, Vec<&Leaf>)| {
        let worst = attained(&leaves, |l| (l.norm, l.at))?;
        Some(OfRegion {
            name,
            boxes: leaves.len(),
            norm: worst.bound,
            at: Some(worst.at),
        })
    };
    let each = grouped(some, |l| l.region.name()).into_iter();
    let mut regions: Vec<OfRegion> = each.filter_map(of_region).collect();
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
        of_exponential,
        open: found.open,
        leaves: found.leaves,
        regions,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rectangles by the names of their formulas with the worst of each, bounds without rectangles,
    /// and the worst of all.
    #[test]
    fn every_bound_counts() {
        let leaf = |x: f64, region: Region, norm: f64| Leaf {
            at: Rectangle {
                a: [x; 2],
                b: [1.0; 2],
            },
            region,
            norm,
        };
        let (strip, line) = (Region::Strip, Region::RealLine);
        let leaves = || {
            vec![
                leaf(1.0, strip, 1.25),
                leaf(2.0, line, 1.5),
                leaf(3.0, strip, 1.75),
                leaf(4.0, strip, 0.5),
                leaf(5.0, Region::Dominated, 9.0),
            ]
        };
        let of = |parts: [f64; 8], open: Vec<Open>| {
            let dominated = Dominated {
                image_in_cell: parts[0],
                image_by_series: parts[1],
                exponential: parts[2],
                huge: parts[3],
                boxes: 0,
            };
            let again = Again {
                near: parts[4],
                far: parts[5],
                long: parts[6],
            };
            let zeros = AroundZeros {
                norm: parts[7],
                boxes: 17,
                at: None,
            };
            let apart = Apart {
                boxes: 1,
                zeros: 2,
                lines: 3,
            };
            let leaves = leaves();
            together(
                11,
                &dominated,
                (zeros, again, apart),
                Certificate { leaves, open },
            )
        };
        let open = Open {
            at: leaves()[0].at,
            why: "planted",
        };
        let small = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8];
        let found = of(small, vec![open]);
        assert_eq!((found.norm, found.of_exponential), (1.75, 11));
        assert_eq!((found.open.len(), found.leaves.len()), (1, 5));
        let rows: Vec<_> = found.regions.iter().map(|r| (r.boxes, r.norm)).collect();
        let without = small.map(|norm| (if norm == 0.8 { 17 } else { 0 }, norm));
        assert_eq!(rows, [&[(3, 1.75), (1, 1.5)], &without[..]].concat());
        let at = found.regions[0].at.expect("a rectangle");
        assert_eq!((found.regions[0].name, at.a), (strip.name(), [3.0; 2]));
        for k in 0..8 {
            for norm in [3.0, f64::INFINITY] {
                let mut parts = small;
                parts[k] = norm;
                assert_eq!(of(parts, Vec::new()).norm, norm, "{k}");
            }
            let mut parts = small;
            parts[k] = f64::NAN;
            assert!(!(of(parts, Vec::new()).norm <= 2.0), "{k}");
        }
    }
}
