//! A mechanism that moves by itself: the section `[motion]`, with any number of degrees of freedom.
//!
//! One file is read for both sides: for the solver in `f64`, and exactly for the equations of
//! motion whose solution is enclosed ([`Certified`]).

mod begin;
mod certified;
mod elimination;
mod equations;
mod laws;
mod linear;
mod loads;
mod places;
mod pushes;
mod reactions;
mod start;
mod study;
mod text;

pub use certified::{Certified, CertifiedMoment};

use super::bodies::Bodies;
use super::exact::{self, Exact, ExactJoint};
use super::file::File;
use super::linkages::{Parts, of_class_iii, of_dyad};
use super::loads::masses;
use super::{joints, rows};
use crate::machine::linkage::Linkage;
use crate::machine::run_up;
use crate::machine::source::{Refusal, Source};
use crate::reference::planar::Place;
use crate::solvers::planar::dynamics::{Dynamics, DynamicsError, Law, Moment, Settings};
use crate::solvers::planar::{Description, Joint, Point, ReactionError};
use laws::Names;
use loads::MovingLoads;
use mechaudit_symbolic::Expr;
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
    loads: MovingLoads,
    names: Names,
    start: Start,
    /// The formula whose change of sign ends the motion, also in floating point.
    until: Option<(Expr, Law)>,
    /// True if a resistance may hold the driven body at rest.
    holds: bool,
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
    /// Forces in joints are not known.
    #[error(transparent)]
    Forces(#[from] ReactionError),
    /// A resistance may hold a body at rest.
    #[error(
        "load.constant may hold the driven body at rest, which a motion in floating point does not know: \
         see `mechaudit runup`, or certified digits"
    )]
    Holds,
    /// There is no exact description.
    #[error("no certified motion: {0}")]
    NotExact(String),
}

/// Which quantities a row has.
#[derive(Clone, Debug)]
pub enum Row {
    /// Angles and displacements with their rates.
    Motion {
        /// True for the forces in the joints too.
        reactions: bool,
    },
    /// The angle of the drive in degrees, its speed and acceleration.
    RunUp {
        /// The speed that ends the motion, a formula in rad/s.
        target: Option<String>,
    },
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
    /// Reads the description of a mechanism of any type with its motion. Without `[motion.start]`
    /// the drive's coordinate begins at the file's start with `start.speed`.
    ///
    /// # Errors
    /// [`Refusal`].
    pub fn read(source: &Source) -> Result<Moving, Refusal> {
        let (parts, start) = parts(source)?;
        let Parts {
            file,
            bodies,
            masses,
        } = parts;
        let (description, joint_names) = joints::read(source, &file, &bodies)?;
        let names = Names::new(source, &file, &bodies, &description)?;
        let motor = run_up::drivetrain(source)?;
        let motor = motor.as_ref();
        if masses.is_empty() {
            let rule = "no body has a mass: a motion needs mass, inertia and centre of the bodies that move";
            return Err(source.breach("body", rule));
        }
        let parts = (&file, &bodies, &description);
        let loads = MovingLoads::read(source, parts, &names, masses, motor)?;
        let (constant, driven) = loads.rounded(&names, &bodies.lines, motor);
        let until = match file.motion.as_ref().and_then(|m| m.until.as_ref()) {
            Some(text) => {
                let formula = names.formula(source, "motion.until", text)?;
                let law = names.law(&formula);
                Some((formula, law))
            }
            None => None,
        };
        let (masses, gravity) = (loads.masses.iter(), loads.gravity.rounded());
        let masses = masses.map(|m| m.rounded()).collect();
        let dynamics = Dynamics::new(description.clone(), masses, constant, driven, gravity);
        let dynamics = dynamics.map_err(|e| source.refuse("joint", e))?;
        let start = match start {
            Some(start) => start,
            None => Start::read(source, &file, &bodies, &description, &joint_names)?,
        };
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
            holds: motor.is_some_and(|m| m.holds()),
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
    /// slides and slots and theirs, and the forces in the joints, in the ground's axes on the
    /// bodies that are named.
    ///
    /// # Errors
    /// [`MovingError`] for forces in gears and racks.
    pub fn quantities(&self, reactions: bool) -> Result<Vec<MovingQuantity>, MovingError> {
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
        if reactions {
            for (joint, body, moment) in forces(&self.description)? {
                let [joint, body] = [&self.description.joints[joint].name, &self.bodies[body]];
                for c in ["x", "y"] {
                    let name = format!("F{c}_{joint}_{body}");
                    let text = format!("force of {joint} on {body} along {c}");
                    all.push(quantity(&name, "N", text));
                }
                if moment {
                    let text = format!("moment of {joint} on {body}");
                    all.push(quantity(&format!("M_{joint}_{body}"), "N m", text));
                }
            }
        }
        Ok(all)
    }

    /// The values of [`Moving::quantities`] at a moment; NaN for forces that are not determined.
    pub fn values(&self, moment: &Moment, reactions: bool) -> Vec<f64> {
        let mut all = Vec::new();
        for body in 1..self.bodies.len() {
            let [angle, rate, _] = self.dynamics.angle(moment, body);
            all.extend([angle + self.lines[body], rate]);
        }
        for (joint, _) in self.travels() {
            all.extend(self.dynamics.displacement(moment, joint));
        }
        if reactions {
            let found = self.dynamics.reactions(moment).unwrap_or_default();
            for (joint, body, moment) in forces(&self.description).unwrap_or_default() {
                let force = found.iter().find(|f| (f.joint, f.body) == (joint, body));
                all.extend(force.map_or([f64::NAN; 2], |f| f.force_n));
                if moment {
                    all.push(force.map_or(f64::NAN, |f| f.moment_n_m));
                }
            }
        }
        all
    }

    /// The motion in `f64`: calls `visit` at each of the times, in seconds and ascending from 0,
    /// until `motion.until` changes its sign, which is visited last and whose time is returned.
    ///
    /// # Errors
    /// [`MovingError`].
    pub fn run(
        &self,
        times: &[f64],
        settings: Settings,
        mut visit: impl FnMut(&Moment),
    ) -> Result<Option<f64>, MovingError> {
        if self.holds {
            return Err(MovingError::Holds);
        }
        let start = self.assembly()?;
        let until = self.until.as_ref().map(|u| &u.1);
        let ended = self
            .dynamics
            .motion_until(&start, times, settings, until, |m| {
                visit(m);
                true
            });
        Ok(ended?)
    }
}

/// The parts of the mechanism of any type that a file describes, and where it begins if its
/// sections do not say it as those of a mechanism of bodies do.
fn parts(source: &Source) -> Result<(Parts, Option<Start>), Refusal> {
    if Linkage::is_planar(source)? {
        let file: File = source.parse()?;
        let bodies = Bodies::new(source, &file)?;
        let masses = masses(source, &file)?;
        let parts = Parts {
            file,
            bodies,
            masses,
        };
        return Ok((parts, None));
    }
    let (parts, start) = match Linkage::read(source)? {
        Linkage::ClassIii(linkage) => (
            of_class_iii(&linkage),
            Start::of_class_iii(source, &linkage)?,
        ),
        Linkage::Dyad(dyad) => (of_dyad(&dyad), Start::of_dyad(source, &dyad)?),
        Linkage::Planar(_) => unreachable!("a mechanism of bodies is read above"),
    };
    let parts = parts.map_err(|e| source.refuse("bodies", e))?;
    Ok((parts, Some(start)))
}

/// Joints with the bodies that their forces act on, and true for those that have a moment.
fn forces(description: &Description) -> Result<Vec<(usize, usize, bool)>, MovingError> {
    let teeth = |j: &Joint| matches!(j, Joint::Gears { .. } | Joint::Rack { .. });
    match description.joints.iter().find(|j| teeth(&j.part)) {
        None => Ok(rows::forces(description)),
        Some(joint) => Err(MovingError::Forces(ReactionError::Teeth {
            joint: joint.name.clone(),
        })),
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
