//! Principal square roots in an [`Algebra`].

use super::enclosure::{Point, enclose_fraction};
use super::error::unsupported;
use super::kernel::Kernel;
use super::{Algebra, Fraction, Gauss, Poly, Symbol, SymbolicError};
use rug::{Integer, Rational};

/// Working precisions at which the sign of a constant is looked for; that it is not zero is known
/// before.
const PRECISIONS: [u32; 3] = [128, 512, 2048];

/// Sample points at which the sign of a function is looked for.
const SAMPLES: u32 = 3;

impl Algebra {
    /// Returns true if the symbol's value is positive for all positive values of the free symbols.
    fn is_positive_symbol(&self, x: Symbol) -> bool {
        if self.is_unsigned(x) || self.antiderivatives().iter().any(|(g, _)| *g == x) {
            return false;
        }
        if let Some((_, kernel)) = self.kernels().iter().find(|(k, _)| *k == x) {
            return match kernel {
                Kernel::Exp(p) => self.is_real(&p.clone().into()),
                _ => false,
            };
        }
        let root = self.roots().iter().find(|(s, _)| *s == x);
        root.is_none_or(|(_, radicand)| self.is_positive(radicand))
    }

    /// Returns true if p is shown to be positive for all positive values of the free symbols: its
    /// terms are, or it is a real constant whose enclosure is.
    pub(super) fn is_positive(&self, p: &Poly) -> bool {
        if p.is_zero()
            || !p.terms().all(|(_, c)| c.im.is_zero())
            || !p.symbols().into_iter().all(|x| self.is_positive_symbol(x))
        {
            return false;
        }
        p.terms().all(|(_, c)| c.re > 0) || self.is_positive_constant(p)
    }

    /// Decides by enclosures whether a real number that is not zero is positive.
    fn is_positive_constant(&self, p: &Poly) -> bool {
        if !self.is_constant(p) {
            return false;
        }
        let f = Fraction::from(p.clone());
        let value = |bits| enclose_fraction(self, &f, &Point::default(), bits).ok();
        let decided = PRECISIONS
            .iter()
            .filter_map(|bits| value(*bits))
            .find(|z| z.re.is_positive() || z.re.is_negative());
        decided.is_some_and(|z| z.re.is_positive())
    }

    /// Returns true if no symbol but π is in p or in the radicands of its roots.
    pub(super) fn is_constant(&self, p: &Poly) -> bool {
        p.symbols().into_iter().all(|x| {
            let root = self.roots().iter().find(|(s, _)| *s == x);
            x.name() == "pi" || root.is_some_and(|(_, radicand)| self.is_constant(radicand))
        })
    }

    /// Returns a fraction's constant factor c if the rest is positive for all positive values of
    /// the symbols.
    pub(super) fn signed(&self, f: &Fraction) -> Option<Gauss> {
        let c = f.num().leading();
        let rest = f.num().scaled(&c.inverse()?);
        (self.is_positive(&rest) && self.is_positive(f.den())).then_some(c)
    }

    /// Returns ±g, whichever has a positive real part, or real part zero and imaginary part ≥ 0,
    /// for all positive values of the symbols; `radicand` is g².
    fn principal(&self, g: &Fraction, radicand: &Poly) -> Result<Fraction, SymbolicError> {
        let half_plane = |c: &Gauss| c.re > 0 || (c.re.is_zero() && c.im >= 0);
        if let Some(c) = self.signed(g) {
            return Ok(if half_plane(&c) { g.clone() } else { -g });
        }
        if self.is_constant(g.num()) && self.is_constant(g.den()) {
            let conj = self.conj(&g.clone().into()).ok();
            let imaginary = conj.is_some_and(|conj| conj == (-g).into());
            for bits in PRECISIONS {
                let Ok(z) = enclose_fraction(self, g, &Point::default(), bits) else {
                    continue;
                };
                let part = if imaginary { &z.im } else { &z.re };
                if part.is_positive() {
                    return Ok(g.clone());
                }
                if part.is_negative() {
                    return Ok(-g);
                }
            }
        }
        if self.is_positive(radicand) && self.is_analytic(g) {
            // g is meromorphic and g² has neither zeros nor poles: g keeps its sign where the
            // symbols are positive.
            for number in 0..SAMPLES {
                let value = enclose_fraction(self, g, &Point::sample(number), PRECISIONS[0]);
                match value {
                    Ok(z) if z.re.is_positive() => return Ok(g.clone()),
                    Ok(z) if z.re.is_negative() => return Ok(-g),
                    _ => {}
                }
            }
        }
        Err(SymbolicError::Root(
            self.text(&Fraction::from(radicand.clone()).into()),
        ))
    }

    /// Returns true if f is a quotient of real functions that are analytic where the symbols are
    /// positive.
    fn is_analytic(&self, f: &Fraction) -> bool {
        [f.num(), f.den()].into_iter().all(|p| {
            let is_apart = |x| self.is_dependent(x);
            !self.reaches(p, &is_apart)
                && p.terms().all(|(_, c)| c.im.is_zero())
                && p.symbols().into_iter().all(|x| self.is_positive_symbol(x))
        })
    }

    /// The principal root of a polynomial: an element of the field if the polynomial is a square
    /// there, else a new symbol s with `s² = radicand`.
    fn adjoin(&mut self, name: Option<String>, radicand: Poly) -> Result<Fraction, SymbolicError> {
        if let Some((s, _)) = self.roots().iter().find(|(_, p)| *p == radicand) {
            return Ok(Fraction::symbol(*s));
        }
        let root = self.root_within(&Fraction::from(radicand.clone()));
        if let Some(Ok(root)) = root.as_ref().map(|root| self.principal(root, &radicand)) {
            return Ok(root);
        }
        let name = name
            .and_then(|name| Symbol::new(&name))
            .unwrap_or(Symbol::named(&format!("r#{}", self.roots().len() + 1))?);
        // √((x − y)²) is x − y or y − x: a root all the same, but its tower is no field.
        let of_dependent = |x| self.is_dependent(x);
        if root.is_some() || self.reaches(&radicand, &of_dependent) {
            let of_real = root.is_some_and(|root| self.is_real(&root.into()));
            self.push_dependent(name, of_real);
        }
        self.push_root(name, radicand);
        Ok(Fraction::symbol(name))
    }

    /// The principal square root of a rational function whose denominator is positive.
    ///
    /// Roots of symbols, of primes and of what is left are adjoined as they are needed, unless the
    /// radicand is a square already: `√(3 + 2√2) = 1 + √2`.
    ///
    /// # Errors
    /// [`SymbolicError::Root`] of a number with large prime factors;
    /// [`SymbolicError::Unsupported`] for a denominator that may be negative.
    pub fn sqrt(&mut self, f: &Fraction) -> Result<Fraction, SymbolicError> {
        let f = &self.reduce_fraction(f);
        if f.is_zero() {
            return Ok(Fraction::zero());
        }
        if !self.is_positive(f.den()) {
            return unsupported(format!("the root of {f}"));
        }
        // √(num/den) = √(num den)/den, den > 0.
        let p = self.reduce_fraction(&Fraction::from(f.num() * f.den()));
        let p = p.num().clone();
        let mut out = f.inverse_of_denominator();
        let lead = p.leading();
        let mut rest = p.scaled(&lead.inverse().unwrap_or_default());
        for x in p.symbols() {
            if !self.is_positive_symbol(x) {
                continue;
            }
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
        // √(R Q) = √R √Q for positive R, of which there may be a root.
        let of_positive: Vec<(Symbol, Poly)> = self
            .roots()
            .iter()
            .filter(|(_, r)| !r.symbols().is_empty() && self.is_positive(r))
            .cloned()
            .collect();
        for (s, radicand) in of_positive {
            if let Some(quotient) = rest.divided_by(&radicand).filter(|_| !rest.is_one()) {
                rest = quotient;
                out = &out * &Fraction::symbol(s);
            }
        }
        // √(c P) = √c √P where c or P is positive. Else only |c| comes out: √(y − x) is not
        // i√(x − y) where y > x.
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
        // A square is recognised before the roots of its constant factors are adjoined, so that
        // √(2(x + y)²) and √(8 + 4√3) find theirs among the roots there are.
        out = &out * &self.sqrt_constant(&outside)?;
        if !rest.is_one() {
            out = &out * &self.adjoin(None, rest)?;
        }
        Ok(self.reduce_fraction(&out))
    }

    /// `√c = w √r` with w Gaussian rational and r a product of distinct primes, or a new root of a
    /// number that is not real.
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
            match found {
                Some(found) => found,
                None => return self.adjoin(None, Poly::constant(c.clone())),
            }
        };
        let mut out = Fraction::constant(w);
        for p in primes {
            out = &out * &self.adjoin(Some(format!("r:{p}")), Poly::integer(p))?;
        }
        Ok(out)
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
