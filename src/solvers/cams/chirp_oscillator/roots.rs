//! The roots `λ± = −n ± √(n² − w²)` of the oscillator.

use super::phase::sqrt;
use crate::double_double::{Dd, two_prod, two_sum};
use num_complex::Complex;

/// Both roots, `+` first.
#[derive(Clone, Debug)]
pub(super) struct Roots {
    pub w: f64,
    pub n: f64,
    /// `n > w`.
    pub over: bool,
    /// `√|n² − w²|`.
    pub half: Dd,
    /// `−Re λ`.
    pub eta: [Dd; 2],
    /// `Im λ`.
    pub beta: [Dd; 2],
    pub lambda: [Complex<f64>; 2],
    /// `λ₊ − λ₋`, never by subtraction.
    pub gap: Complex<f64>,
}

impl Roots {
    pub fn new(w: f64, n: f64) -> Roots {
        let over = n > w;
        let square = two_sum(n, -w) * two_sum(n, w);
        let half = sqrt(if over { square } else { -square });
        let (eta, beta) = if over {
            let fast = half.add_f(n);
            ([two_prod(w, w).div(fast), fast], [Dd::ZERO; 2])
        } else {
            ([Dd::from(n); 2], [half, -half])
        };
        let lambda = [0, 1].map(|i| Complex::new(-eta[i].value(), beta[i].value()));
        let wide = 2.0 * half.value();
        let gap = match over {
            true => Complex::new(wide, 0.0),
            false => Complex::new(0.0, wide),
        };
        Roots {
            w,
            n,
            over,
            half,
            eta,
            beta,
            lambda,
            gap,
        }
    }

    /// `λ_i + iω`, each component rounded once.
    #[inline(always)]
    pub fn p(&self, i: usize, omega: Dd) -> Complex<f64> {
        Complex::new(self.lambda[i].re, (omega + self.beta[i]).value())
    }
}
