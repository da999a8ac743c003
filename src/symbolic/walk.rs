//! One way through an expression for every kind of value.

use super::error::unsupported;
use super::expr::{Bound, Constant, EACH, Expr, Func, Loop, RESERVED, Roots};
use super::work::step;
use super::{Gauss, Symbol, SymbolicError, parse};
use rug::Rational;
use rug::ops::Pow;
use std::collections::{BTreeMap, BTreeSet};

/// Definitions by name.
#[derive(Clone, Debug, Default)]
pub struct Definitions {
    /// Names that stand for expressions.
    pub names: BTreeMap<String, Expr>,
    /// Derivations by name: pairs of a symbol and its image.
    pub derivations: BTreeMap<String, Vec<(String, Expr)>>,
}

impl Definitions {
    /// Adds or replaces a definition.
    pub fn set(&mut self, name: &str, value: Expr) {
        self.names.insert(name.into(), value);
    }

    /// Returns true if one of the names occurs in the expression, definitions and derivations
    /// followed.
    pub fn reaches(&self, e: &Expr, names: &[&str]) -> bool {
        self.any(
            e,
            |e| matches!(e, Expr::Sym(name) if names.contains(&name.as_str())),
        )
    }

    /// Returns true if something is so of a part of the expression, definitions and derivations
    /// followed.
    pub(super) fn any(&self, e: &Expr, is_so: impl Fn(&Expr) -> bool) -> bool {
        let mut open = vec![e];
        let (mut seen, mut derived) = (BTreeSet::new(), BTreeSet::new());
        while let Some(e) = open.pop() {
            if is_so(e) {
                return true;
            }
            if let Expr::Sym(name) = e
                && seen.insert(name.as_str())
            {
                open.extend(self.names.get(name));
            }
            if let Expr::Diff(_, by) = e
                && derived.insert(by.as_str())
            {
                let images = self.derivations.get(by).into_iter().flatten();
                open.extend(images.map(|i| &i.1));
            }
            open.extend(e.children());
        }
        false
    }

    /// From texts `name = expression`; derivatives are written `t: x = expression`.
    ///
    /// # Errors
    /// As [`parse()`].
    pub fn read(lines: &[&str]) -> Result<Definitions, SymbolicError> {
        Definitions::read_with(lines, &|text| parse(text))
    }

    /// As [`Definitions::read`], with a reader of the expressions: one that knows declared names.
    ///
    /// # Errors
    /// As the reader.
    pub fn read_with(
        lines: &[&str],
        parse: &dyn Fn(&str) -> Result<Expr, SymbolicError>,
    ) -> Result<Definitions, SymbolicError> {
        let mut out = Definitions::default();
        for line in lines {
            let missing = || SymbolicError::Parse {
                at: 0,
                reason: format!("expected '=' in {line:?}"),
            };
            let (left, right) = line.split_once('=').ok_or_else(missing)?;
            let value = parse(right)?;
            let name = left.rsplit(':').next().unwrap_or(left).trim();
            if RESERVED.contains(&name) {
                return Err(SymbolicError::Reserved(name.into()));
            }
            match left.split_once(':') {
                Some((by, symbol)) => out
                    .derivations
                    .entry(by.trim().into())
                    .or_default()
                    .push((symbol.trim().into(), value)),
                None => out.set(left.trim(), value),
            }
        }
        Ok(out)
    }
}

/// Values bound on the way, innermost last, and how deep the definitions are nested.
#[derive(Clone, Debug)]
pub struct Scope<'a, V> {
    /// The definitions.
    pub definitions: &'a Definitions,
    /// Bound names.
    pub bound: Vec<(String, V)>,
    /// Indices of sums, each with its place among the bound names.
    indices: Vec<(String, i64, usize)>,
    /// The index of the series that the expression is a term of.
    series: Option<String>,
    depth: usize,
}

impl<'a, V> Scope<'a, V> {
    /// Nothing bound.
    pub fn new(definitions: &'a Definitions) -> Scope<'a, V> {
        Scope {
            definitions,
            bound: Vec::new(),
            indices: Vec::new(),
            series: None,
            depth: 0,
        }
    }

    /// Returns the result of `make` where a name is bound.
    pub(super) fn binding<T>(
        &mut self,
        name: &str,
        value: V,
        f: impl FnOnce(&mut Scope<'a, V>) -> T,
    ) -> T {
        self.bound.push((name.into(), value));
        let out = f(self);
        self.bound.pop();
        out
    }

    /// Runs `f` one definition deeper.
    ///
    /// # Errors
    /// [`SymbolicError::Circular`] if definitions are nested too deep.
    pub(super) fn deeper<T>(
        &mut self,
        name: &str,
        f: impl FnOnce(&mut Scope<'a, V>) -> Result<T, SymbolicError>,
    ) -> Result<T, SymbolicError> {
        if self.depth >= DEEPEST {
            return Err(SymbolicError::Circular(name.into()));
        }
        self.depth += 1;
        let out = f(self);
        self.depth -= 1;
        out
    }

    /// The same scope with other values.
    pub fn with_values<U>(&self, f: impl Fn(&V) -> U) -> Scope<'a, U> {
        Scope {
            definitions: self.definitions,
            bound: self.bound.iter().map(|(n, v)| (n.clone(), f(v))).collect(),
            indices: self.indices.clone(),
            series: self.series.clone(),
            depth: self.depth,
        }
    }
}

/// Operations that a node of an expression counts for, of those that [`step`] counts.
const NODE: u64 = 16;

/// Definitions within definitions.
const DEEPEST: usize = 40;

/// A kind of value that expressions can have. [`walk`] goes through an expression; a domain says
/// what the operations mean.
pub trait Domain: Sized {
    /// The values.
    type V: Clone;
    /// A number.
    fn constant(&mut self, c: &Gauss) -> Self::V;
    /// A free symbol.
    fn symbol(&mut self, name: &str) -> Result<Self::V, SymbolicError>;
    /// Sum.
    fn add(&mut self, a: &Self::V, b: &Self::V) -> Self::V;
    /// Product.
    fn mul(&mut self, a: &Self::V, b: &Self::V) -> Self::V;
    /// Quotient.
    fn div(&mut self, a: &Self::V, b: &Self::V) -> Result<Self::V, SymbolicError>;
    /// A function.
    fn call(&mut self, f: Func, x: &[Self::V]) -> Result<Self::V, SymbolicError>;
    /// An integral.
    fn integral(
        &mut self,
        scope: &mut Scope<Self::V>,
        bound: &Bound,
    ) -> Result<Self::V, SymbolicError>;
    /// `−a`; by default a product with −1.
    fn neg(&mut self, a: &Self::V) -> Self::V {
        let minus = self.constant(&Gauss::real(-1));
        self.mul(&minus, a)
    }
    /// `a − b`.
    fn sub(&mut self, a: &Self::V, b: &Self::V) -> Self::V {
        let minus = self.neg(b);
        self.add(a, &minus)
    }
    /// An integer power; by default repeated products.
    fn power(&mut self, x: &Self::V, k: i32) -> Result<Self::V, SymbolicError> {
        let one = self.constant(&Gauss::real(1));
        let mut product = one.clone();
        for _ in 0..k.unsigned_abs() {
            step(1)?;
            product = self.mul(&product, x);
        }
        match k < 0 {
            true => self.div(&one, &product),
            false => Ok(product),
        }
    }
    /// Infinity, where it is a limit of an integral or of a sum.
    fn infinity(&mut self) -> Result<Self::V, SymbolicError> {
        unsupported("inf other than as a limit")
    }
    /// A named constant; by default the value of its definition.
    fn named_constant(
        &mut self,
        scope: &mut Scope<Self::V>,
        c: Constant,
    ) -> Result<Self::V, SymbolicError> {
        walk(self, scope, &parse(c.definition())?)
    }
    /// A sum over an index, other than a series; by default term by term.
    fn sum(&mut self, scope: &mut Scope<Self::V>, bound: &Bound) -> Result<Self::V, SymbolicError> {
        finite_sum(self, scope, bound)
    }
    /// A sum from `bound.from` to infinity.
    fn infinite_sum(
        &mut self,
        _scope: &mut Scope<Self::V>,
        bound: &Bound,
    ) -> Result<Self::V, SymbolicError> {
        unsupported(format!("the sum of {} to infinity", bound.body))
    }
    /// The only root between the limits.
    fn root(
        &mut self,
        _scope: &mut Scope<Self::V>,
        bound: &Bound,
        _which: Roots,
    ) -> Result<Self::V, SymbolicError> {
        unsupported(format!("a root of {}", bound.body))
    }
    /// A comparison, a connective, or the constants true and false.
    fn condition(
        &mut self,
        _scope: &mut Scope<Self::V>,
        e: &Expr,
    ) -> Result<Self::V, SymbolicError> {
        unsupported(format!("the condition {e}"))
    }
    /// The second where the first is true, else the third.
    fn choose(
        &mut self,
        _scope: &mut Scope<Self::V>,
        [condition, ..]: &[Expr; 3],
    ) -> Result<Self::V, SymbolicError> {
        unsupported(format!("a choice by {condition}"))
    }
    /// A loop.
    fn repeat(
        &mut self,
        _scope: &mut Scope<Self::V>,
        repeated: &Loop,
    ) -> Result<Self::V, SymbolicError> {
        unsupported(format!("a loop while {}", repeated.condition))
    }
    /// A derivative; of balls there is none.
    fn derivative(
        &mut self,
        _scope: &mut Scope<Self::V>,
        _body: &Expr,
        by: &str,
    ) -> Result<Self::V, SymbolicError> {
        unsupported(format!("a derivative by {by} in balls"))
    }
    /// The value of a definition that was kept before.
    fn recall(&mut self, _name: &str) -> Option<Self::V> {
        None
    }
    /// May keep the value of a definition, nothing being bound.
    fn keep(&mut self, _definitions: &Definitions, _name: &str, _value: &Self::V) {}
    /// The value at a value of a symbol; by binding unless the domain knows better.
    fn at(
        &mut self,
        scope: &mut Scope<Self::V>,
        body: &Expr,
        symbol: &str,
        value: Self::V,
    ) -> Result<Self::V, SymbolicError> {
        scope.binding(symbol, value, |scope| walk(self, scope, body))
    }
}

/// Digits of a number and powers of ten and two that are read; more would take too long.
const LONGEST: usize = 10_000;

/// Returns true if the text is a number: see [`number`].
pub(super) fn is_number(text: &str) -> bool {
    number(text).is_some()
}

/// Reads a number: `12`, `0.5`, `.5`, `1e-3`, `0x1.8p3`, `1/3`.
pub fn number(text: &str) -> Option<Rational> {
    if text.len() > LONGEST {
        return None;
    }
    if let Some((above, below)) = text.split_once('/') {
        let (above, below) = (number(above)?, number(below)?);
        return (below != 0).then(|| above / below);
    }
    let lower = text.to_ascii_lowercase();
    let (digits, radix, mark, power) = match lower.strip_prefix("0x") {
        Some(rest) => (rest, 16, 'p', 2),
        None => (lower.as_str(), 10, 'e', 10),
    };
    let (digits, exponent) = match digits.split_once(mark) {
        Some((digits, exponent)) => (digits, exponent.parse::<i32>().ok()?),
        None => (digits, 0),
    };
    let (whole, part) = digits.split_once('.').unwrap_or((digits, ""));
    let all = format!("{whole}{part}");
    let is_good = !all.is_empty()
        && all.chars().all(|c| c.is_digit(radix))
        && !(digits.ends_with('.') && radix == 10)
        && exponent.unsigned_abs() as usize <= 2 * LONGEST;
    if !is_good {
        return None;
    }
    let value = rug::Integer::from_str_radix(&all, radix as i32).ok()?;
    let scale = |base: u32, k: u32| rug::Integer::from(base).pow(k);
    let value = Rational::from((value, scale(radix, part.len() as u32)));
    let factor = scale(power, exponent.unsigned_abs());
    Some(if exponent < 0 {
        value / factor
    } else {
        value * factor
    })
}

/// The integer that an expression of numbers and indices stands for.
pub(super) fn integer<V>(scope: &Scope<V>, e: &Expr) -> Option<i64> {
    match e {
        Expr::Num(n) => n.parse().ok(),
        Expr::Sym(s) => {
            let place = scope.bound.iter().rposition(|b| b.0 == *s)?;
            let found = scope.indices.iter().find(|index| index.2 == place);
            found.map(|b| b.1)
        }
        Expr::Neg(x) => Some(-integer(scope, x)?),
        Expr::Add(x) => x.iter().map(|x| integer(scope, x)).sum(),
        _ => None,
    }
}

/// The value of an expression.
///
/// # Errors
/// Operations that the domain cannot do, and definitions that do not end.
pub fn walk<D: Domain>(
    d: &mut D,
    scope: &mut Scope<D::V>,
    e: &Expr,
) -> Result<D::V, SymbolicError> {
    step(NODE)?;
    match e {
        Expr::Num(n) => match number(n) {
            Some(value) => Ok(d.constant(&Gauss::real(value))),
            None => unsupported(format!("the number {n}")),
        },
        Expr::Constant(c) => d.named_constant(scope, *c),
        Expr::I => Ok(d.constant(&Gauss::i())),
        Expr::Sym(name) => named(d, scope, name),
        Expr::Index(name, index) => match (integer(scope, index), &**index) {
            (Some(k), _) => named(d, scope, &format!("{name}_{k}")),
            // A variable of an integral or one with a value is no index.
            (None, Expr::Sym(s))
                if !RESERVED.contains(&s.as_str())
                    && (scope.series.as_ref() == Some(s)
                        || scope.bound.iter().all(|(name, _)| name != s)) =>
            {
                named(d, scope, &format!("{name}_{s}"))
            }
            _ => unsupported(format!("the index {index}")),
        },
        Expr::Neg(x) => {
            let x = walk(d, scope, x)?;
            Ok(d.neg(&x))
        }
        Expr::Add(terms) => {
            let Some((first, rest)) = terms.split_first() else {
                return Ok(d.constant(&Gauss::default()));
            };
            let mut sum = walk(d, scope, first)?;
            for x in rest {
                sum = match x {
                    Expr::Neg(x) => {
                        let x = walk(d, scope, x)?;
                        d.sub(&sum, &x)
                    }
                    x => {
                        let x = walk(d, scope, x)?;
                        d.add(&sum, &x)
                    }
                };
            }
            Ok(sum)
        }
        Expr::Mul(factors) => {
            let Some((first, rest)) = factors.split_first() else {
                return Ok(d.constant(&Gauss::real(1)));
            };
            let mut product = walk(d, scope, first)?;
            for x in rest {
                let x = walk(d, scope, x)?;
                product = d.mul(&product, &x);
            }
            Ok(product)
        }
        Expr::Div(a, b) => {
            let (a, b) = (walk(d, scope, a)?, walk(d, scope, b)?);
            d.div(&a, &b)
        }
        Expr::Pow(x, k) => {
            let x = walk(d, scope, x)?;
            d.power(&x, *k)
        }
        Expr::Call(f, x) => {
            let x: Result<Vec<D::V>, _> = x.iter().map(|x| walk(d, scope, x)).collect();
            d.call(*f, &x?)
        }
        Expr::Root(bound, which) => d.root(scope, bound, *which),
        Expr::Compare(..) | Expr::And(_) | Expr::Or(_) | Expr::Not(_) | Expr::Truth(_) => {
            d.condition(scope, e)
        }
        Expr::If(parts) => d.choose(scope, parts),
        Expr::Let(sequential, values, body) => {
            let outside = scope.bound.len();
            let found = bound_values(d, scope, *sequential, values);
            let value = found.and_then(|()| walk(d, scope, body));
            scope.bound.truncate(outside);
            value
        }
        Expr::While(repeated) => d.repeat(scope, repeated),
        Expr::Int(bound) => d.integral(scope, bound),
        Expr::Sum(bound) if bound.to == Expr::Sym(EACH.into()) => {
            let index = d.symbol(&Symbol::INDEX.name())?;
            let outside = scope.series.replace(bound.var.clone());
            let term = scope.binding(&bound.var, index, |scope| walk(d, scope, &bound.body));
            scope.series = outside;
            let sign = d.symbol(&Symbol::SERIES.name())?;
            Ok(d.mul(&sign, &term?))
        }
        Expr::Sum(bound) => d.sum(scope, bound),
        Expr::Diff(body, by) => d.derivative(scope, body, by),
        Expr::At(body, symbol, value) => {
            let value = walk(d, scope, value)?;
            d.at(scope, body, symbol, value)
        }
    }
}

/// A sum over an index term by term, or to infinity.
///
/// # Errors
/// Limits that are not numbers.
pub(super) fn finite_sum<D: Domain>(
    d: &mut D,
    scope: &mut Scope<D::V>,
    bound: &Bound,
) -> Result<D::V, SymbolicError> {
    if bound.to == Expr::Sym("inf".into()) {
        return d.infinite_sum(scope, bound);
    }
    let limits = (integer(scope, &bound.from), integer(scope, &bound.to));
    let (Some(from), Some(to)) = limits else {
        return unsupported("the limits of a sum");
    };
    let mut sum = d.constant(&Gauss::default());
    for k in from..=to {
        step(1)?;
        let value = d.constant(&Gauss::real(k));
        let place = scope.bound.len();
        scope.indices.push((bound.var.clone(), k, place));
        let x = scope.binding(&bound.var, value, |scope| walk(d, scope, &bound.body));
        scope.indices.pop();
        sum = d.add(&sum, &x?);
    }
    Ok(sum)
}

/// Binds names to values, which see those before them if `sequential`.
fn bound_values<D: Domain>(
    d: &mut D,
    scope: &mut Scope<D::V>,
    sequential: bool,
    values: &[(String, Expr)],
) -> Result<(), SymbolicError> {
    let mut later = Vec::new();
    for (name, value) in values {
        let value = walk(d, scope, value)?;
        match sequential {
            true => scope.bound.push((name.clone(), value)),
            false => later.push((name.clone(), value)),
        }
    }
    scope.bound.extend(later);
    Ok(())
}

fn named<D: Domain>(d: &mut D, scope: &mut Scope<D::V>, name: &str) -> Result<D::V, SymbolicError> {
    if let Some((_, v)) = scope.bound.iter().rev().find(|b| b.0 == name) {
        return Ok(v.clone());
    }
    let definitions = scope.definitions;
    let Some(e) = definitions.names.get(name) else {
        if name == "inf" {
            return d.infinity();
        }
        // Inside a series over n, x_n is a term of a sequence.
        let suffix = scope.series.as_ref().map(|n| format!("_{n}"));
        let sequence = suffix.and_then(|suffix| name.strip_suffix(&suffix));
        return match sequence {
            Some(base) => d.symbol(&format!("{base}_{}", Symbol::INDEX)),
            None => d.symbol(name),
        };
    };
    let free = scope.bound.is_empty() && scope.indices.is_empty();
    if let Some(kept) = free.then(|| d.recall(name)).flatten() {
        return Ok(kept);
    }
    let out = scope.deeper(name, |scope| walk(d, scope, e));
    if let (true, Ok(value)) = (free, &out) {
        d.keep(definitions, name, value);
    }
    out
}

#[cfg(test)]
mod tests;
