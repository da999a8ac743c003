//! `2e^{−z²} − w(−z)` where both terms are pairs, and the norm of other formulas.

use super::exponential::LEAST;
use crate::bounds::{above, exp_up};
use crate::cover::Rectangle;
use crate::formula::TWO_52;
use crate::grid::TINIEST;
use crate::interval::{
    Interval, down, hypot_down, hypot_up, larger, product_up, quotient_up, sum_up, up,
};
use crate::tracked::Result as Tracks;
use mechaudit_reference::Ball;
use mechaudit_reference::faddeeva::w_f64;

/// The last rounding, and what is left out, in units of 2⁻⁵².
const ROUNDINGS: f64 = 0.5 + 1e-4 + 1e-9;
/// `e^710.48 > 2^1025`: from here on a component of w overflows.
const OVERFLOW: f64 = 710.48;

/// Describes what is known of the two components of a formula, and of its truncation.
#[derive(Clone, Copy, Debug)]
pub(super) struct Value {
    /// A lower bound of the absolute value of what the formula stands for.
    pub least: f64,
    /// An upper bound of it.
    pub most: f64,
    /// The largest distance of the number computed from it.
    pub error: f64,
}

impl Value {
    /// Of components without the factor σ.
    pub fn of([re, im]: [Tracks; 2], truncated: f64) -> Value {
        let lost = product_up(sum_up(re.tiny, im.tiny), TINIEST);
        Value {
            least: down(hypot_down(re.exact.mignitude(), im.exact.mignitude()) - truncated),
            most: sum_up(
                hypot_up(re.exact.magnitude(), im.exact.magnitude()),
                truncated,
            ),
            error: sum_up(sum_up(hypot_up(re.error, im.error), truncated), lost),
        }
    }

    /// The bound of the error in units of 2⁻⁵² of the value.
    pub fn norm(self) -> f64 {
        quotient_up(self.error, self.least) * TWO_52
    }
}

/// `Re z² = a² − b²` over a rectangle.
pub(super) fn decay(at: &Rectangle) -> Interval {
    let ends = |a: f64, b: f64| {
        let (p, q) = (Interval::point(a), Interval::point(b));
        (p - q) * (p + q)
    };
    let (lo, hi) = (ends(at.a[0], at.b[1]).lo, ends(at.a[1], at.b[0]).hi);
    Interval::new(lo, hi)
}

/// Bounds of `2|e^{−z²}|` from those of Re z²; the upper one is cut at 2¹⁰⁰⁰.
pub(super) fn exponential([lo, hi]: [f64; 2]) -> [f64; 2] {
    const MOST: f64 = 690.0;
    let below = |t: f64| match t {
        t if t > MOST => 0.0,
        t => down(2.0 / exp_up(t.max(-MOST))),
    };
    let above = |t: f64| match t {
        t if t < -MOST => 1e300,
        t => up(2.0 * exp_up(-t)),
    };
    [below(hi), above(lo)]
}

/// A lower bound of |w| over a rectangle, from its value at the centre: with D the distance of the
/// farthest point and `|w′| ≤ 2|z||w| + 2/√π`, the largest |w| is at most
/// `M = (|w(c)| + 1.13 D)/(1 − 2RD)` for `|z| ≤ R` (infinite unless `2RD < 1`), and the least at
/// least `|w(c)| − D (2RM + 1.13)`. Zero where that is nothing.
pub(super) fn least_of_w(at: &Rectangle) -> f64 {
    let middle = |[lo, hi]: [f64; 2]| lo + 0.5 * (hi - lo);
    let far = |[lo, hi]: [f64; 2], c: f64| up(hi - c).max(up(c - lo));
    let (a, b) = (middle(at.a), middle(at.b));
    let d = hypot_up(far(at.a, a), far(at.b, b));
    let r = hypot_up(at.a[1], at.b[1]);
    let Ok(w) = w_f64(a, -b, 60) else { return 0.0 };
    let [size, largest] = sizes([&w.re, &w.im]);
    let turn = product_up(product_up(2.0, r), d);
    let most = quotient_up(sum_up(largest, product_up(1.13, d)), down(1.0 - turn));
    let slope = sum_up(product_up(product_up(2.0, r), most), 1.13);
    down(size - product_up(d, slope)).max(0.0)
}

/// Bounds of the absolute value of a number, from below and above.
fn sizes(parts: [&Ball; 2]) -> [f64; 2] {
    let [p, q] = parts.map(|x| down(x.mignitude().to_f64()));
    let [s, t] = parts.map(above);
    [hypot_down(p, q), hypot_up(s, t)]
}

/// The bound of [`reflected`] where |w| is known to be larger than the code makes sure.
pub(super) fn reflected_off_zeros(w: Value, at: &Rectangle, rho: f64) -> f64 {
    let decay = decay(at);
    let [_, most] = exponential([decay.lo, decay.hi]);
    let error = sum_up(w.error, product_up(rho, most));
    sum_up(quotient_up(error, least_of_w(at)) * TWO_52, ROUNDINGS)
}

/// Returns whether a component of w overflows on the whole rectangle.
pub(super) fn overflows(at: &Rectangle) -> bool {
    decay(at).hi < -OVERFLOW
}

/// The bound of the norm of `2e^{−z²} − w(−z)`, in units of 2⁻⁵², from w(−z), the error ρ of the
/// exponential as a part of it, and the part λ of `|w(−z)|` below which the code does not use this
/// value.
///
/// With `x = 2|e^{−z²}|` and `W = |w(−z)|` the error before the last rounding is at most `e + ρx`,
/// `|w| ≥ |x − W|`, and where the value is used also `|w| ≥ λW` up to the errors:
/// `(e + ρx)/(W − x)` grows with x, `(e + ρx)/(x − W)` falls. The last rounding is half a unit in
/// the last place of each component. The roundings of what is below the leading parts are of the
/// order u², counted by 10⁻⁹; the exponential, where it is left out, is below 2⁻⁶⁶ of each
/// component, and where it stands alone w(−z) is below 2⁻¹⁹⁸ of it: 10⁻⁴ units.
pub(super) fn reflected(w: Value, at: &Rectangle, rho: f64, cancelled: f64) -> f64 {
    let decay = decay(at);
    let [least, most] = exponential([decay.lo, decay.hi]);
    // Where e^x is not proved, both are below 2⁻¹⁰⁰⁰.
    let missing = if decay.hi > -LEAST { 1e-303 } else { 0.0 };
    let error = |x: f64| sum_up(sum_up(w.error, missing), product_up(rho, x));
    if !(w.least > 0.0) {
        return f64::INFINITY;
    }
    let part = |w: f64| cancelled * w;
    let near = [
        down(w.least - up(part(w.least))),
        up(w.most + up(part(w.most))),
    ];
    let mut worst: f64 = 0.0;
    if least < near[0] {
        let x = most.min(near[0]);
        worst = larger(worst, quotient_up(error(x), down(w.least - x)));
    }
    if most > near[1] {
        let x = least.max(near[1]);
        worst = larger(worst, quotient_up(error(x), down(x - w.most)));
    }
    if least <= near[1] && most >= near[0] {
        let off = error(near[1].min(most));
        let size = down(down(part(w.least) * (1.0 - 1e-12)) - up(1.1 * off));
        worst = larger(worst, quotient_up(off, size));
    }
    sum_up(worst * TWO_52, ROUNDINGS)
}

#[cfg(test)]
mod tests;
