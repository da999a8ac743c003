//! Charts in the manner of Fig. 5. The paper gives neither the phases of its cams nor the
//! oscillator nor the speeds, so these stand for any.

use crate::solvers::cam_law::{CamCycle, MotionLaw, Stroke};
use crate::solvers::chirp_chart::{CamDrive, CamResponse, Chart, ChirpChartError, Period};
use crate::solvers::chirp_oscillator::{Chirp, Oscillator};

/// Natural frequency, rad/s.
pub const FREQUENCY: f64 = 100.0;
/// Damping ratio.
pub const DAMPING_RATIO: f64 = 0.02;
/// Acceleration of the shaft, rad/s², in either direction.
pub const ACCELERATION: f64 = 0.2;
/// Speed at which the run-down begins, rad/s.
pub const FASTEST: f64 = 18.0;
/// Harmonics.
pub const HARMONICS: u32 = 60;

/// The laws of Fig. 5.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Law {
    /// "К", cosine acceleration.
    K,
    /// "0050", constant acceleration.
    Constant,
}

impl Law {
    /// Its name in the paper.
    pub fn name(self) -> &'static str {
        match self {
            Law::K => "К",
            Law::Constant => "0050",
        }
    }
}

/// Which way the shaft's speed changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Programme {
    /// From rest, as the formulas have it.
    RunUp,
    /// To rest, as was measured.
    RunDown,
}

/// ξ = 2.0 … 14.0 in steps of 0.1.
pub fn grid() -> Vec<f64> {
    (20..=140).map(|i| f64::from(i) / 10.0).collect()
}

/// The chart of the motion over the paper's ξ (the rise as the period): rise, dwells and return of
/// 120, 60, 120 and 60 degrees, a lift of one.
///
/// # Errors
/// None for these data; those of the solvers.
pub fn chart(law: Law, programme: Programme) -> Result<Chart, ChirpChartError> {
    let motion = || match law {
        Law::K => MotionLaw::simple_harmonic(),
        Law::Constant => MotionLaw::constant_acceleration(),
    };
    let stroke = || Stroke {
        law: motion(),
        turns: 1.0 / 3.0,
    };
    let sixth = 1.0 / 6.0;
    let drive = CamDrive {
        oscillator: Oscillator::new(FREQUENCY, DAMPING_RATIO * FREQUENCY)?,
        cycle: CamCycle::new(1.0, stroke(), sixth, stroke(), sixth)?,
        chirp: match programme {
            Programme::RunUp => Chirp {
                omega0: 0.0,
                eps: ACCELERATION,
            },
            Programme::RunDown => Chirp {
                omega0: FASTEST,
                eps: -ACCELERATION,
            },
        },
    };
    Chart::of_motion(
        &CamResponse::new(drive, HARMONICS, None)?,
        Period::Rise,
        &grid(),
    )
}
