//! Bounds of integrals from both sides, points, and what is remembered.

use super::*;
use crate::parse;
use mechaudit_reference::Mag;

fn at(x: i32) -> Point {
    let named = [("x".to_string(), Rational::from(x))].into();
    Point {
        named,
        sample: Some(0),
    }
}

fn value(text: &str) -> Result<ComplexBall, SymbolicError> {
    Enclosures::new(&at(2)).value(&Definitions::default(), &parse(text).unwrap())
}

fn rational(z: &ComplexBall, due: (i32, i32)) -> bool {
    z.re.contains(&Rational::from(due)) && z.im.contains_zero()
}

/// Along paths on the real line, of complex values.
#[test]
fn integrals_of_exponentials() {
    for (text, due) in [
        ("int(s, 1, 3, s)", (4, 1)),
        ("int(s, -1, 1, s^3 + s^2)", (2, 3)),
        ("int(s, 1, 2, exp(0*s)*s)", (3, 2)),
    ] {
        assert!(rational(&value(text).unwrap(), due), "{text}");
    }
    for c in ["18", "(-18)", "40*i", "(20 + 20*i)"] {
        for factor in ["1", "i"] {
            let found = value(&format!("{factor}*int(s, 1, 3, exp({c}*s)/exp(2*{c}))")).unwrap();
            let due = value(&format!("{factor}*(exp({c}) - exp(-{c}))/({c})")).unwrap();
            assert!(
                found.re.overlaps(&due.re) && found.im.overlaps(&due.im),
                "{c}: {found:?} {due:?}"
            );
            assert!(
                found.radius() < due.magnitude().shift(-34),
                "{c}: {found:?}"
            );
        }
    }
}

/// Checks that a variable bound inside an integral is free again behind it.
#[test]
fn bound_variables_end_with_their_integrals() {
    assert!(rational(&value("int(x, 0, 1, x) + x").unwrap(), (5, 2)));
    assert!(rational(&value("at(x^2, x, 3) + x").unwrap(), (11, 1)));
}

/// Between 1/2 and 3/2, and another for every name and turn.
#[test]
fn points_are_distinct() {
    let mut seen = std::collections::BTreeSet::new();
    let names: Vec<String> = ('a'..='z').chain('A'..='Z').map(String::from).collect();
    for turn in 0..4 {
        let point = Point::sample(turn);
        for name in &names {
            for name in [name.clone(), format!("{name}_1"), format!("{name}{name}")] {
                let q = point.value(&name).unwrap();
                assert!((0.45..1.5).contains(&q.to_f64()), "{name}: {q}");
                // Three digits each.
                assert!(*q.denom() < 120, "{name}: {q}");
                seen.insert(q);
            }
        }
    }
    // 624 draws.
    assert!(seen.len() > 250, "{}", seen.len());
    assert_eq!(at(2).value("x").unwrap(), 2);
}

/// Checks that definitions are kept if they do not depend on a changing name, and only then.
#[test]
fn definitions_that_change_are_not_kept() {
    let mut enclosures = Enclosures::of_changing(&at(2), &["k"]);
    let mut value = |k: &str, text: &str| {
        let k = format!("k = {k}");
        let lines = [
            "fixed = 3*x",
            "changing = k + x",
            "through = 2*changing",
            &k,
        ];
        let definitions = Definitions::read(&lines).unwrap();
        enclosures
            .value(&definitions, &parse(text).unwrap())
            .unwrap()
    };
    for (k, text, due) in [
        ("5", "fixed + 1", (7, 1)),
        ("5", "through", (14, 1)),
        ("5", "int(s, 0, 1, k*x*s)", (5, 1)),
        ("7", "through", (18, 1)),
        ("7", "fixed + 1", (7, 1)),
        ("7", "int(s, 0, 1, k*x*s)", (7, 1)),
        ("7", "sum(j, 1, 2, fixed*j)", (18, 1)),
    ] {
        assert!(rational(&value(k, text), due), "{k}: {text}");
    }
    assert!(enclosures.known.contains_key("fixed"));
    assert!(!enclosures.known.contains_key("through"));
}

/// A precision that is too low to decide is raised.
#[test]
fn precision_is_raised() {
    // √(x² + 10⁻⁹⁰) − x, below which the first precision sees nothing.
    let small = value("1/(sqrt(x^2 + 1/10^90) - x)").unwrap();
    assert!(small.re.accuracy_bits() > 60, "{small:?}");
    // An exact zero at every precision.
    let zero = value("1/(sqrt(x^2 + 2*x + 1) - x - 1)");
    assert!(
        matches!(zero, Err(SymbolicError::NotInvertible(_))),
        "{zero:?}"
    );
}

/// Checks that a variable of an integral is free again after it.
#[test]
fn variables_of_integrals_end_with_them() {
    let named = [("s".to_string(), Rational::from(5))].into();
    let point = Point {
        named,
        sample: Some(0),
    };
    let value = |text: &str| {
        let found = Enclosures::new(&point).value(&Definitions::default(), &parse(text).unwrap());
        found.unwrap()
    };
    for (text, due) in [
        ("int(s, 0, 1, 2*s) + s", 6),
        ("s*int(s, 0, 1, 3*s^2)*s", 25),
    ] {
        let found = value(text);
        assert!(found.re.contains(&Rational::from(due)), "{text}: {found:?}");
        assert!(found.re.rad() < Mag::power_of_two(-60), "{text}: {found:?}");
    }
}
