//! Tests of `paper`, and a report for those of other forms.

use super::*;
use crate::papers::{
    Citation, Entry, EntryVerdict, Figure, FindingVerdict, SCHEMA_VERSION, Subject,
    VariantJudgement,
};
use crate::report::gallery::Gallery;

/// A report that exists for tests.
pub fn fabricated() -> PaperReport {
    let result = |units: f64, verdict, note: Option<&str>| VariantJudgement {
        recomputed: "1.2345678901234567890".into(),
        units_in_last_digit: units,
        verdict,
        note: note.map(Into::into),
    };
    let entry = |row, column, printed: &str, a: VariantJudgement, b: VariantJudgement| Entry {
        table: 1,
        row,
        column,
        printed: printed.into(),
        variants: [("as_printed", a), ("recovered", b)].into(),
    };
    use EntryVerdict as E;
    PaperReport {
        schema_version: SCHEMA_VERSION,
        mechaudit_version: "0.0.0",
        paper: Citation {
            key: "nobody",
            authors: "A. Nobody",
            title: "On <tests> & such",
            year: Some(1900),
            venue: "Proceedings of Nowhere 1, 1–2",
            source: "",
        },
        findings: vec![
            Finding {
                id: "mass",
                subject: Subject::Data,
                place: "Section 2",
                title: "The mass of link 4 is not printed".into(),
                verdict: FindingVerdict::Recovered,
                text: "It follows from the moments of Table 3, which are linear in it. ".repeat(3),
                figures: vec![Figure {
                    name: "mass of link 4".into(),
                    value: "550".into(),
                    unit: "kg",
                    latex: None,
                }],
                as_recorded: true,
            },
            Finding {
                id: "claim",
                subject: Subject::Claim,
                place: "Conclusion",
                title: "The step is small enough".into(),
                verdict: FindingVerdict::Refuted,
                text: "It is not.".into(),
                figures: vec![],
                as_recorded: false,
            },
        ],
        tallies: vec![Tally {
            variant: "as_printed",
            table: 1,
            column: "phi2",
            entries: 3,
            within_half: 2,
            within_one: 2,
            worst_units: 12.0,
            worst: 0.012,
        }],
        entries: vec![
            entry(
                0,
                "phi2",
                "1.235",
                result(0.2, E::Agrees, None),
                result(0.1, E::Agrees, None),
            ),
            entry(
                1,
                "phi2",
                "1.243",
                result(12.0, E::Misprint, Some("3 for 5")),
                result(0.7, E::Rounding, None),
            ),
            entry(
                1,
                "phi3",
                "9.9",
                result(86.0, E::Unexplained, None),
                result(1.5, E::Unexplained, None),
            ),
        ],
    }
}

/// Findings by subject within the width, figures with leaders as far as there is room, and a table
/// of tallies for each table in order, in the colour of how many agree.
#[test]
fn papers() {
    let mut all = Gallery::default();
    let mut report = fabricated();
    for width in [60, 100] {
        all.add(format!("on {width}"), paper(&report, width));
    }
    let of = |table, variant, (entries, within_half, within_one)| Tally {
        table,
        variant,
        entries,
        within_half,
        within_one,
        ..fabricated().tallies.remove(0)
    };
    report.paper.year = None;
    report.findings.truncate(1);
    report.tallies = vec![
        of(3, "as_printed", (4, 4, 4)),
        of(2, "as_printed", (4, 3, 4)),
        of(3, "recovered", (4, 1, 3)),
        of(3, "other", (4, 0, 2)),
        of(3, "fourth", (5, 0, 2)),
        of(3, "fifth", (4, 0, 0)),
    ];
    all.add("tallies", paper(&report, 90));
    report.tallies.clear();
    all.add("no tallies", paper(&report, 90));
    let figure = |name: &str, value: &str| Figure {
        name: name.into(),
        value: value.into(),
        unit: "1",
        latex: None,
    };
    let mut found = fabricated().findings.remove(1);
    found.text = "aaa bbb ccc".into();
    for width in [80, 44, 43, 20, 19, 12] {
        found.figures = vec![
            figure("a", "1"),
            figure("abcde", "2"),
            figure("ab", "one two"),
        ];
        all.add(format!("figures on {width}"), finding(&found, width));
    }
    all.pin("papers");
}
