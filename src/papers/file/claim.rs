//! Claims with numbers: a value, or an extreme over a box, and the number as printed.

use super::entry::fault;
use super::read::{Reading, ends, only, required, text, word};
use super::table::{ROUNDINGS, Rounding, formula, shared};
use crate::papers::number::Number;
use crate::papers::{Figure, Finding, FindingVerdict, Subject};
use crate::study::document::Item as Node;
use crate::study::{Study, StudyError, is_name};
use crate::symbolic::requirement::boxes::{Function, Region};
use crate::symbolic::{Expr, Outcome};

/// The number that a claim is about.
#[derive(Clone, Debug)]
pub(super) enum Quantity {
    /// An expression without free symbols.
    Value(Study),
    /// The largest value over a box.
    Largest(Function),
    /// The smallest value over a box, by the function's negative.
    Smallest(Function),
}

/// A statement of a paper.
#[derive(Clone, Debug)]
pub struct Statement {
    /// A stable name.
    pub id: &'static str,
    /// Where in the paper.
    pub place: &'static str,
    /// The subject of its finding.
    pub subject: Subject,
    /// Its words.
    pub claim: &'static str,
    /// A further remark, for instance how it is read.
    pub note: &'static str,
}

impl Statement {
    /// Reads the keys that all statements have.
    pub(super) fn read(reading: &mut Reading, node: &Node) -> Result<Statement, StudyError> {
        let id = reading.id(node)?;
        required(node, "place")?;
        required(node, "claims")?;
        Ok(Statement {
            id,
            place: text(node, "place")?,
            subject: word(node.get("subject"), &SUBJECTS, Subject::Claim)?,
            claim: text(node, "claims")?,
            note: text(node, "note")?,
        })
    }

    /// The finding on it, whose text is `words` and the remark.
    pub(super) fn finding(
        &self,
        verdict: FindingVerdict,
        words: &str,
        figures: Vec<Figure>,
        as_recorded: bool,
    ) -> Finding {
        Finding {
            id: self.id,
            subject: self.subject,
            place: self.place,
            title: self.claim.trim_end_matches('.').into(),
            verdict,
            text: [words, self.note].join(" ").trim().into(),
            figures,
            as_recorded,
        }
    }
}

/// A claim with a number.
#[derive(Clone, Debug)]
pub struct Claim {
    /// Its statement.
    pub statement: Statement,
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
    pub(super) quantity: Quantity,
}

impl Claim {
    /// The numbers as printed, with their names.
    pub(super) fn numbers(&self) -> impl Iterator<Item = (&'static str, &Number)> {
        let [lower, upper] = &self.bounds;
        let all = [
            ("printed", &self.printed),
            ("printed lower bound", lower),
            ("printed upper bound", upper),
        ];
        all.into_iter()
            .filter_map(|(name, number)| Some((name, number.as_ref()?)))
    }
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
    let statement = Statement::read(reading, node)?;
    let number = |key: &str| {
        let read = |item: &Node| -> Result<Number, StudyError> {
            let text = item.text()?;
            let none = || item.fault(format!("{text:?} is no decimal number"));
            Number::parse(text).ok_or_else(none)
        };
        node.get(key).map(read).transpose()
    };
    let claim = Claim {
        statement,
        unit: match text(node, "unit")? {
            "" => "1",
            unit => unit,
        },
        printed: number("printed")?,
        rounding: word(node.get("rounding"), &ROUNDINGS, Rounding::Nearest)?,
        bounds: [number("above")?, number("below")?],
        expected: word(node.get("verdict"), &VERDICTS, Outcome::Proved)?,
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
    for (name, node) in over.table()? {
        is_name(name, node)?;
        let range = ends(node)?;
        if range[0] > range[1] {
            return Err(node.fault(format!("the range of {name} is empty")));
        }
        region.push((name.clone(), range));
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
