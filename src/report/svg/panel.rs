//! The charts of motions: the page, its title, panels of named curves in linear or other axes.

use super::style::{AXIS, GRID, INK, PAPER, RGBColor, SOFT, head, hex, legible};
use crate::report::axis::Axis;
use maud::{Markup, html};

/// Heights of the letters of a title, of marks and names, and of the labels of axes.
const TITLE: u32 = 19;
const SMALL: u32 = 12;
const LABEL: u32 = 14;

/// Curves over a common abscissa, for a drawing as for a page.
pub struct Panel {
    /// Names the abscissa; a panel of a drawing without a name shares that of a panel below.
    pub x: String,
    /// Names the ordinate.
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

    pub fn draw(&self, area: &Area, page: &mut Page) {
        panel(area, page, (&self.x, &self.y), &self.curves);
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

/// A rectangle of a page, in pixels.
#[derive(Clone, Copy)]
pub struct Area {
    left: f64,
    top: f64,
    width: f64,
    height: f64,
}

impl Area {
    /// Without so much of it at the top, the bottom, on the left and on the right.
    pub fn margin(&self, top: f64, bottom: f64, left: f64, right: f64) -> Area {
        Area {
            left: self.left + left,
            top: self.top + top,
            width: self.width - left - right,
            height: self.height - top - bottom,
        }
    }

    /// Equal parts, row by row; each begins at a whole pixel.
    pub fn split(&self, rows: usize, columns: usize) -> Vec<Area> {
        let ends = |whole: f64, parts: usize, k: usize| {
            [k, k + 1].map(|k| (whole * k as f64 / parts as f64).floor())
        };
        let part = |k: usize| {
            let [top, bottom] = ends(self.height, rows, k / columns);
            let [left, right] = ends(self.width, columns, k % columns);
            self.margin(top, self.height - bottom, left, self.width - right)
        };
        (0..rows * columns).map(part).collect()
    }

    /// The part on the left that is so wide, and the rest.
    pub fn split_at(&self, width: f64) -> (Area, Area) {
        (
            self.margin(0.0, 0.0, 0.0, self.width - width),
            self.margin(0.0, 0.0, width, 0.0),
        )
    }
}

/// The axes of a chart, and where they are on the page.
pub struct Place {
    axes: [Axis; 2],
    area: Area,
}

impl Place {
    fn at(&self, p: (f64, f64)) -> (f64, f64) {
        let [x, y] = &self.axes;
        (
            self.area.left + x.part(p.0) * self.area.width,
            self.area.top + (1.0 - y.part(p.1)) * self.area.height,
        )
    }
}

/// A page in the making: its head, and everything below the curves and above.
#[derive(Default)]
pub struct Page {
    title: String,
    description: Vec<String>,
    below: String,
    curves: String,
}

impl Page {
    /// Draws the axes into an area; the names of curves have room above.
    pub fn axes(&mut self, area: &Area, axes: [Axis; 2], named: bool) -> Place {
        let room = area.margin(
            if named { 34.0 } else { 8.0 },
            8.0 + if axes[0].label.is_empty() { 28.0 } else { 48.0 },
            8.0 + 84.0,
            20.0,
        );
        // The last pixel belongs to the chart.
        let place = Place {
            area: room.margin(0.0, 1.0, 0.0, 1.0),
            axes,
        };
        let [x, y] = &place.axes;
        let (ends, middle) = ((x.range, y.range), |r: (f64, f64)| 0.5 * (r.0 + r.1));
        let (left, bottom) = place.at((ends.0.0, ends.1.0));
        let (right, top) = place.at((ends.0.1, ends.1.1));
        for (value, text) in &x.marks {
            let at = place.at((*value, ends.1.0)).0;
            self.stroke(GRID, [(at, top), (at, bottom)]);
            self.stroke(AXIS, [(at, bottom), (at, bottom + 5.0)]);
            self.text(text, (at, bottom + 10.0), Form::mark("middle", "0.76em"));
        }
        for (value, text) in &y.marks {
            let at = place.at((ends.0.0, *value)).1;
            self.stroke(GRID, [(left, at), (right, at)]);
            self.stroke(AXIS, [(left - 5.0, at), (left, at)]);
            self.text(text, (left - 10.0, at), Form::mark("end", "0.5ex"));
        }
        self.stroke(AXIS, [(left, bottom), (right, bottom)]);
        self.stroke(AXIS, [(left, top), (left, bottom)]);
        let label = |dy| Form {
            size: LABEL,
            ..Form::mark("middle", dy)
        };
        let centre = place.at((middle(ends.0), middle(ends.1)));
        self.text(
            &x.label,
            (centre.0, area.top + area.height - 12.0),
            label("0"),
        );
        let upright = Form {
            upright: true,
            ..label("0.76em")
        };
        self.text(&y.label, (area.left + 10.0, centre.1), upright);
        place
    }

    fn stroke(&mut self, colour: RGBColor, ends: [(f64, f64); 2]) {
        let [a, b] = ends;
        let points = format!("{:.2},{:.2} {:.2},{:.2}", a.0, a.1, b.0, b.1);
        self.add(&html! {
            polyline fill="none" stroke=(hex(colour)) stroke-width="1" points=(points) {}
        });
    }

    fn text(&mut self, text: &str, (x, y): (f64, f64), form: Form) {
        if text.is_empty() {
            return;
        }
        let turn = form.upright.then(|| format!("rotate(-90 {x:.2} {y:.2})"));
        self.add(&html! {
            text x=(format!("{x:.2}")) y=(format!("{y:.2}")) dy=(form.dy) text-anchor=(form.anchor)
                font-family="sans-serif" font-size=(form.size) fill=(hex(form.colour))
                transform=[turn] { (legible(text)) }
        });
    }

    fn add(&mut self, element: &Markup) {
        self.below += &element.0;
        self.below.push('\n');
    }

    pub fn line(&mut self, place: &Place, curve: &Curve) {
        let mut points = String::new();
        for (k, p) in curve.points.iter().enumerate() {
            let (x, y) = place.at(*p);
            let space = if k > 0 { " " } else { "" };
            points.push_str(&format!("{space}{x:.2},{y:.2}"));
        }
        self.above(&html! {
            polyline fill="none" stroke=(hex(curve.colour)) stroke-width=(curve.width)
                stroke-linejoin="round" stroke-dasharray=[curve.dashed.then_some("7 5")]
                points=(points) {}
        });
    }

    pub fn dot(&mut self, place: &Place, p: (f64, f64), colour: RGBColor) {
        let (x, y) = place.at(p);
        self.above(&html! {
            circle cx=(format!("{x:.2}")) cy=(format!("{y:.2}")) r="3" fill=(hex(colour)) {}
        });
    }

    fn above(&mut self, element: &Markup) {
        self.curves += &element.0;
        self.curves.push('\n');
    }
}

/// How a text is written, and how it hangs at its place.
struct Form {
    size: u32,
    colour: RGBColor,
    anchor: &'static str,
    dy: &'static str,
    upright: bool,
}

impl Form {
    fn mark(anchor: &'static str, dy: &'static str) -> Form {
        Form {
            size: SMALL,
            colour: INK,
            anchor,
            dy,
            upright: false,
        }
    }
}

/// A page of that size, as text.
pub fn drawn((width, height): (u32, u32), draw: impl FnOnce(&Area, &mut Page)) -> String {
    let mut page = Page::default();
    let area = Area {
        left: 0.0,
        top: 0.0,
        width: f64::from(width),
        height: f64::from(height),
    };
    draw(&area, &mut page);
    let svg = html! {
        svg width=(width) height=(height) viewBox={ "0 0 " (width) " " (height) }
            xmlns="http://www.w3.org/2000/svg" { "\n"
            (head(&page.title, &page.description.join("; ")))
            rect width=(width) height=(height) fill=(hex(PAPER)) {} "\n"
            (maud::PreEscaped(page.below))
            (maud::PreEscaped(page.curves))
        } "\n"
    };
    svg.into_string()
}

/// The page's subject, and a line of notes below it. Returns what is left of the page.
pub fn titled(root: &Area, page: &mut Page, text: &str, note: &str) -> Area {
    let text = &legible(text);
    page.title.clone_from(text);
    let form = |size, colour| Form {
        size,
        colour,
        ..Form::mark("start", "0.76em")
    };
    page.text(text, (24.0, 18.0), form(TITLE, INK));
    if note.is_empty() {
        return root.margin(56.0, 10.0, 10.0, 24.0);
    }
    let note = legible(note);
    page.text(&note, (24.0, 50.0), form(SMALL, SOFT));
    page.description.push(note);
    root.margin(76.0, 10.0, 10.0, 24.0)
}

/// Curves over a common abscissa, their names in a line above. A panel without a label of its
/// abscissa shares that of a panel below.
pub fn panel(area: &Area, page: &mut Page, labels: (&str, &str), curves: &[Curve]) {
    panel_over(abscissae(curves), area, page, labels, curves);
}

/// A panel with these ends of its abscissa.
pub fn panel_over(
    (first, last): (f64, f64),
    area: &Area,
    page: &mut Page,
    labels: (&str, &str),
    curves: &[Curve],
) {
    let points = curves.iter().flat_map(|c| c.points.iter());
    let (low, high) = padded(points.map(|p| p.1));
    let last = if last > first { last } else { first + 1.0 };
    let most = ((area.width - 112.0) / 60.0).clamp(3.0, 11.0) as usize;
    let axes = [
        Axis::linear(labels.0, (first, last), most),
        Axis::linear(labels.1, (low, high), 7),
    ];
    let label = axes[1].label.clone();
    let place = page.axes(area, axes, curves.iter().any(|c| !c.name.is_empty()));
    if low < 0.0 && high > 0.0 {
        let zero = [first, last].map(|x| place.at((x, 0.0)));
        page.stroke(AXIS, zero);
    }
    curves.iter().for_each(|c| page.line(&place, c));
    if !label.is_empty() {
        let names = curves.iter().map(|c| c.name).filter(|n| !n.is_empty());
        let names: Vec<&str> = names.collect();
        let of = if names.is_empty() { "" } else { " of " };
        let text = format!("{label}{of}{}", names.join(", "));
        page.description.push(text);
    }
    legend(area, page, curves);
}

/// Writes names in a line above the panel, where no curve can run through them.
pub fn legend(area: &Area, page: &mut Page, curves: &[Curve]) {
    let (mut x, y) = (area.left + 100.0, area.top + 18.0);
    for c in curves.iter().filter(|c| !c.name.is_empty()) {
        let points = format!("{x:.2},{y:.2} {:.2},{y:.2}", x + 27.0);
        page.add(&html! {
            polyline fill="none" stroke=(hex(c.colour)) stroke-width="3"
                stroke-dasharray=[c.dashed.then_some("7 3")] points=(points) {}
        });
        let form = Form::mark("start", "0.76em");
        page.text(c.name, (x + 34.0, y - 8.0), form);
        // Letters of this size are about eight pixels wide.
        x += 34.0 + 8.0 * c.name.chars().count() as f64 + 26.0;
    }
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
