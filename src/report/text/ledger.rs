//! A ledger for people.

use super::style::{self, BAD, BOLD, DIM, paint, paragraph, wrap};
use crate::papers::ledger::{Ledger, LedgerEntry, Obligation};
use crate::report::words::ledger::{counts, mark, search, word};
use crate::report::words::numbers::clipped;
use crate::symbolic::Outcome;

/// The whole ledger.
pub fn ledger(ledger: &Ledger, width: usize) -> String {
    let p = &ledger.paper;
    let mut out = paint(
        BOLD,
        &wrap(&format!("{}. {}.", p.authors, p.title), 0, width),
    );
    out.push_str(&format!("\n\n{}", paragraph(&counts(ledger), 0, width)));
    for e in &ledger.entries {
        out.push_str(&entry(e, width));
    }
    out
}

fn labelled(label: &str, text: &str, width: usize) -> String {
    format!("    {label:<11}{}\n", wrap(text, 15, width))
}

fn entry(e: &LedgerEntry, width: usize) -> String {
    let (sign, tone) = mark(e.verdict);
    let head = format!("{} [{}; {}]", e.place, e.verdict.words(), e.id);
    let mut out = format!(
        "\n  {} {}\n",
        paint(style::of(tone), sign),
        wrap(&head, 4, width)
    );
    if !e.as_recorded {
        out.push_str(&format!("    {}\n", paint(BAD, "NOT AS RECORDED")));
    }
    out.push_str(&paragraph(e.claim, 4, width));
    if let Some(f) = &e.printed {
        let label = if e.composed { "composed" } else { "printed" };
        out.push_str(&labelled(label, &f.text, width));
    }
    if let Some(f) = &e.corrected {
        out.push_str(&labelled("corrected", &f.text, width));
    }
    if let Some(fault) = &e.dimension {
        out.push_str(&labelled("dimension", fault, width));
    }
    if let Some(r) = &e.repair {
        for edit in &r.edits {
            let text = format!("{}: {} becomes {}", edit.kind, edit.before, edit.after);
            out.push_str(&labelled("edit", &text, width));
        }
        out.push_str(&labelled("search", &search(r), width));
    }
    for o in &e.obligations {
        out.push_str(&obligation(o, width));
    }
    if !e.note.is_empty() {
        out.push_str(&paragraph(e.note, 4, width));
    }
    out
}

fn obligation(o: &Obligation, width: usize) -> String {
    let mut outcome = word(o.printed).to_string();
    if let Some(c) = o.corrected {
        outcome.push_str(&format!(" as printed, {} as corrected", word(c)));
    }
    let mut out = labelled(
        "requires",
        &format!("{} [{outcome}]", o.formula.text),
        width,
    );
    if o.recorded.is_some() {
        out = labelled("fact", &format!("{} [{outcome}]", o.formula.text), width);
    }
    if o.printed == Outcome::Refuted {
        if let Some(r) = &o.residual {
            let text = labelled("residual", &clipped(r, 300), width);
            out.push_str(&paint(DIM, text.trim_end_matches('\n')));
            out.push('\n');
        }
        if let Some(w) = &o.witness {
            let point: Vec<String> = w.point.iter().map(|(n, v)| format!("{n} = {v}")).collect();
            let at = if point.is_empty() { "" } else { " at " };
            let text = format!("{}{at}{}", w.residual, point.join(", "));
            let text = labelled("witness", &text, width);
            out.push_str(&paint(DIM, text.trim_end_matches('\n')));
            out.push('\n');
        }
    }
    out
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::papers::Citation;
    use crate::papers::ledger::{Item, Kind};

    /// A small ledger with one entry of most kinds.
    pub fn fabricated() -> Ledger {
        let paper = Citation {
            key: "test",
            authors: "A & B",
            title: "On <tests>",
            year: None,
            venue: "Nowhere",
            source: "",
        };
        Ledger::of(
            paper,
            &[
                Item::new("good", "(1)", Kind::Formula)
                    .printed("y = (a + b)^2")
                    .claims("A square.")
                    .requires(&["y = a^2 + 2*a*b + b^2"]),
                Item::new("slip", "(2)", Kind::Formula)
                    .printed("y = a^2 - 2*a*b + b^2")
                    .claims("A square & more.")
                    .requires(&["y = (a + b)^2"])
                    .misprint(1, &["a b"], ""),
                Item::new("claim", "(3)", Kind::Statement)
                    .claims("Nothing.")
                    .model()
                    .but_not("1/2 < 1/3"),
            ],
        )
    }

    #[test]
    fn a_ledger_says_what_was_found() {
        let text = style::plain(&ledger(&fabricated(), 90));
        for part in [
            "3 entries: 1 proved, 1 misprint, 1 model claim tested; all as recorded.",
            "~ (2) [misprint; slip]",
            "printed    y = a^2 - 2*a*b + b^2",
            "corrected  y = a^2 + 2*a*b + b^2",
            "edit       sign: -2*a*b becomes 2*a*b",
            "[refuted as printed, proved as corrected]",
            "residual   -4*a*b",
            "fact       1/2 < 1/3 [refuted]",
        ] {
            assert!(text.contains(part), "{part} is missing in\n{text}");
        }
        assert!(text.lines().all(|l| l.chars().count() <= 90), "{text}");
    }

    #[test]
    fn a_ledger_is_its_paper_its_counts_and_its_entries() {
        let mut all = fabricated();
        all.entries.truncate(1);
        let text = style::plain(&ledger(&all, 90));
        let due = "\
A & B. On <tests>.

1 entries: 1 proved; all as recorded.

  ✓ (1) [proved; good]
    A square.
    printed    y = (a + b)^2
    requires   y = a^2 + 2*a*b + b^2 [proved]
";
        let words = |t: &str| t.lines().map(str::trim_end).collect::<Vec<_>>().join("\n");
        assert_eq!(words(&text), words(due));
        let e = &mut all.entries[0];
        (e.as_recorded, e.composed, e.note) = (false, true, "A note.");
        let text = style::plain(&entry(e, 90));
        let start = "\n  ✓ (1) [proved; good]\n    NOT AS RECORDED\n    A square.\n    composed   ";
        assert!(
            text.starts_with(start) && text.ends_with("\n    A note.\n"),
            "{text}"
        );
    }

    #[test]
    fn what_is_refuted_has_residual_and_witness() {
        let all = fabricated();
        let mut o = all.entries[1].obligations[0].clone();
        let text = |o: &Obligation| style::plain(&obligation(o, 400));
        let witness = |point: &[(&str, &str)]| crate::symbolic::Witness {
            point: point
                .iter()
                .map(|(n, v)| (n.to_string(), v.to_string()))
                .collect(),
            residual: "-4".into(),
        };
        o.witness = Some(witness(&[("a", "1"), ("b", "2")]));
        let seen = text(&o);
        assert!(
            seen.ends_with("\n    witness    -4 at a = 1, b = 2\n"),
            "{seen}"
        );
        o.witness = Some(witness(&[]));
        assert!(text(&o).ends_with("\n    witness    -4\n"));
        let clipped = |n: usize| {
            let residual = "x".repeat(n);
            let o = Obligation {
                residual: Some(residual),
                witness: None,
                ..o.clone()
            };
            let seen = text(&o);
            (seen.matches('x').count(), seen.ends_with(" …\n"))
        };
        assert_eq!((clipped(300), clipped(301)), ((300, false), (300, true)));
        let colours = obligation(&o, 400);
        assert!(colours.contains(&DIM.render().to_string()), "{colours:?}");
        // Elsewhere neither is of interest.
        o.printed = Outcome::Proved;
        assert_eq!(text(&o).lines().count(), 1);
        assert!(text(&o).starts_with("    requires   "));
        o.recorded = Some(Outcome::Proved);
        assert!(text(&o).starts_with("    fact       ") && text(&o).lines().count() == 1);
    }

    #[test]
    fn claims_and_notes_are_wrapped_four_characters_from_the_edge() {
        let mut e = fabricated().entries.remove(0);
        (e.claim, e.note) = ("aaa bbb ccc", "ddd eee fff");
        e.obligations.clear();
        let text = style::plain(&entry(&e, 12));
        assert!(text.contains("\n    aaa bbb\n    ccc\n"), "{text}");
        assert!(text.ends_with("\n    ddd eee\n    fff\n"), "{text}");
    }
}
