//! Which way a harmonic is computed, and one root by the closed form.

use super::*;

pub(in super::super) fn prepared(roots: &Roots, omega0: f64, eps: f64) -> Prepared {
    let harmonic = Harmonic {
        k: 1.0,
        amplitude: 1.0,
        phase: 0.3,
    };
    Prepared::new(roots, &Chirp { omega0, eps }, &harmonic, 1.0)
}

/// The closed form serves where `|p| t` is above 4 for both roots, at the start or now.
#[test]
fn where_the_closed_form_serves() {
    let roots = Roots::new(1.25, 0.75);
    let mut h = prepared(&roots, 0.0, 0.5);
    h.norms = [1.0, 4.0];
    assert!(!h.is_closed([4.0, 4.0], 2.0) && h.is_closed([4.001, 4.001], 2.0));
    assert!(!h.is_closed([3.9, 4.1], 2.0) && !h.is_closed([4.1, 3.9], 2.0));
    assert!(!h.is_closed([2.0, 2.0], 2.5) && h.is_closed([2.57, 2.0], 2.5));
    assert!(!h.is_closed([0.5, 64.0], 2.0) && !h.is_closed([0.5, 64.0], 4.0));
    assert!(h.is_closed([0.5, 64.0], 4.01));
    assert!(!h.is_closed([64.0, 64.0], 0.5) && h.is_closed([64.0, 64.0], 0.501));
}

/// Quadrature with both roots up to `|p| t` = 16, then with the slow one alone.
#[test]
fn where_the_quadrature_serves() {
    // λ = −0.01 and −99.99.
    let roots = Roots::new(1.0, 50.0);
    let h = prepared(&roots, 0.1, 0.01);
    let way = |t: f64| h.way(&roots, t, h.sweep.omega(t));
    for (t, due) in [
        (0.01, Way::Direct),
        (0.15, Way::Direct),
        (0.159, Way::Direct),
        (0.161, Way::Mixed(0)),
        (1.0, Way::Mixed(0)),
        (15.0, Way::Mixed(0)),
        (40.0, Way::Closed),
    ] {
        assert_eq!(way(t), due, "{t}");
    }
    // The other root is the slow one: λ = ±i with ω beside 1.
    let roots = Roots::new(1.0, 0.0);
    for (omega0, slow) in [(1.0, 1), (-1.0, 0)] {
        let h = prepared(&roots, omega0, 1e-6);
        let way = |t: f64| h.way(&roots, t, h.sweep.omega(t));
        assert_eq!(way(7.9), Way::Direct);
        assert_eq!(way(8.1), Way::Mixed(slow));
    }
}

/// `φ′ = λφ + e^{−iθ}` from zero, through the root's resonance, by Simpson's rule.
#[test]
fn one_root_by_the_closed_form() {
    for (w, n, omega0, eps, i) in [
        (1.25, 0.75, -3.0, 0.75, 0),
        (1.25, 0.75, -3.0, 0.75, 1),
        (1.0, 0.02, -4.0, 0.5, 0),
        (1.0, 1.5, -3.0, 0.75, 0),
        (1.0, 1.5, -3.0, 0.75, 1),
    ] {
        let roots = Roots::new(w, n);
        let h = prepared(&roots, omega0, eps);
        let lambda = roots.lambda[i];
        for t in [3.0, 6.0, 9.0, 12.0] {
            let steps = 6000;
            let at = |k: u32| {
                let s = t * f64::from(k) / f64::from(steps);
                (lambda * (t - s)).exp() * h.sweep.carrier(s)
            };
            let inner = |k: u32| at(k) * if k % 2 == 1 { 4.0 } else { 2.0 };
            let sum = at(0) + at(steps) + (1..steps).map(inner).sum::<C>();
            let y = sum * (t / f64::from(3 * steps));
            let carrier = h.sweep.carrier(t);
            let omega = h.sweep.omega(t);
            let v = lambda * y + carrier;
            let a = lambda * v - C::new(0.0, omega.value()) * carrier;
            let found = h.closed_one(&roots, i, t, omega);
            for (found, due) in found.0.iter().zip([y, v, a]) {
                assert!(
                    (found - due).norm() < 1e-9,
                    "{w} {n} {i} {t}: {found} {due}"
                );
            }
        }
    }
}
