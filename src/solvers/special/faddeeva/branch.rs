//! The choice of a formula: one ladder of limits of |z|², by which single points, batches and the
//! functions built on w go, and which [`SEAMS`](super::SEAMS) publishes.

use crate::hex::hex;
use crate::real::Real;

/// A formula for w(z).
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

pub(super) const MACLAURIN_9: Branch = Branch::Maclaurin { terms: 9 };
pub(super) const MACLAURIN_21: Branch = Branch::Maclaurin { terms: 21 };
pub(super) const CELL: Branch = Branch::Cell { terms: 18 };
pub(super) const LOWER_CELL: Branch = Branch::LowerCell { terms: 18 };
pub(super) const IMAGINARY_AXIS: Branch = Branch::ImaginaryAxis { terms: 18 };
pub(super) const REAL_AXIS: Branch = Branch::RealAxis { terms: 18 };
pub(super) const IN_STRIP: Branch = Branch::Strip { terms: 16 };
pub(super) const REAL_LINE: Branch = Branch::RealLine { terms: 10 };
pub(super) const SERIES_26: Branch = Branch::Asymptotic { terms: 26 };
pub(super) const SERIES_14: Branch = Branch::Asymptotic { terms: 14 };
pub(super) const SERIES_6: Branch = Branch::Asymptotic { terms: 6 };
pub(super) const SERIES_4: Branch = Branch::Asymptotic { terms: 4 };
pub(super) const SERIES_2: Branch = Branch::Asymptotic { terms: 2 };

impl Branch {
    /// A number for each formula for w that has no other condition than its place; batches sort by
    /// it.
    #[inline(always)]
    pub(super) const fn number(self) -> usize {
        match self {
            CELL => 0,
            SERIES_26 => 1,
            SERIES_14 => 2,
            SERIES_6 => 3,
            REAL_AXIS => 4,
            SERIES_4 => 5,
            SERIES_2 => 6,
            MACLAURIN_9 => 7,
            MACLAURIN_21 => 8,
            LOWER_CELL => 9,
            IN_STRIP => 10,
            REAL_LINE => 11,
            _ => 12,
        }
    }

    #[inline(always)]
    const fn same(self, other: Branch) -> bool {
        self.number() == other.number()
    }
}

/// The formulas between two circles.
pub(super) struct Ring {
    /// The least |z|².
    pub from: f64,
    /// For w above the real axis, each component as one number.
    pub above: Branch,
    /// For w below it.
    pub below: Branch,
    /// For w in the first quadrant as pairs of `f64`, from which the other functions are made.
    pub pairs: Branch,
    /// For all of them in the strip beside the real axis, if it is another one there.
    pub strip: Option<Branch>,
}

const fn ring(from: f64, [above, below, pairs]: [Branch; 3], strip: Option<Branch>) -> Ring {
    Ring {
        from,
        above,
        below,
        pairs,
        strip,
    }
}

/// The ladder. Every limit but the last is one of 1, 5/4, 3/2, 7/4 times a power of two, so that
/// the exponent and the first two bits of the fraction tell which side of it a number is on.
///
/// The asymptotic series leaves out less than 2⁻⁵⁹ of w wherever pairs are summed. From
/// 768 on `e^{−z²}` in the strip is below every `f64`; from the last limit on z is scaled first.
#[rustfmt::skip]
pub(super) const RINGS: [Ring; 13] = [
    //   |z|²            above         below         pairs         strip
    ring(0.0,           [MACLAURIN_9,  MACLAURIN_9,  CELL],      None),
    ring(1.0 / 16384.0, [MACLAURIN_21, MACLAURIN_21, CELL],      None),
    ring(1.0 / 16.0,    [CELL,         LOWER_CELL,   CELL],      None),
    ring(1.0,           [CELL,         CELL,         CELL],      None),
    ring(1.25,          [CELL,         CELL,         CELL],      Some(REAL_AXIS)),
    ring(48.0,          [SERIES_26,    SERIES_26,    SERIES_26], Some(REAL_AXIS)),
    ring(80.0,          [SERIES_26,    SERIES_26,    SERIES_26], Some(IN_STRIP)),
    ring(112.0,         [SERIES_14,    SERIES_14,    SERIES_14], Some(IN_STRIP)),
    ring(768.0,         [SERIES_14,    SERIES_14,    SERIES_14], None),
    ring(1024.0,        [SERIES_6,     SERIES_6,     SERIES_6],  None),
    ring(5120.0,        [SERIES_4,     SERIES_6,     SERIES_6],  None),
    ring(1_048_576.0,   [SERIES_2,     SERIES_6,     SERIES_2],  None),
    ring(1e200,         [Branch::Huge, Branch::Huge, Branch::Huge], None),
];

/// The rings where the asymptotic series begins, where two terms of it begin to suffice, and where
/// z is scaled.
const FAR: usize = 5;
const TWO_TERMS: usize = 11;
const SCALED: usize = 12;

/// |z|² below which nine terms of the Maclaurin series suffice, and from which two of the
/// asymptotic series do.
pub(super) const NEAREST: f64 = RINGS[1].from;
pub(super) const FARTHEST: f64 = RINGS[TWO_TERMS].from;
/// |z|² from which z is scaled first.
pub(super) const HUGE: f64 = RINGS[SCALED].from;

/// Within these limits of the larger of |Re z| and |Im z|, |z|² is within [`NEAREST`], [`FARTHEST`]
/// and [`HUGE`], however it is rounded.
pub(super) const SURELY_NEAREST: f64 = 0.0055;
pub(super) const SURELY_FARTHEST: f64 = 1024f64.next_up();
pub(super) const SURELY_BELOW_HUGE: f64 = 7e99;
const _: () = {
    assert!(2.0 * SURELY_NEAREST * SURELY_NEAREST < 0.999 * NEAREST);
    assert!(SURELY_FARTHEST * SURELY_FARTHEST > FARTHEST);
    assert!(2.0 * SURELY_BELOW_HUGE * SURELY_BELOW_HUGE < 0.999 * HUGE);
};

/// Half the distance of the centres of the fine cells, and half the width of the strips beside the
/// axes; 1/8 belongs to the strip, where a cell's centre would be on the axis.
pub(super) const STRIP: f64 = 0.125_f64.next_up();
/// Where the fine cells end: the larger of |Re z|, |Im z|.
pub(super) const FINE: f64 = 3.75;
/// Closer to the real axis only the first power of Im z counts in the strip.
pub(super) const NEAR: f64 = hex("0x1p-28");
/// Closer to the imaginary axis, and on it, batches leave points to the scalar code.
pub(super) const TINY: f64 = 1e-290;

/// A column of the ladder.
type Column = [Branch; RINGS.len()];

/// The columns. That of the strip, which has formulas of its own only in the middle, repeats the
/// first and the last of them.
const COLUMNS: [Column; 4] = {
    let mut columns = [[REAL_AXIS; RINGS.len()]; 4];
    let mut k = 0;
    while k < RINGS.len() {
        columns[0][k] = RINGS[k].above;
        columns[1][k] = RINGS[k].below;
        columns[2][k] = RINGS[k].pairs;
        columns[3][k] = match RINGS[k].strip {
            Some(formula) => formula,
            None if k > 0 => columns[3][k - 1],
            None => REAL_AXIS,
        };
        k += 1;
    }
    columns
};
const ABOVE: &Column = &COLUMNS[0];
const BELOW: &Column = &COLUMNS[1];
#[cfg(feature = "proof")]
const PAIRS: &Column = &COLUMNS[2];
const STRIPS: &Column = &COLUMNS[3];

/// |z|² between which the strip has formulas of its own.
const STRIP_FROM: f64 = {
    let mut k = 0;
    while RINGS[k].strip.is_none() {
        k += 1;
    }
    RINGS[k].from
};
const STRIP_TO: f64 = {
    let mut k = RINGS.len();
    while RINGS[k - 1].strip.is_none() {
        k -= 1;
    }
    RINGS[k].from
};

#[inline(always)]
const fn has_strip(r2: f64) -> bool {
    (r2 >= STRIP_FROM) & (r2 < STRIP_TO)
}

/// The entry of a column for |z|²; what is not a number has the last one. From the first change
/// where the asymptotic series begins or after it in either direction, and past limits at which the
/// column does not change: compiled, a few comparisons are left, the most frequent first.
#[inline(always)]
const fn look_up(column: &Column, r2: f64) -> Branch {
    let mut k = FAR;
    while column[k].same(column[k - 1]) {
        k += 1;
    }
    if r2 < RINGS[k].from {
        k -= 1;
        while k > 0 && (column[k].same(column[k - 1]) || r2 < RINGS[k].from) {
            k -= 1;
        }
    } else {
        while k < SCALED && (column[k].same(column[k + 1]) || !(r2 < RINGS[k + 1].from)) {
            k += 1;
        }
    }
    column[k]
}

/// The formula for w at a point, by |z|², whether it lies in the lower half-plane, in the strip
/// beside the real axis, and next to it.
#[inline(always)]
pub(super) const fn formula(r2: f64, low: bool, beside_real: bool, next_to_real: bool) -> Branch {
    if beside_real && has_strip(r2) {
        return match look_up(STRIPS, r2) {
            IN_STRIP if next_to_real => REAL_LINE,
            formula => formula,
        };
    }
    look_up(if low { BELOW } else { ABOVE }, r2)
}

/// The formula for w at `a + i y`, `a ≥ 0`.
#[inline(always)]
pub(super) fn formula_at(a: f64, y: f64) -> Branch {
    let b = y.abs();
    let r2 = modulus_squared(a, b);
    formula(r2, y < 0.0, b < STRIP, b < NEAR)
}

/// |z|² where the rows for pairs and the series with 26, 14, 6 and 2 terms end. The last one does
/// not: callers see to huge points, by |z|² rounded in another order perhaps.
pub(super) const ENDS_OF_PAIRS: [f64; 5] = {
    let formulas = [CELL, SERIES_26, SERIES_14, SERIES_6];
    let mut ends = [f64::INFINITY; 5];
    let mut k = 0;
    while k < formulas.len() {
        let mut last = SCALED - 1;
        while !RINGS[last].pairs.same(formulas[k]) {
            last -= 1;
        }
        ends[k] = RINGS[last + 1].from;
        k += 1;
    }
    ends
};

/// |z|² between which the strip beside the real axis has formulas of its own.
pub(super) const STRIP_ENDS: [f64; 2] = [STRIP_FROM, STRIP_TO];

/// |z|² from which rows about the real axis serve on it, and where they end.
pub(super) const ROWS_ON_REAL_AXIS: [f64; 2] = {
    let mut last = SCALED;
    while !matches!(RINGS[last].strip, Some(REAL_AXIS)) {
        last -= 1;
    }
    [STRIP_FROM, RINGS[last + 1].from]
};

/// The series of it, whether or not `e^{−z²}` is added.
#[cfg(feature = "proof")]
pub(super) fn series_of_pairs(a: f64, b: f64) -> Branch {
    look_up(PAIRS, modulus_squared(a, b))
}

/// Returns whether the functions built on pairs are computed from their limits at `x + i y`: where
/// z is huge, or not a number.
#[inline(always)]
pub(super) fn is_huge(x: f64, y: f64) -> bool {
    !(modulus_squared(x, y) < HUGE)
}

/// Added to the distance from the real axis, where it does not count in |z|²: squares that
/// underflow take as long as half of a formula.
const RAISE: f64 = 1e-150;

/// |z|², by which the formula is chosen.
#[inline(always)]
pub(super) fn modulus_squared<R: Real>(a: R, b: R) -> R {
    let b = b + b.like(RAISE);
    a.fma(a, b * b)
}
