//! Constants of an integration.

use super::motor::Characteristic;
use crate::Ball;

/// The constants of a run.
pub(super) struct Setting {
    pub bits: u32,
    pub order: usize,
    /// Half the width of a panel in radians.
    pub half_width: Ball,
    /// I_1.
    pub rotor: Ball,
    /// Along the path.
    pub motor: Characteristic,
    /// True if φ falls along the path.
    pub backward: bool,
}

/// Why a step could not be proved.
pub(super) type Refusal = &'static str;
