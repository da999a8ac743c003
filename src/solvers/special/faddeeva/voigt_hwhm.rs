//! Half the width of the Voigt profile at half its maximum.
//!
//! With `y = γ/(σ√2)` it is `σ√2 t`, where t > 0 solves `Re w(t + iy) = erfcx(y)/2`. The start is
//! within 0.02 % (Olivero & Longbothum, J. Quant. Spectrosc. Radiat. Transfer 17 (1977) 233):
//!
//! ```text
//! t ≈ ½ (1.06868 y + √(0.86743 y² + 4 ln 2))
//! ```
//!
//! Halley's step in single numbers leaves some 10⁻¹¹, Newton's with the residual as an unevaluated
//! sum the last rounding. Both derivatives follow from w: `w′ = −2zw + 2i/√π`, `w″ = −2(zw′ + w)`
//! (DLMF 7.10.2, 7.10.3).
//!
//! For large y the condition is solved by a series in `r = σ/γ`, from the heat equation
//! `V = Σ (σ²/2)^k L^{(2k)}/k!` for Lorentz's profile L:
//!
//! ```text
//! γ (1 + (3/2) r² − (21/8) r⁴ + (183/16) r⁶ − (10413/128) r⁸ + …)
//! ```

use super::constants::{INV_SQRT_2, SQRT_LN_2, TWO_OVER_SQRT_PI};
use super::pairs::w;
use super::places::One;
use super::quadrant::times_power;
use super::taylor::SHORT;
use super::voigt::split;
use crate::double_double::{Dd, fast_two_sum};
use crate::hex::hex;
use crate::lanes::{Lanes, Task, with_best};
use crate::real::ROUND;
use std::f64::consts::LN_2;

/// `γ/(σ√2)` below which γ does not matter: the width is `σ√(2 ln 2) + 0.53 γ + …`.
pub(super) const NORMAL: f64 = hex("0x1p-60");
/// `γ/(σ√2)` from which three terms of the series suffice: the next one is below 2⁻⁶⁰.
pub(super) const SERIES: f64 = hex("0x1p8");

struct Width {
    sigma: f64,
    gamma: f64,
}

/// w, Re w′ and Im w′ at `t + iy`, the derivatives as single numbers.
#[inline(always)]
fn with_slope<L: Lanes>(lanes: L, t: f64, y: f64) -> (Dd, f64, f64) {
    let (u, v) = w::<_, SHORT>(One(lanes), t, y, true);
    // Re w′ = 2(yv − tu) is as small as 1/y² beside its terms.
    let re = (v.mul_f(y) - u.mul_f(t)).value() * 2.0;
    let im = TWO_OVER_SQRT_PI.hi - 2.0 * (t * v.hi + y * u.hi);
    (u, re, im)
}

/// t for `NORMAL ≤ y < SERIES`.
#[inline(always)]
fn solved<L: Lanes>(lanes: L, y: Dd) -> Dd {
    let h = y.hi;
    let t = 0.5 * 1.06868f64.mul_add(h, 0.86743f64.mul_add(h * h, 4.0 * LN_2).sqrt());
    let half = w::<_, SHORT>(One(lanes), 0.0, h, true).0.scale(0.5);

    let (u, re, im) = with_slope(lanes, t, h);
    let f = (u - half).value();
    let bend = -2.0 * (t * re - h * im + u.hi);
    let t = t - 2.0 * f * re / (2.0 * re).mul_add(re, -(f * bend));

    let (u, re, im) = with_slope(lanes, t, h);
    // ∂(Re w)/∂y = −Im w′, and erfcx′(y) = 2y erfcx(y) − 2/√π.
    let by_low = -im - (2.0 * h * half.hi - 0.5 * TWO_OVER_SQRT_PI.hi);
    let f = (u - half).value() + by_low * y.lo;
    fast_two_sum(t, -f / re)
}

impl Task for Width {
    type Output = f64;
    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> f64 {
        let Width { sigma, gamma } = self;
        if !(sigma >= 0.0 && gamma >= 0.0) {
            return f64::NAN;
        }
        if sigma.is_infinite() || gamma.is_infinite() {
            return f64::INFINITY;
        }
        if sigma == 0.0 {
            return gamma.abs();
        }
        let ((mg, eg), (ms, es)) = (split(gamma), split(sigma));
        let n = ROUND + (eg - es);
        let y = Dd::from(mg).div(Dd::from(ms)) * INV_SQRT_2;
        let y = Dd::new(times_power(y.hi, n), times_power(y.lo, n));
        if y.hi >= SERIES {
            let r = times_power(ms / mg, ROUND + (es - eg));
            let r2 = r * r;
            let more = r2 * r2.mul_add(r2.mul_add(183.0 / 16.0, -21.0 / 8.0), 1.5);
            return times_power(mg.mul_add(more, mg), ROUND + eg);
        }
        let t = match y.hi < NORMAL {
            true => SQRT_LN_2,
            false => solved(lanes, y),
        };
        // σ√2 = 2σ/√2.
        times_power((t * INV_SQRT_2).mul_f(ms).value(), ROUND + (es + 1.0))
    }
}

/// Half the width at half the maximum of the Voigt profile: the x > 0 at which
/// [`voigt`](super::voigt())`(x, σ, γ) = voigt(0, σ, γ)/2`.
///
/// σ is the standard deviation of the normal part, γ half the width of the Cauchy part at half its
/// height; they and the value share a unit. There is one such x, because the profile, a convolution
/// of two even densities that fall from their centres, falls from its centre.
///
/// # Accuracy
/// Worst found against the certified reference in 1.1·10⁶ cases of `mechaudit audit voigt-hwhm`
/// (`reference/campaigns`): 0.76 units in the last place.
///
/// # Special values
/// | arguments | value |
/// |---|---|
/// | σ = 0 | γ |
/// | γ = 0 | `σ√(2 ln 2)` |
/// | σ = γ = 0 | 0 |
/// | σ or γ infinite, the other not negative | ∞ |
/// | beyond the range | ∞ |
/// | σ or γ negative, anything NaN | NaN |
///
/// ```
/// use mechaudit_solvers::faddeeva::{voigt, voigt_hwhm};
///
/// assert_eq!(voigt_hwhm(0.0, 2.0), 2.0);
/// assert_eq!(voigt_hwhm(1.0, 0.0), 1.1774100225154747);
/// let x = voigt_hwhm(1.0, 0.5);
/// assert!((voigt(x, 1.0, 0.5) / voigt(0.0, 1.0, 0.5) - 0.5).abs() < 1e-15);
/// ```
pub fn voigt_hwhm(sigma: f64, gamma: f64) -> f64 {
    with_best(Width { sigma, gamma })
}
