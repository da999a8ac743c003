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
    use crate::report::gallery::Gallery;

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

    /// Entries of each kind with obligations, residuals and witnesses; long residuals are clipped.
    #[test]
    fn ledgers() {
        let mut shown = Gallery::default();
        let mut all = fabricated();
        for width in [90, 40] {
            shown.add(format!("on {width}"), ledger(&all, width));
        }
        let mut o = all.entries[1].obligations[0].clone();
        let witness = |point: &[(&str, &str)]| {
            let pair = |(n, v): &(&str, &str)| (n.to_string(), v.to_string());
            crate::symbolic::Witness {
                point: point.iter().map(pair).collect(),
                residual: "-4".into(),
            }
        };
        for point in [&[("a", "1"), ("b", "2")][..], &[]] {
            o.witness = Some(witness(point));
            shown.add(format!("witness {point:?}"), obligation(&o, 400));
        }
        for n in [300, 301] {
            o.residual = Some("x".repeat(n));
            let text = style::plain(&obligation(&o, 400));
            assert_eq!(text.matches('x').count(), 300);
            assert_eq!(text.contains(" …\n"), n > 300, "{text}");
        }
        // Elsewhere neither is of interest.
        o.printed = Outcome::Proved;
        shown.add("proved", obligation(&o, 400));
        o.recorded = Some(Outcome::Proved);
        shown.add("a fact", obligation(&o, 400));
        let e = &mut all.entries[0];
        (e.as_recorded, e.composed, e.note) = (false, true, "A note.");
        shown.add("not as recorded", entry(e, 12));
        shown.pin("ledgers");
    }
}
