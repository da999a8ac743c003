//! The solution of an initial value problem, as far as it is asked for.

use super::InitialValueProblem;
use super::field::Sides;
use super::motion::{Halt, Motion};
use super::quantities::Quantities;
use crate::evaluation::adaptive::lacking;
use crate::evaluation::{Balls, Evaluator, Goal, Stop, Value};
use crate::graph::Id;
use mechaudit_reference::elementary::NoValue;
use mechaudit_reference::initial_value::Stopped;
use mechaudit_reference::{Ball, Mag};
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
    #[error("the rate of {state} has no value at {time}: {reason}", time = time.to_f64())]
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
    /// The motion at one working precision, before and after the start.
    run: [Option<Motion>; 2],
    /// The trajectory with the derivatives by starts and inputs.
    variation: Option<Box<Trajectory>>,
}

/// The derivatives of the states at a time.
#[derive(Clone, Debug)]
pub struct Derivatives {
    /// The states at the start.
    pub starts: Vec<Ball>,
    /// The states at the time.
    pub states: Vec<Ball>,
    /// State by state, the derivatives by the states at the start.
    pub by_starts: Vec<Vec<Ball>>,
    /// State by state, the derivatives by the inputs.
    pub by_inputs: Vec<Vec<Ball>>,
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
            run: [None, None],
            variation: None,
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
            evaluator.set_input(k, Value::rational(bits, input.clone()));
        }
        evaluator
    }

    /// The exact start of the time.
    fn start_time(&self) -> Result<Rational, MotionError> {
        let node = self.problem.start;
        let text = || self.problem.graph.text(node);
        match self.evaluator(64, true).value(node) {
            Ok(Value::Exact(value)) => Ok(value.number().clone()),
            Ok(_) => Err(MotionError::StartTime(text())),
            Err(stop) => Err(MotionError::Start {
                name: self.problem.time.clone(),
                reason: reason(&self.problem, &stop),
            }),
        }
    }

    /// The states at the start, and the derivatives that are carried along.
    fn starts(&self, bits: u32) -> Result<[Vec<Ball>; 2], MotionError> {
        let mut evaluator = self.evaluator(bits, false);
        let problem = &self.problem;
        let mut value = |(id, name): (&Id, &String)| {
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
        let starts = problem.starts.iter().zip(&problem.states);
        let starts = starts.map(&mut value).collect::<Result<_, _>>()?;
        let slopes = problem.variation.iter().flat_map(|v| &v.start).enumerate();
        let of = |(k, id)| value((id, &problem.states[k / problem.states.len()]));
        Ok([starts, slopes.map(of).collect::<Result<_, _>>()?])
    }

    /// The number of steps that were made in all runs.
    pub fn steps(&self) -> u64 {
        self.limits.steps - self.steps
    }

    /// The time of the start.
    pub fn start(&self) -> &Rational {
        &self.start
    }

    /// The states at an exact time, before or after the start, each in a ball that meets the goal,
    /// or the narrowest one within the limits where none does.
    ///
    /// # Errors
    /// See [`MotionError`].
    pub fn at(&mut self, time: &Rational, goal: Goal) -> Result<Vec<Ball>, MotionError> {
        let bits = match goal {
            Goal::Bits(bits) | Goal::Double(bits) => bits,
            Goal::Nearest => f64::MANTISSA_DIGITS + 8,
        };
        self.until(time, bits, |balls| {
            let lacks = balls.iter().map(|ball| lacking(ball, goal));
            lacks.max().unwrap_or(0)
        })
    }

    /// The states at an exact time by a run of at least `bits` working bits, as narrow as they
    /// come out.
    ///
    /// # Errors
    /// See [`MotionError`].
    pub fn enclosed(&mut self, time: &Rational, bits: u32) -> Result<Vec<Ball>, MotionError> {
        self.until(time, bits, |_| 0)
    }

    /// The values of the problem's quantities at a time up to which the motion is known, and the
    /// states then; `None` for one that has no value or is not enclosed. At a switch they are those
    /// on the side of the motion, or the mean along which it slides.
    ///
    /// # Errors
    /// See [`MotionError`]: the motion does not begin.
    pub fn quantities(
        &mut self,
        time: &Rational,
        states: &[Ball],
        bits: u32,
    ) -> Result<Vec<Option<Ball>>, MotionError> {
        let side = usize::from(*time < self.start);
        if let Err(halt) = self.begin(side, bits) {
            return Err(self.error(halt, side));
        }
        let run = self.run[side].as_mut().expect("a run");
        let when = Ball::rational(bits + SPARE, time);
        Ok(run.quantities(&self.problem, time, (&when, states)))
    }

    /// The values of the problem's quantities at all times and states of some balls, whatever the
    /// sides of its switches there are.
    pub fn quantities_across(&self, time: &Ball, states: &[Ball]) -> Vec<Option<Ball>> {
        let mut evaluator = self.evaluator(time.prec(), false);
        let quantities = Quantities::on(&self.problem, &Sides::new());
        quantities.values(&self.problem, &mut evaluator, (time, states))
    }

    /// The states at a time, at precisions that are raised by the bits that are lacking.
    fn until(
        &mut self,
        time: &Rational,
        bits: u32,
        lacking: impl Fn(&[Ball]) -> u32,
    ) -> Result<Vec<Ball>, MotionError> {
        /// Runs at twice the precision for a value that may be zero.
        const DOUBLINGS: u32 = 2;
        let first = bits.saturating_add(SPARE).next_multiple_of(32);
        let mut bits = first.min(self.limits.bits);
        let mut doublings = 0;
        let side = usize::from(*time < self.start);
        // Where a run has served other times, later ones are likely to follow.
        let is_row = self.run[side].is_some();
        loop {
            let found = self.at_bits(time, bits);
            let done = self.run[side].as_ref().map_or(bits, Motion::bits);
            let is_last = done >= self.limits.bits;
            let next = match found {
                Ok(balls) => match lacking(&balls) {
                    0 => return Ok(balls),
                    _ if is_last || doublings == DOUBLINGS => return Ok(balls),
                    u32::MAX => {
                        doublings += 1;
                        done.saturating_mul(2)
                    }
                    lacks => {
                        let carried = done.saturating_sub(first) + SPARE;
                        let more = (lacks + 16).max(if is_row { carried } else { 0 });
                        done.saturating_add(more).next_multiple_of(32)
                    }
                },
                Err(halt) if halt.is_precision() && !is_last => done.saturating_mul(2),
                Err(halt) => return Err(self.error(halt, side)),
            };
            bits = next.min(self.limits.bits);
        }
    }

    /// The states at a time by a run of at least `bits` bits.
    fn at_bits(&mut self, time: &Rational, bits: u32) -> Result<Vec<Ball>, Halt> {
        let side = usize::from(*time < self.start);
        if self.problem.variation.is_some() && *time == self.start {
            return self
                .starts(bits)
                .map(|found| found.concat())
                .map_err(Halt::Error);
        }
        self.begin(side, bits)?;
        let run = self.run[side].as_mut().expect("a run");
        run.at(&self.problem, time, &mut self.steps)
    }

    /// Begins a run of at least `bits` bits before or after the start, if there is none yet.
    fn begin(&mut self, side: usize, bits: u32) -> Result<(), Halt> {
        if self.run[side].as_ref().is_none_or(|run| run.bits() < bits) {
            // Starts and constants are rounded once more than anything else.
            let [starts, variation] = self.starts(bits + 16).map_err(Halt::Error)?;
            let evaluator = self.evaluator(bits + 16, false);
            let start = self.start.clone();
            self.run[side] = None;
            let starts = (starts, variation);
            let motion = Motion::new(&self.problem, evaluator, start, starts, (bits, side == 1));
            self.run[side] = Some(motion?);
        }
        Ok(())
    }

    fn error(&self, halt: Halt, side: usize) -> MotionError {
        let undecided = |reached: Rational, reason: &str| MotionError::Undecided {
            reached,
            reason: reason.into(),
        };
        let stopped = match halt {
            Halt::Error(error) => return error,
            Halt::Switch { reached, reason } => return undecided(reached, reason),
            Halt::Rate { node, reason, time } => {
                return rate_error(&self.problem, node, reason, &time);
            }
            Halt::Stopped(stopped) => stopped,
        };
        match stopped {
            Stopped::Obstacle {
                reached,
                in_jacobian,
                obstacle,
            } => {
                let run = self.run[side].as_ref().expect("a run that stopped");
                let node = run.origin(in_jacobian, obstacle.slot);
                match in_jacobian {
                    false => rate_error(&self.problem, node, obstacle.reason, &reached),
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

    /// The derivatives of the states at a time by those at the start and by the inputs: `S′ =
    /// (∂f/∂y) S + ∂f/∂p` along the motion, carried along in double numbers with radii. For each
    /// state the errors add up to at most 2^−20 of itself or of `Σ |y_k(0) ∂y/∂y_k(0)| + Σ |p_j
    /// ∂y/∂p_j|` where double numbers can say that.
    ///
    /// # Errors
    /// See [`MotionError`]; inputs by which the rates have no derivative in the language are
    /// undecided.
    pub fn derivatives(&mut self, time: &Rational) -> Result<Derivatives, MotionError> {
        /// The working precision at first, without the spare bits.
        const BITS: u32 = 64;
        /// Bits of a sum of derivatives.
        const ACCURACY: i64 = 20;
        if self.variation.is_none() {
            let problem = self.problem.with_variation();
            let problem = problem.map_err(|error| MotionError::Undecided {
                reached: self.start.clone(),
                reason: error.to_string(),
            })?;
            let trajectory = Trajectory::new(problem, &self.inputs, self.limits)?;
            self.variation = Some(Box::new(trajectory));
        }
        let trajectory = self.variation.as_mut().expect("a trajectory");
        let [data, _] = trajectory.starts(BITS)?;
        let (n, size) = (self.problem.states.len(), data.len());
        let found = trajectory.until(time, BITS, |found| {
            let is_open = (0..n).any(|i| {
                let row = found[size * (1 + i)..].iter().zip(&data);
                let terms = row.filter(|(_, x)| !x.is_zero()).map(|(s, x)| s * x);
                let mut error = Mag::ZERO;
                // Beside it radii of double numbers are no longer relative ones.
                let mut sum = found[i].mignitude().max(Mag::power_of_two(-900));
                for term in terms {
                    sum = sum.max(term.mignitude());
                    error = error.add(term.rad());
                }
                error > sum.shift(-ACCURACY)
            });
            if is_open { u32::MAX } else { 0 }
        })?;
        let rows = || found[size..].chunks(size).take(n);
        Ok(Derivatives {
            starts: data[..n].to_vec(),
            states: found[..n].to_vec(),
            by_starts: rows().map(|row| row[..n].to_vec()).collect(),
            by_inputs: rows().map(|row| row[n..].to_vec()).collect(),
        })
    }

    /// Enclosures of the times at which the rates switched from one smooth piece to another, and
    /// of the states then, as far as the motion is known: those after the start, then those before
    /// it.
    pub fn switches(&self) -> Vec<(Ball, Vec<Ball>)> {
        let known = [&self.run[0], &self.run[1]].into_iter().flatten();
        known.flat_map(Motion::switches).collect()
    }
}

/// A node without a value, as that of the first rate that needs it.
fn rate_error(
    problem: &InitialValueProblem,
    node: Id,
    reason: NoValue,
    time: &Rational,
) -> MotionError {
    let graph = &problem.graph;
    let mut rates = problem.rates.iter().zip(&problem.states);
    let of = rates.find(|(rate, _)| graph.reach(**rate).contains(&node));
    let state = of.map_or(&problem.states[0], |found| found.1).clone();
    MotionError::Rate {
        state,
        time: time.clone(),
        reason: format!("{}: {}", why(reason), graph.text(node)),
    }
}

fn why(reason: NoValue) -> String {
    match reason {
        NoValue::Undefined(why) | NoValue::Undecided(why) => why.to_string(),
        other => other.to_string(),
    }
}

fn reason(problem: &InitialValueProblem, stop: &Stop) -> String {
    format!("{}: {}", why(stop.reason), problem.graph.text(stop.node))
}
