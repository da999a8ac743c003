//! Hexadecimal floats as in C99.

/// A float in C's `%a` form, exact.
///
/// ```
/// use mechaudit_audit::hex_float;
/// assert_eq!(hex_float(-0.15625), "-0x1.4p-3");
/// assert_eq!(hex_float(1.0), "0x1p+0");
/// ```
pub fn hex_float(x: f64) -> String {
    if x.is_nan() {
        return "nan".into();
    }
    let sign = if x.is_sign_negative() { "-" } else { "" };
    if x.is_infinite() {
        return format!("{sign}inf");
    }
    if x == 0.0 {
        return format!("{sign}0x0p+0");
    }
    let bits = x.to_bits();
    let exponent = ((bits >> 52) & 0x7ff) as i32;
    let fraction = bits & ((1 << 52) - 1);
    let (lead, e) = if exponent == 0 {
        (0, -1022)
    } else {
        (1, exponent - 1023)
    };
    let digits = format!("{fraction:013x}");
    let digits = digits.trim_end_matches('0');
    let point = if digits.is_empty() { "" } else { "." };
    format!("{sign}0x{lead}{point}{digits}p{e:+}")
}

#[cfg(test)]
mod tests {
    use super::hex_float;

    #[test]
    fn hex_floats() {
        assert_eq!(hex_float(0.1), "0x1.999999999999ap-4");
        assert_eq!(hex_float(f64::MAX), "0x1.fffffffffffffp+1023");
        assert_eq!(hex_float(f64::from_bits(1)), "0x0.0000000000001p-1022");
        assert_eq!(hex_float(-0.0), "-0x0p+0");
        assert_eq!(hex_float(f64::NEG_INFINITY), "-inf");
    }
}
