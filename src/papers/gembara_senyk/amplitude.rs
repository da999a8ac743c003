//! The amplitude (18) of one harmonic and its modulus in (19), as printed and corrected
//! (`passage.toml` of the paper), beside the convolution (10).
//!
//! The paper prints `− i n` in `U` (12), though not in `U₀`; and in (19) `W(V₀)` where `W(U₀)`
//! belongs, with a 4 too many in the prefactor.

use crate::reference::chirp_oscillator::{Problem, enclose};
use crate::reference::{Ball, Mag};
use crate::study::Study;
use crate::symbolic::evaluation::{Answer, Goal};
use rug::Rational;
use std::sync::LazyLock;

static FORMULAS: LazyLock<Study> = LazyLock::new(|| {
    let text = include_str!("../../../reference/papers/gembara-senyk/passage.toml");
    Study::parse(text, "passage").expect("a study that is compiled in")
});

/// Which formula, by its place among the outputs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Formula {
    /// (18), with `U` as it has to be.
    Corrected,
    /// (18) with (12) as printed.
    Printed18,
    /// (19) as printed apart from its prefactor, `U` as it has to be.
    Printed19,
}

/// An oscillator that a shaft, at rest at first, passes with one harmonic: natural frequency w,
/// damping n < w, acceleration ε > 0 of the shaft, harmonic k, time t.
#[derive(Clone, Debug)]
pub struct Passage(pub [Rational; 5]);

impl Passage {
    /// `|A(t)|` by the formulas; an infinite ball where there is no value.
    pub fn moduli(&self, bits: u32) -> Vec<Ball> {
        let known = |answer| match answer {
            Answer::Number(ball) => ball,
            _ => Ball::integer(bits, 0).widened(Mag::INFINITY),
        };
        let answers = FORMULAS.answers(&self.0, Goal::Bits(bits));
        answers.into_iter().map(known).collect()
    }

    /// The relative errors of the formulas against the convolution (10), whatever they say.
    pub fn errors(&self, bits: u32) -> Vec<Ball> {
        let [w, n, eps, k, t] = self.0.clone();
        let o = Rational::new;
        let due = match Problem::new(&[w, n, eps, o(), k, o(), o(), o(), t]) {
            Ok(problem) => enclose(&problem, bits).amplitude.norm_sqr().sqrt(),
            Err(_) => Ball::integer(bits, 0),
        };
        let moduli = self.moduli(bits).into_iter();
        moduli.map(|m| (m - &due) / &due).collect()
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
            let passage = Passage(values.map(Rational::from));
            let error = &passage.errors(200)[Formula::Corrected as usize];
            assert!(error.contains_zero(), "{values:?}: {error:?}");
            assert!(error.magnitude().to_f64() < 1e-40, "{values:?}: {error:?}");
        }
    }
}
