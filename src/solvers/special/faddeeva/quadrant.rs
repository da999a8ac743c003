//! The factors of the functions that are built on W(z) in the first quadrant, as unevaluated sums.

use super::asymptotic::four_terms;
use super::axis::beside_axis;
use super::branch::{ROWS_ON_REAL_AXIS, modulus_squared};
use super::pairs::{self, Parts};
use super::places::{Choose, Mask, Number, One, Places};
use super::rows::on_real_axis;
use super::trapezoidal;
use crate::double_double::{Dd, two_prod, two_sum};
use crate::double_double_functions::{Gaussian, exp_minus_square};
use crate::exponential::{LARGE_PHASE, exp_wide_to, exponent, phase, product as by_phase, reduce};
pub(super) use crate::exponential::{circle, exp_wide, pair_times_power, times_power};
use crate::hex::hex;
use crate::lanes::{Lanes, Task};
use crate::numbers::Numbers;
use crate::payne_hanek;
use crate::real::{Masked, ROUND, Real};

/// A sum smaller than this part of its terms is computed again in double-double.
const CANCELLED: f64 = 1.0 / 24.0;

/// The larger coordinate and `|Re z²|` below which functions are computed in double-double side by
/// side.
pub(super) const IN_PAIRS: [f64; 2] = [4096.0, 1400.0];
/// The part of its terms below which a component so computed is left to the code for one point,
/// which knows the zeros.
pub(super) const VANISHING: f64 = 1.0 / 1024.0;

/// Returns whether a sum has lost digits against one of its two terms.
#[inline(always)]
pub(super) fn lost<R: Real>(sum: Dd<R>, term: R) -> R::Mask {
    let part = sum.hi.like(CANCELLED) * term;
    sum.hi.magnitude().below(part)
}

/// The product of two complex numbers, and the size of a term of each component.
#[inline(always)]
pub(super) fn product<R: Real>(
    (a, b): (Dd<R>, Dd<R>),
    (c, d): (Dd<R>, Dd<R>),
) -> (Dd<R>, Dd<R>, [R; 2]) {
    let (re, re_term) = sum_of_products((a, c), (-b, d));
    let (im, im_term) = sum_of_products((a, d), (b, c));
    (re, im, [re_term, im_term])
}

/// `a b + c d` to about 2⁻¹⁰⁴ of the terms, and the size of one.
#[inline(always)]
fn sum_of_products<R: Real>((a, b): (Dd<R>, Dd<R>), (c, d): (Dd<R>, Dd<R>)) -> (Dd<R>, R) {
    let (p, q) = (two_prod(a.hi, b.hi), two_prod(c.hi, d.hi));
    let s = two_sum(p.hi, q.hi);
    let p_lo = a.hi.fma(b.lo, a.lo.fma(b.hi, p.lo));
    let q_lo = c.hi.fma(d.lo, c.lo.fma(d.hi, q.lo));
    (two_sum(s.hi, s.lo + (p_lo + q_lo)), p.hi.magnitude())
}

/// A coordinate so small that a function is linear in it, raised by 2³⁰⁰ so that its products keep
/// all digits, and the exponent to subtract again. Where the other one is large, by 2⁶⁰, so that
/// the phase stays small: everything that grows with it has overflowed there.
#[inline(always)]
pub(super) fn lifted<R: Masked>(x: R, other: R) -> (R, R) {
    const SMALL: f64 = hex("0x1p-400");
    const LARGE: f64 = hex("0x1p40");
    const FAR_UP: f64 = hex("0x1p300");
    const UP: f64 = hex("0x1p60");
    let like = |c: f64| x.like(c);
    let small = x.below(like(SMALL));
    if !x.any(small) {
        return (x, like(0.0));
    }
    let near = other.below(like(LARGE));
    let by = x.pick(near, like(FAR_UP), like(UP));
    let down = x.pick(near, like(300.0), like(60.0));
    (x.pick(small, x * by, x), x.pick(small, down, like(0.0)))
}

/// `e^{−z²}` at `a + i y` as mantissas and `ROUND` plus the exponent, for any phase and as many
/// exponents as [`exp_wide`] has.
#[inline(always)]
pub(super) fn gaussian<N: Numbers>(
    numbers: N,
    a: N::Number,
    y: N::Number,
) -> (Dd<N::Number>, Dd<N::Number>, N::Number) {
    let theta = phase(a, y);
    let (r, quadrant) = reduce(theta);
    let small = theta.hi.magnitude().below(a.like(LARGE_PHASE));
    let phase = [r.hi, r.lo, quadrant];
    let [hi, lo, quadrant] = numbers.replaced(small, phase, [a, y], |[a, y]| {
        let (r, quadrant) = payne_hanek::reduce(a, y);
        [r.hi, r.lo, quadrant]
    });
    let e = exp_wide_to::<_, true>(exponent(a, y));
    by_phase::<_, true>(e, (Dd::new(hi, lo), quadrant))
}

/// `(2/√π) F(t + i b)`, `F` Dawson's function: real part, and imaginary part, `½ ≤ t < 10¹⁰⁰`,
/// `b ≤` [`STRIP`], in the places `among`.
#[inline(always)]
pub(super) fn dawson_in_strip<P: Places>(
    places: P,
    t: Number<P>,
    b: Number<P>,
    among: Mask<P>,
) -> Parts<Number<P>> {
    let near = modulus_squared(t, t.like(0.0)).below(t.like(ROWS_ON_REAL_AXIS[1]));
    let on_rows = t.both(among, near);
    let mut value = Choose::none(t);
    if t.any(on_rows) {
        let (n, dx) = on_real_axis(t);
        let (re, im) = places.real_rows(beside_axis, n, (dx, b));
        value = (re, im.mul_f(b)).or_else(on_rows, value);
    }
    let beyond = t.except(among, near);
    if t.any(beyond) {
        // (2/√π) F = −i (w − e^{−z²}).
        let (u, v) = pairs::far(t, b, beyond);
        value = (v, -u).or_else(beyond, value);
    }
    value
}

/// w at `a + i b`, `a, b ≥ 0`, `|z| < 10¹⁰⁰`, in double-double; to about 2⁻¹⁰⁰ of the larger
/// component, from 4096 on to 2⁻⁷⁷.
#[inline(always)]
pub(super) fn w_exact<L: Lanes>(lanes: L, a: f64, b: f64) -> Parts<f64> {
    if a.max(b) < 4096.0 {
        lanes.call(trapezoidal::Upper { a, b }).0
    } else {
        four_terms(a, b)
    }
}

/// [`w_exact`] and [`gaussian_exact`] at `a + i b`.
#[inline(always)]
pub(super) fn both_exact<L: Lanes>(lanes: L, a: f64, b: f64) -> (Parts<f64>, Gaussian) {
    if a.max(b) < 4096.0 && exponent(a, b).hi.abs() < 1400.0 {
        lanes.call(trapezoidal::Upper { a, b })
    } else {
        (w_exact(lanes, a, b), gaussian_exact(lanes, a, b))
    }
}

/// `e^{−z²}` at `b + i a` from that at `a + i b`: the inverse of its conjugate.
#[inline(always)]
pub(super) fn mirrored<R: Real>((c, s, n): Gaussian<R>) -> Gaussian<R> {
    let square = c.square() + s.square();
    (c.div(square), s.div(square), n.like(2.0 * ROUND) - n)
}

/// `e^{−z²}` at `a + i y` in double-double. A function of its own, as [`trapezoidal::Upper`].
struct ExpMinusSquare {
    a: f64,
    y: f64,
}

impl Task for ExpMinusSquare {
    type Output = Gaussian;
    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> Gaussian {
        exp_minus_square(One(lanes), self.a, -self.y, Dd::ZERO, Dd::ZERO).0
    }
}

/// `e^{−z²}` at `a + i y` as mantissas and `ROUND` plus the exponent, in double-double where it
/// matters.
#[inline(always)]
pub(super) fn gaussian_exact<L: Lanes>(lanes: L, a: f64, y: f64) -> (Dd, Dd, f64) {
    if exponent(a, y).hi.abs() < 1400.0 {
        lanes.call(ExpMinusSquare { a, y })
    } else {
        gaussian(One(lanes), a, y)
    }
}
