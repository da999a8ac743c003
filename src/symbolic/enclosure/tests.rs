//! Bounds of integrals from both sides, points, and what is remembered.

use super::*;
use crate::parse;

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

/// The tail is `4 M/(3 (N + 1) 4^N)`, M the bound found for `e^{cs}` on the square `|Re s|, |Im s| ≤ 4`.
#[test]
fn the_tail_is_cauchys() {
    let n = Jets::ORDER as i32;
    for c in [3, 5, 6] {
        let found = value(&format!("int(s, 0, 1, exp({c}*s))")).unwrap();
        let square = Ball::integer(BITS, 0).widened(Mag::from_f64(f64::from(4 * c)));
        let square = ComplexBall::new(square.clone(), square);
        let largest = square.exp().magnitude().to_f64();
        let tail = largest * 4.0 / (3.0 * f64::from(n + 1)) * 4f64.powi(-n);
        let ratio = found.im.rad().to_f64() / tail;
        assert!((1.0..1.01).contains(&ratio), "{c}: {ratio}");
        let ratio = found.re.rad().to_f64() / tail;
        assert!((1.0..1.01).contains(&ratio), "{c}: {ratio}");
        let due = value(&format!("(exp({c}) - 1)/{c}")).unwrap();
        assert!(found.re.overlaps(&due.re));
    }
}

/// In pieces where one is too coarse, from the lower limit on, until both parts are narrow.
#[test]
fn pieces_add_up() {
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

#[test]
fn arc_tangents_of_what_is_certainly_complex_are_refused() {
    assert!(value("arctan(1 + i/4)").is_err());
    assert!(value("arctan(1 - i/4)").is_err());
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

/// Checks that definitions and integrals are kept if they do not depend on a changing name, and only then.
#[test]
fn caches_keep_what_does_not_change() {
    let lines = ["fixed = 3*x", "changing = k + x", "through = 2*changing"];
    let definitions = Definitions::read(&lines).unwrap();
    let cache = Cache::new(&["k"]);
    let value = |x: i32, text: &str| {
        let point = at(x);
        let found =
            Enclosures::remembering(&point, &cache).value(&definitions, &parse(text).unwrap());
        found.unwrap()
    };
    let k = Point::sample(0).value("k").unwrap();
    let near = |z: ComplexBall, due: Rational| {
        assert!(z.re.contains(&due), "{z:?} {due}");
    };
    near(value(2, "fixed + 1"), 7.into());
    near(value(2, "changing"), k.clone() + 2);
    near(value(2, "through"), (k.clone() + 2) * 2);
    near(value(2, "int(s, 0, 1, x*s)"), 1.into());
    near(value(2, "int(s, 0, 1, k*x*s)"), k.clone());
    // At another point, where a cache of the first is out of place: the kept values stand out.
    near(value(4, "fixed + 1"), 7.into());
    near(value(4, "int(s, 0, 1, x*s)"), 1.into());
    near(value(4, "changing"), k.clone() + 4);
    near(value(4, "through"), (k.clone() + 4) * 2);
    near(value(4, "int(s, 0, 1, k*x*s)"), k * 2);
    // Inside a sum nothing is kept or used.
    near(value(4, "sum(j, 1, 2, fixed*j)"), 36.into());
}

/// The arc tangent of a ball that may be complex holds those of its points; where it might meet a branch cut it is
/// refused.
#[test]
fn arc_tangents_beside_the_real_axis() {
    let point = Point::default();
    let mut enclosures = Enclosures::new(&point);
    let ball = |x: f64, off: f64| {
        let im = Ball::integer(BITS, 0).widened(Mag::from_f64(off));
        ComplexBall::new(Ball::exact(BITS, x), im)
    };
    let mut arctan = |x: f64, off: f64| enclosures.call(Func::Arctan, &[ball(x, off)]);
    for x in [-3.0, -1.0, 0.0, 0.25, 1.0, 40.0f64] {
        for off in [1e-20, 1e-3, 0.25, 0.5] {
            let found = arctan(x, off).unwrap();
            for y in [-off, -0.5 * off, 0.0, off] {
                // Re and Im of atan(x + iy).
                let re = 0.5 * (2.0 * x).atan2((1.0 - x * x) - y * y);
                let im =
                    0.25 * ((x * x + (1.0 + y) * (1.0 + y)) / (x * x + (1.0 - y) * (1.0 - y))).ln();
                let holds = |b: &Ball, v: f64| {
                    b.widened(Mag::from_f64(4e-16))
                        .contains(&Rational::from_f64(v).unwrap())
                };
                assert!(
                    holds(&found.re, re) && holds(&found.im, im),
                    "{x} {y}: {found:?}"
                );
            }
            // Four times what it may be off.
            assert!(
                found.im.rad().to_f64() <= 4.0 * off * (1.0 + 1e-15),
                "{x} {off}"
            );
        }
        assert!(arctan(x, 0.5f64.next_up()).is_err() && arctan(x, 0.75).is_err());
    }
    let off_axis = ComplexBall::new(Ball::integer(BITS, 1), Ball::exact(BITS, 0.125));
    assert!(enclosures.call(Func::Arctan, &[off_axis]).is_err());
    // Exactly real: no imaginary part at all.
    let real = enclosures.call(Func::Arctan, &[ball(2.0, 0.0)]).unwrap();
    assert!(real.im.is_zero());
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
