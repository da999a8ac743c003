//! Exponentials, logarithms and powers.

use super::arithmetic::{above_rounded, integer_power};
use super::coarse;
use super::support::{
    BITS, Directed, NARROW, Rounded, directed, doubles, ends, exact, exp_above, f64_below, finish,
    hull, hull_of_doubles, increasing, is_narrow, nearest, off, one_more,
};
use super::trigonometric::outwards;
use super::{Evaluated, NoValue};
use crate::arithmetic::nearest as by_words;
use crate::{Ball, Mag};
use rug::Float;
use rug::ops::Pow;

/// An upper bound on ln 2.
const LN_2: f64 = 0.6931471805599454;
/// An upper bound on ln 10.
const LN_10: f64 = 2.302585092994047;
/// An upper bound on 1/ln 2.
const INVERSE_LN_2: f64 = 1.4426950408889636;
/// An upper bound on 1/ln 10.
const INVERSE_LN_10: f64 = 0.4342944819032519;

/// An upper bound on `e^s − 1` for s ≤ 1: `s + s²`.
pub(super) fn expm1_above(s: Mag) -> Mag {
    s.add(s.mul(s))
}

/// `b^x`: `|b^x − b^m| ≤ b^m (e^s − 1)` with `s = r ln b`.
fn exponential(
    x: &Ball,
    prec: u32,
    log_base: Mag,
    at: impl Fn(&Float) -> Rounded,
    f: impl Directed,
) -> Evaluated {
    if x.rad().is_zero() {
        return finish(at(x.mid()), Mag::ZERO);
    }
    let s = x.rad().mul(log_base);
    if s <= Mag::power_of_two(NARROW) {
        let value = at(x.mid());
        if value.0.is_finite() {
            let size = above_rounded(&value);
            return finish(value, size.mul(expm1_above(s)));
        }
    }
    increasing(f, &ends(x, prec), prec)
}

/// `e^x`. The radius is `e^m (r + r²)` for r ≤ 2^-10.
pub fn exp(x: &Ball, prec: u32) -> Evaluated {
    let one = Mag::power_of_two(0);
    let at = |m: &Float| by_words::exp(m, prec);
    if x.rad() > Mag::power_of_two(NARROW) {
        let [low, high] = doubles(&ends(x, prec));
        if low >= -coarse::EXPONENTS && high <= coarse::EXPONENTS {
            let range = [coarse::exp(low), coarse::exp(high)];
            return hull_of_doubles(prec, outwards(range));
        }
    }
    exponential(x, prec, one, at, directed!(exp_ref))
}

/// `2^x`.
pub fn exp2(x: &Ball, prec: u32) -> Evaluated {
    let at = |m: &Float| nearest(prec, m.exp2_ref());
    exponential(x, prec, Mag::from_f64(LN_2), at, directed!(exp2_ref))
}

/// `10^x`.
pub fn exp10(x: &Ball, prec: u32) -> Evaluated {
    let at = |m: &Float| nearest(prec, m.exp10_ref());
    exponential(x, prec, Mag::from_f64(LN_10), at, directed!(exp10_ref))
}

/// `e^x − 1`: the same radius `e^m (r + r²)`, with e^m bounded by the value and one for m ≥ 0.
pub fn expm1(x: &Ball, prec: u32) -> Evaluated {
    let (m, r) = (x.mid(), x.rad());
    if r.is_zero() {
        return finish(nearest(prec, m.exp_m1_ref()), Mag::ZERO);
    }
    if r <= Mag::power_of_two(NARROW) {
        let value = nearest(prec, m.exp_m1_ref());
        if value.0.is_finite() {
            let size = if m.is_sign_negative() {
                exp_above(-f64_below(m))
            } else {
                one_more(above_rounded(&value))
            };
            return finish(value, size.mul(expm1_above(r)));
        }
    }
    increasing(directed!(exp_m1_ref), &ends(x, prec), prec)
}

/// Refuses what has no logarithm.
fn positive(x: &Ball) -> Result<(), NoValue> {
    if x.is_positive() {
        return Ok(());
    }
    let [_, high] = ends(x, BITS);
    Err(if high <= 0 {
        NoValue::Undefined("the logarithm of a number that is not positive")
    } else {
        NoValue::Undecided("the logarithm of what may not be positive")
    })
}

/// A logarithm: `|ln x − ln m| ≤ r/(m − r)`, times `scale = 1/ln b`.
fn logarithm(
    x: &Ball,
    prec: u32,
    scale: f64,
    at: impl Fn(&Float) -> Rounded,
    f: impl Directed,
) -> Evaluated {
    positive(x)?;
    if x.rad().is_zero() {
        return finish(at(x.mid()), Mag::ZERO);
    }
    let least = x.mignitude();
    if is_narrow(x.rad(), least) {
        return finish(at(x.mid()), x.rad().div(least).mul(Mag::from_f64(scale)));
    }
    increasing(f, &ends(x, prec), prec)
}

/// `ln x`; radius `r/(m − r)` (mean value theorem).
pub fn log(x: &Ball, prec: u32) -> Evaluated {
    let at = |m: &Float| by_words::log(m, prec);
    if !is_narrow(x.rad(), x.mignitude()) {
        let both = doubles(&ends(x, prec));
        if both.iter().all(|x| *x > 0.0 && x.is_normal()) {
            let [low, high] = both.map(coarse::ln);
            let error = |x: f64| coarse::ERROR * x.abs().max(1.0);
            return hull_of_doubles(prec, [low - error(low), high + error(high)]);
        }
    }
    logarithm(x, prec, 1.0, at, directed!(ln_ref))
}

/// The logarithm to base two.
pub fn log2(x: &Ball, prec: u32) -> Evaluated {
    let at = |m: &Float| nearest(prec, m.log2_ref());
    logarithm(x, prec, INVERSE_LN_2, at, directed!(log2_ref))
}

/// The logarithm to base ten.
pub fn log10(x: &Ball, prec: u32) -> Evaluated {
    let at = |m: &Float| nearest(prec, m.log10_ref());
    logarithm(x, prec, INVERSE_LN_10, at, directed!(log10_ref))
}

/// `ln(1 + x)`; radius `r/(1 + m − r)`.
pub fn log1p(x: &Ball, prec: u32) -> Evaluated {
    let least = off(x, -1);
    if least.is_zero() || *x.mid() < -1 {
        let [low, high] = ends(x, prec);
        if high <= -1 {
            return Err(NoValue::Undefined("log1p of a number that is not above -1"));
        }
        if low <= -1 {
            return Err(NoValue::Undecided("log1p of what may not be above -1"));
        }
    }
    if x.rad().is_zero() {
        return finish(nearest(prec, x.mid().ln_1p_ref()), Mag::ZERO);
    }
    if is_narrow(x.rad(), least) {
        return finish(nearest(prec, x.mid().ln_1p_ref()), x.rad().div(least));
    }
    increasing(directed!(ln_1p_ref), &ends(x, prec), prec)
}

/// `x^y`.
///
/// For x > 0 with `s = r_x/(x − r_x)`: `|y' ln x' − y ln x| ≤ δ = |y| s + r_y (|ln x| + s)`, so the
/// radius is `x^y (e^δ − 1)`. Over a wide box the extremes are at corners, because x^y is monotone
/// in x for each y, and in y for each x.
pub fn pow(x: &Ball, y: &Ball, prec: u32) -> Evaluated {
    if y.is_zero() {
        return Ok(exact(prec, 1));
    }
    if x.is_zero() {
        return if y.is_positive() {
            Ok(exact(prec, 0))
        } else if y.is_negative() {
            Err(NoValue::Undefined("zero to a negative power"))
        } else {
            Err(NoValue::Undecided("zero to a power that may be negative"))
        };
    }
    if y.rad().is_zero() && y.mid().is_integer() {
        return integer_power(x, y.mid(), prec);
    }
    if x.is_positive() {
        return positive_power(x, y, prec);
    }
    let [low, high] = ends(x, prec);
    if high < 0 {
        return Err(if is_between_integers(&ends(y, prec)) {
            NoValue::Undefined("a negative number to a power that is no integer")
        } else {
            NoValue::Undecided("a negative number to a power that may be no integer")
        });
    }
    if low >= 0 && y.is_positive() {
        return corners(&[low, high], &ends(y, prec), prec);
    }
    Err(NoValue::Undecided(
        "the power of what may be zero or negative",
    ))
}

/// Returns true if an interval holds no integer.
fn is_between_integers([low, high]: &[Float; 2]) -> bool {
    let floor = |x: &Float| Float::with_val(x.prec(), x.floor_ref());
    let whole = low.is_integer() || high.is_integer();
    !whole && low.is_finite() && floor(low) == floor(high)
}

fn positive_power(x: &Ball, y: &Ball, prec: u32) -> Evaluated {
    let (r, s) = (x.rad(), y.rad());
    if r.is_zero() && s.is_zero() {
        return finish(by_words::pow(x.mid(), y.mid(), prec), Mag::ZERO);
    }
    let turn = r.div(x.mignitude());
    let mut delta = Mag::above(y.mid()).mul(turn);
    if !s.is_zero() {
        let log = nearest(BITS, x.mid().ln_ref());
        delta = delta.add(s.mul(above_rounded(&log).add(turn)));
    }
    if delta <= Mag::power_of_two(NARROW) {
        let value = by_words::pow(x.mid(), y.mid(), prec);
        if value.0.is_finite() {
            let size = above_rounded(&value);
            return finish(value, size.mul(expm1_above(delta)));
        }
    }
    corners(&ends(x, prec), &ends(y, prec), prec)
}

/// `x^y` over a box with x ≥ 0, and y > 0 where x may be zero.
fn corners(x: &[Float; 2], y: &[Float; 2], prec: u32) -> Evaluated {
    let mut found: Option<[Float; 2]> = None;
    for a in x {
        for b in y {
            let low = super::support::down(prec + 8, a.pow(b));
            let high = super::support::up(prec + 8, a.pow(b));
            found = Some(match found.take() {
                None => [low, high],
                Some([l, h]) => [
                    if low < l { low } else { l },
                    if high > h { high } else { h },
                ],
            });
        }
    }
    let [low, high] = found.ok_or(super::support::WIDE)?;
    hull(prec, &low, &high)
}
