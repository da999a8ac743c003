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
    use super::*;
    use crate::report::gallery::Gallery;

    /// From edge to edge below the next power of ten: values without a logarithm, single points,
    /// many decades, and a fourth line, which looks like the first.
    #[test]
    fn diagrams() {
        let mut all = Gallery::default();
        let mut draw = |lines_of: &[&[(f64, f64)]]| {
            let named = ["a", "b", "c", "d"].into_iter().zip(lines_of);
            let lines_of: Vec<_> = named.map(|(n, l)| (n.to_string(), l.to_vec())).collect();
            all.add(format!("{lines_of:?}"), lines("", &lines_of).into_string());
        };
        draw(&[]);
        draw(&[&[(1.0, 1e-1), (10.0, 1e-3), (100.0, 3e-3)]]);
        draw(&[&[(1.6, 3e-2), (10.0, 1e-3)]]);
        draw(&[&[
            (0.0, 1e-1),
            (0.5, 1.0),
            (10.0, -1e-5),
            (10.0, 0.0),
            (50.0, 0.1),
        ]]);
        draw(&[&[(10.0, 1e-3)]]);
        for decades in [8, 9, 18] {
            draw(&[&[(1.0, 1.0), (10.0, 10f64.powi(-decades))]]);
        }
        draw(&[&[(1.0, 1.0), (10.0, 0.1)][..]; 4]);
        all.pin("plots");
    }
}
