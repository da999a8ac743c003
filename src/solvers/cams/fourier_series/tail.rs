//! How fast the transform of a law falls: `|F(q)| ≤ T_p/q^p`.
//!
//! `T_p` is the total variation of `s^(p)` on the whole line, jumps at the ends included, where
//! `s^(p−1)` is continuous: `p − 1` integrations by parts leave `∫ dS^(p)/(iq)^p`.

use super::transform::{Knot, Transform, lowest_order};
use crate::cam_law::{MotionLaw, Shape};
use std::f64::consts::PI;

/// Rounding of the bound itself.
const SLACK: f64 = 1.0 + 1e-9;

/// `|F(q)| ≤ variation / q^order`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Decay {
    pub(super) order: i32,
    pub(super) variation: f64,
}

/// Bounds for a law; every one of them holds.
pub(super) fn decays(law: &MotionLaw, transform: &Transform) -> Vec<Decay> {
    let decay = |order, variation: f64| Decay {
        order,
        variation: variation * SLACK,
    };
    let fraction = law.acceleration_fraction();
    let (up, down) = (2.0 * fraction, 2.0 * (1.0 - fraction));
    match (law.shape(), transform.knots()) {
        (Shape::Scca(scca), _) => {
            let ca = scca.acceleration;
            // Up to C_a/2λ, down to −C_a/2μ, back to zero.
            let mut all = vec![decay(2, 2.0 * (ca / up + ca / down))];
            if scca.b > 0.0 && scca.d > 0.0 {
                let (sine, cosine) = (ca * PI / scca.b, ca * PI / scca.d);
                let (u, d) = (1.0 / (up * up), 1.0 / (down * down));
                let halves = (2.0 * sine + cosine) * (u + d);
                all.push(decay(3, halves + cosine * (u - d).abs()));
            }
            all
        }
        (Shape::Polynomial(p), Some(knots)) => {
            let order = lowest_order(knots);
            vec![decay(
                order as i32,
                jumps(knots, order) + variation(&p.derivative(order)),
            )]
        }
        (Shape::Symmetric(p), Some(knots)) => {
            let order = lowest_order(knots);
            // ∫ |s^(order+1)| of each half, from its values at the start: monotone pieces.
            let half = half_variation(p.at_start(), order);
            let scale = |s: f64| half / s.powi(order as i32 - 1);
            vec![decay(
                order as i32,
                jumps(knots, order) + scale(up) + scale(down),
            )]
        }
        (_, knots) => {
            let knots = knots.unwrap_or_default();
            let order = lowest_order(knots);
            // s''' of a spline is constant between its knots, s'' is straight, s' a parabola.
            let inner = match order {
                3 => 0.0,
                _ => between_knots(knots, order),
            };
            vec![decay(order as i32, jumps(knots, order) + inner)]
        }
    }
}

/// Jumps of one order at all knots.
fn jumps(knots: &[Knot], order: usize) -> f64 {
    knots.iter().map(|k| k.jumps[order - 1].abs()).sum()
}

/// Total variation of a polynomial inside [0, 1]: that of its Bernstein coefficients bounds it
/// (variation is diminished), here after the interval was halved five times.
fn variation(p: &[f64]) -> f64 {
    let n = p.len() - 1;
    // b_j = Σ_{k≤j} C(j,k)/C(n,k) p_k.
    let mut b = vec![0.0; n + 1];
    for (j, b) in b.iter_mut().enumerate() {
        let mut ratio = 1.0;
        for (k, c) in p.iter().enumerate().take(j + 1) {
            *b += ratio * c;
            ratio *= (j - k) as f64 / (n - k).max(1) as f64;
        }
    }
    halved(b, 5)
}

fn halved(mut b: Vec<f64>, times: u32) -> f64 {
    if times == 0 {
        return b.windows(2).map(|w| (w[1] - w[0]).abs()).sum();
    }
    // de Casteljau: the left coefficients as they come, the right ones stay.
    let mut left = Vec::with_capacity(b.len());
    for last in (0..b.len()).rev() {
        left.push(b[0]);
        for i in 0..last {
            b[i] = 0.5 * (b[i] + b[i + 1]);
        }
    }
    halved(left, times - 1) + halved(b, times - 1)
}

/// Variation of `s^(order)` over the accelerating half, given all derivatives at the start.
fn half_variation(start: &[f64], order: usize) -> f64 {
    // Taylor coefficients of s^(order) in 2x, so that the half becomes [0, 1].
    let mut scale = 1.0;
    let mut taylor = Vec::new();
    for (k, v) in start[order - 1..].iter().enumerate() {
        taylor.push(v * scale);
        scale *= 0.5 / (k + 1) as f64;
    }
    variation(&taylor)
}

/// Variation of `s'` or `s''` of a spline between its knots, from its jumps alone.
fn between_knots(knots: &[Knot], order: usize) -> f64 {
    let (mut second, mut third) = (0.0, 0.0);
    let mut sum = 0.0;
    for pair in knots.windows(2) {
        second += pair[0].jumps[1];
        third += pair[0].jumps[2];
        let h = pair[1].place - pair[0].place;
        let end = second + third * h;
        sum += match order {
            1 => h * second.abs().max(end.abs()),
            _ => h * third.abs(),
        };
        second = end;
    }
    sum
}

#[cfg(test)]
mod tests;
