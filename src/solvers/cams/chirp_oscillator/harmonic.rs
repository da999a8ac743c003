//! The response to one harmonic from rest.

use super::direct;
use super::free::Free;
use super::inlined::{three, two};
use super::passage::{left_behind, passage, passage_of_one};
use super::phase::{circle, decay};
use super::return_to_rest;
use super::roots::Roots;
use super::sweep::{Amplitudes, Sweep};
use super::types::{Chirp, Harmonic};
use crate::double_double::Dd;
use num_complex::Complex;

type C = Complex<f64>;

/// The particular solution and the free vibration cancel where `|p| t` is below this.
pub(super) const SHORT: f64 = 4.0;
/// The quadrature with both roots is used up to here where one of them needs it.
const LONG: f64 = 16.0;

/// A harmonic made ready.
#[derive(Clone, Debug)]
pub(super) struct Prepared {
    pub sweep: Sweep,
    /// `w² D`
    pub scale: f64,
    /// Tells whether k was negated to have `κ ≥ 0`: amplitudes are conjugated then.
    pub mirrored: bool,
    /// `−ψ(0), −ψ′(0)` of the particular solution, per `w²`, and the same without `e^{−iδ}`.
    pub start: [C; 2],
    pub start_amplitudes: [C; 2],
    /// Holds what passages add to that, where they are constants.
    pub left: Option<[[C; 2]; 2]>,
    /// `|p|²` at `t = 0` for both roots.
    pub norms: [f64; 2],
}

/// How the response is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Way {
    /// Particular solution, free vibration, passages.
    Closed,
    /// Quadrature.
    Direct,
    /// Quadrature for the root of this number, the closed form for the other.
    Mixed(usize),
}

impl Prepared {
    pub fn new(roots: &Roots, chirp: &Chirp, harmonic: &Harmonic, scale: f64) -> Prepared {
        let mirrored = harmonic.k * chirp.eps < 0.0;
        let (k, delta) = match mirrored {
            true => (-harmonic.k, -harmonic.phase),
            false => (harmonic.k, harmonic.phase),
        };
        let sweep = Sweep::new(roots, k, chirp, delta);
        let norms = two(|i| roots.p(i, sweep.nu).norm_sqr());
        let carrier = sweep.carrier(0.0);
        let Amplitudes { y, v, .. } = sweep.particular(roots, sweep.nu);
        Prepared {
            left: left_behind(&sweep, roots),
            sweep,
            scale,
            mirrored,
            start: [-carrier * y, -carrier * v],
            start_amplitudes: [-y, -v],
            norms,
        }
    }

    /// Decides whether the closed form serves at time t, where `|p|²` has these values.
    #[inline(always)]
    pub fn is_closed(&self, norms: [f64; 2], t: f64) -> bool {
        let limit = SHORT * SHORT;
        let long = |i: usize| self.norms[i].max(norms[i]) * t * t > limit;
        long(0) & long(1)
    }

    #[inline(always)]
    fn way(&self, roots: &Roots, t: f64, omega: Dd) -> Way {
        let norms = two(
            #[inline(always)]
            |i| roots.p(i, omega).norm_sqr(),
        );
        if self.is_closed(norms, t) {
            return Way::Closed;
        }
        let phase = two(
            #[inline(always)]
            |i| self.norms[i].max(norms[i]) * t * t,
        );
        let (low, high) = match phase[0] < phase[1] {
            true => (0, phase[1]),
            false => (1, phase[0]),
        };
        match high <= LONG * LONG {
            true => Way::Direct,
            false => Way::Mixed(low),
        }
    }

    /// `ψ, ψ′, ψ″` at time t, where the carrier is `e^{−iθ}`.
    #[inline(always)]
    pub fn psi(&self, roots: &Roots, free: &Free, carrier: C, t: f64) -> [C; 3] {
        self.motion::<false>(roots, free, carrier, t).0
    }

    /// `ψ, ψ′, ψ″` and `A = ψ e^{iθ}`. A is not ψ turned back: one of its components may be small
    /// beside the other, in the first moments, far below the resonance and far above it. Each keeps
    /// its own accuracy in a sum of terms that are all relative to the carrier.
    pub fn psi_and_amplitude(&self, roots: &Roots, free: &Free, carrier: C, t: f64) -> ([C; 3], C) {
        self.motion::<true>(roots, free, carrier, t)
    }

    /// `ψ, ψ′, ψ″` and, if it is wanted, A.
    #[inline(always)]
    fn motion<const AMPLITUDE: bool>(
        &self,
        roots: &Roots,
        free: &Free,
        carrier: C,
        t: f64,
    ) -> ([C; 3], C) {
        let omega = self.sweep.omega(t);
        let (sum, amplitude) = match self.way(roots, t, omega) {
            Way::Direct => direct::both(&self.sweep, roots, free, t),
            Way::Mixed(i) => self.mixed(roots, i, t, omega),
            Way::Closed => {
                let mut passed = [C::ZERO; 2];
                let mut left = [C::ZERO; 3];
                match &self.left {
                    Some(states) => {
                        for i in [0, 1] {
                            if self.sweep.beyond(roots, i, omega) {
                                passed[0] += states[i][0];
                                passed[1] += states[i][1];
                            }
                        }
                    }
                    None => left = passage(&self.sweep, roots, t, omega),
                }
                let [a, b] = two(
                    #[inline(always)]
                    |i| self.start[i] + passed[i],
                );
                let own = free.motion(roots.w, a, b);
                let Amplitudes { y, v, a } = self.sweep.particular(roots, omega);
                let forced = [y, v, a];
                let sum = three(
                    #[inline(always)]
                    |j| forced[j] * carrier + own[j] + left[j],
                );
                let again = match return_to_rest::cancels(sum[0], y) {
                    true => return_to_rest::motion(&self.sweep, roots, t, carrier),
                    false => None,
                };
                again.unwrap_or_else(
                    #[inline(always)]
                    || match AMPLITUDE {
                        true => {
                            let [a, b] = self.start_amplitudes;
                            let turn = circle(self.sweep.turned(t));
                            let own = (a * free.k0 + b * free.k) * turn;
                            let left = passed[0] * free.k0 + passed[1] * free.k + left[0];
                            (sum, y + own + left * carrier.conj())
                        }
                        false => (sum, y),
                    },
                )
            }
        };
        let psi = three(
            #[inline(always)]
            |j| sum[j] * self.scale,
        );
        (psi, amplitude * self.scale)
    }

    #[cold]
    #[inline(never)]
    fn mixed(&self, roots: &Roots, short: usize, t: f64, omega: Dd) -> ([C; 3], C) {
        let (near, amplitude) = direct::one(&self.sweep, roots, short, t);
        let (far, other) = self.closed_one(roots, 1 - short, t, omega);
        let sign = if short == 0 { 1.0 } else { -1.0 };
        let psi = three(|j| sign * (near[j] - far[j]) / roots.gap);
        (psi, sign * (amplitude - other) / roots.gap)
    }

    /// `φ, φ′, φ″` of root number i, and `φ e^{iθ}`.
    fn closed_one(&self, roots: &Roots, i: usize, t: f64, omega: Dd) -> ([C; 3], C) {
        let lambda = roots.lambda[i];
        let at = |omega: Dd| {
            let (f, r) = self.sweep.single(roots, i, omega);
            Amplitudes::new(omega.value(), f, r, lambda * r)
        };
        let (now, then) = (at(omega), at(self.sweep.nu));
        let carrier = self.sweep.carrier(t);
        let beta = roots.beta[i];
        let decay = decay(roots.eta[i].mul_f(t));
        let free = then.y * -decay;
        let own = circle(beta.mul_f(t).add_f(-self.sweep.delta)) * free;
        let left = passage_of_one(&self.sweep, roots, i, t, omega);
        let phi = [
            carrier * now.y + own + left[0],
            carrier * now.v + own * lambda + left[1],
            carrier * now.a + own * lambda * lambda + left[2],
        ];
        let turn = circle(beta.mul_f(t) + self.sweep.turned(t));
        (phi, now.y + turn * free + left[0] * carrier.conj())
    }
}

#[cfg(test)]
pub(super) mod tests;
