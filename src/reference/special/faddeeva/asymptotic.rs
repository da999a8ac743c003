//! W for large |z|: the asymptotic series with proven remainders, per component.
//!
//! # Series
//! `w(z) = (i/π) ∫ e^{−t²}/(z − t) dt` over the real line for Im z > 0 (DLMF 7.7.2). With
//! `1/(z − t) = Σ_{m<2N} t^m/z^{m+1} + t^{2N}/(z^{2N}(z − t))`, odd moments zero, even moments
//! `∫ t^{2m} e^{−t²} dt = Γ(m + 1/2) = √π (1/2)_m`, and the two halves ±t put together,
//!
//! ```text
//! w = S_N + R_N     S_N = (i/(√π z)) Σ_{m<N} (1/2)_m z^{−2m}      (DLMF 7.12.1 at −iz)
//! R_N = (i/π) z^{1−2N} ∫ t^{2N} e^{−t²}/(z² − t²) dt
//! ```
//!
//! # Remainder in the closed quadrant 0 ≤ θ = arg z ≤ π/2
//! Turn the line of integration to `t = τ e^{−iα}`, 0 ≤ α ≤ π/8. The integrand has no pole between
//! the lines (θ > 0), decays (cos 2α > 0), and the turned integral continues R_N to θ = 0. On it
//! `|e^{−t²}| = e^{−τ² cos 2α}`, and `z² − t²` with the angle 2(θ + α) ∈ [2α, 5π/4] between its two
//! terms obeys `|z² − t²| ≥ |z|² sin 2α` (distance of z² from a ray: |z|² when the angle is at
//! least π/2, |z|² sin 2(θ+α) otherwise). With `T_N = Γ(N + 1/2)/(π |z|^{2N+1})`
//!
//! ```text
//! |R_N| ≤ T_N / (cos^{N+1/2} 2α  sin 2α)
//! ```
//!
//! and with tan² 2α = 1/(N + 1/2) (at most 1 for N ≥ 1, so α ≤ π/8):
//! `cos^{−(N+1/2)} 2α = ((N+3/2)/(N+1/2))^{(N+1/2)/2} ≤ √e`, `sin 2α = (N + 3/2)^{−1/2}`, hence
//!
//! ```text
//! |R_N| ≤ B_N = √(e (N + 3/2)) T_N                         0 ≤ θ ≤ π/2, N ≥ 1
//! ```
//!
//! Differentiating under the integral, `z d/dz [z^{1−2N}/(z²−t²)] =
//! z^{1−2N} [−(2N−1)/(z²−t²) − 2z²/(z²−t²)²]`, and by the same bounds
//!
//! ```text
//! |z R_N'| ≤ D_N = √e ((2N − 1) √(N + 3/2) + 2N + 3) T_N    0 ≤ θ ≤ π/2, N ≥ 1
//! ```
//!
//! # Remainder of a component beside an axis
//! On the imaginary axis R_N is real. Along the arc |z| = const from there,
//! `|Im R_N| ≤ (π/2 − θ) max |z R_N'| ≤ (π/2 − θ) D_N`. On the real axis `w − e^{−z²}` and S_N are
//! purely imaginary (`w − e^{−z²} = (2i/√π) F` with Dawson's real F), hence so is
//! `R_N − e^{−z²}`, and along the arc from there, for θ ≤ π/4,
//!
//! ```text
//! |Re(R_N − e^{−z²})| ≤ θ (D_N + 2|z|² e^{−Re z²})
//! ```
//!
//! (`|z (e^{−z²})'| = 2|z|² e^{−Re z²}`, and Re z² = |z|² cos 2θ falls along the arc). So beside
//! the real axis `Re w = Re e^{−z²} + Re S_N` with an error proportional to θ ≤ (π/2) sin θ: Re w
//! beside the axis, and e^{−x²} on it, keep their relative accuracy.
//!
//! # Lower half-plane
//! `w(z) = 2e^{−z²} − w(−z)` (DLMF 7.4.3) and `w(−conj z) = conj w(z)` (w is real on the
//! imaginary axis; Schwarz): `w(x − ih) = 2e^{−z²} − conj w(x + ih)`.
//!
//! # Evaluation
//! With `u = 1/z = a + ib`, `v = C u²`, C a power of two with |v| ≤ 1,
//! `Σ (1/2)_m C^{−m} v^m = P + i q S`, q = 2abC ([`super::fixed`], term ratio (2m+1)/(2C)):
//! `u (P + iqS) = a (P − 2b²C S) + i b (P + 2a²C S)`.
use super::argument::{Argument, Member};
use super::fixed;
use super::gaussian::Gaussian;
use super::scaled::{REACH, Scaled};
use crate::{Ball, Mag};
use rug::Integer;
use std::f64::consts::FRAC_PI_2;

/// `log2` of upper bounds on `T_N`, `B_N` and `D_N`; `log_r` is `log2 |z|²` or a little less.
pub(super) struct Remainder {
    pub plain: f64,
    pub turning: f64,
}

pub(super) fn remainder(n: u64, log_r: f64) -> Remainder {
    let n = n as f64;
    let s = n + 0.5;
    // ln Γ(s) ≤ (s − 1/2) ln s − s + ln(2π)/2 + 1/(12 s), DLMF 5.11.1.
    let ln_gamma = n * s.ln() - s + 0.9189386 + 1.0 / (12.0 * s);
    let t = ln_gamma * std::f64::consts::LOG2_E - s * log_r - 1.6514;
    // One bit for everything rounded here.
    let t = t + 1.0;
    let e = 0.7214;
    let root = (n + 1.5).sqrt();
    Remainder {
        plain: t + e + root.log2(),
        turning: t + e + ((2.0 * n - 1.0) * root + 2.0 * n + 3.0).log2(),
    }
}

/// Below |z|² = 8 no number of terms suffices for two bits.
const LEAST: f64 = 3.0;

/// States what `log2 |z|²` may be off by.
const SLACK: f64 = 1e-8;

/// Precision of an exponent that is rounded to an integer.
const BITS: u32 = 64;

/// The number of terms that makes the remainder small enough for `prec` bits of each component,
/// if there is one.
pub(super) fn terms(log_r: f64, prec: u32) -> Option<u64> {
    let wanted = -f64::from(prec) - 0.5 * log_r - 3.0;
    if log_r < LEAST {
        return None;
    }
    let most = log_r.exp2() as u64;
    let enough = |n: u64| remainder(n, log_r).turning <= wanted;
    if !enough(most) {
        return None;
    }
    let (mut low, mut high) = (0, 1);
    while !enough(high) {
        low = high;
        high = (2 * high).min(most);
    }
    while high - low > 1 {
        let mid = low + (high - low) / 2;
        if enough(mid) {
            high = mid;
        } else {
            low = mid;
        }
    }
    Some(high)
}

/// w (or w − e^{−z²}, first quadrant only) by components; `None` where the series does not reach
/// `prec` bits. `z.x` must not be negative.
pub(super) fn parts(z: &Argument, member: Member, prec: u32) -> Option<[Scaled; 2]> {
    let log_r = z.norm_log2() - SLACK;
    let n = terms(log_r, prec)?;
    let inner = prec + 24;
    let (x, y) = (z.x.ball(inner), z.y.ball(inner));
    let lower = z.y.is_negative();
    let h = y.abs();
    let norm = x.square() + h.square();

    // The series, per component divided by the small coordinate.
    let log_c = (log_r as u32).min(40);
    let (a, b) = (&x / &norm, &h / &norm);
    let (aa, bb) = (
        a.square().shift(log_c as i32),
        b.square().shift(log_c as i32),
    );
    let q2 = (&aa * &bb).shift(2);
    let bits = inner + (64 - n.leading_zeros());
    let (p, s) = fixed::sum(&(&aa - &bb), &q2, bits, n, |k| (2 * k + 1, 2 << log_c));
    let (p, s) = (p.with_prec(inner), s.with_prec(inner));
    let root_pi = Ball::pi(inner).sqrt();
    let re = (&b / &root_pi) * (&p + &(&aa * &s).shift(1));
    let im = (&a / &root_pi) * (&p - &(&bb * &s).shift(1));

    // Errors of Re and Im of S_N as an approximation of w(x + ih).
    let bound = remainder(n, log_r);
    let plain = power(bound.plain);
    let turning = power(bound.turning);
    let arc = |small: &Ball| {
        let r = z.norm.mignitude();
        // θ ≤ (π/2) sin θ = (π/2) small/|z|.
        let sine = small.magnitude().mul(small.magnitude()).div(r).sqrt();
        Mag::from_f64(FRAC_PI_2.next_up()).mul(sine)
    };
    let im_error = plain.min(arc(&x).mul(turning));

    let near_real = h.magnitude() < x.mignitude();
    // Is e^{−z²} needed at all?
    let absent = Mag::power_of_two(-i64::from(prec) - 8);
    let re_size = re.mignitude();
    // Above the diagonal e^{−z²} is no part of w, however large it is.
    if member == Member::W && !lower && (!near_real || plain <= absent.mul(re_size)) {
        return Some([
            Scaled::from(re.widened(plain)),
            Scaled::from(im.widened(im_error)),
        ]);
    }
    let e = if !z.y.is_zero() && negligible(z) <= absent.mul(re_size) {
        Gaussian::absent(negligible(z), inner)
    } else {
        // Digits of the exponent and of the angle 2xy.
        let wide = inner + (log_r as u32) + 16;
        Gaussian::new(&z.x.ball(wide), &z.y.ball(wide).abs(), inner)
    };
    if z.y.is_zero() {
        // S_N and the remainder contribute nothing to Re w. Im e^{−z²} is zero.
        let re = match member {
            Member::W => Scaled::new(e.c, e.k),
            Member::Dawson => Scaled::from(re),
        };
        return Some([re, Scaled::from(im.widened(im_error))]);
    }
    let zero = Integer::new();
    let by = (&e.k).max(&zero);
    let (ec, es) = e.relative_to(by);
    let down = Integer::from(-by);
    let scale = |b: &Ball| Scaled::shifted(b, &down);
    let (re, im) = (scale(&re), scale(&im));
    let scale = |m: Mag| m.shift(down.to_i64().unwrap_or(-REACH).max(-REACH));
    // |e^{−z²}| ≤ |c| + |s|, relative to 2^by.
    let gaussian = ec.magnitude().add(es.magnitude());
    let twice = z.norm.magnitude().shift(1).mul(gaussian);
    let beside = arc(&h).mul(scale(turning).add(twice));
    let with_gaussian = near_real && beside < scale(plain);
    let re_error = if with_gaussian { beside } else { scale(plain) };
    let im = im.widened(scale(im_error));
    let re = re.widened(re_error);
    let im = match (member, lower) {
        (Member::Dawson, _) => im + &es,
        (_, false) => im,
        (_, true) => es.shift(1) + &im,
    };
    let re = match (member, lower, with_gaussian) {
        (Member::Dawson, _, true) | (Member::W, false, false) => re,
        (Member::Dawson, _, false) => re - &ec,
        (_, false, true) => &ec + &re,
        (_, true, false) => ec.shift(1) - &re,
        (_, true, true) => ec - &re,
    };
    Some([Scaled::new(re, by.clone()), Scaled::new(im, by.clone())])
}

/// An upper bound on `|e^{−z²}| = e^{y²−x²}`, by a power of two: `e^{−g} ≤ 2^{−1.44 g}`.
fn negligible(z: &Argument) -> Mag {
    let gap = z.x.ball(BITS).square() - z.y.ball(BITS).square();
    if !gap.is_positive() {
        return Mag::INFINITY;
    }
    Mag::power_of_two(-((gap.mignitude().to_f64().min(3e8) * 1.44) as i64))
}

fn power(log2: f64) -> Mag {
    Mag::power_of_two(log2.ceil().max(-5e8) as i64)
}

#[cfg(test)]
mod tests;
