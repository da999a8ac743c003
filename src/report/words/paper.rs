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

/// The number of findings of each kind.
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

/// The number of findings that are not as recorded.
pub fn recorded(changed: usize) -> String {
    match changed {
        0 => "all as recorded".into(),
        n => format!("{n} NOT as recorded"),
    }
}

/// The number of findings by kind.
pub fn findings(report: &PaperReport) -> String {
    let all = count(report.findings.len(), "finding");
    format!("{all}: {}", kinds(report))
}

/// The number of findings, and whether they are as recorded.
pub fn counts(report: &PaperReport) -> String {
    let changed = report.findings.iter().filter(|f| !f.as_recorded).count();
    format!(
        "{}; {}. {} printed entries recomputed.",
        findings(report),
        recorded(changed),
        report.entries.len()
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::text::paper::tests::fabricated;

    #[test]
    fn findings_are_counted_by_kind() {
        let mut report = fabricated();
        assert_eq!(
            counts(&report),
            "2 findings: 1 refuted, 1 recovered; 1 NOT as recorded. 3 printed entries recomputed."
        );
        let verdicts = [
            FindingVerdict::Confirmed,
            FindingVerdict::ErrorOfPaper,
            FindingVerdict::ErrorOfPaper,
            FindingVerdict::PrintOrScan,
            FindingVerdict::Unexplained,
        ];
        let one = report.findings[0].clone();
        report.findings = verdicts
            .map(|verdict| Finding {
                verdict,
                ..one.clone()
            })
            .to_vec();
        report.findings[2].as_recorded = false;
        report.findings[3].as_recorded = false;
        report.entries.clear();
        let kinds = "1 confirmed, 2 errors of the paper, 1 of print or scan, 1 unexplained";
        assert_eq!(
            counts(&report),
            format!("5 findings: {kinds}; 2 NOT as recorded. 0 printed entries recomputed.")
        );
        report.findings.truncate(2);
        assert_eq!(
            findings(&report),
            "2 findings: 1 confirmed, 1 error of the paper"
        );
        assert_eq!(recorded(0), "all as recorded");
    }

    #[test]
    fn findings_are_told_apart_by_their_subject() {
        let report = fabricated();
        let of = |subject| {
            of_subject(&report, subject)
                .into_iter()
                .map(|f| f.id)
                .collect::<Vec<_>>()
        };
        assert_eq!(
            (of(Subject::Data), of(Subject::Claim)),
            (vec!["mass"], vec!["claim"])
        );
        assert!(of(Subject::Tables).is_empty() && of(Subject::Formula).is_empty());
    }
}
