//! The one thing that can be wrong with a batch.

/// A slice beside the first one differs from it in length.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{points} points beside a slice of {values}: all slices have to be equally long")]
pub struct LengthMismatch {
    /// Points given.
    pub points: usize,
    /// Length of the slice for values (or of another one) that differs.
    pub values: usize,
}

pub(super) fn same_length<const N: usize>(
    points: usize,
    others: [usize; N],
) -> Result<(), LengthMismatch> {
    match others.into_iter().find(|&n| n != points) {
        None => Ok(()),
        Some(values) => Err(LengthMismatch { points, values }),
    }
}
