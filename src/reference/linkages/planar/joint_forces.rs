//! Forces in the pins and the drive torque by the laws of Newton and Euler for every body.
//!
//! With the force f of a pin on its second body, and its opposite on the first, every body's forces
//! add up to `m (S'' − g)` and their moments about its centre of mass S to `J ψ''`, the drive's
//! torque among them: 3n linear equations for 2p forces and the torque. Nothing of the loops'
//! multipliers is used, whose drive force is a check.

use super::enclosure::Linkage;
use super::energy::Forces;
use super::parts::{Attachment, Frame, Joint};
use super::reactions::Rates;
use super::series::Series;
use super::system::BallForm;
use crate::{Ball, BallLu, Undecided};

/// Forces of a position in motion.
#[derive(Clone, Debug)]
pub struct JointForces {
    /// For every pin in the order of the joints the force on its second end, in the axes of the
    /// ground.
    pub pins: Vec<[Ball; 2]>,
    /// The force on the drive's form that the motion needs in addition to what acts: a torque where
    /// it is an angle.
    pub drive: Ball,
}

impl Linkage {
    /// A point with its first and second derivatives by the drive:
    /// `[[x, y], [x', y'], [x'', y'']]`.
    ///
    /// # Panics
    /// If the series has fewer than two orders.
    pub fn point_motion(&self, series: &Series, at: &Attachment) -> [[Ball; 2]; 3] {
        let form = BallForm::new(&self.mechanism.loops.point(at), self.bits());
        let [p, v, a] = [0, 1, 2].map(|n| series.form(&form, n));
        [p, v, a.map(|x| x.shift(1))]
    }

    /// Forces in the pins under gravity and inertia, for the rates of a position with its series of
    /// two orders or more.
    ///
    /// # Errors
    /// [`Undecided`] where the forces are not determined, and for mechanisms with joints other than
    /// pins or with springs.
    pub fn joint_forces(
        &self,
        series: &Series,
        rates: &Rates,
        forces: &Forces,
    ) -> Result<JointForces, Undecided> {
        let bits = self.bits();
        let bodies = &self.mechanism.bodies;
        let mut pins = Vec::with_capacity(self.mechanism.joints.len());
        for joint in &self.mechanism.joints {
            match joint {
                Joint::Pin { a, b } => pins.push((a, b)),
                _ => return Err(self.undecided("forces are computed for pins alone")),
            }
        }
        if !forces.springs.is_empty() {
            return Err(self.undecided("forces are computed without springs"));
        }
        let zero = Ball::integer(bits, 0);
        let place =
            |at: &Attachment| series.form(&BallForm::new(&self.mechanism.loops.point(at), bits), 0);
        let n = 3 * bodies.len();
        let mut matrix = vec![vec![zero.clone(); n]; n];
        let mut right = vec![zero.clone(); n];
        let [speed, acceleration] = &rates.drive;
        let square = speed.square();
        let mut centres = Vec::with_capacity(bodies.len());
        for (k, body) in bodies.iter().enumerate() {
            let centre = Attachment::body(k, body.centre.clone());
            let [s, first, second] = self.point_motion(series, &centre);
            let mass = Ball::rational(bits, &body.mass);
            for i in 0..2 {
                let by = &second[i] * &square + &first[i] * acceleration;
                right[3 * k + i] = &mass * &(by - Ball::rational(bits, &forces.gravity[i]));
            }
            right[3 * k + 2] = &Ball::rational(bits, &body.inertia) * &rates.second[k];
            centres.push(s);
        }
        for (j, (a, b)) in pins.iter().enumerate() {
            for (at, sign) in [(a, -1), (b, 1)] {
                let Frame::Body(k) = at.frame else { continue };
                let p = place(at);
                let arm = [0, 1].map(|i| &p[i] - &centres[k][i]);
                let one = Ball::integer(bits, sign);
                let [x, y] = [2 * j, 2 * j + 1];
                matrix[3 * k][x] = one.clone();
                matrix[3 * k + 1][y] = one.clone();
                matrix[3 * k + 2][x] = -(&arm[1] * &one);
                matrix[3 * k + 2][y] = &arm[0] * &one;
            }
        }
        for (i, factor) in &self.fine.drive {
            if *i < bodies.len() {
                matrix[3 * i + 2][n - 1] = factor.clone();
            }
        }
        let lu = BallLu::new(matrix)
            .ok_or_else(|| self.undecided("the forces in the joints are not determined"))?;
        let mut all = lu.solve(&right);
        let drive = &all[n - 1] - &Ball::rational(bits, &forces.drive);
        all.truncate(n - 1);
        let pins = all.chunks_exact(2).map(|f| [f[0].clone(), f[1].clone()]);
        Ok(JointForces {
            pins: pins.collect(),
            drive,
        })
    }
}
