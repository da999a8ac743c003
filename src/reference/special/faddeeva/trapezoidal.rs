//! W by the corrected trapezoidal rule: a second, independent route, as a witness.
//!
//! # Rule
//! For Im z > 0, `w(z) = ∫ f(t) dt` with `f(t) = (i/π) e^{−t²}/(z − t)` (DLMF 7.7.2). Let
//! `t_k = (k + σ) h`, `T = h Σ f(t_k)`, `s = t/h − σ`. The function `π cot πs` has the residue h at
//! every node, so for a strip |Im t| < a
//!
//! ```text
//! T = (1/2πi) ∮ f π cot πs dt − [pole of f inside] Res_{t=z} f π cot πs
//! ```
//!
//! Above the real line `cot πs = −i (1 + 2q/(1−q))` with `q = e^{2πis}`, below it
//! `cot πs = i (1 + 2p/(1−p))` with `p = e^{−2πis}`. The ones give two halves of the integral,
//! moved back to the real line; the residue of f at z is `−(i/π) e^{−z²}`. Collecting everything,
//!
//! ```text
//! w(z) = T + [Im z < a] 2 e^{−z²}/(1 − e^{−2πi(z/h − σ)}) − ε
//! ε = ∫_{Im t = −b} f p/(1−p) dt + ∫_{Im t = a} f q/(1−q) dt
//! ```
//!
//! for any a ≠ Im z and b > 0 (the two lines may have different heights). By continuity this holds
//! for Im z = 0 as well if no node is z. The method is Goodwin's with the pole correction of
//! Chiarella and Reichel (*Math. Comp.* 22, 1968, 137) and Matta and Reichel (25, 1971, 339).
//!
//! # Error
//! Put A = π/h ≥ 2. On Im t = ±c: `|e^{−t²}| = e^{c² − u²}`, `|q|` or `|p|` is `e^{−2cA}`, and the
//! integral of `e^{−u²}` is √π. Take b = A (then |z − t| ≥ A). If Im z < 3A/4 take a = A, else a =
//! A/2: in both cases |z − t| ≥ A/4, and `c² − 2cA ≤ −3A²/4`, `e^{−2cA} ≤ e^{−A²} < 0.02`:
//!
//! ```text
//! |ε| ≤ (1/√π) (1/A + 4/A) e^{−3A²/4}/0.98 ≤ 1.5 e^{−3A²/4}
//! ```
//!
//! σ ∈ {0, 1/2} is chosen so that Re z is at least h/4 away from every node. Leaving out the nodes
//! with
//! |t_k| ≥ S then costs at most
//! `(h/π) (4/h) Σ e^{−t_k²} ≤ (8/π) e^{−S²} (1 + 1/(2hS))`, the sum being bounded by its first term
//! and an integral, `∫_S^∞ e^{−t²} dt ≤ e^{−S²}/(2S)`, on either side.

use crate::{Ball, ComplexBall, Mag};
use rug::{Float, Rational};
use std::f64::consts::FRAC_2_PI;

/// An enclosure of w(z), z = re + i im, with an absolute error of about 2^-prec times
/// `max(1, |e^{−z²}|)`.
pub fn w(re: &Rational, im: &Rational, prec: u32) -> ComplexBall {
    let size = |q: &Rational| Float::with_val(32, q).get_exp().unwrap_or(0).max(0) as u32;
    // Bits of z that exp(−z²) needs, and then some.
    let inner = prec + 48 + 2 * size(re).max(size(im));
    let z = ComplexBall::rational(inner, re, im);
    if *im < 0 {
        // w(z) = 2e^{−z²} − w(−z)
        let twice = (-&z.square()).exp();
        let two = Ball::integer(inner, 2);
        return &twice.scaled(&two) - &upper(&-&z, prec, inner);
    }
    upper(&z, prec, inner)
}

fn upper(z: &ComplexBall, prec: u32, inner: u32) -> ComplexBall {
    // 3A²/4 ≥ (prec + 4) ln 2 and A ≥ 2, by an exact h a little smaller than π/A.
    let wanted = (4.0 / 3.0 * f64::from(prec + 4) * std::f64::consts::LN_2).sqrt();
    let h64 = std::f64::consts::PI / (wanted.max(2.0) * (1.0 + 1e-9));
    let h = Ball::exact(inner, h64);
    let a = &Ball::pi(inner) / &h;

    // σ: z/h at least a quarter from every node.
    let position = &z.re / &h;
    let nearest = Float::with_val(inner, position.mid().round_ref());
    let offset = &position - &Ball::new(nearest, Mag::ZERO);
    let half = offset.magnitude() <= Mag::from_f64(0.25);
    let (sigma, distance) = if half {
        let distance = Mag::from_f64(0.5).sub_below(offset.magnitude());
        (Rational::from((1, 2)), distance)
    } else {
        (Rational::new(), offset.mignitude())
    };

    // Nodes ±t_k, k + σ > 0, weights by g' = g r, r' = r e^{−2h²}.
    let count = ((f64::from(prec + 8) * std::f64::consts::LN_2).sqrt() / h64).ceil() as u32 + 1;
    let hh = h.square();
    let s = Ball::rational(inner, &sigma);
    let mut t = &s * &h;
    let mut g = (-(s.square() * &hh)).exp();
    let two = Ball::integer(inner, 2);
    let mut r = (-((&two * &s + &Ball::integer(inner, 1)) * &hh)).exp();
    let shrink = (-(&two * &hh)).exp();
    let mut sum = ComplexBall::zero(inner);
    let zz = z.square();
    for k in 0..count {
        // 1/(z−t) + 1/(z+t) = 2z/(z² − t²); the node 0 counts once.
        let below = ComplexBall::new(&zz.re - &t.square(), zz.im.clone());
        let weight = if k == 0 && !half {
            g.clone()
        } else {
            g.shift(1)
        };
        let term = ComplexBall::new(weight, Ball::integer(inner, 0)).div(&below);
        sum = &sum + &term;
        t = t + &h;
        g = g * &r;
        r = r * &shrink;
    }
    // t is now the first node left out.
    let last = t.lower();
    let reach = Ball::new(last, Mag::ZERO);
    let e = (-reach.square()).exp().magnitude();
    let step = (&h * &reach).shift(1).mignitude();
    // In units of the actual distance d h instead of h/4: 1/(πd) per unit of the two sums.
    let tail = e
        .mul(Mag::from_f64(1.0).add(Mag::from_f64(1.0).div(step)))
        .mul(Mag::from_f64(FRAC_2_PI.next_up()))
        .div(distance);
    let rule = (-(a.square() * &Ball::exact(inner, 0.75)))
        .exp()
        .magnitude();
    let error = tail.add(rule.mul(Mag::from_f64(1.5)));

    // (i h/π) z Σ
    let factor = &h / &Ball::pi(inner);
    let mut w = (z * &sum).scaled(&factor).turned();
    let border = &a * &Ball::exact(inner, 0.75);
    // Certainly below, or certainly not; in between both are allowed by the bound (|y − a| ≥ A/4
    // holds up to the width of the ball), so the midpoint decides.
    if z.im.mid() < border.mid() {
        let turn = ComplexBall::new(&position - &s, &z.im / &h).scaled(&Ball::pi(inner).shift(1));
        // e^{−2πi s} = exp of (2π Im s − 2πi Re s)
        let e = ComplexBall::new(turn.im.clone(), -turn.re).exp();
        let one = ComplexBall::new(Ball::integer(inner, 1), Ball::integer(inner, 0));
        let gauss = (-&zz).exp().scaled(&two);
        w = &w + &gauss.div(&(&one - &e));
    }
    w.widened(error)
}

#[cfg(test)]
mod tests {
    use super::super::tests::q;
    use super::*;
    use std::f64::consts::{LN_2, PI};

    /// Both errors of the head, from the step, the nearest node and the first node left out.
    fn bound(x: f64, prec: u32) -> f64 {
        let a = (4.0 / 3.0 * f64::from(prec + 4) * LN_2).sqrt().max(2.0) * (1.0 + 1e-9);
        let h = PI / a;
        let off = (x / h - (x / h).round()).abs();
        let (sigma, distance) = if off <= 0.25 {
            (0.5, 0.5 - off)
        } else {
            (0.0, off)
        };
        let count = ((f64::from(prec + 8) * LN_2).sqrt() / h).ceil() + 1.0;
        let s = (count + sigma) * h;
        let tail = 2.0 / (PI * distance) * (-s * s).exp() * (1.0 + 1.0 / (2.0 * h * s));
        tail + 1.5 * (-0.75 * a * a).exp()
    }

    /// The radius is the bound of the head, no less and no more, and keeps what is promised.
    #[test]
    fn the_radius_is_the_bound() {
        for prec in (0..150).step_by(7) {
            for (x, y) in [
                (0.0, 1.0),
                (0.3, 0.5),
                (0.5, 12.0),
                (1.71875, 3.0),
                (9.0, 1.0),
            ] {
                let r = w(&q(x), &q(y), prec).re.rad().to_f64();
                let ratio = r / bound(x, prec);
                assert!(
                    (1.0 - 1e-9..1.0 + 1e-8).contains(&ratio),
                    "{prec} {x} {y}: {ratio}"
                );
                assert!(r <= (-f64::from(prec)).exp2(), "{prec} {x} {y}: {r}");
            }
        }
    }

    /// Few bits, so that the rule's own error shows: beside its nodes, on either side of the border
    /// and of the real line.
    #[test]
    fn few_bits_hold_what_many_find() {
        let a = (4.0 / 3.0 * 12.0 * LN_2).sqrt();
        let mut heights = vec![0.0, 1e-9, 0.4];
        heights.extend([0.3, 0.5, 0.74, 0.76, 0.99, 1.01, 1.3, 1.49, 2.0].map(|k| k * a));
        for x in [0.0, 0.1, 0.235, 0.25, 0.47, 0.7, 0.94, 2.0] {
            for y in &heights {
                for y in [*y, -y] {
                    let (coarse, fine) = (w(&q(x), &q(y), 8), w(&q(x), &q(y), 90));
                    assert!(
                        coarse.re.contains_ball(&fine.re),
                        "{x} {y}: {coarse:?} {fine:?}"
                    );
                    assert!(
                        coarse.im.contains_ball(&fine.im),
                        "{x} {y}: {coarse:?} {fine:?}"
                    );
                }
            }
        }
    }

    /// `e^{−z²}` of `e^(2^28)` keeps its bits.
    #[test]
    fn far_below_the_radius_is_relative() {
        let (x, y) = (q(0.25), q(-16_384.5));
        let found = w(&x, &y, 60);
        let z = ComplexBall::rational(400, &x, &y);
        let due = (-&z.square()).exp().scaled(&Ball::integer(400, 2));
        assert!(due.magnitude().is_finite() && found.overlaps(&due));
        assert!(found.radius() <= due.magnitude().shift(-60));
    }
}
