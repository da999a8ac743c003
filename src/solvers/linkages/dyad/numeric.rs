//! Scaling by powers of two, exact signs of sums, and triangles from their sides.

use super::error::{DyadError, MAX_LENGTH_RATIO};
use crate::arctangent::first_quadrant;
use crate::double_double::Dd;
use crate::real::{Masked, Real};
use crate::units::Length;

/// `2^k` for `k` in `−1022..=1023`.
fn pow2(k: i32) -> f64 {
    f64::from_bits(((k + 1023) as u64) << 52)
}

/// `x · 2^k`, rounded at most once where the result is not subnormal.
#[inline(always)]
pub(super) fn scale<R: Real>(x: R, k: i32) -> R {
    let half = k / 2;
    let power = |k: i32| x.like(pow2(k.clamp(-1022, 1023)));
    x * power(half) * power(k - half)
}

/// The exponent of `x > 0`: `x` lies in `[2^e, 2^(e+1))`.
pub(super) fn exponent(x: f64) -> i32 {
    let e = ((x.to_bits() >> 52) & 0x7ff) as i32;
    if e == 0 {
        exponent(x * pow2(100)) - 100
    } else {
        e - 1023
    }
}

/// Checks named lengths and returns the exponent of the longest.
pub(super) fn check_lengths(
    positive: &[(&'static str, Length)],
    any_sign: &[(&'static str, Length)],
) -> Result<i32, DyadError> {
    for &(what, l) in positive.iter().chain(any_sign) {
        let value = l.m();
        if !value.is_finite() {
            return Err(DyadError::NotFinite { what, value });
        }
    }
    for &(what, l) in positive {
        let value_m = l.m();
        if value_m <= 0.0 {
            return Err(DyadError::NotPositive { what, value_m });
        }
    }
    let all = || positive.iter().chain(any_sign).map(|(_, l)| l.m().abs());
    let longest_m = all().fold(0.0, f64::max);
    let shortest_m = all().filter(|&l| l > 0.0).fold(longest_m, f64::min);
    if longest_m / MAX_LENGTH_RATIO > shortest_m {
        return Err(DyadError::LengthRatio {
            longest_m,
            shortest_m,
        });
    }
    Ok(exponent(longest_m))
}

/// The angle between two sides of a triangle, as the pair whose `atan2` is half of it.
///
/// With the sides `p` and `q` enclosing the angle and `o` opposite to it,
///
/// ```text
/// tan(angle/2) = √((o − p + q)(o + p − q)) / √((p + q − o)(p + q + o))      (1)
/// ```
#[derive(Clone, Copy, Debug)]
pub(super) struct HalfAngle<R = f64> {
    /// Proportional to `sin(angle/2)`.
    pub sin: R,
    /// Proportional to `cos(angle/2)`.
    pub cos: R,
}

impl HalfAngle {
    /// From the factors of (1), each not negative.
    pub fn new(o_p_q: f64, o_q_p: f64, p_q_o: f64, sum: f64) -> HalfAngle {
        HalfAngle {
            sin: (o_p_q * o_q_p).sqrt(),
            cos: (p_q_o * sum).sqrt(),
        }
    }
}

impl<R: Masked> HalfAngle<R> {
    /// The angle, in `[0, π]`.
    #[inline(always)]
    pub fn angle(self) -> R {
        self.sin.like(2.0) * first_quadrant(self.sin, self.cos)
    }

    /// π minus the angle, without subtracting.
    #[inline(always)]
    pub fn supplement(self) -> R {
        self.sin.like(2.0) * first_quadrant(self.cos, self.sin)
    }
}

/// The square root of a sum of two parts, to half a unit in the last place, and its reciprocal, to
/// one unit; zero has a large one.
#[inline(always)]
pub(super) fn root<R: Masked>(square: Dd<R>) -> (R, R) {
    let like = |v: f64| square.hi.like(v);
    let r = square.hi.root();
    let per = like(1.0) / r.raised(f64::MIN_POSITIVE);
    let rest = (-r).fma(r, square.hi) + square.lo;
    let root = (like(0.5) * per).fma(rest, r);
    (root, per.fma((-root).fma(per, like(1.0)), per))
}

/// The length of a vector and its reciprocal.
#[inline(always)]
pub(super) fn length<R: Masked>([x, y]: [R; 2]) -> (R, R) {
    let like = |v: f64| x.like(v);
    // Squares of what is tiny would underflow.
    let size = x.magnitude().at_least(y.magnitude());
    let by = x.pick(size.below(like(pow2(-400))), like(pow2(500)), like(1.0));
    let (x, y) = (x * by, y * by);
    let ((p, e), (q, f)) = (x.two_prod(x), y.two_prod(y));
    let (hi, lo) = p.two_sum(q);
    let (length, per) = root(Dd::new(hi, lo + (e + f)));
    let back = x.pick(like(1.0).below(by), like(pow2(-500)), like(1.0));
    (length * back, per * by)
}

/// The sum of three numbers, the two of largest opposite magnitude first: where the result is
/// small against them that first difference is exact.
#[inline(always)]
pub(super) fn sum3<R: Real>([a, b, c]: [R; 3]) -> R {
    let close = |x: R, y: R, z: R| ((x + y).magnitude(), x + y + z);
    let closer = |x: (R, R), y: (R, R)| {
        let m = y.0.below(x.0);
        (a.pick(m, y.0, x.0), a.pick(m, y.1, x.1))
    };
    closer(closer(close(a, b, c), close(b, c, a)), close(c, a, b)).1
}

/// The scalar product.
#[inline(always)]
pub(super) fn dot<R: Real>(a: [R; 2], b: [R; 2]) -> R {
    a[0].fma(b[0], a[1] * b[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scaling_is_exact_over_the_whole_range() {
        for x in [f64::from_bits(1), 1e-310, 1.0, 1.5e300] {
            let e = exponent(x);
            let m = scale(x, -e);
            assert!((1.0..2.0).contains(&m), "{x} {m}");
            assert_eq!(scale(m, e), x);
        }
    }

    #[test]
    fn right_and_flat_triangles() {
        // Between the sides p and q, opposite o.
        let angle =
            |p: f64, q: f64, o: f64| HalfAngle::new(o - p + q, o + p - q, p + q - o, p + q + o);
        assert_eq!(angle(3.0, 4.0, 5.0).angle(), std::f64::consts::FRAC_PI_2);
        assert_eq!(angle(1.0, 2.0, 3.0).angle(), std::f64::consts::PI);
        assert_eq!(angle(1.0, 2.0, 3.0).supplement(), 0.0);
        assert_eq!(angle(3.0, 2.0, 1.0).angle(), 0.0);
        let equilateral = angle(7.0, 7.0, 7.0).angle();
        assert!((equilateral - std::f64::consts::FRAC_PI_3).abs() < 3e-16);
    }

    #[test]
    fn sums_of_three_keep_what_is_left() {
        let tiny = 2f64.powi(-52);
        assert_eq!(sum3([1.0, 1e-20, -(1.0 + tiny)]), 1e-20 - tiny);
        assert_eq!(sum3([-1.0, 1.0 + tiny, 1e-3]), 1e-3 + tiny);
    }
}
