//! A smooth piece of a motion, the proof of its guards, and the ways to the next piece.

use super::crossing::{Crossing, TOUCHES, Uncrossed, cross, jumped, times, whole};
use super::field::{Guarded, Sides, Smooth, set, set_again};
use super::motion::Halt;
use super::problem::InitialValueProblem;
use super::quantities::Quantities;
use super::sliding::{Exit, Sliding, values_at};
use crate::evaluation::taylor::{Side, Switch};
use crate::evaluation::{Balls, Evaluator};
use crate::graph::Id;
use mechaudit_reference::Ball;
use mechaudit_reference::elementary::NoValue;
use mechaudit_reference::initial_value::Solution;
use rug::Rational;
use std::sync::Arc;

/// A smooth piece.
pub(super) struct Piece {
    pub field: Smooth,
    pub solution: Solution,
    /// The way across the switch that leads here.
    pub entry: Option<Entry>,
    pub start: Rational,
    /// All guards hold from the start to this time.
    pub verified: Rational,
    /// The switch that the motion slides along.
    pub slides: Option<Arc<Sliding>>,
    /// A switch that the motion leaves at the start of the piece, and the number of the exit.
    pub leaves: Option<(Arc<Sliding>, usize)>,
    /// The quantities on the sides of the piece, once they are asked for.
    pub quantities: Option<Quantities>,
}

/// The way across a switch to a piece.
pub(super) struct Entry {
    /// The time before the switch.
    pub before: Rational,
    /// The states on the way.
    pub hull: Vec<Ball>,
    /// True if the rates on the way are those of the two pieces.
    pub has_two_sides: bool,
}

/// Parts of a step are halved so often before a guard is given up.
const DEPTH: u32 = 128;

/// The most switches that are crossed at once: there is a piece for each choice of their sides.
pub(super) const MOST: usize = 4;

impl Piece {
    pub fn after(field: Smooth, crossing: Crossing, variation: &[Ball], bits: u32) -> Piece {
        let solution = Solution::new(crossing.after.clone(), &crossing.states, bits);
        Piece {
            field,
            solution: carrying(solution, variation),
            entry: Some(Entry {
                before: crossing.before,
                hull: crossing.hull,
                has_two_sides: crossing.has_two_sides,
            }),
            slides: None,
            leaves: None,
            quantities: None,
            verified: crossing.after.clone(),
            start: crossing.after,
        }
    }

    /// The piece past the switch of a guard that fails after a time, and past others that are met with
    /// it.
    pub fn next(
        &mut self,
        (problem, evaluator): (&InitialValueProblem, &mut Evaluator<Balls>),
        (guarded, before, width): (Guarded, &Rational, Rational),
        (bits, is_backward): (u32, bool),
        known: &mut Vec<Arc<Sliding>>,
        steps: &mut u64,
    ) -> Result<Piece, Halt> {
        let halt = |reason| Halt::Switch {
            reached: before.clone(),
            reason,
        };
        let states = self.at(before, steps)?;
        let exact = Ball::rational(evaluator.interpretation.prec, before);
        set_again(evaluator, problem, &exact, &states);
        let sides = self.field.active();
        let other = |guarded: &Guarded| {
            let side = other_side(&sides, guarded).ok_or(halt(TOUCHES))?;
            Ok((guarded.switch, side))
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
                let field = Smooth::new(problem, evaluator, &sides);
                fields.push(field.map_err(|fault| at_rate(fault, before))?);
            }
            let between = others.iter().filter_map(|(switch, past)| {
                let before = sides.get(switch)?.clone();
                Some((*switch, [before, past.clone()]))
            });
            let between: Vec<(Switch, [Side; 2])> = between.collect();
            let on = fields_on(problem, evaluator, &sides, &between);
            let on = on.map_err(|fault| at_rate(fault, before))?;
            let pieces: Vec<&Smooth> = [&self.field]
                .into_iter()
                .chain(&on)
                .chain(&fields)
                .collect();
            let at: Vec<Switch> = others.iter().map(|other| other.0).collect();
            let from = (before, states.as_slice());
            match cross(from, &pieces, &at, (width.clone(), is_backward), bits) {
                Ok(crossing) => break (at, crossing),
                Err(Uncrossed::Meets(met)) if self.is_margin(met.switch) => {
                    return Err(halt("the motion meets another switch where it leaves one"));
                }
                Err(Uncrossed::Meets(_)) if at.len() == MOST => {
                    return Err(halt("the motion meets too many switches at once"));
                }
                Err(Uncrossed::Meets(met)) => others.push(other(&met)?),
                Err(Uncrossed::Open(reason)) => return Err(halt(reason)),
            }
        };
        let mut s = self.carried(before, steps)?;
        if crossing.slides {
            let pieces = [&self.field];
            let from = (pieces.as_slice(), s);
            let piece = match self.slides {
                None => Piece::along(
                    (problem, evaluator),
                    (at[0], bits),
                    from,
                    crossing,
                    known,
                    false,
                ),
                Some(_) => None,
            };
            let reason =
                "the motion may slide along two switches at once, or with rates of its own";
            return piece.ok_or_else(|| halt(reason));
        }
        if problem.variation.is_some() {
            let pieces: Vec<&Smooth> = [&self.field].into_iter().chain(&fields).collect();
            let gradients = gradients(problem, evaluator, &at, &crossing);
            s = jumped(s, &crossing, &pieces, (&at, &gradients), false);
        }
        let field = fields.pop().expect("a piece past the switches");
        let slides = self.slides.clone();
        Ok(Piece {
            slides,
            ..Piece::after(field, crossing, &s, bits)
        })
    }

    /// Returns true if a motion certainly goes to the sides of the piece from a time and states,
    /// which may be at switches.
    pub fn departs(&self, time: &Ball, states: &[Ball]) -> bool {
        let goes = |guard: &Guarded| {
            guard.holds() || guard.value.is_zero() && guard.rises() == Some(guard.positive)
        };
        let guards = self.field.guards(time, states);
        guards.is_ok_and(|guards| guards.iter().all(goes))
    }

    /// The quantities of the problem on the sides of the piece.
    pub fn quantities(&mut self, problem: &InitialValueProblem) -> &Quantities {
        self.quantities.get_or_insert_with(|| {
            let problem = self.slides.as_ref().map_or(problem, |along| &along.problem);
            Quantities::on(problem, &self.field.active())
        })
    }

    /// Returns true if a switch is an exit from the one that the motion slides along.
    fn is_margin(&self, switch: Switch) -> bool {
        let sliding = self.slides.as_ref();
        sliding.is_some_and(|sliding| sliding.exit(switch).is_some())
    }

    /// The piece along a switch, of which the rates on both sides lead to it.
    pub fn along(
        (problem, evaluator): (&InitialValueProblem, &mut Evaluator<Balls>),
        (switch, bits): (Switch, u32),
        (pieces, s): (&[&Smooth], Vec<Ball>),
        mut crossing: Crossing,
        known: &mut Vec<Arc<Sliding>>,
        is_start: bool,
    ) -> Option<Piece> {
        let sliding = match known.iter().find(|sliding| sliding.switch == switch) {
            Some(sliding) => sliding.clone(),
            None => {
                let sliding = Arc::new(Sliding::new(problem, switch).ok()?);
                known.push(sliding.clone());
                sliding
            }
        };
        if sliding.is_ambiguous {
            return None;
        }
        if let Some(rest) = sliding.rest {
            if is_start && crossing.starts[rest].is_zero() {
                crossing.after.clone_from(&crossing.before);
                crossing.states.clone_from(&crossing.starts);
                crossing.hull.clone_from(&crossing.starts);
            }
            crossing.states[rest] = Ball::integer(bits, 0);
        }
        let mut sides = pieces[0].active();
        sides.remove(&switch);
        sides.extend(sliding.margins());
        let mut own = sliding.evaluator(evaluator);
        let exact = Ball::rational(own.interpretation.prec, &crossing.after);
        set(&mut own, &sliding.problem, &exact, &crossing.states);
        let field = Smooth::new(&sliding.problem, &mut own, &sides).ok()?;
        let mut variation = s;
        if problem.variation.is_some() {
            let gradients = gradients(problem, evaluator, &[switch], &crossing);
            let pieces: Vec<&Smooth> = pieces.iter().copied().chain([&field]).collect();
            variation = jumped(
                variation,
                &crossing,
                &pieces,
                (&[switch], &gradients),
                is_start,
            );
        }
        Some(Piece {
            slides: Some(sliding),
            ..Piece::after(field, crossing, &variation, bits)
        })
    }

    /// The piece beyond an exit from the switch that this one slides along.
    pub fn left(
        &mut self,
        (sliding, exit): (Arc<Sliding>, usize),
        (problem, evaluator): (&InitialValueProblem, &mut Evaluator<Balls>),
        (before, width): (&Rational, Rational),
        steps: &mut u64,
    ) -> Result<Piece, Halt> {
        let states = self.at(before, steps)?;
        let exact = Ball::rational(evaluator.interpretation.prec, before);
        set_again(evaluator, problem, &exact, &states);
        let out = &sliding.exits[exit];
        let sides = sliding.sides_beyond(out, self.field.active());
        let beyond = Smooth::new(problem, evaluator, &sides);
        let beyond = beyond.map_err(|fault| at_rate(fault, before))?;
        let mut own = sliding.evaluator(evaluator);
        let fields = [&self.field, &beyond];
        let crossing = sliding.leave(out, (before, &states), fields, width, &mut own);
        let crossing = match crossing {
            Ok(crossing) => crossing,
            Err(reason) => {
                let reached = before.clone();
                let reason = match reason {
                    Uncrossed::Open(reason) => reason,
                    Uncrossed::Meets(_) => TOUCHES,
                };
                return Err(Halt::Switch { reached, reason });
            }
        };
        let mut s = self.carried(before, steps)?;
        if problem.variation.is_some() {
            let at = [out.margin];
            let gradients = gradients(&sliding.problem, &mut own, &at, &crossing);
            s = jumped(
                s,
                &crossing,
                &[&self.field, &beyond],
                (&at, &gradients),
                false,
            );
        }
        let bits = self.solution.bits();
        let piece = Piece::after(beyond, crossing, &s, bits);
        Ok(Piece {
            leaves: Some((sliding, exit)),
            ..piece
        })
    }

    /// Proves the guards from the start, where the motion leaves a switch, to a time at which it is
    /// certainly past it.
    pub fn depart(
        &mut self,
        sliding: &Sliding,
        exit: &Exit,
        mut to: Rational,
        evaluator: &mut Evaluator<Balls>,
        steps: &mut u64,
    ) -> Result<(), Halt> {
        let bits = self.solution.bits();
        for _ in 0..DEPTH {
            let from = self.start.clone();
            let is_other = |guard: &Guarded| guard.switch != sliding.switch;
            let over = self.guards_over([&from, &to], bits, steps)?;
            let holds = over.is_some_and(|over| {
                let mut others = over.iter().filter(|guard| is_other(guard));
                others.all(Guarded::holds)
            });
            let span = times(bits, &from, &to);
            let states = self.over([&from, &to], steps)?;
            if holds && sliding.turns(exit, &span, &states, evaluator) {
                let at_end = self.guards_over([&to, &to], bits, steps)?;
                if at_end.is_some_and(|guards| guards.iter().all(Guarded::holds)) {
                    self.verified = to;
                    return Ok(());
                }
                // A shorter step is known more closely.
                self.solution.shorten(Rational::from(&to - &from).to_f64());
                let (field, constants) = (&self.field.field, &self.field.constants);
                let end = self
                    .solution
                    .end_of_step(field, constants, &from, false, steps)
                    .map_err(Halt::Stopped)?;
                to = to.min(end);
            }
            to = from.clone() + (to - from) / 4u32;
        }
        let (reached, reason) = (self.start.clone(), TOUCHES);
        Err(Halt::Switch { reached, reason })
    }

    pub fn at(&mut self, time: &Rational, steps: &mut u64) -> Result<Vec<Ball>, Halt> {
        let (field, constants) = (&self.field.field, &self.field.constants);
        let found = self.solution.at(field, constants, time, steps);
        found
            .map(|states| self.at_rest(states))
            .map_err(Halt::Stopped)
    }

    /// The states with the one that a sliding motion keeps at zero exactly there.
    fn at_rest(&self, mut states: Vec<Ball>) -> Vec<Ball> {
        if let Some(rest) = self.slides.as_ref().and_then(|sliding| sliding.rest) {
            states[rest] = Ball::integer(states[rest].prec(), 0);
        }
        states
    }

    /// The derivatives that are carried along.
    pub fn carried(&mut self, time: &Rational, steps: &mut u64) -> Result<Vec<Ball>, Halt> {
        let (field, constants) = (&self.field.field, &self.field.constants);
        let found = self.solution.carried(field, constants, time, steps);
        found.map_err(Halt::Stopped)
    }

    /// The states over a part of a step.
    fn over(&mut self, times: [&Rational; 2], steps: &mut u64) -> Result<Vec<Ball>, Halt> {
        let (field, constants) = (&self.field.field, &self.field.constants);
        let states = self.solution.over(field, constants, times, steps);
        states
            .map(|states| self.at_rest(states))
            .map_err(Halt::Stopped)
    }

    /// The guards over a part of a step; none where they have no bounds.
    fn guards_over(
        &mut self,
        [from, to]: [&Rational; 2],
        bits: u32,
        steps: &mut u64,
    ) -> Result<Option<Vec<Guarded>>, Halt> {
        let states = self.over([from, to], steps)?;
        let time = times(bits, from, to);
        Ok(self.field.guards(&time, &states).ok())
    }

    /// Proves the guards from the last time to the end of a step. If one fails, it is returned with
    /// a time at which it still holds and a length after which it fails.
    pub fn failure(
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

/// The gradients of the values that change their signs at switches, over the way across them.
pub(super) fn gradients(
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
    let at = (&span, crossing.hull.as_slice());
    let gradient = |switch: &Switch| {
        let nodes = problem.variation.as_ref()?.gradients.get(switch)?;
        Some(values_at(evaluator, problem, at, nodes))
    };
    let found = switches.iter().map(gradient);
    found
        .map(|g| g.unwrap_or_else(|| vec![whole(); crossing.states.len()]))
        .collect()
}

/// The fields of a motion that stays at some of the switches between two sides each, where those are
/// others than the fields on both sides.
pub(super) fn fields_on(
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

/// The reason of a rate without a value at a time.
pub(super) fn at_rate((node, reason): (Id, NoValue), time: &Rational) -> Halt {
    let time = time.clone();
    Halt::Rate { node, reason, time }
}

/// A solution that carries derivatives along, if there are any.
pub(super) fn carrying(solution: Solution, variation: &[Ball]) -> Solution {
    match variation {
        [] => solution,
        _ => solution.carrying(variation),
    }
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
