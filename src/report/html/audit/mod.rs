//! The report of an audit as one page without outside parts, whosever code was audited.

mod data;
mod encoded;
mod method;
mod overview;
mod whole;

use super::assets::{AUDIT_CSS, AUDIT_JS, D3_JS, FIGURES_JS, MAP_JS, PLOT_JS};
use super::page::{Page, class, verdict};
use super::{convergence, page::entry_of_contents};
use crate::audit::{ConvergenceReport, MethodReport};
use crate::report::words::Tone;
use crate::report::words::audit::{all_pass, holds, settings, totals, verdict as of_method};
use crate::report::words::numbers::count;
use maud::{Markup, html};

/// The page: the verdict, what is over budget, a line for each method, then each in full. With the
/// convergence of approximations where it was asked for. `interrupted` if the run was ended early.
pub fn page(
    reports: &[MethodReport],
    approximations: Option<&[Result<ConvergenceReport, String>]>,
    interrupted: bool,
) -> String {
    let (tone, word) = match all_pass(reports) {
        _ if interrupted => (Tone::Bad, "Interrupted"),
        true => (Tone::Good, "As expected"),
        false => (Tone::Bad, "NOT as expected"),
    };
    let title = match reports {
        [only] => format!("Audit of {}", only.method),
        _ => format!("Audit of {}", count(reports.len(), "method")),
    };
    let data = data::Data::of(reports);
    let main = html! {
        h1 { (title) } "\n"
        (verdict(tone, word, &format!("{}.", totals(reports))))
        @if let Some(first) = reports.first() { p.soft { (settings(&first.settings)) } "\n" }
        (news(reports))
        @if reports.len() > 1 { (overview::table(reports, &data)) }
        @for (k, report) in reports.iter().enumerate() {
            (method::section(k, report, &data, reports.len() <= 3))
        }
        @if let Some(reports) = approximations { (convergence::all(reports)) }
        p.soft.small {
            "An ulp is the unit in the last place of the unrounded reference; u is 2" sup { "-53" }
            "; worst found is the largest of a sample."
        } "\n"
        dialog #case aria-labelledby="case-title" {} "\n"
    };
    let page = Page {
        title: &format!("{title}: {word}"),
        kind: "audit",
        styles: &[AUDIT_CSS],
        contents: contents(reports, approximations.is_some()),
        main,
        data: &[("audit-data", super::page::embedded(&data))],
        scripts: &[D3_JS, PLOT_JS, FIGURES_JS, MAP_JS, AUDIT_JS],
    };
    page.write()
}

fn contents(reports: &[MethodReport], convergence: bool) -> Markup {
    html! {
        @if reports.len() > 1 { li { a href="#overview" { b { "Overview" } } } "\n" }
        @for (k, r) in reports.iter().enumerate() {
            @let (_, tone) = of_method(r);
            @let sign = if r.passed() { "✓" } else { "✗" };
            (entry_of_contents(&anchor(k), tone, sign, r.method))
            @if reports.len() == 1 {
                @for part in ["regions", "cases", "figures"] {
                    li { a href={ "#" (part) "-" (k) } { (part) } } "\n"
                }
            }
        }
        @if convergence { li { a href="#convergence" { b { "Convergence" } } } "\n" }
    }
}

/// The name of a method's section. Methods audited twice, say two candidates, have one each.
fn anchor(k: usize) -> String {
    format!("method-{k}")
}

/// What is over budget, and laws that do not hold.
fn news(reports: &[MethodReport]) -> Markup {
    let failing: Vec<(usize, &MethodReport)> = reports
        .iter()
        .enumerate()
        .filter(|r| !r.1.passed())
        .collect();
    html! {
        @if !failing.is_empty() {
            ul.news { "\n"
                @for (k, r) in failing {
                    li {
                        a href={ "#" (anchor(k)) } { (r.method) } ": "
                        @if r.interrupted { "interrupted after " (r.cases) " cases" }
                        @else { (r.failed()) " of " (r.cases) " cases do not pass" }
                        @for law in r.laws.iter().filter(|l| !holds(l)) {
                            "; law " (law.name) " does not hold"
                        }
                        @if let Some(trouble) = r.candidate.as_ref().and_then(|c| c.trouble.as_ref()) {
                            "; " (trouble)
                        }
                    } "\n"
                }
            } "\n"
        }
    }
}

/// A verdict as a word in its colour.
fn word(r: &MethodReport) -> Markup {
    let (word, tone) = of_method(r);
    html! { span.sign.(class(tone)) { (word) } }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::html::page::tests::{markup, whole};
    use crate::report::text::method::tests::{fabricated, passing};

    #[test]
    fn the_verdict_comes_first_then_what_is_over_budget() {
        let page = page(&[fabricated(), passing()], None, false);
        whole(&page);
        let order = [
            "<title>Audit of 2 methods: NOT as expected</title>",
            "NOT as expected</span>: 1 of 2 methods pass, 799 of 800 cases.",
            "1 of 400 cases do not pass",
            "id=\"overview\"",
            "id=\"method-0\"",
            "reproduce  mechaudit audit a-method",
            "id=\"method-1\"",
        ];
        let places: Vec<usize> = order.iter().map(|p| page.find(p).expect(p)).collect();
        assert!(places.is_sorted(), "{places:?}");
        let good = passing();
        let page = super::page(&[good], None, false);
        assert!(!page.contains("class=\"news\""));
        assert_eq!(markup(&page).1, 6);
    }
}
