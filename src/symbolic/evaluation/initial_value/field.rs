//! The smooth field of a problem on the chosen sides of its switches.

use super::InitialValueProblem;
use crate::evaluation::real::unary;
use crate::evaluation::taylor::{Compiled, Fixed, Side, Switch, Unsupported, compile};
use crate::evaluation::{Balls, Evaluator, Value};
use crate::graph::{Id, Node};
use mechaudit_reference::elementary::NoValue;
use mechaudit_reference::initial_value::{Constants, Field, Obstacle, Slot, values};
use mechaudit_reference::{Ball, Mag};
use std::collections::HashMap;

/// The sides of the switches that a motion has met.
pub(super) type Sides = HashMap<Switch, Side>;

/// A smooth field with its constants at a working precision.
pub(super) struct Smooth {
    pub field: Field,
    pub constants: Constants,
    sides: Sides,
    rates: Compiled,
    jacobian: Compiled,
    /// The rows of the entries of the Jacobian, and their places.
    entries: Vec<(usize, Slot)>,
    outputs: Vec<Slot>,
    guards: Guards,
}

/// A program for the values that change their signs at switches, and for their rates along the
/// motion.
struct Guards {
    compiled: Compiled,
    constants: Vec<Ball>,
    rates: Vec<Option<Slot>>,
}

/// The value of a guard, and the sign that it has to have.
pub(super) struct Guarded {
    pub switch: Switch,
    pub positive: bool,
    pub value: Ball,
    /// The rate of the value, where the language has one.
    pub rate: Option<Ball>,
}

/// Reason of a switch at which a motion is.
pub(super) const AT_SWITCH: NoValue = NoValue::Undecided("the side of a switch");

type Fault = (Id, NoValue);

impl Smooth {
    /// The field on the given sides of switches; the sides of others are those of the evaluator's
    /// states.
    ///
    /// # Errors
    /// A node without a Taylor series or without a value, and why.
    pub fn new(
        problem: &InitialValueProblem,
        evaluator: &mut Evaluator<Balls>,
        known: &Sides,
    ) -> Result<Smooth, Fault> {
        let graph = &problem.graph;
        let unsupported = |u: Unsupported| (u.node, u.reason);
        let mut sides = known.clone();
        let mut choose = |switch: Switch| match sides.get(&switch) {
            Some(side) => Ok(side.clone()),
            None => {
                let side = side(evaluator, switch)?;
                sides.insert(switch, side.clone());
                Ok(side)
            }
        };
        let mut compiled = |roots: &[Id], switches: &[Switch]| {
            compile(graph, problem.inputs, roots, switches, &mut choose).map_err(unsupported)
        };
        let (rates, outputs) = compiled(&problem.rates, &[])?;
        let slopes: Vec<Id> = problem.jacobian.iter().map(|e| e.2).collect();
        let (jacobian, slots) = compiled(&slopes, &[])?;
        let mut switches: Vec<Switch> = problem.margins.clone();
        for guard in rates.guards.iter().chain(&jacobian.guards) {
            if !switches.contains(&guard.switch) {
                switches.push(guard.switch);
            }
        }
        let rate_of = |switch: &Switch| {
            let known = problem.switches.iter().find(|s| s.0 == *switch);
            known.and_then(|s| s.1)
        };
        let rated: Vec<Id> = switches.iter().filter_map(rate_of).collect();
        let (guards, rated_slots) = compiled(&rated, &switches)?;
        let rated: HashMap<Id, Slot> = rated.into_iter().zip(rated_slots).collect();
        let guard_rates = guards.guards.iter().map(|guard| {
            let rate = rate_of(&guard.switch)?;
            rated.get(&rate).copied()
        });
        let guards = Guards {
            rates: guard_rates.collect(),
            constants: constants(evaluator, &guards)?,
            compiled: guards,
        };
        let entries = problem.jacobian.iter().zip(slots);
        let entries = entries.map(|((row, column, _), slot)| (*row, *column, slot));
        let entries: Vec<(usize, usize, Slot)> = entries.collect();
        let constants = Constants {
            rates: constants(evaluator, &rates)?,
            jacobian: constants(evaluator, &jacobian)?,
        };
        Ok(Smooth {
            field: Field::new(
                rates.program.clone(),
                outputs.clone(),
                jacobian.program.clone(),
                entries.clone(),
            ),
            constants,
            sides,
            rates,
            jacobian,
            entries: entries.iter().map(|e| (e.0, e.2)).collect(),
            outputs,
            guards,
        })
    }

    /// Returns true if the field is this one only on one side of some switches.
    pub fn is_guarded(&self) -> bool {
        !self.guards.compiled.guards.is_empty()
    }

    /// The sides of the switches that the field is guarded at.
    pub fn active(&self) -> Sides {
        let guards = self.guards.compiled.guards.iter();
        let sides = guards.filter_map(|guard| {
            let side = self.sides.get(&guard.switch)?;
            Some((guard.switch, side.clone()))
        });
        sides.collect()
    }

    /// The node of an operation.
    pub fn origin(&self, in_jacobian: bool, slot: Slot) -> Id {
        let compiled = match in_jacobian {
            true => &self.jacobian,
            false => &self.rates,
        };
        compiled.origin[slot]
    }

    /// The rates at all times and states of some balls.
    pub fn rates(&self, time: &Ball, states: &[Ball]) -> Result<Vec<Ball>, Obstacle> {
        let bits = time.prec();
        let (program, constants) = (&self.rates.program, &self.constants.rates);
        values(program, constants, time, states, &self.outputs, bits)
    }

    /// Row by row, the sum of the magnitudes of the Jacobian's entries for all times and states of
    /// some balls.
    pub fn steepness(&self, time: &Ball, states: &[Ball]) -> Result<Vec<Mag>, Obstacle> {
        let (program, constants) = (&self.jacobian.program, &self.constants.jacobian);
        let slots: Vec<Slot> = self.entries.iter().map(|e| e.1).collect();
        let found = values(program, constants, time, states, &slots, time.prec())?;
        let mut rows = vec![Mag::ZERO; states.len()];
        for ((row, _), entry) in self.entries.iter().zip(found) {
            rows[*row] = rows[*row].add(entry.magnitude());
        }
        Ok(rows)
    }

    /// The guards at all times and states of some balls.
    pub fn guards(&self, time: &Ball, states: &[Ball]) -> Result<Vec<Guarded>, Obstacle> {
        let bits = time.prec();
        let compiled = &self.guards.compiled;
        let own = compiled.guards.iter().map(|guard| guard.slot);
        let slots: Vec<Slot> = own
            .chain(self.guards.rates.iter().flatten().copied())
            .collect();
        let program = &compiled.program;
        let found = values(program, &self.guards.constants, time, states, &slots, bits)?;
        let (found, rates) = found.split_at(compiled.guards.len());
        let mut rates = rates.iter();
        let guards = compiled.guards.iter().zip(found).zip(&self.guards.rates);
        let guards = guards.map(|((guard, value), rate)| Guarded {
            switch: guard.switch,
            positive: guard.positive,
            value: value.clone(),
            rate: rate.and_then(|_| rates.next().cloned()),
        });
        Ok(guards.collect())
    }
}

impl Guarded {
    /// Returns true if the value certainly has the sign that it has to have.
    pub fn holds(&self) -> bool {
        match self.positive {
            true => self.value.is_positive(),
            false => self.value.is_negative(),
        }
    }

    /// Returns true if the value certainly has the other sign.
    pub fn fails(&self) -> bool {
        match self.positive {
            true => self.value.is_negative(),
            false => self.value.is_positive(),
        }
    }

    /// A lower bound on the rate towards zero, where the value certainly moves towards it.
    pub fn pull(&self) -> Option<Mag> {
        let rate = self.rate.as_ref()?;
        (self.rises()? != self.positive).then(|| rate.mignitude())
    }

    /// True if the value certainly rises, false if it falls.
    pub fn rises(&self) -> Option<bool> {
        let rate = self.rate.as_ref()?;
        match (rate.is_positive(), rate.is_negative()) {
            (true, _) => Some(true),
            (_, true) => Some(false),
            _ => None,
        }
    }
}

/// Gives an evaluator the time and the states.
pub(super) fn set(
    evaluator: &mut Evaluator<Balls>,
    problem: &InitialValueProblem,
    time: &Ball,
    states: &[Ball],
) {
    evaluator.set_input(problem.inputs, Value::Real(time.clone()));
    for (k, state) in states.iter().enumerate() {
        evaluator.set_input(problem.inputs + 1 + k, Value::Real(state.clone()));
    }
}

/// The values of some inputs of an evaluator.
pub(super) fn inputs_of(evaluator: &mut Evaluator<Balls>, inputs: usize) -> Vec<Option<Value>> {
    let value = |k: usize| {
        let id = evaluator.graph().find(Node::Input(k as u32))?;
        evaluator.value(id).ok().cloned()
    };
    (0..inputs).map(value).collect()
}

/// Forgets what depends on the last states, and gives others.
pub(super) fn set_again(
    evaluator: &mut Evaluator<Balls>,
    problem: &InitialValueProblem,
    time: &Ball,
    states: &[Ball],
) {
    let inputs = inputs_of(evaluator, problem.inputs);
    evaluator.reset(false);
    for (k, value) in inputs.into_iter().enumerate() {
        if let Some(value) = value {
            evaluator.set_input(k, value);
        }
    }
    set(evaluator, problem, time, states);
}

/// The values of the constants of a program.
fn constants(evaluator: &mut Evaluator<Balls>, compiled: &Compiled) -> Result<Vec<Ball>, Fault> {
    let bits = evaluator.interpretation.prec;
    let value = |fixed: &Fixed| match fixed {
        Fixed::Number(n) => Ok(Ball::rational(bits, n)),
        Fixed::TwoOverRootPi => Ok(Ball::pi(bits).sqrt().recip().shift(1)),
        Fixed::HalfPi => Ok(Ball::pi(bits).shift(-1)),
        Fixed::Node(id) => match evaluator.value(*id) {
            Ok(value) => match value.real() {
                Some(ball) => Ok(ball.clone()),
                None => Err((*id, NoValue::Undefined("a value that is not a real number"))),
            },
            Err(stop) => Err((stop.node, stop.reason)),
        },
    };
    compiled.constants.iter().map(value).collect()
}

/// The side of a switch at the values of the evaluator.
pub(super) fn side(evaluator: &mut Evaluator<Balls>, switch: Switch) -> Result<Side, NoValue> {
    let mut real = |id: Id| -> Result<Ball, NoValue> {
        let value = evaluator.value(id).map_err(|stop| stop.reason)?;
        value.real().cloned().ok_or(AT_SWITCH)
    };
    let difference = match switch {
        Switch::SignOf(a) => real(a)?,
        Switch::Sign(a, b) => real(a)? - real(b)?,
        Switch::Step(f, a) => {
            let a = real(a)?;
            // At an end of a step the value is not that of a neighbourhood.
            let off = Mag::power_of_two(-i64::from(a.prec()));
            let value = unary(f, &a.widened(off), a.prec())?;
            let integer = value.real().filter(|n| n.rad().is_zero());
            let integer = integer.and_then(|n| n.mid().to_rational());
            return integer.map(Side::Integer).ok_or(AT_SWITCH);
        }
    };
    match () {
        () if difference.is_positive() => Ok(Side::Positive),
        () if difference.is_negative() => Ok(Side::Negative),
        () => Err(AT_SWITCH),
    }
}
