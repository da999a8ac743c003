//! The lower half-plane: `w(z) = 2e^{−z²} − w(−z)` (DLMF 7.4.3), both terms at `a − i b` from a and
//! b.

use crate::double_double::{Dd, two_sum};
use crate::exponential::{
    binary_exponent, exp_minus_square_rounded, exp_minus_square_short, exponent,
};
use crate::hex::hex;
use crate::real::{ROUND, Real};

/// A component smaller than this part of its terms is computed again in double-double.
pub(super) const CANCELLED: f64 = 0.04;
/// And both components where neither is larger than this part of the larger one of w(−z): around
/// zeros.
pub(super) const BOTH_CANCELLED: f64 = 0.18;
/// The same where `e^{−z²}` dominates and the terms are rounded.
const CANCELLED_ROUNDED: f64 = 2.0;
/// The part of its modulus below which a component of `e^{−z²}` has to be computed again: the rest
/// of a phase that is as close to a multiple of π/2 has too few digits. Beside the imaginary axis
/// there is no such multiple, and Im W is proportional to Re z.
const CLOSE: f64 = hex("0x1p-60");
/// Powers of two from which `2e^{−z²}` stands alone.
pub(super) const ALONE: f64 = 200.0;

/// One term dominates in a cell, or where 26 terms of the asymptotic series are used, if `|Re z²|`
/// is above this: `|2e^{−z²}|` is above 2000, or below a fifth of each component of w(−z), so that
/// none vanishes.
pub(super) const DOMINANT: f64 = 7.0;
/// `Re z²` above which `2e^{−z²}` is below 2⁻⁵⁴ of each component of w(−z) there.
pub(super) const NEGLIGIBLE: f64 = 47.0;

/// `Re z² = −ln |e^{−z²}|`, to tell the dominant term.
#[inline(always)]
pub(super) fn decay<R: Real>(x: R, y: R) -> R {
    y.fma(-y, x * x)
}

/// `(Re w, Im w)` at `a + i y`, `y < 0`, from those at `a − i y` where they dominate.
#[inline(always)]
pub(super) fn image_dominates<R: Real>(image: (R, R), a: R, y: R) -> (R, R) {
    sum(image, exp_minus_square_short(a, y))
}

#[inline(always)]
fn sum<R: Real>((u, v): (R, R), (c, s, n): (R, R, R)) -> (R, R) {
    let factor = (n + n.like(1.0)).power_of_two();
    (c.fma(factor, -u), s.fma(factor, v))
}

/// The same where `2e^{−z²}` dominates; `true` where the terms of a component cancel.
#[inline(always)]
pub(super) fn exponential_dominates<R: Real>((u, v): (R, R), a: R, y: R) -> (R, R, R::Mask) {
    let (re, im) = sum((u, v), exp_minus_square_rounded(a, y));
    let part = a.like(CANCELLED_ROUNDED);
    let lost = a.or(
        re.magnitude().below(u * part),
        im.magnitude().below(v * part),
    );
    (re, im, lost)
}

/// `t · factor + x`
#[inline(always)]
fn scaled_sum<R: Real>(t: Dd<R>, factor: R, x: Dd<R>) -> R {
    let s = two_sum(t.hi * factor, x.hi);
    s.hi + (s.lo + t.lo.fma(factor, x.lo))
}

/// The part of `|e^{−z²}|` below which a component of it has too few digits at `a − i b`.
#[inline(always)]
pub(super) fn close<R: Real>(a: R, b: R) -> R {
    (a * b).at_most(a.like(CLOSE))
}

/// `(Re w, Im w)` at `a − i b` from those at `a + i b` and `e^{−z²} = (c + i s) 2^k`,
/// `n = ROUND + k`, `k` below [`ALONE`]; `true` where the terms of a component, or of both, cancel,
/// or a component of `e^{−z²}` is below the part `close` of its modulus.
#[inline(always)]
pub(super) fn reflect<R: Real>(
    (u, v): (Dd<R>, Dd<R>),
    (c, s, n): (Dd<R>, Dd<R>, R),
    close: R,
) -> (R, R, R::Mask) {
    // Below the smallest f64 beside components that may be subnormal.
    let none = n.below(n.like(ROUND - 1021.0));
    let factor = n.pick(none, n.like(0.0), (n + n.like(1.0)).power_of_two());
    let (re, im) = (scaled_sum(c, factor, -u), scaled_sum(s, factor, v));
    let (p, q) = (re.magnitude(), im.magnitude());
    let (part, close) = (n.like(CANCELLED), factor * close);
    let lost = n.or(
        p.below(u.hi.fma(part, close)),
        q.below(v.hi.fma(part, close)),
    );
    let larger = u.hi.at_least(v.hi);
    let both = p.at_least(q).below(larger * n.like(BOTH_CANCELLED));
    (re, im, n.or(lost, both))
}

/// Returns whether `2e^{−z²}` is below 2⁻⁶⁶ of both components of w(−z).
#[inline(always)]
pub(super) fn negligible<R: Real>(a: R, b: R, u: R, v: R) -> R::Mask {
    let e = exponent(a, b).hi.at_least(a.like(-708.0));
    let (_, n) = binary_exponent(e.at_most(a.like(0.0)));
    let small = (n + n.like(68.0)).power_of_two();
    small.below(u.at_most(v))
}

#[cfg(test)]
mod tests;
