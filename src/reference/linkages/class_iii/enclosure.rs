//! Krawczyk's operator on the distance equations.
//!
//! For an approximate zero z and an approximate inverse Y of the Jacobian, let
//! `K(X) = z − Y F(z) + (I − Y F'(X)) (X − z)` over a box X around z. If `K(X)` lies in the
//! interior of X, F has exactly one zero in X, and it lies in `K(X)` (Krawczyk, *Computing* 4
//! (1969) 187–201; Neumaier, *Interval Methods for Systems of Equations*, 1990, Thm 5.1.8). Y is
//! an `f64` matrix taken as exact; a bad one can only make the test fail.

use super::Linkage;
use crate::{Ball, ComplexBall, Mag};
use nalgebra::Matrix4;
use rug::Float;

/// Joints at one crank angle (or over an interval of crank angles).
#[derive(Clone, Debug)]
pub struct Configuration {
    /// Crank direction `e(φ1)`.
    pub e1: ComplexBall,
    /// Crank pin A.
    pub a: ComplexBall,
    /// Joint B.
    pub b: ComplexBall,
    /// Joint C.
    pub c: ComplexBall,
    /// Joint D.
    pub d: ComplexBall,
}

/// Precision of what only has to contract: the approximate inverse, boxes and arcs.
const BITS: u32 = 64;

/// Arcs are halved so often until there is no proof.
const HALVINGS: u32 = 20;

/// Coordinates (Cx, Cy, Dx, Dy).
pub(super) type Point4 = [Float; 4];

/// Joints C and D.
fn joints(z: &Point4, part: impl Fn(&Float) -> Ball) -> (ComplexBall, ComplexBall) {
    let [cx, cy, dx, dy] = z.each_ref().map(part);
    (ComplexBall::new(cx, cy), ComplexBall::new(dx, dy))
}

fn boxed(z: &Point4, r: Mag) -> (ComplexBall, ComplexBall) {
    joints(z, |x| Ball::new(x.clone(), r).with_prec(BITS))
}

/// `Y v`.
fn apply(y: &Matrix4<f64>, v: &[Ball; 4]) -> [Ball; 4] {
    std::array::from_fn(|i| {
        let mut sum = Ball::integer(BITS, 0);
        for (j, x) in v.iter().enumerate() {
            sum = sum + &Ball::exact(BITS, y[(i, j)]) * x;
        }
        sum
    })
}

impl Linkage {
    /// Joint B from C and D.
    pub(super) fn joint_b(&self, c: &ComplexBall, d: &ComplexBall) -> ComplexBall {
        &(&self.one_minus_kappa * c) + &(&self.kappa * d)
    }

    /// Half the residuals of the distance equations.
    fn residual(&self, a: &ComplexBall, c: &ComplexBall, d: &ComplexBall) -> [Ball; 4] {
        let b = self.joint_b(c, d);
        let excess = |p: &ComplexBall, l: &Ball| (p.norm_sqr() - l.square()).shift(-1);
        [
            excess(&(c - &self.o3), &self.l3),
            excess(&(d - &self.o5), &self.l5),
            excess(&(d - c), &self.l4),
            excess(&(&b - a), &self.l2),
        ]
    }

    /// Half the Jacobian, rows as in [`Linkage::residual`], columns (Cx, Cy, Dx, Dy).
    pub(super) fn jacobian(
        &self,
        a: &ComplexBall,
        c: &ComplexBall,
        d: &ComplexBall,
    ) -> [[Ball; 4]; 4] {
        let zero = || Ball::integer(BITS, 0);
        let (u, v, w) = (c - &self.o3, d - &self.o5, d - c);
        let arm = &self.joint_b(c, d) - a;
        // B = (1 − κ) C + κ D, so the gradient of ½|B − A|² is conj(1 − κ) arm, conj(κ) arm.
        let gc = &self.one_minus_kappa.conj() * &arm;
        let gd = &self.kappa.conj() * &arm;
        [
            [u.re, u.im, zero(), zero()],
            [zero(), zero(), v.re, v.im],
            [-&w.re, -&w.im, w.re, w.im],
            [gc.re, gc.im, gd.re, gd.im],
        ]
    }

    pub(super) fn approximate_inverse(&self, a: &ComplexBall, z: &Point4) -> Option<Matrix4<f64>> {
        let (c, d) = boxed(z, Mag::ZERO);
        let j = self.jacobian(a, &c, &d);
        let m = Matrix4::from_fn(|i, k| j[i][k].mid().to_f64());
        m.try_inverse().filter(|y| y.iter().all(|x| x.is_finite()))
    }

    /// An upper bound on `‖I − Y F'(X)‖∞`.
    pub(super) fn contraction(
        &self,
        y: &Matrix4<f64>,
        a: &ComplexBall,
        c: &ComplexBall,
        d: &ComplexBall,
    ) -> Mag {
        let j = self.jacobian(a, c, d);
        let entry = |i: usize, k: usize| {
            let one = Ball::integer(BITS, i64::from(i == k));
            let terms = (0..4).map(|m| Ball::exact(BITS, y[(i, m)]) * &j[m][k]);
            terms.fold(one, |e, term| e - term).magnitude()
        };
        let row = |i: usize| (0..4).fold(Mag::ZERO, |sum, k| sum.add(entry(i, k)));
        (0..4).fold(Mag::ZERO, |norm, i| norm.max(row(i)))
    }

    /// `Y F(z)`, and the largest upper bound of a component.
    fn step(&self, y: &Matrix4<f64>, a: &ComplexBall, z: &Point4) -> ([Ball; 4], Mag) {
        let (c, d) = joints(z, |x| Ball::new(x.clone(), Mag::ZERO));
        let step = apply(y, &self.residual(a, &c, &d));
        let size = step.iter().fold(Mag::ZERO, |m, x| m.max(x.magnitude()));
        (step, size)
    }

    /// The joints for the crank direction `e1`, enclosed around the zero that the chord method
    /// finds from `guess`; `None` if Krawczyk's test fails at this precision.
    pub(super) fn enclose(&self, e1: &ComplexBall, guess: &Point4) -> Option<Configuration> {
        let a = e1.scaled(&self.l1);
        let mut z: Point4 = std::array::from_fn(|i| Float::with_val(self.bits, &guess[i]));
        let mut y = self.approximate_inverse(&a, &z)?;
        let mut last = Mag::INFINITY;
        // Each round gains some 40 bits or more; the count is only a guard.
        for round in 0..self.bits {
            let (step, size) = self.step(&y, &a, &z);
            // Settled: the step is rounding, or not finite, and no longer shrinks.
            if round > 1 && size >= last.shift(-1) {
                break;
            }
            for i in 0..4 {
                z[i] -= step[i].mid();
            }
            if round < 4 {
                y = self.approximate_inverse(&a, &z)?;
            }
            last = size;
        }
        let (step, size) = self.step(&y, &a, &z);
        // Where the zero is hit exactly, any box shows that it is alone.
        let r = match size.is_zero() {
            true => Mag::power_of_two(-i64::from(self.bits)),
            false => size.shift(2),
        };
        let (bc, bd) = boxed(&z, r);
        let contraction = self.contraction(&y, &a, &bc, &bd);
        let reach = size.add(contraction.mul(r));
        if !(reach < r) {
            return None;
        }
        let ball = |i: usize| {
            // z − Y F(z) + (I − Y F'(X)) (X − z): keep z as midpoint, both terms in the radius.
            let rad = step[i].magnitude().add(contraction.mul(r));
            Ball::new(z[i].clone(), rad)
        };
        let c = ComplexBall::new(ball(0), ball(1));
        let d = ComplexBall::new(ball(2), ball(3));
        Some(Configuration {
            e1: e1.clone(),
            b: self.joint_b(&c, &d),
            a,
            c,
            d,
        })
    }

    /// Returns whether two enclosed configurations lie on one branch over the crank angles between
    /// them: Krawczyk's test on a box that holds both, with the crank pin anywhere on its arc,
    /// proves one and only one configuration in the box for every crank angle on the way.
    pub(super) fn joined(
        &self,
        arc: &ComplexBall,
        from: &Configuration,
        to: &Configuration,
    ) -> bool {
        let a = arc.scaled(&self.l1);
        let [p, q] = [from, to].map(|at| at.balls().map(|b| b.with_prec(BITS)));
        let ends: [Ball; 4] = std::array::from_fn(|i| p[i].union(&q[i]));
        let z: Point4 = std::array::from_fn(|i| ends[i].mid().clone());
        let Some(y) = self.approximate_inverse(&a, &z) else {
            return false;
        };
        let (_, size) = self.step(&y, &a, &z);
        let need = ends.iter().fold(size, |m, e| m.max(e.rad()));
        // Room for the curvature of the path and for the contraction.
        let r = need.mul(Mag::from_f64(1.5));
        let (bc, bd) = boxed(&z, r);
        let contraction = self.contraction(&y, &a, &bc, &bd);
        size.add(contraction.mul(r)) < r
    }

    /// Follows the branch from `from` at the crank angle `phi_from` to `phi_to`; `None` when the
    /// proof fails even on arcs of 2⁻²⁰ rad (a fold, or a lack of precision).
    pub fn follow(
        &self,
        from: &Configuration,
        phi_from: &Ball,
        phi_to: &Ball,
    ) -> Option<Configuration> {
        self.follow_from(from, phi_from, phi_to, None)
    }

    /// [`Linkage::follow`] with a first guess for the joints (C, D) at the end; a bad guess costs
    /// time, never truth.
    pub fn follow_from(
        &self,
        from: &Configuration,
        phi_from: &Ball,
        phi_to: &Ball,
        mut guess: Option<[Float; 4]>,
    ) -> Option<Configuration> {
        let mut here = from.clone();
        let mut at = phi_from.clone();
        loop {
            let mut next = phi_to.clone();
            let mut left = HALVINGS;
            loop {
                let e1 = ComplexBall::unit(&next);
                let start = guess.take().unwrap_or_else(|| here.coordinates());
                let arc = ComplexBall::unit(&at.with_prec(BITS).union(&next.with_prec(BITS)));
                let found = self.enclose(&e1, &start);
                if let Some(found) = found
                    && self.joined(&arc, &here, &found)
                {
                    here = found;
                    break;
                }
                left = left.checked_sub(1)?;
                // Half the arc; any intermediate angle will do, so its midpoint is taken as exact.
                let middle = (&at + &next).shift(-1);
                next = Ball::new(middle.mid().clone(), Mag::ZERO);
            }
            if next.mid() == phi_to.mid() {
                return Some(here);
            }
            at = next;
        }
    }

    /// The configuration near approximate joints C and D, enclosed.
    pub fn near(&self, phi1: &Ball, c: [f64; 2], d: [f64; 2]) -> Option<Configuration> {
        let guess = [c[0], c[1], d[0], d[1]].map(|x| Float::with_val(self.bits, x));
        self.enclose(&ComplexBall::unit(phi1), &guess)
    }
}

impl Configuration {
    /// Midpoints of (Cx, Cy, Dx, Dy).
    pub fn coordinates(&self) -> [Float; 4] {
        self.balls().map(|b| b.mid().clone())
    }

    /// Cx, Cy, Dx, Dy.
    pub(crate) fn balls(&self) -> [&Ball; 4] {
        [&self.c.re, &self.c.im, &self.d.re, &self.d.im]
    }
}
