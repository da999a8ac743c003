//! Findings that sum up entries of the ledger in words. Every verdict is the ledger's.

use super::read::{Reading, required, text, texts, word};
use crate::papers::ledger::{Item, Ledger, LedgerEntry};
use crate::papers::{Draft, Figure, Finding, FindingVerdict, Subject};
use crate::study::document::Item as Node;
use crate::study::{Place, StudyError};

/// A finding and the entries that it rests on.
#[derive(Clone, Debug)]
pub struct Summary {
    id: &'static str,
    place: &'static str,
    verdict: FindingVerdict,
    title: &'static str,
    text: &'static str,
    /// Names of entries with their places in the file.
    entries: Vec<(&'static str, Place)>,
    file: &'static str,
}

pub(super) const VERDICTS: [(&str, FindingVerdict); 6] = [
    ("confirmed", FindingVerdict::Confirmed),
    ("error-of-paper", FindingVerdict::ErrorOfPaper),
    ("print-or-scan", FindingVerdict::PrintOrScan),
    ("refuted", FindingVerdict::Refuted),
    ("recovered", FindingVerdict::Recovered),
    ("unexplained", FindingVerdict::Unexplained),
];

/// Reads a finding.
pub(super) fn read(reading: &mut Reading, node: &Node) -> Result<Summary, StudyError> {
    node.only(&["id", "place", "verdict", "title", "text", "entries"])?;
    let verdict = required(node, "verdict")?;
    let mut entries = Vec::new();
    for item in texts(node.get("entries"))? {
        entries.push((crate::study::intern(item.text()?), item.place));
    }
    for key in ["place", "title", "text", "entries"] {
        required(node, key)?;
    }
    if entries.is_empty() {
        return Err(node.fault("a finding rests on at least one entry"));
    }
    Ok(Summary {
        id: reading.id(node)?,
        place: text(node, "place")?,
        verdict: word(Some(verdict), &VERDICTS, FindingVerdict::Unexplained)?,
        title: text(node, "title")?,
        text: text(node, "text")?,
        entries,
        file: reading.file,
    })
}

impl Summary {
    /// Checks that all entries exist.
    pub(super) fn check(&self, items: &[Item]) -> Result<(), StudyError> {
        let ids: Vec<&str> = items.iter().map(|i| i.id).collect();
        let missing = self.entries.iter().find(|e| !ids.contains(&e.0));
        let Some((id, place)) = missing else {
            return Ok(());
        };
        let hint = crate::audit::did_you_mean(id, &ids);
        let fault = StudyError::new(format!("there is no entry {id:?}{hint}"));
        Err(fault.at(*place).in_file(self.file))
    }

    /// Returns true if the finding rests on an entry.
    pub(super) fn covers(&self, id: &str) -> bool {
        self.entries.iter().any(|e| e.0 == id)
    }

    /// The finding, which is as recorded if all of its entries are.
    pub(in crate::papers) fn finding(&self, ledger: &Ledger) -> Finding {
        let found = |id: &str| ledger.entries.iter().find(|e| e.id == id);
        let entries: Vec<&LedgerEntry> = self.entries.iter().filter_map(|e| found(e.0)).collect();
        let all = entries.len() == self.entries.len() && entries.iter().all(|e| e.as_recorded);
        Draft::new(self.id, Subject::Formula, self.place)
            .verdict(self.verdict)
            .titled(self.title)
            .text(self.text)
            .figures(entries.into_iter().map(figure))
            .recorded_if(all)
    }
}

fn figure(entry: &LedgerEntry) -> Figure {
    let statements = entry.obligations.len();
    Figure {
        name: format!("{} of the ledger", entry.id),
        value: match (&entry.corrected, statements) {
            (Some(corrected), _) => format!("misprint, has to be {}", corrected.text),
            (None, 0) => entry.verdict.words().into(),
            (None, 1) => format!("{}, one statement decided", entry.verdict.words()),
            (None, n) => format!("{}, {n} statements decided", entry.verdict.words()),
        },
        unit: "1",
        latex: None,
    }
}
