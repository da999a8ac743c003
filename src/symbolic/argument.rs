//! Arguments, absolute values and arc tangents in the algebra.

use super::enclosure::{Point, enclose_fraction};
use super::error::unsupported;
use super::turn::multiple_of_pi;
use super::{Algebra, ExpSum, Fraction, Gauss, Symbol, SymbolicError};
use mechaudit_reference::Ball;
use rug::Rational;
use rug::float::Round;

/// Working precision of enclosures that only suggest what is then proved, or decide how many turns
/// an angle has too many.
const BITS: u32 = 128;

/// Arguments are looked for among the multiples of π/120.
const PARTS: u32 = 120;

impl Algebra {
    /// Real and imaginary parts of a fraction.
    pub(super) fn parts(&self, f: &Fraction) -> Result<[Fraction; 2], SymbolicError> {
        let conj = self.conj(&f.clone().into())?.as_fraction();
        let conj = conj.ok_or_else(|| SymbolicError::Unsupported("a conjugate".into()))?;
        let half = Fraction::constant(Gauss::real((1, 2)));
        let over_2i = Fraction::constant(Gauss::new(0, (-1, 2)));
        let part = |g: Fraction, c: &Fraction| self.reduce_fraction(&(&g * c));
        Ok([part(f + &conj, &half), part(f - &conj, &over_2i)])
    }

    /// Returns true if the value is shown to be real.
    pub(super) fn is_real(&self, e: &ExpSum) -> bool {
        self.conj(e).is_ok_and(|conj| self.reduce(&conj) == *e)
    }

    /// Returns true if the fraction is shown to be positive for all positive values of the symbols.
    pub(super) fn is_positive_fraction(&self, f: &Fraction) -> bool {
        self.signed(f).is_some_and(|c| c.im.is_zero() && c.re > 0)
    }

    /// `|x|`. Of `c e^p` it is `|c| e^{Re p}`.
    pub(super) fn abs(&mut self, x: &ExpSum) -> Result<ExpSum, SymbolicError> {
        if let Some((p, c)) = x.as_single() {
            let [real, _] = self.parts(p)?;
            let size = self.root_of_norm(&c.clone().into())?;
            return Ok(ExpSum::term(size, real));
        }
        let size = self.root_of_norm(x)?;
        Ok(self.reduce(&size.into()))
    }

    fn root_of_norm(&mut self, x: &ExpSum) -> Result<Fraction, SymbolicError> {
        let square = self.product(x, &self.conj(x)?);
        let square = self.as_kernels(&square)?;
        self.sqrt(&square)
    }

    /// `√x`; of `c e^p` with real p it is `√c e^{p/2}`.
    pub(super) fn square_root(&mut self, x: &ExpSum) -> Result<ExpSum, SymbolicError> {
        if x.is_zero() {
            return Ok(ExpSum::zero());
        }
        if let Some((p, c)) = x.as_single()
            && self.is_real(&p.clone().into())
        {
            let half = Fraction::constant(Gauss::real((1, 2)));
            let root = self.sqrt(c)?;
            return Ok(ExpSum::term(root, p * &half));
        }
        let f = self.as_kernels(x)?;
        let root = self.sqrt(&f)?;
        Ok(self.reduce(&root.into()))
    }

    /// The argument in (−π, π] of `c e^p`, if the angle is a number or p is real.
    pub(super) fn arg(&mut self, x: &ExpSum) -> Result<ExpSum, SymbolicError> {
        let (p, c) = x
            .as_single()
            .ok_or_else(|| SymbolicError::Unsupported("the argument of a sum".into()))?;
        let [_, theta] = self.parts(p)?;
        let angle = &self.angle(c)? + &theta;
        if !self.is_constant(angle.num()) || !self.is_constant(angle.den()) {
            return unsupported("an argument whose range is not known");
        }
        self.within_half_turn(&angle).map(Into::into)
    }

    /// The argument of a constant that is a multiple of π/120, times a positive function.
    fn angle(&mut self, c: &Fraction) -> Result<Fraction, SymbolicError> {
        let unknown = || SymbolicError::Unsupported("the argument of such a number".into());
        let mut constant = c.clone();
        if !self.is_constant(c.num()) || !self.is_constant(c.den()) {
            let size = self.root_of_norm(&c.clone().into())?;
            constant = self.reduce_fraction(&(c * &self.inverse(&size)?));
        }
        if !self.is_constant(constant.num()) || !self.is_constant(constant.den()) {
            return Err(unknown());
        }
        let value = enclose_fraction(self, &constant, &Point::default(), BITS)?;
        let turn = &value.arg() / &Ball::pi(BITS);
        let parts = turn.mid().to_f64() * f64::from(PARTS);
        let part = Rational::from_f64(parts.round()).ok_or_else(unknown)? / PARTS;
        let back = Fraction::constant(Gauss::new(0, -part.clone()));
        let pi = Fraction::symbol(Symbol::PI);
        let unity = self.unity(&(&pi * &back))?.as_fraction();
        let turned = self.reduce_fraction(&(&constant * &unity.ok_or_else(unknown)?));
        match self.is_positive_fraction(&turned) {
            true => Ok(&pi * &Fraction::constant(Gauss::real(part))),
            false => Err(unknown()),
        }
    }

    /// A constant angle less the whole turns that bring it into (−π, π].
    fn within_half_turn(&self, angle: &Fraction) -> Result<Fraction, SymbolicError> {
        let pi = Fraction::symbol(Symbol::PI);
        let minus = |turns: Rational| {
            let whole = &pi * &Fraction::constant(Gauss::real(turns * 2u32));
            self.reduce_fraction(&(angle - &whole))
        };
        let of_pi = multiple_of_pi(angle).map_or_else(Rational::new, |c| c.re);
        let multiple = &pi * &Fraction::constant(Gauss::real(of_pi.clone()));
        if *angle == multiple {
            // (q − 1)/2 rounded up.
            return Ok(minus(((of_pi - 1u32) / 2u32).ceil()));
        }
        let value = enclose_fraction(self, angle, &Point::default(), BITS)?;
        let turns = (&value.re / &Ball::pi(BITS)).shift(-1);
        let nearest = turns.mid().clone().round();
        let found = nearest
            .to_integer_round(Round::Nearest)
            .map(|(n, _)| minus(Rational::from(n)));
        let Some(found) = found else {
            return unsupported("an argument whose range is not known");
        };
        let value = enclose_fraction(self, &found, &Point::default(), BITS)?;
        let (low, high) = (&value.re + &Ball::pi(BITS), &Ball::pi(BITS) - &value.re);
        match low.is_positive() && high.is_positive() {
            true => Ok(found),
            false => unsupported("an argument whose range is not known"),
        }
    }

    /// The arc tangent of a real number: the argument of `1 + ix`.
    pub(super) fn arctan(&mut self, x: &ExpSum) -> Result<ExpSum, SymbolicError> {
        let Some(f) = x.as_fraction().filter(|_| self.is_real(x)) else {
            return unsupported("an arc tangent");
        };
        let up = &Fraction::integer(1) + &(&Fraction::constant(Gauss::i()) * &f);
        if f.is_zero() {
            return Ok(ExpSum::zero());
        }
        match self.angle(&self.reduce_fraction(&up)) {
            Err(SymbolicError::Unsupported(_)) => self.arctan_kernel(&f).map(Into::into),
            found => found.map(Into::into),
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::{Definitions, Identity, Outcome, parse_equation};

    fn outcome(text: &str) -> Outcome {
        let lines = ["z = r*exp(i*p)"];
        let equation = parse_equation(text).unwrap();
        Identity::of(&Definitions::read(&lines).unwrap(), &equation).outcome
    }

    #[test]
    fn arguments_lie_in_their_range() {
        for text in [
            "arg(exp(7*i)) = 7 - 2*pi",
            "D(x, x)*arg(exp(7*i)) = 7 - 2*pi",
            "arg(exp(5*i*pi/4)) = -3*pi/4",
            "arg(exp(9*i*pi/7)) = -5*pi/7",
            "arg(exp(-7*i*pi)) = pi",
            "arg(-x) = pi",
            "arg(x/y) = 0",
            "arg(exp(x)) = 0",
            "arg(-i*x*exp(x)) = -pi/2",
            "arg(1 + i) = pi/4",
            "arg(i*sqrt(3) - 1) = 2*pi/3",
            "arg((1 + i)*(x + y)) = pi/4",
            "arg(r*exp(2*i*pi/3)*sqrt(x)) = 2*pi/3",
            "arg(exp(i)*exp(2*i)) = 3",
            "arg(-exp(3*i)) = 3 - pi",
            "abs(exp(x + i*y)) = exp(x)",
            "abs(-x) = x",
            "abs(1 + i*x) = sqrt(1 + x^2)",
            "sqrt(exp(2*x)) = exp(x)",
            "arctan(1) = pi/4",
            "arctan(-1/sqrt(3)) = -pi/6",
            "arctan(2 - sqrt(3)) = pi/12",
        ] {
            assert_eq!(outcome(text), Outcome::Proved, "{text}");
        }
        for text in [
            "arg(exp(7*i)) = 7",
            "arg(exp(5*i*pi/4)) = 5*pi/4",
            "arg(exp(4*i*x)) = 4*x",
            "arg(z^3) = 3*arg(z)",
            "arg(exp(i*sqrt(x - y))) = sqrt(x - y)",
            "arg(r*exp(i*x)) = x",
            "abs(x - y) = x - y",
            "sqrt(exp(2*i)) = exp(2*i)",
            "sqrt(exp(6*i)) = exp(3*i)",
            "arctan(2) = pi/3",
            "arg(x - y) = 0",
        ] {
            assert_ne!(outcome(text), Outcome::Proved, "{text}");
        }
        // At the cut an enclosure holds neither side.
        for text in [
            "arg(y*exp(-i*pi)) + sqrt(x)*sqrt(y) - sqrt(x*y) = pi",
            "at((z^2 - 1)/(z - 1), z, 1 + arg(y*exp(-i*pi)) - pi) = 2",
        ] {
            assert_ne!(outcome(text), Outcome::Refuted, "{text}");
        }
    }
}
