//! Verdicts on a paper.

use super::Tone;
use super::numbers::count;
use crate::papers::{EntryVerdict, Finding, FindingVerdict, PaperReport, Subject};

/// Subjects in the order of a report.
pub const SUBJECTS: [(Subject, &str); 4] = [
    (Subject::Data, "Data"),
    (Subject::Tables, "Tables"),
    (Subject::Formula, "Formulas"),
    (Subject::Claim, "Claims"),
];

/// The findings about a subject.
pub fn of_subject(report: &PaperReport, subject: Subject) -> Vec<&Finding> {
    let of = |f: &&Finding| f.subject == subject;
    report.findings.iter().filter(of).collect()
}

/// Mark, words and tone of a verdict.
pub fn mark(verdict: FindingVerdict) -> (&'static str, &'static str, Tone) {
    match verdict {
        FindingVerdict::Confirmed => ("✓", "confirmed", Tone::Good),
        FindingVerdict::ErrorOfPaper => ("✗", "error of the paper", Tone::Bad),
        FindingVerdict::PrintOrScan => ("~", "print or scan", Tone::Doubt),
        FindingVerdict::Refuted => ("✗", "refuted", Tone::Bad),
        FindingVerdict::Recovered => ("+", "recovered", Tone::New),
        FindingVerdict::Unexplained => ("?", "unexplained", Tone::Doubt),
    }
}

/// The verdict on a printed entry, as in CSV and JSON.
pub fn entry(verdict: EntryVerdict) -> &'static str {
    match verdict {
        EntryVerdict::Agrees => "agrees",
        EntryVerdict::Rounding => "rounding",
        EntryVerdict::Misprint => "misprint",
        EntryVerdict::Unexplained => "unexplained",
    }
}

/// How many findings of each kind.
pub fn kinds(report: &PaperReport) -> String {
    use FindingVerdict as V;
    let kinds = [
        (V::Confirmed, "confirmed", "confirmed"),
        (V::ErrorOfPaper, "error of the paper", "errors of the paper"),
        (V::Refuted, "refuted", "refuted"),
        (V::PrintOrScan, "of print or scan", "of print or scan"),
        (V::Recovered, "recovered", "recovered"),
        (V::Unexplained, "unexplained", "unexplained"),
    ];
    let number = |v| report.findings.iter().filter(|f| f.verdict == v).count();
    let parts = kinds.map(|(v, one, many)| (number(v), one, many));
    let parts = parts.iter().filter(|k| k.0 > 0);
    let parts: Vec<String> = parts
        .map(|(n, one, many)| format!("{n} {}", if *n == 1 { one } else { many }))
        .collect();
    parts.join(", ")
}

/// How many findings are not as recorded.
pub fn recorded(changed: usize) -> String {
    match changed {
        0 => "all as recorded".into(),
        n => format!("{n} NOT as recorded"),
    }
}

/// How many findings there are of what kind.
pub fn findings(report: &PaperReport) -> String {
    let all = count(report.findings.len(), "finding");
    format!("{all}: {}", kinds(report))
}

/// How many findings there are, and whether they are as recorded.
pub fn counts(report: &PaperReport) -> String {
    let changed = report.findings.iter().filter(|f| !f.as_recorded).count();
    format!(
        "{}; {}. {} printed entries recomputed.",
        findings(report),
        recorded(changed),
        report.entries.len()
    )
}
