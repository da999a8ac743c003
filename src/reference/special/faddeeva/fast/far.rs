//! Beyond the cells.

use super::coordinate::Coordinate;
use super::fixed_point::PREC;
use super::gaussian::{above_power, ball, bound, gaussian, negligible};
use super::series::{Powers, UNIT};
use crate::faddeeva::asymptotic::{remainder, terms};
use crate::{Ball, ComplexBall, Mag};
use rug::Float;
use std::sync::OnceLock;

/// The function that is asked for, at a ± ih.
#[derive(Clone, Copy, PartialEq)]
pub enum Wanted {
    /// w above the axis.
    Upper,
    /// w below it.
    Lower,
    /// D above it.
    Dawson,
}

/// √π with a relative error below 2^-160.
static ROOT_PI: OnceLock<Float> = OnceLock::new();

/// `n 2^-UNIT factor`, where n 2^-UNIT is wrong by `wide`; 2^-150 of it for the roundings.
#[inline]
fn part(factor: Float, n: i128, wide: Mag) -> Ball {
    let mid = (Float::with_val(PREC, n) >> UNIT) * &factor;
    let error = Mag::above(&factor)
        .mul(wide)
        .add(Mag::above(&mid).shift(-150));
    Ball::new(mid, error)
}

/// The angle to an axis at whose other end z has this part, divided by |z|²: at most π/2 times its
/// sine, `(π/2) |z| x/|z|²`.
#[inline]
fn arc(part: &Float, log_r: f64) -> Mag {
    Mag::above(part).mul(above_power(0.5 * log_r + 0.66))
}

/// `D_N + 2|z|² e^{−Re z²}`.
#[inline]
fn turning(remainder: f64, gauss: Mag, log_r: f64) -> Mag {
    above_power(remainder).add(gauss.mul(above_power(log_r + 1.01)))
}

/// The asymptotic series with its plain remainder bound or, beside the real axis, with that of the
/// real part where that is less, on both sides of it ([`super::super::asymptotic`] has the
/// derivation).
///
/// That one holds for |Im z| ≤ |Re z|, and is less at small angles only: `θ D_N ≥ B_N` from 0.24
/// on.
pub fn far(x: &Coordinate, y: &Coordinate, wanted: Wanted, bits: u32) -> Option<ComplexBall> {
    let square = |x: &Float| Float::with_val(PREC, x.square_ref());
    let norm = square(&x.value) + square(&y.value);
    let (m, e) = norm.to_f64_exp();
    let log_r = m.log2() + f64::from(e) - 1e-8;
    let n = terms(log_r, bits + 4)?;
    let over = |x: &Float| Float::with_val(PREC, x / &norm);
    let (a, b) = (over(&x.value), over(&y.value));
    let sums = Powers::new(&a, &b, log_r)?.sums(n)?;
    let [below, beside] = [arc(&a, log_r), arc(&b, log_r)];
    let wide = Mag::from_f64(sums.error).shift(-i64::from(UNIT));
    let root_pi = ROOT_PI.get_or_init(|| Ball::pi(PREC + 8).sqrt().mid().clone());
    let re = part(b / root_pi, sums.re, wide);
    let im = part(a / root_pi, sums.im, wide);
    let due = remainder(n, log_r);
    let plain = above_power(due.plain);
    let im = im.widened(plain.min(below.mul(above_power(due.turning))));
    let gauss = bound(x, y);
    let turned = beside.mul(turning(due.turning, gauss, log_r));
    if plain <= turned {
        let re = re.widened(plain);
        if wanted == Wanted::Upper {
            return Some(ComplexBall::new(re, im));
        }
        let (c, s, slack) = gaussian(x, y)?;
        let (c, s) = (ball(c, slack), ball(s, slack));
        return Some(match wanted {
            Wanted::Dawson => ComplexBall::new(&re - &c, &im + &s),
            // 2E − conj w, E = c + is.
            _ => ComplexBall::new(&c.shift(1) - &re, &im + &s.shift(1)),
        });
    }
    let re = re.widened(turned);
    let re = if wanted == Wanted::Lower { -re } else { re };
    if wanted == Wanted::Dawson {
        // Re D is what the series gives, and Im D within 2^-130 of it.
        return Some(ComplexBall::new(re, im.widened(gauss)));
    }
    if negligible(gauss, &re, bits) {
        let im = match wanted {
            Wanted::Lower => im.widened(gauss.shift(1)),
            _ => im,
        };
        return Some(ComplexBall::new(re.widened(gauss), im));
    }
    let (c, s, slack) = gaussian(x, y)?;
    // Below: 2E − conj w, E = c + is.
    let im = match wanted {
        Wanted::Lower => &im + &ball(s, slack).shift(1),
        _ => im,
    };
    Some(ComplexBall::new(&re + &ball(c, slack), im))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn f(x: f64) -> Float {
        Float::with_val(300, x)
    }

    /// The factor times what n is wrong by, and 2^-150; a bound of 53 bits on a longer factor lies
    /// above it.
    #[test]
    fn parts_are_wrong_by_their_factor() {
        let long: Float = f(1.5) + (f(1.0) >> 100);
        let factor = Float::with_val(PREC, &long);
        for (wide, size) in [(Mag::ZERO, 0.0), (Mag::power_of_two(-151), 0.5)] {
            let found = part(factor.clone(), 3 << UNIT, wide);
            assert!(*found.mid() == 3 * long.clone());
            let due: Float = (long.clone() * (3.0 + size)) >> 150;
            let rad = f(1.0) * found.rad().to_float();
            assert!(
                rad >= due && rad <= due.clone() * (1.0 + 1e-12),
                "{rad} {due}"
            );
        }
    }

    /// From what is due to its next power of two.
    #[test]
    fn bounds_of_angles() {
        for k in 0..400 {
            let log_r = 6.5 + f64::from(k) * 0.01;
            let norm = log_r.exp2();
            let [angle, turned] = [
                arc(&f(0.75), log_r).to_f64() / (0.75 * std::f64::consts::FRAC_PI_2 * norm.sqrt()),
                turning(-300.0, Mag::from_f64(0.75), log_r).to_f64() / (0.75 * 2.0 * norm),
            ];
            for found in [angle, turned] {
                assert!((1.0..2.025).contains(&found), "{log_r}: {found}");
            }
        }
        let both = turning(-3.5, Mag::from_f64(0.75), 0.5).to_f64();
        assert!((3.125..3.125_001).contains(&both), "{both}");
    }
}
