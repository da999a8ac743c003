//! Effects of loads: as generalised forces on the independent coordinates, as forces on the bodies,
//! and as energies.

use super::super::chain::{Spot, spot};
use super::super::loads::{Course, Load};
use super::super::motion::Motion;
use super::super::plane::dot;
use super::super::pose::Pose;
use super::super::reactions::Wrenches;
use super::flow::Instant;
use super::{DrivenLoad, Dynamics, Law};
use num_complex::Complex64;

/// A receiver of the forces and torques of loads.
pub(super) trait Sink {
    /// A force in N at a point.
    fn push(&mut self, at: Spot, force: Complex64);
    /// A torque in N·m on a body, and its reaction on another.
    fn turn(&mut self, body: usize, from: usize, torque: f64);
    /// An inertia that turns with the difference of two angles, beside the torque that the
    /// accelerations at hand ask for.
    fn rotor(&mut self, body: usize, from: usize, inertia: f64);
}

impl Sink for Wrenches<'_> {
    fn push(&mut self, at: Spot, force: Complex64) {
        Wrenches::push(self, at.body, force, at.at);
    }

    fn turn(&mut self, body: usize, from: usize, torque: f64) {
        Wrenches::turn(self, body, torque);
        Wrenches::turn(self, from, -torque);
    }

    fn rotor(&mut self, _: usize, _: usize, _: f64) {}
}

/// Generalised forces that loads add to.
pub(super) struct Pushed<'a> {
    pub pose: &'a Pose,
    pub partial: &'a [Motion],
    pub force: &'a mut [f64],
    pub mass: &'a mut [f64],
    pub metres: f64,
}

impl Sink for Pushed<'_> {
    fn push(&mut self, at: Spot, force: Complex64) {
        for (sum, partial) in self.force.iter_mut().zip(self.partial) {
            *sum += dot(force, partial.moved(self.pose, at)[0]) * self.metres;
        }
    }

    fn turn(&mut self, body: usize, from: usize, torque: f64) {
        for (sum, partial) in self.force.iter_mut().zip(self.partial) {
            *sum += torque * (partial.bodies[body].turn[0] - partial.bodies[from].turn[0]);
        }
    }

    fn rotor(&mut self, body: usize, from: usize, inertia: f64) {
        let d = self.force.len();
        let turn = |m: &Motion| m.bodies[body].turn[0] - m.bodies[from].turn[0];
        for i in 0..d {
            for j in 0..=i {
                let both = turn(&self.partial[i]) * turn(&self.partial[j]);
                self.mass[i * d + j] += inertia * both;
            }
        }
    }
}

/// Hands on what a load by a law does.
pub(super) fn drive(load: &DrivenLoad, instant: &Instant, sink: &mut impl Sink) {
    let value = |law: &Law| law(instant);
    match load {
        DrivenLoad::Torque { body, from, torque } => sink.turn(*body, *from, value(torque)),
        DrivenLoad::Force { at, components } => {
            let [x, y] = components.each_ref().map(value);
            let metres = instant.dynamics.chain.metres;
            sink.push(spot(at, metres), Complex64::new(x, y));
        }
        DrivenLoad::Inertia {
            body,
            from,
            inertia,
        } => {
            let bodies = &instant.flow.bodies;
            let turn = bodies[*body].turn[1] - bodies[*from].turn[1];
            sink.turn(*body, *from, -inertia * turn);
            sink.rotor(*body, *from, *inertia);
        }
    }
}

/// Hands on what a load does.
pub(super) fn load(load: &Load, instant: &Instant, sink: &mut impl Sink) {
    let (dynamics, pose, flow) = (instant.dynamics, instant.pose, instant.flow);
    let (chain, metres) = (&dynamics.chain, dynamics.chain.metres);
    let constant = |c: &Course| match c {
        Course::Constant(x) => *x,
        // Refused when the mechanism was made.
        Course::Table(_) => f64::NAN,
    };
    let between = |b: usize, f: usize| pose.angle(chain, b) - pose.angle(chain, f);
    let rate = |b: usize, f: usize| flow.bodies[b].turn[0] - flow.bodies[f].turn[0];
    match load {
        Load::Torque { body, from, torque } => sink.turn(*body, *from, constant(torque)),
        Load::TorsionSpring {
            body,
            from,
            stiffness,
            angle,
        } => sink.turn(*body, *from, -stiffness * (between(*body, *from) - angle)),
        Load::TorsionDamper {
            body,
            from,
            damping,
        } => sink.turn(*body, *from, -damping * rate(*body, *from)),
        Load::Force {
            at,
            components,
            along,
        } => {
            let [x, y] = components.each_ref().map(constant);
            let force = pose.e[*along] * Complex64::new(x, y);
            sink.push(spot(at, metres), force);
        }
        Load::Spring { ends, .. } | Load::Damper { ends, .. } => {
            let [p, q] = ends.map(|e| spot(&e, metres));
            let ([a, va, _], [b, vb, _]) = (flow.spot(pose, p), flow.spot(pose, q));
            let (along, apart) = (b - a, vb - va);
            let length = along.norm();
            let tension = match load {
                Load::Spring {
                    stiffness,
                    length: rest,
                    ..
                } if *rest == 0.0 => stiffness * length * metres,
                Load::Spring {
                    stiffness,
                    length: rest,
                    ..
                } => stiffness * (length * metres - rest),
                Load::Damper { damping, .. } => damping * dot(along, apart) / length * metres,
                _ => 0.0,
            };
            // A spring without length at rest may pass through zero.
            let pull = match tension == 0.0 {
                true => Complex64::ZERO,
                false => along / length * tension,
            };
            sink.push(p, pull);
            sink.push(q, -pull);
        }
    }
}

impl Dynamics {
    /// Kinetic and potential energy in J: that of weights, springs and torsion springs.
    pub(super) fn energies(&self, pose: &Pose, flow: &Motion) -> [f64; 2] {
        let metres = self.chain.metres;
        let (mut kinetic, mut potential) = (0.0, 0.0);
        for body in &self.rigid {
            let [r, v, _] = flow.spot(pose, body.centre);
            let w = flow.bodies[body.centre.body].turn[0];
            kinetic += 0.5 * (body.kg * (v * metres).norm_sqr() + body.inertia * w * w);
            potential -= body.kg * dot(self.gravity, r * metres);
        }
        for load in &self.driven {
            if let DrivenLoad::Inertia {
                body,
                from,
                inertia,
            } = load
            {
                let w = flow.bodies[*body].turn[0] - flow.bodies[*from].turn[0];
                kinetic += 0.5 * inertia * w * w;
            }
        }
        for load in &self.loads {
            potential += match load {
                Load::Spring {
                    ends,
                    stiffness,
                    length,
                } => {
                    let [a, b] = ends.map(|e| pose.at(spot(&e, metres)));
                    0.5 * stiffness * ((b - a).norm() * metres - length).powi(2)
                }
                Load::TorsionSpring {
                    body,
                    from,
                    stiffness,
                    angle,
                } => {
                    let turn = pose.angle(&self.chain, *body) - pose.angle(&self.chain, *from);
                    0.5 * stiffness * (turn - angle).powi(2)
                }
                _ => 0.0,
            };
        }
        [kinetic, potential]
    }
}
