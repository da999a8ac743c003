//! The smooth field of a problem on the chosen sides of its switches.

use super::InitialValueProblem;
use crate::evaluation::taylor::{Compiled, Fixed, Side, Switch, Unsupported, compile};
use crate::evaluation::{Balls, Evaluator, Value};
use crate::graph::{Id, Node};
use mechaudit_reference::Ball;
use mechaudit_reference::elementary::NoValue;
use mechaudit_reference::initial_value::{Constants, Field, Slot};
use rug::Rational;

/// A smooth field with its constants at a working precision.
pub(super) struct Smooth {
    pub field: Field,
    pub constants: Constants,
    rates: Compiled,
    jacobian: Compiled,
}

const AT_SWITCH: NoValue = NoValue::Undecided("the side of a switch");

impl Smooth {
    /// The field on the sides of switches where a motion is at a time; the evaluator knows the inputs.
    ///
    /// # Errors
    /// A node without a Taylor series or without a value, and why.
    pub fn new(
        problem: &InitialValueProblem,
        mut evaluator: Evaluator<Balls>,
        time: &Rational,
        states: &[Ball],
    ) -> Result<Smooth, (Id, NoValue)> {
        let bits = evaluator.interpretation.prec;
        evaluator.set_input(problem.inputs, Value::Real(Ball::rational(bits, time)));
        for (k, state) in states.iter().enumerate() {
            evaluator.set_input(problem.inputs + 1 + k, Value::Real(state.clone()));
        }
        let graph = &problem.graph;
        let unsupported = |u: Unsupported| (u.node, u.reason);
        let mut choose = |switch: Switch| side(&mut evaluator, switch);
        let (rates, outputs) = compile(graph, problem.inputs, &problem.rates, &[], &mut choose)
            .map_err(unsupported)?;
        let switches: Vec<Switch> = rates.guards.iter().map(|g| g.switch).collect();
        let slopes: Vec<Id> = problem.jacobian.iter().map(|e| e.2).collect();
        let (jacobian, slots) =
            compile(graph, problem.inputs, &slopes, &switches, &mut choose).map_err(unsupported)?;
        let entries = problem.jacobian.iter().zip(slots);
        let entries = entries.map(|((row, column, _), slot)| (*row, *column, slot));
        let constants = Constants {
            rates: constants(&mut evaluator, &rates)?,
            jacobian: constants(&mut evaluator, &jacobian)?,
        };
        Ok(Smooth {
            field: Field::new(
                rates.program.clone(),
                outputs,
                jacobian.program.clone(),
                entries.collect(),
            ),
            constants,
            rates,
            jacobian,
        })
    }

    /// The node of an operation.
    pub fn origin(&self, in_jacobian: bool, slot: Slot) -> Id {
        let compiled = match in_jacobian {
            true => &self.jacobian,
            false => &self.rates,
        };
        compiled.origin[slot]
    }
}

/// The values of the constants of a program.
fn constants(
    evaluator: &mut Evaluator<Balls>,
    compiled: &Compiled,
) -> Result<Vec<Ball>, (Id, NoValue)> {
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
fn side(evaluator: &mut Evaluator<Balls>, switch: Switch) -> Result<Side, NoValue> {
    let mut real = |id: Id| -> Result<Ball, NoValue> {
        let value = evaluator.value(id).map_err(|stop| stop.reason)?;
        value.real().cloned().ok_or(AT_SWITCH)
    };
    let difference = match switch {
        Switch::SignOf(a) => real(a)?,
        Switch::Sign(a, b) => real(a)? - real(b)?,
        Switch::Step(f, a) => {
            let a = real(a)?;
            let value = crate::evaluation::ball::unary(f, &a, a.prec())?;
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

#[allow(unused)]
fn is_input(node: Node) -> bool {
    matches!(node, Node::Input(_))
}
