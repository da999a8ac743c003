//! The formulas of the upper half-plane and beside the real axis, for a bucket.

use super::super::asymptotic::{series_rounded, two_terms};
use super::super::maclaurin::{nine_terms, twenty_one_terms};
use super::super::plane::{in_strip, on_real_line};
use crate::real::Real;

/// A formula for w at `a + i y`, `a ≥ 0`.
pub(super) trait Formula: Copy {
    fn value<R: Real>(self, a: R, y: R) -> (R, R);
}

/// A formula that also tells where digits are lost.
pub(super) trait UnlessLost: Copy {
    fn value<R: Real>(self, a: R, y: R) -> (R, R, R::Mask);
}

#[derive(Clone, Copy)]
pub(super) struct InStrip;

impl UnlessLost for InStrip {
    #[inline(always)]
    fn value<R: Real>(self, a: R, y: R) -> (R, R, R::Mask) {
        in_strip(a, y)
    }
}

#[derive(Clone, Copy)]
pub(super) struct OnRealLine;

impl UnlessLost for OnRealLine {
    #[inline(always)]
    fn value<R: Real>(self, a: R, y: R) -> (R, R, R::Mask) {
        on_real_line(a, y)
    }
}

/// The Maclaurin series with 9 terms.
#[derive(Clone, Copy)]
pub(super) struct Maclaurin9;

impl Formula for Maclaurin9 {
    #[inline(always)]
    fn value<R: Real>(self, a: R, y: R) -> (R, R) {
        nine_terms(a, y)
    }
}

/// The same with 21.
#[derive(Clone, Copy)]
pub(super) struct Maclaurin21;

impl Formula for Maclaurin21 {
    #[inline(always)]
    fn value<R: Real>(self, a: R, y: R) -> (R, R) {
        twenty_one_terms(a, y)
    }
}

/// The asymptotic series with two terms.
#[derive(Clone, Copy)]
pub(super) struct TwoTerms;

impl Formula for TwoTerms {
    #[inline(always)]
    fn value<R: Real>(self, a: R, y: R) -> (R, R) {
        two_terms(a, y.magnitude())
    }
}

/// The asymptotic series with N terms.
#[derive(Clone, Copy)]
pub(super) struct Series<const N: usize>;

impl<const N: usize> Formula for Series<N> {
    #[inline(always)]
    fn value<R: Real>(self, a: R, y: R) -> (R, R) {
        series_rounded::<_, N>(a, y.magnitude())
    }
}
