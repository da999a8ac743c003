//! Certified Faddeeva function `w(z) = e^{−z²} erfc(−iz)` and its relatives.
//!
//! Every result is a ball with a proven radius. [`w`] certifies each component to the relative
//! accuracy asked for, beside the axes and beside the zeros too; a component that is zero comes
//! out as exactly zero (Im w on the imaginary axis). Two evaluations cover the plane:
//!
//! * Kummer's series of Dawson's function with guard bits (`kummer.rs`), and
//! * the asymptotic series with a remainder bound on the closed quadrant and bounds for the
//!   components beside the axes (`asymptotic.rs`), wherever it reaches the precision.
//!
//! Both are derived at the head of their files. A loop raises the working precision until both
//! components are decided (Ziv, *ACM TOMS* 17, 1991, 410). Up to about 100 bits a third one, Taylor
//! series in 128-bit fixed point (`fast.rs`), is asked first; it declines what it cannot prove.
//! [`trapezoidal`] is a witness by an independent formula.
//!
//! # Errors
//! [`Undecided`] when the precision reaches its cap, `4 (bits + length of the input) + 4096` bits:
//! a component then is zero or indistinguishable from zero; or when the value leaves MPFR's
//! exponents (about 2^±(2^29) here), in which case [`w_scaled`] still has it.

mod argument;
mod asymptotic;
mod choice;
mod derivatives;
mod fast;
mod fixed;
mod gaussian;
mod general;
mod kummer;
mod recurrence;
mod related;
mod scaled;
pub mod trapezoidal;
mod voigt_hwhm;
mod zeros;
mod ziv;

use crate::{Ball, ComplexBall, Mag, Undecided};
use argument::Real;
use choice::{once, scaled, value};
use rug::{Float, Rational};
use std::f64::consts::FRAC_2_SQRT_PI;

pub use derivatives::{taylor, w_derivative, w_derivative_scaled};
pub(crate) use related::Relative;
pub use related::{
    dawson, dawson_scaled, erf, erf_scaled, erfc, erfc_scaled, erfcx, erfcx_scaled, erfi,
    erfi_scaled, voigt, voigt_scaled,
};
pub use scaled::Scaled;
pub use voigt_hwhm::voigt_hwhm;
pub use zeros::{zero, zero_of_erf};

/// w(z) for z = re + i im, each component with a relative radius of at most 2^-bits.
///
/// ```
/// use mechaudit_reference::faddeeva;
/// use rug::Rational;
/// // On the imaginary axis w is erfcx, and real.
/// let w = faddeeva::w(&Rational::new(), &Rational::from(1), 120)?;
/// assert_eq!(w.re.to_decimal(30).unwrap(), "0.427583576155807004410750344491");
/// assert!(w.im.is_zero());
/// # Ok::<(), mechaudit_reference::Undecided>(())
/// ```
///
/// # Errors
/// See the [module](self).
pub fn w(re: &Rational, im: &Rational, bits: u32) -> Result<ComplexBall, Undecided> {
    value(Real::of(re), Real::of(im), bits)
}

/// [`w`] at an exact pair of doubles. NaN and infinities are refused. Up to about 100 bits this
/// takes a microsecond or a few almost everywhere (`fast.rs`; its tables are made on first use).
///
/// # Errors
/// See the [module](self).
pub fn w_f64(re: f64, im: f64, bits: u32) -> Result<ComplexBall, Undecided> {
    if !(re.is_finite() && im.is_finite()) {
        return Err(Undecided::new(
            bits,
            format!("w at the argument ({re}, {im}), which is not finite"),
        ));
    }
    value(Real::Double(re), Real::Double(im), bits)
}

/// [`w`] at an exact pair of floats.
///
/// # Errors
/// See the [module](self). A NaN or an infinity is refused.
pub fn w_float(re: &Float, im: &Float, bits: u32) -> Result<ComplexBall, Undecided> {
    if !(re.is_finite() && im.is_finite()) {
        return Err(Undecided::new(
            bits,
            format!("w at the argument ({re}, {im}), which is not finite"),
        ));
    }
    value(Real::Float(re.clone()), Real::Float(im.clone()), bits)
}

/// [`w`] with exponents of any size: real and imaginary part.
///
/// # Errors
/// As [`w`], but not for the size of the result.
pub fn w_scaled(re: &Rational, im: &Rational, bits: u32) -> Result<[Scaled; 2], Undecided> {
    scaled(Real::of(re), Real::of(im), bits)
}

/// An enclosure of w over a ball, at a working precision of `prec` bits; nothing is promised about
/// its radius.
///
/// With the midpoint m and all points within ρ of it, `|w(z) − w(m)| ≤ ρ sup |w'|`. From
/// `w(z) = (2/√π) ∫_0^∞ e^{−t²+2izt} dt` (complete the square in DLMF 7.2.2; all z) follows
/// `w'(z) = (4i/√π) ∫_0^∞ t e^{−t² + 2izt} dt`, hence `|w'| ≤ 2/√π` for Im z ≥ 0, and
/// `|w'| ≤ 2/√π + 4h e^{h²}` for Im z ≥ −h, because
/// `∫_0^∞ 2t e^{−t²+2ht} dt = 1 + √π h e^{h²} erfc(−h)`. For |z| ≥ 1 and Im z ≥ 0 also
/// `|w'| ≤ (1/√π + 3.07/|z|²)/|z|²`: one term of the asymptotic series and `D_1` (`asymptotic.rs`:
/// `|z R_1'| ≤ √e(√2.5 + 5) Γ(3/2)/(π|z|³) ≤ 3.07/|z|³`). And for small ρ anywhere: w' = −2zw +
/// 2i/√π gives, with Z = sup |z| and Grönwall's lemma along a radius,
/// `|w| ≤ e^{2Zρ} (|w(m)| + 2ρ/√π)`, and with it a bound on |w'|.
pub fn w_ball(z: &ComplexBall, prec: u32) -> ComplexBall {
    let whole = || {
        let line = Ball::new(Float::new(prec), Mag::INFINITY);
        ComplexBall::new(line.clone(), line)
    };
    if !z.is_finite() {
        return whole();
    }
    let (x, y) = (z.re.mid(), z.im.mid());
    let (x, y) = (Real::Float(x.clone()), Real::Float(y.clone()));
    let Some(parts) = once(x, y, prec.max(16)) else {
        return whole();
    };
    let [re, im] = parts.map(|part| part.to_ball_or_tiny());
    let at_mid = ComplexBall::new(re, im);
    let rho = z.radius();
    if rho.is_zero() {
        return at_mid;
    }
    let slope = slope(z, rho, at_mid.magnitude());
    at_mid.widened(rho.mul(slope))
}

/// An upper bound on |w'| over the ball; `rho` its radius, `size` a bound on |w| at its midpoint.
pub(crate) fn slope(z: &ComplexBall, rho: Mag, size: Mag) -> Mag {
    let low = z.im.lower();
    let flat = Mag::from_f64(FRAC_2_SQRT_PI.next_up());
    if low < 0 {
        let t = z.magnitude().mul(rho).shift(1);
        if t <= Mag::from_f64(1.0) {
            // e^t ≤ 1 + 2t.
            let grown = Mag::from_f64(1.0).add(t.shift(1));
            let w = grown.mul(size.add(flat.mul(rho)));
            return z.magnitude().shift(1).mul(w).add(flat);
        }
        let h = Ball::new(low, Mag::ZERO);
        let grown = h.square().exp().magnitude();
        return flat.add(h.magnitude().mul(grown).shift(2));
    }
    let r = z.mignitude();
    let one = Mag::from_f64(1.0);
    if r < one {
        return flat;
    }
    let inverse = one.div(r).mul(one.div(r));
    let bound = inverse.mul(Mag::from_f64(0.5642).add(Mag::from_f64(3.07).mul(inverse)));
    if bound < flat { bound } else { flat }
}

#[cfg(test)]
mod ball_tests;
#[cfg(test)]
mod related_tests;
#[cfg(test)]
mod tests;
