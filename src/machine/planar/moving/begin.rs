//! The start of a motion as formulas and equations.

use super::super::exact::radians;
use super::equations::{State, Writer};
use super::laws::INNER;
use super::text::{add, angle, mul, rational, sub};
use crate::solvers::planar::dynamics::{Coordinate, Moment};
use rug::Rational;
use std::f64::consts::TAU;

impl Writer<'_> {
    /// The start: coordinates and rates that are given, and equations for the others.
    pub(super) fn start(&mut self, first: &Moment) {
        let moving = self.moving;
        let (n, bodies, travels) = (self.free.len(), self.bodies, moving.travels());
        let near = |i: usize| match i < bodies {
            true => {
                let [angle, rate, _] = moving.dynamics.angle(first, i + 1);
                [angle, rate]
            }
            false => moving.dynamics.displacement(first, travels[i - bodies].0),
        };
        let mut given: Vec<Option<[String; 2]>> = vec![None; n];
        let mut others: Vec<(usize, usize, String, String)> = Vec::new();
        for g in &moving.start.given {
            let i = moving.index(g.coordinate);
            let (from, lines) = match g.coordinate {
                Coordinate::Angle { body, from } => (from, sub(&self.line(from), &self.line(body))),
                Coordinate::Displacement { .. } => (0, "0".into()),
            };
            let value = add(&angle(&g.value), &lines);
            let speed = angle(&g.speed);
            match self.free.iter().position(|f| *f == i) {
                Some(k) if from == 0 && given[k].is_none() => given[k] = Some([value, speed]),
                _ => others.push((i, from, value, speed)),
            }
        }
        let mut texts: Vec<[String; 2]> = Vec::new();
        for (k, given) in given.into_iter().enumerate() {
            texts.push(given.unwrap_or_else(|| {
                let near = near(self.free[k]);
                [0, 1].map(|c| {
                    let name = format!("{INNER}start_{k}_{c}");
                    self.out.unknowns.push((name.clone(), near[c]));
                    name
                })
            }));
        }
        let places: Vec<String> = texts.iter().map(|t| t[0].clone()).collect();
        let rates: Vec<String> = texts.iter().map(|t| t[1].clone()).collect();
        let position = self.position(&places);
        for form in self.loops.closures.clone() {
            let point = self.point(&position, &form);
            let gradient = self.gradient(&position, &form);
            let velocity = self.velocity(&gradient, &rates);
            self.out.equations.extend(point);
            self.out.equations.extend(velocity);
        }
        for (i, from, value, speed) in others {
            let near_from = if from == 0 { 0.0 } else { near(from - 1)[0] };
            // The angle that is given counts no turns.
            let given = moving
                .start
                .given
                .iter()
                .find(|g| moving.index(g.coordinate) == i);
            let wanted = given.map_or(0.0, |g| radians(&g.value));
            let lines = if i < self.bodies {
                moving.lines[i + 1] - moving.lines[from]
            } else {
                0.0
            };
            let turns = match i < self.bodies {
                true => {
                    let off = near(i)[0] - near_from - (wanted - lines);
                    (off / TAU).round() as i64
                }
                false => 0,
            };
            let turned = mul(&rational(&Rational::from(2 * turns)), "pi");
            let of = |w: &Self, texts: &[String], constant: bool| {
                let own = w.by(i, texts, constant);
                match from {
                    0 => own,
                    from => sub(&own, &w.by(from - 1, texts, constant)),
                }
            };
            let place = sub(&of(self, &places, true), &add(&value, &turned));
            let rate = sub(&of(self, &rates, false), &speed);
            self.out.equations.extend([place, rate]);
        }
        for (q, [place, rate]) in self.q.iter().zip(texts) {
            for (name, start) in q.iter().zip([place, rate]) {
                self.out.states.push(State {
                    name: name.clone(),
                    start,
                    rate: String::new(),
                });
            }
        }
    }
}
