//! The Voigt profile.

use super::constants::{INV_PI, INV_SQRT_2, INV_SQRT_2_PI, TWO_OVER_SQRT_PI};
use super::lengths::{LengthMismatch, same_length};
use super::pairs;
use super::places::{Number, One, Places};
use super::quadrant::{exp_wide, times_power};
use super::slope::derivative;
use super::taylor::SHORT;
use crate::double_double::{Dd, two_prod};
use crate::hex::hex;
use crate::lanes::{Lanes, Task, with_best};
use crate::real::{Masked, ROUND, Real};

#[cfg(all(target_arch = "x86_64", feature = "vectors"))]
use super::places::Several;
#[cfg(all(target_arch = "x86_64", feature = "vectors"))]
use crate::pack::{Wide, WideTask, by_groups, with_widest};

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

/// Between these widths, and for x below the larger one, nothing has to be scaled.
const THIN: f64 = hex("0x1p-300");
const BROAD: f64 = hex("0x1p300");

#[inline(always)]
fn twice<R: Real>(t: Dd<R>) -> Dd<R> {
    Dd::new(t.hi + t.hi, t.lo + t.lo)
}

/// `v/(σ√2)` to 100 bits.
#[inline(always)]
fn over<R: Real>(v: R, sigma: R) -> Dd<R> {
    let zero = v.like(0.0);
    Dd::new(v, zero).div(Dd::new(sigma, zero)) * INV_SQRT_2.like(v)
}

/// Where a width is between [`THIN`] and [`BROAD`].
#[inline(always)]
fn is_usual<R: Masked>(v: R) -> R::Mask {
    v.except(v.below(v.like(BROAD)), v.below(v.like(THIN)))
}

/// The profile at one place or several.
#[inline(always)]
fn profile<P: Places>(places: P, [x, sigma, gamma]: [Number<P>; 3]) -> Number<P> {
    let like = |c: f64| x.like(c);
    let a = x.magnitude();
    let (p, q) = (over(a, sigma), over(gamma, sigma));
    let widths = x.both(is_usual(sigma), is_usual(gamma));
    let near = x.both(p.hi.below(like(LORENTZ)), q.hi.below(like(LORENTZ)));
    let kept = x.both(x.both(widths, near), a.below(like(BROAD)));
    let kept = x.except(kept, q.hi.below(like(LINEAR)));
    let mut value = a;
    if x.any(kept) {
        let (u, v) = pairs::w::<_, SHORT>(places, p.hi, q.hi, kept);
        // By the low parts of the argument, with w′ = −2zw + 2i/√π.
        let re = (v.mul_f(q.hi) + -u.mul_f(p.hi)).hi;
        let im = (TWO_OVER_SQRT_PI.like(x) + twice(-(v.mul_f(p.hi) + u.mul_f(q.hi)))).hi;
        let u = u.add_f((re + re) * p.lo - im * q.lo);
        let density = u * INV_SQRT_2_PI.like(x);
        value = density.div(Dd::new(sigma, like(0.0))).value();
    }
    let [value] = places.replaced(kept, [value], [x, sigma, gamma], |at| [anywhere(at)]);
    value
}

/// The profile where its arguments have to be scaled or are no densities.
#[cold]
#[inline(never)]
fn anywhere([x, sigma, gamma]: [f64; 3]) -> f64 {
    with_best(Anywhere { x, sigma, gamma })
}

struct Anywhere {
    x: f64,
    sigma: f64,
    gamma: f64,
}

impl Task for Anywhere {
    type Output = f64;
    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> f64 {
        let Anywhere { x, sigma, gamma } = self;
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
            let ((_, slope), _) = derivative(One(lanes), p.hi, 0.0, true);
            let t = (-slope).mul_f(mg) * INV_SQRT_2_PI * INV_SQRT_2;
            let t = t.div(two_prod(ms, ms)).value();
            return gauss(p, (ms, es)) + times_power(t, ROUND + (eg - 2.0 * es));
        }
        let (u, _) = pairs::w::<_, SHORT>(One(lanes), p.hi, q.hi, true);
        let ((du, dv), _) = derivative(One(lanes), p.hi, q.hi, true);
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
/// Worst found against the certified reference in 3.5·10⁷ cases of `mechaudit audit voigt`
/// (`reference/campaigns`): 2.68 units in the last place.
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
    with_best(At([x, sigma, gamma]))
}

/// One place.
struct At([f64; 3]);

impl Task for At {
    type Output = f64;
    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> f64 {
        profile(One(lanes), self.0)
    }
}

/// Many places: x, σ and γ, each as long as the values or one number.
struct Many<'a>([&'a [f64]; 3], &'a mut [f64]);

impl Task for Many<'_> {
    type Output = ();
    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) {
        for (i, v) in self.1.iter_mut().enumerate() {
            let at = self.0.map(|c| if c.len() == 1 { c[0] } else { c[i] });
            *v = profile(One(lanes), at);
        }
    }
}

#[cfg(all(target_arch = "x86_64", feature = "vectors"))]
impl WideTask for Many<'_> {
    type Output = ();
    #[inline(always)]
    fn run<S: Wide, L: Lanes>(self, simd: S, _: L) {
        by_groups(
            simd,
            self.0,
            self.1,
            #[inline(always)]
            |at| profile(Several(simd), at),
        );
    }
}

fn many(columns: [&[f64]; 3], v: &mut [f64]) {
    let task = Many(columns, v);
    #[cfg(all(target_arch = "x86_64", feature = "vectors"))]
    let Err(task) = with_widest(task) else { return };
    with_best(task);
}

/// [`voigt`] at many x, by vectors; the values have the same bits.
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
    many([x, &[sigma], &[gamma]], v);
    Ok(())
}

/// [`voigt`] at many x with widths of their own; the values have the same bits.
///
/// # Errors
/// [`LengthMismatch`] if the slices differ in length; nothing is written then.
///
/// ```
/// use mechaudit_solvers::faddeeva::{voigt, voigt_each};
///
/// let (x, sigma, gamma) = ([-1.0, 0.0, 3.5], [1.0, 2.0, 0.5], [0.2, 0.0, 1.0]);
/// let mut v = [0.0; 3];
/// voigt_each(&x, &sigma, &gamma, &mut v)?;
/// assert_eq!(v[2], voigt(3.5, 0.5, 1.0));
/// # Ok::<(), mechaudit_solvers::faddeeva::LengthMismatch>(())
/// ```
pub fn voigt_each(
    x: &[f64],
    sigma: &[f64],
    gamma: &[f64],
    v: &mut [f64],
) -> Result<(), LengthMismatch> {
    same_length(x.len(), [sigma.len(), gamma.len(), v.len()])?;
    many([x, sigma, gamma], v);
    Ok(())
}
