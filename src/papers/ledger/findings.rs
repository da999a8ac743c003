//! An entry of a ledger as a finding of a paper's report.

use super::{LedgerEntry, Verdict};
use crate::papers::{Figure, Finding, FindingVerdict, Subject, figure};
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
        Verdict::Undecided => (Subject::Formula, format!("{} is undecided", e.place)),
        _ => (Subject::Formula, format!("{} is wrong", e.place)),
    };
    let forms = [("printed", &e.printed), ("corrected", &e.corrected)];
    let forms = forms.into_iter().filter_map(|(name, form)| {
        let form = form.as_ref()?;
        Some(Figure {
            latex: Some(form.latex.clone()),
            ..figure(name, &form.text, "1")
        })
    });
    let mut figures: Vec<Figure> = forms.collect();
    if let Some(r) = &e.repair {
        let has_pairs = r.pairs > 0;
        let counts = [
            ("single edits tried", r.single_edits, true),
            ("single edits that hold", r.single_that_hold, true),
            ("pairs of edits tried", r.pairs, has_pairs),
            ("pairs that hold", r.pairs_that_hold, has_pairs),
            ("edits left undecided", r.undecided, r.undecided > 0),
        ];
        let counts = counts.into_iter().filter(|count| count.2);
        figures.extend(counts.map(|(name, count, _)| figure(name, count, "1")));
    }
    let unproved = e.obligations.iter().find(|o| o.printed != Outcome::Proved);
    if let (None, Some(o), true) = (&e.printed, unproved, e.verdict != Verdict::Model) {
        figures.push(figure("requirement", &o.formula.text, "1"));
        let off = o.witness.iter();
        figures.extend(off.map(|w| figure("left side less right side", &w.residual, "1")));
    }
    let text = [e.claim, e.note].join(" ").trim().to_string();
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
    Some(Finding {
        id,
        subject: Subject::Formula,
        place: e.place,
        title: format!("{} has a wrong dimension", e.place),
        verdict: FindingVerdict::ErrorOfPaper,
        text: format!("By the units of the symbols, {fault}."),
        figures: vec![figure("printed", &printed.text, "1")],
        as_recorded: e.as_recorded,
    })
}
