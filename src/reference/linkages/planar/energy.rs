//! Masses and conservative forces: reduced inertia, work, potential.

use super::enclosure::{Linkage, Position};
use super::loops::difference;
use super::mechanism::Mechanism;
use super::parts::{Attachment, Body, Point};
use super::scalar::Scalar;
use super::series::{Series, product};
use super::system::{BallForm, Pose};
use crate::{Ball, dot};
use rug::Rational;

/// A linear spring between two points.
#[derive(Clone, Debug, PartialEq)]
pub struct Spring {
    /// One end.
    pub a: Attachment,
    /// The other.
    pub b: Attachment,
    /// Force for an elongation of one.
    pub stiffness: Rational,
    /// Length without force.
    pub length: Rational,
}

/// Forces whose work depends on the position alone.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Forces {
    /// Constant force on the drive's form: a torque where it is an angle.
    pub drive: Rational,
    /// Springs.
    pub springs: Vec<Spring>,
    /// Acceleration of gravity.
    pub gravity: Point,
}

/// A spring's ends as a difference of points, in balls.
#[derive(Clone, Debug)]
pub(super) struct Stretch {
    pub ends: BallForm,
    pub stiffness: Ball,
    pub length: Ball,
}

/// A body's centre of mass, in balls.
#[derive(Clone, Debug)]
pub(super) struct Heavy {
    pub centre: BallForm,
    pub mass: Ball,
    pub inertia: Ball,
    pub angle: usize,
}

/// Bodies and forces at a precision.
#[derive(Clone, Debug)]
pub(super) struct Load {
    pub bits: u32,
    pub bodies: Vec<Heavy>,
    pub springs: Vec<Stretch>,
    pub gravity: [Ball; 2],
    pub drive: Ball,
}

impl Load {
    pub(super) fn new(mechanism: &Mechanism, forces: &Forces, bits: u32) -> Load {
        let ball = |q: &Rational| Ball::rational(bits, q);
        let loops = &mechanism.loops;
        let centre = |i: usize, body: &Body| Attachment::body(i, body.centre.clone());
        let heavy = |(angle, body): (usize, &Body)| Heavy {
            centre: BallForm::new(&loops.point(&centre(angle, body)), bits),
            mass: ball(&body.mass),
            inertia: ball(&body.inertia),
            angle,
        };
        let ends = |s: &Spring| difference(&loops.point(&s.a), &loops.point(&s.b));
        let stretch = |s: &Spring| Stretch {
            ends: BallForm::new(&ends(s), bits),
            stiffness: ball(&s.stiffness),
            length: ball(&s.length),
        };
        Load {
            bits,
            bodies: mechanism.bodies.iter().enumerate().map(heavy).collect(),
            springs: forces.springs.iter().map(stretch).collect(),
            gravity: forces.gravity.each_ref().map(ball),
            drive: ball(&forces.drive),
        }
    }

    /// `Σ m |S'|² + J ψ'²` for given rates of the coordinates.
    pub(super) fn inertia<T: Scalar>(&self, pose: &Pose<T>, rates: &[T]) -> T {
        let zero = T::real(&Ball::integer(self.bits, 0));
        let mut out = zero.clone();
        for body in &self.bodies {
            if !body.mass.is_zero() {
                let [x, y] = body.centre.rate(pose, rates, &zero);
                out = out.plus(&x.times(&x).plus(&y.times(&y)).by(&body.mass));
            }
            let turn = &rates[body.angle];
            out = out.plus(&turn.times(turn).by(&body.inertia));
        }
        out
    }

    /// The energy of springs and weights, `Σ k (L − l)²/2 − m g·S`.
    pub(super) fn potential<T: Scalar>(&self, pose: &Pose<T>) -> T {
        let zero = T::real(&Ball::integer(self.bits, 0));
        let half = Ball::integer(self.bits, 1).shift(-1);
        let mut out = zero.clone();
        for s in &self.springs {
            let [x, y] = s.ends.value(pose, &zero);
            let square = x.times(&x).plus(&y.times(&y));
            let stretch = square.times(&square.over_root()).minus(&T::real(&s.length));
            out = out.plus(&stretch.times(&stretch).by(&s.stiffness).by(&half));
        }
        if self.gravity.iter().any(|g| !g.is_zero()) {
            for body in &self.bodies {
                let [x, y] = body.centre.value(pose, &zero);
                let height = x.by(&self.gravity[0]).plus(&y.by(&self.gravity[1]));
                out = out.minus(&height.by(&body.mass));
            }
        }
        out
    }

    /// Taylor coefficients of the reduced inertia, one order less than the coordinates have.
    pub(super) fn inertia_series(&self, series: &Series) -> Vec<Ball> {
        let top = series.order();
        let slope = |c: &[Ball]| -> Vec<Ball> {
            let term = |(n, x): (usize, &Ball)| x * &Ball::integer(self.bits, n as i64);
            c.iter().enumerate().skip(1).map(term).collect()
        };
        let mut out = vec![Ball::integer(self.bits, 0); top];
        let mut add = |factor: &Ball, rate: &[Ball]| {
            for (n, out) in out.iter_mut().enumerate() {
                *out = &*out + &(factor * &product(rate, rate, n, self.bits));
            }
        };
        for body in &self.bodies {
            if !body.mass.is_zero() {
                for path in series.path(&body.centre) {
                    add(&body.mass, &slope(&path));
                }
            }
            add(&body.inertia, &slope(series.of(body.angle)));
        }
        out
    }

    /// Taylor coefficients of the potential. A spring's length is the root of `|D|²`:
    /// `2 L_0 L_n = (|D|²)_n − Σ_{k=1}^{n−1} L_k L_{n−k}`.
    pub(super) fn potential_series(&self, series: &Series) -> Vec<Ball> {
        let bits = self.bits;
        let orders = 0..=series.order();
        let mut out = vec![Ball::integer(bits, 0); series.order() + 1];
        for s in &self.springs {
            let [x, y] = series.path(&s.ends);
            let mut length: Vec<Ball> = Vec::with_capacity(out.len());
            for n in orders.clone() {
                let square = product(&x, &x, n, bits) + product(&y, &y, n, bits);
                length.push(match n {
                    0 => square.sqrt(),
                    _ => {
                        let inner = (1..n).map(|k| (&length[k], &length[n - k]));
                        (square - dot(bits, inner)) / length[0].shift(1)
                    }
                });
            }
            length[0] = &length[0] - &s.length;
            for n in orders.clone() {
                let half = (&s.stiffness * &product(&length, &length, n, bits)).shift(-1);
                out[n] = &out[n] + &half;
            }
        }
        if self.gravity.iter().any(|g| !g.is_zero()) {
            for body in &self.bodies {
                for (path, g) in series.path(&body.centre).iter().zip(&self.gravity) {
                    for (out, s) in out.iter_mut().zip(path) {
                        *out = &*out - &(&(&body.mass * g) * s);
                    }
                }
            }
        }
        out
    }
}

impl Linkage {
    /// Taylor coefficients of the reduced inertia `Σ m |dS/db|² + J (dψ/db)²`, one order less than
    /// the series has.
    pub fn reduced_inertia(&self, series: &Series) -> Vec<Ball> {
        Load::new(&self.mechanism, &Forces::default(), self.bits()).inertia_series(series)
    }

    /// Returns what forces do for a unit of the drive, `Q − dV/db`, and its derivative.
    ///
    /// # Panics
    /// If the series has fewer than two orders.
    pub fn reduced_force(&self, series: &Series, forces: &Forces) -> [Ball; 2] {
        let load = Load::new(&self.mechanism, forces, self.bits());
        let potential = load.potential_series(series);
        [&load.drive - &potential[1], -potential[2].shift(1)]
    }

    /// The energy of springs and weights at a position.
    pub fn potential(&self, position: &Position, forces: &Forces) -> Ball {
        let load = Load::new(&self.mechanism, forces, self.bits());
        load.potential(&self.fine.pose(position.x.clone()))
    }
}
