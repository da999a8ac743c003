//! Unevaluated sums of two `f64` (double-double numbers) and the error-free transformations below
//! them.
//!
//! Sources: Dekker, *A floating-point technique for extending the available precision*, Numer.
//! Math. 18 (1971); Knuth, *TAOCP* 2, 4.2.2; error bounds: Joldes, Muller & Popescu, *Tight and
//! rigorous error bounds for basic building blocks of double-word arithmetic*, ACM TOMS 44 (2017),
//! art. 15, whose algorithm numbers are quoted. With `u = 2⁻⁵³`.

use super::tables::HALF_PI;
use crate::real::Real;
use std::ops::{Add, Mul, Neg, Sub};

/// `hi + lo` with `|lo| ≤ ulp(hi)/2` after every operation that renormalises.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Dd<R = f64> {
    pub hi: R,
    pub lo: R,
}

/// `a + b = s + e` exactly (Knuth).
#[inline(always)]
pub(crate) fn two_sum<R: Real>(a: R, b: R) -> Dd<R> {
    let (hi, lo) = a.two_sum(b);
    Dd { hi, lo }
}

/// `a + b = s + e` exactly if `|a| ≥ |b|` or `a = 0` (Dekker).
#[inline(always)]
pub(crate) fn fast_two_sum<R: Real>(a: R, b: R) -> Dd<R> {
    let (hi, lo) = a.fast_two_sum(b);
    Dd { hi, lo }
}

/// `a b = p + e` exactly, barring underflow.
#[inline(always)]
pub(crate) fn two_prod<R: Real>(a: R, b: R) -> Dd<R> {
    let (hi, lo) = a.two_prod(b);
    Dd { hi, lo }
}

/// The sign of a sum of a few numbers, exactly: an expansion without overlap is grown term by
/// term and its last non-zero component has the sign of the whole (J. R. Shewchuk, *Adaptive
/// precision floating-point arithmetic*, Discrete Comput. Geom. 18, 1997, theorem 10).
pub(crate) fn sign_of_sum(terms: &[f64]) -> f64 {
    let mut expansion: Vec<f64> = Vec::with_capacity(terms.len());
    for &t in terms {
        let mut carry = t;
        for e in &mut expansion {
            let sum = carry + *e;
            let back = sum - carry;
            *e = (carry - (sum - back)) + (*e - back);
            carry = sum;
        }
        expansion.push(carry);
    }
    match expansion.iter().rev().find(|&&e| e != 0.0) {
        Some(e) => e.signum(),
        None => 0.0,
    }
}

impl Dd {
    pub(crate) const PI: Dd = Dd::new(2.0 * HALF_PI[0], 2.0 * HALF_PI[1]);
    pub(crate) const ZERO: Dd = Dd { hi: 0.0, lo: 0.0 };

    #[inline(always)]
    pub(crate) const fn from(hi: f64) -> Dd {
        Dd { hi, lo: 0.0 }
    }

    /// The constant in every place.
    #[inline(always)]
    pub(crate) fn like<R: Real>(self, x: R) -> Dd<R> {
        Dd::new(x.like(self.hi), x.like(self.lo))
    }

    /// Exact product with a power of two (barring underflow).
    #[inline(always)]
    pub(crate) fn scale(self, power_of_two: f64) -> Dd {
        Dd {
            hi: self.hi * power_of_two,
            lo: self.lo * power_of_two,
        }
    }
}

impl<R> Dd<R> {
    #[inline(always)]
    pub(crate) const fn new(hi: R, lo: R) -> Dd<R> {
        Dd { hi, lo }
    }
}

impl<R: Real> Dd<R> {
    /// The nearest `f64`.
    #[inline(always)]
    pub(crate) fn value(self) -> R {
        self.hi + self.lo
    }

    /// Renormalised; needs `|hi| ≥ |lo|`.
    #[inline(always)]
    pub(crate) fn normal(self) -> Dd<R> {
        fast_two_sum(self.hi, self.lo)
    }

    /// `DWPlusFP`, relative error ≤ 2u².
    #[inline(always)]
    pub(crate) fn add_f(self, b: R) -> Dd<R> {
        let s = two_sum(self.hi, b);
        fast_two_sum(s.hi, s.lo + self.lo)
    }

    /// The square, relative error ≤ 5u².
    #[inline(always)]
    pub(crate) fn square(self) -> Dd<R> {
        let p = two_prod(self.hi, self.hi);
        fast_two_sum(p.hi, (self.hi + self.hi).fma(self.lo, p.lo))
    }

    /// `DWTimesFP3`, relative error ≤ 2u².
    #[inline(always)]
    pub(crate) fn mul_f(self, b: R) -> Dd<R> {
        let p = two_prod(self.hi, b);
        fast_two_sum(p.hi, self.lo.fma(b, p.lo))
    }

    /// `DWDivDW3`-like quotient: one Newton correction, relative error ≤ 10u².
    #[inline(always)]
    pub(crate) fn div(self, b: Dd<R>) -> Dd<R> {
        let q = self.hi / b.hi;
        // self − q b, exactly in its leading part.
        let p = two_prod(q, b.hi);
        let r = (self.hi - p.hi) - p.lo + q.fma(-b.lo, self.lo);
        fast_two_sum(q, r / b.hi)
    }
}

/// `AccurateDWPlusDW`, relative error ≤ 3u²/(1 − 4u).
impl<R: Real> Add for Dd<R> {
    type Output = Dd<R>;
    #[inline(always)]
    fn add(self, b: Dd<R>) -> Dd<R> {
        let s = two_sum(self.hi, b.hi);
        let t = two_sum(self.lo, b.lo);
        let v = fast_two_sum(s.hi, s.lo + t.hi);
        fast_two_sum(v.hi, v.lo + t.lo)
    }
}

impl<R: Real> Sub for Dd<R> {
    type Output = Dd<R>;
    #[inline(always)]
    fn sub(self, b: Dd<R>) -> Dd<R> {
        self + -b
    }
}

impl<R: Real> Neg for Dd<R> {
    type Output = Dd<R>;
    #[inline(always)]
    fn neg(self) -> Dd<R> {
        Dd {
            hi: -self.hi,
            lo: -self.lo,
        }
    }
}

/// `DWTimesDW3`, relative error ≤ 4u².
impl<R: Real> Mul for Dd<R> {
    type Output = Dd<R>;
    #[inline(always)]
    fn mul(self, b: Dd<R>) -> Dd<R> {
        let p = two_prod(self.hi, b.hi);
        let t = self.lo * b.lo;
        let t = self.hi.fma(b.lo, t);
        let t = self.lo.fma(b.hi, t);
        fast_two_sum(p.hi, p.lo + t)
    }
}
