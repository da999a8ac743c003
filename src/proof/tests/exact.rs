use super::*;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use rug::Rational;

/// A rational function of two coordinates, over a rectangle and at a point of it.
#[test]
fn values_at_points_are_enclosed() {
    let mut random = ChaCha8Rng::seed_from_u64(3);
    let mut unit = || (random.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
    for _ in 0..500 {
        let (x0, y0) = (1.0 + 4.0 * unit(), 0.5 + unit());
        let (x1, y1) = (x0 + unit(), y0 + unit());
        let coordinates = [Interval::new(x0, x1), Interval::new(y0, y1)];
        let [x, y] = [0, 1].map(|i| Exact::coordinate(coordinates[i], i));
        let r2 = x.square() + y * y;
        let q = (x.square() + -(y.square())).over(r2);
        let value = q * x + -(x.over(y)) + Exact::within(Interval::new(0.5, 0.5));
        let halved = value.scaled(0.5, value.range * Interval::point(0.5));
        for _ in 0..20 {
            let at = |lo: f64, hi: f64, t: f64| (lo + (hi - lo) * t).clamp(lo, hi);
            let (a, b) = (at(x0, x1, unit()), at(y0, y1, unit()));
            let [a, b] = [a, b].map(|x| Rational::from_f64(x).expect("finite"));
            let (aa, bb) = (Rational::from(&a * &a), Rational::from(&b * &b));
            let q = Rational::from(&aa - &bb) / Rational::from(&aa + &bb);
            let due = (q * &a - Rational::from(&a / &b) + Rational::from((1, 2))) / 2;
            let [lo, hi] = [halved.range.lo, halved.range.hi];
            let end = |x: f64| Rational::from_f64(x).expect("finite");
            assert!(end(lo) <= due && due <= end(hi));
        }
    }
}

#[test]
fn what_two_values_share_cancels() {
    let x = Exact::coordinate(Interval::new(1.0, 1.25), 0);
    let square = x.square();
    let difference = square + -(x * x);
    assert!(difference.range.magnitude() < 0.05);
    assert!((square.range + -square.range).magnitude() > 0.5);
}
