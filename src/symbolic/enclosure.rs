//! Expressions in balls, straight from the data and without the algebra; normal forms in balls.

use super::complex;
use super::error::unsupported;
use super::exact::Exact;
use super::expr::{Bound, Expr, Func};
use super::jet::Jets;
use super::series;
use super::walk::{Definitions, Domain, Scope, walk};
use super::work::{LIMIT, limited, step};
use super::{Algebra, ExpSum, Fraction, Gauss, Poly, Symbol, SymbolicError};
use mechaudit_reference::{Ball, ComplexBall, Mag};
use rug::Rational;
use std::cell::RefCell;
use std::collections::BTreeMap;

/// Working precision of enclosures.
pub const BITS: u32 = 128;

/// Rational values of the symbols.
///
/// A name without a value is an error, except at a sample: there it has a value between 1/2 and 3/2
/// that depends on the name, so that distinct symbols have distinct values. What holds at a sample is
/// shown for that point alone; samples serve to refute.
#[derive(Clone, Debug, Default)]
pub struct Point {
    /// The named values.
    pub named: BTreeMap<String, Rational>,
    /// The number of the sample, which changes the values that are not named; `None` if every name
    /// has to have a value.
    pub sample: Option<u32>,
}

impl Point {
    /// Returns the sample of that number, without named values.
    pub fn sample(number: u32) -> Point {
        Point {
            named: BTreeMap::new(),
            sample: Some(number),
        }
    }

    /// Returns the value of a symbol.
    ///
    /// # Errors
    /// [`SymbolicError::NoValue`] if it has none.
    pub fn value(&self, name: &str) -> Result<Rational, SymbolicError> {
        if let Some(q) = self.named.get(name) {
            return Ok(q.clone());
        }
        let turn = self
            .sample
            .ok_or_else(|| SymbolicError::NoValue(name.into()))?;
        // The index of a series is an integer; without the sum, what stands beside it is seen.
        if name == Symbol::INDEX.name() {
            return Ok(Rational::from(turn + 1));
        }
        if name == Symbol::SERIES.name() {
            return Ok(Rational::from((turn + 1) % 2));
        }
        // FNV-1a, reduced to a fraction with a small denominator.
        let start = 0xcbf2_9ce4_8422_2325 ^ u64::from(turn);
        let hash = name.bytes().fold(start, |h, b| {
            (h ^ u64::from(b)).wrapping_mul(0x0100_0000_01b3)
        });
        let below = 89 + (hash >> 40) % 30;
        let above = below / 2 + (hash >> 8) % below;
        // The last samples are larger and smaller, for what holds between 1/2 and 3/2 alone.
        let scale = match turn {
            4 => Rational::from(5),
            5 => Rational::from((1, 5)),
            _ => Rational::from(1),
        };
        Ok(Rational::from((above, below)) * scale)
    }
}

/// Values of definitions and integrals at one point, for the many candidates of a search that
/// differ in the printed form only.
#[derive(Debug, Default)]
pub struct Cache {
    changing: Vec<String>,
    values: RefCell<BTreeMap<String, ComplexBall>>,
}

impl Cache {
    /// Empty; whatever depends on one of these names is not kept.
    pub fn new(changing: &[&str]) -> Cache {
        Cache {
            changing: changing.iter().map(|n| n.to_string()).collect(),
            values: RefCell::default(),
        }
    }

    fn get(&self, key: &str) -> Option<ComplexBall> {
        self.values.borrow().get(key).cloned()
    }

    fn keep(&self, definitions: &Definitions, e: &Expr, key: String, value: &ComplexBall) {
        let changing: Vec<&str> = self.changing.iter().map(String::as_str).collect();
        if !definitions.reaches(e, &changing) {
            self.values.borrow_mut().insert(key, value.clone());
        }
    }
}

/// Evaluates in balls at a point.
pub struct Enclosures<'a> {
    point: &'a Point,
    cache: Option<&'a Cache>,
}

impl<'a> Enclosures<'a> {
    /// At that point.
    pub fn new(point: &'a Point) -> Enclosures<'a> {
        Enclosures { point, cache: None }
    }

    /// At that point, which has to be the same whenever this cache is used.
    pub fn remembering(point: &'a Point, cache: &'a Cache) -> Enclosures<'a> {
        Enclosures {
            point,
            cache: Some(cache),
        }
    }

    /// An enclosure of the value.
    ///
    /// # Errors
    /// Divisors that may be zero, roots of complex numbers, derivatives.
    pub fn value(
        &mut self,
        definitions: &Definitions,
        e: &Expr,
    ) -> Result<ComplexBall, SymbolicError> {
        limited(LIMIT, || {
            series::check(definitions, e)?;
            walk(self, &mut Scope::new(definitions), e)
        })
    }
}

/// Radius of the circle for Cauchy's bound, the path of integration having length one.
const CIRCLE: i64 = 4;
const _: () = assert!((CIRCLE as u64).is_power_of_two());

impl Enclosures<'_> {
    /// The integral over a straight path, by the Taylor series of the integrand, with Cauchy's
    /// bound `|f_k| ≤ M R^{-k}` for the coefficients that are left out.
    fn piece(
        &mut self,
        scope: &mut Scope<ComplexBall>,
        bound: &Bound,
        from: &ComplexBall,
        step: &ComplexBall,
    ) -> Result<ComplexBall, SymbolicError> {
        // The products of series below are many times the nodes of the expression.
        super::work::step(200)?;
        let mut jets = Jets { point: self.point };
        let mut inner = scope.with_values(|v| vec![v.clone()]);
        let path = vec![from.clone(), step.clone()];
        let series = inner.binding(&bound.var, path, |scope| {
            walk(&mut jets, scope, &bound.body)
        })?;
        let mut sum = ComplexBall::zero(BITS);
        for (k, c) in series.iter().enumerate() {
            sum = &sum + &c.scaled(&Ball::integer(BITS, k as i64 + 1).recip());
        }
        let reach = Mag::from_f64(complex::size(step) * CIRCLE as f64);
        let disc = from.widened(reach);
        let on_disc = scope.binding(&bound.var, disc, |scope| walk(self, scope, &bound.body));
        let largest = on_disc?.magnitude();
        // Σ_{k≥N} R^{-k}/(k+1) ≤ R^{-N} (4/3)/(N+1).
        let n = Jets::ORDER as i64;
        let share = Mag::from_f64(4.0).div(Mag::from_f64(3.0 * (n + 1) as f64));
        let tail = largest.mul(share).shift(-n * i64::from(CIRCLE.ilog2()));
        Ok(&sum.widened(tail) * step)
    }
}

impl Domain for Enclosures<'_> {
    type V = ComplexBall;

    fn constant(&mut self, c: &Gauss) -> ComplexBall {
        ComplexBall::rational(BITS, &c.re, &c.im)
    }

    fn symbol(&mut self, name: &str) -> Result<ComplexBall, SymbolicError> {
        let re = match name {
            "pi" => Ball::pi(BITS),
            name => Ball::rational(BITS, &self.point.value(name)?),
        };
        Ok(ComplexBall::new(re, Ball::integer(BITS, 0)))
    }

    fn add(&mut self, a: &ComplexBall, b: &ComplexBall) -> ComplexBall {
        a + b
    }

    fn mul(&mut self, a: &ComplexBall, b: &ComplexBall) -> ComplexBall {
        a * b
    }

    fn div(&mut self, a: &ComplexBall, b: &ComplexBall) -> Result<ComplexBall, SymbolicError> {
        complex::quotient(a, b)
            .ok_or_else(|| SymbolicError::NotInvertible("a number that may be zero".into()))
    }

    fn call(&mut self, f: Func, x: &[ComplexBall]) -> Result<ComplexBall, SymbolicError> {
        let [x] = x else {
            return unsupported(f.name());
        };
        let real = |re: Ball| ComplexBall::new(re, Ball::integer(BITS, 0));
        match f {
            Func::Exp => Ok(x.exp()),
            Func::Sqrt => complex::sqrt(x),
            Func::W => complex::w(x),
            Func::Re => Ok(real(x.re.clone())),
            Func::Im => Ok(real(x.im.clone())),
            Func::Abs => Ok(real(x.norm_sqr().sqrt())),
            Func::Arg => complex::arg(x).map(real),
            Func::Arctan if x.im.is_zero() => Ok(real(x.re.atan2(&Ball::integer(BITS, 1)))),
            // |arctan′| = 1/|1 + z²| ≤ 1/(1 − |Im z|)² ≤ 4 on the way from Re z to z.
            Func::Arctan if x.im.contains_zero() && x.im.magnitude() <= Mag::from_f64(0.5) => {
                let off = x.im.magnitude().shift(2);
                let re = x.re.atan2(&Ball::integer(BITS, 1)).widened(off);
                Ok(ComplexBall::new(re, Ball::integer(BITS, 0).widened(off)))
            }
            Func::Arctan => unsupported("arctan of a complex number"),
            Func::Sin | Func::Cos => Ok(complex::sine_and_cosine(f, x)),
            f => unsupported(f.name()),
        }
    }

    fn integral(
        &mut self,
        scope: &mut Scope<ComplexBall>,
        bound: &Bound,
    ) -> Result<ComplexBall, SymbolicError> {
        let whole = Expr::Int(Box::new(bound.clone()));
        let cache = self.cache.filter(|_| scope.bound.is_empty());
        if let Some(found) = cache.and_then(|cache| cache.get(&whole.to_string())) {
            return Ok(found);
        }
        let a = walk(self, scope, &bound.from)?;
        let b = walk(self, scope, &bound.to)?;
        let step = &b - &a;
        let mut found = Err(SymbolicError::Wide("an integral".into()));
        // Shorter pieces if the bound on a disc is too coarse.
        for pieces in [1_i64, 4, 16, 64] {
            let part = step.scaled(&Ball::rational(BITS, &Rational::from((1, pieces))));
            let mut sum = ComplexBall::zero(BITS);
            let mut from = a.clone();
            for _ in 0..pieces {
                sum = &sum + &self.piece(scope, bound, &from, &part)?;
                from = &from + &part;
            }
            let narrow = sum.re.rad().max(sum.im.rad()) < Mag::power_of_two(-40);
            found = Ok(sum);
            if narrow {
                break;
            }
        }
        if let (Some(cache), Ok(value)) = (cache, &found) {
            cache.keep(scope.definitions, &whole, whole.to_string(), value);
        }
        found
    }

    fn recall(&mut self, name: &str) -> Option<ComplexBall> {
        self.cache?.get(name)
    }

    fn keep(&mut self, definitions: &Definitions, name: &str, value: &ComplexBall) {
        if let Some(cache) = self.cache {
            cache.keep(definitions, &Expr::Sym(name.into()), name.into(), value);
        }
    }
}

/// Returns true if a derivative occurs, definitions followed.
pub fn has_derivative(definitions: &Definitions, e: &Expr) -> bool {
    definitions.any(e, |e| matches!(e, Expr::Diff(..)))
}

/// Returns true if the normal form of an expression shows that its value is real.
pub fn is_real(definitions: &Definitions, e: &Expr) -> bool {
    let mut exact = Exact::default();
    let form = exact.value(definitions, e);
    form.is_ok_and(|form| exact.algebra.is_real(&form))
}

/// An enclosure of an expression: straight from the data, or through the normal form where there is
/// a derivative.
///
/// # Errors
/// As [`Enclosures::value`] or [`Exact::value`].
pub fn enclose(
    definitions: &Definitions,
    e: &Expr,
    point: &Point,
) -> Result<ComplexBall, SymbolicError> {
    if has_derivative(definitions, e) {
        let mut exact = Exact::default();
        let form = exact.value(definitions, e)?;
        return enclose_form(&exact.algebra, &form, point);
    }
    Enclosures::new(point).value(definitions, e)
}

/// An enclosure of a normal form.
///
/// # Errors
/// As [`Enclosures::value`].
pub fn enclose_form(
    algebra: &Algebra,
    form: &ExpSum,
    point: &Point,
) -> Result<ComplexBall, SymbolicError> {
    limited(LIMIT, || Values::new(algebra, point, BITS).form(form))
}

/// Samples at which a function is looked at to see that it is not zero.
const SAMPLES: u32 = 3;

fn excludes_zero(z: &ComplexBall) -> bool {
    !z.re.contains_zero() || !z.im.contains_zero()
}

/// Returns true if an enclosure at a sample point excludes zero.
pub(super) fn is_somewhere_not_zero(algebra: &Algebra, f: &Fraction) -> bool {
    (0..SAMPLES).any(|turn| {
        let value = enclose_fraction(algebra, f, &Point::sample(turn), BITS);
        value.is_ok_and(|z| excludes_zero(&z))
    })
}

/// As [`is_somewhere_not_zero`], for a sum of exponentials.
pub(super) fn is_form_somewhere_not_zero(algebra: &Algebra, form: &ExpSum) -> bool {
    (0..SAMPLES).any(|turn| {
        let value = enclose_form(algebra, form, &Point::sample(turn));
        value.is_ok_and(|z| excludes_zero(&z))
    })
}

/// An enclosure of an element of the field, at a working precision.
pub(super) fn enclose_fraction(
    algebra: &Algebra,
    f: &Fraction,
    point: &Point,
    bits: u32,
) -> Result<ComplexBall, SymbolicError> {
    Values::new(algebra, point, bits).fraction(f)
}

/// Enclosures of normal forms at a point; those of symbols are kept.
pub(super) struct Values<'a> {
    algebra: &'a Algebra,
    point: &'a Point,
    /// The working precision.
    pub bits: u32,
    known: BTreeMap<Symbol, ComplexBall>,
}

impl<'a> Values<'a> {
    fn new(algebra: &'a Algebra, point: &'a Point, bits: u32) -> Values<'a> {
        Values {
            algebra,
            point,
            bits,
            known: BTreeMap::new(),
        }
    }

    /// The value of a sum of exponentials.
    pub(super) fn form(&mut self, form: &ExpSum) -> Result<ComplexBall, SymbolicError> {
        let mut sum = ComplexBall::zero(self.bits);
        for (p, c) in form.terms() {
            let p = self.fraction(p)?;
            let c = self.fraction(c)?;
            sum = &sum + &(&c * &p.exp());
        }
        Ok(sum)
    }

    /// The value of a fraction.
    pub(super) fn fraction(&mut self, f: &Fraction) -> Result<ComplexBall, SymbolicError> {
        let num = self.poly(f.num())?;
        if f.den().is_one() {
            return Ok(num);
        }
        let den = self.poly(f.den())?;
        complex::quotient(&num, &den)
            .ok_or_else(|| SymbolicError::NotInvertible(f.den().to_string()))
    }

    fn poly(&mut self, p: &Poly) -> Result<ComplexBall, SymbolicError> {
        let mut sum = ComplexBall::zero(self.bits);
        for (m, c) in p.terms() {
            let mut product = ComplexBall::rational(self.bits, &c.re, &c.im);
            for (x, k) in m {
                let value = self.symbol(*x)?;
                for _ in 0..*k {
                    step(2)?;
                    product = &product * &value;
                }
            }
            sum = &sum + &product;
        }
        Ok(sum)
    }

    fn symbol(&mut self, x: Symbol) -> Result<ComplexBall, SymbolicError> {
        if let Some(value) = self.known.get(&x) {
            return Ok(value.clone());
        }
        let algebra = self.algebra;
        let roots = algebra.roots().iter();
        let integrals = algebra.antiderivatives().iter();
        let kernels = algebra.kernels().iter();
        let value = if let Some((_, p)) = roots.clone().find(|(s, _)| *s == x) {
            complex::sqrt(&self.poly(p)?)?
        } else if let Some((_, z)) = integrals.clone().find(|(g, _)| *g == x) {
            complex::antiderivative(&self.fraction(z)?)?
        } else if let Some((_, kernel)) = kernels.clone().find(|(k, _)| *k == x) {
            kernel.enclose(self)?
        } else {
            let re = match x == Symbol::PI {
                true => Ball::pi(self.bits),
                false => Ball::rational(self.bits, &self.point.value(&x.name())?),
            };
            ComplexBall::new(re, Ball::integer(self.bits, 0))
        };
        self.known.insert(x, value.clone());
        Ok(value)
    }
}

#[cfg(test)]
mod tests;
