//! The response from its amplitude and the free vibration.

use super::free::vibration;
use super::problem::{Problem, Response};
use crate::{Ball, ComplexBall};
use rug::Rational;

/// The response in parts: `ψ = A e^{−iθ}` and the free vibration from the initial state, both with
/// two derivatives.
pub(super) struct Parts {
    pub amplitude: ComplexBall,
    pub forced: [ComplexBall; 3],
    pub free: [Ball; 3],
}

impl Parts {
    /// From `A/w²` and `Ȧ/w²` with `ψ′ = Ȧ e^{−iθ}`.
    pub fn new(p: &Problem, prec: u32, amplitude: &ComplexBall, rate: &ComplexBall) -> Parts {
        let real = |q: &Rational| Ball::rational(prec, q);
        let square = real(&Rational::from(p.w.square_ref()));
        let twice = real(&Rational::from(&p.n * 2));
        let carrier = p.carrier(prec);
        let amplitude = amplitude.scaled(&square);
        let psi = &amplitude * &carrier;
        let first = &rate.scaled(&square) * &carrier;
        let second = &(&carrier - &psi).scaled(&square) - &first.scaled(&twice);
        Parts {
            amplitude,
            forced: [psi, first, second],
            free: vibration(p, prec),
        }
    }

    /// The motion.
    pub fn response(self) -> Response {
        let [y, v, a] = [0, 1, 2].map(|i| &self.forced[i].re + &self.free[i]);
        Response {
            y,
            v,
            a,
            amplitude: self.amplitude,
        }
    }
}
