//! Drawings as SVG, for light and dark pages.

#[cfg(feature = "report")]
pub mod chirp;
pub mod linkage;
mod mechanism;
#[cfg(feature = "report")]
mod panel;
#[cfg(feature = "report")]
pub mod reduced;
#[cfg(feature = "report")]
pub mod run_up;
mod style;
mod view;

#[cfg(feature = "report")]
pub use panel::CannotDraw;
