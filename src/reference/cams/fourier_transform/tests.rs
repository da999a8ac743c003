//! Tests of `fourier_transform`.

use super::*;

fn r(n: i32, d: i32) -> Rational {
    Rational::from((n, d))
}

/// The one number of `x + 2k` in `[−1, 1)`.
#[test]
fn angles_are_reduced_to_one_turn() {
    for (x, due) in [
        ((7, 2), (-1, 2)),
        ((5, 2), (1, 2)),
        ((-7, 2), (1, 2)),
        ((1, 1), (-1, 1)),
        ((-1, 1), (-1, 1)),
        ((2, 3), (2, 3)),
        ((1_000_001, 3), (-1, 3)),
        ((0, 1), (0, 1)),
    ] {
        assert_eq!(half_turns(&Rational::from(x)), Rational::from(due), "{x:?}");
    }
}

/// Quarter turns are exact, and other angles are none.
#[test]
fn quarter_turns_are_exact() {
    for (x, due) in [
        ((0, 1), [1, 0]),
        ((1, 2), [0, 1]),
        ((-1, 2), [0, -1]),
        ((1, 1), [-1, 0]),
        ((-1, 1), [-1, 0]),
        ((9, 2), [0, 1]),
        ((7, 2), [0, -1]),
        ((4, 1), [1, 0]),
    ] {
        let z = quarter(&Rational::from(x), 64).unwrap();
        assert!(z.re.rad().is_zero() && z.im.rad().is_zero());
        assert!(*z.re.mid() == due[0] && *z.im.mid() == due[1], "{x:?}");
    }
    for x in [r(1, 4), r(1, 3), r(3, 4), r(1, 100)] {
        assert!(quarter(&x, 64).is_none());
    }
}

/// Jumps 1, 2, …, 5 at one corner and an angle of ½ give `Σ k (2/i)^k`.
#[test]
fn derivatives_are_divided_by_powers_of_i() {
    let ball = |n: i32| Ball::integer(64, i64::from(n));
    let jumps = vec![(1..=5).map(ball).collect::<Vec<_>>(), Vec::new()];
    let one = ComplexBall::new(ball(1), ball(0));
    let z = by_jumps(&jumps, &ball(1).shift(-1), &[one.clone(), one.clone()]);
    // −2i, −8, 24i, 64, −160i.
    assert!(z.re.contains(&r(56, 1)) && z.im.contains(&r(-138, 1)));
    let none = by_jumps(&[Vec::new()], &ball(1), &[one]);
    assert!(none.re.is_zero() && none.im.is_zero());
}
