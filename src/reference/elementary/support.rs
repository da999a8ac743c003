//! Midpoints, radii and ends that all functions share.

use super::{Evaluated, NoValue};
use crate::{Ball, Mag};
use rug::Float;
use rug::float::{Round, exp_max, exp_min};
use rug::ops::{AddAssignRound, AssignRound, SubAssignRound};
use std::cmp::Ordering;

/// Up to this radius, relative to the distance from the nearest singularity, a bound on the
/// derivative over the ball is nearly the derivative itself.
pub(super) const NARROW: i64 = -10;

/// Bits of a number that only has to bound another.
pub(super) const BITS: u32 = 64;

/// A value rounded to nearest, with its ternary value.
pub(super) type Rounded = (Float, Ordering);

/// Rounds to nearest.
pub(super) fn nearest<T>(prec: u32, value: T) -> Rounded
where
    Float: AssignRound<T, Round = Round, Ordering = Ordering>,
{
    Float::with_val_round(prec, value, Round::Nearest)
}

/// Rounds towards minus infinity.
pub(super) fn down<T>(prec: u32, value: T) -> Float
where
    Float: AssignRound<T, Round = Round, Ordering = Ordering>,
{
    Float::with_val_round(prec, value, Round::Down).0
}

/// Rounds towards plus infinity.
pub(super) fn up<T>(prec: u32, value: T) -> Float
where
    Float: AssignRound<T, Round = Round, Ordering = Ordering>,
{
    Float::with_val_round(prec, value, Round::Up).0
}

pub(super) const WIDE: NoValue = NoValue::Undecided("the operand is too wide");

/// The ball of a value that was rounded to nearest, with what is propagated from the operands.
///
/// The rounding error is at most half a unit in the last place; where MPFR's exponents end below,
/// at most the least positive number `2^(emin − 1)`. A value that was rounded to infinity is at
/// least `(3/4) 2^emax` in magnitude; where at most `2^(emax − 2)` is propagated, every value of
/// the ball is beyond `2^(emax − 1)`.
pub(super) fn finish((mid, ordering): Rounded, propagated: Mag) -> Evaluated {
    let Some(e) = mid.get_exp() else {
        if mid.is_zero() {
            let rounding = match ordering {
                Ordering::Equal => Mag::ZERO,
                _ => least(),
            };
            return bounded(mid, propagated.add(rounding));
        }
        if mid.is_infinite() && propagated <= Mag::power_of_two(i64::from(exp_max()) - 2) {
            let negative = mid.is_sign_negative();
            return Err(NoValue::Overflow { negative });
        }
        return Err(WIDE);
    };
    let rounding = if ordering == Ordering::Equal {
        Mag::ZERO
    } else if e == exp_min() {
        least()
    } else {
        Mag::power_of_two(i64::from(e) - i64::from(mid.prec()) - 1)
    };
    bounded(mid, propagated.add(rounding))
}

/// The least positive number of MPFR.
pub(super) fn least() -> Mag {
    Mag::power_of_two(i64::from(exp_min()) - 1)
}

fn bounded(mid: Float, rad: Mag) -> Evaluated {
    if rad.is_finite() {
        Ok(Ball::new(mid, rad))
    } else {
        Err(WIDE)
    }
}

/// The ball at another precision, without the losses at the ends of MPFR's exponents.
pub(super) fn with_prec(x: &Ball, prec: u32) -> Evaluated {
    finish(nearest(prec, x.mid()), x.rad())
}

/// An exact ball.
pub(super) fn exact(prec: u32, n: i32) -> Ball {
    Ball::new(Float::with_val(prec.max(32), n), Mag::ZERO)
}

/// A radius as a float, rounded up at the lower end of the exponents.
pub(super) fn float_above(rad: Mag) -> Float {
    match rad.exponent() {
        Some(e) if e < i64::from(exp_min()) - 1 => Float::with_val(53, 1) << (exp_min() - 1),
        Some(e) if e >= i64::from(exp_max()) => Float::with_val(53, f64::INFINITY),
        _ => rad.to_float(),
    }
}

/// The lower and the upper end of a ball, rounded outwards; infinite for an unbounded ball. A zero
/// is positive.
///
/// As many bits are kept as the sum has, up to `prec` and 64 more than the midpoint has.
pub(super) fn ends(x: &Ball, prec: u32) -> [Float; 2] {
    let mid = x.mid();
    if x.rad().is_zero() {
        return [unsigned(mid.clone()), unsigned(mid.clone())];
    }
    let gap = match (mid.get_exp(), x.rad().exponent()) {
        (Some(m), Some(r)) => i64::from(m) - r,
        _ => 0,
    };
    let most = i64::from(mid.prec()) + i64::from(prec) + i64::from(BITS);
    let bits = (gap + i64::from(BITS)).clamp(i64::from(BITS), most) as u32;
    let bits = bits.max(mid.prec());
    let rad = float_above(x.rad());
    let mut low = Float::with_val(bits, mid);
    let mut high = low.clone();
    low.sub_assign_round(&rad, Round::Down);
    high.add_assign_round(&rad, Round::Up);
    [unsigned(low), unsigned(high)]
}

/// Zero without its sign.
pub(super) fn unsigned(x: Float) -> Float {
    if x.is_zero() { x.abs() } else { x }
}

/// The ball that holds `[low, high]`; ends that are beyond MPFR's exponents on the same side are an
/// overflow, others undecided.
pub(super) fn hull(prec: u32, low: &Float, high: &Float) -> Evaluated {
    let beyond = |x: &Float| x.is_infinite() || x.get_exp() == Some(exp_max());
    if low.is_nan() || high.is_nan() {
        return Err(WIDE);
    }
    if low.is_infinite() || high.is_infinite() {
        // An end of exponent emax is at least 2^(emax − 1) in magnitude.
        if beyond(low) && beyond(high) && low.is_sign_negative() == high.is_sign_negative() {
            let negative = low.is_sign_negative();
            return Err(NoValue::Overflow { negative });
        }
        return Err(WIDE);
    }
    if low == high {
        return finish(nearest(prec, low), Mag::ZERO);
    }
    let ball = Ball::between(prec, low, high);
    // The sum of the ends may be beyond the exponents.
    if ball.is_finite() {
        Ok(ball)
    } else {
        Err(WIDE)
    }
}

/// The ends of an interval as doubles, rounded outwards.
pub(super) fn doubles([low, high]: &[Float; 2]) -> [f64; 2] {
    [low.to_f64_round(Round::Down), high.to_f64_round(Round::Up)]
}

/// The ball that holds `[low, high]`.
pub(super) fn hull_of_doubles(prec: u32, [low, high]: [f64; 2]) -> Evaluated {
    let mid = low / 2.0 + high / 2.0;
    // Each difference is rounded to nearest.
    let rad = (high - mid).max(mid - low).next_up();
    finish(nearest(prec, mid), Mag::from_f64(rad))
}

/// A function that rounds as it is told.
pub(super) trait Directed: Fn(&Float, u32, Round) -> Float {}
impl<F: Fn(&Float, u32, Round) -> Float> Directed for F {}

/// An increasing function over `[low, high]`.
pub(super) fn increasing(f: impl Directed, [low, high]: &[Float; 2], prec: u32) -> Evaluated {
    hull(
        prec,
        &f(low, prec + 8, Round::Down),
        &f(high, prec + 8, Round::Up),
    )
}

/// A decreasing function over `[low, high]`.
pub(super) fn decreasing(f: impl Directed, [low, high]: &[Float; 2], prec: u32) -> Evaluated {
    hull(
        prec,
        &f(high, prec + 8, Round::Down),
        &f(low, prec + 8, Round::Up),
    )
}

/// A function of MPFR as [`Directed`].
macro_rules! directed {
    ($method:ident) => {
        |x: &rug::Float, prec: u32, round| rug::Float::with_val_round(prec, x.$method(), round).0
    };
}
pub(super) use directed;

/// The union of balls.
pub(super) fn union(prec: u32, balls: &[&Ball]) -> Evaluated {
    let mut found: Option<[Float; 2]> = None;
    for ball in balls {
        let [low, high] = ends(ball, prec);
        found = Some(match found.take() {
            None => [low, high],
            Some([l, h]) => [
                if low < l { low } else { l },
                if high > h { high } else { h },
            ],
        });
    }
    match found {
        Some([low, high]) => hull(prec, &low, &high),
        None => Err(WIDE),
    }
}

/// An upper bound on `e^t`, at most seven per cent above it.
///
/// With `t log2 e = k + f`, 0 ≤ f < 1, it is `2^k (1 + f)`, because 2^f is convex and 1 + f is its
/// chord.
pub(super) fn exp_above(t: f64) -> Mag {
    if t.is_nan() || t > 1e17 {
        return Mag::INFINITY;
    }
    if t < -1e17 {
        // Beyond any exponent of a float.
        return Mag::power_of_two(-(1 << 40));
    }
    // The product is off by 2^-52 of itself at most, the constant included.
    let v = t * std::f64::consts::LOG2_E;
    let v = v + v.abs() * f64::EPSILON * 2.0;
    let k = v.floor();
    Mag::from_f64((1.0 + (v - k)).next_up()).shift(k as i64)
}

/// `|x|` as a double, rounded down; finite.
pub(super) fn f64_below(x: &Float) -> f64 {
    x.to_f64_round(Round::Zero).abs()
}

/// Returns true if the radius is at most `2^NARROW` times `scale`, a lower bound.
pub(super) fn is_narrow(rad: Mag, scale: Mag) -> bool {
    rad <= scale.shift(NARROW)
}

/// `1 + x` of an upper bound.
pub(super) fn one_more(x: Mag) -> Mag {
    x.add(Mag::power_of_two(0))
}

/// A lower bound on the distance of the ball from `n`; zero if it reaches it.
pub(super) fn off(x: &Ball, n: i32) -> Mag {
    let gap = Float::with_val_round(BITS, x.mid() - n, Round::Zero).0;
    Mag::below(&gap).sub_below(x.rad())
}
