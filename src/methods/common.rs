//! What many methods write.

use crate::audit::{CheckPoint, Draw, Region};

pub(super) fn region(
    name: &'static str,
    description: &'static str,
    sample: fn(&mut Draw) -> Vec<f64>,
) -> Region {
    Region {
        name,
        description,
        sample,
    }
}

pub(super) fn point(name: &'static str, input: impl Into<Vec<f64>>) -> CheckPoint {
    CheckPoint {
        name,
        input: input.into(),
    }
}

/// The residual of a law that holds bit for bit or not at all.
pub(super) fn held(held: bool) -> Option<f64> {
    Some(if held { 0.0 } else { f64::INFINITY })
}
