//! Oscillator, speed programme, harmonics and what comes out.

use super::error::{ChirpError, finite, not_negative, positive};
use num_complex::Complex;

/// `y″ + 2n y′ + w² y`: natural circular frequency `w` and damping coefficient `n`, both in rad/s.
///
/// `n = 0` is undamped, `n = w` critical, `n > w` overdamped; the damping ratio is `n/w`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Oscillator {
    w: f64,
    n: f64,
}

impl Oscillator {
    /// An oscillator.
    ///
    /// # Errors
    /// Numbers that are not finite, `w ≤ 0`, `n < 0`.
    ///
    /// ```
    /// use mechaudit_solvers::chirp_oscillator::Oscillator;
    /// assert!(Oscillator::new(10.0, 0.5).is_ok());
    /// let wrong = Oscillator::new(10.0, -0.5).unwrap_err();
    /// assert_eq!(wrong.to_string(), "n = -0.5 must not be negative");
    /// ```
    pub fn new(w: f64, n: f64) -> Result<Oscillator, ChirpError> {
        Ok(Oscillator {
            w: positive("w", w)?,
            n: not_negative("n", n)?,
        })
    }

    /// Natural circular frequency `w`, rad/s.
    pub fn w(&self) -> f64 {
        self.w
    }

    /// Damping coefficient `n`, rad/s.
    pub fn n(&self) -> f64 {
        self.n
    }
}

/// A shaft's angle `Ω₀ t + ε t²/2`: speed `Ω₀` at `t = 0` in rad/s and acceleration `ε` in rad/s²,
/// either of either sign or zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chirp {
    /// Speed at `t = 0`, rad/s.
    pub omega0: f64,
    /// Acceleration, rad/s².
    pub eps: f64,
}

/// A term `D cos(k (Ω₀ t + ε t²/2) + δ)` of the excitation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Harmonic {
    /// Multiple `k` of the shaft's angle; usually a whole number, but any will do.
    pub k: f64,
    /// Amplitude `D`, in the unit of [`Forcing`].
    pub amplitude: f64,
    /// Phase `δ`, rad.
    pub phase: f64,
}

/// Describes what the amplitudes of the excitation are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Forcing {
    /// Displacements of the driven end of the spring: the right-hand side is
    /// `w² (a₀ + Σ D_k cos θ_k)` (Gembara & Senyk (7)).
    #[default]
    Displacement,
    /// Accelerations: the right-hand side is `a₀ + Σ D_k cos θ_k`.
    Acceleration,
}

/// The right-hand side.
#[derive(Clone, Debug, PartialEq)]
pub struct Excitation {
    /// The shaft.
    pub chirp: Chirp,
    /// Holds what the amplitudes are.
    pub forcing: Forcing,
    /// The constant `a₀`, in the unit of the amplitudes.
    pub static_term: f64,
    /// The harmonics.
    pub harmonics: Vec<Harmonic>,
}

/// The state at `t = 0`; at rest by default.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct InitialState {
    /// `y(0)`.
    pub displacement: f64,
    /// `y′(0)`.
    pub velocity: f64,
}

/// Displacement and its derivatives at one time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Motion {
    /// `y`.
    pub displacement: f64,
    /// `y′`.
    pub velocity: f64,
    /// `y″`.
    pub acceleration: f64,
}

impl Motion {
    /// The spring's deflection `y − f`, `f` the displacement of the driven end:
    /// `−(y″ + 2n y′)/w²`, which does not cancel where `y` follows `f` closely.
    pub fn deflection(&self, oscillator: &Oscillator) -> f64 {
        let Oscillator { w, n } = *oscillator;
        -(2.0 * n).mul_add(self.velocity, self.acceleration) / w / w
    }
}

/// The response to one harmonic from rest, `y = Re A e^{−iθ}`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HarmonicResponse {
    /// Complex amplitude `A`.
    pub amplitude: Complex<f64>,
    /// `y`, `y′`, `y″`.
    pub motion: Motion,
}

impl HarmonicResponse {
    /// The envelope `|A|`.
    pub fn envelope(&self) -> f64 {
        self.amplitude.norm()
    }

    /// The phase `δ* = −arg A` in `(−π, π]`, by `atan2`: `y = |A| cos(θ + δ*)`.
    ///
    /// The arctangent of Gembara & Senyk (17) loses the quadrant.
    pub fn phase(&self) -> f64 {
        (-self.amplitude.im).atan2(self.amplitude.re)
    }
}

impl Excitation {
    /// Itself, if all its numbers are finite.
    pub(super) fn checked(self) -> Result<Excitation, ChirpError> {
        finite("omega0", self.chirp.omega0)?;
        finite("eps", self.chirp.eps)?;
        finite("static term", self.static_term)?;
        for h in &self.harmonics {
            finite("k", h.k)?;
            finite("amplitude", h.amplitude)?;
            finite("phase", h.phase)?;
        }
        Ok(self)
    }
}
