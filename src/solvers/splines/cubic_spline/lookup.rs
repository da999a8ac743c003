//! Numbers from a table for several points at once, with the widest vector instructions of the
//! processor. They add, multiply and move exactly as the plain code does, nothing is fused, so that
//! the results have the same bits everywhere.

/// Points evaluated together.
pub(super) const GROUP: usize = 8;

/// One number for each point of a group.
pub(super) type Lane<T> = [T; GROUP];

/// How the ordinates and bends at the ends of the segments of a group are found.
pub trait Lookup: Copy {
    /// `y[i]`, `y[i + 1]`, `bend[i]`, `bend[i + 1]` for eight `i`; `None` if one is too large.
    fn ends(self, y: &[f64], bend: &[f64], i: &[u64; 8]) -> Option<[[f64; 8]; 4]>;
    /// For each number how many of the knots it has passed.
    #[inline(always)]
    fn passed(self, knots: &[f64; 8], x: &[f64; 8]) -> [u64; 8] {
        x.map(|x| knots.iter().map(|knot| u64::from(*knot <= x)).sum())
    }
}

/// One number after the other.
#[derive(Clone, Copy)]
pub(super) struct Plain;

impl Lookup for Plain {
    #[inline(always)]
    fn ends(self, y: &[f64], bend: &[f64], i: &Lane<u64>) -> Option<[Lane<f64>; 4]> {
        let mut found = [[0.0; GROUP]; 4];
        for j in 0..GROUP {
            let i = i[j] as usize;
            let (y, m) = (
                y.get(i..)?.first_chunk::<2>()?,
                bend.get(i..)?.first_chunk::<2>()?,
            );
            found[0][j] = y[0];
            found[1][j] = y[1];
            found[2][j] = m[0];
            found[3][j] = m[1];
        }
        Some(found)
    }
}

/// Something to be done with one of the lookups.
pub(super) trait Work {
    type Output;
    /// Has to be inlined, to be compiled for each set of instructions.
    fn run<L: Lookup>(self, lookup: L) -> Self::Output;
}

/// Runs the work with the best lookup of this processor.
#[inline]
pub(super) fn with_best<W: Work>(work: W) -> W::Output {
    #[cfg(all(target_arch = "x86_64", feature = "vectors"))]
    {
        use pulp::x86::{V3, V4};
        if let Some(v) = V4::try_new() {
            return v.vectorize(
                #[inline(always)]
                || work.run(v),
            );
        }
        if let Some(v) = V3::try_new() {
            return v.vectorize(
                #[inline(always)]
                || work.run(v),
            );
        }
    }
    work.run(Plain)
}

/// Points close together share a few neighbouring numbers of the table, which then are loaded once
/// and distributed by a permutation.
#[cfg(all(target_arch = "x86_64", feature = "vectors"))]
mod x86 {
    use super::{GROUP, Lane, Lookup, Plain};
    use pulp::cast;
    use pulp::x86::{V3, V4};
    use std::hint::black_box;

    /// For points too far apart. The segments are hidden from the compiler, lest it takes them
    /// apart beforehand for every group.
    #[inline(always)]
    fn scattered(y: &[f64], bend: &[f64], i: &Lane<u64>) -> Option<[Lane<f64>; 4]> {
        Plain.ends(y, bend, black_box(i))
    }

    /// The comparison `≤`, false for what is no number.
    const AT_MOST: i32 = 18;

    impl Lookup for V4 {
        #[inline(always)]
        fn passed(self, knots: &Lane<f64>, x: &Lane<f64>) -> Lane<u64> {
            let f = self.avx512f;
            let (x, one) = (cast(*x), f._mm512_set1_epi64(1));
            let mut count = f._mm512_set1_epi64(0);
            for knot in knots {
                let passed = f._mm512_cmp_pd_mask::<AT_MOST>(f._mm512_set1_pd(*knot), x);
                count = f._mm512_mask_add_epi64(count, passed, count, one);
            }
            cast(count)
        }
        #[inline(always)]
        fn ends(self, y: &[f64], bend: &[f64], i: &Lane<u64>) -> Option<[Lane<f64>; 4]> {
            let from = i[0] as usize;
            let first = self.avx512f._mm512_set1_epi64(i[0] as i64);
            let ahead = self.avx512f._mm512_sub_epi64(cast(*i), first);
            let far = self
                .avx512f
                ._mm512_cmpgt_epu64_mask(ahead, cast([GROUP as u64 - 1; GROUP]));
            let (Some(y9), Some(m9)) = (
                y.get(from..).and_then(|y| y.first_chunk::<9>()),
                bend.get(from..).and_then(|m| m.first_chunk::<9>()),
            ) else {
                return scattered(y, bend, i);
            };
            if far != 0 {
                return scattered(y, bend, i);
            }
            let pick = |from: Option<&Lane<f64>>| -> Option<Lane<f64>> {
                let from = cast(*from?);
                Some(cast(self.avx512f._mm512_permutexvar_pd(ahead, from)))
            };
            Some([
                pick(y9.first_chunk())?,
                pick(y9.last_chunk())?,
                pick(m9.first_chunk())?,
                pick(m9.last_chunk())?,
            ])
        }
    }

    impl Lookup for V3 {
        #[inline(always)]
        fn passed(self, knots: &Lane<f64>, x: &Lane<f64>) -> Lane<u64> {
            let x: [[f64; GROUP / 2]; 2] = cast(*x);
            let mut count = [self.avx._mm256_setzero_si256(); 2];
            for knot in knots {
                let knot = self.avx._mm256_set1_pd(*knot);
                for (count, x) in count.iter_mut().zip(x) {
                    // A mask of ones is −1.
                    let passed = cast(self.avx._mm256_cmp_pd::<AT_MOST>(knot, cast(x)));
                    *count = self.avx2._mm256_sub_epi64(*count, passed);
                }
            }
            cast(count)
        }
        #[inline(always)]
        fn ends(self, y: &[f64], bend: &[f64], i: &Lane<u64>) -> Option<[Lane<f64>; 4]> {
            const HALF: usize = GROUP / 2;
            let mut ahead = [0; GROUP];
            for j in 0..GROUP {
                ahead[j] = i[j].wrapping_sub(i[j / HALF * HALF]);
            }
            let any = ahead.iter().fold(0, |all, a| all | a);
            if any >= HALF as u64 {
                return scattered(y, bend, i);
            }
            let mut found = [[0.0; GROUP]; 4];
            for half in [0, HALF] {
                let from = i[half] as usize;
                let (Some(y), Some(m)) = (
                    y.get(from..).and_then(|y| y.first_chunk::<5>()),
                    bend.get(from..).and_then(|m| m.first_chunk::<5>()),
                ) else {
                    return scattered(y, bend, i);
                };
                // Each f64 is moved as two halves: numbers 2k and 2k + 1.
                let mut words = [0u64; HALF];
                for j in 0..HALF {
                    let a = ahead[half + j];
                    words[j] = ((a << 1) | (a << 33)) + (1 << 32);
                }
                let pick = |from: Option<&[f64; HALF]>| -> Option<[f64; HALF]> {
                    let from = cast(*from?);
                    Some(cast(self.avx2._mm256_permutevar8x32_ps(from, cast(words))))
                };
                let picked = [
                    pick(y.first_chunk())?,
                    pick(y.last_chunk())?,
                    pick(m.first_chunk())?,
                    pick(m.last_chunk())?,
                ];
                for (found, picked) in found.iter_mut().zip(picked) {
                    found[half..half + HALF].copy_from_slice(&picked);
                }
            }
            Some(found)
        }
    }
}
