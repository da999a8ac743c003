//! The response to an excitation.

use super::error::{ChirpError, finite, not_negative};
use super::free::Free;
use super::harmonic::Prepared;
use super::roots::Roots;
use super::types::{
    Chirp, Excitation, Forcing, Harmonic, HarmonicResponse, InitialState, Motion, Oscillator,
};
use crate::lanes::{Lanes, Task, with_best};
use num_complex::Complex;

/// The response of an oscillator to an excitation from an initial state, in closed form.
///
/// Values may be asked for at any times `t ≥ 0` in any order; nothing is stepped.
///
/// ```
/// use mechaudit_solvers::chirp_oscillator::*;
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
    let x = x.max(f64::MIN_POSITIVE);
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

    /// The response to one harmonic as a displacement.
    ///
    /// # Errors
    /// As [`ChirpResponse::new`].
    pub fn of_harmonic(
        oscillator: Oscillator,
        chirp: Chirp,
        harmonic: Harmonic,
        initial: InitialState,
    ) -> Result<ChirpResponse, ChirpError> {
        let excitation = Excitation {
            chirp,
            forcing: Forcing::Displacement,
            static_term: 0.0,
            harmonics: vec![harmonic],
        };
        ChirpResponse::new(oscillator, excitation, initial)
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
    fn motion_at(&self, t: f64) -> Motion {
        with_best(MotionAt(self, t))
    }

    #[inline(always)]
    fn motion_here(&self, t: f64) -> Motion {
        let free = Free::at(&self.roots, t);
        let (y0, v0) = (self.start[0], self.start[1]);
        let own = free.motion(self.roots.w, y0.into(), v0.into());
        let mut sum = [own[0].re, own[1].re, own[2].re];
        for harmonic in self.constant.iter().chain(&self.harmonics) {
            let carrier = harmonic.sweep.carrier(t);
            let psi = harmonic.psi(&self.roots, &free, carrier, t);
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
        let (psi, amplitude) = with_best(PsiAt(&self.roots, harmonic, self.time(t)?));
        Ok(HarmonicResponse {
            amplitude: match harmonic.mirrored {
                true => amplitude.conj(),
                false => amplitude,
            },
            motion: self.scaled(psi.map(|x| x.re)),
        })
    }

    /// The displacement under the static term alone, for ever: `a₀`, or `a₀/w²` if it is an
    /// acceleration.
    pub fn mean(&self) -> f64 {
        let w = self.roots.w;
        self.constant.as_ref().map_or(0.0, |c| c.scale / (w * w))
    }

    /// `Σ|A_k|` at time `t`: the bound of Gembara & Senyk (19) on what the harmonics add from rest.
    /// It leaves out the static term and the free vibration from the initial state.
    ///
    /// # Errors
    /// A time that is negative or not finite.
    pub fn sum_of_amplitudes(&self, t: f64) -> Result<f64, ChirpError> {
        let t = self.time(t)?;
        let size = |h| with_best(PsiAt(&self.roots, h, t)).1.norm();
        Ok(self.harmonics.iter().map(size).sum())
    }

    /// The envelope of the motion: `|y(t) − mean| ≤ envelope(t)`, the sum of
    /// [`sum_of_amplitudes`](ChirpResponse::sum_of_amplitudes) and of a bound on the free vibration
    /// from the initial state, taken about the [`mean`](ChirpResponse::mean); raised by 2⁻⁴⁶ of
    /// what is added up, for the roundings of both sides.
    ///
    /// # Errors
    /// A time that is negative or not finite.
    pub fn envelope(&self, t: f64) -> Result<f64, ChirpError> {
        let harmonics = self.sum_of_amplitudes(t)?;
        let t = self.time(t)?;
        let (mean, [y0, v0]) = (self.mean(), self.start);
        let free = Free::at(&self.roots, t).bound(&self.roots, y0 - mean, v0, t);
        let sum = harmonics + free;
        Ok(sum + f64::EPSILON * 64.0 * (sum + mean.abs() + y0.abs()))
    }

    /// The amplitudes `A` of harmonic number `index` at many times, from rest.
    ///
    /// # Errors
    /// As [`ChirpResponse::harmonic`]; slices of different lengths.
    pub fn amplitudes(
        &self,
        index: usize,
        times: &[f64],
        out: &mut [Complex<f64>],
    ) -> Result<(), ChirpError> {
        same_length(times, out)?;
        for (t, out) in times.iter().zip(out) {
            *out = self.harmonic(index, *t)?.amplitude;
        }
        Ok(())
    }
}

struct MotionAt<'a>(&'a ChirpResponse, f64);

impl Task for MotionAt<'_> {
    type Output = Motion;

    #[inline(always)]
    fn run<L: Lanes>(self, _: L) -> Motion {
        self.0.motion_here(self.1)
    }
}

/// `ψ, ψ′, ψ″` and `ψ e^{iθ}` of one harmonic.
struct PsiAt<'a>(&'a Roots, &'a Prepared, f64);

impl Task for PsiAt<'_> {
    type Output = ([Complex<f64>; 3], Complex<f64>);

    #[inline(always)]
    fn run<L: Lanes>(self, _: L) -> Self::Output {
        let PsiAt(roots, harmonic, t) = self;
        let carrier = harmonic.sweep.carrier(t);
        harmonic.psi_and_amplitude(roots, &Free::at(roots, t), carrier, t)
    }
}

pub(super) fn same_length<T>(times: &[f64], out: &[T]) -> Result<(), ChirpError> {
    let (times, values) = (times.len(), out.len());
    match times == values {
        true => Ok(()),
        false => Err(ChirpError::Lengths { times, values }),
    }
}

#[cfg(test)]
mod tests {
    use super::power_of_two;

    #[test]
    fn powers_of_two() {
        let least = f64::MIN_POSITIVE;
        for (x, due) in [
            (1.0, 1.0),
            (1.999, 1.0),
            (2.0, 2.0),
            (0.7, 0.5),
            (300.0, 256.0),
            (least, least),
            (least.next_down(), least),
            (5e-324, least),
        ] {
            assert_eq!(power_of_two(x), due, "{x:e}");
        }
    }
}
