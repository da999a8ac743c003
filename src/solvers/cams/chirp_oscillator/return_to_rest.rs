//! The response from rest where forced and free vibration cancel, in double-double.
//!
//! An undamped oscillator under a force of nearly constant frequency returns to rest wherever both
//! vibrations have made whole numbers of half-turns, for instance beside `wt = 2πm` under a static
//! force. Displacement and velocity vanish together there, so that the condition number grows like
//! the inverse of the distance from the return, but the lost digits like its square.

use super::complex_double_double::Cd;
use super::extended;
use super::phase::circle;
use super::roots::Roots;
use super::series::FAR;
use super::sweep::Sweep;
use crate::double_double::{Dd, two_prod};
use crate::double_double_functions::circles_and_exponential;
use crate::exponential::LARGE_PHASE;
use crate::lanes::{Lanes, Task, with_best};
use crate::numbers::One;
use num_complex::Complex;

/// A sum smaller than this part of its terms is computed again.
const CANCELLED: f64 = 1.0 / 16.0;
/// Damping beyond this part of `w` keeps the motion away from rest.
const DAMPED: f64 = 0.5;
/// Largest decay in nats.
const GONE: f64 = 10.0;
/// Terms of the asymptotic series: the smallest one is met here for `|z|² = 49`.
const TERMS: usize = 44;

/// Returns whether a sum has lost digits against one of its terms.
#[inline(always)]
pub(super) fn cancels(sum: Complex<f64>, term: Complex<f64>) -> bool {
    sum.norm_sqr() < CANCELLED * CANCELLED * term.norm_sqr()
}

/// `ψ, ψ′, ψ″` at time t from rest, and `ψ e^{iθ}`; `None` where the terms cancel for another
/// reason: strong damping, phases from 2³⁰ on, a resonance passed on the way.
#[cold]
#[inline(never)]
pub(super) fn motion(
    sweep: &Sweep,
    roots: &Roots,
    t: f64,
    carrier: Complex<f64>,
) -> Option<([Complex<f64>; 3], Complex<f64>)> {
    let omega = sweep.omega(t);
    let passed = |i: usize| sweep.beyond(roots, i, omega) != sweep.beyond(roots, i, sweep.nu);
    let turned = (sweep.nu + sweep.kappa.mul_f(0.5 * t)).mul_f(t);
    let free = roots.half.mul_f(t);
    if roots.over
        || roots.n > DAMPED * roots.w
        || roots.n * t > GONE
        || turned.hi.abs() >= LARGE_PHASE
        || free.hi >= LARGE_PHASE
        || passed(0)
        || passed(1)
    {
        return None;
    }
    let [amplitude, y, v] = with_best(Sum {
        sweep,
        roots,
        t,
        omega,
        phases: [turned, free],
    });
    let start = circle(Dd::from(-sweep.delta));
    let (y, v) = (start * y.value(), start * v.value());
    // Nothing cancels here: next to rest the force stands alone.
    let a = carrier - v * (2.0 * roots.n) - y * (roots.w * roots.w);
    Some(([y, v, a], amplitude.value()))
}

/// The amplitude of the displacement, then displacement and velocity without `e^{−iδ}`.
struct Sum<'a> {
    sweep: &'a Sweep,
    roots: &'a Roots,
    t: f64,
    omega: Dd,
    phases: [Dd; 2],
}

impl Task for Sum<'_> {
    type Output = [Cd; 3];

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> [Cd; 3] {
        let Sum {
            sweep, roots, t, ..
        } = self;
        let n = Dd::from(roots.n);
        let ([(sin, cos), (s, c)], e) =
            circles_and_exponential(One(lanes), self.phases, -two_prod(roots.n, t));
        let s = s.div(roots.half);
        // K, K′ and K′ + 2nK.
        let (k, k1, k0) = (e * s, e * (c - n * s), e * (c + n * s));

        let [y, v] = amplitudes(sweep, roots, self.omega);
        let [y0, v0] = amplitudes(sweep, roots, sweep.nu);
        let carrier = Cd(cos, -sin);
        let stiffness = two_prod(roots.w, roots.w);
        let amplitude = y - Cd(cos, sin) * (y0.scaled(k0) + v0.scaled(k));
        [
            amplitude,
            carrier * amplitude,
            carrier * v - (v0.scaled(k1) - y0.scaled(stiffness * k)),
        ]
    }
}

/// `F[·]` and `V[·]`, the particular solution and its velocity without `e^{−iθ}`.
fn amplitudes(sweep: &Sweep, roots: &Roots, omega: Dd) -> [Cd; 2] {
    let p = [0, 1].map(|i| roots.p(i, omega));
    let [f, r] = match sweep.distance(p[0]).min(sweep.distance(p[1])) >= FAR {
        true => far(sweep, roots, omega),
        false => {
            let [f, r, _] = extended::unrounded(sweep, roots, omega);
            [f, r]
        }
    };
    [f, f.scaled(omega).turned() + r]
}

/// `F[·]` and `R[·]` by the asymptotic series (see [`super::sweep`]).
fn far(sweep: &Sweep, roots: &Roots, omega: Dd) -> [Cd; 2] {
    let [p, r] = [0, 1].map(|i| Cd(-roots.eta[i], omega + roots.beta[i]));
    // The larger one first: the conjugate at −ω has the same bits then.
    let (p, r) = match p.1.hi.abs() < r.1.hi.abs() {
        true => (r, p),
        false => (p, r),
    };
    let q = (p * r).inverse();
    let s = (p + r) * q;
    let one = Cd(Dd::from(1.0), Dd::ZERO);
    let (mut even, mut odd, mut f) = (one, s, one);
    let mut rate = Cd(Dd::ZERO, Dd::ZERO);
    let mut size = Dd::from(1.0);
    for m in 1..=TERMS {
        size = (size * sweep.kappa).mul_f((2 * m - 1) as f64);
        let slower = odd.scaled(size);
        rate = rate + slower.turned_by(m);
        even = s * odd - q * even;
        let term = even.scaled(size);
        f = f + term.turned_by(m);
        odd = s * even - q * odd;
        if term.size().max(slower.size()) < f64::EPSILON * f64::EPSILON * f.size() {
            break;
        }
    }
    [q * f, q * rate]
}

#[cfg(test)]
mod tests;
