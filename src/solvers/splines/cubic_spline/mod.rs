//! Interpolating cubic splines in second-derivative form.
//!
//! Between two knots a distance `h` apart, with `k = (x − x_i)/h`, `w = (x_{i+1} − x)/h = 1 − k`,
//! ordinates `y` and second derivatives `m`:
//!
//! ```text
//! S''' = (m_{i+1} − m_i) / h
//! S''  = w m_i + k m_{i+1}                                                               (8)
//! S'   = (y_{i+1} − y_i)/h + h/6 ((3k² − 1) m_{i+1} − (3w² − 1) m_i)                    (11)
//! S    = w y_i + k y_{i+1} − h²/6 · k w ((1 + w) m_i + (1 + k) m_{i+1})                 (12)
//! ```
//!
//! The `m_i` make `S'` continuous: `m_{i−1} + 4 m_i + m_{i+1} = (6/h²)(y_{i−1} − 2 y_i + y_{i+1})`
//! (16) for equal steps, `h_{i−1} m_{i−1} + 2 (h_{i−1} + h_i) m_i + h_i m_{i+1} = 6 (δ_i − δ_{i−1})`
//! with `δ_i = (y_{i+1} − y_i)/h_i` otherwise. Two more equations come from the [`Boundary`].
//! Beside an end with a given slope s, where (11) would subtract ordinates that hardly matter there,
//! `S' = s − w h (S'' + m_n)/2` and its like at the other end: exactly s at the end itself.
//!
//! [`CubicSpline`] takes arbitrary increasing knots, [`UniformCubicSpline`] the knots `x_0 + i h`
//! taken exactly, with a faster fit. Both evaluate with the same code; single points, batches and
//! sorted batches give bit-identical results. At a knot `S'''` is that of the segment to the
//! right, at the last knot that of the last segment.
//!
//! # Accuracy
//! Worst found over 200 random cases in each of four or five regions for each kind of ends and the
//! worst inputs of earlier hunts, as a multiple of `u (|f| + Σ_j |x_j ∂f/∂x_j|)` with `u = 2⁻⁵³`: 4.2
//! for `S'`, 4.0 for `S`, 3.4 for everything else. `mechaudit audit cubic-spline-…` repeats the search.
//!
//! # Source
//! Zinchenko 2008, eqs (8)–(17), numbers above. The form of (11) and (12) here is algebraically
//! theirs but symmetric in `k` and `w`, each computed from its own difference of abscissae, so that
//! weights near 0 keep their relative accuracy and `S(x_i) = y_i` holds at both ends.

mod batch;
mod evaluate;
mod fit;
mod grid;
mod lookup;
mod uniform;

pub use evaluate::{Extrapolation, Jet};
pub use grid::{Grid, Knots, UniformKnots};

/// What is asked of a spline at one end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum End {
    /// The second derivative there, eq. (17); 0 is the natural end.
    SecondDerivative(f64),
    /// The first derivative there (clamped).
    FirstDerivative(f64),
    /// The third derivative is continuous at the neighbouring knot.
    NotAKnot,
}

/// The two equations that the interior knots leave open.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Boundary {
    /// One condition at each end.
    Ends(End, End),
    /// First and second derivative agree at the two ends; the first and last ordinate must be
    /// equal.
    Periodic,
}

impl Boundary {
    /// Zero second derivative at both ends.
    pub const NATURAL: Boundary =
        Boundary::Ends(End::SecondDerivative(0.0), End::SecondDerivative(0.0));
    /// Not-a-knot at both ends. Two knots give the line, three the parabola.
    pub const NOT_A_KNOT: Boundary = Boundary::Ends(End::NotAKnot, End::NotAKnot);

    /// Given first derivatives at both ends.
    pub const fn clamped(first: f64, last: f64) -> Boundary {
        Boundary::Ends(End::FirstDerivative(first), End::FirstDerivative(last))
    }

    /// Given second derivatives at both ends.
    pub const fn second_derivatives(first: f64, last: f64) -> Boundary {
        Boundary::Ends(End::SecondDerivative(first), End::SecondDerivative(last))
    }

    fn known(self) -> [Known; 2] {
        let known = |end| match end {
            End::FirstDerivative(v) => Known::First(v),
            _ => Known::Nothing,
        };
        match self {
            Boundary::Periodic => [Known::Nothing; 2],
            Boundary::Ends(first, last) => [first, last].map(known),
        }
    }
}

/// Why there is no spline.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CubicSplineError {
    /// Fewer knots than the end conditions need.
    #[error("{got} knots, at least {needed} are needed")]
    TooFewKnots {
        /// The least number.
        needed: usize,
        /// The number given.
        got: usize,
    },
    /// More knots than [`UniformKnots::MAX_SEGMENTS`] allows.
    #[error("{got} uniform knots, at most 2^26 + 1 are allowed")]
    TooManyKnots {
        /// The number given.
        got: usize,
    },
    /// Not as many ordinates as knots.
    #[error("{values} values for {knots} knots")]
    Length {
        /// Number of knots.
        knots: usize,
        /// Number of ordinates.
        values: usize,
    },
    /// A number that is not finite.
    #[error("{name}[{index}] = {value} is not finite")]
    NotFinite {
        /// `knots`, `values`, `ends` or `origin`.
        name: &'static str,
        /// The place.
        index: usize,
        /// The number.
        value: f64,
    },
    /// Knots that do not increase.
    #[error("knots[{index}] = {value} is not greater than its predecessor {previous}")]
    NotIncreasing {
        /// The place of the later knot.
        index: usize,
        /// The earlier knot.
        previous: f64,
        /// The later knot.
        value: f64,
    },
    /// A step that is not positive and finite, or too small to tell the knots apart.
    #[error(
        "step {value} is not a positive number of at least four units in the last place of the knots"
    )]
    Step {
        /// The step.
        value: f64,
    },
    /// A periodic spline through different end ordinates.
    #[error("the first ordinate {first} and the last {last} of a periodic spline differ")]
    NotPeriodic {
        /// The first ordinate.
        first: f64,
        /// The last ordinate.
        last: f64,
    },
    /// The spline does not fit in `f64`: a knot or ordinate beyond 2^1000, or a step or a second
    /// derivative that over- or underflows.
    #[error("the spline overflows or underflows at knot {knot}")]
    Overflow {
        /// The knot.
        knot: usize,
    },
}

/// Why there is no value at a point.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum EvaluationError {
    /// The point is not a finite number.
    #[error("x[{index}] = {x} is not finite")]
    NotFinite {
        /// Place in the batch, 0 for a single point.
        index: usize,
        /// The point.
        x: f64,
    },
    /// The point is outside the knots and [`Extrapolation::Error`] is in force.
    #[error("x[{index}] = {x} is outside [{first}, {last}]")]
    Outside {
        /// Place in the batch, 0 for a single point.
        index: usize,
        /// The point.
        x: f64,
        /// The first knot.
        first: f64,
        /// The last knot.
        last: f64,
    },
    /// A batch said to be sorted is not.
    #[error("x[{index}] is smaller than its predecessor")]
    NotSorted {
        /// Place in the batch.
        index: usize,
    },
    /// Input and output of a batch have different lengths.
    #[error("{points} points, room for {room} values")]
    Length {
        /// Number of points.
        points: usize,
        /// Length of the output.
        room: usize,
    },
}

/// What the condition at an end makes known beside it.
#[derive(Clone, Copy, Debug)]
enum Known {
    Nothing,
    /// The first derivative at the end, as given.
    First(f64),
    /// The third derivative, which not-a-knot makes common to two segments.
    Third(f64),
}

/// A cubic spline on the knots `G`.
#[derive(Clone, Debug)]
pub struct Spline<G: Grid> {
    grid: G,
    y: Vec<f64>,
    /// Second derivatives in the grid's own scale, see [`Grid`].
    bend: Vec<f64>,
    known: [Known; 2],
    extrapolation: Extrapolation,
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

    /// What happens outside the knots.
    pub fn extrapolation(&self) -> Extrapolation {
        self.extrapolation
    }

    /// The same spline with another behaviour outside the knots.
    pub fn with_extrapolation(mut self, extrapolation: Extrapolation) -> Self {
        self.extrapolation = extrapolation;
        self
    }
}

#[cfg(test)]
mod batch_tests;
#[cfg(test)]
mod limit_tests;
#[cfg(test)]
mod tests;
