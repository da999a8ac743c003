//! A method's report for people.

use super::case;
use super::style::{self, BAD, BOLD, DIM, PLAIN, paint, paragraph, wrap};
use super::table::Table;
use crate::audit::{
    CaseReport, ErrorMap, Kinds, MethodReport, OutputStatistics, RegionReport, Spread, Verdict,
};
use crate::report::words::audit::{
    budgets, candidate, holds, kinds, mark, proved, share, undecided, verdict,
};
use crate::report::words::numbers::{percent, short, short_if};
use anstyle::Style;

/// Failing cases printed in full for each method.
const FAILURES_SHOWN: usize = 10;
/// Outputs up to which a region in which cases fail has a line for each of them.
const FEW: usize = 4;

/// The report of one method.
pub fn method(report: &MethodReport, width: usize) -> String {
    let mut out = heading(report, width);
    out.push_str(&outputs(report, width));
    out.push_str(&regions(report, width));
    let open = undecided(&report.total);
    if !open.is_empty() {
        out.push_str(&paragraph(&open, 2, width));
    }
    out.push_str(&laws(report, width));
    if let Some(map) = &report.map {
        out.push_str(&paragraph(&on_the_map(map), 2, width));
    }
    let shown = failing(report, FAILURES_SHOWN);
    for failure in &shown {
        out.push('\n');
        out.push_str(&case::text(failure, &report.again(&failure.case), width));
    }
    let left = report.failed().saturating_sub(shown.len() as u64);
    if left > 0 && !shown.is_empty() {
        let text =
            format!("{left} more failing cases; --format json lists the first 500 of each region.");
        out.push_str(&paragraph(&text, 2, width));
    }
    out.push_str(&trouble(report, width));
    out
}

/// The report of a single case.
pub fn single(report: &MethodReport, only: &CaseReport, width: usize) -> String {
    let mut out = case::text(only, &report.again(&only.case), width);
    let line = |label: &str, text: &str| format!("    {label:<10} {}\n", wrap(text, 15, width));
    out.push_str(&line("budget", &budgets(report)));
    if let Some(c) = &report.candidate {
        out.push_str(&line("candidate", &candidate(c)));
    }
    for law in report.laws.iter().filter(|l| l.cases > 0) {
        let style = if holds(law) { BOLD } else { BAD };
        let (name, share) = (paint(style, law.name), percent(law.worst));
        out.push_str(&format!(
            "    law        {name}: {share} of what is allowed\n"
        ));
    }
    out.push_str(&trouble(report, width));
    out
}

/// What went wrong besides the answers.
fn trouble(report: &MethodReport, width: usize) -> String {
    let trouble = report.candidate.as_ref().and_then(|c| c.trouble.as_ref());
    let text = trouble.map(|t| paragraph(t, 2, width));
    text.map_or(String::new(), |t| format!("{}\n", paint(BAD, t.trim_end())))
}

/// The failing cases to look at first: the worst over budget, those of each wrong kind, and then
/// others; each once.
pub fn failing(report: &MethodReport, most: usize) -> Vec<&CaseReport> {
    let over = report.worst.iter();
    let over = over.filter(|c| c.judgement.verdict != Verdict::Pass && !is_recorded(report, c));
    let all = over.chain(&report.wrong).chain(&report.failures);
    let mut chosen: Vec<&CaseReport> = Vec::new();
    for case in all {
        let same =
            |c: &&CaseReport| c.case.region == case.case.region && c.case.order(&case.case).is_eq();
        if chosen.len() < most && !chosen.iter().any(same) {
            chosen.push(case);
        }
    }
    chosen
}

/// Whether a case over budget is a recorded one: it is in no list of failures.
fn is_recorded(report: &MethodReport, case: &CaseReport) -> bool {
    case.case.region == "hard"
        && report.recorded > 0
        && !report
            .failures
            .iter()
            .any(|f| f.case.order(&case.case).is_eq())
}

fn heading(report: &MethodReport, width: usize) -> String {
    let (word, tone) = verdict(report);
    let recorded = match report.recorded {
        0 => String::new(),
        n => format!(", {n} over budget as recorded"),
    };
    let count = format!("{} of {} cases{recorded}", report.passed, report.cases);
    let used = report.method.chars().count() + word.len() + 2 + count.len();
    let gap = width.saturating_sub(used).max(2);
    let line = |label: &str, text: &str| format!("  {label:<10} {}\n", wrap(text, 13, width));
    let mut out = format!(
        "{}{}{}  {count}\n{}",
        paint(BOLD, report.method),
        " ".repeat(gap),
        paint(style::of(tone), word),
        paragraph(report.summary, 2, width)
    );
    if let Some(c) = &report.candidate {
        out.push_str(&line("candidate", &candidate(c)));
    }
    out.push_str(&line("budget", &budgets(report)));
    for bound in &report.proved {
        out.push_str(&line("proved", &proved(bound)));
    }
    out
}

/// The errors of a row.
fn errors(s: &Spread) -> [(String, Style); 4] {
    let number = |x: f64| (short_if(s.count > 0, x), PLAIN);
    let max = match s.beyond {
        0 => number(s.max),
        _ => (">1e308".into(), BAD),
    };
    [max, number(s.p99), number(s.median), number(s.rms)]
}

fn wrong(of: &Kinds) -> (String, Style) {
    match of.total() {
        0 => ("–".into(), DIM),
        _ => (kinds(of), BAD),
    }
}

fn outputs(report: &MethodReport, width: usize) -> String {
    let header = [
        "output",
        "values",
        "worst ulps",
        "p99",
        "median",
        "RMS",
        "u(1+cond)",
        "of budget",
        "condition",
        "wrong",
    ];
    let mut table = Table::new(&header, &[0, 9]);
    for s in report.outputs() {
        let mut row = vec![(s.name.into(), PLAIN), (s.values.to_string(), DIM)];
        row.extend(errors(&s.ulps));
        row.push((short_if(s.conditioned.count > 0, s.conditioned.max), PLAIN));
        row.push((percent(s.max_of_budget), style::of(share(s.max_of_budget))));
        row.push((short(s.max_condition), DIM));
        row.push(wrong(&s.kinds));
        table.row(row);
    }
    if let Some(norm) = &report.total.normwise {
        let u = |x: f64| (short_if(norm.count > 0, x), PLAIN);
        let mut row = vec![("norm, in u".into(), PLAIN), (norm.count.to_string(), DIM)];
        row.extend([u(norm.max), u(norm.p99), u(norm.median), u(norm.rms)]);
        row.extend(["", "", "", ""].map(|t| (t.into(), PLAIN)));
        table.row(row);
    }
    let dispensable = ["condition", "median", "RMS", "p99"];
    let mut out = table
        .fitted(width.saturating_sub(2), &dispensable)
        .render(2);
    for s in report.outputs() {
        if let Some(parts) = s.parts {
            let (method, rounding) = (short(parts.method), short(parts.rounding));
            out.push_str(&format!(
                "  worst {}: {method} ulps of the method, {rounding} of rounding\n",
                s.name
            ));
        }
    }
    out
}

/// A line for each region, with the largest figures of all outputs; where cases fail, a line for each
/// output if there are few.
fn regions(report: &MethodReport, width: usize) -> String {
    if report.regions.len() < 2 {
        return String::new();
    }
    let each = |r: &RegionReport| r.failed() > 0 && (2..=FEW).contains(&r.outputs.len());
    let named = report.regions.iter().any(each);
    let header = [
        "region",
        "cases",
        "failed",
        if named { "output" } else { "" },
        "worst ulps",
        "p99",
        "median",
        "RMS",
        "norm, u",
        "of budget",
        "wrong",
    ];
    let mut table = Table::new(&header, &[0, 3, 10]);
    for r in &report.regions {
        let failed = match r.failed() {
            0 => ("–".into(), DIM),
            n => (n.to_string(), BAD),
        };
        let norm = r.normwise.filter(|n| n.count > 0);
        let norm = norm.map_or("–".into(), |n| short(n.max));
        let first = [
            (r.name.to_string(), PLAIN),
            (r.cases.to_string(), DIM),
            failed,
        ];
        let lines: Vec<(&str, Spread, f64)> = match each(r) {
            true => (r.outputs.iter().map(|o| (o.name, o.ulps, o.max_of_budget))).collect(),
            false => vec![("", of_all(&r.outputs), r.max_of_budget)],
        };
        for (k, (name, ulps, of_budget)) in lines.iter().enumerate() {
            let blank = || (String::new(), PLAIN);
            let mut row = match k {
                0 => first.to_vec(),
                _ => vec![blank(), blank(), blank()],
            };
            row.push(((*name).into(), PLAIN));
            row.extend(errors(ulps));
            row.push(match k {
                0 => (norm.clone(), PLAIN),
                _ => blank(),
            });
            row.push((percent(*of_budget), style::of(share(*of_budget))));
            row.push(if k == 0 { wrong(&r.kinds) } else { blank() });
            table.row(row);
        }
    }
    let dispensable = ["median", "RMS", "p99", "norm, u"];
    table
        .fitted(width.saturating_sub(2), &dispensable)
        .render(2)
}

/// The largest of each figure over all outputs.
fn of_all(outputs: &[OutputStatistics]) -> Spread {
    let mut all = Spread::default();
    for s in outputs.iter().map(|o| o.ulps) {
        all.count += s.count;
        all.beyond += s.beyond;
        all.max = all.max.max(s.max);
        all.p99 = all.p99.max(s.p99);
        all.median = all.median.max(s.median);
        all.rms = all.rms.max(s.rms);
    }
    all
}

/// What an error map holds, in a line.
fn on_the_map(map: &ErrorMap) -> String {
    let worst = |o: &crate::audit::MapOutput| {
        let ulps = o.ulps.iter().copied().fold(0.0, f64::max);
        format!("{} {}", o.name, short(ulps))
    };
    let worst: Vec<String> = map.outputs.iter().map(worst).collect();
    format!(
        "map of {} points: worst ulps {}; {} points do not pass",
        map.points(),
        worst.join(", "),
        map.not_passed
    )
}

fn laws(report: &MethodReport, width: usize) -> String {
    let mut out = String::new();
    for law in &report.laws {
        let (mark, tone) = mark(law);
        let text = format!(
            "{}: {} (worst residual {} of what is allowed, {} cases)",
            law.name,
            law.statement,
            percent(law.worst),
            law.cases
        );
        out.push_str(&format!("  {} ", paint(style::of(tone), mark)));
        out.push_str(&wrap(&text, 4, width));
        out.push('\n');
        if !holds(law)
            && let Some(worst) = &law.worst_case
        {
            out.push_str(&case::input(worst, 4));
            out.push_str(&format!("    reproduce  {}\n", report.again(worst)));
        }
    }
    out
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::audit::{
        Budget, Case, ComponentJudgement, ErrorParts, Format, Judgement, LawReport, Limit, Octave,
        Origin, OutputBudget, Proof, Reproduce, Settings, SolverAnswer,
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
                reason: Some("phi2 (value 0) is 1.750 times its budget off".into()),
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
            "FAIL  399 of 400 cases",
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

    /// With two outputs, one of two regions in which a case fails, and the other with an error beyond all numbers.
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
a-method                                                                        FAIL  399 of 400 cases
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
    phi2 (value 0) is 1.750 times its budget off
    input  unit  decimal  hexadecimal
                     0.1  0x1.999999999999ap-4
                    -2.0  -0x1p+1
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

    /// A case of the hard region that is over budget comes first, unless it is recorded: then it is among no failures.
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
}
