//! Every seam is drawn.

use super::*;

/// With `(ω ∓ w₃)² + n² = 2κ|z|²` at time t.
#[test]
fn every_seam_is_drawn() {
    let mut found = [0; 8];
    let seams = [1.0, 49.0, 64.0, 100.0, 1e3, 1e5];
    for k in 0..4000 {
        let x = seam(&mut Draw::new(1, "chirp-response", "seams", k));
        let [w, n, eps, omega0, k, .., t] = x[..] else {
            panic!("{x:?}");
        };
        let (kappa, omega) = (eps * k, k * (omega0 + eps * t));
        let w3 = (w * w - n * n).max(0.0).sqrt();
        let near = |value: f64, due: f64| (value / due - 1.0).abs() < 1e-6;
        for (at, due) in seams.into_iter().enumerate() {
            let square = |side: f64| ((omega - side).powi(2) + n * n) / (2.0 * kappa);
            found[at] += usize::from(near(square(w3), due) || near(square(-w3), due));
        }
        found[6] += usize::from(n > 0.0 && near(omega, w3 + n));
        found[7] += usize::from(n > 0.0 && near(omega, n));
    }
    assert!(found.iter().all(|count| *count > 40), "{found:?}");
}

/// Where force and free vibration turn together |p| is taken for w/10: t is a number that is known.
#[test]
fn seams_in_resonance_are_drawn() {
    let times: Vec<f64> = (0..4000)
        .map(|k| seam(&mut Draw::new(1, "chirp-response", "seams", k)))
        .map(|x| x[0] * x[8])
        .collect();
    for due in [40.0, 160.0] {
        let found = times.iter().filter(|t| (**t / due - 1.0).abs() < 1e-6);
        assert!(found.count() >= 3, "{due}");
    }
}
