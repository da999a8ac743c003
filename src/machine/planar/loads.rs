//! Masses and loads.

use super::Machine;
use super::bodies::Bodies;
use super::file::File;
use super::joints::{drive_value, quantity};
use crate::machine::quantity::{Dimension, Force, Quantity};
use crate::machine::source::{Refusal, Source};
use crate::reference::nearest_f64;
use crate::solvers::planar::{BodyMass, Course, GROUND, Load, Loads, Mechanism, State};
use crate::solvers::units::{Inertia, Length, Mass, Torque};
use std::f64::consts::{PI, TAU};

/// A value or a table over the drive; `offset` is the user's drive where the solver's is zero.
struct Courses<'a> {
    source: &'a Source,
    rotary: bool,
    offset: f64,
}

impl Courses<'_> {
    fn read<D: Dimension>(
        &self,
        at: &str,
        value: &Option<String>,
        table: &Option<Vec<[String; 2]>>,
    ) -> Result<Course, Refusal> {
        match (value, table) {
            (Some(text), None) => Ok(Course::Constant(quantity::<D>(
                self.source,
                &format!("{at}.value"),
                text,
            )?)),
            (None, Some(rows)) => {
                let place = format!("{at}.table");
                let row = |[drive, value]: &[String; 2]| -> Result<[f64; 2], Refusal> {
                    let x = drive_value(self.source, &place, drive, self.rotary)?;
                    let x = if self.rotary {
                        x.to_radians() - self.offset
                    } else {
                        x
                    };
                    Ok([x, quantity::<D>(self.source, &place, value)?])
                };
                Ok(Course::Table(
                    rows.iter().map(row).collect::<Result<_, _>>()?,
                ))
            }
            _ => Err(self
                .source
                .breach(at, format!("{at} needs either value or table"))),
        }
    }
}

/// Masses and loads; `None` if the file has none.
pub(super) fn read(
    source: &Source,
    file: &File,
    bodies: &Bodies,
    mechanism: &Mechanism,
    offset: f64,
) -> Result<Option<Loads>, Refusal> {
    let courses = Courses {
        source,
        rotary: !mechanism.drive_is_displacement(),
        offset,
    };
    let masses = masses(source, file)?;
    let loads = loads(source, file, bodies, &courses)?;
    if masses.is_empty() && loads.is_empty() {
        return Ok(None);
    }
    let gravity = gravity(file);
    let loads = Loads::new(mechanism, masses, loads, gravity);
    loads.map(Some).map_err(|e| source.refuse("body", e))
}

/// Masses of the bodies.
fn masses(source: &Source, file: &File) -> Result<Vec<BodyMass>, Refusal> {
    let mut masses = Vec::new();
    for (k, body) in file.body.iter().enumerate() {
        let at = format!("body[{k}]");
        let Some(mass) = &body.mass else {
            if body.inertia.is_none() && body.centre.is_none() {
                continue;
            }
            return Err(source.breach(&at, format!("{at}: inertia and centre need mass")));
        };
        let Some(centre) = &body.centre else {
            return Err(source.breach(&at, format!("{at}: mass needs centre, in the body's frame")));
        };
        let m = |q: &Quantity<Length>| Length::from_m(nearest_f64(&q.value));
        masses.push(BodyMass {
            body: k + 1,
            mass: Mass::from_kg(nearest_f64(&mass.value)),
            inertia: Inertia::from_kg_m2(
                body.inertia.as_ref().map_or(0.0, |j| nearest_f64(&j.value)),
            ),
            centre: [m(&centre[0]), m(&centre[1])],
        });
    }
    Ok(masses)
}

/// The acceleration of gravity in m/s².
fn gravity(file: &File) -> [f64; 2] {
    let g = file
        .gravity
        .as_ref()
        .map_or(9.80665, |g| nearest_f64(&g.value));
    match &file.gravity_direction {
        None => [0.0, -g],
        Some(a) => {
            let (s, c) = a.to_f64().sin_cos();
            [g * c, g * s]
        }
    }
}

/// Masses, loads and gravity.
type Parts = (Vec<BodyMass>, Vec<Load>, [f64; 2]);

/// Masses, loads and gravity of a mechanism without a drive, whose loads have no tables.
pub(super) fn parts(source: &Source, file: &File, bodies: &Bodies) -> Result<Parts, Refusal> {
    let courses = Courses {
        source,
        rotary: false,
        offset: 0.0,
    };
    let loads = loads(source, file, bodies, &courses)?;
    Ok((masses(source, file)?, loads, gravity(file)))
}

fn loads(
    source: &Source,
    file: &File,
    bodies: &Bodies,
    courses: &Courses,
) -> Result<Vec<Load>, Refusal> {
    let body = |at: &str, key: &str, name: &str| bodies.find(source, &format!("{at}.{key}"), name);
    let from = |at: &str, name: &Option<String>| match name {
        Some(name) => body(at, "from", name),
        None => Ok(GROUND),
    };
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
        let size = courses.read::<Force>(&at, &f.value, &f.table)?;
        let (s, c) = f.direction.to_f64().sin_cos();
        let along = match &f.with {
            Some(name) => body(&at, "with", name)?,
            None => GROUND,
        };
        let part = |factor: f64| match &size {
            Course::Constant(x) => Course::Constant(x * factor),
            Course::Table(rows) => {
                Course::Table(rows.iter().map(|[x, y]| [*x, y * factor]).collect())
            }
        };
        let at = bodies.point(source, &format!("{at}.at"), &f.at)?;
        all.push(Load::Force {
            at,
            components: [part(c), part(s)],
            along,
        });
    }
    for (k, t) in file.torque.iter().enumerate() {
        let at = format!("torque[{k}]");
        all.push(Load::Torque {
            body: body(&at, "body", &t.body)?,
            from: from(&at, &t.from)?,
            torque: courses.read::<Torque>(&at, &t.value, &t.table)?,
        });
    }
    for (k, s) in file.spring.iter().enumerate() {
        all.push(Load::Spring {
            ends: ends(&format!("spring[{k}]"), &s.ends)?,
            stiffness: nearest_f64(&s.stiffness.value),
            length: nearest_f64(&s.length.value),
        });
    }
    for (k, s) in file.torsion_spring.iter().enumerate() {
        let at = format!("torsion_spring[{k}]");
        if s.stiffness.degrees {
            let place = format!("{at}.stiffness");
            let rule = format!("{place}: write it for each radian, for instance in N m/rad");
            return Err(source.breach(&place, rule));
        }
        // From the angle between the bodies' lines to that between their frames; turns are those of
        // the branch.
        let (b, f) = (body(&at, "body", &s.body)?, from(&at, &s.from)?);
        all.push(Load::TorsionSpring {
            body: b,
            from: f,
            stiffness: nearest_f64(&s.stiffness.value),
            angle: s.angle.to_f64() - bodies.lines[b] + bodies.lines[f],
        });
    }
    for (k, d) in file.damper.iter().enumerate() {
        all.push(Load::Damper {
            ends: ends(&format!("damper[{k}]"), &d.ends)?,
            damping: nearest_f64(&d.damping.value),
        });
    }
    for (k, d) in file.torsion_damper.iter().enumerate() {
        let at = format!("torsion_damper[{k}]");
        all.push(Load::TorsionDamper {
            body: body(&at, "body", &d.body)?,
            from: from(&at, &d.from)?,
            damping: nearest_f64(&d.damping.value),
        });
    }
    Ok(all)
}

/// How near to −180 degrees a line counts as at 180: rounding must not wind a spring by a turn.
const SEAM: f64 = 1e-9;

impl Machine {
    /// Returns true if there are masses or loads.
    pub fn has_loads(&self) -> bool {
        self.loads.is_some()
    }

    /// Masses and loads on the branch of a position, with the torsion springs' turns counted on it:
    /// the angle between two bodies is the difference of their lines' angles, each in (−180°,
    /// 180°], where the branch passes the drive at which it is to start (0° or the range's
    /// beginning if the file does not say) next to the position, or at its lower end if it does not
    /// pass there.
    pub fn loads_on(&self, position: &State) -> Option<Loads> {
        let mut loads = self.loads.clone()?;
        if loads.has_torsion_springs() {
            let from = self.counted_from(position);
            let turns = |body: usize| {
                let line = self.line(&from, body);
                ((line - PI - SEAM) / TAU).ceil() * TAU
            };
            loads.shift_torsion_springs(|body, from| turns(body) - turns(from));
        }
        Some(loads)
    }

    fn counted_from(&self, position: &State) -> State {
        let here = self.outer(self.solver.drive_of(position));
        let at = |drive: f64| {
            let (state, error) = self.solver.follow_as_far(position, self.inner(drive));
            (state, error.is_none())
        };
        let tried = match (self.rotary(), self.start.at) {
            (true, at) => {
                let at = at.unwrap_or(0.0).to_radians();
                let near = at + ((here - at) / TAU).round() * TAU;
                let other = if near > here { near - TAU } else { near + TAU };
                [Some(near), Some(other)]
            }
            (false, at) => [at.or(self.window.map(|w| w[0])), None],
        };
        let low = self.window.map_or(here - TAU, |w| w[0]);
        let passes = |drive: f64| Some(at(drive)).filter(|(_, reached)| *reached);
        let passed = tried.into_iter().flatten().find_map(passes);
        passed.unwrap_or_else(|| at(low)).0
    }
}

#[cfg(test)]
mod tests;
