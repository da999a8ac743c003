//! How rectangles are cut.

use super::tests::CODE;
use super::*;
use crate::cover::hole;
use crate::pinned::{bit_by_bit, counted, digest};

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

/// How rectangles are halved, which cut is better, and what a proof begins with.
#[test]
fn halves_bit_by_bit() {
    use std::sync::atomic::Ordering;
    let watch = Watch::default();
    let strict = Target {
        norm: 0.45,
        component: 0.9,
        depth: 6,
    };
    let of = |target: Target, a: [f64; 2], b: [f64; 2]| {
        let found = on_rectangle(&CODE, target, &watch, Rectangle { a, b }).expect("not stopped");
        (found.leaves, found.open)
    };
    let proved = [
        of(UPPER_HALF_PLANE, [2.0, 2.5], [2.0, 2.5]),
        of(UPPER_HALF_PLANE, [9.0, 9.05], [0.0, 0.5]),
        of(strict, [1.0, 1.05], [1.0, 1.1]),
        of(strict, [3.0; 2], [1.0, 1.1]),
    ];
    let leaves = proved.iter().map(|p| p.0.len()).sum::<usize>();
    // A target that is met exactly.
    let at = Rectangle {
        a: [3.0, 3.001],
        b: [3.0, 3.001],
    };
    let norm = on_rectangle(&CODE, Target { depth: 0, ..strict }, &watch, at).expect("not stopped");
    let met = Target {
        norm: norm.leaves[0].bound.norm,
        component: f64::INFINITY,
        depth: 5,
    };
    let met = of(met, at.a, at.b);
    let shell = |_: usize, r: &Rectangle| [r.a, r.b] == [[4.0, 8f64.next_down()]; 2];
    let shallow = Target { depth: 3, ..strict };
    let shallow = upper_half_plane(&CODE, shallow, &watch, shell).expect("not stopped");
    let leaf = |norm, component, formula, a: [f64; 2]| Leaf {
        at: Rectangle { a, b: [0.0, 1.0] },
        formula,
        bound: Bound {
            norm,
            re: component,
            im: 0.5,
            tiny: 0.0,
        },
    };
    let target = Target {
        norm: 1.25,
        component: 4.0,
        depth: 1,
    };
    let worse = [
        [1.0, 1.0],
        [2.5, 8.0],
        [2.5, 9.0],
        [2.5, 7.0],
        [1.25, 4.0],
        [1.0, 3.5],
    ];
    let worse = worse.map(|[n, c]| {
        let leaves = [
            leaf(n, c, Formula::Strip, [1.0; 2]),
            leaf(0.5, 0.5, Formula::Strip, [1.0; 2]),
        ];
        (target.norm_is_worse(&leaves), target.excess(&leaves))
    });
    let cuts = [
        [0.89, 1.0],
        [0.9, 1.0],
        [1.0, 0.9],
        [1.0, 0.8],
        [0.9 * 3.0, 3.0],
        [0.0, 0.0],
        [f64::INFINITY; 2],
    ];
    let cuts = cuts.map(|[p, q]| better_cut(p, q));
    let row = Formula::RealAxis { centre: 3.0 };
    let mut beside = Vec::new();
    for formula in [Formula::Strip, Formula::RealLine, row] {
        for side in [0.003, 0.00390625, 0.004, 0.005, 0.03, 0.032, 0.04] {
            for b in [[0.0, 1e-20], [1e-3, 2e-3], [0.0, 1.0], [0.5, 1.0]] {
                let at = Rectangle { a: [0.0, side], b };
                beside.push(beside_real_axis(&at, &[leaf(1.0, 1.0, formula, at.a)]));
            }
        }
    }
    let limits = [
        None,
        Some(3.0),
        Some(4f64.next_down()),
        Some(4.0),
        Some(1e300),
    ];
    let first = limits.map(|limit| first_rectangles(limit).len());
    watch.stop.store(true, Ordering::Relaxed);
    assert!(upper_half_plane(&CODE, strict, &watch, shell).is_none());
    let found = [
        ("proved", digest(proved), leaves as f64),
        ("met", digest([&met.0]), met.0.len() as f64),
        (
            "shallow",
            digest([&shallow.leaves]),
            shallow.leaves.len() as f64,
        ),
        counted("worse", worse),
        counted("cuts", cuts),
        counted("beside the real axis", beside),
        counted("first", first),
    ];
    let due = [
        ("proved", 0x4c34e90f38432df2, 39.0),
        ("met", 0x005f4f93c91dc785, 1.0),
        ("shallow", 0x6b7daf96cee3e4cc, 8.0),
        ("worse", 0x54351bfe8038feab, 6.0),
        ("cuts", 0xb473533274962f1f, 7.0),
        ("beside the real axis", 0xee169cf5bc8e0a70, 84.0),
        ("first", 0x9fe65d364c88f135, 5.0),
    ];
    bit_by_bit(&found, &due);
}
