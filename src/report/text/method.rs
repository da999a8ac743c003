//! A method's report for people.

use super::case;
use super::style::{self, BOLD, DIM, PLAIN, paint, paragraph, wrap};
use super::table::Table;
use crate::audit::{Case, ErrorMap, MethodReport, OutputStatistics};
use crate::report::words::audit::{holds, mark, share, verdict};
use crate::report::words::numbers::{percent, short, short_if};

/// Failing cases printed in full for each method.
const FAILURES_SHOWN: usize = 10;

/// The report of one method. `again` gives the command that judges a case again.
pub fn method(report: &MethodReport, again: &dyn Fn(&Case) -> String, width: usize) -> String {
    let mut out = heading(report, width);
    out.push_str(&outputs(&report.outputs));
    out.push_str(&laws(report, width));
    if let Some(map) = &report.map {
        out.push_str(&paragraph(&on_the_map(map), 2, width));
    }
    for failure in report.failures.iter().take(FAILURES_SHOWN) {
        out.push('\n');
        out.push_str(&case::text(failure, &again(&failure.case), width));
    }
    // What got no answer is said by whoever waited for it.
    let judged = report.failures_left_out - report.unanswered;
    let left = report.failures.len().saturating_sub(FAILURES_SHOWN) + judged;
    if left > 0 {
        let text = format!("{left} more failing cases; --format json lists all of them.");
        out.push_str(&paragraph(&text, 2, width));
    }
    out
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
    format!(
        "{}{}{}  {count}\n{}",
        paint(BOLD, report.method),
        " ".repeat(gap),
        paint(style::of(tone), word),
        paragraph(report.summary, 2, width)
    )
}

fn outputs(statistics: &[OutputStatistics]) -> String {
    let mut table = Table::new(
        &[
            "output",
            "values",
            "worst ulps",
            "p99",
            "RMS",
            "u(1+cond)",
            "of budget",
            "condition",
        ],
        &[0],
    );
    for s in statistics {
        let ulps = |x: f64| short_if(s.ulps.count > 0, x);
        table.row(vec![
            (s.name.into(), PLAIN),
            (s.values.to_string(), DIM),
            (ulps(s.ulps.max), PLAIN),
            (ulps(s.ulps.p99), PLAIN),
            (ulps(s.ulps.rms), PLAIN),
            (short_if(s.conditioned.count > 0, s.conditioned.max), PLAIN),
            (percent(s.max_of_budget), style::of(share(s.max_of_budget))),
            (short(s.max_condition), DIM),
        ]);
    }
    let mut out = table.render(2);
    for s in statistics {
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
            out.push_str(&format!("    reproduce  {}\n", worst.reproduce()));
        }
    }
    out
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::audit::{
        CaseReport, ComponentJudgement, ErrorParts, Judgement, LawReport, Origin, Proof, Settings,
        SolverAnswer, Spread, Verdict,
    };

    /// A report that exists for tests.
    pub fn fabricated() -> MethodReport {
        let case = Case {
            method: "a-method",
            region: "wide",
            input: vec![0.1, -2.0],
            origin: Origin::Random { seed: 1, index: 17 },
        };
        MethodReport {
            method: "a-method",
            summary: "A method that exists for this test.",
            source: "Nobody (1900), (1)",
            settings: Settings::default(),
            cases: 400,
            passed: 399,
            recorded: 0,
            interrupted: false,
            outputs: vec![OutputStatistics {
                name: "phi2",
                values: 400,
                ulps: Spread {
                    count: 400,
                    max: 7.25,
                    p99: 1.5,
                    rms: 0.4,
                },
                conditioned: Spread::default(),
                histogram: vec![(Some(-2), 399), (Some(2), 1)],
                max_of_budget: 1.75,
                max_condition: 31.0,
                worst: Some(case.clone()),
                parts: Some(ErrorParts {
                    method: 0.125,
                    rounding: 7.25,
                }),
            }],
            laws: vec![LawReport {
                name: "energy",
                statement: "The sum is constant within 4 ulp.",
                cases: 400,
                worst: 0.25,
                worst_case: None,
            }],
            max_normwise: 3.0,
            failures: vec![CaseReport {
                case,
                answer: Some(SolverAnswer::Values(vec![0.75])),
                judgement: Judgement {
                    verdict: Verdict::Over,
                    reason: Some("phi2 (value 0) is 1.750 times its budget off".into()),
                    components: vec![ComponentJudgement {
                        output: "phi2",
                        verdict: Verdict::Over,
                        ulps: 7.25,
                        conditioned: 0.4,
                        of_budget: 1.75,
                        condition: 31.0,
                    }],
                    normwise: 3.0,
                },
                bits: 128,
                reference: vec![Some("0.75000000000000080491".into())],
                radii: vec![1e-30],
                proof: Some(Proof::Exact),
            }],
            failures_left_out: 0,
            unanswered: 0,
            map: None,
        }
    }

    #[test]
    fn a_failing_case_has_all_it_needs() {
        let text = method(&fabricated(), &Case::reproduce, 100);
        let text = style::plain(&text);
        for part in [
            "FAIL  399 of 400 cases",
            "175.0 %",
            "0x1.999999999999ap-4",
            "0.75000000000000080491",
            "mechaudit audit a-method --region wide --seed 1 --case 17",
            "✓ energy",
            "31.00",
            "worst phi2: 0.125 ulps of the method, 7.25 of rounding",
        ] {
            assert!(text.contains(part), "{part} is missing in\n{text}");
        }
        assert!(text.lines().all(|l| l.chars().count() <= 100), "{text}");
    }
}
