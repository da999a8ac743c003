//! Expressions in the algebra: the normal form.

use super::error::unsupported;
use super::expr::{Bound, Expr, Func};
use super::walk::{Definitions, Domain, Scope, walk};
use super::{Algebra, Derivation, ExpSum, Fraction, Gauss, Poly, Symbol, SymbolicError};

/// Evaluates expressions to normal forms.
#[derive(Clone, Debug, Default)]
pub struct Exact {
    /// What has been adjoined on the way.
    pub algebra: Algebra,
}

impl Exact {
    /// The normal form.
    ///
    /// # Errors
    /// What is outside the algebra.
    pub fn value(&mut self, definitions: &Definitions, e: &Expr) -> Result<ExpSum, SymbolicError> {
        walk(self, &mut Scope::new(definitions), e)
    }

    fn fraction(&self, e: &ExpSum, what: &str) -> Result<Fraction, SymbolicError> {
        e.as_fraction()
            .ok_or_else(|| SymbolicError::Unsupported(format!("{what} with exponentials")))
    }

    /// `∫ f dx` from a to b; f is a sum of `c e^p` with p of degree two at most in x, and c free of
    /// x unless p is.
    fn definite(
        &mut self,
        f: &ExpSum,
        x: Symbol,
        a: &Fraction,
        b: &Fraction,
    ) -> Result<ExpSum, SymbolicError> {
        let mut out = ExpSum::zero();
        let zero = Poly::zero();
        for (p, c) in f.terms() {
            let parts = p.num().coefficients(x);
            let hidden = [p.num(), p.den(), c.num(), c.den()]
                .into_iter()
                .any(|q| self.algebra.hides(q, x));
            if p.den().contains(x) || parts.len() > 3 || c.den().contains(x) || hidden {
                return unsupported(format!("the integral of {f}"));
            }
            let part = |k: usize| {
                let over = parts.get(k).unwrap_or(&zero).clone();
                Fraction::new(over, p.den().clone()).unwrap_or_else(Fraction::zero)
            };
            let (p0, p1, p2) = (part(0), part(1), part(2));
            let unit = |e: &Fraction| ExpSum::term(Fraction::integer(1), e.clone());
            let integral = if p1.is_zero() && p2.is_zero() {
                let mut sum = Fraction::zero();
                for (k, d) in c.num().coefficients(x).into_iter().enumerate() {
                    let over = Poly::integer(k as i64 + 1);
                    let power = |y: &Fraction| (0..=k).fold(Fraction::integer(1), |q, _| &q * y);
                    let d = Fraction::new(d, &over * c.den()).unwrap_or_else(Fraction::zero);
                    sum = &sum + &(&d * &(&power(b) - &power(a)));
                }
                self.algebra.product(&sum.into(), &unit(&p0))
            } else if c.contains(x) {
                return unsupported(format!("the integral of {f}"));
            } else if p2.is_zero() {
                let ends = &unit(&(&p1 * b)) - &unit(&(&p1 * a));
                let ends = self.algebra.quotient(&ends, &p1.into())?;
                self.algebra.product(&ends, &ExpSum::term(c.clone(), p0))
            } else {
                // p = z² + p0 − p1²/(4 p2) with z = √p2 x + p1/(2√p2).
                let root = self.algebra.sqrt(&p2)?;
                let inverse = root.inverse().unwrap_or_else(Fraction::zero);
                let half = Fraction::constant(Gauss::real((1, 2)));
                let shift = &(&p1 * &inverse) * &half;
                let z = |x: &Fraction| &(&root * x) + &shift;
                let ends =
                    &self.algebra.antiderivative(&z(b))? - &self.algebra.antiderivative(&z(a))?;
                let rest = &p0 - &(&shift * &shift);
                let factor = ExpSum::term(c * &inverse, rest);
                self.algebra.product(&ends.into(), &factor)
            };
            out = &out + &integral;
        }
        Ok(self.algebra.reduce(&out))
    }

    fn poly_at(
        &mut self,
        p: &Poly,
        x: Symbol,
        value: &Fraction,
    ) -> Result<Fraction, SymbolicError> {
        let mut out = Fraction::zero();
        for (m, c) in p.terms() {
            let mut product = Fraction::constant(c.clone());
            for (s, k) in m {
                let roots = self.algebra.roots().iter();
                let hidden = |q: &Poly| q.contains(x) || self.algebra.hides(q, x);
                let mut roots = roots.filter(|(r, q)| r == s && hidden(q));
                if roots.next().is_some() {
                    return unsupported(format!("a value of {x} under a root"));
                }
                let integrals = self.algebra.antiderivatives();
                let found = integrals.iter().find(|(g, _)| g == s).cloned();
                let factor = match found {
                    Some((_, z)) => {
                        let z = self.fraction_at(&z, x, value)?;
                        self.algebra.antiderivative(&z)?
                    }
                    None if *s == x => value.clone(),
                    None => Fraction::symbol(*s),
                };
                for _ in 0..*k {
                    product = &product * &factor;
                }
            }
            out = &out + &product;
        }
        Ok(self.algebra.reduce_fraction(&out))
    }

    fn fraction_at(
        &mut self,
        f: &Fraction,
        x: Symbol,
        value: &Fraction,
    ) -> Result<Fraction, SymbolicError> {
        let num = self.poly_at(f.num(), x, value)?;
        let den = self.poly_at(f.den(), x, value)?;
        let inverse = den
            .inverse()
            .ok_or_else(|| SymbolicError::NotInvertible(format!("{} at {x} = {value}", f.den())))?;
        Ok(self.algebra.reduce_fraction(&(&num * &inverse)))
    }

    /// Refuses where a value bound on the way depends on `x`, which is to be free in what follows: a derivative by it
    /// or a value put in for it would reach into what is bound. A name that is bound to its own symbol is free.
    fn is_free(&self, scope: &Scope<ExpSum>, x: Symbol) -> Result<(), SymbolicError> {
        let captured = scope.bound.iter().any(|(name, v)| {
            let own = Symbol::new(name).is_some_and(|s| *v == ExpSum::symbol(s));
            let hidden = |q: &Poly| self.algebra.hides(q, x);
            let hides = |f: &Fraction| hidden(f.num()) || hidden(f.den());
            !own && (v.contains(x) || v.terms().any(|(p, c)| hides(p) || hides(c)))
        });
        match captured {
            true => unsupported(format!("{x} inside of what is bound to a value of it")),
            false => Ok(()),
        }
    }

    fn square_root(&mut self, x: &ExpSum) -> Result<ExpSum, SymbolicError> {
        let x = self.fraction(x, "a root")?;
        Ok(self.algebra.sqrt(&x)?.into())
    }
}

impl Domain for Exact {
    type V = ExpSum;

    fn constant(&mut self, c: &Gauss) -> ExpSum {
        ExpSum::constant(c.clone())
    }

    fn symbol(&mut self, name: &str) -> Result<ExpSum, SymbolicError> {
        let x = Symbol::named(name)?;
        Ok(ExpSum::symbol(x))
    }

    fn add(&mut self, a: &ExpSum, b: &ExpSum) -> ExpSum {
        a + b
    }

    fn mul(&mut self, a: &ExpSum, b: &ExpSum) -> ExpSum {
        self.algebra.product(a, b)
    }

    fn div(&mut self, a: &ExpSum, b: &ExpSum) -> Result<ExpSum, SymbolicError> {
        self.algebra.quotient(a, b)
    }

    fn call(&mut self, f: Func, x: &ExpSum) -> Result<ExpSum, SymbolicError> {
        let halved = |a: &Algebra, e: &ExpSum, c: Gauss| a.product(e, &ExpSum::constant(c));
        match f {
            Func::Exp => self.algebra.exp(x),
            Func::Sqrt => self.square_root(x),
            Func::W => {
                let z = self.fraction(x, "the argument of W")?;
                let pi = self.symbol("pi")?;
                let root = self.square_root(&pi)?;
                let g = self.algebra.antiderivative(&z)?;
                let g = self.algebra.quotient(&g.into(), &root)?;
                let sum = &ExpSum::integer(1)
                    + &self
                        .algebra
                        .product(&ExpSum::constant(Gauss::new(0, 2)), &g);
                let damp = ExpSum::term(Fraction::integer(1), -&(&z * &z));
                Ok(self.algebra.product(&sum, &damp))
            }
            Func::Re => {
                let sum = x + &self.algebra.conj(x)?;
                Ok(halved(&self.algebra, &sum, Gauss::real((1, 2))))
            }
            Func::Im => {
                let difference = x - &self.algebra.conj(x)?;
                Ok(halved(&self.algebra, &difference, Gauss::new(0, (-1, 2))))
            }
            Func::Abs => {
                let square = self.algebra.product(x, &self.algebra.conj(x)?);
                self.square_root(&square)
            }
            Func::Arg => {
                // arg(c e^{iθ}) = θ for c > 0, here: a positive multiple of symbols.
                let found = x.as_single().and_then(|(p, c)| {
                    let positive = c.den().is_one()
                        && c.num().terms().count() == 1
                        && self.algebra.is_positive(c.num());
                    let minus_i = Fraction::constant(Gauss::i_power(3));
                    let theta = p * &minus_i;
                    (positive && theta == theta.conj()).then_some(theta)
                });
                found.map_or_else(|| unsupported("an argument"), |theta| Ok(theta.into()))
            }
            Func::Arctan => unsupported("an arc tangent"),
            Func::Sin | Func::Cos => unsupported(f.name()),
        }
    }

    fn integral(
        &mut self,
        scope: &mut Scope<ExpSum>,
        bound: &Bound,
    ) -> Result<ExpSum, SymbolicError> {
        let a = walk(self, scope, &bound.from)?;
        let b = walk(self, scope, &bound.to)?;
        let (a, b) = (self.fraction(&a, "a limit")?, self.fraction(&b, "a limit")?);
        // A name that cannot be typed and differs by depth, so that no limit is caught.
        let name = format!("${}", scope.bound.len());
        let x = Symbol::named(&name)?;
        let f = scope.binding(&bound.var, ExpSum::symbol(x), |scope| {
            Algebra::unsigned(self, x, |exact| walk(exact, scope, &bound.body))
        });
        self.definite(&f?, x, &a, &b)
    }

    fn derivative(
        &mut self,
        scope: &mut Scope<ExpSum>,
        body: &Expr,
        by: &str,
    ) -> Result<ExpSum, SymbolicError> {
        let x = Symbol::named(by)?;
        let mut d = Derivation::from([(x, ExpSum::integer(1))]);
        let definitions = scope.definitions;
        for (symbol, image) in definitions.derivations.get(by).into_iter().flatten() {
            let image = walk(self, scope, image)?;
            let s = Symbol::named(symbol)?;
            d.insert(s, image);
        }
        d.keys().try_for_each(|s| self.is_free(scope, *s))?;
        let bound = scope.bound.iter().rev().find(|b| b.0 == by);
        if bound.is_some_and(|b| b.1 != ExpSum::symbol(x)) {
            return unsupported(format!(
                "a derivative by {by}, which is bound outside of it"
            ));
        }
        let f = scope.binding(by, ExpSum::symbol(x), |scope| walk(self, scope, body));
        self.algebra.derive(&f?, &d)
    }

    /// Evaluates with the symbol free and puts the value in afterwards, so that derivatives are
    /// taken before.
    fn at(
        &mut self,
        scope: &mut Scope<ExpSum>,
        body: &Expr,
        symbol: &str,
        value: ExpSum,
    ) -> Result<ExpSum, SymbolicError> {
        let Some(value) = value.as_fraction() else {
            return scope.binding(symbol, value, |scope| walk(self, scope, body));
        };
        let x = Symbol::named(symbol)?;
        self.is_free(scope, x)?;
        let f = scope.binding(symbol, ExpSum::symbol(x), |scope| {
            Algebra::unsigned(self, x, |exact| walk(exact, scope, body))
        });
        let mut out = ExpSum::zero();
        for (p, c) in f?.terms() {
            let p = self.fraction_at(p, x, &value)?;
            out.accumulate(self.fraction_at(c, x, &value)?, p);
        }
        Ok(self.algebra.reduce(&out))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parse;

    /// No value is put in below a root, however deep; beside one it is.
    #[test]
    fn values_under_roots() {
        let mut exact = Exact::default();
        let [x, y] = ["x", "y"].map(|n| Symbol::new(n).unwrap());
        let mut at = |text: &str, s: Symbol| {
            let form = exact.value(&Definitions::default(), &parse(text).unwrap());
            let fraction = form.unwrap().as_fraction().unwrap();
            exact.poly_at(fraction.num(), s, &Fraction::integer(3))
        };
        for text in [
            "sqrt(x + y)",
            "y*sqrt(x + y) + 1",
            "sqrt(1 + sqrt(x))",
            "sqrt(2)*sqrt(x)",
        ] {
            let found = at(text, x);
            assert!(
                matches!(found, Err(SymbolicError::Unsupported(_))),
                "{text}: {found:?}"
            );
        }
        let beside = at("y*sqrt(x) + 2*y^2", y).unwrap();
        assert_eq!(beside, at("3*sqrt(x) + 18", y).unwrap());
    }

    #[test]
    fn values_in_polynomials() {
        let [x, y] = ["x", "y"].map(|n| Symbol::new(n).unwrap());
        let p = &Poly::symbol(x).pow(2) + &Poly::symbol(y);
        let found = Exact::default().poly_at(&p, x, &Fraction::integer(3));
        assert_eq!(found.unwrap().to_string(), "9+y");
    }

    /// A symbol is positive again behind the value that was put in for it.
    #[test]
    fn signs_are_free_inside_of_values_only() {
        let mut exact = Exact::default();
        let mut form = |text: &str| exact.value(&Definitions::default(), &parse(text).unwrap());
        assert_eq!(
            form("at(x^2, x, -3) + sqrt(x)^2").unwrap().to_string(),
            "9+x"
        );
        assert!(form("at(sqrt(x)^2, x, -3)").is_err());
        assert_eq!(form("sqrt(x^2)").unwrap().to_string(), "x");
    }
}
