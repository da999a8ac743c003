//! Square roots adjoined to the rational functions, the antiderivative of `e^{z²}`, derivations.

use super::error::unsupported;
use super::gcd::{coprime, squarefree};
use super::{ExpSum, Fraction, Gauss, Poly, Symbol, SymbolicError};
use rug::{Integer, Rational};
use std::collections::BTreeMap;

/// Images of symbols under a derivation; symbols that are not named are constants.
pub type Derivation = BTreeMap<Symbol, ExpSum>;

/// What has been adjoined so far.
///
/// * Square roots: `s² = P` with P squarefree and coprime to the radicands before it, so that no
///   product of radicands is a square and the products of distinct roots are linearly independent.
///   A normal form has every root to the first power at most and none in a denominator. Symbols
///   under a root are taken to be positive: `√(x²) = x`. Variables of integrals and symbols for which a value
///   is put in have any sign; a root of them is refused.
/// * `G(z) = ∫_0^z e^{s²} ds` for rational functions z: odd, `G(0) = 0`, `dG = e^{z²} dz`. Values at
///   different arguments are kept as independent; that is enough to prove identities. A normal form
///   that is not zero is called non-zero only after an enclosure at a point has excluded zero.
#[derive(Clone, Debug, Default)]
pub struct Algebra {
    roots: Vec<(Symbol, Poly)>,
    antiderivatives: Vec<(Symbol, Fraction)>,
    /// Symbols that stand for values of any sign at present, as often as they are bound.
    unsigned: Vec<Symbol>,
}

impl Algebra {
    /// Nothing adjoined.
    pub fn new() -> Algebra {
        Algebra::default()
    }

    /// The adjoined roots with their radicands.
    pub fn roots(&self) -> &[(Symbol, Poly)] {
        &self.roots
    }

    /// The arguments z of the values `G(z)` in use.
    pub fn antiderivatives(&self) -> &[(Symbol, Fraction)] {
        &self.antiderivatives
    }

    /// What is made by `f`, in which x may have either sign.
    pub(super) fn unsigned<T>(
        exact: &mut super::Exact,
        x: Symbol,
        f: impl FnOnce(&mut super::Exact) -> T,
    ) -> T {
        exact.algebra.unsigned.push(x);
        let out = f(exact);
        exact.algebra.unsigned.pop();
        out
    }

    /// Whether the symbol's value is positive whatever the values of the free symbols, which are positive.
    fn is_positive_symbol(&self, x: Symbol) -> bool {
        if self.unsigned.contains(&x) || self.antiderivatives.iter().any(|(g, _)| *g == x) {
            return false;
        }
        let root = self.roots.iter().find(|(s, _)| *s == x);
        root.is_none_or(|(_, radicand)| self.is_positive(radicand))
    }

    /// Whether all terms of p are positive.
    pub(super) fn is_positive(&self, p: &Poly) -> bool {
        !p.is_zero()
            && p.terms().all(|(_, c)| c.im.is_zero() && c.re > 0)
            && p.symbols().into_iter().all(|x| self.is_positive_symbol(x))
    }

    /// Whether p depends on x otherwise than as a polynomial in it: by a root or an integral.
    pub(super) fn hides(&self, p: &Poly, x: Symbol) -> bool {
        let depends = |q: &Poly| q.contains(x) || self.hides(q, x);
        p.symbols().into_iter().any(|y| {
            let root = self.roots.iter().find(|(s, _)| *s == y);
            let value = self.antiderivatives.iter().find(|(g, _)| *g == y);
            root.is_some_and(|(_, radicand)| depends(radicand))
                || value.is_some_and(|(_, z)| depends(z.num()) || depends(z.den()))
        })
    }

    /// With every root to the first power at most.
    fn reduce_poly(&self, p: &Poly) -> Poly {
        let mut out = p.clone();
        for (s, radicand) in &self.roots {
            if !out
                .terms()
                .any(|(m, _)| m.iter().any(|f| f.0 == *s && f.1 > 1))
            {
                continue;
            }
            let mut halves = [Poly::zero(), Poly::zero()];
            let mut power = Poly::integer(1);
            for pair in out.coefficients(*s).chunks(2) {
                for (half, c) in halves.iter_mut().zip(pair) {
                    *half = &*half + &(c * &power);
                }
                power = &power * radicand;
            }
            out = Poly::from_coefficients(*s, &halves);
        }
        out
    }

    /// The normal form of a rational function of symbols and roots.
    pub fn reduce_fraction(&self, f: &Fraction) -> Fraction {
        let touched = |p: &Poly| self.roots.iter().any(|(s, _)| p.contains(*s));
        if !touched(f.num()) && !touched(f.den()) {
            return f.clone();
        }
        let mut num = self.reduce_poly(f.num());
        let mut den = self.reduce_poly(f.den());
        for (s, _) in &self.roots {
            if !den.contains(*s) {
                continue;
            }
            // (a + b s)(a − b s) = a² − b² P.
            let mut c = den.coefficients(*s);
            if let Some(b) = c.get_mut(1) {
                *b = -&*b;
            }
            let other = Poly::from_coefficients(*s, &c);
            num = self.reduce_poly(&(&num * &other));
            den = self.reduce_poly(&(&den * &other));
        }
        // A zero denominator cannot arise: a² = b² P would make P a square.
        Fraction::new(num, den).unwrap_or_else(Fraction::zero)
    }

    /// The normal form of a sum of exponentials.
    pub fn reduce(&self, e: &ExpSum) -> ExpSum {
        let mut out = ExpSum::zero();
        for (p, c) in e.terms() {
            let (unit, p) = half_turns(&self.reduce_fraction(p));
            let c = self.reduce_fraction(c);
            let c = if unit.is_one() {
                c
            } else {
                &c * &Fraction::constant(unit)
            };
            out.accumulate(c, p);
        }
        out
    }

    /// The product in normal form.
    pub fn product(&self, a: &ExpSum, b: &ExpSum) -> ExpSum {
        self.reduce(&(a * b))
    }

    /// The quotient in normal form.
    ///
    /// # Errors
    /// [`SymbolicError::NotInvertible`] if b is zero or a proper sum of exponentials.
    pub fn quotient(&self, a: &ExpSum, b: &ExpSum) -> Result<ExpSum, SymbolicError> {
        let inverse = b.inverse();
        let inverse = inverse.ok_or_else(|| SymbolicError::NotInvertible(b.to_string()))?;
        Ok(self.product(a, &inverse))
    }

    /// `e^x` of an x without exponentials.
    ///
    /// # Errors
    /// [`SymbolicError::Unsupported`] for an exponent that is itself a sum of exponentials.
    pub fn exp(&self, x: &ExpSum) -> Result<ExpSum, SymbolicError> {
        let p = x
            .as_fraction()
            .ok_or_else(|| SymbolicError::Unsupported("an exponential of an exponential".into()))?;
        Ok(self.reduce(&ExpSum::term(Fraction::integer(1), p)))
    }

    fn adjoin(&mut self, name: Option<String>, radicand: Poly) -> Result<Fraction, SymbolicError> {
        if let Some((s, _)) = self.roots.iter().find(|(_, p)| *p == radicand) {
            return Ok(Fraction::symbol(*s));
        }
        let constant = |p: &Poly| p.as_constant().is_some();
        let known = self.roots.iter().filter(|(_, p)| !constant(p));
        let independent = constant(&radicand)
            || (squarefree(&radicand) && known.into_iter().all(|(_, p)| coprime(p, &radicand)));
        if !independent {
            return Err(SymbolicError::Root(radicand.to_string()));
        }
        let name = name.unwrap_or_else(|| format!("r#{}", self.roots.len() + 1));
        let s = Symbol::named(&name)?;
        self.roots.push((s, radicand));
        Ok(Fraction::symbol(s))
    }

    /// The square root of a rational function whose denominator is a monomial. Roots of symbols, of
    /// primes and of one squarefree polynomial are adjoined as they are needed.
    ///
    /// # Errors
    /// [`SymbolicError::Root`] for a radicand that is not squarefree or shares a factor with an
    /// earlier one; [`SymbolicError::Unsupported`] for another denominator.
    pub fn sqrt(&mut self, f: &Fraction) -> Result<Fraction, SymbolicError> {
        if f.is_zero() {
            return Ok(Fraction::zero());
        }
        if f.den().terms().count() != 1 || !self.is_positive(f.den()) {
            return unsupported(format!("the root of {f}"));
        }
        // √(num/den) = √(num den)/den, den > 0.
        let p = f.num() * f.den();
        if let Some(x) = p
            .symbols()
            .into_iter()
            .find(|x| !self.is_positive_symbol(*x))
        {
            return unsupported(format!("a root of {x}, which may have any sign"));
        }
        let mut out = f.inverse_of_denominator();
        let lead = p.leading();
        let mut rest = p.scaled(&lead.inverse().unwrap_or_default());
        for x in p.symbols() {
            let lowest = rest.coefficients(x).iter().position(|c| !c.is_zero());
            let k = lowest.unwrap_or(0) as u32;
            if k == 0 {
                continue;
            }
            let x_poly = Poly::symbol(x);
            rest = rest.divided_by(&x_poly.pow(k)).unwrap_or(rest);
            out = &out * &Fraction::from(x_poly.pow(k / 2));
            if k % 2 == 1 {
                let name = format!("r:{x}");
                out = &out * &self.adjoin(Some(name), x_poly)?;
            }
        }
        // √(c P) = √c √P where c or P is positive. Else only |c| comes out: √(y − x) is not i√(x − y) where
        // y > x.
        let outside = match () {
            () if lead.im.is_zero() && lead.re > 0 || self.is_positive(&rest) => lead,
            () if lead.im.is_zero() => {
                rest = rest.scaled(&Gauss::real(-1));
                -&lead
            }
            () => {
                rest = rest.scaled(&lead);
                Gauss::real(1)
            }
        };
        out = &out * &self.sqrt_constant(&outside)?;
        if !rest.is_one() {
            out = &out * &self.adjoin(None, rest)?;
        }
        Ok(self.reduce_fraction(&out))
    }

    /// `√c = w √r` with w Gaussian rational and r a product of distinct primes.
    fn sqrt_constant(&mut self, c: &Gauss) -> Result<Fraction, SymbolicError> {
        if let Some(w) = c.sqrt() {
            return Ok(Fraction::constant(w));
        }
        let (real, tried) = (c.im.is_zero(), [2, 3, 5, 6, 7, 10, 11, 13, 14, 15]);
        let (w, primes) = if real {
            let size = Rational::from(c.re.abs_ref());
            // a/b = ab/b².
            let (square, primes) = split(&Integer::from(size.numer() * size.denom()))
                .ok_or_else(|| SymbolicError::Root(c.to_string()))?;
            let w = Rational::from((square, size.denom().clone()));
            let unit = if c.re < 0 { Gauss::i() } else { Gauss::real(1) };
            (&unit * &Gauss::real(w), primes)
        } else {
            let found = tried.iter().find_map(|&r| {
                let w = (c * &Gauss::real((1, r))).sqrt()?;
                Some((w, split(&Integer::from(r))?.1))
            });
            found.ok_or_else(|| SymbolicError::Root(c.to_string()))?
        };
        let mut out = Fraction::constant(w);
        for p in primes {
            out = &out * &self.adjoin(Some(format!("r:{p}")), Poly::integer(p))?;
        }
        Ok(out)
    }

    /// `G(z) = ∫_0^z e^{s²} ds`.
    ///
    /// # Errors
    /// [`SymbolicError::Name`] if there are more values than names.
    pub fn antiderivative(&mut self, z: &Fraction) -> Result<Fraction, SymbolicError> {
        let z = self.reduce_fraction(z);
        let lead = z.num().leading();
        if z.is_zero() {
            return Ok(Fraction::zero());
        }
        if lead.re < 0 || (lead.re.is_zero() && lead.im < 0) {
            return Ok(-&self.antiderivative(&-&z)?);
        }
        if let Some((g, _)) = self.antiderivatives.iter().find(|(_, y)| *y == z) {
            return Ok(Fraction::symbol(*g));
        }
        let g = Symbol::named(&format!("G:{}", self.antiderivatives.len() + 1))?;
        self.antiderivatives.push((g, z));
        Ok(Fraction::symbol(g))
    }

    /// A normal form as text, with `sqrt(…)` for the roots and `G(…)` for the antiderivative.
    pub fn text(&self, e: &ExpSum) -> String {
        self.spelled(&e.to_string())
    }

    /// With what generated names stand for in their places: of it others may be part.
    fn spelled(&self, text: &str) -> String {
        let roots = self.roots.iter();
        let roots = roots.map(|(s, p)| (s.name(), "sqrt", p.to_string()));
        let values = self.antiderivatives.iter();
        let values = values.map(|(g, z)| (g.name(), "G", z.to_string()));
        let mut names: Vec<_> = roots.chain(values).collect();
        // G:12 is not G:1.
        names.sort_by_key(|(name, ..)| std::cmp::Reverse(name.len()));
        let (mut out, mut rest) = (String::new(), text);
        while let Some(c) = rest.chars().next() {
            let found = names.iter().find(|(name, ..)| rest.starts_with(name));
            let passed = if let Some((name, function, inner)) = found {
                out += &format!("{function}({})", self.spelled(inner));
                name.len()
            } else {
                out.push(c);
                c.len_utf8()
            };
            rest = &rest[passed..];
        }
        out
    }

    /// Conjugated, all symbols being real.
    ///
    /// # Errors
    /// [`SymbolicError::Unsupported`] if a value of G is left, whose argument is complex, or a root of what may be
    /// negative.
    pub fn conj(&self, e: &ExpSum) -> Result<ExpSum, SymbolicError> {
        let complex = |(s, p): &&(Symbol, Poly)| e.contains(*s) && !self.is_positive(p);
        if let Some((_, p)) = self.roots.iter().find(complex) {
            return unsupported(format!(
                "the conjugate of the root of {p}, which may be negative"
            ));
        }
        if self.antiderivatives.iter().any(|(g, _)| e.contains(*g)) {
            return unsupported("the conjugate of an integral");
        }
        Ok(e.conj())
    }

    fn derive_fraction(&self, f: &Fraction, d: &Derivation) -> Result<ExpSum, SymbolicError> {
        let mut symbols = f.num().symbols();
        symbols.extend(f.den().symbols());
        let mut out = ExpSum::zero();
        for x in symbols {
            let dx = if let Some((_, p)) = self.roots.iter().find(|(s, _)| *s == x) {
                let dp = self.derive_fraction(&Fraction::from(p.clone()), d)?;
                let twice = Fraction::from(Poly::symbol(x).scaled(&Gauss::real(2)));
                self.quotient(&dp, &twice.into())?
            } else if let Some((_, z)) = self.antiderivatives.iter().find(|(g, _)| *g == x) {
                let dz = self.derive_fraction(z, d)?;
                let square = self.reduce_fraction(&(z * z));
                self.product(&dz, &ExpSum::term(Fraction::integer(1), square))
            } else if let Some(image) = d.get(&x) {
                image.clone()
            } else {
                continue;
            };
            out = &out + &self.product(&dx, &f.derivative(x).into());
        }
        Ok(self.reduce(&out))
    }

    /// The derivation d applied to e: linear, Leibniz's rule, `d e^p = e^p dp`.
    ///
    /// # Errors
    /// As the operations in it.
    pub fn derive(&self, e: &ExpSum, d: &Derivation) -> Result<ExpSum, SymbolicError> {
        let mut out = ExpSum::zero();
        for (p, c) in e.terms() {
            let dc = self.derive_fraction(c, d)?;
            let dp = self.derive_fraction(p, d)?;
            let inner = &dc + &self.product(&dp, &c.clone().into());
            let unit = ExpSum::term(Fraction::integer(1), p.clone());
            out = &out + &self.product(&inner, &unit);
        }
        Ok(self.reduce(&out))
    }
}

/// `n = square² × primes`, for numbers whose prime factors are small.
fn split(n: &Integer) -> Option<(Integer, Vec<i64>)> {
    let (mut rest, mut square, mut primes) = (n.clone(), Integer::from(1), Vec::new());
    for p in 2..10_000_i64 {
        let mut count = 0;
        while rest.is_divisible(&Integer::from(p)) {
            rest /= p;
            count += 1;
        }
        for _ in 0..count / 2 {
            square *= p;
        }
        if count % 2 == 1 {
            primes.push(p);
        }
    }
    if rest == 1 {
        return Some((square, primes));
    }
    rest.is_perfect_square()
        .then(|| (square * rest.sqrt(), primes))
}

/// `e^{iπk/2} = i^k`: the unit and what is left of the exponent.
fn half_turns(p: &Fraction) -> (Gauss, Fraction) {
    let one = || (Gauss::real(1), p.clone());
    let Some(pi) = Symbol::new("pi") else {
        return one();
    };
    // p = c π + (the rest), with c read off at π times the leading monomial of the denominator.
    let Some((lead, _)) = p.den().terms().last() else {
        return one();
    };
    let at = &Poly::symbol(pi) * &Poly::monomial(lead);
    let Some((_, c)) = at
        .terms()
        .next()
        .and_then(|(m, _)| p.num().terms().find(|t| t.0 == m))
    else {
        return one();
    };
    let twice = Rational::from(&c.im * 2u32);
    match twice.numer().to_i64() {
        Some(k) if c.re.is_zero() && *twice.denom() == 1 => {
            let turned = Fraction::from(Poly::symbol(pi).scaled(c));
            (Gauss::i_power(k), p - &turned)
        }
        _ => one(),
    }
}

#[cfg(test)]
#[path = "algebra_tests.rs"]
mod tests;
