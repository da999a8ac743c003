//! The mechanism at several positions, with the paths of its joints.

use super::svg_style::{escape, head};
use mechaudit::solvers::class_iii::{Geometry, State};
use std::fmt::Write;

pub const WIDTH: f64 = 1000.0;
const MARGIN: f64 = 70.0;
const HEAD: f64 = 56.0;
const COLOURS: [(&str, &str); 4] = [
    ("A", "#8a8f98"),
    ("B", "#c2571a"),
    ("C", "#1f6fb2"),
    ("D", "#2f8f4e"),
];

/// From metres, y up, to the drawing, y down.
pub struct View {
    scale: f64,
    left: f64,
    top: f64,
    pub height: f64,
}

impl View {
    pub fn new(points: &[[f64; 2]]) -> View {
        let range = |i: usize| {
            let fold = |f: fn(f64, f64) -> f64, start| points.iter().map(|p| p[i]).fold(start, f);
            (
                fold(f64::min, f64::INFINITY),
                fold(f64::max, f64::NEG_INFINITY),
            )
        };
        let ((x0, x1), (y0, y1)) = (range(0), range(1));
        // Neither side much longer than the other would leave room to draw in.
        let size = (x1 - x0).max(y1 - y0).max(f64::MIN_POSITIVE);
        let scale = (WIDTH - 2.0 * MARGIN) / size;
        let slack = 0.5 * (size - (x1 - x0)) * scale;
        View {
            scale,
            left: MARGIN + slack - x0 * scale,
            top: HEAD + MARGIN + y1 * scale,
            height: HEAD + 2.0 * MARGIN + (y1 - y0) * scale,
        }
    }

    pub fn at(&self, p: [f64; 2]) -> (f64, f64) {
        (self.left + p[0] * self.scale, self.top - p[1] * self.scale)
    }

    pub fn points(&self, points: &[[f64; 2]]) -> String {
        let text = |p: &[f64; 2]| {
            let (x, y) = self.at(*p);
            format!("{x:.2},{y:.2}")
        };
        points.iter().map(text).collect::<Vec<_>>().join(" ")
    }
}

/// The drawing; `path` runs over the branch, `whole` if that is a whole turn.
pub fn draw(name: &str, geometry: &Geometry, path: &[State], whole: bool) -> String {
    let o1 = [0.0, 0.0];
    let o3 = [geometry.x3.m(), geometry.y3.m()];
    let o5 = [geometry.x5.m(), geometry.y5.m()];
    let mut all = vec![o1, o3, o5];
    all.extend(path.iter().flat_map(State::joints));
    let view = View::new(&all);
    let chosen = positions(path, whole);
    let mut out = begun(name, &legend(&chosen, whole), view.height);
    let pivots = [(o1, "O1", 0), (o3, "O3", 2), (o5, "O5", 3)];
    for (pivot, label, joint) in pivots {
        ground(&mut out, &view, pivot, label, hangs(path, pivot, joint));
    }
    for state in chosen.iter().skip(1) {
        links(&mut out, &view, state, [o1, o3, o5], false);
    }
    joint_paths(&mut out, &view, path);
    if let Some(first) = chosen.first() {
        links(&mut out, &view, first, [o1, o3, o5], true);
    }
    for (pivot, _, _) in pivots {
        circle(&mut out, &view, pivot, "#1d2125", 1.6);
    }
    if let Some(first) = chosen.first() {
        joints(&mut out, &view, first);
    }
    out.push_str("</svg>\n");
    out
}

/// A drawing up to its title and a line of legend.
pub fn begun(name: &str, legend: &str, height: f64) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height:.0}\" \
         width=\"{WIDTH}\" height=\"{height:.0}\" font-family=\"sans-serif\" font-size=\"16\">\n\
         {}<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n\
         <text x=\"24\" y=\"36\" font-size=\"22\" font-weight=\"600\" fill=\"#1d2125\">{}</text>\n\
         <text x=\"24\" y=\"60\" font-size=\"15\" fill=\"#5b646d\">{legend}</text>\n",
        head(name, legend),
        escape(name)
    )
}

/// The position drawn in full and those drawn faintly.
fn positions(path: &[State], whole: bool) -> Vec<&State> {
    let n = path.len();
    if n < 8 {
        return path.iter().collect();
    }
    if whole {
        // Eight equal parts of the turn; the start leads.
        return (0..8).map(|k| &path[k * (n - 1) / 8]).collect();
    }
    // The middle leads; the ends are the singular positions.
    [4, 0, 2, 6, 8]
        .iter()
        .map(|k| &path[k * (n - 1) / 8])
        .collect()
}

fn joint_paths(out: &mut String, view: &View, path: &[State]) {
    for (i, (_, colour)) in COLOURS.iter().enumerate() {
        let points: Vec<[f64; 2]> = path.iter().map(|s| s.joints()[i]).collect();
        let dash = if i == 0 {
            " stroke-dasharray=\"3 4\""
        } else {
            ""
        };
        let _ = writeln!(
            out,
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"2\"{dash}/>",
            view.points(&points)
        );
    }
}

fn links(out: &mut String, view: &View, state: &State, pivots: [[f64; 2]; 3], lead: bool) {
    let [a, b, c, d] = state.joints();
    let [o1, o3, o5] = pivots;
    let (opacity, width) = if lead { (1.0, 4.0) } else { (0.16, 2.0) };
    let _ = writeln!(
        out,
        "<g stroke=\"#1d2125\" stroke-width=\"{width}\" opacity=\"{opacity}\" \
         stroke-linecap=\"round\" stroke-linejoin=\"round\" fill=\"none\">"
    );
    for (p, q) in [(o1, a), (a, b), (o3, c), (o5, d)] {
        let _ = writeln!(out, "<polyline points=\"{}\"/>", view.points(&[p, q]));
    }
    let _ = writeln!(
        out,
        "<polygon points=\"{}\" fill=\"#1d2125\" fill-opacity=\"0.12\"/>\n</g>",
        view.points(&[b, c, d])
    );
    if lead {
        let centre = [(b[0] + c[0] + d[0]) / 3.0, (b[1] + c[1] + d[1]) / 3.0];
        let middle = |p: [f64; 2], q: [f64; 2]| [0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])];
        number(out, view, "1", middle(o1, a), a, o1);
        number(out, view, "2", middle(a, b), b, a);
        number(out, view, "3", middle(o3, c), c, o3);
        number(out, view, "5", middle(o5, d), d, o5);
        let (x, y) = view.at(centre);
        text(out, "4", x, y + 5.0, "middle", "#5b646d");
    }
}

/// A link's number beside its middle.
pub fn number(out: &mut String, view: &View, label: &str, at: [f64; 2], p: [f64; 2], q: [f64; 2]) {
    let (x, y) = view.at(at);
    let ((px, py), (qx, qy)) = (view.at(p), view.at(q));
    let length = (px - qx).hypot(py - qy).max(1e-9);
    // On the upper side.
    let up = if px > qx { -1.0 } else { 1.0 };
    let (nx, ny) = (-up * (py - qy) / length, up * (px - qx) / length);
    text(
        out,
        label,
        x + 15.0 * nx,
        y + 15.0 * ny + 5.0,
        "middle",
        "#5b646d",
    );
}

pub fn text(out: &mut String, text: &str, x: f64, y: f64, anchor: &str, colour: &str) {
    // A white edge keeps labels readable on lines.
    let _ = writeln!(
        out,
        "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\" fill=\"{colour}\" stroke=\"#ffffff\" \
         stroke-width=\"4\" paint-order=\"stroke\" stroke-linejoin=\"round\">{text}</text>"
    );
}

/// Whether the link at the pivot stays below it.
fn hangs(path: &[State], pivot: [f64; 2], joint: usize) -> bool {
    path.iter().all(|s| s.joints()[joint][1] < pivot[1])
}

/// Hatched ground under a fixed pivot, above it where the link hangs.
pub fn ground(out: &mut String, view: &View, p: [f64; 2], label: &str, above: bool) {
    let (x, y) = view.at(p);
    let flip = if above { -1.0 } else { 1.0 };
    let base = y + 22.0 * flip;
    let _ = writeln!(
        out,
        "<g stroke=\"#1d2125\" stroke-width=\"1.6\">\n\
         <path d=\"M{x:.1} {y:.1}L{:.1} {base:.1}h26z\" fill=\"#ffffff\"/>\n\
         <path d=\"M{:.1} {base:.1}h44\"/>",
        x - 13.0,
        x - 22.0
    );
    for k in 0..6 {
        let foot = x - 18.0 + 8.0 * f64::from(k);
        let drop = 8.0 * flip;
        let _ = writeln!(
            out,
            "<path d=\"M{foot:.1} {base:.1}l-7 {drop}\" stroke-width=\"1.1\"/>"
        );
    }
    out.push_str("</g>\n");
    text(
        out,
        label,
        x + 26.0,
        y + 17.0 * flip + 2.0,
        "start",
        "#1d2125",
    );
}

pub fn circle(out: &mut String, view: &View, p: [f64; 2], colour: &str, width: f64) {
    let (x, y) = view.at(p);
    let _ = writeln!(
        out,
        "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"6\" fill=\"#ffffff\" stroke=\"{colour}\" stroke-width=\"{width}\"/>"
    );
}

fn joints(out: &mut String, view: &View, state: &State) {
    for (p, (label, colour)) in state.joints().into_iter().zip(COLOURS) {
        let (x, y) = view.at(p);
        circle(out, view, p, colour, 3.0);
        text(out, label, x + 11.0, y - 10.0, "start", colour);
    }
}

fn legend(chosen: &[&State], whole: bool) -> String {
    let degrees = |s: &&State| s.phi1.to_degrees();
    let others = if whole {
        "every 45° faint".to_string()
    } else {
        let low = chosen.iter().map(degrees).fold(f64::INFINITY, f64::min);
        let high = chosen.iter().map(degrees).fold(f64::NEG_INFINITY, f64::max);
        format!("from {low:.2}° to {high:.2}° faint")
    };
    let first = chosen.first().map_or(f64::NAN, degrees);
    format!("at φ1 = {first:.3}°, {others}; paths of A (dashed), B, C, D")
}
