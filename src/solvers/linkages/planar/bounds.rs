//! The longest step of the continuation: bounds on the second derivatives of the closures.
//!
//! For changes δ of the unknowns and s of the drive, each row's second derivative is at most
//! `k ‖δ‖² + 2 m ‖δ‖ |s| + w s²` in the maximum norm. An arm that turns by θ contributes its length
//! times θ², a displacement t along a turning rail 2 |t θ|. Displacements may grow by [`SLACK`].

use super::chain::{Bound, Chain, Closure, Entry, Rail, Spot, Travel};
use super::pose::Pose;
use num_complex::Complex64;
use std::cell::Cell;

/// The distance that unknowns and drive may move within one step, so that the bounds hold: radians
/// or units of length.
pub(super) const SLACK: f64 = 0.25;

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
            // No body turns with a drive that is a displacement.
            Travel::Drive => {
                self.first[1] += 1.0;
                self.second.m += u;
            }
        }
    }
}

/// Returns whether a body turns with an unknown, and how fast with the drive.
fn turns(chain: &Chain, body: usize) -> [f64; 2] {
    let t = &chain.turns[body];
    [f64::from(u8::from(t.unknown.is_some())), t.drive.abs()]
}

/// The bounds along the way to a point; displacements along rails by `travelled`.
fn path(chain: &Chain, travelled: &impl Fn(Travel) -> f64, mut spot: Spot, sum: &mut Path) {
    let mut slack = 0.0;
    loop {
        let body = spot.body;
        let turn = turns(chain, body);
        let arm = |hinge: Complex64| (spot.at - hinge).norm_sqr().sqrt();
        spot = match chain.entries[body] {
            Entry::Ground => return,
            Entry::Pin { on, own } => {
                sum.arm(arm(own) + slack, turn);
                slack = 0.0;
                on
            }
            Entry::OnRail { rail, own, travel } => {
                sum.arm(arm(own) + slack, turn);
                sum.travel(travel, turns(chain, rail.body));
                // The arm of the rail's body gets longer as the displacement grows.
                slack = SLACK;
                rail.at(travelled(travel))
            }
            Entry::WithRail {
                on,
                at,
                along,
                travel,
            } => {
                sum.arm(arm(at + along * travelled(travel)) + slack + SLACK, turn);
                sum.travel(travel, turn);
                slack = 0.0;
                on
            }
        };
    }
}

/// Bounds of a pin's rows.
fn pinned(chain: &Chain, travelled: &impl Fn(Travel) -> f64, ends: [Spot; 2]) -> Bound {
    let mut sum = Path::default();
    for end in ends {
        path(chain, travelled, end, &mut sum);
    }
    sum.second
}

/// The bounds that are the same at every position, for each closure: of pins with nothing but pins
/// on the way.
pub(super) fn constant(chain: &Chain) -> Vec<Option<Bound>> {
    let of = |closure: &Closure| match *closure {
        Closure::Pin { a, b } => {
            let slides = Cell::new(false);
            let bound = pinned(
                chain,
                &|_| {
                    slides.set(true);
                    0.0
                },
                [a, b],
            );
            (!slides.get()).then_some(bound)
        }
        Closure::Tie { .. } | Closure::Gears { .. } => Some(Bound::default()),
        _ => None,
    };
    chain.closures.iter().map(of).collect()
}

/// `along × d` or `along · d` with a turning direction.
fn projected(chain: &Chain, pose: &Pose, rail: Rail, point: Spot) -> Bound {
    let mut sum = Path::default();
    let travelled = |t| pose.travel(t);
    path(chain, &travelled, point, &mut sum);
    path(chain, &travelled, rail.at(0.0), &mut sum);
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
    for (closure, constant) in chain.closures.iter().zip(&chain.bounds) {
        let bound = match (*constant, *closure) {
            (Some(bound), _) => bound,
            (None, Closure::Pin { a, b }) => pinned(chain, &|t| pose.travel(t), [a, b]),
            (None, Closure::Line { rail, point } | Closure::Rack { rail, point, .. }) => {
                projected(chain, pose, rail, point)
            }
            (None, Closure::Tie { .. } | Closure::Gears { .. }) => Bound::default(),
        };
        out.extend((0..closure.rows()).map(|_| bound));
    }
}

#[cfg(test)]
mod tests;
