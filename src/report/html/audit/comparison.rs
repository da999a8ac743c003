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
    use crate::report::gallery::Gallery;

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

    /// A program that stopped has fewer cases than there are; the best has a star, and what is
    /// wrong its number.
    #[test]
    fn lines_and_changes() {
        let mut all = Gallery::default();
        let mut found = contest([7, 400]);
        all.add("the second has most", line(&found).into_string());
        let best = &mut found.standings[0];
        (best.best, best.wrong, best.failed, best.ratio) = (true, 0, 0, Some(1.0));
        all.add("best", line(&found).into_string());
        found.standings.clear();
        all.add("none", line(&found).into_string());
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
        all.add("changes", changes(&found).into_string());
        all.pin("contests");
    }
}
