//! Items built step by step, for tests.

use super::*;

impl Item {
    /// The printed form. A left side that is a name gives that name to the right side; in any case
    /// the sides are called `left` and `right` in the requirements.
    pub fn printed(mut self, text: &'static str) -> Item {
        self.printed = Some(text);
        self
    }

    /// Its claim.
    pub fn claims(mut self, text: &'static str) -> Item {
        self.claim = text;
        self
    }

    /// A form that is not printed but put together from parts that were corrected.
    pub fn composed(mut self, text: &'static str) -> Item {
        self.composed = true;
        self.printed(text)
    }

    /// Definitions in use.
    pub fn with(mut self, definitions: &[&'static str]) -> Item {
        self.definitions.extend(definitions);
        self
    }

    /// Adds requirements.
    pub fn requires(mut self, requirements: &[impl ToString]) -> Item {
        let texts = requirements.iter().map(ToString::to_string);
        self.requirements.extend(texts);
        self
    }

    /// A statement beside the verdict that is proved.
    pub fn also(mut self, text: &'static str) -> Item {
        self.facts.push((text, Outcome::Proved));
        self
    }

    /// A statement beside the verdict that is refuted.
    pub fn but_not(mut self, text: &'static str) -> Item {
        self.facts.push((text, Outcome::Refuted));
        self
    }

    /// Expected to be a misprint that `edits` edits of the family undo.
    pub fn misprint(mut self, edits: usize, confused: &[&str], missing: &str) -> Item {
        self.family = Some(Family::new(confused, missing));
        self.most_edits = edits;
        self.expected = Verdict::Misprint;
        self
    }

    /// Expected to be refuted, no single edit of the family helping.
    pub fn refuted(mut self, confused: &[&str], missing: &str) -> Item {
        self.family = Some(Family::new(confused, missing));
        self.expected = Verdict::Refuted;
        self
    }

    /// A claim about the model: its statements are decided beside the verdict.
    pub fn model(mut self) -> Item {
        self.expected = Verdict::Model;
        self
    }

    /// A definition or datum.
    pub fn definition(mut self) -> Item {
        self.expected = Verdict::Definition;
        self
    }

    /// The paper does not say enough.
    pub fn undefined(mut self) -> Item {
        self.expected = Verdict::Undefined;
        self
    }

    /// A further remark.
    pub fn note(mut self, text: &'static str) -> Item {
        self.note = text;
        self
    }
}
