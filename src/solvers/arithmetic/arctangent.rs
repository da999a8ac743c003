//! Angles of vectors, and the sine and cosine of an angle, for one number or several.
//!
//! The first octant is turned by the nearest of the angles 0, arctan 1/2 and π/4, after which the
//! quotient is below 0.24 and twelve terms of `arctan q = q − q³/3 + …` leave less than 2⁻⁵⁸ of it.
//! The turn is exact but for the rounding of two sums, whose errors are kept.

use crate::double_double::{Dd, fast_two_sum, two_sum};
use crate::exponential::{LARGE_PHASE, paired, reduce, sin_cos_rounded, turned};
use crate::real::Masked;

/// `arctan 1/2`
const OF_HALF: Dd = Dd::new(0.463_647_609_000_806_1, 2.269_877_745_296_168_7e-17);
/// `π/4`
const OF_ONE: Dd = Dd::new(std::f64::consts::FRAC_PI_4, 3.061_616_997_868_383e-17);
/// `π/2`
const RIGHT: Dd = Dd::new(std::f64::consts::FRAC_PI_2, 6.123_233_995_736_766e-17);

/// `−1/3, 1/5, −1/7, …`
const TERMS: [f64; 12] = {
    let mut t = [0.0; 12];
    let mut n = 0;
    while n < 12 {
        let odd = (2 * n + 3) as f64;
        t[n] = if n % 2 == 0 { -1.0 / odd } else { 1.0 / odd };
        n += 1;
    }
    t
};

/// The angle of the vector `(x, y)` in the first quadrant, to 0.6 units in the last place. Both
/// numbers are at least zero, not both zero, and far from underflow and overflow.
#[inline(always)]
pub(crate) fn first_quadrant<R: Masked>(y: R, x: R) -> R {
    let (angle, low) = quadrant(y, x);
    angle + low
}

/// The same in two parts.
#[inline(always)]
fn quadrant<R: Masked>(y: R, x: R) -> (R, R) {
    let like = |v: f64| x.like(v);
    let steep = x.below(y);
    let (small, large) = (x.pick(steep, x, y), x.pick(steep, y, x));
    // tan(arctan(1/2)/2), and the tangent of the mean of arctan 1/2 and π/4.
    let (half, one) = (
        (large * like(0.2361)).below(small),
        (large * like(0.7208)).below(small),
    );
    let by = |zero: f64, half_: f64, one_: f64| {
        x.pick(one, like(one_), x.pick(half, like(half_), like(zero)))
    };
    let c = by(0.0, 0.5, 1.0);
    // Products with c are exact.
    let p = two_sum(small, -(c * large));
    let q = two_sum(large, c * small);
    // Its rounding goes to the rest.
    let per = like(1.0) / q.hi;
    let t = p.hi * per;
    let rest = (-t).fma(q.hi, p.hi) + (-t).fma(q.lo, p.lo);
    let tt = t * t;
    let low = (t * tt).fma(paired(&TERMS, tt), rest * per);
    let base = fast_two_sum(by(0.0, OF_HALF.hi, OF_ONE.hi), t);
    let low = low + (by(0.0, OF_HALF.lo, OF_ONE.lo) + base.lo);
    // π/2 less the angle where the vector is steep.
    let turned = fast_two_sum(like(RIGHT.hi), -base.hi);
    (
        x.pick(steep, turned.hi, base.hi),
        x.pick(steep, (turned.lo + like(RIGHT.lo)) - low, low),
    )
}

/// The angle of the vector `(x, y)`, not zero, from −π to π.
#[inline(always)]
pub(crate) fn angle<R: Masked>(y: R, x: R) -> R {
    let zero = x.like(0.0);
    let (a, low) = quadrant(y.magnitude(), x.magnitude());
    let back = fast_two_sum(x.like(2.0 * RIGHT.hi), -a);
    let beyond = back.hi + ((back.lo + x.like(2.0 * RIGHT.lo)) - low);
    x.pick(x.below(zero), beyond, a + low).with_sign_of(y)
}

/// `(sin, cos)` of an angle below [`LARGE_PHASE`], to one unit in the last place.
#[inline(always)]
pub(crate) fn sin_cos<R: Masked>(angle: R) -> (R, R) {
    let (r, quadrant) = reduce(Dd::new(angle, angle.like(0.0)));
    let (sin, cos) = sin_cos_rounded(r);
    turned(sin, cos, quadrant)
}

/// Returns whether [`sin_cos`] takes the angle.
pub(crate) fn is_moderate(angle: f64) -> bool {
    angle.abs() < LARGE_PHASE
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arithmetic::tests::Random;
    use rug::Float;

    /// Beside MPFR with 120 bits, in units of the last place.
    #[test]
    fn angles_of_vectors_everywhere() {
        let mut random = Random(51);
        let mut worst = 0.0f64;
        for k in 0..200_000 {
            let size = 2f64.powi((k % 41) - 20);
            let (y, x) = (random.between(-1.0, 1.0) * size, random.between(-1.0, 1.0));
            let (up, right) = (y.abs(), x.abs());
            for (got, y, x) in [(angle(y, x), y, x), (first_quadrant(up, right), up, right)] {
                let due = Float::with_val(120, y).atan2(&Float::with_val(120, x));
                let ulp = due.to_f64().abs().next_up() - due.to_f64().abs();
                worst = worst.max((due - got).abs().to_f64() / ulp);
            }
        }
        assert!(worst < 0.6, "{worst}");
        assert_eq!(first_quadrant(0.0, 1.0), 0.0);
        assert_eq!(first_quadrant(1.0, 0.0), RIGHT.hi);
        assert_eq!(angle(0.0, -1.0), std::f64::consts::PI);
        assert_eq!(angle(-0.0, -1.0), -std::f64::consts::PI);
    }

    #[test]
    fn sines_and_cosines() {
        let mut random = Random(52);
        let mut worst = 0.0f64;
        for k in 0..100_000 {
            let x = random.between(-1.0, 1.0) * 2f64.powi(k % 30);
            let (sin, cos) = sin_cos(x);
            let (s, c) = Float::with_val(120, x).sin_cos(Float::new(120));
            for (got, due) in [(sin, s), (cos, c)] {
                let ulp = due.to_f64().abs().next_up() - due.to_f64().abs();
                worst = worst.max((due - got).abs().to_f64() / ulp);
            }
        }
        assert!(worst < 1.0, "{worst}");
    }
}
