//! Generalised forces of loads as formulas.

use super::MovingError;
use super::equations::Writer;
use super::laws::INNER;
use super::loads::ExactLoad;
use super::places::Position;
use super::text::{Vector, add, angle, dot, mul, rational, sub, sum};
use crate::solvers::planar::Point;
use mechaudit_symbolic::Expr;

impl Writer<'_> {
    /// Adds a load's generalised forces.
    pub(super) fn load(
        &mut self,
        load: &ExactLoad,
        position: &Position,
        rates: &[String],
        (mass, force): (&mut [Vec<Vec<String>>], &mut [Vec<String>]),
    ) -> Result<(), MovingError> {
        let torque = |w: &mut Self, force: &mut [Vec<String>], body, from, torque: String| {
            let torque = w.define(torque);
            for (f, k) in force.iter_mut().zip(w.turn(body, from)) {
                f.push(mul(&k, &torque));
            }
        };
        let speed = |w: &Self, body, from| {
            sum(w.turn(body, from).iter().zip(rates).map(|(k, r)| mul(k, r)))
        };
        match load {
            ExactLoad::Torque {
                body,
                from,
                torque: t,
            } => {
                torque(self, force, *body, *from, rational(t));
            }
            ExactLoad::TorqueLaw {
                body,
                from,
                torque: t,
            } => {
                let name = self.law(t);
                torque(self, force, *body, *from, name);
            }
            ExactLoad::Motor {
                body,
                from,
                torque: t,
            } => {
                let speed = speed(self, *body, *from);
                let speed = self.define(speed);
                torque(
                    self,
                    force,
                    *body,
                    *from,
                    format!("({})", t.replace("speed", &speed)),
                );
            }
            ExactLoad::TorsionDamper {
                body,
                from,
                damping,
            } => {
                let speed = speed(self, *body, *from);
                torque(
                    self,
                    force,
                    *body,
                    *from,
                    sub("0", &mul(&rational(damping), &speed)),
                );
            }
            ExactLoad::TorsionSpring {
                body,
                from,
                stiffness,
                angle: rest,
            } => {
                let lines = sub(&self.line(*body), &self.line(*from));
                let turn = sub(&add(&self.between(*body, *from), &lines), &angle(rest));
                torque(
                    self,
                    force,
                    *body,
                    *from,
                    sub("0", &mul(&rational(stiffness), &turn)),
                );
            }
            ExactLoad::Inertia {
                body,
                from,
                inertia,
            } => {
                let turn = self.turn(*body, *from);
                for j in 0..turn.len() {
                    for k in 0..=j {
                        mass[j][k].push(mul(inertia, &mul(&turn[j], &turn[k])));
                    }
                }
            }
            ExactLoad::Force {
                at,
                components,
                along,
            } => {
                let v = self.turned(position, components, along.checked_sub(1));
                self.push(at, position, &v, force)?;
            }
            ExactLoad::ForceLaw { at, components } => {
                let v = components.each_ref().map(|c| self.law(c));
                self.push(at, position, &v, force)?;
            }
            ExactLoad::Spring { ends, .. } | ExactLoad::Damper { ends, .. } => {
                let [a, b] = [self.attached(&ends[0])?, self.attached(&ends[1])?];
                let (p, q) = (self.point(position, &a), self.point(position, &b));
                let (ga, gb) = (self.gradient(position, &a), self.gradient(position, &b));
                let along = self.define_pair([0, 1].map(|c| sub(&q[c], &p[c])));
                let none = || ["0".to_string(), "0".to_string()];
                let mut apart = Vec::new();
                for (a, b) in ga.into_iter().zip(gb) {
                    let (a, b) = (a.unwrap_or_else(none), b.unwrap_or_else(none));
                    let d = [0, 1].map(|c| sub(&b[c], &a[c]));
                    apart.push(self.define(dot(&along, &d)));
                }
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
                        let rate = sum(apart.iter().zip(rates).map(|(d, r)| mul(d, r)));
                        format!("{}*({rate})/{square}", rational(damping))
                    }
                    _ => "0".into(),
                };
                let tension = self.define(format!("({tension})"));
                for (f, d) in force.iter_mut().zip(apart) {
                    f.push(sub("0", &mul(&tension, &d)));
                }
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

    pub(super) fn push(
        &mut self,
        at: &Point,
        position: &Position,
        v: &Vector,
        force: &mut [Vec<String>],
    ) -> Result<(), MovingError> {
        let form = self.attached(at)?;
        let gradient = self.gradient(position, &form);
        for (f, g) in force.iter_mut().zip(gradient) {
            if let Some(g) = g {
                f.push(dot(v, &g));
            }
        }
        Ok(())
    }
}
