//! Tests of `cam_law`.

use super::*;
use crate::mag::Mag;

fn r(n: i32, d: i32) -> Rational {
    Rational::from((n, d))
}

#[test]
fn halves_fit_together() {
    for family in [
        Family::Polynomial345,
        Family::Polynomial4567,
        Family::Scca {
            b: r(1, 5),
            d: r(2, 5),
        },
    ] {
        let law = Law::stretched(&family, &r(1, 3));
        let tiny = r(1, 1 << 30);
        let [before, after] = [r(1, 3) - tiny, r(1, 3)].map(|x| law.jet(&x, 128));
        let close = |a: &Ball, b: &Ball| (a - b).magnitude().to_f64() < 1e-5;
        for k in 0..3 {
            assert!(close(&before[k], &after[k]), "{family:?} {k}");
        }
        let end = law.jet(&r(1, 1), 128);
        assert!(end[0].contains(&r(1, 1)) && end[1].contains(&r(0, 1)));
    }
}

/// Holds the number, and to 100 bits.
fn is(found: &Ball, due: &Ball) -> bool {
    let scale = Mag::from_f64(1.0).add(due.magnitude());
    found.overlaps(due)
        && found.rad() < scale.shift(-100)
        && due.rad() < Mag::power_of_two(-100).mul(scale)
}

fn scca(b: (i32, i32), d: (i32, i32), fraction: (i32, i32)) -> Law {
    let (b, d) = (Rational::from(b), Rational::from(d));
    Law::stretched(&Family::Scca { b, d }, &Rational::from(fraction))
}

fn ball(n: i32, d: i32) -> Ball {
    Ball::rational(160, &r(n, d))
}

#[track_caller]
fn same(found: [Ball; 5], due: [Ball; 5]) {
    for (k, (found, due)) in found.iter().zip(&due).enumerate() {
        assert!(is(found, due), "derivative {k}: {found:?} {due:?}");
    }
}

/// `x − sin 2πx/2π` and its derivatives, in each of the four zones and at their joints.
#[test]
fn the_cycloid_in_all_zones() {
    let law = scca((1, 2), (1, 2), (1, 2));
    let turn = Ball::pi(160).shift(1);
    for (n, d) in [
        (0, 1),
        (1, 12),
        (1, 4),
        (1, 3),
        (1, 2),
        (5, 8),
        (3, 4),
        (11, 12),
        (1, 1),
    ] {
        let (sine, cosine) = (&turn * ball(n, d)).sin_cos();
        let due = [
            ball(n, d) - &sine / &turn,
            ball(1, 1) - &cosine,
            &turn * &sine,
            &turn * &turn * &cosine,
            -(&turn * &turn * &turn * &sine),
        ];
        same(law.jet(&r(n, d), 160), due);
    }
}

/// `(1 − cos πx)/2` and its derivatives, at both ends as well: there are no zones but the two of a
/// cosine.
#[test]
fn the_harmonic_law_in_both_zones() {
    let law = scca((0, 1), (1, 1), (1, 2));
    let Form::Zones(zones) = &law.0 else {
        panic!("zones");
    };
    assert_eq!(zones.len(), 2);
    let pi = Ball::pi(160);
    for (n, d) in [(0, 1), (1, 3), (1, 2), (2, 3), (1, 1)] {
        let (sine, cosine) = (&pi * ball(n, d)).sin_cos();
        let square = &pi * &pi;
        let due = [
            (ball(1, 1) - &cosine).shift(-1),
            (&pi * &sine).shift(-1),
            (&square * &cosine).shift(-1),
            -(&square * &pi * &sine).shift(-1),
            -(&square * &square * &cosine).shift(-1),
        ];
        same(law.jet(&r(n, d), 160), due);
    }
}

/// All sine: `s'' = sin πx · π` up to the middle of the stroke and its negative image from there
/// on.
#[test]
fn a_law_of_sines_alone() {
    let law = scca((1, 1), (0, 1), (1, 2));
    let Form::Zones(zones) = &law.0 else {
        panic!("zones");
    };
    assert_eq!(zones.len(), 2);
    let pi = Ball::pi(160);
    // s'' = c sin πx from rest: s' = c (1 − cos πx)/π and s = c (x − sin πx/π)/π; s(1/2) = 1/2.
    let factor = &pi * &pi / (&pi - ball(2, 1));
    let rising = |n, d| -> [Ball; 5] {
        let (sine, cosine) = (&pi * ball(n, d)).sin_cos();
        let scaled = |x: Ball| &factor * x;
        [
            scaled((ball(n, d) - &sine / &pi) / &pi),
            scaled((ball(1, 1) - &cosine) / &pi),
            scaled(sine.clone()),
            scaled(&pi * &cosine),
            scaled(-(&pi * &pi * &sine)),
        ]
    };
    same(law.jet(&r(1, 5), 160), rising(1, 5));
    let [s, v, a, j, k] = rising(1, 5);
    same(law.jet(&r(4, 5), 160), [ball(1, 1) - s, v, -a, j, -k]);
}

/// The modified trapezoid: `a = 8π/(2 + π)`, a sine up to x = 1/8, then constant up to 3/8.
#[test]
fn the_modified_trapezoid_has_its_textbook_values() {
    let law = scca((1, 4), (1, 4), (1, 2));
    let pi = Ball::pi(160);
    let a = pi.shift(3) / (ball(2, 1) + &pi);
    let four = pi.shift(2);
    let zero = ball(0, 1);
    // At the joint, from the right: v = a/4π and s = v (1/8 − 1/4π).
    let speed = &a / &four;
    let place = &speed * (ball(1, 8) - four.recip());
    same(
        law.jet(&r(1, 8), 160),
        [
            place.clone(),
            speed.clone(),
            a.clone(),
            zero.clone(),
            zero.clone(),
        ],
    );
    let u = ball(1, 8);
    let due = [
        place + &speed * &u + (&a * &u * &u).shift(-1),
        speed + &a * &u,
        a.clone(),
        zero.clone(),
        zero,
    ];
    same(law.jet(&r(1, 4), 160), due.clone());
    let [s, v, a, _, _] = due;
    let zero = ball(0, 1);
    same(
        law.jet(&r(3, 4), 160),
        [ball(1, 1) - s, v, -a, zero.clone(), zero],
    );
}

/// Two parabolas: at the joint the acceleration is that to the right.
#[test]
fn at_a_joint_the_derivatives_are_those_to_the_right() {
    let law = scca((0, 1), (0, 1), (1, 4));
    let jet = |n, d| law.jet(&r(n, d), 160);
    // x²/λ, 2x/λ, 2/λ; then 1 − (1 − x)²/μ.
    let three = |s, v, a| [s, v, a, ball(0, 1), ball(0, 1)];
    same(jet(1, 8), three(ball(1, 16), ball(1, 1), ball(8, 1)));
    same(jet(1, 4), three(ball(1, 4), ball(2, 1), ball(-8, 3)));
    same(jet(1, 2), three(ball(2, 3), ball(4, 3), ball(-8, 3)));
    same(jet(1, 1), three(ball(1, 1), ball(0, 1), ball(-8, 3)));
    // 10x³ stretched: s''' = 60/(2λ)² before the joint and 60 · (1 − 6/2 + 6/4)/(2μ)² after.
    let law = Law::stretched(&Family::Polynomial345, &r(1, 4));
    let third = |x: Rational| law.jet(&x, 160)[3].clone();
    assert!(third(r(1, 4)).contains(&r(-40, 3)));
    assert!(third(r(0, 1)).contains(&r(240, 1)));
}

/// `2λ s(x/2λ)`, and `1 − 2μ s((1 − x)/2μ)` beyond the joint.
#[test]
fn polynomials_stretched_to_a_quarter() {
    let law = Law::stretched(&Family::Polynomial345, &r(1, 4));
    let at = |n, d| law.jet(&r(n, d), 160)[0].clone();
    // s(1/4) = 53/512 either way.
    assert!(at(1, 8).contains(&r(53, 1024)) && at(5, 8).contains(&r(865, 1024)));
    assert!(at(0, 1).is_zero() && at(1, 1).contains(&r(1, 1)));
    assert!(law.reached(64).contains(&r(1, 1)) && law.reached(64).rad().is_zero());
}

/// With `A = ∫_0^½ s` of the symmetric law it is `μ + 4 (λ² − μ²) A`.
#[test]
fn means_of_stretched_laws() {
    let pi = || Ball::pi(160);
    let square = || pi() * pi();
    let half = |family: &str| match family {
        "parabolas" => ball(1, 12),
        "harmonic" => ball(1, 4) - pi().shift(1).recip(),
        "cycloidal" => ball(1, 8) - square().shift(1).recip(),
        "3-4-5" => ball(5, 64),
        // A sine, a constant and a cosine, of 1/8, 1/4 and 1/8: areas from s, v and a at the start
        // of each.
        "trapezoid" => {
            let (a, four) = (pi().shift(3) / (ball(2, 1) + pi()), pi().shift(2));
            let quotient = &a / (&four * &four);
            let v = &a / &four;
            let s = &v * (ball(1, 8) - four.recip());
            let first = &v * ball(1, 128) - &quotient / &four;
            let second = s.shift(-2) + v.shift(-5) + &a * ball(1, 384);
            let s = s + v.shift(-2) + a.shift(-5);
            let v = v + a.shift(-2);
            let third = s.shift(-3) + v.shift(-7) + quotient * (ball(1, 8) - four.recip());
            first + second + third
        }
        other => panic!("{other}"),
    };
    for (n, d) in [(1, 4), (1, 2), (9, 10)] {
        let polynomial = Law::stretched(&Family::Polynomial345, &r(n, d));
        for (name, law) in [
            ("parabolas", scca((0, 1), (0, 1), (n, d))),
            ("harmonic", scca((0, 1), (1, 1), (n, d))),
            ("cycloidal", scca((1, 2), (1, 2), (n, d))),
            ("3-4-5", polynomial),
            ("trapezoid", scca((1, 4), (1, 4), (n, d))),
        ] {
            // λ² − μ² = λ − μ.
            let due = ball(d - n, d) + ball(2 * n - d, d).shift(2) * half(name);
            assert!(is(&law.mean(160), &due), "{name} {n}/{d}");
        }
    }
    // x², and the sum of the coefficients divided out: 2x² − x.
    let law = |c: &[i32]| Law::polynomial(&c.iter().map(|&c| r(c, 1)).collect::<Vec<_>>());
    assert!(law(&[0, 0, 5]).unwrap().mean(64).contains(&r(1, 3)));
    assert!(law(&[0, -3, 6]).unwrap().mean(64).contains(&r(1, 6)));
    assert!(law(&[0, 1, -1]).is_none() && law(&[]).is_none());
}

/// One inner knot in the middle. With its ordinate σ is `x²(12 − 16x)` on either side of it, of
/// area ½.
#[test]
fn the_variation_of_an_ordinate_in_the_middle() {
    let knots = [r(0, 1), r(1, 2), r(1, 1)];
    let y = [r(0, 1), r(1, 3), r(1, 1)];
    let law = Law::spline(
        &Spline::clamped(&knots, &y, &r(0, 1), &r(0, 1)).unwrap(),
        &knots,
    );
    let variations = law.spline_variations(128);
    assert_eq!(variations.len(), 2);
    let [knot, ordinate] = &variations[..] else {
        panic!("two");
    };
    assert!(knot.datum.contains(&r(1, 2)) && ordinate.datum.contains(&r(1, 3)));
    assert!(ordinate.integral.contains(&r(1, 2)) && ordinate.integral.accuracy_bits() > 110);
    for (jumps, due) in ordinate.jumps.iter().zip([[24, -96], [0, 192], [-24, -96]]) {
        assert!(jumps[0].is_zero());
        assert!(jumps[1].contains(&r(due[0], 1)) && jumps[2].contains(&r(due[1], 1)));
    }
}

/// Other laws have no variations: one piece, pieces that are no cubics, zones.
#[test]
fn only_splines_with_inner_knots_vary() {
    let cubic: Vec<Rational> = [0, 0, 3, -2].map(|c| r(c, 1)).into();
    let none = |law: &Law| law.spline_variations(64).is_empty();
    assert!(none(&Law::polynomial(&cubic).unwrap()));
    assert!(none(&scca((1, 4), (1, 2), (1, 3))));
    assert!(none(&Law::stretched(&Family::Polynomial345, &r(1, 2))));
    let piece = |start: Rational, end: Rational, coefficients: &[Rational]| Piece {
        start,
        end,
        coefficients: coefficients.to_vec(),
    };
    let longer: Vec<Rational> = [0, 0, 3, -2, 1].map(|c| r(c, 1)).into();
    for (first, second) in [(&cubic, &longer), (&longer, &cubic)] {
        let law = Law(Form::Pieces(vec![
            piece(r(0, 1), r(1, 2), first),
            piece(r(1, 2), r(1, 1), second),
        ]));
        assert!(none(&law));
    }
}
