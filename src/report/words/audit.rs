//! Verdicts of an audit.

use super::Tone;
use super::numbers::{count, short_if};
use crate::audit::{LawReport, MethodReport, OutputStatistics, Spread, Verdict};

/// The verdict on a method.
pub fn verdict(report: &MethodReport) -> (&'static str, Tone) {
    match report.passed() {
        true => ("pass", Tone::Good),
        false if report.interrupted => ("interrupted", Tone::Bad),
        false => ("FAIL", Tone::Bad),
    }
}

/// The verdict on a case.
pub fn of_case(verdict: Verdict) -> (&'static str, Tone) {
    match verdict {
        Verdict::Pass => ("pass", Tone::Good),
        Verdict::Undecided => ("undecided", Tone::Doubt),
        Verdict::Over => ("over budget", Tone::Bad),
        Verdict::WrongKind => ("wrong kind", Tone::Bad),
        Verdict::OracleError => ("reference failed", Tone::Bad),
    }
}

/// The worst found of a method, over all its outputs.
pub struct Worst {
    /// In ulps.
    pub ulps: String,
    /// In u (1 + condition).
    pub conditioned: String,
    /// Largest share of a budget.
    pub of_budget: f64,
}

impl Worst {
    /// The worst of this report.
    pub fn of(report: &MethodReport) -> Worst {
        let spread = |of: fn(&OutputStatistics) -> &Spread| {
            let all = || report.outputs.iter().map(of).filter(|s| s.count > 0);
            let max = all().map(|s| s.max).fold(0.0, f64::max);
            short_if(all().next().is_some(), max)
        };
        let shares = report.outputs.iter().map(|o| o.max_of_budget);
        Worst {
            ulps: spread(|o| &o.ulps),
            conditioned: spread(|o| &o.conditioned),
            of_budget: shares.fold(0.0, f64::max),
        }
    }
}

/// How near a budget so large a share of it is.
pub fn share(of_budget: f64) -> Tone {
    match of_budget {
        x if x <= 0.5 => Tone::Plain,
        x if x <= 1.0 => Tone::Doubt,
        _ => Tone::Bad,
    }
}

/// Whether a law holds: a residual that is no number breaks it.
pub fn holds(law: &LawReport) -> bool {
    law.worst <= 1.0
}

/// Mark of a law that holds or does not.
pub fn mark(law: &LawReport) -> (&'static str, Tone) {
    match holds(law) {
        true => ("✓", Tone::Good),
        false => ("✗", Tone::Bad),
    }
}

/// How many methods and cases pass.
pub fn totals(reports: &[MethodReport]) -> String {
    let sum = |of: fn(&MethodReport) -> usize| reports.iter().map(of).sum::<usize>();
    let recorded = match sum(|r| r.recorded) {
        0 => String::new(),
        n => format!(", {n} over budget as recorded"),
    };
    let (cases, passed) = (sum(|r| r.cases), sum(|r| r.passed));
    let (all, good) = (reports.len(), sum(|r| usize::from(r.passed())));
    match good == all {
        true => {
            let pass = if all == 1 { "passes" } else { "pass" };
            format!(
                "{} {pass}, {}{recorded}",
                count(all, "method"),
                count(cases, "case")
            )
        }
        false => format!("{good} of {all} methods pass, {passed} of {cases} cases{recorded}"),
    }
}

/// Whether every method passes; an audit of nothing does not.
pub fn all_pass(reports: &[MethodReport]) -> bool {
    !reports.is_empty() && reports.iter().all(MethodReport::passed)
}

/// How an audit was done.
pub fn settings(s: &crate::audit::Settings) -> String {
    format!(
        "seed {}, {} random cases per region, references from {} to {} bits",
        s.seed, s.cases_per_region, s.first_bits, s.last_bits
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::text::method::tests::fabricated;

    #[test]
    fn one_failing_method_or_none_at_all_is_no_pass() {
        let failing = fabricated();
        let mut passing = fabricated();
        passing.passed = passing.cases;
        passing.failures.clear();
        assert!(all_pass(&[passing.clone(), passing.clone()]));
        assert!(!all_pass(&[passing.clone(), failing.clone()]) && !all_pass(&[]));
        assert_eq!(totals(&[passing.clone()]), "1 method passes, 400 cases");
        assert_eq!(
            totals(&[passing, failing]),
            "1 of 2 methods pass, 799 of 800 cases"
        );
    }
}
