//! Generalised forces of loads as formulas.

use super::super::loads::{ExactLoad, Size};
use super::MovingError;
use super::equations::Writer;
use super::laws::INNER;
use super::loads::MovingLoad;
use super::places::Position;
use super::text::{Vector, add, angle, dot, mul, rational, sub, sum};
use crate::reference::planar::Real;
use crate::solvers::planar::Point;
use mechaudit_symbolic::Expr;
use rug::Rational;

impl Writer<'_> {
    /// Adds what a load does.
    pub(super) fn load(
        &mut self,
        load: &MovingLoad,
        position: &Position,
        acts: &mut impl Acts,
    ) -> Result<(), MovingError> {
        match load {
            MovingLoad::Constant(load) => self.constant(load, position, acts)?,
            MovingLoad::TorqueLaw { body, from, torque } => {
                let torque = self.law(torque);
                acts.turn(self, *body, *from, torque);
            }
            MovingLoad::ForceLaw { at, components } => {
                let force = components.each_ref().map(|c| self.law(c));
                acts.push(self, at, position, &force)?;
            }
            MovingLoad::Motor {
                body,
                from,
                formulas,
            } => {
                let speed = self.turning(*body, *from);
                let mut torque = formulas.torque.replace("speed", &speed);
                if let Some(size) = &formulas.friction {
                    torque += &format!(" - copysign({size}, {speed})");
                }
                let torque = format!("({torque})");
                let torque = self.define(torque);
                acts.turn(self, *body, *from, torque);
                if formulas.inertia != "0" {
                    acts.rotor(self, *body, *from, &formulas.inertia);
                }
            }
        }
        Ok(())
    }

    /// The difference of two bodies' angular velocities.
    pub(super) fn turning(&mut self, body: usize, from: usize) -> String {
        let rates: Vec<String> = self.q.iter().map(|q| q[1].clone()).collect();
        let turn = self.turn(body, from);
        self.define(sum(turn.iter().zip(&rates).map(|(k, r)| mul(k, r))))
    }

    fn constant(
        &mut self,
        load: &ExactLoad,
        position: &Position,
        acts: &mut impl Acts,
    ) -> Result<(), MovingError> {
        // Tables are refused where the file is read.
        let size = |size: &Size| match size {
            Size::Constant(q) => q.clone(),
            Size::Table(_) => Rational::new(),
        };
        match load {
            ExactLoad::Torque { body, from, torque } => {
                acts.turn(self, *body, *from, rational(&size(torque)));
            }
            ExactLoad::TorsionDamper {
                body,
                from,
                damping,
            } => {
                let speed = self.turning(*body, *from);
                let torque = self.define(sub("0", &mul(&rational(damping), &speed)));
                acts.turn(self, *body, *from, torque);
            }
            ExactLoad::TorsionSpring {
                body,
                from,
                stiffness,
                angle: rest,
            } => {
                let lines = sub(&self.line(*body), &self.line(*from));
                let turn = sub(&add(&self.between(*body, *from), &lines), &angle(rest));
                let torque = self.define(sub("0", &mul(&rational(stiffness), &turn)));
                acts.turn(self, *body, *from, torque);
            }
            ExactLoad::Force {
                at,
                size: of,
                direction,
                along,
            } => {
                let force = Real::unit(direction).map(|x| x * &size(of));
                let force = self.turned(position, &force, along.checked_sub(1));
                acts.push(self, at, position, &force)?;
            }
            ExactLoad::Spring { ends, .. } | ExactLoad::Damper { ends, .. } => {
                let [a, b] = [self.attached(&ends[0])?, self.attached(&ends[1])?];
                let (p, q) = (self.point(position, &a), self.point(position, &b));
                let along = self.define_pair([0, 1].map(|c| sub(&q[c], &p[c])));
                let square = self.define(dot(&along, &along));
                // Tension over length.
                let tension = match load {
                    ExactLoad::Spring {
                        stiffness, length, ..
                    } if length.is_zero() => rational(stiffness),
                    ExactLoad::Spring {
                        stiffness, length, ..
                    } => {
                        format!(
                            "{}*(1 - {}/sqrt({square}))",
                            rational(stiffness),
                            rational(length)
                        )
                    }
                    ExactLoad::Damper { damping, .. } => {
                        let rates: Vec<String> = self.q.iter().map(|q| q[1].clone()).collect();
                        let [u, v] = [&a, &b].map(|form| {
                            let gradient = self.gradient(position, form);
                            self.velocity(&gradient, &rates)
                        });
                        let apart = dot(&along, &[0, 1].map(|c| sub(&v[c], &u[c])));
                        format!("{}*({apart})/{square}", rational(damping))
                    }
                    _ => "0".into(),
                };
                let tension = self.define(format!("({tension})"));
                let pull = self.define_pair(along.each_ref().map(|x| mul(&tension, x)));
                let back = pull.each_ref().map(|x| sub("0", x));
                acts.push(self, &ends[0], position, &pull)?;
                acts.push(self, &ends[1], position, &back)?;
            }
        }
        Ok(())
    }

    /// The name of a formula of the file.
    pub(super) fn law(&mut self, formula: &Expr) -> String {
        let name = format!("{INNER}law_{}", self.out.given.len());
        self.out.given.push((name.clone(), formula.clone()));
        name
    }
}

/// A receiver of the forces and torques of loads, as formulas.
pub(super) trait Acts {
    /// A force at a point.
    fn push(
        &mut self,
        writer: &mut Writer,
        at: &Point,
        position: &Position,
        force: &Vector,
    ) -> Result<(), MovingError>;
    /// A torque on a body, and its reaction on another.
    fn turn(&mut self, writer: &mut Writer, body: usize, from: usize, torque: String);
    /// An inertia that turns with the difference of two angles.
    fn rotor(&mut self, writer: &mut Writer, body: usize, from: usize, inertia: &str);
}

/// The masses of coordinates and the forces on them.
pub(super) struct Generalised {
    /// The lower half.
    pub mass: Vec<Vec<Vec<String>>>,
    pub force: Vec<Vec<String>>,
}

impl Acts for Generalised {
    fn push(
        &mut self,
        writer: &mut Writer,
        at: &Point,
        position: &Position,
        force: &Vector,
    ) -> Result<(), MovingError> {
        let form = writer.attached(at)?;
        let gradient = writer.gradient(position, &form);
        for (f, g) in self.force.iter_mut().zip(gradient) {
            if let Some(g) = g {
                f.push(dot(force, &g));
            }
        }
        Ok(())
    }

    fn turn(&mut self, writer: &mut Writer, body: usize, from: usize, torque: String) {
        for (f, k) in self.force.iter_mut().zip(writer.turn(body, from)) {
            f.push(mul(&k, &torque));
        }
    }

    fn rotor(&mut self, writer: &mut Writer, body: usize, from: usize, inertia: &str) {
        let turn = writer.turn(body, from);
        for j in 0..turn.len() {
            for k in 0..=j {
                self.mass[j][k].push(mul(inertia, &mul(&turn[j], &turn[k])));
            }
        }
    }
}
