//! A part of the path of a conservative motion: the branch, analytic in the drive, and bounds on I
//! and W.

use super::disc::{Disc, guess};
use super::enclosure::{Linkage, Position};
use super::energy::Load;
use super::scalar::Scalar;
use super::series::Series;
use super::system::Pose;
use crate::{Ball, Mag, Undecided};
use rug::float::Round;
use rug::{Float, Rational};

/// Half-axis over h of the ellipse with ρ = 4 and the foci `c ± h`, `(ρ + 1/ρ)/2`.
pub(super) const REACH: f64 = 2.125;
/// Where I and W are bounded, over h: the ellipse with room for roundings.
pub(super) const BOUNDED: f64 = 2.15625;
/// Radius of the disc of positions over that of the disc where I and W are bounded.
const WIDER: f64 = 1.625;
/// Taylor coefficients that bound I and W.
const ORDER: usize = 20;

/// Positions over a disc of drives, and what is known of I and V there.
pub(super) struct Branch {
    disc: Disc,
    centre: Ball,
    series: Series,
    radius: Mag,
    inertia: Vec<Ball>,
    potential: Vec<Ball>,
    /// Bounds on |I| and |V| on the disc.
    most: [Mag; 2],
}

/// A part of the path with a bound on the integrand.
pub(super) struct Panel {
    pub branch: Branch,
    /// Left end.
    pub from: Ball,
    pub half: Float,
    /// Where the bound holds, around the panel's middle.
    pub reach: Mag,
    /// Bound of `√(I/2W)`.
    pub most: Mag,
    /// Lower bound of `W/(b − b0)` over the panel.
    pub least_force: f64,
}

/// A linkage and its load at both precisions.
pub(super) struct Loaded<'a> {
    pub linkage: &'a Linkage,
    /// The same with 64 bits.
    low: Linkage,
    pub fine: Load,
    coarse: Load,
    pub start: Ball,
    pub resting: Position,
    /// V at the start.
    potential: Ball,
}

/// A lower bound in `f64` of a lower bound.
fn below(x: Mag) -> f64 {
    x.to_float().to_f64_round(Round::Down)
}

pub(super) fn exact(x: &Float) -> Ball {
    Ball::new(x.clone(), Mag::ZERO)
}

/// A bound on `|Σ_{n≥from} a_n s^{n−down}|` for `|s| ≤ reach`: coefficients as far as they are
/// known, then Cauchy's `|a_n| ≤ M/R^n` for a function that M bounds on the disc of radius R.
pub(super) fn tail(
    series: &[Ball],
    most: Mag,
    radius: Mag,
    [from, down]: [usize; 2],
    reach: Mag,
) -> Mag {
    let mut power = Mag::from_f64(1.0);
    let mut sum = Mag::ZERO;
    for (n, a) in series.iter().enumerate().skip(down) {
        if n >= from {
            sum = sum.add(a.magnitude().mul(power));
        }
        power = power.mul(reach);
    }
    // M/R^n reach^(n − down) from the first unknown n on, a geometric series.
    let radius = Mag::below(&radius.to_float());
    let (inverse, ratio) = (Mag::from_f64(1.0).div(radius), reach.div(radius));
    let mut first = most;
    for n in 0..series.len() {
        first = first.mul(if n < down { inverse } else { ratio });
    }
    sum.add(first.div(Mag::from_f64(1.0).sub_below(ratio)))
}

impl Branch {
    /// An upper bound on I for `|s| ≤ reach`; none unless I is not zero there.
    fn inertia(&self, reach: Mag) -> Option<Mag> {
        let spread = tail(&self.inertia, self.most[0], self.radius, [1, 0], reach);
        let first = &self.inertia[0];
        let least = first.mignitude().sub_below(spread);
        (!least.is_zero()).then(|| first.magnitude().add(spread))
    }

    /// A bound on `|V_2 s^{2−down} + V_3 s^{3−down} + …|`.
    fn curved(&self, down: usize, reach: Mag) -> Mag {
        tail(&self.potential, self.most[1], self.radius, [2, down], reach)
    }

    /// A guess at the position there.
    pub(super) fn guess(&self, drive: &Ball) -> Vec<Float> {
        let by = Float::with_val(64, drive.mid() - self.centre.mid());
        guess(&self.series, &by)
    }
}

impl<'a> Loaded<'a> {
    pub(super) fn new(
        linkage: &'a Linkage,
        forces: &super::energy::Forces,
        start: &Ball,
        resting: Position,
    ) -> Loaded<'a> {
        Loaded {
            low: Linkage {
                fine: linkage.coarse.clone(),
                ..linkage.clone()
            },
            fine: Load::new(&linkage.mechanism, forces, linkage.bits()),
            coarse: Load::new(&linkage.mechanism, forces, 64),
            start: start.clone(),
            potential: linkage.potential(&resting, forces),
            resting,
            linkage,
        }
    }

    /// W at a position.
    pub(super) fn work(&self, drive: &Ball, position: &Position) -> Ball {
        self.work_of(drive, &self.linkage.fine.pose(position.x.clone()))
    }

    fn work_of(&self, drive: &Ball, pose: &Pose<Ball>) -> Ball {
        &self.fine.drive * &(drive - &self.start) - self.fine.potential(pose) + &self.potential
    }

    /// `I/2W` at a drive and the position there, times `factor`.
    fn ratio(&self, drive: &Ball, position: &Position, factor: &Ball) -> Option<Ball> {
        let pose = self.linkage.fine.pose(position.x.clone());
        let rates = self.linkage.rates(position).ok()?;
        let inertia = self.fine.inertia(&pose, &rates);
        Some(factor * &inertia / self.work_of(drive, &pose).shift(1))
    }

    /// The position at a drive of a branch.
    pub(super) fn on(&self, branch: &Branch, drive: &Ball) -> Result<Position, Undecided> {
        self.linkage
            .within(&branch.disc, drive, &branch.guess(drive))
            .ok_or_else(|| {
                self.linkage
                    .undecided("a position is not shown to be on the branch")
            })
    }

    /// `√(factor I/2W)` at a drive of a branch.
    pub(super) fn slowness(
        &self,
        branch: &Branch,
        drive: &Ball,
        factor: &Ball,
    ) -> Result<Ball, Undecided> {
        let position = self.on(branch, drive)?;
        let ratio = self.ratio(drive, &position, factor);
        let singular = || self.linkage.undecided("the Jacobian may be singular");
        Ok(ratio.ok_or_else(singular)?.sqrt())
    }

    /// The branch of a position over a disc that exceeds `reach`.
    fn branch(&self, centre: &Ball, middle: &Position, reach: Mag) -> Option<Branch> {
        let radius = reach.mul(Mag::from_f64(WIDER));
        let disc = self.linkage.disc(centre, middle, radius)?;
        if !disc.owns(centre, middle) {
            return None;
        }
        let at = Position {
            x: middle.x.iter().map(|x| x.with_prec(64)).collect(),
        };
        let series = self.low.series(&at, ORDER + 1).ok()?;
        Some(Branch {
            radius,
            inertia: self.coarse.inertia_series(&series),
            potential: self.coarse.potential_series(&series),
            most: [
                self.coarse.inertia(&disc.pose, &disc.rates).size(),
                self.coarse.potential(&disc.pose).size(),
            ],
            centre: centre.clone(),
            series,
            disc,
        })
    }

    /// The first panel, in `x = √(b − b0)` from 0 to the root of `width`; none if a proof fails.
    pub(super) fn first(&self, width: &Float) -> Option<Panel> {
        // |x| ≤ (1 + 17/8) √width/2 on the ellipse.
        let share = (1.0 + REACH) / 2.0;
        let reach = Mag::above(width).mul(Mag::from_f64(share * share));
        let branch = self.branch(&self.start, &self.resting, reach)?;
        let inertia = branch.inertia(reach)?;
        // W/(b − b0) = Q − V_1 − V_2 (b − b0) − …
        let force = &self.coarse.drive - &branch.potential[1];
        let least = force.mignitude().sub_below(branch.curved(1, reach));
        if least.is_zero() || !force.is_positive() {
            return None;
        }
        Some(Panel {
            branch,
            from: self.start.clone(),
            half: width.clone() >> 1,
            reach,
            most: inertia.div(least.shift(1)).sqrt(),
            least_force: below(least),
        })
    }

    /// The panel of half-length `half` from a drive and a position; none if a proof fails.
    pub(super) fn panel(
        &self,
        from: &Ball,
        at: &Position,
        before: &Branch,
        half: &Float,
    ) -> Option<Panel> {
        let centre = from + &exact(half);
        let middle = self
            .linkage
            .position(&centre, &before.guess(&centre))
            .ok()?;
        let reach = Mag::above(half).mul(Mag::from_f64(BOUNDED));
        let branch = self.branch(&centre, &middle, reach)?;
        if !branch.disc.owns(from, at) {
            return None;
        }
        let inertia = branch.inertia(reach)?;
        // W(c) + (Q − V_1) (b − c) − V_2 (b − c)² − …
        let work = self.work(&centre, &middle).with_prec(64);
        let slope = &self.coarse.drive - &branch.potential[1];
        let spread = slope.magnitude().mul(reach).add(branch.curved(0, reach));
        let least = work.mignitude().sub_below(spread);
        if least.is_zero() || !work.is_positive() {
            return None;
        }
        let far = (&centre - &self.start).magnitude().add(Mag::above(half));
        Some(Panel {
            branch,
            from: from.clone(),
            half: half.clone(),
            reach,
            most: inertia.div(least.shift(1)).sqrt(),
            least_force: (below(least) / far.to_f64()).next_down(),
        })
    }
}

/// A power of four as an exact float.
pub(super) fn power_of_four(k: i32, bits: u32) -> Float {
    Float::with_val(bits, Rational::from(1)) << (2 * k)
}

#[cfg(test)]
mod tests {
    use super::super::tests::oscillator;
    use super::*;

    const BITS: u32 = 192;

    /// The oscillator of mass 2 with `W = 3 (b − b0) − 4 (b² − b0²)` from b0 = 1/8.
    fn loaded<'a>(linkage: &'a Linkage, forces: &super::super::Forces) -> Loaded<'a> {
        let start = Ball::exact(BITS, 0.125);
        let at = [0.0, 0.125].map(|x| Float::with_val(64, x));
        let resting = linkage.position(&start, &at).expect("proved");
        Loaded::new(linkage, forces, &start, resting)
    }

    fn wide(mid: f64, rad: f64) -> Ball {
        Ball::exact(BITS, mid).widened(Mag::from_f64(rad))
    }

    fn bounds(found: f64, due: f64) {
        assert!(found >= due && found < 1.005 * due, "{found} {due}");
    }

    fn bounds_below(found: f64, due: f64) {
        assert!(found <= due && found > 0.995 * due, "{found} {due}");
    }

    /// `W/(b − b0) = 2 − 4 (b − b0)` and `√(I/2W)` as `√((b − b0)/W)` over the first panel's
    /// ellipse.
    #[test]
    fn the_first_panel_of_an_oscillator() {
        let (linkage, forces) = oscillator();
        let mut loaded = loaded(&linkage, &forces);
        let width = power_of_four(-2, BITS);
        let panel = loaded.first(&width).expect("a panel");
        let reach = (25.0f64 / 16.0).powi(2) / 16.0;
        bounds(panel.reach.to_f64(), reach);
        assert_eq!(panel.half, 1.0 / 32.0);
        bounds_below(panel.least_force, 2.0 - 4.0 * reach);
        bounds(panel.most.to_f64(), (2.0 - 4.0 * reach).sqrt().recip());
        // Four times as long the force is zero on the ellipse.
        assert!(loaded.first(&power_of_four(-1, BITS)).is_none());
        // A force that is known within a half.
        loaded.coarse.drive = wide(3.0, 0.5);
        let panel = loaded.first(&width).expect("a panel");
        bounds_below(panel.least_force, 1.5 - 4.0 * reach);
        bounds(panel.most.to_f64(), (1.5 - 4.0 * reach).sqrt().recip());
        // Backwards there is no motion, whatever the force's size.
        loaded.coarse.drive = wide(-3.0, 0.0);
        assert!(loaded.first(&width).is_none());
    }

    /// A panel from 3/16 to 7/32: W at its middle less what slope and curvature take over the
    /// reach.
    #[test]
    fn a_later_panel_of_an_oscillator() {
        let (linkage, forces) = oscillator();
        let mut loaded = loaded(&linkage, &forces);
        let first = loaded.first(&power_of_four(-2, BITS)).expect("a panel");
        let from = Ball::exact(BITS, 0.1875);
        let at = loaded.on(&first.branch, &from).expect("a position");
        let half = Float::with_val(64, 1.0 / 64.0);
        let check = |loaded: &Loaded, work: f64, slope: f64, start: f64| {
            let panel = loaded
                .panel(&from, &at, &first.branch, &half)
                .expect("a panel");
            let (c, reach) = (0.203125, 2.15625 / 64.0);
            bounds(panel.reach.to_f64(), reach);
            let whole = 3.0 * (c - 0.125) - 4.0 * (c * c - 1.0 / 64.0);
            let least = whole - work - (3.0 - 8.0 * c + slope) * reach - 4.0 * reach * reach;
            bounds(panel.most.to_f64(), least.sqrt().recip());
            bounds_below(panel.least_force, least / (c - start + 1.0 / 64.0));
        };
        check(&loaded, 0.0, 0.0, 0.125);
        // The slope, the work, the start known within a radius.
        loaded.coarse.drive = wide(3.0, 0.5);
        check(&loaded, 0.0, 0.5, 0.125);
        loaded.coarse.drive = wide(3.0, 0.0);
        loaded.fine.drive = wide(3.0, 0.5);
        check(&loaded, 0.5 * 0.078125, 0.0, 0.125);
        loaded.fine.drive = wide(3.0, 0.0);
        loaded.start = wide(0.125, 0.005);
        check(&loaded, 0.015, 0.0, 0.12);
    }

    /// A position that reaches out of its polydisc starts no branch.
    #[test]
    fn a_branch_owns_its_middle() {
        let (linkage, forces) = oscillator();
        let loaded = loaded(&linkage, &forces);
        let reach = Mag::from_f64(0.01);
        let middle = loaded.resting.clone();
        assert!(loaded.branch(&loaded.start, &middle, reach).is_some());
        let x = middle.x.iter().map(|x| x.widened(Mag::from_f64(1.0)));
        let out = Position { x: x.collect() };
        assert!(loaded.branch(&loaded.start, &out, reach).is_none());
    }

    /// Bounds on I and on V from its curvature on, by coefficients and a geometric series.
    #[test]
    fn bounds_by_coefficients() {
        let (linkage, forces) = oscillator();
        let loaded = loaded(&linkage, &forces);
        let mut branch = loaded
            .branch(&loaded.start, &loaded.resting, Mag::from_f64(0.01))
            .expect("a branch");
        branch.radius = Mag::from_f64(2.0);
        branch.most = [10.0, 20.0].map(Mag::from_f64);
        branch.inertia = vec![wide(3.0, 0.25), wide(-1.0, 0.125)];
        branch.potential = [(7.0, 0.0), (5.0, 0.0), (-2.0, 0.5), (1.0, 0.0)]
            .map(|(mid, rad)| wide(mid, rad))
            .to_vec();
        // 9/8 s + 10 (s/2)²/(1 − s/2).
        let spread = |s: f64| 1.125 * s + 10.0 * (s / 2.0).powi(2) / (1.0 - s / 2.0);
        for s in [0.5, 0.7] {
            let most = branch.inertia(Mag::from_f64(s)).expect("not zero");
            bounds(most.to_f64(), 3.25 + spread(s));
        }
        // 2.835 is more than 3 − 1/4.
        for s in [0.72, 1.0, 1.9] {
            assert!(branch.inertia(Mag::from_f64(s)).is_none(), "{s}");
        }
        let curved = |down: usize| branch.curved(down, Mag::from_f64(0.5)).to_f64();
        let rest = 20.0 / 256.0 / 0.75;
        bounds(curved(0), 2.5 / 4.0 + 1.0 / 8.0 + rest);
        bounds(curved(1), 2.5 / 2.0 + 1.0 / 4.0 + 2.0 * rest);
    }

    #[test]
    fn powers_of_four() {
        for (k, due) in [(-3, 1.0 / 64.0), (0, 1.0), (-1, 0.25), (2, 16.0)] {
            assert_eq!(power_of_four(k, BITS), due);
        }
    }
}
