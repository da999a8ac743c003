//! This project's solver.

use crate::code::{Codes, Missing};

/// Adds it.
pub fn add(codes: &mut Codes) {
    codes.missing.push(Missing {
        name: "mechaudit".into(),
        reason: "not in this build".into(),
    });
}
