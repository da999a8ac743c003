//! Drawings of a run: speed, torques and energies over time, and work against precision.

use super::failure::Failure;
use super::runup_precision::Point;
use super::svg_panel::{
    AXIS, Area, BLUE, Drawn, GREEN, GRID, INK, ORANGE, PURPLE, curve, drawn, panel, titled,
};
use mechaudit::solvers::run_up::{Method, Sample};
use plotters::prelude::*;

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
const BINS: usize = 1600;

/// The drawing of a run.
pub fn draw(name: &str, samples: &[Sample]) -> Result<String, Failure> {
    let last = samples.last().map_or(1.0, |s| s.t);
    let end = if last > 0.0 { last } else { 1.0 };
    drawn((1000, 1080), |root| {
        let areas = titled(root, name, "")?.split_evenly((PANELS.len(), 1));
        for (k, (area, (label, courses))) in areas.iter().zip(PANELS).enumerate() {
            // What is zero throughout is not drawn.
            let seen = courses
                .iter()
                .filter(|c| courses.len() == 1 || samples.iter().any(|s| c.2(s) != 0.0));
            let curves: Vec<_> = seen
                .map(|&(name, colour, course)| curve(name, thinned(samples, course, end), colour))
                .collect();
            let time = if k + 1 == PANELS.len() { "time, s" } else { "" };
            panel(area, (time, label), &curves)?;
        }
        Ok(())
    })
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

/// The diagram of work against precision.
pub fn work_precision(name: &str, points: &[Point]) -> Result<String, Failure> {
    drawn((1000, 700), |root| {
        let body = titled(root, &format!("{name}: work and precision"), "")?;
        diagram(&body, points)
    })
}

fn diagram(body: &Area, points: &[Point]) -> Drawn {
    // An error of exactly zero has no place on the axis; rounding is about here.
    let error = |p: &Point| p.error.max(1e-16);
    let bounds = |f: &dyn Fn(&Point) -> f64| {
        let all = || points.iter().map(f);
        (
            10f64.powf(all().fold(f64::INFINITY, f64::min).log10().floor()),
            10f64.powf(all().fold(0.0, f64::max).log10().ceil()),
        )
    };
    let (x0, x1) = bounds(&error);
    let (y0, y1) = bounds(&|p| p.evaluations.max(1) as f64);
    // Errors fall to the right.
    let mut chart = ChartBuilder::on(body)
        .margin(8)
        .x_label_area_size(52)
        .y_label_area_size(84)
        .build_cartesian_2d((-x1.log10())..(-x0.log10()), (y0..y1).log_scale())?;
    let power = |x: f64| format!("1e{:.0}", -x);
    chart
        .configure_mesh()
        .x_labels(14)
        .x_label_formatter(&|x| power(*x))
        .y_label_formatter(&|y| format!("{y:.0}"))
        .x_desc("worst error of the speed found, rad/s")
        .y_desc("evaluations of the right-hand side")
        .label_style(("sans-serif", 15).into_font().color(&INK))
        .axis_desc_style(("sans-serif", 17).into_font().color(&INK))
        .axis_style(AXIS)
        .bold_line_style(GRID)
        .light_line_style(TRANSPARENT)
        .draw()?;
    for (method, colour) in Method::ALL.into_iter().zip([BLUE, ORANGE, GREEN]) {
        let own = || points.iter().filter(move |p| p.method == method);
        let line: Vec<(f64, f64)> = own()
            .map(|p| (-error(p).log10(), p.evaluations as f64))
            .collect();
        chart
            .draw_series(LineSeries::new(line.clone(), colour.stroke_width(2)))?
            .label(method.name())
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 22, y)], colour.stroke_width(3)));
        chart.draw_series(line.into_iter().map(|p| Circle::new(p, 3, colour.filled())))?;
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperLeft)
        .label_font(("sans-serif", 16).into_font().color(&INK))
        .background_style(WHITE.mix(0.85))
        .border_style(GRID)
        .legend_area_size(28)
        .margin(10)
        .draw()?;
    Ok(())
}
