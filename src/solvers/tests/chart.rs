//! The chart of a cam-driven oscillator, put together once more from its parts.

use crate::solvers::cam_law::{CamCycle, MotionLaw, Stroke};
use crate::solvers::chirp_chart::{CamDrive, CamResponse, Chart, Period};
use crate::solvers::chirp_oscillator::{
    Chirp, ChirpResponse, Excitation, Forcing, Harmonic, InitialState, Oscillator,
};
use crate::solvers::fourier_series::FourierSeries;
use num_complex::Complex;
use std::f64::consts::TAU;

const LIFT: f64 = 0.02;
const RISE: f64 = 0.3;
const HARMONICS: u32 = 12;
const W: f64 = 40.0;

fn drive() -> CamDrive {
    let stroke = |law, turns| Stroke { law, turns };
    let (rise, fall) = (MotionLaw::modified_sine(), MotionLaw::cycloidal());
    let cycle = CamCycle::new(LIFT, stroke(rise, RISE), 0.2, stroke(fall, 0.35), 0.15);
    CamDrive {
        oscillator: Oscillator::new(W, 1.5).expect("an oscillator"),
        cycle: cycle.expect("a cycle"),
        chirp: Chirp {
            omega0: 3.0,
            eps: 0.7,
        },
    }
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-11 * b.abs()
}

#[test]
fn bounds_are_sums_over_the_harmonics() {
    let drive = drive();
    let r = CamResponse::new(drive.clone(), HARMONICS, None).expect("a response");
    let series = FourierSeries::new(&drive.cycle);
    let terms = series.harmonics(HARMONICS).expect("harmonics");
    let harmonics = terms.iter().map(|h| Harmonic {
        k: f64::from(h.order),
        amplitude: h.amplitude(),
        phase: h.phase(),
    });
    let excitation = Excitation {
        chirp: drive.chirp,
        forcing: Forcing::Displacement,
        static_term: series.mean(),
        harmonics: harmonics.collect(),
    };
    let start = InitialState::default();
    let alone = ChirpResponse::new(drive.oscillator, excitation, start).expect("a response");
    for t in [0.3, 2.0, 9.0, 40.0] {
        let (mut sum, mut spring) = (0.0, 0.0);
        for (k, h) in terms.iter().enumerate() {
            let a = alone.harmonic(k, t).expect("a harmonic").amplitude;
            sum += a.norm();
            spring += W * W * (Complex::from(h.amplitude()) - a).norm();
        }
        let [bound, acceleration] = r.bounds(t).expect("bounds");
        assert!(close(bound, sum) && close(acceleration, spring), "{t}");
    }
}

#[test]
fn points_are_peaks_in_units_of_the_stroke() {
    let r = CamResponse::new(drive(), HARMONICS, None).expect("a response");
    let grid = [0.4, 0.9, 1.3];
    let chart = Chart::new(&r, Period::Rise, &grid).expect("a chart");
    assert_eq!(chart.points.len(), 3);
    for (p, xi) in chart.points.iter().zip(grid) {
        let speed = W * RISE / xi;
        assert!(
            close(p.speed, speed) && close(p.t, (speed - 3.0) / 0.7),
            "{xi}"
        );
        assert!(close(p.xi_rise, xi) && close(p.xi_turn, xi / RISE), "{xi}");
        // The rise takes the time T = 2π·RISE/Ω.
        let time = TAU * RISE / speed;
        let (peaks, [bound, spring]) = (r.peaks(p.t), r.bounds(p.t).expect("bounds"));
        let acceleration = peaks.acceleration * time * time / LIFT;
        assert!(close(p.displacement, peaks.displacement / LIFT), "{xi}");
        assert!(close(p.bound, bound / LIFT), "{xi}");
        assert!(
            close(p.acceleration_bound, spring * time * time / LIFT),
            "{xi}"
        );
        assert!(close(p.acceleration, acceleration), "{xi}");
        // Moment in h²/(β T²), power in h²/T³, both per unit of mass.
        let angle = TAU * RISE;
        let moment = peaks.moment * angle * time * time / (LIFT * LIFT);
        let power = peaks.power * time.powi(3) / (LIFT * LIFT);
        let due = [acceleration, moment, power];
        for ((got, due), rigid) in p.dynamic_coefficients.iter().zip(due).zip(chart.rigid) {
            assert!(close(*got, due / rigid), "{xi}");
        }
    }
}
