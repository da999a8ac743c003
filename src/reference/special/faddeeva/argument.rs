//! Exactly known arguments, rounded to a ball on demand.

use crate::{Ball, Mag};
use rug::{Float, Rational};

/// Which function of the pair: both come from the same series.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Member {
    /// `w(z)`.
    W,
    /// `w(z) − e^{−z²} = (2i/√π) F(z)`, F Dawson's function; in the first quadrant only.
    Dawson,
}

/// A real number known exactly.
#[derive(Clone)]
pub(super) enum Real {
    Double(f64),
    Float(Float),
    Rational(Rational),
    /// `√q`, or `−√q` when the flag is set.
    Root(bool, Rational),
}

impl Real {
    /// A rational; a double where it is one, which is cheaper.
    pub fn of(q: &Rational) -> Real {
        let (n, d) = (q.numer(), q.denom());
        let places = d.significant_bits() - 1;
        if n.significant_bits() <= 53 && places <= 1000 && d.is_power_of_two() {
            // Both factors and their product are doubles: it is at least 2^-1000 unless zero.
            return Real::Double(n.to_f64() * 2f64.powi(-(places as i32)));
        }
        let x = q.to_f64();
        match x.is_finite() && *q == x {
            true => Real::Double(x),
            false => Real::Rational(q.clone()),
        }
    }

    /// A float; a double where it is a normal one.
    pub fn of_float(x: &Float) -> Real {
        let double = x.to_f64();
        if double.is_normal() && *x == double {
            Real::Double(double)
        } else {
            Real::Float(x.clone())
        }
    }

    /// A ball of relative radius 2^-prec or zero.
    pub fn ball(&self, prec: u32) -> Ball {
        match self {
            Real::Double(x) => Ball::new(Float::with_val(prec.max(53), x), Mag::ZERO),
            Real::Float(x) => Ball::new(Float::with_val(prec.max(x.prec()), x), Mag::ZERO),
            Real::Rational(q) => Ball::rational(prec, q),
            Real::Root(minus, q) => {
                let root = Ball::rational(prec + 2, q).sqrt();
                if *minus { -root } else { root }
            }
        }
    }

    pub fn is_zero(&self) -> bool {
        match self {
            Real::Double(x) => *x == 0.0,
            Real::Float(x) => x.is_zero(),
            Real::Rational(q) | Real::Root(_, q) => *q == 0,
        }
    }

    pub fn is_negative(&self) -> bool {
        match self {
            Real::Double(x) => *x < 0.0,
            Real::Float(x) => x.is_sign_negative() && !x.is_zero(),
            Real::Rational(q) => *q < 0,
            Real::Root(minus, q) => *minus && *q != 0,
        }
    }

    pub fn negated(&self) -> Real {
        match self {
            Real::Double(x) => Real::Double(-x),
            Real::Float(x) => Real::Float(-x.clone()),
            Real::Rational(q) => Real::Rational(Rational::from(-q)),
            Real::Root(minus, q) => Real::Root(!minus, q.clone()),
        }
    }

    /// Bits needed to write the number down.
    pub fn length(&self) -> u32 {
        match self {
            Real::Double(x) => {
                let exponent = (x.to_bits() >> 52 & 0x7ff) as i32 - 1023;
                64 + exponent.unsigned_abs()
            }
            Real::Float(x) => x.prec() + 32,
            Real::Rational(q) | Real::Root(_, q) => {
                q.numer().significant_bits() + q.denom().significant_bits()
            }
        }
    }
}

/// Bits needed to write both down.
pub(super) fn length(x: &Real, y: &Real) -> u32 {
    x.length().saturating_add(y.length())
}

/// A point of the plane with some bounds on its size.
pub(super) struct Argument {
    pub x: Real,
    pub y: Real,
    /// `|z|²`, 80 bits.
    pub norm: Ball,
}

impl Argument {
    pub fn new(x: Real, y: Real) -> Argument {
        let norm = x.ball(80).square() + y.ball(80).square();
        Argument { x, y, norm }
    }

    /// `|z|²` as a double, an upper bound (relative error below 10^-12; infinite when too large).
    pub fn norm_f64(&self) -> f64 {
        self.norm.mid().to_f64().next_up() * (1.0 + 1e-13)
    }

    /// `log2 |z|²`, error below 10^-9.
    pub fn norm_log2(&self) -> f64 {
        let (m, e) = self.norm.mid().to_f64_exp();
        m.log2() + f64::from(e)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn doubles_are_known_as_such() {
        let doubles = [
            0.0,
            1.0,
            -0.1,
            1.5,
            9007199254740993.0,
            1e300,
            -1e-300,
            5e-324,
            f64::MAX,
            3e-310,
            2e-302,
        ];
        for x in doubles {
            let q = Rational::from_f64(x).unwrap();
            assert!(matches!(Real::of(&q), Real::Double(y) if y == x), "{x:e}");
        }
        for q in [(1, 3), (i64::MAX, 1), (i64::MAX, 1_i64 << 62)] {
            assert!(
                matches!(Real::of(&Rational::from(q)), Real::Rational(_)),
                "{q:?}"
            );
        }
        let tiny = Rational::from_f64(5e-324).unwrap() / 2u32;
        assert!(matches!(Real::of(&tiny), Real::Rational(_)));
    }
}
