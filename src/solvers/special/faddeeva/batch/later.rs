//! Points of buckets that have too few of them for whole groups: kept until there are as many as in
//! a chunk.

use super::super::points::Points;
use super::chunk::{CHUNK, Chunk, LATER};
use num_complex::Complex;

/// With more points than these they are due.
const FULL: usize = CHUNK * 3 / 4;

/// Points, their numbers in the batch, and their buckets.
pub(super) struct Later {
    len: usize,
    z: [Complex<f64>; CHUNK],
    number: [usize; CHUNK],
    codes: [u8; CHUNK],
}

impl Later {
    #[inline(always)]
    pub(super) fn new() -> Later {
        Later {
            len: 0,
            z: [Complex::ZERO; CHUNK],
            number: [0; CHUNK],
            codes: [0; CHUNK],
        }
    }

    #[inline(always)]
    pub(super) fn len(&self) -> usize {
        self.len.min(CHUNK)
    }

    #[inline(always)]
    pub(super) fn is_empty(&self) -> bool {
        self.len == 0
    }

    #[inline(always)]
    pub(super) fn is_full(&self) -> bool {
        self.len > FULL
    }

    /// For how many more there is room.
    #[inline(always)]
    pub(super) fn room(&self) -> usize {
        CHUNK - self.len()
    }

    #[inline(always)]
    pub(super) fn points(&self) -> &[Complex<f64>; CHUNK] {
        &self.z
    }

    /// Takes those of the chunk that begins at point `start` of the batch.
    #[inline(always)]
    pub(super) fn take(&mut self, chunk: &Chunk, start: usize) {
        let more = chunk.buffers.order.len(LATER);
        for at in 0..more {
            let i = chunk.buffers.order.numbers(LATER, at)[0] as usize;
            let to = (self.len + at) & (CHUNK - 1);
            self.z[to] = chunk.z[i];
            self.number[to] = start + i;
            self.codes[to] = chunk.buffers.order.codes[i];
        }
        self.len += more;
    }

    /// Sets the buckets of a chunk that consists of these points; which there are.
    #[inline(always)]
    pub(super) fn classify(&self, chunk: &mut Chunk) -> u32 {
        chunk.buffers.order.codes = self.codes;
        self.codes[..self.len()]
            .iter()
            .fold(0, |present, code| present | 1 << (code & 31))
    }

    /// Takes the values to their places; none is left.
    #[inline(always)]
    pub(super) fn store<P: Points>(&mut self, w: &[Complex<f64>; CHUNK], points: &mut P) {
        for (number, w) in self.number[..self.len()].iter().zip(w) {
            points.store(*number, &[*w]);
        }
        self.len = 0;
    }
}
