//! Radii of the elementary operations: they hold every result of points in the arguments, and the largest that is met
//! uses a stated share of them. A radius smaller by that factor would be wrong.

use super::ball::{Ball, dot};
use super::complex::ComplexBall;
use super::mag::Mag;
use rug::Float;

const P: u32 = 80;
const HIGH: u32 = 400;

/// A ball with a radius that is a part of its midpoint.
fn ball(mid: f64, rad: f64) -> Ball {
    Ball::new(Float::with_val(P, mid), Mag::from_f64(rad))
}

/// The ends and the midpoint of a ball, exactly.
fn points(b: &Ball) -> [Float; 3] {
    let r = b.rad().to_float();
    [-1, 0, 1].map(|k| Float::with_val(HIGH, &r * k) + b.mid())
}

/// The share of the radius at which the point lies; more than one is outside.
fn share(b: &Ball, x: &Float) -> f64 {
    let way = Float::with_val(HIGH, x - b.mid()).abs();
    (way / b.rad().to_float()).to_f64()
}

/// That all results lie inside, and the farthest uses at least `needed` of the radius.
fn both_ways(what: &str, b: &Ball, results: impl IntoIterator<Item = Float>, needed: f64) {
    let shares = results.into_iter().map(|x| share(b, &x));
    let most = shares.fold(0.0, f64::max);
    assert!(most <= 1.0, "{what}: {most} of the radius");
    assert!(most >= needed, "{what}: only {most} of the radius is used");
}

type OfBall = fn(&Ball) -> Ball;
type Real = fn(&Float) -> Float;

#[test]
fn functions_of_one_ball() {
    let functions: [(&str, OfBall, Real, f64); 7] = [
        ("sqrt", |b| b.sqrt(), |x| x.clone().sqrt(), 0.4),
        ("square", |b| b.square(), |x| x.clone().square(), 0.9),
        ("exp", |b| b.exp(), |x| x.clone().exp(), 0.5),
        ("ln", |b| b.ln(), |x| x.clone().ln(), 0.5),
        ("recip", |b| b.recip(), |x| x.clone().recip(), 0.9),
        ("sin", |b| b.sin_cos().0, |x| x.clone().sin(), 0.01),
        ("cos", |b| b.sin_cos().1, |x| x.clone().cos(), 0.01),
    ];
    for (name, enclosed, exact, needed) in functions {
        for mid in [0.3, 1.0, 2.5, 40.0] {
            // From nearly the whole positive ball down to the rounding.
            for part in [0.9, 0.3, 1e-3, 1e-12] {
                let b = ball(mid, mid * part);
                let results = points(&b).map(|x| exact(&x));
                // Where e^x is spread over decades its bound is, too.
                let needed = match name {
                    "exp" if mid * part > 0.5 => needed * 0.9,
                    "ln" if part > 0.5 => 0.2,
                    "sin" | "cos" if mid * part > 0.5 => 0.0,
                    _ => needed,
                };
                both_ways(
                    &format!("{name} {mid} ± {part}"),
                    &enclosed(&b),
                    results,
                    needed,
                );
            }
        }
    }
}

#[test]
fn operations_of_two_balls() {
    type OfBalls = fn(&Ball, &Ball) -> Ball;
    type Pair = fn(&Float, &Float) -> Float;
    let operations: [(&str, OfBalls, Pair, f64); 5] = [
        ("+", |a, b| a + b, |x, y| Float::with_val(HIGH, x + y), 0.99),
        ("-", |a, b| a - b, |x, y| Float::with_val(HIGH, x - y), 0.99),
        ("*", |a, b| a * b, |x, y| Float::with_val(HIGH, x * y), 0.99),
        ("/", |a, b| a / b, |x, y| Float::with_val(HIGH, x / y), 0.9),
        (
            "dot",
            |a, b| dot(P, [(a, b)]),
            |x, y| Float::with_val(HIGH, x * y),
            0.99,
        ),
    ];
    for (name, enclosed, exact, needed) in operations {
        for (m, n) in [(1.5, 2.25), (-3.0, 0.125), (1e10, -7.0)] {
            for (p, q) in [(0.5, 0.25), (1e-9, 1e-3), (0.3, 0.0), (0.0, 0.8)] {
                let (a, b) = (ball(m, f64::abs(m) * p), ball(n, f64::abs(n) * q));
                let all = points(&a);
                let results = all.iter().flat_map(|x| points(&b).map(|y| exact(x, &y)));
                let results: Vec<Float> = results.collect();
                both_ways(
                    &format!("{m} ± {p} {name} {n} ± {q}"),
                    &enclosed(&a, &b),
                    results,
                    needed,
                );
            }
        }
    }
}

/// A box of nearly the distance from the origin: its corner turns by more than ρ/|z|.
#[test]
fn the_angle_of_a_wide_box() {
    for (x, y, rx, ry) in [
        (1.0, 0.0, 0.6, 0.79),
        (0.0, 1.0, 0.79, 0.6),
        (-1.0, 0.0, 0.6, 0.79),
        (3.0, 0.0, 0.001, 0.002),
        (2.0, 2.0, 0.5, 0.25),
    ] {
        let (bx, by) = (ball(x, rx), ball(y, ry));
        let angle = by.atan2(&bx);
        let turn = Float::with_val(HIGH, rug::float::Constant::Pi) * 2;
        let near = |a: Float| {
            let turns: Float = Float::with_val(HIGH, angle.mid() - &a) / &turn;
            a + turns.round() * &turn
        };
        let all = points(&bx);
        let results: Vec<Float> = all
            .iter()
            .flat_map(|x| points(&by).map(|y| near(y.atan2(x))))
            .collect();
        both_ways(&format!("atan2 {x} {y}"), &angle, results, 0.35);
    }
}

#[test]
fn bounds_of_complex_balls() {
    let z = ComplexBall::new(ball(3.0, 0.5), ball(-4.0, 0.25));
    let all = points(&z.re);
    let corners: Vec<Float> = all
        .iter()
        .flat_map(|x| points(&z.im).map(|y| Float::with_val(HIGH, x.hypot_ref(&y))))
        .collect();
    let (high, low) = (z.magnitude().to_float(), z.mignitude().to_float());
    let most = corners.iter().fold(Float::new(HIGH), |m, x| m.max(x));
    let least = corners
        .iter()
        .fold(Float::with_val(HIGH, 99), |m, x| m.min(x));
    assert!(high >= most && Float::with_val(64, &high * 0.999) < most);
    assert!(low <= least && Float::with_val(64, &low * 1.3) > least);
    let radius = z.radius().to_float();
    let half_diagonal = 0.5f64.hypot(0.25);
    assert!(radius >= half_diagonal && radius <= half_diagonal * 1.001);
}

/// Every operation of upper bounds is above the exact result and below the next but one double; the difference
/// is below it.
#[test]
fn magnitudes_are_rounded_up() {
    let values = [
        1.0,
        1.0f64.next_up(),
        1.5,
        2.0f64.next_down(),
        1.0 / 3.0,
        1e-30,
        7e40,
    ];
    let exact = |m: Mag| m.to_float().to_rational().unwrap();
    let tight = |m: Mag, due: &rug::Rational, what: &str| {
        let m = exact(m);
        assert!(m >= *due, "{what}");
        assert!(m <= due.clone() * (1.0 + 1e-15).to_rational(), "{what}");
    };
    for a in values {
        for b in values {
            let (x, y) = (Mag::from_f64(a), Mag::from_f64(b));
            let (p, q) = (a.to_rational(), b.to_rational());
            tight(x.add(y), &rug::Rational::from(&p + &q), "sum");
            tight(x.mul(y), &rug::Rational::from(&p * &q), "product");
            tight(x.div(y), &rug::Rational::from(&p / &q), "quotient");
            let root = exact(x.sqrt());
            assert!(
                root.clone().square() >= p && root <= x.sqrt().to_float().to_f64() * (1.0 + 1e-15)
            );
            let difference = rug::Rational::from(&p - &q);
            let below = exact(x.sub_below(y));
            assert!(below <= difference.clone().max(rug::Rational::new()));
            if difference > 0 && b / a < 0.9 {
                assert!(below >= difference * (1.0 - 1e-14).to_rational());
            }
            let larger = if a > b { a } else { b };
            assert_eq!(exact(x.max(y)), larger.to_rational());
        }
    }
}

trait Exactly {
    fn to_rational(&self) -> rug::Rational;
}

impl Exactly for f64 {
    fn to_rational(&self) -> rug::Rational {
        rug::Rational::from_f64(*self).expect("finite")
    }
}
