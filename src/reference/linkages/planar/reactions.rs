//! Multipliers of the equations in motion: joint reactions and the force on the drive.
//!
//! With F the equations, drive last, and a motion x(t) that satisfies them,
//! `Σ m S''·∂S/∂x + J ψ'' = Q − F'ᵀ λ`, Q being springs, weights and the given force on the drive.
//! A loop's two multipliers are the components of the force between the two points that it joins;
//! the drive's is the force that the motion needs less, and zero in free motion.

use super::enclosure::{Linkage, Position};
use super::energy::{Forces, Load};
use super::series::Series;
use crate::{Ball, BallLu, Undecided};

/// Rates and accelerations of a position in motion.
#[derive(Clone, Debug)]
pub struct Rates {
    /// Of the drive.
    pub drive: [Ball; 2],
    /// First derivatives of the coordinates by the time.
    pub first: Vec<Ball>,
    /// Second derivatives.
    pub second: Vec<Ball>,
}

impl Series {
    /// Rates of all coordinates for a speed and an acceleration of the drive.
    ///
    /// # Panics
    /// If the series has fewer than two orders.
    pub fn in_time(&self, speed: &Ball, acceleration: &Ball) -> Rates {
        let square = speed.square();
        let n = self.coordinates();
        let first = |i: usize| self.coefficient(i, 1) * speed;
        let second = |i: usize| {
            (self.coefficient(i, 2) * &square).shift(1) + self.coefficient(i, 1) * acceleration
        };
        Rates {
            drive: [speed.clone(), acceleration.clone()],
            first: (0..n).map(first).collect(),
            second: (0..n).map(second).collect(),
        }
    }
}

impl Linkage {
    /// Rates of all coordinates for a speed and an acceleration of the drive.
    ///
    /// # Errors
    /// [`Undecided`] where the Jacobian may be singular.
    pub fn in_time(
        &self,
        position: &Position,
        speed: &Ball,
        acceleration: &Ball,
    ) -> Result<Rates, Undecided> {
        Ok(self.series(position, 2)?.in_time(speed, acceleration))
    }

    /// The multipliers λ: two for each loop in the order of the joints that close them, one for
    /// each slide's, gear's or rack's relation, the drive's last.
    ///
    /// # Errors
    /// [`Undecided`] where the Jacobian may be singular.
    pub fn multipliers(
        &self,
        position: &Position,
        rates: &Rates,
        forces: &Forces,
    ) -> Result<Vec<Ball>, Undecided> {
        let bits = self.bits();
        let system = &self.fine;
        let load = Load::new(&self.mechanism, forces, bits);
        let pose = system.pose(position.x.clone());
        let zero = Ball::integer(bits, 0);
        let mut right = vec![zero.clone(); system.coordinates];
        for (i, k) in &system.drive {
            right[*i] = &right[*i] + &(&load.drive * k);
        }
        for s in &load.springs {
            let [x, y] = s.ends.value(&pose, &zero);
            let length = (x.square() + y.square()).sqrt();
            let pull = &s.stiffness * &(&length - &s.length) / &length;
            for (r, g) in right.iter_mut().zip(s.ends.gradient(&pose, &zero)) {
                *r = &*r - &(&pull * &(&x * &g[0] + &y * &g[1]));
            }
        }
        let series = self.series(position, 2)?;
        let [speed, acceleration] = &rates.drive;
        let square = speed.square();
        for body in &load.bodies {
            if !body.mass.is_zero() {
                let path = series.path(&body.centre);
                let due = |i: usize| {
                    let by = (&path[i][2] * &square).shift(1) + &path[i][1] * acceleration;
                    &body.mass * &(&load.gravity[i] - &by)
                };
                let (x, y) = (due(0), due(1));
                for (r, g) in right.iter_mut().zip(body.centre.gradient(&pose, &zero)) {
                    *r = &*r + &(&x * &g[0] + &y * &g[1]);
                }
            }
            let k = body.angle;
            right[k] = &right[k] - &(&body.inertia * &rates.second[k]);
        }
        let j = system.jacobian(&pose);
        let n = system.coordinates;
        let turned = (0..n).map(|i| (0..n).map(|k| j[k][i].clone()).collect());
        let matrix = BallLu::new(turned.collect())
            .ok_or_else(|| self.undecided("the Jacobian cannot be told from a singular one"))?;
        Ok(matrix.solve(&right))
    }
}

#[cfg(test)]
mod tests;
