//! Tests of the measures of errors, shares and budgets, and of their words.

use super::*;

fn measured(got: &[f64], expected: &[f64], limit: Limit, conditions: Option<&[f64]>) -> Judgement {
    let answer = SolverAnswer::Values(got.to_vec());
    judge(&outputs(limit), &answer, &exact(expected), conditions)
}

/// `1 + k u` in units of u = 2^-53, where one is 2u wide above and u below.
fn near_one(k: f64) -> f64 {
    1.0 + k * 2f64.powi(-53)
}

#[test]
fn what_is_wrong_is_said() {
    let expected = |d: Expected| ReferenceAnswer::Expected(vec![d], Proof::Exact);
    let o = outputs(Limit::Ulps(4.0));
    let said =
        |got: f64, d: Expected| judge(&o, &SolverAnswer::Values(vec![got]), &expected(d), None);
    let zero = said(-0.0, Expected::zero(false));
    assert_eq!(zero.why().as_deref(), Some("x (value 0) is -0, expected 0"));
    assert_eq!(
        (zero.kind, zero.components[0].kind),
        (Some(Kind::WrongZero), Some(Kind::WrongZero))
    );
    let nan = said(f64::NAN, Expected::zero(false));
    assert_eq!(nan.why().as_deref(), Some("x (value 0) is NaN, expected 0"));
    assert_eq!(nan.kind, Some(Kind::Nan));
    let number = |x: f64| Expected::Number(Ball::exact(64, x));
    assert_eq!(said(f64::INFINITY, number(1.0)).kind, Some(Kind::Infinity));
    let over = said(1.0 + 8.0 * f64::EPSILON, number(1.0));
    assert_eq!((over.kind, over.components[0].kind), (None, None));
    assert_eq!(
        over.why().as_deref(),
        Some("x (value 0) is 1.0000000000000018e0, expected 1e0: 2.000 times its budget off")
    );
    // The first of two equally wrong values is named.
    let first = measured(&[2.0, 7.0], &[1.0, 1.0], Limit::Ulps(4.0), None);
    assert!(first.why().unwrap().starts_with("x (value 0) is "));
    let lost = measured(
        &[f64::NAN, f64::INFINITY],
        &[1.0, 1.0],
        Limit::Ulps(4.0),
        None,
    );
    assert_eq!(lost.kind, Some(Kind::Nan));
    // No infinity that is due has a share but none or all of its budget.
    let infinity = said(f64::INFINITY, Expected::Infinity { negative: false });
    assert_eq!(
        (infinity.components[0].of_budget, infinity.share()),
        (0.0, 0.0)
    );
    let other = said(f64::NEG_INFINITY, Expected::Infinity { negative: false });
    assert_eq!(other.share(), f64::INFINITY);
}

#[test]
fn a_share_is_that_of_the_worst() {
    let two = measured(
        &[near_one(2.0), near_one(4.0)],
        &[1.0, 1.0],
        Limit::Ulps(4.0),
        None,
    );
    assert!((two.share() - 0.5).abs() < 1e-12);
    // Nothing there is all of the budget, unless nothing is due.
    let none = measured(&[1.0], &[1.0, 1.0], Limit::Ulps(4.0), None);
    assert_eq!((none.components.len(), none.share()), (0, f64::INFINITY));
    let refused = ReferenceAnswer::Refuses("singular");
    let right = judge(
        &outputs(Limit::Ulps(1.0)),
        &SolverAnswer::Refuses("singular"),
        &refused,
        None,
    );
    assert_eq!((right.share(), right.normwise), (0.0, 0.0));
    // A share that is no number is all of it.
    let lost = Judgement {
        components: vec![ComponentJudgement {
            of_budget: f64::NAN,
            ..two.components[0].clone()
        }],
        ..two
    };
    assert_eq!(lost.share(), f64::INFINITY);
}

#[test]
fn errors_are_measured_in_their_units() {
    // 2 u off 1, conditioned on |1| + 3.
    let one = measured(
        &[near_one(2.0)],
        &[1.0],
        Limit::Conditioned(4.0),
        Some(&[3.0]),
    );
    let c = &one.components[0];
    assert!(c.ulps == 1.0 && (c.condition - 3.0).abs() < 1e-12, "{c:?}");
    assert!(
        (c.conditioned - 0.5).abs() < 1e-12 && (c.of_budget - 0.125).abs() < 1e-12,
        "{c:?}"
    );
    assert!((one.normwise - 2.0).abs() < 1e-9);
    // A condition number is by |f|: 3 of |2| is 1.5.
    let two = measured(&[2.0], &[2.0], Limit::Conditioned(4.0), Some(&[3.0]));
    assert!((two.components[0].condition - 1.5).abs() < 1e-12);
    assert_eq!(two.normwise, 0.0);
    // Zero has none, nor ulps.
    let zero = measured(&[0.0], &[0.0], Limit::Absolute(1.0), Some(&[3.0]));
    let c = &zero.components[0];
    assert!(c.ulps.is_nan() && c.condition == f64::INFINITY, "{c:?}");
    // Without condition numbers, or with one that is none, the limit that needs them is undecided.
    for conditions in [
        None,
        Some(&[f64::INFINITY][..]),
        Some(&[f64::NAN]),
        Some(&[1.0, 1.0]),
    ] {
        for limit in [Limit::Conditioned(4.0), Limit::Normwise(4.0)] {
            let open = measured(&[1.0], &[1.0], limit, conditions);
            if conditions.is_none()
                || limit == Limit::Conditioned(4.0)
                || conditions.unwrap().len() == 2
            {
                assert_eq!(open.verdict, Verdict::Undecided, "{limit} {conditions:?}");
            }
            assert!(open.verdict != Verdict::Over);
        }
    }
    // The norm is over all values: errors of 2 u in both of (3, 4) are 2 √2/5 u.
    let u = 2f64.powi(-51);
    let norm = measured(
        &[3.0 + u, 4.0 + 2.0 * u],
        &[3.0, 4.0],
        Limit::Absolute(1.0),
        None,
    );
    assert!(
        (norm.normwise - 4.0 * 5f64.sqrt() / 5.0).abs() < 1e-9,
        "{}",
        norm.normwise
    );
    // With a value that is no number it has no meaning.
    let expected = vec![
        Expected::Number(Ball::integer(64, 1)),
        Expected::Infinity { negative: false },
    ];
    let expected = ReferenceAnswer::Expected(expected, Proof::Exact);
    let got = SolverAnswer::Values(vec![1.0, f64::INFINITY]);
    let budget = NormBudget::new(4.0, "planted");
    let mixed = judge_with_norm(
        &outputs(Limit::Ulps(1.0)),
        Some(&budget),
        &got,
        &expected,
        None,
    );
    assert!(mixed.normwise.is_nan() && mixed.norm_of_budget.is_nan());
    assert_eq!(mixed.verdict, Verdict::Pass);
}

#[test]
fn a_norm_s_budget_is_for_numbers_and_decided_by_bounds() {
    let budget = NormBudget::new(4.0, "planted");
    let o = outputs(Limit::Absolute(1e300));
    let judged = |got: f64, expected: Ball| {
        let reference = ReferenceAnswer::bounded(vec![expected], "planted");
        judge_with_norm(
            &o,
            Some(&budget),
            &SolverAnswer::Values(vec![got]),
            &reference,
            None,
        )
    };
    // 4 u of 1 with a reference known to 2 u: over from 6 u on, a pass up to 2 u, else undecided.
    let wide = || Ball::new(Float::with_val(128, 1.0), Mag::from_f64(2f64.powi(-52)));
    for (k, verdict) in [
        (0.0, Verdict::Pass),
        (1.9, Verdict::Pass),
        (4.0, Verdict::Undecided),
        (8.0, Verdict::Over),
    ] {
        let found = judged(
            1.0,
            Ball::new(
                Float::with_val(128, 1.0) + Float::with_val(128, k * 2f64.powi(-53)),
                wide().rad(),
            ),
        );
        assert_eq!(found.verdict, verdict, "{k}");
        assert_eq!(found.reason.is_some(), verdict != Verdict::Pass);
        if verdict == Verdict::Undecided {
            assert!(
                found
                    .why()
                    .unwrap()
                    .contains("the reference cannot decide it")
            );
        } else if verdict == Verdict::Over {
            assert!(
                found
                    .why()
                    .unwrap()
                    .contains(" times its budget, expected at most 1")
            );
        }
    }
    // A component that is already as wrong keeps its reason.
    let tight = outputs(Limit::Ulps(1.0));
    let off = SolverAnswer::Values(vec![1.0 + 64.0 * f64::EPSILON]);
    let both = judge_with_norm(&tight, Some(&budget), &off, &exact(&[1.0]), None);
    assert!(both.why().unwrap().contains("64.000 times its budget"));
    // An infinity is no number of a norm.
    let lost = judge_with_norm(
        &o,
        Some(&budget),
        &SolverAnswer::Values(vec![f64::INFINITY, 1.0]),
        &exact(&[1.0, 1.0]),
        None,
    );
    assert!(lost.norm_of_budget.is_nan());
}

#[test]
fn normwise_limits_take_the_largest_with_its_condition() {
    // Of 1 and 4 with conditions 1 and 8 the scale is 12: 4 u of it are 48 u.
    let at = |k: f64| {
        let got = [1.0 + k * 2f64.powi(-53), 4.0];
        measured(&got, &[1.0, 4.0], Limit::Normwise(4.0), Some(&[1.0, 8.0])).verdict
    };
    assert_eq!((at(48.0), at(50.0)), (Verdict::Pass, Verdict::Over));
    // Another output's limit does not take the scale away.
    let mut mixed = outputs(Limit::Ulps(4.0));
    mixed.extend(outputs(Limit::OfNorm(1e-3)));
    let got = SolverAnswer::Values(vec![3.0, 4.0 + 4.9e-3]);
    let found = judge(&mixed, &got, &exact(&[3.0, 4.0]), None);
    assert_eq!(found.verdict, Verdict::Pass);
    let got = SolverAnswer::Values(vec![3.0, 4.0 + 5.1e-3]);
    assert_eq!(
        judge(&mixed, &got, &exact(&[3.0, 4.0]), None).verdict,
        Verdict::Over
    );
}

#[test]
fn a_bound_on_a_norm_from_below_is_below() {
    for k in 1..2000 {
        let x = Mag::from_f64(f64::from(k) * 0.37);
        let root = Squares::root_below(x, 1).to_f64();
        let expected = (f64::from(k) * 0.37).sqrt();
        assert!(root < expected && root > expected * (1.0 - 1e-11), "{k}");
    }
}

/// k roundings of subnormal numbers are allowed, no more, and none where nothing has a size.
#[test]
fn subnormal_roundings() {
    let tiny = f64::from_bits(1);
    let judged = |got: f64, expected: &Ball, limit: Limit, condition: f64| {
        let reference = ReferenceAnswer::bounded(vec![expected.clone()], "planted");
        let got = SolverAnswer::Values(vec![got]);
        judge(&outputs(limit), &got, &reference, Some(&[condition])).verdict
    };
    let expected = Ball::exact(128, 8.0 * tiny);
    for limit in [Limit::Conditioned(4.0), Limit::Normwise(4.0)] {
        let off = |k: f64| judged((8.0 + k) * tiny, &expected, limit, 8.0 * tiny);
        assert_eq!(off(2.0), Verdict::Pass);
        assert_eq!(off(-2.0), Verdict::Pass);
        assert_eq!(off(3.0), Verdict::Over);
        let zero = Ball::exact(128, 0.0);
        assert_eq!(judged(0.0, &zero, limit, 0.0), Verdict::Pass);
        assert_eq!(judged(tiny, &zero, limit, 0.0), Verdict::Over);
    }
}

#[test]
fn a_budget_is_finite_and_positive() {
    for k in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(!Limit::Ulps(k).is_sound(), "{k}");
        assert!(!Limit::RelativeOrAbsolute(1.0, k).is_sound(), "{k}");
        assert!(!Limit::RelativeOrAbsolute(k, 1.0).is_sound(), "{k}");
        assert!(std::panic::catch_unwind(|| NormBudget::new(k, "planted")).is_err());
        assert!(std::panic::catch_unwind(|| Budget::new(Limit::Relative(k), "planted")).is_err());
    }
    assert!(Limit::Ulps(1e-9).is_sound() && Limit::RelativeOrAbsolute(1.0, 5e-324).is_sound());
    let asks = |l: Limit| l.needs_conditions();
    assert!(asks(Limit::Conditioned(1.0)) && asks(Limit::Normwise(1.0)));
    assert!(!asks(Limit::Ulps(1.0)) && !asks(Limit::OfNorm(1.0)) && !asks(Limit::Absolute(1.0)));
    assert_eq!(NormBudget::new(4.0, "").to_string(), "4 u of the norm");
    // In single precision u is 2^-24.
    let shown = |k: f64| NormBudget::new(k, "").shown(Format::Single);
    assert_eq!(shown(4.0), "4 u of the norm");
    assert_eq!(shown(1e-6 * 2f64.powi(24)), "1.000e-6 of the norm");
    assert_eq!(
        NormBudget::new(999_999.0, "").to_string(),
        "999999 u of the norm"
    );
    assert_eq!(
        NormBudget::new(1e6, "").to_string(),
        "1.110e-10 of the norm"
    );
    assert_eq!(
        NormBudget::new(4.5, "").to_string(),
        "4.996e-16 of the norm"
    );
}

/// An error that is at least what is allowed, and no more than that for certain, is undecided.
#[test]
fn a_norm_at_its_budget_is_undecided() {
    let one = Mag::from_f64(1.0);
    let mut squares = norm::Squares::default();
    squares.add(Some(one), one.shift(-50), one.shift(-49));
    let norms = squares.norms(Format::Double);
    let least = norm::Squares::root_below(one.shift(-50).mul(one.shift(-50)), 1);
    let allowed = |factor: f64| Mag::from_f64(factor).mul(norms.0).shift(-53);
    let mut near = (-64..64).map(|k| 8.0 + f64::from(k) * 2f64.powi(-50));
    let at = near
        .find(|f| allowed(*f) == least)
        .expect("a budget at the bound");
    for (factor, expected) in [
        (at.next_down().next_down(), Verdict::Over),
        (at, Verdict::Undecided),
        (at.next_up(), Verdict::Undecided),
    ] {
        let budget = NormBudget::new(factor, "planted");
        assert_eq!(
            squares.verdict(norms, &budget, Format::Double).0,
            expected,
            "{factor}"
        );
    }
}

/// Up to ten thousand in full, from there on as a power of ten.
#[test]
fn multiples_of_a_budget_are_shown() {
    for (x, expected) in [
        (1e4f64.next_down(), "10000.000"),
        (1e4, "1.00e4"),
        (f64::INFINITY, "more than 1e308"),
    ] {
        let fault = Fault::Over(x);
        let value = Reason::Value {
            output: "x",
            number: 0,
            got: 1e300,
            expected: -0.25,
            fault,
        };
        assert_eq!(
            value.to_string(),
            format!("x (value 0) is 1e300, expected -2.5e-1: {expected} times its budget off")
        );
    }
}

/// Whatever is wrong, the reason says what came and what was expected, and no number is long.
#[test]
fn reasons_say_what_was_expected() {
    let numbers = |values: &[f64]| {
        let expected = values.iter().map(|x| Expected::Number(Ball::exact(64, *x)));
        ReferenceAnswer::Expected(expected.collect(), Proof::Exact)
    };
    let given = |values: &[f64]| SolverAnswer::Values(values.to_vec());
    let refusal = |word: &str| SolverAnswer::Declines(Some(word.into()));
    let nan = || ReferenceAnswer::Expected(vec![Expected::NotANumber], Proof::Exact);
    let infinity =
        || ReferenceAnswer::Expected(vec![Expected::Infinity { negative: true }], Proof::Exact);
    let singular = || ReferenceAnswer::Refuses("singular");
    for (answer, reference, expected) in [
        (
            given(&[f64::NAN]),
            numbers(&[0.25]),
            "x (value 0) is NaN, expected 2.5e-1",
        ),
        (given(&[1e300]), nan(), "x (value 0) is 1e300, expected NaN"),
        (
            given(&[-1e300]),
            infinity(),
            "x (value 0) is -1e300, expected -inf",
        ),
        (
            given(&[1.0]),
            numbers(&[1.0, 2.0]),
            "1 value, expected 2 values",
        ),
        (
            given(&[1e300]),
            singular(),
            "1e300, expected the refusal \"singular\"",
        ),
        (
            given(&[1.0; 7]),
            singular(),
            "7 values, expected the refusal \"singular\"",
        ),
        (
            refusal("overflow"),
            singular(),
            "the refusal \"overflow\", expected the refusal \"singular\"",
        ),
        (
            refusal("overflow"),
            numbers(&[1e300, 0.5]),
            "the refusal \"overflow\", expected 1e300, 5e-1",
        ),
        (
            SolverAnswer::Declines(None),
            numbers(&[1.0; 9]),
            "a refusal, expected 9 values",
        ),
        (
            SolverAnswer::Fails("\"x\" is no number".into()),
            numbers(&[0.5]),
            "\"x\" is no number, expected 5e-1",
        ),
        (
            SolverAnswer::Unanswered("no line in 5 s".into()),
            numbers(&[0.5]),
            "no line in 5 s, expected 5e-1",
        ),
    ] {
        let o = outputs(Limit::Ulps(4.0));
        let found = judge(&o, &answer, &reference, None);
        assert_eq!(found.why().as_deref(), Some(expected));
    }
}
