//! Every reader of the library with text of any kind: a value or a typed error, no panic.
//!
//! `PROPTEST_CASES=100000 cargo test --release --test library fuzz_parsers` looks longer; the
//! readers of the command line are tried in `src/cli/fuzz.rs`.

use crate::fuzz_solvers::cases;
use mechaudit::audit::{HARD_HEADER, HardCase, hex_float};
use mechaudit::reference::{Decimal, HexFloat};
use mechaudit_symbolic::{parse, parse_equation};
use proptest::prelude::*;
use rug::Rational;

/// Words of a language and a few that are not, one after the other.
fn text(words: &'static [&'static str]) -> impl Strategy<Value = String> {
    let word = prop_oneof![
        8 => prop::sample::select(words).prop_map(String::from),
        1 => "\\PC{0,3}",
        1 => any::<i64>().prop_map(|n| n.to_string()),
    ];
    prop::collection::vec(word, 0..12).prop_map(|w| w.concat())
}

const NUMBERS: &[&str] = &[
    "0",
    "1",
    "9",
    "000",
    "123456789",
    "f",
    "A",
    ".",
    ".",
    "-",
    "+",
    "e",
    "E",
    "e-",
    "p",
    "p-",
    "P+",
    "0x",
    "0X",
    "1e",
    "e99999",
    "e-99999",
    "e-2147483648",
    "e2147483647",
    "p350000",
    "p-350001",
    "p-9223372036854775808",
    "p9223372036854775807",
    "inf",
    "nan",
    " ",
    "\t",
    "_",
    "é",
    "\0",
];

const FORMULAS: &[&str] = &[
    "a", "x", "phi'", "i", "2", "0.5", "1.", "+", "-", "*", "/", "^", "^2", "^(-1)", "^1000", "(",
    "(", ")", ")", "[", "]", ",", "=", "exp(", "sqrt(", "int(", "sum(", "series(", "D(", "at(",
    "n", "inf", " ", "π", "_", ":",
];

proptest! {
    #![proptest_config(cases(3000))]

    #[test]
    fn decimals(text in text(NUMBERS)) {
        match Decimal::parse(&text) {
            Ok(d) => {
                // Rust's own conversion reads the same number.
                let due: f64 = text.trim().parse().unwrap_or(f64::NAN);
                let limit = Rational::from_f64(due);
                let off = limit.map(|q| (q - &d.value).abs());
                let half = Rational::from_f64(due.abs().next_up() - due.abs());
                let close = match (off, half) {
                    (Some(off), Some(ulp)) => off * 2u32 <= ulp,
                    _ => due.is_infinite(),
                };
                prop_assert!(close, "{:?} read as {} and {}", text, d.value.to_f64(), due);
                let _ = d.unit();
            }
            Err(e) => prop_assert!(e.to_string().contains("decimal")),
        }
    }

    #[test]
    fn hexadecimal_floats(text in text(NUMBERS), bits in any::<u64>()) {
        match HexFloat::parse(&text) {
            Ok(x) => {
                let value = x.to_f64();
                prop_assert!(!value.is_nan());
                if value.is_finite() && value != 0.0 {
                    let off = (Rational::from_f64(value).expect("finite") - x.value()).abs();
                    let ulp = value.abs().next_up() - value.abs();
                    prop_assert!(ulp.is_infinite() || off * 2u32 <= ulp, "{:?}", text);
                }
            }
            Err(e) => prop_assert!(e.to_string().len() > 8),
        }
        let x = f64::from_bits(bits);
        if x.is_finite() {
            let back = HexFloat::parse(&hex_float(x)).expect("written here").to_f64();
            prop_assert_eq!(back.to_bits(), bits);
        }
    }

    #[test]
    fn formulas(text in text(FORMULAS)) {
        if let Ok(e) = parse(&text) {
            let shown = e.to_string();
            prop_assert_eq!(parse(&shown).ok(), Some(e), "{} gave {}", text, shown);
        }
        if let Ok(e) = parse_equation(&text) {
            prop_assert_eq!(parse(&e.left.to_string()).ok(), Some(e.left));
        }
    }

    #[test]
    fn hard_cases(lines in prop::collection::vec(text(&[
        "0.5", "1", "-1", "nan", "inf", ",", ",", ",", "y", "\"", "\"climbed\"", "0x1p-3", " ",
        "0x1.8p+1", "#", "\n", "\r\n", "é",
    ]), 0..6), header: bool) {
        let text = if header { format!("{HARD_HEADER}\n") } else { String::new() };
        match HardCase::read(&(text + &lines.join("\n"))) {
            Ok(all) => {
                let again: String = all.iter().map(HardCase::line).collect();
                let again = HardCase::read(&format!("{HARD_HEADER}\n{again}"));
                prop_assert_eq!(again.map(|a| a.len()).ok(), Some(all.len()));
            }
            Err(e) => prop_assert!(e.to_string().contains("line")),
        }
    }
}

proptest! {
    #![proptest_config(cases(300))]

    /// Bytes without a grammar.
    #[test]
    fn anything(text in any::<String>(), bytes in prop::collection::vec(any::<u8>(), 0..80)) {
        for text in [text, String::from_utf8_lossy(&bytes).into_owned()] {
            let _ = (Decimal::parse(&text), HexFloat::parse(&text), HardCase::read(&text));
            let _ = (parse(&text).is_ok(), parse_equation(&text).is_ok());
        }
    }
}

/// Long and deep texts end in an error or a value, not in an exhausted stack.
#[test]
fn long_texts() {
    for unit in [
        "(", "-", "a/", "a*", "a+", "exp(", "D(", "a[", "x^2", "1", "sum(n,1,", "0x", ".",
    ] {
        for tail in ["", "a", ")"] {
            let text = unit.repeat(200_000) + tail;
            let _ = (parse(&text).is_ok(), parse_equation(&text).is_ok());
            let _ = (
                Decimal::parse(&text).is_ok(),
                HexFloat::parse(&text).is_ok(),
            );
        }
    }
}
