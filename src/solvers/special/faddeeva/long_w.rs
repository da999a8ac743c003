//! W(z) in 256 bits, for points so close to a curve on which a component is zero, or to a zero,
//! that double-double has too few digits.
//!
//! For `|z| < 4096` the rule of [`trapezoidal`](super::trapezoidal) with the step `h = 1/4`: its
//! remainder is below `2e^{−(4π)²} < 2⁻²²⁶`, and below that times `Im z` in the real part, which
//! the real axis makes odd in Im z. Nodes end at 13, where `e^{−t²} < 2⁻²⁴³`. Beyond, the
//! asymptotic series (DLMF 7.12.1) with twelve terms; the next one is below
//! `25!!/2¹³ · 2⁻³¹² < 2⁻²⁸²` of the first.
//!
//! How close a component may come to zero: of the two terms, whose phase `2ab` is a multiple of the
//! last places of a and b, 106 bits can vanish, and a few more by chance among all exponents. What
//! is left has 80 bits.

use super::long::Long;
use super::long_functions::{Angle, Complex, HALF_PI, exp, gaussian, plus, reciprocal, times};
use crate::hex::hex;

/// 1/√π.
pub(super) const INV_SQRT_PI: Long = Long::parts(
    0,
    [
        0x906e_ba82_14db_688d,
        0x71d4_8a7f_6bfe_c344,
        0x1409_a0eb_ac3e_7517,
        0x39a1_5830_cce6_20b1,
    ],
);
/// Nodes of each rule.
const NODES: u32 = 52;
/// Terms of the asymptotic series.
const TERMS: u32 = 12;
/// Im z above which the residue is below the remainder.
const ABOVE: f64 = 12.5;

/// Both.
#[cfg(feature = "proof")]
pub(super) const RULE: (u32, f64) = (NODES, ABOVE);

/// The rule with the nodes `(k + σ)/4`, σ = 0 or ½: `(i/(4π)) Σ e^{−t²}/(z − t)` at `a + i y`.
fn sum(halfway: bool, a: f64, y: f64) -> Complex {
    let (x, y) = (Long::from(a), Long::from(y));
    let (xx, yy) = (x.square(), y.square());
    let r2 = xx + yy;
    // e^{−t²} by the quotients of neighbours, and their quotients.
    let power = |t: f64| exp(Long::from(t), Angle::quarters(0.0)).0;
    let second = power(-0.125);
    let (mut weight, mut first, mut odd) = match halfway {
        true => (power(-1.0 / 64.0), second, 1.0),
        false => (Long::ONE.scale(-1), power(-1.0 / 16.0), 0.0),
    };
    let (mut plus, mut minus) = (Long::ZERO, Long::ZERO);
    for k in 0..NODES {
        let t = Long::from(odd / 8.0).square();
        let less = r2 - t;
        let m = less.square() + (t * yy).scale(2);
        let q = weight * m.recip();
        plus = plus + q * (r2 + t);
        minus = minus + q * less;
        // The node at zero has no partner.
        weight = if k == 0 && !halfway {
            first
        } else {
            weight * first
        };
        first = first * second;
        odd += 2.0;
    }
    let factor = HALF_PI.scale(2).recip();
    (y * plus * factor, x * minus * factor)
}

/// The trapezoidal rule with its residue.
fn trapezoidal(a: f64, y: f64) -> Complex {
    if y > ABOVE {
        return sum(false, a, y);
    }
    // e^{−2πiz/h}, whose phase is −4a turns.
    let turns = Angle::quarters(-(a % 0.25) * 16.0);
    let e = exp(Long::from(y) * HALF_PI.scale(4), turns);
    // The rule whose poles are farther away.
    let halfway = !e.0.is_negative();
    let e = if halfway { e } else { (-e.0, -e.1) };
    let factor = reciprocal((Long::ONE + e.0, e.1));
    let (re, im) = times(gaussian(a, y), factor);
    plus(sum(halfway, a, y), (re.scale(1), im.scale(1)))
}

/// `1/z` and `Σ c_n/z²ⁿ` at `z = a + i b`, with `c₀ = 1`, `c_n = (n + offset) c_{n−1}`: by the
/// offset −½ the asymptotic series of w (DLMF 7.12.1), by ½ that of its derivative.
pub(super) fn series(a: f64, b: f64, offset: f64) -> (Complex, Complex) {
    let one = (Long::ONE, Long::ZERO);
    let inverse = reciprocal((Long::from(a), Long::from(b)));
    let q = times(inverse, inverse);
    let mut sum = one;
    for n in (1..=TERMS).rev() {
        let factor = Long::from(f64::from(n) + offset);
        let (re, im) = times(sum, q);
        sum = plus(one, (re * factor, im * factor));
    }
    (inverse, sum)
}

/// w at `a + i y`, `0 ≤ a`, `|z| < 2³³²`, `y² − a²` below 2¹⁰ for `y < 0`: each component to 2⁻²⁰⁰
/// of its terms.
pub(super) fn w(a: f64, y: f64) -> Complex {
    if a.max(y.abs()) < 4096.0 {
        return trapezoidal(a, y);
    }
    // i/(√π z).
    let (inverse, sum) = series(a, y.abs(), -0.5);
    let (re, im) = times(inverse, sum);
    let (u, v) = (-(im * INV_SQRT_PI), re * INV_SQRT_PI);
    if y >= 0.0 {
        return (u, v);
    }
    let (c, s) = gaussian(a, y);
    (c.scale(1) - u, s.scale(1) + v)
}

/// The part of its terms below which a component is computed again with these numbers:
/// double-double is within 2⁻⁹² of the larger term, from `|z| = 4096` on 2⁻⁷⁷.
#[inline(always)]
pub(super) fn vanishing_part(a: f64, b: f64) -> f64 {
    const NEAR: f64 = hex("0x1p-36");
    const FAR: f64 = hex("0x1p-22");
    if a.max(b) < 4096.0 { NEAR } else { FAR }
}

/// The part of its modulus that the imaginary part of `e^{−z²}` may have: small beside the axes,
/// where its phase has all its digits.
#[inline(always)]
pub(super) fn turned(a: f64, b: f64) -> f64 {
    (2.0 * a * b).min(1.0)
}

/// w at `a − i b`, rounded.
#[cold]
#[inline(never)]
pub(super) fn lower(a: f64, b: f64) -> (f64, f64) {
    let (re, im) = w(a, -b);
    (re.value(), im.value())
}

#[cfg(test)]
mod tests;
