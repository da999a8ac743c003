//! Which row of a table serves a point, and how far the point is from its centre.

use super::branch::{FINE, ROWS_ON_REAL_AXIS, STRIP, modulus_squared};
use super::constants::TWO_OVER_SQRT_PI;
use super::tables::{self, ZEROS};
use super::taylor::{ComplexRow, RealRow};
use super::zeros::candidate;
use crate::double_double::Dd;
use crate::real::{ROUND, Real};
use std::f64::consts::FRAC_1_PI;

/// The distance between the centres of fine cells, and on the imaginary axis and in the lower
/// half-disc; of coarse cells; on the real axis.
pub(super) const FINE_PITCH: f64 = 0.25;
pub(super) const COARSE_PITCH: f64 = 0.5;
pub(super) const REAL_AXIS_PITCH: f64 = 0.0625;
/// States what the distance from the real axis is raised to beside it: no part of w is changed by
/// that there, and products with smaller numbers would be subnormal.
const LEAST: f64 = 1e-80;

/// Half the side of the square around a zero in which its expansion is used, times the real part of
/// the zero: farther off the second term of the expansion, `|z_k||δ|` of the first, would make its
/// roundings those of w.
pub(super) const REACH: f64 = 0.124;

/// Entry `n` of a table that has it: the last one otherwise, which costs less than a bounds check
/// that may panic.
#[inline(always)]
pub(super) fn entry<T>(table: &[T], n: usize) -> &T {
    &table[n.min(table.len() - 1)]
}

/// The number of the cell around `a + i b`, plus `ROUND`, and the distance from its centre.
#[inline(always)]
pub(super) fn cell<R: Real>(a: R, b: R) -> [R; 3] {
    let like = |x: f64| a.like(x);
    // Beside the real axis the fine cells go on.
    let fine = a.or(a.at_least(b).below(like(FINE)), b.below(like(2.0 * STRIP)));
    // Not three choices: they would become a branch.
    let fine = a.pick(fine, like(1.0), like(0.0));
    let coarser = 1.0 / COARSE_PITCH;
    let step = fine.fma(like(1.0 / FINE_PITCH - coarser), like(coarser));
    let unit = fine.fma(like(COARSE_PITCH - FINE_PITCH), like(-COARSE_PITCH));
    let base = fine.fma(like(-512.0), like(ROUND + 512.0));
    let round = like(ROUND);
    let (i, j) = (a.fma(step, round) - round, b.fma(step, round) - round);
    [j.fma(like(32.0), i) + base, i.fma(unit, a), j.fma(unit, b)]
}

/// The row of the cell around `a + i b`, and the distance from its centre.
#[inline(always)]
pub(super) fn in_cell(a: f64, b: f64) -> (&'static ComplexRow, f64, f64) {
    let [n, dx, dy] = cell(a, b);
    (cell_row(n), dx, dy)
}

/// The row of cell number `n`.
#[inline(always)]
pub(super) fn cell_row(n: f64) -> &'static ComplexRow {
    entry(&tables::CELLS, cell_number(n) as usize)
}

/// Its place in the table.
#[inline(always)]
pub(super) fn cell_number(n: f64) -> u16 {
    tables::CELL[n.to_bits() as usize & 1023]
}

/// The number of the centre on the real axis next to `a`, plus `ROUND`, and the distance from it.
#[inline(always)]
pub(super) fn on_real_axis<R: Real>(a: R) -> (R, R) {
    let round = a.like(ROUND);
    let n = a.fma(a.like(1.0 / REAL_AXIS_PITCH), round);
    (n, (n - round).fma(a.like(-REAL_AXIS_PITCH), a))
}

/// The number of the first centre there that has a row.
const FIRST_OF_REAL_AXIS: u16 = 18;

/// The row of centre `n` on the real axis.
#[inline(always)]
pub(super) fn real_axis_row(n: f64) -> &'static ComplexRow {
    entry(&tables::REAL_AXIS, real_axis_number(n) as usize)
}

/// Its place in the table.
#[inline(always)]
pub(super) fn real_axis_number(n: f64) -> u16 {
    (n.to_bits() as u16 & 255).wrapping_sub(FIRST_OF_REAL_AXIS)
}

/// Rows of `(2/√π) F`, F Dawson's function, about real centres: on the real axis
/// `w = e^{−x²} + i (2/√π) F(x)`. First those of cells.
pub(super) static DAWSON: [RealRow; OF_CELLS + tables::REAL_AXIS.len()] = {
    let mut rows = [const { RealRow([0.0; 20]) }; OF_CELLS + tables::REAL_AXIS.len()];
    let mut k = 0;
    while k < rows.len() {
        let c = match k < OF_CELLS {
            true => &tables::CELLS[tables::CELL[k + FIRST_CELL] as usize].0,
            false => &tables::REAL_AXIS[k - OF_CELLS].0,
        };
        let d = &mut rows[k].0;
        [d[0], d[1], d[2], d[3]] = [c[2], c[3], c[6], c[7]];
        let mut n = 0;
        while n < 16 {
            d[4 + n] = c[12 + 8 * (n / 4) + n % 4];
            n += 1;
        }
        k += 1;
    }
    rows
};
/// Rows of erf about the real centres 1/4, 1/2, …, 6, from those of w: there `Re w = e^{−x²}`, so
/// that with its coefficients `c_n` those of erf are `(2/√π) c_{n−1}/n`, and `erf x = 1 − e^{−x²}
/// erfcx x`.
pub(super) static ERF: [RealRow; 24] = {
    let mut rows = [const { RealRow([0.0; 20]) }; 24];
    let mut k = 0;
    while k < rows.len() {
        let at = k + 1;
        let c = match at <= CENTRES_OF_FINE_CELLS {
            true => &tables::CELLS[tables::CELL[at] as usize].0,
            false => &tables::REAL_AXIS[4 * at - FIRST_OF_REAL_AXIS as usize].0,
        };
        let (e, w) = (exact(c, 0), exact(&tables::IMAGINARY_AXIS[at].0, 0));
        let (value, slope) = (complement(product(e, w)), product(e, TWO_OVER_SQRT_PI));
        let d = &mut rows[k].0;
        [d[0], d[1], d[2], d[3]] = [value.hi, value.lo, slope.hi, slope.lo];
        // Re c₁ has two parts, of which the first suffices, the others one.
        d[4] = TWO_OVER_SQRT_PI.hi * c[4] / 2.0;
        let mut n = 3;
        while n < 18 {
            d[n + 2] = TWO_OVER_SQRT_PI.hi * c[8 + 8 * ((n - 3) / 4) + (n - 3) % 4] / n as f64;
            n += 1;
        }
        k += 1;
    }
    rows
};
/// Centres of cells on the real axis, but 0.
const CENTRES_OF_FINE_CELLS: usize = 4;

/// Two numbers of a row as one in two parts.
const fn exact<const N: usize>(row: &[f64; N], at: usize) -> Dd {
    Dd::new(row[at], row[at + 1])
}

/// `ab` by parts of 26 bits (Dekker): constants have no fused operations.
const fn product(a: Dd, b: Dd) -> Dd {
    const fn halves(x: f64) -> [f64; 2] {
        let c = 134_217_729.0 * x;
        let high = c - (c - x);
        [high, x - high]
    }
    let p = a.hi * b.hi;
    let ([a1, a2], [b1, b2]) = (halves(a.hi), halves(b.hi));
    let lost = ((a1 * b1 - p) + a1 * b2 + a2 * b1) + a2 * b2;
    normal(p, lost + (a.hi * b.lo + a.lo * b.hi))
}

/// `1 − a`, `|a| < 1`.
const fn complement(a: Dd) -> Dd {
    let s = 1.0 - a.hi;
    normal(s, (1.0 - s) - a.hi - a.lo)
}

const fn normal(hi: f64, lo: f64) -> Dd {
    let s = hi + lo;
    Dd::new(s, lo - (s - hi))
}

/// The row of [`ERF`] of centre `n` as [`on_axis`] numbers them.
#[inline(always)]
pub(super) fn erf_row(n: f64) -> &'static RealRow {
    entry(&ERF, (n.to_bits() as usize & 31).wrapping_sub(1))
}

/// The cells about 1/2, 3/4 and 1.
const FIRST_CELL: usize = 2;
const OF_CELLS: usize = 3;

/// `ROUND` plus the place in [`DAWSON`] of the row for `x ≥ ½`, and the distance from its centre.
#[inline(always)]
pub(super) fn on_axis_of_dawson<R: Real>(x: R) -> (R, R) {
    let like = |c: f64| x.like(c);
    let cells = modulus_squared(x, like(0.0)).below(like(ROWS_ON_REAL_AXIS[0]));
    let pitch = x.pick(cells, like(FINE_PITCH), like(REAL_AXIS_PITCH));
    let step = x.pick(cells, like(1.0 / FINE_PITCH), like(1.0 / REAL_AXIS_PITCH));
    let before = OF_CELLS as f64 - FIRST_OF_REAL_AXIS as f64;
    let first = x.pick(cells, like(-(FIRST_CELL as f64)), like(before));
    let k = x.fma(step, like(ROUND)) - like(ROUND);
    ((k + first) + like(ROUND), k.fma(-pitch, x))
}

/// The row of [`DAWSON`] with this place.
#[inline(always)]
pub(super) fn dawson_row(n: f64) -> &'static RealRow {
    entry(&DAWSON, n.to_bits() as usize & 255)
}

/// The number of the cell of the lower half-disc around `a + i y`, plus `ROUND`, and the distance
/// from its centre.
#[inline(always)]
pub(super) fn disc_cell<R: Real>(a: R, y: R) -> [R; 3] {
    let (i, dx) = on_axis(a);
    let (j, dy) = on_axis(y);
    let round = a.like(ROUND);
    [(j - round).fma(a.like(-5.0), i), dx, dy]
}

/// The row of cell number `n` of the lower half-disc.
#[inline(always)]
pub(super) fn disc_row(n: f64) -> &'static ComplexRow {
    entry(&tables::DISC, disc_number(n) as usize)
}

/// Its place in the table.
#[inline(always)]
pub(super) fn disc_number(n: f64) -> u16 {
    n.to_bits() as u16 & 31
}

/// `ROUND` plus the number of the centre on an axis next to `x`, and the distance from it.
#[inline(always)]
pub(super) fn on_axis<R: Real>(x: R) -> (R, R) {
    let round = x.like(ROUND);
    let n = x.fma(x.like(1.0 / FINE_PITCH), round);
    (n, (n - round).fma(x.like(-FINE_PITCH), x))
}

/// The row of centre `n` on the imaginary axis.
#[inline(always)]
pub(super) fn imaginary_axis_row(n: f64) -> &'static RealRow {
    entry(&tables::IMAGINARY_AXIS, n.to_bits() as usize & 31)
}

/// The distance from the real axis where [`LEAST`] makes no difference.
#[inline(always)]
pub(super) fn above_real_axis<R: Real>(b: R) -> R {
    b.raised(LEAST)
}

/// The same below the real axis.
#[inline(always)]
pub(super) fn below_real_axis<R: Real>(y: R) -> R {
    -((-y).raised(LEAST))
}

/// The zero next to `a − i b`, if the point lies in its square: `2ab/π` at the k-th zero is
/// `2k − 0.27`, nearly.
#[inline(always)]
pub(super) fn nearest_zero(a: f64, b: f64) -> Option<usize> {
    if !candidate(a, b) {
        return None;
    }
    let k = (a * b * FRAC_1_PI - 0.365) as usize;
    let z = &ZEROS.get(k)?.0;
    let near = |d: f64| d.abs() * z[0] <= REACH;
    (near(a - z[0]) && near(b + z[3])).then_some(k)
}

/// The row of zero `k`.
#[inline(always)]
pub(super) fn zero_row(k: usize) -> &'static [f64; 46] {
    &entry(&ZEROS, k).0
}
