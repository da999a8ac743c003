//! The exponential of a ball, and complex balls' division.

use super::nearest;
use crate::{Ball, ComplexBall, Mag};
use rug::Float;
use rug::float::Round;

impl Ball {
    /// `e^x`. With midpoint m and radius r the propagated radius is `e^m (e^r − 1)`, because
    /// `|e^x − e^m| ≤ e^m (e^|x−m| − 1)`; for r ≤ 1/2 it is bounded by `e^m (r + r²)`
    /// (`e^r − 1 − r ≤ r²/2 · e^r`, and `e^{1/2} < 2`). Beyond MPFR's exponent range the result
    /// is the whole line.
    pub fn exp(&self) -> Ball {
        if !self.is_finite() {
            return self.clone();
        }
        let value = nearest::exp(self.mid(), self.prec());
        let r = self.rad();
        if r.is_zero() {
            return Ball::rounded(value, Mag::ZERO);
        }
        // An upper bound on e^m: one step above the rounded value.
        let mut high = value.0.clone();
        high.next_up();
        let spread = if r <= Mag::from_f64(0.5) {
            r.add(r.mul(r))
        } else {
            let grown = Float::with_val_round(53, r.to_float().exp_m1_ref(), Round::Up).0;
            Mag::above(&grown)
        };
        Ball::rounded(value, Mag::above(&high).mul(spread))
    }

    /// `ln x`. With midpoint m and radius r < m the propagated radius is at most `r/(m − r)` (mean
    /// value theorem). A ball that is not certainly positive gives the whole line.
    pub fn ln(&self) -> Ball {
        if !self.is_positive() {
            return Ball::new(self.mid().clone(), Mag::INFINITY);
        }
        let propagated = self.rad().div(self.mignitude());
        Ball::rounded(nearest::log(self.mid(), self.prec()), propagated)
    }
}

impl ComplexBall {
    /// The number as an exact pair of floats, each rounded to `prec` bits.
    pub fn rational(prec: u32, re: &rug::Rational, im: &rug::Rational) -> ComplexBall {
        ComplexBall::new(Ball::rational(prec, re), Ball::rational(prec, im))
    }

    /// `e^z = e^x (cos y + i sin y)`.
    pub fn exp(&self) -> ComplexBall {
        ComplexBall::unit(&self.im).scaled(&self.re.exp())
    }

    /// `z² = (x − y)(x + y) + 2xy i`.
    pub fn square(&self) -> ComplexBall {
        let re = (&self.re - &self.im) * (&self.re + &self.im);
        ComplexBall::new(re, (&self.re * &self.im).shift(1))
    }

    /// `z / w = z w̄ / |w|²`; the whole plane if w may be zero.
    pub fn div(&self, w: &ComplexBall) -> ComplexBall {
        let n = w.norm_sqr();
        let t = self * &w.conj();
        ComplexBall::new(&t.re / &n, &t.im / &n)
    }

    /// Both components enlarged by `extra`: a superset of all points within `extra` of the ball.
    pub fn widened(&self, extra: Mag) -> ComplexBall {
        ComplexBall::new(self.re.widened(extra), self.im.widened(extra))
    }

    /// An upper bound on `|z|`.
    pub fn magnitude(&self) -> Mag {
        let (x, y) = (self.re.magnitude(), self.im.magnitude());
        x.mul(x).add(y.mul(y)).sqrt()
    }

    /// A lower bound on `|z|`: that of the larger component.
    pub fn mignitude(&self) -> Mag {
        self.re.mignitude().max(self.im.mignitude())
    }

    /// An upper bound on the distance of any point from the midpoint.
    pub fn radius(&self) -> Mag {
        let (x, y) = (self.re.rad(), self.im.rad());
        x.mul(x).add(y.mul(y)).sqrt()
    }

    /// Returns true if both components bound anything.
    pub fn is_finite(&self) -> bool {
        self.re.is_finite() && self.im.is_finite()
    }

    /// Returns true if the two rectangles share a point.
    pub fn overlaps(&self, other: &ComplexBall) -> bool {
        self.re.overlaps(&other.re) && self.im.overlaps(&other.im)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const P: u32 = 60;
    const HIGH: u32 = 400;

    fn ball(reach: f64) -> impl Strategy<Value = (Ball, Float)> {
        (-reach..reach, 0u32..60, -1.0f64..1.0).prop_map(|(m, k, t)| {
            let rad = Mag::power_of_two(1 - i64::from(k));
            let point = Float::with_val(HIGH, t) * rad.to_float() + m;
            (Ball::new(Float::with_val(P, m), rad), point)
        })
    }

    fn holds(b: &Ball, x: &Float) -> bool {
        b.widened(Mag::power_of_two(-250))
            .contains(&x.to_rational().unwrap())
    }

    proptest! {
        #[test]
        fn containment((a, x) in ball(30.0), (b, y) in ball(30.0), (c, u) in ball(9.0), (d, v) in ball(9.0)) {
            prop_assert!(holds(&a.exp(), &Float::with_val(HIGH, x.exp_ref())));
            if a.is_positive() {
                prop_assert!(holds(&a.ln(), &Float::with_val(HIGH, x.ln_ref())));
            }
            let z = ComplexBall::new(a.clone(), b.clone());
            let w = ComplexBall::new(c, d);
            let square = z.square();
            prop_assert!(holds(&square.re, &(Float::with_val(HIGH, x.square_ref()) - Float::with_val(HIGH, y.square_ref()))));
            prop_assert!(holds(&square.im, &(Float::with_val(HIGH, &x * &y) * 2)));
            let e = z.exp();
            let grown = Float::with_val(HIGH, x.exp_ref());
            prop_assert!(holds(&e.re, &(Float::with_val(HIGH, y.cos_ref()) * &grown)));
            prop_assert!(holds(&e.im, &(Float::with_val(HIGH, y.sin_ref()) * &grown)));
            let q = z.div(&w);
            let n = Float::with_val(HIGH, u.square_ref()) + Float::with_val(HIGH, v.square_ref());
            let re = (Float::with_val(HIGH, &x * &u) + Float::with_val(HIGH, &y * &v)) / &n;
            let im = (Float::with_val(HIGH, &y * &u) - Float::with_val(HIGH, &x * &v)) / &n;
            prop_assert!(holds(&q.re, &re) && holds(&q.im, &im));
            let size = Float::with_val(HIGH, x.hypot_ref(&y)).to_rational().unwrap();
            prop_assert!(size <= z.magnitude().to_float().to_rational().unwrap());
            prop_assert!(size >= z.mignitude().to_float().to_rational().unwrap());
        }
    }

    #[test]
    fn what_cannot_be_decided_is_the_whole_line() {
        let wide = Ball::new(Float::with_val(P, 0.5), Mag::from_f64(1.0));
        assert!(!wide.ln().is_finite());
        assert!(!Ball::exact(P, 1e300).exp().is_finite());
        assert!(!Ball::exact(P, -1e300).exp().is_finite());
        assert!(Ball::integer(P, 0).exp().contains(&rug::Rational::from(1)));
    }
}
