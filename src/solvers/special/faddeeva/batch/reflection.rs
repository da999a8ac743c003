//! The lower half-plane: the formulas for the mirror images, and the reflection.

use super::super::asymptotic::{series, series_rounded};
use super::super::branch::{CELL, SERIES_6, SERIES_14, SERIES_26};
use super::super::reflection::{
    ALONE, close, exponential_dominates, image_dominates, negligible, reflect,
};
use super::super::rows::nearest_zero;
use super::super::zeros;
use super::bucket::{EXPONENTIAL_IN_CELL, IMAGE_BY_SERIES, IMAGE_IN_CELL, LOWER, SERIES_ALONE};
use super::chunk::{CHUNK, Chunk};
use super::formulas::Formula;
use super::tables::Cells;
use crate::double_double::Dd;
use crate::exponential::{LARGE_PHASE, exp_minus_square};
use crate::lanes::Lanes;
use crate::pack::{Pack, Wide};
use crate::real::{Masked, ROUND, Real};

/// Why a point has to be computed again: it may be next to a zero; its terms cancel; it is one of
/// those that only the scalar code takes care of.
const NEAR_ZERO: f64 = 1.0;
const LOST: f64 = 2.0;
const FOR_SCALAR: f64 = 3.0;

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
        let alone = SERIES_26.number() + LOWER + SERIES_ALONE;
        self.without_rows(simd, IMAGE_BY_SERIES, ImageBySeries);
        self.without_rows(simd, alone, ImageAlone);
    }

    /// The buckets in which neither term dominates, or which does is not known beforehand. In the
    /// first two no term is negligible, no phase large and no exponential beyond every f64.
    #[inline(always)]
    pub(super) fn both_terms<S: Wide, L: Lanes>(&mut self, simd: S, lanes: L) {
        let bucket = CELL.number() + LOWER;
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
        let bucket = SERIES_26.number() + LOWER;
        let mut at = 0;
        while at < self.buffers.order.len(bucket) {
            let (x, y) = self.gather(simd, self.buffers.order.numbers(bucket, at), 0);
            let image = series::<_, 26>(x.magnitude(), y.magnitude());
            self.reflect(lanes, (bucket, at), image, (x, y));
            at += S::WIDTH;
        }
        for plane in [LOWER, LOWER + SERIES_ALONE] {
            self.far::<S, L, 14>(simd, lanes, SERIES_14.number() + plane);
            self.far::<S, L, 6>(simd, lanes, SERIES_6.number() + plane);
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
        let b = y.magnitude();
        let (re, im, lost) = reflect(image, exp_minus_square(a, y), close(a, b));
        self.scatter(bucket, at, re, im.with_sign_of(x));
        let near = zeros::candidate(a, b);
        let special = a.pick(near, a.like(NEAR_ZERO), a.like(0.0));
        let special = a.pick(lost, a.like(LOST), special);
        self.again(lanes, (bucket, at), special);
    }

    /// A bucket of the asymptotic series with N terms, far enough out for large phases and for
    /// either term to be negligible.
    #[inline(always)]
    fn far<S: Wide, L: Lanes, const N: usize>(&mut self, simd: S, lanes: L, bucket: usize) {
        let len = self.buffers.order.len(bucket);
        let mut at = 0;
        while at < len {
            let (x, y) = self.gather(simd, self.buffers.order.numbers(bucket, at), 0);
            let (a, b) = (x.magnitude(), y.magnitude());
            let (u, v) = series::<_, N>(a, b);
            let none = negligible(a, b, u.hi, v.hi);
            if a.all(none) {
                self.scatter(bucket, at, -u.hi, v.hi.with_sign_of(x));
            } else {
                let e = exp_minus_square(a, y);
                let (re, im, lost) = reflect((u, v), e, close(a, b));
                let (re, im) = (a.pick(none, -u.hi, re), a.pick(none, v.hi, im));
                self.scatter(bucket, at, re, im.with_sign_of(x));
                let like = |x: f64| a.like(x);
                let large = like(LARGE_PHASE.next_down()).below((a + a) * b);
                let high = like((ROUND + ALONE).next_down()).below(e.2);
                let special = a.pick(lost, like(LOST), like(0.0));
                let special = a.pick(a.or(large, high), like(FOR_SCALAR), special);
                let special = a.pick(none, like(0.0), special);
                self.again(lanes, (bucket, at), special);
            }
            at += S::WIDTH;
        }
    }

    /// Computes again those of a group for which this has to be done.
    #[inline(always)]
    fn again<S: Wide, L: Lanes>(
        &mut self,
        lanes: L,
        (bucket, at): (usize, usize),
        special: Pack<S>,
    ) {
        if special.is_zero() {
            return;
        }
        let special = special.array();
        let numbers = *self.buffers.order.numbers(bucket, at);
        for m in 0..(self.buffers.order.len(bucket) - at).min(S::WIDTH) {
            let i = numbers[m];
            if special[m] == FOR_SCALAR {
                self.alone(lanes, i);
            } else if special[m] > 0.0 && !self.next_to_zero(i) && special[m] == LOST {
                self.cancelled(lanes, i);
            }
        }
    }

    /// Returns whether point `i` is next to a zero; it is noted.
    #[inline(always)]
    fn next_to_zero(&mut self, i: u8) -> bool {
        let [x, y] = self.at(i);
        let near = nearest_zero(x.abs(), -y).is_some();
        if near {
            let buffers = &mut *self.buffers;
            buffers.zeros[buffers.near_zeros.min(CHUNK)] = i;
            buffers.near_zeros += 1;
        }
        near
    }
}
