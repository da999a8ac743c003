//! What the audited splines on arbitrary knots share.
//!
//! Input: `x[n]`, `y[n]`, then two end values for the kinds that have them, then the two query
//! points `q0`, `q1`. Output, for each query: `S`, `S'`, `S''`, `S'''` there and the integral from
//! it to the other query.

use super::cubic_spline_conditions as sensitivity;
use crate::audit::{
    Budget, Input, Limit, Output, Proof, Reference, ReferenceAnswer, Rows, SolverAnswer,
};
use crate::reference::Ball;
use crate::reference::cubic_spline::{Spline as ExactSpline, SplineError};
use crate::solvers::cubic_spline::{
    Boundary, CubicSpline, CubicSplineError, EvaluationError, Grid, Spline,
};
use rug::Rational;

/// The end conditions.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Kind {
    SecondDerivatives,
    Clamped,
    NotAKnot,
    Periodic,
}

/// An input taken apart.
pub(super) struct Parts<'a, T> {
    pub x: &'a [T],
    pub y: &'a [T],
    pub ends: &'a [T],
    pub queries: &'a [T],
}

impl Kind {
    pub(super) fn end_values(self) -> usize {
        match self {
            Kind::SecondDerivatives | Kind::Clamped => 2,
            Kind::NotAKnot | Kind::Periodic => 0,
        }
    }

    pub(super) fn split<T>(self, input: &[T]) -> Option<Parts<'_, T>> {
        let data = input.len().checked_sub(2 + self.end_values())?;
        if data % 2 != 0 {
            return None;
        }
        let (x, rest) = input.split_at(data / 2);
        let (y, rest) = rest.split_at(data / 2);
        let (ends, queries) = rest.split_at(self.end_values());
        Some(Parts {
            x,
            y,
            ends,
            queries,
        })
    }

    pub(super) fn fit(self, p: &Parts<f64>) -> Result<CubicSpline, &'static str> {
        let boundary = match self {
            Kind::SecondDerivatives => Boundary::second_derivatives(p.ends[0], p.ends[1]),
            Kind::Clamped => Boundary::clamped(p.ends[0], p.ends[1]),
            Kind::NotAKnot => Boundary::NOT_A_KNOT,
            Kind::Periodic => Boundary::Periodic,
        };
        CubicSpline::fit(p.x.to_vec(), p.y.to_vec(), boundary).map_err(|e| word(&e))
    }

    pub(super) fn solve(self, input: &[f64]) -> SolverAnswer {
        let run = || {
            let p = self.split(input).ok_or("bad layout")?;
            outputs_of(&self.fit(&p)?, p.queries)
        };
        match run() {
            Ok(v) => SolverAnswer::Values(v),
            Err(why) => SolverAnswer::Refuses(why),
        }
    }

    pub(super) fn reference(self, input: &[Rational], bits: u32) -> ReferenceAnswer {
        let Some(p) = self.split(input) else {
            return ReferenceAnswer::Refuses("bad layout");
        };
        let spline = match self {
            Kind::SecondDerivatives => {
                ExactSpline::second_derivatives(p.x, p.y, &p.ends[0], &p.ends[1])
            }
            Kind::Clamped => ExactSpline::clamped(p.x, p.y, &p.ends[0], &p.ends[1]),
            Kind::NotAKnot => ExactSpline::not_a_knot(p.x, p.y),
            Kind::Periodic => ExactSpline::periodic(p.x, p.y),
        };
        match spline {
            Ok(s) => reference_of(&s, p.x, p.queries, bits),
            Err(SplineError::TooFew(_)) => ReferenceAnswer::Refuses("too few knots"),
            Err(SplineError::Length { .. }) => ReferenceAnswer::Refuses("bad layout"),
            Err(SplineError::NotIncreasing(_)) => ReferenceAnswer::Refuses("knots not increasing"),
            Err(SplineError::NotPeriodic) => ReferenceAnswer::Refuses("not periodic"),
        }
    }

    pub(super) fn conditions(self, input: &[f64]) -> Option<Vec<f64>> {
        sensitivity::conditions(self, input)
    }

    pub(super) fn inputs(self) -> Vec<Input> {
        let ends: &[(&str, &str)] = match self {
            Kind::SecondDerivatives => &[("m0", "y/x^2"), ("mn", "y/x^2")],
            Kind::Clamped => &[("s0", "y/x"), ("sn", "y/x")],
            Kind::NotAKnot | Kind::Periodic => &[],
        };
        [("x[n]", "x"), ("y[n]", "y")]
            .iter()
            .chain(ends)
            .chain(&[("q0", "x"), ("q1", "x")])
            .map(|&(name, unit)| Input { name, unit })
            .collect()
    }
}

fn word(e: &CubicSplineError) -> &'static str {
    match e {
        CubicSplineError::TooFewKnots { .. } => "too few knots",
        CubicSplineError::NotIncreasing { .. } => "knots not increasing",
        CubicSplineError::NotPeriodic { .. } => "not periodic",
        CubicSplineError::NotFinite { .. } => "not finite",
        CubicSplineError::Overflow { .. } => "overflow",
        CubicSplineError::Step { .. } => "bad step",
        _ => "bad layout",
    }
}

/// What the solver gives for the two queries.
pub(super) fn outputs_of<G: Grid>(s: &Spline<G>, q: &[f64]) -> Result<Vec<f64>, &'static str> {
    let refuse = |e: EvaluationError| match e {
        EvaluationError::Outside { .. } => "outside",
        _ => "not finite",
    };
    let mut out = Vec::with_capacity(10);
    for (a, b) in [(q[0], q[1]), (q[1], q[0])] {
        let j = s.jet(a).map_err(refuse)?;
        let integral = s.integral(a, b).map_err(refuse)?;
        out.extend([j.value, j.first, j.second, j.third, integral]);
    }
    Ok(out)
}

/// What the exact spline gives for the two queries.
pub(super) fn reference_of(
    s: &ExactSpline,
    x: &[Rational],
    q: &[Rational],
    bits: u32,
) -> ReferenceAnswer {
    if q.iter().any(|q| *q < x[0] || *q > x[x.len() - 1]) {
        return ReferenceAnswer::Refuses("outside");
    }
    let mut values = Vec::with_capacity(10);
    let integral = s.integral(&q[0], &q[1]);
    values.extend(s.eval(&q[0]));
    values.push(integral.clone());
    values.extend(s.eval(&q[1]));
    values.push(-integral);
    ReferenceAnswer::Values(Reference {
        values: values.iter().map(|v| Ball::rational(bits, v)).collect(),
        proof: Proof::Exact,
    })
}

const REASON: &str = "every weight of S, S', S'' and S''' is a product of a few factors, each with a \
    relative error of a few u, and the second derivatives come from a system dominant by rows, solved \
    with a componentwise backward error of 13 u at most; the sum over the data is the condition";

/// The five outputs with their budgets in units of the conditioned limit.
pub(super) fn outputs(k: f64) -> Vec<Output> {
    [
        ("S", "y"),
        ("S'", "y/x"),
        ("S''", "y/x^2"),
        ("S'''", "y/x^3"),
        ("integral", "x y"),
    ]
    .map(|(name, unit)| Output {
        name,
        unit,
        budget: Budget::new(Limit::Conditioned(k), REASON),
    })
    .to_vec()
}

/// The outputs belong to a query each.
pub(super) const ROWS: Rows = Rows {
    index: "q",
    count: "2",
    meaning: "at q0 and at q1, the integral running to the other one",
};

/// Implements [`Method`](crate::audit::Method) for a kind of end condition.
macro_rules! audit {
    ($kind:expr, $name:literal, $summary:literal, $budget:literal, $($laws:expr),*) => {
        /// Input `x[n], y[n]`, the end values if there are any, `q0, q1`; output `S, S', S'', S'''`
        /// and the integral to the other query, for each query.
        pub struct Audit;

        impl crate::audit::Method for Audit {
            fn name(&self) -> &'static str {
                $name
            }
            fn summary(&self) -> &'static str {
                $summary
            }
            fn source(&self) -> &'static str {
                "Zinchenko 2008, eqs (8)-(17), on arbitrary knots"
            }
            fn inputs(&self) -> Vec<crate::audit::Input> {
                $kind.inputs()
            }
            fn outputs(&self) -> Vec<crate::audit::Output> {
                crate::methods::cubic_spline_common::outputs($budget)
            }
            fn rows(&self) -> Option<crate::audit::Rows> {
                Some(crate::methods::cubic_spline_common::ROWS)
            }
            fn domain(&self) -> crate::audit::Domain {
                crate::methods::cubic_spline_domain::domain!($kind)
            }
            fn hard(&self) -> Vec<crate::audit::HardCase> {
                let text = include_str!(concat!("../../reference/hard/", $name, ".csv"));
                crate::audit::HardCase::included(text)
            }
            fn solve(&self, input: &[f64]) -> crate::audit::SolverAnswer {
                $kind.solve(input)
            }
            fn reference(&self, input: &[rug::Rational], bits: u32) -> crate::audit::ReferenceAnswer {
                $kind.reference(input, bits)
            }
            fn conditions(&self, input: &[f64]) -> Option<Vec<f64>> {
                $kind.conditions(input)
            }
            fn laws(&self) -> Vec<crate::audit::Law> {
                vec![$($laws),*]
            }
        }
    };
}
pub(super) use audit;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::audit::{Draw, Method, Settings, Verdict, audit_method, judge};

    const NAMES: [&str; 7] = [
        "tridiagonal",
        "cyclic-tridiagonal",
        "cubic-spline-second-derivatives",
        "cubic-spline-clamped",
        "cubic-spline-not-a-knot",
        "cubic-spline-periodic",
        "cubic-spline-uniform",
    ];

    #[test]
    fn a_short_audit_passes() {
        let settings = Settings {
            seed: 20,
            cases_per_region: 12,
            ..Settings::default()
        };
        for name in NAMES {
            let method = crate::methods::find(name).expect("registered");
            let report = audit_method(&*method, &settings, &|| {});
            assert!(report.passed(), "{name}: {:?}", report.failures.first());
        }
    }

    #[test]
    fn planted_faults_are_over_budget() {
        for name in NAMES {
            let method = crate::methods::find(name).expect("registered");
            let case = (method.domain().regions[0].sample)(&mut Draw::new(3, name, "planted", 1));
            let exact: Vec<Rational> = case.iter().filter_map(|&x| Rational::from_f64(x)).collect();
            let reference = method.reference(&exact, 128);
            let conditions = method.conditions(&case);
            let SolverAnswer::Values(good) = method.solve(&case) else {
                panic!("{name} refuses its own sample");
            };
            let verdict = |v: Vec<f64>| {
                let answer = SolverAnswer::Values(v);
                judge(
                    &method.outputs(),
                    &answer,
                    &reference,
                    conditions.as_deref(),
                )
                .verdict
            };
            assert_eq!(verdict(good.clone()), Verdict::Pass, "{name}");
            for i in 0..good.len() {
                let mut bad = good.clone();
                bad[i] = bad[i] * (1.0 + 1e-3) + 1e-6;
                assert_eq!(verdict(bad), Verdict::Over, "{name}, value {i}");
            }
        }
    }

    #[test]
    fn the_end_values_enter_the_conditions() {
        let input = [0.0, 1.0, 2.0, 0.0, 0.0, 0.0, 3.0, -5.0, 0.5, 1.5];
        let c = super::sensitivity::conditions(Kind::SecondDerivatives, &input).unwrap();
        assert_eq!(c.len(), 10);
        assert!(c.iter().all(|c| c.is_finite() && *c > 0.0));
        let audit = crate::methods::find("cubic-spline-second-derivatives").unwrap();
        assert_eq!(Method::conditions(&*audit, &input), Some(c));
    }
}
