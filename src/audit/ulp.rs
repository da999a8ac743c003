//! Fractional ulps against an unrounded reference.

use mechaudit_reference::{Ball, Mag};
use rug::Float;

/// The smallest number that rounds to infinity: half a unit beyond the largest `f64`,
/// `2¹⁰²⁴ − 2⁹⁷⁰`.
pub(super) fn overflow() -> Ball {
    let edge = (Float::with_val(64, 1) << 1024i32) - (Float::with_val(64, 1) << 970i32);
    Ball::new(edge, Mag::ZERO)
}

/// The exponent `k` of the unit in the last place, `ulp(x) = 2^k`: for `|x|` in `[2^e, 2^(e+1))`
/// it is `e − 52`, and never below −1074. Zero has the smallest unit.
///
/// A ball that straddles a power of two takes the exponent of its midpoint.
pub fn ulp_exponent(x: &Float) -> i64 {
    match x.get_exp() {
        Some(e) => (i64::from(e) - 1 - 52).max(-1074),
        None => -1074,
    }
}

/// Bounds on `|got − ref|` in ulps of the reference: `(at least, at most)`.
pub fn ulps(got: f64, reference: &Ball) -> (f64, f64) {
    let (lo, hi) = distance(got, reference);
    let k = -ulp_exponent(reference.mid());
    (lo.shift(k).to_f64(), hi.shift(k).to_f64())
}

/// Bounds on `|got − ref|`. Not a number is infinitely far. An infinity stands for all numbers that
/// round to it, the nearest of which counts.
pub(crate) fn distance(got: f64, reference: &Ball) -> (Mag, Mag) {
    if got.is_nan() {
        return (Mag::INFINITY, Mag::INFINITY);
    }
    if got.is_infinite() {
        let gap = match got > 0.0 {
            true => overflow() - reference,
            false => overflow() + reference,
        };
        return match gap.is_finite() {
            true if gap.upper() <= 0 => (Mag::ZERO, Mag::ZERO),
            true => (gap.mignitude(), gap.magnitude()),
            false => (Mag::ZERO, Mag::INFINITY),
        };
    }
    let d = &Ball::exact(reference.prec().max(64), got) - reference;
    (d.mignitude(), d.magnitude())
}

#[cfg(test)]
mod tests {
    use super::*;
    use rug::Rational;

    #[test]
    fn a_third() {
        let third = Ball::rational(200, &Rational::from((1, 3)));
        // fl(1/3) = (2^54 - 1)/3 / 2^54, a third of an ulp below.
        let (lo, hi) = ulps(1.0 / 3.0, &third);
        assert!((lo - 1.0 / 3.0).abs() < 1e-9 && (hi - 1.0 / 3.0).abs() < 1e-9);
        let (lo, _) = ulps((1.0f64 / 3.0).next_up(), &third);
        assert!((lo - 2.0 / 3.0).abs() < 1e-9);
    }

    #[test]
    fn the_edges() {
        assert_eq!(ulp_exponent(&Float::with_val(53, 1.0)), -52);
        assert_eq!(ulp_exponent(&Float::with_val(53, 1.0f64.next_down())), -53);
        assert_eq!(ulp_exponent(&Float::with_val(53, f64::from_bits(1))), -1074);
        assert_eq!(ulp_exponent(&Float::with_val(53, 0.0)), -1074);
        let one = Ball::integer(64, 1);
        assert_eq!(ulps(f64::NAN, &one).0, f64::INFINITY);
        assert_eq!(ulps(f64::INFINITY, &one).0, f64::INFINITY);
        assert_eq!(ulps(1.0, &one), (0.0, 0.0));
        assert_eq!(ulps(-0.0, &Ball::integer(64, 0)), (0.0, 0.0));
    }
}
