//! The digits of blocks of terms.

use super::{MANY, pow2};

/// Blocks start where terms are smaller by this many bits than their digits say.
const SPARE: i64 = 32;
/// The fewest bits of a block.
const FEWEST: u32 = 128;

/// Returns by how many bits each block of m terms has fewer digits than the first, in whole words.
/// Errors of a block enter the sum times its largest term.
pub(super) fn depths(bits: u32, n: u64, m: u64, ratio: impl Fn(u64) -> (u64, u64)) -> Vec<u32> {
    if bits < MANY {
        return vec![0; n.div_ceil(m) as usize];
    }
    let mut depths = Vec::new();
    let (mut term, mut exponent) = (1.0f64, 0i64);
    let mut largest = i64::MIN;
    for k in 0..n {
        // The power of two above it.
        let above = (term.to_bits() >> 52) as i64 - 1022;
        largest = largest.max(exponent + above);
        if (k + 1) % m == 0 || k + 1 == n {
            let most = i64::from(bits.saturating_sub(FEWEST));
            depths.push((-largest - SPARE).clamp(0, most) as u32 / 64 * 64);
            largest = i64::MIN;
        }
        let (a, b) = ratio(k);
        term *= a as f64 / b as f64;
        if above.abs() > 500 {
            (term, exponent) = (term * pow2(-above), exponent + above);
        }
    }
    // A later block has no more digits than one before it.
    for j in (1..depths.len()).rev() {
        depths[j - 1] = depths[j - 1].min(depths[j]);
    }
    depths
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Terms 2^-7k in blocks of 20: digits fall by 140 bits a block, to the fewest there may be; terms
    /// that grow again keep the digits of the largest behind them.
    #[test]
    fn digits_fall_with_the_terms() {
        let falling = |_: u64| (1, 128);
        assert_eq!(depths(MANY, 100, 20, falling), [0, 64, 192, 384, 512]);
        assert_eq!(depths(MANY, 250, 20, falling)[10..], [1344, 1344, 1344]);
        assert_eq!(depths(MANY - 1, 100, 20, falling), [0; 5]);
        let again = |k: u64| if k < 40 { (1, 128) } else { (1 << 40, 1) };
        assert_eq!(depths(MANY, 50, 20, again), [0, 0, 0]);
        let growing = |_: u64| (128, 1);
        assert_eq!(depths(MANY, 100, 20, growing), [0; 5]);
    }
}
