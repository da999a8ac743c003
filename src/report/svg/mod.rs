//! Drawings as SVG, for light and dark pages.

#[cfg(feature = "report")]
pub mod chirp;
pub mod linkage;
#[cfg(feature = "report")]
pub(crate) mod panel;
#[cfg(feature = "report")]
pub mod reduced;
#[cfg(feature = "report")]
pub mod run_up;
pub(crate) mod style;
pub(crate) mod view;
