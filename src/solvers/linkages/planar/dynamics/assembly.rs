//! Positions at the start of a motion, from as many coordinates as there are degrees of freedom.

use super::super::chain::Closure;
use super::super::dense::{Factors, Matrix};
use super::super::plane::wrapped;
use super::super::pose::Pose;
use super::flow::Flow;
use super::{Dynamics, DynamicsError};
use crate::planar::GROUND;
use std::f64::consts::TAU;

/// A coordinate that is given at the start.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coordinate {
    /// The angle of a body, less that of another.
    Angle {
        /// The body.
        body: usize,
        /// The body that its angle is measured from.
        from: usize,
    },
    /// The displacement of a slide or slot, by the joint's number.
    Displacement {
        /// The joint.
        joint: usize,
    },
}

impl Coordinate {
    /// The angle of a body against the ground.
    pub fn angle(body: usize) -> Coordinate {
        let from = GROUND;
        Coordinate::Angle { body, from }
    }
}

/// A coordinate with its value and its rate, in radians or metres and seconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Given {
    /// Which.
    pub coordinate: Coordinate,
    /// Its value.
    pub value: f64,
    /// Its rate.
    pub speed: f64,
}

/// A position with velocities.
#[derive(Clone, Debug)]
pub struct Assembly {
    pub(super) u: Vec<f64>,
    pub(super) rates: Vec<f64>,
    /// The angle of each body in radians, the ground's first.
    pub angles: Vec<f64>,
}

/// The number of positions from which Newton's method is tried for each unknown that the loops
/// determine.
const STARTS: u32 = 40;
const MOST_STARTS: u32 = 400;
/// Corrections from one of them, and the longest one.
const ROUNDS: usize = 60;
const LONGEST: f64 = 0.7;
/// A correction that is rounding.
const SETTLED: f64 = 1e-13;
/// Unknowns that differ by less are those of one position.
const SAME: f64 = 1e-7;

/// The closures with the coordinates given, as many equations as unknowns.
struct Equations<'a> {
    dynamics: &'a Dynamics,
    given: &'a [Given],
    closures: usize,
    part: Matrix,
    row: Matrix,
    all: Matrix,
    factors: Factors,
    residual: Vec<f64>,
}

impl Equations<'_> {
    /// The residual and the Jacobian; `None` for a coordinate that no joint has.
    fn set(&mut self, pose: &Pose) -> Option<()> {
        let chain = &self.dynamics.chain;
        let n = chain.unknowns;
        pose.residual(chain, &chain.closures, &mut self.residual);
        if self.closures > 0 {
            pose.jacobian(chain, 0..chain.closures.len(), &mut self.part);
        }
        for r in 0..self.closures {
            (0..n).for_each(|c| self.all[(r, c)] = self.part[(r, c)]);
        }
        for (k, given) in self.given.iter().enumerate() {
            let r = self.closures + k;
            (0..n).for_each(|c| self.all[(r, c)] = 0.0);
            let here = match given.coordinate {
                Coordinate::Angle { body, from } => {
                    for (b, sign) in [(body, 1.0), (from, -1.0)] {
                        if let Some(c) = chain.turns[b].unknown {
                            self.all[(r, c)] += sign;
                        }
                    }
                    wrapped(pose.angle(chain, body) - pose.angle(chain, from) - given.value)
                }
                Coordinate::Displacement { joint } => {
                    if !self.dynamics.displacement_row(pose, joint, &mut self.row) {
                        return None;
                    }
                    (0..n).for_each(|c| self.all[(r, c)] = self.row[(0, c)]);
                    let still = super::super::motion::Motion::default();
                    let mut still = still;
                    let zero = vec![0.0; n];
                    still.set(chain, pose, [&zero, &zero]);
                    let [s, _] = self.dynamics.displaced(pose, &still, joint);
                    (s - given.value) / chain.metres
                }
            };
            self.residual.push(here);
        }
        Some(())
    }

    /// Newton's method with corrections of limited length.
    fn solve(&mut self, u: Vec<f64>) -> Option<Pose> {
        let chain = &self.dynamics.chain;
        let n = chain.unknowns;
        let mut pose = Pose::new(chain, 0.0, u);
        let mut step = vec![0.0; n];
        let mut last = f64::INFINITY;
        for _ in 0..ROUNDS {
            self.set(&pose)?;
            if n == 0 || !self.factors.of(&self.all, n, 0) {
                return None;
            }
            let residual = &self.residual;
            self.factors.solve(|r| -residual[r], &mut step);
            let size = step.iter().fold(
                0.0,
                |m: f64, s| if s.is_nan() { *s } else { m.max(s.abs()) },
            );
            if !size.is_finite() {
                return None;
            }
            let short = (LONGEST / size).min(1.0);
            pose.u
                .iter_mut()
                .zip(&step)
                .for_each(|(u, s)| *u += short * s);
            pose.place(chain, &chain.order);
            if size <= SETTLED || (size <= 1e-11 && size >= 0.5 * last) {
                return Some(pose);
            }
            last = size;
        }
        None
    }
}

impl Dynamics {
    /// The positions found with these coordinates, next to `near` (bodies with angles in radians)
    /// first, with the velocities. Newton's method starts there and at many other positions; that
    /// none is missing is not proved. Angles are those next to `near`, and within half a turn
    /// of zero for other bodies, where no gear or rack counts turns.
    ///
    /// # Errors
    /// [`DynamicsError::Freedoms`], [`DynamicsError::NotAssembled`],
    /// [`DynamicsError::SingularStart`].
    pub fn assemblies(
        &self,
        given: &[Given],
        near: &[(usize, f64)],
    ) -> Result<Vec<Assembly>, DynamicsError> {
        let chain = &self.chain;
        let n = chain.unknowns;
        if self.freedoms() != given.len() as i64 {
            return Err(DynamicsError::Freedoms {
                freedoms: self.freedoms(),
                given: given.len(),
            });
        }
        let closures: usize = chain.closures.iter().map(Closure::rows).sum();
        let mut equations = Equations {
            dynamics: self,
            given,
            closures,
            part: Matrix::new(closures, n + 1),
            row: Matrix::new(1, n + 1),
            all: Matrix::new(n, n),
            factors: Factors::default(),
            residual: Vec::new(),
        };
        let wanted = self.guess(given, near);
        let mut found: Vec<Pose> = Vec::new();
        let starts = match closures {
            0 => 1,
            _ => (STARTS * closures as u32).min(MOST_STARTS),
        };
        // The root of x^(n+1) = x + 1.
        let root = (0..50).fold(2.0f64, |x, _| (1.0 + x).powf(1.0 / (n + 1) as f64));
        for k in 0..starts {
            let u = (0..n).map(|c| self.spread(&wanted, root, c, k)).collect();
            let Some(pose) = equations.solve(u) else {
                continue;
            };
            let same = |p: &Pose| (0..n).all(|c| chain.apart(c, p.u[c], pose.u[c]) < SAME);
            if !found.iter().any(same) {
                found.push(pose);
            }
        }
        if found.is_empty() {
            return Err(DynamicsError::NotAssembled);
        }
        let off = |p: &Pose| {
            let bodies = near.iter();
            bodies.fold(0.0, |m: f64, (b, a)| {
                m.max(wrapped(p.angle(chain, *b) - a).abs())
            })
        };
        found.sort_by(|a, b| off(a).total_cmp(&off(b)));
        let all = found.into_iter().map(|pose| {
            let u = self.counted(&pose, &wanted);
            self.assembly(&mut equations, u)
        });
        all.collect()
    }

    /// Values of the unknowns as far as they are given or wanted.
    fn guess(&self, given: &[Given], near: &[(usize, f64)]) -> Vec<Option<f64>> {
        let chain = &self.chain;
        let mut wanted = vec![None; chain.unknowns];
        let mut set = |body: usize, angle: f64| {
            let turn = &chain.turns[body];
            if let Some(c) = turn.unknown {
                wanted[c] = Some(angle - turn.offset);
            }
        };
        near.iter().for_each(|(b, a)| set(*b, *a));
        for g in given {
            if let Coordinate::Angle { body, from: GROUND } = g.coordinate {
                set(body, g.value);
            }
        }
        wanted
    }

    /// The unknown c of the start k: the wanted value or zero first, then values of a sequence of
    /// low discrepancy (powers of the generalised golden ratio).
    fn spread(&self, wanted: &[Option<f64>], root: f64, c: usize, k: u32) -> f64 {
        if k == 0 {
            return wanted[c].unwrap_or(0.0);
        }
        let part = (0.5 + f64::from(k) * root.powi(-(c as i32 + 1))).fract() - 0.5;
        match self.chain.lengths[c] {
            true => 8.0 * part,
            false => TAU * part,
        }
    }

    /// Unknowns with angles by whole turns next to the wanted ones.
    fn counted(&self, pose: &Pose, wanted: &[Option<f64>]) -> Vec<f64> {
        let chain = &self.chain;
        let counts = |c: &Closure| matches!(c, Closure::Gears { .. } | Closure::Rack { .. });
        let mut u = pose.u.clone();
        if chain.closures.iter().any(counts) {
            return u;
        }
        for c in (0..u.len()).filter(|c| !chain.lengths[*c]) {
            let at = wanted[c].unwrap_or(0.0);
            u[c] = at + wrapped(u[c] - at);
        }
        u
    }

    /// The velocities at a position.
    fn assembly(&self, equations: &mut Equations, u: Vec<f64>) -> Result<Assembly, DynamicsError> {
        let chain = &self.chain;
        let n = chain.unknowns;
        let pose = Pose::new(chain, 0.0, u);
        let speeds = equations.given.iter().map(|g| match g.coordinate {
            Coordinate::Angle { .. } => g.speed,
            Coordinate::Displacement { .. } => g.speed / chain.metres,
        });
        let speeds: Vec<f64> = speeds.collect();
        let mut rates = vec![0.0; n];
        let determined = equations.set(&pose).is_some()
            && equations.factors.of(&equations.all, n, 0)
            && Flow::new(self, &pose.u).is_some();
        if !determined {
            return Err(DynamicsError::SingularStart);
        }
        let closures = equations.closures;
        let right = |r: usize| {
            if r < closures {
                0.0
            } else {
                speeds[r - closures]
            }
        };
        equations.factors.solve(right, &mut rates);
        if !rates.iter().all(|x| x.is_finite()) {
            return Err(DynamicsError::SingularStart);
        }
        let bodies = 0..chain.body_count();
        Ok(Assembly {
            angles: bodies.map(|b| pose.angle(chain, b)).collect(),
            u: pose.u,
            rates,
        })
    }
}
