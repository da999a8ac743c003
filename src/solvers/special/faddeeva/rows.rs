//! Which row of a table serves a point, and how far the point is from its centre.

use super::branch::{FINE, STRIP};
use super::tables::{self, ZEROS};
use super::taylor::ComplexRow;
use super::zeros::candidate;
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
pub(super) fn imaginary_axis_row(n: f64) -> &'static [f64; 20] {
    &entry(&tables::IMAGINARY_AXIS, n.to_bits() as usize & 31).0
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
