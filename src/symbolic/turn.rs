//! Exponentials of rational multiples of `iπ`: roots of unity.
//!
//! `e^{2πit}` is a product of roots of unity of prime power order, t being a sum of fractions with
//! such denominators. Those of orders 2, 4, 8, 16, 3 and 5 are made of square roots, so that the
//! trigonometric values at multiples of π/120 are numbers of the field. The others stay
//! exponentials; of order `p^k` those with exponents below `p^(k−1)` (p = 3, 5) or `(p−1) p^(k−1)`
//! are kept, and the others follow from `Σ_j e^{2πi j/p} = 0`.

use super::work::step;
use super::{Algebra, ExpSum, Fraction, Gauss, Poly, Symbol, SymbolicError};
use rug::{Integer, Rational};

/// Prime factors that are looked for in a denominator.
const LARGEST_PRIME: u32 = 1000;

/// The coefficient c of π in `p = c π + …` for a fraction p: at π times the leading monomial of the
/// denominator, which is monic.
pub(super) fn multiple_of_pi(p: &Fraction) -> Option<Gauss> {
    let pi = Poly::symbol(Symbol::PI);
    let (lead, _) = p.den().terms().last()?;
    let at = &pi * &Poly::monomial(lead);
    let (m, _) = at.terms().next()?;
    let found = p.num().terms().find(|t| t.0 == m)?;
    Some(found.1.clone())
}

/// `t = Σ a/p^k` modulo one: prime, power of it, numerator; with the part whose denominator has
/// large factors as a fraction.
fn partial_fractions(t: &Rational) -> (Vec<(u32, u32, Rational)>, Rational) {
    let mut rest = t.clone();
    let mut parts = Vec::new();
    let mut below = t.denom().clone();
    for p in 2..LARGEST_PRIME {
        if below == 1 {
            break;
        }
        let (mut k, mut power) = (0, Integer::from(1));
        while below.is_divisible_u(p) {
            below /= p;
            power *= p;
            k += 1;
        }
        if k == 0 {
            continue;
        }
        // a/power + b/others = t: a = numerator / others modulo the power.
        let others = Integer::from(rest.denom() / &power);
        let Ok(inverse) = others.invert(&power) else {
            break;
        };
        let a = Integer::from(rest.numer() * &inverse).modulo(&power);
        let part = Rational::from((a, power));
        rest -= &part;
        parts.push((p, k, part));
    }
    (parts, rest)
}

impl Algebra {
    /// `e^{p}` with its roots of unity in normal form.
    ///
    /// # Errors
    /// [`SymbolicError::Work`] past the limit on work.
    pub(super) fn unity(&mut self, p: &Fraction) -> Result<ExpSum, SymbolicError> {
        let p = self.reduce_fraction(p);
        let one = Fraction::integer(1);
        let turn = match multiple_of_pi(&p) {
            Some(c) if !c.im.is_zero() => c.im / 2u32,
            _ => return Ok(ExpSum::term(one, p)),
        };
        let whole = |t: &Rational| &Fraction::symbol(Symbol::PI) * &unit_imaginary(t);
        let left = &p - &whole(&turn);
        let (parts, rest) = partial_fractions(&turn);
        // The rest of the turn is a whole number, or has factors too large to look at.
        let rest = rest.rem_trunc();
        let mut out = ExpSum::term(one, &left + &whole(&rest));
        for (prime, k, t) in parts {
            let factor = self.prime_power(prime, k, &t)?;
            let mut product = ExpSum::zero();
            for (p, c) in out.terms() {
                for (q, d) in factor.terms() {
                    step(1)?;
                    product.accumulate(self.reduce_fraction(&(c * d)), p + q);
                }
            }
            out = product;
        }
        Ok(out)
    }

    /// `e^{2πit}` for `t = a/p^k` in `[0, 1)`.
    fn prime_power(&mut self, p: u32, k: u32, t: &Rational) -> Result<ExpSum, SymbolicError> {
        let free = |t: &Rational| {
            let exponent = &Fraction::symbol(Symbol::PI) * &unit_imaginary(t);
            ExpSum::term(Fraction::integer(1), exponent)
        };
        if p == 2 {
            // Quarter turns are units; what is left is below a quarter.
            let quarters = Rational::from(t * 4u32).floor();
            let turns = quarters.numer().to_i64().unwrap_or(0);
            let unit = Fraction::constant(Gauss::i_power(turns));
            let rest = Rational::from(t - &(quarters / 4u32));
            let root = match k {
                0..=2 => Fraction::integer(1),
                3 | 4 => self.dyadic(&rest)?,
                _ => {
                    let unit = ExpSum::from(unit);
                    return Ok(&unit * &free(&rest));
                }
            };
            return Ok(self.reduce_fraction(&(&unit * &root)).into());
        }
        let power = Rational::from(p);
        if p <= 5 {
            // b/p + r/p^k with r below p^(k-1).
            let b = Rational::from(t * &power).floor();
            let rest = Rational::from(t - &Rational::from(&b / &power));
            let b = b.numer().to_u32().unwrap_or(0);
            let root = self.odd(p)?;
            let mut product = Fraction::integer(1);
            for _ in 0..b {
                product = self.reduce_fraction(&(&product * &root));
            }
            let product = ExpSum::from(product);
            return Ok(match rest.is_zero() {
                true => product,
                false => &product * &free(&rest),
            });
        }
        // The last block follows from the others.
        let block = Rational::from(p - 1) / &power;
        if *t < block {
            return Ok(free(t));
        }
        let within = Rational::from(t - &block);
        let mut sum = ExpSum::zero();
        for j in 0..p - 1 {
            step(1)?;
            sum = &sum + &free(&(Rational::from((j, p)) + &within));
        }
        Ok(-&sum)
    }

    /// `e^{2πit}` for t a multiple of 1/16 below 1/4.
    fn dyadic(&mut self, t: &Rational) -> Result<Fraction, SymbolicError> {
        let half = Fraction::constant(Gauss::real((1, 2)));
        let i = Fraction::constant(Gauss::i());
        let root = self.sqrt(&Fraction::integer(2))?;
        let eighth = &(&Fraction::integer(1) + &i) * &(&root * &half);
        let sixteenths = Rational::from(t * 16u32).numer().to_u32().unwrap_or(0);
        if sixteenths.is_multiple_of(2) {
            return Ok(match sixteenths {
                0 => Fraction::integer(1),
                _ => eighth,
            });
        }
        // e^{iπ/8} = (√(2 + √2) + i √(2 − √2))/2.
        let two = Fraction::integer(2);
        let cos = &self.sqrt(&(&two + &root))? * &half;
        let sin = &self.sqrt(&(&two - &root))? * &half;
        let first = &cos + &(&i * &sin);
        let value = if sixteenths == 1 {
            first
        } else {
            &first * &eighth
        };
        Ok(self.reduce_fraction(&value))
    }

    /// `e^{2πi/3} = (−1 + i√3)/2`, `e^{2πi/5} = (√5 − 1)/4 + i √(10 + 2√5)/4`.
    fn odd(&mut self, p: u32) -> Result<Fraction, SymbolicError> {
        let i = Fraction::constant(Gauss::i());
        let one = Fraction::integer(1);
        if p == 3 {
            let root = self.sqrt(&Fraction::integer(3))?;
            let half = Fraction::constant(Gauss::real((1, 2)));
            return Ok(&(&(&i * &root) - &one) * &half);
        }
        let root = self.sqrt(&Fraction::integer(5))?;
        let under = &Fraction::integer(10) + &(&root * &Fraction::integer(2));
        let sin = self.sqrt(&under)?;
        let quarter = Fraction::constant(Gauss::real((1, 4)));
        let sum = &(&root - &one) + &(&i * &sin);
        Ok(&sum * &quarter)
    }

    /// Brings the roots of unity of a sum of exponentials to normal form.
    ///
    /// # Errors
    /// As [`Algebra::unity`].
    pub(super) fn with_unity(&mut self, e: &ExpSum) -> Result<ExpSum, SymbolicError> {
        let mut out = ExpSum::zero();
        for (p, c) in e.terms() {
            let unity = self.unity(p)?;
            out = &out + &self.product(&unity, &c.clone().into());
        }
        Ok(out)
    }
}

/// `2it` as a constant.
fn unit_imaginary(t: &Rational) -> Fraction {
    Fraction::constant(Gauss::new(0, Rational::from(t * 2u32)))
}

#[cfg(test)]
mod tests {
    use crate::{Definitions, Identity, Outcome, parse_equation};

    fn outcome(text: &str) -> Outcome {
        let equation = parse_equation(text).unwrap();
        Identity::of(&Definitions::default(), &equation).outcome
    }

    #[test]
    fn trigonometric_values_are_algebraic_numbers() {
        for text in [
            "cos(pi/3) = 1/2",
            "sin(pi/3) = sqrt(3)/2",
            "cos(pi/4) = 1/sqrt(2)",
            "cos(pi/5) = (1 + sqrt(5))/4",
            "sin(pi/10) = (sqrt(5) - 1)/4",
            "cos(pi/12) = (sqrt(6) + sqrt(2))/4",
            "cos(pi/8) = sqrt(2 + sqrt(2))/2",
            "sin(3*pi/8) = sqrt(2 + sqrt(2))/2",
            "sin(pi/8) = sqrt(2 - sqrt(2))/2",
            "cos(pi/24)^2 = (4 + sqrt(2) + sqrt(6))/8",
            "8*cos(pi/15) = sqrt(30 + 6*sqrt(5)) + sqrt(5) - 1",
            "cos(2*pi/7) + cos(4*pi/7) + cos(6*pi/7) = -1/2",
            "cos(pi/9)*cos(2*pi/9)*cos(4*pi/9) = 1/8",
            "cos(100*pi/3) = -1/2",
            "exp(i*pi/9)^3 = exp(i*pi/3)",
            "cos(x + pi/3) + cos(x - pi/3) = cos(x)",
            "sin(x + 2*pi/3) + sin(x + 4*pi/3) + sin(x) = 0",
            "exp(i*pi/32)^64 = 1",
            "exp(2*i*pi/997)^997 = 1",
        ] {
            assert_eq!(outcome(text), Outcome::Proved, "{text}");
        }
        for text in [
            "cos(pi/3) = sqrt(3)/2",
            "cos(2*pi/7) + cos(4*pi/7) + cos(6*pi/7) = 1/2",
            "cos(pi/9) = cos(pi/8)",
            "sin(pi/8) = sqrt(2 + sqrt(2))/2",
        ] {
            assert_eq!(outcome(text), Outcome::Refuted, "{text}");
        }
    }
}
