//! A ledger as one page without outside parts; formulas in MathML, which browsers render.

use super::html::escape;
use super::html_style::CSS;
use super::ledger::{clipped, counts, search};
use super::ledger_text::{mark, word};
use mechaudit::papers::ledger::{Formula, Ledger, LedgerEntry, Obligation, Verdict};
use mechaudit::symbolic::Outcome;
use pulldown_latex::config::DisplayMode;
use pulldown_latex::{Parser, RenderConfig, Storage, push_mathml};

/// What a ledger needs beyond the style sheet of reports.
const EXTRA: &str = "
.pair { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 30rem), 1fr));
  gap: .4rem 1.5rem; margin: .5rem 0; }
body { max-width: 92rem; }
.pair > div { overflow: auto hidden; padding: .3rem .6rem .6rem; border: 1px solid var(--line);
  border-radius: .25rem; }
.pair .wrong { background: var(--misprint); } .pair .right { background: var(--agrees); }
.cap { display: block; font-size: .75rem; color: var(--soft); }
math { font-size: 1.05rem; } code { font-size: .8rem; overflow-wrap: anywhere; }
.ob { margin: .25rem 0; padding: .2rem 0 .4rem; overflow: auto hidden; } .ok { color: var(--good); } .no { color: var(--bad); }
";

/// MathML of a formula; the text form if it cannot be typeset.
fn math(f: &Formula, display: DisplayMode) -> String {
    let storage = Storage::new();
    let parsed: Result<Vec<_>, _> = Parser::new(&f.latex, &storage).collect();
    let mut out = String::new();
    let config = RenderConfig {
        display_mode: display,
        ..RenderConfig::default()
    };
    let written =
        parsed.is_ok() && push_mathml(&mut out, Parser::new(&f.latex, &storage), config).is_ok();
    match written {
        true => out,
        false => format!("<code>{}</code>", escape(&f.text)),
    }
}

/// The page.
pub fn page(ledger: &Ledger) -> String {
    let p = &ledger.paper;
    let title = escape(p.title);
    let mut out = format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>{title}: ledger</title>\n<style>{CSS}{EXTRA}</style>\n</head>\n<body>\n\
         <h1>{title}</h1>\n<p class=\"soft\">{}{}, {}</p>\n<p>{}</p>\n",
        escape(p.authors),
        p.year.map_or(String::new(), |y| format!(" ({y})")),
        escape(p.venue),
        escape(&counts(ledger))
    );
    ledger.entries.iter().for_each(|e| out.push_str(&entry(e)));
    out.push_str(&format!(
        "<p class=\"soft\">Written by mechaudit {}.</p>\n</body>\n</html>\n",
        escape(ledger.mechaudit_version)
    ));
    out
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
    let mut out = format!(
        "<article class=\"finding t-{}\" id=\"{}\">\n<h3>{}</h3>\n<div class=\"tag\">{sign} {}</div>\n",
        tone(e.verdict),
        escape(e.id),
        escape(e.place),
        e.verdict.words()
    );
    if !e.as_recorded {
        out.push_str("<p class=\"alarm\">Not as recorded.</p>\n");
    }
    out.push_str(&format!("<p>{}</p>\n", escape(e.claim)));
    let cell = |class: &str, caption: &str, f: &Formula| {
        format!(
            "<div class=\"{class}\"><span class=\"cap\">{caption}</span>{}</div>\n",
            math(f, DisplayMode::Block)
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
                "<p>{}: <code>{}</code> becomes <code>{}</code></p>\n",
                edit.kind,
                escape(&edit.before),
                escape(&edit.after)
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
        out.push_str(&format!("<p>{}</p>\n", escape(e.note)));
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
        math(&o.formula, DisplayMode::Inline)
    );
    if o.printed == Outcome::Refuted {
        if let Some(r) = &o.residual {
            let text = escape(&clipped(r, 400));
            out.push_str(&format!(
                "<p class=\"soft\">residual <code>{text}</code></p>\n"
            ));
        }
        if let Some(w) = &o.witness {
            let point: Vec<String> = w.point.iter().map(|(n, v)| format!("{n} = {v}")).collect();
            let at = if point.is_empty() { "" } else { " at " };
            out.push_str(&format!(
                "<p class=\"soft\">left minus right is <code>{}</code>{at}<code>{}</code></p>\n",
                escape(&w.residual),
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
                    let html = math(f, DisplayMode::Inline);
                    assert!(html.starts_with("<math"), "{}: {}", e.id, f.latex);
                }
            }
        }
    }
}
