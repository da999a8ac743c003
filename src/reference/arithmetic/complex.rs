//! Complex balls: a rectangle of two real balls. Also vectors of the plane.

use super::ball::Ball;
use std::ops::{Add, Mul, Neg, Sub};

/// A complex number, or a vector of the plane, each component a ball.
#[derive(Clone, Debug)]
pub struct ComplexBall {
    /// Real part, or x.
    pub re: Ball,
    /// Imaginary part, or y.
    pub im: Ball,
}

impl ComplexBall {
    /// From its parts.
    pub fn new(re: Ball, im: Ball) -> ComplexBall {
        ComplexBall { re, im }
    }

    /// Zero at some precision.
    pub fn zero(prec: u32) -> ComplexBall {
        ComplexBall::new(Ball::integer(prec, 0), Ball::integer(prec, 0))
    }

    /// `e^{iφ} = (cos φ, sin φ)`.
    pub fn unit(phi: &Ball) -> ComplexBall {
        let (s, c) = phi.sin_cos();
        ComplexBall::new(c, s)
    }

    /// The conjugate.
    pub fn conj(&self) -> ComplexBall {
        ComplexBall::new(self.re.clone(), -&self.im)
    }

    /// `i z`: the vector turned by a right angle.
    pub fn turned(&self) -> ComplexBall {
        ComplexBall::new(-&self.im, self.re.clone())
    }

    /// `Re(z̄ w)`: the scalar product.
    pub fn dot(&self, w: &ComplexBall) -> Ball {
        &self.re * &w.re + &self.im * &w.im
    }

    /// `Im(z̄ w)`: the cross product.
    pub fn cross(&self, w: &ComplexBall) -> Ball {
        &self.re * &w.im - &self.im * &w.re
    }

    /// `|z|²`.
    pub fn norm_sqr(&self) -> Ball {
        self.re.square() + self.im.square()
    }

    /// `r z` for a real r.
    pub fn scaled(&self, r: &Ball) -> ComplexBall {
        ComplexBall::new(&self.re * r, &self.im * r)
    }

    /// The argument, as [`Ball::atan2`].
    pub fn arg(&self) -> Ball {
        self.im.atan2(&self.re)
    }
}

impl Add for &ComplexBall {
    type Output = ComplexBall;
    fn add(self, w: &ComplexBall) -> ComplexBall {
        ComplexBall::new(&self.re + &w.re, &self.im + &w.im)
    }
}

impl Sub for &ComplexBall {
    type Output = ComplexBall;
    fn sub(self, w: &ComplexBall) -> ComplexBall {
        ComplexBall::new(&self.re - &w.re, &self.im - &w.im)
    }
}

impl Mul for &ComplexBall {
    type Output = ComplexBall;
    fn mul(self, w: &ComplexBall) -> ComplexBall {
        ComplexBall::new(
            &self.re * &w.re - &self.im * &w.im,
            &self.re * &w.im + &self.im * &w.re,
        )
    }
}

impl Neg for &ComplexBall {
    type Output = ComplexBall;
    fn neg(self) -> ComplexBall {
        ComplexBall::new(-&self.re, -&self.im)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rug::Rational;

    #[test]
    fn exact_products() {
        let z = |a, b| ComplexBall::new(Ball::integer(64, a), Ball::integer(64, b));
        let w = &z(1, 2) * &z(3, 4);
        let holds = |b: &Ball, n: i64| b.contains(&Rational::from(n)) && b.rad().is_zero();
        assert!(holds(&w.re, -5) && holds(&w.im, 10));
        let (sum, difference) = (&z(1, 2) + &z(3, 5), &z(1, 2) - &z(3, 5));
        assert!(holds(&sum.re, 4) && holds(&sum.im, 7));
        assert!(holds(&difference.re, -2) && holds(&difference.im, -3));
        assert!(ComplexBall::zero(64).re.is_zero() && ComplexBall::zero(64).im.is_zero());
        assert!(holds(&z(1, 2).dot(&z(3, 4)), 11));
        assert!(holds(&z(1, 2).cross(&z(3, 4)), -2));
        assert!(holds(&z(3, 4).norm_sqr(), 25));
        assert!(holds(&z(1, 2).turned().re, -2));
        let unit = ComplexBall::unit(&Ball::pi(100));
        assert!(unit.re.contains(&Rational::from(-1)) && unit.im.contains(&Rational::from(0)));
    }
}
