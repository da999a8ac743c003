//! Loops that close to double-double, and linear systems refined with them.
//!
//! Angles in `f64` and their sines leave the loops open by a rounding of every length, and the two
//! projections of a loop by another few. Where the links' directions nearly agree, derivatives
//! would show all of that several times. So a link's vector is `l e(φ) = l v (1 + η + iδ)` here,
//! with `v` the rounded sine and cosine, `η = (1 − |v|²)/2` what `v` is short of a unit vector, and
//! `δ` the turn that closes the loops: `J δ` is minus their residual, computed in double-double.
//! The rest of the residual is of the order of `δ²`. Derivatives are solved for in `f64` and
//! refined once with residuals in double-double (Higham, *Accuracy and Stability of Numerical
//! Algorithms*, 2nd ed., 12.1).

use super::geometry::Lengths;
use super::loops::{Frame, Jacobian};
use crate::double_double::{Dd, two_prod, two_sum};
use crate::lanes::{Lanes, Task};
use num_complex::Complex64;

/// A vector in the plane.
type Vector = [Dd; 2];

/// Turns in radians above which an angle does not close the loops but for rounding, and is left as
/// it is.
const OPEN: f64 = 1e-6;

/// The links' vectors: those of both loops, which close.
#[derive(Clone, Copy, Debug)]
pub(super) struct Links {
    /// O1–A.
    crank: Vector,
    /// A–B.
    second: Vector,
    /// O3–C.
    third: Vector,
    /// C–B.
    to_b: Vector,
    /// C–D.
    fourth: Vector,
    /// O5–D.
    fifth: Vector,
}

/// A sum of products, its leading part and what the rounding of that has lost.
#[derive(Clone, Copy)]
struct Sum(Dd);

impl Sum {
    const ZERO: Sum = Sum(Dd::ZERO);

    #[inline(always)]
    fn plus(self, a: f64) -> Sum {
        let s = two_sum(self.0.hi, a);
        Sum(Dd::new(s.hi, self.0.lo + s.lo))
    }

    #[inline(always)]
    fn plus_product(self, a: Dd, b: Dd) -> Sum {
        let p = two_prod(a.hi, b.hi);
        let s = two_sum(self.0.hi, p.hi);
        let tails = a.hi.mul_add(b.lo, a.lo.mul_add(b.hi, p.lo));
        Sum(Dd::new(s.hi, self.0.lo + (s.lo + tails)))
    }

    #[inline(always)]
    fn value(self) -> f64 {
        self.0.value()
    }
}

/// `(1 − |v|²)/2` of a vector whose length is one but for rounding.
#[inline(always)]
fn shortness(v: Complex64) -> f64 {
    let (x, y) = (two_prod(v.re, v.re), two_prod(v.im, v.im));
    let s = two_sum(x.hi, y.hi);
    ((1.0 - s.hi) - s.lo - x.lo - y.lo) * 0.5
}

/// `z v (1 + η)` where `z` is real or complex.
#[inline(always)]
fn times_unit(z: Vector, v: Complex64) -> Vector {
    let eta = shortness(v);
    let (x, y) = (Dd::from(v.re), Dd::from(v.im));
    let re = Sum::ZERO.plus_product(z[0], x).plus_product(z[1], -y).0;
    let im = Sum::ZERO.plus_product(z[0], y).plus_product(z[1], x).0;
    [re, im].map(|t| Dd::new(t.hi, t.hi.mul_add(eta, t.lo)))
}

/// Turned by a small angle.
#[inline(always)]
fn turned([x, y]: Vector, delta: f64) -> Vector {
    [
        Dd::new(x.hi, (-delta).mul_add(y.hi, x.lo)),
        Dd::new(y.hi, delta.mul_add(x.hi, y.lo)),
    ]
}

impl Links {
    /// The vectors along the frame, not yet turned.
    #[inline(always)]
    fn along(l: &Lengths, e1: Complex64, f: &Frame) -> Links {
        let real = |l: f64| [Dd::from(l), Dd::ZERO];
        let arm = times_unit(real(l.lb), l.eb);
        Links {
            crank: times_unit(real(l.l1), e1),
            second: times_unit(real(l.l2), f.e2),
            third: times_unit(real(l.l3), f.e3),
            to_b: times_unit(arm, f.e4),
            fourth: times_unit(real(l.l4), f.e4),
            fifth: times_unit(real(l.l5), f.e5),
        }
    }

    /// Returns what the loops are open by.
    #[inline(always)]
    fn gap(&self, l: &Lengths) -> [Complex64; 2] {
        let one = Dd::from(1.0);
        let first = |i: usize, pivot: f64| {
            let s = Sum::ZERO.plus(-pivot).plus_product(self.crank[i], one);
            let s = s.plus_product(self.second[i], one);
            let s = s.plus_product(-self.third[i], one);
            s.plus_product(-self.to_b[i], one).value()
        };
        let second = |i: usize, from: f64, to: f64| {
            let s = Sum::ZERO.plus(from).plus(-to);
            let s = s.plus_product(self.third[i], one);
            let s = s.plus_product(self.fourth[i], one);
            s.plus_product(-self.fifth[i], one).value()
        };
        let (o3, o5) = (l.o3, l.o5);
        [
            Complex64::new(first(0, o3.re), first(1, o3.im)),
            Complex64::new(second(0, o3.re, o5.re), second(1, o3.im, o5.im)),
        ]
    }

    /// `Σ a_k x_k` over each loop, with the signs of the loops: of links 2, 3, 4, 5.
    #[inline(always)]
    fn around(&self, start: [Sum; 4], x: [Dd; 4]) -> [Sum; 4] {
        let [x2, x3, x4, x5] = x;
        let first = |i: usize| {
            let s = start[i].plus_product(self.second[i], x2);
            let s = s.plus_product(self.third[i], -x3);
            s.plus_product(self.to_b[i], -x4)
        };
        let second = |i: usize| {
            let s = start[2 + i].plus_product(self.third[i], x3);
            let s = s.plus_product(self.fourth[i], x4);
            s.plus_product(self.fifth[i], -x5)
        };
        [first(0), first(1), second(0), second(1)]
    }

    /// The unit vectors along the links.
    #[inline(always)]
    fn frame(&self, l: &Lengths) -> Frame {
        let unit = |v: Vector, l: f64| Complex64::new(v[0].value() / l, v[1].value() / l);
        Frame {
            e2: unit(self.second, l.l2),
            e3: unit(self.third, l.l3),
            e4: unit(self.fourth, l.l4),
            e4b: unit(self.to_b, l.lb),
            e5: unit(self.fifth, l.l5),
        }
    }
}

/// The sum of two numbers, the second of which is small.
#[inline(always)]
fn refined(x: [f64; 4], dx: [f64; 4]) -> [Dd; 4] {
    std::array::from_fn(|k| two_sum(x[k], dx[k]))
}

/// The links' vectors that close the loops, the frame along them, and the first derivatives.
pub(super) struct Closing<'a> {
    pub l: &'a Lengths,
    pub e1: Complex64,
    pub frame: &'a Frame,
    pub jacobian: &'a Jacobian,
}

impl Task for Closing<'_> {
    type Output = Option<(Links, Frame, [Dd; 4])>;

    #[inline(always)]
    fn run<L: Lanes>(self, _: L) -> Self::Output {
        let (l, jacobian) = (self.l, self.jacobian);
        let mut links = Links::along(l, self.e1, self.frame);
        let [g1, g2] = links.gap(l);
        let delta = jacobian.solve(-g1, -g2)?;
        if delta.iter().all(|d| d.abs() < OPEN) {
            let [d2, d3, d4, d5] = delta;
            links = Links {
                crank: links.crank,
                second: turned(links.second, d2),
                third: turned(links.third, d3),
                to_b: turned(links.to_b, d4),
                fourth: turned(links.fourth, d4),
                fifth: turned(links.fifth, d5),
            };
        }
        // J x = (−i l1 e1, 0), with i times the sum around each loop for J x.
        let by_minus_i = |re: f64, im: f64| Complex64::new(im, -re);
        let crank = links.crank.map(|x| x.value());
        let x = jacobian.solve(by_minus_i(crank[0], crank[1]), Complex64::new(0.0, 0.0))?;
        let [c0, c1] = links.crank.map(Sum);
        let left = links.around([c0, c1, Sum::ZERO, Sum::ZERO], x.map(Dd::from));
        let [p, q, r, s] = left.map(Sum::value);
        let dx = jacobian.solve(by_minus_i(p, q), by_minus_i(r, s))?;
        Some((links, links.frame(l), refined(x, dx)))
    }
}

/// The second derivatives: `J x = Σ a_k φ_k'²` around each loop, the crank's with it.
pub(super) struct Accelerations<'a> {
    pub links: &'a Links,
    pub first: &'a [Dd; 4],
    pub jacobian: &'a Jacobian,
}

impl Task for Accelerations<'_> {
    type Output = Option<[f64; 4]>;

    #[inline(always)]
    fn run<L: Lanes>(self, _: L) -> Self::Output {
        let (links, jacobian) = (self.links, self.jacobian);
        let [c0, c1] = links.crank.map(Sum);
        let start = [c0, c1, Sum::ZERO, Sum::ZERO];
        let due = links.around(start, self.first.map(Dd::square));
        let [p, q, r, s] = due.map(Sum::value);
        let x = jacobian.solve(Complex64::new(p, q), Complex64::new(r, s))?;
        // i (a, b) = (−b, a).
        let [p, q, r, s] = links.around([Sum::ZERO; 4], x.map(Dd::from)).map(|t| t.0);
        let less = |due: Sum, t: Dd| {
            let one = Dd::from(1.0);
            due.plus_product(t, one).value()
        };
        let r1 = Complex64::new(less(due[0], q), less(due[1], -p));
        let r2 = Complex64::new(less(due[2], s), less(due[3], -r));
        let dx = jacobian.solve(r1, r2)?;
        let x = refined(x, dx).map(Dd::value);
        x.iter().all(|v| v.is_finite()).then_some(x)
    }
}

#[cfg(test)]
mod tests;
