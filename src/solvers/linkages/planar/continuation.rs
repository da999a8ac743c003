//! Continuation along a branch that cannot jump to another one unseen.
//!
//! Let F(u, φ) be the closures with the Jacobian J in the unknowns, A = J⁻¹ at the solution u₀, φ₀
//! and u' = −A F_φ. With the bounds k, m, w of [`super::bounds`] on the rows' second derivatives
//! let
//!
//! ```text
//! κ = ‖|A| k‖,  μ = ‖|A| m‖,  ω = ‖|A| w‖,  ν = ‖u'‖      (maximum norms)
//! ```
//!
//! For |s| ≤ S and all u within r of c(s) = u₀ + u' s, Taylor's formula gives
//!
//! ```text
//! ‖1 − A J(u, φ₀ + s)‖ ≤ κ (ν S + r) + μ S,
//! ‖A F(c(s), φ₀ + s)‖  ≤ ½ S² (κ ν² + 2 μ ν + ω).
//! ```
//!
//! Where the first is at most ½ and the second at most r/2, `u − A F(u, φ₀ + s)` maps that ball
//! into itself and contracts: for **every** value of the drive on the way there is exactly one
//! solution in the ball, and they join continuously. A step of that length stays on the branch;
//! longer ones are divided. Near a singular position the steps shrink to nothing.

use super::bounds::{SLACK, bounds};
use super::chain::{Bound, Chain};
use super::error::PositionError;
use super::mechanism::Mechanism;
use super::newton::Work;
use super::state::State;

/// Below this step, in radians or units of length, a branch counts as ended.
const SMALLEST_STEP: f64 = 1e-9;
/// The drive beyond this, in radians or units of length, is refused: a step of [`SMALLEST_STEP`]
/// has to remain one.
const LARGEST_DRIVE: f64 = 1e6;
/// Steps of one call.
const MOST_STEPS: u32 = 2_000_000;
/// Leaves room for rounding.
const SAFETY: f64 = 0.98;

/// A step that is proved: its length, the radius around the tangent's end, and the bounds κ and μ.
#[derive(Clone, Copy, Debug, Default)]
struct Step {
    length: f64,
    radius: f64,
    kappa: f64,
    mu: f64,
}

impl Step {
    /// The longest one by κ, μ, ω and ν; of no length where they are not finite or it is below
    /// [`SMALLEST_STEP`].
    fn proved([kappa, mu, omega]: [f64; 3], nu: f64) -> Step {
        let radius = (0.25 / kappa).min(0.5 * SLACK);
        let contracts = 0.25 / (kappa * nu + mu);
        let within = (radius / (kappa * nu * nu + 2.0 * mu * nu + omega)).sqrt();
        let near = 0.5 * SLACK / nu.max(1.0);
        let sound = [kappa, mu, omega, nu].iter().all(|x| x.is_finite());
        let length = SAFETY * contracts.min(within).min(near);
        Step {
            length: match sound && length >= SMALLEST_STEP {
                true => length,
                false => 0.0,
            },
            radius,
            kappa,
            mu,
        }
    }

    /// The part that a correction by the anchor's factors leaves of itself, at unknowns `off` from
    /// its own and the drive `s` from its: in the ball `|J⁻¹|` is at most twice that of the anchor.
    fn left(&self, off: f64, s: f64) -> f64 {
        4.0 * (self.kappa * off + self.mu * s.abs())
    }
}

/// The state from which a step is proved. For all values of the drive within its length the branch
/// is the one solution in the ball around the tangent's end, so that further states may be found in
/// it without another proof.
#[derive(Clone, Debug, Default)]
pub(super) struct Anchor {
    step: Step,
    drive: f64,
    u: Vec<f64>,
    rates: Vec<f64>,
    /// The unknowns of the last state found from it.
    last: Vec<f64>,
}

impl Anchor {
    fn moor(&mut self, state: &State, step: Step) {
        self.step = step;
        self.drive = state.pose.drive;
        self.u.clone_from(&state.pose.u);
        self.rates.clone_from(&state.rates[0]);
        self.last.clone_from(&state.pose.u);
    }

    /// Returns whether a step is proved here, the state was found from here and the drive is within
    /// the step.
    fn holds(&self, state: &State, drive: f64) -> bool {
        let length = self.step.length;
        length > 0.0 && (drive - self.drive).abs() <= length && self.last == state.pose.u
    }

    /// The drive as far towards `to` as the step goes.
    fn towards(&self, to: f64) -> f64 {
        let (left, length) = (to - self.drive, self.step.length);
        match left.abs() <= length {
            true => to,
            false => self.drive + length.copysign(left),
        }
    }

    /// The end of the tangent.
    fn tangent(&self, k: usize, drive: f64) -> f64 {
        self.u[k] + self.rates[k] * (drive - self.drive)
    }
}

/// Memory of a continuation.
#[derive(Clone, Debug)]
pub(super) struct Follower {
    pub work: Work,
    anchor: Anchor,
    /// Memory for the next state.
    spare: Option<State>,
}

impl Follower {
    pub(super) fn new(chain: &Chain) -> Follower {
        Follower {
            work: Work::new(chain),
            anchor: Anchor::default(),
            spare: None,
        }
    }
}

/// Returns the largest difference.
fn apart(a: &[f64], b: &[f64]) -> f64 {
    let pairs = a.iter().zip(b);
    pairs.fold(0.0, |m, (a, b)| m.max((a - b).abs()))
}

impl Mechanism {
    /// Follows the branch of a state to another value of the drive, in radians or metres. Angles
    /// are carried on beyond whole turns.
    ///
    /// # Errors
    /// [`PositionError::Ends`] where the mechanism becomes singular on the way; then
    /// [`Mechanism::singularity`] tells what is there.
    pub fn follow(&self, from: &State, to: f64) -> Result<State, PositionError> {
        let mut state = from.clone();
        self.advance(&mut state, to, &mut Follower::new(&self.chain))?;
        Ok(state)
    }

    /// Follows the branch as far as it goes: the last state, and why it is not at `to`.
    pub fn follow_as_far(&self, from: &State, to: f64) -> (State, Option<PositionError>) {
        let mut state = from.clone();
        let end = self.advance(&mut state, to, &mut Follower::new(&self.chain));
        (state, end.err())
    }

    fn checked(&self, drive: f64) -> Result<f64, PositionError> {
        let inner = self.inner_drive(drive);
        match inner.abs() <= LARGEST_DRIVE {
            true => Ok(inner),
            false => Err(PositionError::Drive { value: drive }),
        }
    }

    /// Moves a state along its branch; on an error it is the last one that was reached.
    pub(super) fn advance(
        &self,
        state: &mut State,
        to: f64,
        follower: &mut Follower,
    ) -> Result<(), PositionError> {
        let to = self.checked(to)?;
        let mut next = follower.spare.take().unwrap_or_else(|| state.clone());
        let end = self.steps(state, &mut next, to, follower);
        follower.spare = Some(next);
        end
    }

    /// Steps from `state` on; `next` is memory for its successor.
    fn steps(
        &self,
        state: &mut State,
        next: &mut State,
        to: f64,
        follower: &mut Follower,
    ) -> Result<(), PositionError> {
        let Follower { work, anchor, .. } = follower;
        for _ in 0..MOST_STEPS {
            if state.pose.drive == to {
                return Ok(());
            }
            let kept = anchor.holds(state, to);
            if !kept {
                let step = self.longest_step(state, work);
                anchor.moor(state, step);
            }
            let drive = anchor.towards(to);
            let found = anchor.step.length > 0.0 && self.correct(state, next, drive, anchor, work);
            if !found && kept {
                // Another proof, from here, before the branch counts as ended.
                anchor.step.length = 0.0;
                continue;
            }
            if !found {
                return Err(PositionError::Ends {
                    drive: self.outer_drive(state.pose.drive),
                });
            }
            anchor.last.clone_from(&next.pose.u);
            std::mem::swap(state, next);
        }
        Err(PositionError::TooManySteps {
            drive: self.outer_drive(state.pose.drive),
            steps: MOST_STEPS,
        })
    }

    /// The longest step that is proved from a state.
    fn longest_step(&self, state: &State, work: &mut Work) -> Step {
        let n = self.chain.unknowns;
        bounds(&self.chain, &state.pose, &mut work.bounds);
        work.sums.clear();
        work.sums.resize(n, [0.0; 4]);
        for row in 0..n {
            let b = work.bounds[row];
            if b == Bound::default() {
                continue;
            }
            let unit = |r: usize| f64::from(u8::from(r == row));
            state.factors.solve(unit, &mut work.step);
            for (sum, a) in work.sums.iter_mut().zip(&work.step) {
                let a = a.abs();
                sum[0] += a * b.k;
                sum[1] += a * b.m;
                sum[2] += a * b.w;
                sum[3] += a;
            }
        }
        let largest = |i: usize| work.sums.iter().fold(0.0f64, |m, s| m.max(s[i]));
        let [kappa, mu, omega] = [0, 1, 2].map(largest);
        let nu = state.rates[0].iter().fold(0.0f64, |m, x| m.max(x.abs()));
        let mut step = Step::proved([kappa, mu, omega], nu);
        // The state itself is known to the rounding of its residual only, which next to a change
        // point is as much as the branches are apart.
        let extent = state.pose.p.iter().fold(1.0, |m: f64, p| m.max(p.norm()));
        if !(largest(3) * f64::EPSILON * extent <= 0.25 * step.radius) {
            step.length = 0.0;
        }
        step
    }

    /// The state at another value of the drive, within the anchor's radius of its tangent's end,
    /// into `next`.
    fn correct(
        &self,
        from: &State,
        next: &mut State,
        drive: f64,
        anchor: &Anchor,
        work: &mut Work,
    ) -> bool {
        let s = drive - from.pose.drive;
        let [first, second] = &from.rates;
        let Step { radius, kappa, .. } = anchor.step;
        let n = self.chain.unknowns;
        // The state before, which `next` held, gives third derivatives.
        let before = from.pose.drive - next.pose.drive;
        let third = match before.abs() <= 2.0 * s.abs() && before != 0.0 {
            true => 1.0 / before,
            false => 0.0,
        };
        // A predictor outside the ball would prove nothing; the tangent's end always lies inside.
        for curved in [true, false] {
            let pose = &mut next.pose;
            pose.drive = drive;
            for k in 0..n {
                pose.u[k] = match curved {
                    true => {
                        let third = (second[k] - next.rates[1][k]) * third;
                        from.pose.u[k] + s * (first[k] + s * (0.5 * second[k] + s * third / 6.0))
                    }
                    false => anchor.tangent(k, drive),
                };
            }
            pose.place(&self.chain, &self.chain.order);
            let left = anchor.step.left(apart(&pose.u, &from.pose.u), s);
            let near = (&from.factors, left);
            let inside = self.chain.newton_within(pose, near, kappa, work)
                && (0..n).all(|k| (pose.u[k] - anchor.tangent(k, drive)).abs() <= radius);
            if inside {
                return next.update(&self.chain, work);
            }
        }
        false
    }

    /// Calls `visit` with the state at each value of the drive, each followed from the one before.
    ///
    /// # Errors
    /// When the branch ends; `visit` has seen the states up to there.
    pub fn each(
        &self,
        start: &State,
        drives: impl IntoIterator<Item = f64>,
        mut visit: impl FnMut(&State),
    ) -> Result<(), PositionError> {
        let mut follower = Follower::new(&self.chain);
        let mut here = start.clone();
        for drive in drives {
            self.advance(&mut here, drive, &mut follower)?;
            visit(&here);
        }
        Ok(())
    }

    /// The states at the given values of the drive, each followed from the one before.
    ///
    /// # Errors
    /// With the states up to there, when the branch ends.
    pub fn sweep(
        &self,
        start: &State,
        drives: impl IntoIterator<Item = f64>,
    ) -> Result<Vec<State>, (Vec<State>, PositionError)> {
        let mut states = Vec::new();
        match self.each(start, drives, |s| states.push(s.clone())) {
            Ok(()) => Ok(states),
            Err(e) => Err((states, e)),
        }
    }
}

#[cfg(test)]
mod tests;
