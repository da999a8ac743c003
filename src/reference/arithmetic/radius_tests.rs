//! Radii of the elementary operations: they hold every result of points in the arguments, and the
//! largest that is met uses a stated share of them. A radius smaller by that factor would be wrong.

use super::ball::{Ball, dot};
use super::complex::ComplexBall;
use super::mag::Mag;
use crate::draw::Draw;
use rug::{Float, Rational};

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

/// Balls inside of balls and beside them, by exact ends.
#[test]
fn balls_hold_and_meet_by_their_ends() {
    let b = |mid: f64, rad: f64| ball(mid, rad);
    for (x, y, holds, meets) in [
        (b(1.0, 0.5), b(1.25, 0.25), true, true),
        (b(1.0, 0.5), b(1.25, 0.25f64.next_up()), false, true),
        (b(1.0, 0.5), b(0.5, 0.0), true, true),
        (b(1.0, 0.5), b(0.5f64.next_down(), 0.0), false, false),
        (b(1.0, 0.5), b(2.0, 0.5), false, true),
        (b(1.0, 0.5), b(2.0f64.next_up(), 0.5), false, false),
        (b(-1.0, 0.5), b(1.0, 0.5), false, false),
        (b(-1.0, 0.5), b(-1.0, 0.5), true, true),
        (b(1.0, 0.25), b(1.0, 0.5), false, true),
    ] {
        assert_eq!(x.contains_ball(&y), holds, "{x:?} {y:?}");
        assert_eq!(
            (x.overlaps(&y), y.overlaps(&x)),
            (meets, meets),
            "{x:?} {y:?}"
        );
        let (zero, one) = (Ball::integer(P, 0), Ball::integer(P, 1));
        let pair = |re: &Ball, im: &Ball| ComplexBall::new(re.clone(), im.clone());
        assert_eq!(pair(&x, &zero).overlaps(&pair(&y, &zero)), meets);
        assert_eq!(pair(&zero, &x).overlaps(&pair(&zero, &y)), meets);
        assert!(!pair(&x, &zero).overlaps(&pair(&y, &one)));
    }
    // The whole line holds all and meets all, and nothing less holds it.
    let line = Ball::new(Float::with_val(P, 5), Mag::INFINITY);
    let some = b(1.0, 0.5);
    assert!(line.contains_ball(&some) && line.contains_ball(&line) && !some.contains_ball(&line));
    assert!(line.overlaps(&some) && some.overlaps(&line) && line.overlaps(&line));
    assert!(line.contains_zero() && line.mignitude().is_zero() && !line.is_positive());
    let plane = ComplexBall::new(some.clone(), line.clone());
    assert!(!plane.is_finite() && ComplexBall::new(some.clone(), some).is_finite());
    assert!(!ComplexBall::new(line.clone(), b(1.0, 0.0)).is_finite());
}

/// An interval's ball and the union of two hold all ends, exactly, and are no wider than a rounding
/// asks for.
#[test]
fn intervals_are_held_by_their_balls() {
    let third = Float::with_val(200, 1) / 3u32;
    let ends = [
        (Float::with_val(200, -1.0), third.clone()),
        (third.clone(), Float::with_val(200, &third + 1e-40f64)),
        (Float::with_val(53, 1.0), Float::with_val(200, &third + 1)),
        (
            Float::with_val(24, 1e-300),
            Float::with_val(300, &third * 3u32),
        ),
        (Float::with_val(64, -1e30), Float::with_val(64, 1e-30)),
    ];
    for (lo, hi) in &ends {
        let width = Float::with_val(900, hi - lo);
        for prec in [24, 64, 250] {
            let b = Ball::between(prec, lo, hi);
            let q = |x: &Float| x.to_rational().unwrap();
            assert!(b.contains(&q(lo)) && b.contains(&q(hi)), "{prec} {lo} {hi}");
            // Half the width, and the rounding of a midpoint.
            let rounding = Float::with_val(900, b.mid().clone().abs()) >> (prec as i32 - 1);
            assert!(b.rad().to_float() <= (width.clone() / 2u32 + rounding) * 1.000001f64);
        }
        let (x, y) = (ball(1.5, 0.25), Ball::between(90, lo, hi));
        for u in [x.union(&y), y.union(&x), y.union(&y)] {
            assert!(u.contains_ball(&y), "{lo} {hi}");
        }
        assert!(x.union(&y).contains_ball(&x) && y.union(&x).contains_ball(&x));
    }
    // No fewer bits than the better of the two has.
    let fine = Ball::rational(200, &rug::Rational::from((1, 3)));
    assert_eq!(fine.union(&ball(0.5, 0.0)).prec(), 200);
    assert_eq!(ball(0.5, 0.0).union(&fine).prec(), 200);
    for both in [
        &fine + &ball(1.0, 0.0),
        &ball(1.0, 0.0) * &fine,
        &ball(1.0, 0.0) - &fine,
        &ball(1.0, 0.0) / &fine,
    ] {
        assert_eq!(both.prec(), 200);
    }
}

/// Checks that an argument outside of a function's domain bounds nothing.
#[test]
fn outside_of_the_domain_is_the_whole_line() {
    let open = |b: Ball| assert!(!b.is_finite(), "{b:?}");
    let line = Ball::new(Float::with_val(P, 1), Mag::INFINITY);
    open(ball(-1.0, 0.0).sqrt());
    open(ball(1.0, 1.5).sqrt());
    open(ball(0.0, 0.5).sqrt());
    assert!(ball(0.0, 0.0).sqrt().is_zero() && ball(1.0, 1.0).sqrt().is_finite());
    open(ball(1.0, 1.0).ln());
    open(ball(-1.0, 0.0).ln());
    open(ball(1.0, 1.0).recip());
    open(&ball(1.0, 0.0) / &ball(0.5, 0.5));
    open(&ball(1.0, 0.0) / &ball(0.0, 0.0));
    open(ball(0.0, 0.0).atan2(&ball(0.0, 0.0)));
    open(ball(1.0, 2.0).atan2(&ball(1.0, 2.0)));
    assert!(ball(0.0, 0.0).atan2(&ball(1.0, 0.0)).is_finite());
    assert!(ball(1.0, 0.0).atan2(&ball(0.0, 0.0)).is_finite());
    for whole in [
        line.exp(),
        line.ln(),
        line.sqrt(),
        line.square(),
        line.recip(),
        &line + &line,
        &line * &ball(2.0, 0.0),
    ] {
        open(whole);
    }
    // But sine and cosine.
    let sine = line.sin_cos().0.rad().to_f64();
    assert!((2.0..2.001).contains(&sine), "{sine}");
    for x in [f64::NAN, f64::INFINITY] {
        open(Ball::exact(P, x));
    }
}

/// Bits of accuracy are no more than there are, and at most two fewer.
#[test]
fn bits_of_accuracy() {
    for (mid, rad) in [
        (1.0, 0.25),
        (1.99, 0.3),
        (1.0, 0.49),
        (1e10, 1e-7),
        (-3.0, 1.99),
        (1.5, 0.75),
    ] {
        let due = (f64::abs(mid) / rad).log2();
        let bits = ball(mid, rad).accuracy_bits() as f64;
        assert!(
            bits <= due && bits > due - 2.0 - 1e-12,
            "{mid} {rad}: {bits} of {due}"
        );
    }
    assert_eq!(ball(1.0, 0.0).accuracy_bits(), i64::MAX);
    assert_eq!(ball(0.0, 0.0).accuracy_bits(), i64::MAX);
    assert_eq!(ball(0.0, 1.0).accuracy_bits(), i64::MIN);
    assert_eq!(
        Ball::new(Float::with_val(P, 1), Mag::INFINITY).accuracy_bits(),
        i64::MIN
    );
}

/// Where second order is below a radius's last bit, the ends of the arguments use all of it: a
/// bound on a midpoint rounded the wrong way would lose them. The midpoints are just below or above
/// what 53 bits hold.
#[test]
fn radii_are_rounded_the_right_way() {
    const WIDE: u32 = 200;
    let mut draw = Draw(1);
    let mut unit = || mantissa(&mut draw) - 1.0;
    // Just above or just below a number of 53 bits.
    let just = |base: f64, low: bool| {
        let step = (-52f64).exp2();
        let x = if low {
            (-90f64).exp2()
        } else {
            step - (-90f64).exp2()
        };
        Float::with_val(WIDE, x) + base
    };
    let holds = |what: &str, b: &Ball, x: &Float| {
        let way = Float::with_val(WIDE, x - b.mid()).abs();
        assert!(way <= b.rad().to_float(), "{what}: {way} {b:?}");
    };
    for _ in 0..20_000 {
        let r = Mag::from_f64((1.0 + unit()) * (-100f64).exp2());
        let end = |x: &Float| Float::with_val(WIDE, r.to_float()) + x;
        let other = Float::with_val(WIDE, 1.0 + unit());
        for low in [false, true] {
            let m = just(1.0 + 0.3 * unit(), low);
            let b = Ball::new(m.clone(), r);
            let exact = |x: &Float| Ball::new(x.clone(), Mag::ZERO);
            holds("square", &b.square(), &end(&m).square());
            // Either factor, dividend or divisor.
            let wide = Ball::new(other.clone(), r);
            for (x, y) in [(&m, &other), (&other, &m)] {
                let (from, to) = (exact(x), Ball::new(y.clone(), r));
                holds("product", &(&from * &to), &(end(y) * x));
                holds("product", &(&to * &from), &(end(y) * x));
                let low = Float::with_val(WIDE, y - &r.to_float());
                holds("quotient", &(&from / &to), &Float::with_val(WIDE, x / &low));
                holds("quotient", &(&to / &from), &(end(y) / x));
                // One without a rounding of its own.
                let whole = Float::with_val(WIDE, x * y);
                let due = Float::with_val(WIDE, &whole / &low);
                holds("exact quotient", &(&exact(&whole) / &to), &due);
            }
            holds("sum", &(&b + &wide), &(end(&m) + &end(&other)));
            let grown = Float::with_val(WIDE, end(&m).exp_ref());
            holds("exp", &b.exp(), &grown);
        }
        // e^r − 1, for wide balls.
        let (m, r) = (Float::with_val(WIDE, unit()), 0.5 + unit());
        let far = Float::with_val(WIDE, &m + r).exp();
        holds("wide exp", &Ball::new(m, Mag::from_f64(r)).exp(), &far);
    }
}

/// The root of a ball from zero on: the radius reaches zero, from the rounded root of the midpoint,
/// at any precision.
#[test]
fn roots_of_balls_from_zero_on() {
    for prec in [12, 24, 53, 80] {
        for m in 2..400 {
            let mid = Float::with_val(prec, m);
            let rad = Mag::from_f64(mid.to_f64());
            let root = Ball::new(mid, rad).sqrt();
            assert!(root.contains(&rug::Rational::new()), "{prec} {m}");
            assert!(
                root.contains_ball(&Ball::integer(200, 2 * m).sqrt()),
                "{prec} {m}"
            );
        }
    }
}

/// At six bits the rounding of `e^m` is a good part of the radius.
#[test]
fn exponentials_of_few_bits() {
    for k in -256..=256 {
        for size in 1..14 {
            let mid = Float::with_val(6, f64::from(k) / 64.0);
            let r = (-f64::from(size)).exp2();
            let e = Ball::new(mid.clone(), Mag::from_f64(r)).exp();
            for end in [-r, r] {
                let x = Float::with_val(200, &mid) + end;
                assert!(e.contains(&x.exp().to_rational().unwrap()), "{k} {size}");
            }
        }
    }
}

/// Whole numbers and doubles are kept, however few bits are asked for; the far end of an interval
/// is held however small it is beside the other.
#[test]
fn few_bits_and_far_exponents() {
    for n in [1001, -123_456_789, i64::MAX, i64::MIN + 1] {
        assert!(Ball::integer(8, n).contains(&rug::Rational::from(n)));
        let x = n as f64 / 3.0;
        assert!(Ball::exact(8, x).contains(&rug::Rational::from_f64(x).unwrap()));
    }
    let tiny = Float::with_val(64, 1) >> 400u32;
    let far = Float::with_val(64, 2);
    let q = |x: &Float| x.to_rational().unwrap();
    let up = Ball::between(64, &-far.clone(), &tiny);
    assert!(up.contains(&q(&tiny)) && up.contains(&q(&-far.clone())));
    let down = Ball::between(64, &-tiny.clone(), &far);
    assert!(down.contains(&q(&-tiny)) && down.contains(&q(&far)));
    // |z| ≥ 1, though the other part may be 3.
    let z = ComplexBall::new(ball(1.0, 0.0), ball(0.0, 3.0));
    assert!(z.mignitude() == Mag::from_f64(1.0));
    assert!(ComplexBall::new(ball(0.0, 3.0), ball(1.0, 0.0)).mignitude() == Mag::from_f64(1.0));
}

/// A number in `[1, 2)` of 53 bits.
fn mantissa(draw: &mut Draw) -> f64 {
    f64::from_bits(0x3ff << 52 | draw.next() >> 12)
}

/// Radii of 53 bits are computed with a few roundings upwards: one downwards among them would show
/// in some of that number of radii, though it costs a unit in the last place only. Precisions are
/// so high that midpoints are as good as exact.
#[test]
fn no_unit_of_a_radius_is_rounded_down() {
    let mut draw = Draw(1);
    let mut next = || mantissa(&mut draw);
    let exact = |m: &Mag| m.to_float().to_rational().expect("finite");
    for _ in 0..20_000 {
        // Just above a number of 53 bits, and below the next.
        let beyond = |x: f64, by: i32| {
            Float::with_val(200, x)
                + Float::with_val(200, 1) * by * Float::with_val(53, Float::i_exp(1, -100))
        };
        let (x, r) = (next(), Mag::from_f64(next()).shift(-30));
        let y = beyond(1.0, 1);
        let a = Ball::new(beyond(x, 1), Mag::ZERO);
        let b = Ball::new(y.clone(), r);
        let [x, y, r] = [
            a.mid().to_rational().unwrap(),
            y.to_rational().unwrap(),
            exact(&r),
        ];
        let due = x * &r / (Rational::from(&y - &r) * y);
        assert!(exact(&(&a / &b).rad()) >= due);
        let b = Ball::new(beyond(next(), -1), Mag::from_f64(next()));
        let high = Float::with_val(300, b.mid().exp_ref())
            * Float::with_val(300, b.rad().to_float().exp_m1_ref());
        assert!(b.exp().rad().to_float() >= high);
    }
}
