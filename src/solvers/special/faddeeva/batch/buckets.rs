//! The points of a bucket: brought together, put on their rows, computed, taken back.

use super::super::taylor::OnRows;
use super::chunk::{Chunk, GROUPS};
use super::formulas::Formula;
use super::tables::Rows;
use crate::lanes::Lanes;
use crate::pack::{Pack, Wide};
use crate::real::{Masked, Real};
use crate::two::Two;
use num_complex::Complex;

impl Chunk<'_> {
    /// A bucket whose formula gives the value and needs no rows: two groups at once, because each
    /// operation waits for the one before.
    #[inline(always)]
    pub(super) fn without_rows<S: Wide>(&mut self, simd: S, bucket: usize, formula: impl Formula) {
        let len = self.buffers.order.len(bucket);
        let mut at = 0;
        while at < len {
            let (x, y) = self.gather_two(simd, self.buffers.order.numbers(bucket, at));
            let (re, im) = formula.value(x.magnitude(), y);
            let im = im.with_sign_of(x);
            self.scatter(bucket, at, re.0, im.0);
            self.scatter(bucket, at + S::WIDTH, re.1, im.1);
            at += 2 * S::WIDTH;
        }
    }

    /// A bucket whose points have rows of a table: each group of them.
    #[inline(always)]
    pub(super) fn on_rows<S: Wide>(
        &mut self,
        simd: S,
        rows: impl Rows,
        bucket: usize,
        mut each: impl FnMut(&mut Self, usize, Pack<S>, Pack<S>, OnRows<'_, S>),
    ) {
        let len = self.buffers.order.len(bucket);
        self.locate(simd, rows, bucket, len);
        let mut at = 0;
        while at < len {
            let buffers = &*self.buffers;
            let mut group = [rows.row(0); 8];
            for m in 0..S::WIDTH {
                group[m] = rows.row(buffers.row[at + m]);
            }
            let on = OnRows {
                rows: group,
                dx: Pack::load(simd, &buffers.dx, at),
                dy: Pack::load(simd, &buffers.dy, at),
            };
            let (x, y) = (
                Pack::load(simd, &buffers.x, at),
                Pack::load(simd, &buffers.y, at),
            );
            each(self, at, x, y, on);
            at += S::WIDTH;
        }
    }

    /// A bucket whose formula gives the value from the rows.
    #[inline(always)]
    pub(super) fn rounded<S: Wide>(&mut self, simd: S, rows: impl Rows, bucket: usize) {
        self.on_rows(
            simd,
            rows,
            bucket,
            #[inline(always)]
            |chunk, at, x, _, on| {
                let (re, im) = on.rounded(simd);
                chunk.scatter(bucket, at, re, im.with_sign_of(x));
            },
        );
    }

    /// Computes again the points of a group, from `at` on, that have lost digits.
    #[inline(always)]
    pub(super) fn recompute<S: Wide, L: Lanes, const M: usize>(
        &mut self,
        lanes: L,
        bucket: usize,
        at: usize,
        lost: [(S::m64s, Pack<S>); M],
    ) {
        let len = self.buffers.order.len(bucket);
        for (k, (lost, any)) in lost.into_iter().enumerate() {
            let lost = any.pick(lost, any.like(1.0), any.like(0.0));
            if lost.is_zero() {
                continue;
            }
            let (lost, at) = (lost.array(), at + k * S::WIDTH);
            for m in 0..len.saturating_sub(at).min(S::WIDTH) {
                if lost[m] > 0.0 {
                    self.cancelled(lanes, self.buffers.order.numbers(bucket, at)[m]);
                }
            }
        }
    }

    /// The points with the numbers from a place on.
    #[inline(always)]
    pub(super) fn gather<S: Wide>(
        &self,
        simd: S,
        numbers: &[u8; GROUPS],
        from: usize,
    ) -> (Pack<S>, Pack<S>) {
        let (x, y) = simd.deinterleave(
            #[inline(always)]
            |m| self.at(numbers[from + m]),
        );
        (Pack(simd, x), Pack(simd, y))
    }

    /// The points of two groups.
    #[inline(always)]
    pub(super) fn gather_two<S: Wide>(
        &self,
        simd: S,
        numbers: &[u8; GROUPS],
    ) -> (Two<Pack<S>>, Two<Pack<S>>) {
        let (x, y) = self.gather(simd, numbers, 0);
        let (p, q) = self.gather(simd, numbers, S::WIDTH);
        (Two(x, p), Two(y, q))
    }

    /// Takes the values of a group.
    #[inline(always)]
    pub(super) fn scatter<S: Wide>(&mut self, bucket: usize, at: usize, re: Pack<S>, im: Pack<S>) {
        let numbers = self.buffers.order.numbers(bucket, at);
        let pairs = re.0.interleave(re.1, im.1);
        for m in 0..S::WIDTH {
            let [re, im] = pairs[m];
            self.w[numbers[m] as usize] = Complex::new(re, im);
        }
    }

    /// Brings the points of a bucket together, finds their rows and the distances from the centres:
    /// beforehand, because all that follows waits for the row.
    #[inline(always)]
    fn locate<S: Wide>(&mut self, simd: S, rows: impl Rows, bucket: usize, len: usize) {
        let mut at = 0;
        while at < len {
            let (x, y) = self.gather(simd, self.buffers.order.numbers(bucket, at), 0);
            let buffers = &mut *self.buffers;
            let [codes, dx, dy] = rows.locate(x.magnitude(), y);
            let codes = codes.array();
            for m in 0..S::WIDTH {
                buffers.row[at + m] = rows.number(codes[m]);
            }
            x.store_at(&mut buffers.x, at);
            y.store_at(&mut buffers.y, at);
            dx.store_at(&mut buffers.dx, at);
            dy.store_at(&mut buffers.dy, at);
            at += S::WIDTH;
        }
    }
}
