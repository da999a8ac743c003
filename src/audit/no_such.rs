//! The error for a name that a method does not have.

use super::nearest::did_you_mean;

/// A region, check point or output that a method does not have.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{method} has no {what} {name:?}{}; it has: {}", did_you_mean(.name, .known), .known.join(", "))]
pub struct NoSuch {
    /// The method.
    pub method: &'static str,
    /// The name that was asked for.
    pub what: &'static str,
    /// Its name.
    pub name: String,
    /// The names there are.
    pub known: Vec<&'static str>,
}

impl NoSuch {
    pub(super) fn new(
        method: &'static str,
        what: &'static str,
        name: &str,
        known: Vec<&'static str>,
    ) -> NoSuch {
        let name = name.into();
        NoSuch {
            method,
            what,
            name,
            known,
        }
    }
}
