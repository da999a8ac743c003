//! Conditions over a box, and the choice between two branches.

use super::super::tape::{Condition, Place, Tape};
use super::{Pass, Stop, one, stop};
use crate::interval::sum_up;
use mechaudit_symbolic::Relation;

impl Pass {
    /// Returns whether a condition holds for every value on the path, or for none.
    pub fn holds(&self, tape: &Tape, condition: usize) -> Option<bool> {
        match tape.conditions[condition] {
            Condition::Truth(t) => Some(t),
            Condition::Not(a) => self.holds(tape, a).map(|t| !t),
            Condition::And(a, b) => match (self.holds(tape, a), self.holds(tape, b)) {
                (Some(false), _) | (_, Some(false)) => Some(false),
                (Some(true), Some(true)) => Some(true),
                _ => None,
            },
            Condition::Or(a, b) => match (self.holds(tape, a), self.holds(tape, b)) {
                (Some(true), _) | (_, Some(true)) => Some(true),
                (Some(false), Some(false)) => Some(false),
                _ => None,
            },
            Condition::Compare(relation, a, b) => {
                let (x, y) = (self.value[a], self.value[b]);
                let all = |all: bool, none: bool| match (all, none) {
                    (true, _) => Some(true),
                    (_, true) => Some(false),
                    _ => None,
                };
                let equal = x.is_point() && y.is_point() && x.lo == y.lo;
                let apart = x.hi < y.lo || y.hi < x.lo;
                match relation {
                    Relation::Less => all(x.hi < y.lo, x.lo >= y.hi),
                    Relation::LessEqual => all(x.hi <= y.lo, x.lo > y.hi),
                    Relation::Greater => all(x.lo > y.hi, x.hi <= y.lo),
                    Relation::GreaterEqual => all(x.lo >= y.hi, x.hi < y.lo),
                    Relation::Equal => all(equal, apart),
                    Relation::NotEqual => all(apart, equal),
                }
            }
        }
    }

    /// Returns whether a condition compares numbers without errors alone: the execution then takes
    /// the branch of the exact value.
    fn is_exact(&self, tape: &Tape, condition: usize) -> bool {
        match tape.conditions[condition] {
            Condition::Truth(_) => true,
            Condition::Not(a) => self.is_exact(tape, a),
            Condition::And(a, b) | Condition::Or(a, b) => {
                self.is_exact(tape, a) && self.is_exact(tape, b)
            }
            Condition::Compare(_, a, b) => self.error[a] == 0.0 && self.error[b] == 0.0,
        }
    }

    /// The branch of the exact value, and what the other one differs by where the execution may
    /// take it.
    pub(super) fn choose(
        &mut self,
        tape: &Tape,
        condition: usize,
        a: Place,
        b: Place,
        picks: &[bool],
    ) -> Result<(), Stop> {
        let mut float = None;
        let (taken, jump, value) = match self.holds(tape, condition) {
            Some(true) => (a, 0.0, self.value[a]),
            Some(false) => (b, 0.0, self.value[b]),
            None => {
                let known = self.open.iter().position(|c| *c == condition);
                let place = known.unwrap_or_else(|| {
                    self.open.push(condition);
                    self.open.len() - 1
                });
                let pick = picks.get(place).copied();
                let taken = if pick.unwrap_or(true) { a } else { b };
                // As long as no branch is picked the exact value may be that of either.
                let value = match pick {
                    Some(_) => self.value[taken],
                    None => self.value[a].hull(self.value[b]),
                };
                let follows = self.is_exact(tape, condition);
                let jump = match a == b || follows {
                    true => 0.0,
                    false => (self.float[a] - self.float[b]).magnitude(),
                };
                if pick.is_none() || !follows {
                    float = Some(self.float[a].hull(self.float[b]));
                }
                if !jump.is_finite() {
                    return stop("a jump without a bound");
                }
                (taken, jump, value)
            }
        };
        let (float, grain) = match float {
            Some(either) => (either, self.grain[a].min(self.grain[b])),
            None => (self.float[taken], self.grain[taken]),
        };
        let error = sum_up(self.error[taken], jump);
        self.push(float, value, jump, grain, error);
        let last = self.partial.len() - 1;
        let side = usize::from(taken == b && a != b);
        self.partial[last][side] = one();
        Ok(())
    }
}
