//! Which formula computes W(z) where.

use super::real::Real;
use super::zeros;

// Every limit of |z|² but the last is one of 1, 5/4, 3/2, 7/4 times a power of two, so that the exponent and the
// first two bits of the fraction tell which side of it a number is on.

/// |z|² below which the Maclaurin series is used, and below which nine terms of it.
pub(super) const TERMS_21: f64 = 1.0 / 16.0;
pub(super) const TERMS_9: f64 = 1.0 / 16384.0;
/// |z|² below which cells of the lower half-plane are tabulated.
pub(super) const DISC_EDGE: f64 = 1.0;
/// |z|² from which the strip beside the real axis has rows of its own, the asymptotic series with
/// `e^{−z²}` added, and nothing, because `e^{−z²}` is below every `f64`.
pub(super) const APART: f64 = 1.25;
pub(super) const BEYOND: f64 = 80.0;
pub(super) const GONE: f64 = 768.0;
/// |z|² from which the asymptotic series is used, and from which it needs 14, 6, 4, 2 terms
/// instead of 26.
pub(super) const FAR: f64 = 48.0;
pub(super) const TERMS_14: f64 = 112.0;
pub(super) const TERMS_6: f64 = 1024.0;
pub(super) const TERMS_4: f64 = 5120.0;
pub(super) const TERMS_2: f64 = 1_048_576.0;
/// |z|² above this is scaled first.
pub(super) const HUGE: f64 = 1e200;

/// Half the distance of the centres of the fine cells, and half the width of the strip beside the real
/// axis; 1/8 belongs to the strip, where a cell's centre would be on the axis.
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
    Series26,
    Series14,
    Series6,
    RealAxis,
    Series4,
    Series2,
    Maclaurin9,
    Maclaurin21,
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
    /// Taylor series of erfcx about a centre on the imaginary axis, on this axis.
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
    /// The same next to the real axis, by polynomials in `1/(Re z)²`.
    RealLine {
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
        Kind::Maclaurin9 => Branch::Maclaurin { terms: 9 },
        Kind::Cell | Kind::Maclaurin21 if a == 0.0 && y >= 0.0 => {
            Branch::ImaginaryAxis { terms: 18 }
        }
        Kind::Maclaurin21 => Branch::Maclaurin { terms: 21 },
        Kind::Series4 => Branch::Asymptotic { terms: 4 },
        Kind::Series2 => Branch::Asymptotic { terms: 2 },
        Kind::Cell => Branch::Cell { terms: 18 },
        Kind::Disc => Branch::LowerCell { terms: 18 },
        Kind::RealAxis => Branch::RealAxis { terms: 18 },
        Kind::Strip => Branch::Strip { terms: 16 },
        Kind::RealLine => Branch::RealLine { terms: 10 },
        Kind::Series26 => Branch::Asymptotic { terms: 26 },
        Kind::Series14 => Branch::Asymptotic { terms: 14 },
        Kind::Series6 => Branch::Asymptotic { terms: 6 },
        Kind::Other => Branch::Huge,
    }
}

/// The formula at a point, by |z|², whether it lies in the lower half-plane, in the strip beside the
/// real axis, and next to it.
#[inline(always)]
pub(super) const fn formula(r2: f64, low: bool, beside_real: bool, next_to_real: bool) -> Kind {
    if beside_real & (r2 >= APART) & (r2 < GONE) {
        if r2 < BEYOND {
            Kind::RealAxis
        } else if next_to_real {
            Kind::RealLine
        } else {
            Kind::Strip
        }
    } else if r2 < FAR {
        if r2 < TERMS_9 {
            Kind::Maclaurin9
        } else if r2 < TERMS_21 {
            Kind::Maclaurin21
        } else if low & (r2 < DISC_EDGE) {
            Kind::Disc
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

/// Added to the distance from the real axis, where it does not count in |z|²: squares that underflow
/// take as long as half of a formula.
const RAISE: f64 = 1e-150;

/// |z|², by which the formula is chosen.
#[inline(always)]
pub(super) fn modulus_squared<R: Real>(a: R, b: R) -> R {
    let b = b + b.like(RAISE);
    a.fma(a, b * b)
}

/// The formula at `a + i y`, `a ≥ 0`.
#[inline(always)]
pub(super) fn kind(a: f64, y: f64) -> Kind {
    let b = y.abs();
    let r2 = modulus_squared(a, b);
    formula(r2, y < 0.0, b < STRIP, b < NEAR)
}
