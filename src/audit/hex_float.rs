//! Hexadecimal floats as in C99.

/// A float in C's `%a` form, exact.
///
/// ```
/// use mechaudit_audit::hex_float;
/// assert_eq!(hex_float(-0.15625), "-0x1.4p-3");
/// assert_eq!(hex_float(1.0), "0x1p+0");
/// ```
pub fn hex_float(x: f64) -> String {
    let mut text = String::with_capacity(24);
    write_hex_float(&mut text, x);
    text
}

/// [`hex_float`] at the end of a text.
pub fn write_hex_float(text: &mut String, x: f64) {
    if x.is_nan() {
        return text.push_str("nan");
    }
    if x.is_sign_negative() {
        text.push('-');
    }
    if x.is_infinite() {
        return text.push_str("inf");
    }
    let bits = x.to_bits();
    let (exponent, fraction) = ((bits >> 52) as i32 & 0x7ff, bits & ((1 << 52) - 1));
    let (lead, e) = match exponent {
        0 if fraction == 0 => ("0x0", 0),
        0 => ("0x0", -1022),
        _ => ("0x1", exponent - 1023),
    };
    text.push_str(lead);
    // Without a formatter: inputs and answers of programs are millions of these.
    let digit = |d: u64| b"0123456789abcdef"[d as usize];
    if fraction != 0 {
        let digits: [u8; 13] = std::array::from_fn(|k| digit(fraction >> (48 - 4 * k) & 15));
        let count = 13 - fraction.trailing_zeros() as usize / 4;
        text.push('.');
        text.push_str(std::str::from_utf8(&digits[..count]).expect("digits are ASCII"));
    }
    text.push_str(if e < 0 { "p-" } else { "p+" });
    let size = u64::from(e.unsigned_abs());
    let places = [1000, 100, 10, 1].into_iter().filter(|p| *p <= size.max(1));
    text.extend(places.map(|p| char::from(digit(size / p % 10))));
}

#[cfg(test)]
mod tests {
    use super::hex_float;

    #[test]
    fn hex_floats() {
        assert_eq!(hex_float(0.1), "0x1.999999999999ap-4");
        assert_eq!(hex_float(1.0625), "0x1.1p+0");
        assert_eq!(hex_float(1.0 + 2f64.powi(-9)), "0x1.008p+0");
        assert_eq!(hex_float(f64::MAX), "0x1.fffffffffffffp+1023");
        assert_eq!(hex_float(f64::from_bits(1)), "0x0.0000000000001p-1022");
        assert_eq!(hex_float(-0.0), "-0x0p+0");
        assert_eq!(hex_float(f64::NEG_INFINITY), "-inf");
        assert_eq!(hex_float(-f64::NAN), "nan");
    }
}
