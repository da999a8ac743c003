//! Functions with jumps: integers nearby, remainders, signs.
//!
//! Over a ball in which no jump lies the value is exact. Over two or more steps the ball holds the
//! values of all of them, from the least to the greatest.

use super::arithmetic::fabs;
use super::support::{Directed, ends, finish, float_above, hull, nearest, unsigned, with_prec};
use super::{Evaluated, NoValue};
use crate::{Ball, Mag};
use rug::Float;
use rug::float::{Round, exp_max};

/// An integer-valued increasing function, exact at a float of the same precision.
fn step(x: &Ball, prec: u32, f: impl Directed) -> Evaluated {
    let [low, high] = ends(x, prec);
    let at = |x: &Float| unsigned(f(x, x.prec(), Round::Nearest));
    let (a, b) = (at(&low), at(&high));
    if a == b && a.is_finite() {
        return integer(a, prec);
    }
    hull(prec, &a, &b)
}

/// An exact integer, with more bits than `prec` where it has more.
fn integer(n: Float, prec: u32) -> Evaluated {
    let rounded = nearest(prec, &n);
    if rounded.1.is_eq() {
        return finish(rounded, Mag::ZERO);
    }
    Ok(Ball::new(n, Mag::ZERO))
}

macro_rules! step {
    ($(#[$doc:meta])* $name:ident, $method:ident) => {
        $(#[$doc])*
        pub fn $name(x: &Ball, prec: u32) -> Evaluated {
            step(x, prec, |x: &Float, prec, round| {
                Float::with_val_round(prec, x.$method(), round).0
            })
        }
    };
}
step!(
    /// The greatest integer that is not above x.
    floor, floor_ref
);
step!(
    /// The least integer that is not below x.
    ceil, ceil_ref
);
step!(
    /// The nearest integer, halves away from zero.
    round, round_ref
);
step!(
    /// The integer towards zero.
    trunc, trunc_ref
);
step!(
    /// The nearest integer, halves to the even one.
    nearbyint, round_even_ref
);

/// `x − n y` at the midpoints, exactly, and a bound on what it is off by at other points while `n`
/// stays the same: `r_x + |n| r_y`, `|n| ≤ |x|/|y| + 1`.
///
/// The remainder is a multiple of the lesser unit in the last place and less than both `2|x|` and
/// `|y|`: the precision of the one with that unit holds it, with a bit to spare.
fn remainder_at(x: &Ball, y: &Ball, nearest: bool) -> (Float, Mag) {
    let bits = x.mid().prec().max(y.mid().prec()) + 2;
    let value = if nearest {
        Float::with_val(bits, x.mid().remainder_ref(y.mid()))
    } else {
        Float::with_val(bits, x.mid() % y.mid())
    };
    if y.rad().is_zero() {
        return (value, x.rad());
    }
    let quotient = Mag::above(x.mid()).div(Mag::below(y.mid()));
    let n = super::support::one_more(quotient);
    (value, x.rad().add(n.mul(y.rad())))
}

/// The divisor's least magnitude, where it is no zero.
fn modulus(y: &Ball) -> Result<Mag, NoValue> {
    if y.is_zero() {
        return Err(NoValue::Undefined("the remainder of a division by zero"));
    }
    let least = y.mignitude();
    if least.is_zero() {
        return Err(NoValue::Undecided("the divisor may be zero"));
    }
    Ok(least)
}

/// `x − n y` with n = x/y rounded towards zero: the sign of x, less than |y|.
///
/// With `v` the remainder of the midpoints and `δ` what `x − n y` is off by over the box with the
/// same n, that n is the quotient of every point if `v − δ` has the sign of x (or is zero) and
/// `|v| + δ < |y|`; for n = 0 if `|x| < |y|`. Otherwise the ball holds all remainders of the box: up
/// to `min(|x|, |y|)`, on the side of x.
pub fn fmod(x: &Ball, y: &Ball, prec: u32) -> Evaluated {
    let least = modulus(y)?;
    if x.magnitude() < least {
        return with_prec(x, prec);
    }
    if x.is_finite() {
        let (value, off) = remainder_at(x, y, false);
        let same =
            off.is_zero() || (off <= Mag::below(&value) && Mag::above(&value).add(off) < least);
        if same {
            return finish(nearest(prec, &unsigned(value)), off);
        }
    }
    let reach = float_above(x.magnitude().min(y.magnitude()));
    let zero = Float::new(prec);
    let [low, high] = ends(x, prec);
    let low_end = if low >= 0 {
        zero.clone()
    } else {
        -reach.clone()
    };
    let high_end = if high <= 0 { zero } else { reach };
    hull(prec, &low_end, &high_end)
}

/// `x − n y` with n the integer nearest to x/y, halves to the even one (IEEE 754).
///
/// With `v` and `δ` as in [`fmod`], n is the same over the box if `|v| + δ < |y|/2`. Otherwise the
/// ball is `[−|y|/2, |y|/2]`.
pub fn remainder(x: &Ball, y: &Ball, prec: u32) -> Evaluated {
    let least = modulus(y)?;
    if x.magnitude() < least.shift(-1) {
        return with_prec(x, prec);
    }
    if x.is_finite() {
        let (value, off) = remainder_at(x, y, true);
        if off.is_zero() || Mag::above(&value).add(off) < least.shift(-1) {
            return finish(nearest(prec, &unsigned(value)), off);
        }
    }
    let half = float_above(y.magnitude().shift(-1));
    hull(prec, &-half.clone(), &half)
}

/// `|x|` with the sign of y; a zero is positive. Both signs if y may have either.
pub fn copysign(x: &Ball, y: &Ball, prec: u32) -> Evaluated {
    let size = fabs(x, prec)?;
    let [low, high] = ends(y, prec);
    if low >= 0 {
        return Ok(size);
    }
    if high < 0 {
        return Ok(-size);
    }
    let top = float_above(size.magnitude());
    if top.is_infinite() || top.get_exp() == Some(exp_max()) {
        return Err(super::support::WIDE);
    }
    hull(prec, &-top.clone(), &top)
}
