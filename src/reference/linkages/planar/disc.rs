//! Positions continued over a disc of complex drives.
//!
//! For a centre z, an approximate inverse Y of the Jacobian and radii r, `N(x) = x − Y F(x; b)`
//! takes the polydisc X, `|x_i − z_i| ≤ r_i`, into its interior for every b of the disc D if
//! `|Y F(z; D)|_i + Σ_k |I − Y F'(X)|_ik r_k < r_i`. The sum alone makes N a contraction in the
//! norm `max |x_i|/r_i`, with a factor κ < 1, so that F has exactly one zero in X for every b in D;
//! the iterates from z are analytic in b and converge uniformly, so the zero is analytic in b, and
//! real where b is.
//!
//! Describes what follows from the same κ: the zero lies within `‖Y F(x; b)‖/(1 − κ)` of any x of
//! X; and from `F' x' = e` with `E = I − Y F'`, hence `x' = Y e + E x'`, that
//! `‖x'‖ ≤ ‖Y e‖/(1 − κ)` and `|x' − Y e|_i ≤ Σ_k |E|_ik r_k ‖x'‖`.

use super::enclosure::{Linkage, Position, apply, defect, exact, largest, reach};
use super::scalar::Round;
use super::series::Series;
use super::system::Pose;
use crate::{Ball, Mag};
use nalgebra::DMatrix;
use rug::Float;

/// A disc of drives with one position, analytic in the drive, for each.
#[derive(Clone, Debug)]
pub(super) struct Disc {
    /// The real centre of the polydisc.
    pub centre: Vec<Float>,
    inverse: DMatrix<f64>,
    /// κ, rounded up.
    factor: Mag,
    /// Where the real part of the disc lies.
    pub drive: Ball,
    /// Radii of the polydisc.
    pub r: Vec<Mag>,
    /// Encloses all its positions.
    pub pose: Pose<Round>,
    /// Encloses the derivatives by the drive.
    pub rates: Vec<Round>,
}

fn balls(v: &[Round]) -> Vec<Ball> {
    v.iter().map(|x| x.0.clone()).collect()
}

/// `max v_i/r_i`.
fn norm(v: impl Iterator<Item = Mag>, r: &[Mag]) -> Mag {
    v.zip(r).fold(Mag::ZERO, |m, (v, r)| m.max(v.div(*r)))
}

impl Linkage {
    /// The disc of that radius around the drive at a position; none if the proof fails.
    pub(super) fn disc(&self, drive: &Ball, position: &Position, radius: Mag) -> Option<Disc> {
        const ROUNDS: usize = 12;
        let system = &self.coarse;
        let z = position.midpoints();
        let y = system.approximate_inverse(&z)?;
        let at: Vec<Ball> = exact(&z, 64);
        let middle = system.pose(at.iter().cloned().map(Round).collect::<Vec<_>>());
        let discs = Round(drive.with_prec(64).widened(radius));
        let step = apply(&y, &balls(&system.residual(&middle, &discs)));
        let needs: Vec<Mag> = step.iter().map(Ball::magnitude).collect();
        let first = |s: &Mag| s.mul(Mag::from_f64(1.25)).max(radius.shift(-20));
        let mut r: Vec<Mag> = needs.iter().map(first).collect();
        for _ in 0..ROUNDS {
            let wide = at.iter().zip(&r).map(|(x, r)| Round(x.widened(*r)));
            let pose = system.pose(wide.collect::<Vec<_>>());
            let j = system.jacobian(&pose);
            let j: Vec<Vec<Ball>> = j.iter().map(|row| balls(row)).collect();
            let e = defect(&y, &j);
            let spread: Vec<Mag> = e.iter().map(|e| reach(e, &r)).collect();
            let due: Vec<Mag> = needs.iter().zip(&spread).map(|(s, e)| s.add(*e)).collect();
            if due.iter().any(|d| !d.is_finite()) {
                return None;
            }
            if due.iter().zip(&r).all(|(d, r)| d < r) {
                let factor = norm(spread.iter().copied(), &r);
                let rates = self.disc_rates(&y, &spread, &r, factor)?;
                return Some(Disc {
                    centre: z,
                    inverse: y,
                    factor,
                    drive: drive.widened(radius),
                    r,
                    pose,
                    rates,
                });
            }
            r = due.iter().map(|d| d.mul(Mag::from_f64(1.05))).collect();
        }
        None
    }

    /// Encloses the rates over the polydisc.
    fn disc_rates(
        &self,
        y: &DMatrix<f64>,
        spread: &[Mag],
        r: &[Mag],
        factor: Mag,
    ) -> Option<Vec<Round>> {
        let n = self.coarse.coordinates;
        let mut unit = vec![Ball::integer(64, 0); n];
        unit[n - 1] = Ball::integer(64, 1);
        let first = apply(y, &unit);
        let rest = Mag::from_f64(1.0).sub_below(factor);
        if rest.is_zero() {
            return None;
        }
        let size = norm(first.iter().map(Ball::magnitude), r).div(rest);
        let rates = first.iter().zip(spread);
        Some(rates.map(|(x, s)| Round(x.widened(s.mul(size)))).collect())
    }

    /// The position of the disc at a real drive in it, from a guess; none if it is not enclosed
    /// within the polydisc.
    pub(super) fn within(&self, disc: &Disc, drive: &Ball, guess: &[Float]) -> Option<Position> {
        if !disc.drive.contains_ball(drive) {
            return None;
        }
        let rounded = |x| Float::with_val(self.bits(), x);
        let mut z: Vec<Float> = guess.iter().map(rounded).collect();
        let y = self.coarse.approximate_inverse(&z)?;
        let mut last = Mag::INFINITY;
        loop {
            let residual = self.residual(&z, drive);
            let step = apply(&y, &residual);
            let size = largest(&step);
            if !size.is_finite() {
                return None;
            }
            // Settled: the step is rounding, and no longer shrinks.
            if size >= last.shift(-3) || size < Mag::power_of_two(-i64::from(self.bits())) {
                return disc.bound(&z, &residual);
            }
            for (z, s) in z.iter_mut().zip(&step) {
                *z -= s.mid();
            }
            last = size;
        }
    }
}

impl Disc {
    /// Encloses the zero by the residual at a point of the polydisc.
    fn bound(&self, z: &[Float], residual: &[Ball]) -> Option<Position> {
        let inside = z.iter().zip(&self.centre).zip(&self.r).all(|((x, c), r)| {
            let way = Ball::new(x.clone(), Mag::ZERO) - Ball::new(c.clone(), Mag::ZERO);
            way.magnitude() <= *r
        });
        let rest = Mag::from_f64(1.0).sub_below(self.factor);
        if !inside || rest.is_zero() {
            return None;
        }
        let step = apply(&self.inverse, residual);
        let off = norm(step.iter().map(Ball::magnitude), &self.r).div(rest);
        let x = z
            .iter()
            .zip(&self.r)
            .map(|(x, r)| Ball::new(x.clone(), off.mul(*r)));
        Some(Position { x: x.collect() })
    }

    /// Returns whether a position at a real drive of the disc is the disc's: its enclosure lies in
    /// the polydisc, where there is but one.
    pub(super) fn owns(&self, drive: &Ball, position: &Position) -> bool {
        let inside =
            |((x, z), r): ((&Ball, &Float), &Mag)| Ball::new(z.clone(), *r).contains_ball(x);
        self.drive.contains_ball(drive)
            && position.x.iter().zip(&self.centre).zip(&self.r).all(inside)
    }
}

/// A guess for the position at a distance from the centre of a series.
pub(super) fn guess(series: &Series, by: &Float) -> Vec<Float> {
    (0..series.coordinates())
        .map(|i| {
            let terms = series.of(i).iter().rev();
            terms.fold(Float::new(by.prec()), |s, c| s * by + c.mid())
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::soundness_tests::both;
    use super::super::tests::{cranked, four_bar};
    use super::*;

    /// Checks that what is not a point of the polydisc, be it by less than a bound has bits, has no
    /// bound by its residual.
    #[test]
    fn only_points_of_the_polydisc_are_bounded() {
        let linkage = cranked(&four_bar());
        let drive = Ball::exact(128, 0.875);
        let start = both(&linkage, &drive).into_iter().next().expect("a mode");
        let disc = linkage
            .disc(&drive, &start, Mag::from_f64(0.05))
            .expect("proved");
        let zero = vec![Ball::integer(64, 0); disc.centre.len()];
        for k in 0..disc.centre.len() {
            for side in [-1, 1] {
                let mut z: Vec<Float> = disc
                    .centre
                    .iter()
                    .map(|x| Float::with_val(400, x))
                    .collect();
                z[k] += disc.r[k].to_float() * side;
                assert!(disc.bound(&z, &zero).is_some());
                z[k] += Float::with_val(64, Float::i_exp(side, -180));
                assert!(disc.bound(&z, &zero).is_none());
            }
        }
    }
}
