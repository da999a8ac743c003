//! An undecided entry of a ledger.

use super::{Conditions, Kind, Names, Verdict};
use crate::symbolic::{Dimensions, Family, Outcome};
use std::sync::Arc;

/// An entry of a ledger as data; nothing is evaluated before [`decide`](super::decide()).
#[derive(Clone, Debug)]
pub struct Item {
    /// A stable name.
    pub id: &'static str,
    /// Where in the paper.
    pub place: &'static str,
    /// Its subject.
    pub kind: Kind,
    /// The printed form. A left side that is a name gives that name to the right side; in any case
    /// the sides are called `left` and `right` in the requirements.
    pub printed: Option<&'static str>,
    /// True if the form is put together from corrected parts instead of printed.
    pub composed: bool,
    /// Its claim.
    pub claim: &'static str,
    /// Definitions that its requirements need, `name = expression` or `t: x = expression`.
    pub definitions: Vec<&'static str>,
    /// The requirements on the printed form.
    pub requirements: Vec<String>,
    /// Further statements with the outcome on record; they do not enter the verdict.
    pub facts: Vec<(&'static str, Outcome)>,
    /// Where a repair is looked for.
    pub family: Option<Family>,
    /// The largest number of edits.
    pub most_edits: usize,
    /// The verdict on record.
    pub expected: Verdict,
    /// A further remark.
    pub note: &'static str,
    /// The smallest repair on record, where the entry states one.
    pub repair: Option<&'static str>,
    /// The names that its formulas may use.
    pub names: Names,
    /// The values that its symbols may have.
    pub conditions: Arc<Conditions>,
    /// The units of its symbols, where they are known.
    pub dimensions: Option<Arc<Dimensions>>,
    /// Its file and line, where it comes from one.
    pub origin: Option<(&'static str, usize)>,
}

impl Item {
    /// An entry of that name and place, expected to be proved.
    pub fn new(id: &'static str, place: &'static str, kind: Kind) -> Item {
        Item {
            id,
            place,
            kind,
            printed: None,
            composed: false,
            claim: "",
            definitions: Vec::new(),
            requirements: Vec::new(),
            facts: Vec::new(),
            family: None,
            most_edits: 1,
            expected: Verdict::Proved,
            note: "",
            repair: None,
            names: Names::default(),
            conditions: Arc::default(),
            dimensions: None,
            origin: None,
        }
    }
}

#[cfg(test)]
mod tests;
