//! Closed loops, velocities, and accelerations at one moment.

use super::super::chain::{Chain, Closure, Entry, Travel, rail, spot};
use super::super::dense::{Factors, Matrix};
use super::super::motion::Motion;
use super::super::plane::dot;
use super::super::pose::Pose;
use super::forces::{Pushed, Sink, drive, load};
use super::{Dynamics, DynamicsError};
use num_complex::Complex64;

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

/// Closures are solved to a correction whose product with the way since the Jacobian is below this:
/// the next would be about that product.
const SETTLED: f64 = 1e-17;
/// A Jacobian is good for more corrections after a way that is shorter.
const NEAR: f64 = 5e-3;
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
    /// Bodies that the former move.
    placed: Vec<usize>,
    pub independent: Vec<usize>,
    jacobian: Matrix,
    factors: Factors,
    residual: Vec<f64>,
    step: Vec<f64>,
    /// The same among all unknowns.
    moved: Vec<f64>,
    /// Zero if the factors are those of the pose, infinite if they may be those of any other.
    astray: f64,
    /// `∂u/∂z_i` for each i.
    pub basis: Vec<Vec<f64>>,
    /// Partial velocities for each i.
    partial: Vec<Motion>,
    /// `u̇` and the part β of ü.
    pub rates: Vec<f64>,
    bias: Vec<f64>,
    /// Velocities and the accelerations for z̈ = 0.
    pub flow: Motion,
    /// Partial velocities of a centre of mass, and partial turns of its body.
    reach: Vec<(Complex64, f64)>,
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
            placed: Vec::new(),
            independent: Vec::new(),
            jacobian: Matrix::new(rows, n + 1),
            factors: Factors::default(),
            residual: Vec::new(),
            step: vec![0.0; rows],
            moved: vec![0.0; n],
            astray: f64::INFINITY,
            basis: vec![vec![0.0; n]; freedoms],
            partial: vec![Motion::default(); freedoms],
            rates: vec![0.0; n],
            bias: vec![0.0; n],
            flow: Motion::default(),
            reach: vec![(Complex64::ZERO, 0.0); freedoms],
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
        for (basis, &c) in self.basis.iter_mut().zip(&self.independent) {
            basis.fill(0.0);
            basis[c] = 1.0;
        }
        self.placed.clear();
        for &b in &chain.order {
            let moves = |k: usize| self.dependent.contains(&k);
            if chain.turns[b].unknown.is_some_and(moves) || self.hangs(chain.entries[b]) {
                self.placed.push(b);
            }
        }
        self.factored(chain) && self.spread()
    }

    /// Returns true if a body that hangs in this way moves with dependent unknowns, by its travel or
    /// by what it hangs on.
    fn hangs(&self, entry: Entry) -> bool {
        let (on, travel) = match entry {
            Entry::Ground => return false,
            Entry::Pin { on, .. } => (on.body, None),
            Entry::OnRail { rail, travel, .. } => (rail.body, Some(travel)),
            Entry::WithRail { on, travel, .. } => (on.body, Some(travel)),
        };
        let own = match travel {
            Some(Travel::Unknown(k)) => self.dependent.contains(&k),
            _ => false,
        };
        own || self.placed.contains(&on)
    }

    /// The Jacobian with its dependent columns factored.
    fn factored(&mut self, chain: &Chain) -> bool {
        self.pose
            .jacobian(chain, 0..chain.closures.len(), &mut self.jacobian);
        self.factors.of_columns(&self.jacobian, &self.dependent)
    }

    /// The basis: `J_D N_D = −J_I`.
    fn spread(&mut self) -> bool {
        let mut sum = 0.0;
        for (basis, &c) in self.basis.iter_mut().zip(&self.independent) {
            let jacobian = &self.jacobian;
            self.factors.solve(|r| -jacobian[(r, c)], &mut self.step);
            for (x, &d) in self.step.iter().zip(&self.dependent) {
                basis[d] = *x;
                sum += x;
            }
        }
        f64::is_finite(sum)
    }

    /// The largest entry of the basis: how much faster a dependent unknown moves than z.
    pub(super) fn amplification(&self) -> f64 {
        let all = self.basis.iter().flatten();
        all.fold(0.0, |m: f64, x| m.max(x.abs()))
    }

    /// The state (u, ż).
    pub(super) fn state(&self, out: &mut [f64]) {
        let rates = self.independent.iter().map(|c| self.rates[*c]);
        let all = self.pose.u.iter().copied().chain(rates);
        out.iter_mut().zip(all).for_each(|(out, x)| *out = x);
    }

    /// Closes the loops next to these unknowns, of which the independent ones are kept; `false` if
    /// that fails.
    fn close(&mut self, dynamics: &Dynamics, u: &[f64]) -> bool {
        let chain = &dynamics.chain;
        // The distance from the place of the Jacobian that is at hand.
        let ways = u.iter().zip(&self.pose.u).map(|(a, b)| (a - b).abs());
        let mut since = ways.fold(self.astray, |m, way| if way <= m { m } else { way });
        self.astray = f64::INFINITY;
        self.pose.u.copy_from_slice(u);
        self.pose.place(chain, &chain.order);
        if self.dependent.is_empty() {
            return u.iter().all(|u| u.is_finite());
        }
        self.moved.fill(0.0);
        let mut all = 0.0;
        for _ in 0..ROUNDS {
            if !(since <= NEAR) {
                if !self.factored(chain) {
                    return false;
                }
                since = 0.0;
            }
            self.pose
                .residual(chain, &chain.closures, &mut self.residual);
            let residual = &self.residual;
            self.factors.solve(|r| -residual[r], &mut self.step);
            let mut size = 0.0;
            for (step, &d) in self.step.iter().zip(&self.dependent) {
                // A step that is no number makes the sum none.
                size += step.abs();
                self.moved[d] = *step;
                self.pose.u[d] += step;
            }
            all += size;
            since += size;
            if !(all <= FARTHEST) {
                return false;
            }
            self.pose.turn_some_by(chain, &self.placed, &self.moved);
            if since * size <= SETTLED {
                let known = self.factored(chain) && self.spread();
                self.astray = if known { 0.0 } else { f64::INFINITY };
                return known;
            }
        }
        false
    }

    /// Positions next to these unknowns, and rates for ż; `false` if the loops do not close.
    pub(super) fn set(&mut self, dynamics: &Dynamics, u: &[f64], speeds: &[f64]) -> bool {
        if !self.close(dynamics, u) {
            return false;
        }
        self.rates.fill(0.0);
        for (basis, speed) in self.basis.iter().zip(speeds) {
            let pairs = self.rates.iter_mut().zip(basis);
            pairs.for_each(|(r, b)| *r += b * speed);
        }
        true
    }

    /// Velocities alone.
    pub(super) fn set_velocities(&mut self, dynamics: &Dynamics) {
        self.flow
            .set_first(&dynamics.chain, &self.pose, &self.rates);
    }

    /// Velocities, and accelerations for z̈ = 0.
    pub(super) fn set_bias(&mut self, dynamics: &Dynamics) {
        let chain = &dynamics.chain;
        self.bias.fill(0.0);
        self.flow.set(chain, &self.pose, [&self.rates, &self.bias]);
        if self.dependent.is_empty() {
            return;
        }
        self.flow
            .second(&self.pose, &chain.closures, &mut self.residual);
        let residual = &self.residual;
        self.factors.solve(|r| -residual[r], &mut self.step);
        for (k, &d) in self.dependent.iter().enumerate() {
            self.bias[d] = self.step[k];
        }
        self.flow.set(chain, &self.pose, [&self.rates, &self.bias]);
    }

    /// The forces in the closures, which do no work on the dependent unknowns together with this.
    pub(super) fn closing(&self, work: &[f64]) -> Vec<f64> {
        let mut sizes = vec![0.0; self.dependent.len()];
        let known: Vec<f64> = self.dependent.iter().map(|c| -work[*c]).collect();
        let rows = sizes.len();
        let mut square = Matrix::new(rows, rows);
        for r in 0..rows {
            for (k, c) in self.dependent.iter().enumerate() {
                square[(r, k)] = self.jacobian[(r, *c)];
            }
        }
        self.factors
            .solve_transposed_closely(&square, &known, &mut sizes);
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
            partial.set_first(chain, &self.pose, basis);
        }
        self.mass.fill(0.0);
        self.force.fill(0.0);
        let d = self.basis.len();
        let metres = chain.metres;
        for body in &dynamics.rigid {
            let [_, a] = self.flow.moved(&self.pose, body.centre);
            let alpha = self.flow.bodies[body.centre.body].turn[1];
            let active = (dynamics.gravity - a * metres) * body.kg;
            for (reach, partial) in self.reach.iter_mut().zip(&self.partial) {
                let v = partial.moved(&self.pose, body.centre)[0] * metres;
                *reach = (v, partial.bodies[body.centre.body].turn[0]);
            }
            for (i, (v, w)) in self.reach.iter().enumerate() {
                self.force[i] += dot(active, *v) - body.inertia * alpha * w;
                for (j, (vj, wj)) in self.reach[..=i].iter().enumerate() {
                    self.mass[i * d + j] += body.kg * dot(*v, *vj) + body.inertia * w * wj;
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

    /// Sets a motion to the velocities with the accelerations for z̈.
    pub(super) fn accelerated(&mut self, dynamics: &Dynamics, second: &[f64], out: &mut Motion) {
        let all = &mut self.moved;
        all.copy_from_slice(&self.bias);
        for (basis, a) in self.basis.iter().zip(second) {
            all.iter_mut().zip(basis).for_each(|(s, b)| *s += b * a);
        }
        out.set(&dynamics.chain, &self.pose, [&self.rates, all]);
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
