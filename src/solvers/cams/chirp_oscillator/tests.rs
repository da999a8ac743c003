use super::*;
use num_complex::Complex;

const EPS: f64 = f64::EPSILON;

fn harmonic(k: f64, amplitude: f64, phase: f64) -> Harmonic {
    Harmonic {
        k,
        amplitude,
        phase,
    }
}

fn excitation(omega0: f64, eps: f64, harmonics: Vec<Harmonic>) -> Excitation {
    Excitation {
        chirp: Chirp { omega0, eps },
        forcing: Forcing::Displacement,
        static_term: 0.0,
        harmonics,
    }
}

fn response(w: f64, n: f64, excitation: Excitation) -> ChirpResponse {
    let oscillator = Oscillator::new(w, n).unwrap();
    ChirpResponse::new(oscillator, excitation, InitialState::default()).unwrap()
}

fn at(r: &ChirpResponse, t: f64) -> [f64; 3] {
    let m = r.motion(t).unwrap();
    [m.displacement, m.velocity, m.acceleration]
}

fn close(a: f64, b: f64, tolerance: f64) {
    assert!((a - b).abs() <= tolerance, "{a} {b}");
}

/// w, n, ε, Ω₀, end: run-up and run-down, through resonances and away from them, light, heavy and
/// critical damping, constant speed, a fast sweep and a slow one.
const SWEEPS: [[f64; 5]; 16] = [
    [100.0, 1.0, 0.05, 3.0, 100.0],
    [10.0, 9.999_999, 40.0, -10.0, 6.0],
    [10.0, 14.1, 4.0, -10.0, 25.0],
    [10.0, 0.3, 0.0, 10.0, 25.0],
    [1.0, 0.1, 900.0, -30.0, 1.0],
    [10.0, 0.5, 4.0, 0.0, 12.0],
    [10.0, 0.01, 0.4, 1.0, 60.0],
    [10.0, 0.0, 2.0, 3.0, 20.0],
    [10.0, 2.0, -3.0, 25.0, 20.0],
    [10.0, 9.999_999, 4.0, 0.0, 10.0],
    [10.0, 10.0, 4.0, -10.0, 10.0],
    [10.0, 0.3, 0.0, 3.7, 25.0],
    [1.0, 0.1, 1e-3, 0.2, 900.0],
    [300.0, 5.0, 20.0, 10.0, 8.0],
    [3.0, 0.02, 0.3, 50.0, 30.0],
    [1.0, 0.6, 0.02, 1e7, 100.0],
];

/// The first harmonics of a series about a mean, not from rest.
fn moved([w, n, eps, omega0, _]: [f64; 5], count: u32) -> ChirpResponse {
    let of = |k: u32| harmonic(k.into(), 1.0 / f64::from(k * k), 0.3 * f64::from(k));
    let excitation = Excitation {
        static_term: 0.2,
        ..excitation(omega0, eps, (1..=count).map(of).collect())
    };
    let initial = InitialState {
        displacement: 0.1,
        velocity: -0.2 * w,
    };
    let oscillator = Oscillator::new(w, n).expect("an oscillator");
    ChirpResponse::new(oscillator, excitation, initial).expect("a response")
}

#[test]
fn batches_of_times() {
    for sweep in SWEEPS {
        for count in [1, 4] {
            let r = moved(sweep, count);
            let [w, .., end] = sweep;
            // Not a multiple of four; of any order.
            let times: Vec<f64> = (0..61)
                .map(|i| end * f64::from(i * 23 % 61) / 60.0)
                .collect();
            let one: Vec<Motion> = times
                .iter()
                .map(|t| r.motion(*t).expect("a time"))
                .collect();
            let size = one.iter().map(|m| m.displacement.abs()).fold(0.0, f64::max);
            let fast = one
                .iter()
                .map(|m| m.velocity.abs())
                .fold(w * size, f64::max);
            let hard = one
                .iter()
                .map(|m| m.acceleration.abs())
                .fold(w * w * size, f64::max);
            let close = |got: f64, due: f64, size: f64| {
                let off = (got - due).abs() / size;
                assert!(off <= 60.0 * f64::EPSILON, "{sweep:?} {count}: {off:e}");
            };
            for length in [61, 4, 3, 1] {
                let mut motions = vec![Motion::default(); length];
                let mut displacements = vec![0.0; length];
                r.motions(&times[..length], &mut motions).expect("times");
                r.displacements(&times[..length], &mut displacements)
                    .expect("times");
                for i in 0..length {
                    close(motions[i].displacement, one[i].displacement, size);
                    close(motions[i].velocity, one[i].velocity, fast);
                    close(motions[i].acceleration, one[i].acceleration, hard);
                    close(displacements[i], one[i].displacement, size);
                    let alone = r.displacement(times[i]).expect("a time");
                    close(alone, one[i].displacement, size);
                }
            }
        }
    }
}

/// A chunk of 512 ends within; all cores do the same chunks.
#[test]
#[cfg(feature = "parallel")]
fn chunks_of_times() {
    let r = moved(SWEEPS[5], 2);
    let times: Vec<f64> = (0..1100).map(|i| 0.01 * f64::from(i)).collect();
    let mut one = (vec![0.0; 1100], vec![Motion::default(); 1100]);
    let mut all = one.clone();
    r.displacements(&times, &mut one.0).expect("times");
    r.motions(&times, &mut one.1).expect("times");
    r.displacements_parallel(&times, &mut all.0).expect("times");
    r.motions_parallel(&times, &mut all.1).expect("times");
    assert_eq!(one, all);
    for i in [0, 300, 511, 512, 777, 1023, 1024, 1099] {
        let due = r.motion(times[i]).expect("a time").displacement;
        assert!((one.0[i] - due).abs() < 1e-13 && (one.1[i].displacement - due).abs() < 1e-13);
    }
    assert!(
        r.motions_parallel(&times, &mut [Motion::default(); 3])
            .is_err()
    );
    assert!(r.displacements_parallel(&times, &mut [0.0; 3]).is_err());
    assert!(
        r.motions_parallel(&[1.0, -1.0], &mut [Motion::default(); 2])
            .is_err()
    );
}

#[test]
fn the_equation_holds() {
    let others = [
        [100.0, 2.0, 2.0, 1.0, 25.0],
        [10.0, 0.1, 4.0, 1.0, 25.0],
        [10.0, 0.0, -4.0, 12.0, 6.0],
        [10.0, 10.0, 4.0, -10.0, 6.0],
    ];
    for &[w, n, eps, omega0, end] in SWEEPS[..5].iter().chain(&others) {
        let r = response(w, n, excitation(omega0, eps, vec![harmonic(2.0, 1.0, 0.4)]));
        for i in 0..200 {
            let t = end * f64::from(i) / 199.0;
            let [y, v, a] = at(&r, t);
            let theta = 2.0 * (omega0 * t + eps * t * t / 2.0) + 0.4;
            let terms = [a, 2.0 * n * v, w * w * y, -w * w * theta.cos()];
            let size: f64 = terms.iter().map(|x| x.abs()).sum::<f64>() + w * w * theta.abs();
            close(terms.iter().sum(), 0.0, 64.0 * EPS * size);
        }
    }
}

/// Textbook results: magnification factor, secular growth, step response.
#[test]
fn stationary_limits() {
    let (w, n, omega) = (10.0, 1.5, 7.0);
    let r = response(w, n, excitation(omega, 0.0, vec![harmonic(1.0, 1.0, 0.0)]));
    let h = r.harmonic(0, 60.0).unwrap();
    let due = w * w / Complex::new(w * w - omega * omega, -2.0 * n * omega);
    assert!((h.amplitude - due).norm() < 4.0 * EPS * due.norm());
    close(h.phase(), -due.arg(), 4.0 * EPS);

    let r = response(
        2.0,
        0.0,
        excitation(2.0, 0.0, vec![harmonic(1.0, 1.0, 0.0)]),
    );
    for t in [0.1, 3.0, 50.0, 4000.0] {
        // y = wt sin(wt)/2
        close(at(&r, t)[0], t * (2.0 * t).sin(), 8.0 * EPS * t);
    }

    let mut e = excitation(1.0, 1.0, Vec::new());
    e.static_term = 3.0;
    let r = response(2.0, 0.5, e);
    close(at(&r, 200.0)[0], 3.0, 4.0 * EPS);
    // a₀ w² t²/2 (1 − 2nt/3 + …)
    let t = 1e-5;
    close(at(&r, t)[0] / (6.0 * t * t), 1.0 - t / 3.0, 1e-9);
}

#[test]
fn forcing_by_accelerations() {
    let e = excitation(3.0, 0.5, vec![harmonic(2.0, 0.5, 0.1)]);
    let by_displacement = response(5.0, 0.2, e.clone());
    let mut e = Excitation {
        forcing: Forcing::Acceleration,
        ..e
    };
    e.harmonics[0].amplitude *= 25.0;
    let by_acceleration = response(5.0, 0.2, e);
    for t in [0.3, 4.0, 20.0] {
        let (a, b) = (at(&by_displacement, t), at(&by_acceleration, t));
        for (a, b) in a.into_iter().zip(b) {
            close(a, b, 8.0 * EPS * a.abs());
        }
    }
}

#[test]
fn deflection_of_the_spring() {
    let r = response(
        50.0,
        3.0,
        excitation(0.02, 0.001, vec![harmonic(1.0, 1.0, 1.0)]),
    );
    let m = r.motion(12.0).unwrap();
    let f = (0.02f64 * 12.0 + 0.001 * 72.0 + 1.0).cos();
    let oscillator = Oscillator::new(50.0, 3.0).unwrap();
    close(m.deflection(&oscillator), m.displacement - f, 4.0 * EPS);
}

#[test]
fn envelopes_and_amplitudes() {
    let harmonics = vec![harmonic(1.0, 1.0, 0.0), harmonic(3.0, -0.4, 1.0)];
    let r = response(10.0, 0.3, excitation(1.0, 0.7, harmonics));
    let mut a = [Complex::default(); 3];
    let times = [0.5, 2.0, 9.0];
    let mut sizes = [0.0; 3];
    for index in [0, 1] {
        r.amplitudes(index, &times, &mut a).unwrap();
        for (size, a) in sizes.iter_mut().zip(a) {
            *size += a.norm();
        }
    }
    for (t, size) in times.into_iter().zip(sizes) {
        close(r.sum_of_amplitudes(t).unwrap(), size, 4.0 * EPS * size);
        // From rest there is nothing else.
        let envelope = r.envelope(t).unwrap();
        assert!(envelope >= size && envelope < size * (1.0 + 1e-12));
        assert!(at(&r, t)[0].abs() <= envelope);
    }
}

/// From any state, about any mean, with any damping: the bound holds, and below critical damping it
/// is touched.
#[test]
fn the_envelope_bounds_the_motion() {
    // Evenly spread: multiples of the golden ratio.
    let mut drawn = 0.0;
    let mut between = |low: f64, high: f64| {
        drawn = (drawn + 0.618_033_988_749_894_8) % 1.0;
        low + (high - low) * drawn
    };
    for case in 0..300 {
        let w = between(-3.0, 7.0).exp2();
        let n = match case % 5 {
            0 => 0.0,
            1 => w,
            2 => w * (1.0 + between(-1e-6, 1e-6)),
            3 => w * between(0.0, 5.0).exp2(),
            _ => w * between(0.0, 1.0),
        };
        let excitation = Excitation {
            static_term: between(-1.0, 1.0),
            forcing: if case % 2 == 0 {
                Forcing::Displacement
            } else {
                Forcing::Acceleration
            },
            ..excitation(
                w * between(-2.0, 2.0),
                w * w * between(-0.1, 0.1),
                vec![harmonic(1.0, between(-0.2, 0.2), 0.4)],
            )
        };
        let unit = match excitation.forcing {
            Forcing::Displacement => 1.0,
            Forcing::Acceleration => w * w,
        };
        let start = InitialState {
            displacement: between(-2.0, 2.0) / unit,
            velocity: w * between(-2.0, 2.0) / unit,
        };
        let r = ChirpResponse::new(Oscillator::new(w, n).unwrap(), excitation, start).unwrap();
        let mut closest = f64::INFINITY;
        for k in 0..400 {
            let t = 0.05 * f64::from(k) / w;
            let off = (r.displacement(t).unwrap() - r.mean()).abs();
            let envelope = r.envelope(t).unwrap();
            assert!(off <= envelope, "{w} {n} {t}: {off:e} beyond {envelope:e}");
            closest = closest.min(envelope / off);
        }
        assert!(n > 0.5 * w || closest < 1.5, "{w} {n}: {closest}");
    }
}

#[test]
fn refusals() {
    let message = |r: Result<Oscillator, ChirpError>| r.unwrap_err().to_string();
    assert_eq!(
        message(Oscillator::new(0.0, 1.0)),
        "w = 0 must be greater than zero"
    );
    assert_eq!(
        message(Oscillator::new(f64::NAN, 1.0)),
        "w = NaN is not a finite number"
    );
    assert_eq!(
        message(Oscillator::new(1.0, -1.0)),
        "n = -1 must not be negative"
    );
    let e = excitation(1.0, f64::INFINITY, Vec::new());
    let o = Oscillator::new(1.0, 0.0).unwrap();
    let refused = ChirpResponse::new(o, e, InitialState::default()).unwrap_err();
    assert_eq!(refused.to_string(), "eps = inf is not a finite number");
    let r = response(
        1.0,
        0.1,
        excitation(1.0, 0.0, vec![harmonic(1.0, 1.0, 0.0)]),
    );
    assert_eq!(r.motion(-1.0).unwrap_err().name(), "negative");
    assert_eq!(r.displacement(f64::NAN).unwrap_err().name(), "not finite");
    assert_eq!(r.harmonic(1, 0.0).unwrap_err().name(), "no such harmonic");
    assert_eq!(
        r.displacements(&[1.0], &mut []).unwrap_err().name(),
        "lengths"
    );
    assert_eq!(
        r.displacements(&[1.0, -1.0], &mut [0.0; 2])
            .unwrap_err()
            .name(),
        "negative"
    );
}

/// Units of time far from a second.
#[test]
fn units_of_time() {
    let at = |unit: f64, t: f64| {
        let r = response(
            10.0 * unit,
            0.5 * unit,
            excitation(0.0, 4.0 * unit * unit, vec![harmonic(2.0, 1.0, 0.0)]),
        );
        r.motion(t / unit).unwrap().displacement
    };
    let due = at(1.0, 1.5);
    for unit in [
        2f64.powi(-300),
        2f64.powi(-40),
        2f64.powi(40),
        2f64.powi(300),
    ] {
        assert_eq!(at(unit, 1.5), due);
    }
}

/// An undamped oscillator under a static force comes back to rest at every whole turn, by
/// y = 2 sin²(t/2), y′ = sin t; the digits stay.
#[test]
fn returns_to_rest() {
    let r = response(
        1.0,
        0.0,
        excitation(0.0, 0.0, vec![harmonic(0.0, 1.0, 0.0)]),
    );
    // 2π as two numbers.
    let turn = [std::f64::consts::TAU, 2.449_293_598_294_706_4e-16];
    for m in [1.0, 2.0, 4.0, 64.0] {
        for off in [0.3, 1e-2, -1e-3, 1e-5, -1e-7, 1e-9] {
            let t = turn[0] * m + off;
            // m is a power of two and the difference exact.
            let rest = (t - turn[0] * m) - turn[1] * m;
            let [y, v, a] = at(&r, t);
            close(y, 2.0 * (rest / 2.0).sin().powi(2), 4.0 * EPS * y.abs());
            close(v, rest.sin(), 4.0 * EPS * v.abs());
            close(a, rest.cos(), 4.0 * EPS);
            let amplitude = r.harmonic(0, t).unwrap().amplitude;
            close(amplitude.re, y, 4.0 * EPS * y);
        }
    }
}

/// `|A|` and `−arg A`.
#[test]
fn polar_form_of_an_amplitude() {
    let response = HarmonicResponse {
        amplitude: Complex::new(3.0, 4.0),
        motion: Motion::default(),
    };
    assert_eq!(response.envelope(), 5.0);
    close(response.phase(), -(4.0f64 / 3.0).atan(), 1e-15);
}

/// At `t → 0`, `A = w² t²/2 + i w² k Ω₀ t³/3 + …`: each component keeps its digits.
#[test]
fn the_first_moment_after_rest() {
    let drive = excitation(3.0, 50.0, vec![harmonic(1.0, 1.0, 0.3)]);
    let r = response(100.0, 2.0, drive);
    for t in [1e-30, 1e-90, 1e-12] {
        let a = r.harmonic(0, t).unwrap().amplitude;
        let re = 100.0 * 100.0 * t * t / 2.0;
        let im = 100.0 * 100.0 * 3.0 * t * t * t / 3.0;
        close(a.re / re, 1.0, 1e-9);
        close(a.im / im, 1.0, 1e-9);
    }
    // Certified: 1.0000000000000000000e-86.
    let a = r.harmonic(0, 1e-30).unwrap().amplitude;
    close(a.im / 1e-86, 1.0, 4.0 * EPS);
}
