//! Where one of the two terms is much larger, each a single number, and where z is scaled.
//!
//! With `U · 2⁻⁵²` the bound of the rounded w(−z), which is that of the upper half-plane, ρ that of
//! the exponential, `x = 2|e^{−z²}|`, `W = |w(−z)|`, and one rounding of the sum, half a unit in
//! the last place of each component:
//!
//! * `Re z² = D > 7`: `(UW + ρx)/(W − x) + ½` with `ρ = ρ₀ + ρ₁D`. Since `D e^{−D}` falls, the
//!   worst is `D = 7`. There `W ≥ 1/(√π r) − B₁`, `B₁ = √(5e/2) T₁ ≤ 0.7355/r³`; this is at least
//!   `0.459/r` for `r² ≥ 7`, and `0.548/r` for `r² ≥ 48`. With 26 terms and `D > 47` the
//!   exponential is left out, below `2e^{−47}`.
//! * `Re z² < −7`, in cells: `(UW + ρx)/(x − W) + ½` with `W ≤ erfcx(Im(−z)) ≤ 1`.
//! * `|z|² ≥ 10²⁰⁰`: for `|Re z| > |Im z|` the exponential is nothing, `Re z²` being at least an
//!   `f64` spacing times `|z|`; for `|Re z| < |Im z|` it overflows; on the diagonals the code has
//!   the leading parts of 2 cos and 2 sin, and leaves w(−z) out, below 10⁻¹⁰⁰.

use super::exponential::Exponential;
use crate::ProofError;
use crate::bounds::exp_up;
use crate::certificate::Watch;
use crate::code::Code;
use crate::cover::Rectangle;
use crate::formula::{Formula, TWO_52};
use crate::interval::{self, down, larger, quotient_up, up};
use crate::prove::{self, Certificate, Target};
use mechaudit_solvers::faddeeva::proof::lower::Limits;

/// Bounds of the norm, in units of 2⁻⁵².
#[derive(Clone, Copy, Debug)]
pub struct Dominated {
    /// w(−z) from a cell, and `2e^{−z²}`, smaller.
    pub image_in_cell: f64,
    /// w(−z) by 26 terms, and `2e^{−z²}`, smaller or left out.
    pub image_by_series: f64,
    /// `2e^{−z²}`, and w(−z) from a cell.
    pub exponential: f64,
    /// `|z|² ≥ 10²⁰⁰`.
    pub huge: f64,
    /// Rectangles of the upper half-plane behind them.
    pub boxes: usize,
}

const ROUNDED: Target = Target {
    norm: 1.25,
    component: f64::INFINITY,
    depth: 48,
};

impl Dominated {
    /// From the proof of the upper half-plane; `None` if it was stopped.
    ///
    /// # Errors
    /// If a rectangle of it is open.
    pub fn of(
        code: &Code,
        e: &Exponential,
        limits: &Limits,
        watch: &Watch,
    ) -> Result<Option<Dominated>, ProofError> {
        let Some(found) = prove::upper_half_plane(code, ROUNDED, watch, |_, r| is_behind(r)) else {
            return Ok(None);
        };
        Dominated::together(&found, e, limits).map(Some)
    }

    fn together(
        found: &Certificate,
        e: &Exponential,
        limits: &Limits,
    ) -> Result<Dominated, ProofError> {
        if let Some(open) = found.open.first() {
            return Err(ProofError::Fails(format!(
                "{:?} is open: {}",
                open.at, open.why
            )));
        }
        let worst = |of: fn(Formula) -> bool| {
            let some = found.leaves.iter().filter(|l| of(l.formula));
            interval::worst(some.map(|l| l.bound.norm))
        };
        let cell = worst(|f| matches!(f, Formula::Cell { .. }));
        let series = worst(|f| matches!(f, Formula::Asymptotic { terms: 26 }));
        let huge = worst(|f| f == Formula::Huge);
        Ok(Dominated {
            image_in_cell: image(cell, e, limits, 0.459 / 6.93),
            image_by_series: image(series, e, limits, 0.548 / 10.6),
            exponential: exponential(cell, e, limits),
            huge: larger(huge, e.leading * TWO_52 + 1e-9),
            boxes: found.leaves.len(),
        })
    }
}

/// Returns whether a rectangle of the upper half-plane may be behind one of the bounds: the shells
/// of the cells and of 26 terms, and one of those that are scaled.
fn is_behind(r: &Rectangle) -> bool {
    let most = r.a[1].max(r.b[1]);
    (0.5..16.0).contains(&most) || (1e101..2e101).contains(&most)
}

/// `(UW + ρx)/(W − x) + ½` at the limit, from a lower bound of W.
fn image(u: f64, e: &Exponential, limits: &Limits, w: f64) -> f64 {
    let d = down(limits.dominant - 1e-12);
    let q = quotient_up(up(2.0 * exp_up(-d)), down(w));
    let rho = up(e.short[0] + up(e.short[1] * d)) * TWO_52;
    // The part that is left out beyond the second limit.
    let left_out = quotient_up(up(2.0 * exp_up(-limits.negligible)), down(w)) * TWO_52;
    // The worst is at the limit from D = 1 on.
    match d > 1.0 && q < 1.0 {
        true => {
            let at_limit =
                up(quotient_up(up(u + up(rho * q)), down(1.0 - q)) * (1.0 + 1e-12) + 0.5);
            larger(at_limit, u + left_out)
        }
        false => f64::INFINITY,
    }
}

/// `(UW + ρx)/(x − W) + ½` at the limit.
fn exponential(u: f64, e: &Exponential, limits: &Limits) -> f64 {
    let x = down(2.0 / exp_up(-down(limits.dominant - 1e-12)));
    let rho = e.rounded * TWO_52;
    up(quotient_up(up(u + up(rho * x)), down(x - 1.0)) * (1.0 + 1e-12) + 0.5)
}

#[cfg(test)]
mod tests;
