//! The search for the smallest repair.

use super::decide::bound;
use super::{Formula, Repair, Requirement};
use crate::symbolic::{
    Definitions, Edit, Equation, Exact, Expr, Family, Outcome, edits, latex_equation,
};
use std::collections::BTreeSet;

/// What a candidate turned out to be.
fn judge(requirements: &[Requirement], definitions: &Definitions) -> Outcome {
    if requirements.iter().any(|r| r.fails_quickly(definitions)) {
        return Outcome::Refuted;
    }
    let mut out = Outcome::Proved;
    for r in requirements {
        match r.decide(definitions).outcome {
            Outcome::Refuted => return Outcome::Refuted,
            Outcome::Undecided => out = Outcome::Undecided,
            Outcome::Proved => {}
        }
    }
    out
}

/// Whether two repairs say the same: equal right sides under one name, or differences of the sides
/// that are equal up to sign.
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

/// Looks for the smallest repair of a printed form that fails. Gives the first one that holds.
pub(super) fn search(
    printed: &Equation,
    family: &Family,
    most: usize,
    definitions: &Definitions,
    requirements: &[Requirement],
) -> (Repair, Option<Equation>) {
    let singles = edits(printed, family);
    let mut out = Repair {
        single_edits: singles.len(),
        ..Repair::default()
    };
    let mut holding: Vec<(Vec<Edit>, Equation)> = Vec::new();
    let mut tried: BTreeSet<String> = BTreeSet::from([printed.to_string()]);
    for (edit, candidate) in &singles {
        tried.insert(candidate.to_string());
        match judge(requirements, &bound(definitions, candidate)) {
            Outcome::Proved => holding.push((vec![edit.clone()], candidate.clone())),
            Outcome::Undecided => out.undecided += 1,
            Outcome::Refuted => {}
        }
    }
    out.single_that_hold = holding.len();
    if holding.is_empty() && most > 1 {
        for (first, between) in &singles {
            for (second, candidate) in edits(between, family) {
                if !tried.insert(candidate.to_string()) {
                    continue;
                }
                out.pairs += 1;
                match judge(requirements, &bound(definitions, &candidate)) {
                    Outcome::Proved => holding.push((vec![first.clone(), second], candidate)),
                    Outcome::Undecided => out.undecided += 1,
                    Outcome::Refuted => {}
                }
            }
        }
        out.pairs_that_hold = holding.len();
    }
    let mut distinct: Vec<&Equation> = Vec::new();
    for (_, e) in &holding {
        if !distinct.iter().any(|d| same(definitions, d, e)) {
            distinct.push(e);
        }
    }
    out.distinct = distinct
        .iter()
        .map(|e| Formula {
            text: e.to_string(),
            latex: latex_equation(e),
        })
        .collect();
    let first = holding.into_iter().next();
    let (edits, corrected) = first.map_or((Vec::new(), None), |(e, c)| (e, Some(c)));
    out.edits = edits;
    (out, corrected)
}
