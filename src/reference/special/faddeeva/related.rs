//! erf, erfc, erfcx, erfi, Dawson's function and the Voigt profile.
//!
//! All components are certified to the relative accuracy asked for, like those of w.
//!
//! * `erfcx(z) = w(iz)` (DLMF 7.2.3).
//! * `erfc(z) = e^{−z²} w(iz)` for Re z ≥ 0; to the left `erfc(z) = 2 − erfc(−z)` (DLMF 7.4.2),
//!   where Im erfc is e^{−x²} times smaller than Re erfc and must not come out of a product.
//! * `erf(z) = 1 − erfc(z)` for Re z ≥ 1; else `erf(z) = −e^{−z²} D(iz)` with
//!   `D(z) = w(z) − e^{−z²}`, which keeps the relative accuracy next to z = 0 and of Re erf beside
//!   the imaginary axis. For Re z ≤ −1 erf is odd.
//! * `erfi(z) = −i erf(iz)` (DLMF 7.2.3 with the usual sign), `F(z) = (√π/(2i)) D(z)` (DLMF 7.5.1).
//! * Voigt: `Re w((x + iγ)/(σ√2)) / (σ√(2π))` (DLMF 7.19.1 rewritten).
//!
//! Each function comes with a variant `…_scaled`, whose exponents may have any size.

use super::argument::{Argument, Member, Real, length};
use super::choice::{at, once, once_dawson, scaled};
use super::gaussian::Gaussian;
use super::scaled::{Scaled, aligned};
use super::ziv::{balls, decide};
use crate::{Ball, ComplexBall, Undecided};
use rug::{Float, Rational};

/// Digits of z beyond the working precision that `e^{−z²}` needs.
fn extra(x: &Real, y: &Real) -> u32 {
    let e = |r: &Real| r.ball(64).mid().get_exp().unwrap_or(0).max(0) as u32;
    2 * e(x).max(e(y)) + 16
}

/// The product of the complex numbers given by components with their own exponents.
pub(super) fn times_gaussian(parts: &[Scaled; 2], x: &Real, y: &Real, prec: u32) -> [Scaled; 2] {
    let wide = prec + extra(x, y);
    let e = Gaussian::new(&x.ball(wide), &y.ball(wide), prec);
    let (a, b, k) = aligned(&parts[0], &parts[1]);
    // (a + ib)(c − is)
    let re = &a * &e.c + &b * &e.s;
    let im = &b * &e.c - &a * &e.s;
    let k = k + e.k;
    [Scaled::new(re, k.clone()), Scaled::new(im, k)]
}

/// `erfc` for Re z ≥ 0, at one precision.
fn erfc_right(x: &Real, y: &Real, prec: u32) -> Option<[Scaled; 2]> {
    let w = once(y.negated(), x.clone(), prec + 8)?;
    let [re, im] = times_gaussian(&w, x, y, prec + 8);
    if x.is_zero() {
        // erfc(iy) = 1 − i erfi(y).
        return Some([Scaled::from(Ball::integer(prec, 1)), im]);
    }
    Some([re, im])
}

/// `n − s`.
fn integer_minus(n: i64, s: &Scaled, prec: u32) -> Scaled {
    let one = Scaled::from(Ball::integer(prec, n));
    let (a, b, k) = aligned(&one, s);
    Scaled::new(a - &b, k)
}

fn erfc_once(x: &Real, y: &Real, prec: u32) -> Option<[Scaled; 2]> {
    if !x.is_negative() {
        return erfc_right(x, y, prec);
    }
    let [re, im] = erfc_right(&x.negated(), &y.negated(), prec)?;
    Some([integer_minus(2, &re, prec), -im])
}

pub(super) fn erf_once(x: &Real, y: &Real, prec: u32) -> Option<[Scaled; 2]> {
    if x.is_negative() {
        let [re, im] = erf_once(&x.negated(), &y.negated(), prec)?;
        return Some([-re, -im]);
    }
    if x.ball(64).lower() >= 1 {
        let [re, im] = erfc_right(x, y, prec)?;
        return Some([integer_minus(1, &re, prec), -im]);
    }
    let d = once_dawson(&y.negated(), x, prec + 8)?;
    let [a, b] = times_gaussian(&d, x, y, prec + 8);
    Some([-a, -b])
}

/// The error function erf z, each component with a relative radius of at most 2^-bits.
///
/// ```
/// use mechaudit_reference::faddeeva;
/// use rug::Rational;
/// let e = faddeeva::erf(&Rational::from((1, 2)), &Rational::new(), 100)?;
/// assert_eq!(e.re.to_decimal(25).unwrap(), "0.5204998778130465376827467");
/// # Ok::<(), mechaudit_reference::Undecided>(())
/// ```
///
/// # Errors
/// See the [module](super).
pub fn erf(re: &Rational, im: &Rational, bits: u32) -> Result<ComplexBall, Undecided> {
    balls(erf_scaled(re, im, bits)?, bits)
}

/// [`erf`] with exponents of any size.
///
/// # Errors
/// As [`erf`], but not for the size of the result.
pub fn erf_scaled(re: &Rational, im: &Rational, bits: u32) -> Result<[Scaled; 2], Undecided> {
    let (x, y) = (Real::of(re), Real::of(im));
    decide("erf", bits, length(&x, &y), |p| erf_once(&x, &y, p))
}

/// The complementary error function erfc z, each component with a relative radius of at most
/// 2^-bits.
///
/// # Errors
/// See the [module](super).
pub fn erfc(re: &Rational, im: &Rational, bits: u32) -> Result<ComplexBall, Undecided> {
    balls(erfc_scaled(re, im, bits)?, bits)
}

/// [`erfc`] with exponents of any size.
///
/// # Errors
/// As [`erfc`], but not for the size of the result.
pub fn erfc_scaled(re: &Rational, im: &Rational, bits: u32) -> Result<[Scaled; 2], Undecided> {
    let (x, y) = (Real::of(re), Real::of(im));
    decide("erfc", bits, length(&x, &y), |p| erfc_once(&x, &y, p))
}

/// The scaled complementary error function `erfcx z = e^{z²} erfc z = w(iz)`.
///
/// # Errors
/// See the [module](super).
pub fn erfcx(re: &Rational, im: &Rational, bits: u32) -> Result<ComplexBall, Undecided> {
    balls(erfcx_scaled(re, im, bits)?, bits)
}

/// [`erfcx`] with exponents of any size.
///
/// # Errors
/// As [`erfcx`], but not for the size of the result.
pub fn erfcx_scaled(re: &Rational, im: &Rational, bits: u32) -> Result<[Scaled; 2], Undecided> {
    scaled(Real::of(im).negated(), Real::of(re), bits)
}

/// The imaginary error function `erfi z = −i erf(iz)`.
///
/// # Errors
/// See the [module](super).
pub fn erfi(re: &Rational, im: &Rational, bits: u32) -> Result<ComplexBall, Undecided> {
    balls(erfi_scaled(re, im, bits)?, bits)
}

/// [`erfi`] with exponents of any size.
///
/// # Errors
/// As [`erfi`], but not for the size of the result.
pub fn erfi_scaled(re: &Rational, im: &Rational, bits: u32) -> Result<[Scaled; 2], Undecided> {
    let [a, b] = erf_scaled(&Rational::from(-im), re, bits)?;
    Ok([b, -a])
}

/// Dawson's function `F(z) = e^{−z²} ∫_0^z e^{t²} dt`.
///
/// # Errors
/// See the [module](super).
pub fn dawson(re: &Rational, im: &Rational, bits: u32) -> Result<ComplexBall, Undecided> {
    balls(dawson_scaled(re, im, bits)?, bits)
}

/// [`dawson`] with exponents of any size.
///
/// # Errors
/// As [`dawson`], but not for the size of the result.
pub fn dawson_scaled(re: &Rational, im: &Rational, bits: u32) -> Result<[Scaled; 2], Undecided> {
    dawson_at(&Real::of(re), &Real::of(im), bits)
}

/// A function of this module at an exact pair of floats.
#[derive(Clone, Copy)]
pub(crate) enum Relative {
    Erf,
    Erfc,
    Erfcx,
    Dawson,
}

impl Relative {
    /// The value, each component with a relative radius of at most 2^-bits or exactly zero.
    pub(crate) fn at(self, re: &Float, im: &Float, bits: u32) -> Result<[Scaled; 2], Undecided> {
        let (x, y) = (Real::of_float(re), Real::of_float(im));
        match self {
            Relative::Erf => decide("erf", bits, length(&x, &y), |p| erf_once(&x, &y, p)),
            Relative::Erfc => decide("erfc", bits, length(&x, &y), |p| erfc_once(&x, &y, p)),
            Relative::Erfcx => scaled(y.negated(), x, bits),
            Relative::Dawson => dawson_at(&x, &y, bits),
        }
    }
}

fn dawson_at(x: &Real, y: &Real, bits: u32) -> Result<[Scaled; 2], Undecided> {
    decide("Dawson's function", bits, length(x, y), |p| {
        let [a, b] = once_dawson(x, y, p + 8)?;
        let half = Ball::pi(p + 8).sqrt().shift(-1);
        let times = |s: Scaled| Scaled::new(&s.ball * &half, s.exponent);
        Some([times(b), times(-a)])
    })
}

/// The Voigt profile: the density of the sum of a normal variable of standard deviation σ and a
/// Cauchy variable of half-width γ, at x. `σ = 0` and `γ = 0` (not both) are the two pure profiles.
///
/// # Errors
/// See the [module](super). Negative σ or γ, or both zero, are refused with that reason.
pub fn voigt(
    x: &Rational,
    sigma: &Rational,
    gamma: &Rational,
    bits: u32,
) -> Result<Ball, Undecided> {
    let zero = Scaled::from(Ball::integer(64, 0));
    Ok(balls([voigt_scaled(x, sigma, gamma, bits)?, zero], bits)?.re)
}

/// [`voigt`] with an exponent of any size.
///
/// # Errors
/// As [`voigt`], but not for the size of the result.
pub fn voigt_scaled(
    x: &Rational,
    sigma: &Rational,
    gamma: &Rational,
    bits: u32,
) -> Result<Scaled, Undecided> {
    if *sigma < 0 || *gamma < 0 || (*sigma == 0 && *gamma == 0) {
        return Err(Undecided::new(
            bits,
            "the Voigt profile needs σ ≥ 0 and γ ≥ 0, not both zero",
        ));
    }
    let p = bits + 8;
    if *sigma == 0 {
        let n = Rational::from(x.square_ref()) + Rational::from(gamma.square_ref());
        let value = Ball::rational(p, &(gamma.clone() / n)) / &Ball::pi(p);
        return Ok(Scaled::from(value));
    }
    let over = |q: &Rational| {
        let t = Rational::from(q / sigma);
        Real::Root(*q < 0, Rational::from(t.square_ref()) / 2u32)
    };
    let (a, b) = (over(x), over(gamma));
    let z = Argument::new(if a.is_negative() { a.negated() } else { a }, b);
    let all = length(&z.x, &z.y);
    let [re, _] = decide("the Voigt profile", bits + 4, all, |p| {
        let [re, _] = at(&z, Member::W, p)?;
        Some([re, Scaled::from(Ball::integer(64, 0))])
    })?;
    let root = Ball::rational(p, &Rational::from(sigma.square_ref())) * &Ball::pi(p).shift(1);
    Ok(Scaled::new(re.ball / &root.sqrt(), re.exponent))
}

#[cfg(test)]
mod tests {
    use super::super::tests::q;
    use super::super::{taylor, w_derivative_scaled};
    use super::*;

    type Function = fn(&Rational, &Rational, u32) -> Result<[Scaled; 2], Undecided>;

    fn overlap(a: &[Scaled; 2], b: &[Scaled; 2]) -> bool {
        a.iter().zip(b).all(|(a, b)| {
            let (a, b, _) = aligned(a, b);
            a.overlaps(&b)
        })
    }

    /// Where no ball holds the value: two precisions, and what is asked for.
    #[test]
    fn exponents_of_any_size() {
        let functions: [Function; 6] = [
            erf_scaled,
            erfc_scaled,
            erfcx_scaled,
            erfi_scaled,
            dawson_scaled,
            w_derivative_scaled,
        ];
        for (i, f) in functions.iter().enumerate() {
            for (x, y) in [
                (1e5, 3.0),
                (2.5, 1e9),
                (-7.0, -1e200),
                (-1e200, 1e-200),
                (1e200, 0.0),
                (0.0, -1e200),
                (1e9, -1e9),
            ] {
                let (x, y) = (q(x), q(y));
                let (a, b) = (f(&x, &y, 60).unwrap(), f(&x, &y, 200).unwrap());
                assert!(overlap(&a, &b), "{i}: {x}, {y}");
                let good = |s: &Scaled| s.ball.is_zero() || s.ball.accuracy_bits() >= 60;
                assert!(a.iter().all(good), "{i}: {x}, {y}");
            }
        }
        // F(iy) = i (√π/2) e^{y²} erf y.
        let [re, im] = dawson_scaled(&Rational::new(), &q(1e10), 60).unwrap();
        assert!(re.ball.is_zero() && im.exponent.significant_bits() == 67);
        // Normal density at 10^12 deviations.
        let v = voigt_scaled(&q(1e12), &q(1.0), &Rational::new(), 60).unwrap();
        assert!(v.to_decimal(10).unwrap().contains("e-217147240951625913"));
    }

    #[test]
    fn the_derivative_is_the_first_taylor_coefficient() {
        for (x, y) in [
            (0.5, 0.25),
            (-3.0, 2.0),
            (1.0, -2.0),
            (20.0, 1e-9),
            (0.0, 3.0),
        ] {
            let (x, y) = (q(x), q(y));
            let c = &taylor(&x, &y, 1, 80).unwrap()[1];
            let [re, im] = w_derivative_scaled(&x, &y, 80)
                .unwrap()
                .map(|s| s.to_ball());
            assert!(c.re.overlaps(&re) && c.im.overlaps(&im), "{x}, {y}");
        }
    }
}
