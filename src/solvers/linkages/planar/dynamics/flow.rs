//! Closed loops, velocities, and accelerations at one moment.

use super::super::chain::{Closure, rail, spot};
use super::super::dense::{Factors, Matrix};
use super::super::motion::Motion;
use super::super::plane::dot;
use super::super::pose::Pose;
use super::forces::{Pushed, Sink, drive, load};
use super::{Dynamics, DynamicsError};

/// The mechanism at a moment, as laws see it.
pub struct Instant<'a> {
    pub(super) dynamics: &'a Dynamics,
    pub(super) pose: &'a Pose,
    /// Velocities.
    pub(super) flow: &'a Motion,
    /// Time in seconds.
    pub time: f64,
}

impl Instant<'_> {
    /// A body's angle in radians, not reduced by whole turns, and its rate.
    pub fn angle(&self, body: usize) -> [f64; 2] {
        let angle = self.pose.angle(&self.dynamics.chain, body);
        [angle, self.flow.bodies[body].turn[0]]
    }

    /// Hands on what all loads do.
    pub(super) fn act(&self, sink: &mut impl Sink) {
        let dynamics = self.dynamics;
        dynamics.loads.iter().for_each(|l| load(l, self, sink));
        dynamics.driven.iter().for_each(|l| drive(l, self, sink));
    }

    /// The displacement of a slide or slot in metres and its rate; NaN for other joints.
    pub fn displacement(&self, joint: usize) -> [f64; 2] {
        self.dynamics.displaced(self.pose, self.flow, joint)
    }
}

/// Closures are solved to corrections below this; the next would be its square.
const SETTLED: f64 = 1e-9;
/// The most corrections.
const ROUNDS: usize = 8;
/// Unknowns that move by more than this from where they were expected may be on another branch.
const FARTHEST: f64 = 0.5;
/// Smallest pivot of the closures' Jacobian by its largest entry.
const SINGULAR: f64 = 1e-9;

/// Positions and rates at one moment, in memory that is used again.
#[derive(Clone, Debug)]
pub(super) struct Flow {
    pub pose: Pose,
    /// Unknowns that the closures determine, and the others: z.
    pub dependent: Vec<usize>,
    pub independent: Vec<usize>,
    jacobian: Matrix,
    square: Matrix,
    factors: Factors,
    residual: Vec<f64>,
    step: Vec<f64>,
    /// `∂u/∂z_i` for each i.
    pub basis: Vec<Vec<f64>>,
    zero: Vec<f64>,
    /// Partial velocities for each i.
    partial: Vec<Motion>,
    /// `u̇` and the part β of ü.
    pub rates: Vec<f64>,
    bias: Vec<f64>,
    /// Velocities and the accelerations for z̈ = 0.
    pub flow: Motion,
    mass: Vec<f64>,
    force: Vec<f64>,
}

impl Flow {
    /// The mechanism at unknowns that close the loops; z is chosen by complete pivoting.
    pub(super) fn new(dynamics: &Dynamics, u: &[f64]) -> Option<Flow> {
        let chain = &dynamics.chain;
        let n = chain.unknowns;
        let rows: usize = chain.closures.iter().map(Closure::rows).sum();
        let freedoms = n.checked_sub(rows)?;
        let mut flow = Flow {
            pose: Pose::new(chain, 0.0, u.to_vec()),
            dependent: Vec::new(),
            independent: Vec::new(),
            jacobian: Matrix::new(rows, n + 1),
            square: Matrix::new(rows, rows),
            factors: Factors::default(),
            residual: Vec::new(),
            step: vec![0.0; rows],
            basis: vec![vec![0.0; n]; freedoms],
            zero: vec![0.0; n],
            partial: vec![Motion::default(); freedoms],
            rates: vec![0.0; n],
            bias: vec![0.0; n],
            flow: Motion::default(),
            mass: vec![0.0; freedoms * freedoms],
            force: vec![0.0; freedoms],
        };
        flow.choose(dynamics).then_some(flow)
    }

    /// Chooses the independent coordinates anew, and computes the basis; `false` at a singular
    /// position.
    pub(super) fn choose(&mut self, dynamics: &Dynamics) -> bool {
        let chain = &dynamics.chain;
        let (rows, n) = (self.step.len(), chain.unknowns);
        self.pose
            .jacobian(chain, 0..chain.closures.len(), &mut self.jacobian);
        let mut a: Vec<Vec<f64>> = (0..rows)
            .map(|r| self.jacobian.row(r)[..n].to_vec())
            .collect();
        let largest = |a: &[Vec<f64>], from: usize, taken: &[usize]| {
            let mut best = (0.0, from, 0);
            for (r, row) in a.iter().enumerate().skip(from) {
                for (c, x) in row.iter().enumerate().filter(|(c, _)| !taken.contains(c)) {
                    if x.abs() > best.0 {
                        best = (x.abs(), r, c);
                    }
                }
            }
            best
        };
        let scale = largest(&a, 0, &[]).0;
        self.dependent.clear();
        for k in 0..rows {
            let (size, r, c) = largest(&a, k, &self.dependent);
            if !(size > SINGULAR * scale) {
                return false;
            }
            a.swap(k, r);
            self.dependent.push(c);
            for below in k + 1..rows {
                let factor = a[below][c] / a[k][c];
                let (above, rest) = a.split_at_mut(below);
                let pairs = rest[0].iter_mut().zip(&above[k]);
                pairs.for_each(|(x, y)| *x -= factor * y);
            }
        }
        self.independent = (0..n).filter(|c| !self.dependent.contains(c)).collect();
        self.factored() && self.spread()
    }

    /// Factors the dependent columns of the Jacobian at hand.
    fn factored(&mut self) -> bool {
        let rows = self.step.len();
        for r in 0..rows {
            for (k, c) in self.dependent.iter().enumerate() {
                self.square[(r, k)] = self.jacobian[(r, *c)];
            }
        }
        rows == 0 || self.factors.of(&self.square, rows, 0)
    }

    /// The basis: `J_D N_D = −J_I`.
    fn spread(&mut self) -> bool {
        for (i, &c) in self.independent.iter().enumerate() {
            let basis = &mut self.basis[i];
            basis.fill(0.0);
            basis[c] = 1.0;
            if self.dependent.is_empty() {
                continue;
            }
            let jacobian = &self.jacobian;
            self.factors.solve(|r| -jacobian[(r, c)], &mut self.step);
            for (k, &c) in self.dependent.iter().enumerate() {
                basis[c] = self.step[k];
            }
            if !self.step.iter().all(|x| x.is_finite()) {
                return false;
            }
        }
        true
    }

    /// The largest entry of the basis: how much faster a dependent unknown moves than z.
    pub(super) fn amplification(&self) -> f64 {
        let all = self.basis.iter().flatten();
        all.fold(0.0, |m: f64, x| m.max(x.abs()))
    }

    /// The independent coordinates.
    pub(super) fn z(&self, out: &mut [f64]) {
        for (out, &c) in out.iter_mut().zip(&self.independent) {
            *out = self.pose.u[c];
        }
    }

    /// Moves to other independent coordinates and closes the loops; `false` if that fails.
    fn close(&mut self, dynamics: &Dynamics, z: &[f64]) -> bool {
        let chain = &dynamics.chain;
        for (i, &c) in self.independent.iter().enumerate() {
            let moved = z[i] - self.pose.u[c];
            self.pose.u[c] = z[i];
            for &d in &self.dependent {
                self.pose.u[d] += self.basis[i][d] * moved;
            }
        }
        self.pose.place(chain, &chain.order);
        if self.dependent.is_empty() {
            return z.iter().all(|z| z.is_finite());
        }
        let closures = 0..chain.closures.len();
        let mut all = 0.0;
        for _ in 0..ROUNDS {
            self.pose
                .residual(chain, &chain.closures, &mut self.residual);
            self.pose
                .jacobian(chain, closures.clone(), &mut self.jacobian);
            if !self.factored() {
                return false;
            }
            let residual = &self.residual;
            self.factors.solve(|r| -residual[r], &mut self.step);
            let mut size = 0.0f64;
            for (k, &d) in self.dependent.iter().enumerate() {
                let step = self.step[k];
                // A step that is no number has no size.
                size = if step.is_nan() {
                    f64::NAN
                } else {
                    size.max(step.abs())
                };
                self.pose.u[d] += step;
            }
            all += size;
            if !(all <= FARTHEST) {
                return false;
            }
            self.pose.place(chain, &chain.order);
            if size <= SETTLED {
                self.pose.jacobian(chain, closures, &mut self.jacobian);
                return self.factored() && self.spread();
            }
        }
        false
    }

    /// Positions and velocities at (z, ż); after a failure those of `from` are the start.
    pub(super) fn set(
        &mut self,
        dynamics: &Dynamics,
        z: &[f64],
        speeds: &[f64],
        from: Option<&[f64]>,
    ) -> bool {
        if !self.close(dynamics, z) {
            let Some(from) = from else { return false };
            self.pose.u.copy_from_slice(from);
            let chain = &dynamics.chain;
            self.pose.place(chain, &chain.order);
            self.pose
                .jacobian(chain, 0..chain.closures.len(), &mut self.jacobian);
            if !(self.factored() && self.spread() && self.close(dynamics, z)) {
                self.pose.u.copy_from_slice(from);
                return false;
            }
        }
        self.set_rates(dynamics, speeds);
        true
    }

    /// Velocities, and accelerations for z̈ = 0, from ż.
    fn set_rates(&mut self, dynamics: &Dynamics, speeds: &[f64]) {
        let chain = &dynamics.chain;
        self.rates.fill(0.0);
        for (basis, speed) in self.basis.iter().zip(speeds) {
            let pairs = self.rates.iter_mut().zip(basis);
            pairs.for_each(|(r, b)| *r += b * speed);
        }
        self.flow.set(chain, &self.pose, [&self.rates, &self.zero]);
        if self.dependent.is_empty() {
            return;
        }
        self.flow
            .second(&self.pose, &chain.closures, &mut self.residual);
        let residual = &self.residual;
        self.factors.solve(|r| -residual[r], &mut self.step);
        self.bias.fill(0.0);
        for (k, &d) in self.dependent.iter().enumerate() {
            self.bias[d] = self.step[k];
        }
        self.flow.set(chain, &self.pose, [&self.rates, &self.bias]);
    }

    /// The forces in the closures, which do no work on the dependent unknowns together with this.
    pub(super) fn closing(&self, work: &[f64]) -> Vec<f64> {
        let mut sizes = vec![0.0; self.dependent.len()];
        let known: Vec<f64> = self.dependent.iter().map(|c| -work[*c]).collect();
        if !sizes.is_empty() {
            self.factors
                .solve_transposed_closely(&self.square, &known, &mut sizes);
        }
        sizes
    }

    /// z̈ at the positions and velocities that are set.
    pub(super) fn accelerations(
        &mut self,
        dynamics: &Dynamics,
        time: f64,
        out: &mut [f64],
    ) -> Result<(), DynamicsError> {
        let chain = &dynamics.chain;
        for (partial, basis) in self.partial.iter_mut().zip(&self.basis) {
            partial.set(chain, &self.pose, [basis, &self.zero]);
        }
        self.mass.fill(0.0);
        self.force.fill(0.0);
        let d = self.basis.len();
        let metres = chain.metres;
        for body in &dynamics.rigid {
            let [_, _, a] = self.flow.spot(&self.pose, body.centre);
            let alpha = self.flow.bodies[body.centre.body].turn[1];
            let active = (dynamics.gravity - a * metres) * body.kg;
            for i in 0..d {
                let v = self.partial[i].spot(&self.pose, body.centre)[1] * metres;
                let w = self.partial[i].bodies[body.centre.body].turn[0];
                self.force[i] += dot(active, v) - body.inertia * alpha * w;
                for j in 0..=i {
                    let vj = self.partial[j].spot(&self.pose, body.centre)[1] * metres;
                    let wj = self.partial[j].bodies[body.centre.body].turn[0];
                    self.mass[i * d + j] += body.kg * dot(v, vj) + body.inertia * w * wj;
                }
            }
        }
        let mut pushed = Pushed {
            pose: &self.pose,
            partial: &self.partial,
            force: &mut self.force,
            mass: &mut self.mass,
            metres,
        };
        Instant {
            dynamics,
            pose: &self.pose,
            flow: &self.flow,
            time,
        }
        .act(&mut pushed);
        if !self.force.iter().all(|x| x.is_finite()) {
            return Err(DynamicsError::Law { t: time });
        }
        out.copy_from_slice(&self.force);
        match cholesky(&mut self.mass, out) {
            true => Ok(()),
            false => Err(DynamicsError::NoInertia { t: time }),
        }
    }

    /// Velocities with the accelerations for z̈.
    pub(super) fn accelerated(&self, dynamics: &Dynamics, accelerations: &[f64]) -> Motion {
        let mut second = self.bias.clone();
        for (basis, a) in self.basis.iter().zip(accelerations) {
            second.iter_mut().zip(basis).for_each(|(s, b)| *s += b * a);
        }
        let mut motion = Motion::default();
        motion.set(&dynamics.chain, &self.pose, [&self.rates, &second]);
        motion
    }
}

/// Solves `M x = b` in place by the lower half of a symmetric matrix; `false` unless it is
/// certainly positive definite.
fn cholesky(m: &mut [f64], x: &mut [f64]) -> bool {
    let d = x.len();
    for j in 0..d {
        let diagonal = m[j * d + j];
        for k in 0..j {
            let l = m[j * d + k];
            m[j * d + j] -= l * l;
        }
        if !(m[j * d + j] > 1e-14 * diagonal) {
            return false;
        }
        let root = m[j * d + j].sqrt();
        m[j * d + j] = root;
        for i in j + 1..d {
            for k in 0..j {
                m[i * d + j] -= m[i * d + k] * m[j * d + k];
            }
            m[i * d + j] /= root;
        }
    }
    for i in 0..d {
        for k in 0..i {
            x[i] -= m[i * d + k] * x[k];
        }
        x[i] /= m[i * d + i];
    }
    for i in (0..d).rev() {
        for k in i + 1..d {
            x[i] -= m[k * d + i] * x[k];
        }
        x[i] /= m[i * d + i];
    }
    true
}

impl Dynamics {
    pub(super) fn displaced(&self, pose: &Pose, flow: &Motion, joint: usize) -> [f64; 2] {
        let part = self.description.joints.get(joint).map(|j| &j.part);
        let Some((point, guide)) = part.and_then(|p| p.guided()) else {
            return [f64::NAN; 2];
        };
        let metres = self.chain.metres;
        let [u, d] = flow.along(pose, rail(guide, metres), spot(point, metres));
        [
            dot(u[0], d[0]) * metres,
            (dot(u[1], d[0]) + dot(u[0], d[1])) * metres,
        ]
    }

    /// The row of a displacement by the unknowns.
    pub(super) fn displacement_row(&self, pose: &Pose, joint: usize, out: &mut Matrix) -> bool {
        let part = self.description.joints.get(joint).map(|j| &j.part);
        let Some((point, guide)) = part.and_then(|p| p.guided()) else {
            return false;
        };
        let metres = self.chain.metres;
        out.clear();
        let (rail, point) = (rail(guide, metres), spot(point, metres));
        pose.travelled(&self.chain, rail, point, 0, out);
        true
    }
}
