//! Claims with numbers: a value, or an extreme over a box, and the number as printed.

use super::entry::fault;
use super::read::{Reading, only, required, text, word};
use super::table::{ROUNDINGS, Rounding, formula, shared};
use crate::papers::Subject;
use crate::papers::ledger::boxes::{Function, Region};
use crate::papers::number::Number;
use crate::study::document::Item as Node;
use crate::study::{Study, StudyError, is_name, rational};
use crate::symbolic::{Expr, Outcome};

/// The number that a claim is about.
#[derive(Clone, Debug)]
pub(super) enum Quantity {
    /// An expression without free symbols.
    Value(Study),
    /// The largest value over a box.
    Largest(Function),
    /// The smallest value over a box: that of the negative is the largest.
    Smallest(Function),
}

/// A claim with a number.
#[derive(Clone, Debug)]
pub struct Claim {
    /// A stable name.
    pub id: &'static str,
    /// Where in the paper.
    pub place: &'static str,
    /// The subject of its finding.
    pub subject: Subject,
    /// Its statement.
    pub claim: &'static str,
    /// A further remark.
    pub note: &'static str,
    /// The unit of the number.
    pub unit: &'static str,
    /// The number as printed.
    pub printed: Option<Number>,
    /// The rule of its rounding.
    pub rounding: Rounding,
    /// Bounds as printed that the number has to keep: from below and from above.
    pub bounds: [Option<Number>; 2],
    /// The outcome on record.
    pub expected: Outcome,
    /// Its file and line.
    pub origin: (&'static str, usize),
    pub(super) quantity: Quantity,
}

const KEYS: &str = "id place subject claims note is largest smallest over with printed rounding \
                    above below unit verdict";

const VERDICTS: [(&str, Outcome); 3] = [
    ("confirmed", Outcome::Proved),
    ("refuted", Outcome::Refuted),
    ("undecided", Outcome::Undecided),
];

pub(super) const SUBJECTS: [(&str, Subject); 4] = [
    ("claim", Subject::Claim),
    ("data", Subject::Data),
    ("tables", Subject::Tables),
    ("formula", Subject::Formula),
];

/// Reads a claim.
pub(super) fn read(reading: &mut Reading, node: &Node) -> Result<Claim, StudyError> {
    only(node, KEYS)?;
    let id = reading.id(node)?;
    required(node, "place")?;
    required(node, "claims")?;
    let number = |key: &str| {
        let read = |item: &Node| -> Result<Number, StudyError> {
            let text = item.text()?;
            let none = || item.fault(format!("{text:?} is no decimal number"));
            Number::parse(text).ok_or_else(none)
        };
        node.get(key).map(read).transpose()
    };
    let claim = Claim {
        id,
        place: text(node, "place")?,
        subject: word(node.get("subject"), &SUBJECTS, Subject::Claim)?,
        claim: text(node, "claims")?,
        note: text(node, "note")?,
        unit: match text(node, "unit")? {
            "" => "1",
            unit => unit,
        },
        printed: number("printed")?,
        rounding: word(node.get("rounding"), &ROUNDINGS, Rounding::Nearest)?,
        bounds: [number("above")?, number("below")?],
        expected: word(node.get("verdict"), &VERDICTS, Outcome::Proved)?,
        origin: (reading.file, node.place.line),
        quantity: quantity(reading, node)?,
    };
    match (&claim.printed, &claim.bounds) {
        (None, [None, None]) => Err(node.fault("a claim has a number: printed, above or below")),
        _ => Ok(claim),
    }
}

fn quantity(reading: &Reading, node: &Node) -> Result<Quantity, StudyError> {
    let ways = ["is", "largest", "smallest"].map(|key| node.get(key));
    let shared = shared(reading, node)?;
    let (of, is_largest) = match ways {
        [Some(is), None, None] => return formula(reading, is, &[], &shared).map(Quantity::Value),
        [None, Some(of), None] => (of, true),
        [None, None, Some(of)] => (of, false),
        _ => return Err(node.fault("a claim has one of the keys: is, largest, smallest")),
    };
    let over = required(node, "over")?;
    let mut region: Region = Vec::new();
    for (name, ends) in over.table()? {
        is_name(name, ends)?;
        let [low, high] = ends.list()? else {
            return Err(ends.fault("expected two ends: [from, to]"));
        };
        let (low, high) = (rational(low)?, rational(high)?);
        if low > high {
            return Err(ends.fault(format!("the range of {name} is empty")));
        }
        region.push((name.clone(), [low, high]));
    }
    let (mut definitions, own) = shared;
    let variables = region.iter().map(|r| r.0.clone());
    let names = reading.symbols.names.with(own.into_iter().chain(variables));
    let e = names
        .expression(of.text()?)
        .map_err(|e| fault(e, of, &names))?;
    for (name, _) in &region {
        definitions.names.remove(name);
    }
    let e = match is_largest {
        true => e,
        false => Expr::Neg(Box::new(e)),
    };
    let f = Function::new(&definitions, &e, &region).map_err(|e| fault(e, of, &names))?;
    Ok(match is_largest {
        true => Quantity::Largest(f),
        false => Quantity::Smallest(f),
    })
}
