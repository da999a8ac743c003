//! Masses and loads, exactly as written and rounded for the solvers.

use super::Machine;
use super::bodies::{Bodies, nearest};
use super::exact::radians;
use super::file::File;
use super::joints::{drive_value, exactly, quantity};
use crate::machine::quantity::{Dimension, Force};
use crate::machine::source::{Refusal, Source};
use crate::reference::class_iii::ExactAngle;
use crate::reference::nearest_f64;
use crate::reference::planar::Place;
use crate::solvers::planar::{BodyMass, Course, GROUND, Load, Loads, Mechanism, Point, State};
use crate::solvers::units::{Inertia, Length, Mass, Torque};
use rug::Rational;
use std::f64::consts::{PI, TAU};

/// Mass, inertia and centre of a body.
#[derive(Clone, Debug)]
pub(super) struct ExactMass {
    pub body: usize,
    pub mass: Rational,
    pub inertia: Rational,
    pub centre: Place,
}

impl ExactMass {
    pub fn rounded(&self) -> BodyMass {
        BodyMass {
            body: self.body,
            mass: Mass::from_kg(nearest_f64(&self.mass)),
            inertia: Inertia::from_kg_m2(nearest_f64(&self.inertia)),
            centre: self.centre.each_ref().map(|x| Length::from_m(nearest(x))),
        }
    }
}

/// The size of a force or torque.
#[derive(Clone, Debug)]
pub(super) enum Size {
    Constant(Rational),
    /// Over the solver's drive.
    Table(Vec<[f64; 2]>),
}

impl Size {
    fn course(&self, factor: f64) -> Course {
        match self {
            Size::Constant(q) => Course::Constant(nearest_f64(q) * factor),
            Size::Table(rows) => {
                Course::Table(rows.iter().map(|[x, y]| [*x, y * factor]).collect())
            }
        }
    }
}

/// A load in SI units.
#[derive(Clone, Debug)]
pub(super) enum ExactLoad {
    /// A force in the axes of a body or the ground.
    Force {
        at: Point,
        size: Size,
        direction: ExactAngle,
        along: usize,
    },
    Torque {
        body: usize,
        from: usize,
        torque: Size,
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

impl ExactLoad {
    /// The load in floating point. `lines` holds the angles of the bodies' lines in their frames;
    /// turns of a torsion spring are those of the branch.
    pub fn rounded(&self, lines: &[f64]) -> Load {
        match self {
            ExactLoad::Force {
                at,
                size,
                direction,
                along,
            } => {
                let (s, c) = radians(direction).sin_cos();
                Load::Force {
                    at: *at,
                    components: [size.course(c), size.course(s)],
                    along: *along,
                }
            }
            ExactLoad::Torque { body, from, torque } => Load::Torque {
                body: *body,
                from: *from,
                torque: torque.course(1.0),
            },
            ExactLoad::Spring {
                ends,
                stiffness,
                length,
            } => Load::Spring {
                ends: *ends,
                stiffness: nearest_f64(stiffness),
                length: nearest_f64(length),
            },
            ExactLoad::TorsionSpring {
                body,
                from,
                stiffness,
                angle,
            } => Load::TorsionSpring {
                body: *body,
                from: *from,
                stiffness: nearest_f64(stiffness),
                angle: radians(angle) - lines[*body] + lines[*from],
            },
            ExactLoad::Damper { ends, damping } => Load::Damper {
                ends: *ends,
                damping: nearest_f64(damping),
            },
            ExactLoad::TorsionDamper {
                body,
                from,
                damping,
            } => Load::TorsionDamper {
                body: *body,
                from: *from,
                damping: nearest_f64(damping),
            },
        }
    }
}

/// The acceleration of gravity in m/s².
#[derive(Clone, Debug)]
pub(super) struct Gravity {
    size: Rational,
    /// Downwards otherwise.
    direction: Option<ExactAngle>,
}

impl Gravity {
    pub fn of(file: &File) -> Gravity {
        let standard = || Rational::from((980_665, 100_000));
        let direction = file.gravity_direction.as_ref();
        Gravity {
            size: file
                .gravity
                .as_ref()
                .map_or_else(standard, |g| g.value.clone()),
            direction: direction.map(|a| a.exact_angle()),
        }
    }

    #[cfg(feature = "report")]
    pub fn exact(&self) -> Place {
        let down = ExactAngle::Degrees(Rational::from(-90));
        let direction = self.direction.as_ref().unwrap_or(&down);
        crate::reference::planar::Real::unit(direction).map(|x| x * &self.size)
    }

    pub fn rounded(&self) -> [f64; 2] {
        let g = nearest_f64(&self.size);
        match &self.direction {
            None => [0.0, -g],
            Some(a) => {
                let (s, c) = radians(a).sin_cos();
                [g * c, g * s]
            }
        }
    }
}

/// A value or a table over the drive.
pub(super) struct Courses {
    pub rotary: bool,
    /// The user's drive where the solver's is zero.
    pub offset: f64,
}

impl Courses {
    fn read<D: Dimension>(
        &self,
        source: &Source,
        at: &str,
        value: &Option<String>,
        table: &Option<Vec<[String; 2]>>,
    ) -> Result<Size, Refusal> {
        match (value, table) {
            (Some(text), None) => {
                let value = exactly::<D>(source, &format!("{at}.value"), text)?;
                Ok(Size::Constant(value.value))
            }
            (None, Some(rows)) => {
                let place = format!("{at}.table");
                let row = |[drive, value]: &[String; 2]| -> Result<[f64; 2], Refusal> {
                    let x = drive_value(source, &place, drive, self.rotary)?;
                    let x = if self.rotary {
                        x.to_radians() - self.offset
                    } else {
                        x
                    };
                    Ok([x, quantity::<D>(source, &place, value)?])
                };
                Ok(Size::Table(rows.iter().map(row).collect::<Result<_, _>>()?))
            }
            _ => Err(source.breach(at, format!("{at} needs either value or table"))),
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
        rotary: !mechanism.drive_is_displacement(),
        offset,
    };
    let masses = masses(source, file)?;
    let loads = loads(source, file, bodies, &courses)?;
    if masses.is_empty() && loads.is_empty() {
        return Ok(None);
    }
    let masses = masses.iter().map(ExactMass::rounded).collect();
    let loads = loads.iter().map(|l| l.rounded(&bodies.lines)).collect();
    let loads = Loads::new(mechanism, masses, loads, Gravity::of(file).rounded());
    loads.map(Some).map_err(|e| source.refuse("body", e))
}

/// Masses of the bodies.
pub(super) fn masses(source: &Source, file: &File) -> Result<Vec<ExactMass>, Refusal> {
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
        let inertia = body.inertia.as_ref();
        masses.push(ExactMass {
            body: k + 1,
            mass: mass.value.clone(),
            inertia: inertia.map(|j| j.value.clone()).unwrap_or_default(),
            centre: centre.each_ref().map(|x| x.value.clone().into()),
        });
    }
    Ok(masses)
}

/// Forces, torques, springs and dampers.
pub(super) fn loads(
    source: &Source,
    file: &File,
    bodies: &Bodies,
    courses: &Courses,
) -> Result<Vec<ExactLoad>, Refusal> {
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
        let size = courses.read::<Force>(source, &at, &f.value, &f.table)?;
        let along = match &f.with {
            Some(name) => body(&at, "with", name)?,
            None => GROUND,
        };
        all.push(ExactLoad::Force {
            at: bodies.point(source, &format!("{at}.at"), &f.at)?,
            size,
            direction: f.direction.exact_angle(),
            along,
        });
    }
    for (k, t) in file.torque.iter().enumerate() {
        let at = format!("torque[{k}]");
        all.push(ExactLoad::Torque {
            body: body(&at, "body", &t.body)?,
            from: from(&at, &t.from)?,
            torque: courses.read::<Torque>(source, &at, &t.value, &t.table)?,
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
        if s.stiffness.degrees {
            let place = format!("{at}.stiffness");
            let rule = format!("{place}: write it for each radian, for instance in N m/rad");
            return Err(source.breach(&place, rule));
        }
        all.push(ExactLoad::TorsionSpring {
            body: body(&at, "body", &s.body)?,
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
            body: body(&at, "body", &d.body)?,
            from: from(&at, &d.from)?,
            damping: d.damping.value.clone(),
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
