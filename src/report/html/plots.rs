//! Diagrams within a page as SVG, whose colours the page's style gives.

use super::prose::prose;
use crate::report::axis::Axis;
use maud::{Markup, html};

/// A line of a diagram: the classes of its style, the title it shows, its points.
pub struct Line<'a> {
    pub class: String,
    pub title: Option<&'a str>,
    pub points: Vec<(f64, f64)>,
}

/// A diagram with that label, a plotting area of that size, and so much room to the left of it.
pub fn diagram(
    label: &str,
    [w, h]: [f64; 2],
    left: f64,
    axes: &[Axis; 2],
    lines: &[Line],
) -> Markup {
    let tenths = |x: f64| format!("{x:.1}");
    let [across, up] = axes;
    let px = |x: f64| left + across.part(x) * w;
    let py = |y: f64| 8.0 + (1.0 - up.part(y)) * h;
    let points = |line: &Line| {
        let seen = line
            .points
            .iter()
            .filter(|p| p.0.is_finite() && p.1.is_finite());
        let at = seen.map(|p| format!("{:.1},{:.1}", px(p.0), py(p.1)));
        at.collect::<Vec<_>>().join(" ")
    };
    html! {
        svg viewBox={ "0 0 " (left + w + 28.0) " " (h + 34.0) } role="img" aria-label=(label) { "\n"
            @for (y, text) in &up.marks {
                path.grid d={ "M" (left) " " (tenths(py(*y))) "h" (w) } {}
                text x=(left - 6.0) y=(tenths(py(*y) + 4.0)) text-anchor="end" { (text) } "\n"
            }
            @for (x, text) in &across.marks {
                text x=(tenths(px(*x))) y=(h + 26.0) text-anchor="middle" { (text) } "\n"
            }
            path.axis d={ "M" (left) " 8v" (h) "h" (w) } {} "\n"
            @for line in lines {
                polyline class=(line.class) points=(points(line)) {
                    @if let Some(title) = line.title { title { (title) } }
                } "\n"
            }
        }
    }
}

/// Lines in doubly logarithmic axes, with their names; the label says what they are.
pub fn lines(label: &str, lines: &[(String, Vec<(f64, f64)>)]) -> Markup {
    let logarithms = |line: &[(f64, f64)]| -> Vec<(f64, f64)> {
        let shown = line.iter().filter(|p| p.0 > 0.0 && p.1 > 0.0);
        shown.map(|p| (p.0.log10(), p.1.log10())).collect()
    };
    let drawn: Vec<Line> = lines
        .iter()
        .enumerate()
        .map(|(k, (name, line))| Line {
            class: format!("s{}", k % 3),
            title: Some(name),
            points: logarithms(line),
        })
        .collect();
    let all = || drawn.iter().flat_map(|l| &l.points);
    if all().next().is_none() {
        return html! { p { "no data" } };
    }
    let range = |f: &dyn Fn(&(f64, f64)) -> f64| {
        let ends = (f64::INFINITY, f64::NEG_INFINITY);
        let (low, high) = all().map(f).fold(ends, |(a, b), x| (a.min(x), b.max(x)));
        (low, high.max(low + 0.1))
    };
    let (x, y) = (range(&|p| p.0), range(&|p| p.1));
    let across = Axis {
        label: String::new(),
        range: x,
        marks: [x.0, x.1]
            .map(|k| (k, 10f64.powf(k).round().to_string()))
            .to_vec(),
    };
    let up = Axis::decades("", (y.0.floor(), y.1.ceil()), 9, |k| format!("1e{k}"));
    html! {
        (diagram(label, [330.0, 230.0], 46.0, &[across, up], &drawn))
        div.keys {
            @for (k, (name, _)) in lines.iter().enumerate() {
                span { span.{ "k" (k % 3) } { "▬" } " " (prose(name)) } " "
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::page::tests::between;
    use super::*;

    /// The points of the only line, and the drawing.
    fn placed(line: &[(f64, f64)]) -> (String, String) {
        let svg = lines("", &[("a".into(), line.to_vec())]).into_string();
        let points = between(&svg, "points=\"", "\"")[0].to_string();
        (points, svg)
    }

    #[test]
    fn a_line_runs_from_edge_to_edge_below_the_next_power_of_ten() {
        for (line, due, marks) in [
            (
                &[(1.0, 1e-1), (10.0, 1e-3), (100.0, 3e-3)][..],
                "46.0,8.0 211.0,238.0 376.0,183.1",
                &["1e-3", "1e-2", "1e-1"][..],
            ),
            (
                &[(1.0, 3e-2), (10.0, 1e-3)],
                "46.0,68.1 376.0,238.0",
                &["1e-3", "1e-2", "1e-1"],
            ),
            // A value without a logarithm has no place.
            (
                &[
                    (0.0, 1e-1),
                    (0.5, 1.0),
                    (10.0, -1e-5),
                    (10.0, 0.0),
                    (50.0, 0.1),
                ],
                "46.0,8.0 376.0,238.0",
                &["1e-1", "1e0"],
            ),
        ] {
            let (points, svg) = placed(line);
            assert_eq!(points, due);
            assert_eq!(between(&svg, "text-anchor=\"end\">", "</text>"), marks);
        }
        // A single point: a tenth of a decade beside it.
        let (points, svg) = placed(&[(10.0, 1e-3)]);
        assert_eq!(points, "46.0,238.0");
        let work = between(&svg, "text-anchor=\"middle\">", "</text>");
        assert_eq!(work, ["10", "13"]);
        assert!(lines("", &[]).into_string().contains("no data"));
    }

    #[test]
    fn nine_decades_are_all_named_and_of_more_every_second() {
        for (decades, every) in [(2, 1), (8, 1), (9, 2), (16, 2), (18, 3)] {
            let (_, svg) = placed(&[(1.0, 1.0), (10.0, 10f64.powi(-decades))]);
            let marks = between(&svg, "text-anchor=\"end\">", "</text>");
            let due = (-decades..=0).filter(|e| e % every == 0);
            assert_eq!(marks, due.map(|e| format!("1e{e}")).collect::<Vec<_>>());
        }
    }

    #[test]
    fn axes_have_their_marks_where_they_belong() {
        let (_, svg) = placed(&[(1.6, 1.0), (100.0, 1e-2)]);
        assert!(svg.contains("viewBox=\"0 0 404 264\""), "{svg}");
        assert!(svg.contains("class=\"axis\" d=\"M46 8v230h330\""), "{svg}");
        let grid = between(&svg, "class=\"grid\" d=\"", "\"");
        assert_eq!(grid, ["M46 238.0h330", "M46 123.0h330", "M46 8.0h330"]);
        let marks = between(&svg, "<text x=\"40\" y=\"", "\"");
        assert_eq!(marks, ["242.0", "127.0", "12.0"]);
        let work = between(&svg, "text-anchor=\"middle\">", "</text>");
        assert_eq!(work, ["2", "100"]);
        assert!(svg.contains("x=\"46.0\" y=\"256\"") && svg.contains("x=\"376.0\" y=\"256\""));
    }

    #[test]
    fn the_fourth_line_looks_like_the_first() {
        let line = |name: &str| (name.to_string(), vec![(1.0, 1.0), (10.0, 0.1)]);
        let svg = lines("", &["a", "b", "c", "d"].map(line)).into_string();
        let classes = between(&svg, "<polyline class=\"", "\"");
        assert_eq!(classes, ["s0", "s1", "s2", "s0"]);
        let keys = between(&svg, "<span class=\"", "\"");
        assert_eq!(keys, ["k0", "k1", "k2", "k0"]);
        assert_eq!(between(&svg, "<title>", "</title>"), ["a", "b", "c", "d"]);
        assert_eq!(between(&svg, "▬</span> ", "</span>"), ["a", "b", "c", "d"]);
    }
}
