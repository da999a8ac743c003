//! A paper as a folder of text files: symbols, entries, tables and claims, read with their places.
//!
//! The format is described in the chapter [Auditing a paper](crate::book::audit_a_paper).

mod accuracy;
mod audit;
mod claim;
mod entry;
mod finding;
#[cfg(test)]
mod planted_tests;
mod program;
mod read;
mod source;
mod study;
mod survey;
mod symbols;
mod table;
#[cfg(test)]
mod tests;

pub use accuracy::Accuracy;
pub use claim::{Claim, Statement};
pub(super) use finding::VERDICTS as FINDING_VERDICTS;
pub use finding::{Measured, Quantity, Stated};
pub use program::{Program, Programs};
pub use source::Texts;
pub use survey::Survey;
pub use symbols::Symbol;
pub use table::{Column, Rounding, Table};

use super::Citation;
use super::ledger::{Item, Ledger};
use crate::reference::Decimal;
use crate::study::StudyError;
use program::Asked;
use rug::Rational;
use source::Source;
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

/// A paper as its files state it.
#[derive(Clone, Debug, Default)]
pub struct PaperFile {
    /// The paper.
    pub citation: Citation,
    /// The declared symbols.
    pub symbols: Vec<Symbol>,
    /// The entries of the ledger in the order of the files.
    pub items: Vec<Item>,
    /// The tables.
    pub tables: Vec<Table>,
    /// The claims with numbers.
    pub claims: Vec<Claim>,
    /// The claims about the accuracy of algorithms.
    pub accuracies: Vec<Accuracy>,
    /// The surveys of solvers.
    pub surveys: Vec<Survey>,
    /// Groups of definitions by their names.
    groups: BTreeMap<String, Vec<String>>,
    /// The solvers that are programs.
    programs: Vec<Arc<Asked>>,
    /// The findings that it states in words.
    pub stated: Vec<Stated>,
    /// The paper whose analysis in the program finds the figures of findings.
    pub analysis: Option<&'static str>,
}

/// A skeleton of a paper, which is one itself.
pub const SKELETON: Texts = &[
    ("paper.toml", include_str!("skeleton/paper.toml")),
    ("table-1.csv", include_str!("skeleton/table-1.csv")),
];

impl PaperFile {
    /// Opens a folder that holds `paper.toml`, or a single file.
    ///
    /// # Errors
    /// The file, the place and the rule that is broken.
    pub fn open(path: &Path) -> Result<PaperFile, StudyError> {
        let named = |path: &Path| {
            let absolute = std::path::absolute(path).unwrap_or_else(|_| path.to_path_buf());
            let stem = match path.is_dir() {
                true => absolute.file_name(),
                false => absolute.file_stem(),
            };
            stem.map_or_else(|| "paper".into(), |s| s.to_string_lossy().into_owned())
        };
        let (folder, file) = match path.is_dir() {
            true => (path, "paper.toml".into()),
            false => {
                let file = path.file_name().map(|n| n.to_string_lossy().into_owned());
                let folder = path.parent().unwrap_or(Path::new(""));
                (folder, file.unwrap_or_default())
            }
        };
        let source = Source::Folder(folder.to_path_buf());
        let shown = folder.display().to_string();
        read::paper(&named(path), &source, &file).map_err(|mut e| {
            // The whole path, as the user wrote it.
            let file = e.file.unwrap_or(file);
            e.file = Some(match shown.as_str() {
                "" => file,
                shown => format!("{}/{file}", shown.trim_end_matches('/')),
            });
            e
        })
    }

    /// Reads a paper from texts, the first of which is `paper.toml`.
    ///
    /// # Errors
    /// As [`PaperFile::open`].
    pub fn parse(key: &str, texts: Texts) -> Result<PaperFile, StudyError> {
        read::paper(key, &Source::Texts(texts), "paper.toml")
    }

    /// Runs the solvers of the paper that are programs by `by` from now on.
    ///
    /// # Errors
    /// There are programs, and nothing that may run them.
    pub fn run_by(&self, by: Option<&'static dyn Programs>) -> Result<(), StudyError> {
        match by {
            Some(by) => self.programs.iter().for_each(|program| program.run_by(by)),
            None if self.programs.is_empty() => {}
            None => {
                let reason = "solvers of the paper are programs: --exec lets them run";
                return Err(StudyError::new(format!("{}: {reason}", self.citation.key)));
            }
        }
        Ok(())
    }

    /// The number that a group defines, `name = decimal`.
    ///
    /// # Panics
    /// If there is none: for papers that are compiled in.
    pub(super) fn given(&self, group: &str, name: &str) -> Rational {
        let number = |line: &String| {
            let (left, right) = line.split_once('=')?;
            let right = (left.trim() == name).then(|| Decimal::parse(right.trim()))?;
            right.ok()
        };
        let found = self
            .groups
            .get(group)
            .and_then(|g| g.iter().find_map(number));
        found.expect("a number of the paper").value
    }

    /// Decides every entry.
    pub fn ledger(&self) -> Ledger {
        Ledger::of(self.citation.clone(), &self.items)
    }
}
