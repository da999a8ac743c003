//! Continuation along a branch that cannot jump to another one unseen.
//!
//! The Jacobian J of the loop equations depends on the links' angles alone and is Lipschitz with
//! the constant K. Turning the crank by s from a solution x changes the residual by at most
//! `l1 |s|`. With `β = ‖J(x)⁻¹‖` the Newton–Kantorovich theorem (Kantorovich & Akilov,
//! *Functional Analysis*, ch. XVIII) gives, as long as `h = β² K l1 |s| ≤ ½`, exactly one solution
//! within `(1 + √(1 − 2h))/(βK)` of x for **every** crank angle on the way. A step of that length
//! therefore stays on the branch; longer ones are divided. Near a fold the steps shrink to
//! nothing, and the fold is reported.

use super::geometry::ClassIii;
use super::kinematics::State;
use super::loops::{Frame, Jacobian, unit};
use super::positions::Positions;
use crate::units::Angle;
use num_complex::Complex64;

/// The branch could not be followed.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum ContinuationError {
    /// The branch ends: two assembly modes merge in a singular position.
    #[error("the branch ends at the crank angle {phi1} rad: two assembly modes merge there")]
    Fold {
        /// Crank angle in radians up to which the branch was followed.
        phi1: f64,
    },
    /// The start is not a solution of the loop equations.
    #[error("the start at {phi1} rad does not close the loops (correction {correction} rad)")]
    NotClosed {
        /// Crank angle in radians.
        phi1: f64,
        /// Size of the Newton correction in radians.
        correction: f64,
    },
    /// The target angle is NaN or infinite.
    #[error("the crank angle {phi1} is not a finite number")]
    NotFinite {
        /// The value.
        phi1: f64,
    },
    /// The linkage is so close to singular for so long that the proof needs too many steps.
    #[error(
        "gave up at the crank angle {phi1} rad after {steps} steps: the linkage stays nearly singular"
    )]
    TooManySteps {
        /// Crank angle in radians up to which the branch was followed.
        phi1: f64,
        /// Steps taken.
        steps: u32,
    },
    /// The target angle is so large that floats no longer tell crank angles apart well.
    #[error("the crank angle {phi1} rad is beyond 1e6 rad: reduce it by whole turns")]
    TooFar {
        /// The value.
        phi1: f64,
    },
}

/// Below this step, in radians, a branch counts as ended.
const SMALLEST_STEP: f64 = 1e-9;

/// Crank angles beyond this, in radians, are refused: a step of [`SMALLEST_STEP`] has to remain
/// one.
const LARGEST_ANGLE: f64 = 1e6;

/// Steps of one call; the paper's linkage takes about a hundred a turn.
const MOST_STEPS: u32 = 2_000_000;

fn checked(phi1: f64) -> Result<(), ContinuationError> {
    if !phi1.is_finite() {
        Err(ContinuationError::NotFinite { phi1 })
    } else if phi1.abs() > LARGEST_ANGLE {
        Err(ContinuationError::TooFar { phi1 })
    } else {
        Ok(())
    }
}

/// The step with `h = 0.49`: 0.98 of the theorem's leaves room for rounding.
fn longest_step(beta: f64, k: f64, l1: f64) -> f64 {
    0.49 / (beta * beta * k * l1)
}

/// The radius `(1 + √(1 − 2h))/(βK)` within which a solution is the only one during a step.
fn unique_radius(beta: f64, k: f64, l1: f64, step: f64) -> f64 {
    let h = beta * beta * k * l1 * step.abs();
    (1.0 + (1.0 - 2.0 * h).max(0.0).sqrt()) / (beta * k)
}

/// The positions at `phi1` by the first and second derivatives at `from`.
fn predicted(from: &State, phi1: f64) -> Positions {
    let s = phi1 - from.phi1;
    let r = &from.rates;
    from.positions.plus(std::array::from_fn(|i| {
        (r.first[i] + 0.5 * r.second[i] * s) * s
    }))
}

impl ClassIii {
    /// Follows the branch from a configuration to the crank angle `to` and returns it there, its
    /// angles unwrapped.
    ///
    /// # Errors
    /// [`ContinuationError::Fold`] when the branch ends before `to`.
    pub fn follow(&self, from: &State, to: Angle) -> Result<State, ContinuationError> {
        let to = to.rad();
        checked(to)?;
        let k = self.l.lipschitz();
        let mut here = *from;
        for _ in 0..MOST_STEPS {
            let left = to - here.phi1;
            if left == 0.0 {
                return Ok(here);
            }
            let f = Frame::new(&self.l, &here.positions);
            let beta = Jacobian::new(&self.l, &f).inverse_norm();
            let longest = longest_step(beta, k, self.l.l1);
            if !(longest >= SMALLEST_STEP) {
                return Err(ContinuationError::Fold { phi1: here.phi1 });
            }
            let step = left.clamp(-longest, longest);
            let phi1 = if step == left { to } else { here.phi1 + step };
            here = self
                .correct(&here, phi1, unique_radius(beta, k, self.l.l1, step))
                .ok_or(ContinuationError::Fold { phi1: here.phi1 })?;
        }
        Err(ContinuationError::TooManySteps {
            phi1: here.phi1,
            steps: MOST_STEPS,
        })
    }

    /// The solution at `phi1` within `unique` radians of `from`.
    fn correct(&self, from: &State, phi1: f64, unique: f64) -> Option<State> {
        let e1 = unit(phi1);
        let inside = |p: &Positions| {
            let (a, b) = (p.to_array(), from.positions.to_array());
            a.iter().zip(b).all(|(x, y)| (x - y).abs() <= unique)
        };
        // A predictor outside the ball would prove nothing; the centre always lies inside.
        let starts = [predicted(from, phi1), from.positions];
        let found = starts
            .into_iter()
            .find_map(|start| self.newton(e1, start).filter(&inside))?;
        self.state(Angle::from_rad(phi1), found).ok()
    }

    /// A checked start for [`ClassIii::follow`]: the solution at the crank angle `at` near `guess`.
    ///
    /// # Errors
    /// When Newton's method does not settle within `1e-2` rad of the guess, or the position is
    /// singular.
    pub fn state_near(&self, at: Angle, guess: Positions) -> Result<State, ContinuationError> {
        let phi1 = at.rad();
        checked(phi1)?;
        let found = self
            .newton(unit(phi1), guess)
            .filter(|p| p.distance(guess) <= 1e-2);
        let not_closed = ContinuationError::NotClosed {
            phi1,
            correction: self.first_correction(unit(phi1), &guess),
        };
        self.state(at, found.ok_or(not_closed)?)
            .map_err(|_| ContinuationError::Fold { phi1 })
    }

    fn first_correction(&self, e1: Complex64, p: &Positions) -> f64 {
        let f = Frame::new(&self.l, p);
        let (r1, r2) = self.residual(e1, &f);
        match Jacobian::new(&self.l, &f).solve(-r1, -r2) {
            Some(d) => d.iter().fold(0.0, |m: f64, x| m.max(x.abs())),
            None => f64::INFINITY,
        }
    }

    /// The states at the given crank angles, each followed from the one before.
    ///
    /// # Errors
    /// With the states up to there, when the branch ends.
    pub fn sweep(
        &self,
        start: &State,
        angles: impl IntoIterator<Item = Angle>,
    ) -> Result<Vec<State>, (Vec<State>, ContinuationError)> {
        let mut states = Vec::new();
        let mut here = *start;
        for phi1 in angles {
            match self.follow(&here, phi1) {
                Ok(s) => here = s,
                Err(e) => return Err((states, e)),
            }
            states.push(here);
        }
        Ok(states)
    }

    /// [`ClassIii::sweep`] on all cores: the branch is first followed from chunk to chunk, then
    /// within the chunks in parallel. The angles should be in order.
    ///
    /// # Errors
    /// When the branch ends before one of the angles.
    #[cfg(feature = "parallel")]
    pub fn sweep_parallel(
        &self,
        start: &State,
        angles: &[Angle],
    ) -> Result<Vec<State>, ContinuationError> {
        use rayon::prelude::*;
        let size = angles
            .len()
            .div_ceil(4 * rayon::current_num_threads())
            .max(64);
        let mut heads = Vec::new();
        let mut here = *start;
        for chunk in angles.chunks(size) {
            here = self.follow(&here, chunk[0])?;
            heads.push(here);
        }
        let parts: Result<Vec<Vec<State>>, ContinuationError> = angles
            .par_chunks(size)
            .zip(heads)
            .map(|(chunk, head)| self.sweep(&head, chunk.iter().copied()).map_err(|e| e.1))
            .collect();
        Ok(parts?.concat())
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{paper, zinchenko};
    use super::*;

    #[test]
    fn a_whole_turn_closes() {
        let linkage = zinchenko();
        let phi1 = 14.426f64.to_radians();
        let start = paper(phi1);
        let end = linkage
            .follow(&start, Angle::from_rad(phi1 + std::f64::consts::TAU))
            .unwrap();
        let (a, b) = (start.positions.to_array(), end.positions.to_array());
        assert!(a.iter().zip(b).all(|(x, y)| (x - y).abs() < 1e-13));
        // Steps of any size give the same states.
        let angles: Vec<Angle> = (0..=1000)
            .map(|k| Angle::from_rad(phi1 + k as f64 * 1e-3))
            .collect();
        let fine = linkage.sweep(&start, angles.iter().copied()).unwrap();
        let coarse = linkage.follow(&start, angles[1000]).unwrap();
        assert!(fine[1000].positions.distance(coarse.positions) < 1e-13);
        #[cfg(feature = "parallel")]
        {
            let parallel = linkage.sweep_parallel(&start, &angles).unwrap();
            assert_eq!(fine.len(), parallel.len());
            for (a, b) in fine.iter().zip(&parallel) {
                assert_eq!(a.phi1, b.phi1);
                assert!(a.positions.distance(b.positions) < 1e-13);
            }
        }
    }

    #[test]
    fn a_fold_ends_the_branch() {
        let linkage = zinchenko();
        let phi1 = 200f64.to_radians();
        let modes = linkage.assembly_modes(Angle::from_rad(phi1)).modes;
        let folding = modes
            .iter()
            .filter_map(|m| {
                linkage
                    .follow(
                        &linkage.state_near(Angle::from_rad(phi1), *m).unwrap(),
                        Angle::from_rad(4.0),
                    )
                    .err()
            })
            .collect::<Vec<_>>();
        assert_eq!(folding.len(), 2);
        for e in folding {
            let ContinuationError::Fold { phi1 } = e else {
                panic!("{e}")
            };
            // The reported angle is the last one certified, at most a little short of the fold.
            let short = 217.270876406 - phi1.to_degrees();
            assert!((0.0..1e-4).contains(&short), "{short}");
        }
    }

    #[test]
    fn bad_starts_and_far_angles_are_refused() {
        let linkage = zinchenko();
        let e = linkage.follow(&paper(0.3), Angle::from_rad(1e7));
        assert!(matches!(e, Err(ContinuationError::TooFar { .. })), "{e:?}");
        let p = Positions::from_array([0.0; 4]);
        assert!(matches!(
            linkage.state_near(Angle::from_rad(0.3), p),
            Err(ContinuationError::NotClosed { .. })
        ));
        for bad in [f64::NAN, f64::INFINITY] {
            assert!(matches!(
                linkage.state_near(Angle::from_rad(bad), p),
                Err(ContinuationError::NotFinite { .. })
            ));
        }
    }
}

#[cfg(test)]
mod step_tests;
