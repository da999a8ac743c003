//! Tests of `banded`.

use super::*;
use proptest::prelude::*;

fn q(v: &[i32]) -> Vec<Rational> {
    v.iter().map(|&v| Rational::from(v)).collect()
}

/// Every row the same.
fn constant(n: usize, lower: usize, row: &[i32]) -> Banded {
    let entries = (0..n).flat_map(|_| q(row)).collect();
    Banded::new(n, lower, row.len() - 1 - lower, entries).unwrap()
}

#[test]
fn long_systems_are_solved() {
    // Second differences, of condition n²: d = (1, 0, …) has x_i = (n − i)/(n + 1).
    let n = 2000;
    let a = constant(n, 1, &[-1, 2, -1]);
    let mut d = vec![Rational::new(); n];
    d[0] = Rational::from(1);
    let x = solve(&a, &d, 64).unwrap();
    for (i, x) in x.iter().enumerate() {
        let due = Rational::from(((n - i) as u32, n as u32 + 1));
        assert!(x.contains(&due) && x.accuracy_bits() >= 64, "{i}");
    }
    // Not symmetric, of a wider band, and with entries that are no floating-point numbers.
    let n = 600;
    let entry =
        |k: usize| Rational::from(((k * 7 % 11) as i32 - 5 + if k % 6 == 2 { 40 } else { 0 }, 3));
    let a = Banded::new(n, 2, 3, (0..6 * n).map(entry).collect()).unwrap();
    let due: Vec<Rational> = (0..n as i32)
        .map(|i| Rational::from((i - 300, 7)))
        .collect();
    let x = solve(&a, &a.times(&due), 100).unwrap();
    for (x, due) in x.iter().zip(&due) {
        assert!(x.contains(due) && (*due == 0 || x.accuracy_bits() >= 100));
    }
}

#[test]
fn only_the_band_is_looked_at() {
    let one = Rational::from(1);
    let a = Banded::new(2, 1, 1, q(&[99, 2, 1, 1, 2, 99])).unwrap();
    assert_eq!(a.dense().entries(), q(&[2, 1, 1, 2]));
    assert_eq!(a.times(&[one.clone(), one.clone()]), q(&[3, 3]));
    let wide = Banded::new(2, 3, 2, q(&[9, 9, 9, 1, 2, 9, 9, 9, 3, 4, 9, 9])).unwrap();
    assert_eq!(wide.dense().entries(), q(&[1, 2, 3, 4]));
    let x = solve(&wide, &q(&[5, 11]), 53).unwrap();
    assert!(x[0].contains(&one) && x[1].contains(&Rational::from(2)));
    let wrong = Banded::new(2, 1, 1, q(&[1, 2])).unwrap_err();
    assert!(matches!(
        wrong,
        LinearError::Length {
            found: 2,
            due: 6,
            ..
        }
    ));
    assert!(matches!(
        solve(&a, &q(&[1]), 53),
        Err(LinearError::Length {
            found: 1,
            due: 2,
            ..
        })
    ));
    let nan = Banded::from_f64(2, 0, 1, &[1.0, 1.0, f64::NAN, 0.0]).unwrap_err();
    assert_eq!(nan, LinearError::NotFinite { row: 1, column: 0 });
    assert!(
        solve(&constant(0, 1, &[1, 2, 1]), &[], 53)
            .unwrap()
            .is_empty()
    );
}

#[test]
fn singular_bands_are_refused_with_a_proof() {
    for n in [5, 500] {
        // Constants are mapped to zero.
        let mut a = constant(n, 1, &[-1, 2, -1]);
        a.entries[1] = Rational::from(1);
        a.entries[3 * n - 2] = Rational::from(1);
        let mut side = vec![Rational::new(); n];
        side[0] = Rational::from(1);
        let Err(LinearError::Singular { null }) = solve(&a, &side, 53) else {
            panic!("singular");
        };
        assert!(null.iter().any(|x| *x != 0) && a.times(&null).iter().all(|x| *x == 0));
    }
}

/// An upper triangle whose inverse grows by 2 in a row: no number of bits is enough that is tried.
#[test]
fn a_condition_out_of_reach_is_undecided() {
    let n = 2000;
    let side = vec![Rational::from(1); n];
    let found = solve(&constant(n, 0, &[1, -2]), &side, 53);
    assert!(matches!(found, Err(LinearError::Undecided(_))));
    // A short one is solved exactly.
    let x = solve(&constant(200, 0, &[1, -2]), &side[..200], 53).unwrap();
    let due = (Rational::from(1) << 200u32) - 1;
    assert!(x[0].contains(&due) && x[0].accuracy_bits() >= 53);
}

/// The bound on the least eigenvalue is one: it lies below, and shifts above prove nothing.
#[test]
fn the_least_eigenvalue_is_bounded_from_below() {
    let a = constant(2, 1, &[1, 2, 1]);
    // Rows are scaled to 1/2 and 1/4: AᵀA has the eigenvalues 9/16 and 1/16.
    let s = Scaled::new(&a, 128).square(128);
    let due = Mag::from_f64(1.0 / 16.0);
    for estimate in [0.0625, 0.125, 0.24, 4.0] {
        let bound = least_eigenvalue(&s, &Float::with_val(53, estimate), 128).unwrap();
        assert!(bound <= due, "{estimate}");
    }
    assert!(Factors::new(&s, &Float::with_val(53, 0.07), 128).is_none());
    // Factors of too few bits: what they leave out counts.
    let rough = Factors {
        l: vec![vec![], vec![Float::new(53)]],
        d: vec![Float::with_val(53, 0.25); 2],
    };
    let sigma = Float::with_val(53, 0.0625);
    // S − σ − D is 0 1/4, 1/4 0.
    let defect = rough.defect(&s, &sigma, 128);
    assert!(defect >= Mag::from_f64(0.25) && defect < Mag::from_f64(0.26));
}

/// Factors in 8 bits of an indefinite matrix: an off-diagonal entry rounds to 1, and the pivots are
/// positive.
#[test]
fn what_factors_leave_out_counts() {
    let ball = |x: f64| Ball::exact(64, x);
    let rows = vec![
        vec![ball(1.0)],
        vec![ball(1.0 + 1.0 / 256.0), ball(1.0 + 1.0 / 128.0)],
    ];
    let s = Symmetric { rows };
    let sigma = Float::with_val(53, 1.0 / 4096.0);
    assert!(Factors::new(&s, &sigma, 8).is_some());
    assert!(least_eigenvalue(&s, &(sigma * 4u32), 8).is_none());
}

/// The error is bounded by the residual, and needs it.
#[test]
fn a_residual_bounds_the_error() {
    let r = [3.0, 4.0].map(|x| Ball::exact(64, x));
    let bound = distance(&r, Mag::from_f64(0.25));
    assert!(bound >= Mag::from_f64(10.0) && bound < Mag::from_f64(10.001));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    /// Balls hold the exact solution of any band, and a band is singular where it is.
    #[test]
    fn balls_hold_exact_solutions(
        v in prop::collection::vec(-4i32..5, 60),
        n in 1usize..9,
        lower in 0usize..3,
        upper in 0usize..3,
    ) {
        let width = lower + upper + 1;
        let a = Banded::new(n, lower, upper, q(&v[..n * width])).unwrap();
        let b: Vec<Rational> = v[40..40 + n].iter().map(|&v| Rational::from((v, 3))).collect();
        let exact = dense::solve_exactly(&a.dense(), &Matrix::new(n, 1, b.clone()).unwrap());
        match (solve(&a, &b, 60), exact) {
            (Ok(x), Ok(due)) => {
                prop_assert!(x.iter().zip(due.entries()).all(|(x, due)| x.contains(due)));
                prop_assert!(are_settled(&x, 60));
            }
            (Err(LinearError::Singular { null }), Err(_)) => {
                prop_assert!(null.iter().any(|x| *x != 0));
                prop_assert!(a.times(&null).iter().all(|x| *x == 0));
            }
            (found, _) => prop_assert!(false, "{:?}", found),
        }
    }
}
