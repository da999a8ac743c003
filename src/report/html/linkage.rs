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
/// The largest number of columns of a table beside the drive.
const COLUMNS: usize = 6;

/// The columns' values at each position as courses over the drive; the drive and the branch, which
/// are the first two columns, left out.
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
                "Columns as " code { "mechaudit linkage" } " names them, one position of " (every(motion)) "; all digits by "
                code { "--format csv" } "."
            } "\n"
            (tables(motion))
        },
        columns: (&["linkage"], &names(motion)),
        data: &[("motion-data", motion::data(motion))],
        scripts: &[D3_JS, PLOT_JS, FIGURES_JS, MOTION_JS],
    };
    page.write()
}

/// The names of the columns, but for their units; those of angles end with one.
fn names(motion: &Motion) -> Vec<String> {
    let drive = match motion.drive.symbol {
        "φ1" => "phi1_deg",
        "φ" => "phi_deg",
        _ => "s_m",
    };
    let courses = motion.courses.iter().map(|c| match &*c.unit {
        "°" | "rad" => format!("{}_deg", c.name),
        _ => c.name.clone(),
    });
    std::iter::once(drive.to_string()).chain(courses).collect()
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
pub fn sentence(line: &str) -> String {
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
                    th.given { (drive.symbol) ", " (drive.unit) }
                    @for c in group { th.given { (c.name) @if !c.unit.is_empty() { ", " (c.unit) } } }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::{Drive, Point};
    use crate::report::gallery::Gallery;

    #[test]
    fn numbers_have_four_decimals_at_most_and_lines_a_full_stop() {
        for (x, due) in [
            (1.5, "1.5"),
            (2.0, "2"),
            (100.0, "100"),
            (0.123_44, "0.1234"),
            (-0.000_01, "0"),
            (0.0, "0"),
            (-30.25, "-30.25"),
        ] {
            assert_eq!(number(x), due);
        }
        assert_eq!(sentence("one body"), "One body.");
        assert_eq!(sentence("φ1 turns"), "Φ1 turns.");
        assert_eq!(sentence(""), ".");
    }

    #[test]
    fn courses_are_the_columns_behind_drive_and_branch() {
        let names = ["phi1_deg", "branch", "x_m", "omega_rad_per_s"].map(String::from);
        let units = ["mm", "deg"].map(String::from);
        let columns = Columns::of(names.to_vec(), &units, false).unwrap();
        let courses = courses(&columns, &[vec![0.5, 0.0], vec![-2.0, 1.0]]);
        let [x, omega] = &courses[..] else {
            panic!("{courses:?}");
        };
        assert_eq!((&*x.name, &*x.unit), ("x", "mm"));
        assert_eq!(x.variants, [(String::new(), vec![500.0, -2000.0])]);
        assert_eq!((&*omega.name, &*omega.unit), ("omega", "°/s"));
        assert_eq!(omega.variants[0].1, [0.0, 1f64.to_degrees()]);
        assert!(x.printed.is_empty());
    }

    /// `n` positions, ten degrees apart, and courses of the squares of their numbers.
    fn moving(n: usize, courses: usize) -> Motion {
        let values = |f: fn(f64) -> f64| (0..n).map(|k| f(k as f64)).collect::<Vec<f64>>();
        let course = |k: usize| {
            let mut values = values(|x| x * x);
            if k > 0 {
                values[0] = f64::NAN;
            }
            Course {
                name: format!("y{k}"),
                unit: if k == 1 { "m".into() } else { String::new() },
                variants: vec![(String::new(), values)],
                printed: Vec::new(),
            }
        };
        Motion {
            name: "a crank".into(),
            drive: Drive {
                symbol: "φ1",
                unit: "°",
                values: values(|x| 10.0 * x),
            },
            closed: true,
            start: 0,
            points: vec![Point::fixed("O", [0.0, 0.0])],
            links: Vec::new(),
            plates: Vec::new(),
            guides: Vec::new(),
            wheels: Vec::new(),
            courses: (0..courses).map(course).collect(),
        }
    }

    #[test]
    fn tables_have_25_positions_and_six_columns_at_most() {
        for (n, rows) in [(25, 25), (26, 13), (50, 25), (51, 17)] {
            let html = tables(&moving(n, 1)).into_string();
            assert_eq!(html.matches("<td>").count(), rows, "{n}");
        }
        let mut all = Gallery::default();
        all.add("of 26 and 7", tables(&moving(26, 7)).into_string());
        all.pin("tables");
    }

    #[test]
    fn the_page_says_where_its_positions_lie() {
        let text = page(&moving(51, 1), &["two bodies".into(), "it turns".into()]);
        for part in [
            "<title>a crank: linkage</title>",
            "51 positions by the f64 solver, φ1 from 0 to 500 °. Arrow keys",
            "<p>Two bodies.</p>",
            "<code>phi1_deg</code>",
            "<p>It turns.</p>",
            "one position of 3;",
        ] {
            assert!(text.contains(part), "{part} is missing");
        }
        super::super::page::tests::whole(&text);
    }
}
