//! Krawczyk's operator on the loop equations.
//!
//! For an approximate zero z, an approximate inverse Y of the Jacobian and a box X of half-widths r
//! around z, `K(X) = z − Y F(z) + (I − Y F'(X)) (X − z)`. If `K(X)` lies in the interior of X, F
//! has exactly one zero in X, and it lies in `K(X)` (Krawczyk, *Computing* 4 (1969) 187–201;
//! Neumaier, *Interval Methods for Systems of Equations*, 1990, Thm 5.1.8). With a ball for the
//! drive this holds for every drive in the ball. Y is an `f64` matrix taken as exact; a bad one can
//! only make the test fail.

use super::mechanism::Mechanism;
use super::mid_rad::MidRad;
use super::parts::{Drive, MechanismError};
use super::scalar::Scalar;
use super::system::System;
use crate::{Ball, BallLu, Mag, Undecided};
use nalgebra::{DMatrix, DVector};
use rug::Float;

/// A mechanism with a drive at a working precision.
#[derive(Clone, Debug)]
pub struct Linkage {
    pub(super) mechanism: Mechanism,
    pub(super) drive: Drive,
    pub(super) fine: System,
    /// For contraction factors, which need no digits.
    pub(super) coarse: System,
}

/// Enclosed coordinates: angles of the bodies, then displacements.
#[derive(Clone, Debug)]
pub struct Position {
    /// The coordinates.
    pub x: Vec<Ball>,
}

impl Position {
    /// Their midpoints.
    pub fn midpoints(&self) -> Vec<Float> {
        self.x.iter().map(|b| b.mid().clone()).collect()
    }

    /// Returns whether all of `other` lies in it.
    pub fn holds(&self, other: &Position) -> bool {
        let pairs = self.x.iter().zip(&other.x);
        pairs.into_iter().all(|(a, b)| a.contains_ball(b))
    }
}

pub(super) fn exact(z: &[Float], bits: u32) -> Vec<Ball> {
    let at = |x: &Float| Ball::new(x.clone(), Mag::ZERO).with_prec(bits);
    z.iter().map(at).collect()
}

/// `Y v`.
pub(super) fn apply(y: &DMatrix<f64>, v: &[Ball]) -> Vec<Ball> {
    (0..v.len())
        .map(|i| {
            let mut sum = Ball::integer(64, 0);
            for (k, x) in v.iter().enumerate() {
                if y[(i, k)] != 0.0 && !x.is_zero() {
                    sum = sum + &Ball::exact(64, y[(i, k)]) * x;
                }
            }
            sum
        })
        .collect()
}

impl System {
    /// The inverse of the Jacobian at z, in `f64`.
    pub(super) fn approximate_inverse(&self, z: &[Float]) -> Option<DMatrix<f64>> {
        let pose = self.pose(z.iter().map(Float::to_f64).collect());
        let j = self.jacobian::<f64>(&pose);
        let n = self.coordinates;
        let m = DMatrix::from_fn(n, n, |i, k| j[i][k]);
        m.try_inverse().filter(|y| y.iter().all(|x| x.is_finite()))
    }

    /// Upper bounds on the entries of `|I − Y F'(X)|` over the box of half-widths r around z.
    pub(super) fn contraction(&self, y: &DMatrix<f64>, z: &[Float], r: &[Mag]) -> Vec<Vec<Mag>> {
        let wide = exact(z, self.bits)
            .into_iter()
            .zip(r)
            .map(|(x, r)| MidRad::of(&x.widened(*r)));
        let j = self.jacobian(&self.pose(wide.collect()));
        defect(y, &j)
    }
}

/// Upper bounds on the entries of `|I − Y J|`.
pub(super) fn defect<T: Scalar>(y: &DMatrix<f64>, j: &[Vec<T>]) -> Vec<Vec<Mag>> {
    let n = j.len();
    let entry = |i: usize, k: usize| {
        let mut e = T::real(&Ball::integer(64, i64::from(i == k)));
        for (m, row) in j.iter().enumerate() {
            if y[(i, m)] != 0.0 && !row[k].size().is_zero() {
                e = e.minus(&row[k].by_f64(y[(i, m)]));
            }
        }
        e.size()
    };
    (0..n)
        .map(|i| (0..n).map(|k| entry(i, k)).collect())
        .collect()
}

/// `Σ_k e_ik r_k`.
pub(super) fn reach(e: &[Mag], r: &[Mag]) -> Mag {
    e.iter()
        .zip(r)
        .fold(Mag::ZERO, |s, (e, r)| s.add(e.mul(*r)))
}

pub(super) fn largest(v: &[Ball]) -> Mag {
    v.iter().fold(Mag::ZERO, |m, x| m.max(x.magnitude()))
}

impl Linkage {
    /// The mechanism with that drive.
    ///
    /// # Errors
    /// [`MechanismError::Drive`] if the drive names no coordinate.
    pub fn new(mechanism: &Mechanism, drive: &Drive, bits: u32) -> Result<Linkage, MechanismError> {
        mechanism.check_drive(drive)?;
        Ok(Linkage {
            fine: System::new(mechanism, drive, bits),
            coarse: System::new(mechanism, drive, 64),
            mechanism: mechanism.clone(),
            drive: drive.clone(),
        })
    }

    /// The working precision in bits.
    pub fn bits(&self) -> u32 {
        self.fine.bits
    }

    /// The mechanism.
    pub fn mechanism(&self) -> &Mechanism {
        &self.mechanism
    }

    /// Returns what the drive's form gives at a position.
    pub fn driven(&self, position: &Position) -> Ball {
        self.fine.driven(&position.x)
    }

    pub(super) fn undecided(&self, reason: &str) -> Undecided {
        Undecided::new(self.bits(), reason)
    }

    /// The position with the drive at `drive`, enclosed around the zero that Newton's method finds
    /// from `guess`.
    ///
    /// # Errors
    /// [`Undecided`] when Krawczyk's test fails: no position near, a change point or dead position
    /// near, too few bits.
    pub fn position(&self, drive: &Ball, guess: &[Float]) -> Result<Position, Undecided> {
        self.enclose(drive, guess)
            .ok_or_else(|| self.undecided("Krawczyk's test of a position fails"))
    }

    pub(super) fn enclose(&self, drive: &Ball, guess: &[Float]) -> Option<Position> {
        let bits = self.bits();
        let mut y = self.coarse.approximate_inverse(guess)?;
        // Newton's method in f64, then chords with all digits; the counts are only guards.
        let near = drive.mid().to_f64();
        let mut x: Vec<f64> = guess.iter().map(Float::to_f64).collect();
        let mut last = f64::INFINITY;
        for round in 0..30 {
            let f = self.coarse.residual(&self.coarse.pose(x.clone()), &near);
            let step = &y * DVector::from_vec(f);
            let size = step.amax();
            if !size.is_finite() {
                return None;
            }
            if round > 1 && size >= 0.5 * last {
                break;
            }
            x.iter_mut().zip(&step).for_each(|(x, s)| *x -= s);
            let at: Vec<Float> = x.iter().map(|x| Float::with_val(53, *x)).collect();
            y = self.coarse.approximate_inverse(&at)?;
            last = size;
        }
        let mut z: Vec<Float> = x.iter().map(|x| Float::with_val(bits, *x)).collect();
        let mut last = Mag::INFINITY;
        let mut step = apply(&y, &self.residual(&z, drive));
        for round in 0..10 + bits / 16 {
            let size = largest(&step);
            if !size.is_finite() {
                return None;
            }
            // Settled: the step is rounding, and no longer shrinks.
            if round > 0 && size >= last.shift(-1) {
                break;
            }
            for (z, s) in z.iter_mut().zip(&step) {
                *z -= s.mid();
            }
            last = size;
            step = apply(&y, &self.residual(&z, drive));
        }
        self.krawczyk(&y, &z, &step)
    }

    /// `F(z)`.
    pub(super) fn residual(&self, z: &[Float], drive: &Ball) -> Vec<Ball> {
        let pose = self.fine.pose(exact(z, self.bits()));
        self.fine.residual(&pose, drive)
    }

    /// Krawczyk's test around z with `step = Y F(z)`.
    fn krawczyk(&self, y: &DMatrix<f64>, z: &[Float], step: &[Ball]) -> Option<Position> {
        let tiny = Mag::power_of_two(-i64::from(self.bits()));
        let half = largest(step).shift(2).max(tiny);
        let r = vec![half; z.len()];
        // The coarse midpoint is not z itself: the box takes the difference in.
        let e = self.coarse.contraction(y, z, &r);
        let mut x = Vec::with_capacity(z.len());
        for i in 0..z.len() {
            let rad = step[i].magnitude().add(reach(&e[i], &r));
            if !(rad < r[i]) {
                return None;
            }
            x.push(Ball::new(z[i].clone(), rad));
        }
        Some(Position { x })
    }

    /// The factored Jacobian at a position.
    pub(super) fn factored(&self, position: &Position) -> Result<BallLu, Undecided> {
        let pose = self.fine.pose(position.x.clone());
        BallLu::new(self.fine.jacobian(&pose))
            .ok_or_else(|| self.undecided("the Jacobian cannot be told from a singular one"))
    }

    /// Derivatives of the coordinates by the drive.
    ///
    /// # Errors
    /// [`Undecided`] where the Jacobian may be singular.
    pub fn rates(&self, position: &Position) -> Result<Vec<Ball>, Undecided> {
        let n = self.fine.coordinates;
        let mut right = vec![Ball::integer(self.bits(), 0); n];
        right[n - 1] = Ball::integer(self.bits(), 1);
        Ok(self.factored(position)?.solve(&right))
    }
}
