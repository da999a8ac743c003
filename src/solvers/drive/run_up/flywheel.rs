//! The flywheel that keeps the fluctuation of the steady cycle to a wanted δ.

use super::equation::Equation;
use super::integrate::{Counts, Settings};
use super::motor_error::MotorError;
use super::steady::{Cycle, CycleError, steady_cycle};
use crate::units::Inertia;

/// A flywheel and the cycle that it gives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flywheel {
    /// Inertia to add at the crank, kg·m²; zero where none is needed.
    pub inertia: f64,
    /// The cycle with it.
    pub cycle: Cycle,
    /// Holds what the search cost.
    pub counts: Counts,
}

/// Why there is no flywheel.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FlywheelError {
    /// The fluctuation asked for makes no sense.
    #[error("the coefficient of fluctuation {value} must lie between 1e-6 and 2")]
    Fluctuation {
        /// The value.
        value: f64,
    },
    /// A cycle could not be found.
    #[error("with {inertia} kg·m² of flywheel: {source}")]
    Cycle {
        /// Flywheel inertia, kg·m².
        inertia: f64,
        /// Why.
        source: CycleError,
    },
    /// The drive refuses the inertia.
    #[error(transparent)]
    Drive(#[from] MotorError),
    /// No flywheel up to this size is enough, or the search did not close in.
    #[error("no flywheel up to {inertia} kg·m² gives the fluctuation {wanted}; it gives {found}")]
    NotFound {
        /// The largest tried, kg·m².
        inertia: f64,
        /// δ asked for.
        wanted: f64,
        /// δ with the largest tried.
        found: f64,
    },
}

/// Doublings of the flywheel at most: from a ten-thousandth of I_n to a thousand million times it.
const DOUBLINGS: u32 = 45;
/// Steps of the search between two sizes; each at least halves every third interval.
const STEPS: u32 = 60;

/// The smallest flywheel found whose steady cycle has the coefficient of fluctuation `wanted`, to a
/// relative 1e-6; none if the machine is even enough without.
///
/// # Errors
/// [`FlywheelError`].
pub fn flywheel(
    equation: &Equation,
    phi: f64,
    guess: f64,
    wanted: f64,
    settings: Settings,
) -> Result<Flywheel, FlywheelError> {
    if !(1e-6..=2.0).contains(&wanted) {
        return Err(FlywheelError::Fluctuation { value: wanted });
    }
    let mut counts = Counts::default();
    let mut speed = guess;
    let mut with = |inertia: f64| -> Result<Cycle, FlywheelError> {
        let drive = equation
            .drive()
            .with_flywheel(Inertia::from_kg_m2(inertia))?;
        let cycle = steady_cycle(
            &Equation::new(equation.model(), &drive),
            phi,
            speed,
            settings,
        )
        .map_err(|source| FlywheelError::Cycle { inertia, source })?;
        counts = counts.plus(cycle.counts);
        speed = cycle.psi;
        Ok(cycle)
    };
    let (inertia, cycle) = search(wanted, &mut with)?;
    Ok(Flywheel {
        inertia,
        cycle,
        counts,
    })
}

/// The inertia found and the cycle with it, which `with` finds.
fn search(
    wanted: f64,
    with: &mut dyn FnMut(f64) -> Result<Cycle, FlywheelError>,
) -> Result<(f64, Cycle), FlywheelError> {
    let bare = with(0.0)?;
    if bare.fluctuation <= wanted {
        return Ok((0.0, bare));
    }
    let scale = 2.0 * bare.kinetic_energy / (bare.psi * bare.psi);
    let (mut low, mut excess_low) = (0.0, (bare.fluctuation / wanted).ln());
    let mut high = 1e-4 * scale;
    let mut cycle = with(high)?;
    for _ in 0..DOUBLINGS {
        if cycle.fluctuation <= wanted {
            break;
        }
        (low, excess_low) = (high, (cycle.fluctuation / wanted).ln());
        high *= 2.0;
        cycle = with(high)?;
    }
    let mut excess_high = (cycle.fluctuation / wanted).ln();
    if excess_high > 0.0 {
        return Err(FlywheelError::NotFound {
            inertia: high,
            wanted,
            found: cycle.fluctuation,
        });
    }
    // Regula falsi, Illinois variant, on ln(δ/δ_wanted).
    let mut side = 0;
    for _ in 0..STEPS {
        let middle = (low * excess_high - high * excess_low) / (excess_high - excess_low);
        cycle = with(middle)?;
        let excess = (cycle.fluctuation / wanted).ln();
        if excess.abs() <= 1e-6 || !(low < middle && middle < high) {
            return Ok((middle, cycle));
        }
        if excess > 0.0 {
            (low, excess_low) = (middle, excess);
            if side == 1 {
                excess_high *= 0.5;
            }
            side = 1;
        } else {
            (high, excess_high) = (middle, excess);
            if side == -1 {
                excess_low *= 0.5;
            }
            side = -1;
        }
    }
    Err(FlywheelError::NotFound {
        inertia: high,
        wanted,
        found: cycle.fluctuation,
    })
}

#[cfg(test)]
mod tests;
