//! The ledger of a paper: every formula, step, table definition and inline number with what it
//! claims, what was proved or refuted, and the smallest repair.
//!
//! The printed form is data ([`Equation`]). It is rendered, and it is
//! evaluated: an entry's requirements are equations in which the printed form is put in by name.
//! The verdict follows from their outcomes; what the ledger's author expected is only compared.
//!
//! A repair is looked for among all single edits of the printed form (see
//! [`edits`](crate::symbolic::edits())), then, where the entry says so, among all pairs of edits.
//! Every edit that does not work is refuted by an enclosure that excludes zero at a rational point;
//! every edit that works is proved.

mod decide;
mod findings;
mod item;
mod repair;

pub use crate::symbolic::requirement::{Conditions, Domain, Names, Requirement};
pub use decide::decide;
pub use findings::{dimension, finding};
pub use item::Item;

use super::Citation;
use crate::symbolic::{Edit, Equation, Outcome, Witness, latex_equation};
use rayon::prelude::*;
use serde::Serialize;

/// Version of the JSON layout; changes when a field is removed or changes its meaning.
pub const SCHEMA_VERSION: u32 = 1;

/// The subject of an entry.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// A numbered formula, or a part of one.
    Formula,
    /// A step without a number.
    Step,
    /// A row of a table that defines something.
    Table,
    /// A number in the text.
    Number,
    /// A statement of the text about the model.
    Statement,
}

/// The verdict on an entry.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Everything it has to satisfy is proved for the printed form.
    Proved,
    /// Wrong as printed, and no repair in the family.
    Refuted,
    /// Wrong as printed, with a smallest repair for which everything is proved.
    Misprint,
    /// Everything it has to satisfy is proved, but its parts have different dimensions.
    Undimensional,
    /// A claim about the model rather than about the formula, tested; its requirements say how.
    Model,
    /// A definition or datum: nothing follows that could be tested.
    Definition,
    /// The paper does not say enough to test it.
    Undefined,
    /// Neither proved nor refuted.
    Undecided,
}

impl Verdict {
    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Verdict::Proved => "proved",
            Verdict::Refuted => "refuted",
            Verdict::Misprint => "misprint",
            Verdict::Undimensional => "wrong dimension",
            Verdict::Model => "model claim tested",
            Verdict::Definition => "definition",
            Verdict::Undefined => "undefined in the paper",
            Verdict::Undecided => "undecided",
        }
    }
}

/// A formula in both forms.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Formula {
    /// The text form, which is read back and evaluated.
    pub text: String,
    /// LaTeX without delimiters.
    pub latex: String,
}

impl Formula {
    fn of(e: &Equation) -> Formula {
        Formula {
            text: e.to_string(),
            latex: latex_equation(e),
        }
    }
}

/// One requirement with its outcome.
#[derive(Clone, Debug, Serialize)]
pub struct Obligation {
    /// The requirement.
    pub formula: Formula,
    /// For the printed form.
    pub printed: Outcome,
    /// Left minus right in normal form where that is not zero.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub residual: Option<String>,
    /// Where it fails.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub witness: Option<Witness>,
    /// For the corrected form, if there is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub corrected: Option<Outcome>,
    /// The outcome on record for the printed form, where it is not the entry's verdict that says
    /// so.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub recorded: Option<Outcome>,
}

/// A search for the smallest repair.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Repair {
    /// The number of single edits that the family has for this formula.
    pub single_edits: usize,
    /// The number of them that make everything true.
    pub single_that_hold: usize,
    /// Pairs of edits tried; zero if a single edit does or pairs were not asked for.
    pub pairs: usize,
    /// The number of those that hold.
    pub pairs_that_hold: usize,
    /// Edits that make the formula divide by zero.
    pub without_value: usize,
    /// Edits that were neither proved nor refuted.
    pub undecided: usize,
    /// The repairs that hold, without those that say the same in another way.
    pub distinct: Vec<Formula>,
    /// The edits of the first of them.
    pub edits: Vec<Edit>,
}

/// One entry, decided.
#[derive(Clone, Debug, Serialize)]
pub struct LedgerEntry {
    /// A stable name.
    pub id: &'static str,
    /// Where in the paper.
    pub place: &'static str,
    /// Its subject.
    pub kind: Kind,
    /// Its claim.
    pub claim: &'static str,
    /// As printed.
    pub printed: Option<Formula>,
    /// True if the form is not printed like that but put together from parts that were corrected.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub composed: bool,
    /// The verdict.
    pub verdict: Verdict,
    /// The corrected form.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub corrected: Option<Formula>,
    /// Its requirements.
    pub obligations: Vec<Obligation>,
    /// How the correction was found.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub repair: Option<Repair>,
    /// The part whose dimension is wrong, and how.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub dimension: Option<String>,
    /// A further remark.
    #[serde(skip_serializing_if = "str::is_empty")]
    pub note: &'static str,
    /// True if the verdict and every outcome are those on record.
    pub as_recorded: bool,
    /// The verdict on record.
    #[serde(skip)]
    pub expected: Verdict,
    /// Its file and line, where it comes from one.
    #[serde(skip)]
    pub origin: Option<(&'static str, usize)>,
}

/// A paper's ledger.
#[derive(Clone, Debug, Serialize)]
pub struct Ledger {
    /// [`SCHEMA_VERSION`].
    pub schema_version: u32,
    /// Program version.
    pub mechaudit_version: &'static str,
    /// The paper.
    pub paper: Citation,
    /// The entries in the order of the paper.
    pub entries: Vec<LedgerEntry>,
}

impl Ledger {
    /// Decides every item.
    pub fn of(paper: Citation, items: &[Item]) -> Ledger {
        Ledger {
            schema_version: SCHEMA_VERSION,
            mechaudit_version: env!("CARGO_PKG_VERSION"),
            paper,
            entries: items.par_iter().map(decide).collect(),
        }
    }

    /// Returns true if every entry is as recorded.
    pub fn as_recorded(&self) -> bool {
        !self.entries.is_empty() && self.entries.iter().all(|e| e.as_recorded)
    }

    /// The number of entries with that verdict.
    pub fn count(&self, verdict: Verdict) -> usize {
        self.entries.iter().filter(|e| e.verdict == verdict).count()
    }

    /// The short list of what is wrong as printed.
    pub fn errata(&self) -> Errata {
        let wrong = |e: &&LedgerEntry| matches!(e.verdict, Verdict::Misprint | Verdict::Refuted);
        Errata {
            paper: self.paper.clone(),
            source: "text layer of a scan, or a file of the source; a misprint may be one of the paper or of that text",
            errata: self.entries.iter().filter(wrong).map(Erratum::of).collect(),
        }
    }
}

/// The errors of a paper as printed, for programs.
#[derive(Clone, Debug, Serialize)]
pub struct Errata {
    /// The paper.
    pub paper: Citation,
    /// The source of the printed forms.
    pub source: &'static str,
    /// One for each wrong entry.
    pub errata: Vec<Erratum>,
}

/// One erratum.
#[derive(Clone, Debug, Serialize)]
pub struct Erratum {
    /// The entry of the ledger.
    pub id: &'static str,
    /// Where in the paper.
    pub place: &'static str,
    /// Misprint or refuted.
    pub verdict: Verdict,
    /// As printed.
    pub printed: Option<Formula>,
    /// Corrected, if a repair was found.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub corrected: Option<Formula>,
    /// The edits that lead from one to the other.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub edits: Vec<Edit>,
    /// The residual of the first requirement that fails.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub residual: Option<String>,
}

impl Erratum {
    fn of(e: &LedgerEntry) -> Erratum {
        let failed = e.obligations.iter().find(|o| o.printed == Outcome::Refuted);
        let residual = failed.and_then(|o| {
            let at = o.witness.as_ref().map(|w| w.residual.clone());
            o.residual.clone().filter(|r| r.len() <= 160).or(at)
        });
        Erratum {
            id: e.id,
            place: e.place,
            verdict: e.verdict,
            printed: e.printed.clone(),
            corrected: e.corrected.clone(),
            edits: e.repair.as_ref().map_or_else(Vec::new, |r| r.edits.clone()),
            residual,
        }
    }
}

#[cfg(test)]
mod tests;
