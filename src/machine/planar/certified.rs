//! Rows of a mechanism with certified digits, and the proof that no assembly mode is missing.

use super::Machine;
use crate::machine::first_bits;
use crate::reference::planar::{
    self as reference, Attachment, Body, Frame, Linkage, Mechanism, Position,
};
use crate::reference::{Ball, ComplexBall, Undecided};
use crate::solvers::planar::{Drive, GROUND, Joint, Point, State};
use rug::Rational;

/// Why a file has no certified digits.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NotExact {
    /// A joint that is no pin.
    #[error("joint {joint} is no pin: certified digits are for mechanisms of pins alone")]
    Joint {
        /// Its name.
        joint: String,
    },
    /// A drive by a displacement.
    #[error("the drive is a displacement: certified digits are for mechanisms driven by an angle")]
    Drive,
    /// A point that is no fraction of a metre.
    #[error(
        "a point of body {body} is given by sides, which make it a square root: give it by points or drawn for certified digits"
    )]
    Point {
        /// The body's name.
        body: String,
    },
    /// What the reference does not take.
    #[error(transparent)]
    Mechanism(#[from] reference::MechanismError),
}

/// Precisions tried, each twice the one before.
const RAISED: u32 = 4;
/// How near the solver's angles a position has to be.
const REACH: f64 = 1e-3;

/// Encloses rows of a mechanism.
pub struct Certifier<'a> {
    machine: &'a Machine,
    mechanism: Mechanism,
    drive: reference::Drive,
    /// The driven body, and the one that its angle is measured from.
    driven: [usize; 2],
    /// For each body the vector of the line that its angle is that of.
    lines: Vec<Option<[Rational; 2]>>,
    points: Vec<Attachment>,
    digits: usize,
    bits: u32,
}

impl<'a> Certifier<'a> {
    /// For so many significant digits of every value.
    ///
    /// # Errors
    /// [`NotExact`].
    pub fn new(machine: &'a Machine, digits: u32) -> Result<Certifier<'a>, NotExact> {
        let description = machine.solver.description();
        let Drive::Angle { body, from } = description.drive else {
            return Err(NotExact::Drive);
        };
        let mut joints = Vec::new();
        for joint in &description.joints {
            let Joint::Pin { points } = &joint.part else {
                let joint = joint.name.clone();
                return Err(NotExact::Joint { joint });
            };
            for b in &points[1..] {
                joints.push(reference::Joint::Pin {
                    a: attached(machine, &points[0])?,
                    b: attached(machine, b)?,
                });
            }
        }
        let names = machine.bodies[1..].iter();
        let bodies = names.map(|name| Body::massless(name)).collect();
        let drive = match from {
            GROUND => reference::Drive::coordinate(body - 1),
            from => reference::Drive::relative(from - 1, body - 1),
        };
        let line = |k: usize| {
            let [a, b] = machine.exact.get(k)?.get(..2)? else {
                return None;
            };
            let ([px, py], [qx, qy]) = (a.1.as_ref()?, b.1.as_ref()?);
            Some([Rational::from(qx - px), Rational::from(qy - py)])
        };
        let of = |k: usize| line(k).filter(|_| machine.lines[k] != 0.0);
        let points = machine.points.iter().map(|(_, p)| attached(machine, p));
        Ok(Certifier {
            machine,
            mechanism: Mechanism::new(bodies, joints)?,
            drive,
            driven: [body, from],
            lines: (0..machine.bodies.len()).map(of).collect(),
            points: points.collect::<Result<_, _>>()?,
            digits: digits as usize,
            bits: first_bits(digits),
        })
    }

    /// The angle of a body's line in its frame.
    fn line(&self, body: usize, bits: u32) -> Ball {
        match &self.lines[body] {
            Some([x, y]) => ComplexBall::rational(bits, x, y).arg(),
            None => Ball::integer(bits, 0),
        }
    }

    /// The reference's drive for the user's in degrees, so many whole turns on.
    fn drive(&self, degrees: &Rational, turns: i64, bits: u32) -> Ball {
        let all = degrees + Rational::from(360 * turns);
        let angle = Ball::rational(bits, &(all / 180u32)) * Ball::pi(bits);
        angle - self.line(self.driven[0], bits) + self.line(self.driven[1], bits)
    }

    fn linkage(&self, bits: u32) -> Option<Linkage> {
        Linkage::new(&self.mechanism, &self.drive, bits).ok()
    }

    /// The values of a row next to a position of the solver, from the column after `branch` on, each with the digits
    /// asked for; `None` where they could not be proved.
    pub fn values(&self, degrees: &Rational, state: &State, paths: bool) -> Vec<Option<String>> {
        let mut known: Vec<Option<String>> = Vec::new();
        for k in 0..RAISED {
            let Some(values) = self.enclosed(degrees, state, paths, self.bits << k) else {
                continue;
            };
            let texts = values.iter().map(|x| x.to_decimal(self.digits));
            match known.is_empty() {
                true => known = texts.collect(),
                false => known
                    .iter_mut()
                    .zip(texts)
                    .for_each(|(k, text)| *k = k.take().or(text)),
            }
            if known.iter().all(Option::is_some) {
                break;
            }
        }
        known.resize(super::certified_names(self.machine, paths).len() - 2, None);
        known
    }

    fn enclosed(
        &self,
        degrees: &Rational,
        state: &State,
        paths: bool,
        bits: u32,
    ) -> Option<Vec<Ball>> {
        let solver = &self.machine.solver;
        let angle = |b: usize| solver.body_angle(state, b).angle.rad();
        let near: Vec<f64> = (1..self.machine.bodies.len()).map(angle).collect();
        let [body, from] = self.driven.map(angle);
        let here = body - from;
        let due = self.drive(degrees, 0, 64).to_f64();
        let turns = ((here - due) / std::f64::consts::TAU).round() as i64;
        let linkage = self.linkage(bits)?;
        let drive = self.drive(degrees, turns, bits);
        let position = linkage.nearest(&drive, &near, REACH).ok()??;
        let series = linkage.series(&position, 2).ok()?;
        let degree = Ball::integer(bits, 180) / Ball::pi(bits);
        let mut all = Vec::new();
        for k in 0..near.len() {
            // The drive and its derivatives are what they are, exactly.
            if self.driven == [k + 1, GROUND] {
                let turns = (degrees.to_f64() / 360.0).round() as i64;
                let rest = degrees - Rational::from(360 * turns);
                all.push(Ball::rational(bits, &rest));
                all.extend([1, 0].map(|n| Ball::integer(bits, n)));
                continue;
            }
            let whole = &position.x[k] + &self.line(k + 1, bits);
            let turns = (whole.to_f64() / std::f64::consts::TAU).round() as i64;
            let turn = Ball::pi(bits).shift(1) * Ball::integer(bits, turns);
            all.push((whole - turn) * &degree);
            all.push(series.coefficient(k, 1).clone());
            all.push(series.coefficient(k, 2).shift(1));
        }
        for at in self.points.iter().filter(|_| paths) {
            let [p, v, a] = linkage.point_motion(&series, at);
            all.extend(p);
            for (v, a) in v.into_iter().zip(a) {
                all.extend([v, a]);
            }
        }
        Some(all)
    }

    /// How many assembly modes there are at the drive in degrees, proved to be all.
    ///
    /// # Errors
    /// [`Undecided`] where modes meet or nearly so, or the search takes too long.
    pub fn modes(&self, degrees: &Rational) -> Result<Vec<Position>, Undecided> {
        let undecided = || Undecided {
            bits: self.bits,
            reason: "no linkage".into(),
        };
        let linkage = self.linkage(self.bits).ok_or_else(undecided)?;
        linkage.modes(&self.drive(degrees, 0, self.bits))
    }
}

/// A point exactly.
fn attached(machine: &Machine, point: &Point) -> Result<Attachment, NotExact> {
    let inexact = || NotExact::Point {
        body: machine.bodies[point.body].clone(),
    };
    let same = machine.exact[point.body].iter().filter(|p| p.0 == *point);
    let mut places = same.map(|p| p.1.as_ref());
    let first = places.next().flatten().ok_or_else(inexact)?;
    // Two points that are one when rounded could be confused.
    if places.any(|other| other != Some(first)) {
        return Err(inexact());
    }
    let frame = match point.body {
        GROUND => Frame::Ground,
        body => Frame::Body(body - 1),
    };
    Ok(Attachment {
        frame,
        point: first.clone(),
    })
}

#[cfg(test)]
#[path = "certified_tests.rs"]
mod tests;
