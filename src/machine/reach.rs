//! The range of a drive on a branch of a mechanism.

/// Turns after which a branch is given up to close.
pub const TURNS: u32 = 12;

/// The range of a drive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reach<E> {
    /// All round.
    Whole {
        /// The number of turns after which every body is back where it was; `None` if not within
        /// 12.
        turns: Option<u32>,
    },
    /// Between two ends.
    Part {
        /// The end in the negative sense.
        low: E,
        /// The end in the positive one.
        high: E,
    },
}

impl<E> Reach<E> {
    /// Returns true if the drive goes all round.
    pub fn is_whole(&self) -> bool {
        matches!(self, Reach::Whole { .. })
    }

    /// Returns the number of turns after which the branch closes, if it does.
    pub fn turns(&self) -> Option<u32> {
        match self {
            Reach::Whole { turns } => *turns,
            Reach::Part { .. } => None,
        }
    }
}

/// Puts a position among others, in the order of their drives, unless there is one at its drive;
/// returns its number.
pub(super) fn insert_shown<T>(all: &mut Vec<T>, shown: T, drive: impl Fn(&T) -> f64) -> usize {
    let at = drive(&shown);
    let k = all.partition_point(|p| drive(p) < at);
    if all.get(k).is_none_or(|p| drive(p) != at) {
        all.insert(k, shown);
    }
    k
}
