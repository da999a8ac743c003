//! The points of a bucket: brought together, put on their rows, computed, taken back.

use super::super::lanes::Lanes;
use super::super::pack::{Pack, Wide};
use super::super::real::Real;
use super::super::rows::{On, Rows};
use super::super::two::Two;
use super::{CHUNK, Chunk, Formula, GROUPS, window};
use num_complex::Complex;

impl Chunk<'_> {
    /// A bucket whose formula gives the value and needs no rows: two groups at once, because each
    /// operation waits for the one before.
    #[inline(always)]
    pub(super) fn without_rows<S: Wide>(&mut self, simd: S, bucket: usize, formula: impl Formula) {
        let len = self.groups(bucket);
        let mut at = 0;
        while at < len {
            let (x, y) = self.gather_two(simd, window(&self.buffers.order[bucket], at));
            let (re, im) = formula.value(x.magnitude(), y);
            let im = im.with_sign_of(x);
            self.scatter(bucket, at, re.0, im.0);
            self.scatter(bucket, at + S::WIDTH, re.1, im.1);
            at += 2 * S::WIDTH;
        }
    }

    /// A bucket whose formula gives the value from `a`, `y` and the rows.
    #[inline(always)]
    pub(super) fn rounded<S: Wide, R: Rows<N>, const N: usize>(
        &mut self,
        simd: S,
        rows: R,
        bucket: usize,
        formula: impl Fn(S, Pack<S>, Pack<S>, On<'_, S, N>) -> (Pack<S>, Pack<S>),
    ) {
        let len = self.groups(bucket);
        self.locate(simd, rows, bucket, len);
        let mut at = 0;
        while at < len {
            let (x, y, on) = self.on(simd, rows, bucket, at);
            let (re, im) = formula(simd, x.magnitude(), y, on);
            self.scatter(bucket, at, re, im.with_sign_of(x));
            at += S::WIDTH;
        }
    }

    /// A bucket whose formula gives the value, and whether digits were lost.
    #[inline(always)]
    pub(super) fn unless_lost<S: Wide, L: Lanes, R: Rows<N>, const N: usize>(
        &mut self,
        simd: S,
        lanes: L,
        rows: R,
        bucket: usize,
        formula: impl Fn(S, Pack<S>, Pack<S>, On<'_, S, N>) -> (Pack<S>, Pack<S>, S::m64s),
    ) {
        let len = self.groups(bucket);
        self.locate(simd, rows, bucket, len);
        let mut at = 0;
        while at < len {
            let (x, y, on) = self.on(simd, rows, bucket, at);
            let (re, im, lost) = formula(simd, x.magnitude(), y, on);
            self.scatter(bucket, at, re, im.with_sign_of(x));
            let lost = re.pick(lost, re.like(1.0), re.like(0.0));
            if !lost.is_zero() {
                let lost = lost.array();
                for m in 0..(len - at).min(S::WIDTH) {
                    if lost[m] > 0.0 {
                        let i = window(&self.buffers.order[bucket], at)[m];
                        self.cancelled(lanes, i);
                    }
                }
            }
            at += S::WIDTH;
        }
    }

    /// How many points a bucket has; the last one is repeated, so that groups are whole.
    #[inline(always)]
    pub(super) fn groups(&mut self, bucket: usize) -> usize {
        let buffers = &mut *self.buffers;
        let len = buffers.len[bucket].min(CHUNK);
        if len > 0 {
            let last = buffers.order[bucket][len - 1];
            buffers.order[bucket][len..len + GROUPS].fill(last);
        }
        len
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
        let numbers = window(&self.buffers.order[bucket], at);
        let pairs = re.0.interleave(re.1, im.1);
        for m in 0..S::WIDTH {
            let [re, im] = pairs[m];
            self.w[numbers[m] as usize] = Complex::new(re, im);
        }
    }

    /// Brings the points of a bucket together, finds their rows and the distances from the centres:
    /// beforehand, because all that follows waits for the row.
    #[inline(always)]
    pub(super) fn locate<S: Wide, R: Rows<N>, const N: usize>(
        &mut self,
        simd: S,
        rows: R,
        bucket: usize,
        len: usize,
    ) {
        if !R::SOME {
            return;
        }
        let mut at = 0;
        while at < len {
            let (x, y) = self.gather(simd, window(&self.buffers.order[bucket], at), 0);
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

    /// A group of points, and its rows if they have been located.
    #[inline(always)]
    pub(super) fn on<S: Wide, R: Rows<N>, const N: usize>(
        &self,
        simd: S,
        rows: R,
        bucket: usize,
        at: usize,
    ) -> (Pack<S>, Pack<S>, On<'static, S, N>) {
        let buffers = &*self.buffers;
        let mut group = [rows.row(0); 8];
        if R::SOME {
            for m in 0..S::WIDTH {
                group[m] = rows.row(buffers.row[at + m]);
            }
        }
        let on = On {
            rows: group,
            dx: Pack::load(simd, &buffers.dx, at),
            dy: Pack::load(simd, &buffers.dy, at),
        };
        let (x, y) = match R::SOME {
            true => (
                Pack::load(simd, &buffers.x, at),
                Pack::load(simd, &buffers.y, at),
            ),
            false => self.gather(simd, window(&buffers.order[bucket], at), 0),
        };
        (x, y, on)
    }
}
