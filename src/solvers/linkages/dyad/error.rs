//! Why a dyad or a linkage has no answer.

use crate::hex::hex;

/// Lengths of one linkage may differ by at most this factor, `2^100 ≈ 1.3e30`.
pub const MAX_LENGTH_RATIO: f64 = hex("0x1p100");

/// Why a dyad or a linkage has no answer.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DyadError {
    /// An input is NaN or infinite.
    #[error("{what} is {value}; it has to be finite")]
    NotFinite {
        /// Which input.
        what: &'static str,
        /// Its value in SI units.
        value: f64,
    },
    /// A length that has to be positive is not.
    #[error("{what} is {value_m} m; it has to be greater than zero")]
    NotPositive {
        /// Which length.
        what: &'static str,
        /// Its value in metres.
        value_m: f64,
    },
    /// The lengths differ by more than [`MAX_LENGTH_RATIO`].
    #[error(
        "the longest length is {longest_m} m and the shortest {shortest_m} m; they may differ by at most a factor 2^100"
    )]
    LengthRatio {
        /// The longest, in metres.
        longest_m: f64,
        /// The shortest, in metres.
        shortest_m: f64,
    },
    /// The links cannot be joined in any position.
    #[error(
        "the {what} of {longest_m} m has to be shorter than the other lengths together, {others_m} m"
    )]
    CannotClose {
        /// Which length is too long.
        what: &'static str,
        /// The length in metres.
        longest_m: f64,
        /// The sum of the others in metres.
        others_m: f64,
    },
    /// The dyad cannot be joined in this position.
    #[error("the dyad has to span {span_m} m, but spans only from {least_m} m to {most_m} m")]
    Unreachable {
        /// The distance to be spanned, in metres.
        span_m: f64,
        /// The least it can span, in metres.
        least_m: f64,
        /// The most it can span, in metres.
        most_m: f64,
    },
    /// Both links of the dyad lie on one line, or its outer joints coincide: the determinant of
    /// the velocity equations is zero.
    #[error(
        "the dyad spans {span_m} m, an end of its range from {least_m} m to {most_m} m; its determinant has to differ from zero"
    )]
    Singular {
        /// The distance spanned, in metres.
        span_m: f64,
        /// The least it can span, in metres.
        least_m: f64,
        /// The most it can span, in metres.
        most_m: f64,
    },
    /// A column has not as many places as there are angles.
    #[error("a column has {room} places, {angles} are needed")]
    Room {
        /// The number of angles.
        angles: usize,
        /// The number of places.
        room: usize,
    },
    /// A result exceeds the range of `f64`.
    #[error("{what} exceeds the range of f64")]
    Overflow {
        /// Which result.
        what: &'static str,
    },
}

impl DyadError {
    /// The error's name in one or two lower-case words.
    pub fn name(&self) -> &'static str {
        match self {
            DyadError::NotFinite { .. } => "not finite",
            DyadError::NotPositive { .. } => "not positive",
            DyadError::LengthRatio { .. } => "length ratio",
            DyadError::CannotClose { .. } => "cannot close",
            DyadError::Unreachable { .. } => "unreachable",
            DyadError::Singular { .. } => "singular",
            DyadError::Room { .. } => "room",
            DyadError::Overflow { .. } => "overflow",
        }
    }
}
