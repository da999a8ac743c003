//! A paper's report as one page without outside parts.

mod printed;

use super::assets::{D3_JS, FIGURES_JS, MOTION_JS, PLOT_JS};
use super::page::{AboutPaper, class, counted, entry_of_contents, filter};
use super::prose::{math, prose};
use super::{motion, spark};
use crate::motion::Motion;
use crate::papers::{Entry, EntryVerdict, Figure, Finding, PaperReport, Tally};
use crate::report::words::numbers::{clipped, short, unit};
use crate::report::words::paper::{SUBJECTS, entry, findings, mark, of_subject};
use maud::{Markup, html};
use pulldown_latex::config::DisplayMode;
use std::collections::{BTreeMap, BTreeSet};

/// The page; with the mechanism in motion where the paper has one.
pub fn page(report: &PaperReport, moving: Option<&Motion>) -> String {
    let verdicts = counted(report.findings.iter().map(|f| mark(f.verdict).1));
    let (data, scripts) = match moving {
        Some(m) => (
            vec![("motion-data", motion::data(m))],
            &[D3_JS, PLOT_JS, FIGURES_JS, MOTION_JS][..],
        ),
        None => (Vec::new(), &[][..]),
    };
    let about = AboutPaper {
        paper: &report.paper,
        kind: "audit",
        verdict: (report.as_recorded(), findings(report)),
        contents: contents(report, moving),
        main: html! {
            @if let Some(m) = moving { (motion::section(m, &positions(m))) }
            h2 #findings { "Findings" } "\n"
            (filter("article.finding", "findings", &verdicts))
            @for (subject, name) in SUBJECTS {
                @let findings = of_subject(report, subject);
                @if !findings.is_empty() {
                    section data-filtered { "\n"
                        h3 id={ "subject-" (name) } { (name) } "\n"
                        div.flow { "\n"
                            @for (f, wide) in findings.iter().zip(wide(&findings)) {
                                (finding(f, wide))
                            }
                        } "\n"
                    } "\n"
                }
            }
            (tallies(report))
            (printed::table(report))
            (entries(report))
        },
        columns: if report.entries.is_empty() {
            &[]
        } else {
            &["paper"]
        },
        data: &data,
        scripts,
    };
    about.page()
}

/// Describes the positions and the curves.
fn positions(motion: &Motion) -> Markup {
    let drive = &motion.drive.values;
    let variants = motion.courses.first().map(|c| &c.variants[..]);
    html! {
        (drive.len()) " positions of one turn by the f64 solver"
        @if let [a, b, ..] = drive[..] { ", one every " (short(b - a)) "°" } ". "
        @for (k, (name, _)) in variants.unwrap_or_default().iter().enumerate() {
            (if k == 0 { "Solid: centres of mass " } else { "; dashed: " }) (name)
        }
        ". Rings: values printed in the paper's tables."
    }
}

fn tables(report: &PaperReport) -> BTreeSet<u32> {
    report.entries.iter().map(|e| e.table).collect()
}

fn contents(report: &PaperReport, moving: Option<&Motion>) -> Markup {
    html! {
        @if let Some(m) = moving {
            li { a href="#motion" { b { (m.name) " in motion" } } } "\n"
        }
        @for (subject, name) in SUBJECTS {
            @let findings = of_subject(report, subject);
            @if !findings.is_empty() {
                li {
                    a href={ "#subject-" (name) } { b { (name) } } "\n"
                    ul { "\n"
                        @for f in findings {
                            @let (sign, _, tone) = mark(f.verdict);
                            (entry_of_contents(f.id, tone, sign, &f.title))
                        }
                    }
                } "\n"
            }
        }
        @if !report.entries.is_empty() {
            li { a href="#printed-entries" { b { "Printed entries" } } } "\n"
        }
        @if !report.tallies.is_empty() {
            li { a href="#tallies" { b { "Entries that agree" } } } "\n"
        }
        @for n in tables(report) {
            li { a href={ "#table-" (n) } { b { "Table " (n) " as printed" } } } "\n"
        }
    }
}

/// Formulas of more characters than this have the width of the page.
pub const WIDE: usize = 75;

/// Which cards have the width of the page: those of long formulas, and those alone between them.
fn wide(findings: &[&Finding]) -> Vec<bool> {
    let long = |g: &Figure| g.latex.is_some() && g.value.chars().count() > WIDE;
    let own: Vec<bool> = findings
        .iter()
        .map(|f| f.figures.iter().any(long))
        .collect();
    let some = own.contains(&true);
    let at = |k: Option<usize>| k.and_then(|k| own.get(k)).is_none_or(|w| *w);
    (0..own.len())
        .map(|k| own[k] || (some && at(k.checked_sub(1)) && at(Some(k + 1))))
        .collect()
}

fn finding(f: &Finding, wide: bool) -> Markup {
    let (sign, words, tone) = mark(f.verdict);
    html! {
        article.finding.(class(tone)).wide[wide] id=(f.id) data-verdict=(words) { "\n"
            h3 { (prose(&f.title)) } "\n"
            div.tag { (sign) " " (words) " " span.soft { "· " (prose(f.place)) } } "\n"
            @if !f.as_recorded {
                p.alarm { "Not as recorded: earlier runs found otherwise." } "\n"
            }
            p { (prose(&f.text)) } "\n"
            @if !f.figures.is_empty() {
                dl.figures { "\n" @for g in &f.figures { (figure(g)) "\n" } } "\n"
            }
        } "\n"
    }
}

fn figure(g: &Figure) -> Markup {
    html! {
        dt { (prose(&g.name)) }
        @match &g.latex {
            Some(latex) => dd.formula { (math(latex, &g.value, DisplayMode::Block)) },
            None => dd { (prose(&g.value)) " " (unit(g.unit)) },
        }
    }
}

fn tallies(report: &PaperReport) -> Markup {
    let mut tallies: Vec<_> = report.tallies.iter().collect();
    tallies.sort_by_key(|t| t.table);
    html! {
        @if !tallies.is_empty() {
            h2 id="tallies" { "Entries that agree" } "\n"
            p.soft {
                (report.entries.len()) " printed entries recomputed. "
                "Deviations in units of the last printed digit; within ½ is the correct rounding."
            } "\n"
            div.scroll tabindex="0" { table.sortable { "\n"
                thead { tr {
                    th { "table" } th.left { "data" } th.left { "column" }
                    th.left data-sort="none" { "deviations by row, ±2 units" } th { "entries" }
                    th { "within ½" } th { "within 1" } th { "worst units" } th { "worst deviation" }
                } } "\n"
                tbody { "\n" @for t in tallies {
                    @let class = match t.entries {
                        n if n == t.within_half => "agrees",
                        n if n == t.within_one => "rounding",
                        _ => "",
                    };
                    tr class=(class) {
                        td { (t.table) }
                        td.left { (t.variant.replace('_', " ")) }
                        td.left { (prose(t.column)) }
                        td { (spark::deviations(t.column, &along(report, t))) }
                        td { (t.entries) } td { (t.within_half) } td { (t.within_one) }
                        td data-v=(t.worst_units) { (short(t.worst_units)) }
                        td data-v=(t.worst) { (short(t.worst)) }
                    } "\n"
                } } "\n"
            } } "\n"
        }
    }
}

/// Deviations of a column in units of its last digits, row by row.
fn along(report: &PaperReport, t: &Tally) -> Vec<f64> {
    let of = report
        .entries
        .iter()
        .filter(|e| e.table == t.table && e.column == t.column);
    of.filter_map(|e| Some(e.variants.get(t.variant)?.units_in_last_digit))
        .collect()
}

fn entries(report: &PaperReport) -> Markup {
    html! {
        @for (i, number) in tables(report).into_iter().enumerate() {
            @let of: Vec<&Entry> = report.entries.iter().filter(|e| e.table == number).collect();
            h2 id={ "table-" (number) } { "Table " (number) " as printed" } "\n"
            @if i == 0 {
                p.soft { "Recomputed values stand under " a href="#printed-entries" { "Printed entries" } "." } "\n"
                p.legend {
                    span.agrees { "agrees" } span.rounding { "within one unit" }
                    span.misprint { "misprint" } span.unexplained { "unexplained" }
                } "\n"
            }
            @let variants: BTreeSet<&str> = of.iter().flat_map(|e| e.variants.keys().copied()).collect();
            div.side { "\n"
                @for variant in variants {
                    details open { summary { "Data: " (variant.replace('_', " ")) } "\n"
                        div.scroll tabindex="0" { (grid(&of, variant)) }
                        (remarks(&of, variant))
                    } "\n"
                }
            } "\n"
        }
    }
}

/// Remarks on a table at most.
const REMARKS: usize = 20;

/// Lines about entries that do not agree, or that something is said about.
fn remarks(entries: &[&Entry], variant: &str) -> Markup {
    let judged = entries
        .iter()
        .filter_map(|e| Some((e, e.variants.get(variant)?)));
    let told: Vec<_> = judged
        .filter(|(_, r)| r.note.is_some() || wrong(r.verdict))
        .collect();
    html! {
        @if told.len() > REMARKS {
            p.small { (told.len()) " entries do not agree; their deviations stand under Printed entries." } "\n"
        } @else if !told.is_empty() {
            ul.small { "\n" @for (e, r) in told {
                li {
                    "row " (e.row) ", " (prose(e.column)) ": printed " (e.printed) ", recomputed "
                    (clipped(&r.recomputed, 16)) ", " (short(r.units_in_last_digit)) " units: " (entry(r.verdict))
                    @if let Some(note) = &r.note { "; " (prose(note)) }
                } "\n"
            } } "\n"
        }
    }
}

fn wrong(verdict: EntryVerdict) -> bool {
    matches!(verdict, EntryVerdict::Misprint | EntryVerdict::Unexplained)
}

fn grid(entries: &[&Entry], variant: &str) -> Markup {
    let mut columns: Vec<&str> = Vec::new();
    let mut rows: BTreeMap<u32, Vec<&Entry>> = BTreeMap::new();
    for e in entries {
        if !columns.contains(&e.column) {
            columns.push(e.column);
        }
        rows.entry(e.row).or_default().push(e);
    }
    html! {
        table.entries { "\n"
            thead { tr { th { "row" } @for c in &columns { th.given { (prose(c)) } } } } "\n"
            tbody { "\n" @for (row, cells) in rows {
                tr {
                    th { (row) }
                    @for column in &columns {
                        @match cells.iter().find(|e| e.column == *column) {
                            Some(e) => (cell(e, variant)),
                            None => td {},
                        }
                    }
                } "\n"
            } } "\n"
        } "\n"
    }
}

fn cell(e: &Entry, variant: &str) -> Markup {
    let Some(r) = e.variants.get(variant) else {
        return html! { td { (e.printed) } };
    };
    let word = entry(r.verdict);
    let mut tip = format!(
        "recomputed {}\n{} units of the last digit: {word}",
        r.recomputed,
        short(r.units_in_last_digit),
    );
    if let Some(note) = &r.note {
        tip.push_str(&format!("\n{note}"));
    }
    html! { td class=(word) tabindex=[wrong(r.verdict).then_some("0")] data-tip=(tip) { (e.printed) } }
}

#[cfg(test)]
mod tests;
