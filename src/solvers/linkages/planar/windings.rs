//! Whole turns of an angle that gears and racks tell apart.
//!
//! Pins, slides and slots give an angle up to whole turns, while gears and racks take it as a real
//! number. Let θ be an angle that joints of the first kind give, and let every body behind it turn
//! by gears: a whole turn of θ turns each of them by a fraction of a turn, and after q turns, q
//! being the least common denominator of these fractions, all of them are where they were. So 0, 1,
//! …, q − 1 turns of θ give all positions, and none twice.
//!
//! A rack moves by the same length with each turn and does not come back. Where pins alone join its
//! slider to the body of its guide, the slider is no farther from the guide's origin than the sum
//! of the largest distances between two points of a body, over all bodies: that leaves finitely
//! many turns. Elsewhere they are endless, and the positions found are not said to be all.
//!
//! The drive is a real number that counts its own turns.

use super::chain::{Block, Chain, Closure, spot};
use super::model::{Description, Joint, Point};
use super::plane::dot;
use super::pose::Pose;
use std::f64::consts::TAU;

/// Turns of one angle, and turns for one rack, at most; a mechanism with more counts as having
/// endlessly many.
const MOST_TURNS: i128 = 1000;
/// Numerators and denominators beyond this count as irrational: ever more fractions would round to
/// one number.
const LARGEST: i128 = 1_000_000;

/// A fraction in lowest terms, the denominator positive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Fraction {
    over: i128,
    under: i128,
}

fn gcd(a: i128, b: i128) -> i128 {
    if b == 0 { a.abs() } else { gcd(b, a % b) }
}

impl Fraction {
    const ZERO: Fraction = Fraction { over: 0, under: 1 };
    const ONE: Fraction = Fraction { over: 1, under: 1 };

    fn new(over: i128, under: i128) -> Option<Fraction> {
        let by = gcd(over, under) * under.signum();
        let (over, under) = (over.checked_div(by)?, under / by);
        (over.abs() <= LARGEST && under <= LARGEST).then_some(Fraction { over, under })
    }

    /// The first convergent of the continued fraction of `x` that rounds to `x`.
    fn of(x: f64) -> Option<Fraction> {
        let (mut before, mut last) = ((0, 1), (1, 0));
        let mut rest = x;
        for _ in 0..64 {
            let whole = rest.floor();
            if !(whole.abs() <= LARGEST as f64) {
                return None;
            }
            let whole_part = whole as i128;
            let next: (i128, i128) = (
                whole_part * last.0 + before.0,
                whole_part * last.1 + before.1,
            );
            if next.1 > LARGEST {
                return None;
            }
            if next.0 as f64 / next.1 as f64 == x {
                return Fraction::new(next.0, next.1);
            }
            (before, last) = (last, next);
            rest = 1.0 / (rest - whole);
        }
        None
    }

    fn plus(self, other: Fraction) -> Option<Fraction> {
        let over = self.over * other.under + other.over * self.under;
        Fraction::new(over, self.under * other.under)
    }

    fn less(self, other: Fraction) -> Option<Fraction> {
        self.plus(Fraction {
            over: -other.over,
            ..other
        })
    }

    fn times(self, other: Fraction) -> Option<Fraction> {
        Fraction::new(self.over * other.over, self.under * other.under)
    }

    fn inverse(self) -> Option<Fraction> {
        Fraction::new(self.under, self.over)
    }

    fn to_f64(self) -> f64 {
        self.over as f64 / self.under as f64
    }
}

/// Describes what a turn of one unknown angle does to bodies of later groups.
#[derive(Clone, Debug)]
struct Effects {
    /// Unknown angles with the part of a turn that each makes, the turned one first.
    angles: Vec<(usize, Fraction)>,
    /// Group, closure and the wheel's turn against the guide, of the racks that it moves.
    racks: Vec<(usize, usize, Fraction)>,
}

/// An angle that its own group gives up to whole turns.
#[derive(Clone, Debug)]
struct Free {
    unknown: usize,
    /// Turns after which the bodies behind gears are where they were.
    period: u32,
}

/// Turns of an angle as far as a rack can go.
#[derive(Clone, Debug)]
struct Racked {
    /// The rack's closure.
    closure: usize,
    /// Unknown angles with the radians that one step adds.
    steps: Vec<(usize, f64)>,
    /// The travel of the rack by a step, and its largest distance from its guide's origin.
    step: f64,
    reach: f64,
}

/// Which turns are to be tried, group by group.
#[derive(Clone, Debug, Default)]
pub(super) struct Windings {
    free: Vec<Vec<Free>>,
    racked: Vec<Vec<Racked>>,
    /// Tells whether some turns are endless, so that not all are tried.
    pub endless: bool,
}

impl Windings {
    pub(super) fn new(description: &Description, chain: &Chain) -> Windings {
        let groups = chain.blocks.len();
        let mut all = Windings {
            free: vec![Vec::new(); groups],
            racked: vec![Vec::new(); groups],
            endless: false,
        };
        let geared = |c: &Closure| matches!(c, Closure::Gears { .. } | Closure::Rack { .. });
        if !chain.closures.iter().any(geared) {
            return all;
        }
        let mut racks: Vec<usize> = Vec::new();
        for (group, block) in chain.blocks.iter().enumerate() {
            let given = given(chain, group);
            let angles = block.unknowns.clone().filter(|&u| !chain.lengths[u]);
            for unknown in angles.filter(|u| !given.contains(u)) {
                let added = effects(chain, group, unknown)
                    .and_then(|found| all.add(description, chain, group, &found, &mut racks));
                all.endless |= added.is_none();
            }
        }
        all
    }

    /// Adds the turns of an angle; nothing if they are endless.
    fn add(
        &mut self,
        description: &Description,
        chain: &Chain,
        group: usize,
        found: &Effects,
        racks: &mut Vec<usize>,
    ) -> Option<()> {
        let unders = found.angles.iter().map(|(_, e)| e.under);
        let period = unders.fold(1, |m, q| (m / gcd(m, q)).saturating_mul(q));
        if period > MOST_TURNS {
            return None;
        }
        if period > 1 {
            self.free[group].push(Free {
                unknown: found.angles[0].0,
                period: period as u32,
            });
        }
        let Some(&(at, closure, turn)) = found.racks.first() else {
            return Some(());
        };
        // Two angles that move one rack would have to be turned together.
        if racks.contains(&closure) {
            return None;
        }
        racks.extend(found.racks.iter().map(|r| r.1));
        let reach = reach(description, chain, closure)?;
        let Closure::Rack { radius, .. } = chain.closures[closure] else {
            return None;
        };
        let turns = TAU * period as f64;
        let before = |u: &usize| *u < chain.blocks[at].unknowns.start;
        let angles = found.angles.iter().filter(|(u, _)| before(u));
        let racked = Racked {
            closure,
            steps: angles.map(|(u, e)| (*u, turns * e.to_f64())).collect(),
            step: radius * turns * turn.to_f64(),
            reach,
        };
        if 2.0 * reach > racked.step.abs() * MOST_TURNS as f64 {
            return None;
        }
        self.racked[at].push(racked);
        Some(())
    }

    /// Returns whether one position may come from several combinations of turns.
    pub(super) fn overlap(&self) -> bool {
        let count = |all: &[Vec<Free>]| all.iter().map(Vec::len).sum::<usize>();
        count(&self.free) > 1
    }

    /// The positions of the groups before this one, with the turns for which its racks are within
    /// reach.
    pub(super) fn before(&self, chain: &Chain, group: usize, poses: Vec<Pose>) -> Vec<Pose> {
        self.racked[group].iter().fold(poses, |poses, racked| {
            let of = |pose: Pose| racked.turned(chain, pose);
            poses.into_iter().flat_map(of).collect()
        })
    }

    /// The positions of this group and those before, with the turns of its own angles.
    pub(super) fn after(&self, group: usize, poses: Vec<Pose>) -> Vec<Pose> {
        self.free[group].iter().fold(poses, |poses, free| {
            let turned = |pose: Pose| {
                (0..free.period).map(move |turns| {
                    let mut pose = pose.clone();
                    pose.u[free.unknown] += TAU * f64::from(turns);
                    pose
                })
            };
            poses.into_iter().flat_map(turned).collect()
        })
    }
}

impl Racked {
    fn turned(&self, chain: &Chain, pose: Pose) -> Vec<Pose> {
        let Closure::Rack {
            rail,
            wheel,
            radius,
            phase,
            ..
        } = chain.closures[self.closure]
        else {
            return vec![pose];
        };
        let turn = pose.angle(chain, wheel) - pose.angle(chain, rail.body);
        let at = radius * turn + phase;
        let ends = [-self.reach, self.reach].map(|end| (end - at) / self.step);
        let [low, high] = [ends[0].min(ends[1]).ceil(), ends[0].max(ends[1]).floor()];
        let count = (high - low).max(-1.0) as i64 + 1;
        let with = |k: i64| {
            let mut pose = pose.clone();
            for (u, by) in &self.steps {
                pose.u[*u] += by * (low + k as f64);
            }
            pose
        };
        (0..count).map(with).collect()
    }
}

/// Turns the wheels of a group by the whole turns that their gears and racks have made.
pub(super) fn wind(chain: &Chain, block: &Block, pose: &mut Pose) {
    let own = |b: usize| block.bodies.contains(&b);
    for closure in &chain.closures[block.closures.clone()] {
        let angle = |b: usize| pose.angle(chain, b);
        let (wheel, due) = match *closure {
            Closure::Gears {
                wheels: [a, b],
                carrier: c,
                ratio,
                phase,
            } if !own(c) && own(a) != own(b) => match own(b) {
                true => (b, angle(c) + ratio * (angle(a) - angle(c)) + phase),
                false => (a, angle(c) + (angle(b) - angle(c) - phase) / ratio),
            },
            Closure::Rack {
                rail,
                point,
                wheel,
                radius,
                phase,
            } if !own(rail.body) && !own(point.body) => {
                let (along, d) = pose.along(rail, point);
                (wheel, angle(rail.body) + (dot(along, d) - phase) / radius)
            }
            _ => continue,
        };
        let turns = ((due - angle(wheel)) / TAU).round();
        if let Some(u) = chain.turns[wheel].unknown {
            pose.u[u] += TAU * turns;
        }
    }
}

/// The unknown angles of a group that gears and racks give as real numbers.
fn given(chain: &Chain, group: usize) -> Vec<usize> {
    let block = &chain.blocks[group];
    let own = |b: usize| block.bodies.contains(&b);
    let closures = chain.closures[block.closures.clone()].iter();
    let wheel = |closure: &Closure| match *closure {
        Closure::Gears {
            wheels: [a, b],
            carrier,
            ..
        } if !own(carrier) => match (own(a), own(b)) {
            (false, true) => Some(b),
            (true, false) => Some(a),
            _ => None,
        },
        Closure::Rack {
            rail, point, wheel, ..
        } if !own(rail.body) && !own(point.body) => Some(wheel),
        _ => None,
    };
    let wheels = closures.filter_map(wheel);
    wheels.filter_map(|b| chain.turns[b].unknown).collect()
}

/// Returns what a turn of an unknown angle of a group does; nothing where a ratio is no fraction.
fn effects(chain: &Chain, group: usize, unknown: usize) -> Option<Effects> {
    let mut all = Effects {
        angles: vec![(unknown, Fraction::ONE)],
        racks: Vec::new(),
    };
    for (later, block) in chain.blocks.iter().enumerate().skip(group + 1) {
        let own = |b: usize| block.bodies.contains(&b);
        for closure in block.closures.clone() {
            let turn = |b: usize| {
                let of = |u| all.angles.iter().find(|a| a.0 == u).map(|a| a.1);
                let turn = chain.turns[b].unknown.and_then(of);
                turn.unwrap_or(Fraction::ZERO)
            };
            let (wheel, turned) = match chain.closures[closure] {
                Closure::Gears {
                    wheels: [a, b],
                    carrier: c,
                    ratio,
                    ..
                } if !own(c) && own(a) != own(b) => {
                    let (known, wheel) = if own(b) { (a, b) } else { (b, a) };
                    let against = turn(known).less(turn(c))?;
                    if against == Fraction::ZERO {
                        (wheel, turn(c))
                    } else {
                        let ratio = Fraction::of(ratio)?;
                        let ratio = if own(b) { ratio } else { ratio.inverse()? };
                        (wheel, turn(c).plus(ratio.times(against)?)?)
                    }
                }
                Closure::Rack {
                    rail, point, wheel, ..
                } if !own(rail.body) => {
                    let guide = turn(rail.body);
                    if !own(point.body) {
                        (wheel, guide)
                    } else {
                        let against = turn(wheel).less(guide)?;
                        if against != Fraction::ZERO && !own(wheel) {
                            all.racks.push((later, closure, against));
                        }
                        continue;
                    }
                }
                _ => continue,
            };
            if let Some(u) = chain.turns[wheel].unknown.filter(|_| turned.over != 0) {
                all.angles.push((u, turned));
            }
        }
    }
    Some(all)
}

/// The largest distance of a rack's slider from its guide's origin, where pins join it to the
/// guide's body.
fn reach(description: &Description, chain: &Chain, closure: usize) -> Option<f64> {
    let Closure::Rack { rail, point, .. } = chain.closures[closure] else {
        return None;
    };
    let mut joined = vec![false; chain.body_count()];
    joined[point.body] = true;
    // Each round joins at least one body more, or is the last.
    for _ in 0..joined.len() {
        for joint in &description.joints {
            if let Joint::Pin { points } = &joint.part
                && points.iter().any(|p| joined[p.body])
            {
                points.iter().for_each(|p| joined[p.body] = true);
            }
        }
    }
    let points: Vec<Point> = description.joints.iter().flat_map(held).collect();
    let extent = |body: usize| {
        let on = points.iter().filter(|p| p.body == body);
        let at: Vec<_> = on.map(|p| spot(p, chain.metres).at).collect();
        let pairs = at
            .iter()
            .flat_map(|p| at.iter().map(move |q| (p - q).norm()));
        pairs.fold(0.0, f64::max)
    };
    let all = (0..joined.len()).map(extent).sum::<f64>();
    joined[rail.body].then_some(all * (1.0 + 1e-9))
}

/// The points that a joint holds.
fn held(joint: &super::model::Named<Joint>) -> Vec<Point> {
    match &joint.part {
        Joint::Pin { points } => points.clone(),
        part => match part.guided() {
            Some((point, guide)) => vec![*point, guide.origin],
            None => Vec::new(),
        },
    }
}

#[cfg(test)]
mod tests;
