//! Tests of `paper`, and a report for those of other forms.

use super::*;
use crate::papers::{
    Citation, Entry, EntryVerdict, Figure, FindingVerdict, SCHEMA_VERSION, Subject,
    VariantJudgement,
};

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

#[test]
fn findings_by_subject_with_marks_and_width() {
    for width in [60, 100] {
        let text = paper(&fabricated(), width);
        let text = style::plain(&text);
        for part in [
            "Data\n",
            "Claims\n",
            "+ The mass",
            "✗ The step",
            "NOT AS RECORDED",
            "550 kg",
        ] {
            assert!(text.contains(part), "{part} is missing in\n{text}");
        }
        let prose = text.split("Table 1").next().unwrap();
        assert!(prose.lines().all(|l| l.chars().count() <= width), "{text}");
    }
}

/// Green where all are rounded correctly, plain where all are within a unit, yellow where half are,
/// red below.
#[test]
fn tallies_have_the_colour_of_how_many_agree() {
    let of = |entries, within_half, within_one| {
        tallies(&[Tally {
            variant: "as_printed",
            table: 1,
            column: "phi2",
            entries,
            within_half,
            within_one,
            worst_units: 12.0,
            worst: 0.012,
        }])
    };
    for ((entries, half, one), style) in [
        ((4, 4, 4), Some(GOOD)),
        ((4, 3, 4), None),
        ((4, 1, 3), Some(DOUBT)),
        ((4, 0, 2), Some(DOUBT)),
        ((5, 0, 2), Some(BAD)),
        ((4, 0, 0), Some(BAD)),
    ] {
        let text = of(entries, half, one);
        for other in [GOOD, DOUBT, BAD] {
            let painted = text.contains(&other.render().to_string());
            assert_eq!(
                painted,
                Some(other) == style,
                "{one} of {entries}: {text:?}"
            );
        }
    }
}

#[test]
fn a_paper_has_its_citation_findings_and_tallies() {
    let mut report = fabricated();
    report.findings.truncate(1);
    report.findings[0].text = "It follows.".into();
    let text = style::plain(&paper(&report, 90));
    let due = "\
A. Nobody (1900). On <tests> & such. Proceedings of Nowhere 1, 1–2.

1 finding: 1 recovered; all as recorded. 3 printed entries recomputed.

Data

  + The mass of link 4 is not printed [recovered; Section 2]
    It follows.
      mass of link 4 ... 550 kg

Table 1: entries that agree
  data        column  entries  within ½ unit  within 1  worst units  worst deviation
  as printed  phi2          3              2         2        12.00            0.012
  Units of the last printed digit; within ½ is the correct rounding.
";
    assert_eq!(text, due);
    report.tallies.clear();
    report.paper.year = None;
    let text = style::plain(&paper(&report, 90));
    assert!(
        text.starts_with("A. Nobody. On") && text.ends_with("550 kg\n"),
        "{text}"
    );
}

#[test]
fn every_table_has_its_own_tallies_in_order() {
    let tally = |table, variant| Tally {
        table,
        variant,
        ..fabricated().tallies.remove(0)
    };
    let all = [
        tally(3, "as_printed"),
        tally(2, "as_printed"),
        tally(3, "recovered"),
    ];
    let text = style::plain(&tallies(&all));
    let heads: Vec<&str> = text.lines().filter(|l| l.starts_with("Table")).collect();
    assert_eq!(
        heads,
        ["Table 2: entries that agree", "Table 3: entries that agree"]
    );
    let (second, third) = text.split_once("Table 3").unwrap();
    assert_eq!(
        (
            second.matches("phi2").count(),
            third.matches("phi2").count()
        ),
        (1, 2)
    );
}

/// Up to a common column, which leaves forty characters for values; a line that is too long is
/// wrapped.
#[test]
fn figures_have_leaders_as_far_as_there_is_room() {
    let figure = |name: &str, value: &str| Figure {
        name: name.into(),
        value: value.into(),
        unit: "1",
        latex: None,
    };
    let of = |figures: Vec<Figure>, width| {
        let mut finding = fabricated().findings.remove(1);
        finding.as_recorded = true;
        finding.figures = figures;
        let text = style::plain(&super::finding(&finding, width));
        let lines = text.lines().filter(|l| l.starts_with("      "));
        lines.map(String::from).collect::<Vec<_>>()
    };
    let two = || vec![figure("a", "1"), figure("abcde", "2")];
    assert_eq!(of(two(), 80), ["      a ....... 1", "      abcde ... 2"]);
    // With 44 characters there are four for names.
    assert_eq!(of(two(), 44), ["      a ...... 1", "      abcde ... 2"]);
    assert_eq!(of(two(), 43), ["      a ..... 1", "      abcde ... 2"]);
    assert_eq!(of(two(), 20), ["      a ... 1", "      abcde ... 2"]);
    let long = || vec![figure("ab", "one two")];
    assert_eq!(of(long(), 20), ["      ab ... one two"]);
    assert_eq!(of(long(), 19), ["      ab: one two"]);
    assert!(of(Vec::new(), 80).is_empty());
}

#[test]
fn a_finding_is_wrapped_four_characters_from_the_edge() {
    let mut finding = fabricated().findings.remove(1);
    finding.text = "aaa bbb ccc".into();
    let text = style::plain(&super::finding(&finding, 12));
    assert!(text.ends_with("\n    aaa bbb\n    ccc\n"), "{text}");
}
