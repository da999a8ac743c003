//! Masses and loads exactly, and the loads that follow formulas or a motor.

use super::super::bodies::Bodies;
use super::super::file::File;
use super::laws::{Laws, Names};
use crate::machine::quantity::{Dimension, Force, Quantity};
use crate::machine::run_up::Drivetrain;
use crate::machine::source::{Refusal, Source};
use crate::reference::class_iii::ExactAngle;
use crate::reference::planar::Real;
use crate::solvers::planar::dynamics::{DrivenLoad, Instant};
use crate::solvers::planar::{Description, Drive, GROUND, Point};
use crate::solvers::units::Torque;
use mechaudit_symbolic::Expr;
use rug::Rational;
use std::str::FromStr;

/// Mass, inertia and centre of a body.
#[derive(Clone, Debug)]
pub(super) struct ExactMass {
    pub body: usize,
    pub mass: Rational,
    pub inertia: Rational,
    pub centre: [Rational; 2],
}

/// A load in SI units.
#[derive(Clone, Debug)]
pub(super) enum ExactLoad {
    /// A constant force in the axes of a body or the ground.
    Force {
        at: Point,
        components: [Real; 2],
        along: usize,
    },
    /// A force by formulas.
    ForceLaw {
        at: Point,
        components: [Expr; 2],
    },
    Torque {
        body: usize,
        from: usize,
        torque: Rational,
    },
    TorqueLaw {
        body: usize,
        from: usize,
        torque: Expr,
    },
    /// A motor's torque as a formula of the time and the speed, which it calls `t` and `speed`.
    Motor {
        body: usize,
        from: usize,
        torque: String,
    },
    Inertia {
        body: usize,
        from: usize,
        inertia: String,
    },
    Spring {
        ends: [Point; 2],
        stiffness: Rational,
        length: Rational,
    },
    /// The angle is that between the bodies' lines.
    TorsionSpring {
        body: usize,
        from: usize,
        stiffness: Rational,
        angle: ExactAngle,
    },
    Damper {
        ends: [Point; 2],
        damping: Rational,
    },
    TorsionDamper {
        body: usize,
        from: usize,
        damping: Rational,
    },
}

/// Masses, loads and gravity.
#[derive(Clone, Debug)]
pub(super) struct ExactLoads {
    pub masses: Vec<ExactMass>,
    pub loads: Vec<ExactLoad>,
    pub gravity: [Real; 2],
}

/// The driven body and the one that its angle is measured from.
fn driven_bodies(
    source: &Source,
    file: &File,
    description: &Description,
) -> Result<[usize; 2], Refusal> {
    match (&file.drive, description.drive) {
        (Some(_), Drive::Angle { body, from }) => Ok([body, from]),
        _ => {
            let rule = "a motor needs drive.body, which it turns";
            Err(source.breach("motor", rule))
        }
    }
}

impl ExactLoads {
    /// Reads masses and loads, which have been read in floating point before.
    pub(super) fn read(
        source: &Source,
        file: &File,
        bodies: &Bodies,
        description: &Description,
        motor: Option<&Drivetrain>,
    ) -> Result<ExactLoads, Refusal> {
        let mut masses = Vec::new();
        for (k, body) in file.body.iter().enumerate() {
            if let (Some(mass), Some(centre)) = (&body.mass, &body.centre) {
                masses.push(ExactMass {
                    body: k + 1,
                    mass: mass.value.clone(),
                    inertia: body
                        .inertia
                        .as_ref()
                        .map(|j| j.value.clone())
                        .unwrap_or_default(),
                    centre: centre.each_ref().map(|x| x.value.clone()),
                });
            }
        }
        let standard = Rational::from((980_665, 100_000));
        let g = file.gravity.as_ref().map_or(standard, |g| g.value.clone());
        let down = ExactAngle::Degrees(Rational::from(-90));
        let direction = file
            .gravity_direction
            .as_ref()
            .map_or(down, |a| a.exact_angle());
        let mut loads = constant(source, file, bodies)?;
        if let Some(motor) = motor {
            let [body, from] = driven_bodies(source, file, description)?;
            let fault = |rule: String| source.breach("motor", rule);
            let (torque, inertia) = motor.formulas().map_err(fault)?;
            loads.push(ExactLoad::Motor { body, from, torque });
            if inertia != "0" {
                loads.push(ExactLoad::Inertia {
                    body,
                    from,
                    inertia,
                });
            }
        }
        Ok(ExactLoads {
            masses,
            loads,
            gravity: Real::unit(&direction).map(|x| x * &g),
        })
    }

    /// The loads by formulas for the solver, which are added to the exact ones too.
    pub(super) fn driven(
        &self,
        source: &Source,
        file: &File,
        description: &Description,
        names: &Names,
        motor: Option<Drivetrain>,
    ) -> Result<Vec<DrivenLoad>, Refusal> {
        let mut all = Vec::new();
        for load in &self.loads {
            match load {
                ExactLoad::TorqueLaw { body, from, torque } => all.push(DrivenLoad::Torque {
                    body: *body,
                    from: *from,
                    torque: names.law(torque),
                }),
                ExactLoad::ForceLaw { at, components } => all.push(DrivenLoad::Force {
                    at: *at,
                    components: components.each_ref().map(|c| names.law(c)),
                }),
                _ => {}
            }
        }
        if let Some(motor) = motor {
            let [body, from] = driven_bodies(source, file, description)?;
            let drive = motor.drive;
            if drive.inertia() > 0.0 {
                all.push(DrivenLoad::Inertia {
                    body,
                    from,
                    inertia: drive.inertia(),
                });
            }
            let torque = move |instant: &Instant| {
                let speed = instant.angle(body)[1] - instant.angle(from)[1];
                let motor = drive.motor_torque_at(instant.time, speed);
                let resisting = drive.resisting_torque(speed, speed.signum()).0;
                motor.map_or(f64::NAN, |m| m.0 + resisting)
            };
            all.push(DrivenLoad::Torque {
                body,
                from,
                torque: Box::new(torque),
            });
        }
        Ok(all)
    }

    /// Adds the loads of `[[motion.torque]]` and `[[motion.force]]`.
    pub(super) fn add_laws(
        &mut self,
        source: &Source,
        file: &File,
        bodies: &Bodies,
        laws: Laws,
    ) -> Result<(), Refusal> {
        let Some(motion) = &file.motion else {
            return Ok(());
        };
        for (k, (section, torque)) in motion.torque.iter().zip(laws.torques).enumerate() {
            let at = |key: &str| format!("motion.torque[{k}].{key}");
            self.loads.push(ExactLoad::TorqueLaw {
                body: bodies.find(source, &at("body"), &section.body)?,
                from: match &section.from {
                    Some(name) => bodies.find(source, &at("from"), name)?,
                    None => GROUND,
                },
                torque,
            });
        }
        for (k, (section, components)) in motion.force.iter().zip(laws.forces).enumerate() {
            let at = format!("motion.force[{k}].at");
            self.loads.push(ExactLoad::ForceLaw {
                at: bodies.point(source, &at, &section.at)?,
                components,
            });
        }
        Ok(())
    }
}

/// The value of a load without a table.
fn value<D: Dimension>(
    source: &Source,
    at: &str,
    text: &Option<String>,
) -> Result<Rational, Refusal> {
    let Some(text) = text else {
        let rule = format!(
            "{at}: a table over the drive has no meaning in a motion; write a formula in motion.force or motion.torque"
        );
        return Err(source.breach(at, rule));
    };
    match Quantity::<D>::from_str(text) {
        Ok(q) => Ok(q.value),
        Err(e) => Err(source.breach(at, format!("{at}.value = {e}"))),
    }
}

/// Constant forces and torques, springs and dampers.
fn constant(source: &Source, file: &File, bodies: &Bodies) -> Result<Vec<ExactLoad>, Refusal> {
    let from = |at: &str, name: &Option<String>| match name {
        Some(name) => bodies.find(source, &format!("{at}.from"), name),
        None => Ok(GROUND),
    };
    let body = |at: &str, name: &str| bodies.find(source, &format!("{at}.body"), name);
    let ends = |at: &str, [a, b]: &[String; 2]| -> Result<_, Refusal> {
        let place = format!("{at}.ends");
        Ok([
            bodies.point(source, &place, a)?,
            bodies.point(source, &place, b)?,
        ])
    };
    let mut all = Vec::new();
    for (k, f) in file.force.iter().enumerate() {
        let at = format!("force[{k}]");
        let size = value::<Force>(source, &at, &f.value)?;
        all.push(ExactLoad::Force {
            at: bodies.point(source, &format!("{at}.at"), &f.at)?,
            components: Real::unit(&f.direction.exact_angle()).map(|x| x * &size),
            along: match &f.with {
                Some(name) => bodies.find(source, &format!("{at}.with"), name)?,
                None => GROUND,
            },
        });
    }
    for (k, t) in file.torque.iter().enumerate() {
        let at = format!("torque[{k}]");
        all.push(ExactLoad::Torque {
            body: body(&at, &t.body)?,
            from: from(&at, &t.from)?,
            torque: value::<Torque>(source, &at, &t.value)?,
        });
    }
    for (k, s) in file.spring.iter().enumerate() {
        all.push(ExactLoad::Spring {
            ends: ends(&format!("spring[{k}]"), &s.ends)?,
            stiffness: s.stiffness.value.clone(),
            length: s.length.value.clone(),
        });
    }
    for (k, s) in file.torsion_spring.iter().enumerate() {
        let at = format!("torsion_spring[{k}]");
        all.push(ExactLoad::TorsionSpring {
            body: body(&at, &s.body)?,
            from: from(&at, &s.from)?,
            stiffness: s.stiffness.value.clone(),
            angle: s.angle.exact_angle(),
        });
    }
    for (k, d) in file.damper.iter().enumerate() {
        all.push(ExactLoad::Damper {
            ends: ends(&format!("damper[{k}]"), &d.ends)?,
            damping: d.damping.value.clone(),
        });
    }
    for (k, d) in file.torsion_damper.iter().enumerate() {
        let at = format!("torsion_damper[{k}]");
        all.push(ExactLoad::TorsionDamper {
            body: body(&at, &d.body)?,
            from: from(&at, &d.from)?,
            damping: d.damping.value.clone(),
        });
    }
    Ok(all)
}
