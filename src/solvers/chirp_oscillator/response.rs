//! The response to an excitation.

use super::error::{ChirpError, finite, not_negative};
use super::free::Free;
use super::harmonic::Prepared;
use super::roots::Roots;
use super::types::{
    Chirp, Excitation, Forcing, Harmonic, HarmonicResponse, InitialState, Motion, Oscillator,
};
use num_complex::Complex;

/// The response of an oscillator to an excitation from an initial state, in closed form.
///
/// Values may be asked for at any times `t ≥ 0` in any order; nothing is stepped.
///
/// ```
/// use mechaudit::solvers::chirp_oscillator::*;
///
/// // Run-up from rest through the resonance of the second harmonic.
/// let oscillator = Oscillator::new(10.0, 0.5)?;
/// let excitation = Excitation {
///     chirp: Chirp { omega0: 0.0, eps: 4.0 },
///     forcing: Forcing::Displacement,
///     static_term: 0.0,
///     harmonics: vec![Harmonic { k: 2.0, amplitude: 1.0, phase: 0.0 }],
/// };
/// let response = ChirpResponse::new(oscillator, excitation, InitialState::default())?;
/// let motion = response.motion(1.5)?;
/// assert!((motion.displacement - 0.758713241617771).abs() < 1e-15);
/// // The envelope and the phase of the harmonic alone.
/// let harmonic = response.harmonic(0, 1.5)?;
/// let theta: f64 = 2.0 * (4.0 * 1.5 * 1.5 / 2.0);
/// let again = harmonic.envelope() * (theta + harmonic.phase()).cos();
/// assert!((again - motion.displacement).abs() < 1e-14);
/// # Ok::<(), ChirpError>(())
/// ```
#[derive(Clone, Debug)]
pub struct ChirpResponse {
    pub(super) roots: Roots,
    pub(super) harmonics: Vec<Prepared>,
    /// The static term as a harmonic with `k = 0`.
    pub(super) constant: Option<Prepared>,
    pub(super) start: [f64; 2],
    /// The unit of frequency, a power of two, in which `w` lies in [1, 2).
    pub(super) unit: f64,
}

/// The largest power of two up to `x`.
fn power_of_two(x: f64) -> f64 {
    let x = if x < f64::MIN_POSITIVE {
        f64::MIN_POSITIVE
    } else {
        x
    };
    f64::from_bits(x.to_bits() & 0x7ff0_0000_0000_0000)
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
        finite("y0", initial.displacement)?;
        finite("v0", initial.velocity)?;
        let excitation = excitation.checked()?;
        let unit = power_of_two(oscillator.w());
        let (w, n) = (oscillator.w() / unit, oscillator.n() / unit);
        let chirp = Chirp {
            omega0: excitation.chirp.omega0 / unit,
            eps: excitation.chirp.eps / unit / unit,
        };
        let factor = match excitation.forcing {
            Forcing::Displacement => w * w,
            Forcing::Acceleration => 1.0 / unit / unit,
        };
        let roots = Roots::new(w, n);
        let prepared = |h: &Harmonic| Prepared::new(&roots, &chirp, h, h.amplitude * factor);
        let constant = Harmonic {
            k: 0.0,
            amplitude: excitation.static_term,
            phase: 0.0,
        };
        Ok(ChirpResponse {
            harmonics: excitation.harmonics.iter().map(prepared).collect(),
            constant: (constant.amplitude != 0.0).then(|| prepared(&constant)),
            start: [initial.displacement, initial.velocity / unit],
            unit,
            roots,
        })
    }

    /// The time in units of `1/unit`.
    pub(super) fn time(&self, t: f64) -> Result<f64, ChirpError> {
        not_negative("t", t).map(|t| t * self.unit)
    }

    /// Displacement, velocity and acceleration at time `t ≥ 0`.
    ///
    /// # Errors
    /// A time that is negative or not finite.
    pub fn motion(&self, t: f64) -> Result<Motion, ChirpError> {
        Ok(self.motion_at(self.time(t)?))
    }

    /// `t` in its own unit.
    pub(super) fn motion_at(&self, t: f64) -> Motion {
        let free = Free::at(&self.roots, t);
        let [y0, v0] = self.start.map(|x| Complex::new(x, 0.0));
        let mut sum = free.motion(self.roots.w, y0, v0).map(|x| x.re);
        for harmonic in self.constant.iter().chain(&self.harmonics) {
            let psi = harmonic.psi(&self.roots, &free, t);
            for (sum, psi) in sum.iter_mut().zip(psi) {
                *sum += psi.re;
            }
        }
        self.scaled(sum)
    }

    /// In the caller's unit of time.
    pub(super) fn scaled(&self, [y, v, a]: [f64; 3]) -> Motion {
        Motion {
            displacement: y,
            velocity: v * self.unit,
            acceleration: a * self.unit * self.unit,
        }
    }

    /// The response to harmonic number `index` alone, from rest.
    ///
    /// # Errors
    /// A time that is negative or not finite; no such harmonic.
    pub fn harmonic(&self, index: usize, t: f64) -> Result<HarmonicResponse, ChirpError> {
        let count = self.harmonics.len();
        let harmonic = self
            .harmonics
            .get(index)
            .ok_or(ChirpError::NoHarmonic { index, count })?;
        let t = self.time(t)?;
        let free = Free::at(&self.roots, t);
        let psi = harmonic.psi(&self.roots, &free, t);
        let amplitude = psi[0] * harmonic.sweep.carrier(t).conj();
        Ok(HarmonicResponse {
            amplitude: match harmonic.mirrored {
                true => amplitude.conj(),
                false => amplitude,
            },
            motion: self.scaled(psi.map(|x| x.re)),
        })
    }

    /// `Σ|A_k|` at time `t`: the bound of Gembara & Senyk (19) on the displacement from rest.
    ///
    /// # Errors
    /// A time that is negative or not finite.
    pub fn envelope(&self, t: f64) -> Result<f64, ChirpError> {
        let t = self.time(t)?;
        let free = Free::at(&self.roots, t);
        let sizes = self
            .harmonics
            .iter()
            .map(|h| h.psi(&self.roots, &free, t)[0].norm());
        Ok(sizes.sum())
    }
}
