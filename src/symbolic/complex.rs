//! Functions of complex balls that the enclosures need.

use super::SymbolicError;
use mechaudit_reference::{Ball, ComplexBall, Mag};

/// Returns `a/b`; `None` if b may be zero.
pub(super) fn quotient(a: &ComplexBall, b: &ComplexBall) -> Option<ComplexBall> {
    b.norm_sqr().is_positive().then(|| a.div(b))
}

/// `√z`, the root with positive real part; of a negative number the one above the real axis.
pub(super) fn sqrt(z: &ComplexBall) -> Result<ComplexBall, SymbolicError> {
    let wide = || SymbolicError::Wide("a root".into());
    let zero = Ball::integer(z.re.prec(), 0);
    if z.im.is_zero() {
        return match () {
            () if z.re.is_zero() => Ok(ComplexBall::new(zero.clone(), zero)),
            () if z.re.is_positive() => Ok(ComplexBall::new(z.re.sqrt(), zero)),
            () if z.re.is_negative() => Ok(ComplexBall::new(zero, (-&z.re).sqrt())),
            () => Err(wide()),
        };
    }
    // (x + iy)² = z: x² = (|z| + re)/2, 2xy = im.
    let size = z.norm_sqr().sqrt();
    let half = (&size + &z.re).shift(-1);
    if z.re.is_positive() || (half.is_positive() && !z.im.contains_zero()) {
        let x = half.sqrt();
        let y = &z.im / &x.shift(1);
        return Ok(ComplexBall::new(x, y));
    }
    Err(wide())
}

/// Upper bound on `|z|`.
pub(super) fn size(z: &ComplexBall) -> f64 {
    z.magnitude().to_f64()
}

/// `G(z) = ∫_0^z e^{s²} ds = Σ z^{2k+1}/(k! (2k+1))`.
///
/// The tail after K terms is at most twice the size of its first term once `|z|² ≤ (K+1)/2`.
pub(super) fn antiderivative(z: &ComplexBall) -> Result<ComplexBall, SymbolicError> {
    let p = z.re.prec();
    let r = size(z);
    if !(r < 12.0) {
        return Err(SymbolicError::Wide("an integral of e^(s^2)".into()));
    }
    let square = z * z;
    let mut power = z.clone();
    let mut sum = ComplexBall::zero(p);
    let small = Mag::power_of_two(-i64::from(p));
    for k in 0_u32..5000 {
        let over = Ball::integer(p, i64::from(2 * k + 1)).recip();
        sum = &sum + &power.scaled(&over);
        let next = (&power * &square).scaled(&Ball::integer(p, i64::from(k + 1)).recip());
        power = next;
        let term = power.magnitude();
        if r * r <= f64::from(k + 2) / 2.0 && term < small {
            let tail = term.shift(1);
            return Ok(sum.widened(tail));
        }
    }
    Err(SymbolicError::Wide("an integral of e^(s^2)".into()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use rug::Rational;

    fn at(re: (i32, i32), im: (i32, i32)) -> ComplexBall {
        let q = |a: (i32, i32)| Ball::rational(128, &Rational::from(a));
        ComplexBall::new(q(re), q(im))
    }

    #[test]
    fn sizes_are_upper_bounds_however_small() {
        let tiny = Ball::exact(64, 1e-200);
        let r = size(&ComplexBall::new(tiny.clone(), tiny));
        assert!((1.414e-200..1.415e-200).contains(&r), "{r:e}");
    }

    #[test]
    fn roots() {
        for z in [
            at((3, 2), (-2, 7)),
            at((-3, 2), (1, 7)),
            at((2, 1), (0, 1)),
            at((-2, 1), (0, 1)),
        ] {
            let root = sqrt(&z).unwrap();
            let square = &root * &root;
            assert!(square.re.overlaps(&z.re) && square.im.overlaps(&z.im));
            assert!(root.re.to_f64() >= 0.0 && root.re.rad().to_f64() < 1e-30);
        }
        let around = ComplexBall::new(
            Ball::integer(64, 0).widened(Mag::from_f64(0.5)),
            Ball::integer(64, 0),
        );
        assert!(sqrt(&around).is_err());
    }

    fn rational(z: &ComplexBall, due: (Rational, Rational)) -> bool {
        z.re.contains(&due.0) && z.im.contains(&due.1)
    }

    /// `z + z³/3 + z⁵/10 + z⁷/42` for `z = q i^turns`.
    fn few_terms(q: &Rational, turns: u32) -> (Rational, Rational) {
        let power = |k: u32, over: u32| (0..k).fold(Rational::from((1, over)), |p, _| p * q);
        let (odd, even) = (power(1, 1) + power(5, 10), power(3, 3) + power(7, 42));
        match turns {
            0 => (odd + even, Rational::new()),
            _ => (Rational::new(), odd - even),
        }
    }

    /// Checks what the sum leaves out is above its rounding here, in either part.
    #[test]
    fn the_tail_of_the_antiderivative() {
        for turns in [0, 1] {
            for k in [11, 16, 22, 24] {
                let q = Rational::from((1, 1_i64 << k));
                let (axis, zero) = (Ball::rational(64, &q), Ball::integer(64, 0));
                let z = match turns {
                    0 => ComplexBall::new(axis, zero),
                    _ => ComplexBall::new(zero, axis),
                };
                let found = antiderivative(&z).unwrap();
                let due = few_terms(&q, turns);
                assert!(rational(&found, due), "{turns} {k}: {found:?}");
                assert!(found.radius().to_f64() < 1e-18);
            }
        }
        // A ball about zero, in which the powers may vanish.
        let wide = Ball::integer(64, 0).widened(Mag::from_f64(0.5));
        let found = antiderivative(&ComplexBall::new(wide.clone(), wide)).unwrap();
        let half = Rational::from((1, 2));
        for turns in [0, 1] {
            // Within 10⁻⁴ of the value, and less than it.
            let (re, im) = few_terms(&half, turns);
            assert!(found.re.contains(&re) && found.im.contains(&im));
            assert!(found.re.contains(&(-re)) && found.im.contains(&(-im)));
        }
        assert!(found.radius().to_f64() < 2.0);
    }

    /// Up to a modulus of twelve, against `G(x) = e^{x²} F(x)` with Dawson's integral F.
    #[test]
    fn the_antiderivative_far_out() {
        for x in [8, 10, 11] {
            let found = antiderivative(&at((x, 1), (0, 1))).unwrap();
            // F(x) ~ Σ (2k−1)!!/(2x²)^k/(2x); twenty terms leave less than 10⁻¹².
            let square = Rational::from(2 * x * x);
            let mut term = Rational::from((1, 2 * x));
            let mut sum = Rational::new();
            for k in 0..20 {
                sum += &term;
                term *= Rational::from(2 * k + 1) / &square;
            }
            let damped = &Ball::integer(128, i64::from(-x * x)).exp() * &found.re;
            let off = (&damped - &Ball::rational(128, &sum)).magnitude().to_f64();
            assert!(off < 1e-10, "{x}: {off:e}");
        }
        for (re, im) in [((13, 1), (0, 1)), ((9, 1), (-9, 1)), ((0, 1), (12, 1))] {
            let found = antiderivative(&at(re, im)).unwrap_err();
            let due = "an enclosure is too wide for an integral of e^(s^2)";
            assert_eq!(found.to_string(), due);
        }
    }

    /// A number that may lie on either side of the cut, or at its end, has no root.
    #[test]
    fn roots_at_the_cut() {
        let zero = sqrt(&at((0, 1), (0, 1))).unwrap();
        assert!(zero.re.is_zero() && zero.im.is_zero());
        let ball = |mid: (i32, i32), rad: f64| {
            Ball::rational(64, &Rational::from(mid)).widened(Mag::from_f64(rad))
        };
        // Right of zero, whatever the sign of the imaginary part.
        let right = sqrt(&ComplexBall::new(ball((4, 1), 0.0), ball((0, 1), 0.25))).unwrap();
        assert!(right.re.contains(&2.into()) && right.im.contains_zero());
        assert!(right.re.is_positive() && right.radius().to_f64() < 0.2);
        // Beside the imaginary axis, off the real one.
        let beside = sqrt(&ComplexBall::new(ball((0, 1), 0.25), ball((2, 1), 0.0))).unwrap();
        assert!(beside.re.contains(&1.into()) && beside.im.contains(&1.into()));
        for (re, im) in [
            (ball((-1, 1), 0.0), ball((0, 1), 0.25)),
            (ball((-2, 1), 1.0), ball((3, 20), 0.05)),
            (ball((0, 1), 0.5), ball((0, 1), 0.5)),
            (ball((1, 4), 0.5), ball((0, 1), 0.5)),
        ] {
            let found = sqrt(&ComplexBall::new(re, im)).unwrap_err();
            assert_eq!(found.to_string(), "an enclosure is too wide for a root");
        }
    }
}
