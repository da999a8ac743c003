//! The one thing that can be wrong with a batch.

/// The slice for the values is not as long as that of the points.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "{values} values cannot be written for {points} points: both slices have to be equally long"
)]
pub struct LengthMismatch {
    /// Points given.
    pub points: usize,
    /// Places for values given.
    pub values: usize,
}

pub(super) fn same_length(points: usize, values: usize) -> Result<(), LengthMismatch> {
    if points == values {
        Ok(())
    } else {
        Err(LengthMismatch { points, values })
    }
}
