//! How far the continuation may step: bounds on the second derivatives of the closures.
//!
//! For changes δ of the unknowns and s of the drive, each row's second derivative is at most
//! `k ‖δ‖² + 2 m ‖δ‖ |s| + w s²` in the maximum norm. An arm that turns by θ contributes its length
//! times θ², a displacement t along a turning rail 2 |t θ|. Displacements may grow by [`SLACK`].

use super::chain::{Chain, Closure, Entry, Rail, Spot, Travel};
use super::pose::Pose;

/// How far unknowns and drive may move within one step, so that the bounds hold: radians or units of
/// length.
pub(super) const SLACK: f64 = 0.25;

/// Bounds of one row.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Bound {
    /// Of the unknowns twice.
    pub k: f64,
    /// Of the unknowns and the drive.
    pub m: f64,
    /// Of the drive twice.
    pub w: f64,
}

/// Bounds of the first derivatives, beside those of the second.
#[derive(Clone, Copy, Debug, Default)]
struct Path {
    first: [f64; 2],
    second: Bound,
}

impl Path {
    /// A vector of this length turns with a body.
    fn arm(&mut self, length: f64, [u, d]: [f64; 2]) {
        self.first[0] += length * u;
        self.first[1] += length * d;
        self.second.k += length * u * u;
        self.second.m += length * u * d;
        self.second.w += length * d * d;
    }

    /// A displacement along a rail of this body.
    fn travel(&mut self, travel: Travel, [u, d]: [f64; 2]) {
        match travel {
            Travel::Unknown(_) => {
                self.first[0] += 1.0;
                self.second.k += 2.0 * u;
                self.second.m += d;
            }
            Travel::Drive => {
                self.first[1] += 1.0;
                self.second.m += u;
                self.second.w += 2.0 * d;
            }
        }
    }
}

/// Whether a body turns with an unknown, and how fast with the drive.
fn turns(chain: &Chain, body: usize) -> [f64; 2] {
    let t = &chain.turns[body];
    [f64::from(u8::from(t.unknown.is_some())), t.drive.abs()]
}

/// The bounds along the way to a point.
fn path(chain: &Chain, pose: &Pose, spot: Spot, sum: &mut Path) {
    let mut body = spot.body;
    let mut here = pose.at(spot);
    let mut slack = 0.0;
    loop {
        let turn = turns(chain, body);
        let (on, next) = match chain.entries[body] {
            Entry::Ground => return,
            Entry::Pin { on, .. } => {
                let next = pose.at(on);
                sum.arm((here - next).norm() + slack, turn);
                slack = 0.0;
                (on.body, next)
            }
            Entry::OnRail { rail, travel, .. } => {
                let along = pose.e[rail.body] * rail.along;
                let origin = pose.p[rail.body] + pose.e[rail.body] * rail.at;
                let next = origin + along * pose.travel(travel);
                sum.arm((here - next).norm() + slack, turn);
                sum.travel(travel, turns(chain, rail.body));
                // The arm of the rail's body gets longer as the displacement grows.
                slack = SLACK;
                (rail.body, next)
            }
            Entry::WithRail { on, travel, .. } => {
                let next = pose.at(on);
                sum.arm((here - next).norm() + slack + SLACK, turn);
                sum.travel(travel, turn);
                slack = 0.0;
                (on.body, next)
            }
        };
        (body, here) = (on, next);
    }
}

/// `along × d` or `along · d` with a turning direction.
fn projected(chain: &Chain, pose: &Pose, rail: Rail, point: Spot) -> Bound {
    let mut sum = Path::default();
    path(chain, pose, point, &mut sum);
    let origin = Spot {
        body: rail.body,
        at: rail.at,
    };
    path(chain, pose, origin, &mut sum);
    let [u, d] = turns(chain, rail.body);
    let (_, distance) = pose.along(rail, point);
    let far = distance.norm() + SLACK * (sum.first[0] + sum.first[1]);
    let [by_u, by_d] = sum.first;
    Bound {
        k: sum.second.k + u * u * far + 2.0 * u * by_u,
        m: sum.second.m + u * d * far + u * by_d + d * by_u,
        w: sum.second.w + d * d * far + 2.0 * d * by_d,
    }
}

/// The bounds of all rows.
pub(super) fn bounds(chain: &Chain, pose: &Pose, out: &mut Vec<Bound>) {
    out.clear();
    for closure in &chain.closures {
        match *closure {
            Closure::Pin { a, b } => {
                let mut sum = Path::default();
                path(chain, pose, a, &mut sum);
                path(chain, pose, b, &mut sum);
                out.extend([sum.second; 2]);
            }
            Closure::Line { rail, point } | Closure::Travel { rail, point } => {
                out.push(projected(chain, pose, rail, point));
            }
            Closure::Rack { rail, point, .. } => out.push(projected(chain, pose, rail, point)),
            Closure::Tie { .. } | Closure::Gears { .. } => out.push(Bound::default()),
        }
    }
}
