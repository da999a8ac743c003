//! The error function, its relatives, and Dawson's function.
//!
//! erf and erfc are MPFR's; the others come from [`faddeeva`](crate::faddeeva), with each value
//! certified to the relative accuracy asked for.

use super::arithmetic::between_values;
use super::support::{
    NARROW, WIDE, decreasing, directed, ends, exp_above, finish, increasing, least, nearest, union,
};
use super::{Evaluated, NoValue};
use crate::special::faddeeva::{Relative, Scaled};
use crate::{Ball, Mag};
use rug::Float;
use rug::float::{exp_max, exp_min};

/// An upper bound on `2/√π`.
pub(super) const TWO_OVER_ROOT_PI: f64 = 1.1283791670955128;

/// `e^{t²}` of this and beyond is more than MPFR holds: `30000² log2 e > 1.29e9`, less the factors
/// beside it here.
const OVERFLOW: f64 = 30000.0;

/// Bits beyond those of the result.
const GUARD: u32 = 8;

/// `e^{−a²}` from above, with `a` a lower bound.
pub(super) fn gaussian_above(a: Mag) -> Mag {
    let a = a.to_f64().min(1e8);
    exp_above(-(a * a) * (1.0 - 4.0 * f64::EPSILON))
}

/// `e^{a²}` from above, with `a` an upper bound.
pub(super) fn growing_above(a: Mag) -> Mag {
    let a = a.to_f64();
    exp_above(a * a * (1.0 + 4.0 * f64::EPSILON))
}

/// Returns true if e^{±x²} changes little over the ball.
fn is_level(x: &Ball) -> bool {
    let scale = Mag::above(x.mid()).max(Mag::power_of_two(0));
    x.rad().mul(scale) <= Mag::power_of_two(NARROW)
}

/// `erf x`: the derivative is at most `(2/√π) e^{−a²}`, with `a` the least |x|.
pub fn erf(x: &Ball, prec: u32) -> Evaluated {
    if x.rad().is_zero() {
        return finish(nearest(prec, x.mid().erf_ref()), Mag::ZERO);
    }
    if !is_level(x) {
        return increasing(directed!(erf_ref), &ends(x, prec), prec);
    }
    let slope = gaussian_above(x.mignitude()).mul(Mag::from_f64(TWO_OVER_ROOT_PI));
    finish(nearest(prec, x.mid().erf_ref()), slope.mul(x.rad()))
}

/// `erfc x`, as [`erf`].
pub fn erfc(x: &Ball, prec: u32) -> Evaluated {
    if x.rad().is_zero() {
        return finish(nearest(prec, x.mid().erfc_ref()), Mag::ZERO);
    }
    if !is_level(x) {
        return decreasing(directed!(erfc_ref), &ends(x, prec), prec);
    }
    let slope = gaussian_above(x.mignitude()).mul(Mag::from_f64(TWO_OVER_ROOT_PI));
    finish(nearest(prec, x.mid().erfc_ref()), slope.mul(x.rad()))
}

/// A ball times a power of two as a ball.
pub(super) fn of_scaled(value: &Scaled, prec: u32) -> Evaluated {
    let ball = &value.ball;
    let Some(e) = ball.mid().get_exp() else {
        return if ball.is_zero() {
            Ok(ball.clone())
        } else {
            Err(WIDE)
        };
    };
    let k = value
        .exponent
        .to_i64()
        .unwrap_or(if value.exponent.is_negative() {
            -(1 << 40)
        } else {
            1 << 40
        });
    let to = i64::from(e).saturating_add(k);
    if to > i64::from(exp_max()) {
        // At least 2^(to − 2) where the ball is not wide.
        if ball.accuracy_bits() < 2 {
            return Err(WIDE);
        }
        let negative = ball.mid().is_sign_negative();
        return Err(NoValue::Overflow { negative });
    }
    if to <= i64::from(exp_min()) {
        let size = ball.magnitude().shift(k).add(least());
        return Ok(Ball::new(Float::new(prec), size));
    }
    let shifted = ball.mid().clone() << k as i32;
    finish(nearest(prec, &shifted), ball.rad().shift(k))
}

fn related(which: Relative, x: &Float, imaginary: bool, prec: u32) -> Evaluated {
    let zero = Float::new(prec);
    let (re, im) = if imaginary { (&zero, x) } else { (x, &zero) };
    let found = which.at(re, im, prec + GUARD);
    let [re, im] = found.map_err(|_| NoValue::Undecided("the value cannot be told from zero"))?;
    of_scaled(if imaginary { &im } else { &re }, prec)
}

/// erfcx at a float.
///
/// `1 − 1/(2x²) ≤ √π x erfcx x ≤ 1` for x > 0, from `erfcx x = (2/√π) ∫_0^∞ e^{−t²−2xt} dt` with
/// `1 − t² ≤ e^{−t²} ≤ 1`. `|erfcx x − 1| ≤ 4|x|` for |x| ≤ 1/2, because `|erfcx'|` is at most
/// `2|x| erfcx x + 2/√π ≤ 1.96 + 1.13` there. Left of zero `erfcx x ≥ e^{x²}`.
fn erfcx_at(x: &Float, prec: u32) -> Evaluated {
    let Some(e) = x.get_exp() else {
        return Ok(super::support::exact(prec, 1));
    };
    if *x <= -OVERFLOW {
        return Err(NoValue::Overflow { negative: false });
    }
    let bits = i64::from(prec);
    if i64::from(e) < -bits - 8 {
        return finish(
            nearest(prec, Float::with_val(prec, 1)),
            Mag::above(x).shift(2),
        );
    }
    if *x > 0 && i64::from(e) > bits / 2 + 8 {
        let root = Ball::pi(prec + GUARD).sqrt();
        let ball = Ball::new(x.clone(), Mag::ZERO);
        let lead = super::recip(&super::mul(&root, &ball, prec + GUARD)?, prec)?;
        // x ≥ 2^(e − 1): 1/(2x²) ≤ 2^(1 − 2e).
        let rest = lead.magnitude().shift(1 - 2 * i64::from(e));
        return Ok(lead.widened(rest));
    }
    related(Relative::Erfcx, x, false, prec)
}

/// The scaled complementary error function `e^{x²} erfc x`. It decreases.
///
/// For x ≥ 0 `0 < −erfcx' x = 2/√π − 2x erfcx x ≤ (1/√π)/(x² + 1/2)`, because
/// `erfcx x ≥ (2/√π)/(x + √(x² + 2)) ≥ (1/√π) x/(x² + 1/2)` (DLMF 7.8.2, and
/// `x √(x² + 2) ≤ x² + 1`). For x ≥ l, l < 0, it is at most `4|l| e^{l²} + 2/√π`, since
/// `erfcx l ≤ 2 e^{l²}` and erfcx is convex.
pub fn erfcx(x: &Ball, prec: u32) -> Evaluated {
    if x.rad().is_zero() {
        return erfcx_at(x.mid(), prec);
    }
    if !x.is_finite() {
        return Err(WIDE);
    }
    // To the right of zero the relative change is r/x.
    let level =
        is_level(x) || (x.is_positive() && super::support::is_narrow(x.rad(), Mag::below(x.mid())));
    if level {
        let slope = if x.is_positive() {
            let a = x.mignitude();
            let divisor = Mag::power_of_two(-1).add_below(a.mul_below(a));
            Mag::from_f64(TWO_OVER_ROOT_PI).shift(-1).div(divisor)
        } else {
            let l = x.magnitude();
            let grown = growing_above(l).mul(l).shift(2);
            grown.add(Mag::from_f64(TWO_OVER_ROOT_PI))
        };
        let value = erfcx_at(x.mid(), prec);
        if !matches!(value, Err(NoValue::Overflow { .. })) {
            return widened(value?, slope.mul(x.rad()));
        }
    }
    let [low, high] = ends(x, prec);
    between_values(
        erfcx_at(&high, prec + GUARD),
        erfcx_at(&low, prec + GUARD),
        prec,
    )
}

/// A ball enlarged; undecided where that has no bound.
pub(super) fn widened(ball: Ball, extra: Mag) -> Evaluated {
    let wide = ball.widened(extra);
    if wide.is_finite() {
        Ok(wide)
    } else {
        Err(WIDE)
    }
}

/// erfi at a float. `|erfi x − 2x/√π| ≤ (2/√π) |x|³` for |x| ≤ 1, because
/// `Σ x^{2n}/(n! (2n + 1)) ≤ x²/2` from n = 1 on. Beyond 30000 it is more than `e^{x²}/(4x)`.
fn erfi_at(x: &Float, prec: u32) -> Evaluated {
    let Some(e) = x.get_exp() else {
        return Ok(super::support::exact(prec, 0));
    };
    if *x.as_abs() >= OVERFLOW {
        let negative = x.is_sign_negative();
        return Err(NoValue::Overflow { negative });
    }
    if i64::from(e) < -i64::from(prec) / 2 - 4 {
        let root = Ball::pi(prec + GUARD).sqrt().shift(-1);
        let lead = super::div(&Ball::new(x.clone(), Mag::ZERO), &root, prec)?;
        let rest = lead.magnitude().shift(2 * i64::from(e));
        return Ok(lead.widened(rest));
    }
    // erf(iy) = i erfi y.
    related(Relative::Erf, x, true, prec)
}

/// `erfi x = −i erf ix`: the derivative is at most `(2/√π) e^{X²}`, with X the greatest |x|.
pub fn erfi(x: &Ball, prec: u32) -> Evaluated {
    if x.rad().is_zero() {
        return erfi_at(x.mid(), prec);
    }
    if !x.is_finite() {
        return Err(WIDE);
    }
    if is_level(x) {
        let slope = growing_above(x.magnitude()).mul(Mag::from_f64(TWO_OVER_ROOT_PI));
        let value = erfi_at(x.mid(), prec);
        if !matches!(value, Err(NoValue::Overflow { .. })) {
            return widened(value?, slope.mul(x.rad()));
        }
    }
    let [low, high] = ends(x, prec);
    between_values(
        erfi_at(&low, prec + GUARD),
        erfi_at(&high, prec + GUARD),
        prec,
    )
}

/// Dawson's function at a float. `|F(x) − x| ≤ |x|³` for |x| ≤ 1 (an alternating series whose terms
/// fall). For x ≥ 8 `|2x F(x) − 1| ≤ 2/x²`: with `s = x² − t²`, `F = ∫_0^{x²} e^{−s}/(2√(x² − s))
/// ds` is at least `(1 − e^{−x²})/(2x)`; at most `(1 + 1/x²)/(2x)` comes from s ≤ x²/2, where
/// `1/√(1 − u) ≤ 1 + u`, and at most `x e^{−x²/2}` from the rest.
fn dawson_at(x: &Float, prec: u32) -> Evaluated {
    let Some(e) = x.get_exp() else {
        return Ok(super::support::exact(prec, 0));
    };
    let e = i64::from(e);
    if e < -i64::from(prec) / 2 - 4 {
        return finish(nearest(prec, x), Mag::above(x).shift(2 * e));
    }
    if e > i64::from(prec) / 2 + 8 {
        let twice = Ball::new(x.clone(), Mag::ZERO);
        let lead = super::div(&Ball::exact(prec, 0.5), &twice, prec)?;
        // x ≥ 2^(e − 1): 2/x² ≤ 2^(3 − 2e).
        let rest = lead.magnitude().shift(3 - 2 * e);
        return Ok(lead.widened(rest));
    }
    related(Relative::Dawson, x, false, prec)
}

/// Where F has its maximum: 0.92413887300…
const DAWSON_TURN: [f64; 2] = [0.92413887, 0.92413888];
/// Just above the maximum 0.54104422463… of F.
pub(super) const DAWSON_MOST: f64 = 0.541044225;

/// Dawson's function `F(x) = e^{−x²} ∫_0^x e^{t²} dt`.
///
/// `F(x) = ∫_0^∞ e^{−t²} sin 2xt dt` (DLMF 7.7.3), so `|F'| ≤ ∫ 2t e^{−t²} dt = 1` and `|F''| ≤ ∫
/// 4t² e^{−t²} dt = √π`. With `F' = 1 − 2x F`: `|F(x) − F(m)| ≤ |1 − 2m F(m)| r + 0.89 r²`. Over a
/// wide ball the extremes are at the ends, and at ±0.924… where they are inside.
pub fn dawson(x: &Ball, prec: u32) -> Evaluated {
    let (m, r) = (x.mid(), x.rad());
    if r.is_zero() {
        return dawson_at(m, prec);
    }
    if r <= Mag::power_of_two(NARROW) {
        let value = dawson_at(m, prec)?;
        let one = Mag::power_of_two(0);
        let slope = if Mag::below(m) >= Mag::from_f64(8.0) {
            // |1 − 2x F| ≤ 2/x²
            let a = x.mignitude();
            Mag::power_of_two(1).div(a.mul_below(a))
        } else {
            let m = Ball::new(m.clone(), Mag::ZERO).with_prec(64);
            let at = Ball::integer(64, 1) - (&m * &value.with_prec(64)).shift(1);
            at.magnitude().add(r.mul(Mag::from_f64(0.89)))
        };
        return widened(value, slope.min(one).mul(r));
    }
    let most = Ball::exact(64, DAWSON_MOST);
    if !x.is_finite() {
        return union(prec, &[&most, &-most.clone()]);
    }
    let [low, high] = ends(x, prec);
    let a = dawson_at(&low, prec + GUARD)?;
    let b = dawson_at(&high, prec + GUARD)?;
    let (mut all, least) = (vec![&a, &b], -most.clone());
    let [t, u] = DAWSON_TURN;
    if low <= u && high >= t {
        all.push(&most);
    }
    if low <= -t && high >= -u {
        all.push(&least);
    }
    union(prec, &all)
}
