//! Exponents of `f64`s, and the powers of two of which they are multiples.

/// The smallest positive number, twice the unit of what underflows.
pub(crate) const TINIEST: f64 = f64::from_bits(1);

/// `2^k`, `−1074 ≤ k ≤ 1023`.
pub(crate) fn power_of_two(k: i32) -> f64 {
    assert!((-1074..=1023).contains(&k), "{k} is no exponent of f64");
    if k < -1022 {
        f64::from_bits(1 << (k + 1074))
    } else {
        f64::from_bits(((k + 1023) as u64) << 52)
    }
}

/// `⌊log₂ x⌋` of a positive number; 1024 for infinity.
pub(crate) fn exponent(x: f64) -> i32 {
    let bits = x.to_bits();
    match (bits >> 52) as i32 {
        0 => 63 - bits.leading_zeros() as i32 - 1074,
        e => e - 1023,
    }
}

/// The exponent of the spacing of numbers from `x ≥ 0` on: all of them are multiples of `2^` of it.
pub(crate) fn grain_of(x: f64) -> i32 {
    (exponent(x) - 52).max(-1074)
}

/// The same for one number, by its last bit that is set.
pub(crate) fn grain_of_point(x: f64) -> i32 {
    if x == 0.0 || !x.is_finite() {
        return grain_of(x.abs());
    }
    // The leading bit of a normal number is not stored; it ends the count.
    let zeros = (x.to_bits() | 1 << 52).trailing_zeros();
    grain_of(x.abs()) + zeros as i32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exponents_and_spacings() {
        for k in [-1074, -1073, -1023, -1022, -1, 0, 52, 1023] {
            let x = power_of_two(k);
            assert_eq!(
                (x, exponent(x)),
                (2f64.powi(k / 2) * 2f64.powi(k - k / 2), k)
            );
            assert!(k == -1074 || exponent(x.next_down()) == k - 1);
            let grain = grain_of(x);
            assert_eq!(power_of_two(grain), x.next_up() - x);
        }
        assert_eq!(exponent(f64::INFINITY), 1024);
        assert_eq!((grain_of(0.0), grain_of_point(0.0)), (-1074, -1074));
        for (x, grain) in [
            (1.0, 0),
            (-3.0, 0),
            (0.75, -2),
            (1.5e-323, -1074),
            (2e-323, -1072),
        ] {
            assert_eq!(grain_of_point(x), grain, "{x}");
        }
        assert_eq!(grain_of_point(1.0f64.next_up()), -52);
        assert_eq!(grain_of_point(f64::MIN_POSITIVE), -1022);
    }
}
