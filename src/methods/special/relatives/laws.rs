//! Identities of several relatives of the Faddeeva function, and the parts of their laws.

use super::{C, Relative};
use crate::audit::Law;
use crate::methods::common::held;
use crate::reference::Ball;
use num_complex::Complex;

/// u = 2⁻⁵³.
pub(in crate::methods::special) const U: f64 = f64::EPSILON / 2.0;

pub(in crate::methods::special) fn point(input: &[f64]) -> Option<C> {
    match input {
        &[x, y] => Some(Complex::new(x, y)),
        _ => None,
    }
}

/// The same bits, or both NaN.
pub(in crate::methods::special) fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan())
}

pub(in crate::methods::special) fn same_pair(a: C, b: C) -> bool {
    same(a.re, b.re) && same(a.im, b.im)
}

/// `f(−z) = −f(z)`, `f(z̄) = conj f(z)`, bit for bit.
fn odd(f: impl Fn(C) -> C, input: &[f64]) -> Option<f64> {
    let z = point(input)?;
    let value = f(z);
    held(same_pair(f(-z), -value) && same_pair(f(z.conj()), value.conj()))
}

/// `f(z̄) = conj f(z)`, bit for bit.
fn conjugation(f: impl Fn(C) -> C, input: &[f64]) -> Option<f64> {
    let z = point(input)?;
    held(same_pair(f(z.conj()), f(z).conj()))
}

pub(super) fn odd_law<F: Relative>() -> Law {
    Law {
        name: "symmetry",
        statement: "f(-z) = -f(z) and f(conj z) = conj f(z), bit for bit",
        residual: |input| odd(F::VALUE, input),
    }
}

pub(super) fn conjugation_law<F: Relative>() -> Law {
    Law {
        name: "conjugation",
        statement: "f(conj z) = conj f(z), bit for bit",
        residual: |input| conjugation(F::VALUE, input),
    }
}

/// The law of [`on_the_axis`].
pub(super) fn real_argument_law(residual: fn(&[f64]) -> Option<f64>) -> Law {
    Law {
        name: "real-argument",
        statement: "the function of a real argument agrees at Re z within 5 ulp",
        residual,
    }
}

/// How far the function of a real argument is from the complex one on the real axis: four units in the last place for
/// that one, and one for this, of which less than 7/8 is proved (erfi: found).
pub(super) fn on_the_axis(
    complex: impl Fn(C) -> C,
    real: impl Fn(f64) -> f64,
    input: &[f64],
) -> Option<f64> {
    let x = point(input)?.re;
    let (a, b) = (complex(Complex::new(x, 0.0)), real(x));
    if !a.re.is_finite() || !b.is_finite() {
        return held(same(a.re, b));
    }
    let ulp = (a.re.abs() * f64::EPSILON).max(f64::from_bits(1));
    held(a.im == 0.0).map(|r| r.max((a.re - b).abs() / (5.0 * ulp)))
}

/// The batch at the point and around it, of every length up to the longest, gives the scalar values.
pub(in crate::methods::special) fn batch_agrees(
    z: C,
    longest: usize,
    value: impl Fn(C) -> C,
    batch: impl Fn(&[C], &mut [C]) -> bool,
) -> Option<f64> {
    let n = 1 + (z.re.to_bits() ^ z.im.to_bits().rotate_left(7)) as usize % longest;
    let around = |k: usize| match k % 6 {
        0 => z,
        1 => -z,
        2 => z.conj(),
        3 => Complex::new(z.im, z.re),
        4 => Complex::new(z.re + k as f64 / 16.0, z.im - k as f64 / 32.0),
        _ => Complex::new(z.re * 0.5, z.im * 1.5),
    };
    let points: Vec<C> = (0..n).map(around).collect();
    let mut values = vec![C::default(); n];
    let done = batch(&points, &mut values);
    let mut pairs = points.iter().zip(&values);
    held(done && pairs.all(|(&z, &f)| same_pair(f, value(z))))
}

/// `factor · e^{−z²}` to 1e-30, for |z| ≤ 1e8.
pub(in crate::methods::special) fn gaussian(z: C, factor: i64) -> C {
    const PREC: u32 = 192;
    let (x, y) = (Ball::exact(PREC, z.re), Ball::exact(PREC, z.im));
    let e = ((&y - &x) * &(&y + &x)).exp() * &Ball::integer(PREC, factor);
    let (sin, cos) = (&x * &y).shift(1).sin_cos();
    Complex::new((&e * &cos).to_f64(), -(&e * &sin).to_f64())
}

/// f at z + h by the Taylor series at z, where `f′ = c − 2zf` and so all coefficients follow from f(z); for |z| ≤ 1e6.
pub(in crate::methods::special) fn equation(f: impl Fn(C) -> C, c: C, z: C) -> Option<f64> {
    let r = z.norm();
    if !(r <= 1e6) {
        return None;
    }
    // A step of about 1/(8|z|), or 1/8, turned by one radian; exact as a difference.
    let step = 0.125 / r.max(1.0);
    let to = C::new(z.re + 0.54 * step, z.im + 0.84 * step);
    let h = to - z;
    let (start, end) = (f(z), f(to));
    let size = start.norm() + end.norm() + h.norm();
    if !(size < 1e300) {
        return None;
    }
    // The terms c_n h^n, which stay of the size of f where the coefficients do not.
    let zh = z * h;
    let mut terms = [start, c * h - 2.0 * zh * start];
    let mut sum = terms[0] + terms[1];
    for n in 2..30 {
        let next = -(zh * terms[1] + h * h * terms[0]) * (2.0 / f64::from(n));
        terms = [terms[1], next];
        sum += next;
    }
    // 4 u of both values, the first grown by e^{1/4}, and some ten operations of the first terms with 1 u each, of the
    // size of h where f is smaller.
    within(sum - end, 16.0, size)
}

/// Whether products and sums of such values neither overflow nor lose digits to underflow.
pub(super) fn plain(values: &[C]) -> bool {
    values.iter().all(|v| (1e-290..1e290).contains(&v.norm()))
}

/// `‖rest‖` in units of `k u size`; nothing where the size is beyond what sums allow.
pub(super) fn within(rest: C, k: f64, size: f64) -> Option<f64> {
    (size < 1e307).then(|| rest.norm() / (k * U * size.max(f64::MIN_POSITIVE)))
}

#[cfg(test)]
mod tests;
