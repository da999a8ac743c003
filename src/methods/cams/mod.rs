//! Laws and cycles of cams, and followers that a cam forces.

mod cam_fourier_series;
mod cam_law;
mod chirp_response;
mod law_input;

pub use cam_fourier_series::{CamCycleInput, CamFourierSeries, CamFourierSeriesInput};
pub use cam_law::{CamLaw, CamLawInput};
pub use chirp_response::{ChirpResponse, ChirpResponseInput};
