//! Cubic splines with every kind of end, on both kinds of knots.

use super::{Answer, hold, same};
use crate::cubic_spline::{
    Boundary, CubicSpline, CubicSplineError as Error, End, EvaluationError, Extrapolation, Grid,
    Spline, UniformCubicSpline,
};
use crate::hermite_spline::{HermiteSpline, Slopes};

fn word(e: Error) -> String {
    match e {
        Error::TooFewKnots { .. } => "too few knots",
        Error::NotIncreasing { .. } => "knots not increasing",
        Error::NotPeriodic { .. } => "not periodic",
        Error::NotFinite { .. } => "not finite",
        Error::Overflow { .. } => "overflow",
        Error::Step { .. } => "bad step",
        _ => "bad layout",
    }
    .into()
}

/// `S, S', S'', S'''` and the integral to the other query, for each; all paths have the same bits.
fn outputs<G: Grid>(s: &Spline<G>, q: &[f64]) -> Answer {
    let refuse = |e: EvaluationError| match e {
        EvaluationError::Outside { .. } => "outside".to_string(),
        _ => "not finite".into(),
    };
    let mut out = Vec::new();
    for (a, b) in [(q[0], q[1]), (q[1], q[0])] {
        let j = s.jet(a).map_err(refuse)?;
        let integral = s.integral(a, b).map_err(refuse)?;
        out.extend([j.value, j.first, j.second, j.third, integral]);
    }
    paths_agree(s, q[0].min(q[1]), q[0].max(q[1]));
    Ok(out)
}

/// Single values, jets, batches, sorted batches and batches on all cores.
fn paths_agree<G: Grid>(s: &Spline<G>, low: f64, high: f64) {
    let sorted: Vec<f64> = (0..=40)
        .map(|k| (low + (high - low) * (f64::from(k) / 40.0)).clamp(low, high))
        .collect();
    let mixed: Vec<f64> = (0..41).map(|k| sorted[k * 17 % 41]).collect();
    let one = |x: &f64| s.value(*x).expect("inside");
    for (x, ascending) in [(&sorted, true), (&mixed, false)] {
        let due: Vec<f64> = x.iter().map(one).collect();
        let mut out = vec![0.0; x.len()];
        let check = |out: &[f64], path: &str| {
            for ((x, a), b) in x.iter().zip(&due).zip(out) {
                assert!(same(*a, *b), "{path} at {x}: {b} where {a} is due");
            }
        };
        s.values(x, &mut out).expect("inside");
        check(&out, "batch");
        let jets = s.jets(x).expect("inside");
        check(&jets.iter().map(|j| j.value).collect::<Vec<_>>(), "jets");
        #[cfg(feature = "parallel")]
        {
            s.par_values(x, &mut out).expect("inside");
            check(&out, "all cores");
        }
        if ascending {
            s.values_sorted(x, &mut out).expect("inside");
            check(&out, "sorted batch");
            #[cfg(feature = "parallel")]
            {
                s.par_values_sorted(x, &mut out).expect("inside");
                check(&out, "sorted, all cores");
            }
        }
    }
}

fn on_knots(method: &str, ends: usize, boundary: fn(&[f64]) -> Boundary) {
    hold(
        method,
        &[("fit", &|x| {
            let n = (x.len() - 2 - ends) / 2;
            let boundary = boundary(&x[2 * n..2 * n + ends]);
            let s =
                CubicSpline::fit(x[..n].to_vec(), x[n..2 * n].to_vec(), boundary).map_err(word)?;
            assert_eq!(s.values_at_knots(), &x[n..2 * n]);
            let s = match boundary {
                Boundary::Periodic => s.with_extrapolation(Extrapolation::Wrap),
                Boundary::Ends(..) => s,
            };
            outputs(&s, &x[x.len() - 2..])
        })],
    );
}

#[test]
fn on_any_knots() {
    on_knots("cubic-spline-second-derivatives", 2, |e| {
        Boundary::second_derivatives(e[0], e[1])
    });
    on_knots("cubic-spline-clamped", 2, |e| Boundary::clamped(e[0], e[1]));
    on_knots("cubic-spline-not-a-knot", 0, |_| Boundary::NOT_A_KNOT);
    on_knots("cubic-spline-periodic", 0, |_| Boundary::Periodic);
}

/// A code and a value for each end stand between the ordinates and the queries.
#[test]
fn with_mixed_ends() {
    let end = |code: f64, value: f64| match code {
        0.0 if value == 0.0 => Ok(End::NotAKnot),
        1.0 => Ok(End::FirstDerivative(value)),
        2.0 => Ok(End::SecondDerivative(value)),
        _ => Err("bad end".to_string()),
    };
    let fit = |x: &[f64]| -> Answer {
        let n = (x.len() - 6) / 2;
        let (points, rest) = x.split_at(2 * n);
        let boundary = Boundary::Ends(end(rest[0], rest[1])?, end(rest[2], rest[3])?);
        let (x, y) = points.split_at(n);
        let s = CubicSpline::fit(x.to_vec(), y.to_vec(), boundary).map_err(word)?;
        outputs(&s, &rest[4..])
    };
    hold("cubic-spline-mixed-ends", &[("fit", &fit)]);
}

/// Single values, jets and batches, which have the same bits.
#[test]
fn with_local_slopes() {
    for (method, slopes) in [
        ("pchip", Slopes::Pchip),
        ("akima", Slopes::Akima),
        ("modified-akima", Slopes::ModifiedAkima),
    ] {
        let fit = |x: &[f64]| -> Answer {
            let n = (x.len() - 2) / 2;
            let (points, q) = x.split_at(2 * n);
            let (x, y) = points.split_at(n);
            let s = HermiteSpline::fit(x.to_vec(), y.to_vec(), slopes).map_err(word)?;
            let jets = s.jets(q).map_err(|e| match e {
                EvaluationError::Outside { .. } => "outside".to_string(),
                _ => "not finite".into(),
            })?;
            let mut values = [0.0; 2];
            s.values(q, &mut values).expect("inside");
            let mut out = Vec::new();
            for (k, j) in jets.iter().enumerate() {
                let single = s.value(q[k]).expect("inside");
                assert!(same(single, j.value) && same(single, values[k]));
                let integral = s.integral(q[k], q[1 - k]).expect("inside");
                out.extend([j.value, j.first, j.second, j.third, integral]);
            }
            Ok(out)
        };
        hold(method, &[("fit", &fit)]);
    }
}

fn uniform(x: &[f64]) -> Result<UniformCubicSpline, Error> {
    UniformCubicSpline::fit(
        x[0],
        x[1],
        x[6..].to_vec(),
        Boundary::second_derivatives(x[2], x[3]),
    )
}

#[test]
fn on_equal_steps() {
    let fit = |x: &[f64]| -> Answer { outputs(&uniform(x).map_err(word)?, &x[4..6]) };
    hold("cubic-spline-uniform", &[("fit", &fit)]);
}
