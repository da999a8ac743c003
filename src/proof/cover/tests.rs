use super::*;
use crate::pinned::{bit_by_bit, counted, of_binades, units};

#[test]
fn halves_cover_the_whole() {
    let whole = Rectangle {
        a: [1.0, 4.0],
        b: [0.0, 0.5],
    };
    for across_re in [true, false] {
        let [p, q] = whole.halves(across_re);
        let (side, first, second) = match across_re {
            true => (whole.a, p.a, q.a),
            false => (whole.b, p.b, q.b),
        };
        assert_eq!((first[0], second[1]), (side[0], side[1]));
        assert_eq!(first[1].next_up(), second[0]);
    }
}

#[test]
fn pieces_are_constant_and_adjacent() {
    let found = pieces([0.0, 10.0], |x| x.floor() as i64);
    assert_eq!(found.len(), 11);
    for pair in found.windows(2) {
        assert_eq!(pair[0].0[1].next_up(), pair[1].0[0]);
    }
}

/// Every `f64` of the closed quadrant is in exactly one rectangle: none is in no one, and there are
/// no more numbers in all of them than there are.
#[test]
fn the_first_partition_has_no_overlap() {
    let numbers = |[lo, hi]: [f64; 2]| u128::from(hi.to_bits() - lo.to_bits()) + 1;
    let all = roots();
    assert!(all.iter().all(|r| r.a[0] <= r.a[1] && r.b[0] <= r.b[1]));
    let sum: u128 = all.iter().map(|r| numbers(r.a) * numbers(r.b)).sum();
    let finite = numbers([0.0, f64::MAX]);
    assert_eq!(sum, finite * finite);
    assert_eq!(hole(&all), None);
    // Whole binades, so that what is scaled has one power of two.
    for r in all.iter().filter(|r| r.a[0].max(r.b[0]) > 1e-300) {
        assert!(r.scaled().is_some(), "{r:?}");
    }
}

/// A strip of one number that is missing is found, wherever it is; without rectangles everything
/// is.
#[test]
fn a_missing_number_is_found() {
    assert_eq!(hole(&[]), Some([0.0, 0.0]));
    let to = |a, b| Rectangle { a, b };
    let (one, most) = (1.0f64, f64::MAX);
    let below = one.next_down();
    let quarters = [
        to([0.0, below], [0.0, below]),
        to([0.0, below], [one, most]),
        to([one, most], [0.0, below]),
        to([one, most], [one, most]),
    ];
    assert_eq!(hole(&quarters), None);
    for i in 0..4 {
        for side in 0..4 {
            let mut some = quarters;
            let r = &mut some[i];
            let ends = match side / 2 {
                0 => &mut r.a,
                _ => &mut r.b,
            };
            let missing = ends[side % 2];
            ends[side % 2] = match side % 2 {
                0 => missing.next_up(),
                _ => missing.next_down(),
            };
            let found = hole(&some).expect("a hole");
            assert_eq!(found[side / 2], missing, "{i} {side} {found:?}");
            let whole = quarters[i];
            let inside = |[lo, hi]: [f64; 2], x: f64| lo <= x && x <= hi;
            assert!(inside(whole.a, found[0]) && inside(whole.b, found[1]));
        }
    }
    // One point alone.
    let next = one.next_up();
    let around = [
        to([0.0, below], [0.0, most]),
        to([next, most], [0.0, most]),
        to([one, one], [0.0, below]),
        to([one, one], [next, most]),
    ];
    assert_eq!(hole(&around), Some([one, one]));
}

/// Every number divided by the power of two is inside, and the ends are next to the quotients.
#[test]
fn scaled_rectangles_hold_the_quotients() {
    let exact = |x: f64| rug::Rational::from_f64(x).expect("finite");
    for r in [
        Rectangle {
            a: [1e200, 1.2e200],
            b: [1e190, 1e199],
        },
        Rectangle {
            a: [1e190, 1e199],
            b: [1e200, 1.2e200],
        },
        Rectangle {
            a: [1.7e308, f64::MAX],
            b: [0.0, 1e-320],
        },
        Rectangle {
            a: [1e300, 1.1e300],
            b: [3e-10, 7e-10],
        },
    ] {
        let k = crate::grid::exponent(r.a[1].max(r.b[1]));
        let scaled = r.scaled().expect("one power of two");
        for ([lo, hi], [p, q]) in [(scaled.a, r.a), (scaled.b, r.b)] {
            let [p, q] = [p, q].map(|x| exact(x) >> k);
            assert!(exact(lo) <= p && q <= exact(hi), "{r:?} {scaled:?}");
            let few = |x: f64, due: &rug::Rational| {
                exact(x.next_down().next_down().max(0.0)) <= *due
                    && *due <= exact(x.next_up().next_up())
            };
            assert!(few(lo, &p) && few(hi, &q), "{r:?} {scaled:?}");
            // Exact values stay as they are.
            let kept =
                |x: f64, due: &rug::Rational| exact(due.to_f64()) != *due || exact(x) == *due;
            assert!(kept(lo, &p) && kept(hi, &q), "{r:?} {scaled:?}");
        }
        assert!((1.0..2.0).contains(&scaled.a[1].max(scaled.b[1])));
    }
    let wide = Rectangle {
        a: [1e200, 4e200],
        b: [0.0, 1.0],
    };
    assert!(wide.scaled().is_none());
    let point = Rectangle {
        a: [3e200; 2],
        b: [7e190; 2],
    };
    let scaled = point.scaled().expect("one power of two");
    assert_eq!((scaled.a[0], scaled.b[0]), (scaled.a[1], scaled.b[1]));
}

/// Pieces of a function with steps at any place, of one number and without a step.
#[test]
fn pieces_of_steps() {
    for step in [1.0, 1.5, 2.0f64.next_down(), 2.0] {
        let found = pieces([1.0, 2.0], |x| x >= step);
        match step > 1.0 {
            true => assert_eq!(
                found,
                [([1.0, step.next_down()], false), ([step, 2.0], true)]
            ),
            false => assert_eq!(found, [([1.0, 2.0], true)]),
        }
    }
    assert_eq!(pieces([3.0, 3.0], |x| x as u8), [([3.0, 3.0], 3)]);
    assert_eq!(pieces([1.0, 2.0], |_| 7), [([1.0, 2.0], 7)]);
}

/// Halves of rectangles, and the way they are cut.
#[test]
fn cuts_bit_by_bit() {
    let mut unit = units(12);
    let mut all = roots();
    let one = |x: f64| [x, x];
    let next = |x: f64| [x, x.next_up()];
    for (a, b) in [
        (one(0.0), one(0.0)),
        (one(1.0), one(1.0)),
        (one(1.0), next(1.0)),
        (next(1.0), one(1.0)),
        (next(1.0), next(1.0)),
        (next(2.0), next(1.0)),
        (next(1.0), next(2.0)),
        (next(1.0), [1.0, 2.0]),
        ([1.0, 2.0], next(1.0)),
        (one(3.0), [1.0, 2.0]),
        ([1.0, 2.0], one(3.0)),
        ([1.0, 2.0], [2.0, 3.0]),
        ([1.0, 1.5], [1.0, 1.25]),
        ([1.0, 1.5], [2.0, 2.5]),
    ] {
        all.push(Rectangle { a, b });
    }
    for i in 0..200 {
        let [a, b] = [0; 2].map(|_| match i % 2 {
            0 => 8.0 * unit(),
            _ => of_binades(&mut unit, [-50, 20]),
        });
        let [p, q] = [0; 2].map(|_| of_binades(&mut unit, [-8, 1]));
        all.push(Rectangle {
            a: [a, a + p],
            b: [b, b + q],
        });
    }
    let cuts = all
        .iter()
        .map(|r| [true, false].map(|x| (r.across_re(x), r.halves(x))));
    let scaled = all.iter().map(|r| (r.scaled(), r.small_re(), r.small_im()));
    let found = [
        counted("roots", roots()),
        counted("cuts", cuts),
        counted("scaled", scaled),
    ];
    let due = [
        ("roots", 0x8fe9c43e940343a4, 14464.0),
        ("cuts", 0x8eb8973f74a01200, 14678.0),
        ("scaled", 0xf0307af99bd5c025, 14678.0),
    ];
    bit_by_bit(&found, &due);
}

#[test]
fn rectangles_below_a_limit() {
    let is = |limit, a: f64, b: f64| {
        let (a, b) = ([1.0, a], [0.5, b]);
        Rectangle { a, b }.is_below(limit)
    };
    assert!(is(None, 1e9, 1e9) && is(Some(4.0), 3.0, 3.5));
    assert!(is(Some(4.0), 3.5, 3.0) && !is(Some(4.0), 4.0, 1.5));
    assert!(!is(Some(4.0), 5.0, 2.0) && !is(Some(4.0), 2.0, 5.0));
}
