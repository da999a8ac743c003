//! Multivariate polynomials over the Gaussian rationals.

use super::work::spend;
use super::{Gauss, Symbol};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::ops::{Add, Mul, Neg, Sub};

/// A product of powers: symbols in order, exponents positive.
pub type Monomial = Vec<(Symbol, u32)>;

/// A polynomial: its non-zero terms. Equal polynomials have equal terms.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Poly {
    terms: BTreeMap<Monomial, Gauss>,
}

fn times(a: &Monomial, b: &Monomial) -> Monomial {
    let mut out = Monomial::with_capacity(a.len() + b.len());
    let (mut i, mut j) = (0, 0);
    while i < a.len() && j < b.len() {
        match a[i].0.cmp(&b[j].0) {
            std::cmp::Ordering::Less => {
                out.push(a[i]);
                i += 1;
            }
            std::cmp::Ordering::Greater => {
                out.push(b[j]);
                j += 1;
            }
            std::cmp::Ordering::Equal => {
                out.push((a[i].0, a[i].1 + b[j].1));
                i += 1;
                j += 1;
            }
        }
    }
    out.extend_from_slice(&a[i..]);
    out.extend_from_slice(&b[j..]);
    out
}

impl Poly {
    /// Zero.
    pub fn zero() -> Poly {
        Poly::default()
    }

    /// A constant.
    pub fn constant(c: Gauss) -> Poly {
        Poly::term(Monomial::new(), c)
    }

    /// An integer.
    pub fn integer(n: i64) -> Poly {
        Poly::constant(Gauss::real(n))
    }

    /// An indeterminate.
    pub fn symbol(x: Symbol) -> Poly {
        Poly::term(vec![(x, 1)], Gauss::real(1))
    }

    /// A monomial with coefficient one.
    pub fn monomial(m: &Monomial) -> Poly {
        Poly::term(m.clone(), Gauss::real(1))
    }

    fn term(m: Monomial, c: Gauss) -> Poly {
        let mut out = Poly::default();
        out.accumulate(m, &c);
        out
    }

    fn accumulate(&mut self, m: Monomial, c: &Gauss) {
        let Some(old) = self.terms.get_mut(&m) else {
            if !c.is_zero() {
                self.terms.insert(m, c.clone());
            }
            return;
        };
        *old = &*old + c;
        if old.is_zero() {
            self.terms.remove(&m);
        }
    }

    /// The terms in order.
    pub fn terms(&self) -> impl Iterator<Item = (&Monomial, &Gauss)> {
        self.terms.iter()
    }

    /// Returns true if it is zero.
    pub fn is_zero(&self) -> bool {
        self.terms.is_empty()
    }

    /// Returns true if it is the constant one.
    pub fn is_one(&self) -> bool {
        self.as_constant().is_some_and(|c| c.is_one())
    }

    /// Its value if it is a constant.
    pub fn as_constant(&self) -> Option<Gauss> {
        match self.terms.len() {
            0 => Some(Gauss::default()),
            1 => self.terms.get(&Monomial::new()).cloned(),
            _ => None,
        }
    }

    /// The coefficient of the last monomial; one makes a polynomial "monic".
    pub fn leading(&self) -> Gauss {
        self.terms
            .last_key_value()
            .map_or_else(Gauss::default, |(_, c)| c.clone())
    }

    /// All symbols in it.
    pub fn symbols(&self) -> BTreeSet<Symbol> {
        let names = self.terms.keys().flatten();
        names.map(|(x, _)| *x).collect()
    }

    /// Returns true if the symbol occurs.
    pub fn contains(&self, x: Symbol) -> bool {
        self.terms.keys().flatten().any(|(y, _)| *y == x)
    }

    /// With other coefficients, none of which is zero.
    fn mapped(&self, f: impl Fn(&Gauss) -> Gauss) -> Poly {
        let terms = self.terms.iter().map(|(m, c)| (m.clone(), f(c)));
        Poly {
            terms: terms.collect(),
        }
    }

    /// Multiplied by a constant.
    pub fn scaled(&self, c: &Gauss) -> Poly {
        if c.is_zero() || !spend(c.words() * self.terms.len() as u64) {
            return Poly::zero();
        }
        self.mapped(|a| a * c)
    }

    /// `self^k`.
    pub fn pow(&self, k: u32) -> Poly {
        (0..k).fold(Poly::integer(1), |p, _| &p * self)
    }

    /// Coefficients of `x^0, x^1, …`; empty for zero.
    pub fn coefficients(&self, x: Symbol) -> Vec<Poly> {
        let mut out: Vec<Poly> = Vec::new();
        for (m, c) in &self.terms {
            spend(1 + m.len() as u64 / 2);
            let k = m.iter().find(|f| f.0 == x).map_or(0, |f| f.1) as usize;
            let rest: Monomial = m.iter().filter(|f| f.0 != x).copied().collect();
            if out.len() <= k {
                out.resize(k + 1, Poly::zero());
            }
            out[k].accumulate(rest, c);
        }
        out
    }

    /// `Σ c_k x^k`.
    pub fn from_coefficients(x: Symbol, coefficients: &[Poly]) -> Poly {
        let mut out = Poly::zero();
        for (k, p) in coefficients.iter().enumerate() {
            let power = match k {
                0 => Monomial::new(),
                k => vec![(x, k as u32)],
            };
            for (m, c) in &p.terms {
                spend(1 + m.len() as u64 / 2);
                out.accumulate(times(m, &power), c);
            }
        }
        out
    }

    /// `∂/∂x`.
    pub fn derivative(&self, x: Symbol) -> Poly {
        let mut out = Poly::zero();
        for (m, c) in &self.terms {
            let Some(at) = m.iter().position(|f| f.0 == x) else {
                continue;
            };
            let k = m[at].1;
            let mut rest = m.clone();
            if k == 1 {
                rest.remove(at);
            } else {
                rest[at].1 = k - 1;
            }
            out.accumulate(rest, &(c * &Gauss::real(k)));
        }
        out
    }

    /// With other symbols in place of some, distinct ones for distinct ones.
    pub(super) fn renamed(&self, names: &BTreeMap<Symbol, Symbol>) -> Poly {
        let mut out = Poly::zero();
        for (m, c) in &self.terms {
            let name = |(x, k): &(Symbol, u32)| (*names.get(x).unwrap_or(x), *k);
            let mut renamed: Monomial = m.iter().map(name).collect();
            renamed.sort();
            out.accumulate(renamed, c);
        }
        out
    }

    /// Conjugated, all symbols being real.
    pub fn conj(&self) -> Poly {
        self.mapped(Gauss::conj)
    }

    /// The quotient if `d` divides exactly; `None` otherwise or for `d = 0`.
    pub fn divided_by(&self, d: &Poly) -> Option<Poly> {
        if self.is_zero() {
            return (!d.is_zero()).then(Poly::zero);
        }
        if let Some(c) = d.as_constant() {
            return Some(self.scaled(&c.inverse()?));
        }
        let x = *d.symbols().last()?;
        let mut rest = self.coefficients(x);
        let divisor = d.coefficients(x);
        let top = divisor.last()?;
        if rest.len() < divisor.len() {
            return None;
        }
        let mut quotient = vec![Poly::zero(); rest.len() - divisor.len() + 1];
        for k in (0..quotient.len()).rev() {
            let q = rest[k + divisor.len() - 1].divided_by(top)?;
            for (j, p) in divisor.iter().enumerate() {
                rest[k + j] = &rest[k + j] - &(&q * p);
            }
            quotient[k] = q;
        }
        rest.iter()
            .all(Poly::is_zero)
            .then(|| Poly::from_coefficients(x, &quotient))
    }
}

impl Add for &Poly {
    type Output = Poly;
    fn add(self, b: &Poly) -> Poly {
        if !spend(1 + (self.terms.len() + b.terms.len()) as u64 / 4) {
            return Poly::zero();
        }
        let mut out = self.clone();
        for (m, c) in &b.terms {
            out.accumulate(m.clone(), c);
        }
        out
    }
}

impl Sub for &Poly {
    type Output = Poly;
    fn sub(self, b: &Poly) -> Poly {
        let mut out = self.clone();
        for (m, c) in &b.terms {
            out.accumulate(m.clone(), &-c);
        }
        out
    }
}

impl Mul for &Poly {
    type Output = Poly;
    fn mul(self, b: &Poly) -> Poly {
        let mut out = Poly::zero();
        for (m, c) in &self.terms {
            // Past the limit the result is discarded; zero ends whatever loop asked for it.
            let each = c.words() + m.len() as u64;
            if !spend(each * b.terms.len() as u64) {
                return Poly::zero();
            }
            for (n, d) in &b.terms {
                out.accumulate(times(m, n), &(c * d));
            }
        }
        out
    }
}

impl Neg for &Poly {
    type Output = Poly;
    fn neg(self) -> Poly {
        self.scaled(&Gauss::real(-1))
    }
}

impl fmt::Display for Poly {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        if self.is_zero() {
            return f.write_str("0");
        }
        for (k, (m, c)) in self.terms.iter().enumerate() {
            let power = |(x, e): &(Symbol, u32)| match e {
                1 => x.name(),
                e => format!("{x}^{e}"),
            };
            let product = m.iter().map(power).collect::<Vec<_>>().join("*");
            let text = match (c.to_string().as_str(), product.as_str()) {
                (c, "") => c.to_string(),
                ("1", p) => p.to_string(),
                ("-1", p) => format!("-{p}"),
                (c, p) => format!("{c}*{p}"),
            };
            let plus = if k > 0 && !text.starts_with('-') {
                "+"
            } else {
                ""
            };
            write!(f, "{plus}{text}")?;
        }
        Ok(())
    }
}
