//! The numbers in which loop equations are evaluated.

use crate::{Ball, ComplexBall, Mag};

/// Balls for the mechanism as it is, complex balls for its continuation over a disc of drive coordinates. Both
/// enclose: an operation's result holds the exact result for all numbers that the operands hold.
pub(super) trait Scalar: Clone {
    /// A real number.
    fn real(b: &Ball) -> Self;
    /// Sum.
    fn plus(&self, other: &Self) -> Self;
    /// Difference.
    fn minus(&self, other: &Self) -> Self;
    /// Product.
    fn times(&self, other: &Self) -> Self;
    /// Product with a real number.
    fn by(&self, k: &Ball) -> Self;
    /// Cosine and sine.
    fn cos_sin(&self) -> (Self, Self);
    /// `1/√q` by the branch that is positive on the positive real line; unbounded unless that is analytic on all that
    /// the operand holds.
    fn over_root(&self) -> Self;
    /// An upper bound on the absolute value.
    fn size(&self) -> Mag;
}

impl Scalar for Ball {
    fn real(b: &Ball) -> Ball {
        b.clone()
    }
    fn plus(&self, other: &Ball) -> Ball {
        self + other
    }
    fn minus(&self, other: &Ball) -> Ball {
        self - other
    }
    fn times(&self, other: &Ball) -> Ball {
        self * other
    }
    fn by(&self, k: &Ball) -> Ball {
        self * k
    }
    fn cos_sin(&self) -> (Ball, Ball) {
        let (s, c) = self.sin_cos();
        (c, s)
    }
    fn over_root(&self) -> Ball {
        self.sqrt().recip()
    }
    fn size(&self) -> Mag {
        self.magnitude()
    }
}

impl Scalar for ComplexBall {
    fn real(b: &Ball) -> ComplexBall {
        ComplexBall::new(b.clone(), Ball::integer(b.prec(), 0))
    }
    fn plus(&self, other: &ComplexBall) -> ComplexBall {
        self + other
    }
    fn minus(&self, other: &ComplexBall) -> ComplexBall {
        self - other
    }
    fn times(&self, other: &ComplexBall) -> ComplexBall {
        self * other
    }
    fn by(&self, k: &Ball) -> ComplexBall {
        self.scaled(k)
    }
    /// `cos(x + iy) = cos x cosh y − i sin x sinh y`, `sin(x + iy) = sin x cosh y + i cos x sinh y`.
    fn cos_sin(&self) -> (ComplexBall, ComplexBall) {
        let (s, c) = self.re.sin_cos();
        let (up, down) = (self.im.exp(), (-&self.im).exp());
        let (cosh, sinh) = ((&up + &down).shift(-1), (&up - &down).shift(-1));
        (
            ComplexBall::new(&c * &cosh, -(&s * &sinh)),
            ComplexBall::new(&s * &cosh, &c * &sinh),
        )
    }
    /// With a real q0 > 0 and `|q − q0| ≤ s < q0` the root has a positive real part, so that
    /// `|√q − √q0| ≤ s/√q0` and `|1/√q − 1/√q0| ≤ s/(q0 √(q0 − s))`.
    fn over_root(&self) -> ComplexBall {
        let q0 = Ball::new(self.re.mid().clone(), Mag::ZERO);
        let s = self.minus(&ComplexBall::real(&q0)).magnitude();
        let rest = q0.mignitude().sub_below(s);
        if !q0.is_positive() || rest.is_zero() {
            return self.widened(Mag::INFINITY);
        }
        // Below the root of a lower bound.
        let root = Ball::new(rest.to_float(), Mag::ZERO).sqrt().mignitude();
        let spread = s.div(q0.mignitude()).div(root);
        ComplexBall::real(&q0.sqrt().recip()).widened(spread)
    }
    fn size(&self) -> Mag {
        self.magnitude()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rug::Float;

    /// Against the same functions in 200 bits at points of a box.
    #[test]
    fn cosine_and_sine_of_a_box() {
        let centre = [0.7, -0.4];
        let radius = 0.25;
        let z = ComplexBall::new(
            Ball::exact(64, centre[0]).widened(Mag::from_f64(radius)),
            Ball::exact(64, centre[1]).widened(Mag::from_f64(radius)),
        );
        let (cosine, sine) = z.cos_sin();
        let (mut far, mut wide) = (0.0f64, 0.0f64);
        for i in -4..=4 {
            for k in -4..=4 {
                let at = |c: f64, i: i32| c + radius * f64::from(i) / 4.0;
                let (x, y) = (at(centre[0], i), at(centre[1], k));
                let (x, y) = (Float::with_val(200, x), Float::with_val(200, y));
                let (up, down) = (y.clone().exp(), (-y.clone()).exp());
                let (s, c) = x.sin_cos(Float::new(200));
                let half = |a: &Float, b: &Float| Float::with_val(200, a + b) / 2;
                let values: [Float; 4] = [
                    c.clone() * half(&up, &down),
                    -s.clone() * half(&up, &-down.clone()),
                    s * half(&up, &down),
                    c * half(&up, &-down),
                ];
                let balls = [&cosine.re, &cosine.im, &sine.re, &sine.im];
                for (ball, value) in balls.into_iter().zip(values) {
                    assert!(ball.contains(&value.to_rational().unwrap()));
                    let way = Float::with_val(64, ball.mid() - &value).abs().to_f64();
                    far = far.max(way / ball.rad().to_f64());
                    wide = wide.max(ball.rad().to_f64());
                }
            }
        }
        assert!(far > 0.5 && wide < 2.0 * radius, "{far} {wide}");
    }
}
