//! Where the chirp-forced oscillator is audited.

use crate::audit::{CheckPoint, Draw, Region};
use crate::methods::common::{points, region};
use std::f64::consts::PI;

/// A case from w, n/w, kε, kΩ₀ and t: splits kε and kΩ₀ by a whole k, adds a phase and, in half of
/// the cases, an initial state.
fn finish(d: &mut Draw, [w, zeta, kappa, nu, t]: [f64; 5]) -> Vec<f64> {
    let k = d.log_uniform(1.0, 60.0).floor();
    let k = if d.chance(0.1) { -k } else { k };
    let delta = d.uniform(-PI, PI);
    let (y0, v0) = match d.chance(0.5) {
        true => (0.0, 0.0),
        false => (d.uniform(-1.0, 1.0), w * d.uniform(-1.0, 1.0)),
    };
    vec![w, w * zeta, kappa / k, nu / k, k, delta, y0, v0, t]
}

/// [`finish`], the sweep and the speed of either sign.
fn finish_signed(d: &mut Draw, [w, zeta, kappa, nu, t]: [f64; 5]) -> Vec<f64> {
    let (kappa, nu) = (d.signed(kappa), d.signed(nu));
    finish(d, [w, zeta, kappa, nu, t])
}

fn frequency(d: &mut Draw) -> f64 {
    d.log_uniform(0.3, 30.0)
}

/// Damping ratios up to 30.
fn ratio(d: &mut Draw) -> f64 {
    match d.integer(0, 6) {
        0 => 0.0,
        1 => d.log_uniform(1e-6, 1e-2),
        2 | 3 => d.log_uniform(1e-2, 0.7),
        4 => near_one(d),
        5 => d.uniform(0.0, 2.0),
        _ => d.log_uniform(1.0, 30.0),
    }
}

/// 1, exactly or off by 1e-16 to 0.3.
fn near_one(d: &mut Draw) -> f64 {
    match d.chance(0.1) {
        true => 1.0,
        false => 1.0 + d.log_signed(1e-16, 0.3),
    }
}

fn sweep(d: &mut Draw) -> f64 {
    d.log_uniform(1e-9, 1e2)
}

fn time(d: &mut Draw) -> f64 {
    d.log_uniform(1e-3, 3e2)
}

/// Light to moderate damping.
fn light(d: &mut Draw) -> f64 {
    d.zero_or_log(0.2, 1e-6, 0.5)
}

/// `ν` such that ω at time t is a few resonance widths from ±w₃, or at a multiple of `√κ`.
fn at_resonance(d: &mut Draw, w: f64, zeta: f64, kappa: f64, t: f64) -> f64 {
    let w3 = w * (1.0 - zeta * zeta).abs().sqrt();
    let off = d.uniform(-12.0, 12.0) * kappa.abs().sqrt().max(w * zeta);
    let off = if d.chance(0.3) { off * 0.05 } else { off };
    d.signed(w3) + off - kappa * t
}

pub(super) fn all() -> Vec<Region> {
    vec![
        region(
            "any",
            "n/w = 0..30, |k eps| = 1e-9..1e2, |k omega0| = 1e-3..1e2, t = 1e-3..3e2",
            |d| {
                let (w, zeta, kappa, t) = (frequency(d), ratio(d), sweep(d), time(d));
                let nu = d.log_uniform(1e-3, 1e2);
                finish_signed(d, [w, zeta, kappa, nu, t])
            },
        ),
        region(
            "run-up",
            "from rest or from a speed below resonance, eps > 0",
            |d| {
                let (w, zeta, kappa, t) = (frequency(d), ratio(d), sweep(d), time(d));
                let nu = match d.chance(0.5) {
                    true => 0.0,
                    false => w * d.uniform(0.0, 1.0),
                };
                finish(d, [w, zeta, kappa, nu, t])
            },
        ),
        region(
            "run-down",
            "from above resonance towards a stop, eps < 0",
            |d| {
                let (w, zeta, kappa) = (frequency(d), ratio(d), sweep(d));
                let nu = w * d.log_uniform(1.0, 30.0);
                let t = (nu / kappa).min(300.0) * d.log_uniform(1e-3, 1.0);
                finish(d, [w, zeta, -kappa, nu, t])
            },
        ),
        region("reversal", "through zero speed, eps of either sign", |d| {
            let (w, zeta) = (frequency(d), ratio(d));
            let (nu, t) = (w * d.log_uniform(0.1, 20.0), time(d));
            let kappa = -nu / t * d.uniform(0.99, 3.0);
            let turn = d.signed(1.0);
            finish(d, [w, zeta, kappa * turn, nu * turn, t])
        }),
        region(
            "resonance-passage",
            "within 12 widths of a resonance at time t, n/w = 0..0.5",
            |d| {
                let (w, zeta, kappa, t) = (frequency(d), light(d), sweep(d), time(d));
                let kappa = d.signed(kappa);
                let nu = at_resonance(d, w, zeta, kappa, t);
                finish(d, [w, zeta, kappa, nu, t])
            },
        ),
        region(
            "quasi-static",
            "speeds below w/30 throughout, n/w up to 30",
            |d| {
                let (w, zeta, t) = (frequency(d), ratio(d), time(d));
                let nu = w * d.log_uniform(1e-9, 0.03);
                let kappa = w / t * d.log_uniform(1e-9, 0.03);
                finish_signed(d, [w, zeta, kappa, nu, t])
            },
        ),
        region("stationary-limit", "|k eps| = 1e-300..1e-9", |d| {
            let (w, zeta, t) = (frequency(d), ratio(d), time(d));
            let kappa = d.log_uniform(1e-300, 1e-9);
            let nu = w * d.log_uniform(1e-3, 30.0);
            finish_signed(d, [w, zeta, kappa, nu, t])
        }),
        region("stationary", "eps = 0, resonance included", |d| {
            let (w, zeta, t) = (frequency(d), ratio(d), time(d));
            let nu = match d.integer(0, 3) {
                0 => w,
                1 => w * (1.0 + d.log_signed(1e-15, 1e-1)),
                2 => 0.0,
                _ => w * d.log_uniform(1e-3, 30.0),
            };
            // At rest all that moves is the free vibration: below the range of f64 some time.
            let t = if nu == 0.0 { t.min(600.0 / w) } else { t };
            let nu = d.signed(nu);
            finish(d, [w, zeta, 0.0, nu, t])
        }),
        region("undamped", "n = 0, at and off resonance", |d| {
            let (w, kappa, t) = (frequency(d), sweep(d), time(d));
            let kappa = d.signed(kappa);
            let nu = match d.chance(0.5) {
                true => at_resonance(d, w, 0.0, kappa, t),
                false => w * d.uniform(-5.0, 5.0),
            };
            finish(d, [w, 0.0, kappa, nu, t])
        }),
        region("critical", "n/w = 1 exactly or off by 1e-16..0.3", |d| {
            let (w, zeta, kappa, t) = (frequency(d), near_one(d), sweep(d), time(d));
            let nu = w * d.log_uniform(1e-2, 30.0);
            finish_signed(d, [w, zeta, kappa, nu, t])
        }),
        region(
            "critical-passage",
            "likewise, with omega = n within a few widths at time t",
            |d| {
                let (w, zeta, t) = (frequency(d), near_one(d), time(d));
                let kappa = w * w * d.log_uniform(1e-3, 1e2);
                let off = d.uniform(-2.0, 2.0) * kappa.sqrt().max(w);
                let off = if d.chance(0.4) { off * 1e-3 } else { off };
                let nu = w * zeta + off - kappa * t;
                finish(d, [w, zeta, kappa, nu, t])
            },
        ),
        region("overdamped", "n/w = 1..1000", |d| {
            let (w, kappa, t) = (frequency(d), sweep(d), time(d));
            let zeta = d.log_uniform(1.0, 1e3);
            let nu = w * d.log_uniform(1e-3, 30.0);
            finish_signed(d, [w, zeta, kappa, nu, t])
        }),
        region("small-t", "w t = 1e-12..10", |d| {
            let (w, zeta) = (frequency(d), ratio(d));
            let t = d.log_uniform(1e-12, 10.0) / w;
            let (kappa, nu) = (sweep(d), w * d.log_uniform(1e-3, 30.0));
            finish_signed(d, [w, zeta, kappa, nu, t])
        }),
        region("first-moments", "w t = 1e-90..1e-9, n/w = 0..30", |d| {
            let (w, zeta) = (frequency(d), ratio(d));
            let t = d.log_uniform(1e-90, 1e-9) / w;
            let (kappa, nu) = (sweep(d), w * d.log_uniform(1e-3, 30.0));
            finish_signed(d, [w, zeta, kappa, nu, t])
        }),
        region("fast-sweep", "|k eps|/w^2 = 1..1e6", |d| {
            let (w, zeta) = (frequency(d), ratio(d));
            let kappa = w * w * d.log_uniform(1.0, 1e6);
            let t = d.log_uniform(1e-2, 1e3) / kappa.sqrt();
            let kappa = d.signed(kappa);
            let nu = match d.chance(0.5) {
                true => at_resonance(d, w, zeta.min(1.0), kappa, t),
                false => w * d.uniform(-5.0, 5.0),
            };
            finish(d, [w, zeta, kappa, nu, t])
        }),
        region("huge-phases", "phases 1e6..1e9 rad", |d| {
            let (w, zeta) = (frequency(d), light(d));
            let t = d.log_uniform(1e3, 1e6);
            let phase = d.log_uniform(1e6, 1e9);
            let share = d.uniform(0.0, 1.0);
            let (nu, kappa) = (phase * share / t, 2.0 * phase * (1.0 - share) / t / t);
            let (kappa, nu) = (d.signed(kappa), d.signed(nu));
            finish(d, [w, zeta * 1e-3, kappa, nu, t])
        }),
        region(
            "return-to-rest",
            "n/w up to 1e-3, beside times when force and free vibration have made whole half-turns",
            |d| {
                let w = frequency(d);
                let zeta = d.zero_or_log(0.5, 1e-16, 1e-3);
                let free = d.integer(2, 30) as f64;
                // Of the same parity, but not in resonance.
                let forced = free - 2.0 * d.integer(1, 40) as f64;
                let forced = if forced == -free { 0.0 } else { forced };
                let forced = if d.chance(0.3) { free % 2.0 } else { forced };
                let end = PI * free / w;
                let kappa = match d.chance(0.2) {
                    true => 0.0,
                    false => w / end * d.log_uniform(1e-12, 1e-2),
                };
                let kappa = d.signed(kappa);
                let nu = PI * forced / end - 0.5 * kappa * end;
                let t = end * (1.0 + d.log_signed(1e-12, 1e-1));
                finish(d, [w, zeta, kappa, nu, t])
            },
        ),
        region(
            "seams",
            "|z|^2 at time t beside 1, 49, 64, 100, 1000 or 1e5; omega beside w3 + n; |p| t beside 4, 16",
            seam,
        ),
    ]
}

/// At or beside a border between formulas.
fn seam(d: &mut Draw) -> Vec<f64> {
    let (w, zeta) = (frequency(d), ratio(d));
    let kappa = w * w * d.log_uniform(1e-6, 1e2);
    let n = w * zeta;
    let w3 = w * (1.0 - zeta * zeta).max(0.0).sqrt();
    let beside = 1.0 + d.log_signed(1e-16, 1e-2);
    let t = match d.chance(0.3) {
        true => d.log_uniform(0.1, 30.0) / w,
        false => time(d),
    };
    let omega = match d.integer(0, 3) {
        0 => (w3 + n) * beside,
        1 => n * beside,
        _ => {
            let z2 = d.one_of(&[1.0, 49.0, 64.0, 100.0, 1e3, 1e5]) * beside;
            let x = (2.0 * kappa * z2 - n * n).max(0.0).sqrt();
            let side = d.signed(w3);
            side + d.signed(x)
        }
    };
    if d.chance(0.3) {
        let nu = d.uniform(-4.0, 4.0) * w;
        let size = libm::hypot(n, nu.abs().max((nu + kappa * t).abs()) + d.signed(w3)).max(w * 0.1);
        let t = d.one_of(&[4.0, 16.0]) / size * beside;
        return finish(d, [w, zeta, kappa, nu, t]);
    }
    finish(d, [w, zeta, kappa, omega - kappa * t, t])
}

/// Columns: name, `w`, `n`, `eps`, `omega0`, `k`, `delta`, `y0`, `v0`, `t`.
const CHECK_POINTS: &str = "\
run-up-from-rest                   10   0.5     4      0  2     0   0  0   1.5
run-down-from-speed                10   0.5    -4     30  2   0.3 0.1 -2     8
at-time-zero                       10   0.5     4      3  2  0.25 0.5 -2     0
a-moment-after-rest               100     2    50      3  1   0.3   0  0 1e-30
constant-force                     10   0.5     4      3  0  0.25   0  0   0.7
constant-force-long-after          10   0.5     4      3  0  0.25   0  0   400
resonance-without-damping          10     0     0     10  1     0   0  0   100
resonance-with-damping             10   0.1     0     10  1     0   0  0   1e4
critical-from-rest                  1     1     1      0  1     0   0  0     5
critical-both-passed                1     1   0.5     -3  1     0   0  0    40
both-resonances-passed              2  0.01   0.5     -9  1     0   0  0    40
no-speed                            3   0.2     0      0  5     1   0  0     2
negative-multiple                  10   0.5     4      1 -2   0.5   0  0   1.5
phase-beyond-the-fast-reduction    10  1e-9     0    3e9  1     0   0  0    10
slow-units                       1e-9 1e-10 1e-18      0  2   0.3   0  0   3e9
fast-units                       1e12  1e11  1e23   1e12  3   0.3   0  0 1e-11
no-frequency                        0   0.5     4      0  2     0   0  0   1.5
negative-frequency                 -1   0.5     4      0  2     0   0  0   1.5
negative-damping                   10  -0.5     4      0  2     0   0  0   1.5
negative-time                      10   0.5     4      0  2     0   0  0  -1.5
frequency-not-a-number            nan   0.5     4      0  2     0   0  0   1.5
infinite-time                      10   0.5     4      0  2     0   0  0   inf";

pub(super) fn check_points() -> Vec<CheckPoint> {
    points(CHECK_POINTS)
}

#[cfg(test)]
mod tests;
