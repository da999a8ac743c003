//! Drawings as SVG, for light and dark pages.

pub mod chirp;
pub mod linkage;
mod mechanism;
mod panel;
pub mod reduced;
pub mod run_up;
mod style;
mod view;

pub use panel::CannotDraw;
