//! Zeros of w, all in the lower half-plane, in pairs z and −conj z.
//!
//! # Start
//! With `λ = √((k − 1/8)π)` and `μ = ln(λ√(2π))` the k-th zero of erfc in the second quadrant is
//! `−λ + μ/(4λ) + i(λ + μ/(4λ))` and terms of order λ^-3 (DLMF 7.13.4); erfc(ζ) = 0 means
//! `w(iζ) = 0`, and the mirror image of iζ is `λ + μ/(4λ) − i(λ − μ/(4λ))`.
//!
//! # Certificate
//! Newton's method at rising precision, then the Newton–Kantorovich theorem (Ortega & Rheinboldt
//! 12.6.2) at the last iterate z_0: with `β ≥ 1/|w'(z_0)|`, `η ≥ β|w(z_0)|` and M a Lipschitz constant
//! of w' on the disc of radius 2η, `βηM ≤ 1/2` implies a zero within 2η, the only one there. From
//! `w'' = (4z² − 2) w − 4iz/√π` and, on the disc, `|w| ≤ e^{2Zr} (|w(z_0)| + 2r/√π)`, r = 2η,
//! Z = |z_0| + r (Grönwall for w' = −2zw + 2i/√π):
//!
//! ```text
//! M = (4Z² + 2) e^{2Zr} (|w(z_0)| + 2r/√π) + 4Z/√π
//! ```

use super::w_ball;
use crate::reference::{Ball, ComplexBall, Mag, Undecided};
use rug::Float;

/// `w'(z) = −2z w + 2i/√π`.
fn slope(z: &ComplexBall, w: &ComplexBall, prec: u32) -> ComplexBall {
    let two = Ball::integer(prec, 2);
    let t = (z * w).scaled(&-two.clone());
    ComplexBall::new(t.re, t.im + &(two / &Ball::pi(prec).sqrt()))
}

fn exact(z: &ComplexBall, prec: u32) -> ComplexBall {
    let part = |b: &Ball| Ball::new(Float::with_val(prec, b.mid()), Mag::ZERO);
    ComplexBall::new(part(&z.re), part(&z.im))
}

/// A bound on the distance of a zero from the exact point z, if there certainly is one.
fn certificate(z: &ComplexBall, prec: u32) -> Option<Mag> {
    let w = w_ball(z, prec);
    let below = slope(z, &w, prec).mignitude();
    let size = w.magnitude();
    let eta = size.div(below);
    if !eta.is_finite() {
        return None;
    }
    let r = eta.shift(1);
    let z = z.magnitude().add(r);
    let t = z.mul(r).shift(1);
    if !(t <= Mag::from_f64(1.0)) {
        return None;
    }
    // e^t ≤ 1 + 2t for t ≤ 1; 2/√π < 1.1284, 4/√π < 2.2568.
    let grown = Mag::from_f64(1.0).add(t.shift(1));
    let w = grown.mul(size.add(Mag::from_f64(1.1284).mul(r)));
    let four = z.mul(z).shift(2).add(Mag::from_f64(2.0));
    let m = four.mul(w).add(Mag::from_f64(2.2568).mul(z));
    (eta.mul(m).div(below) <= Mag::from_f64(0.5)).then_some(r)
}

/// The k-th zero of w (k = 1, 2, …) with positive real part, counted by the asymptotic expansion
/// (DLMF 7.13.4), i.e. by increasing modulus. Existence and uniqueness in a neighbourhood are
/// proved; each component has a relative radius of at most 2^-bits. Its mirror image `−conj z` is a
/// zero as well, and there are no others in the plane.
///
/// # Errors
/// k = 0, or no certificate at `4 bits + 4096` bits.
pub fn zero(k: u32, bits: u32) -> Result<ComplexBall, Undecided> {
    let open = |bits: u32, reason: String| Undecided { bits, reason };
    if k == 0 {
        return Err(open(bits, "the zeros of w are counted from one".into()));
    }
    let lambda = ((f64::from(k) - 0.125) * std::f64::consts::PI).sqrt();
    let part = (lambda * (2.0 * std::f64::consts::PI).sqrt()).ln() / (4.0 * lambda);
    let mut prec = 96;
    let mut z = ComplexBall::new(
        Ball::exact(prec, lambda + part),
        Ball::exact(prec, part - lambda),
    );
    let cap = 4 * bits.max(64) + 4096;
    let mut steps = 0;
    loop {
        let w = w_ball(&z, prec);
        let step = w.div(&slope(&z, &w, prec));
        if !step.is_finite() {
            return Err(open(prec, format!("zero {k} of w: no Newton step")));
        }
        z = exact(&(&z - &step), prec);
        steps += 1;
        if steps < 7 {
            continue;
        }
        if let Some(r) = certificate(&z, prec) {
            let smaller = if z.re.mignitude() < z.im.mignitude() {
                &z.re
            } else {
                &z.im
            };
            if r <= smaller.mignitude().shift(-i64::from(bits)) {
                return Ok(z.widened(r));
            }
        }
        if prec >= cap {
            return Err(open(prec, format!("zero {k} of w is not certified")));
        }
        // Each step doubles the correct digits.
        prec = (2 * prec).min((bits + 64).max(prec + 32)).min(cap);
        z = exact(&z, prec);
    }
}
