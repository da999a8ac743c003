//! Where a motion begins.

use super::super::Machine;
use super::super::bodies::Bodies;
use super::super::branch::wrapped;
use super::super::exact::radians;
use super::super::file::{Coordinate as Section, File};
use super::super::joints::exactly;
use super::{Moving, MovingError, travels};
use crate::machine::class_iii;
use crate::machine::dyad::{Dyad, Shape};
use crate::machine::quantity::{Quantity, Velocity};
use crate::machine::run_up::start_speed;
use crate::machine::source::{Refusal, Source};
use crate::reference::class_iii::ExactAngle;
use crate::solvers::planar::dynamics::{Assembly, Coordinate, Given};
use crate::solvers::planar::{Description, Drive, GROUND, State};
use crate::solvers::units::{Angle, AngularVelocity, Length};
use rug::Rational;

/// How near the bodies' angles have to be to choose a position: 15 degrees.
const NEAR: f64 = 0.262;

/// A coordinate at the start with its rate.
#[derive(Clone, Debug)]
pub(super) struct ExactGiven {
    pub coordinate: Coordinate,
    /// The angle between lines of bodies, or metres as radians.
    pub value: ExactAngle,
    /// The rate, in radians or metres a second; degrees as an angle.
    pub speed: ExactAngle,
}

/// Where a motion begins.
#[derive(Clone, Debug, Default)]
pub(super) struct Start {
    pub given: Vec<ExactGiven>,
    /// Bodies with the angles of their lines in radians.
    pub near: Vec<(usize, f64)>,
    /// The number of the position among those found.
    pub mode: Option<usize>,
}

fn exact<D>(q: &Quantity<D>) -> ExactAngle {
    match q.degrees {
        true => ExactAngle::Degrees(q.value.clone()),
        false => ExactAngle::Radians(q.value.clone()),
    }
}

impl Start {
    pub(super) fn read(
        source: &Source,
        file: &File,
        bodies: &Bodies,
        description: &Description,
        joints: &[String],
    ) -> Result<Start, Refusal> {
        let mut start = Start::default();
        let section = file.motion.as_ref();
        let near = section.map(|m| &m.near).filter(|near| !near.is_empty());
        for (name, angle) in near.unwrap_or(&file.start.near) {
            let place = format!("motion.near.{name}");
            start
                .near
                .push((bodies.find(source, &place, name)?, angle.to_f64()));
        }
        let coordinates = section.map(|m| &m.start).filter(|s| !s.is_empty());
        match coordinates {
            Some(all) => {
                for (name, given) in all {
                    let place = format!("motion.start.{name}");
                    let given = read_given(source, &place, (name, given), bodies, description)?;
                    start.given.push(given);
                }
            }
            None => start.by_drive(source, file, description, joints)?,
        }
        start.mode = file.start.mode.filter(|_| coordinates.is_none());
        Ok(start)
    }

    /// Of a linkage whose crank is its first body; `near` holds the angles of the others.
    fn of_crank(source: &Source, angle: ExactAngle, near: Vec<f64>) -> Result<Start, Refusal> {
        let speed = start_speed(source)?;
        let crank = ExactGiven {
            coordinate: Coordinate::Angle {
                body: 1,
                from: GROUND,
            },
            value: angle,
            speed: speed.map_or_else(|| ExactAngle::Radians(Rational::new()), |q| exact(&q)),
        };
        Ok(Start {
            given: vec![crank],
            near: (2..).zip(near).collect(),
            mode: None,
        })
    }

    pub(super) fn of_class_iii(
        source: &Source,
        linkage: &class_iii::Linkage,
    ) -> Result<Start, Refusal> {
        let degrees = linkage.start_degrees().unwrap_or_default();
        let branch = class_iii::choose(&linkage.solver, &degrees, None, &linkage.start);
        let p = branch
            .map_err(|e| source.refuse("start", e))?
            .start
            .positions;
        let angle = linkage.start.phi1.as_ref().map(Quantity::exact_angle);
        let angle = angle.unwrap_or_else(|| ExactAngle::Degrees(Rational::new()));
        Start::of_crank(source, angle, vec![p.phi2, p.phi3, p.phi4, p.phi5])
    }

    pub(super) fn of_dyad(source: &Source, dyad: &Dyad) -> Result<Start, Refusal> {
        let angle = dyad.exact.start.clone();
        let crank = Angle::from_rad(radians(&angle));
        let near = match &dyad.shape {
            Shape::FourBar { solver, .. } => solver
                .position(crank, dyad.assembly)
                .map(|at| vec![at.coupler.angle.rad(), at.rocker.angle.rad()]),
            Shape::SliderCrank { solver, .. } => solver
                .position(crank, dyad.assembly)
                .map(|at| vec![at.rod.angle.rad(), 0.0]),
        };
        Start::of_crank(source, angle, near.map_err(|e| source.refuse("start", e))?)
    }

    /// The drive's coordinate, where nothing else is said.
    fn by_drive(
        &mut self,
        source: &Source,
        file: &File,
        description: &Description,
        joints: &[String],
    ) -> Result<(), Refusal> {
        let Some(drive) = &file.drive else {
            let rule = "motion.start is missing: it names as many bodies or slides as there are degrees of freedom";
            return Err(source.breach("motion", rule));
        };
        let none = || ExactAngle::Radians(Rational::new());
        let (at, speed) = (file.start.at.as_deref(), file.start.speed.as_deref());
        let given = match (&drive.body, description.drive) {
            (Some(_), Drive::Angle { body, from }) => ExactGiven {
                coordinate: Coordinate::Angle { body, from },
                value: match at {
                    Some(text) => exact(&exactly::<Angle>(source, "start.at", text)?),
                    None => none(),
                },
                speed: match speed {
                    Some(text) => exact(&exactly::<AngularVelocity>(source, "start.speed", text)?),
                    None => none(),
                },
            },
            (_, Drive::Displacement { joint }) if joint < joints.len() => ExactGiven {
                coordinate: Coordinate::Displacement { joint },
                value: match at {
                    Some(text) => exact(&exactly::<Length>(source, "start.at", text)?),
                    None => none(),
                },
                speed: match speed {
                    Some(text) => exact(&exactly::<Velocity>(source, "start.speed", text)?),
                    None => none(),
                },
            },
            _ => return Err(source.breach("drive", "drive names no coordinate")),
        };
        self.given.push(given);
        Ok(())
    }
}

fn read_given(
    source: &Source,
    place: &str,
    (name, given): (&String, &Section),
    bodies: &Bodies,
    description: &Description,
) -> Result<ExactGiven, Refusal> {
    let key = |key: &str| format!("{place}.{key}");
    let slide = travels(description).into_iter().find(|t| t.1 == name);
    if let (Some((joint, _)), false) = (slide, bodies.names.contains(name)) {
        if given.from.is_some() {
            return Err(source.breach(place, format!("{place}: a displacement has no from")));
        }
        return Ok(ExactGiven {
            coordinate: Coordinate::Displacement { joint },
            value: exact(&exactly::<Length>(source, &key("at"), &given.at)?),
            speed: match &given.speed {
                Some(text) => exact(&exactly::<Velocity>(source, &key("speed"), text)?),
                None => ExactAngle::Radians(Rational::new()),
            },
        });
    }
    let body = bodies.find(source, place, name)?;
    let from = match &given.from {
        Some(from) => bodies.find(source, &key("from"), from)?,
        None => GROUND,
    };
    if body == from || body == GROUND {
        return Err(source.breach(
            place,
            format!("{place}: the angle of a body against another"),
        ));
    }
    Ok(ExactGiven {
        coordinate: Coordinate::Angle { body, from },
        value: exact(&exactly::<Angle>(source, &key("at"), &given.at)?),
        speed: match &given.speed {
            Some(text) => exact(&exactly::<AngularVelocity>(source, &key("speed"), text)?),
            None => ExactAngle::Radians(Rational::new()),
        },
    })
}

impl Moving {
    /// Begins on the branch of a position of the driven mechanism.
    pub fn start_on(&mut self, machine: &Machine, position: &State) {
        let bodies = 1..self.bodies.len();
        self.start.near = bodies.map(|b| (b, machine.line(position, b))).collect();
        self.start.mode = None;
    }

    /// The position at the start with its velocities, chosen by `motion.near`.
    ///
    /// # Errors
    /// [`MovingError`]: none or several.
    pub fn assembly(&self) -> Result<Assembly, MovingError> {
        let given: Vec<Given> = self.start.given.iter().map(|g| self.rounded(g)).collect();
        let frames = self
            .start
            .near
            .iter()
            .map(|(b, a)| (*b, a - self.lines[*b]));
        let near: Vec<(usize, f64)> = frames.collect();
        let mut found = self.dynamics.assemblies(&given, &near)?;
        let off = |a: &Assembly| {
            near.iter().fold(0.0, |m: f64, (b, angle)| {
                m.max(wrapped(a.angles[*b] - angle).abs())
            })
        };
        let listed = |found: &[Assembly]| self.listed(found);
        if let Some(mode) = self.start.mode.filter(|_| near.is_empty()) {
            // As the assembly modes are counted where a mechanism is driven: by the bodies' angles.
            return match mode < found.len() {
                true => Ok(found.swap_remove(mode)),
                false => Err(MovingError::Ambiguous {
                    listed: listed(&found),
                }),
            };
        }
        if !near.is_empty() && off(&found[0]) > NEAR {
            return Err(MovingError::NotNear {
                listed: listed(&found),
            });
        }
        match found.get(1) {
            Some(second) if near.is_empty() || off(second) < off(&found[0]) + 1e-9 => {
                Err(MovingError::Ambiguous {
                    listed: listed(&found),
                })
            }
            _ => Ok(found.swap_remove(0)),
        }
    }

    fn rounded(&self, given: &ExactGiven) -> Given {
        let (value, speed) = (radians(&given.value), radians(&given.speed));
        let frames = match given.coordinate {
            Coordinate::Angle { body, from } => self.lines[body] - self.lines[from],
            Coordinate::Displacement { .. } => 0.0,
        };
        Given {
            coordinate: given.coordinate,
            value: value - frames,
            speed,
        }
    }

    fn listed(&self, found: &[Assembly]) -> String {
        let most = 8;
        let of = |a: &Assembly| {
            let angles = (1..self.bodies.len()).map(|b| {
                let degrees = wrapped(a.angles[b] + self.lines[b]).to_degrees();
                format!("{} {degrees:.3}", self.bodies[b])
            });
            format!("{} deg", angles.collect::<Vec<_>>().join(", "))
        };
        let mut all: Vec<String> = found.iter().take(most).map(of).collect();
        if found.len() > most {
            all.push(format!("{} more", found.len() - most));
        }
        format!("there are {}", all.join("; "))
    }
}
