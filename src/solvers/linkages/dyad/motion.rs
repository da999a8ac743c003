//! How a dyad is joined, and how points and links move.

use super::error::DyadError;
use crate::units::{Angle, AngularVelocity};

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

    pub(super) fn check(&self, what: &'static str) -> Result<(), DyadError> {
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
