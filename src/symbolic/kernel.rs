//! Values that the algebra names without computing with them: kernels.
//!
//! A kernel is a function of a normal form, so that equal arguments give the same symbol. Relations
//! between kernels are not known: what holds for indeterminates in their place holds, and a divisor
//! with a kernel in it is accepted only if an enclosure excludes zero.

use super::enclosure::Values;
use super::error::unsupported;
use super::work::spend;
use super::{Algebra, Derivation, ExpSum, Fraction, Poly, Symbol, SymbolicError, complex};
use mechaudit_reference::{Ball, ComplexBall};

/// The function that a kernel is a value of.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Kernel {
    /// `e^p` inside of an exponent or of a root; elsewhere it is a term of the sum.
    Exp(Fraction),
    /// `1/e` for a proper sum of exponentials with first term 1.
    Inverse(ExpSum),
    /// The arc tangent of a real value.
    Arctan(Fraction),
}

impl Kernel {
    /// The polynomials of its argument.
    pub(super) fn polynomials(&self) -> Vec<&Poly> {
        match self {
            Kernel::Exp(f) | Kernel::Arctan(f) => vec![f.num(), f.den()],
            Kernel::Inverse(e) => e
                .terms()
                .flat_map(|(p, c)| [p.num(), p.den(), c.num(), c.den()])
                .collect(),
        }
    }

    /// Its function and its argument as text.
    pub(super) fn text(&self) -> (&'static str, String) {
        match self {
            Kernel::Exp(f) => ("exp", f.to_string()),
            Kernel::Arctan(f) => ("arctan", f.to_string()),
            Kernel::Inverse(e) => ("1/", e.to_string()),
        }
    }

    /// An enclosure of its value.
    pub(super) fn enclose(&self, values: &mut Values) -> Result<ComplexBall, SymbolicError> {
        let bits = values.bits;
        let real = |re| ComplexBall::new(re, Ball::integer(bits, 0));
        match self {
            Kernel::Exp(p) => Ok(values.fraction(p)?.exp()),
            Kernel::Inverse(e) => {
                complex::quotient(&real(Ball::integer(bits, 1)), &values.form(e)?)
                    .ok_or_else(|| SymbolicError::NotInvertible(e.to_string()))
            }
            // The argument is real, whatever the ball says.
            Kernel::Arctan(f) => {
                let x = values.fraction(f)?.re;
                Ok(real(x.atan2(&Ball::integer(bits, 1))))
            }
        }
    }
}

impl Algebra {
    /// The symbol of a kernel.
    fn kernel(&mut self, kernel: Kernel) -> Result<Symbol, SymbolicError> {
        if let Some((s, _)) = self.kernels().iter().find(|(_, k)| *k == kernel) {
            return Ok(*s);
        }
        let s = Symbol::named(&format!("k#{}", self.kernels().len() + 1))?;
        self.push_kernel(s, kernel);
        Ok(s)
    }

    /// A sum of exponentials as a fraction, with a kernel for each exponential.
    pub(super) fn as_kernels(&mut self, e: &ExpSum) -> Result<Fraction, SymbolicError> {
        let mut out = Fraction::zero();
        for (p, c) in e.terms() {
            out = &out + &(c * &self.exponential(p)?);
        }
        Ok(self.reduce_fraction(&out))
    }

    /// `e^p` as a power of a kernel.
    fn exponential(&mut self, p: &Fraction) -> Result<Fraction, SymbolicError> {
        if p.is_zero() {
            return Ok(Fraction::integer(1));
        }
        for (s, kernel) in self.kernels() {
            let Kernel::Exp(q) = kernel else { continue };
            let ratio = q.inverse().map(|over| &over * p);
            let k = ratio.and_then(|r| r.as_constant());
            let Some(k) = k.filter(|k| k.im.is_zero() && *k.re.denom() == 1) else {
                continue;
            };
            if let Some(k) = k.re.numer().to_u32().filter(|k| (1..=100).contains(k)) {
                return Ok(Poly::symbol(*s).pow(k).into());
            }
        }
        let s = self.kernel(Kernel::Exp(p.clone()))?;
        // The conjugate, so that there is one for it.
        if let Ok(conj) = self.conj(&p.clone().into())
            && let Some(conj) = self.reduce(&conj).as_fraction()
        {
            self.kernel(Kernel::Exp(conj))?;
        }
        Ok(Fraction::symbol(s))
    }

    /// Takes the exponentials out of a coefficient: pairs of a coefficient and an exponent.
    pub(super) fn without_kernels(&self, c: &Fraction) -> Vec<(Fraction, Fraction)> {
        let exponent = |p: &Poly, x: Symbol| {
            let kernel = self.kernels().iter().find(|(s, _)| *s == x);
            match kernel {
                Some((_, Kernel::Exp(q))) if p.contains(x) => Some(q.clone()),
                _ => None,
            }
        };
        let mut out = vec![(c.clone(), Fraction::zero())];
        for x in c.num().symbols().union(&c.den().symbols()) {
            let Some(q) = exponent(c.num(), *x).or_else(|| exponent(c.den(), *x)) else {
                continue;
            };
            let mut next = Vec::new();
            for (c, p) in out {
                if !spend(10 + c.num().terms().count() as u64) {
                    return Vec::new();
                }
                let below = c.den().coefficients(*x);
                let lowest = below.len() - 1;
                // A sum in the denominator stays.
                if below[..lowest].iter().any(|b| !b.is_zero()) {
                    next.push((c, p));
                    continue;
                }
                for (k, part) in c.num().coefficients(*x).into_iter().enumerate() {
                    let turns = Fraction::integer(k as i64 - lowest as i64);
                    if let Some(part) = Fraction::new(part, below[lowest].clone())
                        && !part.is_zero()
                    {
                        next.push((part, &p + &(&q * &turns)));
                    }
                }
            }
            out = next;
        }
        out
    }

    /// `1/e` for a proper sum of exponentials.
    pub(super) fn inverse_of_sum(&mut self, e: &ExpSum) -> Result<ExpSum, SymbolicError> {
        let refused = |algebra: &Algebra| SymbolicError::NotInvertible(algebra.text(e));
        let Some((p, c)) = e.terms().next() else {
            return Err(refused(self));
        };
        let first = ExpSum::term(self.inverse(c)?, -p);
        let unit = self.product(e, &first);
        let is_index = |x| x == Symbol::INDEX;
        let kernel = Kernel::Inverse(unit.clone());
        let of_index = kernel
            .polynomials()
            .into_iter()
            .any(|p| self.reaches(p, &is_index));
        if of_index || !super::enclosure::is_form_somewhere_not_zero(self, &unit) {
            return Err(refused(self));
        }
        let s = self.kernel(kernel)?;
        // The conjugate, so that there is one for it.
        if let Ok(conj) = self.conj(&unit) {
            self.kernel(Kernel::Inverse(self.reduce(&conj)))?;
        }
        Ok(self.product(&first, &ExpSum::symbol(s)))
    }

    /// The form times the sums that it is divided by, which is zero if the form is.
    ///
    /// # Errors
    /// As the operations in it.
    pub(super) fn cleared(&self, form: &ExpSum) -> Result<ExpSum, SymbolicError> {
        let mut out = form.clone();
        for (x, kernel) in self.kernels().iter().rev() {
            let Kernel::Inverse(sum) = kernel else {
                continue;
            };
            // Powers of the inverse, from the lowest on.
            let mut powers: Vec<(i64, ExpSum)> = Vec::new();
            let mut whole = true;
            for (p, c) in out.terms() {
                let below = c.den().coefficients(*x);
                let lowest = below.len() - 1;
                whole &= !p.contains(*x) && below[..lowest].iter().all(Poly::is_zero);
                for (k, part) in c.num().coefficients(*x).into_iter().enumerate() {
                    let Some(part) = Fraction::new(part, below[lowest].clone()) else {
                        continue;
                    };
                    powers.push((k as i64 - lowest as i64, ExpSum::term(part, p.clone())));
                }
            }
            if !whole || powers.iter().all(|(k, _)| *k == 0) {
                continue;
            }
            let top = powers.iter().map(|(k, _)| *k).max().unwrap_or(0);
            let mut sums = ExpSum::zero();
            for (k, part) in powers {
                let mut product = part;
                for _ in k..top {
                    super::work::step(1)?;
                    product = self.product(&product, sum);
                }
                sums = &sums + &product;
            }
            out = self.reduce(&sums);
        }
        Ok(out)
    }

    /// The arc tangent of a real value as a kernel; odd.
    pub(super) fn arctan_kernel(&mut self, f: &Fraction) -> Result<Fraction, SymbolicError> {
        if f.num().leading().re < 0 {
            return Ok(-&self.arctan_kernel(&-f)?);
        }
        self.kernel(Kernel::Arctan(f.clone())).map(Fraction::symbol)
    }

    /// The derivative of a kernel.
    pub(super) fn derive_kernel(
        &self,
        x: Symbol,
        kernel: &Kernel,
        d: &Derivation,
    ) -> Result<ExpSum, SymbolicError> {
        let value = ExpSum::symbol(x);
        match kernel {
            Kernel::Exp(p) => Ok(self.product(&value, &self.derive_fraction(p, d)?)),
            Kernel::Inverse(e) => {
                let square = self.product(&value, &value);
                Ok(-&self.product(&square, &self.derive(e, d)?))
            }
            Kernel::Arctan(f) => {
                let below = self.reduce_fraction(&(&Fraction::integer(1) + &(f * f)));
                let slope = self.inverse(&below)?;
                Ok(self.product(&slope.into(), &self.derive_fraction(f, d)?))
            }
        }
    }

    /// A kernel at a value of x.
    pub(super) fn kernel_at(
        exact: &mut super::Exact,
        kernel: &Kernel,
        x: Symbol,
        value: &Fraction,
    ) -> Result<Fraction, SymbolicError> {
        match kernel {
            Kernel::Exp(p) => {
                let p = exact.fraction_at(p, x, value)?;
                exact.algebra.exponential(&p)
            }
            Kernel::Arctan(f) => {
                let f = exact.fraction_at(f, x, value)?;
                let angle = exact.algebra.arctan(&f.into())?;
                exact.fraction(&angle, "an arc tangent")
            }
            Kernel::Inverse(_) => unsupported(format!("a value of {x} in a divisor")),
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::{Definitions, Identity, Outcome, parse_equation};

    fn outcome(text: &str) -> Outcome {
        Identity::of(&Definitions::default(), &parse_equation(text).unwrap()).outcome
    }

    #[test]
    fn exponentials_of_exponentials_and_quotients_of_sums() {
        for text in [
            "sin(sin(x))^2 + cos(sin(x))^2 = 1",
            "exp(a*exp(b))^2 = exp(2*a*exp(b))",
            "sin(x)/cos(x)*cos(x) = sin(x)",
            "sin(x)/(1 + cos(x)) = (1 - cos(x))/sin(x)",
            "1/(1/cos(x)) = cos(x)",
            "exp(x)/(1 + exp(x)) = 1/(1 + exp(-x))",
            "D(sin(x)/cos(x), x) = 1 + (sin(x)/cos(x))^2",
            "D(exp(sin(x)), x) = cos(x)*exp(sin(x))",
            "1/(1 - exp(-a)) - 1 = exp(-a)/(1 - exp(-a))",
            "abs(exp(i*sin(x))) = 1",
            "abs(cos(x))^2 = cos(x)^2",
            "sqrt(cos(x)^2) = abs(cos(x))",
            "abs(x - y) = abs(y - x)",
            "sqrt(y - 6*sqrt(y) + 9) = abs(sqrt(y) - 3)",
            "D(abs(x - y), x) = (x - y)/abs(x - y)",
            "arctan(-x) = -arctan(x)",
            "D(arctan(x), x) = 1/(1 + x^2)",
            "at(D(arctan(x), x), x, 1) = 1/2",
        ] {
            assert_eq!(outcome(text), Outcome::Proved, "{text}");
        }
        for text in [
            "abs(x - y) = x - y",
            "1/(abs(x - y) - x + y) = 0",
            "1/(abs(x - y) + x - y) = 1/(2*x - 2*y)",
            "1/(sin(x)^2 + cos(x)^2 - 1) = 0",
            "1/(sin(sin(x))/cos(sin(x)) - sin(sin(x))/cos(sin(x))) = 0",
            "1/(exp(-x)*cos(x)/cos(x) - exp(-x)) = 0",
            "(cos(x)/cos(x) - 1)/(cos(x)/cos(x) - 1) = 1",
            "1/(sqrt(cos(x)^2)^2 - cos(x)^2) = 0",
            "sqrt((x - y)^2*(x + 1))/sqrt(x + 1) = x - y",
            "(arctan(x) + arctan(1/x) - pi/2)/(arctan(x) + arctan(1/x) - pi/2) = 1",
            "(exp(arctan(x)) - exp(pi/2 - arctan(1/x)))/(exp(arctan(x)) - exp(pi/2 - arctan(1/x))) = 1",
        ] {
            assert_ne!(outcome(text), Outcome::Proved, "{text}");
        }
    }
}
