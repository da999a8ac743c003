//! Phases reduced modulo π/2, of any size.

use super::super::exponential::{self, LARGE_PHASE, phase};
use super::super::payne_hanek::reduce;
use super::Random;
use super::exact::pi;
use crate::double_double::Dd;
use crate::real::ROUND;
use rug::float::Constant;
use rug::{Float, Integer};
use std::f64::consts::FRAC_PI_4;

/// Digits: 2048 for the largest phase, 212 for what is left, and some.
const WIDE: u32 = 2560;

/// `2 a y − k π/2`.
fn rest(a: f64, y: f64, k: &Integer) -> Float {
    let phase = Float::with_val(WIDE, a) * y * 2u32;
    phase - Float::with_val(WIDE, k * pi(WIDE)) / 2u32
}

/// The multiple of π/2 next to `2 a y`.
fn multiple(a: f64, y: f64) -> Integer {
    let phase = Float::with_val(WIDE, a) * y * 2u32;
    (phase * 2u32 / pi(WIDE))
        .round()
        .to_integer()
        .expect("finite")
}

/// Absolute and relative error, after a check of the quadrant.
fn errors(a: f64, y: f64, (r, n): (Dd, f64)) -> (f64, f64) {
    let mut k = multiple(a, y);
    let quadrant = (n - ROUND) as i64;
    let off = Integer::from(quadrant - &k).mod_u(4);
    if off != 0 {
        // Next to an odd multiple of π/4 either neighbour will do.
        let step = if off == 1 { 1 } else { -1 };
        assert!(
            off != 2 && r.hi.abs() > 0.785,
            "{a:e} {y:e}: quadrant {quadrant}, {r:?}"
        );
        k += step;
    }
    let exact = rest(a, y, &k);
    let d = (Float::with_val(WIDE, r.hi) + r.lo - &exact).abs();
    assert!(r.hi.abs() < FRAC_PI_4 + 1e-7, "{a:e} {y:e}: {r:?}");
    (d.to_f64(), (d / exact).abs().to_f64())
}

fn check(a: f64, y: f64) {
    let (absolute, relative) = errors(a, y, reduce(a, y));
    // Two f64 of the product with π/2, and what the window leaves out: 2⁻¹⁰⁴ and 2⁻²⁰⁸.
    assert!(absolute < 2f64.powi(-104), "{a:e} {y:e}: {absolute:e}");
    assert!(
        relative < 2f64.powi(-100),
        "{a:e} {y:e}: relative {relative:e}"
    );
}

#[test]
fn phases_of_any_size() {
    let mut random = Random(11);
    for k in 0..6000 {
        let sum = random.between(30.0, 2040.0);
        let e = random.between((sum - 1020.0).max(-1000.0), 1020.0f64.min(sum + 1000.0));
        let (a, y) = (
            random.significand() * e.floor().exp2(),
            random.number(0, 0) * (sum - e).floor().clamp(-1022.0, 1023.0).exp2(),
        );
        if !((a * y).abs() * 2.0 >= LARGE_PHASE) {
            continue;
        }
        check(a, y);
        if k % 4 == 0 {
            let x = random.significand() * random.between(15.0, 1022.0).floor().exp2();
            check(x, x);
            check(x, -x);
            check(x, x.next_up());
        }
    }
    for x in [1e154, 1e200, 1e300, f64::MAX, 65536.0, 2f64.powi(1023)] {
        check(x, x);
        check(x, -x);
        check(x, 1.0);
    }
    // One factor subnormal.
    check(f64::MAX, 5e-324 * 12345.0);
    check(5e-324, f64::MAX);
}

/// Numbers `q 2^e` next to a multiple of π/2: q are the denominators of the convergents of
/// `2^(e+1)/π`, so that `|2^e q − p π/2| < (π/2)/q`.
#[test]
fn tiny_rests() {
    let mut random = Random(12);
    let mut smallest = 1.0f64;
    for e in (-20..970).step_by(3) {
        let ratio: Float = Float::with_val(WIDE, 1) << (e + 1);
        let mut x: Float = ratio / Float::with_val(WIDE, Constant::Pi);
        x.fract_mut();
        let (mut before, mut q) = (Integer::from(0), Integer::from(1));
        loop {
            let t = Float::with_val(WIDE, x.recip_ref());
            let whole = t
                .to_integer_round(rug::float::Round::Down)
                .expect("finite")
                .0;
            let next = Integer::from(&whole * &q) + &before;
            if next.significant_bits() > 53 {
                break;
            }
            (before, q) = (q, next);
            x = t - whole;
        }
        // 2 a y = q 2^e, the power of two distributed by chance.
        let shift = random.between(-400.0, 400.0).floor();
        let (a, y) = (
            q.to_f64() * shift.exp2(),
            (f64::from(e) - 1.0 - shift).clamp(-1022.0, 1023.0).exp2(),
        );
        if !(a * y * 2.0 >= LARGE_PHASE && a.is_finite())
            || a * y * 2.0 != q.to_f64() * f64::from(e).exp2()
        {
            continue;
        }
        check(a, y);
        check(a, -y);
        smallest = smallest.min(reduce(a, y).0.hi.abs());
    }
    // The worst of all f64 (Muller, *Elementary Functions*, table of worst cases): 2⁻⁶¹ about.
    let x = 6_381_956_970_095_103.0 * 2f64.powi(797);
    check(x, 0.5);
    smallest = smallest.min(reduce(x, 0.5).0.hi.abs());
    assert!(smallest < 5e-19, "{smallest:e}");
}

/// Both reductions below their common limit.
#[test]
fn reductions_agree() {
    let mut random = Random(13);
    for _ in 0..4000 {
        let (a, y) = (random.power(-8.0, 15.0), random.number(-8, 13));
        let theta = phase(a, y);
        if theta.hi.abs() >= LARGE_PHASE {
            continue;
        }
        let (x, n) = exponential::reduce(theta);
        let (absolute, _) = errors(a, y, (x, n));
        assert!(absolute < 2f64.powi(-104), "{a:e} {y:e}: {absolute:e}");
        if theta.hi.abs() > 1.0 {
            check(a, y);
        }
    }
}
