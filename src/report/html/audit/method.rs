//! One method, or one candidate for it.

use super::data::Data;
use super::overview::{cell, heat, legend, number, sorting};
use super::{anchor, word};
use crate::audit::{CaseReport, LawReport, MethodReport, OutputStatistics, RegionReport};
use crate::report::html::page::class;
use crate::report::text::case;
use crate::report::text::style::plain;
use crate::report::words::audit::{
    budgets, candidate, holds, kinds, mark, of_case, proved, undecided,
};
use crate::report::words::numbers::{percent, short, short_if};
use maud::{Markup, html};

/// Failing cases written out for each method.
const FAILURES_SHOWN: usize = 20;

/// The section; with all statistics where there is room for them.
pub fn section(k: usize, name: &str, r: &MethodReport, data: &Data, full: bool) -> Markup {
    let left = r.failures.len().saturating_sub(FAILURES_SHOWN) as u64 + r.failures_left_out;
    html! {
        section.method data-m=(k) { "\n"
            h2 id=(anchor(k)) { (name) " " (word(r)) } "\n"
            p { (r.summary) } "\n"
            @if let Some(c) = &r.candidate {
                p { b { (candidate(c)) } } "\n"
                @if let Some(trouble) = &c.trouble { p.alarm { (trouble) } "\n" }
            }
            p.soft.small { "Budget: " (budgets(r)) } "\n"
            @for bound in &r.proved { p.soft.small { "Proved: " (proved(bound)) } "\n" }
            p.soft.small { (r.source) } "\n"
            @for remark in &r.remarks { p.small { "Remark: " (remark) } "\n" }
            (outputs(r))
            h3 id={ "regions-" (k) } { "Regions" } "\n"
            (legend())
            (regions(k, r, data))
            @if full { (statistics(r)) }
            @for law in &r.laws { (self::law(law)) }
            h3 id={ "cases-" (k) } { "Cases to look at first" } "\n"
            (first(k, r, data))
            h3 .js id={ "figures-" (k) } { "Figures" } "\n"
            div.figures.js data-figures=(k) {} "\n"
            @if !r.failures.is_empty() {
                details { summary { "Failing cases in full" } "\n"
                    @for f in r.failures.iter().take(FAILURES_SHOWN) {
                        @let text = plain(&case::text(f, &r.layout, &r.reproduce_command(&f.case), 110));
                        pre { (text.trim_end()) } "\n"
                    }
                    @if left > 0 { p.alarm { (left) " more failing cases." } "\n" }
                } "\n"
            }
        } "\n"
    }
}

/// All regions together, output by output.
fn outputs(r: &MethodReport) -> Markup {
    html! {
        div.scroll tabindex="0" { table { "\n"
            thead { tr {
                th.left { "output" } th { "values" } th { "wrong kind" } th { "worst ulps" }
                th { "p99" } th { "median" } th { "RMS" } th { "worst u(1+cond)" } th { "of budget" }
                th { "worst condition" }
            } } "\n"
            tbody { "\n" @for o in r.outputs() { (output(o)) } } "\n"
        } } "\n"
        @if let Some(norm) = &r.total.normwise {
            p.small { "All outputs together, normwise: worst " (short(norm.max)) " u, p99 "
                (short(norm.p99)) ", median " (short(norm.median)) ", RMS " (short(norm.rms)) "." } "\n"
        }
        @if r.total.kinds.total() > 0 {
            p.small { "Answers of the wrong kind: " (kinds(&r.total.kinds)) "." } "\n"
        }
        @let open = undecided(&r.total);
        @if !open.is_empty() { p.alarm { (open) "." } "\n" }
    }
}

fn output(o: &OutputStatistics) -> Markup {
    let (some, conditioned) = (o.ulps.count > 0, o.conditioned.count > 0);
    html! {
        tr {
            td.left { (o.name) } td { (o.values) } td { (o.kinds.total()) }
            (number(some, o.ulps.max)) (number(some, o.ulps.p99)) (number(some, o.ulps.median))
            (number(some, o.ulps.rms)) (number(conditioned, o.conditioned.max))
            td.unexplained[o.max_of_budget > 1.0] { (percent(o.max_of_budget)) }
            td { (short_if(conditioned, o.max_condition)) }
        } "\n"
    }
}

/// The heat map of regions and outputs: worst ulps, coloured by the share of the budget.
fn regions(k: usize, r: &MethodReport, data: &Data) -> Markup {
    html! {
        div.scroll tabindex="0" { table.sortable.regions { "\n"
            thead { tr {
                th.left { "region" } th { "cases" } th { "failed" } th { "of budget" }
                @for o in r.outputs() { th { (o.name) ", ulps" } }
                @if r.total.normwise.is_some() { th { "norm, u" } }
                th.left { "wrong kind" }
            } } "\n"
            tbody { "\n"
                @for (i, region) in r.regions.iter().enumerate() {
                    tr {
                        td.left.region data-v=(region.name) {
                            (region.name) small.meaning data-r=(i) { (region.description) }
                        }
                        td { (region.cases) } td { (region.failed()) }
                        td.(heat(region.failed() > 0, region.max_of_budget)) data-v=[sorting(region.max_of_budget)] {
                            button.heat data-c=[data.worst_of(k, i)] { (cell(region)) }
                        }
                        @for (j, o) in region.outputs.iter().enumerate() {
                            (of_output(data.worst_of_output(k, i, j), region, o))
                        }
                        @if let Some(norm) = &region.normwise { (number(norm.count > 0, norm.max)) }
                        @else if r.total.normwise.is_some() { td { "–" } }
                        td.left { (kinds(&region.kinds)) }
                    } "\n"
                }
            } "\n"
        } } "\n"
    }
}

fn of_output(worst: Option<usize>, region: &RegionReport, o: &OutputStatistics) -> Markup {
    let some = o.ulps.count > 0;
    let failed = o.max_of_budget > 1.0 && region.failed() > 0 || o.kinds.total() > 0;
    let text = match (some, o.kinds.total()) {
        (true, _) => short(o.ulps.max),
        (false, 0) => "–".into(),
        (false, n) => format!("✗ {n}"),
    };
    html! {
        td.(heat(failed, o.max_of_budget)) data-v=[sorting(o.ulps.max)] {
            @if worst.is_some() {
                button.heat data-c=[worst] { (text) }
            } @else { (text) }
        }
    }
}

/// Every region and output with all its statistics.
fn statistics(r: &MethodReport) -> Markup {
    html! {
        details { summary { "All statistics by region and output" }
            div.scroll.tall tabindex="0" { table.sortable { "\n"
                thead { tr {
                    th.left { "region" } th.left { "output" } th { "values" } th { "wrong kind" }
                    th { "worst ulps" } th { "p99" } th { "median" } th { "RMS" }
                    th { "worst u(1+cond)" } th { "p99" } th { "of budget" } th { "worst condition" }
                } } "\n"
                tbody { "\n" @for region in &r.regions { @for o in &region.outputs {
                    @let (some, conditioned) = (o.ulps.count > 0, o.conditioned.count > 0);
                    tr {
                        td.left { (region.name) } td.left { (o.name) } td { (o.values) }
                        td { (o.kinds.total()) }
                        (number(some, o.ulps.max)) (number(some, o.ulps.p99))
                        (number(some, o.ulps.median)) (number(some, o.ulps.rms))
                        (number(conditioned, o.conditioned.max)) (number(conditioned, o.conditioned.p99))
                        td data-v=[sorting(o.max_of_budget)] { (percent(o.max_of_budget)) }
                        (number(conditioned, o.max_condition))
                    } "\n"
                } } } "\n"
            } }
        } "\n"
    }
}

fn law(law: &LawReport) -> Markup {
    let (sign, tone) = mark(law);
    html! {
        p.small.alarm[!holds(law)] {
            span.sign.(class(tone)) { (sign) } " " (law.name) ": " (law.statement) " "
            span.soft {
                "(worst residual " (percent(law.worst)) " of what is allowed, " (law.cases) " cases)"
            }
        } "\n"
    }
}

/// The worst cases and those of each wrong kind, each with what it takes to run it again.
fn first(k: usize, r: &MethodReport, data: &Data) -> Markup {
    let cases: Vec<&CaseReport> = r.wrong.iter().chain(&r.worst).collect();
    html! {
        div.scroll tabindex="0" { table.sortable { "\n"
            thead { tr {
                th.js data-sort="none" { "case" } th.left { "verdict" } th.left { "region" }
                th { "of budget" } th { "ulps" } th.left { "reason, or the command" }
            } } "\n"
            tbody { "\n" @for c in cases {
                @let (word, tone) = of_case(c.judgement.verdict);
                @let of = |f: fn(&crate::audit::ComponentJudgement) -> f64| {
                    let all = c.judgement.components.iter().map(f).filter(|x| !x.is_nan());
                    all.fold(f64::NAN, f64::max)
                };
                @let share = of(|c| c.of_budget);
                @let ulps = of(|c| c.ulps);
                tr {
                    td.js { button.open data-c=[data.place_of(k, &c.case)] {
                        "open"
                    } }
                    td.left { span.sign.(class(tone)) { (word) } }
                    td.left { (c.case.region) }
                    td data-v=[sorting(share)] { (percent(share)) }
                    (number(!ulps.is_nan(), ulps))
                    td.left.wrap {
                        @if let Some(reason) = &c.judgement.reason { div.reason { (reason) } }
                        code { (r.reproduce_command(&c.case)) }
                    }
                } "\n"
            } } "\n"
        } } "\n"
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::audit::Kind;
    use crate::report::gallery::Gallery;
    use crate::report::text::method::tests::fabricated;

    fn cell_of(change: impl Fn(&mut RegionReport)) -> String {
        let mut region = fabricated().total;
        region.outputs[0].max_of_budget = 1.0;
        change(&mut region);
        let o = region.outputs[0].clone();
        of_output(Some(3), &region, &o).into_string()
    }

    /// In the colour of its share, unless it is over budget where cases fail or has values of the
    /// wrong kind; figures where there are errors.
    #[test]
    fn outputs() {
        let mut all = Gallery::default();
        type Change = fn(&mut RegionReport);
        let changes: [(&str, Change); 7] = [
            ("within", |_| ()),
            ("over", |r| r.outputs[0].max_of_budget = 1.25),
            ("recorded", |r| {
                r.outputs[0].max_of_budget = 1.25;
                (r.passed, r.over) = (r.cases, 0);
            }),
            ("wrong", |r| r.outputs[0].kinds[Kind::Nan] = 1),
            ("one", |r| r.outputs[0].ulps.count = 1),
            ("none", |r| r.outputs[0].ulps.count = 0),
            ("none but wrong", |r| {
                r.outputs[0].ulps.count = 0;
                r.outputs[0].kinds[Kind::Nan] = 4;
            }),
        ];
        for (name, change) in changes {
            all.add(name, cell_of(change));
        }
        let mut o = fabricated().total.outputs.remove(0);
        o.conditioned.max = 0.5;
        for counts in [[400, 0], [0, 1], [1, 0]] {
            [o.ulps.count, o.conditioned.count] = counts;
            all.add(format!("{counts:?} values"), output(&o).into_string());
        }
        all.pin("outputs");
    }

    #[test]
    fn failing_cases_beyond_those_shown_are_counted() {
        let seen = |failures: usize, left_out: u64| {
            let mut report = fabricated();
            report.failures = vec![report.failures[0].clone(); failures];
            report.failures_left_out = left_out;
            let named = [("a-method", &report)];
            let html = section(0, "a-method", &report, &Data::of(&named), false).into_string();
            let more = html.split(" more failing cases").next().unwrap();
            let left = html.contains("more failing cases").then(|| {
                let digits = more.rsplit('>').next().unwrap();
                digits.parse::<u64>().unwrap()
            });
            (html.matches("<pre>").count(), left)
        };
        assert_eq!(seen(FAILURES_SHOWN, 0), (FAILURES_SHOWN, None));
        assert_eq!(seen(FAILURES_SHOWN + 3, 0), (FAILURES_SHOWN, Some(3)));
        assert_eq!(seen(FAILURES_SHOWN + 3, 4), (FAILURES_SHOWN, Some(7)));
        assert_eq!(seen(2, 4), (2, Some(4)));
        assert_eq!(seen(0, 0), (0, None));
    }
}
