//! A motion computed once, as a page: its curves, what is known of it, some of its rows.

use super::assets::RUN_CSS;
use super::page::Page;
use super::prose::prose;
use super::{linkage::sentence, panel, plots};
use crate::report::cell::Cell;
use crate::report::svg::panel::Panel;
use crate::report::words::numbers::short;
use maud::{Markup, PreEscaped, html};

/// A part of the page.
pub struct Section {
    /// The topic of its columns, by which the page refers to it.
    pub key: &'static str,
    /// Its heading.
    pub title: String,
    /// Its curves.
    pub figures: Vec<Figure>,
    /// The output of [`Form::Table`](crate::report::rows::Form::Table).
    pub table: Vec<u8>,
}

/// A diagram.
pub enum Figure {
    /// Curves over a common abscissa.
    Panel(Panel),
    /// Lines in doubly logarithmic axes: a caption, the lines.
    Logarithmic(String, Vec<(String, Vec<(f64, f64)>)>),
}

impl From<Panel> for Figure {
    fn from(panel: Panel) -> Figure {
        Figure::Panel(panel)
    }
}

/// The page of a machine of that name; `facts` are lines about it.
pub fn page(name: &str, kind: &str, facts: &[String], sections: &[Section]) -> String {
    let keys: Vec<&str> = sections.iter().map(|s| s.key).collect();
    let page = Page {
        title: &format!("{name}: {kind}"),
        kind,
        styles: &[RUN_CSS],
        contents: html! {
            @for s in sections { li { a href={ "#" (s.key) } { b { (s.title) } } } "\n" }
            li { a href="#facts" { b { "In words" } } } "\n"
        },
        main: html! {
            h1 { (name) } "\n"
            @for s in sections { (section(s)) }
            h2 #facts { "In words" } "\n"
            @for line in facts { p { (prose(&sentence(line))) } "\n" }
        },
        columns: (&keys, &[]),
        data: &[],
        scripts: &[],
    };
    page.write()
}

fn section(s: &Section) -> Markup {
    html! {
        section { "\n"
            h2 id=(s.key) { (s.title) } "\n"
            div.panels { "\n" @for f in &s.figures { (figure(f)) } } "\n"
            (PreEscaped(String::from_utf8_lossy(&s.table)))
        } "\n"
    }
}

fn figure(figure: &Figure) -> Markup {
    match figure {
        Figure::Panel(panel) => panel::panel(panel),
        Figure::Logarithmic(caption, lines) => html! {
            figure.panel { figcaption { (prose(caption)) } div.lines { div { (plots::lines(caption, lines)) } } } "\n"
        },
    }
}

/// The rows that were kept, of which there are `every` times as many.
pub fn table(names: &[String], rows: &[Vec<Cell>], every: usize) -> Markup {
    let text = |cell: &Cell| match cell {
        Cell::Float(x) if x.is_finite() => short(*x),
        Cell::Float(_) => String::new(),
        other => other.text(),
    };
    html! {
        p.soft.small {
            @match every { 1 => "All rows; ", n => { "One row of " (n) "; all rows and " } }
            "all digits by " code { "--format csv" } "."
        } "\n"
        div.scroll.tall tabindex="0" { table { "\n"
            thead { tr { @for name in names { th { (name) } } } } "\n"
            tbody { "\n" @for row in rows {
                tr { @for (k, cell) in row.iter().enumerate() {
                    @if k == 0 { th { (text(cell)) } } @else { td { (text(cell)) } }
                } } "\n"
            } } "\n"
        } } "\n"
    }
}

#[cfg(test)]
mod tests {
    use super::super::page::tests::whole;
    use super::*;
    use crate::report::svg::panel::curve;
    use crate::report::svg::style::BLUE;

    #[test]
    fn a_page_has_its_curves_rows_and_columns() {
        let names = ["t_s", "phi1_deg"].map(String::from);
        let rows = [
            [Cell::Float(0.0), Cell::Float(f64::NAN)],
            [Cell::Float(1.0), Cell::Float(2.0)],
        ];
        let table = table(&names, &rows.map(Vec::from), 8)
            .into_string()
            .into_bytes();
        let line = curve("y", vec![(0.0, 0.0), (1.0, 2.0)], BLUE);
        let lines = vec![("D_n".to_string(), vec![(1.0, 1.0), (2.0, 0.5)])];
        let sections = [Section {
            key: "runup",
            title: "The <run>".into(),
            figures: vec![
                Panel::new("time, s", "speed, m/s", vec![line]).into(),
                Figure::Logarithmic("amplitudes D_n".into(), lines),
            ],
            table,
        }];
        let text = page("a <machine>", "run-up", &["it runs".into()], &sections);
        whole(&text);
        for part in [
            "<title>a &lt;machine&gt;: run-up</title>",
            "<h2 id=\"runup\">The &lt;run&gt;</h2>",
            "<b>speed, m/s</b> over time, s",
            "amplitudes D<sub>n</sub>",
            "One row of 8",
            "<th>t_s</th><th>phi1_deg</th>",
            "<tr><th>1.00</th><td>2.00</td></tr>",
            "<p>It runs.</p>",
            "crank angle, whole turns included, in °",
        ] {
            assert!(text.contains(part), "{part} is missing in {text}");
        }
    }
}
