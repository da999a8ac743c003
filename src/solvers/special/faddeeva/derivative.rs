//! The derivative `w′(z) = −2z w(z) + 2i/√π` (DLMF 7.10.2) without its cancellation.
//!
//! In the upper half-plane it is summed from w's Taylor expansions with this equation put in, so
//! that nothing cancels but what is exact, and, from |z|² = 48 on, from
//!
//! ```text
//! w′(z) ~ −(i/√π) (1/z² + 3 a₁/z⁴ + 5 a₂/z⁶ + …),   a_n = (2n − 1)!!/2ⁿ       (DLMF 7.12.1)
//! ```
//!
//! In the lower half-plane `w′(z) = −4z e^{−z²} + w′(−z)` (DLMF 7.4.3).

use super::branch::{HUGE, is_huge, modulus_squared};
use super::constants::{INV_SQRT_PI, TWO_OVER_SQRT_PI};
use super::groups::{Function, at_all, at_one};
use super::lengths::{LengthMismatch, same_length};
use super::long_relatives;
use super::long_w::turned;
use super::pairs::Formulas;
use super::places::{Choose, Mask, Number, Places};
use super::quadrant::{
    IN_PAIRS, VANISHING, circle, exp_wide, gaussian, gaussian_exact, lifted, lost,
    pair_times_power, product, times_power, w_exact,
};
use super::slope::{derivative, far_derivative, series_derivative};
use super::trapezoidal::upper_short;
use crate::double_double::{Dd, two_prod};
use crate::exponential::exponent;
use crate::hex::hex;
use crate::lanes::{Lanes, Task};
use crate::real::{Masked, ROUND, Real, is_zero, scaled};
use num_complex::Complex;

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
            series_derivative::<_, 4>(a, b)
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
    let (u, v) = far_derivative(a, b * LIFT, true);
    let (e, n) = exp_wide(exponent(a, 0.0));
    let on_axis = pair_times_power(e * Dd::from(-a), n + 301.0);
    let re = if lower { on_axis - u } else { on_axis + u };
    if lost(re, u.hi.abs()) {
        let down = 0.0;
        return vanishing(Exact { a, b, lower, down });
    }
    (times_power(re.value(), ROUND - 300.0), v.value())
}

/// Where the terms of Re w′ may be subnormal.
#[inline(always)]
fn underflows<R: Masked>(a: R, b: R) -> R::Mask {
    let like = |c: f64| a.like(c);
    let beside = a.both(b.below(like(LINEAR)), like(26.0).below(a));
    a.both(beside, a.below(like(UNDERFLOW)))
}

/// w′ at `a + i b`, at `a − i b` in the places `lower`, and where it holds.
#[inline(always)]
fn half_plane<P: Places>(
    places: P,
    a: Number<P>,
    b: Number<P>,
    lower: Mask<P>,
) -> ([Number<P>; 2], Mask<P>) {
    let like = |c: f64| a.like(c);
    let finite = modulus_squared(a, b).below(like(HUGE));
    let among = a.except(finite, underflows(a, b));
    let lower = a.both(among, lower);
    let (a, down) = lifted(a, b);
    let ((u, v), less) = derivative(places, a, b, among);
    let mut kept = a.except(among, less);
    let (mut re, mut im) = (u.value(), v.value());
    let mut n = like(ROUND);
    if a.any(lower) {
        let (c, s, k) = gaussian(places, a, -b);
        let zero = like(0.0);
        let (p, q, [p_term, q_term]) = product((c, s), (Dd::new(-a, zero), Dd::new(b, zero)));
        let k = k + like(2.0);
        let alone = a.both(lower, like(ROUND + 500.0).below(k));
        let within = k.raised(ROUND - 2040.0).at_most(like(ROUND + 900.0));
        let (re_sum, im_sum) = (
            pair_times_power(p, within) - u,
            pair_times_power(q, within) + v,
        );
        let lost = a.or(
            lost(re_sum, scaled(p_term, within).at_least(u.hi.magnitude())),
            lost(im_sum, scaled(q_term, within).at_least(v.hi.magnitude())),
        );
        kept = a.except(kept, a.both(lower, lost));
        re = a.pick(alone, p.value(), a.pick(lower, re_sum.value(), re));
        im = a.pick(alone, q.value(), a.pick(lower, im_sum.value(), im));
        n = a.pick(alone, k, n);
        im = times_power(im, n);
    }
    ([times_power(re, n - down), im], kept)
}

/// The same by more accurate sums, where it holds: away from zeros of components.
#[inline(always)]
fn in_pairs<P: Places>(
    places: P,
    a: Number<P>,
    b: Number<P>,
    lower: Mask<P>,
) -> ([Number<P>; 2], Mask<P>) {
    let like = |c: f64| a.like(c);
    let usual = a.except(
        a.both(
            a.at_least(b).below(like(IN_PAIRS[0])),
            exponent(a, b).hi.magnitude().below(like(IN_PAIRS[1] / 8.0)),
        ),
        underflows(a, b),
    );
    let (a, down) = lifted(a, b);
    let zero = like(0.0);
    let ((p, q), (c, s, n)) = upper_short(places, a, b);
    let minus = (Dd::new(like(-2.0) * a, zero), Dd::new(like(-2.0) * b, zero));
    let (re, im, _) = product((p, q), minus);
    let (mut re, mut im) = (re, im + TWO_OVER_SQRT_PI.like(a));
    let mut least = like(VANISHING);
    if a.any(lower) {
        let (p, q, _) = product((c, -s), (Dd::new(-a, zero), Dd::new(b, zero)));
        let n = n + like(2.0);
        let below = (pair_times_power(p, n) - re, pair_times_power(q, n) + im);
        (re, im) = below.or_else(lower, (re, im));
        let e = scaled(like(VANISHING), n) * a.at_least(b);
        least = a.pick(lower, least.at_least(e), least);
    }
    let small = a.or(
        re.hi.magnitude().below(least),
        im.hi.magnitude().below(least),
    );
    let kept = a.except(usual, small);
    (
        [times_power(re.value(), like(ROUND) - down), im.value()],
        kept,
    )
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

#[derive(Clone, Copy)]
pub(super) struct Derivative;

impl Derivative {
    /// The value at any point from that at `|x| + iy`. On the imaginary axis Re w′ falls with x:
    /// `w′(x + iy) = −x f″(y) + …`, f = erfcx, f″ > 0; and w′(−z̄) = −conj w′(z).
    #[inline(always)]
    fn anywhere<R: Masked>(x: R, [re, im]: [R; 2]) -> [R; 2] {
        [x.pick(is_zero(x), x.like(-0.0), re).with_sign_of(x), im]
    }
}

impl Function for Derivative {
    #[inline(always)]
    fn class<R: Masked>(self, [x, y]: [R; 2]) -> R {
        let class = Formulas::class(x.magnitude(), y.magnitude());
        class + x.pick(y.below(x.like(0.0)), x.like(15.0), x.like(0.0))
    }
    #[inline(always)]
    fn value<P: Places>(self, places: P, [x, y]: [Number<P>; 2]) -> ([Number<P>; 2], Mask<P>) {
        let lower = y.below(y.like(0.0));
        let (parts, kept) = half_plane(places, x.magnitude(), y.magnitude(), lower);
        (Derivative::anywhere(x, parts), kept)
    }
    #[inline(always)]
    fn again<P: Places>(self, places: P, [x, y]: [Number<P>; 2]) -> ([Number<P>; 2], Mask<P>) {
        let lower = y.below(y.like(0.0));
        let (parts, kept) = in_pairs(places, x.magnitude(), y.magnitude(), lower);
        (Derivative::anywhere(x, parts), kept)
    }
    #[inline(always)]
    fn alone<L: Lanes>(self, lanes: L, [x, y]: [f64; 2]) -> [f64; 2] {
        let (a, b, lower) = (x.abs(), y.abs(), y < 0.0);
        let (re, im) = if is_huge(a, b) {
            limits(a, y)
        } else if underflows(a, b) {
            underflowing(a, b, lower)
        } else {
            let (a, down) = lifted(a, b);
            Exact { a, b, lower, down }.run(lanes)
        };
        Derivative::anywhere(x, [re, im])
    }
}

/// The derivative `w′(z) = −2z w(z) + 2i/√π` (DLMF 7.10.2) of the Faddeeva function, on the whole
/// plane and without that sum's cancellation for large |z|.
///
/// # Accuracy
/// Worst found against the certified reference in the 1 080 052 cases of `mechaudit audit
/// faddeeva-derivative --cases 40000`: Re 1.50 and Im 1.42 units in the last place. Next to zeros,
/// and to curves on which a component is zero, by sums in 256 bits.
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
    at_one(Derivative, z)
}

/// [`w_derivative`] at many points, several times as fast; the values have the same bits.
///
/// # Errors
/// [`LengthMismatch`] if the slices differ in length; nothing is written then.
///
/// ```
/// use mechaudit_solvers::faddeeva::{w_derivative, w_derivative_batch};
/// use num_complex::Complex;
///
/// let z = [Complex::new(0.5, 1.0), Complex::new(3.0, -2.0)];
/// let mut d = [Complex::default(); 2];
/// w_derivative_batch(&z, &mut d)?;
/// assert_eq!(d, z.map(w_derivative));
/// # Ok::<(), mechaudit_solvers::faddeeva::LengthMismatch>(())
/// ```
pub fn w_derivative_batch(
    z: &[Complex<f64>],
    d: &mut [Complex<f64>],
) -> Result<(), LengthMismatch> {
    same_length(z.len(), [d.len()])?;
    at_all(Derivative, z, d);
    Ok(())
}
