//! The response to one harmonic from rest.

use super::direct;
use super::free::Free;
use super::passage::{passage, passage_of_one};
use super::roots::Roots;
use super::sweep::{Amplitudes, Sweep};
use super::types::{Chirp, Harmonic};
use crate::solvers::faddeeva::double_double::Dd;
use num_complex::Complex;

type C = Complex<f64>;

/// The particular solution and the free vibration cancel where `|p| t` is below this.
const SHORT: f64 = 4.0;
/// The quadrature with both roots is used up to here where one of them needs it.
const LONG: f64 = 16.0;

/// A harmonic made ready.
#[derive(Clone, Debug)]
pub(super) struct Prepared {
    pub sweep: Sweep,
    /// `w² D`
    pub scale: f64,
    /// Whether k was negated to have `κ ≥ 0`: amplitudes are conjugated then.
    pub mirrored: bool,
    /// `−ψ(0), −ψ′(0)` of the particular solution, per `w²`.
    pub start: [C; 2],
    /// `|p|` at `t = 0` for both roots.
    size: [f64; 2],
}

/// How the response is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Way {
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
        let size = [0, 1].map(|i| roots.p(i, sweep.nu).norm());
        let carrier = sweep.carrier(0.0);
        let Amplitudes { y, v, .. } = sweep.particular(roots, sweep.nu);
        Prepared {
            sweep,
            scale,
            mirrored,
            start: [-carrier * y, -carrier * v],
            size,
        }
    }

    pub fn way(&self, roots: &Roots, t: f64, omega: Dd) -> Way {
        let phase = [0, 1].map(|i| self.size[i].max(roots.p(i, omega).norm()) * t);
        let (low, high) = match phase[0] < phase[1] {
            true => (0, phase[1]),
            false => (1, phase[0]),
        };
        if phase[low] > SHORT {
            Way::Closed
        } else if high <= LONG {
            Way::Direct
        } else {
            Way::Mixed(low)
        }
    }

    /// `ψ, ψ′, ψ″` at time t.
    pub fn psi(&self, roots: &Roots, free: &Free, t: f64) -> [C; 3] {
        let omega = self.sweep.omega(t);
        let sum = match self.way(roots, t, omega) {
            Way::Direct => direct::both(&self.sweep, roots, free, t),
            Way::Mixed(i) => self.mixed(roots, i, t, omega),
            Way::Closed => {
                let [a, b] = self.start;
                let own = free.motion(roots.w, a, b);
                let left = passage(&self.sweep, roots, t, omega);
                let carrier = self.sweep.carrier(t);
                let Amplitudes { y, v, a } = self.sweep.particular(roots, omega);
                let forced = [y, v, a].map(|x| x * carrier);
                [0, 1, 2].map(|j| forced[j] + own[j] + left[j])
            }
        };
        sum.map(|x| x * self.scale)
    }

    fn mixed(&self, roots: &Roots, short: usize, t: f64, omega: Dd) -> [C; 3] {
        let near = direct::one(&self.sweep, roots, short, t);
        let far = self.closed_one(roots, 1 - short, t, omega);
        let sign = if short == 0 { 1.0 } else { -1.0 };
        [0, 1, 2].map(|j| sign * (near[j] - far[j]) / roots.gap)
    }

    /// `φ, φ′, φ″` of root number i.
    fn closed_one(&self, roots: &Roots, i: usize, t: f64, omega: Dd) -> [C; 3] {
        let lambda = roots.lambda[i];
        let at = |omega: Dd| {
            let (f, r) = self.sweep.single(roots, i, omega);
            Amplitudes::new(omega.value(), f, r, lambda * r)
        };
        let (now, then) = (at(omega), at(self.sweep.nu));
        let carrier = self.sweep.carrier(t);
        let (eta, beta) = (roots.eta[i].value(), roots.beta[i]);
        let decay = (-eta * t).exp();
        let turned = super::phase::circle(beta.mul_f(t).add_f(-self.sweep.delta));
        let own = turned * (-decay) * then.y;
        let left = passage_of_one(&self.sweep, roots, i, t, omega);
        [
            carrier * now.y + own + left[0],
            carrier * now.v + own * lambda + left[1],
            carrier * now.a + own * lambda * lambda + left[2],
        ]
    }
}
