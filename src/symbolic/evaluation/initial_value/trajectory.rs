//! The solution of an initial value problem, as far as it is asked for.

use super::InitialValueProblem;
use super::field::Smooth;
use crate::evaluation::adaptive::lacking;
use crate::evaluation::{Balls, Evaluator, Goal, Stop, Value};
use crate::graph::Id;
use mechaudit_reference::Ball;
use mechaudit_reference::elementary::NoValue;
use mechaudit_reference::initial_value::{Solution, Stopped};
use rug::Rational;

/// Limits on the work of one trajectory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// The highest working precision in bits.
    pub bits: u32,
    /// The most steps of all runs together.
    pub steps: u64,
}

impl Default for Limits {
    /// 4096 bits and a million steps.
    fn default() -> Limits {
        Limits {
            bits: 4096,
            steps: 1_000_000,
        }
    }
}

/// Reason why a motion has no certified value at a time.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MotionError {
    /// A start has no value.
    #[error("the start of {name} has no value: {reason}")]
    Start {
        /// The state, or the time.
        name: String,
        /// Why.
        reason: String,
    },
    /// The start of the time is not a rational number.
    #[error("the start of the time {0} is not a rational number")]
    StartTime(String),
    /// A rate has no value.
    #[error("the rate of {state} is undefined at {time}: {reason}", time = time.to_f64())]
    Rate {
        /// The state.
        state: String,
        /// The time up to which the motion is known.
        time: Rational,
        /// Why.
        reason: String,
    },
    /// The solution grows without bound in finite time, or seems to.
    #[error("the motion is known up to {reached} and grows without bound near {near}", reached = reached.to_f64())]
    BlowUp {
        /// The time up to which the motion is proved to exist.
        reached: Rational,
        /// An estimate, which is not proved, of the time where it ceases to exist.
        near: f64,
    },
    /// Nothing is proved beyond a time.
    #[error("undecided beyond {reached}: {reason}", reached = reached.to_f64())]
    Undecided {
        /// The time up to which the motion is proved to exist.
        reached: Rational,
        /// Why.
        reason: String,
    },
}

/// The solution of an initial value problem for one set of inputs, extended as it is asked for.
pub struct Trajectory {
    problem: InitialValueProblem,
    inputs: Vec<Rational>,
    limits: Limits,
    /// Steps that are left.
    steps: u64,
    start: Rational,
    run: Option<Run>,
}

/// A run at one working precision.
struct Run {
    bits: u32,
    field: Smooth,
    solution: Solution,
}

/// Bits that errors may take while they are carried on, before a run is made once more.
const SPARE: u32 = 64;

impl Trajectory {
    pub(super) fn new(
        problem: &InitialValueProblem,
        inputs: &[Rational],
        limits: Limits,
    ) -> Result<Trajectory, MotionError> {
        assert_eq!(inputs.len(), problem.inputs, "a value for each input");
        let mut trajectory = Trajectory {
            problem: problem.clone(),
            inputs: inputs.to_vec(),
            limits,
            steps: limits.steps,
            start: Rational::new(),
            run: None,
        };
        trajectory.start = trajectory.start_time()?;
        Ok(trajectory)
    }

    /// An evaluator of what depends on the inputs alone.
    fn evaluator(&self, bits: u32, exact: bool) -> Evaluator<Balls> {
        let mut balls = Balls::new(bits);
        balls.exact = exact;
        let mut evaluator = Evaluator::new(self.problem.graph.clone(), balls);
        for (k, input) in self.inputs.iter().enumerate() {
            let ball = Ball::rational(bits, input);
            evaluator.set_input(k, Value::Exact(Box::new((input.clone(), ball))));
        }
        evaluator
    }

    /// The exact start of the time.
    fn start_time(&self) -> Result<Rational, MotionError> {
        let node = self.problem.start;
        let text = || self.problem.graph.text(node);
        match self.evaluator(64, true).value(node) {
            Ok(Value::Exact(value)) => Ok(value.0.clone()),
            Ok(_) => Err(MotionError::StartTime(text())),
            Err(stop) => Err(MotionError::Start {
                name: self.problem.time.clone(),
                reason: reason(&self.problem, &stop),
            }),
        }
    }

    /// The values of nodes that depend on the inputs alone.
    fn starts(&self, bits: u32) -> Result<Vec<Ball>, MotionError> {
        let mut evaluator = self.evaluator(bits, false);
        let starts = self.problem.starts.iter().zip(&self.problem.states);
        let value = |(id, name): (&Id, &String)| {
            let fault = |reason: String| MotionError::Start {
                name: name.clone(),
                reason,
            };
            match evaluator.value(*id) {
                Ok(value) => match value.real() {
                    Some(ball) => Ok(ball.clone()),
                    None => Err(fault("its value is not a real number".into())),
                },
                Err(stop) => Err(fault(reason(&self.problem, &stop))),
            }
        };
        starts.map(value).collect()
    }

    #[cfg(test)]
    pub(super) fn work(&self) -> String {
        let run = self
            .run
            .as_ref()
            .map(|run| (run.bits, run.solution.steps()));
        format!("{run:?} {}", self.limits.steps - self.steps)
    }

    /// The time of the start.
    pub fn start(&self) -> &Rational {
        &self.start
    }

    /// The states at an exact time, before or after the start, each in a ball that meets the goal, or the narrowest
    /// one within the limits where none does.
    ///
    /// # Errors
    /// See [`MotionError`].
    pub fn at(&mut self, time: &Rational, goal: Goal) -> Result<Vec<Ball>, MotionError> {
        let bits = match goal {
            Goal::Bits(bits) | Goal::Double(bits) => bits,
            Goal::Nearest => f64::MANTISSA_DIGITS + 8,
        };
        let first = bits.saturating_add(SPARE).next_multiple_of(32);
        let mut bits = first.min(self.limits.bits);
        let mut doublings = 0;
        loop {
            let found = self.at_bits(time, bits);
            let bits_now = self.run.as_ref().map_or(bits, |run| run.bits);
            let is_last = bits_now >= self.limits.bits;
            bits = match found {
                Ok(balls) => {
                    let lacks = balls.iter().map(|ball| lacking(ball, goal)).max();
                    match lacks.unwrap_or(0) {
                        0 => return Ok(balls),
                        _ if is_last || doublings == 2 => return Ok(balls),
                        // A value that may be zero.
                        u32::MAX => {
                            doublings += 1;
                            bits_now.saturating_mul(2)
                        }
                        lacks => bits_now.saturating_add(lacks + 16).next_multiple_of(32),
                    }
                }
                Err(Halt::Stopped(Stopped::Wide { .. })) if !is_last => bits_now.saturating_mul(2),
                Err(Halt::Stopped(stopped)) => return Err(self.error(stopped)),
                Err(Halt::Error(error)) => return Err(error),
            };
            bits = bits.min(self.limits.bits);
        }
    }

    /// The states at a time by a run of at least so many bits.
    fn at_bits(&mut self, time: &Rational, bits: u32) -> Result<Vec<Ball>, Halt> {
        if self.run.as_ref().is_none_or(|run| run.bits < bits) {
            self.run = Some(self.begin(bits).map_err(Halt::Error)?);
        }
        let run = self.run.as_mut().expect("a run");
        let found = run.solution.at(
            &run.field.field,
            &run.field.constants,
            time,
            &mut self.steps,
        );
        found.map_err(Halt::Stopped)
    }

    fn begin(&self, bits: u32) -> Result<Run, MotionError> {
        // Starts and constants are rounded once more than anything else.
        let starts = self.starts(bits + 16)?;
        let evaluator = self.evaluator(bits + 16, false);
        let field = Smooth::new(&self.problem, evaluator, &self.start, &starts);
        let field = field.map_err(|(node, reason)| self.rate_error(node, reason, &self.start))?;
        Ok(Run {
            bits,
            field,
            solution: Solution::new(self.start.clone(), &starts, bits),
        })
    }

    /// A node without a value, as that of the first rate that needs it.
    fn rate_error(&self, node: Id, reason: NoValue, time: &Rational) -> MotionError {
        let graph = &self.problem.graph;
        let rates = self.problem.rates.iter().zip(&self.problem.states);
        let of = rates
            .clone()
            .find(|(rate, _)| **rate >= node && graph.reach(**rate).contains(&node));
        let state = of.map_or(&self.problem.states[0], |found| found.1).clone();
        let reason = match reason {
            NoValue::Undefined(why) | NoValue::Undecided(why) => why.to_string(),
            other => other.to_string(),
        };
        MotionError::Rate {
            state,
            time: time.clone(),
            reason: format!("{reason}: {}", graph.text(node)),
        }
    }

    fn error(&self, stopped: Stopped) -> MotionError {
        let undecided = |reached: Rational, reason: &str| MotionError::Undecided {
            reached,
            reason: reason.into(),
        };
        match stopped {
            Stopped::Obstacle {
                reached,
                in_jacobian,
                obstacle,
            } => {
                let run = self.run.as_ref().expect("a run that stopped");
                let node = run.field.origin(in_jacobian, obstacle.slot);
                match in_jacobian {
                    false => self.rate_error(node, obstacle.reason, &reached),
                    true => {
                        let text = self.problem.graph.text(node);
                        undecided(reached, &format!("{}: {text}", obstacle.reason))
                    }
                }
            }
            Stopped::Unbounded { reached, near } => MotionError::BlowUp { reached, near },
            Stopped::Short { reached } => undecided(
                reached,
                "the steps become too short, as next to a singularity",
            ),
            Stopped::Wide { reached } => undecided(
                reached,
                "the errors grow too large within the limit on the working precision",
            ),
            Stopped::Steps { reached } => undecided(reached, "the limit on the number of steps"),
        }
    }

    /// The derivatives of the states by the inputs at a time, state by state, each with at least `bits` bits where
    /// the limits allow it.
    ///
    /// # Errors
    /// See [`MotionError`], and inputs by which the rates have no derivative in the language.
    pub fn sensitivities(
        &mut self,
        _time: &Rational,
        _bits: u32,
    ) -> Result<Vec<Vec<Ball>>, MotionError> {
        todo!()
    }

    /// Enclosures of the times at which the rates switched from one smooth piece to another, as far as the motion is
    /// known.
    pub fn switches(&self) -> Vec<Ball> {
        Vec::new()
    }
}

/// Reason why a run has no value at a time.
enum Halt {
    Stopped(Stopped),
    Error(MotionError),
}

fn reason(problem: &InitialValueProblem, stop: &Stop) -> String {
    let why = match stop.reason {
        NoValue::Undefined(why) | NoValue::Undecided(why) => why.to_string(),
        other => other.to_string(),
    };
    format!("{why}: {}", problem.graph.text(stop.node))
}
