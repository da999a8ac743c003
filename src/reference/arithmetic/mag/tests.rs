//! Tests of `mag`.

use super::*;
use proptest::prelude::*;

fn exact(m: Mag) -> Float {
    Float::with_val(4000, m.to_float())
}

/// Every size, evenly by the bits.
fn number() -> impl Strategy<Value = f64> {
    (1e-300f64.to_bits()..1e300f64.to_bits()).prop_map(f64::from_bits)
}

proptest! {
    #[test]
    fn every_operation_is_a_tight_upper_bound((a, b, near) in (number(), number(), 0.5f64..2.0)) {
        for b in [b, a * near] {
            let (x, y) = (Mag::from_f64(a), Mag::from_f64(b));
            let (p, q) = (Float::with_val(4000, a), Float::with_val(4000, b));
            prop_assert_eq!(exact(x), a);
            for (found, due) in [
                (x.add(y), Float::with_val(4000, &p + &q)),
                (x.mul(y), Float::with_val(4000, &p * &q)),
                (x.div(y), Float::with_val(4000, &p / &q)),
                (x.sqrt(), p.clone().sqrt()),
            ] {
                let found = exact(found);
                prop_assert!(due <= found && found <= due * (1.0 + 1e-15), "{a} {b}");
            }
            let (d, due) = (exact(x.sub_below(y)), p - q);
            prop_assert!(d == 0 || d <= due);
            prop_assert!(b > 0.9 * a || d >= due * (1.0 - 1e-14), "{a} {b}");
        }
    }
}

#[test]
fn floats_of_any_length_lie_between_their_bounds() {
    for bits in [2, 24, 53, 54, 64, 65, 128, 200] {
        let third = Float::with_val(bits, 1) / 3;
        // All bits set: rounded up it is a power of two.
        let mut full = Float::with_val(bits, 2);
        full.next_down();
        let tiny = Float::with_val(bits, &third >> 5000u32);
        for x in [third, full.clone(), -full, tiny, Float::with_val(bits, 3)] {
            let size = Float::with_val(4000, x.abs_ref());
            let (low, high) = (exact(Mag::below(&x)), exact(Mag::above(&x)));
            assert!(low <= size && size <= high, "{bits}: {x}");
            let gap = Float::with_val(4000, &high - &low) / &size;
            assert!(gap <= f64::EPSILON, "{bits}: {x}");
            assert!(bits > 53 || gap == 0, "{bits}: {x}");
        }
    }
}

/// Sums and products rounded down, once: exact where 53 bits hold them.
#[test]
fn sums_and_products_from_below_are_rounded_down() {
    let floor = |x: Float| exact(Mag::below(&x));
    let numbers = [
        0.0,
        5e-324,
        1e-300,
        0.3,
        1.0 / 3.0,
        0.5,
        1.0,
        1.0f64.next_up(),
        2.0f64.next_down(),
        3.0,
        2f64.powi(53) - 1.0,
        2f64.powi(59) + 256.0,
        2f64.powi(60),
        2f64.powi(61),
        7e15,
        1e300,
    ];
    for a in numbers {
        for b in numbers {
            let (x, y) = (Mag::from_f64(a), Mag::from_f64(b));
            let sum = Float::with_val(4000, a) + b;
            let product = Float::with_val(4000, a) * b;
            assert_eq!(exact(x.add_below(y)), floor(sum), "{a:e} {b:e}");
            assert_eq!(exact(x.mul_below(y)), floor(product), "{a:e} {b:e}");
        }
        let x = Mag::from_f64(a);
        for (x, y) in [(x, Mag::INFINITY), (Mag::INFINITY, x)] {
            assert!(x.add_below(y).is_zero() && x.mul_below(y).is_zero());
        }
    }
}

#[test]
fn integers_lie_between_their_bounds() {
    let odd = (1u128 << 127) | 1;
    for d in [
        0,
        1,
        3,
        (1 << 53) - 1,
        (1 << 53) + 1,
        (1 << 54) - 1,
        odd,
        u128::MAX,
    ] {
        let size = Float::with_val(200, rug::Integer::from(d)) >> 9u32;
        let [low, high] = [false, true].map(|up| exact(Mag::of_integer(d, -9, up)));
        assert!(low <= size && size <= high, "{d}");
        assert!(
            Float::with_val(200, &high - &low) <= size.clone() * f64::EPSILON,
            "{d}"
        );
        assert!(d >= 1 << 53 || low == high, "{d}");
    }
    // Exact where 53 bits hold them, however large.
    for d in [1u128 << 54, ((1 << 53) - 1) << 20, 3 << 126] {
        assert_eq!(Mag::of_integer(d, 0, false), Mag::of_integer(d, 0, true));
    }
}

#[test]
fn the_ends_of_the_range() {
    assert_eq!(Mag::from_f64(f64::from_bits(1)).to_f64(), f64::from_bits(2));
    assert_eq!(Mag::from_f64(f64::MAX).to_f64(), f64::MAX);
    assert_eq!(Mag::power_of_two(5000).to_f64(), f64::INFINITY);
    for k in [1024, 1025, 2047] {
        assert_eq!(Mag::power_of_two(k).to_f64(), f64::INFINITY);
    }
    assert_eq!(Mag::power_of_two(1023).to_f64(), 2f64.powi(1023));
    assert_eq!(Mag::power_of_two(-5000).to_f64(), f64::from_bits(1));
    assert!(!Mag::from_f64(f64::NAN).is_finite());
    assert!(!Mag::ZERO.mul(Mag::INFINITY).is_finite());
    assert!(!Mag::from_f64(1.0).div(Mag::ZERO).is_finite());
    assert!(Mag::power_of_two(-40000) < Mag::power_of_two(40000));
    // Of what is no number nothing is known, and zero and infinity are one each.
    assert_eq!(Mag::from_f64(f64::NAN), Mag::INFINITY);
    assert_eq!(Mag::from_f64(-f64::INFINITY), Mag::INFINITY);
    assert_eq!(Mag::from_f64(-0.0), Mag::ZERO);
    assert_eq!(Mag::INFINITY.div(Mag::INFINITY), Mag::INFINITY);
    // Normal numbers as they are, below them the next one up.
    let least = f64::MIN_POSITIVE;
    assert_eq!(Mag::from_f64(least).to_f64(), least);
    assert_eq!(Mag::from_f64(least / 2.0).to_f64(), (least / 2.0).next_up());
    assert_eq!(Mag::from_f64(1.5).shift(-1075).to_f64(), f64::from_bits(1));
}

/// Infinite and zero bounds, and terms far below others.
#[test]
fn operations_at_the_ends() {
    let (zero, one, inf) = (Mag::ZERO, Mag::from_f64(1.0), Mag::INFINITY);
    let nan = Float::with_val(53, f64::NAN);
    assert!(!Mag::above(&nan).is_finite() && Mag::below(&nan).is_zero());
    assert!(Mag::below(&Float::new(53)).is_zero());
    for x in [one, Mag::power_of_two(-5000), Mag::power_of_two(5000)] {
        for y in [x.add(inf), inf.add(x), x.mul(inf), inf.mul(x), x.div(zero)] {
            assert!(!y.is_finite(), "{x:?}");
        }
        assert!(!inf.div(x).is_finite() && x.div(inf).is_zero());
        assert!(zero.div(x).is_zero() && zero.mul(x).is_zero() && zero.sub_below(x).is_zero());
        assert_eq!((x.add(zero), zero.add(x)), (x, x));
    }
    assert!(zero.div(zero).is_zero() && zero.sqrt().is_zero() && !inf.sqrt().is_finite());
    let exponents = [zero, inf, one].map(Mag::exponent);
    assert_eq!(exponents, [None, None, Some(0)]);
    // Powers of two are exact, and a tiny term still moves a sum up and a difference down.
    for k in [50, 59, 60, 61, 62, 100, 4000] {
        let (tiny, part) = (Mag::power_of_two(-k), 2f64.powi(-k as i32));
        let most = Mag::from_f64(1.0 + part + 3.0 * f64::EPSILON);
        for sum in [one.add(tiny), tiny.add(one)] {
            assert!(sum > one && sum <= most, "{k}");
        }
        let less = one.sub_below(tiny);
        let least = Mag::from_f64(1.0 - part - 3.0 * f64::EPSILON);
        assert!(less < one && less >= least, "{k}");
    }
    // As f64, from above.
    for (e, due) in [
        (-3, 0.125),
        (-1021, 2f64.powi(-1021)),
        (-1074, f64::from_bits(2)),
        (-1075, f64::from_bits(1)),
    ] {
        assert_eq!(Mag::power_of_two(e).to_f64(), due, "{e}");
    }
}

#[test]
fn differences_from_below_whatever_the_exponents() {
    let all = [-6000, -3000, -60, -1, 0, 1, 60, 3000, 6000].map(|k| Mag::from_f64(1.5).shift(k));
    for (i, x) in all.iter().enumerate() {
        for (j, y) in all.iter().enumerate() {
            let d = x.sub_below(*y);
            assert_eq!(d.is_zero(), i <= j, "{x:?} {y:?}");
            assert!(d <= *x && (i <= j || d >= x.shift(-2)), "{x:?} {y:?} {d:?}");
            assert_eq!(x.min(*y), all[i.min(j)]);
            assert_eq!(x.max(*y), all[i.max(j)]);
        }
        assert!(
            x.sub_below(Mag::INFINITY).is_zero()
                && Mag::INFINITY.sub_below(Mag::INFINITY).is_zero()
        );
        assert_eq!(Mag::INFINITY.sub_below(*x), Mag::INFINITY);
        assert_eq!(x.sub_below(Mag::ZERO), *x);
    }
    // Neighbours.
    let one = Mag::from_f64(1.0);
    let above = one.sub_below(Mag::from_f64(1.0f64.next_down()));
    assert!(!above.is_zero() && above.to_f64() <= f64::EPSILON / 2.0);
    let above = Mag::from_f64(1.0f64.next_up()).sub_below(one);
    assert!(!above.is_zero() && above.to_f64() <= f64::EPSILON);
}

/// Without a look at limbs the bounds are the same.
#[test]
fn bounds_do_not_depend_on_limbs() {
    for bits in [2, 24, 53, 54, 64, 65, 200] {
        let mut full = Float::with_val(bits, 2);
        full.next_down();
        for k in 1..30 {
            let third: Float = Float::with_val(bits, k) / 3u32;
            let (third, full): (Float, Float) = (third << (300 * k - 4500), full.clone() >> k);
            for x in [third, full] {
                for x in [-x.clone(), x] {
                    assert_eq!(Mag::of_any_limbs(&x, true), Mag::above(&x), "{x}");
                    assert_eq!(Mag::of_any_limbs(&x, false), Mag::below(&x), "{x}");
                }
            }
        }
    }
}

/// Checks that a magnitude beyond MPFR's exponents is bounded from above.
#[test]
fn floats_outside_the_range_of_exponents_are_bounds() {
    let least = Float::with_val(53, 1) << (rug::float::exp_min() - 1);
    for e in [-(1 << 30) - 2, -(1 << 31), -(1 << 31) - 5, -(1 << 40)] {
        assert_eq!(Mag::power_of_two(e).to_float(), least, "{e}");
    }
    assert_eq!(Mag::power_of_two(-(1 << 30) - 1).to_float(), least);
    for e in [1 << 30, 1 << 31, 1 << 40] {
        assert!(Mag::power_of_two(e).to_float().is_infinite(), "{e}");
    }
    assert!(Mag::ZERO.to_float().is_zero());
}
