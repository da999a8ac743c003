//! Rows of a mechanism with certified digits, and the proof that no assembly mode is missing.

use super::Machine;
use super::exact::{attached, reference_joints};
use super::rows::travels;
use crate::machine::first_bits;
use crate::reference::class_iii::ExactAngle;
use crate::reference::planar::{
    self as reference, Attachment, Body, Determined, ExactDrive, ExactRates, Linkage, Mechanism,
    Position, Real, Series, Special,
};
use crate::reference::{Ball, ComplexBall, Undecided};
use crate::solvers::planar::{Drive, GROUND, State};
use rug::Rational;
use std::f64::consts::TAU;

/// Why a file has no certified digits.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NotExact {
    /// A guide without an exact direction.
    #[error(
        "the guide of joint {joint} has no exact direction: its two points are one, or no triangle"
    )]
    Guide {
        /// The joint's name.
        joint: String,
    },
    /// Sides that make a triangle only when rounded.
    #[error("no triangle has exactly the sides of body {body}")]
    Sides {
        /// The body's name.
        body: String,
    },
    /// Two points that cannot be told apart.
    #[error("two points of body {body} differ, and are one when rounded to 64-bit numbers")]
    Point {
        /// The body's name.
        body: String,
    },
    /// The reference does not take the mechanism.
    #[error(transparent)]
    Mechanism(#[from] reference::MechanismError),
}

/// Precisions tried, each twice the one before.
const RAISED: u32 = 4;
/// How near the solver's coordinates a position has to be, in radians and metres.
const REACH: f64 = 1e-3;

/// Why a row of a singular position has no derivatives.
const SINGULAR: &str =
    "the position is singular, where branches meet or end: no derivatives are proved";

/// A certified row.
#[derive(Clone, Debug, PartialEq)]
pub struct CertifiedRow {
    /// From the column after `branch` on; `None` where no digits are proved.
    pub digits: Vec<Option<String>>,
    /// Why digits are missing, if any are.
    pub reason: Option<String>,
}

/// Encloses rows of a mechanism.
pub struct Certifier<'a> {
    machine: &'a Machine,
    mechanism: Mechanism,
    drive: reference::Drive,
    /// The driven body, and the one that its angle is measured from; none for a displacement.
    driven: Option<[usize; 2]>,
    /// For each body the vector of the line that its angle is that of.
    lines: Vec<Option<[Rational; 2]>>,
    points: Vec<Attachment>,
    /// The coordinates that follow from the drive without loops.
    determined: Vec<Option<Determined>>,
    digits: usize,
    bits: u32,
}

impl<'a> Certifier<'a> {
    /// For `digits` significant digits of every value.
    ///
    /// # Errors
    /// [`NotExact`].
    pub fn new(machine: &'a Machine, digits: u32) -> Result<Certifier<'a>, NotExact> {
        let joints = reference_joints(&machine.exactly())?;
        let names = machine.bodies[1..].iter();
        let bodies = names.map(|name| Body::massless(name)).collect();
        let mechanism = Mechanism::new(bodies, joints)?;
        let (drive, driven) = match machine.solver.description().drive {
            Drive::Angle { body, from: GROUND } => {
                let drive = reference::Drive::coordinate(body - 1);
                (drive, Some([body, GROUND]))
            }
            Drive::Angle { body, from } => {
                let drive = reference::Drive::relative(from - 1, body - 1);
                (drive, Some([body, from]))
            }
            Drive::Displacement { joint } => {
                let before = travels(machine).iter().position(|t| t.0 == joint);
                let slide = machine.bodies.len() - 1 + before.unwrap_or_default();
                (reference::Drive::coordinate(slide), None)
            }
        };
        let line = |k: usize| {
            let [a, b] = machine.exact.get(k)?.get(..2)? else {
                return None;
            };
            let ([px, py], [qx, qy]) = (a.1.as_ref()?, b.1.as_ref()?);
            let along = |p: &Real, q: &Real| Some(Rational::from(q.fraction()? - p.fraction()?));
            Some([along(px, qx)?, along(py, qy)?])
        };
        let of = |k: usize| line(k).filter(|_| machine.lines[k] != 0.0);
        let exactly = machine.exactly();
        let points = machine.points.iter().map(|(_, p)| attached(&exactly, p));
        let linkage = Linkage::new(&mechanism, &drive, 64)?;
        Ok(Certifier {
            machine,
            drive,
            driven,
            lines: (0..machine.bodies.len()).map(of).collect(),
            points: points.collect::<Result<_, _>>()?,
            determined: (0..mechanism.coordinates())
                .map(|k| linkage.determined(k))
                .collect(),
            mechanism,
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

    /// The reference's drive for the user's in degrees or metres, that number of whole turns on.
    fn drive(&self, value: &Rational, turns: i64, bits: u32) -> Ball {
        let Some([body, from]) = self.driven else {
            return Ball::rational(bits, value);
        };
        let all = value + Rational::from(360 * turns);
        let angle = Ball::rational(bits, &(all / 180u32)) * Ball::pi(bits);
        angle - self.line(body, bits) + self.line(from, bits)
    }

    fn linkage(&self, bits: u32) -> Result<Linkage, Undecided> {
        Linkage::new(&self.mechanism, &self.drive, bits).map_err(|e| Undecided {
            bits,
            reason: e.to_string(),
        })
    }

    /// A coordinate that the drive determines without loops, if that is a fraction: in degrees of
    /// the body's line, or in metres.
    fn fraction(&self, value: &Rational, coordinate: usize) -> Option<Rational> {
        let found = self.determined[coordinate].as_ref()?;
        let body = Some(coordinate + 1).filter(|b| *b < self.machine.bodies.len());
        // As `plain + by_pi π`.
        let (mut plain, mut by_pi) = (Rational::new(), Rational::new());
        match self.driven {
            None => plain += Rational::from(&found.rate * value),
            Some(_) => by_pi += Rational::from(&found.rate * value) / 180u32,
        }
        for (k, angle) in &found.constants {
            match angle {
                ExactAngle::Degrees(q) => by_pi += Rational::from(k * q) / 180u32,
                ExactAngle::Radians(q) => plain += Rational::from(k * q),
            }
        }
        // The driven line's own angle leaves no other angle a fraction.
        let lined = |b: &usize| self.lines[*b].is_some();
        let driven = self.driven.filter(|_| !found.rate.is_zero());
        let tilted: Vec<usize> = driven
            .into_iter()
            .flatten()
            .chain(body)
            .filter(lined)
            .collect();
        match (&tilted[..], driven) {
            ([], _) => {}
            ([a, b], Some([driven, GROUND])) if [*a, *b] == [driven; 2] => {}
            _ => return None,
        }
        match body {
            Some(_) => plain.is_zero().then(|| by_pi * 180u32),
            None => by_pi.is_zero().then_some(plain),
        }
    }

    /// The coordinates of the solver's position, as the reference orders them.
    fn near(&self, state: &State) -> Vec<f64> {
        let solver = &self.machine.solver;
        let bodies = 1..self.machine.bodies.len();
        let angles = bodies.map(|b| solver.body_angle(state, b).angle.rad());
        let travels = travels(self.machine).into_iter();
        let travels = travels.map(|(j, _)| solver.joint_displacement(state, j));
        let travels = travels.map(|s| s.map_or(f64::NAN, |s| s.s_m));
        angles.chain(travels).collect()
    }

    /// The digits of a row next to a position of the solver, from the column after `branch` on;
    /// `None` where they could not be proved. The drive's value is in degrees or metres.
    pub fn values(&self, value: &Rational, state: &State, paths: bool) -> Vec<Option<String>> {
        self.row(value, state, paths).digits
    }

    /// [`Certifier::values`], with the reason where digits are missing.
    pub fn row(&self, value: &Rational, state: &State, paths: bool) -> CertifiedRow {
        let near = self.near(state);
        let names = super::certified_names(self.machine, paths);
        let (mut digits, mut failed) = self.rising(names.len() - 2, |bits| {
            self.enclosed(value, &near, paths, bits)
        });
        let mut add = |found: Vec<Option<String>>| {
            for (text, exact) in digits.iter_mut().zip(found) {
                *text = text.take().or(exact);
            }
            digits.iter().any(Option::is_none)
        };
        // Values that are zero, and positions where branches meet.
        if add(Vec::new())
            && (failed.is_some() || self.is_one(&near, |l| self.special(value, &near, l), value))
        {
            let special = |l: &Linkage| self.special(value, &near, l);
            let (found, _) = self.rising(names.len() - 2, |bits| {
                self.exact_row(value, paths, bits, special, false)
            });
            if failed.is_some() && found.iter().any(Option::is_some) {
                failed = Some(SINGULAR.into());
            }
            add(found);
        }
        if failed.is_none()
            && add(Vec::new())
            && self.is_one(&near, |l| self.family(value, &near, l), value)
        {
            let family = |l: &Linkage| self.family(value, &near, l);
            let (found, _) = self.rising(names.len() - 2, |bits| {
                self.exact_row(value, paths, bits, family, true)
            });
            add(found);
        }
        let open = digits.iter().position(Option::is_none);
        let near_zero = |k: usize| format!("{} is not told from zero", names[k + 2]);
        let reason = open.map(|k| failed.unwrap_or_else(|| near_zero(k)));
        CertifiedRow { digits, reason }
    }

    /// The row at a singular position: coordinates by exact algebra, and no derivatives but those
    /// that need no loops. Angles are those of all moving bodies; displacements are near those of a
    /// state.
    pub fn singular_row(
        &self,
        value: &Rational,
        angles: &[f64],
        state: &State,
        paths: bool,
    ) -> CertifiedRow {
        let mut near = self.near(state);
        near[..angles.len()].copy_from_slice(angles);
        let count = super::certified_names(self.machine, paths).len() - 2;
        let special = |l: &Linkage| self.special(value, &near, l);
        let (digits, failed) = self.rising(count, |bits| {
            self.exact_row(value, paths, bits, special, false)
        });
        let open = digits.iter().any(Option::is_none);
        let reason = open.then(|| failed.unwrap_or_else(|| SINGULAR.into()));
        CertifiedRow { digits, reason }
    }

    /// Digits at rising precision from what encloses a row, and why the last precision failed.
    fn rising(
        &self,
        count: usize,
        enclosed: impl Fn(u32) -> Result<Vec<Option<Ball>>, Undecided>,
    ) -> (Vec<Option<String>>, Option<String>) {
        let mut digits: Vec<Option<String>> = vec![None; count];
        let mut failed = None;
        for k in 0..RAISED {
            let values = match enclosed(self.bits << k) {
                Ok(values) => values,
                Err(e) => {
                    failed = Some(e.reason);
                    continue;
                }
            };
            failed = None;
            // Values that are missing at one precision are missing at all.
            let mut open = false;
            for (text, x) in digits.iter_mut().zip(&values) {
                let found = || x.as_ref()?.to_decimal(self.digits);
                *text = text.take().or_else(found);
                open |= text.is_none() && x.is_some();
            }
            if !open {
                break;
            }
        }
        (digits, failed)
    }

    /// The drive by exact numbers.
    fn exact_drive(&self, value: &Rational) -> ExactDrive {
        let Some([body, from]) = self.driven else {
            return ExactDrive::Displacement(value.clone().into());
        };
        let mut u = Real::unit(&ExactAngle::Degrees(value.clone()));
        for (k, sign) in [(body, -1), (from, 1)] {
            let line = self.lines[k].as_ref();
            let line = line.and_then(|v| Real::along(&v.clone().map(Real::from)));
            let Some([c, s]) = line else { continue };
            let s = s * &Rational::from(sign);
            let sum = |mut a: Real, b: Real| {
                a += &b;
                a
            };
            u = [
                sum(u[0].times(&c), -u[1].times(&s)),
                sum(u[0].times(&s), u[1].times(&c)),
            ];
        }
        ExactDrive::Direction(u)
    }

    /// The position next to approximate coordinates by exact algebra.
    fn special(
        &self,
        value: &Rational,
        near: &[f64],
        linkage: &Linkage,
    ) -> Result<Special, Undecided> {
        let drive = self.drive(value, self.turns(value, near), linkage.bits());
        let found = linkage.special(&drive, &self.exact_drive(value), near)?;
        let off = |(x, g): (&Ball, &f64)| (x.to_f64() - g).abs() < REACH;
        match found.position.x.iter().zip(near).all(off) {
            true => Ok(found),
            false => Err(Undecided {
                bits: linkage.bits(),
                reason: "no position is near that of the solver".into(),
            }),
        }
    }

    /// The same as one of a motion in which bodies keep their directions or turn with the drive, as
    /// the rates say.
    fn family(
        &self,
        value: &Rational,
        near: &[f64],
        linkage: &Linkage,
    ) -> Result<Special, Undecided> {
        let drive = self.drive(value, self.turns(value, near), linkage.bits());
        let rates = match linkage.nearest(&drive, near, REACH)? {
            Some(position) => linkage.rates(&position)?,
            None => Vec::new(),
        };
        let turns = |rate: &Ball| match rate {
            x if x.contains_zero() => Some(false),
            x if x.contains(&Rational::from(1)) => Some(true),
            _ => None,
        };
        let mut turns: Vec<Option<bool>> = rates.iter().map(turns).collect();
        turns.resize(self.machine.bodies.len() - 1, None);
        linkage.family(&drive, &self.exact_drive(value), &turns, near)
    }

    /// Coordinates, and the named points, at a position by exact algebra; with the derivatives of a
    /// motion.
    fn exact_row(
        &self,
        value: &Rational,
        paths: bool,
        bits: u32,
        found: impl Fn(&Linkage) -> Result<Special, Undecided>,
        moves: bool,
    ) -> Result<Vec<Option<Ball>>, Undecided> {
        let linkage = self.linkage(bits)?;
        let found = found(&linkage)?;
        let mut all = self.coordinates(value, &found.position, None, bits);
        let bodies = self.machine.bodies.len() - 1;
        let rates = match moves {
            true => None,
            false => ExactRates::new(&linkage, &found),
        };
        for k in 0..found.position.x.len() {
            if let Some(rates) = &rates {
                let [first, second] = rates.of(k, bits);
                (all[3 * k + 1], all[3 * k + 2]) = (Some(first), Some(second));
            }
            if let Some(rate) = found.rate(k).filter(|_| moves) {
                all[3 * k + 1] = Some(Ball::integer(bits, rate.into()));
                all[3 * k + 2] = Some(Ball::integer(bits, 0));
            }
            if k < bodies && self.fraction(value, k).is_none() {
                let axis = || [Rational::from(1), Rational::new()];
                let line = self.lines[k + 1].clone().unwrap_or_else(axis);
                if let Some(quarters) = found.quarters(k, &line) {
                    let degrees = [0, 90, 180, -90][quarters as usize];
                    all[3 * k] = Some(Ball::integer(bits, degrees));
                }
            }
        }
        for at in self.points.iter().filter(|_| paths) {
            match found.motion(&linkage, at).filter(|_| moves) {
                Some([p, v, a]) => {
                    all.extend(p.map(Some));
                    for (v, a) in v.into_iter().zip(a) {
                        all.extend([v, a].map(Some));
                    }
                }
                None => {
                    all.extend(found.point(&linkage, at).map(Some));
                    let exact = rates.as_ref().and_then(|r| r.point(&linkage, &found, at));
                    match exact {
                        Some([[vx, vy], [ax, ay]]) => all.extend([vx, ax, vy, ay].map(Some)),
                        None => all.extend([const { None }; 4]),
                    }
                }
            }
        }
        Ok(all)
    }

    /// Returns true if a position of exact algebra is the one that is enclosed next to the
    /// coordinates: it lies in the enclosure, where there is but one.
    fn is_one(
        &self,
        near: &[f64],
        found: impl Fn(&Linkage) -> Result<Special, Undecided>,
        value: &Rational,
    ) -> bool {
        let compared = || -> Result<bool, Undecided> {
            let coarse = self.linkage(self.bits)?;
            let drive = self.drive(value, self.turns(value, near), self.bits);
            let enclosed = coarse.nearest(&drive, near, REACH)?;
            let exact = found(&self.linkage(2 * self.bits)?)?;
            Ok(enclosed.is_some_and(|p| p.holds(&exact.position)))
        };
        compared().unwrap_or(false)
    }

    fn enclosed(
        &self,
        value: &Rational,
        near: &[f64],
        paths: bool,
        bits: u32,
    ) -> Result<Vec<Option<Ball>>, Undecided> {
        let linkage = self.linkage(bits)?;
        let drive = self.drive(value, self.turns(value, near), bits);
        let position = linkage
            .nearest(&drive, near, REACH)?
            .ok_or_else(|| Undecided {
                bits,
                reason: "no position is near that of the solver".into(),
            })?;
        let series = linkage.series(&position, 2)?;
        let mut all = self.coordinates(value, &position, Some(&series), bits);
        for at in self.points.iter().filter(|_| paths) {
            let [p, v, a] = linkage.point_motion(&series, at);
            all.extend(p.map(Some));
            for (v, a) in v.into_iter().zip(a) {
                all.extend([v, a].map(Some));
            }
        }
        Ok(all)
    }

    /// Whole turns from the user's drive to that of the solver's position.
    fn turns(&self, value: &Rational, near: &[f64]) -> i64 {
        let Some(driven) = self.driven else { return 0 };
        let angle = |b: usize| if b == GROUND { 0.0 } else { near[b - 1] };
        let [body, from] = driven.map(angle);
        let due = self.drive(value, 0, 64).to_f64();
        ((body - from - due) / TAU).round() as i64
    }

    /// Angles of the bodies' lines and displacements, each with its derivatives where there is a
    /// series.
    fn coordinates(
        &self,
        value: &Rational,
        position: &Position,
        series: Option<&Series>,
        bits: u32,
    ) -> Vec<Option<Ball>> {
        let bodies = self.machine.bodies.len() - 1;
        let mut all = Vec::new();
        for k in 0..position.x.len() {
            all.push(Some(match self.fraction(value, k) {
                Some(degrees) if k < bodies => {
                    let turns = (degrees.clone() / 360u32 - Rational::from((1, 2))).ceil();
                    Ball::rational(bits, &(degrees - turns * 360u32))
                }
                Some(metres) => Ball::rational(bits, &metres),
                None if k < bodies => self.degrees(&position.x[k], k + 1, bits),
                None => position.x[k].clone(),
            }));
            all.extend(match (&self.determined[k], series) {
                (Some(d), _) => [Ball::rational(bits, &d.rate), Ball::integer(bits, 0)].map(Some),
                (None, Some(s)) => {
                    let [first, second] = [1, 2].map(|n| s.coefficient(k, n));
                    [first.clone(), second.shift(1)].map(Some)
                }
                (None, None) => [None, None],
            });
        }
        all
    }

    /// The angle of a body's line in degrees, within half a turn of zero, for that of its frame.
    fn degrees(&self, angle: &Ball, body: usize, bits: u32) -> Ball {
        let whole = angle + &self.line(body, bits);
        let turns = (whole.to_f64() / TAU).round() as i64;
        let turn = Ball::pi(bits).shift(1) * Ball::integer(bits, turns);
        (whole - turn) * (Ball::integer(bits, 180) / Ball::pi(bits))
    }

    /// Returns true if all assembly modes can be counted: the displacements of slides and slots lie
    /// in no bounded set.
    pub fn counts_modes(&self) -> bool {
        travels(self.machine).is_empty()
    }

    /// The assembly modes at the drive in degrees, proved to be all.
    ///
    /// # Errors
    /// [`Undecided`] where modes meet or nearly so, where the search takes too long, and for
    /// mechanisms with slides or slots.
    pub fn modes(&self, degrees: &Rational) -> Result<Vec<Position>, Undecided> {
        self.linkage(self.bits)?
            .modes(&self.drive(degrees, 0, self.bits))
    }
}

#[cfg(test)]
mod tests;
