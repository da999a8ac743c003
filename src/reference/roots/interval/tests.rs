//! Tests of `interval`.

use super::*;
use proptest::prelude::*;
use std::convert::Infallible;

fn q(n: i64, d: i64) -> Rational {
    Rational::from((n, d))
}

/// A polynomial by its coefficients, the constant first.
fn polynomial(c: &[Rational]) -> impl FnMut(&Ball, u32) -> Result<Ball, Infallible> {
    let c = c.to_vec();
    move |x, bits| {
        let zero = Ball::integer(bits, 0);
        let horner = |sum: Ball, c: &Rational| sum * x + Ball::rational(bits, c);
        Ok(c.iter().rev().fold(zero, horner))
    }
}

fn derivative(c: &[Rational]) -> Vec<Rational> {
    let term = |(k, c): (usize, &Rational)| Rational::from(c * k as u32);
    c.iter().enumerate().skip(1).map(term).collect()
}

/// The coefficients of `Π (x − r)`.
fn with_roots(roots: &[Rational]) -> Vec<Rational> {
    let mut c = vec![Rational::from(1)];
    for r in roots {
        let mut next = vec![Rational::new(); c.len() + 1];
        for (k, c) in c.iter().enumerate() {
            next[k + 1] += c;
            next[k] -= Rational::from(c * r);
        }
        c = next;
    }
    c
}

fn all(c: &[Rational], lo: Rational, hi: Rational) -> Result<Vec<Ball>, RootError<Infallible>> {
    all_roots(
        polynomial(c),
        polynomial(&derivative(c)),
        &lo,
        &hi,
        100,
        20_000,
    )
}

fn unique(c: &[Rational], lo: Rational, hi: Rational) -> Result<Ball, RootError<Infallible>> {
    unique_root(polynomial(c), polynomial(&derivative(c)), &lo, &hi, 100)
}

#[test]
fn one_none_and_several_are_told_apart() {
    let c = with_roots(&[q(1, 3), q(5, 7), q(-2, 1)]);
    let root = unique(&c, q(1, 2), q(1, 1)).unwrap();
    assert!(root.contains(&q(5, 7)) && root.accuracy_bits() >= 100);
    assert!(matches!(unique(&c, q(2, 1), q(9, 1)), Err(RootError::None)));
    let Err(RootError::Several { roots }) = unique(&c, q(0, 1), q(1, 1)) else {
        panic!("two roots");
    };
    assert!(roots[0].contains(&q(1, 3)) && roots[1].contains(&q(5, 7)));
    assert!(matches!(
        unique(&c, q(1, 1), q(0, 1)),
        Err(RootError::Interval { .. })
    ));
}

#[test]
fn ends_may_be_roots() {
    // x³ − x
    let c = with_roots(&[q(0, 1), q(1, 1), q(-1, 1)]);
    let roots = all(&c, q(-1, 1), q(1, 1)).unwrap();
    assert_eq!(roots.len(), 3);
    assert!(
        roots
            .iter()
            .zip(-1..=1)
            .all(|(x, due)| x.contains(&Rational::from(due)))
    );
    assert!(roots[1].is_zero());
    assert_eq!(all(&c, q(1, 1), q(5, 1)).unwrap().len(), 1);
    assert_eq!(all(&c, q(1, 1), q(1, 1)).unwrap().len(), 1);
    assert!(all(&c, q(1, 2), q(1, 2)).unwrap().is_empty());
    // A third is no floating-point number: nobody knows on which side of the end the root is.
    let c = with_roots(&[q(1, 3)]);
    let Err(RootError::Undecided { open, .. }) = all(&c, q(1, 3), q(1, 1)) else {
        panic!("undecided");
    };
    assert!(
        open.len() == 1
            && open[0].0 == q(1, 3)
            && Rational::from(&open[0].1 - &open[0].0) < q(1, 1 << 40)
    );
}

#[test]
fn multiple_roots_are_undecided_at_their_place() {
    let c = with_roots(&[q(1, 3), q(1, 3), q(2, 1)]);
    let Err(RootError::Undecided { roots, open, .. }) = all(&c, q(0, 1), q(3, 1)) else {
        panic!("undecided");
    };
    assert!(roots.len() == 1 && roots[0].contains(&q(2, 1)));
    assert!(open.len() == 1 && open[0].0 <= q(1, 3) && q(1, 3) <= open[0].1);
    assert!(Rational::from(&open[0].1 - &open[0].0) < q(1, 1 << 40));
    assert!(matches!(
        unique(&c, q(0, 1), q(1, 1)),
        Err(RootError::Undecided { .. })
    ));
    // Two roots at a distance of 2⁻⁶⁰, and a pair that just misses the axis.
    let c = with_roots(&[q(1, 3), q(1, 3) + q(1, 1 << 60)]);
    assert_eq!(all(&c, q(0, 1), q(1, 1)).unwrap().len(), 2);
    let mut c = with_roots(&[q(1, 3), q(1, 3)]);
    c[0] += q(1, 1 << 62) * q(1, 1 << 40);
    assert!(matches!(unique(&c, q(0, 1), q(1, 1)), Err(RootError::None)));
}

/// A root at zero of a function that is not exactly zero there, and ends far from the root.
#[test]
fn small_roots_and_large_intervals() {
    // x + 1/3 − (1/9 + 2/9)
    let f = |x: &Ball, bits: u32| {
        let [third, ninth] = [q(1, 3), q(1, 9)].map(|q| Ball::rational(bits, &q));
        Ok::<_, Infallible>(x + third - (&ninth + ninth.shift(1)))
    };
    let df = |_: &Ball, bits: u32| Ok(Ball::integer(bits, 1));
    let root = unique_root(f, df, &q(-3, 1), &q(2, 1), 100).unwrap();
    assert!(root.contains(&Rational::new()) && root.rad() < Mag::power_of_two(-198));
    // (x − 1/3) (x − 2/3) in ±10³⁰⁰.
    let far = Rational::from_f64(1e300).unwrap();
    let roots = all(&with_roots(&[q(1, 3), q(2, 3)]), Rational::from(-&far), far).unwrap();
    assert!(roots.len() == 2 && roots[0].contains(&q(1, 3)) && roots[1].contains(&q(2, 3)));
    assert!(roots.iter().all(|x| x.rad() < Mag::from_f64(1e290)));
}

/// sin over 1000 radians, and a limit that is too small for it.
#[test]
fn all_roots_of_a_sine() {
    let f = |x: &Ball, _: u32| Ok::<_, Infallible>(x.sin_cos().0);
    let df = |x: &Ball, _: u32| Ok(x.sin_cos().1);
    let found = all_roots(f, df, &q(0, 1), &q(1000, 1), 200, 10_000).unwrap();
    assert_eq!(found.len(), 319);
    for (k, x) in (0i64..).zip(&found) {
        let due = Ball::pi(400) * Ball::integer(400, k);
        assert!(x.contains_ball(&due) && (k == 0 || x.accuracy_bits() >= 200));
    }
    let short = all_roots(f, df, &q(0, 1), &q(1000, 1), 200, 100);
    assert!(matches!(short, Err(RootError::Undecided { open, .. }) if !open.is_empty()));
}

#[test]
fn a_function_that_fails_ends_the_search() {
    let f = |_: &Ball, _: u32| Err::<Ball, _>("no such function");
    let df = |x: &Ball, _: u32| Ok(x.clone());
    let found = all_roots(f, df, &q(0, 1), &q(1, 1), 53, 10);
    assert!(matches!(
        found,
        Err(RootError::Function {
            error: "no such function",
            ..
        })
    ));
    // 1/x has no bound over zero, and no root anywhere: undecided there alone.
    let f = |x: &Ball, _: u32| Ok::<_, Infallible>(x.recip());
    let df = |x: &Ball, _: u32| Ok(-x.square().recip());
    let Err(RootError::Undecided { roots, open, .. }) =
        all_roots(f, df, &q(-1, 1), &q(2, 1), 53, 5000)
    else {
        panic!("undecided");
    };
    assert!(roots.is_empty() && open.len() == 1 && open[0].0 <= 0 && open[0].1 >= 0);
}

/// Next to a turning point the slope of a piece varies, and precision does not help.
#[test]
fn a_root_beside_a_turning_point() {
    let roots = [q(32, 13), q(33, 13)];
    let found = all(&with_roots(&roots), q(-5, 1) + q(1, 97), q(5, 1)).expect("two roots");
    assert!(found.len() == 2 && found.iter().zip(&roots).all(|(x, due)| x.contains(due)));
}

/// A monotone function has a root only where its signs differ.
#[test]
fn signs_decide_over_a_monotone_piece() {
    use Sign::{Negative, Positive, Unknown, Zero};
    let is = |low, high, rising| match by_signs(low, high, rising) {
        Verdict::None => "none",
        Verdict::One => "one",
        Verdict::Low => "low",
        Verdict::High => "high",
        Verdict::Open => "open",
    };
    assert_eq!(is(Negative, Positive, true), "one");
    assert_eq!(is(Positive, Negative, false), "one");
    assert_eq!(is(Positive, Positive, true), "none");
    assert_eq!(is(Unknown, Negative, true), "none");
    assert_eq!(is(Unknown, Positive, true), "open");
    assert_eq!(is(Positive, Unknown, false), "open");
    assert_eq!(is(Zero, Positive, true), "low");
    assert_eq!(is(Positive, Zero, false), "high");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]
    /// All simple roots are found, and none that is not there.
    #[test]
    fn rational_roots_are_found(mut v in prop::collection::btree_set(-60i64..61, 1..7)) {
        let roots: Vec<Rational> = std::mem::take(&mut v).into_iter().map(|n| q(n, 13)).collect();
        let c = with_roots(&roots);
        let found = all(&c, q(-5, 1) + q(1, 97), q(5, 1)).unwrap();
        prop_assert_eq!(found.len(), roots.len());
        for (x, due) in found.iter().zip(&roots) {
            prop_assert!(x.contains(due) && x.accuracy_bits() >= 100);
        }
    }
}
