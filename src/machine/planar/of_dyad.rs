//! A four-bar linkage or slider-crank as a mechanism of bodies and joints, for what its own rows do
//! not have: reduced masses, paths of its points, forces in its joints.

use super::branch::wrapped;
use super::linkages::{self, Parts};
use super::loads::{ExactMass, Gravity};
use super::rows::{further, further_names};
use super::{Columns, Machine, Start, exact, joints};
use crate::machine::dyad::{Dyad, Values};
use crate::machine::source::Source;
use crate::solvers::planar::{LoadError, Loads, Mechanism, MechanismError, State};
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
    fn of_dyad(dyad: &Dyad) -> Result<Machine, FurtherError> {
        let Parts {
            file,
            bodies,
            masses,
        } = linkages::of_dyad(dyad)?;
        let Ok((description, joints)) = joints::read(&Source::toml(""), &file, &bodies) else {
            unreachable!("joints and points of a linkage belong together");
        };
        let solver = Mechanism::new(description)?;
        let loads = match dyad.shape.has_bodies() {
            true => {
                let masses = masses.iter().map(ExactMass::rounded).collect();
                let gravity = Gravity::of(&file).rounded();
                Some(Loads::new(&solver, masses, Vec::new(), gravity)?)
            }
            false => None,
        };
        Ok(Machine {
            name: file.name,
            loads,
            exact_joints: exact::joints(&file.joint, &bodies),
            exact_window: None,
            joints,
            lines: bodies.lines.clone(),
            points: bodies.moving(),
            exact: bodies.exact(),
            outlines: bodies.outlines(),
            bodies: bodies.names,
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

/// A named point of a link by fractions of a metre in its frame: the link's number, counted from 0.
pub type LinkPoint = (usize, String, [Rational; 2]);

#[cfg(test)]
mod tests;
