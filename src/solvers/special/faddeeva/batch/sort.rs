//! Points into buckets.

use super::bucket::{bucket, places};
use super::chunk::{CHUNK, Chunk, GROUPS, LATER, ORDERED, Order, SETS, pair};
use crate::pack::{Pack, Wide};

/// Points compared with a bucket at a time.
const BLOCK: usize = 32;
const BLOCKS: usize = CHUNK / BLOCK;
/// Fewer points than these do not fill two groups of the narrower vectors.
const FEW: usize = 8;
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
    /// Finds the buckets of the first `n` points; which there are.
    #[inline(always)]
    pub(super) fn classify<S: Wide>(&mut self, simd: S, n: usize) -> u32 {
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
        let mut present = 0_u32;
        for (code, place) in buffers.order.codes[..n].iter_mut().zip(&buffers.x) {
            *code = bucket(place.to_bits());
            present |= 1 << (*code & 31);
        }
        present
    }
}

impl Order {
    /// Sorts the first `n` points into the buckets: each bucket collects its own, so that no count
    /// waits for the one before. Buckets with few points leave them for later, as long as there is
    /// room. After each bucket its last point stands again `apart` times.
    #[inline(always)]
    pub(in super::super) fn sort<S: Wide>(
        &mut self,
        simd: S,
        n: usize,
        present: u32,
        (room, apart): (usize, usize),
    ) {
        let (mut present, mut room) = (present, room);
        let buffers = self;
        buffers.codes[n..].fill(NONE);
        buffers.len = [0; SETS];
        let order = &mut buffers.order;
        let blocks = n.div_ceil(BLOCK).min(BLOCKS);
        let mut start = 0;
        let mut later = [0_u32; BLOCKS];
        while present != 0 {
            let k = present.trailing_zeros() as usize & (SETS - 1);
            present &= present - 1;
            let mut members = [0_u32; BLOCKS];
            let mut len = 0;
            for (members, block) in members.iter_mut().zip(buffers.codes.as_chunks::<BLOCK>().0) {
                *members = simd.equal(block, k as u8);
                len += members.count_ones() as usize;
            }
            if len < FEW && len <= room {
                room -= len;
                for (later, members) in later.iter_mut().zip(members) {
                    *later |= members;
                }
                continue;
            }
            list(order, start, &members[..blocks]);
            buffers.len[k] = len;
            buffers.start[k] = start;
            // The last one again, so that groups are whole.
            let last = order[(start + len - 1) & (ORDERED - 1)];
            place(order, start + len, [last; GROUPS]);
            start += len + apart;
        }
        let len = later.iter().map(|x| x.count_ones() as usize).sum();
        if len > 0 {
            list(order, start, &later[..blocks]);
        }
        buffers.len[LATER] = len;
        buffers.start[LATER] = start;
    }
}

/// Puts the members of a set of points from a place on.
#[inline(always)]
fn list(order: &mut [u8; ORDERED + GROUPS], at: usize, members: &[u32]) {
    let mut at = at;
    for (i, block) in members.iter().enumerate() {
        for (j, set) in block.to_le_bytes().into_iter().enumerate() {
            let members = MEMBERS[set as usize] + bytes(i * BLOCK + j * 8);
            place(order, at, members.to_le_bytes());
            at += set.count_ones() as usize;
        }
    }
}

/// Puts numbers from a place on.
#[inline(always)]
fn place<const N: usize>(order: &mut [u8; ORDERED + GROUPS], at: usize, numbers: [u8; N]) {
    let at = at & (ORDERED - 1);
    order[at..at + N].copy_from_slice(&numbers);
}
