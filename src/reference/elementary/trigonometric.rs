//! Circular functions and their inverses.

use super::arithmetic::above_rounded;
use super::coarse;
use super::support::{
    BITS, NARROW, Rounded, WIDE, decreasing, directed, doubles, down, ends, exact, f64_below,
    finish, hull, hull_of_doubles, increasing, is_narrow, nearest, one_more,
};
use super::{Evaluated, NoValue};
use crate::arithmetic::nearest as by_words;
use crate::{Ball, Mag};
use rug::float::{Constant, Round};
use rug::{Assign, Float};
use std::cmp::Ordering;

/// Numbers beyond 2 to this power are not reduced by multiples of π: that many of its bits would be
/// needed. A function that is bounded is between its bounds there.
const REDUCED: i32 = 1 << 17;

/// An upper bound on π.
const PI: f64 = 3.1415926535897936;

/// Returns true if x can be reduced by multiples of π.
fn is_reduced(x: &Float) -> bool {
    x.get_exp().is_none_or(|e| e <= REDUCED)
}

/// `[−1, 1]`
fn unit(prec: u32) -> Evaluated {
    Ok(exact(prec, 0).widened(Mag::power_of_two(0)))
}

/// sin or cos from its rounded value: with `c` the other one at the midpoint, by Taylor's theorem
/// `|f(x) − f(m)| ≤ |c| r + r²/2`, and `|c| = √(1 − f(m)²)`; near an extremum c is evaluated.
fn wave(value: Rounded, r: Mag, other: impl FnOnce() -> Float) -> Evaluated {
    if r.is_zero() {
        return finish(value, Mag::ZERO);
    }
    let v = f64_below(&value.0);
    let slope = if v > 0.99 || value.0.prec() < 32 {
        above_rounded(&(other(), Ordering::Less))
    } else {
        // The value is off by 2^-32 of itself at most.
        Mag::from_f64(1.0 - v * v + 2f64.powi(-30)).sqrt()
    };
    let curved = slope.mul(r).add(r.mul(r).shift(-1));
    finish(value, r.min(curved))
}

/// `sin x`.
///
/// Over a wide ball of width below π the derivative has no zero if it has the same sign at both
/// ends, and one otherwise, where the function is ±1.
pub fn sin(x: &Ball, prec: u32) -> Evaluated {
    if !is_reduced(x.mid()) {
        return unit(prec);
    }
    if x.rad() <= Mag::power_of_two(NARROW) {
        let other = || Float::with_val(BITS, x.mid().cos_ref());
        return wave(by_words::sin(x.mid(), prec), x.rad(), other);
    }
    let [sine, _] = wide_waves(x, 3.1, sine_cosine, prec);
    hull_of_doubles(prec, sine)
}

/// `cos x`, as [`sin`].
pub fn cos(x: &Ball, prec: u32) -> Evaluated {
    if !is_reduced(x.mid()) {
        return unit(prec);
    }
    if x.rad() <= Mag::power_of_two(NARROW) {
        let other = || Float::with_val(BITS, x.mid().sin_ref());
        return wave(by_words::cos(x.mid(), prec), x.rad(), other);
    }
    let [_, cosine] = wide_waves(x, 3.1, sine_cosine, prec);
    hull_of_doubles(prec, cosine)
}

/// `sin x` and `cos x`, which share most of their work.
pub(super) fn sin_cos(x: &Ball, prec: u32) -> Result<[Ball; 2], NoValue> {
    if !is_reduced(x.mid()) {
        return Ok([unit(prec)?, unit(prec)?]);
    }
    if x.rad() <= Mag::power_of_two(NARROW) {
        let [sine, cosine] = by_words::sin_cos(x.mid(), prec);
        let other = [&cosine, &sine].map(|x| Float::with_val(BITS, &x.0));
        let [of_cosine, of_sine] = other;
        let sine = wave(sine, x.rad(), || of_cosine)?;
        return Ok([sine, wave(cosine, x.rad(), || of_sine)?]);
    }
    let [sine, cosine] = wide_waves(x, 3.1, sine_cosine, prec);
    Ok([hull_of_doubles(prec, sine)?, hull_of_doubles(prec, cosine)?])
}

/// Sine and cosine of a number that is rounded in a direction, off by less than
/// [`coarse::ERROR`].
fn sine_cosine(x: &Float, round: Round) -> (f64, f64) {
    let near = x.to_f64_round(round);
    if near.abs() <= coarse::TURNS {
        return coarse::sine_cosine(near);
    }
    let (mut sine, mut cosine) = (Float::new(53), Float::new(53));
    (&mut sine, &mut cosine).assign(x.sin_cos_ref());
    (sine.to_f64(), cosine.to_f64())
}

/// The range of a wave between two ends less than half a period apart, whose derivative has the
/// sign of the slopes: the values at both ends, and 1 or −1 if it may change its sign.
fn range(values: [f64; 2], slopes: [f64; 2]) -> [f64; 2] {
    let mut low = (values[0].min(values[1]) - coarse::ERROR).max(-1.0);
    let mut high = (values[0].max(values[1]) + coarse::ERROR).min(1.0);
    if slopes[0] > -coarse::ERROR && slopes[1] < coarse::ERROR {
        high = 1.0;
    }
    if slopes[0] < coarse::ERROR && slopes[1] > -coarse::ERROR {
        low = -1.0;
    }
    [low, high]
}

/// The ranges of sine and cosine between two ends; none where they are far from zero.
pub(super) fn waves([a, b]: [f64; 2]) -> Option<[[f64; 2]; 2]> {
    if !(a.abs() <= coarse::TURNS && b.abs() <= coarse::TURNS) {
        return None;
    }
    if b - a > 3.1 {
        return Some([[-1.0, 1.0]; 2]);
    }
    let [(s, c), (t, d)] = [a, b].map(coarse::sine_cosine);
    Some([range([s, t], [c, d]), range([c, d], [-s, -t])])
}

/// The ranges of a sine and a cosine over a ball, from their values at a number. At most `width` is
/// less than half a period.
fn wide_waves(
    x: &Ball,
    width: f64,
    at: impl Fn(&Float, Round) -> (f64, f64),
    prec: u32,
) -> [[f64; 2]; 2] {
    const WHOLE: [[f64; 2]; 2] = [[-1.0, 1.0]; 2];
    if x.rad() > Mag::from_f64(width / 2.0) {
        return WHOLE;
    }
    let [a, b] = ends(x, prec);
    // The ends were rounded outwards.
    if down(BITS, &b - &a) > width + 0.01 || !is_reduced(&a) || !is_reduced(&b) {
        return WHOLE;
    }
    let ((s, c), (t, d)) = (at(&a, Round::Down), at(&b, Round::Up));
    [range([s, t], [c, d]), range([c, d], [-s, -t])]
}

/// `tan x`. With `d = x − m` and `t = tan m`: `tan x − t = tan d (1 + t²)/(1 − t tan d)`, and
/// `tan r ≤ T = r + r³/2` for r ≤ 1/2 (the difference over r³ increases, to 0.371). The radius is
/// `T (1 + t²)/(1 − |t| T)`.
///
/// Over a wide ball of width below π there is no pole if cos has the same sign at both ends; then
/// tan increases.
pub fn tan(x: &Ball, prec: u32) -> Evaluated {
    if !is_reduced(x.mid()) {
        return Err(NoValue::Undecided(
            "the argument of tan is too large to be reduced",
        ));
    }
    tangent(
        x,
        x.rad(),
        nearest(prec, x.mid().tan_ref()),
        prec,
        |a, b| {
            let turn = down(BITS, b - a);
            if !(turn < 3.1) || !is_reduced(a) || !is_reduced(b) {
                return None;
            }
            let (c, d) = (
                Float::with_val(BITS, a.cos_ref()),
                Float::with_val(BITS, b.cos_ref()),
            );
            let same = c.is_sign_negative() == d.is_sign_negative();
            let tan = directed!(tan_ref);
            (same && !c.is_zero() && !d.is_zero())
                .then(|| [tan(a, prec + 8, Round::Down), tan(b, prec + 8, Round::Up)])
        },
    )
}

/// tan with a radius `r` in radians and its values at both ends, where no pole is between them.
fn tangent(
    x: &Ball,
    r: Mag,
    value: Rounded,
    prec: u32,
    at_ends: impl Fn(&Float, &Float) -> Option<[Float; 2]>,
) -> Evaluated {
    if r.is_zero() {
        return finish(value, Mag::ZERO);
    }
    if r <= Mag::power_of_two(NARROW) {
        let size = above_rounded(&value);
        let turn = r.add(r.mul(r).mul(r).shift(-1));
        let share = size.mul(turn);
        if share <= Mag::power_of_two(-4) {
            let rest = Mag::power_of_two(0).sub_below(share);
            let propagated = turn.mul(one_more(size.mul(size))).div(rest);
            return finish(value, propagated);
        }
    }
    let [a, b] = ends(x, prec);
    match at_ends(&a, &b) {
        Some([low, high]) => hull(prec, &low, &high),
        None => Err(NoValue::Undecided("a pole of tan may be in the operand")),
    }
}

/// `sin πx`: as [`sin`] with the radius πr.
pub fn sinpi(x: &Ball, prec: u32) -> Evaluated {
    let r = x.rad().mul(Mag::from_f64(PI));
    if r <= Mag::power_of_two(NARROW) {
        let other = || Float::with_val(BITS, x.mid().cos_pi_ref());
        return wave(nearest(prec, x.mid().sin_pi_ref()), r, other);
    }
    hull_of_doubles(prec, wide_waves(x, 0.98, sine_cosine_pi, prec)[0])
}

/// `cos πx`: as [`cos`] with the radius πr.
pub fn cospi(x: &Ball, prec: u32) -> Evaluated {
    let r = x.rad().mul(Mag::from_f64(PI));
    if r <= Mag::power_of_two(NARROW) {
        let other = || Float::with_val(BITS, x.mid().sin_pi_ref());
        return wave(nearest(prec, x.mid().cos_pi_ref()), r, other);
    }
    hull_of_doubles(prec, wide_waves(x, 0.98, sine_cosine_pi, prec)[1])
}

/// `sin πx` and `cos πx`, off by less than [`coarse::ERROR`].
fn sine_cosine_pi(x: &Float, _: Round) -> (f64, f64) {
    let of = |value: Float| value.to_f64();
    (
        of(Float::with_val(53, x.sin_pi_ref())),
        of(Float::with_val(53, x.cos_pi_ref())),
    )
}

/// `tan πx`: as [`tan`] with the radius πr; undefined at half-integers.
pub fn tanpi(x: &Ball, prec: u32) -> Evaluated {
    let value = nearest(prec, x.mid().tan_pi_ref());
    let r = x.rad().mul(Mag::from_f64(PI));
    if r.is_zero() && value.0.is_infinite() && Float::with_val(BITS, x.mid().cos_pi_ref()).is_zero()
    {
        return Err(NoValue::Undefined("tanpi at half an odd integer"));
    }
    tangent(x, r, value, prec, |a, b| {
        if !(down(BITS, b - a) < 0.99) {
            return None;
        }
        let cos = |x: &Float| Float::with_val(BITS, x.cos_pi_ref());
        let (c, d) = (cos(a), cos(b));
        let same = c.is_sign_negative() == d.is_sign_negative();
        let tan = directed!(tan_pi_ref);
        (same && !c.is_zero() && !d.is_zero())
            .then(|| [tan(a, prec + 8, Round::Down), tan(b, prec + 8, Round::Up)])
    })
}

/// A lower bound on `1 − |x|` over the ball; zero if it reaches beyond ±1.
pub(super) fn inside(x: &Ball) -> Mag {
    let size = x.mid().as_abs();
    let gap = Float::with_val_round(BITS, 1 - &*size, Round::Down).0;
    if gap.is_sign_negative() {
        return Mag::ZERO;
    }
    Mag::below(&gap).sub_below(x.rad())
}

/// Returns true if the ball lies in `[−1, 1]`.
fn in_unit(x: &Ball, prec: u32) -> Result<[Float; 2], NoValue> {
    let [low, high] = ends(x, prec);
    if low >= -1 && high <= 1 {
        return Ok([low, high]);
    }
    Err(if low > 1 || high < -1 {
        NoValue::Undefined("the inverse sine or cosine of a number beyond 1")
    } else {
        NoValue::Undecided("the inverse sine or cosine of what may be beyond 1")
    })
}

/// Returns the radius that an inverse of sin or cos propagates: the derivative is at most
/// `1/√((1 − X)(1 + |m|))`, with X the greatest |x|. None where that is no good bound.
fn of_arc(x: &Ball) -> Option<Mag> {
    let gap = inside(x);
    if !is_narrow(x.rad(), gap) {
        return None;
    }
    // (1 − |m|)(1 + |m|) over the narrow ball, from below.
    let more = Mag::power_of_two(0).add_below(Mag::below(x.mid()));
    Some(x.rad().div(root_below(gap.mul_below(more))))
}

/// A lower bound on a root: `√x ≥ u (1 − 2^-50)` with `u` the upper bound on it.
pub(super) fn root_below(x: Mag) -> Mag {
    x.sqrt().mul_below(Mag::from_f64(1.0 - 4.0 * f64::EPSILON))
}

/// `arcsin x`, in `[−π/2, π/2]`.
pub fn asin(x: &Ball, prec: u32) -> Evaluated {
    if !x.rad().is_zero()
        && let Some(propagated) = of_arc(x)
    {
        return finish(nearest(prec, x.mid().asin_ref()), propagated);
    }
    let both = in_unit(x, prec)?;
    if x.rad().is_zero() {
        return finish(nearest(prec, x.mid().asin_ref()), Mag::ZERO);
    }
    increasing(directed!(asin_ref), &both, prec)
}

/// `arccos x`, in `[0, π]`.
pub fn acos(x: &Ball, prec: u32) -> Evaluated {
    if !x.rad().is_zero()
        && let Some(propagated) = of_arc(x)
    {
        return finish(nearest(prec, x.mid().acos_ref()), propagated);
    }
    let both = in_unit(x, prec)?;
    if x.rad().is_zero() {
        return finish(nearest(prec, x.mid().acos_ref()), Mag::ZERO);
    }
    decreasing(directed!(acos_ref), &both, prec)
}

/// Widened by [`coarse::ERROR`] of each end.
pub(super) fn outwards([low, high]: [f64; 2]) -> [f64; 2] {
    [
        low - coarse::ERROR * low.abs(),
        high + coarse::ERROR * high.abs(),
    ]
}

/// `arctan x`: the derivative is at most `1/(1 + a²)`, with `a` the least |x|.
pub fn atan(x: &Ball, prec: u32) -> Evaluated {
    if x.rad().is_zero() {
        return finish(by_words::atan(x.mid(), prec), Mag::ZERO);
    }
    let scale = Mag::power_of_two(0).max(Mag::below(x.mid()));
    if !is_narrow(x.rad(), scale) {
        let both = ends(x, prec);
        let at = doubles(&both).map(|x| coarse::atan2(x, 1.0));
        if let [Some(low), Some(high)] = at {
            return hull_of_doubles(prec, outwards([low, high]));
        }
        return increasing(directed!(atan_ref), &both, prec);
    }
    let a = x.mignitude();
    let divisor = Mag::power_of_two(0).add_below(a.mul_below(a));
    finish(by_words::atan(x.mid(), prec), x.rad().div(divisor))
}

/// The angle of the point `(x, y)` in `(−π, π]`; zero at the origin.
///
/// The gradient is `(−y, x)/|z|²`: the radius is at most `(|y| r_x + |x| r_y)/|z|²` with upper
/// bounds on |x| and |y| and a lower one on |z| over the box, which does not meet the cut x ≤ 0,
/// y = 0 from below. Over a wide box the extremes are at corners: the angle is monotone in x for
/// each y, and in y for each x.
pub fn atan2(y: &Ball, x: &Ball, prec: u32) -> Evaluated {
    if y.is_zero() {
        let [low, high] = ends(x, prec);
        return if low >= 0 {
            Ok(exact(prec, 0))
        } else if high < 0 {
            finish(nearest(prec, Constant::Pi), Mag::ZERO)
        } else {
            Err(NoValue::Undecided("atan2 jumps at the origin"))
        };
    }
    let certain = !y.contains_zero() || x.is_positive();
    if certain {
        let (r, s) = (x.rad(), y.rad());
        if r.is_zero() && s.is_zero() {
            return finish(by_words::atan2(y.mid(), x.mid(), prec), Mag::ZERO);
        }
        let (a, b) = (x.mignitude(), y.mignitude());
        let away = a.mul_below(a).add_below(b.mul_below(b));
        let far = a.max(b);
        if is_narrow(r, far) && is_narrow(s, far) {
            let turn = y.magnitude().mul(r).add(x.magnitude().mul(s));
            let value = by_words::atan2(y.mid(), x.mid(), prec);
            return finish(value, turn.div(away));
        }
    }
    let ([a, b], [c, d]) = (ends(x, prec), ends(y, prec));
    if !certain {
        if a <= 0 && c < 0 && d >= 0 {
            return Err(NoValue::Undecided("atan2 jumps at the negative x-axis"));
        }
        if a <= 0 && b >= 0 && c <= 0 && d >= 0 {
            return Err(NoValue::Undecided("atan2 turns about the origin"));
        }
    }
    let (xs, ys) = (
        doubles(&[a.clone(), b.clone()]),
        doubles(&[c.clone(), d.clone()]),
    );
    // Rounded outwards, a box that meets the cut from above may meet it from below.
    if certain || ys[0] >= 0.0 {
        let corners = [(0, 0), (0, 1), (1, 0), (1, 1)].map(|(i, j)| coarse::atan2(ys[j], xs[i]));
        if let [Some(p), Some(q), Some(r), Some(s)] = corners {
            let range = [p.min(q).min(r.min(s)), p.max(q).max(r.max(s))];
            return hull_of_doubles(prec, outwards(range));
        }
    }
    let mut found: Option<[Float; 2]> = None;
    for x in [&a, &b] {
        for y in [&c, &d] {
            let at = |round| Float::with_val_round(prec + 8, y.atan2_ref(x), round).0;
            let (low, high) = (at(Round::Down), at(Round::Up));
            found = Some(match found.take() {
                None => [low, high],
                Some([l, h]) => [
                    if low < l { low } else { l },
                    if high > h { high } else { h },
                ],
            });
        }
    }
    let [low, high] = found.ok_or(WIDE)?;
    hull(prec, &low, &high)
}
