//! The report of a paper that its files state.

use super::claim::Quantity;
use super::finding::{Measured, on_proofs};
use super::table::{Column, Rounding};
use super::{Accuracy, Claim, PaperFile, Stated, Survey, Table};
use crate::papers::ledger::{Ledger, LedgerEntry, dimension, finding};
use crate::papers::number::{self, AS_PRINTED, Number, explained};
use crate::papers::{
    Entry, EntryVerdict, Figure, Finding, FindingVerdict, PaperReport, Progress, Subject, Tally,
    VariantJudgement, decided, figure,
};
use crate::reference::{Ball, Undecided};
use crate::study::Study;
use crate::symbolic::Outcome;
use crate::symbolic::evaluation::{Answer, Goal};
use rayon::prelude::*;
use rug::Rational;

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
            let findings = all.par_iter().map(|s| s.finding(ledger, measured));
            findings.collect()
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
    let given = |k: usize| table.given.iter().map(move |g| g.1[k].value.value.clone());
    let inputs: Vec<Vec<Rational>> = (0..table.rows.len()).map(|k| given(k).collect()).collect();
    let known = table.columns.iter().map(|column| {
        let cells = column.printed.iter().enumerate();
        let cells: Vec<(usize, &Number)> = cells
            .filter_map(|(k, number)| Some((k, number.as_ref()?)))
            .collect();
        // The same digits in all rows: a trajectory that has to be closer begins anew.
        let digits = cells.iter().map(|(_, number)| number.text.len()).max();
        let digits = digits.unwrap_or_default() + MORE_DIGITS;
        let values = cells.into_par_iter().map(|(k, number)| {
            let value = value_in_row(column, &inputs[k], digits);
            (table.rows[k], number, value)
        });
        values.collect::<Vec<_>>()
    });
    let known: Vec<Vec<(u32, &Number, Known)>> = known.collect();
    let columns = table.columns.iter().zip(&known).map(|(column, cells)| {
        let rows = cells.iter().map(|(row, printed, value)| number::Row {
            number: *row,
            name: column.name,
            printed,
            due: vec![value.as_ref().ok()],
        });
        number::Column {
            table: table.number,
            name: column.name,
            rows: rows.collect(),
        }
    });
    let columns: Vec<number::Column> = columns.collect();
    let (entries, tallies) = number::entries(&[AS_PRINTED], &columns, |[c, r, _], agrees| {
        let (_, number, value) = &known[c][r];
        judged(number, value, table.columns[c].rounding, agrees)
    });
    let (mut figures, mut as_recorded, mut right) = (Vec::new(), true, 0);
    let mut of_print = true;
    let mut rest = entries.iter();
    for (column, cells) in table.columns.iter().zip(&known) {
        let mut wrong = Vec::new();
        for entry in rest.by_ref().take(cells.len()) {
            let judged = &entry.variants[AS_PRINTED];
            if judged.verdict == EntryVerdict::Agrees {
                right += 1;
                continue;
            }
            wrong.push(entry.row);
            of_print &= judged.verdict == EntryVerdict::Misprint;
            figures.push(off(entry, judged));
        }
        // An undecided number is not known to be wrong.
        as_recorded &= wrong == column.wrong && cells.iter().all(|cell| cell.2.is_ok());
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

fn off(entry: &Entry, judged: &VariantJudgement) -> Figure {
    let name = format!(
        "row {}, {}, printed {}",
        entry.row, entry.column, entry.printed
    );
    let value = match &judged.note {
        Some(note) => format!("{} ({note})", judged.recomputed),
        None => judged.recomputed.clone(),
    };
    figure(name, value, "1")
}

/// Decides a claim.
fn judge_claim(claim: &Claim) -> Finding {
    let longest = claim.numbers().map(|(_, n)| n.text.len()).max();
    let longest = longest.unwrap_or_default();
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
    let printed = claim.numbers();
    let mut figures: Vec<Figure> = printed
        .map(|(name, number)| figure(name, &number.text, claim.unit))
        .collect();
    figures.push(figure(
        "recomputed",
        shown(&value, longest + MORE_DIGITS),
        claim.unit,
    ));
    let statement = &claim.statement;
    let as_recorded = outcome == claim.expected;
    statement.finding(verdict, statement.claim, figures, as_recorded)
}

fn not_enclosed() -> String {
    "undecided: the extreme is not enclosed within the limit on subdivisions".into()
}

/// The radius of an extreme that decides its claim, unless the number is close to a limit.
fn within(claim: &Claim) -> f64 {
    let units = claim.numbers().map(|(_, n)| n.value.unit().to_f64());
    units.fold(f64::INFINITY, f64::min) / 64.0
}

/// The digits that are known.
pub(super) fn shown(value: &Known, digits: usize) -> String {
    let value = match value {
        Ok(value) => value,
        Err(reason) => return reason.clone(),
    };
    decided((1..=digits).rev().find_map(|n| value.to_decimal(n)))
}

/// All parts of the claim have to hold; one that fails refutes it.
fn outcome(claim: &Claim, value: &Ball) -> Outcome {
    let rounded = claim.printed.iter().map(|printed| {
        let is_right = is_right(printed, value, claim.rounding);
        (is_right, printed.is_wrong(value, claim.rounding))
    });
    let [lower, upper] = &claim.bounds;
    let above = lower.iter().map(|bound| -bound.difference(value));
    let below = upper.iter().map(|bound| bound.difference(value));
    let kept = above.chain(below);
    let kept = kept.map(|slack| {
        let is_kept = slack.is_positive() || slack.is_zero();
        (is_kept, slack.is_negative())
    });
    let parts: Vec<(bool, bool)> = rounded.chain(kept).collect();
    match () {
        () if parts.iter().any(|part| part.1) => Outcome::Refuted,
        () if parts.iter().all(|part| part.0) && !parts.is_empty() => Outcome::Proved,
        () => Outcome::Undecided,
    }
}
