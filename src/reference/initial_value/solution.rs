//! A solution as a sequence of steps from its start, in both directions.

use super::enclosed::Enclosed;
use super::set::ErrorSet;
use super::step::{Failure, Place, Setting, Step};
use super::{Constants, Field, Obstacle};
use crate::{Ball, Mag};
use rug::Rational;

/// Reason why a solution is not continued, and the time up to which it is proved to exist.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Stopped {
    /// An operation of the rates, or of their derivatives, has no value.
    #[error("a rate without a value beyond {reached}: {}", obstacle.reason, reached = reached.to_f64())]
    Obstacle {
        /// The last time.
        reached: Rational,
        /// True if it is one of the derivatives.
        in_jacobian: bool,
        /// The operation.
        obstacle: Obstacle,
    },
    /// A state grows without bound, or seems to.
    #[error("known up to {reached}, unbounded near {near}", reached = reached.to_f64())]
    Unbounded {
        /// The last time.
        reached: Rational,
        /// An estimate of the time where the solution ends.
        near: f64,
    },
    /// The steps become too short, as next to a singularity.
    #[error("the steps become too short at {reached}", reached = reached.to_f64())]
    Short {
        /// The last time.
        reached: Rational,
    },
    /// The errors have grown too large for a proof; a higher precision helps.
    #[error("the errors are too large at {reached}", reached = reached.to_f64())]
    Wide {
        /// The last time.
        reached: Rational,
    },
    /// The limit on the number of steps.
    #[error("the limit on steps is reached at {reached}", reached = reached.to_f64())]
    Steps {
        /// The last time.
        reached: Rational,
    },
}

/// The steps in one direction.
#[derive(Clone, Debug)]
struct Branch {
    backward: bool,
    /// The longest that the first step may be.
    first: f64,
    /// Where steps begin; the last one is not continued yet.
    places: Vec<Place>,
    /// The lengths of the steps.
    lengths: Vec<f64>,
    /// A step that is at hand, by its number.
    current: Option<(usize, Step)>,
    /// The sizes of the states when steps were 2^20 times as long.
    sizes: Vec<(f64, Mag)>,
    stopped: Option<Stopped>,
}

/// A certified solution of an initial value problem at a working precision.
///
/// The field and its constants have to be the same at each call.
#[derive(Clone, Debug)]
pub struct Solution {
    bits: u32,
    order: usize,
    branches: [Branch; 2],
}

/// Steps that are shorter than this part of the time since the start end the search for the way.
const SHORTEST: f64 = 1.0 / (1u64 << 40) as f64;

impl Solution {
    /// Creates the solution from the states at an exact time, at a working precision.
    ///
    /// # Panics
    /// If there is no state.
    pub fn new(time: Rational, states: &[Ball], bits: u32) -> Solution {
        assert!(!states.is_empty(), "a solution has states");
        let rounded: Vec<Ball> = states.iter().map(|s| s.with_prec(bits)).collect();
        let radii: Vec<Mag> = rounded.iter().map(Ball::rad).collect();
        let place = Place {
            time,
            mid: rounded.iter().map(|b| b.mid().clone()).collect(),
            errors: ErrorSet::of_boxes(&[radii], &vec![1.0; states.len()]),
            carried: None,
        };
        let branch = |backward| Branch {
            backward,
            first: (1u64 << 40) as f64,
            places: vec![place.clone()],
            lengths: Vec::new(),
            current: None,
            sizes: Vec::new(),
            stopped: None,
        };
        Solution {
            bits,
            order: (f64::from(bits) * 0.35) as usize + 6,
            branches: [branch(false), branch(true)],
        }
    }

    /// The solution with a matrix S that the linearised flow carries along: `S′ = (∂f/∂y) S`, given
    /// at the start row by row. It is known to the accuracy of double numbers at best.
    pub fn carrying(mut self, matrix: &[Ball]) -> Solution {
        for branch in &mut self.branches {
            let place = &mut branch.places[0];
            let start = Enclosed::of_balls(place.mid.len(), matrix);
            let mut radii = vec![place.errors.radii()];
            radii.extend(start.columns_of_radii());
            place.errors = ErrorSet::of_boxes(&radii, &vec![1.0; start.n]);
            place.carried = Some(Enclosed::exact(start.n, start.mid));
        }
        self
    }

    /// Begins once more with first steps of at most some length. Of a solution that is simpler than its
    /// field, as a motion that slides, coefficients are rounding errors, which bound no step; and
    /// errors of a step are those of its end.
    pub fn shorten(&mut self, length: f64) {
        for branch in &mut self.branches {
            branch.first = branch.first.min(length);
            branch.places.truncate(1);
            branch.lengths.clear();
            branch.sizes.clear();
            (branch.current, branch.stopped) = (None, None);
        }
    }

    /// The working precision in bits.
    pub fn bits(&self) -> u32 {
        self.bits
    }

    /// The number of steps that are at hand.
    pub fn steps(&self) -> usize {
        self.branches.iter().map(|b| b.lengths.len()).sum()
    }

    /// The states at an exact time. `steps` is the number of steps that may be made, and is reduced
    /// by those that were.
    ///
    /// # Errors
    /// See [`Stopped`].
    pub fn at(
        &mut self,
        field: &Field,
        constants: &Constants,
        time: &Rational,
        steps: &mut u64,
    ) -> Result<Vec<Ball>, Stopped> {
        let is_backward = *time < self.branches[0].places[0].time;
        let step = self.step_at(field, constants, time, is_backward, steps)?;
        Ok(step.at(time))
    }

    /// The matrix that is carried along at an exact time, row by row; see [`Solution::at`].
    ///
    /// # Errors
    /// See [`Stopped`].
    pub fn carried(
        &mut self,
        field: &Field,
        constants: &Constants,
        time: &Rational,
        steps: &mut u64,
    ) -> Result<Vec<Ball>, Stopped> {
        let setting = Setting {
            field,
            constants,
            bits: self.bits,
            order: self.order,
        };
        let is_backward = *time < self.branches[0].places[0].time;
        self.branches[usize::from(is_backward)].carried(&setting, time, steps)
    }

    /// The states at all times from one to another, which have to be those of one step
    /// ([`Solution::end_of_step`]).
    ///
    /// # Errors
    /// See [`Stopped`].
    pub fn over(
        &mut self,
        field: &Field,
        constants: &Constants,
        [from, to]: [&Rational; 2],
        steps: &mut u64,
    ) -> Result<Vec<Ball>, Stopped> {
        let start = &self.branches[0].places[0].time;
        let is_backward = from < start || to < start;
        let later = if is_backward {
            from.min(to)
        } else {
            from.max(to)
        };
        let step = self.step_at(field, constants, later, is_backward, steps)?;
        Ok(step.over(from, to))
    }

    /// The end, in a direction, of the step that holds a time and what follows it.
    ///
    /// # Errors
    /// See [`Stopped`].
    pub fn end_of_step(
        &mut self,
        field: &Field,
        constants: &Constants,
        time: &Rational,
        is_backward: bool,
        steps: &mut u64,
    ) -> Result<Rational, Stopped> {
        let step = self.step_at(field, constants, time, is_backward, steps)?;
        let end = step.end();
        if end != *time {
            return Ok(end);
        }
        let branch = &mut self.branches[usize::from(is_backward)];
        let last = branch.places.last().map(|place| place.time == *time);
        if last == Some(true) {
            let setting = Setting {
                field,
                constants,
                bits: self.bits,
                order: self.order,
            };
            branch.extend(&setting, steps)?;
        }
        let k = branch.places.iter().position(|place| place.time == *time);
        let next = k.and_then(|k| branch.places.get(k + 1));
        Ok(next.map_or(end, |place| place.time.clone()))
    }

    fn step_at(
        &mut self,
        field: &Field,
        constants: &Constants,
        time: &Rational,
        is_backward: bool,
        steps: &mut u64,
    ) -> Result<&Step, Stopped> {
        let setting = Setting {
            field,
            constants,
            bits: self.bits,
            order: self.order,
        };
        self.branches[usize::from(is_backward)].step_at(&setting, time, steps)
    }
}

impl Branch {
    /// The step that holds a time.
    fn step_at(
        &mut self,
        setting: &Setting<'_>,
        time: &Rational,
        steps: &mut u64,
    ) -> Result<&Step, Stopped> {
        let is_before = |place: &Place| match self.backward {
            true => place.time > *time,
            false => place.time < *time,
        };
        let k = self.places.partition_point(is_before).saturating_sub(1);
        if k + 1 < self.places.len() {
            return self.again(setting, k, steps);
        }
        loop {
            let k = self.lengths.len();
            if k > 0 && self.is_reached(time) {
                return self.again(setting, k - 1, steps);
            }
            self.extend(setting, steps)?;
        }
    }

    /// The matrix that is carried along. Early in a step, beside whose end it may be small, it is
    /// that of a shorter step.
    fn carried(
        &mut self,
        setting: &Setting<'_>,
        time: &Rational,
        steps: &mut u64,
    ) -> Result<Vec<Ball>, Stopped> {
        let step = self.step_at(setting, time, steps)?;
        let way = Rational::from(time - step.start()).abs().to_f64();
        let found = step.carried(time);
        let Some((k, step)) = &self.current else {
            return Ok(found);
        };
        if way == 0.0 || 4.0 * way > step.h.abs() {
            return Ok(found);
        }
        // A step may be shorter than any that is made.
        Ok(match self.made(setting, *k, 1.0625 * way, steps) {
            Ok(shorter) if shorter.h.abs() >= way => shorter.carried(time),
            _ => found,
        })
    }

    fn is_reached(&self, time: &Rational) -> bool {
        let last = self.places.last().map(|place| &place.time);
        last.is_some_and(|last| match self.backward {
            true => last <= time,
            false => last >= time,
        })
    }

    /// A step that was made before; it is made once more if it is not at hand.
    fn again(
        &mut self,
        setting: &Setting<'_>,
        k: usize,
        steps: &mut u64,
    ) -> Result<&Step, Stopped> {
        let is_at_hand = self.current.as_ref().is_some_and(|c| c.0 == k);
        if !is_at_hand {
            let longest = self.longest(k);
            let step = self.made(setting, k, longest, steps)?;
            self.current = Some((k, step));
        }
        Ok(&self.current.as_ref().expect("a step").1)
    }

    /// The longest that a step may be.
    fn longest(&self, k: usize) -> f64 {
        match k {
            0 => self.first,
            k => 16.0 * self.lengths[k - 1].abs(),
        }
    }

    fn made(
        &self,
        setting: &Setting<'_>,
        k: usize,
        longest: f64,
        steps: &mut u64,
    ) -> Result<Step, Stopped> {
        let place = &self.places[k];
        let reached = || place.time.clone();
        if *steps == 0 {
            return Err(Stopped::Steps { reached: reached() });
        }
        *steps -= 1;
        setting
            .step(place, self.backward, longest)
            .map_err(|failure| match failure {
                Failure::Obstacle {
                    in_jacobian,
                    obstacle,
                } => Stopped::Obstacle {
                    reached: reached(),
                    in_jacobian,
                    obstacle,
                },
                Failure::Short { .. } => Stopped::Short { reached: reached() },
                Failure::Wide => Stopped::Wide { reached: reached() },
            })
    }

    /// Makes the next step.
    fn extend(&mut self, setting: &Setting<'_>, steps: &mut u64) -> Result<(), Stopped> {
        if let Some(stopped) = &self.stopped {
            return Err(stopped.clone());
        }
        let k = self.lengths.len();
        let made = self.made(setting, k, self.longest(k), steps);
        let step = match made {
            Ok(step) => step,
            Err(stopped) => {
                if !matches!(stopped, Stopped::Steps { .. }) {
                    self.stopped = Some(stopped.clone());
                }
                return Err(stopped);
            }
        };
        let next = step.next();
        let size = step.sizes().into_iter().fold(Mag::ZERO, Mag::max);
        let length = step.h.abs();
        if self.sizes.last().is_none_or(|last| length < last.0 / 2.0) {
            self.sizes.push((length, size));
        } else if self.sizes.last().is_some_and(|last| length > 2.0 * last.0) {
            self.sizes.retain(|s| s.0 >= length);
        }
        let since = Rational::from(&next.time - &self.places[0].time)
            .abs()
            .to_f64();
        if length < SHORTEST * since {
            let stopped = self.ended(&step, size, length);
            self.stopped = Some(stopped.clone());
            return Err(stopped);
        }
        self.lengths.push(step.h);
        self.places.push(next);
        self.current = Some((k, step));
        Ok(())
    }

    /// The steps have become too short.
    fn ended(&self, step: &Step, size: Mag, length: f64) -> Stopped {
        let reached = step.start().clone();
        let before = self.sizes.iter().rev().find(|s| s.0 > length * 1e6);
        match before {
            Some((_, before)) if size > before.mul(Mag::from_f64(1.4)) => {
                let near = reached.to_f64() + step.pole();
                Stopped::Unbounded { reached, near }
            }
            _ => Stopped::Short { reached },
        }
    }
}
