//! Tests of `quantity`.

use super::*;

fn si<D: Dimension>(text: &str) -> Rational {
    text.parse::<Quantity<D>>().unwrap().value
}

fn refusal<D: Dimension + fmt::Debug>(text: &str) -> String {
    text.parse::<Quantity<D>>().unwrap_err().to_string()
}

#[test]
fn quantities_are_exact() {
    assert_eq!(si::<Length>("48.5 cm"), Rational::from((485, 1000)));
    assert_eq!(si::<Length>("48.5cm"), Rational::from((485, 1000)));
    assert_eq!(si::<Length>("-1.5e1 mm"), Rational::from((-15, 1000)));
    assert_eq!(si::<Length>("2 in"), Rational::from((508, 10_000)));
    assert_eq!(si::<Inertia>("20 kg cm^2"), Rational::from((2, 1000)));
    assert_eq!(si::<Inertia>("20 kg·m²"), 20);
    assert_eq!(
        si::<Inertia>("3 g*mm^2"),
        Rational::from((3, 1_000_000_000u64))
    );
    assert_eq!(si::<Acceleration>("981 cm/s^2"), Rational::from((981, 100)));
    assert_eq!(si::<Torque>("2.5 kN cm"), 25);
    assert_eq!(si::<Torque>("3 N·m"), 3);
    assert_eq!(si::<ViscousResistance>("3 N m s"), 3);
    assert_eq!(si::<Time>("5 ms"), Rational::from((5, 1000)));
    assert_eq!(si::<AngularVelocity>("60 rpm"), 360);
    assert_eq!(si::<AngularVelocity>("2 rev/min"), 12);
    assert_eq!(si::<AngularVelocity>("50 Hz"), 18_000);
    for frequency in [
        "1500 1/min",
        "1500/min",
        "1500 min^-1",
        "1500 min⁻¹",
        "25 Hz",
        "1500 rpm",
    ] {
        assert_eq!(si::<AngularVelocity>(frequency), 9000, "{frequency}");
    }
    for small in ["5 µm", "5 μm", "5 um", "5μm"] {
        assert_eq!(si::<Length>(small), Rational::from((5, 1_000_000)));
    }
    assert_eq!(si::<Length>("2 inch"), Rational::from((508, 10_000)));
    let q = "-39.3 deg".parse::<Quantity<Angle>>().unwrap();
    assert!(q.degrees && q.value == Rational::from((-393, 10)));
    assert_eq!(q.to_f64(), (-39.3f64).to_radians());
    assert_eq!(si::<Mass>("0.1 kg"), Rational::from((1, 10)));
    assert_eq!(nearest_f64(&si::<Mass>("0.1 kg")), 0.1);
}

/// Every unit that [`KNOWN`] names against its definition: the SI (BIPM, *The International System
/// of Units*, 9th ed. 2019, tables 4, 5, 7 and 8); the international yard and pound of 1959: 1 yd =
/// 0.9144 m, 1 lb = 0.453 592 37 kg, 1 ft = 1/3 yd, 1 in = 1/36 yd.
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
    ];
    let named: Vec<&str> = definitions.iter().map(|d| d.0).collect();
    assert_eq!(named.join(" "), KNOWN);
    for (name, scale, dimension, degrees) in definitions {
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

/// The value is rounded once also where it is subnormal.
#[test]
fn subnormal_values_are_nearest() {
    for (text, due) in [
        ("2.4703282292062327209e-322 cm", 5e-324),
        ("2.4703282292062327208e-322 cm", 0.0),
        ("-2.4703282292062327209e-321 mm", -5e-324),
        ("1e-308 cm", 1e-310),
    ] {
        let l: Quantity<Length> = text.parse().unwrap();
        assert_eq!(l.to_f64(), due, "{text}");
    }
}

#[test]
fn the_list_of_units_is_right() {
    for name in KNOWN.split(' ') {
        assert!(unit(name).is_ok(), "{name}");
    }
}

#[test]
fn refusals_say_what_to_write() {
    let long = format!("1 {}", "in^4 ".repeat(200_000));
    let e = refusal::<Length>(&long);
    assert!(e.contains("more than 16 units"));
    type Read = fn(&str) -> String;
    let cases: [(Read, &str, &str); 12] = [
        (refusal::<Length>, "10", "write for instance \"10 cm\""),
        (refusal::<Length>, "10 kg", "is not a length"),
        (refusal::<Length>, "10 furlong", "\"furlong\" is not a unit"),
        (refusal::<Length>, "nan m", "decimal number"),
        (refusal::<Length>, "inf m", "decimal number"),
        (refusal::<Length>, "", "decimal number"),
        (refusal::<Length>, "1,5 cm", "not a unit"),
        (refusal::<Inertia>, "18 kg m", "is not a moment of inertia"),
        (refusal::<Inertia>, "18 kg m^x", "power"),
        (refusal::<Angle>, "1 rad/s", "is not an angle"),
        (refusal::<Mass>, "1e999999 kg", "decimal number"),
        (
            refusal::<AngularVelocity>,
            "5 1/s",
            "1/min and Hz are known",
        ),
    ];
    for (refusal, text, part) in cases {
        let e = refusal(text);
        assert!(e.contains(part), "{text}: {e}");
        assert!(!e.contains('\n'));
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
            (found.scale, found.dimension, found.degrees),
            (scale, dimension, false),
            "{text}"
        );
    }
    assert_eq!(unit("deg/s^2").unwrap().dimension, [0, 0, -2, 1]);
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
    assert_eq!(unit("rad 1"), Err(UnitError::Frequency));
    assert_eq!(unit(&"m ".repeat(16)).unwrap().dimension, [16, 0, 0, 0]);
    assert_eq!(unit(&"m ".repeat(17)), Err(UnitError::TooMany));
}

/// An exponent has digits; what follows the number is its unit.
#[test]
fn numbers_end_where_units_begin() {
    for (text, due) in [
        ("1e3m", 1000.0),
        ("2.5E-1 m", 0.25),
        ("1e+2m", 100.0),
        ("+.5m", 0.5),
        (" 7 m ", 7.0),
        ("-3\u{b5}m", -3e-6),
    ] {
        let found: Quantity<Length> = text.parse().unwrap();
        assert_eq!(found.to_f64(), due, "{text}");
    }
    for text in ["1em", "1e", "1e-m", "1e+", "e3 m", "m", "--1 m", "1-2 m"] {
        assert!(text.parse::<Quantity<Length>>().is_err(), "{text}");
    }
}

/// Degrees stay what they are; radians are in SI units.
#[test]
fn angles_are_degrees_or_radians() {
    let angle = |text: &str| text.parse::<Quantity<Angle>>().unwrap();
    let [degrees, radians] = ["45 deg", "0.5 rad"].map(angle);
    assert_eq!(
        [degrees.to_f64(), radians.to_f64()],
        [45f64.to_radians(), 0.5]
    );
    assert_eq!(degrees.in_degrees(), Some(Rational::from(45)));
    assert_eq!(
        radians.in_degrees(),
        Rational::from_f64(0.5f64.to_degrees())
    );
    assert_eq!(
        [degrees.in_turns(), radians.in_turns()],
        [0.125, 0.25 / std::f64::consts::PI]
    );
    assert_eq!(angle("1 rev").in_turns(), 1.0);
    let q = |n: i32, d: i32| Rational::from((n, d));
    assert_eq!(degrees.exact_angle(), ExactAngle::Degrees(q(45, 1)));
    assert_eq!(radians.exact_angle(), ExactAngle::Radians(q(1, 2)));
    assert_eq!(radians.to_ball(64).to_f64(), 0.5);
    assert!((degrees.to_ball(64).to_f64() - 45f64.to_radians()).abs() < 1e-16);
    let si = Quantity::<Angle>::si(q(1, 2));
    assert_eq!((si.to_f64(), si), (0.5, radians));
}
