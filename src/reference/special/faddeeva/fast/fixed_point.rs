//! Numbers in units of 2^-122, and Taylor series of them.

/// Precision of the floats here.
pub const PREC: u32 = 160;
/// Fixed point: units of 2^-SCALE.
pub const SCALE: u32 = 122;
const ONE: f64 = (1u128 << SCALE) as f64;

/// `a b 2^-SCALE`, too small by less than 3 units. Exact parts of the 256-bit product are shifted
/// one by one; each floor loses less than one unit. |a b| must stay below 32 (in units of one).
#[inline]
pub fn mul(a: i128, b: i128) -> i128 {
    let (a1, a0) = (a >> 64, a & i128::from(u64::MAX));
    let (b1, b0) = (b >> 64, b & i128::from(u64::MAX));
    // a0 b0 < 2^128 as an unsigned number.
    let low = ((a0 as u128 * b0 as u128) >> SCALE) as i128;
    ((a1 * b1) << (128 - SCALE)) + ((a1 * b0) >> (SCALE - 64)) + ((a0 * b1) >> (SCALE - 64)) + low
}

/// x in units, truncated; |x| < 32. The factor is a power of two, and the product exact.
#[inline]
pub fn fixed(x: f64) -> i128 {
    (x * ONE) as i128
}

/// `Σ c_n (s + iv)^n = P + i v S` for real coefficients; `square` is v².
#[inline]
pub fn real_series<'a>(
    coefficients: impl DoubleEndedIterator<Item = &'a i128>,
    s: i128,
    square: i128,
) -> (i128, i128) {
    let (mut p, mut q) = (0, 0);
    for c in coefficients.rev() {
        (p, q) = (mul(s, p) - mul(square, q) + c, p + mul(s, q));
    }
    (p, q)
}

/// `Σ c_n (s + iv)^n`, real and imaginary part.
#[inline]
pub fn complex_series(coefficients: &[[i128; 2]], s: i128, v: i128) -> (i128, i128) {
    let (mut p, mut q) = (0, 0);
    for c in coefficients.iter().rev() {
        (p, q) = (mul(s, p) - mul(v, q) + c[0], mul(s, q) + mul(v, p) + c[1]);
    }
    (p, q)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use rug::Integer;

    /// The exact product less what came out, in units: from 0 to 3.
    fn lost(a: i128, b: i128) -> f64 {
        let exact = Integer::from(a) * Integer::from(b) - (Integer::from(mul(a, b)) << SCALE);
        exact.to_f64() / ONE
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 2000, ..ProptestConfig::default() })]

        /// Factors of every size, in units of one up to 16 and 2.
        #[test]
        fn products_lose_less_than_three_units(
            a in any::<i128>(), b in any::<i128>(), i in 1u32..128, j in 4u32..128,
        ) {
            let (a, b) = (a >> i, b >> j);
            prop_assert!((0.0..3.0).contains(&lost(a, b)), "{a} {b}: {}", lost(a, b));
            prop_assert!(mul(a, b) == mul(b, a));
        }
    }

    #[test]
    fn products_of_few_bits_are_exact() {
        for a in [-5i128, -1, 0, 1, 3] {
            for b in [-7i128, -1, 0, 1, 6] {
                for (i, j) in [(122, 122), (61, 61), (122, 0), (0, 122), (64, 58), (30, 92)] {
                    assert_eq!(
                        mul(a << i, b << j),
                        (a * b) << (i + j - SCALE),
                        "{a} {b} {i}"
                    );
                }
            }
        }
        // Three floors that lose next to a unit each.
        let all = i128::from(u64::MAX);
        assert!(lost(all, all) > 0.99);
        assert!((1..200).any(|k| lost((k << 64) + all, (3 << 64) + all) > 1.5));
    }

    /// Towards zero; what is below a unit is zero.
    #[test]
    fn doubles_are_truncated() {
        for (x, due) in [
            (0.0, 0),
            (-0.0, 0),
            (1.0, 1 << 122),
            (-9.75, -39 << 120),
            (1.75 / ONE, 1),
            (-1.75 / ONE, -1),
            (1.0 / ONE, 1),
            (0.99 / ONE, 0),
            (-5e-324, 0),
            (1e-310, 0),
            (0.1, (0x0019_9999_9999_999a_i128) << (122 - 56)),
            (2f64.powi(-70) + 2f64.powi(-122), (1 << 52) + 1),
            (2f64.powi(-71) + 2f64.powi(-123), 1 << 51),
        ] {
            assert_eq!(fixed(x), due, "{x:e}");
        }
    }

    /// One coefficient is itself, without a product that could be off.
    #[test]
    fn series_begin_with_their_last_coefficient() {
        let s = -(1i128 << 120);
        assert_eq!(real_series([7].iter(), s, 1 << 118), (7, 0));
        assert_eq!(complex_series(&[[7, 9]], s, s), (7, 9));
        // 1 + 2 (s + iv) + 3 (s + iv)² at s = −1/4, v = 1/8 (v² = 1/64).
        let one = 1i128 << SCALE;
        let c = [one, 2 * one, 3 * one];
        let (p, q) = real_series(c.iter(), s, one >> 6);
        assert_eq!((p, q), (one / 64 * 41, one / 2));
        let (p, q) = complex_series(&c.map(|c| [c, -c]), s, one >> 3);
        // Times 1 − i: P + v S and v S − P.
        assert_eq!((p, q), (one / 64 * 45, one / 64 * -37));
    }
}
