//! The lower half-plane: W at the mirror images by all formulas first, then the reflection of all of
//! them.

use super::super::branch::{Kind, LOWER, SERIES_ALONE};
use super::super::double_double::Dd;
use super::super::exponential::{LARGE_PHASE, exp_minus_square};
use super::super::lanes::Lanes;
use super::super::pack::{Pack, Wide};
use super::super::plane::{ALONE, negligible, reflect};
use super::super::real::{ROUND, Real};
use super::super::rows::{On, Rows};
use super::super::zeros;
use super::{CHUNK, Chunk, GROUPS, window};
use num_complex::Complex;

impl Chunk<'_> {
    /// The bucket in the lower half-plane of a formula that gives `w(a + i|y|)`.
    #[inline(always)]
    pub(super) fn mirrored<S: Wide, R: Rows<N>, const N: usize>(
        &mut self,
        simd: S,
        rows: R,
        bucket: usize,
        formula: impl Fn(S, Pack<S>, Pack<S>, On<'_, S, N>) -> (Dd<Pack<S>>, Dd<Pack<S>>),
    ) {
        let len = self.groups(bucket);
        self.locate(simd, rows, bucket, len);
        let alone = bucket >= Kind::Series26 as usize + LOWER + SERIES_ALONE;
        let mut at = 0;
        while at < len {
            let (x, y, on) = self.on(simd, rows, bucket, at);
            let (a, b) = (x.magnitude(), y.magnitude());
            let (u, v) = formula(simd, a, b, on);
            if alone && a.all(negligible(a, b, u.hi, v.hi)) {
                self.scatter(bucket, at, -u.hi, v.hi.with_sign_of(x));
            } else {
                let buffers = &mut *self.buffers;
                let to = buffers.mirrored.min(CHUNK);
                let numbers = window(&buffers.order[bucket], at);
                buffers.below[to..to + GROUPS].copy_from_slice(numbers);
                let parts = [u.hi, u.lo, v.hi, v.lo];
                for (part, kept) in parts.into_iter().zip(&mut buffers.mirror) {
                    part.store_at(kept, to);
                }
                buffers.mirrored = to + (len - at).min(S::WIDTH);
            }
            at += S::WIDTH;
        }
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
            // 0 is done, 1 asks for double-double, 2 for the scalar code; with 4 added the point
            // may lie next to a zero.
            let like = |x: f64| a.like(x);
            let state = a.pick(lost, like(1.0), like(0.0));
            let phase = ((a + a) * y).magnitude();
            let state = a.pick(phase.below(like(LARGE_PHASE)), state, like(2.0));
            let state = a.pick(e.2.below(like(ROUND + ALONE)), state, like(2.0));
            let near = zeros::candidate(a, y.magnitude());
            let state = state + a.pick(near, like(4.0), like(0.0));
            let state = a.pick(none, like(0.0), state);
            let re = a.pick(none, -u.hi, re);
            let im = a.pick(none, v.hi, im).with_sign_of(x);
            if state.is_zero() && at + S::WIDTH <= len {
                let numbers = window(&self.buffers.below, at);
                let pairs = simd.to_pairs(re.1, im.1);
                for m in 0..S::WIDTH {
                    let [re, im] = pairs[m];
                    self.w[numbers[m] as usize] = Complex::new(re, im);
                }
            } else {
                let (re, im, state) = (re.array(), im.array(), state.array());
                for m in 0..(len - at).min(S::WIDTH) {
                    let i = window(&self.buffers.below, at)[m];
                    self.take(lanes, i, (re[m], im[m]), state[m]);
                }
            }
            at += S::WIDTH;
        }
    }

    /// Takes the value for point `i`, or another as its state asks.
    #[inline(always)]
    fn take<L: Lanes>(&mut self, lanes: L, i: u8, value: (f64, f64), state: f64) {
        let [x, y] = self.at(i);
        if state >= 4.0 && zeros::nearest(x.abs(), -y).is_some() {
            let buffers = &mut *self.buffers;
            buffers.zeros[buffers.near_zeros.min(CHUNK)] = i;
            buffers.near_zeros += 1;
            return;
        }
        match state as u8 & 3 {
            0 => self.put(i, value),
            1 => self.cancelled(lanes, i),
            _ => self.alone(lanes, i),
        }
    }
}
