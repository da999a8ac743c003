//! Which bucket a point belongs to: a table for the leading bits of |z|² and a few comparisons.

use super::super::branch::{
    Branch, CELL, FARTHEST, HUGE, NEAR, NEAREST, REAL_AXIS, SERIES_6, SERIES_14, SERIES_26, STRIP,
    TINY, formula, modulus_squared,
};
use super::super::reflection::{DOMINANT, NEGLIGIBLE, decay};
use crate::pack::{Pack, Wide};
use crate::real::Real;

/// The number of the bucket of a formula in the lower half-plane, for those up to [`REAL_AXIS`],
/// less its number in the upper one, [`Branch::number`].
pub(in super::super) const LOWER: usize = Branch::Huge.number() + 1;
/// States what is added to it once more for a series beside which `e^{−z²}` should be negligible.
pub(in super::super) const SERIES_ALONE: usize = REAL_AXIS.number() + 1 - SERIES_26.number();
/// The buckets of the lower half-plane where one term dominates: W(−z) in cells and given by 26
/// terms, `2e^{−z²}` in cells.
pub(in super::super) const IMAGE_IN_CELL: usize = SERIES_6.number() + LOWER + SERIES_ALONE + 1;
pub(in super::super) const IMAGE_BY_SERIES: usize = IMAGE_IN_CELL + 1;
pub(in super::super) const EXPONENTIAL_IN_CELL: usize = IMAGE_IN_CELL + 2;
/// The number of buckets.
pub(in super::super) const BUCKETS: usize = IMAGE_IN_CELL + 3;

/// Flags beside the eight bits of |z|².
const LOW: usize = 1 << 8;
const BESIDE_REAL: usize = 1 << 9;
/// W(−z) dominates.
const IMAGE: usize = 1 << 10;
/// With it: `e^{−z²}` should be negligible, and the point is not next to the real axis, where
/// another formula knows that. Without it: `2e^{−z²}` dominates.
const APART: usize = 1 << 11;
/// Room for all of them.
const PLACES: usize = 1 << 12;

/// |z|² outside these has the formula of the nearer one.
const LEAST: f64 = NEAREST / 2.0;
const MOST: f64 = FARTHEST;
/// Stands for what is left to the scalar code.
const OTHER: f64 = 2.0 * FARTHEST;

/// The bucket by the number that [`places`] gives.
static BUCKET: [u8; PLACES] = {
    let mut table = [Branch::Huge.number() as u8; PLACES];
    let (least, other) = (LEAST.to_bits() >> 50, OTHER.to_bits() >> 50);
    let mut bits = least;
    while bits < other {
        let r2 = f64::from_bits(bits << 50);
        let mut flags = 0;
        while flags < PLACES {
            let (low, apart) = (flags & LOW != 0, flags & APART != 0);
            let formula = formula(r2, low, flags & BESIDE_REAL != 0, !apart);
            let bucket = if low {
                below(formula, flags & IMAGE != 0, apart)
            } else {
                formula.number()
            };
            table[flags | bits as usize & 255] = bucket as u8;
            flags += LOW;
        }
        bits += 1;
    }
    table
};

/// The bucket of a formula in the lower half-plane.
const fn below(formula: Branch, image: bool, apart: bool) -> usize {
    let above = formula.number();
    match (formula, image, apart) {
        (CELL, true, _) => IMAGE_IN_CELL,
        (CELL, false, true) => EXPONENTIAL_IN_CELL,
        (SERIES_26, true, false) => IMAGE_BY_SERIES,
        (SERIES_26 | SERIES_14 | SERIES_6, true, true) => above + LOWER + SERIES_ALONE,
        _ if above <= REAL_AXIS.number() => above + LOWER,
        _ => above,
    }
}

/// The bucket by the place in its table.
#[inline(always)]
pub(in super::super) fn bucket(place: u64) -> u8 {
    BUCKET[place as usize & (PLACES - 1)]
}

/// The places in the table of buckets at `x + i y`.
#[inline(always)]
pub(in super::super) fn places<S: Wide>(x: Pack<S>, y: Pack<S>) -> S::u64s {
    let (s, a, b) = (x.0, x.magnitude(), y.magnitude());
    let like = |v: f64| x.like(v);
    let r2 = modulus_squared(x, b);
    let kept = r2.at_least(like(LEAST)).at_most(like(MOST));
    let kept = x.pick(r2.below(like(HUGE)), kept, like(OTHER));
    let kept = x.pick(a.below(like(TINY)), like(OTHER), kept);
    let flag = |mask: S::m64s, bit: usize| s.flag(mask, bit as u64);
    let decay = decay(x, y);
    let negligible = s.and_m64s(
        like(NEGLIGIBLE).below(decay),
        like(NEAR.next_down()).below(b),
    );
    let flags = s.or_u64s(
        s.or_u64s(
            flag(y.below(like(0.0)), LOW),
            flag(b.below(like(STRIP)), BESIDE_REAL),
        ),
        s.or_u64s(
            flag(like(DOMINANT).below(decay), IMAGE),
            flag(x.or(negligible, decay.below(like(-DOMINANT))), APART),
        ),
    );
    let bits = s.and_u64s(s.leading(s.transmute_u64s_f64s(kept.1)), s.splat_u64s(255));
    s.or_u64s(bits, flags)
}
