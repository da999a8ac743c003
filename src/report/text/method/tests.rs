//! Tests of `method`, and reports for those of other forms.

use super::*;
use crate::audit::{
    Budget, Case, ComponentJudgement, ErrorParts, Format, Input, Judgement, LawReport, Layout,
    Limit, Octave, Origin, OutputBudget, Proof, Reproduce, Settings, SolverAnswer,
};

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

#[test]
fn a_failing_case_has_all_it_needs() {
    let text = method(&fabricated(), 100);
    let text = style::plain(&text);
    for part in [
        "FAIL  1 of 400 cases failed",
        "175.0 %",
        "0x1.999999999999ap-4",
        "0.75000000000000080491",
        "mechaudit audit a-method --region wide --seed 1 --case 17",
        "✓ energy",
        "31.00",
        "phi2: 4 ulp",
        "wide",
        "worst phi2: 0.125 ulps of the method, 7.25 of rounding",
    ] {
        assert!(text.contains(part), "{part} is missing in\n{text}");
    }
    assert!(text.lines().all(|l| l.chars().count() <= 100), "{text}");
}

/// With two outputs, one of two regions in which a case fails, and the other with an error beyond
/// all numbers.
fn varied() -> MethodReport {
    let mut report = fabricated();
    let mut wrong = Kinds::default();
    wrong[crate::audit::Kind::Nan] = 1;
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

#[test]
fn regions_in_which_cases_fail_have_a_line_for_each_output() {
    let mut report = varied();
    let due = "\
a-method                                                                   FAIL  1 of 400 cases failed
  A method that exists for this test.
  budget     phi2: 4 ulp
  output      values  worst ulps   p99  median    RMS  u(1+cond)  of budget  condition  wrong
  phi2           400        7.25  1.50   0.300  0.400          –    175.0 %      31.00  –
  phi3           400        7.25  1.50   0.300  0.400          –    175.0 %      31.00  –
  norm, in u     400        7.25  1.50   0.300  0.400
  worst phi2: 0.125 ulps of the method, 7.25 of rounding
  region  cases  failed  output  worst ulps   p99  median    RMS  norm, u  of budget  wrong
  wide      400       1  phi2          7.25  1.50   0.300  0.400     7.25    175.0 %  1 NaN
                         phi3          7.25  1.50   0.300  0.400             175.0 %
  near      400       –              >1e308  1.50   0.300  0.400     7.25    175.0 %  –
  1 case undecided
  ✓ energy: The sum is constant within 4 ulp. (worst residual 25.00 % of what is allowed, 400 cases)

  over budget  a-method / wide, decided at 128 bits
    phi2 (value 0) is 7.5e-1, expected 7.500000000000008e-1: 1.750 times its budget off
    input  unit  decimal  hexadecimal
    a                0.1  0x1.999999999999ap-4
    b      m        -2.0  -0x1p+1
    output  got   reference                       ulps  of budget  condition
    phi2    0.75  0.75000000000000080491 ± 1e-30  7.25    175.0 %      31.00
    proof      exact arithmetic
    reproduce  mechaudit audit a-method --region wide --seed 1 --case 17
";
    let text = style::plain(&method(&report, 102));
    let lines: Vec<&str> = text.lines().map(str::trim_end).collect();
    assert_eq!(lines.join("\n") + "\n", due);
    report.regions.truncate(1);
    assert_eq!(regions(&report, 102), "");
}

#[test]
fn columns_of_regions_give_way_one_column_before_the_edge() {
    let report = varied();
    let seen = |width| style::plain(&regions(&report, width));
    let whole = seen(200);
    let longest = whole.lines().map(|l| l.chars().count()).max().unwrap();
    assert_eq!(seen(longest), whole);
    assert!(!seen(longest - 1).contains("median"), "{whole}");
}

/// A case of the hard region that is over budget comes first, unless it is recorded: then it is
/// among no failures.
#[test]
fn recorded_cases_are_not_shown_as_failing() {
    let mut report = fabricated();
    report.recorded = 1;
    let other = report.failures[0].clone();
    let mut hard = other.clone();
    (hard.case.region, hard.case.input) = ("hard", vec![0.5, 0.5]);
    report.worst = vec![hard.clone()];
    let first = |r: &MethodReport| failing(r, 1)[0].case.region;
    assert_eq!(first(&report), "wide");
    report.failures.push(hard);
    assert_eq!(first(&report), "hard");
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

#[test]
fn ten_failing_cases_are_shown_and_the_others_counted() {
    for (listed, failed, shown, left) in [
        (1, 1, 1, None),
        (1, 3, 1, Some("2 more failing cases")),
        (10, 10, 10, None),
        (12, 12, 10, Some("2 more failing cases")),
        (0, 3, 0, None),
    ] {
        let mut report = fabricated();
        report.worst.clear();
        report.failures = failures(listed);
        report.total.passed = report.total.cases - failed;
        let text = style::plain(&method(&report, 100));
        assert_eq!(text.matches("    reproduce  ").count(), shown, "{text}");
        let more = "more failing cases; --format json lists the first 500 of each region.";
        assert_eq!(text.contains(more), left.is_some(), "{text}");
        assert!(text.contains(left.unwrap_or_default()), "{text}");
    }
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
fn the_heading_says_whose_code_it_is_and_what_is_proved() {
    let mut report = passing();
    let text = style::plain(&heading(&report, 80));
    let due = "\
a-method                                                  pass  400 of 400 cases
  A method that exists for this test.
  budget     phi2: 4 ulp
";
    assert_eq!(text, due);
    assert_eq!(text.lines().next().unwrap().chars().count(), 80);
    let remark = "The name e is an input, not the constant.";
    report.remarks = vec![remark.into()];
    let text = style::plain(&heading(&report, 80));
    assert_eq!(text, format!("{due}  remark     {remark}\n"));
    let only = fabricated().failures.remove(0);
    let text = style::plain(&single(&report, &only, 80));
    assert!(
        text.contains(&format!("\n    remark     {remark}\n")),
        "{text}"
    );
    report.remarks.clear();
    // Where there is no room, two spaces.
    let narrow = style::plain(&heading(&report, 10));
    assert!(
        narrow.starts_with("a-method  pass  400 of 400 cases\n"),
        "{narrow}"
    );
    (report.passed, report.recorded) = (397, 3);
    (report.total.passed, report.total.recorded) = (397, 3);
    report.candidate = Some(crate::audit::CandidateReport {
        name: "other".into(),
        answered: 2,
        ..Default::default()
    });
    let method = crate::methods::find("faddeeva").unwrap();
    report.proved = method.proved().to_vec();
    let text = style::plain(&heading(&report, 200));
    assert!(
        text.contains("  397 of 400 cases, 3 over budget as recorded\n"),
        "{text}"
    );
    assert!(text.contains("\n  candidate  other, 2 answers\n"), "{text}");
    let lines = text
        .lines()
        .filter(|l| l.starts_with("  proved     error at most "));
    assert!(
        report.proved.len() == lines.count() && !report.proved.is_empty(),
        "{text}"
    );
}

/// With five outputs a region has one line, with the largest figures of all.
#[test]
fn a_line_for_each_output_where_there_are_two_to_four() {
    let with = |n: usize, failed: u64| {
        let mut report = fabricated();
        for region in &mut report.regions {
            let output = region.outputs[0].clone();
            region.outputs = (0..n)
                .map(|k| {
                    let mut o = output.clone();
                    o.ulps.max = 1.0 + k as f64;
                    o
                })
                .collect();
            (region.passed, region.over) = (region.cases - failed, failed);
        }
        let text = style::plain(&regions(&report, 120));
        let lines = text
            .lines()
            .map(|l| l.split_whitespace().collect::<Vec<_>>().join(" "));
        lines.collect::<Vec<_>>()
    };
    for (n, failed, lines) in [(1, 1, 3), (2, 1, 5), (4, 1, 9), (5, 1, 3), (4, 0, 3)] {
        let all = with(n, failed);
        assert_eq!(all.len(), lines, "{n}: {all:?}");
        let named = all[0].contains("output");
        assert_eq!(named, lines > 3, "{all:?}");
    }
    let failed = |n: u64| if n > 0 { n.to_string() } else { "–".into() };
    for (n, k) in [(5, 1), (4, 0)] {
        let all = with(n, k);
        let due = format!(
            "wide 400 {} {n}.00 1.50 0.300 0.400 7.25 175.0 % –",
            failed(k)
        );
        assert_eq!(all[1], due);
    }
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

#[test]
fn a_law_that_fails_shows_its_worst_case() {
    let mut report = fabricated();
    let worst = report.failures[0].case.clone();
    report.laws[0].worst_case = Some(worst);
    let text = |report: &MethodReport| style::plain(&laws(report, 100));
    let holding = text(&report);
    assert!(
        holding.starts_with("  ✓ energy: ") && !holding.contains("reproduce"),
        "{holding}"
    );
    report.laws[0].worst = 1.5;
    let failing = text(&report);
    assert!(failing.starts_with("  ✗ energy: "), "{failing}");
    assert!(
        failing.contains("(worst residual 150.0 % of what is allowed, 400 cases)\n"),
        "{failing}"
    );
    let end = "\n    reproduce  mechaudit audit a-method --region wide --seed 1 --case 17\n";
    assert!(
        failing.ends_with(end) && failing.contains("0x1.999999999999ap-4"),
        "{failing}"
    );
    report.laws[0].worst_case = None;
    assert!(!text(&report).contains("reproduce"));
}

#[test]
fn a_map_is_told_by_its_worst_points() {
    let output = |name, ulps: &[f64]| crate::audit::MapOutput {
        name,
        ulps: ulps.to_vec(),
    };
    let mut report = passing();
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
    let text = style::plain(&method(&report, 100));
    let due = "  map of 6 points: worst ulps Re W 2.50, Im W 0; 4 points do not pass\n";
    assert!(text.contains(due), "{text}");
}

#[test]
fn a_single_case_comes_with_budget_laws_and_trouble() {
    let mut report = fabricated();
    let case = report.failures[0].clone();
    let text = |report: &MethodReport| style::plain(&single(report, &case, 100));
    let due = "    budget     phi2: 4 ulp\n    law        energy: 25.00 % of what is allowed\n";
    assert!(text(&report).ends_with(due), "{}", text(&report));
    report.laws[0].cases = 0;
    assert!(!text(&report).contains("law "));
    report.candidate = Some(crate::audit::CandidateReport {
        name: "other".into(),
        answered: 1,
        trouble: Some("it stopped".into()),
        ..Default::default()
    });
    let end = "    budget     phi2: 4 ulp\n    candidate  other, 1 answer\n  it stopped\n";
    assert!(text(&report).ends_with(end), "{}", text(&report));
    assert!(style::plain(&method(&report, 100)).ends_with("\n  it stopped\n"));
}

#[test]
fn outputs_give_way_one_column_before_the_edge() {
    let report = fabricated();
    let seen = |width| style::plain(&outputs(&report, width));
    let whole = seen(200);
    let table = whole.lines().take_while(|l| !l.starts_with("  worst"));
    let longest = table.map(|l| l.chars().count()).max().unwrap();
    assert_eq!(seen(longest), whole);
    assert!(!seen(longest - 1).contains("condition"), "{whole}");
    assert!(seen(longest - 1).contains("median"), "{whole}");
}

/// One value is enough for a figure.
#[test]
fn figures_stand_where_there_are_values() {
    let seen = |count: u64| {
        let mut report = fabricated();
        let spread = Spread {
            count,
            ..report.total.outputs[0].ulps
        };
        for region in report.regions.iter_mut().chain([&mut report.total]) {
            region.normwise = Some(spread);
            (region.outputs[0].ulps, region.outputs[0].conditioned) = (spread, spread);
        }
        let words = |l: &str| l.split_whitespace().collect::<Vec<_>>().join(" ");
        let lines = |text: String| {
            style::plain(&text)
                .lines()
                .skip(1)
                .map(words)
                .collect::<Vec<_>>()
        };
        let (outputs, regions) = (outputs(&report, 200), regions(&report, 200));
        [&lines(outputs)[..2], &lines(regions)[..1]].concat()
    };
    assert_eq!(
        seen(1),
        [
            "phi2 400 7.25 1.50 0.300 0.400 7.25 175.0 % 31.00 –",
            "norm, in u 1 7.25 1.50 0.300 0.400",
            "wide 400 1 7.25 1.50 0.300 0.400 7.25 175.0 % –",
        ]
    );
    assert_eq!(
        seen(0),
        [
            "phi2 400 – – – – – 175.0 % 31.00 –",
            "norm, in u 0 – – – –",
            "wide 400 1 – – – – – 175.0 % –",
        ]
    );
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
