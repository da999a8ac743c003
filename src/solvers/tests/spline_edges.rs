//! Splines outside their knots, at their ends and in batches of every kind.

use crate::cubic_spline::{
    Boundary, CubicSpline, EvaluationError, Extrapolation, Grid, Spline, UniformCubicSpline,
    UniformKnots,
};
use crate::double_double::{two_prod, two_sum};

fn uniform(boundary: Boundary) -> UniformCubicSpline {
    let mut y: Vec<f64> = (0..12).map(|k| (f64::from(k) * 1.3).sin()).collect();
    if boundary == Boundary::Periodic {
        y[11] = y[0];
    }
    UniformCubicSpline::fit(0.5, 0.25, y, boundary).expect("a spline")
}

fn uneven() -> CubicSpline {
    let x = vec![0.5, 0.6, 1.0, 1.1, 1.5, 2.5, 2.75, 3.25];
    let y = vec![0.2, 1.0, -0.5, 0.3, 0.9, -1.0, 0.1, 0.2];
    CubicSpline::fit(x, y, Boundary::NOT_A_KNOT).expect("a spline")
}

/// Ten points of Gauss and Legendre on each half of an interval without knots: exact for cubics.
fn by_rule<G: Grid>(s: &Spline<G>, a: f64, b: f64) -> f64 {
    let r = (3.0f64 / 5.0).sqrt();
    let at = |x: f64| s.value(0.5 * (a + b) + 0.5 * (b - a) * x).expect("a point");
    0.5 * (b - a) * (5.0 * at(-r) + 8.0 * at(0.0) + 5.0 * at(r)) / 9.0
}

/// `∫` piece by piece between all knots and their repetitions.
fn pieces<G: Grid>(s: &Spline<G>, a: f64, b: f64) -> f64 {
    let (first, last) = s.grid().span();
    let period = last - first;
    let mut cuts = vec![a, b];
    for turn in -6..=6 {
        for i in 0..=s.grid().segments() {
            cuts.push(s.grid().knot(i) + f64::from(turn) * period);
        }
    }
    cuts.retain(|x| a.min(b) <= *x && *x <= a.max(b));
    cuts.sort_by(f64::total_cmp);
    let sum: f64 = cuts.windows(2).map(|w| by_rule(s, w[0], w[1])).sum();
    if a <= b { sum } else { -sum }
}

fn integrals<G: Grid + Clone>(s: Spline<G>) {
    use Extrapolation::{Clamp, EndPolynomial, Linear, Wrap};
    let (first, last) = s.grid().span();
    let limits = [
        -3.7, -1.0, 0.1, 0.5, 0.9, 1.7, 2.9, 3.25, 3.5, 5.0, 11.0, first, last,
    ];
    for kind in [Clamp, EndPolynomial, Linear, Wrap] {
        let s = s.clone().with_extrapolation(kind);
        assert_eq!(s.extrapolation(), kind);
        for a in limits {
            for b in limits {
                let (got, due) = (s.integral(a, b).expect("limits"), pieces(&s, a, b));
                let size = 1.0 + due.abs();
                assert!(
                    (got - due).abs() < 1e-11 * size * 50.0,
                    "{kind:?} {a} {b}: {got} {due}"
                );
            }
        }
    }
}

#[test]
fn integrals_over_the_ends() {
    integrals(uneven());
    integrals(uniform(Boundary::Periodic));
    integrals(uniform(Boundary::clamped(0.3, -0.2)));
}

/// An odd function and a constant: the large parts cancel.
#[test]
fn integrals_that_cancel() {
    let big = 1e15;
    for constant in [0.25, 3.0, -8.0] {
        let odd = [big, -big, big, 0.0, -big, big, -big];
        let y = odd.iter().map(|y| y + constant).collect();
        let ends = Boundary::second_derivatives(0.0, 0.0);
        let s = UniformCubicSpline::fit(0.0, 1.0, y, ends).expect("a spline");
        let got = s.integral(0.0, 6.0).expect("limits");
        assert!((got - 6.0 * constant).abs() < 4e-15 * big, "{got}");
    }
}

/// The index of a refused point counts from the start of the whole batch.
#[test]
fn indices_of_refused_points() {
    fn check<G: Grid>(s: &Spline<G>, n: usize, bad: usize, value: f64) {
        let (first, last) = s.grid().span();
        let at = |i: usize| first + (last - first) * i as f64 / n as f64;
        let mut x: Vec<f64> = (0..n).map(at).collect();
        x[bad] = value;
        let mut out = vec![0.0; n];
        let index = |e: Result<(), EvaluationError>| match e.expect_err("a bad point") {
            EvaluationError::NotFinite { index, .. }
            | EvaluationError::Outside { index, .. }
            | EvaluationError::NotSorted { index } => index,
            other => panic!("{other}"),
        };
        assert_eq!(index(s.values(&x, &mut out)), bad);
        // In ascending order the first out of place may be the next one.
        let sorted = index(s.values_sorted(&x, &mut out));
        assert!(sorted == bad || sorted == bad + 1, "{sorted} {bad}");
        assert_eq!(index(s.jets(&x).map(|_| ())), bad);
        #[cfg(feature = "parallel")]
        {
            assert_eq!(index(s.par_values(&x, &mut out)), bad);
            let sorted = index(s.par_values_sorted(&x, &mut out));
            assert!(sorted == bad || sorted == bad + 1, "{sorted} {bad}");
        }
    }
    for (n, bad) in [
        (5, 3),
        (30, 17),
        (3000, 1024),
        (3000, 2999),
        (70_000, 66_001),
    ] {
        for value in [f64::NAN, 99.0, -99.0] {
            check(&uneven(), n, bad, value);
            check(&uniform(Boundary::NOT_A_KNOT), n, bad, value);
        }
    }
}

/// `origin + i · step` as if the sum were rounded once, also where it nearly cancels.
#[test]
fn equally_spaced_knots() {
    for (step, segments) in [(0.1, 50), (1.0 / 3.0, 1000), (7.3e-5, 4000)] {
        for cancelling in [0, 7, 33] {
            let origin = -(f64::from(cancelling) * step) + if cancelling == 7 { 0.5 } else { 0.0 };
            let grid = UniformKnots::new(origin, step, segments).expect("a grid");
            assert_eq!(
                (grid.origin(), grid.step(), grid.segments()),
                (origin, step, segments)
            );
            for i in 0..=segments {
                let p = two_prod(i as f64, step);
                let t = two_sum(p.hi, origin);
                let due = t.hi + (t.lo + p.lo);
                let off = (grid.knot(i) - due).abs();
                let size = p.hi.abs().max(origin.abs());
                assert!(
                    off <= 2.0 * f64::EPSILON * due.abs() && off <= 1e-15 * size,
                    "{i}: {off}"
                );
            }
            assert_eq!(grid.knot(0), origin);
            let (a, b) = grid.span();
            assert_eq!((a, b), (origin, grid.knot(segments)));
        }
    }
}
