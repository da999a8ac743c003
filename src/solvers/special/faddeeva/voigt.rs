//! The Voigt profile.

use super::constants::{INV_PI, INV_SQRT_2, INV_SQRT_2_PI};
use super::lengths::{LengthMismatch, same_length};
use super::quadrant::{derivative, exp_wide, times_power, w};
use crate::double_double::{Dd, two_prod};
use crate::hex::hex;
use crate::lanes::{Lanes, Task, with_best};
use crate::real::ROUND;

/// Distance from the centre in units of `σ√2` from which the profile is Lorentz's.
pub(super) const LORENTZ: f64 = hex("0x1p27");
/// `γ/(σ√2)` below which the profile is linear in it.
pub(super) const LINEAR: f64 = hex("0x1p-400");

/// `x = m 2^e`, `1 ≤ m < 2`, for finite `x > 0`; zero is `0 · 2⁰`.
#[inline(always)]
pub(super) fn split(x: f64) -> (f64, f64) {
    const UP: f64 = hex("0x1p60");
    if x == 0.0 {
        return (0.0, 0.0);
    }
    let (x, down) = if x < f64::MIN_POSITIVE {
        (x * UP, 60.0)
    } else {
        (x, 0.0)
    };
    let bits = x.to_bits();
    let m = f64::from_bits(bits & ((1 << 52) - 1) | 1023 << 52);
    (m, (bits >> 52) as f64 - 1023.0 - down)
}

/// `γ/(π (x² + γ²))`
#[inline(always)]
fn lorentz(x: f64, gamma: f64) -> f64 {
    let ((mx, ex), (mg, eg)) = (split(x), split(gamma));
    let e = if x > gamma { ex } else { eg };
    let unit = |m: f64, k: f64| times_power(m, ROUND + (k - e));
    let (p, q) = (unit(mx, ex), unit(mg, eg));
    let r2 = two_prod(p, p) + two_prod(q, q);
    times_power(
        Dd::from(mg).div(r2).mul_f(INV_PI.hi).value(),
        ROUND + (eg - 2.0 * e),
    )
}

/// `e^{−t²} 2^{−e}/(m √(2π))` for `σ = m 2^e`.
#[inline(always)]
fn gauss(t: Dd, (m, e): (f64, f64)) -> f64 {
    if !(t.hi < 60.0) {
        return 0.0;
    }
    let (g, n) = exp_wide(-(t.square()));
    times_power((g * INV_SQRT_2_PI).div(Dd::from(m)).value(), n - e)
}

struct Voigt {
    x: f64,
    sigma: f64,
    gamma: f64,
}

impl Task for Voigt {
    type Output = f64;
    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> f64 {
        let Voigt { x, sigma, gamma } = self;
        let x = x.abs();
        if !(sigma >= 0.0 && gamma >= 0.0) || x.is_nan() {
            return f64::NAN;
        }
        if x.is_infinite() || sigma.is_infinite() || gamma.is_infinite() {
            return 0.0;
        }
        if sigma == 0.0 {
            return match (gamma > 0.0, x > 0.0) {
                (true, _) => lorentz(x, gamma),
                (false, true) => 0.0,
                (false, false) => f64::INFINITY,
            };
        }
        let ((mx, ex), (mg, eg), (ms, es)) = (split(x), split(gamma), split(sigma));
        // |x|/(σ√2), γ/(σ√2) to 100 bits.
        let over = |m: f64, e: f64| {
            let t = Dd::from(m).div(Dd::from(ms)) * INV_SQRT_2;
            let n = ROUND + (e - es);
            Dd::new(times_power(t.hi, n), times_power(t.lo, n))
        };
        let (p, q) = (over(mx, ex), over(mg, eg));
        if gamma == 0.0 {
            return gauss(p, (ms, es));
        }
        if !(p.hi < LORENTZ && q.hi < LORENTZ) {
            return lorentz(x, gamma);
        }
        if q.hi < LINEAR {
            // e^{−p²} − q Im w′(p), each with its own power of two.
            let slope = derivative(lanes, p.hi, 0.0).1;
            let t = (-slope).mul_f(mg) * INV_SQRT_2_PI * INV_SQRT_2;
            let t = t.div(two_prod(ms, ms)).value();
            return gauss(p, (ms, es)) + times_power(t, ROUND + (eg - 2.0 * es));
        }
        let (u, _) = w(lanes, p.hi, q.hi);
        let (du, dv, _) = derivative(lanes, p.hi, q.hi);
        let u = u.add_f(du.hi * p.lo - dv.hi * q.lo);
        times_power((u * INV_SQRT_2_PI).div(Dd::from(ms)).value(), ROUND - es)
    }
}

/// The Voigt profile, `Re w((x + iγ)/(σ√2))/(σ√(2π))` (DLMF 7.19.1 in other units): the density at
/// x of the sum of a normal variable of standard deviation σ and a Cauchy variable of half-width γ.
///
/// x, σ and γ share a unit, the value has its inverse. The quotients are kept to 100 bits, so that
/// the wings of a narrow line, where `e^{−x²/(2σ²)}` magnifies their rounding, are as accurate as
/// the rest.
///
/// # Accuracy
/// Worst found against the certified reference, 10⁵ points in each of five regions, σ and γ from
/// 10⁻³²⁰ (`tests/faddeeva_related.rs`): 2.4 units in the last place; `mechaudit audit
/// voigt` judges it.
///
/// # Special values
/// | arguments | value |
/// |---|---|
/// | σ = 0 | Lorentz's `γ/(π(x² + γ²))` |
/// | γ = 0 | the normal density |
/// | σ = γ = 0 | a point mass: ∞ at x = 0, else 0 |
/// | x, σ or γ infinite | 0 |
/// | σ or γ negative, anything NaN | NaN |
///
/// ```
/// use mechaudit_solvers::faddeeva::voigt;
///
/// assert!((voigt(0.0, 1.0, 0.0) - 0.3989422804014327).abs() < 1e-16);
/// assert!((voigt(0.0, 0.0, 2.0) - 0.15915494309189535).abs() < 1e-16);
/// assert!((voigt(1.0, 1.0, 1.0) / 0.16579566268916646 - 1.0).abs() < 1e-15);
/// assert!(voigt(0.0, -1.0, 1.0).is_nan());
/// ```
pub fn voigt(x: f64, sigma: f64, gamma: f64) -> f64 {
    with_best(Voigt { x, sigma, gamma })
}

struct Batch<'a> {
    x: &'a [f64],
    sigma: f64,
    gamma: f64,
    v: &'a mut [f64],
}

impl Task for Batch<'_> {
    type Output = ();
    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) {
        let Batch { x, sigma, gamma, v } = self;
        for (v, &x) in v.iter_mut().zip(x) {
            *v = Voigt { x, sigma, gamma }.run(lanes);
        }
    }
}

/// [`voigt`] at many x; the values have the same bits.
///
/// # Errors
/// [`LengthMismatch`] if the slices differ in length; nothing is written then.
///
/// ```
/// use mechaudit_solvers::faddeeva::{voigt, voigt_batch};
///
/// let x = [-1.0, 0.0, 3.5];
/// let mut v = [0.0; 3];
/// voigt_batch(&x, 1.0, 0.2, &mut v)?;
/// assert_eq!(v[2], voigt(3.5, 1.0, 0.2));
/// # Ok::<(), mechaudit_solvers::faddeeva::LengthMismatch>(())
/// ```
pub fn voigt_batch(x: &[f64], sigma: f64, gamma: f64, v: &mut [f64]) -> Result<(), LengthMismatch> {
    same_length(x.len(), [v.len()])?;
    with_best(Batch { x, sigma, gamma, v });
    Ok(())
}
