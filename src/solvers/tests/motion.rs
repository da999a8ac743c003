//! Cam laws, their Fourier series, and the oscillator under a chirp.

use super::{Answer, Line, hold, lines};
use crate::cam_law::{CamCycle, MotionLaw, Stroke};
use crate::chirp_oscillator::{
    Chirp, ChirpError, ChirpResponse, Excitation, Forcing, Harmonic, InitialState, Oscillator,
};
use crate::cubic_spline::End;
use crate::fourier_series::FourierSeries;

/// The law at the start of `x`, and what follows it.
fn law(x: &[f64]) -> Result<(MotionLaw, &[f64]), String> {
    let (p, rest) = x[3..].split_at(x[2] as usize);
    let symmetric = match x[0] {
        0.0 => MotionLaw::scca(p[0], 1.0 - p[0].max(p[1]) - p[0].min(p[1]), p[1]),
        1.0 => Ok(MotionLaw::polynomial_345()),
        2.0 => Ok(MotionLaw::polynomial_4567()),
        3.0 => MotionLaw::polynomial(&[&[0.0], p].concat()),
        _ => {
            let (x, y) = p.split_at(p.len() / 2);
            MotionLaw::tabulated(x.to_vec(), y.to_vec(), [End::FirstDerivative(0.0); 2])
        }
    };
    let law = match x[0] {
        0.0..3.0 => symmetric.and_then(|l| l.with_acceleration_fraction(x[1])),
        _ => symmetric,
    };
    Ok((law.map_err(|_| "law")?, rest))
}

#[test]
fn cam_law() {
    let motion = |x: &[f64]| -> Answer {
        let law = law(&x[1..])?.0;
        let m = law.motion(x[0]).map_err(|_| "place")?;
        let left = law.remaining(x[0]).map_err(|_| "place")?;
        Ok(vec![
            m.displacement,
            left,
            m.velocity,
            m.acceleration,
            m.jerk,
        ])
    };
    hold("cam-law", &[("motion", &motion)]);
}

/// The cycle of an input of the Fourier series: lift, start, rise, dwell, return, orders, laws.
fn cycle(x: &[f64]) -> Result<CamCycle, String> {
    let (rise, rest) = law(&x[7..])?;
    let fall = law(rest)?.0;
    let rise = Stroke {
        law: rise,
        turns: x[2],
    };
    let cycle = match x[4] == 0.0 {
        true => CamCycle::rise_dwell(x[0], rise, 1.0 - x[2]),
        false => {
            let fall = Stroke {
                law: fall,
                turns: x[4],
            };
            let low = 1.0 - x[2] - x[3] - x[4];
            CamCycle::new(x[0], rise, x[3], fall, low.max(0.0))
        }
    };
    cycle
        .and_then(|c| c.starting_at(x[1]))
        .map_err(|_| "cycle".into())
}

#[test]
fn fourier_series() {
    let coefficients = |x: &[f64]| -> Answer {
        let series = FourierSeries::new(&cycle(x)?);
        let mut all = Vec::new();
        for k in 0..8 {
            let h = series
                .harmonic(x[5] as u32 + k * x[6] as u32)
                .map_err(|_| "harmonic")?;
            all.extend([series.mean(), h.a, h.b]);
        }
        Ok(all)
    };
    hold("cam-fourier-series", &[("harmonics", &coefficients)]);
}

fn response(x: &[f64]) -> Result<ChirpResponse, ChirpError> {
    let harmonic = Harmonic {
        k: x[4],
        amplitude: 1.0,
        phase: x[5],
    };
    let initial = InitialState {
        displacement: x[6],
        velocity: x[7],
    };
    let chirp = Chirp {
        omega0: x[3],
        eps: x[2],
    };
    ChirpResponse::of_harmonic(Oscillator::new(x[0], x[1])?, chirp, harmonic, initial)
}

fn chirp_values(r: &ChirpResponse, t: f64) -> Result<Vec<f64>, ChirpError> {
    let m = r.motion(t)?;
    let a = r.harmonic(0, t)?.amplitude;
    Ok(vec![m.displacement, m.velocity, m.acceleration, a.re, a.im])
}

#[test]
fn chirp_response() {
    let word = |e: ChirpError| e.name().to_string();
    let motion = |x: &[f64]| -> Answer {
        let r = response(x).map_err(word)?;
        chirp_values(&r, x[8]).map_err(word)
    };
    // The same harmonic as one of three, the others without amplitude, as an acceleration.
    let among = |x: &[f64]| -> Answer {
        let zero = Harmonic {
            k: 2.0 * x[4],
            amplitude: 0.0,
            phase: 0.3,
        };
        let harmonic = Harmonic {
            k: x[4],
            amplitude: 1.0,
            phase: x[5],
        };
        let excitation = Excitation {
            chirp: Chirp {
                omega0: x[3],
                eps: x[2],
            },
            forcing: Forcing::Displacement,
            static_term: 0.0,
            harmonics: vec![harmonic, zero, zero],
        };
        let initial = InitialState {
            displacement: x[6],
            velocity: x[7],
        };
        let oscillator = Oscillator::new(x[0], x[1]).map_err(word)?;
        let r = ChirpResponse::new(oscillator, excitation, initial).map_err(word)?;
        chirp_values(&r, x[8]).map_err(word)
    };
    hold(
        "chirp-response",
        &[("motion", &motion), ("among others", &among)],
    );
}

/// Displacements alone, one by one and in batches of every length, on every path through them.
#[test]
fn chirp_displacements() {
    for line in lines("chirp-response") {
        let (Ok(r), Ok(due)) = (response(&line.input), &line.due) else {
            continue;
        };
        let t = line.input[8];
        let only = |y: f64| {
            Line {
                place: line.place.clone(),
                input: line.input.clone(),
                due: Ok(vec![due[0]]),
            }
            .check("chirp-response, displacement,", &Ok(vec![y]))
        };
        only(r.displacement(t).expect("a time"));
        for n in [1, 7, 64] {
            // The time in question at every place of a group.
            let mut times: Vec<f64> = (0..n).map(|k| t * (k as f64 / n as f64)).collect();
            for place in (0..n).step_by(if n > 8 { 9 } else { 1 }) {
                let other = std::mem::replace(&mut times[place], t);
                let mut out = vec![f64::NAN; n];
                r.displacements(&times, &mut out).expect("times");
                only(out[place]);
                times[place] = other;
            }
            let (mut out, mut motions) = (vec![0.0; n], vec![r.motion(t).expect("a time"); n]);
            r.displacements(&times, &mut out).expect("times");
            r.motions(&times, &mut motions).expect("times");
            // Of the same size as the largest of them, as roundings are.
            let size = motions
                .iter()
                .map(|m| m.displacement.abs())
                .fold(0.0, f64::max);
            let allowed = due[0].1.max(1e-12 * size);
            for ((t, y), m) in times.iter().zip(&out).zip(&motions) {
                let off = (y - m.displacement).abs();
                assert!(
                    off <= allowed || size == 0.0,
                    "{}, t = {t}: {off}",
                    line.place
                );
            }
            #[cfg(feature = "parallel")]
            {
                let mut all = vec![0.0; n];
                r.displacements_parallel(&times, &mut all).expect("times");
                assert_eq!(all, out);
            }
        }
    }
}
