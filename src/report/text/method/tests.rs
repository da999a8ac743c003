//! Tests of `method`, and reports for those of other forms.

use super::*;
use crate::audit::{
    Budget, CandidateReport, Case, ComponentJudgement, ErrorParts, Format, Input, Judgement, Kind,
    LawReport, Layout, Limit, MapOutput, Octave, Origin, OutputBudget, Proof, Reproduce, Settings,
    SolverAnswer,
};
use crate::report::gallery::Gallery;

/// A report that exists for tests.
pub fn fabricated() -> MethodReport {
    let case = Case {
        method: "a-method",
        region: "wide",
        input: vec![0.1, -2.0],
        origin: Origin::Random { seed: 1, index: 17 },
    };
    let spread = Spread {
        count: 400,
        beyond: 0,
        max: 7.25,
        p99: 1.5,
        p9999: None,
        median: 0.3,
        rms: 0.4,
    };
    let octave = |exponent, count| Octave {
        exponent: Some(exponent),
        count,
        worst: case.clone(),
    };
    let total = RegionReport {
        name: "all",
        description: "all regions together",
        cases: 400,
        passed: 399,
        recorded: 0,
        over: 1,
        undecided: 0,
        reference_failed: 0,
        kinds: Kinds::default(),
        outputs: vec![OutputStatistics {
            name: "phi2",
            values: 400,
            kinds: Kinds::default(),
            ulps: spread,
            conditioned: Spread::default(),
            histogram: vec![octave(-2, 399), octave(2, 1)],
            max_of_budget: 1.75,
            max_condition: 31.0,
            worst: Some(case.clone()),
            parts: Some(ErrorParts {
                method: 0.125,
                rounding: 7.25,
            }),
        }],
        normwise: Some(spread),
        max_of_budget: 1.75,
        worst: Some(case.clone()),
    };
    let region = |name, description| RegionReport {
        name,
        description,
        ..total.clone()
    };
    let failure = CaseReport {
        case: case.clone(),
        answer: Some(SolverAnswer::Values(vec![0.75])),
        judgement: Judgement {
            verdict: Verdict::Over,
            reason: Some("phi2 (value 0) is 7.5e-1, expected 7.500000000000008e-1: 1.750 times its budget off".into()),
            kind: None,
            components: vec![ComponentJudgement {
                output: "phi2",
                verdict: Verdict::Over,
                kind: None,
                ulps: 7.25,
                conditioned: 0.4,
                of_budget: 1.75,
                condition: 31.0,
            }],
            normwise: 3.0,
            norm_of_budget: f64::NAN,
            wide: false,
        },
        bits: 128,
        reference: vec![Some("0.75000000000000080491".into())],
        radii: vec![1e-30],
        proof: Some(Proof::Exact),
        branch: None,
        unwritten: None,
    };
    MethodReport {
        method: "a-method",
        summary: "A method that exists for this test.",
        source: "Nobody (1900), (1)",
        remarks: Vec::new(),
        layout: Layout::of(
            vec![
                Input {
                    name: "a",
                    unit: "1",
                },
                Input {
                    name: "b",
                    unit: "m",
                },
            ],
            vec![("phi2", "rad")],
            None,
        ),
        candidate: None,
        settings: Settings::default(),
        format: Format::Double,
        inputs: vec![("a", 0), ("b", 1)],
        budgets: vec![OutputBudget {
            name: "phi2",
            unit: "rad",
            budget: Budget::new(Limit::Ulps(4.0), "planted"),
        }],
        norm_budget: None,
        proved: Vec::new(),
        cases: 400,
        passed: 399,
        recorded: 0,
        interrupted: false,
        regions: vec![region("wide", "far away"), region("near", "close by")],
        total,
        laws: vec![LawReport {
            name: "energy",
            statement: "The sum is constant within 4 ulp.",
            cases: 400,
            worst: 0.25,
            worst_case: None,
        }],
        worst: vec![failure.clone()],
        wrong: Vec::new(),
        failures: vec![failure],
        failures_left_out: 0,
        points: Vec::new(),
        map: None,
        reproduce: Reproduce {
            head: "mechaudit audit a-method ".into(),
            tail: String::new(),
        },
    }
}

/// The same, passed.
pub fn passing() -> MethodReport {
    let mut good = fabricated();
    good.passed = good.cases;
    good.failures.clear();
    good.worst.clear();
    for r in good.regions.iter_mut().chain([&mut good.total]) {
        r.passed = r.cases;
        r.over = 0;
    }
    good
}

/// With two outputs, one of two regions in which a case fails, and the other with an error beyond
/// all numbers.
fn varied() -> MethodReport {
    let mut report = fabricated();
    let mut wrong = Kinds::default();
    wrong[Kind::Nan] = 1;
    for region in report.regions.iter_mut().chain([&mut report.total]) {
        (region.over, region.undecided, region.kinds) = (0, 1, wrong);
        let second = OutputStatistics {
            name: "phi3",
            parts: None,
            ..region.outputs[0].clone()
        };
        region.outputs.push(second);
    }
    let near = &mut report.regions[1];
    (near.passed, near.undecided) = (400, 0);
    (near.outputs[0].ulps.beyond, near.kinds) = (3, Kinds::default());
    report
}

/// Cases that differ by their number.
fn failures(n: u64) -> Vec<CaseReport> {
    let one = fabricated().failures.remove(0);
    let case = |index| CaseReport {
        case: Case {
            origin: Origin::Random { seed: 1, index },
            ..one.case.clone()
        },
        ..one.clone()
    };
    (100..100 + n).map(case).collect()
}

/// The worst, then those of the wrong kind, then others: whatever is in two lists comes once.
#[test]
fn failing_cases_come_once_the_worst_first() {
    let mut report = fabricated();
    let mut all = failures(4);
    for (k, case) in all.iter_mut().enumerate() {
        case.case.input = vec![k as f64];
    }
    let mut passed = all[3].clone();
    passed.judgement.verdict = Verdict::Pass;
    report.worst = vec![passed, all[2].clone()];
    report.wrong = vec![all[1].clone(), all[2].clone()];
    report.failures = all.clone();
    // Of another region it is another case.
    let mut elsewhere = all[1].clone();
    elsewhere.case.region = "near";
    report.failures.push(elsewhere);
    let seen = |most| -> Vec<(&str, f64)> {
        let cases = failing(&report, most).into_iter();
        cases.map(|c| (c.case.region, c.case.input[0])).collect()
    };
    let due = [
        ("wide", 2.0),
        ("wide", 1.0),
        ("wide", 0.0),
        ("wide", 3.0),
        ("near", 1.0),
    ];
    assert_eq!(seen(9), due);
    assert_eq!(seen(2), due[..2]);
    assert_eq!(seen(0), []);
}

#[test]
fn only_cases_of_the_hard_region_are_recorded() {
    let mut report = fabricated();
    let mut hard = failures(1).remove(0);
    hard.case.region = "hard";
    hard.case.input = vec![0.5];
    report.recorded = 1;
    assert!(is_recorded(&report, &hard));
    let mut wide = hard.clone();
    wide.case.region = "wide";
    assert!(!is_recorded(&report, &wide));
    report.failures = vec![hard.clone()];
    assert!(!is_recorded(&report, &hard));
    (report.failures, report.recorded) = (Vec::new(), 0);
    assert!(!is_recorded(&report, &hard));
}

#[test]
fn all_outputs_together_have_the_largest_of_each_figure() {
    let output = |count, beyond, figures: [f64; 4]| {
        let [max, p99, median, rms] = figures;
        let ulps = Spread {
            count,
            beyond,
            max,
            p99,
            p9999: None,
            median,
            rms,
        };
        OutputStatistics {
            ulps,
            ..fabricated().total.outputs.remove(0)
        }
    };
    let all = of_all(&[
        output(3, 1, [1.0, 8.0, 0.25, 4.0]),
        output(4, 2, [2.0, 7.0, 0.5, 3.0]),
    ]);
    assert_eq!((all.count, all.beyond), (7, 3));
    assert_eq!(
        [all.max, all.p99, all.median, all.rms],
        [2.0, 8.0, 0.5, 4.0]
    );
    assert_eq!(of_all(&[]).count, 0);
}

/// Nothing is measured of answers that cannot be read: their share of a budget is a dash, not zero.
#[test]
fn answers_that_cannot_be_read_have_no_share_of_a_budget() {
    use crate::audit::{Panel, Settings, SolverAnswer, Variant, judge_case};
    let method = crate::methods::find("erf").unwrap();
    let variant = Variant::new(&*method).without_laws();
    let settings = Settings {
        cases_per_region: 2,
        ..Settings::default()
    };
    let cases = crate::audit::Cases::new(&variant, &settings);
    let mut tally = Panel::new(&variant, &settings).into_tally();
    for case in (0..cases.len()).map(|i| cases.get(i)) {
        let answer = SolverAnswer::Fails("\"?\" is no number".into());
        tally.add(&judge_case(&variant, case, answer, &settings));
    }
    let report = tally.finish(&variant);
    let text = style::plain(&super::method(&report, 200));
    let head = text.lines().next().unwrap();
    assert!(
        head.ends_with(&format!("FAIL  {0} of {0} cases failed", report.cases)),
        "{head}"
    );
    assert!(!text.contains("0 %"), "{text}");
    assert!(!text.contains("branch"), "{text}");
    let short = crate::report::text::summary::methods(&[report], 200);
    assert!(!style::plain(&short).contains("0 %"), "{short}");
}

/// As wide as the table, one column less, and wider.
#[test]
fn columns_give_way_one_by_one() {
    let report = varied();
    for (seen, named) in [
        (regions as fn(&MethodReport, usize) -> String, "median"),
        (outputs, "condition"),
    ] {
        let seen = |width| style::plain(&seen(&report, width));
        let whole = seen(200);
        let table = whole.lines().take_while(|l| !l.starts_with("  worst"));
        let longest = table.map(|l| l.chars().count()).max().unwrap();
        assert_eq!(seen(longest), whole);
        assert!(!seen(longest - 1).contains(named), "{whole}");
    }
}

/// Returns a report of `n` outputs, whose largest errors are 1, 2, …, and of regions in which `failed` cases fail.
fn with_outputs(n: usize, failed: u64) -> MethodReport {
    let mut report = fabricated();
    for region in &mut report.regions {
        let output = region.outputs[0].clone();
        let numbered = |k: usize| {
            let mut o = output.clone();
            o.ulps.max = 1.0 + k as f64;
            o
        };
        region.outputs = (0..n).map(numbered).collect();
        (region.passed, region.over) = (region.cases - failed, failed);
    }
    report
}

/// Returns a report with figures of `count` values.
fn with_values(count: u64) -> MethodReport {
    let mut report = fabricated();
    let spread = Spread {
        count,
        ..report.total.outputs[0].ulps
    };
    for region in report.regions.iter_mut().chain([&mut report.total]) {
        region.normwise = Some(spread);
        (region.outputs[0].ulps, region.outputs[0].conditioned) = (spread, spread);
    }
    report
}

/// Whole reports with their colours, and the parts that vary: failing cases shown and counted, a
/// candidate in trouble, proved bounds, laws that fail, a map.
#[test]
fn reports() {
    let mut all = Gallery::default();
    let mut show = |name: &str, report: &MethodReport| all.add(name, method(report, 100));
    show("failing", &fabricated());
    show("passing", &passing());
    show("two outputs", &varied());
    for (n, failed) in [(4, 1), (5, 1), (4, 0)] {
        show(
            &format!("{n} outputs, {failed} failed"),
            &with_outputs(n, failed),
        );
    }
    for count in [0, 1] {
        show(&format!("figures of {count} values"), &with_values(count));
    }
    let mut report = passing();
    report.remarks = vec!["The name e is an input, not the constant.".into()];
    (report.passed, report.recorded) = (397, 3);
    (report.total.passed, report.total.recorded) = (397, 3);
    report.candidate = Some(CandidateReport {
        name: "other".into(),
        answered: 1,
        trouble: Some("it stopped".into()),
        ..Default::default()
    });
    report.proved = crate::methods::find("faddeeva").unwrap().proved().to_vec();
    let output = |name, ulps: &[f64]| MapOutput {
        name,
        ulps: ulps.to_vec(),
    };
    report.map = Some(ErrorMap {
        columns: 3,
        rows: 2,
        corner: [0.0, 0.0],
        side: 1.0,
        outputs: vec![
            output("Re W", &[0.5, f64::NAN, 2.5]),
            output("Im W", &[f64::NAN]),
        ],
        not_passed: 4,
    });
    show("with all there can be", &report);
    let only = fabricated().failures.remove(0);
    all.add("single", single(&report, &only, 80));
    report.laws[0].cases = 0;
    all.add("single without laws", single(&report, &only, 80));
    all.add("narrow", heading(&report, 10));
    report = fabricated();
    report.laws[0].worst = 1.5;
    all.add("a law that fails", laws(&report, 100));
    report.laws[0].worst_case = Some(only.case);
    all.add("its worst case", laws(&report, 100));
    report.worst.clear();
    for (listed, failed) in [(1, 3), (10, 10), (12, 12), (0, 3)] {
        report.failures = failures(listed);
        report.total.passed = report.total.cases - failed;
        let text = style::plain(&method(&report, 100));
        let start = text.find("\n\n").unwrap_or(text.len());
        let end = text[start..].matches("reproduce").count();
        let last = text.lines().last().unwrap();
        all.add(
            format!("{listed} of {failed} listed"),
            format!("{end} shown\n{last}"),
        );
    }
    all.pin("methods");
}
