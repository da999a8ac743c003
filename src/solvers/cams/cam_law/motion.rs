//! Describes what a law gives, and what laws are compared by.

use crate::double_double::Dd;

/// Displacement of a law and its derivatives in `x`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Motion {
    /// `s`.
    pub displacement: f64,
    /// `s'`.
    pub velocity: f64,
    /// `s''`; at a jump the value to the right, at the end of the stroke that to the left.
    pub acceleration: f64,
    /// `s'''`, likewise; jumps of the acceleration are not in it.
    pub jerk: f64,
}

impl Motion {
    pub(super) fn scaled(self, f: f64) -> Motion {
        Motion {
            displacement: f * self.displacement,
            velocity: f * self.velocity,
            acceleration: f * self.acceleration,
            jerk: f * self.jerk,
        }
    }
}

/// A factor for [`times`]: beyond the range of `f64` infinite without a second part.
pub(super) fn factor(x: Dd) -> Dd {
    match x.hi.is_finite() && x.lo.is_finite() {
        true => x,
        false => Dd::from(x.hi),
    }
}

/// A number by a factor in two parts, rounded once.
pub(super) fn times(x: f64, factor: Dd) -> f64 {
    x.mul_add(factor.hi, x * factor.lo)
}

/// The constants that laws are compared by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peaks {
    /// C_v, the largest `|s'|`.
    pub velocity: f64,
    /// C_a while accelerating, the largest `s''`; infinite if the velocity jumps at an end.
    pub acceleration: f64,
    /// C_a while decelerating, the largest `−s''`.
    pub deceleration: f64,
    /// C_j, the largest `|s'''|`; infinite if the acceleration jumps.
    pub jerk: f64,
}

/// Names that [`MotionLaw::by_name`](super::MotionLaw::by_name) knows.
pub const NAMES: [&str; 9] = [
    "0050",
    "К",
    "constant-acceleration",
    "simple-harmonic",
    "modified-trapezoid",
    "modified-sine",
    "cycloidal",
    "3-4-5",
    "4-5-6-7",
];
