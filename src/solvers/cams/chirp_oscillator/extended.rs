//! Divided differences over roots, in double-double: where `f64` does not tell the roots apart, and
//! where what follows from the differences cancels.

use super::complex_double_double::Cd;
use super::roots::Roots;
use super::sweep::Sweep;
use crate::double_double::Dd;
use crate::faddeeva::w_extended;
use crate::hex::hex;
use num_complex::Complex;

/// A gap below this part of the scale of `F` is replaced by the derivative: what that neglects is
/// (gap/scale)² of it.
const DERIVATIVE: f64 = 1e-9;

/// √π/2.
const HALF_SQRT_PI: Dd = Dd::new(hex("0x1.c5bf891b4ef6bp-1"), hex("-0x1.618f13eb7ca89p-55"));

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

#[cfg(test)]
mod tests {
    use super::super::phase::sqrt;
    use crate::double_double::Dd;

    #[test]
    fn the_constant() {
        let square = super::HALF_SQRT_PI.square();
        let quarter = std::f64::consts::FRAC_PI_4;
        assert_eq!(square.hi, quarter);
        // The low part of π/4.
        assert!((square.lo - 3.061_616_997_868_383e-17).abs() < 1e-31);
        let two = sqrt(Dd::from(2.0)).square();
        assert!((two.hi - 2.0 + two.lo).abs() < 1e-31);
        let more = sqrt(Dd::new(2.0, 1e-16)).square();
        assert!((more.hi - 2.0 + (more.lo - 1e-16)).abs() < 1e-31);
    }
}
