//! Expressions in the algebra: the normal form.

use super::enclosure::has_derivative;
use super::error::unsupported;
use super::expr::{Bound, Expr, Func};
use super::integral::Limit;
use super::series;
use super::walk::{Definitions, Domain, Scope, walk};
use super::work::{LIMIT, limited};
use super::{Algebra, Derivation, ExpSum, Fraction, Gauss, Poly, Symbol, SymbolicError};
use rug::Rational;

/// Evaluates expressions to normal forms.
#[derive(Clone, Debug, Default)]
pub struct Exact {
    /// The roots and integrals adjoined on the way.
    pub algebra: Algebra,
    /// Evaluates what is differentiated in place of its derivative, to see where it is defined.
    undifferentiated: bool,
}

impl Exact {
    /// The normal form.
    ///
    /// # Errors
    /// A formula outside the algebra.
    pub fn value(&mut self, definitions: &Definitions, e: &Expr) -> Result<ExpSum, SymbolicError> {
        limited(LIMIT, || {
            series::check(definitions, e)?;
            let form = walk(self, &mut Scope::new(definitions), e)?;
            self.algebra.with_unity(&form)
        })
    }

    pub(super) fn fraction(&self, e: &ExpSum, what: &str) -> Result<Fraction, SymbolicError> {
        e.as_fraction()
            .ok_or_else(|| SymbolicError::Unsupported(format!("{what} with exponentials")))
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
                let root = roots.clone().find(|(r, q)| r == s && hidden(q)).cloned();
                let integrals = self.algebra.antiderivatives();
                let found = integrals.iter().find(|(g, _)| g == s).cloned();
                let kernels = self.algebra.kernels().iter();
                let kernel = kernels
                    .clone()
                    .find(|(k, kernel)| k == s && kernel.polynomials().into_iter().any(&hidden));
                let kernel = kernel.cloned();
                if let Some((_, kernel)) = kernel {
                    let factor = Algebra::kernel_at(self, &kernel, x, value)?;
                    for _ in 0..*k {
                        product = &product * &factor;
                    }
                    continue;
                }
                let factor = match (root, found) {
                    (Some((_, radicand)), _) => {
                        let radicand = self.poly_at(&radicand, x, value)?;
                        self.algebra.sqrt(&radicand)?
                    }
                    (_, Some((_, z))) => {
                        let z = self.fraction_at(&z, x, value)?;
                        self.algebra.antiderivative(&z)?
                    }
                    _ if *s == x => value.clone(),
                    _ => Fraction::symbol(*s),
                };
                for _ in 0..*k {
                    product = &product * &factor;
                }
            }
            out = &out + &product;
        }
        Ok(self.algebra.reduce_fraction(&out))
    }

    pub(super) fn fraction_at(
        &mut self,
        f: &Fraction,
        x: Symbol,
        value: &Fraction,
    ) -> Result<Fraction, SymbolicError> {
        let num = self.poly_at(f.num(), x, value)?;
        let den = self.poly_at(f.den(), x, value)?;
        let inverse = self.algebra.inverse(&den)?;
        Ok(self.algebra.reduce_fraction(&(&num * &inverse)))
    }

    /// Refuses where a value bound on the way depends on `x`, which is to be free in what follows:
    /// a derivative by it or a value put in for it would reach into what is bound. A name that is
    /// bound to its own symbol is free.
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

    /// A limit of an integral.
    fn limit(&mut self, scope: &mut Scope<ExpSum>, e: &Expr) -> Result<Limit, SymbolicError> {
        let is_infinite = |e: &Expr| *e == Expr::Sym("inf".into());
        match e {
            e if is_infinite(e) => Ok(Limit::Infinity),
            Expr::Neg(e) if is_infinite(e) => Ok(Limit::MinusInfinity),
            e => {
                let value = walk(self, scope, e)?;
                self.fraction(&value, "a limit").map(Limit::Finite)
            }
        }
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

    fn call(&mut self, f: Func, x: &[ExpSum]) -> Result<ExpSum, SymbolicError> {
        let [x, rest @ ..] = x else {
            return unsupported(f.name());
        };
        let halved = |a: &Algebra, e: &ExpSum, c: Gauss| a.product(e, &ExpSum::constant(c));
        match f {
            Func::Exp => self.algebra.exp(x),
            Func::Sqrt => self.algebra.square_root(x),
            Func::W => {
                let z = self.fraction(x, "the argument of W")?;
                let pi = self.symbol("pi")?;
                let root = self.algebra.square_root(&pi)?;
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
            Func::Abs => self.algebra.abs(x),
            Func::Arg => self.algebra.arg(x),
            Func::Arctan => self.algebra.arctan(x),
            Func::Sin => self.algebra.sine_and_cosine(x).map(|(sine, _)| sine),
            Func::Cos => self.algebra.sine_and_cosine(x).map(|(_, cosine)| cosine),
            Func::Tan => {
                let (sine, cosine) = self.algebra.sine_and_cosine(x)?;
                self.algebra.quotient(&sine, &cosine)
            }
            Func::Sinh => Ok(self.algebra.hyperbolic(x)?.0),
            Func::Cosh => Ok(self.algebra.hyperbolic(x)?.1),
            Func::Tanh => {
                let (sine, cosine) = self.algebra.hyperbolic(x)?;
                self.algebra.quotient(&sine, &cosine)
            }
            Func::Expm1 => Ok(&self.algebra.exp(x)? - &ExpSum::integer(1)),
            Func::Conj => self.algebra.conj(x),
            Func::Hypot | Func::Fma => match (f, rest) {
                (Func::Hypot, [y]) => {
                    let a = &self.algebra;
                    let sum = &a.product(x, x) + &a.product(y, y);
                    self.algebra.square_root(&sum)
                }
                (_, [y, z]) => Ok(&self.algebra.product(x, y) + z),
                _ => unsupported(f.name()),
            },
            Func::Exp2
            | Func::Exp10
            | Func::Log
            | Func::Log2
            | Func::Log10
            | Func::Log1p
            | Func::Cbrt
            | Func::Asin
            | Func::Acos
            | Func::Asinh
            | Func::Acosh
            | Func::Atanh
            | Func::Erf
            | Func::Erfc
            | Func::Erfcx
            | Func::Erfi
            | Func::Dawson
            | Func::Tgamma
            | Func::Lgamma
            | Func::Digamma
            | Func::AiryAi
            | Func::AiryAiPrime
            | Func::AiryBi
            | Func::AiryBiPrime
            | Func::SinInt
            | Func::CosInt
            | Func::Ei
            | Func::ExpInt
            | Func::LambertW
            | Func::LambertWm1
            | Func::Zeta
            | Func::ZetaDerivative
            | Func::BesselJ
            | Func::BesselI
            | Func::BesselIe
            | Func::WeierstrassP
            | Func::WeierstrassPPrime
            | Func::Floor
            | Func::Ceil
            | Func::Round
            | Func::Trunc
            | Func::Nearbyint
            | Func::Pow
            | Func::Atan2
            | Func::Fmin
            | Func::Fmax
            | Func::Fdim
            | Func::Fmod
            | Func::Remainder
            | Func::Copysign
            | Func::Voigt => unsupported(f.name()),
        }
    }

    fn integral(
        &mut self,
        scope: &mut Scope<ExpSum>,
        bound: &Bound,
    ) -> Result<ExpSum, SymbolicError> {
        let limits = [
            self.limit(scope, &bound.from)?,
            self.limit(scope, &bound.to)?,
        ];
        let complex = limits.iter().any(|limit| match limit {
            Limit::Finite(x) => !self.algebra.is_real(&x.clone().into()),
            _ => false,
        });
        // A name that cannot be typed and differs by depth, so that no limit is caught.
        let name = format!("${}", scope.bound.len());
        let x = Symbol::named(&name)?;
        let f = scope.binding(&bound.var, ExpSum::symbol(x), |scope| {
            Algebra::unsigned(self, x, complex, |exact| walk(exact, scope, &bound.body))
        });
        self.algebra.definite(&f?, x, limits.each_ref())
    }

    fn infinite_sum(
        &mut self,
        scope: &mut Scope<ExpSum>,
        bound: &Bound,
    ) -> Result<ExpSum, SymbolicError> {
        let Some(from) = super::walk::integer(scope, &bound.from) else {
            return unsupported("the limits of a sum");
        };
        if scope.bound.iter().any(|(_, v)| v.contains(Symbol::INDEX)) {
            return unsupported("a sum to infinity in a series");
        }
        // The index counts the terms from one, so that a divisor is seen to vanish in none of them.
        let term = Fraction::from(&Poly::symbol(Symbol::INDEX) + &Poly::integer(from - 1));
        let f = scope.binding(&bound.var, term.into(), |scope| {
            walk(self, scope, &bound.body)
        });
        self.algebra.infinite_sum(&f?)
    }

    fn derivative(
        &mut self,
        scope: &mut Scope<ExpSum>,
        body: &Expr,
        by: &str,
    ) -> Result<ExpSum, SymbolicError> {
        if self.undifferentiated {
            return walk(self, scope, body);
        }
        let x = Symbol::named(by)?;
        let mut d = Derivation::from([(x, ExpSum::integer(1))]);
        let definitions = scope.definitions;
        for (symbol, image) in definitions.derivations.get(by).into_iter().flatten() {
            let image = scope.deeper(symbol, |scope| walk(self, scope, image))?;
            // The derivative of a real value is real: Re f would not be differentiated like f.
            if !self.algebra.is_real(&image) && definitions.any(body, uses_conjugates) {
                return unsupported(format!(
                    "a derivation that makes {symbol} complex, of real and imaginary parts"
                ));
            }
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

    /// Puts the value in before the body is evaluated, so that no division by zero is lost. Where
    /// there is a derivative, evaluates with the symbol free and puts the value in afterwards, what
    /// is differentiated being defined there.
    fn at(
        &mut self,
        scope: &mut Scope<ExpSum>,
        body: &Expr,
        symbol: &str,
        value: ExpSum,
    ) -> Result<ExpSum, SymbolicError> {
        let fraction = match value.as_fraction() {
            Some(fraction) if has_derivative(scope.definitions, body) => fraction,
            _ => return scope.binding(symbol, value, |scope| walk(self, scope, body)),
        };
        let outside = std::mem::replace(&mut self.undifferentiated, true);
        let defined = scope.binding(symbol, value.clone(), |scope| walk(self, scope, body));
        self.undifferentiated = outside;
        let defined = defined?;
        if outside {
            return Ok(defined);
        }
        let x = Symbol::named(symbol)?;
        self.is_free(scope, x)?;
        let complex = !self.algebra.is_real(&value);
        let f = scope.binding(symbol, ExpSum::symbol(x), |scope| {
            Algebra::unsigned(self, x, complex, |exact| walk(exact, scope, body))
        });
        let mut out = ExpSum::zero();
        for (p, c) in f?.terms() {
            let p = self.fraction_at(p, x, &fraction)?;
            let c = self.fraction_at(c, x, &fraction)?;
            let unit = self.algebra.exp(&p.into())?;
            out = &out + &self.algebra.product(&c.into(), &unit);
        }
        Ok(self.algebra.reduce(&out))
    }
}

impl Algebra {
    /// `(sinh x, cosh x)` as exponentials.
    fn hyperbolic(&mut self, x: &ExpSum) -> Result<(ExpSum, ExpSum), SymbolicError> {
        let minus = self.product(&ExpSum::integer(-1), x);
        let [up, down] = [self.exp(x)?, self.exp(&minus)?];
        let half = ExpSum::constant(Gauss::real((1, 2)));
        let [sine, cosine] = [&up - &down, &up + &down].map(|e| self.product(&half, &e));
        Ok((sine, cosine))
    }

    /// `(sin x, cos x)` as exponentials: `sin x = sinh(ix)/i`, `cos x = cosh(ix)`.
    fn sine_and_cosine(&mut self, x: &ExpSum) -> Result<(ExpSum, ExpSum), SymbolicError> {
        let turned = self.product(&ExpSum::constant(Gauss::i()), x);
        let (sine, cosine) = self.hyperbolic(&turned)?;
        let minus_i = ExpSum::constant(Gauss::i_power(3));
        Ok((self.product(&minus_i, &sine), cosine))
    }
}

/// Operations allowed for a proof that a value is zero, which is asked for where balls only suggest
/// it: some hundredths of a second with numbers of a thousand bits.
const LEAST: u64 = LIMIT / 40;

/// Returns true if the normal form of an expression is zero at rational values of its symbols.
pub(super) fn proves_zero(
    definitions: &Definitions,
    e: &Expr,
    names: &[String],
    values: &[Rational],
) -> bool {
    let mut definitions = definitions.clone();
    for (name, value) in names.iter().zip(values) {
        let size = Expr::Num(value.clone().abs().to_string());
        let value = match *value < 0 {
            true => Expr::Neg(Box::new(size)),
            false => size,
        };
        definitions.set(name, value);
    }
    let form = limited(LEAST, || Exact::default().value(&definitions, e));
    form.is_ok_and(|form| form.is_zero())
}

/// Returns true for functions that are not differentiated like analytic ones.
fn uses_conjugates(e: &Expr) -> bool {
    matches!(
        e,
        Expr::Call(Func::Re | Func::Im | Func::Abs | Func::Arg | Func::Conj, _)
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parse;

    /// A value is put in below roots as well, however deep.
    #[test]
    fn values_under_roots() {
        let mut exact = Exact::default();
        let [x, y] = ["x", "y"].map(|n| Symbol::new(n).unwrap());
        let mut at = |text: &str, s: Symbol| {
            let form = exact.value(&Definitions::default(), &parse(text).unwrap());
            let fraction = form.unwrap().as_fraction().unwrap();
            exact.poly_at(fraction.num(), s, &Fraction::integer(3))
        };
        for (text, due) in [
            ("sqrt(x + y)", "sqrt(3 + y)"),
            ("y*sqrt(x + y) + 1", "y*sqrt(3 + y) + 1"),
            ("sqrt(1 + sqrt(x))", "sqrt(1 + sqrt(3))"),
            ("sqrt(2)*sqrt(x)", "sqrt(2)*sqrt(3)"),
        ] {
            let (found, due) = (at(text, x).unwrap(), at(due, x).unwrap());
            assert_eq!(found, due, "{text}");
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
        assert_eq!(form("at(sqrt(x)^2, x, -3)").unwrap().to_string(), "-3");
        assert_eq!(
            form("at(D(sqrt(x^2), x), x, -3)").unwrap().to_string(),
            "-1"
        );
        assert_eq!(form("sqrt(x^2)").unwrap().to_string(), "x");
    }
}
