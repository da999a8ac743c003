//! W in the closed first quadrant as pairs of numbers, at one point or at several side by side.

use super::asymptotic::series;
use super::axis::dawson_row;
use super::branch::{
    ENDS_OF_PAIRS, FINE, HUGE, ROWS_ON_REAL_AXIS, STRIP, STRIP_ENDS, modulus_squared,
};
use super::places::{Choose, Mask, Number, Places, by_ends};
use super::rows::{cell, cell_row, imaginary_axis_row, on_axis, on_real_axis, real_axis_row};
use crate::double_double::Dd;
use crate::exponential::{exp_minus_square, pair_times_power};
use crate::real::{Masked, ROUND, Real};

/// Real and imaginary part.
pub(super) type Parts<R> = (Dd<R>, Dd<R>);

/// `e^{x²} erfc x` for `x < 10¹⁰⁰` from where its rows end, in the places `among`.
#[inline(always)]
pub(super) fn erfcx_right<R: Masked>(x: R, among: R::Mask) -> Dd<R> {
    let zero = x.like(0.0);
    by_ends!(modulus_squared(zero, x), among;
        ENDS_OF_PAIRS[1] => series::<_, 26>(zero, x).0,
        ENDS_OF_PAIRS[2] => series::<_, 14>(zero, x).0,
        ENDS_OF_PAIRS[3] => series::<_, 6>(zero, x).0,
        ENDS_OF_PAIRS[4] => series::<_, 2>(zero, x).0
    )
}

/// `(2/√π) F(x)`, F Dawson's function, for `½ ≤ x < 10¹⁰⁰`, in the places `among`.
#[inline(always)]
pub(super) fn dawson_right<P: Places>(places: P, x: Number<P>, among: Mask<P>) -> Dd<Number<P>> {
    let zero = x.like(0.0);
    by_ends!(modulus_squared(x, zero), among;
        ROWS_ON_REAL_AXIS[1] => {
            let (n, t) = on_real_axis(x);
            places.axis_rows(dawson_row, n, t)
        },
        ENDS_OF_PAIRS[1] => series::<_, 26>(x, zero).1,
        ENDS_OF_PAIRS[2] => series::<_, 14>(x, zero).1,
        ENDS_OF_PAIRS[3] => series::<_, 6>(x, zero).1,
        ENDS_OF_PAIRS[4] => series::<_, 2>(x, zero).1
    )
}

/// The series without `e^{−z²}`, `48 ≤ |z|² < 10²⁰⁰`, in the places `among`.
#[inline(always)]
pub(super) fn far<R: Masked>(a: R, b: R, among: R::Mask) -> Parts<R> {
    by_ends!(modulus_squared(a, b), among;
        ENDS_OF_PAIRS[1] => series::<_, 26>(a, b),
        ENDS_OF_PAIRS[2] => series::<_, 14>(a, b),
        ENDS_OF_PAIRS[3] => series::<_, 6>(a, b),
        ENDS_OF_PAIRS[4] => series::<_, 2>(a, b)
    )
}

/// Where each formula for the pairs holds. Beside either axis w is expanded about centres on it.
pub(super) struct Formulas<M> {
    pub in_cell: M,
    pub on_imaginary: M,
    pub on_real: M,
    /// The asymptotic series, with `e^{−z²}` in the strip beside the real axis.
    pub beyond: M,
    pub strip: M,
}

impl<M: Copy> Formulas<M> {
    /// The formulas at `a + i b`, `a, b ≥ 0`, in the places `among`.
    #[inline(always)]
    pub(super) fn of<R: Masked<Mask = M>>(a: R, b: R, among: M) -> Formulas<M> {
        let like = |c: f64| a.like(c);
        let r2 = modulus_squared(a, b);
        let below = |end: f64| r2.below(like(end));
        let beside = a.both(among, b.below(like(STRIP)));
        let strip = a.except(a.both(beside, below(STRIP_ENDS[1])), below(STRIP_ENDS[0]));
        let on_real = a.both(strip, below(ROWS_ON_REAL_AXIS[1]));
        let near = a.except(a.both(among, below(ENDS_OF_PAIRS[0])), strip);
        let width = a.pick(
            a.at_least(b).below(like(FINE)),
            like(STRIP),
            like(2.0 * STRIP),
        );
        let on_imaginary = a.both(near, a.below(width));
        let beyond = a.except(a.except(among, near), on_real);
        Formulas {
            in_cell: a.except(near, on_imaginary),
            on_imaginary,
            on_real,
            beyond,
            strip: a.both(beyond, strip),
        }
    }

    /// Five classes of distances, and of each those beside the imaginary and beside the real axis:
    /// `ROUND` plus a number below 15 by which points with the same formula can be brought
    /// together.
    #[inline(always)]
    pub(super) fn class<R: Masked<Mask = M>>(a: R, b: R) -> R {
        let like = |c: f64| a.like(c);
        let r2 = modulus_squared(a, b);
        let mut ring = like(ROUND);
        for end in [ENDS_OF_PAIRS[0], ENDS_OF_PAIRS[1], ENDS_OF_PAIRS[2], HUGE] {
            ring = ring + a.pick(r2.below(like(end)), like(0.0), like(1.0));
        }
        let side = a.pick(a.below(like(2.0 * STRIP)), like(5.0), like(0.0));
        ring + a.pick(b.below(like(STRIP)), like(10.0), side)
    }
}

/// `(Re w, Im w)` at `a + i b`, `a, b ≥ 0`, `|z| < 10¹⁰⁰`, in the places `among`; elsewhere
/// anything. Rows are summed by `SUM`.
#[inline(always)]
pub(super) fn w<P: Places, const SUM: u8>(
    places: P,
    a: Number<P>,
    b: Number<P>,
    among: Mask<P>,
) -> Parts<Number<P>> {
    let formulas = Formulas::of(a, b, among);
    let mut value = Choose::none(a);
    if a.any(formulas.in_cell) {
        let [n, dx, dy] = cell(a, b);
        value = places.summed_rows::<SUM>(cell_row, n, (a - dx, b - dy), (dx, dy));
        // As a rule, as below.
        if a.all(formulas.in_cell) {
            return value;
        }
    }
    if a.any(formulas.on_imaginary) {
        let (n, t) = on_axis(b);
        value = places
            .summed_real_rows::<SUM>(imaginary_axis_row, n, b - t, (t, a))
            .or_else(formulas.on_imaginary, value);
    }
    if a.any(formulas.on_real) {
        let (n, t) = on_real_axis(a);
        value = places
            .summed_rows::<SUM>(real_axis_row, n, (a - t, a.like(0.0)), (t, b))
            .or_else(formulas.on_real, value);
    }
    if a.any(formulas.beyond) {
        let (u, v) = far(a, b, formulas.beyond);
        let mut parts = (u, v);
        if a.any(formulas.strip) {
            let (c, _, n) = exp_minus_square(a, b);
            parts = (u + pair_times_power(c, n), v).or_else(formulas.strip, parts);
        }
        if a.all(formulas.beyond) {
            return parts;
        }
        value = parts.or_else(formulas.beyond, value);
    }
    value
}
