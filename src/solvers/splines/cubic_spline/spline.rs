//! A spline: its knots, ordinates and second derivatives.

use super::boundary::Known;
use super::grid::{Grid, Knots, UniformKnots};

/// Describes what a spline is outside its knots.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Extrapolation {
    /// [`EvaluationError::Outside`](super::EvaluationError::Outside).
    #[default]
    Error,
    /// The cubic of the first or last segment goes on.
    EndPolynomial,
    /// The tangent at the end goes on.
    Linear,
    /// The ordinate of the end is held, with zero derivatives.
    Clamp,
    /// The spline repeats with the period `last − first`. Smooth only for a periodic spline.
    Wrap,
}

/// A cubic spline on the knots `G`.
#[derive(Clone, Debug)]
pub struct Spline<G: Grid> {
    pub(super) grid: G,
    pub(super) y: Vec<f64>,
    /// Second derivatives in the grid's own scale, see [`Grid`].
    pub(super) bend: Vec<f64>,
    pub(super) known: [Known; 2],
    /// See [`plain`](super::evaluate::plain).
    pub(super) plain: (f64, f64),
    pub(super) extrapolation: Extrapolation,
}

/// A cubic spline on arbitrary increasing knots.
///
/// ```
/// use mechaudit_solvers::cubic_spline::{Boundary, CubicSpline};
/// let x = vec![0.0, 1.0, 2.5, 4.0];
/// let y = x.iter().map(|x| x * x * x).collect();
/// let s = CubicSpline::fit(x, y, Boundary::second_derivatives(0.0, 24.0))?;
/// assert!((s.value(3.0)? - 27.0).abs() < 1e-13);
/// assert!((s.integral(0.0, 4.0)? - 64.0).abs() < 1e-13);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub type CubicSpline = Spline<Knots>;

/// A cubic spline on equally spaced knots.
///
/// ```
/// use mechaudit_solvers::cubic_spline::{Boundary, UniformCubicSpline};
/// let y = (0..=10).map(|i| (i as f64 * 0.1).sin()).collect();
/// let s = UniformCubicSpline::fit(0.0, 0.1, y, Boundary::clamped(1.0, 1f64.cos()))?;
/// assert!((s.value(0.55)? - 0.55f64.sin()).abs() < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub type UniformCubicSpline = Spline<UniformKnots>;

impl<G: Grid> Spline<G> {
    /// The knots.
    pub fn grid(&self) -> &G {
        &self.grid
    }

    /// The ordinates.
    pub fn values_at_knots(&self) -> &[f64] {
        &self.y
    }

    /// The second derivatives `m_i` at the knots.
    pub fn second_derivatives(&self) -> Vec<f64> {
        let f = self.grid.second_per_bend();
        self.bend.iter().map(|b| b * f).collect()
    }

    /// Returns what happens outside the knots.
    pub fn extrapolation(&self) -> Extrapolation {
        self.extrapolation
    }

    /// The same spline with another behaviour outside the knots.
    pub fn with_extrapolation(mut self, extrapolation: Extrapolation) -> Self {
        self.extrapolation = extrapolation;
        self
    }
}
