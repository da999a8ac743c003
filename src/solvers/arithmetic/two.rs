//! Two numbers, or two vectors of them, as one [`Real`].

use crate::real::{Masked, Real};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Two of them side by side: twice as many operations that need not wait for each other.
#[derive(Clone, Copy)]
pub(crate) struct Two<R>(pub R, pub R);

macro_rules! both {
    ($trait:ident, $method:ident) => {
        impl<R: Real> $trait for Two<R> {
            type Output = Two<R>;
            #[inline(always)]
            fn $method(self, other: Two<R>) -> Two<R> {
                Two(self.0.$method(other.0), self.1.$method(other.1))
            }
        }
    };
}
both!(Add, add);
both!(Sub, sub);
both!(Mul, mul);
both!(Div, div);

impl<R: Real> Neg for Two<R> {
    type Output = Two<R>;
    #[inline(always)]
    fn neg(self) -> Two<R> {
        Two(-self.0, -self.1)
    }
}

impl<R: Real> Real for Two<R> {
    type Mask = (R::Mask, R::Mask);
    #[inline(always)]
    fn like(self, x: f64) -> Two<R> {
        Two(self.0.like(x), self.1.like(x))
    }
    #[inline(always)]
    fn fma(self, b: Two<R>, c: Two<R>) -> Two<R> {
        Two(self.0.fma(b.0, c.0), self.1.fma(b.1, c.1))
    }
    #[inline(always)]
    fn magnitude(self) -> Two<R> {
        Two(self.0.magnitude(), self.1.magnitude())
    }
    #[inline(always)]
    fn at_least(self, low: Two<R>) -> Two<R> {
        Two(self.0.at_least(low.0), self.1.at_least(low.1))
    }
    #[inline(always)]
    fn raised(self, least: f64) -> Two<R> {
        Two(self.0.raised(least), self.1.raised(least))
    }
    #[inline(always)]
    fn at_most(self, high: Two<R>) -> Two<R> {
        Two(self.0.at_most(high.0), self.1.at_most(high.1))
    }
    #[inline(always)]
    fn below(self, other: Two<R>) -> Self::Mask {
        (self.0.below(other.0), self.1.below(other.1))
    }
    #[inline(always)]
    fn or(self, a: Self::Mask, b: Self::Mask) -> Self::Mask {
        (self.0.or(a.0, b.0), self.1.or(a.1, b.1))
    }
    #[inline(always)]
    fn pick(self, mask: Self::Mask, yes: Two<R>, no: Two<R>) -> Two<R> {
        Two(
            self.0.pick(mask.0, yes.0, no.0),
            self.1.pick(mask.1, yes.1, no.1),
        )
    }
    #[inline(always)]
    fn all(self, mask: Self::Mask) -> bool {
        self.0.all(mask.0) & self.1.all(mask.1)
    }
    #[inline(always)]
    fn power_of_two(self) -> Two<R> {
        Two(self.0.power_of_two(), self.1.power_of_two())
    }
    #[inline(always)]
    fn is_odd(self) -> Self::Mask {
        (self.0.is_odd(), self.1.is_odd())
    }
    #[inline(always)]
    fn flip(self, x: Two<R>) -> Two<R> {
        Two(self.0.flip(x.0), self.1.flip(x.1))
    }
}

impl<R: Masked> Masked for Two<R> {
    #[inline(always)]
    fn any(self, mask: Self::Mask) -> bool {
        self.0.any(mask.0) | self.1.any(mask.1)
    }
    #[inline(always)]
    fn both(self, a: Self::Mask, b: Self::Mask) -> Self::Mask {
        (self.0.both(a.0, b.0), self.1.both(a.1, b.1))
    }
    #[inline(always)]
    fn except(self, a: Self::Mask, b: Self::Mask) -> Self::Mask {
        (self.0.except(a.0, b.0), self.1.except(a.1, b.1))
    }
    #[inline(always)]
    fn with_sign_of(self, x: Self) -> Self {
        Two(self.0.with_sign_of(x.0), self.1.with_sign_of(x.1))
    }
    #[inline(always)]
    fn root(self) -> Self {
        Two(self.0.root(), self.1.root())
    }
}
