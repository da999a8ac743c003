//! A ledger as one page without outside parts; formulas in MathML, which browsers render.

use super::html::{WIDE, begun, ended, entry_of_contents, escape};
use super::html_text::{expression, math, prose};
use super::ledger::{clipped, counts, search};
use super::ledger_text::{mark, word};
use mechaudit::papers::ledger::{Formula, Ledger, LedgerEntry, Obligation, Verdict};
use mechaudit::symbolic::Outcome;
use pulldown_latex::config::DisplayMode;

/// What a ledger needs beyond the style sheet of papers.
const EXTRA: &str = "
.pair { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 30rem), 1fr));
  gap: .4rem 1.5rem; margin: .5rem 0; }
.pair > div { overflow: auto hidden; padding: .3rem .6rem .6rem; border: 1px solid var(--line);
  border-radius: .25rem; }
.pair .wrong { background: var(--misprint); } .pair .right { background: var(--agrees); }
.cap { display: block; font-size: .75rem; color: var(--soft); }
.ob { margin: .25rem 0; padding: .2rem 0 .4rem; overflow: auto hidden; } .ok { color: var(--good); } .no { color: var(--bad); }
";

/// The page.
pub fn page(ledger: &Ledger) -> String {
    let mut out = begun(&ledger.paper, "ledger", EXTRA, &counts(ledger));
    out.push_str("<nav class=\"toc\" aria-label=\"Contents\">\n<ul>\n");
    for e in &ledger.entries {
        let (sign, _) = mark(e.verdict);
        out.push_str(&entry_of_contents(e.id, tone(e.verdict), sign, e.place));
    }
    out.push_str("</ul>\n</nav>\n<main>\n<div class=\"cards\">\n");
    ledger.entries.iter().for_each(|e| out.push_str(&entry(e)));
    out.push_str("</div>\n");
    out.push_str(&ended(ledger.mechaudit_version));
    out
}

fn formula(f: &Formula, display: DisplayMode) -> String {
    math(&f.latex, &f.text, display)
}

fn tone(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Proved => "good",
        Verdict::Refuted | Verdict::Undecided => "bad",
        Verdict::Misprint | Verdict::Undefined => "doubt",
        Verdict::Model | Verdict::Definition => "new",
    }
}

fn entry(e: &LedgerEntry) -> String {
    let (sign, _) = mark(e.verdict);
    let shown = e.printed.iter().chain(&e.corrected);
    let mut formulas = shown.chain(e.obligations.iter().map(|o| &o.formula));
    let wide = match formulas.any(|f| f.text.chars().count() > WIDE) {
        true => " wide",
        false => "",
    };
    let mut out = format!(
        "<article class=\"finding t-{}{wide}\" id=\"{}\">\n<h3>{}</h3>\n<div class=\"tag\">{sign} {}</div>\n",
        tone(e.verdict),
        escape(e.id),
        prose(e.place),
        e.verdict.words()
    );
    if !e.as_recorded {
        out.push_str("<p class=\"alarm\">Not as recorded.</p>\n");
    }
    out.push_str(&format!("<p>{}</p>\n", prose(e.claim)));
    let cell = |class: &str, caption: &str, f: &Formula| {
        format!(
            "<div class=\"{class}\"><span class=\"cap\">{caption}</span>{}</div>\n",
            formula(f, DisplayMode::Block)
        )
    };
    if let Some(printed) = &e.printed {
        let class = match e.verdict {
            Verdict::Misprint | Verdict::Refuted => "wrong",
            _ => "",
        };
        out.push_str("<div class=\"pair\">\n");
        let caption = match e.composed {
            true => "of corrected parts",
            false => "printed",
        };
        out.push_str(&cell(class, caption, printed));
        if let Some(corrected) = &e.corrected {
            out.push_str(&cell("right", "corrected", corrected));
        }
        out.push_str("</div>\n");
    }
    if let Some(r) = &e.repair {
        for edit in &r.edits {
            out.push_str(&format!(
                "<p>{}: {} becomes {}</p>\n",
                edit.kind,
                expression(&edit.before),
                expression(&edit.after)
            ));
        }
        out.push_str(&format!("<p class=\"soft\">{}</p>\n", escape(&search(r))));
    }
    if !e.obligations.is_empty() {
        let open = if e.verdict == Verdict::Proved {
            ""
        } else {
            " open"
        };
        out.push_str(&format!("<details{open}><summary>Requirements</summary>\n"));
        e.obligations
            .iter()
            .for_each(|o| out.push_str(&obligation(o)));
        out.push_str("</details>\n");
    }
    if !e.note.is_empty() {
        out.push_str(&format!("<p>{}</p>\n", prose(e.note)));
    }
    out.push_str("</article>\n");
    out
}

fn obligation(o: &Obligation) -> String {
    let tagged = |outcome: Outcome| {
        let class = match outcome {
            Outcome::Proved => "ok",
            _ => "no",
        };
        format!("<span class=\"{class}\">{}</span>", word(outcome))
    };
    let mut outcome = tagged(o.printed);
    if let Some(c) = o.corrected {
        outcome = format!("as printed {outcome}, as corrected {}", tagged(c));
    }
    let mut out = format!(
        "<div class=\"ob\">{} <span class=\"soft\">·</span> {outcome}</div>\n",
        formula(&o.formula, DisplayMode::Inline)
    );
    if o.printed == Outcome::Refuted {
        if let Some(r) = &o.residual {
            out.push_str(&format!(
                "<p class=\"soft\">residual {}</p>\n",
                expression(&clipped(r, 400))
            ));
        }
        if let Some(w) = &o.witness {
            let point: Vec<String> = w.point.iter().map(|(n, v)| format!("{n} = {v}")).collect();
            let at = if point.is_empty() { "" } else { " at " };
            out.push_str(&format!(
                "<p class=\"soft\">left minus right is {}{at}<code>{}</code></p>\n",
                expression(&w.residual),
                escape(&point.join(", "))
            ));
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::ledger_text::tests::fabricated;

    #[test]
    fn the_page_is_whole_escaped_and_without_outside_parts() {
        let html = page(&fabricated());
        for part in [
            "<!doctype html>",
            "On &lt;tests&gt;",
            "A square &amp; more.",
            "<math display=\"block\">",
            "class=\"wrong\"",
            "class=\"right\"",
            "as corrected <span class=\"ok\">proved</span>",
            "</html>",
        ] {
            assert!(html.contains(part), "{part} is missing");
        }
        for outside in [
            "http:", "https:", "src=", "<script", "@import", "url(", "merror",
        ] {
            assert!(!html.contains(outside), "{outside}");
        }
        for tag in ["article", "details", "div", "math", "mrow", "p", "code"] {
            let opened = html.matches(&format!("<{tag}>")).count()
                + html.matches(&format!("<{tag} ")).count();
            assert_eq!(opened, html.matches(&format!("</{tag}>")).count(), "{tag}");
        }
    }

    #[test]
    fn every_formula_of_every_paper_is_typeset() {
        for key in mechaudit::papers::keys() {
            let ledger = mechaudit::papers::ledger_of(key).unwrap();
            for e in &ledger.entries {
                let own = e.printed.iter().chain(&e.corrected);
                for f in own.chain(e.obligations.iter().map(|o| &o.formula)) {
                    let html = formula(f, DisplayMode::Inline);
                    assert!(html.starts_with("<math"), "{}: {}", e.id, f.latex);
                }
            }
        }
    }
}
