//! Trajectories of a problem, kept for a while: rows with the same inputs share one.

use crate::reference::Ball;
use mechaudit_symbolic::evaluation::{
    Derivatives, Goal, InitialValueProblem, Limits, MotionError, Trajectory,
};
use rug::Rational;
use std::sync::{Arc, Mutex, PoisonError};

/// The most trajectories that are kept; each holds the series of all its steps.
const KEPT: usize = 8;

/// A trajectory with its inputs.
type Kept = (Vec<Rational>, Arc<Mutex<Trajectory>>);

/// The solutions of a problem.
pub struct Trajectories {
    problem: InitialValueProblem,
    limits: Limits,
    /// The one used last comes last.
    kept: Mutex<Vec<Kept>>,
}

impl Trajectories {
    pub fn new(problem: InitialValueProblem, limits: Limits) -> Trajectories {
        Trajectories {
            problem,
            limits,
            kept: Mutex::default(),
        }
    }

    /// The number of states.
    pub fn states(&self) -> usize {
        self.problem.states().len()
    }

    /// Sets the highest working precision in bits.
    pub fn set_limit(&mut self, bits: u32) {
        self.limits.bits = bits;
        *self.kept.get_mut().unwrap_or_else(PoisonError::into_inner) = Vec::new();
    }

    /// The states at a time.
    ///
    /// # Errors
    /// As [`Trajectory::at`].
    pub fn at(
        &self,
        inputs: &[Rational],
        time: &Rational,
        goal: Goal,
    ) -> Result<Vec<Ball>, MotionError> {
        self.with(inputs, |trajectory| trajectory.at(time, goal))
    }

    /// The derivatives of the states at a time.
    ///
    /// # Errors
    /// As [`Trajectory::derivatives`].
    pub fn derivatives(
        &self,
        inputs: &[Rational],
        time: &Rational,
    ) -> Result<Derivatives, MotionError> {
        self.with(inputs, |trajectory| trajectory.derivatives(time))
    }

    fn with<T>(
        &self,
        inputs: &[Rational],
        of: impl FnOnce(&mut Trajectory) -> Result<T, MotionError>,
    ) -> Result<T, MotionError> {
        let trajectory = self.trajectory(inputs)?;
        // A trajectory that a panic left behind may be half extended.
        match trajectory.lock() {
            Ok(mut trajectory) => of(&mut trajectory),
            Err(_) => of(&mut self.problem.trajectory(inputs, self.limits)?),
        }
    }

    fn trajectory(&self, inputs: &[Rational]) -> Result<Arc<Mutex<Trajectory>>, MotionError> {
        let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        let found = match kept.iter().position(|k| k.0 == inputs) {
            Some(place) => kept.remove(place),
            None => {
                let new = self.problem.trajectory(inputs, self.limits)?;
                (inputs.to_vec(), Arc::new(Mutex::new(new)))
            }
        };
        if kept.len() >= KEPT {
            kept.remove(0);
        }
        let trajectory = found.1.clone();
        kept.push(found);
        Ok(trajectory)
    }
}
