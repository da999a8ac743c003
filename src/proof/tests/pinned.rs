//! Bounds beside those that were proved before: a change has to be meant.
//!
//! A bound that shrinks may no longer be one and a bound that grows is a loss, and neither fails a
//! test of inclusion. [`bit_by_bit`] notices every change of a number of terms, a working
//! precision, a slack or a start.

use crate::grid::power_of_two;
use std::fmt::Debug;

/// A name, a digest of what was found under it, and a figure to read: the worst of it, or how much
/// of it there is.
pub(crate) type Pinned<'a> = (&'a str, u64, f64);

/// A digest of values as they are printed, which tells every `f64` from every other (FNV-1a).
pub(crate) fn digest<T: Debug>(values: impl IntoIterator<Item = T>) -> u64 {
    let mut hash = 0xcbf2_9ce4_8422_2325;
    for value in values {
        for byte in format!("{value:?};").bytes() {
            hash = (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }
    hash
}

/// Values with their number as the figure.
pub(crate) fn counted<T: Debug>(name: &str, values: impl IntoIterator<Item = T>) -> Pinned<'_> {
    let mut count = 0.0;
    let values = values.into_iter().inspect(|_| count += 1.0);
    let digest = digest(values);
    (name, digest, count)
}

/// Numbers with the largest that is finite as the figure.
pub(crate) fn largest(name: &str, numbers: impl IntoIterator<Item = f64>) -> Pinned<'_> {
    let mut most = f64::MIN;
    let finite = |x: &f64| if x.is_finite() { *x } else { f64::MIN };
    let numbers = numbers.into_iter().inspect(|x| most = most.max(finite(x)));
    let digest = digest(numbers);
    (name, digest, most)
}

/// Asserts that this was found; all of it is listed where it was not, to take its place.
pub(crate) fn bit_by_bit(found: &[Pinned], due: &[Pinned]) {
    let bits = |p: &Pinned| (p.0.to_owned(), p.1, p.2.to_bits());
    let line = |p: &Pinned| format!("    ({:?}, {:#018x}, {:?}),", p.0, p.1, p.2);
    let same = found.iter().map(bits).eq(due.iter().map(bits));
    let listed: Vec<String> = found.iter().map(line).collect();
    let listed = listed.join("\n");
    assert!(same, "found:\n{listed}");
}

/// Numbers from 0 to 1, the same on every machine (splitmix64).
pub(crate) fn units(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = state;
        z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ z >> 31) >> 11) as f64 * power_of_two(-53)
    }
}

/// A number from 1 to 2 times a power of two between these exponents.
pub(crate) fn of_binades(unit: &mut impl FnMut() -> f64, [least, most]: [i32; 2]) -> f64 {
    let k = f64::from(least) + unit() * f64::from(most - least + 1);
    (1.0 + unit()) * power_of_two(k.floor() as i32)
}

#[test]
fn other_bits_are_told() {
    let found = [counted("a", [0.5, 1.0]), largest("b", [0.5, 0.25])];
    assert_eq!((found[0].2, found[1].2), (2.0, 0.5));
    assert_eq!(largest("c", [f64::INFINITY, 0.5, f64::NAN]).2, 0.5);
    bit_by_bit(&found, &found);
    for wrong in [
        vec![found[0]],
        vec![found[1], found[0]],
        vec![found[0], largest("c", [0.5, 0.25])],
        vec![found[0], largest("b", [0.5, 0.25f64.next_up()])],
        vec![found[0], (found[1].0, found[1].1, 0.25)],
    ] {
        assert!(std::panic::catch_unwind(|| bit_by_bit(&wrong, &found)).is_err());
    }
    assert!(digest([0.0]) != digest([-0.0]) && digest([1.0, 2.0]) != digest([2.0, 1.0]));
    let mut unit = units(1);
    let some: Vec<f64> = (0..1000).map(|_| unit()).collect();
    assert!(some.iter().all(|x| (0.0..1.0).contains(x)));
    let mean = some.iter().sum::<f64>() / 1000.0;
    assert!((0.45..0.55).contains(&mean), "{mean}");
    let x = of_binades(&mut unit, [-3, -3]);
    assert!((0.125..0.25).contains(&x), "{x}");
}
