use super::*;
use proptest::prelude::*;

fn gathered(values: impl IntoIterator<Item = f64>) -> SpreadTally {
    let mut tally = SpreadTally::default();
    values.into_iter().for_each(|v| tally.add(v));
    tally
}

fn of(values: impl IntoIterator<Item = f64>) -> Spread {
    gathered(values).spread()
}

#[test]
fn spread() {
    let s = of((1..=200).map(f64::from).chain([f64::NAN]));
    assert_eq!((s.count, s.max, s.beyond), (200, 200.0, 0));
    assert!((198.0..198.2).contains(&s.p99), "{}", s.p99);
    assert!((100.0..100.2).contains(&s.median), "{}", s.median);
    assert_eq!(s.rms, (201.0f64 * 401.0 / 6.0).sqrt());
    assert_eq!(of([]), Spread::default());
    for large in [1e160, 1e300, 1e-300] {
        let s = of([large, 0.0, large, 0.0]);
        assert!((s.rms / large - 0.5f64.sqrt()).abs() < 1e-15, "{s:?}");
    }
    let s = of([f64::MAX, f64::MAX]);
    assert_eq!((s.max, s.rms), (f64::MAX, f64::MAX));
    assert_eq!(of([0.0; 5]).p99, 0.0);
}

#[test]
fn octaves() {
    let tally = gathered([0.0, 1.5, 1.0, 0.26, f64::INFINITY]);
    assert_eq!(tally.octaves(), [(None, 1), (Some(-2), 1), (Some(0), 2)]);
    for x in [1.0, 1.999, 0.3, 1e-300, 1e300] {
        assert_eq!(octave(x), Some(x.log2().floor() as i32), "{x}");
    }
    let mut coarse = SpreadTally::coarse();
    [0.0, 1e-300, 1e-7].iter().for_each(|x| coarse.add(*x));
    assert_eq!(coarse.octaves(), [(None, 1), (Some(-20), 2)]);
}

/// A list of numbers becomes an array of counts where it is full, whatever came first.
#[test]
fn full_lists_are_counted() {
    let full = FEW as u32;
    for n in [full - 1, full, full + 1, 3 * full] {
        let value = |k: u32| 1.0 + f64::from(k * 37 % 64) / 64.0;
        let whole = gathered((0..n).map(value));
        assert_eq!(whole, gathered((0..n).rev().map(value)));
        for cut in [1, n / 2, n - 1] {
            let (mut a, b) = (gathered((0..cut).map(value)), gathered((cut..n).map(value)));
            a.merge(&b);
            assert_eq!(a, whole);
            assert_eq!(a.octaves(), [(Some(0), u64::from(n))]);
        }
        let counts: Vec<u64> = whole.bins().map(|b| b.1).collect();
        assert_eq!((counts.len(), counts.iter().sum()), (64, u64::from(n)));
        assert_eq!(whole.quantile(10_000), 1.0 + 63.0 / 64.0);
    }
    // Of as many numbers with the same largest one and the same squares.
    assert_ne!(gathered([17.0, 31.0, 31.0]), gathered([25.0, 25.0, 31.0]));
    // Subnormal numbers are in one octave with the smallest normal ones, and not zeros.
    let low = gathered([0.0, 5e-309, f64::MIN_POSITIVE]);
    assert_eq!(low.octaves(), [(None, 1), (Some(-1022), 2)]);
}

/// Sums of squares beyond 128 bits.
#[test]
fn carries_are_kept() {
    let x = 2f64.next_down();
    let mut tally = gathered([x]);
    for _ in 0..40 {
        let same = tally.clone();
        tally.merge(&same);
    }
    let s = tally.spread();
    assert_eq!((s.count, s.rms), (1 << 40, x));
}

/// The end of the bin of `x`.
fn end(x: f64, dropped: u32) -> f64 {
    f64::from_bits(x.to_bits() | ((1 << dropped) - 1))
}

/// Each percentile by its rank: the numbers at its rank, before it and after it differ.
#[test]
fn percentiles_are_those_of_their_ranks() {
    let ranked = |parts: &[(u64, f64)]| {
        let each = parts.iter();
        of(each.flat_map(|(n, x)| (0..*n).map(move |_| *x)))
    };
    let s = ranked(&[
        (4999, 0.0),
        (1, 1.0),
        (4899, 1.5),
        (1, 2.0),
        (98, 2.5),
        (1, 3.0),
        (1, 4.0),
    ]);
    assert_eq!((s.count, s.max), (10_000, 4.0));
    assert_eq!(s.median, end(1.0, DROPPED));
    assert_eq!(s.p99, end(2.0, DROPPED));
    assert_eq!(s.p9999, Some(end(3.0, DROPPED)));
    // Of twice as many.
    let s = ranked(&[(19_997, 0.0), (1, 1.0), (2, 2.0)]);
    assert_eq!((s.p99, s.p9999), (0.0, Some(end(1.0, DROPPED))));
    assert_eq!(ranked(&[(9999, 1.0)]).p9999, None);
    // The end of the last bin is the largest number.
    assert_eq!(ranked(&[(3, 1.0)]).median, 1.0);
}

/// Bins end just below the next; a coarse one is eight times as wide.
#[test]
fn percentiles_are_the_ends_of_bins() {
    for (mut tally, dropped) in [
        (SpreadTally::default(), DROPPED),
        (SpreadTally::coarse(), DROPPED_COARSELY),
    ] {
        let width = f64::from_bits(1.0f64.to_bits() + (1 << dropped)) - 1.0;
        for x in [1.0, 1.0 + width, 1.0 + 2.5 * width, 8.0] {
            tally.add(x);
        }
        assert_eq!(tally.quantile(2500), (1.0 + width).next_down());
        assert_eq!(tally.quantile(5000), (1.0 + 2.0 * width).next_down());
        assert_eq!(tally.quantile(7500), (1.0 + 3.0 * width).next_down());
        assert_eq!(tally.quantile(10_000), 8.0);
    }
    let none = SpreadTally::default();
    assert_eq!((none.quantile(5000), none.rms()), (0.0, 0.0));
}

/// Every bit of a number counts, of the smallest as well.
#[test]
fn a_root_mean_square_of_one_number_is_that_number() {
    let tiny = f64::MIN_POSITIVE;
    for x in [
        1.0f64.next_up(),
        1.0f64.next_down(),
        tiny,
        tiny.next_up(),
        tiny.next_down(),
        2.0 * tiny,
        f64::from_bits(1),
        f64::from_bits(1 << 45 | 5),
    ] {
        assert_eq!(of([x; 3]).rms, x, "{x:e}");
    }
    // (3, 4) · 2^-1074 on both sides of the smallest normal number.
    let s = of([3.0 * tiny, 4.0 * tiny, tiny / 2.0, tiny / 2.0]);
    assert_eq!(s.rms, (25.5f64 / 4.0).sqrt() * tiny);
}

#[test]
fn errors_beyond_every_number_add_up() {
    let mut a = gathered([f64::INFINITY, 1.0, f64::INFINITY]);
    a.merge(&gathered([f64::INFINITY; 3]));
    let s = a.spread();
    assert_eq!((s.beyond, s.count, s.max), (5, 1, 1.0));
    assert_eq!((s.p99, s.rms), (1.0, 1.0));
    let s = of([f64::INFINITY]);
    assert_eq!((s.count, s.beyond, s.max), (0, 1, 0.0));
}

/// Zeros and the smallest numbers, in octaves as in coarse bins.
#[test]
fn the_smallest_octaves() {
    let tiny = f64::MIN_POSITIVE;
    let least = f64::from_bits(1 << DROPPED_COARSELY);
    for (x, expected) in [
        (0.0, None),
        (least.next_down(), None),
        (least, Some(-1022)),
        (tiny.next_down(), Some(-1022)),
        (tiny, Some(-1022)),
        ((2.0 * tiny).next_down(), Some(-1022)),
        (2.0 * tiny, Some(-1021)),
        (4.0 * tiny, Some(-1020)),
    ] {
        assert_eq!(octave(x), expected, "{x:e}");
    }
}

/// Bins and sums that were stored are those of finite numbers.
#[test]
fn stored_bins_are_those_of_numbers() {
    let set = |field: u32| {
        let mut tally = SpreadTally::coarse();
        let shift = 52 - DROPPED_COARSELY;
        (tally.count_in_bin(field << shift, 3), tally)
    };
    for (field, expected) in [
        (0, true),
        (1023, true),
        (2046, true),
        (2047, false),
        (2048, false),
    ] {
        let (done, tally) = set(field);
        assert_eq!(done.is_some(), expected, "{field}");
        assert_eq!(
            tally.bins().map(|b| b.1).sum::<u64>(),
            if expected { 3 } else { 0 }
        );
    }
    // A sum belongs to bins of its exponent.
    let squares = Squares { low: 9, carry: 0 };
    for (field, exponent) in [(0, -1074), (1, -1074), (2, -1073), (1023, -52)] {
        let mut tally = set(field).1;
        assert_eq!(tally.set_squares(exponent, squares), Some(()));
        assert_eq!(tally.squares().collect::<Vec<_>>(), [(exponent, squares)]);
        assert_eq!(tally.set_squares(exponent + 1, squares), None);
        assert_eq!(tally.set_squares(i32::MAX, squares), None);
        assert_eq!(tally.set_squares(-1076, squares), None);
    }
}

/// Not negative, of every size.
fn any_error() -> impl Strategy<Value = f64> {
    prop_oneof![
        (0..u64::MAX >> 1).prop_map(f64::from_bits),
        0.0..10.0f64,
        Just(0.0),
    ]
}

proptest! {
    #[test]
    fn merging_is_adding_in_any_order(
        values in prop::collection::vec(any_error(), 0..60),
        cuts in prop::array::uniform2(0usize..60),
    ) {
        let whole = gathered(values.iter().copied());
        let backwards = gathered(values.iter().rev().copied());
        prop_assert_eq!(&whole, &backwards);
        let cut = |k: usize| k.min(values.len());
        let (i, j) = (cut(cuts[0].min(cuts[1])), cut(cuts[0].max(cuts[1])));
        let part = |r: std::ops::Range<usize>| gathered(values[r].iter().copied());
        let (a, b, c) = (part(0..i), part(i..j), part(j..values.len()));
        let merged = |x: &SpreadTally, y: &SpreadTally| {
            let mut x = x.clone();
            x.merge(y);
            x
        };
        prop_assert_eq!(&merged(&a, &b), &merged(&b, &a));
        prop_assert_eq!(&merged(&merged(&a, &b), &c), &merged(&a, &merged(&b, &c)));
        let all = merged(&merged(&c, &a), &b);
        prop_assert_eq!(&all, &whole);
        let bits = |s: Spread| [s.max, s.p99, s.median, s.rms].map(f64::to_bits);
        prop_assert_eq!(bits(all.spread()), bits(whole.spread()));
    }
}

/// A list holds 256 numbers of an octave; an array of all bins takes the place of more.
#[test]
fn lists_and_arrays_have_their_sizes() {
    let bins = |tally: &SpreadTally| {
        let bins = &tally.octaves.get(1023).unwrap().bins;
        (bins.few.len(), bins.all.len())
    };
    for (empty, all) in [
        (SpreadTally::default(), 1 << 10),
        (SpreadTally::coarse(), 1 << 7),
    ] {
        let mut tally = empty.clone();
        for n in 1..=FEW {
            tally.add(1.5);
            assert_eq!(bins(&tally), (n, 0));
        }
        let mut merged = empty;
        merged.merge(&tally);
        assert_eq!(bins(&merged), (FEW, 0));
        tally.add(1.5);
        assert_eq!(bins(&tally), (0, all));
        tally.add(1.5);
        assert_eq!(bins(&tally), (1, all));
    }
}
