//! The heat map of methods and regions, as a table that sorts.

use super::data::Data;
use super::{anchor, word};
use crate::audit::{MethodReport, RegionReport};
use crate::report::words::audit::Worst;
use crate::report::words::numbers::{percent, short};
use maud::{Markup, html};

/// The class of colour of a region or output: by its share of the budget, or because cases fail.
pub fn heat(failed: bool, share: f64) -> &'static str {
    match share {
        _ if failed => "h5",
        s if s.is_nan() => "none",
        s if s <= 0.25 => "h0",
        s if s <= 0.5 => "h1",
        s if s <= 0.75 => "h2",
        s if s <= 1.0 => "h3",
        // Over budget by no more than is recorded.
        _ => "h4",
    }
}

/// A share of the budget in at most five characters.
pub fn brief(share: f64) -> String {
    match share {
        s if s.is_nan() => "–".into(),
        s if s < 9.995 => format!("{:.0} %", 100.0 * s),
        s if s < 1e4 => format!("{s:.0}×"),
        s => format!("{s:.0e}×"),
    }
}

/// The text of a region's cell: how many cases are of the wrong kind, or the share of the budget.
pub fn cell(region: &RegionReport) -> String {
    match region.kinds.total() {
        0 => brief(region.max_of_budget),
        n => format!("✗ {n}"),
    }
}

/// The words of a cell for a screen reader.
pub fn spoken(region: &RegionReport) -> String {
    format!(
        "{}: {} of {} cases pass, worst {} of its budget",
        region.name,
        region.passed,
        region.cases,
        percent(region.max_of_budget)
    )
}

/// A line for each method, a cell for each of its regions.
pub fn table(reports: &[&MethodReport], data: &Data) -> Markup {
    html! {
        section { "\n"
            h2 #overview { "Overview" } "\n"
            (legend())
            div.scroll tabindex="0" { table.sortable #overview-table { "\n"
                thead { tr {
                    th.left { "method" } th.left { "verdict" } th { "cases" } th { "failed" }
                    th { "worst ulps" } th { "of budget" }
                    th.left data-sort="none" { "regions: worst share of the budget" }
                } } "\n"
                tbody { "\n" @for (k, r) in reports.iter().enumerate() { (row(k, r, data)) } } "\n"
            } } "\n"
        } "\n"
    }
}

fn row(k: usize, r: &MethodReport, data: &Data) -> Markup {
    let ulps = r.outputs().iter().map(|o| o.ulps.max).fold(0.0, f64::max);
    html! {
        tr data-m=(k) {
            td.left { a href={ "#" (anchor(k)) } { (r.method) } }
            td.left { (word(r)) }
            td { (r.cases) } td { (r.failed()) }
            td data-v=[sorting(ulps)] { (Worst::of(r).ulps) }
            td data-v=[sorting(r.total.max_of_budget)] { (percent(r.total.max_of_budget)) }
            td.left.strip { @for (i, region) in r.regions.iter().enumerate() {
                button.heat.(heat(region.failed() > 0, region.max_of_budget)) aria-label=(spoken(region))
                    data-c=[data.worst_of(k, i)] {
                    (cell(region))
                }
            } }
        } "\n"
    }
}

/// The meanings of the colours.
pub fn legend() -> Markup {
    html! {
        p.legend.small {
            @for (class, name) in [
                ("h0", "≤ 25 % of the budget"), ("h1", "≤ 50 %"), ("h2", "≤ 75 %"),
                ("h3", "≤ 100 %"), ("h4", "over, as recorded"), ("h5", "cases fail"),
                ("none", "no error to judge"),
            ] {
                span.heat.(class) { (name) } " "
            }
            span.js { "A cell opens its worst case and says what its region is; ✗ counts answers of the wrong kind." }
        } "\n"
    }
}

/// Returns the number to sort by. NaN has none: such a cell shows a dash and comes after all
/// numbers.
pub fn sorting(x: f64) -> Option<String> {
    match x {
        0.0 => Some("0".into()),
        _ if x.is_nan() => None,
        _ if x.is_infinite() => Some(format!("{}Infinity", if x < 0.0 { "-" } else { "" })),
        _ => Some(format!("{x:.3e}")),
    }
}

/// A number, and what to sort it by.
pub fn number(there: bool, x: f64) -> Markup {
    html! { @if there { td data-v=[sorting(x)] { (short(x)) } } @else { td { "–" } } }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::audit::Kind;
    use crate::report::gallery::Gallery;
    use crate::report::text::method::tests::fabricated;

    #[test]
    fn a_share_is_a_percentage_a_multiple_or_unknown() {
        for (share, due) in [
            (0.0, "0 %"),
            (0.504, "50 %"),
            (9.99, "999 %"),
            (9.996, "10×"),
            (9999.0, "9999×"),
            (1e4, "1e4×"),
            (12345.0, "1e4×"),
            (f64::INFINITY, "inf×"),
            (f64::NAN, "–"),
        ] {
            assert_eq!(brief(share), due);
        }
    }

    #[test]
    fn a_colour_says_how_near_the_budget_is_and_what_is_over_or_failed() {
        let of = |share| heat(false, share);
        let shares = [0.25, 0.5, 0.75, 1.0, 1.01, f64::INFINITY];
        let names = shares.map(of);
        assert_eq!(names[1..], ["h1", "h2", "h3", "h4", "h4"]);
        assert!(!names[1..].contains(&names[0]), "{names:?}");
        assert!(!names.contains(&heat(true, 0.25)), "{names:?}");
        assert_eq!(heat(true, f64::NAN), heat(true, 0.25));
        assert!(!names.contains(&of(f64::NAN)), "{names:?}");
    }

    #[test]
    fn numbers_sort_as_scripts_read_them() {
        for (x, due) in [
            (0.0, Some("0")),
            (-0.0, Some("0")),
            (f64::INFINITY, Some("Infinity")),
            (f64::NEG_INFINITY, Some("-Infinity")),
            (f64::NAN, None),
            (0.25, Some("2.500e-1")),
            (-1e300, Some("-1.000e300")),
        ] {
            assert_eq!(sorting(x).as_deref(), due);
        }
        let cell = |there| number(there, 0.25).into_string();
        assert_eq!(cell(true), "<td data-v=\"2.500e-1\">0.250</td>");
        assert_eq!(cell(false), "<td>–</td>");
    }

    #[test]
    fn a_line_has_the_worst_of_its_method_and_a_cell_for_each_region() {
        let mut report = fabricated();
        let mut second = report.total.outputs[0].clone();
        second.ulps.max = 9.5;
        report.total.outputs.insert(0, second);
        (report.regions[0].over, report.regions[0].passed) = (0, 400);
        report.regions[1].kinds[Kind::Nan] = 3;
        let data = Data::of(&[("a-method", &report), ("a-method", &report)]);
        let html = table(&[&report, &report], &data).into_string();
        let mut all = Gallery::default();
        all.add("overview", html);
        all.pin("overview");
    }
}
