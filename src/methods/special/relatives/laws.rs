//! Identities of several relatives of the Faddeeva function, and the parts of their laws.

use super::relative::Relative;
use crate::audit::Law;
use crate::methods::common::held;
use crate::methods::special::complex::C;
use crate::methods::special::identities::{point, same, same_pair};
use num_complex::Complex;

/// `f(−z) = −f(z)`, `f(z̄) = conj f(z)`, bit for bit.
fn odd(f: impl Fn(C) -> C, input: &[f64]) -> Option<f64> {
    let z = point(input)?;
    let value = f(z);
    held(same_pair(f(-z), -value) && same_pair(f(z.conj()), value.conj()))
}

/// `f(z̄) = conj f(z)`, bit for bit.
fn conjugation(f: impl Fn(C) -> C, input: &[f64]) -> Option<f64> {
    let z = point(input)?;
    held(same_pair(f(z.conj()), f(z).conj()))
}

pub(super) fn odd_law<F: Relative>() -> Law {
    Law {
        name: "symmetry",
        statement: "f(-z) = -f(z) and f(conj z) = conj f(z), bit for bit",
        residual: |input| odd(F::VALUE, input),
    }
}

pub(super) fn conjugation_law<F: Relative>() -> Law {
    Law {
        name: "conjugation",
        statement: "f(conj z) = conj f(z), bit for bit",
        residual: |input| conjugation(F::VALUE, input),
    }
}

/// The law of [`on_the_axis`].
pub(super) fn real_argument_law(residual: fn(&[f64]) -> Option<f64>) -> Law {
    Law {
        name: "real-argument",
        statement: "the function of a real argument agrees at Re z within 5 ulp",
        residual,
    }
}

/// Returns the distance of the function of a real argument from the complex one on the real axis,
/// as a share of five units in the last place: four for the complex one and one for the real one,
/// whose error is proved to be less than 7/8 of a unit (for erfi this is the worst found).
pub(super) fn on_the_axis(
    complex: impl Fn(C) -> C,
    real: impl Fn(f64) -> f64,
    input: &[f64],
) -> Option<f64> {
    let x = point(input)?.re;
    let (a, b) = (complex(Complex::new(x, 0.0)), real(x));
    if !a.re.is_finite() || !b.is_finite() {
        return held(same(a.re, b));
    }
    let ulp = (a.re.abs() * f64::EPSILON).max(f64::from_bits(1));
    held(a.im == 0.0).map(|r| r.max((a.re - b).abs() / (5.0 * ulp)))
}

/// Returns whether products and sums of such values neither overflow nor lose digits to underflow.
pub(super) fn plain(values: &[C]) -> bool {
    values.iter().all(|v| (1e-290..1e290).contains(&v.norm()))
}

#[cfg(test)]
mod tests;
