//! Zeros of trigonometric polynomials, and what each bound counts for.

use super::super::laurent::Laurent;
use super::*;
use crate::draw::Draw;
use std::f64::consts::{PI, TAU};

/// `Π (cos(θ − m) − cos d)`, with a zero at every `m ± d`.
fn with_zeros(pairs: &[(f64, f64); 3], bits: u32) -> Trigonometric {
    let exact = |x: f64| Ball::exact(bits, x);
    let factor = |(m, d): &(f64, f64)| {
        let turn = ComplexBall::unit(&exact(*m)).scaled(&exact(0.5));
        let level = ComplexBall::new(-exact(*d).sin_cos().1, exact(0.0));
        Laurent::new(1, vec![turn.clone(), level, turn.conj()])
    };
    let [a, b, c] = pairs.each_ref().map(factor);
    let t = a.mul(&b).mul(&c);
    Trigonometric::new(bits, (0..=3).map(|k| t.at(k).unwrap().clone()).collect())
}

/// Each interval holds one zero, and each zero lies in one; zeros 2^−9 apart are still told apart.
#[test]
fn all_zeros_are_isolated() {
    let mut draw = Draw(1);
    let mut unit = || (draw.next() >> 11) as f64 / (1u64 << 53) as f64;
    for case in 0..60 {
        let narrow = f64::from(case % 6);
        let pairs = [(); 3].map(|()| (TAU * unit(), PI * (0.05 + 0.9 * unit())));
        let mut pairs = pairs;
        pairs[0].1 = (-1.0 - 2.0 * narrow).exp2();
        let t = with_zeros(&pairs, 64);
        let zeros = pairs.map(|(m, d)| [m - d, m + d]).concat();
        let apart = |x: f64, y: f64| {
            let way = (x - y).rem_euclid(TAU);
            way.min(TAU - way)
        };
        let (lo, found) = (-2.71875, t.isolate());
        let near = zeros.iter().any(|z| apart(*z, lo) < 1e-3);
        let Ok(found) = found else {
            assert!(near, "{pairs:?}");
            continue;
        };
        assert_eq!(found.len(), 6, "{pairs:?}");
        for (a, b) in &found {
            let (low, high) = (a.to_f64(), b.to_f64());
            let inside = |z: &&f64| (**z - low).rem_euclid(TAU) < high - low;
            assert_eq!(
                zeros.iter().filter(inside).count(),
                1,
                "{pairs:?} {low} {high}"
            );
            let x = t.approximate(a, b).to_f64();
            assert!(zeros.iter().any(|z| apart(*z, x) < 1e-9), "{pairs:?} {x}");
        }
    }
}

/// A double zero, one on a cut, and none at all.
#[test]
fn double_zeros_are_undecided() {
    let why = |pairs: &[(f64, f64); 3]| with_zeros(pairs, 53).isolate().unwrap_err();
    let double = why(&[(1.0, 0.0), (0.3, 0.5), (2.0, 1.0)]);
    assert_eq!(double.bits, 53);
    assert!(double.reason.contains("too close"), "{double:?}");
    // On the first cut, and on the second, which is an f64 at this precision.
    for at in [-2.71875, TAU / 12.0 - 2.71875] {
        let cut = why(&[(at + 0.5, 0.5), (0.3, 0.5), (2.0, 1.0)]);
        assert!(cut.reason.contains("cut"), "{cut:?}");
    }
    // 5/4 + cos θ in every factor.
    let mut none = with_zeros(&[(1.0, 0.3); 3], 64);
    for (k, c) in [(0, 2.0), (1, 0.3), (2, 0.2), (3, 0.1)] {
        none.c[k] = real(c, 0.0);
    }
    assert!(none.isolate().unwrap().is_empty());
}

fn ball(mid: f64, rad: f64) -> Ball {
    Ball::exact(64, mid).widened(Mag::from_f64(rad))
}

fn real(mid: f64, rad: f64) -> ComplexBall {
    ComplexBall::new(ball(mid, rad), Ball::integer(64, 0))
}

/// Both conditions count the width of T and of T', each against what it is compared with:
/// half-width 1/4.
#[test]
fn how_many_zeros_an_interval_can_hold() {
    // T, T', each with a radius; the bound on |T''|.
    for ((t, slope, curvature), due) in [
        // |T'| r + L r²/2 is 1/4 + 1/4.
        ((0.51, 0.0, 1.0, 0.0, 8.0), Zeros::None),
        ((-0.51, 0.0, -1.0, 0.0, 8.0), Zeros::None),
        ((0.49, 0.0, 1.0, 0.0, 8.0), Zeros::Unknown),
        ((0.61, 0.11, 1.0, 0.0, 8.0), Zeros::Unknown),
        ((0.51, 0.0, 0.5, 0.6, 8.0), Zeros::Unknown),
        ((0.51, 0.0, 1.0, 0.0, 8.5), Zeros::Unknown),
        // L r is 1.
        ((0.0, 0.0, 1.01, 0.0, 4.0), Zeros::AtMostOne),
        ((0.0, 0.0, -1.01, 0.0, 4.0), Zeros::AtMostOne),
        ((0.0, 0.0, 0.99, 0.0, 4.0), Zeros::Unknown),
        ((0.0, 0.0, 1.01, 0.02, 4.0), Zeros::Unknown),
        ((0.0, 0.0, 1.01, 0.0, 4.1), Zeros::Unknown),
    ]
    .map(|((t, dt, s, ds, l), due)| ((ball(t, dt), ball(s, ds), Mag::from_f64(l)), due))
    {
        let found = zeros_within(&t, &slope, curvature, Mag::from_f64(0.25));
        assert_eq!(found, due, "{t:?} {slope:?} {curvature:?}");
    }
    // Bounds that are just met show nothing.
    let (r, one, l) = (Mag::from_f64(0.25), Mag::from_f64(1.0), Mag::from_f64(8.0));
    let reach = one.mul(r).add(l.mul(r).mul(r).shift(-1)).to_f64();
    let bend = l.mul(r).to_f64();
    for ((t, slope), due) in [
        ((reach, 1.0), Zeros::Unknown),
        ((reach.next_up(), 1.0), Zeros::None),
        ((0.0, bend), Zeros::Unknown),
        ((0.0, bend.next_up()), Zeros::AtMostOne),
    ] {
        assert_eq!(zeros_within(&ball(t, 0.0), &ball(slope, 0.0), l, r), due);
    }
}

/// The larger side, to the last bit, and not below it.
#[test]
fn half_widths_reach_to_the_further_end() {
    let float = |x: f64| Float::with_val(64, x);
    let width = |lo: f64, mid: f64, hi: f64| half_width(&float(lo), &float(mid), &float(hi));
    for (ends, due) in [
        ((1.0, 1.25, 1.5), 0.25),
        ((1.0, 1.25, 2.0), 0.75),
        ((-1.0, 1.25, 2.0), 2.25),
    ] {
        let found = width(ends.0, ends.1, ends.2);
        assert!(found >= Mag::from_f64(due) && found <= Mag::from_f64(due * (1.0 + 1e-14)));
    }
    // More bits than a bound has.
    let long = Float::with_val(64, 1) - Float::with_val(64, Float::i_exp(1, -60));
    let (zero, least) = (float(0.0), float(0.25));
    assert!(half_width(&zero, &zero, &long).to_float() >= long);
    assert!(half_width(&zero, &long, &long).to_float() >= long);
    assert!(half_width(&least, &long, &long).to_float() >= Float::with_val(64, &long - &least));
}

#[test]
fn signs_are_told_or_not() {
    let of = |a: (f64, f64), b: (f64, f64)| changes_sign(&ball(a.0, a.1), &ball(b.0, b.1));
    assert_eq!(of((1.0, 0.5), (2.0, 1.0)), Some(false));
    assert_eq!(of((-1.0, 0.5), (-2.0, 1.0)), Some(false));
    assert_eq!(of((1.0, 0.5), (-2.0, 1.0)), Some(true));
    assert_eq!(of((-1.0, 0.5), (2.0, 1.0)), Some(true));
    assert_eq!(of((1.0, 1.5), (2.0, 1.0)), None);
    assert_eq!(of((1.0, 0.5), (2.0, 2.5)), None);
    assert_eq!(of((0.0, 0.0), (2.0, 1.0)), None);
}

/// 2 Σ k² |c_k|, with the widths of the coefficients and both their parts.
#[test]
fn the_curvature_counts_every_coefficient_whole() {
    let c = [
        real(100.0, 50.0),
        real(-1.0, 0.5),
        real(2.0, 0.0),
        real(0.0, 0.25),
    ];
    let mut c = c.to_vec();
    c[2].im = ball(-3.0, 1.0);
    let t = Trigonometric::new(64, c);
    // 1.5 + 4 (2 + 4) + 9/4.
    let due = 2.0 * (1.5 + 24.0 + 2.25);
    assert!((t.curvature.to_f64() - due).abs() < 1e-9 && t.curvature >= Mag::from_f64(due));
    let coarse = t.with_prec(32);
    assert_eq!((t.bits(), coarse.bits()), (64, 32));
    assert!(coarse.curvature >= t.curvature);
}

/// T's distance from zero against what it can change by over a gap, which has a width of its own.
#[test]
fn a_gap_is_closed_by_the_slope() {
    // 1 + 2 cos θ · 1/4: at 0 it is 1.5, and the bound on the slope 1/2.
    let t = Trigonometric::new(64, [1.0, 0.25, 0.0, 0.0].map(|c| real(c, 0.0)).to_vec());
    let keeps = |gap: Ball| t.keeps_its_sign(&Float::new(64), &gap);
    assert!(keeps(ball(2.9, 0.0)) && keeps(ball(-2.9, 0.0)) && keeps(ball(2.0, 0.9)));
    assert!(!keeps(ball(3.1, 0.0)) && !keeps(ball(-3.1, 0.0)) && !keeps(ball(2.0, 1.1)));
    // Just what T is from zero.
    let gaps = (0..9).map(|k| 3.0 - f64::from(k) * f64::EPSILON);
    let mut just = 0;
    for gap in gaps {
        let change = t.curvature.mul(Mag::from_f64(gap));
        assert_eq!(keeps(ball(gap, 0.0)), change < Mag::from_f64(1.5), "{gap}");
        just += u32::from(change == Mag::from_f64(1.5));
    }
    assert!(just > 0);
    let wide = Trigonometric::new(
        64,
        vec![
            real(1.0, 0.5),
            real(0.25, 0.0),
            real(0.0, 0.0),
            real(0.0, 0.0),
        ],
    );
    assert!(!wide.keeps_its_sign(&Float::new(64), &ball(2.1, 0.0)));
    assert!(wide.keeps_its_sign(&Float::new(64), &ball(1.9, 0.0)));
}

/// T' and the bound on |T''| against differences.
#[test]
fn slope_and_curvature() {
    let t = with_zeros(&[(0.4, 0.9), (0.3, 0.5), (2.0, 1.0)], 128);
    let step = (-20f64).exp2();
    let at = |x: f64| t.value(&Float::with_val(128, x));
    let bound = t.curvature.to_f64();
    let mut most = 0.0f64;
    for k in 0..64 {
        let theta = f64::from(k) * TAU / 64.0;
        let (before, here, after) = (at(theta - step), at(theta), at(theta + step));
        let slope = (&after.0 - &before.0).to_f64() / (2.0 * step);
        let second = (&after.1 - &before.1).to_f64() / (2.0 * step);
        assert!((slope - here.1.to_f64()).abs() < 1e-9 * bound, "{theta}");
        assert!(second.abs() <= bound, "{theta}");
        most = most.max(second.abs());
    }
    assert!(most > 0.2 * bound, "{most} {bound}");
}

/// Zeros at `1 ± 2^(−k/4)` are told apart up to a k that grows with the bits.
#[test]
fn how_near_zeros_may_be() {
    let last = [32, 48, 64].map(|bits| {
        let told = |k: &u32| {
            let d = (-f64::from(*k) / 4.0).exp2();
            with_zeros(&[(1.0, d), (0.3, 0.5), (2.0, 1.0)], bits)
                .isolate()
                .is_ok()
        };
        (8u32..).take_while(told).last()
    });
    assert_eq!(last, [13, 32, 44].map(Some));
}
