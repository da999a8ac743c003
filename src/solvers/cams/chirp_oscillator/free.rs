//! Free vibration.

use super::phase::{circle, decay};
use super::roots::Roots;
use crate::double_double::two_prod;
use num_complex::Complex;

/// The impulse response `K` (`K(0) = 0`, `K′(0) = 1`) with two derivatives, and the response
/// `K₀ = K′ + 2nK` to a unit displacement, at one time.
#[derive(Clone, Copy, Debug)]
pub(super) struct Free {
    pub k: f64,
    pub k1: f64,
    pub k2: f64,
    pub k0: f64,
}

impl Free {
    #[inline(always)]
    pub fn at(roots: &Roots, t: f64) -> Free {
        let Roots { w, n, .. } = *roots;
        if roots.over {
            // Slow and fast exponential; K by expm1, the others from it without differences of
            // equals.
            let (slow, fast) = (roots.lambda[0].re, roots.lambda[1].re);
            let (a, b) = (decay(roots.eta[0].mul_f(t)), decay(roots.eta[1].mul_f(t)));
            let wide = roots.gap.re;
            let k = a * (-(-wide * t).exp_m1() / wide);
            let k1 = slow.mul_add(k, b);
            return Free {
                k,
                k1,
                k2: slow.mul_add(k1, fast * b),
                k0: (-fast).mul_add(k, b),
            };
        }
        let w3 = roots.half;
        let turn = circle(w3.mul_f(t));
        let s = match w3.hi == 0.0 {
            true => t,
            false => turn.im / w3.value(),
        };
        let e = decay(two_prod(n, t));
        let c = turn.re;
        Free {
            k: e * s,
            k1: e * (-n).mul_add(s, c),
            // 2n² − w² = n² − w3²
            k2: e * (-2.0 * n).mul_add(c, (2.0 * n * n - w * w) * s),
            k0: e * n.mul_add(s, c),
        }
    }

    /// A bound on |y| from the state `(a, b)`. Below critical damping
    /// `y = e^{−nt} (a cos w₃t + (b + na) sin(w₃t)/w₃)`, and the sine is below its argument; above,
    /// K and K₀ are positive.
    pub fn bound(&self, roots: &Roots, a: f64, b: f64, t: f64) -> f64 {
        if roots.over {
            return a.abs().mul_add(self.k0, b.abs() * self.k);
        }
        let rate = roots.n.mul_add(a, b);
        let turning = a.hypot(rate / roots.half.value());
        // Next to critical damping the quotient is large, or 0/0.
        let straight = rate.abs().mul_add(t, a.abs());
        decay(two_prod(roots.n, t)) * straight.min(turning)
    }

    /// `y, y′, y″` from the state `(a, b)` at `t = 0`.
    #[inline(always)]
    pub fn motion(&self, w: f64, a: Complex<f64>, b: Complex<f64>) -> [Complex<f64>; 3] {
        let ww = w * w;
        [
            a * self.k0 + b * self.k,
            b * self.k1 - a * (ww * self.k),
            b * self.k2 - a * (ww * self.k1),
        ]
    }
}
