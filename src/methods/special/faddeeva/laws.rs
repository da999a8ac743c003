//! Identities of the Faddeeva function.

use crate::audit::Law;
use crate::methods::common::held;
use crate::methods::special::identities::{U, batch_agrees, equation, gaussian, point, same_pair};
use crate::solvers::faddeeva::{faddeeva, faddeeva_batch};
use num_complex::Complex;
use std::f64::consts::FRAC_2_SQRT_PI;

type C = Complex<f64>;

fn conjugation(w: impl Fn(C) -> C, input: &[f64]) -> Option<f64> {
    let z = point(input)?;
    held(same_pair(w(-z.conj()), w(z).conj()))
}

fn batch(input: &[f64]) -> Option<f64> {
    batch_agrees(point(input)?, 19, faddeeva, |z, w| {
        faddeeva_batch(z, w).is_ok()
    })
}

fn reflection(input: &[f64]) -> Option<f64> {
    let z = point(input)?;
    if !(z.norm() <= 1e8) {
        return None;
    }
    let (p, m) = (faddeeva(z), faddeeva(-z));
    let size = p.norm() + m.norm();
    if !(size < 1e307) {
        return None;
    }
    let rest = (p - gaussian(z, 2)) + m;
    // 4u of each value, and the rounding of the three terms.
    Some(rest.norm() / (7.0 * U * size.max(f64::MIN_POSITIVE)))
}

/// W falls along the imaginary axis.
fn monotonic(w: impl Fn(C) -> C, y: f64) -> Option<f64> {
    if !y.is_finite() {
        return None;
    }
    let on_axis = |y: f64| w(C::new(0.0, y));
    let next = [y.next_up(), y + y.abs() * 2f64.powi(-40)];
    let here = on_axis(y);
    held(here.im == 0.0 && next.iter().all(|&y| on_axis(y).re <= here.re))
}

/// The laws.
pub(super) fn all() -> Vec<Law> {
    vec![
        Law {
            name: "conjugation",
            statement: "W(-conj z) = conj W(z), bit for bit",
            residual: |input| conjugation(faddeeva, input),
        },
        Law {
            name: "batch",
            statement: "a batch of 1 to 19 points around z gives the scalar values, bit for bit",
            residual: batch,
        },
        Law {
            name: "reflection",
            statement: "W(z) + W(-z) = 2 exp(-z^2) within 7 u (|W(z)| + |W(-z)|), for |z| <= 1e8",
            residual: reflection,
        },
        Law {
            name: "differential-equation",
            statement: "the Taylor series of W' = -2 z W + 2i/sqrt(pi) from W(z) gives W(z + h), \
                        |h| = 1/(8 max(|z|, 1)), within 16 u (|W(z)| + |W(z + h)| + |h|), for \
                        |z| <= 1e6",
            residual: |input| equation(faddeeva, C::new(0.0, FRAC_2_SQRT_PI), point(input)?),
        },
        Law {
            name: "monotonicity",
            statement: "W(iy) is real and does not grow from y to the next number or to \
                        y + 2^-40 |y|",
            residual: |input| monotonic(faddeeva, point(input)?.im),
        },
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// i z is real on the imaginary axis, z is not.
    #[test]
    fn a_conjugate_that_is_lost_breaks_the_law() {
        let input = [0.5, 0.25];
        assert_eq!(conjugation(|z| C::i() * z, &input), Some(0.0));
        assert_eq!(conjugation(|z| z, &input), Some(f64::INFINITY));
        assert_eq!(conjugation(|z| z, &[0.5]), None);
    }

    #[test]
    fn w_may_not_grow_up_the_axis() {
        let broken = |w: &dyn Fn(f64) -> C| monotonic(|z| w(z.im), 3.0);
        let jump = |at: f64, to: f64| move |y: f64| C::from(if y > at { to } else { 1.0 });
        assert_eq!(broken(&|_| C::from(1.0)), Some(0.0));
        assert_eq!(broken(&jump(3.0, 0.5)), Some(0.0));
        // At the next number, and only at the farther one of the two that are looked at.
        assert_eq!(broken(&jump(3.0, 1.5)), Some(f64::INFINITY));
        assert_eq!(broken(&jump(3.0 + 2e-12, 1.5)), Some(f64::INFINITY));
        assert_eq!(broken(&jump(3.0 + 3e-12, 1.5)), Some(0.0));
        assert_eq!(broken(&|_| C::new(1.0, 1e-300)), Some(f64::INFINITY));
    }
}
