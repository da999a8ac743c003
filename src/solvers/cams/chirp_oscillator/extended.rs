//! Divided differences over roots, in double-double: where `f64` does not tell the roots apart, and
//! where what follows from the differences cancels.

use super::complex_double_double::Cd;
use super::roots::Roots;
use super::sweep::Sweep;
use crate::double_double::Dd;
use crate::faddeeva::{HALF_SQRT_PI, w_extended};
use num_complex::Complex;

/// A gap below this part of the scale of `F` is replaced by the derivative: what that neglects is
/// (gap/scale)² of it.
const DERIVATIVE: f64 = 1e-9;

/// `F`, `R` at `p = −η + iX`.
fn single(sweep: &Sweep, eta: Dd, x: Dd, beyond: bool) -> (Cd, Cd) {
    let half = Dd::from(0.5).div(sweep.root_kappa);
    let (mut re, mut im) = ((x + eta) * half, (eta - x) * half);
    if beyond {
        (re, im) = (-re, -im);
    }
    let (u, v) = w_extended(re, im);
    let c = HALF_SQRT_PI.div(sweep.root_kappa);
    let c = if beyond { -c } else { c };
    let f = Cd(c, -c) * Cd(u, v);
    (f, (Cd(-eta, x) * f).plus_one())
}

/// `F[·]`, `R[·]`, `(λR)[·]`; `|z|²` is below 50.
#[cold]
#[inline(never)]
pub(super) fn differences(sweep: &Sweep, roots: &Roots, omega: Dd) -> [Complex<f64>; 3] {
    unrounded(sweep, roots, omega).map(Cd::value)
}

/// The same, unrounded.
pub(super) fn unrounded(sweep: &Sweep, roots: &Roots, omega: Dd) -> [Cd; 3] {
    let scale = omega.hi.abs().max(roots.w).max(sweep.root_kappa.hi);
    let half = roots.half;
    let n = Dd::from(roots.n);
    if half.hi < 0.5 * DERIVATIVE * scale {
        let lambda = Cd(-n, Dd::ZERO);
        let (f, r) = single(sweep, n, omega, omega.value() > roots.n);
        // dF/dλ = −iR/κ, dR/dλ = F + p dF/dλ
        let by_kappa = Dd::from(1.0).div(sweep.kappa);
        let df = r.turned().scaled(by_kappa);
        let dr = f + Cd(-n, omega) * df;
        return [df, dr, r + lambda * dr];
    }
    let each = [0, 1].map(|i| {
        let beyond = sweep.beyond(roots, i, omega);
        single(sweep, roots.eta[i], omega + roots.beta[i], beyond)
    });
    let [(f, r), (g, s)] = each;
    let lambda = [0, 1].map(|i| Cd(-roots.eta[i], roots.beta[i]));
    let inverse = Dd::from(0.5).div(half);
    let over_gap = |x: Cd| {
        let x = x.scaled(inverse);
        if roots.over { x } else { x.turned() }
    };
    [f - g, r - s, lambda[0] * r - lambda[1] * s].map(over_gap)
}
