//! Drawings as SVG, for light and dark pages.

pub mod chirp;
pub mod linkage;
mod mechanism;
pub(crate) mod panel;
pub mod reduced;
pub mod run_up;
pub(crate) mod style;
mod view;

pub use panel::CannotDraw;
