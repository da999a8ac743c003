//! Which formula computes W(z) where: for one point, and for several by a table.

#[cfg(target_arch = "x86_64")]
use super::pack::{Pack, Wide};
#[cfg(target_arch = "x86_64")]
use super::real::Real;
use super::{maclaurin, zeros};

// Every limit of |z|² is one of 1, 5/4, 3/2, 7/4 times a power of two, so that the exponent and the
// first two bits of the fraction tell which side of it a number is on.

/// |z|² below which the Maclaurin series is used.
pub(super) const SMALL: f64 = 1.0 / 16384.0;
/// |z|² below which cells of the lower half-plane are tabulated.
const DISC_EDGE: f64 = 1.0;
/// |z|² from which the strip beside the real axis has rows of its own, the asymptotic series with
/// `e^{−z²}` added, and nothing, because `e^{−z²}` is below every `f64`.
const APART: f64 = 1.25;
const BEYOND: f64 = 80.0;
const GONE: f64 = 768.0;
/// |z|² from which the strip beside the imaginary axis is twice as wide.
const WIDE: f64 = 14.0;
/// |z|² from which the asymptotic series is used, and from which it needs 14, 6, 4, 2 terms
/// instead of 26.
const FAR: f64 = 48.0;
const TERMS_14: f64 = 112.0;
const TERMS_6: f64 = 1024.0;
const TERMS_4: f64 = 5120.0;
pub(super) const TERMS_2: f64 = 1_048_576.0;
/// |z|² above this is scaled first.
pub(super) const HUGE: f64 = 1e200;

/// Half the distance of the centres of the fine cells, and half the width of the strips beside the
/// axes; 1/8 belongs to the strips, where a cell's centre would be on the axis.
pub(super) const STRIP: f64 = 0.125_f64.next_up();
/// Closer to the real axis only the first power of Im z counts in the strip from [`BEYOND`] on.
pub(super) const NEAR: f64 = f64::from_bits((1023 - 28) << 52);
/// Closer to the imaginary axis, and on it, batches leave points to the scalar code.
pub(super) const TINY: f64 = 1e-290;

/// The formula for W(z).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub(super) enum Kind {
    Cell,
    ImaginaryAxis,
    Series26,
    Series14,
    Series6,
    RealAxis,
    Series4,
    Series2,
    Small,
    Disc,
    Strip,
    RealLine,
    Other,
}

/// A formula for W(z).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Branch {
    /// Maclaurin series.
    Maclaurin {
        /// Terms.
        terms: u32,
    },
    /// Taylor series about the centre of a cell.
    Cell {
        /// Terms.
        terms: u32,
    },
    /// Taylor series about the centre of a cell in the lower half-plane, `|z| < 1`.
    LowerCell {
        /// Terms.
        terms: u32,
    },
    /// Taylor series of erfcx about a centre on the imaginary axis.
    ImaginaryAxis {
        /// Terms.
        terms: u32,
    },
    /// Taylor series about a centre on the real axis, on either side of it.
    RealAxis {
        /// Terms.
        terms: u32,
    },
    /// Asymptotic series and `e^{−z²}`, on either side of the real axis.
    Strip {
        /// Terms.
        terms: u32,
    },
    /// Asymptotic series.
    Asymptotic {
        /// Terms.
        terms: u32,
    },
    /// Taylor series about zero number `zero` (from 1) in the lower half-plane.
    Zero {
        /// The number of the zero, by modulus.
        zero: u32,
        /// Terms.
        terms: u32,
    },
    /// `i/(√π z)`, scaled; and everything that is not finite.
    Huge,
}

/// The formula at `a + i y`, `a ≥ 0`.
pub(super) fn branch(a: f64, y: f64) -> Branch {
    if y < 0.0
        && let Some(k) = zeros::nearest(a, -y)
    {
        return Branch::Zero {
            zero: k as u32 + 1,
            terms: 21,
        };
    }
    match kind(a, y) {
        Kind::Small => Branch::Maclaurin {
            terms: maclaurin::TERMS,
        },
        Kind::Series4 => Branch::Asymptotic { terms: 4 },
        Kind::Series2 => Branch::Asymptotic { terms: 2 },
        Kind::Cell => Branch::Cell { terms: 18 },
        Kind::Disc => Branch::LowerCell { terms: 18 },
        Kind::ImaginaryAxis => Branch::ImaginaryAxis { terms: 18 },
        Kind::RealAxis => Branch::RealAxis { terms: 18 },
        Kind::Strip | Kind::RealLine => Branch::Strip { terms: 16 },
        Kind::Series26 => Branch::Asymptotic { terms: 26 },
        Kind::Series14 => Branch::Asymptotic { terms: 14 },
        Kind::Series6 => Branch::Asymptotic { terms: 6 },
        Kind::Other => Branch::Huge,
    }
}

/// The formula at a point, by |z|², whether it lies in the lower half-plane, in the strips beside
/// the real and the imaginary axis, and next to the real one.
#[inline(always)]
const fn formula(
    r2: f64,
    low: bool,
    beside_real: bool,
    beside_imaginary: bool,
    next_to_real: bool,
) -> Kind {
    if beside_real & (r2 >= APART) & (r2 < GONE) {
        if r2 < BEYOND {
            Kind::RealAxis
        } else if next_to_real {
            Kind::RealLine
        } else {
            Kind::Strip
        }
    } else if r2 < FAR {
        if r2 < SMALL {
            Kind::Small
        } else if low & (r2 < DISC_EDGE) {
            Kind::Disc
        } else if beside_imaginary {
            Kind::ImaginaryAxis
        } else {
            Kind::Cell
        }
    } else if r2 < TERMS_14 {
        Kind::Series26
    } else if r2 < TERMS_6 {
        Kind::Series14
    } else if r2 < HUGE {
        if low | (r2 < TERMS_4) {
            Kind::Series6
        } else if r2 < TERMS_2 {
            Kind::Series4
        } else {
            Kind::Series2
        }
    } else {
        Kind::Other
    }
}

/// Half the width of the strip beside the imaginary axis.
#[inline(always)]
fn width(r2: f64) -> f64 {
    if r2 < WIDE { STRIP } else { 2.0 * STRIP }
}

/// The formula at `a + i y`, `a ≥ 0`.
#[inline(always)]
pub(super) fn kind(a: f64, y: f64) -> Kind {
    let b = y.abs();
    let r2 = a.mul_add(a, b * b);
    formula(r2, y < 0.0, b < STRIP, a < width(r2), b < NEAR)
}

/// The number of the bucket of a kind in the lower half-plane, for those up to [`Kind::RealAxis`],
/// less that of the kind.
pub(super) const LOWER: usize = Kind::Other as usize + 1;
/// What is added to it once more for a series beside which `e^{−z²}` should be negligible.
pub(super) const SERIES_ALONE: usize = Kind::RealAxis as usize + 1 - Kind::Series26 as usize;
/// How many buckets there are.
pub(super) const BUCKETS: usize = Kind::Series6 as usize + LOWER + SERIES_ALONE + 1;

/// The square of a smaller number would be subnormal, which is slow, and does not count in |z|².
#[cfg(target_arch = "x86_64")]
const RAISED: f64 = 1e-150;

/// Flags beside the eight bits of |z|².
const LOW: usize = 1 << 8;
const BESIDE_REAL: usize = 1 << 9;
const BESIDE_IMAGINARY: usize = 1 << 10;
/// `e^{−z²}` should be negligible, and the point is not next to the real axis, where another formula
/// knows that.
const DECAYED: usize = 1 << 11;
/// `Re z² =  −ln |e^{−z²}|` from which it is taken for negligible.
const DECAY: f64 = 60.0;

/// |z|² outside these has the kind of the nearer one.
const LEAST: f64 = SMALL / 2.0;
const MOST: f64 = TERMS_2;
/// Stands for what is left to the scalar code.
const OTHER: f64 = 2.0 * TERMS_2;

/// The bucket by the number that [`places`] gives.
#[cfg(target_arch = "x86_64")]
static BUCKET: [u8; 4096] = {
    let mut table = [Kind::Other as u8; 4096];
    let (least, other) = (LEAST.to_bits() >> 50, OTHER.to_bits() >> 50);
    let mut bits = least;
    while bits < other {
        let r2 = f64::from_bits(bits << 50);
        let mut flags = 0;
        while flags < 4096 {
            let low = flags & LOW != 0;
            let kind = formula(
                r2,
                low,
                flags & BESIDE_REAL != 0,
                flags & BESIDE_IMAGINARY != 0,
                flags & DECAYED == 0,
            ) as usize;
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
#[cfg(target_arch = "x86_64")]
#[inline(always)]
pub(super) fn bucket(place: u64) -> u8 {
    BUCKET[place as usize & 4095]
}

/// The places in the table of buckets at `x + i y`.
#[cfg(target_arch = "x86_64")]
#[inline(always)]
pub(super) fn places<S: Wide>(x: Pack<S>, y: Pack<S>) -> S::u64s {
    let (s, a, b) = (x.0, x.magnitude(), y.magnitude());
    let like = |v: f64| x.like(v);
    let raised = b.at_least(like(RAISED));
    let yy = raised * raised;
    let r2 = x.fma(x, yy);
    let kept = r2.at_least(like(LEAST)).at_most(like(MOST));
    let kept = x.pick(r2.below(like(HUGE)), kept, like(OTHER));
    let kept = x.pick(a.below(like(TINY)), like(OTHER), kept);
    let flag = |mask: S::m64s, bit: usize| s.flag(mask, bit as u64);
    let width = x.pick(r2.below(like(WIDE)), like(STRIP), like(2.0 * STRIP));
    let flags = [
        flag(y.below(like(0.0)), LOW),
        flag(b.below(like(STRIP)), BESIDE_REAL),
        flag(a.below(width), BESIDE_IMAGINARY),
        s.and_u64s(
            flag(like(DECAY).below(yy.fma(like(-2.0), r2)), DECAYED),
            flag(like(NEAR.next_down()).below(b), DECAYED),
        ),
    ];
    let flags = s.or_u64s(s.or_u64s(flags[0], flags[1]), s.or_u64s(flags[2], flags[3]));
    let bits = s.and_u64s(s.leading(s.transmute_u64s_f64s(kept.1)), s.splat_u64s(255));
    s.or_u64s(bits, flags)
}
