//! The shared part of the audited splines on arbitrary knots.
//!
//! Input: `x[n]`, `y[n]`, then two end values for the kinds that have them, then the two query
//! points `q0`, `q1`. Output, for each query: `S`, `S'`, `S''`, `S'''` there and the integral from
//! it to the other query.

use crate::audit::{Output, ReferenceAnswer, Rows, Uncertified};
use crate::methods::Number;
use crate::methods::common::conditioned;
use crate::reference::cubic_spline::{End as ExactEnd, Spline as ExactSpline, SplineError};
use crate::solvers::cubic_spline::{
    Boundary, CubicSpline, CubicSplineError, End, EvaluationError, Extrapolation, Grid, Jet, Spline,
};
use crate::solvers::hermite_spline::{HermiteSpline, Slopes};
use rug::Rational;

/// Describes what makes a spline on arbitrary knots the only one.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Kind {
    /// A cubic spline with a condition for each end.
    Ends([EndKind; 2]),
    /// A periodic cubic spline.
    Periodic,
    /// Slopes from neighbouring points.
    Local(Slopes),
}

/// The condition at one end.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum EndKind {
    NotAKnot,
    FirstDerivative,
    SecondDerivative,
}

/// A spline to be made and where it is asked for.
#[derive(Debug)]
pub struct SplineProblem<'a, T: Number = f64> {
    /// The knots, increasing; fewer than two or unordered ones have to be refused.
    pub x: &'a [T],
    /// The ordinates.
    pub y: &'a [T],
    /// The end values, for the kinds that have them.
    pub ends: Option<[T::Of<'a>; 2]>,
    /// Two abscissae. Due for each: `S, S', S'', S'''` there and the integral to the other.
    pub queries: [T::Of<'a>; 2],
}

// Derived, these would ask for numbers that are `Copy` themselves.
impl<T: Number> Clone for SplineProblem<'_, T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T: Number> Copy for SplineProblem<'_, T> {}

/// Ends are given where the kind has them.
const ENDS: &str = "an input of this kind has end values";

impl EndKind {
    /// The order of the derivative that is given, if one is.
    pub(super) fn order(self) -> Option<i32> {
        match self {
            EndKind::NotAKnot => None,
            EndKind::FirstDerivative => Some(1),
            EndKind::SecondDerivative => Some(2),
        }
    }
}

/// A fitted spline of either form.
pub(super) trait Fitted {
    fn jet(&self, x: f64) -> Result<Jet, EvaluationError>;
    fn integral(&self, a: f64, b: f64) -> Result<f64, EvaluationError>;
}

impl<G: Grid> Fitted for Spline<G> {
    fn jet(&self, x: f64) -> Result<Jet, EvaluationError> {
        self.jet(x)
    }
    fn integral(&self, a: f64, b: f64) -> Result<f64, EvaluationError> {
        self.integral(a, b)
    }
}

impl Fitted for HermiteSpline {
    fn jet(&self, x: f64) -> Result<Jet, EvaluationError> {
        self.jet(x)
    }
    fn integral(&self, a: f64, b: f64) -> Result<f64, EvaluationError> {
        self.integral(a, b)
    }
}

impl Kind {
    pub(super) const SECOND_DERIVATIVES: Kind = Kind::Ends([EndKind::SecondDerivative; 2]);
    pub(super) const CLAMPED: Kind = Kind::Ends([EndKind::FirstDerivative; 2]);
    pub(super) const NOT_A_KNOT: Kind = Kind::Ends([EndKind::NotAKnot; 2]);

    /// The orders of the derivatives given at the ends.
    pub(super) fn end_orders(self) -> [Option<i32>; 2] {
        match self {
            Kind::Ends(kinds) => kinds.map(EndKind::order),
            Kind::Periodic | Kind::Local(_) => [None; 2],
        }
    }

    fn try_fit(self, p: SplineProblem) -> Result<Box<dyn Fitted>, CubicSplineError> {
        let (x, y) = (p.x.to_vec(), p.y.to_vec());
        let boundary = match self {
            Kind::Ends(kinds) => {
                let end = |i: usize| {
                    let value = || p.ends.expect(ENDS)[i];
                    match kinds[i] {
                        EndKind::NotAKnot => End::NotAKnot,
                        EndKind::FirstDerivative => End::FirstDerivative(value()),
                        EndKind::SecondDerivative => End::SecondDerivative(value()),
                    }
                };
                Boundary::Ends(end(0), end(1))
            }
            Kind::Periodic => Boundary::Periodic,
            Kind::Local(slopes) => {
                return Ok(Box::new(HermiteSpline::fit(x, y, slopes)?));
            }
        };
        let s = CubicSpline::fit(x, y, boundary)?;
        Ok(Box::new(match self {
            Kind::Periodic => s.with_extrapolation(Extrapolation::Wrap),
            _ => s,
        }))
    }

    /// Why there is no spline, with the place.
    pub(super) fn explanation(self, p: SplineProblem) -> Option<String> {
        self.try_fit(p).err().map(|e| e.to_string())
    }

    pub(super) fn fit(self, p: SplineProblem) -> Result<Box<dyn Fitted>, &'static str> {
        self.try_fit(p).map_err(|e| word(&e))
    }

    pub(super) fn solve(self, p: SplineProblem) -> Result<Vec<f64>, &'static str> {
        outputs_of(&*self.fit(p)?, p.queries)
    }

    pub(super) fn reference(
        self,
        p: SplineProblem<Rational>,
        bits: u32,
    ) -> Result<ReferenceAnswer, Uncertified> {
        let spline = match self {
            Kind::Ends(kinds) => {
                let end = |i: usize| {
                    let value = || p.ends.expect(ENDS)[i];
                    match kinds[i] {
                        EndKind::NotAKnot => ExactEnd::NotAKnot,
                        EndKind::FirstDerivative => ExactEnd::FirstDerivative(value()),
                        EndKind::SecondDerivative => ExactEnd::SecondDerivative(value()),
                    }
                };
                ExactSpline::with_ends(p.x, p.y, end(0), end(1))
            }
            Kind::Periodic => ExactSpline::periodic(p.x, p.y),
            Kind::Local(Slopes::Pchip) => ExactSpline::pchip(p.x, p.y),
            Kind::Local(Slopes::Akima) => ExactSpline::akima(p.x, p.y),
            Kind::Local(Slopes::ModifiedAkima) => ExactSpline::modified_akima(p.x, p.y),
        };
        let refused = |e| {
            Uncertified::Refused(match e {
                SplineError::TooFew(_) => "too few knots",
                SplineError::Length { .. } => "bad layout",
                SplineError::NotIncreasing(_) => "knots not increasing",
                SplineError::NotPeriodic => "not periodic",
            })
        };
        let spline = spline.map_err(refused)?;
        match self {
            Kind::Periodic => Ok(values_of(
                p.queries,
                bits,
                |q| spline.eval_periodic(q),
                |a, b| spline.integral_periodic(a, b),
            )),
            _ => reference_of(&spline, p.x, p.queries, bits),
        }
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

/// Returns what the solver gives for the two queries.
pub(super) fn outputs_of(s: &dyn Fitted, q: [f64; 2]) -> Result<Vec<f64>, &'static str> {
    let refuse = |e: EvaluationError| match e {
        EvaluationError::Outside { .. } => "outside",
        _ => "not finite",
    };
    let mut out = Vec::new();
    for (a, b) in [(q[0], q[1]), (q[1], q[0])] {
        let j = s.jet(a).map_err(refuse)?;
        let integral = s.integral(a, b).map_err(refuse)?;
        out.extend([j.value, j.first, j.second, j.third, integral]);
    }
    Ok(out)
}

/// Returns what the exact spline gives for the two queries.
pub(super) fn reference_of(
    s: &ExactSpline,
    x: &[Rational],
    q: [&Rational; 2],
    bits: u32,
) -> Result<ReferenceAnswer, Uncertified> {
    if q.iter().any(|q| **q < x[0] || **q > x[x.len() - 1]) {
        return Err(Uncertified::Refused("outside"));
    }
    Ok(values_of(q, bits, |q| s.eval(q), |a, b| s.integral(a, b)))
}

fn values_of(
    q: [&Rational; 2],
    bits: u32,
    eval: impl Fn(&Rational) -> [Rational; 4],
    integral: impl Fn(&Rational, &Rational) -> Rational,
) -> ReferenceAnswer {
    let mut values = Vec::new();
    let integral = integral(q[0], q[1]);
    values.extend(eval(q[0]));
    values.push(integral.clone());
    values.extend(eval(q[1]));
    values.push(-integral);
    ReferenceAnswer::exact(&values, bits)
}

const REASON: &str = "every weight of S, S', S'' and S''' is a product of a few factors, each with a \
    relative error of a few u, and the second derivatives come from a system dominant by rows, solved \
    with a componentwise backward error of 13 u at most, or from divided differences where four knots leave one \
    cubic; the sum over the data is the condition";

const LOCAL_REASON: &str = "differences of neighbouring chord slopes are taken in twice the working precision, where their \
    error is a few u^2 of the chord slopes, far below the u of them that the data's rounding is worth; slopes and \
    their excess over the chords are sums of two products of a few factors, each with a relative error of a few u; \
    where a comparison of slopes could go either way the slope is continuous, but for Akima's two vanishing \
    weights, where solver and reference both decide exactly; the sum over the data is the condition, on whichever \
    side it is larger";

/// The five outputs with their budgets in units of the conditioned limit.
pub(super) fn outputs(k: f64) -> Vec<Output> {
    budgeted(k, REASON)
}

/// [`outputs`] of interpolants with local slopes.
pub(super) fn local_outputs(k: f64) -> Vec<Output> {
    budgeted(k, LOCAL_REASON)
}

fn budgeted(k: f64, reason: &'static str) -> Vec<Output> {
    [
        ("S", "y"),
        ("S'", "y/x"),
        ("S''", "y/x^2"),
        ("S'''", "y/x^3"),
        ("integral", "x y"),
    ]
    .map(|(name, unit)| conditioned(name, unit, k, reason))
    .to_vec()
}

/// The outputs belong to a query each.
pub(super) const ROWS: Rows = Rows {
    index: "q",
    count: "2",
    meaning: "at q0 and at q1, the integral running to the other one",
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::audit::{Draw, Settings, SolverAnswer, Verdict, audit_method, judge};
    use crate::methods::definition::exact;

    const NAMES: [&str; 11] = [
        "tridiagonal",
        "cyclic-tridiagonal",
        "cubic-spline-second-derivatives",
        "cubic-spline-clamped",
        "cubic-spline-not-a-knot",
        "cubic-spline-periodic",
        "cubic-spline-uniform",
        "cubic-spline-mixed-ends",
        "pchip",
        "akima",
        "modified-akima",
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

    /// Solver and reference in one word.
    #[test]
    fn what_is_no_spline_is_refused_by_its_name() {
        let (inf, max) = (f64::INFINITY, f64::MAX);
        // x, y, queries
        let inputs = [
            (&[0.0][..], &[1.0][..], [0.0, 0.0], "too few knots"),
            (
                &[0.0, 1.0, 1.0],
                &[1.0, 2.0, 1.0],
                [0.0, 1.0],
                "knots not increasing",
            ),
            (&[0.0, 1.0, 2.0], &[1.0, 2.0, 1.0], [-0.25, 2.0], "outside"),
            (&[0.0, 1.0, 2.0], &[1.0, 2.0, 1.0], [0.0, 2.25], "outside"),
            (&[0.0, 1.0, 2.0], &[1.0, 2.0, 1.0], [2.25, 0.0], "outside"),
            (&[0.0, 1.0, inf], &[1.0, 2.0, 1.0], [0.0, 1.0], "not finite"),
            (&[0.0, 1.0, 2.0], &[1.0, inf, 1.0], [0.0, 1.0], "not finite"),
            (
                &[0.0, 1.0, 2.0],
                &[1.0, 2.0, 1.0],
                [0.0, f64::NAN],
                "not finite",
            ),
            (&[0.0, 1.0, 2.0], &[max, -max, max], [0.0, 1.0], "overflow"),
        ];
        for (name, ends) in [
            ("cubic-spline-second-derivatives", 2),
            ("cubic-spline-clamped", 2),
            ("cubic-spline-not-a-knot", 0),
            ("cubic-spline-periodic", 0),
            ("pchip", 0),
            ("akima", 0),
            ("modified-akima", 0),
        ] {
            let method = crate::methods::find(name).expect("registered");
            for (x, y, queries, due) in inputs {
                let input = [x, y, &[0.5, 0.25][..ends], &queries].concat();
                let answer = method.solve(&input);
                // A periodic spline goes on.
                if name == "cubic-spline-periodic" && due == "outside" {
                    assert!(matches!(answer, SolverAnswer::Values(_)), "{input:?}");
                    continue;
                }
                assert_eq!(answer, SolverAnswer::Refuses(due), "{name} {input:?}");
                let Some(exact) = exact(&input).filter(|_| due != "overflow") else {
                    continue;
                };
                let no_spline = ["too few knots", "knots not increasing"].contains(&due);
                assert_eq!(
                    method.conditions(&input).is_none(),
                    no_spline,
                    "{name} {input:?}"
                );
                match method.reference(&exact, 128) {
                    ReferenceAnswer::Refuses(word) => assert_eq!(word, due, "{name} {input:?}"),
                    other => panic!("{name} {input:?}: {other:?}"),
                }
            }
            // At the ends themselves.
            let good = [
                &[0.0, 1.0, 2.0, 1.0, 2.0, 1.0][..],
                &[0.5, 0.25][..ends],
                &[0.0, 2.0],
            ];
            let answer = method.solve(&good.concat());
            assert!(matches!(answer, SolverAnswer::Values(_)), "{name}");
        }
        let uneven = [0.0, 1.0, 2.0, 1.0, 2.0, 1.5, 0.0, 2.0];
        let periodic = crate::methods::find("cubic-spline-periodic").expect("registered");
        assert_eq!(
            periodic.solve(&uneven),
            SolverAnswer::Refuses("not periodic")
        );
        assert_eq!(periodic.conditions(&uneven), None);
        let answer = periodic.reference(&exact(&uneven).unwrap(), 128);
        assert!(matches!(answer, ReferenceAnswer::Refuses("not periodic")));
    }

    /// Other conventions at exact decisions are over budget, and the one of the definition passes.
    #[test]
    fn conventions_are_told_apart() {
        let judged = |name: &str, place: &str, change: &dyn Fn(&mut Vec<f64>)| {
            let method = crate::methods::find(name).expect("registered");
            let domain = method.domain();
            let case = domain.check_points.iter().find(|p| p.name == place);
            let case = &case.expect("a check point").input;
            let reference = method.reference(&exact(case).unwrap(), 128);
            let conditions = method.conditions(case);
            let SolverAnswer::Values(mut values) = method.solve(case) else {
                panic!("{name} refuses {place}");
            };
            change(&mut values);
            let answer = SolverAnswer::Values(values);
            let outputs = method.outputs();
            judge(&outputs, &answer, &reference, conditions.as_deref()).verdict
        };
        // q0 = 1.5 lies before the knot 2 with chords 0 and 1, where Akima's weights are both 0: a
        // slope of 0 or 1 there instead of 1/2 changes S by 1/16.
        for other in [0.0625, -0.0625] {
            let moved = |v: &mut Vec<f64>| v[0] += other;
            assert_eq!(
                judged("akima", "two-straight-pieces", &moved),
                Verdict::Over
            );
        }
        for place in ["two-straight-pieces", "a-step", "level"] {
            assert_eq!(judged("akima", place, &|_| ()), Verdict::Pass, "{place}");
        }
        // A threshold of 10⁻⁹ of the largest weight gives 0.5·10⁻¹² at knot 2, where 1.5·10⁻¹² is
        // due.
        let place = "small-bend-far-from-a-large-one";
        let with_threshold = |v: &mut Vec<f64>| v[5] += 1.25e-13;
        assert_eq!(judged("akima", place, &|_| ()), Verdict::Pass);
        assert_eq!(judged("akima", place, &with_threshold), Verdict::Over);
        // Without its clippings the parabola's slope at the left end is −0.5 for 0, 6.5 for 3.
        for (place, slope) in [("end-slope-zero", -0.5), ("end-slope-limited", 3.5)] {
            let (k, w) = (0.25, 0.75);
            let unclipped = |v: &mut Vec<f64>| v[0] += k * w * w * slope;
            assert_eq!(judged("pchip", place, &unclipped), Verdict::Over, "{place}");
            assert_eq!(judged("pchip", place, &|_| ()), Verdict::Pass, "{place}");
        }
    }

    #[test]
    fn the_end_values_enter_the_conditions() {
        let input = [0.0, 1.0, 2.0, 0.0, 0.0, 0.0, 3.0, -5.0, 0.5, 1.5];
        let method = crate::methods::find("cubic-spline-second-derivatives").unwrap();
        let c = method.conditions(&input).unwrap();
        assert_eq!(c.len(), 10);
        assert!(c.iter().all(|c| c.is_finite() && *c > 0.0));
    }
}
