//! Class-II Assur groups (dyads) and the two linkages built from a crank and one dyad.
//!
//! An Assur group of class II, or dyad, is two links and three joints that add no freedom to the
//! mechanism they are joined to. Two of the kinds are here: [`RrrDyad`] (three revolute joints)
//! and [`RrpDyad`] (the outer joint of the second link slides on a fixed guide). With a crank they
//! give the [`FourBar`] and the [`SliderCrank`].
//!
//! # Derivatives
//! Every motion is differentiated with respect to one parameter; for the linkages it is the crank
//! angle φ1, so that `φ' = dφ/dφ1` and `φ'' = d²φ/dφ1²` depend on the geometry alone. For a crank
//! with angular velocity ω1 and angular acceleration ε1
//!
//! ```text
//! ω = φ' ω1          ε = φ'' ω1² + φ' ε1
//! ```
//!
//! which is [`LinkMotion::angular_velocity`] and [`LinkMotion::angular_acceleration_rad_per_s2`].
//!
//! # Accuracy
//! Differences of squares are computed as products, triangle angles by half-angle formulas with
//! `atan2`, and lengths are first multiplied by a power of two, so that neither overflow nor
//! underflow disturbs a result and a scaling by powers of two leaves every angle bit for bit
//! unchanged.
//!
//! # Source
//! I. I. Artobolevskii, *Theory of Mechanisms and Machines*, the chapters on the classification
//! and on the analytical kinematics of class-II groups; for four-bar types F. Grashof,
//! *Theoretische Maschinenlehre*, vol. 2 (1883). The formulas are derived at each function from
//! the loop equation, numbered (1) to (8).

mod four_bar;
#[cfg(test)]
mod limit_tests;
mod linkage_type;
mod numeric;
mod rrp;
mod rrr;
mod slider_crank;
#[cfg(test)]
mod tests;

pub use four_bar::{FourBar, FourBarMotion};
pub use linkage_type::{CrankRange, DeadPosition, DeadPositions, GrashofType};
pub use rrp::{Guide, RrpDyad, RrpMotion};
pub use rrr::{RrrDyad, RrrMotion};
pub use slider_crank::{DeadCentre, DeadCentres, SliderCrank, SliderCrankMotion};

use crate::units::{Angle, AngularVelocity};

/// Lengths of one linkage may differ by at most this factor, `2^100 ≈ 1.3e30`.
pub const MAX_LENGTH_RATIO: f64 = 1_267_650_600_228_229_401_496_703_205_376.0;

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
            DyadError::Overflow { .. } => "overflow",
        }
    }
}

/// On which side a dyad is joined.
///
/// For the RRR dyad between `A` and `B` with the inner joint `C`: the sign of
/// `(B − A) × (C − A)`. For the RRP dyad: the sign of the rod's component along the guide, seen
/// from its revolute outer joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Assembly {
    /// `C` to the left of the line from `A` to `B`; slider ahead of the rod's other end.
    Positive,
    /// `C` to the right; slider behind.
    Negative,
}

impl Assembly {
    /// `1` or `−1`.
    pub fn sign(self) -> f64 {
        match self {
            Assembly::Positive => 1.0,
            Assembly::Negative => -1.0,
        }
    }

    /// The other one.
    pub fn mirrored(self) -> Assembly {
        match self {
            Assembly::Positive => Assembly::Negative,
            Assembly::Negative => Assembly::Positive,
        }
    }
}

/// A point of the plane with its first two derivatives with respect to the parameter.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PointMotion {
    /// Coordinates in metres.
    pub position_m: [f64; 2],
    /// First derivative, in metres for each unit of the parameter.
    pub first_m: [f64; 2],
    /// Second derivative, in metres for each unit of the parameter squared.
    pub second_m: [f64; 2],
}

impl PointMotion {
    /// A point at rest.
    pub fn fixed(position_m: [f64; 2]) -> PointMotion {
        PointMotion {
            position_m,
            ..PointMotion::default()
        }
    }

    fn check(&self, what: &'static str) -> Result<(), DyadError> {
        let all = [self.position_m, self.first_m, self.second_m];
        match all.as_flattened().iter().find(|x| !x.is_finite()) {
            Some(&value) => Err(DyadError::NotFinite { what, value }),
            None => Ok(()),
        }
    }
}

/// The angle of a link with its first two derivatives with respect to the parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinkMotion {
    /// The angle, from the x-axis, counter-clockwise positive.
    pub angle: Angle,
    /// `φ'`, in radians for each unit of the parameter.
    pub first: f64,
    /// `φ''`, in radians for each unit of the parameter squared.
    pub second: f64,
}

impl LinkMotion {
    /// `ω = φ' ω1`, for a parameter (crank angle) that changes at the rate `crank`.
    pub fn angular_velocity(&self, crank: AngularVelocity) -> AngularVelocity {
        AngularVelocity::from_rad_per_s(self.first * crank.rad_per_s())
    }

    /// `ε = φ'' ω1² + φ' ε1` in rad/s², with `ε1` in rad/s².
    ///
    /// ```
    /// use mechaudit_solvers::dyad::LinkMotion;
    /// use mechaudit_solvers::units::{Angle, AngularVelocity};
    /// let link = LinkMotion { angle: Angle::from_rad(0.0), first: 0.5, second: -2.0 };
    /// let w = AngularVelocity::from_rad_per_s(10.0);
    /// assert_eq!(link.angular_velocity(w).rad_per_s(), 5.0);
    /// assert_eq!(link.angular_acceleration_rad_per_s2(w, 4.0), -198.0);
    /// ```
    pub fn angular_acceleration_rad_per_s2(
        &self,
        crank: AngularVelocity,
        crank_acceleration_rad_per_s2: f64,
    ) -> f64 {
        let w = crank.rad_per_s();
        self.second * w * w + self.first * crank_acceleration_rad_per_s2
    }
}
