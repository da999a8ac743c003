//! Tests of `generators`.

use super::*;
use crate::tridiagonal::{inverse, solve as eliminated};
use proptest::prelude::*;

fn exact(parts: [&[Rational]; 4]) -> (Minors<Rational>, Vec<Rational>) {
    let [lower, diagonal, upper, d] = parts.map(<[Rational]>::to_vec);
    (Minors::new(Rational::from(1), lower, diagonal, upper), d)
}

/// Minors of 0 1 0, 1 0 2, 0 3 4: the first leading one is zero, and the matrix is regular.
#[test]
fn minors_are_determinants() {
    let q = |v: &[i32]| v.iter().map(|&v| Rational::from(v)).collect::<Vec<_>>();
    let (lower, diagonal, upper) = (q(&[1, 3]), q(&[0, 0, 4]), q(&[1, 2]));
    let minors = Minors::new(Rational::from(1), lower, diagonal, upper);
    assert_eq!(minors.leading, q(&[1, 0, -1, -4]));
    assert_eq!(minors.trailing, q(&[-4, -6, 4, 1]));
    assert!(minors.any_leading(|m| *m == 0) && !minors.any_leading(|m| *m == -4));
    // x = (1, 2, 3).
    let x = minors.solve(&q(&[2, 7, 18]));
    assert_eq!(x, q(&[1, 2, 3]));
}

proptest! {
    /// Both solutions and the sums of magnitudes are those of elimination, zero pivots included;
    /// balls hold them.
    #[test]
    fn generators_are_the_inverse(v in prop::collection::vec(-3i32..4, 4..40)) {
        let n = v.len() / 4;
        let part = |k: usize| v[k * n..(k + 1) * n].iter().map(|&v| Rational::from((v, 3))).collect::<Vec<_>>();
        let (l, d, u, w) = (part(0), part(1), part(2), part(3));
        let parts = [&l[1..], &d[..], &u[..n - 1], &w[..]];
        let (minors, w) = exact(parts);
        let Some(x) = eliminated(parts[0], parts[1], parts[2], &w) else {
            prop_assert_eq!(minors.determinant(), &Rational::new());
            prop_assert!(solve(parts, 64).is_none() && conditions(parts).is_none());
            return Ok(());
        };
        prop_assert_eq!(&minors.solve(&w), &x);
        let sums = minors.sums(&x, &w);
        let rows = inverse(parts[0], parts[1], parts[2]).unwrap();
        let due: Vec<Rational> = rows
            .iter()
            .map(|row| row.iter().zip(&sums).map(|(a, v)| Rational::from(a * v).abs()).sum())
            .collect();
        prop_assert_eq!(&minors.solve_magnitudes(&sums), &due);
        let balls = solve(parts, 64).unwrap();
        prop_assert!(balls.iter().zip(&x).all(|(b, x)| b.contains(x)));
        if due.iter().all(|c| *c != 0) {
            let balls = conditions(parts).unwrap();
            prop_assert!(balls.iter().zip(&due).all(|(b, c)| b.contains(c) && b.accuracy_bits() >= 50));
        }
    }
}

/// 2 on the diagonal and -1 beside it, the least dominance there is, in 3000 rows: `d = (1, 0, …,
/// 0)` has `x_i = (n − i)/(n + 1)`.
#[test]
fn long_systems_are_enclosed() {
    let n = 3000;
    let (off, on) = (vec![Rational::from(-1); n - 1], vec![Rational::from(2); n]);
    let mut d = vec![Rational::new(); n];
    d[0] = Rational::from(1);
    let x = solve([&off, &on, &off, &d], 128).unwrap();
    for (i, x) in x.iter().enumerate() {
        let due = Rational::from(((n - i) as u32, n as u32 + 1));
        assert!(x.contains(&due) && x.accuracy_bits() >= 120, "{i}");
    }
}
