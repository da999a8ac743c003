//! Several codes side by side, and what has changed since an earlier report.

use super::overview::{brief, heat, number, sorting};
use super::{anchor, word};
use crate::audit::{Comparison, Contest, Speed, Standing};
use crate::report::baseline::Changes;
use crate::report::html::page::class;
use crate::report::words::Tone;
use crate::report::words::audit::candidate;
use crate::report::words::numbers::short;
use maud::{Markup, html};

/// The codes, then a line for each region with the best marked.
pub fn table(found: &Comparison) -> Markup {
    html! {
        section { "\n"
            h2 #comparison { "Side by side" } "\n"
            div.scroll tabindex="0" { table { "\n"
                thead { tr {
                    th.left { "code" } th.left { "verdict" } th.left { "what it is" }
                    th { "ns an answer" } th { "start-up, ms" }
                } } "\n"
                tbody { "\n" @for (k, c) in found.candidates.iter().enumerate() {
                    tr {
                        td.left { a href={ "#" (anchor(k)) } { (c.name) } }
                        td.left { (word(&c.report)) }
                        td.left.wrap { @match &c.report.candidate {
                            Some(own) => (candidate(own)),
                            None => "the method's own solver, called in this process",
                        } }
                        (speed(c.speed.as_ref()))
                    } "\n"
                } } "\n"
            } } "\n"
            p.soft.small {
                "Worst share of the budget in each region; ★ is the best: the fewest answers of the wrong "
                "kind, then the smallest share. ✗ counts answers of the wrong kind or undecided. Speeds include the protocol, start-up apart."
            } "\n"
            div.scroll tabindex="0" { table.sortable #comparison-table { "\n"
                thead { tr {
                    th.left { "region" } th { "cases" }
                    @for c in &found.candidates { th.given { (c.name) } th { "times the best" } th { "worst ulps" } }
                } } "\n"
                tbody { "\n" @for contest in &found.regions { (line(contest)) } } "\n"
            } } "\n"
        } "\n"
    }
}

fn speed(speed: Option<&Speed>) -> Markup {
    html! {
        @match speed {
            Some(s) => {
                (number(true, s.ns_per_answer))
                @match s.start_up_ms { Some(ms) => (number(true, ms)), None => td { "–" } }
            },
            None => { td { "–" } td { "–" } },
        }
    }
}

fn line(contest: &Contest) -> Markup {
    let cases = contest.standings.iter().map(|s| s.cases).max();
    html! {
        tr {
            td.left { (contest.region) } td { (cases.unwrap_or(0)) }
            @for s in &contest.standings { (standing(s)) }
        } "\n"
    }
}

fn standing(s: &Standing) -> Markup {
    html! {
        td.(heat(s.failed > 0, s.of_budget)) data-v=[sorting(s.of_budget)] {
            @if s.best { "★ " } (brief(s.of_budget))
            @if s.failed > 0 { ", " (s.failed) " fail" }
            @if s.wrong > 0 { " ✗ " (s.wrong) }
        }
        @match s.ratio { Some(r) => (number(true, r)), None => td { "–" } }
        (number(true, s.worst_ulps))
    }
}

/// Values that are worse and better, the worse first.
pub fn changes(found: &Changes) -> Markup {
    let worse = found.changes.iter().filter(|c| !c.better).count();
    let better = found.changes.len() - worse;
    html! {
        section { "\n"
            h2 #changes { "Since the baseline" } "\n"
            p { (worse) " figures worse, " (better) " better." } "\n"
            @for text in &found.not_compared { p.soft { (text) } "\n" }
            @if !found.changes.is_empty() {
                div.scroll.tall tabindex="0" { table.sortable #changes-table { "\n"
                    thead { tr {
                        th.left { "change" } th.left { "of" } th.left { "region" } th.left { "output" }
                        th.left { "figure" } th { "before" } th { "now" }
                    } } "\n"
                    tbody { "\n" @for c in &found.changes {
                        @let (word, tone) = if c.better { ("better", Tone::Good) } else { ("worse", Tone::Bad) };
                        tr {
                            td.left { span.sign.(class(tone)) { (word) } }
                            td.left { (c.of) } td.left { (c.region) }
                            td.left { (c.output.as_deref().unwrap_or("")) } td.left { (c.figure) }
                            td data-v=[sorting(c.before)] { (short(c.before)) }
                            td data-v=[sorting(c.now)] { (short(c.now)) }
                        } "\n"
                    } } "\n"
                } } "\n"
            }
        } "\n"
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::baseline::Change;

    fn contest(cases: [u64; 2]) -> Contest {
        let standing = |cases| Standing {
            cases,
            failed: 3,
            wrong: 2,
            of_budget: 0.5,
            worst_ulps: 2.0,
            rms_ulps: 0.25,
            ratio: None,
            best: false,
        };
        Contest {
            region: "wide",
            standings: cases.map(standing).to_vec(),
        }
    }

    /// A program that stopped has fewer cases than there are.
    #[test]
    fn a_region_has_the_cases_of_the_code_that_had_most() {
        for cases in [[400, 7], [7, 400]] {
            let html = line(&contest(cases)).into_string();
            let start = "<tr><td class=\"left\">wide</td><td>400</td>";
            assert!(html.starts_with(start), "{html}");
        }
        let html = line(&Contest {
            standings: Vec::new(),
            ..contest([0, 0])
        });
        assert!(html.into_string().contains("<td>0</td>"));
    }

    #[test]
    fn the_best_has_a_star_and_what_is_wrong_its_number() {
        let mut s = contest([400, 400]).standings.remove(0);
        let html = standing(&s).into_string();
        for part in ["class=\"h5\"", ">50 %, 3 fail ✗ 2</td><td>–</td>"] {
            assert!(html.contains(part), "{part} is missing in {html}");
        }
        (s.best, s.wrong, s.failed, s.ratio) = (true, 0, 0, Some(1.0));
        let html = standing(&s).into_string();
        assert!(
            html.contains("class=\"h1\"") && html.contains(">★ 50 %</td>"),
            "{html}"
        );
        assert!(html.contains("<td data-v=\"1.000e0\">1.00</td>"), "{html}");
    }

    #[test]
    fn figures_worse_and_better_are_counted() {
        let change = |better| Change {
            of: "a-method".into(),
            region: "wide".into(),
            output: None,
            figure: "failed",
            before: 1.0,
            now: 2.0,
            better,
        };
        let found = Changes {
            changes: vec![change(false), change(true), change(true)],
            not_compared: Vec::new(),
        };
        let html = changes(&found).into_string();
        assert!(html.contains("<p>1 figures worse, 2 better.</p>"), "{html}");
        assert_eq!(html.matches("t-bad\">worse").count(), 1);
        assert_eq!(html.matches("t-good\">better").count(), 2);
    }
}
