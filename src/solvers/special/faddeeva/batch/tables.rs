//! The tables of Taylor rows as batches use them: which row serves each of a group of points.

use super::super::rows::{
    above_real_axis, below_real_axis, cell, cell_number, disc_cell, disc_number, entry,
    on_real_axis, real_axis_number,
};
use super::super::tables::{CELLS, DISC, REAL_AXIS};
use super::super::taylor::ComplexRow;
use crate::real::Real;

/// A table of rows.
pub(super) trait Rows: Copy {
    /// For `a + i y`: the code of the row plus `ROUND`, and the distance from its centre.
    fn locate<R: Real>(self, a: R, y: R) -> [R; 3];
    /// The row's place in the table, by its code.
    fn number(self, code: f64) -> u16;
    fn row(self, number: u16) -> &'static [f64; 40];
}

/// A table whose place the compiler does not know: it would fetch it anew for every load.
#[inline(always)]
fn table<T>(rows: &'static T) -> &'static T {
    std::hint::black_box(rows)
}

#[derive(Clone, Copy)]
pub(super) struct Cells(&'static [ComplexRow; CELLS.len()]);

impl Cells {
    #[inline(always)]
    pub(super) fn new() -> Self {
        Cells(table(&CELLS))
    }
}

impl Rows for Cells {
    #[inline(always)]
    fn locate<R: Real>(self, a: R, y: R) -> [R; 3] {
        cell(a, y.magnitude())
    }
    #[inline(always)]
    fn number(self, code: f64) -> u16 {
        cell_number(code)
    }
    #[inline(always)]
    fn row(self, number: u16) -> &'static [f64; 40] {
        &entry(self.0, number as usize).0
    }
}

#[derive(Clone, Copy)]
pub(super) struct LowerDisc(&'static [ComplexRow; DISC.len()]);

impl LowerDisc {
    #[inline(always)]
    pub(super) fn new() -> Self {
        LowerDisc(table(&DISC))
    }
}

impl Rows for LowerDisc {
    #[inline(always)]
    fn locate<R: Real>(self, a: R, y: R) -> [R; 3] {
        disc_cell(a, y)
    }
    #[inline(always)]
    fn number(self, code: f64) -> u16 {
        disc_number(code)
    }
    #[inline(always)]
    fn row(self, number: u16) -> &'static [f64; 40] {
        &entry(self.0, number as usize).0
    }
}

#[derive(Clone, Copy)]
pub(super) struct RealAxis(&'static [ComplexRow; REAL_AXIS.len()]);

impl RealAxis {
    #[inline(always)]
    pub(super) fn new() -> Self {
        RealAxis(table(&REAL_AXIS))
    }
}

impl Rows for RealAxis {
    #[inline(always)]
    fn locate<R: Real>(self, a: R, y: R) -> [R; 3] {
        let (code, t) = on_real_axis(a);
        let below = y.below(y.like(0.0));
        let above = above_real_axis(y.magnitude());
        [code, t, y.pick(below, below_real_axis(y), above)]
    }
    #[inline(always)]
    fn number(self, code: f64) -> u16 {
        real_axis_number(code)
    }
    #[inline(always)]
    fn row(self, number: u16) -> &'static [f64; 40] {
        &entry(self.0, number as usize).0
    }
}
