//! Diagrams within a page as SVG, whose colours the page's style gives.

use super::prose::prose;
use maud::{Markup, html};

/// A coordinate to a tenth.
pub(super) fn tenths(x: f64) -> String {
    format!("{x:.1}")
}

/// Lines in doubly logarithmic axes, with their names; the label says what they are.
pub fn lines(label: &str, lines: &[(String, Vec<(f64, f64)>)]) -> Markup {
    const W: f64 = 330.0;
    const H: f64 = 230.0;
    let shown = |p: &&(f64, f64)| p.0 > 0.0 && p.1 > 0.0;
    let points = || lines.iter().flat_map(|l| &l.1).filter(shown);
    let bounds = |f: &dyn Fn(&(f64, f64)) -> f64| {
        let logs = || points().map(|p| f(p).log10());
        let low = logs().fold(f64::INFINITY, f64::min);
        (low, logs().fold(f64::NEG_INFINITY, f64::max).max(low + 0.1))
    };
    if points().next().is_none() {
        return html! { p { "no data" } };
    }
    let ((x0, x1), (y0, y1)) = (bounds(&|p| p.0), bounds(&|p| p.1));
    let (y0, y1) = (y0.floor(), y1.ceil());
    let px = |x: f64| 46.0 + (x.log10() - x0) / (x1 - x0) * W;
    let py = |e: f64| 8.0 + (y1 - e) / (y1 - y0) * H;
    let every = ((y1 - y0) / 8.0).ceil().max(1.0) as i32;
    let path = |line: &[(f64, f64)]| {
        let points = line.iter().filter(shown);
        let points = points.map(|p| format!("{:.1},{:.1}", px(p.0), py(p.1.log10())));
        points.collect::<Vec<String>>().join(" ")
    };
    html! {
        svg viewBox={ "0 0 " (W + 70.0) " " (H + 34.0) } role="img"
            aria-label=(label) {
            @for e in (y0 as i32..=y1 as i32).filter(|e| e % every == 0) {
                @let y = py(f64::from(e));
                path.grid d={ "M46 " (tenths(y)) "h" (W) } {}
                text x="42" y=(tenths(y + 4.0)) text-anchor="end" { "1e" (e) }
            }
            @for x in [x0, x1].map(|edge| 10f64.powf(edge)) {
                text x=(tenths(px(x))) y=(H + 26.0) text-anchor="middle" { (x.round()) }
            }
            path.axis d={ "M46 8V" (H + 8.0) "H" (W + 46.0) } {}
            @for (k, (name, line)) in lines.iter().enumerate() {
                polyline.{ "s" (k % 3) } points=(path(line)) { title { (name) } }
            }
        }
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

    #[test]
    fn lines_leave_out_what_has_no_logarithm() {
        let line = vec![(1.0, 1e-3), (10.0, 0.0), (100.0, 1e-5)];
        let svg = lines("", &[("a".into(), line)]).into_string();
        let points = svg.split("points=\"").nth(1).unwrap();
        assert_eq!(points.split('"').next().unwrap().split(' ').count(), 2);
        assert!(lines("", &[]).into_string().contains("no data"));
    }

    /// The points of the only line.
    fn placed(line: &[(f64, f64)]) -> (String, String) {
        let svg = lines("", &[("a".into(), line.to_vec())]).into_string();
        let points = svg.split("points=\"").nth(1).unwrap();
        (points.split('"').next().unwrap().into(), svg)
    }

    #[test]
    fn a_line_runs_from_edge_to_edge_below_the_next_power_of_ten() {
        let (points, svg) = placed(&[(1.0, 1e-1), (10.0, 1e-3), (100.0, 3e-3)]);
        assert_eq!(points, "46.0,8.0 211.0,238.0 376.0,183.1");
        let marks = ["1e-3", "1e-2", "1e-1"].map(|e| format!(">{e}</text>"));
        assert!(marks.iter().all(|e| svg.contains(e)), "{svg}");
        let (points, svg) = placed(&[(1.0, 3e-2), (10.0, 1e-3)]);
        assert_eq!(points, "46.0,68.1 376.0,238.0");
        assert!(svg.contains(">1e-1</text>"), "{svg}");
    }

    #[test]
    fn a_single_point_has_a_place() {
        let (points, svg) = placed(&[(10.0, 1e-3)]);
        assert_eq!(points, "46.0,238.0");
        // A tenth of a decade beside it.
        let work = between(&svg, "text-anchor=\"middle\">", "</text>");
        assert_eq!(work, ["10", "13"]);
    }

    #[test]
    fn eight_decades_are_all_named_and_of_more_every_second() {
        for (decades, every) in [(2, 1), (8, 1), (9, 2), (16, 2), (17, 3)] {
            let low = 10f64.powi(-decades);
            let (_, svg) = placed(&[(1.0, 1.0), (10.0, low)]);
            let marks = between(&svg, "text-anchor=\"end\">", "</text>");
            let due = (-decades..=0).filter(|e| e % every == 0);
            let due: Vec<String> = due.map(|e| format!("1e{e}")).collect();
            assert_eq!(marks, due);
        }
    }

    #[test]
    fn axes_have_their_marks_where_they_belong() {
        let (_, svg) = placed(&[(1.6, 1.0), (100.0, 1e-2)]);
        assert!(svg.contains("viewBox=\"0 0 400 264\""), "{svg}");
        assert!(svg.contains("class=\"axis\" d=\"M46 8V238H376\""), "{svg}");
        let grid = between(&svg, "class=\"grid\" d=\"", "\"");
        assert_eq!(grid, ["M46 238.0h330", "M46 123.0h330", "M46 8.0h330"]);
        let marks = between(&svg, "<text x=\"42\" y=\"", "\"");
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

    #[test]
    fn no_work_and_negative_errors_have_no_place() {
        let (points, _) = placed(&[(0.0, 1e-1), (0.5, 1.0), (10.0, -1e-5), (50.0, 0.1)]);
        assert_eq!(points, "46.0,8.0 376.0,238.0");
    }
}
