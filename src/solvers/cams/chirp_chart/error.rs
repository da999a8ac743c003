//! Why there is no response or no chart.

use crate::cam_law::CamLawError;
use crate::chirp_oscillator::ChirpError;
use crate::fourier_series::FourierSeriesError;

/// Why there is no response or no chart.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ChirpChartError {
    /// The oscillator or the excitation is refused.
    #[error("{0}")]
    Chirp(#[from] ChirpError),
    /// The cam is refused.
    #[error("{0}")]
    Cam(#[from] CamLawError),
    /// The series is refused.
    #[error("{0}")]
    Series(#[from] FourierSeriesError),
    /// A cycle that does not return: its forcing does not repeat.
    #[error("the cycle has no return: a displacement that grows from turn to turn has no chart")]
    NoReturn,
    /// A criterion that is not positive.
    #[error("xi = {xi} is not a positive number")]
    Criterion {
        /// The criterion.
        xi: f64,
    },
    /// A speed that the programme never has.
    #[error(
        "xi = {xi} needs {speed} rad/s, a speed that the shaft does not have from {omega0} rad/s \
         on with {eps} rad/s^2"
    )]
    NeverReached {
        /// The criterion.
        xi: f64,
        /// The speed.
        speed: f64,
        /// Speed at the start.
        omega0: f64,
        /// Acceleration.
        eps: f64,
    },
}
