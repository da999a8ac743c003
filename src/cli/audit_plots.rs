//! Diagrams of an audit's page as SVG whose colours the page's style gives.

use super::html::escape;
use std::fmt::Write;

/// Errors in ulps counted by octaves: exponent of two and count; none for exact values.
pub fn histogram(octaves: &[(Option<i32>, usize)]) -> String {
    const BAR: usize = 7;
    const HEIGHT: f64 = 34.0;
    let Some(most) = octaves.iter().map(|o| o.1).max() else {
        return "–".into();
    };
    let first = octaves.iter().filter_map(|o| o.0).min().unwrap_or(0);
    let last = octaves.iter().filter_map(|o| o.0).max().unwrap_or(first);
    // The first column is for exact values; beyond forty octaves they are put together.
    let step = ((last - first) / 40 + 1).max(1);
    let column = |e: Option<i32>| e.map_or(0, |e| 1 + ((e - first) / step) as usize);
    let mut counts = vec![0usize; column(Some(last)) + 1];
    for (e, n) in octaves {
        counts[column(*e)] += n;
    }
    let most = counts.iter().copied().max().unwrap_or(most).max(1);
    let width = counts.len() * BAR + 2;
    let label = format!("2^{first} to 2^{} ulps", last + 1);
    let mut out = format!(
        "<svg viewBox=\"0 0 {width} 38\" width=\"{width}\" height=\"38\" role=\"img\"><title>{}</title>",
        escape(&label)
    );
    for (k, n) in counts.iter().enumerate().filter(|(_, n)| **n > 0) {
        // The root makes the few visible beside the many.
        let h = (HEIGHT * (*n as f64 / most as f64).sqrt()).max(1.0);
        let (x, y) = (k * BAR + 1, 36.0 - h);
        let range = match k {
            0 => "exact".into(),
            _ => format!("2^{} ulps", first + (k as i32 - 1) * step),
        };
        let _ = write!(
            out,
            "<rect class=\"bar\" x=\"{x}\" y=\"{y:.1}\" width=\"{}\" height=\"{h:.1}\">\
             <title>{range}: {n}</title></rect>",
            BAR - 1
        );
    }
    let _ = write!(out, "<path class=\"axis\" d=\"M0 36.5H{width}\"/></svg>");
    out
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

/// A map of errors: rows from below, with the lower left corner and the side of a cell.
pub fn map(
    ulps: &[f64],
    (columns, rows): (usize, usize),
    (left, below): (f64, f64),
    side: f64,
) -> String {
    const CELL: usize = 4;
    let mut paths = vec![String::new(); CLASSES.len() + 2];
    for (r, row) in ulps.chunks(columns).enumerate() {
        let y = (rows - 1 - r) * CELL;
        let mut start = 0;
        while start < row.len() {
            let k = class(row[start]);
            let run = row[start..].iter().take_while(|u| class(**u) == k).count();
            let (x, w) = (start * CELL, run * CELL);
            let _ = write!(paths[k], "M{x} {y}h{w}v{CELL}h-{w}z");
            start += run;
        }
    }
    let (w, h) = (columns * CELL, rows * CELL);
    let mut out = format!(
        "<svg viewBox=\"-34 -4 {} {}\" width=\"{}\" role=\"img\">",
        w + 40,
        h + 26,
        w + 40
    );
    for (k, d) in paths.iter().enumerate().filter(|(_, d)| !d.is_empty()) {
        let _ = write!(out, "<path class=\"m{k}\" d=\"{d}\"/>");
    }
    let at_x = |x: f64| (x - left) / side * CELL as f64;
    let at_y = |y: f64| h as f64 - (y - below) / side * CELL as f64;
    let _ = write!(
        out,
        "<path class=\"axis\" d=\"M{0:.1} 0V{h}M0 {1:.1}H{w}\"/>",
        at_x(0.0),
        at_y(0.0)
    );
    let (right, above) = (left + side * columns as f64, below + side * rows as f64);
    for x in ((left / 3.0).ceil() as i32..=(right / 3.0).floor() as i32).map(|k| f64::from(3 * k)) {
        let _ = write!(
            out,
            "<text x=\"{:.1}\" y=\"{}\" text-anchor=\"middle\">{x}</text>",
            at_x(x),
            h + 16
        );
    }
    for y in ((below / 3.0).ceil() as i32..=(above / 3.0).floor() as i32).map(|k| f64::from(3 * k))
    {
        let _ = write!(
            out,
            "<text x=\"-6\" y=\"{:.1}\" text-anchor=\"end\">{y}i</text>",
            at_y(y) + 4.0
        );
    }
    out.push_str("</svg>");
    out
}

/// What the colours of a map mean.
pub fn map_legend() -> String {
    let mut out = String::from("<p>");
    let names = CLASSES.iter().map(|c| format!("≤ {c} ulps"));
    let names = names.chain(["more".into(), "no number, or wrong in kind".into()]);
    for (k, name) in names.enumerate() {
        let _ = write!(
            out,
            "<svg class=\"key\" viewBox=\"0 0 1 1\"><path class=\"m{k}\" d=\"M0 0h1v1h-1z\"/></svg> {name} &nbsp; "
        );
    }
    out.push_str("</p>");
    out
}

/// Lines in doubly logarithmic axes, with their names.
pub fn lines(lines: &[(String, Vec<(f64, f64)>)]) -> String {
    const W: f64 = 330.0;
    const H: f64 = 230.0;
    let points = || {
        lines
            .iter()
            .flat_map(|l| &l.1)
            .filter(|p| p.0 > 0.0 && p.1 > 0.0)
    };
    let bounds = |f: &dyn Fn(&(f64, f64)) -> f64| {
        let logs = || points().map(|p| f(p).log10());
        let (lo, hi) = (
            logs().fold(f64::INFINITY, f64::min),
            logs().fold(f64::NEG_INFINITY, f64::max),
        );
        (lo, hi.max(lo + 0.1))
    };
    if points().next().is_none() {
        return "<p>no data</p>".into();
    }
    let ((x0, x1), (y0, y1)) = (bounds(&|p| p.0), bounds(&|p| p.1));
    let (y0, y1) = (y0.floor(), y1.ceil());
    let px = |x: f64| 46.0 + (x.log10() - x0) / (x1 - x0) * W;
    let py = |e: f64| 8.0 + (y1 - e) / (y1 - y0) * H;
    let mut out = format!(
        "<svg viewBox=\"0 0 {0} {1}\" width=\"{0}\" role=\"img\">",
        W + 60.0,
        H + 34.0
    );
    let every = ((y1 - y0) / 8.0).ceil().max(1.0) as i32;
    for e in (y0 as i32..=y1 as i32).filter(|e| e % every == 0) {
        let y = py(f64::from(e));
        let _ = write!(
            out,
            "<path class=\"grid\" d=\"M46 {y:.1}h{W}\"/><text x=\"42\" y=\"{:.1}\" text-anchor=\"end\">1e{e}</text>",
            y + 4.0
        );
    }
    for edge in [x0, x1] {
        let x = 10f64.powf(edge);
        let _ = write!(
            out,
            "<text x=\"{:.1}\" y=\"{}\" text-anchor=\"middle\">{}</text>",
            px(x),
            H + 26.0,
            x.round()
        );
    }
    let _ = write!(
        out,
        "<path class=\"axis\" d=\"M46 8V{0}H{1}\"/>",
        H + 8.0,
        W + 46.0
    );
    for (k, (name, line)) in lines.iter().enumerate() {
        let points: Vec<String> = line
            .iter()
            .filter(|p| p.0 > 0.0 && p.1 > 0.0)
            .map(|p| format!("{:.1},{:.1}", px(p.0), py(p.1.log10())))
            .collect();
        let _ = write!(
            out,
            "<polyline class=\"s{}\" points=\"{}\"><title>{}</title></polyline>",
            k % 3,
            points.join(" "),
            escape(name)
        );
    }
    out.push_str("</svg><div>");
    for (k, (name, _)) in lines.iter().enumerate() {
        let _ = write!(
            out,
            "<span class=\"k{}\">▬</span> {} &nbsp; ",
            k % 3,
            escape(name)
        );
    }
    out.push_str("</div>");
    out
}
