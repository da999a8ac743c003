//! Integrands that oscillate up to an end: sums of products of sines and cosines of `cx^m` next to
//! infinity, or of `c/(x − a)^m` next to a finite end, with factors that vary slowly.

mod sectors;
#[cfg(test)]
mod tests;

use super::Evaluator;
use super::ball::{Balls, Value};
use super::integral::{Body, leaves};
use crate::graph::{Graph, Id, Node};
use crate::{Func, Gauss};
use mechaudit_reference::quadrature::{End, Growth, Integrand, Sector, Waves};
use mechaudit_reference::{Ball, ComplexBall};
use rug::Rational;
use sectors::Sectors;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Waves that are told apart at most.
const MOST: usize = 16;

/// The frequency of a wave: rational multiples of constants, none of which is zero. The constant 1 is
/// none.
type Frequency = BTreeMap<Option<Id>, Rational>;

fn sum(a: &Frequency, b: &Frequency, sign: i32) -> Frequency {
    let mut sum = a.clone();
    for (constant, q) in b {
        *sum.entry(*constant).or_default() += Rational::from(q * sign);
    }
    sum.retain(|_, q| !q.is_zero());
    sum
}

/// A number times an amplitude times a wave.
#[derive(Clone)]
struct Term {
    frequency: Frequency,
    factor: Gauss,
    amplitude: Id,
}

/// The parts of a graph as sums of waves.
struct Splitter<'a> {
    graph: &'a mut Graph,
    binder: u32,
    variable: Id,
    /// The finite end.
    end: Option<Ball>,
    /// True if x grows towards a finite end, or falls towards minus infinity.
    is_mirrored: bool,
    /// The values of nodes that do not depend on the variable.
    values: &'a Evaluator<Balls>,
    /// The order m, once a wave has been found.
    order: Option<u32>,
}

impl Splitter<'_> {
    fn is_constant(&self, id: Id) -> bool {
        !self.graph.depends_on(id, self.binder)
    }

    fn number(&self, id: Id) -> Option<Rational> {
        rational(self.graph, id)
    }

    /// A power of the distance from a finite end, or of `|x|` next to infinity, and its sign.
    fn power_of_distance(&self, id: Id) -> Option<(i32, i32)> {
        let away = if self.is_mirrored { -1 } else { 1 };
        match (self.graph.node(id), &self.end) {
            (Node::Power(base, k), _) => {
                let (order, sign) = self.power_of_distance(base)?;
                Some((order.checked_mul(k)?, if k % 2 == 0 { 1 } else { sign }))
            }
            (Node::Neg(a), _) => {
                let (order, sign) = self.power_of_distance(a)?;
                Some((order, -sign))
            }
            (_, None) => (id == self.variable).then_some((1, away)),
            (node, Some(end)) => {
                let x = self.variable;
                let (at, sign) = match node {
                    _ if id == x => (Ball::integer(64, 0), 1),
                    Node::Sub(y, a) if y == x => (self.value_of(a)?, 1),
                    Node::Sub(a, y) if y == x => (self.value_of(a)?, -1),
                    Node::Add(y, a) | Node::Add(a, y) if y == x => (-self.value_of(a)?, 1),
                    _ => return None,
                };
                (&at - end).is_zero().then_some((1, sign * away))
            }
        }
    }

    fn value_of(&self, id: Id) -> Option<Ball> {
        if let Some(q) = self.number(id) {
            return q.denom().is_power_of_two().then(|| Ball::rational(256, &q));
        }
        self.values
            .known
            .get(id as usize)?
            .as_ref()?
            .real()
            .cloned()
    }

    /// A monomial `c u`: its order and the constant, as a number times a node.
    fn monomial(&mut self, id: Id) -> Option<(u32, Rational, Option<Id>)> {
        let times = |this: &mut Self, a: Id, (m, q, c): (u32, Rational, Option<Id>)| {
            Some(match (this.number(a), c) {
                (Some(factor), c) => (m, q * factor, c),
                (None, None) => (m, q, Some(a)),
                (None, Some(c)) => (m, q, Some(this.graph.push(Node::Mul(a, c)))),
            })
        };
        match self.graph.node(id) {
            Node::Neg(a) => self.monomial(a).map(|(m, q, c)| (m, -q, c)),
            Node::Mul(a, b) if self.is_constant(a) => {
                let inner = self.monomial(b)?;
                times(self, a, inner)
            }
            Node::Mul(a, b) if self.is_constant(b) => {
                let inner = self.monomial(a)?;
                times(self, b, inner)
            }
            Node::Div(a, b) if self.is_constant(b) => {
                let inner = self.monomial(a)?;
                let inverse = match self.number(b) {
                    Some(q) if !q.is_zero() => self.graph.number(q.recip()),
                    _ => {
                        let one = self.graph.number(1);
                        self.graph.push(Node::Div(one, b))
                    }
                };
                times(self, inverse, inner)
            }
            Node::Div(a, b) if self.is_constant(a) && self.end.is_some() => {
                let (order, sign) = self.power_of_distance(b)?;
                let m = u32::try_from(order).ok().filter(|m| *m > 0)?;
                times(self, a, (m, Rational::from(sign), None))
            }
            _ => {
                let (order, sign) = self.power_of_distance(id)?;
                let m = match self.end {
                    Some(_) => order.checked_neg()?,
                    None => order,
                };
                let m = u32::try_from(m).ok().filter(|m| *m > 0)?;
                Some((m, Rational::from(sign), None))
            }
        }
    }

    /// The frequency of a phase and what is left of it.
    fn phase(&mut self, id: Id) -> Option<(Frequency, Option<Id>)> {
        if let Some((m, q, constant)) = self.monomial(id) {
            if *self.order.get_or_insert(m) != m {
                return None;
            }
            let mut frequency = Frequency::new();
            if !q.is_zero() {
                frequency.insert(constant, q);
            }
            return Some((frequency, None));
        }
        let (a, b, sign) = match self.graph.node(id) {
            Node::Add(a, b) => (a, b, 1),
            Node::Sub(a, b) => (a, b, -1),
            Node::Neg(a) => {
                let (frequency, rest) = self.phase(a)?;
                let rest = rest.map(|rest| self.graph.push(Node::Neg(rest)));
                return Some((sum(&Frequency::new(), &frequency, -1), rest));
            }
            _ => return Some((Frequency::new(), Some(id))),
        };
        let ((first, x), (second, y)) = (self.phase(a)?, self.phase(b)?);
        let rest = match (x, y) {
            (Some(x), Some(y)) if sign > 0 => Some(self.graph.push(Node::Add(x, y))),
            (Some(x), Some(y)) => Some(self.graph.push(Node::Sub(x, y))),
            (None, Some(y)) if sign < 0 => Some(self.graph.push(Node::Neg(y))),
            (x, y) => x.or(y),
        };
        Some((sum(&first, &second, sign), rest))
    }

    fn plain(&self, amplitude: Id) -> Vec<Term> {
        vec![Term {
            frequency: Frequency::new(),
            factor: Gauss::real(1),
            amplitude,
        }]
    }

    fn product(&mut self, a: &[Term], b: &[Term]) -> Option<Vec<Term>> {
        let one = self.graph.number(1);
        let mut terms: Vec<Term> = Vec::new();
        for x in a {
            for y in b {
                let amplitude = match (x.amplitude, y.amplitude) {
                    (x, y) if x == one => y,
                    (x, y) if y == one => x,
                    (x, y) => self.graph.push(Node::Mul(x, y)),
                };
                merge(
                    &mut terms,
                    Term {
                        frequency: sum(&x.frequency, &y.frequency, 1),
                        factor: &x.factor * &y.factor,
                        amplitude,
                    },
                );
            }
        }
        (terms.len() <= MOST).then_some(terms)
    }

    /// A node as a sum of waves.
    fn terms(&mut self, id: Id) -> Option<Vec<Term>> {
        if self.is_constant(id) {
            return Some(self.plain(id));
        }
        match self.graph.node(id) {
            Node::Neg(a) => {
                let mut terms = self.terms(a)?;
                if self.is_plain(&terms) {
                    return Some(self.plain(id));
                }
                for term in &mut terms {
                    term.factor = &term.factor * &Gauss::real(-1);
                }
                Some(terms)
            }
            Node::Add(a, b) | Node::Sub(a, b) => {
                let (mut terms, others) = (self.terms(a)?, self.terms(b)?);
                let sign = if matches!(self.graph.node(id), Node::Add(..)) {
                    1
                } else {
                    -1
                };
                if self.is_plain(&terms) && self.is_plain(&others) {
                    return Some(self.plain(id));
                }
                for mut term in others {
                    term.factor = &term.factor * &Gauss::real(sign);
                    merge(&mut terms, term);
                }
                (terms.len() <= MOST).then_some(terms)
            }
            Node::Mul(a, b) => {
                let (x, y) = (self.terms(a)?, self.terms(b)?);
                match self.is_plain(&x) && self.is_plain(&y) {
                    true => Some(self.plain(id)),
                    false => self.product(&x, &y),
                }
            }
            Node::Div(a, b) => {
                let (mut terms, below) = (self.terms(a)?, self.terms(b)?);
                if !self.is_plain(&below) {
                    return None;
                }
                if self.is_plain(&terms) {
                    return Some(self.plain(id));
                }
                for term in &mut terms {
                    term.amplitude = self.graph.push(Node::Div(term.amplitude, b));
                }
                Some(terms)
            }
            Node::Power(a, k) => {
                let terms = self.terms(a)?;
                match k {
                    _ if self.is_plain(&terms) => Some(self.plain(id)),
                    1..=4 => {
                        let mut power = terms.clone();
                        for _ in 1..k {
                            power = self.product(&power, &terms)?;
                        }
                        Some(power)
                    }
                    _ => None,
                }
            }
            Node::Unary(f @ (Func::Sin | Func::Cos), x) => {
                let (frequency, rest) = self.phase(x)?;
                if frequency.is_empty() {
                    return Some(self.plain(id));
                }
                // sin φ = (e^{iφ} − e^{−iφ})/(2i), cos φ = (e^{iφ} + e^{−iφ})/2.
                let half = Rational::from((1, 2));
                let wave = |this: &mut Self, sign: i32| {
                    let amplitude = match rest {
                        None => this.graph.number(1),
                        Some(rest) => {
                            let unit = this.graph.push(Node::ImaginaryUnit);
                            let turned = this.graph.push(Node::Mul(unit, rest));
                            let turned = match sign > 0 {
                                true => turned,
                                false => this.graph.push(Node::Neg(turned)),
                            };
                            this.graph.push(Node::Unary(Func::Exp, turned))
                        }
                    };
                    let factor = match f {
                        Func::Sin => Gauss::new(0, -half.clone() * sign),
                        _ => Gauss::real(half.clone()),
                    };
                    Term {
                        frequency: sum(&Frequency::new(), &frequency, sign),
                        factor,
                        amplitude,
                    }
                };
                Some(vec![wave(self, 1), wave(self, -1)])
            }
            node => {
                // No other function keeps waves.
                let operands = match node {
                    Node::Variable(..) => Vec::new(),
                    Node::Unary(_, a) => vec![a],
                    Node::Binary(_, a, b) => vec![a, b],
                    _ => return None,
                };
                for operand in operands {
                    let terms = self.terms(operand)?;
                    if !self.is_plain(&terms) {
                        return None;
                    }
                }
                Some(self.plain(id))
            }
        }
    }

    fn is_plain(&self, terms: &[Term]) -> bool {
        matches!(terms, [term] if term.frequency.is_empty() && term.factor.is_one())
    }
}

/// The rational number that a node is, of quotients.
fn rational(graph: &Graph, id: Id) -> Option<Rational> {
    match graph.node(id) {
        Node::Number(place) => Some(graph.rational(place).clone()),
        Node::Neg(a) => rational(graph, a).map(|q| -q),
        Node::Div(a, b) => {
            let below = rational(graph, b).filter(|q| !q.is_zero())?;
            Some(rational(graph, a)? / below)
        }
        _ => None,
    }
}

/// Adds a term, to one with the same wave and amplitude where there is one.
fn merge(terms: &mut Vec<Term>, term: Term) {
    let is_same = |x: &&mut Term| x.frequency == term.frequency && x.amplitude == term.amplitude;
    match terms.iter_mut().find(is_same) {
        Some(known) => known.factor = &known.factor + &term.factor,
        None => terms.push(term),
    }
    terms.retain(|term| !term.factor.is_zero());
}

/// The waves of an integrand.
pub(super) struct Oscillation {
    evaluator: Evaluator<Balls>,
    binder: u32,
    order: u32,
    frequencies: Vec<Ball>,
    amplitudes: Vec<(Gauss, Id)>,
    /// Nodes that are the distance from the end, and their signs.
    distances: Vec<(Id, i32)>,
    /// The part that does not oscillate.
    rest: Option<Id>,
}

impl Oscillation {
    /// Splits the body of a binder next to an end; none where it does not oscillate there, or in
    /// another way.
    pub fn new(values: &Evaluator<Balls>, binder: u32, body: Id, end: &End) -> Option<Oscillation> {
        let parts = values.graph().reach(body);
        let is_wave = |id: &Id| {
            matches!(
                values.graph().node(*id),
                Node::Unary(Func::Sin | Func::Cos, _)
            ) && values.graph().depends_on(*id, binder)
        };
        if !parts.iter().any(is_wave) {
            return None;
        }
        let mut graph = Graph::clone(values.graph());
        let variable = graph.find(Node::Variable(binder, 0))?;
        let (at, is_mirrored) = match end {
            End::PlusInfinity => (None, false),
            End::MinusInfinity => (None, true),
            End::Above(a) => (Some(a.clone()), false),
            End::Below(a) => (Some(a.clone()), true),
        };
        let mut splitter = Splitter {
            graph: &mut graph,
            binder,
            variable,
            end: at,
            is_mirrored,
            values,
            order: None,
        };
        let terms = splitter.terms(body)?;
        let order = splitter.order?;
        let of_distance = |id: Id| {
            let (order, sign) = splitter.power_of_distance(id)?;
            (order == 1).then_some((id, sign))
        };
        let distances = parts.into_iter().filter_map(of_distance).collect();
        let mut rest: Option<Id> = None;
        let mut waves: Vec<Term> = Vec::new();
        for term in terms {
            if !term.frequency.is_empty() {
                waves.push(term);
                continue;
            }
            if !term.factor.im.is_zero() || graph.is_complex(term.amplitude) {
                return None;
            }
            let factor = graph.number(term.factor.re);
            let part = graph.push(Node::Mul(factor, term.amplitude));
            rest = Some(match rest {
                Some(rest) => graph.push(Node::Add(rest, part)),
                None => part,
            });
        }
        if waves.is_empty() {
            return None;
        }
        let graph = Arc::new(graph);
        let mut balls = values.interpretation.clone();
        balls.precisions.clear();
        let mut evaluator = Evaluator::new(graph.clone(), balls);
        for id in leaves(values.graph(), body, binder) {
            if let Some(value) = &values.known[id as usize] {
                evaluator.set(id, value.clone());
            }
        }
        let mut frequencies = Vec::new();
        for wave in &waves {
            let bits = evaluator.interpretation.prec;
            let mut frequency = Ball::integer(bits, 0);
            for (constant, q) in &wave.frequency {
                let q = Ball::rational(bits, q);
                frequency = match constant {
                    Some(id) => frequency + evaluator.value(*id).ok()?.real()? * &q,
                    None => frequency + q,
                };
            }
            if frequency.contains_zero() || !frequency.is_finite() {
                return None;
            }
            frequencies.push(frequency);
        }
        Some(Oscillation {
            evaluator,
            binder,
            order,
            frequencies,
            amplitudes: waves.into_iter().map(|w| (w.factor, w.amplitude)).collect(),
            distances,
            rest,
        })
    }

    fn scaled(&self, wave: usize, value: &ComplexBall, bits: u32) -> ComplexBall {
        let factor = &self.amplitudes[wave].0;
        let part = |q: &Rational| Ball::rational(bits, q);
        value * &ComplexBall::new(part(&factor.re), part(&factor.im))
    }
}

impl Waves for Oscillation {
    fn order(&self) -> u32 {
        self.order
    }

    fn frequencies(&self) -> &[Ball] {
        &self.frequencies
    }

    fn amplitude(&mut self, wave: usize, x: &ComplexBall, bits: u32) -> Option<ComplexBall> {
        let node = self.amplitudes[wave].1;
        // A real function is continued by principal branches alone, which agree everywhere.
        let value = match self.evaluator.graph().depends_on(node, self.binder) {
            true => {
                let mut body = Body::new(&mut self.evaluator, self.binder, node);
                body.value(Value::Complex(x.clone()), true, bits).ok()?
            }
            false => self.evaluator.value(node).ok()?.clone(),
        };
        Some(self.scaled(wave, &value.to_complex()?, bits))
    }

    fn beside(&mut self, wave: usize, x: &Sector, distance: &Sector) -> Option<Sector> {
        let node = self.amplitudes[wave].1;
        let graph = self.evaluator.graph().clone();
        let mut sectors = Evaluator::new(
            graph.clone(),
            Sectors {
                variable: x.clone(),
            },
        );
        for id in leaves(&graph, node, self.binder) {
            let value = match rational(&graph, id) {
                Some(q) => x.rational(&q),
                None => x.constant(&self.evaluator.value(id).ok()?.to_complex()?),
            };
            sectors.set(id, value);
        }
        sectors.set_variables(self.binder, [x.clone()]);
        for (id, sign) in &self.distances {
            let distance = distance.clone();
            sectors.set(
                *id,
                if *sign > 0 {
                    distance
                } else {
                    distance.negative()
                },
            );
        }
        let amplitude = sectors.value(node).ok()?.clone();
        let factor = &self.amplitudes[wave].0;
        let part = |q: &Rational| Ball::rational(64, q);
        let factor = ComplexBall::new(part(&factor.re), part(&factor.im));
        Some(amplitude.mul(&x.constant(&factor)))
    }

    fn rest(&mut self) -> Option<&mut dyn Integrand> {
        self.rest.is_some().then_some(self)
    }
}

impl Oscillation {
    fn body(&mut self) -> Body<'_> {
        let node = self.rest.unwrap_or(0);
        Body::new(&mut self.evaluator, self.binder, node)
    }
}

/// The part that does not oscillate.
impl Integrand for Oscillation {
    fn enclose(&mut self, z: &ComplexBall, holomorphic: bool, bits: u32) -> Option<ComplexBall> {
        self.body().enclose(z, holomorphic, bits)
    }

    fn enclose_real(&mut self, x: &Ball, bits: u32) -> Option<Ball> {
        self.body().enclose_real(x, bits)
    }

    fn growth(&mut self, end: &End, k: u32) -> Option<Growth> {
        self.body().growth(end, k)
    }
}
