//! `eval chirp.response`: the chirp-forced oscillator, one harmonic of unit amplitude.

use super::eval_functions::{Function, certified};
use mechaudit::reference::chirp_oscillator::{Problem, response};
use mechaudit::reference::{Ball, Undecided};
use mechaudit::solvers::chirp_oscillator::{
    Chirp, ChirpError, ChirpResponse, Harmonic, InitialState, Oscillator,
};
use rug::Rational;

pub const NAME: &str = "chirp.response";

pub fn function() -> Function {
    Function {
        name: NAME,
        summary: "y'' + 2n y' + w^2 y = w^2 cos(k (omega0 t + eps t^2/2) + delta), y = Re A e^(-i theta) from rest",
        arguments: &["w", "n", "eps", "omega0", "k", "delta", "y0", "v0", "t"],
        values: &["y", "v", "a", "A_re", "A_im"],
        // Refused arguments have been found before.
        solve: |x| values(x).unwrap_or_else(|_| vec![f64::NAN; 5]),
        certify: |x, digits| {
            certified(digits, |bits| {
                let balls = certify(x, bits)?;
                Ok(balls.iter().map(|b| b.to_decimal(digits)).collect())
            })
        },
    }
}

/// Why the arguments are refused, if they are.
pub fn refusal(x: &[f64]) -> Option<String> {
    values(x).err().map(|e| e.to_string())
}

fn values(x: &[f64]) -> Result<Vec<f64>, ChirpError> {
    let &[w, n, eps, omega0, k, delta, y0, v0, t] = x else {
        unreachable!("the number of fields is checked")
    };
    let harmonic = Harmonic {
        k,
        amplitude: 1.0,
        phase: delta,
    };
    let initial = InitialState {
        displacement: y0,
        velocity: v0,
    };
    let chirp = Chirp { omega0, eps };
    let response = ChirpResponse::of_harmonic(Oscillator::new(w, n)?, chirp, harmonic, initial)?;
    let m = response.motion(t)?;
    let a = response.harmonic(0, t)?.amplitude;
    Ok(vec![m.displacement, m.velocity, m.acceleration, a.re, a.im])
}

/// `y, v, a, Re A, Im A`, each with a relative radius of at most 2^-bits.
fn certify(x: &[Rational], bits: u32) -> Result<Vec<Ball>, Undecided> {
    let undecided = |reason: String| Undecided { bits, reason };
    let values: &[Rational; 9] = x.try_into().map_err(|_| undecided("nine fields".into()))?;
    let problem = Problem::new(values).map_err(|e| undecided(e.to_string()))?;
    let r = response(&problem, bits)?;
    Ok(r.components().map(Clone::clone).to_vec())
}
