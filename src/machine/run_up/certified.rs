//! A run with certified digits: the motion of the whole mechanism, whose drive is shown.

use super::{Coefficients, RunSection};
use crate::machine::linkage::Linkage;
use crate::machine::planar::{self, Certified, Moving, MovingError, PlanarError, Row};
use crate::machine::source::{Refusal, Source};
use rug::Rational;
use serde::Deserialize;

/// A run with certified digits.
pub struct CertifiedRun {
    /// Its name, if it has one.
    pub name: Option<String>,
    /// The motion, whose quantities are the drive's angle in degrees, its speed and acceleration.
    pub motion: Certified,
    /// The times of the rows in seconds.
    pub times: Vec<Rational>,
}

/// Why a run has no certified digits.
#[derive(Debug, thiserror::Error)]
pub enum CertifiedRunError {
    /// The file is refused.
    #[error(transparent)]
    File(#[from] Refusal),
    /// The mechanism has no such branch.
    #[error(transparent)]
    Mechanism(#[from] PlanarError),
    /// There is no motion.
    #[error(transparent)]
    Motion(#[from] MovingError),
}

#[derive(Deserialize)]
struct File {
    run: RunSection,
}

/// Rows of a run without a step.
const ROWS: u32 = 1000;
/// The most rows.
const MOST: u32 = 1_000_000;

impl CertifiedRun {
    /// Reads the description of a machine of any type, for `digits` significant digits.
    ///
    /// ```
    /// use mechaudit_cli::machine::{run_up::CertifiedRun, Source};
    /// let text = include_str!(concat!(
    ///     env!("CARGO_MANIFEST_DIR"), "/../../examples/four-bar-run-up.toml"
    /// ));
    /// let mut run = CertifiedRun::read(&Source::toml(text), 12)?;
    /// let found = run.motion.at(&run.times[1]);
    /// assert_eq!(found.digits[1].as_deref(), Some("0.0377185683863"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`CertifiedRunError`].
    pub fn read(source: &Source, digits: u32) -> Result<CertifiedRun, CertifiedRunError> {
        let File { run } = source.parse()?;
        if run.coefficients.unwrap_or_default() != Coefficients::Exact {
            let rule = "run.coefficients: certified digits are those of the exact coefficients";
            return Err(source.breach("run.coefficients", rule).into());
        }
        if run.settle.is_some() {
            let rule =
                "run.settle: certified digits are computed up to run.duration or run.target_speed";
            return Err(source.breach("run.settle", rule).into());
        }
        let duration = &run.duration.value;
        let step = match &run.step {
            Some(step) => step.value.clone(),
            None => Rational::from(duration / ROWS),
        };
        if *duration <= 0 || step <= 0 || Rational::from(duration / &step) > MOST {
            let rule = format!(
                "run.duration and run.step have to be positive and give at most {MOST} rows"
            );
            return Err(source.breach("run", rule).into());
        }
        let rows = (0..=MOST).map(|k| &step * Rational::from(k));
        let mut times: Vec<Rational> = rows.take_while(|t| t < duration).collect();
        times.push(duration.clone());
        let mut moving = Moving::read(source)?;
        if let Linkage::Planar(machine) = Linkage::read(source)? {
            if machine.start.drawn {
                let rule = "start.at is missing: the angle of the drawing is rounded";
                return Err(source.breach("start", rule).into());
            }
            let phi = machine.start.at.unwrap_or(0.0).to_radians();
            let branch = planar::choose(&machine, phi, None)?;
            moving.start_on(&machine, &branch.start);
        }
        let target = run.target_speed.as_ref().map(super::drivetrain::quantity);
        Ok(CertifiedRun {
            motion: Certified::new(&moving, digits, &Row::RunUp { target })?,
            name: moving.name,
            times,
        })
    }
}

#[cfg(test)]
mod tests;
