//! All assembly modes at a value of the drive, with the proof that none is missing.
//!
//! Branch and prune over a compact chart of the bodies' angles ([`chart`](super::chart)). A box
//! goes when an equation cannot be zero on it or when `K(X)` does not meet it, every zero of X
//! being one of `K(X)`; it is settled when `K(X)` lies in the interior of X, which proves one zero;
//! else it is cut to `K(X)` or halved. Boxes overlap a little, so that zeros on common faces lie
//! inside some box; what is found twice, by whole turns too, is told by the box in which a zero is
//! alone.

use super::chart::Equation;
use super::enclosure::{Linkage, Position, apply, defect, exact, reach};
use crate::ball::{greater, lesser};
use crate::{Ball, Mag, Undecided};
use rug::{Float, Rational};

/// Boxes looked at before the search is given up: some seconds.
const MOST_BOXES: usize = 100_000;
/// Boxes narrower than this are left undecided: modes that meet, or nearly so.
const NARROWEST: f64 = 1e-6;

/// A zero and a box in which it is the only one.
pub(super) struct Found {
    pub position: Position,
    pub alone: Vec<Ball>,
}

/// Describes what is made of a box.
enum Look {
    Empty,
    Single(Vec<Ball>),
    Smaller(Vec<Ball>),
    Open,
}

pub(super) fn intersection(a: &Ball, b: &Ball) -> Option<Ball> {
    let low = greater(a.lower(), b.lower());
    let high = lesser(a.upper(), b.upper());
    (low <= high).then(|| Ball::between(64, &low, &high))
}

impl Linkage {
    /// Every position at that value of the drive, proved to be all, in no particular order; angles
    /// of bodies up to whole turns that keep gears and drive (a crank at 4 rad is none at 4 − 2π).
    ///
    /// # Errors
    /// [`Undecided`] with the number of boxes that are left where modes meet or nearly so, where
    /// the search takes too long, and for mechanisms with slides or slots, whose displacements lie
    /// in no compact chart.
    pub fn modes(&self, drive: &Ball) -> Result<Vec<Position>, Undecided> {
        self.modes_within(drive, MOST_BOXES)
    }

    /// [`Linkage::modes`] by a look at `most` boxes at most.
    fn modes_within(&self, drive: &Ball, most: usize) -> Result<Vec<Position>, Undecided> {
        let n = self.coarse.coordinates;
        if n != self.coarse.bodies {
            return Err(self.undecided("displacements have no compact chart"));
        }
        let coarse = drive.with_prec(64);
        let mut boxes = vec![self.coarse.chart(&self.linear(&coarse))];
        let mut found: Vec<Found> = Vec::new();
        let (mut looked, mut left) = (0, 0);
        while let Some(x) = boxes.pop() {
            looked += 1;
            if looked > most {
                let open = boxes.len() + 1 + left;
                return Err(
                    self.undecided(&format!("{open} boxes are left of the search for modes"))
                );
            }
            match self.look(&x, &coarse) {
                Look::Empty => {}
                Look::Single(alone) => self.record(drive, alone, &mut found)?,
                Look::Smaller(cut) => boxes.push(cut),
                Look::Open => {
                    let width = |b: &Ball| b.rad().to_f64();
                    let widest = (0..n).max_by(|&i, &j| width(&x[i]).total_cmp(&width(&x[j])));
                    let Some(i) = widest.filter(|&i| width(&x[i]) > NARROWEST) else {
                        left += 1;
                        continue;
                    };
                    let mid = x[i].mid();
                    for (low, high) in [(&x[i].lower(), mid), (mid, &x[i].upper())] {
                        let mut half = x.clone();
                        half[i] = Ball::between(64, low, high);
                        boxes.push(half);
                    }
                }
            }
        }
        if left > 0 {
            return Err(self.undecided(&format!("{left} boxes are left of the search for modes")));
        }
        Ok(found.into_iter().map(|f| f.position).collect())
    }

    /// Gears and drive.
    fn linear(&self, drive: &Ball) -> Vec<Equation> {
        let relations = &self.mechanism.loops.relations;
        let gears = relations.iter().zip(&self.coarse.relations);
        let gears = gears.map(|(exact, r)| (exact.terms.clone(), r.constant.clone()));
        let drive = (self.drive.0.clone(), drive.clone());
        gears.chain([drive]).collect()
    }

    /// Returns whether whole turns of the bodies change no gear and no drive.
    pub(super) fn keeps(&self, turns: &[i64]) -> bool {
        let relations = self.mechanism.loops.relations.iter().map(|r| &r.terms);
        relations.chain([&self.drive.0]).all(|terms| {
            let sum: Rational = terms
                .iter()
                .map(|(i, k)| Rational::from(k * turns[*i]))
                .sum();
            sum.is_zero()
        })
    }

    fn look(&self, x: &[Ball], drive: &Ball) -> Look {
        let system = &self.coarse;
        let over = system.residual(&system.pose(x.to_vec()), drive);
        if over.iter().any(|f| !f.contains_zero()) {
            return Look::Empty;
        }
        // A tenth wider, and never of no width.
        let wide =
            |b: &Ball| b.widened(b.rad().mul(Mag::from_f64(0.1)).add(Mag::power_of_two(-40)));
        let wide: Vec<Ball> = x.iter().map(wide).collect();
        let z: Vec<Float> = wide.iter().map(|b| b.mid().clone()).collect();
        let Some(y) = system.approximate_inverse(&z) else {
            return Look::Open;
        };
        let step = apply(&y, &system.residual(&system.pose(exact(&z, 64)), drive));
        let e = defect(&y, &system.jacobian(&system.pose(wide.clone())));
        let r: Vec<Mag> = wide.iter().map(Ball::rad).collect();
        let spread: Vec<Mag> = e.iter().map(|e| reach(e, &r)).collect();
        let inside = |i: usize| step[i].magnitude().add(spread[i]) < r[i];
        if (0..x.len()).all(inside) {
            return Look::Single(wide);
        }
        let mut cut = Vec::with_capacity(x.len());
        let mut shrunk = false;
        for i in 0..x.len() {
            let image = (Ball::new(z[i].clone(), Mag::ZERO) - &step[i]).widened(spread[i]);
            let Some(rest) = (match image.is_finite() {
                true => intersection(&x[i], &image),
                false => Some(x[i].clone()),
            }) else {
                return Look::Empty;
            };
            shrunk |= rest.rad() < x[i].rad().mul(Mag::from_f64(0.6))
                && x[i].rad() > Mag::power_of_two(-40);
            cut.push(rest);
        }
        if shrunk {
            Look::Smaller(cut)
        } else {
            Look::Open
        }
    }

    /// Adds the only zero of a box unless it is known.
    pub(super) fn record(
        &self,
        drive: &Ball,
        alone: Vec<Ball>,
        found: &mut Vec<Found>,
    ) -> Result<(), Undecided> {
        let guess: Vec<Float> = alone.iter().map(|b| b.mid().clone()).collect();
        let position = self.position(drive, &guess)?;
        let mut parts = alone.iter().zip(&position.x);
        if !parts.all(|(a, x)| a.contains_ball(x)) {
            return Err(self.undecided("a mode leaves the box in which it is alone"));
        }
        let turn = Ball::pi(self.bits()).shift(1);
        // The whole turns that bring an angle next to another.
        let turns =
            |x: &Ball, to: &Ball| ((to - x).mid().to_f64() / std::f64::consts::TAU).round() as i64;
        let moved = |x: &Ball, by: i64| x + &(Ball::integer(self.bits(), by) * &turn);
        for known in found.iter() {
            let apart = position.x.iter().zip(&known.position.x);
            let apart = apart
                .into_iter()
                .any(|(x, k)| !moved(x, turns(x, k)).overlaps(k));
            let by: Vec<i64> = (position.x.iter().zip(&known.alone))
                .map(|(x, a)| turns(x, a))
                .collect();
            let there = position.x.iter().zip(&by).zip(&known.alone);
            // Turns that do not keep gears and drive lead to no solution, wherever.
            let same = self.keeps(&by)
                && there
                    .into_iter()
                    .all(|((x, v), a)| a.contains_ball(&moved(x, *v)));
            match (same, apart) {
                (true, _) => return Ok(()),
                (false, true) => {}
                (false, false) => return Err(self.undecided("two modes are not told apart")),
            }
        }
        found.push(Found { position, alone });
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::super::Drive;
    use super::super::tests::four_bar;
    use super::*;

    #[test]
    fn a_search_ends_after_so_many_boxes() {
        let linkage = Linkage::new(&four_bar(), &Drive::coordinate(0), 64).unwrap();
        let drive = Ball::exact(64, 0.875);
        let reason = |most: usize| linkage.modes_within(&drive, most).map_err(|why| why.reason);
        // The first box and nothing looked at.
        let found = reason(0).unwrap_err();
        assert_eq!(found, "1 boxes are left of the search for modes");
        let enough = (1..).find(|most| reason(*most).is_ok()).unwrap();
        assert_eq!(reason(enough).unwrap().len(), 2);
        // Of a search that would have ended with it.
        assert_eq!(reason(enough - 1).unwrap_err(), found);
    }

    /// A mode that was found elsewhere, and whose ball shares points with this one's without
    /// holding it.
    #[test]
    fn modes_that_may_be_one_are_not_counted_as_two() {
        let linkage = Linkage::new(&four_bar(), &Drive::coordinate(0), 64).unwrap();
        let drive = Ball::exact(64, 0.875);
        let mode = linkage.modes(&drive).unwrap().remove(0);
        let alone: Vec<Ball> = mode.x.iter().map(|x| x.widened(x.rad())).collect();
        let mut found = Vec::new();
        linkage.record(&drive, alone.clone(), &mut found).unwrap();
        found[0].alone = alone.iter().map(|a| a + &Ball::integer(64, 1)).collect();
        let x = &found[0].position.x[1];
        assert!(!x.rad().is_zero());
        let radius = x.rad().to_float();
        let beside = Ball::new(Float::with_val(80, x.mid() + &radius), x.rad());
        found[0].position.x[1] = beside;
        let refused = linkage.record(&drive, alone.clone(), &mut found);
        let reason = refused.unwrap_err().reason;
        assert_eq!(reason, "two modes are not told apart");
        // Off by more than both radii they are two.
        let x = &mut found[0].position.x[1];
        *x = &*x + &Ball::exact(64, 0.25);
        linkage.record(&drive, alone, &mut found).unwrap();
        assert_eq!(found.len(), 2);
    }
}
