//! The parts of laws of functions of a complex argument.

use super::complex::C;
use crate::methods::common::held;
use crate::reference::Ball;
use num_complex::Complex;

/// u = 2⁻⁵³.
pub(super) const U: f64 = f64::EPSILON / 2.0;

pub(super) fn point(input: &[f64]) -> Option<C> {
    match input {
        &[x, y] => Some(Complex::new(x, y)),
        _ => None,
    }
}

/// The same bits, or both NaN.
pub(super) fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan())
}

pub(super) fn same_pair(a: C, b: C) -> bool {
    same(a.re, b.re) && same(a.im, b.im)
}

/// The batch at the point and around it, of every length up to the longest, gives the scalar
/// values.
pub(super) fn batch_agrees(
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
pub(super) fn gaussian(z: C, factor: i64) -> C {
    const PREC: u32 = 192;
    let (x, y) = (Ball::exact(PREC, z.re), Ball::exact(PREC, z.im));
    let e = ((&y - &x) * &(&y + &x)).exp() * &Ball::integer(PREC, factor);
    let (sin, cos) = (&x * &y).shift(1).sin_cos();
    Complex::new((&e * &cos).to_f64(), -(&e * &sin).to_f64())
}

/// f at z + h by the Taylor series at z, where `f′ = c − 2zf` and so all coefficients follow from
/// f(z); for |z| ≤ 1e6.
pub(super) fn equation(f: impl Fn(C) -> C, c: C, z: C) -> Option<f64> {
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
    // 4 u of both values, the first grown by e^{1/4}, and some ten operations of the first terms
    // with 1 u each, of the size of h where f is smaller.
    within(sum - end, 16.0, size)
}

/// `‖rest‖` in units of `k u size`; nothing where the size is beyond what sums allow.
pub(super) fn within(rest: C, k: f64, size: f64) -> Option<f64> {
    (size < 1e307).then(|| rest.norm() / (k * U * size.max(f64::MIN_POSITIVE)))
}
