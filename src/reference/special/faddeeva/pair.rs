//! The two functions that share their series.

/// Which function of the pair: both come from the same series.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Member {
    /// `w(z)`.
    W,
    /// `w(z) − e^{−z²} = (2i/√π) F(z)`, F Dawson's function; in the first quadrant only.
    Dawson,
}
