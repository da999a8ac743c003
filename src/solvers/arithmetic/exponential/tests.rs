use super::super::tests::Random;
use super::super::tests::exact::{are_parts, error, gaussian, rational, shifted, sum, wide};
use super::*;
use crate::real::ROUND;
use mechaudit_reference::Ball;
use rug::{Float, Rational};
use std::f64::consts::FRAC_PI_4;

/// u² = 2⁻¹⁰⁶.
const SQUARE: f64 = f64::EPSILON * f64::EPSILON / 4.0;

#[test]
fn constants() {
    let half_pi = Ball::pi(400).shift(-1);
    assert!(are_parts(&half_pi, &HALF_PI));
    assert!(are_parts(
        &(Ball::integer(300, 1) / &half_pi),
        &[TWO_OVER_PI]
    ));
    let ln_2 = Ball::integer(300, 2).ln();
    assert!(are_parts(&(Ball::integer(300, 1) / &ln_2), &[LOG2_E]));
    // The first part ends in twelve zeros and is within a unit of its last digit, the second one
    // is the nearest to the rest.
    assert_eq!(LN_2[0].to_bits() & 0xfff, 0);
    let rest = &ln_2 - &Ball::exact(300, LN_2[0]);
    assert!(rest.magnitude().to_f64() < f64::EPSILON * 4096.0);
    assert!(are_parts(&rest, &LN_2[1..]));
    // Correctly rounded, or the next one to that.
    let check = |c: &[f64], first: u32, step: u32, sign: i32| {
        let mut exact = Rational::from((1, rug::Integer::from(rug::Integer::factorial(first))));
        for (j, c) in c.iter().enumerate() {
            let off = (rational(*c) / &exact - 1u32).abs();
            assert!(off.to_f64() <= f64::EPSILON, "coefficient {j}");
            for k in 1..=step {
                exact /= first + step * j as u32 + k;
            }
            exact *= sign;
        }
    };
    check(&EXP, 2, 1, 1);
    check(&SIN, 3, 2, -1);
    check(&COS, 4, 2, -1);
    check(&EXP_FROM_CUBE, 3, 1, 1);
    check(&SIN_FROM_FIFTH, 5, 2, -1);
    let sixth = &Ball::integer(300, 1) / &Ball::integer(300, 6);
    assert!(are_parts(&sixth, &[SIXTH.hi, SIXTH.lo]));
}

#[test]
fn squares() {
    let mut random = Random(61);
    for k in 0..20_000 {
        let a = random.number(-40, 40).abs();
        let y = if k % 2 == 0 {
            random.number(-40, 40)
        } else {
            a + random.between(-9.0, 9.0) / a
        };
        let exact = rational(y).square() - rational(a).square();
        if exact == 0 {
            assert_eq!(exponent(a, y).hi, 0.0);
            continue;
        }
        let got = sum(exponent(a, y));
        let off = (got - &exact).abs() / Rational::from(exact.abs_ref());
        assert!(off.to_f64() <= 8.0 * SQUARE, "{a:e} {y:e}: {off}");
        assert_eq!(sum(phase(a, y)), rational(a) * rational(y) * 2u32);
        let (a, y) = (random.between(9.0, 27.5), random.between(-0.125, 0.125));
        let exact = rational(y).square() - rational(a).square();
        // Half a unit in the last place of y² ≤ 1/64, and a little: absolute, in an exponent.
        let off = (sum(exponent_in_strip(a, y)) - &exact).abs();
        assert!(off.to_f64() < 2f64.powi(-59), "{a:e} {y:e}: {off}");
    }
}

#[test]
fn exponential() {
    let mut random = Random(62);
    let mut worst = 0.0f64;
    for k in 0..20_000 {
        let x = match k % 4 {
            0 => random.between(-745.0, 710.0),
            1 => random.number(-60, -1),
            2 => random.between(-1400.0, 1400.0),
            _ => random.between(-3.0, 3.0),
        };
        let x = two_sum(x, x * random.number(-70, -54));
        let (e, n) = exp(x);
        assert!((0.7..1.42).contains(&e.hi), "{x:?}");
        let exact = Float::with_val(640, wide(x).exp_ref());
        let off = error(&shifted(e, n), &exact, &exact);
        worst = worst.max(off);
        assert!(off < 0.05 * f64::EPSILON, "{x:?}: {off:e}");
        // One number: half a unit and what the reduced argument loses.
        let (e, n) = exp_rounded(x);
        let off = error(&shifted(Dd::from(e), n), &exact, &exact);
        assert!(off < 0.75 * f64::EPSILON, "{x:?}: {off:e} as one number");
    }
    println!("{} ε", worst / f64::EPSILON);
    // Cut, never undefined.
    for x in [f64::INFINITY, f64::NEG_INFINITY, 1e300, -1e300] {
        let (_, n) = binary_exponent(x);
        assert!((n - ROUND).abs() < 2200.0);
    }
}

#[test]
fn sine_and_cosine() {
    let mut random = Random(63);
    let (mut worst, mut accurate) = (0.0f64, 0.0f64);
    for k in 0..20_000 {
        let x = if k % 3 == 0 {
            random.number(-80, -2)
        } else {
            random.between(-FRAC_PI_4, FRAC_PI_4)
        };
        let r = two_sum(x, x * random.number(-70, -54));
        let (s, c) = sin_cos_reduced(r);
        let exact = wide(r);
        let (es, ec) = (
            Float::with_val(640, exact.sin_ref()),
            Float::with_val(640, exact.cos_ref()),
        );
        let off = error(&wide(s), &es, &es).max(error(&wide(c), &ec, &ec));
        worst = worst.max(off);
        assert!(off < 0.25 * f64::EPSILON, "{r:?}: {off:e}");
        let (t, d) = sin_cos_accurate(r);
        let off = error(&wide(t), &es, &es).max(error(&wide(d), &ec, &ec));
        accurate = accurate.max(off);
        assert!(off < 0.07 * f64::EPSILON, "{r:?}: {off:e}");
        // All quadrants.
        for q in -9..9 {
            let (s, c) = turn(s, c, ROUND + f64::from(q));
            let (p, r) = match i32::rem_euclid(q, 4) {
                0 => (es.clone(), ec.clone()),
                1 => (ec.clone(), -es.clone()),
                2 => (-es.clone(), -ec.clone()),
                _ => (-ec.clone(), es.clone()),
            };
            assert!(error(&wide(s), &p, &p).max(error(&wide(c), &r, &r)) < 0.25 * f64::EPSILON);
        }
    }
    println!("{} {} ε", worst / f64::EPSILON, accurate / f64::EPSILON);
}

/// `e^{−z²}` with phases up to 2³⁰ and beyond, each component by itself.
#[test]
fn gaussian_of_a_complex_number() {
    let mut random = Random(64);
    let (mut worst, mut rounded, mut short, mut long) = (0.0f64, 0.0f64, 0.0f64, 0.0f64);
    for k in 0..12_000 {
        let (a, y) = match k % 3 {
            0 => (random.between(0.0, 26.0), random.between(-26.0, 26.0)),
            1 => {
                let a = random.power(0.0, 14.45);
                (a, a + random.between(-300.0, 300.0) / a)
            }
            _ => (random.power(-20.0, 5.0), -random.power(-20.0, 5.0)),
        };
        let size = y * y - a * a;
        if size.abs() > 1400.0 || phase(a, y).hi.abs() >= LARGE_PHASE {
            continue;
        }
        let (c, s, n) = exp_minus_square(a, y);
        let exact = gaussian(a, y);
        let off_by = |(c, s, n): (Dd, Dd, f64)| {
            let re = error(&shifted(c, n), &exact.0, &exact.0);
            re.max(error(&shifted(s, n), &exact.1, &exact.1))
        };
        let off = off_by((c, s, n));
        worst = worst.max(off);
        assert!(off < 0.08 * f64::EPSILON, "{a:e} {y:e}: {off:e}");
        let e = exp_wide_to::<_, true>(exponent(a, y));
        let off = off_by(product::<_, true>(e, reduce(phase(a, y))));
        long = long.max(off);
        assert!(off < 0.012 * f64::EPSILON, "{a:e} {y:e}: {off:e}");
        assert_eq!(exp_minus_square_any(a, y), (c, s, n));
        let off = off_as_one_number(exp_minus_square_rounded(a, y), &exact);
        rounded = rounded.max(off);
        assert!(off < 1.5 * f64::EPSILON, "{a:e} {y:e}: {off:e}");
        if size.abs() < 700.0 && phase(a, y).hi.abs() < 256.0 {
            let (c, s, n) = exp_minus_square_short(a, y);
            // Of the norm: next to a zero of a component its relative error is larger.
            let norm = Float::with_val(640, exact.0.hypot_ref(&exact.1));
            let due = f64::EPSILON / 2.0 * (3.0 * size.abs() + 4.0);
            for (part, exact) in [(c, &exact.0), (s, &exact.1)] {
                let off = error(&shifted(Dd::from(part), n), exact, &norm);
                short = short.max(off / due);
                assert!(off < due, "{a:e} {y:e}: {off:e}");
            }
        }
    }
    println!("{} {} ε", worst / f64::EPSILON, rounded / f64::EPSILON);
    println!("{short} of the bound, {} ε", long / f64::EPSILON);
    for _ in 0..1000 {
        let a = random.power(15.1, 400.0);
        for y in [a, -a] {
            let (c, s, n) = exp_minus_square_any(a, y);
            let exact = gaussian(a, y);
            let off = error(&shifted(c, n), &exact.0, &exact.0).max(error(
                &shifted(s, n),
                &exact.1,
                &exact.1,
            ));
            assert!(off < 0.08 * f64::EPSILON, "{a:e} {y:e}: {off:e}");
        }
    }
}

fn off_as_one_number((c, s, n): (f64, f64, f64), exact: &(Float, Float)) -> f64 {
    let off = |part, exact| error(&shifted(Dd::from(part), n), exact, exact);
    off(c, &exact.0).max(off(s, &exact.1))
}
