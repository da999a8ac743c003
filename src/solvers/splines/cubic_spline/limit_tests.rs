//! Splines at the limits of what is accepted, and sums that cancel.

use super::grid::LARGEST;
use super::*;

/// Ordinates up to the largest are accepted, and nothing that follows from them may be larger.
#[test]
fn the_largest_ordinates() {
    use CubicSplineError::Overflow;
    let fit = |h: f64, y: &[f64]| {
        let x = (0..y.len()).map(|i| h * i as f64).collect();
        CubicSpline::fit(x, y.to_vec(), Boundary::NATURAL)
    };
    let s = fit(1.0, &[LARGEST; 5]).expect("a constant");
    assert_eq!(s.value(1.5).expect("a point"), LARGEST);
    assert!(fit(1.0, &[-LARGEST; 5]).is_ok());
    let y = [1.0, LARGEST.next_up(), 1.0];
    assert_eq!(fit(1.0, &y).unwrap_err(), Overflow { knot: 1 });
    // S'' = 12 · 2¹⁰⁰⁰ / h² in the middle: small itself for h = 1024, but not times h².
    let y = [1.0, -1.0, 1.0, -1.0, 1.0, -1.0, 1.0].map(|s| s * LARGEST);
    assert!(matches!(fit(1024.0, &y), Err(Overflow { .. })));
    let tenth: Vec<f64> = y.iter().map(|y| y / 16.0).collect();
    assert!(fit(1024.0, &tenth).is_ok());
    // A slope beyond all numbers is reported at its knot.
    let x = vec![0.0, 1.0, 2.0, 3.0, 4.0, 4.0 + 1e-9];
    let y = [0.0, 0.0, 0.0, 0.0, -LARGEST, LARGEST].to_vec();
    let e = CubicSpline::fit(x, y, Boundary::NATURAL).unwrap_err();
    assert_eq!(e, Overflow { knot: 4 });
}

/// A segment alone, whose bends do not depend on the ordinates.
#[test]
fn two_knots_are_checked() {
    for bad in [f64::NAN, f64::INFINITY] {
        for y in [[bad, 1.0], [1.0, bad]] {
            let e = UniformCubicSpline::fit(0.0, 1.0, y.to_vec(), Boundary::NATURAL);
            let e = e.unwrap_err();
            assert!(matches!(e, CubicSplineError::NotFinite { .. }), "{e}");
        }
    }
}

/// Not-a-knot at both ends of three segments leaves one cubic, with one third derivative.
#[test]
fn three_segments_of_one_cubic() {
    for x in [
        [0.0, 0.9, 1.0, 1.7],
        [0.0, 0.3, 1.0, 1.1],
        [0.0, 0.1, 0.3, 1.4],
    ] {
        let y = [0.1, -0.7, 0.3, 1.9];
        let s = CubicSpline::fit(x.to_vec(), y.to_vec(), Boundary::NOT_A_KNOT).expect("a spline");
        let third = |x: f64| s.jet(x).expect("a point").third;
        let all = [0.05, 0.5 * (x[1] + x[2]), 0.5 * (x[2] + x[3])].map(third);
        assert!(all.iter().all(|t| *t == all[0]), "{all:?}");
    }
}

/// Beside an end segment much longer or shorter than the next a parabola comes back, `S'' = 2`.
#[test]
fn ends_of_uneven_segments() {
    for end in [2f64.powi(-20), 2f64.powi(-6), 1.0, 64.0, 2f64.powi(17)] {
        let left = vec![-end, 0.0, 1.25, 2.125, 3.75];
        let right: Vec<f64> = left.iter().rev().map(|x| -x).collect();
        for (x, at) in [(left, -end), (right, end)] {
            let y: Vec<f64> = x.iter().map(|x| x * x).collect();
            let s = CubicSpline::fit(x, y, Boundary::NOT_A_KNOT).expect("a spline");
            let got = s.jet(at).expect("an end").second;
            assert!((got - 2.0).abs() < 1e-14, "{end}: {}", got - 2.0);
        }
    }
}

/// Units lost one by one beside 2⁵³ are kept: the integral of 1 is the length, without error.
#[test]
fn integrals_of_many_short_segments() {
    let far = -(2f64.powi(53));
    let mut x = vec![far, far + 2.0];
    x.extend((-2..=8).map(f64::from));
    let y = vec![1.0; x.len()];
    let length = 8.0 - far;
    let s = CubicSpline::fit(x, y.clone(), Boundary::Periodic).expect("a constant");
    assert_eq!(s.integral(far, 8.0), Ok(length));
    assert_eq!(s.integral(8.0, far), Ok(-length));
    // Four turns of it.
    let s = s.with_extrapolation(Extrapolation::Wrap);
    assert_eq!(s.integral(far, far + 4.0 * length), Ok(4.0 * length));
}

/// Four knots, the inner two nearly one: the cubic through them has a second derivative of few
/// digits if the two rows of the system, opposite to each other but for the short step, are
/// eliminated.
#[test]
fn one_cubic_over_a_short_middle_step() {
    for short in [2f64.powi(-8), 2f64.powi(-20), 2f64.powi(-24)] {
        let x = vec![-1.0, 0.0, short, 2.0];
        // All powers and sums are exact: S = x³ − x.
        let y: Vec<f64> = x.iter().map(|x| x * x * x - x).collect();
        let s = CubicSpline::fit(x, y, Boundary::NOT_A_KNOT).expect("a spline");
        for at in [-0.75, 0.5 * short, 1.5] {
            let jet = s.jet(at).expect("a point");
            // The second difference over the short step is rounded at 2⁻⁵³ / short.
            let allowed = 16.0 * f64::EPSILON / short * f64::from(u8::from(short < 1e-5))
                + 16.0 * f64::EPSILON;
            assert!(
                (jet.third - 6.0).abs() <= allowed,
                "{short} {at}: {}",
                jet.third - 6.0
            );
            assert!(
                (jet.second - 6.0 * at).abs() <= allowed,
                "{short} {at}: {jet:?}"
            );
        }
    }
}

/// Beside an end with a given slope the far ordinate, 2⁶⁰ times as large, has hardly any weight.
#[test]
fn values_beside_a_given_slope() {
    let far = 2f64.powi(60);
    // S = far (3 t² − 2 t³) + t (1 − t)², whose slopes are 1 and 0.
    let due = |t: f64| far * (t * t * (3.0 - 2.0 * t)) + t * (1.0 - t) * (1.0 - t);
    let s = CubicSpline::fit(vec![0.0, 1.0], vec![0.0, far], Boundary::clamped(1.0, 0.0));
    let s = s.expect("a spline");
    let mirrored = CubicSpline::fit(vec![0.0, 1.0], vec![far, 0.0], Boundary::clamped(0.0, -1.0));
    let mirrored = mirrored.expect("a spline");
    let uniform = UniformCubicSpline::fit(0.0, 1.0, vec![0.0, far], Boundary::clamped(1.0, 0.0));
    let uniform = uniform.expect("a spline");
    for power in 4..64 {
        let t = 2f64.powi(-power);
        let near = |got: f64| (got - due(t)).abs() <= 4.0 * f64::EPSILON * due(t);
        assert!(near(s.value(t).expect("a point")), "{t}");
        assert!(near(uniform.value(t).expect("a point")), "{t}");
        if power < 50 {
            assert!(near(mirrored.value(1.0 - t).expect("a point")), "{t}");
        }
        let integral = s.integral(0.0, t).expect("points");
        let due =
            far * (t * t * t - 0.5 * t.powi(4)) + t * t * (0.5 - 2.0 / 3.0 * t + 0.25 * t * t);
        assert!((integral - due).abs() <= 8.0 * f64::EPSILON * due, "{t}");
    }
}
