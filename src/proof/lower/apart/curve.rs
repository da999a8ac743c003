//! Points at which both terms of w are equal: the equation `ζ = G(ζ) − 2πim` and its real part
//! along a line.

use super::smooth::middle;
use crate::ProofError;
use crate::interval::{product_up, quotient_up, sqrt_up, up};
use mechaudit_reference::{Ball, ComplexBall, Mag};
use num_complex::Complex64;
use rug::{Float, Rational};

/// A residual below this part of ζ ends an iteration, at 192 bits and at more.
const RESIDUAL: [i64; 2] = [-135, -175];

/// Above `1/(1 − L)`, L what the map contracts by: of a zero `|G′| < 1/21`, of a line `1/D` and
/// less than half.
const OF_ZERO: f64 = 1.05;
const OF_LINE: f64 = 2.0;

/// `ln (2√π)`.
const LN_2_SQRT_PI: f64 = 1.265_512_123_484_645_4;

fn residual(bits: u32) -> i64 {
    RESIDUAL[usize::from(bits > 200)]
}

/// `√(e(N + 3/2)) T_N/T_0` for the least N that makes it small enough, from a lower bound of |ζ|.
fn terms(size: f64, bits: u32) -> (u32, f64) {
    let enough = f64::from(residual(bits) as i32 - 10).exp2();
    let (mut n, mut ratio) = (0, 1.0);
    loop {
        n += 1;
        ratio = product_up(ratio, quotient_up(f64::from(n) - 0.5, size));
        // √e < 1.65
        let bound = product_up(product_up(1.65, sqrt_up(f64::from(n) + 1.5)), ratio);
        if bound < enough || f64::from(n) > 0.9 * size {
            return (n, bound);
        }
    }
}

fn exact(x: &Ball, bits: u32) -> Ball {
    Ball::new(Float::with_val(bits, x.mid()), Mag::ZERO)
}

/// `(G, |ζ|²)`.
fn g(zeta: &ComplexBall, bits: u32) -> (ComplexBall, Ball) {
    let norm = zeta.norm_sqr();
    let size = norm.mignitude().to_f64().sqrt() * (1.0 - 1e-9);
    let (n, missing) = terms(size, bits);
    let q = ComplexBall::new(&zeta.re / &norm, -(&zeta.im / &norm));
    let one = Ball::integer(bits, 1);
    let mut a = ComplexBall::new(one.clone(), Ball::integer(bits, 0));
    for k in (1..n).rev() {
        let next = (&a * &q).scaled(&Ball::exact(bits, f64::from(k) - 0.5));
        a = ComplexBall::new(next.re + &one, next.im);
    }
    let a = a.widened(Mag::from_f64(up(missing)));
    let pi = Ball::pi(bits);
    // ln(2√π) + ½ ln |ζ| − ln |A|, from ¼ ln(16π² |ζ|²/|A|⁴).
    let of_a = a.norm_sqr();
    let inside = (&pi * &pi).shift(4) * &norm / &of_a.square();
    let re = inside.ln().shift(-2);
    let im = pi.shift(-1) + &zeta.arg().shift(-1) - &a.arg();
    (ComplexBall::new(re, im), norm)
}

/// The largest distance of a solution from a point that a map moves by `off`, if that is small
/// enough: `factor` is `1/(1 − L)` of the map, or more.
fn within(off: &ComplexBall, enough: Mag, factor: f64) -> Option<Mag> {
    let off = off.magnitude();
    let radius = off.mul(Mag::from_f64(factor));
    (off <= enough).then(|| radius.add(Mag::power_of_two(-128)))
}

/// D and P at a zero after that many turns, to 2⁻⁵², A apart.
fn beside_zero(turns: f64) -> [f64; 2] {
    let (mut x, mut p) = (3.0f64, turns);
    for _ in 0..6 {
        (x, p) = (
            LN_2_SQRT_PI + 0.5 * x.hypot(p).ln(),
            turns - std::f64::consts::FRAC_PI_2 + 0.5 * p.atan2(x),
        );
    }
    [x, p]
}

/// `G′(ζ)` without powers of 1/ζ from the fifth on, to 2⁻⁵⁰.
fn slope(zeta: &ComplexBall) -> Complex64 {
    let q = Complex64::new(middle(&zeta.re), middle(&zeta.im)).inv();
    q * (0.5 + q * (0.5 + q * (1.25 + q * 4.625)))
}

/// `−Im z` at zero number m of the equation.
pub(super) fn zero(m: u64, bits: u32) -> Result<Ball, ProofError> {
    let turns = Ball::pi(bits).shift(1) * Ball::rational(bits, &Rational::from(m));
    let start = beside_zero(middle(&turns));
    zero_from(start, &turns, bits)
        .ok_or_else(|| ProofError::Fails(format!("zero {m} is not found")))
}

fn zero_from([x, p]: [f64; 2], turns: &Ball, bits: u32) -> Option<Ball> {
    let mut zeta = ComplexBall::new(Ball::exact(bits, x), Ball::exact(bits, -p));
    for _ in 0..60 {
        let (g, _) = g(&zeta, bits);
        let next = ComplexBall::new(g.re, g.im - turns);
        let off = &next - &zeta;
        let enough = zeta.magnitude().shift(residual(bits));
        if let Some(radius) = within(&off, enough, OF_ZERO) {
            let found = zeta.widened(radius);
            // a² = (|ζ| + D)/2, b = P/(2a).
            let a = (found.norm_sqr().sqrt() + &found.re).shift(-1).sqrt();
            return Some(-(found.im / &a.shift(1)));
        }
        // Newton's method.
        let slope = slope(&zeta);
        let off = Complex64::new(middle(&off.re), middle(&off.im));
        let more = off * (slope / (1.0 - slope));
        let moved = |x: Ball, by: f64| exact(&(x + Ball::exact(bits, by)), bits);
        zeta = ComplexBall::new(moved(next.re, more.re), moved(next.im, more.im));
    }
    None
}

/// D on the line `a − b = jδ`, `δ = 2^{k−52}`, to 2⁻⁴⁵.
fn beside_line(k: i32, j: u64) -> f64 {
    let c = j as f64 * f64::from(k - 52).exp2();
    let mut d = 11.0 + 0.7 * f64::from(k - 13);
    for _ in 0..5 {
        let p = 0.5 * ((d / c).powi(2) - c * c);
        d += (LN_2_SQRT_PI + 0.5 * d.hypot(p).ln() - d) * d / (d - 1.0);
    }
    d
}

/// S on the line `a − b = jδ`, `δ = 2^{k−52}`.
pub(super) fn line(k: i32, j: u64, bits: u32) -> Result<Ball, ProofError> {
    line_from(beside_line(k, j), k, j, bits)
        .ok_or_else(|| ProofError::Fails(format!("line {j} of binade {k} is not found")))
}

fn line_from(start: f64, k: i32, j: u64, bits: u32) -> Option<Ball> {
    let unit = |x: Ball, sign: i32| x.shift(sign * (2 * k - 104));
    let number = Ball::rational(bits, &Rational::from(j));
    let square = number.square();
    let mut d = Ball::exact(bits, start);
    for _ in 0..60 {
        let s = unit(&d / &number, -1);
        let p = unit(s.square() - &square, 1).shift(-1);
        let (g, _) = g(&ComplexBall::new(d.clone(), -p), bits);
        let off = g.re - &d;
        let real = ComplexBall::new(off.clone(), Ball::integer(bits, 0));
        if let Some(radius) = within(&real, Mag::power_of_two(residual(bits)), OF_LINE) {
            return Some(unit(d.widened(radius) / &number, -1));
        }
        // Newton's method: Re G is ln D and a constant, nearly.
        let size = middle(&d);
        d = exact(&(d + off * Ball::exact(bits, size / (size - 1.0))), bits);
    }
    None
}

#[cfg(test)]
mod tests;
