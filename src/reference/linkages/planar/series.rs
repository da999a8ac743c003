//! Taylor coefficients of the coordinates by the drive, of any order.
//!
//! With `x(b) = Σ x_n (b − b0)^n` the directions follow from `c' = −s ψ'`, `s' = c ψ'`:
//! `n c_n = −Σ_{k=1}^{n} k ψ_k s_{n−k}`. The coefficient of order n of the equations is
//! `F'(x_0) x_n` plus what the lower orders give, so that one factored Jacobian serves all orders.

use super::enclosure::{Linkage, Position};
use super::system::{BallForm, System};
use crate::{Ball, Undecided, dot};

/// Taylor coefficients of the coordinates about a position: `coefficient(i, n)` is `x_i^{(n)}/n!`.
#[derive(Clone, Debug)]
pub struct Series {
    bits: u32,
    x: Vec<Vec<Ball>>,
    cos: Vec<Vec<Ball>>,
    sin: Vec<Vec<Ball>>,
}

/// `Σ_{k=0}^{n} a_k b_{n−k}`.
pub(super) fn product(a: &[Ball], b: &[Ball], n: usize, bits: u32) -> Ball {
    dot(bits, (0..=n).map(|k| (&a[k], &b[n - k])))
}

impl Series {
    fn start(system: &System, position: &Position) -> Series {
        let pose = system.pose(position.x.clone());
        Series {
            bits: system.bits,
            x: position.x.iter().map(|x| vec![x.clone()]).collect(),
            cos: pose.cos_sin.iter().map(|p| vec![p.0.clone()]).collect(),
            sin: pose.cos_sin.iter().map(|p| vec![p.1.clone()]).collect(),
        }
    }

    /// Appends the next coefficients of coordinates and directions.
    fn push(&mut self, next: Vec<Ball>) {
        for (x, next) in self.x.iter_mut().zip(next) {
            x.push(next);
        }
        let n = self.order();
        for i in 0..self.cos.len() {
            let [c, s] = self.directions(i, n);
            self.cos[i].push(c);
            self.sin[i].push(s);
        }
    }

    /// Coefficients n of cosine and sine from those below and ψ_1 … ψ_n.
    fn directions(&self, i: usize, n: usize) -> [Ball; 2] {
        let mut c = Ball::integer(self.bits, 0);
        let mut s = Ball::integer(self.bits, 0);
        for k in 1..=n {
            let slope = &self.x[i][k] * &Ball::integer(self.bits, k as i64);
            c = c - &slope * &self.sin[i][n - k];
            s = s + &slope * &self.cos[i][n - k];
        }
        let n = Ball::integer(self.bits, n as i64);
        [c / &n, s / &n]
    }

    /// The highest order.
    pub fn order(&self) -> usize {
        self.x.first().map_or(0, |x| x.len() - 1)
    }

    /// The number of coordinates.
    pub fn coordinates(&self) -> usize {
        self.x.len()
    }

    /// `x_i^{(n)}/n!`.
    pub fn coefficient(&self, i: usize, n: usize) -> &Ball {
        &self.x[i][n]
    }

    /// All coefficients of one coordinate.
    pub fn of(&self, i: usize) -> &[Ball] {
        &self.x[i]
    }

    /// Coefficient n of a point.
    pub(super) fn form(&self, form: &BallForm, n: usize) -> [Ball; 2] {
        let mut out = [Ball::integer(self.bits, 0), Ball::integer(self.bits, 0)];
        for t in &form.0 {
            let [c, s] = match (t.body, t.slide) {
                (Some(k), None) => [self.cos[k][n].clone(), self.sin[k][n].clone()],
                (Some(k), Some(j)) => [
                    product(&self.cos[k], &self.x[j], n, self.bits),
                    product(&self.sin[k], &self.x[j], n, self.bits),
                ],
                (None, Some(j)) => [self.x[j][n].clone(), Ball::integer(self.bits, 0)],
                (None, None) if n == 0 => {
                    [Ball::integer(self.bits, 1), Ball::integer(self.bits, 0)]
                }
                (None, None) => continue,
            };
            out[0] = &out[0] + &(&c * &t.re - &s * &t.im);
            out[1] = &out[1] + &(&s * &t.re + &c * &t.im);
        }
        out
    }

    /// Coefficients 0 … order of a point.
    pub(super) fn path(&self, form: &BallForm) -> [Vec<Ball>; 2] {
        let points: Vec<[Ball; 2]> = (0..=self.order()).map(|n| self.form(form, n)).collect();
        [0, 1].map(|i| points.iter().map(|p| p[i].clone()).collect())
    }
}

impl Linkage {
    /// Taylor coefficients up to `order` about a position.
    ///
    /// # Errors
    /// [`Undecided`] where the Jacobian may be singular.
    pub fn series(&self, position: &Position, order: usize) -> Result<Series, Undecided> {
        let system = &self.fine;
        let matrix = self.factored(position)?;
        let zero = || Ball::integer(system.bits, 0);
        let mut series = Series::start(system, position);
        for n in 1..=order {
            // With zero for x_n the equations give what the lower orders contribute.
            let mut trial = series.clone();
            trial.push(vec![zero(); system.coordinates]);
            let mut right = Vec::with_capacity(system.coordinates);
            for f in &system.closures {
                right.extend(trial.form(f, n).map(|v| -v));
            }
            right.extend(system.relations.iter().map(|_| zero()));
            right.push(Ball::integer(system.bits, i64::from(n == 1)));
            series.push(matrix.solve(&right));
        }
        Ok(series)
    }
}
