//! The four operations, powers with fixed exponents, roots and lengths.

use super::support::{
    BITS, NARROW, WIDE, directed, ends, exact, finish, float_above, hull, increasing, is_narrow,
    nearest, union,
};
use super::trigonometric::root_below;
use super::{Evaluated, NoValue};
use crate::{Ball, Mag};
use rug::Float;
use rug::float::{Round, exp_max};
use rug::ops::Pow;
use std::cmp::Ordering;

/// `x + y`; radius `r_x + r_y`.
pub fn add(x: &Ball, y: &Ball, prec: u32) -> Evaluated {
    finish(nearest(prec, x.mid() + y.mid()), x.rad().add(y.rad()))
}

/// `x − y`; radius `r_x + r_y`.
pub fn sub(x: &Ball, y: &Ball, prec: u32) -> Evaluated {
    finish(nearest(prec, x.mid() - y.mid()), x.rad().add(y.rad()))
}

/// Returns the radius that the product of two balls propagates: `(|x| + r_x) r_y + |y| r_x`.
fn of_product(x: &Ball, y: &Ball) -> Mag {
    if x.rad().is_zero() && y.rad().is_zero() {
        return Mag::ZERO;
    }
    let y_mid = Mag::above(y.mid());
    x.magnitude().mul(y.rad()).add(y_mid.mul(x.rad()))
}

/// An overflow where every value is beyond the exponents: `least` is a lower bound on them.
fn or_overflow(found: Evaluated, least: Mag, negative: bool) -> Evaluated {
    let beyond = Mag::power_of_two(i64::from(exp_max()) - 1);
    match found {
        Err(NoValue::Undecided(_)) if least.is_finite() && least >= beyond => {
            Err(NoValue::Overflow { negative })
        }
        found => found,
    }
}

/// `x y`; radius `(|x| + r_x) r_y + |y| r_x`. Exactly zero if a factor is, and the other bounded.
pub fn mul(x: &Ball, y: &Ball, prec: u32) -> Evaluated {
    let found = finish(nearest(prec, x.mid() * y.mid()), of_product(x, y));
    let negative = x.mid().is_sign_negative() != y.mid().is_sign_negative();
    or_overflow(found, x.mignitude().mul_below(y.mignitude()), negative)
}

/// `x y + z`; radius `(|x| + r_x) r_y + |y| r_x + r_z`.
pub fn fma(x: &Ball, y: &Ball, z: &Ball, prec: u32) -> Evaluated {
    let value = nearest(prec, x.mid().mul_add_ref(y.mid(), z.mid()));
    finish(value, of_product(x, y).add(z.rad()))
}

/// Refuses a divisor that is zero or may be.
fn divisor(y: &Ball) -> Result<Mag, NoValue> {
    if y.is_zero() {
        return Err(NoValue::Undefined("division by zero"));
    }
    let least = y.mignitude();
    if least.is_zero() {
        return Err(NoValue::Undecided("the divisor may be zero"));
    }
    Ok(least)
}

/// `x / y`. With `x' = x + d`, `y' = y + e`: `x'/y' − x/y = (d − (x/y) e)/y'`, so the radius is
/// `(r_x + |x| r_y/|y|)/(|y| − r_y)`.
pub fn div(x: &Ball, y: &Ball, prec: u32) -> Evaluated {
    let least = divisor(y)?;
    let propagated = if x.rad().is_zero() && y.rad().is_zero() {
        Mag::ZERO
    } else {
        let turned = Mag::above(x.mid()).mul(y.rad()).div(Mag::below(y.mid()));
        x.rad().add(turned).div(least)
    };
    let found = finish(nearest(prec, x.mid() / y.mid()), propagated);
    let negative = x.mid().is_sign_negative() != y.mid().is_sign_negative();
    // m_x 2^a / (m_y 2^b) is more than 2^(a − b − 1).
    let lower = match (x.mignitude().exponent(), y.magnitude().exponent()) {
        (Some(a), Some(b)) => Mag::power_of_two(a - b - 1),
        _ => Mag::ZERO,
    };
    or_overflow(found, lower, negative)
}

/// `1 / x`; radius `r/(|x| (|x| − r))`.
pub fn recip(x: &Ball, prec: u32) -> Evaluated {
    div(&exact(BITS, 1), x, prec)
}

/// `x²`; radius `(2|x| + r) r`. Never negative.
pub fn sqr(x: &Ball, prec: u32) -> Evaluated {
    let (m, r) = (Mag::above(x.mid()), x.rad());
    let found = finish(
        nearest(prec, x.mid().square_ref()),
        m.shift(1).add(r).mul(r),
    );
    let found = or_overflow(found, x.mignitude().mul_below(x.mignitude()), false)?;
    if is_narrow(r, Mag::below(x.mid())) || r.is_zero() {
        return Ok(found);
    }
    let [low, high] = ends(x, prec);
    even_hull(directed!(square_ref), low, high, prec)
}

/// An even function that increases with |x| from f(0) = 0.
fn even_hull(f: impl super::support::Directed, low: Float, high: Float, prec: u32) -> Evaluated {
    if low >= 0 {
        return increasing(f, &[low, high], prec);
    }
    if high <= 0 {
        return increasing(f, &[-high, -low], prec);
    }
    let top = if -low.clone() > high { -low } else { high };
    increasing(f, &[Float::new(BITS), top], prec)
}

/// `x^n`, `x^0 = 1`. With `s = r/(|x| − r)` every point of the ball is `x (1 + t)`, |t| ≤ s, and
/// `|(1 + t)^n − 1| ≤ e^{|n| s} − 1 ≤ δ + δ²` with `δ = |n| s ≤ 1` (`|ln(1 + t)| ≤ |t|/(1 − |t|)`
/// at `t = r/|x|`).
pub fn powi(x: &Ball, n: i64, prec: u32) -> Evaluated {
    match n {
        0 => return Ok(exact(prec, 1)),
        1 => return super::support::with_prec(x, prec),
        2 => return sqr(x, prec),
        _ => {}
    }
    if n < 0 && x.is_zero() {
        return Err(NoValue::Undefined("zero to a negative power"));
    }
    let exponent = Float::with_val(BITS, n);
    integer_power(x, &exponent, prec)
}

/// `x^n` for an integer `n`, which is not zero; x is not zero where n is negative.
pub(super) fn integer_power(x: &Ball, n: &Float, prec: u32) -> Evaluated {
    if x.rad().is_zero() {
        return finish(nearest(prec, x.mid().pow(n)), Mag::ZERO);
    }
    let slope = Mag::above(n);
    let delta = slope.mul(x.rad()).div(x.mignitude());
    if delta <= Mag::power_of_two(NARROW) {
        let value = nearest(prec, x.mid().pow(n));
        let size = above_rounded(&value);
        let found = finish(value, size.mul(delta.add(delta.mul(delta))));
        if !matches!(found, Err(NoValue::Undecided(_))) {
            return found;
        }
    }
    let power = |x: &Float, prec: u32, round| Float::with_val_round(prec, x.pow(n), round).0;
    let [low, high] = ends(x, prec);
    let odd = !Float::with_val(n.prec(), n >> 1u32).is_integer();
    if n.is_sign_positive() {
        return if odd {
            increasing(power, &[low, high], prec)
        } else {
            even_hull(power, low, high, prec)
        };
    }
    if low <= 0 && high >= 0 {
        return Err(NoValue::Undecided("a negative power of what may be zero"));
    }
    // Decreasing in |x|.
    let size = if low > 0 { [low, high] } else { [-high, -low] };
    let found = super::support::decreasing(power, &size, prec);
    if odd && x.mid().is_sign_negative() {
        return negated(found);
    }
    found
}

/// `−x` of what was found.
pub(super) fn negated(found: Evaluated) -> Evaluated {
    match found {
        Ok(ball) => Ok(-ball),
        Err(NoValue::Overflow { negative }) => Err(NoValue::Overflow {
            negative: !negative,
        }),
        other => other,
    }
}

/// An upper bound on the magnitude of what was rounded to nearest.
pub(super) fn above_rounded((value, ordering): &(Float, Ordering)) -> Mag {
    if *ordering == Ordering::Equal {
        return Mag::above(value);
    }
    let mut away = value.clone();
    if away.is_sign_negative() {
        away.next_down();
    } else {
        away.next_up();
    }
    Mag::above(&away)
}

/// `√x`: `|√x − √m| = |x − m|/(√x + √m) ≤ r/√m`.
pub fn sqrt(x: &Ball, prec: u32) -> Evaluated {
    if x.is_zero() {
        return Ok(exact(prec, 0));
    }
    if x.is_negative() {
        return Err(NoValue::Undefined("the square root of a negative number"));
    }
    // Both have 53 bits at most: r ≤ m where r is at most m rounded down to as many.
    if x.mid().is_sign_negative() || x.rad() > Mag::below(x.mid()) {
        return Err(NoValue::Undecided(
            "the square root of what may be negative",
        ));
    }
    let root = nearest(prec, x.mid().sqrt_ref());
    if x.rad().is_zero() {
        return finish(root, Mag::ZERO);
    }
    // The rounded root is off by half of a unit at most: one step below it is a lower bound.
    let mut low = root.0.clone();
    low.next_down();
    finish(root, x.rad().div(Mag::below(&low)))
}

/// `∛x`: `|∛x − ∛m| = |x − m|/(x^{2/3} + (x m)^{1/3} + m^{2/3})`; for r ≤ 2^-10 |m| the divisor is
/// at least `2.99 m^{2/3}`, because each x is at least `(1 − 2^-10) m` in magnitude.
pub fn cbrt(x: &Ball, prec: u32) -> Evaluated {
    let root = nearest(prec, x.mid().cbrt_ref());
    if x.rad().is_zero() {
        return finish(root, Mag::ZERO);
    }
    if !is_narrow(x.rad(), Mag::below(x.mid())) {
        return increasing(directed!(cbrt_ref), &ends(x, prec), prec);
    }
    let low = below_rounded(&root.0);
    let divisor = low.mul_below(low).mul_below(Mag::from_f64(2.99));
    finish(root, x.rad().div(divisor))
}

/// A lower bound on the magnitude of what was rounded to nearest.
pub(super) fn below_rounded(value: &Float) -> Mag {
    let mut low = value.clone().abs();
    low.next_down();
    if low.is_sign_negative() {
        return Mag::ZERO;
    }
    Mag::below(&low)
}

/// `√(x² + y²)`. The gradient is `(x, y)/√(x² + y²)`, of length one: the radius is at most
/// `√(r_x² + r_y²)`, and `(|x| r_x + |y| r_y)/h` with upper bounds on |x| and |y| and a lower one h
/// on the length over the box.
pub fn hypot(x: &Ball, y: &Ball, prec: u32) -> Evaluated {
    let (r, s) = (x.rad(), y.rad());
    let value = nearest(prec, x.mid().hypot_ref(y.mid()));
    if r.is_zero() && s.is_zero() {
        return finish(value, Mag::ZERO);
    }
    let long = r.mul(r).add(s.mul(s)).sqrt();
    let low = x.mignitude().max(y.mignitude());
    let turned = x.magnitude().mul(r).add(y.magnitude().mul(s)).div(low);
    // Of a wide box the least and the greatest length.
    let (a, b) = (x.mignitude(), y.mignitude());
    let is_in_range = low.exponent().is_none_or(|e| e > -(1 << 20));
    if long > low.shift(NARROW) && long.is_finite() && is_in_range {
        let least = root_below(a.mul_below(a).add_below(b.mul_below(b)));
        let (a, b) = (x.magnitude(), y.magnitude());
        let most = a.mul(a).add(b.mul(b)).sqrt();
        return hull(prec, &least.to_float(), &float_above(most));
    }
    or_overflow(finish(value, long.min(turned)), low, false)
}

/// `|x|`; zero is its least value over a ball that holds zero.
pub fn fabs(x: &Ball, prec: u32) -> Evaluated {
    if x.mid().is_sign_negative() {
        return fabs(&-x, prec);
    }
    if !x.contains_zero() || x.is_zero() {
        return super::support::with_prec(x, prec);
    }
    let [low, high] = ends(x, prec);
    let top = if -low.clone() > high { -low } else { high };
    hull(prec, &Float::new(BITS), &top)
}

/// The lesser of two numbers.
pub fn fmin(x: &Ball, y: &Ball, prec: u32) -> Evaluated {
    match order(x, y) {
        Some(Ordering::Greater) => super::support::with_prec(y, prec),
        Some(_) => super::support::with_prec(x, prec),
        None => {
            let ([a, b], [c, d]) = (ends(x, prec), ends(y, prec));
            let low = if a < c { a } else { c };
            let high = if b < d { b } else { d };
            hull(prec, &low, &high)
        }
    }
}

/// The greater of two numbers.
pub fn fmax(x: &Ball, y: &Ball, prec: u32) -> Evaluated {
    negated(fmin(&-x, &-y, prec))
}

/// The positive difference: `x − y`, or zero where that is negative.
pub fn fdim(x: &Ball, y: &Ball, prec: u32) -> Evaluated {
    match order(x, y) {
        Some(Ordering::Greater) => return sub(x, y, prec),
        Some(_) => return Ok(exact(prec, 0)),
        None => {}
    }
    let (high, low) = (ends(x, prec), ends(y, prec));
    let top = super::support::up(prec.max(BITS), &high[1] - &low[0]);
    hull(prec, &Float::new(BITS), &top)
}

/// The order of two numbers, where it is the same at all points (less or equal counts as less).
fn order(x: &Ball, y: &Ball) -> Option<Ordering> {
    let reach = x.rad().add(y.rad());
    if reach.is_zero() {
        return x.mid().partial_cmp(y.mid());
    }
    let gap = Float::with_val_round(BITS, x.mid() - y.mid(), Round::Zero).0;
    if Mag::below(&gap) < reach || !reach.is_finite() {
        return None;
    }
    Some(if gap.is_sign_positive() && !gap.is_zero() {
        Ordering::Greater
    } else {
        Ordering::Less
    })
}

/// The least ball that holds the values at two ends, of a monotone function that is itself a ball.
pub(super) fn between_values(low: Evaluated, high: Evaluated, prec: u32) -> Evaluated {
    match (low, high) {
        (Ok(a), Ok(b)) => union(prec, &[&a, &b]),
        (Err(a), Err(b)) if a == b => Err(a),
        _ => Err(WIDE),
    }
}
