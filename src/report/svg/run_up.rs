//! Drawings of a run: speed, torques and energies over time, and work against precision.

use super::panel::{Area, Curve, Page, Panel, curve, drawn, legend, panel, tick, titled};
use super::style::{BLUE, GREEN, ORANGE, PURPLE, RGBColor};
use crate::report::axis::Axis;
use crate::solvers::run_up::Sample;

/// A name, a colour and what is drawn.
type Course = (&'static str, RGBColor, fn(&Sample) -> f64);

const PANELS: [(&str, &[Course]); 3] = [
    ("crank speed ω, rad/s", &[("", BLUE, |s| s.psi)]),
    (
        "torque at the crank, N·m",
        &[
            ("motor", BLUE, |s| s.motor),
            ("weights M_o", GREEN, |s| s.weights),
            ("load", PURPLE, |s| s.resistance),
        ],
    ),
    (
        "energy, J",
        &[
            ("kinetic", ORANGE, |s| s.kinetic_energy),
            ("work of the motor", BLUE, |s| s.work[0]),
            ("work of the weights", GREEN, |s| s.work[1]),
            ("work of the load", PURPLE, |s| s.work[2]),
        ],
    ),
];

/// Columns of the drawing: with two points in each it looks like all of them.
const BINS: usize = 700;

/// Width of the panels that show it enlarged.
const ENLARGED: f64 = 370.0;

/// The drawing of a run; a short start has samples of its own and stands enlarged beside the rest.
pub fn draw(name: &str, samples: &[Sample], start: Option<&[Sample]>) -> String {
    let end = |s: &[Sample]| s.last().map_or(0.0, |s| s.t);
    let note = start.map_or(String::new(), |s| {
        let times = end(samples) / end(s);
        format!(
            "left: the start, {} ms of {} s, {times:.0} times as wide; right: the whole run",
            tick(1e3 * end(s)),
            tick(end(samples))
        )
    });
    drawn((1000, 1080), |root, page| {
        let areas = titled(root, page, name, &note).split(PANELS.len(), 1);
        for (k, (area, (label, courses))) in areas.iter().zip(PANELS).enumerate() {
            let seen = seen(courses, samples);
            let last = k + 1 == PANELS.len();
            let Some(start) = start else {
                let time = if last { "time, s" } else { "" };
                panel(area, page, (time, label), &curves(&seen, samples, 1.0));
                continue;
            };
            let (left, right) = area.split_at(ENLARGED);
            let (ms, s) = if last {
                ("time, ms", "time, s")
            } else {
                ("", "")
            };
            let mut enlarged = curves(&seen, start, 1e3);
            // The names stand over the whole run, where there is room for them.
            let names = enlarged.iter().any(|c| !c.name.is_empty());
            let left = if names {
                left.margin(26.0, 0.0, 0.0, 0.0)
            } else {
                left
            };
            enlarged.iter_mut().for_each(|c| c.name = "");
            panel(&left, page, (ms, label), &enlarged);
            panel(&right, page, (s, ""), &curves(&seen, samples, 1.0));
        }
    })
}

/// Leaves out courses that are zero throughout.
fn seen(courses: &[Course], samples: &[Sample]) -> Vec<Course> {
    let drawn = |c: &&Course| courses.len() == 1 || samples.iter().any(|s| c.2(s) != 0.0);
    courses.iter().filter(drawn).copied().collect()
}

/// The panels of a page; what is zero throughout the `whole` run is not drawn.
pub fn panels(samples: &[Sample], whole: &[Sample]) -> Vec<Panel> {
    let panel = |(label, courses): &(&str, &[Course])| {
        Panel::new(
            "time, s",
            *label,
            curves(&seen(courses, whole), samples, 1.0),
        )
    };
    PANELS.iter().map(panel).collect()
}

/// The courses over time, in seconds divided by `scale`.
fn curves(courses: &[Course], samples: &[Sample], scale: f64) -> Vec<Curve> {
    let end = samples.last().map_or(1.0, |s| s.t);
    let end = if end > 0.0 { end } else { 1.0 };
    let one = |&(name, colour, course): &Course| {
        let mut line = thinned(samples, course, end);
        line.iter_mut().for_each(|p| p.0 *= scale);
        curve(name, line, colour)
    };
    courses.iter().map(one).collect()
}

/// The least and the largest value in each column of the drawing, in order of time.
fn thinned(samples: &[Sample], curve: fn(&Sample) -> f64, end: f64) -> Vec<(f64, f64)> {
    if samples.len() <= 2 * BINS {
        return samples.iter().map(|s| (s.t, curve(s))).collect();
    }
    let bin = |s: &Sample| ((s.t / end) * BINS as f64) as usize;
    let mut line = Vec::new();
    for group in samples.chunk_by(|a, b| bin(a) == bin(b)) {
        let value = |s: &&Sample| curve(s);
        let least = group.iter().min_by(|a, b| value(a).total_cmp(&value(b)));
        let most = group.iter().max_by(|a, b| value(a).total_cmp(&value(b)));
        let mut pair: Vec<&Sample> = least.into_iter().chain(most).collect();
        pair.sort_by(|a, b| a.t.total_cmp(&b.t));
        line.extend(pair.iter().map(|s| (s.t, curve(s))));
    }
    line
}

/// The cost of a method of integration.
pub struct Work {
    /// The method.
    pub method: &'static str,
    /// For each tolerance the worst error of the speed in rad/s, and evaluations of the right-hand
    /// side.
    pub points: Vec<(f64, u64)>,
}

/// The diagram of work against precision.
pub fn work_precision(name: &str, methods: &[Work]) -> String {
    drawn((1000, 700), |root, page| {
        let note = "each point a tolerance: what it costs and how far off the speed is";
        let body = titled(root, page, &format!("{name}: work and precision"), note);
        diagram(&body, page, methods);
    })
}

fn diagram(body: &Area, page: &mut Page, methods: &[Work]) {
    // An error of exactly zero has no place on the axis; rounding is about here.
    let error = |p: &(f64, u64)| p.0.max(1e-16).log10();
    let work = |p: &(f64, u64)| (p.1.max(1) as f64).log10();
    let bounds = |f: &dyn Fn(&(f64, u64)) -> f64| {
        let all = || methods.iter().flat_map(|m| &m.points).map(f);
        let low = all().fold(f64::INFINITY, f64::min).floor();
        let high = all().fold(f64::NEG_INFINITY, f64::max).ceil();
        (low, high.max(low + 1.0))
    };
    let ((x0, x1), (y0, y1)) = (bounds(&error), bounds(&work));
    // Errors fall to the right.
    let axes = [
        Axis::decades(
            "worst error of the speed found, rad/s",
            (-x1, -x0),
            14,
            |x| format!("1e{:.0}", -x),
        ),
        Axis::decades("evaluations of the right-hand side", (y0, y1), 10, |y| {
            format!("{:.0}", 10f64.powf(y))
        }),
    ];
    let place = page.axes(body, axes, true);
    let mut lines = Vec::new();
    for (m, colour) in methods.iter().zip([BLUE, ORANGE, GREEN, PURPLE]) {
        let line: Vec<(f64, f64)> = m.points.iter().map(|p| (-error(p), work(p))).collect();
        line.iter().for_each(|p| page.dot(&place, *p, colour));
        lines.push(curve(m.method, line, colour));
    }
    lines.iter().for_each(|c| page.line(&place, c));
    legend(body, page, &lines);
}

#[cfg(test)]
mod tests;
