//! Unevaluated sums of two `f64` (double-double numbers) and the error-free transformations below
//! them.
//!
//! Sources: Dekker, *A floating-point technique for extending the available precision*, Numer.
//! Math. 18 (1971); Knuth, *TAOCP* 2, 4.2.2; error bounds: Joldes, Muller & Popescu, *Tight and
//! rigorous error bounds for basic building blocks of double-word arithmetic*, ACM TOMS 44 (2017),
//! art. 15, whose algorithm numbers are quoted. With `u = 2⁻⁵³`.

use std::ops::{Add, Mul, Neg, Sub};

/// `hi + lo` with `|lo| ≤ ulp(hi)/2` after every operation that renormalises.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Dd {
    pub hi: f64,
    pub lo: f64,
}

/// `a + b = s + e` exactly (Knuth).
#[inline(always)]
pub(super) fn two_sum(a: f64, b: f64) -> Dd {
    let s = a + b;
    let t = s - a;
    Dd {
        hi: s,
        lo: (a - (s - t)) + (b - t),
    }
}

/// `a + b = s + e` exactly if `|a| ≥ |b|` or `a = 0` (Dekker).
#[inline(always)]
pub(super) fn fast_two_sum(a: f64, b: f64) -> Dd {
    let s = a + b;
    Dd {
        hi: s,
        lo: b - (s - a),
    }
}

/// `a b = p + e` exactly, barring underflow.
#[inline(always)]
pub(super) fn two_prod(a: f64, b: f64) -> Dd {
    let p = a * b;
    Dd {
        hi: p,
        lo: a.mul_add(b, -p),
    }
}

impl Dd {
    pub(super) const ZERO: Dd = Dd { hi: 0.0, lo: 0.0 };

    #[inline(always)]
    pub(super) const fn new(hi: f64, lo: f64) -> Dd {
        Dd { hi, lo }
    }

    #[inline(always)]
    pub(super) const fn from(hi: f64) -> Dd {
        Dd { hi, lo: 0.0 }
    }

    /// The nearest `f64`.
    #[inline(always)]
    pub(super) fn value(self) -> f64 {
        self.hi + self.lo
    }

    /// Renormalised; needs `|hi| ≥ |lo|`.
    #[inline(always)]
    pub(super) fn normal(self) -> Dd {
        fast_two_sum(self.hi, self.lo)
    }

    /// Exact product with a power of two (barring underflow).
    #[inline(always)]
    pub(super) fn scale(self, power_of_two: f64) -> Dd {
        Dd {
            hi: self.hi * power_of_two,
            lo: self.lo * power_of_two,
        }
    }

    /// `DWPlusFP`, relative error ≤ 2u².
    #[inline(always)]
    pub(super) fn add_f(self, b: f64) -> Dd {
        let s = two_sum(self.hi, b);
        fast_two_sum(s.hi, s.lo + self.lo)
    }

    /// `DWTimesFP3`, relative error ≤ 2u².
    #[inline(always)]
    pub(super) fn mul_f(self, b: f64) -> Dd {
        let p = two_prod(self.hi, b);
        fast_two_sum(p.hi, self.lo.mul_add(b, p.lo))
    }

    /// The square, relative error ≤ 5u².
    #[inline(always)]
    pub(super) fn square(self) -> Dd {
        let p = two_prod(self.hi, self.hi);
        fast_two_sum(p.hi, (2.0 * self.hi).mul_add(self.lo, p.lo))
    }

    /// `DWDivDW3`-like quotient: one Newton correction, relative error ≤ 10u².
    #[inline(always)]
    pub(super) fn div(self, b: Dd) -> Dd {
        let q = self.hi / b.hi;
        // self − q b, exactly in its leading part.
        let p = two_prod(q, b.hi);
        let r = (self.hi - p.hi) - p.lo + q.mul_add(-b.lo, self.lo);
        fast_two_sum(q, r / b.hi)
    }
}

/// `AccurateDWPlusDW`, relative error ≤ 3u²/(1 − 4u).
impl Add for Dd {
    type Output = Dd;
    #[inline(always)]
    fn add(self, b: Dd) -> Dd {
        let s = two_sum(self.hi, b.hi);
        let t = two_sum(self.lo, b.lo);
        let v = fast_two_sum(s.hi, s.lo + t.hi);
        fast_two_sum(v.hi, v.lo + t.lo)
    }
}

impl Sub for Dd {
    type Output = Dd;
    #[inline(always)]
    fn sub(self, b: Dd) -> Dd {
        self + -b
    }
}

impl Neg for Dd {
    type Output = Dd;
    #[inline(always)]
    fn neg(self) -> Dd {
        Dd {
            hi: -self.hi,
            lo: -self.lo,
        }
    }
}

/// `DWTimesDW3`, relative error ≤ 4u².
impl Mul for Dd {
    type Output = Dd;
    #[inline(always)]
    fn mul(self, b: Dd) -> Dd {
        let p = two_prod(self.hi, b.hi);
        let t = self.lo * b.lo;
        let t = self.hi.mul_add(b.lo, t);
        let t = self.lo.mul_add(b.hi, t);
        fast_two_sum(p.hi, p.lo + t)
    }
}
