//! Remainders, terms and radii of the asymptotic series.

use super::*;
use crate::ComplexBall;
use crate::faddeeva::argument::Real;
use crate::faddeeva::{taylor, trapezoidal};
use proptest::prelude::*;
use rug::Rational;
use std::f64::consts::PI;

/// `T_N` and what the head of the file makes of it, with a bit for the roundings and the step from
/// `ln Γ` to its bound.
#[test]
fn remainders_are_those_of_the_head() {
    use rug::Float;
    let log2 = |x: Float| x.ln() / std::f64::consts::LN_2;
    for n in [1u64, 2, 3, 7, 40, 1000, 1_000_000] {
        for log_r in [0.5, 3.0, 12.25, 100.0] {
            let f = |x: f64| Float::with_val(160, x);
            let whole = f(n as f64);
            let s: Float = whole.clone() + 0.5;
            let t: Float = s.clone().ln_gamma() / f(2.0).ln()
                - log2(Float::with_val(160, rug::float::Constant::Pi))
                - s * log_r;
            let half_e: Float = f(1.0).exp().ln() / f(2.0).ln() / 2;
            let root: Float = Float::with_val(160, &whole + 1.5).sqrt();
            let turning: Float = (whole.clone() * 2 - 1) * root.clone() + whole * 2 + 3;
            let bound = remainder(n, log_r);
            for (found, due) in [
                (bound.plain, t.clone() + &half_e + log2(root)),
                (bound.turning, t.clone() + &half_e + log2(turning)),
            ] {
                let more = found - due.to_f64();
                assert!((0.99..1.02).contains(&more), "{n} {log_r}: {more}");
            }
        }
    }
}

fn w(x: f64, y: f64) -> ComplexBall {
    let q = |x: f64| Rational::from_f64(x).unwrap();
    trapezoidal::w(&q(x), &q(y), 300)
}

fn found(x: f64, y: f64, member: Member, prec: u32) -> Option<[Scaled; 2]> {
    parts(
        &Argument::new(Real::Double(x), Real::Double(y)),
        member,
        prec,
    )
}

fn radii(found: &[Scaled; 2]) -> [f64; 2] {
    [0, 1].map(|k: usize| found[k].ball.rad().to_f64())
}

/// The least number of terms below |z|² whose remainder is small enough, and none where none is.
#[test]
fn terms_are_the_least_that_suffice() {
    for prec in [1, 2, 10, 24, 40, 53, 100, 300] {
        for log_r in [
            2.0, 2.999, 3.0, 3.7, 4.5, 5.0, 5.9, 6.0, 7.3, 9.0, 12.5, 39.9, 41.0, 90.0,
        ] {
            let wanted = -f64::from(prec) - 0.5 * log_r - 3.0;
            let most = (log_r.exp2() as u64).min(2000);
            let least = (1..=most).find(|n| remainder(*n, log_r).turning <= wanted);
            let least = least.filter(|_| log_r >= 3.0);
            assert_eq!(terms(log_r, prec), least, "{prec} {log_r}");
        }
    }
    // Only |z|² terms: where the remainder grows again, none.
    assert_eq!(terms(3.0, 12), None);
}

/// The radii are the bounds of the head, no less and no more, where they outweigh the roundings.
#[test]
fn radii_are_the_bounds() {
    let near = |found: f64, due: f64| (due * (1.0 - 1e-9)..due * 1.02).contains(&found);
    let (mut beside, mut above) = (0, 0);
    for prec in 8..60 {
        for (x, h) in [
            (6.0, 1e-6f64),
            (6.0, 1.0 / 1024.0),
            (6.0, 0.05),
            (6.5, 0.1),
            (8.0, 0.25),
            (0.0078125, 7.0),
            (1e-30, 7.0),
            (3.0, 6.0),
        ] {
            let Some(out) = found(x, h, Member::W, prec) else {
                continue;
            };
            let z = Argument::new(Real::Double(x), Real::Double(h));
            let bound = remainder(
                terms(z.norm_log2() - 1e-8, prec).unwrap(),
                z.norm_log2() - 1e-8,
            );
            let (plain, turning) = (bound.plain.ceil().exp2(), bound.turning.ceil().exp2());
            let r = x.hypot(h);
            let arc = |small: f64| FRAC_PI_2 * small / r;
            let e = (h * h - x * x).exp();
            let sum = e * ((2.0 * x * h).cos().abs() + (2.0 * x * h).sin().abs());
            let twice = 2.0 * r * r * sum;
            let [re, im] = radii(&out);
            assert!(
                near(im, plain.min(arc(x) * turning)),
                "{x} {h} {prec}: {im}"
            );
            // About the least share of Re S_N that counts.
            let absent = h / (PI.sqrt() * r * r) * (-f64::from(prec) - 8.0).exp2();
            if h > x || plain < absent * 0.7 {
                assert!(near(re, plain), "{x} {h} {prec}: {re}");
                above += 1;
            } else if plain > absent * 1.5 && e > absent * 1.5 {
                let due = plain.min(arc(h) * (turning + twice));
                assert!(near(re, due), "{x} {h} {prec}: {re} {due}");
                beside += u32::from(due < plain);
            }
        }
    }
    assert!(beside > 20 && above > 40, "{beside} {above}");
}

/// Beside the real axis, on both sides of it, and about the diagonals, at precisions where e^{−z²}
/// counts: what is found holds the value and has the bits asked for.
#[test]
fn values_hold_where_the_gaussian_counts() {
    let mut members = [0; 2];
    for prec in (6..60).step_by(3) {
        for x in [0.0, 3.0, 4.25, 5.5, 7.0] {
            for y in [1e-20, 0.01, 0.3, 1.0, 3.0, 4.0, 6.0, 7.5] {
                let z = ComplexBall::new(Ball::exact(400, x), Ball::exact(400, y));
                let e = (-&z.square()).exp();
                let below = ComplexBall::new(Ball::exact(400, x), Ball::exact(400, -y));
                let e_below = (-&below.square()).exp();
                let up = w(x, y);
                let down = &e_below.scaled(&Ball::integer(400, 2)) - &up.conj();
                let cases = [
                    (found(x, y, Member::W, prec), up.clone()),
                    (found(x, -y, Member::W, prec), down),
                    (found(x, y, Member::Dawson, prec), &up - &e),
                ];
                for (k, (found, due)) in cases.into_iter().enumerate() {
                    let Some([re, im]) = found else { continue };
                    for (part, due) in [(&re, &due.re), (&im, &due.im)] {
                        let held = match part.ball.is_zero() {
                            true => due.contains_zero(),
                            false => part.to_ball().contains_ball(due),
                        };
                        assert!(held, "{k} {x} {y} {prec}: {part:?} {due:?}");
                    }
                    let least = due
                        .magnitude()
                        .max(e.magnitude())
                        .shift(1 - i64::from(prec));
                    assert!(
                        re.ball.rad() <= least && im.ball.rad() <= least,
                        "{k} {x} {y} {prec}"
                    );
                    members[k / 2] += 1;
                }
            }
        }
    }
    assert!(members[0] > 300 && members[1] > 100, "{members:?}");
}

/// On the axes: a part that vanishes does so exactly, and the other keeps its digits.
#[test]
fn axes() {
    let [re, im] = found(7.0, 0.0, Member::W, 50).unwrap();
    let e = (-Ball::integer(300, 49)).exp();
    assert!(re.to_ball().overlaps(&e) && re.to_ball().accuracy_bits() > 50);
    assert!(im.to_ball().accuracy_bits() > 50);
    let bound = remainder(terms(49f64.log2() - 1e-8, 50).unwrap(), 49f64.log2() - 1e-8);
    assert!(im.ball.rad() >= power(bound.plain));
    let [re, _] = found(7.0, 0.0, Member::Dawson, 50).unwrap();
    assert!(re.ball.is_zero());
    let [_, im] = found(0.0, 7.0, Member::W, 50).unwrap();
    assert!(im.ball.is_zero());
}

/// Where `e^{−z²}` has an exponent of its own, the radii are relative to it.
#[test]
fn radii_far_below() {
    for y in [-2e4, -1e5, -1e200] {
        let [re, im] = found(1.25e-5, y, Member::W, 50).unwrap();
        assert!(re.exponent > 1i64 << 26 && re.exponent == im.exponent);
        for part in [re, im] {
            assert!(part.ball.rad() <= Mag::power_of_two(-68), "{y}: {part:?}");
        }
    }
}

/// An upper bound by less than one per cent of the exponent, up to where it is cut off.
#[test]
fn negligible_is_a_close_bound() {
    let at = |x: f64, y: f64| negligible(&Argument::new(Real::Double(x), Real::Double(y)));
    for (x, y) in [(10.0, 1.0), (30.0, 0.25), (300.0, 299.0), (1e4, 1.0)] {
        let due = (y * y - x * x) * std::f64::consts::LOG2_E;
        let found = at(x, y).exponent().unwrap() as f64;
        assert!(
            found >= due && found < due * 0.995 + 1.0,
            "{x} {y}: {found} {due}"
        );
    }
    assert_eq!(at(1.0, 1.0), Mag::INFINITY);
    assert_eq!(at(1.0, 2.0), Mag::INFINITY);
    assert_eq!(at(1e9, 1.0), Mag::power_of_two(-432_000_000));
    for (log2, due) in [(-3.5, -3), (2.0, 2), (2.25, 3), (-1e10, -500_000_000)] {
        assert_eq!(power(log2), Mag::power_of_two(due));
    }
    let [one, two] = [0, 1].map(Mag::power_of_two);
    assert!(one.min(two) == one && two.min(one) == one);
}

proptest! {
    /// w and w' at moderate |z| (Kummer's series) against N terms: both remainders obey their
    /// bounds over the closed quadrant.
    #[test]
    fn remainders_obey_their_bounds(r in 0.8f64..7.0, turn in 0.0f64..1.0, k in 0u32..4, n in 1u64..40) {
        let turn = [turn * FRAC_PI_2, turn * 0.01, FRAC_PI_2 - turn * 0.01, 0.0][k as usize];
        let q = |x: f64| Rational::from_f64(x.max(0.0)).unwrap();
        let (x, y) = (q(r * turn.cos()), q(r * turn.sin()));
        let prec = 200;
        let c = taylor(&x, &y, 1, prec).unwrap();
        let z = ComplexBall::rational(prec, &x, &y);
        let one = ComplexBall::new(Ball::integer(prec, 1), Ball::integer(prec, 0));
        let inverse = one.div(&z);
        let square = inverse.square();
        // t = (1/2)_m z^{−2m−1}; z (t)' = −(2m+1) t.
        let mut t = inverse;
        let (mut s, mut slope) = (ComplexBall::zero(prec), ComplexBall::zero(prec));
        for m in 0..n {
            s = &s + &t;
            slope = &slope - &t.scaled(&Ball::integer(prec, 2 * m as i64 + 1));
            t = (&t * &square).scaled(&Ball::rational(prec, &Rational::from((2 * m + 1, 2))));
        }
        let factor = Ball::pi(prec).sqrt().recip();
        let rest = &c[0] - &s.scaled(&factor).turned();
        let turning = &(&z * &c[1]) - &slope.scaled(&factor).turned();
        let z = Argument::new(Real::Rational(x), Real::Rational(y));
        let bound = remainder(n, z.norm_log2() - 1e-8);
        prop_assert!(rest.mignitude() <= power(bound.plain), "{rest:?}");
        prop_assert!(turning.mignitude() <= power(bound.turning), "{turning:?}");
    }
}
