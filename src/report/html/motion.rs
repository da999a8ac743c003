//! A mechanism in motion beside its quantities: the drawing at one position, and the data that the
//! script moves it by.

use super::page::embedded;
use super::prose::prose;
use crate::motion::{Course, Motion, Point};
use crate::report::svg::view::View;
use maud::{Markup, html};
use serde::Serialize;

const WIDTH: f64 = 640.0;
const MARGIN: f64 = 60.0;
/// Courses drawn from the start; others when they are asked for.
const DRAWN: usize = 3;

fn view(motion: &Motion) -> View {
    View::framed(motion.extent(), [WIDTH, MARGIN, 0.0])
}

/// The place of a point in the drawing, to hundredths.
fn place(view: &View, p: [f64; 2]) -> [f64; 2] {
    let (x, y) = view.at(p);
    [x, y].map(|v| (v * 100.0).round() / 100.0)
}

fn text(view: &View, p: [f64; 2]) -> String {
    let [x, y] = place(view, p);
    format!("{x},{y}")
}

#[derive(Serialize)]
struct Data<'a> {
    symbol: &'a str,
    unit: &'a str,
    drive: Vec<f64>,
    closed: bool,
    /// x and y in turn, in the drawing: one place, or one for each position.
    points: Vec<Vec<f64>>,
    courses: Vec<Row<'a>>,
}

/// A course for the script.
#[derive(Serialize)]
struct Row<'a> {
    name: &'a str,
    unit: &'a str,
    variants: Vec<Vec<Option<f64>>>,
    printed: &'a [(f64, f64)],
    /// Positions before which an angle jumps by a turn.
    breaks: Vec<usize>,
    /// The range of the chart.
    range: [f64; 2],
    drawn: bool,
}

/// Rounds `x` to `n` significant digits.
fn digits(x: f64, n: usize) -> f64 {
    format!("{x:.*e}", n - 1).parse().unwrap_or(x)
}

/// All values, or the bulk of them where a few at the ends of a branch dwarf it.
fn range(course: &Course) -> [f64; 2] {
    let values = course.variants.iter().flat_map(|v| &v.1).copied();
    let printed = course.printed.iter().map(|p| p.1);
    let mut all: Vec<f64> = values.chain(printed).filter(|x| x.is_finite()).collect();
    all.sort_by(f64::total_cmp);
    let (Some(&low), Some(&high)) = (all.first(), all.last()) else {
        return [0.0, 1.0];
    };
    let inner = all.len() / 40;
    let (a, b) = (all[inner], all[all.len() - 1 - inner]);
    let (low, high) = match high - low > 5.0 * (b - a) && b > a {
        true => (low.max(a - (b - a)), high.min(b + (b - a))),
        false => (low, high),
    };
    // A course that is constant but for rounding is a straight line.
    let least = 1e-9 * high.abs();
    match high - low > least {
        true => [low, high],
        false => [
            low - low.abs().max(1.0) * 0.5,
            high + high.abs().max(1.0) * 0.5,
        ],
    }
}

fn row(course: &Course, drawn: bool) -> Row<'_> {
    let six = |x: &f64| x.is_finite().then(|| digits(*x, 6));
    let first = course.variants.first().map_or(&[][..], |v| &v.1);
    let jump = |w: &[f64]| course.unit == "°" && (w[1] - w[0]).abs() > 180.0;
    let pairs = first.windows(2).enumerate();
    Row {
        name: &course.name,
        unit: &course.unit,
        variants: course
            .variants
            .iter()
            .map(|v| v.1.iter().map(six).collect())
            .collect(),
        printed: &course.printed,
        breaks: pairs.filter(|(_, w)| jump(w)).map(|(k, _)| k + 1).collect(),
        range: range(course),
        drawn,
    }
}

/// Reduced quantities are what most look for; without them those of the first body that is not
/// driven itself.
fn drawn(motion: &Motion) -> Vec<bool> {
    let reduced =
        |c: &Course| ["I_n", "dI_n_dphi", "M_o", "m_n", "dm_n_ds", "F_o"].contains(&&*c.name);
    let any = motion.courses.iter().any(reduced);
    let own = motion.courses.iter().take(1).any(|c| is_drive(motion, c));
    let first = if own { DRAWN } else { 0 };
    let chosen = motion.courses.iter().enumerate();
    let among = |k: usize| (first..first + DRAWN).contains(&k);
    chosen
        .map(|(k, c)| if any { reduced(c) } else { among(k) })
        .collect()
}

/// Returns true if an angle is the drive, but for whole turns.
fn is_drive(motion: &Motion, course: &Course) -> bool {
    let values = course.variants[0].1.iter().zip(&motion.drive.values);
    course.unit == "°"
        && values
            .map(|(v, d)| (v - d) / 360.0)
            .all(|t| (t - t.round()).abs() < 1e-9)
}

/// The data of the script.
pub fn data(motion: &Motion) -> String {
    let view = view(motion);
    let flat = |p: &Point| p.path.iter().flat_map(|q| place(&view, *q)).collect();
    let all = motion.courses.len() <= DRAWN;
    let drawn = drawn(motion);
    let courses = motion.courses.iter().zip(&drawn);
    embedded(&Data {
        symbol: motion.drive.symbol,
        unit: motion.drive.unit,
        drive: motion.drive.values.iter().map(|v| digits(*v, 9)).collect(),
        closed: motion.closed,
        points: motion.points.iter().map(flat).collect(),
        courses: courses.map(|(c, drawn)| row(c, all || *drawn)).collect(),
    })
}

/// The section of the page: what the positions are, the drawing, the values, their charts.
pub fn section(motion: &Motion, about: &Markup) -> Markup {
    let last = motion.drive.values.len().saturating_sub(1);
    let choice = motion.courses.len() > DRAWN;
    let drawn = drawn(motion);
    html! {
        section { "\n"
            h2 #motion { (motion.name) " in motion" } "\n"
            p.soft { (about) } "\n"
            div.motion { "\n"
                div.run.js {
                    button #play type="button" aria-pressed="false" { "Play" }
                    label for="drive" { (motion.drive.symbol) }
                    input #drive type="range" min="0" max=(last) step="1" value=(motion.start);
                    output #drive-value for="drive" {}
                } "\n"
                @if !motion.points.is_empty() { figure { (drawing(motion))
                    figcaption {
                        (motion.drive.symbol) " = "
                        span #drawn-at { (format!("{:.3}", motion.drive.values[motion.start])) (motion.drive.unit) }
                        ". Thin: paths of the joints"
                        @if fixed(motion).any(|p| p.pivot) { "; hatched: fixed pivots" }
                        @if !motion.guides.is_empty() { "; dash-dotted: guides" }
                        @if !motion.wheels.is_empty() { "; circles: pitch circles" }
                        "."
                    }
                } } "\n"
                div.beside {
                    @if choice { p.soft.small.js { "Choose what is drawn over the drive." } "\n" }
                    dl.now.js { "\n"
                        @for (i, c) in motion.courses.iter().enumerate() {
                            div {
                                dt {
                                    @if choice {
                                        button type="button" aria-pressed=(drawn[i]) data-course=(i) { (prose(&c.name)) }
                                    } @else { (prose(&c.name)) }
                                }
                                dd id={ "now-" (i) } {}
                            } "\n"
                        }
                    } "\n"
                    div #courses {} "\n"
                } "\n"
            } "\n"
        } "\n"
    }
}

/// Points of the ground that have a name.
fn fixed(motion: &Motion) -> impl Iterator<Item = &Point> {
    motion
        .points
        .iter()
        .filter(|p| p.path.len() == 1 && !p.label.is_empty())
}

/// At the first position.
fn drawing(motion: &Motion) -> Markup {
    let view = view(motion);
    let first = |p: &usize| text(&view, motion.points[*p].at(motion.start));
    let corners = |points: &[usize]| points.iter().map(first).collect::<Vec<_>>().join(" ");
    let indices = |points: &[usize]| {
        points
            .iter()
            .map(usize::to_string)
            .collect::<Vec<_>>()
            .join(" ")
    };
    let all = || motion.points.iter().enumerate();
    let joints: Vec<(usize, &Point)> = all().filter(|p| p.1.is_traced()).collect();
    let colour = |k: usize| format!("c{}", k % 5);
    let place = |p: &Point| {
        format!(
            "translate({})",
            text(&view, p.at(motion.start)).replace(',', " ")
        )
    };
    html! {
        svg #mechanism viewBox={ "0 0 " (WIDTH) " " (format!("{:.0}", view.height)) } role="img"
            aria-label={ (motion.name) " at the slider's position" } { "\n"
            @for guide in &motion.guides {
                polyline.guide data-points=(indices(guide)) points=(corners(guide)) {} "\n"
            }
            @for (k, (_, p)) in joints.iter().enumerate() {
                @let path: Vec<String> = p.path.iter().map(|q| text(&view, *q)).collect();
                @let class = format!("trace {}", colour(k));
                @if motion.closed { polygon.(class) points=(path.join(" ")) {} }
                @else { polyline.(class) points=(path.join(" ")) {} }
                "\n"
            }
            @for p in fixed(motion) {
                g transform=(place(p)) {
                    @if p.pivot {
                        path.ground d="M0 0L-11 18H11ZM-18 18H18M-14 18l-5 7M-5 18l-5 7M4 18l-5 7M13 18l-5 7" {}
                        text x="24" y="20" { (p.label) }
                    } @else {
                        circle.spot r="3" {}
                        text x="8" y="16" { (p.label) }
                    }
                } "\n"
            }
            @for wheel in &motion.wheels {
                circle.wheel data-at=(wheel.centre) r=(format!("{:.2}", wheel.radius * view.scale))
                    transform=(place(&motion.points[wheel.centre])) {} "\n"
            }
            @for plate in &motion.plates {
                polygon.plate data-points=(indices(plate)) points=(corners(plate)) {} "\n"
            }
            @for link in &motion.links {
                polyline.link data-points=(indices(link)) points=(corners(link)) {} "\n"
            }
            @for (k, (i, p)) in joints.iter().enumerate() {
                g data-at=(i) transform=(place(p)) {
                    circle.{ "joint " (colour(k)) } r="6" {}
                    text x="10" y="-9" { (p.label) }
                } "\n"
            }
        }
    }
}

#[cfg(test)]
mod tests;
