use super::*;
use crate::cam_law::{CamCycle, MotionLaw, Stroke};
use crate::cubic_spline::End;

fn cycle(law: &MotionLaw, rise: f64, high: f64, fall: f64) -> CamCycle {
    let stroke = |turns| Stroke {
        law: law.clone(),
        turns,
    };
    let low = 1.0 - rise - high - fall;
    CamCycle::new(2.0, stroke(rise), high, stroke(fall), low.max(0.0))
        .and_then(|c| c.starting_at(0.1))
        .unwrap()
}

fn laws() -> Vec<MotionLaw> {
    let mut laws = crate::cam_law::tests::all();
    // s = x³ (x⁵ − ..) of degree 9 with zero velocity and acceleration at both ends.
    let nine = [
        0.0, 0.0, 0.0, 84.0, -378.0, 756.0, -840.0, 540.0, -189.0, 28.0,
    ];
    laws.push(MotionLaw::polynomial(&nine).unwrap());
    let x = vec![0.0, 0.2, 0.35, 0.6, 0.85, 1.0];
    let y = vec![0.0, 0.1, 0.3, 0.7, 0.95, 1.0];
    laws.push(MotionLaw::tabulated(x, y, [End::NotAKnot; 2]).unwrap());
    laws
}

/// The trapezoidal rule on the cycle itself, corrected by nothing.
fn by_sums(c: &CamCycle, n: f64) -> (f64, f64) {
    let m = 1 << 12;
    let (mut a, mut b) = (0.0, 0.0);
    for k in 0..m {
        let turns = (f64::from(k) + 0.5) / f64::from(m);
        let f = c.at(turns).unwrap().displacement;
        let (s, co) = (TAU * n * turns).sin_cos();
        a += f * co;
        b += f * s;
    }
    (2.0 * a / f64::from(m), 2.0 * b / f64::from(m))
}

#[test]
fn coefficients_are_those_of_the_cycle() {
    for law in laws() {
        for (rise, high, fall) in [(0.3, 0.2, 0.25), (0.5, 0.0, 0.5), (0.7, 0.05, 0.1)] {
            let c = cycle(&law, rise, high, fall);
            let s = FourierSeries::new(&c);
            let mean = by_sums(&c, 0.0).0 / 2.0;
            assert!(
                (s.mean() - mean).abs() < 1e-6,
                "{law:?} {} {mean}",
                s.mean()
            );
            for n in [1, 2, 3, 5, 8, 13, 40, 101] {
                let h = s.harmonic(n).unwrap();
                let (a, b) = by_sums(&c, f64::from(n));
                assert!(
                    (h.a - a).abs() + (h.b - b).abs() < 1e-6,
                    "{law:?} {n} {h:?} {a} {b}"
                );
                assert!((h.amplitude() * h.phase().cos() - h.a).abs() < 1e-15);
                assert!((h.amplitude() * h.phase().sin() + h.b).abs() < 1e-15);
            }
        }
    }
}

#[test]
fn indexing_leaves_the_ramp_out() {
    let law = MotionLaw::modified_sine();
    let c = CamCycle::rise_dwell(2.0, Stroke { law, turns: 0.4 }, 0.6).unwrap();
    let s = FourierSeries::new(&c);
    let harmonics = s.harmonics(2000).unwrap();
    for turns in [0.0, 0.1, 0.35, 0.7] {
        let sum: f64 = harmonics
            .iter()
            .map(|h| h.amplitude() * (TAU * f64::from(h.order) * turns + h.phase()).cos())
            .sum();
        let f = c.at(turns).unwrap().displacement - 2.0 * turns;
        assert!((s.mean() + sum - f).abs() < s.tail_bound(2000, 0) + 1e-13);
    }
}

#[test]
fn tails_are_bounded() {
    for law in laws() {
        let c = cycle(&law, 0.3, 0.2, 0.25);
        let s = FourierSeries::new(&c);
        let last = 1500;
        let all = s.harmonics(last).unwrap();
        for after in [0u32, 1, 7, 50, 400] {
            for derivative in [0, 1] {
                let sum: f64 = all[after as usize..]
                    .iter()
                    .map(|h| f64::from(h.order).powi(derivative as i32) * h.amplitude())
                    .sum();
                let bound = s.tail_bound(after, derivative);
                assert!(sum <= bound, "{law:?} {after} {derivative}: {sum} {bound}");
            }
        }
        let tolerance = 1e-6;
        match s.harmonics_for(tolerance, 0) {
            Ok(n) => {
                assert!(s.tail_bound(n, 0) <= tolerance);
                assert!(n == 1 || s.tail_bound(n - 1, 0) > tolerance);
            }
            Err(e) => assert!(matches!(e, FourierSeriesError::TooMany { .. }), "{e}"),
        }
    }
    // A bound is of use: not a hundred times too large.
    let s = FourierSeries::new(&cycle(&MotionLaw::cycloidal(), 0.3, 0.2, 0.25));
    let sum: f64 = s.harmonics(1500).unwrap()[50..]
        .iter()
        .map(|h| h.amplitude())
        .sum();
    assert!(
        s.tail_bound(50, 0) < 20.0 * sum,
        "{sum} {}",
        s.tail_bound(50, 0)
    );
}

/// `s'' = ±4` varies by 16 on the whole line, so that two strokes of half a turn each with a lift
/// of 2 lose at most `(2/π) 2 (16/π²)/((2 − k) N^(2−k))`.
fn parabolas() -> FourierSeries {
    FourierSeries::new(&cycle(&MotionLaw::constant_acceleration(), 0.5, 0.0, 0.5))
}

/// Above the exact value by a billionth, and by 1e-14 against its own rounding.
#[test]
fn the_bound_of_parabolas() {
    let s = parabolas();
    for (after, n) in [(1, 1.0), (2, 2.0), (5, 5.0), (1000, 1000.0)] {
        for (derivative, power) in [(0, 2.0 * n * n), (1, n)] {
            let due = 64.0 * (1.0 + 1e-9) / (PI * PI * PI * power);
            let above = s.tail_bound(after, derivative) / due - 1.0;
            assert!((5e-15..1.5e-14).contains(&above), "{after}: {above:e}");
        }
        assert_eq!(s.tail_bound(after, 2), f64::INFINITY);
    }
    // Without any harmonic the first one is lost too, which is not less than it is.
    let first = s.harmonic(1).unwrap().amplitude();
    for derivative in [0, 1] {
        let lost = s.tail_bound(0, derivative) - s.tail_bound(1, derivative);
        assert!(lost >= first * (1.0 + 5e-13) && lost <= first * (1.0 + 2e-12));
    }
}

#[test]
fn how_many_harmonics_would_be_needed() {
    let s = parabolas();
    for (derivative, needed) in [(0, 1e7), (1, 1e8)] {
        let last = s.tail_bound(LAST_HARMONIC, derivative);
        assert_eq!(s.harmonics_for(last, derivative), Ok(LAST_HARMONIC));
        let tolerance = last / 100.0;
        match s.harmonics_for(tolerance, derivative) {
            Err(FourierSeriesError::TooMany {
                needed: n,
                tolerance: t,
            }) => {
                assert!((n / needed - 1.0).abs() < 1e-12 && t == tolerance, "{n}");
            }
            other => panic!("{other:?}"),
        }
    }
}

#[test]
fn tolerances_are_positive_and_finite() {
    let s = parabolas();
    for value in [0.0, -1.0, f64::INFINITY, f64::NEG_INFINITY] {
        let refused = Err(FourierSeriesError::Tolerance { value });
        assert_eq!(s.harmonics_for(value, 0), refused);
    }
    assert_eq!(s.harmonics_for(1e3, 0), Ok(1));
}

#[test]
fn a_harmonic_as_a_complex_number() {
    let (order, a, b) = (1, 3.0, 4.0);
    let h = Harmonic { order, a, b };
    assert_eq!(h.complex(), Complex64::new(3.0, -4.0));
    assert_eq!(h.amplitude(), 5.0);
    assert!((Complex64::from_polar(h.amplitude(), h.phase()) - h.complex()).norm() < 1e-15);
}

#[test]
fn refusals() {
    let s = FourierSeries::new(&cycle(&MotionLaw::simple_harmonic(), 0.3, 0.2, 0.25));
    assert!(s.harmonic(0).is_err() && s.harmonic(LAST_HARMONIC + 1).is_err());
    assert!(s.harmonic(LAST_HARMONIC).is_ok());
    let says = |e: Result<u32, FourierSeriesError>| e.unwrap_err().to_string();
    assert!(says(s.harmonics_for(f64::NAN, 0)).contains("NaN"));
    assert!(says(s.harmonics_for(1e-20, 0)).contains("harmonics would be needed"));
    assert!(says(s.harmonics_for(1e-3, 2)).contains("no finite sum"));
}

/// The strokes of a short lift cancel: an even pulse about zero has `a_n = 2a_0` but for the square
/// of its length.
#[test]
fn lifts_shorter_than_a_harmonic() {
    for name in ["3-4-5", "modified-sine"] {
        for fraction in [0.5, 0.3] {
            let stroke = |fraction: f64| Stroke {
                law: MotionLaw::by_name(name)
                    .and_then(|law| law.with_acceleration_fraction(fraction))
                    .unwrap(),
                turns: 1e-9,
            };
            let (rise, fall) = (stroke(fraction), stroke(1.0 - fraction));
            let cycle = CamCycle::new(2.0, rise, 1e-9, fall, 1.0 - 3e-9).unwrap();
            let series = FourierSeries::new(&cycle.starting_at(-1.5e-9).unwrap());
            for n in [1, 2, 3] {
                let h = series.harmonic(n).unwrap();
                let off = h.a / (2.0 * series.mean()) - 1.0;
                assert!(off.abs() < 4e-15, "{name} {fraction} {n}: {off:e}");
                assert!(
                    h.b.abs() < 1e-15 * h.a,
                    "{name} {fraction} {n}: {}",
                    h.b / h.a
                );
            }
        }
    }
}
