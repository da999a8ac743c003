//! A four-bar linkage or slider-crank at several positions, with the paths of its joints.

use super::svg_mechanism::{View, begun, circle, ground, number, text};
use mechaudit::machine::dyad::{Dyad, Shape, Turn, turn};
use mechaudit::reference::nearest_f64;
use mechaudit::solvers::dyad::Assembly;
use mechaudit::solvers::units::Angle;
use std::fmt::Write;

/// Positions that the paths are drawn through.
const SAMPLES: u32 = 720;
const INK: &str = "#1d2125";
const A: (&str, &str) = ("A", "#c2571a");
const B: (&str, &str) = ("B", "#1f6fb2");

/// Crank angle in degrees, the crank's end and the joint at the dyad's other end.
type Position = (f64, [f64; 2], [f64; 2]);

fn position(shape: &Shape, degrees: f64, assembly: Assembly) -> Option<Position> {
    let phi = Angle::from_deg(degrees);
    let (sin, cos) = phi.rad().sin_cos();
    let (a, b) = match shape {
        Shape::FourBar { solver, .. } => {
            let m = solver.position(phi, assembly).ok()?;
            (solver.crank().m(), m.joint.position_m)
        }
        Shape::SliderCrank { solver, .. } => {
            let m = solver.position(phi, assembly).ok()?;
            let (e, [s, c]) = (solver.offset().m(), direction(shape));
            let x = m.slider_m;
            (solver.crank().m(), [x * c - e * s, x * s + e * c])
        }
    };
    Some((degrees, [a * cos, a * sin], b))
}

/// Sine and cosine of the guide's direction.
fn direction(shape: &Shape) -> [f64; 2] {
    match shape {
        Shape::FourBar { .. } => [0.0, 1.0],
        Shape::SliderCrank { solver, .. } => solver.direction().rad().sin_cos().into(),
    }
}

/// The crank angles drawn: a turn, or the range that holds the start, or the first one.
fn range(dyad: &Dyad) -> ([f64; 2], bool) {
    let start = dyad.start.as_ref().map_or(0.0, nearest_f64);
    match turn(&dyad.shape) {
        Turn::Full { .. } => ([start, start + 360.0], true),
        Turn::Parts(parts) => {
            let holds = |p: &&[f64; 2]| (start - p[0]).rem_euclid(360.0) <= p[1] - p[0];
            let part = parts.iter().find(holds).or(parts.first());
            (part.copied().unwrap_or([start, start]), false)
        }
    }
}

/// The drawing as text.
pub fn draw(dyad: &Dyad, assembly: Assembly) -> String {
    let ([from, to], whole) = range(dyad);
    let path: Vec<Position> = (0..=SAMPLES)
        .map(|k| from + (to - from) * f64::from(k) / f64::from(SAMPLES))
        .filter_map(|phi| position(&dyad.shape, phi, assembly))
        .collect();
    let origin = [0.0, 0.0];
    let pivot = match &dyad.shape {
        Shape::FourBar { solver, .. } => Some([solver.frame().m(), 0.0]),
        Shape::SliderCrank { .. } => None,
    };
    let mut all = vec![origin];
    all.extend(pivot);
    all.extend(path.iter().flat_map(|p| [p.1, p.2]));
    let view = View::new(&all);
    let name = dyad.name.as_deref().unwrap_or(dyad.shape.type_name());
    let (lead, faint) = match whole {
        true => (from, "every 45° faint".to_string()),
        false => (
            path.get(path.len().saturating_sub(1) / 2)
                .map_or(from, |p| p.0),
            format!("from {from:.2}° to {to:.2}° faint"),
        ),
    };
    let legend = format!("at φ1 = {lead:.3}°, {faint}; paths of A (dashed), B");
    let mut out = begun(name, &legend, view.height);
    ground(&mut out, &view, origin, "O1", false);
    match pivot {
        Some(p) => ground(&mut out, &view, p, "O3", path.iter().all(|q| q.2[1] < 0.0)),
        None => guide(&mut out, &view, &dyad.shape, &path),
    }
    // Eight equal parts of a turn, the start leading; or the middle of the range leading.
    let n = path.len().saturating_sub(1);
    let chosen: Vec<Position> = if whole {
        let at = |k| position(&dyad.shape, from + 45.0 * f64::from(k), assembly);
        (0..8).filter_map(at).collect()
    } else {
        let at = |k: &usize| path.get(k * n / 8).copied();
        [4, 0, 2, 6, 8].iter().filter_map(at).collect()
    };
    for p in chosen.iter().skip(1) {
        links(&mut out, &view, dyad, pivot, p, false);
    }
    for (points, colour, dash) in [
        (path.iter().map(|p| p.1).collect::<Vec<_>>(), A.1, "3 4"),
        (path.iter().map(|p| p.2).collect(), B.1, "none"),
    ] {
        let _ = writeln!(
            out,
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"2\" stroke-dasharray=\"{dash}\"/>",
            view.points(&points)
        );
    }
    if let Some(first) = chosen.first() {
        links(&mut out, &view, dyad, pivot, first, true);
        for p in [Some(origin), pivot].into_iter().flatten() {
            circle(&mut out, &view, p, INK, 1.6);
        }
        // The slider's letter clears its block.
        let lift = if pivot.is_some() { 10.0 } else { 30.0 };
        for (p, (label, colour), lift) in [(first.1, A, 10.0), (first.2, B, lift)] {
            let (x, y) = view.at(p);
            circle(&mut out, &view, p, colour, 3.0);
            text(&mut out, label, x + 11.0, y - lift, "start", colour);
        }
    }
    out.push_str("</svg>\n");
    out
}

fn links(
    out: &mut String,
    view: &View,
    dyad: &Dyad,
    pivot: Option<[f64; 2]>,
    &(_, a, b): &Position,
    lead: bool,
) {
    let (opacity, width) = if lead { (1.0, 4.0) } else { (0.16, 2.0) };
    let mut chain = vec![[0.0, 0.0], a, b];
    chain.extend(pivot);
    let _ = writeln!(
        out,
        "<g stroke=\"{INK}\" stroke-width=\"{width}\" opacity=\"{opacity}\" fill=\"none\" \
         stroke-linecap=\"round\" stroke-linejoin=\"round\">\n<polyline points=\"{}\"/>",
        view.points(&chain)
    );
    if pivot.is_none() {
        let (x, y) = view.at(b);
        let [sin, cos] = direction(&dyad.shape);
        let turn = -sin.atan2(cos).to_degrees();
        let _ = writeln!(
            out,
            "<rect x=\"{:.1}\" y=\"{:.1}\" width=\"48\" height=\"28\" fill=\"{INK}\" fill-opacity=\"0.12\" \
             transform=\"rotate({turn:.3} {x:.1} {y:.1})\"/>",
            x - 24.0,
            y - 14.0
        );
    }
    out.push_str("</g>\n");
    if lead {
        for (link, ends) in ["1", "2", "3"].iter().zip(chain.windows(2)) {
            let middle = [0, 1].map(|i| 0.5 * (ends[0][i] + ends[1][i]));
            number(out, view, link, middle, ends[1], ends[0]);
        }
    }
}

/// The guide's line as far as the slider goes, and a little farther.
fn guide(out: &mut String, view: &View, shape: &Shape, path: &[Position]) {
    let [sin, cos] = direction(shape);
    let along = |p: &Position| p.2[0] * cos + p.2[1] * sin;
    let by_place = |p: &&Position, q: &&Position| along(p).total_cmp(&along(q));
    let ends = path
        .iter()
        .min_by(by_place)
        .zip(path.iter().max_by(by_place));
    let Some((first, last)) = ends else { return };
    let ((x0, y0), (x1, y1)) = (view.at(first.2), view.at(last.2));
    let (dx, dy) = (40.0 * cos, -40.0 * sin);
    let _ = writeln!(
        out,
        "<path d=\"M{:.1} {:.1}L{:.1} {:.1}\" stroke=\"{INK}\" stroke-width=\"1.1\" stroke-dasharray=\"12 4 2 4\"/>",
        x0 - dx,
        y0 - dy,
        x1 + dx,
        y1 + dy
    );
}
