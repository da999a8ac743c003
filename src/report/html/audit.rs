//! The report of an audit as one page without outside parts.

use super::page::{class, document, verdict};
use super::style::AUDIT_CSS;
use super::{convergence, plots};
use crate::audit::{
    ConvergenceReport, ErrorMap, LawReport, MethodReport, OutputStatistics, Uncertified, hex_float,
};
use crate::report::text::case;
use crate::report::text::style::plain;
use crate::report::words::Tone;
use crate::report::words::audit::{
    Worst, all_pass, holds, mark, settings, totals, verdict as of_method,
};
use crate::report::words::numbers::{count, percent, short, short_if};
use maud::{Markup, html};

/// Failing cases written out for each method.
const FAILURES_SHOWN: usize = 20;

/// The page: the verdict, what is over budget, a line for each method, then each in full. With the
/// convergence of approximations where it was asked for. `interrupted` if the run was ended early.
pub fn page(
    reports: &[MethodReport],
    approximations: Option<&[Result<ConvergenceReport, Uncertified>]>,
    interrupted: bool,
) -> String {
    let (tone, word) = match all_pass(reports) {
        _ if interrupted => (Tone::Bad, "Interrupted"),
        true => (Tone::Good, "As expected"),
        false => (Tone::Bad, "NOT as expected"),
    };
    let title = format!("Audit of {}", count(reports.len(), "method"));
    let version = env!("CARGO_PKG_VERSION");
    let body = html! {
        h1 { (title) } "\n"
        (verdict(tone, word, &format!("{}.", totals(reports))))
        @if let Some(first) = reports.first() { p.soft { (settings(&first.settings)) } "\n" }
        (news(reports))
        (overview(reports))
        @for report in reports { (method(report)) }
        @if let Some(reports) = approximations { (convergence::all(reports)) }
        p.soft {
            "Written by mechaudit " (version) ". An ulp is the unit in the last place of the \
             unrounded reference; u is 2" sup { "-53" } "; worst found is the largest of a sample."
        } "\n"
    };
    document(&format!("{title}: {word}"), AUDIT_CSS, &body)
}

/// What is over budget, and laws that do not hold.
fn news(reports: &[MethodReport]) -> Markup {
    let failing: Vec<&MethodReport> = reports.iter().filter(|r| !r.passed()).collect();
    html! {
        @if !failing.is_empty() {
            ul.news { "\n"
                @for r in failing {
                    @let failed = r.failed();
                    li {
                        b { (r.method) } ": "
                        @if r.interrupted { "interrupted after " (r.cases) " cases" }
                        @else { (failed) " of " (r.cases) " cases do not pass" }
                        @for law in r.laws.iter().filter(|l| !holds(l)) {
                            "; law " (law.name) " does not hold"
                        }
                    } "\n"
                }
            } "\n"
        }
    }
}

fn overview(reports: &[MethodReport]) -> Markup {
    html! {
        div.scroll { table { "\n"
            tr {
                th.left { "method" } th.left { "verdict" } th { "cases" } th { "worst ulps" }
                th { "u(1+cond)" } th { "of budget" } th { "recorded findings" }
            } "\n"
            @for r in reports {
                @let worst = Worst::of(r);
                tr {
                    td.left { a href={ "#" (r.method) } { (r.method) } }
                    td.left.(if r.passed() { "agrees" } else { "unexplained" }) { (of_method(r).0) }
                    td { (r.cases) } td { (worst.ulps) } td { (worst.conditioned) }
                    td { (percent(worst.of_budget)) } td { (r.recorded) }
                } "\n"
            }
        } } "\n"
    }
}

fn method(report: &MethodReport) -> Markup {
    let failures = report.failures.len();
    let left = failures.saturating_sub(FAILURES_SHOWN) as u64 + report.failures_left_out;
    html! {
        h2 id=(report.method) { (report.method) } "\n"
        p { (report.summary) } "\n"
        p.soft { (report.source) } "\n"
        div.scroll { table { "\n"
            tr {
                th.left { "output" } th { "values" } th { "worst ulps" } th { "p99" } th { "RMS" }
                th { "worst u(1+cond)" } th { "of budget" } th { "worst condition" }
                th.left { "errors in ulps" }
            } "\n"
            @for o in report.outputs() { (output(o)) }
        } } "\n"
        @if let Some(map) = &report.map { (maps(map)) }
        (worst(report))
        @for law in &report.laws { (self::law(law)) }
        @for f in report.failures.iter().take(FAILURES_SHOWN) {
            @let text = plain(&case::text(f, &report.again(&f.case), 110));
            pre { (text.trim_end()) } "\n"
        }
        @if left > 0 { p.alarm { (left) " more failing cases." } "\n" }
    }
}

fn output(o: &OutputStatistics) -> Markup {
    let (some, conditioned) = (o.ulps.count > 0, o.conditioned.count > 0);
    html! {
        tr {
            td.left { (o.name) } td { (o.values) }
            td { (short_if(some, o.ulps.max)) } td { (short_if(some, o.ulps.p99)) }
            td { (short_if(some, o.ulps.rms)) } td { (short_if(conditioned, o.conditioned.max)) }
            td.unexplained[o.max_of_budget > 1.0] { (percent(o.max_of_budget)) }
            td { (short_if(conditioned, o.max_condition)) }
            @let bars: Vec<_> = o.histogram.iter().map(|b| (b.exponent, b.count as usize)).collect();
            td.left { (plots::histogram(&bars)) }
        } "\n"
    }
}

fn law(law: &LawReport) -> Markup {
    let (sign, tone) = mark(law);
    html! {
        p {
            span.sign.(class(tone)) { (sign) } " " (law.name) ": " (law.statement) " "
            span.soft {
                "(worst residual " (percent(law.worst)) " of what is allowed, " (law.cases) " cases)"
            }
        } "\n"
    }
}

/// The worst input of each output, to be copied.
fn worst(report: &MethodReport) -> Markup {
    let worst = report.outputs().iter();
    let worst = worst.filter_map(|o| Some((o, o.worst.as_ref()?)));
    html! {
        details { summary { "Worst cases" } "\n"
            @for (o, case) in worst {
                @let hex: Vec<String> = case.input.iter().map(|x| hex_float(*x)).collect();
                p {
                    (o.name) " at " (percent(o.max_of_budget)) " of its budget, " (case.region)
                    @if let Some(p) = o.parts {
                        "; " (short(p.method)) " ulps from the method, "
                        (short(p.rounding)) " from rounding"
                    }
                    ":"
                } "\n"
                pre {
                    code.copy { (hex.join(",")) } "\n"
                    code.copy { (report.again(case)) }
                } "\n"
            }
        } "\n"
    }
}

fn maps(map: &ErrorMap) -> Markup {
    html! {
        h3 { "Errors over the complex plane" } "\n"
        div.maps { "\n"
            @for o in &map.outputs {
                figure {
                    (plots::map(map, &o.ulps))
                    figcaption { (o.name) ", ulps at " (o.ulps.len()) " points" }
                } "\n"
            }
        } "\n"
        (plots::map_legend()) "\n"
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::html::page::tests::whole;
    use crate::report::text::method::tests::{fabricated, passing};

    #[test]
    fn the_verdict_comes_first_then_what_is_over_budget() {
        let page = page(&[fabricated()], None, false);
        whole(&page);
        let order = [
            "<title>Audit of 1 method: NOT as expected</title>",
            "NOT as expected</span>: 0 of 1 methods pass, 399 of 400 cases.",
            "1 of 400 cases do not pass",
            "<table>",
            "id=\"a-method\"",
            "reproduce  mechaudit audit a-method",
        ];
        let places: Vec<usize> = order.iter().map(|p| page.find(p).expect(p)).collect();
        assert!(places.is_sorted(), "{places:?}");
        let good = passing();
        assert!(!super::page(&[good], None, false).contains("class=\"news\""));
    }
}
