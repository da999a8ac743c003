//! Equations of motion of planar mechanisms with any number of degrees of freedom.
//!
//! With independent coordinates z among the unknowns u of the tree of bodies, the closures F(u) = 0
//! give `u̇ = N ż` and `ü = N z̈ + β`, so that a point of a body moves with `v = Σ v_i ż_i` and `a
//! = Σ v_i z̈_i + a_β`. The equations of motion are those of Kane and Levinson (*Dynamics: Theory
//! and Applications*, 1985, section 6.1):
//!
//! ```text
//! Σ_j M_ij z̈_j = Σ F·v_i + Σ T ω_i − Σ m a_β·v_i − Σ J α_β ω_i,      M_ij = Σ m v_i·v_j + Σ J ω_i ω_j
//! ```
//!
//! The closures are solved by Newton's method at every evaluation, so that loops stay closed; z is
//! chosen anew where the closures determine the other unknowns badly, as they do near a dead
//! position of the coordinate that was independent before.

mod assembly;
mod flow;
mod forces;
mod trajectory;

pub use assembly::{Assembly, Coordinate, Given};
pub use flow::Instant;
pub use trajectory::{Moment, Settings};

use super::chain::{Chain, Spot, spot};
use super::check::{check, largest};
use super::error::MechanismError;
use super::loads::{BodyMass, Course, Load, LoadError, Loads};
use super::model::{Description, Point};
use crate::initial_value::StepError;
use num_complex::Complex64;

/// A force or torque as a function of time, positions and speeds, in SI units.
pub type Law = Box<dyn Fn(&Instant) -> f64>;

/// A load that follows a [`Law`].
pub enum DrivenLoad {
    /// A torque on a body, and its reaction on another (or the ground).
    Torque {
        /// The body that it turns forward.
        body: usize,
        /// The body that takes the reaction.
        from: usize,
        /// The torque in N·m.
        torque: Law,
    },
    /// A force at a point.
    Force {
        /// Where it acts.
        at: Point,
        /// Components in the ground's axes in N.
        components: [Law; 2],
    },
    /// Inertia that turns with the difference of two bodies' angles, such as that of a motor's
    /// rotor seen through its gear.
    Inertia {
        /// The body.
        body: usize,
        /// The body that its angle is measured from.
        from: usize,
        /// In kg·m².
        inertia: f64,
    },
}

/// A body with mass.
#[derive(Clone, Copy, Debug)]
struct Rigid {
    centre: Spot,
    kg: f64,
    /// In kg·m² about the centre of mass.
    inertia: f64,
}

/// A mechanism with masses and loads that moves by itself.
pub struct Dynamics {
    description: Description,
    chain: Chain,
    rigid: Vec<Rigid>,
    loads: Vec<Load>,
    driven: Vec<DrivenLoad>,
    /// In m/s².
    gravity: Complex64,
}

/// Why there is no motion.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DynamicsError {
    /// The parts break a rule.
    #[error(transparent)]
    Parts(#[from] MechanismError),
    /// Masses or loads break a rule.
    #[error(transparent)]
    Loads(#[from] LoadError),
    /// A load is a table over the drive, of which there is none.
    #[error(
        "a force or torque as a table over the drive has no meaning in a motion; write a formula"
    )]
    Table,
    /// As many coordinates have to be given at the start as there are degrees of freedom.
    #[error(
        "the mechanism has {freedoms} degrees of freedom, and the start gives {given} coordinates"
    )]
    Freedoms {
        /// Degrees of freedom, by count.
        freedoms: i64,
        /// Coordinates that are given.
        given: usize,
    },
    /// The loops do not close.
    #[error(
        "the mechanism cannot be assembled at the start: no position was found with the coordinates given"
    )]
    NotAssembled,
    /// The given coordinates do not determine the position or the speeds.
    #[error(
        "the coordinates given at the start do not determine the position: it is singular there"
    )]
    SingularStart,
    /// The loops determine no unknowns: the mechanism is at a singular position.
    #[error("the mechanism is singular at t = {t} s: its loops do not determine the motion there")]
    Singular {
        /// Time in seconds.
        t: f64,
    },
    /// A coordinate has no inertia.
    #[error(
        "a body that moves has neither mass nor inertia (at t = {t} s): its acceleration is not determined"
    )]
    NoInertia {
        /// Time in seconds.
        t: f64,
    },
    /// A law has no value.
    #[error("a force or torque is not a finite number at t = {t} s")]
    Law {
        /// Time in seconds.
        t: f64,
    },
    /// The step became too small.
    #[error("the step became too small at t = {t} s: the motion is not smooth there, or it ends")]
    Small {
        /// Time in seconds.
        t: f64,
    },
    /// The budget of steps is used up.
    #[error("gave up at t = {t} s after {steps} steps")]
    Budget {
        /// Time in seconds.
        t: f64,
        /// Steps taken.
        steps: usize,
    },
}

impl From<StepError<DynamicsError>> for DynamicsError {
    fn from(e: StepError<DynamicsError>) -> DynamicsError {
        match e {
            StepError::Rate(e) => e,
            StepError::Small { t } => DynamicsError::Small { t },
        }
    }
}

impl Dynamics {
    /// Checks the parts and hangs the bodies on one another. The description's drive is not looked
    /// at: nothing holds a coordinate.
    ///
    /// ```
    /// use mechaudit_solvers::planar::dynamics::{Coordinate, Dynamics, Given, Settings};
    /// use mechaudit_solvers::planar::{BodyMass, Description, GROUND};
    /// use mechaudit_solvers::units::{Inertia, Length, Mass};
    /// // A pendulum of 1 m with a point mass, let go at 0.1 rad from the lowest position.
    /// let mut d = Description::new();
    /// let rod = d.body("rod");
    /// d.pin("O", &[(GROUND, [0.0, 0.0]), (rod, [0.0, 0.0])]);
    /// let m = Length::from_m;
    /// let mass = BodyMass {
    ///     body: rod,
    ///     mass: Mass::from_kg(2.0),
    ///     inertia: Inertia::from_kg_m2(0.0),
    ///     centre: [m(1.0), m(0.0)],
    /// };
    /// let pendulum = Dynamics::new(d, vec![mass], Vec::new(), Vec::new(), [0.0, -9.81])?;
    /// let lowest = -std::f64::consts::FRAC_PI_2;
    /// let start = Given { coordinate: Coordinate::angle(rod), value: lowest + 0.1, speed: 0.0 };
    /// let start = pendulum.assemblies(&[start], &[])?.remove(0);
    /// let mut last = 0.0;
    /// // T = 2π √(l/g) (1 + 0.1²/16 + …)
    /// pendulum.motion(&start, &[2.007_324_97], Settings::default(), |moment| {
    ///     last = pendulum.angle(moment, rod)[0];
    ///     true
    /// })?;
    /// assert!((last - lowest - 0.1).abs() < 1e-8);
    /// # Ok::<(), mechaudit_solvers::planar::dynamics::DynamicsError>(())
    /// ```
    ///
    /// # Errors
    /// [`DynamicsError`]: a part, mass or load that breaks a rule, bodies that hang on nothing.
    pub fn new(
        description: Description,
        masses: Vec<BodyMass>,
        loads: Vec<Load>,
        driven: Vec<DrivenLoad>,
        gravity: [f64; 2],
    ) -> Result<Dynamics, DynamicsError> {
        check(&description)?;
        let loads = Loads::checked(description.bodies.len(), false, masses, loads, gravity)?;
        let tabled = |c: &Course| matches!(c, Course::Table(_));
        if loads.loads.iter().any(|l| match l {
            Load::Force { components, .. } => components.iter().any(tabled),
            Load::Torque { torque, .. } => tabled(torque),
            _ => false,
        }) {
            return Err(DynamicsError::Table);
        }
        // One body on a pin or a slide may have no dimension.
        let size = match largest(&description) {
            Err(MechanismError::Size { largest_m: 0.0 }) => 1.0,
            size => size?,
        };
        let metres = 2f64.powi(size.log2().floor() as i32);
        let chain = Chain::free(&description, metres);
        let hanging = (1..description.bodies.len()).filter(|b| !chain.order.contains(b));
        let bodies: Vec<String> = hanging.map(|b| description.bodies[b].clone()).collect();
        if !bodies.is_empty() {
            return Err(MechanismError::Hanging { bodies }.into());
        }
        let rigid = |m: &BodyMass| Rigid {
            centre: spot(&Point::new(m.body, m.centre[0], m.centre[1]), metres),
            kg: m.mass.kg(),
            inertia: m.inertia.kg_m2(),
        };
        Ok(Dynamics {
            rigid: loads.masses.iter().map(rigid).collect(),
            loads: loads.loads,
            gravity: Complex64::new(gravity[0], gravity[1]),
            driven,
            chain,
            description,
        })
    }

    /// Bodies and joints.
    pub fn description(&self) -> &Description {
        &self.description
    }

    /// Degrees of freedom, by count: unknowns less equations of closure.
    pub fn freedoms(&self) -> i64 {
        let rows: usize = self.chain.closures.iter().map(|c| c.rows()).sum();
        self.chain.unknowns as i64 - rows as i64
    }
}

#[cfg(test)]
mod tests;
