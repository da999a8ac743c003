//! The decision of an entry: from data to verdict.

use super::repair::{bound, search};
use super::{Formula, Item, LedgerEntry, Obligation, Requirement, Verdict};
use crate::symbolic::{
    Definitions, Equation, Expr, Identity, Outcome, SymbolicError, Undimensional,
};

fn obligation(r: &Requirement, found: Identity, recorded: Option<Outcome>) -> Obligation {
    Obligation {
        formula: Formula {
            text: r.to_string(),
            latex: r.latex(),
        },
        printed: found.outcome,
        residual: found.residual.filter(|_| found.outcome != Outcome::Proved),
        witness: found.witness,
        corrected: None,
        recorded,
    }
}

/// The longest text of a form that a repair is looked for: every edit is a copy of the whole form.
const LONGEST_REPAIRED: usize = 1000;

/// Decides one item.
pub fn decide(item: &Item) -> LedgerEntry {
    match evaluate(item) {
        Ok(entry) => entry,
        // Data that cannot be read are shown as undecided, which is never on record.
        Err(error) => LedgerEntry {
            verdict: Verdict::Undecided,
            as_recorded: false,
            obligations: vec![Obligation {
                formula: Formula {
                    text: error.to_string(),
                    latex: String::new(),
                },
                printed: Outcome::Undecided,
                residual: None,
                witness: None,
                corrected: None,
                recorded: None,
            }],
            ..blank(item)
        },
    }
}

fn blank(item: &Item) -> LedgerEntry {
    LedgerEntry {
        id: item.id,
        place: item.place,
        kind: item.kind,
        claim: item.claim,
        printed: None,
        composed: item.composed,
        verdict: Verdict::Undecided,
        corrected: None,
        obligations: Vec::new(),
        repair: None,
        note: item.note,
        dimension: None,
        as_recorded: false,
        expected: item.expected,
        origin: item.origin,
    }
}

/// The fault of the dimensions of a printed form. Where a name has no unit nothing is said.
fn undimensional(item: &Item, definitions: &Definitions, printed: &Equation) -> Option<String> {
    let units = item.dimensions.as_ref()?;
    let checked = match &printed.left {
        // A number alone is in the unit of its symbol.
        Expr::Sym(_) if is_number(&printed.right) => Ok(()),
        Expr::Sym(name) if !units.has(name) => units.of(definitions, &printed.right).map(drop),
        _ => units.check(definitions, printed),
    };
    match checked {
        Ok(()) | Err(Undimensional::NoUnit { .. } | Undimensional::Circular { .. }) => None,
        Err(fault) => Some(fault.to_string()),
    }
}

fn is_number(e: &Expr) -> bool {
    matches!(e, Expr::Num(_)) || matches!(e, Expr::Neg(x) if is_number(x))
}

fn evaluate(item: &Item) -> Result<LedgerEntry, SymbolicError> {
    let (names, conditions) = (&item.names, &*item.conditions);
    let definitions = names.definitions(&item.definitions)?;
    let printed = item.printed.map(|text| names.equation(text)).transpose()?;
    let with = match &printed {
        Some(e) => bound(&definitions, e, e),
        None => definitions.clone(),
    };
    let parsed = item
        .requirements
        .iter()
        .map(|t| Requirement::read(t, names));
    let requirements: Vec<Requirement> = parsed.collect::<Result<_, _>>()?;
    let mut obligations: Vec<Obligation> = requirements
        .iter()
        .map(|r| obligation(r, conditions.decide(r, &with), None))
        .collect();
    let outcome = |o: Outcome| obligations.iter().any(|x| x.printed == o);
    let (failed, open) = (outcome(Outcome::Refuted), outcome(Outcome::Undecided));

    let mut entry = blank(item);
    entry.printed = printed.as_ref().map(Formula::of);
    entry.dimension = printed
        .as_ref()
        .and_then(|e| undimensional(item, &definitions, e));
    entry.verdict = match item.expected {
        declared @ (Verdict::Model | Verdict::Definition | Verdict::Undefined)
            if requirements.is_empty() =>
        {
            declared
        }
        _ if requirements.is_empty() => Verdict::Undecided,
        _ if failed => Verdict::Refuted,
        _ if open => Verdict::Undecided,
        _ if entry.dimension.is_some() => Verdict::Undimensional,
        _ => Verdict::Proved,
    };
    let short = item
        .printed
        .is_some_and(|text| text.len() <= LONGEST_REPAIRED);
    if let (true, Some(e), Some(family)) = (failed && short, &printed, &item.family) {
        let (repair, corrected) = search(
            e,
            family,
            item.most_edits,
            &definitions,
            &requirements,
            conditions,
        );
        if let Some(corrected) = corrected {
            entry.verdict = Verdict::Misprint;
            let with = bound(&definitions, e, &corrected);
            for (o, r) in obligations.iter_mut().zip(&requirements) {
                o.corrected = Some(conditions.decide(r, &with).outcome);
            }
            entry.corrected = Some(Formula::of(&corrected));
        }
        entry.repair = Some(repair);
    }
    for (text, recorded) in &item.facts {
        let r = Requirement::read(text, names)?;
        let found = conditions.decide(&r, &with);
        obligations.push(obligation(&r, found, Some(*recorded)));
    }
    // A claim that is called tested has to be tested.
    let repair = item.repair.map(|text| names.equation(text)).transpose()?;
    let repaired = repair.is_none_or(|r| {
        let found = entry.corrected.as_ref().map(|c| c.text.as_str());
        found == Some(r.to_string().as_str())
    });
    let tested = item.expected != Verdict::Model || !item.facts.is_empty();
    entry.as_recorded = entry.verdict == item.expected
        && tested
        && repaired
        && obligations
            .iter()
            .all(|o| o.recorded.is_none_or(|r| r == o.printed))
        && obligations
            .iter()
            .all(|o| o.corrected.is_none_or(|c| c == Outcome::Proved))
        && entry.repair.as_ref().is_none_or(|r| {
            r.undecided == 0 && (r.edits.is_empty() || r.edits.len() == item.most_edits)
        });
    entry.obligations = obligations;
    Ok(entry)
}
