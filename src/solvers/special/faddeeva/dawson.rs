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

use super::branch::{HUGE, STRIP, is_huge, modulus_squared};
use super::constants::HALF_SQRT_PI;
use super::erf_zeros;
use super::groups::{Function, at_all, at_one};
use super::lengths::{LengthMismatch, same_length};
use super::long_relatives;
use super::long_w::{turned, vanishing_part};
use super::odd_series::{self, odd};
use super::pairs::{self, Formulas};
use super::places::{Mask, Number, Places};
use super::quadrant::{
    IN_PAIRS, VANISHING, both_exact, circle, dawson_in_strip, gaussian, lifted, pair_times_power,
    times_power,
};
use super::relatives_tables::{MAXIMUM_OF_DAWSON as MAXIMUM, MINUS_INVERSE_MAXIMUM};
use super::taylor::LONG;
use super::trapezoidal::upper_short;
use crate::double_double::{Dd, two_prod, two_sum};
use crate::exponential::exponent;
use crate::lanes::{Lanes, Task};
use crate::real::{Masked, ROUND, Real, is_zero, scaled};
use num_complex::Complex;

/// A component smaller than this part of its terms is computed again in double-double.
const CANCELLED: f64 = 1.0 / 32.0;
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
/// `true` where the two leading terms cancel so far that the rounding of the others, of the size of
/// b⁴, shows; it does not where b is small.
#[inline(always)]
fn slope_beside_maximum<R: Masked>(x: R, b: R) -> (Dd<R>, R::Mask) {
    let like = |c: f64| x.like(c);
    let s = two_sum(x, like(-MAXIMUM[0]));
    let distance = s.add_f(like(-MAXIMUM[1])).add_f(like(-MAXIMUM[2]));
    let t = distance.hi;
    let twice = like(2.0) * t;
    // Im δⁿ/b by the recurrence δⁿ⁺¹ = 2t δⁿ − |δ|² δⁿ⁻¹.
    let r2 = t.fma(t, b * b);
    let square = distance.square();
    let third = square + Dd::new(square.hi + square.hi, square.lo + square.lo) - two_prod(b, b);
    let (mut before, mut here) = (twice, third.hi);
    let mut sum = like(0.0);
    let mut n = 4;
    while n < ORDER {
        let next = twice.fma(here, -(r2 * before));
        sum = like(COEFFICIENTS[n]).fma(next, sum);
        (before, here) = (here, next);
        n += 1;
    }
    let linear = LEADING[0].like(x) * distance;
    let slope = (linear + LEADING[1].like(x) * third).add_f(sum);
    let small = slope
        .hi
        .magnitude()
        .below(like(0.0625) * linear.hi.magnitude());
    let cancelled = x.both(small, like(ROUNDING_SHOWS).below(b));
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
        let ((u, v), (c, s, n)) = both_exact(lanes, x, y);
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
fn difference<R: Real>((c, s, n): (Dd<R>, Dd<R>, R), (u, v): (Dd<R>, Dd<R>)) -> (Dd<R>, Dd<R>) {
    (v - pair_times_power(s, n), pair_times_power(c, n) - u)
}

/// Returns whether a sum is smaller than a part of its term.
#[inline(always)]
fn lost<R: Real>(part: f64, sum: Dd<R>, term: Dd<R>) -> R::Mask {
    let least = sum.hi.like(part) * term.hi.magnitude();
    sum.hi.magnitude().below(least)
}

/// `(√π/2) t 2^k`, `n = ROUND + k`.
#[inline(always)]
fn by_root<R: Masked>(t: Dd<R>, n: R) -> R {
    times_power((t * HALF_SQRT_PI.like(n)).value(), n)
}

/// F in the first quadrant, and where it holds.
#[inline(always)]
fn quadrant<P: Places>(places: P, x: Number<P>, y: Number<P>) -> ([Number<P>; 2], Mask<P>) {
    let like = |c: f64| x.like(c);
    let root = HALF_SQRT_PI.like(x);
    let r2 = x.fma(x, y * y);
    let finite = modulus_squared(x, y).below(like(HUGE));
    let near = r2.below(like(odd_series::REACH));
    let among = x.except(finite, near);
    let beside = y.below(like(STRIP));
    let (strip, away) = (x.both(among, beside), x.except(among, beside));
    let (mut re, mut im, mut kept) = (x, y, finite);
    let ((a, x_down), (b, y_down)) = (lifted(x, y), lifted(y, x));
    if x.any(away) {
        let (u, v) = pairs::w::<_, LONG>(places, a, b, away);
        let (c, s, n) = gaussian(places, a, b);
        let (p, q) = difference((c, s, n.at_most(like(ROUND + 900.0))), (u, v));
        let alone = like(ROUND + 200.0).below(n);
        let small = x.or(lost(CANCELLED, p, v), lost(CANCELLED, q, u));
        kept = x.except(kept, x.both(away, x.except(small, alone)));
        re = by_root(p, like(ROUND) - x_down);
        im = by_root(q, like(ROUND) - y_down);
        if x.any(alone) {
            re = x.pick(alone, by_root(-s, n - x_down), re);
            im = x.pick(alone, by_root(c, n - y_down), im);
        }
    }
    if x.any(strip) {
        let (p, q) = dawson_in_strip(places, a, b, strip);
        let mut q = (q * root).value();
        let at_maximum = (a - like(MAXIMUM[0]))
            .magnitude()
            .below(like(BESIDE_MAXIMUM));
        let at_maximum = x.both(strip, at_maximum);
        if x.any(at_maximum) {
            let (slope, cancelled) = slope_beside_maximum(a, b);
            q = x.pick(at_maximum, b * slope.value(), q);
            kept = x.except(kept, x.both(at_maximum, cancelled));
        }
        re = x.pick(strip, (p * root).value(), re);
        im = x.pick(strip, times_power(q, like(ROUND) - y_down), im);
    }
    if x.any(near) {
        let (p, q) = odd(odd_series::DAWSON, x, y);
        re = x.pick(near, p.value(), re);
        im = x.pick(near, q.value(), im);
    }
    ([re, im], kept)
}

/// The same by more accurate sums, where it holds: away from zeros of components.
#[inline(always)]
fn in_pairs<P: Places>(places: P, x: Number<P>, y: Number<P>) -> ([Number<P>; 2], Mask<P>) {
    let like = |c: f64| x.like(c);
    let ((a, x_down), (b, y_down)) = (lifted(x, y), lifted(y, x));
    let usual = x.both(
        a.at_least(b).below(like(IN_PAIRS[0])),
        exponent(a, b).hi.magnitude().below(like(IN_PAIRS[1] / 4.0)),
    );
    let ((u, v), (c, s, n)) = upper_short(places, a, b);
    let (p, q) = difference((c, s, n), (u, v));
    let e = scaled(like(VANISHING), n);
    let beside = x.or(p.hi.magnitude().below(e), q.hi.magnitude().below(e));
    let small = x.or(lost(VANISHING, p, v), lost(VANISHING, q, u));
    let parts = [
        by_root(p, like(ROUND) - x_down),
        by_root(q, like(ROUND) - y_down),
    ];
    (parts, x.except(usual, x.or(small, beside)))
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

/// Dawson's function.
#[derive(Clone, Copy)]
pub(super) struct Dawson;

impl Dawson {
    /// The value at any point from that in the first quadrant.
    #[inline(always)]
    fn anywhere<R: Masked>([x, y]: [R; 2], [re, im]: [R; 2]) -> [R; 2] {
        let like = |c: f64| x.like(c);
        let re = x.pick(is_zero(x), like(0.0), re);
        // The sign of F′(x). The maximum is no `f64`.
        let last = if MAXIMUM[1] < 0.0 {
            MAXIMUM[0].next_down()
        } else {
            MAXIMUM[0]
        };
        let falls = like(last).below(x.magnitude());
        let zero = x.pick(falls, like(-0.0), like(0.0));
        let im = x.pick(is_zero(y), zero, im);
        [re.with_sign_of(x), im.with_sign_of(y)]
    }
}

impl Function for Dawson {
    #[inline(always)]
    fn class<R: Masked>(self, [x, y]: [R; 2]) -> R {
        let (a, b) = (x.magnitude(), y.magnitude());
        let near = a.fma(a, b * b).below(x.like(odd_series::REACH));
        x.pick(near, x.like(ROUND + 15.0), Formulas::class(a, b))
    }
    #[inline(always)]
    fn value<P: Places>(self, places: P, [x, y]: [Number<P>; 2]) -> ([Number<P>; 2], Mask<P>) {
        let (parts, kept) = quadrant(places, x.magnitude(), y.magnitude());
        (Dawson::anywhere([x, y], parts), kept)
    }
    #[inline(always)]
    fn again<P: Places>(self, places: P, [x, y]: [Number<P>; 2]) -> ([Number<P>; 2], Mask<P>) {
        let (parts, kept) = in_pairs(places, x.magnitude(), y.magnitude());
        (Dawson::anywhere([x, y], parts), kept)
    }
    #[inline(always)]
    fn alone<L: Lanes>(self, lanes: L, [x, y]: [f64; 2]) -> [f64; 2] {
        let (a, b) = (x.abs(), y.abs());
        let (re, im) = if is_huge(a, b) {
            limits(a, b)
        } else {
            let ((x, x_down), (y, y_down)) = (lifted(a, b), lifted(b, a));
            let down = (x_down, y_down);
            Exact { x, y, down }.run(lanes)
        };
        Dawson::anywhere([x, y], [re, im])
    }
}

/// Dawson's function `F(z) = e^{−z²} ∫₀^z e^{t²} dt` (DLMF 7.2.5), on the whole plane.
///
/// # Accuracy
/// Worst found against the certified reference in the 1 080 056 cases of `mechaudit audit dawson
/// --cases 40000`: Re 2.13 and Im 2.58 units in the last place, beside the axes and beside the zero
/// 0.924… of F′, where Im F changes sign, too. Next to its zeros and to the zero curves of its
/// components as [`erf`](super::erf()).
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
    at_one(Dawson, z)
}

/// [`dawson`] at many points, several times as fast; the values have the same bits.
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
    at_all(Dawson, z, f);
    Ok(())
}
