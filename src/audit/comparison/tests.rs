use super::*;
use crate::planted::{Planted, case, off, output, point, region};
use crate::{Kind, Limit, ReferenceAnswer, Verdict};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// A case of a region with its judgement: `x` off by a number of ulps, or no number.
fn judged(region: &'static str, index: u64, ulps: Option<u64>) -> CaseReport {
    let got = ulps.map_or(f64::NAN, |ulps| off(1.0, ulps));
    let case = Case {
        region,
        ..case(index, &[1.0])
    };
    let answer = SolverAnswer::Values(vec![got]);
    Judge::new(&Planted::default(), &Settings::default()).judge(case, answer, false)
}

fn report(name: Option<&str>, all: &[CaseReport]) -> MethodReport {
    let method = Planted::default();
    let mut tally = Tally::new(&method, &Settings::default());
    all.iter().for_each(|r| tally.add(r));
    let mut report = tally.finish(&method);
    report.candidate = name.map(|name| CandidateReport {
        name: name.into(),
        ..CandidateReport::default()
    });
    report
}

fn compared(reports: Vec<MethodReport>) -> Comparison {
    let reports = reports.into_iter().map(|r| (r, None));
    Comparison::new("planted", reports.collect())
}

#[test]
fn names_are_told_apart() {
    let names = [
        None,
        Some("a"),
        None,
        Some("a"),
        Some("a (2)"),
        None,
        Some("b"),
    ];
    let one = [judged("middle", 0, Some(0))];
    let reports = names.map(|n| report(n, &one)).to_vec();
    let found = compared(reports);
    let names: Vec<&str> = found.candidates.iter().map(|c| c.name.as_str()).collect();
    assert_eq!(
        names,
        [
            "ours",
            "a",
            "ours (2)",
            "a (2)",
            "a (2) (2)",
            "ours (3)",
            "b"
        ]
    );
    assert_eq!(found.method, "planted");
}

/// Every region that a code has, once, in the order in which they come, and all of them together.
#[test]
fn regions_are_those_of_all_codes() {
    let one = |region| judged(region, 0, Some(2));
    let found = compared(vec![
        report(None, &[one("hard"), one("middle")]),
        report(Some("a"), &[one("box"), one("middle")]),
        report(Some("b"), &[one("near"), one("hard")]),
    ]);
    let regions: Vec<&str> = found.regions.iter().map(|c| c.region).collect();
    assert_eq!(regions, ["hard", "middle", "box", "near", "all"]);
    let cases: Vec<Vec<u64>> = (found.regions.iter())
        .map(|c| c.standings.iter().map(|s| s.cases).collect())
        .collect();
    assert_eq!(
        cases,
        [[1, 0, 1], [1, 1, 0], [0, 1, 0], [0, 0, 1], [2, 2, 2]]
    );
    // A code without a case there is neither best nor measured.
    let middle = &found.regions[1].standings;
    let best: Vec<bool> = middle.iter().map(|s| s.best).collect();
    assert_eq!(best, [true, true, false]);
    assert!(middle[2].of_budget.is_nan() && middle[2].ratio.is_none());
    assert_eq!((middle[2].failed, middle[2].wrong), (0, 0));
    assert_eq!((middle[2].worst_ulps, middle[2].rms_ulps), (0.0, 0.0));
}

/// A code without a case in a region is not the best there, however wrong the others are.
#[test]
fn nobody_wins_by_not_being_there() {
    let found = compared(vec![
        report(None, &[judged("hard", 0, Some(0))]),
        report(Some("a"), &[judged("middle", 0, None)]),
    ]);
    let middle = &found.regions[1];
    let best: Vec<bool> = middle.standings.iter().map(|s| s.best).collect();
    assert_eq!((middle.region, best), ("middle", vec![false, true]));
}

/// Counts, shares of the budget of four ulps, and errors, as they were planted.
#[test]
fn standings_are_those_of_the_planted_errors() {
    let all = |ulps: &[Option<u64>]| -> Vec<CaseReport> {
        let each = ulps.iter().enumerate();
        each.map(|(i, u)| judged("middle", i as u64, *u)).collect()
    };
    let found = compared(vec![
        report(None, &all(&[Some(1), Some(2), Some(2), Some(0)])),
        report(Some("over"), &all(&[Some(8), Some(0), Some(0), Some(0)])),
        report(Some("nan"), &all(&[None, Some(1), Some(1), None])),
        report(Some("other"), &all(&[None, Some(0), Some(0), Some(0)])),
        report(Some("alike"), &all(&[Some(2), Some(2), Some(2), Some(2)])),
    ]);
    for contest in &found.regions {
        let s = &contest.standings;
        let counts: Vec<_> = s.iter().map(|s| (s.cases, s.failed, s.wrong)).collect();
        assert_eq!(
            counts,
            [(4, 0, 0), (4, 1, 0), (4, 2, 2), (4, 1, 1), (4, 0, 0)]
        );
        let rounded = |x: f64| (x * 1024.0).round() / 1024.0;
        let shares: Vec<f64> = s.iter().map(|s| rounded(s.of_budget)).collect();
        assert_eq!(shares, [0.5, 2.0, 0.25, 0.0, 0.5]);
        let ratios: Vec<_> = s.iter().map(|s| s.ratio.map(rounded)).collect();
        assert_eq!(ratios, [Some(1.0), Some(4.0), Some(0.5), None, Some(1.0)]);
        let best: Vec<bool> = s.iter().map(|s| s.best).collect();
        assert_eq!(best, [true, false, false, false, true]);
        let worst: Vec<f64> = s.iter().map(|s| s.worst_ulps).collect();
        assert_eq!(worst, [2.0, 8.0, 1.0, 0.0, 2.0]);
        let rms: Vec<f64> = s.iter().map(|s| s.rms_ulps).collect();
        assert_eq!(rms, [1.5, 4.0, 1.0, 0.0, 2.0]);
    }
}

/// Beside a code without any error no other has a ratio.
#[test]
fn nothing_is_a_multiple_of_no_error() {
    let found = compared(vec![
        report(None, &[judged("middle", 0, Some(0))]),
        report(Some("a"), &[judged("middle", 0, Some(3))]),
    ]);
    let s = &found.regions[0].standings;
    assert_eq!((s[0].best, s[0].ratio, s[0].of_budget), (true, None, 0.0));
    assert_eq!((s[1].best, s[1].ratio), (false, None));
}

/// Cases that the reference left open or failed at are as wrong as those of the wrong kind.
#[test]
fn what_the_reference_leaves_open_is_wrong() {
    let method = |failed: bool| Planted {
        reference: Box::new(move |x, bits| match (x[0] < 2, failed) {
            (true, _) => ReferenceAnswer::exact(x, bits),
            (_, true) => ReferenceAnswer::Failed("planted".into()),
            (_, false) => ReferenceAnswer::Undecided("planted".into()),
        }),
        ..Planted::default()
    };
    let at = |failed: bool, x: f64, index: u64| {
        let answer = SolverAnswer::Values(vec![x]);
        let referee = method(failed);
        let settings = Settings::default();
        let judge = Judge::new(&referee, &settings);
        let referee = judge.referee(case(index, &[x]));
        referee.judge_last(answer, false)
    };
    let open = at(false, 2.0, 0);
    assert_eq!(open.judgement.verdict, Verdict::Undecided);
    let failed = |i| at(true, 2.0, i);
    assert_eq!(failed(0).judgement.verdict, Verdict::OracleError);
    let nan = || judged("middle", 7, None);
    let found = compared(vec![
        report(None, &[open, failed(1), failed(2), nan(), at(true, 1.0, 3)]),
        report(Some("a"), &[nan()]),
    ]);
    let s = &found.regions[0].standings;
    assert_eq!((s[0].cases, s[0].failed, s[0].wrong), (5, 4, 4));
    assert_eq!((s[1].wrong, s[1].best), (1, true));
}

/// The largest error of any output, by its own measure.
#[test]
fn the_worst_output_counts() {
    let method = Planted {
        outputs: vec![
            output("x", Limit::Ulps(4.0)),
            output("y", Limit::Ulps(64.0)),
        ],
        reference: Box::new(|x, bits| ReferenceAnswer::exact([&x[0], &x[0]], bits)),
        ..Planted::default()
    };
    let settings = Settings::default();
    let mut tally = Tally::new(&method, &settings);
    for (i, [x, y]) in [[4, 0], [0, 5], [0, 0], [0, 0]].into_iter().enumerate() {
        let answer = SolverAnswer::Values(vec![off(1.0, x), off(1.0, y)]);
        let judge = Judge::new(&method, &settings);
        let referee = judge.referee(case(i as u64, &[1.0]));
        tally.add(&referee.judge_last(answer, false));
    }
    let found = compared(vec![tally.finish(&method)]);
    let s = &found.regions[0].standings[0];
    assert_eq!((s.worst_ulps, s.rms_ulps), (5.0, 2.5));
    assert!((s.of_budget - 1.0).abs() < 1e-9);
}

#[test]
fn a_comparison_passes_with_all_its_codes() {
    let good = || report(None, &[judged("middle", 0, Some(0))]);
    let bad = || report(Some("a"), &[judged("middle", 0, Some(5))]);
    let half = || MethodReport {
        interrupted: true,
        ..good()
    };
    for (reports, passed, interrupted) in [
        (vec![], false, false),
        (vec![good()], true, false),
        (vec![good(), good()], true, false),
        (vec![good(), bad()], false, false),
        (vec![bad(), good()], false, false),
        (vec![good(), half()], false, true),
        (vec![half(), good()], false, true),
    ] {
        let found = compared(reports);
        assert_eq!((found.passed(), found.interrupted()), (passed, interrupted));
    }
}

/// Each code's answers go to its own tally; a code that was not asked has nothing counted.
#[test]
fn answers_of_several_codes_are_counted_apart() {
    let asked = AtomicUsize::new(0);
    let method = Planted {
        reference: Box::new(|x, bits| {
            asked.fetch_add(1, Ordering::Relaxed);
            ReferenceAnswer::exact(x, bits)
        }),
        ..Planted::default()
    };
    let settings = Settings::default();
    let mut tallies = vec![Tally::new(&method, &settings); 3];
    let right = |x: f64| Some(SolverAnswer::Values(vec![x]));
    let nan = || right(f64::NAN);
    let cases = vec![
        (case(0, &[1.0]), vec![right(1.0), nan(), None]),
        (case(1, &[1.5]), vec![right(1.5), nan(), None]),
        (
            case(2, &[1.75]),
            vec![right(off(1.75, 5)), None, right(1.75)],
        ),
    ];
    judge_together(&method, &settings, cases, &mut tallies);
    // The values computed for a case served all codes.
    assert_eq!(asked.load(Ordering::Relaxed), 3);
    let reports = tallies.into_iter().map(|t| t.finish(&Planted::default()));
    let counts: Vec<_> = reports
        .map(|r| (r.cases, r.passed, r.total.over, r.total.kinds[Kind::Nan]))
        .collect();
    assert_eq!(counts, [(3, 2, 1, 0), (2, 0, 0, 2), (1, 1, 0, 0)]);
}

/// Every case once for the judge, whichever part it is in; then each of those timed, evenly over
/// all of them.
#[test]
fn contenders_are_judged_at_every_case_and_timed_at_some() {
    let mut method = Planted::default();
    method
        .domain
        .regions
        .push(region("next", |d| vec![d.uniform(2.0, 3.0)]));
    method.domain.check_points = vec![point("five", &[5.0])];
    for per_region in [3, 700] {
        let settings = Settings {
            cases_per_region: per_region,
            ..Settings::default()
        };
        let cases = Cases::new(&method, &settings);
        let expected: Vec<u64> = (0..cases.len())
            .map(|i| cases.get(i).input[0].to_bits())
            .collect();
        let seen = Mutex::new(Vec::new());
        let own = |x: &[f64]| {
            seen.lock().unwrap().push(x[0].to_bits());
            SolverAnswer::Values(x.to_vec())
        };
        let refuses = |_: &[f64]| SolverAnswer::Refuses("planted");
        let name = ("a".to_string(), Some("1.0".to_string()));
        let contenders: [Contender; 2] = [(None, &own), (Some(name), &refuses)];
        let found = compare(&method, &contenders, &settings);
        let n = expected.len();
        let mut seen = seen.into_inner().unwrap();
        let timed = seen.split_off(n);
        seen.sort_unstable();
        let mut sorted = expected.clone();
        sorted.sort_unstable();
        assert_eq!(seen, sorted);
        let answers = n.min(TIMED);
        let round: Vec<u64> = (0..answers).map(|k| expected[k * n / answers]).collect();
        assert_eq!(timed, round.repeat(ROUNDS));
        let [own, other] = found.candidates.as_slice() else {
            panic!("two codes")
        };
        for c in [own, other] {
            let speed = c.speed.unwrap();
            assert_eq!((speed.answers, speed.start_up_ms), (answers as u64, None));
            assert_eq!((c.report.method, c.report.cases), ("planted", n as u64));
        }
        assert!(own.report.passed() && own.report.candidate.is_none());
        assert_eq!(other.report.total.kinds[Kind::Refusal], n as u64);
        let candidate = CandidateReport {
            name: "a".into(),
            version: Some("1.0".into()),
            command: None,
            answered: n as u64,
            trouble: None,
        };
        assert_eq!(other.report.candidate, Some(candidate));
        assert_eq!((own.name.as_str(), other.name.as_str()), ("ours", "a"));
    }
}

/// Without a case nothing is timed; a code that panics fails at every case.
#[test]
fn nothing_to_time_and_a_panic() {
    let none = Settings {
        cases_per_region: 0,
        ..Settings::default()
    };
    let own = |x: &[f64]| SolverAnswer::Values(x.to_vec());
    let found = compare(&Planted::default(), &[(None, &own)], &none);
    assert_eq!((found.candidates[0].speed, found.passed()), (None, false));
    let one = Settings {
        cases_per_region: 1,
        ..none
    };
    let panics = |_: &[f64]| -> SolverAnswer { panic!("planted") };
    let found = compare(&Planted::default(), &[(None, &panics)], &one);
    assert_eq!(found.candidates[0].report.total.kinds[Kind::Unreadable], 1);
}

#[test]
fn the_fastest_round_counts() {
    let ms = Duration::from_millis;
    let timed = |rounds: &[u64], answers| speed(rounds.iter().copied().map(ms), answers);
    let expected = |ns_per_answer, answers| {
        Some(Speed {
            ns_per_answer,
            start_up_ms: None,
            answers,
        })
    };
    assert_eq!(timed(&[3, 2, 5], 1), expected(2e6, 1));
    assert_eq!(timed(&[9, 8, 10], 4), expected(2e6, 4));
    assert_eq!(timed(&[9, 8, 10], 0), None);
    assert_eq!(timed(&[], 3), None);
}
