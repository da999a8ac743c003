//! Verdicts of an audit.

use super::Tone;
use super::numbers::{count, short_if};
use crate::audit::{
    CandidateReport, Kinds, LawReport, MethodReport, OutputStatistics, ProvedBound, RegionReport,
    Spread, Verdict,
};

/// The verdict on a method.
pub fn verdict(report: &MethodReport) -> (&'static str, Tone) {
    match report.passed() {
        true => ("pass", Tone::Good),
        false if report.interrupted => ("interrupted", Tone::Bad),
        false => ("FAIL", Tone::Bad),
    }
}

/// The number of cases that failed, or of those that passed where none did.
pub fn cases(report: &MethodReport) -> String {
    let recorded = match report.recorded {
        0 => String::new(),
        n => format!(", {n} over budget as recorded"),
    };
    let all = report.cases;
    match report.failed() {
        0 if report.passed() => format!("{} of {all} cases{recorded}", report.passed),
        0 => format!("{} of {all} cases passed{recorded}", report.passed),
        n => format!("{n} of {all} cases failed{recorded}"),
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
    /// Largest share of a budget; NaN where there is none.
    pub of_budget: f64,
}

impl Worst {
    /// The worst of this report.
    pub fn of(report: &MethodReport) -> Worst {
        let spread = |of: fn(&OutputStatistics) -> &Spread| {
            let all = || report.outputs().iter().map(of).filter(|s| s.count > 0);
            let max = all().map(|s| s.max).fold(0.0, f64::max);
            short_if(all().next().is_some(), max)
        };
        Worst {
            ulps: spread(|o| &o.ulps),
            conditioned: spread(|o| &o.conditioned),
            of_budget: report.total.max_of_budget,
        }
    }
}

/// The number of each wrong kind.
pub fn kinds(of: &Kinds) -> String {
    let each = of.nonzero().map(|(kind, n)| format!("{n} {}", kind.name()));
    each.collect::<Vec<_>>().join(", ")
}

/// Cases that the reference left open; nothing if there are none.
pub fn undecided(of: &RegionReport) -> String {
    let part = |n: u64, what: &str| match n {
        0 => None,
        n => Some(format!("{} {what}", count(n as usize, "case"))),
    };
    let parts = [
        part(of.undecided, "undecided"),
        part(of.reference_failed, "at which the reference failed"),
    ];
    parts.into_iter().flatten().collect::<Vec<_>>().join(", ")
}

/// Whose code it is, and how many answers it gave.
pub fn candidate(of: &CandidateReport) -> String {
    let version = of.version.as_ref();
    let version = version.map_or(String::new(), |v| format!(" {v}"));
    let command = of.command.as_ref().filter(|c| **c != of.name);
    let command = command.map_or(String::new(), |c| format!(" ({c})"));
    let answers = count(of.answered as usize, "answer");
    format!("{}{version}{command}, {answers}", of.name)
}

/// The budgets in force, those that outputs share once.
pub fn budgets(report: &MethodReport) -> String {
    let mut groups: Vec<(Vec<&str>, String)> = Vec::new();
    for o in &report.budgets {
        let limit = o.budget.limit.to_string();
        match groups.iter_mut().find(|g| g.1 == limit) {
            Some(group) => group.0.push(o.name),
            None => groups.push((vec![o.name], limit)),
        }
    }
    let each = groups.iter();
    let mut all: Vec<String> = each
        .map(|(names, limit)| format!("{}: {limit}", names.join(", ")))
        .collect();
    let norm = report.norm_budget.map(|n| n.shown(report.format));
    all.extend(norm.map(|n| format!("all together: {n}")));
    if report.format == crate::audit::Format::Single {
        all.push("in single precision, u = 2⁻²⁴".into());
    }
    all.join("; ")
}

/// A proved bound, and how it is proved.
pub fn proved(bound: &ProvedBound) -> String {
    let ProvedBound {
        error,
        inputs,
        command,
    } = bound;
    format!("error at most {error} for {inputs}: {command}")
}

/// How near a budget so large a share of it is.
pub fn share(of_budget: f64) -> Tone {
    match of_budget {
        x if x <= 0.5 || x.is_nan() => Tone::Plain,
        x if x <= 1.0 => Tone::Doubt,
        _ => Tone::Bad,
    }
}

/// Returns true if a law holds: a residual that is no number breaks it.
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

/// The number of methods and cases that pass.
pub fn totals(reports: &[MethodReport]) -> String {
    let sum = |of: fn(&MethodReport) -> u64| reports.iter().map(of).sum::<u64>() as usize;
    let recorded = match sum(|r| r.recorded) {
        0 => String::new(),
        n => format!(", {n} over budget as recorded"),
    };
    let cases = sum(|r| r.cases);
    let (all, good) = (reports.len(), sum(|r| u64::from(r.passed())));
    match good == all {
        true => {
            let pass = if all == 1 { "passes" } else { "pass" };
            format!(
                "{} {pass}, {}{recorded}",
                count(all, "method"),
                count(cases, "case")
            )
        }
        false => {
            let failed = sum(MethodReport::failed);
            format!("{good} of {all} methods pass, {failed} of {cases} cases failed{recorded}")
        }
    }
}

/// Returns true if every method passes; an audit of nothing does not.
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
mod tests;
