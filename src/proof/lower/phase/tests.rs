use super::*;
use crate::pinned::units;
use rug::Float;
use std::sync::LazyLock;

static PHASE: LazyLock<Phase> =
    LazyLock::new(|| Phase::of(&code::constants(), Rounding::default()).expect("a bound"));

/// Phases `k H₀ + r` with a low part at points: the reduced pair, and sine and cosine of the short
/// form, are within their errors.
#[test]
fn reduced_phases_are_within_their_errors() {
    let mut unit = units(23);
    let h0 = code::constants().half_pi[0];
    let half_pi = Ball::pi(300).shift(-1).mid().clone();
    let float = |x: f64| Float::with_val(300, x);
    let mut most = [0.0f64; 2];
    for i in 0..4000 {
        let short = i % 2 == 0;
        let quarters = if short {
            127.0
        } else {
            code::LIMITS.large_phase * 0.63
        };
        let k = (quarters * unit() * if i % 3 == 0 { 1.0 } else { 2f64.powi(-6) }).floor();
        let theta = k.mul_add(h0, REDUCED * (2.0 * unit() - 1.0) * 0.999);
        let low = theta.abs() * U * (2.0 * unit() - 1.0);
        let due = float(theta) + low - float(k) * &half_pi;
        if due.clone().abs() > REDUCED {
            continue;
        }
        if short {
            let (s, c) = code::sin_cos_short((theta, low), k);
            let off = (float(s) - due.clone().sin()).square() + (float(c) - due.cos()).square();
            let off = off.sqrt().to_f64();
            assert!(off <= PHASE.short, "{k} {theta} {off:e}");
            most[0] = most[0].max(off / PHASE.short);
        } else {
            let (hi, lo) = code::without_quarters((theta, low), k);
            let off = (float(hi) + lo - due).abs().to_f64();
            assert!(off <= PHASE.error, "{k} {theta} {off:e}");
            most[1] = most[1].max(off / PHASE.error);
        }
    }
    assert!(most[0] > 0.2, "{most:?}");
}

/// Checks that what three and two parts of π/2 lack is counted, as often as it is subtracted.
#[test]
fn parts_of_half_pi_are_counted() {
    let c = code::constants();
    let [h0, h1, h2] = c.half_pi;
    let exact = Ball::pi(300).shift(-1).mid().clone();
    for parts in [&[h0][..], &[h0, h1], &[h0, h1, h2]] {
        let sum = parts.iter().fold(Float::with_val(300, 0), |s, x| s + *x);
        let due = (exact.clone() - sum).abs().to_f64();
        let left = left_of_half_pi(parts);
        assert!(
            left >= due * (1.0 - 1e-9) && left <= due * (1.0 + 1e-8),
            "{parts:?}"
        );
    }
    // The last number of quarters times what is missing, and the roundings.
    let most = binades(code::LIMITS.large_phase * 0.64)
        .last()
        .expect("some")[1];
    let left = most * left_of_half_pi(&[h0, h1, h2]);
    assert!(
        PHASE.error >= left && PHASE.error < 5e-22,
        "{left:e} {:e}",
        PHASE.error
    );
    assert!(PHASE.error >= power_of_two(-100));
    let mut faulty = code::constants();
    faulty.half_pi[2] = 0.0;
    let found = Phase::of(&faulty, Rounding::default()).expect("a bound");
    assert!(found.error > 0.99 * most * left_of_half_pi(&[h0, h1]));
    faulty.half_pi = [h0, 0.0, 0.0];
    let found = Phase::of(&faulty, Rounding::default()).expect("a bound");
    assert!(found.short > 0.99 * 127.0 * left_of_half_pi(&[h0]));
    // Without roundings: what is left of the sine and the cosine is their polynomials' and a few
    // units.
    assert!(
        PHASE.short > 1.5 * U && PHASE.short < 6.0 * U,
        "{}",
        PHASE.short / U
    );
    assert_eq!(
        PHASE.boxes,
        48 * binades(SHORT).len() + binades(code::LIMITS.large_phase * 0.64).len()
    );
}

#[test]
fn a_first_part_off_the_grid_is_refused() {
    let refused = |first: f64| {
        let mut c = code::constants();
        c.half_pi[0] = first;
        Phase::of(&c, Rounding::default()).is_err()
    };
    assert!(refused(0.75f64.next_up()) && !refused(1.5));
    // Above twice the largest reduced phase, or below nothing.
    assert!(refused(1.5708007) && refused(-1.5));
    // With 3·10⁻⁷ of room, which the other checks do not know of.
    let why = |off: f64| {
        let mut c = code::constants();
        c.half_pi[0] = (2.0 * (REDUCED - off) * f64::exp2(40.0)).round() * f64::exp2(-40.0);
        c.two_over_pi = &[1, 2];
        Phase::of(&c, Rounding::default())
            .err()
            .expect("wrong digits")
            .to_string()
    };
    let first = "the first part of";
    assert!(why(2.5e-7).starts_with(first) && !why(3.5e-7).starts_with(first));
}

#[test]
fn wrong_digits_are_refused() {
    let words = code::constants().two_over_pi;
    assert!(are_digits_of_two_over_pi(words).is_ok());
    for i in 0..words.len() {
        for bit in [0, 31, 63] {
            let mut wrong = words.to_vec();
            wrong[i] ^= 1 << bit;
            assert!(are_digits_of_two_over_pi(&wrong).is_err(), "{i} {bit}");
        }
    }
    static WRONG: [u64; 2] = [1, 2];
    let mut c = code::constants();
    c.two_over_pi = &WRONG;
    assert!(Phase::of(&c, Rounding::default()).is_err());
}

/// The polynomials are off the sine and the cosine by no more than their bounds, at the end by
/// nearly as much.
#[test]
fn polynomials_are_within_their_errors() {
    let c = code::constants();
    let float = |x: f64| Float::with_val(300, x);
    let [accurate, rounded] = polynomials(&c);
    // Σ c_j x^{first + 2j}
    let sum = |x: &Float, c: &[f64], first: u32| {
        let square = x.clone().square();
        let mut power = (0..first).fold(float(1.0), |p, _| p * x);
        let mut all = float(0.0);
        for c in c {
            all += power.clone() * *c;
            power *= &square;
        }
        all
    };
    let mut most = [0.0f64; 3];
    for i in 1..=20 {
        let x: Float = float(REDUCED) * f64::from(i) / 20.0;
        let third = (0..3).fold(float(1.0), |p, _| p * &x);
        let sixth = third * (float(c.sixth[0]) + c.sixth[1]);
        let minus: Vec<f64> = c.sin.iter().map(|x| -x).collect();
        let cosine = float(1.0) - x.clone().square() / 2 + sum(&x, &c.cos, 4);
        let off = [
            x.clone() - sixth + sum(&x, &c.sin_from_fifth, 5) - x.clone().sin(),
            x.clone() + sum(&x, &minus, 3) - x.clone().sin(),
            cosine - x.cos(),
        ];
        for (most, off) in most.iter_mut().zip(off) {
            *most = most.max(off.abs().to_f64());
        }
    }
    let bounds = [accurate[0], rounded[0], rounded[1]];
    assert_eq!(accurate[1], rounded[1]);
    for (most, bound) in most.into_iter().zip(bounds) {
        assert!(most <= bound && bound < 4.0 * most, "{most:e} {bound:e}");
    }
}
