//! Bodies with their points.

use super::file::{Body, File, Place};
use crate::machine::source::{Refusal, Source};
use crate::reference::nearest_f64;
use crate::reference::planar::{self as reference, Real};
use crate::solvers::planar::{GROUND, Point};
use rug::Rational;

/// All bodies, the ground first.
pub(super) struct Bodies {
    pub names: Vec<String>,
    /// Points of each body in metres.
    points: Vec<Vec<(String, [f64; 2])>>,
    /// The same points exactly; `None` where sides make a triangle only when rounded.
    exact: Vec<Vec<Option<reference::Place>>>,
    /// The angle of each body's line in its frame.
    pub lines: Vec<f64>,
    /// True if a body is given by points of the drawing.
    pub drawn: Vec<bool>,
}

/// A point by fractions of a metre.
pub(super) type Exact = [Rational; 2];

/// Points of a body with their names, rounded and exact.
type Points = Vec<(String, [f64; 2], Option<reference::Place>)>;

/// A point by fractions among exact points.
fn fractions(p: Exact) -> Option<reference::Place> {
    Some(p.map(Real::from))
}

fn place([x, y]: &Place) -> [Rational; 2] {
    [x.value.clone(), y.value.clone()]
}

/// The number in floating point.
pub(super) fn nearest(x: &Real) -> f64 {
    match x.fraction() {
        Some(q) => nearest_f64(q),
        None => x.to_ball(128).to_f64(),
    }
}

fn rounded(p: &[Rational; 2]) -> [f64; 2] {
    [nearest_f64(&p[0]), nearest_f64(&p[1])]
}

/// Names in columns and messages.
pub(in crate::machine) fn check_name(source: &Source, at: &str, name: &str) -> Result<(), Refusal> {
    let good = |c: char| c.is_alphanumeric() || matches!(c, '_' | '-' | '\'');
    match !name.is_empty() && name.len() <= 40 && name.chars().all(good) {
        true => Ok(()),
        false => {
            let rule =
                format!("{at} = {name:?} must be a name: letters, digits, _, - and ', at most 40");
            Err(source.breach(at, rule))
        }
    }
}

impl Bodies {
    /// Bodies by names and exact points, the ground first, whose angles are those of their frames.
    pub(super) fn of(all: Vec<(String, Vec<(&str, reference::Place)>)>) -> Bodies {
        let count = all.len();
        let point = |(name, at): &(&str, reference::Place)| {
            ((*name).to_owned(), at.each_ref().map(nearest))
        };
        Bodies {
            points: all
                .iter()
                .map(|b| b.1.iter().map(point).collect())
                .collect(),
            lines: vec![0.0; count],
            drawn: vec![false; count],
            exact: all
                .iter()
                .map(|b| b.1.iter().map(|p| Some(p.1.clone())).collect())
                .collect(),
            names: all.into_iter().map(|b| b.0).collect(),
        }
    }

    pub(super) fn new(source: &Source, file: &File) -> Result<Bodies, Refusal> {
        let mut all = Bodies {
            names: vec!["ground".into()],
            points: vec![Vec::new()],
            exact: vec![Vec::new()],
            lines: vec![0.0],
            drawn: vec![true],
        };
        for (name, at) in &file.ground.points {
            check_name(source, "ground.points", name)?;
            all.points[GROUND].push((name.clone(), rounded(&place(at))));
            all.exact[GROUND].push(fractions(place(at)));
        }
        for name in &file.ground.drawn {
            let at = drawn(source, file, "ground.drawn", name)?;
            all.points[GROUND].push((name.clone(), rounded(&at)));
            all.exact[GROUND].push(fractions(at));
        }
        for (k, body) in file.body.iter().enumerate() {
            let at = format!("body[{k}]");
            check_name(source, &format!("{at}.name"), &body.name)?;
            if all.names.contains(&body.name) {
                let rule = format!("{at}.name = {:?} is taken", body.name);
                return Err(source.breach(&format!("{at}.name"), rule));
            }
            let points = points(source, file, body, &at)?;
            // The first point drawn is the origin.
            let line = match (&points[..], body.drawn.is_empty()) {
                ([_, (_, [x, y], _), ..], false) => y.atan2(*x),
                _ => 0.0,
            };
            all.names.push(body.name.clone());
            all.exact.push(points.iter().map(|p| p.2.clone()).collect());
            let rounded = points.into_iter().map(|(name, at, _)| (name, at));
            all.points.push(rounded.collect());
            all.lines.push(line);
            all.drawn.push(!body.drawn.is_empty());
        }
        for (b, points) in all.points.iter().enumerate() {
            for (k, (name, _)) in points.iter().enumerate() {
                if points[..k].iter().any(|p| p.0 == *name) {
                    let rule = format!("{} has the point {name:?} twice", all.names[b]);
                    let at = if b == GROUND {
                        "ground".into()
                    } else {
                        format!("body[{}]", b - 1)
                    };
                    return Err(source.breach(&at, rule));
                }
            }
        }
        Ok(all)
    }

    /// The number of a body.
    pub(super) fn find(&self, source: &Source, at: &str, name: &str) -> Result<usize, Refusal> {
        let found = self.names.iter().position(|n| n == name);
        found.ok_or_else(|| {
            let names: Vec<&str> = self.names.iter().map(String::as_str).collect();
            let meant = crate::audit::did_you_mean(name, &names);
            source.breach(at, format!("{at} = {name:?} is no body{meant}"))
        })
    }

    /// A point of a body.
    pub(super) fn on(&self, body: usize, name: &str) -> Option<Point> {
        let at = self.points[body].iter().find(|p| p.0 == name)?.1;
        Some(Point::from_m(body, at))
    }

    /// The points of this name on all bodies.
    pub(super) fn all(&self, name: &str) -> Vec<Point> {
        (0..self.names.len())
            .filter_map(|b| self.on(b, name))
            .collect()
    }

    /// `POINT` on any body that has it, or `BODY.POINT`.
    pub(super) fn point(&self, source: &Source, at: &str, text: &str) -> Result<Point, Refusal> {
        let found = match text.split_once('.') {
            Some((body, name)) => {
                let body = self.find(source, at, body)?;
                self.on(body, name)
            }
            None => self.all(text).into_iter().next(),
        };
        found.ok_or_else(|| source.breach(at, format!("{at} = {text:?} is no point of a body")))
    }

    /// The named points on moving bodies, each name once.
    pub(super) fn moving(&self) -> Vec<(String, Point)> {
        let mut all: Vec<(String, Point)> = Vec::new();
        for body in 1..self.names.len() {
            for (name, at) in &self.points[body] {
                let fixed = self.on(GROUND, name).is_some();
                if !fixed && !all.iter().any(|p| p.0 == *name) {
                    all.push((name.clone(), Point::from_m(body, *at)));
                }
            }
        }
        all.sort_by(|a, b| a.0.cmp(&b.0));
        all
    }

    /// The exact place of every point of a body.
    pub(super) fn exact(&self) -> Vec<Vec<(Point, Option<reference::Place>)>> {
        let of = |(b, points): (usize, &Vec<(String, [f64; 2])>)| {
            let pairs = points.iter().zip(&self.exact[b]);
            pairs
                .map(|((_, p), exact)| (Point::from_m(b, *p), exact.clone()))
                .collect()
        };
        self.points.iter().enumerate().map(of).collect()
    }

    /// The exact place of a point of a body.
    pub(super) fn place(&self, body: usize, name: &str) -> Option<&reference::Place> {
        let k = self.points[body].iter().position(|p| p.0 == name)?;
        self.exact[body][k].as_ref()
    }

    /// The points of every body.
    pub(super) fn outlines(&self) -> Vec<Vec<(String, Point)>> {
        let of = |(b, points): (usize, &Vec<(String, [f64; 2])>)| {
            points
                .iter()
                .map(|(n, p)| (n.clone(), Point::from_m(b, *p)))
                .collect()
        };
        self.points.iter().enumerate().map(of).collect()
    }
}

/// A point of the drawing.
fn drawn(source: &Source, file: &File, at: &str, name: &str) -> Result<[Rational; 2], Refusal> {
    check_name(source, at, name)?;
    match file.points.get(name) {
        Some(p) => Ok(place(p)),
        None => Err(source.breach(at, format!("{at}: {name:?} is not in [points]"))),
    }
}

fn points(source: &Source, file: &File, body: &Body, at: &str) -> Result<Points, Refusal> {
    let alone = body.ends.is_empty() && body.points.is_empty();
    if !(body.drawn.is_empty() || alone) {
        let rule = format!("{at}: drawn stands alone, without points and ends");
        return Err(source.breach(at, rule));
    }
    let mut all = Vec::new();
    if let Some(first) = body.drawn.first() {
        let origin = drawn(source, file, &format!("{at}.drawn"), first)?;
        for name in &body.drawn {
            let [x, y] = drawn(source, file, &format!("{at}.drawn"), name)?;
            let arm = [x - &origin[0], y - &origin[1]];
            all.push((name.clone(), rounded(&arm), fractions(arm)));
        }
    }
    let place_of = format!("{at}.ends");
    match (&body.ends[..], &body.length, &body.sides) {
        ([], None, None) => {}
        ([a, b], Some(l), None) => {
            check_name(source, &place_of, a)?;
            check_name(source, &place_of, b)?;
            let (l, exact) = (nearest_f64(&l.value), l.value.clone());
            if !(l > 0.0) {
                return Err(source.breach(
                    &format!("{at}.length"),
                    format!("{at}.length must be positive"),
                ));
            }
            let none = Rational::new;
            all.extend([
                (a.clone(), [0.0, 0.0], fractions([none(), none()])),
                (b.clone(), [l, 0.0], fractions([exact, none()])),
            ]);
        }
        ([a, b, c], None, Some(sides)) => {
            for name in [a, b, c] {
                check_name(source, &place_of, name)?;
            }
            let [ab, bc, ca] = sides.each_ref().map(|s| nearest_f64(&s.value));
            // Heron's square root of the four factors.
            let s = [ab + bc + ca, bc + ca - ab, ab + ca - bc, ab + bc - ca];
            if !s.iter().all(|x| *x >= 0.0) || !(ab > 0.0) {
                let rule = format!("{at}.sides: no triangle has these sides");
                return Err(source.breach(&format!("{at}.sides"), rule));
            }
            let height = 0.5 * (s[0] * s[1]).sqrt() * (s[2] * s[3]).sqrt() / ab;
            let x = 0.5 * (ab + (ca - bc) * (ca + bc) / ab);
            let y = if body.clockwise { -height } else { height };
            let none = Rational::new;
            let first = sides[0].value.clone();
            let third = third_point(sides.each_ref().map(|s| &s.value), body.clockwise);
            all.extend([
                (a.clone(), [0.0, 0.0], fractions([none(), none()])),
                (b.clone(), [ab, 0.0], fractions([first, none()])),
                (c.clone(), [x, y], third),
            ]);
        }
        _ => {
            let rule = format!("{at}: two ends with length, or three ends with sides");
            return Err(source.breach(at, rule));
        }
    }
    for (name, p) in &body.points {
        check_name(source, &format!("{at}.points"), name)?;
        all.push((name.clone(), rounded(&place(p)), fractions(place(p))));
    }
    if all.is_empty() {
        return Err(source.breach(at, format!("{at} has no points, ends or drawn")));
    }
    Ok(all)
}

/// The third point of a triangle with the first side on the x-axis:
/// `x = (AB² + CA² − BC²)/(2 AB)`, and the height `√(CA² − x²)`.
fn third_point([ab, bc, ca]: [&Rational; 3], clockwise: bool) -> Option<reference::Place> {
    let square = |x: &Rational| Rational::from(x.square_ref());
    let x = (square(ab) + square(ca) - square(bc)) / (ab.clone() * 2u32);
    let height = square(ca) - square(&x);
    let y = (height >= 0).then(|| Real::root(&height.into()))?;
    Some([x.into(), if clockwise { -y } else { y }])
}

#[cfg(test)]
mod tests;
