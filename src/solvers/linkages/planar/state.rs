//! One position with its rates, and what can be read from it.

use super::chain::{Chain, rail, spot};
use super::dense::{Factors, Matrix};
use super::mechanism::Mechanism;
use super::model::{Guide, Joint, Point};
use super::motion::Motion;
use super::newton::Work;
use super::plane::{cross, dot};
use super::pose::Pose;
use crate::class_iii::PointMotion;
use crate::dyad::LinkMotion;
use crate::units::Angle;
use num_complex::Complex64;

/// A mechanism at one value of its drive: positions and rates. Rates are derivatives with respect
/// to the drive: for each radian, or for each metre where the drive is a displacement.
#[derive(Clone, Debug)]
pub struct State {
    pub(super) pose: Pose,
    /// First and second derivatives of the unknowns.
    pub(super) rates: [Vec<f64>; 2],
    pub(super) motion: Motion,
    pub(super) jacobian: Matrix,
    pub(super) factors: Factors,
}

/// A displacement along a guide with its first two derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Displacement {
    /// In metres.
    pub s_m: f64,
    /// `ds/dφ`, in metres for each unit of the drive.
    pub first_m: f64,
    /// `d²s/dφ²`.
    pub second_m: f64,
}

impl State {
    /// Rates of a pose that closes the loops; `None` if it is singular.
    pub(super) fn new(mechanism: &Mechanism, pose: Pose) -> Option<State> {
        State::within(mechanism, pose, &mut Work::new(&mechanism.chain))
    }

    /// [`State::new`] in memory that is at hand.
    pub(super) fn within(mechanism: &Mechanism, pose: Pose, work: &mut Work) -> Option<State> {
        let chain = &mechanism.chain;
        let mut state = State {
            pose,
            rates: [vec![0.0; chain.unknowns], vec![0.0; chain.unknowns]],
            motion: Motion::default(),
            jacobian: work.jacobian.clone(),
            factors: Factors::default(),
        };
        if !state.factored(chain) {
            return None;
        }
        state.pose.settle(chain, &state.factors, work);
        state.update(chain, work).then_some(state)
    }

    /// The Jacobian of the pose and its factors; `false` if it is singular.
    fn factored(&mut self, chain: &Chain) -> bool {
        self.pose
            .jacobian(chain, 0..chain.closures.len(), &mut self.jacobian);
        let blocks = chain.blocks.iter().map(|b| b.rows.clone());
        self.factors.of_blocks(&self.jacobian, 0, blocks)
    }

    /// Rates from the pose; `false` if it is singular.
    pub(super) fn update(&mut self, chain: &Chain, work: &mut Work) -> bool {
        let n = chain.unknowns;
        if !self.factored(chain) {
            return false;
        }
        let [first, second] = &mut self.rates;
        let jacobian = &self.jacobian;
        self.factors
            .solve_closely(jacobian, |r| -jacobian[(r, n)], first, &mut work.correction);
        second.fill(0.0);
        self.motion.set(chain, &self.pose, [first, second]);
        self.motion
            .second(&self.pose, &chain.closures, &mut work.residual);
        let right = &work.residual;
        self.factors
            .solve_closely(jacobian, |r| -right[r], second, &mut work.correction);
        self.motion.set(chain, &self.pose, [first, second]);
        first.iter().chain(second.iter()).all(|x| x.is_finite())
    }

    /// The determinant of the closures' Jacobian in the solver's unit of length; it changes sign
    /// only at singular positions.
    pub fn determinant(&self) -> f64 {
        self.factors.determinant()
    }
}

impl Mechanism {
    /// The drive in radians or metres.
    pub fn drive_of(&self, state: &State) -> f64 {
        self.outer_drive(state.pose.drive)
    }

    /// From values with derivatives in the chain's units to metres and the drive's unit.
    fn outer(&self, value: [f64; 3], lengths: bool) -> [f64; 3] {
        let metres = self.chain.metres;
        let l = if lengths { metres } else { 1.0 };
        // A power of two, so that its reciprocal is exact.
        let d = if self.chain.linear { 1.0 / metres } else { 1.0 };
        [value[0] * l, value[1] * l * d, value[2] * l * d * d]
    }

    /// A body's angle, not reduced by whole turns, with its derivatives.
    pub fn body_angle(&self, state: &State, body: usize) -> LinkMotion {
        let angle = state.pose.angle(&self.chain, body);
        let [first, second] = state.motion.bodies[body].turn;
        let [angle, first, second] = self.outer([angle, first, second], false);
        LinkMotion {
            angle: Angle::from_rad(angle),
            first,
            second,
        }
    }

    /// A point fixed on a body.
    pub fn point(&self, state: &State, point: &Point) -> PointMotion {
        let jet = state
            .motion
            .spot(&state.pose, spot(point, self.chain.metres));
        let [x, y] = [0, 1].map(|i| {
            let part = |z: Complex64| if i == 0 { z.re } else { z.im };
            self.outer(jet.map(part), true)
        });
        PointMotion {
            r: [x[0], y[0]],
            first: [x[1], y[1]],
            second: [x[2], y[2]],
        }
    }

    /// The displacement of a point along a guide.
    pub fn displacement(&self, state: &State, point: &Point, guide: &Guide) -> Displacement {
        let (rail, point) = (
            rail(guide, self.chain.metres),
            spot(point, self.chain.metres),
        );
        let [u, d] = state.motion.along(&state.pose, rail, point);
        let s = [
            dot(u[0], d[0]),
            dot(u[1], d[0]) + dot(u[0], d[1]),
            dot(u[2], d[0]) + 2.0 * dot(u[1], d[1]) + dot(u[0], d[2]),
        ];
        let [s_m, first_m, second_m] = self.outer(s, true);
        Displacement {
            s_m,
            first_m,
            second_m,
        }
    }

    /// The displacement of a slide or slot; `None` for other joints.
    pub fn joint_displacement(&self, state: &State, joint: usize) -> Option<Displacement> {
        let (point, guide) = self.description().joints.get(joint)?.part.guided()?;
        Some(self.displacement(state, point, guide))
    }

    /// The largest distance between the sides of a joint, in metres (gears and racks: radians or
    /// metres): how well the loops are closed.
    pub fn gap(&self, state: &State) -> f64 {
        let mut rows = Vec::new();
        state
            .pose
            .residual(&self.chain, &self.chain.closures, &mut rows);
        rows.iter().fold(0.0, |m: f64, x| m.max(x.abs())) * self.chain.metres
    }

    /// The angle ACB in [0, π] of a dyad of two links with pins A, C (the inner one) and B: the
    /// transmission angle, 90° where force is passed on best and 0° or 180° in a singular position.
    /// `None` for other groups.
    pub fn transmission(&self, state: &State, group: usize) -> Option<Angle> {
        let block = self.chain.blocks.get(group)?;
        let [a, b] = <[usize; 2]>::try_from(block.bodies.clone()).ok()?;
        let mut inner = None;
        let mut outer = [None, None];
        for joint in &self.description().joints {
            let Joint::Pin { points } = &joint.part else {
                continue;
            };
            let on = |body: usize| points.iter().find(|p| p.body == body);
            let known = points.iter().any(|p| self.chain.precedes(p.body, a));
            match (on(a), on(b)) {
                (Some(p), Some(_)) if inner.is_none() => inner = Some(*p),
                (Some(p), None) if known => outer[0] = Some(*p),
                (None, Some(p)) if known => outer[1] = Some(*p),
                _ => {}
            }
        }
        let at = |p: Point| state.pose.at(spot(&p, self.chain.metres));
        let c = at(inner?);
        let (p, q) = (at(outer[0]?) - c, at(outer[1]?) - c);
        Some(Angle::from_rad(cross(p, q).abs().atan2(dot(p, q))))
    }
}

/// Signed curvature of a point's path in 1/m, positive where it bends to the left of the direction
/// of travel: `(x'y'' − y'x'') / |r'|³`. NaN where the point stands still.
pub fn curvature(motion: &PointMotion) -> f64 {
    let [a, b] = [motion.first, motion.second];
    (a[0] * b[1] - a[1] * b[0]) / a[0].hypot(a[1]).powi(3)
}

#[cfg(test)]
mod tests;
