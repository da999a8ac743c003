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
            "is not an angular velocity",
        ),
    ];
    for (refusal, text, part) in cases {
        let e = refusal(text);
        assert!(e.contains(part), "{text}: {e}");
        assert!(!e.contains('\n'));
    }
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
