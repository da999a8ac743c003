//! The transform `∫_0^1 s' e^{−iπqx} dx` of a law of motion over its stroke.
//!
//! Polynomial pieces are integrated by parts to the end,
//!
//! ```text
//! ∫ s' e^{−iπqx} dx = Σ_k e^{−iπq x_k} Σ_j [s^(j)](x_k)/(iπq)^j
//! ```
//!
//! with the jumps `[s^(j)]` of the derivatives, `s` being constant outside the stroke. The velocity
//! of an SCCA law vanishes at both ends, `∫ s' e^{−iπqx} dx = (1/iπq) ∫ s'' e^{−iπqx} dx`, and over
//! a zone of it
//!
//! ```text
//! ∫ cos(πr(x − x*)) e^{−iπqx} dx = e^{−iπqx} (iq cos πr(x − x*) − r sin πr(x − x*))/π(q² − r²)
//! ```
//!
//! between its ends. Near resonance, `q ≈ ±r`, it is `½ Σ_± ∫ e^{±iπr(x−x*) − iπqx} dx` instead,
//! and `∫ e^{iπκx} dx` over a width `w` about `m` is `w e^{iπκm} sinc(πκw/2)`. All `q`, `r` and `κ`
//! are rational, so phases are reduced exactly and resonance (`κ = 0`) is decided.

use super::cam_law::{Form, Law, Zone, derivatives, derivatives_at_zero};
use crate::ball::Ball;
use crate::complex::ComplexBall;
use rug::Rational;

/// `x mod 2`, in `[−1, 1)`.
fn half_turns(x: &Rational) -> Rational {
    let shifted = Rational::from(x + 1u32) / 2u32;
    let floor = Rational::from(shifted.floor_ref());
    (shifted - floor) * 2u32 - 1u32
}

/// `e^{iπx}`.
pub(super) fn cis(x: &Rational, bits: u32) -> ComplexBall {
    ComplexBall::unit(&(Ball::pi(bits) * Ball::rational(bits, &half_turns(x))))
}

/// `∫ e^{iπκx} dx` between two places.
fn exponential(kappa: &Rational, from: &Rational, to: &Rational, bits: u32) -> ComplexBall {
    let width = Rational::from(to - from);
    let mid = Rational::from(from + to) / 2u32;
    let phase = cis(&Rational::from(kappa * &mid), bits);
    let argument = Rational::from(kappa * &width) / 2u32;
    let length = Ball::rational(bits, &width);
    if argument == 0 {
        return phase.scaled(&length);
    }
    let sine = cis(&argument, bits).im;
    let pi = Ball::pi(bits) * Ball::rational(bits, &argument);
    phase.scaled(&(length * sine / pi))
}

/// `∫ e^{−iπq(x − start)} cos(πr(x − origin)) dx` over a zone, for any `q`.
pub(super) fn near_resonance(zone: &Zone, q: &Rational, bits: u32) -> ComplexBall {
    let (start, width) = (Rational::new(), Rational::from(&zone.end - &zone.start));
    let origin = Rational::from(&zone.origin - &zone.start);
    let side = |r: &Rational| {
        let kappa = Rational::from(r - q);
        let turn = cis(&-Rational::from(r * &origin), bits);
        &turn * &exponential(&kappa, &start, &width, bits)
    };
    let minus = -zone.frequency.clone();
    let sum = &side(&zone.frequency) + &side(&minus);
    ComplexBall::new(sum.re.shift(-1), sum.im.shift(-1))
}

/// Bits that `q ± r` may lose by cancellation before the formula for resonance is taken.
const CANCELLED: i64 = 24;

/// A zone between corners `left` and `left + 1`.
struct Wave<'a> {
    zone: &'a Zone,
    left: usize,
    amplitude: Ball,
    frequency: Ball,
    /// `cos πr(x − x*)` and `r sin πr(x − x*)` at both ends.
    ends: [(Ball, Ball); 2],
}

impl Wave<'_> {
    fn new(zone: &Zone, left: usize, bits: u32) -> Wave<'_> {
        let frequency = Ball::rational(bits, &zone.frequency);
        let ends = [&zone.start, &zone.end].map(|x| {
            let phase = Rational::from(x - &zone.origin) * &zone.frequency;
            let ComplexBall { re, im } = quarter(&phase, bits).unwrap_or_else(|| cis(&phase, bits));
            (re, im * &frequency)
        });
        Wave {
            zone,
            left,
            amplitude: Ball::rational(bits, &zone.amplitude),
            frequency,
            ends,
        }
    }

    /// Adds the zone's `π ∫ s'' e^{−iπqx} dx`, with the phases of the corners.
    fn add_to(&self, sum: &mut ComplexBall, q: &Rational, phases: &[ComplexBall]) {
        let bits = self.amplitude.prec();
        let ball = Ball::rational(bits, q);
        let gaps = [&ball - &self.frequency, &ball + &self.frequency];
        let little = ball.magnitude().shift(-CANCELLED);
        let cancelled = |gap: &Ball| gap.mignitude() <= little;
        if gaps.iter().any(cancelled) {
            let whole =
                near_resonance(self.zone, q, bits).scaled(&(Ball::pi(bits) * &self.amplitude));
            *sum = &*sum + &(&whole * &phases[self.left]);
            return;
        }
        let share = &self.amplitude / (&gaps[0] * &gaps[1]);
        let turning = &share * &ball;
        let [from, to] = [0, 1].map(|end| {
            let (cosine, sine) = &self.ends[end];
            let value = ComplexBall::new(-(sine * &share), cosine * &turning);
            &value * &phases[self.left + end]
        });
        *sum = &*sum + &(&to - &from);
    }
}

/// `e^{iπx}` where both parts are −1, 0 or 1.
fn quarter(x: &Rational, bits: u32) -> Option<ComplexBall> {
    let x = half_turns(x) * 2u32;
    let (re, im) = match (*x.denom() == 1).then(|| x.numer().to_i32())?? {
        0 => (1, 0),
        1 => (0, 1),
        -1 => (0, -1),
        _ => (-1, 0),
    };
    Some(ComplexBall::new(
        Ball::integer(bits, re),
        Ball::integer(bits, im),
    ))
}

/// The contributions of a law at its corners.
enum Parts<'a> {
    /// Jumps of the derivatives from the first on, at each corner.
    Jumps(Vec<Vec<Ball>>),
    /// The zones, and what they reach.
    Waves(Vec<Wave<'a>>, Ball),
}

/// A law ready for any `q`.
pub(super) struct Transform<'a> {
    pub(super) corners: Vec<&'a Rational>,
    parts: Parts<'a>,
}

impl Transform<'_> {
    pub(super) fn new(law: &Law, bits: u32) -> Transform<'_> {
        let mut corners: Vec<&Rational> = Vec::new();
        // The number of the corner where a part begins; it ends at the next.
        let mut between = |start, end| {
            if corners.last() != Some(&start) {
                corners.push(start);
            }
            corners.push(end);
            corners.len() - 2
        };
        let parts = match &law.0 {
            Form::Zones(zones) => {
                let waves = zones
                    .iter()
                    .map(|zone| Wave::new(zone, between(&zone.start, &zone.end), bits));
                Parts::Waves(waves.collect(), law.reached(bits))
            }
            Form::Pieces(pieces) => {
                let mut jumps: Vec<Vec<Rational>> = Vec::new();
                for piece in pieces {
                    let left = between(&piece.start, &piece.end);
                    jumps.resize_with(left + 2, Vec::new);
                    let width = Rational::from(&piece.end - &piece.start);
                    add_jumps(&mut jumps[left], derivatives_at_zero(&piece.coefficients));
                    let end = derivatives(&piece.coefficients, &width);
                    add_jumps(&mut jumps[left + 1], end.into_iter().map(|d| -d));
                }
                let balls = |j: &Vec<Rational>| j.iter().map(|j| Ball::rational(bits, j)).collect();
                Parts::Jumps(jumps.iter().map(balls).collect())
            }
        };
        Transform { corners, parts }
    }

    /// `e^{−iπp} ∫_0^1 s' e^{−iπqx} dx`, `q ≠ 0`, with the phases `e^{−iπ(p + q x_k)}` of the
    /// corners.
    pub(super) fn at(&self, q: &Rational, phases: &[ComplexBall], bits: u32) -> ComplexBall {
        let pi = Ball::pi(bits);
        let angle = &pi * Ball::rational(bits, q);
        match &self.parts {
            Parts::Jumps(jumps) => by_jumps(jumps, &angle, phases),
            Parts::Waves(waves, reached) => {
                let mut sum = ComplexBall::zero(bits);
                for wave in waves {
                    wave.add_to(&mut sum, q, phases);
                }
                let iq = angle * pi * reached;
                // Division by i.
                -&sum.scaled(&iq.recip()).turned()
            }
        }
    }
}

/// Adds derivatives, of which the zeroth does not count.
fn add_jumps(jumps: &mut Vec<Rational>, derivatives: impl IntoIterator<Item = Rational>) {
    for (k, d) in derivatives.into_iter().skip(1).enumerate() {
        match jumps.get_mut(k) {
            Some(jump) => *jump += d,
            None => jumps.push(d),
        }
    }
}

/// `Σ_k phase_k Σ_j jump_kj/(iπq)^j`, with `πq` given.
pub(super) fn by_jumps(jumps: &[Vec<Ball>], angle: &Ball, phases: &[ComplexBall]) -> ComplexBall {
    let bits = angle.prec();
    let inverse = angle.recip();
    let longest = jumps.iter().map(Vec::len).max().unwrap_or(0);
    let mut powers = vec![inverse.clone()];
    while powers.len() < longest {
        powers.push(&powers[powers.len() - 1] * &inverse);
    }
    let mut sum = ComplexBall::zero(bits);
    for (jumps, phase) in jumps.iter().zip(phases) {
        // 1/i, 1/i², …: −i, −1, i, 1.
        let mut value = ComplexBall::zero(bits);
        for (k, (jump, power)) in jumps.iter().zip(&powers).enumerate() {
            if jump.is_zero() {
                continue;
            }
            let term = jump * power;
            match k % 4 {
                0 => value.im = value.im - term,
                1 => value.re = value.re - term,
                2 => value.im = value.im + term,
                _ => value.re = value.re + term,
            }
        }
        sum = &sum + &(&value * phase);
    }
    sum
}

#[cfg(test)]
mod tests;
