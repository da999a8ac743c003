//! First and second derivatives of the bodies' poses with respect to the drive.

use super::chain::{Chain, Closure, Entry, Rail, Spot, Travel};
use super::model::GROUND;
use super::plane::{cross, dot, quarter};
use super::pose::Pose;
use num_complex::Complex64;

/// Position with two derivatives.
pub(super) type Jet = [Complex64; 3];

/// Derivatives of a body's angle and of its origin.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct BodyRates {
    /// `θ'` and `θ''`.
    pub turn: [f64; 2],
    /// `p'` and `p''`.
    pub origin: [Complex64; 2],
}

/// The derivatives of all bodies for given derivatives of the unknowns.
#[derive(Clone, Debug, Default)]
pub(super) struct Motion {
    pub bodies: Vec<BodyRates>,
}

/// A vector fixed on a body that turns: `i θ' z` and `(i θ'' − θ'²) z`.
fn turned(z: Complex64, [w, x]: [f64; 2]) -> [Complex64; 2] {
    let q = quarter(z);
    [q * w, q * x - z * (w * w)]
}

/// A vector of a body that turns and stretches.
fn stretched(z: Complex64, along: Complex64, turn: [f64; 2], s: [f64; 2]) -> [Complex64; 2] {
    let [a, b] = turned(z, turn);
    [
        a + along * s[0],
        b + quarter(along) * (2.0 * turn[0] * s[0]) + along * s[1],
    ]
}

impl Motion {
    /// Becomes that of other derivatives.
    pub(super) fn copy(&mut self, other: &Motion) {
        self.bodies.clone_from(&other.bodies);
    }

    /// `rates` holds first and second derivatives of the unknowns.
    pub(super) fn set(&mut self, chain: &Chain, pose: &Pose, rates: [&[f64]; 2]) {
        self.fill::<true>(chain, pose, rates);
    }

    /// First derivatives alone: the second ones become NaN.
    pub(super) fn set_first(&mut self, chain: &Chain, pose: &Pose, rates: &[f64]) {
        self.fill::<false>(chain, pose, [rates; 2]);
    }

    #[inline(always)]
    fn fill<const SECOND: bool>(&mut self, chain: &Chain, pose: &Pose, rates: [&[f64]; 2]) {
        // The ground's, which is not in the order, remain zero.
        self.bodies.resize(chain.body_count(), BodyRates::default());
        let travel = |t: Travel| match t {
            Travel::Unknown(k) => [rates[0][k], rates[1][k]],
            Travel::Drive => [1.0, 0.0],
        };
        for &b in &chain.order {
            let t = &chain.turns[b];
            let turn = [0, 1].map(|i| {
                let own = t.unknown.map_or(0.0, |k| rates[i][k]);
                own + if i == 0 { t.drive } else { 0.0 }
            });
            let e = pose.e[b];
            let origin = match chain.entries[b] {
                Entry::Ground => continue,
                Entry::Pin { on, own } => {
                    let [v, a] = self.moved(pose, on);
                    let [dv, da] = turned(e * own, turn);
                    [v - dv, a - da]
                }
                Entry::OnRail {
                    rail,
                    own,
                    travel: t,
                } => {
                    let [v, a] = self.on_rail(pose, rail, pose.travel(t), travel(t));
                    let [dv, da] = turned(e * own, turn);
                    [v - dv, a - da]
                }
                Entry::WithRail {
                    on,
                    at,
                    along,
                    travel: t,
                } => {
                    let [v, a] = self.moved(pose, on);
                    let arm = e * (at + along * pose.travel(t));
                    let [dv, da] = stretched(arm, e * along, turn, travel(t));
                    [v - dv, a - da]
                }
            };
            let mut body = BodyRates { turn, origin };
            if !SECOND {
                let none = f64::NAN;
                (body.turn[1], body.origin[1]) = (none, Complex64::new(none, none));
            }
            self.bodies[b] = body;
        }
    }

    fn on_rail(&self, pose: &Pose, rail: Rail, s: f64, rates: [f64; 2]) -> [Complex64; 2] {
        let e = pose.e[rail.body];
        let BodyRates { turn, origin } = self.bodies[rail.body];
        let [v, a] = stretched(e * (rail.at + rail.along * s), e * rail.along, turn, rates);
        [origin[0] + v, origin[1] + a]
    }

    /// A point fixed on a body.
    #[inline]
    pub(super) fn spot(&self, pose: &Pose, spot: Spot) -> Jet {
        let [v, a] = self.moved(pose, spot);
        [pose.at(spot), v, a]
    }

    /// The derivatives of [`Motion::spot`].
    #[inline(always)]
    pub(super) fn moved(&self, pose: &Pose, spot: Spot) -> [Complex64; 2] {
        if spot.body == GROUND {
            return [Complex64::ZERO; 2];
        }
        let BodyRates { turn, origin } = self.bodies[spot.body];
        let [v, a] = turned(pose.e[spot.body] * spot.at, turn);
        [origin[0] + v, origin[1] + a]
    }

    /// A rail's direction and the vector from its origin to a point, with derivatives.
    pub(super) fn along(&self, pose: &Pose, rail: Rail, point: Spot) -> [Jet; 2] {
        let u = pose.e[rail.body] * rail.along;
        let [u1, u2] = turned(u, self.bodies[rail.body].turn);
        let from = self.spot(pose, rail.at(0.0));
        let to = self.spot(pose, point);
        [[u, u1, u2], std::array::from_fn(|k| to[k] - from[k])]
    }

    /// Second derivatives of the closures where those of the unknowns are zero.
    pub(super) fn second(&self, pose: &Pose, closures: &[Closure], out: &mut Vec<f64>) {
        out.clear();
        let dots = |[u, d]: [Jet; 2]| dot(u[2], d[0]) + 2.0 * dot(u[1], d[1]) + dot(u[0], d[2]);
        for closure in closures {
            match *closure {
                Closure::Pin { a, b } => {
                    let d = self.spot(pose, a)[2] - self.spot(pose, b)[2];
                    out.extend([d.re, d.im]);
                }
                Closure::Line { rail, point } => {
                    let [u, d] = self.along(pose, rail, point);
                    out.push(cross(u[2], d[0]) + 2.0 * cross(u[1], d[1]) + cross(u[0], d[2]));
                }
                // Angles are linear in the unknowns: nothing of their own.
                Closure::Rack { rail, point, .. } => out.push(dots(self.along(pose, rail, point))),
                Closure::Tie { .. } | Closure::Gears { .. } => out.push(0.0),
            }
        }
    }
}
