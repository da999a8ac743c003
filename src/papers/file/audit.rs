//! The report of a paper that its files state.

use super::claim::Quantity;
use super::finding::{Measured, on_proofs};
use super::table::{Column, Rounding};
use super::{Accuracy, Claim, PaperFile, Stated, Survey, Table};
use crate::papers::ledger::{Ledger, LedgerEntry, dimension, finding};
use crate::papers::number::{AS_PRINTED, Number, explained, tally};
use crate::papers::{
    Entry, EntryVerdict, Figure, Finding, FindingVerdict, PaperReport, Progress, Subject, Tally,
    VariantJudgement, figure,
};
use crate::reference::{Ball, Undecided};
use crate::study::Study;
use crate::symbolic::Outcome;
use crate::symbolic::evaluation::{Answer, Goal};
use rayon::prelude::*;
use rug::Rational;
use std::collections::BTreeMap;

/// Significant digits of recomputed values beyond those that are printed.
pub(super) const MORE_DIGITS: usize = 10;

impl PaperFile {
    /// Audits the paper: the ledger, the tables entry by entry, the claims, and what its analysis in
    /// the program measures.
    ///
    /// # Errors
    /// [`Undecided`] when the analysis has no certified value.
    pub fn report(&self, progress: Progress) -> Result<PaperReport, Undecided> {
        let of = self.analysis.and_then(crate::papers::paper);
        let analyse = of.and_then(|paper| paper.analyse);
        let none = || Ok(Measured::default());
        self.analysed(|| analyse.map_or_else(none, |analyse| analyse()), progress)
    }

    /// Audits the paper with what an analysis measures.
    ///
    /// # Errors
    /// [`Undecided`] when the analysis has no certified value.
    pub(in crate::papers) fn analysed(
        &self,
        analyse: impl FnOnce() -> Result<Measured, Undecided>,
        progress: Progress,
    ) -> Result<PaperReport, Undecided> {
        progress("ledger", 0, 4);
        let ledger = self.ledger();
        progress("analysis", 1, 4);
        let measured = analyse()?;
        let mut findings = self.findings(&ledger, &measured);
        progress("tables", 2, 4);
        let (mut entries, mut tallies) = (measured.entries, measured.tallies);
        for table in &self.tables {
            let (found, of_table, of_columns) = judge_table(table);
            findings.push(found);
            entries.extend(of_table);
            tallies.extend(of_columns);
        }
        progress("claims", 3, 4);
        findings.par_extend(self.claims.par_iter().map(judge_claim));
        findings.extend(self.accuracies.iter().map(Accuracy::finding));
        findings.extend(self.surveys.iter().flat_map(Survey::findings));
        progress("done", 4, 4);
        let paper = self.citation.clone();
        Ok(PaperReport::new(paper, findings, entries, tallies))
    }

    /// The findings that the files state, in their order; after those on single entries one for each
    /// other entry that is wrong or open, and one for everything that is proved unless a finding
    /// rests on the ledger.
    pub(in crate::papers) fn findings(&self, ledger: &Ledger, measured: &Measured) -> Vec<Finding> {
        let on_entries = self.stated.iter().take_while(|s| s.is_on_entries());
        let (first, rest) = self.stated.split_at(on_entries.count());
        let covered = |e: &&LedgerEntry| !self.stated.iter().any(|s| s.covers(e.id));
        let alone = ledger.entries.iter().filter(covered);
        let stated = |all: &[Stated]| -> Vec<Finding> {
            all.iter().map(|s| s.finding(ledger, measured)).collect()
        };
        let mut all = stated(first);
        all.extend(alone.flat_map(|e| [finding(e), dimension(e)]).flatten());
        if !self.items.is_empty() && !self.stated.iter().any(Stated::is_on_ledger) {
            all.push(on_proofs(ledger));
        }
        all.extend(stated(rest));
        all
    }
}

/// A value as far as it is known.
pub(super) type Known = Result<Ball, String>;

/// The certified value of a column in a row.
fn value_in_row(column: &Column, inputs: &[Rational], digits: usize) -> Known {
    let answers = column.study.answers(inputs, Goal::Bits(bits(digits)));
    known(answers.into_iter().skip(column.output))
}

fn bits(digits: usize) -> u32 {
    (digits as f64 * std::f64::consts::LOG2_10).ceil() as u32 + 10
}

fn known(answers: impl IntoIterator<Item = Answer>) -> Known {
    match answers.into_iter().next() {
        Some(Answer::Number(ball)) => Ok(ball),
        Some(Answer::Zero) => Ok(Ball::integer(64, 0)),
        Some(Answer::Huge { .. }) => Err("beyond all exponents".into()),
        Some(Answer::Undefined { reason, place }) => Err(format!("undefined: {reason} in {place}")),
        Some(Answer::Undecided(open)) => Err(format!("undecided: {open}")),
        None => Err("undecided".into()),
    }
}

/// The certified value of a study without inputs.
pub(super) fn recomputed(study: &Study, digits: usize) -> Known {
    known(study.answers(&[], Goal::Bits(bits(digits))))
}

/// Returns true if a printed number is right by a rule of rounding.
fn is_right(printed: &Number, value: &Ball, rounding: Rounding) -> bool {
    match rounding {
        Rounding::Nearest => printed.is_rounded(value),
        Rounding::LastDigit => printed.is_within_one(value),
        Rounding::Cut => printed.is_cut(value),
    }
}

/// Judges every entry of a table.
fn judge_table(table: &Table) -> (Finding, Vec<Entry>, Vec<Tally>) {
    let inputs: Vec<Vec<Rational>> = (0..table.rows.len())
        .map(|k| {
            table
                .given
                .iter()
                .map(|g| g.1[k].value.value.clone())
                .collect()
        })
        .collect();
    let (mut entries, mut tallies) = (Vec::new(), Vec::new());
    let (mut figures, mut as_recorded, mut right) = (Vec::new(), true, 0);
    let mut of_print = true;
    for column in &table.columns {
        let cells: Vec<(usize, &Number)> = column
            .printed
            .iter()
            .enumerate()
            .filter_map(|(k, number)| Some((k, number.as_ref()?)))
            .collect();
        // The same digits in all rows: a trajectory that has to be closer begins anew.
        let digits = cells.iter().map(|(_, number)| number.text.len()).max();
        let digits = digits.unwrap_or_default() + MORE_DIGITS;
        let values: Vec<Known> = cells
            .par_iter()
            .map(|(k, _)| value_in_row(column, &inputs[*k], digits))
            .collect();
        let pairs = cells.iter().zip(&values);
        let pairs = pairs.filter_map(|((_, number), value)| Some((*number, value.as_ref().ok()?)));
        let of_column = Tally {
            entries: cells.len(),
            ..tally([AS_PRINTED, column.name], table.number, pairs)
        };
        // A misprint stands out only where nearly everything else agrees.
        let agrees = cells.len() - of_column.within_one <= cells.len() / 10;
        let mut wrong = Vec::new();
        for ((k, number), value) in cells.iter().zip(&values) {
            let row = table.rows[*k];
            let judged = judged(number, value, column.rounding, agrees);
            if matches!(judged.verdict, EntryVerdict::Agrees) {
                right += 1;
            } else {
                wrong.push(row);
                of_print &= judged.verdict == EntryVerdict::Misprint;
                figures.push(off(column, row, number, &judged));
            }
            entries.push(Entry {
                table: table.number,
                row,
                column: column.name,
                printed: number.text.clone(),
                variants: BTreeMap::from([(AS_PRINTED, judged)]),
            });
        }
        // An undecided number is not known to be wrong.
        as_recorded &= wrong == column.wrong && values.iter().all(Result::is_ok);
        tallies.push(of_column);
    }
    let verdict = match (right == entries.len(), of_print) {
        (true, _) => FindingVerdict::Confirmed,
        (false, true) => FindingVerdict::PrintOrScan,
        (false, false) => FindingVerdict::ErrorOfPaper,
    };
    let of = entries.len();
    let name = crate::study::intern(&format!("table-{}", table.number));
    let place = crate::study::intern(&format!("table {}", table.number));
    let sentence = "Every printed number is compared with the certified value of its column's definition in the \
                    numbers of its row, by the rule of rounding of its column.";
    let text = match table.title {
        "" => sentence.to_string(),
        title => format!("{title}. {sentence}"),
    };
    let found = Finding {
        id: name,
        subject: Subject::Tables,
        place,
        title: format!("{right} of {of} printed numbers are right"),
        verdict,
        text,
        figures,
        as_recorded: as_recorded && of > 0,
    };
    (found, entries, tallies)
}

/// The judgement of one entry: it agrees if it is right by its rule.
fn judged(number: &Number, value: &Known, rounding: Rounding, agrees: bool) -> VariantJudgement {
    let value = match value {
        Ok(value) => value,
        Err(reason) => {
            return VariantJudgement {
                recomputed: reason.clone(),
                units_in_last_digit: f64::NAN,
                verdict: EntryVerdict::Unexplained,
                note: None,
            };
        }
    };
    let mut found = number.judged(value, number.text.len() + MORE_DIGITS);
    if is_right(number, value, rounding) {
        (found.verdict, found.note) = (EntryVerdict::Agrees, None);
    } else if found.verdict == EntryVerdict::Agrees {
        // The nearest number, where the digits had to be cut off.
        found.verdict = EntryVerdict::Rounding;
    } else if found.verdict == EntryVerdict::Unexplained
        && agrees
        && let Some(note) = explained(&number.text, value)
    {
        (found.verdict, found.note) = (EntryVerdict::Misprint, Some(note));
    }
    found
}

fn off(column: &Column, row: u32, number: &Number, judged: &VariantJudgement) -> Figure {
    let name = format!("row {row}, {}, printed {}", column.name, number.text);
    let value = match &judged.note {
        Some(note) => format!("{} ({note})", judged.recomputed),
        None => judged.recomputed.clone(),
    };
    figure(name, value, "1")
}

/// Decides a claim.
fn judge_claim(claim: &Claim) -> Finding {
    let numbers = claim.printed.iter().chain(claim.bounds.iter().flatten());
    let longest = numbers.map(|n| n.text.len()).max().unwrap_or_default();
    let value = match &claim.quantity {
        Quantity::Value(study) => recomputed(study, longest + MORE_DIGITS),
        Quantity::Largest(f) => f.largest(within(claim)).ok_or_else(not_enclosed),
        Quantity::Smallest(f) => {
            let found = f.largest(within(claim)).map(|b| -&b);
            found.ok_or_else(not_enclosed)
        }
    };
    let outcome = match &value {
        Ok(value) => outcome(claim, value),
        Err(_) => Outcome::Undecided,
    };
    let verdict = match outcome {
        Outcome::Proved => FindingVerdict::Confirmed,
        Outcome::Refuted => FindingVerdict::Refuted,
        Outcome::Undecided => FindingVerdict::Unexplained,
    };
    let mut figures = Vec::new();
    if let Some(printed) = &claim.printed {
        figures.push(figure("printed", &printed.text, claim.unit));
    }
    for (name, bound) in ["printed lower bound", "printed upper bound"]
        .iter()
        .zip(&claim.bounds)
    {
        if let Some(bound) = bound {
            figures.push(figure(*name, &bound.text, claim.unit));
        }
    }
    figures.push(figure(
        "recomputed",
        shown(&value, longest + MORE_DIGITS),
        claim.unit,
    ));
    let text = match claim.note {
        "" => claim.claim.to_string(),
        note => format!("{} {note}", claim.claim),
    };
    Finding {
        id: claim.id,
        subject: claim.subject,
        place: claim.place,
        title: claim.claim.trim_end_matches('.').into(),
        verdict,
        text,
        figures,
        as_recorded: outcome == claim.expected,
    }
}

fn not_enclosed() -> String {
    "undecided: the extreme is not enclosed within the limit on subdivisions".into()
}

/// The radius of an extreme that decides its claim, unless the number is close to a limit.
fn within(claim: &Claim) -> f64 {
    let numbers = claim.printed.iter().chain(claim.bounds.iter().flatten());
    let units = numbers.map(|n| n.value.unit().to_f64());
    units.fold(f64::INFINITY, f64::min) / 64.0
}

/// The digits that are known.
pub(super) fn shown(value: &Known, digits: usize) -> String {
    let value = match value {
        Ok(value) => value,
        Err(reason) => return reason.clone(),
    };
    let shown = (1..=digits)
        .rev()
        .find_map(|digits| value.to_decimal(digits));
    shown.unwrap_or_else(|| "undecided".into())
}

/// All parts of the claim have to hold; one that fails refutes it.
fn outcome(claim: &Claim, value: &Ball) -> Outcome {
    let mut parts = Vec::new();
    if let Some(printed) = &claim.printed {
        parts.push(match is_right(printed, value, claim.rounding) {
            true => Outcome::Proved,
            false if printed.is_wrong(value, claim.rounding) => Outcome::Refuted,
            false => Outcome::Undecided,
        });
    }
    for (bound, sign) in claim.bounds.iter().zip([-1, 1]) {
        let Some(bound) = bound else { continue };
        // Positive if the bound is kept.
        let slack = bound.difference(value);
        let slack = if sign < 0 { -&slack } else { slack };
        parts.push(match () {
            () if slack.is_positive() || slack.is_zero() => Outcome::Proved,
            () if slack.is_negative() => Outcome::Refuted,
            () => Outcome::Undecided,
        });
    }
    match () {
        () if parts.contains(&Outcome::Refuted) => Outcome::Refuted,
        () if parts.contains(&Outcome::Undecided) || parts.is_empty() => Outcome::Undecided,
        () => Outcome::Proved,
    }
}
