//! Half the width at half the maximum of the Voigt profile.
//!
//! With `y = γ/(σ√2)` it is `H = σ√2 t`, where t > 0 solves
//!
//! ```text
//! f(t) = 2 Re w(t + iy) − Re w(iy) = 0
//! ```
//!
//! # One solution
//! Re w(x + iy) is, but for a factor, the convolution V = G ∗ L of the normal density G and of
//! Cauchy's L. For y > 0 and x > 0
//!
//! ```text
//! V′(x) = ∫ G′(s) L(x − s) ds = ∫_0^∞ G′(s) (L(x − s) − L(x + s)) ds < 0
//! ```
//!
//! because G′ is odd and negative for s > 0, and L is even and falls with |x − s| < |x + s|. So f
//! falls strictly from f(0) = Re w(iy) > 0 to −Re w(iy), and has one zero.
//!
//! # Certificate
//! Newton's method on midpoints proposes t; nothing about it is trusted. Where `f(a) > 0` and
//! `f(b) < 0` are certain for floats `0 < a < b`, the zero lies between them. The derivative
//! `Re w′ = 2(y Im w − x Re w)` of the steps loses `2 log₂ y` digits; where these are more than
//! half of all, that of Lorentz's profile, wrong by about y^-2, replaces it.

use super::argument::{Argument, Member, Real};
use super::choice::at;
use super::ziv::{cap, first};
use crate::{Ball, Undecided};
use rug::ops::Pow;
use rug::{Float, Rational};

/// Newton's steps at one precision; five are used.
const STEPS: usize = 40;

const OPEN: &str = "no certificate for the width of the Voigt profile";

/// The equation at one working precision.
struct Equation {
    y: Real,
    /// y, rounded.
    near: Float,
    /// Re w(iy).
    peak: Ball,
    prec: u32,
}

impl Equation {
    fn new(y: Real, prec: u32) -> Option<Equation> {
        let near = y.ball(prec).mid().clone();
        let z = Argument::new(Real::Double(0.0), y.clone());
        let [peak, _] = at(&z, Member::W, prec)?;
        let peak = peak.to_ball();
        Some(Equation {
            y,
            near,
            peak,
            prec,
        })
    }

    /// f(t), and Re w and Im w.
    fn value(&self, t: &Float) -> Option<(Ball, [Ball; 2])> {
        let z = Argument::new(Real::Float(t.clone()), self.y.clone());
        let w = at(&z, Member::W, self.prec)?.map(|part| part.to_ball());
        Some((w[0].shift(1) - &self.peak, w))
    }

    /// Returns whether the steps are those for Lorentz's profile.
    fn is_far(&self) -> bool {
        let most = self.prec / 4;
        self.near
            .get_exp()
            .is_some_and(|e| i64::from(e) > i64::from(most))
    }

    /// A first t: within 0.02 % (Olivero & Longbothum 1977), for large y from `t = y + 3/(4y) + …`.
    fn start(&self) -> Float {
        let y = &self.near;
        if self.is_far() {
            return Float::with_val(self.prec, 0.75 / y) + y;
        }
        let square = Float::with_val(self.prec, y.square_ref()) * 0.86743;
        let root = Float::with_val(self.prec, square + 4.0 * std::f64::consts::LN_2).sqrt();
        (root + Float::with_val(self.prec, y * 1.06868)) / 2
    }

    /// Re w′(t + iy), about.
    fn slope(&self, t: &Float, [u, v]: &[Ball; 2]) -> Float {
        let y = &self.near;
        if self.is_far() {
            // Re w ≈ y/(√π (t² + y²))
            let norm = Float::with_val(self.prec, t.square_ref()) + y.clone().square();
            return Float::with_val(self.prec, t * u.mid()) * -2 / norm;
        }
        (Float::with_val(self.prec, y * v.mid()) - Float::with_val(self.prec, t * u.mid())) * 2
    }

    /// The approximate zero; its last step was below `2^-bits` of it.
    fn approached(&self, bits: u32) -> Option<Float> {
        let small = Float::with_val(64, 2).pow(-(bits as i32));
        let mut t = self.start();
        for _ in 0..STEPS {
            let (f, w) = self.value(&t)?;
            let slope = self.slope(&t, &w) * 2;
            let step = Float::with_val(self.prec, f.mid() / &slope);
            t -= &step;
            if !t.is_finite() {
                return None;
            }
            if step.abs() <= Float::with_val(64, &t * &small) {
                return Some(t);
            }
        }
        None
    }

    /// `[t(1 − 2^-bits), t(1 + 2^-bits)]` if the positive zero certainly lies there; bits > 0.
    /// Where both ends are rounded to one number f is not of both signs there.
    fn certified(&self, t: &Float, bits: u32) -> Option<Ball> {
        let part = Float::with_val(self.prec, t >> bits);
        let a = Float::with_val(self.prec, t - &part);
        let b = Float::with_val(self.prec, t + &part);
        let proved = *t > 0 && self.value(&a)?.0.is_positive() && self.value(&b)?.0.is_negative();
        proved.then(|| Ball::between(self.prec, &a, &b))
    }
}

/// Half the width at half the maximum of the Voigt profile, the x > 0 with `V(x) = V(0)/2`, with a
/// relative radius of at most 2^-bits: for a normal variable of standard deviation σ and a Cauchy
/// variable of half-width γ. `σ = 0` gives γ, `γ = 0` gives `σ√(2 ln 2)`.
///
/// ```
/// use mechaudit_reference::faddeeva;
/// use rug::Rational;
/// let h = faddeeva::voigt_hwhm(&Rational::from(1), &Rational::from(1), 100)?;
/// assert_eq!(h.to_decimal(25).unwrap(), "1.800567838601578690431255");
/// # Ok::<(), mechaudit_reference::Undecided>(())
/// ```
///
/// # Errors
/// [`Undecided`]: σ or γ is negative, or no certificate at `4 (bits + length of the input) + 4096`
/// bits.
pub fn voigt_hwhm(sigma: &Rational, gamma: &Rational, bits: u32) -> Result<Ball, Undecided> {
    if *sigma < 0 || *gamma < 0 {
        return Err(Undecided::new(
            bits,
            "the width of the Voigt profile needs σ ≥ 0 and γ ≥ 0",
        ));
    }
    let bits = bits.max(16);
    let p = bits + 16;
    if *sigma == 0 {
        return Ok(Ball::rational(p, gamma));
    }
    if *gamma == 0 {
        let root = (Ball::integer(p, 2).ln().shift(1)).sqrt();
        return Ok(Ball::rational(p, sigma) * &root);
    }
    let ratio = Rational::from(gamma / sigma);
    let y = Real::Root(false, Rational::from(ratio.square_ref()) / 2u32);
    let cap = cap(bits, y.length());
    first(bits + 64, 1, cap, OPEN, |prec| {
        let equation = Equation::new(y.clone(), prec)?;
        // A step of half the digits leaves an error of all of them.
        let t = equation.approached(bits.div_ceil(2) + 6)?;
        let t = equation.certified(&t, bits + 4)?;
        let root = Ball::integer(prec, 2).sqrt();
        Some(t * &(Ball::rational(prec, sigma) * &root))
    })
}

#[cfg(test)]
mod tests {
    use super::super::tests::q;
    use super::*;
    use crate::faddeeva::{voigt_scaled, w_derivative_scaled};

    /// mpmath 1.3.0: root of `re(exp(-z²) erfc(-iz)) − exp(y²) erfc(y)/2` at 60 digits.
    const BY_MPMATH: [(f64, f64, &str); 5] = [
        (1.0, 1.0, "1.80056783860157869043125502534"),
        (0.5, 0.25, "0.733586118306799935928180921102"),
        (2.0, 1e-06, "2.35482057757811590700074945857"),
        (3.0, 0.1, "3.58580505058593546308878126408"),
        (0.125, 1.0, "1.02283602738881979133167608503"),
    ];

    #[test]
    fn mpmath_gives_the_same() {
        for (sigma, gamma, digits) in BY_MPMATH {
            let h = voigt_hwhm(&q(sigma), &q(gamma), 120).unwrap();
            assert_eq!(h.to_decimal(30).unwrap(), digits, "{sigma}, {gamma}");
        }
    }

    /// From σ ≫ γ to σ ≪ γ, beyond the exponents of an `f64`.
    #[test]
    fn the_profile_there_is_half_its_peak() {
        for k in (-1060..=1060).step_by(53) {
            let gamma = match k < 0 {
                true => Rational::from((1, 1)) >> -k,
                false => Rational::from((1, 1)) << k,
            };
            let sigma = Rational::from((3, 5));
            let h = voigt_hwhm(&sigma, &gamma, 90).unwrap();
            assert!(h.accuracy_bits() >= 90, "2^{k}: {}", h.accuracy_bits());
            let end = |x: Float| Rational::try_from(x).unwrap();
            let at = |x: &Rational| voigt_scaled(x, &sigma, &gamma, 200).unwrap().to_ball();
            let half = at(&Rational::new()).shift(-1);
            assert!((at(&end(h.lower())) - &half).is_positive(), "2^{k}");
            assert!((at(&end(h.upper())) - &half).is_negative(), "2^{k}");
        }
    }

    /// A wrong t, however close, has no certificate; a right one has.
    #[test]
    fn what_is_beside_the_zero_is_not_certified() {
        let equation = Equation::new(Real::Double(0.75), 160).unwrap();
        let t = equation.approached(60).unwrap();
        assert!(equation.certified(&t, 90).is_some());
        let beside = Float::with_val(160, &t + Float::with_val(160, &t >> 80u32));
        assert!(equation.certified(&beside, 90).is_none());
        // Re w is even, and -t a zero as well.
        assert!(equation.certified(&-t.clone(), 90).is_none());
        // Nor does one that the working precision cannot decide.
        assert!(equation.certified(&t, 155).is_none());
    }

    #[test]
    fn precisions_double_up_to_the_cap() {
        let asked = std::cell::RefCell::new(Vec::new());
        let until = |least: u32| {
            asked.take();
            first(100, 1, 900, OPEN, |prec| {
                asked.borrow_mut().push(prec);
                (prec >= least).then(|| Ball::integer(64, 7))
            })
        };
        assert!(until(0).is_ok());
        assert_eq!(asked.take(), [100]);
        assert!(until(801).is_ok());
        assert_eq!(asked.take(), [100, 200, 400, 800, 900]);
        assert_eq!(until(901).unwrap_err().bits, 900);
        assert_eq!(asked.take(), [100, 200, 400, 800, 900]);
    }

    #[test]
    fn pure_profiles_and_refusals() {
        let zero = Rational::new();
        let h = voigt_hwhm(&zero, &q(0.3), 100).unwrap();
        assert!(h.contains(&q(0.3)));
        assert!(voigt_hwhm(&zero, &zero, 100).unwrap().is_zero());
        // √(2 ln 2), OEIS A185357 has 1.17741002251547469101156932645969963774738568938582…
        let h = voigt_hwhm(&q(1.0), &zero, 120).unwrap();
        assert_eq!(h.to_decimal(30).unwrap(), "1.17741002251547469101156932646");
        assert!(voigt_hwhm(&q(-1.0), &q(1.0), 100).is_err());
        assert!(voigt_hwhm(&q(1.0), &q(-1.0), 100).is_err());
    }

    /// Few bits and many, of every size of γ/σ: what comes out is within the width that more bits
    /// give.
    #[test]
    fn as_many_bits_as_asked_for() {
        for gamma in [0.0, 1e-30, 0.01, 1.0, 900.0, 7e5, 1.1e6, 2.2e6, 3e9, 1e40] {
            let fine = voigt_hwhm(&q(0.75), &q(gamma), 500).unwrap();
            for bits in [0, 1, 15, 16, 17, 40, 53, 63, 64, 65, 130, 200, 300, 400] {
                let h = voigt_hwhm(&q(0.75), &q(gamma), bits).unwrap();
                assert!(h.accuracy_bits() >= i64::from(bits), "{gamma} {bits}");
                assert!(h.overlaps(&fine), "{gamma} {bits}");
            }
        }
        // More steps than 40 of a fixed gain would take.
        let wide = voigt_hwhm(&q(0.75), &q(1.1e6), 3000).unwrap();
        assert!(wide.accuracy_bits() >= 3000);
    }

    /// Olivero and Longbothum's formula, or the two terms for large y: `t = y + 3/(4y) + O(y^-3)`.
    #[test]
    fn the_first_t_is_near_the_zero() {
        for y in [1e-9, 0.125, 3.0, 5e5, 1.1e6, 4e9, 1e12] {
            let equation = Equation::new(Real::Double(y), 100).unwrap();
            let fine = Equation::new(Real::Double(y), 400).unwrap();
            let t = fine.approached(150).unwrap();
            assert!(fine.certified(&t, 250).is_some(), "{y}");
            let off = Float::with_val(400, &equation.start() - &t).abs() / &t;
            let due = if y < 1e8 {
                2.5e-4
            } else {
                4.0 / y.powi(4) + 1e-30
            };
            assert!(off < due, "{y}: {off}");
        }
    }

    /// The slope of the steps has half of the digits at least.
    #[test]
    fn slopes_are_those_of_w() {
        for y in [1e-9, 0.125, 3.0, 5e5, 1.1e6, 3.3e7, 6e7, 4e9, 1e40] {
            let equation = Equation::new(Real::Double(y), 100).unwrap();
            let t = equation.start();
            let (_, w) = equation.value(&t).unwrap();
            let x = t.to_rational().unwrap();
            let due = w_derivative_scaled(&x, &q(y), 120).unwrap()[0].to_ball();
            let off: Float = equation.slope(&t, &w) / due.mid() - 1u32;
            assert!(off.abs() < 1e-14, "{y}");
        }
    }
}
