//! Motions that slide along a switch.
//!
//! Where the rates f_± on both sides of `h(t, y) = 0` point at each other, `ḣ_+ < 0 < ḣ_−` with `ḣ_±
//! = ∂h/∂t + ∇h·f_±`, the solution in the sense of Filippov (*Differential Equations with
//! Discontinuous Righthand Sides*, 1988, §4) stays on the surface and moves by the mean that is
//! tangent to it,
//!
//! ```text
//! f_0 = α f_+ + (1 − α) f_−,   α = ḣ_−/(ḣ_− − ḣ_+),
//! ```
//!
//! and it is the only one forwards in time (§10). f_0 is a smooth field, and the two signs are its
//! guards: while they are proved the motion slides, and where one of them changes it leaves.
//!
//! # The exit
//! Let `ḣ_+` change its sign between a and b, where over an enclosure of all means of f_0 and f_+
//! `ḣ_− > 0` and `ḧ_+ > 0` along f_0 as well as along f_+. The motion does not come below the
//! surface, as `ḣ_−` is positive there. Above it h changes by `ḣ_+`, which rises: h cannot fall back to
//! zero. So the rate is f_0 up to the exit and f_+ from there on, and at b, where `ḣ_+ > 0`, `h ≥ 0`.
//! From b on `h > 0` as long as `ḧ_+ > 0`, until h itself is far enough from zero to be a guard.

use super::crossing::{Crossing, TOUCHES, Uncrossed, enclosed, times};
use super::field::{Guarded, Sides, Smooth, inputs_of, set_again};
use super::problem::{InitialValueProblem, ProblemError, rate_of_value, value_of_switch};
use crate::SymbolicError;
use crate::evaluation::taylor::{Side, Switch};
use crate::evaluation::{Balls, Evaluator};
use crate::graph::{Graph, Id, Node};
use crate::{Func, Relation};
use mechaudit_reference::Ball;
use rug::Rational;
use std::collections::HashMap;

/// A motion along a switch.
pub(super) struct Sliding {
    pub switch: Switch,
    /// The problem of the rates f_0.
    pub problem: InitialValueProblem,
    /// The state that is zero, where the switch is the sign of one.
    pub rest: Option<usize>,
    /// The ways out, below and above.
    pub exits: [Exit; 2],
    /// True if other states than that one may have rates at the switch that are none of the means.
    pub is_ambiguous: bool,
}

/// A way out of a sliding motion.
pub(super) struct Exit {
    pub side: Side,
    /// The sign of `ḣ` on this side.
    pub margin: Switch,
    /// `ḧ` along the rates of this side.
    second: Id,
}

impl Sliding {
    /// The motion along a switch.
    ///
    /// # Errors
    /// A derivative that is not in the language.
    pub fn new(problem: &InitialValueProblem, switch: Switch) -> Result<Sliding, SymbolicError> {
        let mut graph = Graph::clone(&problem.graph);
        let zero = graph.number(0);
        let rest = match switch {
            Switch::SignOf(a) => match graph.node(a) {
                Node::Input(k) => (k as usize).checked_sub(problem.inputs + 1),
                _ => None,
            },
            _ => None,
        };
        // Values at the switch alone do not count in Filippov's sense, but they do where the motion
        // stays in the classical one.
        let is_ambiguous = switch.is_pointed(&graph)
            && (0..problem.rates.len()).any(|k| {
                let rate = &problem.rates[k..=k];
                rest != Some(k) && !choices(&mut graph, rate, switch, true).is_empty()
            });
        let value = value_of_switch(&mut graph, switch);
        let mut sides = Vec::new();
        let n = problem.rates.len();
        let all = [problem.rates.as_slice(), &problem.quantities].concat();
        for is_above in [false, true] {
            let map = choices(&mut graph, &all, switch, is_above);
            let nodes = all.iter().map(|node| graph.replaced(*node, &map));
            let nodes: Vec<Id> = nodes.collect::<Result<_, _>>()?;
            let first = rate_of_value(&mut graph, value, problem.inputs, &nodes[..n])?;
            let second = rate_of_value(&mut graph, first, problem.inputs, &nodes[..n])?;
            sides.push((nodes, first, second));
        }
        let [(below, fall, _), (above, rise, _)] = &sides[..] else {
            unreachable!("two sides")
        };
        let against = graph.push(Node::Sub(*fall, *rise));
        let share = graph.push(Node::Div(*fall, against));
        let on_surface = match rest {
            Some(k) => HashMap::from([(graph.input(problem.inputs + 1 + k), zero)]),
            None => HashMap::new(),
        };
        let mut means = Vec::new();
        for (k, (below, above)) in below.iter().zip(above).enumerate() {
            let mean = match () {
                () if rest == Some(k) => zero,
                () if below == above => *below,
                () => {
                    let jump = graph.push(Node::Sub(*above, *below));
                    let part = graph.push(Node::Mul(share, jump));
                    graph.push(Node::Add(*below, part))
                }
            };
            means.push(graph.replaced(mean, &on_surface)?);
        }
        let quantities = means.split_off(n);
        let states: Vec<(Id, Id)> = means.into_iter().map(|mean| (zero, mean)).collect();
        let mut margins = Vec::new();
        for side in &sides {
            margins.push(Switch::SignOf(graph.replaced(side.1, &on_surface)?));
        }
        let exits = [Side::Negative, Side::Positive].into_iter();
        let exits = exits.zip(&margins).zip(&sides);
        let exits: Vec<Exit> = exits
            .map(|((side, margin), (_, _, second))| Exit {
                side,
                margin: *margin,
                second: *second,
            })
            .collect();
        let fault = |e: ProblemError| SymbolicError::Unsupported(e.to_string());
        let mut posed = InitialValueProblem::of_graph(graph, zero, &states)
            .map_err(fault)?
            .guarded(margins)
            .with_quantities(quantities);
        if problem.variation.is_some() {
            posed = posed.by_inputs(Vec::new()).map_err(fault)?;
        }
        Ok(Sliding {
            switch,
            problem: posed,
            rest,
            is_ambiguous,
            exits: exits
                .try_into()
                .unwrap_or_else(|_| unreachable!("two sides")),
        })
    }

    /// An evaluator of the problem with the inputs of another one.
    pub fn evaluator(&self, of: &mut Evaluator<Balls>) -> Evaluator<Balls> {
        let balls = Balls::new(of.interpretation.prec);
        let mut own = Evaluator::new(self.problem.graph.clone(), balls);
        for (k, value) in inputs_of(of, self.problem.inputs).into_iter().enumerate() {
            if let Some(value) = value {
                own.set_input(k, value);
            }
        }
        own
    }

    /// The sides of the margins while the motion slides.
    pub fn margins(&self) -> impl Iterator<Item = (Switch, Side)> {
        let held = [Side::Positive, Side::Negative];
        self.exits.iter().map(|exit| exit.margin).zip(held)
    }

    /// The number of the exit whose margin a switch is.
    pub fn exit(&self, switch: Switch) -> Option<usize> {
        self.exits.iter().position(|exit| exit.margin == switch)
    }

    /// Leaves the switch by one of the exits; `fields` are those along the switch and beyond it.
    ///
    /// # Errors
    /// Why the motion is not proved to leave.
    pub fn leave(
        &self,
        exit: &Exit,
        (time, states): (&Rational, &[Ball]),
        fields: [&Smooth; 2],
        mut width: Rational,
        evaluator: &mut Evaluator<Balls>,
    ) -> Result<Crossing, Uncrossed> {
        let bits = evaluator.interpretation.prec;
        for _ in 0..4 * bits {
            let after = Rational::from(time + &width);
            let span = times(bits, time, &after);
            let way = Ball::rational(bits, &width);
            width *= 2;
            let reason = "the motion is not enclosed while it leaves a switch";
            let (hull, end) =
                enclosed(states, &fields, &span, &way).ok_or(Uncrossed::Open(reason))?;
            let [along, beyond] = fields.map(|field| field.guards(&span, &hull));
            let (Ok(along), Ok(beyond)) = (along, beyond) else {
                break;
            };
            let (out, along): (Vec<Guarded>, _) = along
                .into_iter()
                .partition(|guard| guard.switch == exit.margin);
            let (_, beyond): (Vec<Guarded>, _) = beyond
                .into_iter()
                .partition(|guard| guard.switch == self.switch);
            let is_kept = along.iter().chain(&beyond).all(Guarded::holds);
            let is_up = exit.side == Side::Positive;
            let leaves = matches!(&out[..], [guard] if guard.rises() == Some(is_up));
            if !is_kept || !leaves || !self.turns(exit, &span, &hull, evaluator) {
                break;
            }
            let at_end = fields[1].guards(&Ball::rational(bits, &after), &end);
            let past =
                |guard: &Guarded| guard.switch != self.switch || guard.rises() == Some(is_up);
            if at_end.is_ok_and(|guards| guards.iter().all(past)) {
                return Ok(Crossing::new((time, states), after, (hull, end), false));
            }
        }
        Err(Uncrossed::Open(TOUCHES))
    }

    /// True if `ḧ` along the rates of an exit's side certainly leads away from the switch.
    pub fn turns(
        &self,
        exit: &Exit,
        span: &Ball,
        states: &[Ball],
        evaluator: &mut Evaluator<Balls>,
    ) -> bool {
        let second = values_at(evaluator, &self.problem, (span, states), &[exit.second]);
        match exit.side {
            Side::Positive => second[0].is_positive(),
            _ => second[0].is_negative(),
        }
    }

    /// The sides of other switches, and that of an exit.
    pub fn sides_beyond(&self, exit: &Exit, mut sides: Sides) -> Sides {
        self.exits.iter().for_each(|exit| {
            sides.remove(&exit.margin);
        });
        sides.insert(self.switch, exit.side.clone());
        sides
    }
}

/// The values of nodes at all times and states of some balls; the whole line for one without a
/// value.
pub(super) fn values_at(
    evaluator: &mut Evaluator<Balls>,
    problem: &InitialValueProblem,
    (time, states): (&Ball, &[Ball]),
    nodes: &[Id],
) -> Vec<Ball> {
    set_again(evaluator, problem, time, states);
    let value = |id: &Id| {
        let value = evaluator.value(*id).ok();
        let value = value.and_then(|value| value.real().cloned());
        value.unwrap_or_else(super::crossing::whole)
    };
    nodes.iter().map(value).collect()
}

/// The nodes that become others on one side of a switch.
pub(super) fn choices(
    graph: &mut Graph,
    roots: &[Id],
    switch: Switch,
    is_above: bool,
) -> HashMap<Id, Id> {
    let mut map = HashMap::new();
    let all: Vec<Id> = roots.iter().flat_map(|root| graph.reach(*root)).collect();
    for id in all {
        let of_sign = |a: Id| Switch::SignOf(a) == switch;
        let node = graph.node(id);
        let is_greater = match node {
            Node::Compare(_, a, b) | Node::Binary(Func::Fmin | Func::Fmax | Func::Fdim, a, b) => {
                let (found, is_turned) = Switch::between(graph, a, b);
                (found == switch).then_some(is_above != is_turned)
            }
            Node::Unary(Func::Abs, a) if of_sign(a) => Some(is_above),
            Node::Binary(Func::Copysign, size, a) if of_sign(a) && !of_sign(size) => Some(is_above),
            _ => None,
        };
        let Some(is_greater) = is_greater else {
            continue;
        };
        let zero = graph.number(0);
        let chosen = match (node, is_greater) {
            (Node::Compare(relation, ..), _) => graph.push(Node::Truth(match relation {
                Relation::Less | Relation::LessEqual => !is_greater,
                Relation::Greater | Relation::GreaterEqual => is_greater,
                Relation::Equal => false,
                Relation::NotEqual => true,
            })),
            (Node::Binary(Func::Copysign, size, _), _) => {
                let size = graph.push(Node::Unary(Func::Abs, size));
                match is_greater {
                    true => size,
                    false => graph.push(Node::Neg(size)),
                }
            }
            (Node::Unary(_, a), true) => a,
            (Node::Unary(_, a), false) => graph.push(Node::Neg(a)),
            (Node::Binary(Func::Fdim, a, b), true) => graph.push(Node::Sub(a, b)),
            (Node::Binary(Func::Fdim, ..), false) => zero,
            (Node::Binary(Func::Fmax, a, _), true) | (Node::Binary(Func::Fmin, a, _), false) => a,
            (Node::Binary(_, _, b), _) => b,
            _ => continue,
        };
        map.insert(id, chosen);
    }
    map
}
