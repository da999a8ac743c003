//! Sums to infinity in closed form.

use super::error::unsupported;
use super::{Algebra, ExpSum, Fraction, Gauss, Poly, Symbol, SymbolicError};
use rug::{Integer, Rational};

/// Terms that a sum of a rational function is shifted by at most.
const SHIFTS: i64 = 1000;

impl Algebra {
    /// `Σ_{n ≥ 1} f(n)`, n the index, for a sum of terms `c(n) e^{−pn}` with a polynomial c and Re
    /// p > 0, and of rational functions of n that are sums of `c/(n + a)^k` with integers a.
    ///
    /// # Errors
    /// [`SymbolicError::Unsupported`] for other terms and for sums that are not shown to converge.
    pub(super) fn infinite_sum(&mut self, f: &ExpSum) -> Result<ExpSum, SymbolicError> {
        let n = Symbol::INDEX;
        let text = self.text(f);
        let refused = || SymbolicError::Unsupported(format!("the sum of {text} to infinity"));
        let mut out = ExpSum::zero();
        for (p, c) in f.terms() {
            let hidden = [p.num(), p.den(), c.num(), c.den()]
                .into_iter()
                .any(|q| self.hides(q, n));
            if p.den().contains(n) || hidden {
                return Err(refused());
            }
            let rates = p.num().coefficients(n);
            let over = |q: Option<&Poly>| {
                let q = q.cloned().unwrap_or_else(Poly::zero);
                Fraction::new(q, p.den().clone())
            };
            let (Some(fixed), Some(rate)) = (over(rates.first()), over(rates.get(1))) else {
                return Err(refused());
            };
            if rates.len() > 2 {
                return Err(refused());
            }
            let sum = if rate.is_zero() {
                let sum = self.sum_of_rational(c, n)?.ok_or_else(refused)?;
                self.product(&sum, &ExpSum::term(Fraction::integer(1), fixed))
            } else {
                if c.den().contains(n) {
                    return Err(refused());
                }
                let unit = self.exp(&fixed.into())?;
                let sum = self.sum_of_exponential(c, &rate, n)?;
                self.product(&sum, &unit)
            };
            out = &out + &sum;
        }
        Ok(self.reduce(&out))
    }

    /// `Σ_{n ≥ 1} c(n) q^n` with `q = e^{rate}`, |q| < 1: `Σ_{m ≥ 0} b(m) q^m` for the polynomial
    /// `b(m) = c(m + 1)` is `Σ_k Δ^k b(0) q^k/(1 − q)^{k+1}` with the differences of b.
    fn sum_of_exponential(
        &mut self,
        c: &Fraction,
        rate: &Fraction,
        n: Symbol,
    ) -> Result<ExpSum, SymbolicError> {
        let [real, _] = self.parts(rate)?;
        if !self.is_positive_fraction(&-&real) {
            return unsupported("a sum to infinity of what is not shown to vanish there");
        }
        let q = self.exp(&rate.clone().into())?;
        let below = &ExpSum::integer(1) - &q;
        let inverse = self.quotient(&ExpSum::integer(1), &below)?;
        let coefficients = c.num().coefficients(n);
        let over = Fraction::from(c.den().clone());
        let over = self.inverse(&over)?;
        let value = |m: i64| {
            let x = Gauss::real(m + 1);
            coefficients
                .iter()
                .rev()
                .fold(Poly::zero(), |sum, c| &sum.scaled(&x) + c)
        };
        let mut row: Vec<Poly> = (0..coefficients.len() as i64).map(value).collect();
        let mut factor = inverse.clone();
        let mut out = ExpSum::zero();
        while let Some(first) = row.first() {
            let first = &Fraction::from(first.clone()) * &over;
            out = &out + &self.product(&first.into(), &factor);
            row = row.windows(2).map(|pair| &pair[1] - &pair[0]).collect();
            factor = self.product(&factor, &self.product(&q, &inverse));
        }
        Ok(self.product(&out, &q))
    }

    /// `Σ_{n ≥ 1} c(n)` of a rational function that falls off like n^(−2): by partial fractions
    /// `c_{k,a}/(n + a)^k`. Those with k = 1 telescope, those with even k are values of ζ. `None`
    /// for others.
    fn sum_of_rational(
        &mut self,
        c: &Fraction,
        n: Symbol,
    ) -> Result<Option<ExpSum>, SymbolicError> {
        if c.is_zero() {
            return Ok(Some(ExpSum::zero()));
        }
        let degree = |p: &Poly| p.coefficients(n).len();
        // Of n alone below, and falling off.
        if c.den().symbols().iter().any(|x| *x != n) || degree(c.num()) + 2 > degree(c.den()) {
            return Ok(None);
        }
        let Some(roots) = integer_roots(c.den(), n) else {
            return Ok(None);
        };
        let mut out = Fraction::zero();
        let (mut harmonic, mut rest) = (Fraction::zero(), c.clone());
        for (a, multiplicity) in roots {
            let linear = &Poly::symbol(n) + &Poly::integer(a);
            for k in (1..=multiplicity).rev() {
                let power = Fraction::from(linear.pow(k));
                let Some(coefficient) = at_integer(&(&rest * &power), n, -a) else {
                    return Ok(None);
                };
                if coefficient.is_zero() {
                    continue;
                }
                let Some(part) = power.inverse().map(|over| &coefficient * &over) else {
                    return Ok(None);
                };
                rest = &rest - &part;
                // Σ_{n ≥ 1} 1/(n + a)^k = ζ(k) − Σ_{1 ≤ j ≤ a} 1/j^k.
                let finite = (1..=a).fold(Rational::new(), |sum, j| {
                    sum + Rational::from((Integer::from(1), Integer::from(j).pow(k)))
                });
                out = &out - &(&coefficient * &Fraction::constant(Gauss::real(finite)));
                if k == 1 {
                    harmonic = &harmonic + &coefficient;
                } else {
                    let Some(value) = even_zeta(k) else {
                        return Ok(None);
                    };
                    let pi = Fraction::from(Poly::symbol(Symbol::PI).pow(k));
                    let value = &pi * &Fraction::constant(Gauss::real(value));
                    out = &out + &(&coefficient * &value);
                }
            }
        }
        // Divergent parts have to cancel: the remainder of the harmonic sums vanishes.
        let complete = rest.is_zero() && self.reduce_fraction(&harmonic).is_zero();
        Ok(complete.then(|| self.reduce_fraction(&out).into()))
    }
}

use rug::ops::Pow;

/// The value of a fraction at an integer.
fn at_integer(f: &Fraction, n: Symbol, value: i64) -> Option<Fraction> {
    let x = Gauss::real(value);
    let at = |p: &Poly| {
        p.coefficients(n)
            .iter()
            .rev()
            .fold(Poly::zero(), |sum, c| &sum.scaled(&x) + c)
    };
    Fraction::new(at(f.num()), at(f.den()))
}

/// The numbers a ≥ 0 of the factors `n + a` of a polynomial in n with their multiplicities; `None`
/// if it has others.
fn integer_roots(p: &Poly, n: Symbol) -> Option<Vec<(i64, u32)>> {
    let mut rest = p.clone();
    let mut out = Vec::new();
    for a in 0..=SHIFTS {
        let linear = &Poly::symbol(n) + &Poly::integer(a);
        let mut multiplicity = 0;
        while let Some(quotient) = rest
            .divided_by(&linear)
            .filter(|_| rest.as_constant().is_none())
        {
            rest = quotient;
            multiplicity += 1;
        }
        if multiplicity > 0 {
            out.push((a, multiplicity));
        }
        if rest.as_constant().is_some() {
            return Some(out);
        }
        if !super::work::spend(10) {
            return None;
        }
    }
    None
}

/// `ζ(k)/π^k` for even k: `(−1)^{k/2+1} B_k 2^{k−1}/k!` with the Bernoulli numbers.
fn even_zeta(k: u32) -> Option<Rational> {
    if k % 2 == 1 || k > 60 {
        return None;
    }
    // Σ_{j<m} C(m, j) B_j = 0.
    let mut bernoulli: Vec<Rational> = vec![Rational::from(1)];
    for m in 2..=k + 1 {
        let sum = bernoulli
            .iter()
            .enumerate()
            .fold(Rational::new(), |sum, (j, b)| {
                sum + Rational::from(b * Integer::from(m).binomial(j as u32))
            });
        bernoulli.push(-sum / m);
    }
    let b = bernoulli.pop()?.abs();
    let factorial = Integer::from(Integer::factorial(k));
    Some(b * (Integer::from(1) << (k - 1)) / factorial)
}

#[cfg(test)]
mod tests {
    use crate::{Definitions, Identity, Outcome, parse_equation};

    fn outcome(text: &str) -> Outcome {
        Identity::of(&Definitions::default(), &parse_equation(text).unwrap()).outcome
    }

    #[test]
    fn sums_to_infinity_have_their_closed_forms() {
        for text in [
            "sum(n, 1, inf, 1/n^2) = pi^2/6",
            "sum(n, 1, inf, 1/n^4) = pi^4/90",
            "sum(n, 1, inf, 1/n^10) = pi^10/93555",
            "sum(n, 1, inf, 1/(n*(n + 1))) = 1",
            "sum(n, 0, inf, x/((n + 1)*(n + 3))) = 3*x/4",
            "sum(n, 3, inf, 1/(n - 1)^2) = pi^2/6 - 1",
            "sum(n, 0, inf, exp(-n*a)) = 1/(1 - exp(-a))",
            "sum(n, 1, inf, n*exp(-n*x)) = exp(-x)/(1 - exp(-x))^2",
            "sum(n, 2, inf, n^2*exp(-n)) = sum(n, 1, inf, n^2*exp(-n)) - exp(-1)",
            "sum(n, 1, inf, exp(-n) + exp(-2*n)) = sum(n, 1, inf, exp(-n)) + sum(n, 1, inf, exp(-2*n))",
            "sum(n, 0, inf, exp(-n*y)*cos(n)) = re(1/(1 - exp(i - y)))",
            "sum(n, 5, inf, 0) = 0",
        ] {
            assert_eq!(outcome(text), Outcome::Proved, "{text}");
        }
        for text in [
            "sum(n, 1, inf, 1/n^2) = 49/36",
            "sum(n, 0, inf, exp(-n)) = 2",
        ] {
            assert_eq!(outcome(text), Outcome::Refuted, "{text}");
        }
    }

    #[test]
    fn what_is_not_shown_to_converge_is_not_proved() {
        for text in [
            "sum(n, 1, inf, 1/n) - sum(n, 1, inf, 1/n) = 0",
            "sum(n, 1, inf, z) = sum(n, 1, inf, z)",
            "sum(n, 5, inf, a[n]) = 0",
            "sum(n, 0, inf, exp(n)) = 1/(1 - exp(1))",
            "sum(n, 0, inf, exp(i*n)) = 1/(1 - exp(i))",
            "sum(n, 0, inf, exp(n*(x - y))) = 1/(1 - exp(x - y))",
            "sum(n, -1, inf, 1/(n*(n + 1))) = 1",
            "sum(n, 1, inf, 1/n^3) = 1",
            "sum(n, 1, inf, 1/(n^2 + 1)) = 1",
            "sum(n, 1, inf, (n - 2)/((n - 2)*n^2)) = pi^2/6",
            "sum(n, 1, inf, 1/(n - 2)^2) = pi^2/6 + 1",
            "series(k, sum(n, 1, inf, k/n^2)) = series(k, k)",
        ] {
            assert_ne!(outcome(text), Outcome::Proved, "{text}");
        }
    }
}
