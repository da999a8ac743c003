use super::*;
use crate::pinned::units;
use rug::Float;

const ROUND: f64 = mechaudit_solvers::faddeeva::proof::ROUND;

fn float(x: f64) -> Float {
    Float::with_val(300, x)
}

/// `e^{h + l}` at points of an interval is within its errors in each form, and they are not idle.
#[test]
fn exponentials_at_points_are_within_their_errors() {
    let mut unit = units(29);
    let c = code::constants();
    let of_series = exponential_error(&c.exp, c.ln_2, MOST_EXPONENT);
    let mut most = [0.0f64; 3];
    for at in [
        [0.1, 0.12],
        [-0.3, -0.28],
        [500.2, 500.22],
        [-699.5, -699.48],
        [0.34, 0.36],
    ] {
        let e = of_exp(&Factors::default(), at).expect("a bound");
        let e = e.map(|x| sum_up(x, of_series));
        for _ in 0..200 {
            let h = at[0] + (at[1] - at[0]) * unit();
            let l = 0.5 * (h.abs().next_up() - h.abs()) * (2.0 * unit() - 1.0);
            let part = |value: Float, n: f64, x: Float| {
                let due = x.exp() >> (n - ROUND) as i32;
                ((value - &due) / due).abs().to_f64()
            };
            let ((hi, lo), n) = code::exp((h, l));
            let (rounded, m) = code::exp_rounded((h, l));
            let (short, k) = code::exp_short(h);
            let off = [
                part(float(hi) + lo, n, float(h) + l),
                part(float(rounded), m, float(h) + l),
                part(float(short), k, float(h)),
            ];
            for (i, bound) in [e.pair, e.rounded, e.short].into_iter().enumerate() {
                assert!(off[i] <= bound, "{i} {h} {l} {} {bound}", off[i]);
                most[i] = most[i].max(off[i] / bound);
            }
        }
    }
    assert!(most[0] > 1e-3 && most[1] > 0.3 && most[2] > 0.3, "{most:?}");
    // A low part that is left out is missing.
    let both = |at| {
        let without = Factors {
            low_part: false,
            ..Factors::default()
        };
        [Factors::default(), without].map(|f| of_exp(&f, at).expect("a bound"))
    };
    let at = [3.0, 3.02];
    let [sound, faulty] = both(at);
    assert!(faulty.pair >= sound.pair && faulty.pair > 0.9 * low(at));
    assert!(faulty.rounded > sound.rounded + 0.9 * low(at));
    assert!(faulty.pair < sound.pair + 1.1 * low(at));
    assert!(faulty.rounded < sound.rounded + 1.1 * low(at));
    // One that is handed on is rounded too, which is little.
    let at = [0.5, 0.51];
    let [sound, faulty] = both(at);
    let more = sound.pair / (faulty.pair - product_up(1.01, low(at))) - 1.0;
    assert!(more > 1e-11 && more < 1e-9, "{more:e}");
}

/// Sine and cosine of a reduced phase and its low part, without what the phase itself is wrong by.
#[test]
fn circles_at_points_are_within_their_errors() {
    let mut unit = units(29);
    let c = code::constants();
    let none = Phase {
        error: 0.0,
        short: 0.0,
        boxes: 0,
    };
    let polynomials = phase::polynomials(&c);
    let mut most = [0.0f64; 3];
    for at in [[0.7, 0.705], [-0.3, -0.295], [0.001, 0.0012], [0.78, 0.785]] {
        let found = of_circle(&Factors::default(), &none, polynomials, at).expect("a bound");
        for _ in 0..200 {
            let h = at[0] + (at[1] - at[0]) * unit();
            let l = 0.5 * (h.abs().next_up() - h.abs()) * (2.0 * unit() - 1.0);
            let (s, c) = (float(h) + l).sin_cos(float(0.0));
            let length =
                |p: Float, q: Float| ((p - &s).square() + (q - &c).square()).sqrt().to_f64();
            let [(sh, sl), (ch, cl)] = code::sin_cos((h, l));
            let (p, q) = code::sin_cos_rounded((h, l));
            let (t, u) = code::sin_cos_leading((h, l));
            let off = [
                length(float(sh) + sl, float(ch) + cl),
                length(float(p), float(q)),
                length(float(t), float(u)),
            ];
            for (i, bound) in [found.pair, found.rounded, found.leading]
                .into_iter()
                .enumerate()
            {
                assert!(off[i] <= bound, "{i} {h} {l} {} {bound}", off[i]);
                most[i] = most[i].max(off[i] / bound);
            }
        }
        // The error of the phase is added to each.
        let off = Phase {
            error: 1e-3,
            ..none
        };
        let more = of_circle(&Factors::default(), &off, polynomials, at).expect("a bound");
        for (p, q) in [
            (found.pair, more.pair),
            (found.rounded, more.rounded),
            (found.leading, more.leading),
        ] {
            assert!((q - p - 1e-3).abs() < 1e-12);
        }
        // So are the polynomials, each component by itself.
        let polynomials = [[3e-3, 4e-3], [6e-3, 8e-3]];
        let more = of_circle(&Factors::default(), &none, polynomials, at).expect("a bound");
        let due = [5e-3, 1e-2, 1e-2];
        for (found, due) in [more.pair, more.rounded, more.leading].into_iter().zip(due) {
            assert!(found >= due && found < due + 1e-12);
        }
    }
    assert!(most[0] > 1e-3 && most[1] > 0.2 && most[2] > 0.2, "{most:?}");
}

/// Each interval begins where the one before it ends; none is longer than the step.
#[test]
fn arguments_are_covered() {
    for (lo, hi, step) in [(0.0, 1.0, 0.25), (-0.7, 0.9, 0.3), (2.0, 2.1, 1.0)] {
        let all = intervals(lo, hi, step);
        assert_eq!((all[0][0], all[all.len() - 1][1]), (lo, hi));
        assert!(all.windows(2).all(|p| p[0][1] == p[1][0]));
        assert!(
            all.iter()
                .all(|[p, q]| p < q && q - p <= step * (1.0 + 1e-12))
        );
        assert!(all.len() as f64 <= (hi - lo) / step + 1.0);
    }
    let all = arguments();
    assert!(all[0][0] <= LEAST && all[all.len() - 1][1] >= MOST);
    assert!(all.windows(2).all(|p| p[0][1] == p[1][0]));
    // At most one edge between two k in each, and those that hold one are narrow.
    let ln_2 = std::f64::consts::LN_2;
    for [p, q] in &all {
        let edges = ((q / ln_2 + 0.5).floor() - (p / ln_2 + 0.5).floor()) as i32;
        assert!(edges == 0 || (edges == 1 && q - p < 1e-8), "{p} {q}");
        assert!(q - p < 0.04);
    }
    // The range where the solver computes it, and what is beyond.
    assert!(LEAST.exp() < 2f64.powi(-1000) && MOST > 1024.0 * ln_2);
    assert!(MOST_EXPONENT > MOST / ln_2 && MOST_EXPONENT > (1.0 - LEAST) / ln_2);
    for (at, due) in [
        ([1.0, 1.5], U),
        ([-3.0, 1.0], 2.0 * U),
        ([0.0, 0.3], 0.25 * U),
    ] {
        assert_eq!(low(at), due);
    }
}

/// `(1 + p)(1 + q) − 1`, what the argument is wrong by, and the roundings of the product.
#[test]
fn factors_are_multiplied() {
    let e = Errors {
        pair: 1e-3,
        rounded: 2e-3,
        short: 3e-3,
        leading: 4e-3,
    };
    let t = Errors {
        pair: 5e-3,
        rounded: 6e-3,
        short: 7e-3,
        leading: 8e-3,
    };
    let found = Exponential::together(e, t, 17);
    let near = |x: f64, due: f64| x >= due && x <= due * (1.0 + 1e-11);
    let both = |p: f64, q: f64| (1.0 + p) * (1.0 + q) - 1.0;
    assert!(near(found.pair, both(1e-3, 5e-3) - 1e-18));
    assert!(near(found.rounded, both(2e-3, 6e-3)));
    assert!(near(found.short[0], both(3e-3, 7e-3)));
    assert_eq!((found.leading, found.boxes), (8e-3, 17));
    assert!(near(found.short[1], 3.01 * U));
    // Without errors of the factors the argument's and the product's are left.
    let none = Exponential::together(Errors::default(), Errors::default(), 0);
    assert!(near(none.pair, (712.0 * 9.0 + 8.0) * U * U));
    assert!(near(none.rounded, U + 712.0 * 9.0 * U * U) && near(none.short[0], U));
    let most = e.max(t);
    assert_eq!(
        [most.pair, most.rounded, most.short, most.leading],
        [5e-3, 6e-3, 7e-3, 8e-3]
    );
    let most = t.max(e);
    assert_eq!(
        [most.pair, most.rounded, most.short, most.leading],
        [5e-3, 6e-3, 7e-3, 8e-3]
    );
}

/// `|l| x⁴/24`, `|l| x²/2`, `|l| (|x|³/6 + l²)`, and no less than the differences are.
#[test]
fn a_low_part_is_turned_nearly() {
    for (x, l) in [(0.79, 1e-16), (0.3, 2e-17), (0.01, 1e-18), (0.5, 1e-3)] {
        let found = of_low_part(x, l);
        let due = [
            l * x.powi(4) / 24.0,
            l * x * x / 2.0,
            l * (x.powi(3) / 6.0 + l * l),
        ];
        for (f, d) in found.iter().zip(due) {
            assert!(
                *f >= d * (1.0 - 1e-15) && *f <= d * (1.0 + 1e-14),
                "{x} {l}"
            );
        }
        let less = [
            (l * (x.cos() - (1.0 - x * x / 2.0))).abs(),
            (l * (x.cos() - 1.0)).abs(),
            (l * (x.sin() - x)).abs(),
        ];
        for (f, least) in found.iter().zip(less) {
            assert!(
                *f >= least && *f < 1.3 * least + l * l * l,
                "{x} {l} {f} {least}"
            );
        }
    }
    // Half a unit in the last place.
    assert_eq!(low([-3.0, 1.0]), 2f64.powi(-52));
    assert_eq!(low([0.25, 0.5]), 2f64.powi(-54));
    assert_eq!(low([0.0, 1e-320]), f64::from_bits(1));
}
