//! Positions continued over a disc of complex drives.
//!
//! For a centre z, an approximate inverse Y of the Jacobian and half-widths r, `N(x) = x − Y F(x; b)` takes the polydisc
//! `|x_i − z_i| ≤ r_i` into its interior for every b of the disc D if
//! `|Y F(z; D)|_i + Σ_k |I − Y F'(X)|_ik r_k < r_i`. The sum alone makes N a contraction in the norm `max |x_i|/r_i`,
//! so that F has exactly one zero there for every b in D; the iterates from z are analytic in b and converge uniformly,
//! so the zero is analytic in b, and real where b is.
//!
//! The same bound encloses the rates: with `E = I − Y F'` and `F' x' = e`, `x' = Y e + E x'`, hence
//! `‖x'‖ ≤ ‖Y e‖/(1 − κ)` and `|x' − Y e|_i ≤ Σ_k |E|_ik r_k ‖x'‖`.

use super::enclosure::{Linkage, Position, reach};
use super::scalar::Scalar;
use super::system::Pose;
use crate::{Ball, ComplexBall, Mag};
use nalgebra::DMatrix;
use rug::Float;

/// A disc of drives with one position, analytic in the drive, for each.
#[derive(Clone, Debug)]
pub(super) struct Disc {
    /// The real centre of the polydisc.
    pub centre: Vec<Float>,
    /// Rates at the centre.
    slopes: Vec<f64>,
    /// Where the real part of the disc lies.
    pub drive: Ball,
    /// Half-widths of the polydisc.
    pub r: Vec<Mag>,
    /// Encloses all its positions.
    pub pose: Pose<ComplexBall>,
    /// Encloses the derivatives by the drive.
    pub rates: Vec<ComplexBall>,
}

/// `Y v` for complex v.
fn apply(y: &DMatrix<f64>, v: &[ComplexBall]) -> Vec<ComplexBall> {
    let row = |i: usize| {
        v.iter().enumerate().fold(ComplexBall::zero(64), |s, (k, x)| {
            s.plus(&x.by(&Ball::exact(64, y[(i, k)])))
        })
    };
    (0..v.len()).map(row).collect()
}

/// Upper bounds on `|I − Y J|`.
fn defect(y: &DMatrix<f64>, j: &[Vec<ComplexBall>]) -> Vec<Vec<Mag>> {
    let n = j.len();
    let entry = |i: usize, k: usize| {
        let mut e = ComplexBall::real(&Ball::integer(64, i64::from(i == k)));
        for (m, row) in j.iter().enumerate() {
            if y[(i, m)] != 0.0 {
                e = e.minus(&row[k].by(&Ball::exact(64, y[(i, m)])));
            }
        }
        e.size()
    };
    (0..n)
        .map(|i| (0..n).map(|k| entry(i, k)).collect())
        .collect()
}

/// A square around a point of the real line that holds the disc of radius r.
fn square(middle: &Ball, r: Mag) -> ComplexBall {
    let imaginary = Ball::integer(middle.prec(), 0).widened(r);
    ComplexBall::new(middle.widened(r), imaginary)
}

impl Linkage {
    /// The disc of that radius around the drive at a position; none if the proof fails.
    pub(super) fn disc(&self, drive: &Ball, position: &Position, radius: Mag) -> Option<Disc> {
        const ROUNDS: usize = 12;
        let system = &self.coarse;
        let z = position.midpoints();
        let y = system.approximate_inverse(&z)?;
        let at: Vec<Ball> = super::enclosure::exact(&z, 64);
        let real = |b: &Ball| ComplexBall::real(b);
        let middle = system.pose(at.iter().map(real).collect::<Vec<_>>());
        let discs = square(&drive.with_prec(64), radius);
        let step = apply(&y, &system.residual(&middle, &discs));
        let needs: Vec<Mag> = step.iter().map(ComplexBall::size).collect();
        let mut r: Vec<Mag> = needs
            .iter()
            .map(|s| s.mul(Mag::from_f64(1.25)).max(radius.shift(-20)))
            .collect();
        for _ in 0..ROUNDS {
            let wide: Vec<ComplexBall> = at.iter().zip(&r).map(|(x, r)| square(x, *r)).collect();
            let pose = system.pose(wide);
            let e = defect(&y, &system.jacobian(&pose));
            let spread: Vec<Mag> = e.iter().map(|e| reach(e, &r)).collect();
            let due: Vec<Mag> = needs.iter().zip(&spread).map(|(s, e)| s.add(*e)).collect();
            if due.iter().any(|d| !d.is_finite()) {
                return None;
            }
            if due.iter().zip(&r).all(|(d, r)| d < r) {
                let rates = self.disc_rates(&y, &spread, &r)?;
                return Some(Disc {
                    centre: z,
                    slopes: rates.iter().map(|x| x.re.mid().to_f64()).collect(),
                    drive: drive.widened(radius),
                    r,
                    pose,
                    rates,
                });
            }
            r = due.iter().map(|d| d.mul(Mag::from_f64(1.05))).collect();
        }
        None
    }

    /// Encloses the rates over the polydisc.
    fn disc_rates(&self, y: &DMatrix<f64>, spread: &[Mag], r: &[Mag]) -> Option<Vec<ComplexBall>> {
        let n = self.coarse.coordinates;
        let mut unit = vec![ComplexBall::zero(64); n];
        unit[n - 1] = ComplexBall::real(&Ball::integer(64, 1));
        let first = apply(y, &unit);
        // Upper bounds on κ and on ‖Y e‖.
        let ratio = |a: Mag, b: Mag| a.div(b);
        let (mut kappa, mut norm) = (Mag::ZERO, Mag::ZERO);
        for i in 0..n {
            kappa = kappa.max(ratio(spread[i], r[i]));
            norm = norm.max(ratio(first[i].size(), r[i]));
        }
        let rest = Mag::from_f64(1.0).sub_below(kappa);
        if rest.is_zero() {
            return None;
        }
        let norm = norm.div(rest);
        let rates = first.iter().zip(spread);
        Some(rates.map(|(x, s)| x.widened(s.mul(norm))).collect())
    }
}

impl Disc {
    /// A guess for the position at a drive of the disc.
    pub(super) fn guess(&self, by: f64) -> Vec<Float> {
        let at = self.centre.iter().zip(&self.slopes);
        at.map(|(x, s)| Float::with_val(x.prec(), x + by * s)).collect()
    }

    /// Whether a position at a real drive of the disc is the disc's: its enclosure lies in the polydisc, where there is
    /// but one.
    pub(super) fn owns(&self, drive: &Ball, position: &Position) -> bool {
        let inside = |((x, z), r): ((&Ball, &Float), &Mag)| {
            Ball::new(z.clone(), *r).contains_ball(x)
        };
        self.drive.contains_ball(drive)
            && position
                .x
                .iter()
                .zip(&self.centre)
                .zip(&self.r)
                .all(inside)
    }
}
