//! A few hundred points at work, and where their buckets are.

use super::bucket::BUCKETS;
use num_complex::Complex;

/// Points sorted at a time.
pub(in super::super) const CHUNK: usize = 256;
/// Two groups in the widest vectors.
pub(in super::super) const GROUPS: usize = 16;
/// Places of a bucket: room for all points, and for repeating the last one.
pub(in super::super) const ROOM: usize = CHUNK + GROUPS;
/// Room for all buckets and one more, a power of two.
pub(super) const SETS: usize = (BUCKETS + 1).next_power_of_two();
/// The bucket of those left for later.
pub(super) const LATER: usize = SETS - 1;
/// Room for the points of all buckets, one after another, the last one of each repeated.
pub(super) const ORDERED: usize = (CHUNK + GROUPS * BUCKETS).next_power_of_two();

/// A chunk of points and the place for their values, and what is needed to compute them.
pub(super) struct Chunk<'a> {
    pub z: &'a [Complex<f64>; CHUNK],
    pub w: &'a mut [Complex<f64>; CHUNK],
    pub buffers: &'a mut Buffers,
}

/// Points in the order of their buckets.
pub(in super::super) struct Order {
    /// The bucket of each point.
    pub codes: [u8; CHUNK],
    /// The points of all buckets, where those of each begin, and how many it has.
    pub(super) order: [u8; ORDERED + GROUPS],
    pub(super) start: [usize; SETS],
    pub(super) len: [usize; SETS],
}

pub(super) struct Buffers {
    pub order: Order,
    /// The points of the bucket at work that needs rows, these, and the distances from the centres.
    pub x: [f64; ROOM],
    pub y: [f64; ROOM],
    pub row: [u16; ROOM],
    pub dx: [f64; ROOM],
    pub dy: [f64; ROOM],
    /// The points next to a zero.
    pub near_zeros: usize,
    pub zeros: [u8; ROOM],
}

impl Buffers {
    #[inline(always)]
    pub(super) fn new() -> Buffers {
        let none = [0.0; ROOM];
        Buffers {
            order: Order::new(),
            x: none,
            y: none,
            row: [0; ROOM],
            dx: none,
            dy: none,
            near_zeros: 0,
            zeros: [0; ROOM],
        }
    }
}

impl Order {
    #[inline(always)]
    pub(in super::super) fn new() -> Order {
        Order {
            codes: [0; CHUNK],
            order: [0; ORDERED + GROUPS],
            start: [0; SETS],
            len: [0; SETS],
        }
    }

    /// The number of points of a bucket.
    #[inline(always)]
    pub(in super::super) fn len(&self, bucket: usize) -> usize {
        self.len[bucket].min(CHUNK)
    }

    /// The numbers of two groups of points of a bucket from a place on.
    #[inline(always)]
    pub(in super::super) fn numbers(&self, bucket: usize, at: usize) -> &[u8; GROUPS] {
        self.order[(self.start[bucket] + at) & (ORDERED - 1)..]
            .first_chunk()
            .expect("there is room")
    }
}

impl Chunk<'_> {
    /// The same for a while. By value: what is stored may not change where it is then.
    #[inline(always)]
    pub(super) fn lent(&mut self) -> Chunk<'_> {
        Chunk {
            z: self.z,
            w: self.w,
            buffers: self.buffers,
        }
    }

    /// Point `i`.
    #[inline(always)]
    pub(super) fn at(&self, i: u8) -> [f64; 2] {
        pair(self.z[i as usize])
    }

    /// Takes the value at point `i`.
    #[inline(always)]
    pub(super) fn put(&mut self, i: u8, (re, im): (f64, f64)) {
        self.w[i as usize] = Complex::new(re, im);
    }
}

#[inline(always)]
pub(super) fn pair(z: Complex<f64>) -> [f64; 2] {
    [z.re, z.im]
}
