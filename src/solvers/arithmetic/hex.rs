//! Constants whose bits matter, as hexadecimal floating-point literals.

/// The number that a literal of C99 (6.4.4.2) such as `0x1.8p-3` denotes, exactly.
///
/// # Panics
/// At compile time in a constant: another form, more than 53 bits, a number outside the range of
/// `f64`.
pub(crate) const fn hex(literal: &str) -> f64 {
    let text = literal.as_bytes();
    let mut at = 0;
    let negative = text[at] == b'-';
    if negative {
        at += 1;
    }
    assert!(text[at] == b'0' && text[at + 1] == b'x', "0x is missing");
    at += 2;
    let (mut digits, mut exponent, mut fraction) = (0u64, 0i64, false);
    while text[at] != b'p' {
        if text[at] == b'.' {
            assert!(!fraction, "two points");
            fraction = true;
        } else {
            let digit = match text[at] {
                d @ b'0'..=b'9' => d - b'0',
                d @ b'a'..=b'f' => d - b'a' + 10,
                _ => panic!("no hexadecimal digit"),
            };
            assert!(digits >> 60 == 0, "too many digits");
            digits = digits << 4 | digit as u64;
            if fraction {
                exponent -= 4;
            }
        }
        at += 1;
    }
    at += 1;
    let down = text[at] == b'-';
    if down || text[at] == b'+' {
        at += 1;
    }
    assert!(at < text.len(), "no exponent");
    let mut power = 0;
    while at < text.len() {
        assert!(text[at].is_ascii_digit() && power < 10_000, "no exponent");
        power = 10 * power + (text[at] - b'0') as i64;
        at += 1;
    }
    exponent += if down { -power } else { power };
    let sign = (negative as u64) << 63;
    if digits == 0 {
        return f64::from_bits(sign);
    }
    // With the first bit in place 52, or where the subnormal numbers have it.
    let first = 63 - digits.leading_zeros() as i64;
    let least = if first + exponent < -1022 {
        -1074
    } else {
        first + exponent - 52
    };
    let shift = exponent - least;
    let mantissa = if shift >= 0 {
        digits << shift
    } else {
        let shift = -shift;
        assert!(
            shift < 64 && digits & ((1 << shift) - 1) == 0,
            "more bits than an f64 has"
        );
        digits >> shift
    };
    assert!(first + exponent < 1024, "too large");
    if mantissa >> 52 == 0 {
        return f64::from_bits(sign | mantissa);
    }
    f64::from_bits(sign | ((least + 1075) as u64) << 52 | mantissa & ((1 << 52) - 1))
}

#[cfg(test)]
mod tests {
    use super::hex;
    use std::f64::consts::PI;

    #[test]
    fn literals() {
        assert_eq!(hex("0x1.8p-3"), 0.1875);
        assert_eq!(hex("0x10p0"), 16.0);
        assert_eq!(hex("-0x1.921fb54442d18p+1"), -PI);
        assert_eq!(hex("0x1.fffffffffffffp1023"), f64::MAX);
        assert_eq!(hex("0x1p-1022"), f64::MIN_POSITIVE);
        assert_eq!(hex("0x1p-1074"), f64::from_bits(1));
        assert_eq!(
            hex("0x0.fffffffffffffp-1022"),
            f64::MIN_POSITIVE.next_down()
        );
        assert!(hex("-0x0p0").is_sign_negative());
    }

    #[test]
    fn what_is_no_f64() {
        for bad in [
            "1p0",
            "0x1.g",
            "0x1p",
            "0x1.00000000000008p0",
            "0x1p1024",
            "0x1p-1075",
        ] {
            let read = std::panic::catch_unwind(|| hex(bad));
            assert!(read.is_err(), "{bad}");
        }
    }
}
