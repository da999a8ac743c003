//! The response of a cam-driven oscillator in time.

use super::error::ChirpChartError;
use super::peak::largest;
use crate::cam_law::{CamCycle, Motion as CamMotion};
use crate::chirp_oscillator::{
    Chirp, ChirpResponse, Excitation, Forcing, Harmonic, InitialState, Motion, Oscillator,
};
use crate::fourier_series::FourierSeries;
use num_complex::Complex64;
use std::f64::consts::{PI, TAU};

/// Samples in the shortest period.
const SAMPLES: f64 = 8.0;
/// From this multiple of the natural frequency on the harmonics left out are taken as filtered.
const REACH: f64 = 1.5;
/// Least number of samples in a turn.
const LEAST_SAMPLES: f64 = 200.0;
/// Most of them: 2500 periods in a turn.
const MOST_SAMPLES: f64 = 2e4;

/// Describes what the period of the forcing is, of which the frequency criterion is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Period {
    /// The time of the rise, as in Gembara & Senyk (1).
    Rise,
    /// The time of a turn, as in their (19).
    Turn,
}

/// A cam, an oscillator on it and how the shaft moves.
#[derive(Clone, Debug)]
pub struct CamDrive {
    /// The oscillator.
    pub oscillator: Oscillator,
    /// The cam.
    pub cycle: CamCycle,
    /// The shaft; it starts at angle 0.
    pub chirp: Chirp,
}

impl CamDrive {
    /// Speed of the shaft, rad/s.
    pub fn speed(&self, t: f64) -> f64 {
        self.chirp.eps.mul_add(t, self.chirp.omega0)
    }

    /// Angle of the shaft in turns.
    pub fn turns(&self, t: f64) -> f64 {
        t * (0.5 * self.chirp.eps).mul_add(t, self.chirp.omega0) / TAU
    }

    /// ξ of a speed of the shaft: natural frequency over frequency of the forcing.
    pub fn criterion(&self, speed: f64, period: Period) -> f64 {
        let share = match period {
            Period::Rise => self.cycle.rise().turns,
            Period::Turn => 1.0,
        };
        self.oscillator.w() * share / speed.abs()
    }

    /// The first time at which the shaft has the speed of a criterion, forward or backward.
    ///
    /// # Errors
    /// A criterion that is not positive; a speed that the shaft never has.
    pub fn time_of(&self, xi: f64, period: Period) -> Result<f64, ChirpChartError> {
        if !(xi > 0.0 && xi.is_finite()) {
            return Err(ChirpChartError::Criterion { xi });
        }
        let speed = self.criterion(xi, period);
        let Chirp { omega0, eps } = self.chirp;
        let times = [speed, -speed].map(|s| (s - omega0) / eps);
        let possible = times.into_iter().filter(|t| *t >= 0.0 && t.is_finite());
        possible
            .min_by(f64::total_cmp)
            .ok_or(ChirpChartError::NeverReached {
                xi,
                speed,
                omega0,
                eps,
            })
    }

    /// Displacement of the cam at a time, with derivatives in the shaft's angle.
    fn cam(&self, t: f64) -> CamMotion {
        self.cycle.at(self.turns(t)).unwrap_or_default()
    }

    /// Times at which the shaft is half a turn before and after a time; where it turns back
    /// earlier, the time at which it stands.
    fn turn_about(&self, t: f64) -> [f64; 2] {
        let (speed, eps) = (self.speed(t), self.chirp.eps);
        let side = |sign: f64| {
            let half = sign * PI * speed.signum();
            let square = speed * speed + 2.0 * eps * half;
            match square > 0.0 {
                true => t + 2.0 * half / (speed + square.sqrt().copysign(speed)),
                false => t - speed / eps,
            }
        };
        [side(-1.0).max(0.0), side(1.0)]
    }
}

/// State of the driven mass and of the cam at a time, in SI units of the lift.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct State {
    /// Time.
    pub t: f64,
    /// Angle of the shaft in turns.
    pub turns: f64,
    /// Speed of the shaft.
    pub speed: f64,
    /// `f`, displacement of the cam.
    pub cam: f64,
    /// `df/dθ`.
    pub cam_rate: f64,
    /// `y`.
    pub displacement: f64,
    /// `y′`.
    pub velocity: f64,
    /// `y″`.
    pub acceleration: f64,
    /// `w² (f − y) = y″ + 2n y′`: the spring's force on a unit of mass.
    pub spring: f64,
}

/// The largest values in a turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TurnPeaks {
    /// First and last time.
    pub times: [f64; 2],
    /// `|y − a_0|`.
    pub displacement: f64,
    /// `|y″|`.
    pub acceleration: f64,
    /// `|y″ df/dθ|`, without the friction of the damper.
    pub moment: f64,
    /// `|y′ y″|`.
    pub power: f64,
}

/// `y − f = amplitude · e^{−nτ} cos(√(w² − n²) τ + phase)`, `τ` after the time asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FreeVibration {
    /// Amplitude at that time.
    pub amplitude: f64,
    /// Phase at that time in (−π, π].
    pub phase: f64,
}

/// The response of a drive.
///
/// ```
/// use mechaudit_solvers::cam_law::{CamCycle, MotionLaw, Stroke};
/// use mechaudit_solvers::chirp_chart::{CamDrive, CamResponse, Period};
/// use mechaudit_solvers::chirp_oscillator::{Chirp, Oscillator};
/// let stroke = || Stroke { law: MotionLaw::modified_sine(), turns: 0.25 };
/// let drive = CamDrive {
///     oscillator: Oscillator::new(100.0, 2.0)?,
///     cycle: CamCycle::new(0.01, stroke(), 0.25, stroke(), 0.25)?,
///     chirp: Chirp { omega0: 0.0, eps: 4.0 },
/// };
/// let response = CamResponse::new(drive, 60, None)?;
/// let t = response.drive().time_of(4.0, Period::Rise)?;
/// let peaks = response.peaks(t);
/// // Without elasticity the acceleration would reach C_a h (Ω/β)².
/// let speed = response.drive().speed(t);
/// let rigid = 5.528 * 0.01 * (speed / (0.25 * std::f64::consts::TAU)).powi(2);
/// assert!(peaks.acceleration > rigid, "{} {rigid}", peaks.acceleration);
/// # Ok::<(), mechaudit_solvers::chirp_chart::ChirpChartError>(())
/// ```
#[derive(Clone, Debug)]
pub struct CamResponse {
    drive: CamDrive,
    mean: f64,
    amplitudes: Vec<f64>,
    response: ChirpResponse,
}

impl CamResponse {
    /// The response with `harmonics` terms of the cam's displacement, from an initial state or, if
    /// none is given, from following the cam.
    ///
    /// # Errors
    /// A cycle without a return, harmonics or states that are refused.
    pub fn new(
        drive: CamDrive,
        harmonics: u32,
        initial: Option<InitialState>,
    ) -> Result<CamResponse, ChirpChartError> {
        if drive.cycle.fall().is_none() {
            return Err(ChirpChartError::NoReturn);
        }
        let series = FourierSeries::new(&drive.cycle);
        let terms = series.harmonics(harmonics)?;
        let start = drive.cycle.at(0.0)?;
        let initial = initial.unwrap_or(InitialState {
            displacement: start.displacement,
            velocity: start.velocity * drive.chirp.omega0,
        });
        let harmonic = |h: &crate::fourier_series::Harmonic| Harmonic {
            k: f64::from(h.order),
            amplitude: h.amplitude(),
            phase: h.phase(),
        };
        let excitation = Excitation {
            chirp: drive.chirp,
            forcing: Forcing::Displacement,
            static_term: series.mean(),
            harmonics: terms.iter().map(harmonic).collect(),
        };
        Ok(CamResponse {
            amplitudes: excitation.harmonics.iter().map(|h| h.amplitude).collect(),
            mean: series.mean(),
            response: ChirpResponse::new(drive.oscillator, excitation, initial)?,
            drive,
        })
    }

    /// The drive.
    pub fn drive(&self) -> &CamDrive {
        &self.drive
    }

    /// The mean `a_0` of the cam's displacement.
    pub fn mean(&self) -> f64 {
        self.mean
    }

    /// State at a time `t ≥ 0`.
    ///
    /// While the highest harmonic is slower than 1.5 w the acceleration is that of the harmonics
    /// alone, and smoother than the true one; take more of them for such speeds.
    ///
    /// # Errors
    /// A time that is negative or not finite.
    pub fn state(&self, t: f64) -> Result<State, ChirpChartError> {
        Ok(self.state_of(t, self.response.motion(t)?))
    }

    fn state_of(&self, t: f64, m: Motion) -> State {
        let cam = self.drive.cam(t);
        let (w, n) = (self.drive.oscillator.w(), self.drive.oscillator.n());
        let speed = self.drive.speed(t);
        // Harmonics left out are filtered away, or they are not and f must not have them either.
        let highest = self.amplitudes.len() as f64 * speed.abs();
        let spring = match highest >= REACH * w {
            true => w * w * (cam.displacement - m.displacement),
            false => m.acceleration + 2.0 * n * m.velocity,
        };
        State {
            t,
            turns: self.drive.turns(t),
            speed,
            cam: cam.displacement,
            cam_rate: cam.velocity,
            displacement: m.displacement,
            velocity: m.velocity,
            acceleration: spring - 2.0 * n * m.velocity,
            spring,
        }
    }

    /// States at many times; those of times that are refused are zero.
    fn states(&self, times: &[f64]) -> Vec<State> {
        let mut motions = vec![Motion::default(); times.len()];
        match self.response.motions(times, &mut motions) {
            Ok(()) => {
                let both = times.iter().zip(motions);
                both.map(|(&t, m)| self.state_of(t, m)).collect()
            }
            Err(_) => {
                let one = |&t| self.state(t).unwrap_or_default();
                times.iter().map(one).collect()
            }
        }
    }

    /// The envelope of the motion: `|y − a_0|` is not above it, whatever the initial state
    /// ([`ChirpResponse::envelope`]).
    ///
    /// # Errors
    /// A time that is negative or not finite.
    pub fn envelope(&self, t: f64) -> Result<f64, ChirpChartError> {
        Ok(self.response.envelope(t)?)
    }

    /// `Σ|A_k|` (19), and `w² Σ|D_k − A_k|`.
    ///
    /// # Errors
    /// A time that is negative or not finite.
    pub fn bounds(&self, t: f64) -> Result<[f64; 2], ChirpChartError> {
        let w = self.drive.oscillator.w();
        let mut sums = [0.0; 2];
        for (k, &forcing) in self.amplitudes.iter().enumerate() {
            let a = self.response.harmonic(k, t)?.amplitude;
            sums[0] += a.norm();
            sums[1] += w * w * (Complex64::from(forcing) - a).norm();
        }
        Ok(sums)
    }

    /// The frequency of the oscillator or, if that is higher, of the highest harmonic between two
    /// times.
    fn fastest(&self, times: [f64; 2]) -> f64 {
        let speed = times.map(|t| self.drive.speed(t).abs());
        let fastest = self.amplitudes.len() as f64 * speed[0].max(speed[1]);
        fastest.max(self.drive.oscillator.w())
    }

    /// The largest values in the turn about a time. Samples lie an eighth of the shortest period
    /// apart, of the highest harmonic and of the oscillator, but there are 20 000 at most; peaks
    /// among them are refined.
    pub fn peaks(&self, t: f64) -> TurnPeaks {
        self.peaks_of(t, true)
    }

    /// [`CamResponse::peaks`] of displacement and acceleration alone, in about half the time;
    /// moment and power are NaN.
    pub fn motion_peaks(&self, t: f64) -> TurnPeaks {
        self.peaks_of(t, false)
    }

    fn peaks_of(&self, t: f64, loads: bool) -> TurnPeaks {
        let times = self.drive.turn_about(t);
        let places = places(times, self.fastest(times));
        let at = |t: f64| self.state(t).unwrap_or_default();
        let samples = self.states(&places);
        let peak = |of: fn(&State) -> f64, offset: f64| {
            let values: Vec<f64> = samples.iter().map(|s| of(s) - offset).collect();
            largest(&places, &values, |t| of(&at(t)) - offset).1
        };
        let load = |of| if loads { peak(of, 0.0) } else { f64::NAN };
        TurnPeaks {
            times,
            displacement: peak(|s| s.displacement, self.mean),
            acceleration: peak(|s| s.acceleration, 0.0),
            moment: load(|s| s.acceleration * s.cam_rate),
            power: load(|s| s.velocity * s.acceleration),
        }
    }

    /// The free vibration with which a dwell that holds the time goes on; none if overdamped.
    ///
    /// # Errors
    /// A time that is negative or not finite.
    pub fn free_vibration(&self, t: f64) -> Result<Option<FreeVibration>, ChirpChartError> {
        let s = self.state(t)?;
        let (w, n) = (self.drive.oscillator.w(), self.drive.oscillator.n());
        if n >= w {
            return Ok(None);
        }
        let off = s.displacement - s.cam;
        let quadrature = (s.velocity + n * off) / ((w - n) * (w + n)).sqrt();
        Ok(Some(FreeVibration {
            amplitude: off.hypot(quadrature),
            phase: (-quadrature).atan2(off),
        }))
    }

    /// The time nearest to `t` at which a high dwell ends and the return begins; none if there is
    /// no high dwell, if it ended before the motion began, or if the shaft turns back before its
    /// end.
    pub(super) fn end_of_dwell(&self, t: f64) -> Option<f64> {
        let cycle = &self.drive.cycle;
        let due = cycle.start() + cycle.rise().turns + cycle.high_dwell();
        let now = self.drive.turns(t);
        let speed = self.drive.speed(t);
        let ahead = (due - now).rem_euclid(1.0);
        // On the nearer side, as the turn that is looked at is centred.
        let ahead = TAU * if ahead > 0.5 { ahead - 1.0 } else { ahead };
        let square = speed * speed + 2.0 * self.drive.chirp.eps * ahead;
        if cycle.high_dwell() == 0.0 || square <= 0.0 {
            return None;
        }
        let end = t + 2.0 * ahead / (speed + square.sqrt().copysign(speed));
        (end > 0.0).then_some(end)
    }
}

/// Times from one to the other for a motion whose highest frequency is `fastest`.
fn places(times: [f64; 2], fastest: f64) -> Vec<f64> {
    let periods = (times[1] - times[0]) * fastest / TAU;
    let wanted = (SAMPLES * periods).max(LEAST_SAMPLES);
    let count = wanted.min(MOST_SAMPLES).ceil() as usize;
    let step = (times[1] - times[0]) / count as f64;
    (0..=count).map(|i| times[0] + step * i as f64).collect()
}

#[cfg(test)]
mod tests;
