//! Forces in the joints and the drive torque, by the laws of Newton and Euler for every body.
//!
//! For a given speed and acceleration of the drive each body's forces and torques have to add up to
//! `m a` and `J θ̈` (about its centre of mass). Joints are free of friction. Let Q be what loads
//! and inertia do to each unknown of the tree of bodies: for an angle the moments about its bodies'
//! hinges, for a displacement the force along the rail. The forces λ in the closures, which do no
//! work together with Q, are
//!
//! ```text
//! Jᵀ λ = −Q,      J the closures' Jacobian;
//! ```
//!
//! with them in place each hinge bears what hangs on it, from the last body to the first, and the
//! drive exerts `−Q_φ − λ·F_φ`. Reduced quantities are not used: the drive torque that they give is
//! a check.

use super::chain::{Chain, Closure, Entry, Rail, Spot, spot};
use super::loads::{Load, Loads, stretch};
use super::mechanism::Mechanism;
use super::model::{Joint, Named, Point};
use super::plane::{cross, dot, quarter};
use super::pose::Pose;
use super::state::State;
use num_complex::Complex64;

/// Describes what a joint exerts on one of its bodies.
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
    /// The drive's torque on the driven body in N·m, or its force on the slider along the guide in
    /// N.
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

/// Describes what acts on a body: a force, and a moment about its hinge, in the chain's unit of
/// length.
#[derive(Clone, Copy, Debug, Default)]
struct Wrench {
    force: Complex64,
    moment: f64,
}

/// Describes what acts on the bodies of a mechanism at a pose.
#[derive(Clone)]
pub(super) struct Wrenches<'a> {
    chain: &'a Chain,
    pose: &'a Pose,
    on: Vec<Wrench>,
}

impl<'a> Wrenches<'a> {
    pub(super) fn none(chain: &'a Chain, pose: &'a Pose) -> Wrenches<'a> {
        let on = vec![Wrench::default(); chain.body_count()];
        Wrenches { chain, pose, on }
    }

    /// A torque in N·m.
    pub(super) fn turn(&mut self, body: usize, torque: f64) {
        self.on[body].moment += torque / self.chain.metres;
    }

    /// The work on a unit of each unknown and of the drive, which is last, where everything but
    /// forces of closures acts.
    pub(super) fn known_work(&self) -> Vec<f64> {
        let mut known = self.clone();
        known.hang();
        known.work()
    }

    /// The forces of the joints with those in the closures.
    pub(super) fn borne(mut self, joints: &[Named<Joint>], sizes: &[f64]) -> Vec<JointForce> {
        let mut row = 0;
        for closure in &self.chain.closures {
            self.close(closure, &sizes[row..]);
            row += closure.rows();
        }
        self.hang();
        gathered(joints, &mut self, sizes)
    }

    /// A force at a point of the body's own frame.
    pub(super) fn push(&mut self, body: usize, force: Complex64, at: Complex64) {
        let arm = self.pose.e[body] * (at - self.pose.hinge(self.chain, body));
        self.on[body].force += force;
        self.on[body].moment += cross(arm, force);
    }

    /// A force at a place.
    fn push_at(&mut self, body: usize, force: Complex64, place: Complex64) {
        let hinge = self.pose.hinge(self.chain, body);
        let arm = place - self.pose.at(Spot { body, at: hinge });
        self.on[body].force += force;
        self.on[body].moment += cross(arm, force);
    }

    /// The forces in a closure, and moments of ties.
    fn close(&mut self, closure: &Closure, size: &[f64]) {
        let e = &self.pose.e;
        match *closure {
            Closure::Pin { a, b } => {
                let force = Complex64::new(size[0], size[1]);
                self.push(a.body, force, a.at);
                self.push(b.body, -force, b.at);
            }
            Closure::Line { rail, point } => {
                let force = quarter(e[rail.body] * rail.along) * size[0];
                self.push(point.body, force, point.at);
                self.push_at(rail.body, -force, self.pose.at(point));
            }
            Closure::Tie { a, b, .. } => {
                self.on[b].moment += size[0];
                self.on[a].moment -= size[0];
            }
            Closure::Gears { .. } | Closure::Rack { .. } => {}
        }
    }

    /// Hands every body's force on to what it hangs on, the last body first.
    fn hang(&mut self) {
        for &body in self.chain.order.iter().rev() {
            let force = self.on[body].force;
            let on = match self.chain.entries[body] {
                Entry::Ground => continue,
                Entry::Pin { on, .. } | Entry::WithRail { on, .. } => on,
                Entry::OnRail { rail, travel, .. } => rail.at(self.pose.travel(travel)),
            };
            self.push(on.body, force, on.at);
        }
    }

    /// The work on a unit of each unknown and of the drive, which is last.
    fn work(&self) -> Vec<f64> {
        let (chain, e) = (self.chain, &self.pose.e);
        let mut work = vec![0.0; chain.unknowns + 1];
        for &body in &chain.order {
            let Wrench { force, moment } = self.on[body];
            let turn = &chain.turns[body];
            if let Some(k) = turn.unknown {
                work[k] += moment;
            }
            work[chain.unknowns] += turn.drive * moment;
            match chain.entries[body] {
                Entry::OnRail { rail, travel, .. } => {
                    work[chain.column(travel)] += dot(e[rail.body] * rail.along, force);
                }
                Entry::WithRail { along, travel, .. } => {
                    work[chain.column(travel)] -= dot(e[body] * along, force);
                }
                Entry::Ground | Entry::Pin { .. } => {}
            }
        }
        work
    }
}

impl Loads {
    /// Forces in the joints and of the drive for a speed (rad/s or m/s) and acceleration of the
    /// drive.
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
        let joints = &mechanism.description().joints;
        without_teeth(joints)?;
        let (chain, pose) = (&mechanism.chain, &state.pose);
        let mut all = Wrenches::none(chain, pose);
        // The known side: loads less inertia.
        for m in &self.masses {
            let [x, y] = m.centre;
            let centre = Point::new(m.body, x, y);
            let c = mechanism.point(state, &centre);
            let turn = mechanism.body_angle(state, m.body);
            let at = |second: f64, first: f64| second * speed * speed + first * acceleration;
            let kg = m.mass.kg();
            let [x, y] = [0, 1].map(|i| kg * (self.gravity[i] - at(c.second[i], c.first[i])));
            let own = spot(&centre, chain.metres).at;
            all.push(m.body, Complex64::new(x, y), own);
            let torque = -m.inertia.kg_m2() * at(turn.second, turn.first);
            all.turn(m.body, torque);
        }
        self.loads
            .iter()
            .for_each(|l| applied(mechanism, state, l, speed, &mut all));
        let work = all.known_work();
        let n = chain.unknowns;
        let mut sizes = vec![0.0; n];
        let jacobian = &state.jacobian;
        state
            .factors
            .solve_transposed_closely(jacobian, &work[..n], &mut sizes);
        sizes.iter_mut().for_each(|x| *x = -*x);
        let by_closures = (0..n).map(|r| sizes[r] * jacobian[(r, n)]).sum::<f64>();
        let drive = -(work[n] + by_closures);
        let found = Reactions {
            joints: all.borne(joints, &sizes),
            // A torque, or a force as it is.
            drive: match chain.linear {
                true => drive,
                false => drive * chain.metres,
            },
        };
        match found.drive.is_finite() {
            true => Ok(found),
            false => Err(ReactionError::Singular),
        }
    }
}

/// Checks that no joint is one of gears or a rack.
pub(super) fn without_teeth(joints: &[Named<Joint>]) -> Result<(), ReactionError> {
    let teeth = |j: &Joint| matches!(j, Joint::Gears { .. } | Joint::Rack { .. });
    match joints.iter().find(|j| teeth(&j.part)) {
        None => Ok(()),
        Some(joint) => Err(ReactionError::Teeth {
            joint: joint.name.clone(),
        }),
    }
}

/// The forces of the joints, from those of hinges and closures.
fn gathered(joints: &[Named<Joint>], all: &mut Wrenches, sizes: &[f64]) -> Vec<JointForce> {
    let (chain, pose) = (all.chain, all.pose);
    let mut found: Vec<JointForce> = Vec::with_capacity(chain.forces[joints.len()]);
    for (joint, named) in joints.iter().enumerate() {
        let points = match &named.part {
            Joint::Pin { points } => &points[1..],
            Joint::Slide { slider: p, .. } | Joint::Slot { pin: p, .. } => std::slice::from_ref(p),
            Joint::Gears { .. } | Joint::Rack { .. } => &[],
        };
        found.extend(points.iter().map(|point| {
            let at = pose.at(spot(point, chain.metres)) * chain.metres;
            JointForce {
                joint,
                body: point.body,
                force_n: [0.0; 2],
                moment_n_m: 0.0,
                at_m: [at.re, at.im],
            }
        }));
    }
    let add = |found: &mut JointForce, force: Complex64| {
        found.force_n[0] += force.re;
        found.force_n[1] += force.im;
    };
    // Adds the force of a pin on the body of one of its points, and the opposite on the one that
    // carries the others.
    let mut pin = |(joint, point): (usize, usize), on: usize, force: Complex64| {
        let own = &mut found[chain.forces[joint]..chain.forces[joint + 1]];
        if let Some(k) = point.checked_sub(1) {
            add(&mut own[k], force);
        }
        if let Some(other) = own.iter_mut().find(|f| f.body == on) {
            add(other, -force);
        }
    };
    for &body in &chain.order {
        if let Entry::Pin { on, .. } = chain.entries[body] {
            pin(chain.hung[body], on.body, -all.on[body].force);
        }
    }
    let rows = |closures: &[Closure]| closures.iter().map(Closure::rows).sum::<usize>();
    for (k, (closure, joint)) in chain.closures.iter().zip(&chain.closed).enumerate() {
        if let (Closure::Pin { b, .. }, Some(joint)) = (closure, joint) {
            let row = rows(&chain.closures[..k]);
            pin(*joint, b.body, Complex64::new(sizes[row], sizes[row + 1]));
        }
    }
    on_rails(chain, all, sizes, &mut found);
    found
}

/// The forces of slides and slots, at right angles to their rails, and the moments of slides.
fn on_rails(chain: &Chain, all: &mut Wrenches, sizes: &[f64], found: &mut [JointForce]) {
    let pose = all.pose;
    let first = |joint: usize| chain.forces[joint];
    let normal = |rail: &Rail| quarter(pose.e[rail.body] * rail.along);
    let set = |found: &mut [JointForce], joint: usize, normal: Complex64, size: f64| {
        found[first(joint)].force_n = [normal.re * size, normal.im * size];
    };
    for &body in &chain.order {
        let force = all.on[body].force;
        let (joint, _) = chain.hung[body];
        match chain.entries[body] {
            Entry::OnRail { rail, .. } => {
                let n = normal(&rail);
                set(found, joint, n, -dot(n, force));
            }
            Entry::WithRail { along, .. } => {
                let n = quarter(pose.e[body] * along);
                set(found, joint, n, dot(n, force));
            }
            Entry::Ground | Entry::Pin { .. } => {}
        }
    }
    let mut row = 0;
    for (closure, joint) in chain.closures.iter().zip(&chain.closed) {
        if let (Closure::Line { rail, .. }, Some((joint, _))) = (closure, joint) {
            set(found, *joint, normal(rail), sizes[row]);
        }
        if let Closure::Tie { a, b, .. } = *closure {
            let tie = chain.ties.iter().find(|t| (t.a, t.b) == (a, b));
            if let Some(joint) = tie.and_then(|t| t.joint) {
                found[first(joint)].moment_n_m = sizes[row] * chain.metres;
            }
        }
        row += closure.rows();
    }
    // Each tie bears the moment that is left of the body placed last.
    for &body in chain.order.iter().rev() {
        let Some(tie) = chain.tied[body].map(|k| &chain.ties[k]) else {
            continue;
        };
        let borne = -all.on[body].moment;
        let (other, on_slider) = match tie.b == body {
            true => (tie.a, borne),
            false => (tie.b, -borne),
        };
        all.on[other].moment -= borne;
        if let Some(joint) = tie.joint {
            found[first(joint)].moment_n_m = on_slider * chain.metres;
        }
    }
}

/// Adds a load's forces at the drive's speed.
fn applied(mechanism: &Mechanism, state: &State, load: &Load, speed: f64, all: &mut Wrenches) {
    let linear = mechanism.drive_is_displacement();
    let drive = mechanism.drive_of(state);
    let angle = |b: usize| mechanism.body_angle(state, b);
    let metres = mechanism.chain.metres;
    let mut couple = |body: usize, from: usize, torque: f64| {
        all.turn(body, torque);
        all.turn(from, -torque);
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
            let force = Complex64::new(c * x - s * y, s * x + c * y);
            all.push(at.body, force, spot(at, metres).at);
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
            let pull = Complex64::new(q[0] - p[0], q[1] - p[1]) / l * tension;
            for (end, force) in ends.iter().zip([pull, -pull]) {
                all.push(end.body, force, spot(end, metres).at);
            }
        }
    }
}
