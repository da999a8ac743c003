//! The tables of Taylor rows as batches use them: which row serves each of a group of points.

use super::pack::{Pack, Wide};
use super::plane::{cell, cell_number, disc_cell, disc_number, entry, imaginary_axis_number};
use super::plane::{on_axis, on_real_axis, real_axis_number};
use super::real::Real;
use super::tables::{CELLS, DISC, IMAGINARY_AXIS, REAL_AXIS};

/// A table of rows with N numbers.
pub(super) trait Rows<const N: usize>: Copy {
    /// Whether there is a table.
    const SOME: bool = true;
    /// For `a + i y`: the code of the row plus `ROUND`, and the distance from its centre.
    fn locate<R: Real>(self, a: R, y: R) -> [R; 3];
    /// The row's place in the table, by its code.
    fn number(self, code: f64) -> u16;
    fn row(self, number: u16) -> &'static [f64; N];
}

/// A formula without rows.
#[derive(Clone, Copy)]
pub(super) struct NoRows;

impl Rows<0> for NoRows {
    const SOME: bool = false;
    #[inline(always)]
    fn locate<R: Real>(self, a: R, _: R) -> [R; 3] {
        [a; 3]
    }
    #[inline(always)]
    fn number(self, _: f64) -> u16 {
        0
    }
    #[inline(always)]
    fn row(self, _: u16) -> &'static [f64; 0] {
        &[]
    }
}

#[derive(Clone, Copy)]
pub(super) struct Cells;

impl Rows<40> for Cells {
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
        &entry(&CELLS, number as usize).0
    }
}

#[derive(Clone, Copy)]
pub(super) struct LowerDisc;

impl Rows<40> for LowerDisc {
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
        &entry(&DISC, number as usize).0
    }
}

#[derive(Clone, Copy)]
pub(super) struct RealAxis;

impl Rows<40> for RealAxis {
    #[inline(always)]
    fn locate<R: Real>(self, a: R, y: R) -> [R; 3] {
        let (code, t) = on_real_axis(a);
        [code, t, y]
    }
    #[inline(always)]
    fn number(self, code: f64) -> u16 {
        real_axis_number(code)
    }
    #[inline(always)]
    fn row(self, number: u16) -> &'static [f64; 40] {
        &entry(&REAL_AXIS, number as usize).0
    }
}

#[derive(Clone, Copy)]
pub(super) struct ImaginaryAxis;

impl Rows<20> for ImaginaryAxis {
    #[inline(always)]
    fn locate<R: Real>(self, a: R, y: R) -> [R; 3] {
        let (code, t) = on_axis(y.magnitude());
        [code, t, a]
    }
    #[inline(always)]
    fn number(self, code: f64) -> u16 {
        imaginary_axis_number(code)
    }
    #[inline(always)]
    fn row(self, number: u16) -> &'static [f64; 20] {
        &entry(&IMAGINARY_AXIS, number as usize).0
    }
}

/// A group of points on their rows: these, and the distances from their centres.
pub(super) struct On<'a, S: Wide, const N: usize> {
    pub rows: [&'a [f64; N]; 8],
    pub dx: Pack<S>,
    pub dy: Pack<S>,
}
