//! Phases in double-double and their sines and cosines.

use crate::solvers::faddeeva::double_double::Dd;
use crate::solvers::faddeeva::exponential::{LARGE_PHASE, reduce, sin_cos_reduced, turn};
use crate::solvers::faddeeva::payne_hanek;
use crate::solvers::faddeeva::real::ROUND;
use num_complex::Complex;

/// `√x` for `x ≥ 0`, relative error about 2⁻¹⁰⁴.
pub(super) fn sqrt(x: Dd) -> Dd {
    let s = x.hi.sqrt();
    if s == 0.0 {
        return Dd::ZERO;
    }
    let rest = (-s).mul_add(s, x.hi) + x.lo;
    Dd::new(s, rest / (2.0 * s)).normal()
}

/// `x` modulo π/2, for phases of any size: the rest and `ROUND` plus the quadrant.
#[cold]
#[inline(never)]
fn reduce_large(x: Dd) -> (Dd, f64) {
    let part = |x: f64| match x.abs() < LARGE_PHASE {
        true => reduce(Dd::from(x)),
        // 2 a y with a = |x| and y = ±1/2.
        false => payne_hanek::reduce(x.abs(), 0.5f64.copysign(x)),
    };
    let ((r, m), (s, n)) = (part(x.hi), part(x.lo));
    let (rest, last) = reduce(r + s);
    // Quadrants count modulo four.
    let quadrant = (m - ROUND).rem_euclid(4.0) + (n - ROUND).rem_euclid(4.0);
    (rest, last + quadrant)
}

/// `e^{ix}`, rounded once.
#[inline(always)]
pub(super) fn circle(x: Dd) -> Complex<f64> {
    let (rest, quadrant) = match x.hi.abs() < LARGE_PHASE {
        true => reduce(x),
        false => reduce_large(x),
    };
    let (sin, cos) = sin_cos_reduced(rest);
    let (sin, cos) = turn(sin, cos, quadrant);
    Complex::new(cos.value(), sin.value())
}

/// `e^{−x}` for `x ≥ 0`, without the error of a rounded `x`.
#[inline(always)]
pub(super) fn decay(x: Dd) -> f64 {
    let e = (-x.hi).exp();
    (-x.lo).mul_add(e, e)
}
