//! The response to an excitation.

use super::error::ChirpError;
use super::types::{Excitation, HarmonicResponse, InitialState, Motion, Oscillator};

/// The response of an oscillator to an excitation from an initial state, in closed form.
///
/// Values may be asked for at any times `t ≥ 0` in any order; nothing is stepped.
#[derive(Clone, Debug)]
pub struct ChirpResponse {
    oscillator: Oscillator,
    excitation: Excitation,
    initial: InitialState,
}

impl ChirpResponse {
    /// Prepares the response.
    ///
    /// # Errors
    /// Numbers that are not finite.
    pub fn new(
        oscillator: Oscillator,
        excitation: Excitation,
        initial: InitialState,
    ) -> Result<ChirpResponse, ChirpError> {
        Ok(ChirpResponse {
            oscillator,
            excitation: excitation.checked()?,
            initial,
        })
    }

    /// Displacement, velocity and acceleration at time `t ≥ 0`.
    ///
    /// # Errors
    /// A time that is negative or not finite.
    pub fn motion(&self, _t: f64) -> Result<Motion, ChirpError> {
        todo!()
    }

    /// The response to harmonic number `index` alone, from rest.
    ///
    /// # Errors
    /// A time that is negative or not finite; no such harmonic.
    pub fn harmonic(&self, _index: usize, _t: f64) -> Result<HarmonicResponse, ChirpError> {
        todo!()
    }

    /// `Σ|A_k|` at time `t`: the bound of Gembara & Senyk (19) on the forced displacement from rest.
    ///
    /// # Errors
    /// A time that is negative or not finite.
    pub fn envelope(&self, _t: f64) -> Result<f64, ChirpError> {
        todo!()
    }

    /// [`ChirpResponse::motion`] at many times.
    ///
    /// # Errors
    /// A time that is negative or not finite; slices of different lengths.
    pub fn motions(&self, _times: &[f64], _out: &mut [Motion]) -> Result<(), ChirpError> {
        todo!()
    }

    /// Displacements alone at many times, several times as fast.
    ///
    /// # Errors
    /// As [`ChirpResponse::motions`].
    pub fn displacements(&self, _times: &[f64], _out: &mut [f64]) -> Result<(), ChirpError> {
        todo!()
    }

    /// [`ChirpResponse::motions`] on all cores.
    ///
    /// # Errors
    /// As [`ChirpResponse::motions`].
    #[cfg(feature = "parallel")]
    pub fn motions_parallel(&self, _times: &[f64], _out: &mut [Motion]) -> Result<(), ChirpError> {
        todo!()
    }

    /// [`ChirpResponse::displacements`] on all cores.
    ///
    /// # Errors
    /// As [`ChirpResponse::motions`].
    #[cfg(feature = "parallel")]
    pub fn displacements_parallel(
        &self,
        _times: &[f64],
        _out: &mut [f64],
    ) -> Result<(), ChirpError> {
        todo!()
    }
}
