//! Points into buckets.

use super::super::pack::{Pack, Wide};
use super::bucket::{bucket, places};
use super::{CHUNK, Chunk, GROUPS, ORDERED, SETS, pair};

/// Points compared with a bucket at a time.
const BLOCK: usize = 32;
/// No bucket.
const NONE: u8 = 255;

/// For each set of eight places the places in it, a byte each from the lowest on.
static MEMBERS: [u64; 256] = {
    let mut table = [0; 256];
    let mut set = 0;
    while set < 256 {
        let (mut place, mut shift) = (0, 0);
        while place < 8 {
            if set >> place & 1 != 0 {
                table[set] |= place << shift;
                shift += 8;
            }
            place += 1;
        }
        set += 1;
    }
    table
};

/// A number in each of eight bytes.
const fn bytes(x: usize) -> u64 {
    x as u64 * 0x0101_0101_0101_0101
}

impl Chunk<'_> {
    /// Sorts the first `n` points into the buckets: each bucket collects its own, so that no count
    /// waits for the one before.
    #[inline(always)]
    pub(super) fn sort<S: Wide>(&mut self, simd: S, n: usize) {
        let buffers = &mut *self.buffers;
        let mut at = 0;
        while at < n {
            let (x, y) = simd.deinterleave(
                #[inline(always)]
                |m| pair(self.z[(at + m) & (CHUNK - 1)]),
            );
            let places = places(Pack(simd, x), Pack(simd, y));
            simd.store_at(simd.transmute_f64s_u64s(places), &mut buffers.x, at);
            at += S::WIDTH;
        }
        let mut codes = [NONE; CHUNK];
        let mut present = 0_u32;
        for (code, place) in codes[..n].iter_mut().zip(&buffers.x) {
            *code = bucket(place.to_bits());
            present |= 1 << (*code & 31);
        }
        buffers.len = [0; SETS];
        let order = &mut buffers.order;
        let mut start = 0;
        while present != 0 {
            let k = present.trailing_zeros() as usize & (SETS - 1);
            present &= present - 1;
            let mut end = start;
            for (i, block) in codes.as_chunks::<BLOCK>().0.iter().enumerate() {
                let equal = simd.equal(block, k as u8);
                if equal == 0 {
                    continue;
                }
                for (j, set) in equal.to_le_bytes().into_iter().enumerate() {
                    let members = MEMBERS[set as usize] + bytes(i * BLOCK + j * 8);
                    place(order, end, members.to_le_bytes());
                    end += set.count_ones() as usize;
                }
            }
            buffers.len[k] = end - start;
            buffers.start[k] = start;
            // The last one again, so that groups are whole.
            let last = order[(end - 1) & (ORDERED - 1)];
            place(order, end, [last; GROUPS]);
            start = end + GROUPS;
        }
    }
}

/// Puts numbers from a place on.
#[inline(always)]
fn place<const N: usize>(order: &mut [u8; ORDERED + GROUPS], at: usize, numbers: [u8; N]) {
    let at = at & (ORDERED - 1);
    order[at..at + N].copy_from_slice(&numbers);
}
