//! What the drawings of motions have in common: the page, its title, panels of named curves.

use super::style::{AXIS, GRID, INK, PAPER, SOFT, head, hex, legible};
use crate::report::axis::Format;
use maud::{Markup, html};
use plotters::coord::Shift;
use plotters::coord::ranged1d::{BoldPoints, Ranged};
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use std::ops::Range;

/// A page that cannot be drawn, with the reason.
#[derive(Debug, thiserror::Error)]
#[error("cannot draw: {0}")]
pub struct CannotDraw(Box<dyn std::error::Error + Send + Sync>);

pub type Drawn = Result<(), Box<dyn std::error::Error + Send + Sync>>;
pub type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Chart<'a, 'b, X, Y> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<X, Y>>;

/// Curves over a common abscissa, for a drawing as for a page.
pub struct Panel {
    /// What the abscissa is; a panel of a drawing without one shares that of a panel below.
    pub x: String,
    /// What the ordinate is.
    pub y: String,
    pub curves: Vec<Curve>,
}

impl Panel {
    pub fn new(x: &str, y: impl Into<String>, curves: impl Into<Vec<Curve>>) -> Panel {
        Panel {
            x: x.into(),
            y: y.into(),
            curves: curves.into(),
        }
    }

    pub fn draw(&self, area: &Area, page: &mut Page) -> Drawn {
        panel(area, page, (&self.x, &self.y), &self.curves)
    }

    /// The ends of its axes.
    pub fn ranges(&self) -> [(f64, f64); 2] {
        let points = || self.curves.iter().flat_map(|c| c.points.iter());
        [abscissae(&self.curves), padded(points().map(|p| p.1))]
    }
}

/// The ends of the curves' abscissa.
fn abscissae(curves: &[Curve]) -> (f64, f64) {
    let points = curves.iter().flat_map(|c| c.points.iter());
    let (low, high) = points.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), p| {
        (a.min(p.0), b.max(p.0))
    });
    if low <= high { (low, high) } else { (0.0, 1.0) }
}

/// A curve; one without a name is not in the legend.
#[derive(Clone)]
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

/// What a page has besides axes and words: plotters rounds to whole pixels, which shows in curves.
#[derive(Default)]
pub struct Page {
    title: String,
    description: Vec<String>,
    curves: Vec<String>,
}

/// Where a chart's values stand on the page.
pub struct Place {
    values: [Range<f64>; 2],
    pixels: [Range<i32>; 2],
}

impl Place {
    /// `values` are the ends of the axes; their logarithms where an axis is logarithmic.
    pub fn of<X, Y>(chart: &Chart<X, Y>, x: Range<f64>, y: Range<f64>) -> Place
    where
        X: Ranged<ValueType = f64>,
        Y: Ranged<ValueType = f64>,
    {
        let axes = chart.as_coord_spec();
        Place {
            values: [x, y],
            pixels: [axes.get_x_axis_pixel_range(), axes.get_y_axis_pixel_range()],
        }
    }

    fn at(&self, p: (f64, f64)) -> (f64, f64) {
        let part = |i: usize, v: f64| {
            let (range, pixels) = (&self.values[i], &self.pixels[i]);
            let length = f64::from(pixels.end - pixels.start);
            (v - range.start) / (range.end - range.start) * length
        };
        (
            f64::from(self.pixels[0].start) + part(0, p.0),
            f64::from(self.pixels[1].end) - part(1, p.1),
        )
    }
}

impl Page {
    pub fn line(&mut self, place: &Place, curve: &Curve) {
        let mut points = String::new();
        for (k, p) in curve.points.iter().enumerate() {
            let (x, y) = place.at(*p);
            let space = if k > 0 { " " } else { "" };
            points.push_str(&format!("{space}{x:.2},{y:.2}"));
        }
        self.add(&html! {
            polyline fill="none" stroke=(hex(curve.colour)) stroke-width=(curve.width)
                stroke-linejoin="round" stroke-dasharray=[curve.dashed.then_some("7 5")]
                points=(points) {}
        });
    }

    pub fn dot(&mut self, place: &Place, p: (f64, f64), colour: RGBColor) {
        let (x, y) = place.at(p);
        self.add(&html! {
            circle cx=(format!("{x:.2}")) cy=(format!("{y:.2}")) r="3" fill=(hex(colour)) {}
        });
    }

    fn add(&mut self, element: &Markup) {
        self.curves.push(format!("{}\n", element.0));
    }
}

/// A page of that size, as text.
pub fn drawn(
    size: (u32, u32),
    draw: impl FnOnce(&Area, &mut Page) -> Drawn,
) -> Result<String, CannotDraw> {
    let mut out = String::new();
    let mut page = Page::default();
    {
        let root = SVGBackend::with_string(&mut out, size).into_drawing_area();
        let done = root
            .fill(&PAPER)
            .map_err(Into::into)
            .and_then(|()| draw(&root, &mut page));
        let done = done.and_then(|()| root.present().map_err(Into::into));
        done.map_err(CannotDraw)?;
    }
    let head = head(&page.title, &page.description.join("; "));
    let begun = out.find('>').map_or(0, |k| k + 2);
    out.insert_str(begun, &head.into_string());
    let end = out.rfind("</svg>").unwrap_or(out.len());
    out.insert_str(end, &page.curves.concat());
    Ok(out)
}

/// What the page is about, and a line of notes below it. Returns what is left of the page.
pub fn titled<'a>(
    root: &Area<'a>,
    page: &mut Page,
    text: &str,
    note: &str,
) -> Result<Area<'a>, Box<dyn std::error::Error + Send + Sync>> {
    let text = &legible(text);
    page.title.clone_from(text);
    let font = ("sans-serif", 24).into_font().color(&INK);
    root.draw(&Text::new(text.clone(), (24, 18), font))?;
    if note.is_empty() {
        return Ok(root.margin(56, 10, 10, 24));
    }
    let note = legible(note);
    let font = ("sans-serif", 15).into_font().color(&SOFT);
    root.draw(&Text::new(note.clone(), (24, 50), font))?;
    page.description.push(note);
    Ok(root.margin(76, 10, 10, 24))
}

/// Curves over a common abscissa, their names in a line above. A panel without a label of its
/// abscissa shares that of a panel below.
pub fn panel(area: &Area, page: &mut Page, labels: (&str, &str), curves: &[Curve]) -> Drawn {
    panel_over(abscissae(curves), area, page, labels, curves)
}

/// A panel with these ends of its abscissa.
pub fn panel_over(
    (first, last): (f64, f64),
    area: &Area,
    page: &mut Page,
    labels: (&str, &str),
    curves: &[Curve],
) -> Drawn {
    let labels = (labels.0, legible(labels.1));
    let points = curves.iter().flat_map(|c| c.points.iter());
    let (low, high) = padded(points.map(|p| p.1));
    let last = if last > first { last } else { first + 1.0 };
    let named = curves.iter().any(|c| !c.name.is_empty());
    let most = (area.dim_in_pixel().0.saturating_sub(112) / 60).clamp(3, 11) as usize;
    let format = |from: f64, to: f64, most| {
        let marks = RangedCoordf64::from(from..to).key_points(BoldPoints(most));
        let near = 1e-9 * (to - from);
        let zeroed = marks
            .into_iter()
            .map(|x| if x.abs() < near { 0.0 } else { x });
        let format = Format::of(&zeroed.collect::<Vec<f64>>());
        move |x: &f64| format.text(if x.abs() < near { 0.0 } else { *x })
    };
    let (abscissa, ordinate) = (format(first, last, most), format(low, high, 7));
    let mut chart = ChartBuilder::on(area)
        .margin(8)
        .margin_right(20)
        .margin_top(if named { 34 } else { 8 })
        .x_label_area_size(if labels.0.is_empty() { 28 } else { 48 })
        .y_label_area_size(84)
        .build_cartesian_2d(first..last, low..high)?;
    chart
        .configure_mesh()
        .x_labels(most)
        .y_labels(7)
        .x_label_formatter(&abscissa)
        .y_label_formatter(&ordinate)
        .x_desc(labels.0)
        .y_desc(&labels.1)
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
    let place = Place::of(&chart, first..last, low..high);
    curves.iter().for_each(|c| page.line(&place, c));
    if !labels.1.is_empty() {
        let names: Vec<&str> = curves.iter().map(|c| c.name).collect();
        let names: Vec<&str> = names.into_iter().filter(|n| !n.is_empty()).collect();
        let of = if names.is_empty() { "" } else { " of " };
        let text = format!("{}{of}{}", labels.1, names.join(", "));
        page.description.push(text);
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
        area.draw(&Text::new(legible(c.name), (x + 34, 10), font.clone()))?;
        // Letters of this size are about eight pixels wide.
        x += 34 + 8 * c.name.chars().count() as i32 + 26;
    }
    Ok(())
}

/// A number without needless zeros.
pub fn tick(y: f64) -> String {
    match y.abs() {
        0.0 => "0".into(),
        size if (1e-3..1e6).contains(&size) => ((y * 1e6).round() / 1e6).to_string(),
        _ => format!("{y:.2e}"),
    }
}

/// The range of the values with some air; zero belongs to it where it is near.
fn padded(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for v in values.filter(|v| v.is_finite()) {
        low = low.min(v);
        high = high.max(v);
    }
    if !(low <= high) {
        return (-1.0, 1.0);
    }
    let size = high - low;
    if low > 0.0 && low < 0.3 * high {
        low = 0.0;
    }
    let air = if size > 0.0 {
        0.05 * size
    } else {
        0.5 * high.abs().max(1.0)
    };
    (low - if low == 0.0 { 0.0 } else { air }, high + air)
}

#[cfg(test)]
pub(super) mod tests;
