//! The Fourier transform of a stroke's velocity,
//!
//! ```text
//! F(q) = ∫_0^1 s'(x) e^{−iq(x − x_c)} dx,   q = 2π n B,
//! ```
//!
//! about the centre `x_c`, the place of the largest velocity of a law with two halves and the
//! middle of the stroke of any other. `F(0) = 1`.
//!
//! For `q < 2π`, and for laws with a short half up to where the jumps are small, it is integrated
//! numerically, piece by piece: `s' ≥ 0` and nothing cancels. Beyond, parts are integrated until
//! only the jumps of derivatives are left,
//!
//! ```text
//! F = Σ_knots e^{−iq(x_k − x_c)} Σ_j (jump of s^(j) at x_k) / (iq)^j,
//! ```
//!
//! of which the first ones, where all derivatives are continuous, are left out and not subtracted.
//! An SCCA law has infinitely many jumps at the ends of its sines, whose sum is
//!
//! ```text
//! F = −(C_a/q²) { [e^{iλq} C̄(2λ t_b) − C(2λ t_d)]/(2λ)
//!               + [e^{−iμq} C(2μ t_b) − C̄(2μ t_d)]/(2μ) },
//! C(t) = π ∫_0^{1/2} cos(πy) e^{2πity} dy = (e^{πit} − 2it)/(1 − 4t²),
//! t_b = qb/2π, t_d = qd/2π, μ = 1 − λ.
//! ```

use super::quadrature::integral;
use super::turns::Turns;
use crate::cam_law::{MotionLaw, Scca, Shape};
use crate::double_double::{Dd, two_sum};
use num_complex::Complex64;
use std::f64::consts::{PI, TAU};

/// Turns of a harmonic up to which two strokes are short: their shares are next to each other.
pub(super) const SHORT: f64 = 0.125;

/// The jumps of derivatives at one place of the stroke.
#[derive(Clone, Debug)]
pub(super) struct Knot {
    pub(super) place: f64,
    /// `jumps[j − 1]` is that of `s^(j)`.
    pub(super) jumps: Vec<f64>,
}

#[derive(Clone, Debug)]
enum Tail {
    Scca(Scca),
    Jumps(Vec<Knot>),
}

/// A law ready for its transform.
#[derive(Clone, Debug)]
pub(super) struct Transform {
    law: MotionLaw,
    pub(super) centre: f64,
    tail: Tail,
    /// In turns: from here on `tail` is used.
    tail_from: f64,
    /// Ends of the pieces on which the velocity is smooth.
    pieces: Vec<f64>,
    /// Integrated by parts down to this derivative between one turn and `tail_from`: its order and
    /// its coefficients.
    derivative: Option<(usize, Vec<f64>)>,
}

/// `C(t)` for `t ≥ 0`.
fn c(t: Turns) -> Complex64 {
    let e = t.one_minus_twice();
    if e.abs() <= 1.0 {
        // About the removable singularity t = 1/2.
        let sinc = |x: f64| if x == 0.0 { 1.0 } else { x.sin() / x };
        let (half, quarter) = (0.5 * PI * e, 0.25 * PI * e);
        let re = 0.5 * PI * sinc(half);
        let im = 1.0 - 0.5 * PI * quarter.sin() * sinc(quarter);
        return Complex64::new(re, im) / (2.0 - e);
    }
    let turns = t.turns();
    let wave = t.times(0.5).cis();
    Complex64::new(wave.re, wave.im - 2.0 * turns) / (e * (1.0 + 2.0 * turns))
}

fn scca(law: &Scca, fraction: f64, t: Turns) -> Complex64 {
    let q = t.radians();
    // 1 − λ in two parts: a millionth harmonic sees what rounding it would cost.
    let half = |share: Dd| {
        let stretched = t.times_pair(share.scale(2.0));
        let (sine, cosine) = (c(stretched.times(law.b)), c(stretched.times(law.d)));
        // Between them: where the half is short against the wave, or whole waves, nothing cancels
        // but this.
        let step = t.times_pair(share).cis_less_one() * sine.conj();
        (step + (sine.conj() - cosine)) / (2.0 * share.hi)
    };
    let (up, down) = (
        half(Dd::from(fraction)),
        half(two_sum(1.0, -fraction)).conj(),
    );
    (up + down) * (-law.acceleration / (q * q))
}

/// `Σ_j jumps[j − 1]/(iq)^j`.
fn at_knot(jumps: &[f64], q: f64) -> Complex64 {
    let iq = Complex64::new(0.0, -1.0 / q);
    let sum = jumps.iter().rev();
    sum.fold(Complex64::ZERO, |sum, &jump| (sum + jump) * iq)
}

fn jumps(knots: &[Knot], centre: f64, t: Turns) -> Complex64 {
    let q = t.radians();
    let terms = knots.iter().map(|k| {
        let turn = match k.place == centre {
            true => Turns::ZERO,
            false => t.times(centre).minus(t.times(k.place)),
        };
        turn.cis() * at_knot(&k.jumps, q)
    });
    terms.sum()
}

/// The knots of a law made of two stretched halves.
fn stretched(start: &[f64], middle: &[f64], fraction: f64) -> Vec<Knot> {
    let scaled = |values: &[f64], share: f64, sign: f64| -> Vec<f64> {
        let mut scale = sign;
        let one = |v: &f64| {
            let value = v * scale;
            scale /= sign * 2.0 * share;
            value
        };
        values.iter().map(one).collect()
    };
    let (up, down) = (fraction, 1.0 - fraction);
    // Derivatives on the way out of the stroke: those on the way in, with (−1)^(j+1).
    let end = scaled(start, down, -1.0);
    let mut knots = vec![
        Knot {
            place: 0.0,
            jumps: scaled(start, up, 1.0),
        },
        Knot {
            place: 1.0,
            jumps: end,
        },
    ];
    if up != down {
        let jumps = middle.iter().zip(0..);
        knots.push(Knot {
            place: fraction,
            jumps: jumps.map(|(v, j)| v * difference(j, fraction)).collect(),
        });
    }
    knots
}

/// `(2 − 2λ)^−j − (2λ)^−j`, with `e = 2λ − 1` the quotient of `(1 + e)^j − (1 − e)^j` and
/// `(1 − e²)^j`: `2e Σ_i binomial(j, 2i + 1) e^{2i}` above, so that nothing cancels beside λ = 1/2.
fn difference(j: i32, fraction: f64) -> f64 {
    let e = 2.0 * fraction - 1.0;
    // Of the odd powers, from the first one on.
    let mut binomial = f64::from(j);
    let (mut sum, mut power) = (0.0, 1.0);
    for i in (1..=j).step_by(2) {
        sum += binomial * power;
        power *= e * e;
        let (n, k) = (f64::from(j), f64::from(i));
        binomial *= (n - k) * (n - k - 1.0) / ((k + 1.0) * (k + 2.0));
    }
    2.0 * e * sum / (4.0 * fraction * (1.0 - fraction)).powi(j)
}

fn spline_knots(places: &[f64], third: &[f64], ends: [[f64; 2]; 2]) -> Vec<Knot> {
    let last = places.len() - 1;
    let knot = |k: usize| {
        let before = if k == 0 { 0.0 } else { third[k - 1] };
        let after = if k == last { 0.0 } else { third[k] };
        let [first, second] = match k {
            0 => ends[0],
            _ if k == last => ends[1].map(|v| -v),
            _ => [0.0; 2],
        };
        Knot {
            place: places[k],
            jumps: vec![first, second, after - before],
        }
    };
    (0..=last).map(knot).collect()
}

/// The lowest order with a jump.
pub(super) fn lowest_order(knots: &[Knot]) -> usize {
    let orders = knots
        .iter()
        .filter_map(|k| k.jumps.iter().position(|&j| j != 0.0));
    orders.min().map_or(1, |j| j + 1)
}

/// From which number of turns the jumps, added up, lose no more than integration does.
fn where_jumps_serve(knots: &[Knot], order: usize) -> f64 {
    let mut turns = 1.0;
    let size = |j: usize| -> f64 { knots.iter().map(|k| k.jumps[j].abs()).sum() };
    let highest = knots[0].jumps.len();
    loop {
        let q = TAU * turns;
        let lead = size(order - 1);
        let all: f64 = (order - 1..highest)
            .map(|j| size(j) * q.powi(order as i32 - 1 - j as i32))
            .sum();
        if all <= 0.5 * q * lead || turns > 1e4 {
            return turns;
        }
        turns *= 1.1;
    }
}

/// From which number of turns the terms of the jumps, all of one sign, are at most one together, so
/// that their sum is rounded no more than an integral of one is.
fn where_jumps_are_small(knots: &[Knot]) -> f64 {
    let mut turns = 1.0;
    let sum = |q: f64| -> f64 {
        let at = |k: &Knot| k.jumps.iter().rev().fold(0.0, |sum, j| (sum + j.abs()) / q);
        knots.iter().map(at).sum()
    };
    while sum(TAU * turns) > 1.0 && turns < 1e4 {
        turns *= 1.1;
    }
    turns
}

impl Transform {
    pub(super) fn new(law: &MotionLaw) -> Transform {
        let fraction = law.acceleration_fraction();
        let shorter = 2.0 * fraction.min(1.0 - fraction);
        let mut transform = Transform {
            law: law.clone(),
            centre: fraction,
            tail: Tail::Jumps(Vec::new()),
            tail_from: 1.0,
            pieces: vec![0.0, fraction, 1.0],
            derivative: None,
        };
        match law.shape() {
            Shape::Scca(scca) => {
                for place in [0.5 * scca.b, 0.5 * (scca.b + scca.c)] {
                    transform.pieces.push(2.0 * fraction * place);
                    transform.pieces.push(1.0 - 2.0 * (1.0 - fraction) * place);
                }
                transform.pieces.sort_by(f64::total_cmp);
                // Of the order of the sum's rounding, C_a/(2λ q²) u, is that of an integral of one.
                let turns = (scca.acceleration / shorter).sqrt() / TAU;
                transform.tail_from = turns.max(1.0);
                transform.tail = Tail::Scca(*scca);
            }
            Shape::Symmetric(p) => {
                let knots = stretched(p.at_start(), p.in_middle(), fraction);
                transform.tail_from = where_jumps_are_small(&knots);
                transform.tail = Tail::Jumps(knots);
            }
            Shape::Polynomial(p) => {
                let [start, end] = p.at_ends();
                let end = end.into_iter().map(|v| -v).collect();
                let knots = vec![
                    Knot {
                        place: 0.0,
                        jumps: start,
                    },
                    Knot {
                        place: 1.0,
                        jumps: end,
                    },
                ];
                let order = lowest_order(&knots);
                transform.tail_from = where_jumps_serve(&knots, order);
                transform.derivative = Some((order, p.derivative(order)));
                transform.tail = Tail::Jumps(knots);
            }
            Shape::Tabulated(table) => {
                let knots = spline_knots(table.knots(), &table.third(), table.at_ends());
                transform.pieces = table.knots().to_vec();
                transform.tail = Tail::Jumps(knots);
            }
        }
        transform
    }

    /// The knots, if the law is a piecewise polynomial.
    pub(super) fn knots(&self) -> Option<&[Knot]> {
        match &self.tail {
            Tail::Scca(_) => None,
            Tail::Jumps(knots) => Some(knots),
        }
    }

    /// Without the imaginary part, which is rounding, where the velocity is even about the centre.
    fn parts(&self, value: Complex64) -> Complex64 {
        let halves = matches!(self.law.shape(), Shape::Scca(_) | Shape::Symmetric(_));
        match halves && self.centre == 0.5 {
            true => Complex64::from(value.re),
            false => value,
        }
    }

    /// `F(q)` with `q = 2πt`.
    pub(super) fn at(&self, t: Turns) -> Complex64 {
        self.parts(self.of_any_law(t))
    }

    fn of_any_law(&self, t: Turns) -> Complex64 {
        let turns = t.turns();
        if turns < self.tail_from {
            return match &self.derivative {
                Some((order, p)) if turns >= 1.0 => {
                    let value = |x: f64| p.iter().rev().fold(0.0, |sum, c| sum * x + c);
                    let power = Complex64::new(0.0, -1.0 / t.radians()).powi(*order as i32 - 1);
                    self.integrated(t, Turns::cis, value) * power
                }
                _ => self.integrated(t, Turns::cis, |x| self.velocity(x)),
            };
        }
        match &self.tail {
            Tail::Scca(law) => scca(law, self.centre, t),
            Tail::Jumps(knots) => jumps(knots, self.centre, t),
        }
    }

    /// `F(q) − 1` of a stroke so short that F is next to 1: each part within a few u of `|q|`.
    pub(super) fn less_one(&self, t: Turns) -> Option<Complex64> {
        let short = t.turns() <= SHORT;
        short.then(|| self.parts(self.integrated(t, Turns::cis_less_one, |x| self.velocity(x))))
    }

    fn velocity(&self, x: f64) -> f64 {
        self.law.motion(x).map_or(f64::NAN, |m| m.velocity)
    }

    /// `∫ wave(−q(x − x_c)) f(x) dx`
    fn integrated(
        &self,
        t: Turns,
        wave: impl Fn(Turns) -> Complex64,
        f: impl Fn(f64) -> f64,
    ) -> Complex64 {
        let mut sum = Complex64::ZERO;
        for piece in self.pieces.windows(2) {
            let width = piece[1] - piece[0];
            let panels = (t.turns() * width).ceil().max(1.0) as usize;
            for k in 0..panels {
                let at = |k: usize| piece[0] + width * (k as f64 / panels as f64);
                sum += integral(at(k), at(k + 1), |x| wave(t.times(self.centre - x)) * f(x));
            }
        }
        sum
    }
}

#[cfg(test)]
mod tests;
