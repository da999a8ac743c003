//! Findings that a file states in words, with the entries or figures that they rest on. What is
//! found is the ledger's, the evaluator's, or that of the paper's own analysis.

use super::audit::{MORE_DIGITS, recomputed, shown};
use super::claim::SUBJECTS;
use super::read::{Reading, only, required, text, texts, word};
use super::table::{formula, shared};
use crate::papers::ledger::{Item, Ledger, LedgerEntry, Verdict, proved};
use crate::papers::number::Number;
use crate::papers::{Analysis, Draft, Figure, Finding, FindingVerdict, Found, Subject, figure};
use crate::papers::{known, recorded};
use crate::reference::Decimal;
use crate::study::document::Item as Node;
use crate::study::{Place, Study, StudyError, intern};

/// A finding and its basis.
#[derive(Clone, Debug)]
pub struct Summary {
    id: &'static str,
    subject: Subject,
    place: &'static str,
    verdict: FindingVerdict,
    title: &'static str,
    text: &'static str,
    basis: Basis,
    file: &'static str,
}

#[derive(Clone, Debug)]
enum Basis {
    /// Entries of the ledger, with their places in the file.
    Entries(Vec<(&'static str, Place)>),
    /// Everything in the ledger that is proved; no other entry is a finding if it is the whole.
    Ledger { whole: bool },
    /// Figures as on record, and the words on record that title and text have in places.
    Figures(Vec<Stated>, Vec<&'static str>),
}

/// A figure as the file states it.
#[derive(Clone, Debug)]
struct Stated {
    name: &'static str,
    unit: &'static str,
    value: &'static str,
    /// Its expression; none where the analysis gives the value.
    is: Option<Study>,
}

const KEYS: &str = "id subject place verdict title text entries ledger figures words with";

pub(in crate::papers) const VERDICTS: [(&str, FindingVerdict); 6] = [
    ("confirmed", FindingVerdict::Confirmed),
    ("error-of-paper", FindingVerdict::ErrorOfPaper),
    ("print-or-scan", FindingVerdict::PrintOrScan),
    ("refuted", FindingVerdict::Refuted),
    ("recovered", FindingVerdict::Recovered),
    ("unexplained", FindingVerdict::Unexplained),
];

/// Reads a finding.
pub(super) fn read(reading: &mut Reading, node: &Node) -> Result<Summary, StudyError> {
    only(node, KEYS)?;
    for key in ["place", "title", "text"] {
        required(node, key)?;
    }
    let verdict = required(node, "verdict")?;
    Ok(Summary {
        id: reading.id(node)?,
        subject: word(node.get("subject"), &SUBJECTS, Subject::Formula)?,
        place: text(node, "place")?,
        verdict: word(Some(verdict), &VERDICTS, FindingVerdict::Unexplained)?,
        title: text(node, "title")?,
        text: text(node, "text")?,
        basis: basis(reading, node)?,
        file: reading.file,
    })
}

fn basis(reading: &Reading, node: &Node) -> Result<Basis, StudyError> {
    let mut entries = Vec::new();
    for item in texts(node.get("entries"))? {
        entries.push((intern(item.text()?), item.place));
    }
    match (node.get("entries"), node.get("ledger")) {
        (Some(_), None) if !entries.is_empty() => return Ok(Basis::Entries(entries)),
        (None, Some(ledger)) => {
            let whole = word(Some(ledger), &[("whole", true), ("proved", false)], true)?;
            return Ok(Basis::Ledger { whole });
        }
        (None, None) => {}
        _ => return Err(node.fault("a finding rests on at least one entry, or on the ledger")),
    }
    let shared = shared(reading, node)?;
    let mut figures = Vec::new();
    for item in node.get("figures").map_or(Ok(&[][..]), Node::list)? {
        item.only(&["name", "unit", "value", "is"])?;
        let value = required(item, "value")?;
        let is = match item.get("is") {
            None => None,
            Some(_) if Decimal::parse(value.text()?).is_err() => {
                return Err(value.fault("the value of an expression is a decimal number"));
            }
            Some(is) => Some(formula(reading, is, &[], &shared)?),
        };
        figures.push(Stated {
            name: intern(required(item, "name")?.text()?),
            unit: item
                .get("unit")
                .map_or(Ok("1"), |unit| unit.text().map(intern))?,
            value: intern(value.text()?),
            is,
        });
    }
    let of_analysis = figures.is_empty() || figures.iter().any(|f| f.is.is_none());
    if of_analysis && !reading.is_analysed {
        let rule = "a finding rests on entries, on the ledger, or on figures with expressions";
        return Err(node.fault(rule));
    }
    let words = texts(node.get("words"))?;
    let words = words.into_iter().map(|word| word.text().map(intern));
    Ok(Basis::Figures(figures, words.collect::<Result<_, _>>()?))
}

impl Stated {
    /// The figure as found: on record if the value is the correct rounding of the expression's.
    fn figure(&self, of_analysis: &mut impl Iterator<Item = Figure>) -> Figure {
        let value = match &self.is {
            Some(study) => {
                let on_record = Number::read(self.value);
                let digits = on_record.text.len() + MORE_DIGITS;
                match recomputed(study, digits) {
                    Ok(value) if on_record.is_rounded(&value) => on_record.text,
                    value => shown(&value, digits),
                }
            }
            None => of_analysis.next().map_or("missing".into(), |f| f.value),
        };
        figure(self.name, value, self.unit)
    }
}

impl Summary {
    /// Checks that all entries exist.
    pub(super) fn check(&self, items: &[Item]) -> Result<(), StudyError> {
        let entries = match &self.basis {
            Basis::Entries(entries) => entries,
            Basis::Ledger { .. } if items.is_empty() => {
                let fault = StudyError::new(format!("{}: the paper has no entries", self.id));
                return Err(fault.in_file(self.file));
            }
            _ => return Ok(()),
        };
        let ids: Vec<&str> = items.iter().map(|i| i.id).collect();
        let Some((id, place)) = entries.iter().find(|e| !ids.contains(&e.0)) else {
            return Ok(());
        };
        let hint = crate::audit::did_you_mean(id, &ids);
        let fault = StudyError::new(format!("there is no entry {id:?}{hint}"));
        Err(fault.at(*place).in_file(self.file))
    }

    /// Returns true if the finding rests on an entry.
    pub(super) fn covers(&self, id: &str) -> bool {
        match &self.basis {
            Basis::Entries(entries) => entries.iter().any(|e| e.0 == id),
            Basis::Ledger { whole } => *whole,
            Basis::Figures(..) => false,
        }
    }

    /// Returns true if the finding is on single entries.
    pub(super) fn is_on_entries(&self) -> bool {
        matches!(self.basis, Basis::Entries(_))
    }

    /// Returns true if the finding is on everything that is proved.
    pub(super) fn is_on_proofs(&self) -> bool {
        matches!(self.basis, Basis::Ledger { .. })
    }

    /// The finding on single entries or on what is proved, which is as recorded if they are.
    pub(in crate::papers) fn on_ledger(&self, ledger: &Ledger) -> Option<Finding> {
        let entries = match &self.basis {
            Basis::Entries(entries) => entries,
            Basis::Ledger { .. } => {
                let count = ledger.count(Verdict::Proved).to_string();
                let title = self.title.replace("{proved}", &count);
                return Some(proved(ledger, [self.id, self.place], title, self.text));
            }
            Basis::Figures(..) => return None,
        };
        let found = |id: &str| ledger.entries.iter().find(|e| e.id == id);
        let found: Vec<&LedgerEntry> = entries.iter().filter_map(|e| found(e.0)).collect();
        let all = found.len() == entries.len() && found.iter().all(|e| e.as_recorded);
        let draft = self.draft(&[]);
        Some(
            draft
                .figures(found.into_iter().map(of_entry))
                .recorded_if(all),
        )
    }

    /// The finding on figures.
    pub(in crate::papers) fn on_figures(&self, analysis: &mut Analysis) -> Option<Finding> {
        let Basis::Figures(stated, words) = &self.basis else {
            return None;
        };
        let found = analysis.found.remove(self.id);
        let of_analysis = stated.is_empty() || stated.iter().any(|f| f.is.is_none());
        let missing = of_analysis && found.is_none();
        let found = found.unwrap_or_else(|| Found::new([], !missing));
        let mut rest = found.figures.into_iter();
        let figures: Vec<Figure> = match stated.is_empty() {
            true => rest.by_ref().collect(),
            false => stated.iter().map(|f| f.figure(&mut rest)).collect(),
        };
        let values: Vec<&str> = stated.iter().map(|f| f.value).collect();
        let same = match stated.is_empty() {
            true => known(&figures) && !figures.is_empty(),
            false => recorded(&figures, &values) && rest.next().is_none(),
        };
        let own: Vec<String> = figures.iter().map(|f| f.value.clone()).collect();
        let same_words = found.words.iter().eq(words.iter());
        let draft = self.draft(&[found.words, own].concat());
        let whole = found.holds && same && same_words;
        Some(draft.figures(figures).recorded_if(whole))
    }

    /// Title and text with `{1}`, `{2}`, … replaced by words.
    fn draft(&self, words: &[String]) -> Draft {
        let filled = |text: &str| {
            let words = words.iter().zip(1..);
            words.fold(text.to_string(), |text, (word, k)| {
                text.replace(&format!("{{{k}}}"), word)
            })
        };
        Draft::new(self.id, self.subject, self.place)
            .verdict(self.verdict)
            .titled(filled(self.title))
            .text(filled(self.text))
    }
}

fn of_entry(entry: &LedgerEntry) -> Figure {
    let value = match (&entry.corrected, entry.obligations.len()) {
        (Some(corrected), _) => format!("misprint, has to be {}", corrected.text),
        (None, 0) => entry.verdict.words().into(),
        (None, 1) => format!("{}, one statement decided", entry.verdict.words()),
        (None, n) => format!("{}, {n} statements decided", entry.verdict.words()),
    };
    figure(format!("{} of the ledger", entry.id), value, "1")
}

#[cfg(test)]
mod tests;
