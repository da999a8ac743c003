//! Ellipses around a panel on which the integrand is holomorphic and bounded, of which the best is
//! chosen.

use super::super::nodes;
use super::{Budget, Panel, Path};
use crate::{Ball, ComplexBall, Mag};
use rug::Float;

/// The sums `ρ` of half-axes that are tried.
const ELLIPSES: [f64; 12] = [
    2.4,
    3.0,
    3.75,
    5.0,
    6.4,
    8.0,
    24.0,
    128.0,
    2048.0,
    131_072.0,
    16_777_216.0,
    4_294_967_296.0,
];

/// Rules of so few nodes are not made smaller by another ellipse.
const FEW: u32 = 6;

/// An ellipse, a bound of the integrand times half the width on it, and the nodes needed.
pub(super) struct Ellipse {
    pub rho: f64,
    pub most: Mag,
    pub nodes: u32,
}

/// Parts of an ellipse: the interval of the major axis in units of the half-axis, and the height
/// above it.
pub(in super::super) const PARTS: [([f64; 2], f64); 5] = [
    ([-1.0, -0.96], 0.2801),
    ([0.96, 1.0], 0.2801),
    ([-0.96, -0.8], 0.6001),
    ([0.8, 0.96], 0.6001),
    ([-0.8, 0.8], 1.0),
];

/// Bits by which a rectangle above the real line reaches below it.
const BELOW: i64 = 20;

/// A panel as a midpoint and half the width.
pub(super) struct Around<'a> {
    pub mid: &'a Ball,
    pub reach: Mag,
    pub settled: Option<&'a Float>,
}

impl Around<'_> {
    /// Bounds the integrand on a rectangle beside the panel, if it is holomorphic there.
    fn bound<P: Path>(
        &self,
        path: &mut P,
        [from, to]: [Mag; 2],
        height: Mag,
        budget: &mut Budget,
    ) -> Option<Mag> {
        let bits = self.mid.prec();
        let of = |x: Mag| Ball::new(x.to_float(), Mag::ZERO).with_prec(bits);
        // From −from to `to`, each rounded away from zero.
        let along = Ball::between(bits, (-of(from)).mid(), of(to).mid());
        let across = match P::MIRRORS {
            // A little below the axis as well: a function such as √t has a limit from above on its cut,
            // where it is not real.
            true => of(height.shift(-1)).widened(height.shift(-1).add(height.shift(-BELOW))),
            false => Ball::integer(bits, 0).widened(height),
        };
        budget.spent += 1;
        let t = ComplexBall::new(self.mid + &along, across);
        let chosen = self.settled.and_then(|at| path.bound_chosen(at, &t, bits));
        let most = match chosen {
            Some(most) => most,
            None => path.bound(&t, bits)?,
        };
        most.is_finite().then_some(most)
    }

    /// Bounds it on an ellipse: on a rectangle around it, or on several around its parts.
    fn over_ellipse<P: Path>(
        &self,
        path: &mut P,
        rho: f64,
        parted: bool,
        budget: &mut Budget,
    ) -> Option<Mag> {
        let [major, minor] = nodes::half_axes(rho).map(|axis| axis.mul(self.reach));
        if !parted {
            return self.bound(path, [major, major], minor, budget);
        }
        let mut most = Mag::ZERO;
        for (ends, height) in PARTS {
            let bits = self.mid.prec();
            let [from, to] = ends.map(|x| Ball::new(major.to_float() * x, Mag::ZERO));
            let middle = self.mid + &Ball::between(bits, from.mid(), to.mid());
            let half = Mag::ZERO;
            let part = Around {
                mid: &middle,
                reach: half,
                settled: self.settled,
            };
            let height = minor.mul(Mag::from_f64(height));
            most = most.max(part.bound(path, [Mag::ZERO; 2], height, budget)?);
        }
        Some(most)
    }
}

/// The ellipse that was the best one of the last panel, which the next one begins with.
#[derive(Clone, Copy)]
pub(super) struct Hint {
    index: usize,
    parted: bool,
    /// True if a larger one was worse.
    capped: bool,
    /// Bits that the nodes of the last panel needed beyond those of its value.
    pub more: u32,
    /// Panels in a row for which machine words were not accurate enough.
    pub missed: u32,
    /// Panels for which they are not tried.
    pub skipped: u32,
}

impl Hint {
    pub const FIRST: Hint = Hint {
        index: 2,
        parted: false,
        capped: false,
        more: 0,
        missed: 0,
        skipped: 0,
    };
}

/// The ellipse that needs the fewest nodes, of those on which the integrand is proved to be
/// holomorphic; or whether there is one at all.
pub(super) fn ellipse<P: Path>(
    path: &mut P,
    panel: &Panel<P::Value>,
    around: &Around,
    tolerance: Mag,
    greatest: u32,
    hint: &mut Hint,
    budget: &mut Budget,
) -> Result<Ellipse, bool> {
    // A jump on the panel itself makes all else futile.
    if panel.refused && panel.settled.is_none() {
        // Without any height an interval of real values would do.
        let (on, height) = ([around.reach; 2], around.reach.shift(-BELOW));
        around.bound(path, on, height, budget).ok_or(false)?;
    }
    let mut parted = hint.parted && panel.depth == 0;
    let mut i = hint.index;
    let mut most = around.over_ellipse(path, ELLIPSES[i], parted, budget);
    while most.is_none() {
        match (parted, i) {
            (false, _) => parted = true,
            (true, 0) => return Err(false),
            (true, _) => i -= 1,
        }
        most = around.over_ellipse(path, ELLIPSES[i], parted, budget);
    }
    let lowered = i < hint.index;
    let mut best: Option<Ellipse> = None;
    let mut least = f64::INFINITY;
    let mut next = Hint {
        index: i,
        parted,
        capped: lowered,
        more: hint.more,
        ..*hint
    };
    while let Some(size) = most {
        let rho = ELLIPSES[i];
        let size = size.mul(around.reach);
        if let Some(nodes) = nodes::degree(size, rho, tolerance, greatest)
            && best.as_ref().is_none_or(|best| nodes < best.nodes)
        {
            best = Some(Ellipse {
                rho,
                most: size,
                nodes,
            });
        }
        // Estimated nodes, whatever their number.
        let digits = size.exponent().unwrap_or(0) - tolerance.exponent().unwrap_or(0) + 3;
        let nodes = digits as f64 / (2.0 * rho.log2());
        if nodes > 0.9 * least {
            next.capped = true;
            break;
        }
        (least, next.index) = (nodes, i);
        let few = best.as_ref().is_some_and(|best| best.nodes <= FEW);
        let capped = lowered || hint.capped && panel.depth == 0;
        if few || capped || i + 1 == ELLIPSES.len() {
            next.capped = capped;
            break;
        }
        i += 1;
        most = around.over_ellipse(path, ELLIPSES[i], parted, budget);
        next.capped = most.is_none();
    }
    if best.is_some() {
        *hint = next;
    }
    best.ok_or(true)
}
