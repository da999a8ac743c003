//! Rational functions over the Gaussian rationals, in lowest terms.

use super::gcd::gcd;
use super::{Gauss, Poly, Symbol};
use std::collections::BTreeMap;
use std::fmt;
use std::ops::{Add, Mul, Neg, Sub};

/// `num/den`: without common divisors, den monic. Equal rational functions are equal values.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Fraction {
    num: Poly,
    den: Poly,
}

impl From<Poly> for Fraction {
    fn from(num: Poly) -> Fraction {
        Fraction {
            num,
            den: Poly::integer(1),
        }
    }
}

impl Fraction {
    /// Zero.
    pub fn zero() -> Fraction {
        Poly::zero().into()
    }

    /// An integer.
    pub fn integer(n: i64) -> Fraction {
        Poly::integer(n).into()
    }

    /// A constant.
    pub fn constant(c: Gauss) -> Fraction {
        Poly::constant(c).into()
    }

    /// An indeterminate.
    pub fn symbol(x: Symbol) -> Fraction {
        Poly::symbol(x).into()
    }

    /// `num/den` in lowest terms; `None` for `den = 0`.
    pub fn new(num: Poly, den: Poly) -> Option<Fraction> {
        if den.is_zero() {
            return None;
        }
        if num.is_zero() {
            return Some(Fraction::zero());
        }
        let (num, den) = match den.as_constant() {
            Some(_) => (num, den),
            None => {
                let g = gcd(&num, &den);
                (num.divided_by(&g)?, den.divided_by(&g)?)
            }
        };
        let unit = den.leading().inverse()?;
        Some(Fraction {
            num: num.scaled(&unit),
            den: den.scaled(&unit),
        })
    }

    /// The numerator.
    pub fn num(&self) -> &Poly {
        &self.num
    }

    /// The denominator.
    pub fn den(&self) -> &Poly {
        &self.den
    }

    /// `1/den`.
    pub(super) fn inverse_of_denominator(&self) -> Fraction {
        Fraction {
            num: Poly::integer(1),
            den: self.den.clone(),
        }
    }

    /// Returns true if it is zero.
    pub fn is_zero(&self) -> bool {
        self.num.is_zero()
    }

    /// Its value if it is a constant.
    pub fn as_constant(&self) -> Option<Gauss> {
        self.den.is_one().then(|| self.num.as_constant()).flatten()
    }

    /// The inverse; `None` of zero.
    pub fn inverse(&self) -> Option<Fraction> {
        let unit = self.num.leading().inverse()?;
        Some(Fraction {
            num: self.den.scaled(&unit),
            den: self.num.scaled(&unit),
        })
    }

    /// Returns true if the symbol occurs.
    pub fn contains(&self, x: Symbol) -> bool {
        self.num.contains(x) || self.den.contains(x)
    }

    /// Conjugated, all symbols being real.
    pub fn conj(&self) -> Fraction {
        // The conjugate of a monic denominator has leading coefficient one.
        Fraction {
            num: self.num.conj(),
            den: self.den.conj(),
        }
    }

    /// With other symbols in place of some.
    pub(super) fn renamed(&self, names: &BTreeMap<Symbol, Symbol>) -> Fraction {
        Fraction::new(self.num.renamed(names), self.den.renamed(names))
            .unwrap_or_else(Fraction::zero)
    }

    /// `∂/∂x`.
    pub fn derivative(&self, x: Symbol) -> Fraction {
        let top = &(&self.num.derivative(x) * &self.den) - &(&self.num * &self.den.derivative(x));
        Fraction::new(top, &self.den * &self.den).unwrap_or_else(Fraction::zero)
    }
}

impl Add for &Fraction {
    type Output = Fraction;
    fn add(self, b: &Fraction) -> Fraction {
        let (num, den) = if self.den == b.den {
            (&self.num + &b.num, self.den.clone())
        } else {
            (
                &(&self.num * &b.den) + &(&b.num * &self.den),
                &self.den * &b.den,
            )
        };
        Fraction::new(num, den).unwrap_or_else(Fraction::zero)
    }
}

impl Neg for &Fraction {
    type Output = Fraction;
    fn neg(self) -> Fraction {
        Fraction {
            num: -&self.num,
            den: self.den.clone(),
        }
    }
}

impl Sub for &Fraction {
    type Output = Fraction;
    fn sub(self, b: &Fraction) -> Fraction {
        self + &-b
    }
}

impl Mul for &Fraction {
    type Output = Fraction;
    fn mul(self, b: &Fraction) -> Fraction {
        Fraction::new(&self.num * &b.num, &self.den * &b.den).unwrap_or_else(Fraction::zero)
    }
}

impl fmt::Display for Fraction {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let bracketed = |p: &Poly| match p.terms().count() {
            0 | 1 => p.to_string(),
            _ => format!("({p})"),
        };
        if self.den.is_one() {
            write!(f, "{}", self.num)
        } else {
            let den = match self.den.terms().next() {
                Some((m, _)) if self.den.terms().count() == 1 && m.len() == 1 => {
                    self.den.to_string()
                }
                _ => format!("({})", self.den),
            };
            write!(f, "{}/{den}", bracketed(&self.num))
        }
    }
}
