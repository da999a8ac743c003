//! This project's solver.

use crate::code::{Codes, Scalar};
use mechaudit::solvers::faddeeva;

/// Adds it.
pub fn add(codes: &mut Codes) {
    codes.found.push(Box::new(Scalar {
        name: "mechaudit".into(),
        version: concat!(env!("CARGO_PKG_VERSION"), ", this checkout").into(),
        own: true,
        w: faddeeva::faddeeva,
    }));
}
