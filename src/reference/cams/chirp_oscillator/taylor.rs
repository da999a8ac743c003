//! The convolution integral (1) by Taylor panels.
//!
//! With `P = K h`, `Q = K′h`, `h = e^{i(ωs − κs²/2)}` and `q(s) = ω − κs`
//!
//! ```text
//! P′ = Q + iqP,   Q′ = −2nQ − w²P + iqQ                                                  (2)
//! ```
//!
//! so the coefficients about the centre of a panel follow by recurrence from the values of K, K′
//! and h there, which are elementary; `A = w² ∫P` and, for `ψ′ = Ȧ e^{−iθ}`, `Ȧ = w² ∫Q`. Panels
//! only add: no error is carried from one to the next.
//!
//! # Tail
//! For complex σ with `|σ| ≤ R` the norm of `u = (wP, Q)` grows along the ray from the centre c at
//! most by the rate `w + 2n + |q(c)| + κR` (the matrix of (2) in these variables is `[0, w; −w,
//! −2n] + iq`), so `|u(c + σ)| ≤ B = |u(c)| e^{(w + 2n + |q(c)| + |κ|R) R}` and, by Cauchy's
//! estimate, `|u_m| ≤ B R^{−m}`. What a panel of half-width `h < R` leaves out of its integral when
//! M terms are kept is at most `2h B (h/R)^M / ((M + 1)(1 − h/R))`.

use super::free::impulse;
use super::parts::Parts;
use super::problem::{Problem, Response};
use crate::{Ball, ComplexBall, Mag, Undecided};
use rug::Rational;

/// Most panels that are tried.
const PANELS: f64 = 200_000.0;

/// The response by Taylor panels at a working precision of `prec` bits; nothing is promised about
/// the radii.
///
/// # Errors
/// [`Undecided`] where more than 200 000 panels would be needed: the cost is proportional to
/// `(w + 2n + |ω|) t`.
pub fn enclose(problem: &Problem, prec: u32) -> Result<Response, Undecided> {
    let (amplitude, rate) = convolution(problem, prec)?;
    Ok(Parts::new(problem, prec, &amplitude, &rate).response())
}

/// A number near `q`, for choices that need no proof.
fn about(q: &Rational) -> f64 {
    q.to_f64()
}

fn convolution(p: &Problem, prec: u32) -> Result<(ComplexBall, ComplexBall), Undecided> {
    let mut sums = (ComplexBall::zero(prec), ComplexBall::zero(prec));
    if p.t == 0 {
        return Ok(sums);
    }
    let (nu, kappa) = (p.nu(), p.kappa());
    let omega = Rational::from(&kappa * &p.t) + &nu;
    let speed = about(&nu).abs().max(about(&omega).abs());
    let rate = about(&p.w) + 2.0 * about(&p.n) + speed;
    // Panels of a phase of about a sixth of the digits, in nats, take the fewest operations. The
    // sweep asks for no more: κt is at most twice the speed.
    let phase = (f64::from(prec) * 0.12).clamp(4.0, 200.0);
    let panels = (rate * about(&p.t) / (2.0 * phase)).ceil().max(1.0);
    if !(panels <= PANELS) {
        return Err(Undecided::new(
            prec,
            format!("{panels} Taylor panels are too many"),
        ));
    }
    let panels = panels as u32;
    let half = Rational::from(&p.t / (2 * panels));
    for j in 0..panels {
        let centre = Rational::from(&half * (2 * j + 1));
        let (a, b) = panel(p, &omega, &kappa, &centre, &half, prec);
        sums = (&sums.0 + &a, &sums.1 + &b);
    }
    Ok(sums)
}

/// `∫P` and `∫Q` over the panel.
fn panel(
    p: &Problem,
    omega: &Rational,
    kappa: &Rational,
    centre: &Rational,
    half: &Rational,
    prec: u32,
) -> (ComplexBall, ComplexBall) {
    // The recurrence cancels as e^{(rate) h} does; a few bits more than that are kept.
    let q = Rational::from(omega - &Rational::from(kappa * centre));
    let rate = about(&p.w) + 2.0 * about(&p.n) + about(&q).abs();
    let h = about(half);
    let growth = rate * h + about(kappa).abs() * h * h;
    let work = prec + (growth * 1.5) as u32 + 24;
    let real = |x: &Rational| Ball::rational(work, x);

    let (k, slope) = impulse(p, centre, work);
    let angle = Rational::from(centre * omega) - Rational::from(centre.square_ref()) * kappa / 2u32;
    let unit = ComplexBall::unit(&real(&angle));
    let (mut before, mut here) = (
        (ComplexBall::zero(work), ComplexBall::zero(work)),
        (unit.scaled(&k), unit.scaled(&slope)),
    );

    let (terms, ratio) = plan(rate, about(kappa).abs(), h, f64::from(prec) + 8.0);
    let tail = Tail {
        start: norm(p, &here),
        rate: growth_rate(p, &q),
        kappa: real(kappa).magnitude(),
        half: real(half).magnitude(),
        ratio,
    };

    let (stiffness, twice) = (
        real(&Rational::from(p.w.square_ref())),
        real(&Rational::from(&p.n * 2)),
    );
    let (kappa, q, step) = (real(kappa), real(&q), real(half));
    // Terms scaled by h^m, so that all are of the size of their contribution.
    let (stiffness, twice, q) = (&stiffness * &step, &twice * &step, &q * &step);
    let sweep = &kappa * step.square();
    let mut sums = (ComplexBall::zero(work), ComplexBall::zero(work));
    let limit = Mag::power_of_two(-i64::from(prec)).mul(tail.start);
    let mut m: i64 = 0;
    loop {
        if m % 2 == 0 {
            let share = Ball::integer(work, m + 1);
            let by = |x: &ComplexBall| ComplexBall::new(&x.re / &share, &x.im / &share);
            sums = (&sums.0 + &by(&here.0), &sums.1 + &by(&here.1));
        }
        m += 1;
        if m as f64 >= terms && m % 8 == 0 {
            let bound = tail.after(m);
            if bound <= limit || m as f64 > 2.0 * terms {
                let twice = real(half).shift(1);
                // ∫ over [−h, h] of s^m is 2h^{m+1}/(m + 1) for even m.
                let integral = |x: &ComplexBall, extra: Mag| {
                    let x = x.scaled(&twice).widened(extra);
                    ComplexBall::new(x.re.with_prec(prec), x.im.with_prec(prec))
                };
                // |wP| ≤ |u|.
                let low = Mag::below(real(&p.w).mid()).sub_below(real(&p.w).rad());
                return (integral(&sums.0, bound.div(low)), integral(&sums.1, bound));
            }
        }
        let share = Ball::integer(work, m);
        let chirp =
            |now: &ComplexBall, old: &ComplexBall| (&now.scaled(&q) - &old.scaled(&sweep)).turned();
        let a = &here.1.scaled(&step) + &chirp(&here.0, &before.0);
        let b = &(&chirp(&here.1, &before.1) - &here.1.scaled(&twice)) - &here.0.scaled(&stiffness);
        let by = |x: ComplexBall| ComplexBall::new(&x.re / &share, &x.im / &share);
        before = std::mem::replace(&mut here, (by(a), by(b)));
    }
}

/// An upper bound on `w + 2n + |q|`.
fn growth_rate(p: &Problem, q: &Rational) -> Mag {
    let size = |x: &Rational| Ball::rational(64, x).magnitude();
    size(&p.w).add(size(&p.n).shift(1)).add(size(q))
}

/// The number of terms that should do for `bits` bits, and `R/h`.
///
/// The tail is about `e^{(rate + κR) R} (h/R)^M`, smallest where `rate R + 2κR² = M`.
fn plan(rate: f64, kappa: f64, h: f64, bits: f64) -> (f64, f64) {
    let mut terms = 8.0;
    loop {
        let radius = 2.0 * terms / (rate + (rate * rate + 8.0 * kappa * terms).sqrt());
        let ratio = (radius / h).clamp(2.0, 1e15).floor();
        let grown = (rate + kappa * ratio * h) * ratio * h * std::f64::consts::LOG2_E;
        if terms * ratio.log2() - grown > bits || terms > 1e5 {
            return (terms, ratio);
        }
        terms = (terms * 1.05).ceil();
    }
}

/// An upper bound on `|(wP, Q)|`.
fn norm(p: &Problem, (a, b): &(ComplexBall, ComplexBall)) -> Mag {
    let w = Ball::rational(64, &p.w).magnitude();
    let (a, b) = (a.magnitude().mul(w), b.magnitude());
    a.mul(a).add(b.mul(b)).sqrt()
}

struct Tail {
    start: Mag,
    rate: Mag,
    kappa: Mag,
    half: Mag,
    /// `R/h`, a whole number of at least two.
    ratio: f64,
}

impl Tail {
    /// Bounds the rest of the integral after m terms.
    fn after(&self, m: i64) -> Mag {
        let radius = self.half.mul(Mag::from_f64(self.ratio));
        let exponent = self.rate.add(self.kappa.mul(radius)).mul(radius);
        let grown = Ball::new(exponent.to_float(), Mag::ZERO).exp().magnitude();
        // 1/(1 − h/R) ≤ 2.
        let mut power = Mag::from_f64(1.0);
        let small = Mag::from_f64(1.0).div(Mag::from_f64(self.ratio));
        for _ in 0..m {
            power = power.mul(small);
        }
        self.start.mul(grown).mul(power).mul(self.half).shift(2)
    }
}

#[cfg(test)]
mod tests;
