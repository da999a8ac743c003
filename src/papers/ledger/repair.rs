//! The search for the smallest repair.

use super::{Conditions, Formula, Repair, Requirement};
use crate::reference::ComplexBall;
use crate::symbolic::{
    Definitions, Edit, Enclosures, Equation, Exact, Expr, Family, Outcome, SymbolicError, edits,
};
use std::cell::RefCell;
use std::collections::BTreeSet;

/// The outcome of a candidate.
enum Judged {
    Holds,
    Fails,
    /// It divides by zero whatever the values are.
    WithoutValue,
    Undecided,
}

/// The definitions with a form put in: under the name that the printed form has, if it has one.
pub(super) fn bound(definitions: &Definitions, printed: &Equation, form: &Equation) -> Definitions {
    let mut out = definitions.clone();
    if let Expr::Sym(name) = &printed.left {
        out.set(name, form.right.clone());
    }
    out.set("left", form.left.clone());
    out.set("right", form.right.clone());
    out
}

/// The requirements, with the sides that do not depend on the printed form enclosed beforehand.
struct Judge<'a> {
    printed: &'a Equation,
    definitions: &'a Definitions,
    requirements: &'a [Requirement],
    conditions: &'a Conditions,
    fixed: Vec<[Option<ComplexBall>; 2]>,
    /// Values at the point of the first look; none where no point is known to be one of the domain.
    enclosures: Option<RefCell<Enclosures>>,
}

impl<'a> Judge<'a> {
    fn new(
        printed: &'a Equation,
        definitions: &'a Definitions,
        requirements: &'a [Requirement],
        conditions: &'a Conditions,
    ) -> Judge<'a> {
        let point = conditions.first_point();
        let mut names = vec!["left", "right"];
        if let Expr::Sym(name) = &printed.left {
            names.push(name);
        }
        let mut enclosures = point.map(|point| Enclosures::of_changing(&point, &names));
        let mut enclosed = |e: &Expr| match definitions.reaches(e, &names) {
            true => None,
            false => enclosures.as_mut()?.value(definitions, e).ok(),
        };
        let fixed = requirements
            .iter()
            .map(|r| match r {
                Requirement::Equal(e) => [enclosed(&e.left), enclosed(&e.right)],
                _ => [None, None],
            })
            .collect();
        Judge {
            printed,
            definitions,
            requirements,
            conditions,
            fixed,
            enclosures: enclosures.map(RefCell::new),
        }
    }

    /// Returns true if an enclosure refutes an equation at the first point.
    fn fails_quickly(&self, with: &Definitions) -> bool {
        let Some(enclosures) = &self.enclosures else {
            return false;
        };
        self.requirements.iter().zip(&self.fixed).any(|(r, fixed)| {
            let Requirement::Equal(e) = r else {
                return false;
            };
            // Of derivatives there are no enclosures.
            let value = |e: &Expr, fixed: &Option<ComplexBall>| match fixed {
                Some(v) => Some(v.clone()),
                None => enclosures.borrow_mut().value(with, e).ok(),
            };
            let Some(left) = value(&e.left, &fixed[0]) else {
                return false;
            };
            let Some(right) = value(&e.right, &fixed[1]) else {
                return false;
            };
            !left.re.overlaps(&right.re) || !left.im.overlaps(&right.im)
        })
    }

    fn judge(&self, candidate: &Equation) -> Judged {
        let with = bound(self.definitions, self.printed, candidate);
        if self.fails_quickly(&with) {
            return Judged::Fails;
        }
        let mut out = Judged::Holds;
        for r in self.requirements {
            let found = self.conditions.decide(r, &with);
            match (found.outcome, found.error) {
                (Outcome::Refuted, _) => return Judged::Fails,
                (Outcome::Proved, _) => {}
                (Outcome::Undecided, Some(SymbolicError::NotInvertible(_))) => {
                    out = Judged::WithoutValue;
                }
                (Outcome::Undecided, _) => return Judged::Undecided,
            }
        }
        out
    }
}

/// Returns true if two repairs say the same: equal right sides under one name, or differences of
/// the sides that are equal up to sign.
fn same(definitions: &Definitions, a: &Equation, b: &Equation) -> bool {
    let difference = |e: &Equation| {
        let parts = vec![e.left.clone(), Expr::Neg(Box::new(e.right.clone()))];
        match e.left {
            Expr::Sym(_) | Expr::Index(..) => e.right.clone(),
            _ => Expr::Add(parts),
        }
    };
    let (a, b) = (difference(a), difference(b));
    let vanishes = |e: Expr| {
        let form = Exact::default().value(definitions, &e);
        form.is_ok_and(|f| f.is_zero())
    };
    let minus = Expr::Add(vec![a.clone(), Expr::Neg(Box::new(b.clone()))]);
    vanishes(minus) || vanishes(Expr::Add(vec![a, b]))
}

/// Candidates of one search, ten times as many as any formula of the papers has had.
const MOST: usize = 50_000;
/// Undecided candidates after which a search is given up: each may have cost all the work allowed.
const MOST_UNDECIDED: usize = 200;

/// Returns the candidates that hold, of all until there are too many or too many stay undecided.
fn judge_all(
    judge: &Judge,
    all: impl Iterator<Item = (Vec<Edit>, Equation)>,
    out: &mut Repair,
) -> Vec<(Vec<Edit>, Equation)> {
    let mut holding = Vec::new();
    for (edits, candidate) in all {
        if out.single_edits + out.pairs > MOST || out.undecided > MOST_UNDECIDED {
            out.undecided += 1;
            break;
        }
        out.pairs += edits.len() - 1;
        match judge.judge(&candidate) {
            Judged::Holds => holding.push((edits, candidate)),
            Judged::Undecided => out.undecided += 1,
            Judged::WithoutValue => out.without_value += 1,
            Judged::Fails => {}
        }
    }
    holding
}

/// Looks for the smallest repair of a printed form that fails. Gives the first one that holds.
pub(super) fn search(
    printed: &Equation,
    family: &Family,
    most: usize,
    definitions: &Definitions,
    requirements: &[Requirement],
    conditions: &Conditions,
) -> (Repair, Option<Equation>) {
    let singles = edits(printed, family);
    let judge = Judge::new(printed, definitions, requirements, conditions);
    let mut out = Repair {
        single_edits: singles.len(),
        ..Repair::default()
    };
    let one = singles.iter().map(|(e, c)| (vec![e.clone()], c.clone()));
    let mut holding = judge_all(&judge, one, &mut out);
    out.single_that_hold = holding.len();
    if holding.is_empty() && most > 1 {
        let mut tried: BTreeSet<String> = singles.iter().map(|s| s.1.to_string()).collect();
        tried.insert(printed.to_string());
        let pairs = singles.iter().flat_map(|(first, between)| {
            let more = edits(between, family).into_iter();
            more.map(move |(second, candidate)| (vec![first.clone(), second], candidate))
        });
        let new = pairs.filter(|pair| tried.insert(pair.1.to_string()));
        holding = judge_all(&judge, new, &mut out);
        out.pairs_that_hold = holding.len();
    }
    let mut distinct: Vec<&Equation> = Vec::new();
    for (_, e) in &holding {
        if !distinct.iter().any(|d| same(definitions, d, e)) {
            distinct.push(e);
        }
    }
    out.distinct = distinct.into_iter().map(Formula::of).collect();
    let first = holding.into_iter().next();
    let (edits, corrected) = first.map_or((Vec::new(), None), |(e, c)| (e, Some(c)));
    out.edits = edits;
    (out, corrected)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::symbolic::parse_equation;

    /// √2 √2 < 2 cannot be told in balls, whatever is printed.
    #[test]
    fn what_stays_undecided_is_counted() {
        let printed = parse_equation("x = a + b").unwrap();
        let requirement = Requirement::parse("sqrt(2) * sqrt(2) < 2").unwrap();
        let found = |most| {
            let family = Family::default();
            let (definitions, requirements) = (Definitions::default(), [requirement.clone()]);
            let conditions = Conditions::default();
            search(
                &printed,
                &family,
                most,
                &definitions,
                &requirements,
                &conditions,
            )
            .0
        };
        let singles = found(1);
        assert!(singles.single_edits > 2 && singles.pairs == 0);
        assert_eq!(singles.undecided, singles.single_edits);
        let pairs = found(2);
        assert!(pairs.pairs > 2);
        assert_eq!(pairs.undecided, pairs.single_edits + pairs.pairs);
    }
}
