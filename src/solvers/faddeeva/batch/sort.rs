//! Points into buckets.

use super::super::branch::{BUCKETS, bucket, places};
use super::super::pack::{Pack, Wide};
use super::{CHUNK, Chunk, SETS, pair};

impl Chunk<'_> {
    /// Sorts the first `n` points into the buckets.
    #[inline(always)]
    pub(super) fn sort<S: Wide>(&mut self, simd: S, n: usize) {
        let buffers = &mut *self.buffers;
        let mut at = 0;
        while at < n {
            let (x, y) = simd.from_pairs(
                #[inline(always)]
                |m| pair(self.z[(at + m) & (CHUNK - 1)]),
            );
            let places = places(Pack(simd, x), Pack(simd, y));
            simd.store_at(simd.transmute_f64s_u64s(places), &mut buffers.x, at);
            at += S::WIDTH;
        }
        buffers.len = [0; SETS];
        let mut odd = [0; SETS];
        for (i, places) in buffers.x[..n].chunks(2).enumerate() {
            let k = bucket(places[0].to_bits()) & (SETS - 1);
            let len = buffers.len[k];
            buffers.order[k][len & (CHUNK / 2 - 1)] = (2 * i) as u8;
            buffers.len[k] = len + 1;
            if let Some(place) = places.get(1) {
                let k = bucket(place.to_bits()) & (SETS - 1);
                let len = odd[k];
                buffers.odd[k][len & (CHUNK / 2 - 1)] = (2 * i + 1) as u8;
                odd[k] = len + 1;
            }
        }
        for k in 0..BUCKETS {
            if odd[k] > 0 {
                let len = buffers.len[k].min(CHUNK / 2);
                buffers.order[k][len..len + CHUNK / 2].copy_from_slice(&buffers.odd[k]);
                buffers.len[k] = len + odd[k].min(CHUNK / 2);
            }
        }
    }
}
