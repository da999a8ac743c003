//! Masses and loads exactly, and the loads that follow formulas or a motor.

use super::super::bodies::Bodies;
use super::super::file::File;
use super::super::loads::{Courses, ExactLoad, ExactMass, Gravity, loads};
use super::laws::Names;
use crate::machine::run_up::{Drivetrain, Formulas};
use crate::machine::source::{Refusal, Source};
use crate::solvers::planar::dynamics::{DrivenLoad, Instant, Law};
use crate::solvers::planar::{self, Description, GROUND, Load, Point};
use crate::solvers::run_up::Drive;
use mechaudit_symbolic::Expr;

/// A load of a motion.
#[derive(Clone, Debug)]
pub(super) enum MovingLoad {
    Constant(ExactLoad),
    ForceLaw {
        at: Point,
        components: [Expr; 2],
    },
    TorqueLaw {
        body: usize,
        from: usize,
        torque: Expr,
    },
    /// A motor with its resistance and the inertia that turns with it.
    Motor {
        body: usize,
        from: usize,
        formulas: Formulas,
    },
}

/// Masses, loads and gravity.
#[derive(Clone, Debug)]
pub(super) struct MovingLoads {
    pub masses: Vec<ExactMass>,
    pub loads: Vec<MovingLoad>,
    pub gravity: Gravity,
}

/// The driven body and the one that its angle is measured from.
fn driven_bodies(
    source: &Source,
    file: &File,
    description: &Description,
) -> Result<[usize; 2], Refusal> {
    match (&file.drive, description.drive) {
        (Some(_), planar::Drive::Angle { body, from }) => Ok([body, from]),
        _ => {
            let rule = "a motor needs drive.body, which it turns";
            Err(source.breach("motor", rule))
        }
    }
}

impl MovingLoads {
    /// Reads the loads.
    pub(super) fn read(
        source: &Source,
        (file, bodies, description): (&File, &Bodies, &Description),
        names: &Names,
        masses: Vec<ExactMass>,
        motor: Option<&Drivetrain>,
    ) -> Result<MovingLoads, Refusal> {
        let forces = file.force.iter().map(|f| ("force", &f.table));
        let torques = file.torque.iter().map(|t| ("torque", &t.table));
        for (k, (key, table)) in forces.enumerate().chain(torques.enumerate()) {
            if table.is_some() {
                let at = format!("{key}[{k}]");
                let rule = format!(
                    "{at}: a table over the drive has no meaning in a motion; write a formula in motion.force or motion.torque"
                );
                return Err(source.breach(&at, rule));
            }
        }
        let courses = Courses {
            rotary: false,
            offset: 0.0,
        };
        let constant = loads(source, file, bodies, &courses)?.into_iter();
        let mut loads: Vec<MovingLoad> = constant.map(MovingLoad::Constant).collect();
        let laws = names.laws(source, file)?;
        let motion = file.motion.as_ref();
        let torques = motion.into_iter().flat_map(|m| &m.torque);
        for (k, (section, torque)) in torques.zip(laws.torques).enumerate() {
            let at = |key: &str| format!("motion.torque[{k}].{key}");
            loads.push(MovingLoad::TorqueLaw {
                body: bodies.find(source, &at("body"), &section.body)?,
                from: match &section.from {
                    Some(name) => bodies.find(source, &at("from"), name)?,
                    None => GROUND,
                },
                torque,
            });
        }
        let forces = motion.into_iter().flat_map(|m| &m.force);
        for (k, (section, components)) in forces.zip(laws.forces).enumerate() {
            let at = format!("motion.force[{k}].at");
            loads.push(MovingLoad::ForceLaw {
                at: bodies.point(source, &at, &section.at)?,
                components,
            });
        }
        if let Some(motor) = motor {
            let [body, from] = driven_bodies(source, file, description)?;
            loads.push(MovingLoad::Motor {
                body,
                from,
                formulas: motor.formulas(),
            });
        }
        Ok(MovingLoads {
            masses,
            loads,
            gravity: Gravity::of(file),
        })
    }

    /// The loads of the solver: constant ones, and those that follow formulas or the motor.
    pub(super) fn rounded(
        &self,
        names: &Names,
        lines: &[f64],
        motor: Option<&Drivetrain>,
    ) -> (Vec<Load>, Vec<DrivenLoad>) {
        let (mut constant, mut driven) = (Vec::new(), Vec::new());
        for load in &self.loads {
            match load {
                MovingLoad::Constant(load) => constant.push(load.rounded(lines)),
                MovingLoad::TorqueLaw { body, from, torque } => driven.push(DrivenLoad::Torque {
                    body: *body,
                    from: *from,
                    torque: names.law(torque),
                }),
                MovingLoad::ForceLaw { at, components } => driven.push(DrivenLoad::Force {
                    at: *at,
                    components: components.each_ref().map(|c| names.law(c)),
                }),
                MovingLoad::Motor { body, from, .. } => {
                    let motor = motor.map(|m| m.drive.clone());
                    driven.extend(
                        motor
                            .into_iter()
                            .flat_map(|drive| turned(*body, *from, drive)),
                    );
                }
            }
        }
        (constant, driven)
    }
}

/// Returns the loads of a motor: its inertia, and its torque less the resistance.
fn turned(body: usize, from: usize, drive: Drive) -> Vec<DrivenLoad> {
    let inertia = drive.inertia();
    let torque = move |instant: &Instant| {
        let speed = instant.angle(body)[1] - instant.angle(from)[1];
        let motor = drive.motor_torque_at(instant.time, speed);
        let resisting = drive.resisting_torque(speed, speed.signum()).0;
        motor.map_or(f64::NAN, |m| m.0 + resisting)
    };
    let torque: Law = Box::new(torque);
    let mut all = vec![DrivenLoad::Torque { body, from, torque }];
    if inertia > 0.0 {
        let rotor = DrivenLoad::Inertia {
            body,
            from,
            inertia,
        };
        all.insert(0, rotor);
    }
    all
}
