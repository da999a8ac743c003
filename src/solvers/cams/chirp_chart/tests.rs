use super::*;
use crate::cam_law::{CamCycle, MotionLaw, Stroke};
use crate::chirp_oscillator::{
    Chirp, ChirpResponse, Excitation, Forcing, Harmonic, InitialState, Oscillator,
};
use crate::fourier_series::FourierSeries;
use num_complex::Complex;
use std::f64::consts::TAU;

fn drive(law: MotionLaw, omega0: f64, eps: f64) -> CamDrive {
    let stroke = |turns| Stroke {
        law: law.clone(),
        turns,
    };
    CamDrive {
        oscillator: Oscillator::new(100.0, 3.0).unwrap(),
        cycle: CamCycle::new(0.02, stroke(0.25), 0.25, stroke(0.3), 0.2).unwrap(),
        chirp: Chirp { omega0, eps },
    }
}

/// Classical Runge–Kutta steps on the cam's own displacement.
fn integrated(d: &CamDrive, t: f64, steps: usize) -> [f64; 2] {
    let (w, n) = (d.oscillator.w(), d.oscillator.n());
    let h = t / steps as f64;
    let rate = |t: f64, [y, v]: [f64; 2]| {
        let f = d.cycle.at(d.turns(t)).unwrap().displacement;
        [v, w * w * (f - y) - 2.0 * n * v]
    };
    let mut s = [0.0, 0.0];
    for k in 0..steps {
        let t = h * k as f64;
        let along = |d: [f64; 2], f: f64| [s[0] + f * d[0], s[1] + f * d[1]];
        let a = rate(t, s);
        let b = rate(t + 0.5 * h, along(a, 0.5 * h));
        let c = rate(t + 0.5 * h, along(b, 0.5 * h));
        let e = rate(t + h, along(c, h));
        for i in 0..2 {
            s[i] += h / 6.0 * (a[i] + 2.0 * (b[i] + c[i]) + e[i]);
        }
    }
    s
}

#[test]
fn the_state_is_that_of_the_equation_of_motion() {
    for (omega0, eps) in [(0.0, 8.0), (30.0, -8.0), (10.0, -10.0), (25.0, 0.0)] {
        let d = drive(MotionLaw::modified_sine(), omega0, eps);
        let r = CamResponse::new(d.clone(), 120, None).unwrap();
        let t = 2.3;
        let s = r.state(t).unwrap();
        let [y, v] = integrated(&d, t, 20_000);
        assert!(
            (s.displacement - y).abs() < 1e-8,
            "{eps} {} {y}",
            s.displacement
        );
        assert!((s.velocity - v).abs() < 1e-5, "{eps} {} {v}", s.velocity);
        let rate = 1e4 * (s.cam - y) - 6.0 * v;
        assert!((s.acceleration - rate).abs() < 1e-3, "{eps}");
    }
}

#[test]
fn a_stiff_follower_has_coefficients_of_one() {
    let mut d = drive(MotionLaw::cycloidal(), 1.0, 0.01);
    d.oscillator = Oscillator::new(300.0, 60.0).unwrap();
    let r = CamResponse::new(d, 500, None).unwrap();
    let chart = Chart::new(&r, Period::Turn, &[150.0]).unwrap();
    for k in chart.points[0].dynamic_coefficients {
        assert!((k - 1.0).abs() < 0.03, "{k}");
    }
}

#[test]
fn the_dwell_goes_on_with_its_free_vibration() {
    let d = drive(MotionLaw::simple_harmonic(), 20.0, 0.0);
    let r = CamResponse::new(d, 400, None).unwrap();
    // High dwell from 0.25 to 0.5 turns; the fifth turn.
    let time = |turns: f64| TAU * turns / 20.0;
    let from = time(4.26);
    let free = r.free_vibration(from).unwrap().unwrap();
    let w3 = (100.0f64 * 100.0 - 9.0).sqrt();
    for turns in [4.3, 4.4, 4.49] {
        let tau = time(turns) - from;
        let due = free.amplitude * (-3.0 * tau).exp() * (w3 * tau + free.phase).cos();
        let s = r.state(time(turns)).unwrap();
        assert!(
            (s.displacement - s.cam - due).abs() < 1e-5 * free.amplitude,
            "{turns}"
        );
    }
}

#[test]
fn times_and_refusals() {
    let down = drive(MotionLaw::cycloidal(), 60.0, -2.0);
    assert!((down.time_of(2.0, Period::Turn).unwrap() - 5.0).abs() < 1e-12);
    assert!((down.time_of(1.0, Period::Rise).unwrap() - 17.5).abs() < 1e-12);
    // Backward, after the reversal at 30 s.
    assert!((down.time_of(100.0 / 70.0, Period::Turn).unwrap() - 65.0).abs() < 1e-9);
    let steady = drive(MotionLaw::cycloidal(), 60.0, 0.0);
    let says = |e: Result<f64, ChirpChartError>| e.unwrap_err().to_string();
    assert!(says(steady.time_of(2.0, Period::Turn)).contains("does not have"));
    assert!(says(down.time_of(f64::NAN, Period::Turn)).contains("xi = NaN"));
    assert!(says(down.time_of(0.0, Period::Turn)).contains("xi = 0"));
    let mut carried = steady.clone();
    let law = MotionLaw::cycloidal();
    carried.cycle = CamCycle::rise_dwell(1.0, Stroke { law, turns: 0.5 }, 0.5).unwrap();
    assert_eq!(
        CamResponse::new(carried, 5, None).unwrap_err(),
        ChirpChartError::NoReturn
    );
    let wrong = InitialState {
        displacement: f64::NAN,
        velocity: 0.0,
    };
    assert!(CamResponse::new(steady, 5, Some(wrong)).is_err());
}

const LIFT: f64 = 0.02;
const RISE: f64 = 0.3;
const HARMONICS: u32 = 12;
const W: f64 = 40.0;

fn two_laws() -> CamDrive {
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
    let drive = two_laws();
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
    let r = CamResponse::new(two_laws(), HARMONICS, None).expect("a response");
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
    let mut drive = two_laws();
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
