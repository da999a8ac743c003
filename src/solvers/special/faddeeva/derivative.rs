//! The derivative `w′(z) = −2z w(z) + 2i/√π` (DLMF 7.10.2) without its cancellation.
//!
//! In the upper half-plane it is summed from the derivative of w's Taylor expansions and, from
//! |z|² = 48 on, from
//!
//! ```text
//! w′(z) ~ −(i/√π) (1/z² + 3 a₁/z⁴ + 5 a₂/z⁶ + …),   a_n = (2n − 1)!!/2ⁿ       (DLMF 7.12.1)
//! ```
//!
//! In the lower half-plane `w′(z) = −4z e^{−z²} + w′(−z)` (DLMF 7.4.3).

use super::branch::is_huge;
use super::constants::{INV_SQRT_PI, TWO_OVER_SQRT_PI};
use super::long_relatives;
use super::long_w::turned;
use super::quadrant::{
    circle, derivative, exp_wide, far_derivative, gaussian, gaussian_exact, lifted,
    pair_times_power, product, series_derivative, times_power, w_exact,
};
use crate::double_double::{Dd, two_prod};
use crate::exponential::exponent;
use crate::hex::hex;
use crate::lanes::{Lanes, Task, with_best};
use crate::real::{ROUND, scaled, with_sign_of};
use num_complex::Complex;

/// As `lost`, for the sums of Taylor terms here, whose slope is rounded.
#[inline(always)]
fn cancelled(sum: Dd, term: Dd) -> bool {
    sum.hi.abs() < 0.4 * term.hi.abs()
}

/// Sizes below which a component is computed again in 256 bits: double-double is within 2⁻⁹⁸ for
/// |z| < 4096, beyond within `2⁻⁵¹/|z|⁴`, and next to the diagonal within `2⁻⁴⁹/|z|⁶` of the
/// imaginary part.
const NEAR: f64 = hex("0x1p-44");
const FAR_BELOW: f64 = hex("0x1p-22");
const FAR_ABOVE: f64 = hex("0x1p-19");

/// w′ in double-double, at `a + i b` or `a − i b`.
struct Exact {
    a: f64,
    b: f64,
    lower: bool,
    down: f64,
}

impl Task for Exact {
    type Output = (f64, f64);
    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> (f64, f64) {
        let Exact { a, b, lower, down } = self;
        let near = a.max(b) < 4096.0;
        let (u, v) = if near {
            let (p, q) = w_exact(lanes, a, b);
            let (re, im, _) = product((p, q), (Dd::from(-2.0 * a), Dd::from(-2.0 * b)));
            (re, im + TWO_OVER_SQRT_PI)
        } else {
            series_derivative::<3>(a, b)
        };
        // The lost part of the upper half-plane's terms, by its size, and the terms of the other
        // one.
        let r2 = a.mul_add(a, b * b);
        let upper = match (near, lower) {
            (true, _) => NEAR,
            (false, true) => FAR_BELOW / r2,
            (false, false) => FAR_ABOVE / (r2 * r2),
        };
        let mut least = (upper, upper);
        let (re, im) = if lower {
            let (c, s, n) = gaussian_exact(lanes, a, -b);
            let (p, q, _) = product((c, s), (Dd::from(-a), Dd::from(b)));
            let n = n + 2.0;
            if n > ROUND + 500.0 {
                return (times_power(p.value(), n - down), times_power(q.value(), n));
            }
            let e = scaled(NEAR, n.max(ROUND - 2000.0)) * if near { 1.0 } else { FAR_BELOW / NEAR };
            let t = turned(a, b);
            least.0 = upper.max(e * a.max(b * t));
            least.1 = upper.max(e * b.max(a * t));
            (pair_times_power(p, n) - u, pair_times_power(q, n) + v)
        } else {
            (u, v)
        };
        if (re.hi.abs() < least.0) | (im.hi.abs() < least.1) {
            return vanishing(self);
        }
        (times_power(re.value(), ROUND - down), im.value())
    }
}

/// Where a component is too small beside its terms for double-double.
#[cold]
#[inline(never)]
fn vanishing(Exact { a, b, lower, down }: Exact) -> (f64, f64) {
    let (re, im) = long_relatives::derivative(a, if lower { -b } else { b });
    (re.scale(-(down as i64)).value(), im.value())
}

/// Re z up to which `e^{−a²}` is a subnormal number, and Im z from which w′ is linear in it.
pub(super) const UNDERFLOW: f64 = 28.0;
const LINEAR: f64 = hex("0x1p-900");

/// w′ at `a ± i b` where the terms of Re w′ may be subnormal: they are added 2³⁰⁰ times as large,
/// and the sum is rounded once. Below the axis they have opposite signs.
#[cold]
#[inline(never)]
fn underflowing(a: f64, b: f64, lower: bool) -> (f64, f64) {
    const LIFT: f64 = hex("0x1p300");
    let (u, v) = far_derivative(a, b * LIFT);
    let (e, n) = exp_wide(exponent(a, 0.0));
    let on_axis = pair_times_power(e * Dd::from(-a), n + 301.0);
    let re = if lower { on_axis - u } else { on_axis + u };
    if cancelled(re, u) {
        let down = 0.0;
        return vanishing(Exact { a, b, lower, down });
    }
    (times_power(re.value(), ROUND - 300.0), v.value())
}

/// w′ at `a + i b` or `a − i b`, `|z| < 10¹⁰⁰`.
#[inline(always)]
fn half_plane<L: Lanes>(lanes: L, a: f64, b: f64, lower: bool) -> (f64, f64) {
    if b < LINEAR && a > 26.0 && a < UNDERFLOW {
        return underflowing(a, b, lower);
    }
    let (a, down) = lifted(a, b);
    let exact = Exact { a, b, lower, down };
    let (u, v, less) = derivative(lanes, a, b);
    if less {
        return lanes.call(exact);
    }
    if !lower {
        return (times_power(u.value(), ROUND - down), v.value());
    }
    let (c, s, n) = gaussian(a, -b);
    let (p, q, any) = product((c, s), (Dd::from(-a), Dd::from(b)));
    let n = n + 2.0;
    if any {
        return lanes.call(exact);
    }
    if n > ROUND + 500.0 {
        return (times_power(p.value(), n - down), times_power(q.value(), n));
    }
    let (re, im) = (pair_times_power(p, n) - u, pair_times_power(q, n) + v);
    if cancelled(re, u) | cancelled(im, v) {
        return lanes.call(exact);
    }
    (times_power(re.value(), ROUND - down), im.value())
}

/// w′ at points that are huge or not finite.
#[cold]
#[inline(never)]
fn limits(a: f64, y: f64) -> (f64, f64) {
    if a.is_nan() || y.is_nan() {
        // Imaginary on the imaginary axis.
        return (if a == 0.0 { a } else { f64::NAN }, f64::NAN);
    }
    let b = y.abs();
    if a == 0.0 && y < 0.0 {
        return (0.0, f64::INFINITY);
    }
    if y == f64::NEG_INFINITY {
        return (f64::NAN, f64::NAN);
    }
    // −(i/√π)/z² = −(2ab + i (a² − b²))/(√π |z|⁴).
    let (u, v) = if a.is_infinite() || b.is_infinite() {
        (-0.0, if b > a { 0.0 } else { -0.0 })
    } else {
        let k = (a.max(b).to_bits() >> 52) as f64 - 1023.0;
        let (p, q) = (scaled(a, ROUND - k), scaled(b, ROUND - k));
        let r2 = two_prod(p, p) + two_prod(q, q);
        let over = INV_SQRT_PI.div(r2.square());
        let by = |t: Dd| times_power((t * over).value(), ROUND - 2.0 * k);
        (by(two_prod(-2.0 * p, q)), by(exponent(p, q)))
    };
    if y >= 0.0 {
        return (u, v);
    }
    if a > b {
        return (-u, v);
    }
    let (s, c) = circle(a, y);
    // −4z e^{−z²} with z and e^{−z²} = c − i s of modulus one.
    let (p, q) = (a / b, 1.0);
    let re = -(p * c.hi - q * s.hi);
    let im = p * s.hi + q * c.hi;
    if b > a {
        return (f64::INFINITY.copysign(re), f64::INFINITY.copysign(im));
    }
    // Everything else is 10¹⁰⁰ times smaller.
    let k = ROUND + 2.0;
    (
        scaled((s - c).value() * b, k),
        scaled((s + c).value() * b, k),
    )
}

struct Derivative(f64, f64);

impl Task for Derivative {
    type Output = (f64, f64);
    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> (f64, f64) {
        let (a, b) = (self.0.abs(), self.1.abs());
        let (re, im) = if is_huge(a, b) {
            limits(a, self.1)
        } else {
            half_plane(lanes, a, b, self.1 < 0.0)
        };
        // On the imaginary axis Re w′ falls with x: w′(x + iy) = −x f″(y) + …, f = erfcx, f″ > 0.
        let re = if a == 0.0 { -0.0 } else { re };
        // w′(−z̄) = −conj w′(z).
        (with_sign_of(re, self.0), im)
    }
}

/// The derivative `w′(z) = −2z w(z) + 2i/√π` (DLMF 7.10.2) of the Faddeeva function, on the whole
/// plane and without that sum's cancellation for large |z|.
///
/// # Accuracy
/// Worst found against the certified reference, 10⁵ points in each of eleven regions
/// (`tests/faddeeva_related.rs`): norm 0.7 ε (ε = 2⁻⁵²), components 4 units in their last place.
/// Next to zeros, and to curves on which a component is zero, sums in 256 bits: 1.2 units the worst
/// of 5000 points in each region of the audit. `mechaudit audit faddeeva-derivative` judges it.
///
/// # Special values
/// | z | w′(z) |
/// |---|---|
/// | `±0 + iy` | Re is ∓0 |
/// | infinite, Im z ≥ 0 or `±∞ + iy`, y finite | 0 with the signs of `−i/z²` |
/// | `±0 − i∞` | `∓0 + i∞` |
/// | `x − i∞`, x ≠ 0 | `NaN + NaN i`: no limit |
/// | a component NaN | `NaN + NaN i`; Re is ∓0 on the imaginary axis |
/// | above the range | the infinity of the right sign for each component above it |
///
/// ```
/// use mechaudit_solvers::faddeeva::w_derivative;
/// use num_complex::Complex;
///
/// // w′ ~ −i/(√π z²).
/// let d = w_derivative(Complex::new(0.0, 1e6));
/// assert!((d.im / 5.6418958354691e-13 - 1.0).abs() < 1e-15 && d.re == 0.0);
/// ```
pub fn w_derivative(z: Complex<f64>) -> Complex<f64> {
    let (re, im) = with_best(Derivative(z.re, z.im));
    Complex::new(re, im)
}
