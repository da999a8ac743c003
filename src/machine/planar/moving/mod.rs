//! A mechanism that moves by itself: the section `[motion]`, with any number of degrees of freedom.
//!
//! One file is read for both sides: for the solver in `f64`, and exactly for the equations of motion
//! whose solution is enclosed ([`Certified`]).

mod begin;
mod certified;
mod elimination;
mod equations;
mod laws;
mod linear;
mod loads;
mod places;
mod pushes;
mod start;
mod study;
mod text;

pub use certified::Certified;

use super::bodies::Bodies;
use super::exact::{self, Exact, ExactJoint};
use super::file::File;
use super::joints;
use crate::machine::run_up;
use crate::machine::source::{Refusal, Source};
use crate::reference::planar::Place;
use crate::solvers::planar::dynamics::{Dynamics, DynamicsError, Law, Moment, Settings};
use crate::solvers::planar::{Description, Joint, Point};
use laws::Names;
use loads::ExactLoads;
use start::Start;

/// A mechanism that moves by itself.
pub struct Moving {
    /// Its name, if it has one.
    pub name: Option<String>,
    /// Bodies, masses and loads in floating point.
    pub dynamics: Dynamics,
    /// Names of all bodies, the ground first.
    bodies: Vec<String>,
    description: Description,
    points: Vec<Vec<(Point, Option<Place>)>>,
    joints: Vec<Option<ExactJoint>>,
    /// For each body the angle, in its frame, of the line that its angle is that of; radians.
    lines: Vec<f64>,
    loads: ExactLoads,
    names: Names,
    start: Start,
    until: Option<Law>,
}

/// Why a mechanism has no motion.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MovingError {
    /// The solver gives up.
    #[error(transparent)]
    Dynamics(#[from] DynamicsError),
    /// Several positions fit the start.
    #[error("which position? {listed}; write motion.near with the angles of some bodies")]
    Ambiguous {
        /// The positions found.
        listed: String,
    },
    /// None is near.
    #[error("no position at the start has its bodies within 15 deg of motion.near; {listed}")]
    NotNear {
        /// The positions found.
        listed: String,
    },
    /// There is no exact description.
    #[error("no certified motion: {0}")]
    NotExact(String),
}

/// A quantity of a motion.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MovingQuantity {
    /// Its name, as formulas use it.
    pub name: String,
    /// Its unit.
    pub unit: &'static str,
    /// Describes the quantity in words.
    pub text: String,
}

impl Moving {
    /// Reads the description of a mechanism with its motion. Without `[motion.start]` the drive's
    /// coordinate begins at `start.at` with `start.speed`.
    ///
    /// # Errors
    /// [`Refusal`].
    pub fn read(source: &Source) -> Result<Moving, Refusal> {
        let file: File = source.parse()?;
        let bodies = Bodies::new(source, &file)?;
        let (description, joint_names) = joints::read(source, &file, &bodies)?;
        let names = Names::new(source, &file, &bodies, &description)?;
        let motor = run_up::drivetrain(source)?;
        let mut loads = ExactLoads::read(source, &file, &bodies, &description, motor.as_ref())?;
        loads.add_laws(source, &file, &bodies, names.laws(source, &file)?)?;
        let (masses, constant, gravity) = super::loads::parts(source, &file, &bodies)?;
        if masses.is_empty() {
            let rule = "no body has a mass: a motion needs mass, inertia and centre of the bodies that move";
            return Err(source.breach("body", rule));
        }
        let driven = loads.driven(source, &file, &description, &names, motor)?;
        let until = match file.motion.as_ref().and_then(|m| m.until.as_ref()) {
            Some(text) => Some(names.law(&names.formula(source, "motion.until", text)?)),
            None => None,
        };
        let dynamics = Dynamics::new(description.clone(), masses, constant, driven, gravity);
        let dynamics = dynamics.map_err(|e| source.refuse("joint", e))?;
        let start = Start::read(source, &file, &bodies, &description, &joint_names)?;
        if dynamics.freedoms() != start.given.len() as i64 {
            let rule = DynamicsError::Freedoms {
                freedoms: dynamics.freedoms(),
                given: start.given.len(),
            };
            let rule = format!("{rule}; motion.start names bodies or slides with at and speed");
            return Err(source.breach("motion", rule));
        }
        Ok(Moving {
            joints: exact::joints(&file.joint, &bodies),
            points: bodies.exact(),
            lines: bodies.lines.clone(),
            bodies: bodies.names,
            name: file.name,
            dynamics,
            description,
            loads,
            names,
            start,
            until,
        })
    }

    fn exactly(&self) -> Exact<'_> {
        Exact {
            description: &self.description,
            points: &self.points,
            joints: &self.joints,
        }
    }

    /// Slides and slots with the numbers of their joints.
    fn travels(&self) -> Vec<(usize, &str)> {
        travels(&self.description)
    }

    /// The quantities of each row: angles of the bodies' lines and their rates, displacements of
    /// slides and slots and theirs.
    pub fn quantities(&self) -> Vec<MovingQuantity> {
        let mut all = Vec::new();
        for (body, name) in self.bodies.iter().enumerate().skip(1) {
            let [angle, rate] = self.names.of_body(body);
            all.push(quantity(angle, "rad", format!("angle of {name}")));
            all.push(quantity(
                rate,
                "rad/s",
                format!("angular velocity of {name}"),
            ));
        }
        for (joint, name) in self.travels() {
            let [place, rate] = self.names.of_joint(joint);
            all.push(quantity(place, "m", format!("displacement of {name}")));
            all.push(quantity(rate, "m/s", format!("speed of {name}")));
        }
        all
    }

    /// The values of [`Moving::quantities`] at a moment.
    pub fn values(&self, moment: &Moment) -> Vec<f64> {
        let mut all = Vec::new();
        for body in 1..self.bodies.len() {
            let [angle, rate, _] = self.dynamics.angle(moment, body);
            all.extend([angle + self.lines[body], rate]);
        }
        for (joint, _) in self.travels() {
            all.extend(self.dynamics.displacement(moment, joint));
        }
        all
    }

    /// The motion in `f64`: calls `visit` at each of the times, in seconds and ascending from 0, until
    /// `motion.until` changes its sign, which is visited last and whose time is returned.
    ///
    /// # Errors
    /// [`MovingError`].
    pub fn run(
        &self,
        times: &[f64],
        settings: Settings,
        mut visit: impl FnMut(&Moment),
    ) -> Result<Option<f64>, MovingError> {
        let start = self.assembly()?;
        let until = self.until.as_ref();
        let ended = self
            .dynamics
            .motion_until(&start, times, settings, until, |m| {
                visit(m);
                true
            });
        Ok(ended?)
    }
}

fn quantity(name: &str, unit: &'static str, text: String) -> MovingQuantity {
    MovingQuantity {
        name: name.into(),
        unit,
        text,
    }
}

fn travels(description: &Description) -> Vec<(usize, &str)> {
    let joints = description.joints.iter().enumerate();
    let guided = joints.filter(|(_, j)| matches!(j.part, Joint::Slide { .. } | Joint::Slot { .. }));
    guided.map(|(k, j)| (k, &*j.name)).collect()
}

#[cfg(test)]
mod tests;
