//! Tests of `exact`.

use super::*;

fn q(n: usize, v: &[i64]) -> Matrix<Rational> {
    Matrix::new(n, n, v.iter().map(|&v| Rational::from(v)).collect()).unwrap()
}

/// A solution counts only if it solves.
#[test]
fn a_wrong_solution_is_none() {
    let matrix = Matrix::new(2, 2, [2, 1, 1, 3].map(Integer::from).to_vec()).unwrap();
    let lifting = Lifting::new(&matrix).unwrap();
    let side = [3, 4].map(Integer::from);
    let fractions = |n: [i32; 2], d: i32| Fractions {
        numerators: n.map(Integer::from).to_vec(),
        denominator: Integer::from(d),
    };
    assert!(lifting.is_solution(&fractions([1, 1], 1), &side));
    assert!(lifting.is_solution(&fractions([2, 2], 2), &side));
    assert!(!lifting.is_solution(&fractions([1, 2], 1), &side));
    assert!(!lifting.is_solution(&fractions([0, 0], 0), &side));
}

/// The determinant is the first of the primes: regular, though singular modulo that.
#[test]
fn a_matrix_that_is_singular_modulo_a_prime_alone_is_regular() {
    let p = modular::primes().next().unwrap() as i64;
    let a = q(2, &[p + 1, 1, 1, 1]);
    assert!(modular::inverse(Cleared::new(&a).modulo(p as u64), p as u64).is_none());
    assert_eq!(null_vector(&a), None);
    assert_eq!(check_regular(&a, &Cleared::new(&a)), Ok(()));
    assert_eq!(determinant(&a, &Cleared::new(&a)).unwrap(), p);
    let b = Matrix::new(2, 1, vec![Rational::from(p + 2), Rational::from(2)]).unwrap();
    let x = solve(&a, &Cleared::new(&a), &b).unwrap();
    assert_eq!(x.entries(), [1, 1]);
}

/// Residues of −1/(p + 1) and the like are short for their length, and are no solutions.
#[test]
fn residues_that_look_like_integers_are_not_taken_for_solutions() {
    let p = Integer::from(modular::primes().next().unwrap());
    for d in [
        Integer::from(&p + 1u32),
        p.clone().square() + 1u32,
        p - 1u32,
    ] {
        let matrix = Matrix::new(1, 1, vec![d.clone()]).unwrap();
        let found = Lifting::new(&matrix)
            .unwrap()
            .solve(&[Integer::from(-1)])
            .unwrap();
        assert_eq!(
            (&found.numerators[0], &found.denominator),
            (&Integer::from(-1), &d)
        );
    }
}

/// Equal blocks have one denominator between them: the determinant is a power of it.
#[test]
fn a_determinant_of_many_primes() {
    let block = [1_000_003, 17, -23, 999_983];
    let d = Integer::from(1_000_003i64 * 999_983 + 17 * 23);
    let n = 10;
    let a = Matrix::from_fn(n, n, |i, j| match i / 2 == j / 2 {
        true => Rational::from(block[i % 2 * 2 + j % 2]),
        false => Rational::new(),
    });
    assert_eq!(
        determinant(&a, &Cleared::new(&a)).unwrap(),
        Rational::from(d.clone().square().square() * &d)
    );
}
