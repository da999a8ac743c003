//! A branch in motion.

use super::Machine;
use crate::motion::{Drive, Motion, Point as Place, Wheel, hull};
use crate::solvers::planar::{GROUND, Guide, Joint, Point, State};
use std::f64::consts::TAU;

/// Positions with the user's drive in radians or metres.
type Positions = [(f64, State)];

/// The mechanism at these positions, without quantities; `closed` if the first follows the last.
pub fn motion(machine: &Machine, positions: &Positions, start: usize, closed: bool) -> Motion {
    let shown = |drive: f64| match machine.rotary() {
        true => drive.to_degrees(),
        false => drive,
    };
    let (symbol, unit) = match machine.rotary() {
        true => ("φ", "°"),
        false => ("s", "m"),
    };
    let mut scene = Scene {
        machine,
        positions,
        motion: Motion {
            name: machine.name.clone().unwrap_or_else(|| "mechanism".into()),
            drive: Drive {
                symbol,
                unit,
                values: positions.iter().map(|p| shown(p.0)).collect(),
            },
            closed,
            start,
            points: Vec::new(),
            links: Vec::new(),
            plates: Vec::new(),
            guides: Vec::new(),
            wheels: Vec::new(),
            courses: Vec::new(),
        },
    };
    scene.named_points();
    scene.bodies();
    scene.wheels();
    scene.slides();
    scene.motion
}

struct Scene<'a> {
    machine: &'a Machine,
    positions: &'a Positions,
    motion: Motion,
}

impl Scene<'_> {
    fn joints(&self) -> impl Iterator<Item = &Joint> {
        self.machine
            .solver
            .description()
            .joints
            .iter()
            .map(|j| &j.part)
    }

    /// Where a point is at each position; once if it is on the ground.
    fn path(&self, point: &Point) -> Vec<[f64; 2]> {
        match point.body {
            GROUND => vec![point.at.map(|x| x.m())],
            _ => {
                let at = |(_, state): &(f64, State)| self.machine.solver.point(state, point).r;
                self.positions.iter().map(at).collect()
            }
        }
    }

    fn pinned(&self, point: &Point) -> bool {
        self.joints()
            .any(|j| matches!(j, Joint::Pin { points } if points.contains(point)))
    }

    fn named_points(&mut self) {
        for (name, point) in &self.machine.outlines[GROUND] {
            let pivot = self.pinned(point);
            let path = self.path(point);
            let label = name.clone();
            self.motion.add(Place { label, pivot, path });
        }
        for (name, point) in &self.machine.points {
            let path = self.path(point);
            self.motion.add(Place::moving(name.clone(), path));
        }
    }

    /// The index of a body's point: that of its name where it stays in that place.
    fn index(&mut self, name: &str, point: &Point) -> usize {
        let path = self.path(point);
        let near = 1e-9 * self.motion.size();
        let same = |p: &Place| {
            let apart = |(k, q): (usize, &[f64; 2])| {
                let at = p.at(k);
                (at[0] - q[0]).hypot(at[1] - q[1])
            };
            p.label == name && path.iter().enumerate().all(|q| apart(q) <= near)
        };
        match self.motion.points.iter().position(same) {
            Some(k) => k,
            None => self.motion.add(Place::moving("", path)),
        }
    }

    fn bodies(&mut self) {
        for outline in &self.machine.outlines[1..] {
            let places: Vec<[f64; 2]> = outline.iter().map(|(_, p)| p.at.map(|x| x.m())).collect();
            let indices: Vec<usize> = outline.iter().map(|(n, p)| self.index(n, p)).collect();
            match hull(&places)[..] {
                [] | [_] => {}
                [a, b] => self.motion.links.push([indices[a], indices[b]]),
                ref corners => {
                    let plate = corners.iter().map(|k| indices[*k]).collect();
                    self.motion.plates.push(plate);
                }
            }
        }
    }

    /// A body's point that a pin holds on the carrier, or on any body.
    fn centre(&self, wheel: usize, carrier: Option<usize>) -> Option<Point> {
        let holds = |points: &[Point]| {
            let of = |b: usize| points.iter().find(|p| p.body == b).copied();
            of(wheel).filter(|_| carrier.is_none_or(|c| of(c).is_some()))
        };
        self.joints().find_map(|j| match j {
            Joint::Pin { points } => holds(points),
            _ => None,
        })
    }

    /// Pitch circles, with a spoke where nothing else shows that the wheel turns.
    fn wheels(&mut self) {
        let mut found: Vec<(Point, f64)> = Vec::new();
        for joint in self.joints() {
            match joint {
                Joint::Gears {
                    wheels,
                    carrier,
                    ratio,
                    ..
                } => {
                    let [a, b] = wheels.map(|w| self.centre(w, Some(*carrier)));
                    let (Some(a), Some(b)) = (a, b) else { continue };
                    let Some((_, first)) = self.positions.first() else {
                        continue;
                    };
                    let [p, q] = [a, b].map(|c| self.machine.solver.point(first, &c).r);
                    let second = (p[0] - q[0]).hypot(p[1] - q[1]) / (1.0 - ratio).abs();
                    found.extend([(a, second * ratio.abs()), (b, second)]);
                }
                Joint::Rack { wheel, radius, .. } => {
                    let centre = self.centre(*wheel, None);
                    found.extend(centre.map(|c| (c, radius.m().abs())));
                }
                _ => {}
            }
        }
        for (k, (centre, radius)) in found.iter().enumerate() {
            let same =
                |(c, r): &(Point, f64)| c.body == centre.body && (r - radius).abs() < 1e-9 * radius;
            if found[..k].iter().any(same) || !radius.is_finite() {
                continue;
            }
            let path = self.path(centre);
            let hub = self.motion.add(Place::moving("", path));
            self.motion.wheels.push(Wheel {
                centre: hub,
                radius: *radius,
            });
            if self.machine.outlines[centre.body].len() < 2 {
                let [x, y] = centre.at.map(|x| x.m());
                let rim = self.path(&Point::from_m(centre.body, [x + radius, y]));
                let rim = self.motion.add(Place::moving("", rim));
                self.motion.links.push([hub, rim]);
            }
        }
    }

    /// Guides as far as something slides on them, and blocks on them.
    fn slides(&mut self) {
        let of = |joint: &Joint| match joint {
            Joint::Slide {
                slider: pin, guide, ..
            }
            | Joint::Slot { pin, slot: guide } => Some((*pin, *guide)),
            _ => None,
        };
        let all: Vec<(Point, Guide)> = self.joints().filter_map(of).collect();
        for (pin, guide) in all {
            let solver = &self.machine.solver;
            let at = |(_, state): &(f64, State)| {
                let turn = solver.body_angle(state, guide.origin.body).angle.rad();
                (
                    solver.point(state, &pin).r,
                    (turn + guide.direction.rad()) % TAU,
                )
            };
            let along: Vec<([f64; 2], f64)> = self.positions.iter().map(at).collect();
            match guide.origin.body {
                GROUND => self.motion.add_guide(&along),
                body => {
                    let s =
                        |(_, state): &(f64, State)| solver.displacement(state, &pin, &guide).s_m;
                    let travels = || self.positions.iter().map(s);
                    let slack = 0.05 * self.motion.size();
                    let low = travels().fold(f64::INFINITY, f64::min) - slack;
                    let high = travels().fold(f64::NEG_INFINITY, f64::max) + slack;
                    let [x, y] = guide.origin.at.map(|x| x.m());
                    let (sin, cos) = guide.direction.rad().sin_cos();
                    let ends = [low, high].map(|s| Point::from_m(body, [x + s * cos, y + s * sin]));
                    let ends = ends
                        .map(|p| self.path(&p))
                        .map(|path| self.motion.add(Place::moving("", path)));
                    self.motion.guides.push(ends);
                }
            }
            self.motion.add_block(&along);
        }
    }
}

#[cfg(test)]
mod tests;
