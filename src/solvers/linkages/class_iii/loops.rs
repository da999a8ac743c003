//! The loop equations, their residual, their Jacobian and the solution of linear systems with it.

use super::geometry::{ClassIii, Lengths};
use super::positions::Positions;
use nalgebra::{Matrix2, Vector2};
use num_complex::Complex64;

/// Unit vectors along the links at one configuration.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    pub e2: Complex64,
    pub e3: Complex64,
    pub e4: Complex64,
    /// Along C–B.
    pub e4b: Complex64,
    pub e5: Complex64,
}

pub(super) fn unit(phi: f64) -> Complex64 {
    let (s, c) = phi.sin_cos();
    Complex64::new(c, s)
}

pub(super) fn dot(a: Complex64, b: Complex64) -> f64 {
    a.re * b.re + a.im * b.im
}

/// `a × b`; also `(i a) · b` with `i a` the tangent of a.
pub(super) fn cross(a: Complex64, b: Complex64) -> f64 {
    a.re * b.im - a.im * b.re
}

impl Frame {
    pub(super) fn new(l: &Lengths, p: &Positions) -> Frame {
        let e4 = unit(p.phi4);
        Frame {
            e2: unit(p.phi2),
            e3: unit(p.phi3),
            e4,
            e4b: e4 * l.eb,
            e5: unit(p.phi5),
        }
    }
}

/// The Jacobian of the loop equations, reduced to two unknowns.
///
/// Projecting the first loop on e2 and the second on e5 removes φ2 and φ5, because the tangent of
/// a link is normal to it. What is left for (φ3, φ4) is the matrix of this struct; φ2 and φ5
/// follow from the projections on the tangents. A rotation of each loop's pair of equations loses
/// nothing, and `det J = l2 l5 det M`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Jacobian {
    pub m: Matrix2<f64>,
    lu: nalgebra::LU<f64, nalgebra::U2, nalgebra::U2>,
    frame: Frame,
    l: Lengths,
}

impl Jacobian {
    pub(super) fn new(l: &Lengths, f: &Frame) -> Jacobian {
        // tangent(a) · b = cross(a, b)
        let m = Matrix2::new(
            -l.l3 * cross(f.e3, f.e2),
            -l.lb * cross(f.e4b, f.e2),
            l.l3 * cross(f.e3, f.e5),
            l.l4 * cross(f.e4, f.e5),
        );
        Jacobian {
            m,
            lu: m.lu(),
            frame: *f,
            l: *l,
        }
    }

    /// The determinant of the 4 × 4 Jacobian, in m⁴.
    pub(super) fn determinant(&self) -> f64 {
        self.m.determinant() * self.l.l2 * self.l.l5
    }

    /// Solves `J x = (r1, r2)` for the angles (φ2, φ3, φ4, φ5); `None` when singular.
    pub(super) fn solve(&self, r1: Complex64, r2: Complex64) -> Option<[f64; 4]> {
        let (f, l) = (&self.frame, &self.l);
        let x = self.lu.solve(&Vector2::new(dot(r1, f.e2), dot(r2, f.e5)))?;
        let (x3, x4) = (x[0], x[1]);
        // Projections on the tangents: tangent(a) · tangent(b) = a · b.
        let x2 =
            (cross(f.e2, r1) + l.l3 * x3 * dot(f.e3, f.e2) + l.lb * x4 * dot(f.e4b, f.e2)) / l.l2;
        let x5 =
            -(cross(f.e5, r2) - l.l3 * x3 * dot(f.e3, f.e5) - l.l4 * x4 * dot(f.e4, f.e5)) / l.l5;
        let x = [x2, x3, x4, x5];
        x.iter().all(|v| v.is_finite()).then_some(x)
    }

    /// An upper bound on `‖J⁻¹‖`, from the larger of the two loops' Euclidean residuals to the
    /// largest angle; infinite when singular.
    pub(super) fn inverse_norm(&self) -> f64 {
        let l = &self.l;
        let Some(inv) = self.m.try_inverse() else {
            return f64::INFINITY;
        };
        let x3 = inv[(0, 0)].abs() + inv[(0, 1)].abs();
        let x4 = inv[(1, 0)].abs() + inv[(1, 1)].abs();
        let x2 = (1.0 + l.l3 * x3 + l.lb * x4) / l.l2;
        let x5 = (1.0 + l.l3 * x3 + l.l4 * x4) / l.l5;
        x2.max(x3).max(x4).max(x5)
    }
}

impl Lengths {
    /// A Lipschitz constant of J in the norms of [`Jacobian::inverse_norm`]: each loop's columns
    /// turn at the rate of their length.
    pub(super) fn lipschitz(&self) -> f64 {
        (self.l2 + self.l3 + self.lb).max(self.l3 + self.l4 + self.l5)
    }
}

/// Returns whether Newton's method is done after corrections of `last` and `size`: below 2⁻⁵⁰, or
/// below 1e-12 and no longer halved.
fn settled(size: f64, last: f64) -> bool {
    size <= f64::EPSILON * 4.0 || (size <= 1e-12 && size >= last * 0.5)
}

impl ClassIii {
    /// The residuals of the two loops, crank direction `e1` given.
    pub(super) fn residual(&self, e1: Complex64, f: &Frame) -> (Complex64, Complex64) {
        let l = &self.l;
        let c = l.o3 + f.e3 * l.l3;
        (
            e1 * l.l1 + f.e2 * l.l2 - c - f.e4b * l.lb,
            c + f.e4 * l.l4 - l.o5 - f.e5 * l.l5,
        )
    }

    /// Newton's method on the loop equations from `start`; `None` if it does not settle.
    pub(super) fn newton(&self, e1: Complex64, start: Positions) -> Option<Positions> {
        let mut p = start;
        let mut last = f64::INFINITY;
        for _ in 0..30 {
            let f = Frame::new(&self.l, &p);
            let (r1, r2) = self.residual(e1, &f);
            let d = Jacobian::new(&self.l, &f).solve(-r1, -r2)?;
            let size = d.iter().fold(0.0f64, |a, x| a.max(x.abs()));
            p = p.plus(d);
            if settled(size, last) {
                return Some(p);
            }
            if size > 10.0 {
                return None;
            }
            last = size;
        }
        // Beside a fold the corrections stay near the square root of the rounding error.
        (last < 1e-6).then_some(p)
    }
}

#[cfg(test)]
mod newton_tests;
