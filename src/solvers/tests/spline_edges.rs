//! Splines outside their knots, at their ends and in batches of every kind.

use crate::cubic_spline::{
    Boundary, CubicSpline, End, EvaluationError, Extrapolation, Grid, Spline, UniformCubicSpline,
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

/// Straight on outside, with the slope of the end; nothing else bends there.
#[test]
fn jets_outside() {
    let s = uneven().with_extrapolation(Extrapolation::Linear);
    let (first, last) = s.grid().span();
    for (end, x) in [(first, -2.0), (last, 7.0)] {
        let (at, out) = (s.jet(end).expect("a point"), s.jet(x).expect("a point"));
        assert!((out.value - (at.value + at.first * (x - end))).abs() < 1e-12);
        assert_eq!((out.first, out.second, out.third), (at.first, 0.0, 0.0));
    }
    let s = s.with_extrapolation(Extrapolation::Clamp);
    for (end, x) in [(first, -2.0), (last, 7.0)] {
        let (at, out) = (s.value(end).expect("a point"), s.jet(x).expect("a point"));
        assert_eq!((out.value, out.first, out.second), (at, 0.0, 0.0));
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

/// Sorted batches of all sizes and steps have the bits of single points, on all cores too.
#[test]
fn batches_have_the_bits_of_single_points() {
    fn check<G: Grid>(s: &Spline<G>, x: &[f64]) {
        let one: Vec<f64> = x.iter().map(|x| s.value(*x).expect("a point")).collect();
        let same = |out: &[f64]| {
            out.iter()
                .zip(&one)
                .all(|(a, b)| a.to_bits() == b.to_bits())
        };
        let mut out = vec![f64::NAN; x.len()];
        s.values(x, &mut out).expect("points");
        assert!(same(&out));
        out.fill(f64::NAN);
        s.values_sorted(x, &mut out).expect("points");
        assert!(same(&out));
        let jets = s.jets(x).expect("points");
        assert_eq!(jets.len(), x.len());
        assert!(
            jets.iter()
                .zip(&one)
                .all(|(j, y)| (j.value - y).abs() < 1e-12 * (1.0 + y.abs()))
        );
        #[cfg(feature = "parallel")]
        {
            out.fill(f64::NAN);
            s.par_values(x, &mut out).expect("points");
            assert!(same(&out));
            out.fill(f64::NAN);
            s.par_values_sorted(x, &mut out).expect("points");
            assert!(same(&out));
        }
    }
    let many: Vec<f64> = (0..300).map(|k| f64::from(k) * 0.01 + 0.001).collect();
    let y: Vec<f64> = many.iter().map(|x| (3.0 * x).cos()).collect();
    let fine = CubicSpline::fit(many, y.clone(), Boundary::NOT_A_KNOT).expect("a spline");
    let even = UniformCubicSpline::fit(0.001, 0.01, y, Boundary::NOT_A_KNOT).expect("a spline");
    for n in [1usize, 2, 7, 8, 9, 40, 1025, 2100, 66_000] {
        for (from, to) in [(0.001, 2.991), (0.5, 0.9), (1.0, 1.0)] {
            let at = |k: usize| from + (to - from) * k as f64 / (n.max(2) - 1) as f64;
            let x: Vec<f64> = (0..n).map(at).map(|x| x.min(2.99)).collect();
            check(&fine, &x);
            check(&even, &x);
        }
    }
    for kind in [
        Extrapolation::Linear,
        Extrapolation::Wrap,
        Extrapolation::EndPolynomial,
    ] {
        let x: Vec<f64> = (0..50).map(|k| f64::from(k) * 0.2 - 3.0).collect();
        check(&uneven().with_extrapolation(kind), &x);
        check(&uniform(Boundary::Periodic).with_extrapolation(kind), &x);
    }
    // One below another at the seam of two chunks of all cores.
    #[cfg(feature = "parallel")]
    {
        let mut x = vec![1.0; 70_000];
        x[..65_536].fill(1.5);
        let e = fine
            .par_values_sorted(&x, &mut vec![0.0; 70_000])
            .unwrap_err();
        assert_eq!(e, EvaluationError::NotSorted { index: 65_536 });
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

/// A cubic comes back from its own values with all derivatives, however different the end steps.
#[test]
fn cubics_come_back() {
    let cubic = |x: f64| ((2.0 * x - 3.0) * x + 0.5) * x + 1.0;
    let small = 2f64.powi(-8);
    for x in [
        vec![0.0, small, 1.0, 2.0, 3.0],
        vec![0.0, 1.0, 2.0, 3.0 - small, 3.0],
        vec![0.0, 1.0, 1.0 + small, 2.0, 3.0],
        vec![0.0, 1.0, 2.0, 2.0 + small, 3.0],
        vec![0.0, 1.0, 3.0, 3.25],
        vec![0.0, 0.25, 1.0, 3.0],
    ] {
        let y = x.iter().map(|x| cubic(*x)).collect();
        let s = CubicSpline::fit(x.clone(), y, Boundary::NOT_A_KNOT).expect("a spline");
        for k in 0..=60 {
            let at = f64::from(k) * 0.05;
            let j = s.jet(at).expect("a point");
            let close = |got: f64, due: f64, u: f64| {
                assert!((got - due).abs() < u, "{x:?} at {at}: {got} {due}");
            };
            close(j.value, cubic(at), 1e-13);
            close(j.first, (6.0 * at - 6.0) * at + 0.5, 1e-11);
            close(j.second, 12.0 * at - 6.0, 1e-10);
            close(j.third, 12.0, 1e-9);
        }
        assert_eq!(s.second_derivatives().len(), x.len());
        for (m, x) in s.second_derivatives().iter().zip(&x) {
            assert!((m - (12.0 * x - 6.0)).abs() < 1e-10, "{m}");
        }
    }
    // Third derivatives next to not-a-knot ends are those of the longer of the two steps.
    for ends in [
        [End::NotAKnot, End::FirstDerivative(0.0)],
        [End::FirstDerivative(0.0), End::NotAKnot],
    ] {
        let x = vec![0.0, 0.01, 1.0, 2.0, 2.99, 3.0];
        let y = vec![0.0, 0.2, 1.0, -1.0, 0.4, 0.3];
        let s = CubicSpline::fit(x.clone(), y, Boundary::Ends(ends[0], ends[1])).expect("a spline");
        let third = |x: f64| s.jet(x).expect("a point").third;
        match ends[0] {
            End::NotAKnot => assert_eq!(third(0.005), third(0.5)),
            _ => assert_eq!(third(2.995), third(2.5)),
        }
        let m = s.second_derivatives();
        assert!((third(1.5) - (m[3] - m[2])).abs() < 1e-10);
    }
}
