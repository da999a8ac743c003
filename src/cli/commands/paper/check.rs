//! The verdicts of a paper against those on record.

use crate::cli::complain;
use crate::cli::failure::{Failure, Outcome};
use mechaudit::papers::{Finding, PaperFile, Subject};

/// Prints a line for each entry, table and claim whose verdict is not the one on record.
pub fn check(paper: &PaperFile, text: &str) -> Result<Outcome, Failure> {
    let ledger = paper.ledger();
    let mut changed = 0;
    for entry in ledger.entries.iter().filter(|e| !e.as_recorded) {
        let place = match entry.origin {
            Some((file, line)) => format!("{text}: {file}, line {line}: "),
            None => format!("{text}: "),
        };
        let (id, found, due) = (entry.id, entry.verdict.words(), entry.expected.words());
        let found = match found == due {
            true => "with a fact or repair that is not the one on record".to_string(),
            false => format!("on record as {due}"),
        };
        complain(&format!(
            "{place}{id} is {}, {found}",
            entry.verdict.words()
        ));
        changed += 1;
    }
    let entries: Vec<&str> = ledger.entries.iter().map(|e| e.id).collect();
    match paper.report(&|_, _, _| {}) {
        Err(e) => {
            complain(&format!("{text}: {e}"));
            changed += 1;
        }
        Ok(report) => {
            // Findings on the ledger change with its entries.
            let entries_changed = changed > 0;
            let on_ledger = |f: &&Finding| entries_changed && f.subject == Subject::Formula;
            let findings = report.findings.iter().filter(|f| !f.as_recorded);
            let findings = findings.filter(|f| !entries.contains(&f.id) && !on_ledger(f));
            for f in findings {
                complain(&format!("{text}: {} is not as recorded: {}", f.id, f.title));
                changed += 1;
            }
        }
    }
    Ok(Outcome::of(changed == 0))
}
