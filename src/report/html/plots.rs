//! Diagrams within a page as SVG, whose colours the page's style gives.

use crate::audit::ErrorMap;
use maud::{Markup, html};
use std::fmt::Write;

/// Errors in ulps counted by octaves: exponent of two and count; none for exact values.
pub fn histogram(octaves: &[(Option<i32>, usize)]) -> Markup {
    const BAR: usize = 7;
    const HEIGHT: f64 = 34.0;
    if octaves.is_empty() {
        return html! { "–" };
    }
    let first = octaves.iter().filter_map(|o| o.0).min().unwrap_or(0);
    let last = octaves.iter().filter_map(|o| o.0).max().unwrap_or(first);
    // The first column is for exact values; beyond forty octaves they are put together.
    let step = ((last - first) / 40 + 1).max(1);
    let column = |e: Option<i32>| e.map_or(0, |e| 1 + ((e - first) / step) as usize);
    let mut counts = vec![0usize; column(Some(last)) + 1];
    for (e, n) in octaves {
        counts[column(*e)] += n;
    }
    let most = counts.iter().copied().max().unwrap_or(1).max(1);
    let width = counts.len() * BAR + 2;
    // The root makes the few visible beside the many.
    let height = |n: usize| (HEIGHT * (n as f64 / most as f64).sqrt()).max(1.0);
    let range = |k: usize| match k {
        0 => "exact".into(),
        _ => format!("2^{} ulps", first + (k as i32 - 1) * step),
    };
    html! {
        svg viewBox={ "0 0 " (width) " 38" } width=(width) height="38" role="img" {
            title { "2^" (first) " to 2^" (last + 1) " ulps" }
            @for (k, n) in counts.iter().copied().enumerate().filter(|(_, n)| *n > 0) {
                @let h = height(n);
                rect.bar x=(k * BAR + 1) y=(tenths(36.0 - h)) width=(BAR - 1) height=(tenths(h)) {
                    title { (range(k)) ": " (n) }
                }
            }
            path.axis d={ "M0 36.5H" (width) } {}
        }
    }
}

/// A coordinate to a tenth.
fn tenths(x: f64) -> String {
    format!("{x:.1}")
}

/// Upper ends of the classes of an error map, in ulps; then more, and no number at all.
const CLASSES: [f64; 6] = [0.25, 0.5, 0.75, 1.0, 4.0, 1000.0];

fn class(ulps: f64) -> usize {
    match ulps.is_nan() {
        true => CLASSES.len() + 1,
        false => CLASSES
            .iter()
            .position(|c| ulps <= *c)
            .unwrap_or(CLASSES.len()),
    }
}

/// A map of one output's errors.
pub fn map(map: &ErrorMap, ulps: &[f64]) -> Markup {
    const CELL: usize = 4;
    let mut paths = vec![String::new(); CLASSES.len() + 2];
    for (r, row) in ulps.chunks(map.columns).enumerate() {
        let y = (map.rows - 1 - r) * CELL;
        let mut start = 0;
        while start < row.len() {
            let k = class(row[start]);
            let run = row[start..].iter().take_while(|u| class(**u) == k).count();
            let (x, w) = (start * CELL, run * CELL);
            let _ = write!(paths[k], "M{x} {y}h{w}v{CELL}h-{w}z");
            start += run;
        }
    }
    let (w, h) = (map.columns * CELL, map.rows * CELL);
    let [left, below] = map.corner;
    let at_x = |x: f64| (x - left) / map.side * CELL as f64;
    let at_y = |y: f64| h as f64 - (y - below) / map.side * CELL as f64;
    let ticks = |from: f64, cells: usize| {
        let to = from + map.side * cells as f64;
        ((from / 3.0).ceil() as i32..=(to / 3.0).floor() as i32).map(|k| 3 * k)
    };
    html! {
        svg viewBox={ "-34 -4 " (w + 40) " " (h + 26) } role="img" {
            @for (k, d) in paths.iter().enumerate().filter(|(_, d)| !d.is_empty()) {
                path.{ "m" (k) } d=(d) {}
            }
            path.axis d={ "M" (tenths(at_x(0.0))) " 0V" (h) "M0 " (tenths(at_y(0.0))) "H" (w) } {}
            @for x in ticks(left, map.columns) {
                text x=(tenths(at_x(x.into()))) y=(h + 16) text-anchor="middle" { (x) }
            }
            @for y in ticks(below, map.rows) {
                text x="-6" y=(tenths(at_y(y.into()) + 4.0)) text-anchor="end" { (y) "i" }
            }
        }
    }
}

/// What the colours of a map mean.
pub fn map_legend() -> Markup {
    let names = CLASSES.iter().map(|c| format!("≤ {c} ulps"));
    let names = names.chain(["more".into(), "no number, or wrong in kind".into()]);
    html! {
        p.keys {
            @for (k, name) in names.enumerate() {
                span {
                    svg.key viewBox="0 0 1 1" { path.{ "m" (k) } d="M0 0h1v1h-1z" {} } " " (name)
                } " "
            }
        }
    }
}

/// Lines in doubly logarithmic axes, with their names.
pub fn lines(lines: &[(String, Vec<(f64, f64)>)]) -> Markup {
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
        svg viewBox={ "0 0 " (W + 60.0) " " (H + 34.0) } role="img" {
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
                span { span.{ "k" (k % 3) } { "▬" } " " (name) } " "
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_map_has_its_rows_from_below_and_its_classes() {
        let grid = ErrorMap {
            columns: 2,
            rows: 2,
            corner: [-3.0, -3.0],
            side: 3.0,
            outputs: Vec::new(),
            not_passed: 1,
        };
        let svg = map(&grid, &[0.1, 0.1, 2.0, f64::NAN]).into_string();
        for part in [
            "class=\"m0\" d=\"M0 4h8v4h-8z\"",
            "class=\"m4\" d=\"M0 0h4v4h-4z\"",
            "class=\"m7\" d=\"M4 0h4v4h-4z\"",
            ">-3i</text>",
        ] {
            assert!(svg.contains(part), "{part} is missing in {svg}");
        }
    }

    #[test]
    fn lines_leave_out_what_has_no_logarithm() {
        let line = vec![(1.0, 1e-3), (10.0, 0.0), (100.0, 1e-5)];
        let svg = lines(&[("a".into(), line)]).into_string();
        let points = svg.split("points=\"").nth(1).unwrap();
        assert_eq!(points.split('"').next().unwrap().split(' ').count(), 2);
        assert!(lines(&[]).into_string().contains("no data"));
    }
}
