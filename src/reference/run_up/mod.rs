//! x
mod coefficients;
mod integrate;
mod linkage_panel;
mod motor;
mod series;
mod step;
pub use coefficients::{LinkageCurve, Coefficients};
pub use integrate::{Run,Sample,Motion,integrate,integrate_with};
pub use motor::Motor;
