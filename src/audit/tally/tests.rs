//! Planted answers in tallies: each statistic, each wrong kind, in any order.

use super::*;
use crate::answer::{ReferenceAnswer, SolverAnswer};
use crate::case::Origin;
use crate::judged::judge_case_briefly;
use crate::kind::{Kind, Kinds};
use crate::planted::{self, Planted, hard, output, point, region};
use crate::{CandidateReport, Domain, Law, Limit, NormBudget, Output};
use proptest::prelude::*;
use rug::Rational;

mod report;
mod stored;

/// `x` and `2x`; refuses where x is negative.
fn twice() -> Planted<'static> {
    Planted {
        outputs: ["one", "two"]
            .map(|name| output(name, Limit::Ulps(4.0)))
            .into(),
        norm: Some(NormBudget::new(34.0, "planted")),
        domain: Domain {
            regions: vec![
                region("small", |d| vec![d.uniform(1.0, 2.0)]),
                region("large", |d| vec![d.log_uniform(1e200, 1e300)]),
            ],
            check_points: vec![point("one", &[1.0])],
        },
        solve: Box::new(|x| match x[0] < 0.0 {
            true => SolverAnswer::Refuses("negative"),
            false => SolverAnswer::Values(vec![x[0], 2.0 * x[0]]),
        }),
        reference: Box::new(|x, bits| match x[0] < 0 {
            true => ReferenceAnswer::Refuses("negative"),
            false => ReferenceAnswer::exact([&x[0], &Rational::from(&x[0] * 2u32)], bits),
        }),
        hard: [
            (2.0, "one", RECORDED),
            (0.5, "one", 1.625),
            (9.0, "two", 1.75),
        ]
        .map(|(share, output, x)| hard(share, output, &[x]))
        .into(),
        ..Planted::default()
    }
}

/// Where the first output is known to be over its budget of 4 ulps, twice of it.
const RECORDED: f64 = 1.5;

/// A finding that is recorded is forgiven: this output at this input, up to the recorded share, and
/// nothing else.
#[test]
fn only_what_is_recorded_is_forgiven() {
    let at = |x: f64, [one, two]: [u64; 2]| {
        let off = |x: f64, ulps: u64| f64::from_bits(x.to_bits() + ulps);
        let got = SolverAnswer::Values(vec![off(x, one), off(2.0 * x, two)]);
        let found = report(&[judged("small", 0, x, got)]);
        (
            found.passed,
            found.total.recorded,
            found.failed(),
            found.passed(),
        )
    };
    let (good, known, bad) = ((1, 0, 0, true), (0, 1, 0, true), (0, 0, 1, false));
    assert_eq!(at(RECORDED, [4, 4]), good);
    assert_eq!(at(RECORDED, [5, 0]), known);
    assert_eq!(at(RECORDED, [8, 4]), known);
    // Worse than recorded; the other output; both.
    assert_eq!(at(RECORDED, [9, 0]), bad);
    assert_eq!(at(RECORDED, [0, 5]), bad);
    assert_eq!(at(RECORDED, [6, 6]), bad);
    // Recorded within its budget, where no excess is forgiven; elsewhere; of the other output.
    assert_eq!(at(1.625, [5, 0]), bad);
    assert_eq!(at(RECORDED.next_up(), [5, 0]), bad);
    assert_eq!(at(1.75, [5, 0]), bad);
    assert_eq!(
        at(1.75, [0, 34]),
        bad,
        "the norm is over its budget as well"
    );
    assert_eq!(at(1.75, [0, 12]), known);
    // No number is no recorded excess.
    let nan = SolverAnswer::Values(vec![f64::NAN, 2.0 * RECORDED]);
    assert_eq!(report(&[judged("small", 0, RECORDED, nan)]).failed(), 1);
    // Nor is an answer that is not there.
    let silent = SolverAnswer::Unanswered("planted".into());
    assert_eq!(report(&[judged("small", 0, RECORDED, silent)]).failed(), 1);
    // Recorded and passed cases add up over merged tallies.
    let half = |n: u64| {
        let mut tally = Tally::new(&twice(), &Settings::default());
        for i in 0..n {
            let x = f64::from_bits(RECORDED.to_bits() + 6);
            tally.add(&judged(
                "small",
                i,
                RECORDED,
                SolverAnswer::Values(vec![x, 2.0 * RECORDED]),
            ));
        }
        tally
    };
    let mut whole = half(3);
    whole.merge(half(2));
    let found = whole.finish(&twice());
    assert_eq!(
        (found.total.recorded, found.cases, found.passed()),
        (5, 5, true)
    );
}

/// A report is a pass only if its program came through.
#[test]
fn trouble_besides_the_answers_is_no_pass() {
    let mut found = report(&[off("small", 0, 0)]);
    assert!(found.passed());
    found.candidate = Some(CandidateReport::default());
    assert!(found.passed());
    found.candidate = Some(CandidateReport {
        trouble: Some("it crashed".into()),
        ..CandidateReport::default()
    });
    assert!(!found.passed());
}

/// Of two laws one that fails is enough, in whichever order, and its worst case is the largest
/// residual's, the earliest of equals.
#[test]
fn laws_keep_their_worst() {
    let settings = Settings::default();
    let mut tally = Tally::new(&lawful(), &settings);
    let at = |index: u64| case("small", index, 1.0 + index as f64 / 64.0);
    tally.laws(&at(3), &[Some(0.25), Some(0.5)]);
    tally.laws(&at(2), &[Some(0.25), None]);
    tally.laws(&at(4), &[Some(0.25), Some(1.5)]);
    tally.laws(&at(5), &[None, Some(1.25)]);
    let place = |l: &crate::LawReport| l.worst_case.as_ref().map(|c| c.place());
    let check = |tally: &Tally| {
        let found = tally.clone().finish(&lawful());
        let [one, two] = found.laws.as_slice() else {
            panic!("two laws")
        };
        assert_eq!(
            (one.worst, one.cases, place(one)),
            (0.25, 3, Some(at(2).place()))
        );
        assert_eq!(
            (two.worst, two.cases, place(two)),
            (1.5, 3, Some(at(4).place()))
        );
        assert!(!found.passed());
    };
    check(&tally);
    // The same in two parts, either way round.
    let (mut a, mut b) = (
        Tally::new(&lawful(), &settings),
        Tally::new(&lawful(), &settings),
    );
    a.laws(&at(2), &[Some(0.25), None]);
    a.laws(&at(5), &[None, Some(1.25)]);
    b.laws(&at(3), &[Some(0.25), Some(0.5)]);
    b.laws(&at(4), &[Some(0.25), Some(1.5)]);
    let (c, d) = (a.clone(), b.clone());
    a.merge(d);
    b.merge(c);
    check(&a);
    check(&b);
    // Zero is no worst case.
    let mut calm = Tally::new(&lawful(), &settings);
    calm.laws(&at(1), &[Some(0.0), Some(0.0)]);
    let found = calm.finish(&lawful());
    assert!(
        found
            .laws
            .iter()
            .all(|l| l.worst == 0.0 && l.worst_case.is_none() && l.cases == 1)
    );
}

/// [`twice`] with two laws, whose residuals are planted.
fn lawful() -> Planted<'static> {
    let law = |name| Law {
        name,
        statement: "planted",
        residual: |_| None,
    };
    Planted {
        laws: ["first", "second"].map(law).into(),
        ..twice()
    }
}

fn case(region: &'static str, index: u64, x: f64) -> Case {
    Case {
        region,
        ..planted::case(index, &[x])
    }
}

fn judged(region: &'static str, index: u64, x: f64, answer: SolverAnswer) -> CaseReport {
    judge_case_briefly(
        &twice(),
        case(region, index, x),
        answer,
        &Settings::default(),
    )
}

/// `x` off by a number of ulps, `2x` right.
fn off(region: &'static str, index: u64, ulps: u64) -> CaseReport {
    let x = 1.0 + index as f64 * 2f64.powi(-20);
    let got = f64::from_bits(x.to_bits() + ulps);
    judged(region, index, x, SolverAnswer::Values(vec![got, 2.0 * x]))
}

fn report(all: &[CaseReport]) -> MethodReport {
    let mut tally = Tally::new(&twice(), &Settings::default());
    all.iter().for_each(|r| tally.add(r));
    tally.finish(&twice())
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
    let mut expected = Kinds::default();
    for (i, (x, answer, kind)) in planted.into_iter().enumerate() {
        let report = judged("small", i as u64, x, answer);
        assert_eq!(report.judgement.kind, Some(kind), "{report:?}");
        expected[kind] += 1;
        all.push(report);
    }
    let r = report(&all);
    assert_eq!((r.cases, r.passed, r.total.kinds), (11, 2, expected));
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
    for kind in expected.nonzero().map(|k| k.0) {
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
    let expected = 9.0 * 2.0 / (5f64.sqrt() * x);
    assert!(
        (norm.max / expected - 1.0).abs() < 1e-3,
        "{norm:?} {expected}"
    );
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
    let expected = [
        ("small", 129.0),
        ("large", 7.0),
        ("check-points", 3.0),
        ("small", 128.0),
    ];
    assert_eq!(places[..4], expected);
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

/// Returns a report without the settings of its run.
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
            let mut tally = Tally::new(&twice(), &settings);
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
        let whole = shown(&tally(&all, false).finish(&twice()));
        let [a, b, c] = parts(false);
        let [x, y, z] = parts(true);
        for sum in [
            merged(&merged(&a, &b), &c),
            merged(&a, &merged(&b, &c)),
            merged(&merged(&z, &x), &y),
            tally(&all, true),
        ] {
            prop_assert_eq!(&shown(&sum.finish(&twice())), &whole);
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
            let mut tally = Tally::lean(&twice(), &settings);
            part.iter().for_each(|r| tally.add(r));
            tally
        };
        let again = |tally: &Tally| {
            let text = serde_json::to_string(&tally.stored()).unwrap();
            let read: StoredTally = serde_json::from_str(&text).unwrap();
            let back = Tally::restored(&twice(), &settings, read).unwrap();
            assert_eq!(serde_json::to_string(&back.stored()).unwrap(), text);
            back
        };
        // The word of a refusal is judged alike, whoever says it.
        let shown = |tally: Tally| {
            shown(&tally.finish(&twice())).replace(r#"Declines(Some("negative"))"#, r#"Refuses("negative")"#)
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
    let mut tally = Tally::lean(&twice(), &settings);
    tally.add(&off("small", 0, 3));
    let text = serde_json::to_string(&tally.stored()).unwrap();
    let restored = |text: &str| {
        let read: StoredTally = serde_json::from_str(text).unwrap();
        Tally::restored(&twice(), &settings, read).map(drop)
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
    let whole = Tally::new(&twice(), &settings);
    let mut whole = whole;
    whole.add(&off("small", 0, 3));
    let e = Tally::restored(&twice(), &settings, whole.stored());
    assert!(e.is_err());
}

/// A norm just at its budget is none over it.
#[test]
fn a_norm_at_its_budget_is_forgiven() {
    for (norm, recorded) in [(1.0, 1), (1f64.next_up(), 0)] {
        let got = vec![f64::from_bits(RECORDED.to_bits() + 5), 2.0 * RECORDED];
        let mut case = judged("small", 0, RECORDED, SolverAnswer::Values(got));
        case.judgement.norm_of_budget = norm;
        assert_eq!(report(&[case]).total.recorded, recorded);
    }
}

/// A tally that was stored keeps no more cases than it did before.
#[test]
fn a_stored_tally_has_its_room() {
    let settings = Settings::default();
    let mut tally = Tally::lean(&twice(), &settings);
    tally.add(&off("small", 0, 1));
    let back = Tally::restored(&twice(), &settings, tally.stored()).unwrap();
    let region = &back.regions[0].1;
    assert_eq!(region.share.room(), 1);
    for output in &region.outputs {
        assert_eq!(output.worst.room(), 1);
        assert!(
            output
                .octaves
                .iter()
                .all(|(_, largest)| largest.room() == 1)
        );
    }
}
