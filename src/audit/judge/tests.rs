//! Planted faults.

use super::*;
use crate::{Budget, Proof, Reference};
use rug::Float;

fn outputs(limit: Limit) -> Vec<Output> {
    vec![Output {
        name: "x",
        unit: "1",
        budget: Budget::new(limit, "planted"),
    }]
}

fn truth() -> Vec<f64> {
    vec![1.25, -3.0e-5, 7.0e8]
}

fn exact(values: &[f64]) -> ReferenceAnswer {
    ReferenceAnswer::Values(Reference {
        values: values.iter().map(|&x| Ball::exact(128, x)).collect(),
        proof: Proof::Exact,
    })
}

fn verdict(got: Vec<f64>, limit: Limit) -> Verdict {
    let c = [1.25, 3.0e-5, 7.0e8];
    judge(
        &outputs(limit),
        &SolverAnswer::Values(got),
        &exact(&truth()),
        Some(&c),
    )
    .verdict
}

const LIMITS: [Limit; 3] = [
    Limit::Ulps(4.0),
    Limit::Conditioned(4.0),
    Limit::Normwise(4.0),
];

#[test]
fn the_truth_passes() {
    for limit in LIMITS {
        assert_eq!(verdict(truth(), limit), Verdict::Pass);
    }
}

#[test]
fn planted_faults_fail_under_every_limit() {
    for limit in LIMITS {
        for (fault, verdict_due) in [
            (f64::NAN, Verdict::WrongKind),
            (f64::INFINITY, Verdict::WrongKind),
            (f64::NEG_INFINITY, Verdict::WrongKind),
        ] {
            for i in 0..3 {
                let mut got = truth();
                got[i] = fault;
                assert_eq!(verdict(got, limit), verdict_due);
            }
        }
        let mut swapped = truth();
        swapped.swap(0, 2);
        assert_eq!(verdict(swapped, limit), Verdict::Over);
        let mut sign = truth();
        sign[2] = -sign[2];
        assert_eq!(verdict(sign, limit), Verdict::Over);
        assert_eq!(verdict(truth()[..2].to_vec(), limit), Verdict::WrongKind);
        assert_eq!(verdict(vec![], limit), Verdict::WrongKind);
    }
    // A wrong sign on the small value is lost in a norm, and only there.
    let mut sign = truth();
    sign[1] = -sign[1];
    assert_eq!(verdict(sign.clone(), Limit::Ulps(4.0)), Verdict::Over);
    assert_eq!(verdict(sign, Limit::Conditioned(4.0)), Verdict::Over);
}

#[test]
fn one_ulp_over_the_budget_fails() {
    let shifted = |k: u64| vec![f64::from_bits(1.25f64.to_bits() + k), -3.0e-5, 7.0e8];
    assert_eq!(verdict(shifted(4), Limit::Ulps(4.0)), Verdict::Pass);
    assert_eq!(verdict(shifted(5), Limit::Ulps(4.0)), Verdict::Over);
    // 1.25 + cond 1.25 is 2.5, and 2^-53 · 2.5 is 1.25 ulps of 1.25.
    assert_eq!(verdict(shifted(5), Limit::Conditioned(4.0)), Verdict::Pass);
    assert_eq!(verdict(shifted(6), Limit::Conditioned(4.0)), Verdict::Over);
}

#[test]
fn a_reference_that_proves_nothing_passes_nothing() {
    let o = outputs(Limit::Ulps(4.0));
    let got = SolverAnswer::Values(vec![1.0]);
    let infinite = ReferenceAnswer::Values(Reference {
        values: vec![Ball::new(Float::with_val(64, 1.0), Mag::INFINITY)],
        proof: Proof::Exact,
    });
    assert_eq!(judge(&o, &got, &infinite, None).verdict, Verdict::Undecided);
    let coarse = ReferenceAnswer::Values(Reference {
        values: vec![Ball::new(Float::with_val(64, 1.0), Mag::from_f64(1e-15))],
        proof: Proof::Exact,
    });
    assert_eq!(judge(&o, &got, &coarse, None).verdict, Verdict::Undecided);
    let undecided = ReferenceAnswer::Undecided("planted".into());
    assert_eq!(
        judge(&o, &got, &undecided, None).verdict,
        Verdict::Undecided
    );
    let failed = ReferenceAnswer::Failed("planted".into());
    assert_eq!(judge(&o, &got, &failed, None).verdict, Verdict::OracleError);
    let refused = SolverAnswer::Refuses("singular");
    assert_eq!(
        judge(&o, &refused, &failed, None).verdict,
        Verdict::OracleError
    );
}

#[test]
fn refusals_have_to_match() {
    let o = outputs(Limit::Ulps(4.0));
    let singular = ReferenceAnswer::Refuses("singular");
    let refused = SolverAnswer::Refuses("singular");
    let other = SolverAnswer::Refuses("not finite");
    assert_eq!(judge(&o, &refused, &singular, None).verdict, Verdict::Pass);
    assert_eq!(
        judge(&o, &other, &singular, None).verdict,
        Verdict::WrongKind
    );
    assert_eq!(
        judge(&o, &refused, &exact(&[1.0]), None).verdict,
        Verdict::WrongKind
    );
    let value = SolverAnswer::Values(vec![1.0]);
    assert_eq!(
        judge(&o, &value, &singular, None).verdict,
        Verdict::WrongKind
    );
}

#[test]
fn missing_or_infinite_conditions_do_not_pass() {
    let o = outputs(Limit::Conditioned(4.0));
    let got = SolverAnswer::Values(vec![2.0]);
    let r = exact(&[1.0]);
    assert_eq!(judge(&o, &got, &r, None).verdict, Verdict::Undecided);
    assert_eq!(
        judge(&o, &got, &r, Some(&[f64::INFINITY])).verdict,
        Verdict::Undecided
    );
    assert_eq!(
        judge(&o, &got, &r, Some(&[f64::NAN])).verdict,
        Verdict::Undecided
    );
    assert_eq!(
        judge(&o, &got, &r, Some(&[1.0, 1.0])).verdict,
        Verdict::Undecided
    );
    assert_eq!(judge(&o, &got, &r, Some(&[1.0])).verdict, Verdict::Over);
}

fn judged(got: f64, due: Due) -> Verdict {
    let outputs = outputs(Limit::Ulps(4.0));
    let answer = SolverAnswer::Values(vec![got]);
    judge(
        &outputs,
        &answer,
        &ReferenceAnswer::Dues(vec![due], Proof::Exact),
        None,
    )
    .verdict
}

/// `sign · (largest f64 + k ulps)` ± a radius of 2⁻⁶⁰ ulp or the one given.
fn edge(k: f64, radius: Mag) -> Due {
    let mid = Float::with_val(200, f64::MAX) + (Float::with_val(200, k) << 971i32);
    Due::Number(Ball::new(mid, radius))
}

#[test]
fn an_infinity_or_nan_that_is_due_passes_alone() {
    let (inf, nan) = (f64::INFINITY, f64::NAN);
    let plus = || Due::Infinity { negative: false };
    let minus = || Due::Infinity { negative: true };
    let number = || Due::Number(Ball::integer(64, 1));
    for (got, due, verdict) in [
        (inf, plus(), Verdict::Pass),
        (-inf, plus(), Verdict::WrongKind),
        (-inf, minus(), Verdict::Pass),
        (inf, minus(), Verdict::WrongKind),
        (nan, plus(), Verdict::WrongKind),
        (nan, minus(), Verdict::WrongKind),
        (f64::MAX, plus(), Verdict::WrongKind),
        (0.0, minus(), Verdict::WrongKind),
        (nan, Due::NotANumber, Verdict::Pass),
        (-nan, Due::NotANumber, Verdict::Pass),
        (inf, Due::NotANumber, Verdict::WrongKind),
        (0.0, Due::NotANumber, Verdict::WrongKind),
        (1.0, number(), Verdict::Pass),
        (nan, number(), Verdict::WrongKind),
        (inf, number(), Verdict::WrongKind),
        (-inf, number(), Verdict::WrongKind),
    ] {
        let shown = format!("{got} for {due:?}");
        assert_eq!(judged(got, due), verdict, "{shown}");
    }
}

#[test]
fn a_zero_with_a_sign_is_not_the_other_zero() {
    for (got, due, verdict) in [
        (0.0, Due::zero(false), Verdict::Pass),
        (-0.0, Due::zero(true), Verdict::Pass),
        (-0.0, Due::zero(false), Verdict::WrongKind),
        (0.0, Due::zero(true), Verdict::WrongKind),
        (1e-300, Due::zero(false), Verdict::Over),
        (f64::NAN, Due::zero(true), Verdict::WrongKind),
        // A zero that is due as a number alone has no sign.
        (-0.0, Due::Number(Ball::integer(64, 0)), Verdict::Pass),
    ] {
        let shown = format!("{got:?} for {due:?}");
        assert_eq!(judged(got, due), verdict, "{shown}");
    }
    // Only an exact zero takes a sign.
    let signed = Due::Number(Ball::integer(64, 0)).signed(Some(true));
    assert!(matches!(signed, Due::Zero { negative: true, .. }));
    let signed = Due::Number(Ball::integer(64, 1)).signed(Some(true));
    assert!(matches!(signed, Due::Number(_)));
}

#[test]
fn overflow_begins_half_a_unit_beyond_the_largest_number() {
    let sharp = Mag::power_of_two(900);
    let (inf, max) = (f64::INFINITY, f64::MAX);
    for (got, k, verdict) in [
        // Beyond 4 ulps of the largest number only infinity is right …
        (inf, 10.0, Verdict::Pass),
        (-inf, 10.0, Verdict::WrongKind),
        (f64::NAN, 10.0, Verdict::WrongKind),
        (max, 10.0, Verdict::WrongKind),
        (max, 1e9, Verdict::WrongKind),
        // … within them the largest number is as good (its ulp is twice as large from 2^1024 on) …
        (inf, 0.5, Verdict::Pass),
        (max, 0.5, Verdict::Pass),
        (max, 1.0, Verdict::Pass),
        (max, 7.9, Verdict::Pass),
        (max, 8.1, Verdict::WrongKind),
        // … and infinity from 4 ulps below half a unit beyond it.
        (max, 0.25, Verdict::Pass),
        (inf, 0.25, Verdict::Pass),
        (inf, -3.4, Verdict::Pass),
        (inf, -3.6, Verdict::WrongKind),
        (-inf, -3.4, Verdict::WrongKind),
        (inf, -1e9, Verdict::WrongKind),
    ] {
        assert_eq!(
            judged(got, edge(k, sharp)),
            verdict,
            "{got} for max + {k} ulps"
        );
        // The same below zero.
        let Due::Number(b) = edge(k, sharp) else {
            unreachable!()
        };
        assert_eq!(
            judged(-got, Due::Number(-b)),
            verdict,
            "{} for −max − {k} ulps",
            -got
        );
    }
    // A ball that reaches over the border decides nothing there.
    let blunt = Mag::power_of_two(970);
    assert_eq!(judged(inf, edge(-3.5, blunt)), Verdict::Undecided);
    assert_eq!(judged(max, edge(8.0, blunt)), Verdict::Undecided);
    assert_eq!(judged(inf, edge(0.5, blunt)), Verdict::Pass);
}

#[test]
fn what_rounds_to_zero_may_be_zero() {
    let tiny = |k: i64| Due::Number(Ball::new(Float::new(64), Mag::power_of_two(k)));
    assert_eq!(judged(0.0, tiny(-2000)), Verdict::Pass);
    assert_eq!(judged(-0.0, tiny(-2000)), Verdict::Pass);
    assert_eq!(judged(f64::from_bits(5), tiny(-2000)), Verdict::Over);
    assert_eq!(judged(f64::MIN_POSITIVE, tiny(-2000)), Verdict::Over);
    assert_eq!(judged(f64::NAN, tiny(-2000)), Verdict::WrongKind);
    assert_eq!(judged(0.0, tiny(-1000)), Verdict::Undecided);
    // Five of the smallest numbers are not zero.
    let five = Due::Number(Ball::exact(64, f64::from_bits(5)));
    assert_eq!(judged(0.0, five.clone()), Verdict::Over);
    assert_eq!(judged(f64::from_bits(4), five), Verdict::Pass);
}

fn in_the_norm(got: [f64; 2], due: [f64; 2], factor: f64) -> Verdict {
    let outputs = outputs(Limit::Ulps(1e300));
    let norm = NormBudget::new(factor, "planted");
    let answer = SolverAnswer::Values(got.to_vec());
    judge_with_norm(&outputs, Some(&norm), &answer, &exact(&due), None).verdict
}

#[test]
fn the_norm_has_a_budget_of_its_own() {
    let e = f64::EPSILON;
    // The error of (3 + 3i) · 2u against |1| = 1: √18 = 4.24 ε = 8.5 u.
    let got = [1.0 + 3.0 * e, 1e-9 + 3.0 * e];
    assert_eq!(in_the_norm(got, [1.0, 1e-9], 8.6), Verdict::Pass);
    assert_eq!(in_the_norm(got, [1.0, 1e-9], 8.4), Verdict::Over);
    assert_eq!(
        in_the_norm([1.0, 1e-9 + 1e-16], [1.0, 1e-9], 2.0),
        Verdict::Pass
    );
    assert_eq!(in_the_norm([0.0, 1.0], [1.0, 0.0], 4.0), Verdict::Over);
    // The components' own faults stay.
    assert_eq!(
        in_the_norm([f64::NAN, 1.0], [1.0, 0.0], 1e9),
        Verdict::WrongKind
    );
    // In the subnormal range the smallest normal number counts instead.
    let s = f64::from_bits;
    assert_eq!(
        in_the_norm([s(12), s(9)], [s(10), s(9)], 4.0),
        Verdict::Pass
    );
    assert_eq!(
        in_the_norm([s(13), s(9)], [s(10), s(9)], 4.0),
        Verdict::Over
    );
    assert_eq!(in_the_norm([0.0, 0.0], [0.0, 0.0], 4.0), Verdict::Pass);
    assert_eq!(in_the_norm([s(3), 0.0], [0.0, 0.0], 4.0), Verdict::Over);
}

#[test]
fn limits_of_ones_own() {
    for (limit, passes, fails) in [
        (
            Limit::Relative(1e-6),
            1.25 * (1.0 + 0.9e-6),
            1.25 * (1.0 + 1.1e-6),
        ),
        (Limit::Absolute(1e-3), 1.2509, 1.2511),
        (Limit::RelativeOrAbsolute(1e-6, 1e-3), 1.2509, 1.2511),
        (Limit::RelativeOrAbsolute(1e-2, 1e-9), 1.2624, 1.2626),
        // The norm is that of 7e8.
        (Limit::OfNorm(1e-9), 1.25 + 0.69, 1.25 + 0.71),
    ] {
        let got = |x: f64| vec![x, -3.0e-5, 7.0e8];
        assert_eq!(verdict(got(passes), limit), Verdict::Pass, "{limit}");
        assert_eq!(verdict(got(fails), limit), Verdict::Over, "{limit}");
        assert_eq!(verdict(got(f64::NAN), limit), Verdict::WrongKind);
    }
    // A rounding of the smallest numbers is no relative error that anybody could avoid.
    let third = ReferenceAnswer::Values(Reference {
        values: vec![Ball::new(Float::with_val(64, 1.4) << -1074i32, Mag::ZERO)],
        proof: Proof::Exact,
    });
    let o = outputs(Limit::Relative(1e-12));
    let nearest = SolverAnswer::Values(vec![5e-324]);
    assert_eq!(judge(&o, &nearest, &third, None).verdict, Verdict::Pass);
    let zero = SolverAnswer::Values(vec![0.0]);
    assert_eq!(judge(&o, &zero, &third, None).verdict, Verdict::Over);
}

#[test]
fn single_precision_has_ulps_of_its_own() {
    let o = outputs(Limit::Ulps(1.0));
    let rules = Rules {
        outputs: &o,
        norm: None,
        format: Format::Single,
    };
    let one = |got: f64, due: f64| {
        judge_by(
            &rules,
            &SolverAnswer::Values(vec![got]),
            &exact(&[due]),
            None,
        )
    };
    let ulp = 2f64.powi(-23);
    assert_eq!(one(1.0 + ulp, 1.0).verdict, Verdict::Pass);
    let over = one(1.0 + 2.0 * ulp, 1.0);
    assert_eq!(
        (over.verdict, over.components[0].ulps),
        (Verdict::Over, 2.0)
    );
    assert!((over.normwise - 4.0).abs() < 1e-9);
    // Infinite beyond the largest f32, and not before.
    assert_eq!(one(f64::INFINITY, 3.5e38).verdict, Verdict::Pass);
    let early = one(f64::INFINITY, 3.0e38);
    assert_eq!(
        (early.verdict, early.kind),
        (Verdict::WrongKind, Some(Kind::Infinity))
    );
    let late = one(f64::from(f32::MAX), 1e39);
    assert_eq!(
        (late.verdict, late.kind),
        (Verdict::WrongKind, Some(Kind::Finite))
    );
}

#[test]
fn a_norm_has_a_share_of_its_budget() {
    let norm = NormBudget::new(4.0, "planted");
    let o = outputs(Limit::Relative(1.0));
    let got = SolverAnswer::Values(vec![3.0, 4.0 + 8.0 * 2f64.powi(-51)]);
    let found = judge_with_norm(&o, Some(&norm), &got, &exact(&[3.0, 4.0]), None);
    // 8 · 2⁻⁵¹ of 5 is 6.4 u, 1.6 times the budget.
    assert!((found.norm_of_budget - 1.6).abs() < 1e-9, "{found:?}");
    assert_eq!((found.verdict, found.kind), (Verdict::Over, None));
    assert!((found.share() - 1.6).abs() < 1e-9);
}

fn measured(got: &[f64], due: &[f64], limit: Limit, conditions: Option<&[f64]>) -> Judgement {
    let answer = SolverAnswer::Values(got.to_vec());
    judge(&outputs(limit), &answer, &exact(due), conditions)
}

/// `1 + k u` in units of u = 2^-53, where one is 2u wide above and u below.
fn near_one(k: f64) -> f64 {
    1.0 + k * 2f64.powi(-53)
}

#[test]
fn what_is_wrong_is_said() {
    let due = |d: Due| ReferenceAnswer::Dues(vec![d], Proof::Exact);
    let o = outputs(Limit::Ulps(4.0));
    let said = |got: f64, d: Due| judge(&o, &SolverAnswer::Values(vec![got]), &due(d), None);
    let zero = said(-0.0, Due::zero(false));
    assert_eq!(
        zero.reason.as_deref(),
        Some("x (value 0) is -0.0 where 0.0 is due")
    );
    assert_eq!(
        (zero.kind, zero.components[0].kind),
        (Some(Kind::WrongZero), Some(Kind::WrongZero))
    );
    let nan = said(f64::NAN, Due::zero(false));
    assert_eq!(nan.reason.as_deref(), Some("x (value 0) is NaN"));
    assert_eq!(nan.kind, Some(Kind::Nan));
    let number = |x: f64| Due::Number(Ball::exact(64, x));
    assert_eq!(said(f64::INFINITY, number(1.0)).kind, Some(Kind::Infinity));
    let over = said(1.0 + 8.0 * f64::EPSILON, number(1.0));
    assert_eq!((over.kind, over.components[0].kind), (None, None));
    assert_eq!(
        over.reason.as_deref(),
        Some("x (value 0) is 2.000 times its budget off")
    );
    let far = |times: f64| {
        said(1.0 + 4.0 * times * f64::EPSILON, number(1.0))
            .reason
            .unwrap()
    };
    assert!(far(9999.0).contains("9999.000 times"), "{}", far(9999.0));
    assert!(far(1e4).contains("1.00e4 times"), "{}", far(1e4));
    let beyond = said(f64::MAX, number(5e-324)).reason.unwrap();
    assert!(beyond.contains("more than 1e308 times"), "{beyond}");
    // The first of two equally wrong values is named.
    let first = measured(&[2.0, 7.0], &[1.0, 1.0], Limit::Ulps(4.0), None);
    assert!(first.reason.unwrap().starts_with("x (value 0) is "));
    let lost = measured(
        &[f64::NAN, f64::INFINITY],
        &[1.0, 1.0],
        Limit::Ulps(4.0),
        None,
    );
    assert_eq!(lost.kind, Some(Kind::Nan));
    // No infinity that is due has a share but none or all of its budget.
    let infinity = said(f64::INFINITY, Due::Infinity { negative: false });
    assert_eq!(
        (infinity.components[0].of_budget, infinity.share()),
        (0.0, 0.0)
    );
    let other = said(f64::NEG_INFINITY, Due::Infinity { negative: false });
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
    let dues = vec![
        Due::Number(Ball::integer(64, 1)),
        Due::Infinity { negative: false },
    ];
    let dues = ReferenceAnswer::Dues(dues, Proof::Exact);
    let got = SolverAnswer::Values(vec![1.0, f64::INFINITY]);
    let budget = NormBudget::new(4.0, "planted");
    let mixed = judge_with_norm(&outputs(Limit::Ulps(1.0)), Some(&budget), &got, &dues, None);
    assert!(mixed.normwise.is_nan() && mixed.norm_of_budget.is_nan());
    assert_eq!(mixed.verdict, Verdict::Pass);
}

#[test]
fn a_norm_s_budget_is_for_numbers_and_decided_by_bounds() {
    let budget = NormBudget::new(4.0, "planted");
    let o = outputs(Limit::Absolute(1e300));
    let judged = |got: f64, due: Ball| {
        let reference = ReferenceAnswer::Values(Reference {
            values: vec![due],
            proof: Proof::Exact,
        });
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
            assert!(found.reason.unwrap().contains("cannot be decided"));
        } else if verdict == Verdict::Over {
            assert!(found.reason.unwrap().contains("over its budget"));
        }
    }
    // A component that is already as wrong keeps its reason.
    let tight = outputs(Limit::Ulps(1.0));
    let off = SolverAnswer::Values(vec![1.0 + 64.0 * f64::EPSILON]);
    let both = judge_with_norm(&tight, Some(&budget), &off, &exact(&[1.0]), None);
    assert!(both.reason.unwrap().contains("64.000 times its budget"));
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
fn roundings_of_the_smallest_numbers_are_free_under_every_relative_limit() {
    let due = ReferenceAnswer::Values(Reference {
        values: vec![Ball::new(Float::with_val(64, 1.5) << -1074i32, Mag::ZERO)],
        proof: Proof::Exact,
    });
    for limit in [
        Limit::Relative(1e-12),
        Limit::RelativeOrAbsolute(1e-12, 5e-324),
        Limit::OfNorm(1e-12),
    ] {
        for (bits, verdict) in [
            (1, Verdict::Pass),
            (2, Verdict::Pass),
            (3, Verdict::Over),
            (0, Verdict::Over),
        ] {
            let got = SolverAnswer::Values(vec![f64::from_bits(bits)]);
            let found = judge(&outputs(limit), &got, &due, None);
            assert_eq!(found.verdict, verdict, "{limit} {bits}");
        }
    }
}

#[test]
fn a_bound_on_a_norm_from_below_is_below() {
    for k in 1..2000 {
        let x = Mag::from_f64(f64::from(k) * 0.37);
        let root = Squares::root_below(x).to_f64();
        let due = (f64::from(k) * 0.37).sqrt();
        assert!(root < due && root > due * (1.0 - 1e-11), "{k}");
    }
}

/// k roundings of subnormal numbers are allowed, no more, and none where nothing has a size.
#[test]
fn subnormal_roundings() {
    let tiny = 2f64.powi(-1074);
    let judged = |got: f64, due: &Ball, limit: Limit, condition: f64| {
        let reference = ReferenceAnswer::Values(Reference {
            values: vec![due.clone()],
            proof: Proof::Exact,
        });
        let got = SolverAnswer::Values(vec![got]);
        judge(&outputs(limit), &got, &reference, Some(&[condition])).verdict
    };
    let due = Ball::exact(128, 8.0 * tiny);
    for limit in [Limit::Conditioned(4.0), Limit::Normwise(4.0)] {
        let off = |k: f64| judged((8.0 + k) * tiny, &due, limit, 8.0 * tiny);
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
    assert_eq!(
        NormBudget::new(1e6, "").to_string(),
        "1.110e-10 of the norm"
    );
    assert_eq!(
        NormBudget::new(4.5, "").to_string(),
        "4.996e-16 of the norm"
    );
}
