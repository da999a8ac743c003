//! Adaptive integration between finite limits: bisection, Gauss–Legendre rules of adaptive degree.

mod changes;
mod ellipse;

use super::nodes;
use crate::{Ball, ComplexBall, Mag};
pub use changes::Crossing;
use changes::{is_close, unsettled};
#[cfg(test)]
pub(super) use ellipse::PARTS;
use ellipse::{Around, Ellipse, Hint, ellipse};
use rug::Float;
use rug::ops::CompleteRound;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// The values that are summed: real or complex balls.
pub(super) trait Value: Clone {
    fn zero() -> Self;
    fn plus(&self, other: &Self) -> Self;
    fn times(&self, factor: &Ball) -> Self;
    fn widened(&self, extra: Mag) -> Self;
    fn radius(&self) -> Mag;
    fn magnitude(&self) -> Mag;
    fn mignitude(&self) -> Mag;
}

macro_rules! value {
    ($type:ty, $zero:expr, $radius:ident, $times:ident) => {
        impl Value for $type {
            fn zero() -> Self {
                $zero
            }
            fn plus(&self, other: &Self) -> Self {
                self + other
            }
            fn times(&self, factor: &Ball) -> Self {
                $times(self, factor)
            }
            fn widened(&self, extra: Mag) -> Self {
                self.widened(extra)
            }
            fn radius(&self) -> Mag {
                self.$radius()
            }
            fn magnitude(&self) -> Mag {
                self.magnitude()
            }
            fn mignitude(&self) -> Mag {
                self.mignitude()
            }
        }
    };
}

fn real_times(x: &Ball, factor: &Ball) -> Ball {
    x * factor
}

fn complex_times(z: &ComplexBall, factor: &Ball) -> ComplexBall {
    z.scaled(factor)
}

value!(Ball, Ball::integer(64, 0), rad, real_times);
value!(ComplexBall, ComplexBall::zero(64), radius, complex_times);

/// An integrand over a real parameter.
pub(super) trait Path {
    type Value: Value;
    /// Encloses the values for all parameters in a ball.
    fn value(&mut self, t: &Ball, bits: u32) -> Option<Self::Value>;
    /// The sum of a rule around a middle with half a width, in machine words where these decide.
    fn short_sum(&mut self, _: &nodes::Rule, _: [&Ball; 2]) -> Option<Self::Value> {
        None
    }
    /// True if values are real: the part of an ellipse above the real line is then enough, because
    /// the integrand continues by reflection (Schwarz) to a function that agrees with it on the
    /// line.
    const MIRRORS: bool;
    /// As those of an [`Integrand`](super::Integrand).
    fn has_choices(&mut self) -> bool {
        false
    }
    fn is_settled(&mut self, _: &Ball) -> bool {
        false
    }
    fn crossing(&mut self, _: [&Float; 2]) -> Option<Crossing> {
        None
    }
    /// As [`Path::bound`], of the function that the choices made at a parameter continue to.
    fn bound_chosen(&mut self, _at: &Float, _t: &ComplexBall, _bits: u32) -> Option<Mag> {
        None
    }
    /// Bounds the integrand where it is proved to be holomorphic on the whole rectangle.
    fn bound(&mut self, t: &ComplexBall, bits: u32) -> Option<Mag>;
}

/// The error that a panel may have.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tolerance {
    /// The error allowed now.
    pub now: Mag,
    /// The bits by which it lies below the greatest panel seen.
    pub relative: i64,
}

impl Tolerance {
    fn see(&mut self, size: Mag) {
        self.now = self.now.max(size.shift(-self.relative));
    }
}

/// Evaluations made and allowed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Budget {
    pub spent: u64,
    pub limit: u64,
    /// Evaluations in machine words that are not counted among the others yet.
    pub words: u64,
}

impl Budget {
    /// Counts evaluations in machine words at or around a number, which are as many times faster than
    /// others.
    fn spend_words(&mut self, evaluations: u64) {
        const FASTER: u64 = 8;
        self.words += evaluations;
        self.spent += self.words / FASTER;
        self.words %= FASTER;
    }
}

/// The sum over panels, and the worst panel if the work was not finished.
pub(super) struct Sum<V> {
    pub value: Option<V>,
    pub hindered: Option<(Float, Float)>,
}

struct Panel<V> {
    lower: Float,
    upper: Float,
    /// The width times an enclosure of the values.
    direct: Option<V>,
    error: Mag,
    /// True if no ellipse around the whole was found free of singularities.
    refused: bool,
    depth: u32,
    /// The precision of enclosures on rectangles.
    bits: u32,
    /// A parameter at which every choice is the same as on the whole panel.
    settled: Option<Float>,
    /// The parameter up to which choices do not change from the lower end on.
    first: Float,
    /// True if a choice changes on it that machine words do not place more closely.
    closed: bool,
}

impl<V> Ord for Panel<V> {
    /// By error; of equal ones the left one is greater, so that the order of the work is always the
    /// same.
    fn cmp(&self, other: &Self) -> Ordering {
        let error = self.error.partial_cmp(&other.error);
        let place = other.lower.partial_cmp(&self.lower);
        let [error, place] = [error, place].map(|o| o.unwrap_or(Ordering::Equal));
        error.then(place)
    }
}

impl<V> PartialOrd for Panel<V> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<V> PartialEq for Panel<V> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl<V> Eq for Panel<V> {}

fn exponent(x: &Float) -> i32 {
    x.get_exp().unwrap_or(i32::MIN / 2)
}

/// Bits by which a size is larger than the width of a panel.
fn resolution(size: i32, lower: &Float, upper: &Float) -> u32 {
    let width = (upper - lower).complete(64);
    u32::try_from(size.saturating_sub(exponent(&width))).unwrap_or(0)
}

/// Bits by which the parameters are larger than the width: a node has to be known to that number of
/// bits more.
fn finer(lower: &Float, upper: &Float) -> u32 {
    resolution(exponent(lower).max(exponent(upper)), lower, upper)
}

/// A number near the middle of a panel.
fn middle_of(lower: &Float, upper: &Float) -> Float {
    (lower + upper).complete(64 + finer(lower, upper)) >> 1u32
}

fn panel<P: Path>(
    path: &mut P,
    [lower, upper]: [Float; 2],
    depth: u32,
    refused: Option<i32>,
    tolerance: &mut Tolerance,
    budget: &mut Budget,
) -> Panel<P::Value> {
    // Next to a jump, sizes like those of the whole interval or like 1 may have to be resolved.
    let beside = refused.map_or(0, |size| resolution(size, &lower, &upper));
    let bits = 64 + finer(&lower, &upper).max(beside);
    let width = difference(&upper, &lower, bits);
    budget.spent += 1;
    let values = path.value(&Ball::between(bits, &lower, &upper), bits);
    let direct = values
        .map(|v| v.times(&width))
        .filter(|v| v.radius().is_finite());
    let error = direct.as_ref().map_or(Mag::INFINITY, Value::radius);
    if let Some(direct) = &direct {
        tolerance.see(direct.mignitude());
    }
    Panel {
        first: lower.clone(),
        lower,
        upper,
        direct,
        error,
        refused: refused.is_some(),
        depth,
        bits,
        settled: None,
        closed: false,
    }
}

fn difference(a: &Float, b: &Float, bits: u32) -> Ball {
    let exact = |x: &Float| Ball::new(x.clone(), Mag::ZERO);
    (exact(a) - exact(b)).with_prec(bits)
}

/// The result of a rule over a panel.
enum Outcome<V> {
    Done(V),
    /// No ellipse is known to be free of singularities.
    Refused,
    /// The error is too large with the nodes allowed.
    Costly,
}

/// Bits by which the rounding errors of a panel lie below its tolerance, once they are known.
const SPARE: i64 = 12;

/// Bits that are added at first at most.
const MOST_MORE: u32 = 1 << 10;

/// The most rounding errors may widen a sum before it is done again with more bits.
const ATTEMPTS: u32 = 3;

/// Bits by which rounding errors may lie above the share of a panel of its own size: they are small
/// beside their panels, and their sum beside the integral, however many there are.
const ROUNDING: i64 = 7;

/// Bits that machine words may lack on a panel and are tried again on the next one.
const LITTLE: i64 = 3;

/// The binary logarithm of the number of panels after which machine words are tried again.
const MOST_MISSED: u32 = 6;

/// Bits of the error of a panel below its size that machine words are tried for; its size may be
/// known badly, and the bits below the greatest panel serve as well.
const WORDS: u32 = 124;

fn gauss<P: Path>(
    path: &mut P,
    panel: &Panel<P::Value>,
    Tolerance {
        now: tolerance,
        relative,
    }: Tolerance,
    greatest: u32,
    hint: &mut Hint,
    budget: &mut Budget,
) -> Outcome<P::Value> {
    let Some(direct) = &panel.direct else {
        return Outcome::Refused;
    };
    let finer = finer(&panel.lower, &panel.upper);
    let half_of = |bits: u32| difference(&panel.upper, &panel.lower, bits).shift(-1);
    let mid_of = |bits: u32| {
        let exact = |x: &Float| Ball::new(x.clone(), Mag::ZERO);
        let bits = bits + finer;
        (exact(&panel.lower).with_prec(bits) + exact(&panel.upper).with_prec(bits)).shift(-1)
    };
    let around = Around {
        mid: &mid_of(panel.bits.saturating_sub(finer)),
        reach: half_of(64).magnitude(),
        settled: panel.settled.as_ref(),
    };
    let found = ellipse(path, panel, &around, tolerance, greatest, hint, budget);
    let Ellipse {
        rho,
        most,
        nodes: n,
    } = match found {
        Ok(ellipse) => ellipse,
        Err(true) => return Outcome::Costly,
        Err(false) => return Outcome::Refused,
    };
    let error = nodes::error(most, rho, n);
    let (Some(top), Some(bottom)) = (direct.magnitude().exponent(), tolerance.exponent()) else {
        return Outcome::Costly;
    };
    if hint.skipped > 0 {
        hint.skipped -= 1;
    } else if relative.min(top - bottom) <= i64::from(WORDS)
        && let Some(rule) = nodes::rule(n, WORDS)
        && let Some(words) = path.short_sum(&rule, [&mid_of(WORDS), &half_of(WORDS)])
    {
        budget.spent += u64::from(n);
        let enough = tolerance.max(words.magnitude().shift(ROUNDING - relative));
        if words.radius() <= enough {
            hint.missed = 0;
            return Outcome::Done(words.widened(error));
        }
        // Most integrands lose as many bits on the next panel.
        if words.radius() > enough.shift(LITTLE) {
            hint.missed = (hint.missed + 1).min(MOST_MISSED);
            hint.skipped = (1 << hint.missed) - 2;
        }
    }
    let mut bits = u32::try_from((top - bottom).max(8)).unwrap_or(u32::MAX / 4) + 16 + n.ilog2();
    // The integrand loses about as many bits to cancellation here as in the panel beside this one.
    bits += hint.more;
    for _ in 0..ATTEMPTS {
        let Some(rule) = nodes::rule(n, bits) else {
            return Outcome::Costly;
        };
        let (mid, half) = (mid_of(bits), half_of(bits));
        let mut at = |t: &Ball, weight: &Ball| {
            budget.spent += 1;
            path.value(t, bits).map(|v| v.times(weight))
        };
        let mut sum = || {
            let mut sum = match &rule.centre {
                Some(weight) => at(&mid, weight)?,
                None => P::Value::zero(),
            };
            for (x, weight) in &rule.positive {
                let off = x * &half;
                sum = sum.plus(&at(&(&mid - &off), weight)?);
                sum = sum.plus(&at(&(&mid + &off), weight)?);
            }
            Some(sum.times(&half))
        };
        let sum = sum().filter(|sum| sum.radius().is_finite());
        let Some(sum) = sum else {
            bits *= 2;
            continue;
        };
        let excess = sum.radius().exponent().unwrap_or(i64::MIN / 2) - bottom;
        if excess < 0 {
            let spare = u32::try_from(-excess - SPARE).unwrap_or(0);
            hint.more = hint.more.saturating_sub(spare);
            return Outcome::Done(sum.widened(error));
        }
        let lacking = u32::try_from(excess + SPARE).unwrap_or(bits);
        hint.more = hint.more.saturating_add(lacking).min(MOST_MORE);
        bits += lacking;
    }
    Outcome::Costly
}

/// Integrates between neighbouring break points, which ascend.
pub(super) fn adaptive<P: Path>(
    path: &mut P,
    breaks: &[Float],
    tolerance: &mut Tolerance,
    budget: &mut Budget,
) -> Sum<P::Value> {
    let mut queue = BinaryHeap::new();
    for ends in breaks.windows(2) {
        let ends = [ends[0].clone(), ends[1].clone()];
        queue.push(panel(path, ends, 0, None, tolerance, budget));
    }
    let greatest = u32::try_from(60 + tolerance.relative.max(0) / 2).unwrap_or(u32::MAX);
    let lost = u32::try_from(LOST + 4 * tolerance.relative.max(0)).unwrap_or(DEPTH);
    let mut hint = Hint::FIRST;
    let has_choices = path.has_choices();
    let size = [breaks.first(), breaks.last()].map(|x| x.map_or(0, exponent));
    let size = size[0].max(size[1]).max(0);
    let mut total = P::Value::zero();
    let mut hindered = None;
    while let Some(top) = queue.pop() {
        let mut refused = None;
        if let Some(direct) = &top.direct
            && top.error <= tolerance.now
        {
            total = total.plus(direct);
            continue;
        }
        if budget.spent < budget.limit && !top.closed {
            match gauss(path, &top, *tolerance, greatest, &mut hint, budget) {
                Outcome::Done(value) => {
                    tolerance.see(value.mignitude());
                    total = total.plus(&value);
                    continue;
                }
                Outcome::Refused => refused = Some(size),
                Outcome::Costly => {}
            }
        }
        let middle = middle_of(&top.lower, &top.upper);
        let splits = top.lower < middle && middle < top.upper;
        let deepest = match &top.direct {
            Some(_) => DEPTH,
            None => lost,
        };
        if budget.spent >= budget.limit || top.depth >= deepest || !splits {
            // The first panel left over is the worst.
            hindered.get_or_insert((top.lower.clone(), top.upper.clone()));
            match &top.direct {
                Some(direct) => total = total.plus(direct),
                None => {
                    return Sum {
                        value: None,
                        hindered,
                    };
                }
            }
            continue;
        }
        if refused.is_some()
            && top.settled.is_none()
            && top.direct.is_some()
            && has_choices
            && let Some([low, high, end]) = unsettled(path, &top, tolerance.now, budget)
        {
            let closed = is_close([&low, &high], &top);
            let mut add = |[a, b]: [&Float; 2], refused| {
                let ends = [a, b].map(Float::clone);
                panel(path, ends, top.depth + 1, refused, tolerance, budget)
            };
            // The ends may lie too near to a change to be told from it.
            if top.lower < low {
                let settled = Some(middle_of(&top.lower, &low));
                let part = add([&top.lower, &low], None);
                queue.push(Panel { settled, ..part });
            }
            if low < high {
                let part = add([&low, &high], refused);
                queue.push(Panel { closed, ..part });
            }
            if high < top.upper {
                let part = match end < top.upper {
                    true => Panel {
                        first: end,
                        ..add([&high, &top.upper], refused)
                    },
                    false => Panel {
                        settled: Some(middle_of(&high, &end)),
                        ..add([&high, &end], None)
                    },
                };
                queue.push(part);
            }
            continue;
        }
        // Beside a jump sizes like those of the whole interval are resolved.
        let refused = refused.or(top.closed.then_some(size));
        let halves = [[top.lower, middle.clone()], [middle, top.upper]];
        for ends in halves {
            let mut half = panel(path, ends, top.depth + 1, refused, tolerance, budget);
            half.settled.clone_from(&top.settled);
            half.closed = top.closed;
            if half.lower < top.first {
                half.first = top.first.clone().min(&half.upper);
            }
            queue.push(half);
        }
    }
    Sum {
        value: Some(total),
        hindered,
    }
}

/// A panel is halved no more often than this: its width is then below any tolerance in use.
const DEPTH: u32 = 100_000;

/// A panel without any enclosure is halved no more often than this, and four times for each bit
/// that is due: where an integrand has no bound on so short an interval, it has none further in.
const LOST: i64 = 1024;
