//! Planar linkages of pins.

use super::{Answer, hold};
use crate::planar::{BodyMass, Description, Drive, GROUND, Loads, Mechanism, Point, State};
use crate::units::{Inertia, Length, Mass};
use std::f64::consts::TAU;

/// The parts of an input of planar-linkage, and what follows them.
struct Input<'a> {
    bodies: usize,
    phi: f64,
    /// a, b, xa, ya, xb, yb of the pins.
    pins: Vec<&'a [f64]>,
    centres: [&'a [f64]; 2],
    near: &'a [f64],
    rest: &'a [f64],
}

fn parts(x: &[f64]) -> Input<'_> {
    let (bodies, pins) = (x[0] as usize, x[1] as usize);
    let (lists, rest) = x[3..].split_at(6 * pins);
    let (bodily, rest) = rest.split_at(3 * bodies);
    let of = |k: usize| &bodily[k * bodies..][..bodies];
    Input {
        bodies,
        phi: x[2],
        pins: lists.chunks(pins).collect(),
        centres: [of(0), of(1)],
        near: of(2),
        rest,
    }
}

impl Input<'_> {
    fn placed(&self) -> Result<(Mechanism, State), String> {
        let mut d = Description::new();
        for k in 1..=self.bodies {
            d.body(k.to_string());
        }
        for k in 0..self.pins[0].len() {
            let at = |n: usize| self.pins[n][k];
            let ends = [
                (at(0) as usize, [at(2), at(3)]),
                (at(1) as usize, [at(4), at(5)]),
            ];
            d.pin(k.to_string(), &ends);
        }
        d.drive = Drive::Angle {
            body: 1,
            from: GROUND,
        };
        let mechanism = Mechanism::new(d).map_err(|_| "structure")?;
        let off = |s: &State| {
            let of = |(k, near): (usize, &f64)| {
                let by = mechanism.body_angle(s, k + 1).angle.rad() - near;
                (by - TAU * (by / TAU).round()).abs()
            };
            self.near.iter().enumerate().map(of).fold(0.0, f64::max)
        };
        let modes = mechanism.assembly_modes(self.phi).states;
        let nearest = modes
            .into_iter()
            .min_by(|a, b| off(a).total_cmp(&off(b)))
            .filter(|s| off(s) <= 0.1)
            .ok_or("no position near")?;
        Ok((mechanism, nearest))
    }

    fn centre(&self, k: usize) -> [f64; 2] {
        self.centres.map(|c| c[k])
    }
}

#[test]
fn planar_linkage() {
    let direct = |x: &[f64]| -> Answer {
        let input = parts(x);
        let (mechanism, state) = input.placed()?;
        let mut all = Vec::new();
        for (k, near) in input.near.iter().enumerate() {
            let turn = mechanism.body_angle(&state, k + 1);
            let turns = ((near - turn.angle.rad()) / TAU).round();
            all.extend([turn.angle.rad() + turns * TAU, turn.first, turn.second]);
            let c = mechanism.point(&state, &Point::from_m(k + 1, input.centre(k)));
            all.extend([c.r, c.first, c.second].concat());
        }
        Ok(all)
    };
    hold("planar-linkage", &[("nearest mode", &direct)]);
}

/// Speed, acceleration, gravity, then the linkage, masses and inertias.
fn loaded(x: &[f64]) -> Result<(Mechanism, State, Loads), String> {
    let input = parts(&x[4..]);
    let (mechanism, state) = input.placed()?;
    let mass = |k: usize| BodyMass {
        body: k + 1,
        mass: Mass::from_kg(input.rest[k]),
        inertia: Inertia::from_kg_m2(input.rest[input.bodies + k]),
        centre: input.centre(k).map(Length::from_m),
    };
    let masses = (0..input.bodies).map(mass).collect();
    let loads = Loads::new(&mechanism, masses, Vec::new(), [x[2], x[3]]).expect("masses");
    Ok((mechanism, state, loads))
}

#[test]
fn planar_reduction_and_reactions() {
    let reduced = |x: &[f64]| -> Answer {
        let (mechanism, state, loads) = loaded(x)?;
        let r = loads.reduce(&mechanism, &state);
        Ok(vec![
            r.inertia,
            r.inertia_derivative,
            r.moment,
            r.moment_derivative,
            r.drive(x[0], x[1]),
        ])
    };
    hold("planar-reduction", &[("reduced", &reduced)]);
    let forces = |x: &[f64]| -> Answer {
        let (mechanism, state, loads) = loaded(x)?;
        let found = loads.reactions(&mechanism, &state, x[0], x[1]);
        let found = found.map_err(|e| e.to_string())?;
        Ok(found.joints.iter().flat_map(|j| j.force_n).collect())
    };
    hold("planar-reactions", &[("forces", &forces)]);
}
