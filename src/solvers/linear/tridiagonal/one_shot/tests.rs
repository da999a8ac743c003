//! Against the sweep, the elimination with pivoting and rational arithmetic.

use super::super::{Pivoted, TridiagonalError as Error, solve as swept};
use super::*;
use crate::arithmetic::tests::Random;
use rug::Rational;

fn system(random: &mut Random, n: usize, dominance: f64) -> [Vec<f64>; 4] {
    let mut some = |n: usize| -> Vec<f64> { (0..n).map(|_| random.between(-1.0, 1.0)).collect() };
    let (lower, upper, mut diagonal, d) = (some(n - 1), some(n - 1), some(n), some(n));
    for b in &mut diagonal {
        *b += dominance.copysign(*b);
    }
    [lower, diagonal, upper, d]
}

/// The largest component of the exact residual over `|A||x|` and `|d|`.
fn backward_error([lower, diagonal, upper, d]: &[Vec<f64>; 4], x: &[f64]) -> f64 {
    let exact = |v: f64| Rational::from_f64(v).expect("finite");
    let n = x.len();
    let mut worst = 0.0f64;
    for i in 0..n {
        let (mut rest, mut size) = (exact(d[i]), exact(d[i].abs()));
        let mut term = |a: f64, x: f64| {
            rest -= exact(a) * exact(x);
            size += exact(a.abs()) * exact(x.abs());
        };
        term(diagonal[i], x[i]);
        if i > 0 {
            term(lower[i - 1], x[i - 1]);
        }
        if i + 1 < n {
            term(upper[i], x[i + 1]);
        }
        worst = worst.max((rest.abs() / size).to_f64());
    }
    worst
}

#[test]
fn solutions_of_every_length() {
    let mut random = Random(41);
    for n in (1..60).chain([1000, 1001, 8196, 8205, 8206, 17_000]) {
        let system = system(&mut random, n, 2.0);
        let [lower, diagonal, upper, d] = &system;
        let mut x = vec![7.0; n];
        solve_into(lower, diagonal, upper, d, &mut x).expect("dominant");
        assert!(backward_error(&system, &x) < 8.0 * f64::EPSILON, "{n}");
        let mut again = vec![7.0; n];
        let error = solve_into_with_error(lower, diagonal, upper, d, &mut again).expect("dominant");
        assert_eq!(x, again);
        let mut there = d.clone();
        let same = solve_in_place(lower, diagonal, upper, &mut there, true).expect("dominant");
        assert_eq!((&x, error.to_bits()), (&there, same.to_bits()));
        // Above Hager's estimate, which is from below, and the same but for that.
        let s = swept(lower, diagonal, upper, d)
            .expect("dominant")
            .stability;
        let skeel = error / (2.0 * f64::EPSILON);
        assert!(
            skeel > 0.9 * s.skeel && skeel < 30.0 * s.skeel,
            "{n} {skeel} {s:?}"
        );
    }
}

/// Matrices that are not dominant: the error is within its estimate.
#[test]
fn errors_within_their_estimates() {
    let mut random = Random(42);
    let mut large = 0;
    for _ in 0..2000 {
        let n = 1 + random.below(30) as usize;
        let [lower, diagonal, upper, d] = system(&mut random, n, 0.0);
        let mut x = vec![7.0; n];
        let Ok(error) = solve_into_with_error(&lower, &diagonal, &upper, &d, &mut x) else {
            continue;
        };
        let Ok(due) = Pivoted::factor(&lower, &diagonal, &upper).and_then(|a| a.solve(&d)) else {
            continue;
        };
        let size = due.iter().fold(0.0f64, |m, v| m.max(v.abs()));
        let off = x
            .iter()
            .zip(&due)
            .fold(0.0f64, |m, (p, q)| m.max((p - q).abs()));
        assert!(off <= error * size, "{n}: {} beside {error}", off / size);
        large += usize::from(error > 1e-12);
    }
    assert!(large > 20, "{large} hard matrices");
}

#[test]
fn refused_as_by_the_sweep() {
    let solve = |l: &[f64], b: &[f64], u: &[f64], d: &[f64]| {
        let mut x = d.to_vec();
        solve_into(l, b, u, d, &mut x).map(|()| x)
    };
    assert_eq!(
        solve(&[], &[], &[], &[]),
        Err(Error::TooFew { needed: 1, got: 0 })
    );
    assert!(matches!(
        solve(&[1.0], &[1.0], &[], &[1.0]),
        Err(Error::Length { name: "lower", .. })
    ));
    assert!(matches!(
        solve(&[1.0], &[1.0, 2.0], &[1.0], &[1.0]),
        Err(Error::Length {
            name: "right-hand side",
            ..
        })
    ));
    let inf = f64::INFINITY;
    for k in 0..3 {
        let mut bands = [vec![1.0, 1.0], vec![4.0, 4.0, 4.0], vec![1.0, 1.0]];
        bands[k][1] = inf;
        let [l, b, u] = &bands;
        let name = ["lower", "diagonal", "upper"][k];
        assert_eq!(
            solve(l, b, u, &[1.0; 3]),
            Err(Error::NotFinite {
                name,
                index: 1,
                value: inf
            })
        );
    }
    assert!(matches!(
        solve(&[1.0], &[4.0, 4.0], &[1.0], &[1.0, f64::NAN]),
        Err(Error::NotFinite {
            name: "right-hand side",
            index: 1,
            ..
        })
    ));
    assert_eq!(
        solve(&[1.0, 1.0], &[0.0, 4.0, 4.0], &[1.0, 1.0], &[1.0; 3]),
        Err(Error::Pivot { row: 0, value: 0.0 })
    );
    assert_eq!(
        solve(&[], &[2f64.powi(-1000)], &[], &[1e300]),
        Err(Error::Overflow { row: 0 })
    );
    // Products of entries that underflow or overflow are no reason.
    for scale in [1e-200, 1e200] {
        let x = solve(
            &[scale; 2],
            &[4.0 * scale; 3],
            &[scale; 2],
            &[5.0 * scale, 6.0 * scale, 5.0 * scale],
        );
        assert!(x.expect("solved").iter().all(|x| (x - 1.0).abs() < 1e-15));
    }
    // Pivots that vanish from one side alone: 1 and 1 − 1.
    let x = solve(&[1.0; 2], &[1.0; 3], &[1.0; 2], &[2.0, 3.0, 2.0]);
    assert_eq!(x, Ok(vec![1.0, 1.0, 1.0]));
}

/// Entries of any size, of neighbouring rows and of one: continuants leave their limits and are
/// set back, or the rows are eliminated one after the other.
#[test]
fn rows_of_any_scale() {
    let mut random = Random(43);
    for spread in [8.0, 60.0, 300.0, 600.0] {
        for n in [37, 200] {
            let mut system = system(&mut random, n, 2.0);
            let [lower, diagonal, upper, d] = &mut system;
            for i in 0..n {
                let scale = 2f64.powf(random.between(-spread, spread));
                diagonal[i] *= scale;
                d[i] *= scale;
                if i > 0 {
                    lower[i - 1] *= scale;
                }
                if i + 1 < n {
                    upper[i] *= scale;
                }
            }
            let mut x = vec![7.0; n];
            solve_into(&system[0], &system[1], &system[2], &system[3], &mut x).expect("dominant");
            assert!(
                backward_error(&system, &x) < 8.0 * f64::EPSILON,
                "{spread} {n}"
            );
        }
    }
}

/// Several right-hand sides are as many single ones, bit for bit; errors have their place in all.
#[test]
fn many_right_hand_sides() {
    let mut random = Random(45);
    for n in [1, 2, 3, 12, 13, 14, 15, 8300] {
        let [lower, diagonal, upper, _] = system(&mut random, n, 2.0);
        let many: Vec<f64> = (0..n * 11).map(|_| random.between(-1.0, 1.0)).collect();
        let solve = |mut x: Vec<f64>, diagonal: &[f64]| {
            solve_many_in_place(&lower, diagonal, &upper, &mut x).map(|()| x)
        };
        let single = |d: &[f64]| {
            let mut x = vec![0.0; n];
            solve_into(&lower, &diagonal, &upper, d, &mut x).map(|()| x)
        };
        let due: Vec<_> = many
            .chunks(n)
            .map(|d| single(d).expect("dominant"))
            .collect();
        assert_eq!(
            solve(many.clone(), &diagonal).expect("dominant"),
            due.concat()
        );
        for place in [0, n, 9 * n, 11 * n - 1] {
            let mut bad = many.clone();
            bad[place] = f64::NAN;
            let e = solve(bad, &diagonal).unwrap_err();
            assert!(
                matches!(e, Error::NotFinite { index, .. } if index == place),
                "{e} {place}"
            );
        }
        let mut bad = diagonal.clone();
        bad[n - 1] = f64::NAN;
        let e = solve(many, &bad).unwrap_err();
        assert!(matches!(e, Error::NotFinite { name: "diagonal", index, .. } if index == n - 1));
    }
}
