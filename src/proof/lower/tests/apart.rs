use super::*;

#[test]
fn the_first_zeros_are_off_all_numbers() {
    let watch = Watch::default();
    let found = Apart::all(Some(64.0), &watch)
        .expect("proved")
        .expect("not stopped");
    assert!(
        found.boxes > 1000 && found.zeros > 1000 && found.lines == 0,
        "{found:?}"
    );
}

#[test]
#[ignore = "minutes"]
fn all_zeros_are_off_all_numbers() {
    let watch = Watch::default();
    let found = Apart::all(None, &watch)
        .expect("proved")
        .expect("not stopped");
    eprintln!("{found:?}");
    assert!(found.zeros > 20_000_000 && found.lines > 200_000_000);
}

/// `(n + c)/3` is whole at some numbers, at single ones and within blocks; `n + 1/3` nowhere.
#[test]
fn a_value_next_to_a_whole_number_is_found() {
    let of = |p: u64, c: u64| {
        move |n: u64, bits: u32| {
            let x = rug::Rational::from((p * n + c, 3));
            Ok(Ball::rational(bits, &x))
        }
    };
    let watch = Watch::default();
    let found = |value: smooth::Value, first: u64| {
        let smooth = Smooth {
            value,
            shift: &|_| 0,
            most: &|n| 2.0 * n as f64,
            few: true,
        };
        smooth.stays_off(first, first + 300, &watch)
    };
    for first in [20_000, 100_000, 1 << 23] {
        assert_eq!(found(&of(3, 1), first), Ok(Some(301)));
        assert!(found(&of(1, 0), first).is_err() && found(&of(1, 2), first).is_err());
        // Whole at one number of them, and a third off 2⁻²⁰ at the others.
        let once = |n: u64, bits: u32| {
            let x = rug::Rational::from((n - first, 1 << 20)) - rug::Rational::from((117, 1 << 20));
            Ok(Ball::rational(bits, &x))
        };
        assert!(found(&once, first).is_err());
        let never = |n: u64, bits: u32| {
            let x = rug::Rational::from((2 * (n - first) + 1, 1 << 21));
            Ok(Ball::rational(bits, &x))
        };
        assert!(found(&never, first).is_ok());
    }
}
