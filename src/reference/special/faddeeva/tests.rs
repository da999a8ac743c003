//! Random arguments: two precisions, two routes, identities, and the edges of the range.

use super::argument::{Argument, Member};
use super::ziv::balls;
use super::*;
use crate::Decimal;
use proptest::prelude::*;

/// The exact value of a number.
pub(super) fn q(x: f64) -> Rational {
    Rational::from_f64(x).expect("finite")
}

fn decimal(text: &str) -> Rational {
    Decimal::parse(text).expect("a decimal").value
}

fn accurate(b: &Ball, bits: u32) -> bool {
    b.is_zero() || b.accuracy_bits() >= i64::from(bits)
}

/// Same number, and both as accurate as promised.
fn agree(a: &ComplexBall, bits: u32, b: &ComplexBall, more: u32) -> bool {
    let small = [&a.re, &a.im].iter().all(|x| accurate(x, bits));
    let smaller = [&b.re, &b.im].iter().all(|x| accurate(x, more));
    small && smaller && a.overlaps(b)
}

/// A coordinate: of moderate size, or of any exponent.
fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![
        3 => -9.0f64..9.0,
        1 => -60.0f64..60.0,
        1 => (-300.0f64..3.0, any::<bool>()).prop_map(|(e, s)| {
            let x = 10f64.powf(e);
            if s { -x } else { x }
        }),
        1 => (-300.0f64..-1.0, any::<bool>()).prop_map(|(e, s)| {
            let x = 10f64.powf(e);
            if s { -x } else { x }
        }),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, ..ProptestConfig::default() })]

    #[test]
    fn precisions_agree(x in coordinate(), y in coordinate(), bits in 53u32..500, more in 1u32..600) {
        let a = w_f64(x, y, bits).unwrap();
        let b = w(&q(x), &q(y), bits + more).unwrap();
        prop_assert!(agree(&a, bits, &b, bits + more), "{a:?} {b:?}");
    }

    #[test]
    fn diagonal_rays(r in -3.0f64..8.0, damping in -0.1f64..0.1, bits in 53u32..200) {
        let r = 10f64.powf(r);
        for (x, y) in [(r, -r * (1.0 + damping)), (r, r * (1.0 + damping)), (r, -r)] {
            // Below the axis |w| reaches e^{10^15}.
            let a = w_scaled(&q(x), &q(y), bits).unwrap();
            let b = w_scaled(&q(x), &q(y), 2 * bits).unwrap();
            for (a, b) in a.iter().zip(&b) {
                prop_assert!(accurate(&a.ball, bits) && accurate(&b.ball, 2 * bits), "{x} {y}");
                let (a, b, _) = scaled::aligned(a, b);
                prop_assert!(a.overlaps(&b), "{x} {y}: {a:?} {b:?}");
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 4000, ..ProptestConfig::default() })]

    #[test]
    fn fixed_point_holds(
        x in coordinate(), y in coordinate(), bits in 30u32..104, k in 0u32..9, small in -300.0..0.0f64,
    ) {
        // Anywhere; next to the axes; at the borders of the cells; further out, beside the real
        // axis on both sides, however near, too; next to the diagonals, where e^(-z^2) is neither
        // large nor small; far below the axis, where it is large beyond what doubles hold.
        let (x, y) = match k {
            0 => (x, y),
            1 => (x * 1.1, y * 1e-5),
            2 => ((4.0 * x).round() / 4.0, (4.0 * y).round() / 4.0 + 1e-12),
            3 => (2.0 * x, 2.0 * y.abs()),
            4 => (9.5 + 3.0 * x.abs(), y * 10f64.powf(small)),
            5 => (9.5 + 3.0 * x.abs(), 2.0 * y),
            6 => (x, -9.5 - 3.0 * y.abs()),
            7 => (x, -(10f64.powf(2.0 - small / 150.0))),
            _ => {
                let r = 10f64.powf(1.0 - small / 50.0);
                (r + 2.0 * x / r, -r + 2.0 * y / r)
            }
        };
        let (dx, dy) = (Real::Double(x), Real::Double(y));
        // The same plus something no double holds.
        let third = |x: f64| Real::Rational(q(x) + q(x) / 3u32);
        for (x, y) in [(&dx, &dy), (&third(x), &third(y))] {
            if let Some(fast) = fast::w(x, y, bits) {
                let slow = balls(scaled(x.clone(), y.clone(), 160).unwrap(), 160).unwrap();
                prop_assert!(agree(&fast, bits, &slow, 160), "{fast:?} {slow:?}");
            }
        }
        // W, and D in the first quadrant, whatever is lost in differences.
        for (y, member) in [(dy.clone(), Member::W), (Real::Double(y.abs()), Member::Dawson)] {
            let z = Argument::new(Real::Double(x.abs()), y);
            if let Some(fast) = fast::parts(&z.x, &z.y, member, bits) {
                let slow = ziv::decide("", 160, 3000, |prec| general::general(&z, member, prec));
                let slow = balls(slow.unwrap(), 160).unwrap();
                prop_assert!(fast.overlaps(&slow), "{fast:?} {slow:?}");
                let good = |a: &Ball, b: &Ball| a.rad() <= b.magnitude().shift(-i64::from(bits));
                let good = good(&fast.re, &slow.re) && good(&fast.im, &slow.im);
                prop_assert!(good || member == Member::W || bits > 80, "{x} {fast:?}");
            }
        }
        if fast::w(&dx, &dy, bits).is_none() {
            // It does answer in ordinary places.
            prop_assert!(!(bits < 80 && x.abs() < 9.0 && y > 0.3 && y < 9.0 && x.abs() > 0.3));
            // Close below the axis e^(-x^2) may cancel against the rest.
            let cancels = y > -1e-40 && y <= 0.0;
            prop_assert!(!(bits < 80 && (10.5..39.0).contains(&x) && y.abs() < 1.0 && !cancels));
            prop_assert!(!(bits < 50 && k == 8 && x.abs() < 1e6));
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, ..ProptestConfig::default() })]

    #[test]
    fn trapezoidal_rule_agrees(x in -9.0f64..9.0, y in -5.0f64..9.0, k in 0u32..4, prec in 60u32..400) {
        // Beside the axes too.
        let (x, y) = match k {
            0 => (x, y * 1e-40),
            1 => (x * 1e-40, y),
            2 => (x * 9.0, y.abs() * 9.0),
            _ => (x, y),
        };
        let a = w_f64(x, y, prec + 60).unwrap();
        let b = trapezoidal::w(&q(x), &q(y), prec);
        prop_assert!(a.overlaps(&b), "{x} {y} {a:?} {b:?}");
        let size = a.magnitude().max(Mag::from_f64(1.0));
        prop_assert!(b.radius() <= size.shift(4 - i64::from(prec)), "{x} {y} {prec}: {b:?}");
    }

    #[test]
    fn identities(x in coordinate(), y in -9.0f64..9.0, bits in 60u32..300) {
        let (u, v) = (q(x), q(y));
        let (mu, mv) = (Rational::from(-&u), Rational::from(-&v));
        let at = |a: &Rational, b: &Rational| w(a, b, bits).unwrap();
        let f = at(&u, &v);
        // Mirror image.
        let g = at(&mu, &v);
        prop_assert!(g.re.overlaps(&f.re) && g.im.overlaps(&-&f.im));
        // w(z) + w(−z) = 2e^{−z²}
        let p = bits + 700;
        let z = ComplexBall::rational(p, &u, &v);
        let e = (-&z.square()).exp().scaled(&Ball::integer(p, 2));
        prop_assert!((&f + &at(&mu, &mv)).overlaps(&e));
        // erf + erfc = 1, erfcx e^{−z²} = erfc, erfi, Dawson
        let (erf, erfc) = (erf(&u, &v, bits).unwrap(), erfc(&u, &v, bits).unwrap());
        let sum = &erf + &erfc;
        prop_assert!(sum.re.contains(&Rational::from(1)) && sum.im.contains(&Rational::new()));
        let gauss = (-&z.square()).exp();
        prop_assert!((&erfcx(&u, &v, bits).unwrap() * &gauss).overlaps(&erfc));
        let i = erfi(&u, &v, bits).unwrap();
        let d = dawson(&u, &v, bits).unwrap();
        let half = Ball::pi(p).sqrt().shift(-1);
        prop_assert!((&i * &gauss).scaled(&half).overlaps(&d));
        prop_assert!(accurate(&d.re, bits) && accurate(&d.im, bits));
        prop_assert!(accurate(&erf.re, bits) && accurate(&erfc.im, bits));
        // w' = −2zw + 2i/√π
        let slope = (&z * &f).scaled(&Ball::integer(p, -2));
        let slope = ComplexBall::new(slope.re, slope.im + &half.recip());
        prop_assert!(slope.overlaps(&w_derivative(1, &u, &v, bits).unwrap()));
    }

    #[test]
    fn balls_contain(x in -7.0f64..7.0, y in -4.0f64..7.0, k in 1u32..40, s in -1.0f64..1.0, t in -1.0f64..1.0) {
        let rad = Mag::power_of_two(-i64::from(k));
        let part = |m: f64| Ball::new(Float::with_val(80, m), rad);
        let z = ComplexBall::new(part(x), part(y));
        let r = q(rad.to_f64());
        let inside = w(&(q(x) + q(s) * &r), &(q(y) + q(t) * &r), 100).unwrap();
        prop_assert!(w_ball(&z, 90).overlaps(&inside));
        let far = ComplexBall::new(part(x * 1e3), part(y.abs() * 1e3));
        let inside = w(&(q(x * 1e3) + q(s) * &r), &(q(y.abs() * 1e3) + q(t) * &r), 100).unwrap();
        prop_assert!(w_ball(&far, 90).overlaps(&inside));
    }

    #[test]
    fn taylor_series_sums_to_w(x in -5.0f64..5.0, y in -2.0f64..5.0, s in -0.25f64..0.25, t in -0.25f64..0.25) {
        let bits = 120;
        let n = 60;
        let c = taylor(&q(x), &q(y), n, bits).unwrap();
        prop_assert!(c.iter().all(|c| c.radius() <= c.mignitude().shift(-i64::from(bits))));
        let delta = ComplexBall::rational(200, &q(s), &q(t));
        let mut sum = ComplexBall::zero(200);
        for c in c.iter().rev() {
            sum = &(&sum * &delta) + c;
        }
        let z = (q(x) + q(s), q(y) + q(t));
        let there = w(&z.0, &z.1, 80).unwrap();
        // |c_n| ≤ 1/Γ(n/2+1) above the axis, e^{O(h²)} times that below: 0.36^60/30! is 2^-196.
        prop_assert!(sum.widened(Mag::power_of_two(-120)).overlaps(&there), "{sum:?} {there:?}");
    }
}

/// y a power of two, and y + x and y - x rounded by different amounts: t = y² - x² is 2^-160 t off,
/// and e^t 2^-132.
#[test]
fn a_large_exponential_is_left_to_the_general_evaluation() {
    let y = 2f64.powi(14);
    let x = y * 2f64.powi(-120) * (1.0 + 2f64.powi(-41) + 2f64.powi(-52));
    let (x, y) = (Real::Double(x), Real::Double(-y));
    if let Some(fast) = fast::w(&x, &y, 60) {
        let slow = balls(scaled(x, y, 160).unwrap(), 160).unwrap();
        assert!(agree(&fast, 60, &slow, 160), "{fast:?} {slow:?}");
    }
}

#[test]
fn ten_thousand_digits() {
    let bits = 33_220;
    for (x, y) in [("0.5", "0.25"), ("3.25", "-1.75"), ("200", "1e-30")] {
        let (x, y) = (decimal(x), decimal(y));
        let a = w(&x, &y, bits).unwrap();
        let b = w(&x, &y, bits + 777).unwrap();
        assert!(agree(&a, bits, &b, bits + 777));
        assert!(a.re.to_decimal(10_000).is_some() && a.im.to_decimal(10_000).is_some());
    }
}

#[test]
fn the_edges_of_the_range() {
    for x in [5e-324, 1e-310, 1e-160, 1.0, 6.5, 27.0, 1e5, 1e160, f64::MAX] {
        for y in [5e-324, 1e-310, 1e-30, 1.0, 1e5, 1e200, f64::MAX] {
            let a = w_f64(x, y, 60).unwrap();
            let b = w_f64(x, y, 200).unwrap();
            assert!(agree(&a, 60, &b, 200), "{x} {y}");
        }
    }
    // Exactly on the axes.
    for x in [1e-300, 0.5, 3.0, 20.0, 1e3] {
        let a = w_f64(x, 0.0, 90).unwrap();
        let square = Ball::exact(2000, x).square();
        assert!((-square).exp().overlaps(&a.re), "{x}");
        assert!(accurate(&a.re, 90) && accurate(&a.im, 90));
        assert!(w_f64(0.0, x, 90).unwrap().im.is_zero());
        assert!(w_f64(0.0, -x, 90).unwrap().im.is_zero());
    }
    let origin = w_f64(0.0, 0.0, 90).unwrap();
    assert!(origin.re.contains(&Rational::from(1)) && origin.im.is_zero());
}

#[test]
fn exponents_beyond_any_float() {
    // Re w = e^{−10^600} on the real axis: log2 = −10^600/ln 2.
    let x = decimal("1e300");
    let refused = w(&x, &Rational::new(), 60).unwrap_err();
    assert!(refused.reason.contains("exponent"));
    let [re, im] = w_scaled(&x, &Rational::new(), 60).unwrap();
    let log2 = re.ball.ln() / &Ball::integer(3000, 2).ln()
        + &Ball::rational(3000, &Rational::from(&re.exponent));
    let expected = -(Ball::rational(3000, &decimal("1e600")) / &Ball::integer(3000, 2).ln());
    assert!((&log2 - &expected).magnitude() < Mag::power_of_two(-50));
    assert!(accurate(&re.ball, 60) && accurate(&im.ball, 60));
    // A decimal exponent of 600 digits; by hand: 10^600/ln 10 = 4342944819…(600 digits).
    let text = re.to_decimal(12).unwrap();
    assert!(
        text.contains("e-43429448190325182765112891891660508229439700580366"),
        "{text}"
    );
    assert_eq!(text.len(), "1.23456789012e-".len() + 600);
    assert!(re.to_decimal(40).is_none());
    // Far below the axis 2e^{−z²} is everything.
    let [re, im] = w_scaled(&Rational::from(1), &decimal("-1e300"), 60).unwrap();
    assert!(accurate(&re.ball, 60) && accurate(&im.ball, 60));
    assert!(re.exponent.significant_bits() > 1900);
}

/// Far out in the upper half-plane the series alone decides: e^{−z²}, beyond every exponent there,
/// is no part of w.
#[test]
fn balls_far_out_are_small_at_every_precision() {
    for k in 0..40 {
        let (r, turn) = (1e3 * 3.7f64.powi(k % 11), f64::from(k) * 0.077);
        let (x, y) = (r * turn.cos(), r * turn.sin().abs());
        let z = ComplexBall::new(Ball::exact(53, x), Ball::exact(53, y));
        for prec in 53..=420 {
            let w = w_ball(&z, prec);
            let due = w.magnitude().mul(Mag::power_of_two(4 - i64::from(prec)));
            assert!(w.radius() <= due, "{x:e} + {y:e} i at {prec} bits: {w:?}");
        }
    }
}

#[test]
fn zeros_are_zeros() {
    // Fettis, Caslin & Cramer's table for erfc (Math. Comp. 27, 1973, 401), turned by i.
    for (k, x, y) in [
        (1, "1.99146684", "-1.35481013"),
        (2, "2.69114902", "-2.17704491"),
        (3, "3.23533087", "-2.78438761"),
    ] {
        let z = zero(k, 120).unwrap();
        assert!(accurate(&z.re, 119) && accurate(&z.im, 119));
        let near = |b: &Ball, text| {
            (b - &Ball::rational(200, &decimal(text))).magnitude() < Mag::from_f64(6e-9)
        };
        assert!(near(&z.re, x) && near(&z.im, y), "{z:?}");
        let w = w_ball(&z, 200);
        assert!(w.re.contains_zero() && w.im.contains_zero());
        assert!(w.magnitude() < Mag::power_of_two(-110));
        // Rounded to a double it is no zero, and each component is decided.
        let rounded = w_f64(z.re.to_f64(), z.im.to_f64(), 90).unwrap();
        assert!(accurate(&rounded.re, 90) && accurate(&rounded.im, 90));
    }
    assert!(zero(40, 1000).is_ok() && zero(100_000, 60).is_ok());
}

#[test]
fn zeros_are_counted_completely() {
    // Winding number of w around [0.1, X] × [−X, −0.1], X beyond the first six zeros: w is real and
    // positive on the imaginary axis, and Re w > 0 above the real axis.
    let (low, high) = (0.1, 4.62);
    let corners = [(low, -low), (low, -high), (high, -high), (high, -low)];
    let mut turns = Ball::integer(64, 0);
    for i in 0..4 {
        let ((a, b), (c, d)) = (corners[i], corners[(i + 1) % 4]);
        let mut at = 0.0f64;
        let mut step = 1.0 / 64.0;
        while at < 1.0 {
            let to = (at + step).min(1.0);
            let point = |t: f64| (a + (c - a) * t, b + (d - b) * t);
            let ((x0, y0), (x1, y1)) = (point(at), point(to));
            let (xm, ym) = ((x0 + x1) / 2.0, (y0 + y1) / 2.0);
            let rad = Mag::from_f64((x1 - x0).abs().max((y1 - y0).abs()) / 2.0 * 1.001);
            let thick = |m: f64, along: bool| {
                Ball::new(
                    Float::with_val(64, m),
                    if along { rad } else { Mag::from_f64(1e-14) },
                )
            };
            let piece = w_ball(&ComplexBall::new(thick(xm, a != c), thick(ym, b != d)), 64);
            // Half a plane: the argument is continuous over the piece and its change is the
            // principal value of the quotient's argument.
            if piece.mignitude().is_zero() {
                step /= 2.0;
                assert!(step > 1e-9, "stuck at {xm} {ym}");
                continue;
            }
            let (from, until) = (w_f64(x0, y0, 60).unwrap(), w_f64(x1, y1, 60).unwrap());
            turns = turns + &until.div(&from).arg();
            at = to;
            step = (step * 1.5).min(1.0 / 64.0);
        }
    }
    let turns = &turns / &Ball::pi(64).shift(1);
    // Counter-clockwise from the upper left corner.
    assert!(
        (&turns - &Ball::integer(64, 6)).magnitude() < Mag::from_f64(0.01),
        "{turns:?}"
    );
}

#[test]
fn voigt_profiles_at_their_ends() {
    let one = Rational::from(1);
    let lorentz = voigt(&one, &Rational::new(), &one, 100).unwrap();
    assert_eq!(
        lorentz.to_decimal(25).unwrap(),
        "0.1591549430918953357688838"
    );
    for (s, g) in [("-1", "1"), ("1", "-1"), ("0", "0")] {
        assert!(voigt(&one, &decimal(s), &decimal(g), 100).is_err());
    }
}

#[test]
fn near_a_zero_known_to_three_thousand_bits() {
    let z = zero(1, 3000).unwrap();
    let near = |b: &Ball| b.mid().to_rational().unwrap();
    let tiny = w(&near(&z.re), &near(&z.im), 60).unwrap();
    assert!(accurate(&tiny.re, 60) && accurate(&tiny.im, 60));
    assert!(tiny.magnitude() < Mag::power_of_two(-2990));
}

#[test]
fn next_to_a_component_s_zero() {
    // Bisection in doubles for Re w(x − ih) = 0 and Im w(x − ih) = 0: what is left is decided.
    for (x, real) in [(3.0, true), (5.5, true), (2.0, false), (7.25, false)] {
        let part = |h: f64| {
            let w = w_f64(x, -h, 90).unwrap();
            if real { w.re } else { w.im }
        };
        let (mut low, mut high) = (1e-9, 0.0);
        for k in 1..4000 {
            high = f64::from(k) * 0.002;
            if part(high).is_positive() != part(low).is_positive() {
                break;
            }
        }
        assert!(part(high).is_positive() != part(low).is_positive());
        for _ in 0..80 {
            let mid = (low + high) / 2.0;
            if part(mid).is_positive() == part(low).is_positive() {
                low = mid;
            } else {
                high = mid;
            }
        }
        assert!(high - low < 1e-14);
        for h in [low, high] {
            assert!(accurate(&part(h), 90) && part(h).magnitude() < Mag::from_f64(1e-11));
        }
    }
    let (x, y) = (Float::with_val(300, 2).sqrt(), Float::with_val(90, -1.5));
    let a = w_float(&x, &y, 80).unwrap();
    let b = w_float(&x, &y, 300).unwrap();
    assert!(agree(&a, 80, &b, 300));
}

#[test]
fn what_stays_open_is_undecided() {
    let around_zero = Ball::new(Float::new(64), Mag::power_of_two(-500));
    let part = || Scaled::new(around_zero.clone(), rug::Integer::new());
    let open = ziv::decide("a test", 60, 10, |_| Some([part(), part()])).unwrap_err();
    assert_eq!(open.bits, 4 * 70 + 4096);
    assert!(open.reason.contains("a test"));
    assert!(ziv::decide("a test", 60, 10, |_| None).is_err());
}
