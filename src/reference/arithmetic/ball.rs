//! Real balls: a midpoint in MPFR and a radius that bounds the distance to the true value.
//!
//! # Contract
//! For every operation here: if each operand's ball contains a number, the result's ball contains
//! the exact result of the operation on those numbers. The midpoint is rounded to nearest by MPFR
//! (correctly rounded, so its error is at most half a unit in the last place: Fousse et al.,
//! *MPFR*, ACM TOMS 33(2), 2007, art. 13); the radius is propagated with the bound written at each
//! operation and rounded up ([`Mag`]).

use super::mag::Mag;
use super::nearest;
use rug::float::{Constant, Round, exp_min};
use rug::ops::{AddAssignRound, AssignRound, NegAssign};
use rug::{Float, Rational};
use std::borrow::Borrow;
use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Holds a double, an integer of the machine, and more than a bound: any number of 53 bits or more
/// rounds alike to one.
const BITS: u32 = 64;

/// A real number known to lie in `[mid − rad, mid + rad]`.
#[derive(Clone, Debug)]
pub struct Ball {
    mid: Float,
    rad: Mag,
}

/// Half a unit in the last place of a midpoint that was rounded to nearest.
fn rounding(mid: &Float, ordering: Ordering) -> Mag {
    if ordering == Ordering::Equal {
        return Mag::ZERO;
    }
    match mid.get_exp() {
        // The least positive number of MPFR stands for all below it.
        Some(e) if e == exp_min() => Mag::power_of_two(i64::from(e)),
        Some(e) => Mag::power_of_two(i64::from(e) - i64::from(mid.prec()) - 1),
        // Rounded to zero or infinity: outside MPFR's exponent range.
        None => Mag::INFINITY,
    }
}

impl Ball {
    /// A ball from its parts. A NaN or infinite midpoint gives the whole line.
    pub fn new(mid: Float, rad: Mag) -> Ball {
        if mid.is_finite() {
            Ball { mid, rad }
        } else {
            Ball {
                mid: Float::new(mid.prec()),
                rad: Mag::INFINITY,
            }
        }
    }

    /// A correctly rounded midpoint with what was propagated from the operands.
    pub(super) fn rounded((mid, ordering): (Float, Ordering), propagated: Mag) -> Ball {
        let rad = propagated.add(rounding(&mid, ordering));
        Ball::new(mid, rad)
    }

    /// A value rounded to nearest with what was propagated from the operands.
    pub(super) fn nearest<T>(prec: u32, value: T, propagated: Mag) -> Ball
    where
        Float: AssignRound<T, Round = Round, Ordering = Ordering>,
    {
        let rounded = Float::with_val_round(prec, value, Round::Nearest);
        Ball::rounded(rounded, propagated)
    }

    /// An exact integer (at least 64 bits are kept, so it is exact).
    pub fn integer(prec: u32, n: i64) -> Ball {
        Ball::new(Float::with_val(prec.max(BITS), n), Mag::ZERO)
    }

    /// An exact `f64`. NaN and infinities give the whole line.
    pub fn exact(prec: u32, x: f64) -> Ball {
        Ball::new(Float::with_val(prec.max(53), x), Mag::ZERO)
    }

    /// The ball around an exact rational, rounded to `prec` bits.
    pub fn rational(prec: u32, q: &Rational) -> Ball {
        Ball::nearest(prec, q, Mag::ZERO)
    }

    /// π to `prec` bits.
    pub fn pi(prec: u32) -> Ball {
        Ball::nearest(prec, Constant::Pi, Mag::ZERO)
    }

    /// The midpoint.
    pub fn mid(&self) -> &Float {
        &self.mid
    }

    /// The radius.
    pub fn rad(&self) -> Mag {
        self.rad
    }

    /// Working precision of the midpoint in bits.
    pub fn prec(&self) -> u32 {
        self.mid.prec()
    }

    /// Returns true if the ball bounds anything.
    pub fn is_finite(&self) -> bool {
        self.rad.is_finite()
    }

    /// The same midpoint with the radius enlarged by `extra`.
    pub fn widened(&self, extra: Mag) -> Ball {
        Ball::new(self.mid.clone(), self.rad.add(extra))
    }

    /// The same number at another precision (a superset when bits are dropped).
    pub fn with_prec(&self, prec: u32) -> Ball {
        Ball::nearest(prec, &self.mid, self.rad)
    }

    /// An upper bound on the absolute value.
    pub fn magnitude(&self) -> Mag {
        Mag::above(&self.mid).add(self.rad)
    }

    /// A lower bound on the absolute value; zero if the ball contains zero.
    pub fn mignitude(&self) -> Mag {
        Mag::below(&self.mid).sub_below(self.rad)
    }

    /// Returns true if zero may be the value.
    pub fn contains_zero(&self) -> bool {
        !self.is_off_zero()
    }

    /// Certainly greater than zero.
    pub fn is_positive(&self) -> bool {
        self.mid.is_sign_positive() && self.is_off_zero()
    }

    /// Certainly less than zero.
    pub fn is_negative(&self) -> bool {
        self.mid.is_sign_negative() && self.is_off_zero()
    }

    /// Returns true if `|mid| > rad`.
    fn is_off_zero(&self) -> bool {
        // A bound has 53 bits: |mid| rounded up to as many is above it where |mid| is, and only
        // there.
        Mag::above(&self.mid) > self.rad
    }

    /// Certainly zero.
    pub fn is_zero(&self) -> bool {
        self.rad.is_zero() && self.mid.is_zero()
    }

    /// The lower end, rounded down.
    pub fn lower(&self) -> Float {
        let mut x = self.mid.clone();
        x.add_assign_round(-self.rad.to_float(), Round::Down);
        x
    }

    /// The upper end, rounded up.
    pub fn upper(&self) -> Float {
        let mut x = self.mid.clone();
        x.add_assign_round(self.rad.to_float(), Round::Up);
        x
    }

    /// The smallest ball at `prec` bits that holds `[lo, hi]`.
    pub fn between(prec: u32, lo: &Float, hi: &Float) -> Ball {
        let mid = Float::with_val(prec, lo + hi) >> 1u32;
        let up = Float::with_val_round(BITS, hi - &mid, Round::Up).0;
        let down = Float::with_val_round(BITS, &mid - lo, Round::Up).0;
        let rad = Mag::above(&up).max(Mag::above(&down));
        Ball::new(mid, rad)
    }

    /// The smallest ball that holds both.
    pub fn union(&self, other: &Ball) -> Ball {
        let low = lesser(self.lower(), other.lower());
        let high = greater(self.upper(), other.upper());
        Ball::between(self.prec().max(other.prec()), &low, &high)
    }

    /// Returns true if the exact number `x` lies in the ball.
    pub fn contains(&self, x: &Rational) -> bool {
        if !self.is_finite() {
            return true;
        }
        let mid = self.mid.to_rational().expect("finite midpoint");
        let rad = self.rad.to_float().to_rational().expect("finite radius");
        (x - mid).abs() <= rad
    }

    /// Returns true if every point of `other` lies in the ball.
    pub fn contains_ball(&self, other: &Ball) -> bool {
        !self.is_finite() || self.exactly(other).is_some_and(|[gap, r, s]| gap + s <= r)
    }

    /// Returns true if the two balls share a point.
    pub fn overlaps(&self, other: &Ball) -> bool {
        self.exactly(other).is_none_or(|[gap, r, s]| gap <= r + s)
    }

    /// The distance of the midpoints and the two radii; none unless both balls are bounded.
    fn exactly(&self, other: &Ball) -> Option<[Rational; 3]> {
        let [r, s] = [self.rad, other.rad].map(|rad| rad.to_float().to_rational());
        let gap = self.mid.to_rational()? - other.mid.to_rational()?;
        Some([gap.abs(), r?, s?])
    }

    /// Bits of relative accuracy: `log2(|mid| / rad)`, rounded down. An exact ball has as many as
    /// anybody asks for.
    pub fn accuracy_bits(&self) -> i64 {
        if self.rad.is_zero() {
            return i64::MAX;
        }
        match (self.mid.get_exp(), self.rad.exponent()) {
            (Some(m), Some(r)) => i64::from(m) - 1 - (r + 1),
            _ => i64::MIN,
        }
    }

    /// `√x`: `|√x − √m| ≤ r/√m`, for balls without negative numbers. A ball that reaches below
    /// zero gives the whole line.
    pub fn sqrt(&self) -> Ball {
        if self.is_zero() {
            return self.clone();
        }
        if !self.is_finite() || self.lower() < 0 || self.mid.is_zero() {
            return Ball::new(self.mid.clone(), Mag::INFINITY);
        }
        let root = Float::with_val_round(self.prec(), self.mid.sqrt_ref(), Round::Nearest);
        // A lower bound on the exact root of the midpoint: one step below the rounded one.
        let mut low = root.0.clone();
        low.next_down();
        let propagated = self.rad.div(Mag::below(&low));
        Ball::rounded(root, propagated)
    }

    /// `(sin x, cos x)`; both are 1-Lipschitz and bounded by one, so the propagated radius is
    /// `min(r, 2)`.
    pub fn sin_cos(&self) -> (Ball, Ball) {
        let p = self.prec();
        let propagated = self.rad.min(Mag::from_f64(2.0));
        let [sine, cosine] = nearest::sin_cos(&self.mid, p).map(|x| Ball::rounded(x, propagated));
        (sine, cosine)
    }

    /// The angle of the point `(x, y)`, `self` being `y`, in `(−π, π]`, continued beyond ±π where
    /// the box crosses the negative x-axis.
    ///
    /// If the box stays off the origin, the angle turns by at most `asin(ρ/|z|) ≤ (π/2) ρ/|z|`
    /// over it, with ρ the half-diagonal of the box.
    pub fn atan2(&self, x: &Ball) -> Ball {
        let p = self.prec().max(x.prec());
        let rho = self.rad.mul(self.rad).add(x.rad.mul(x.rad)).sqrt();
        let mid = nearest::atan2(&self.mid, &x.mid, p);
        // |z| ≥ max(|x|, |y|) is enough for a bound.
        let away = Mag::below(&self.mid).max(Mag::below(&x.mid));
        if !(rho < away) {
            return Ball::new(mid.0, Mag::INFINITY);
        }
        let propagated = Mag::from_f64(1.5707963267948968).mul(rho).div(away);
        Ball::rounded(mid, propagated)
    }

    /// `x²`, never negative at its midpoint; radius `2|m| r + r²`.
    pub fn square(&self) -> Ball {
        let m = Mag::above(&self.mid);
        let propagated = m.shift(1).mul(self.rad).add(self.rad.mul(self.rad));
        Ball::nearest(self.prec(), self.mid.square_ref(), propagated)
    }

    /// `|x|`.
    pub fn abs(&self) -> Ball {
        Ball::new(self.mid.clone().abs(), self.rad)
    }

    /// `x · 2^k`; exact.
    pub fn shift(&self, k: i32) -> Ball {
        Ball::new(self.mid.clone() << k, self.rad.shift(i64::from(k)))
    }

    /// The multiplicative inverse.
    pub fn recip(&self) -> Ball {
        &Ball::integer(self.prec(), 1) / self
    }
}

pub(crate) fn lesser(a: Float, b: Float) -> Float {
    if a < b { a } else { b }
}

pub(crate) fn greater(a: Float, b: Float) -> Float {
    if a > b { a } else { b }
}

/// Sum of products, `Σ a_i b_i`.
pub fn dot<'a>(prec: u32, terms: impl IntoIterator<Item = (&'a Ball, &'a Ball)>) -> Ball {
    let mut sum = Ball::integer(prec, 0);
    for (a, b) in terms {
        sum = &sum + &(a * b);
    }
    sum
}

fn add(a: &Ball, b: &Ball) -> Ball {
    let p = a.prec().max(b.prec());
    Ball::nearest(p, &a.mid + &b.mid, a.rad.add(b.rad))
}

fn sub(a: &Ball, b: &Ball) -> Ball {
    let p = a.prec().max(b.prec());
    Ball::nearest(p, &a.mid - &b.mid, a.rad.add(b.rad))
}

/// Radius `|a| r_b + |b| r_a + r_a r_b`.
fn mul(a: &Ball, b: &Ball) -> Ball {
    let p = a.prec().max(b.prec());
    let propagated = if a.rad.is_zero() && b.rad.is_zero() {
        Mag::ZERO
    } else {
        let (x, y) = (Mag::above(&a.mid), Mag::above(&b.mid));
        x.add(a.rad).mul(b.rad).add(y.mul(a.rad))
    };
    Ball::nearest(p, &a.mid * &b.mid, propagated)
}

/// Radius `(|a| r_b + |b| r_a) / (|b| (|b| − r_b))`; the whole line if the divisor may be zero.
fn div(a: &Ball, b: &Ball) -> Ball {
    let p = a.prec().max(b.prec());
    let low = Mag::below(&b.mid);
    let reach = b.mignitude();
    if reach.is_zero() {
        return Ball::new(Float::new(p), Mag::INFINITY);
    }
    let propagated = if a.rad.is_zero() && b.rad.is_zero() {
        Mag::ZERO
    } else {
        // a r_b / (b (b − r_b)) + r_a / (b − r_b)
        let (x, r) = (Mag::above(&a.mid), b.rad);
        x.mul(r).div(low).add(a.rad).div(reach)
    };
    Ball::nearest(p, &a.mid / &b.mid, propagated)
}

macro_rules! operator {
    ($trait:ident, $method:ident) => {
        impl<B: Borrow<Ball>> $trait<B> for &Ball {
            type Output = Ball;
            fn $method(self, other: B) -> Ball {
                $method(self, other.borrow())
            }
        }
        impl<B: Borrow<Ball>> $trait<B> for Ball {
            type Output = Ball;
            fn $method(self, other: B) -> Ball {
                $method(&self, other.borrow())
            }
        }
    };
}
operator!(Add, add);
operator!(Sub, sub);
operator!(Mul, mul);
operator!(Div, div);

impl Neg for &Ball {
    type Output = Ball;
    fn neg(self) -> Ball {
        -self.clone()
    }
}

impl Neg for Ball {
    type Output = Ball;
    fn neg(mut self) -> Ball {
        self.mid.neg_assign();
        self
    }
}

mod distance;

pub use distance::Apart;

#[cfg(test)]
mod tests;
