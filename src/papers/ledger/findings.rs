//! An entry of a ledger as a finding of a paper's report.

use super::{Ledger, LedgerEntry, Verdict};
use crate::papers::{Draft, Figure, Finding, FindingVerdict, Subject, figures};
use crate::symbolic::Outcome;

/// The contribution of an entry that is wrong, or of a claim about the model that was tested, to
/// the report; nothing for the others.
pub fn finding(e: &LedgerEntry) -> Option<Finding> {
    // Slips of reasoning, not of print: a lost quadrant, a value taken to be zero.
    let slips = e.repair.iter().flat_map(|r| &r.edits);
    let of_the_paper = slips
        .into_iter()
        .any(|s| matches!(s.kind, "quadrant" | "zero for a symbol"));
    let verdict = match e.verdict {
        Verdict::Misprint if of_the_paper => FindingVerdict::ErrorOfPaper,
        Verdict::Misprint => FindingVerdict::PrintOrScan,
        Verdict::Refuted => FindingVerdict::ErrorOfPaper,
        Verdict::Undecided => FindingVerdict::Unexplained,
        Verdict::Model if e.obligations.iter().any(|o| o.printed == Outcome::Refuted) => {
            FindingVerdict::Refuted
        }
        _ => return None,
    };
    let (subject, title) = match e.verdict {
        Verdict::Misprint if !of_the_paper => {
            (Subject::Formula, format!("{} is misprinted", e.place))
        }
        Verdict::Model => (Subject::Claim, e.claim.trim_end_matches('.').to_string()),
        _ => (Subject::Formula, format!("{} is wrong", e.place)),
    };
    let mut figures = Vec::new();
    let mut figure = |name: &str, value: String, latex: Option<String>| {
        figures.push(Figure {
            name: name.into(),
            value,
            unit: "1",
            latex,
        });
    };
    if let Some(f) = &e.printed {
        figure("printed", f.text.clone(), Some(f.latex.clone()));
    }
    if let Some(f) = &e.corrected {
        figure("corrected", f.text.clone(), Some(f.latex.clone()));
    }
    if let Some(r) = &e.repair {
        figure("single edits tried", r.single_edits.to_string(), None);
        figure(
            "single edits that hold",
            r.single_that_hold.to_string(),
            None,
        );
        if r.pairs > 0 {
            figure("pairs of edits tried", r.pairs.to_string(), None);
            figure("pairs that hold", r.pairs_that_hold.to_string(), None);
        }
    }
    let text = match e.note {
        "" => e.claim.to_string(),
        note => format!("{} {note}", e.claim),
    };
    Some(Finding {
        id: e.id,
        subject,
        place: e.place,
        title,
        verdict,
        text,
        figures,
        as_recorded: e.as_recorded,
    })
}

/// The finding that the dimensions of a printed form are wrong.
pub fn dimension(e: &LedgerEntry) -> Option<Finding> {
    let fault = e.dimension.as_ref()?;
    let id = crate::study::intern(&format!("{}-dimension", e.id));
    let printed = e.printed.as_ref()?;
    Some(
        Draft::new(id, Subject::Formula, e.place)
            .verdict(FindingVerdict::ErrorOfPaper)
            .titled(format!("{} has a wrong dimension", e.place))
            .text(format!("By the units of the symbols, {fault}."))
            .figures(figures! { "printed": "{}", printed.text => "1"; })
            .recorded_if(e.as_recorded),
    )
}

/// The finding that the formulas of a ledger are proved, but for those with findings of their own.
pub(in crate::papers) fn proved(
    ledger: &Ledger,
    [id, place]: [&'static str; 2],
    title: impl Into<String>,
    text: &str,
) -> Finding {
    Draft::new(id, Subject::Formula, place)
        .verdict(FindingVerdict::Confirmed)
        .titled(title)
        .text(text)
        .figures(figures! {
            "entries of the ledger": "{}", ledger.entries.len() => "1";
            "proved": "{}", ledger.count(Verdict::Proved) => "1";
        })
        .recorded_if(ledger.as_recorded())
}
