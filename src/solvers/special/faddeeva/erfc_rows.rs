//! erfc and erfi of a positive argument from value and slope at a centre, and erfcx likewise.
//!
//! ```text
//! erfc(c + t) = erfc c − (2/√π) e^{−c²} t (1 + p)
//! erfcx(c + t) = e^{2ct + t²} (erfcx c − (2/√π) t (1 + p))
//! 1 + p = ∫₀¹ e^{us − vs²} ds = Σ_k (−v)^k/k! Σ_m u^m/(m! (m + 2k + 1)),   u = −2ct, v = t²
//! erfi(c + t) = erfi c + (2/√π) e^{c²} t (1 + p),                          u = 2ct, v = −t²
//! ```
//!
//! With centres as close as here |u| is at most 1/16, and four sums of a few terms give p.

use super::constant_pairs::{minus, over, product, quotient, sum};
use super::constants::TWO_OVER_SQRT_PI;
use super::rows::{REAL_AXIS_PITCH, entry};
use super::tables::ON_THE_AXIS;
use crate::double_double::{Dd, fast_two_sum, two_prod};
use crate::exponential::exp_minus_one;
use crate::real::{ROUND, Real};

/// The distance between centres.
const PITCH: f64 = 1.0 / 128.0;
/// x up to which there are rows: half a distance before 8.
pub(super) const END: f64 = 8.0 - 0.5 * PITCH;
const ALL: usize = 1024;

#[repr(align(64))]
struct Rows([[f64; 4]; ALL]);

/// erfc c (hi, lo) and `−(2/√π) e^{−c²}` (hi, lo).
static ROWS: Rows = {
    let mut rows = [[0.0; 4]; ALL];
    let mut k = 0;
    while k < ALL {
        rows[k] = row(k as f64 * PITCH, false);
        k += 1;
    }
    Rows(rows)
};

/// erfi c (hi, lo) and `(2/√π) e^{c²}` (hi, lo).
static OF_ERFI: Rows = {
    let mut rows = [[0.0; 4]; ALL];
    let mut k = 0;
    while k < ALL {
        rows[k] = row(k as f64 * PITCH, true);
        k += 1;
    }
    Rows(rows)
};

/// erfcx c (hi, lo) and erfcx −c (hi, lo): erfc by `e^{c²}`.
static OF_ERFCX: Rows = {
    let mut rows = ROWS.0;
    let mut k = 0;
    while k < ALL {
        let [value, low, slope, slope_low] = rows[k];
        let value = Dd::new(value, low);
        let growth = quotient(minus(TWO_OVER_SQRT_PI), Dd::new(slope, slope_low));
        let right = product(value, growth);
        let left = product(sum(Dd::from(2.0), minus(value)), growth);
        rows[k] = [right.hi, right.lo, left.hi, left.lo];
        k += 1;
    }
    Rows(rows)
};

/// Value and slope at c by the Taylor series about the next centre of
/// [`ON_THE_AXIS`], in pairs; `|h| ≤ 1/32`, so that what is left out of `(2ch)ⁿ/n!` is below 2⁻¹⁰⁰.
const fn row(c: f64, erfi: bool) -> [f64; 4] {
    let k = (c / REAL_AXIS_PITCH + 0.5) as usize;
    let x = k as f64 * REAL_AXIS_PITCH;
    let h = c - x;
    let at = &ON_THE_AXIS[k];
    let (e, erfcx) = (Dd::new(at[0], at[1]), Dd::new(at[2], at[3]));
    let (mut value, mut slope, twice) = match erfi {
        false => (product(e, erfcx), minus(product(e, TWO_OVER_SQRT_PI)), -2.0),
        // (2/√π) F = e^{−x²} erfi x.
        true => (
            quotient(Dd::new(at[4], at[5]), e),
            quotient(TWO_OVER_SQRT_PI, e),
            2.0,
        ),
    };
    if h != 0.0 {
        // d_n = (n + 1) c_{n+1} hⁿ: (n + 1) d_{n+1} = ∓2h (x d_n + h d_{n−1}).
        let (mut before, mut last) = (Dd::from(0.0), slope);
        let mut n = 0;
        while n < 24 {
            let term = product(last, Dd::from(h));
            value = sum(value, over(term, (n + 1) as f64));
            let next = sum(product(last, Dd::from(x)), product(before, Dd::from(h)));
            let next = over(product(next, Dd::from(twice * h)), (n + 1) as f64);
            slope = sum(slope, next);
            (before, last) = (last, next);
            n += 1;
        }
    }
    [value.hi, value.lo, slope.hi, slope.lo]
}

/// `ROUND` plus the number of the centre next to `0 ≤ x <` [`END`], the centre, and the distance
/// from it.
#[inline(always)]
pub(super) fn centre<R: Real>(x: R) -> (R, R, R) {
    let round = x.like(ROUND);
    let n = x.fma(x.like(1.0 / PITCH), round);
    let c = (n - round) * x.like(PITCH);
    (n, c, x - c)
}

/// The row of centre `n`.
#[inline(always)]
pub(super) fn erfc_row(n: f64) -> &'static [f64; 4] {
    entry(&ROWS.0, n.to_bits() as usize & 1023)
}

/// The row of erfi about centre `n`.
#[inline(always)]
pub(super) fn erfi_row(n: f64) -> &'static [f64; 4] {
    entry(&OF_ERFI.0, n.to_bits() as usize & 1023)
}

/// The row of erfcx about centre `n` and about its negative.
#[inline(always)]
pub(super) fn erfcx_row(n: f64) -> &'static [f64; 4] {
    entry(&OF_ERFCX.0, n.to_bits() as usize & 1023)
}

/// `1/(m! (m + 2k + 1) k!)`, m rising; of k = 0 without m = 0, which is one.
pub(super) const TERMS: (&[f64; 8], &[f64; 7], &[f64; 4], &[f64; 1]) =
    (&terms(0, 1), &terms(1, 0), &terms(2, 0), &terms(3, 0));

const fn terms<const N: usize>(k: usize, first: usize) -> [f64; N] {
    let mut all = [0.0; N];
    let mut factorial = 1.0;
    let mut n = 2;
    while n <= k {
        factorial *= n as f64;
        n += 1;
    }
    let mut m = 0;
    while m < first + N {
        if m > 1 {
            factorial *= m as f64;
        }
        if m >= first {
            all[m - first] = 1.0 / (factorial * (m + 2 * k + 1) as f64);
        }
        m += 1;
    }
    all
}

#[inline(always)]
fn polynomial<R: Real, const N: usize>(u: R, c: &[f64; N]) -> R {
    let mut sum = u.like(c[N - 1]);
    let mut k = N - 1;
    while k > 0 {
        k -= 1;
        sum = u.fma(sum, u.like(c[k]));
    }
    sum
}

/// erfc at distance t from centre c with its row.
#[inline(always)]
pub(super) fn value<R: Real>(row: [R; 4], c: R, t: R) -> Dd<R> {
    about(row, t, (c + c) * -t, t * t)
}

/// erfi likewise.
#[inline(always)]
pub(super) fn erfi_value<R: Real>(row: [R; 4], c: R, t: R) -> Dd<R> {
    about(row, t, (c + c) * t, -(t * t))
}

#[inline(always)]
fn about<R: Real>([value, low, slope, slope_low]: [R; 4], t: R, u: R, v: R) -> Dd<R> {
    let (k0, k1, k2, k3) = TERMS;
    let inner = (-v).fma(polynomial(u, k3), polynomial(u, k2));
    let inner = (-v).fma(inner, polynomial(u, k1));
    let p = u.fma(polynomial(u, k0), -(v * inner));
    let a = two_prod(slope, t);
    let s = fast_two_sum(value, a.hi);
    let rest = a.lo + slope_low.fma(t, low);
    fast_two_sum(s.hi, s.lo + a.hi.fma(p, rest))
}

/// erfcx at distance t from a centre c of either sign, from erfcx c: the sum of two numbers whose
/// second one need not be small.
#[inline(always)]
pub(super) fn erfcx_value<R: Real>([hi, lo]: [R; 2], c: R, t: R) -> Dd<R> {
    let slope = -TWO_OVER_SQRT_PI;
    let row = [hi, lo, hi.like(slope.hi), hi.like(slope.lo)];
    let sum = value(row, c, t);
    let growth = exp_minus_one((c + c).fma(t, t * t));
    Dd::new(sum.hi, sum.hi.fma(growth, sum.lo))
}
