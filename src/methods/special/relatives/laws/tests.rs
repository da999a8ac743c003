//! Laws judge planted functions.

use super::*;
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
