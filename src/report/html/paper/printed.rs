//! Every printed entry in one table, to be sorted and filtered.

use super::super::page::{counted, filter};
use super::super::prose::prose;
use crate::papers::{Entry, PaperReport};
use crate::report::words::numbers::{clipped, short};
use crate::report::words::paper::entry;
use maud::{Markup, html};
use std::collections::BTreeSet;

/// Widest bar of a deviation, in tenths of a rem, and the deviation that has it.
const WIDEST: (f64, f64) = (40.0, 5.0);

/// The table. The verdict and the recomputed value are those of the last variant of the data: the
/// one with the most recovered.
pub fn table(report: &PaperReport) -> Markup {
    let variants: BTreeSet<&str> = report
        .entries
        .iter()
        .flat_map(|e| e.variants.keys().copied())
        .collect();
    let Some(last) = variants.last() else {
        return html! {};
    };
    let spoken = |v: &str| v.replace('_', " ");
    let verdict = |e: &Entry| e.variants.get(last).map_or("", |r| entry(r.verdict));
    let verdicts = counted(report.entries.iter().map(verdict));
    html! {
        section { "\n"
            h2 #printed-entries { "Printed entries" } "\n"
            p.soft {
                (report.entries.len()) " entries; deviations (printed − recomputed) in units of the last "
                "printed digit. Recomputed value and verdict for the data " (spoken(last)) "."
            } "\n"
            (filter("#entries-table tbody tr", "entries", &verdicts))
            div.scroll.tall tabindex="0" { table.sortable.printed-entries #entries-table { "\n"
                thead { tr {
                    th { "table" } th { "row" } th.left { "column" } th { "printed" } th { "recomputed" }
                    th.left data-sort="none" { "deviation" } th.left { "verdict" }
                    @for v in &variants { th.given { (spoken(v)) } }
                } } "\n"
                tbody { "\n"
                    @for e in &report.entries { (row(e, &variants, last, verdict(e))) }
                } "\n"
            } } "\n"
        } "\n"
    }
}

fn row(e: &Entry, variants: &BTreeSet<&str>, last: &str, verdict: &str) -> Markup {
    let of = |v: &str| e.variants.get(v);
    let units = of(last).map_or(f64::NAN, |r| r.units_in_last_digit);
    // The sign of the number, without that of its zero.
    let digits = e.printed.trim_start_matches('-').len() + 3;
    html! {
        tr data-verdict=(verdict) {
            td { (e.table) } td { (e.row) } td.left { (prose(e.column)) }
            td { (e.printed) }
            td { @if let Some(r) = of(last) { (clipped(&r.recomputed, digits)) } }
            td.left { (bar(units)) }
            td.left.(verdict) { (verdict) }
            @for v in variants {
                @match of(v) {
                    Some(r) => td data-v=(r.units_in_last_digit) { (short(r.units_in_last_digit)) },
                    None => td {},
                }
            }
        } "\n"
    }
}

/// The deviation as a bar from the middle, to the left where it is negative.
fn bar(units: f64) -> Markup {
    let (width, most) = WIDEST;
    let w = (units.abs().min(most) / most * width).max(0.5);
    let x = if units < 0.0 { width - w } else { width };
    html! {
        svg.spark viewBox={ "0 0 " (2.0 * width) " 10" } width=(2.0 * width) height="10" aria-hidden="true" {
            path.zero d={ "M" (width) " 0V10" } {}
            rect.over[!(units.abs() <= most)] x=(format!("{x:.1}")) y="2" width=(format!("{w:.1}")) height="6" {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::gallery::Gallery;
    use crate::report::text::paper::tests::fabricated;

    /// Eight tenths of a rem for a unit, to the left below zero; half a tenth at least, and five
    /// units at most. A line has the verdict of the last variant and three more digits.
    #[test]
    fn bars_and_tables() {
        let mut all = Gallery::default();
        for units in [0.0, 0.01, -0.01, 0.1, 1.0, -2.5, 5.0, -12.0, f64::NAN] {
            all.add(units, bar(units).into_string());
        }
        let mut report = fabricated();
        report.entries[1].printed = "-1.243".into();
        all.add("table", table(&report).into_string());
        report.entries.clear();
        all.add("no entries", table(&report).into_string());
        all.pin("printed");
    }
}
