//! Tests of `decimal`.

use super::*;

#[test]
fn rational_numbers_are_rounded_once() {
    let tiny = |text: &str| nearest_f64(&Decimal::parse(text).unwrap().value);
    // Half of the smallest subnormal is 2.47032822920623272088…e-324.
    for (text, steps) in [
        ("2.4703282292062327208e-324", 0),
        ("2.4703282292062327209e-324", 1),
        ("7.410984687618698162e-324", 1),
        ("7.410984687618698163e-324", 2),
        ("1e-400", 0),
        ("1e-100000", 0),
        ("2.2250738585072014e-308", 1 << 52),
        ("2.2250738585072011e-308", (1 << 52) - 1),
    ] {
        assert_eq!(tiny(text).to_bits(), steps, "{text}");
        let less = -nearest_f64(&-Decimal::parse(text).unwrap().value);
        assert_eq!(less, f64::from_bits(steps), "-{text}");
    }
    // Exact ties go to the even multiple, everything else as Rust rounds the same digits.
    let step = |n: u32| Rational::from((n, 2)) >> 1074u32;
    for (halves, due) in [(1, 0), (2, 1), (3, 2), (5, 2), (7, 4)] {
        assert_eq!(nearest_f64(&step(halves)).to_bits(), due, "{halves} halves");
    }
    for k in 0..2000u32 {
        let text = format!("{}.{:05}e-{}", 1 + k % 9, k * 37 % 100_000, 300 + k % 26);
        assert_eq!(tiny(&text), text.parse::<f64>().unwrap(), "{text}");
    }
    assert_eq!(tiny("1e309"), f64::INFINITY);
    assert_eq!(tiny("0.1"), 0.1);
}

#[test]
fn exact_parsing() {
    for (text, n, d, places) in [
        ("0.034", 34, 1000, 3),
        ("-0.000", 0, 1, 3),
        ("+7", 7, 1, 0),
        ("1.5e-3", 15, 10_000, 4),
        ("2.5E2", 250, 1, 0),
        (".5", 1, 2, 1),
    ] {
        let x = Decimal::parse(text).unwrap();
        assert_eq!(x.value, Rational::from((n, d)), "{text}");
        assert_eq!(x.places, places, "{text}");
    }
    for text in [
        "",
        "-",
        ".",
        "1,5",
        "nan",
        "inf",
        "1e",
        "1e999999999",
        "1e-2147483648",
        "0x10",
        "1.2.3",
        "--1",
    ] {
        assert!(Decimal::parse(text).is_err(), "{text:?}");
    }
}

#[test]
fn the_last_digit_has_its_place() {
    for (text, n, d) in [
        ("1.25", 1, 100),
        ("1.2e4", 1000, 1),
        ("12", 1, 1),
        ("1.20e-1", 1, 1000),
    ] {
        assert_eq!(
            Decimal::parse(text).unwrap().unit(),
            Rational::from((n, d)),
            "{text}"
        );
    }
    let off = Decimal::parse("0.334").unwrap();
    let off = off.units_off(&Ball::rational(100, &Rational::from((1, 3))));
    assert!((off.to_f64() - 2.0 / 3.0).abs() < 1e-12);
}

#[test]
fn digits_are_printed_only_when_certified() {
    let third = Ball::rational(100, &Rational::from((1, 3)));
    assert_eq!(third.to_decimal(20).unwrap(), "0.33333333333333333333");
    assert_eq!(third.to_fixed(4).unwrap(), "0.3333");
    assert_eq!(third.to_decimal(40), None);
    assert_eq!(third.to_fixed(40), None);
    let minus = -(&third / &Ball::integer(100, 1000));
    assert_eq!(minus.to_fixed(5).unwrap(), "-0.00033");
    assert_eq!(minus.to_decimal(6).unwrap(), "-0.000333333");
    assert_eq!(Ball::integer(64, 1200).to_decimal(6).unwrap(), "1200.00");
    assert_eq!(Ball::integer(64, 0).to_decimal(6).unwrap(), "0");
}
