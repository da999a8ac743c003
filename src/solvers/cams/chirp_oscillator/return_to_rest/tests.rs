//! Motions from rest against the convolution integral, and the reasons to refuse.

use super::*;
use crate::chirp_oscillator::types::Chirp;

type C = Complex<f64>;

/// `ψ, ψ′, ψ″` at t for `ω = ν + κt`.
fn from_rest([w, n, nu, kappa, delta]: [f64; 5], t: f64) -> Option<[C; 3]> {
    let roots = Roots::new(w, n);
    let chirp = Chirp {
        omega0: nu,
        eps: kappa,
    };
    let sweep = Sweep::new(&roots, 1.0, &chirp, delta);
    motion(&sweep, &roots, t, sweep.carrier(t)).map(|(psi, _)| psi)
}

/// `∫ K(t − s) e^{−iθ(s)} ds` and the same with `K′`, `K(u) = e^{−nu} sin(hu)/h`, by Simpson's
/// rule.
fn convolution([w, n, nu, kappa, delta]: [f64; 5], t: f64) -> [C; 2] {
    let h = (w * w - n * n).sqrt();
    let steps = 40_000;
    let step = t / f64::from(steps);
    let mut sums = [C::ZERO; 2];
    for i in 0..=steps {
        let s = f64::from(i) * step;
        let u = t - s;
        let weight = match i {
            0 => 1.0,
            _ if i == steps => 1.0,
            _ if i % 2 == 1 => 4.0,
            _ => 2.0,
        };
        let decay = (-n * u).exp() * weight * step / 3.0;
        let (sin, cos) = (h * u).sin_cos();
        let force = C::cis(-(nu * s + 0.5 * kappa * s * s + delta));
        sums[0] += force * (decay * sin / h);
        sums[1] += force * (decay * (cos - n * sin / h));
    }
    sums
}

#[test]
fn motions_are_the_convolution() {
    // Near: |z|² below 49; far: above; with roots apart and together, resonances ahead and behind.
    for (given, times) in [
        ([1.0, 0.0, 0.05, 1e-3, 0.0], vec![6.2, 6.3, 12.6, 2.0]),
        ([1.0, 0.02, 0.05, 1e-3, 0.4], vec![6.2, 6.3, 12.6, 2.0]),
        ([1.0, 0.02, 0.05, 0.06, -0.4], vec![1.0, 6.2, 9.0]),
        ([2.0, 0.5, 0.3, 1e-2, 1.0], vec![3.1, 6.4, 12.0]),
        ([2.0, 1.0, 0.3, 0.1, 1.0], vec![0.7, 3.1, 6.4]),
        ([1.0, 0.01, 1.9, 2e-3, 0.2], vec![6.2, 6.3, 12.6]),
        ([1.0, 0.5, 3.0, 0.4, 0.2], vec![1.0, 5.2]),
        ([3.0, 0.0, 0.0, 1e-4, 0.0], vec![2.094, 2.0944, 20.944]),
    ] {
        for t in times {
            let [y, v, a] = from_rest(given, t).unwrap_or_else(|| panic!("{given:?} at {t}"));
            let [due_y, due_v] = convolution(given, t);
            let [w, n, nu, kappa, delta] = given;
            let force = C::cis(-(nu * t + 0.5 * kappa * t * t + delta));
            let due_a = force - due_v * (2.0 * n) - due_y * (w * w);
            for (got, due) in [(y, due_y), (v, due_v), (a, due_a)] {
                assert!((got - due).norm() < 2e-12, "{given:?} at {t}: {got} {due}");
            }
        }
    }
}

#[test]
fn refusals() {
    let base = [1.0, 0.1, 0.05, 1e-3, 0.0];
    let with = |change: fn(&mut [f64; 5]), t: f64| {
        let mut given = base;
        change(&mut given);
        from_rest(given, t).is_some()
    };
    assert!(with(|_| (), 6.0));
    // Damping: half of w is still served.
    assert!(with(|g| g[1] = 0.5, 6.0));
    assert!(!with(|g| g[1] = 0.5f64.next_up(), 6.0));
    assert!(!with(|g| (g[0], g[1]) = (0.05, 0.1), 6.0));
    assert!(with(|g| (g[0], g[1]) = (4.0, 2.0), 2.0));
    assert!(!with(|g| (g[0], g[1]) = (4.0, 2.1), 2.0));
    // Decay: ten nats are still served.
    assert!(with(|g| (g[1], g[3]) = (0.125, 1e-6), 80.0));
    assert!(!with(|g| (g[1], g[3]) = (0.125, 1e-6), 80.0f64.next_up()));
    assert!(with(|g| (g[1], g[3]) = (0.01, 1e-6), 200.0));
    // Phases of the force and of the free vibration, without damping.
    let free = |w: f64, nu: f64, t: f64| from_rest([w, 0.0, nu, 0.0, 0.0], t).is_some();
    assert!(free(1.0, 0.5, LARGE_PHASE.next_down()));
    assert!(!free(1.0, 0.5, LARGE_PHASE));
    assert!(free(1.0, 1.5, 0.6 * LARGE_PHASE));
    assert!(!free(1.0, 2.0, 0.5 * LARGE_PHASE));
    // A resonance on the way: from below w, and from a negative speed through −w.
    assert!(with(|g| g[3] = 0.01, 60.0));
    assert!(!with(|g| g[3] = 0.01, 120.0));
    let passes = |nu: f64, t: f64| from_rest([1.0, 0.0, nu, 0.01, 0.0], t).is_none();
    assert!(passes(-1.5, 60.0) && !passes(-1.5, 40.0));
    assert!(passes(-0.5, 160.0) && !passes(-0.5, 140.0));
}

#[test]
fn what_cancels() {
    let unit = C::new(0.6, 0.8);
    let limit = unit * 0.0625;
    assert!(cancels(limit * 0.999, unit) && !cancels(limit * 1.001, unit));
    assert!(cancels(limit * 3e-3, unit * 3.1e-3) && !cancels(limit * 3.1e-3, unit * 3e-3));
    assert!(!cancels(unit * 0.0625, C::new(1.0, 0.0)));
}
