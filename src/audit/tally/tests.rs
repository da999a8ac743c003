//! Planted answers in tallies: each statistic, each wrong kind, in any order.

use super::*;
use crate::answer::{Proof, Reference, ReferenceAnswer, SolverAnswer};
use crate::case::Origin;
use crate::judged::judge_case_briefly;
use crate::kind::{Kind, Kinds};
use crate::{Budget, CheckPoint, Domain, Input, Law, Limit, Output, Region};
use mechaudit_reference::Ball;
use proptest::prelude::*;
use rug::Rational;

/// `x` and `2x`; refuses where x is negative.
struct Twice;

impl Method for Twice {
    fn name(&self) -> &'static str {
        "twice"
    }
    fn summary(&self) -> &'static str {
        "x and 2x"
    }
    fn source(&self) -> &'static str {
        "planted"
    }
    fn inputs(&self) -> Vec<Input> {
        vec![Input {
            name: "x",
            unit: "1",
        }]
    }
    fn outputs(&self) -> Vec<Output> {
        ["one", "two"]
            .map(|name| Output {
                name,
                unit: "1",
                budget: Budget::new(Limit::Ulps(4.0), "planted"),
            })
            .to_vec()
    }
    fn domain(&self) -> Domain {
        let region = |name, sample| Region {
            name,
            description: "planted",
            sample,
        };
        Domain {
            regions: vec![
                region("small", |d| vec![d.uniform(1.0, 2.0)]),
                region("large", |d| vec![d.log_uniform(1e200, 1e300)]),
            ],
            check_points: vec![CheckPoint {
                name: "one",
                input: vec![1.0],
            }],
        }
    }
    fn solve(&self, x: &[f64]) -> SolverAnswer {
        match x[0] < 0.0 {
            true => SolverAnswer::Refuses("negative"),
            false => SolverAnswer::Values(vec![x[0], 2.0 * x[0]]),
        }
    }
    fn reference(&self, x: &[Rational], bits: u32) -> ReferenceAnswer {
        if x[0] < 0 {
            return ReferenceAnswer::Refuses("negative");
        }
        let twice = Rational::from(&x[0] * 2u32);
        ReferenceAnswer::Values(Reference {
            values: vec![Ball::rational(bits, &x[0]), Ball::rational(bits, &twice)],
            proof: Proof::Exact,
        })
    }
    fn conditions(&self, _: &[f64]) -> Option<Vec<f64>> {
        None
    }
    fn laws(&self) -> Vec<Law> {
        Vec::new()
    }
}

fn case(region: &'static str, index: u64, x: f64) -> Case {
    Case {
        method: "twice",
        region,
        input: vec![x],
        origin: Origin::Random { seed: 1, index },
    }
}

fn judged(region: &'static str, index: u64, x: f64, answer: SolverAnswer) -> CaseReport {
    judge_case_briefly(&Twice, case(region, index, x), answer, &Settings::default())
}

/// `x` so many ulps off, `2x` right.
fn off(region: &'static str, index: u64, ulps: u64) -> CaseReport {
    let x = 1.0 + index as f64 * 2f64.powi(-20);
    let got = f64::from_bits(x.to_bits() + ulps);
    judged(region, index, x, SolverAnswer::Values(vec![got, 2.0 * x]))
}

fn report(all: &[CaseReport]) -> MethodReport {
    let mut tally = Tally::new(&Twice, &Settings::default());
    all.iter().for_each(|r| tally.add(r));
    tally.finish(&Twice)
}

#[test]
fn each_wrong_kind_is_counted_apart_and_in_no_statistic() {
    use SolverAnswer as A;
    let nan = f64::NAN;
    let planted = [
        (1.0, A::Values(vec![nan, 2.0]), Kind::Nan),
        (1.5, A::Values(vec![1.5, f64::INFINITY]), Kind::Infinity),
        (f64::MAX, A::Values(vec![f64::MAX, 1.0]), Kind::Finite),
        (1.0, A::Refuses("negative"), Kind::Refusal),
        (-1.0, A::Values(vec![-1.0, -2.0]), Kind::Value),
        (-1.0, A::Declines(Some("other".into())), Kind::Refusal),
        (1.0, A::Values(vec![1.0]), Kind::Missing),
        (1.0, A::Fails("planted".into()), Kind::Unreadable),
        (1.0, A::Unanswered("planted".into()), Kind::Unanswered),
    ];
    let mut all = vec![off("small", 100, 2), off("small", 101, 0)];
    let mut due = Kinds::default();
    for (i, (x, answer, kind)) in planted.into_iter().enumerate() {
        let report = judged("small", i as u64, x, answer);
        assert_eq!(report.judgement.kind, Some(kind), "{report:?}");
        due[kind] += 1;
        all.push(report);
    }
    let r = report(&all);
    assert_eq!((r.cases, r.passed, r.total.kinds), (11, 2, due));
    let one = &r.outputs()[0];
    assert_eq!((one.kinds[Kind::Nan], one.kinds.total()), (1, 1));
    // Numbers beside the wrong ones are judged; the wrong ones leave no trace.
    assert_eq!((one.values, one.ulps.count, one.ulps.max), (5, 4, 2.0));
    assert!((one.max_of_budget - 0.5).abs() < 1e-9);
    assert_eq!(r.outputs()[1].kinds[Kind::Infinity], 1);
    assert_eq!(r.outputs()[1].kinds[Kind::Finite], 1);
    // Two measured cases have a norm.
    assert_eq!(r.total.normwise.unwrap().count, 2);
    // An example of each.
    let kinds: Vec<Option<Kind>> = r.wrong.iter().map(|c| c.judgement.kind).collect();
    for kind in due.some().map(|k| k.0) {
        assert!(kinds.contains(&Some(kind)), "{kind:?}");
    }
    assert_eq!(r.failures.len(), 9);
}

#[test]
fn statistics_are_those_of_the_planted_errors() {
    let all: Vec<CaseReport> = (0..100).map(|i| off("small", i, i % 10)).collect();
    let r = report(&all);
    let s = r.outputs()[0].ulps;
    // 0 to 9 ulps, ten times each.
    assert_eq!((s.count, s.max), (100, 9.0));
    assert!((9.0..9.01).contains(&s.p99) && (4.0..4.01).contains(&s.median));
    assert_eq!(s.rms, 28.5f64.sqrt());
    assert_eq!((r.total.over, r.passed), (50, 50));
    let norm = r.total.normwise.unwrap();
    let x = 1.0 + 99.0 * 2f64.powi(-20);
    let due = 9.0 * 2.0 / (5f64.sqrt() * x);
    assert!((norm.max / due - 1.0).abs() < 1e-3, "{norm:?} {due}");
    let octaves: Vec<(Option<i32>, u64)> = r.outputs()[0]
        .histogram
        .iter()
        .map(|o| (o.exponent, o.count))
        .collect();
    let due = [
        (None, 10),
        (Some(0), 10),
        (Some(1), 20),
        (Some(2), 40),
        (Some(3), 20),
    ];
    assert_eq!(octaves, due);
    // The first of those with the largest error of the octave.
    let top = &r.outputs()[0].histogram[4].worst;
    assert_eq!(top.origin, Origin::Random { seed: 1, index: 9 });
}

#[test]
fn the_worst_of_each_region_comes_first() {
    let mut all: Vec<CaseReport> = (0..30).map(|i| off("small", i, 100 + i)).collect();
    all.push(off("large", 0, 7));
    all.push(off("check-points", 0, 3));
    let r = report(&all);
    assert_eq!(r.worst.len(), 10);
    let places: Vec<(&str, f64)> = r
        .worst
        .iter()
        .map(|c| (c.case.region, (4.0 * c.judgement.share()).round()))
        .collect();
    let due = [
        ("small", 129.0),
        ("large", 7.0),
        ("check-points", 3.0),
        ("small", 128.0),
    ];
    assert_eq!(places[..4], due);
    // With everything that is known of them.
    assert!(
        r.worst
            .iter()
            .all(|c| c.reference.len() == 2 && c.proof.is_some())
    );
    let names: Vec<&str> = r.regions.iter().map(|r| r.name).collect();
    assert_eq!(names, ["check-points", "small", "large"]);
    assert_eq!(
        r.total.cases,
        r.regions.iter().map(|r| r.cases).sum::<u64>()
    );
}

/// All that a report says, but for how it was asked for.
fn shown(report: &MethodReport) -> String {
    format!("{:?}", report)
}

fn any_case() -> impl Strategy<Value = (bool, u64)> {
    (any::<bool>(), 0u64..50)
}

fn planted(((large, index), fault): ((bool, u64), u64)) -> CaseReport {
    let region = if large { "large" } else { "small" };
    match fault {
        0 => judged(
            region,
            index,
            1.0,
            SolverAnswer::Values(vec![f64::NAN, 2.0]),
        ),
        1 => judged(region, index, 1.0, SolverAnswer::Unanswered("late".into())),
        2 => judged(region, index, -1.0, SolverAnswer::Refuses("negative")),
        ulps => off(region, index, ulps),
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]
    #[test]
    fn several_machines_tallies_add_up(
        // One answer to each case.
        cases in prop::collection::btree_map(any_case(), 0u64..40, 0..60), cut in (0usize..60, 0usize..60),
    ) {
        let all: Vec<CaseReport> = cases.into_iter().map(planted).collect();
        let settings = Settings { points: 4, ..Settings::default() };
        let tally = |part: &[CaseReport], backwards: bool| {
            let mut tally = Tally::new(&Twice, &settings);
            match backwards {
                false => part.iter().for_each(|r| tally.add(r)),
                true => part.iter().rev().for_each(|r| tally.add(r)),
            }
            tally
        };
        let at = |k: usize| k.min(all.len());
        let (i, j) = (at(cut.0.min(cut.1)), at(cut.0.max(cut.1)));
        let parts = |backwards| [&all[..i], &all[i..j], &all[j..]].map(|p| tally(p, backwards));
        let merged = |a: &Tally, b: &Tally| {
            let mut sum = a.clone();
            sum.merge(b.clone());
            sum
        };
        let whole = shown(&tally(&all, false).finish(&Twice));
        let [a, b, c] = parts(false);
        let [x, y, z] = parts(true);
        for sum in [
            merged(&merged(&a, &b), &c),
            merged(&a, &merged(&b, &c)),
            merged(&merged(&z, &x), &y),
            tally(&all, true),
        ] {
            prop_assert_eq!(&shown(&sum.finish(&Twice)), &whole);
        }
    }

    /// Written, read, and written again; alone and merged with another.
    #[test]
    fn a_tally_that_was_stored_is_the_same(
        cases in prop::collection::btree_map(any_case(), 0u64..40, 0..40), cut in 0usize..40,
    ) {
        let all: Vec<CaseReport> = cases.into_iter().map(planted).collect();
        let settings = Settings { points: 4, ..Settings::default() };
        let tally = |part: &[CaseReport]| {
            let mut tally = Tally::lean(&Twice, &settings);
            part.iter().for_each(|r| tally.add(r));
            tally
        };
        let again = |tally: &Tally| {
            let text = serde_json::to_string(&tally.stored()).unwrap();
            let read: StoredTally = serde_json::from_str(&text).unwrap();
            let back = Tally::restored(&Twice, &settings, read).unwrap();
            assert_eq!(serde_json::to_string(&back.stored()).unwrap(), text);
            back
        };
        // The word of a refusal is judged alike, whoever says it.
        let shown = |tally: Tally| {
            shown(&tally.finish(&Twice)).replace(r#"Declines(Some("negative"))"#, r#"Refuses("negative")"#)
        };
        let whole = shown(tally(&all));
        prop_assert_eq!(&shown(again(&tally(&all))), &whole);
        let (a, b) = all.split_at(cut.min(all.len()));
        for (a, b) in [(a, b), (b, a)] {
            let mut sum = again(&tally(a));
            sum.merge(again(&tally(b)));
            prop_assert_eq!(&shown(again(&sum)), &whole);
        }
    }
}

#[test]
fn what_no_tally_of_the_method_holds_is_refused() {
    let settings = Settings::default();
    let mut tally = Tally::lean(&Twice, &settings);
    tally.add(&off("small", 0, 3));
    let text = serde_json::to_string(&tally.stored()).unwrap();
    let restored = |text: &str| {
        let read: StoredTally = serde_json::from_str(text).unwrap();
        Tally::restored(&Twice, &settings, read).map(drop)
    };
    assert_eq!(restored(&text), Ok(()));
    for (from, to, why) in [
        ("\"small\"", "\"tiny\"", "no region \"tiny\""),
        ("\"two\"", "\"three\"", "no output \"three\""),
        ("\"dropped\":45", "\"dropped\":42", "widths of bins"),
        ("\"count\":1", "\"count\":2", "a spread"),
        ("\"kinds\":[0,", "\"kinds\":[", "numbers of kinds"),
    ] {
        let changed = text.replacen(from, to, 1);
        assert_ne!(changed, text, "{from}");
        let e = restored(&changed).unwrap_err().to_string();
        assert!(e.contains(why), "{e}");
    }
    // Of a spread that is not lean.
    let whole = Tally::new(&Twice, &settings);
    let mut whole = whole;
    whole.add(&off("small", 0, 3));
    let e = Tally::restored(&Twice, &settings, whole.stored());
    assert!(e.is_err());
}
