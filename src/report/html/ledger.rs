//! A ledger as one page without outside parts; formulas in MathML, which browsers render.

use super::page::{AboutPaper, class, counted, entry_of_contents, filter};
use super::paper::WIDE;
use super::prose::{expression, math, prose};
use crate::papers::ledger::{Formula, Ledger, LedgerEntry, Obligation, Verdict};
use crate::report::words::Tone;
use crate::report::words::ledger::{entries, mark, search, word};
use crate::report::words::numbers::clipped;
use crate::symbolic::Outcome;
use maud::{Markup, html};
use pulldown_latex::config::DisplayMode;

/// The page.
pub fn page(ledger: &Ledger) -> String {
    let verdicts = counted(ledger.entries.iter().map(|e| e.verdict.words()));
    let about = AboutPaper {
        paper: &ledger.paper,
        kind: "ledger",
        verdict: (ledger.as_recorded(), entries(ledger)),
        contents: html! {
            @for e in &ledger.entries {
                @let (sign, tone) = mark(e.verdict);
                (entry_of_contents(e.id, tone, sign, e.place))
            }
        },
        main: html! {
            (filter("article.finding", "entries", &verdicts))
            div.cards { "\n" @for e in &ledger.entries { (entry(e)) } } "\n"
        },
        columns: &[],
        data: &[],
        scripts: &[],
    };
    about.page()
}

fn formula(f: &Formula, display: DisplayMode) -> Markup {
    math(&f.latex, &f.text, display)
}

fn entry(e: &LedgerEntry) -> Markup {
    let (sign, tone) = mark(e.verdict);
    let shown = e.printed.iter().chain(&e.corrected);
    let mut formulas = shown.chain(e.obligations.iter().map(|o| &o.formula));
    let wide = formulas.any(|f| f.text.chars().count() > WIDE);
    html! {
        article.finding.(class(tone)).wide[wide] id=(e.id)
            data-verdict=(e.verdict.words()) { "\n"
            h3 { (prose(e.place)) } "\n"
            div.tag { (sign) " " (e.verdict.words()) } "\n"
            @if !e.as_recorded { p.alarm { "Not as recorded." } "\n" }
            p { (prose(e.claim)) } "\n"
            @if let Some(printed) = &e.printed { (pair(e, printed)) }
            @if let Some(fault) = &e.dimension { p { "Dimension: " (fault) "." } "\n" }
            @if let Some(r) = &e.repair {
                @for edit in &r.edits {
                    p {
                        (edit.kind.to_string()) ": " (expression(&edit.before)) " becomes "
                        (expression(&edit.after))
                    } "\n"
                }
                p.soft { (search(r)) } "\n"
            }
            @if !e.obligations.is_empty() {
                details open[e.verdict != Verdict::Proved] {
                    summary { "Requirements" } "\n"
                    @for o in &e.obligations { (obligation(o)) }
                } "\n"
            }
            @if !e.note.is_empty() { p { (prose(e.note)) } "\n" }
        } "\n"
    }
}

/// The formula as printed, beside the corrected one.
fn pair(e: &LedgerEntry, printed: &Formula) -> Markup {
    let caption = match e.composed {
        true => "of corrected parts",
        false => "printed",
    };
    let wrong = matches!(e.verdict, Verdict::Misprint | Verdict::Refuted);
    let cell = |class: &str, caption: &str, f: &Formula| {
        html! {
            div class=(class) { span.cap { (caption) } (formula(f, DisplayMode::Block)) } "\n"
        }
    };
    html! {
        div.pair { "\n"
            (cell(if wrong { "wrong" } else { "" }, caption, printed))
            @if let Some(corrected) = &e.corrected { (cell("right", "corrected", corrected)) }
        } "\n"
    }
}

fn obligation(o: &Obligation) -> Markup {
    let tagged = |outcome: Outcome| {
        let tone = match outcome {
            Outcome::Proved => Tone::Good,
            _ => Tone::Bad,
        };
        html! { span.sign.(class(tone)) { (word(outcome)) } }
    };
    html! {
        div.ob {
            (formula(&o.formula, DisplayMode::Inline)) " " span.soft { "·" } " "
            @match o.corrected {
                None => (tagged(o.printed)),
                Some(c) => { "as printed " (tagged(o.printed)) ", as corrected " (tagged(c)) },
            }
        } "\n"
        @if o.printed == Outcome::Refuted {
            @if let Some(r) = &o.residual {
                p.soft { "residual " (expression(&clipped(r, 400))) } "\n"
            }
            @if let Some(w) = &o.witness {
                @let point: Vec<String> = w.point.iter().map(|(n, v)| format!("{n} = {v}")).collect();
                p.soft {
                    "left minus right is " (expression(&w.residual))
                    @if !point.is_empty() { " at " }
                    code { (point.join(", ")) }
                } "\n"
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::text::ledger::tests::fabricated;

    #[test]
    fn the_page_is_whole_escaped_and_without_outside_parts() {
        let html = page(&fabricated());
        for part in [
            "On &lt;tests&gt;",
            "A square &amp; more.",
            "<math display=\"block\">",
            "class=\"wrong\"",
            "class=\"right\"",
            "as corrected <span class=\"sign t-good\">proved</span>",
        ] {
            assert!(html.contains(part), "{part} is missing");
        }
        super::super::page::tests::whole(&html);
    }

    #[test]
    fn every_formula_of_every_paper_is_typeset() {
        for key in crate::papers::keys() {
            let ledger = crate::papers::ledger_of(key).unwrap();
            for e in &ledger.entries {
                let own = e.printed.iter().chain(&e.corrected);
                for f in own.chain(e.obligations.iter().map(|o| &o.formula)) {
                    let html = formula(f, DisplayMode::Inline).into_string();
                    assert!(html.starts_with("<math"), "{}: {}", e.id, f.latex);
                }
            }
        }
    }

    #[test]
    fn entries_of_long_formulas_are_wide() {
        let of = |change: &dyn Fn(&mut LedgerEntry)| {
            let mut e = fabricated().entries.remove(1);
            change(&mut e);
            let html = entry(&e).into_string();
            let tag = html.split('>').next().unwrap();
            tag.contains("wide")
        };
        let formula = |n: usize| Formula {
            text: "φ".repeat(n),
            latex: "a".into(),
        };
        assert!(!of(&|_| ()));
        for (n, wide) in [(WIDE, false), (WIDE + 1, true)] {
            assert_eq!(of(&|e| e.printed = Some(formula(n))), wide);
            assert_eq!(of(&|e| e.corrected = Some(formula(n))), wide);
            assert_eq!(of(&|e| e.obligations[0].formula = formula(n)), wide);
        }
    }
}
