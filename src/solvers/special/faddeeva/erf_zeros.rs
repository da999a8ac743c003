//! Next to the zeros of erf and erfc, where no sum of rounded terms keeps any digits.

use super::constants::TWO_OVER_SQRT_PI;
use super::quadrant::product;
use super::relatives_tables::ZEROS_OF_ERF;
use super::tables::ZEROS;
use crate::double_double::{Dd, two_sum};

/// Beyond this distance double-double sums are as good.
const CLOSE: f64 = 1.0 / 131_072.0;

/// `δ + g₂δ² + g₃δ³ + …` with `δ = x + i y − z` and `(n + 1) g_{n+1} = 2 sign (z g_n + g_{n−1})`,
/// `g₀ = 0`, `g₁ = 1`; for `z` given in three parts and δ below [`CLOSE`].
///
/// `g = e^{z²} erf z` obeys `g′ = 2zg + 2/√π` (DLMF 7.10.2 rearranged), w obeys
/// `w′ = −2zw + 2i/√π`: their expansions about zeros, up to the factors `2/√π` and `2i/√π`.
fn expansion(zero: &[f64], sign: f64, x: f64, y: f64) -> Option<(Dd, Dd)> {
    let (zx, zy) = (zero[0], zero[3]);
    if !((x - zx).abs() < CLOSE && (y - zy).abs() < CLOSE) {
        return None;
    }
    let difference = |x: f64, at: usize| {
        let s = two_sum(x, -zero[at]);
        s.add_f(-zero[at + 1]).add_f(-zero[at + 2])
    };
    let (p, q) = (difference(x, 0), difference(y, 3));
    let (dx, dy) = (p.hi, q.hi);
    // Σ_{n≥3} g_n δⁿ⁻³, the coefficients going up, the powers too.
    let times = |(a, b): (f64, f64), (c, d): (f64, f64)| (a * c - b * d, a * d + b * c);
    let (z, delta) = ((zx, zy), (dx, dy));
    let (mut before, mut here) = ((1.0, 0.0), (sign * zx, sign * zy));
    let (mut power, mut sum) = ((1.0, 0.0), (0.0, 0.0));
    let mut n = 2;
    while n < 8 {
        let (c, d) = times(z, here);
        let f = 2.0 * sign / (n + 1) as f64;
        let next = (f * (c + before.0), f * (d + before.1));
        let (a, b) = times(next, power);
        sum = (sum.0 + a, sum.1 + b);
        (before, here) = (here, next);
        power = times(power, delta);
        n += 1;
    }
    // z δ² with all digits.
    let z = (Dd::new(zx, zero[1]), Dd::new(zy, zero[4]));
    let (a, b, _) = product((p, q), (p, q));
    let square = (a.hi, b.hi);
    let (a, b, _) = product((a, b), z);
    let (c, d) = times(times(square, delta), sum);
    let by = |t: Dd| if sign < 0.0 { -t } else { t };
    Some((p + by(a).add_f(c), q + by(b).add_f(d)))
}

/// `erf(z)/e^{−z²}` next to a zero of erf in the first quadrant.
pub(super) fn near_zero_of_erf(x: f64, y: f64) -> Option<(Dd, Dd)> {
    let (u, v) = ZEROS_OF_ERF.iter().find_map(|z| expansion(z, 1.0, x, y))?;
    Some((u * TWO_OVER_SQRT_PI, v * TWO_OVER_SQRT_PI))
}

/// `erfc(−z)/e^{−z²}`, `z = x + i y` in the first quadrant, next to a zero: `w(−iz) = w(y − ix)`.
pub(super) fn near_zero_of_erfc(x: f64, y: f64) -> Option<(Dd, Dd)> {
    let (u, v) = ZEROS
        .iter()
        .find_map(|z| expansion(&z.0[..6], -1.0, y, -x))?;
    Some((-(v * TWO_OVER_SQRT_PI), u * TWO_OVER_SQRT_PI))
}
