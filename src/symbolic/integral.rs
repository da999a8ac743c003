//! Definite integrals in closed form.

use super::error::unsupported;
use super::{Algebra, ExpSum, Fraction, Gauss, Poly, Symbol, SymbolicError};

/// A limit of an integral.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Limit {
    /// A finite one.
    Finite(Fraction),
    /// Plus infinity.
    Infinity,
    /// Minus infinity.
    MinusInfinity,
}

/// A term `c e^p` of an integrand, c and p by their coefficients of the powers of the variable.
struct Term {
    c: Vec<Fraction>,
    p: [Fraction; 3],
}

fn number(re: impl Into<rug::Rational>) -> Fraction {
    Fraction::constant(Gauss::real(re))
}

impl Algebra {
    /// `∫ f dx` between two limits; f is a sum of `c e^p` with c a polynomial in x and p one of
    /// degree two at most. To infinity each term is integrated by itself and has to vanish there.
    ///
    /// # Errors
    /// [`SymbolicError::Unsupported`] for other integrands and for terms that do not vanish.
    pub(super) fn definite(
        &mut self,
        f: &ExpSum,
        x: Symbol,
        [a, b]: [&Limit; 2],
    ) -> Result<ExpSum, SymbolicError> {
        let mut out = ExpSum::zero();
        for (p, c) in f.terms() {
            let Some(term) = self.term(p, c, x) else {
                return unsupported(format!("the integral of {}", self.text(f)));
            };
            let integral = match [term.p[1].is_zero(), term.p[2].is_zero()] {
                [true, true] => self.of_polynomial(&term, [a, b])?,
                [false, true] => self.of_exponential(&term, [a, b])?,
                _ => self.of_gaussian(&term, [a, b])?,
            };
            out = &out + &integral;
        }
        Ok(self.reduce(&out))
    }

    fn term(&self, p: &Fraction, c: &Fraction, x: Symbol) -> Option<Term> {
        let hidden = [p.num(), p.den(), c.num(), c.den()]
            .into_iter()
            .any(|q| self.hides(q, x));
        if p.den().contains(x) || c.den().contains(x) || hidden {
            return None;
        }
        let parts = |f: &Fraction| -> Option<Vec<Fraction>> {
            let coefficients = f.num().coefficients(x).into_iter();
            let over = |q: Poly| Fraction::new(q, f.den().clone());
            coefficients.map(over).collect()
        };
        let mut powers = parts(p)?;
        if powers.len() > 3 {
            return None;
        }
        powers.resize(3, Fraction::zero());
        Some(Term {
            c: parts(c)?,
            p: powers.try_into().ok()?,
        })
    }

    /// `q(x)` by the coefficients of q.
    fn polynomial_at(&self, q: &[Fraction], x: &Fraction) -> Fraction {
        q.iter().rev().fold(Fraction::zero(), |sum, c| {
            self.reduce_fraction(&(&(&sum * x) + c))
        })
    }

    fn of_polynomial(&mut self, term: &Term, limits: [&Limit; 2]) -> Result<ExpSum, SymbolicError> {
        let [Limit::Finite(a), Limit::Finite(b)] = limits else {
            return unsupported("an integral to infinity of what does not vanish there");
        };
        let mut antiderivative = vec![Fraction::zero()];
        for (k, c) in term.c.iter().enumerate() {
            antiderivative.push(c * &number((1, k as u64 + 1)));
        }
        let ends =
            &self.polynomial_at(&antiderivative, b) - &self.polynomial_at(&antiderivative, a);
        let unit = self.exp(&term.p[0].clone().into())?;
        Ok(self.product(&ends.into(), &unit))
    }

    /// The antiderivative of `c e^{p₁x}` is `q e^{p₁x}` with `p₁ q + q′ = c`.
    fn of_exponential(
        &mut self,
        term: &Term,
        limits: [&Limit; 2],
    ) -> Result<ExpSum, SymbolicError> {
        let rate = &term.p[1];
        let inverse = self.inverse(rate)?;
        let mut q = vec![Fraction::zero(); term.c.len()];
        for k in (0..q.len()).rev() {
            let above = match q.get(k + 1) {
                Some(next) => next * &number(k as u64 + 1),
                None => Fraction::zero(),
            };
            q[k] = self.reduce_fraction(&(&(&term.c[k] - &above) * &inverse));
        }
        let [a, b] = limits;
        let p = [&term.p[0], rate, &Fraction::zero()].map(Clone::clone);
        let (upper, lower) = (self.boundary(&q, &p, b)?, self.boundary(&q, &p, a)?);
        Ok(&upper - &lower)
    }

    /// `q(x) e^{p(x)}` at a limit, at infinity zero if the exponential vanishes there.
    fn boundary(
        &mut self,
        q: &[Fraction],
        p: &[Fraction; 3],
        limit: &Limit,
    ) -> Result<ExpSum, SymbolicError> {
        if let Limit::Finite(x) = limit {
            let value = self.polynomial_at(q, x);
            let exponent = self.polynomial_at(p, x);
            let unit = self.exp(&exponent.into())?;
            return Ok(self.product(&value.into(), &unit));
        }
        let growth = match p[2].is_zero() {
            false => p[2].clone(),
            true if *limit == Limit::Infinity => p[1].clone(),
            true => -&p[1],
        };
        let [real, _] = self.parts(&growth)?;
        match self.is_positive_fraction(&-&real) {
            true => Ok(ExpSum::zero()),
            false => unsupported("an integral to infinity of what is not shown to vanish there"),
        }
    }

    /// Powers of x are taken off by `∫ x^k e^p = x^(k−1) e^p/(2p₂) − (k−1)/(2p₂) ∫ x^(k−2) e^p −
    /// p₁/(2p₂) ∫ x^(k−1) e^p`. The rest is `p = z² + p₀ − p₁²/(4p₂)` with `z = √p₂ x + p₁/(2√p₂)`.
    fn of_gaussian(&mut self, term: &Term, [a, b]: [&Limit; 2]) -> Result<ExpSum, SymbolicError> {
        let [p0, p1, p2] = &term.p;
        let half = number((1, 2));
        let over = &self.inverse(p2)? * &half;
        let (mut c, mut q) = (term.c.clone(), vec![Fraction::zero(); term.c.len()]);
        for k in (1..c.len()).rev() {
            let share = self.reduce_fraction(&(&c[k] * &over));
            q[k - 1] = &q[k - 1] + &share;
            c[k - 1] = self.reduce_fraction(&(&c[k - 1] - &(&share * p1)));
            if k > 1 {
                let part = &share * &number(k as u64 - 1);
                c[k - 2] = self.reduce_fraction(&(&c[k - 2] - &part));
            }
        }
        let mut out = ExpSum::zero();
        if q.iter().any(|q| !q.is_zero()) {
            let (upper, lower) = (
                self.boundary(&q, &term.p, b)?,
                self.boundary(&q, &term.p, a)?,
            );
            out = &upper - &lower;
        }
        let Some(c) = c.first().filter(|c| !c.is_zero()) else {
            return Ok(out);
        };
        let root = self.sqrt(p2)?;
        let inverse = self.inverse(&root)?;
        let shift = &(p1 * &inverse) * &half;
        let mut value = |limit: &Limit| -> Result<Fraction, SymbolicError> {
            let sign = match limit {
                Limit::Finite(x) => return self.antiderivative(&(&(&root * x) + &shift)),
                Limit::Infinity => Gauss::new(0, (1, 2)),
                Limit::MinusInfinity => Gauss::new(0, (-1, 2)),
            };
            // √p₂ is above the origin on the imaginary axis, and G(z) tends to i√π/2 upwards.
            if !self.is_positive_fraction(&-p2) {
                return unsupported("an integral to infinity of what is not shown to vanish there");
            }
            let pi = self.sqrt(&Fraction::symbol(Symbol::PI))?;
            Ok(&pi * &Fraction::constant(sign))
        };
        let ends = &value(b)? - &value(a)?;
        let exponent = p0 - &(&shift * &shift);
        let unit = self.exp(&self.reduce_fraction(&exponent).into())?;
        let factor = self.product(&(c * &inverse).into(), &unit);
        Ok(&out + &self.product(&ends.into(), &factor))
    }
}

#[cfg(test)]
mod tests {
    use crate::{Definitions, Identity, Outcome, parse_equation};

    fn outcome(text: &str) -> Outcome {
        Identity::of(&Definitions::default(), &parse_equation(text).unwrap()).outcome
    }

    #[test]
    fn integrals_have_their_closed_forms() {
        for text in [
            "int(x, 0, inf, exp(-x)) = 1",
            "int(x, 0, inf, x^3*exp(-2*x)) = 3/8",
            "int(x, -inf, 0, x*exp(c*x)) = -1/c^2",
            "int(x, 0, inf, exp(-a*x)*cos(b*x)) = a/(a^2 + b^2)",
            "int(x, -inf, inf, exp(-x^2)) = sqrt(pi)",
            "int(x, 0, inf, x^2*exp(-c*x^2)) = sqrt(pi)/(4*c*sqrt(c))",
            "int(x, -inf, inf, exp(-x^2 + 2*b*x)) = sqrt(pi)*exp(b^2)",
            "int(x, -inf, inf, exp(-x^2)*cos(2*b*x)) = sqrt(pi)*exp(-b^2)",
            "int(x, 0, 1, x*exp(x)) = 1",
            "int(x, a, b, x*sin(x)) = a*cos(a) - b*cos(b) + sin(b) - sin(a)",
            "int(x, 0, t, x^3*exp(x^2)) = (exp(t^2)*(t^2 - 1) + 1)/2",
            "int(x, 0, 1, 2*x*exp(-x^2)) = 1 - exp(-1)",
            "int(s, 0, 4, sqrt(s)*sqrt(s)) = 8",
        ] {
            assert_eq!(outcome(text), Outcome::Proved, "{text}");
        }
        for text in [
            "int(x, 0, inf, exp(-x)) = 2",
            "int(x, 0, inf, x*exp(-x)) = 2",
            "int(x, -inf, inf, exp(-x^2)) = pi",
        ] {
            assert_eq!(outcome(text), Outcome::Refuted, "{text}");
        }
    }

    #[test]
    fn what_does_not_converge_is_not_proved() {
        for text in [
            "int(x, 0, inf, exp(x)) = -1",
            "int(x, 0, inf, cos(x)) = 0",
            "int(x, 0, inf, 1) = 0",
            "int(x, -inf, inf, exp(-(a - b)*x^2)) = sqrt(pi/(a - b))",
            "int(x, 0, inf, x*exp(x^2)) = -1/2",
            "int(x, inf, 0, exp(-x)) = 1",
        ] {
            assert_ne!(outcome(text), Outcome::Proved, "{text}");
        }
    }
}
