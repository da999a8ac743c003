//! The report of an audit as JUnit XML: a suite for each method, a test for each region and law.
//! Budgets, candidate and settings are properties of the suite.

use super::text::case;
use super::text::method::failing;
use super::text::style::plain;
use super::words::audit::{budgets, candidate, holds, kinds, settings, undecided};
use super::words::numbers::{percent, short};
use crate::audit::{CaseReport, MethodReport, RegionReport};
use quick_junit::{NonSuccessKind, Property, Report, TestCase, TestCaseStatus, TestSuite};

/// The text of the first failing cases of a region goes with its failure.
const FAILURES_SHOWN: usize = 5;

/// The document.
pub fn document(reports: &[MethodReport]) -> Result<String, quick_junit::SerializeError> {
    let mut all = Report::new("mechaudit");
    for report in reports {
        all.add_test_suite(suite(report));
    }
    all.to_string()
}

fn suite(report: &MethodReport) -> TestSuite {
    let mut suite = TestSuite::new(report.method);
    suite.add_property(Property::new("budget", budgets(report)));
    suite.add_property(Property::new("settings", settings(&report.settings)));
    if let Some(c) = &report.candidate {
        suite.add_property(Property::new("candidate", candidate(c)));
    }
    for region in &report.regions {
        let status = match region.failed() {
            0 => TestCaseStatus::success(),
            _ => failure(report, region),
        };
        let mut test = TestCase::new(region.name, status);
        test.set_system_out(figures(region));
        suite.add_test_case(test);
    }
    for law in &report.laws {
        let status = match holds(law) {
            true => TestCaseStatus::success(),
            false => failed(format!("residual {} times what is allowed", law.worst)),
        };
        suite.add_test_case(TestCase::new(format!("law {}", law.name), status));
    }
    let trouble = report.candidate.as_ref().and_then(|c| c.trouble.clone());
    if report.cases == 0 && !report.interrupted {
        suite.add_test_case(TestCase::new("some cases", failed("there are no cases")));
    }
    if let Some(trouble) = trouble {
        suite.add_test_case(TestCase::new("the program", failed(trouble)));
    }
    if report.interrupted {
        let status = failed(format!("interrupted after {} cases", report.cases));
        suite.add_test_case(TestCase::new("not interrupted", status));
    }
    suite
}

fn failed(message: impl Into<quick_junit::XmlString>) -> TestCaseStatus {
    let mut status = TestCaseStatus::non_success(NonSuccessKind::Failure);
    status.set_message(message);
    status
}

/// The findings in a region, a line for each output.
fn figures(region: &RegionReport) -> String {
    let line = |o: &crate::audit::OutputStatistics| {
        format!(
            "{}: {} values, worst {} ulps, p99 {}, median {}, RMS {}, {} of budget",
            o.name,
            o.values,
            short(o.ulps.max),
            short(o.ulps.p99),
            short(o.ulps.median),
            short(o.ulps.rms),
            percent(o.max_of_budget)
        )
    };
    let lines: Vec<String> = region.outputs.iter().map(line).collect();
    lines.join("\n")
}

fn failure(report: &MethodReport, region: &RegionReport) -> TestCaseStatus {
    let all = failing(report, usize::MAX).into_iter();
    let cases: Vec<&CaseReport> = all.filter(|f| f.case.region == region.name).collect();
    let reason = cases.first().and_then(|f| f.judgement.why());
    let parts = [
        format!("{} of {} cases fail", region.failed(), region.cases),
        kinds(&region.kinds),
        undecided(region),
        reason.map_or(String::new(), |r| format!("the worst: {r}")),
    ];
    let parts: Vec<String> = parts.into_iter().filter(|p| !p.is_empty()).collect();
    let mut status = failed(parts.join("; "));
    let texts = cases.iter().take(FAILURES_SHOWN).map(|f| {
        plain(&case::text(
            f,
            &report.layout,
            &report.reproduce_command(&f.case),
            100,
        ))
    });
    status.set_description(texts.collect::<Vec<String>>().join("\n"));
    status
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::audit::CandidateReport;
    use crate::report::text::method::tests::{fabricated, passing};

    fn failures(report: &MethodReport) -> Vec<(String, String)> {
        let cases = suite(report).test_cases;
        let failed = cases.into_iter().filter_map(|c| match c.status {
            TestCaseStatus::NonSuccess { message, .. } => Some((
                c.name.to_string(),
                message.map_or(String::new(), |m| m.to_string()),
            )),
            _ => None,
        });
        failed.collect()
    }

    /// Whatever keeps a method from passing is a test that fails, with its reason.
    #[test]
    fn all_that_fails_is_a_failure() {
        assert_eq!(failures(&passing()), []);
        let failing = fabricated();
        let regions = failing.regions.iter().filter(|r| r.failed() > 0);
        let found = failures(&failing);
        assert!(regions.clone().count() > 0 && found.len() == regions.clone().count());
        for (region, (name, why)) in regions.zip(found) {
            let due = format!("{} of {} cases fail", region.failed(), region.cases);
            assert!(
                name == region.name && why.starts_with(&due),
                "{name}: {why}"
            );
        }
        let only = |change: fn(&mut MethodReport)| {
            let mut report = passing();
            change(&mut report);
            failures(&report)
        };
        let one = |name: &str, why: &str| vec![(name.to_string(), why.to_string())];
        assert_eq!(only(|r| r.cases = 1), []);
        assert_eq!(
            only(|r| r.cases = 0),
            one("some cases", "there are no cases")
        );
        let trouble = only(|r| {
            r.candidate = Some(CandidateReport {
                trouble: Some("it stopped".into()),
                ..CandidateReport::default()
            });
        });
        assert_eq!(trouble, one("the program", "it stopped"));
        let interrupted = only(|r| (r.cases, r.interrupted) = (0, true));
        assert_eq!(
            interrupted,
            one("not interrupted", "interrupted after 0 cases")
        );
        let law = only(|r| r.laws[0].worst = f64::NAN);
        assert_eq!(law, one("law energy", "residual NaN times what is allowed"));
    }

    #[test]
    fn a_suite_has_properties_a_test_for_each_region_and_the_first_failures_in_full() {
        let mut report = fabricated();
        report.candidate = Some(CandidateReport {
            name: "other".into(),
            answered: 1,
            ..CandidateReport::default()
        });
        report.regions[0].undecided = 2;
        report.regions[0].kinds[crate::audit::Kind::Nan] = 1;
        let one = report.failures[0].clone();
        report.worst.clear();
        let case = |index| {
            let mut other = one.clone();
            other.case.origin = crate::audit::Origin::Random { seed: 1, index };
            other.judgement.reason = Some(format!("reason {index}").into());
            other
        };
        report.failures = (0..7).map(case).collect();
        let suite = suite(&report);
        let properties: Vec<(&str, &str)> = suite
            .properties
            .iter()
            .map(|p| (p.name.as_str(), p.value.as_str()))
            .collect();
        let run = settings(&report.settings);
        let due = [
            ("budget", "phi2: 4 ulp"),
            ("settings", run.as_str()),
            ("candidate", "other, 1 answer"),
        ];
        assert_eq!(properties, due);
        let names: Vec<&str> = suite.test_cases.iter().map(|c| c.name.as_str()).collect();
        assert_eq!(names, ["wide", "near", "law energy"]);
        let out = suite.test_cases[0].system_out.as_ref().unwrap().as_str();
        let figures = "phi2: 400 values, worst 7.25 ulps, p99 1.50, median 0.300, RMS 0.400, 175.0 % of budget";
        assert_eq!(out, figures);
        let TestCaseStatus::NonSuccess {
            message,
            description,
            ..
        } = &suite.test_cases[0].status
        else {
            panic!("it fails");
        };
        let nan = crate::audit::Kind::Nan.name();
        let due = format!("1 of 400 cases fail; 1 {nan}; 2 cases undecided; the worst: reason 0");
        assert_eq!(message.as_ref().unwrap().as_str(), due);
        let text = description.as_ref().unwrap().as_str();
        assert_eq!(
            text.matches("    reproduce  ").count(),
            FAILURES_SHOWN,
            "{text}"
        );
        assert!(
            text.contains("--case 4\n") && !text.contains("--case 5"),
            "{text}"
        );
        // None of the cases written out is of the other region.
        let TestCaseStatus::NonSuccess { message, .. } = &suite.test_cases[1].status else {
            panic!("it fails");
        };
        let due = "1 of 400 cases fail";
        assert_eq!(message.as_ref().unwrap().as_str(), due);
        let both = document(&[report, passing()]).unwrap();
        assert_eq!(both.matches("<testsuite ").count(), 2, "{both}");
    }
}
