//! The report of a paper's audit.

use crate::reference::Ball;
use serde::Serialize;
use std::collections::BTreeMap;

/// Version of the JSON layout; changes when a field is removed or changes its meaning.
pub const SCHEMA_VERSION: u32 = 1;

/// The paper.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Citation {
    /// The name used on the command line.
    pub key: &'static str,
    /// Authors.
    pub authors: &'static str,
    /// Title, in English.
    pub title: &'static str,
    /// Year, where it is known.
    pub year: Option<u16>,
    /// Where it appeared.
    pub venue: &'static str,
    /// The source that was read, where that is stated.
    #[serde(skip_serializing_if = "str::is_empty")]
    pub source: &'static str,
}

impl Citation {
    /// Returns the authors with the year; none where the paper names nobody.
    pub fn by(&self) -> Option<String> {
        let year = self.year.map_or(String::new(), |y| format!(" ({y})"));
        let by = format!("{}{year}", self.authors);
        Some(by.trim().to_string()).filter(|by| !by.is_empty())
    }

    /// Returns the venue, where it is known.
    pub fn at(&self) -> Option<String> {
        Some(self.venue.to_string()).filter(|venue| !venue.is_empty())
    }
}

/// Everything found about one paper.
#[derive(Clone, Debug, Serialize)]
pub struct PaperReport {
    /// [`SCHEMA_VERSION`].
    pub schema_version: u32,
    /// Program version.
    pub mechaudit_version: &'static str,
    /// The paper.
    pub paper: Citation,
    /// The findings, in plain words with figures.
    pub findings: Vec<Finding>,
    /// The number of entries that agree, by variant of the data and column.
    pub tallies: Vec<Tally>,
    /// Every printed entry.
    pub entries: Vec<Entry>,
}

impl PaperReport {
    /// The findings of this version of the program, with the printed entries and how many of them
    /// agree.
    pub(super) fn new(
        paper: Citation,
        findings: Vec<Finding>,
        entries: Vec<Entry>,
        tallies: Vec<Tally>,
    ) -> PaperReport {
        PaperReport {
            schema_version: SCHEMA_VERSION,
            mechaudit_version: env!("CARGO_PKG_VERSION"),
            paper,
            findings,
            tallies,
            entries,
        }
    }

    /// Returns true if every finding is as recorded.
    pub fn as_recorded(&self) -> bool {
        !self.findings.is_empty() && self.findings.iter().all(|f| f.as_recorded)
    }
}

/// The subject of a finding.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Subject {
    /// Input data.
    Data,
    /// Printed tables.
    Tables,
    /// A formula or step.
    Formula,
    /// A claim or conclusion.
    Claim,
}

/// The verdict on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum FindingVerdict {
    /// The print is right.
    Confirmed,
    /// Wrong in the paper.
    ErrorOfPaper,
    /// Wrong as it stands; the scan may be to blame.
    PrintOrScan,
    /// A claim that does not hold.
    Refuted,
    /// Missing in the paper and worked out from its tables.
    Recovered,
    /// Left open.
    Unexplained,
}

/// A figure that belongs to a finding.
#[derive(Clone, Debug, Serialize)]
pub struct Figure {
    /// Its name.
    pub name: String,
    /// Its value, written with the digits that hold.
    pub value: String,
    /// Its unit, `1` if none.
    pub unit: &'static str,
    /// LaTeX without delimiters where the value is a formula.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub latex: Option<String>,
}

pub(super) fn figure(name: impl Into<String>, value: impl ToString, unit: &'static str) -> Figure {
    Figure {
        name: name.into(),
        value: value.to_string(),
        unit,
        latex: None,
    }
}

/// Stands for a value that is not known to the digits asked for.
const UNDECIDED: &str = "undecided";

/// A value to `digits` digits.
pub(super) fn shown(value: &Ball, digits: usize) -> String {
    decided(value.to_decimal(digits))
}

/// A value in digits, if it is known to as many.
pub(super) fn decided(digits: Option<String>) -> String {
    digits.unwrap_or_else(|| UNDECIDED.into())
}

/// Returns true if all figures are known.
pub(super) fn known(figures: &[Figure]) -> bool {
    figures.iter().all(|f| f.value != UNDECIDED)
}

/// One finding.
#[derive(Clone, Debug, Serialize)]
pub struct Finding {
    /// A stable name.
    pub id: &'static str,
    /// Its subject.
    pub subject: Subject,
    /// Where in the paper: a formula number, table or section.
    pub place: &'static str,
    /// One line.
    pub title: String,
    /// The verdict.
    pub verdict: FindingVerdict,
    /// A paragraph in plain words.
    pub text: String,
    /// The figures.
    pub figures: Vec<Figure>,
    /// True if this run found what earlier runs recorded. False makes the program exit with 1.
    pub as_recorded: bool,
}

/// The verdict on a printed entry.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum EntryVerdict {
    /// Within half a unit of the last printed digit: the correct rounding.
    Agrees,
    /// Within one unit: rounded from inexact intermediate values.
    Rounding,
    /// Off by more, with one wrong or superfluous character that explains it.
    Misprint,
    /// Off by more, without an explanation.
    Unexplained,
}

/// A printed entry under one variant of the data.
#[derive(Clone, Debug, Serialize)]
pub struct VariantJudgement {
    /// The certified value, at least 20 significant digits.
    pub recomputed: String,
    /// `(printed − recomputed)` in units of the last printed digit.
    pub units_in_last_digit: f64,
    /// The verdict.
    pub verdict: EntryVerdict,
    /// The explanation of a misprint.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub note: Option<String>,
}

/// One printed entry.
#[derive(Clone, Debug, Serialize)]
pub struct Entry {
    /// Table number.
    pub table: u32,
    /// Row, as printed.
    pub row: u32,
    /// Column.
    pub column: &'static str,
    /// The text as printed, with a decimal point.
    pub printed: String,
    /// By variant of the data: `as_printed`, `recovered`, `recovered_fitted_nodes`.
    pub variants: BTreeMap<&'static str, VariantJudgement>,
}

/// The number of entries of a column that agree.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Tally {
    /// Variant of the data.
    pub variant: &'static str,
    /// Table number.
    pub table: u32,
    /// Column.
    pub column: &'static str,
    /// Entries.
    pub entries: usize,
    /// Within half a unit of the last digit.
    pub within_half: usize,
    /// Within one unit.
    pub within_one: usize,
    /// Largest deviation in units of the last digit.
    pub worst_units: f64,
    /// Largest absolute deviation.
    pub worst: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_known_to_so_many_digits_is_undecided() {
        let third = &Ball::integer(64, 1) / &Ball::integer(64, 3);
        let of = |digits| [figure("a third", shown(&third, digits), "1")];
        assert_eq!((of(5)[0].value.as_str(), known(&of(5))), ("0.33333", true));
        assert_eq!(
            (of(30)[0].value.as_str(), known(&of(30))),
            ("undecided", false)
        );
    }

    #[test]
    fn one_finding_that_has_changed_is_enough() {
        let finding = |as_recorded| Finding {
            id: "",
            subject: Subject::Data,
            place: "",
            title: String::new(),
            verdict: FindingVerdict::Confirmed,
            text: String::new(),
            figures: Vec::new(),
            as_recorded,
        };
        let recorded = |of: &[bool]| {
            let paper = Citation::default();
            let findings = of.iter().map(|r| finding(*r)).collect();
            PaperReport::new(paper, findings, Vec::new(), Vec::new()).as_recorded()
        };
        assert!(recorded(&[true]) && recorded(&[true, true]));
        assert!(!recorded(&[true, false]) && !recorded(&[false, true]) && !recorded(&[]));
    }
}
