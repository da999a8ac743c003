//! Findings that a file states in words, with what they rest on: entries of the ledger, everything
//! in it that is proved, or figures and conditions on record. Numbers in the words are formulas of
//! what the file declares and, of a paper with an analysis in the program, of what that measures.

mod text;

use super::claim::SUBJECTS;
use super::read::{Reading, only, required, text, texts, word};
use super::table::shared;
use crate::papers::ledger::{Item, Ledger, LedgerEntry, Names, Verdict};
use crate::papers::number::Number;
use crate::papers::{Entry, Figure, Finding, FindingVerdict, Subject, Tally, figure, known};
use crate::reference::Ball;
use crate::study::document::{Item as Node, Value};
use crate::study::{Place, StudyError, intern};
use rug::Rational;
use std::collections::BTreeMap;
use text::{Condition, Scope, Template};

/// A quantity that an analysis hands to the findings of a paper.
#[derive(Clone, Debug)]
pub enum Quantity {
    /// An exact number.
    Exact(Rational),
    /// A number with its enclosure.
    Number(Ball),
    /// A number as printed, which stands in words with its characters.
    Printed(Number),
    /// A text.
    Text(String),
    /// Figures as they are.
    Figures(Vec<Figure>),
}

/// The quantities, entries and counts that an analysis in the program measures.
#[derive(Clone, Debug, Default)]
pub struct Measured {
    /// The quantities by their names.
    pub quantities: BTreeMap<String, Quantity>,
    /// Printed entries that it judges.
    pub entries: Vec<Entry>,
    /// Their counts.
    pub tallies: Vec<Tally>,
}

impl Measured {
    /// Hands over a number. One that is not finite stays unknown: no finding that needs it is as
    /// recorded.
    pub fn set(&mut self, name: impl Into<String>, x: f64) {
        if let Some(x) = Rational::from_f64(x) {
            self.add(name, Quantity::Exact(x));
        }
    }

    /// Hands over any quantity.
    pub fn add(&mut self, name: impl Into<String>, value: Quantity) {
        self.quantities.insert(name.into(), value);
    }

    /// Hands over a text.
    pub fn text(&mut self, name: impl Into<String>, text: impl ToString) {
        self.add(name, Quantity::Text(text.to_string()));
    }
}

/// A finding as the file states it.
#[derive(Clone, Debug)]
pub struct Stated {
    id: &'static str,
    subject: Subject,
    place: &'static str,
    verdict: FindingVerdict,
    title: Template,
    text: Template,
    basis: Basis,
    lines: Vec<Line>,
    conditions: Vec<Condition>,
    file: &'static str,
}

/// The part of the ledger that a finding rests on.
#[derive(Clone, Debug)]
enum Basis {
    /// None of it: figures and conditions alone.
    Figures,
    /// Entries, with their places in the file.
    Entries(Vec<(&'static str, Place)>),
    /// All of it; no other entry is a finding if it is the whole.
    Ledger { whole: bool },
}

/// A line of a finding's figures.
#[derive(Clone, Debug)]
enum Line {
    /// A list that the analysis hands over.
    List(&'static str),
    /// Name and value of a figure, its unit, and its value on record.
    One([Template; 2], &'static str, Option<&'static str>),
}

const KEYS: &str = "id subject place verdict title text entries ledger figures holds with";

/// Names that stand for numbers of the entries that a finding rests on: all, those that are proved,
/// and those that are as recorded.
const COUNTS: [&str; 3] = ["entries", "proved", "recorded"];

pub(in crate::papers) const VERDICTS: [(&str, FindingVerdict); 6] = [
    ("confirmed", FindingVerdict::Confirmed),
    ("error-of-paper", FindingVerdict::ErrorOfPaper),
    ("print-or-scan", FindingVerdict::PrintOrScan),
    ("refuted", FindingVerdict::Refuted),
    ("recovered", FindingVerdict::Recovered),
    ("unexplained", FindingVerdict::Unexplained),
];

/// Reads a finding.
pub(super) fn read(reading: &mut Reading, node: &Node) -> Result<Stated, StudyError> {
    only(node, KEYS)?;
    required(node, "place")?;
    let basis = basis(node)?;
    let (definitions, own) = shared(reading, node)?;
    let counts = match basis {
        Basis::Figures => &[][..],
        _ => &COUNTS[..],
    };
    let scope = Scope {
        names: match reading.is_analysed {
            // Whatever the analysis may measure.
            true => Names::default(),
            false => {
                let counts = counts.iter().map(|name| name.to_string());
                reading.symbols.names.with(own.into_iter().chain(counts))
            }
        },
        given: (!reading.is_analysed).then_some(counts),
        definitions: &definitions,
    };
    let lines = node.get("figures").map_or(Ok(&[][..]), Node::list)?;
    let lines = lines.iter().map(|node| line(&scope, node));
    let conditions = texts(node.get("holds")).into_iter();
    let conditions = conditions.map(|node| scope.condition(node));
    let stated = Stated {
        id: reading.id(node)?,
        subject: word(node.get("subject"), &SUBJECTS, Subject::Formula)?,
        place: text(node, "place")?,
        verdict: word(
            Some(required(node, "verdict")?),
            &VERDICTS,
            FindingVerdict::Unexplained,
        )?,
        title: scope.template(required(node, "title")?)?,
        text: scope.template(required(node, "text")?)?,
        lines: lines.collect::<Result<_, _>>()?,
        conditions: conditions.collect::<Result<_, _>>()?,
        basis,
        file: reading.file,
    };
    let is_judged = |line: &Line| matches!(line, Line::List(_) | Line::One(.., Some(_)));
    let is_on_record = !stated.conditions.is_empty() || stated.lines.iter().any(is_judged);
    match matches!(stated.basis, Basis::Figures) && !is_on_record {
        true => Err(node.fault(
            "a finding rests on entries, on the ledger, or on at least one condition or value on record",
        )),
        false => Ok(stated),
    }
}

fn basis(node: &Node) -> Result<Basis, StudyError> {
    let mut entries = Vec::new();
    for item in texts(node.get("entries")) {
        entries.push((intern(item.text()?), item.place));
    }
    match (node.get("entries"), node.get("ledger")) {
        (None, None) => Ok(Basis::Figures),
        (Some(_), None) if !entries.is_empty() => Ok(Basis::Entries(entries)),
        (None, Some(ledger)) => {
            let whole = word(Some(ledger), &[("whole", true), ("proved", false)], true)?;
            Ok(Basis::Ledger { whole })
        }
        _ => Err(node.fault("a finding rests on at least one entry, or on the ledger")),
    }
}

/// `[name, value, unit, value on record]`, the last of which may be missing, or the name of a list
/// that an analysis hands over.
fn line(scope: &Scope, node: &Node) -> Result<Line, StudyError> {
    let parts = match &node.value {
        Value::List(parts) => &parts[..],
        _ if scope.given.is_none() => return node.text().map(|name| Line::List(intern(name))),
        _ => &[],
    };
    let [name, value, unit, recorded @ ..] = parts else {
        return Err(node.fault("a figure is [name, value, unit, value on record]"));
    };
    let recorded = recorded.first().map(|r| r.text().map(intern)).transpose()?;
    let both = [scope.template(name)?, scope.template(value)?];
    Ok(Line::One(both, intern(unit.text()?), recorded))
}

impl Stated {
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
            Basis::Figures => false,
        }
    }

    /// Returns true if the finding is on single entries.
    pub(super) fn is_on_entries(&self) -> bool {
        matches!(self.basis, Basis::Entries(_))
    }

    /// Returns true if the finding rests on the ledger or a part of it.
    pub(in crate::papers) fn is_on_ledger(&self) -> bool {
        !matches!(self.basis, Basis::Figures)
    }

    /// The finding, which is as recorded if its entries and figures are, its conditions hold and
    /// every number in it is known.
    pub(in crate::papers) fn finding(&self, ledger: &Ledger, measured: &Measured) -> Finding {
        let entries: Vec<&LedgerEntry> = match &self.basis {
            Basis::Figures => Vec::new(),
            Basis::Entries(ids) => {
                let found = |id: &str| ledger.entries.iter().find(|e| e.id == id);
                ids.iter().filter_map(|e| found(e.0)).collect()
            }
            Basis::Ledger { .. } => ledger.entries.iter().collect(),
        };
        let count = |of: fn(&LedgerEntry) -> bool| entries.iter().filter(|e| of(e)).count();
        let proved = count(|e| e.verdict == Verdict::Proved);
        let counts = [entries.len(), proved, count(|e| e.as_recorded)];
        let mut own = measured.quantities.clone();
        for (name, count) in COUNTS.iter().zip(counts) {
            own.insert((*name).into(), Quantity::Exact(count.into()));
        }
        let mut same = match &self.basis {
            Basis::Figures => true,
            Basis::Entries(ids) => ids.len() == entries.len(),
            Basis::Ledger { .. } => !entries.is_empty(),
        };
        same &= entries.iter().all(|e| e.as_recorded);
        same &= self.conditions.iter().all(|c| c.holds(&own));
        let mut known_all = true;
        let mut written = |template: &Template| {
            let (text, all) = template.written(&own);
            known_all &= all;
            text
        };
        let (title, text) = (written(&self.title), written(&self.text));
        let mut figures = match (&self.basis, &self.lines[..]) {
            (Basis::Entries(_), []) => entries.into_iter().map(of_entry).collect(),
            (Basis::Ledger { .. }, []) => of_ledger([counts[0], proved]),
            _ => Vec::new(),
        };
        for line in &self.lines {
            match line {
                Line::List(name) => match own.get(*name) {
                    Some(Quantity::Figures(list)) if !list.is_empty() && known(list) => {
                        figures.extend(list.iter().cloned());
                    }
                    _ => same = false,
                },
                Line::One(both, unit, recorded) => {
                    let [name, value] = both.each_ref().map(&mut written);
                    same &= recorded.is_none_or(|recorded| recorded == value);
                    figures.push(figure(name, value, unit));
                }
            }
        }
        Finding {
            id: self.id,
            subject: self.subject,
            place: self.place,
            title,
            verdict: self.verdict,
            text,
            figures,
            as_recorded: same && known_all,
        }
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

fn of_ledger([all, proved]: [usize; 2]) -> Vec<Figure> {
    vec![
        figure("entries of the ledger", all, "1"),
        figure("proved", proved, "1"),
    ]
}

/// The finding on everything that is proved, of a paper whose files state nothing of it.
pub(super) fn on_proofs(ledger: &Ledger) -> Finding {
    let count = ledger.count(Verdict::Proved);
    Finding {
        id: "ledger-proved",
        subject: Subject::Formula,
        place: "all formulas",
        title: match count {
            0 => "No entry of the ledger is proved as printed".into(),
            1 => "One entry of the ledger is proved as printed".into(),
            count => format!("{count} entries of the ledger are proved as printed"),
        },
        verdict: FindingVerdict::Confirmed,
        text:
            "The difference of both sides has the normal form zero in the exact algebra, or lies \
               within its bound in balls. The ledger lists every entry with its requirements."
                .into(),
        figures: of_ledger([ledger.entries.len(), count]),
        as_recorded: ledger.as_recorded(),
    }
}

#[cfg(test)]
mod tests;
