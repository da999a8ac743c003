//! Drawings as SVG, for light and dark pages.

pub mod chirp;
mod panel;
pub mod reduced;
pub mod run_up;
pub mod scene;
mod style;

pub use panel::CannotDraw;
