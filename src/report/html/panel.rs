//! Panels of curves within a page as SVG, whose colours the page's style gives.

use super::plots::tenths;
use super::prose::prose;
use crate::report::axis::{Format, at_most};
use crate::report::svg::panel::{Curve, Panel};
use crate::report::svg::style::{GREEN, ORANGE, PURPLE};
use maud::{Markup, html};

/// The plotting area of a panel, and the room for marks left of it and below.
const PANEL: [f64; 2] = [560.0, 220.0];
const ROOM: [f64; 2] = [64.0, 34.0];

/// Curves over a common abscissa, with their names.
pub fn panel(panel: &Panel) -> Markup {
    let [(x0, x1), (y0, y1)] = panel.ranges();
    let ([w, h], [left, below]) = (PANEL, ROOM);
    let size = |a: f64, b: f64| if b > a { b - a } else { 1.0 };
    let px = |x: f64| left + (x - x0) / size(x0, x1) * w;
    let py = |y: f64| 8.0 + (y1 - y) / size(y0, y1) * h;
    let (across, up) = (at_most(x0, x1, 8), at_most(y0, y1, 7));
    let (of_x, of_y) = (Format::of(&across), Format::of(&up));
    let points = |c: &Curve| {
        let seen = c
            .points
            .iter()
            .filter(|p| p.0.is_finite() && p.1.is_finite());
        let at = seen.map(|p| format!("{:.1},{:.1}", px(p.0), py(p.1)));
        at.collect::<Vec<_>>().join(" ")
    };
    html! {
        figure.panel { "\n"
            figcaption { b { (prose(&panel.y)) } " over " (prose(&panel.x))
                span.keys { @for c in panel.curves.iter().filter(|c| !c.name.is_empty()) {
                    " " span { span.(class(c)) { (if c.dashed { "╌╌" } else { "━━" }) } " " (prose(c.name)) }
                } }
            } "\n"
            svg viewBox={ "0 0 " (left + w + 28.0) " " (h + below) } role="img"
                aria-label={ (panel.y) " over " (panel.x) } { "\n"
                @for y in &up {
                    path.grid d={ "M" (left) " " (tenths(py(*y))) "h" (w) } {}
                    text x=(left - 6.0) y=(tenths(py(*y) + 4.0)) text-anchor="end" { (of_y.text(*y)) } "\n"
                }
                @for x in &across {
                    text x=(tenths(px(*x))) y=(h + 26.0) text-anchor="middle" { (of_x.text(*x)) } "\n"
                }
                path.axis d={ "M" (left) " 8v" (h) "h" (w) } {} "\n"
                @for c in &panel.curves {
                    polyline.(class(c)).dashed[c.dashed].fine[c.width < 2] points=(points(c)) {} "\n"
                }
            }
        } "\n"
    }
}

fn class(curve: &Curve) -> &'static str {
    match curve.colour {
        ORANGE => "c1",
        GREEN => "c3",
        PURPLE => "c4",
        _ => "c2",
    }
}

#[cfg(test)]
mod tests {
    use super::super::page::tests::between;
    use super::*;

    #[test]
    fn a_panel_has_its_curves_their_names_and_marks_of_one_format() {
        let curve = |name, colour, dashed| Curve {
            name,
            points: vec![(0.0, 0.0), (1.0, f64::NAN), (2.0, 0.0015)],
            colour,
            width: 2,
            dashed,
        };
        let curves = vec![curve("D_n", ORANGE, false), curve("", GREEN, true)];
        let html = panel(&Panel::new("time, s", "|y − a_0|, lifts", curves)).into_string();
        for part in [
            "<b>|y − a<sub>0</sub>|, lifts</b> over time, s",
            "<span class=\"c1\">━━</span> D<sub>n</sub>",
            "<polyline class=\"c3 dashed\" points=\"64.0,228.0 624.0,18.5\">",
        ] {
            assert!(html.contains(part), "{part} is missing in {html}");
        }
        assert_eq!(
            html.matches("class=\"c3").count(),
            1,
            "a curve without a name is in the legend"
        );
        let up = between(&html, "text-anchor=\"end\">", "</text>");
        assert_eq!(up, ["0", "0.0005", "0.0010", "0.0015"]);
    }
}
