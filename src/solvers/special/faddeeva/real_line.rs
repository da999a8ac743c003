//! Formulas of erf, erfc, erfcx and Dawson's function of a real argument, for any type of number,
//! as sums of two that are not rounded to one yet.

use super::branch::STRIP;
use super::constants::{HALF_SQRT_PI, INV_SQRT_PI, TWO_OVER_SQRT_PI};
use super::odd_series::{DAWSON, ERF, ERFI, odd_real};
use crate::double_double::{Dd, two_prod};
use crate::exponential::{exp, pair_times_power};
use crate::real::{ROUND, Real};

/// Re z from which erfc is not computed as 1 − erf.
pub(super) const COMPLEMENT: f64 = 0.25;
/// |x| below which erfi x and Dawson's function are Maclaurin series.
pub(super) const SERIES: f64 = 0.5;
/// |x| below which erf x is one: half the distance of the centres of its rows.
pub(super) const SERIES_OF_ERF: f64 = STRIP;
/// |x| from which |erf x| rounds to 1.
pub(super) const ONE: f64 = 6.0;
/// |x| from which erfc x rounds to 0 or 2; beyond it `e^{x²}` overflows.
pub(super) const FAR: f64 = 30.0;
/// The binary exponent of `e^{x²}` above which erfcx |x| is nothing beside it.
const ALONE: f64 = 200.0;

/// erf x next to zero.
#[inline(always)]
pub(super) fn erf_near<R: Real>(x: R) -> Dd<R> {
    odd_real(ERF, x) * TWO_OVER_SQRT_PI.like(x)
}

/// erfi x for `|x| <` [`SERIES`].
#[inline(always)]
pub(super) fn erfi_near<R: Real>(x: R) -> Dd<R> {
    odd_real(ERFI, x) * TWO_OVER_SQRT_PI.like(x)
}

/// A constant less a number that is a mantissa and `ROUND` plus an exponent.
#[inline(always)]
pub(super) fn less<R: Real>(constant: f64, (t, n): (Dd<R>, R)) -> Dd<R> {
    (-pair_times_power(t, n)).add_f(n.like(constant))
}

/// `e^{x²}` as a mantissa and `ROUND` plus the exponent.
#[inline(always)]
pub(super) fn growth<R: Real>(x: R) -> (Dd<R>, R) {
    exp(two_prod(x, x))
}

/// erfc x for `|x| <` [`COMPLEMENT`].
#[inline(always)]
pub(super) fn erfc_near<R: Real>(x: R) -> Dd<R> {
    (-erf_near(x)).add_f(x.like(1.0))
}

/// erfc x for [`COMPLEMENT`] `≤ x <` [`FAR`], from erfcx x, as a mantissa and `ROUND` plus the
/// exponent.
#[inline(always)]
pub(super) fn erfc_right<R: Real>(x: R, w: Dd<R>) -> (Dd<R>, R) {
    let (e, n) = exp(-two_prod(x, x));
    (e * w, n)
}

/// Returns whether erfcx −x is `2e^{x²}` to the last place, from `ROUND` plus the exponent of
/// `e^{x²}`.
#[inline(always)]
pub(super) fn alone<R: Real>(n: R) -> R::Mask {
    n.like(ROUND + ALONE).below(n)
}

/// erfcx −x = `2e^{x²}` − erfcx x, from mantissa and `ROUND` plus the exponent of `e^{x²}` and
/// erfcx x.
#[inline(always)]
pub(super) fn erfcx_left<R: Real>((e, n): (Dd<R>, R), w: Dd<R>) -> Dd<R> {
    pair_times_power(e, n + n.like(1.0)) - w
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
