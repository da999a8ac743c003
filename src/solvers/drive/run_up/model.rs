//! Describes what the equation of motion needs of a linkage.

use crate::class_iii::{ClassIii, ContinuationError, State};
use crate::dyad::DyadError;
use crate::reduction::Masses;
use crate::units::Angle;
use std::cell::Cell;
use std::f64::consts::TAU;

/// I_n, dI_n/dφ and M_o at one crank angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coefficients {
    /// I_n in kg·m².
    pub inertia: f64,
    /// Holds what stands for dI_n/dφ in the equation, kg·m²/rad.
    pub inertia_derivative: f64,
    /// M_o in N·m, positive when the weights drive the crank forward.
    pub moment: f64,
}

/// Why there are no coefficients at a crank angle.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ModelError {
    /// The class-III linkage cannot be followed to the angle.
    #[error(transparent)]
    Linkage(#[from] ContinuationError),
    /// The dyad cannot be joined there.
    #[error("at the crank angle {phi} rad: {source}")]
    Dyad {
        /// Crank angle in radians.
        phi: f64,
        /// Why.
        source: DyadError,
    },
    /// The mechanism cannot be followed to the angle.
    #[error(transparent)]
    Mechanism(#[from] crate::planar::PositionError),
    /// The crank angle is not finite or too large to be told from its neighbours.
    #[error("the crank angle {phi} rad is not a finite number below 1e6 rad")]
    Angle {
        /// The angle.
        phi: f64,
    },
    /// I_n is negative (a spline may undershoot) or not a number.
    #[error(
        "the reduced inertia is {value} kg·m² at the crank angle {phi} rad; it must not be negative"
    )]
    Inertia {
        /// Crank angle in radians.
        phi: f64,
        /// The value.
        value: f64,
    },
    /// The linkage is not where it was after one turn of the crank.
    #[error("the linkage is not back in its position after one turn of the crank")]
    NotPeriodic,
}

/// Crank angles beyond this, in radians, are refused.
pub(super) const LARGEST_ANGLE: f64 = 1e6;

/// A linkage with masses, seen from its crank.
pub trait ReducedModel {
    /// The coefficients at the crank angle φ in radians, counted through whole turns.
    ///
    /// # Errors
    /// [`ModelError`].
    fn coefficients(&self, phi: f64) -> Result<Coefficients, ModelError>;

    /// Crank angles in one turn at which a derivative of the coefficients jumps. The integration
    /// ends a step at each.
    fn knots(&self) -> &[f64] {
        &[]
    }

    /// Crank angles in one turn at which the driven links turn back. The integration ends a step
    /// at each and reports the passage.
    fn dead_positions(&self) -> &[f64] {
        &[]
    }
}

impl<M: ReducedModel + ?Sized> ReducedModel for &M {
    fn coefficients(&self, phi: f64) -> Result<Coefficients, ModelError> {
        (**self).coefficients(phi)
    }
    fn knots(&self) -> &[f64] {
        (**self).knots()
    }
    fn dead_positions(&self) -> &[f64] {
        (**self).dead_positions()
    }
}

pub(super) fn checked_angle(phi: f64) -> Result<f64, ModelError> {
    match phi.abs() <= LARGEST_ANGLE {
        true => Ok(phi),
        false => Err(ModelError::Angle { phi }),
    }
}

/// A class-III linkage with its exact coefficients, formulas (4), (5) and (7) of Zinchenko 2008.
///
/// The linkage is followed from the crank angle of the last call to that of the next, so it cannot
/// change its branch unseen; the value has one user at a time.
#[derive(Debug)]
pub struct ClassIiiModel {
    linkage: ClassIii,
    masses: Masses,
    here: Cell<State>,
    dead: Vec<f64>,
}

impl ClassIiiModel {
    /// The linkage on the branch of `start`.
    pub fn new(linkage: ClassIii, masses: Masses, start: State) -> ClassIiiModel {
        // Where the crank cannot turn fully, those on the way are enough.
        let dead = linkage
            .dead_positions(&start, Angle::from_rad(start.phi1 + TAU))
            .unwrap_or_else(|e| e.0);
        ClassIiiModel {
            linkage,
            masses,
            here: Cell::new(start),
            dead: dead.iter().map(|d| d.state.phi1).collect(),
        }
    }
}

impl ReducedModel for ClassIiiModel {
    fn coefficients(&self, phi: f64) -> Result<Coefficients, ModelError> {
        let state = self
            .linkage
            .follow(&self.here.get(), Angle::from_rad(phi))?;
        self.here.set(state);
        let r = self.masses.reduce(&state);
        Ok(Coefficients {
            inertia: r.inertia_kg_m2,
            inertia_derivative: r.inertia_derivative_kg_m2,
            moment: r.moment_n_m,
        })
    }

    fn dead_positions(&self) -> &[f64] {
        &self.dead
    }
}

/// A crank with a fixed inertia and no weights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConstantInertia(
    /// I in kg·m².
    pub f64,
);

impl ReducedModel for ConstantInertia {
    fn coefficients(&self, phi: f64) -> Result<Coefficients, ModelError> {
        checked_angle(phi)?;
        Ok(Coefficients {
            inertia: self.0,
            inertia_derivative: 0.0,
            moment: 0.0,
        })
    }
}

/// The smallest and largest I_n found over one turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InertiaRange {
    /// Smallest found, kg·m².
    pub least: f64,
    /// Crank angle there, rad.
    pub least_at: f64,
    /// Largest found, kg·m².
    pub most: f64,
}

/// The range of I_n over a turn from `from` on, by 720 samples and the dead positions.
///
/// # Errors
/// [`ModelError`], as for instance where the crank does not turn fully.
pub fn inertia_range(model: &dyn ReducedModel, from: f64) -> Result<InertiaRange, ModelError> {
    let mut range = InertiaRange {
        least: f64::INFINITY,
        least_at: from,
        most: 0.0,
    };
    let dead = model
        .dead_positions()
        .iter()
        .map(|d| from + (d - from).rem_euclid(TAU));
    let mut angles: Vec<f64> = (0..720)
        .map(|k| from + TAU * f64::from(k) / 720.0)
        .chain(dead)
        .collect();
    angles.sort_by(f64::total_cmp);
    for phi in angles {
        let i = model.coefficients(phi)?.inertia;
        if i < range.least {
            (range.least, range.least_at) = (i, phi);
        }
        range.most = range.most.max(i);
    }
    Ok(range)
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::class_iii::tests::{paper, zinchenko};
    use crate::reduction::tests::recovered;

    /// The sand screen with the recovered masses, from the paper's first row.
    pub(crate) fn sand_screen() -> ClassIiiModel {
        ClassIiiModel::new(zinchenko(), recovered(), paper(START))
    }

    /// 14.426°.
    pub(crate) const START: f64 = 0.251_781_197_892_702;

    #[test]
    fn the_screen_is_light_at_its_dead_positions() {
        let model = sand_screen();
        let range = inertia_range(&model, START).unwrap();
        assert!((range.least - 0.034_350_5).abs() < 2e-6, "{range:?}");
        assert!((range.most - 5.63).abs() < 0.02, "{range:?}");
        assert_eq!(model.dead_positions().len(), 2);
        // Whole turns on, the same values.
        let (a, b) = (
            model.coefficients(1.0).unwrap(),
            model.coefficients(1.0 + 3.0 * TAU).unwrap(),
        );
        assert!((a.inertia - b.inertia).abs() < 1e-13);
        assert!(model.coefficients(f64::NAN).is_err());
        assert!(model.coefficients(1e7).is_err());
    }
}
