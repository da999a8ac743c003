use super::*;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use rug::Rational;

fn rational(x: f64) -> Rational {
    Rational::from_f64(x).expect("finite")
}

/// Numbers of all signs, some of them subnormal or zero.
fn number(random: &mut ChaCha8Rng) -> f64 {
    let bits = random.next_u64();
    match bits % 16 {
        0 => 0.0,
        1 => f64::from_bits(bits >> 13),
        _ => f64::from_bits((bits & !(0x7ff << 52)) | (1023 - 20 + (bits >> 52) % 40) << 52),
    }
}

#[test]
fn every_operation_encloses() {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    for _ in 0..4000 {
        let mut interval = || {
            let (a, b) = (number(&mut random), number(&mut random));
            Interval::new(a.min(b), a.max(b))
        };
        let (p, q) = (interval(), interval());
        let holds = |i: Interval, x: &Rational| {
            (!i.lo.is_finite() || rational(i.lo) <= *x)
                && (!i.hi.is_finite() || *x <= rational(i.hi))
        };
        for x in [p.lo, p.hi].map(rational) {
            for y in [q.lo, q.hi].map(rational) {
                assert!(holds(p + q, &Rational::from(&x + &y)));
                assert!(holds(p - q, &Rational::from(&x - &y)));
                assert!(holds(p * q, &Rational::from(&x * &y)));
                if q.mignitude() > 0.0 {
                    assert!(holds(p / q, &Rational::from(&x / &y)));
                }
            }
            assert!(holds(p.square(), &Rational::from(&x * &x)));
        }
    }
}

#[test]
fn lengths_are_on_their_sides() {
    let mut random = ChaCha8Rng::seed_from_u64(2);
    for _ in 0..4000 {
        let (a, b) = (number(&mut random).abs(), number(&mut random).abs());
        let square = Rational::from(rational(a).square_ref()) + rational(b).square();
        let (low, high) = (rational(hypot_down(a, b)), rational(hypot_up(a, b)));
        assert!(
            low.square() <= square && square <= high.square(),
            "{a:e} {b:e}"
        );
    }
}
