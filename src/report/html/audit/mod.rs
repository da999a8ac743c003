//! The report of an audit as one page without outside parts, whosever code was audited.

#[cfg(feature = "report")]
mod campaign;
mod comparison;
mod data;
mod encoded;
mod method;
mod overview;
mod whole;

use super::assets::{AUDIT_CSS, AUDIT_JS, D3_JS, FIGURES_JS, MAP_JS, PLOT_JS};
use super::page::{Page, class, verdict};
use super::{convergence, page::entry_of_contents};
use crate::audit::{Comparison, ConvergenceReport, MethodReport, Uncertified};
#[cfg(feature = "report")]
use crate::campaign::{PartSum, Plan};
use crate::report::baseline::Changes;
use crate::report::words::Tone;
use crate::report::words::audit::{all_pass, holds, settings, totals, verdict as of_method};
use crate::report::words::numbers::count;
use maud::{Markup, html};

/// The page: the verdict, what is over budget, a line for each method, then each in full. With the
/// convergence of approximations and the changes since a baseline, where they were asked for.
/// `interrupted` if the run was ended early.
pub fn page(
    reports: &[MethodReport],
    approximations: Option<&[Result<ConvergenceReport, Uncertified>]>,
    changes: Option<&Changes>,
    interrupted: bool,
) -> String {
    let named: Named = reports.iter().map(|r| (r.method, r)).collect();
    let title = match reports {
        [only] => format!("Audit of {}", only.method),
        _ => format!("Audit of {}", count(reports.len(), "method")),
    };
    let parts = Parts {
        title,
        kind: "audit",
        named,
        first: html! {},
        links: Vec::new(),
        totals: totals(reports),
        changes,
        approximations,
        state: (!interrupted).then(|| all_pass(reports)),
    };
    parts.page()
}

#[cfg(feature = "report")]
/// A campaign as far as it is done, with the number of its finished shards.
pub fn campaign(plan: &Plan, (done, shards): (u64, u64), found: &[PartSum]) -> String {
    let labels: Vec<String> = plan.parts.iter().map(|p| p.label()).collect();
    let parts = labels.iter().zip(found);
    let named: Named = parts
        .filter_map(|(label, found)| match found {
            PartSum::Report(report) => Some((label.as_str(), &**report)),
            PartSum::Hunts(..) | PartSum::Proof(_) => None,
        })
        .collect();
    let reports: Vec<&MethodReport> = named.iter().map(|n| n.1).collect();
    let shards_done = format!("{done} of {} done", count(shards as usize, "shard"));
    let mut sections = vec![
        ("proofs", "Proofs", campaign::proofs(plan, found)),
        ("hunts", "Hunts", campaign::hunts(plan, found)),
    ];
    sections.retain(|s| !s.2.0.is_empty());
    let page = Parts {
        title: format!("Campaign {}", plan.name),
        kind: "campaign",
        totals: format!("{shards_done}; {}", campaign::totals(&reports)),
        named,
        links: sections.iter().map(|s| (s.0, s.1)).collect(),
        first: html! { @for (.., section) in &sections { (section) } },
        changes: None,
        approximations: None,
        state: (done == shards).then(|| found.iter().all(PartSum::passed)),
    };
    page.page()
}

/// Several codes side by side, then each in full.
pub fn comparison(found: &Comparison, changes: Option<&Changes>) -> String {
    let codes = &found.candidates;
    let good = codes.iter().filter(|c| c.report.passed()).count();
    let parts = Parts {
        title: format!(
            "{}: {} side by side",
            found.method,
            count(codes.len(), "code")
        ),
        kind: "comparison",
        named: codes.iter().map(|c| (c.name.as_str(), &c.report)).collect(),
        first: comparison::table(found),
        links: vec![("comparison", "Side by side")],
        totals: format!("{good} of {} pass", count(codes.len(), "code")),
        changes,
        approximations: None,
        state: (!found.interrupted()).then(|| found.passed()),
    };
    parts.page()
}

/// Reports with the names of their sections.
type Named<'a> = Vec<(&'a str, &'a MethodReport)>;

/// The parts of a page.
struct Parts<'a> {
    title: String,
    kind: &'a str,
    named: Named<'a>,
    /// Before all else.
    first: Markup,
    /// Its sections: where the contents lead, and what they call it.
    links: Vec<(&'a str, &'a str)>,
    totals: String,
    changes: Option<&'a Changes>,
    approximations: Option<&'a [Result<ConvergenceReport, Uncertified>]>,
    /// True if all pass; nothing if the run was ended early.
    state: Option<bool>,
}

impl Parts<'_> {
    fn page(&self) -> String {
        let (tone, word) = match self.state {
            None if self.kind == "campaign" => (Tone::Doubt, "Under way"),
            None => (Tone::Bad, "Interrupted"),
            Some(true) => (Tone::Good, "As expected"),
            Some(false) => (Tone::Bad, "NOT as expected"),
        };
        let reports: Vec<&MethodReport> = self.named.iter().map(|n| n.1).collect();
        let data = data::Data::of(&self.named);
        let several = self.kind != "comparison" && reports.len() > 1;
        let main = html! {
            h1 { (self.title) } "\n"
            (verdict(tone, word, &format!("{}.", self.totals)))
            @if let Some(first) = reports.first().filter(|_| self.kind != "campaign") { p.soft { (settings(&first.settings)) } "\n" }
            (units())
            (news(&self.named))
            (self.first)
            @if let Some(changes) = self.changes { (comparison::changes(changes)) }
            @if several { (overview::table(&reports, &data)) }
            @for (k, (name, report)) in self.named.iter().enumerate() {
                (method::section(k, name, report, &data, reports.len() <= 3))
            }
            @if let Some(reports) = self.approximations { (convergence::all(reports)) }
            dialog #case aria-labelledby="case-title" {} "\n"
        };
        let page = Page {
            title: &format!("{}: {word}", self.title),
            kind: self.kind,
            styles: &[AUDIT_CSS],
            contents: self.contents(several),
            main,
            columns: (self.topics(), &[]),
            data: &[("audit-data", super::page::embedded(&data))],
            scripts: &[D3_JS, PLOT_JS, FIGURES_JS, MAP_JS, AUDIT_JS],
        };
        page.write()
    }

    fn topics(&self) -> &[&str] {
        match (self.kind, self.changes) {
            ("campaign", _) => &["audit", "campaign"],
            ("comparison", _) | (_, Some(_)) => &["audit", "compare"],
            _ => &["audit"],
        }
    }

    fn contents(&self, several: bool) -> Markup {
        html! {
            @for (id, title) in &self.links {
                li { a href={ "#" (id) } { b { (title) } } } "\n"
            }
            @if self.changes.is_some() { li { a href="#changes" { b { "Since the baseline" } } } "\n" }
            @if several { li { a href="#overview" { b { "Overview" } } } "\n" }
            @for (k, (name, r)) in self.named.iter().enumerate() {
                @let (_, tone) = of_method(r);
                @let sign = if r.passed() { "✓" } else { "✗" };
                (entry_of_contents(&anchor(k), tone, sign, name))
                @if self.named.len() == 1 {
                    @for part in ["regions", "cases", "figures"] {
                        li { a href={ "#" (part) "-" (k) } { (part) } } "\n"
                    }
                }
            }
            @if self.approximations.is_some() {
                li { a href="#convergence" { b { "Convergence" } } } "\n"
            }
        }
    }
}

/// The name of a section.
fn anchor(k: usize) -> String {
    format!("method-{k}")
}

/// The units of errors, a line each.
fn units() -> Markup {
    html! {
        ul.units.small { "\n"
            li { b { "ulp" } ": the unit in the last place of the unrounded reference; rounded correctly, a result is off by ½ at most." } "\n"
            li { b { "u(1+cond)" } ": u = 2" sup { "−53" } ", times one plus the condition number: what rounded inputs alone may cost." } "\n"
            li { b { "budget" } ": the error that is allowed; a case fails above 100 % of it. Worst is the worst found of a sample." } "\n"
        } "\n"
    }
}

/// Cases over budget, and laws that do not hold.
fn news(named: &Named) -> Markup {
    let failing: Vec<_> = named
        .iter()
        .enumerate()
        .filter(|(_, n)| !n.1.passed())
        .collect();
    html! {
        @if !failing.is_empty() {
            ul.news { "\n"
                @for (k, (name, r)) in failing {
                    li {
                        a href={ "#" (anchor(k)) } { (name) } ": "
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
        let page = page(&[fabricated(), passing()], None, None, false);
        whole(&page);
        let order = [
            "<title>Audit of 2 methods: NOT as expected</title>",
            "NOT as expected</span>: 1 of 2 methods pass, 1 of 800 cases failed.",
            "1 of 400 cases do not pass",
            "id=\"overview\"",
            "id=\"method-0\"",
            "reproduce  mechaudit audit a-method",
            "id=\"method-1\"",
        ];
        let places: Vec<usize> = order.iter().map(|p| page.find(p).expect(p)).collect();
        assert!(places.is_sorted(), "{places:?}");
        let good = passing();
        let page = super::page(&[good], None, None, false);
        assert!(!page.contains("class=\"news\""));
        assert_eq!(markup(&page).1, 6);
    }

    #[test]
    fn a_comparison_that_was_ended_early_has_no_verdict() {
        let title = |interrupted| {
            let mut second = passing();
            second.interrupted = interrupted;
            let found = Comparison::new("a-method", vec![(passing(), None), (second, None)]);
            let page = comparison(&found, None);
            let title = page.split("<title>").nth(1).unwrap();
            title.split("</title>").next().unwrap().to_string()
        };
        assert_eq!(title(false), "a-method: 2 codes side by side: As expected");
        assert_eq!(title(true), "a-method: 2 codes side by side: Interrupted");
    }

    #[test]
    fn a_law_that_fails_and_trouble_are_news() {
        let mut report = passing();
        report.laws[0].worst = 1.5;
        report.candidate = Some(crate::audit::CandidateReport {
            trouble: Some("it stopped".into()),
            ..Default::default()
        });
        let page = |r: &MethodReport| super::page(std::slice::from_ref(r), None, None, false);
        let text = page(&report);
        let news = "0 of 400 cases do not pass; law energy does not hold; it stopped</li>";
        assert!(text.contains(news), "{text}");
        report.interrupted = true;
        let text = page(&report);
        let news = "interrupted after 400 cases; law energy";
        assert!(text.contains(news), "{text}");
    }

    /// Contents of a page of one method lead into it; a page of several has an overview, and one of
    /// three all statistics.
    #[test]
    fn what_a_page_has_depends_on_how_many_methods_there_are() {
        for n in 1..=4 {
            let text = page(&vec![fabricated(); n], None, None, false);
            assert_eq!(text.contains("href=\"#regions-0\""), n == 1, "{n}");
            assert_eq!(text.contains("href=\"#overview\""), n > 1, "{n}");
            assert_eq!(text.contains("id=\"overview-table\""), n > 1, "{n}");
            let all = text.matches("All statistics by region and output").count();
            assert_eq!(all, if n <= 3 { n } else { 0 });
        }
        let text = page(&[fabricated()], None, None, true);
        assert!(text.contains("<title>Audit of a-method: Interrupted</title>"));
        assert!(text.contains("<p class=\"soft\">seed 1, "), "{text}");
        let found = Comparison::new("a-method", vec![(passing(), None), (fabricated(), None)]);
        let text = comparison(&found, None);
        assert!(!text.contains("id=\"overview-table\""), "{text}");
        assert!(text.contains("1 of 2 codes pass."), "{text}");
    }
}
