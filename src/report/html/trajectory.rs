//! A certified motion: its curves, which a slider moves over, and its digits; the errors of a
//! simulation over time.

use super::assets::{D3_JS, FIGURES_JS, MOTION_CSS, MOTION_JS, PLOT_JS, RUN_CSS};
use super::linkage::sentence;
use super::motion;
use super::page::{Page, verdict};
use super::panel::panel;
use super::prose::prose;
use crate::motion::Motion;
use crate::report::cell::Cell;
use crate::report::svg::panel::{Panel, curve};
use crate::report::svg::style::{BLUE, GREEN, ORANGE, PURPLE};
use crate::report::words::Tone;
use maud::{Markup, html};

/// Rows of the table at most.
const ROWS: usize = 101;

/// The page: `facts` are lines about the motion, and a row of the table is a time with its values.
pub fn page(
    moving: &Motion,
    digits: Option<u32>,
    facts: &[String],
    (names, rows): (&[String], &[Vec<Cell>]),
) -> String {
    let drive = &moving.drive;
    let about = html! {
        (drive.values.len()) " times, "
        @if let Some(digits) = digits { (digits) " certified digits each" } @else { "in floating point" }
        ": curves are drawn through them. Arrow keys move the "
        "slider; a press on a curve does too."
    };
    let page = Page {
        title: &format!("{}: motion", moving.name),
        kind: "motion",
        styles: &[MOTION_CSS],
        contents: html! {
            li { a href="#motion" { b { "In motion" } } } "\n"
            li { a href="#values" { b { "Values" } } } "\n"
            li { a href="#facts" { b { "In words" } } } "\n"
        },
        main: html! {
            h1 { (moving.name) } "\n"
            (motion::section(moving, &about))
            h2 #values { "Values" } "\n"
            (table(names, rows))
            h2 #facts { "In words" } "\n"
            @for line in facts { p { (prose(&sentence(line))) } "\n" }
        },
        columns: (&[], &[]),
        data: &[("motion-data", motion::data(moving))],
        scripts: &[D3_JS, PLOT_JS, FIGURES_JS, MOTION_JS],
    };
    page.write()
}

/// Some of the rows, evenly spaced.
fn table(names: &[String], rows: &[Vec<Cell>]) -> Markup {
    let every = rows.len().div_ceil(ROWS).max(1);
    html! {
        p.soft.small {
            @match every { 1 => "All rows; also by ", n => { "One row of " (n) "; all rows by " } }
            code { "--format csv" } "."
        } "\n"
        div.scroll.tall tabindex="0" { table { "\n"
            thead { tr { @for name in names { th.given { (name) } } } } "\n"
            tbody { "\n" @for row in rows.iter().step_by(every) {
                tr { @for (k, cell) in row.iter().enumerate() {
                    @if k == 0 { th { (cell.text()) } } @else { td { (cell.text()) } }
                } } "\n"
            } } "\n"
        } } "\n"
    }
}

/// The error of a quantity over time.
pub struct ErrorCurve {
    /// The quantity.
    pub name: &'static str,
    /// Times and absolute errors.
    pub points: Vec<(f64, f64)>,
}

/// Curves of a panel at most.
const CURVES: usize = 4;

/// The page of a simulation that was judged: of that title, from that file, over that time. The
/// table has a row for each quantity.
pub fn errors(
    (title, file, time): (&str, &str, &str),
    (passes, head): (bool, String),
    curves: &[ErrorCurve],
    (names, rows): (&[&str], &[Vec<String>]),
    facts: &[String],
) -> String {
    let (tone, word) = match passes {
        true => (Tone::Good, "Pass"),
        false => (Tone::Bad, "FAIL"),
    };
    let colours = [BLUE, ORANGE, GREEN, PURPLE];
    let panels = curves.chunks(CURVES).map(|some| {
        let lines = some.iter().zip(colours).map(|(c, colour)| {
            let seen = c.points.iter().filter(|p| p.1 > 0.0 && p.1.is_finite());
            curve(c.name, seen.map(|p| (p.0, p.1.log10())).collect(), colour)
        });
        Panel::new(
            time,
            "decimal logarithm of the error",
            lines.collect::<Vec<_>>(),
        )
    });
    let page = Page {
        title: &format!("{title}: errors of {file}"),
        kind: "errors",
        styles: &[RUN_CSS],
        contents: html! {
            li { a href="#errors" { b { "Errors over time" } } } "\n"
            li { a href="#columns-judged" { b { "Columns" } } } "\n"
            li { a href="#facts" { b { "Budgets" } } } "\n"
        },
        main: html! {
            h1 { (title) } "\n"
            p.soft { (file) } "\n"
            (verdict(tone, word, &format!("{head}.")))
            h2 #errors { "Errors over time" } "\n"
            p.soft { "Distances from the certified motion, in the unit of each quantity. An error of zero has no place in a drawing." } "\n"
            div.panels { "\n" @for p in panels { (panel(&p)) } } "\n"
            h2 #columns-judged { "Columns" } "\n"
            div.scroll tabindex="0" { table { "\n"
                thead { tr { @for name in names { th.given { (name) } } } } "\n"
                tbody { "\n" @for row in rows {
                    tr { @for (k, cell) in row.iter().enumerate() {
                        @if k == 0 { th { (prose(cell)) } } @else { td { (cell) } }
                    } } "\n"
                } } "\n"
            } } "\n"
            p.soft.small {
                "Digits that are right are those of the largest value of the column. All rows by " code { "--format csv" } "."
            } "\n"
            h2 #facts { "Budgets" } "\n"
            @for line in facts { p { (prose(&sentence(line))) } "\n" }
        },
        columns: (&[], &[]),
        data: &[],
        scripts: &[],
    };
    page.write()
}

#[cfg(test)]
mod tests {
    use super::super::page::tests::{between, whole};
    use super::*;
    use crate::motion::{Course, Drive};

    /// A motion of `n` times with one quantity.
    fn moving(n: usize) -> (Motion, Vec<Vec<Cell>>) {
        let values: Vec<f64> = (0..n).map(|k| k as f64).collect();
        let rows = values.iter().map(|x| {
            let value = (*x != 1.0).then(|| format!("{x}.50"));
            vec![Cell::Word(x.to_string()), Cell::certified(value)]
        });
        let rows = rows.collect();
        let motion = Motion {
            name: "a <swing>".into(),
            drive: Drive {
                symbol: "t",
                unit: "",
                values: values.clone(),
            },
            closed: false,
            start: 0,
            points: Vec::new(),
            links: Vec::new(),
            plates: Vec::new(),
            guides: Vec::new(),
            wheels: Vec::new(),
            courses: vec![Course {
                name: "theta".into(),
                unit: "rad".into(),
                variants: vec![(String::new(), values)],
                printed: Vec::new(),
            }],
        };
        (motion, rows)
    }

    #[test]
    fn a_page_has_its_curves_and_digits() {
        let (motion, rows) = moving(3);
        let names = ["t", "theta [rad]"].map(String::from);
        let text = page(
            &motion,
            Some(15),
            &["theta' = omega".into()],
            (&names, &rows),
        );
        whole(&text);
        for part in [
            "<title>a &lt;swing&gt;: motion</title>",
            "3 times, 15 certified digits each",
            "<th class=\"given\">theta [rad]</th>",
            "<tr><th>0</th><td>0.50</td></tr>",
            "<tr><th>1</th><td>undecided</td></tr>",
            "All rows",
        ] {
            assert!(text.contains(part), "{part} is missing");
        }
        assert!(!text.contains("id=\"mechanism\""), "nothing is drawn");
    }

    #[test]
    fn errors_are_drawn_four_to_a_panel() {
        let names = ["a", "b", "c", "d", "<e>"];
        let curves = names.map(|name| ErrorCurve {
            name,
            points: vec![(0.0, 0.0), (1.0, 1e-9), (2.0, 1e-6), (3.0, f64::NAN)],
        });
        let rows = [vec!["a".to_string(), "1e-6".to_string()]];
        let table = (&["column", "largest error"][..], &rows[..]);
        let facts = ["a: relative error 1e-9".to_string()];
        let head = (false, "1 of 2 entries not within budget".to_string());
        let text = errors(("Swing", "sim.csv", "t"), head, &curves, table, &facts);
        whole(&text);
        assert_eq!(text.matches("<figure class=\"panel\">").count(), 2);
        for part in ["FAIL", "&lt;e&gt;", "A: relative error 1e-9.", "sim.csv"] {
            assert!(text.contains(part), "{part} is missing");
        }
    }

    #[test]
    fn a_table_has_101_rows_at_most() {
        for (n, due) in [(101, 101), (102, 51), (1000, 100)] {
            let (_, rows) = moving(n);
            let html = table(&["t".into(), "x".into()], &rows).into_string();
            assert_eq!(between(&html, "<td>", "</td>").len(), due, "{n}");
        }
    }
}
