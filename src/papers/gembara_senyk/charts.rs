//! Charts in the manner of Fig. 5. The paper gives neither the phases of its cams nor the
//! oscillator nor the speeds, so that those of the example stand for any.

use crate::machine::{CamOscillator, Source};
use crate::solvers::chirp_chart::{CamResponse, Chart, Period};
use crate::solvers::chirp_oscillator::Chirp;

const EXAMPLE: &str = include_str!("../../../examples/chirp-chart.toml");

/// Harmonics.
pub const HARMONICS: u32 = 60;

/// The chart of a law, "К" of cosine or "0050" of constant acceleration, over the paper's ξ: of the
/// run-down as it was measured, or of a run-up from rest as the formulas have it. None for another
/// law.
pub fn chart(law: &str, runs_up: bool) -> Option<Chart> {
    // A lift of one.
    let example = EXAMPLE.replace("\"20 deg\"", "\"1 rad\"");
    let example = CamOscillator::read(&Source::toml(example), Some(HARMONICS)).ok()?;
    let mut drives = example.chart?.drives.into_iter();
    let mut drive = drives.find(|drive| drive.0 == law)?.1;
    if runs_up {
        drive.chirp = Chirp {
            omega0: 0.0,
            eps: -drive.chirp.eps,
        };
    }
    let response = CamResponse::new(drive, HARMONICS, None).ok()?;
    let grid: Vec<f64> = (20..=140).map(|i| f64::from(i) / 10.0).collect();
    Chart::of_motion(&response, Period::Rise, &grid).ok()
}
