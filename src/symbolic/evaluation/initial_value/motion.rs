//! A motion in one direction at one working precision: smooth pieces, one after another.

use super::crossing::{Crossing, TOUCHES, Uncrossed, cross, jumped, times, whole};
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

/// The most switches that are crossed at once: there is a piece for each choice of their sides.
const MOST: usize = 4;

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
        let fault = |(node, reason): (Id, NoValue)| Halt::Rate {
            node,
            reason,
            time: start.clone(),
        };
        let place = (&start, starts.as_slice(), variation.as_slice());
        let way = (bits, is_backward);
        let piece = match Motion::away(problem, &mut evaluator, place, &at, way) {
            Some(piece) => piece,
            None => Piece {
                field: Smooth::new(problem, &mut evaluator, &Sides::new()).map_err(fault)?,
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
        })
    }

    /// The first piece of a motion that starts at some switches and leaves them.
    fn away(
        problem: &InitialValueProblem,
        evaluator: &mut Evaluator<Balls>,
        (start, starts, variation): (&Rational, &[Ball], &[Ball]),
        at: &[Switch],
        (bits, is_backward): (u32, bool),
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
            if let Err(halt) = self.extend(problem, steps) {
                match self.is_past(&self.pieces[last].verified, time) {
                    true => break,
                    false => return Err(halt),
                }
            }
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
        if let Some(mut states) = states {
            let unknown = problem.variation.as_ref().map_or(0, |s| s.start.len());
            states.extend((0..unknown).map(|_| whole()));
            return Ok(states);
        }
        let piece = &mut self.pieces[k];
        let mut states = piece.at(time, steps)?;
        states.extend(piece.carried(time, steps)?);
        Ok(states)
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
        piece.verified.clone_from(&before);
        let sides = piece.field.active();
        let other = |guarded: &Guarded| {
            let side = other_side(&sides, guarded).ok_or(halt(TOUCHES))?;
            Ok((guarded.switch, side))
        };
        let fault = |(node, reason): (Id, NoValue)| Halt::Rate {
            node,
            reason,
            time: before.clone(),
        };
        let mut others = vec![other(&guarded)?];
        let mut fields: Vec<Smooth> = Vec::new();
        let (at, crossing) = loop {
            // All choices of sides that have the new one past its switch.
            for choice in 0..1 << (others.len() - 1) {
                let is_past = |k: &usize| k + 1 == others.len() || choice >> k & 1 == 1;
                let chosen = (0..others.len()).filter(is_past).map(|k| others[k].clone());
                let mut sides = sides.clone();
                sides.extend(chosen);
                let field = Smooth::new(problem, &mut self.evaluator, &sides);
                fields.push(field.map_err(fault)?);
            }
            let between = others.iter().filter_map(|(switch, past)| {
                let before = sides.get(switch)?.clone();
                Some((*switch, [before, past.clone()]))
            });
            let between: Vec<(Switch, [Side; 2])> = between.collect();
            let on = fields_on(problem, &mut self.evaluator, &sides, &between).map_err(fault)?;
            let pieces: Vec<&Smooth> = [&piece.field]
                .into_iter()
                .chain(&on)
                .chain(&fields)
                .collect();
            let at: Vec<Switch> = others.iter().map(|other| other.0).collect();
            let from = (&before, states.as_slice());
            match cross(from, &pieces, &at, (width.clone(), is_backward), bits) {
                Ok(crossing) => break (at, crossing),
                Err(Uncrossed::Meets(_)) if at.len() == MOST => {
                    return Err(halt("the motion meets too many switches at once"));
                }
                Err(Uncrossed::Meets(met)) => others.push(other(&met)?),
                Err(Uncrossed::Open(reason)) => return Err(halt(reason)),
            }
        };
        let mut s = piece.carried(&before, steps)?;
        if problem.variation.is_some() {
            let pieces: Vec<&Smooth> = [&piece.field].into_iter().chain(&fields).collect();
            let gradients = gradients(problem, &mut self.evaluator, &at, &crossing);
            s = jumped(s, &crossing, &pieces, (&at, &gradients), false);
        }
        let next = fields.pop().expect("a piece past the switches");
        self.pieces.push(Piece::after(next, crossing, &s, bits));
        Ok(())
    }
}

/// The gradients of the values that change their signs at switches, over the way across them.
fn gradients(
    problem: &InitialValueProblem,
    evaluator: &mut Evaluator<Balls>,
    switches: &[Switch],
    crossing: &Crossing,
) -> Vec<Vec<Ball>> {
    let span = times(
        evaluator.interpretation.prec,
        &crossing.before,
        &crossing.after,
    );
    set_again(evaluator, problem, &span, &crossing.hull);
    let mut value = |id: &Id| {
        let value = evaluator
            .value(*id)
            .ok()
            .and_then(|value| value.real().cloned());
        value.unwrap_or_else(whole)
    };
    let gradient = |switch: &Switch| {
        let nodes = problem.variation.as_ref()?.gradients.get(switch)?;
        Some(nodes.iter().map(&mut value).collect())
    };
    let found = switches.iter().map(gradient);
    found
        .map(|g| g.unwrap_or_else(|| vec![whole(); crossing.states.len()]))
        .collect()
}

/// A solution that carries derivatives along, if there are any.
fn carrying(solution: Solution, variation: &[Ball]) -> Solution {
    match variation {
        [] => solution,
        _ => solution.carrying(variation),
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

/// The fields of a motion that stays at some of the switches between two sides each, where those are
/// others than the fields on both sides.
fn fields_on(
    problem: &InitialValueProblem,
    evaluator: &mut Evaluator<Balls>,
    known: &Sides,
    between: &[(Switch, [Side; 2])],
) -> Result<Vec<Smooth>, (Id, NoValue)> {
    let mut choices = vec![(known.clone(), false)];
    for (switch, sides) in between {
        let on = switch.is_pointed(&problem.graph).then_some(Side::Zero);
        let mut more = Vec::new();
        for (choice, stays) in choices {
            for side in sides.iter().chain(&on) {
                let mut choice = choice.clone();
                choice.insert(*switch, side.clone());
                more.push((choice, stays || *side == Side::Zero));
            }
        }
        choices = more;
    }
    let staying = choices.into_iter().filter(|choice| choice.1);
    let fields = staying.map(|choice| Smooth::new(problem, evaluator, &choice.0));
    fields.collect()
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
        Side::Zero => return None,
        // A guard that has to be positive is at the lower end.
        Side::Integer(n) => {
            let by = if guarded.positive { -1 } else { 1 };
            Side::Integer(Rational::from(n + by))
        }
    })
}

impl Piece {
    fn after(field: Smooth, crossing: Crossing, variation: &[Ball], bits: u32) -> Piece {
        let solution = Solution::new(crossing.after.clone(), &crossing.states, bits);
        Piece {
            field,
            solution: carrying(solution, variation),
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

    /// The derivatives that are carried along.
    fn carried(&mut self, time: &Rational, steps: &mut u64) -> Result<Vec<Ball>, Halt> {
        let (field, constants) = (&self.field.field, &self.field.constants);
        let found = self.solution.carried(field, constants, time, steps);
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
                    match self.guards_over([&to, &to], bits, steps)? {
                        Some(at) if lost.iter().all(|k| at[*k].holds()) => continue,
                        Some(at) if lost.iter().any(|k| at[*k].fails()) => {
                            return self.bracket(from, to, bits, steps).map(Some);
                        }
                        _ => {}
                    }
                }
            }
            if depth == DEPTH {
                self.verified.clone_from(&from);
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

    /// The first guard that fails, a time at which all still hold, and a length after which that one
    /// does not.
    fn bracket(
        &mut self,
        mut from: Rational,
        mut to: Rational,
        bits: u32,
        steps: &mut u64,
    ) -> Result<(Guarded, Rational, Rational), Halt> {
        let mut is_narrow = false;
        for _ in 0..4 * bits {
            let middle = Rational::from(&from + &to) / 2u32;
            let Some(at) = self.guards_over([&middle, &middle], bits, steps)? else {
                break;
            };
            match () {
                () if at.iter().all(Guarded::holds) => from = middle,
                () if is_narrow => break,
                () => {
                    // Beyond a time that balls do not decide the last one at which all hold is
                    // sought.
                    is_narrow = !at.iter().any(Guarded::fails);
                    to = middle;
                }
            }
        }
        let at = self
            .guards_over([&to, &to], bits, steps)?
            .unwrap_or_default();
        let guarded = at.into_iter().find(|guard| !guard.holds());
        let width = Rational::from(&to - &from).abs();
        let halt = || Halt::Switch {
            reached: from.clone(),
            reason: TOUCHES,
        };
        let guarded = guarded.ok_or_else(halt)?;
        Ok((guarded, from, width))
    }
}
