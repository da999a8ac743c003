//! Error functions of a complex and of a real argument.
//!
//! In the first quadrant, `w = W(y + i x) = u + i v`:
//!
//! ```text
//! erfc(x + i y) = e^{−z²} (u − i v)                                       (DLMF 7.2.2, 7.2.3)
//! erf(x + i y) = (2/√π) i e^{−z²} · conj F(y + i x), F Dawson's function  (DLMF 7.5.1)
//! erf z = (2/√π) z (1 − z²/3 + z⁴/10 − …)                                 (DLMF 7.6.1)
//! ```
//!
//! The first is used where `e^{−z²}W` is not near 1, the second beside the imaginary axis, where
//! Re erf is small, the third next to zero. The other quadrants follow from
//! `erf(−z) = −erf z`, `erf z̄ = conj erf z`.

use super::branch::{STRIP, is_huge};
use super::constants::{INV_SQRT_PI, TWO_OVER_SQRT_PI};
use super::erf_zeros;
use super::long::Long;
use super::long_relatives;
use super::long_w::{turned, vanishing_part};
use super::odd_series::{self, odd};
use super::quadrant::{
    circle, dawson_in_strip, gaussian, gaussian_exact, lifted, pair_times_power, product, size,
    times_power, w, w_exact,
};
use super::real_line::COMPLEMENT;
use crate::double_double::Dd;
use crate::hex::hex;
use crate::lanes::{Lanes, Task, with_best};
use crate::real::{ROUND, scaled, with_sign_of};
use num_complex::Complex;

/// xy below which, x being small, Re erf is linear in it.
const LINEAR: f64 = hex("0x1p-32");

/// Which function: `offset + sign · erf` in the real part, `sign · erf` in the imaginary part.
#[derive(Clone, Copy, PartialEq)]
enum Which {
    /// erf z.
    Erf,
    /// 1 − erf z.
    Erfc,
    /// 1 + erf z, for erfc(−z).
    Erfcm,
}

impl Which {
    /// `(offset, sign)` for erf.
    #[inline(always)]
    fn of_erf(self) -> (f64, f64) {
        match self {
            Which::Erf => (0.0, 1.0),
            Which::Erfc => (1.0, -1.0),
            Which::Erfcm => (1.0, 1.0),
        }
    }
    /// `(offset, sign)` for erfc.
    #[inline(always)]
    fn of_erfc(self) -> (f64, f64) {
        match self {
            Which::Erf => (1.0, -1.0),
            Which::Erfc => (0.0, 1.0),
            Which::Erfcm => (2.0, -1.0),
        }
    }
}

/// `offset + sign · t 2^k`, `n = ROUND + k`; `true` if the two cancel.
#[inline(always)]
fn shifted((offset, sign): (f64, f64), t: Dd, n: f64) -> (f64, bool) {
    if t.hi == 0.0 {
        return (offset, false);
    }
    if offset == 0.0 || size(t.hi, n) > 200.0 {
        return (times_power(sign * t.value(), n), false);
    }
    let t = pair_times_power(t, n);
    let t = if sign < 0.0 { -t } else { t };
    let sum = t.add_f(offset);
    // The terms of t may have cancelled to a sixth before.
    (sum.value(), sum.hi.abs() < 0.5 * offset)
}

/// `e^{−z²} (u − i v)` in double-double.
struct Exact {
    which: Which,
    x: f64,
    y: f64,
    /// Exponents to subtract again.
    down: (f64, f64),
}

impl Task for Exact {
    type Output = (f64, f64);
    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> (f64, f64) {
        let Exact { which, x, y, down } = self;
        let zero = match which {
            Which::Erf => erf_zeros::near_zero_of_erf(x, y),
            Which::Erfc => None,
            Which::Erfcm => erf_zeros::near_zero_of_erfc(x, y),
        };
        let (c, s, n) = gaussian_exact(lanes, x, y);
        if let Some((u, v)) = zero {
            let (re, im, _) = product((c, s), (u, v));
            let (p, q) = (re.hi.abs(), im.hi.abs());
            if p.min(q) < vanishing_part(x, y) * p.max(q) {
                return self.vanishing();
            }
            return (times_power(re.value(), n), times_power(im.value(), n));
        }
        let (u, v) = w_exact(lanes, y, x);
        let (product_re, im, _) = product((c, s), (u, -v));
        let (offset, sign) = which.of_erfc();
        let linear = x < STRIP && x * y < LINEAR;
        let re = if linear {
            // Re erf = (2/√π) x e^{y²} (1 − x²(2y² + 1)/3 + …), and c = e^{y²} (1 − x²(2y² + 1) +
            // …); e^{−z²}w is far larger.
            let linear = (c * TWO_OVER_SQRT_PI).mul_f(x);
            let second = 2.0 / 3.0 * (x * x) * (2.0 * y).mul_add(y, 1.0);
            let linear = linear.add_f(linear.hi * second);
            shifted(which.of_erf(), linear, n - down.0).0
        } else {
            shifted((offset, sign), product_re, n - down.0).0
        };
        let (part, t) = (vanishing_part(x, y), turned(x, y));
        let (u, v, e) = (u.hi.abs(), v.hi.abs(), c.hi.abs().max(s.hi.abs()));
        let (re_terms, im_terms) = (e * t.mul_add(v, u), e * t.mul_add(u, v));
        let within_range = (n - down.0).clamp(ROUND - 2040.0, ROUND + 900.0);
        let im_value = times_power(sign * im.value(), n - down.1);
        if linear {
            let vanishes = re.abs() < part * which.of_erf().0;
            return (if vanishes { self.linear() } else { re }, im_value);
        }
        let vanishes = (product_re.hi.abs() < part * re_terms)
            | (im.hi.abs() < part * im_terms)
            | (re.abs() < part * offset.max(scaled(re_terms, within_range)));
        if vanishes {
            return self.vanishing();
        }
        (re, im_value)
    }
}

impl Exact {
    /// Where a component is too small beside its terms for double-double.
    #[cold]
    #[inline(never)]
    fn vanishing(&self) -> (f64, f64) {
        let (offset, sign) = self.which.of_erfc();
        let (re, im) = long_relatives::erfc(self.x, self.y);
        let (re, im) = if sign < 0.0 { (-re, -im) } else { (re, im) };
        let re = Long::from(offset) + re;
        let down = [self.down.0, self.down.1].map(|k| -(k as i64));
        (re.scale(down[0]).value(), im.scale(down[1]).value())
    }

    /// The real part where that of erf is linear in x and next to 1.
    #[cold]
    #[inline(never)]
    fn linear(&self) -> f64 {
        let (offset, sign) = self.which.of_erf();
        let re = long_relatives::re_erf(self.x, self.y).scale(-(self.down.0 as i64));
        (Long::from(offset) + if sign < 0.0 { -re } else { re }).value()
    }
}

/// The function in the first quadrant, `|z| < 10¹⁰⁰`.
#[inline(always)]
fn quadrant<L: Lanes>(lanes: L, which: Which, x: f64, y: f64) -> (f64, f64) {
    let r2 = x.mul_add(x, y * y);
    let near = if which == Which::Erfc {
        x < COMPLEMENT
    } else {
        true
    };
    if r2 < odd_series::REACH && near {
        let (re, im) = odd(odd_series::ERF, x, y);
        let (offset, sign) = which.of_erf();
        let (re, _) = shifted((offset, sign), re * TWO_OVER_SQRT_PI, ROUND);
        return (re, sign * (im * TWO_OVER_SQRT_PI).value());
    }
    let ((x, x_down), (y, y_down)) = (lifted(x, y), lifted(y, x));
    let exact = Exact {
        which,
        x,
        y,
        down: (x_down, y_down),
    };
    let (c, s, n) = gaussian(x, y);
    let (re, im, form, any) = if x < STRIP {
        // i (c + i s)(p − i q), p + i q = (2/√π) F(y + i x).
        let (p, q) = dawson_in_strip(lanes, y, x);
        let (a, b, any) = product((c, s), (p, -q));
        (-b, a, which.of_erf(), any)
    } else {
        let (u, v) = w(lanes, y, x);
        let (re, im, any) = product((c, s), (u, -v));
        (re, im, which.of_erfc(), any)
    };
    let (re, cancelled) = shifted(form, re, n - x_down);
    if any | cancelled {
        return lanes.call(exact);
    }
    (re, times_power(form.1 * im.value(), n - y_down))
}

/// The function in the first quadrant at points that are huge or not finite.
#[cold]
#[inline(never)]
fn limits(which: Which, x: f64, y: f64) -> (f64, f64) {
    let (offset, sign) = which.of_erf();
    let one = offset + sign;
    if x.is_nan() || y.is_nan() {
        // Real on the real axis; Re erf is zero on the imaginary axis.
        let re = if x == 0.0 { offset } else { f64::NAN };
        let im = if y == 0.0 { sign * y } else { f64::NAN };
        return (re, im);
    }
    if x > y || y == 0.0 {
        return (one, sign * 0.0);
    }
    if x == 0.0 {
        return (offset, sign * f64::INFINITY);
    }
    if y.is_infinite() {
        return (f64::NAN, f64::NAN);
    }
    // erfc ~ e^{−2ixy} (x − i y)/(√π r²), of modulus e^{y² − x²}/(√π r).
    let (s, c) = circle(x, y);
    if y > x {
        // Exponents apart, so that nothing overflows; the signs are those of −erfc.
        let ratio = x / y;
        let re = c.hi.mul_add(ratio, -s.hi);
        let im = -s.hi.mul_add(ratio, c.hi);
        let sign = -sign;
        return (
            f64::INFINITY.copysign(sign * re),
            f64::INFINITY.copysign(sign * im),
        );
    }
    let size = 0.5 * INV_SQRT_PI.hi / x;
    let re = (c + -s).value() * size;
    let im = -(s + c).value() * size;
    let (offset, sign) = which.of_erfc();
    (offset + sign * re, sign * im)
}

/// Any point of the first quadrant, NaN included. On an axis erf is real or imaginary, and there
/// its slope is positive, so that the zero has the sign of the other part.
#[inline(always)]
fn anywhere<L: Lanes>(lanes: L, which: Which, x: f64, y: f64) -> (f64, f64) {
    let (re, im) = if is_huge(x, y) {
        limits(which, x, y)
    } else {
        quadrant(lanes, which, x, y)
    };
    let (offset, sign) = which.of_erf();
    (
        if x == 0.0 { offset } else { re },
        if y == 0.0 { sign * 0.0 } else { im },
    )
}

/// erf z.
struct Erf(f64, f64);

impl Task for Erf {
    type Output = (f64, f64);
    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> (f64, f64) {
        let (re, im) = anywhere(lanes, Which::Erf, self.0.abs(), self.1.abs());
        (with_sign_of(re, self.0), with_sign_of(im, self.1))
    }
}

/// erfc z.
struct Erfc(f64, f64);

impl Task for Erfc {
    type Output = (f64, f64);
    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> (f64, f64) {
        let left = self.0.is_sign_negative();
        let which = if left { Which::Erfcm } else { Which::Erfc };
        let (re, im) = anywhere(lanes, which, self.0.abs(), self.1.abs());
        // erfc(−z) = 1 + erf z.
        (
            re,
            if left != self.1.is_sign_negative() {
                -im
            } else {
                im
            },
        )
    }
}

/// The error function `erf z = (2/√π) ∫₀^z e^{−t²} dt` (DLMF 7.2.1), on the whole plane.
///
/// # Accuracy
/// Worst found against the certified reference, 10⁵ points in each of eleven regions
/// (`tests/faddeeva_related.rs`): norm 0.8 ε (ε = 2⁻⁵²), components 4 units in their last place;
/// `mechaudit audit erf` judges it. Both components keep their relative accuracy next to zero,
/// beside the axes, next to zeros and next to the curves on which they are zero, there by sums in
/// 256 bits: 0.9 units the worst of 5000 points in each region of the audit.
///
/// # Special values
/// | z | erf z |
/// |---|---|
/// | `x ± 0i` | Im is ±0 |
/// | `±0 + iy` | Re is ±0 |
/// | `±∞ + iy`, y finite | `±1 ± 0i` (the signs of x and y) |
/// | `0 ± i∞` | `0 ± i∞` |
/// | `x ± i∞`, x ≠ 0 | `NaN + NaN i`: no limit |
/// | a component NaN | `NaN + NaN i`; Im is ±0 on the real axis, Re is ±0 on the imaginary axis |
/// | above the range | the infinity of the right sign for each component above it |
///
/// ```
/// use mechaudit_solvers::faddeeva::erf;
/// use num_complex::Complex;
///
/// // Next to zero erf z is (2/√π) z.
/// let f = erf(Complex::new(1e-300, 2.0));
/// assert!((f.re / 6.160741505935513e-299 - 1.0).abs() < 1e-15);
/// assert!((f.im / 18.564802414575553 - 1.0).abs() < 1e-15);
/// ```
pub fn erf(z: Complex<f64>) -> Complex<f64> {
    let (re, im) = with_best(Erf(z.re, z.im));
    Complex::new(re, im)
}

/// The complementary error function `erfc z = 1 − erf z = e^{−z²} w(iz)` (DLMF 7.2.2, 7.2.3), on
/// the whole plane.
///
/// # Accuracy
/// Worst found against the certified reference, 10⁵ points in each of eleven regions
/// (`tests/faddeeva_related.rs`): norm 1.1 ε (ε = 2⁻⁵²; at gradual underflow in units of it),
/// components 3.7 units in their last place; `mechaudit audit erfc` judges it. Next to zeros and
/// zero curves as [`erf`].
///
/// # Special values
/// `1 − erf z`, with the table of [`erf`]: Im is ∓0 at `x ± 0i`, `+0 ∓ 0i` at `+∞ ± iy`, `2 ∓ 0i`
/// at `−∞ ± iy`, `1 ∓ i∞` at `0 ± i∞`, NaN as there.
///
/// ```
/// use mechaudit_solvers::faddeeva::erfc;
/// use num_complex::Complex;
///
/// let f = erfc(Complex::new(20.0, 0.0));
/// assert!((f.re / 5.395865611607901e-176 - 1.0).abs() < 1e-15);
/// ```
pub fn erfc(z: Complex<f64>) -> Complex<f64> {
    let (re, im) = with_best(Erfc(z.re, z.im));
    Complex::new(re, im)
}

/// The imaginary error function `erfi z = −i erf(iz) = (2/√π) e^{z²} F(z)` (DLMF 7.5.1), on the
/// whole plane.
///
/// # Accuracy
/// That of [`erf`]; `mechaudit audit erfi` judges it. Special values: those of [`erf`] at `iz`.
///
/// ```
/// use mechaudit_solvers::faddeeva::erfi;
/// use num_complex::Complex;
///
/// let f = erfi(Complex::new(1.0, 0.0));
/// assert!((f.re / 1.6504257587975428 - 1.0).abs() < 1e-15 && f.im == 0.0);
/// ```
pub fn erfi(z: Complex<f64>) -> Complex<f64> {
    let (re, im) = with_best(Erf(-z.im, z.re));
    Complex::new(im, -re)
}
