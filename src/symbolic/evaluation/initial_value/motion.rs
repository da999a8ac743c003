//! A motion in one direction at one working precision: smooth pieces, one after another.

use super::crossing::{Crossing, TOUCHES, cross, jumped, times};
use super::field::{AT_SWITCH, Guarded, Sides, Smooth, set, side};
use super::{InitialValueProblem, MotionError};
use crate::evaluation::ball::unary;
use crate::evaluation::taylor::{Side, Switch};
use crate::evaluation::{Balls, Evaluator};
use crate::graph::Id;
use mechaudit_reference::Ball;
use mechaudit_reference::elementary::NoValue;
use mechaudit_reference::initial_value::{Solution, Stopped};
use rug::Rational;

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

/// A smooth piece.
struct Piece {
    field: Smooth,
    solution: Solution,
    /// The time and the states before the switch that leads here, with those on the way.
    entry: Option<(Rational, Vec<Ball>)>,
    start: Rational,
    /// All guards hold from the start to this time.
    verified: Rational,
}

/// A motion in one direction.
pub(super) struct Motion {
    bits: u32,
    is_backward: bool,
    evaluator: Evaluator<Balls>,
    pieces: Vec<Piece>,
}

/// Parts of a step are halved so often before a guard is given up.
const DEPTH: u32 = 128;

impl Motion {
    /// Begins a motion from the states at the start.
    ///
    /// # Errors
    /// A rate without a value, a switch at the start that is not crossed.
    pub fn new(
        problem: &InitialValueProblem,
        mut evaluator: Evaluator<Balls>,
        start: Rational,
        starts: Vec<Ball>,
        (bits, is_backward): (u32, bool),
    ) -> Result<Motion, Halt> {
        let exact = Ball::rational(evaluator.interpretation.prec, &start);
        set(&mut evaluator, problem, &exact, &starts);
        let at_switch = problem
            .switches
            .iter()
            .map(|switch| switch.0)
            .find(|switch| side(&mut evaluator, *switch) == Err(AT_SWITCH));
        let fault = |(node, reason): (Id, NoValue)| Halt::Rate {
            node,
            reason,
            time: start.clone(),
        };
        let mut piece = None;
        // Derivatives by the inputs have no value where the start is at a switch for one value of
        // them only.
        if let Some(switch) = at_switch.filter(|_| problem.derivatives.is_none()) {
            piece = Motion::away(
                problem,
                &mut evaluator,
                (&start, &starts),
                switch,
                (bits, is_backward),
            );
        }
        let piece = match piece {
            Some(piece) => piece,
            None => Piece {
                field: Smooth::new(problem, &mut evaluator, &Sides::new()).map_err(fault)?,
                solution: Solution::new(start.clone(), &starts, bits),
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
        })
    }

    /// The first piece of a motion that starts at a switch and leaves it.
    fn away(
        problem: &InitialValueProblem,
        evaluator: &mut Evaluator<Balls>,
        (start, starts): (&Rational, &[Ball]),
        switch: Switch,
        (bits, is_backward): (u32, bool),
    ) -> Option<Piece> {
        let sides = about(evaluator, switch)?;
        let mut pieces = Vec::new();
        for side in sides {
            let known = Sides::from([(switch, side)]);
            pieces.push(Smooth::new(problem, evaluator, &known).ok()?);
        }
        let width = Rational::from(1) >> bits;
        for _ in 0..2 {
            let both = [&pieces[0], &pieces[1]];
            let way = (width.clone(), is_backward);
            if let Ok(crossing) = cross((start, starts), both, switch, way, bits) {
                let field = pieces.pop()?;
                return Some(Piece::after(field, crossing, bits));
            }
            pieces.swap(0, 1);
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
            let (before, states) = piece.entry.as_ref()?;
            Some((times(self.bits, before, &piece.start), states.clone()))
        })
    }

    /// Returns true if a time is another, or comes after it in the direction of the motion.
    fn is_past(&self, time: &Rational, other: &Rational) -> bool {
        match self.is_backward {
            true => time <= other,
            false => time >= other,
        }
    }

    /// The states at a time.
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
            self.extend(problem, steps)?;
        }
        let (mut k, mut states) = (self.pieces.len() - 1, None);
        loop {
            if self.is_past(time, &self.pieces[k].start) {
                break;
            }
            if let Some((before, hull)) = &self.pieces[k].entry
                && self.is_past(time, before)
            {
                states = Some(hull.clone());
                break;
            }
            if k == 0 {
                break;
            }
            k -= 1;
        }
        if let Some(states) = states {
            return Ok(states);
        }
        let piece = &mut self.pieces[k];
        let (field, constants) = (&piece.field.field, &piece.field.constants);
        let found = piece.solution.at(field, constants, time, steps);
        found.map_err(Halt::Stopped)
    }

    /// Proves the guards of the last piece over the next step, or enters the next piece.
    fn extend(&mut self, problem: &InitialValueProblem, steps: &mut u64) -> Result<(), Halt> {
        let (bits, is_backward) = (self.bits, self.is_backward);
        let piece = self.pieces.last_mut().expect("a motion has a piece");
        let (field, constants) = (&piece.field.field, &piece.field.constants);
        let end = piece
            .solution
            .end_of_step(field, constants, &piece.verified, is_backward, steps)
            .map_err(Halt::Stopped)?;
        let Some((guarded, before, width)) = piece.failure(&end, bits, steps)? else {
            piece.verified = end;
            return Ok(());
        };
        let halt = |reason| Halt::Switch {
            reached: before.clone(),
            reason,
        };
        let states = piece.at(&before, steps)?;
        set_again(
            &mut self.evaluator,
            problem,
            &Ball::rational(bits + 16, &before),
            &states,
        );
        let mut sides = piece.field.active();
        let side = other_side(&sides, &guarded).ok_or(halt(TOUCHES))?;
        sides.insert(guarded.switch, side);
        let next =
            Smooth::new(problem, &mut self.evaluator, &sides).map_err(|(node, reason)| {
                Halt::Rate {
                    node,
                    reason,
                    time: before.clone(),
                }
            })?;
        let from = (&before, states.as_slice());
        let pieces = [&piece.field, &next];
        let crossing = cross(from, pieces, guarded.switch, (width, is_backward), bits);
        let mut crossing = crossing.map_err(halt)?;
        if let Some(derivatives) = &problem.derivatives {
            let mut slopes = |span: &Ball, hull: &[Ball]| {
                set_again(&mut self.evaluator, problem, span, hull);
                let nodes = derivatives.switches.get(&guarded.switch)?;
                let value = |id: &Id| self.evaluator.value(*id).ok()?.real().cloned();
                nodes.iter().map(value).collect()
            };
            crossing = jumped(
                crossing,
                pieces,
                guarded.switch,
                (derivatives.states, &mut slopes),
                bits,
            )
            .map_err(halt)?;
        }
        piece.verified = before;
        self.pieces.push(Piece::after(next, crossing, bits));
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

/// Forgets what depends on the last states.
fn set_again(
    evaluator: &mut Evaluator<Balls>,
    problem: &InitialValueProblem,
    time: &Ball,
    states: &[Ball],
) {
    use crate::graph::Node;
    let graph = evaluator.graph().clone();
    let inputs: Vec<_> = (0..problem.inputs)
        .map(|k| {
            let id = graph.find(Node::Input(k as u32))?;
            evaluator.value(id).ok().cloned()
        })
        .collect();
    evaluator.reset(false);
    for (k, value) in inputs.into_iter().enumerate() {
        if let Some(value) = value {
            evaluator.set_input(k, value);
        }
    }
    set(evaluator, problem, time, states);
}

/// The side that a switch is on once a guard has failed.
fn other_side(sides: &Sides, guarded: &Guarded) -> Option<Side> {
    Some(match sides.get(&guarded.switch)? {
        Side::Positive => Side::Negative,
        Side::Negative => Side::Positive,
        // A guard that has to be positive is at the lower end.
        Side::Integer(n) => {
            let by = if guarded.positive { -1 } else { 1 };
            Side::Integer(Rational::from(n + by))
        }
    })
}

impl Piece {
    fn after(field: Smooth, crossing: Crossing, bits: u32) -> Piece {
        Piece {
            field,
            solution: Solution::new(crossing.after.clone(), &crossing.states, bits),
            entry: Some((crossing.before, crossing.hull)),
            verified: crossing.after.clone(),
            start: crossing.after,
        }
    }

    fn at(&mut self, time: &Rational, steps: &mut u64) -> Result<Vec<Ball>, Halt> {
        let (field, constants) = (&self.field.field, &self.field.constants);
        let found = self.solution.at(field, constants, time, steps);
        found.map_err(Halt::Stopped)
    }

    /// The guards over a part of a step; none where they have no bounds.
    fn guards_over(
        &mut self,
        [from, to]: [&Rational; 2],
        bits: u32,
        steps: &mut u64,
    ) -> Result<Option<Vec<Guarded>>, Halt> {
        let (field, constants) = (&self.field.field, &self.field.constants);
        let states = self.solution.over(field, constants, [from, to], steps);
        let states = states.map_err(Halt::Stopped)?;
        let time = times(bits, from, to);
        Ok(self.field.guards(&time, &states).ok())
    }

    /// Proves the guards from the last time to the end of a step. If one fails, it is returned with
    /// a time at which it still holds and a length after which it fails.
    fn failure(
        &mut self,
        end: &Rational,
        bits: u32,
        steps: &mut u64,
    ) -> Result<Option<(Guarded, Rational, Rational)>, Halt> {
        let mut open = vec![(self.verified.clone(), end.clone(), 0)];
        while let Some((from, to, depth)) = open.pop() {
            let over = self.guards_over([&from, &to], bits, steps)?;
            if let Some(over) = over {
                let lost: Vec<usize> = (0..over.len()).filter(|k| !over[*k].holds()).collect();
                if lost.is_empty() {
                    continue;
                }
                // Where its rate has a sign, a guard that holds at both ends holds between them.
                if lost.iter().all(|k| over[*k].rises().is_some()) {
                    let at = self
                        .guards_over([&to, &to], bits, steps)?
                        .unwrap_or_default();
                    let open: Vec<&usize> = lost.iter().filter(|k| !at[**k].holds()).collect();
                    match open.as_slice() {
                        [] => continue,
                        [k] if at[**k].fails() => {
                            return self.bracket(**k, from, to, bits, steps).map(Some);
                        }
                        _ => {}
                    }
                }
            }
            if depth == DEPTH {
                let (reached, reason) = (from, TOUCHES);
                return Err(Halt::Switch { reached, reason });
            }
            // Switching times at simple fractions of a step are not met.
            let part = Rational::from(&to - &from) * Rational::from((29, 64));
            let middle = &from + part;
            open.push((middle.clone(), to, depth + 1));
            open.push((from, middle, depth + 1));
        }
        Ok(None)
    }

    /// A guard, a time at which it still holds, and a length after which it does not.
    fn bracket(
        &mut self,
        k: usize,
        mut from: Rational,
        mut to: Rational,
        bits: u32,
        steps: &mut u64,
    ) -> Result<(Guarded, Rational, Rational), Halt> {
        let mut is_narrow = false;
        for _ in 0..4 * bits {
            let middle = Rational::from(&from + &to) / 2u32;
            let at = self.guards_over([&middle, &middle], bits, steps)?;
            let Some(at) = at.filter(|at| at.len() > k) else {
                break;
            };
            match () {
                () if at[k].holds() => from = middle,
                () if is_narrow => break,
                () => {
                    // Beyond a time that balls do not decide the last one that holds is sought.
                    is_narrow = !at[k].fails();
                    to = middle;
                }
            }
        }
        let guards = self.guards_over([&from, &from], bits, steps)?;
        let guarded =
            guards.and_then(|mut guards| (k < guards.len()).then(|| guards.swap_remove(k)));
        let width = Rational::from(&to - &from).abs();
        let halt = || Halt::Switch {
            reached: from.clone(),
            reason: TOUCHES,
        };
        let guarded = guarded.ok_or_else(halt)?;
        Ok((guarded, from, width))
    }
}
