//! Dimensional analysis: the unit of every part of an expression, from the units of its symbols.
//!
//! Terms of a sum, sides of an equation and operands of a comparison have equal dimensions;
//! functions such as the sine take and give pure numbers; an exponent is a pure number, and a base
//! with a dimension has a rational one. Angles are pure numbers, as in the SI. Zero has every
//! dimension.
//!
//! An equation holds between *quantities*, whose units do not matter, or between *numbers*: values
//! in the units that are declared. Between numbers a sum of metres and centimetres lacks a factor,
//! which [`Undimensional`] names.
//!
//! ```
//! use mechaudit_symbolic::{Definitions, Dimensions, parse_equation, unit};
//! let mut units = Dimensions::default();
//! for (name, of) in [("E", "J"), ("m", "kg"), ("v", "m/s")] {
//!     units.declare(name, &unit(of)?);
//! }
//! let none = Definitions::default();
//! assert!(units.check(&none, &parse_equation("E = m*v^2/2")?).is_ok());
//! let wrong = units.check(&none, &parse_equation("E = m*v/2")?).unwrap_err();
//! assert_eq!(wrong.to_string(), "in E = m*v/2: E is in m^2 kg s^-2, but m*v/2 in m kg s^-1");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use super::expr::{Bound, EACH, Equation, Expr, Func, Roots};
use super::unit::Unit;
use super::walk::{Definitions, number};
use rug::Rational;
use rug::ops::Pow;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

/// A factor of a unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Factor {
    /// A prime number in its size, or what trial division leaves.
    Number(u64),
    /// The number π in its size.
    Pi,
    /// A base unit of the SI, by its place in [`BASES`].
    Base(usize),
}

/// Signs of the base units without that of angle, in the order of [`Unit::dimension`].
const BASES: [(usize, &str); 7] = [
    (0, "m"),
    (1, "kg"),
    (2, "s"),
    (4, "A"),
    (5, "K"),
    (6, "mol"),
    (7, "cd"),
];

/// A unit as a product of rational powers of SI base units, prime numbers and π.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Powers(BTreeMap<Factor, Rational>);

impl Powers {
    /// The powers in a unit.
    pub fn of(unit: &Unit) -> Powers {
        let mut out = Powers::default();
        for (place, (index, _)) in BASES.iter().enumerate() {
            out.multiply(Factor::Base(place), &Rational::from(unit.dimension[*index]));
        }
        out.scale(unit.scale.numer(), 1);
        out.scale(unit.scale.denom(), -1);
        if unit.degrees {
            let angle = unit.dimension[3];
            out.multiply(Factor::Pi, &Rational::from(angle));
            out.scale(&rug::Integer::from(180), -angle);
        }
        out
    }

    fn scale(&mut self, n: &rug::Integer, power: i32) {
        // The units that can be read have sizes far below 2^64.
        let mut rest = n.to_u64().unwrap_or(u64::MAX);
        let mut divisor = 2;
        while rest > 1 {
            if divisor > LARGEST_DIVISOR {
                divisor = rest;
            }
            while rest.is_multiple_of(divisor) {
                self.multiply(Factor::Number(divisor), &Rational::from(power));
                rest /= divisor;
            }
            divisor += 1;
        }
    }

    fn multiply(&mut self, factor: Factor, power: &Rational) {
        let exponent = self.0.entry(factor).or_default();
        *exponent += power;
        if exponent.is_zero() {
            self.0.remove(&factor);
        }
    }

    fn times(&self, other: &Powers) -> Powers {
        let mut out = self.clone();
        for (factor, power) in &other.0 {
            out.multiply(*factor, power);
        }
        out
    }

    fn to_the(&self, power: &Rational) -> Powers {
        let mut out = Powers::default();
        for (factor, exponent) in &self.0 {
            out.multiply(*factor, &Rational::from(exponent * power));
        }
        out
    }

    fn per(&self, other: &Powers) -> Powers {
        self.times(&other.to_the(&Rational::from(-1)))
    }

    /// Returns true if no base unit enters.
    pub fn is_pure(&self) -> bool {
        !self.0.keys().any(|f| matches!(f, Factor::Base(_)))
    }

    /// The unit of the SI that has the same dimension.
    fn coherent(&self) -> Powers {
        let mut out = self.clone();
        out.0.retain(|f, _| matches!(f, Factor::Base(_)));
        out
    }

    /// The size in the SI, if its prime numbers have whole exponents: a rational number and a power
    /// of π.
    fn size(&self) -> Option<(Rational, i32)> {
        let (mut size, mut pi) = (Rational::from(1), 0);
        for (factor, exponent) in self.0.iter().filter(|f| !matches!(f.0, Factor::Base(_))) {
            // No quantity has larger exponents.
            let whole = exponent.numer().to_i32();
            let whole = whole.filter(|k| exponent.is_integer() && k.abs() <= 100)?;
            match factor {
                Factor::Number(n) => size *= Rational::from(*n).pow(whole),
                _ => pi = whole,
            }
        }
        Some((size, pi))
    }
}

/// Divisors that are tried; what is left is taken for one factor.
const LARGEST_DIVISOR: u64 = 10_000;

/// The text of a size: a power of ten, or a quotient.
fn size_text(size: &Rational) -> String {
    let power_of_ten = |n: &rug::Integer| {
        let digits = n.to_string();
        let zeros = digits.strip_prefix('1')?;
        zeros.bytes().all(|b| b == b'0').then_some(zeros.len())
    };
    let one = |n: &rug::Integer| *n == 1;
    match (power_of_ten(size.numer()), power_of_ten(size.denom())) {
        (Some(k), _) if k > 2 && one(size.denom()) => format!("10^{k}"),
        (_, Some(k)) if k > 2 && one(size.numer()) => format!("10^-{k}"),
        _ => size.to_string(),
    }
}

/// As in `10^-4 m^2 kg`, or `1`.
impl fmt::Display for Powers {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let mut parts = Vec::new();
        match self.size() {
            Some((size, _)) if size == 1 => {}
            Some((size, _)) => parts.push(size_text(&size)),
            None => parts.push("(a number)".into()),
        }
        let named = self.0.iter().filter_map(|(factor, exponent)| match factor {
            Factor::Base(place) => Some((BASES[*place].1, exponent)),
            Factor::Pi => Some(("pi", exponent)),
            Factor::Number(_) => None,
        });
        for (name, exponent) in named {
            parts.push(match exponent {
                e if *e == 1 => name.into(),
                e if e.is_integer() => format!("{name}^{e}"),
                e => format!("{name}^({e})"),
            });
        }
        match parts.is_empty() {
            true => f.write_str("1"),
            false => f.write_str(&parts.join(" ")),
        }
    }
}

/// A fault that dimensional analysis finds. Every text is that of a part as it is written.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Undimensional {
    /// Parts that are added, compared or equated differ.
    #[error(
        "in {whole}: {left} is in {of_left}, but {right} in {of_right}{}",
        missing(of_left, of_right)
    )]
    Differ {
        /// The sum, comparison or equation.
        whole: String,
        /// A part.
        left: String,
        /// Its unit.
        of_left: Powers,
        /// The first part that differs from it.
        right: String,
        /// The unit of that.
        of_right: Powers,
    },
    /// An argument, a condition or an index is no pure number.
    #[error("in {whole}: {part} has to be a pure number and is in {unit}")]
    Impure {
        /// The function or power.
        whole: String,
        /// The argument.
        part: String,
        /// The unit of that.
        unit: Powers,
    },
    /// The exponent of a base with a unit is not a rational number.
    #[error("in {whole}: {base} is in {unit}, so that the exponent has to be a rational number")]
    Exponent {
        /// The power.
        whole: String,
        /// Its base.
        base: String,
        /// The unit of that.
        unit: Powers,
    },
    /// A symbol has no unit.
    #[error("{name} has no unit")]
    NoUnit {
        /// The symbol.
        name: String,
    },
    /// Definitions that lead back to themselves.
    #[error("the definition of {name} does not end")]
    Circular {
        /// Where.
        name: String,
    },
}

/// The factor that numbers lack, if the dimensions agree.
fn missing(left: &Powers, right: &Powers) -> String {
    let factor = right.per(left);
    match factor.is_pure() {
        true => format!("; as numbers they differ by the factor {factor}"),
        false => String::new(),
    }
}

/// The units of symbols.
#[derive(Clone, Debug, Default)]
pub struct Dimensions {
    /// A unit, or none where any will do.
    symbols: BTreeMap<String, Option<Powers>>,
    /// True if equations hold between numbers in the declared units, false if between quantities.
    pub numbers: bool,
}

impl Dimensions {
    /// Declares the unit of a symbol.
    pub fn declare(&mut self, name: &str, unit: &Unit) {
        self.symbols.insert(name.into(), Some(Powers::of(unit)));
    }

    /// Lets a symbol have any unit.
    pub fn leave_open(&mut self, name: &str) {
        self.symbols.insert(name.into(), None);
    }

    /// Returns true if the symbol has a unit.
    pub fn has(&self, name: &str) -> bool {
        self.symbols.contains_key(name)
    }

    /// The unit of an expression; `None` if any unit will do, as for zero.
    ///
    /// # Errors
    /// [`Undimensional`] names the innermost part that is wrong.
    pub fn of(&self, definitions: &Definitions, e: &Expr) -> Result<Option<Powers>, Undimensional> {
        self.analysis(definitions).of(e)
    }

    /// Checks both sides of an equation and that they have the same unit.
    ///
    /// # Errors
    /// [`Undimensional`].
    pub fn check(
        &self,
        definitions: &Definitions,
        equation: &Equation,
    ) -> Result<(), Undimensional> {
        let sides = [&equation.left, &equation.right];
        self.analysis(definitions)
            .equal(&equation.to_string(), &sides)
            .map(drop)
    }

    fn analysis<'a>(&'a self, definitions: &'a Definitions) -> Analysis<'a> {
        Analysis {
            units: self,
            definitions,
            bound: Vec::new(),
            known: BTreeMap::new(),
            open: BTreeSet::new(),
        }
    }
}

/// A unit, or none where any will do.
type Found = Result<Option<Powers>, Undimensional>;

struct Analysis<'a> {
    units: &'a Dimensions,
    definitions: &'a Definitions,
    bound: Vec<(String, Option<Powers>)>,
    known: BTreeMap<String, Option<Powers>>,
    open: BTreeSet<String>,
}

impl Analysis<'_> {
    fn sized(&self, unit: &Powers) -> Powers {
        match self.units.numbers {
            true => unit.clone(),
            false => unit.coherent(),
        }
    }

    /// The unit of a name: of a variable, as declared, or of its definition.
    fn named(&mut self, name: &str) -> Found {
        if let Some((_, unit)) = self.bound.iter().rev().find(|b| b.0 == name) {
            return Ok(unit.clone());
        }
        if let Some(unit) = self.units.symbols.get(name) {
            return Ok(unit.as_ref().map(|u| self.sized(u)));
        }
        match name {
            "pi" => return Ok(Some(Powers::default())),
            "inf" => return Ok(None),
            _ => {}
        }
        if let Some(unit) = self.known.get(name) {
            return Ok(unit.clone());
        }
        let definitions = self.definitions;
        let Some(e) = definitions.names.get(name) else {
            return Err(Undimensional::NoUnit { name: name.into() });
        };
        if !self.open.insert(name.into()) {
            return Err(Undimensional::Circular { name: name.into() });
        }
        let outside = std::mem::take(&mut self.bound);
        let found = self.of(e);
        self.bound = outside;
        self.open.remove(name);
        let found = found?;
        self.known.insert(name.into(), found.clone());
        Ok(found)
    }

    /// The common unit of parts.
    fn equal(&mut self, whole: &str, parts: &[&Expr]) -> Found {
        let mut first: Option<(String, Powers)> = None;
        for part in parts {
            let Some(unit) = self.of(part)? else { continue };
            match &first {
                Some((left, of_left)) if *of_left != unit => {
                    return Err(Undimensional::Differ {
                        whole: whole.into(),
                        left: left.clone(),
                        of_left: of_left.clone(),
                        right: part.to_string(),
                        of_right: unit,
                    });
                }
                Some(_) => {}
                None => first = Some((part.to_string(), unit)),
            }
        }
        Ok(first.map(|f| f.1))
    }

    /// Checks that a part is a pure number. Its size has to be 1 but where an angle may be in
    /// degrees.
    fn pure(&mut self, whole: &Expr, part: &Expr, degrees: bool) -> Result<(), Undimensional> {
        match self.of(part)? {
            Some(unit) if !(unit.is_pure() && (degrees || unit == Powers::default())) => {
                Err(Undimensional::Impure {
                    whole: whole.to_string(),
                    part: part.to_string(),
                    unit,
                })
            }
            _ => Ok(()),
        }
    }

    fn with<T>(&mut self, name: &str, unit: Option<Powers>, f: impl FnOnce(&mut Self) -> T) -> T {
        self.bound.push((name.into(), unit));
        let out = f(self);
        self.bound.pop();
        out
    }

    fn of(&mut self, e: &Expr) -> Found {
        let one = || Ok(Some(Powers::default()));
        match e {
            Expr::Num(n) if number(n).is_some_and(|q| q.is_zero()) => Ok(None),
            Expr::Num(_) | Expr::Constant(_) | Expr::I | Expr::Truth(_) => one(),
            Expr::Sym(name) => self.named(name),
            Expr::Index(name, index) => {
                let member = match &**index {
                    Expr::Num(k) => Some(format!("{name}_{k}")),
                    Expr::Sym(k) => Some(format!("{name}_{k}")),
                    _ => None,
                };
                let known =
                    |n: &String| self.units.has(n) || self.definitions.names.contains_key(n);
                self.named(&member.filter(known).unwrap_or_else(|| name.clone()))
            }
            Expr::Neg(x) => self.of(x),
            Expr::Add(terms) => self.equal(&e.to_string(), &terms.iter().collect::<Vec<_>>()),
            Expr::Mul(factors) => {
                let mut product = Some(Powers::default());
                for x in factors {
                    product = product_of(product, self.of(x)?);
                }
                Ok(product)
            }
            Expr::Div(a, b) => {
                let (a, b) = (self.of(a)?, self.of(b)?);
                Ok(product_of(a, b.map(|b| b.to_the(&Rational::from(-1)))))
            }
            Expr::Pow(x, k) => Ok(self.of(x)?.map(|x| x.to_the(&Rational::from(*k)))),
            Expr::Call(f, x) => self.call(e, *f, x),
            Expr::Int(b) => {
                let variable = self.variable(e, b)?;
                let body = self.with(&b.var, variable.clone(), |a| a.of(&b.body))?;
                Ok(product_of(body, variable))
            }
            Expr::Sum(b) => {
                if b.to != Expr::Sym(EACH.into()) {
                    self.pure(e, &b.from, false)?;
                    self.pure(e, &b.to, false)?;
                }
                self.with(&b.var, Some(Powers::default()), |a| a.of(&b.body))
            }
            Expr::Root(b, which) => {
                let variable = self.variable(e, b)?;
                self.with(&b.var, variable.clone(), |a| a.of(&b.body))?;
                Ok(match which {
                    Roots::Number => Some(Powers::default()),
                    Roots::Only | Roots::One { .. } => variable,
                })
            }
            Expr::Diff(x, by) => {
                let (x, by) = (self.of(x)?, self.named(by)?);
                Ok(product_of(x, by.map(|by| by.to_the(&Rational::from(-1)))))
            }
            Expr::At(x, symbol, value) => {
                let value = self.equal(&e.to_string(), &[&Expr::Sym(symbol.clone()), &**value])?;
                self.with(symbol, value, |a| a.of(x))
            }
            Expr::Compare(_, x) => {
                self.equal(&e.to_string(), &x.iter().collect::<Vec<_>>())?;
                one()
            }
            Expr::And(x) | Expr::Or(x) => {
                for x in x {
                    self.of(x)?;
                }
                one()
            }
            Expr::Not(x) => {
                self.of(x)?;
                one()
            }
            Expr::If(parts) => {
                let [condition, yes, no] = &**parts;
                self.of(condition)?;
                self.equal(&e.to_string(), &[yes, no])
            }
            Expr::Let(sequential, values, body) => {
                let outside = self.bound.len();
                let mut later = Vec::new();
                let mut found = Ok(None);
                for (name, value) in values {
                    match (self.of(value), sequential) {
                        (Ok(unit), true) => self.bound.push((name.clone(), unit)),
                        (Ok(unit), false) => later.push((name.clone(), unit)),
                        (Err(fault), _) => {
                            found = Err(fault);
                            break;
                        }
                    }
                }
                if found.is_ok() {
                    self.bound.extend(later);
                    found = self.of(body);
                }
                self.bound.truncate(outside);
                found
            }
            Expr::While(l) => {
                let outside = self.bound.len();
                let mut starts = Vec::new();
                for (name, start, _) in &l.variables {
                    starts.push((name.clone(), self.of(start)?));
                }
                self.bound.extend(starts);
                let found = self.repeated(e, l);
                self.bound.truncate(outside);
                found
            }
        }
    }

    /// The value of a loop: each update has the unit that its variable begins with.
    fn repeated(&mut self, e: &Expr, l: &super::expr::Loop) -> Found {
        self.of(&l.condition)?;
        for (name, _, update) in &l.variables {
            self.equal(&e.to_string(), &[&Expr::Sym(name.clone()), update])?;
        }
        self.of(&l.body)
    }

    /// The unit of a variable between limits: that of the limits, as declared, or a pure number.
    fn variable(&mut self, whole: &Expr, b: &Bound) -> Found {
        match self.equal(&whole.to_string(), &[&b.from, &b.to])? {
            Some(unit) => Ok(Some(unit)),
            None => match self.units.symbols.get(&b.var) {
                Some(declared) => Ok(declared.as_ref().map(|u| self.sized(u))),
                None => Ok(Some(Powers::default())),
            },
        }
    }

    fn call(&mut self, e: &Expr, f: Func, x: &[Expr]) -> Found {
        let one = || Ok(Some(Powers::default()));
        let all: Vec<&Expr> = x.iter().collect();
        let root = |unit: Option<Powers>, n: u32| unit.map(|u| u.to_the(&Rational::from((1, n))));
        match (f, x) {
            (Func::Sqrt, [x]) => Ok(root(self.of(x)?, 2)),
            (Func::Cbrt, [x]) => Ok(root(self.of(x)?, 3)),
            (Func::Re | Func::Im | Func::Abs | Func::Conj, [x]) => self.of(x),
            (Func::Arg, [x]) => {
                self.of(x)?;
                one()
            }
            (Func::Atan2, _) => {
                self.equal(&e.to_string(), &all)?;
                one()
            }
            (
                Func::Hypot | Func::Fmin | Func::Fmax | Func::Fdim | Func::Fmod | Func::Remainder,
                _,
            ) => self.equal(&e.to_string(), &all),
            (Func::Copysign, [x, y]) => {
                self.of(y)?;
                self.of(x)
            }
            (Func::Fma, [x, y, z]) => {
                let product = Expr::Mul(vec![x.clone(), y.clone()]);
                self.equal(&e.to_string(), &[&product, z])
            }
            (Func::Voigt, _) => {
                let unit = self.equal(&e.to_string(), &all)?;
                Ok(unit.map(|u| u.to_the(&Rational::from(-1))))
            }
            (Func::Pow, [x, y]) => {
                self.pure(e, y, false)?;
                let Some(base) = self.of(x)?.filter(|u| *u != Powers::default()) else {
                    return one();
                };
                match rational(y) {
                    Some(k) => Ok(Some(base.to_the(&k))),
                    None => Err(Undimensional::Exponent {
                        whole: e.to_string(),
                        base: x.to_string(),
                        unit: base,
                    }),
                }
            }
            _ => {
                let angle = matches!(f, Func::Sin | Func::Cos | Func::Tan);
                for x in x {
                    self.pure(e, x, angle)?;
                }
                one()
            }
        }
    }
}

fn product_of(a: Option<Powers>, b: Option<Powers>) -> Option<Powers> {
    Some(a?.times(&b?))
}

/// The value of an expression of numbers alone.
fn rational(e: &Expr) -> Option<Rational> {
    Some(match e {
        Expr::Num(n) => number(n)?,
        Expr::Neg(x) => -rational(x)?,
        Expr::Add(x) => x.iter().map(rational).sum::<Option<Rational>>()?,
        Expr::Mul(x) => x.iter().map(rational).product::<Option<Rational>>()?,
        Expr::Div(a, b) => {
            let below = rational(b).filter(|b| !b.is_zero())?;
            rational(a)? / below
        }
        _ => return None,
    })
}

#[cfg(test)]
mod tests;
