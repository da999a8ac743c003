//! The position nearest to approximate coordinates, with the proof that none is nearer.
//!
//! Let d be the largest difference of a position's coordinates from the approximate ones g, and X
//! the cube of half-width d around g. By the mean value theorem, row by row,
//! `F(x) − F(x') = A (x − x')` for x, x' in X with a matrix A of the interval matrix `F'(X)`. If
//! `‖I − Y F'(X)‖ < 1`, every such A is regular: F is one to one on X, and every other position is
//! farther than d from g.

use super::enclosure::{Linkage, Position, exact, reach as sum_of};
use crate::{Ball, Mag, Undecided};
use rug::Float;

impl Linkage {
    /// The position at that value of the drive whose largest difference from `guess` over all
    /// coordinates (the angles of all moving bodies, where there are no slides or slots) is least,
    /// if that is at most `reach`; none if it is proved that none is within `reach`.
    ///
    /// Angles are real numbers, not reduced by whole turns: a position and its whole turns are
    /// several.
    ///
    /// # Errors
    /// [`Undecided`] where positions nearly meet, where the guess is so far off that another
    /// position could be nearer, and where neither can be proved.
    pub fn nearest(
        &self,
        drive: &Ball,
        guess: &[f64],
        reach: f64,
    ) -> Result<Option<Position>, Undecided> {
        let at: Vec<Float> = guess.iter().map(|x| Float::with_val(64, *x)).collect();
        let off = |p: &Position| {
            let differences = p.x.iter().zip(&at).map(|(x, g)| {
                let g = Ball::new(g.clone(), Mag::ZERO).with_prec(self.bits());
                (x - &g).magnitude()
            });
            differences.fold(Mag::ZERO, Mag::max)
        };
        if let Some(position) = self.enclose(drive, &at) {
            let off = off(&position);
            if off <= Mag::from_f64(reach) && self.single_within(&at, off) {
                return Ok(Some(position));
            }
        }
        match self.none_within(drive, &at, reach) {
            true => Ok(None),
            false => {
                Err(self.undecided("which position is nearest to the one given is not proved"))
            }
        }
    }

    /// Returns whether F is one to one on the cube around g.
    fn single_within(&self, g: &[Float], half: Mag) -> bool {
        let Some(y) = self.coarse.approximate_inverse(g) else {
            return false;
        };
        let e = self.coarse.contraction(&y, g, &vec![half; g.len()]);
        let one = vec![Mag::from_f64(1.0); g.len()];
        e.iter().all(|row| sum_of(row, &one) < Mag::from_f64(1.0))
    }

    /// Returns whether an equation cannot be zero on the cube around g.
    fn none_within(&self, drive: &Ball, g: &[Float], half: f64) -> bool {
        let system = &self.coarse;
        let wide = exact(g, 64).into_iter();
        let wide = wide.map(|x| x.widened(Mag::from_f64(half))).collect();
        let over = system.residual(&system.pose(wide), &drive.with_prec(64));
        over.iter().any(|f| !f.contains_zero())
    }
}

#[cfg(test)]
mod tests;
