use super::*;
use rug::Rational;

/// `∫₀¹ x² dx` by the trapezoidal rule: the error is exactly `1/(6 n²)`.
#[test]
fn the_error_is_taken_apart() {
    let intervals = |level: usize| 3u64 << level;
    let area = |level| {
        let h = 1.0 / intervals(level) as f64;
        let ends = |i: u64| [i as f64 * h, (i + 1) as f64 * h];
        let all = (0..intervals(level)).map(ends);
        all.fold(0.0, |s, [a, b]| s + 0.5 * h * (a * a + b * b))
    };
    let exactly = |level| {
        let n = intervals(level);
        let area = |i| Rational::from((i * i + (i + 1) * (i + 1), 2 * n * n * n));
        let sum: Rational = (0..n).map(area).sum();
        Some(vec![Ball::rational(128, &sum)])
    };
    let mut plan = Plan::of(&[0, 1, 2, 3, 4].map(area));
    plan.runs[1] = SolverAnswer::Fails("planted".into());
    plan.twins = (0..5).map(exactly).collect();
    plan.truth = Ball::rational(128, &Rational::from((1, 3)));
    let report = plan.report();
    assert_eq!(report.levels[1].failed.as_deref(), Some("planted"));
    // The level after a failed one shows no order.
    assert_eq!(report.levels[2].errors[0].order, None);
    let last = report.levels[4].errors[0];
    let expected = 1.0 / (6.0 * 48.0 * 48.0);
    assert!((last.method.unwrap() / expected - 1.0).abs() < 1e-12);
    assert!((last.order.unwrap() - 2.0).abs() < 1e-9);
    assert!((last.richardson.unwrap() - 2.0).abs() < 1e-6);
    assert!(last.rounding.unwrap() > 0.0 && last.rounding.unwrap() < 1e-15);
    assert!((report.fitted[0].unwrap() - 2.0).abs() < 1e-9);
    assert!(last.total <= last.method.unwrap() + last.rounding.unwrap() + 1e-18);
}

/// Values, twins and half steps at each level as they are planted; the work doubles.
struct Plan {
    outputs: usize,
    truths: usize,
    /// Of each value.
    truth: Ball,
    regular: bool,
    runs: Vec<SolverAnswer>,
    twins: Vec<Option<Vec<Ball>>>,
    halved: Vec<Option<Vec<Ball>>>,
}

impl Plan {
    /// One output, no twin.
    fn of(values: &[f64]) -> Plan {
        let runs = values.iter().map(|v| SolverAnswer::Values(vec![*v]));
        Plan {
            outputs: 1,
            truths: 1,
            truth: ball(0.5, 0.0),
            regular: true,
            runs: runs.collect(),
            twins: Vec::new(),
            halved: Vec::new(),
        }
    }

    /// With an exact twin of these values.
    fn with_twins(self, values: &[f64]) -> Plan {
        let twins = values.iter().map(|v| Some(vec![ball(*v, 0.0)])).collect();
        Plan { twins, ..self }
    }

    fn report(&self) -> ConvergenceReport {
        convergence(self).unwrap()
    }
}

fn ball(mid: f64, radius: f64) -> Ball {
    Ball::new(rug::Float::with_val(53, mid), Mag::from_f64(radius))
}

impl Approximation for Plan {
    fn name(&self) -> &'static str {
        "plan"
    }
    fn summary(&self) -> &'static str {
        "a planted approximation"
    }
    fn work_unit(&self) -> &'static str {
        "steps"
    }
    fn outputs(&self) -> Vec<(&'static str, Option<f64>)> {
        [("s", Some(2.0)), ("t", None)][..self.outputs].to_vec()
    }
    fn places(&self) -> String {
        "one place".into()
    }
    fn levels(&self) -> Vec<String> {
        (0..self.runs.len()).map(|k| format!("level {k}")).collect()
    }
    fn is_regular(&self) -> bool {
        self.regular
    }
    fn run(&self, level: usize) -> (u64, SolverAnswer) {
        (8 << level, self.runs[level].clone())
    }
    fn twin(&self, level: usize) -> Option<Vec<Ball>> {
        self.twins.get(level).cloned().flatten()
    }
    fn twin_of_half_steps(&self, level: usize) -> Option<Vec<Ball>> {
        self.halved.get(level).cloned().flatten()
    }
    fn truth(&self) -> Result<Vec<Ball>, Uncertified> {
        match self.truths {
            0 => Err(Uncertified::Undecided("planted".into())),
            n => Ok(vec![self.truth.clone(); n]),
        }
    }
}

/// Powers of two, so that every logarithm is a multiple of one.
#[test]
fn orders_follow_from_errors() {
    // Errors 1/4, 1/16, 1/64, 1/256: a quarter for twice the work.
    let errors = [2, 4, 6, 8].map(|k| 2f64.powi(-k));
    let report = Plan::of(&errors.map(|e| 0.5 + e)).report();
    assert_eq!((report.name, report.work_unit), ("plan", "steps"));
    assert_eq!(report.outputs, ["s"]);
    assert_eq!(report.places, "one place");
    assert_eq!(report.orders, [Some(2.0)]);
    for (k, level) in report.levels.iter().enumerate() {
        assert_eq!(
            (level.level.as_str(), level.work),
            (&*format!("level {k}"), 8 << k)
        );
        assert_eq!(level.failed, None);
        let e = level.errors[0];
        assert_eq!((e.total, e.method, e.rounding), (errors[k], None, None));
        let near = |order: Option<f64>| order.map(|x| (x - 2.0).abs() < 1e-12);
        assert_eq!(near(e.order), (k > 0).then_some(true));
        assert_eq!(near(e.richardson), (k > 1).then_some(true));
    }
    assert!((report.fitted[0].unwrap() - 2.0).abs() < 1e-12);
}

/// With a twin the orders are those of the method error, whatever rounding adds.
#[test]
fn a_twin_takes_rounding_out() {
    let twins = [1.0, 0.625, 0.53125];
    let report = Plan::of(&[1.25, 0.875, 0.78125])
        .with_twins(&twins)
        .report();
    for (k, level) in report.levels.iter().enumerate() {
        let e = level.errors[0];
        let method = 2f64.powi(-1 - 2 * k as i32);
        assert_eq!((e.method, e.rounding), (Some(method), Some(0.25)));
        assert_eq!(e.total, method + 0.25);
    }
    let last = report.levels[2].errors[0];
    assert!((last.order.unwrap() - 2.0).abs() < 1e-12);
    assert!((report.fitted[0].unwrap() - 2.0).abs() < 1e-12);
    // Errors are upper bounds: the radius of the twin is part of both.
    let mut wide = Plan::of(&[1.0]);
    wide.twins = vec![Some(vec![ball(1.0, 0.25)])];
    let e = wide.report().levels[0].errors[0];
    assert_eq!((e.total, e.rounding), (0.5, Some(0.25)));
    assert!((0.75..0.751).contains(&e.method.unwrap()));
}

/// A value that is missing or no number leaves a gap, across which no order is observed.
#[test]
fn what_is_no_value_is_a_gap() {
    let values = |v: &[f64]| SolverAnswer::Values(v.to_vec());
    let missing = "a value is missing or not finite";
    for (bad, expected) in [
        (values(&[1.0, f64::NAN]), missing),
        (values(&[f64::INFINITY, 1.0]), missing),
        (values(&[1.0]), missing),
        (values(&[1.0, 1.0, 1.0]), missing),
        (values(&[]), missing),
        (SolverAnswer::Fails("planted".into()), "planted"),
        (SolverAnswer::Unanswered("no answer".into()), "no answer"),
        (SolverAnswer::Refuses("domain"), "domain"),
        (SolverAnswer::Declines(None), "refused"),
    ] {
        let mut plan = Plan::of(&[0.0; 5]);
        plan.truths = 2;
        let good = |k: i32| values(&[0.5 + 2f64.powi(-k), 0.5 - 2f64.powi(-k)]);
        plan.runs = vec![good(1), bad, good(3), good(4), good(5)];
        let report = plan.report();
        let failed: Vec<_> = report.levels.iter().map(|l| l.failed.as_deref()).collect();
        assert_eq!(failed, [None, Some(expected), None, None, None]);
        let gap = &report.levels[1];
        assert_eq!((gap.work, gap.errors.len()), (16, 0));
        let orders = |f: fn(&LevelError) -> Option<f64>| {
            let errors = report.levels.iter().flat_map(|l| &l.errors);
            errors.map(|e| f(e).is_some()).collect::<Vec<_>>()
        };
        assert_eq!(orders(|e| e.order), [false, false, true, true]);
        assert_eq!(orders(|e| e.richardson), [false, false, false, true]);
        // The line goes through the levels that have errors.
        assert!((report.fitted[0].unwrap() - 1.0).abs() < 1e-12);
    }
}

/// A twin of another number of values is none.
#[test]
fn twins_have_as_many_values() {
    let mut plan = Plan::of(&[1.0, 0.75, 0.625]);
    let one = ball(0.75, 0.0);
    plan.twins = vec![
        Some(vec![one.clone(); 2]),
        Some(vec![]),
        Some(vec![one.clone()]),
    ];
    plan.halved = vec![Some(vec![one.clone()]), Some(vec![one]), Some(vec![])];
    plan.regular = false;
    let report = plan.report();
    let methods: Vec<_> = report.levels.iter().map(|l| l.errors[0].method).collect();
    assert_eq!(methods, [None, None, Some(0.25)]);
    assert!(report.levels.iter().all(|l| l.errors[0].order.is_none()));
}

/// Where steps are chosen by the code, cutting them in two shows the order, not the next level.
#[test]
fn half_steps_show_the_order() {
    let mut plan = Plan::of(&[1.0, 0.75, 0.625]).with_twins(&[1.0, 0.75, 0.625]);
    plan.regular = false;
    plan.halved = vec![
        Some(vec![ball(0.5625, 0.0)]),
        None,
        Some(vec![ball(0.75, 0.0); 2]),
    ];
    let orders = |plan: &Plan| -> Vec<_> {
        let levels = plan.report().levels;
        levels.iter().map(|l| l.errors[0].order).collect()
    };
    // An error of 1/2 becomes one of 1/16.
    assert_eq!(orders(&plan), [Some(3.0), None, None]);
    let richardson = |l: &LevelReport| l.errors[0].richardson.is_none();
    assert!(plan.report().levels.iter().all(richardson));
    // From one regular level to the next the work tells.
    plan.regular = true;
    assert_eq!(orders(&plan), [Some(3.0), Some(1.0), Some(1.0)]);
}

/// Values belong to outputs cyclically, and the largest error of an output counts.
#[test]
fn outputs_have_their_own_errors() {
    let mut plan = Plan::of(&[0.0; 3]);
    (plan.outputs, plan.truths) = (2, 4);
    let at = |k: i32| {
        let (e, f) = (2f64.powi(-k), 2f64.powi(-3 * k));
        SolverAnswer::Values(vec![0.5 + e / 4.0, 0.5 + f, 0.5 - e, 0.5 - f / 2.0])
    };
    plan.runs = vec![at(1), at(2), at(3)];
    let report = plan.report();
    assert_eq!(report.orders, [Some(2.0), None]);
    for (k, level) in (1..).zip(&report.levels) {
        let totals: Vec<f64> = level.errors.iter().map(|e| e.total).collect();
        assert_eq!(totals, [2f64.powi(-k), 2f64.powi(-3 * k)]);
    }
    let last = &report.levels[2].errors;
    for (o, expected) in [1.0, 3.0].into_iter().enumerate() {
        for order in [last[o].order, last[o].richardson, report.fitted[o]] {
            assert!((order.unwrap() - expected).abs() < 1e-12, "{o} {order:?}");
        }
    }
}

/// A line goes through three points at least; what is exact has no logarithm and is left out.
#[test]
fn lines_are_fitted_to_three_levels() {
    let fitted = |values: &[f64]| Plan::of(values).report().fitted[0];
    assert_eq!(fitted(&[]), None);
    assert_eq!(fitted(&[1.0]), None);
    assert_eq!(fitted(&[1.0, 0.75]), None);
    assert_eq!(fitted(&[1.0, 0.75, 0.5]), None);
    let order = fitted(&[1.0, 0.75, 0.625]).unwrap();
    assert!((order - 1.0).abs() < 1e-12, "{order}");
    let order = fitted(&[1.0, 0.75, 0.5, 0.5625]).unwrap();
    assert!((order - 1.0).abs() < 1e-12, "{order}");
    // Of errors 1, 1/2, 1/8 the least squares through 0, -1, -3 have the slope -3/2.
    let order = fitted(&[1.5, 1.0, 0.625]).unwrap();
    assert!((order - 1.5).abs() < 1e-12, "{order}");
    // An order between a level and an exact one means nothing.
    let report = Plan::of(&[1.0, 0.5, 0.5]).report();
    assert!(report.levels.iter().all(|l| l.errors[0].order.is_none()));
    assert!(
        report
            .levels
            .iter()
            .all(|l| l.errors[0].richardson.is_none())
    );
}

#[test]
fn without_the_truth_there_is_no_report() {
    let mut plan = Plan::of(&[1.0]);
    plan.truths = 0;
    assert!(matches!(convergence(&plan), Err(Uncertified::Undecided(why)) if why == "planted"));
}

/// Levels next to each other, far from zero on both axes: deviations from the means keep the
/// digits.
#[test]
fn a_line_is_fitted_far_from_its_origin() {
    for n in 5..12 {
        let mut levels = Plan::of(&vec![1.0; n]).report().levels;
        for (k, level) in levels.iter_mut().enumerate() {
            level.work = 1_000_000 + k as u64;
            let ratio = level.work as f64 / 1e6;
            level.errors[0].total = 1e-300 / (ratio * ratio);
        }
        let order = fitted(&levels, 0).unwrap();
        assert!((order - 2.0).abs() < 1e-3, "{n}: {order}");
    }
}
