//! Pins certified digits of the Faddeeva function at notable points, its zeros included.

use crate::pin;
use mechaudit::reference::faddeeva::{w, w_scaled, zero};
use mechaudit::reference::{Decimal, HexFloat};
use rug::Rational;
use std::fmt::Write;

const DIGITS: usize = 60;
const BITS: u32 = 220;

fn exact(text: &str) -> Rational {
    match text.contains("0x") {
        true => HexFloat::parse(text).expect("a hexadecimal float").value(),
        false => Decimal::parse(text).expect("a decimal").value,
    }
}

/// Zeros with 60 digits each, and w at the double next to them.
#[test]
fn zeros() {
    let mut text = String::new();
    for k in 1..=10 {
        let z = zero(k, BITS).expect("certified");
        let digits = [&z.re, &z.im].map(|b| b.to_decimal(DIGITS).expect("certified"));
        writeln!(text, "zero {k:2}    {}, {}", digits[0], digits[1]).expect("a string");
        let near = [&z.re, &z.im].map(|b| Rational::from_f64(b.to_f64()).expect("finite"));
        let w = w(&near[0], &near[1], BITS).expect("decided");
        let digits = [&w.re, &w.im].map(|b| b.to_decimal(DIGITS).expect("certified"));
        writeln!(text, "  w beside {}, {}", digits[0], digits[1]).expect("a string");
    }
    pin("faddeeva-zeros", &text);
}

/// Values on the axes, the diagonals, beside the axes, at seams of algorithms and far away.
#[test]
fn values() {
    let points = [
        ("0", "0"),
        ("1", "0"),
        ("0", "1"),
        ("0", "-1"),
        ("1", "1"),
        ("1", "-1"),
        ("0.1", "0.2"),
        ("2.5", "-2.5"),
        ("7", "-7"),
        ("100", "-100"),
        ("0x1.8p+13", "-0x1.8000000000001p+13"),
        ("6", "0"),
        ("26.5", "0"),
        ("6", "1e-300"),
        ("6", "-1e-300"),
        ("3", "-0.0003"),
        ("1e-300", "2"),
        ("1e-20", "-3"),
        ("1e-200", "1e-200"),
        ("0", "1e-320"),
        ("7", "0.125"),
        ("0.125", "-3.75"),
        ("16", "0.125"),
        ("0", "-26.6"),
        ("1e8", "1e-8"),
        ("1e8", "1e8"),
        ("1e154", "1e154"),
        ("-1.5", "-0.75"),
    ];
    let mut text = String::new();
    for (x, y) in points {
        let w = w(&exact(x), &exact(y), BITS).expect("decided");
        let digits = [&w.re, &w.im].map(|b| b.to_decimal(DIGITS).expect("certified"));
        writeln!(text, "w({x}, {y})\n  {}\n  {}", digits[0], digits[1]).expect("a string");
    }
    // Beyond the exponents of a ball.
    for (x, y) in [("1e5", "1e-310"), ("30000", "-40000"), ("1e20", "0")] {
        let w = w_scaled(&exact(x), &exact(y), BITS).expect("decided");
        let digits = w.map(|part| part.to_decimal(DIGITS).expect("certified"));
        writeln!(text, "w({x}, {y})\n  {}\n  {}", digits[0], digits[1]).expect("a string");
    }
    pin("faddeeva-values", &text);
}
