use super::*;
use crate::cam_law::{CamCycle, MotionLaw, Stroke};
use crate::chirp_oscillator::{Chirp, InitialState, Oscillator};
use std::f64::consts::{PI, TAU};

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
fn peaks_and_bounds() {
    let d = drive(MotionLaw::simple_harmonic(), 0.0, 0.5);
    let r = CamResponse::new(d.clone(), 100, None).unwrap();
    let grid: Vec<f64> = (4..12).map(f64::from).collect();
    let chart = Chart::new(&r, Period::Rise, &grid).unwrap();
    for (p, xi) in chart.points.iter().zip(grid) {
        assert!((p.xi_rise - xi).abs() < 1e-12 && (p.xi_turn - 4.0 * xi).abs() < 1e-12);
        // The start is over: half a turn before, e^{−nt} of it is left.
        let left = (-3.0 * (p.t - PI / p.speed)).exp();
        assert!(p.displacement <= p.bound + 2.0 * left, "{p:?}");
        let [first, last] = r.peaks(p.t).times;
        let turned = r.drive().turns(last) - r.drive().turns(first);
        assert!((turned - 1.0).abs() < 1e-9, "{turned}");
        let c_a = PI * PI / 2.0;
        assert!((p.dynamic_coefficients[0] * c_a - p.acceleration).abs() < 1e-12);
        let mut largest = 0.0f64;
        for k in 0..=1000 {
            let t = first + (last - first) * f64::from(k) / 1000.0;
            let rate = p.speed / (TAU * 0.25);
            let a = r.state(t).unwrap().acceleration.abs() / (0.02 * rate * rate);
            largest = largest.max(a);
        }
        assert!(largest <= p.acceleration * (1.0 + 1e-9), "{largest} {p:?}");
        assert!(largest >= p.acceleration * 0.99, "{largest} {p:?}");
    }
    // K exceeds one for a law whose acceleration jumps.
    assert!(chart.points.iter().all(|p| p.dynamic_coefficients[0] > 1.0));
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
