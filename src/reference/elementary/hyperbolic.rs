//! Hyperbolic functions and their inverses.

use super::arithmetic::above_rounded;
use super::coarse;
use super::exponential::expm1_above;
use super::support::{
    BITS, NARROW, directed, doubles, ends, exp_above, f64_below, finish, hull_of_doubles,
    increasing, is_narrow, nearest, off, one_more,
};
use super::trigonometric::{inside, root_below};
use super::{Evaluated, NoValue};
use crate::{Ball, Mag};
use rug::Float;
use rug::float::Round;
use rug::ops::AssignRound;

/// `sinh x`: with `d = x − m`, `sinh x − sinh m = sinh m (cosh d − 1) + cosh m sinh d`, at most
/// `cosh m (e^|d| − 1)`; `cosh m ≤ 1 + |sinh m|`.
pub fn sinh(x: &Ball, prec: u32) -> Evaluated {
    let r = x.rad();
    if r <= Mag::power_of_two(NARROW) {
        let value = nearest(prec, x.mid().sinh_ref());
        if r.is_zero() {
            return finish(value, Mag::ZERO);
        }
        if value.0.is_finite() {
            let size = one_more(above_rounded(&value));
            return finish(value, size.mul(expm1_above(r)));
        }
    }
    match wide(x) {
        Some([sinh, _]) => hull_of_doubles(prec, sinh),
        None => increasing(directed!(sinh_ref), &ends(x, prec), prec),
    }
}

/// The ranges of sinh and cosh over a wide ball, unless its ends are too large.
fn wide(x: &Ball) -> Option<[[f64; 2]; 2]> {
    ranges(doubles(&ends(x, BITS)))
}

/// The same between two ends.
pub(super) fn ranges(both: [f64; 2]) -> Option<[[f64; 2]; 2]> {
    if both.iter().any(|x| !(x.abs() <= coarse::EXPONENTS)) {
        return None;
    }
    // Sum and difference of e^x and e^−x, each off by ERROR of itself, and three roundings.
    let [a, b] = both.map(|x| {
        let (up, down) = (coarse::exp(x), coarse::exp(-x));
        let (sinh, cosh) = (0.5 * (up - down), 0.5 * (up + down));
        (sinh, cosh, 2.0 * coarse::ERROR * cosh)
    });
    let least = match both[0] <= 0.0 && both[1] >= 0.0 {
        true => 1.0,
        false => (a.1 - a.2).min(b.1 - b.2),
    };
    Some([[a.0 - a.2, b.0 + b.2], [least, (a.1 + a.2).max(b.1 + b.2)]])
}

/// `sinh x` and `cosh x`, which share most of their work.
pub(super) fn sinh_cosh(x: &Ball, prec: u32) -> (Evaluated, Evaluated) {
    let r = x.rad();
    if r > Mag::power_of_two(NARROW)
        && let Some([sinh, cosh]) = wide(x)
    {
        return (hull_of_doubles(prec, sinh), hull_of_doubles(prec, cosh));
    }
    if !r.is_zero() {
        return (sinh(x, prec), cosh(x, prec));
    }
    let (mut s, mut c) = (Float::new(prec), Float::new(prec));
    let (a, b) = (&mut s, &mut c).assign_round(x.mid().sinh_cosh_ref(), Round::Nearest);
    (finish((s, a), Mag::ZERO), finish((c, b), Mag::ZERO))
}

/// `cosh x`: with `d = x − m`, `cosh x − cosh m = cosh m (cosh d − 1) + sinh m sinh d`. For r ≤
/// 2^-10 `cosh r − 1 ≤ r²` and `sinh r ≤ r + r²`; `|sinh m|` is at most `cosh m`, and at most
/// `1.1753 |m|` for |m| ≤ 1, where it is convex.
pub fn cosh(x: &Ball, prec: u32) -> Evaluated {
    let r = x.rad();
    if r <= Mag::power_of_two(NARROW) {
        let value = nearest(prec, x.mid().cosh_ref());
        if r.is_zero() {
            return finish(value, Mag::ZERO);
        }
        if value.0.is_finite() {
            let size = above_rounded(&value);
            let m = Mag::above(x.mid());
            let slope = if m <= Mag::power_of_two(0) {
                m.mul(Mag::from_f64(1.1753))
            } else {
                size
            };
            let curved = size.mul(r.mul(r)).add(slope.mul(expm1_above(r)));
            return finish(value, curved);
        }
    }
    if let Some([_, cosh]) = wide(x) {
        return hull_of_doubles(prec, cosh);
    }
    let [low, high] = ends(x, prec);
    let size = if low >= 0 {
        [low, high]
    } else if high <= 0 {
        [-high, -low]
    } else {
        let top = if -low.clone() > high { -low } else { high };
        [Float::new(BITS), top]
    };
    increasing(directed!(cosh_ref), &size, prec)
}

/// `tanh x`: the derivative `1/cosh² x` is at most 1 and at most `4 e^{−2a}`, with `a` the least |x|.
pub fn tanh(x: &Ball, prec: u32) -> Evaluated {
    let r = x.rad();
    if r.is_zero() {
        return finish(nearest(prec, x.mid().tanh_ref()), Mag::ZERO);
    }
    if r <= Mag::power_of_two(NARROW) {
        // e^{2r} ≤ 1.002.
        let fall = exp_above(-2.0 * f64_below(x.mid())).mul(Mag::from_f64(4.008));
        let slope = fall.min(Mag::power_of_two(0));
        return finish(nearest(prec, x.mid().tanh_ref()), slope.mul(r));
    }
    increasing(directed!(tanh_ref), &ends(x, prec), prec)
}

/// `arsinh x`: the derivative is at most `1/√(1 + a²)`, with `a` the least |x|.
pub fn asinh(x: &Ball, prec: u32) -> Evaluated {
    let r = x.rad();
    if r.is_zero() {
        return finish(nearest(prec, x.mid().asinh_ref()), Mag::ZERO);
    }
    let one = Mag::power_of_two(0);
    if is_narrow(r, one.max(Mag::below(x.mid()))) {
        let a = x.mignitude();
        let root = root_below(one.add_below(a.mul_below(a)));
        return finish(nearest(prec, x.mid().asinh_ref()), r.div(root));
    }
    increasing(directed!(asinh_ref), &ends(x, prec), prec)
}

/// `arcosh x`: the derivative is at most `1/√((x − 1)(x + 1))` at the least x.
pub fn acosh(x: &Ball, prec: u32) -> Evaluated {
    let r = x.rad();
    if !r.is_zero() && *x.mid() > 1 {
        let gap = off(x, 1);
        if is_narrow(r, gap) {
            // x + 1 = (x − 1) + 2
            let more = gap.add_below(Mag::power_of_two(1));
            let root = root_below(gap.mul_below(more));
            return finish(nearest(prec, x.mid().acosh_ref()), r.div(root));
        }
    }
    let [low, high] = ends(x, prec);
    if high < 1 {
        return Err(NoValue::Undefined("acosh of a number below 1"));
    }
    if low < 1 {
        return Err(NoValue::Undecided("acosh of what may be below 1"));
    }
    if r.is_zero() {
        return finish(nearest(prec, x.mid().acosh_ref()), Mag::ZERO);
    }
    increasing(directed!(acosh_ref), &[low, high], prec)
}

/// `artanh x`: the derivative is at most `1/((1 − X)(1 + |m|))`, with X the greatest |x|, since
/// `1 + X ≥ 1 + |m|`. Undefined at ±1 and beyond.
pub fn atanh(x: &Ball, prec: u32) -> Evaluated {
    let r = x.rad();
    if !r.is_zero() {
        let gap = inside(x);
        if is_narrow(r, gap) {
            let more = Mag::power_of_two(0).add_below(Mag::below(x.mid()));
            let propagated = r.div(gap.mul_below(more));
            return finish(nearest(prec, x.mid().atanh_ref()), propagated);
        }
    }
    let [low, high] = ends(x, prec);
    if low >= 1 || high <= -1 {
        return Err(NoValue::Undefined(
            "atanh of a number that is not inside (-1, 1)",
        ));
    }
    if low <= -1 || high >= 1 {
        return Err(NoValue::Undecided(
            "atanh of what may not be inside (-1, 1)",
        ));
    }
    if r.is_zero() {
        return finish(nearest(prec, x.mid().atanh_ref()), Mag::ZERO);
    }
    increasing(directed!(atanh_ref), &[low, high], prec)
}
