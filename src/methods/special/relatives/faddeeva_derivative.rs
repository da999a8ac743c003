//! The derivative of the Faddeeva function.

use super::relative::{Exact, Relative, Zeros, on_axis};
use crate::audit::{Draw, Expected, Law, Region};
use crate::methods::common::{held, region};
use crate::methods::definition::method;
use crate::methods::special::complex::{C, NORM, infinity, number};
use crate::methods::special::faddeeva::curves::{BITS_OF_ZEROS, Beside, zero as zero_of_w};
use crate::methods::special::identities::{point, same_pair, within};
use crate::reference::ComplexBall;
use crate::reference::faddeeva::{self, w_f64};
use crate::solvers::faddeeva::{faddeeva as w, w_derivative};
use num_complex::Complex;
use rug::Rational;
use std::f64::consts::{FRAC_2_SQRT_PI, PI};
use std::sync::OnceLock;

/// Input `Re z, Im z`, output `Re W', Im W'`.
///
/// A candidate is a `Fn(Complex<f64>) -> Complex<f64>`.
#[derive(Clone, Copy, Debug)]
pub struct FaddeevaDerivative;

method! {
    FaddeevaDerivative "faddeeva-derivative": Fn(Complex<f64>), |f, z| f(z.into())
}

impl Relative for FaddeevaDerivative {
    const SUMMARY: &'static str =
        "derivative W'(z) = -2 z W(z) + 2i/sqrt(pi) of the Faddeeva function in the whole plane";
    const SOURCE: &'static str = "DLMF 7.10.2";
    const OUTPUTS: [&'static str; 2] = ["Re W'", "Im W'"];
    const ULPS: (f64, &'static str) = (
        4.0,
        "the differentiated series, and -4 z exp(-z^2) below the axis, again in double-double where \
         terms cancel: an ulp each for the exponential, the series, the product and the last rounding",
    );
    const NORM: (f64, &'static str) = NORM;
    const VALUE: fn(C) -> C = w_derivative;
    const EXACT: Exact = faddeeva::w_derivative_scaled;
    const ZEROS: Zeros = Zeros {
        at: zero,
        mirrored: [true, false],
        stored: 0,
    };

    /// `W″ = −2W − 2zW′`, and W from the equation of the first derivative.
    fn from_w(w: fn(C) -> C, z: C) -> C {
        C::new(0.0, FRAC_2_SQRT_PI) - 2.0 * z * w(z)
    }

    fn slope(z: C, value: C) -> C {
        let w = (C::new(0.0, FRAC_2_SQRT_PI) - value) / (2.0 * z);
        -2.0 * (w + z * value)
    }

    /// W' tends to 0 in the closed upper half-plane and for Re z → ±∞, to +i∞ down the imaginary
    /// axis, on which it is imaginary.
    fn limit(x: f64, y: f64) -> [Expected; 2] {
        let re = if x == 0.0 {
            number(0)
        } else {
            Expected::NotANumber
        };
        if x.is_nan() || y.is_nan() {
            return [re, Expected::NotANumber];
        }
        match (y > f64::NEG_INFINITY, x == 0.0) {
            (true, _) => [number(0), number(0)],
            (false, true) => [re, infinity(1.0)],
            (false, false) => [Expected::NotANumber, Expected::NotANumber],
        }
    }

    /// On the imaginary axis, `W(iy) = E(y)`, `Re W′(x + iy) = −x E″(y) + …`, and
    /// `E″(y) = (8/√π) ∫_0^∞ t² e^{−t²−2yt} dt > 0`. At infinity `W′ = −(i/√π) z^{−2} + …`.
    fn signs_of_zero(x: f64, y: f64) -> [Option<bool>; 2] {
        let far = x.is_infinite() || y.is_infinite();
        let re = match far && x != 0.0 && y != 0.0 {
            true => Some(x.is_sign_negative() == y.is_sign_negative()),
            false => on_axis(x, -1.0),
        };
        let im = (x.is_infinite() != y.is_infinite()).then(|| x.is_infinite());
        [re, im]
    }

    fn regions() -> Vec<Region> {
        vec![region(
            "zero-curve-beside-real-axis",
            "next to the zero curve of Re W' at Re z = 6..27.3, Im z to -5e-324, within some of its places in Im z \
             or off by a relative 1e-15..1e-1",
            beside_flat_curve,
        )]
    }

    fn laws() -> Vec<Law> {
        vec![
            Law {
                name: "symmetry",
                statement: "W'(-conj z) = -conj W'(z), bit for bit",
                residual: |input| symmetry(w_derivative, input),
            },
            Law {
                name: "differential-equation",
                statement: "W'(z) + 2 z W(z) = 2i/sqrt(pi) within 7 u (|W'(z)| + |2 z W(z)| + 1)",
                residual: equation,
            },
        ]
    }
}

fn symmetry(slope: impl Fn(C) -> C, input: &[f64]) -> Option<f64> {
    let z = point(input)?;
    held(same_pair(slope(-z.conj()), -slope(z).conj()))
}

fn equation(input: &[f64]) -> Option<f64> {
    let z = point(input)?;
    let (slope, product) = (w_derivative(z), 2.0 * z * w(z));
    // 4 u of each value, 2 u of the product's rounding, 1 u of the sum's: no value has all of it.
    let rest = (product - C::new(0.0, FRAC_2_SQRT_PI)) + slope;
    within(rest, 7.0, slope.norm() + product.norm() + 1.0)
}

/// A point just below the real axis, next to the curve `2x e^{-x²} = |y| Im W″(x)` on which
/// `Re W′ = 0`, with `Im W″` by its asymptotic series (DLMF 7.12.1, twice differentiated), whose
/// terms fall down to `e^{-x²}`.
fn beside_flat_curve(d: &mut Draw) -> Vec<f64> {
    let x = d.uniform(6.0, 27.3);
    let square = x * x;
    let gaussian = libm::exp(-square) * (1.0 - x.mul_add(x, -square));
    // (2n − 1)!!/2ⁿ (2n + 1)(2n + 2)/x²ⁿ⁺³, over √π.
    let mut term = 2.0 / (PI.sqrt() * square * x);
    let mut curved = 0.0;
    for n in 0..36 {
        curved += term;
        let n = f64::from(n);
        term *= (n + 0.5) * (2.0 * n + 3.0) * (2.0 * n + 4.0)
            / ((2.0 * n + 1.0) * (2.0 * n + 2.0) * square);
    }
    let y = Beside::draw(d, 1e-1).of(2.0 * x * gaussian / curved);
    vec![d.signed(x), -y]
}

/// The `f64` next to the zero of W' that Newton's method finds from the k-th zero of W.
fn zero(k: usize) -> [f64; 2] {
    const ZEROS: usize = 60;
    static ALL: [OnceLock<[f64; 2]>; ZEROS] = [const { OnceLock::new() }; ZEROS];
    // An argument that the audit shows as not finite.
    *ALL[(k - 1) % ZEROS].get_or_init(|| refined(zero_of_w(k)).unwrap_or([f64::NAN; 2]))
}

fn refined([x, y]: [f64; 2]) -> Option<[f64; 2]> {
    let rough = |b: &ComplexBall| C::new(b.re.to_f64(), b.im.to_f64());
    let mut z = C::new(x, y);
    for _ in 0..60 {
        let (re, im) = (Rational::from_f64(z.re)?, Rational::from_f64(z.im)?);
        let w = rough(&w_f64(z.re, z.im, BITS_OF_ZEROS).ok()?);
        let slope = rough(&faddeeva::w_derivative(1, &re, &im, BITS_OF_ZEROS).ok()?);
        // W'' = −2 (W + z W').
        let step = slope / (-2.0 * (w + z * slope));
        let next = z - step;
        if step.norm() <= 1e-15 * z.norm() {
            return Some([next.re, next.im]);
        }
        z = next;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    /// z is imaginary on the imaginary axis, i z is not.
    #[test]
    fn a_sign_that_is_lost_breaks_the_symmetry() {
        let input = [0.5, 0.25];
        assert_eq!(symmetry(|z| z, &input), Some(0.0));
        assert_eq!(symmetry(|z| C::i() * z, &input), Some(f64::INFINITY));
    }

    /// Of the points beside the flat curve half are so close that all but a few digits of Re W'
    /// cancel.
    #[test]
    fn points_beside_the_flat_curve() {
        let mut close = 0;
        for i in 0..200 {
            let z = beside_flat_curve(&mut Draw::new(1, "m", "r", i));
            let exact = [z[0], z[1]].map(|x| Rational::from_f64(x).unwrap());
            let due = faddeeva::w_derivative(1, &exact[0], &exact[1], 60).unwrap();
            let one = 4.0 * z[0] * libm::exp(-z[0] * z[0]);
            let share = due.re.to_f64().abs() / one.abs();
            assert!(share < 0.11 || one.abs() < 1e-300, "{z:?}: {share}");
            close += usize::from(share < 1e-13);
        }
        assert!((60..140).contains(&close), "{close}");
    }

    /// At infinity W' is −(i/√π) z^{−2}: −2xy has the sign of the real part's opposite, and the
    /// imaginary part that of y² − x².
    #[test]
    fn signs_of_zero_at_infinity_and_on_the_axis() {
        let (inf, plus, minus) = (f64::INFINITY, Some(false), Some(true));
        for ((x, y), due) in [
            ((inf, 2.0), [minus, minus]),
            ((inf, -2.0), [plus, minus]),
            ((inf, 0.0), [None, minus]),
            ((1.0, inf), [minus, plus]),
            ((-1.0, inf), [plus, plus]),
            ((0.0, inf), [minus, plus]),
            ((-0.0, inf), [plus, plus]),
            ((-0.0, 3.0), [plus, None]),
            ((1.0, 3.0), [None, None]),
            ((inf, inf), [minus, None]),
        ] {
            let signs = FaddeevaDerivative::signs_of_zero(x, y);
            assert_eq!(signs, due, "{x} {y}");
        }
    }

    #[test]
    fn zeros_of_the_derivative_are_zeros() {
        let mut before = 0.0;
        for k in 1..=60 {
            let [x, y] = zero(k);
            let slope = w_derivative(C::new(x, y));
            // Half a unit in each coordinate times |W''| ≈ 2|W|.
            let size = w(C::new(x, y)).norm();
            assert!(
                slope.norm() < 1e-14 * size * x.hypot(y),
                "{k}: {x} {y} {slope}"
            );
            assert!(x.hypot(y) > before, "{k}");
            before = x.hypot(y);
        }
    }
}
