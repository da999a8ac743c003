//! Tests of `eigenvalues`.

use super::*;
use proptest::prelude::*;

fn q(n: usize, v: &[i32]) -> Matrix<Rational> {
    Matrix::new(n, n, v.iter().map(|&v| Rational::from(v)).collect()).unwrap()
}

/// `Wᵀ D W` with W a product of exact rotations: eigenvalues as given.
fn with_eigenvalues(values: &[Rational]) -> Matrix<Rational> {
    let n = values.len();
    let mut a = Matrix::from_fn(n, n, |i, j| {
        if i == j {
            values[i].clone()
        } else {
            Rational::new()
        }
    });
    // (4/5, 3/5) turns exactly.
    let (c, s) = (Rational::from((4, 5)), Rational::from((3, 5)));
    for p in 0..n {
        for q in p + 1..n {
            for k in 0..n {
                let (x, y) = (a.at(k, p).clone(), a.at(k, q).clone());
                *a.at_mut(k, p) = Rational::from(&c * &x) - Rational::from(&s * &y);
                *a.at_mut(k, q) = Rational::from(&s * &x) + Rational::from(&c * &y);
            }
            for k in 0..n {
                let (x, y) = (a.at(p, k).clone(), a.at(q, k).clone());
                *a.at_mut(p, k) = Rational::from(&c * &x) - Rational::from(&s * &y);
                *a.at_mut(q, k) = Rational::from(&s * &x) + Rational::from(&c * &y);
            }
        }
    }
    a
}

fn hold(found: &[Ball], due: &[Rational], goal: u32) {
    assert_eq!(found.len(), due.len());
    for (x, due) in found.iter().zip(due) {
        assert!(x.contains(due), "{x:?} {due}");
        assert!(x.is_zero() || x.accuracy_bits() >= i64::from(goal));
    }
}

#[test]
fn multiple_and_near_eigenvalues_are_enclosed() {
    let tiny = Rational::from((1, 1u64 << 60));
    let values: Vec<Rational> = vec![
        Rational::from(-3),
        Rational::from(-3),
        Rational::new(),
        Rational::new(),
        Rational::from(&tiny * 5),
        Rational::from(2) - &tiny,
        Rational::from(2),
        Rational::from(2),
    ];
    let found = symmetric(&with_eigenvalues(&values), 80).unwrap();
    hold(&found, &values, 80);
    assert!(found[2].is_zero() && found[3].is_zero() && !found[4].contains_zero());
    assert!(symmetric(&q(0, &[]), 64).unwrap().is_empty());
}

/// An eigenvalue far below the rounding of the first precision is not zero, and a second matrix
/// with such a one is positive definite.
#[test]
fn small_eigenvalues_are_not_zero() {
    let tiny = Rational::from(1) >> 200u32;
    let a = with_eigenvalues(&[tiny.clone(), Rational::from(1)]);
    hold(&symmetric(&a, 53).unwrap(), &[tiny, Rational::from(1)], 53);
    let huge = Rational::from(1) << 200u32;
    let found = generalised(&q(2, &[1, 0, 0, 1]), &a, 53).unwrap();
    hold(&found, &[Rational::from(1), huge], 53);
}

/// The second differences have the eigenvalues `2 − 2 cos(kπ/(n + 1))`.
#[test]
fn a_pencil_has_its_eigenvalues() {
    let n = 6;
    let a = Matrix::from_fn(n, n, |i, j| match i.abs_diff(j) {
        0 => Rational::from(2),
        1 => Rational::from(-1),
        _ => Rational::new(),
    });
    // Half of it and twice the unit matrix: λ/(2 + λ/2).
    let b = Matrix::from_fn(n, n, |i, j| {
        Rational::from(a.at(i, j) / 2u32) + if i == j { 2 } else { 0 }
    });
    let found = generalised(&a, &b, 120).unwrap();
    for (k, x) in (1i64..).zip(&found) {
        let angle = Ball::pi(300) * Ball::rational(300, &Rational::from((k, n as i64 + 1)));
        let value = Ball::integer(300, 2) - angle.sin_cos().1.shift(1);
        let due = &value / (Ball::integer(300, 2) + value.shift(-1));
        assert!(x.contains_ball(&due) && x.accuracy_bits() >= 120);
    }
}

#[test]
fn what_is_not_definite_is_refused_with_a_proof() {
    let a = q(2, &[1, 0, 0, 1]);
    for b in [
        q(2, &[1, 2, 2, 1]),
        q(2, &[1, 1, 1, 1]),
        q(2, &[0, 0, 0, 1]),
        q(2, &[-1, 0, 0, 1]),
    ] {
        let Err(LinearError::NotPositiveDefinite { witness }) = generalised(&a, &b, 53) else {
            panic!("not positive definite");
        };
        assert!(witness.iter().any(|x| *x != 0) && inner(&witness, &b.times(&witness)) <= 0);
    }
    let crooked = q(2, &[1, 2, 3, 4]);
    let named = LinearError::NotSymmetric { row: 1, column: 0 };
    assert_eq!(symmetric(&crooked, 53).unwrap_err(), named);
    assert_eq!(generalised(&a, &crooked, 53).unwrap_err(), named);
    let other = generalised(&a, &q(1, &[1]), 53).unwrap_err();
    assert!(matches!(
        other,
        LinearError::Length {
            found: 1,
            due: 2,
            ..
        }
    ));
}

/// The theorems hold for any W: a crude one gives wide balls that hold the eigenvalues.
#[test]
fn crude_directions_give_wide_balls() {
    let a = q(2, &[3, 1, 1, 1]).balls(64);
    // 2 ± √2, with W off a unit matrix by a tenth; the diagonal alone is 3 and 1.
    let due = [
        Ball::integer(200, 2) - Ball::integer(200, 2).sqrt(),
        Ball::integer(200, 2) + Ball::integer(200, 2).sqrt(),
    ];
    for scale in [0.875, 1.0, 1.125] {
        let w = Matrix::from_fn(2, 2, |i, j| {
            Float::with_val(64, if i == j { scale } else { 0.0 })
        });
        let found = enclosures(&a, None, &w, 64).unwrap();
        assert!(
            found.iter().zip(&due).all(|(x, due)| x.contains_ball(due)),
            "{scale}"
        );
    }
    // A diagonal matrix: only the scale is wrong.
    let a = q(2, &[3, 0, 0, 1]).balls(64);
    let w = Matrix::from_fn(2, 2, |i, j| {
        Float::with_val(64, if i == j { 0.875 } else { 0.0 })
    });
    let found = enclosures(&a, None, &w, 64).unwrap();
    assert!(found[0].contains(&Rational::from(1)) && found[1].contains(&Rational::from(3)));
    // ‖WᵀW − I‖ = 1.25: nothing follows.
    let w = Matrix::from_fn(2, 2, |i, j| {
        Float::with_val(64, if i == j { 1.5 } else { 0.0 })
    });
    assert!(enclosures(&a, None, &w, 64).is_none());
    // A singular second matrix: nothing follows either.
    let w = Matrix::from_fn(2, 2, |i, j| Float::with_val(64, u32::from(i == j)));
    assert!(enclosures(&a, Some(&q(2, &[1, 0, 0, 0]).balls(64)), &w, 64).is_none());
}

/// Eigenvalues of a diagonal of balls, in whatever order their points are.
#[test]
fn balls_hold_the_eigenvalues_of_all_points() {
    let ball = |x: f64, r: f64| Ball::new(Float::with_val(64, x), Mag::from_f64(r));
    let a = Matrix::from_fn(2, 2, |i, j| match (i, j) {
        (0, 0) => ball(1.0, 0.0),
        (1, 1) => ball(1.125, 0.5),
        _ => ball(0.0, 0.0),
    });
    let found = balls(&a, None, 64).unwrap();
    for second in [(5, 8), (13, 8)] {
        let (x, y) = (Rational::from(1), Rational::from(second));
        let (low, high) = if x < y { (x, y) } else { (y, x) };
        assert!(found[0].contains(&low) && found[1].contains(&high));
    }
    let a = Matrix::from_fn(2, 2, |i, _| ball(i as f64, 0.0));
    assert_eq!(
        balls(&a, None, 64).unwrap_err(),
        LinearError::NotSymmetric { row: 1, column: 0 }
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    /// Eigenvalues are where they were put, and where they are multiplied to by a pencil.
    #[test]
    fn eigenvalues_are_where_they_were_put(v in prop::collection::vec(-5i32..6, 1..6)) {
        let mut values: Vec<Rational> = v.iter().map(|&v| Rational::from((v, 3))).collect();
        values.sort();
        let a = with_eigenvalues(&values);
        hold(&symmetric(&a, 70).unwrap(), &values, 70);
        // With B = T Tᵀ and T A Tᵀ the eigenvalues are those of A.
        let n = values.len();
        let t = Matrix::from_fn(n, n, |i, j| {
            Rational::from(if i == j { 2 } else if i > j { v[j] } else { 0 })
        });
        let transposed = |m: &Matrix<Rational>| Matrix::from_fn(n, n, |i, j| m.at(j, i).clone());
        let product = |a: &Matrix<Rational>, b: &Matrix<Rational>| {
            let columns = transposed(b);
            Matrix::from_fn(n, n, |i, j| inner(a.row(i), columns.row(j)))
        };
        let b = product(&t, &transposed(&t));
        let a = product(&product(&t, &a), &transposed(&t));
        hold(&generalised(&a, &b, 70).unwrap(), &values, 70);
    }
}
