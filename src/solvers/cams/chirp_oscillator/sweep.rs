//! One harmonic's frequency `ω = ν + κt` and the particular solution that has no memory of `t = 0`.
//!
//! For a root λ let `p = λ + iω` and
//!
//! ```text
//! F = C w(z)       where ω + Im λ ≤ −Re λ,     C = (1 − i)√π/(2√κ),
//! F = −C w(−z)     beyond,                     z = (1 − i)(ω − iλ)/(2√κ),
//! ```
//!
//! so that w is only needed in the upper half-plane. `φ = e^{−iθ}F` solves `φ′ = λφ + e^{−iθ}`,
//! hence `κ dF/dω = R = 1 + pF = −i(√π/2) w′(±z)`, and
//!
//! ```text
//! φ′ = e^{−iθ} V,   V = −iωF + R,         φ″ = e^{−iθ} (−iωV + λR).
//! ```
//!
//! The oscillator's particular solution is `w²` times the divided difference of φ over both roots.
//! Far from both resonances, `|z|² ≥ 49`, it follows from
//!
//! ```text
//! F ~ −Σ g_m/p^{2m+1},   R ~ −Σ_{m≥1} g_m/p^{2m},   g_m = (2m − 1)!! (−iκ)^m
//! ```
//!
//! (DLMF 7.12.1) without a difference: with `a = 1/p₊`, `b = 1/p₋`, `q = ab` and
//! `h_j = Σ a^i b^{j−i}`, which satisfy `h_j = (a + b) h_{j−1} − q h_{j−2}`,
//!
//! ```text
//! F[λ₊, λ₋] = q Σ g_m h_{2m},  R[·] = q Σ_{m≥1} g_m h_{2m−1},
//! (λR)[·] = q Σ_{m≥1} g_m (h_{2m−2} − iω h_{2m−1}).
//! ```

use super::inlined::two;
use super::phase::{circle, sqrt};
use super::roots::Roots;
use super::series::{self, FAR, Z, terms};
use super::types::Chirp;
use crate::double_double::{Dd, two_prod};
use crate::exponential::LARGE_PHASE;
use crate::faddeeva::{HALF_SQRT_PI, faddeeva, w_derivative};
use crate::real::Real;
use num_complex::Complex;

type C = Complex<f64>;
const I: C = C::I;

/// Roots closer together than this part of the scale of `F` are not told apart in `f64`.
const APART: f64 = 0.5;
/// Roots closer together than this part of `w`, or than √κ, pass their resonances together.
const CLOSE: f64 = 0.5;

/// `φ`, `φ′`, `φ″` without `e^{−iθ}`.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Amplitudes {
    pub y: C,
    pub v: C,
    pub a: C,
}

impl Amplitudes {
    /// From `F`, `R` and `λR` or their divided differences.
    #[inline(always)]
    pub fn new(omega: f64, f: C, r: C, lr: C) -> Amplitudes {
        let turn = |x: C| C::new(omega * x.im, -omega * x.re);
        let v = turn(f) + r;
        Amplitudes {
            y: f,
            v,
            a: turn(v) + lr,
        }
    }
}

/// `θ = νt + κt²/2 + δ` with `κ ≥ 0`.
#[derive(Clone, Debug)]
pub(super) struct Sweep {
    pub nu: Dd,
    pub kappa: Dd,
    pub root_kappa: Dd,
    pub delta: f64,
    /// Tells whether the roots are so close together that their resonances are passed as one.
    pub joint: bool,
}

impl Sweep {
    /// `k (Ω₀ t + ε t²/2) + δ`, for `kε ≥ 0`.
    pub fn new(roots: &Roots, k: f64, chirp: &Chirp, delta: f64) -> Sweep {
        let kappa = two_prod(k, chirp.eps);
        let root_kappa = sqrt(kappa);
        Sweep {
            nu: two_prod(k, chirp.omega0),
            kappa,
            root_kappa,
            delta,
            joint: roots.gap.norm() <= (CLOSE * roots.w).max(root_kappa.hi),
        }
    }

    #[inline(always)]
    pub fn omega(&self, t: f64) -> Dd {
        self.nu + self.kappa.mul_f(t)
    }

    /// `θ − δ`
    #[inline(always)]
    pub fn turned(&self, t: f64) -> Dd {
        (self.nu + self.kappa.mul_f(0.5 * t)).mul_f(t)
    }

    /// θ
    #[inline(always)]
    pub fn phase(&self, t: f64) -> Dd {
        self.turned(t).add_f(self.delta)
    }

    /// Returns whether all phases up to `t` are so small that they are reduced without Payne &
    /// Hanek.
    pub fn phases_are_small(&self, t: f64) -> bool {
        (self.nu.hi.abs() + self.kappa.hi * t) * t + self.delta.abs() < LARGE_PHASE
    }

    /// `e^{−iθ}`
    #[inline(always)]
    pub fn carrier(&self, t: f64) -> C {
        circle(self.phase(t)).conj()
    }

    /// `|z|²` for `p`.
    #[inline(always)]
    pub fn distance(&self, p: C) -> f64 {
        match self.kappa.hi == 0.0 {
            true => f64::INFINITY,
            false => p.norm_sqr() / (2.0 * self.kappa.hi),
        }
    }

    /// Returns whether root number i has its resonance behind it at ω.
    #[inline(always)]
    pub fn beyond(&self, roots: &Roots, i: usize, omega: Dd) -> bool {
        match self.joint {
            true => omega.value() > roots.n,
            false => (omega + roots.beta[i]).value() > roots.eta[i].value(),
        }
    }

    /// Decides whether the values of `F` for both roots are told apart in `f64`.
    #[inline(always)]
    pub fn apart(&self, roots: &Roots, p: [C; 2]) -> bool {
        let [a, b] = two(
            #[inline(always)]
            |i| p[i].norm_sqr().max(self.kappa.hi),
        );
        roots.gap.norm_sqr() >= APART * APART * a.min(b)
    }

    /// Returns whether the values of `F` for both roots by their series are told apart, from the
    /// nearer `|p|²`: where the roots are farther apart than that.
    #[inline(always)]
    pub fn apart_far<R: Real>(&self, roots: &Roots, nearer: R) -> R::Mask {
        nearer.below(nearer.like(roots.gap.norm_sqr()))
    }

    /// `F[·]` by its series, from `p` and the least `|z|²`.
    #[inline(always)]
    pub fn far_displacement(&self, roots: &Roots, p: [C; 2], distance: f64) -> C {
        let nearer = p[0].norm_sqr().min(p[1].norm_sqr());
        let (p, kappa, terms) = (p.map(Z::from), self.kappa.hi, terms(distance));
        match self.apart_far(roots, nearer) {
            true => series::of_both_apart(p, roots, kappa, terms).into(),
            false => series::of_both(p, kappa, terms).into(),
        }
    }

    /// `F` by its series, where that serves.
    #[inline(always)]
    pub fn far_single(&self, p: C) -> Option<C> {
        let distance = self.distance(p);
        (distance >= FAR).then(|| {
            series::of_one(p.into(), self.kappa.hi, terms(distance))
                .0
                .into()
        })
    }

    /// `F` and `R` for one root.
    #[inline(always)]
    pub fn single(&self, roots: &Roots, i: usize, omega: Dd) -> (C, C) {
        let p = roots.p(i, omega);
        let distance = self.distance(p);
        if distance >= FAR {
            let (f, r) = series::of_one(p.into(), self.kappa.hi, terms(distance));
            return (f.into(), r.into());
        }
        let z = self.z(p);
        let beyond = self.beyond(roots, i, omega);
        let z = if beyond { -z } else { z };
        if distance >= 1.0 {
            let r = -I * HALF_SQRT_PI.hi * w_derivative(z);
            ((r - 1.0) / p, r)
        } else {
            let f = self.factor() * faddeeva(z);
            let f = if beyond { -f } else { f };
            (f, 1.0 + p * f)
        }
    }

    /// `(1 − i)(ω + Im λ − i Re λ)/(2√κ)`, from `p`.
    #[inline(always)]
    pub fn z(&self, p: C) -> C {
        let by = 0.5 / self.root_kappa.hi;
        C::new((p.im - p.re) * by, (-p.re - p.im) * by)
    }

    /// `C`
    #[inline(always)]
    pub fn factor(&self) -> C {
        let c = HALF_SQRT_PI.hi / self.root_kappa.hi;
        C::new(c, -c)
    }
}

#[cfg(test)]
mod tests;
