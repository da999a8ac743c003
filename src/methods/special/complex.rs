//! The parts of the audits of functions of a complex argument: input, expected values, the bound of
//! the norm.

use crate::audit::{Expected, Proof};
use crate::methods::inputs::inputs;
use crate::reference::faddeeva::Scaled;
use crate::reference::{Ball, Mag};
use num_complex::Complex;
use rug::Float;

pub(super) type C = Complex<f64>;

inputs! {
    /// A complex argument.
    pub struct ComplexInput {
        re: number "Re z", "1";
        im: number "Im z", "1";
    }
}

impl From<ComplexInput<'_>> for Complex<f64> {
    fn from(z: ComplexInput<'_>) -> Complex<f64> {
        Complex::new(z.re, z.im)
    }
}

/// The reference is asked for this number of bits less than the working precision: each component
/// comes out with the accuracy asked for, and 80 bits settle every budget here.
const SPARED: u32 = 48;

/// The bits the reference is asked for at a working precision.
pub(super) fn asked(bits: u32) -> u32 {
    bits.saturating_sub(SPARED).max(64)
}

/// Returns a component as the reference expects it. What no ball holds is beyond every `f64` or
/// below all of them.
pub(super) fn expected_part(part: &Scaled) -> Expected {
    let direct = part.to_ball();
    if direct.is_finite() {
        return Expected::Number(direct);
    }
    if !part.ball.is_finite() || part.ball.contains_zero() {
        return Expected::Number(part.ball.widened(Mag::INFINITY));
    }
    // The factor is within 2^±(2^29), the exponent beyond that of a ball.
    match part.exponent < 0 {
        true => Expected::Number(Ball::new(Float::new(64), Mag::power_of_two(-5000))),
        false => Expected::Infinity {
            negative: part.ball.is_negative(),
        },
    }
}

/// An exact small number.
pub(super) fn number(n: i64) -> Expected {
    Expected::Number(Ball::integer(64, n))
}

/// The infinity of the sign of `x`.
pub(super) fn infinity(x: f64) -> Expected {
    Expected::Infinity {
        negative: x.is_sign_negative(),
    }
}

/// e^z, roughly and alike on every machine.
pub(super) fn exponential(z: C) -> C {
    libm::exp(z.re) * C::new(libm::cos(z.im), libm::sin(z.im))
}

/// The allowed error of the norm, in units of 2⁻⁵³, and the reason for it: as for W itself.
pub(super) const NORM: (f64, &str) = (
    4.0,
    "2 eps: half a unit of rounding in each component is 1 u of the norm at most, 3 u more for what \
     happens before",
);
/// The proof of the references.
pub(super) const PROOF: Proof = Proof::Bounded(
    "Taylor, Kummer and asymptotic series with remainder bounds (reference::faddeeva)",
);
