//! Panels of curves within a page as SVG, whose colours the page's style gives.

use super::plots::{Line, diagram};
use super::prose::prose;
use crate::report::axis::Axis;
use crate::report::svg::panel::{Curve, Panel};
use crate::report::svg::style::{GREEN, ORANGE, PURPLE};
use maud::{Markup, html};

/// Curves over a common abscissa, with their names.
pub fn panel(panel: &Panel) -> Markup {
    let [x, y] = panel.ranges();
    let wide = |(a, b): (f64, f64)| if b > a { (a, b) } else { (a, a + 1.0) };
    let axes = [Axis::linear("", wide(x), 8), Axis::linear("", wide(y), 7)];
    let line = |c: &Curve| Line {
        class: [
            class(c),
            if c.dashed { " dashed" } else { "" },
            if c.width < 2 { " fine" } else { "" },
        ]
        .concat(),
        title: None,
        points: c.points.clone(),
    };
    let lines: Vec<Line> = panel.curves.iter().map(line).collect();
    html! {
        figure.panel { "\n"
            figcaption { b { (prose(&panel.y)) } " over " (prose(&panel.x))
                span.keys { @for c in panel.curves.iter().filter(|c| !c.name.is_empty()) {
                    " " span { span.(class(c)) { (if c.dashed { "╌╌" } else { "━━" }) } " " (prose(c.name)) }
                } }
            } "\n"
            (diagram(&format!("{} over {}", panel.y, panel.x), [560.0, 220.0], 64.0, &axes, &lines))
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
    use super::*;
    use crate::report::gallery::Gallery;

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
        let page = panel(&Panel::new("time, s", "|y − a_0|, lifts", curves));
        let mut all = Gallery::default();
        all.add("panel", page.into_string());
        all.pin("panel-of-a-page");
    }
}
