use super::*;
use crate::bounds::rational;
use rand::rngs::ChaCha8Rng;
use rand::{Rng, SeedableRng};
use rug::Rational;

/// Numbers of all signs, some of them subnormal or zero.
fn number(random: &mut ChaCha8Rng) -> f64 {
    let bits = random.next_u64();
    match bits % 16 {
        0 => 0.0,
        1 => f64::from_bits(bits >> 13),
        _ => f64::from_bits((bits & !(0x7ff << 52)) | (1023 - 20 + (bits >> 52) % 40) << 52),
    }
}

/// Returns whether an interval holds all numbers from `least` to `most`, and no end of it is more
/// than two spacings off.
fn is_tight(found: Interval, least: &Rational, most: &Rational) -> bool {
    if [least, most]
        .into_iter()
        .any(|x| x.clone().abs() > f64::MAX)
    {
        return true;
    }
    let [lo, hi] = [found.lo, found.hi].map(rational);
    let [in_lo, in_hi] = [
        found.lo.next_up().next_up(),
        found.hi.next_down().next_down(),
    ];
    lo <= *least && *least <= rational(in_lo) && rational(in_hi) <= *most && *most <= hi
}

#[test]
fn ends_are_next_to_those_of_the_exact_range() {
    let mut random = ChaCha8Rng::seed_from_u64(3);
    for _ in 0..4000 {
        let mut interval = || {
            let (a, b) = (number(&mut random), number(&mut random));
            Interval::new(a.min(b), a.max(b))
        };
        let (p, q) = (interval(), interval());
        let pairs = |f: fn(&Rational, &Rational) -> Rational| {
            let mut all: Vec<Rational> = Vec::new();
            for x in [p.lo, p.hi].map(rational) {
                all.extend([q.lo, q.hi].map(rational).iter().map(|y| f(&x, y)));
            }
            all.sort();
            [all[0].clone(), all[3].clone()]
        };
        let tight = |found: Interval, [least, most]: [Rational; 2]| {
            assert!(is_tight(found, &least, &most), "{p:?} {q:?} {found:?}");
        };
        tight(p + q, pairs(|x, y| Rational::from(x + y)));
        tight(p - q, pairs(|x, y| Rational::from(x - y)));
        tight(p * q, pairs(|x, y| Rational::from(x * y)));
        if q.mignitude() > 0.0 {
            tight(p / q, pairs(|x, y| Rational::from(x / y)));
        }
        let square = |x: f64| rational(x).square();
        tight(p.square(), [square(p.mignitude()), square(p.magnitude())]);
        assert!(p.square().lo >= 0.0);
        let r = q.magnitude();
        let ends = [rational(p.lo) - rational(r), rational(p.hi) + rational(r)];
        tight(p.widened(r), ends);
        // Each of its numbers is at least the least absolute value, which one of them has.
        let inside = p.lo <= 0.0 && p.hi >= 0.0;
        let due = if inside {
            0.0
        } else {
            p.lo.abs().min(p.hi.abs())
        };
        assert_eq!(p.mignitude(), due);
        if p.lo >= 0.0 && q.lo >= 0.0 {
            assert!((p * q).lo >= 0.0);
        }
    }
}

#[test]
fn bounds_of_single_operations_are_next_above() {
    let mut random = ChaCha8Rng::seed_from_u64(4);
    let next = |found: f64, due: &Rational| {
        *due > f64::MAX
            || rational(found) >= *due && rational(found.next_down().next_down()) <= *due
    };
    for _ in 0..4000 {
        let (a, b) = (number(&mut random).abs(), number(&mut random).abs());
        let (x, y) = (rational(a), rational(b));
        assert!(next(sum_up(a, b), &Rational::from(&x + &y)), "{a} + {b}");
        assert!(next(product_up(a, b), &Rational::from(&x * &y)), "{a} {b}");
        if b > 0.0 {
            assert!(next(quotient_up(a, b), &Rational::from(&x / &y)), "{a}/{b}");
        }
        let root = sqrt_up(a);
        assert!(rational(root).square() >= x);
        assert!(a == 0.0 || rational(root.next_down().next_down()).square() <= x);
        // Lengths are within a few roundings.
        let square = Rational::from(x.square_ref()) + y.square();
        let (low, high) = (hypot_down(a, b), hypot_up(a, b));
        let sides = [low, high].map(|r| rational(r).square());
        assert!(sides[0] <= square && square <= sides[1], "{a:e} {b:e}");
        let few = |r: f64, up: bool| {
            let x = (0..12).fold(r, |x, _| if up { x.next_up() } else { x.next_down() });
            rational(x.max(0.0)).square()
        };
        assert!(
            few(low, true) >= square && few(high, false) <= square,
            "{a} {b}"
        );
    }
}

/// Zero is exact: what has no error keeps none. What is not known is unbounded.
#[test]
fn zeros_are_kept_and_unknown_bounds_stay_unknown() {
    let tiny = f64::from_bits(1);
    assert_eq!([sum_up(0.0, tiny), sum_up(tiny, 0.0)], [tiny; 2]);
    for x in [0.0, 1.0, f64::INFINITY] {
        assert_eq!([product_up(0.0, x), product_up(x, 0.0)], [0.0; 2]);
        assert_eq!(quotient_up(0.0, x), 0.0);
        assert_eq!([hypot_up(0.0, x), hypot_up(x, 0.0)], [x; 2]);
        assert_eq!([hypot_down(0.0, x), hypot_down(x, 0.0)], [x; 2]);
        assert_eq!(hypot_up(f64::INFINITY, x), f64::INFINITY);
        assert_eq!(hypot_up(x, f64::INFINITY), f64::INFINITY);
    }
    assert_eq!(sqrt_up(0.0), 0.0);
    for divisor in [0.0, -1.0, f64::NAN] {
        assert_eq!(quotient_up(1.0, divisor), f64::INFINITY);
    }
    let all = Interval::new(f64::NEG_INFINITY, f64::INFINITY);
    let to = |lo, hi| Interval::new(lo, hi);
    assert_eq!(
        [to(1.0, 0.0), to(f64::NAN, 1.0), to(0.0, f64::NAN)],
        [all; 3]
    );
    let some = to(0.3, 0.7);
    assert_eq!([some + Interval::ZERO, Interval::ZERO + some], [some; 2]);
    assert_eq!(some.widened(0.0), some);
    let none = Interval::ZERO;
    assert_eq!(
        [none * all, all * none, none / some, none.square()],
        [none; 4]
    );
    assert_eq!(
        [
            to(0.0, 1.0) * to(1.0, f64::INFINITY),
            to(1.0, f64::INFINITY) * to(0.0, 1.0)
        ],
        [all; 2]
    );
    assert_eq!(to(1.0, f64::INFINITY) / to(1.0, f64::INFINITY), all);
    for divisor in [to(0.0, 1.0), to(-1.0, 0.0), to(-1.0, 1.0), none] {
        assert_eq!([some / divisor, none / divisor], [all; 2]);
    }
    assert!(none.is_zero() && !to(0.0, 1.0).is_zero() && !to(-1.0, 0.0).is_zero());
    assert!(Interval::point(0.5).is_point() && !some.is_point());
}
