//! What the drawings of motions have in common: the page, its title, panels of named curves.

use super::failure::Failure;
use super::svg_reduced::{padded, tick};
use plotters::coord::Shift;
use plotters::prelude::*;

pub type Drawn = Result<(), Box<dyn std::error::Error>>;
pub type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

pub const INK: RGBColor = RGBColor(29, 33, 37);
pub const AXIS: RGBColor = RGBColor(120, 128, 136);
pub const GRID: RGBColor = RGBColor(220, 224, 227);
pub const BLUE: RGBColor = RGBColor(31, 111, 178);
pub const ORANGE: RGBColor = RGBColor(194, 87, 26);
pub const GREEN: RGBColor = RGBColor(47, 143, 78);
pub const PURPLE: RGBColor = RGBColor(122, 79, 163);

/// A curve; one without a name is not in the legend.
pub struct Curve {
    pub name: &'static str,
    pub points: Vec<(f64, f64)>,
    pub colour: RGBColor,
    pub width: u32,
    pub dashed: bool,
}

pub fn curve(name: &'static str, points: Vec<(f64, f64)>, colour: RGBColor) -> Curve {
    Curve {
        name,
        points,
        colour,
        width: 2,
        dashed: false,
    }
}

pub fn dashed(name: &'static str, points: Vec<(f64, f64)>, colour: RGBColor) -> Curve {
    Curve {
        dashed: true,
        ..curve(name, points, colour)
    }
}

/// A page of that size, as text.
pub fn drawn(size: (u32, u32), draw: impl FnOnce(&Area) -> Drawn) -> Result<String, Failure> {
    let mut out = String::new();
    {
        let root = SVGBackend::with_string(&mut out, size).into_drawing_area();
        let done = root
            .fill(&WHITE)
            .map_err(Into::into)
            .and_then(|()| draw(&root));
        let done = done.and_then(|()| root.present().map_err(Into::into));
        done.map_err(|e| Failure::new(format!("cannot draw: {e}")))?;
    }
    Ok(out)
}

/// What the page is about, and a line of notes below it. Returns what is left of the page.
pub fn titled<'a>(
    root: &Area<'a>,
    text: &str,
    note: &str,
) -> Result<Area<'a>, Box<dyn std::error::Error>> {
    let font = ("sans-serif", 24).into_font().color(&INK);
    root.draw(&Text::new(text.to_string(), (24, 18), font))?;
    if note.is_empty() {
        return Ok(root.margin(56, 10, 10, 24));
    }
    let font = ("sans-serif", 15).into_font().color(&AXIS);
    root.draw(&Text::new(note.to_string(), (24, 50), font))?;
    Ok(root.margin(76, 10, 10, 24))
}

/// Curves over a common abscissa, their names in a line above. A panel without a label of its
/// abscissa shares that of a panel below.
pub fn panel(area: &Area, labels: (&str, &str), curves: &[Curve]) -> Drawn {
    let points = || curves.iter().flat_map(|c| c.points.iter());
    let (low, high) = padded(points().map(|p| p.1));
    let (first, last) = points().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), p| {
        (a.min(p.0), b.max(p.0))
    });
    let last = if last > first { last } else { first + 1.0 };
    let named = curves.iter().any(|c| !c.name.is_empty());
    let mut chart = ChartBuilder::on(area)
        .margin(8)
        .margin_right(20)
        .margin_top(if named { 34 } else { 8 })
        .x_label_area_size(if labels.0.is_empty() { 28 } else { 48 })
        .y_label_area_size(84)
        .build_cartesian_2d(first..last, low..high)?;
    chart
        .configure_mesh()
        .x_labels(11)
        .y_labels(7)
        .x_label_formatter(&|x| tick(*x))
        .y_label_formatter(&|y| {
            tick(if y.abs() < 1e-9 * (high - low) {
                0.0
            } else {
                *y
            })
        })
        .x_desc(labels.0)
        .y_desc(labels.1)
        .label_style(("sans-serif", 15).into_font().color(&INK))
        .axis_desc_style(("sans-serif", 17).into_font().color(&INK))
        .axis_style(AXIS)
        .bold_line_style(GRID)
        .light_line_style(TRANSPARENT)
        .draw()?;
    if low < 0.0 && high > 0.0 {
        let zero = [(first, 0.0), (last, 0.0)];
        chart.draw_series(LineSeries::new(zero, AXIS.stroke_width(1)))?;
    }
    for c in curves {
        let points = c.points.iter().copied();
        let style = c.colour.stroke_width(c.width);
        match c.dashed {
            true => chart.draw_series(DashedLineSeries::new(points, 7, 5, style))?,
            false => chart.draw_series(LineSeries::new(points, style))?,
        };
    }
    legend(area, curves)
}

/// In a line above the panel, where no curve can run through the names.
pub fn legend(area: &Area, curves: &[Curve]) -> Drawn {
    let font = ("sans-serif", 15).into_font().color(&INK);
    let mut x = 100;
    for c in curves.iter().filter(|c| !c.name.is_empty()) {
        let style = c.colour.stroke_width(3);
        let strokes: &[(i32, i32)] = if c.dashed {
            &[(0, 7), (10, 17), (20, 27)]
        } else {
            &[(0, 27)]
        };
        for (from, to) in strokes {
            area.draw(&PathElement::new([(x + from, 18), (x + to, 18)], style))?;
        }
        area.draw(&Text::new(c.name, (x + 34, 10), font.clone()))?;
        // Letters of this size are about eight pixels wide.
        x += 34 + 8 * c.name.chars().count() as i32 + 26;
    }
    Ok(())
}
