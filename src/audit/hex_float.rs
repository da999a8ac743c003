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
    if x.is_infinite() {
        return text.push_str(if x > 0.0 { "inf" } else { "-inf" });
    }
    let bits = x.to_bits();
    let (exponent, fraction) = ((bits >> 52) as i32 & 0x7ff, bits & ((1 << 52) - 1));
    let (lead, e) = match exponent {
        0 if fraction == 0 => (b'0', 0),
        0 => (b'0', -1022),
        _ => (b'1', exponent - 1023),
    };
    // Without a formatter: inputs and answers of programs are millions of these.
    let mut line = Characters::default();
    if x.is_sign_negative() {
        line.push(b'-');
    }
    line.push(b'0');
    line.push(b'x');
    line.push(lead);
    if fraction != 0 {
        line.push(b'.');
    }
    let mut rest = fraction << 12;
    while rest != 0 {
        line.push(b"0123456789abcdef"[(rest >> 60) as usize]);
        rest <<= 4;
    }
    line.push(b'p');
    line.push(if e < 0 { b'-' } else { b'+' });
    let size = e.unsigned_abs();
    for place in [1000, 100, 10, 1] {
        if place <= size.max(1) {
            line.push(b'0' + (size / place % 10) as u8);
        }
    }
    text.push_str(std::str::from_utf8(&line.all[..line.len]).expect("ASCII"));
}

/// Room for the longest hexadecimal float, `-0x1.fffffffffffffp-1022`.
#[derive(Default)]
struct Characters {
    all: [u8; 24],
    len: usize,
}

impl Characters {
    fn push(&mut self, c: u8) {
        self.all[self.len] = c;
        self.len += 1;
    }
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
        assert_eq!(
            hex_float(-f64::MIN_POSITIVE.next_down()),
            "-0x0.fffffffffffffp-1022"
        );
        assert_eq!(hex_float(1024.0), "0x1p+10");
        assert_eq!(hex_float(1.0), "0x1p+0");
        assert_eq!(hex_float(-0.0), "-0x0p+0");
        assert_eq!(hex_float(f64::NEG_INFINITY), "-inf");
        assert_eq!(hex_float(-f64::NAN), "nan");
    }
    /// None of them is moved while it is written.
    #[test]
    fn the_longest_has_its_place() {
        let longest = hex_float(-f64::MIN_POSITIVE.next_down());
        assert_eq!((longest.len(), longest.capacity()), (24, 24));
    }
}
