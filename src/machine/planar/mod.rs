//! A mechanism of bodies and joints as its file describes it.

mod bodies;
mod branch;
mod certified;
mod drawn;
mod exact;
mod file;
mod joints;
mod linkages;
mod loads;
mod motion;
#[cfg(feature = "report")]
mod moving;
mod of_dyad;
mod path;
mod rows;

pub(in crate::machine) use bodies::check_name;
pub use branch::{Branch, End, MARGIN, PlanarError, Reach, choose};
pub use certified::{CertifiedRow, Certifier, NotExact};
pub use motion::motion;
#[cfg(feature = "report")]
pub use moving::{Certified, CertifiedMoment, Moving, MovingError, MovingQuantity, Row};
pub use of_dyad::{Further, FurtherError, LinkPoint};
pub use path::{path, positions};
pub use rows::{Columns, certified_names, names, values};

use super::source::{Refusal, Source};
use crate::reference::planar::{Freedom, Mobility, Place};
use crate::solvers::planar::{Description, Drive, Loads, Mechanism, MechanismError, Point};
use bodies::Bodies;
use file::File;
use rug::Rational;

/// A mechanism as described, in floating point.
pub struct Machine {
    /// Its name, if it has one.
    pub name: Option<String>,
    /// Bodies, joints and drive.
    pub solver: Mechanism,
    /// Where the file gives masses or loads; [`Machine::loads_on`] counts a branch's turns.
    loads: Option<Loads>,
    /// Names of all bodies, the ground first.
    pub bodies: Vec<String>,
    /// Names of the joints.
    pub joints: Vec<String>,
    /// For each body the angle, in its frame, of the line that its angle is that of; radians.
    pub lines: Vec<f64>,
    /// The named points on moving bodies, each once.
    pub points: Vec<(String, Point)>,
    /// All points of each body, in the file's order of names, for drawings.
    pub outlines: Vec<Vec<(String, Point)>>,
    /// Speed and acceleration of the drive, if given, in rad/s or m/s and their squares.
    pub speed: Option<[f64; 2]>,
    /// Of a drive by displacement: first value, last value and step in metres.
    pub window: Option<[f64; 3]>,
    /// Which branch is meant.
    pub start: Start,
    /// Ranks in the drawing, where every body is drawn and every joint a pin.
    pub drawing: Option<Freedom>,
    /// [`Machine::window`] exactly.
    pub exact_window: Option<[Rational; 3]>,
    /// The exact places of all points of each body.
    exact: Vec<Vec<(Point, Option<Place>)>>,
    /// The exact numbers of the joints.
    exact_joints: Vec<Option<exact::ExactJoint>>,
}

/// Which branch is meant.
#[derive(Clone, Debug, Default)]
pub struct Start {
    /// The drive there, as the user counts it: degrees or metres.
    pub at: Option<f64>,
    /// The mode of this number.
    pub mode: Option<usize>,
    /// Bodies with the angles of their lines in radians, near which they are.
    pub near: Vec<(usize, f64)>,
    /// True if these come from the drawing.
    pub drawn: bool,
}

impl Machine {
    /// Reads the description of a mechanism.
    ///
    /// # Errors
    /// [`Refusal`].
    pub fn read(source: &Source) -> Result<Machine, Refusal> {
        let file: File = source.parse()?;
        let Some(section) = &file.drive else {
            let rule = match file.motion {
                Some(_) => {
                    "drive is missing: without it the file has a motion alone, see `mechaudit motion`"
                }
                None => {
                    "drive is missing: it names the body or the slide that everything is a function of"
                }
            };
            return Err(source.breach("drive", rule));
        };
        let bodies = Bodies::new(source, &file)?;
        let (description, joints) = joints::read(source, &file, &bodies)?;
        let drawing = drawn::freedom(&file, &bodies);
        let solver = Mechanism::new(description).map_err(|e| {
            let place = if file.joint.is_empty() {
                "body"
            } else {
                "joint"
            };
            match (&drawing, &e) {
                (
                    Some(freedom),
                    MechanismError::OverConstrained { .. }
                    | MechanismError::Locked { .. }
                    | MechanismError::Loose { .. },
                ) => source.refuse(place, drawn::Special::new(e, freedom, &bodies)),
                _ => source.refuse(place, e),
            }
        })?;
        let offset = offset(solver.description().drive, &bodies.lines);
        let loads = loads::read(source, &file, &bodies, &solver, offset)?;
        let drive = joints::drive(source, section, !solver.drive_is_displacement())?;
        let start = start(source, &file, &bodies, solver.description())?;
        let exact_joints = exact::joints(&file.joint, &bodies);
        Ok(Machine {
            name: file.name,
            loads,
            joints,
            lines: bodies.lines.clone(),
            points: bodies.moving(),
            outlines: bodies.outlines(),
            exact: bodies.exact(),
            exact_joints,
            exact_window: exact::window(&file.drive),
            bodies: bodies.names,
            speed: drive.speed,
            window: drive.window,
            start,
            solver,
            drawing,
        })
    }

    /// One line about the drawing where it is not regular: redundant equations there, or more than
    /// one velocity.
    pub fn drawing_text(&self) -> Option<String> {
        let drawing = self.drawing.as_ref()?;
        match drawing.mobility {
            Mobility::Regular { freedoms: 1 } => None,
            _ => Some(drawn::words(drawing, &self.bodies)),
        }
    }

    /// Returns true if the drive is an angle.
    pub fn rotary(&self) -> bool {
        !self.solver.drive_is_displacement()
    }

    /// The solver's drive for the user's: the angle of the driven body's line less that of the line
    /// of the body that it is measured from, in radians, or metres.
    pub fn inner(&self, drive: f64) -> f64 {
        drive - self.offset()
    }

    /// The user's drive for the solver's.
    pub fn outer(&self, drive: f64) -> f64 {
        drive + self.offset()
    }

    fn offset(&self) -> f64 {
        offset(self.solver.description().drive, &self.lines)
    }
}

/// The angle between the two bodies' lines where that between their frames is zero.
fn offset(drive: Drive, lines: &[f64]) -> f64 {
    match drive {
        Drive::Angle { body, from } => lines[body] - lines[from],
        Drive::Displacement { .. } => 0.0,
    }
}

/// The section `[start]`; without it the drawing, if every body is drawn.
fn start(
    source: &Source,
    file: &File,
    bodies: &Bodies,
    description: &Description,
) -> Result<Start, Refusal> {
    let rotary = matches!(description.drive, Drive::Angle { .. });
    let section = &file.start;
    if section.mode.is_some() && !section.near.is_empty() {
        let rule = "start.mode and start.near exclude each other";
        return Err(source.breach("start.mode", rule));
    }
    let mut near = Vec::new();
    for (name, angle) in &section.near {
        let place = format!("start.near.{name}");
        near.push((bodies.find(source, &place, name)?, angle.to_f64()));
    }
    let given = match &section.at {
        Some(text) => Some(joints::drive_value(source, "start.at", text, rotary)?),
        None => None,
    };
    let told = given.is_some() || section.mode.is_some() || !near.is_empty();
    if let (false, Some(at)) = (told, drawn::drive(file, bodies, description)) {
        // A body drawn by one point has no line that could be seen.
        let lined = |b: &usize| file.body[b - 1].drawn.len() > 1;
        let lines = (1..bodies.names.len()).filter(lined);
        return Ok(Start {
            at: Some(at),
            mode: None,
            near: lines.map(|b| (b, bodies.lines[b])).collect(),
            drawn: true,
        });
    }
    Ok(Start {
        at: given,
        mode: section.mode,
        near,
        drawn: false,
    })
}

#[cfg(test)]
mod tests;
