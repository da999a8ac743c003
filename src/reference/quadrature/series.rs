//! Truncated series in the distance from an end, with a power in front and a bound on what is left
//! out.

use super::bounds::{Bounds, Sign};
use super::growth::{Growth, Side};
use crate::{Ball, Mag};
use Side::{Lower, Upper};
use rug::Float;

/// Terms of a series.
pub(super) const TERMS: usize = 8;

/// `s^p (c_0 + … + c_(n−1) s^(n−1) + R(s) s^n)` with R(s) in `rest` for all s.
#[derive(Clone, Debug)]
pub(super) struct Series {
    pub(super) p: f64,
    pub(super) c: Vec<Ball>,
    pub(super) rest: Ball,
}

pub(super) fn whole(bits: u32, n: i64) -> Ball {
    Ball::integer(bits, n)
}

/// All of `[0, 2^−k]^n`.
pub(super) fn step(bits: u32, k: u32, n: usize) -> Ball {
    let half = i64::from(k) * n as i64 + 1;
    Ball::new(
        Float::with_val(bits, 1) >> half as u32,
        Mag::power_of_two(-half),
    )
}

pub(super) fn sum_is_exact(a: f64, b: f64) -> Option<f64> {
    let sum = a + b;
    let back = sum - a;
    ((a - (sum - back)) + (b - back) == 0.0 && sum.is_finite()).then_some(sum)
}

impl Series {
    pub(super) fn of(p: f64, c: Vec<Ball>) -> Series {
        let bits = c.first().map_or(64, Ball::prec);
        Series {
            p,
            c,
            rest: whole(bits, 0),
        }
    }

    pub(super) fn bits(&self) -> u32 {
        self.rest.prec()
    }

    /// The largest number of terms; the others go into the rest.
    pub(super) fn cut(mut self, k: u32, terms: usize) -> Series {
        while self.c.len() > terms {
            let last = self.c.pop().expect("a term");
            self.rest = &last + &self.rest * step(self.bits(), k, 1);
        }
        self
    }

    /// Returns true if this is exactly the function zero.
    pub(super) fn is_zero(&self) -> bool {
        self.rest.is_zero() && self.c.iter().all(Ball::is_zero)
    }

    /// The number of leading terms that are exactly zero, and the series divided by as many powers
    /// of s, with the p of before.
    pub(super) fn stripped(&self) -> (usize, Series) {
        let zeros = self.c.iter().take_while(|c| c.is_zero()).count();
        let c = self.c[zeros..].to_vec();
        let stripped = Series { c, ..self.clone() };
        if stripped.c.is_empty() {
            return (zeros, stripped);
        }
        (zeros, stripped.filled())
    }

    /// With zeros behind an exact end.
    pub(super) fn filled(mut self) -> Series {
        if self.rest.is_zero() {
            let bits = self.bits();
            while self.c.len() < TERMS {
                self.c.push(whole(bits, 0));
            }
        }
        self
    }

    /// All values of the part without the power.
    pub(super) fn range(&self, k: u32) -> Ball {
        let s = step(self.bits(), k, 1);
        self.c
            .iter()
            .rev()
            .fold(self.rest.clone(), |sum, c| c + &sum * &s)
    }

    /// Times `s^n`, without a change of p.
    pub(super) fn shifted(&self, n: usize) -> Series {
        let mut c = vec![whole(self.bits(), 0); n];
        c.extend(self.c.iter().cloned());
        Series { c, ..self.clone() }
    }

    pub(super) fn add(&self, other: &Series, k: u32) -> Option<Series> {
        if other.p < self.p {
            return other.add(self, k);
        }
        let gap = sum_is_exact(other.p, -self.p)?;
        if gap.fract() != 0.0 || gap > 1000.0 {
            return None;
        }
        let (a, b) = (self.clone().filled(), other.shifted(gap as usize).filled());
        let terms = a.c.len().min(b.c.len());
        let (a, b) = (a.cut(k, terms), b.cut(k, terms));
        let c = a.c.iter().zip(&b.c).map(|(x, y)| x + y).collect();
        Some(Series {
            p: self.p,
            c,
            rest: a.rest + b.rest,
        })
    }

    pub(super) fn mul(&self, other: &Series, k: u32) -> Option<Series> {
        let p = sum_is_exact(self.p, other.p)?;
        let (a, b) = (self.clone().filled(), other.clone().filled());
        let terms = a.c.len().min(b.c.len());
        let (a, b) = (a.cut(k, terms), b.cut(k, terms));
        let bits = a.bits().max(b.bits());
        let mut c = vec![whole(bits, 0); 2 * terms];
        for (i, x) in a.c.iter().enumerate() {
            for (j, y) in b.c.iter().enumerate() {
                c[i + j] = &c[i + j] + &(x * y);
            }
        }
        // The rests times all of the other.
        let range = Series {
            rest: whole(bits, 0),
            ..a.clone()
        }
        .range(k);
        let rest = &b.rest * range + &a.rest * b.range(k);
        let beyond = c.split_off(terms);
        let s = step(bits, k, 1);
        let beyond = beyond
            .iter()
            .rev()
            .fold(whole(bits, 0), |sum, c| c + &sum * &s);
        Some(Series {
            p,
            c,
            rest: rest + beyond,
        })
    }

    /// The composition `g(f)` for p = 0, by the Taylor coefficients of g: those at `c_0`, and the
    /// one of the rest everywhere, times a power of `(f − c_0)/s`.
    pub(super) fn compose(
        &self,
        k: u32,
        g: impl Fn(&Ball, usize) -> Option<Vec<Ball>>,
    ) -> Option<Series> {
        debug_assert!(self.p == 0.0 && !self.c.is_empty());
        let this = self.clone().filled();
        let n = this.c.len();
        let bits = this.bits();
        let at = g(&this.c[0], n)?;
        let along = g(&this.range(k), n + 1)?;
        let mut h = this.clone();
        h.c[0] = whole(bits, 0);
        let slope = Series {
            c: h.c[1..].to_vec(),
            ..h.clone()
        }
        .range(k);
        let mut sum = Series {
            p: 0.0,
            c: vec![whole(bits, 0); n],
            rest: whole(bits, 0),
        };
        for coefficient in at.iter().rev() {
            sum = sum.mul(&h, k)?;
            sum.c[0] = &sum.c[0] + coefficient;
        }
        let power = (0..n).fold(whole(bits, 1), |power, _| &power * &slope);
        sum.rest = &sum.rest + &along[n] * power;
        let finite = sum.c.iter().all(Ball::is_finite) && sum.rest.is_finite();
        finite.then_some(sum)
    }

    pub(super) fn bounds(&self, k: u32) -> Option<Bounds> {
        if self.is_zero() {
            let upper = Growth::constant(k, Mag::ZERO);
            return Some(Bounds {
                sign: Sign::Unknown,
                lower: None,
                upper,
            });
        }
        let (zeros, unit) = self.stripped();
        let range = unit.range(k);
        if !range.is_finite() {
            return None;
        }
        let exponent = |side: Side| side.add(self.p, zeros as f64);
        let lower = || Growth::power(k, range.mignitude(), exponent(Upper));
        Some(Bounds {
            sign: match () {
                () if range.is_positive() => Sign::Positive,
                () if range.is_negative() => Sign::Negative,
                () => Sign::Unknown,
            },
            lower: (!range.contains_zero()).then(lower),
            upper: Growth::power(k, range.magnitude(), exponent(Lower)),
        })
    }

    /// The same with p = 0, if p is a whole number that is not negative.
    pub(super) fn regular(&self, k: u32) -> Option<Series> {
        if !(self.p >= 0.0 && self.p.fract() == 0.0 && self.p <= 1000.0) {
            return None;
        }
        let whole = Series {
            p: 0.0,
            ..self.shifted(self.p as usize)
        };
        Some(whole.cut(k, TERMS))
    }
}
