//! Formulas of erf, erfc, erfcx and Dawson's function of a real argument, for any type of number,
//! as sums of two that are not rounded to one yet.

use super::constants::{HALF_SQRT_PI, INV_SQRT_PI};
use super::erfc_rows;
use super::odd_series::{DAWSON, odd_real};
use super::rows::REAL_AXIS_PITCH;
use crate::double_double::{Dd, fast_two_sum, two_prod};
use crate::exponential::exp;
use crate::real::Real;

/// |x| below which Dawson's function is a Maclaurin series.
pub(super) const SERIES: f64 = 0.5;
/// |x| from which |erf x| rounds to 1.
pub(super) const ONE: f64 = 6.0 - 0.5 * REAL_AXIS_PITCH;
/// |x| from which erfc x is computed from erfcx x, erfc −|x| rounds to 2, and erfcx −|x| is
/// `2e^{x²}`.
pub(super) const BEYOND: f64 = erfc_rows::END;
/// |x| from which erfc x rounds to 0 or 2; beyond it `e^{x²}` overflows.
pub(super) const FAR: f64 = 30.0;

/// `e^{x²}` as a mantissa and `ROUND` plus the exponent.
#[inline(always)]
pub(super) fn growth<R: Real>(x: R) -> (Dd<R>, R) {
    exp(two_prod(x, x))
}

/// erfc −x from erfc x.
#[inline(always)]
pub(super) fn erfc_left<R: Real>(right: Dd<R>) -> Dd<R> {
    let s = fast_two_sum(right.hi.like(2.0), -right.hi);
    Dd::new(s.hi, s.lo - right.lo)
}

/// erfc x for [`BEYOND`] `≤ x <` [`FAR`], from erfcx x, as a mantissa and `ROUND` plus the
/// exponent.
#[inline(always)]
pub(super) fn erfc_right<R: Real>(x: R, w: Dd<R>) -> (Dd<R>, R) {
    let (e, n) = exp(-two_prod(x, x));
    (e * w, n)
}

/// `1/(√π x)`, erfcx x for `x ≥ 10¹⁰⁰`, at an x scaled to about one.
#[inline(always)]
pub(super) fn erfcx_far<R: Real>(x: R) -> Dd<R> {
    INV_SQRT_PI.like(x).div(Dd::new(x, x.like(0.0)))
}

/// Dawson's function for `|x| <` [`SERIES`].
#[inline(always)]
pub(super) fn dawson_near<R: Real>(x: R) -> Dd<R> {
    odd_real(DAWSON, x)
}

/// Dawson's function from Im w.
#[inline(always)]
pub(super) fn dawson_beyond<R: Real>(v: Dd<R>) -> Dd<R> {
    v * HALF_SQRT_PI.like(v.hi)
}
