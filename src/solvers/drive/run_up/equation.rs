//! The equation of motion of the crank.

use super::drive::Drive;
use super::model::{Coefficients, ModelError, ReducedModel};
use super::motor::OutsideTable;

/// Why the equation has no right-hand side.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum EquationError {
    /// The linkage has no coefficients there.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// The motor's table ends.
    #[error(transparent)]
    Motor(#[from] OutsideTable),
    /// Nothing to accelerate: `I_n + I_1` is zero.
    #[error(
        "the reduced inertia I_n + I_1 is {value} kg·m² at the crank angle {phi} rad; it must be positive"
    )]
    NoInertia {
        /// Crank angle in radians.
        phi: f64,
        /// I_n + I_1.
        value: f64,
    },
}

/// Everything that acts on the crank at one angle and speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Forces {
    /// Coefficients of the linkage.
    pub linkage: Coefficients,
    /// I_n + I_1 in kg·m².
    pub inertia: f64,
    /// Motor's torque at the crank, N·m.
    pub motor: f64,
    /// Torque of the resistance, N·m, negative while the crank turns forward.
    pub resistance: f64,
    /// `dψ/dt` in rad/s².
    pub acceleration: f64,
    /// `∂(dψ/dt)/∂ψ` in 1/s.
    pub damping: f64,
}

/// `dψ/dt = (M_d(ψ) + M_r(ψ) + M_o(φ) − ½ ψ² dI_n/dφ) / (I_n(φ) + I_1)`, `dφ/dt = ψ`.
///
/// Zinchenko 2008, (1), with his I_1 (zero in the paper, so left out of his I_n) and a resistance
/// M_r beside the weights. M_o is a moment with its sign: negative while the screen is lifted. It
/// is the power balance `d(½ (I_n + I_1) ψ²)/dt = (M_d + M_r + M_o) ψ` solved for the
/// acceleration.
#[derive(Clone, Copy)]
pub struct Equation<'a> {
    model: &'a dyn ReducedModel,
    drive: &'a Drive,
}

impl<'a> Equation<'a> {
    /// The motion of `model` under `drive`.
    pub fn new(model: &'a dyn ReducedModel, drive: &'a Drive) -> Equation<'a> {
        Equation { model, drive }
    }

    /// The linkage.
    pub fn model(&self) -> &'a dyn ReducedModel {
        self.model
    }

    /// The drive.
    pub fn drive(&self) -> &'a Drive {
        self.drive
    }

    /// The forces at the beginning of a run while the crank turns in the direction `sign` (±1, the
    /// side that a constant resistance takes).
    ///
    /// # Errors
    /// [`EquationError`].
    pub fn forces(&self, phi: f64, psi: f64, sign: f64) -> Result<Forces, EquationError> {
        self.forces_at(0.0, phi, psi, sign)
    }

    /// The same at a time in s, for motors whose torque depends on it.
    ///
    /// # Errors
    /// [`EquationError`].
    pub fn forces_at(
        &self,
        time: f64,
        phi: f64,
        psi: f64,
        sign: f64,
    ) -> Result<Forces, EquationError> {
        let c = self.model.coefficients(phi)?;
        if !(c.inertia >= 0.0) {
            let value = c.inertia;
            return Err(ModelError::Inertia { phi, value }.into());
        }
        let inertia = c.inertia + self.drive.inertia();
        if !(inertia > 0.0 && inertia.is_finite()) {
            return Err(EquationError::NoInertia {
                phi,
                value: inertia,
            });
        }
        let (motor, motor_slope) = self.drive.motor_torque_at(time, psi)?;
        let (resistance, resistance_slope) = self.drive.resisting_torque(psi, sign);
        let torque = motor + resistance + c.moment - 0.5 * psi * psi * c.inertia_derivative;
        Ok(Forces {
            linkage: c,
            inertia,
            motor,
            resistance,
            acceleration: torque / inertia,
            damping: (motor_slope + resistance_slope - psi * c.inertia_derivative) / inertia,
        })
    }
}
