//! Functions of complex balls that the enclosures need.

use super::SymbolicError;
use mechaudit_reference::{Ball, ComplexBall, Mag};
use rug::Float;
use rug::float::Round;

/// `e^x`: `|e^x − e^m| ≤ e^m r e^r`.
pub(super) fn exp_real(x: &Ball) -> Ball {
    let p = x.prec();
    let mid = Float::with_val_round(p, x.mid().exp_ref(), Round::Nearest).0;
    if !mid.is_finite() || !x.is_finite() {
        return Ball::new(Float::new(p), Mag::INFINITY);
    }
    // One unit in the last place is more than the rounding; if the result vanishes, so is this.
    let exponent = mid.get_exp().unwrap_or(i32::MIN / 2);
    let rounding = Mag::power_of_two(i64::from(exponent) - i64::from(p));
    let mut rad = rounding;
    if !x.rad().is_zero() {
        let r = x.rad().to_float();
        let growth = Float::with_val_round(53, r.exp_ref(), Round::Up).0;
        let size = Mag::above(&mid).add(rounding);
        rad = rad.add(size.mul(x.rad()).mul(Mag::above(&growth)));
    }
    Ball::new(mid, rad)
}

/// `e^z`.
pub(super) fn exp(z: &ComplexBall) -> ComplexBall {
    ComplexBall::unit(&z.im).scaled(&exp_real(&z.re))
}

/// `a/b`; `None` if b may be zero.
pub(super) fn quotient(a: &ComplexBall, b: &ComplexBall) -> Option<ComplexBall> {
    let norm = b.norm_sqr();
    norm.is_positive()
        .then(|| (a * &b.conj()).scaled(&norm.recip()))
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
            return Ok(ComplexBall::new(sum.re.widened(tail), sum.im.widened(tail)));
        }
    }
    Err(SymbolicError::Wide("an integral of e^(s^2)".into()))
}

/// `W(z)`.
pub(super) fn w(z: &ComplexBall) -> Result<ComplexBall, SymbolicError> {
    let p = z.re.prec();
    let factor = &Ball::integer(p, 2) / &Ball::pi(p).sqrt();
    let inner = antiderivative(z)?.scaled(&factor).turned();
    let one = ComplexBall::new(Ball::integer(p, 1), Ball::integer(p, 0));
    Ok(&exp(&-&(z * z)) * &(&one + &inner))
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
    fn exponentials() {
        let e = exp_real(&Ball::integer(128, 1));
        let digits: Rational =
            Rational::from((2_718_281_828_459_045_i64, 1_000_000_000_000_000_i64));
        let gap = &e - &Ball::rational(128, &digits);
        assert!(gap.is_positive() && gap.magnitude().to_f64() < 3e-16);
        // e^{a+b} = e^a e^b, also for wide balls.
        let wide = Ball::integer(128, 2).widened(Mag::from_f64(0.25));
        assert!(
            exp_real(&wide)
                .contains_ball(&(exp_real(&Ball::rational(128, &Rational::from((9, 4))))))
        );
        assert!(
            exp_real(&wide)
                .contains_ball(&(exp_real(&Ball::rational(128, &Rational::from((7, 4))))))
        );
        let product = &exp(&at((1, 3), (2, 5))) * &exp(&at((-1, 3), (-2, 5)));
        assert!(
            (&product.re - &Ball::integer(128, 1)).contains_zero() && product.im.contains_zero()
        );
        assert!(!exp_real(&Ball::exact(64, 1e300)).is_finite());
        assert!(exp_real(&Ball::exact(64, -1e300)).magnitude().to_f64() < 1e-100);
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

    #[test]
    fn the_probability_integral() {
        // Computed with another library (scipy.special.wofz).
        for (re, im, x, y) in [
            ((2, 5), (1, 1), 0.40381810194892653, 0.10438045886960581),
            ((6, 5), (1, 5), 0.2709276879663836, 0.4694884732147171),
        ] {
            let value = w(&at(re, im)).unwrap();
            assert!(
                (value.re.to_f64() - x).abs() < 1e-15,
                "{}",
                value.re.to_f64()
            );
            assert!(
                (value.im.to_f64() - y).abs() < 1e-15,
                "{}",
                value.im.to_f64()
            );
        }
        // w(−z̄) is the conjugate of w(z).
        let (a, b) = (
            w(&at((1, 2), (3, 4))).unwrap(),
            w(&at((-1, 2), (3, 4))).unwrap(),
        );
        assert!(a.re.overlaps(&b.re) && a.im.overlaps(&-&b.im));
        assert!(antiderivative(&at((40, 1), (0, 1))).is_err());
    }
}
