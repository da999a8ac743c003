//! erf and its relatives next to their zeros, on the axes and far out; the Gaussian; Voigt
//! profiles.

use super::argument::Real;
use super::gaussian::{Gaussian, exp_scaled};
use super::related::times_gaussian;
use super::tests::q;
use super::*;
use rug::Integer;

fn one() -> [Scaled; 2] {
    [
        Scaled::from(Ball::integer(64, 1)),
        Scaled::from(Ball::integer(64, 0)),
    ]
}

/// `m 2^k` is e^t: the logarithm of m is `t − k ln 2`. No power of two is split off what an `f64`
/// or so holds.
#[test]
fn exponentials_of_any_size() {
    let ln2 = Ball::integer(400, 2).ln();
    for (t, plain) in [
        (0.0, true),
        (5.5, true),
        (-700.25, true),
        (9.9e7, true),
        (-9.9e7, true),
        (1.1e8, false),
        (-1.1e8, false),
        (1e15, false),
        (-1e40, false),
        (1e60, false),
    ] {
        let (m, k) = exp_scaled(&Ball::exact(300, t), 80);
        assert_eq!(k == 0, plain, "{t}");
        assert!(m.accuracy_bits() >= 70, "{t}: {}", m.accuracy_bits());
        if !plain {
            assert!((0.5..=2.0).contains(&m.to_f64()), "{t}");
        }
        let rest = Ball::exact(400, t) - &(Ball::rational(400, &Rational::from(&k)) * &ln2);
        assert!(m.ln().overlaps(&rest), "{t}");
    }
}

/// The argument of the Gaussian has as many bits more as its size asks for: nothing is lost of the
/// product.
#[test]
fn products_with_gaussians_keep_their_bits() {
    for (x, y) in [
        (0.3, 0.4),
        (1e5, 1e3),
        (1e3, 1e5),
        (-1e5, 1.7),
        (1.7, -1e5),
        (1e20, 1e20),
        (3e60, 0.1),
        (0.1, 3e60),
    ] {
        let parts = times_gaussian(&one(), &Real::Double(x), &Real::Double(y), 100);
        for part in parts {
            let bits = part.ball.accuracy_bits();
            assert!(bits >= 90, "{x} {y}: {bits}");
        }
    }
    // e^{−10^10}, as Re w(10^5).
    let [re, im] = times_gaussian(&one(), &Real::Double(1e5), &Real::Double(0.0), 100);
    assert_eq!(
        re.to_decimal(20).unwrap(),
        "9.2785844203248725781e-4342944820"
    );
    assert!(im.ball.is_zero());
    // Both exponents count: 2^9000 e^{−10^10}.
    let large = one().map(|s| Scaled::new(s.ball, Integer::from(9000)));
    let [large, _] = times_gaussian(&large, &Real::Double(1e5), &Real::Double(0.0), 100);
    assert_eq!(large.exponent - re.exponent, 9000);
    assert!(large.ball.overlaps(&re.ball));
    // (3/2 − i/4) e^{−z²} with z² = 0.3125 − 0.75 i.
    let factor = [1.5, -0.25].map(|x| Scaled::from(Ball::exact(80, x)));
    let (x, y) = (Real::Double(0.75), Real::Double(-0.5));
    let [re, im] = times_gaussian(&factor, &x, &y, 80).map(|s| s.to_ball().to_f64());
    let size = (-0.3125f64).exp();
    let (c, s) = (size * 0.75f64.cos(), size * 0.75f64.sin());
    assert!((re - (1.5 * c + 0.25 * s)).abs() < 1e-15);
    assert!((im - (1.5 * s - 0.25 * c)).abs() < 1e-15);
}

/// Relative to a power of two: what is too small becomes a tiny ball about zero.
#[test]
fn gaussians_relative_to_a_power() {
    let e = Gaussian::new(&Ball::exact(120, 0.5), &Ball::exact(120, 0.25), 80);
    let (c, s) = e.relative_to(&Integer::from(7));
    assert!(c.shift(7).overlaps(&e.c) && s.shift(7).overlaps(&e.s));
    let (c, s) = e.relative_to(&(Integer::from(1) << 40u32));
    assert!(c.mid().is_zero() && s.mid().is_zero() && c.rad() == s.rad());
}

/// `erfc(iy) = 1 − i erfi(y)` and erf(iy) is imaginary, exactly.
#[test]
fn on_the_imaginary_axis() {
    for y in [1e-9, 0.25, -1.5, 7.0, -30.0] {
        let erfc = erfc(&Rational::new(), &q(y), 90).unwrap();
        assert!(erfc.re.rad().is_zero() && erfc.re.contains(&Rational::from(1)));
        let erfi = erfi(&q(y), &Rational::new(), 90).unwrap();
        assert!(erfc.im.overlaps(&-&erfi.re) && erfi.im.is_zero());
        let erf = erf(&Rational::new(), &q(y), 90).unwrap();
        assert!(erf.re.is_zero() && erf.im.overlaps(&erfi.re));
        assert!(erf.im.accuracy_bits() >= 90 && erfc.im.accuracy_bits() >= 90);
    }
}

/// erf is odd and `erf + erfc = 1` on both sides of every change of the formula.
#[test]
fn formulas_of_erf_meet() {
    let step = 2f64.powi(-52);
    for x in [
        0.0,
        1e-300,
        0.5,
        1.0 - step,
        1.0,
        1.0 + step,
        2.0,
        2.0 + step,
        6.0,
    ] {
        for y in [0.0, 1e-200, 0.75, -3.0] {
            let (a, b) = (
                erf(&q(x), &q(y), 80).unwrap(),
                erf(&q(-x), &q(-y), 100).unwrap(),
            );
            assert!(a.re.overlaps(&-&b.re) && a.im.overlaps(&-&b.im), "{x} {y}");
            for part in [&a.re, &a.im] {
                assert!(part.is_zero() || part.accuracy_bits() >= 80, "{x} {y}");
            }
            let c = erfc(&q(x), &q(y), 80).unwrap();
            let sum = &a + &c;
            assert!(sum.re.contains(&Rational::from(1)) && sum.im.contains(&Rational::new()));
            // Re erf grows with x on the real axis from (2/√π) x.
            if y == 0.0 && 0.0 < x && x <= 0.5 {
                let first = Ball::exact(200, x) * &(Ball::integer(200, 2) / &Ball::pi(200).sqrt());
                let ratio = &a.re / &first;
                assert!(ratio.to_f64() <= 1.0 && ratio.to_f64() > 1.0 - x * x / 3.0 - 1e-15);
            }
        }
    }
}

/// An argument of 6000 bits, all of which are needed next to a zero: they count for the cap.
#[test]
fn next_to_a_zero_of_erf_known_to_six_thousand_bits() {
    let z = zero_of_erf(1, 6000).unwrap();
    let near = |b: &Ball| b.mid().to_rational().unwrap();
    let tiny = erf(&near(&z.re), &near(&z.im), 40).unwrap();
    assert!(tiny.re.accuracy_bits() >= 40 && tiny.im.accuracy_bits() >= 40);
    assert!(tiny.magnitude() < Mag::power_of_two(-5980));
}

/// `Re w((x + iγ)/(σ√2))/(σ√(2π))`, even in x, by w over a ball, in the reach of every series.
#[test]
fn voigt_profiles_by_w() {
    for (x, sigma, gamma) in [
        (0.5, 1.0, 0.25),
        (3.0, 0.5, 0.125),
        (2.0, 3.0, 1e-9),
        (9.0, 1.0, 3.0),
        (20.0, 0.5, 0.0),
        (100.0, 2.0, 1.0),
        (1e6, 1.0, 1e-3),
        (0.0, 1.0, 0.5),
        (40.0, 4.0, 1e-30),
    ] {
        for bits in [40, 90, 200] {
            let wide = 1500;
            let root = Ball::integer(wide, 2).sqrt() * &Ball::exact(wide, sigma);
            let z = ComplexBall::new(
                Ball::exact(wide, x) / &root,
                Ball::exact(wide, gamma) / &root,
            );
            let due = w_ball(&z, wide).re / &(&root * &Ball::pi(wide).sqrt());
            for x in [x, -x] {
                let found = voigt(&q(x), &q(sigma), &q(gamma), bits).unwrap();
                assert!(found.overlaps(&due), "{x} {sigma} {gamma} {bits}");
                assert!(found.accuracy_bits() >= i64::from(bits));
            }
        }
    }
}

/// Any number of bits is reached, of large and of small values: no bit of the quotient by σ√(2π) is
/// left out.
#[test]
fn voigt_profiles_have_the_bits_asked_for() {
    for bits in (0..4).chain(70..105) {
        for k in 0..24 {
            let x = q(0.5 + f64::from(k) * 0.375);
            for gamma in [q(1e-12), q(0.0)] {
                let v = voigt(&x, &q(0.75), &gamma, bits).unwrap();
                assert!(v.accuracy_bits() >= i64::from(bits), "{x} {gamma} {bits}");
            }
        }
        let cauchy = voigt(&q(3.0), &q(0.0), &q(0.7), bits).unwrap();
        assert!(cauchy.accuracy_bits() >= i64::from(bits));
    }
}

/// Few bits of each function, and none at all, are still balls about the value.
#[test]
fn few_bits() {
    let (x, y) = (q(1.25), q(0.5));
    for f in [w, erf, erfc, erfcx, erfi, dawson] {
        let fine = f(&x, &y, 80).unwrap();
        for bits in 0..9 {
            let coarse = f(&x, &y, bits).unwrap();
            assert!(coarse.re.overlaps(&fine.re) && coarse.im.overlaps(&fine.im));
            for part in [&coarse.re, &coarse.im] {
                assert!(part.accuracy_bits() >= i64::from(bits));
            }
        }
    }
}
