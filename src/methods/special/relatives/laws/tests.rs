//! Laws judge planted functions.

use super::*;
use crate::methods::special::identities::{U, batch_agrees, equation, gaussian, within};
use crate::solvers::faddeeva::dawson;
use std::cell::Cell;
use std::collections::BTreeSet;

/// `f′ = −2zf` holds for `e^{−z²}`.
#[test]
fn the_taylor_series_finds_an_error_and_ends_where_its_domain_does() {
    let none = C::default();
    // All but the first value off.
    let off = |by: f64| {
        let start = C::new(0.5, 0.5);
        let f = move |z: C| gaussian(z, 1) * if z == start { 1.0 } else { 1.0 + by };
        equation(f, none, start).unwrap()
    };
    assert!(off(0.0) < 0.2);
    assert!(off(28.0 * U) < 1.0 && off(40.0 * U) > 1.0);
    // Constants solve f′ = 0 as far as h is nothing beside them.
    let constant = |size: f64, z: f64| equation(|_| C::from(size), none, C::from(z));
    assert!(constant(1.0, 1e6).is_some());
    assert_eq!(constant(1.0, 1e6f64.next_up()), None);
    assert!(constant(5e299f64.next_down(), 0.0).is_some());
    assert_eq!(constant(5e299, 0.0), None);
    assert_eq!(constant(8e299, 0.0), None);
}

/// Points of every kind, in batches of every length.
#[test]
fn batches_have_all_lengths_and_kinds_of_points() {
    let lengths: BTreeSet<usize> = (0..400)
        .map(|k| {
            let length = Cell::new(0);
            let z = C::new(1.0 + f64::from(k) * f64::EPSILON, 0.5);
            let refused = batch_agrees(z, 40, dawson, |points, _| {
                length.set(points.len());
                let kinds = [
                    z,
                    -z,
                    z.conj(),
                    C::new(z.im, z.re),
                    C::new(z.re + 4.0 / 16.0, z.im - 4.0 / 32.0),
                    C::new(z.re * 0.5, z.im * 1.5),
                    z,
                ];
                assert!(points.iter().zip(kinds).all(|(a, b)| *a == b));
                false
            });
            assert_eq!(refused, Some(f64::INFINITY));
            length.get()
        })
        .collect();
    assert_eq!(lengths, (1..=40).collect());
}

#[test]
fn a_batch_that_differs_or_refuses_breaks_the_law() {
    for (by, done, due) in [
        (1.0, true, 0.0),
        (1.0, false, f64::INFINITY),
        (1.0 + f64::EPSILON, true, f64::INFINITY),
    ] {
        let law = batch_agrees(C::new(1.0, 0.5), 40, dawson, |points, values| {
            for (value, &z) in values.iter_mut().zip(points) {
                *value = dawson(z) * by;
            }
            done
        });
        assert_eq!(law, Some(due), "{by} {done}");
    }
}

/// Of these z³ alone is odd and real on the real axis.
#[test]
fn a_sign_or_a_conjugate_that_is_lost_breaks_a_symmetry() {
    let (holds, broken) = (Some(0.0), Some(f64::INFINITY));
    let input = [0.5, 0.25];
    for (f, if_odd, if_real) in [
        ((|z| z * z * z) as fn(C) -> C, holds, holds),
        (|z| z * z, broken, holds),
        (|z| C::i() * z, broken, broken),
    ] {
        assert_eq!(odd(f, &input), if_odd);
        assert_eq!(conjugation(f, &input), if_real);
    }
    assert_eq!(odd(|z| z, &input[..1]), None);
}

#[test]
fn on_the_axis_five_units_in_the_last_place_are_allowed() {
    let (inf, nan, tiny, e) = (f64::INFINITY, f64::NAN, f64::from_bits(1), f64::EPSILON);
    let law = |value: C, real: f64| on_the_axis(|_| value, |_| real, &[0.0, 7.0]).unwrap();
    for (re, real, due) in [
        (1.0, 1.0, 0.0),
        (1.0, 1.0 + 5.0 * e, 1.0),
        (-1.0, -1.0 + 10.0 * e, 2.0),
        (0.0, 5.0 * tiny, 1.0),
        (3.0 * tiny, 0.0, 0.6),
        (inf, inf, 0.0),
        (nan, nan, 0.0),
        (inf, -inf, inf),
        (inf, 1.0, inf),
        (1.0, inf, inf),
        (nan, 1.0, inf),
        (1.0, nan, inf),
    ] {
        assert_eq!(law(C::new(re, 0.0), real), due, "{re:e} {real:e}");
    }
    assert_eq!(law(C::new(1.0, tiny), 1.0), inf);
    // Both at Re z.
    let at = |complex: fn(C) -> C, real: fn(f64) -> f64| on_the_axis(complex, real, &[3.0, 7.0]);
    assert_eq!(at(|z| z, |x| x), Some(0.0));
    assert_ne!(at(|z| z, |_| 7.0), Some(0.0));
}

#[test]
fn bits_are_compared_but_for_those_of_nan() {
    let nan = f64::NAN;
    assert!(same(nan, -nan) && same(-0.0, -0.0) && same(1.0, 1.0));
    assert!(!same(0.0, -0.0) && !same(1.0, nan) && !same(nan, 1.0));
    let z = C::new(1.0, 2.0);
    assert!(same_pair(z, z));
    assert!(!same_pair(z, C::new(1.0, 3.0)) && !same_pair(z, C::new(3.0, 2.0)));
}

#[test]
fn what_is_left_is_measured_by_the_size() {
    let five = C::new(3.0, -4.0);
    assert_eq!(within(five * U, 1.0, 1.0), Some(5.0));
    assert_eq!(within(five * U, 2.0, 10.0), Some(0.25));
    // Below the normal numbers units are as large as at the least of them.
    let normal = f64::MIN_POSITIVE;
    assert_eq!(within(C::from(normal), 1.0 / U, 0.0), Some(1.0));
    assert!(within(five, 1.0, 1e307f64.next_down()).is_some());
    assert_eq!(within(five, 1.0, 1e307), None);
    assert_eq!(within(five, 1.0, f64::NAN), None);
}

#[test]
fn plain_values_are_far_from_both_ends_of_the_range() {
    let all = |sizes: &[f64]| plain(&sizes.iter().map(|x| C::new(0.0, *x)).collect::<Vec<_>>());
    assert!(all(&[1e-290, -1.0, 0.9e290]));
    for bad in [0.0, 0.9e-290, 1e290, f64::INFINITY, f64::NAN] {
        assert!(
            !all(&[bad]) && !all(&[1.0, bad]) && !all(&[bad, 1.0]),
            "{bad:e}"
        );
    }
}

/// e^{−z²} for z = x + iy is e^{y² − x²} (cos 2xy − i sin 2xy).
#[test]
fn the_gaussian_is_that_of_its_definition() {
    for (z, factor) in [(C::new(0.5, 0.25), 1), (C::new(-0.75, 1.5), 2)] {
        let size = factor as f64 * (z.im * z.im - z.re * z.re).exp();
        let phase = 2.0 * z.re * z.im;
        let due = C::new(size * phase.cos(), -size * phase.sin());
        assert!((gaussian(z, factor) - due).norm() < 1e-14 * size, "{z}");
    }
}
