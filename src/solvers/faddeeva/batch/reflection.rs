//! The lower half-plane: W at the mirror images by all formulas first, then the reflection of all of
//! them.

use super::super::asymptotic::{series, series_rounded};
use super::super::branch::Kind;
use super::super::double_double::Dd;
use super::super::exponential::{LARGE_PHASE, exp_minus_square};
use super::super::lanes::Lanes;
use super::super::pack::{Pack, Wide};
use super::super::real::{ROUND, Real};
use super::super::reflection::{
    ALONE, exponential_dominates, image_dominates, negligible, reflect,
};
use super::super::rows::Cells;
use super::super::zeros;
use super::bucket::{EXPONENTIAL_IN_CELL, IMAGE_BY_SERIES, IMAGE_IN_CELL, LOWER, SERIES_ALONE};
use super::{CHUNK, Chunk, Formula, GROUPS, window};
use num_complex::Complex;

/// The asymptotic series with 26 terms for w(−z), and `2e^{−z²}`, much smaller.
#[derive(Clone, Copy)]
struct ImageBySeries;

impl Formula for ImageBySeries {
    #[inline(always)]
    fn value<R: Real>(self, a: R, y: R) -> (R, R) {
        image_dominates(series_rounded::<_, 26>(a, y.magnitude()), a, y)
    }
}

/// The asymptotic series with 26 terms for w(−z), `2e^{−z²}` negligible.
#[derive(Clone, Copy)]
struct ImageAlone;

impl Formula for ImageAlone {
    #[inline(always)]
    fn value<R: Real>(self, a: R, y: R) -> (R, R) {
        let (u, v) = series_rounded::<_, 26>(a, y.magnitude());
        (-u, v)
    }
}

impl Chunk<'_> {
    /// The buckets in which one term dominates.
    #[inline(always)]
    pub(super) fn one_term_dominates<S: Wide, L: Lanes>(&mut self, simd: S, lanes: L) {
        self.on_rows(
            simd,
            Cells::new(),
            IMAGE_IN_CELL,
            #[inline(always)]
            |chunk, at, x, y, on| {
                let (re, im) = image_dominates(on.rounded(simd), x.magnitude(), y);
                chunk.scatter(IMAGE_IN_CELL, at, re, im.with_sign_of(x));
            },
        );
        self.on_rows(
            simd,
            Cells::new(),
            EXPONENTIAL_IN_CELL,
            #[inline(always)]
            |chunk, at, x, y, on| {
                let (re, im, lost) = exponential_dominates(on.rounded(simd), x.magnitude(), y);
                chunk.scatter(EXPONENTIAL_IN_CELL, at, re, im.with_sign_of(x));
                chunk.recompute(lanes, EXPONENTIAL_IN_CELL, at, [(lost, x)]);
            },
        );
        let alone = Kind::Series26 as usize + LOWER + SERIES_ALONE;
        self.without_rows(simd, IMAGE_BY_SERIES, ImageBySeries);
        self.without_rows(simd, alone, ImageAlone);
    }

    /// The buckets in which neither term is negligible, no phase large and no exponential beyond every f64.
    #[inline(always)]
    pub(super) fn both_terms<S: Wide, L: Lanes>(&mut self, simd: S, lanes: L) {
        let bucket = Kind::Cell as usize + LOWER;
        self.on_rows(
            simd,
            Cells::new(),
            bucket,
            #[inline(always)]
            |chunk, at, x, y, on| {
                let image = on.unevaluated(simd);
                chunk.reflect(lanes, (bucket, at), image, (x, y));
            },
        );
        let bucket = Kind::Series26 as usize + LOWER;
        let mut at = 0;
        while at < self.buffers.len(bucket) {
            let (x, y) = self.gather(simd, self.buffers.numbers(bucket, at), 0);
            let image = series::<_, 26>(x.magnitude(), y.magnitude());
            self.reflect(lanes, (bucket, at), image, (x, y));
            at += S::WIDTH;
        }
    }

    /// A group of such points.
    #[inline(always)]
    fn reflect<S: Wide, L: Lanes>(
        &mut self,
        lanes: L,
        (bucket, at): (usize, usize),
        image: (Dd<Pack<S>>, Dd<Pack<S>>),
        (x, y): (Pack<S>, Pack<S>),
    ) {
        let a = x.magnitude();
        let (re, im, lost) = reflect(image, exp_minus_square(a, y));
        self.scatter(bucket, at, re, im.with_sign_of(x));
        let like = |x: f64| a.like(x);
        let near = a.pick(zeros::candidate(a, y.magnitude()), like(1.0), like(0.0));
        let state = a.pick(lost, like(2.0), near);
        if state.is_zero() {
            return;
        }
        let state = state.array();
        let numbers = *self.buffers.numbers(bucket, at);
        for m in 0..(self.buffers.len(bucket) - at).min(S::WIDTH) {
            if state[m] > 0.0 && !self.next_to_zero(numbers[m]) && state[m] > 1.0 {
                self.cancelled(lanes, numbers[m]);
            }
        }
    }

    /// A bucket in the lower half-plane whose mirror images are given by the asymptotic series.
    #[inline(always)]
    pub(super) fn mirrored_series<S: Wide, const N: usize>(&mut self, simd: S, bucket: usize) {
        let len = self.buffers.len(bucket);
        let alone = bucket >= Kind::Series26 as usize + LOWER + SERIES_ALONE;
        let mut at = 0;
        while at < len {
            let (x, y) = self.gather(simd, self.buffers.numbers(bucket, at), 0);
            let (a, b) = (x.magnitude(), y.magnitude());
            let (u, v) = series::<_, N>(a, b);
            if alone && a.all(negligible(a, b, u.hi, v.hi)) {
                self.scatter(bucket, at, -u.hi, v.hi.with_sign_of(x));
            } else {
                self.keep(bucket, at, (u, v));
            }
            at += S::WIDTH;
        }
    }

    /// Keeps w at the mirror images of a group of points.
    #[inline(always)]
    fn keep<S: Wide>(&mut self, bucket: usize, at: usize, (u, v): (Dd<Pack<S>>, Dd<Pack<S>>)) {
        let buffers = &mut *self.buffers;
        let len = buffers.len(bucket);
        let to = buffers.mirrored.min(CHUNK);
        let numbers = *buffers.numbers(bucket, at);
        buffers.below[to..to + GROUPS].copy_from_slice(&numbers);
        let parts = [u.hi, u.lo, v.hi, v.lo];
        for (part, kept) in parts.into_iter().zip(&mut buffers.mirror) {
            part.store_at(kept, to);
        }
        buffers.mirrored = to + (len - at).min(S::WIDTH);
    }

    /// All points whose mirror images are done.
    #[inline(always)]
    pub(super) fn reflected<S: Wide, L: Lanes>(&mut self, simd: S, lanes: L) {
        let len = self.buffers.mirrored.min(CHUNK);
        if len == 0 {
            return;
        }
        let mut at = 0;
        while at < len {
            let buffers = &*self.buffers;
            let (x, y) = self.gather(simd, window(&buffers.below, at), 0);
            let [p, q, s, t] = &buffers.mirror;
            let u = Dd::new(Pack::load(simd, p, at), Pack::load(simd, q, at));
            let v = Dd::new(Pack::load(simd, s, at), Pack::load(simd, t, at));
            let a = x.magnitude();
            let none = negligible(a, y.magnitude(), u.hi, v.hi);
            let e = exp_minus_square(a, y);
            let (re, im, lost) = reflect((u, v), e);
            let like = |x: f64| a.like(x);
            let turn = ((a + a) * y).magnitude();
            let large = like(LARGE_PHASE.next_down()).below(turn);
            let high = like((ROUND + ALONE).next_down()).below(e.2);
            let near = zeros::candidate(a, y.magnitude());
            let special = a.or(a.or(lost, near), a.or(large, high));
            let special = a.pick(special, like(1.0), like(0.0));
            let special = a.pick(none, like(0.0), special);
            let re = a.pick(none, -u.hi, re);
            let im = a.pick(none, v.hi, im).with_sign_of(x);
            if special.is_zero() && at + S::WIDTH <= len {
                let numbers = window(&self.buffers.below, at);
                let pairs = simd.interleave(re.1, im.1);
                for m in 0..S::WIDTH {
                    let [re, im] = pairs[m];
                    self.w[numbers[m] as usize] = Complex::new(re, im);
                }
            } else {
                let state = a.pick(lost, special + special, special);
                let (re, im, state) = (re.array(), im.array(), state.array());
                let (turn, n) = (turn.array(), e.2.array());
                for m in 0..(len - at).min(S::WIDTH) {
                    let i = window(&self.buffers.below, at)[m];
                    let scalar = turn[m] >= LARGE_PHASE || n[m] >= ROUND + ALONE;
                    if state[m] == 0.0 {
                        self.put(i, (re[m], im[m]));
                    } else if self.next_to_zero(i) {
                        continue;
                    } else if scalar {
                        self.alone(lanes, i);
                    } else if state[m] > 1.0 {
                        self.cancelled(lanes, i);
                    } else {
                        self.put(i, (re[m], im[m]));
                    }
                }
            }
            at += S::WIDTH;
        }
    }

    /// Whether point `i` is next to a zero; it is noted.
    #[inline(always)]
    fn next_to_zero(&mut self, i: u8) -> bool {
        let [x, y] = self.at(i);
        let near = zeros::nearest(x.abs(), -y).is_some();
        if near {
            let buffers = &mut *self.buffers;
            buffers.zeros[buffers.near_zeros.min(CHUNK)] = i;
            buffers.near_zeros += 1;
        }
        near
    }
}
