//! The problem and its answer.

use crate::{Ball, ComplexBall};
use rug::Rational;
use std::cmp::Ordering;

/// One harmonic of unit amplitude and an initial state, all numbers exact.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    /// Natural circular frequency `w > 0`.
    pub w: Rational,
    /// Damping coefficient `n ≥ 0`.
    pub n: Rational,
    /// Acceleration `ε` of the shaft.
    pub eps: Rational,
    /// Its speed `Ω₀` at `t = 0`.
    pub omega0: Rational,
    /// Multiple `k` of its angle.
    pub k: Rational,
    /// Phase `δ`.
    pub delta: Rational,
    /// `y(0)`.
    pub y0: Rational,
    /// `y′(0)`.
    pub v0: Rational,
    /// Time `t ≥ 0`.
    pub t: Rational,
}

/// Why there is no response.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ProblemError {
    /// `w ≤ 0`.
    #[error("{name} must be greater than zero")]
    NotPositive {
        /// The parameter.
        name: &'static str,
    },
    /// `n < 0` or `t < 0`.
    #[error("{name} must not be negative")]
    Negative {
        /// The parameter.
        name: &'static str,
    },
}

impl ProblemError {
    /// One word for the kind of error.
    pub fn name(&self) -> &'static str {
        match self {
            ProblemError::NotPositive { .. } => "not positive",
            ProblemError::Negative { .. } => "negative",
        }
    }
}

impl Problem {
    /// From `w, n, ε, Ω₀, k, δ, y₀, v₀, t`.
    ///
    /// # Errors
    /// `w ≤ 0`, `n < 0`, `t < 0`.
    pub fn new(values: &[Rational; 9]) -> Result<Problem, ProblemError> {
        let [w, n, eps, omega0, k, delta, y0, v0, t] = values.clone();
        if w.cmp0() != Ordering::Greater {
            return Err(ProblemError::NotPositive { name: "w" });
        }
        for (name, x) in [("n", &n), ("t", &t)] {
            if x.cmp0() == Ordering::Less {
                return Err(ProblemError::Negative { name });
            }
        }
        Ok(Problem {
            w,
            n,
            eps,
            omega0,
            k,
            delta,
            y0,
            v0,
            t,
        })
    }

    /// `ν = kΩ₀`.
    pub(super) fn nu(&self) -> Rational {
        Rational::from(&self.k * &self.omega0)
    }

    /// `κ = kε`.
    pub(super) fn kappa(&self) -> Rational {
        Rational::from(&self.k * &self.eps)
    }

    /// `n² − w²`, the square of half the distance of the roots.
    pub(super) fn square(&self) -> Rational {
        Rational::from(&self.n - &self.w) * Rational::from(&self.n + &self.w)
    }

    /// `νt + κt²/2`.
    pub(super) fn turned(&self) -> Rational {
        (self.nu() + self.kappa() * &self.t / 2) * &self.t
    }

    /// `e^{−iθ(t)}`.
    pub(super) fn carrier(&self, prec: u32) -> ComplexBall {
        let theta = self.turned() + &self.delta;
        ComplexBall::unit(&Ball::rational(prec, &theta)).conj()
    }
}

/// `y`, `y′`, `y″` and the complex amplitude `A` of the response from rest, `y = Re A e^{−iθ}`
/// then.
#[derive(Clone, Debug)]
pub struct Response {
    /// `y(t)`.
    pub y: Ball,
    /// `y′(t)`.
    pub v: Ball,
    /// `y″(t)`.
    pub a: Ball,
    /// `A(t)`.
    pub amplitude: ComplexBall,
}

impl Response {
    /// All components.
    pub fn components(&self) -> [&Ball; 5] {
        let Response { y, v, a, amplitude } = self;
        [y, v, a, &amplitude.re, &amplitude.im]
    }
}
