//! Sums of exponentials with rational functions as coefficients.

use super::work::spend;
use super::{Fraction, Gauss, Poly, Symbol};
use std::collections::BTreeMap;
use std::fmt;
use std::ops::{Add, Mul, Neg, Sub};

/// `Σ c_j e^{p_j}` with distinct rational functions `p_j` and non-zero `c_j`.
///
/// Exponentials of distinct exponents are linearly independent over the rational functions (those
/// whose exponents differ by a function, because the quotient of the exponentials is not algebraic;
/// those that differ by an algebraic constant, by Lindemann's theorem), so equal sums have equal
/// terms. π is an indeterminate here; the one relation it has, `e^{iπ} = −1`, is applied by
/// [`Algebra::reduce`](super::Algebra::reduce).
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ExpSum {
    terms: BTreeMap<Fraction, Fraction>,
}

impl From<Fraction> for ExpSum {
    fn from(c: Fraction) -> ExpSum {
        ExpSum::term(c, Fraction::zero())
    }
}

impl ExpSum {
    /// Zero.
    pub fn zero() -> ExpSum {
        ExpSum::default()
    }

    /// `c e^p`.
    pub fn term(c: Fraction, p: Fraction) -> ExpSum {
        let mut out = ExpSum::default();
        out.accumulate(c, p);
        out
    }

    /// A constant.
    pub fn constant(c: Gauss) -> ExpSum {
        Fraction::constant(c).into()
    }

    /// An integer.
    pub fn integer(n: i64) -> ExpSum {
        Fraction::integer(n).into()
    }

    /// An indeterminate.
    pub fn symbol(x: Symbol) -> ExpSum {
        Fraction::from(Poly::symbol(x)).into()
    }

    pub(super) fn accumulate(&mut self, c: Fraction, p: Fraction) {
        let Some(old) = self.terms.get_mut(&p) else {
            if !c.is_zero() {
                self.terms.insert(p, c);
            }
            return;
        };
        *old = &*old + &c;
        if old.is_zero() {
            self.terms.remove(&p);
        }
    }

    /// Pairs of exponent and coefficient, in order.
    pub fn terms(&self) -> impl Iterator<Item = (&Fraction, &Fraction)> {
        self.terms.iter()
    }

    /// Returns true if it is zero.
    pub fn is_zero(&self) -> bool {
        self.terms.is_empty()
    }

    /// Exponent and coefficient if there is one term only.
    pub fn as_single(&self) -> Option<(&Fraction, &Fraction)> {
        match self.terms.len() {
            1 => self.terms.first_key_value(),
            _ => None,
        }
    }

    /// Its value if no exponential is left.
    pub fn as_fraction(&self) -> Option<Fraction> {
        if self.is_zero() {
            return Some(Fraction::zero());
        }
        let (p, c) = self.as_single()?;
        p.is_zero().then(|| c.clone())
    }

    /// The inverse of a single term; `None` of zero and of proper sums, whose inverses are not
    /// sums of exponentials.
    pub fn inverse(&self) -> Option<ExpSum> {
        let (p, c) = self.as_single()?;
        Some(ExpSum::term(c.inverse()?, -p))
    }

    /// Conjugated, all symbols being real.
    pub fn conj(&self) -> ExpSum {
        let mut out = ExpSum::zero();
        for (p, c) in &self.terms {
            out.accumulate(c.conj(), p.conj());
        }
        out
    }

    /// Returns true if the symbol occurs.
    pub fn contains(&self, x: Symbol) -> bool {
        self.terms
            .iter()
            .any(|(p, c)| p.contains(x) || c.contains(x))
    }
}

impl Add for &ExpSum {
    type Output = ExpSum;
    fn add(self, b: &ExpSum) -> ExpSum {
        // Copying counts as well: a long sum is made of as many additions as it has terms.
        spend(1 + (self.terms.len() + b.terms.len()) as u64 / 2);
        let mut out = self.clone();
        for (p, c) in &b.terms {
            out.accumulate(c.clone(), p.clone());
        }
        out
    }
}

impl Neg for &ExpSum {
    type Output = ExpSum;
    fn neg(self) -> ExpSum {
        let terms = self.terms.iter();
        ExpSum {
            terms: terms.map(|(p, c)| (p.clone(), -c)).collect(),
        }
    }
}

impl Sub for &ExpSum {
    type Output = ExpSum;
    fn sub(self, b: &ExpSum) -> ExpSum {
        self + &-b
    }
}

impl Mul for &ExpSum {
    type Output = ExpSum;
    fn mul(self, b: &ExpSum) -> ExpSum {
        let mut out = ExpSum::zero();
        let size = |f: &Fraction| (f.num().terms().count() + f.den().terms().count()) as u64;
        for (p, c) in &self.terms {
            let each = 10 + size(p) + size(c);
            // Past the limit the result is discarded.
            if !spend(each * b.terms.len() as u64) {
                return ExpSum::zero();
            }
            for (q, d) in &b.terms {
                out.accumulate(c * d, p + q);
            }
        }
        out
    }
}

impl fmt::Display for ExpSum {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        if self.is_zero() {
            return f.write_str("0");
        }
        for (k, (p, c)) in self.terms.iter().enumerate() {
            let sum = c.den().is_one() && c.num().terms().count() > 1;
            let text = match (p.is_zero(), sum) {
                (true, _) => c.to_string(),
                (false, true) => format!("({c})*exp({p})"),
                (false, false) => match c.to_string().as_str() {
                    "1" => format!("exp({p})"),
                    "-1" => format!("-exp({p})"),
                    c => format!("{c}*exp({p})"),
                },
            };
            let plus = if k > 0 && !text.starts_with('-') {
                " + "
            } else {
                ""
            };
            let space = if k > 0 && plus.is_empty() { " " } else { "" };
            write!(f, "{plus}{space}{text}")?;
        }
        Ok(())
    }
}
