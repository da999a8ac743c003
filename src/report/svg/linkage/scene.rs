//! A mechanism at several positions, with the paths of its joints.

use super::super::style::{head, legible};
use super::super::view::{INK, PAPER, Point, SOFT, View, WIDTH};
use crate::motion::hull;
use maud::{Markup, html};

/// Half the length and half the width of a slider.
const SLIDER: [f64; 2] = [24.0, 14.0];

/// Colours of paths, again from the first when they are used up.
const PATHS: [&str; 5] = ["#c2571a", "#1f6fb2", "#2f8f4e", "#7a4fa3", "#8a8f98"];

/// A mechanism over its drive's range.
pub struct Scene<'a> {
    /// Its name.
    pub name: &'a str,
    /// The drive in words before its value, its unit behind it, and how an eighth of a turn is
    /// told.
    pub drive: [&'static str; 3],
    /// Fixed pivots.
    pub pivots: &'a [Pivot],
    /// Moving joints, in the order of [`Pose::joints`].
    pub joints: &'a [Joint],
    /// Angle of the slider's guide in radians, where there is one.
    pub guide: Option<f64>,
    /// Positions from one end of the range to the other.
    pub path: &'a [Pose],
    /// True if that is a whole turn.
    pub whole: bool,
}

/// A fixed pivot.
pub struct Pivot {
    /// Its name.
    pub label: String,
    /// Where it is.
    pub at: Point,
    /// The joint at the other end of its only link.
    pub joint: Option<usize>,
}

/// A moving joint.
pub struct Joint {
    /// Its name.
    pub label: String,
    /// Its colour.
    pub colour: &'static str,
    /// Returns true if its path is dashed.
    pub dashed: bool,
}

impl Joint {
    /// A joint of that number, whose path is a full line.
    pub fn new(label: &str, number: usize) -> Joint {
        Joint {
            label: label.into(),
            colour: PATHS[number % PATHS.len()],
            dashed: false,
        }
    }

    /// The end of a crank, whose path is a circle and dashed.
    pub fn crank(label: &str, colour: &'static str) -> Joint {
        Joint {
            colour,
            dashed: true,
            ..Joint::new(label, 0)
        }
    }
}

/// A position.
#[derive(Clone)]
pub struct Pose {
    /// The drive in the scene's unit.
    pub drive: f64,
    /// The moving joints; on a guide the last one is a slider.
    pub joints: Vec<Point>,
    /// Links of two joints each.
    pub bars: Vec<Bar>,
    /// Links of three joints or more, with their numbers.
    pub plates: Vec<(&'static str, Vec<Point>)>,
    /// Bodies of one point.
    pub blocks: Vec<Point>,
}

/// A link between two joints.
#[derive(Clone)]
pub struct Bar {
    /// Its number, or nothing.
    pub label: &'static str,
    /// Its ends.
    pub ends: [Point; 2],
}

/// A coordinate to a tenth.
fn tenths(x: f64) -> String {
    format!("{x:.1}")
}

impl Scene<'_> {
    /// The drawing.
    pub fn draw(&self) -> String {
        let joints = self.path.iter().flat_map(|p| &p.joints);
        let pivots = self.pivots.iter().map(|p| p.at);
        let view = View::new(pivots.chain(joints.copied()));
        let chosen = self.chosen();
        let (legend, height) = (self.legend(&chosen), format!("{:.0}", view.height));
        let svg = html! {
            svg xmlns="http://www.w3.org/2000/svg" viewBox={ "0 0 " (WIDTH) " " (height) }
                width=(WIDTH) height=(height) font-family="sans-serif" font-size="16" { "\n"
                (head(self.name, &legend))
                rect width="100%" height="100%" fill=(PAPER) {} "\n"
                text x="24" y="36" font-size="22" font-weight="600" fill=(INK) {
                    (legible(self.name))
                } "\n"
                text x="24" y="60" font-size="15" fill=(SOFT) { (legend) } "\n"
                @for pivot in self.pivots { (ground(&view, pivot, self.hangs(pivot))) }
                @if let Some(angle) = self.guide { (self.guide(&view, angle)) }
                @for pose in chosen.iter().skip(1) { (self.links(&view, pose, false)) }
                @for (i, joint) in self.joints.iter().enumerate() {
                    @let points: Vec<Point> = self.path.iter().map(|p| p.joints[i]).collect();
                    polyline points=(view.line(points.iter().copied())) fill="none" stroke=(joint.colour)
                        stroke-width="2" stroke-dasharray=[joint.dashed.then_some("3 4")] {} "\n"
                }
                @if let Some(first) = chosen.first() {
                    (self.links(&view, first, true))
                    @for pivot in self.pivots { (circle(&view, pivot.at, INK, 1.6)) }
                    @for (k, (p, joint)) in first.joints.iter().zip(self.joints).enumerate() {
                        // The slider's letter clears its block.
                        @let slider = self.guide.is_some() && k + 1 == self.joints.len();
                        @let lift = if slider { SLIDER[1] + 16.0 } else { 10.0 };
                        @let (x, y) = view.at(*p);
                        (circle(&view, *p, joint.colour, 3.0))
                        (text(&joint.label, (x + 11.0, y - lift), "start", joint.colour))
                    }
                }
            } "\n"
        };
        svg.into_string()
    }

    /// The position drawn in full and those drawn faintly: eighths of a turn, the start first; or
    /// of a range, the middle first.
    fn chosen(&self) -> Vec<&Pose> {
        let n = self.path.len();
        let order: &[usize] = match self.whole {
            true => &[0, 1, 2, 3, 4, 5, 6, 7],
            false => &[4, 0, 2, 6, 8],
        };
        match n {
            0..8 => self.path.iter().collect(),
            _ => order.iter().map(|k| &self.path[k * (n - 1) / 8]).collect(),
        }
    }

    fn legend(&self, chosen: &[&Pose]) -> String {
        let [at, unit, eighth] = self.drive;
        let drives = || chosen.iter().map(|p| p.drive);
        let others = match self.whole {
            true => format!("every {eighth} faint"),
            false => {
                let low = drives().fold(f64::INFINITY, f64::min);
                let high = drives().fold(f64::NEG_INFINITY, f64::max);
                format!("from {low:.2}{unit} to {high:.2}{unit} faint")
            }
        };
        let first = drives().next().unwrap_or(f64::NAN);
        let label = |j: &Joint| format!("{}{}", j.label, if j.dashed { " (dashed)" } else { "" });
        let labels: Vec<String> = self.joints.iter().map(label).collect();
        let labels = labels.join(", ");
        legible(&format!(
            "{at} {first:.3}{unit}, {others}; paths of {labels}"
        ))
    }

    /// Returns true if the link at the pivot stays below it.
    fn hangs(&self, pivot: &Pivot) -> bool {
        let below = |joint: usize| self.path.iter().all(|p| p.joints[joint][1] < pivot.at[1]);
        pivot.joint.is_some_and(below)
    }

    fn links(&self, view: &View, pose: &Pose, lead: bool) -> Markup {
        let (opacity, width) = if lead { ("1", "4") } else { ("0.16", "2") };
        let slider = self.guide.zip(pose.joints.last());
        html! {
            g stroke=(INK) stroke-width=(width) opacity=(opacity) stroke-linecap="round"
                stroke-linejoin="round" fill="none" { "\n"
                @for bar in &pose.bars { polyline points=(view.line(bar.ends.into_iter())) {} "\n" }
                @for (_, corners) in &pose.plates {
                    polygon points=(view.line(outline(corners).into_iter())) fill=(INK) fill-opacity="0.12" {} "\n"
                }
                @for (x, y) in pose.blocks.iter().map(|p| view.at(*p)) {
                    rect x=(tenths(x - 14.0)) y=(tenths(y - 9.0)) width="28" height="18" {} "\n"
                }
                @if let Some((angle, p)) = slider {
                    @let (x, y) = view.at(*p);
                    rect x=(tenths(x - SLIDER[0])) y=(tenths(y - SLIDER[1])) width=(2.0 * SLIDER[0])
                        height=(2.0 * SLIDER[1]) fill=(INK) fill-opacity="0.12"
                        transform=(format!("rotate({:.3} {x:.1} {y:.1})", -angle.to_degrees())) {}
                    "\n"
                }
            } "\n"
            @if lead {
                @for bar in pose.bars.iter().filter(|b| !b.label.is_empty()) { (number(view, bar)) }
                @for (label, corners) in pose.plates.iter().filter(|p| !p.0.is_empty()) {
                    @let sum = |i: usize| corners.iter().map(|p| p[i]).sum::<f64>();
                    @let (x, y) = view.at([0, 1].map(|i| sum(i) / corners.len() as f64));
                    (text(label, (x, y + 5.0), "middle", SOFT))
                }
            }
        }
    }

    /// The guide's line as far as the slider goes, and a little farther.
    fn guide(&self, view: &View, angle: f64) -> Markup {
        let (sin, cos) = angle.sin_cos();
        let places = || self.path.iter().filter_map(|p| p.joints.last());
        let along = |p: &&Point| p[0] * cos + p[1] * sin;
        let first = places().min_by(|p, q| along(p).total_cmp(&along(q)));
        let last = places().max_by(|p, q| along(p).total_cmp(&along(q)));
        let (dx, dy) = (40.0 * cos, -40.0 * sin);
        html! {
            @if let Some((first, last)) = first.zip(last) {
                @let ((x0, y0), (x1, y1)) = (view.at(*first), view.at(*last));
                path d=(format!("M{:.1} {:.1}L{:.1} {:.1}", x0 - dx, y0 - dy, x1 + dx, y1 + dy))
                    stroke=(INK) stroke-width="1.1" stroke-dasharray="12 4 2 4" {} "\n"
            }
        }
    }
}

/// The outline of a plate; a triangle has all of its corners on it.
fn outline(corners: &[Point]) -> Vec<Point> {
    match corners.len() {
        0..=3 => corners.to_vec(),
        _ => hull(corners).into_iter().map(|k| corners[k]).collect(),
    }
}

/// A link's number beside its middle.
fn number(view: &View, bar: &Bar) -> Markup {
    let [q, p] = bar.ends;
    let (x, y) = view.at([0, 1].map(|i| 0.5 * (p[i] + q[i])));
    let ((px, py), (qx, qy)) = (view.at(p), view.at(q));
    let length = (px - qx).hypot(py - qy).max(1e-9);
    // On the upper side.
    let up = if px > qx { -1.0 } else { 1.0 };
    let (nx, ny) = (-up * (py - qy) / length, up * (px - qx) / length);
    text(
        bar.label,
        (x + 15.0 * nx, y + 15.0 * ny + 5.0),
        "middle",
        SOFT,
    )
}

fn text(text: &str, (x, y): (f64, f64), anchor: &str, colour: &str) -> Markup {
    // A white edge keeps labels readable on lines.
    html! {
        text x=(tenths(x)) y=(tenths(y)) text-anchor=(anchor) fill=(colour) stroke=(PAPER)
            stroke-width="4" paint-order="stroke" stroke-linejoin="round" { (legible(text)) } "\n"
    }
}

/// Hatched ground under a fixed pivot, above it where the link hangs.
fn ground(view: &View, pivot: &Pivot, above: bool) -> Markup {
    let (x, y) = view.at(pivot.at);
    let flip = if above { -1.0 } else { 1.0 };
    let base = y + 22.0 * flip;
    let triangle = format!("M{x:.1} {y:.1}L{:.1} {base:.1}h26z", x - 13.0);
    html! {
        g stroke=(INK) stroke-width="1.6" { "\n"
            path d=(triangle) fill=(PAPER) {} "\n"
            path d=(format!("M{:.1} {base:.1}h44", x - 22.0)) {} "\n"
            @for k in 0..6 {
                @let foot = x - 18.0 + 8.0 * f64::from(k);
                path d=(format!("M{foot:.1} {base:.1}l-7 {}", 8.0 * flip)) stroke-width="1.1" {} "\n"
            }
        } "\n"
        (text(&pivot.label, (x + 26.0, y + 17.0 * flip + 2.0), "start", INK))
    }
}

fn circle(view: &View, p: Point, colour: &str, width: f64) -> Markup {
    let (x, y) = view.at(p);
    html! {
        circle cx=(tenths(x)) cy=(tenths(y)) r="6" fill=(PAPER) stroke=(colour)
            stroke-width=(width) {} "\n"
    }
}

#[cfg(test)]
pub(crate) mod tests;
