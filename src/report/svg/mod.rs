//! Drawings as SVG, for light and dark pages.

pub mod chirp;
pub mod mechanism;
mod panel;
pub mod reduced;
pub mod run_up;
pub mod scene;
mod style;

pub use panel::CannotDraw;
