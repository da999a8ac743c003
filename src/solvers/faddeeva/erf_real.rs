//! Error functions of a real argument.

use super::constants::TWO_OVER_SQRT_PI;
use super::double_double::Dd;
use super::exponential::{exp, exponent};
use super::lanes::{Lanes, Task, with_best};
use super::odd_series::{ERF, odd, odd_real};
use super::plane;
use super::quadrant::{HUGE, dawson_in_strip, pair_times_power, times_power, w};
use super::real::{ROUND, scaled};

/// |x| below which erfc x is computed as 1 − erf x.
const COMPLEMENT: f64 = 0.25;

/// `e^{x²} erfc x` for `0 ≤ x < HUGE`.
#[inline(always)]
fn erfcx_right<L: Lanes>(lanes: L, x: f64) -> Dd {
    w(lanes, 0.0, x).0
}

/// erfc x for `¼ ≤ x < 30` as a mantissa and `ROUND` plus the exponent.
#[inline(always)]
fn erfc_right<L: Lanes>(lanes: L, x: f64) -> (Dd, f64) {
    let (e, n) = exp(exponent(x, 0.0));
    (e * erfcx_right(lanes, x), n)
}

/// erf x, real.
struct ErfReal(f64);

impl Task for ErfReal {
    type Output = f64;
    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> f64 {
        let x = self.0.abs();
        let value = if x < 0.5 {
            (odd_real(ERF, x) * TWO_OVER_SQRT_PI).value()
        } else if x < 6.0 {
            let (t, n) = erfc_right(lanes, x);
            (-pair_times_power(t, n)).add_f(1.0).value()
        } else if x.is_nan() {
            return f64::NAN;
        } else {
            1.0
        };
        value.copysign(self.0)
    }
}

/// erfc x, real.
struct ErfcReal(f64);

impl Task for ErfcReal {
    type Output = f64;
    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> f64 {
        let x = self.0;
        let b = x.abs();
        if b < COMPLEMENT {
            return (-(odd_real(ERF, x) * TWO_OVER_SQRT_PI)).add_f(1.0).value();
        }
        if b < 30.0 {
            let (t, n) = erfc_right(lanes, b);
            return if x > 0.0 {
                scaled(t.value(), n)
            } else {
                (-pair_times_power(t, n)).add_f(2.0).value()
            };
        }
        if x.is_nan() {
            f64::NAN
        } else if x > 0.0 {
            0.0
        } else {
            2.0
        }
    }
}

/// erfi x, real: `(2/√π) x + …` next to zero, else `(2/√π) e^{x²} F(x)`.
struct ErfiReal(f64);

impl Task for ErfiReal {
    type Output = f64;
    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> f64 {
        let x = self.0.abs();
        let value = if x < 0.5 {
            // erfi x = −i erf(ix): the signs of the coefficients alternate no more.
            let (_, im) = odd(ERF, 0.0, x);
            (im * TWO_OVER_SQRT_PI).value()
        } else if x < 30.0 {
            let (e, n) = exp(exponent(0.0, x));
            let (p, _) = dawson_in_strip(lanes, x, 0.0);
            times_power((e * p).value(), n)
        } else if x.is_nan() {
            return f64::NAN;
        } else {
            f64::INFINITY
        };
        value.copysign(self.0)
    }
}

/// erfcx x = `e^{x²} erfc x`, real.
struct ErfcxReal(f64);

impl Task for ErfcxReal {
    type Output = f64;
    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> f64 {
        let x = self.0;
        let b = x.abs();
        if !(b < HUGE) {
            return plane::w(lanes, 0.0, x).0;
        }
        if x >= 0.0 {
            return erfcx_right(lanes, b).value();
        }
        if b > 30.0 {
            return f64::INFINITY;
        }
        // 2 e^{x²} − erfcx |x|.
        let (e, n) = exp(exponent(0.0, b));
        let t = erfcx_right(lanes, b);
        if n > ROUND + 200.0 {
            return times_power(e.value(), n + 1.0);
        }
        (pair_times_power(e, n + 1.0) - t).value()
    }
}

/// DOC
pub fn erf_real(x: f64) -> f64 {
    with_best(ErfReal(x))
}

/// DOC
pub fn erfc_real(x: f64) -> f64 {
    with_best(ErfcReal(x))
}

/// DOC
pub fn erfi_real(x: f64) -> f64 {
    with_best(ErfiReal(x))
}

/// DOC
pub fn erfcx_real(x: f64) -> f64 {
    with_best(ErfcxReal(x))
}
