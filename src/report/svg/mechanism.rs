//! A mechanism of any structure at several positions, with the paths of its points.

use super::style::{head, legible};
use super::view::{INK, PAPER, Point, SOFT, View, WIDTH};
use crate::motion::hull;
use maud::{Markup, html};

/// Colours of paths, again from the first when they are used up.
const PATHS: [&str; 5] = ["#c2571a", "#1f6fb2", "#2f8f4e", "#7a4fa3", "#8a8f98"];

/// A mechanism over its drive's range.
pub struct Scene<'a> {
    /// What it is.
    pub name: &'a str,
    /// The drive's unit as written behind a number.
    pub unit: &'a str,
    /// Points of the ground in metres.
    pub fixed: &'a [(String, Point)],
    /// Names of the moving points, in the order of [`Pose::points`].
    pub points: &'a [String],
    /// Positions from one end of the range to the other.
    pub poses: &'a [Pose],
    /// Whether that is a whole turn.
    pub whole: bool,
}

/// A position.
#[derive(Clone)]
pub struct Pose {
    /// The drive in the scene's unit.
    pub drive: f64,
    /// The moving points.
    pub points: Vec<Point>,
    /// The moving bodies.
    pub shapes: Vec<Shape>,
}

/// A body: its points.
#[derive(Clone)]
pub struct Shape {
    /// One point, two of a bar, or the corners of a plate.
    pub corners: Vec<Point>,
}

impl Scene<'_> {
    /// The drawing.
    pub fn draw(&self) -> String {
        let moving = self.poses.iter().flat_map(|p| &p.points).copied();
        let view = View::new(self.fixed.iter().map(|f| f.1).chain(moving));
        let chosen = self.chosen();
        let (legend, height) = (self.legend(&chosen), format!("{:.0}", view.height));
        let svg = html! {
            svg xmlns="http://www.w3.org/2000/svg" viewBox={ "0 0 " (WIDTH) " " (height) }
                width=(WIDTH) height=(height) font-family="sans-serif" font-size="16" { "\n"
                (head(self.name, &legend))
                rect width="100%" height="100%" fill=(PAPER) {} "\n"
                text x="24" y="36" font-size="22" font-weight="600" fill=(INK) { (legible(self.name)) } "\n"
                text x="24" y="60" font-size="15" fill=(SOFT) { (legend) } "\n"
                @for pose in chosen.iter().skip(1) { (bodies(&view, pose, false)) }
                @for (i, _) in self.points.iter().enumerate() {
                    polyline points=(view.line(self.poses.iter().map(|p| p.points[i]))) fill="none"
                        stroke=(PATHS[i % PATHS.len()]) stroke-width="1.6" {} "\n"
                }
                @if let Some(first) = chosen.first() {
                    (bodies(&view, first, true))
                    @for (name, at) in self.fixed { (pivot(&view, name, *at)) }
                    @for (i, name) in self.points.iter().enumerate() {
                        (dot(&view, name, first.points[i], PATHS[i % PATHS.len()]))
                    }
                }
            } "\n"
        };
        svg.into_string()
    }

    /// The position drawn in full and those drawn faintly: of a turn its start and eighths, of a range
    /// its middle and quarters.
    fn chosen(&self) -> Vec<&Pose> {
        let n = self.poses.len();
        let order: &[usize] = if self.whole {
            &[0, 1, 2, 3, 4, 5, 6, 7]
        } else {
            &[4, 0, 2, 6, 8]
        };
        match n {
            0..8 => self.poses.iter().collect(),
            _ => order.iter().map(|k| &self.poses[k * (n - 1) / 8]).collect(),
        }
    }

    fn legend(&self, chosen: &[&Pose]) -> String {
        let unit = self.unit;
        let first = chosen.first().map_or(f64::NAN, |p| p.drive);
        let others = match self.whole {
            true => "every eighth of a turn faint".to_string(),
            false => {
                let drives = || chosen.iter().map(|p| p.drive);
                let low = drives().fold(f64::INFINITY, f64::min);
                let high = drives().fold(f64::NEG_INFINITY, f64::max);
                format!("from {low:.2}{unit} to {high:.2}{unit} faint")
            }
        };
        let names = self.points.join(", ");
        legible(&format!(
            "drive at {first:.3}{unit}, {others}; paths of {names}"
        ))
    }
}

fn bodies(view: &View, pose: &Pose, lead: bool) -> Markup {
    let (opacity, width) = if lead { ("1", "4") } else { ("0.16", "2") };
    html! {
        g stroke=(INK) stroke-width=(width) opacity=(opacity) stroke-linecap="round"
            stroke-linejoin="round" fill="none" { "\n"
            @for shape in &pose.shapes {
                @match shape.corners.len() {
                    0 => {}
                    1 => { (slider(view, shape.corners[0])) }
                    2 => { polyline points=(view.line(shape.corners.iter().copied())) {} "\n" }
                    _ => {
                        polygon points=(view.line(hull(&shape.corners).into_iter().map(|k| shape.corners[k]))) fill=(INK)
                            fill-opacity="0.12" {} "\n"
                    }
                }
            }
        } "\n"
    }
}

/// A body of one point.
fn slider(view: &View, at: Point) -> Markup {
    let (x, y) = view.at(at);
    html! {
        rect x=(format!("{:.1}", x - 14.0)) y=(format!("{:.1}", y - 9.0)) width="28" height="18" {} "\n"
    }
}

fn label(name: &str, (x, y): (f64, f64), colour: &str) -> Markup {
    // A white edge keeps labels readable on lines.
    html! {
        text x=(format!("{x:.1}")) y=(format!("{y:.1}")) fill=(colour) stroke=(PAPER) stroke-width="4"
            paint-order="stroke" stroke-linejoin="round" { (legible(name)) } "\n"
    }
}

fn dot(view: &View, name: &str, at: Point, colour: &str) -> Markup {
    let (x, y) = view.at(at);
    html! {
        circle cx=(format!("{x:.1}")) cy=(format!("{y:.1}")) r="5" fill=(PAPER) stroke=(colour)
            stroke-width="3" {} "\n"
        (label(name, (x + 9.0, y - 9.0), colour))
    }
}

/// A fixed pivot on hatched ground.
fn pivot(view: &View, name: &str, at: Point) -> Markup {
    let (x, y) = view.at(at);
    html! {
        g stroke=(INK) stroke-width="1.6" { "\n"
            path d=(format!("M{x:.1} {y:.1}l-13 22h26z")) fill=(PAPER) {} "\n"
            path d=(format!("M{:.1} {:.1}h44", x - 22.0, y + 22.0)) {} "\n"
            @for k in 0..6 {
                @let foot = x - 18.0 + 8.0 * f64::from(k);
                path d=(format!("M{foot:.1} {:.1}l-7 8", y + 22.0)) stroke-width="1.1" {} "\n"
            }
            circle cx=(format!("{x:.1}")) cy=(format!("{y:.1}")) r="5" fill=(PAPER) {} "\n"
        } "\n"
        (label(name, (x + 18.0, y + 18.0), INK))
    }
}

#[cfg(test)]
mod tests;
