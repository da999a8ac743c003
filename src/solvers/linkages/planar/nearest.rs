//! The position nearest to approximate angles.
//!
//! In a linkage of pins every closure is a sum of arms `z e^{iθ}`, each θ an unknown plus a
//! constant. Two positions p and x differ by `M (x − p) = 0`, where column k of M is that of the
//! Jacobian at (p + x)/2 times `sinc((x_k − p_k)/2)`: a chord is a tangent at the middle,
//! shortened. Let g be the given angles, p a position found by Newton's method from them, d its
//! largest difference from them, c = (g + p)/2, A an approximate inverse of J(c), and iJ the
//! Jacobian with the two rows of each pin turned by a right angle. If x lies within d of g,
//! `|(p + x)/2 − c| ≤ d/2` and `|x − p| ≤ 2d`, so that each column of M is one of J(c) turned by at
//! most d/2 and shortened by at most d²/6:
//!
//! ```text
//! ‖I − A M‖ ≤ ‖I − A J(c)‖ + ½ d ‖A iJ(c)‖ + (1/6 + 1/8) d²        (maximum norm)
//! ```
//!
//! Where this is less than one, M is regular and x = p: no other position is as near as p. That the
//! exact position is where Newton's method ended to within 4η, η the bound on its last correction,
//! follows by the same estimate around p (Newton and Kantorovich). It is computed in `f64`, with
//! allowances for rounding.
//!
//! A pin whose gap at g is more than its arms can close within `reach` proves that there is no
//! position. Where neither can be told all assembly modes are compared.

use super::chain::{Chain, Closure, Entry};
use super::dense::{Factors, Matrix};
use super::error::NearestError;
use super::mechanism::Mechanism;
use super::newton::Work;
use super::pose::Pose;
use super::state::State;
use crate::units::Angle;
use std::f64::consts::TAU;

/// Largest norm taken for less than one.
const REGULAR: f64 = 0.95;
/// Of two positions whose distances differ by less than this part of a radian it is not said which
/// is nearer.
const TIE: f64 = 1e-9;

/// Describes what the estimates use of a Jacobian J with an approximate inverse A.
struct Estimate {
    /// `‖I − A J‖`.
    defect: f64,
    /// `‖A iJ‖`.
    bend: f64,
    /// `‖|A| (|F| + rounding)‖` for the residual given.
    correction: f64,
}

/// Describes what is told of the nearest position.
pub(super) enum Way {
    /// This is it.
    Found(Box<State>),
    /// None is within reach.
    None,
    /// It cannot be told this way.
    Unknown,
}

impl Mechanism {
    /// The position at that value of the drive, in radians or metres, whose largest difference from
    /// `near` over the angles of all moving bodies is least, if that is at most `reach`. `near` has
    /// an angle for each body but the ground. Angles are real numbers, not reduced by whole turns;
    /// those of the position are next to `near`, but where the drive gives them.
    ///
    /// In linkages of pins Newton's method from `near` finds it where an estimate shows that no
    /// other is as near (see the source of this module); elsewhere, and where that cannot be told,
    /// it is one of [`Mechanism::assembly_modes`].
    ///
    /// ```
    /// use mechaudit_solvers::planar::{Description, Drive, GROUND, Mechanism, NearestError};
    /// use mechaudit_solvers::units::Angle;
    /// // A 3-4-5 triangle of coupler and rocker on the frame, above it or below.
    /// let mut d = Description::new();
    /// let [crank, coupler, rocker] = ["crank", "coupler", "rocker"].map(|name| d.body(name));
    /// d.pin("O", &[(GROUND, [0.0, 0.0]), (crank, [0.0, 0.0])]);
    /// d.pin("A", &[(crank, [1.0, 0.0]), (coupler, [0.0, 0.0])]);
    /// d.pin("B", &[(coupler, [3.0, 0.0]), (rocker, [4.0, 0.0])]);
    /// d.pin("C", &[(GROUND, [6.0, 0.0]), (rocker, [0.0, 0.0])]);
    /// d.drive = Drive::Angle { body: crank, from: GROUND };
    /// let linkage = Mechanism::new(d)?;
    /// let near = [0.0, -0.9, -2.5].map(Angle::from_rad);
    /// let state = linkage.nearest(0.0, &near, Angle::from_deg(10.0))?;
    /// assert!((linkage.body_angle(&state, coupler).angle.rad() + 0.6f64.acos()).abs() < 1e-15);
    /// let none = linkage.nearest(0.0, &near, Angle::from_deg(1.0));
    /// assert!(matches!(none, Err(NearestError::NoneWithin { .. })));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`NearestError`]: none within reach, or which is nearest cannot be told.
    pub fn nearest(&self, drive: f64, near: &[Angle], reach: Angle) -> Result<State, NearestError> {
        let bodies = self.chain.body_count() - 1;
        if near.len() != bodies {
            return Err(NearestError::Count {
                given: near.len(),
                bodies,
            });
        }
        let near: Vec<f64> = near.iter().map(|a| a.rad()).collect();
        let reach = reach.rad();
        let numbers = near.iter().chain([&drive, &reach]);
        if let Some(&value) = numbers.into_iter().find(|x| !x.is_finite()) {
            return Err(NearestError::NotFinite { value });
        }
        if !self.chain.turns_freely() {
            return Err(NearestError::CannotTell);
        }
        match self.nearest_by_newton(drive, &near, reach) {
            Way::Found(state) => Ok(*state),
            Way::None => Err(NearestError::NoneWithin { reach }),
            Way::Unknown => self.nearest_mode(drive, &near, reach),
        }
    }

    /// Returns what Newton's method from `near` tells of the nearest position: of linkages of pins
    /// alone, for which the estimates are.
    pub(super) fn nearest_by_newton(&self, drive: f64, near: &[f64], reach: f64) -> Way {
        let chain = &self.chain;
        if !chain.is_of_pins() {
            return Way::Unknown;
        }
        let mut work = Work::new(chain);
        let inner = self.inner_drive(drive);
        let given = Pose::new(chain, inner, chain.unknowns_at(inner, near));
        let mut pose = given.clone();
        let settled = chain.blocks.iter().all(|block| {
            let settled = chain.newton(&mut pose, Some(block), &mut work);
            pose.place(chain, &chain.order);
            settled
        });
        if settled
            && let Some(state) = State::new(self, pose)
            && let Some(error) = chain.error_of(&state, &mut work)
        {
            let off = [self.off(&state, near), error];
            if let Some(way) = chain.told(&given, state, off, reach, &mut work) {
                return way;
            }
        }
        match chain.is_open(&given, near, reach, &mut work) {
            true => Way::None,
            false => Way::Unknown,
        }
    }

    /// The nearest of all assembly modes.
    fn nearest_mode(&self, drive: f64, near: &[f64], reach: f64) -> Result<State, NearestError> {
        let modes = self.assembly_modes(drive);
        if !modes.complete || modes.near_singular {
            return Err(NearestError::CannotTell);
        }
        let mut states = modes.states;
        for state in &mut states {
            self.chain.turn_next_to(&mut state.pose, near);
        }
        let off: Vec<f64> = states.iter().map(|s| self.off(s, near)).collect();
        let mut order: Vec<usize> = (0..states.len()).collect();
        order.sort_by(|&a, &b| off[a].total_cmp(&off[b]));
        match order[..] {
            [first, second, ..] if off[first] <= reach && off[second] - off[first] < TIE => {
                Err(NearestError::CannotTell)
            }
            [first, ..] if off[first] <= reach => Ok(states.swap_remove(first)),
            _ => Err(NearestError::NoneWithin { reach }),
        }
    }

    /// The largest difference of the bodies' angles from those given.
    fn off(&self, state: &State, near: &[f64]) -> f64 {
        let of = |(k, near): (usize, &f64)| (state.pose.angle(&self.chain, k + 1) - near).abs();
        near.iter().enumerate().map(of).fold(0.0, f64::max)
    }
}

impl Estimate {
    /// `j` holds the closures of pins, two rows each, at a pose whose points are computed to within
    /// `rounding` a row.
    fn new(j: &Matrix, factors: &Factors, residual: &[f64], rounding: f64) -> Estimate {
        let n = residual.len();
        let mut inverse = vec![0.0; n * n];
        let mut column = vec![0.0; n];
        for r in 0..n {
            factors.solve(|k| f64::from(u8::from(k == r)), &mut column);
            (0..n).for_each(|i| inverse[i * n + r] = column[i]);
        }
        let mut all = Estimate {
            defect: 0.0,
            bend: 0.0,
            correction: 0.0,
        };
        for (i, a) in inverse.chunks(n.max(1)).enumerate() {
            let size: f64 = a.iter().map(|x| x.abs()).sum();
            let (mut defect, mut bend) = (0.0, 0.0);
            for k in 0..n {
                let column = |sum: f64, r: usize| sum - a[r] * j[(r, k)];
                defect += (0..n).fold(f64::from(u8::from(i == k)), column).abs();
                let turned = |r: usize| a[r + 1] * j[(r, k)] - a[r] * j[(r + 1, k)];
                bend += (0..n).step_by(2).map(turned).sum::<f64>().abs();
            }
            let noise = n as f64 * size * rounding;
            let correction: f64 = a.iter().zip(residual).map(|(a, f)| (a * f).abs()).sum();
            all.defect = all.defect.max(defect + noise);
            all.bend = all.bend.max(bend + noise);
            all.correction = all.correction.max(correction + size * rounding);
        }
        all
    }

    /// A bound on `‖I − A M‖` for matrices M whose columns are those of J turned by at most `turn`
    /// and shortened by at most `short` of their length.
    fn norm(&self, turn: f64, short: f64) -> f64 {
        self.defect + turn * self.bend + 0.5 * turn * turn + short
    }
}

impl Chain {
    /// Returns whether all joints are pins.
    fn is_of_pins(&self) -> bool {
        let hung = |e: &Entry| matches!(e, Entry::Ground | Entry::Pin { .. });
        let closed = |c: &Closure| matches!(c, Closure::Pin { .. });
        self.entries.iter().all(hung) && self.closures.iter().all(closed)
    }

    /// Returns whether whole turns of any unknown angle lead from positions to positions.
    fn turns_freely(&self) -> bool {
        let geared = |c: &Closure| matches!(c, Closure::Gears { .. } | Closure::Rack { .. });
        !self.closures.iter().any(geared)
    }

    /// The unknown angles from those of the bodies: of bodies that turn together from the first.
    fn unknowns_at(&self, drive: f64, near: &[f64]) -> Vec<f64> {
        let mut u = vec![0.0; self.unknowns];
        for (t, near) in self.turns[1..].iter().zip(near).rev() {
            if let Some(k) = t.unknown {
                u[k] = near - t.offset - t.drive * drive;
            }
        }
        u
    }

    /// Turns the unknown angles by the whole turns that bring the bodies' next to those given.
    fn turn_next_to(&self, pose: &mut Pose, near: &[f64]) {
        for k in (0..self.unknowns).filter(|&k| !self.lengths[k]) {
            let with = (1..self.body_count()).filter(|&b| self.turns[b].unknown == Some(k));
            let off = with.map(|b| near[b - 1] - pose.angle(self, b));
            let ends = off.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| {
                (a.min(x), b.max(x))
            });
            pose.u[k] += ((ends.0 + ends.1) / (2.0 * TAU)).round() * TAU;
        }
    }

    /// Returns what rounding may do to a row of residual or Jacobian.
    fn rounding(&self, pose: &Pose) -> f64 {
        // Coordinates of joints are less than two units of length.
        let extent = pose.p.iter().fold(0.0, |m: f64, p| m.max(p.norm() + 3.0));
        16.0 * f64::EPSILON * self.body_count() as f64 * extent
    }

    /// A bound on the distance, in the maximum norm, of a state of pins from an exact position;
    /// none if it cannot be told.
    fn error_of(&self, state: &State, work: &mut Work) -> Option<f64> {
        let (pose, j) = (&state.pose, &state.jacobian);
        pose.residual(self, &self.closures, &mut work.residual);
        let rounding = self.rounding(pose);
        let at = Estimate::new(j, &state.factors, &work.residual, rounding);
        let radius = 4.0 * at.correction;
        // A chord from a point of the ball: the middle is within the radius of the state.
        let norm = at.norm(radius, radius * radius / 6.0);
        (norm <= 0.5).then_some(radius)
    }

    /// Returns what a state so far from the angles given, and at most `error` from an exact
    /// position, tells; nothing where another may be as near.
    fn told(
        &self,
        given: &Pose,
        state: State,
        [off, error]: [f64; 2],
        reach: f64,
        work: &mut Work,
    ) -> Option<Way> {
        let alone = self.is_alone(given, &state.pose, off + 2.0 * error, work);
        alone.then(|| match () {
            () if off + error <= reach => Way::Found(Box::new(state)),
            () if off - error > reach => Way::None,
            () => Way::Unknown,
        })
    }

    /// Returns whether no position but that of `found` has all unknowns within `d` of those given.
    fn is_alone(&self, given: &Pose, found: &Pose, d: f64, work: &mut Work) -> bool {
        let middle = given.u.iter().zip(&found.u).map(|(a, b)| 0.5 * (a + b));
        let pose = Pose::new(self, given.drive, middle.collect());
        pose.jacobian(self, 0..self.closures.len(), &mut work.jacobian);
        if !work.factor(self) {
            return false;
        }
        let nothing = vec![0.0; self.unknowns];
        let rounding = self.rounding(&pose);
        let at = Estimate::new(&work.jacobian, &work.factors, &nothing, rounding);
        at.norm(0.5 * d, d * d / 6.0) < REGULAR
    }

    /// Returns whether no position has all angles within `reach` of those given: a body that the
    /// drive turns is farther off, or a pin's gap is more than its arms can close.
    fn is_open(&self, given: &Pose, near: &[f64], reach: f64, work: &mut Work) -> bool {
        let rounding = self.rounding(given);
        let driven = (1..self.body_count()).filter(|&b| self.turns[b].unknown.is_none());
        let mut off = driven.map(|b| (given.angle(self, b) - near[b - 1]).abs());
        if off.any(|off| off > reach) {
            return true;
        }
        given.residual(self, &self.closures, &mut work.residual);
        given.jacobian(self, 0..self.closures.len(), &mut work.jacobian);
        let (f, j) = (&work.residual, &work.jacobian);
        (0..f.len()).step_by(2).any(|r| {
            let arm = |k: usize| j[(r, k)].hypot(j[(r + 1, k)]) + rounding;
            let arms: f64 = (0..self.unknowns).map(arm).sum();
            f[r].hypot(f[r + 1]) > reach * arms * (1.0 + 1e-9) + 2.0 * rounding
        })
    }
}

#[cfg(test)]
mod estimate_tests;
#[cfg(test)]
mod tests;
