//! The points of a bucket: brought together, put on their rows, computed, taken back.

use super::super::lanes::Lanes;
use super::super::pack::{Pack, Wide};
use super::super::real::{Real, Two};
use super::super::rows::{On, Rows};
use super::super::taylor::Duo;
use super::{CHUNK, Chunk, GROUPS, window};
use num_complex::Complex;

impl Chunk<'_> {
    /// A bucket whose formula gives the value at `a + i y` from `a`, `y` and the rows.
    #[inline(always)]
    pub(super) fn rounded<S: Wide, R: Rows<N>, const N: usize>(
        &mut self,
        simd: S,
        rows: R,
        bucket: usize,
        formula: impl Fn(S, Duo<S>, Duo<S>, On<'_, S, N>) -> (Duo<S>, Duo<S>),
    ) {
        let len = self.groups(bucket);
        self.locate(simd, rows, bucket, len);
        let mut at = 0;
        while at < len {
            let (x, y, on) = self.on(simd, rows, bucket, at);
            let (re, im) = formula(simd, x.magnitude(), y, on);
            self.scatter(bucket, at, re, im.with_sign_of(x));
            at += 2 * S::WIDTH;
        }
    }

    /// A bucket whose formula gives the value and whether digits were lost.
    #[inline(always)]
    pub(super) fn unless_lost<S: Wide, L: Lanes, R: Rows<N>, const N: usize>(
        &mut self,
        simd: S,
        lanes: L,
        rows: R,
        bucket: usize,
        formula: impl Fn(
            S,
            Duo<S>,
            Duo<S>,
            On<'_, S, N>,
        ) -> (Duo<S>, Duo<S>, <Duo<S> as Real>::Mask),
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
                for m in 0..(len - at).min(2 * S::WIDTH) {
                    if lost[m] > 0.0 {
                        let i = window(&self.buffers.order[bucket], at)[m];
                        self.cancelled(lanes, i);
                    }
                }
            }
            at += 2 * S::WIDTH;
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

    /// Two groups of points.
    #[inline(always)]
    pub(super) fn gather<S: Wide>(&self, simd: S, numbers: &[u8; GROUPS]) -> (Duo<S>, Duo<S>) {
        let (x, y) = simd.from_pairs(
            #[inline(always)]
            |m| self.at(numbers[m]),
        );
        let (p, q) = simd.from_pairs(
            #[inline(always)]
            |m| self.at(numbers[S::WIDTH + m]),
        );
        (
            Two(Pack(simd, x), Pack(simd, p)),
            Two(Pack(simd, y), Pack(simd, q)),
        )
    }

    /// Takes the values of two groups.
    #[inline(always)]
    pub(super) fn scatter<S: Wide>(&mut self, bucket: usize, at: usize, re: Duo<S>, im: Duo<S>) {
        let numbers = window(&self.buffers.order[bucket], at);
        for (k, (re, im)) in [(re.0, im.0), (re.1, im.1)].into_iter().enumerate() {
            let pairs = re.0.to_pairs(re.1, im.1);
            for m in 0..S::WIDTH {
                let [re, im] = pairs[m];
                self.w[numbers[k * S::WIDTH + m] as usize] = Complex::new(re, im);
            }
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
            let (x, y) = self.gather(simd, window(&self.buffers.order[bucket], at));
            let buffers = &mut *self.buffers;
            let [codes, dx, dy] = rows.locate(x.magnitude(), y);
            let codes = codes.array();
            for m in 0..2 * S::WIDTH {
                buffers.row[at + m] = rows.number(codes[m]);
            }
            x.store_at(&mut buffers.x, at);
            y.store_at(&mut buffers.y, at);
            dx.store_at(&mut buffers.dx, at);
            dy.store_at(&mut buffers.dy, at);
            at += 2 * S::WIDTH;
        }
    }

    /// Two groups of points, and their rows if they have been located.
    #[inline(always)]
    pub(super) fn on<S: Wide, R: Rows<N>, const N: usize>(
        &self,
        simd: S,
        rows: R,
        bucket: usize,
        at: usize,
    ) -> (Duo<S>, Duo<S>, On<'static, S, N>) {
        let buffers = &*self.buffers;
        let mut pair = [[rows.row(0); 8]; 2];
        if R::SOME {
            for m in 0..S::WIDTH {
                pair[0][m] = rows.row(buffers.row[at + m]);
                pair[1][m] = rows.row(buffers.row[at + S::WIDTH + m]);
            }
        }
        let on = On {
            rows: pair,
            dx: Duo::load(simd, &buffers.dx, at),
            dy: Duo::load(simd, &buffers.dy, at),
        };
        let (x, y) = match R::SOME {
            true => (
                Duo::load(simd, &buffers.x, at),
                Duo::load(simd, &buffers.y, at),
            ),
            false => self.gather(simd, window(&buffers.order[bucket], at)),
        };
        (x, y, on)
    }
}
