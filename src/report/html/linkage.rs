//! A linkage moved by a slider over its drive, with the values of its rows.

use super::assets::{D3_JS, FIGURES_JS, MOTION_CSS, MOTION_JS, PLOT_JS};
use super::motion;
use super::page::Page;
use crate::motion::{Course, Motion};
use crate::report::columns::Columns;
use crate::report::words::numbers::short;
use maud::{Markup, html};

/// Positions in the tables at most.
const ROWS: usize = 25;
/// Columns of a table at most, besides the drive.
const COLUMNS: usize = 6;

/// The columns' values at each position as courses over the drive; the drive and the branch, which are the first two
/// columns, left out.
pub fn courses(columns: &Columns, rows: &[Vec<f64>]) -> Vec<Course> {
    let of = |k: usize| {
        let values = rows.iter().map(|r| columns.value(k, r[k - 2]));
        Course {
            name: columns.stem(k).into(),
            unit: columns.unit(k),
            variants: vec![(String::new(), values.collect())],
            printed: Vec::new(),
        }
    };
    (2..columns.names.len()).map(of).collect()
}

/// The page; `facts` are lines about the linkage.
pub fn page(motion: &Motion, facts: &[String]) -> String {
    let drive = &motion.drive;
    let ends = drive.values.first().zip(drive.values.last());
    let about = html! {
        (drive.values.len()) " positions by the f64 solver"
        @if let Some((a, b)) = ends { ", " (drive.symbol) " from " (number(*a)) " to " (number(*b)) " " (drive.unit) }
        ". Arrow keys move the slider; a press on a curve does too."
    };
    let page = Page {
        title: &format!("{}: linkage", motion.name),
        kind: "linkage",
        styles: &[MOTION_CSS],
        contents: html! {
            li { a href="#motion" { b { "In motion" } } } "\n"
            li { a href="#facts" { b { "Structure and range" } } } "\n"
            li { a href="#values" { b { "Values" } } } "\n"
        },
        main: html! {
            h1 { (motion.name) } "\n"
            (motion::section(motion, &about))
            h2 #facts { "Structure and range" } "\n"
            @for line in facts { p { (sentence(line)) } "\n" }
            h2 #values { "Values" } "\n"
            p.soft {
                "Columns as " code { "mechaudit linkage" } " names them, at every " (every(motion)) "th position; all digits by "
                code { "--format csv" } "."
            } "\n"
            (tables(motion))
        },
        data: &[("motion-data", motion::data(motion))],
        scripts: &[D3_JS, PLOT_JS, FIGURES_JS, MOTION_JS],
    };
    page.write()
}

fn number(x: f64) -> String {
    let text = format!("{x:.4}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" {
        "0".into()
    } else {
        text.into()
    }
}

/// With a capital and a full stop.
fn sentence(line: &str) -> String {
    let mut letters = line.chars();
    let first = letters.next().map(|c| c.to_uppercase().to_string());
    first.unwrap_or_default() + letters.as_str() + "."
}

/// A motion has a position at least.
fn every(motion: &Motion) -> usize {
    motion.drive.values.len().div_ceil(ROWS)
}

fn tables(motion: &Motion) -> Markup {
    let drive = &motion.drive;
    let value = |c: &Course, k: usize| match c.variants[0].1[k] {
        x if x.is_finite() => short(x),
        _ => "–".into(),
    };
    html! {
        @for group in motion.courses.chunks(COLUMNS) {
            div.scroll tabindex="0" { table { "\n"
                thead { tr {
                    th { (drive.symbol) ", " (drive.unit) }
                    @for c in group { th { (c.name) @if !c.unit.is_empty() { ", " (c.unit) } } }
                } } "\n"
                tbody { "\n"
                    @for k in (0..drive.values.len()).step_by(every(motion)) {
                        tr { th { (number(drive.values[k])) } @for c in group { td { (value(c, k)) } } } "\n"
                    }
                }
            } } "\n"
        }
    }
}
