//! Integrals of graphs.

use super::ball::{Balls, Value};
use super::germ::{Germs, Near};
use super::mirror::Mirrored;
use super::oscillation::Oscillation;
use super::short::Pointwise;
use super::{Evaluator, Stop};
use crate::Func;
use crate::graph::{Graph, Id, Node};
use mechaudit_reference::elementary::NoValue;
use mechaudit_reference::quadrature::{
    self, Crossing, End, Goal, Growth, Hindrance, Integrand, Limit, Waves,
};
use mechaudit_reference::{Ball, Ball128, Complex128, ComplexBall, Mag};
use rug::Float;
use std::cmp::Ordering;

/// Bits to which an integral under another is enclosed beyond the goal of the outer one, whose sum
/// is to reach it.
const INNER: u32 = 16;

/// Bits by which it is less accurate than the variable of the outer one.
const SPARE: i64 = 8;

/// The binary logarithm of the share of evaluations that an inner integral may take.
const INNER_SHARE: u32 = 5;

/// Bits beyond the goal to which an integral is enclosed where a sum with it cancels: each costs
/// nodes.
const DEEPER: u32 = 1 << 10;

/// Bits beyond those that an integral next to zero may lose to cancellation within it.
const CANCELLED: u32 = 1 << 11;

/// Poles and the like between the limits of an integral.
const MOST_POLES: u32 = 8;

/// Bits and evaluations of an inner integral for an interval or a rectangle of the outer variable.
const COARSE_BITS: u32 = 8;
const COARSE_EVALUATIONS: u64 = 1 << 7;

/// Evaluations in machine words that count as one.
const FASTER: u32 = 8;

/// Bits of a rectangle up to which doubles are tried.
const TOLD_APART: u32 = 64 + 40;

/// Bits to which a variable is known, relative to its size or to 1.
fn known_bits(variable: &Value) -> i64 {
    let of = |x: &Ball| {
        let absolute = x.rad().exponent().map_or(i64::MAX, |e| -e);
        absolute.max(x.accuracy_bits())
    };
    match variable {
        Value::Continued(z) | Value::Complex(z) => of(&z.re).min(of(&z.im)),
        Value::Mirrored(f) => of(&f.value.re).min(of(&f.value.im)),
        other => other.real().map_or(i64::MAX, of),
    }
}

/// The body of an integral as a function of its variable.
pub(super) struct Body<'e> {
    evaluator: &'e mut Evaluator<Balls>,
    binder: u32,
    body: Id,
    /// Where the integrand is undefined on a whole interval.
    undefined: Option<Stop>,
    /// Nodes with zeros that are ends.
    zeros: Vec<(Id, Ball)>,
    /// The body in machine words, once it was asked for.
    short: Option<Pointwise>,
    /// Evaluations in machine words.
    short_evaluations: u32,
    /// True if the mirror image of the body is integrated.
    is_image: bool,
}

impl<'e> Body<'e> {
    /// The body of a binder of one variable.
    pub(super) fn new(evaluator: &'e mut Evaluator<Balls>, binder: u32, body: Id) -> Body<'e> {
        Body {
            evaluator,
            binder,
            body,
            undefined: None,
            zeros: Vec::new(),
            short: None,
            short_evaluations: 0,
            is_image: false,
        }
    }

    /// The value of the body for a value of its variable.
    pub(super) fn value(
        &mut self,
        variable: Value,
        holomorphic: bool,
        bits: u32,
    ) -> Result<Value, Stop> {
        if self.evaluator.evaluations == 0 {
            return Err(Stop {
                node: self.body,
                reason: NoValue::Undecided(super::EVALUATIONS_REASON),
            });
        }
        self.evaluator.evaluations -= 1;
        let balls = &mut self.evaluator.interpretation;
        let outside = (balls.prec, balls.holomorphic, balls.wide, balls.known);
        // Around a continuation everything has to be holomorphic in its variable, too.
        (balls.prec, balls.holomorphic) = (bits, holomorphic || outside.1);
        balls.wide |= variable.real().is_some_and(|x| !x.rad().is_zero());
        balls.known = balls.known.min(known_bits(&variable));
        self.evaluator.set_variables(self.binder, [variable]);
        let value = self.evaluator.value(self.body).cloned();
        let balls = &mut self.evaluator.interpretation;
        (balls.prec, balls.holomorphic, balls.wide, balls.known) = outside;
        value
    }

    /// The exponent of a bound on the integral of the absolute value between finite limits, where the
    /// values are real.
    fn size(&mut self, limits: &[Limit; 2]) -> Option<i64> {
        let [Limit::Finite(a), Limit::Finite(b)] = limits else {
            return None;
        };
        let value = self.enclose_real(&a.union(b), a.prec())?;
        let most = value.magnitude().mul((b - a).magnitude());
        most.exponent()
    }

    /// The body in machine words and the rounds that it may take, for one evaluation.
    fn pointwise(&mut self) -> Option<(&mut Pointwise, &mut u64)> {
        let (binder, body) = (self.binder, self.body);
        self.short_evaluations += 1;
        let counted = u64::from(self.short_evaluations.is_multiple_of(FASTER));
        self.evaluator.evaluations = self.evaluator.evaluations.checked_sub(counted)?;
        self.short.take_if(|known| !known.is_of(body));
        let pointwise = self
            .short
            .get_or_insert_with(|| Pointwise::new(self.evaluator, binder, body));
        Some((pointwise, &mut self.evaluator.rounds))
    }

    /// A value as a complex number, or that of the mirror image.
    fn complex(&self, value: Value) -> Option<ComplexBall> {
        match self.is_image {
            true => value.image(),
            false => value.to_complex(),
        }
    }

    fn real(&mut self, x: &Ball, bits: u32) -> Option<Value> {
        let is_wide = !x.rad().is_zero();
        match self.value(Value::Real(x.clone()), false, bits) {
            Ok(value) => Some(value),
            Err(stop) => {
                if is_wide && matches!(stop.reason, NoValue::Undefined(_)) {
                    self.undefined = Some(stop);
                }
                None
            }
        }
    }
}

impl Body<'_> {
    /// The integral of a real body, whose parts may be zero at singularities between the limits.
    fn between(
        &mut self,
        from: &Limit,
        to: &Limit,
        goal: &Goal,
        poles: u32,
    ) -> (Option<Ball>, Option<Hindrance>) {
        let found = quadrature::integrate(self, from, to, goal);
        let (None, Some(Hindrance::Interval(a, b))) = (&found.value, &found.hindrance) else {
            return (found.value, found.hindrance);
        };
        let Some((node, root)) = self.inner_root(a, b).filter(|_| poles > 0) else {
            return (None, found.hindrance);
        };
        self.zeros.push((node, root.clone()));
        let middle = Limit::Finite(root);
        let (Some(left), before) = self.between(from, &middle, goal, poles - 1) else {
            return (None, found.hindrance);
        };
        let (Some(right), after) = self.between(&middle, to, goal, poles - 1) else {
            return (None, found.hindrance);
        };
        (Some(left + right), before.or(after))
    }

    /// The sign of a part at a number.
    fn sign(&mut self, node: Id, x: &Float) -> Option<Ordering> {
        let bits = x.prec();
        let body = std::mem::replace(&mut self.body, node);
        let value = self.real(&Ball::new(x.clone(), Mag::ZERO), bits);
        self.body = body;
        let value = value?;
        match value.real()? {
            y if y.is_zero() => Some(Ordering::Equal),
            y if y.is_positive() => Some(Ordering::Greater),
            y if y.is_negative() => Some(Ordering::Less),
            _ => None,
        }
    }

    /// A part whose zeros are singularities, with a zero of it next to an interval: it changes its
    /// sign there and is continuous, being holomorphic.
    fn inner_root(&mut self, a: &Float, b: &Float) -> Option<(Id, Ball)> {
        let graph = self.evaluator.graph().clone();
        let parts = graph
            .reach(self.body)
            .into_iter()
            .filter_map(|id| match graph.node(id) {
                Node::Unary(
                    Func::Log | Func::Log2 | Func::Log10 | Func::Abs | Func::Sqrt | Func::Cbrt,
                    x,
                )
                | Node::Binary(Func::Pow, x, _)
                | Node::Div(_, x) => Some(x),
                Node::Power(x, k) if k < 0 => Some(x),
                _ => None,
            });
        let parts: Vec<Id> = parts
            .filter(|id| graph.depends_on(*id, self.binder))
            .collect();
        let bits = self.evaluator.interpretation.prec.saturating_mul(4) + CLOSER;
        // The rest of the body has to be known as closely as its zero.
        for id in graph.reach(self.body) {
            let is_given = matches!(
                graph.node(id),
                Node::Input(_) | Node::Variable(..) | Node::Bound(_) | Node::Last(..)
            );
            if !is_given && !graph.depends_on(id, self.binder) {
                self.evaluator.known[id as usize] = None;
            }
        }
        prepare(self.evaluator, self.binder, self.body, bits);
        let middle = Float::with_val(bits, a + b) >> 1u32;
        parts.into_iter().find_map(|node| {
            [10, 20, 40, 80].into_iter().find_map(|k| {
                let reach = Float::with_val(bits, 1) >> k as u32;
                let ends = [
                    Float::with_val(bits, &middle - &reach),
                    middle.clone() + &reach,
                ];
                self.zero_between(node, ends).map(|root| (node, root))
            })
        })
    }

    /// A zero of a part between two numbers at which its signs differ.
    fn zero_between(&mut self, node: Id, [mut low, mut high]: [Float; 2]) -> Option<Ball> {
        let bits = low.prec();
        let start = self.sign(node, &low)?;
        let end = self.sign(node, &high)?;
        if start == end || start == Ordering::Equal || end == Ordering::Equal {
            return None;
        }
        let reach = Ball::between(bits, &low, &high);
        let beside = Ball::integer(bits, 0).widened(reach.rad());
        let body = std::mem::replace(&mut self.body, node);
        let is_holomorphic = self
            .enclose(&ComplexBall::new(reach, beside), true, 64)
            .is_some();
        self.body = body;
        if !is_holomorphic {
            return None;
        }
        let zero = Float::new(bits);
        if low < 0 && high > 0 && self.sign(node, &zero) == Some(Ordering::Equal) {
            return Some(Ball::new(zero, Mag::ZERO));
        }
        let least = Float::with_val(bits, 1) >> bits;
        // The middle may lie on the zero, and one of two other places is away from it.
        'halved: loop {
            for eighths in [3, 5] {
                let width = Float::with_val(bits, &high - &low);
                if width <= least {
                    break 'halved;
                }
                let place = Float::with_val(bits, &low + ((width * eighths) >> 3u32));
                if !(low < place && place < high) {
                    break 'halved;
                }
                match self.sign(node, &place) {
                    Some(Ordering::Equal) => return Some(Ball::new(place, Mag::ZERO)),
                    Some(sign) if sign == start => low = place,
                    Some(_) => high = place,
                    None => continue,
                }
                continue 'halved;
            }
            break;
        }
        Some(Ball::between(bits, &low, &high))
    }
}

impl Integrand for Body<'_> {
    fn enclose(&mut self, z: &ComplexBall, holomorphic: bool, bits: u32) -> Option<ComplexBall> {
        if z.im.is_zero() && (!holomorphic || z.re.rad().is_zero()) {
            let value = self.real(&z.re, bits)?;
            return self.complex(value);
        }
        if !holomorphic {
            return None;
        }
        // Doubles do not tell the parts of a short panel apart.
        if bits <= TOLD_APART && !self.is_image {
            let (pointwise, rounds) = self.pointwise()?;
            if let Some(found) = pointwise.continuation(z, rounds) {
                return Some(found);
            }
        }
        let value = self.value(Value::Continued(z.clone()), true, bits).ok()?;
        self.complex(value)
    }

    fn enclose_real(&mut self, x: &Ball, bits: u32) -> Option<Ball> {
        match self.real(x, bits)? {
            Value::Real(value) => Some(value),
            other => other.real().cloned(),
        }
    }

    fn enclose_short(&mut self, x: &Ball128) -> Option<Ball128> {
        let (pointwise, rounds) = self.pointwise()?;
        pointwise.value(x, rounds)
    }

    fn enclose_short_complex(&mut self, x: &Ball128) -> Option<Complex128> {
        // Around a continuation functions that are not holomorphic have no values.
        if self.evaluator.interpretation.holomorphic {
            return None;
        }
        let (pointwise, rounds) = self.pointwise()?;
        pointwise.complex_value(x, rounds)
    }

    fn has_choices(&mut self) -> bool {
        self.pointwise().is_some_and(|(body, _)| body.has_choices())
    }

    fn is_settled(&mut self, x: &Ball) -> bool {
        let known = self.pointwise();
        known.is_some_and(|(body, rounds)| body.is_settled(x, rounds))
    }

    fn crossing(&mut self, between: [&Ball; 2]) -> Option<Crossing> {
        let (pointwise, rounds) = self.pointwise()?;
        pointwise.crossing(between, rounds)
    }

    fn enclose_chosen(&mut self, at: &Ball, z: &ComplexBall, bits: u32) -> Option<ComplexBall> {
        if bits > TOLD_APART {
            return None;
        }
        let (pointwise, rounds) = self.pointwise()?;
        pointwise.chosen(at, z, rounds)
    }

    fn waves(&mut self, end: &End) -> Option<Box<dyn Waves>> {
        let found = Oscillation::new(self.evaluator, self.binder, self.body, end)?;
        Some(Box::new(found))
    }

    fn growth(&mut self, end: &End, k: u32) -> Option<Growth> {
        let zero = match end {
            End::Above(a) | End::Below(a) => {
                self.zeros.iter().find(|(_, root)| a.mid() == root.mid())
            }
            End::PlusInfinity | End::MinusInfinity => None,
        };
        let zero = zero.map(|(id, _)| *id);
        let bits = self.evaluator.interpretation.prec;
        let graph = self.evaluator.graph().clone();
        let mut germs = Evaluator::new(graph.clone(), Germs { k, bits });
        // Nodes that do not depend on the variable are constant.
        for id in leaves(&graph, self.body, self.binder) {
            let value = self.evaluator.value(id).ok()?.real()?.clone();
            let constant = germs.interpretation.constant_of(&value);
            germs.set(id, constant);
        }
        let variable = quadrature::Germ::variable(end, k, bits);
        germs.set_variables(self.binder, [Near::varying(variable)]);
        if let Some(id) = zero {
            let vanishing = germs.value(id).ok()?.germ().vanishing();
            germs.set(id, Near::varying(vanishing));
        }
        germs.value(self.body).ok()?.germ().growth()
    }
}

/// Nodes that the body depends on and that do not depend on the variable of its binder: the largest
/// of them.
pub(super) fn leaves(graph: &Graph, body: Id, binder: u32) -> Vec<Id> {
    let mut open = vec![body];
    let mut seen = vec![false; body as usize + 1];
    let mut found = Vec::new();
    while let Some(id) = open.pop() {
        if std::mem::replace(&mut seen[id as usize], true) {
            continue;
        }
        match graph.depends_on(id, binder) {
            true => open.extend(graph.operands(graph.node(id))),
            false
                if matches!(
                    graph.node(id),
                    Node::Truth(_)
                        | Node::Compare(..)
                        | Node::And(..)
                        | Node::Or(..)
                        | Node::Not(_)
                ) =>
            {
                open.extend(graph.operands(graph.node(id)));
            }
            false => found.push(id),
        }
    }
    found
}

/// A limit of an integral.
fn limit(evaluator: &mut Evaluator<Balls>, id: Id) -> Result<Limit, Stop> {
    let graph = evaluator.graph().clone();
    match graph.node(id) {
        Node::Infinity => return Ok(Limit::PlusInfinity),
        Node::Neg(a) if graph.node(a) == Node::Infinity => return Ok(Limit::MinusInfinity),
        _ => {}
    }
    match evaluator.value(id)?.real() {
        Some(x) => Ok(Limit::Finite(x.clone())),
        None => Err(Stop {
            node: id,
            reason: NoValue::Undefined("a limit of an integral that is not a real number"),
        }),
    }
}

/// Bits by which parts that do not depend on the variable are known more closely than a panel is
/// due.
pub(super) const CLOSER: u32 = 64;

/// Gives parts of a body that do not depend on the variable their values, to more bits: what is
/// uncertain in them is so on every panel.
fn prepare(evaluator: &mut Evaluator<Balls>, binder: u32, body: Id, more: u32) {
    let graph = evaluator.graph().clone();
    let outside = evaluator.interpretation.prec;
    evaluator.interpretation.prec = outside.saturating_add(more);
    super::system::prepare(evaluator, &graph, &[body]);
    for id in leaves(&graph, body, binder) {
        if graph.node(id) != Node::Infinity {
            // A part without a value is reported where it is needed.
            let _ = evaluator.value(id);
        }
    }
    evaluator.interpretation.prec = outside;
}

/// The value of an integral from one node to another.
pub(super) fn integral(
    evaluator: &mut Evaluator<Balls>,
    binder: u32,
    node: Id,
    [from, to, body]: [Id; 3],
) -> Result<Value, Stop> {
    let limits = [limit(evaluator, from)?, limit(evaluator, to)?];
    prepare(evaluator, binder, body, CLOSER);
    let balls = &evaluator.interpretation;
    let (prec, asked, is_continued) = (balls.prec, balls.goal, balls.holomorphic);
    // Under another integral a bound serves where no more is to be had: for many values of its
    // variable at once.
    let is_inner = balls.known < i64::MAX;
    let (bits, evaluations) = match u32::try_from(balls.known.saturating_sub(SPARE)) {
        _ if !is_inner => (balls.due().min(balls.goal + DEEPER), balls.evaluations),
        Ok(known) if known >= COARSE_BITS => (
            (balls.goal + INNER).min(known),
            balls.evaluations >> INNER_SHARE,
        ),
        _ => (COARSE_BITS, COARSE_EVALUATIONS),
    };
    let places = prec.min(balls.places);
    let (is_real, mirrors) = (!evaluator.graph().is_complex(body), balls.mirrors);
    let is_complex = !is_real || is_continued;
    let mut integrand = Body::new(evaluator, binder, body);
    // An integral next to zero gets its relative accuracy as the working precision is raised; one of
    // small values has it at once.
    let small = match is_inner || places < prec {
        true => 0,
        false => integrand.size(&limits).map_or(0, |e| e.min(0)),
    };
    // Rules of thousands of bits cost seconds.
    let places = places.min(bits.saturating_add(CANCELLED));
    let goal = Goal {
        absolute: Mag::power_of_two(small - i64::from(places)),
        evaluations,
        ..Goal::bits(bits)
    };
    let [from, to] = &limits;
    let (value, hindrance) = if is_complex {
        let (Limit::Finite(a), Limit::Finite(b)) = (from, to) else {
            return Err(Stop {
                node,
                reason: NoValue::Undecided("an infinite limit of a complex integral"),
            });
        };
        let [a, b] = [a, b].map(|x| ComplexBall::new(x.clone(), Ball::integer(x.prec(), 0)));
        let found = quadrature::integrate_segment(&mut integrand, &a, &b, &goal);
        let value = match (is_continued, is_real) {
            (true, true) => found.value.map(Value::Continued),
            (true, false) if mirrors => {
                integrand.is_image = true;
                let image = quadrature::integrate_segment(&mut integrand, &a, &b, &goal).value;
                found.value.map(|value| Mirrored::value(value, image))
            }
            _ => found.value.map(Value::Complex),
        };
        (value, found.hindrance)
    } else {
        let (value, hindrance) = integrand.between(from, to, &goal, MOST_POLES);
        (value.map(Value::Real), hindrance)
    };
    let is_spent = integrand.evaluator.evaluations == 0;
    if let Some(stop) = integrand.undefined.filter(|_| hindrance.is_some()) {
        return Err(stop);
    }
    // A second try with more bits may serve an integrand that is enclosed badly; a third would not
    // end.
    let is_hopeless =
        matches!(hindrance, Some(Hindrance::Interval(..))) && prec > 2 * asked && !is_inner;
    if is_hopeless || (is_spent && hindrance.is_some()) {
        return Err(Stop {
            node,
            reason: NoValue::Undecided(super::EVALUATIONS_REASON),
        });
    }
    // The adaptive loop judges the accuracy of what missed its goal.
    value.ok_or(Stop {
        node,
        reason: NoValue::Undecided("an integral that is not enclosed within its limits"),
    })
}

#[cfg(test)]
mod tests;
