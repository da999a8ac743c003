use super::super::tests::q as rational;
use super::*;
use proptest::prelude::*;
use rug::Rational;

/// The parts of the sum of n terms at p and q², of which the second is a multiple of q.
fn exact(p: &Rational, q2: &Rational, n: u64, ratio: impl Fn(u64) -> (u64, u64)) -> [Rational; 2] {
    let (mut power, mut term) = ((Rational::from(1), Rational::new()), Rational::from(1));
    let mut sums = [Rational::new(), Rational::new()];
    for k in 0..n {
        sums[0] += Rational::from(&power.0 * &term);
        sums[1] += Rational::from(&power.1 * &term);
        let next = Rational::from(p * &power.0) - Rational::from(q2 * &power.1);
        power.1 = Rational::from(p * &power.1) + &power.0;
        power.0 = next;
        term *= Rational::from(ratio(k));
    }
    sums
}

/// The same by balls, term by term.
fn by_balls(
    p: &Rational,
    q2: &Rational,
    n: u64,
    bits: u32,
    ratio: impl Fn(u64) -> (u64, u64),
) -> [Ball; 2] {
    let [p, q2] = [p, q2].map(|x| Ball::rational(bits, x));
    let integer = |k: u64| Ball::integer(bits, k as i64);
    let mut power = [integer(1), integer(0)];
    let (mut term, mut sums) = (integer(1), [integer(0), integer(0)]);
    for k in 0..n {
        for (sum, power) in sums.iter_mut().zip(&power) {
            *sum = &*sum + &(&term * power);
        }
        let next = &(&p * &power[0]) - &(&q2 * &power[1]);
        power = [next, &(&p * &power[1]) + &power[0]];
        let (a, b) = ratio(k);
        term = &(&term * &integer(a)) / &integer(b);
    }
    sums
}

proptest! {
    #[test]
    fn balls_hold_the_exact_sum(
        r in 0.0f64..1.0, turn in 0.0f64..1.6, k in 0u32..3, n in 1u64..40,
        bits in 60u32..200, top in 1u64..60, down in 0u32..30,
    ) {
        // q of order one, tiny, or zero.
        let (p, q) = (r * turn.cos(), r * turn.sin() * [1.0, 1e-9, 0.0][k as usize]);
        let (p, q2) = (rational(p), rational(q).square());
        let ratio = |k: u64| (top, (2 * k + 3) << down);
        let [re, im] = exact(&p, &q2, n, ratio);
        // Inputs with a radius, and none.
        let wide = Mag::power_of_two(-i64::from(bits));
        let given = |x: &Rational| Ball::rational(bits + 20, x).widened(wide);
        let narrow = |x: &Rational| Ball::rational(4000, x);
        for (p, q2) in [(given(&p), given(&q2)), (narrow(&p), narrow(&q2))] {
            let (a, b) = sum(&p, &q2, bits, n, ratio);
            prop_assert!(a.contains(&re) && b.contains(&im), "{a:?} {b:?}");
            let growth = (f64::from(top as u32) / 2.0) * std::f64::consts::LOG2_E;
            let most = Mag::power_of_two(growth as i64 + 24 - i64::from(bits));
            prop_assert!(a.rad() <= most && b.rad() <= most, "{a:?} {b:?}");
        }
    }
}

/// Blocks with fewer digits, short factors and rounded ones: the sums hold, to a few units.
#[test]
fn many_digits_are_held() {
    let bits = MANY + 700;
    for (r, turn) in [(0.9, 0.7), (0.999, 0.0), (0.6, 1.5), (0.99, 3.0)] {
        let (p, q) = (r * f64::cos(turn), r * f64::sin(turn));
        let (p, q2) = (rational(p), rational(q).square());
        let third = Rational::from((1, 3));
        for (top, down, n) in [
            (5u64, 0u32, 330u64),
            (60, 0, 330),
            (1, 4, 150),
            (1 << 40, 41, 200),
        ] {
            let ratio = |k: u64| (top, (2 * k + 3) << down);
            for (p, q2) in [
                (&p, &q2),
                (&Rational::from(&p * &third), &Rational::from(&q2 * &third)),
            ] {
                let [re, im] = by_balls(p, q2, n, bits + 400, ratio);
                let given = |x: &Rational| Ball::rational(bits + 20, x);
                let (a, b) = sum(&given(p), &given(q2), bits, n, ratio);
                assert!(
                    a.contains_ball(&re) && b.contains_ball(&im),
                    "{p} {n} {top}"
                );
                let most = Mag::power_of_two(90 - i64::from(bits));
                assert!(a.rad() <= most && b.rad() <= most, "{a:?} {b:?}");
            }
        }
    }
}

/// A midpoint of few digits with a radius is no short factor.
#[test]
fn short_factors_are_exact() {
    let wide = Mag::power_of_two(200 - i64::from(MANY));
    let [half, third] = [0.5, 0.25].map(|x| Ball::exact(64, x).widened(wide));
    let (a, b) = sum(&half, &third, MANY, 30, |_| (1, 2));
    assert!(
        a.rad() > wide.shift(-4) && b.rad() > wide.shift(-4),
        "{a:?} {b:?}"
    );
    assert!(
        a.rad() < wide.shift(8) && b.rad() < wide.shift(8),
        "{a:?} {b:?}"
    );
}

/// To the nearest unit; a half and the radius are errors.
#[test]
fn numbers_are_stored_to_half_a_unit() {
    for (mid, rad) in [(0.25, 0.0), (-0.75, 0.0), (0.25, 0.5), (0.3, 1.0 / 3.0)] {
        let x = Ball::exact(64, mid).widened(Mag::from_f64(rad));
        let (stored, error) = fixed(&x, 1).unwrap();
        let ends = [x.lower(), x.upper()].map(|end| (end * 2u32 - &stored).abs().to_f64());
        assert!(ends[0] <= error && ends[1] <= error, "{mid} {rad}: {error}");
        assert!(error <= (0.5 + 2.0 * rad) * 1.000_11);
    }
}

/// By a thousandth more than was computed.
#[test]
fn radii_cover_their_own_rounding() {
    for (shift, scale) in [(0, 1.0), (3, 8.0)] {
        let x = enclosed(&Integer::from(5 << 7), 8, 96.0, shift);
        assert_eq!(x.mid().to_f64(), 2.5);
        let rad = x.rad().to_f64() / scale;
        assert!((0.375 * 1.001..0.375 * 1.001 + 1e-9).contains(&rad));
    }
    // A sum of one term has no error but the roundings that were counted.
    let zero = Ball::exact(64, 0.0);
    let (re, im) = sum(&zero, &zero, 64, 1, |_| (1, 1));
    assert!(*re.mid() == 1 && im.mid().is_zero(), "{re:?} {im:?}");
}

/// Where stored powers are off by more than 2^−17 their products say too little.
#[test]
fn powers_have_to_be_near_the_exact_ones() {
    let zero = Ball::exact(64, 0.0);
    for (part, finite) in [(0.999, true), (1.001, false)] {
        let wide = Ball::exact(64, 0.5).widened(Mag::from_f64(part).shift(-17));
        for n in [1, 2, 20] {
            let (re, im) = sum(&wide, &zero, 60, n, |_| (1, 2));
            // Of more terms the second power is stored as well, whose error is half as much
            // again.
            let due = finite && n < 3;
            assert_eq!([re.is_finite(), im.is_finite()], [due, due], "{part} {n}");
        }
    }
}

/// Sums at the ends of uncertain p and q², uncertain by far more than the rounding: all are
/// held, and the farthest takes a fifth of the radius of either part in some of the cases.
#[test]
fn uncertain_arguments_are_carried_on() {
    let (bits, wide) = (160, (-40f64).exp2());
    let mut most = [0.0f64; 2];
    for (r, turn) in [
        (0.95, 0.02),
        (0.9, 0.7),
        (0.95, 1.5),
        (0.5, 1.0),
        (0.9, 0.0),
        (0.95, 3.0),
    ] {
        for small in [1.0, 1e-6] {
            let (p, q) = (r * f64::cos(turn), r * f64::sin(turn) * small);
            for n in [2u64, 5, 12, 30] {
                for (top, factor) in [(1u64, 1u64), (3, 2), (2, 3)] {
                    let ratio = |k: u64| (top, factor * (k % 3 + 1));
                    let given = |x: f64| Ball::exact(bits + 20, x).widened(Mag::from_f64(wide));
                    let (a, b) = sum(&given(p), &given(q * q), bits, n, ratio);
                    for (dp, dq) in [
                        (1.0, 1.0),
                        (1.0, -1.0),
                        (-1.0, 1.0),
                        (-1.0, -1.0),
                        (1.0, 0.0),
                        (0.0, 1.0),
                    ] {
                        let due = exact(
                            &rational(p + dp * wide),
                            &rational(q * q + dq * wide),
                            n,
                            ratio,
                        );
                        for (i, (found, due)) in [&a, &b].into_iter().zip(&due).enumerate() {
                            assert!(found.contains(due), "{p} {q} {n} {top}: {found:?}");
                            let way = Float::with_val(64, found.mid() - due).abs();
                            most[i] = most[i].max((way / found.rad().to_float()).to_f64());
                        }
                    }
                }
            }
        }
    }
    assert!(most.iter().all(|m| *m > 0.2), "{most:?}");
}

/// `|v| ≤ 1` is what the bounds rest on.
#[test]
fn outside_the_unit_disc_nothing_is_bound() {
    let sum = |p: f64, q2: f64| {
        let (p, q2) = (Ball::exact(64, p), Ball::exact(64, q2));
        sum(&p, &q2, 100, 30, |k| (1, k + 1))
    };
    for (p, q2, finite) in [
        (1.0, 0.0, true),
        (-0.5, 0.75, true),
        (0.0, 1.0, true),
        (1.0000001, 0.0, false),
        (-0.5, 0.7500001, false),
        (0.0, 1.0000001, false),
    ] {
        let (a, b) = sum(p, q2);
        assert_eq!((a.is_finite(), b.is_finite()), (finite, finite), "{p} {q2}");
    }
}

/// Terms and bounds that grow beyond 2^512, twice.
#[test]
fn bounds_beyond_numbers_are_multiples() {
    let (bits, n) = (1600, 22u64);
    let ratio = |_: u64| (1u64 << 60, 1u64);
    let [re, im] = exact(&rational(0.5), &rational(0.25), n, ratio);
    let ball = |x: f64| Ball::exact(64, x);
    let (a, b) = sum(&ball(0.5), &ball(0.25), bits, n, ratio);
    assert!(a.contains(&re) && b.contains(&im), "{a:?} {b:?}");
    // A few units times the product of all ratios but for one.
    let unit = Mag::power_of_two(60 * (n as i64 - 1) - i64::from(bits));
    for ball in [&a, &b] {
        let units = ball.rad().div(unit).to_f64();
        assert!((2.0..128.0).contains(&units), "{units}");
    }
}

#[test]
fn too_few_bits_bound_nothing() {
    let half = Ball::exact(64, 0.5);
    let (a, b) = sum(&half, &half, 12, 30, |k| (1, k + 1));
    assert!(!a.is_finite() && !b.is_finite());
}
