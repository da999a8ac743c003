//! Fourier coefficients of a cam cycle, from its corners: where one zone or piece of its laws goes
//! over into the next.
//!
//! The coefficient n of a stroke of B turns is the transform of its law (`fourier_transform.rs`) at
//! `q = 2nB`. From one harmonic to the next each corner turns by the same angle.

use super::cam_law::{Form, Law};
use super::fourier_transform::{Transform, by_jumps, cis};
use crate::ball::Ball;
use crate::complex::ComplexBall;
use crate::mag::Mag;
use rug::Rational;
use std::f64::consts::PI;

/// A rise or a return.
#[derive(Clone, Debug)]
pub struct Stroke {
    /// Its law.
    pub law: Law,
    /// Where it starts, in turns.
    pub start: Rational,
    /// How long it is, in turns.
    pub turns: Rational,
}

/// Equally spaced harmonics.
#[derive(Clone, Copy, Debug)]
pub struct Orders {
    /// The first.
    pub first: u32,
    /// From one to the next.
    pub stride: u32,
    /// How many.
    pub count: u32,
}

impl Orders {
    fn iter(self) -> impl Iterator<Item = u32> {
        (0..self.count).map(move |k| self.first + k * self.stride)
    }
}

/// `e^{−2πin(start + B x_k)}` at each corner, and what it turns by from one harmonic to the next.
struct Phases {
    now: Vec<ComplexBall>,
    step: Vec<ComplexBall>,
}

impl Phases {
    fn new(stroke: &Stroke, corners: &[&Rational], orders: Orders, bits: u32) -> Phases {
        let turned = |n: u32| -> Vec<ComplexBall> {
            let place = |x: &&Rational| Rational::from(&stroke.turns * *x) + &stroke.start;
            let corners = corners.iter().map(place);
            corners
                .map(|place| cis(&-(place * n * 2u32), bits))
                .collect()
        };
        Phases {
            now: turned(orders.first),
            step: match orders.count {
                0 | 1 => Vec::new(),
                _ => turned(orders.stride),
            },
        }
    }

    fn advance(&mut self) {
        for (now, step) in self.now.iter_mut().zip(&self.step) {
            *now = &*now * step;
        }
    }
}

/// About as many bits as the terms of the integration by parts are greater than one: at most
/// `bits`.
fn guard(law: &Law, q: f64, bits: u32) -> u32 {
    let Form::Pieces(pieces) = &law.0 else {
        return 0;
    };
    let mut lost = 0.0f64;
    for piece in pieces {
        let width = Rational::from(&piece.end - &piece.start).to_f64();
        let mut p: Vec<f64> = piece
            .coefficients
            .iter()
            .map(|c| c.to_f64().abs())
            .collect();
        for j in 1..p.len() {
            // The next derivative of Σ |c_k| x^k, greatest at the end of the piece.
            p.remove(0);
            for (k, c) in p.iter_mut().enumerate() {
                *c *= k as f64 + 1.0;
            }
            let most = p.iter().rev().fold(0.0, |sum, c| sum * width + c);
            lost = lost.max(most.log2() - j as f64 * (PI * q).log2());
        }
    }
    (lost.ceil() as u32).min(bits)
}

/// `∫ f' e^{−inθ} dθ` of a stroke of height one, for each of the harmonics.
fn shares(stroke: &Stroke, orders: Orders, bits: u32) -> Vec<ComplexBall> {
    let q = 2.0 * stroke.turns.to_f64() * f64::from(orders.first);
    let bits = bits + guard(&stroke.law, q, bits);
    let law = Transform::new(&stroke.law, bits);
    let mut phases = Phases::new(stroke, &law.corners, orders, bits);
    let share = |n: u32| {
        let q = Rational::from(&stroke.turns * n) * 2u32;
        let share = law.at(&q, &phases.now, bits);
        phases.advance();
        share
    };
    orders.iter().map(share).collect()
}

/// `lift/πn`.
fn scale(lift: &Rational, n: u32, bits: u32) -> Ball {
    Ball::rational(bits, &Rational::from(lift / n)) / Ball::pi(bits)
}

/// `a_n` and `b_n` of a cycle that rises by `lift` and, unless it is carried on, returns.
pub fn harmonics(
    lift: &Rational,
    rise: &Stroke,
    fall: Option<&Stroke>,
    orders: Orders,
    bits: u32,
) -> Vec<[Ball; 2]> {
    let mut sums = shares(rise, orders, bits);
    if let Some(fall) = fall {
        for (up, down) in sums.iter_mut().zip(shares(fall, orders, bits)) {
            *up = &*up - &down;
        }
    }
    let coefficients = |(n, z): (u32, ComplexBall)| {
        let scale = scale(lift, n, bits);
        [z.im, z.re].map(|part| part.with_prec(bits) * &scale)
    };
    orders.iter().zip(sums).map(coefficients).collect()
}

/// `Σ_j |x_j ∂f/∂x_j|` over the inner knots and ordinates of a stroke whose law is a clamped
/// spline: of the mean, and of each `a_n` and `b_n`.
///
/// All are linear in the law, so their derivatives are those of its variations
/// (`Law::spline_variations`).
pub fn data_conditions(
    lift: &Rational,
    stroke: &Stroke,
    orders: Orders,
    bits: u32,
) -> (Mag, Vec<[Mag; 2]>) {
    let variations = stroke.law.spline_variations(bits);
    let length = Ball::rational(bits, &Rational::from(lift * &stroke.turns));
    let mean = variations.iter().fold(Mag::ZERO, |sum, v| {
        sum.add((&length * &v.integral * &v.datum).magnitude())
    });
    let law = Transform::new(&stroke.law, bits);
    let mut phases = Phases::new(stroke, &law.corners, orders, bits);
    let at = |n: u32| {
        let q = Rational::from(&stroke.turns * n) * 2u32;
        let angle = Ball::pi(bits) * Ball::rational(bits, &q);
        let scale = scale(lift, n, bits);
        let mut sums = [Mag::ZERO; 2];
        for v in &variations {
            let z = by_jumps(&v.jumps, &angle, &phases.now);
            let factor = &scale * &v.datum;
            for (sum, part) in sums.iter_mut().zip([z.im, z.re]) {
                *sum = sum.add((part * &factor).magnitude());
            }
        }
        phases.advance();
        sums
    };
    (mean, orders.iter().map(at).collect())
}

/// `a_0`; of a cycle without a return that of `f − lift · θ/2π` with `f = 0` where it starts.
pub fn mean(lift: &Rational, rise: &Stroke, fall: Option<&Stroke>, bits: u32) -> Ball {
    let ball = |r: &Rational| Ball::rational(bits, r);
    let rising = ball(&rise.turns) * rise.law.mean(bits);
    let top = Rational::from(&rise.start + &rise.turns);
    let sum = match fall {
        Some(fall) => {
            let dwell = ball(&Rational::from(&fall.start - &top));
            let falling = ball(&fall.turns) * (Ball::integer(bits, 1) - fall.law.mean(bits));
            rising + dwell + falling
        }
        None => {
            let floor = Rational::from(rise.start.floor_ref());
            let since = Rational::from(&rise.start - &floor);
            let rest = Rational::from((1, 2)) - since - &rise.turns;
            rising + ball(&rest)
        }
    };
    sum * ball(lift)
}

/// `∫_0^1 s' e^{−iqx} dx` by the Taylor series of the exponential, for small `q` in radians: the
/// remainder after `terms` terms is at most `q^terms/terms! · ∫|s'|`, with `s' ≥ 0` given.
#[cfg(test)]
fn by_moments(moments: &[Ball], q: &Ball, bits: u32) -> ComplexBall {
    let mut sum = ComplexBall::zero(bits);
    let mut term = ComplexBall::new(Ball::integer(bits, 1), Ball::integer(bits, 0));
    for (k, m) in moments.iter().enumerate() {
        sum = &sum + &term.scaled(m);
        let next = q / Ball::integer(bits, k as i64 + 1);
        // Times −iq/(k+1).
        term = -&term.turned().scaled(&next);
    }
    sum.widened(term.magnitude())
}

#[cfg(test)]
mod tests;
