//! The report of an audit as JUnit XML: a suite for each method, a test for each region and law.

use super::text::case;
use super::text::style::plain;
use super::words::audit::holds;
use crate::audit::{CaseReport, MethodReport};
use crate::methods;
use quick_junit::{NonSuccessKind, Report, TestCase, TestCaseStatus, TestSuite};
use std::collections::BTreeMap;

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
    let mut failures: BTreeMap<&str, Vec<&CaseReport>> = BTreeMap::new();
    for f in &report.failures {
        failures.entry(f.case.region).or_default().push(f);
    }
    let domain = methods::find(report.method)
        .map(|m| m.domain())
        .unwrap_or_default();
    let mut regions: Vec<&str> = vec!["check-points", "hard"];
    regions.extend(domain.regions.iter().map(|r| r.name));
    let others = failures.keys().filter(|r| !regions.contains(r));
    regions.extend(others.copied().collect::<Vec<&str>>());
    for region in regions {
        let status = match failures.get(region) {
            None => TestCaseStatus::success(),
            Some(failed) => failure(failed),
        };
        suite.add_test_case(TestCase::new(region, status));
    }
    for law in &report.laws {
        let status = match holds(law) {
            true => TestCaseStatus::success(),
            false => {
                let mut status = TestCaseStatus::non_success(NonSuccessKind::Failure);
                status.set_message(format!("residual {} times what is allowed", law.worst));
                status
            }
        };
        suite.add_test_case(TestCase::new(format!("law {}", law.name), status));
    }
    if (report.cases == 0 && !report.interrupted) || report.failures_left_out > 0 {
        let mut status = TestCaseStatus::non_success(NonSuccessKind::Failure);
        let left = report.failures_left_out;
        status.set_message(format!(
            "{} cases, {left} failing ones not listed",
            report.cases
        ));
        suite.add_test_case(TestCase::new("all cases listed", status));
    }
    if report.interrupted {
        let mut status = TestCaseStatus::non_success(NonSuccessKind::Failure);
        status.set_message(format!("interrupted after {} cases", report.cases));
        suite.add_test_case(TestCase::new("not interrupted", status));
    }
    suite
}

fn failure(failed: &[&CaseReport]) -> TestCaseStatus {
    let mut status = TestCaseStatus::non_success(NonSuccessKind::Failure);
    let reason = failed.first().and_then(|f| f.judgement.reason.clone());
    status.set_message(format!(
        "{} cases fail, the first: {}",
        failed.len(),
        reason.unwrap_or_default()
    ));
    let texts = failed
        .iter()
        .take(FAILURES_SHOWN)
        .map(|f| plain(&case::text(f, &f.case.reproduce(), 100)));
    status.set_description(texts.collect::<Vec<String>>().join("\n"));
    status
}
