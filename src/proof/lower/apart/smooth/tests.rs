use super::*;
use crate::ProofError;
use rug::Rational;

fn smooth(value: Value<'_>, few: bool) -> Smooth<'_> {
    Smooth {
        value,
        shift: &|_| 0,
        most: &|n| 2.0 * n as f64,
        few,
    }
}

fn exact(x: Rational, bits: u32) -> Result<Ball, ProofError> {
    Ok(Ball::rational(bits, &x))
}

/// Every number is in one block, which reaches no farther than its polynomial is good for.
#[test]
fn blocks_follow_one_another() {
    let nothing = |_: u64, _: u32| Err("".into());
    for few in [true, false] {
        let all = smooth(&nothing, few);
        for (first, last) in [
            (1, 1),
            (1, 64),
            (5, 70),
            (1, (1 << 15) + 2000),
            ((1 << 15) - 1, 1 << 15),
            (1 << 15, (1 << 15) + 143),
            (1 << 15, (1 << 15) + 144),
            (1 << 20, (1 << 20) + 5000),
            ((1 << 24) - 1, (1 << 24) + 100_000),
            (1 << 30, (1 << 30) + 100_000),
        ] {
            let blocks = all.blocks(first, last);
            let mut next = first;
            for block in &blocks {
                let (at, len, values, h) = (block.first, block.len, block.values, block.h);
                assert_eq!(at, next, "{first} {last}");
                assert!(len > 0);
                next += len;
                if values == 0 {
                    assert!(at < 1 << 15 && len <= 64 && next <= 1 << 15);
                    continue;
                }
                let many = few || at < 1 << 24;
                assert_eq!(values, if many { 10 } else { 7 });
                assert!(at >= 1 << 15 && h > 0 && len <= (values - 1) * h);
                // The distance, in parts of a quarter of the number.
                assert!(4.0 * h as f64 / at as f64 <= 1.0 / 4000.0, "{at} {h}");
                assert!(next > last || len == (values - 1) * h);
            }
            assert_eq!(next, last + 1, "{first} {last}");
        }
        assert_eq!(
            all.stays_off(7, 6, &Watch::default()),
            Ok(Some(0)),
            "none of them"
        );
    }
}

/// A polynomial of the degree that the values determine is stepped without an error but that of the
/// last bits.
#[test]
fn differences_step_a_polynomial() {
    for (values, h) in [(10, 7), (10, 113), (7, 1365), (1, 5), (2, 1)] {
        let of = |t: u64| {
            let (mut x, mut power) = (Rational::from((-5, 7)), Rational::from(1));
            for i in 1..values {
                power *= Rational::from((t, 1000));
                x += Rational::from((3 * i as i64 - 11, 13)) * &power;
            }
            x
        };
        let table = (0..values).map(|i| Float::with_val(EXACT, of(i * h)));
        let mut step = unit_differences(table.collect(), h);
        assert_eq!(step.len() as u64, values);
        for t in 0..=(values - 1) * h {
            let due = (of(t) << 128u32).round();
            let due = due.numer().clone().modulo(&(Integer::from(1) << 128));
            let off = step[0].wrapping_sub(due.to_u128().expect("below 2^128"));
            let off = off.min(off.wrapping_neg());
            assert!(off < 1 << 74, "{values} {h} {t}: {off}");
            for i in 1..step.len() {
                step[i - 1] = step[i - 1].wrapping_add(step[i]);
            }
        }
    }
}

/// One whole value among many, at every place of a block of each kind, and one that is off by a
/// little.
#[test]
fn one_whole_value_is_found_anywhere() {
    let watch = Watch::default();
    for (few, first, count) in [
        (true, 100, 64),
        (true, 1 << 16, 279),
        (true, 1 << 22, 1017),
        (false, 1 << 25, 2046),
    ] {
        for at in [0, 1, 2, count / 2, count - 2, count - 1] {
            // At most a quarter from 0, and 0 at that number alone, or off by 2⁻⁵⁰.
            let line = |off: i64| {
                move |n: u64, bits: u32| {
                    let from = n as i64 - (first + at) as i64;
                    let x = Rational::from((from, 1i64 << 14)) + Rational::from((off, 1i64 << 50));
                    exact(x, bits)
                }
            };
            let on = |off: i64| {
                let value = line(off);
                smooth(&value, few).stays_off(first, first + count - 1, &watch)
            };
            assert!(on(0).is_err(), "{first} {at}");
            let value = line(0);
            let doubled = Smooth {
                shift: &|_| 1,
                ..smooth(&value, few)
            };
            let found = doubled.stays_off(first, first + count - 1, &watch);
            assert!(found.is_err(), "{first} {at} doubled");
            for off in [-1, 1] {
                assert_eq!(on(off), Ok(Some(count)), "{first} {at} {off}");
            }
        }
    }
}

/// Checks what a value may be off by: a power of two moves it, a doubt of it counts, a bound that
/// says too little refuses it.
#[test]
fn what_a_polynomial_is_wrong_by_is_bounded() {
    let watch = Watch::default();
    let third = |n: u64, bits: u32| exact(Rational::from((3 * n + 1, 3)), bits);
    let first = 1 << 20;
    let whole = |shift: i32, most: f64, few: bool| {
        let all = Smooth {
            value: &third,
            shift: &|_| shift,
            most: &|_| most,
            few,
        };
        all.stays_off(first, first + 99, &watch)
    };
    let block = |most: f64, few: bool| whole(0, most, few);
    assert_eq!(block(2.0 * first as f64, true), Ok(Some(100)));
    // h = 56: (4h/n)^10 9!/4 of the bound has to stay below 2⁻³¹.
    let ratio: f64 = 4.0 * 56.0 / first as f64;
    let most = 2f64.powi(-31) / (ratio.powi(10) * 0.25 * 362_880.0);
    assert_eq!(block(0.999 * most, true), Ok(Some(100)));
    assert!(block(1.001 * most, true).is_err());
    // A third of a power of two is off as well, and twice the bound.
    assert_eq!(whole(1, 0.499 * most, true), Ok(Some(100)));
    assert!(whole(1, 0.501 * most, true).is_err());
    // A doubt of 2⁻⁴³ in each value: ten times 2¹¹ of it are more than 2⁻³¹.
    let doubtful = |doubt: i64| {
        move |n: u64, bits: u32| {
            let x = exact(Rational::from((3 * n + 1, 3)), bits)?;
            Ok(Ball::new(x.mid().clone(), Mag::power_of_two(doubt)))
        }
    };
    let with = |doubt: i64| {
        let value = doubtful(doubt);
        smooth(&value, true).stays_off(first, first + 99, &watch)
    };
    assert_eq!(with(-46), Ok(Some(100)));
    assert!(with(-45).is_err());
    // At single numbers it is the distance from a whole one that counts.
    let near = |doubt: i64| {
        let value = doubtful(doubt);
        smooth(&value, true).stays_off(100, 163, &watch)
    };
    assert_eq!(near(-2), Ok(Some(64)));
    assert!(near(-1).is_err());
    watch.stop.store(true, std::sync::atomic::Ordering::Relaxed);
    assert_eq!(smooth(&third, true).stays_off(1, 10, &watch), Ok(None));
}

/// Checks that what the differences themselves are wrong by, 2⁻⁵⁴, is a part of what is allowed.
#[test]
fn errors_of_the_differences_count() {
    let watch = Watch::default();
    let third = |n: u64, bits: u32| exact(Rational::from((3 * n + 1, 3)), bits);
    let first = 1 << 20;
    let passes = |most: f64| {
        let all = Smooth {
            value: &third,
            shift: &|_| 0,
            most: &|_| most,
            few: true,
        };
        all.stays_off(first, first + 99, &watch).is_ok()
    };
    let ratio = 4.0 * 56.0 / first as f64;
    let share = ratio.powi(10) * 0.25 * 362_880.0;
    let (mut below, mut above) = (0.5 * f64::exp2(-31.0) / share, f64::exp2(-30.0) / share);
    for _ in 0..60 {
        let middle = 0.5 * (below + above);
        match passes(middle) {
            true => below = middle,
            false => above = middle,
        }
    }
    let left = (f64::exp2(-31.0) - below * share) / f64::exp2(-54.0);
    assert!((0.9..1.1).contains(&left), "{left}");
}

/// A value that may be within 2⁻⁶⁰ of a whole number is refused.
#[test]
fn values_next_to_whole_numbers_are_refused() {
    let watch = Watch::default();
    let found = [59, 60, 61].map(|off| {
        let value = |n: u64, bits: u32| exact(Rational::from(n) + (Rational::from(1) >> off), bits);
        smooth(&value, true).stays_off(5, 6, &watch).is_ok()
    });
    assert_eq!(found, [true, false, false]);
}
