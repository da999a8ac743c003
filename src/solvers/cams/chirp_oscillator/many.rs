//! Motions and displacements at many times, and the quicker displacement at one.

use super::batch::{Once, displacements};
use super::error::ChirpError;
#[cfg(feature = "parallel")]
use super::group::CHUNK;
use super::motions::motions;
use super::response::{ChirpResponse, same_length};
use super::types::Motion;
use crate::lanes::with_best;

impl ChirpResponse {
    /// The displacement alone at time `t ≥ 0`, about twice as fast. It differs from that of
    /// [`ChirpResponse::motion`] by roundings.
    ///
    /// # Errors
    /// A time that is negative or not finite.
    pub fn displacement(&self, t: f64) -> Result<f64, ChirpError> {
        let t = self.time(t)?;
        Ok(with_best(Once { response: self, t }))
    }

    /// [`ChirpResponse::motion`] at many times, several times as fast; they differ by roundings.
    ///
    /// # Errors
    /// A time that is negative or not finite; slices of different lengths.
    pub fn motions(&self, times: &[f64], out: &mut [Motion]) -> Result<(), ChirpError> {
        same_length(times, out)?;
        for t in times {
            self.time(*t)?;
        }
        motions(self, times, out);
        Ok(())
    }

    /// Displacements alone at many times, several times as fast. They differ from those of
    /// [`ChirpResponse::motion`] by roundings.
    ///
    /// # Errors
    /// As [`ChirpResponse::motions`].
    pub fn displacements(&self, times: &[f64], out: &mut [f64]) -> Result<(), ChirpError> {
        same_length(times, out)?;
        for t in times {
            self.time(*t)?;
        }
        displacements(self, times, out);
        Ok(())
    }

    /// [`ChirpResponse::motions`] on all cores.
    ///
    /// # Errors
    /// As [`ChirpResponse::motions`].
    #[cfg(feature = "parallel")]
    pub fn motions_parallel(&self, times: &[f64], out: &mut [Motion]) -> Result<(), ChirpError> {
        use rayon::prelude::*;
        same_length(times, out)?;
        times
            .par_chunks(CHUNK)
            .zip(out.par_chunks_mut(CHUNK))
            .try_for_each(|(times, out)| self.motions(times, out))
    }

    /// [`ChirpResponse::displacements`] on all cores.
    ///
    /// # Errors
    /// As [`ChirpResponse::motions`].
    #[cfg(feature = "parallel")]
    pub fn displacements_parallel(&self, times: &[f64], out: &mut [f64]) -> Result<(), ChirpError> {
        use rayon::prelude::*;
        same_length(times, out)?;
        times
            .par_chunks(CHUNK)
            .zip(out.par_chunks_mut(CHUNK))
            .try_for_each(|(times, out)| self.displacements(times, out))
    }
}
