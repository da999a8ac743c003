//! Taylor rows of erf and `(2/√π) F`, F Dawson's function, about `k/16` on the real axis.
//!
//! Each function is a solution of a linear equation, so that all coefficients follow from two
//! (DLMF 7.10.1, 7.10.3):
//!
//! ```text
//! erf         y″ = −2x y′            (n + 2) c_{n+2} = −2 (x c_{n+1} + c_n n/(n + 1))
//! (2/√π) F    y′ = 2/√π − 2x y       (n + 2) c_{n+2} = −2 (x c_{n+1} + c_n)
//! ```
//!
//! With `|δ| ≤ 1/32` ten coefficients serve.

use super::constant_pairs::{minus, product, sum};
use super::constants::TWO_OVER_SQRT_PI;
use super::rows::{REAL_AXIS_PITCH, entry};
use super::tables::ON_THE_AXIS;
use crate::double_double::Dd;

static ERF: Rows<12, 96> = Rows::of(Function::Erf);
/// As many coefficients as serve beside the axis, up to [`STRIP`](super::branch::STRIP).
static DAWSON: Rows<20, 145> = Rows::of(Function::Dawson);

/// The row of erf about centre `n` as [`on_real_axis`](super::rows::on_real_axis) numbers them:
/// `c₀` (hi, lo), `c₁` (hi, lo), `c₂ …`
#[inline(always)]
pub(super) fn erf_row(n: f64) -> &'static [f64; 12] {
    ERF.about(n)
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
    Dawson,
}

const fn row<const N: usize>(f: Function, k: usize) -> [f64; N] {
    let x = k as f64 * REAL_AXIS_PITCH;
    let c = &ON_THE_AXIS[k];
    let [e, erfcx, dawson] = [
        Dd::new(c[0], c[1]),
        Dd::new(c[2], c[3]),
        Dd::new(c[4], c[5]),
    ];
    let twice = Dd::from(2.0 * x);
    let slope = product(e, TWO_OVER_SQRT_PI);
    let (value, slope) = match f {
        // e^{−x²} erfcx x = erfc x.
        Function::Erf => (sum(Dd::from(1.0), minus(product(e, erfcx))), slope),
        Function::Dawson => (dawson, sum(TWO_OVER_SQRT_PI, minus(product(dawson, twice)))),
    };
    let mut d = [0.0; N];
    [d[0], d[1], d[2], d[3]] = [value.hi, value.lo, slope.hi, slope.lo];
    let (mut before, mut last) = (value.hi, slope.hi);
    let mut n = 0;
    while n < N - 4 {
        let part = match f {
            Function::Erf => n as f64 * before / (n + 1) as f64,
            _ => before,
        };
        let next = -2.0 * (x * last + part) / (n + 2) as f64;
        d[n + 4] = next;
        (before, last) = (last, next);
        n += 1;
    }
    d
}
