//! Drawings of a run: speed, torques and energies over time, and work against precision.

use super::failure::Failure;
use super::output::write_to;
use super::runup_precision::Point;
use super::svg_reduced::{padded, tick};
use mechaudit::solvers::run_up::{Method, Sample};
use plotters::prelude::*;
use std::path::Path;

/// Writes a drawing into the folder, which is made if missing.
pub fn save(folder: &Path, file: &str, text: &str) -> Result<(), Failure> {
    std::fs::create_dir_all(folder)
        .map_err(|e| Failure::new(format!("cannot make the folder {}: {e}", folder.display())))?;
    write_to(Some(&folder.join(file)), |out| {
        Ok(out.write_all(text.as_bytes())?)
    })
}

type Curve = (&'static str, RGBColor, fn(&Sample) -> f64);

const INK: RGBColor = RGBColor(29, 33, 37);
const AXIS: RGBColor = RGBColor(120, 128, 136);
const GRID: RGBColor = RGBColor(220, 224, 227);
const BLUE: RGBColor = RGBColor(31, 111, 178);
const ORANGE: RGBColor = RGBColor(194, 87, 26);
const GREEN: RGBColor = RGBColor(47, 143, 78);
const PURPLE: RGBColor = RGBColor(122, 79, 163);

const PANELS: [(&str, &[Curve]); 3] = [
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
    let mut out = String::new();
    panels(&mut out, name, samples).map_err(|e| Failure::new(format!("cannot draw: {e}")))?;
    Ok(out)
}

fn panels(
    out: &mut String,
    name: &str,
    samples: &[Sample],
) -> Result<(), Box<dyn std::error::Error>> {
    let last = samples.last().map_or(1.0, |s| s.t);
    let end = if last > 0.0 { last } else { 1.0 };
    let root = SVGBackend::with_string(out, (1000, 1080)).into_drawing_area();
    root.fill(&WHITE)?;
    let title = ("sans-serif", 24).into_font().color(&INK);
    root.draw(&Text::new(name.to_string(), (24, 20), title))?;
    let body = root.margin(56, 10, 10, 24);
    for (k, (area, (label, curves))) in body.split_evenly((3, 1)).iter().zip(PANELS).enumerate() {
        // What is zero throughout is not drawn.
        let seen: Vec<&Curve> = curves
            .iter()
            .filter(|c| curves.len() == 1 || samples.iter().any(|s| c.2(s) != 0.0))
            .collect();
        let all = seen.iter().flat_map(|c| samples.iter().map(|s| c.2(s)));
        let (low, high) = padded(all);
        let mut chart = ChartBuilder::on(area)
            .margin(8)
            .margin_top(if seen.len() > 1 { 32 } else { 8 })
            .x_label_area_size(if k == 2 { 48 } else { 28 })
            .y_label_area_size(84)
            .build_cartesian_2d(0.0..end, low..high)?;
        chart
            .configure_mesh()
            .x_labels(11)
            .y_labels(7)
            .x_label_formatter(&|x| tick(*x))
            .y_label_formatter(&|y| tick(*y))
            .x_desc(if k == 2 { "time, s" } else { "" })
            .y_desc(label)
            .label_style(("sans-serif", 15).into_font().color(&INK))
            .axis_desc_style(("sans-serif", 17).into_font().color(&INK))
            .axis_style(AXIS)
            .bold_line_style(GRID)
            .light_line_style(TRANSPARENT)
            .draw()?;
        if low < 0.0 && high > 0.0 {
            let zero = [(0.0, 0.0), (end, 0.0)];
            chart.draw_series(LineSeries::new(zero, AXIS.stroke_width(1)))?;
        }
        for (_, colour, curve) in &seen {
            let line = thinned(samples, *curve, end);
            chart.draw_series(LineSeries::new(line, colour.stroke_width(2)))?;
        }
        if seen.iter().any(|c| !c.0.is_empty()) {
            legend(area, &seen)?;
        }
    }
    root.present()?;
    drop(body);
    Ok(())
}

/// The names of the curves in a line above the panel, where no curve can run through them.
fn legend<DB: DrawingBackend>(
    area: &DrawingArea<DB, plotters::coord::Shift>,
    curves: &[&Curve],
) -> Result<(), Box<dyn std::error::Error>>
where
    DB::ErrorType: 'static,
{
    let font = ("sans-serif", 15).into_font().color(&INK);
    let mut x = 100;
    for (text, colour, _) in curves {
        let stroke = PathElement::new([(x, 16), (x + 26, 16)], colour.stroke_width(3));
        area.draw(&stroke)?;
        area.draw(&Text::new(text.to_string(), (x + 34, 8), font.clone()))?;
        // Letters of this size are about eight pixels wide.
        x += 34 + 8 * text.chars().count() as i32 + 30;
    }
    Ok(())
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
    let mut out = String::new();
    diagram(&mut out, name, points).map_err(|e| Failure::new(format!("cannot draw: {e}")))?;
    Ok(out)
}

fn diagram(
    out: &mut String,
    name: &str,
    points: &[Point],
) -> Result<(), Box<dyn std::error::Error>> {
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
    let root = SVGBackend::with_string(out, (1000, 700)).into_drawing_area();
    root.fill(&WHITE)?;
    let title = ("sans-serif", 24).into_font().color(&INK);
    root.draw(&Text::new(
        format!("{name}: work and precision"),
        (24, 20),
        title,
    ))?;
    let body = root.margin(56, 10, 10, 24);
    // Errors fall to the right.
    let mut chart = ChartBuilder::on(&body)
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
    root.present()?;
    drop(chart);
    drop(body);
    Ok(())
}
