//! Taylor rows of erf, erfc, erfcx and `(2/√π) F`, F Dawson's function, about `k/16` on the real
//! axis.
//!
//! Each function is a solution of a linear equation, so that all coefficients follow from two
//! (DLMF 7.10.1, 7.10.3):
//!
//! ```text
//! erf, erfc   y″ = −2x y′            (n + 2) c_{n+2} = −2 (x c_{n+1} + c_n n/(n + 1))
//! erfcx       y′ = 2x y − 2/√π       (n + 2) c_{n+2} =  2 (x c_{n+1} + c_n)
//! (2/√π) F    y′ = 2/√π − 2x y       (n + 2) c_{n+2} = −2 (x c_{n+1} + c_n)
//! ```
//!
//! With `|δ| ≤ 1/32` ten coefficients serve. erfc falls by `e^{−2xδ}`, and keeps its relative
//! accuracy up to 4 with four more; beyond, its centres are half as far apart.

use super::constants::TWO_OVER_SQRT_PI;
use super::rows::{REAL_AXIS_PITCH, entry};
use super::tables::{ON_THE_AXIS, ON_THE_AXIS_FINE};
use crate::double_double::Dd;
use crate::real::{ROUND, Real};

static ERF: Rows<12, 96> = Rows::of(Function::Erf);
static ERFC: Rows<16, { ERFC_COARSE + ON_THE_AXIS_FINE.len() }> = Rows::of(Function::Erfc);
/// Up to where the asymptotic series has few terms.
static ERFCX: Rows<12, { ON_THE_AXIS.len() }> = Rows::of(Function::Erfcx);
/// As many coefficients as serve beside the axis, up to [`STRIP`](super::branch::STRIP).
static DAWSON: Rows<20, 145> = Rows::of(Function::Dawson);

/// The row of erf about centre `n` as [`on_real_axis`](super::rows::on_real_axis) numbers them:
/// `c₀` (hi, lo), `c₁` (hi, lo), `c₂ …`
#[inline(always)]
pub(super) fn erf_row(n: f64) -> &'static [f64; 12] {
    ERF.about(n)
}

/// Centres of erfc before they are closer.
const ERFC_COARSE: usize = 64;
/// The number of the first of the closer ones, in units of their distance.
const FIRST_FINE: usize = 127;
/// The distance between them.
const FINE_PITCH: f64 = 0.5 * REAL_AXIS_PITCH;
/// |x| from which the closer ones serve, and up to which.
pub(super) const ENDS_OF_ERFC: [f64; 2] = [
    (ERFC_COARSE as f64 - 0.5) * REAL_AXIS_PITCH,
    ((FIRST_FINE + ON_THE_AXIS_FINE.len()) as f64 - 0.5) * FINE_PITCH,
];

/// `ROUND` plus the number of the centre of erfc next to `x ≥ 0`, and the distance from it.
#[inline(always)]
pub(super) fn on_axis_of_erfc<R: Real>(x: R) -> (R, R) {
    let like = |c: f64| x.like(c);
    let coarse = x.below(like(ENDS_OF_ERFC[0]));
    let pitch = x.pick(coarse, like(-REAL_AXIS_PITCH), like(-FINE_PITCH));
    let step = x.pick(coarse, like(1.0 / REAL_AXIS_PITCH), like(1.0 / FINE_PITCH));
    let before = FIRST_FINE as f64 - ERFC_COARSE as f64;
    let first = x.pick(coarse, like(ROUND), like(ROUND - before));
    let k = x.fma(step, like(ROUND)) - like(ROUND);
    (k + first, k.fma(pitch, x))
}

/// The row of erfc about centre `n` as [`on_axis_of_erfc`] numbers them.
#[inline(always)]
pub(super) fn erfc_row(n: f64) -> &'static [f64; 16] {
    ERFC.about(n)
}

/// The row of erfcx about centre `n`.
#[inline(always)]
pub(super) fn erfcx_row(n: f64) -> &'static [f64; 12] {
    ERFCX.about(n)
}

/// The row of `(2/√π) F` about centre `n` on the axis.
#[inline(always)]
pub(super) fn dawson_row(n: f64) -> &'static [f64; 12] {
    beside_axis(n).first_chunk().expect("twelve of twenty")
}

/// The row of `(2/√π) F` about centre `n` beside the axis.
#[inline(always)]
pub(super) fn beside_axis(n: f64) -> &'static [f64; 20] {
    DAWSON.about(n)
}

/// K rows of N numbers.
#[repr(align(64))]
struct Rows<const N: usize, const K: usize>([[f64; N]; K]);

impl<const N: usize, const K: usize> Rows<N, K> {
    #[inline(always)]
    fn about(&'static self, n: f64) -> &'static [f64; N] {
        entry(&self.0, n.to_bits() as usize & (K.next_power_of_two() - 1))
    }

    const fn of(f: Function) -> Rows<N, K> {
        let mut rows = [[0.0; N]; K];
        let mut k = 0;
        while k < K {
            rows[k] = row(f, k);
            k += 1;
        }
        Rows(rows)
    }
}

#[derive(Clone, Copy)]
enum Function {
    Erf,
    Erfc,
    Erfcx,
    Dawson,
}

const fn row<const N: usize>(f: Function, k: usize) -> [f64; N] {
    let fine = matches!(f, Function::Erfc) && k >= ERFC_COARSE;
    let (x, [e, erfcx, dawson]) = if fine {
        let k = k - ERFC_COARSE;
        let x = (FIRST_FINE + k) as f64 * FINE_PITCH;
        (x, pairs(&ON_THE_AXIS_FINE[k]))
    } else {
        (k as f64 * REAL_AXIS_PITCH, pairs(&ON_THE_AXIS[k]))
    };
    let twice = Dd::from(2.0 * x);
    let slope = product(e, TWO_OVER_SQRT_PI);
    let (value, slope) = match f {
        // e^{−x²} erfcx x = erfc x.
        Function::Erf => (sum(Dd::from(1.0), minus(product(e, erfcx))), slope),
        Function::Erfc => (product(e, erfcx), minus(slope)),
        Function::Erfcx => (erfcx, sum(product(erfcx, twice), minus(TWO_OVER_SQRT_PI))),
        Function::Dawson => (dawson, sum(TWO_OVER_SQRT_PI, minus(product(dawson, twice)))),
    };
    let sign = if matches!(f, Function::Erfcx) {
        2.0
    } else {
        -2.0
    };
    let mut d = [0.0; N];
    [d[0], d[1], d[2], d[3]] = [value.hi, value.lo, slope.hi, slope.lo];
    let (mut before, mut last) = (value.hi, slope.hi);
    let mut n = 0;
    while n < N - 4 {
        let part = match f {
            Function::Erf | Function::Erfc => n as f64 * before / (n + 1) as f64,
            _ => before,
        };
        let next = sign * (x * last + part) / (n + 2) as f64;
        d[n + 4] = next;
        (before, last) = (last, next);
        n += 1;
    }
    d
}

const fn pairs(c: &[f64; 6]) -> [Dd; 3] {
    [
        Dd::new(c[0], c[1]),
        Dd::new(c[2], c[3]),
        Dd::new(c[4], c[5]),
    ]
}

/// `ab` by parts of 26 bits (Dekker): constants have no fused operations.
const fn product(a: Dd, b: Dd) -> Dd {
    const fn halves(x: f64) -> [f64; 2] {
        let c = 134_217_729.0 * x;
        let high = c - (c - x);
        [high, x - high]
    }
    let p = a.hi * b.hi;
    let ([a1, a2], [b1, b2]) = (halves(a.hi), halves(b.hi));
    let lost = ((a1 * b1 - p) + a1 * b2 + a2 * b1) + a2 * b2;
    normal(p, lost + (a.hi * b.lo + a.lo * b.hi))
}

/// `a + b` (Knuth).
const fn sum(a: Dd, b: Dd) -> Dd {
    let s = a.hi + b.hi;
    let t = s - a.hi;
    let lost = (a.hi - (s - t)) + (b.hi - t);
    normal(s, lost + (a.lo + b.lo))
}

const fn minus(a: Dd) -> Dd {
    Dd::new(-a.hi, -a.lo)
}

const fn normal(hi: f64, lo: f64) -> Dd {
    let s = hi + lo;
    Dd::new(s, lo - (s - hi))
}
