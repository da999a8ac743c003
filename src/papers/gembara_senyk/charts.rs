//! Charts in the manner of Fig. 5. The paper gives neither the phases of its cams nor the
//! oscillator nor the speeds, so these stand for any.

use crate::reference::chirp_oscillator::{Problem, response};
use crate::reference::{Ball, Mag, cam_law, fourier_series};
use crate::solvers::cam_law::{CamCycle, MotionLaw, Stroke};
use crate::solvers::chirp_chart::{CamDrive, CamResponse, Chart, ChirpChartError, Period};
use crate::solvers::chirp_oscillator::{Chirp, Oscillator};
use rug::{Float, Rational};

/// Natural frequency, rad/s.
pub const FREQUENCY: f64 = 100.0;
/// Damping ratio.
pub const DAMPING_RATIO: f64 = 0.02;
/// Acceleration of the shaft, rad/s², in either direction.
pub const ACCELERATION: f64 = 0.2;
/// Speed at which the run-down begins, rad/s.
pub const FASTEST: f64 = 18.0;
/// Harmonics.
pub const HARMONICS: u32 = 60;

/// The laws of Fig. 5.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Law {
    /// "К", cosine acceleration.
    K,
    /// "0050", constant acceleration.
    Constant,
}

impl Law {
    /// Its name in the paper.
    pub fn name(self) -> &'static str {
        match self {
            Law::K => "К",
            Law::Constant => "0050",
        }
    }
}

/// Which way the shaft's speed changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Programme {
    /// From rest, as the formulas have it.
    RunUp,
    /// To rest, as was measured.
    RunDown,
}

/// ξ = 2.0 … 14.0 in steps of 0.1.
pub fn grid() -> Vec<f64> {
    (20..=140).map(|i| f64::from(i) / 10.0).collect()
}

/// The chart of the motion over the paper's ξ (the rise as the period): rise, dwells and return of
/// 120, 60, 120 and 60 degrees, a lift of one.
///
/// # Errors
/// None for these data; those of the solvers.
pub fn chart(law: Law, programme: Programme) -> Result<Chart, ChirpChartError> {
    let motion = || match law {
        Law::K => MotionLaw::simple_harmonic(),
        Law::Constant => MotionLaw::constant_acceleration(),
    };
    let stroke = || Stroke {
        law: motion(),
        turns: 1.0 / 3.0,
    };
    let sixth = 1.0 / 6.0;
    let drive = CamDrive {
        oscillator: Oscillator::new(FREQUENCY, DAMPING_RATIO * FREQUENCY)?,
        cycle: CamCycle::new(1.0, stroke(), sixth, stroke(), sixth)?,
        chirp: match programme {
            Programme::RunUp => Chirp {
                omega0: 0.0,
                eps: ACCELERATION,
            },
            Programme::RunDown => Chirp {
                omega0: FASTEST,
                eps: -ACCELERATION,
            },
        },
    };
    Chart::of_motion(
        &CamResponse::new(drive, HARMONICS, None)?,
        Period::Rise,
        &grid(),
    )
}

/// `Σ|A_k|` of the run-up at `ξ` (19), corrected and enclosed.
pub fn certified(law: Law, xi: &Rational, prec: u32) -> Ball {
    let q = |n: i32, d: u32| Rational::from((n, d));
    // The share of a cosine; nothing of the law is without acceleration.
    let d = match law {
        Law::K => q(1, 1),
        Law::Constant => Rational::new(),
    };
    let b = Rational::new();
    let form = cam_law::Law::stretched(&cam_law::Family::Scca { b, d }, &q(1, 2));
    let stroke = |start: Rational| fourier_series::Stroke {
        law: form.clone(),
        start,
        turns: q(1, 3),
    };
    let (rise, fall) = (stroke(q(0, 1)), stroke(q(1, 2)));
    // t = w_rise/(εξ): the speed is a third of w over ξ.
    let t = q(100, 3) * q(5, 1) / xi;
    let orders = fourier_series::Orders {
        first: 1,
        stride: 1,
        count: HARMONICS,
    };
    let harmonics = fourier_series::harmonics(&q(1, 1), &rise, Some(&fall), orders, prec);
    (1..=HARMONICS)
        .zip(harmonics)
        .fold(Ball::integer(prec, 0), |sum, (k, [a, b])| {
            let forcing = hypotenuse(&a, &b);
            let o = Rational::new;
            let values = [
                q(100, 1),
                q(2, 1),
                q(1, 5),
                o(),
                Rational::from(k),
                o(),
                o(),
                o(),
                t.clone(),
            ];
            let amplitude = Problem::new(&values)
                .ok()
                .and_then(|p| response(&p, prec).ok());
            match amplitude {
                Some(r) => sum + forcing * r.amplitude.norm_sqr().sqrt(),
                None => Ball::new(Float::new(prec), Mag::INFINITY),
            }
        })
}

/// `√(a² + b²)`, also where both may vanish.
fn hypotenuse(a: &Ball, b: &Ball) -> Ball {
    let square = a.square() + b.square();
    match square.contains_zero() {
        true => Ball::integer(a.prec(), 0).widened(a.magnitude().add(b.magnitude())),
        false => square.sqrt(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_harmonic_that_may_vanish_is_enclosed() {
        let ball =
            |middle: i64, radius: i64| Ball::integer(64, middle).widened(Mag::power_of_two(radius));
        assert!(hypotenuse(&ball(3, -50), &ball(4, -50)).overlaps(&Ball::integer(64, 5)));
        // Up to (1, 1), and to (1, 0).
        let both = hypotenuse(&ball(0, 0), &ball(0, 0));
        assert!(both.contains_zero() && both.overlaps(&Ball::integer(64, 2).sqrt()));
        let one = hypotenuse(&ball(0, 0), &ball(0, -50));
        assert!(one.overlaps(&Ball::integer(64, 1)));
    }
}
