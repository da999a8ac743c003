//! W(z) for arguments that are not finite or so large that `|z|²` overflows.

use super::asymptotic::one_term;
use super::real_line::erfcx_far;
use crate::exponential::circle;
use crate::real::{ROUND, scaled};

/// `ROUND − k` for a coordinate within `[2^k, 2^(k+1))`: what scales it to about one.
fn to_one(a: f64) -> f64 {
    ROUND - ((a.to_bits() >> 52) as f64 - 1023.0)
}

/// `w(i b) = 1/(√π b)` for `b ≥ 10^100`: a quotient of pairs, whose roundings keep it from growing
/// with b.
#[cold]
#[inline(never)]
pub(super) fn on_imaginary_axis(b: f64) -> f64 {
    if !b.is_finite() {
        return huge(0.0, b).0;
    }
    let k = to_one(b);
    scaled(erfcx_far(scaled(b, k)).hi, k)
}

/// `(Re w, Im w)` at `a + i y`, `a ≥ 0`, for `|z| ≥ 10^100` and everything not finite.
#[cold]
#[inline(never)]
pub(super) fn huge(a: f64, y: f64) -> (f64, f64) {
    if a.is_nan() || y.is_nan() {
        // On the imaginary axis w is real whatever y is.
        return (f64::NAN, if a == 0.0 { 0.0 } else { f64::NAN });
    }
    let b = y.abs();
    // The direction z/|z|, scaled to about one: w ~ i/(√π z).
    let (u, v) = if a.is_infinite() || b.is_infinite() {
        (0.0, 0.0)
    } else {
        let k = to_one(a.max(b));
        let (p, q) = (scaled(a, k), scaled(b, k));
        let (re, im) = one_term(p, q);
        (scaled(re, k), scaled(im, k))
    };
    if y >= 0.0 {
        return (u, v);
    }
    // 2 e^{−z²} − w(−z).
    if a == 0.0 {
        return (f64::INFINITY, 0.0);
    }
    if b.is_infinite() {
        // The modulus grows beyond all bounds (or has no limit); the direction is not defined.
        return (f64::NAN, f64::NAN);
    }
    if a > b {
        // a² − b² ≥ |z| ulp(|z|) is far beyond 745.
        return (-u, v);
    }
    let (s, c) = circle(a, y);
    let (s, c) = (-s.hi, c.hi);
    if b > a {
        return (f64::INFINITY.copysign(c), f64::INFINITY.copysign(s));
    }
    // The phase 2a² is an integer below 2¹⁰⁷ times 2^e, 561 ≤ e ≤ 1943: by the continued fractions
    // of 2^e · 2/π it is nowhere within 3.8e-35 of a multiple of π/2, and w(−z), below 1e-100, does
    // not count.
    (2.0 * c, 2.0 * s)
}

#[cfg(test)]
mod tests;
