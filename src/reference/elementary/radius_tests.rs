//! Radii of functions of balls: they hold the values at points of the operands, and the value that
//! is farthest from the midpoint uses a stated share of them. A radius smaller by that factor would
//! be wrong.

use super::tests::One;
use super::*;
use crate::{Ball, Mag};
use rug::Float;

/// Bits of a result, and of the values at points.
const P: u32 = 200;
const HIGH: u32 = 500;

fn ball(mid: f64, rad: f64) -> Ball {
    Ball::new(Float::with_val(P, mid), Mag::from_f64(rad))
}

/// Exact points of a ball: its ends, its midpoint and some between them.
fn points(b: &Ball) -> Vec<Ball> {
    let r = b.rad().to_float();
    let at = |t: f64| Float::with_val(HIGH, &r * Float::with_val(53, t)) + b.mid();
    [-1.0, -0.75, -0.3, 0.0, 0.4, 0.8, 1.0]
        .map(|t| Ball::new(at(t), Mag::ZERO))
        .to_vec()
}

/// The share of the radius at which the value lies; more than one is outside.
fn share(b: &Ball, value: &Ball) -> f64 {
    let off = Ball::new(Float::with_val(HIGH, value.mid() - b.mid()), Mag::ZERO);
    off.magnitude().div(b.rad()).to_f64()
}

/// That all values lie inside, and the farthest uses at least `needed` of the radius.
fn both_ways(what: &str, found: &Ball, values: impl Iterator<Item = Ball>, needed: f64) {
    let most = values.map(|v| share(found, &v)).fold(0.0, f64::max);
    assert!(most <= 1.0 + 1e-12, "{what}: {most} of the radius");
    assert!(most >= needed, "{what}: only {most} of the radius is used");
}

/// Functions, places inside their domains, and the share that is used of the radius of a narrow
/// ball.
const PLACES: &[(&str, One, &[f64], f64)] = &[
    ("sqrt", sqrt, &[0.3, 2.0, 40.0], 0.49),
    ("cbrt", cbrt, &[0.3, -2.0, 40.0], 0.98),
    ("exp", exp, &[0.3, -20.0, 40.0], 0.98),
    ("exp2", exp2, &[0.3, -20.0, 40.0], 0.98),
    ("exp10", exp10, &[0.3, -20.0, 40.0], 0.98),
    ("expm1", expm1, &[0.3, -20.0, 40.0], 0.9),
    ("log", log, &[0.3, 1.0, 40.0], 0.98),
    ("log2", log2, &[0.3, 1.0, 40.0], 0.98),
    ("log10", log10, &[0.3, 1.0, 40.0], 0.98),
    ("log1p", log1p, &[-0.9, 0.1, 40.0], 0.98),
    (
        "sin",
        sin,
        &[0.3, std::f64::consts::FRAC_PI_2, 3.1, -40.0],
        0.45,
    ),
    (
        "cos",
        cos,
        &[0.3, std::f64::consts::FRAC_PI_2, 3.1, -40.0],
        0.45,
    ),
    ("tan", tan, &[0.3, 1.5, 3.1, -40.0], 0.9),
    ("sinpi", sinpi, &[0.3, 0.5, 1.0, -7.25], 0.45),
    ("cospi", cospi, &[0.3, 0.5, 1.0, -7.25], 0.45),
    ("tanpi", tanpi, &[0.3, 0.49, 1.0, -7.25], 0.9),
    ("asin", asin, &[0.3, -0.99, 0.9999], 0.98),
    ("acos", acos, &[0.3, -0.99, 0.9999], 0.98),
    ("atan", atan, &[0.3, -1.0, 40.0], 0.95),
    ("sinh", sinh, &[0.3, -2.0, 40.0], 0.7),
    ("cosh", cosh, &[0.3, -2.0, 40.0], 0.8),
    ("tanh", tanh, &[0.3, -2.0, 40.0], 0.6),
    ("asinh", asinh, &[0.3, -1.0, 40.0], 0.95),
    ("acosh", acosh, &[1.001, 2.0, 40.0], 0.98),
    ("atanh", atanh, &[0.3, -0.99, 0.9999], 0.98),
    ("erf", erf, &[0.3, -2.0, 6.0], 0.9),
    ("erfc", erfc, &[0.3, -2.0, 20.0], 0.9),
    ("erfcx", erfcx, &[0.3, -2.0, 20.0], 0.6),
    ("erfi", erfi, &[0.3, -2.0, 20.0], 0.9),
    ("dawson", dawson, &[0.3, -2.0, 7.0, 20.0], 0.2),
    (
        "tgamma",
        tgamma,
        &[0.3, 1.4616321, 5.5, 40.0, -0.4, -7.75],
        0.4,
    ),
    (
        "lgamma",
        lgamma,
        &[0.3, 1.4616321, 5.5, 40.0, -0.4, -7.75],
        0.4,
    ),
    (
        "digamma",
        digamma,
        &[0.3, 1.4616321, 5.5, 40.0, -0.4, -7.75],
        0.35,
    ),
    ("recip", recip, &[0.3, -2.0, 40.0], 0.98),
    ("sqr", sqr, &[0.3, -2.0, 40.0], 0.98),
];

#[test]
fn functions_of_one_ball() {
    for (name, f, places, needed) in PLACES {
        for &mid in *places {
            // A narrow ball, and one that is nearly too wide for the bound on the derivative.
            for part in [1e-20, 1e-9, 4e-6] {
                let x = ball(mid, part);
                let found = f(&x, P).unwrap();
                let values = points(&x).into_iter().map(|x| f(&x, HIGH).unwrap());
                both_ways(&format!("{name} {mid} ± {part}"), &found, values, *needed);
            }
        }
    }
}

#[test]
fn wide_balls_hold_all_values() {
    for (name, f, places, _) in PLACES {
        for &mid in *places {
            for part in [1e-3, 0.01, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0] {
                let x = ball(mid, part);
                let Ok(found) = f(&x, P) else {
                    continue;
                };
                let values = points(&x).into_iter().filter_map(|x| f(&x, HIGH).ok());
                // The ends of a monotone function are the ends of the ball.
                let values: Vec<Ball> = values.collect();
                both_ways(
                    &format!("{name} {mid} ± {part}"),
                    &found,
                    values.into_iter(),
                    0.02,
                );
            }
        }
    }
    // Extremes in the middle of the operand.
    for (f, mid, rad, due) in [
        (sin as One, 1.5, 0.5, 1.0),
        (cos, 3.0, 0.5, -1.0),
        (cospi, 1.25, 0.3, -1.0),
        (sinpi, 0.4, 0.3, 1.0),
        (dawson, 1.0, 0.5, 0.541_044_224),
        (dawson, -1.0, 0.5, -0.541_044_224),
        (tgamma, 1.5, 0.25, 0.885_603_195),
        (lgamma, 1.5, 0.25, -0.121_486_290),
        (cosh, 0.25, 0.5, 1.0),
        (sqr, 0.25, 0.5, 0.0),
        (fabs, 0.25, 0.5, 0.0),
    ] {
        let found = f(&ball(mid, rad), P).unwrap();
        let at = Ball::exact(P, due);
        assert!(found.contains_ball(&at), "{mid} ± {rad}: {found:?}");
    }
}

#[test]
fn functions_of_two_balls() {
    let places: [(&str, tests::Two, f64, f64, f64); 14] = [
        ("add", add, 0.3, -2.0, 0.99),
        ("sub", sub, 0.3, -2.0, 0.99),
        ("mul", mul, 0.3, -2.0, 0.99),
        ("div", div, 0.3, -2.0, 0.98),
        ("div", div, 7.0, 0.02, 0.9),
        ("hypot", hypot, 0.3, -2.0, 0.6),
        ("hypot", hypot, 3.0, 2.0, 0.7),
        ("pow", pow, 0.3, -2.0, 0.9),
        ("pow", pow, 7.0, 0.5, 0.9),
        ("atan2", atan2, 0.3, -2.0, 0.6),
        ("atan2", atan2, -3.0, 2.0, 0.6),
        ("fdim", fdim, 3.0, 2.0, 0.99),
        ("fmod", fmod, 100.5, 3.0, 0.9),
        ("remainder", remainder, 100.5, -3.0, 0.9),
    ];
    for (name, f, a, b, needed) in places {
        for (r, s) in [(1e-9, 1e-9), (0.0, 1e-6), (1e-6, 0.0), (1e-5, 2e-6)] {
            let (x, y) = (ball(a, r), ball(b, s));
            let found = f(&x, &y, P).unwrap();
            let ends = |x: &Ball| points(x);
            let values = ends(&x)
                .into_iter()
                .flat_map(|x| ends(&y).into_iter().map(move |y| f(&x, &y, HIGH).unwrap()));
            let name = format!("{name} {a} ± {r}, {b} ± {s}");
            both_ways(&name, &found, values, needed);
        }
        // Wide boxes hold what is in them.
        for (r, s) in [(0.1, 0.0), (0.0, 0.1), (0.2, 0.3), (5.0, 3.0)] {
            let (x, y) = (ball(a, r), ball(b, s));
            let Ok(found) = f(&x, &y, P) else {
                continue;
            };
            for x in points(&x) {
                for value in points(&y).into_iter().filter_map(|y| f(&x, &y, HIGH).ok()) {
                    assert!(
                        share(&found, &value) <= 1.0 + 1e-12,
                        "{name} {a} ± {r}, {b} ± {s}"
                    );
                }
            }
        }
    }
}

#[test]
fn voigt_profiles() {
    // Beside the centre and in the wings, of widths that are like and unlike.
    for (a, s, g) in [
        (0.5, 1.0, 1.0),
        (3.0, 0.1, 2.0),
        (0.5, 2.0, 0.01),
        (60.0, 1.0, 0.5),
        (4.0, 1.0, 1e-4),
    ] {
        for radii in [
            [1e-9, 0.0, 0.0],
            [0.0, 1e-9, 0.0],
            [0.0, 0.0, 1e-9],
            [1e-7, 1e-7, 1e-7],
        ] {
            let [x, sigma, gamma] = [ball(a, radii[0]), ball(s, radii[1]), ball(g, radii[2])];
            let found = voigt(&x, &sigma, &gamma, P).unwrap();
            let mut values = Vec::new();
            for x in [0, 6].map(|k| points(&x)[k].clone()) {
                for sigma in [0, 6].map(|k| points(&sigma)[k].clone()) {
                    for gamma in [0, 6].map(|k| points(&gamma)[k].clone()) {
                        values.push(voigt(&x, &sigma, &gamma, HIGH).unwrap());
                    }
                }
            }
            both_ways(
                &format!("voigt {a} {s} {g} {radii:?}"),
                &found,
                values.into_iter(),
                0.05,
            );
        }
    }
}
