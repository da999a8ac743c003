//! Integrals along the real line: limits that are infinite, or where the integrand is singular, are
//! cut off.

use super::adaptive::{Crossing, Path, adaptive};
use super::nodes::Rule;
use super::{End, Growth, Hindrance, Integrand, Limit, Run, oscillation};
use crate::{Ball, ComplexBall, Mag};
use rug::Float;
use rug::ops::CompleteRound;

/// A real function of the distance t from an origin, `x = origin ± t`.
struct Line<'a> {
    f: &'a mut dyn Integrand,
    /// None for zero.
    origin: Option<Ball>,
    negative: bool,
}

impl Path for Line<'_> {
    type Value = Ball;
    const MIRRORS: bool = true;

    fn value(&mut self, t: &Ball, bits: u32) -> Option<Ball> {
        let (x, bits) = self.place(t, bits);
        self.f.enclose_real(&x, bits)
    }

    fn short_sum(&mut self, rule: &Rule, around: [&Ball; 2]) -> Option<Ball> {
        // The distance from an origin may need more bits.
        if self.origin.is_some() {
            return None;
        }
        rule.short_sum(around, |t| match self.negative {
            true => self.f.enclose_short(&t.negative()),
            false => self.f.enclose_short(t),
        })
    }

    fn has_choices(&mut self) -> bool {
        self.f.has_choices()
    }

    fn is_settled(&mut self, t: &Ball) -> bool {
        let (x, _) = self.place(t, t.prec());
        self.f.is_settled(&x)
    }

    fn crossing(&mut self, between: [&Float; 2]) -> Option<Crossing> {
        let [a, b] = between.map(|t| self.place(&Ball::new(t.clone(), Mag::ZERO), t.prec()).0);
        self.f.crossing([&a, &b])
    }

    fn bound_chosen(&mut self, at: &Float, t: &ComplexBall, bits: u32) -> Option<Mag> {
        let at = Ball::new(at.clone(), Mag::ZERO);
        let (at, _) = self.place(&at, at.prec());
        let (re, bits) = self.place(&t.re, bits);
        let z = ComplexBall::new(re, t.im.clone());
        Some(self.f.enclose_chosen(&at, &z, bits)?.magnitude())
    }

    fn bound(&mut self, t: &ComplexBall, bits: u32) -> Option<Mag> {
        let (re, bits) = self.place(&t.re, bits);
        // A mirrored function is bounded by the same number.
        let z = ComplexBall::new(re, t.im.clone());
        Some(self.f.enclose(&z, true, bits)?.magnitude())
    }
}

impl Line<'_> {
    /// An interval of t as one of x, next to the midpoint of the origin.
    fn interval(&self, (from, to): (Float, Float)) -> (Float, Float) {
        let place = |t: Float| {
            let bits = t.prec();
            let t = if self.negative { -t } else { t };
            match &self.origin {
                Some(a) => Float::with_val(bits.max(a.prec()), a.mid() + t),
                None => t,
            }
        };
        match self.negative {
            true => (place(to), place(from)),
            false => (place(from), place(to)),
        }
    }

    /// x, and the bits to work with: enough that t is known as well as by itself.
    fn place(&self, t: &Ball, bits: u32) -> (Ball, u32) {
        let Some(a) = &self.origin else {
            return (if self.negative { -t } else { t.clone() }, bits);
        };
        let exponent = |x: Mag| x.exponent().unwrap_or(0);
        let gap = exponent(a.magnitude()) - exponent(t.magnitude());
        let finer = u32::try_from(gap).unwrap_or(0);
        let a = a.with_prec(a.prec().max(t.prec() + finer));
        (if self.negative { &a - t } else { &a + t }, bits + finer)
    }
}

/// Half-widths at which an end is looked at, in bits: a bound that needs to be close is tried last.
const DISTANCES: [u32; 9] = [2, 3, 4, 6, 8, 12, 20, 32, 64];

/// Bits of the distance from an end beyond which an integral is taken for one that does not
/// converge fast enough.
const FARTHEST: u32 = 1 << 20;

fn name(end: &End) -> &'static str {
    match end {
        End::Above(_) => "the lower limit",
        End::Below(_) => "the upper limit",
        End::PlusInfinity => "infinity",
        End::MinusInfinity => "minus infinity",
    }
}

/// The integral, as far as it is known.
pub(super) fn integral(
    f: &mut dyn Integrand,
    from: &Limit,
    to: &Limit,
    run: &mut Run,
) -> Option<Ball> {
    let (a, b) = match (from, to) {
        (Limit::Finite(a), Limit::Finite(b)) if (a - b).is_positive() => {
            return Some(-integral(f, to, from, run)?);
        }
        (Limit::PlusInfinity, _) | (_, Limit::MinusInfinity) => {
            return match (from, to) {
                (Limit::PlusInfinity, Limit::PlusInfinity)
                | (Limit::MinusInfinity, Limit::MinusInfinity) => Some(Ball::integer(64, 0)),
                _ => Some(-integral(f, to, from, run)?),
            };
        }
        (Limit::Finite(a), Limit::Finite(b)) if !(b - a).is_positive() => {
            if (b - a).is_zero() {
                return Some(Ball::integer(64, 0));
            }
            // Limits that may be the same number: no more than an enclosure is known.
            let bits = a.prec().max(b.prec());
            return Some(f.enclose_real(&a.union(b), bits)? * (b - a));
        }
        (a, b) => (a, b),
    };
    let lower = match a {
        Limit::Finite(a) => End::Above(a.clone()),
        _ => End::MinusInfinity,
    };
    let upper = match b {
        Limit::Finite(b) => End::Below(b.clone()),
        _ => End::PlusInfinity,
    };
    let singular = [&lower, &upper].map(|end| is_singular(f, end));
    match (a, b, singular) {
        (Limit::Finite(a), Limit::Finite(b), [false, false]) => {
            let line = Line {
                f,
                origin: None,
                negative: false,
            };
            between(line, a, b, &[], run)
        }
        (Limit::Finite(a), _, [false, true]) => {
            let rest = rest(f, a, &upper, run)?;
            towards(f, a, &upper, rest, run)
        }
        (_, Limit::Finite(b), [true, false]) => {
            let rest = rest(f, b, &lower, run)?;
            towards(f, b, &lower, rest, run)
        }
        _ => {
            let middle = match (a, b) {
                (Limit::Finite(a), Limit::Finite(b)) => (a + b).shift(-1).mid().clone(),
                (Limit::Finite(a), _) => Float::with_val(a.prec().max(64), a.mid() + 1u32),
                (_, Limit::Finite(b)) => Float::with_val(b.prec().max(64), b.mid() - 1u32),
                _ => Float::with_val(64, 0),
            };
            // A break at a short number keeps the panels short ones.
            let middle = Ball::new(middle, Mag::ZERO);
            // Nothing is summed unless both ends are known to be integrable.
            let below = rest(f, &middle, &lower, run)?;
            let above = rest(f, &middle, &upper, run)?;
            let left = towards(f, &middle, &lower, below, run)?;
            Some(left + towards(f, &middle, &upper, above, run)?)
        }
    }
}

/// Returns true if the integrand is not enclosed in a neighbourhood of an end.
fn is_singular(f: &mut dyn Integrand, end: &End) -> bool {
    let (a, sign) = match end {
        End::Above(a) => (a, 1),
        End::Below(a) => (a, -1),
        End::PlusInfinity | End::MinusInfinity => return true,
    };
    let bits = a.prec().max(128);
    let near = Float::with_val(bits, sign) >> 60u32;
    let beside = a.with_prec(bits) + Ball::new(near, Mag::ZERO);
    !f.enclose_real(&a.union(&beside), bits)
        .is_some_and(|v| v.is_finite())
}

/// Between two limits in the coordinate of a line; their midpoints are exact, and their radii widen
/// the result.
fn between(mut line: Line, a: &Ball, b: &Ball, inner: &[Float], run: &mut Run) -> Option<Ball> {
    let mut beside = Mag::ZERO;
    for end in [a, b] {
        if !end.rad().is_zero() {
            let values = line.value(end, end.prec()).filter(Ball::is_finite);
            let Some(values) = values else {
                let at = (end.lower(), end.upper());
                run.hinder(Some(line.interval(at)));
                return None;
            };
            beside = beside.add(values.magnitude().mul(end.rad()));
        }
    }
    let mut breaks = vec![a.mid().clone()];
    let within = inner.iter().filter(|x| *x > a.mid() && *x < b.mid());
    breaks.extend(within.cloned());
    breaks.push(b.mid().clone());
    let sum = adaptive(&mut line, &breaks, &mut run.tolerance, &mut run.budget);
    run.hinder(sum.hindered.map(|at| line.interval(at)));
    Some(sum.value?.widened(beside))
}

/// The integral next to an end: its distance from the end is `2^−k`, or `2^k` at infinity.
struct Rest {
    k: u32,
    value: Ball,
}

/// Distances at which a cut is near enough, in bits.
const NEAR: u32 = 8;

/// Places that are tried for the line on which waves decay.
const PLACES: u32 = 8;

/// The place next to an end up to which an integral from an ordinary point is summed, and the rest.
fn rest(f: &mut dyn Integrand, from: &Ball, end: &End, run: &mut Run) -> Option<Rest> {
    let distance = distance(from, end);
    let size = distance.magnitude().exponent().unwrap_or(0);
    let is_infinite = matches!(end, End::PlusInfinity | End::MinusInfinity);
    // The bound has to hold up to a place short of the start.
    let nearest = if is_infinite { size + 2 } else { 2 - size };
    let found = proved_growth(f, end, nearest)
        .and_then(|(growth, k)| cut(&growth, is_infinite, k, run.tail));
    if found.is_none_or(|(k, _)| k > NEAR)
        && let Some(rest) = oscillation(f, &distance, end, run)
    {
        return Some(rest);
    }
    let Some((k, most)) = found else {
        run.hindrance.get_or_insert(Hindrance::End(name(end)));
        return None;
    };
    let value = Ball::integer(64, 0).widened(most);
    Some(Rest { k, value })
}

/// The integral next to an end at which the integrand oscillates, from a place between a start and
/// the end on.
fn oscillation(f: &mut dyn Integrand, start: &Ball, end: &End, run: &mut Run) -> Option<Rest> {
    let is_infinite = matches!(end, End::PlusInfinity | End::MinusInfinity);
    let mut waves = f.waves(end)?;
    let distance = |k: u32| {
        let one = Float::with_val(64, 1);
        Ball::new(if is_infinite { one << k } else { one >> k }, Mag::ZERO)
    };
    let nearest = match (is_infinite, start.mignitude().exponent()) {
        (true, _) => start.magnitude().exponent().unwrap_or(0),
        (false, Some(exponent)) => -exponent,
        (false, None) => return None,
    };
    let nearest = u32::try_from(nearest.max(0)).ok()?;
    let is_beyond = |k: &u32| {
        let way = if is_infinite {
            distance(*k) - start
        } else {
            start - distance(*k)
        };
        way.lower() >= 0
    };
    let mut places = (nearest..=nearest + PLACES).filter(is_beyond);
    let found = places
        .find_map(|k| oscillation::integral(&mut *waves, end, k, run).map(|value| (k, value)));
    let (k, mut value) = found?;
    if let Some(others) = waves.rest() {
        let from = match end {
            End::Above(a) => a + distance(k),
            End::Below(a) => a - distance(k),
            End::PlusInfinity => distance(k),
            End::MinusInfinity => -distance(k),
        };
        let rest = rest(others, &from, end, run)?;
        value = value + towards(others, &from, end, rest, run)?;
    }
    Some(Rest { k, value })
}

/// The coordinate of a point: it grows away from a finite end, and towards an infinite one.
fn distance(from: &Ball, end: &End) -> Ball {
    match end {
        End::Above(a) => from - a,
        End::Below(a) => a - from,
        End::PlusInfinity => from.clone(),
        End::MinusInfinity => -from,
    }
}

/// The integral between an ordinary point and an end, taken upwards.
fn towards(
    f: &mut dyn Integrand,
    from: &Ball,
    end: &End,
    Rest { k, value }: Rest,
    run: &mut Run,
) -> Option<Ball> {
    let zero = Ball::integer(64, 0);
    let (origin, negative) = match end {
        End::Above(a) => (a, false),
        End::Below(a) => (a, true),
        End::PlusInfinity => (&zero, false),
        End::MinusInfinity => (&zero, true),
    };
    let start = distance(from, end);
    let infinite = matches!(end, End::PlusInfinity | End::MinusInfinity);
    let line = Line {
        f,
        origin: (!origin.is_zero()).then(|| origin.clone()),
        negative,
    };
    let bits = from.prec().max(64);
    let main = if infinite {
        let last = Float::with_val(64, 1) << k;
        if (&start - &Ball::new(last.clone(), Mag::ZERO)).is_zero() {
            return Some(value);
        }
        let breaks = geometric(&start.mid().clone(), &last, bits);
        between(line, &start, &Ball::new(last, Mag::ZERO), &breaks, run)?
    } else {
        let first = Float::with_val(64, 1) >> k;
        if (&start - &Ball::new(first.clone(), Mag::ZERO)).is_zero() {
            return Some(value);
        }
        let mut breaks = Vec::new();
        let mut x = (&first << 2u32).complete(64);
        while x < *start.mid() {
            breaks.push(x.clone());
            x <<= 2;
        }
        between(line, &Ball::new(first, Mag::ZERO), &start, &breaks, run)?
    };
    Some(main + value)
}

/// Break points from a start to a distant end, four times as far from the start each time, if it is
/// distant.
fn geometric(start: &Float, last: &Float, bits: u32) -> Vec<Float> {
    let mut breaks = Vec::new();
    if (last - start).complete(64) <= 128 {
        return breaks;
    }
    let mut step = Float::with_val(64, 1);
    loop {
        let x = (start + &step).complete(bits + step.get_exp().map_or(0, |e| e.unsigned_abs()));
        if x >= *last {
            return breaks;
        }
        breaks.push(x);
        step <<= 2;
    }
}

/// A bound that the integrand proves at some distance of at most `2^−nearest`.
fn proved_growth(f: &mut dyn Integrand, end: &End, nearest: i64) -> Option<(Growth, u32)> {
    let nearest = u32::try_from(nearest.max(2)).ok()?;
    let near = DISTANCES.iter().copied().filter(|k| *k > nearest);
    let mut all = std::iter::once(nearest).chain(near);
    all.find_map(|k| f.growth(end, k).map(|growth| (growth, k)))
}

/// The distance `2^−k` at which the rest falls below a bound, and the rest.
fn cut(growth: &Growth, infinite: bool, least: u32, most: Mag) -> Option<(u32, Mag)> {
    let rest = |k: u32| growth.rest(k, infinite);
    let fits = |k: u32| rest(k) <= most;
    let mut high = least;
    while !fits(high) {
        high = high.checked_mul(2).filter(|k| *k <= FARTHEST)?;
    }
    let mut low = least;
    while low < high {
        let k = low + (high - low) / 2;
        if fits(k) {
            high = k;
        } else {
            low = k + 1;
        }
    }
    Some((high, rest(high)))
}
