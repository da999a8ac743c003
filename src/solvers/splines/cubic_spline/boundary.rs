//! The conditions at the ends.

/// Describes what is asked of a spline at one end.
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

    pub(super) fn known(self) -> [Known; 2] {
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

/// Describes what the condition at an end makes known beside it.
#[derive(Clone, Copy, Debug)]
pub(super) enum Known {
    Nothing,
    /// The first derivative at the end, as given.
    First(f64),
    /// The third derivative, which not-a-knot makes common to two segments.
    Third(f64),
}
