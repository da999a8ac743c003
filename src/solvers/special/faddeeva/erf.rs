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

use super::branch::{HUGE, STRIP, modulus_squared};
use super::constants::TWO_OVER_SQRT_PI;
use super::erf_exact::{LINEAR, Which, alone, cancels, shifted};
use super::groups::{Function, at_all, at_one};
use super::lengths::{LengthMismatch, same_length};
use super::odd_series::{self, odd};
use super::pairs::{self, Formulas};
use super::places::{Choose, Mask, Number, Places};
use super::quadrant::{
    IN_PAIRS, VANISHING, dawson_in_strip, gaussian, lifted, mirrored, product, times_power,
};
use super::taylor::SHORT;
use super::trapezoidal::upper_short;
use crate::exponential::exponent;
use crate::lanes::Lanes;
use crate::real::{Masked, ROUND, Real, is_zero, scaled};
use num_complex::Complex;

/// Re z from which erfc is not computed as 1 − erf.
pub(super) const COMPLEMENT: f64 = 0.25;

/// A component smaller than this part of its terms is computed again.
const CANCELLED: f64 = 1.0 / 8.0;

/// `(offset, sign)` for erf and for erfc, as [`Which`] has them, at several points, which may differ.
#[derive(Clone, Copy)]
struct Forms<R> {
    of_erf: (R, R),
    of_erfc: (R, R),
    /// Re z below which the series may serve.
    reach: R,
}

/// erf, erfc, or erfi: one type, so that one compiled function serves all of them.
#[derive(Clone, Copy)]
pub(super) struct ErrorFunction {
    complement: bool,
    /// `erfi z = −i erf(iz)`.
    turned: bool,
}

pub(super) const ERF: ErrorFunction = ErrorFunction {
    complement: false,
    turned: false,
};
pub(super) const ERFC: ErrorFunction = ErrorFunction {
    complement: true,
    ..ERF
};
pub(super) const ERFI: ErrorFunction = ErrorFunction {
    turned: true,
    ..ERF
};

impl ErrorFunction {
    #[inline(always)]
    fn forms<R: Masked>(self, x: R) -> Forms<R> {
        let like = |c: f64| x.like(c);
        let one = like(1.0);
        if !self.complement {
            return Forms {
                of_erf: (like(0.0), one),
                of_erfc: (one, -one),
                reach: like(f64::INFINITY),
            };
        }
        // erfc(−z) = 1 + erf z.
        let sign = one.with_sign_of(x);
        let left = sign.below(like(0.0));
        Forms {
            of_erf: (one, -sign),
            of_erfc: (one - sign, sign),
            reach: x.pick(left, like(f64::INFINITY), like(COMPLEMENT)),
        }
    }
}

/// The function in the first quadrant, and where it holds.
#[inline(always)]
fn quadrant<P: Places>(
    places: P,
    forms: Forms<Number<P>>,
    x: Number<P>,
    y: Number<P>,
) -> ([Number<P>; 2], Mask<P>) {
    let like = |c: f64| x.like(c);
    let r2 = x.fma(x, y * y);
    let near = x.both(r2.below(like(odd_series::REACH)), x.below(forms.reach));
    let finite = modulus_squared(x, y).below(like(HUGE));
    let among = x.except(finite, near);
    let (mut re, mut im, mut kept) = (x, y, finite);
    if x.any(among) {
        let ((x, x_down), (y, y_down)) = (lifted(x, y), lifted(y, x));
        let beside = x.below(like(STRIP));
        let (strip, away) = (x.both(among, beside), x.except(among, beside));
        let mut factor = Choose::none(x);
        if x.any(away) {
            factor = pairs::w::<_, SHORT>(places, y, x, away);
        }
        let beside = x.any(strip);
        if beside {
            // i (c + i s)(p − i q), p + i q = (2/√π) F(y + i x).
            factor = dawson_in_strip(places, y, x, strip).or_else(strip, factor);
        }
        let (c, s, n) = gaussian(places, x, y);
        let (mut p, mut q, [mut p_term, mut q_term]) = product((c, s), (factor.0, -factor.1));
        let mut form = forms.of_erfc;
        if beside {
            (p, q) = (-q, p).or_else(strip, (p, q));
            (p_term, q_term) = (x.pick(strip, q_term, p_term), x.pick(strip, p_term, q_term));
            form = (
                x.pick(strip, forms.of_erf.0, form.0),
                x.pick(strip, forms.of_erf.1, form.1),
            );
        }
        re = shifted(form, p, n - x_down);
        im = times_power(form.1 * q.value(), n - y_down);
        let part = like(CANCELLED);
        let lost = x.or(
            cancels((re, part), form.0, (p, p_term, n - x_down)),
            q.hi.magnitude().below(part * q_term),
        );
        kept = x.except(finite, x.both(among, lost));
    }
    if x.any(near) {
        let (p, q) = odd(odd_series::ERF, x, y);
        let factor = TWO_OVER_SQRT_PI.like(x);
        let value = shifted(forms.of_erf, p * factor, like(ROUND));
        re = x.pick(near, value, re);
        im = x.pick(near, forms.of_erf.1 * (q * factor).value(), im);
    }
    ([re, im], kept)
}

/// The same by more accurate sums, where it holds: away from zeros of components.
#[inline(always)]
fn in_pairs<P: Places>(
    places: P,
    forms: Forms<Number<P>>,
    x: Number<P>,
    y: Number<P>,
) -> ([Number<P>; 2], Mask<P>) {
    let like = |c: f64| x.like(c);
    let ((x, x_down), (y, y_down)) = (lifted(x, y), lifted(y, x));
    let usual = x.both(
        x.at_least(y).below(like(IN_PAIRS[0])),
        exponent(x, y).hi.magnitude().below(like(IN_PAIRS[1])),
    );
    let linear = x.both(x.below(like(STRIP)), (x * y).below(like(LINEAR)));
    let ((u, v), e) = upper_short(places, y, x);
    let (c, s, n) = mirrored(e);
    let (p, q, _) = product((c, s), (u, -v));
    let (offset, sign) = forms.of_erfc;
    let re = shifted((offset, sign), p, n - x_down);
    let im = times_power(sign * q.value(), n - y_down);
    let e = c.hi.magnitude().at_least(s.hi.magnitude());
    let terms = like(VANISHING) * e * (u.hi.magnitude() + v.hi.magnitude());
    let small = x.or(
        p.hi.magnitude().below(terms),
        x.or(
            q.hi.magnitude().below(terms),
            re.magnitude().below(like(VANISHING) * offset),
        ),
    );
    // Beside an offset that cancels, the sum may be small beside the terms.
    let sum = x.both(
        like(0.0).below(offset),
        re.magnitude()
            .below(like(VANISHING) * scaled(terms, (n - x_down).at_most(like(ROUND + 900.0)))),
    );
    (
        [re, im],
        x.except(x.except(usual, linear), x.or(small, sum)),
    )
}

impl Function for ErrorFunction {
    #[inline(always)]
    fn class<R: Masked>(self, at: [R; 2]) -> R {
        let [a, b] = self.argument(at).map(
            #[inline(always)]
            |x| x.magnitude(),
        );
        let near = a.fma(a, b * b).below(a.like(odd_series::REACH));
        a.pick(near, a.like(ROUND + 15.0), Formulas::class(b, a))
    }

    #[inline(always)]
    fn value<P: Places>(self, places: P, at: [Number<P>; 2]) -> ([Number<P>; 2], Mask<P>) {
        let [x, y] = self.argument(at);
        let forms = self.forms(x);
        let (parts, kept) = quadrant(places, forms, x.magnitude(), y.magnitude());
        (self.anywhere(forms, [x, y], parts), kept)
    }

    #[inline(always)]
    fn again<P: Places>(self, places: P, at: [Number<P>; 2]) -> ([Number<P>; 2], Mask<P>) {
        let [x, y] = self.argument(at);
        let forms = self.forms(x);
        let (parts, kept) = in_pairs(places, forms, x.magnitude(), y.magnitude());
        (self.anywhere(forms, [x, y], parts), kept)
    }

    #[inline(always)]
    fn alone<L: Lanes>(self, lanes: L, at: [f64; 2]) -> [f64; 2] {
        let [x, y] = self.argument(at);
        let which = match (self.complement, x.is_sign_negative()) {
            (false, _) => Which::Erf,
            (true, false) => Which::Erfc,
            (true, true) => Which::Erfcm,
        };
        let (re, im) = alone(lanes, which, x.abs(), y.abs());
        self.anywhere(self.forms(x), [x, y], [re, im])
    }
}

impl ErrorFunction {
    /// Where erf or erfc is to be computed.
    #[inline(always)]
    fn argument<R: Real>(self, [x, y]: [R; 2]) -> [R; 2] {
        if self.turned { [-y, x] } else { [x, y] }
    }

    /// The value at any point from that in the first quadrant. On an axis erf is real or imaginary,
    /// and there its slope is positive, so that the zero has the sign of the other part.
    #[inline(always)]
    fn anywhere<R: Masked>(self, forms: Forms<R>, [x, y]: [R; 2], [re, im]: [R; 2]) -> [R; 2] {
        let (offset, sign) = forms.of_erf;
        let re = x.pick(is_zero(x), offset, re);
        let im = x.pick(is_zero(y), sign * x.like(0.0), im);
        if self.complement {
            // erfc(−z) = 1 + erf z.
            return [re, im.with_sign_of(x).with_sign_of(y)];
        }
        let (re, im) = (re.with_sign_of(x), im.with_sign_of(y));
        if self.turned { [im, -re] } else { [re, im] }
    }
}

/// The error function `erf z = (2/√π) ∫₀^z e^{−t²} dt` (DLMF 7.2.1), on the whole plane.
///
/// # Accuracy
/// Worst found against the certified reference in the 135 055 cases of `mechaudit audit erf --cases
/// 5000`: Re 0.98 and Im 1.16 units in the last place, 99 % below 0.5. Both components keep their
/// relative accuracy next to zero, beside the axes, next to zeros and next to the curves on which
/// they are zero, there by sums in 256 bits.
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
    at_one(ERF, z)
}

/// [`erf`] at many points, several times as fast; the values have the same bits.
///
/// # Errors
/// [`LengthMismatch`] if the slices differ in length; nothing is written then.
///
/// ```
/// use mechaudit_solvers::faddeeva::{erf, erf_batch};
/// use num_complex::Complex;
///
/// let z = [Complex::new(0.5, 1.0), Complex::new(3.0, -2.0)];
/// let mut f = [Complex::default(); 2];
/// erf_batch(&z, &mut f)?;
/// assert_eq!(f, z.map(erf));
/// # Ok::<(), mechaudit_solvers::faddeeva::LengthMismatch>(())
/// ```
pub fn erf_batch(z: &[Complex<f64>], f: &mut [Complex<f64>]) -> Result<(), LengthMismatch> {
    same_length(z.len(), [f.len()])?;
    at_all(ERF, z, f);
    Ok(())
}

/// The complementary error function `erfc z = 1 − erf z = e^{−z²} w(iz)` (DLMF 7.2.2, 7.2.3), on
/// the whole plane.
///
/// # Accuracy
/// Worst found against the certified reference in the 135 055 cases of `mechaudit audit erfc
/// --cases 5000`: Re 0.90 and Im 1.06 units in the last place. Next to zeros and zero curves as
/// [`erf`].
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
    at_one(ERFC, z)
}

/// [`erfc`] at many points, several times as fast; the values have the same bits.
///
/// # Errors
/// [`LengthMismatch`] if the slices differ in length; nothing is written then.
///
/// ```
/// use mechaudit_solvers::faddeeva::{erfc, erfc_batch};
/// use num_complex::Complex;
///
/// let z = [Complex::new(0.5, 1.0), Complex::new(3.0, -2.0)];
/// let mut f = [Complex::default(); 2];
/// erfc_batch(&z, &mut f)?;
/// assert_eq!(f, z.map(erfc));
/// # Ok::<(), mechaudit_solvers::faddeeva::LengthMismatch>(())
/// ```
pub fn erfc_batch(z: &[Complex<f64>], f: &mut [Complex<f64>]) -> Result<(), LengthMismatch> {
    same_length(z.len(), [f.len()])?;
    at_all(ERFC, z, f);
    Ok(())
}

/// The imaginary error function `erfi z = −i erf(iz) = (2/√π) e^{z²} F(z)` (DLMF 7.5.1), on the
/// whole plane.
///
/// # Accuracy
/// Worst found in the 135 055 cases of `mechaudit audit erfi --cases 5000`: Re 1.04 and Im 0.96
/// units in the last place. Special values: those of [`erf`] at `iz`.
///
/// ```
/// use mechaudit_solvers::faddeeva::erfi;
/// use num_complex::Complex;
///
/// let f = erfi(Complex::new(1.0, 0.0));
/// assert!((f.re / 1.6504257587975428 - 1.0).abs() < 1e-15 && f.im == 0.0);
/// ```
pub fn erfi(z: Complex<f64>) -> Complex<f64> {
    at_one(ERFI, z)
}

/// [`erfi`] at many points, several times as fast; the values have the same bits.
///
/// # Errors
/// [`LengthMismatch`] if the slices differ in length; nothing is written then.
///
/// ```
/// use mechaudit_solvers::faddeeva::{erfi, erfi_batch};
/// use num_complex::Complex;
///
/// let z = [Complex::new(0.5, 1.0), Complex::new(3.0, -2.0)];
/// let mut f = [Complex::default(); 2];
/// erfi_batch(&z, &mut f)?;
/// assert_eq!(f, z.map(erfi));
/// # Ok::<(), mechaudit_solvers::faddeeva::LengthMismatch>(())
/// ```
pub fn erfi_batch(z: &[Complex<f64>], f: &mut [Complex<f64>]) -> Result<(), LengthMismatch> {
    same_length(z.len(), [f.len()])?;
    at_all(ERFI, z, f);
    Ok(())
}
