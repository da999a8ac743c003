use super::super::branch::{CELL, SERIES_26, formula_at};
use super::super::plane;
use super::super::rows;
use super::super::tables::ZEROS;
use super::super::tests::Random;
use super::super::tests::exact::{error, float, w};
use super::*;
use crate::lanes::Plain;

/// `2|e^{−z²}|` over the smaller component of w at the mirror image.
fn ratio(a: f64, b: f64) -> f64 {
    let (u, v) = w(a, b);
    2.0 * (b * b - a * a).exp() / u.to_f64().min(v.to_f64())
}

/// Where w(−z) dominates, no component can vanish; where `2e^{−z²}` is left out, it is below a
/// quarter of a unit in the last place. Both along the curves where it is largest.
#[test]
fn limits() {
    let mut met = [0; 2];
    for step in 0..400 {
        let b = 0.125 + 0.02 * f64::from(step);
        for (k, (limit, bound)) in [(DOMINANT, 0.2), (NEGLIGIBLE, 2f64.powi(-54))]
            .into_iter()
            .enumerate()
        {
            let a = b.hypot(limit.sqrt());
            if matches!(formula_at(a, -b), CELL | SERIES_26) {
                met[k] += 1;
                assert!(ratio(a, b) < bound, "{a} {b}: {}", ratio(a, b));
            }
        }
    }
    assert!(met.iter().all(|&n| n > 150), "{met:?}");
    // Nor are zeros of w where the exponential dominates.
    for row in &ZEROS {
        let decay = decay(row.0[0], row.0[3]);
        // It changes by at most 2 (a + b)/16 within the square.
        assert!(decay.abs() + (row.0[0] - row.0[3]) / 8.0 < DOMINANT);
    }
}

/// The points where one term dominates: each component by itself.
#[test]
fn one_term_dominates() {
    let mut random = Random(131);
    let (mut met, mut worst) = ([0; 3], 0.0f64);
    for _ in 0..40_000 {
        let (a, b) = (random.between(0.0, 10.6), random.between(0.125, 10.6));
        let class = match (formula_at(a, -b), decay(a, b)) {
            (CELL, d) if d > DOMINANT => 0,
            (CELL, d) if d < -DOMINANT => 1,
            (SERIES_26, d) if d > DOMINANT => 2,
            _ => continue,
        };
        met[class] += 1;
        let (re, im) = plane::w(Plain, a, -b);
        let exact = w(a, -b);
        let off = error(&float(re), &exact.0, &exact.0).max(error(&float(im), &exact.1, &exact.1));
        worst = worst.max(off);
        assert!(off < 2.5 * f64::EPSILON, "{a} -{b}: {off:e}");
    }
    println!("{} ε", worst / f64::EPSILON);
    assert!(met.iter().all(|&n| n > 2000), "{met:?}");
}

/// Next to the zero curves of the components where the exponential dominates, the terms cancel and
/// this is told; a component that is not told keeps its digits.
#[test]
fn cancellation_is_told() {
    let mut random = Random(132);
    let mut told = 0;
    for _ in 0..4000 {
        // cos 2ab or sin 2ab small, b² − a² from 7 to 20.
        let (a, d) = (random.between(0.3, 4.0), random.between(7.1, 20.0));
        let b = a.hypot(f64::sqrt(d));
        let quarter = std::f64::consts::FRAC_PI_2;
        let phase = (2.0 * a * b / quarter).round().max(1.0) * quarter;
        let a = phase / (2.0 * b);
        let a = a * (1.0 + random.between(-0.5, 0.5) * decay(a, b).exp() / phase);
        if formula_at(a, -b) != CELL || decay(a, b) >= -DOMINANT {
            continue;
        }
        let (row, dx, dy) = rows::in_cell(a, b);
        let image = super::super::taylor::complex_row_rounded(Plain, row, dx, dy);
        let (re, im, lost) = exponential_dominates(image, a, -b);
        let exact = w(a, -b);
        let off = error(&float(re), &exact.0, &exact.0).max(error(&float(im), &exact.1, &exact.1));
        assert!(lost || off < 4.0 * f64::EPSILON, "{a} -{b}: {off:e}");
        told += usize::from(lost);
    }
    assert!(told > 300, "{told}");
}

/// Around zeros values are told whose components are both small, though neither is small beside its
/// terms.
#[test]
fn cancellation_of_both_components_is_told() {
    let mut random = Random(133);
    let mut met = [0; 2];
    for k in 13..60 {
        let zero = mechaudit_reference::faddeeva::zero(k, 60).unwrap();
        let at = [zero.re.mid().to_f64(), zero.im.mid().to_f64()];
        for _ in 0..40 {
            // |w| from a twentieth to a half of |w(−z)|, as w is (2i/√π) δ.
            let size = random.between(0.025, 0.25) / at[0].hypot(at[1]);
            let (s, c) = random.between(0.0, std::f64::consts::TAU).sin_cos();
            let (a, b) = (at[0] + size * c, -(at[1] + size * s));
            let (u, v) = super::super::asymptotic::series::<_, 26>(a, b);
            let e = crate::exponential::exp_minus_square_any(a, -b);
            let (re, im, lost) = reflect((u, v), e, close(a, b));
            let (p, q) = (re.abs() / u.hi, im.abs() / v.hi);
            let larger = re.abs().max(im.abs()) / u.hi.max(v.hi);
            if p.min(q) > CANCELLED {
                met[usize::from(lost)] += 1;
                assert_eq!(lost, larger < BOTH_CANCELLED, "{a} -{b}: {larger}");
            }
        }
    }
    assert!(met.iter().all(|n| *n > 200), "{met:?}");
}
