//! Tests of `dense`.

use super::*;
use crate::Mag;
use crate::draw::Draw;
use proptest::prelude::*;

fn q(rows: usize, columns: usize, v: &[i32]) -> Matrix<Rational> {
    Matrix::new(
        rows,
        columns,
        v.iter().map(|&v| Rational::from(v)).collect(),
    )
    .unwrap()
}

fn product(a: &Matrix<Rational>, b: &Matrix<Rational>) -> Matrix<Rational> {
    Matrix::from_fn(a.rows(), b.columns(), |i, j| {
        (0..b.rows())
            .map(|k| Rational::from(a.at(i, k) * b.at(k, j)))
            .sum()
    })
}

/// The determinant by Laplace's expansion.
fn expanded(rows: &[Vec<Rational>]) -> Rational {
    let Some((first, rest)) = rows.split_first() else {
        return Rational::from(1);
    };
    let minor = |j: usize| -> Vec<Vec<Rational>> {
        let without = |row: &Vec<Rational>| {
            let kept = row.iter().enumerate().filter(|(k, _)| *k != j);
            kept.map(|(_, x)| x.clone()).collect()
        };
        rest.iter().map(without).collect()
    };
    let term = |(j, a): (usize, &Rational)| {
        let term = a * expanded(&minor(j));
        if j % 2 == 0 { term } else { -term }
    };
    first.iter().enumerate().map(term).sum()
}

fn hilbert(n: usize) -> Matrix<Rational> {
    Matrix::from_fn(n, n, |i, j| Rational::from((1, (i + j + 1) as u32)))
}

/// The entries of the inverse Hilbert matrix are integers with a closed form.
fn inverse_hilbert(n: u32, i: u32, j: u32) -> rug::Integer {
    let c = |a: u32, b: u32| rug::Integer::from(a).binomial(b);
    let size = c(n + i, n - j - 1) * c(n + j, n - i - 1) * c(i + j, i).square() * (i + j + 1);
    if (i + j).is_multiple_of(2) {
        size
    } else {
        -size
    }
}

#[test]
fn the_inverse_hilbert_matrix_is_exact() {
    let n = 24;
    let x = inverse_exactly(&hilbert(n)).unwrap();
    let balls = inverse(&hilbert(n), 64).unwrap();
    for i in 0..n {
        for j in 0..n {
            let due = Rational::from(inverse_hilbert(n as u32, i as u32, j as u32));
            assert_eq!(*x.at(i, j), due);
            assert!(balls.at(i, j).contains(&due) && balls.at(i, j).accuracy_bits() >= 64);
        }
    }
}

#[test]
fn wrong_shapes_are_named() {
    let (a, b) = (q(2, 3, &[1; 6]), q(2, 1, &[1; 2]));
    let not_square = LinearError::NotSquare {
        rows: 2,
        columns: 3,
    };
    assert_eq!(solve(&a, &b, 53).unwrap_err(), not_square);
    assert_eq!(determinant(&a, 53).unwrap_err(), not_square);
    let square = q(3, 3, &[1; 9]);
    assert!(matches!(
        solve(&square, &b, 53),
        Err(LinearError::Length {
            found: 2,
            due: 3,
            ..
        })
    ));
    assert!(matches!(
        least_squares(&square, &b, 53),
        Err(LinearError::Length {
            found: 2,
            due: 3,
            ..
        })
    ));
    assert!(matches!(
        Matrix::new(2, 2, vec![1]),
        Err(LinearError::Length {
            found: 1,
            due: 4,
            ..
        })
    ));
    let nan = Matrix::from_f64(2, 2, &[1.0, 2.0, f64::NAN, 3.0]);
    assert_eq!(nan, Err(LinearError::NotFinite { row: 1, column: 0 }));
    let open = Matrix::from_fn(1, 1, |_, _| Ball::new(rug::Float::new(64), Mag::INFINITY));
    assert_eq!(
        inverse_balls(&open, 64).unwrap_err(),
        LinearError::NotFinite { row: 0, column: 0 }
    );
    let none = q(0, 0, &[]);
    assert_eq!(solve(&none, &q(0, 2, &[]), 53).unwrap().rows(), 0);
    assert_eq!(determinant_exactly(&none).unwrap(), 1);
}

#[test]
fn dependent_columns_are_refused_with_a_proof() {
    let a = q(3, 3, &[1, 2, 3, 4, 5, 6, 7, 8, 9]);
    let b = q(3, 1, &[1, 0, 0]);
    let Err(LinearError::Singular { null }) = solve(&a, &b, 53) else {
        panic!("singular");
    };
    assert!(null.iter().any(|x| *x != 0) && a.times(&null).iter().all(|x| *x == 0));
    assert_eq!(determinant_exactly(&a).unwrap(), 0);
    let tall = q(4, 2, &[1, 2, 2, 4, 3, 6, 4, 8]);
    let side = q(4, 1, &[1, 1, 1, 1]);
    let Err(LinearError::Singular { null }) = least_squares(&tall, &side, 53) else {
        panic!("dependent columns");
    };
    assert!(null.iter().any(|x| *x != 0) && tall.times(&null).iter().all(|x| *x == 0));
    assert!(matches!(
        solve(&q(1, 1, &[0]), &q(1, 1, &[1]), 53),
        Err(LinearError::Singular { .. })
    ));
}

/// Long systems are refused as short ones are, and what nobody waits for is refused at once.
#[test]
fn work_is_bounded() {
    let flat = q(3, 3, &[1, 2, 3, 4, 5, 6, 7, 8, 9]);
    let refused = exact::check_regular(&flat, &Cleared::new(&flat));
    assert!(matches!(refused, Err(LinearError::Singular { .. })));
    let large = |n: usize, x: f64| {
        Matrix::from_fn(n, n, |i, j| {
            let on = if i == j { 3.0 } else { 0.0 };
            Rational::from_f64(on + x * (1.0 + (i * 7 + j * 3) as f64)).unwrap()
        })
    };
    let a = large(120, 1e-300);
    assert!(matches!(
        inverse_exactly(&a),
        Err(LinearError::Undecided(_))
    ));
    assert!(matches!(
        determinant_balls(&large(1001, 0.0).balls(64), 64),
        Err(LinearError::Undecided(_))
    ));
}

/// A wide matrix of balls holds a singular one, and is not solved.
#[test]
fn balls_that_hold_a_singular_matrix_are_undecided() {
    let wide = |r: f64| {
        Matrix::from_fn(2, 2, |i, j| {
            let x = if i == j { 1.0 } else { 0.0 };
            Ball::new(rug::Float::with_val(64, x), Mag::from_f64(r))
        })
    };
    assert!(inverse_balls(&wide(0.49), 64).is_ok());
    // [[1, -1/2], [-2, 1]] is not in it, [[1/2, 1/2], [1/2, 1/2]] is.
    assert!(matches!(
        inverse_balls(&wide(0.5), 64),
        Err(LinearError::Undecided(_))
    ));
    assert!(determinant_balls(&wide(0.5), 64).is_err());
}

/// Every corner of the balls is enclosed, and the balls are not far too wide.
#[test]
fn balls_hold_the_solutions_of_all_corners() {
    let r = 1.0 / 64.0;
    let middle = [3.0, 1.0, -1.0, 2.0];
    let ball = |x: f64| Ball::new(rug::Float::with_val(64, x), Mag::from_f64(r));
    let a = Matrix::new(2, 2, middle.map(ball).to_vec()).unwrap();
    let b = Matrix::new(2, 1, vec![ball(1.0), ball(2.0)]).unwrap();
    let (x, d) = (
        solve_balls(&a, &b, 64).unwrap(),
        determinant_balls(&a, 64).unwrap(),
    );
    let y = least_squares_balls(&a, &b, 64).unwrap();
    for corner in 0..64u32 {
        let sign = |k: u32| if corner >> k & 1 == 0 { r } else { -r };
        let entries: Vec<f64> = (0..4).map(|k| middle[k as usize] + sign(k)).collect();
        let a = Matrix::from_f64(2, 2, &entries).unwrap();
        let b = Matrix::from_f64(2, 1, &[1.0 + sign(4), 2.0 + sign(5)]).unwrap();
        let due = solve_exactly(&a, &b).unwrap();
        assert!(
            (0..2).all(|i| x.at(i, 0).contains(due.at(i, 0)) && y.at(i, 0).contains(due.at(i, 0)))
        );
        assert!(d.contains(&determinant_exactly(&a).unwrap()));
    }
    assert!(x.entries().iter().all(|x| x.rad() < Mag::from_f64(0.1)));
    assert!(d.rad() < Mag::from_f64(0.5));
}

/// One equation `a x = 1` with a in [3/4, 5/4]: the bound is reached.
#[test]
fn the_bound_on_the_error_is_needed() {
    let ball = |r: f64| Ball::new(rug::Float::with_val(64, 1), Mag::from_f64(r));
    let one = |x: Ball| Matrix::new(1, 1, vec![x]).unwrap();
    let x = solve_balls(&one(ball(0.25)), &one(ball(0.0)), 64).unwrap();
    assert!(x.at(0, 0).contains(&Rational::from((4, 3))));
    assert!(x.at(0, 0).rad() < Mag::from_f64(0.34));
}

/// The enclosures of long systems, on short ones: the same numbers as by exact solution.
#[test]
fn an_approximate_inverse_encloses_what_is_exact() {
    let a = hilbert(12);
    let b = Matrix::from_fn(12, 2, |i, j| Rational::from((i * i + j) as u32));
    let exact = solve_exactly(&a, &b).unwrap();
    let found = solve_balls(&a.balls(300), &b.balls(300), 300).unwrap();
    for (x, due) in found.entries().iter().zip(exact.entries()) {
        assert!(x.contains(due) && x.accuracy_bits() > 200);
    }
    let d = determinant_balls(&a.balls(300), 300).unwrap();
    assert!(d.contains(&determinant_exactly(&a).unwrap()) && d.accuracy_bits() > 200);
    // The condition is 2⁵⁴.
    assert!(matches!(
        inverse_balls(&a.balls(40), 40),
        Err(LinearError::Undecided(_))
    ));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]
    /// Floating-point numbers of any size: the same fractions as by elimination.
    #[test]
    fn elimination_gives_the_same_fractions(
        v in prop::collection::vec(prop_oneof![4 => prop::num::f64::NORMAL, 1 => Just(0.0)], 30),
        n in 1usize..6,
    ) {
        let a = Matrix::from_f64(n, n, &v[..n * n]).unwrap();
        let b = Matrix::from_f64(n, 1, &v[25..25 + n]).unwrap();
        let equation = |i: usize| {
            let row = a.row(i).iter().cloned().enumerate();
            crate::tridiagonal::equation(row, vec![b.at(i, 0).clone()])
        };
        let due = crate::tridiagonal::solve_sparse(n, (0..n).map(equation).collect());
        match (solve_exactly(&a, &b), due) {
            (Ok(x), Some(due)) => prop_assert_eq!(x.entries(), due.concat()),
            (Err(LinearError::Singular { .. }), None) => {}
            (found, _) => prop_assert!(false, "{:?}", found),
        }
    }

    /// Solutions solve, inverses invert, determinants are those of Laplace's expansion, and
    /// residuals of least squares are orthogonal to the columns.
    #[test]
    fn exact_answers_are_exact(
        v in prop::collection::vec(-9i32..10, 25..30),
        den in 1i32..40,
        n in 1usize..6,
    ) {
        let a = Matrix::from_fn(n, n, |i, j| Rational::from((v[i * 5 + j], den + i as i32)));
        let b = Matrix::from_fn(n, 1, |i, _| Rational::from((v[24 - i], 7)));
        let rows: Vec<Vec<Rational>> = (0..n).map(|i| a.row(i).to_vec()).collect();
        let due = expanded(&rows);
        prop_assert_eq!(&determinant_exactly(&a).unwrap(), &due);
        match solve_exactly(&a, &b) {
            Ok(x) => {
                prop_assert!(due != 0);
                prop_assert_eq!(product(&a, &x), b.clone());
                prop_assert_eq!(product(&a, &inverse_exactly(&a).unwrap()), identity(n));
                let balls = solve(&a, &b, 70).unwrap();
                prop_assert!(balls.entries().iter().zip(x.entries()).all(|(b, x)| b.contains(x)));
                prop_assert!(are_known(balls.entries(), 70));
            }
            Err(LinearError::Singular { null }) => {
                prop_assert!(due == 0 && null.iter().any(|x| *x != 0));
                prop_assert!(a.times(&null).iter().all(|x| *x == 0));
            }
            Err(other) => prop_assert!(false, "{}", other),
        }
        let tall = Matrix::from_fn(5, n.min(3), |i, j| Rational::from((v[i * 5 + j], 3)));
        let side = Matrix::from_fn(5, 1, |i, _| Rational::from(v[i]));
        if let Ok(x) = least_squares_exactly(&tall, &side) {
            let fitted = product(&tall, &x);
            for j in 0..tall.columns() {
                let sum: Rational = (0..5)
                    .map(|i| Rational::from(fitted.at(i, 0) - side.at(i, 0)) * tall.at(i, j))
                    .sum();
                prop_assert_eq!(sum, 0);
            }
        }
    }
}

/// A matrix of order 500 with two rows that differ by one unit in the last place of one entry: its
/// condition is above 10²⁰.
#[test]
#[ignore = "takes minutes without optimisation"]
fn a_large_ill_conditioned_system_is_solved() {
    let n = 500;
    let mut random = Draw(1);
    let mut draw = || (random.next() >> 11) as f64 / (1u64 << 52) as f64 - 1.0;
    let mut entries: Vec<f64> = (0..n * n).map(|_| draw()).collect();
    for j in 0..n {
        entries[(n - 1) * n + j] = entries[j];
    }
    let least = (0..n)
        .min_by(|&i, &j| entries[i].abs().total_cmp(&entries[j].abs()))
        .unwrap();
    entries[(n - 1) * n + least] = entries[least].next_up();
    let a = Matrix::from_f64(n, n, &entries).unwrap();
    let due = Matrix::from_fn(n, 1, |i, _| Rational::from((i as i32 - 200, 7)));
    let b = product(&a, &due);
    let start = std::time::Instant::now();
    let x = solve(&a, &b, 54).unwrap();
    eprintln!("solution of order {n}: {:?}", start.elapsed());
    for (x, due) in x.entries().iter().zip(due.entries()) {
        assert!(x.contains(due) && (*due == 0 || x.accuracy_bits() >= 54));
    }
    let b = Matrix::from_fn(n, 1, |_, _| Rational::from_f64(draw()).unwrap());
    let start = std::time::Instant::now();
    let x = solve(&a, &b, 54).unwrap();
    eprintln!(
        "solution with a side that is not short: {:?}",
        start.elapsed()
    );
    assert!(are_known(x.entries(), 54));
    let start = std::time::Instant::now();
    let d = determinant(&a, 54).unwrap();
    eprintln!("determinant: {:?}, {}", start.elapsed(), d.mid());
    let start = std::time::Instant::now();
    let found = Verified::new(a.balls(192), 192)
        .unwrap()
        .solve_all(&b.balls(192));
    eprintln!("by an approximate inverse: {:?}", start.elapsed());
    assert!(
        found
            .entries()
            .iter()
            .zip(x.entries())
            .all(|(x, y)| x.overlaps(y))
    );
}
