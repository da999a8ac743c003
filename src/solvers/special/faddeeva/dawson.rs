//! Dawson's function `F(z) = e^{−z²} ∫₀^z e^{t²} dt` (DLMF 7.2.5).
//!
//! In the first quadrant, `w = u + i v`:
//!
//! ```text
//! F(z) = (√π/2) i (e^{−z²} − w(z))          (DLMF 7.5.1)
//! F(z) = z (1 − (2/3) z² + (4/15) z⁴ − …)   (DLMF 7.6.2)
//! ```
//!
//! Beside the real axis the two terms share their real parts; there the imaginary parts of the
//! coefficients of w about real centres are those of `(2/√π) F`.

use super::branch::{STRIP, is_huge};
use super::constants::HALF_SQRT_PI;
use super::erf_zeros;
use super::lengths::{LengthMismatch, same_length};
use super::long_relatives;
use super::long_w::{turned, vanishing_part};
use super::odd_series::{self, odd};
use super::quadrant::{
    circle, dawson_in_strip, gaussian, gaussian_exact, lifted, pair_times_power, times_power, w,
    w_exact,
};
use super::relatives_tables::{MAXIMUM_OF_DAWSON as MAXIMUM, MINUS_INVERSE_MAXIMUM};
use crate::double_double::{Dd, two_prod, two_sum};
use crate::lanes::{Lanes, Task, with_best};
use crate::real::{ROUND, scaled, with_sign_of};
use num_complex::Complex;

/// A component smaller than this part of its terms is computed again in double-double.
const CANCELLED: f64 = 0.25;
/// Distance from the maximum up to which the expansion about it is used.
pub(super) const BESIDE_MAXIMUM: f64 = 0.1875;
/// Im z from which the sum there may have to be computed again.
pub(super) const ROUNDING_SHOWS: f64 = hex("0x1p-20");

/// `2 f₂ = −1/x₀` and `f₃ = 1/3`.
const LEADING: [Dd; 2] = [
    Dd::new(MINUS_INVERSE_MAXIMUM[0], MINUS_INVERSE_MAXIMUM[1]),
    Dd::new(1.0 / 3.0, -odd_series::THIRD_LOW),
];
/// Terms used.
const ORDER: usize = 24;
/// `f_n = F⁽ⁿ⁾(x₀)/n!`: `f₀ = 1/(2x₀)`, `f₁ = 0`, `(n + 1) f_{n+1} = −2 (x₀ f_n + f_{n−1})`.
const COEFFICIENTS: [f64; ORDER] = {
    let mut f = [0.0; ORDER];
    f[0] = 0.5 / MAXIMUM[0];
    let mut n = 1;
    while n + 1 < ORDER {
        f[n + 1] = -2.0 * (MAXIMUM[0] * f[n] + f[n - 1]) / (n + 1) as f64;
        n += 1;
    }
    f
};
use crate::hex::hex;

/// `Im F(x + i b)/b` for `x` next to the maximum, `b ≤` [`STRIP`]: with `t = x − x₀`,
///
/// ```text
/// 2 f₂ t + f₃ (3t² − b²) + f₄ (4t³ − 4tb²) + …
/// ```
///
/// `true` if the two leading terms cancel so far that the rounding of the others, of the size of
/// b⁴, shows; it does not where b is small.
#[inline(always)]
fn slope_beside_maximum(x: f64, b: f64) -> (Dd, bool) {
    let s = two_sum(x, -MAXIMUM[0]);
    let distance = Dd::new(s.hi, s.lo).add_f(-MAXIMUM[1]).add_f(-MAXIMUM[2]);
    let t = distance.hi;
    // Im δⁿ/b by the recurrence δⁿ⁺¹ = 2t δⁿ − |δ|² δⁿ⁻¹.
    let r2 = t.mul_add(t, b * b);
    let square = distance.square();
    let third = square + square.scale(2.0) - two_prod(b, b);
    let (mut before, mut here) = (2.0 * t, third.hi);
    let mut sum = 0.0;
    let mut n = 4;
    while n < ORDER {
        let next = (2.0 * t).mul_add(here, -(r2 * before));
        sum = COEFFICIENTS[n].mul_add(next, sum);
        (before, here) = (here, next);
        n += 1;
    }
    let linear = LEADING[0] * distance;
    let slope = (linear + LEADING[1] * third).add_f(sum);
    let cancelled = slope.hi.abs() < 0.0625 * linear.hi.abs() && b > ROUNDING_SHOWS;
    (slope, cancelled)
}

/// `(√π/2) i (e^{−z²} − w)` in double-double.
struct Exact {
    x: f64,
    y: f64,
    down: (f64, f64),
}

impl Task for Exact {
    type Output = (f64, f64);
    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> (f64, f64) {
        let Exact { x, y, down } = self;
        // F(z) = −i (√π/2) e^{−z²} erf(iz), and erf(iz) = erf(−y + ix) = −conj erf(y + ix).
        if let Some((p, q)) = erf_zeros::near_zero_of_erf(y, x) {
            // e^{ζ²} erf ζ at ζ = y + ix is p + iq; e^{−z²} = conj e^{ζ²}.
            let (re, im) = (q.hi.abs(), p.hi.abs());
            if re.min(im) < vanishing_part(x, y) * re.max(im) {
                return self.vanishing();
            }
            return ((q * HALF_SQRT_PI).value(), (p * HALF_SQRT_PI).value());
        }
        let (c, s, n) = gaussian_exact(lanes, x, y);
        let (u, v) = w_exact(lanes, x, y);
        let (re, im) = difference((c, s, n), (u, v));
        let (part, e) = (vanishing_part(x, y), scaled(1.0, n.max(ROUND - 2040.0)));
        let least = |w: Dd, e: f64| part * e.max(w.hi.abs());
        if (re.hi.abs() < least(v, e * turned(x, y))) | (im.hi.abs() < least(u, e)) {
            return self.vanishing();
        }
        (
            times_power((re * HALF_SQRT_PI).value(), ROUND - down.0),
            times_power((im * HALF_SQRT_PI).value(), ROUND - down.1),
        )
    }
}

impl Exact {
    /// Where a component is too small beside its terms for double-double.
    #[cold]
    #[inline(never)]
    fn vanishing(&self) -> (f64, f64) {
        let (re, im) = long_relatives::dawson(self.x, self.y);
        let down = [self.down.0, self.down.1].map(|k| -(k as i64));
        (re.scale(down[0]).value(), im.scale(down[1]).value())
    }
}

/// `(v − Im e^{−z²}, Re e^{−z²} − u)`
#[inline(always)]
fn difference((c, s, n): (Dd, Dd, f64), (u, v): (Dd, Dd)) -> (Dd, Dd) {
    (v - pair_times_power(s, n), pair_times_power(c, n) - u)
}

/// F in the first quadrant, `|z| < 10¹⁰⁰`.
#[inline(always)]
fn quadrant<L: Lanes>(lanes: L, x: f64, y: f64) -> (f64, f64) {
    let r2 = x.mul_add(x, y * y);
    if r2 < odd_series::REACH {
        let (re, im) = odd(odd_series::DAWSON, x, y);
        return (re.value(), im.value());
    }
    let ((x, x_down), (y, y_down)) = (lifted(x, y), lifted(y, x));
    if y < STRIP {
        let (re, im) = dawson_in_strip(lanes, x, y);
        let im = if (x - MAXIMUM[0]).abs() < BESIDE_MAXIMUM {
            let (slope, cancelled) = slope_beside_maximum(x, y);
            if cancelled {
                let down = (x_down, y_down);
                return lanes.call(Exact { x, y, down });
            }
            y * slope.value()
        } else {
            (im * HALF_SQRT_PI).value()
        };
        return ((re * HALF_SQRT_PI).value(), times_power(im, ROUND - y_down));
    }
    let (u, v) = w(lanes, x, y);
    let (c, s, n) = gaussian(x, y);
    let root = HALF_SQRT_PI;
    if n > ROUND + 200.0 {
        return (
            times_power(-(s * root).value(), n - x_down),
            times_power((c * root).value(), n - y_down),
        );
    }
    let (re, im) = difference((c, s, n), (u, v));
    if (re.hi.abs() < CANCELLED * v.hi.abs()) | (im.hi.abs() < CANCELLED * u.hi.abs()) {
        return lanes.call(Exact {
            x,
            y,
            down: (x_down, y_down),
        });
    }
    (
        times_power((re * root).value(), ROUND - x_down),
        times_power((im * root).value(), ROUND - y_down),
    )
}

/// F in the first quadrant at points that are huge or not finite.
#[cold]
#[inline(never)]
fn limits(x: f64, y: f64) -> (f64, f64) {
    if x.is_nan() || y.is_nan() {
        // Real on the real axis, imaginary on the imaginary axis.
        let re = if x == 0.0 { x } else { f64::NAN };
        let im = if y == 0.0 { y } else { f64::NAN };
        return (re, im);
    }
    if x == 0.0 {
        return (0.0, f64::INFINITY);
    }
    if y.is_infinite() {
        return (f64::NAN, f64::NAN);
    }
    if x.is_infinite() {
        return (0.0, if y > 0.0 { -0.0 } else { 0.0 });
    }
    // 1/(2z), without overflow of |z|²; Im F < 0 here, for F′ < 0.
    let r = x.max(y);
    let (p, q) = (x / r, y / r);
    let m = 2.0 * (p * p + q * q);
    let (u, v) = (p / m / r, -(q / m / r));
    if x > y {
        return (u, v);
    }
    let (s, c) = circle(x, y);
    if y > x {
        return (f64::INFINITY.copysign(s.hi), f64::INFINITY.copysign(c.hi));
    }
    let half = HALF_SQRT_PI;
    ((s * half).add_f(u).value(), (c * half).add_f(v).value())
}

/// Returns whether F falls at x. The maximum is no `f64`.
#[inline(always)]
fn beyond_maximum(x: f64) -> bool {
    x > MAXIMUM[0] || (x == MAXIMUM[0] && MAXIMUM[1] < 0.0)
}

/// Dawson's function.
struct Dawson(f64, f64);

impl Task for Dawson {
    type Output = (f64, f64);
    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> (f64, f64) {
        let (x, y) = (self.0.abs(), self.1.abs());
        let (re, im) = if is_huge(x, y) {
            limits(x, y)
        } else {
            quadrant(lanes, x, y)
        };
        let re = if x == 0.0 { 0.0 } else { re };
        // The sign of F′(x).
        let im = match y == 0.0 {
            true if beyond_maximum(x) => -0.0,
            true => 0.0,
            false => im,
        };
        (with_sign_of(re, self.0), with_sign_of(im, self.1))
    }
}

/// Dawson's function `F(z) = e^{−z²} ∫₀^z e^{t²} dt` (DLMF 7.2.5), on the whole plane.
///
/// # Accuracy
/// Worst found against the certified reference, 10⁵ points in each of eleven regions
/// (`tests/faddeeva_related.rs`): norm 0.8 ε (ε = 2⁻⁵²), components 4 units in their last place;
/// beside the axes and beside the zero 0.924… of F′, where Im F changes sign, too. Next to its
/// zeros and to the zero curves of its components as [`erf`](super::erf());
/// `mechaudit audit dawson` judges it.
///
/// # Special values
/// | z | F(z) |
/// |---|---|
/// | `±0 + iy` | Re is ±0 |
/// | `x ± 0i` | Im is ±0 for \|x\| < 0.924… , ∓0 beyond: the sign of F′ |
/// | `±∞ + iy`, y finite | `±0 ∓ 0i` |
/// | `0 ± i∞` | `0 ± i∞` |
/// | `x ± i∞`, x ≠ 0 | `NaN + NaN i`: F turns by 2xy while \|F\| grows like `e^{y²}` |
/// | a component NaN | `NaN + NaN i`; Im is ±0 on the real axis, Re is ±0 on the imaginary axis |
/// | above the range | the infinity of the right sign for each component above it |
///
/// ```
/// use mechaudit_solvers::faddeeva::dawson;
/// use num_complex::Complex;
///
/// let f = dawson(Complex::new(1.0, 0.0));
/// assert!((f.re - 0.5380795069127684).abs() < 1e-15 && f.im == 0.0);
/// ```
pub fn dawson(z: Complex<f64>) -> Complex<f64> {
    let (re, im) = with_best(Dawson(z.re, z.im));
    Complex::new(re, im)
}

struct Batch<'a>(&'a [Complex<f64>], &'a mut [Complex<f64>]);

impl Task for Batch<'_> {
    type Output = ();
    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) {
        for (f, z) in self.1.iter_mut().zip(self.0) {
            let (re, im) = Dawson(z.re, z.im).run(lanes);
            *f = Complex::new(re, im);
        }
    }
}

/// [`dawson`] at many points; the values have the same bits.
///
/// # Errors
/// [`LengthMismatch`] if the slices differ in length; nothing is written then.
///
/// ```
/// use mechaudit_solvers::faddeeva::{dawson, dawson_batch};
/// use num_complex::Complex;
///
/// let z = [Complex::new(0.5, 1.0), Complex::new(9.0, -2.0)];
/// let mut f = [Complex::default(); 2];
/// dawson_batch(&z, &mut f)?;
/// assert_eq!(f, z.map(dawson));
/// # Ok::<(), mechaudit_solvers::faddeeva::LengthMismatch>(())
/// ```
pub fn dawson_batch(z: &[Complex<f64>], f: &mut [Complex<f64>]) -> Result<(), LengthMismatch> {
    same_length(z.len(), [f.len()])?;
    with_best(Batch(z, f));
    Ok(())
}
