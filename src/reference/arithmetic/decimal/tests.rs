//! Tests of `decimal`.

use super::*;
use crate::draw::Draw;

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
    for (text, due) in [
        ("1e-400", 0.0f64),
        ("-1e-400", -0.0),
        ("-1e309", f64::NEG_INFINITY),
    ] {
        assert_eq!(tiny(text).to_bits(), due.to_bits(), "{text}");
    }
    assert_eq!(tiny("1e309"), f64::INFINITY);
    assert_eq!(tiny("0.1"), 0.1);
}

/// The sign belongs to the number, the exponent to its last digit, whose place is the unit.
#[test]
fn numbers_are_read_exactly() {
    for (text, n, d, exponent) in [
        ("0.034", 34, 1000, -3),
        ("-0.000", 0, 1, -3),
        ("+7", 7, 1, 0),
        ("1.5e-3", 15, 10_000, -4),
        ("2.5E2", 250, 1, 1),
        (".5", 1, 2, -1),
        ("-1.25", -5, 4, -2),
        ("-7e2", -700, 1, 2),
        ("-12.5e-1", -5, 4, -2),
        ("1.5e1", 15, 1, 0),
        ("1e0", 1, 1, 0),
        ("1.2e4", 12_000, 1, 3),
    ] {
        let x = Decimal::parse(text).unwrap();
        assert_eq!(x.value, Rational::from((n, d)), "{text}");
        assert_eq!(x.exponent, exponent, "{text}");
        assert_eq!(x.places as i32, (-exponent).max(0), "{text}");
        let places = Rational::from(10u32.pow(x.places));
        let unit = match exponent > 0 {
            true => Rational::from(10u32.pow(exponent as u32)),
            false => places.recip(),
        };
        assert_eq!(x.unit(), unit, "{text}");
    }
    for text in [
        "",
        "-",
        "+",
        ".",
        "1,5",
        "nan",
        "inf",
        "1e",
        "1e+",
        "e5",
        ".e5",
        "1e999999999",
        "1e-2147483648",
        "0x10",
        "1.2.3",
        "--1",
    ] {
        assert!(Decimal::parse(text).is_err(), "{text:?}");
    }
    for text in ["", "+", "e5", ".e5", "1e+"] {
        assert!(Decimal::nearest(text).is_err(), "{text:?}");
    }
    assert_eq!(Decimal::parse("1e100000").unwrap().exponent, 100_000);
    let beyond = Decimal::parse("1e100001").unwrap_err().to_string();
    assert!(beyond.ends_with("is beyond ±100000"), "{beyond}");
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

fn around(text: &str, rad: f64) -> Ball {
    let mid = Float::with_val(300, &Decimal::parse(text).unwrap().value);
    Ball::new(mid, Mag::from_f64(rad))
}

/// Not more than 0.51 units wrong: next to a tie a hundredth of a unit is to spare.
#[test]
fn a_hundredth_of_a_unit_is_allowed() {
    let tie = |rad: f64| around("9.995", rad).to_decimal(3);
    assert_eq!(tie(1.1e-4), None);
    assert!(tie(5e-5).is_some());
    let fixed = |text: &str, rad: f64, places: u32| around(text, rad).to_fixed(places);
    for (text, places, unit) in [
        ("9.96", 0, 1.0),
        ("-0.26", 1, 0.1),
        ("3.004", 2, 0.01),
        ("0.5006", 3, 0.001),
    ] {
        assert_eq!(fixed(text, 0.011 * unit, places), None, "{text}");
        let due = match places {
            0 => "10",
            1 => "-0.3",
            2 => "3.00",
            _ => "0.501",
        };
        assert_eq!(fixed(text, 0.009 * unit, places).unwrap(), due);
    }
    assert_eq!(fixed("0.004", 0.0, 2).unwrap(), "0.00");
    assert_eq!(fixed("0", 0.0, 0).unwrap(), "0");
    let all = Ball::new(Float::with_val(64, 1), Mag::INFINITY);
    assert!(all.to_decimal(1).is_none() && all.to_fixed(0).is_none());
    assert!(around("0", 1e-9).to_decimal(1).is_none());
}

/// One digit at least; written out from seven zeros behind the point to twenty-one before it.
#[test]
fn how_decimals_are_written() {
    for (text, digits, due) in [
        ("0.3421", 0, "0.3"),
        ("0.3421", 1, "0.3"),
        ("0.3421", 2, "0.34"),
        ("1.2e-7", 2, "0.00000012"),
        ("1.2e-8", 2, "1.2e-8"),
        ("-1.2e20", 2, "-120000000000000000000"),
        ("1.2e21", 2, "1.2e21"),
        ("-1234567", 3, "-1230000"),
        ("1234567", 9, "1234567.00"),
    ] {
        let found = around(text, 0.0).to_decimal(digits).unwrap();
        assert_eq!(found, due, "{text}");
    }
    for (text, due) in [
        ("1.234e2", "123.4"),
        ("-1.234e2", "-123.4"),
        ("1.2e1", "12"),
        ("1.2e2", "120"),
        ("1e0", "1"),
        ("1.2e-1", "0.12"),
        ("1.2e-2", "0.012"),
        ("12.5", "12.5"),
    ] {
        assert_eq!(plain(text), due);
    }
}

/// The radius reaches from the decimal to both ends of the ball, with little to spare.
#[test]
fn radii_reach_the_whole_ball() {
    let check = |ball: &Ball, digits: usize, most: f64| {
        let (value, radius) = ball.to_decimal_with_radius(digits).unwrap();
        let read = |text: &str| Decimal::parse(text).unwrap().value;
        let mid = ball.mid().to_rational().unwrap();
        let off = (read(&value) - mid).abs() + ball.rad().to_float().to_rational().unwrap();
        let radius = read(&radius);
        assert!(radius >= off, "{value}: {radius} {off}");
        let most = off * Rational::from_f64(most).unwrap();
        assert!(radius <= most, "{value}: {radius} {most}");
    };
    for (text, rad, digits) in [
        ("0.333333", 0.0, 2),
        ("-0.333333", 1e-3, 2),
        ("7123456", 0.0, 3),
        ("0", 0.25, 3),
        ("5", 0.0, 0),
        ("9.995", 1e-4, 3),
        // Barely more than a radius of three digits.
        ("0.3000035000000000000000001", 0.0, 5),
    ] {
        check(&around(text, rad), digits, 1.0101);
    }
    // Barely more than a quarter, a number of few bits.
    let quarter = Rational::from((41, 4)) + (Rational::from(1) >> 150u32);
    let quarter = Ball::new(Float::with_val(200, &quarter), Mag::ZERO);
    check(&quarter, 2, 1.0101);
    // Too long to be written out: half a unit, which is nearly needed here.
    for (text, digits) in [
        ("1.0004999e30000", 4),
        ("-1.4999e-30000", 1),
        ("1.04999999e25000", 2),
    ] {
        check(&around(text, 0.0), digits, 1.6);
    }
    check(&around("1.00000004999e30000", 0.0), 8, 1.02);
    // With a radius that leaves no more than 10^-9 of it to the next three digits.
    let tie = around("1.00000000000000049999999999e30000", 0.0);
    let rad = Float::with_val(53, &Decimal::parse("5.00000001e29984").unwrap().value);
    check(&Ball::new(tie.mid().clone(), Mag::above(&rad)), 16, 1.02);
    // Written out.
    check(&around("1.00001e10000", 0.0), 3, 1.0101);
}

#[test]
fn decimals_with_radii_as_text() {
    for (text, rad, digits, due) in [
        ("3", 0.0, 2, ("3.0", "0")),
        ("0.25", 0.0, 1, ("0.2", "5.01e-2")),
        ("0", 0.0, 5, ("0", "0")),
        ("0", 0.25, 5, ("0", "2.50e-1")),
        ("8.5", 0.125, 0, ("8", "6.26e-1")),
        ("8.5", 0.0001, 3, ("8.50", "1.01e-4")),
    ] {
        let (value, radius) = around(text, rad).to_decimal_with_radius(digits).unwrap();
        assert_eq!((value.as_str(), radius.as_str()), due, "{text}");
    }
    let all = Ball::new(Float::with_val(64, 1), Mag::INFINITY);
    assert_eq!(all.to_decimal_with_radius(3), None);
    // Beyond the exponents that are read.
    let far = Ball::new(Float::with_val(64, 1) << 400_000, Mag::ZERO);
    let (value, radius) = far.to_decimal_with_radius(0).unwrap();
    // 2^400000 is 9.96e120411, half of it 4.98e120411.
    assert_eq!(
        (value.as_str(), radius.as_str()),
        ("1e120412", "4.99e120411")
    );
}

/// A radius that is just a hundredth of a unit is allowed, and none above it.
#[test]
fn a_hundredth_of_a_unit_to_the_last_bit() {
    let mut just = 0;
    for places in 0..40 {
        let hundredths: Float = Float::with_val(200, 10).pow(places + 2);
        let near = Float::with_val(53, hundredths.recip_ref()).to_f64();
        for k in -8..8 {
            let rad = Mag::from_f64(near * (1.0 + f64::from(k) * f64::EPSILON));
            let size = rad.mul(Mag::above(&hundredths));
            let x = Ball::integer(64, 0).widened(rad);
            let due = size <= Mag::from_f64(1.0);
            assert_eq!(x.to_fixed(places as u32).is_some(), due, "{places} {k}");
            just += u32::from(size == Mag::from_f64(1.0));
        }
    }
    assert!(just > 0);
}

/// Half a unit of the last digit, from above, and not by more than its roundings.
#[test]
fn halves_of_units() {
    for bits in [53, 200] {
        let mut draw = Draw(u64::from(bits));
        for digits in 1..50 {
            let x = Ball::rational(bits, &draw.between(1, 2)).mid().clone();
            let found = half_a_unit(&x, digits);
            let power: Float = Float::with_val(400, 10).pow(digits as u32 - 1);
            let due: Float = Float::with_val(400, &x / &power) / 2u32;
            let found = Float::with_val(400, found.to_float());
            assert!(found >= due && found <= due * (1.0 + 1e-15));
        }
    }
}
