//! Linear systems and splines.

use super::{all_finite, any_f64, cases, said, usual};
use mechaudit::solvers::cubic_spline::{
    Boundary, CubicSpline, End, Extrapolation, Grid, Knots, Spline, UniformCubicSpline,
    UniformKnots,
};
use mechaudit::solvers::cyclic_tridiagonal::CyclicSweep;
use mechaudit::solvers::tridiagonal::{Pivoted, Sweep, solve};
use proptest::prelude::*;

fn list(longest: usize) -> impl Strategy<Value = Vec<f64>> {
    prop_oneof![
        prop::collection::vec(any_f64(), 0..longest),
        prop::collection::vec(usual(), 0..longest),
    ]
}

fn end() -> impl Strategy<Value = End> {
    prop_oneof![
        any_f64().prop_map(End::FirstDerivative),
        any_f64().prop_map(End::SecondDerivative),
        Just(End::NotAKnot),
    ]
}

fn boundary() -> impl Strategy<Value = Boundary> {
    prop_oneof![
        4 => (end(), end()).prop_map(|(a, b)| Boundary::Ends(a, b)),
        1 => Just(Boundary::Periodic),
    ]
}

fn extrapolation() -> impl Strategy<Value = Extrapolation> {
    prop::sample::select(vec![
        Extrapolation::Error,
        Extrapolation::EndPolynomial,
        Extrapolation::Linear,
        Extrapolation::Clamp,
        Extrapolation::Wrap,
    ])
}

fn ask<G: Grid>(s: &Spline<G>, points: &[f64]) {
    let (first, last) = s.grid().span();
    assert!(
        all_finite(&s.second_derivatives()) || s.values_at_knots().iter().any(|y| y.abs() > 1e-300)
    );
    let mut out = vec![0.0; points.len()];
    let batch = s.values(points, &mut out).is_ok();
    let mut sorted = points.to_vec();
    sorted.sort_by(f64::total_cmp);
    let _ = said(s.values_sorted(&sorted, &mut vec![0.0; points.len()]));
    let _ = said(s.jets(points));
    #[cfg(feature = "parallel")]
    {
        let _ = said(s.par_values(points, &mut vec![0.0; points.len()]));
        let _ = said(s.par_values_sorted(&sorted, &mut vec![0.0; points.len()]));
    }
    assert!(s.values(points, &mut vec![0.0; points.len() + 1]).is_err());
    for (i, &x) in points.iter().enumerate() {
        let value = said(s.value(x));
        assert!(value.is_some() || !batch, "the batch has a value at {x}");
        let inside = (first..=last).contains(&x);
        assert!(
            !inside || value.is_some_and(f64::is_finite),
            "S({x}) = {value:?}"
        );
        assert!(!x.is_nan() || value.is_none());
        let _ = said(s.jet(x));
        let _ = said(s.integral(x, points[i / 2]));
    }
}

proptest! {
    #![proptest_config(cases(600))]

    #[test]
    fn tridiagonal(v in list(24), cut in 0usize..9) {
        let n = (v.len() + 2) / 4;
        let at = |k: usize| &v[(k * n).min(v.len())..((k + 1) * n).min(v.len())];
        let off = |k: usize| { let p = at(k); &p[..p.len().min(if cut == 0 { n } else { n.saturating_sub(1) })] };
        let (lower, diagonal, upper, d) = (off(0), at(1), off(2), at(3));
        if let Some(s) = said(Sweep::factor(lower, diagonal, upper)) {
            let bound = s.stability();
            prop_assert!(!(bound.relative_error() < 0.0));
            if let Some(x) = said(s.solve(d)) {
                prop_assert!(all_finite(&x) && x.len() == s.n());
            }
            let _ = said(s.solve_many_in_place(&mut v.clone()));
        }
        if let Some(p) = said(Pivoted::factor(lower, diagonal, upper))
            && let Some(x) = said(p.solve(d))
        {
            prop_assert!(all_finite(&x) && x.len() == p.n());
        }
        let _ = said(solve(lower, diagonal, upper, d));
        if let Some(s) = said(CyclicSweep::factor(at(0), diagonal, at(2))) {
            let _ = s.stability().is_reliable();
            if let Some(x) = said(s.solve(d)) {
                prop_assert!(all_finite(&x) && x.len() == s.n());
            }
        }
    }

    #[test]
    fn splines(
        mut x in list(14), y in list(14), sort: bool, cut: bool, ends in boundary(),
        beyond in extrapolation(), points in prop::collection::vec(any_f64(), 0..20),
    ) {
        if sort {
            x.sort_by(f64::total_cmp);
        }
        let _ = said(Knots::new(x.clone()));
        let n = if cut { x.len().min(y.len()) } else { x.len().max(y.len()) };
        let (x, y) = (x[..n.min(x.len())].to_vec(), y[..n.min(y.len())].to_vec());
        if let Some(s) = said(CubicSpline::fit(x.clone(), y, ends)) {
            let points: Vec<f64> = points.iter().chain(&x).copied().collect();
            ask(&s.with_extrapolation(beyond), &points);
        }
    }

    #[test]
    fn splines_on_equal_steps(
        origin in any_f64(), step in any_f64(), y in list(14), ends in boundary(),
        beyond in extrapolation(), points in prop::collection::vec(any_f64(), 0..20),
        segments in any::<usize>(),
    ) {
        let _ = said(UniformKnots::new(origin, step, segments));
        for (origin, step) in [(origin, step), (0.5, 0.25)] {
            if let Some(s) = said(UniformCubicSpline::fit(origin, step, y.clone(), ends)) {
                ask(&s.with_extrapolation(beyond), &points);
            }
        }
    }
}
