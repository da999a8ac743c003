//! The chart of a cam-driven oscillator, put together once more from its parts.

use crate::cam_law::{CamCycle, MotionLaw, Stroke};
use crate::chirp_chart::{CamDrive, CamResponse, Chart, Period, beat_zones};
use crate::chirp_oscillator::{
    Chirp, ChirpResponse, Excitation, Forcing, Harmonic, InitialState, Oscillator,
};
use crate::fourier_series::FourierSeries;
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
    let motion = Chart::of_motion(&r, Period::Rise, &grid).expect("a chart");
    for (p, m) in chart.points.iter().zip(&motion.points) {
        let same = |a: f64, b: f64| a.to_bits() == b.to_bits();
        assert!(same(p.displacement, m.displacement) && same(p.acceleration, m.acceleration));
        assert!(m.dynamic_coefficients[1..].iter().all(|k| k.is_nan()));
    }
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

fn started(omega0: f64, eps: f64) -> CamResponse {
    let mut drive = drive();
    drive.chirp = Chirp { omega0, eps };
    drive.cycle = drive.cycle.starting_at(0.13).expect("a start");
    CamResponse::new(drive, HARMONICS, None).expect("a response")
}

/// Half a turn to either side of a time, and no further than where the shaft turns back.
#[test]
fn the_turn_looked_at_is_centred() {
    let times = |r: &CamResponse, t: f64| r.peaks(t).times;
    for (omega0, eps, t) in [
        (3.0, 0.7, 9.0),
        (60.0, -2.0, 5.0),
        (60.0, -2.0, 65.0),
        (25.0, 0.0, 4.0),
        (-20.0, 0.0, 3.0),
        (-9.0, -0.5, 3.0),
    ] {
        let r = started(omega0, eps);
        let d = r.drive();
        let [a, b] = times(&r, t);
        assert!(a < t && t < b, "{omega0} {eps}: {a} {t} {b}");
        for (time, half) in [(a, -0.5), (b, 0.5)] {
            let due = d.turns(t) + half * d.speed(t).signum();
            let off = (d.turns(time) - due).abs();
            assert!(off < 1e-12 * (1.0 + due.abs()), "{omega0} {eps}: {off}");
            assert!(d.speed(time) * d.speed(t) > 0.0, "{omega0} {eps}");
        }
    }
    // It turns back at 1 s; a tenth of a second away it is 0.05 rad from there.
    let r = started(10.0, -10.0);
    assert!((times(&r, 0.9)[1] - 1.0).abs() < 1e-15 && times(&r, 0.9)[0] < 0.5);
    assert!((times(&r, 1.1)[0] - 1.0).abs() < 1e-15 && times(&r, 1.1)[1] > 1.5);
    // Nothing is before the start.
    assert_eq!(times(&started(3.0, 0.7), 0.1)[0], 0.0);
}

/// The spring's force from the deflection where harmonics left out are filtered away, from the
/// harmonics where they are not.
#[test]
fn forces_of_the_spring() {
    for (eps, spring_from_cam) in [(0.499, false), (0.5, true), (0.6, true), (0.0, false)] {
        // Twelve harmonics of 5 rad/s are at 1.5 w.
        let r = started(3.0, eps);
        let (d, t) = (r.drive(), 4.0);
        let s = r.state(t).expect("a state");
        let at = d.cycle.at(d.turns(t)).expect("a place");
        assert_eq!((s.t, s.turns, s.speed), (t, d.turns(t), d.speed(t)));
        assert_eq!((s.cam, s.cam_rate), (at.displacement, at.velocity));
        let n = d.oscillator.n();
        assert!(close(s.spring, s.acceleration + 2.0 * n * s.velocity));
        let deflection = W * W * (s.cam - s.displacement);
        let size = W * W * LIFT;
        let off = (s.spring - deflection).abs() / size;
        assert_eq!(off < 1e-14, spring_from_cam, "{eps}: {off}");
        // The velocity changes at the rate of the acceleration, up to what was left out.
        let h = 1e-5;
        let v = |t: f64| r.state(t).expect("a state").velocity;
        let rate = (v(t + h) - v(t - h)) / (2.0 * h);
        let allowed = if spring_from_cam { 0.05 } else { 1e-7 };
        assert!((s.acceleration - rate).abs() < allowed * size, "{eps}");
    }
}

#[test]
fn means_and_speeds_of_the_shaft() {
    let r = started(3.0, 0.7);
    assert_eq!(r.mean(), FourierSeries::new(&r.drive().cycle).mean());
    let d = r.drive();
    // The time 0 counts, infinite criteria do not.
    assert_eq!(d.time_of(W / 3.0, Period::Turn).expect("a time"), 0.0);
    assert!(d.time_of(f64::INFINITY, Period::Turn).is_err());
    assert!(d.time_of(-1.0, Period::Turn).is_err());
    assert!(close(
        d.criterion(-8.0, Period::Rise) * 8.0,
        W * d.cycle.rise().turns
    ));
}

/// The dwell is looked at where the return begins that is nearest.
#[test]
fn the_return_that_is_nearest() {
    let due = 0.13 + RISE + 0.2;
    for (omega0, eps) in [(3.0, 0.7), (60.0, -2.0)] {
        let r = started(omega0, eps);
        let d = r.drive();
        for k in 0..6 {
            let speed = 10.0 + 3.4 * f64::from(k);
            let grid = [W / speed];
            let chart = Chart::new(&r, Period::Turn, &grid).expect("a chart");
            let p = chart.points[0];
            assert_eq!(chart.xi(&p), p.xi_turn);
            let whole = (d.turns(p.t) - due).round();
            let target = due + whole;
            if target <= 0.0 {
                assert!(p.dwell_amplitude.is_nan() && p.dwell_phase.is_nan());
                continue;
            }
            let (mut a, mut b) = ((p.t - 1.0).max(0.0), p.t + 1.0);
            for _ in 0..100 {
                let m = 0.5 * (a + b);
                if d.turns(m) < target { a = m } else { b = m }
            }
            let v = r.free_vibration(a).expect("a time").expect("vibrates");
            let off = (p.dwell_amplitude * LIFT / v.amplitude - 1.0).abs();
            assert!(off < 1e-8, "{omega0} {eps} {speed}: {off}");
            assert!((p.dwell_phase - v.phase).abs() < 1e-6, "{omega0} {eps}");
        }
    }
    // Where the shaft turns back before it, no dwell ends.
    let r = started(7.0, -7.0);
    let chart = Chart::new(&r, Period::Turn, &[W / 0.5]).expect("a chart");
    let p = chart.points[0];
    assert!(p.dwell_amplitude.is_nan() && p.dwell_phase.is_nan());
}

/// Parabolas have the vertices that they have, whatever the steps.
#[test]
fn beats_of_parabolas() {
    let vertices = [(1.7, 3.0, 2.0), (6.2, 1.5, 0.5), (10.9, 4.0, 3.0)];
    let mut curve = Vec::new();
    for (at, height, k) in vertices {
        for off in [-1.6, -0.9, -0.25, 0.4, 1.1, 1.45] {
            curve.push((at + off, height - k * off * off));
        }
    }
    let zones = beat_zones(&curve);
    assert_eq!(zones.len(), 3, "{zones:?}");
    for (z, (at, height, _)) in zones.iter().zip(vertices) {
        assert!((z.xi - at).abs() < 1e-13 && (z.value - height).abs() < 1e-13);
    }
    assert!(zones[0].spacing.is_nan());
    assert!((zones[1].spacing - 4.5).abs() < 1e-13);
    assert!((zones[2].spacing - 4.7).abs() < 1e-13);
    // Two equal tops are one maximum between them; a level stretch has none on its rising side.
    let tops = beat_zones(&[(0.0, 0.0), (1.0, 2.0), (2.0, 2.0), (3.0, 0.0)]);
    assert!(tops.len() == 1 && (tops[0].xi - 1.5).abs() < 1e-15);
    assert!(beat_zones(&[(0.0, 1.0), (1.0, 1.0), (2.0, 1.0)]).is_empty());
    assert!(beat_zones(&[(0.0, 1.0), (1.0, 1.0), (2.0, 0.0)]).is_empty());
}
