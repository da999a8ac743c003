//! Tests of the reader of units.

use super::*;

/// Every unit that [`KNOWN_UNITS`] names against its definition: the SI (BIPM, *The International
/// System of Units*, 9th ed. 2019, tables 4, 5, 7 and 8); the international yard and pound of 1959:
/// 1 yd = 0.9144 m, 1 lb = 0.453 592 37 kg, 1 ft = 1/3 yd, 1 in = 1/36 yd.
#[test]
fn every_unit_is_its_definition() {
    let yard = Rational::from((9144, 10_000));
    let ten = |k: u32| Rational::from(rug::Integer::from(rug::Integer::u_pow_u(10, k)));
    let one = || Rational::from(1);
    let (length, mass, time) = ([1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]);
    let (angle, rate, force) = ([0, 0, 0, 1], [0, 0, -1, 1], [1, 1, -2, 0]);
    let full_turn = || Rational::from(360);
    let definitions = [
        ("m", one(), length, false),
        ("dm", ten(1).recip(), length, false),
        ("cm", ten(2).recip(), length, false),
        ("mm", ten(3).recip(), length, false),
        ("um", ten(6).recip(), length, false),
        ("µm", ten(6).recip(), length, false),
        ("in", Rational::from(&yard / 36u32), length, false),
        ("inch", Rational::from(&yard / 36u32), length, false),
        ("ft", Rational::from(&yard / 3u32), length, false),
        ("kg", one(), mass, false),
        ("g", ten(3).recip(), mass, false),
        ("t", ten(3), mass, false),
        ("lb", Rational::from(45_359_237) / ten(8), mass, false),
        ("N", one(), force, false),
        ("kN", ten(3), force, false),
        ("s", one(), time, false),
        ("ms", ten(3).recip(), time, false),
        ("min", Rational::from(60), time, false),
        ("rad", one(), angle, false),
        ("deg", one(), angle, true),
        ("°", one(), angle, true),
        ("rev", full_turn(), angle, true),
        ("rpm", full_turn() / 60u32, rate, true),
        ("Hz", full_turn(), rate, true),
        ("1/min", full_turn() / 60u32, rate, true),
        ("h", Rational::from(3600), time, false),
        ("Pa", one(), [-1, 1, -2, 0], false),
        ("bar", ten(5), [-1, 1, -2, 0], false),
        ("J", one(), [2, 1, -2, 0], false),
        ("W", one(), [2, 1, -3, 0], false),
    ];
    let beyond = [
        ("A", one(), [0, 0, 0, 0, 1, 0, 0, 0]),
        ("C", one(), [0, 0, 1, 0, 1, 0, 0, 0]),
        ("V", one(), [2, 1, -3, 0, -1, 0, 0, 0]),
        ("K", one(), [0, 0, 0, 0, 0, 1, 0, 0]),
        ("mol", one(), [0, 0, 0, 0, 0, 0, 1, 0]),
        ("cd", one(), [0, 0, 0, 0, 0, 0, 0, 1]),
        ("1", one(), [0; 8]),
        ("%", ten(2).recip(), [0; 8]),
    ];
    let mut named: Vec<&str> = definitions.iter().map(|d| d.0).collect();
    named.extend(beyond.iter().map(|d| d.0));
    assert_eq!(named.join(" "), KNOWN_UNITS);
    let mechanical = definitions.map(|(name, scale, [m, kg, s, angle], degrees)| {
        (name, scale, [m, kg, s, angle, 0, 0, 0, 0], degrees)
    });
    let others = beyond.map(|(name, scale, dimension)| (name, scale, dimension, false));
    for (name, scale, dimension, degrees) in mechanical.into_iter().chain(others) {
        let found = unit(name).unwrap();
        assert_eq!(
            found,
            Unit {
                scale,
                dimension,
                degrees
            },
            "{name}"
        );
    }
}

#[test]
fn the_list_of_units_is_right() {
    for name in KNOWN_UNITS.split(' ') {
        assert!(unit(name).is_ok(), "{name}");
    }
}

/// A stroke divides by the next factor alone; powers are whole numbers from −4 to 4.
#[test]
fn products_of_units_are_exact() {
    let q = |n: i64, d: i64| Rational::from((n, d));
    for (text, scale, dimension) in [
        ("m^0", q(1, 1), [0, 0, 0, 0]),
        ("cm^4", q(1, 100_000_000), [4, 0, 0, 0]),
        ("cm^-4", q(100_000_000, 1), [-4, 0, 0, 0]),
        ("kN/cm^2", q(10_000_000, 1), [-1, 1, -2, 0]),
        ("g/cm/s", q(1, 10), [-1, 1, -1, 0]),
        ("1 m".strip_prefix("1 ").unwrap(), q(1, 1), [1, 0, 0, 0]),
        ("m/s·kg", q(1, 1), [1, 1, -1, 0]),
        ("kg / min^2 * mm", q(1, 3_600_000), [1, 1, -2, 0]),
        ("N m s^2/min", q(1, 60), [2, 1, -1, 0]),
        ("s^-1/ms^-1", q(1, 1000), [0, 0, 0, 0]),
    ] {
        let found = unit(text).unwrap();
        assert_eq!(
            (&found.scale, &found.dimension[..4], found.degrees),
            (&scale, &dimension[..], false),
            "{text}"
        );
    }
    assert_eq!(unit("deg/s^2").unwrap().dimension[..4], [0, 0, -2, 1]);
    assert!(unit("rad/s").is_ok_and(|u| !u.degrees) && unit("s^-1 deg").is_ok_and(|u| u.degrees));
    for text in ["m^5", "m^-5", "m^1.5", "m^", "m^x"] {
        let factor = text.into();
        assert_eq!(unit(text), Err(UnitError::Power { factor }));
    }
    for text in ["", " ", "  \t"] {
        assert_eq!(unit(text), Err(UnitError::Empty));
    }
    let name = "M".into();
    assert_eq!(unit("m M"), Err(UnitError::Unknown { name }));
    // A prefix belongs to a unit of the SI: no kilominute, no prefix of a prefix.
    for text in ["kmin", "mmm", "kkg", "k", "Mpsi"] {
        assert_eq!(unit(text), Err(UnitError::Unknown { name: text.into() }));
    }
    assert_eq!(
        unit("GPa/kHz").unwrap().scale,
        Rational::from((1_000_000, 360))
    );
    assert_eq!(unit(&"m ".repeat(16)).unwrap().dimension[0], 16);
    assert_eq!(unit(&"m ".repeat(17)), Err(UnitError::TooMany));
}
