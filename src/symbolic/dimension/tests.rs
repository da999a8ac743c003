//! Tests of dimensional analysis.

use super::super::{parse, parse_equation, unit};
use super::*;

fn units(numbers: bool, declared: &[(&str, &str)]) -> Dimensions {
    let mut out = Dimensions {
        numbers,
        ..Dimensions::default()
    };
    for (names, of) in declared {
        let of = unit(of).unwrap();
        names.split(' ').for_each(|n| out.declare(n, &of));
    }
    out
}

fn mechanics() -> Dimensions {
    units(
        false,
        &[
            ("x y l", "m"),
            ("v", "cm/s"),
            ("t", "s"),
            ("omega", "rpm"),
            ("phi", "deg"),
            ("m", "kg"),
            ("E", "J"),
            ("k n", "1"),
        ],
    )
}

fn found(text: &str) -> Result<String, String> {
    let none = Definitions::default();
    match mechanics().of(&none, &parse(text).unwrap()) {
        Ok(Some(unit)) => Ok(unit.to_string()),
        Ok(None) => Ok("any".into()),
        Err(e) => Err(e.to_string()),
    }
}

#[test]
fn units_of_expressions() {
    for (text, due) in [
        ("x*y/t^2", "m^2 s^-2"),
        ("sqrt(x)", "m^(1/2)"),
        ("cbrt(x^3)/y", "1"),
        ("(x^2 + y^2)^(1/2)", "m"),
        ("x^(-3/2)", "m^(-3/2)"),
        ("0", "any"),
        ("x + 0", "m"),
        ("x*0", "any"),
        ("sin(omega*t + phi)*v", "m s^-1"),
        ("exp(-t/(2*t))", "1"),
        ("atan2(y, x)", "1"),
        ("hypot(x, y)", "m"),
        ("int(s, 0, l, s^2)", "m^3"),
        ("int(s, 0, inf, exp(-s^2))", "1"),
        ("int(t, 0, inf, v*exp(-omega*t))", "m"),
        ("D(x, t)", "m s^-1"),
        ("D(D(x, t), t)", "m s^-2"),
        ("at(x*y, x, l)", "m^2"),
        ("at(x*y, x, 0)", "m^2"),
        ("sum(j, 1, n, x^2/j^2)", "m^2"),
        ("x[3] - x", "m"),
        ("series(j, x[j])", "m"),
        ("if(x < y, x, y)", "m"),
        ("let(a, x/t, a*t)", "m"),
        ("root(s, 0, l, s - x)", "m"),
        ("while(k < n, a, x, a + y, a)", "m"),
        ("voigt(x, y, l)", "m^-1"),
        ("k^n", "1"),
        ("fma(x, y, l^2)", "m^2"),
        ("copysign(x, v)", "m"),
        ("abs(-x)*i", "m"),
    ] {
        assert_eq!(found(text).as_deref(), Ok(due), "{text}");
    }
}

#[test]
fn the_innermost_fault_is_named() {
    for (text, due) in [
        ("x*(x + v)", "in x + v: x is in m, but v in m s^-1"),
        ("sin(x)", "in sin(x): x has to be a pure number and is in m"),
        ("2^x", "in pow(2, x): x has to be a pure number and is in m"),
        (
            "x^k",
            "in pow(x, k): x is in m, so that the exponent has to be a rational number",
        ),
        ("x + 1", "in x + 1: x is in m, but 1 in 1"),
        ("q*x", "q has no unit"),
        ("at(x*y, x, t)", "in at(x*y, x, t): x is in m, but t in s"),
        ("if(x < t, x, y)", "in x < t: x is in m, but t in s"),
        (
            "while(k < n, a, x, a*y, a)",
            "in while(k < n, a, x, a*y, a): a is in m, but a*y in m^2",
        ),
        (
            "int(s, x, t, s)",
            "in int(s, x, t, s): x is in m, but t in s",
        ),
    ] {
        assert_eq!(found(text), Err(due.into()), "{text}");
    }
}

#[test]
fn definitions_are_followed() {
    let with = Definitions::read(&["r = x/t", "t: x = v", "a = b", "b = a"]).unwrap();
    let of = |text: &str| mechanics().of(&with, &parse(text).unwrap());
    assert_eq!(of("r*t").unwrap().unwrap().to_string(), "m");
    assert_eq!(of("D(r, t)").unwrap().unwrap().to_string(), "m s^-2");
    assert!(matches!(of("a"), Err(Undimensional::Circular { .. })));
    // A definition does not see the variables that are bound where it is used.
    assert!(of("let(x, t, r + x/t)").is_err());
}

/// The factor 10^-4 that (4) of Zinchenko's paper lacks: lengths in centimetres, inertias in kg m².
/// Between quantities the formula is right.
#[test]
fn a_lost_factor_is_named() {
    let declared = [
        ("I_n I_2", "kg m^2"),
        ("m_2", "kg"),
        ("v_S2", "cm/s"),
        ("omega_1 omega_2", "1/s"),
        ("c", "m/cm"),
    ];
    let printed = parse_equation("I_n = (m_2*v_S2^2 + I_2*omega_2^2)/omega_1^2").unwrap();
    let none = Definitions::default();
    assert!(units(false, &declared).check(&none, &printed).is_ok());
    let fault = units(true, &declared).check(&none, &printed).unwrap_err();
    assert_eq!(
        fault.to_string(),
        "in m_2*v_S2^2 + I_2*omega_2^2: m_2*v_S2^2 is in 10^-4 m^2 kg s^-2, but I_2*omega_2^2 in m^2 kg s^-2; \
         as numbers they differ by the factor 10^4"
    );
    let right = parse_equation("I_n = (m_2*(c^(-1)*v_S2)^2 + I_2*omega_2^2)/omega_1^2").unwrap();
    let mut with = units(true, &declared);
    with.declare("c", &unit("cm/m").unwrap());
    assert_eq!(with.check(&none, &right), Ok(()));
}

#[test]
fn sizes_are_exact() {
    let of = |text: &str| Powers::of(&unit(text).unwrap()).to_string();
    for (text, due) in [
        ("mm^2", "10^-6 m^2"),
        ("kN cm", "10 m^2 kg s^-2"),
        ("deg", "1/180 pi"),
        ("rpm", "1/30 pi s^-1"),
        ("lb/lb", "1"),
        ("%", "1/100"),
        ("kV", "10^3 m^2 kg s^-3 A^-1"),
    ] {
        assert_eq!(of(text), due, "{text}");
    }
    let area = units(true, &[("a", "cm"), ("b", "mm^2")]);
    let check = |text: &str| area.check(&Definitions::default(), &parse_equation(text).unwrap());
    assert!(check("a^2 = a*a").is_ok());
    let fault = check("sqrt(b) = a").unwrap_err().to_string();
    assert!(
        fault.ends_with("as numbers they differ by the factor 10"),
        "{fault}"
    );
    // Huge exponents are neither written out nor multiplied.
    let none = Definitions::default();
    let huge = area
        .of(&none, &parse("a^(1e300)").unwrap())
        .unwrap()
        .unwrap();
    assert!(huge.to_string().starts_with("(a number)"));
}

/// A random expression of lengths x and y, a time t and numbers.
fn random(next: &mut impl FnMut(u64) -> u64, depth: u32) -> String {
    let leaf = |k: u64| ["x", "y", "t", "2", "3/2", "x*y", "x/t"][k as usize].to_string();
    if depth == 0 {
        return leaf(next(7));
    }
    match next(7) {
        0 => format!(
            "({} + {})",
            random(next, depth - 1),
            random(next, depth - 1)
        ),
        1 => format!(
            "({} - 3*{})",
            random(next, depth - 1),
            random(next, depth - 1)
        ),
        2 => format!("({}*{})", random(next, depth - 1), random(next, depth - 1)),
        3 => format!(
            "({}/({}))",
            random(next, depth - 1),
            random(next, depth - 1)
        ),
        4 => format!("({}^{})", random(next, depth - 1), [2, 3][next(2) as usize]),
        5 => format!("sqrt({}^2)", random(next, depth - 1)),
        _ => format!(
            "exp(({0})/({0} + {1}))",
            random(next, depth - 1),
            leaf(next(7))
        ),
    }
}

/// The witness is a change of units: where metres become 4 and seconds 9 times as many, the value
/// of an expression in m^p s^q becomes 4^p 9^q times as large. Most expressions that are refused
/// change by no such factors.
#[test]
fn units_are_those_by_which_values_change() {
    use super::super::{Point, enclose};
    let mut state = 20261129u64;
    let mut next = |n: u64| {
        state = state
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (state >> 33) % n
    };
    let none = Definitions::default();
    let value = |e: &Expr, [m, s]: [u32; 2]| {
        let numbers = [("x", 7 * m, 5), ("y", 2 * m, 3), ("t", 11 * s, 13)];
        let named = numbers.map(|(name, a, b)| (name.to_string(), Rational::from((a, b))));
        let point = Point {
            named: named.into_iter().collect(),
            sample: None,
        };
        enclose(&none, e, &point)
            .ok()
            .map(|z| z.re.to_f64())
            .filter(|x| x.is_normal())
    };
    let (mut right, mut refused) = (0, 0);
    for _ in 0..4000 {
        let text = random(&mut next, 3);
        let e = parse(&text).unwrap();
        let (Some(one), Some(metres), Some(seconds)) =
            (value(&e, [1, 1]), value(&e, [4, 1]), value(&e, [1, 9]))
        else {
            continue;
        };
        let Some(both) = value(&e, [4, 9]) else {
            continue;
        };
        match mechanics().of(&none, &e) {
            Ok(Some(unit)) => {
                let power = |of: usize| unit.0.get(&Factor::Base(of)).map_or(0.0, Rational::to_f64);
                let due = one * 4f64.powf(power(0)) * 9f64.powf(power(2));
                assert!(
                    (both / due - 1.0).abs() < 1e-9,
                    "{text}: {both} instead of {due}"
                );
                right += 1;
            }
            Ok(None) => {}
            Err(_) => {
                // The logarithms of the factors would be whole multiples of those of 4 and 9, or of
                // their roots.
                let is_power = |x: f64, base: f64| {
                    let p = 2.0 * x.abs().ln() / f64::ln(base);
                    (p - p.round()).abs() < 1e-9
                };
                let homogeneous = is_power(metres / one, 4.0) && is_power(seconds / one, 9.0);
                refused += usize::from(!homogeneous);
            }
        }
    }
    assert!(right > 500 && refused > 500, "{right} {refused}");
}
