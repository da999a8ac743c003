//! The numbers in which loop equations are evaluated.

use crate::{Ball, Mag};
use rug::{Float, float};

/// Balls for the mechanism as it is, `MidRad` where a bound needs no digits, complex discs for its
/// continuation over a disc of drive coordinates. All enclose: an operation's result holds the
/// exact result for all numbers that the operands hold. Plain `f64` do not, and serve to find what
/// is proved by the others.
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
    /// Product with an exact number.
    fn by_f64(&self, k: f64) -> Self {
        self.by(&Ball::exact(64, k))
    }
    /// Cosine and sine.
    fn cos_sin(&self) -> (Self, Self);
    /// `1/√q` by the branch that is positive on the positive real line; unbounded unless that is
    /// analytic on all that the operand holds.
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

impl Scalar for f64 {
    fn real(b: &Ball) -> f64 {
        b.mid().to_f64()
    }
    fn plus(&self, other: &f64) -> f64 {
        self + other
    }
    fn minus(&self, other: &f64) -> f64 {
        self - other
    }
    fn times(&self, other: &f64) -> f64 {
        self * other
    }
    fn by(&self, k: &Ball) -> f64 {
        self * k.mid().to_f64()
    }
    fn cos_sin(&self) -> (f64, f64) {
        let (s, c) = self.sin_cos();
        (c, s)
    }
    fn over_root(&self) -> f64 {
        self.sqrt().recip()
    }
    fn size(&self) -> Mag {
        Mag::from_f64(*self)
    }
}

/// All complex numbers within a radius of a real midpoint.
///
/// The radii of a ball's sums, products, quotients and roots bound complex numbers as well: they
/// are built from absolute values alone, and for `r ≤ m` the root of `|x − m| ≤ r` has no negative
/// real part. Cosine and sine grow off the real line and have a bound of their own.
#[derive(Clone, Debug)]
pub(super) struct Round(pub Ball);

impl Scalar for Round {
    fn real(b: &Ball) -> Round {
        Round(b.clone())
    }
    fn plus(&self, other: &Round) -> Round {
        Round(&self.0 + &other.0)
    }
    fn minus(&self, other: &Round) -> Round {
        Round(&self.0 - &other.0)
    }
    fn times(&self, other: &Round) -> Round {
        Round(&self.0 * &other.0)
    }
    fn by(&self, k: &Ball) -> Round {
        Round(&self.0 * k)
    }
    /// `|cos(m + δ) − cos m| ≤ |sin m| sinh r + |cos m| (cosh r − 1)` for `|δ| ≤ r`, and likewise
    /// the sine.
    fn cos_sin(&self) -> (Round, Round) {
        let (s, c) = Ball::new(self.0.mid().clone(), Mag::ZERO).sin_cos();
        let r = self.0.rad();
        if !r.is_finite() {
            return (Round(c.widened(r)), Round(s.widened(r)));
        }
        let up = |x: Float| Mag::above(&x);
        let sinh = up(Float::with_val_round(53, r.to_float().sinh_ref(), float::Round::Up).0);
        // cosh r − 1 = 2 sinh²(r/2).
        let half =
            up(Float::with_val_round(53, r.shift(-1).to_float().sinh_ref(), float::Round::Up).0);
        let rest = half.mul(half).shift(1);
        let spread = |along: &Ball, across: &Ball| {
            let first = across.magnitude().mul(sinh);
            first.add(along.magnitude().mul(rest))
        };
        let (dc, ds) = (spread(&c, &s), spread(&s, &c));
        (Round(c.widened(dc)), Round(s.widened(ds)))
    }
    fn over_root(&self) -> Round {
        Round(self.0.sqrt().recip())
    }
    fn size(&self) -> Mag {
        self.0.magnitude()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draw::Draw;

    /// Points on the circle, by addition theorems in 200 bits, against the disc's cosine, sine and
    /// inverse root.
    #[test]
    fn functions_of_a_disc() {
        let r = 0.4;
        let mut far = [0.0f64; 3];
        // At π/2 the cosine takes the whole of its bound.
        for m in [0.7, std::f64::consts::FRAC_PI_2] {
            let disc = Round(Ball::exact(64, m).widened(Mag::from_f64(r)));
            let (cosine, sine) = disc.cos_sin();
            let root = disc.over_root();
            let whole = |x: f64| Float::with_val(200, x);
            for i in 0..64 {
                let angle: Float = whole(f64::from(i)) * std::f64::consts::PI / 32;
                let (y, x) = angle.sin_cos(whole(0.0));
                let (x, y): (Float, Float) = (x * r + m, y * r);
                let (up, down) = (y.clone().exp(), (-y.clone()).exp());
                let cosh: Float = whole(0.0) + (up.clone() + &down) / 2;
                let sinh: Float = (up - down) / 2;
                let (s, c) = x.clone().sin_cos(whole(0.0));
                // 1/√z by modulus and argument.
                let modulus: Float = x.clone().hypot(&y).sqrt().recip();
                let half: Float = y.clone().atan2(&x) / -2;
                let values: [[Float; 2]; 3] = [
                    [whole(0.0) + &c * &cosh, whole(0.0) - &s * &sinh],
                    [whole(0.0) + &s * &cosh, whole(0.0) + &c * &sinh],
                    [half.clone().cos() * &modulus, half.sin() * &modulus],
                ];
                for (k, (ball, [re, im])) in
                    [&cosine, &sine, &root].into_iter().zip(values).enumerate()
                {
                    let way: Float = (re - ball.0.mid()).hypot(&im);
                    let share = (way / ball.0.rad().to_float()).to_f64();
                    assert!(share <= 1.0, "{k} {i} {share}");
                    far[k] = far[k].max(share);
                }
            }
        }
        assert!(far[0] > 0.8 && far[1] > 0.8 && far[2] > 0.3, "{far:?}");
    }

    fn disc(mid: f64, rad: f64) -> Round {
        Round(Ball::exact(64, mid).widened(Mag::from_f64(rad)))
    }

    /// Sums, products and sizes of discs reach as far as the farthest points do, and no farther.
    #[test]
    fn arithmetic_of_discs() {
        let (a, b) = (disc(2.0, 0.5), disc(-3.0, 1.0));
        let half = Ball::exact(64, -0.5).widened(Mag::from_f64(0.25));
        for (found, mid, rad) in [
            (a.plus(&b), -1.0, 1.5),
            (a.minus(&b), 5.0, 1.5),
            (a.times(&b), -6.0, 4.0),
            (a.by(&half), -1.0, 0.875),
            (b.by_f64(-1.5), 4.5, 1.5),
        ] {
            assert_eq!(found.0.mid().to_f64(), mid);
            let wide = found.0.rad().to_f64();
            assert!(wide >= rad && wide < rad * 1.000_001, "{mid} {wide}");
            let size = found.size().to_f64();
            let due = mid.abs() + rad;
            assert!(size >= due && size < due * 1.000_001, "{mid} {size}");
        }
    }

    /// About zero a sine goes as far as `sinh r` and a cosine as `cosh r − 1`; elsewhere no less
    /// than either part.
    #[test]
    fn cosines_of_discs_are_as_wide_as_they_have_to_be() {
        let mut draw = Draw(1);
        let mut unit = || (draw.next() >> 11) as f64 / 2f64.powi(53);
        for i in 0..2000 {
            let r = 4.0 * unit() * 2f64.powi(-(i % 40));
            let up = Float::with_val(300, r).exp();
            let down = up.clone().recip();
            let sinh = (up.clone() - &down) / 2u32;
            let rest = (up + down) / 2u32 - 1u32;
            let [c, s] = {
                let (c, s) = disc(0.0, r).cos_sin();
                [c, s].map(|x| x.0.rad().to_float())
            };
            assert!(c >= rest && s >= sinh, "{r}");
            assert!(
                c < rest.clone() * 1.000_001f64 + 1e-18f64
                    && s < sinh.clone() * 1.000_001f64 + 1e-18f64
            );
            let m = 6.0 * unit() - 3.0;
            let (c, s) = disc(m, r).cos_sin();
            let (sine, cosine) = Float::with_val(300, m).sin_cos(Float::new(300));
            let [sine, cosine] = [sine.abs(), cosine.abs()];
            let due = [
                sine.clone() * &sinh + cosine.clone() * &rest,
                cosine * &sinh + sine * &rest,
            ];
            for (found, due) in [c, s].iter().zip(due) {
                assert!(found.0.rad().to_float() >= due, "{m} {r}");
            }
        }
    }

    #[test]
    fn what_has_no_bound_has_no_cosine() {
        for m in [0.0, 1.0] {
            let whole = Round(Ball::new(Float::with_val(64, m), Mag::INFINITY));
            let (c, s) = whole.cos_sin();
            assert!(!c.size().is_finite() && !s.size().is_finite());
        }
    }

    /// Plain numbers follow the same rules.
    #[test]
    fn plain_numbers() {
        assert_eq!(Scalar::over_root(&6.25f64), 0.4);
        assert_eq!(Scalar::size(&-3.0f64), Mag::from_f64(3.0));
        assert_eq!(Scalar::cos_sin(&0.0f64), (1.0, 0.0));
    }
}
