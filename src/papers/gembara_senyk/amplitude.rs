//! The amplitude (18) of one harmonic and its modulus in (19), as printed and corrected, enclosed.
//!
//! ```text
//! |A| = w² √(2π)/(4 w₃ √κ) · |W(U) + W(V) − W(U₀) e^{U₀²−U²} − W(V₀) e^{V₀²−V²}|
//! U = (1 − i)(ω − w₃ + i n)/(2√κ),   V = −(1 − i)(ω + w₃ + i n)/(2√κ),   ω = κt,   κ = kε
//! ```
//!
//! and `U₀`, `V₀` are the same at `ω = 0`. The paper prints `− i n` in `U` (12), though not in
//! `U₀`; and in (19) `W(V₀)` where `W(U₀)` belongs, with a 4 too many in the prefactor.

use crate::reference::chirp_oscillator::{Problem, enclose};
use crate::reference::{Ball, ComplexBall, faddeeva};
use rug::Rational;

/// An oscillator that a shaft, at rest at first, passes with one harmonic.
#[derive(Clone, Debug)]
pub struct Passage {
    /// Natural frequency w, damping n < w, acceleration ε > 0 of the shaft, harmonic k, time t.
    pub values: [Rational; 5],
}

/// Which formula.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Formula {
    /// (18), with `U` as it has to be.
    Corrected,
    /// (18) with (12) as printed.
    Printed18,
    /// (19) as printed apart from its prefactor, `U` as it has to be.
    Printed19,
}

impl Passage {
    /// From fractions.
    pub fn new(values: [(i32, u32); 5]) -> Passage {
        Passage {
            values: values.map(Rational::from),
        }
    }

    /// `|A(t)|` by a formula.
    pub fn modulus(&self, formula: Formula, prec: u32) -> Ball {
        let [w, n, eps, k, t] = &self.values;
        let real = |q: &Rational| Ball::rational(prec, q);
        let kappa = Rational::from(k * eps);
        let omega = Rational::from(&kappa * t);
        let below = Rational::from(w - n) * Rational::from(w + n);
        let w3 = real(&below).sqrt();
        let root = real(&kappa).sqrt();
        // (1 − i)(x + i y)/(2√κ)
        let turned = |x: Ball, y: Ball| {
            let scale = root.shift(1).recip();
            ComplexBall::new((&x + &y) * &scale, (&y - &x) * &scale)
        };
        let u = |omega: &Rational, damping: Ball| turned(real(omega) - &w3, damping);
        let v = |omega: &Rational| turned(-(real(omega) + &w3), -real(n));
        let zero = Rational::new();
        let sign = match formula {
            Formula::Printed18 => -real(n),
            _ => real(n),
        };
        let (u, u0) = (u(&omega, sign), u(&zero, real(n)));
        let (v, v0) = (v(&omega), v(&zero));
        let third = match formula {
            Formula::Printed19 => &v0,
            _ => &u0,
        };
        let value = |z: &ComplexBall| faddeeva::w_ball(z, prec);
        let decay = |z0: &ComplexBall, z: &ComplexBall| (&z0.square() - &z.square()).exp();
        let sum = &(&value(&u) + &value(&v))
            - &(&(&value(third) * &decay(&u0, &u)) + &(&value(&v0) * &decay(&v0, &v)));
        let scale = real(w).square() * Ball::pi(prec).shift(1).sqrt() / (w3 * root).shift(2);
        sum.norm_sqr().sqrt() * scale
    }

    /// `|A(t)|` by the convolution (10), whatever the formulas say.
    pub fn reference(&self, prec: u32) -> Ball {
        let [w, n, eps, k, t] = self.values.clone();
        let o = Rational::new;
        let values = [w, n, eps, o(), k, o(), o(), o(), t];
        match Problem::new(&values) {
            Ok(problem) => enclose(&problem, prec).amplitude.norm_sqr().sqrt(),
            Err(_) => Ball::rational(prec, &o()),
        }
    }

    /// The relative error of a formula.
    pub fn error(&self, formula: Formula, prec: u32) -> Ball {
        let due = self.reference(prec);
        (self.modulus(formula, prec) - &due) / due
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corrected_formula_is_the_convolution() {
        for values in [
            [(10, 1), (1, 2), (4, 1), (2, 1), (3, 2)],
            [(10, 1), (1, 10), (4, 1), (1, 1), (4, 1)],
            [(3, 1), (1, 1), (4, 1), (1, 1), (2, 1)],
        ] {
            let p = Passage::new(values);
            let error = p.error(Formula::Corrected, 200);
            assert!(error.contains_zero(), "{values:?}: {error:?}");
            assert!(error.magnitude().to_f64() < 1e-40, "{values:?}: {error:?}");
        }
    }
}
