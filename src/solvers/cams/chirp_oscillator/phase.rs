//! Phases in double-double and their sines and cosines.

use crate::double_double::Dd;
use crate::exponential::{LARGE_PHASE, reduce, sin_cos_reduced, turn};
use crate::payne_hanek;
use crate::real::ROUND;
use num_complex::Complex;

/// `√x` for `x ≥ 0`, relative error about 2⁻¹⁰⁴.
pub(super) fn sqrt(x: Dd) -> Dd {
    let s = x.hi.sqrt();
    if s == 0.0 {
        return Dd::ZERO;
    }
    let rest = (-s).mul_add(s, x.hi) + x.lo;
    Dd::new(s, rest / (2.0 * s)).normal()
}

/// `x` modulo π/2, for phases of any size: the rest and `ROUND` plus the quadrant.
#[cold]
#[inline(never)]
fn reduce_large(x: Dd) -> (Dd, f64) {
    let part = |x: f64| match x.abs() < LARGE_PHASE {
        true => reduce(Dd::from(x)),
        // 2 a y with a = |x| and y = ±1/2.
        false => payne_hanek::reduce(x.abs(), 0.5f64.copysign(x)),
    };
    let ((r, m), (s, n)) = (part(x.hi), part(x.lo));
    let (rest, last) = reduce(r + s);
    // Quadrants count modulo four.
    let quadrant = (m - ROUND).rem_euclid(4.0) + (n - ROUND).rem_euclid(4.0);
    (rest, last + quadrant)
}

/// `e^{ix}`, rounded once.
#[inline(always)]
pub(super) fn circle(x: Dd) -> Complex<f64> {
    let (rest, quadrant) = match x.hi.abs() < LARGE_PHASE {
        true => reduce(x),
        false => reduce_large(x),
    };
    let (sin, cos) = sin_cos_reduced(rest);
    let (sin, cos) = turn(sin, cos, quadrant);
    Complex::new(cos.value(), sin.value())
}

/// `e^{−x}` for `x ≥ 0`, without the error of a rounded `x`.
#[inline(always)]
pub(super) fn decay(x: Dd) -> f64 {
    let e = (-x.hi).exp();
    (-x.lo).mul_add(e, e)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sines and cosines of sums of two numbers by mpmath 1.3 at 4000 bits.
    #[test]
    fn large_phases_of_two_parts() {
        for ((hi, lo), cos, sin) in [
            (
                (2f64.powi(60), 2.0),
                0.987_016_124_433_588_2,
                -0.160_621_200_680_668_54,
            ),
            (
                (2f64.powi(60), 96.0),
                0.917_479_358_511_319_6,
                -0.397_783_391_691_580_8,
            ),
            (
                (2f64.powi(60), 100.0),
                -0.900_747_993_389_202_2,
                -0.434_342_091_450_190_7,
            ),
            (
                (-(2f64.powi(70)), 4.0),
                0.716_000_245_905_716_6,
                -0.698_100_027_118_573_7,
            ),
            (
                (2f64.powi(30), 0.0),
                0.786_707_122_941_188,
                -0.617_326_415_046_042_2,
            ),
            (
                (2f64.powi(30), 2f64.powi(-24)),
                0.786_707_159_736_708_4,
                -0.617_326_368_154_642_5,
            ),
            (
                (1e300, 1e280),
                0.141_729_089_977_370_6,
                0.989_905_482_889_243_5,
            ),
        ] {
            let e = circle(Dd::new(hi, lo));
            assert!(
                (e.re - cos).abs() <= 2e-16 && (e.im - sin).abs() <= 2e-16,
                "{hi} {lo}: {e}"
            );
        }
    }

    #[test]
    fn roots_of_two_parts() {
        for x in [Dd::from(2.0), Dd::new(2.0, 1e-16)] {
            let square = sqrt(x).square();
            assert!((square.hi - 2.0 + (square.lo - x.lo)).abs() < 1e-31);
        }
    }

    /// The lower part counts to first order: here it is larger than a rounding, to be seen.
    #[test]
    fn a_decay_of_two_parts() {
        let e = decay(Dd::new(1.0, 1e-9));
        assert!((e / 0.367_879_440_803_562_9 - 1.0).abs() < 1e-15, "{e}");
    }
}
