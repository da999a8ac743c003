//! A mechanism in motion beside its reduced quantities: the drawing at the first position, and the
//! data that the script moves it by.

use super::page::embedded;
use crate::papers::motion::Motion;
use crate::report::words::numbers::short;
use maud::{Markup, html};
use serde::Serialize;

const WIDTH: f64 = 640.0;
const MARGIN: f64 = 60.0;

/// From metres, y up, to the drawing, y down.
#[derive(Clone, Copy, Serialize)]
struct View {
    scale: f64,
    left: f64,
    top: f64,
    #[serde(skip)]
    height: f64,
}

impl View {
    fn of(motion: &Motion) -> View {
        let [x, y] = motion.extent();
        let size = [x[1] - x[0], y[1] - y[0]];
        let scale = (WIDTH - 2.0 * MARGIN) / size[0].max(size[1]).max(f64::MIN_POSITIVE);
        let slack = 0.5 * (WIDTH - 2.0 * MARGIN - size[0] * scale);
        View {
            scale,
            left: MARGIN + slack - x[0] * scale,
            top: MARGIN + y[1] * scale,
            height: size[1] * scale + 2.0 * MARGIN,
        }
    }

    fn at(&self, [x, y]: [f64; 2]) -> String {
        let (x, y) = (self.left + x * self.scale, self.top - y * self.scale);
        format!("{x:.2},{y:.2}")
    }
}

#[derive(Serialize)]
struct Data<'a> {
    view: View,
    #[serde(flatten)]
    motion: &'a Motion,
}

/// What the script reads.
pub fn data(motion: &Motion) -> String {
    let view = View::of(motion);
    embedded(&Data { view, motion })
}

/// The section of the page.
pub fn section(motion: &Motion) -> Markup {
    let steps = motion.crank_deg.len();
    let step = motion.crank_deg.get(1).zip(motion.crank_deg.first());
    let variants = motion.courses.first().map(|c| &c.variants[..]);
    html! {
        section { "\n"
            h2 #motion { (motion.name) " in motion" } "\n"
            p.soft {
                (steps) " positions of one turn by the f64 solver"
                @if let Some((b, a)) = step { ", one every " (short(b - a)) "°" } ". "
                @for (k, (name, _)) in variants.unwrap_or_default().iter().enumerate() {
                    (if k == 0 { "Solid: centres of mass " } else { "; dashed: " }) (name)
                }
                ". Rings: values printed in the paper's tables."
            } "\n"
            div.motion { "\n"
                div.run.js {
                    button #play type="button" aria-pressed="false" { "Play" }
                    label for="phi1" { "φ1" }
                    input #phi1 type="range" min="0" max=(steps.saturating_sub(1)) step="1" value="0";
                    output #phi1-value for="phi1" {}
                } "\n"
                figure { (drawing(motion))
                    figcaption { "The paths of the joints; fixed pivots hatched." }
                    dl.now.js { "\n"
                        @for (i, c) in motion.courses.iter().enumerate() {
                            div { dt { (c.name) } dd id={ "now-" (i) } {} } "\n"
                        }
                    }
                } "\n"
                div.js #courses {} "\n"
            } "\n"
        } "\n"
    }
}

/// At the first position.
fn drawing(motion: &Motion) -> Markup {
    let view = View::of(motion);
    let first = |p: &usize| view.at(motion.points[*p].path[0]);
    let corners = |points: &[usize]| points.iter().map(first).collect::<Vec<_>>().join(" ");
    let colour = |label: &str| format!("c-{label}");
    let moving = || {
        motion
            .points
            .iter()
            .enumerate()
            .filter(|p| p.1.path.len() > 1)
    };
    let fixed = || motion.points.iter().filter(|p| p.path.len() == 1);
    let place = |p: &crate::papers::motion::Point| {
        let at = view.at(p.path[0]).replace(',', " ");
        format!("translate({at})")
    };
    html! {
        svg #mechanism viewBox={ "0 0 " (WIDTH) " " (format!("{:.0}", view.height)) } role="img"
            aria-label={ (motion.name) " at the crank angle of the slider" } { "\n"
            @for (_, p) in moving() {
                @let path: Vec<String> = p.path.iter().map(|q| view.at(*q)).collect();
                polygon.{ "trace " (colour(p.label)) } points=(path.join(" ")) {} "\n"
            }
            @for p in fixed() {
                g transform=(place(p)) {
                    path.ground d="M0 0L-11 18H11ZM-18 18H18M-14 18l-5 7M-5 18l-5 7M4 18l-5 7M13 18l-5 7" {}
                    text x="24" y="20" { (p.label) }
                } "\n"
            }
            @for (k, plate) in motion.plates.iter().enumerate() {
                polygon.plate data-plate=(k) points=(corners(plate)) {} "\n"
            }
            @for (k, link) in motion.links.iter().enumerate() {
                polyline.link data-link=(k) points=(corners(link)) {} "\n"
            }
            @for (k, p) in moving() {
                g data-joint=(k) transform=(place(p)) {
                    circle.{ "joint " (colour(p.label)) } r="6" {}
                    text x="10" y="-9" { (p.label) }
                } "\n"
            }
        }
    }
}
