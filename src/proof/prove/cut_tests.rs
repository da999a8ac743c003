//! How rectangles are cut.

use super::tests::CODE;
use super::*;
use crate::cover::hole;

/// A rectangle is halved until its bounds are good; at its depth it comes out with what it has, or
/// open.
#[test]
fn rectangles_are_halved_until_the_bounds_are_good() {
    let watch = Watch::default();
    let of = |target: Target, a: [f64; 2], b: [f64; 2]| {
        on_rectangle(&CODE, target, &watch, Rectangle { a, b }).expect("not stopped")
    };
    let numbers = |[lo, hi]: [f64; 2]| u128::from(hi.to_bits() - lo.to_bits()) + 1;
    let whole = Rectangle {
        a: [2.9, 3.3],
        b: [2.9, 3.0],
    };
    let found = of(UPPER_HALF_PLANE, whole.a, whole.b);
    assert!(found.open.is_empty());
    for leaf in &found.leaves {
        let b = leaf.bound;
        assert!(b.norm <= 1.25 && b.re <= 4.0 && b.im <= 4.0, "{leaf:?}");
    }
    let sum: u128 = found
        .leaves
        .iter()
        .map(|l| numbers(l.at.a) * numbers(l.at.b))
        .sum();
    assert_eq!(sum, numbers(whole.a) * numbers(whole.b));
    let none = Target {
        depth: 0,
        ..UPPER_HALF_PLANE
    };
    assert_eq!(of(none, [0.01, 6.0], [0.01, 6.0]).open.len(), 1);
    let strict = Target {
        norm: 1e-3,
        component: 1e-3,
        depth: 3,
    };
    let found = of(strict, [3.0, 3.01], [3.0, 3.01]);
    assert!(found.leaves.len() >= 8 && found.leaves.iter().all(|l| l.bound.norm > 1e-3));
    // Each of the three bounds counts.
    let leaf = |norm, re, im| Leaf {
        at: whole,
        formula: Formula::Strip,
        bound: Bound {
            norm,
            re,
            im,
            tiny: 0.0,
        },
    };
    let excess = |norm, re, im| UPPER_HALF_PLANE.excess(&[leaf(0.5, 0.5, 0.5), leaf(norm, re, im)]);
    assert_eq!(
        [
            excess(2.5, 1.0, 1.0),
            excess(1.0, 8.0, 1.0),
            excess(1.0, 1.0, 12.0)
        ],
        [2.0, 2.0, 3.0]
    );
    let stopped = Watch::default();
    stopped
        .stop
        .store(true, std::sync::atomic::Ordering::Relaxed);
    assert!(on_rectangle(&CODE, UPPER_HALF_PLANE, &stopped, whole).is_none());
    let all = first_rectangles(None);
    assert_eq!(hole(&all), None);
    // A shell that reaches beyond is left out.
    assert_eq!(
        first_rectangles(Some(3.0)).len(),
        first_rectangles(Some(2.0)).len()
    );
    let first = |i: usize, _: &Rectangle| i < 2;
    let found = upper_half_plane(&CODE, UPPER_HALF_PLANE, &watch, first).expect("not stopped");
    assert!(found.open.is_empty() && found.leaves.iter().any(|l| l.at.a[0] == f64::from_bits(1)));
    assert!(upper_half_plane(&CODE, UPPER_HALF_PLANE, &stopped, first).is_none());
    let some = first_rectangles(Some(4.0));
    assert!(
        some.iter().all(|r| r.a[1].max(r.b[1]) < 4.0) && some.len() > 30 && some.len() < all.len()
    );
}

/// A bound that is not a number is none.
#[test]
fn what_is_not_a_number_is_no_bound() {
    let at = Rectangle {
        a: [3.0, 3.1],
        b: [3.0, 3.1],
    };
    for k in 0..3 {
        let part = |i| if i == k { f64::NAN } else { 0.5 };
        let bound = Bound {
            norm: part(0),
            re: part(1),
            im: part(2),
            tiny: 0.0,
        };
        let leaf = |bound| Leaf {
            at,
            formula: Formula::Strip,
            bound,
        };
        for leaves in [
            [leaf(bound), leaf(Bound::NONE)],
            [leaf(Bound::NONE), leaf(bound)],
        ] {
            assert_eq!(UPPER_HALF_PLANE.excess(&leaves), f64::INFINITY);
        }
        let both = [bound.max(Bound::NONE), Bound::NONE.max(bound)];
        for b in both {
            assert_eq!([b.norm, b.re, b.im][k], f64::INFINITY);
        }
    }
}

/// A target that is met exactly needs no cut, and a proof that is stopped has no leaves.
#[test]
fn halving_ends_at_the_target_and_when_it_is_stopped() {
    let at = Rectangle {
        a: [3.0, 3.001],
        b: [3.0, 3.001],
    };
    let leaves = |norm: f64, depth: u32, watch: &Watch| {
        let target = Target {
            norm,
            component: f64::INFINITY,
            depth,
        };
        on_rectangle(&CODE, target, watch, at).map(|found| found.leaves)
    };
    let watch = Watch::default();
    let norm = leaves(0.45, 0, &watch).expect("not stopped")[0].bound.norm;
    assert_eq!(leaves(norm, 5, &watch).map(|all| all.len()), Some(1));
    assert!(leaves(norm.next_down(), 5, &watch).is_some_and(|all| all.len() > 1));
    watch.stop.store(true, std::sync::atomic::Ordering::Relaxed);
    assert!(leaves(norm.next_down(), 5, &watch).is_none());
}
