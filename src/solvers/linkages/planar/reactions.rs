//! Forces in the joints and the drive torque, by the laws of Newton and Euler for every body.
//!
//! For a given speed and acceleration of the drive each body's forces and torques have to add up to
//! `m a` and `J θ̈` (about its centre of mass). With joints free of friction that is one linear system
//! of three equations a body. It does not use the reduced quantities, whose drive torque is a check.

use super::dense::{Factors, Matrix};
use super::loads::{BodyMass, Load, Loads, stretch};
use super::mechanism::Mechanism;
use super::model::{Drive, GROUND, Guide, Joint, Point};
use super::state::State;
use crate::units::{Inertia, Length, Mass};

/// What a joint exerts on one of its bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointForce {
    /// The joint's number.
    pub joint: usize,
    /// The body that it acts on; the joint's first body takes the opposite.
    pub body: usize,
    /// In newtons, in the ground's axes.
    pub force_n: [f64; 2],
    /// In newton metres, of slides; about [`JointForce::at_m`].
    pub moment_n_m: f64,
    /// Where it acts.
    pub at_m: [f64; 2],
}

/// The forces at one position.
#[derive(Clone, Debug, PartialEq)]
pub struct Reactions {
    /// Joint by joint.
    pub joints: Vec<JointForce>,
    /// The drive's torque on the driven body in N·m, or its force on the slider along the guide in N.
    pub drive: f64,
}

/// Why there are no reactions.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ReactionError {
    /// Where the teeth of a gear or rack meet is not part of the description.
    #[error(
        "{joint} is a gear or rack: forces need the place where its teeth meet, which is not known"
    )]
    Teeth {
        /// The joint's name.
        joint: String,
    },
    /// The position is singular for forces.
    #[error("the position is singular: the forces in the joints are not determined")]
    Singular,
}

/// One unknown: a unit force or torque on a body, and its opposite on another.
#[derive(Clone, Copy, Debug)]
struct Unit {
    on: usize,
    against: usize,
    force: [f64; 2],
    at: [f64; 2],
    moment: f64,
}

fn moment(arm: [f64; 2], force: [f64; 2]) -> f64 {
    arm[0] * force[1] - arm[1] * force[0]
}

/// The forces on all bodies: x, y, and torque about each body's centre of mass.
struct Sums {
    centres: Vec<[f64; 2]>,
    rows: Vec<f64>,
}

impl Sums {
    fn add(&mut self, body: usize, force: [f64; 2], at: [f64; 2], torque: f64, sign: f64) {
        if body == GROUND {
            return;
        }
        let k = 3 * (body - 1);
        let c = self.centres[body];
        self.rows[k] += sign * force[0];
        self.rows[k + 1] += sign * force[1];
        self.rows[k + 2] += sign * (torque + moment([at[0] - c[0], at[1] - c[1]], force));
    }
}

impl Loads {
    /// Forces in the joints and of the drive for a speed (rad/s or m/s) and acceleration of the drive.
    ///
    /// # Errors
    /// [`ReactionError`].
    pub fn reactions(
        &self,
        mechanism: &Mechanism,
        state: &State,
        speed: f64,
        acceleration: f64,
    ) -> Result<Reactions, ReactionError> {
        let bodies = mechanism.description().bodies.len();
        let masses: Vec<BodyMass> = (0..bodies).map(|b| self.mass_of(b)).collect();
        let centre = |m: &BodyMass| Point::new(m.body, m.centre[0], m.centre[1]);
        let motions: Vec<_> = masses
            .iter()
            .map(|m| mechanism.point(state, &centre(m)))
            .collect();
        let mut sums = Sums {
            centres: motions.iter().map(|m| m.r).collect(),
            rows: vec![0.0; 3 * (bodies - 1)],
        };
        // What is known: loads less inertia.
        for (m, c) in masses.iter().zip(&motions).skip(1) {
            let kg = m.mass.kg();
            let turn = mechanism.body_angle(state, m.body);
            let at = |second: f64, first: f64| second * speed * speed + first * acceleration;
            let force = [0, 1].map(|i| kg * (self.gravity[i] - at(c.second[i], c.first[i])));
            let torque = -m.inertia.kg_m2() * at(turn.second, turn.first);
            sums.add(m.body, force, c.r, torque, 1.0);
        }
        self.loads
            .iter()
            .for_each(|l| applied(mechanism, state, l, speed, &mut sums));
        let (units, owners) = units(mechanism, state)?;
        let n = sums.rows.len();
        if units.len() != n {
            return Err(ReactionError::Singular);
        }
        let known = std::mem::replace(&mut sums.rows, vec![0.0; n]);
        let order = Order::new(mechanism, &units);
        let mut matrix = Matrix::new(n, n);
        for (column, &unit) in order.units.iter().enumerate() {
            let u = &units[unit];
            sums.rows.fill(0.0);
            sums.add(u.on, u.force, u.at, u.moment, 1.0);
            sums.add(u.against, u.force, u.at, u.moment, -1.0);
            for (row, &from) in order.rows.iter().enumerate() {
                matrix[(row, column)] = sums.rows[from];
            }
        }
        let mut factors = Factors::default();
        if !factors.of_blocks(&matrix, 0, order.blocks.into_iter()) {
            return Err(ReactionError::Singular);
        }
        let mut solved = vec![0.0; n];
        factors.solve(|r| -known[order.rows[r]], &mut solved);
        let mut sizes = vec![0.0; n];
        for (&unit, size) in order.units.iter().zip(solved) {
            sizes[unit] = size;
        }
        Ok(gathered(&units, &owners, &sizes))
    }

    fn mass_of(&self, body: usize) -> BodyMass {
        let none = BodyMass {
            body,
            mass: Mass::from_kg(0.0),
            inertia: Inertia::from_kg_m2(0.0),
            centre: [Length::from_m(0.0); 2],
        };
        self.masses
            .iter()
            .find(|m| m.body == body)
            .copied()
            .unwrap_or(none)
    }
}

/// The equations and unknowns of the groups, the last group first: its joints hold nothing but its own bodies.
struct Order {
    rows: Vec<usize>,
    units: Vec<usize>,
    blocks: Vec<std::ops::Range<usize>>,
}

impl Order {
    /// All in one block where a group has not as many unknowns as equations: a pin of several bodies whose first one
    /// belongs to a later group.
    fn new(mechanism: &Mechanism, units: &[Unit]) -> Order {
        let group = &mechanism.chain.group;
        let of = |u: &Unit| group[u.on].max(group[u.against]);
        let mut all = Order {
            rows: Vec::with_capacity(units.len()),
            units: Vec::with_capacity(units.len()),
            blocks: Vec::new(),
        };
        for k in (1..=mechanism.chain.blocks.len()).rev() {
            let from = all.rows.len();
            for body in (1..group.len()).filter(|&b| group[b] == k) {
                all.rows.extend(3 * (body - 1)..3 * body);
            }
            let own = (0..units.len()).filter(|&u| of(&units[u]) == k);
            all.units.extend(own);
            all.blocks.push(from..all.rows.len());
            if all.units.len() != all.rows.len() {
                return Order {
                    rows: (0..units.len()).collect(),
                    units: (0..units.len()).collect(),
                    blocks: std::iter::once(0..units.len()).collect(),
                };
            }
        }
        all
    }
}

/// Joint forces from the sizes of their units; the last unit is the drive's.
fn gathered(units: &[Unit], owners: &[Option<(usize, usize)>], sizes: &[f64]) -> Reactions {
    let mut joints: Vec<JointForce> = Vec::new();
    let mut drive = 0.0;
    for ((u, owner), size) in units.iter().zip(owners).zip(sizes) {
        let Some((joint, body)) = *owner else {
            drive = *size;
            continue;
        };
        let same = joints
            .iter_mut()
            .find(|j| (j.joint, j.body) == (joint, body));
        let (force, torque) = (u.force.map(|f| f * size), u.moment * size);
        match same {
            Some(j) => {
                j.force_n = [j.force_n[0] + force[0], j.force_n[1] + force[1]];
                j.moment_n_m += torque;
            }
            None => joints.push(JointForce {
                joint,
                body,
                force_n: force,
                moment_n_m: torque,
                at_m: u.at,
            }),
        }
    }
    Reactions { joints, drive }
}

type Units = (Vec<Unit>, Vec<Option<(usize, usize)>>);

/// All unknown forces with the joint and body they belong to; `None` for the drive, which is last.
fn units(mechanism: &Mechanism, state: &State) -> Result<Units, ReactionError> {
    let at = |p: &Point| mechanism.point(state, p).r;
    let direction = |g: &Guide| {
        let turn = mechanism.body_angle(state, g.origin.body).angle.rad() + g.direction.rad();
        let (s, c) = turn.sin_cos();
        [c, s]
    };
    let mut units = Vec::new();
    let mut owners = Vec::new();
    let description = mechanism.description();
    for (joint, named) in description.joints.iter().enumerate() {
        let mut add = |on: usize, against: usize, force: [f64; 2], at: [f64; 2], moment: f64| {
            units.push(Unit {
                on,
                against,
                force,
                at,
                moment,
            });
            owners.push(Some((joint, on)));
        };
        match &named.part {
            Joint::Pin { points } => {
                for p in &points[1..] {
                    for force in [[1.0, 0.0], [0.0, 1.0]] {
                        add(p.body, points[0].body, force, at(p), 0.0);
                    }
                }
            }
            Joint::Slide {
                slider: p, guide, ..
            }
            | Joint::Slot {
                pin: p,
                slot: guide,
            } => {
                let [c, s] = direction(guide);
                add(p.body, guide.origin.body, [-s, c], at(p), 0.0);
                if matches!(named.part, Joint::Slide { .. }) {
                    add(p.body, guide.origin.body, [0.0, 0.0], at(p), 1.0);
                }
            }
            Joint::Gears { .. } | Joint::Rack { .. } => {
                return Err(ReactionError::Teeth {
                    joint: named.name.clone(),
                });
            }
        }
    }
    let drive = match description.drive {
        Drive::Angle { body, from } => Unit {
            on: body,
            against: from,
            force: [0.0, 0.0],
            at: [0.0, 0.0],
            moment: 1.0,
        },
        Drive::Displacement { joint } => {
            let Joint::Slide { slider, guide, .. } = &description.joints[joint].part else {
                unreachable!("a slide, as checked");
            };
            Unit {
                on: slider.body,
                against: guide.origin.body,
                force: direction(guide),
                at: at(slider),
                moment: 0.0,
            }
        }
    };
    units.push(drive);
    owners.push(None);
    Ok((units, owners))
}

/// Adds a load's forces at the drive's speed.
fn applied(mechanism: &Mechanism, state: &State, load: &Load, speed: f64, sums: &mut Sums) {
    let linear = mechanism.drive_is_displacement();
    let drive = mechanism.drive_of(state);
    let angle = |b: usize| mechanism.body_angle(state, b);
    let mut couple = |body: usize, from: usize, torque: f64| {
        sums.add(body, [0.0; 2], [0.0; 2], torque, 1.0);
        sums.add(from, [0.0; 2], [0.0; 2], torque, -1.0);
    };
    match load {
        Load::Torque { body, from, torque } => couple(*body, *from, torque.at(drive, linear)[0]),
        Load::TorsionSpring {
            body,
            from,
            stiffness,
            angle: rest,
        } => {
            let turn = angle(*body).angle.rad() - angle(*from).angle.rad() - rest;
            couple(*body, *from, -stiffness * turn);
        }
        Load::TorsionDamper {
            body,
            from,
            damping,
        } => {
            let rate = (angle(*body).first - angle(*from).first) * speed;
            couple(*body, *from, -damping * rate);
        }
        Load::Force {
            at,
            components,
            along,
        } => {
            let (s, c) = angle(*along).angle.rad().sin_cos();
            let [x, y] = components.each_ref().map(|f| f.at(drive, linear)[0]);
            let place = mechanism.point(state, at).r;
            sums.add(at.body, [c * x - s * y, s * x + c * y], place, 0.0, 1.0);
        }
        Load::Spring { ends, .. } | Load::Damper { ends, .. } => {
            let [l, first, _] = stretch(mechanism, state, ends);
            let tension = match load {
                Load::Spring {
                    stiffness, length, ..
                } => stiffness * (l - length),
                Load::Damper { damping, .. } => damping * first * speed,
                _ => 0.0,
            };
            let [p, q] = ends.map(|e| mechanism.point(state, &e).r);
            let pull = [(q[0] - p[0]) / l * tension, (q[1] - p[1]) / l * tension];
            sums.add(ends[0].body, pull, p, 0.0, 1.0);
            sums.add(ends[1].body, pull, q, 0.0, -1.0);
        }
    }
}
