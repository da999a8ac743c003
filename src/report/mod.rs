//! Reports in every form: text, HTML, JSON, CSV, JUnit, LaTeX, SVG, DXF.
//!
//! Whatever is shown comes in as a value; nothing here solves, judges or proves. What two forms say
//! in the same words stands in [`words`]. HTML and SVG are written by `maud`, which escapes every
//! text.

mod axis;
pub mod baseline;
pub mod cell;
pub mod columns;
#[cfg(feature = "report")]
pub mod csv;
#[cfg(feature = "report")]
pub mod dxf;
pub mod glossary;
pub mod html;
#[cfg(feature = "report")]
pub mod json;
#[cfg(feature = "report")]
pub mod junit;
#[cfg(feature = "report")]
pub mod latex;
#[cfg(feature = "report")]
pub mod rows;
pub mod svg;
pub mod text;
pub mod words;

/// Of reports in JSON: grows when a member is taken away or changes its meaning.
pub const SCHEMA_VERSION: u32 = 2;

#[cfg(test)]
mod gallery;
#[cfg(test)]
mod hostile;
