//! A planar mechanism of any structure, reduced to its drive.

use super::model::{Coefficients, ModelError, ReducedModel, checked_angle};
use crate::planar::{Loads, Mechanism, State};
use std::cell::RefCell;

/// A planar mechanism with its masses and loads.
///
/// It is followed from the drive's value of the last call to that of the next, so it cannot change
/// its branch unseen; the value has one user at a time.
#[derive(Debug)]
pub struct PlanarModel {
    mechanism: Mechanism,
    loads: Loads,
    here: RefCell<State>,
    offset: f64,
}

/// Why a mechanism has no such model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PlanarModelError {
    /// Dampers act with the speed, which the coefficients do not know.
    #[error("a run-up takes no dampers in the mechanism; give [load] at the crank instead")]
    Dampers,
    /// The drive is a displacement.
    #[error("a run-up needs a drive by angle")]
    Displacement,
}

impl PlanarModel {
    /// The mechanism on the branch of `start`; the crank angle is the drive plus `offset` radians.
    ///
    /// # Errors
    /// [`PlanarModelError`].
    pub fn new(
        mechanism: Mechanism,
        loads: Loads,
        start: State,
        offset: f64,
    ) -> Result<PlanarModel, PlanarModelError> {
        if loads.has_dampers() {
            return Err(PlanarModelError::Dampers);
        }
        if mechanism.drive_is_displacement() {
            return Err(PlanarModelError::Displacement);
        }
        Ok(PlanarModel {
            mechanism,
            loads,
            here: RefCell::new(start),
            offset,
        })
    }
}

impl ReducedModel for PlanarModel {
    fn coefficients(&self, phi: f64) -> Result<Coefficients, ModelError> {
        checked_angle(phi)?;
        let mut here = self.here.borrow_mut();
        *here = self.mechanism.follow(&here, phi - self.offset)?;
        let r = self.loads.reduce(&self.mechanism, &here);
        Ok(Coefficients {
            inertia: r.inertia,
            inertia_derivative: r.inertia_derivative,
            moment: r.moment,
        })
    }
}
