//! All assembly modes at one crank angle.
//!
//! With `u = C − O3`, `p(τ) = O3 − O5 + l4 τ` and `q(τ) = O3 − A + lB e^{iφB} τ`, where
//! `τ = e^{iφ4}`, the three binary links say
//!
//! ```text
//! |u| = l3,   |u + p| = l5,   |u + q| = l2 .
//! ```
//!
//! Subtracting the first square from the others leaves two linear equations,
//! `2 Re(u p̄) = P = l5² − l3² − |p|²` and `2 Re(u q̄) = Q = l2² − l3² − |q|²`, so that
//! `u = (P q − Q p)/(2i Im(p̄ q))` and
//!
//! ```text
//! T(φ4) = |P q − Q p|² − 4 l3² Im(p̄ q)² = 0,
//! ```
//!
//! a real trigonometric polynomial of degree 3 (degree 6 in τ): at most six modes.
//! Its zeros are bracketed between the angles of the six roots of T', where T is monotone. Where p
//! and q are parallel, two modes mirrored in them share φ4; T only touches zero there, so such
//! angles are looked at by themselves.

use super::geometry::{ClassIii, Lengths};
use super::loops::{cross, dot, unit};
use super::positions::{Positions, wrap};
use crate::units::Angle;
use num_complex::Complex64;
use std::sync::LazyLock;

/// Every real solution of the loop equations at one crank angle.
#[derive(Clone, Debug)]
pub struct AssemblyModes {
    /// The crank angle in radians.
    pub phi1: f64,
    /// The solutions, wrapped into (−π, π] and sorted by φ4; none if the linkage cannot be
    /// assembled here, up to six.
    pub modes: Vec<Positions>,
    /// Tells whether a pair of solutions is so close to merging that rounding may have added or
    /// removed it.
    pub near_fold: bool,
}

/// How far, in radians, a start may be off the mode that Newton's method finds from it.
const FARTHEST_START: f64 = 1e-2;

/// The polynomial T at one crank angle.
pub(super) struct Resultant<'a> {
    l: &'a Lengths,
    a: Complex64,
    p0: Complex64,
    q0: Complex64,
    q1: Complex64,
    p_const: f64,
    q_const: f64,
    /// The terms that P and Q are the sums of, at their largest.
    terms: [f64; 2],
}

/// Values of T and what else falls off.
struct Value {
    t: f64,
    /// A bound on the rounding error of `t`, roughly.
    noise: f64,
    u: Complex64,
    /// `2 l3 Im(p̄ q)`: `t = (|u|²/l3² − 1) right²`.
    right: f64,
    /// The lines that the two linear equations say u lies on.
    lines: [Line; 2],
}

/// The line `2 Re(u n̄) = c` of the plane of u.
#[derive(Clone, Copy, Debug)]
struct Line {
    normal: Complex64,
    c: f64,
    /// The terms that c is the sum of, at their largest.
    terms: f64,
}

impl Line {
    /// Returns what rounding may do to its distance from 0, `c / (2 |n|)`, up to a factor.
    fn doubt(self) -> f64 {
        self.terms / self.normal.norm()
    }

    /// Its points on the circle about 0; twice the nearest one if it passes by.
    fn on_circle(self, radius: f64) -> [Complex64; 2] {
        let length = self.normal.norm();
        let along = self.c / (2.0 * length);
        let across = ((radius - along) * (radius + along)).max(0.0).sqrt();
        let e = self.normal / length;
        [across, -across].map(|s| e * Complex64::new(along, s))
    }
}

impl Value {
    /// Returns whether the two lines meet at an angle. The noise of T is that of |u|²; where the
    /// lines touch the circle about O3, the direction of u has its square root. A start may be off
    /// by FARTHEST_START.
    fn determines_u(&self) -> bool {
        self.noise <= (FARTHEST_START * self.right).powi(2)
    }

    /// Where p and q are parallel, or one of them is hardly more than rounding: the line whose
    /// distance from O3 is the better known.
    fn better_line(&self) -> Line {
        let [p, q] = self.lines;
        if p.doubt() <= q.doubt() { p } else { q }
    }
}

impl<'a> Resultant<'a> {
    pub(super) fn new(l: &'a Lengths, e1: Complex64) -> Resultant<'a> {
        let a = e1 * l.l1;
        let p0 = l.o3 - l.o5;
        let q0 = l.o3 - a;
        let p_const = (l.l5 - l.l3) * (l.l5 + l.l3) - p0.norm_sqr() - l.l4 * l.l4;
        let q_const = (l.l2 - l.l3) * (l.l2 + l.l3) - q0.norm_sqr() - l.lb * l.lb;
        Resultant {
            l,
            a,
            p0,
            q0,
            q1: l.eb * l.lb,
            p_const,
            q_const,
            terms: [
                p_const.abs() + 2.0 * p0.norm() * l.l4,
                q_const.abs() + 2.0 * q0.norm() * l.lb,
            ],
        }
    }

    /// T alone.
    fn t(&self, theta: f64) -> f64 {
        let [(p, pp), (q, qq)] = self.equations(theta);
        let right = 2.0 * self.l.l3 * cross(p, q);
        (q * pp - p * qq).norm_sqr() - right * right
    }

    /// `(p, P)` and `(q, Q)`.
    #[inline]
    fn equations(&self, theta: f64) -> [(Complex64, f64); 2] {
        let tau = unit(theta);
        let p1 = tau * self.l.l4;
        let q1 = tau * self.q1;
        [
            (self.p0 + p1, self.p_const - 2.0 * dot(self.p0, p1)),
            (self.q0 + q1, self.q_const - 2.0 * dot(self.q0, q1)),
        ]
    }

    fn value(&self, theta: f64) -> Value {
        let [(p, pp), (q, qq)] = self.equations(theta);
        let n = q * pp - p * qq;
        let delta = cross(p, q);
        let squares = n.norm_sqr();
        let right = 2.0 * self.l.l3 * delta;
        let (np, nq) = (p.norm(), q.norm());
        let [p_terms, q_terms] = self.terms;
        let sizes = np * q_terms + nq * p_terms + 2.0 * self.l.l3 * np * nq;
        let line = |normal, c, terms| Line { normal, c, terms };
        Value {
            t: squares - right * right,
            noise: 16.0 * f64::EPSILON * sizes * sizes,
            u: n / Complex64::new(0.0, 2.0 * delta),
            right,
            lines: [line(p, pp, p_terms), line(q, qq, q_terms)],
        }
    }

    /// Coefficients c_0 … c_3 of `T = c_0 + 2 Re Σ c_k e^{ikθ}` from eight samples (exact for a
    /// polynomial of degree 3).
    fn coefficients(&self) -> [Complex64; 4] {
        const STEP: f64 = std::f64::consts::TAU / 8.0;
        /// `e^{−2πij/8}`.
        static ROOTS: LazyLock<[Complex64; 8]> =
            LazyLock::new(|| std::array::from_fn(|j| unit(-(j as f64) * STEP)));
        let samples: [f64; 8] = std::array::from_fn(|j| self.t(j as f64 * STEP));
        let roots = &*ROOTS;
        std::array::from_fn(|k| {
            let samples = samples.iter().enumerate();
            let sum: Complex64 = samples.map(|(j, &t)| roots[j * k % 8] * t).sum();
            sum / 8.0
        })
    }

    /// Angles at which T may stop being monotone: those of all roots of T', in ascending order.
    fn partition(&self) -> Vec<f64> {
        let c = self.coefficients();
        let i = Complex64::i();
        // T' = 2 Re Σ i k c_k e^{ikθ}, as a polynomial of degree 6 in τ times τ⁻³.
        let mut poly = [Complex64::new(0.0, 0.0); 7];
        for k in 1..=3 {
            let d = i * c[k] * k as f64;
            poly[3 + k] = d;
            poly[3 - k] = d.conj();
        }
        let mut angles: Vec<f64> = polynomial_roots(&poly).iter().map(|r| r.arg()).collect();
        angles.sort_by(f64::total_cmp);
        angles
    }

    /// Joint C − O3 for a zero of T: one value, or two if the linear equations do not determine it.
    fn candidates(&self, theta: f64) -> Vec<Complex64> {
        let v = self.value(theta);
        match v.determines_u() {
            true => vec![v.u],
            false => v.better_line().on_circle(self.l.l3).to_vec(),
        }
    }

    /// Values of φ4 at which one of the linear equations vanishes altogether, with the line that is
    /// left: `p(τ) = 0` if `|O3 − O5| = l4` (links 3 and 5 then move in parallel if they are of one
    /// length), `q(τ) = 0` if `|O3 − A| = lB`. T only touches zero there, so no sign change shows
    /// them.
    fn translations(&self) -> Vec<(f64, Line)> {
        let vanishing = |constant: Complex64, factor: Complex64| {
            let gap = (constant.norm() - factor.norm()).abs();
            (gap <= 1e-7 * factor.norm()).then(|| (-constant / factor).arg())
        };
        let left = |theta: f64, line: usize| (theta, self.value(theta).lines[line]);
        let l4 = Complex64::new(self.l.l4, 0.0);
        let p = vanishing(self.p0, l4).map(|theta| left(theta, 1));
        let q = vanishing(self.q0, self.q1).map(|theta| left(theta, 0));
        p.into_iter().chain(q).collect()
    }

    fn positions(&self, theta: f64, u: Complex64) -> Positions {
        let l = self.l;
        let tau = unit(theta);
        let c = l.o3 + u;
        Positions {
            phi2: (c + tau * self.q1 - self.a).arg(),
            phi3: u.arg(),
            phi4: theta,
            phi5: (c + tau * l.l4 - l.o5).arg(),
        }
    }

    /// The squared distance, in φ4, of the two zeros of T that are nearest to merging beside
    /// `theta`; negative once they have left the real circle. It passes through zero linearly at
    /// a fold. `T(θ*) + ½ T''(θ − θ*)² = 0` at the extremum θ* of T.
    pub(super) fn merging(&self, theta: f64) -> Option<(f64, f64)> {
        let nearest = self
            .partition()
            .into_iter()
            .map(|a| (wrap(a - theta).abs(), a));
        let (_, mut x) = nearest.min_by(|a, b| a.0.total_cmp(&b.0))?;
        let c = self.coefficients();
        let derivative = |x: f64, order: i32| -> f64 {
            (1..=3)
                .map(|k| {
                    let ik = Complex64::new(0.0, k as f64).powi(order);
                    2.0 * (ik * c[k] * unit(k as f64 * x)).re
                })
                .sum()
        };
        for _ in 0..3 {
            let step = derivative(x, 1) / derivative(x, 2);
            if step.is_finite() && step.abs() < 1e-3 {
                x -= step;
            }
        }
        let curvature = derivative(x, 2);
        let d = -8.0 * self.t(x) / curvature;
        d.is_finite().then_some((d, x))
    }
}

/// The zero of a function between two arguments where it has opposite signs, by Chandrupatla's
/// method: inverse quadratic interpolation where it can be trusted, bisection elsewhere; it never
/// leaves the bracket. T. R. Chandrupatla, Advances in Engineering Software 28 (1997) 145-149.
fn zero_between(f: impl Fn(f64) -> f64, [lo, hi]: [f64; 2], f_lo: f64) -> f64 {
    // The newest end of the bracket, the other one, and the end that was given up last.
    let (mut a, mut b) = ((hi, f(hi)), (lo, f_lo));
    let mut share = a.1 / (a.1 - b.1);
    for _ in 0..MOST_STEPS {
        let best = if a.1.abs() < b.1.abs() { a } else { b };
        let width = b.0 - a.0;
        // Of the width: a step is not smaller, so that both ends close in.
        let least = 2.0 * f64::EPSILON * (1.0 + best.0.abs()) / width.abs();
        if best.1 == 0.0 || !(least < 0.5) {
            return best.0;
        }
        let x = a.0 + share.clamp(least, 1.0 - least) * width;
        let new = (x, f(x));
        let c = match (new.1 > 0.0) == (a.1 > 0.0) {
            true => a,
            false => std::mem::replace(&mut b, a),
        };
        a = new;
        // Both quotients on [0, 1]: where the inverse is monotone between the three.
        let (xi, phi) = ((a.0 - b.0) / (c.0 - b.0), (a.1 - b.1) / (c.1 - b.1));
        share = match phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi {
            true => {
                let (of_b, of_c) = (a.1 / (b.1 - a.1), a.1 / (c.1 - a.1));
                of_b * (c.1 / (b.1 - c.1)) + (c.0 - a.0) / (b.0 - a.0) * of_c * (b.1 / (c.1 - b.1))
            }
            false => 0.5,
        };
    }
    a.0
}

/// Bisection alone would take no more.
const MOST_STEPS: usize = 200;

/// All roots of a polynomial with complex coefficients (lowest first) by Aberth's method, leading
/// and trailing zeros dropped.
fn polynomial_roots(coefficients: &[Complex64]) -> Vec<Complex64> {
    let largest = coefficients.iter().fold(0.0f64, |m, c| m.max(c.norm()));
    let tiny = |c: &Complex64| c.norm() <= largest * 1e-15;
    let start = coefficients.iter().position(|c| !tiny(c));
    let end = coefficients.iter().rposition(|c| !tiny(c));
    let (Some(start), Some(end)) = (start, end) else {
        return Vec::new();
    };
    let poly = &coefficients[start..=end];
    let mut z = starts(poly.len() - 1);
    aberth(poly, &mut z);
    z
}

/// The most rounds of Aberth's method.
const MOST_ROUNDS: usize = 100;

/// Where Aberth's method starts. The polynomials here are self-reciprocal, so near the unit circle;
/// no two starts mirror each other in it or in the real axis, or they would do so for ever.
fn starts(n: usize) -> Vec<Complex64> {
    (0..n)
        .map(|k| unit(0.4 + k as f64 * std::f64::consts::TAU / n as f64) * (1.0 + 0.03 * k as f64))
        .collect()
}

/// Moves `z` to the roots of a polynomial (lowest coefficient first) and returns the rounds it
/// took.
fn aberth(poly: &[Complex64], z: &mut [Complex64]) -> usize {
    let n = z.len();
    let horner = |z: Complex64| {
        let mut v = Complex64::new(0.0, 0.0);
        let mut d = v;
        for c in poly.iter().rev() {
            d = d * z + v;
            v = v * z + c;
        }
        (v, d)
    };
    for round in 0..MOST_ROUNDS {
        let mut moved = 0.0f64;
        for k in 0..n {
            let (v, d) = horner(z[k]);
            if v == Complex64::new(0.0, 0.0) {
                continue;
            }
            let ratio = v / d;
            let repulsion: Complex64 = (0..n)
                .filter(|&j| j != k)
                .map(|j| (z[k] - z[j]).inv())
                .sum();
            let step = ratio / (Complex64::new(1.0, 0.0) - ratio * repulsion);
            if !step.is_finite() {
                z[k] *= Complex64::new(1.0 + 1e-3, 1e-3);
                moved = 1.0;
                continue;
            }
            z[k] -= step;
            moved = moved.max(step.norm_sqr() / z[k].norm_sqr().max(f64::MIN_POSITIVE));
        }
        // Squared: no root moved by 1e-14 of itself.
        if moved < 1e-28 {
            return round + 1;
        }
    }
    MOST_ROUNDS
}

impl ClassIii {
    /// All assembly modes at the crank angle `phi1`.
    ///
    /// ```
    /// use mechaudit_solvers::class_iii::{ClassIii, Geometry};
    /// use mechaudit_solvers::units::{Angle, Length};
    /// let cm = Length::from_cm;
    /// let linkage = ClassIii::new(Geometry {
    ///     l1: cm(10.0), l2: cm(104.0), l3: cm(60.0), l4: cm(64.0), l5: cm(48.5),
    ///     lb: cm(22.0), phi_b: Angle::from_deg(-39.3),
    ///     x3: cm(75.0), y3: cm(93.0), x5: cm(128.5), y5: cm(103.5),
    /// })?;
    /// let found = linkage.assembly_modes(Angle::from_deg(14.426));
    /// assert_eq!(found.modes.len(), 4);
    /// assert!((found.modes[2].phi4.to_degrees() - 22.558).abs() < 1e-3);
    /// # Ok::<(), mechaudit_solvers::class_iii::GeometryError>(())
    /// ```
    pub fn assembly_modes(&self, phi1: Angle) -> AssemblyModes {
        let phi1 = phi1.rad();
        let e1 = unit(phi1);
        let resultant = Resultant::new(&self.l, e1);
        let angles = resultant.partition();
        let mut modes: Vec<Positions> = Vec::new();
        let mut near_fold = false;
        let values: Vec<Value> = angles.iter().map(|&a| resultant.value(a)).collect();
        let n = angles.len();
        for k in 0..n {
            let (lo, mut hi) = (angles[k], angles[(k + 1) % n]);
            let (a, b) = (&values[k], &values[(k + 1) % n]);
            if a.t.abs() <= a.noise {
                near_fold = true;
                // T only touches zero where p and q are parallel: two modes with one φ4.
                if !a.determines_u() {
                    let found = a.better_line().on_circle(self.l.l3);
                    self.collect(&resultant, e1, lo, &found, &mut modes);
                }
            }
            if k + 1 == n {
                hi += std::f64::consts::TAU;
            }
            if a.t == 0.0 || (a.t > 0.0) == (b.t > 0.0) {
                continue;
            }
            let theta = zero_between(|x| resultant.t(x), [lo, hi], a.t);
            let found = resultant.candidates(theta);
            self.collect(&resultant, e1, theta, &found, &mut modes);
        }
        for (theta, line) in resultant.translations() {
            let found = line.on_circle(self.l.l3);
            self.collect(&resultant, e1, theta, &found, &mut modes);
        }
        modes.sort_by(|a, b| a.phi4.total_cmp(&b.phi4));
        AssemblyModes {
            phi1,
            modes,
            near_fold,
        }
    }
}

impl ClassIii {
    /// Adds the modes with φ4 = `theta` that are not known yet.
    fn collect(
        &self,
        resultant: &Resultant,
        e1: Complex64,
        theta: f64,
        found: &[Complex64],
        modes: &mut Vec<Positions>,
    ) {
        for &u in found {
            let start = resultant.positions(theta, u);
            if let Some(p) = self.newton(e1, start) {
                let known = modes.iter().any(|m| m.distance(p) < 1e-9);
                if !known && p.distance(start) < FARTHEST_START {
                    modes.push(p.wrapped());
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::zinchenko;
    use super::*;

    #[test]
    fn the_modes_of_the_paper() {
        let found = zinchenko().assembly_modes(Angle::from_rad(14.426f64.to_radians()));
        assert!(!found.near_fold);
        let degrees: Vec<[f64; 4]> = found
            .modes
            .iter()
            .map(|m| m.to_array().map(f64::to_degrees))
            .collect();
        let expected = [
            [77.303, 148.798, -26.938, -170.014],
            [74.558, 158.246, 4.676, 159.539],
            [14.426, -76.174, 22.558, -65.721],
            [29.282, -76.641, 97.682, -173.547],
        ];
        assert_eq!(degrees.len(), 4);
        for (d, e) in degrees.iter().zip(expected) {
            for (x, y) in d.iter().zip(e) {
                assert!((x - y).abs() < 6e-4, "{degrees:?}");
            }
        }
    }
}

#[cfg(test)]
mod parts_tests;

#[cfg(test)]
mod translation_tests;

#[cfg(test)]
mod zero_tests;
