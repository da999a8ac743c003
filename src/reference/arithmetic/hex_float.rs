//! C99 hexadecimal floats in, exactly.

use rug::{Integer, Rational};

/// A number as it stands in a C99 hexadecimal float such as `-0x1.8p-3`: exact, of any length.
#[derive(Clone, Debug, PartialEq)]
pub struct HexFloat {
    negative: bool,
    digits: Digits,
    /// Of two.
    exponent: i64,
}

/// An integer; one below 2⁶⁴ is always the first kind.
#[derive(Clone, Debug, PartialEq)]
enum Digits {
    Few(u64),
    Many(Integer),
}

impl Digits {
    /// Of hexadecimal digits before and after a point.
    fn parse(whole: &str, fraction: &str) -> Option<Digits> {
        let all = || whole.bytes().chain(fraction.bytes());
        let digit = |b: u8| char::from(b).to_digit(16);
        let mut few = (all().next().is_some()).then_some(0u64)?;
        for b in all() {
            let next = u64::from(digit(b)?);
            few = match few >> 60 {
                0 => few << 4 | next,
                _ if all().all(|b| b.is_ascii_hexdigit()) => {
                    let all = [whole, fraction].concat();
                    return Some(Digits::Many(Integer::from_str_radix(&all, 16).ok()?));
                }
                _ => return None,
            };
        }
        Some(Digits::Few(few))
    }
}

/// The text is not a hexadecimal float.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{text:?} is not a hexadecimal float (such as -0x1.8p-3)")]
pub struct HexFloatError {
    /// The text.
    pub text: String,
}

/// Exponents of two beyond this are refused, like those of decimals beyond 100 000.
const LARGEST_EXPONENT: u64 = 350_000;

impl HexFloat {
    /// Reads an optional sign, `0x`, hexadecimal digits with at most one point, and an optional
    /// `p` with a decimal exponent of two.
    ///
    /// ```
    /// use mechaudit_reference::HexFloat;
    /// let x = HexFloat::parse("-0x1.8p-3")?;
    /// assert_eq!(x.value(), rug::Rational::from((-3, 16)));
    /// assert_eq!(x.to_f64(), -0.1875);
    /// # Ok::<(), mechaudit_reference::HexFloatError>(())
    /// ```
    ///
    /// # Errors
    /// Anything else, and an exponent beyond ±350 000.
    pub fn parse(text: &str) -> Result<HexFloat, HexFloatError> {
        HexFloat::read(text.trim()).ok_or_else(|| HexFloatError { text: text.into() })
    }

    fn read(text: &str) -> Option<HexFloat> {
        let (negative, rest) = match text.as_bytes().first()? {
            b'-' => (true, &text[1..]),
            b'+' => (false, &text[1..]),
            _ => (false, text),
        };
        let rest = rest
            .strip_prefix("0x")
            .or_else(|| rest.strip_prefix("0X"))?;
        // By bytes: answers of programs are millions of these.
        let (mantissa, exponent) = match rest.bytes().position(|b| b | 0x20 == b'p') {
            Some(at) => (&rest[..at], rest[at + 1..].parse::<i64>().ok()?),
            None => (rest, 0),
        };
        let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
        let digits = Digits::parse(whole, fraction)?;
        if exponent.unsigned_abs() > LARGEST_EXPONENT {
            return None;
        }
        Some(HexFloat {
            negative,
            digits,
            exponent: exponent - 4 * fraction.len() as i64,
        })
    }

    /// The exact value.
    pub fn value(&self) -> Rational {
        let digits = match &self.digits {
            Digits::Few(few) => Rational::from(*few),
            Digits::Many(many) => Rational::from(many),
        };
        let k = i32::try_from(self.exponent).expect("the exponent and the length are limited");
        let q = digits << k;
        if self.negative { -q } else { q }
    }

    /// The nearest `f64`, ties to even; the sign of a zero is kept.
    pub fn to_f64(&self) -> f64 {
        let size = match &self.digits {
            Digits::Few(few) => nearest(*few, self.exponent),
            Digits::Many(many) => {
                // As many bits as fit, the last of them set where more are behind: no tie is one
                // that was none.
                let cut = many.significant_bits() - u64::BITS;
                let first = Integer::from(many >> cut);
                let more = Integer::from(&first << cut) != *many;
                let first = first.to_u64().expect("64 bits") | u64::from(more);
                nearest(first, self.exponent + i64::from(cut))
            }
        };
        if self.negative { -size } else { size }
    }
}

/// The `f64` next to `n 2^e`, ties to even.
fn nearest(n: u64, e: i64) -> f64 {
    // Not rounded to the subnormal numbers' places: as integers are.
    if e >= LEAST {
        return exact(n as f64, e);
    }
    let length = i64::from(u64::BITS - n.leading_zeros());
    // Bits behind the last one kept: of 53, or of the subnormal numbers'.
    let drop = (length - 53).max(LEAST - e).min(ALL);
    let halves = u128::from(n) << 1;
    let kept = halves >> drop >> 1;
    let (rest, half) = (halves - (kept << 1 << drop), 1 << drop);
    let up = rest > half || rest == half && kept & 1 == 1;
    exact((kept as u64 + u64::from(up)) as f64, e + drop)
}

/// Of two, of the smallest subnormal number.
const LEAST: i64 = -1074;

/// Less than half is left of 64 bits without that number of them.
const ALL: i64 = 65;

/// From here on numbers of at most 64 bits are zero or infinite.
const FAR: i64 = 1200;

/// `n 2^e` for n up to 2^64 with a result that is an `f64` or beyond the largest.
fn exact(n: f64, e: i64) -> f64 {
    let power = |k: i64| f64::from_bits(((k + 1023) as u64) << 52);
    let e = e.clamp(-FAR, FAR);
    let (a, b) = (e / 2, e - e / 2);
    // The larger of the halves first: no rounding on the way.
    n * power(a) * power(b)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use rug::Float;

    #[test]
    fn as_c_reads_them() {
        for (text, x) in [
            ("0x1p+0", 1.0),
            ("0x1.999999999999ap-4", 0.1),
            ("-0X1.4P-3", -0.15625),
            ("0x.8", 0.5),
            ("+0xFF", 255.0),
            ("0x10.p-4", 1.0),
            ("0x0.0000000000001p-1022", f64::from_bits(1)),
            ("0x1.fffffffffffffp+1023", f64::MAX),
            // Ties and what is next to them.
            ("0x1.00000000000008p0", 1.0),
            ("0x1.000000000000080000001p0", 1.0f64.next_up()),
            ("0x1.00000000000018p0", 1.0f64.next_up().next_up()),
            ("0x1.fffffffffffff8p+1023", f64::INFINITY),
            ("0x1.fffffffffffff7ffp+1023", f64::MAX),
            ("0x1p-1075", 0.0),
            ("0x1.0001p-1075", f64::from_bits(1)),
            ("0x3p-1075", f64::from_bits(2)),
            ("0x1p-1076", 0.0),
            ("0x1p300000", f64::INFINITY),
            ("0x1p-300000", 0.0),
            // Rounded once, below the normal numbers too, and infinite far beyond the largest.
            // 2.5 and a little more, in the smallest subnormal.
            ("0x5000000000000001p-1135", f64::from_bits(3)),
            ("0x5000000000000000p-1135", f64::from_bits(2)),
            ("0x7000000000000000p-1135", f64::from_bits(4)),
            ("0x50000000000000000001p-1151", f64::from_bits(3)),
            // Around half of the smallest subnormal, by all bits of an integer.
            ("0xffffffffffffffffp-1139", 0.0),
            ("0xffffffffffffffffp-1138", f64::from_bits(1)),
            ("0x8000000000000001p-1138", f64::from_bits(1)),
            ("0x8000000000000000p-1138", 0.0),
            ("0xffffffffffffffffp-1140", 0.0),
            ("0x80000000000000000001p-1154", f64::from_bits(1)),
            ("0x80000000000000000000p-1154", 0.0),
            ("0x1fffffffffffffp-1075", 2f64.powi(-1022)),
            ("0x3p-1074", f64::from_bits(3)),
            // 64 bits below 2^-1074 whose sum is a normal number: a little less than a tie.
            (
                "0x8000000000000bffp-1080",
                1.0f64.next_up() * 2f64.powi(-1017),
            ),
            // Three quarters of a unit.
            ("0x1.0000000000000cp0", 1.0f64.next_up()),
            ("0x1.00000000000004p0", 1.0),
            ("0x20000000000001p2000", f64::INFINITY),
            ("0x20000000000001p-2000", 0.0),
            ("0x123456789abcdef01p300000", f64::INFINITY),
        ] {
            let got = HexFloat::parse(text).unwrap().to_f64();
            assert_eq!(got.to_bits(), x.to_bits(), "{text}: {got}");
        }
        let zero = HexFloat::parse("-0x0p+0").unwrap();
        assert!(zero.to_f64() == 0.0 && zero.to_f64().is_sign_negative());
        for bad in [
            "",
            "0x",
            "0x.",
            "1.8p3",
            "0x1.8q3",
            "0x1p",
            "0x1p1.5",
            "0x1.2.3",
            "--0x1",
            "0xg",
            "0x1p400000",
            "0x1p-9223372036854775808",
            "x1",
            "0x-1",
            "0x1 p1",
            "é",
        ] {
            assert!(HexFloat::parse(bad).is_err(), "{bad:?}");
        }
    }

    /// Integers of any length; those below 2⁶⁴ are of the first kind.
    #[test]
    fn long_numbers_are_exact() {
        for (text, few) in [
            ("0xffffffffffffffff", true),
            ("0x8000000000000000", true),
            ("0x00000000000000000001", true),
            ("0x10000000000000000", false),
            ("0x1000000000000000000000", false),
            ("0x123456789abcdef0123456789", false),
        ] {
            let x = HexFloat::parse(text).unwrap();
            let due = Integer::from_str_radix(&text[2..], 16).unwrap();
            assert_eq!(x.value(), due, "{text}");
            assert_eq!(matches!(x.digits, Digits::Few(_)), few, "{text}");
            let pointed = format!("0x{}.{}p4", &text[2..9], &text[9..]);
            let places = 4 * (text.len() as u32 - 9);
            let due = Rational::from(due << 4u32) >> places;
            assert_eq!(HexFloat::parse(&pointed).unwrap().value(), due, "{pointed}");
        }
        for bad in [
            "0x10000000000000000_0",
            "0x10000000000000000 0",
            "0x10000000000000000g",
        ] {
            let error = HexFloat::parse(bad).unwrap_err().to_string();
            let due = format!("{bad:?} is not a hexadecimal float (such as -0x1.8p-3)");
            assert_eq!(error, due);
        }
    }

    #[test]
    fn how_large_exponents_may_be() {
        let one = HexFloat::parse("0x1p350000").unwrap().value();
        assert_eq!(one, Rational::from(1) << 350_000u32);
        assert!(HexFloat::parse("0x1p-350000").is_ok());
        assert!(HexFloat::parse("0x1p350001").is_err());
        assert!(HexFloat::parse("0x1p-350001").is_err());
    }

    proptest! {
        #[test]
        fn values_and_rounding(n in any::<u64>(), e in -1160i64..1000, minus in any::<bool>()) {
            let sign = if minus { "-" } else { "" };
            let x = HexFloat::parse(&format!("{sign}0x{n:x}p{e}")).unwrap();
            let mut exact = Float::with_val(80, n);
            exact <<= e as i32;
            if minus {
                exact = -exact;
            }
            prop_assert_eq!(&x.value(), &exact.to_rational().unwrap());
            // MPFR rounds to the nearest double, subnormal ones too.
            prop_assert_eq!(x.to_f64(), exact.to_f64());
        }
    }
}
