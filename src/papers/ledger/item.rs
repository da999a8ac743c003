//! An undecided entry of a ledger.

use super::{Conditions, Kind, Names, Verdict};
use crate::symbolic::{Dimensions, Family, Outcome};
use std::sync::Arc;

/// An entry of a ledger as data. Built with the methods below; nothing is evaluated before
/// [`decide`](super::decide()).
#[derive(Clone, Debug)]
pub struct Item {
    /// A stable name.
    pub id: &'static str,
    /// Where in the paper.
    pub place: &'static str,
    /// Its subject.
    pub kind: Kind,
    /// The printed form.
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

    /// The printed form. A left side that is a name gives that name to the right side; in any case
    /// the sides are called `left` and `right` in the requirements.
    #[must_use]
    pub fn printed(mut self, text: &'static str) -> Item {
        self.printed = Some(text);
        self
    }

    /// Its claim.
    #[must_use]
    pub fn claims(mut self, text: &'static str) -> Item {
        self.claim = text;
        self
    }

    /// A form that is not printed but put together from parts that were corrected.
    #[must_use]
    pub fn composed(mut self, text: &'static str) -> Item {
        self.composed = true;
        self.printed(text)
    }

    /// Definitions in use.
    #[must_use]
    pub fn with(mut self, definitions: &[&'static str]) -> Item {
        self.definitions.extend(definitions);
        self
    }

    /// Adds requirements.
    #[must_use]
    pub fn requires(mut self, requirements: &[impl ToString]) -> Item {
        let texts = requirements.iter().map(ToString::to_string);
        self.requirements.extend(texts);
        self
    }

    /// A statement beside the verdict that is proved.
    #[must_use]
    pub fn also(mut self, text: &'static str) -> Item {
        self.facts.push((text, Outcome::Proved));
        self
    }

    /// A statement beside the verdict that is refuted.
    #[must_use]
    pub fn but_not(mut self, text: &'static str) -> Item {
        self.facts.push((text, Outcome::Refuted));
        self
    }

    /// Expected to be a misprint that so many edits of the family undo.
    #[must_use]
    pub fn misprint(mut self, edits: usize, confused: &[&str], missing: &str) -> Item {
        self.family = Some(Family::new(confused, missing));
        self.most_edits = edits;
        self.expected = Verdict::Misprint;
        self
    }

    /// Expected to be refuted, no single edit of the family helping.
    #[must_use]
    pub fn refuted(mut self, confused: &[&str], missing: &str) -> Item {
        self.family = Some(Family::new(confused, missing));
        self.expected = Verdict::Refuted;
        self
    }

    /// A claim about the model: its statements are decided beside the verdict.
    #[must_use]
    pub fn model(mut self) -> Item {
        self.expected = Verdict::Model;
        self
    }

    /// A definition or datum.
    #[must_use]
    pub fn definition(mut self) -> Item {
        self.expected = Verdict::Definition;
        self
    }

    /// The paper does not say enough.
    #[must_use]
    pub fn undefined(mut self) -> Item {
        self.expected = Verdict::Undefined;
        self
    }

    /// A further remark.
    #[must_use]
    pub fn note(mut self, text: &'static str) -> Item {
        self.note = text;
        self
    }
}
