use super::*;
use proptest::prelude::*;
use rug::Rational;

/// The sum of terms and of their magnitudes.
fn exact(terms: &[(Float, Float, i64)]) -> [Rational; 2] {
    let mut sums = [Rational::new(), Rational::new()];
    for (a, b, w) in terms {
        let term = a.to_rational().unwrap() * b.to_rational().unwrap() * w;
        sums[1] += term.clone().abs();
        sums[0] += term;
    }
    sums
}

/// Returns the error of the sum in units of `u Σ |w a b|`.
fn error(terms: &[(Float, Float, i64)], bits: u32) -> f64 {
    let a: Vec<Float> = terms.iter().map(|t| t.0.clone()).collect();
    let b: Vec<Float> = terms.iter().rev().map(|t| t.1.clone()).collect();
    let found = convolution(
        [&a, &b],
        terms.len() - 1,
        [0, terms.len() - 1],
        |i| terms[i].2,
        bits,
    );
    assert_eq!(found.prec(), bits);
    let [sum, norm] = exact(terms);
    let off = (found.to_rational().unwrap() - sum).abs();
    if norm == 0 {
        assert_eq!(off, 0);
        return 0.0;
    }
    ((off / norm) << bits).to_f64()
}

fn number(bits: u32) -> impl Strategy<Value = Float> {
    let words = proptest::collection::vec(any::<u64>(), bits.div_ceil(64) as usize);
    (words, -300i32..300, any::<bool>(), 0u32..12).prop_map(move |(words, e, negative, kind)| {
        let mut x = Float::with_val(bits, &Integer::from_digits(&words, Order::Lsf));
        match kind {
            0 => x.assign(0),
            1 => x.assign(1),
            2 => x = -(Float::with_val(bits, 1) >> bits) + 1u32,
            _ => (),
        }
        x <<= if kind > 6 { e } else { e % 3 };
        if negative { -x } else { x }
    })
}

fn sums() -> impl Strategy<Value = (u32, Vec<(Float, Float, i64)>)> {
    (20u32..600).prop_flat_map(|bits| {
        let weight = prop_oneof![Just(1i64), -70i64..70, any::<i64>()];
        let term = (number(bits), number(bits), weight);
        (Just(bits), proptest::collection::vec(term, 1..40))
    })
}

proptest! {
    /// One rounding, and almost nothing else.
    #[test]
    fn sums_are_rounded_once((bits, terms) in sums()) {
        let most = if bits.div_ceil(64) as usize <= MOST { 1.0 + 1e-6 } else { 80.0 };
        let found = error(&terms, bits);
        prop_assert!(found <= most, "{bits}: {found}");
    }

    /// Terms that cancel leave no more than what was cut off: nothing here, where all words fit.
    #[test]
    fn terms_that_cancel_leave_nothing(terms in proptest::collection::vec((number(128), number(128)), 1..20)) {
        let twice = terms.iter().map(|(a, b)| (a.clone(), b.clone(), 1i64));
        let negative = terms.iter().map(|(a, b)| (-a.clone(), b.clone(), 1i64));
        let all: Vec<_> = twice.chain(negative).collect();
        prop_assert_eq!(error(&all, 128), 0.0);
    }
}

/// Numbers of other precisions, and such that are none, take the other way.
#[test]
fn other_numbers_are_rounded_one_by_one() {
    let one = |bits| Float::with_val(bits, 1);
    let sum = |a: Float, b: Float| convolution([&[a], &[b]], 0, [0, 0], |_| 3, 128);
    assert_eq!(sum(one(300), one(128)), 3);
    assert_eq!(sum(one(64), one(64)), 3);
    assert!(sum(Float::with_val(128, f64::INFINITY), one(128)).is_infinite());
    assert!(sum(Float::with_val(128, f64::NAN), one(128)).is_nan());
    assert_eq!(convolution([&[], &[]], 0, [1, 0], |_| 1, 128), 0);
}

/// A sum of many terms carries into the last word and back.
#[test]
fn carries_reach_the_last_word() {
    let n = 5000;
    let a = vec![Float::with_val(64, u64::MAX); n];
    for sign in [1, -1] {
        let sum = convolution([&a, &a], n - 1, [0, n - 1], |_| sign, 64);
        let due = Integer::from(u64::MAX).square() * n as i64 * sign;
        assert_eq!(sum, Float::with_val(64, &due));
    }
    let turns = convolution([&a, &a], n - 1, [0, n - 1], |i| 1 - 2 * (i as i64 % 2), 64);
    assert!(turns.is_zero());
}
