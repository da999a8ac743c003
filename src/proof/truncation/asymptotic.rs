//! The asymptotic series, and what is added to it beside the real axis.

use super::{OfSum, Truncation};
use crate::bounds::{HALF_PI, above, exp_up, rational, remainder, remainder_slope};
use crate::cover::Rectangle;
use crate::grid::TINIEST;
use crate::interval::{hypot_down, hypot_up, product_up, quotient_up, sum_up, up};
use mechaudit_reference::Ball;
use rug::Rational;

/// An upper bound of `e^{y² − x²}` over the rectangle.
fn decay(at: &Rectangle) -> f64 {
    let t = up(up(at.b[1] * at.b[1]) - (at.a[0] * at.a[0]).next_down());
    if t > 700.0 { f64::INFINITY } else { exp_up(t) }
}

/// With the terms up to `a_N`, so that `R_{N+1}` is left out; the component along the small
/// coordinate divided by it.
///
/// On the real axis `w − e^{−z²}` and the series are imaginary, on the imaginary axis both are
/// real: along the arc from there the component grows as the remainder's slope allows,
/// `π/2 − θ ≤ (π/2) Re z/|z|`, `θ ≤ (π/2) Im z/|z|` (for `θ ≤ π/4`).
pub(crate) fn asymptotic(terms: u32, at: &Rectangle) -> Truncation {
    let (near, far) = (hypot_down(at.a[0], at.b[0]), hypot_up(at.a[1], at.b[1]));
    let whole = remainder(terms + 1, near);
    let slope = remainder_slope(terms + 1, near);
    let along = quotient_up(product_up(HALF_PI, slope), near);
    let im = match at.small_re() {
        true => along,
        false => whole.min(product_up(along, at.a[1])),
    };
    let (mut re, mut tiny) = (whole, 0.0);
    if at.b[1] <= at.a[0] {
        let e = decay(at);
        // 2|z|² e^{y² − x²}
        let turned = product_up(product_up(2.0 * far, far), e);
        let along = quotient_up(product_up(HALF_PI, sum_up(slope, turned)), near);
        // Below half the smallest number, 2⁻¹⁰⁷⁵ > e^{−745.2}.
        let alone = if e <= TINIEST { 0.0 } else { e };
        if alone == 0.0 {
            tiny = 2.0;
        }
        re = match at.small_im() {
            true => sum_up(along, quotient_up(alone, at.b[0])),
            false => whole.min(sum_up(product_up(along, at.b[1]), alone)),
        };
    }
    Truncation {
        re,
        im,
        tiny,
        ..Truncation::all(whole)
    }
}

/// The same with 16 terms where `e^{−z²}` is added or does not count: what is added, and what
/// should be, are at most `e^{y² − x²}` each.
///
/// Re w is bounded by its two terms, [`OfSum`]: the remainder without `e^{−z²}` is imaginary on the
/// real axis, so that its real part is at most `(π/2)(y/|z|)` times its slope, [`asymptotic`]. The
/// exponential is only added below `y = 2⁻⁵⁰`, which these boxes are above.
pub(crate) fn strip(at: &Rectangle) -> Truncation {
    let mut t = asymptotic(16, at);
    let most = decay(at);
    t.norm = sum_up(t.norm, up(3.0 * most));
    t.sum = Some(OfSum {
        slope: beside(17, at),
        exponential: f64::INFINITY,
        most,
        least: 0.0,
    });
    t.re = f64::INFINITY;
    t
}

/// A bound of `|Re (R_n − e^{−z²})|/y` for `0 ≤ y ≤ x`.
fn beside(n: u32, at: &Rectangle) -> f64 {
    let (near, far) = (hypot_down(at.a[0], at.b[0]), hypot_up(at.a[1], at.b[1]));
    // 2|z|² e^{y² − x²}, the slope of the exponential.
    let turned = product_up(product_up(2.0 * far, far), decay(at));
    let slope = sum_up(remainder_slope(n, near), turned);
    quotient_up(product_up(HALF_PI, slope), near)
}

/// Next to the real axis, `b < 2⁻²⁸`, by the polynomials in `v = 1/a²`.
///
/// `|w(a + ib) − w(a) − i b w′(a)| ≤ b²/2 sup |w″|`, and by Cauchy's estimate on circles of radius
/// 3 about the points between, `|w″| ≤ (2/9) sup |w|`, where for `a ≥ 8.9` all points have
/// `|z| ≥ 5.9` and `|w| ≤ 0.6/5.9 + 2e^{h² − x²}`, `x² − h² ≥ 5.9²`: together below 0.023.
/// (`|w| ≤ (1 + B₁ √π|z|)/(√π|z|)` above the axis with `B₁ ≤ 0.74/|z|³`.) The rest is the remainder
/// of 25 terms and its slope, and what the polynomials differ from the sums they stand for.
///
/// `Re w = y U + E`: U is wrong by the remainder of 25 terms of the series ([`beside`]), by what
/// follows the first power of y in their sum, and by the polynomial. Each term
/// `a_n Re i z^{−m}/√π`, `m = 2n + 1`, is odd in y, so that what follows is at most
/// `y³ m(m + 1)(m + 2)/6 · a_n x^{−m−3}/√π`, summed below `0.7 y³/x⁴` for `x² ≥ 79`. E has
/// `e^{−a²}` in place of `e^{y² − a²} cos 2ay`, wrong by `y²` and `(2ay)²/2` parts of it, and what
/// the code's exponential is wrong by.
pub(crate) fn on_real_line(at: &Rectangle, [p0, p1]: [f64; 2], exponential: f64) -> Truncation {
    let (a, b) = (at.a[0], at.b[1]);
    if !(a >= 8.9) {
        return Truncation::all(f64::INFINITY);
    }
    let curved = product_up(0.0115, product_up(b, b));
    let v = quotient_up(quotient_up(1.0, a), a);
    // f a (1 + v p) with f a ≤ 0.5642/a.
    let size = quotient_up(product_up(0.5642, v), a);
    let im = sum_up(remainder(25, a), product_up(size, p0));
    let both = sum_up(im, product_up(b, line_slope(a, product_up(size, p1))));
    let e = decay(at);
    let exponentials = product_up(e, exponentials_of_line(at.a[1], b));
    let norm = sum_up(sum_up(curved, both), exponentials);
    let cubed = product_up(product_up(0.7, product_up(v, v)), product_up(b, b));
    let phase = product_up(2.0 * at.a[1], b);
    let turned = sum_up(product_up(1.01 * b, b), product_up(phase, phase));
    Truncation {
        re: f64::INFINITY,
        sum: Some(OfSum {
            slope: sum_up(
                sum_up(beside(25, at), cubed),
                product_up(product_up(size, v), p1),
            ),
            exponential: sum_up(exponential, turned),
            most: e,
            least: 0.564 * (1.0 - 1e-9) / (at.a[1] * at.a[1]),
        }),
        ..Truncation::all(norm)
    }
}

/// The remainder's slope next to the real axis, and that of the polynomial, which is off by
/// `missing`.
fn line_slope(a: f64, missing: f64) -> f64 {
    let remainder = quotient_up(remainder_slope(25, a), a);
    sum_up(remainder, quotient_up(missing, a))
}

/// In units of `e^{−x²}`: `e^{−z²}` itself, its slope `2|z|` times b, and what the code adds for
/// it.
fn exponentials_of_line(a: f64, b: f64) -> f64 {
    sum_up(4.0, product_up(2.0 * a, b))
}

/// Returns what `2^k (1 + s + s² Σ c_j s^j)`, evaluated without rounding, differs from `e^x` by, as
/// a part of it: `s = x − k (L₀ + L₁)` with `|s| ≤ 0.348`, `|k| ≤ most`.
///
/// k is an integer next to `x log₂ e` as computed, so that `|s| ≤ ½ ln 2 + 2⁻³⁰`, and the low part
/// of x is below 2⁻⁴⁴. `k (ln 2 − L₀ − L₁)`, the errors of the coefficients, and what follows the
/// last of them, `Σ_{n>13} |s|ⁿ/n!`, at most 1.03 times its first term; all divided by
/// `e^{−0.348} > 0.7`.
pub(crate) fn exponential_error(coefficients: &[f64], ln_2: [f64; 2], most: f64) -> f64 {
    const BITS: u32 = 300;
    const MOST: f64 = 0.348;
    let parts: Rational = ln_2.into_iter().map(rational).sum();
    let reduced = above(&(&Ball::integer(BITS, 2).ln() - &Ball::rational(BITS, &parts)));
    let mut sum = product_up(most, product_up(reduced, 1.01));
    let mut exact = Rational::from(1);
    let mut power = MOST;
    for (j, c) in coefficients.iter().enumerate() {
        exact /= Rational::from(j + 2);
        power = product_up(power, MOST);
        let off = (rational(*c) - &exact).abs();
        sum = sum_up(sum, product_up(up(off.to_f64().next_up()), power));
    }
    let next = exact / Rational::from(coefficients.len() + 2);
    let tail = product_up(product_up(power, MOST), up(next.to_f64().next_up()));
    quotient_up(sum_up(sum, product_up(1.03, tail)), 0.7)
}

/// The most by which a stored polynomial of the real line differs from
/// `Σ_{k<24} a_{k+1} (2k + 3)^s v^k` for `0 ≤ v ≤ 1/79`, `s = 0` or 1.
pub(crate) fn polynomial_error(stored: &[f64; 10], slope: bool) -> f64 {
    let mut a = Rational::from(1);
    let mut c: Vec<Rational> = Vec::new();
    for k in 0..24i64 {
        a *= Rational::from((2 * k + 1, 2));
        let factor = if slope { 2 * k + 3 } else { 1 };
        c.push(-(&a * Rational::from(factor)));
    }
    for (k, s) in stored.iter().enumerate() {
        c[k] += rational(*s);
    }
    let mut most = Rational::new();
    let (centres, half) = pieces();
    for centre in centres {
        let bound = shifted(&c, &centre)
            .iter()
            .rev()
            .fold(Rational::new(), |sum, t| sum * &half + t.clone().abs());
        most = most.max(bound);
    }
    up(most.to_f64().next_up())
}

/// Pieces of `0 ≤ v ≤ 1/79`: their centres, and half their length.
fn pieces() -> (Vec<Rational>, Rational) {
    const PIECES: i64 = 64;
    let part = |k: i64| Rational::from((k, 2 * 79 * PIECES));
    let centres = (0..PIECES).map(|piece| part(2 * piece + 1));
    (centres.collect(), part(1))
}

/// The coefficients about another centre, by repeated division.
fn shifted(c: &[Rational], centre: &Rational) -> Vec<Rational> {
    let mut t = c.to_vec();
    for i in 0..t.len() {
        for j in (i..t.len() - 1).rev() {
            let more = Rational::from(&t[j + 1] * centre);
            t[j] += more;
        }
    }
    t
}

/// One term, `|z| ≥ 10^100`, divided by the first term's scale: below `2⁻⁶⁰⁰`.
pub(crate) fn huge() -> Truncation {
    Truncation::all(1e-180)
}

#[cfg(test)]
mod tests;
