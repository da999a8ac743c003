//! A motion in one direction at one working precision: smooth pieces, one after another.

use super::crossing::{cross, jumped, times, whole};
use super::field::{AT_SWITCH, Sides, Smooth, set, side};
use super::piece::{MOST, Piece, at_rate, carrying, fields_on, gradients};
use super::quantities::Quantities;
use super::sliding::Sliding;
use super::{InitialValueProblem, MotionError};
use crate::evaluation::real::unary;
use crate::evaluation::taylor::{Side, Switch};
use crate::evaluation::{Balls, Evaluator};
use crate::graph::Id;
use mechaudit_reference::Ball;
use mechaudit_reference::elementary::NoValue;
use mechaudit_reference::initial_value::{Solution, Stopped};
use rug::Rational;
use std::sync::Arc;

/// Reason why a motion has no value at a time.
pub(super) enum Halt {
    /// The solution of a piece is not continued.
    Stopped(Stopped),
    /// The motion is not proved to cross a switch.
    Switch {
        reached: Rational,
        reason: &'static str,
    },
    /// A node of the rates has no value.
    Rate {
        node: Id,
        reason: NoValue,
        time: Rational,
    },
    /// The start has no value.
    Error(MotionError),
}

impl Halt {
    /// Returns true if a higher precision may help.
    pub fn is_precision(&self) -> bool {
        matches!(self, Halt::Stopped(Stopped::Wide { .. }))
    }
}

/// A motion in one direction.
pub(super) struct Motion {
    bits: u32,
    is_backward: bool,
    evaluator: Evaluator<Balls>,
    pieces: Vec<Piece>,
    /// Motions along switches that are known.
    sliding: Vec<Arc<Sliding>>,
}

impl Motion {
    /// Begins a motion from the states at the start, and from the derivatives that the problem
    /// carries along.
    ///
    /// # Errors
    /// A rate without a value, a switch at the start that is not crossed.
    pub fn new(
        problem: &InitialValueProblem,
        mut evaluator: Evaluator<Balls>,
        start: Rational,
        (starts, variation): (Vec<Ball>, Vec<Ball>),
        (bits, is_backward): (u32, bool),
    ) -> Result<Motion, Halt> {
        let exact = Ball::rational(evaluator.interpretation.prec, &start);
        set(&mut evaluator, problem, &exact, &starts);
        let switches = problem.switches.iter().map(|switch| switch.0);
        let at: Vec<Switch> = switches
            .filter(|switch| side(&mut evaluator, *switch) == Err(AT_SWITCH))
            .collect();
        let place = (&start, starts.as_slice(), variation.as_slice());
        let way = (bits, is_backward);
        let mut sliding = Vec::new();
        let piece = match Motion::away(problem, &mut evaluator, place, &at, way, &mut sliding) {
            Some(piece) => piece,
            None => Piece {
                slides: None,
                leaves: None,
                quantities: None,
                field: Smooth::new(problem, &mut evaluator, &Sides::new())
                    .map_err(|fault| at_rate(fault, &start))?,
                solution: carrying(Solution::new(start.clone(), &starts, bits), &variation),
                entry: None,
                verified: start.clone(),
                start,
            },
        };
        Ok(Motion {
            bits,
            is_backward,
            evaluator,
            pieces: vec![piece],
            sliding,
        })
    }

    /// The first piece of a motion that starts at some switches, and leaves them or slides along one.
    fn away(
        problem: &InitialValueProblem,
        evaluator: &mut Evaluator<Balls>,
        (start, starts, variation): (&Rational, &[Ball], &[Ball]),
        at: &[Switch],
        (bits, is_backward): (u32, bool),
        known: &mut Vec<Arc<Sliding>>,
    ) -> Option<Piece> {
        if at.is_empty() || at.len() > MOST {
            return None;
        }
        let sides = at.iter().map(|switch| about(evaluator, *switch));
        let sides: Vec<[Side; 2]> = sides.collect::<Option<_>>()?;
        let mut fields = Vec::new();
        for choice in 0..1 << at.len() {
            let side = |(k, sides): (usize, &[Side; 2])| sides[choice >> k & 1].clone();
            let chosen = sides.iter().enumerate().map(side);
            let known: Sides = at.iter().copied().zip(chosen).collect();
            fields.push(Smooth::new(problem, evaluator, &known).ok()?);
        }
        let between: Vec<(Switch, [Side; 2])> = at.iter().copied().zip(sides).collect();
        let on = fields_on(problem, evaluator, &Sides::new(), &between).ok()?;
        let width = Rational::from(1) >> bits;
        for _ in 0..fields.len() {
            // The last piece is another one each time.
            fields.rotate_left(1);
            let pieces: Vec<&Smooth> = on.iter().chain(&fields).collect();
            let way = (width.clone(), is_backward);
            let Ok(crossing) = cross((start, starts), &pieces, at, way, bits) else {
                continue;
            };
            if crossing.slides {
                let from = (pieces.as_slice(), variation.to_vec());
                return Piece::along(
                    (problem, evaluator),
                    (at[0], bits),
                    from,
                    crossing,
                    known,
                    true,
                );
            }
            let mut s = variation.to_vec();
            if problem.variation.is_some() {
                let gradients = gradients(problem, evaluator, at, &crossing);
                let switches = (at, gradients.as_slice());
                s = jumped(s, &crossing, &pieces[on.len()..], switches, true);
            }
            return Some(Piece::after(fields.pop()?, crossing, &s, bits));
        }
        None
    }

    /// The working precision in bits.
    pub fn bits(&self) -> u32 {
        self.bits
    }

    /// The node of an operation of the last piece.
    pub fn origin(&self, in_jacobian: bool, slot: usize) -> Id {
        let piece = self.pieces.last().expect("a motion has a piece");
        piece.field.origin(in_jacobian, slot)
    }

    /// Enclosures of the switching times and of the states then.
    pub fn switches(&self) -> impl Iterator<Item = (Ball, Vec<Ball>)> {
        self.pieces.iter().filter_map(|piece| {
            let entry = piece.entry.as_ref()?;
            let time = times(self.bits, &entry.before, &piece.start);
            Some((time, entry.hull.clone()))
        })
    }

    /// Returns true if a time is another, or comes after it in the direction of the motion.
    fn is_past(&self, time: &Rational, other: &Rational) -> bool {
        match self.is_backward {
            true => time <= other,
            false => time >= other,
        }
    }

    /// The states at a time, and the derivatives that the problem carries along.
    pub fn at(
        &mut self,
        problem: &InitialValueProblem,
        time: &Rational,
        steps: &mut u64,
    ) -> Result<Vec<Ball>, Halt> {
        loop {
            let last = self.pieces.len() - 1;
            let verified = &self.pieces[last].verified;
            let is_guarded = self.pieces[last].field.is_guarded();
            if !is_guarded || self.is_past(verified, time) {
                break;
            }
            if let Err(halt) = self.extend(problem, time, steps) {
                match self.is_past(&self.pieces[last].verified, time) {
                    true => break,
                    false => return Err(halt),
                }
            }
        }
        let (k, is_across) = self.place(time);
        let piece = &mut self.pieces[k];
        if let Some(entry) = piece.entry.as_ref().filter(|_| is_across) {
            let unknown = problem.variation.as_ref().map_or(0, |s| s.start.len());
            let unknown = (0..unknown).map(|_| whole());
            return Ok(entry.hull.iter().cloned().chain(unknown).collect());
        }
        let mut states = piece.at(time, steps)?;
        states.extend(piece.carried(time, steps)?);
        Ok(states)
    }

    /// The piece of a time; true for a time on the way across the switch that leads to the piece.
    fn place(&self, time: &Rational) -> (usize, bool) {
        for (k, piece) in self.pieces.iter().enumerate().rev() {
            if self.is_past(time, &piece.start) {
                return (k, false);
            }
            let entry = piece.entry.as_ref();
            if entry.is_some_and(|entry| self.is_past(time, &entry.before)) {
                return (k, true);
            }
        }
        (0, false)
    }

    /// The values of the quantities at a time and the states then, as far as the motion is known:
    /// at a start at switches those on the sides to which it goes, on the way from one piece to
    /// another those of both.
    pub fn quantities(
        &mut self,
        problem: &InitialValueProblem,
        time: &Rational,
        (when, states): (&Ball, &[Ball]),
    ) -> Vec<Option<Ball>> {
        let (k, is_across) = self.place(time);
        let piece = &self.pieces[k];
        let mut first = k;
        let mut at = (when, states.to_vec());
        if let Some(entry) = piece.entry.as_ref().filter(|_| is_across) {
            match k {
                0 if entry.before == *time && piece.departs(when, states) => {}
                1.. if entry.has_two_sides => (first, at.1) = (k - 1, entry.hull.clone()),
                _ => {
                    let quantities = Quantities::on(problem, &Sides::new());
                    // A start at a switch is not on the side to which the motion goes.
                    let span = times(self.bits, &entry.before, &piece.start);
                    let when = if k == 0 { &span } else { when };
                    let at = (when, entry.hull.as_slice());
                    return quantities.values(problem, &mut self.evaluator, at);
                }
            }
        }
        let mut found: Option<Vec<Option<Ball>>> = None;
        for piece in &mut self.pieces[first..=k] {
            let quantities = piece.quantities(problem);
            let values = quantities.values(problem, &mut self.evaluator, (at.0, &at.1));
            let union = |(a, b): (Option<Ball>, Option<Ball>)| Some(a?.union(&b?));
            found = Some(match found {
                None => values,
                Some(found) => found.into_iter().zip(values).map(union).collect(),
            });
        }
        found.unwrap_or_default()
    }

    /// Proves the guards of the last piece over the next step, or enters the next piece. Those of a
    /// motion that slides, whose steps may be far longer than its guards have bounds, are proved at
    /// most as far beyond a time as it is from where they are proved.
    fn extend(
        &mut self,
        problem: &InitialValueProblem,
        time: &Rational,
        steps: &mut u64,
    ) -> Result<(), Halt> {
        let (bits, is_backward) = (self.bits, self.is_backward);
        let piece = self.pieces.last_mut().expect("a motion has a piece");
        let (field, constants) = (&piece.field.field, &piece.field.constants);
        let mut end = piece
            .solution
            .end_of_step(field, constants, &piece.verified, is_backward, steps)
            .map_err(Halt::Stopped)?;
        let length = Rational::from(&end - &piece.verified).abs();
        let most = Rational::from(time * 2u32) - &piece.verified;
        if piece.slides.is_some() && end > most {
            end = most;
        }
        if let Some((sliding, exit)) = piece.leaves.clone() {
            let mut evaluator = sliding.evaluator(&mut self.evaluator);
            let exit = &sliding.exits[exit];
            piece.depart(&sliding, exit, end, &mut evaluator, steps)?;
            piece.leaves = None;
            return Ok(());
        }
        let Some((guarded, before, width)) = piece.failure(&end, bits, steps)? else {
            piece.verified = end;
            return Ok(());
        };
        piece.verified.clone_from(&before);
        let next = match &piece.slides {
            None => {
                let base = (problem, &mut self.evaluator);
                let way = (bits, is_backward);
                piece.next(
                    base,
                    (guarded, &before, width),
                    way,
                    &mut self.sliding,
                    steps,
                )
            }
            Some(sliding) => {
                let sliding = sliding.clone();
                match sliding.exit(guarded.switch) {
                    Some(exit) => {
                        let base = (problem, &mut self.evaluator);
                        piece.left((sliding, exit), base, (&before, width), steps)
                    }
                    None => {
                        let mut own = sliding.evaluator(&mut self.evaluator);
                        let base = (&sliding.problem, &mut own);
                        let way = (bits, is_backward);
                        piece.next(base, (guarded, &before, width), way, &mut Vec::new(), steps)
                    }
                }
            }
        };
        let mut next = next?;
        if next.slides.is_some() {
            next.solution.shorten(16.0 * length.to_f64());
        }
        self.pieces.push(next);
        Ok(())
    }
}

/// The sides below and above a switch that a motion is at.
fn about(evaluator: &mut Evaluator<Balls>, switch: Switch) -> Option<[Side; 2]> {
    let Switch::Step(f, a) = switch else {
        return Some([Side::Negative, Side::Positive]);
    };
    let a = evaluator.value(a).ok()?.real()?.clone();
    let bits = a.prec();
    let near = |by: f64| {
        let value = unary(f, &(&a + Ball::exact(bits, by)), bits).ok()?;
        let integer = value.real().filter(|n| n.rad().is_zero())?;
        integer.mid().to_rational().map(Side::Integer)
    };
    // The guards of both pieces check what is near enough.
    let small = 1.0 / 1024.0;
    Some([near(-small)?, near(small)?])
}
