//! A four-bar linkage or slider-crank as a mechanism of bodies and joints, for what its own rows do
//! not have: reduced masses, paths of its points, forces in its joints.

use super::branch::wrapped;
use super::rows::{further, further_names};
use super::{Columns, Machine, Start};
use crate::machine::dyad::{Dyad, Shape, Values};
use crate::reference::nearest_f64;
use crate::solvers::planar::{
    BodyMass, Description, Drive, GROUND, Guide, Joint, LoadError, Loads, Mechanism,
    MechanismError, Point, State,
};
use crate::solvers::reduction::{Body, MomentOfInertia};
use crate::solvers::units::{Angle, Inertia, Length};
use rug::Rational;

/// Why there are no such columns.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FurtherError {
    /// The linkage is refused.
    #[error(transparent)]
    Mechanism(#[from] MechanismError),
    /// The masses are refused.
    #[error(transparent)]
    Loads(#[from] LoadError),
    /// A moment of inertia about a pivot that no mass at that distance can have.
    #[error(
        "the inertia of {body} about its pivot, {inertia} kg m^2, is less than its mass times the square of the radius, {least} kg m^2"
    )]
    Inertia {
        /// The body.
        body: String,
        /// The inertia given.
        inertia: f64,
        /// Its least value.
        least: f64,
    },
    /// Forces need masses and a speed.
    #[error("--reactions needs masses, in [bodies.…], and crank_speed in the file")]
    Reactions,
}

/// Columns of a four-bar linkage or slider-crank beyond its own.
pub struct Further {
    machine: Machine,
    columns: Columns,
}

impl Further {
    /// Reduced masses where the file has bodies, and the columns asked for; `None` where there are
    /// none.
    ///
    /// # Errors
    /// [`FurtherError`].
    pub fn of(dyad: &Dyad, columns: Columns) -> Result<Option<Further>, FurtherError> {
        if !(dyad.shape.has_bodies() || columns.paths || columns.reactions) {
            return Ok(None);
        }
        if columns.reactions && !(dyad.shape.has_bodies() && dyad.crank.is_some()) {
            return Err(FurtherError::Reactions);
        }
        let machine = Machine::of_dyad(dyad)?;
        Ok(Some(Further { machine, columns }))
    }

    /// The columns' names with their units.
    pub fn names(&self) -> Vec<String> {
        further_names(&self.machine, self.columns)
    }

    /// Their values at a crank angle in degrees beside a row of the dyad; NaN where the position is
    /// singular.
    pub fn values(&self, degrees: f64, row: &Values<f64>) -> Vec<f64> {
        let drive = self.machine.inner(degrees.to_radians());
        let modes = self.machine.solver.assembly_modes(drive);
        let slider = self.machine.bodies[3] == "slider";
        let middle = row[usize::from(slider)].to_radians();
        // The angle of coupler or rod tells the two positions apart.
        let apart = |state: &State| wrapped(self.machine.line(state, 2) - middle).abs();
        let singular = row[2].is_nan();
        let states = modes.states.iter().filter(|_| !singular);
        let state = states.min_by(|a, b| apart(a).total_cmp(&apart(b)));
        match state {
            Some(state) => {
                let loads = self.machine.loads_on(state);
                further(&self.machine, loads.as_ref(), state, self.columns)
            }
            None => vec![f64::NAN; self.names().len()],
        }
    }
}

impl Machine {
    /// The frames of the links have their origin at the joint nearer to the crank's pivot, that of
    /// the rocker at its own pivot, and x toward the other joint.
    fn of_dyad(dyad: &Dyad) -> Result<Machine, FurtherError> {
        let mut d = Description::new();
        let names = dyad.shape.links();
        let [crank, middle, last] = names.map(|name| d.body(name));
        let at = |body: usize, x: f64| Point::from_m(body, [x, 0.0]);
        let (masses, gravity) = (masses(&dyad.shape)?, dyad.gravity.m_per_s2());
        let mut outlines = vec![Vec::new(); 4];
        let pin = |d: &mut Description, name: &str, points: &[Point]| {
            let points = points.to_vec();
            d.joint(name, Joint::Pin { points });
        };
        pin(&mut d, "O1", &[at(GROUND, 0.0), at(crank, 0.0)]);
        match &dyad.shape {
            Shape::FourBar { solver, .. } => {
                let [a, b, c, e] = [
                    solver.crank(),
                    solver.coupler(),
                    solver.rocker(),
                    solver.frame(),
                ]
                .map(|l| l.m());
                pin(&mut d, "A", &[at(crank, a), at(middle, 0.0)]);
                pin(&mut d, "B", &[at(middle, b), at(last, c)]);
                pin(&mut d, "O3", &[at(GROUND, e), at(last, 0.0)]);
                outlines[crank].push(("A".to_owned(), at(crank, a)));
                outlines[middle].push(("B".to_owned(), at(middle, b)));
            }
            Shape::SliderCrank { solver, .. } => {
                let [a, b, e] = [solver.crank(), solver.rod(), solver.offset()].map(|l| l.m());
                pin(&mut d, "A", &[at(crank, a), at(middle, 0.0)]);
                pin(&mut d, "B", &[at(middle, b), at(last, 0.0)]);
                outlines[crank].push(("A".to_owned(), at(crank, a)));
                outlines[middle].push(("B".to_owned(), at(middle, b)));
                let (sin, cos) = solver.direction().rad().sin_cos();
                d.joint(
                    "guide",
                    Joint::Slide {
                        slider: at(last, 0.0),
                        guide: Guide {
                            origin: Point::from_m(GROUND, [-e * sin, e * cos]),
                            direction: solver.direction(),
                        },
                        turn: Angle::from_rad(0.0),
                    },
                );
            }
        }
        for (body, name, [x, y]) in &dyad.points {
            let place = Point::from_m(body + 1, [nearest_f64(x), nearest_f64(y)]);
            outlines[body + 1].push((name.clone(), place));
        }
        d.drive = Drive::Angle {
            body: crank,
            from: GROUND,
        };
        let mut points: Vec<(String, Point)> = outlines.concat();
        points.sort_by(|a, b| a.0.cmp(&b.0));
        let joints: Vec<_> = d.joints.iter().map(|j| j.name.clone()).collect();
        let bodies = d.bodies.clone();
        let solver = Mechanism::new(d)?;
        let loads = match masses.is_empty() {
            true => None,
            false => Some(Loads::new(&solver, masses, Vec::new(), [0.0, -gravity])?),
        };
        Ok(Machine {
            name: dyad.name.clone(),
            loads,
            exact_joints: vec![None; joints.len()],
            exact_window: None,
            joints,
            lines: vec![0.0; bodies.len()],
            points,
            exact: vec![Vec::new(); bodies.len()],
            outlines,
            bodies,
            speed: dyad
                .crank
                .as_ref()
                .map(|c| [c.omega.to_f64(), c.epsilon.to_f64()]),
            window: None,
            start: Start::default(),
            solver,
            drawing: None,
        })
    }
}

/// Masses of the links where the file has bodies.
fn masses(shape: &Shape) -> Result<Vec<BodyMass>, FurtherError> {
    let links = shape.links();
    let of = |(k, body): (usize, &Body)| {
        let (mass, radius) = (body.mass.kg(), body.radius.m());
        let inertia = match body.inertia {
            MomentOfInertia::AboutCentreOfMass(j) => j.kg_m2(),
            MomentOfInertia::AboutPivot(j) => {
                let least = mass * radius * radius;
                let own = j.kg_m2() - least;
                // A point mass but for rounding.
                if own < -1e-12 * least {
                    return Err(FurtherError::Inertia {
                        body: links[k].into(),
                        inertia: j.kg_m2(),
                        least,
                    });
                }
                own.max(0.0)
            }
        };
        let (sin, cos) = body.angle.rad().sin_cos();
        Ok(BodyMass {
            body: k + 1,
            mass: body.mass,
            inertia: Inertia::from_kg_m2(inertia),
            centre: [radius * cos, radius * sin].map(Length::from_m),
        })
    };
    match shape {
        Shape::FourBar { bodies, .. } => bodies.iter().flatten().enumerate().map(of).collect(),
        Shape::SliderCrank { bodies, .. } => {
            let Some((links, slider)) = bodies else {
                return Ok(Vec::new());
            };
            let mut all: Vec<BodyMass> =
                links.iter().enumerate().map(of).collect::<Result<_, _>>()?;
            all.push(BodyMass {
                body: 3,
                mass: *slider,
                inertia: Inertia::from_kg_m2(0.0),
                centre: [Length::from_m(0.0); 2],
            });
            Ok(all)
        }
    }
}

/// A named point of a link by fractions of a metre in its frame: the link's number, counted from 0.
pub type LinkPoint = (usize, String, [Rational; 2]);

#[cfg(test)]
mod tests;
