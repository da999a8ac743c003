//! Reduction of `2 a y` modulo π/2 for phases of any size (Payne & Hanek, *Radian reduction for
//! trigonometric functions*, SIGNUM Newsletter 18 (1983)).
//!
//! `2 a y = m 2^e` with a whole `m` below 2¹⁰⁶. Of the binary digits of 2/π only those are
//! multiplied with `m` that do not give a multiple of four.

use super::tables::{HALF_PI, TWO_OVER_PI_BITS};
use crate::double_double::Dd;
use crate::real::{ROUND, Real};

/// `|x| = m 2^e` with a whole `m` below 2⁵³.
fn parts(x: f64) -> (u64, i32) {
    let bits = x.to_bits();
    let e = ((bits >> 52) & 0x7ff) as i32;
    let m = bits & ((1 << 52) - 1);
    if e == 0 {
        (m, -1074)
    } else {
        (m | 1 << 52, e - 1075)
    }
}

/// Sixty-four digits of 2/π that begin `at` digits after the point; digits before it are zero.
fn digits(at: i64) -> u64 {
    let word = |i: i64| -> u64 {
        if i < 0 {
            0
        } else {
            TWO_OVER_PI_BITS.get(i as usize).copied().unwrap_or(0)
        }
    };
    let (i, s) = (at.div_euclid(64), at.rem_euclid(64) as u32);
    if s == 0 {
        word(i)
    } else {
        word(i) << s | word(i + 1) >> (64 - s)
    }
}

/// Words of the window of 2/π.
const N: usize = 5;

/// `2 a |y|` in quarters of a turn: the nearest whole number modulo four, and the sign and the
/// binary digits of what is left, for `a ≥ 0`.
///
/// It is the product of 2/π's window, 320 digits of it, with `m` below 2¹⁰⁶; what the window leaves
/// out is below 2⁻²¹².
pub(crate) fn fraction(a: f64, y: f64) -> (i64, bool, [u64; N]) {
    let ((ma, ea), (my, ey)) = (parts(a), parts(y));
    let m = u128::from(ma) * u128::from(my);
    let e = i64::from(ea + ey) + 1;
    // fraction digits of (2/π) m 2^e from weight 2¹ (quadrant) on: digits of 2/π of weight below
    // 2^(2 − e) count. Digit `d` after the point has weight 2^(−d−1)·2^e.
    let first = e - 2;
    let mut window = [0u64; N];
    for (i, w) in window.iter_mut().enumerate() {
        *w = digits(first + 64 * i as i64);
    }
    // product = m · window, modulo 2^(64 N): the point is after the second bit.
    let (m0, m1) = (m as u64, (m >> 64) as u64);
    let mut product = [0u64; N];
    for (shift, limb) in [(0usize, m0), (1, m1)] {
        let mut carry = 0u128;
        for i in (0..N).rev() {
            // window[i] has weight 64·(N − 1 − i); with the shift it goes to i − shift.
            let Some(to) = i.checked_sub(shift) else {
                continue;
            };
            let t = u128::from(window[i]) * u128::from(limb) + u128::from(product[to]) + carry;
            product[to] = t as u64;
            carry = t >> 64;
        }
    }
    let mut quadrant = (product[0] >> 62) as i64;
    // The fraction, as 2⁶⁴-digits, rounded to the nearest quadrant.
    let mut f = [0u64; N];
    for i in 0..N {
        f[i] = product[i] << 2 | product.get(i + 1).map_or(0, |w| w >> 62);
    }
    let negative = f[0] >> 63 == 1;
    if negative {
        quadrant += 1;
        // 1 − fraction.
        let mut carry = true;
        for w in f.iter_mut().rev() {
            let (v, c) = (!*w).overflowing_add(u64::from(carry));
            *w = v;
            carry = c;
        }
    }
    (quadrant, negative, f)
}

/// The rest of `2 a y` in [−π/4, π/4] and `ROUND` plus the quadrant, for
/// `a ≥ 0`: within 2⁻¹⁰⁰ of itself, its two `f64`, and 2⁻²¹².
#[cold]
#[inline(never)]
pub(crate) fn reduce(a: f64, y: f64) -> (Dd, f64) {
    let (quadrant, negative, f) = fraction(a, y);
    // Leading zeros away, then three 53-bit pieces are more than two `f64` can hold.
    let zeros = f.iter().take_while(|w| **w == 0).count();
    let mut value = Dd::ZERO;
    for i in (zeros..(zeros + 3).min(N)).rev() {
        let w = f[i];
        let unit = (ROUND - 64.0 * (i + 1) as f64).power_of_two();
        // A word as two exact halves.
        let low = (w & 0xffff_ffff) as f64 * unit;
        let high = (w >> 32) as f64 * unit * 4_294_967_296.0;
        value = value.add_f(low).add_f(high);
    }
    let mut r = value * Dd::new(HALF_PI[0], HALF_PI[1]);
    if negative {
        r = -r;
    }
    // 2 a y has the sign of y.
    if y < 0.0 {
        (-r, ROUND - quadrant as f64)
    } else {
        (r, ROUND + quadrant as f64)
    }
}
