//! Which bucket a point belongs to: a table for the leading bits of |z|² and a few comparisons.

use super::super::branch::{
    HUGE, Kind, NEAR, SMALL, STRIP, TERMS_2, TINY, formula, modulus_squared,
};
use super::super::pack::{Pack, Wide};
use super::super::real::Real;

/// The number of the bucket of a kind in the lower half-plane, for those up to [`Kind::RealAxis`],
/// less that of the kind.
pub(in super::super) const LOWER: usize = Kind::Other as usize + 1;
/// What is added to it once more for a series beside which `e^{−z²}` should be negligible.
pub(in super::super) const SERIES_ALONE: usize =
    Kind::RealAxis as usize + 1 - Kind::Series26 as usize;
/// How many buckets there are.
pub(in super::super) const BUCKETS: usize = Kind::Series6 as usize + LOWER + SERIES_ALONE + 1;

/// Flags beside the eight bits of |z|².
const LOW: usize = 1 << 8;
const BESIDE_REAL: usize = 1 << 9;
/// `e^{−z²}` should be negligible, and the point is not next to the real axis, where another formula
/// knows that.
const DECAYED: usize = 1 << 10;
/// `Re z² = −ln |e^{−z²}|` from which it is taken for negligible.
const DECAY: f64 = 60.0;

/// |z|² outside these has the kind of the nearer one.
const LEAST: f64 = SMALL / 2.0;
const MOST: f64 = TERMS_2;
/// Stands for what is left to the scalar code.
const OTHER: f64 = 2.0 * TERMS_2;

/// The bucket by the number that [`places`] gives.
static BUCKET: [u8; 2048] = {
    let mut table = [Kind::Other as u8; 2048];
    let (least, other) = (LEAST.to_bits() >> 50, OTHER.to_bits() >> 50);
    let mut bits = least;
    while bits < other {
        let r2 = f64::from_bits(bits << 50);
        let mut flags = 0;
        while flags < 2048 {
            let low = flags & LOW != 0;
            let kind = formula(r2, low, flags & BESIDE_REAL != 0, flags & DECAYED == 0) as usize;
            let mut bucket = kind;
            if low & (kind <= Kind::RealAxis as usize) {
                bucket += LOWER;
                if (flags & DECAYED != 0)
                    & (kind >= Kind::Series26 as usize)
                    & (kind <= Kind::Series6 as usize)
                {
                    bucket += SERIES_ALONE;
                }
            }
            table[flags | bits as usize & 255] = bucket as u8;
            flags += LOW;
        }
        bits += 1;
    }
    table
};

/// The bucket by the place in its table.
#[inline(always)]
pub(in super::super) fn bucket(place: u64) -> u8 {
    BUCKET[place as usize & 2047]
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
    let flags = [
        flag(y.below(like(0.0)), LOW),
        flag(b.below(like(STRIP)), BESIDE_REAL),
        s.and_u64s(
            flag(like(DECAY).below(y.fma(-y, x * x)), DECAYED),
            flag(like(NEAR.next_down()).below(b), DECAYED),
        ),
    ];
    let flags = s.or_u64s(s.or_u64s(flags[0], flags[1]), flags[2]);
    let bits = s.and_u64s(s.leading(s.transmute_u64s_f64s(kept.1)), s.splat_u64s(255));
    s.or_u64s(bits, flags)
}
