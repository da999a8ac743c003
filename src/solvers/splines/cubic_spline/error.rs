//! Why there is no spline, and why it has no value.

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
    /// More knots than [`UniformKnots::MAX_SEGMENTS`](super::UniformKnots::MAX_SEGMENTS) allows.
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
    /// The point is outside the knots and [`Extrapolation::Error`](super::Extrapolation::Error) is
    /// in force.
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
