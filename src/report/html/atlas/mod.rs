//! The atlas as a page.

use crate::claims::{Atlas, Map};

/// The page.
pub fn page(_found: &Atlas, _maps: &[(String, Map)]) -> String {
    String::new()
}
