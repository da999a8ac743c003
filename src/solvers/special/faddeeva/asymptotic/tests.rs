use super::super::branch::{
    Branch, IN_STRIP, RINGS, Ring, SERIES_2, SERIES_4, SERIES_6, SERIES_14, SERIES_26,
};
use super::super::tests::Random;
use super::super::tests::exact::{error, gaussian, rational, w, wide};
use super::*;
use crate::lanes::Plain;
use rug::{Float, Rational};

/// |z|² from which a formula serves above the real axis.
fn from(formula: Branch) -> f64 {
    let ring = RINGS.iter().find(|ring| ring.above == formula);
    ring.expect("on the ladder").from
}

/// |z| between which the series serves in the strip beside the real axis.
fn strip() -> [f64; 2] {
    let inside = |ring: &Ring| ring.strip == Some(IN_STRIP);
    let first = RINGS.iter().position(inside).expect("on the ladder");
    let after = RINGS[first..].iter().find(|ring| !inside(ring));
    [RINGS[first].from, after.expect("on the ladder").from].map(f64::sqrt)
}

#[test]
fn constants() {
    // Products rounded one after the other: half a unit each from the fourteenth on.
    let mut exact = Rational::from(1);
    for (n, a) in A.iter().enumerate() {
        if n > 0 {
            exact *= Rational::from((2 * n as u64 - 1, 2u32));
        }
        let off = (rational(*a) / &exact - 1u32).abs();
        let bound = f64::EPSILON / 2.0 * (n.max(13) - 13) as f64;
        assert!(off.to_f64() <= bound, "a_{n}");
    }
}

/// The sum of two terms that cancel, against the exact one, by the larger of the two.
fn check(a: f64, b: f64) -> f64 {
    let (re, im, _) = large(Plain, a, b);
    let exact = w(a, -b);
    let (u, v) = w(a, b);
    let (c, s) = gaussian(a, -b);
    let larger = |x: Float, y: Float| {
        let (x, y) = (x.abs(), y.abs());
        if x > y { x } else { y }
    };
    let worst = error(&wide(re), &exact.0, &larger(u, c * 2)).max(error(
        &wide(im),
        &exact.1,
        &larger(v, s * 2),
    ));
    // The factor 1 + 1/(2z²) + … is an f64 in its second part.
    let bound = 2f64.powi(-95) + 2f64.powi(-52) / (a * a);
    assert!(worst < bound, "{a:e} − {b:e} i: {worst:e}, bound {bound:e}");
    worst
}

#[test]
fn cancelling_terms() {
    let mut random = Random(51);
    let mut worst = 0.0f64;
    for k in 0..3000 {
        let a = random.power(12.0, if k % 3 == 0 { 300.0 } else { 26.0 });
        // e^{b² − a²} between e^-60 and e^10 as far as the digits of b allow.
        let b = a + random.between(-30.0, 5.0) / a;
        worst = worst.max(check(a, b));
        if a > 1e8 {
            worst = worst.max(check(a, a));
        }
    }
    println!("2^{:.1}", worst.log2());
}

#[test]
fn series_in_the_upper_half_plane() {
    // Both components to a tenth of a unit: the last term, and the roundings of the series' sum.
    let mut random = Random(52);
    for _ in 0..3000 {
        let (t, r) = (
            random.between(0.0, 90.0).to_radians(),
            random.power(0.0, 100.0),
        );
        let b = if random.below(3) == 0 {
            random.power(-300.0, 0.0)
        } else {
            t.sin()
        };
        type Series = fn(f64, f64) -> (Dd, Dd);
        let each: [(f64, Series); 3] = [
            (from(SERIES_26).sqrt(), series::<_, 26>),
            (from(SERIES_14).sqrt(), series::<_, 14>),
            (from(SERIES_6).sqrt(), series::<_, 6>),
        ];
        for (least, series) in each {
            let (a, b) = (
                least * (1.0 + 1e-9) * r * t.cos(),
                least * (1.0 + 1e-9) * r * b,
            );
            if a.hypot(b) < least {
                continue;
            }
            let (u, v) = series(a, b);
            let (re, im) = w(a, b);
            for (x, y) in [(u, re), (v, im)] {
                // Beside the real axis e^{−x²} is not part of the series.
                if b < 0.125 && a < 27.5 {
                    continue;
                }
                let off = error(&wide(x), &y, &y);
                assert!(
                    off < 0.3 * f64::EPSILON,
                    "from {least}: {a:e} + {b:e} i: {off:e}"
                );
            }
        }
    }
}

#[test]
fn rounded_far_out() {
    // Two roundings, the last term and what the corrections lose.
    let mut random = Random(53);
    for k in 0..6000 {
        let (t, r) = (random.between(0.0, 90.0).to_radians(), k % 2);
        let least = [SERIES_4, SERIES_2].map(from)[r].sqrt();
        let far = least * (1.0 + 1e-9) * random.power(0.0, 60.0);
        let (a, b) = match k % 3 {
            0 => (far, far * random.power(-200.0, 0.0)),
            1 => (far * random.power(-200.0, 0.0), far),
            _ => (far * t.cos(), far * t.sin()),
        };
        let got = match r {
            0 => series_rounded::<_, 4>(a, b),
            _ => two_terms(a, b),
        };
        let (re, im) = w(a, b);
        for (x, y) in [(got.0, re), (got.1, im)] {
            let off = error(&Float::with_val(64, x), &y, &y) / f64::EPSILON;
            assert!(off < 1.6, "{a:e} + {b:e} i: {off} eps");
        }
    }
}

#[test]
fn next_to_the_real_axis() {
    let mut random = Random(54);
    let [first, last] = strip();
    for k in 0..4000 {
        let a = match k {
            0 => first,
            1 => last,
            _ => random.between(first, last),
        };
        let (u, v) = series_next_to_real_axis(a);
        // Where b is so small that its powers do not count; e^{−z²} is not part of the series.
        let b = 2f64.powi(-150);
        let (re, im) = w(a, b);
        let re = (re - gaussian(a, b).0) / Float::with_val(64, b);
        for (x, y) in [(u, re), (v, im)] {
            let off = error(&Float::with_val(64, x), &y, &y) / f64::EPSILON;
            assert!(off < 1.3, "{a:e}: {off} eps");
        }
    }
}

#[test]
fn both_formulas_beside_the_real_axis() {
    // The edge between them: what one leaves out is nothing to the other.
    let mut random = Random(55);
    let [first, last] = strip();
    for _ in 0..4000 {
        let a = random.between(first, last);
        let near = series_next_to_real_axis(a);
        let strip = series_beside_real_axis::<_, 16>(a, 2f64.powi(-28));
        for (p, q) in [(near.0, strip.0), (near.1, strip.1)] {
            assert!(
                (p - q).abs() <= 2.0 * f64::EPSILON * q,
                "{a:e}: {p:e} {q:e}"
            );
        }
    }
}
