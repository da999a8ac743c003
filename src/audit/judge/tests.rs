//! Planted faults.

use super::*;
use crate::{Budget, Proof, Reference};
use rug::Float;

mod edges;
mod errors;

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
    let one = |radius| {
        let ball = Ball::new(Float::with_val(64, 1.0), radius);
        ReferenceAnswer::bounded(vec![ball], "planted")
    };
    let got = SolverAnswer::Values(vec![1.0]);
    let failed = || ReferenceAnswer::Failed("planted".into());
    for (got, reference, verdict) in [
        (&got, one(Mag::INFINITY), Verdict::Undecided),
        (&got, one(Mag::from_f64(1e-15)), Verdict::Undecided),
        (
            &got,
            ReferenceAnswer::Undecided("planted".into()),
            Verdict::Undecided,
        ),
        (&got, failed(), Verdict::OracleError),
        (
            &SolverAnswer::Refuses("singular"),
            failed(),
            Verdict::OracleError,
        ),
    ] {
        let found = judge(&outputs(Limit::Ulps(4.0)), got, &reference, None);
        assert_eq!(found.verdict, verdict, "{reference:?}");
    }
}

#[test]
fn refusals_have_to_match() {
    let refuses = SolverAnswer::Refuses;
    let singular = || ReferenceAnswer::Refuses("singular");
    let value = SolverAnswer::Values(vec![1.0]);
    for (got, reference, verdict) in [
        (refuses("singular"), singular(), Verdict::Pass),
        (refuses("not finite"), singular(), Verdict::WrongKind),
        (refuses("singular"), exact(&[1.0]), Verdict::WrongKind),
        (value, singular(), Verdict::WrongKind),
    ] {
        let found = judge(&outputs(Limit::Ulps(4.0)), &got, &reference, None);
        assert_eq!(found.verdict, verdict, "{got:?} {reference:?}");
    }
}

fn judgement(got: f64, expected: Expected) -> Judgement {
    let answer = SolverAnswer::Values(vec![got]);
    let reference = ReferenceAnswer::Expected(vec![expected], Proof::Exact);
    judge(&outputs(Limit::Ulps(4.0)), &answer, &reference, None)
}

fn judged(got: f64, expected: Expected) -> Verdict {
    judgement(got, expected).verdict
}

/// `sign · (largest f64 + k ulps)` ± a radius of 2⁻⁶⁰ ulp or the one given.
fn edge(k: f64, radius: Mag) -> Expected {
    let mid = Float::with_val(200, f64::MAX) + (Float::with_val(200, k) << 971i32);
    Expected::Number(Ball::new(mid, radius))
}

/// Where no number is expected, a wrong value has its kind in its place, and a right one has none.
#[test]
fn an_infinity_or_nan_that_is_due_passes_alone() {
    let (inf, nan) = (f64::INFINITY, f64::NAN);
    let plus = || Expected::Infinity { negative: false };
    let minus = || Expected::Infinity { negative: true };
    let number = || Expected::Number(Ball::integer(64, 1));
    for (got, expected, kind) in [
        (inf, plus(), None),
        (-inf, plus(), Some(Kind::Infinity)),
        (-inf, minus(), None),
        (inf, minus(), Some(Kind::Infinity)),
        (nan, plus(), Some(Kind::Nan)),
        (nan, minus(), Some(Kind::Nan)),
        (f64::MAX, plus(), Some(Kind::Finite)),
        (0.0, minus(), Some(Kind::Finite)),
        (nan, Expected::NotANumber, None),
        (-nan, Expected::NotANumber, None),
        (inf, Expected::NotANumber, Some(Kind::Infinity)),
        (0.0, Expected::NotANumber, Some(Kind::Finite)),
        (1.0, number(), None),
        (nan, number(), Some(Kind::Nan)),
        (inf, number(), Some(Kind::Infinity)),
        (-inf, number(), Some(Kind::Infinity)),
    ] {
        let shown = format!("{got} for {expected:?}");
        let no_number = expected.number().is_none();
        let found = judgement(got, expected);
        let (verdict, share) = match kind {
            None => (Verdict::Pass, 0.0),
            Some(_) => (Verdict::WrongKind, f64::INFINITY),
        };
        let c = &found.components[0];
        assert_eq!((found.verdict, found.kind), (verdict, kind), "{shown}");
        assert_eq!((c.kind, c.of_budget), (kind, share), "{shown}");
        let measures = [c.ulps, c.conditioned, c.condition];
        assert!(!no_number || measures.iter().all(|x| x.is_nan()), "{shown}");
    }
}

#[test]
fn a_zero_with_a_sign_is_not_the_other_zero() {
    for (got, expected, verdict) in [
        (0.0, Expected::zero(false), Verdict::Pass),
        (-0.0, Expected::zero(true), Verdict::Pass),
        (-0.0, Expected::zero(false), Verdict::WrongKind),
        (0.0, Expected::zero(true), Verdict::WrongKind),
        (1e-300, Expected::zero(false), Verdict::Over),
        (f64::NAN, Expected::zero(true), Verdict::WrongKind),
        // A zero that is due as a number alone has no sign.
        (-0.0, Expected::Number(Ball::integer(64, 0)), Verdict::Pass),
    ] {
        let shown = format!("{got:?} for {expected:?}");
        assert_eq!(judged(got, expected), verdict, "{shown}");
    }
    // Only an exact zero takes a sign.
    let signed = Expected::Number(Ball::integer(64, 0)).signed(Some(true));
    assert!(matches!(signed, Expected::Zero { negative: true, .. }));
    let signed = Expected::Number(Ball::integer(64, 1)).signed(Some(true));
    assert!(matches!(signed, Expected::Number(_)));
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
        let Expected::Number(b) = edge(k, sharp) else {
            unreachable!()
        };
        assert_eq!(
            judged(-got, Expected::Number(-b)),
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
    let tiny = |k: i64| Expected::Number(Ball::new(Float::new(64), Mag::power_of_two(k)));
    assert_eq!(judged(0.0, tiny(-2000)), Verdict::Pass);
    assert_eq!(judged(-0.0, tiny(-2000)), Verdict::Pass);
    assert_eq!(judged(f64::from_bits(5), tiny(-2000)), Verdict::Over);
    assert_eq!(judged(f64::MIN_POSITIVE, tiny(-2000)), Verdict::Over);
    assert_eq!(judged(f64::NAN, tiny(-2000)), Verdict::WrongKind);
    assert_eq!(judged(0.0, tiny(-1000)), Verdict::Undecided);
    // Five of the smallest numbers are not zero.
    let five = Expected::Number(Ball::exact(64, f64::from_bits(5)));
    assert_eq!(judged(0.0, five.clone()), Verdict::Over);
    assert_eq!(judged(f64::from_bits(4), five), Verdict::Pass);
}

fn in_the_norm(got: [f64; 2], expected: [f64; 2], factor: f64) -> Verdict {
    let outputs = outputs(Limit::Ulps(1e300));
    let norm = NormBudget::new(factor, "planted");
    let answer = SolverAnswer::Values(got.to_vec());
    judge_with_norm(&outputs, Some(&norm), &answer, &exact(&expected), None).verdict
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
}

#[test]
fn single_precision_has_ulps_of_its_own() {
    let o = outputs(Limit::Ulps(1.0));
    let rules = Rules {
        outputs: &o,
        norm: None,
        format: Format::Single,
    };
    let one = |got: f64, expected: f64| {
        judge_by(
            &rules,
            &SolverAnswer::Values(vec![got]),
            &exact(&[expected]),
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
