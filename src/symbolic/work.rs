//! A limit on the work of one decision.
//!
//! Exact arithmetic can grow without bound: a chain of dependent roots or of high powers. Every
//! decision runs inside [`limited`]. The arithmetic counts its operations with [`spend`]; once the
//! limit is passed, polynomials come out as zero so that every loop ends, and [`limited`] discards
//! the result and reports [`SymbolicError::Work`].

use super::SymbolicError;
use std::cell::Cell;

/// Operations allowed for one decision: products of terms, weighted by their length, and nodes of
/// expressions. A few seconds of processor time.
pub(super) const LIMIT: u64 = 2_000_000;

thread_local! {
    static LEFT: Cell<Option<u64>> = const { Cell::new(None) };
}

/// Counts operations; returns false if the limit is passed. Outside of [`limited`] nothing is
/// counted.
pub(super) fn spend(operations: u64) -> bool {
    LEFT.with(|left| match left.get() {
        None => true,
        Some(n) => {
            left.set(Some(n.saturating_sub(operations)));
            n > operations
        }
    })
}

/// As [`spend`], with an error past the limit.
pub(super) fn step(operations: u64) -> Result<(), SymbolicError> {
    match spend(operations) {
        true => Ok(()),
        false => Err(SymbolicError::Work),
    }
}

/// Runs `f` with a limit on its operations. Inside another limit, that one stays in force.
pub(super) fn limited<T>(
    limit: u64,
    f: impl FnOnce() -> Result<T, SymbolicError>,
) -> Result<T, SymbolicError> {
    if LEFT.get().is_some() {
        return f();
    }
    /// Restores the state even if `f` panics.
    struct Reset;
    impl Drop for Reset {
        fn drop(&mut self) {
            LEFT.set(None);
        }
    }
    let _reset = Reset;
    LEFT.set(Some(limit));
    let found = f();
    match LEFT.get() {
        Some(0) => Err(SymbolicError::Work),
        _ => found,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_past_the_limit_is_discarded() {
        assert_eq!(limited(10, || Ok(spend(9))), Ok(true));
        assert_eq!(limited(10, || Ok(spend(10))), Err(SymbolicError::Work));
        // Without a limit around it nothing is counted.
        assert!(spend(u64::MAX) && spend(1));
        // The outer limit holds inside an inner one.
        let nested = limited(10, || limited(1000, || Ok(spend(20))));
        assert_eq!(nested, Err(SymbolicError::Work));
    }
}
