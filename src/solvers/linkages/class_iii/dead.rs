//! Dead (extreme) positions: crank and link 2 in line, rockers and sieve at rest.

use super::continuation::ContinuationError;
use super::geometry::ClassIii;
use super::kinematics::State;
use crate::units::Angle;

/// A position in which the crank and link 2 lie in one line.
///
/// Link 2 then transmits nothing of the crank's velocity along itself, so ω3 = ω4 = ω5 = 0 and
/// the driven links turn back.
#[derive(Clone, Copy, Debug)]
pub struct DeadPosition {
    /// The linkage there.
    pub state: State,
    /// Tells whether A lies between O1 and B (crank and link 2 stretched out) or the crank is
    /// folded back over link 2.
    pub stretched: bool,
}

fn alignment(s: &State) -> f64 {
    (s.positions.phi2 - s.phi1).sin()
}

impl ClassIii {
    /// The dead positions of a branch for crank angles from that of `start` to `to`, in
    /// order.
    ///
    /// # Errors
    /// With those found so far, when the branch ends before `to`.
    pub fn dead_positions(
        &self,
        start: &State,
        to: Angle,
    ) -> Result<Vec<DeadPosition>, (Vec<DeadPosition>, ContinuationError)> {
        let to = to.rad();
        if !to.is_finite() {
            return Err((Vec::new(), ContinuationError::NotFinite { phi1: to }));
        }
        let steps = ((to - start.phi1).abs() / 0.02).ceil().max(1.0) as usize;
        let mut found = Vec::new();
        let mut here = *start;
        for k in 1..=steps {
            let phi1 = start.phi1 + (to - start.phi1) * k as f64 / steps as f64;
            let next = match self.follow(&here, Angle::from_rad(phi1)) {
                Ok(s) => s,
                Err(e) => return Err((found, e)),
            };
            let (a, b) = (alignment(&here), alignment(&next));
            // The start counts, the end does not: a whole turn has each position once.
            if a == 0.0 || a * b < 0.0 {
                match self.refine_dead(&here, next.phi1) {
                    Ok(state) => found.push(DeadPosition {
                        state,
                        stretched: (state.positions.phi2 - state.phi1).cos() > 0.0,
                    }),
                    Err(e) => return Err((found, e)),
                }
            }
            here = next;
        }
        Ok(found)
    }

    /// Newton's method on `sin(φ2 − φ1)`, whose derivative at its zero is `±(ω2/ω1 − 1)`, kept
    /// within the bracket.
    fn refine_dead(&self, from: &State, to: f64) -> Result<State, ContinuationError> {
        let (lo, hi) = (from.phi1.min(to), from.phi1.max(to));
        let mut here = *from;
        for _ in 0..30 {
            let d = here.positions.phi2 - here.phi1;
            let step = -d.sin() / (d.cos() * (here.rates.first[0] - 1.0));
            let next = (here.phi1 + step).clamp(lo, hi);
            if !next.is_finite() || next == here.phi1 {
                break;
            }
            let last = step.abs() <= 4.0 * f64::EPSILON * (1.0 + here.phi1.abs());
            here = self.follow(&here, Angle::from_rad(next))?;
            if last {
                break;
            }
        }
        Ok(here)
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{paper, zinchenko};
    use crate::units::Angle;

    #[test]
    fn the_two_extreme_positions_of_the_paper() {
        let linkage = zinchenko();
        let dead = linkage
            .dead_positions(&paper(0.0), Angle::from_rad(std::f64::consts::TAU))
            .unwrap();
        let degrees: Vec<f64> = dead.iter().map(|d| d.state.phi1.to_degrees()).collect();
        assert_eq!(degrees.len(), 2);
        assert!((degrees[0] - 14.4260375).abs() < 1e-7);
        assert!((degrees[1] - 196.0140594).abs() < 1e-7);
        assert!(dead[0].stretched && !dead[1].stretched);
        for d in dead {
            assert!(d.state.rates.first[1..].iter().all(|w| w.abs() < 1e-14));
        }
    }
}

#[cfg(test)]
mod built_tests;
